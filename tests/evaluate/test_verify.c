/* Verification: compared values, passes and failures. */
#include "support/check.h"

#include "crushzone/verify.h"
#include "evaluate/small_problem.h"

typedef struct Case {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzVerification *verification;
} Case;

static Case begin_with(const char *more, int n_set, const char *const *set) {
    Case made = {0};
    CzError error = {0};
    if (small_problem_read(more, n_set, set, &made.problem, &error) != CZ_OK)
        fail_msg("%s", error.message);
    const CzEvaluatorOptions options = cz_evaluator_options_default();
    if (cz_evaluator_build(made.problem, &options, &made.evaluator, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return made;
}

static Case begin(const char *more) {
    return begin_with(more, 0, NULL);
}

static void verify(Case *made, const CzVerifyOptions *options) {
    CzError error = {0};
    cz_verification_free(made->verification);
    if (cz_verify(made->evaluator, NULL, NULL, options, &made->verification, &error) != CZ_OK)
        fail_msg("%s", error.message);
}

static void end(Case *made) {
    cz_verification_free(made->verification);
    cz_evaluator_free(made->evaluator);
    cz_problem_free(made->problem);
}

static const CzVerifiedValue *value_of(const CzVerification *verification, const char *name,
                                       const char *scenario) {
    for (int i = 0; i < verification->n_value; i++)
        if (strcmp(verification->value[i].name, name) == 0 &&
            strcmp(verification->value[i].scenario, scenario) == 0)
            return &verification->value[i];
    fail_msg("no value '%s' in '%s'", name, scenario);
    return NULL;
}

static const char limits[] = "checks:\n"
                             "  design_rules: false\n"
                             "  limits:\n"
                             "    - {name: closure, metric: interfaces.shortening_mm, max: 3000}\n";

/* Rigid cars: all three methods agree to much better than 1 %. */
static void numbers_that_do_not_depend_on_step_and_solver_pass(void **state) {
    (void)state;
    Case made = begin(limits);
    verify(&made, NULL);
    const CzVerification *verification = made.verification;
    assert_int_equal(verification->verdict, CZ_VERDICT_PASS);
    assert_int_equal(verification->status, CZ_OK);
    assert_false(verification->is_done[CZ_METHOD_TRACK]); /* the track is rigid both ways */
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
        if (method == CZ_METHOD_TRACK)
            continue;
        assert_true(verification->is_done[method]);
        assert_int_equal(verification->n_flip[method], 0);
        assert_true(verification->largest_change[method] > 0.0);
        assert_true(verification->largest_change[method] < 0.01);
    }
    end(&made);
}

/* A check changes by its margin, so by the share of its limit; the bulk of a scenario by its own
 * size; the largest change is that of all values. */
static void changes_are_relative_to_the_limit(void **state) {
    (void)state;
    Case made = begin(limits);
    verify(&made, NULL);
    const CzVerification *verification = made.verification;
    const CzVerifiedValue *closure = value_of(verification, "closure", "crash");
    const CzVerifiedValue *bulk = value_of(verification, "largest closure", "crash");
    assert_near(closure->production, bulk->production, 1e-12, 0.0);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++) {
        if (method == CZ_METHOD_TRACK)
            continue;
        const double difference = fabs(closure->value[method] - closure->production);
        assert_near(closure->change[method], difference / 3000.0, 1e-9, 1e-15);
        assert_near(bulk->change[method], difference / bulk->production, 1e-9, 1e-15);
        double largest = 0.0;
        for (int i = 0; i < verification->n_value; i++)
            largest = fmax(largest, verification->value[i].change[method]);
        assert_near(verification->largest_change[method], largest, 0.0, 0.0);
        assert_near(verification->value[verification->worst[method]].change[method], largest, 0.0,
                    0.0);
    }
    end(&made);
}

/* A limit of zero, taken as 1 mm, is exceeded by a whole closure: the change is taken over the
 * excess. */
static void changes_of_a_limit_exceeded_many_times_are_relative_to_the_excess(void **state) {
    (void)state;
    Case made = begin("checks:\n"
                      "  design_rules: false\n"
                      "  limits: [{name: closure, metric: interfaces.shortening_mm, max: 1}]\n");
    CzVerifyOptions options = cz_verify_options_default();
    options.methods = 1u << CZ_METHOD_HALF_STEP;
    verify(&made, &options);
    const CzVerifiedValue *closure = value_of(made.verification, "closure", "crash");
    const double difference = fabs(closure->value[CZ_METHOD_HALF_STEP] - closure->production);
    assert_true(difference > 0.0 && closure->production > 100.0);
    assert_near(closure->change[CZ_METHOD_HALF_STEP], difference / (closure->production - 1.0),
                1e-9, 1e-15);
    assert_int_equal(made.verification->verdict, CZ_VERDICT_PASS);
    end(&made);
}

