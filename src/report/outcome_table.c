/* The results of a search on a terminal: before and after, remaining violations, new values. */
#include "crushzone/report.h"

#include "base/number.h"
#include "evaluate/evaluator.h"
#include "report/checks_table.h"
#include "report/figure.h"
#include "report/outcome_table.h"
#include "report/overlay.h"
#include "report/robust_table.h"
#include "report/tables.h"
#include "report/worth_table.h"

#include <math.h>
#include <string.h>

/* The objective before and after. */
static void write_objective(const CzEvaluator *evaluator, const CzOutcome *outcome,
                            CzTerminal *terminal) {
    const bool is_margin = cz_evaluator_maximises_margin(evaluator); /* its negative is minimised */
    const char *unit = is_margin ? NULL : cz_evaluator_objective_unit(evaluator);
    const CzEvaluation *evaluations[2] = {&outcome->start_evaluation, &outcome->best_evaluation};
    char text[2][CZ_FIGURE_SIZE];
    for (int i = 0; i < 2; i++) {
        if (is_margin)
            cz_figure_margin(text[i], -evaluations[i]->objective);
        else
            cz_figure_plain(text[i], evaluations[i]->objective);
        cz_figure_mark(text[i], evaluations[i]->beyond_validity);
    }
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s%s: %s -> %s%s%s\n\n",
                      is_margin ? "smallest margin" : "objective ",
                      is_margin ? "" : cz_evaluator_objective_name(evaluator), text[0], text[1],
                      unit != NULL && unit[0] != '\0' ? " " : "", unit != NULL ? unit : "");
}

const char *cz_outcome_words(const CzEvaluator *evaluator, const CzOutcome *outcome) {
    static const char *const words[] = {[CZ_OUTCOME_FEASIBLE] = "FEASIBLE",
                                        [CZ_OUTCOME_UNVERIFIED] = "NO VERIFIED DESIGN FOUND",
                                        [CZ_OUTCOME_INFEASIBLE] = "NO FEASIBLE DESIGN FOUND",
                                        [CZ_OUTCOME_INTERRUPTED] = "INTERRUPTED"};
    static const char *const of_fit[] = {[CZ_OUTCOME_FEASIBLE] = "WITHIN EVERY TOLERANCE",
                                         [CZ_OUTCOME_UNVERIFIED] = "NOT VERIFIED",
                                         [CZ_OUTCOME_INFEASIBLE] = "NOT WITHIN EVERY TOLERANCE",
                                         [CZ_OUTCOME_INTERRUPTED] = "INTERRUPTED"};
    return (cz_evaluator_is_fit(evaluator) ? of_fit : words)[outcome->status];
}

/* Constraints that could not be judged did not guide the search; those of a scenario that was left
 * out after an interruption did. */
static void write_unchecked(const CzEvaluation *best, CzTerminal *terminal) {
    int n = 0;
    for (int i = 0; best->constraint_check != NULL && i < best->n_constraint; i++)
        n += best->constraint_check[i].verdict == CZ_VERDICT_NOT_CHECKED &&
             !best->constraint_check[i].beyond_validity && !best->constraint_check[i].has_no_run;
    if (n > 0)
        cz_terminal_print(terminal, CZ_STYLE_CAREFUL,
                          "%d constraint%s NOT CHECKED and did not guide the search.\n", n,
                          n == 1 ? " was" : "s were");
}

/* A value or bound of a variable: a bound to its last digit, any other value with six, or with all
 * of them where six digits would look like a bound that it is not at. */
static const char *number_text(char text[CZ_FIGURE_SIZE], const CzVariableInfo *variable,
                               double value) {
    double read;
    if (value == variable->min || value == variable->max)
        return cz_number_print(text, value);
    cz_figure_digits(text, 6, value);
    const bool looks_like_bound =
        cz_number_parse(text, &read) == NULL && (read <= variable->min || read >= variable->max);
    return looks_like_bound ? cz_number_print(text, value) : text;
}

/* A remark next to the values of a variable: that it is fixed, or at its bound; else "". */
static const char *remark_on(const CzVariableInfo *variable, bool is_at_bound) {
    if (variable->is_fixed)
        return variable->min == variable->max ? "fixed: min = max"
                                              : "fixed: one increment within its bounds";
    return is_at_bound ? "at its bound" : "";
}

