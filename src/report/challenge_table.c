/* A challenge on a terminal and on its page: weak points, their values, the outcome. */
#include "report/challenge_table.h"

#include "report/figure.h"
#include "report/sample_table.h"
#include "report/tables.h"
#include "report/verdict_words.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

/* ---- sentences ---- */

static void add(char text[CZ_CHALLENGE_SENTENCE], const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static void add(char text[CZ_CHALLENGE_SENTENCE], const char *format, ...) {
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, CZ_CHALLENGE_SENTENCE - used, format, arguments);
    va_end(arguments);
}

/* A number that a point has, such as "mass +4.7 %" of a factor. */
static void add_value(char text[CZ_CHALLENGE_SENTENCE], const CzDraw *draw, double value) {
    char number[CZ_FIGURE_SIZE];
    const bool is_factor = draw->effect == CZ_DRAW_FACTOR;
    const double shown = is_factor ? 100 * (value - 1) : value;
    const char *unit = is_factor ? "%" : draw->unit;
    add(text, "%s %s%s%s%s", draw->name, draw->effect != CZ_DRAW_VALUE && shown >= 0 ? "+" : "",
        cz_figure_digits(number, 4, shown), unit[0] != '\0' ? " " : "", unit);
}

void cz_challenge_values_sentence(const CzChallenge *challenge, int point,
                                  char text[CZ_CHALLENGE_SENTENCE]) {
    text[0] = '\0';
    for (int d = 0; d < challenge->n_draw; d++) {
        add(text, "%s", d > 0 ? "; " : "");
        add_value(text, &challenge->draw[d], cz_challenge_value(challenge, point, d));
    }
}

static void add_weak(char text[CZ_CHALLENGE_SENTENCE], const CzWeakPoint *weak) {
    char number[CZ_FIGURE_SIZE];
    const CzCheckResult *check = &weak->check;
    if (check->name == NULL) {
        add(text, "%s", weak->message != NULL ? weak->message : "a vehicle climbed");
        return;
    }
    add(text, "%s%s%s, %s", check->name, check->where[0] != '\0' ? " at " : "", check->where,
        check->scenario);
    if (!isnan(check->margin))
        add(text, ", margin %s", cz_figure_margin(number, check->margin));
    if (weak->message != NULL)
        add(text, "; %s", weak->message);
}

void cz_challenge_weak_sentence(const CzChallenge *challenge, int weak,
                                char text[CZ_CHALLENGE_SENTENCE]) {
    text[0] = '\0';
    add_weak(text, &challenge->weak[weak]);
}

void cz_challenge_method_sentence(const CzChallenge *challenge, char text[CZ_CHALLENGE_SENTENCE]) {
    text[0] = '\0';
    add(text,
        "%d runs of at most %d, each of %d scenario%s; %d number%s, %d of the envelope; seed %ld",
        challenge->n_point, challenge->most_points, challenge->n_scenario,
        challenge->n_scenario == 1 ? "" : "s", challenge->n_draw, challenge->n_draw == 1 ? "" : "s",
        challenge->n_span, challenge->seed);
}

/* The first weak point that has a margin; the first of all where none has. */
static int weakest(const CzChallenge *challenge) {
    for (int i = 0; i < challenge->n_weak; i++)
        if (challenge->weak[i].check.name != NULL && !isnan(challenge->weak[i].check.margin))
            return i;
    return 0;
}

void cz_challenge_outcome_sentence(const CzChallenge *challenge, char text[CZ_CHALLENGE_SENTENCE]) {
    text[0] = '\0';
    if (challenge->n_weak == 0) {
        add(text, "%d runs found no point with a margin", challenge->n_point);
        return;
    }
    const int least = weakest(challenge);
    char values[CZ_CHALLENGE_SENTENCE];
    if (challenge->is_broken)
        add(text, "%d of %d runs broke it; worst: ", challenge->n_fail, challenge->n_point);
    else
        add(text, "%d runs could not break it; smallest margin: ", challenge->n_point);
    add_weak(text, &challenge->weak[least]);
    cz_challenge_values_sentence(challenge, challenge->weak[least].point, values);
    add(text, ", at %.2000s", values);
}

