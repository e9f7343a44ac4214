cz_test(test_filter unit test_filter.c)
cz_tests(physics)
