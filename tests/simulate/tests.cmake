cz_test(test_filter unit test_filter.c)
cz_test(test_pulse unit test_pulse.c)
cz_tests(physics)
