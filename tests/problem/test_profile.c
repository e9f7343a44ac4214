/* What a problem takes of a profile: scenarios and partners as if the file had them, limits with
 * other numbers, and what is not run. */
#include "problem/read_problem.h"

#include "problem/profile.h"

#define SINGLE "extends: single.yaml\n"
#define KMH (1 / 3.6)
#define ROUNDING 1e-12 /* of km/h to m/s [m/s] */

static const CzScenario *find_scenario(const CzProblem *problem, const char *name) {
    const CzInput *input = cz_problem_input(problem);
    for (int i = 0; i < input->n_scenarios; i++)
        if (strcmp(input->scenarios[i].name, name) == 0)
            return &input->scenarios[i];
    return NULL;
}

static const CzTrain *train_ahead(const CzProblem *problem, const char *scenario) {
    return cz_input_train(cz_problem_input(problem), find_scenario(problem, scenario), 1);
}

static const CzAskedScenario *find_asked(const CzProblem *problem, const char *name) {
    int n_asked = 0;
    const CzAskedScenario *asked = cz_problem_profile_scenarios(problem, &n_asked);
    for (int i = 0; i < n_asked; i++)
        if (strcmp(asked[i].scenario->name, name) == 0)
            return &asked[i];
    fail_msg("the profile has no scenario %s", name);
    return NULL;
}

static const CzLimit *find_limit(const CzProblem *problem, const char *name) {
    const CzProfile *profile = cz_problem_profile(problem);
    for (int i = 0; i < profile->n_limits; i++)
        if (strcmp(profile->limits[i].name, name) == 0)
            return &profile->limits[i];
    return NULL;
}

/* ---- scenarios and partners ---- */

static void scenarios_of_the_category_are_those_of_the_problem(void **state) {
    (void)state;
    CzProblem *problem = read_good("single.yaml", 0, NULL);
    static const char *const names[] = {"alike", "alike-heavy", "wagon", "crossing"};
    static const double speeds[] = {36, 39.6, 36, 110};
    assert_int_equal(cz_problem_n_scenario(problem), 4);
    for (int i = 0; i < 4; i++) {
        assert_string_equal(cz_problem_scenario_name(problem, i), names[i]);
        assert_near(find_scenario(problem, names[i])->speed, speeds[i] * KMH, ROUNDING, 0);
    }
    assert_near(find_scenario(problem, "alike-heavy")->mass_factor, 1.1, ROUNDING, 0);
    assert_string_equal(find_scenario(problem, "alike-heavy")->family, "alike");
    assert_near(find_scenario(problem, "crossing")->payload_share, 0.5, ROUNDING, 0);
    assert_null(find_scenario(problem, "crossing")->family);
    CzError error = {0};
    cz_problem_place(problem, &find_scenario(problem, "crossing")->speed, &error);
    assert_string_equal(error.file, GOOD_FOLDER "/profiles/own.yaml");
    assert_int_equal(error.line, 16);
    assert_int_equal(error.column, 58); /* at below_line_speed_km_h */
    cz_problem_free(problem);
}

static void scenarios_of_the_file_follow_and_may_be_like_those_of_the_profile(void **state) {
    (void)state;
    CzProblem *problem =
        read_good_text(SINGLE "scenarios: [{name: slow, like: wagon, speed_km_h: 10}]\n");
    assert_int_equal(cz_problem_n_scenario(problem), 5);
    assert_string_equal(cz_problem_scenario_name(problem, 4), "slow");
    assert_string_equal(train_ahead(problem, "slow")->name, "wagon");
    cz_problem_free(problem);
}

static void an_identical_partner_is_a_copy_that_stands_and_faces_the_train(void **state) {
    (void)state;
    CzProblem *problem = read_good("single.yaml", 0, NULL);
    const CzTrain *partner = train_ahead(problem, "alike");
    assert_string_equal(partner->name, "B");
    assert_int_equal(partner->n_vehicles, 2);
    assert_string_equal(partner->vehicles[0].name, "B1");
    assert_near(partner->vehicles[0].mass, 44e3, 0, 0);
    assert_near(partner->speed, 0, 0, 0);
    cz_problem_free(problem);
}

static void the_copy_of_the_file_is_the_identical_partner(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        SINGLE
        "trains: [{name: C, copy: A, reversed: true, brake: {ratio: 0.2, axle_share: 1}}]\n");
    assert_string_equal(train_ahead(problem, "alike")->name, "C");
    assert_int_equal(cz_problem_input(problem)->n_trains, 3); /* the third is the wagon */
    cz_problem_free(problem);
}

