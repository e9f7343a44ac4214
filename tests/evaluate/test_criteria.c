/* Criteria of standards as limits of runs: with parameters, in a search and in recorded runs. */
#include "support/check.h"

#include "evaluate/evaluator.h"
#include "evaluate/judged_problem.h"
#include "evaluate/metric.h"
#include "evaluate/small_problem.h"

static Case judge(const char *more, bool keep_runs) {
    return judged(small_problem(more), keep_runs);
}

/* A check that there is. */
static const CzCheckResult *listed(const Case *made, const char *name, const char *scenario) {
    const CzCheckResult *check = find(made, name, scenario);
    if (check == NULL)
        fail_msg("there is no check %s", name);
    return check;
}

static const char pulses[] =
    "checks: {limits: [\n"
    "  {name: siv, metric: vehicles.siv_m_s(gap_m=0.75), max: 11},\n"
    "  {name: far, metric: vehicles.A1.siv_m_s(gap_m=9), max: 11},\n"
    "  {name: usual, metric: vehicles.mean_deceleration_sliding_g, max: 5},\n"
    "  {name: 120 ms, metric: vehicles.mean_deceleration_120ms_g, max: 5},\n"
    "  {name: short, metric: vehicles.mean_deceleration_sliding_g(window_ms=40).max, max: 5},\n"
    "  {name: contact, metric: vehicles.mean_deceleration_contact_g, max: 5},\n"
    "  {name: all, metric: \"vehicles.mean_deceleration_contact_g(floor=0.02, shortest_ms=0)\", "
    "max: 5},\n"
    "  {name: filtered, metric: vehicles.peak_deceleration_cfc60_g, max: 9}]}\n";

/* Two equal cars at 25 km/h: each changes its speed by half of it. */
static void a_limit_gives_the_parameters_of_its_metric(void **state) {
    (void)state;
    Case made = judge(pulses, true);
    const double change = 25 / 3.6 / 2;
    assert_in_range((long)(1e3 * listed(&made, "far", "crash")->value), (long)(1e3 * change),
                    (long)(1.1e3 * change));
    assert_true(listed(&made, "siv", "crash")->value <= listed(&made, "far", "crash")->value);
    assert_true(listed(&made, "siv", "crash")->when[0] > 0);
    assert_near(listed(&made, "usual", "crash")->value, listed(&made, "120 ms", "crash")->value, 0,
                0);
    assert_true(listed(&made, "short", "crash")->value > listed(&made, "usual", "crash")->value);
    assert_true(listed(&made, "all", "crash")->value >= listed(&made, "contact", "crash")->value);
    assert_true(listed(&made, "filtered", "crash")->value > listed(&made, "short", "crash")->value);
    end(&made);
}

/* Runs that record nothing keep pulses only when a metric reads them. */
static void values_are_the_same_without_a_recording(void **state) {
    (void)state;
    Case recorded = judge(pulses, true), bare = judge(pulses, false);
    assert_int_equal(recorded.evaluation.n_check, bare.evaluation.n_check);
    for (int i = 0; i < bare.evaluation.n_check; i++) {
        const double value = recorded.evaluation.check[i].value;
        assert_int_equal(isnan(value), isnan(bare.evaluation.check[i].value));
        if (!isnan(value))
            assert_near(bare.evaluation.check[i].value, value, 0, 0);
    }
    end(&recorded);
    end(&bare);
}

static void a_search_has_values_of_pulses_as_objective_and_constraint(void **state) {
    (void)state;
    Case made = judge("checks: {limits: [{name: siv, metric: vehicles.siv_m_s(gap_m=0.6), max: "
                      "11}]}\n"
                      "optimise:\n"
                      "  minimise: vehicles.peak_deceleration_cfc60_g\n"
                      "  subject_to: [siv]\n"
                      "  variables: [{path: \"parts.tube.stages[0].force_kN\", min: 400, max: "
                      "1200}]\n",
                      false);
    const double x[] = {500, 1000};
    CzEvaluation evaluation[2];
    CzError error = {0};
    assert_int_equal(cz_evaluator_search(made.evaluator, 2, x, evaluation, NULL, &error), CZ_OK);
    for (int i = 0; i < 2; i++) {
        assert_true(isfinite(evaluation[i].objective) && isfinite(evaluation[i].constraint[0]));
        cz_evaluation_free(&evaluation[i]);
    }
    end(&made);
}

/* Largest value of a metric over all scenarios with some settings, NULL at the end. */
#define VALUE(metric, ...) value_with(metric, (const char *const[]){__VA_ARGS__, NULL})
static double value_with(const char *metric, const char *const *set) {
    char more[256];
    snprintf(more, sizeof more, "checks: {limits: [{name: it, metric: \"%s\", max: 1e9}]}\n",
             metric);
    CzProblem *problem = NULL;
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation;
    CzError error = {0};
    int n_set = 0;
    while (set[n_set] != NULL)
        n_set++;
    if (small_problem_read(more, n_set, set, &problem, &error) != CZ_OK ||
        cz_evaluator_build(problem, NULL, &evaluator, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, false, &evaluation, &error), CZ_OK);
    double value = NAN;
    for (int i = 0; i < evaluation.n_check; i++)
        if (strcmp(evaluation.check[i].name, "it") == 0)
            value = fmax(value, evaluation.check[i].value); /* ignores NaN */
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return value;
}

/* Buffer 400 kN, tube 800 kN, shear-off 1300 kN, two anti-climbers of 300 kN, end 3000 kN in
 * survival space, strength 1650 kN. */
