/* Reading of whole problems: the values of valid files. */
#include "problem/read_problem.h"

static void values_are_in_si_units_and_absent_ones_have_their_defaults(void **state) {
    (void)state;
    CzProblem *problem = read_good("rigid.yaml", 0, NULL);
    const CzInput *input = cz_problem_input(problem);
    assert_string_equal(cz_problem_title(problem), "Two rigid cars");
    assert_int_equal(input->n_trains, 2);
    assert_near(input->trains[0].speed, 10, ROUNDING_OF_A_VALUE, 0);
    const CzVehicle *car = &input->trains[0].vehicles[0];
    assert_string_equal(car->name, "A1");
    assert_int_equal(car->model, CZ_MODEL_RIGID);
    assert_near(car->mass, 44e3, 0, 0);
    assert_near(car->payload, 0, 0, 0);
    assert_true(isnan(car->length));
    assert_true(car->front.given);
    assert_false(car->bogie.given);
    assert_int_equal(car->front.n_stages, 2);
    assert_near(car->front.stages[1].force, 2e6, 0, 0);
    assert_true(isnan(car->front.stages[1].end_force));
    assert_int_equal(car->front.anti_climber.count, 1);
    assert_near(car->front.anti_climber.stiffness, 2e8, 0, 0);
    assert_near(input->trains[1].vehicles[0].front.anti_climber.gap, 0.12, ROUNDING_OF_A_VALUE, 0);
    assert_near(input->trains[1].vehicles[0].rear.anti_climber.gap, 0.1, ROUNDING_OF_A_VALUE, 0);
    assert_false(input->simulation.given);
    assert_near(input->simulation.longest, 20, 0, 0);
    cz_problem_free(problem);
}

static void copied_and_reversed_trains_are_written_out_along_x(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    static const char *const names[] = {"A1", "A2", "A3", "A4", "B1", "B2", "B3", "B4"};
    int n_vehicle = 0;
    const CzVehicle *vehicle = cz_problem_vehicles(problem, &n_vehicle);
    assert_int_equal(n_vehicle, 8);
    for (int i = 0; i < 8; i++)
        assert_string_equal(vehicle[i].name, names[i]);
    assert_ptr_equal(cz_problem_input(problem)->trains[1].vehicles, &vehicle[4]);
    assert_true(vehicle[0].rear.anti_climber.given && !vehicle[0].front.anti_climber.given);
    assert_true(vehicle[3].front.anti_climber.given && !vehicle[3].rear.anti_climber.given);
    assert_true(vehicle[4].rear.anti_climber.given && !vehicle[4].front.anti_climber.given);
    assert_near(vehicle[4].mass, 39e3, 0, 0);
    assert_near(vehicle[7].mass, 38.7e3, 0, 0);
    assert_near(vehicle[3].front.coupler.tube.trigger, 950e3, 0, 0);
    assert_near(vehicle[3].front.coupler.tube.stages[0].force, 900e3, 0, 0);
    assert_near(vehicle[2].rear.coupler.tube.trigger, 1e6, 0, 0);
    cz_problem_free(problem);
}

static void names_of_a_copy_that_do_not_begin_with_the_trains_name_get_it_in_front(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        "schema: 1\ntitle: copy\n"
        "parts:\n"
        "  bumper: {face_gap_m: 0, unloading_stiffness_MN_m: 9, stages: [{stroke_m: 1, force_kN: "
        "1}]}\n"
        "  car: {model: rigid, mass_t: 40, front: {use: bumper}, rear: {use: bumper}}\n"
        "trains:\n"
        "  - {name: A, speed_m_s: 3, vehicles: [{name: Tc, use: car}, {name: M, use: car, repeat: "
        "2}]}\n"
        "  - {name: B, copy: A, reversed: true}\n");
    static const char *const names[] = {"Tc", "M1", "M2", "B-M2", "B-M1", "B-Tc"};
    int n_vehicle = 0;
    const CzVehicle *vehicle = cz_problem_vehicles(problem, &n_vehicle);
    assert_int_equal(n_vehicle, 6);
    for (int i = 0; i < 6; i++)
        assert_string_equal(vehicle[i].name, names[i]);
    cz_problem_free(problem);
}

