/* Searches against scatter: the optimum of a closed form, a scatter that no design bears, and what
 * a stop leaves. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "support/check.h"

#include "crushzone/robust.h"
#include "evaluate/evaluator.h"

/* Two rigid vehicles of 40 t, 25 km/h, and one plateau F with an elastic stiffness k, between a
 * limit on the crush and one on the force:
 *
 *   crush = E / F - F / (2 k)      force = F
 */
static const char two_masses[] =
    "schema: 1\n"
    "title: one plateau between two limits\n"
    "parts:\n"
    "  zone: {gap_mm: 0, stiffness_MN_m: 500, stages: [{stroke_mm: 2000, force_kN: 900}]}\n"
    "trains:\n"
    "  - name: A\n"
    "    speed_km_h: 25\n"
    "    vehicles:\n"
    "      - {name: A1, model: rigid, mass_t: 40, front: {face_gap_m: 5, anti_climber: {use: "
    "zone}}}\n"
    "  - name: B\n"
    "    vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {face_gap_m: 0}}]\n"
    "simulation: {longest_s: 6}\n"
    "checks:\n"
    "  design_rules: false\n"
    "  limits:\n"
    "    - {name: crush, metric: elements.anti-climber *.stroke_mm, max: 600, confidence: user}\n"
    "    - {name: force, metric: interfaces.peak_force_kN, max: 1300, confidence: user}\n"
    "optimise:\n"
    "  variables: [{path: 'parts.zone.stages[0].force_kN', min: 600, max: 1500}]\n"
    "  evaluations: 120\n";

static double crush_margin(double force, double mass) {
    const double speed = 25 / 3.6, energy = mass * 20e3 * speed * speed / 2;
    return 1 - (energy / force - force / (2 * 500e6)) / 0.6;
}

static double force_margin(double force) {
    return 1 - force / 1300e3;
}

/* The force whose smallest margin is largest in n samples of factors on force and mass (n x 2). */
static double best_force(int n, const double *factor) {
    double from = 600e3, to = 1500e3;
    for (int i = 0; i < 60; i++) {
        const double force = (from + to) / 2;
        double crush = INFINITY, limit = INFINITY;
        for (int k = 0; k < n; k++) {
            crush = fmin(crush, crush_margin(force * factor[2 * k], factor[2 * k + 1]));
            limit = fmin(limit, force_margin(force * factor[2 * k]));
        }
        *(crush < limit ? &from : &to) = force;
    }
    return from;
}

