/* Keys that lack the key they act with are warned of once, at their place, and only where they act
 * nowhere. acts.def lists the needs of each key, and problem-every-key tries all of them. */
#include "problem/read_problem.h"

#include "support/shipped.h"

/* The first warning of something without effect that names `word`; NULL for none. */
static const CzError *warning_of(const CzProblem *problem, const char *word) {
    for (int i = 0; i < cz_problem_n_warning(problem); i++) {
        const CzError *warning = cz_problem_warning(problem, i);
        if (strncmp(warning->message, "no effect", 9) == 0 &&
            strstr(warning->message, word) != NULL)
            return warning;
    }
    return NULL;
}

static void a_key_without_its_companion_is_warned_of_at_its_place(void **state) {
    (void)state;
    CzProblem *problem = read_good_text("schema: 1\n"
                                        "title: unpaired\n"
                                        "extends: rigid.yaml\n"
                                        "parts:\n"
                                        "  bumper:\n"
                                        "    anti_climber:\n"
                                        "      speed_reference_m_s: 8\n"
                                        "      trigger_length_mm: 5\n");
    const CzError *speed = warning_of(problem, "speed_reference");
    assert_non_null(speed);
    assert_int_equal(speed->line, 7);
    assert_int_equal(speed->column, 7);
    assert_non_null(strstr(speed->message, "no effect without speed_factor: speed_reference"));
    assert_non_null(strstr(speed->help, "remove the key"));
    assert_non_null(warning_of(problem, "without trigger: trigger_length"));
    cz_problem_free(problem);
}

static void a_key_beside_its_companion_is_not_warned_of(void **state) {
    (void)state;
    static const char *const set[] = {"parts.bumper.anti_climber.speed_reference_m_s=8",
                                      "parts.bumper.anti_climber.speed_factor=0.1"};
    CzProblem *problem = read_good("rigid.yaml", 2, set);
    assert_null(warning_of(problem, "speed"));
    cz_problem_free(problem);
}

static void friction_falls_only_to_a_sliding_friction(void **state) {
    (void)state;
    static const char *const set[] = {"simulation.adhesion.fall_speed_m_s=2",
                                      "simulation.adhesion.sliding_friction=0.1"};
    CzProblem *problem = read_good("full.yaml", 1, set);
    assert_non_null(warning_of(problem, "without sliding_friction: fall_speed"));
    cz_problem_free(problem);
    problem = read_good("full.yaml", 2, set);
    assert_null(warning_of(problem, "fall_speed"));
    cz_problem_free(problem);
}

/* A number of one record that needs a number of another record is warned of without it. */
static void keys_that_need_another_record_are_warned_of_without_it(void **state) {
    (void)state;
    static const struct {
        const char *text, *warning; /* NULL: none */
    } cases[] = {
        {"  - {name: B, copy: A, speed_m_s: 0}\n", NULL},
        {"scenarios: [{name: s, payload_share: 1}]\n", "no vehicle has a 'payload'"},
        {"scenarios: [{name: s, friction: 0.2}]\n", "no train has a brake"},
        {"set: {trains.A.vehicles.A1.payload_t: 5}\n", "no scenario has a 'payload_share'"},
        {"set: {trains.A.vehicles.A1.payload_t: 5}\nscenarios: [{name: s, payload_share: 0}]\n",
         NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[600];
        snprintf(text, sizeof text,
                 "schema: 1\ntitle: alone\ntrains:\n"
                 "  - {name: A, speed_m_s: 4, vehicles: [{name: A1, model: rigid, mass_t: 40, "
                 "front: {face_gap_m: 0, coupler: {buffer: {stages: [{stroke_mm: 50, force_kN: "
                 "400}]}}}, rear: {face_gap_m: 0, coupler: {buffer: {stages: [{stroke_mm: 50, "
                 "force_kN: 400}]}}}}]}\n%s%s",
                 i == 0 ? "" : "  - {name: B, copy: A, speed_m_s: 0}\n", cases[i].text);
        CzProblem *problem = read_good_text(text);
        if (cases[i].warning == NULL)
            assert_null(warning_of(problem, ""));
        else
            assert_non_null(warning_of(problem, cases[i].warning));
        cz_problem_free(problem);
    }
}

#define RIGID_TRAINS                                                                               \
    "schema: 1\n"                                                                                  \
    "title: couplers\n"                                                                            \
    "parts:\n"                                                                                     \
    "  gear: {draw_slack_mm: 5, stages: [{stroke_mm: 60, force_kN: 900}]}\n"                       \
    "  end: {face_gap_m: 1, coupler: {buffer: {use: gear}}}\n"                                     \
    "  car: {model: rigid, mass_t: 40, front: {use: end}, rear: {use: end}}\n"

static void a_part_that_acts_in_one_place_is_not_warned_of_in_others(void **state) {
    (void)state;
    CzProblem *two =
        read_good_text(RIGID_TRAINS "trains:\n"
                                    "  - {name: A, speed_m_s: 2, vehicles: [{use: car}]}\n"
                                    "  - {name: B, vehicles: [{use: car}]}\n");
    const CzError *slack = warning_of(two, "draw_slack");
    assert_non_null(slack);
    assert_int_equal(slack->line, 4);
    cz_problem_free(two);
    CzProblem *three =
        read_good_text(RIGID_TRAINS "trains:\n"
                                    "  - {name: A, speed_m_s: 2, vehicles: [{use: car}]}\n"
                                    "  - {name: B, vehicles: [{use: car, repeat: 2}]}\n");
    assert_null(warning_of(three, "draw_slack"));
    cz_problem_free(three);
}

static void a_rigid_end_needs_no_unloading_and_is_warned_of_one(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        RIGID_TRAINS
        "  hard: {face_gap_m: 1, unloading_stiffness_MN_m: 100}\n"
        "trains:\n"
        "  - {name: A, speed_m_s: 2, vehicles: [{use: car}]}\n"
        "  - {name: B, vehicles: [{use: car, rear: {unloading_stiffness_MN_m: 9}}]}\n");
    const CzError *warning = warning_of(problem, "unloading_stiffness");
    assert_non_null(warning);
    assert_int_equal(warning->line, 10);
    assert_int_equal(cz_problem_n_mistake(problem), 0);
    cz_problem_free(problem);
}

