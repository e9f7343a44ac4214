/* What a search answers, on a terminal: before and after, what is still violated, new values. */
#include "crushzone/report.h"

#include "base/number.h"
#include "evaluate/evaluator.h"
#include "report/checks_table.h"
#include "report/figure.h"
#include "report/outcome_table.h"
#include "report/overlay.h"

#include <math.h>

/* The objective before and after. */
static void write_objective(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                            FILE *stream) {
    const char *unit = cz_evaluator_objective_unit(evaluator);
    const double before = outcome->start_evaluation.objective;
    const double after = outcome->best_evaluation.objective;
    const bool before_beyond = outcome->start_evaluation.beyond_validity;
    const bool after_beyond = outcome->best_evaluation.beyond_validity;
    char start[CZ_FIGURE_ROOM], best[CZ_FIGURE_ROOM];
    if (cz_evaluator_maximises_margin(evaluator)) { /* its negative is minimised */
        cz_figure_margin(start, -before);
        cz_figure_margin(best, -after);
        fprintf(stream, "smallest margin: %s -> %s\n\n", cz_figure_mark(start, before_beyond),
                cz_figure_mark(best, after_beyond));
        return;
    }
    cz_figure_plain(start, before);
    cz_figure_plain(best, after);
    fputs("objective ", stream);
    cz_text_write(cz_evaluator_objective_name(evaluator), CZ_STYLE_PLAIN, colour, stream);
    fprintf(stream, ": %s -> %s%s%s\n\n", cz_figure_mark(start, before_beyond),
            cz_figure_mark(best, after_beyond), unit != NULL && unit[0] != '\0' ? " " : "",
            unit != NULL ? unit : "");
}

const char *cz_outcome_words(const CzEvaluator *evaluator, const CzOutcome *outcome) {
    static const char *const words[] = {[CZ_OUTCOME_FEASIBLE] = "FEASIBLE",
                                        [CZ_OUTCOME_INFEASIBLE] = "NO FEASIBLE DESIGN FOUND",
                                        [CZ_OUTCOME_INTERRUPTED] = "INTERRUPTED"};
    static const char *const of_fit[] = {[CZ_OUTCOME_FEASIBLE] = "WITHIN EVERY TOLERANCE",
                                         [CZ_OUTCOME_INFEASIBLE] = "NOT WITHIN EVERY TOLERANCE",
                                         [CZ_OUTCOME_INTERRUPTED] = "INTERRUPTED"};
    return (cz_evaluator_is_fit(evaluator) ? of_fit : words)[outcome->status];
}

/* Constraints that could not be judged did not guide the search. */
static void write_unchecked(const CzEvaluation *best, bool colour, FILE *stream) {
    int n = 0;
    for (int i = 0; best->constraint_check != NULL && i < best->n_constraint; i++)
        n += best->constraint_check[i].verdict == CZ_VERDICT_NOT_CHECKED &&
             !best->constraint_check[i].beyond_validity;
    if (n == 0)
        return;
    char text[96];
    snprintf(text, sizeof text, "%d constraint%s NOT CHECKED and did not guide the search.", n,
             n == 1 ? " was" : "s were");
    cz_text_write(text, CZ_STYLE_CAREFUL, colour, stream);
    fputc('\n', stream);
}

const char *cz_outcome_number(char text[CZ_FIGURE_ROOM], const CzVariableInfo *variable,
                              double value) {
    double read;
    if (value == variable->min || value == variable->max)
        return cz_number_print(text, value);
    cz_figure_digits(text, 6, value);
    const bool looks_like_bound =
        cz_number_parse(text, &read) == NULL && (read <= variable->min || read >= variable->max);
    return looks_like_bound ? cz_number_print(text, value) : text;
}

const char *cz_outcome_remark(const CzVariableInfo *variable, bool is_at_bound) {
    if (variable->is_fixed)
        return variable->min == variable->max ? "fixed: min = max"
                                              : "fixed: one increment within its bounds";
    return is_at_bound ? "at its bound" : "";
}

