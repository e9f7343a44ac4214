/* Bounds of a search: which commands check them, fixed variables, the reason of the end; and rules
 * between values, which the best design of any search satisfies. On the stand-in simulator. */
#include "support/check.h"

#include "evaluate/metric.h"
#include "evaluate/stand_in.h"
#include "optimise/loopholes.h"
#include "problem/problem.h"

/* ---- bounds bind the search alone ------------------------------------------------------------ */

static void only_a_search_checks_bounds(void **state) {
    (void)state;
    stand_in_reset();
    static const char *const set[] = {"parts.tube.stages[0].stroke_mm=300.0000001"};
    static const char more[] =
        "optimise:\n"
        "  variables: [{path: \"parts.tube.stages[0].stroke_mm\", min: 100, max: 300}]\n";
    Case made = {0};
    CzError error = {0};
    assert_int_equal(small_problem_read(more, 1, set, &made.problem, &error), CZ_OK);
    const CzEvaluatorOptions options = {.n_job = 1, .step_factor = 1};
    CzEvaluation evaluation;
    assert_int_equal(cz_evaluator_build(made.problem, &options, &made.evaluator, &error), CZ_OK);
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, false, &evaluation, &error), CZ_OK);
    assert_int_equal(evaluation.status, CZ_OK);
    cz_evaluation_free(&evaluation);
    assert_int_equal(cz_optimise_check(made.evaluator, NULL, &error), CZ_STATUS_INPUT);
    assert_string_equal(error.message,
                        "the starting value 300.0000001 of 'parts.tube.stages[0].stroke_mm' is "
                        "outside its bounds, 100 to 300 mm");
    assert_int_equal(error.line, 30);
    assert_int_equal(cz_optimise(made.evaluator, NULL, &made.outcome, &error), CZ_STATUS_INPUT);
    end(&made);
}

/* A stroke typed in mm is stored in m; the rounding of the conversion does not violate a bound. */
static void a_start_on_its_bound_is_within_it_whatever_the_unit(void **state) {
    (void)state;
    stand_in_reset();
    for (int tenth = 1001; tenth < 1100; tenth += 7) {
        char more[256], path[64];
        const char *const set[] = {path};
        CzError error = {0};
        Case made = {0};
        snprintf(path, sizeof path, "parts.tube.stages[0].stroke_mm=%.1f", 0.1 * tenth);
        snprintf(more, sizeof more,
                 "optimise:\n  variables:\n"
                 "    - {path: \"parts.tube.stages[0].stroke_mm\", min: %.1f, max: 300}\n",
                 0.1 * tenth);
        assert_int_equal(small_problem_read(more, 1, set, &made.problem, &error), CZ_OK);
        const CzEvaluatorOptions options = {.n_job = 1, .step_factor = 1};
        assert_int_equal(cz_evaluator_build(made.problem, &options, &made.evaluator, &error),
                         CZ_OK);
        assert_int_equal(cz_optimise_check(made.evaluator, NULL, &error), CZ_OK);
        end(&made);
    }
}

/* Bounds are in the unit of the first path, also where other paths have another unit. */
static void tied_places_of_other_units_share_the_bounds(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin("optimise:\n  variables:\n"
                      "    - {paths: [\"parts.tube.stages[0].stroke_mm\","
                      " \"parts.anti-climber.stages[0].stroke_m\"], min: 100, max: 700}\n",
                      1);
    const CzVariableInfo *stroke = cz_evaluator_variable(made.evaluator, 0);
    assert_near(stroke->place[1].factor, 1e-3, 1e-18, 0);
    assert_near(stroke->max, 700, 0, 0);
    end(&made);
}

/* ---- fixed variables ---------------------------------------------------------------------- */

#define VARIED                                                                                     \
    "checks: {design_rules: false,\n"                                                              \
    "  limits: [{name: used, metric: elements.stroke_used, max: 0.8}]}\n"                          \
    "optimise:\n"                                                                                  \
    "  minimise: design.installed_length_mm\n"                                                     \
    "  evaluations: 80\n"                                                                          \
    "  variables:\n"                                                                               \
    "    - {path: \"parts.anti-climber.stages[0].stroke_mm\", min: 100, max: 700, increment: "     \
    "10}\n"

