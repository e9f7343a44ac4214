if(CZ_IS_WHOLE)
    cz_script(python python python.sh)
endif()
