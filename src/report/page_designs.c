/* Designs of a search as parallel coordinates, and sensitivities of the best design. */
#include "report/page.h"

#include "base/error.h"
#include "evaluate/evaluator.h"
#include "report/figure.h"
#include "report/table.h"
#include "report/plot.h"

#include <math.h>
#include <stdlib.h>

#define TOP 22.0
#define HEIGHT 190.0
#define SIDE 44.0  /* next to the first and last axis */
#define APART 84.0 /* of two axes */

enum { MAX_LINES = 400, MAX_COLUMNS = 4 };

/* ---- parallel coordinates ---- */

/* The axes: the variables, then the objective. */
typedef struct Axes {
    const CzEvaluator *evaluator;
    const CzOutcome *outcome;
    int n;                   /* axes */
    double worst, best;      /* of the objectives that are shown, at the bottom and top */
    const double *objective; /* as shown (n_trial) */
} Axes;

static double axis_x(int axis) {
    return SIDE + axis * APART;
}

/* Place on an axis, 0 at its lower end. */
static double share_of(const Axes *axes, int axis, const double *x, double objective) {
    if (axis == axes->n - 1)
        return axes->best != axes->worst ? (objective - axes->worst) / (axes->best - axes->worst)
                                         : 0.5;
    const CzVariableInfo *variable = cz_evaluator_variable(axes->evaluator, axis);
    const double range = variable->max - variable->min;
    return range > 0 ? (x[axis] - variable->min) / range : 0.5;
}

static void write_design(CzMarkup *markup, const Axes *axes, const double *x, double objective) {
    cz_markup_write(markup, "M");
    for (int axis = 0; axis < axes->n; axis++) {
        const double share = fmin(fmax(share_of(axes, axis, x, objective), 0), 1);
        cz_markup_write(markup, "%s%ld %.1f", axis > 0 ? "L" : "", lround(axis_x(axis)),
                        TOP + HEIGHT * (1 - share));
    }
}

/* Draws the feasible designs, or the others, as one path; of many designs an even selection. */
static void write_designs(CzMarkup *markup, const Axes *axes, bool feasible, const char *name) {
    const CzOutcome *outcome = axes->outcome;
    long n = 0, seen = 0, shown = 0;
    for (long i = 0; i < outcome->n_trial; i++)
        n += outcome->trial[i].feasible == feasible && isfinite(outcome->trial[i].objective);
    if (n == 0)
        return;
    const long most = n < MAX_LINES / 2 ? n : MAX_LINES / 2;
    cz_markup_write(markup, "<path stroke='%s' stroke-opacity='%s' d='",
                    cz_plot_colour(feasible ? 0 : CZ_PLOT_QUIET), feasible ? ".55" : ".4");
    for (long i = 0; i < outcome->n_trial; i++) {
        const CzTrial *trial = &outcome->trial[i];
        if (trial->feasible != feasible || !isfinite(trial->objective))
            continue;
        if (seen++ * most / n < shown) /* `most` of n designs, evenly spaced */
            continue;
        shown++;
        write_design(markup, axes, &outcome->trial_x[i * outcome->n_variable], axes->objective[i]);
    }
    cz_markup_write(markup, "'><title>%s</title></path>", name);
}

static void write_axis(CzMarkup *markup, const Axes *axes, int axis) {
    const bool is_objective = axis == axes->n - 1;
    const CzVariableInfo *variable =
        is_objective ? NULL : cz_evaluator_variable(axes->evaluator, axis);
    const double x = axis_x(axis);
    char text[CZ_FIGURE_SIZE + 8];
    cz_markup_write(markup, "<path d='M%ld %ldV%ld' stroke='currentColor'/>", lround(x),
                    lround(TOP), lround(TOP + HEIGHT));
    cz_svg_text(markup, x, TOP - 7, "middle",
                cz_figure_digits(text, 4, is_objective ? axes->best : variable->max));
    cz_svg_text(markup, x, TOP + HEIGHT + 14, "middle",
                cz_figure_digits(text, 4, is_objective ? axes->worst : variable->min));
    if (is_objective)
        snprintf(text, sizeof text, "objective");
    else
        snprintf(text, sizeof text, "%d", axis + 1);
    cz_markup_write(markup,
                    "<text x='%.1f' y='%.1f' text-anchor='middle' font-weight='bold' "
                    "fill='currentColor'>%s</text>",
                    x, TOP + HEIGHT + 32, text);
}

