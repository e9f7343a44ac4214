cz_tests(laws)
