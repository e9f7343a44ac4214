if(CZ_IS_WHOLE)
    cz_script(browser browser browser.sh) # runs report.js
endif()
