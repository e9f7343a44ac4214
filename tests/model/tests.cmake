cz_test(test_kinks unit test_kinks.c)
cz_test(test_model unit test_model.c tests/support/typed_problem.c)
