/* The rounds of a robust search, and how its design holds in samples. */
#include "report/robust_table.h"

#include "problem/problem.h"
#include "report/figure.h"
#include "report/sample_table.h"
#include "report/tables.h"

#include <math.h>
#include <stdlib.h>

enum { MAX_CHECKS = 12 };

static void put_round(CzReportTable *table, const CzRobustRound *round, int number) {
    const char *result = round->is_best ? " (result)" : "";
    if (round->n_evaluation == 0)
        cz_table_put_format(table, "start%s", result);
    else
        cz_table_put_format(table, "%d%s", number, result);
    cz_table_put_format(table, "%d", round->n_scenario);
    cz_table_put_format(table, "%ld", round->n_evaluation);
    cz_sample_put_margin(table, round->nominal_margin);
    cz_sample_put_margin(table, round->required_margin);
    cz_table_put_format(table, "%d of %d", round->n_pass, round->n_sample);
    if (round->n_weak < 0)
        cz_table_put(table, "not challenged");
    else
        cz_table_put_format(table, "%d", round->n_weak);
}

void cz_robust_begin_rounds(CzReportTable *table, const CzRobust *robust) {
    cz_table_begin(table, "round;>scenarios;>evaluations;>smallest margin;>in samples;>samples "
                          "that pass;>weak points");
    const int n_start = robust->n_round > 0 && robust->round[0].n_evaluation == 0 ? 1 : 0;
    for (int i = 0; i < robust->n_round; i++)
        put_round(table, &robust->round[i], i + 1 - n_start);
}

void cz_robust_begin_checks(CzReportTable *table, const CzRobust *robust, const int *order,
                            int most) {
    const CzSampling *sampling = robust->sampling;
    cz_table_begin(table, "check;scenario;>margin;>in samples;>failing samples");
    for (int i = 0, n = 0; i < sampling->n_check; i++) {
        const CzSampledCheck *check = &sampling->check[order[i]];
        const bool is_silent = check->n_fail == 0 && isnan(check->required);
        if (is_silent || (n >= most && check->n_fail == 0))
            continue;
        n++;
        cz_table_put(table, check->name);
        cz_table_put(table, check->scenario);
        cz_sample_put_margin(table, check->nominal);
        cz_sample_put_margin(table, check->required);
        cz_table_put_format(table, "%d", check->n_fail);
    }
}

void cz_robust_challenge_sentence(const CzRobust *robust, char text[CZ_ROBUST_SENTENCE]) {
    const CzChallenge *challenge = robust->challenge;
    const CzProblem *problem = robust->problem;
    text[0] = '\0';
    if (cz_problem_input(problem)->uncertainty.n_envelope == 0)
        return;
    if (challenge == NULL)
        snprintf(text, CZ_ROBUST_SENTENCE, "The adversary was not asked, because the %s",
                 robust->outcome->status == CZ_OUTCOME_INTERRUPTED ? "search was interrupted"
                                                                   : "design fails without it");
    else if (challenge->is_broken)
        snprintf(text, CZ_ROBUST_SENTENCE,
                 "The adversary breaks the design: %d weak points after %d runs", challenge->n_weak,
                 challenge->n_point);
    else
        snprintf(text, CZ_ROBUST_SENTENCE, "%d runs of the adversary could not break the design%s",
                 challenge->n_point, challenge->is_interrupted ? " before it was interrupted" : "");
}

void cz_robust_write_table(const CzRobust *robust, CzTerminal *terminal) {
    CzReportTable table;
    char text[CZ_SAMPLE_SENTENCE];
    int *order = cz_sample_order(robust->sampling);
    if (order == NULL) {
        terminal->failed = true;
        return;
    }
    fputc('\n', terminal->stream);
    cz_robust_begin_rounds(&table, robust);
    cz_table_write_text(&table, terminal);
    fputc('\n', terminal->stream);
    cz_robust_begin_checks(&table, robust, order, MAX_CHECKS);
    cz_table_write_text(&table, terminal);
    cz_sample_share_sentence(robust->sampling, text);
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s, judged by %s.\n", text,
                      robust->sampling->judged_by);
    cz_robust_challenge_sentence(robust, text);
    if (text[0] != '\0')
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s.\n", text);
    free(order);
}

void cz_robust_write_page(const CzRobust *robust, CzMarkup *markup) {
    CzReportTable table;
    char text[CZ_SAMPLE_SENTENCE];
    int *order = cz_sample_order(robust->sampling);
    if (order == NULL) {
        markup->failed = true;
        return;
    }
    cz_markup_write(markup,
                    "<section id='robust'>\n<h2>Against scatter</h2>\n<p>Each round searches with "
                    "the scenarios that broke the design before: samples at the required "
                    "statistic, and weak points of the operating envelope. The smallest margin is "
                    "that of the scenarios of the file, with their reserves.</p>");
    cz_robust_begin_rounds(&table, robust);
    cz_table_write_page(&table, markup);
    cz_sample_share_sentence(robust->sampling, text);
    cz_markup_write(markup, "<p>%s, judged by %s.</p>", text, robust->sampling->judged_by);
    cz_robust_challenge_sentence(robust, text);
    if (text[0] != '\0')
        cz_markup_write(markup, "<p>%s.</p>", text);
    cz_robust_begin_checks(&table, robust, order, MAX_CHECKS);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</section>\n");
    free(order);
}
