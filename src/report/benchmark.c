/* A benchmark on a terminal: the times of each scenario. */
#include "crushzone/report.h"

#include "report/figure.h"
#include "report/tables.h"
#include "report/units.h"

static void put_time(CzReportTable *table, double time) {
    char text[CZ_FIGURE_SIZE];
    cz_table_put(table, cz_figure_plain(text, time * CZ_MILLI_PER_UNIT));
}

/* Only the first row of a scenario shows its name and size. */
static void put_scenario(CzReportTable *table, const CzScenarioTimes *times) {
    cz_table_put(table, times->scenario);
    cz_table_put_format(table, "%d", times->n_vehicle);
    cz_table_put_format(table, "%ld", times->n_step);
    for (int timed = 0; timed < CZ_N_TIMED; timed++) {
        const CzTiming *timing = &times->time[timed];
        for (int column = 0; timed > 0 && column < 3; column++)
            cz_table_put(table, NULL);
        cz_table_put(table, cz_timed_text((CzTimed)timed));
        put_time(table, timing->least);
        put_time(table, timing->median);
        cz_table_put_format(table, "%d", timing->n);
    }
}

void cz_benchmark_write_table(const CzReport *report, CzTerminal *terminal) {
    const CzBenchmark *benchmark = report->benchmark;
    CzReportTable table;
    cz_terminal_print(terminal, CZ_STYLE_PLAIN, "%s\n\n", cz_problem_title(report->problem));
    cz_table_begin(&table, "scenario;>vehicles;>steps;processor time;>min ms;>median ms;>n");
    for (int i = 0; i < benchmark->n_scenario; i++)
        put_scenario(&table, &benchmark->scenario[i]);
    cz_table_write_text(&table, terminal);
    if (benchmark->failure[0] != '\0')
        cz_terminal_print(terminal, CZ_STYLE_BAD, "%s\n", benchmark->failure);
}