void cz_scenario_use_sentence(const CzOutcome *outcome, size_t room, char *text) {
    long n_run = 0;
    int n_in_set = 0;
    for (int s = 0; s < outcome->n_scenario; s++) {
        n_run += outcome->scenario[s].n_run;
        n_in_set += outcome->scenario[s].is_in_set;
    }
    text[0] = '\0';
    if (outcome->n_scenario > 0)
        snprintf(
            text, room,
            "%d of %d scenarios limit the designs; %ld of %ld designs were run in all of them: "
            "%ld of %ld runs.",
            n_in_set, outcome->n_scenario, outcome->n_whole, outcome->n_evaluation, n_run,
            outcome->n_evaluation * outcome->n_scenario);
}

void cz_rejected_sentence(const CzReport *report, const CzRejected *rejected, size_t room,
                          char *text) {
    const CzEvaluator *evaluator = report->evaluator;
    const CzVerifiedValue *value = &rejected->value;
    char objective[CZ_FIGURE_SIZE], change[CZ_FIGURE_SIZE];
    if (cz_evaluator_maximises_margin(evaluator))
        cz_figure_margin(objective, -rejected->objective);
    else
        cz_figure_plain(objective, rejected->objective);
    const char *method = cz_verify_method_text(rejected->method);
    if (value->name == NULL)
        snprintf(text, room, "Not verified: %s: %s", objective, rejected->failure);
    else if (value->flips[rejected->method])
        snprintf(text, room, "Not verified: %s: %s changes the verdict of %s%s%s", objective,
                 method, value->name, value->scenario[0] != '\0' ? ", " : "", value->scenario);
    else
        snprintf(text, room, "Not verified: %s: %s changes %s%s%s by %s", objective, method,
                 value->name, value->scenario[0] != '\0' ? ", " : "", value->scenario,
                 cz_figure_percent(change, value->change[rejected->method]));
}

static void write_head(const CzEvaluator *evaluator, const CzOutcome *outcome,
                       CzTerminal *terminal) {
    static const CzStyle styles[] = {[CZ_OUTCOME_FEASIBLE] = CZ_STYLE_GOOD,
                                     [CZ_OUTCOME_UNVERIFIED] = CZ_STYLE_BAD,
                                     [CZ_OUTCOME_INFEASIBLE] = CZ_STYLE_BAD,
                                     [CZ_OUTCOME_INTERRUPTED] = CZ_STYLE_CAREFUL};
    cz_terminal_print(terminal, styles[outcome->status], "%s",
                      cz_outcome_words(evaluator, outcome));
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, " after %ld evaluation%s: %s",
                      outcome->n_evaluation, outcome->n_evaluation == 1 ? "" : "s",
                      outcome->why_stopped);
    if (outcome->status == CZ_OUTCOME_INTERRUPTED)
        fprintf(terminal->stream, "; the best so far is %sfeasible",
                outcome->best_evaluation.violation <= 0 ? "" : "NOT ");
    fputc('\n', terminal->stream);
    char text[CZ_SENTENCE_SIZE];
    cz_scenario_use_sentence(outcome, sizeof text, text);
    if (text[0] != '\0')
        fprintf(terminal->stream, "%s\n", text);
    write_unchecked(&outcome->best_evaluation, terminal);
    if (outcome->start_evaluation.beyond_validity || outcome->best_evaluation.beyond_validity)
        cz_terminal_print(terminal, CZ_STYLE_BAD, CZ_FIGURE_CAUTION "\n");
    write_objective(evaluator, outcome, terminal);
}

/* Place of a value between the bounds, 0 to 1; NaN when the bounds are equal. */
static double share_of(const CzVariableInfo *variable, double value) {
    const double range = variable->max - variable->min;
    return range > 0 ? (value - variable->min) / range : NAN;
}

void cz_outcome_begin_variables(CzReportTable *table, const CzReport *report, bool on_page) {
    const CzOutcome *outcome = report->outcome;
    cz_table_begin(table, "variable;unit;>min;>max;>before;>after");
    cz_table_head(table, on_page ? "place" : NULL);
    cz_table_head(table, "");
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *variable = cz_evaluator_variable(report->evaluator, i);
        const double numbers[] = {variable->min, variable->max, outcome->start[i],
                                  outcome->best[i]};
        char text[CZ_FIGURE_SIZE];
        cz_table_put(table, variable->name);
        cz_table_put(table, variable->unit);
        for (int k = 0; k < 4; k++)
            cz_table_put(table, variable->n_choice > 0 && k < 2 ? ""
                                : variable->n_choice > 0        ? variable->choice[(int)numbers[k]]
                                                         : number_text(text, variable, numbers[k]));
        cz_table_put_range(table, share_of(variable, outcome->start[i]),
                           share_of(variable, outcome->best[i]));
        cz_table_put_styled(table, remark_on(variable, outcome->at_bound[i]), CZ_STYLE_CAREFUL);
    }
}

