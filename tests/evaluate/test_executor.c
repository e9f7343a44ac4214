/* Executors: every task of a batch once, the first failure, and the same bits wherever tasks run.
 */
#include "support/check.h"

#include "crushzone/challenge.h"
#include "crushzone/sample.h"
#include "base/error.h"
#include "evaluate/tasks.h"
#include "problem/varying.h"
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

/* ---- workers --------------------------------------------------------------------------------- */

enum { N_WORKER = 2 };

/* An executor that sends its tasks to workers of this process, in turn; every third is run without
 * them. */
typedef struct Loop {
    CzWorker *worker[N_WORKER];
    int n_message, n_answer;
    bool cuts_messages, cuts_requests; /* breaks them off in the middle */
} Loop;

static CzStatus broadcast_to_workers(const CzExecutor *executor, const CzBytes *message,
                                     CzError *error) {
    Loop *loop = executor->data;
    const CzBytes sent = {loop->cuts_messages ? message->n / 2 : message->n, message->byte};
    (void)error;
    for (int w = 0; w < N_WORKER; w++)
        cz_worker_receive(loop->worker[w], &sent);
    loop->n_message++;
    return CZ_OK;
}

static CzStatus ask_workers(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    Loop *loop = executor->data;
    (void)error;
    for (int task = cz_tasks_n(tasks) - 1; task >= 0; task--) {
        CzBytes request, answer;
        if (task % 3 == 2 || !cz_task_request(tasks, task, &request)) {
            if (task % 3 == 2 && cz_task_request(tasks, task, &request))
                cz_bytes_free(&request);
            cz_task_run(tasks, task);
            continue;
        }
        if (loop->cuts_requests)
            request.n -= 9;
        assert_int_equal(cz_worker_answer(loop->worker[task % N_WORKER], &request, &answer), CZ_OK);
        cz_task_take(tasks, task, &answer);
        cz_bytes_free(&request);
        cz_bytes_free(&answer);
        loop->n_answer++;
    }
    return CZ_OK;
}

static CzExecutor begin_loop(Loop *loop) {
    *loop = (Loop){0};
    for (int w = 0; w < N_WORKER; w++)
        loop->worker[w] = cz_worker_create();
    return (CzExecutor){.n_place = 3,
                        .submit = take_nothing,
                        .wait = ask_workers,
                        .broadcast = broadcast_to_workers,
                        .data = loop};
}

/* Every study was begun and ended, and its tasks went to the workers. */
static void end_loop(Loop *loop) {
    assert_true(loop->n_message > 0 && loop->n_message % 2 == 0);
    assert_true(loop->n_answer > 0);
    for (int w = 0; w < N_WORKER; w++)
        cz_worker_free(loop->worker[w]);
}

/* Two limits read the pulses of the vehicles, which runs of a search keep on request. */
static const char scatter[] =
    "checks:\n"
    "  limits:\n"
    "    - {name: impact, metric: vehicles.siv_m_s(gap_m=0.4), max: 12}\n"
    "    - {name: sequence, metric: elements.anti-climber *.early_share, max: 1}\n"
    "optimise:\n"
    "  variables:\n"
    "    - {path: 'parts.tube.stages[0].force_kN', min: 400, max: 1500}\n"
    "    - {path: 'parts.anti-climber.stages[0].force_kN', min: 100, max: 900, increment: 50}\n"
    "uncertainty:\n"
    "  samples: 20\n"
    "  parameters:\n"
    "    - {name: tube, path: 'parts.*.stages[*].force_kN', tolerance_percent: 10, group: part}\n"
    "    - {name: speed, path: scenario.speed_km_h, tolerance_percent: 3}\n"
    "  envelope:\n"
    "    - {path: scenario.height_offset_mm, min: -40, max: 40}\n";

static CzSampling *sample_with(const CzProblem *problem, const CzExecutor *executor) {
    CzSampleOptions options = cz_sample_options_default();
    CzSampling *sampling = NULL;
    options.executor = executor;
    assert_int_equal(cz_sample_problem(problem, &options, &sampling, NULL), CZ_OK);
    return sampling;
}

static void samples_are_the_same_bits_with_every_executor(void **state) {
    (void)state;
    int n_backwards = 0;
    Loop loop;
    const CzExecutor executor[] = {
        cz_executor_none(),
        cz_executor_threads(2),
        begin_loop(&loop),
        {.n_place = 5, .submit = take_nothing, .wait = run_backwards, .data = &n_backwards}};
    CzProblem *problem = small_problem(scatter);
    CzSampling *sampling[4];
    for (int e = 0; e < 4; e++)
        sampling[e] = sample_with(problem, &executor[e]);
    const size_t n = (size_t)sampling[0]->n_sample * (size_t)sampling[0]->n_check;
    assert_true(n > 0 && n_backwards >= 5);
    for (int e = 1; e < 4; e++) {
        assert_memory_equal(sampling[0]->margin, sampling[e]->margin, n * sizeof(double));
        assert_memory_equal(sampling[0]->verdict, sampling[e]->verdict, n * sizeof(CzVerdict));
        for (int k = 0; k < sampling[0]->n_sample; k++)
            assert_int_equal(sampling[0]->sample[k].check, sampling[e]->sample[k].check);
    }
    for (int e = 0; e < 4; e++)
        cz_sampling_free(sampling[e]);
    cz_problem_free(problem);
    end_loop(&loop);
}