static void fixed_variables_cost_no_evaluation_and_are_reported(void **state) {
    (void)state;
    stand_in_reset();
    Case alone = begin(VARIED, 1);
    optimise(&alone, NULL);
    Case made =
        begin(VARIED "    - {path: \"parts.tube.stages[0].stroke_mm\", min: 230, max: 290,"
                     " increment: 250}\n"
                     "    - {path: \"parts.tube.stages[0].force_kN\", min: 800, max: 800}\n",
              1);
    optimise(&made, NULL);
    const CzVariableInfo *stroke = cz_evaluator_variable(made.evaluator, 1);
    const CzVariableInfo *force = cz_evaluator_variable(made.evaluator, 2);
    assert_false(cz_evaluator_variable(made.evaluator, 0)->is_fixed);
    assert_true(stroke->is_fixed && force->is_fixed);
    assert_near(stroke->fixed_at, 250, 0, 0);
    assert_near(force->fixed_at, 800, 0, 0);
    assert_int_equal(made.outcome->n_evaluation, alone.outcome->n_evaluation);
    assert_near(made.outcome->best[0], alone.outcome->best[0], 0, 0);
    assert_near(made.outcome->best[1], 250, 0, 0);
    assert_false(made.outcome->at_bound[1] || made.outcome->at_bound[2]);
    assert_string_equal(made.outcome->why_stopped, alone.outcome->why_stopped);
    end(&made);
    end(&alone);
}

static void a_search_without_free_variables_reports_it(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin(
        "optimise:\n  evaluations: 60\n  variables:\n"
        "    - {path: \"parts.tube.stages[0].stroke_mm\", min: 240, max: 270, increment: 250}\n",
        1);
    optimise(&made, NULL);
    assert_int_equal(made.outcome->n_evaluation, 1);
    assert_string_equal(made.outcome->why_stopped,
                        "no variable can vary: each has one value within its bounds");
    end(&made);
}

/* ---- lists of sizes ----------------------------------------------------------------------- */

/* VARIED with these sizes in place of bounds and increment. */
static Case optimise_sizes(const char *sizes) {
    char more[1024];
    const char *bounds = strstr(VARIED, "min: 100");
    stand_in_reset();
    snprintf(more, sizeof more, "%.*svalues: %s}\n", (int)(bounds - VARIED), VARIED, sizes);
    Case made = begin(more, 1);
    optimise(&made, NULL);
    return made;
}

/* The sizes are far from equidistant, and the file's own value is between two of them. */
static void a_search_ends_at_the_best_size_of_a_list(void **state) {
    (void)state;
    stand_in_reset();
    Case free = begin(VARIED, 1);
    optimise(&free, NULL);
    Case made = optimise_sizes("[101, 250.5, 333.25, 419, 420, 690]");
    const CzVariableInfo *info = cz_evaluator_variable(made.evaluator, 0);
    assert_int_equal(info->n_value, 6);
    assert_near(info->min, 101, 0, 0);
    assert_near(info->max, 690, 0, 0);
    int expected = 0; /* the smallest size that the continuous optimum allows */
    while (info->value[expected] < made.outcome->best[0] - 1e-9)
        expected++;
    assert_near(made.outcome->best[0], info->value[expected], 0, 0);
    assert_true(made.outcome->best[0] >= free.outcome->best[0] - 10);
    assert_true(expected == 0 || info->value[expected - 1] < free.outcome->best[0]);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_null(strstr(made.outcome->why_stopped, "between catalogue increments"));
    end(&made);
    end(&free);
}

static void a_list_of_one_size_is_a_fixed_variable(void **state) {
    (void)state;
    Case made = optimise_sizes("[400]");
    assert_true(cz_evaluator_variable(made.evaluator, 0)->is_fixed);
    assert_near(made.outcome->best[0], 400, 0, 0);
    end(&made);
}

/* ---- why it ended ---------------------------------------------------------------------------- */