/* A problem with more text at its end. */
static CzProblem *read_with(const char *more) {
    char text[4096];
    CzProblem *problem = NULL;
    CzError error = {0};
    const int n = snprintf(text, sizeof text, "%s%s", two_masses, more);
    if (cz_problem_read_text(text, (size_t)n, "text", ".", NULL, &problem, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return problem;
}

static CzRobust *search(const CzProblem *problem, int n_job, const volatile sig_atomic_t *stop) {
    CzRobust *robust = NULL;
    CzError error = {0};
    CzEvaluatorOptions of_runs = cz_evaluator_options_default();
    CzOptimiseOptions options = cz_optimise_options_default();
    of_runs.n_job = n_job;
    options.verify_methods = 0;
    options.stop = stop;
    assert_true(cz_robust_is_asked(problem));
    if (cz_optimise_robust(problem, &of_runs, &options, &robust, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return robust;
}

static const char scatter[] =
    "uncertainty:\n"
    "  samples: 20\n"
    "  parameters:\n"
    "    - {path: 'parts.zone.stages[0].force_kN', tolerance_percent: 10}\n"
    "    - {path: 'trains.*.vehicles.*.mass_t', tolerance_percent: 10}\n";

/* The nominal optimum is where both margins are equal; against scatter, where those of two samples
 * are. */
static void the_optimum_against_scatter_is_that_of_the_closed_form(void **state) {
    (void)state;
    CzProblem *problem = read_with(scatter);
    CzRobust *robust = search(problem, 0, NULL);
    const CzSampling *sampling = robust->sampling;
    const double as_written[2] = {1, 1};
    const double force = best_force(sampling->n_sample, sampling->value);
    assert_int_equal(sampling->n_draw, 2);
    assert_true(force > 1.02 * best_force(1, as_written));
    assert_near(1e3 * robust->outcome->best[0], force, 2e-3, 0);
    assert_int_equal(robust->outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_int_equal(sampling->passing.n_pass, 20);
    assert_true(robust->n_round >= 2);
    assert_true(cz_problem_n_scenario(robust->problem) >= 3);
    cz_robust_free(robust);
    cz_problem_free(problem);
}

static void threads_do_not_matter(void **state) {
    (void)state;
    CzProblem *problem = read_with(scatter);
    CzRobust *one = search(problem, 1, NULL), *two = search(problem, 2, NULL);
    assert_int_equal(one->outcome->n_trial, two->outcome->n_trial);
    assert_memory_equal(one->outcome->trial_x, two->outcome->trial_x,
                        (size_t)one->outcome->n_trial * sizeof(double));
    assert_memory_equal(one->outcome->best, two->outcome->best, sizeof(double));
    cz_robust_free(one);
    cz_robust_free(two);
    cz_problem_free(problem);
}

/* The search of a few designs finds the nominal optimum, which is worse in samples. */
static void a_start_that_holds_is_kept(void **state) {
    (void)state;
    CzProblem *problem = read_with(scatter);
    CzRobust *first = search(problem, 0, NULL), *again = NULL;
    CzOptimiseOptions options = cz_optimise_options_default();
    CzError error = {0};
    options.verify_methods = 0;
    options.evaluations = 12;
    options.start = first->outcome->best;
    assert_int_equal(cz_optimise_robust(problem, NULL, &options, &again, &error), CZ_OK);
    assert_int_equal(again->round[0].n_evaluation, 0);
    assert_true(again->round[0].is_best);
    assert_true(again->round[1].required_margin < again->round[0].required_margin - 0.01);
    assert_int_equal(again->outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_near(again->outcome->best[0], first->outcome->best[0], 0, 0);
    cz_robust_free(first);
    cz_robust_free(again);
    cz_problem_free(problem);
}

/* No force bears a scatter of 40 %: never a success with a violated statistic. */
static void too_much_scatter_is_not_feasible(void **state) {
    (void)state;
    CzProblem *problem = read_with(
        "uncertainty:\n"
        "  samples: 20\n"
        "  parameters: [{path: 'parts.zone.stages[0].force_kN', tolerance_percent: 40}]\n");
    CzRobust *robust = search(problem, 0, NULL);
    assert_int_equal(robust->outcome->status, CZ_OUTCOME_INFEASIBLE);
    assert_non_null(strstr(robust->outcome->why_stopped, "fails in samples"));
    assert_true(robust->sampling->passing.n_pass < 20);
    cz_robust_free(robust);
    cz_problem_free(problem);
}

/* A quantile and a mean less deviations ask for less than the worst sample, so that designs with a
 * better nominal margin are found. */
static void other_statistics_ask_for_less(void **state) {
    (void)state;
    static const char *const statistics[] = {"", "  judged_by: quantile\n  quantile: 0.8\n",
                                             "  judged_by: mean_minus\n  deviations: 1\n"};
    double required[3];
    for (int i = 0; i < 3; i++) {
        char more[512];
        snprintf(more, sizeof more, "%s%s", scatter, statistics[i]);
        CzProblem *problem = read_with(more);
        CzRobust *robust = search(problem, 0, NULL);
        assert_int_equal(robust->outcome->status, CZ_OUTCOME_FEASIBLE);
        required[i] = INFINITY;
        for (int c = 0; c < robust->sampling->n_check; c++)
            required[i] = fmin(required[i], robust->sampling->check[c].required);
        cz_robust_free(robust);
        cz_problem_free(problem);
    }
    assert_true(required[1] > required[0] + 0.01);
    assert_true(required[2] > required[0] + 0.01);
}

static void a_stop_ends_the_search(void **state) {
    (void)state;
    const volatile sig_atomic_t stop = 1;
    CzProblem *problem = read_with(scatter);
    CzRobust *robust = search(problem, 0, &stop);
    assert_int_equal(robust->outcome->status, CZ_OUTCOME_INTERRUPTED);
    cz_robust_free(robust);
    cz_problem_free(problem);
}

/* Stops a search when the samples of a round after the first are to be run. */
static void stop_in_second_judgement(const CzProgress *progress, void *data) {
    volatile sig_atomic_t *stop = data;
    if (progress->phase != NULL && strcmp(progress->phase, "samples") == 0 && progress->feasible)
        *stop = 1; /* only a round that was judged has a design that passes */
}

static void a_judgement_that_was_cut_short_is_no_better(void **state) {
    (void)state;
    CzProblem *problem = read_with(scatter);
    CzRobust *robust = NULL;
    CzError error = {0};
    volatile sig_atomic_t stop = 0;
    CzOptimiseOptions options = cz_optimise_options_default();
    options.verify_methods = 0;
    options.stop = &stop;
    options.progress = stop_in_second_judgement;
    options.progress_data = (void *)&stop;
    assert_int_equal(cz_optimise_robust(problem, NULL, &options, &robust, &error), CZ_OK);
    assert_int_equal(robust->outcome->status, CZ_OUTCOME_INTERRUPTED);
    assert_int_equal(robust->n_round, 2);
    assert_true(robust->round[0].is_best);
    assert_int_equal(robust->sampling->n_run, 20);
    cz_robust_free(robust);
    cz_problem_free(problem);
}

/* A range in place of a tolerance would replace the design's own value. */
static void a_range_of_a_variable_is_refused(void **state) {
    (void)state;
    CzProblem *problem =
        read_with("uncertainty:\n"
                  "  samples: 4\n"
                  "  parameters: [{path: 'parts.zone.stages[0].force_kN', min: 800, max: 1000}]\n");
    CzRobust *robust = NULL;
    CzError error = {0};
    assert_int_equal(cz_optimise_robust(problem, NULL, NULL, &robust, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "replaces the value of a design variable"));
    assert_null(robust);
    cz_problem_free(problem);
}

static void only_problems_with_scatter_ask_for_it(void **state) {
    (void)state;
    CzProblem *problem = read_with("");
    assert_false(cz_robust_is_asked(problem));
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_optimum_against_scatter_is_that_of_the_closed_form),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(a_start_that_holds_is_kept),
        cmocka_unit_test(too_much_scatter_is_not_feasible),
        cmocka_unit_test(other_statistics_ask_for_less),
        cmocka_unit_test(a_stop_ends_the_search),
        cmocka_unit_test(a_judgement_that_was_cut_short_is_no_better),
        cmocka_unit_test(a_range_of_a_variable_is_refused),
        cmocka_unit_test(only_problems_with_scatter_ask_for_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
