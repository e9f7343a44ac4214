cz_test(test_fit unit test_fit.c)
cz_test(test_fit_quality unit test_fit_quality.c)
cz_test(test_fit_memory errors test_fit_memory.c)
target_link_options(test_fit_memory PRIVATE -Wl,--wrap=calloc,--wrap=aligned_alloc,--wrap=free)
