/* Energies that are zero in an idle device: what a search sees of them (activation.h). */
#include "support/check.h"

#include "evaluate/evaluator.h"
#include "evaluate/small_problem.h"

/* Two equal cars of one mass, whose devices act one after the other. */
static const char cars[] =
    "schema: 1\n"
    "title: two cars\n"
    "catalogue: [problems/catalogue/rigid-cars.yaml]\n"
    "trains:\n"
    "  - {name: A, speed_km_h: 28, vehicles: [{use: light-cab-car}]}\n"
    "  - {name: B, reversed: true, speed_km_h: 0, vehicles: [{use: light-cab-car}]}\n";

enum { MAX_DETAIL = 4, N_DESIGN = 16 };

/* One limit over a range of one variable, from the most active device to the most idle one. */
typedef struct Sweep {
    double speed;      /* [km/h] */
    const char *limit; /* metric and limit as in a file */
    const char *path;
    double from, to;
} Sweep;

/* Details of a design at a place each, and its constraint. */
typedef struct Seen {
    double detail[N_DESIGN], constraint[N_DESIGN], margin[N_DESIGN];
    bool is_distance; /* and not a margin */
} Seen;

static Seen see(const Sweep *sweep) {
    char more[640];
    snprintf(more, sizeof more,
             "scenarios: [{name: crash, speed_km_h: %g, duration_ms: 500}]\n"
             "checks:\n  design_rules: false\n  limits:\n"
             "    - {name: idle, metric: %s}\n"
             "optimise: {variables: [{path: '%s', min: 1, max: 3000}]}\n",
             sweep->speed, sweep->limit, sweep->path);
    CzProblem *problem = problem_of_text(cars, more);
    CzEvaluator *evaluator = NULL;
    CzError error = {0};
    const CzEvaluatorOptions options = cz_evaluator_options_default();
    assert_int_equal(cz_evaluator_build(problem, &options, &evaluator, &error), CZ_OK);
    const int n = cz_evaluator_n_detail(evaluator);
    assert_in_range(n, 1, MAX_DETAIL);
    double x[N_DESIGN], detail[N_DESIGN * MAX_DETAIL];
    CzEvaluation evaluation[N_DESIGN] = {{0}};
    for (int i = 0; i < N_DESIGN; i++)
        x[i] = sweep->from + (sweep->to - sweep->from) * i / (N_DESIGN - 1);
    assert_int_equal(cz_evaluator_search(evaluator, N_DESIGN, x, evaluation, detail, &error),
                     CZ_OK);
    Seen seen;
    CzDetailKind kind[MAX_DETAIL];
    cz_evaluator_detail_kinds(evaluator, kind);
    seen.is_distance = kind[0] == CZ_DETAIL_ACTIVATION;
    for (int i = 0; i < N_DESIGN; i++) {
        seen.detail[i] = -INFINITY;
        for (int k = 0; k < n; k++)
            seen.detail[i] = fmax(seen.detail[i], detail[i * n + k]);
        seen.constraint[i] = evaluation[i].constraint[0];
        seen.margin[i] = evaluation[i].constraint_check[0].margin;
        cz_evaluation_free(&evaluation[i]);
    }
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return seen;
}

static const Sweep sweeps[] = {
    {36, "elements.end *.energy_kJ, max: 0.1", "parts.light-anti-climber.stages[0].stroke_mm", 150,
     450},
    {50, "energy.survival_kJ, max: 0.1", "parts.light-anti-climber.stages[0].stroke_mm", 50, 800},
    {20, "elements.anti-climber *.energy_kJ, max: 0.1", "parts.light-anti-climber.gap_mm", 100,
     400},
    {5, "elements.coupler *.tube_energy_kJ, max: 0.1", "parts.light-head-tube.stages[0].force_kN",
     100, 600},
    {20, "elements.anti-climber *.energy_kJ, max: 20", "parts.light-anti-climber.gap_mm", 100, 400},
};
enum { N_SWEEP = sizeof sweeps / sizeof *sweeps };

/* Whatever a search sees, it is violated exactly where the check is, whose margin stays. */
static void a_continued_constraint_is_violated_where_the_check_is(void **state) {
    (void)state;
    for (int s = 0; s < N_SWEEP; s++) {
        const Seen seen = see(&sweeps[s]);
        assert_true(seen.constraint[0] > 0); /* the sweep reaches both sides */
        assert_near(seen.margin[N_DESIGN - 1], 1, 0, 0);
        for (int i = 0; i < N_DESIGN; i++) {
            assert_int_equal(seen.detail[i] > 0, seen.constraint[i] > 0);
            assert_near(seen.constraint[i], -seen.margin[i], 0, 0);
        }
    }
}

/* The margin of an idle device is 100 % whatever the design, and below -1000 % once it crushes. */
static void an_energy_that_must_be_zero_has_a_slope_on_both_sides(void **state) {
    (void)state;
    for (int s = 0; s < N_SWEEP; s++) {
        const Seen seen = see(&sweeps[s]);
        double steepest = 0;
        for (int i = 1; i < N_DESIGN; i++) {
            assert_true(seen.detail[i] < seen.detail[i - 1] - 1e-4);
            steepest = fmax(steepest, seen.detail[i - 1] - seen.detail[i]);
        }
        if (!seen.is_distance)
            continue;
        assert_true(steepest < 0.3); /* shares of a stroke or force, where the margin falls by 20 */
        assert_true(fabs(seen.detail[0]) < 1.5);
    }
}

/* A limit that allows some energy has a margin up to it, which is kept. */
static void a_limit_that_allows_some_energy_keeps_its_margins(void **state) {
    (void)state;
    const Seen seen = see(&sweeps[N_SWEEP - 1]);
    assert_false(seen.is_distance);
    for (int i = 0; i < N_DESIGN; i++)
        if (seen.margin[i] < 1)
            assert_near(seen.detail[i], -seen.margin[i], 0, 0);
    for (int s = 0; s < N_SWEEP - 1; s++)
        assert_true(see(&sweeps[s]).is_distance);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_continued_constraint_is_violated_where_the_check_is),
        cmocka_unit_test(an_energy_that_must_be_zero_has_a_slope_on_both_sides),
        cmocka_unit_test(a_limit_that_allows_some_energy_keeps_its_margins),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