static void the_reason_of_the_end_has_exact_numbers(void **state) {
    (void)state;
    for (long limit = 1; limit < 90; limit += 4) {
        stand_in_reset();
        Case made = begin(VARIED, 1);
        CzOptimiseOptions options = cz_optimise_options_default();
        char text[160];
        options.evaluations = limit;
        options.verify_methods = 0;
        optimise(&made, &options);
        const long left = limit - made.outcome->n_evaluation;
        const char *why = made.outcome->why_stopped;
        snprintf(text, sizeof text, "the limit of %ld evaluations is reached", limit);
        const bool at_limit = strncmp(why, text, strlen(text)) == 0;
        snprintf(text, sizeof text, "%ld of %ld evaluations left, all reserved", left, limit);
        assert_true(left >= 0);
        assert_true(left == 0 ? at_limit || strstr(why, "no further improvement") == why
                              : strncmp(why, text, strlen(text)) == 0 ||
                                    strstr(why, "no further improvement") == why);
        end(&made);
    }
}

/* ---- rules between values -------------------------------------------------------------------- */

/* Reads the problem with a design's values typed in. */
static CzStatus read_back(const CzEvaluator *evaluator, const char *more, const double *x,
                          CzError *error) {
    char text[64][192];
    const char *set[64];
    int n = 0;
    for (int i = 0; i < cz_evaluator_n_variable(evaluator); i++)
        for (int k = 0; k < cz_evaluator_variable(evaluator, i)->n_place; k++) {
            const CzVariablePlace *place = &cz_evaluator_variable(evaluator, i)->place[k];
            snprintf(text[n], sizeof text[n], "%s=%.17g", place->path, x[i] * place->factor);
            set[n] = text[n];
            n++;
        }
    CzProblem *problem = NULL;
    const CzStatus status = small_problem_read(more, n, set, &problem, error);
    cz_problem_free(problem);
    return status;
}

/* Every kind of variable, within bounds that violate every rule, under one limit. */
#define WIDELY(limit)                                                                              \
    "set:\n"                                                                                       \
    "  parts.tube.trigger_kN: 900\n"                                                               \
    "  parts.tube.installed_length_mm: 450\n"                                                      \
    "  parts.tube.mass_per_stroke_kg_m: 900\n"                                                     \
    "  parts.anti-climber.trigger_kN: 400\n"                                                       \
    "  parts.anti-climber.mass_per_stroke_kg_m: 900\n"                                             \
    "  parts.head.coupler.length_m: 0.9\n"                                                         \
    "  parts.head.coupler.buffer.preload_kN: 50\n"                                                 \
    "checks: {design_rules: false, limits: [{name: pull, metric: " limit "}]}\n"                   \
    "optimise:\n"                                                                                  \
    "  variables:\n"                                                                               \
    "    - {path: \"parts.tube.stages[0].force_kN\", min: 0, max: 1000}\n"                         \
    "    - {path: \"parts.tube.stages[0].stroke_mm\", min: 50, max: 1200}\n"                       \
    "    - {path: \"parts.tube.trigger_kN\", min: 850, max: 1000}\n"                               \
    "    - {path: \"parts.anti-climber.stages[0].stroke_mm\", min: 200, max: 3000}\n"              \
    "    - {path: \"parts.anti-climber.gap_mm\", min: 0, max: 2500}\n"                             \
    "    - {path: \"parts.head.coupler.buffer.stages[0].force_kN\", min: 0, max: 500}\n"           \
    "    - {path: \"parts.head.stages[0].force_kN\", min: 0, max: 6000}\n"                         \
    "    - {path: \"parts.head.stages[0].stroke_mm\", min: 4, max: 50}\n"                          \
    "    - {path: \"parts.head.coupler.gap_mm\", min: 0, max: 500}\n"

static unsigned long next_random(unsigned long *seed) {
    *seed = *seed * 6364136223846793005ul + 1442695040888963407ul;
    return *seed >> 33;
}