static void the_force_ladder_has_the_ratio_of_each_step(void **state) {
    (void)state;
    assert_near(VALUE("ends.buffer_over_tube", NULL), 400.0 / 800, ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE("ends.tube_over_shear_off", NULL), 800.0 / 1300, ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE("ends.shear_off_over_strength", NULL), 1300.0 / 1650, ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE("ends.anti_climber_over_end", NULL), 600.0 / 3000, ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE("ends.end_over_strength", NULL), 0, 0, 0); /* it has no crush zone */
    assert_near(VALUE("ends.force_ladder", NULL), 1300.0 / 1650, ROUNDING_OF_A_SUM, 0);
}

static void the_worst_step_of_the_force_ladder_counts(void **state) {
    (void)state;
    assert_near(VALUE("ends.force_ladder", "parts.head.coupler.buffer.stages[0].force_kN=760"),
                760.0 / 800, ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE("ends.force_ladder", "parts.tube.stages[0].force_kN=1250"), 1250.0 / 1300,
                ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE("ends.force_ladder", "parts.anti-climber.stages[0].force_kN=1450"),
                2900.0 / 3000, ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE("ends.force_ladder", "parts.head.stages[0].zone=crush"), 3000.0 / 1650,
                ROUNDING_OF_A_SUM, 0);
}

/* Without crushing the ends carry the force of the shear-off, 1300 kN, at most. */
static void an_interface_is_judged_by_the_strength_of_its_ends(void **state) {
    (void)state;
    const double peak = VALUE("interfaces.peak_force_kN", NULL);
    assert_true(peak >= 1300);
    assert_near(VALUE("interfaces.force_share", NULL), peak / 1650, ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE("interfaces.colliding.force_share", NULL), peak / 1650, ROUNDING_OF_A_SUM, 0);
}

/* The end of the small problem crushes by 5 mm and more in its only stage. */
static void temporarily_occupied_space_is_judged_by_its_length(void **state) {
    (void)state;
    static const char share[] = "sections.temporary_share",
                      zone[] = "parts.head.stages[0].zone=temporary";
    const char *const weak = "parts.head.stages[0].force_MN=0.2";
    assert_near(VALUE("sections.temporary_shortening_mm", zone, weak), 5, ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE(share, zone, weak, "parts.head.temporary_length_mm=20"), 0.25,
                ROUNDING_OF_A_SUM, 0);
    assert_near(VALUE(share, weak), 0, 0, 0); /* no stage of the zone */
    assert_near(VALUE("sections.temporary_shortening_mm", weak), 0, 0, 0);
}

/* A subject with one vehicle, 20 m long with 2.5 m in front of the survival space at each end. */
static double loss_of(double rear, double front, double length, const char *text) {
    const CzEnd end = {.given = true, .available_length = 2.5};
    CzVehicle record = {
        .name = "A1", .model = CZ_MODEL_FULL, .length = length, .front = end, .rear = end};
    CzVehicleResult vehicle = {.name = "A1", .survival_loss = {rear, front}};
    vehicle.survival_shortening = (isnan(rear) ? 0 : rear) + (isnan(front) ? 0 : front);
    const CzVehicle *vehicles = &record;
    const int own = 0;
    const CzScene scene = {.n_vehicle = 1, .vehicle = &vehicles, .record = &own};
    const CzRunSummary run = {.n_vehicle = 1, .vehicle = &vehicle};
    const CzSubject subject = {.scene = &scene, .run = &run, .vehicles = &record, .n_vehicle = 1};
    CzMetric metric;
    assert_int_equal(cz_metric_parse(text, &metric, NULL), CZ_OK);
    return cz_metric_value(&metric, &subject, true).value;
}

/* The limit of 50 mm holds within any 5 m: one end counts in a long space, both count in one of at
 * most 5 m, and a space of 4 m may lose 40 mm. */
static void a_loss_of_survival_space_is_scaled_to_the_length_of_the_stretch(void **state) {
    (void)state;
    static const char in_5_m[] = "vehicles.survival_loss_mm";
    assert_near(loss_of(0.030, 0.040, 20, in_5_m), 40, ROUNDING_OF_A_SUM, 0);
    assert_near(loss_of(0.030, 0.040, 10, in_5_m), 70, ROUNDING_OF_A_SUM, 0);
    assert_near(loss_of(0, 0.040, 9, in_5_m), 50, ROUNDING_OF_A_SUM, 0);
    assert_near(loss_of(NAN, 0.040, 20, in_5_m), 40, ROUNDING_OF_A_SUM, 0);
    assert_near(loss_of(0.030, 0.040, NAN, in_5_m), 70, ROUNDING_OF_A_SUM,
                0); /* the length is not given */
    assert_near(loss_of(0.030, 0.0457, 20, "vehicles.survival_loss_share(over_m=4.572)"),
                0.0457 / 4.572, ROUNDING_OF_A_SUM, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_gives_the_parameters_of_its_metric),
        cmocka_unit_test(values_are_the_same_without_a_recording),
        cmocka_unit_test(the_force_ladder_has_the_ratio_of_each_step),
        cmocka_unit_test(the_worst_step_of_the_force_ladder_counts),
        cmocka_unit_test(an_interface_is_judged_by_the_strength_of_its_ends),
        cmocka_unit_test(temporarily_occupied_space_is_judged_by_its_length),
        cmocka_unit_test(a_loss_of_survival_space_is_scaled_to_the_length_of_the_stretch),
        cmocka_unit_test(a_search_has_values_of_pulses_as_objective_and_constraint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
