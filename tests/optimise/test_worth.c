/* The condition of an optimum with its multipliers, and the relaxation of a limit, on a stand-in
 * simulator with a closed form: an anti-climber of force F and stroke s that has to absorb the
 * energy E uses E / (F s) of its stroke. */
#include "support/check.h"

#include "evaluate/stand_in.h"
#include "optimise/loopholes.h"

static const char shortest[] =
    "optimise:\n"
    "  subject_to: [stroke used]\n"
    "  minimise: design.installed_length_mm\n"
    "  evaluations: 200\n"
    "  variables:\n"
    "    - {path: \"parts.anti-climber.stages[0].stroke_mm\", min: 20, max: %d, "
    "start: 50}\n";

static Case find_shortest_by(int most_stroke, long evaluations) {
    char more[512];
    snprintf(more, sizeof more, shortest, most_stroke);
    stand_in_reset();
    Case made = begin(more, 1);
    CzOptimiseOptions options = cz_optimise_options_default();
    options.verify_methods = 0;
    options.evaluations = evaluations;
    optimise(&made, &options);
    return made;
}

static Case find_shortest(int most_stroke) {
    return find_shortest_by(most_stroke, 200);
}

/* The limit is c = s0 / s - 1 with its optimum at s0, whose secant over h is -1 / (s0 + h), and the
 * length is k s. A margin that is larger by 0.01 is then worth 0.01 k (s0 + h). */
static void multiplier_of_a_stroke_is_that_of_the_closed_form(void **state) {
    (void)state;
    Case made = find_shortest(900);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    const double h = outcome->sensitivity_increment[0];
    const double per_stroke = outcome->objective_change[0] / h;
    assert_true(h > 0 && per_stroke > 0);
    assert_near(outcome->stationarity, 0, 0, ROUNDING_OF_A_FORMULA);
    assert_int_equal(outcome->n_multiplier, 1);
    const CzMultiplier *multiplier = outcome->multiplier;
    assert_true(multiplier->constraint >= 0 && multiplier->variable < 0);
    assert_string_equal(outcome->best_evaluation.constraint_check[multiplier->constraint].name,
                        "stroke used");
    /* the search ends within 1e-3 of the limit */
    assert_near(multiplier->worth, 0.01 * per_stroke * (outcome->best[0] + h), 2e-3, 0);
    assert_null(outcome->relaxation.x);
    end(&made);
}

/* Up to 60 mm the stroke does not suffice: the limit has to be what the longest one uses. */
static void relaxed_limit_is_what_the_best_design_needs(void **state) {
    (void)state;
    Case made = find_shortest(60);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_INFEASIBLE);
    int n_violated = 0;
    for (int j = 0; j < outcome->best_evaluation.n_constraint; j++)
        n_violated += outcome->best_evaluation.constraint[j] > 0;
    assert_int_equal(n_violated, 1);
    assert_near(outcome->best[0], 60, 1e-6, 0);
    const CzRelaxation *relaxation = &outcome->relaxation;
    assert_true(relaxation->x != NULL && relaxation->n_evaluation > 0);
    const CzCheckResult *check = &outcome->best_evaluation.constraint_check[relaxation->constraint];
    assert_near(relaxation->x[0], 60, 1e-6, 0);
    assert_near(relaxation->limit, check->value, 1e-6, 0);
    assert_near(relaxation->violation, check->value / check->limit - 1, 1e-6, 0);
    assert_non_null(outcome->multiplier);
    end(&made);
}

/* A short search may miss what the search for a relaxation finds: then that is the result. */
static void design_that_needs_no_relaxation_is_the_result(void **state) {
    (void)state;
    int n_found_later = 0;
    for (long evaluations = 1; evaluations <= 8; evaluations++) {
        Case made = find_shortest_by(900, evaluations);
        const CzOutcome *outcome = made.outcome;
        if (outcome->status == CZ_OUTCOME_INFEASIBLE)
            assert_true(outcome->relaxation.x == NULL || outcome->relaxation.violation > 0);
        else
            assert_true(outcome->best_evaluation.violation <= 0 && outcome->relaxation.x == NULL);
        n_found_later += strstr(outcome->why_stopped, "relaxed one limit") != NULL;
        end(&made);
    }
    assert_true(n_found_later > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(multiplier_of_a_stroke_is_that_of_the_closed_form),
        cmocka_unit_test(relaxed_limit_is_what_the_best_design_needs),
        cmocka_unit_test(design_that_needs_no_relaxation_is_the_result),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
