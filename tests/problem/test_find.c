/* Places that a path names. */
#include "problem/read_problem.h"

typedef struct {
    const char *vehicle;
    size_t offset;
    int match;
} Expected;

static void check_found(const char *path, int n_expected, const Expected *expected) {
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    CzTargets found = {0};
    CzError error = {0};
    int n_vehicle = 0;
    const CzVehicle *vehicle = cz_problem_vehicles(problem, &n_vehicle);
    assert_int_equal(cz_problem_find(problem, path, &found, &error), CZ_OK);
    assert_int_equal(found.n, n_expected);
    for (int i = 0; i < found.n; i++) {
        assert_string_equal(vehicle[found.target[i].vehicle].name, expected[i].vehicle);
        assert_int_equal(found.target[i].offset, expected[i].offset);
        assert_int_equal(found.target[i].match, expected[i].match);
        const double value =
            *(const double *)(const void *)((const char *)&vehicle[found.target[i].vehicle] +
                                            found.target[i].offset);
        assert_near(found.target[i].value, value, 0, 0);
    }
    free(found.target);
    cz_problem_free(problem);
}

static void a_path_through_a_part_names_every_user_that_does_not_override(void **state) {
    (void)state;
    const size_t front = offsetof(CzVehicle, front.coupler.tube.trigger);
    const size_t rear = offsetof(CzVehicle, rear.coupler.tube.trigger);
    const Expected cab[] = {{"A1", rear, 0}, {"A4", front, 0}, {"B1", rear, 0}, {"B4", front, 0}};
    check_found("parts.cab-end.coupler.tube.trigger_kN", 4, cab);
    const Expected rest[] = {{"A1", front, 0}, {"A2", front, 0}, {"A2", rear, 0},  {"A3", front, 0},
                             {"A3", rear, 0},  {"A4", rear, 0},  {"B1", front, 0}, {"B2", front, 0},
                             {"B2", rear, 0},  {"B3", front, 0}, {"B3", rear, 0},  {"B4", rear, 0}};
    check_found("parts.coupler.tube.trigger_kN", 12, rest);
}

static void an_asterisk_matches_every_item(void **state) {
    (void)state;
    const size_t first = offsetof(CzVehicle, front.anti_climber.stages[0].stroke);
    const size_t second = offsetof(CzVehicle, front.anti_climber.stages[1].stroke);
    const Expected expected[] = {
        {"A4", first, 0},
        {"B1", first + offsetof(CzVehicle, rear) - offsetof(CzVehicle, front), 0},
        {"A4", second, 1},
        {"B1", second + offsetof(CzVehicle, rear) - offsetof(CzVehicle, front), 1}};
    check_found("trains.A.vehicles.A4.front.anti_climber.stages[*].stroke_mm", 4, expected);
}

static void a_path_through_a_vehicle_names_its_repeats_and_copies_too(void **state) {
    (void)state;
    const size_t front = offsetof(CzVehicle, front.stages[0].force);
    const size_t rear = offsetof(CzVehicle, rear.stages[0].force);
    const Expected expected[] = {
        {"A2", front, 0}, {"A3", front, 0}, {"B2", rear, 0}, {"B3", rear, 0}};
    check_found("trains.A.vehicles.A2.front.stages[0].force_kN", 4, expected);
}

static void behind_a_star_items_without_the_record_are_skipped(void **state) {
    (void)state;
    const size_t front = offsetof(CzVehicle, front.coupler.shear_off.force);
    const size_t rear = offsetof(CzVehicle, rear.coupler.shear_off.force);
    const Expected expected[] = {
        {"A1", rear, 0}, {"B4", front, 0}, {"A4", front, 1}, {"B1", rear, 1}};
    check_found("trains.*.vehicles.*.front.coupler.shear_off.force_kN", 4, expected);
}

static void a_target_has_its_unit_and_its_concrete_path(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    CzTargets found = {0};
    assert_int_equal(cz_problem_find(problem,
                                     "trains.*.vehicles[*].front.anti_climber.stages[*].force_kN",
                                     &found, NULL),
                     CZ_OK);
    assert_int_equal(found.n, 8);
    assert_near(found.target[0].unit, 1e3, 0, 0);
    assert_string_equal(found.target[0].suffix, "kN");
    assert_true(found.target[0].may_vary);
    assert_string_equal(found.target[0].place,
                        "trains.A.vehicles.A1.front.anti_climber.stages[0].force_kN");
    assert_string_equal(found.target[7].place,
                        "trains.A.vehicles.A4.front.anti_climber.stages[1].force_kN");
    free(found.target);
    found = (CzTargets){0};
    assert_int_equal(cz_problem_find(problem, "trains.A.vehicles.A4.mass_kg", &found, NULL), CZ_OK);
    assert_false(found.target[0].may_vary);
    assert_near(found.target[0].unit, 1, 0, 0);
    free(found.target);
    cz_problem_free(problem);
}