/* Only a full car has the end mass whose distance its length bounds. */
static void a_rigid_car_may_be_shorter_than_the_car_of_its_end(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        "schema: 1\ntitle: short\n"
        "parts:\n"
        "  end: {face_gap_m: 0, distance_m: 10.6, unloading_stiffness_MN_m: 9, stages: [{stroke_m: "
        "1, force_kN: 1}]}\n"
        "  car: {model: rigid, mass_t: 40, length_m: 20, front: {use: end}, rear: {use: end}}\n"
        "trains:\n"
        "  - {name: A, speed_m_s: 3, vehicles: [{use: car}]}\n"
        "  - {name: B, vehicles: [{use: car}]}\n");
    cz_problem_free(problem);
}

static void an_overlay_merges_records_and_named_items_and_replaces_the_rest(void **state) {
    (void)state;
    CzProblem *problem = read_good("overlay.yaml", 0, NULL);
    const CzInput *input = cz_problem_input(problem);
    assert_string_equal(input->title, "Three full cars against their like, changed");
    assert_int_equal(input->n_scenarios, 4);
    assert_near(input->scenarios[2].speed, 7 / 3.6, ROUNDING_OF_A_VALUE, 0);
    assert_string_equal(input->scenarios[3].name, "fast");
    assert_near(find_vehicle(problem, "A4")->mass, 41e3, 0, 0);
    assert_near(find_vehicle(problem, "A1")->mass, 38.7e3, 0, 0);
    const CzAntiClimber *device = &find_vehicle(problem, "A4")->front.anti_climber;
    assert_int_equal(device->n_stages, 1);
    assert_near(device->stages[0].force, 700e3, 0, 0);
    assert_near(device->gap, 0.31, ROUNDING_OF_A_VALUE, 0);
    assert_near(find_vehicle(problem, "B4")->front.anti_climber.stages[0].force, 700e3, 0, 0);
    cz_problem_free(problem);
}

static void an_overlay_can_name_vehicles_that_have_no_name(void **state) {
    (void)state;
    CzProblem *problem = read_good_text("extends: rigid.yaml\n"
                                        "trains:\n"
                                        "  - {name: A, vehicles: [{name: A1, mass_t: 39}]}\n");
    int n_vehicle = 0;
    cz_problem_vehicles(problem, &n_vehicle);
    assert_int_equal(n_vehicle, 2);
    assert_near(find_vehicle(problem, "A1")->mass, 39e3, 0, 0);
    cz_problem_free(problem);
}

static void null_removes_a_key_of_the_part(void **state) {
    (void)state;
    CzProblem *problem = read_good_text("extends: rigid.yaml\n"
                                        "trains:\n"
                                        "  - {name: A, vehicles: [{name: A1, rear: null}]}\n");
    assert_false(find_vehicle(problem, "A1")->rear.given);
    assert_true(find_vehicle(problem, "A1")->front.given);
    cz_problem_free(problem);
}

/* An end takes what is not given from its part, which is merged after the keys beside `use`. */
static void null_removes_a_key_that_is_given_beside_a_part_and_in_it(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        "extends: full.yaml\n"
        "parts:\n"
        "  own-cab: {use: cab-car, rear: {use: cab-end, damping_kN_s_m: 70, anti_climber: {count: "
        "1}}}\n"
        "  bare-cab: {use: own-cab, rear: {damping_kN_s_m: null, anti_climber: null}}\n"
        "trains: [{name: A, vehicles: [{name: A4, use: bare-cab}]}]\n");
    assert_false(find_vehicle(problem, "A4")->rear.anti_climber.given);
    assert_true(find_vehicle(problem, "A4")->rear.coupler.given);
    assert_true(find_vehicle(problem, "A1")->rear.anti_climber.given);
    cz_problem_free(problem);
}

