cz_test(problem-read unit test_read.c)
cz_test(problem-bad-files errors test_bad_files.c)
