cz_test(test_strategy optimise test_strategy.c)
