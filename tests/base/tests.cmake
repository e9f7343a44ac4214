cz_tests(unit)
