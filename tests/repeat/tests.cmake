if(CZ_IS_WHOLE)
    cz_test(test_lanes repeat test_lanes.c)
    cz_test(test_left_out repeat test_left_out.c)
    cz_script(repeat repeat repeat.sh)

    # A second kernel: copies of all parts that line up or put, under other names; everything else is the kernel's own.
    set(second ${CMAKE_CURRENT_BINARY_DIR}/second_kernel)
    file(GLOB second_parts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/dynamics/kernel_*.h)
    add_custom_command(OUTPUT ${second}/names.h
        COMMAND sh ${CMAKE_CURRENT_LIST_DIR}/second_kernel.sh ${PROJECT_SOURCE_DIR} ${second}
        DEPENDS ${CMAKE_CURRENT_LIST_DIR}/second_kernel.sh ${second_parts})
    add_library(cz_kernel_second OBJECT EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/src/dynamics/kernel.c ${second}/names.h)
    target_include_directories(cz_kernel_second BEFORE PRIVATE ${second})
    target_include_directories(cz_kernel_second PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(cz_kernel_second PRIVATE cz_flags)
    target_compile_definitions(cz_kernel_second PRIVATE CZ_ISA=second)
    target_compile_options(cz_kernel_second PRIVATE -include ${second}/names.h)
    cz_test(test_second_kernel repeat test_second_kernel.c)
    target_sources(test_second_kernel PRIVATE $<TARGET_OBJECTS:cz_kernel_second>)
endif()