static void the_name_of_the_copy_is_free(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(SINGLE "trains: [{name: B, vehicles: [{use: car}]}]\n");
    assert_string_equal(train_ahead(problem, "alike")->name, "partner");
    cz_problem_free(problem);
}

static void the_profile_sets_the_brake_of_the_partner(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(SINGLE "checks: {category: metro}\n");
    assert_near(find_scenario(problem, "alike")->partner_brake_ratio, 0.1, 0, 0);
    assert_near(find_scenario(problem, "alike")->speed, 25 * KMH, ROUNDING, 0);
    cz_problem_free(problem);
    problem = read_good("single.yaml", 0, NULL);
    assert_true(isnan(find_scenario(problem, "wagon")->partner_brake_ratio)); /* it has no brake */
    cz_problem_free(problem);
}

static void parts_of_a_partner_are_those_of_the_profile_alone(void **state) {
    (void)state;
    CzProblem *problem = read_good("single.yaml", 0, NULL);
    const CzTrain *wagon = train_ahead(problem, "wagon");
    assert_int_equal(wagon->role, CZ_ROLE_OBSTACLE);
    assert_near(wagon->vehicles[0].mass, 80e3, 0, 0);
    assert_near(wagon->vehicles[0].rear.face_gap, 0.6, 0, 0);
    assert_int_equal(wagon->vehicles[0].rear.n_stages, 0);
    cz_problem_free(problem);
}

static void a_train_of_the_file_with_the_name_of_a_partner_is_used(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        SINGLE "trains: [{name: wagon, vehicles: [{name: V, use: car, mass_t: 90}]}]\n");
    assert_near(train_ahead(problem, "crossing")->vehicles[0].mass, 90e3, 0, 0);
    cz_problem_free(problem);
}

/* ---- what is replaced, selected or does not apply ---- */

static void a_scenario_of_the_file_replaces_that_of_its_name(void **state) {
    (void)state;
    CzProblem *problem =
        read_good_text(SINGLE "scenarios: [{name: alike, speed_km_h: 20, trains: [A, B]}]\n");
    assert_int_equal(cz_problem_n_scenario(problem), 4);
    assert_near(find_scenario(problem, "alike")->speed, 20 * KMH, ROUNDING, 0);
    assert_int_equal(find_asked(problem, "alike")->standing, CZ_STANDING_REPLACED);
    assert_int_equal(find_asked(problem, "alike-heavy")->standing, CZ_STANDING_RUN);
    cz_problem_free(problem);
}

static void a_family_of_the_file_replaces_that_of_the_profile(void **state) {
    (void)state;
    static const char *const files[] = {
        SINGLE "scenarios: [{name: mine, family: alike, speed_km_h: 20, trains: [A, wagon]}]\n",
        SINGLE "scenarios: [{name: alike, sweep: {speed_km_h: [20, 30]}, trains: [A, wagon]}]\n"};
    for (int i = 0; i < 2; i++) {
        CzProblem *problem = read_good_text(files[i]);
        assert_int_equal(cz_problem_n_scenario(problem), 3 + i);
        assert_int_equal(find_asked(problem, "alike")->standing, CZ_STANDING_REPLACED);
        assert_int_equal(find_asked(problem, "alike-heavy")->standing, CZ_STANDING_REPLACED);
        cz_problem_free(problem);
    }
}

static void scenarios_are_selected_by_name_or_family(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(SINGLE "checks: {scenarios: [alike]}\n");
    assert_int_equal(cz_problem_n_scenario(problem), 2);
    assert_int_equal(cz_problem_input(problem)->n_trains, 2); /* the wagon is not needed */
    assert_int_equal(find_asked(problem, "wagon")->standing, CZ_STANDING_NOT_SELECTED);
    cz_problem_free(problem);
}

static void what_does_not_apply_has_a_reason(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(SINGLE "checks: {category: metro}\n");
    assert_int_equal(find_asked(problem, "wagon")->standing, CZ_STANDING_NOT_APPLICABLE);
    assert_string_equal(find_asked(problem, "wagon")->why, "no wagons in a tunnel");
    assert_string_equal(find_asked(problem, "crossing")->why, "it is for main only");
    cz_problem_free(problem);
    problem = read_good_text(SINGLE "checks: {line_speed_km_h: 50}\n");
    assert_string_equal(find_asked(problem, "crossing")->why,
                        "its speed, the line speed less 50 km/h, at most 110 km/h, is not above "
                        "zero at a line speed of 50 km/h");
    cz_problem_free(problem);
}