static void write_head(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                       FILE *stream) {
    static const CzStyle styles[] = {[CZ_OUTCOME_FEASIBLE] = CZ_STYLE_GOOD,
                                     [CZ_OUTCOME_INFEASIBLE] = CZ_STYLE_BAD,
                                     [CZ_OUTCOME_INTERRUPTED] = CZ_STYLE_CAREFUL};
    cz_text_write(cz_outcome_words(evaluator, outcome), styles[outcome->status], colour, stream);
    fprintf(stream, " after %ld evaluation%s: ", outcome->n_evaluation,
            outcome->n_evaluation == 1 ? "" : "s");
    cz_text_write(outcome->why_stopped, CZ_STYLE_PLAIN, colour, stream);
    if (outcome->status == CZ_OUTCOME_INTERRUPTED)
        fprintf(stream, "; the best so far is %sfeasible",
                outcome->best_evaluation.violation <= 0 ? "" : "NOT ");
    fputc('\n', stream);
    write_unchecked(&outcome->best_evaluation, colour, stream);
    if (outcome->start_evaluation.beyond_validity || outcome->best_evaluation.beyond_validity) {
        cz_text_write("Override: a run went beyond model validity (" CZ_FIGURE_MARK_MEANS ").",
                      CZ_STYLE_BAD, colour, stream);
        fputc('\n', stream);
    }
    write_objective(evaluator, outcome, colour, stream);
}

/* Where a value is between the bounds; NaN when they leave no room. */
static double share_of(const CzVariableInfo *variable, double value) {
    const double range = variable->max - variable->min;
    return range > 0 ? (value - variable->min) / range : NAN;
}

void cz_outcome_begin_variables(CzReportTable *table, const CzEvaluator *evaluator,
                                const CzOutcome *outcome, bool on_page) {
    const char *const heads[] = {
        "variable", "unit", ">min", ">max", ">before", ">after", on_page ? "place" : NULL, ""};
    cz_table_begin(table, sizeof heads / sizeof *heads, heads);
    for (int i = 0; i < outcome->n_variable; i++) {
        const CzVariableInfo *variable = cz_evaluator_variable(evaluator, i);
        const double numbers[] = {variable->min, variable->max, outcome->start[i],
                                  outcome->best[i]};
        char text[CZ_FIGURE_ROOM];
        cz_table_put(table, variable->name, CZ_STYLE_PLAIN);
        cz_table_put(table, variable->unit, CZ_STYLE_PLAIN);
        for (int k = 0; k < 4; k++)
            cz_table_put(table,
                         variable->n_choice > 0 && k < 2 ? ""
                         : variable->n_choice > 0        ? variable->choice[(int)numbers[k]]
                                                  : cz_outcome_number(text, variable, numbers[k]),
                         CZ_STYLE_PLAIN);
        cz_table_put_range(table, share_of(variable, outcome->start[i]),
                           share_of(variable, outcome->best[i]));
        cz_table_put(table, cz_outcome_remark(variable, outcome->at_bound[i]), CZ_STYLE_CAREFUL);
    }
}

static bool write_variables(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                            FILE *stream) {
    CzReportTable table;
    cz_outcome_begin_variables(&table, evaluator, outcome, false);
    const bool is_whole = cz_table_write_text(&table, colour, stream);
    fputc('\n', stream);
    return is_whole;
}

