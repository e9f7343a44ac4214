cz_test(problem-read unit test_read.c)
