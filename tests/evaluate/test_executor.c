/* Executors: every task of a batch once, the first failure, and the same bits wherever tasks run.
 */
#include "support/check.h"

#include "crushzone/sample.h"
#include "base/error.h"
#include "evaluate/tasks.h"
#include "small_problem.h"

enum { N_TASK = 100 };

static CzStatus count(int index, void *data, CzError *error) {
    int *n_run = data;
    n_run[index]++;
    return index == 70 || index == 40 ? cz_fail(error, CZ_STATUS_NO_MEMORY, "task %d", index)
                                      : CZ_OK;
}

/* An executor of a user: the last task comes first. */
static CzStatus take_nothing(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    (void)executor;
    (void)tasks;
    (void)error;
    return CZ_OK;
}

static CzStatus run_backwards(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    (void)error;
    for (int task = cz_tasks_n(tasks) - 1; task >= 0; task--)
        cz_task_run(tasks, task);
    *(int *)executor->data += cz_tasks_n(tasks);
    return CZ_OK;
}

static CzStatus break_down(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    (void)executor;
    (void)tasks;
    return cz_fail(error, CZ_STATUS_RUN_FAILED, "no place is left");
}

static void every_task_is_run_once_and_the_first_failure_is_returned(void **state) {
    (void)state;
    int n_backwards = 0;
    const CzExecutor executor[] = {
        cz_executor_none(),
        cz_executor_threads(3),
        {.n_place = 1, .submit = take_nothing, .wait = run_backwards, .data = &n_backwards}};
    for (int e = 0; e < 3; e++) {
        int n_run[N_TASK] = {0};
        CzError error = {0};
        assert_int_equal(cz_tasks_run(&executor[e], N_TASK, count, n_run, &error),
                         CZ_STATUS_NO_MEMORY);
        assert_string_equal(error.message, "task 40");
        for (int i = 0; i < N_TASK; i++)
            assert_int_equal(n_run[i], 1);
    }
    assert_int_equal(n_backwards, N_TASK);
}

static void a_failure_of_the_executor_is_returned(void **state) {
    (void)state;
    int n_run[N_TASK] = {0};
    CzError error = {0};
    const CzExecutor refuses = {.n_place = 1, .submit = break_down, .wait = run_backwards};
    const CzExecutor breaks = {.n_place = 1, .submit = take_nothing, .wait = break_down};
    assert_int_equal(cz_tasks_run(&refuses, N_TASK, count, n_run, &error), CZ_STATUS_RUN_FAILED);
    assert_int_equal(cz_tasks_run(&breaks, N_TASK, count, n_run, &error), CZ_STATUS_RUN_FAILED);
    assert_string_equal(error.message, "no place is left");
    assert_int_equal(n_run[0], 0);
}

static const char scatter[] =
    "uncertainty:\n"
    "  samples: 20\n"
    "  parameters:\n"
    "    - {name: tube, path: 'parts.tube.stages[*].force_kN', tolerance_percent: 10}\n";

/* Margins of the samples, which the caller frees with the sampling. */
static CzSampling *sample_with(const CzProblem *problem, const CzExecutor *executor) {
    CzSampleOptions options = cz_sample_options_default();
    CzSampling *sampling = NULL;
    options.executor = executor;
    assert_int_equal(cz_sample_problem(problem, &options, &sampling, NULL), CZ_OK);
    return sampling;
}

static void an_executor_of_the_user_changes_no_bit(void **state) {
    (void)state;
    int n_backwards = 0;
    const CzExecutor none = cz_executor_none(), threads = cz_executor_threads(2);
    const CzExecutor own = {
        .n_place = 5, .submit = take_nothing, .wait = run_backwards, .data = &n_backwards};
    const CzExecutor *const executor[] = {&none, &threads, &own};
    CzProblem *problem = small_problem(scatter);
    CzSampling *sampling[3];
    for (int e = 0; e < 3; e++)
        sampling[e] = sample_with(problem, executor[e]);
    const size_t n = (size_t)sampling[0]->n_sample * (size_t)sampling[0]->n_check;
    assert_true(n > 0 && n_backwards >= 5);
    for (int e = 1; e < 3; e++)
        assert_memory_equal(sampling[0]->margin, sampling[e]->margin, n * sizeof(double));
    for (int e = 0; e < 3; e++)
        cz_sampling_free(sampling[e]);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_task_is_run_once_and_the_first_failure_is_returned),
        cmocka_unit_test(a_failure_of_the_executor_is_returned),
        cmocka_unit_test(an_executor_of_the_user_changes_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
