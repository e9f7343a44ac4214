cz_test(test_track physics test_track.c tests/physics/rails.c)
cz_test(test_baseline unit test_baseline.c)
cz_tests(physics)