static void write_figure(CzMarkup *markup, const Axes *axes, double start, double best) {
    const double width = 2 * SIDE + (axes->n - 1) * APART;
    cz_svg_open(markup, "Every design of the search as a line over the variables and the objective",
                width, TOP + HEIGHT + 42);
    cz_markup_write(markup, " class='designs' width='%.0f'>", width);
    write_designs(markup, axes, false, "designs that violate a constraint");
    write_designs(markup, axes, true, "feasible designs");
    for (int axis = 0; axis < axes->n; axis++)
        write_axis(markup, axes, axis);
    cz_markup_write(markup, "<path stroke='%s' stroke-width='2' stroke-dasharray='%s' d='",
                    cz_plot_colour(1), cz_plot_dash(1));
    write_design(markup, axes, axes->outcome->start, start);
    cz_markup_write(markup, "'><title>start</title></path><path stroke='%s' stroke-width='3' d='",
                    cz_plot_colour(2));
    write_design(markup, axes, axes->outcome->best, best);
    cz_markup_write(markup, "'><title>best</title></path></svg>\n");
}

/* The upper end of the axis of the objective is the better one; designs that are far worse are at
 * its lower end. */
static void find_range(Axes *axes, double start, double best) {
    axes->best = best;
    const double sign = start < best ? 1 : -1; /* 1 when larger is better, else -1 */
    const double least = best - sign * 2 * fabs(best - start);
    axes->worst = start;
    for (long i = 0; i < axes->outcome->n_trial; i++) {
        const double value = axes->objective[i];
        if (!isfinite(value))
            continue;
        if (sign * (value - axes->best) > 0 && axes->outcome->trial[i].feasible)
            axes->best = value;
        if (sign * (value - axes->worst) < 0 && sign * (value - least) > 0)
            axes->worst = value;
    }
}

static void write_names(CzMarkup *markup, const CzEvaluator *evaluator, int n) {
    cz_markup_write(markup, "<p class='axes'>");
    for (int i = 0; i < n; i++)
        cz_markup_write(markup, "%s%d %s", i > 0 ? " · " : "", i + 1,
                        cz_evaluator_variable(evaluator, i)->name);
    cz_markup_write(markup, "</p>\n");
}

