cz_test(test_arena unit test_arena.c)
cz_test(test_error unit test_error.c)
cz_test(test_number unit test_number.c)
cz_test(test_symmetric unit test_symmetric.c)
