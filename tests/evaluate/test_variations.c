/* Scenarios that change values: as the same values in a file, for the design as written and for the
 * designs of a search. */
#include <stdarg.h>
#include <setjmp.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "evaluate/evaluator.h"
#include "support/check.h"

/* Two pairs of rigid cars; the second train is a copy. */
static const char base[] = "schema: 1\n"
                           "title: variations\n"
                           "parts:\n"
                           "  tube: {stages: [{stroke_mm: 300, force_kN: 700}]}\n"
                           "  other-tube: {use: tube, stiffness_MN_m: 300}\n"
                           "  end:\n"
                           "    proof_strength_kN: 3000\n"
                           "    face_gap_mm: 600\n"
                           "    coupler:\n"
                           "      buffer: {stages: [{stroke_mm: 40, force_kN: 600}]}\n"
                           "      tube: {use: other-tube}\n"
                           "      height_mm: 900\n"
                           "trains:\n"
                           "  - name: A\n"
                           "    speed_km_h: 18\n"
                           "    vehicles:\n"
                           "      - {name: A1, model: rigid, mass_t: 30, length_m: 15, front: "
                           "{use: end}, rear: {use: end}}\n"
                           "      - {name: A2, model: rigid, mass_t: 32, length_m: 15, front: "
                           "{use: end}, rear: {use: end}}\n"
                           "  - {name: B, copy: A, reversed: true, speed_km_h: 0}\n"
                           "scenarios:\n"
                           "  - {name: first, speed_km_h: 18, duration_s: 0.4}\n";

static const char search[] =
    "optimise:\n"
    "  variables:\n"
    "    - {path: \"parts.tube.stages[0].force_kN\", min: 500, max: 900}\n"
    "    - {path: \"parts.tube.stages[0].stroke_mm\", min: 200, max: 400}\n";