static void finding_and_setting_use_the_same_places(void **state) {
    (void)state;
    static const char *const paths[] = {"parts.cab-end.anti_climber.gap_mm",
                                        "parts.end.stages[1].force_kN",
                                        "trains.A.vehicles.A2.rear.coupler.tube.stages[0].force_kN",
                                        "trains.*.vehicles.*.front.stages[0].force_kN"};
    for (int p = 0; p < 4; p++) {
        char set[200];
        const char *sets[] = {set};
        CzProblem *problem = read_good("full.yaml", 0, NULL);
        CzTargets found = {0};
        int n_vehicle = 0, n_changed = 0;
        assert_int_equal(cz_problem_find(problem, paths[p], &found, NULL), CZ_OK);
        const double value = found.target[0].value * 1.001;
        snprintf(set, sizeof set, "%s=%.17g", paths[p], value / found.target[0].unit);
        CzProblem *changed = read_good("full.yaml", 1, sets);
        const CzVehicle *before = cz_problem_vehicles(problem, &n_vehicle);
        const CzVehicle *after = cz_problem_vehicles(changed, &n_vehicle);
        for (int i = 0; i < found.n; i++)
            assert_near(
                *(const double *)(const void *)((const char *)&after[found.target[i].vehicle] +
                                                found.target[i].offset),
                value, ROUNDING_OF_A_VALUE, 0);
        for (int v = 0; v < n_vehicle; v++)
            for (size_t at = offsetof(CzVehicle, mass); at + 8 <= sizeof *before; at += 8)
                n_changed +=
                    memcmp((const char *)&before[v] + at, (const char *)&after[v] + at, 8) != 0;
        assert_int_equal(n_changed, found.n);
        free(found.target);
        cz_problem_free(changed);
        cz_problem_free(problem);
    }
}

static void earlier_settings_are_kept_while_finding(void **state) {
    (void)state;
    static const char *const set[] = {"trains.A.vehicles.A4.front.anti_climber.gap_mm=290"};
    CzProblem *problem = read_good("full.yaml", 1, set);
    CzTargets found = {0};
    assert_int_equal(cz_problem_find(problem, "parts.cab-end.anti_climber.gap_mm", &found, NULL),
                     CZ_OK);
    assert_int_equal(found.n, 2); /* A1 and B4; A4 and its copy B1 have their own */
    free(found.target);
    cz_problem_free(problem);
}

static void an_unknown_path_is_reported_with_a_suggestion(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    CzTargets found = {0};
    CzError error = {0};
    assert_int_equal(cz_problem_find(problem, "trains.A.vehicles.A5.mass_t", &found, &error),
                     CZ_STATUS_INPUT);
    assert_string_equal(
        error.message, "path 'trains.A.vehicles.A5.mass_t': there is no 'A5' in trains.A.vehicles");
    assert_string_equal(error.help, "did you mean 'A1'?");
    assert_null(found.target);
    assert_int_equal(found.n, 0);
    assert_int_equal(cz_problem_find(problem, "", &found, &error), CZ_STATUS_INPUT);
    assert_int_equal(cz_problem_find(problem, "trains[99999999999].x", &found, &error),
                     CZ_STATUS_INPUT);
    assert_int_equal(cz_problem_find(problem, "trains.A.vehicles.A1.front", &found, NULL),
                     CZ_STATUS_INPUT);
    free(found.target);
    cz_problem_free(problem);
}

static void a_candidate_must_satisfy_the_rules_of_a_file(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    int n_vehicle = 0;
    const CzVehicle *own = cz_problem_vehicles(problem, &n_vehicle);
    CzVehicle *candidate = malloc((size_t)n_vehicle * sizeof *candidate);
    CzError error = {0};
    assert_non_null(candidate);
    memcpy(candidate, own, (size_t)n_vehicle * sizeof *candidate);
    assert_int_equal(cz_problem_check_vehicles(problem, candidate, &error), CZ_OK);
    candidate[3].front.anti_climber.stages[0].force = 700e3; /* its trigger is at 600 kN */
    assert_int_equal(cz_problem_check_vehicles(problem, candidate, &error), CZ_STATUS_INPUT);
    assert_non_null(
        strstr(error.message, "a trigger of 600 kN is below the first plateau of 700 kN"));
    assert_string_equal(error.file, GOOD_FOLDER "/parts.yaml");
    assert_int_equal(error.line, 53);
    free(candidate);
    cz_problem_free(problem);
}

/* A setting of a part inside a part is applied after those of the inner part, whichever is typed
 * first, because a value beside `use` takes the values of the part at that moment. */