static void a_line_speed_is_needed_only_by_what_is_run(void **state) {
    (void)state;
    CzProblem *problem = NULL;
    assert_int_equal(read_text(SINGLE "checks: {line_speed_km_h: null}\n", &problem),
                     CZ_STATUS_INPUT);
    cz_problem_free(problem);
    problem = read_good_text(SINGLE "checks: {line_speed_km_h: null, scenarios: [wagon]}\n");
    cz_problem_free(problem);
}

/* ---- limits ---- */

static void an_override_changes_one_limit(void **state) {
    (void)state;
    CzProblem *problem =
        read_good_text(SINGLE "checks: {override: {shortening: {max: 800, source: test 7}}}\n");
    assert_near(find_limit(problem, "shortening")->max, 800, 0, 0);
    assert_string_equal(find_limit(problem, "shortening")->source, "test 7");
    assert_string_equal(find_limit(problem, "shortening")->confidence, "user");
    assert_string_equal(find_limit(problem, "shortening")->clause, "5");
    assert_near(find_limit(problem, "force")->max, 3000, 0, 0);
    assert_string_equal(find_limit(problem, "force")->confidence, "M1");
    cz_problem_free(problem);
}

/* ---- paths ---- */

static void paths_lead_into_what_the_profile_adds(void **state) {
    (void)state;
    static const char *const set[] = {
        "checks.override.shortening.max=700", "scenarios.wagon.speed_km_h=30",
        "trains.wagon.vehicles.W1.mass_t=85", "trains.A.vehicles.A1.mass_t=41"};
    CzProblem *problem = read_good("single.yaml", 4, set);
    assert_near(find_limit(problem, "shortening")->max, 700, 0, 0);
    assert_near(find_scenario(problem, "wagon")->speed, 30 * KMH, ROUNDING, 0);
    assert_near(find_vehicle(problem, "W1")->mass, 85e3, 0, 0);
    assert_near(find_vehicle(problem, "B2")->mass, 41e3, 0, 0);
    CzTargets targets = {0};
    CzError error = {0};
    assert_int_equal(cz_problem_find(problem, "trains.wagon.vehicles.W1.mass_t", &targets, &error),
                     CZ_OK);
    assert_int_equal(targets.n, 1);
    free(targets.target);
    cz_problem_free(problem);
}

static void settings_of_checks_decide_what_is_added(void **state) {
    (void)state;
    static const char *const set[] = {"checks.category=metro"};
    static const char *const listed[] = {"checks.scenarios=[ wagon, 'alike' ]"};
    static const char *const line_speed[] = {"checks.line_speed_km_h=90"};
    CzProblem *problem = read_good("single.yaml", 1, set), *other = NULL;
    assert_int_equal(cz_problem_n_scenario(problem), 2);
    cz_problem_free(problem);
    problem = read_good("single.yaml", 1, listed);
    assert_int_equal(cz_problem_n_scenario(problem), 3);
    assert_int_equal(find_asked(problem, "crossing")->standing, CZ_STANDING_NOT_SELECTED);
    cz_problem_free(problem);
    problem = read_good("single.yaml", 0, NULL);
    assert_int_equal(cz_problem_read_with(problem, 1, line_speed, &other, NULL), CZ_OK);
    assert_near(find_scenario(other, "crossing")->speed, 40 * KMH, ROUNDING, 0);
    cz_problem_free(other);
    cz_problem_free(problem);
}

static void changes_of_a_scenario_may_name_a_partner(void **state) {
    (void)state;
    CzProblem *problem = read_good_text(
        SINGLE "scenarios: [{name: heavy, like: wagon, changes: [{path: "
               "trains.wagon.vehicles.W1.mass_t, add: 10}, {path: scenario.speed_km_h, value: "
               "12}]}]\n");
    const int heavy = cz_problem_n_scenario(problem) - 1;
    const CzProblem *changed = cz_problem_in_scenario(problem, heavy);
    assert_near(find_vehicle(changed, "W1")->mass, 90e3, 0, 0);
    assert_near(find_scenario(changed, "heavy")->speed, 12 * KMH, ROUNDING, 0);
    cz_problem_free(problem);
}

