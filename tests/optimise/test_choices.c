/* Variables that choose a buffer: a buffing collision of two rigid cars with each buffer. */
#include "optimise/loopholes.h"

static const char buffing[] =
    "schema: 1\n"
    "title: two rigid cars that buff\n"
    "parts:\n"
    "  short: {stages: [{stroke_mm: 50, force_kN: 400}]}\n"
    "  long: {stages: [{stroke_mm: 150, force_kN: 400}]}\n"
    "  two-stage: {stages: [{stroke_mm: 50, force_kN: 150}, {stroke_mm: 70, force_kN: 500}]}\n"
    "  same-as-long: {stages: [{stroke_mm: 150, force_kN: 400}]}\n"
    "  tube: {stages: [{stroke_mm: 250, force_kN: 600}]}\n"
    "  head:\n"
    "    face_gap_mm: 900\n"
    "    unloading_stiffness_MN_m: 600\n"
    "    coupler: {buffer: {use: short}, tube: {use: tube}}\n"
    "  wall-head: {use: head, coupler: {buffer: {use: two-stage}, tube: {use: tube}}}\n"
    "trains:\n"
    "  - {name: A, vehicles: [{name: A1, model: rigid, mass_t: 40, front: {use: head}}]}\n"
    "  - {name: B, vehicles: [{name: B1, model: rigid, mass_t: 50, rear: {use: wall-head}}]}\n"
    "scenarios: [{name: buff, speed_km_h: 10}, {name: crash, speed_km_h: 20}]\n"
    "checks: {design_rules: false}\n";

#define CHOOSE(variables)                                                                          \
    "optimise:\n"                                                                                  \
    "  minimise: interfaces.peak_force_kN\n"                                                       \
    "  evaluations: 60\n"                                                                          \
    "  variables: [" variables "]\n"

#define HEAD "{path: parts.head.coupler.buffer, choices: [two-stage, short, long]}"
#define TUBE ", {path: \"parts.tube.stages[0].force_kN\", min: 510, max: 900, increment: 10}"

static double objective_of(const Case *made, const double *x) {
    CzEvaluation evaluation;
    CzError error = {0};
    assert_int_equal(cz_evaluate(made->evaluator, 1, x, false, &evaluation, &error), CZ_OK);
    assert_int_equal(evaluation.status, CZ_OK);
    const double objective = evaluation.objective;
    cz_evaluation_free(&evaluation);
    return objective;
}

static void choice_has_names_and_the_files_own_as_its_start(void **state) {
    (void)state;
    Case made = begin_with(problem_of_text(buffing, CHOOSE(HEAD)), 1);
    const CzVariableInfo *info = cz_evaluator_variable(made.evaluator, 0);
    assert_int_equal(info->n_choice, 3);
    assert_string_equal(info->choice[2], "long");
    assert_near(info->start, 1, 0, 0);
    assert_near(info->min, 0, 0, 0);
    assert_near(info->max, 2, 0, 0);
    assert_int_equal(info->n_place, 1);
    assert_string_equal(info->place[0].path, "parts.head.coupler.buffer.use");
    end(&made);
}

/* The reference is the file with the choice typed in: every bit is equal. */
static void choice_equals_the_file_with_that_part(void **state) {
    (void)state;
    static const char *const names[] = {"two-stage", "short", "long"};
    Case made = begin_with(problem_of_text(buffing, CHOOSE(HEAD)), 1);
    for (int choice = 0; choice < 3; choice++) {
        char more[512];
        snprintf(more, sizeof more, "set: {parts.head.coupler.buffer.use: %s}\n%s", names[choice],
                 CHOOSE("{path: \"parts.tube.stages[0].force_kN\", min: 510, max: 900}"));
        Case typed = begin_with(problem_of_text(buffing, more), 1);
        const double x = choice;
        const double chosen = objective_of(&made, &x), tube = 600;
        const double written = objective_of(&typed, &tube);
        assert_memory_equal(&chosen, &written, sizeof chosen);
        end(&typed);
    }
    end(&made);
}

static void result_does_not_depend_on_other_choices_of_the_batch(void **state) {
    (void)state;
    Case made = begin_with(problem_of_text(buffing, CHOOSE(HEAD TUBE)), 2);
    const double x[] = {2, 600, 0, 700, 1, 550, 2, 550, 0, 510, 1, 900, 1, 600};
    CzEvaluation many[7];
    CzError error = {0};
    assert_int_equal(cz_evaluate(made.evaluator, 7, x, false, many, &error), CZ_OK);
    for (int i = 0; i < 7; i++) {
        const double alone = objective_of(&made, x + 2 * i);
        assert_memory_equal(&many[i].objective, &alone, sizeof alone);
        cz_evaluation_free(&many[i]);
    }
    assert_true(objective_of(&made, x) != objective_of(&made, x + 12));
    end(&made);
}