static void a_value_in_another_unit_overrides_the_same_stem(void **state) {
    (void)state;
    CzProblem *problem = read_good_text("extends: rigid.yaml\n"
                                        "parts: {car: {mass_kg: 41500}}\n"
                                        "trains: [{name: A, speed_m_s: 3}]\n");
    assert_near(find_vehicle(problem, "B1")->mass, 41500, 0, 0);
    assert_near(cz_problem_input(problem)->trains[0].speed, 3, 0, 0);
    cz_problem_free(problem);
}

static void a_setting_equals_the_typed_value(void **state) {
    (void)state;
    static const char *const set[] = {
        "trains.A.vehicles.A4.front.anti_climber.gap_mm=290",
        "parts.cab-end.anti_climber.gap_mm=280",
        "parts.cab-end.anti_climber.stages[1].force_MN=0.7",
        "trains.A.vehicles.A2.mass_t=36",
        "trains.*.height_offset_mm=5",
        "scenarios.head-25.speed_km_h=20",
        "scenarios[1].speed_m_s=6",
        "title='12'",
        "simulation.duration_ms=900",
        "simulation.adhesion.friction=0.25",
    };
    CzProblem *problem = read_good("full.yaml", 10, set);
    const CzInput *input = cz_problem_input(problem);
    assert_near(find_vehicle(problem, "A4")->front.anti_climber.gap, 0.29, ROUNDING_OF_A_VALUE, 0);
    assert_near(find_vehicle(problem, "B1")->rear.anti_climber.gap, 0.29, ROUNDING_OF_A_VALUE, 0);
    assert_near(find_vehicle(problem, "A1")->rear.anti_climber.gap, 0.28, ROUNDING_OF_A_VALUE, 0);
    assert_near(find_vehicle(problem, "A4")->front.anti_climber.stages[1].force, 7e5, 0, 0);
    assert_near(find_vehicle(problem, "A4")->front.anti_climber.stages[0].force, 525e3, 0, 0);
    assert_near(find_vehicle(problem, "A3")->mass, 36e3, 0, 0);
    assert_near(find_vehicle(problem, "B2")->mass, 36e3, 0, 0);
    assert_near(input->trains[0].height_offset, 5e-3, ROUNDING_OF_A_VALUE, 0);
    assert_near(input->trains[1].height_offset, 5e-3, ROUNDING_OF_A_VALUE, 0);
    assert_near(input->scenarios[0].speed, 20 / 3.6, ROUNDING_OF_A_VALUE, 0);
    assert_near(input->scenarios[1].speed, 6, 0, 0);
    assert_string_equal(input->title, "12");
    assert_near(input->simulation.duration, 0.9, ROUNDING_OF_A_VALUE, 0);
    assert_near(input->simulation.adhesion.friction, 0.25, 0, 0);
    cz_problem_free(problem);
}

static void a_setting_of_a_list_item_leaves_the_part_to_others(void **state) {
    (void)state;
    static const char *const set[] = {"trains.A.vehicles.A1.front.stages[1].force_kN=2600",
                                      "parts.end.stages[0].force_kN=2100"};
    CzProblem *problem = read_good("full.yaml", 2, set);
    assert_near(find_vehicle(problem, "A1")->rear.stages[1].force, 2.6e6, 0, 0);
    assert_near(find_vehicle(problem, "A1")->rear.stages[0].force, 2.1e6, 0, 0);
    assert_near(find_vehicle(problem, "A4")->front.stages[1].force, 2.5e6, 0, 0);
    cz_problem_free(problem);
}

