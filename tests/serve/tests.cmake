cz_test(test_serve unit test_serve.c tests/evaluate/small_problem.c)
target_link_libraries(test_serve PRIVATE PkgConfig::JANSSON)
cz_test(test_dakota unit test_dakota.c)
