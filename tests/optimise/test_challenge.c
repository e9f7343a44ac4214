/* Challenges: weakest points known in closed form, what no point breaks, failures by name, the same
 * points for any threads, and challenges of designs. */
#include <stdbool.h>

#include "support/check.h"

#include "evaluate/evaluator.h"
#include "optimise/challenge.h"

/* Two rigid vehicles of 40 t and one plateau of 1 MN with an elastic stiffness k. The plateau takes
 * the energy E = mu v^2 / 2 less the elastic part of its last force:
 *
 *   crush = E / F - F / (2 k)
 *
 * so the weakest point is the corner of the highest speed and mass and the lowest force.
 */
static const char two_masses[] =
    "schema: 1\n"
    "title: two rigid vehicles and one plateau\n"
    "parts:\n"
    "  zone: {gap_mm: 0, stiffness_MN_m: 500, stages: [{stroke_mm: 2000, force_kN: 1000}]}\n"
    "trains:\n"
    "  - name: A\n"
    "    speed_km_h: 20\n"
    "    vehicles:\n"
    "      - {name: A1, model: rigid, mass_t: 40, front: {face_gap_m: 5, anti_climber: {use: "
    "zone}}}\n"
    "  - name: B\n"
    "    vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {face_gap_m: 0}}]\n"
    "simulation: {longest_s: 6}\n"
    "optimise:\n"
    "  variables:\n"
    "    - {path: 'parts.zone.stages[0].force_kN', min: 800, max: 1600}\n"
    "uncertainty:\n"
    "  envelope:\n"
    "    - {name: speed, path: trains.A.speed_km_h, min: 10, max: 25}\n"
    "  parameters:\n"
    "    - {name: force, path: 'parts.zone.stages[0].force_kN', tolerance_percent: 10}\n"
    "    - {name: mass, path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 5}\n";

static const char checks[] = "checks:\n"
                             "  design_rules: false\n"
                             "  limits:\n"
                             "    - {name: crush, metric: elements.anti-climber *.stroke_mm,\n"
                             "       max: %d, source: ours, confidence: user}\n";

/* Crush by the closed form [m]; speed in km/h, mass as a factor, force in N. */
static double crush_at(double speed, double mass, double force) {
    const double v = speed / 3.6, energy = 20e3 * mass * v * v / 2;
    return energy / force - force / (2 * 500e6);
}

/* Error of the simulation at its default step, as a share of the limit. */
#define ERROR_OF_STEP 1e-4