static void a_change_beyond_the_limit_does_not_pass(void **state) {
    (void)state;
    Case made = begin(limits);
    CzVerifyOptions options = cz_verify_options_default();
    options.limit = 1e-12;
    verify(&made, &options);
    assert_int_equal(made.verification->verdict, CZ_VERDICT_FAIL);
    end(&made);
}

/* A limit between the production run's closure and that of a halved time step: the verdict depends
 * on the step, however small the change. */
static void a_verdict_that_flips_does_not_pass(void **state) {
    (void)state;
    Case made = begin(limits);
    CzVerifyOptions options = cz_verify_options_default();
    options.methods = 1u << CZ_METHOD_HALF_STEP;
    verify(&made, &options);
    const CzVerifiedValue *closure = value_of(made.verification, "closure", "crash");
    const double between = 0.5 * (closure->production + closure->value[CZ_METHOD_HALF_STEP]);
    assert_true(closure->production != closure->value[CZ_METHOD_HALF_STEP]);
    assert_int_equal(made.verification->verdict, CZ_VERDICT_PASS);
    end(&made);

    char closer[512];
    snprintf(closer, sizeof closer,
             "checks:\n"
             "  design_rules: false\n"
             "  limits:\n"
             "    - {name: closure, metric: interfaces.shortening_mm, max: %.17g}\n",
             between);
    made = begin(closer);
    verify(&made, &options);
    assert_true(value_of(made.verification, "closure", "crash")->flips[CZ_METHOD_HALF_STEP]);
    assert_int_equal(made.verification->n_flip[CZ_METHOD_HALF_STEP], 1);
    assert_true(made.verification->largest_change[CZ_METHOD_HALF_STEP] < 0.01);
    assert_int_equal(made.verification->verdict, CZ_VERDICT_FAIL);
    end(&made);
}

static void a_yes_or_no_counts_by_its_verdict_alone(void **state) {
    (void)state;
    Case made = begin("checks:\n"
                      "  design_rules: false\n"
                      "  limits:\n"
                      "    - {name: bottom, metric: elements.bottomed_out, max: 0}\n");
    verify(&made, NULL);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        assert_true(isnan(value_of(made.verification, "bottom", "crash")->change[method]));
    end(&made);
}

/* A matched value changes by the share of the measured value; the sum of squares, which may be
 * close to zero, does not count. */
static void a_fit_is_verified_by_what_it_matches(void **state) {
    (void)state;
    Case made = begin("optimise:\n"
                      "  variables:\n"
                      "    - {path: 'parts.tube.stages[0].force_kN', min: 700, max: 900}\n"
                      "  match:\n"
                      "    - {name: measured, scenario: crash, metric: interfaces.shortening_mm,\n"
                      "       value: 800, tolerance: 5}\n");
    CzVerifyOptions options = cz_verify_options_default();
    options.methods = 1u << CZ_METHOD_HALF_STEP;
    verify(&made, &options);
    const CzVerifiedValue *sum = &made.verification->value[0];
    assert_true(sum->value[CZ_METHOD_HALF_STEP] != sum->production);
    assert_true(isnan(sum->change[CZ_METHOD_HALF_STEP]));
    const CzVerifiedValue *match = value_of(made.verification, "measured", "crash");
    const double difference = fabs(match->value[CZ_METHOD_HALF_STEP] - match->production);
    assert_true(difference > 0.0);
    assert_near(match->change[CZ_METHOD_HALF_STEP], difference / 800.0, 1e-9, 0.0);
    assert_int_equal(made.verification->verdict, CZ_VERDICT_PASS);
    end(&made);
}

/* Only the requested methods are run, and only they count. */
static void methods_can_be_chosen(void **state) {
    (void)state;
    Case made = begin(limits);
    CzVerifyOptions options = cz_verify_options_default();
    options.methods = 1u << CZ_METHOD_ADAMS;
    verify(&made, &options);
    assert_int_equal(made.verification->verdict, CZ_VERDICT_PASS);
    assert_false(made.verification->is_done[CZ_METHOD_HALF_STEP]);
    assert_true(isnan(made.verification->largest_change[CZ_METHOD_ERK]));
    assert_true(made.verification->is_done[CZ_METHOD_ADAMS]);
    options.methods = 0;
    verify(&made, &options);
    assert_int_equal(made.verification->verdict, CZ_VERDICT_NOT_CHECKED);
    end(&made);
}

/* The trailing car rolls on behind one that is slowed: the closure has its final value when the
 * collision has settled, the speeds at the end of the run have not. */
