cz_test(test_fit_memory errors test_fit_memory.c)
target_link_options(test_fit_memory PRIVATE -Wl,--wrap=calloc,--wrap=aligned_alloc,--wrap=free)
cz_tests(unit)