static void devices_of_an_end_that_meets_nothing_are_warned_of(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        RIGID_TRAINS "trains:\n"
                     "  - {name: A, speed_m_s: 2, vehicles: [{use: car}]}\n"
                     "  - name: B\n"
                     "    vehicles: [{use: car, front: {coupler: {buffer: {use: gear}}}}]\n");
    const CzError *warning = warning_of(problem, "coupler: this end meets nothing");
    assert_non_null(warning);
    assert_int_equal(warning->line, 10);
    assert_int_equal(warning->column, 35);
    cz_problem_free(problem);
}

/* Its mass acts. */
static void a_tube_with_a_mass_is_not_warned_of_where_it_meets_nothing(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        RIGID_TRAINS
        "trains:\n"
        "  - {name: A, speed_m_s: 2, vehicles: [{use: car}]}\n"
        "  - name: B\n"
        "    vehicles: [{use: car, front: {coupler: {length_m: 1, tube: {mass_per_stroke_kg_m: 90, "
        "stages: [{stroke_mm: 200, force_kN: 900}]}}}}]\n");
    assert_null(warning_of(problem, "this end meets nothing"));
    cz_problem_free(problem);
}

static void a_zone_acts_in_the_stages_of_an_end_only(void **state) {
    (void)state;
    static const char *const set[] = {"parts.bumper.anti_climber.stages[0].zone=temporary",
                                      "parts.bumper.stages[0].zone=crush"};
    CzProblem *problem = read_good("rigid.yaml", 2, set);
    const CzError *warning = warning_of(problem, "zone: a zone applies only to the stages");
    assert_non_null(warning);
    assert_int_equal(warning->line, 1); /* of the settings */
    assert_int_equal(cz_problem_n_warning(problem), OWN_WARNINGS + 1);
    cz_problem_free(problem);
}

static void times_that_end_no_run_are_warned_of(void **state) {
    (void)state;
    static const char *const set[] = {"simulation.longest_s=2", "simulation.duration_s=0.3",
                                      "scenarios.fast.duration_s=0.2",
                                      "scenarios.slow.duration_s=0.2"};
    CzProblem *problem = read_good("rigid.yaml", 1, set);
    assert_int_equal(cz_problem_n_warning(problem), OWN_WARNINGS);
    cz_problem_free(problem);
    problem = read_good("rigid.yaml", 2, set);
    assert_non_null(warning_of(problem, "every run has a duration"));
    assert_null(warning_of(problem, "of its own"));
    cz_problem_free(problem);
    problem = read_good("rigid.yaml", 4, set);
    assert_non_null(warning_of(problem, "every scenario has a duration of its own"));
    cz_problem_free(problem);
}

/* There all parts are written out, those of a catalogue, too. */
static void a_resolved_problem_is_not_warned_of_what_its_source_was_not(void **state) {
    (void)state;
    CzProblem *problem =
        read_good_text(RIGID_TRAINS "trains:\n"
                                    "  - {name: A, speed_m_s: 2, vehicles: [{use: car}]}\n"
                                    "  - {name: B, vehicles: [{use: car, repeat: 2}]}\n");
    assert_null(warning_of(problem, ""));
    char *text = resolved_text(problem);
    cz_problem_free(problem);
    assert_non_null(strstr(text, "draw_slack"));
    assert_int_equal(
        cz_problem_read_text(text, strlen(text), "resolved.yaml", ".", NULL, &problem, NULL),
        CZ_OK);
    assert_null(warning_of(problem, ""));
    cz_problem_free(problem);
    free(text);
}

/* Parts of a catalogue serve any problem. */
static void shipped_problems_have_no_key_without_effect(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++) {
        char path[600];
        CzProblem *problem = NULL;
        snprintf(path, sizeof path, CZ_SOURCE_FOLDER "/problems/%s", shipped.name[i]);
        assert_int_equal(cz_problem_read(path, NULL, &problem, NULL), CZ_OK);
        const CzError *warning = warning_of(problem, "");
        if (warning != NULL)
            fail_msg("%s:%d: %s", warning->file, warning->line, warning->message);
        cz_problem_free(problem);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_key_without_its_companion_is_warned_of_at_its_place),
        cmocka_unit_test(a_key_beside_its_companion_is_not_warned_of),
        cmocka_unit_test(friction_falls_only_to_a_sliding_friction),
        cmocka_unit_test(keys_that_need_another_record_are_warned_of_without_it),
        cmocka_unit_test(a_part_that_acts_in_one_place_is_not_warned_of_in_others),
        cmocka_unit_test(a_rigid_end_needs_no_unloading_and_is_warned_of_one),
        cmocka_unit_test(devices_of_an_end_that_meets_nothing_are_warned_of),
        cmocka_unit_test(a_tube_with_a_mass_is_not_warned_of_where_it_meets_nothing),
        cmocka_unit_test(a_zone_acts_in_the_stages_of_an_end_only),
        cmocka_unit_test(times_that_end_no_run_are_warned_of),
        cmocka_unit_test(a_resolved_problem_is_not_warned_of_what_its_source_was_not),
        cmocka_unit_test(shipped_problems_have_no_key_without_effect),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
