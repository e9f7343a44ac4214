cz_test(test_strategy optimise test_strategy.c)
cz_test(test_surface optimise test_surface.c)
cz_test(test_optimise optimise test_optimise.c tests/evaluate/stand_in.c tests/evaluate/small_problem.c)
cz_test(test_cheats optimise test_cheats.c tests/evaluate/small_problem.c)