static void runs_are_compared_until_they_settle_where_that_leaves_all_checks(void **state) {
    (void)state;
    static const char *const slowed = "trains.B.vehicles.B1.rolling_resistance_N_kN=50";
    static const char *const metric[] = {"interfaces.shortening_mm, max: 3000",
                                         "vehicles.final_speed_km_h, max: 100"};
    for (int later = 0; later < 2; later++) {
        char more[400];
        snprintf(more, sizeof more,
                 "checks:\n  design_rules: false\n  limits:\n    - {name: limit, metric: %s}\n",
                 metric[later]);
        Case made = begin_with(more, 1, &slowed);
        CzVerifyOptions options = cz_verify_options_default();
        options.methods = 1u << CZ_METHOD_HALF_STEP;
        options.until_settled = true;
        verify(&made, &options);
        assert_int_equal(made.verification->verdict, CZ_VERDICT_PASS);
        assert_int_equal(made.verification->until_settled, later == 0);
        end(&made);
    }
}

static void a_production_run_that_did_not_end_is_a_failure(void **state) {
    (void)state;
    Case made = begin("simulation: {longest_ms: 20}\n");
    verify(&made, NULL);
    assert_int_equal(made.verification->status, CZ_STATUS_RUN_FAILED);
    assert_int_equal(made.verification->verdict, CZ_VERDICT_FAIL);
    assert_non_null(strstr(made.verification->failure, "the production run, scenario crash"));
    end(&made);
}

static void a_raised_flag_ends_the_verification(void **state) {
    (void)state;
    Case made = begin(limits);
    const volatile sig_atomic_t stop = 1;
    CzVerifyOptions options = cz_verify_options_default();
    options.stop = &stop;
    CzError error = {0};
    assert_int_equal(cz_verify(made.evaluator, NULL, NULL, &options, &made.verification, &error),
                     CZ_STATUS_INTERRUPTED);
    assert_null(made.verification);
    end(&made);
}

static double constant(int n_scenario, const CzRunSummary *const *summary, void *data) {
    (void)n_scenario, (void)data;
    return 1e-3 * summary[0]->interface[0].peak_force;
}

static void an_objective_of_the_callers_own_is_verified_too(void **state) {
    (void)state;
    Case made = begin(limits);
    cz_evaluator_set_objective(made.evaluator, "own", "kN", constant, NULL);
    verify(&made, NULL);
    assert_string_equal(made.verification->value[0].name, "own");
    assert_string_equal(made.verification->value[0].scenario, "");
    assert_true(made.verification->value[0].production > 100.0);
    end(&made);
}

/* An executor that counts batches and tasks. */
typedef struct Counted {
    int n_batch, n_task;
} Counted;

static CzStatus take_none(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    (void)executor;
    (void)tasks;
    (void)error;
    return CZ_OK;
}

static CzStatus run_and_count(const CzExecutor *executor, CzTasks *tasks, CzError *error) {
    Counted *counted = executor->data;
    (void)error;
    for (int task = 0; task < cz_tasks_n(tasks); task++)
        cz_task_run(tasks, task);
    counted->n_batch++;
    counted->n_task += cz_tasks_n(tasks);
    return CZ_OK;
}

/* One batch has the production run, one all runs of the four methods that apply on a rigid track.
 */
static void methods_are_computed_side_by_side(void **state) {
    (void)state;
    Counted counted = {0};
    const CzExecutor executor = {
        .n_place = 8, .submit = take_none, .wait = run_and_count, .data = &counted};
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CzVerification *verification = NULL;
    CzEvaluator *evaluator = NULL;
    CzProblem *problem = small_problem(limits);
    options.executor = &executor;
    assert_int_equal(cz_evaluator_build(problem, &options, &evaluator, NULL), CZ_OK);
    assert_int_equal(cz_verify(evaluator, NULL, NULL, NULL, &verification, NULL), CZ_OK);
    assert_int_equal(counted.n_batch, 2);
    assert_true(counted.n_task > 2 * cz_problem_n_scenario(problem));
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        assert_true(method == CZ_METHOD_TRACK || verification->run_s[method] > 0);
    cz_verification_free(verification);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_that_do_not_depend_on_step_and_solver_pass),
        cmocka_unit_test(changes_are_relative_to_the_limit),
        cmocka_unit_test(changes_of_a_limit_exceeded_many_times_are_relative_to_the_excess),
        cmocka_unit_test(a_change_beyond_the_limit_does_not_pass),
        cmocka_unit_test(a_verdict_that_flips_does_not_pass),
        cmocka_unit_test(a_yes_or_no_counts_by_its_verdict_alone),
        cmocka_unit_test(a_fit_is_verified_by_what_it_matches),
        cmocka_unit_test(methods_can_be_chosen),
        cmocka_unit_test(methods_are_computed_side_by_side),
        cmocka_unit_test(runs_are_compared_until_they_settle_where_that_leaves_all_checks),
        cmocka_unit_test(a_production_run_that_did_not_end_is_a_failure),
        cmocka_unit_test(a_raised_flag_ends_the_verification),
        cmocka_unit_test(an_objective_of_the_callers_own_is_verified_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