/* A named rule is violated exactly when the reader refuses the design. */
static void named_rules_are_those_of_the_reader(void **state) {
    (void)state;
    stand_in_reset();
    static const char widely[] = WIDELY("interfaces.peak_force_kN, max: 1");
    Case made = begin(widely, 1);
    const int n = cz_evaluator_n_variable(made.evaluator);
    bool was_broken[CZ_N_VALUE_RULE] = {false};
    unsigned long seed = 1;
    int n_refused = 0;
    for (int point = 0; point < 400; point++) {
        double x[16];
        CzEvaluation evaluation;
        CzError error = {0};
        for (int i = 0; i < n; i++) {
            const CzVariableInfo *info = cz_evaluator_variable(made.evaluator, i);
            const double at = next_random(&seed) % 8 == 0 /* on the lower bound */
                                  ? 0
                                  : (double)(next_random(&seed) % 1001) / 1000;
            x[i] = next_random(&seed) % 3 == 0 ? info->min + at * (info->max - info->min)
                                               : info->start;
        }
        assert_int_equal(cz_evaluate(made.evaluator, 1, x, false, &evaluation, &error), CZ_OK);
        bool any = false;
        for (int j = 0; j < evaluation.n_constraint; j++)
            for (int rule = 0; rule < CZ_N_VALUE_RULE; rule++)
                if (strcmp(evaluation.constraint_check[j].name,
                           cz_metric_of_rule((CzValueRule)rule)->name) == 0 &&
                    evaluation.constraint[j] > 0)
                    any = was_broken[rule] = true;
        cz_evaluation_free(&evaluation);
        const bool is_refused = read_back(made.evaluator, widely, x, &error) != CZ_OK;
        if (is_refused != any)
            print_error("design %d: %s\n", point, error.message);
        assert_int_equal(is_refused, any);
        n_refused += is_refused;
    }
    assert_true(n_refused > 50 && n_refused < 350);
    for (int rule = 0; rule < CZ_N_VALUE_RULE; rule++)
        if (!was_broken[rule])
            fail_msg("never broken: %s", cz_metric_of_rule((CzValueRule)rule)->name);
    end(&made);
}

/* The smallest violation of an infeasible limit is at a design that violates rules. */
static void best_design_of_a_search_without_success_can_be_read_back(void **state) {
    (void)state;
    static const char *const problems[] = {
        /* the smallest force: a tube without any */
        WIDELY("interfaces.peak_force_kN, max: 1"),
        /* a tube of 5 MN under a trigger of 900 kN */
        WIDELY("elements.coupler *.peak_force_kN.min, min: 5000"),
        /* a heavy design, so long devices */
        WIDELY("design.absorber_mass_kg, min: 1e6")};
    for (size_t i = 0; i < sizeof problems / sizeof problems[0]; i++)
        for (long evaluations = 20; evaluations <= 60; evaluations += 40) {
            stand_in_reset();
            Case made = begin(problems[i], 1);
            CzOptimiseOptions options = cz_optimise_options_default();
            CzError error = {0};
            options.evaluations = evaluations;
            optimise(&made, &options);
            assert_int_equal(made.outcome->status, CZ_OUTCOME_INFEASIBLE);
            if (read_back(made.evaluator, problems[i], made.outcome->best, &error) != CZ_OK)
                fail_msg("problem %zu, %ld evaluations: %s", i, evaluations, error.message);
            end(&made);
        }
}

static void a_start_that_violates_a_rule_is_refused(void **state) {
    (void)state;
    stand_in_reset();
    Case made = begin("set: {parts.tube.trigger_kN: 900}\n"
                      "optimise:\n  variables:\n"
                      "    - {path: \"parts.tube.stages[0].force_kN\", min: 400, max: 1500,"
                      " start: 1000}\n",
                      1);
    CzError error = {0};
    assert_int_equal(cz_optimise_check(made.evaluator, NULL, &error), CZ_STATUS_INPUT);
    assert_string_equal(error.message,
                        "the start of the search breaks a rule: a trigger of 900 kN is below the "
                        "first plateau of 1000 kN");
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_a_search_checks_bounds),
        cmocka_unit_test(a_start_on_its_bound_is_within_it_whatever_the_unit),
        cmocka_unit_test(tied_places_of_other_units_share_the_bounds),
        cmocka_unit_test(fixed_variables_cost_no_evaluation_and_are_reported),
        cmocka_unit_test(a_search_ends_at_the_best_size_of_a_list),
        cmocka_unit_test(a_list_of_one_size_is_a_fixed_variable),
        cmocka_unit_test(a_search_without_free_variables_reports_it),
        cmocka_unit_test(the_reason_of_the_end_has_exact_numbers),
        cmocka_unit_test(named_rules_are_those_of_the_reader),
        cmocka_unit_test(best_design_of_a_search_without_success_can_be_read_back),
        cmocka_unit_test(a_start_that_violates_a_rule_is_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
