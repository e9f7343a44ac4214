/* Explained checks of small problems: time, place, carriers, states of elements, and changes whose
 * effect is compared with runs of the changed file. */
#include "support/check.h"

#include <stdbool.h>

#include "evaluate/explained_problem.h"
#include "evaluate/place.h"

/* Explains a text, all failing checks or one; returns the status. */
static CzStatus explain(const char *text, const char *check, Case *made, CzError *error) {
    CzExplainOptions options = cz_explain_options_default();
    *made = (Case){0};
    options.n_check = check != NULL;
    options.check = &check;
    const CzStatus read = cz_problem_read_text(text, strlen(text), "over.yaml", "problems", NULL,
                                               &made->problem, error);
    if (read != CZ_OK)
        print_error("%s\n", error->message);
    assert_int_equal(read, CZ_OK);
    assert_int_equal(cz_evaluator_build(made->problem, NULL, &made->evaluator, error), CZ_OK);
    return cz_explain(made->evaluator, &options, &made->explanation, error);
}

static Case explained(const char *text, const char *check) {
    Case made;
    CzError error = {0};
    const CzStatus status = explain(text, check, &made, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    return made;
}

static const CzExplainedCheck *find(const Case *made, const char *name) {
    for (int i = 0; i < made->explanation->n_check; i++)
        if (strcmp(made->explanation->check[i].check.name, name) == 0)
            return &made->explanation->check[i];
    fail_msg("'%s' is not explained", name);
    return NULL;
}

static const CzElementState *state_of(const CzExplainedCheck *check, const char *element) {
    for (int i = 0; i < check->n_state; i++)
        if (strcmp(check->state[i].element, element) == 0)
            return &check->state[i];
    fail_msg("no state of '%s'", element);
    return NULL;
}

/* Two cars up to 0.5 s: all of their events but the stop of rolling cars are before. */
#define CARS "extends: two-cars-25kmh.yaml\nsimulation: {duration_ms: 500}\n"

static double sum_of_shares(const CzExplainedCheck *check) {
    double sum = 0;
    for (int i = 0; i < check->n_carrier; i++)
        sum += check->carrier[i].share;
    return sum;
}

/* Two light trains of three cars whose inner tubes bottom out. */
#define TRAINS                                                                                     \
    "schema: 1\n"                                                                                  \
    "title: light trains\n"                                                                        \
    "catalogue: [catalogue/rigid-cars.yaml]\n"                                                     \
    "parts: {light-tube: {stages: [{stroke_mm: 60, force_kN: 700}]}}\n"                            \
    "trains:\n"                                                                                    \
    "  - name: A\n"                                                                                \
    "    speed_km_h: 22\n"                                                                         \
    "    vehicles: [{use: light-cab-car, reversed: true}, {use: light-car}, {use: "                \
    "light-cab-car}]\n"                                                                            \
    "  - {name: B, copy: A, speed_km_h: 0}\n"                                                      \
    "checks: {design_rules: false, limits: ["
#define LIMIT(name, metric, bound)                                                                 \
    "{name: " name ", metric: '" metric "', " bound ", source: test, confidence: user}"

static const char trains[] =
    TRAINS LIMIT("interface force", "interfaces.peak_force_kN", "max: 1200") ",\n" LIMIT(
        "mean deceleration", "vehicles.mean_deceleration_120ms_g",
        "max: 0.5") ",\n" LIMIT("coupler energy", "elements.coupler *.energy_kJ",
                                "max: 50") ",\n" LIMIT("undamaged couplers",
                                                       "elements.coupler *.bottomed_out",
                                                       "max: 0") ",\n" LIMIT("closure",
                                                                             "interfaces."
                                                                             "shortening_mm",
                                                                             "max: 5000") "]}\n";

static Case light;

static int make_light(void **state) {
    (void)state;
    light = explained(trains, NULL);
    return 0;
}

static int free_light(void **state) {
    (void)state;
    end(&light);
    return 0;
}

static void failing_checks_are_explained_once(void **state) {
    (void)state;
    assert_int_equal(light.explanation->n_check, 4);
    assert_false(light.explanation->has_climbing);
    for (int i = 0; i < 4; i++)
        assert_int_equal(light.explanation->check[i].check.verdict, CZ_VERDICT_FAIL);
}

static void a_force_is_that_of_the_coupler_that_bottomed_out(void **state) {
    (void)state;
    const CzExplainedCheck *check = find(&light, "interface force");
    assert_int_equal(check->carried, CZ_CARRIED_FORCE);
    assert_int_equal(check->n_carrier, 1);
    assert_true(strncmp(check->carrier[0].what, "couplers of ", 12) == 0);
    assert_string_equal(check->carrier[0].what + 12, check->check.where);
    /* Samples are 1 ms apart, around the peak. */
    assert_near(check->carrier[0].amount, 1e3 * check->check.value, 0.1, 0);
    const char *name = check->state[0].element;
    assert_string_equal(check->state[0].state, "bottomed out");
    assert_true(check->state[0].time <= check->time[1]);
    assert_true(strncmp(name, "coupler ", 8) == 0);
}

static void a_deceleration_has_its_window_and_both_neighbours(void **state) {
    (void)state;
    const CzExplainedCheck *check = find(&light, "mean deceleration");
    assert_true(check->time[1] - check->time[0] >= 0.12 - 1e-9);
    assert_near(sum_of_shares(check), 1, 0.011, 0); /* small ones are left out */
    assert_true(check->n_state > 0);
}

static void energies_are_those_of_the_run(void **state) {
    (void)state;
    const CzExplainedCheck *check = find(&light, "coupler energy");
    double sum = 0;
    assert_int_equal(check->carried, CZ_CARRIED_ENERGY);
    for (int i = 0; i < check->n_carrier; i++)
        sum += check->carrier[i].share;
    assert_near(sum, 1, 0.011, 0); /* small ones are left out */
    assert_true(isnan(check->time[0]));
    assert_true(check->carrier[0].amount >= check->carrier[1].amount);
    assert_true(check->carrier[0].amount > 1e3 * check->check.value);
}

static void a_yes_or_no_is_at_the_time_of_its_event(void **state) {
    (void)state;
    const CzExplainedCheck *check = find(&light, "undamaged couplers");
    const CzElementState *device = state_of(check, check->check.where);
    assert_string_equal(device->state, "bottomed out");
    assert_near(check->time[0], device->time, 0, 0);
    assert_near(check->margin, -0.01, ROUNDING_OF_A_VALUE, 0);
}

/* A change as a setting of the file: margins of its checks. */
static double margin_with(const CzTriedChange *change, const char *name, bool *passes) {
    char setting[CZ_PATH_SIZE + 40];
    const char *const set = setting;
    CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation = {0};
    CzError error = {0};
    double margin = NAN;
    snprintf(setting, sizeof setting, "%s=%.17g", change->name, change->tried);
    options.set = &set;
    options.n_set = 1;
    assert_int_equal(cz_problem_read_text(trains, sizeof trains - 1, "over.yaml", "problems",
                                          &options, &problem, &error),
                     CZ_OK);
    assert_int_equal(cz_evaluator_build(problem, NULL, &evaluator, &error), CZ_OK);
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, false, &evaluation, &error), CZ_OK);
    *passes = false;
    for (int i = 0; i < evaluation.n_check; i++)
        if (strcmp(evaluation.check[i].name, name) == 0) {
            margin = evaluation.check[i].margin;
            *passes = evaluation.check[i].verdict == CZ_VERDICT_PASS;
        }
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return margin;
}

