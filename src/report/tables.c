/* Tables for a terminal: the function for each kind of results. */
#include "report/tables.h"

#include "base/error.h"
#include "report/options.h"

CzStatus cz_report_write_table(const CzReport *report, bool colour, FILE *stream, CzError *error) {
    static void (*const writers[CZ_N_REPORT])(const CzReport *, CzTerminal *) = {
        [CZ_REPORT_RUN] = cz_run_write_table,
        [CZ_REPORT_SEARCH] = cz_outcome_write_table,
        [CZ_REPORT_SWEEP] = cz_sweep_write_table,
        [CZ_REPORT_SAMPLE] = cz_sample_write_table,
        [CZ_REPORT_CORRIDOR] = cz_corridor_write_table,
        [CZ_REPORT_PARETO] = cz_pareto_write_table,
        [CZ_REPORT_CHALLENGE] = cz_challenge_write_table,
        [CZ_REPORT_VERIFICATION] = cz_verification_write_table,
        [CZ_REPORT_BENCHMARK] = cz_benchmark_write_table,
        [CZ_REPORT_EXPLANATION] = cz_explanation_write_table,
        [CZ_REPORT_COMPARISON] = cz_comparison_write_table};
    CzTerminal terminal = {
        .stream = stream, .colour = colour, .width = cz_report_options_of(report)->text_width};
    writers[report->kind](report, &terminal);
    return terminal.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the whole table")
                           : CZ_OK;
}