static void settings_of_parts_do_not_depend_on_their_order(void **state) {
    (void)state;
    static const char text[] =
        "schema: 1\n"
        "title: parts in parts\n"
        "parts:\n"
        "  tube: {stages: [{stroke_mm: 250, force_kN: 800}]}\n"
        "  coupler: {buffer: {stages: [{stroke_mm: 50, force_kN: 400}]}, tube: {use: tube}}\n"
        "  head: {face_gap_mm: 900, unloading_stiffness_MN_m: 600, coupler: {use: coupler}}\n"
        "trains:\n"
        "  - {name: A, speed_m_s: 5,\n"
        "     vehicles: [{name: A1, model: rigid, mass_t: 40, front: {use: head}}]}\n"
        "  - {name: B, vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {use: head}}]}\n";
    static const char *const set[2][2] = {
        {"parts.head.coupler.tube.trigger_kN=1000", "parts.tube.stages[0].force_kN=700"},
        {"parts.tube.stages[0].force_kN=700", "parts.head.coupler.tube.trigger_kN=1000"}};
    for (int order = 0; order < 2; order++) {
        CzProblemOptions options = cz_problem_options_default();
        CzProblem *problem = NULL;
        CzTargets found = {0};
        CzError error = {0};
        int n_vehicle;
        options.set = set[order];
        options.n_set = 2;
        assert_int_equal(cz_problem_read_text(text, sizeof text - 1, "parts.yaml", ".", &options,
                                              &problem, &error),
                         CZ_OK);
        const CzTube *tube = &cz_problem_vehicles(problem, &n_vehicle)->front.coupler.tube;
        assert_near(tube->stages[0].force, 700e3, 0, 0);
        assert_near(tube->trigger, 1000e3, 0, 0);
        assert_int_equal(cz_problem_find(problem, "parts.tube.stages[0].force_kN", &found, &error),
                         CZ_OK);
        assert_int_equal(found.n, 2);
        free(found.target);
        cz_problem_free(problem);
    }
}

static void numbers_of_trains_and_of_the_simulation_are_found_too(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    static const char *const paths[] = {"simulation.adhesion.friction", "trains.A.speed_km_h"};
    const CzInput *input = cz_problem_input(problem);
    const double *const fields[] = {&input->simulation.adhesion.friction, &input->trains[0].speed};
    for (int i = 0; i < 2; i++) {
        CzTargets found = {0};
        CzError error = {0};
        assert_int_equal(cz_problem_find(problem, paths[i], &found, &error), CZ_OK);
        assert_int_equal(found.n, 1);
        assert_int_equal(found.target->vehicle, -1);
        assert_ptr_equal(found.target->field, fields[i]);
        assert_near(found.target->value, *fields[i], 0, 0);
        assert_false(found.target->may_vary);
        assert_int_equal(found.target->may_fit, i == 0); /* the speed is fixed data */
        free(found.target);
    }
    cz_problem_free(problem);
}

static void variables_keep_the_places_of_their_paths(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    const CzOptimise *optimise = &cz_problem_input(problem)->optimise;
    int n_checked = 0;
    for (int i = 0; i < optimise->n_variables; i++) {
        const CzTargets *targets = cz_problem_targets(problem, i);
        CzTargets found = {0};
        if (optimise->variables[i].path == NULL)
            continue;
        assert_int_equal(cz_problem_find(problem, optimise->variables[i].path, &found, NULL),
                         CZ_OK);
        assert_int_equal(targets->n, found.n);
        for (int k = 0; k < found.n; k++) {
            assert_ptr_equal(targets->target[k].field, found.target[k].field);
            assert_string_equal(targets->target[k].place, found.target[k].place);
        }
        free(found.target);
        n_checked++;
    }
    assert_in_range(n_checked, 1, optimise->n_variables);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_of_parts_do_not_depend_on_their_order),
        cmocka_unit_test(numbers_of_trains_and_of_the_simulation_are_found_too),
        cmocka_unit_test(variables_keep_the_places_of_their_paths),
        cmocka_unit_test(a_path_through_a_part_names_every_user_that_does_not_override),
        cmocka_unit_test(an_asterisk_matches_every_item),
        cmocka_unit_test(a_path_through_a_vehicle_names_its_repeats_and_copies_too),
        cmocka_unit_test(behind_a_star_items_without_the_record_are_skipped),
        cmocka_unit_test(a_target_has_its_unit_and_its_concrete_path),
        cmocka_unit_test(finding_and_setting_use_the_same_places),
        cmocka_unit_test(earlier_settings_are_kept_while_finding),
        cmocka_unit_test(a_candidate_must_satisfy_the_rules_of_a_file),
        cmocka_unit_test(an_unknown_path_is_reported_with_a_suggestion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