/* A change that is set by hand gives the margins that were reported, those of energies as well. */
static void changes_have_the_effect_of_the_changed_file(void **state) {
    (void)state;
    const char *const name[] = {"interface force", "coupler energy"};
    bool any_passes = false;
    for (int n = 0; n < 2; n++) {
        const CzExplainedCheck *check = find(&light, name[n]);
        assert_true(check->n_change > 0);
        for (int i = 0; i < check->n_change; i++) {
            const CzTriedChange *change = &check->change[i];
            bool passes, other_passes;
            assert_near(margin_with(change, name[n], &passes), change->margin, 1e-9, 1e-9);
            assert_int_equal(passes, change->passes);
            assert_near(margin_with(change, change->other, &other_passes), change->other_margin,
                        1e-9, 1e-9);
            assert_true(change->margin > check->margin);
            any_passes |= passes;
        }
    }
    assert_true(any_passes);
}

static void changes_are_in_order(void **state) {
    (void)state;
    for (int c = 0; c < light.explanation->n_check; c++) {
        const CzExplainedCheck *check = &light.explanation->check[c];
        for (int i = 1; i < check->n_change; i++) {
            const CzTriedChange *before = &check->change[i - 1], *change = &check->change[i];
            const bool is_clean = change->passes && change->n_broken == 0;
            const bool was_clean = before->passes && before->n_broken == 0;
            assert_true(was_clean || !is_clean);
            if (was_clean && is_clean)
                assert_true(fabs(before->change) <= fabs(change->change));
            if (!was_clean)
                assert_true(before->margin >= change->margin);
        }
    }
}

