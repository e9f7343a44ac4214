cz_test(test_solvers physics test_solvers.c)
