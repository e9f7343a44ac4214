if(CZ_IS_WHOLE)
    cz_script(repeat repeat repeat.sh)
endif()
