if(CZ_IS_WHOLE)
    cz_test(test_lanes repeat test_lanes.c)
    cz_script(repeat repeat repeat.sh)
endif()