CzStatus cz_page_write_designs(CzMarkup *markup, const CzReport *report, CzError *error) {
    const CzEvaluator *evaluator = report->evaluator;
    const CzOutcome *outcome = report->outcome;
    if (outcome->n_variable < 2 || outcome->n_trial < 2 || outcome->trial_x == NULL)
        return CZ_OK;
    double *objective = malloc((size_t)outcome->n_trial * sizeof *objective);
    if (objective == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    const double sign = cz_evaluator_maximises_margin(evaluator) ? -100 : 1; /* margins in % */
    for (long i = 0; i < outcome->n_trial; i++)
        objective[i] = sign * outcome->trial[i].objective;
    const double start = sign * outcome->start_evaluation.objective;
    const double best = sign * outcome->best_evaluation.objective;
    Axes axes = {.evaluator = evaluator,
                 .outcome = outcome,
                 .n = outcome->n_variable + 1,
                 .objective = objective};
    find_range(&axes, start, best);
    cz_markup_write(markup,
                    "<section id='designs'>\n<h2>All designs</h2>\n"
                    "<p>Each line is a design; its crossing with an axis is the value between the "
                    "bounds. Grey violates a constraint, blue is feasible, orange dashes are the "
                    "start, green is the best. Objectives far below the start lie at the end of "
                    "their axis.</p><div class='wide'>");
    write_figure(markup, &axes, start, best);
    cz_markup_write(markup, "</div>");
    write_names(markup, evaluator, outcome->n_variable);
    cz_markup_write(markup, "</section>\n");
    free(objective);
    return CZ_OK;
}

/* ---- sensitivities ---- */

int cz_page_next_constraint(const CzEvaluation *evaluation, int n_listed, const int *listed) {
    int found = -1;
    for (int i = 0; i < evaluation->n_constraint; i++) {
        const bool is_flag =
            evaluation->constraint_check != NULL && evaluation->constraint_check[i].is_flag;
        bool is_listed =
            !isfinite(evaluation->constraint[i]) || (is_flag && evaluation->constraint[i] <= 0);
        for (int k = 0; k < n_listed; k++)
            is_listed |= listed[k] == i;
        if (!is_listed && (found < 0 || evaluation->constraint[i] > evaluation->constraint[found]))
            found = i;
    }
    return found;
}

static void put_change(CzReportTable *table, double change) {
    char text[CZ_FIGURE_SIZE];
    cz_table_put(table, !isfinite(change)     ? "-"
                        : fabs(change) < 5e-5 ? "0"
                                              : cz_figure_margin(text, change));
}

static void put_sensitivity(CzReportTable *table, const CzReport *report, int variable,
                            int n_column, const int *column) {
    const CzOutcome *outcome = report->outcome;
    const CzVariableInfo *info = cz_evaluator_variable(report->evaluator, variable);
    const int n_constraint = outcome->best_evaluation.n_constraint;
    char number[CZ_FIGURE_SIZE], text[CZ_FIGURE_SIZE + 40];
    cz_table_put(table, info->name);
    snprintf(text, sizeof text, "%s%s %.30s",
             outcome->sensitivity_increment[variable] > 0 ? "+" : "",
             cz_figure_digits(number, 4, outcome->sensitivity_increment[variable]),
             info->unit != NULL ? info->unit : "");
    cz_table_put(table, text);
    const double change = outcome->objective_change[variable];
    if (cz_evaluator_maximises_margin(report->evaluator))
        put_change(table, -change);
    else
        cz_table_put(table, isfinite(change) ? cz_figure_digits(text, 3, change) : "-");
    for (int i = 0; i < n_column; i++)
        put_change(table, -outcome->constraint_change[variable * n_constraint + column[i]]);
}

static void add_head(CzReportTable *table, const char *name) {
    char head[CZ_SENTENCE_SIZE];
    snprintf(head, sizeof head, ">%s", name);
    cz_table_head(table, head);
}

void cz_page_write_sensitivities(CzMarkup *markup, const CzReport *report) {
    const CzEvaluator *evaluator = report->evaluator;
    const CzOutcome *outcome = report->outcome;
    if (outcome->sensitivity_increment == NULL)
        return;
    int column[MAX_COLUMNS] = {0}, n_column = 0;
    while (n_column < MAX_COLUMNS) {
        column[n_column] = cz_page_next_constraint(&outcome->best_evaluation, n_column, column);
        if (column[n_column] < 0)
            break;
        n_column++;
    }
    cz_markup_write(
        markup,
        "<section id='sensitivities'>\n"
        "<h2>Sensitivities: change per increment of each variable</h2>\n"
        "<p>One variable at a time is changed by its increment, at least 2 %% of its range, "
        "downwards at its upper bound; all others keep the values of the best design. Margins are "
        "those of the most critical constraints, computed as in the search.</p>");
    CzReportTable table;
    cz_table_begin(&table, "variable;>increment");
    table.class_name = "sensitivities cards";
    add_head(&table, cz_evaluator_maximises_margin(evaluator)
                         ? "smallest margin"
                         : cz_evaluator_objective_name(evaluator));
    for (int i = 0; i < n_column; i++)
        add_head(&table, cz_evaluator_constraint_name(evaluator, column[i]));
    for (int i = 0; i < outcome->n_variable; i++)
        if (outcome->sensitivity_increment[i] != 0)
            put_sensitivity(&table, report, i, n_column, column);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</section>\n");
}
