cz_test(test_evaluator unit test_evaluator.c stand_in.c small_problem.c)
