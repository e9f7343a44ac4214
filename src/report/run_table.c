/* The results of a run on a terminal: forces and energies of interfaces, damage, checks. */
#include "crushzone/report.h"

#include "problem/problem.h"
#include "report/checks_table.h"
#include "report/matrix.h"
#include "report/results.h"
#include "report/runs.h"
#include "report/figure.h"
#include "report/tables.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

static double given_or(double given, double otherwise) {
    return isnan(given) ? otherwise : given;
}

/* Speeds of the two trains of a scenario by the file, with its changes, such as "36 km/h -> 0
 * km/h". */
static void write_speeds(const CzProblem *problem, const char *name, FILE *stream) {
    const CzInput *input = cz_problem_input(problem);
    const CzTrain *train[2] = {cz_input_train(input, NULL, 0), cz_input_train(input, NULL, 1)};
    double speed[2] = {NAN, NAN};
    for (int i = 0; i < input->n_scenarios; i++) {
        if (strcmp(input->scenarios[i].name, name) != 0)
            continue;
        const CzInput *changed = cz_problem_input(cz_problem_in_scenario(problem, i));
        const CzScenario *scenario = &changed->scenarios[i];
        for (int side = 0; side < 2; side++)
            train[side] = cz_input_train(changed, scenario, side);
        speed[0] = scenario->speed;
        speed[1] = scenario->partner_speed;
    }
    if (train[0] == NULL || train[1] == NULL)
        return;
    char text[2][CZ_FIGURE_SIZE];
    for (int side = 0; side < 2; side++)
        cz_figure_digits(text[side], 4,
                         given_or(speed[side], train[side]->speed) * CZ_KM_H_PER_M_S);
    fprintf(stream, "   %s km/h -> %s km/h", text[0], text[1]);
}

static void write_run_head(const CzProblem *problem, const CzRunSummary *run,
                           CzTerminal *terminal) {
    static const char poor[] = "POOR: reduce the time step";
    char number[CZ_FIGURE_SIZE];
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s", run->scenario);
    write_speeds(problem, run->scenario, terminal->stream);
    if (run->status != CZ_OK) {
        fputs("   ", terminal->stream);
        cz_terminal_print(terminal, CZ_STYLE_BAD, "RUN FAILED");
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, ": %s\n", run->failure);
        return;
    }
    fprintf(terminal->stream, "   %s s simulated, ", cz_figure_digits(number, 3, run->simulated));
    if (run->ended == CZ_ENDED_INCOMPLETE)
        cz_terminal_print(
            terminal, CZ_STYLE_BAD,
            "INCOMPLETE: end criterion not met within simulation.longest_s = %s: %s",
            cz_figure_digits(number, 3, cz_problem_input(problem)->simulation.longest),
            run->awaited);
    else
        cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s", cz_ended_text(run->ended));
    fprintf(terminal->stream, "   energy balance %s",
            cz_figure_percent(number, run->energy.balance_error));
    if (cz_run_is_unbalanced(run)) {
        fputs("   ", terminal->stream);
        cz_terminal_print(terminal, CZ_STYLE_BAD, "%s", poor);
    }
    if (cz_run_misses_laws(run)) {
        fprintf(terminal->stream, "   force error of series chains %s ",
                cz_figure_percent(number, run->law_error));
        cz_terminal_print(terminal, CZ_STYLE_BAD, "%s", poor);
    }
    fputc('\n', terminal->stream);
}

/* Devices that bottomed out or sheared off at an interface, with the time. */
static void describe_damage(const CzRunSummary *run, int interface, size_t room, char *text) {
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < run->n_event && used < room; i++) {
        const CzEvent *event = &run->event[i];
        const bool bottomed = event->what == CZ_EVENT_BOTTOMED_OUT;
        if ((!bottomed && event->what != CZ_EVENT_SHEAR_OFF) || event->interface != interface)
            continue;
        char time[CZ_FIGURE_SIZE];
        const int n = snprintf(text + used, room - used, "%s%s %s at %s ms", used > 0 ? ", " : "",
                               event->where, bottomed ? "BOTTOMED OUT" : "sheared off",
                               cz_figure_fixed(time, 0, event->time * CZ_MILLI_PER_UNIT));
        used += n > 0 ? (size_t)n : 0;
    }
    if (text[0] == '\0' && run->interface[interface].bottomed_out)
        snprintf(text, room, "BOTTOMED OUT");
}

