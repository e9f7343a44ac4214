cz_test(test_filter unit test_filter.c)
