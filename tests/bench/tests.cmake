# Times per step as JSON: `build/<preset>/tests/bench` from the project's root. The test only checks that it runs.
if(CZ_IS_WHOLE)
    add_executable(bench ${CMAKE_CURRENT_LIST_DIR}/bench.c)
    target_compile_definitions(bench PRIVATE CZ_VERSION="${PROJECT_VERSION}")
    target_link_libraries(bench PRIVATE cz_static)
    cz_build_for(bench bench)
    cz_script(bench_runs bench bench.sh)
endif()