static const CzResult *const interface_columns[] = {
    CZ_RESULT_AT(INTERFACE, peak_force_kN), CZ_RESULT_AT(INTERFACE, shortening_mm),
    CZ_RESULT_AT(INTERFACE, stroke_used), CZ_RESULT_AT(INTERFACE, energy_kJ),
    CZ_RESULT_AT(INTERFACE, energy_share)};
enum { N_INTERFACE_COLUMN = sizeof interface_columns / sizeof *interface_columns };

static void put_interface(CzReportTable *table, const CzRunSummary *run, int index) {
    const CzInterfaceResult *interface = &run->interface[index];
    const bool late = run->beyond_validity;
    const bool peak_is_late = late && !(interface->peak_time <= run->beyond_validity_time);
    const CzStyle style = interface->bottomed_out ? CZ_STYLE_BAD : CZ_STYLE_PLAIN;
    char text[CZ_FIGURE_SIZE + 2], damage[CZ_MAX_ELEMENTS * (CZ_WHERE_SIZE + CZ_FIGURE_SIZE + 32)];
    CzResultContext context = {.run = run};
    cz_table_put(table, interface->name);
    for (int k = 0; k < N_INTERFACE_COLUMN; k++) {
        const CzResult *column = interface_columns[k];
        const bool is_used = column == CZ_RESULT_AT(INTERFACE, stroke_used);
        const bool is_peak = column == CZ_RESULT_AT(INTERFACE, peak_force_kN);
        cz_result_text(text, column, &context, interface);
        cz_figure_mark(text, is_peak ? peak_is_late : late);
        if (is_used && interface->bottomed_out)
            strcat(text, " !");
        cz_table_put_styled(table, text, is_used ? style : CZ_STYLE_PLAIN);
    }
    describe_damage(run, index, sizeof damage, damage);
    cz_table_put_styled(table, damage, style);
}

/* Interfaces of a run; of several runs, the one with the largest force and those with a device that
 * bottomed out. */
static void write_interfaces(const CzRunSummary *run, bool compact, CzTerminal *terminal) {
    int worst = 0;
    for (int i = 1; i < run->n_interface; i++)
        if (run->interface[i].peak_force > run->interface[worst].peak_force)
            worst = i;
    CzReportTable table;
    cz_table_begin(&table, "interface");
    cz_table_head_results(&table, N_INTERFACE_COLUMN, interface_columns);
    cz_table_head(&table, "");
    for (int i = 0; i < run->n_interface; i++)
        if (!compact || i == worst || run->interface[i].bottomed_out)
            put_interface(&table, run, i);
    cz_table_write_text(&table, terminal);
}

/* Writes wheel lift and override, which are results of the whole run. */
static void write_climbing(const CzRunSummary *run, CzTerminal *terminal) {
    char time[CZ_FIGURE_SIZE];
    for (int i = 0; i < run->n_event; i++) {
        const CzEvent *event = &run->event[i];
        const bool override = event->what == CZ_EVENT_OVERRIDE;
        if (override || event->what == CZ_EVENT_WHEEL_LIFT)
            cz_terminal_print(terminal, override ? CZ_STYLE_BAD : CZ_STYLE_PLAIN,
                              "%s: %s at %s ms\n", override ? "OVERRIDE" : "wheel lift",
                              event->where,
                              cz_figure_fixed(time, 0, event->time * CZ_MILLI_PER_UNIT));
    }
    if (run->beyond_validity)
        cz_terminal_print(terminal, CZ_STYLE_BAD,
                          "From %s ms on this run is beyond model validity. " CZ_FIGURE_MARK_MEANS
                          ".\n",
                          cz_figure_fixed(time, 0, run->beyond_validity_time * CZ_MILLI_PER_UNIT));
}