static void a_passing_check_is_explained_by_name(void **state) {
    (void)state;
    Case made = explained(trains, "closure");
    assert_int_equal(made.explanation->n_check, 1);
    assert_int_equal(made.explanation->check[0].check.verdict, CZ_VERDICT_PASS);
    end(&made);
}

static void without_a_failing_check_the_nearest_is_explained(void **state) {
    (void)state;
    static const char passing[] =
        TRAINS LIMIT("force", "interfaces.peak_force_kN", "max: 9000") "," LIMIT(
            "closure", "interfaces.shortening_mm", "max: 50000") "]}\n";
    Case made = explained(passing, NULL);
    assert_int_equal(made.explanation->n_check, 1);
    assert_string_equal(made.explanation->check[0].check.name, "force");
    end(&made);
}

static void an_unknown_check_is_refused_with_the_nearest_name(void **state) {
    (void)state;
    Case made;
    CzError error = {0};
    assert_int_equal(explain(trains, "closur", &made, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.help, "closure"));
    end(&made);
}

/* An anti-climber that is too strong for the section behind it, and a tube too strong for the
 * shear-off, which no run decides. */
static void a_rule_of_the_design_has_changes_but_no_time(void **state) {
    (void)state;
    Case made = explained(CARS "parts: {front-coupler: {shear_off: {force_kN: 620}}}\n",
                          "tube force / shear-off force");
    const CzExplainedCheck *check = find(&made, "tube force / shear-off force");
    assert_int_equal(check->check.verdict, CZ_VERDICT_FAIL);
    assert_true(isnan(check->time[0]));
    assert_int_equal(check->n_carrier, 0);
    assert_true(check->n_change >= 2 && check->change[0].passes);
    assert_false(made.explanation->has_climbing);
    end(&made);
}

/* A service rule: the coupler must not shear at 8 km/h; the time is that of its largest force. */
static void a_service_rule_is_at_the_largest_force(void **state) {
    (void)state;
    static const char service[] =
        TRAINS LIMIT("service", "elements.coupler *.shear_load", "max: 0.1") "]}\n";
    Case made = explained(service, "service");
    const CzExplainedCheck *check = find(&made, "service");
    assert_int_equal(check->check.verdict, CZ_VERDICT_FAIL);
    assert_false(isnan(check->time[0]));
    assert_true(check->n_carrier > 0 && check->n_change > 0);
    end(&made);
}

static void a_wheel_lift_is_at_its_time(void **state) {
    (void)state;
    Case made =
        explained(CARS "trains: [{name: A, speed_km_h: 45}]\n", "wheel lift / flange height");
    const CzExplainedCheck *check = find(&made, "wheel lift / flange height");
    assert_int_equal(check->check.verdict, CZ_VERDICT_FAIL);
    assert_near(check->time[0], check->check.when[0], 0, 0);
    assert_int_equal(check->carried, CZ_CARRIED_MOMENT);
    assert_true(check->n_carrier > 2);
    assert_true(made.explanation->has_climbing);
    end(&made);
}