static void json_is_read_as_well(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        "{\"schema\": 1, \"title\": \"J\\u00e4son\",\n\t\"trains\": [{\"name\": \"A\", "
        "\"speed_km_h\": 3.6e0, \"vehicles\": [{\"model\": \"rigid\", \"mass_t\": 1,\n"
        "\t\"front\": {\"face_gap_mm\": 0, \"unloading_stiffness_MN_m\": 100,\n"
        "\t\"stages\": [{\"stroke_mm\": 100, \"force_kN\": 100}]}}]},\n"
        "\t{\"name\": \"B\", \"vehicles\": [{\"model\": \"fixed\"}]}]}");
    assert_string_equal(cz_problem_title(problem), "J\xc3\xa4son");
    assert_near(cz_problem_input(problem)->trains[0].speed, 1, ROUNDING_OF_A_VALUE, 0);
    assert_int_equal(cz_problem_n_scenario(problem), 1);
    assert_string_equal(cz_problem_scenario_name(problem, 0), "collision");
    cz_problem_free(problem);
}

static void the_hash_covers_files_and_settings(void **state) {
    (void)state;
    static const char *const set[] = {"trains.A.speed_km_h=30"};
    CzProblem *once = read_good("full.yaml", 0, NULL), *again = read_good("full.yaml", 0, NULL);
    CzProblem *changed = read_good("full.yaml", 1, set);
    assert_string_equal(cz_problem_hash(once), cz_problem_hash(again));
    assert_string_not_equal(cz_problem_hash(once), cz_problem_hash(changed));
    assert_int_equal(strlen(cz_problem_hash(once)), 16);
    cz_problem_free(once);
    cz_problem_free(again);
    cz_problem_free(changed);
}

static void the_place_of_a_field_is_where_it_was_written(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    const CzInput *input = cz_problem_input(problem);
    CzError error = {0};
    cz_problem_place(problem, &input->checks.limits[0].max, &error);
    assert_int_equal(error.status, CZ_STATUS_INPUT);
    assert_string_equal(error.file, GOOD_FOLDER "/full.yaml");
    assert_int_equal(error.line, 22);
    assert_string_equal(cz_problem_source_line(problem, &error),
                        "    - {name: wheel lift, metric: vehicles.max_wheel_lift_mm, max: 21, "
                        "scenarios: [head-25, inner]}");
    cz_problem_place(problem, &find_vehicle(problem, "A2")->bogie.link.height, &error);
    assert_string_equal(error.file, GOOD_FOLDER "/parts.yaml");
    assert_int_equal(error.line, 15);
    cz_problem_place(problem, &find_vehicle(problem, "A2")->bogie.flange_height, &error);
    assert_int_equal(error.line, 67); /* a default: the record's own place */
    cz_problem_free(problem);
}

static void limits_of_a_profile_are_those_of_the_category(void **state) {
    (void)state;
    CzProblem *problem = read_good_text("extends: rigid.yaml\n"
                                        "checks: {profile: two-categories, category: C-II}\n");
    const CzProfile *profile = cz_problem_profile(problem);
    assert_non_null(profile);
    assert_int_equal(profile->n_limits, 2);
    assert_string_equal(profile->limits[0].name, "for all");
    assert_string_equal(profile->limits[1].name, "for C-II");
    CzError error = {0};
    cz_problem_place(problem, &profile->limits[1].max, &error);
    assert_int_equal(error.line, 12);
    cz_problem_free(problem);
    problem = read_good("rigid.yaml", 0, NULL);
    assert_null(cz_problem_profile(problem));
    cz_problem_free(problem);
}

static void a_byte_order_mark_before_the_text_is_ignored(void **state) {
    (void)state;
    CzProblem *problem = read_good_text("\xef\xbb\xbf"
                                        "extends: rigid.yaml\n"
                                        "title: marked\n");
    assert_string_equal(cz_problem_input(problem)->title, "marked");
    cz_problem_free(problem);
}