static CzProblem *problem_with(int limit_mm, const char *more) {
    char text[4096];
    CzProblem *problem = NULL;
    CzError error = {0};
    int n = snprintf(text, sizeof text, "%s", two_masses);
    n += snprintf(text + n, sizeof text - (size_t)n, checks, limit_mm);
    n += snprintf(text + n, sizeof text - (size_t)n, "%s", more);
    const CzStatus status =
        cz_problem_read_text(text, (size_t)n, "two.yaml", ".", NULL, &problem, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    return problem;
}

static CzChallenge *challenge(const CzProblem *problem, const double *x,
                              const CzChallengeOptions *options) {
    CzChallenge *made = NULL;
    CzError error = {0};
    const CzStatus status = cz_challenge(problem, x, options, &made, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    return made;
}

static CzChallengeOptions runs(int n) {
    CzChallengeOptions options = cz_challenge_options_default();
    options.n_run = n;
    return options;
}

/* ---- the weakest point ---- */

static void the_weakest_point_is_the_corner_of_the_closed_form(void **state) {
    (void)state;
    CzProblem *problem = problem_with(400, "");
    const CzChallengeOptions options = runs(40);
    CzChallenge *made = challenge(problem, NULL, &options);
    const double least = 1 - crush_at(25, 1.05, 0.9e6) / 0.4;
    assert_true(least < 0 && 1 - crush_at(25, 1, 1e6) / 0.4 > least);
    assert_true(made->is_broken && made->judgement == CZ_VERDICT_FAIL);
    assert_int_equal(made->n_span, 1);
    const CzWeakPoint *weak = &made->weak[0];
    assert_string_equal(weak->check.name, "crush");
    assert_string_equal(weak->check.where, "anti-climber A1");
    assert_near(weak->check.margin, least, 0, ERROR_OF_STEP);
    assert_near(cz_challenge_value(made, weak->point, 0), 25, 0, 0);
    assert_near(cz_challenge_value(made, weak->point, 1), 0.9, 0, 0);
    assert_near(cz_challenge_value(made, weak->point, 2), 1.05, 0, 0);
    cz_challenge_free(made);
    cz_problem_free(problem);
}

/* Only a corner of the highest speed and mass and the lowest force bottoms out; no other check has
 * a margin that leads there. */
static void a_yes_or_no_without_a_margin_is_broken_too(void **state) {
    (void)state;
    static const char limits[] = "checks:\n"
                                 "  design_rules: false\n"
                                 "  limits:\n"
                                 "    - {name: bottoming, metric: elements.bottomed_out, max: 0,\n"
                                 "       source: ours, confidence: user}\n";
    char text[4096];
    CzProblem *problem = NULL;
    CzError error = {0};
    const int n = snprintf(text, sizeof text, "%s%s", two_masses, limits);
    memcpy(strstr(text, "2000"), " 550", 4);
    assert_true(crush_at(25, 1.05, 0.9e6) > 0.55 && crush_at(25, 1.05, 0.94e6) < 0.55 &&
                crush_at(25, 1, 0.9e6) < 0.55);
    assert_int_equal(cz_problem_read_text(text, (size_t)n, "two.yaml", ".", NULL, &problem, &error),
                     CZ_OK);
    const CzChallengeOptions options = runs(40);
    CzChallenge *made = challenge(problem, NULL, &options);
    assert_true(made->is_broken);
    assert_string_equal(made->weak[0].check.name, "bottoming");
    assert_true(isnan(made->weak[0].check.margin) && isnan(made->check[0].least));
    for (int i = 0; i < made->n_point; i++)
        if (strcmp(made->point[i].phase, "spread") == 0)
            assert_int_equal(made->point[i].verdict, CZ_VERDICT_PASS);
    cz_challenge_free(made);
    cz_problem_free(problem);
}

static void every_point_has_the_margin_of_the_closed_form(void **state) {
    (void)state;
    CzProblem *problem = problem_with(400, "");
    const CzChallengeOptions options = runs(40);
    CzChallenge *made = challenge(problem, NULL, &options);
    assert_true(made->n_point > 20 && made->n_point <= 40);
    for (int i = 0; i < made->n_point; i++) {
        const double speed = cz_challenge_value(made, i, 0);
        const double crush =
            crush_at(speed, cz_challenge_value(made, i, 2), 1e6 * cz_challenge_value(made, i, 1));
        assert_true(speed >= 10 && speed <= 25);
        assert_near(made->point[i].margin, 1 - crush / 0.4, 0, ERROR_OF_STEP);
    }
    assert_near(made->check[0].nominal, 1 - crush_at(20, 1, 1e6) / 0.4, 0, ERROR_OF_STEP);
    assert_true(made->check[0].least == made->point[made->check[0].worst].margin);
    cz_challenge_free(made);
    cz_problem_free(problem);
}

static void what_no_point_breaks_ends_with_its_smallest_margin(void **state) {
    (void)state;
    CzProblem *problem = problem_with(700, "");
    const CzChallengeOptions options = runs(40);
    CzChallenge *made = challenge(problem, NULL, &options);
    assert_false(made->is_broken);
    assert_int_equal(made->judgement, CZ_VERDICT_PASS);
    assert_int_equal(made->n_fail, 0);
    assert_int_equal(made->n_weak, 1);
    assert_near(made->weak[0].check.margin, 1 - crush_at(25, 1.05, 0.9e6) / 0.7, 0, ERROR_OF_STEP);
    cz_challenge_free(made);
    cz_problem_free(problem);
}

/* The point with the smallest margin is not a corner: at 21 km/h the crush is just at a limit below
 * it, and a second limit holds above. */
static void distinct_checks_are_listed_each_with_its_own_point(void **state) {
    (void)state;
    static const char more[] =
        "    - {name: light push, metric: elements.anti-climber *.stroke_mm,\n"
        "       min: 100, source: ours, confidence: user}\n";
    CzProblem *problem = problem_with(400, more);
    const CzChallengeOptions options = runs(60);
    CzChallenge *made = challenge(problem, NULL, &options);
    bool has_least = false, has_most = false;
    for (int i = 0; i < made->n_weak; i++) {
        const CzWeakPoint *weak = &made->weak[i];
        const double speed = cz_challenge_value(made, weak->point, 0);
        if (strcmp(weak->check.name, "light push") == 0 && speed < 10.01) {
            has_least = true;
            assert_near(weak->check.margin, crush_at(10, 0.95, 1.1e6) / 0.1 - 1, 0, 1e-2);
        }
        has_most |= strcmp(weak->check.name, "crush") == 0 && speed > 24.99;
        assert_true(i == 0 || weak[-1].check.margin <= weak->check.margin);
    }
    assert_true(has_least && has_most);
    cz_challenge_free(made);
    cz_problem_free(problem);
}

/* ---- designs ---- */

static void a_design_is_challenged_with_its_own_forces(void **state) {
    (void)state;
    CzProblem *problem = problem_with(400, "");
    const CzChallengeOptions options = runs(40);
    const double x = 1500;
    CzChallenge *made = challenge(problem, &x, &options);
    assert_false(made->is_broken);
    assert_near(made->weak[0].check.margin, 1 - crush_at(25, 1.05, 0.9 * 1.5e6) / 0.4, 0,
                ERROR_OF_STEP);
    cz_challenge_free(made);
    cz_problem_free(problem);
}

/* The changes of a weak point are those of a scenario: with them, the problem has its margin. */
static void a_weak_point_is_a_case_of_the_problem(void **state) {
    (void)state;
    CzProblem *problem = problem_with(400, ""), *extended = NULL;
    const CzChallengeOptions options = runs(20);
    CzChallenge *made = challenge(problem, NULL, &options);
    CzCaseChange change[8];
    char name[CZ_NAME_SIZE];
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation = {0};
    CzError error = {0};
    assert_int_equal(cz_challenge_n_change(made), 3);
    cz_challenge_changes(made, made->weak[0].point, change);
    cz_weak_point_name(made, 0, name);
    assert_string_equal(name, "collision-challenge-1");
    const CzCase added = {
        .name = name, .scenario = made->weak[0].scenario, .n_change = 3, .change = change};
    assert_int_equal(cz_problem_read_cases(problem, 1, &added, &extended, &error), CZ_OK);
    assert_int_equal(cz_evaluator_build(extended, NULL, &evaluator, &error), CZ_OK);
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, true, &evaluation, &error), CZ_OK);
    assert_int_equal(evaluation.verdict, CZ_VERDICT_FAIL);
    assert_true(evaluation.check[1].margin == made->weak[0].check.margin); /* the same bits */
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    /* a further challenge does not use the name again */
    CzChallenge *again = challenge(extended, NULL, &options);
    cz_weak_point_name(again, 0, name);
    assert_string_equal(name, "collision-challenge-2");
    cz_challenge_free(again);
    cz_problem_free(extended);
    cz_challenge_free(made);
    cz_problem_free(problem);
}