/* The reference is the evaluation of every choice. */
static void best_of_the_choices_is_found(void **state) {
    (void)state;
    Case made = begin_with(problem_of_text(buffing, CHOOSE(HEAD)), 1);
    double least = INFINITY;
    int best = -1;
    for (int choice = 0; choice < 3; choice++) {
        const double x = choice;
        const double objective = objective_of(&made, &x);
        best = objective < least ? choice : best;
        least = fmin(least, objective);
    }
    optimise(&made, NULL);
    assert_near(made.outcome->best[0], best, 0, 0);
    assert_near(made.outcome->best_evaluation.objective, least, 0, 0);
    assert_int_equal(made.outcome->n_evaluation, 3); /* no further combination exists */
    assert_false(made.outcome->at_bound[0]);
    end(&made);
}

/* A choice beside a number: the search over both is as good as that over the number with the best
 * buffer typed in, and keeps to its limit of evaluations. */
static void choice_and_number_are_found_together(void **state) {
    (void)state;
    double least = INFINITY;
    static const char *const names[] = {"two-stage", "short", "long"};
    for (int choice = 0; choice < 3; choice++) {
        char more[512];
        snprintf(
            more, sizeof more, "set: {parts.head.coupler.buffer.use: %s}\n%s", names[choice],
            CHOOSE("{path: \"parts.tube.stages[0].force_kN\", min: 510, max: 900, increment: 10}"));
        Case typed = begin_with(problem_of_text(buffing, more), 2);
        optimise(&typed, NULL);
        least = fmin(least, typed.outcome->best_evaluation.objective);
        end(&typed);
    }
    for (int named = 0; named < 2; named++) {
        Case made = begin_with(problem_of_text(buffing, CHOOSE(HEAD TUBE)), 2);
        CzOptimiseOptions options = cz_optimise_options_default();
        options.algorithm = named ? "LN_COBYLA" : "auto";
        optimise(&made, &options);
        const CzOutcome *outcome = made.outcome;
        assert_true(outcome->best_evaluation.objective <= 1.02 * least);
        assert_true(outcome->n_evaluation <= 60);
        assert_int_equal(outcome->n_trial, outcome->n_evaluation);
        assert_near(outcome->best[1] / 10, round(outcome->best[1] / 10), 0, 1e-9);
        end(&made);
    }
}

static void refused(const char *variables, const char *sentence) {
    char more[1024];
    CzError error = {0};
    CzEvaluator *evaluator = NULL;
    snprintf(more, sizeof more, "optimise: {minimise: interfaces.peak_force_kN, variables: [%s]}\n",
             variables);
    CzProblem *problem = problem_of_text(buffing, more);
    assert_int_equal(cz_evaluator_build(problem, NULL, &evaluator, &error), CZ_STATUS_INPUT);
    if (strstr(error.message, sentence) == NULL)
        fail_msg("'%s' does not say '%s'", error.message, sentence);
    assert_int_equal(error.line, 19);
    cz_problem_free(problem);
}

static void invalid_choices_are_refused_by_name(void **state) {
    (void)state;
    refused("{path: parts.head.coupler.buffer, choices: [short, long, same-as-long]}",
            "gives 'long' and 'same-as-long' the same values");
    refused("{path: parts.head.coupler.buffer, choices: [two-stage, long]}",
            "the buffer of the file at 'parts.head.coupler.buffer' is not one of the choices");
    refused(HEAD ", {path: \"parts.head.coupler.buffer.stages[0].force_kN\", min: 300, max: 500}",
            "is driven by two variables");
    refused("{path: \"parts.head.coupler.buffer.stages[0].force_kN\", min: 300, max: 500}, " HEAD,
            "is driven by two variables");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(choice_has_names_and_the_files_own_as_its_start),
        cmocka_unit_test(choice_equals_the_file_with_that_part),
        cmocka_unit_test(result_does_not_depend_on_other_choices_of_the_batch),
        cmocka_unit_test(best_of_the_choices_is_found),
        cmocka_unit_test(choice_and_number_are_found_together),
        cmocka_unit_test(invalid_choices_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
