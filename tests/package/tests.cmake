if(CZ_IS_WHOLE)
    cz_script(debian_package package package.sh)
    cz_long_script(debian_root long package.sh root)
endif()
