/* Where the smallest margin is capped, a search maximises the next ones. */
#include "support/check.h"

#include "crushzone/optimise.h"
#include "evaluate/small_problem.h"

/* The shear-off force is at its lower bound, so that its margin cannot grow: 1 - 1250 / 1364. */
static const char capped[] =
    "schema: 1\n"
    "title: two cars\n"
    "catalogue: [problems/catalogue/rigid-cars.yaml]\n"
    "simulation: {time_step_ms: 0.2}\n"
    "trains:\n"
    "  - {name: A, speed_km_h: 34, vehicles: [{use: light-cab-car}]}\n"
    "  - {name: B, reversed: true, speed_km_h: 0, vehicles: [{use: light-cab-car}]}\n"
    "set: {parts.light-shear-off.force_kN: 1250}\n"
    "scenarios: [{name: crash, duration_ms: 400}]\n"
    "checks:\n"
    "  design_rules: false\n"
    "  limits:\n"
    "    - {name: shear-off, metric: ends.shear_off_over_strength, max: 0.9091}\n"
    "    - {name: deceleration, metric: vehicles.mean_deceleration_120ms_g, max: 5}\n"
    "    - {name: stroke, metric: elements.anti-climber *.stroke_demand, max: 0.9}\n"
    "    - {name: length, metric: design.installed_length_mm, max: 1500}\n";

static const char variables[] =
    "optimise:\n"
    "  evaluations: 120\n"
    "  variables:\n"
    "    - {path: parts.light-shear-off.force_kN, min: 1250, max: 1350}\n"
    "    - {path: 'parts.light-anti-climber.stages[0].force_kN', min: 250, max: 700}\n"
    "    - {path: 'parts.light-anti-climber.stages[0].stroke_mm', min: 200, max: 500}\n";

enum { N_VARIABLE = 3, N_GRID = 9 };

typedef struct Case {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzOutcome *outcome;
} Case;

static Case optimise(const char *more) {
    Case made = {.problem = problem_of_text(capped, more)};
    CzError error = {0};
    CzEvaluatorOptions options = cz_evaluator_options_default();
    CzOptimiseOptions search = cz_optimise_options_default();
    search.verify_methods = 0;
    assert_int_equal(cz_evaluator_build(made.problem, &options, &made.evaluator, &error), CZ_OK);
    assert_int_equal(cz_optimise(made.evaluator, &search, &made.outcome, &error), CZ_OK);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_FEASIBLE);
    return made;
}

static void end(Case *made) {
    cz_outcome_free(made->outcome);
    cz_evaluator_free(made->evaluator);
    cz_problem_free(made->problem);
}

/* The smallest margin of a design among the constraints that are not capped. */
static double smallest_free(const CzOutcome *outcome, const CzEvaluation *evaluation) {
    double smallest = INFINITY;
    for (int j = 0; j < evaluation->n_constraint; j++) {
        bool is_counted = !evaluation->constraint_check[j].is_flag;
        for (int i = 0; i < outcome->n_margin; i++)
            is_counted &= !outcome->margin[i].is_capped || outcome->margin[i].constraint != j;
        if (is_counted && strncmp(evaluation->constraint_check[j].scenario, "design", 6) == 0 &&
            strcmp(evaluation->constraint_check[j].name, "length") != 0)
            continue; /* a rule of files */
        if (is_counted)
            smallest = fmin(smallest, evaluation->constraint_check[j].margin);
    }
    return smallest;
}

/* The best of a grid of designs over the variables that are free. */
static double best_of_grid(Case *made) {
    double x[N_GRID * N_GRID * N_VARIABLE], best = -INFINITY;
    CzEvaluation evaluation[N_GRID * N_GRID] = {{0}};
    CzError error = {0};
    for (int i = 0; i < N_GRID * N_GRID; i++) {
        x[N_VARIABLE * i] = 1250;
        x[N_VARIABLE * i + 1] = 250 + 450.0 * (i % N_GRID) / (N_GRID - 1);
        x[N_VARIABLE * i + 2] = 200 + 300.0 * (i / N_GRID) / (N_GRID - 1);
    }
    assert_int_equal(cz_evaluate(made->evaluator, N_GRID * N_GRID, x, false, evaluation, &error),
                     CZ_OK);
    for (int i = 0; i < N_GRID * N_GRID; i++) {
        best = fmax(best, smallest_free(made->outcome, &evaluation[i]));
        cz_evaluation_free(&evaluation[i]);
    }
    return best;
}

static void next_margin_is_maximised_when_the_smallest_is_capped(void **state) {
    (void)state;
    Case made = optimise(variables);
    const CzOutcome *outcome = made.outcome;
    assert_true(outcome->n_margin >= 2);
    assert_true(outcome->margin[0].is_capped);
    assert_string_equal(cz_evaluator_constraint_name(made.evaluator, outcome->margin[0].constraint),
                        "shear-off, design");
    assert_near(outcome->best[0], 1250, 0, 0);
    assert_near(outcome->margin[0].margin, 1 - 1250 / 1500.0 / 0.9091, ROUNDING_OF_A_SUM, 0);
    const double next = smallest_free(outcome, &outcome->best_evaluation);
    const double best = best_of_grid(&made);
    assert_true(next > best - 0.002);
    for (int i = 1; i < outcome->n_margin; i++)
        assert_true(outcome->margin[i - 1].margin <= outcome->margin[i].margin);
    end(&made);
}

/* With the shear-off force at the other end of its bounds the margin can grow, and does first. */
static void a_margin_that_can_grow_comes_first(void **state) {
    (void)state;
    char more[640];
    snprintf(more, sizeof more, "%s", variables);
    memcpy(strstr(more, "min: 1250"), "min:  950", 9);
    Case made = optimise(more);
    assert_true(made.outcome->best[0] < 1100);
    assert_false(made.outcome->margin[0].is_capped);
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(next_margin_is_maximised_when_the_smallest_is_capped),
        cmocka_unit_test(a_margin_that_can_grow_comes_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
