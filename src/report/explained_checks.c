/* Explained checks on a terminal: time and place, carriers, states of elements, changes that help.
 */
#include "report/explained_checks.h"

#include "report/checks_table.h"
#include "report/figure.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

enum { MAX_CHANGES = 6 }; /* on a terminal */

static void write_head(const CzExplainedCheck *explained, CzTerminal *terminal) {
    const CzCheckResult *check = &explained->check;
    char value[CZ_CHECK_SIZE], limit[CZ_CHECK_SIZE], text[CZ_FIGURE_SIZE];
    cz_terminal_print(terminal,
                      check->verdict == CZ_VERDICT_FAIL   ? CZ_STYLE_BAD
                      : cz_verdict_passes(check->verdict) ? CZ_STYLE_GOOD
                                                          : CZ_STYLE_CAREFUL,
                      "%s", cz_checks_word(check));
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "  %s, %s%s%s: ", check->name, check->scenario,
                      check->where[0] != '\0' ? ", " : "", check->where);
    if (isnan(check->value)) {
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n", check->why != NULL ? check->why : "-");
        return;
    }
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s against %s", cz_checks_value(value, check),
                      cz_checks_limit(limit, check));
    if (!isnan(check->margin))
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ", margin %s",
                          cz_figure_margin(text, check->margin));
    if (!isnan(explained->time[0])) {
        const bool is_window = explained->time[1] > explained->time[0];
        cz_figure_fixed(text, 0, explained->time[0] * CZ_MILLI_PER_UNIT);
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ", %s %s", is_window ? "from" : "at", text);
        cz_figure_fixed(text, 0, explained->time[1] * CZ_MILLI_PER_UNIT);
        if (is_window)
            cz_terminal_print(terminal, CZ_STYLE_PLAIN, " to %s", text);
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, " ms");
    }
    fputc('\n', terminal->stream);
}

static void write_carriers(const CzExplainedCheck *explained, CzTerminal *terminal) {
    static const char *const heads[] = {[CZ_CARRIED_FORCE] = "carried by;>kN;>share",
                                        [CZ_CARRIED_ENERGY] = "absorbed by;>kJ;>share",
                                        [CZ_CARRIED_MOMENT] = "pitched by;>kNms;>share"};
    char text[CZ_FIGURE_SIZE];
    CzReportTable table;
    if (explained->n_carrier == 0)
        return;
    cz_table_begin(&table, heads[explained->carried]);
    for (int i = 0; i < explained->n_carrier; i++) {
        const CzCarrier *carrier = &explained->carrier[i];
        cz_table_put(&table, carrier->what);
        cz_table_put(&table, cz_figure_plain(text, carrier->amount / CZ_KILO));
        cz_table_put(&table, cz_figure_percent(text, carrier->share));
    }
    cz_table_write_text(&table, terminal);
}

static void write_states(const CzExplainedCheck *explained, CzTerminal *terminal) {
    char text[CZ_FIGURE_SIZE];
    CzReportTable table;
    if (explained->n_state == 0)
        return;
    cz_table_begin(&table, "element;;until then;>ms;>used in the run");
    for (int i = 0; i < explained->n_state; i++) {
        const CzElementState *state = &explained->state[i];
        cz_table_put(&table, state->interface);
        cz_table_put(&table, state->element);
        cz_table_put_styled(&table, state->state,
                            isnan(state->time) ? CZ_STYLE_PLAIN : CZ_STYLE_BAD);
        cz_table_put(&table, isnan(state->time)
                                 ? ""
                                 : cz_figure_fixed(text, 0, state->time * CZ_MILLI_PER_UNIT));
        cz_table_put(&table, cz_figure_percent(text, state->stroke_used));
    }
    cz_table_write_text(&table, terminal);
}

static void put_number(CzReportTable *table, double value, const char *unit) {
    char text[CZ_FIGURE_SIZE];
    cz_table_put_format(table, "%s %s", cz_figure_digits(text, 4, value), unit);
}

/* The margin of a change; of a yes or no its verdict. */
static void put_margin(CzReportTable *table, const CzTriedChange *change, bool is_flag) {
    char text[CZ_FIGURE_SIZE];
    cz_table_put_styled(table,
                        !is_flag         ? cz_figure_margin(text, change->margin)
                        : change->passes ? "pass"
                                         : "FAIL",
                        change->passes ? CZ_STYLE_GOOD : CZ_STYLE_PLAIN);
}

static void put_change(CzReportTable *table, const CzTriedChange *change, bool is_flag) {
    char text[CZ_FIGURE_SIZE], before[CZ_FIGURE_SIZE];
    cz_table_put(table, change->name);
    put_number(table, change->value, change->unit);
    put_number(table, change->tried, change->unit);
    put_margin(table, change, is_flag);
    if (change->other[0] == '\0')
        cz_table_put(table, "");
    else
        cz_table_put_format(table, "%s, %s: %s, was %s", change->other, change->other_scenario,
                            cz_figure_margin(text, change->other_margin),
                            cz_figure_margin(before, change->other_before));
    if (change->n_broken > 0)
        snprintf(text, sizeof text, "%d", change->n_broken);
    cz_table_put_styled(table, change->n_broken > 0 ? text : "", CZ_STYLE_BAD);
}

static void write_changes(const CzExplanation *explanation, const CzExplainedCheck *explained,
                          CzTerminal *terminal) {
    const CzTriedChange *change = explained->change;
    CzReportTable table;
    const bool has_no_margin =
        explained->check.is_flag && cz_verdict_passes(explained->check.verdict);
    if (explanation->n_tried == 0 || (explained->n_change == 0 && has_no_margin))
        return;
    if (explained->n_change == 0) {
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "No change of a single one of %d numbers %s.\n",
                          explanation->n_tried,
                          explained->check.is_flag ? "makes it pass" : "raises this margin");
        return;
    }
    const bool is_clean = change->passes && change->n_broken == 0;
    cz_terminal_print(
        terminal, CZ_STYLE_PLAIN,
        explained->check.verdict != CZ_VERDICT_FAIL ? "Single changes that raise the margin:\n"
        : is_clean ? "Single changes with which it passes and no other check breaks come "
                     "first:\n"
                   : "No single change makes it pass without breaking another check; the best "
                     "of those tried:\n");
    cz_table_begin(&table, "value;>now;>then;>margin;other check with the smallest margin;>broken");
    for (int i = 0; i < explained->n_change && i < MAX_CHANGES; i++)
        put_change(&table, &change[i], explained->check.is_flag);
    cz_table_write_text(&table, terminal);
}

void cz_explained_checks_write(const CzExplanation *explanation, CzTerminal *terminal) {
    for (int i = 0; i < explanation->n_check; i++) {
        const CzExplainedCheck *explained = &explanation->check[i];
        if (i > 0)
            fputc('\n', terminal->stream);
        write_head(explained, terminal);
        write_carriers(explained, terminal);
        write_states(explained, terminal);
        write_changes(explanation, explained, terminal);
    }
}