/* Writes a table and an empty line. */
static void write_table(CzReportTable *table, CzTerminal *terminal) {
    cz_table_write_text(table, terminal);
    fputc('\n', terminal->stream);
}

/* The measured values and histories of a fit, before and after. */
static void write_matches(const CzOutcome *outcome, CzTerminal *terminal) {
    const CzEvaluation *best = &outcome->best_evaluation, *start = &outcome->start_evaluation;
    CzReportTable table;
    cz_table_begin(&table, "match;where;unit;>measured;>tolerance;>before;>after;>off by");
    for (int i = 0; i < best->n_match; i++) {
        const CzMatchResult *match = &best->match[i];
        const double numbers[] = {match->is_history ? NAN : match->target, match->tolerance,
                                  i < start->n_match ? start->match[i].value : NAN, match->value};
        char text[CZ_FIGURE_SIZE + 16], number[CZ_FIGURE_SIZE];
        cz_table_put(&table, match->name);
        cz_table_put(&table, match->where);
        cz_table_put(&table, match->unit);
        for (int k = 0; k < 4; k++)
            cz_table_put(&table, k == 0 && match->is_history
                                     ? "history"
                                     : cz_figure_digits(text, 5, numbers[k]));
        cz_figure_fixed(number, 2, match->residual);
        snprintf(text, sizeof text, "%s%.40s tol", number[0] == '-' ? "" : "+", number);
        cz_table_put_styled(&table, text,
                            fabs(match->residual) <= 1 ? CZ_STYLE_GOOD : CZ_STYLE_BAD);
    }
    write_table(&table, terminal);
}

/* Further parameter sets that fit about as well, a column each. */
static void write_alternatives(const CzEvaluator *evaluator, const CzOutcome *outcome,
                               CzTerminal *terminal) {
    enum { MAX_SETS = 5 };
    const int n_set = outcome->n_alternative < MAX_SETS ? outcome->n_alternative : MAX_SETS;
    char text[CZ_FIGURE_SIZE];
    if (n_set == 0) {
        fputs("No other parameter set of this search fits as well.\n\n", terminal->stream);
        return;
    }
    CzReportTable table;
    cz_table_begin(&table, "further sets;>best");
    for (int i = 0; i < n_set; i++) {
        snprintf(text, sizeof text, ">set %d", i + 2);
        cz_table_head(&table, text);
    }
    for (int k = -1; k < outcome->n_variable; k++) {
        const double best = k < 0 ? outcome->best_evaluation.objective : outcome->best[k];
        cz_table_put(&table, k < 0 ? "sum of squares" : cz_evaluator_variable(evaluator, k)->name);
        cz_table_put(&table, cz_figure_digits(text, 4, best));
        for (int i = 0; i < n_set; i++)
            cz_table_put(&table, cz_figure_digits(
                                     text, 4,
                                     k < 0 ? outcome->alternative_objective[i]
                                           : outcome->alternative[i * outcome->n_variable + k]));
    }
    write_table(&table, terminal);
}

void cz_outcome_put_constraint(CzReportTable *table, const CzEvaluator *evaluator,
                               const CzEvaluation *best, int i, double margin) {
    const CzCheckResult *check = best->constraint_check != NULL ? &best->constraint_check[i] : NULL;
    const CzStyle style = best->constraint[i] > 0 ? CZ_STYLE_BAD : CZ_STYLE_PLAIN;
    char text[CZ_CHECK_SIZE];
    cz_table_put_styled(table, cz_evaluator_constraint_name(evaluator, i), style);
    cz_table_put(table, check != NULL ? check->where : "");
    cz_table_put(table, check != NULL ? check->scenario : "");
    cz_table_put(table, check != NULL ? cz_checks_limit(text, check) : "");
    cz_table_put(table, check != NULL ? cz_checks_value(text, check) : "");
    cz_table_put(table, check != NULL ? cz_figure_margin(text, margin) : "");
}

/* Every check that the best design violates, in its worst scenario; a constraint may also be a
 * target, which is not among the checks above. */
static void write_violations(const CzEvaluator *evaluator, const CzOutcome *outcome,
                             CzTerminal *terminal) {
    const CzEvaluation *best = &outcome->best_evaluation;
    if (best->violation <= 0 || best->n_constraint == best->n_match)
        return; /* the matches of a fit have a table of their own */
    char text[CZ_FIGURE_SIZE];
    CzReportTable table;
    cz_table_begin(&table, "violated, worst scenario;" CZ_CONSTRAINT_HEADS ";>scenarios");
    for (int i = 0; i < best->n_constraint; i++) {
        const int n = cz_worth_n_violated(best, i);
        if (n == 0)
            continue;
        cz_outcome_put_constraint(&table, evaluator, best, i,
                                  best->constraint_check != NULL ? best->constraint_check[i].margin
                                                                 : NAN);
        cz_table_put(&table, cz_figure_digits(text, 9, n));
    }
    fputc('\n', terminal->stream);
    cz_table_write_text(&table, terminal);
}