static void survival_space_is_explained_at_its_vehicle(void **state) {
    (void)state;
    Case made = explained(CARS "trains: [{name: A, speed_km_h: 45}, {name: B, speed_km_h: -45}]\n"
                               "checks: {limits: [" LIMIT(
                                   "space", "vehicles.survival_shortening_mm", "max: 1") "]}\n",
                          "space");
    const CzExplainedCheck *check = find(&made, "space");
    assert_int_equal(check->check.verdict, CZ_VERDICT_FAIL);
    assert_string_equal(check->interface, "A1-B1");
    assert_true(check->n_carrier > 0 && check->n_change > 0);
    assert_string_equal(state_of(check, "anti-climber A1")->state, "bottomed out");
    assert_string_equal(state_of(check, "coupler A1")->state, "sheared off");
    end(&made);
}

static void numbers_of_an_obstacle_are_not_changed(void **state) {
    (void)state;
    static const char wagon[] =
        "extends: wagon.yaml\n"
        "checks: {limits: [" LIMIT("force", "interfaces.peak_force_kN", "max: 10") "]}\n";
    Case made = explained(wagon, "force");
    const CzExplainedCheck *check = find(&made, "force");
    for (int i = 0; i < check->n_change; i++)
        assert_null(strstr(check->change[i].name, "wagon"));
    end(&made);
}

/* ---- places ---- */

/* Three cars; that in the middle has a coupler in both interfaces. */
static void a_place_leads_to_its_vehicle_interfaces_and_element(void **state) {
    (void)state;
    const struct {
        const char *where;
        int vehicle, behind, ahead;
        double force; /* of the element; 0 for none */
    } expected[] = {
        {"A1-A2", -1, 0, -1, 0},      {"A2-A3", -1, 1, -1, 0}, {"coupler A2", -1, 1, -1, 9},
        {"coupler A1", -1, 0, -1, 5}, {"A2", 1, 0, 1, 0},      {"A2 front", 1, 1, -1, 0},
        {"A2 rear", 1, 0, -1, 0},     {"A1", 0, 0, -1, 0},     {"A3", 2, 1, -1, 0},
        {"A1 front", 0, 0, -1, 0},    {"", -1, -1, -1, 0},     {"A22", -1, -1, -1, 0}};
    static CzInterfaceResult interface[] = {
        {.name = "A1-A2",
         .n_element = 2,
         .element = {{.name = "coupler A1", .peak_force = 5}, {.name = "coupler A2"}}},
        {.name = "A2-A3", .n_element = 1, .element = {{.name = "coupler A2", .peak_force = 9}}}};
    static const CzVehicleResult vehicle[] = {{.name = "A1"}, {.name = "A2"}, {.name = "A3"}};
    const CzRunSummary run = {
        .n_interface = 2, .interface = interface, .n_vehicle = 3, .vehicle = vehicle};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const CzWhere found = cz_where_find(&run, expected[i].where);
        assert_int_equal(found.vehicle, expected[i].vehicle);
        assert_int_equal(found.interface[0], expected[i].behind);
        assert_int_equal(found.interface[1], expected[i].ahead);
        assert_near(found.element != NULL ? found.element->peak_force : 0, expected[i].force, 0, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(failing_checks_are_explained_once),
        cmocka_unit_test(a_force_is_that_of_the_coupler_that_bottomed_out),
        cmocka_unit_test(a_deceleration_has_its_window_and_both_neighbours),
        cmocka_unit_test(energies_are_those_of_the_run),
        cmocka_unit_test(a_yes_or_no_is_at_the_time_of_its_event),
        cmocka_unit_test(changes_have_the_effect_of_the_changed_file),
        cmocka_unit_test(changes_are_in_order),
        cmocka_unit_test(a_passing_check_is_explained_by_name),
        cmocka_unit_test(without_a_failing_check_the_nearest_is_explained),
        cmocka_unit_test(an_unknown_check_is_refused_with_the_nearest_name),
        cmocka_unit_test(a_rule_of_the_design_has_changes_but_no_time),
        cmocka_unit_test(a_service_rule_is_at_the_largest_force),
        cmocka_unit_test(a_wheel_lift_is_at_its_time),
        cmocka_unit_test(survival_space_is_explained_at_its_vehicle),
        cmocka_unit_test(numbers_of_an_obstacle_are_not_changed),
        cmocka_unit_test(a_place_leads_to_its_vehicle_interfaces_and_element),
    };
    return cmocka_run_group_tests(tests, make_light, free_light);
}
