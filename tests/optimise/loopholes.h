/* Loopholes of the model: an optimiser uses each of them when the design rules are off, and none
 * when they are on. Run on the stand-in and on the simulator itself.
 */
#ifndef CZ_TESTS_LOOPHOLES_H
#define CZ_TESTS_LOOPHOLES_H

#include "support/check.h"

#include "crushzone/optimise.h"
#include "evaluate/small_problem.h"

typedef struct Case {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzOutcome *outcome;
} Case;

static inline Case begin_with(CzProblem *problem, int n_job) {
    Case made = {.problem = problem};
    CzError error = {0};
    const CzEvaluatorOptions options = {.n_job = n_job, .step_factor = 1};
    const CzStatus status = cz_evaluator_build(made.problem, &options, &made.evaluator, &error);
    if (status != CZ_OK)
        print_error("%d:%d: %s\n", error.line, error.column, error.message);
    assert_int_equal(status, CZ_OK);
    return made;
}

static inline Case begin(const char *more, int n_job) {
    return begin_with(small_problem(more), n_job);
}

static inline void optimise(Case *made, const CzOptimiseOptions *options) {
    CzError error = {0};
    const CzStatus status = cz_optimise(made->evaluator, options, &made->outcome, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
}

static inline void end(Case *made) {
    cz_outcome_free(made->outcome);
    cz_evaluator_free(made->evaluator);
    cz_problem_free(made->problem);
}

static inline const CzCheckResult *find(const CzEvaluation *evaluation, const char *name,
                                        const char *scenario) {
    for (int i = 0; i < evaluation->n_check; i++)
        if (strcmp(evaluation->check[i].name, name) == 0 &&
            strcmp(evaluation->check[i].scenario, scenario) == 0)
            return &evaluation->check[i];
    return NULL;
}

static inline double value_of(const Case *made, const char *name, const char *scenario) {
    const CzCheckResult *check = find(&made->outcome->best_evaluation, name, scenario);
    assert_non_null(check);
    return check->value;
}

/* A loophole and the design rule that closes it. */
typedef struct Loophole {
    const char *problem; /* all but checks and optimise; NULL: the two rigid cars */
    const char *limits;  /* list entries of checks.limits that make the loophole visible */
    const char *minimise;
    const char *variables; /* list entries */
    const char *check;     /* design rule that must stop it */
    const char *scenario;
} Loophole;

static inline Case run_loophole(const Loophole *loophole, bool with_rules) {
    char more[4096];
    snprintf(more, sizeof more,
             "checks: {design_rules: %s, limits: [%s]}\n"
             "optimise:\n"
             "  minimise: %s\n"
             "  subject_to: [%s]\n"
             "  evaluations: 60\n"
             "  variables: [%s]\n",
             with_rules ? "true" : "false", loophole->limits, loophole->minimise,
             with_rules ? loophole->check : "visible", loophole->variables);
    Case made = loophole->problem != NULL ? begin_with(problem_of_text(loophole->problem, more), 2)
                                          : begin(more, 2);
    optimise(&made, NULL);
    return made;
}

/* The limit named `visible` is never active: it only shows the value at the optimum. */
static inline void check_loophole(const Loophole *loophole) {
    Case exploited = run_loophole(loophole, false);
    const double temptation = value_of(&exploited, "visible", loophole->scenario);
    Case honest = run_loophole(loophole, true);
    const CzCheckResult *rule =
        find(&honest.outcome->best_evaluation, loophole->check, loophole->scenario);
    assert_non_null(rule);
    /* without the rule the optimum violates it and has a better objective; with the rule it
     * satisfies it */
    assert_true(rule->is_minimum ? temptation < rule->limit : temptation > rule->limit);
    assert_int_equal(rule->verdict, CZ_VERDICT_PASS);
    assert_int_equal(honest.outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_true(honest.outcome->best_evaluation.objective >
                exploited.outcome->best_evaluation.objective);
    end(&exploited);
    end(&honest);
}

static inline void optimiser_cannot_win_by_using_every_stroke_up(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .limits = "{name: visible, metric: elements.stroke_used, max: 1e9}",
        .minimise = "design.installed_length_mm",
        .variables = "{path: \"parts.anti-climber.stages[0].stroke_mm\", min: 1, max: 900}",
        .check = "stroke used",
        .scenario = "crash"});
}