/* The worth of limits, or those that conflict, and the smallest relaxation of one. */
static void write_worth(const CzReport *report, CzTerminal *terminal) {
    char text[CZ_SENTENCE_SIZE];
    CzReportTable table;
    if (cz_worth_is_known(report->outcome)) {
        cz_worth_sentence(report, sizeof text, text);
        fprintf(terminal->stream, "\n%s\n", text);
        if (report->outcome->n_multiplier > 0) {
            cz_worth_begin_table(&table, report);
            cz_table_write_text(&table, terminal);
        }
    }
    if (cz_margins_are_capped(report->outcome)) {
        cz_margins_begin_table(&table, report);
        fputc('\n', terminal->stream);
        cz_table_write_text(&table, terminal);
    }
    cz_relaxation_sentence(report, sizeof text, text);
    if (text[0] != '\0')
        fprintf(terminal->stream, "\n%s\n", text);
}

/* A change in percent, rounded up to one decimal. */
static double tenths_above(double change) {
    return 0.1 * ceil(1e3 * change);
}

/* The result with the largest change, where this exceeds the limit. */
static void write_worst(const CzVerification *verification, CzVerifyMethod method, FILE *stream) {
    char text[CZ_FIGURE_SIZE];
    if (!verification->is_done[method] ||
        verification->largest_change[method] <= verification->limit)
        return;
    const CzVerifiedValue *value = &verification->value[verification->worst[method]];
    const char *scenario = value->scenario[0] != '\0' ? value->scenario : "design";
    fprintf(stream, "Largest change with %s: %s%s%s, %s, %s\n", cz_verify_method_text(method),
            value->name, value->where[0] != '\0' ? " at " : "", value->where, scenario,
            cz_figure_percent(text, value->change[method]));
}

static void write_verification(const CzVerification *verification, CzTerminal *terminal) {
    char text[CZ_FIGURE_SIZE];
    if (verification == NULL)
        return;
    const bool passes = verification->verdict == CZ_VERDICT_PASS;
    fputs("\nLargest changes: ", terminal->stream);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        if (verification->is_done[method])
            fprintf(terminal->stream, "%s %s %%, ", cz_verify_method_text((CzVerifyMethod)method),
                    cz_figure_fixed(text, 1, tenths_above(verification->largest_change[method])));
    fputs("verification ", terminal->stream);
    cz_terminal_print(terminal, passes ? CZ_STYLE_GOOD : CZ_STYLE_BAD, passes ? "pass" : "FAIL");
    fprintf(terminal->stream, "%s%s\n", verification->failure[0] != '\0' ? ": " : "",
            verification->failure);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        write_worst(verification, (CzVerifyMethod)method, terminal->stream);
}

/* The first designs that were not verified. */
static void write_rejected(const CzReport *report, CzTerminal *terminal) {
    enum { MAX_LINES = 4 };
    const int n = report->outcome->n_rejected;
    char text[CZ_SENTENCE_SIZE];
    for (int i = 0; i < n && i < MAX_LINES; i++) {
        cz_rejected_sentence(report, &report->outcome->rejected[i], sizeof text, text);
        fprintf(terminal->stream, "%s\n", text);
    }
    if (n > MAX_LINES)
        fprintf(terminal->stream, "Not verified: %d more\n", n - MAX_LINES);
}

void cz_outcome_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzEvaluator *evaluator = report->evaluator;
    const CzOutcome *outcome = report->outcome;
    CzReportTable variables;
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n\n", cz_problem_title(report->problem));
    write_head(evaluator, outcome, terminal);
    cz_outcome_begin_variables(&variables, report, false);
    write_table(&variables, terminal);
    if (cz_evaluator_is_fit(evaluator)) {
        write_matches(outcome, terminal);
        write_alternatives(evaluator, outcome, terminal);
    }
    cz_checks_write_table(&outcome->best_evaluation, &outcome->start_evaluation, terminal);
    write_violations(evaluator, outcome, terminal);
    write_worth(report, terminal);
    write_verification(outcome->verification, terminal);
    write_rejected(report, terminal);
    if (report->robust != NULL)
        cz_robust_write_table(report->robust, terminal);

    fputs("\nNew values:\n", terminal->stream);
    if (cz_overlay_write_values(report, false, terminal->stream, NULL) == CZ_OK)
        return;
    fputs("no memory for the new values\n", terminal->stream);
    terminal->failed = true;
}