/* ---- threads, interruption, failures ---- */

static void the_points_do_not_depend_on_threads(void **state) {
    (void)state;
    CzProblem *problem = problem_with(400, "");
    CzChallengeOptions options = runs(50);
    options.n_job = 1;
    CzChallenge *one = challenge(problem, NULL, &options);
    options.n_job = 3;
    CzChallenge *three = challenge(problem, NULL, &options);
    assert_int_equal(one->n_point, three->n_point);
    assert_memory_equal(one->value, three->value,
                        (size_t)(one->n_point * one->n_draw) * sizeof *one->value);
    assert_memory_equal(one->margin, three->margin, (size_t)one->n_point * sizeof *one->margin);
    options.seed = 7;
    CzChallenge *other = challenge(problem, NULL, &options);
    assert_true(other->value[3] != three->value[3]);
    cz_challenge_free(one);
    cz_challenge_free(three);
    cz_challenge_free(other);
    cz_problem_free(problem);
}

static volatile sig_atomic_t stop;
static void stop_soon(int n_done, int n_run, void *data) {
    (void)data;
    assert_true(n_done <= n_run);
    stop |= n_done >= 24;
}

static void an_interruption_keeps_what_was_found(void **state) {
    (void)state;
    CzProblem *problem = problem_with(300, "");
    CzChallengeOptions options = runs(400);
    options.n_job = 1;
    options.stop = &stop;
    options.progress = stop_soon;
    stop = 0;
    CzChallenge *made = challenge(problem, NULL, &options);
    assert_true(made->is_interrupted && made->is_broken);
    assert_true(made->n_point >= 24 && made->n_point < 40);
    assert_true(made->n_weak > 0);
    stop = 1;
    CzChallenge *early = challenge(problem, NULL, &options);
    assert_true(early->is_interrupted && early->n_point == 0 && early->n_weak == 0);
    assert_int_equal(early->judgement, CZ_VERDICT_NOT_CHECKED);
    cz_challenge_free(made);
    cz_challenge_free(early);
    cz_problem_free(problem);
}