/* ---- families of scenarios ---- */

/* The family of a scenario; NULL for none. */
static const char *family_of(const CzProblem *problem, const char *scenario) {
    const CzInput *input = cz_problem_input(problem);
    for (int i = 0; i < input->n_scenarios; i++)
        if (strcmp(input->scenarios[i].name, scenario) == 0)
            return input->scenarios[i].family;
    return NULL;
}

/* The run of a scenario of a family; NULL when it is not of that family, or was not kept. */
static const CzRunSummary *member_of(const CzProblem *problem, const CzEvaluation *evaluation,
                                     int index, const char *family) {
    const CzRunSummary *run = cz_kept_run(evaluation, index);
    const char *own = run != NULL ? family_of(problem, run->scenario) : NULL;
    return own != NULL && strcmp(own, family) == 0 ? run : NULL;
}

/* The check of a family with the smallest margin; NULL when there is none. */
static const CzCheckResult *worst_check(const CzEvaluation *evaluation, const char *family) {
    const CzCheckResult *worst = NULL;
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        if (!isnan(check->value) && check->family != NULL && strcmp(check->family, family) == 0 &&
            (worst == NULL || cz_check_is_worse(check, worst)))
            worst = check;
    }
    return worst;
}

/* The run that represents a family: one that failed or is incomplete, else the one with the worst
 * check. */
static int worst_member(const CzProblem *problem, const CzEvaluation *evaluation,
                        const char *family) {
    const CzCheckResult *worst = worst_check(evaluation, family);
    int member = -1;
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = member_of(problem, evaluation, i, family);
        if (run == NULL)
            continue;
        if (run->status != CZ_OK || run->ended == CZ_ENDED_INCOMPLETE)
            return i;
        if (member < 0 || (worst != NULL && strcmp(worst->scenario, run->scenario) == 0))
            member = i;
    }
    return member;
}

static void write_family(const CzProblem *problem, const CzEvaluation *evaluation,
                         const char *family, CzTerminal *terminal) {
    const CzCheckResult *worst = worst_check(evaluation, family);
    char margin[CZ_FIGURE_SIZE];
    int n = 0;
    for (int i = 0; i < evaluation->n_run; i++)
        n += member_of(problem, evaluation, i, family) != NULL;
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s: the worst of %d scenarios%s%s", family, n,
                      worst != NULL ? " by " : "", worst != NULL ? worst->name : "");
    if (worst != NULL && !worst->is_flag)
        fprintf(terminal->stream, ", margin %s", cz_figure_margin(margin, worst->margin));
    fputc('\n', terminal->stream);
}

/* Whether a run is printed: runs outside families, and the worst member of each family. */
static bool is_printed(const CzProblem *problem, const CzEvaluation *evaluation, int index) {
    const char *family = family_of(problem, cz_kept_run(evaluation, index)->scenario);
    return family == NULL || worst_member(problem, evaluation, family) == index;
}

void cz_run_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzProblem *problem = report->problem;
    const CzEvaluation *evaluation = report->evaluation;
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n\n", cz_problem_title(problem));
    for (int i = 0; i < evaluation->n_run; i++) {
        const CzRunSummary *run = cz_kept_run(evaluation, i);
        if (run == NULL || !is_printed(problem, evaluation, i))
            continue;
        const char *family = family_of(problem, run->scenario);
        if (family != NULL)
            write_family(problem, evaluation, family, terminal);
        write_run_head(problem, run, terminal);
        if (run->status == CZ_OK) {
            write_interfaces(run, cz_n_kept_run(evaluation) > 1, terminal);
            write_climbing(run, terminal);
        }
        fputc('\n', terminal->stream);
    }
    cz_matrix_write_text(evaluation, terminal);
    cz_checks_write_table(evaluation, NULL, terminal);
}