static CzChallenge *challenge_with(const CzProblem *problem, const CzExecutor *executor) {
    CzChallengeOptions options = cz_challenge_options_default();
    CzChallenge *challenge = NULL;
    options.executor = executor;
    options.n_run = 60;
    assert_int_equal(cz_challenge(problem, NULL, &options, &challenge, NULL), CZ_OK);
    return challenge;
}

static void a_challenge_is_the_same_bits_with_workers(void **state) {
    (void)state;
    Loop loop;
    const CzExecutor none = cz_executor_none(), workers = begin_loop(&loop);
    CzProblem *problem = small_problem(scatter);
    CzChallenge *here = challenge_with(problem, &none), *there = challenge_with(problem, &workers);
    assert_int_equal(here->n_point, there->n_point);
    const size_t n = (size_t)here->n_point;
    assert_memory_equal(here->value, there->value, n * (size_t)here->n_draw * sizeof(double));
    assert_memory_equal(here->margin, there->margin, n * (size_t)here->n_check * sizeof(double));
    for (size_t i = 0; i < n; i++)
        assert_string_equal(here->point[i].phase, there->point[i].phase);
    assert_int_equal(here->n_weak, there->n_weak);
    assert_true(here->n_weak > 0);
    for (int i = 0; i < here->n_weak; i++) {
        const CzCheckResult *a = &here->weak[i].check, *b = &there->weak[i].check;
        assert_true(a->margin == b->margin || (isnan(a->margin) && isnan(b->margin)));
        assert_true(a->name == NULL ? b->name == NULL : strcmp(a->name, b->name) == 0);
        assert_true(a->unit == NULL ? b->unit == NULL : strcmp(a->unit, b->unit) == 0);
    }
    cz_challenge_free(here);
    cz_challenge_free(there);
    cz_problem_free(problem);
    end_loop(&loop);
}

/* Designs of a search by two evaluators, compared in all values. */
static void compare_designs(CzEvaluator *here, CzEvaluator *there) {
    enum { N_DESIGN = 5, N_VARIABLE = 2 };
    const double x[N_DESIGN * N_VARIABLE] = {500, 200, 600, 300, 700, 400, 900, 800, 1200, 150};
    CzEvaluation a[N_DESIGN], b[N_DESIGN];
    CzError error = {0};
    assert_int_equal(cz_evaluate(here, N_DESIGN, x, true, a, &error), CZ_OK);
    assert_int_equal(cz_evaluate(there, N_DESIGN, x, true, b, &error), CZ_OK);
    for (int i = 0; i < N_DESIGN; i++) {
        assert_true(a[i].objective == b[i].objective && a[i].violation == b[i].violation);
        assert_memory_equal(a[i].constraint, b[i].constraint,
                            (size_t)a[i].n_constraint * sizeof(double));
        assert_int_equal(a[i].n_run, b[i].n_run);
        for (int r = 0; r < a[i].n_run; r++) {
            const CzRunSummary *mine = cz_run_summary(a[i].run[r]);
            const CzRunSummary *other = cz_run_summary(b[i].run[r]);
            assert_string_equal(mine->scenario, other->scenario);
            assert_int_equal(mine->n_event, other->n_event);
            assert_memory_equal(&mine->energy, &other->energy, sizeof mine->energy);
            for (int v = 0; v < mine->n_vehicle; v++) {
                const CzPulse *p = &mine->pulse[v], *q = &other->pulse[v];
                assert_int_equal(p->n_sample, q->n_sample);
                assert_memory_equal(p->speed, q->speed, (size_t)p->n_sample * sizeof(double));
                assert_memory_equal(p->force, q->force, (size_t)p->n_sample * sizeof(double));
                assert_int_equal(p->n_window, q->n_window);
                assert_memory_equal(p->window, q->window, (size_t)p->n_window * sizeof *p->window);
            }
            assert_int_equal(cz_run_n_sample(a[i].run[r]), cz_run_n_sample(b[i].run[r]));
            assert_memory_equal(cz_run_channel(a[i].run[r], CZ_CHANNEL_INTERFACE_FORCE, 0),
                                cz_run_channel(b[i].run[r], CZ_CHANNEL_INTERFACE_FORCE, 0),
                                (size_t)cz_run_n_sample(a[i].run[r]) * sizeof(double));
        }
        cz_evaluation_free(&a[i]);
        cz_evaluation_free(&b[i]);
    }
}

static CzEvaluator *evaluator_with(const CzProblem *problem, const CzExecutor *executor,
                                   const CzAim *aim) {
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CzEvaluator *evaluator = NULL;
    options.executor = executor;
    options.aim = aim;
    assert_int_equal(cz_evaluator_build(problem, &options, &evaluator, NULL), CZ_OK);
    return evaluator;
}

