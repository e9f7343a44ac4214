cz_test(test_two_step physics test_two_step.c tests/physics/scheme.c)
cz_tests(physics)
