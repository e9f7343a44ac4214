/* What a search answers, on a terminal: before and after, what is still violated, new values. */
#include "crushzone/report.h"

#include "evaluate/evaluator.h"
#include "report/checks_table.h"
#include "report/grid.h"
#include "report/figure.h"
#include "report/overlay.h"

/* The objective before and after. */
static void write_objective(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                            FILE *stream) {
    const char *unit = cz_evaluator_objective_unit(evaluator);
    const double before = outcome->start_evaluation.objective;
    const double after = outcome->best_evaluation.objective;
    char start[CZ_FIGURE_ROOM], best[CZ_FIGURE_ROOM];
    if (cz_evaluator_maximises_margin(evaluator)) { /* its negative is minimised */
        fprintf(stream, "smallest margin: %s -> %s\n\n", cz_figure_margin(start, -before),
                cz_figure_margin(best, -after));
        return;
    }
    fputs("objective ", stream);
    cz_grid_write_text(cz_evaluator_objective_name(evaluator), CZ_STYLE_PLAIN, colour, stream);
    fprintf(stream, ": %s -> %s%s%s\n\n", cz_figure_plain(start, before),
            cz_figure_plain(best, after), unit != NULL && unit[0] != '\0' ? " " : "",
            unit != NULL ? unit : "");
}

static void write_head(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                       FILE *stream) {
    static const CzStyle styles[] = {[CZ_OUTCOME_FEASIBLE] = CZ_STYLE_GOOD,
                                     [CZ_OUTCOME_INFEASIBLE] = CZ_STYLE_BAD,
                                     [CZ_OUTCOME_INTERRUPTED] = CZ_STYLE_CAREFUL};
    static const char *const words[] = {[CZ_OUTCOME_FEASIBLE] = "FEASIBLE",
                                        [CZ_OUTCOME_INFEASIBLE] = "NOTHING FEASIBLE FOUND",
                                        [CZ_OUTCOME_INTERRUPTED] = "INTERRUPTED"};
    cz_grid_write_text(words[outcome->status], styles[outcome->status], colour, stream);
    fprintf(stream, " after %ld evaluations: ", outcome->n_evaluation);
    cz_grid_write_text(outcome->why_stopped, CZ_STYLE_PLAIN, colour, stream);
    if (outcome->status == CZ_OUTCOME_INTERRUPTED)
        fprintf(stream, "; the best so far is %sfeasible",
                outcome->best_evaluation.violation <= 0 ? "" : "NOT ");
    fputc('\n', stream);
    write_objective(evaluator, outcome, colour, stream);
}

static void write_variables(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                            FILE *stream) {
    static const char *const names[] = {"variable", "unit", "min", "max", "before", "after", ""};
    CzGrid grid;
    cz_grid_begin(&grid, "llrrrrl");
    for (int i = 0; i < 7; i++)
        cz_grid_put(&grid, names[i], CZ_STYLE_PLAIN);
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *variable = cz_evaluator_variable(evaluator, i);
        const double numbers[] = {variable->min, variable->max, outcome->start[i],
                                  outcome->best[i]};
        char text[CZ_FIGURE_ROOM];
        cz_grid_put(&grid, variable->name, CZ_STYLE_PLAIN);
        cz_grid_put(&grid, variable->unit, CZ_STYLE_PLAIN);
        for (int k = 0; k < 4; k++)
            cz_grid_put(&grid, cz_figure_digits(text, 6, numbers[k]), CZ_STYLE_PLAIN);
        cz_grid_put(&grid, outcome->at_bound[i] ? "at its bound" : "", CZ_STYLE_CAREFUL);
    }
    cz_grid_write(&grid, colour, stream);
    fputc('\n', stream);
}

/* Every constraint that the best design breaks; a constraint may be a target that is no check. */
static void write_violations(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                             FILE *stream) {
    static const char *const names[] = {"violated", "where", "scenario",
                                        "limit",    "value", "margin"};
    const CzEvaluation *best = &outcome->best_evaluation;
    if (best->violation <= 0)
        return;
    CzGrid grid;
    cz_grid_begin(&grid, "lllrrr");
    for (int i = 0; i < 6; i++)
        cz_grid_put(&grid, names[i], CZ_STYLE_PLAIN);
    for (int i = 0; i < best->n_constraint; i++) {
        if (best->constraint[i] <= 0)
            continue;
        const CzCheckResult *check =
            best->constraint_check != NULL ? &best->constraint_check[i] : NULL;
        char text[96];
        cz_grid_put(&grid, cz_evaluator_constraint_name(evaluator, i), CZ_STYLE_BAD);
        cz_grid_put(&grid, check != NULL ? check->where : "", CZ_STYLE_PLAIN);
        cz_grid_put(&grid, check != NULL && check->scenario != NULL ? check->scenario : "",
                    CZ_STYLE_PLAIN);
        text[0] = '\0';
        if (check != NULL)
            cz_checks_format_limit(check, sizeof text, text);
        cz_grid_put(&grid, text, CZ_STYLE_PLAIN);
        if (check != NULL)
            cz_checks_format_value(check, sizeof text, text);
        cz_grid_put(&grid, text, CZ_STYLE_PLAIN);
        cz_grid_put(&grid, check != NULL ? cz_figure_margin(text, check->margin) : "",
                    CZ_STYLE_PLAIN);
    }
    fputc('\n', stream);
    cz_grid_write(&grid, colour, stream);
}

void cz_report_write_outcome_table(const CzProblem *problem, const CzEvaluator *evaluator,
                                   const CzOutcome *outcome, bool colour, FILE *stream) {
    cz_grid_write_text(cz_problem_title(problem), CZ_STYLE_PLAIN, colour, stream);
    fputs("\n\n", stream);
    write_head(evaluator, outcome, colour, stream);
    write_variables(evaluator, outcome, colour, stream);
    cz_checks_write_table(&outcome->best_evaluation, &outcome->start_evaluation, colour, stream);
    write_violations(evaluator, outcome, colour, stream);

    CzArena arena = {0};
    int n_setting;
    const char **setting = cz_overlay_settings(evaluator, outcome, NULL, &arena, &n_setting);
    fputs("\nNew values:\n", stream);
    if (setting != NULL)
        cz_overlay_write_set(n_setting, setting, stream);
    cz_arena_free(&arena);
}
