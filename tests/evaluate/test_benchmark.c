/* Times of scenarios: what is timed, and when timing ends. */
#include "support/check.h"

#include "crushzone/benchmark.h"
#include "evaluate/small_problem.h"

static CzEvaluator *begin(const CzProblem *problem, const char *scenario) {
    CzEvaluator *evaluator = NULL;
    CzError error = {0};
    CzEvaluatorOptions options = cz_evaluator_options_default();
    options.scenario = scenario;
    if (cz_evaluator_build(problem, &options, &evaluator, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return evaluator;
}

static void every_scenario_is_timed_as_often_as_requested(void **state) {
    (void)state;
    CzProblem *problem = small_problem("");
    CzEvaluator *evaluator = begin(problem, NULL);
    CzBenchmark *benchmark = NULL;
    CzError error = {0};
    CzBenchmarkOptions options = cz_benchmark_options_default();
    options.n_round = 2;
    assert_int_equal(cz_benchmark(evaluator, &options, &benchmark, &error), CZ_OK);
    assert_int_equal(benchmark->status, CZ_OK);
    assert_int_equal(benchmark->n_scenario, cz_problem_n_scenario(problem));
    for (int i = 0; i < benchmark->n_scenario; i++) {
        const CzScenarioTimes *times = &benchmark->scenario[i];
        assert_string_equal(times->scenario, cz_problem_scenario_name(problem, i));
        assert_int_equal(times->n_vehicle, 2);
        assert_true(times->n_step > 0 && times->simulated > 0.0);
        for (int timed = 0; timed < CZ_N_TIMED; timed++) {
            assert_int_equal(times->time[timed].n, 2);
            assert_true(times->time[timed].least > 0.0);
            assert_true(times->time[timed].least <= times->time[timed].median);
        }
    }
    cz_benchmark_free(benchmark);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

/* Keeps how many rounds are done, of all. */
static void count(int n_done, int n_all, void *data) {
    int *seen = data;
    seen[0] = n_done;
    seen[1] = n_all;
}

static void only_the_scenario_of_the_evaluator_is_timed(void **state) {
    (void)state;
    CzProblem *problem = small_problem("");
    CzEvaluator *evaluator = begin(problem, cz_problem_scenario_name(problem, 1));
    CzBenchmark *benchmark = NULL;
    CzError error = {0};
    int seen[2] = {0, 0};
    CzBenchmarkOptions options = cz_benchmark_options_default();
    options.progress = count;
    options.progress_data = seen;
    assert_int_equal(cz_benchmark(evaluator, &options, &benchmark, &error), CZ_OK);
    assert_int_equal(seen[0], options.n_round);
    assert_int_equal(seen[1], options.n_round);
    assert_int_equal(benchmark->n_scenario, 1);
    assert_string_equal(benchmark->scenario->scenario, cz_problem_scenario_name(problem, 1));
    cz_benchmark_free(benchmark);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

static void a_raised_flag_ends_the_benchmark(void **state) {
    (void)state;
    const volatile sig_atomic_t stop = 1;
    CzProblem *problem = small_problem("");
    CzEvaluator *evaluator = begin(problem, NULL);
    CzBenchmark *benchmark = NULL;
    CzError error = {0};
    CzBenchmarkOptions options = cz_benchmark_options_default();
    options.stop = &stop;
    assert_int_equal(cz_benchmark(evaluator, &options, &benchmark, &error), CZ_STATUS_INTERRUPTED);
    assert_null(benchmark);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scenario_is_timed_as_often_as_requested),
        cmocka_unit_test(only_the_scenario_of_the_evaluator_is_timed),
        cmocka_unit_test(a_raised_flag_ends_the_benchmark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