/* The problem with other values. */
static CzProblem *problem_again(const CzProblem *problem, int n, const char *const *path,
                                const char *const *value) {
    CzProblem *again = NULL;
    CzError error = {0};
    const CzStatus status = cz_problem_read_again(problem, n, path, value, &again, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    return again;
}

static void an_incomplete_run_is_a_weak_point(void **state) {
    (void)state;
    static const char *const path[] = {"uncertainty.envelope[0].path",
                                       "uncertainty.envelope[0].min",
                                       "uncertainty.envelope[0].max"};
    static const char *const value[] = {"simulation.longest_s", "0.05", "0.3"};
    CzProblem *problem = problem_with(700, ""), *again = problem_again(problem, 3, path, value);
    const CzChallengeOptions options = runs(30);
    CzChallenge *made = challenge(again, NULL, &options);
    assert_true(made->is_broken && made->n_failed > 0);
    assert_int_equal(made->weak[0].state, CZ_SAMPLE_RUN_FAILED);
    assert_non_null(strstr(made->weak[0].message, "collision: the run"));
    assert_null(made->weak[0].check.name);
    cz_challenge_free(made);
    cz_problem_free(again);
    cz_problem_free(problem);
}

static void values_that_no_problem_may_have_are_weak_points(void **state) {
    (void)state;
    static const char *const path[] = {"uncertainty.envelope[0].path",
                                       "uncertainty.envelope[0].min",
                                       "uncertainty.envelope[0].max"};
    static const char *const value[] = {"trains.A.vehicles.A1.front.face_gap_m", "-2", "5"};
    CzProblem *problem = problem_with(700, ""), *again = problem_again(problem, 3, path, value);
    const CzChallengeOptions options = runs(30);
    CzChallenge *made = challenge(again, NULL, &options);
    assert_true(made->is_broken && made->n_failed > 0);
    assert_int_equal(made->weak[0].state, CZ_SAMPLE_INVALID);
    cz_challenge_free(made);
    cz_problem_free(again);
    cz_problem_free(problem);
}

static void a_problem_without_numbers_to_vary_is_refused(void **state) {
    (void)state;
    const size_t n = (size_t)(strstr(two_masses, "uncertainty:") - two_masses);
    CzProblem *problem = NULL;
    CzChallenge *made = NULL;
    CzError error = {0};
    assert_int_equal(cz_problem_read_text(two_masses, n, "two.yaml", ".", NULL, &problem, &error),
                     CZ_OK);
    assert_int_equal(cz_challenge(problem, NULL, NULL, &made, &error), CZ_STATUS_INPUT);
    assert_string_equal(error.message, "the problem has neither an envelope nor scatter");
    assert_null(made);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_weakest_point_is_the_corner_of_the_closed_form),
        cmocka_unit_test(a_yes_or_no_without_a_margin_is_broken_too),
        cmocka_unit_test(every_point_has_the_margin_of_the_closed_form),
        cmocka_unit_test(what_no_point_breaks_ends_with_its_smallest_margin),
        cmocka_unit_test(distinct_checks_are_listed_each_with_its_own_point),
        cmocka_unit_test(a_design_is_challenged_with_its_own_forces),
        cmocka_unit_test(a_weak_point_is_a_case_of_the_problem),
        cmocka_unit_test(the_points_do_not_depend_on_threads),
        cmocka_unit_test(an_interruption_keeps_what_was_found),
        cmocka_unit_test(an_incomplete_run_is_a_weak_point),
        cmocka_unit_test(values_that_no_problem_may_have_are_weak_points),
        cmocka_unit_test(a_problem_without_numbers_to_vary_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
