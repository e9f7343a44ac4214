/* Stand-ins for pages: one line in place of each. */
#include "evaluate/evaluator.h"
#include "report/page.h"
#include "report/page_challenge.h"
#include "report/page_pareto.h"
#include "report/iso_mme_folder.h"
#include "report/page_corridor.h"
#include "report/page_sample.h"
#include "report/page_sweep.h"

CzStatus cz_page_write_run(const CzReport *report, int scenario, bool is_top, FILE *stream,
                           CzError *error) {
    (void)report;
    (void)error;
    fprintf(stream, "report of %d%s\n", scenario, is_top ? ", top" : "");
    return CZ_OK;
}

CzStatus cz_page_write_pareto(const CzPareto *pareto, const CzProblem *problem, FILE *stream,
                              CzError *error) {
    (void)pareto;
    (void)problem;
    (void)error;
    fputs("report of a front\n", stream);
    return CZ_OK;
}

CzStatus cz_page_write_sweep(const CzSweep *sweep, FILE *stream, CzError *error) {
    (void)sweep;
    (void)error;
    fputs("report of a sweep\n", stream);
    return CZ_OK;
}

CzStatus cz_page_write_challenge(const CzReport *report, FILE *stream, CzError *error) {
    (void)report;
    (void)stream;
    (void)error;
    return CZ_OK;
}

CzStatus cz_page_write_sample(const CzReport *report, FILE *stream, CzError *error) {
    (void)report;
    (void)stream;
    (void)error;
    return CZ_OK;
}

CzStatus cz_page_write_outcome(const CzReport *report, FILE *stream, CzError *error) {
    (void)report;
    (void)error;
    fputs("report of a search\n", stream);
    return CZ_OK;
}

CzStatus cz_evaluator_read_design(const CzEvaluator *evaluator, const double *x,
                                  CzProblem **problem, CzError *error) {
    (void)evaluator;
    (void)x;
    (void)error;
    *problem = NULL;
    return CZ_STATUS_INPUT;
}

CzStatus cz_page_write_corridor(const CzReport *report, FILE *stream, CzError *error) {
    (void)report;
    (void)stream;
    (void)error;
    return CZ_OK;
}

CzStatus cz_report_write_corridor(const CzCorridor *corridor, FILE *stream, CzError *error) {
    (void)corridor;
    (void)stream;
    (void)error;
    return CZ_OK;
}

CzStatus cz_iso_mme_write_folder(CzFolder *folder, const CzReport *report, int scenario,
                                 const char *before, CzError *error) {
    (void)folder;
    (void)report;
    (void)scenario;
    (void)before;
    (void)error;
    return CZ_OK;
}
