cz_test(test_evaluator unit test_evaluator.c stand_in.c small_problem.c)
cz_test(test_refusals unit test_refusals.c stand_in.c small_problem.c)
cz_test(test_sweep unit test_sweep.c)
cz_test(test_explain unit test_explain.c)