/* What a fit was to reproduce, before and after. */
static bool write_matches(const CzOutcome *outcome, bool colour, FILE *stream) {
    static const char *const heads[] = {"match",      "where",   "unit",   ">measured",
                                        ">tolerance", ">before", ">after", ">off by"};
    const CzEvaluation *best = &outcome->best_evaluation, *start = &outcome->start_evaluation;
    CzReportTable table;
    cz_table_begin(&table, sizeof heads / sizeof *heads, heads);
    for (int i = 0; i < best->n_match; i++) {
        const CzMatchResult *match = &best->match[i];
        const double numbers[] = {match->is_history ? NAN : match->target, match->tolerance,
                                  i < start->n_match ? start->match[i].value : NAN, match->value};
        char text[CZ_FIGURE_ROOM + 16], number[CZ_FIGURE_ROOM];
        cz_table_put(&table, match->name, CZ_STYLE_PLAIN);
        cz_table_put(&table, match->where, CZ_STYLE_PLAIN);
        cz_table_put(&table, match->unit, CZ_STYLE_PLAIN);
        for (int k = 0; k < 4; k++)
            cz_table_put(&table,
                         k == 0 && match->is_history ? "history"
                                                     : cz_figure_digits(text, 5, numbers[k]),
                         CZ_STYLE_PLAIN);
        cz_figure_fixed(number, 2, match->residual);
        snprintf(text, sizeof text, "%s%.40s tol", number[0] == '-' ? "" : "+", number);
        cz_table_put(&table, text, fabs(match->residual) <= 1 ? CZ_STYLE_GOOD : CZ_STYLE_BAD);
    }
    const bool is_whole = cz_table_write_text(&table, colour, stream);
    fputc('\n', stream);
    return is_whole;
}

/* Further parameter sets that fit about as well, a column each. */
static bool write_alternatives(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                               FILE *stream) {
    enum { MOST_SETS = 5 };
    const int n_set = outcome->n_alternative < MOST_SETS ? outcome->n_alternative : MOST_SETS;
    char text[CZ_FIGURE_ROOM];
    if (n_set == 0) {
        fputs("No other parameter set of this search fits as well.\n\n", stream);
        return true;
    }
    CzReportTable table;
    cz_table_begin(&table, 2, (const char *const[]){"further sets", ">best"});
    for (int i = 0; i < n_set; i++) {
        snprintf(text, sizeof text, ">set %d", i + 2);
        cz_table_head(&table, text);
    }
    for (int k = -1; k < outcome->n_variable; k++) {
        const double best = k < 0 ? outcome->best_evaluation.objective : outcome->best[k];
        cz_table_put(&table, k < 0 ? "sum of squares" : cz_evaluator_variable(evaluator, k)->name,
                     CZ_STYLE_PLAIN);
        cz_table_put(&table, cz_figure_digits(text, 4, best), CZ_STYLE_PLAIN);
        for (int i = 0; i < n_set; i++)
            cz_table_put(&table,
                         cz_figure_digits(text, 4,
                                          k < 0
                                              ? outcome->alternative_objective[i]
                                              : outcome->alternative[i * outcome->n_variable + k]),
                         CZ_STYLE_PLAIN);
    }
    const bool is_whole = cz_table_write_text(&table, colour, stream);
    fputc('\n', stream);
    return is_whole;
}

void cz_outcome_begin_constraints(CzReportTable *table, const char *name, const char *left) {
    const char *const heads[] = {name, "where", "scenario", ">limit", ">value", left};
    cz_table_begin(table, sizeof heads / sizeof *heads, heads);
}

void cz_outcome_put_constraint(CzReportTable *table, const CzEvaluator *evaluator,
                               const CzEvaluation *best, int i, double left) {
    const CzCheckResult *check = best->constraint_check != NULL ? &best->constraint_check[i] : NULL;
    const CzStyle style = best->constraint[i] > 0 ? CZ_STYLE_BAD : CZ_STYLE_PLAIN;
    char text[96] = "";
    cz_table_put(table, cz_evaluator_constraint_name(evaluator, i), style);
    cz_table_put(table, check != NULL ? check->where : "", CZ_STYLE_PLAIN);
    cz_table_put(table, check != NULL ? check->scenario : "", CZ_STYLE_PLAIN);
    if (check != NULL)
        cz_checks_format_limit(check, sizeof text, text);
    cz_table_put(table, text, CZ_STYLE_PLAIN);
    if (check != NULL)
        cz_checks_format_value(check, sizeof text, text);
    cz_table_put(table, text, CZ_STYLE_PLAIN);
    cz_table_put(table, check != NULL ? cz_figure_margin(text, left) : "", CZ_STYLE_PLAIN);
}

