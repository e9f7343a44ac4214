/* Tables and sentences of a corridor, and its text on a terminal. */
#include "report/corridor_table.h"

#include "report/figure.h"
#include "report/tables.h"
#include "report/verdict_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- sentences ---- */

/* Why a curve fails. */
static void failure_reason(const CzTriedCurve *curve, size_t room, char *text) {
    char number[CZ_FIGURE_SIZE];
    if (curve->check[0] == '\0')
        snprintf(text, room, "%s", curve->message);
    else if (curve->verdict == CZ_VERDICT_NOT_CHECKED)
        snprintf(text, room, "'%s' in %s is not checked", curve->check, curve->scenario);
    else
        snprintf(text, room, "'%s'%s%s in %s, margin %s", curve->check,
                 curve->where[0] != '\0' ? " at " : "", curve->where, curve->scenario,
                 cz_figure_margin(number, curve->margin));
}

/* An edge in percent, such as "-14" or "+20". */
static const char *edge_percent(const CzCorridor *corridor, int edge,
                                char text[CZ_FIGURE_SIZE + 1]) {
    const double percent = 100 * corridor->edge[edge].width;
    text[0] = '+';
    cz_figure_digits(text + (edge == 1 && percent > 0), 6, edge == 0 ? 0 - percent : percent);
    return text;
}

void cz_corridor_result_sentence(const CzCorridor *corridor, char text[CZ_CORRIDOR_SENTENCE]) {
    const CzTriedCurve *failure = cz_corridor_failure(corridor);
    char low[CZ_FIGURE_SIZE + 1], high[CZ_FIGURE_SIZE + 1], words[CZ_CURVE_WORDS], reason[400];
    const bool is_provisional =
        corridor->exists && corridor->curve[0].verdict == CZ_VERDICT_PROVISIONAL;
    const char *end =
        is_provisional ? ", PROVISIONAL: by limits or scenarios that are not confirmed" : "";
    if (corridor->exists && corridor->edge[0].width + corridor->edge[1].width == 0) {
        snprintf(text, CZ_CORRIDOR_SENTENCE, "Corridor narrower than %s %% of the nominal forces%s",
                 cz_figure_digits(low, 3, 100 * corridor->resolution), end);
    } else if (corridor->exists) {
        snprintf(text, CZ_CORRIDOR_SENTENCE, "Corridor %s to %s %% of the nominal forces%s",
                 edge_percent(corridor, 0, low), edge_percent(corridor, 1, high), end);
    } else if (failure == NULL) {
        snprintf(text, CZ_CORRIDOR_SENTENCE, "No corridor yet");
    } else {
        failure_reason(failure, sizeof reason, reason);
        snprintf(text, CZ_CORRIDOR_SENTENCE, "NO CORRIDOR: the %s fails: %s%s",
                 cz_curve_words(failure, words), reason,
                 failure->sample >= 0 ? "; --no-scatter leaves the scatter out" : "");
    }
}

void cz_corridor_device_sentence(const CzCorridor *corridor, char text[CZ_CORRIDOR_SENTENCE]) {
    int n = snprintf(text, CZ_CORRIDOR_SENTENCE, "%s %s", corridor->what, corridor->path);
    if (corridor->count > 1)
        n += snprintf(text + n, (size_t)(CZ_CORRIDOR_SENTENCE - n), ", %d side by side",
                      corridor->count);
    for (int i = 0; i < corridor->n_place && n < CZ_CORRIDOR_SENTENCE - 80; i++)
        n += snprintf(text + n, (size_t)(CZ_CORRIDOR_SENTENCE - n), "%s%s", i == 0 ? ", at " : ", ",
                      corridor->place[i]);
}

void cz_corridor_tried_sentence(const CzCorridor *corridor, char text[CZ_CORRIDOR_SENTENCE]) {
    char scatter[80] = "", number[CZ_FIGURE_SIZE];
    if (corridor->n_draw > 0)
        snprintf(scatter, sizeof scatter, ", these and the edges in %d samples of the scatter",
                 corridor->n_random);
    snprintf(text, CZ_CORRIDOR_SENTENCE,
             "%d curves of %d piece%s%s%s were tried, and the %d within the corridor pass: at each "
             "width edges, rising, falling and alternating curves; in the widest corridor %d "
             "quasi-random ones (seed %ld)%s, and those of an adversary; widths in steps of %s %%",
             corridor->n_curve, corridor->n_piece, corridor->n_piece > 1 ? "s" : "",
             corridor->peak_word != NULL ? " and a " : "",
             corridor->peak_word != NULL ? corridor->peak_word : "", corridor->n_inside,
             corridor->n_random, corridor->seed, scatter,
             cz_figure_digits(number, 3, 100 * corridor->resolution));
}

