/* What limits and bounds are worth at the best design of a search, and which limits conflict. */
#include "report/worth_table.h"

#include "evaluate/evaluator.h"
#include "report/figure.h"

#include <stdio.h>
#include <string.h>

bool cz_worth_is_known(const CzOutcome *outcome) {
    return outcome->multiplier != NULL;
}

int cz_worth_n_violated(const CzEvaluation *best, int constraint) {
    int n = best->constraint[constraint] > 0 ? 1 : 0;
    if (n == 0 || best->constraint_check == NULL)
        return n;
    for (int i = 0; i < best->n_constraint; i++) {
        if (i == constraint || best->constraint[i] <= 0 ||
            strcmp(best->constraint_check[i].name, best->constraint_check[constraint].name) != 0)
            continue;
        if (best->constraint[i] > best->constraint[constraint] ||
            (best->constraint[i] == best->constraint[constraint] && i < constraint))
            return 0;
        n++;
    }
    return n;
}

/* Names of the limits that the best design violates: they cannot all be kept. */
static void write_conflict(const CzReport *report, size_t room, char *text) {
    const CzEvaluation *best = &report->outcome->best_evaluation;
    size_t n = (size_t)snprintf(text, room, "These limits conflict: ");
    const char *between = "";
    for (int i = 0; i < best->n_constraint && n < room; i++) {
        const int n_scenario = cz_worth_n_violated(best, i);
        if (n_scenario == 0)
            continue;
        n += (size_t)snprintf(text + n, room - n, "%s%s", between,
                              cz_evaluator_constraint_name(report->evaluator, i));
        if (n_scenario > 1 && n < room)
            n += (size_t)snprintf(text + n, room - n, " and %d more scenario%s", n_scenario - 1,
                                  n_scenario > 2 ? "s" : "");
        between = "; ";
    }
    if (n < room)
        snprintf(text + n, room - n, ". The least violation that was found depends on:");
}

void cz_worth_sentence(const CzReport *report, size_t room, char *text) {
    const CzOutcome *outcome = report->outcome;
    char share[CZ_FIGURE_SIZE];
    if (outcome->best_evaluation.violation > 0) {
        write_conflict(report, room, text);
        return;
    }
    snprintf(text, room,
             "Condition of an optimum: active limits and bounds explain the slope of the objective "
             "but for %s.",
             cz_figure_percent(share, outcome->stationarity));
}

/* An improvement of the objective. */
static void put_worth(CzReportTable *table, const CzReport *report, double worth) {
    char number[CZ_FIGURE_SIZE], text[CZ_FIGURE_SIZE + 40];
    const bool is_margin = cz_evaluator_maximises_margin(report->evaluator) ||
                           report->outcome->best_evaluation.violation > 0;
    if (is_margin)
        snprintf(text, sizeof text, "%s %% of margin", cz_figure_digits(number, 2, 100 * worth));
    else
        snprintf(text, sizeof text, "%s %.30s", cz_figure_digits(number, 2, worth),
                 cz_evaluator_objective_unit(report->evaluator));
    cz_table_put(table, text);
}

void cz_worth_begin_table(CzReportTable *table, const CzReport *report) {
    const CzOutcome *outcome = report->outcome;
    cz_table_begin(table, "limit or bound;>relaxed by;>is worth");
    for (int i = 0; i < outcome->n_multiplier; i++) {
        const CzMultiplier *multiplier = &outcome->multiplier[i];
        char text[CZ_FIGURE_SIZE];
        if (multiplier->constraint >= 0) {
            cz_table_put(table,
                         cz_evaluator_constraint_name(report->evaluator, multiplier->constraint));
            cz_table_put(table, "1 %");
        } else {
            const CzVariableInfo *info =
                cz_evaluator_variable(report->evaluator, multiplier->variable);
            cz_table_put(table, info->name);
            snprintf(text, sizeof text, "1 %.20s", info->unit != NULL ? info->unit : "");
            cz_table_put(table, text);
        }
        put_worth(table, report, multiplier->worth);
    }
}

bool cz_margins_are_capped(const CzOutcome *outcome) {
    return outcome->n_margin > 0 && outcome->margin[0].is_capped;
}

void cz_margins_begin_table(CzReportTable *table, const CzReport *report) {
    const CzOutcome *outcome = report->outcome;
    cz_table_begin(table, "smallest margins;>margin;raised by a variable");
    for (int i = 0; i < outcome->n_margin; i++) {
        char text[CZ_FIGURE_SIZE];
        cz_table_put(
            table, cz_evaluator_constraint_name(report->evaluator, outcome->margin[i].constraint));
        cz_table_put(table, cz_figure_percent(text, outcome->margin[i].margin));
        cz_table_put(table, outcome->margin[i].is_capped ? "no" : "yes");
    }
}

void cz_relaxation_sentence(const CzReport *report, size_t room, char *text) {
    const CzOutcome *outcome = report->outcome;
    const CzRelaxation *relaxation = &outcome->relaxation;
    char limit[CZ_FIGURE_SIZE], now[CZ_FIGURE_SIZE], share[CZ_FIGURE_SIZE];
    text[0] = '\0';
    if (relaxation->x == NULL && relaxation->n_evaluation > 0)
        snprintf(text, room,
                 "No relaxation of one limit alone was found with which a design passes, by %ld "
                 "further evaluations.",
                 relaxation->n_evaluation);
    if (relaxation->x == NULL)
        return;
    const CzCheckResult *check = &outcome->best_evaluation.constraint_check[relaxation->constraint];
    snprintf(
        text, room,
        "Smallest relaxation of one limit: with %s at %s %s instead of %s (%s) a design passes, "
        "found by %ld further evaluations.",
        cz_evaluator_constraint_name(report->evaluator, relaxation->constraint),
        cz_figure_digits(limit, 5, relaxation->limit), check->unit != NULL ? check->unit : "",
        cz_figure_digits(now, 5, check->limit), cz_figure_percent(share, relaxation->violation),
        relaxation->n_evaluation);
}