static void every_spelling_of_null_removes_a_key(void **state) {
    (void)state;
    static const char *const words[] = {"null", "Null", "NULL", "~"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char text[200];
        CzProblem *problem = NULL;
        snprintf(text, sizeof text, "extends: rigid.yaml\ntitle: a\noptimise: %s\nchecks: %s\n",
                 words[i], words[i]);
        problem = read_good_text(text);
        assert_false(cz_problem_input(problem)->optimise.given);
        assert_int_equal(cz_problem_input(problem)->checks.n_limits, 0);
        cz_problem_free(problem);
        snprintf(text, sizeof text, "extends: rigid.yaml\ntitle: %s\n", words[i]);
        assert_int_equal(read_text(text, &problem), CZ_STATUS_INPUT);
        cz_problem_free(problem);
        snprintf(text, sizeof text, "extends: rigid.yaml\ntitle: \"%s\"\n", words[i]);
        problem = read_good_text(text);
        assert_string_equal(cz_problem_input(problem)->title, words[i]);
        cz_problem_free(problem);
    }
}

/* The coupler of the full car at 720 mm, an end structure from 900 to 1200 mm or another coupler,
 * 40 mm higher. */
static void a_part_that_passes_the_end_opposite_is_warned_of(void **state) {
    (void)state;
    static const struct {
        const char *wagon, *warning; /* NULL: none */
    } cases[] = {
        {"", NULL},
        {", face_height_mm: 300", "no force: the coupler of 'A1', highest at 720 mm, passes under "
                                  "the end structure of 'W1', "
                                  "whose bottom is at 940 mm"},
        {", face_height_mm: 800", NULL},
        {", face_height_mm: 300, coupler: {height_m: 1, length_m: 1, buffer: {stages: [{stroke_mm: "
         "50, force_kN: 900}]}}",
         "the coupler of 'A1' meets that of 'W1', which is 320 mm higher"},
        {", face_height_mm: 300, coupler: {height_m: 0.8, length_m: 1, buffer: {stages: "
         "[{stroke_mm: 50, force_kN: 900}]}}",
         NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[900];
        snprintf(text, sizeof text,
                 "schema: 1\ntitle: wagon\ncatalogue: [problems/catalogue/generic.yaml]\n"
                 "simulation: {adhesion: {friction: 0.3}}\ntrains:\n"
                 "  - {name: A, speed_m_s: 5, brake: {ratio: 0, axle_share: 0}, vehicles: [{name: "
                 "A1, use: driving-car}]}\n"
                 "  - {name: W, height_offset_mm: 40, vehicles: [{name: W1, model: rigid, mass_t: "
                 "80, rear: {face_gap_m: 0, crush_height_m: 1.05%s}}]}\n",
                 cases[i].wagon);
        CzProblem *problem = NULL;
        CzError error = {0};
        const CzProblemOptions options = cz_problem_options_default();
        assert_int_equal(cz_problem_read_text(text, strlen(text), "wagon.yaml", CZ_SOURCE_FOLDER,
                                              &options, &problem, &error),
                         CZ_OK);
        const char *found = NULL;
        for (int k = 0; k < cz_problem_n_warning(problem); k++)
            if (strstr(cz_problem_warning(problem, k)->message, "the coupler of 'A1'") != NULL)
                found = cz_problem_warning(problem, k)->message;
        if (cases[i].warning == NULL)
            assert_null(found);
        else
            assert_true(found != NULL && strstr(found, cases[i].warning) == found);
        cz_problem_free(problem);
    }
}

static void a_sweep_is_one_scenario_per_combination(void **state) {
    (void)state;
    static const char *const setting[] = {"scenarios.climb.payload_share=0.5"};
    CzProblemOptions options = cz_problem_options_default();
    options.set = setting;
    options.n_set = 1;
    static const char text[] =
        "schema: 1\ntitle: family\nextends: full.yaml\n"
        "scenarios:\n"
        "  - name: climb\n"
        "    sweep: {speed_km_h: 18:36:3, height_offset_mm: [-40, 40]}\n"
        "  - {name: last, family: others}\n"
        "checks:\n"
        "  limits:\n"
        "    - {name: f, metric: interfaces.peak_force_kN, max: 1, scenarios: [climb, last]}\n";
    CzProblem *problem = NULL;
    CzError error = {0};
    const CzStatus status = cz_problem_read_text(text, strlen(text), "family.yaml",
                                                 "tests/problem/good", &options, &problem, &error);
    if (status != CZ_OK)
        print_error("%d:%d: %s\n", error.line, error.column, error.message);
    assert_int_equal(status, CZ_OK);
    static const double speed[] = {5, 5, 7.5, 7.5, 10, 10};
    const CzInput *input = cz_problem_input(problem);
    const int first = input->n_scenarios - 7; /* those of the base file come first */
    assert_true(first >= 0);
    for (int i = 0; i < 6; i++) {
        const CzScenario *member = &input->scenarios[first + i];
        assert_string_equal(member->family, "climb");
        assert_near(member->speed, speed[i], 1e-15, 0);
        assert_near(member->height_offset, i % 2 == 0 ? -0.04 : 0.04, 1e-15, 0);
        assert_near(member->payload_share, 0.5, 0, 0);
    }
    assert_string_equal(input->scenarios[first].name, "climb_18km_h_-40mm");
    assert_string_equal(input->scenarios[first + 3].name, "climb_27km_h_40mm");
    assert_string_equal(input->scenarios[first + 6].name, "last");
    assert_string_equal(input->scenarios[first + 6].family, "others");
    cz_problem_free(problem);
}

/* A third train without a scenario, and an unknown confidence. */
static void unused_trains_and_unknown_confidences_are_warned_of(void **state) {
    static const char text[] =
        "extends: rigid.yaml\ntrains:\n  - {name: C, copy: A, speed_km_h: 0}\n"
        "checks: {limits: [{name: peak, metric: interfaces.peak_force_kN, max: 1500, "
        "confidence: User}]}\noptimise: null\n";
    CzProblem *problem = NULL;
    (void)state;
    assert_int_equal(read_text(text, &problem), CZ_OK);
    assert_int_equal(cz_problem_n_warning(problem), OWN_WARNINGS + 2);
    for (int i = 0; i < 2; i++) {
        const char *message = cz_problem_warning(problem, i)->message;
        assert_true(strstr(message, "no effect: train 'C' is in no scenario") != NULL ||
                    strstr(message, "confidence 'User' is not one of S1") != NULL);
    }
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_in_si_units_and_absent_ones_have_their_defaults),
        cmocka_unit_test(copied_and_reversed_trains_are_written_out_along_x),
        cmocka_unit_test(names_of_a_copy_that_do_not_begin_with_the_trains_name_get_it_in_front),
        cmocka_unit_test(a_rigid_car_may_be_shorter_than_the_car_of_its_end),
        cmocka_unit_test(an_overlay_merges_records_and_named_items_and_replaces_the_rest),
        cmocka_unit_test(an_overlay_can_name_vehicles_that_have_no_name),
        cmocka_unit_test(null_removes_a_key_of_the_part),
        cmocka_unit_test(null_removes_a_key_that_is_given_beside_a_part_and_in_it),
        cmocka_unit_test(a_value_in_another_unit_overrides_the_same_stem),
        cmocka_unit_test(a_setting_equals_the_typed_value),
        cmocka_unit_test(a_setting_of_a_list_item_leaves_the_part_to_others),
        cmocka_unit_test(json_is_read_as_well),
        cmocka_unit_test(the_hash_covers_files_and_settings),
        cmocka_unit_test(the_place_of_a_field_is_where_it_was_written),
        cmocka_unit_test(limits_of_a_profile_are_those_of_the_category),
        cmocka_unit_test(a_byte_order_mark_before_the_text_is_ignored),
        cmocka_unit_test(every_spelling_of_null_removes_a_key),
        cmocka_unit_test(a_part_that_passes_the_end_opposite_is_warned_of),
        cmocka_unit_test(a_sweep_is_one_scenario_per_combination),
        cmocka_unit_test(unused_trains_and_unknown_confidences_are_warned_of),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