/* ---- read again ---- */

static void a_resolved_problem_has_the_same_scenarios_and_limits(void **state) {
    (void)state;
    static const char *const files[] = {
        SINGLE "checks: {override: {force: {max: 2500}}}\n",
        SINGLE "checks: {scenarios: []}\nscenarios: [{name: own, trains: [A, B], speed_km_h: 9}]\n"
               "trains: [{name: B, copy: A}]\n",
        SINGLE "checks: {scenarios: [alike], line_speed_km_h: null}\n"};
    for (int i = 0; i < 3; i++) {
        CzProblem *problem = read_good_text(files[i]), *again = NULL;
        char *text = resolved_text(problem), *second;
        again = read_good_text(text);
        second = resolved_text(again);
        assert_int_equal(cz_problem_n_scenario(problem), cz_problem_n_scenario(again));
        for (int s = 0; s < cz_problem_n_scenario(problem); s++)
            assert_string_equal(cz_problem_scenario_name(problem, s),
                                cz_problem_scenario_name(again, s));
        assert_near(find_limit(again, "force")->max, find_limit(problem, "force")->max, 0, 0);
        assert_int_equal(find_asked(problem, "wagon")->standing == CZ_STANDING_NOT_SELECTED,
                         find_asked(again, "wagon")->standing == CZ_STANDING_NOT_SELECTED);
        assert_non_null(strstr(second, "trains: [A, B]"));
        free(text);
        free(second);
        cz_problem_free(again);
        cz_problem_free(problem);
    }
}

/* ---- all shipped profiles ---- */

static void read_each(const char *name, void *data) {
    CzProblem *holder = cz_problem_create(CZ_SOURCE_FOLDER "/problems");
    CzSuggestion nearest = {0};
    int *n = data;
    const char *path = cz_profile_find(&holder->reader, NULL, name, &nearest);
    const CzProfileFile file = cz_profile_load(holder, path, NULL);
    assert_non_null(file.top);
    assert_string_equal(file.whole->name, name);
    assert_true(file.whole->not_checked.n_text > 0);
    for (int i = 0; i < file.whole->n_categories || i == 0; i++) {
        CzProfile profile = {0};
        const char *category = file.whole->n_categories > 0 ? file.whole->categories[i].name : NULL;
        assert_true(cz_profile_in_category(holder, &file, category, &profile));
        assert_true(profile.n_limits > 0);
    }
    print_mistakes(holder);
    assert_int_equal(cz_problem_n_mistake(holder), 0);
    cz_problem_free(holder);
    ++*n;
}

static void every_shipped_profile_is_valid_in_every_category(void **state) {
    (void)state;
    int n = 0;
    cz_profile_each(CZ_SOURCE_FOLDER "/problems", read_each, &n);
    assert_true(n >= 7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenarios_of_the_category_are_those_of_the_problem),
        cmocka_unit_test(scenarios_of_the_file_follow_and_may_be_like_those_of_the_profile),
        cmocka_unit_test(an_identical_partner_is_a_copy_that_stands_and_faces_the_train),
        cmocka_unit_test(the_copy_of_the_file_is_the_identical_partner),
        cmocka_unit_test(the_name_of_the_copy_is_free),
        cmocka_unit_test(the_profile_sets_the_brake_of_the_partner),
        cmocka_unit_test(parts_of_a_partner_are_those_of_the_profile_alone),
        cmocka_unit_test(a_train_of_the_file_with_the_name_of_a_partner_is_used),
        cmocka_unit_test(a_scenario_of_the_file_replaces_that_of_its_name),
        cmocka_unit_test(a_family_of_the_file_replaces_that_of_the_profile),
        cmocka_unit_test(scenarios_are_selected_by_name_or_family),
        cmocka_unit_test(what_does_not_apply_has_a_reason),
        cmocka_unit_test(a_line_speed_is_needed_only_by_what_is_run),
        cmocka_unit_test(an_override_changes_one_limit),
        cmocka_unit_test(paths_lead_into_what_the_profile_adds),
        cmocka_unit_test(settings_of_checks_decide_what_is_added),
        cmocka_unit_test(changes_of_a_scenario_may_name_a_partner),
        cmocka_unit_test(a_resolved_problem_has_the_same_scenarios_and_limits),
        cmocka_unit_test(every_shipped_profile_is_valid_in_every_category),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