/* ---- tables ---- */

void cz_corridor_begin_points(CzReportTable *table, const CzCorridor *corridor) {
    char text[CZ_FIGURE_SIZE];
    cz_table_begin(table, ">stroke [mm];>lower [kN];>nominal [kN];>upper [kN]");
    for (int i = 0; i < corridor->n_point; i++) {
        const double force[] = {corridor->lower[i], corridor->nominal[i], corridor->upper[i]};
        cz_table_put(table, cz_figure_digits(text, 6, 1e3 * corridor->stroke[i]));
        for (int c = 0; c < 3; c++)
            cz_table_put(table, cz_figure_digits(text, 6, 1e-3 * force[c]));
    }
}

static void put_edge(CzReportTable *table, const CzCorridor *corridor, int edge) {
    const int failing = corridor->edge[edge].failing;
    char text[CZ_FIGURE_SIZE + 1], words[CZ_CURVE_WORDS];
    cz_table_put(table, edge == 0 ? "lower" : "upper");
    cz_table_put_format(table, "%s %%", edge_percent(corridor, edge, text));
    if (failing < 0) {
        cz_table_put(table, corridor->is_interrupted ? "not known" : "none found");
        for (int i = 0; i < 4; i++)
            cz_table_put(table, "");
        return;
    }
    const CzTriedCurve *curve = &corridor->curve[failing];
    cz_table_put(table, curve->check[0] != '\0'             ? curve->check
                        : curve->state == CZ_SAMPLE_INVALID ? "rule of problem files"
                                                            : "run failed");
    cz_table_put(table, curve->where);
    cz_table_put(table, curve->scenario);
    cz_table_put(table, cz_curve_words(curve, words));
    cz_table_put(table, cz_figure_margin(text, curve->margin));
}

void cz_corridor_begin_edges(CzReportTable *table, const CzCorridor *corridor) {
    cz_table_begin(table, "edge;>width;limited by;where;scenario;failing curve beyond;>margin");
    for (int edge = 0; edge < 2; edge++)
        put_edge(table, corridor, edge);
}

const char *cz_corridor_message(const CzCorridor *corridor, int edge) {
    const int failing = corridor->edge[edge].failing;
    return failing >= 0 && corridor->curve[failing].message[0] != '\0'
               ? corridor->curve[failing].message
               : NULL;
}

/* ---- the terminal ---- */

void cz_corridor_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzCorridor *corridor = report->corridor;
    char text[CZ_CORRIDOR_SENTENCE];
    CzReportTable table;
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n", cz_problem_title(corridor->problem));
    cz_corridor_device_sentence(corridor, text);
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n\n", text);
    if (corridor->exists) {
        cz_corridor_begin_points(&table, corridor);
        cz_table_write_text(&table, terminal);
        fputc('\n', terminal->stream);
        cz_corridor_begin_edges(&table, corridor);
        cz_table_write_text(&table, terminal);
        for (int edge = 0; edge < 2; edge++)
            if (cz_corridor_message(corridor, edge) != NULL)
                cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s edge: %s\n",
                                  edge == 0 ? "lower" : "upper",
                                  cz_corridor_message(corridor, edge));
        fputc('\n', terminal->stream);
    }
    cz_corridor_result_sentence(corridor, text);
    cz_terminal_print(terminal, corridor->exists ? CZ_STYLE_GOOD : CZ_STYLE_BAD, "%s.\n", text);
    if (corridor->exists) {
        cz_corridor_tried_sentence(corridor, text);
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s.\n", text);
    }
    cz_screening_print(corridor->problem, terminal);
    if (!corridor->is_interrupted)
        cz_terminal_print(
            terminal, CZ_STYLE_PLAIN, "The design as written, with its reserves: %s.\n",
            cz_verdict_words(corridor->design.verdict, corridor->design.n_not_covered));
    else
        cz_terminal_print(terminal, CZ_STYLE_BAD, "INTERRUPTED: not all curves were tried.\n");
}
