/* Explanations: their statements are checked against runs and sweeps of the same problem. */
#include "support/check.h"

#include "evaluate/explained_problem.h"
#include "crushzone/sweep.h"

static const char file[] = "problems/two-cars-25kmh.yaml";

/* The file with settings, up to 0.5 s: all events but the stop of rolling cars are before. */
static Case begin(const char *over) {
    Case made = {0};
    CzError error = {0};
    char text[512];
    const int n =
        snprintf(text, sizeof text,
                 "extends: two-cars-25kmh.yaml\nsimulation: {duration_ms: 500}\n%s\n", over);
    assert_int_equal(
        cz_problem_read_text(text, (size_t)n, "over.yaml", "problems", NULL, &made.problem, &error),
        CZ_OK);
    assert_int_equal(cz_evaluator_build(made.problem, NULL, &made.evaluator, &error), CZ_OK);
    const CzStatus status = cz_explain(made.evaluator, NULL, &made.explanation, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    return made;
}

/* One explanation serves all tests of an override. */
static Case climb;

static int make_climb(void **state) {
    (void)state;
    climb = begin("trains: [{name: A, speed_km_h: 45}]");
    return 0;
}

static int free_climb(void **state) {
    (void)state;
    end(&climb);
    return 0;
}

static const CzCandidateChange *lever_of(const CzExplanation *explanation, const char *name) {
    for (int i = 0; i < explanation->n_candidate; i++)
        if (strcmp(explanation->candidate[i].name, name) == 0)
            return &explanation->candidate[i];
    fail_msg("no candidate '%s'", name);
    return NULL;
}

/* Whether no vehicle climbs at a height of the links, by a sweep over the file's own path. */
static bool holds_with_link_height(double height) {
    static const char *const set[] = {"trains.A.speed_km_h=45", "simulation.duration_ms=500"};
    CzProblemOptions problem_options = cz_problem_options_default();
    problem_options.set = set;
    problem_options.n_set = 2;
    const CzSweepAxis axis = {
        .path = "parts.bogie.link.height_mm", .from = height, .to = height, .n = 2};
    CzSweepOptions options = cz_sweep_options_default();
    options.n_axis = 1;
    options.axis = &axis;
    static const char *const check[] = {"override"};
    options.n_check = 1;
    options.check = check;
    CzSweep *sweep = NULL;
    CzError error = {0};
    assert_int_equal(cz_sweep(file, &problem_options, &options, &sweep, &error), CZ_OK);
    const bool holds = sweep->point[0].verdict == CZ_VERDICT_PASS;
    cz_sweep_free(sweep);
    return holds;
}

static void the_change_that_restores_the_margin_does_so_in_the_file(void **state) {
    (void)state;
    assert_true(climb.explanation->climbed);
    assert_int_equal(climb.explanation->verdict, CZ_VERDICT_FAIL);
    assert_true(climb.explanation->worst.margin < 0);
    const CzCandidateChange *candidate =
        lever_of(climb.explanation, "height of the traction links");
    assert_true(candidate->turns);
    assert_true(candidate->margin >= 0);
    assert_true(holds_with_link_height(candidate->needed));
    /* One step of the search closer to the value of the file the vehicle still climbs. */
    assert_true(fabs(candidate->not_yet) < fabs(candidate->change));
    assert_false(holds_with_link_height(candidate->value * (1 + candidate->not_yet)));
}

static void candidate_changes_are_in_order(void **state) {
    (void)state;
    const CzExplanation *explanation = climb.explanation;
    assert_true(explanation->n_candidate > 10);
    for (int i = 1; i < explanation->n_candidate; i++) {
        const CzCandidateChange *before = &explanation->candidate[i - 1],
                                *candidate = &explanation->candidate[i];
        assert_true(before->turns || !candidate->turns);
        if (candidate->turns)
            assert_true(fabs(log1p(before->change)) <= fabs(log1p(candidate->change)));
        else if (!before->turns)
            assert_true(before->margin >= candidate->margin);
        assert_true(candidate->margin >= explanation->worst.margin);
    }
}

static void indicators_are_from_before_the_override(void **state) {
    (void)state;
    bool bottoms = false;
    for (int i = 0; i < climb.explanation->n_indicator; i++) {
        const CzIndicator *indicator = &climb.explanation->indicator[i];
        assert_false(indicator->time > climb.explanation->climb_time);
        bottoms |= indicator->cause == CZ_CAUSE_BOTTOMING;
    }
    assert_true(bottoms);
}

static void a_satisfied_limit_gets_the_change_that_violates_it(void **state) {
    (void)state;
    Case made = begin("title: as it is");
    assert_false(made.explanation->climbed);
    assert_true(made.explanation->worst.margin >= 0);
    assert_true(made.explanation->candidate[0].turns);
    assert_true(made.explanation->candidate[0].margin < 0);
    end(&made);
}

static void a_vehicle_without_stops_is_not_checked(void **state) {
    (void)state;
    Case made = begin("parts: {paper-car: {bogie: {secondary: {lift_gap_mm: null}}}}");
    assert_int_equal(made.explanation->verdict, CZ_VERDICT_NOT_CHECKED);
    assert_non_null(made.explanation->worst.why);
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_change_that_restores_the_margin_does_so_in_the_file),
        cmocka_unit_test(candidate_changes_are_in_order),
        cmocka_unit_test(indicators_are_from_before_the_override),
        cmocka_unit_test(a_satisfied_limit_gets_the_change_that_violates_it),
        cmocka_unit_test(a_vehicle_without_stops_is_not_checked),
    };
    return cmocka_run_group_tests(tests, make_climb, free_climb);
}