static inline void optimiser_cannot_win_by_bottoming_out_under_overload(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .limits = "{name: visible, metric: elements.stroke_used, max: 1e9, scenarios: [overload]}",
        .minimise = "design.installed_length_mm",
        .variables = "{path: \"parts.anti-climber.stages[0].stroke_mm\", min: 1, max: 900}",
        .check = "stroke used under overload",
        .scenario = "overload"});
}

static inline void optimiser_cannot_win_with_stroke_that_does_not_exist(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .limits = "{name: visible, metric: ends.length_used, max: 1e9}",
        .minimise = "elements.anti-climber *.stroke_used",
        .variables = "{path: \"parts.anti-climber.stages[0].stroke_mm\", min: 10, max: 5000}",
        .check = "installed length / available length",
        .scenario = "design"});
}

static inline void optimiser_cannot_win_with_a_coupler_that_has_nowhere_to_go(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .limits = "{name: visible, metric: ends.retraction_used, max: 1e9}",
        .minimise = "elements.anti-climber *.stroke_used",
        .variables = "{path: \"parts.anti-climber.stages[0].stroke_mm\", min: 10, max: 5000}",
        .check = "stroke / retraction space",
        .scenario = "design"});
}

static inline void optimiser_cannot_win_by_forces_above_the_strength_behind(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .limits = "{name: visible, metric: sections.force_share, max: 1e9, scenarios: [crash]}",
        .minimise = "elements.anti-climber *.stroke_used",
        .variables = "{path: \"parts.anti-climber.stages[0].force_kN\", min: 10, max: 5000}",
        .check = "section force / proof strength",
        .scenario = "crash"});
}

static inline void optimiser_cannot_use_the_shear_off_as_a_fuse(void **state) {
    (void)state;
    check_loophole(
        &(Loophole){.limits = "{name: visible, metric: elements.coupler *.shear_load, max: 1e9}",
                    .minimise = "elements.coupler *.peak_force_kN",
                    .variables = "{path: parts.shear-off.force_kN, min: 100, max: 2000}",
                    .check = "no shear-off at 15 km/h (service)",
                    .scenario = "service"});
}

static inline void optimiser_cannot_let_the_coupler_go_before_its_tube_works(void **state) {
    (void)state;
    check_loophole(
        &(Loophole){.limits = "{name: visible, metric: ends.tube_over_shear_off, max: 1e9}",
                    .minimise = "elements.coupler *.peak_force_kN",
                    .variables = "{path: parts.shear-off.force_kN, min: 100, max: 2000}",
                    .check = "tube force / shear-off force",
                    .scenario = "design"});
}

static inline void optimiser_cannot_make_the_shear_off_stronger_than_the_car(void **state) {
    (void)state;
    check_loophole(
        &(Loophole){.limits = "{name: visible, metric: ends.shear_off_over_strength, max: 1e9}",
                    .minimise = "ends.tube_over_shear_off",
                    .variables = "{path: parts.shear-off.force_kN, min: 1000, max: 3000}",
                    .check = "shear-off force / proof strength",
                    .scenario = "design"});
}

static inline void optimiser_cannot_win_with_an_element_that_takes_no_energy(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .limits = "{name: visible, metric: energy.absorbers_share, min: -1e9, scenarios: [crash]}",
        .minimise = "design.installed_length_mm",
        .variables = "{path: \"parts.anti-climber.stages[0].stroke_mm\", min: 1, max: 900}",
        .check = "share of collision energy absorbed",
        .scenario = "crash"});
}

#define LOOPHOLES                                                                                  \
    cmocka_unit_test(optimiser_cannot_win_by_using_every_stroke_up),                               \
        cmocka_unit_test(optimiser_cannot_win_by_bottoming_out_under_overload),                    \
        cmocka_unit_test(optimiser_cannot_win_with_stroke_that_does_not_exist),                    \
        cmocka_unit_test(optimiser_cannot_win_with_a_coupler_that_has_nowhere_to_go),              \
        cmocka_unit_test(optimiser_cannot_win_by_forces_above_the_strength_behind),                \
        cmocka_unit_test(optimiser_cannot_use_the_shear_off_as_a_fuse),                            \
        cmocka_unit_test(optimiser_cannot_let_the_coupler_go_before_its_tube_works),               \
        cmocka_unit_test(optimiser_cannot_make_the_shear_off_stronger_than_the_car),               \
        cmocka_unit_test(optimiser_cannot_win_with_an_element_that_takes_no_energy)

#endif