static CzProblem *read_texts(const char *first, const char *second, const char *third) {
    char text[8192];
    CzProblem *problem = NULL;
    CzError error = {0};
    const int n = snprintf(text, sizeof text, "%s%s%s", first, second, third);
    if (cz_problem_read_text(text, (size_t)n, "text", ".", NULL, &problem, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return problem;
}

static CzEvaluator *build(const CzProblem *problem) {
    CzEvaluator *evaluator = NULL;
    CzError error = {0};
    if (cz_evaluator_build(problem, NULL, &evaluator, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return evaluator;
}

/* Peak forces and speeds of the n-th scenario, which identify a run. */
typedef struct Print {
    double value[8];
} Print;

static Print print_of(CzEvaluator *evaluator, const double *x, int scenario) {
    Print print = {{0}};
    CzEvaluation evaluation;
    CzError error = {0};
    if (cz_evaluate(evaluator, 1, x, true, &evaluation, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_string_equal(evaluation.failure, "");
    const CzRunSummary *run = cz_run_summary(evaluation.run[scenario]);
    for (int i = 0; i < 3; i++)
        print.value[i] = run->interface[i].peak_force;
    for (int i = 0; i < 4; i++)
        print.value[3 + i] = run->vehicle[i].final_speed;
    cz_evaluation_free(&evaluation);
    return print;
}

static void expect_equal(Print a, Print b) {
    for (int i = 0; i < 8; i++)
        assert_true(a.value[i] == b.value[i]);
}

static bool differ(Print a, Print b) {
    return memcmp(&a, &b, sizeof a) != 0;
}

/* The last scenario with these changes gives the bits of a file with other texts in its place. */
static void expect_as_written(const char *changes, const char *from, const char *to) {
    char written[4096];
    const char *at = strstr(base, from);
    assert_non_null(at);
    snprintf(written, sizeof written, "%.*s%s%s", (int)(at - base), base, to, at + strlen(from));
    CzProblem *changed = read_texts(base, "  - {name: second, like: first, changes: ", changes);
    CzProblem *plain = read_texts(written, "", "");
    CzEvaluator *one = build(changed), *other = build(plain);
    const Print print = print_of(one, NULL, 1);
    expect_equal(print, print_of(other, NULL, 0));
    assert_true(differ(print, print_of(one, NULL, 0)));
    cz_evaluator_free(one);
    cz_evaluator_free(other);
    cz_problem_free(changed);
    cz_problem_free(plain);
}

static void a_change_is_the_value_in_a_file(void **state) {
    (void)state;
    expect_as_written("[{path: \"parts.tube.stages[0].force_kN\", value: 600}]}\n", "force_kN: 700",
                      "force_kN: 600");
    expect_as_written("[{path: \"parts.tube.stages[*].force_kN\", factor: 1.5}]}\n",
                      "force_kN: 700", "force_kN: 1050");
    expect_as_written("[{path: \"parts.tube.stages[0].force_N\", add: 100000}]}\n", "force_kN: 700",
                      "force_kN: 800");
    expect_as_written("[{path: trains.A.vehicles.A2.mass_t, value: 40},"
                      " {path: trains.B.vehicles.B1.mass_t, value: 40}]}\n",
                      "mass_t: 32", "mass_t: 40");
    expect_as_written("[{path: scenario.speed_km_h, factor: 0.5}]}\n", "speed_km_h: 18, duration",
                      "speed_km_h: 9, duration");
}

/* The tube of a part that uses another one is scaled once. */
static void all_parts_are_changed_once(void **state) {
    (void)state;
    expect_as_written("[{path: \"parts.*.stages[*].force_kN\", factor: 1.5}]}\n", "force_kN: 700",
                      "force_kN: 1050");
}

/* A value that `set:` put into a part, or into the part that this one uses, belongs to that part.
 */
static void all_parts_include_those_that_a_setting_changed(void **state) {
    (void)state;
    CzProblem *changed = read_texts(base,
                                    "  - {name: second, like: first, changes: "
                                    "[{path: \"parts.*.stages[*].force_kN\", factor: 1.5}]}\n",
                                    "set: {\"parts.tube.stages[0].force_kN\": 600}\n");
    CzProblem *plain = read_texts(base, "", "set: {\"parts.tube.stages[0].force_kN\": 900}\n");
    CzEvaluator *one = build(changed), *other = build(plain);
    expect_equal(print_of(one, NULL, 1), print_of(other, NULL, 0));
    cz_evaluator_free(one);
    cz_evaluator_free(other);
    cz_problem_free(changed);
    cz_problem_free(plain);
}

/* Each vehicle of a copy has values of its own in a change. */
static void a_copy_has_its_own_vehicles(void **state) {
    (void)state;
    CzProblem *problem = read_texts(base,
                                    "  - {name: second, like: first, changes: "
                                    "[{path: trains.B.vehicles.B2.mass_t, add: 10}]}\n",
                                    "");
    CzEvaluator *evaluator = build(problem);
    const Print as_written = print_of(evaluator, NULL, 0), heavier = print_of(evaluator, NULL, 1);
    assert_true(heavier.value[6] < as_written.value[6]);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

/* A factor and a sum act on the design's values, as they do on those of a file with the design. */
static void changes_act_on_designs(void **state) {
    (void)state;
    const char cases[] = "  - {name: second, like: first, reserves: false, changes: ["
                         "{path: \"parts.tube.stages[0].force_kN\", factor: 1.25}, "
                         "{path: \"parts.tube.stages[0].force_kN\", add: 25}, "
                         "{path: \"parts.tube.stages[0].stroke_mm\", add: -20}]}\n";
    const double x[2] = {600, 250};
    const double scaled[2] = {600 * 1.25 + 25, 230};
    CzProblem *problem = read_texts(base, cases, search), *plain = read_texts(base, "", search);
    CzEvaluator *changed = build(problem), *other = build(plain);
    const Print print = print_of(changed, x, 1);
    expect_equal(print, print_of(other, scaled, 0));
    CzProblem *designed = NULL;
    CzError error = {0};
    assert_int_equal(cz_evaluator_read_design(changed, x, &designed, &error), CZ_OK);
    CzEvaluator *read_again = build(designed);
    expect_equal(print, print_of(read_again, NULL, 1));
    cz_evaluator_free(read_again);
    cz_problem_free(designed);
    cz_evaluator_free(changed);
    cz_evaluator_free(other);
    cz_problem_free(problem);
    cz_problem_free(plain);
}

/* Margin of the rule "tube force / shear-off force" of the design as written, whose tube has a
 * force that rises with the fastest closing speed. */
static double margin_of_tube(const char *more) {
    char text[4096];
    static const char from[] = "tube: {use: other-tube}\n";
    const char *at = strstr(base, from);
    assert_non_null(at);
    snprintf(text, sizeof text,
             "%.*stube: {use: other-tube, rate_factor_s_m: 0.05}\n"
             "      shear_off: {force_kN: 1300, retraction_space_mm: 1500}\n%s",
             (int)(at - base), base, at + sizeof from - 1);
    CzProblem *problem = read_texts(text, more, "");
    CzEvaluator *evaluator = build(problem);
    CzEvaluation evaluation;
    CzError error = {0};
    double margin = NAN;
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, false, &evaluation, &error), CZ_OK);
    for (int i = 0; i < evaluation.n_check; i++)
        if (strcmp(evaluation.check[i].name, "tube force / shear-off force") == 0 &&
            strcmp(evaluation.check[i].scenario, "design") == 0)
            margin = evaluation.check[i].margin;
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return margin;
}

/* A faster scenario that is like another one, such as a sample, does not change the rules of the
 * design as written; a faster one of its own does. */
static void a_variation_changes_no_rule_of_the_design(void **state) {
    (void)state;
    const double alone = margin_of_tube("");
    assert_true(isfinite(alone));
    assert_true(margin_of_tube("  - {name: faster, like: first, reserves: false, changes: [{path: "
                               "scenario.speed_km_h, value: 30}]}\n") == alone);
    assert_true(margin_of_tube("  - {name: faster, speed_km_h: 30, duration_s: 0.4}\n") < alone);
}

static bool has_check(const CzEvaluation *evaluation, const char *name, const char *scenario) {
    for (int i = 0; i < evaluation->n_check; i++)
        if (strcmp(evaluation->check[i].name, name) == 0 &&
            strcmp(evaluation->check[i].scenario, scenario) == 0)
            return true;
    return false;
}

/* 15 km/h is the service speed; a collision of 15.3 km/h that is like it is no crash, one of 25
 * km/h is. */
static void a_tolerance_of_the_speed_keeps_the_rules_of_a_scenario(void **state) {
    (void)state;
    CzProblem *problem =
        read_texts(base,
                   "  - {name: service, speed_km_h: 15, duration_s: 0.4}\n"
                   "  - {name: sample, like: service, reserves: false, changes: [{path: "
                   "scenario.speed_km_h, factor: 1.02}]}\n"
                   "  - {name: fast, like: service, reserves: false, changes: [{path: "
                   "scenario.speed_km_h, value: 25}]}\n",
                   "");
    CzEvaluator *evaluator = build(problem);
    CzEvaluation evaluation;
    CzError error = {0};
    static const char of_crashes[] = "share of collision energy absorbed";
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, false, &evaluation, &error), CZ_OK);
    assert_false(has_check(&evaluation, of_crashes, "service"));
    assert_false(has_check(&evaluation, of_crashes, "sample"));
    assert_true(has_check(&evaluation, of_crashes, "fast"));
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

/* A case in memory is the scenario of a file. */
static void a_case_is_a_scenario(void **state) {
    (void)state;
    const CzCaseChange change[] = {{"parts.tube.stages[0].force_kN", CZ_CASE_FACTOR, 0.9},
                                   {"scenario.speed_km_h", CZ_CASE_ADD, 2}};
    const CzCase added = {
        .name = "second", .scenario = 0, .reserves = false, .n_change = 2, .change = change};
    CzProblem *plain = read_texts(base, "", search), *extended = NULL;
    CzProblem *written = read_texts(base,
                                    "  - {name: second, like: first, reserves: false, changes: "
                                    "[{path: \"parts.tube.stages[0].force_kN\", factor: 0.9}, "
                                    "{path: scenario.speed_km_h, add: 2}]}\n",
                                    search);
    CzError error = {0};
    if (cz_problem_read_cases(plain, 1, &added, &extended, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_int_equal(cz_problem_n_scenario(extended), 2);
    CzEvaluator *one = build(extended), *other = build(written);
    const double x[2] = {650, 300};
    assert_int_equal(cz_evaluator_n_variable(one), 2);
    assert_int_equal(cz_evaluator_n_constraint(one), cz_evaluator_n_constraint(other));
    expect_equal(print_of(one, x, 1), print_of(other, x, 1));
    cz_evaluator_free(one);
    cz_evaluator_free(other);
    cz_problem_free(extended);
    cz_problem_free(plain);
    cz_problem_free(written);
}

/* Limit of a check in a scenario; NaN when it is not judged there. */
static double limit_of(CzEvaluator *evaluator, const char *name, const char *scenario) {
    CzEvaluation evaluation;
    CzError error = {0};
    double limit = NAN;
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, false, &evaluation, &error), CZ_OK);
    for (int i = 0; i < evaluation.n_check; i++)
        if (strcmp(evaluation.check[i].name, name) == 0 &&
            strcmp(evaluation.check[i].scenario, scenario) == 0)
            limit = evaluation.check[i].limit;
    cz_evaluation_free(&evaluation);
    return limit;
}

/* Without reserves rules hold as physical limits, limits of the file as they are. */
static void reserves_are_left_out(void **state) {
    (void)state;
    const char *const cases = "  - {name: second, like: first, reserves: false}\n"
                              "checks:\n"
                              "  limits: [{name: force, metric: interfaces.peak_force_kN, "
                              "max: 1000, scenarios: [first]}]\n";
    const char *const kept = "uncertainty: {reserves: [stroke used]}\n";
    CzProblem *problem = read_texts(base, cases, ""), *other = read_texts(base, cases, kept);
    CzEvaluator *evaluator = build(problem), *strict = build(other);
    assert_true(limit_of(evaluator, "stroke used", "first") == 0.9);
    assert_true(limit_of(evaluator, "stroke used", "second") == 1);
    assert_true(limit_of(strict, "stroke used", "second") == 0.9);
    assert_true(limit_of(evaluator, "force", "second") == 1000);
    assert_true(isnan(limit_of(evaluator, "stroke / installed length", "second")));
    cz_evaluator_free(evaluator);
    cz_evaluator_free(strict);
    cz_problem_free(problem);
    cz_problem_free(other);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_change_is_the_value_in_a_file),
        cmocka_unit_test(all_parts_are_changed_once),
        cmocka_unit_test(all_parts_include_those_that_a_setting_changed),
        cmocka_unit_test(a_copy_has_its_own_vehicles),
        cmocka_unit_test(changes_act_on_designs),
        cmocka_unit_test(a_variation_changes_no_rule_of_the_design),
        cmocka_unit_test(a_tolerance_of_the_speed_keeps_the_rules_of_a_scenario),
        cmocka_unit_test(a_case_is_a_scenario),
        cmocka_unit_test(reserves_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