/* ---- tables ---- */

static void put_weak(CzReportTable *table, const CzChallenge *challenge, int i, bool on_page) {
    const CzWeakPoint *weak = &challenge->weak[i];
    const CzCheckResult *check = &weak->check;
    const bool fails = weak->verdict == CZ_VERDICT_FAIL, has_check = check->name != NULL;
    char text[CZ_FIGURE_SIZE], values[CZ_CHALLENGE_SENTENCE];
    cz_table_put(table, cz_figure_digits(text, 9, i + 1));
    cz_table_put_styled(table,
                        weak->state != CZ_SAMPLE_DONE ? cz_sample_state_text(weak->state)
                        : fails                       ? "FAIL"
                                                      : cz_verdict_text(weak->verdict),
                        fails ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
    cz_table_put(table, has_check ? check->name : "");
    cz_table_put(table, check->where);
    cz_table_put(table, check->scenario);
    cz_figure_plain(text, check->value);
    cz_table_put_format(table, "%s%s%s", text, has_check && check->unit[0] != '\0' ? " " : "",
                        has_check ? check->unit : "");
    cz_table_put_format(table, "%s%s", check->is_minimum ? "min " : "",
                        cz_figure_plain(text, check->limit));
    cz_table_put(table, cz_figure_margin(text, check->margin));
    cz_table_put(table, cz_figure_digits(text, 9, weak->n_fail));
    if (on_page) {
        cz_challenge_values_sentence(challenge, weak->point, values);
        cz_table_put(table, cz_figure_digits(text, 9, weak->point + 1));
        cz_table_put(table, values);
    }
}

void cz_challenge_begin_weak(CzReportTable *table, const CzChallenge *challenge, bool on_page) {
    cz_table_begin(table, ">;;check;where;scenario;>value;>limit;>margin;>failing checks");
    if (on_page) {
        cz_table_head(table, ">point");
        cz_table_head(table, "at");
    }
    for (int i = 0; i < challenge->n_weak; i++)
        put_weak(table, challenge, i, on_page);
}

/* ---- the terminal ---- */

enum { MAX_DRAWS = 24 };

void cz_challenge_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzChallenge *challenge = report->challenge;
    CzReportTable table;
    char text[CZ_CHALLENGE_SENTENCE];
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n", cz_problem_title(challenge->problem));
    cz_challenge_method_sentence(challenge, text);
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n\n", text);
    if (challenge->n_draw <= MAX_DRAWS) {
        cz_sample_begin_draws(&table, CZ_DRAW_HEADS("number"), challenge->n_draw, challenge->draw);
        cz_table_write_text(&table, terminal);
        fputc('\n', terminal->stream);
    }
    cz_challenge_begin_weak(&table, challenge, false);
    cz_table_write_text(&table, terminal);
    fputc('\n', terminal->stream);
    for (int i = 0; i < challenge->n_weak; i++) {
        cz_challenge_values_sentence(challenge, challenge->weak[i].point, text);
        const char *message = challenge->weak[i].message;
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%d at %s%s%s\n", i + 1, text,
                          message != NULL ? "; " : "", message != NULL ? message : "");
    }
    cz_challenge_outcome_sentence(challenge, text);
    fputc('\n', terminal->stream);
    cz_terminal_print(terminal, challenge->is_broken ? CZ_STYLE_BAD : CZ_STYLE_GOOD, "%s.\n", text);
    if (challenge->n_failed > 0)
        cz_terminal_print(terminal, CZ_STYLE_BAD,
                          "%d of the runs gave no result, and count as failing.\n",
                          challenge->n_failed);
    cz_screening_print(challenge->problem, terminal);
    if (challenge->is_interrupted)
        cz_terminal_print(terminal, CZ_STYLE_BAD, "INTERRUPTED: runs are missing.\n");
}