/* Every constraint that the best design breaks; a constraint may be a target that is no check. */
static bool write_violations(const CzEvaluator *evaluator, const CzOutcome *outcome, bool colour,
                             FILE *stream) {
    const CzEvaluation *best = &outcome->best_evaluation;
    if (best->violation <= 0 || best->n_constraint == best->n_match)
        return true; /* what is matched has a table of its own */
    CzReportTable table;
    cz_outcome_begin_constraints(&table, "violated", ">margin");
    for (int i = 0; i < best->n_constraint; i++)
        if (best->constraint[i] > 0)
            cz_outcome_put_constraint(
                &table, evaluator, best, i,
                best->constraint_check != NULL ? best->constraint_check[i].margin : NAN);
    fputc('\n', stream);
    return cz_table_write_text(&table, colour, stream);
}

/* A change in per cent, up to the next tenth. */
static double tenths_above(double change) {
    return 0.1 * ceil(1e3 * change);
}

/* The number with the largest change, when this exceeds the limit. */
static void write_worst(const CzVerification *verification, CzVerifyMethod method, FILE *stream) {
    char text[CZ_FIGURE_ROOM];
    if (!verification->is_done[method] ||
        verification->largest_change[method] <= verification->limit)
        return;
    const CzVerifiedValue *value = &verification->value[verification->worst[method]];
    const char *scenario = value->scenario[0] != '\0' ? value->scenario : "design";
    fprintf(stream, "Largest change with %s: %s%s%s, %s, %s\n", cz_verify_method_text(method),
            value->name, value->where[0] != '\0' ? " at " : "", value->where, scenario,
            cz_figure_percent(text, value->change[method]));
}

/* Verification of the optimum. */
static void write_verification(const CzVerification *verification, bool colour, FILE *stream) {
    char text[CZ_FIGURE_ROOM];
    if (verification == NULL)
        return;
    const bool passes = verification->verdict == CZ_VERDICT_PASS;
    fputs("\nLargest changes: ", stream);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        if (verification->is_done[method])
            fprintf(stream, "%s %s %%, ", cz_verify_method_text((CzVerifyMethod)method),
                    cz_figure_fixed(text, 1, tenths_above(verification->largest_change[method])));
    fputs("verification ", stream);
    cz_text_write(passes ? "pass" : "FAIL", passes ? CZ_STYLE_GOOD : CZ_STYLE_BAD, colour, stream);
    fprintf(stream, "%s%s\n", verification->failure[0] != '\0' ? ": " : "", verification->failure);
    for (int method = 0; method < CZ_N_VERIFY_METHOD; method++)
        write_worst(verification, (CzVerifyMethod)method, stream);
}

CzStatus cz_report_write_outcome_table(const CzProblem *problem, const CzEvaluator *evaluator,
                                       const CzOutcome *outcome, bool colour, FILE *stream) {
    bool is_whole = true;
    cz_text_write(cz_problem_title(problem), CZ_STYLE_PLAIN, colour, stream);
    fputs("\n\n", stream);
    write_head(evaluator, outcome, colour, stream);
    is_whole &= write_variables(evaluator, outcome, colour, stream);
    if (cz_evaluator_is_fit(evaluator)) {
        is_whole &= write_matches(outcome, colour, stream);
        is_whole &= write_alternatives(evaluator, outcome, colour, stream);
    }
    is_whole &= cz_checks_write_table(&outcome->best_evaluation, &outcome->start_evaluation, colour,
                                      stream);
    is_whole &= write_violations(evaluator, outcome, colour, stream);
    write_verification(outcome->verification, colour, stream);

    CzArena arena = {0};
    int n_setting;
    const char **setting = cz_overlay_settings(evaluator, outcome, NULL, &arena, &n_setting);
    fputs("\nNew values:\n", stream);
    if (setting != NULL)
        cz_overlay_write_set(n_setting, setting, stream);
    cz_arena_free(&arena);
    return is_whole ? CZ_OK : CZ_STATUS_NO_MEMORY;
}