/* The problem as written, with cases that were added, as a search against scatter has them, with
 * variables, as an explanation has them, and with settings. */
static void runs_are_the_same_bits_with_workers(void **state) {
    (void)state;
    Loop loop;
    const CzExecutor none = cz_executor_none(), workers = begin_loop(&loop);
    const CzAim aim = {.minimise = "design.installed_length_mm",
                       .margin = NAN,
                       .bounded = "interfaces.peak_force_kN",
                       .bound = 1500};
    const char *const path[] = {"parts.tube.stages[0].force_kN"}, *const value[] = {"700.1"};
    const CzCaseChange change[] = {{"parts.anti-climber.stages[0].force_kN", CZ_CASE_FACTOR, 1.07},
                                   {"scenario.speed_km_h", CZ_CASE_ADD, 0.3}};
    const CzCase cases[] = {{.name = "more", .scenario = 1, .n_change = 2, .change = change}};
    const CzVaryingNumber varying[] = {
        {"parts.tube.stages[0].force_kN", .value = 800, .min = 1, .max = 2000, .size = 700.1},
        {"parts.anti-climber.stages[0].force_kN", .value = 300, .min = 1, .max = 900, .size = 600}};
    CzProblem *step[4] = {small_problem(scatter), NULL, NULL, NULL};
    assert_int_equal(cz_problem_read_cases(step[0], 1, cases, &step[1], NULL), CZ_OK);
    assert_int_equal(cz_problem_read_varying(step[0], 2, varying, &step[2], NULL), CZ_OK);
    assert_int_equal(cz_problem_read_again(step[0], 1, path, value, &step[3], NULL), CZ_OK);
    for (int i = 0; i < 3; i++)
        for (int with_aim = 0; with_aim < 2; with_aim++) {
            const CzAim *own = with_aim ? &aim : NULL;
            const int n_answer = loop.n_answer;
            CzEvaluator *here = evaluator_with(step[i], &none, own);
            CzEvaluator *there = evaluator_with(step[i], &workers, own);
            compare_designs(here, there);
            assert_true(loop.n_answer > n_answer);
            cz_evaluator_free(here);
            cz_evaluator_free(there);
        }
    CzSampling *here = sample_with(step[3], &none), *there = sample_with(step[3], &workers);
    assert_memory_equal(here->margin, there->margin,
                        (size_t)(here->n_sample * here->n_check) * sizeof(double));
    cz_sampling_free(here);
    cz_sampling_free(there);
    for (int i = 3; i >= 0; i--)
        cz_problem_free(step[i]);
    end_loop(&loop);
}

/* Samples whose values the reader refuses: the message is that of this process. */
static void a_refused_sample_has_the_message_of_its_owner(void **state) {
    (void)state;
    Loop loop;
    const CzExecutor none = cz_executor_none(), workers = begin_loop(&loop);
    CzProblem *problem = small_problem(
        "uncertainty:\n"
        "  samples: 12\n"
        "  parameters:\n"
        "    - {name: mass, path: 'trains.*.vehicles.*.mass_t', min: -20, max: 60}\n");
    CzSampling *here = sample_with(problem, &none), *there = sample_with(problem, &workers);
    int n_refused = 0;
    for (int k = 0; k < here->n_sample; k++) {
        assert_int_equal(here->sample[k].state, there->sample[k].state);
        if (here->sample[k].state != CZ_SAMPLE_INVALID)
            continue;
        assert_string_equal(here->sample[k].message, there->sample[k].message);
        n_refused++;
    }
    assert_true(n_refused > 0 && n_refused < here->n_sample);
    cz_sampling_free(here);
    cz_sampling_free(there);
    cz_problem_free(problem);
    end_loop(&loop);
}

static void a_worker_reports_what_it_cannot_read(void **state) {
    (void)state;
    Loop loop;
    const CzExecutor workers = begin_loop(&loop);
    CzProblem *problem = small_problem(scatter);
    CzSampleOptions options = cz_sample_options_default();
    CzSampling *sampling = NULL;
    CzError error = {0};
    options.executor = &workers;
    loop.cuts_requests = true;
    assert_int_not_equal(cz_sample_problem(problem, &options, &sampling, &error), CZ_OK);
    assert_true(error.message[0] != '\0');
    loop.cuts_requests = false;
    loop.cuts_messages = true;
    error = (CzError){0};
    assert_int_not_equal(cz_sample_problem(problem, &options, &sampling, &error), CZ_OK);
    assert_true(error.message[0] != '\0');
    cz_problem_free(problem);
    end_loop(&loop);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_task_is_run_once_and_the_first_failure_is_returned),
        cmocka_unit_test(a_failure_of_the_executor_is_returned),
        cmocka_unit_test(samples_are_the_same_bits_with_every_executor),
        cmocka_unit_test(a_challenge_is_the_same_bits_with_workers),
        cmocka_unit_test(runs_are_the_same_bits_with_workers),
        cmocka_unit_test(a_refused_sample_has_the_message_of_its_owner),
        cmocka_unit_test(a_worker_reports_what_it_cannot_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
