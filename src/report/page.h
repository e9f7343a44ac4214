/* The report of a run as one page: what its parts share.
 *
 * A page is a pure function of finished results: no time, host or thread stands in it, so the same
 * run gives the same bytes.
 */
#ifndef CZ_REPORT_PAGE_H
#define CZ_REPORT_PAGE_H

#include "crushzone/report.h"
#include "base/memory_text.h"
#include "crushzone/names.h"
#include "model/model.h"
#include "model/stand.h"
#include "report/drawn.h"
#include "report/markup.h"

/* A further run that figures set beside the page's own. */
typedef struct CzPageOther {
    const char *label; /* such as "before" */
    const CzRun *run;
} CzPageOther;

typedef struct CzPage {
    CzMarkup markup;   /* writes into memory, for a page must know how long it is */
    FILE *stream;      /* where the page goes when it is whole; borrowed */
    CzMemoryText text; /* what was written, known once the markup's stream was flushed */
    const CzProblem *problem;
    const CzEvaluation *evaluation;
    const CzReportOptions *options;
    int scenario; /* the one that the figures show */
    const CzRun *run;
    const CzRunSummary *summary;
    CzModel *model;
    CzStand *stand;     /* (n_vehicle) */
    const double *time; /* [ms] (n_sample) */
    int n_sample;
    CzMadeCurves made;
    const char *label; /* of the page's own run where there are others; NULL otherwise */
    int n_measured;
    const struct CzChartCurve *measured; /* curves laid over figures (n_measured) */
    int n_other;
    const CzPageOther *other;  /* (n_other) */
    const CzVehicle *vehicles; /* the problem's array; model->car[].vehicle is an index into it */
} CzPage;

/* Makes a page about one scenario of an evaluation with kept runs. `problem` is the one that the
 * run was computed from, an optimum's with its best values. Statuses: CZ_STATUS_INPUT,
 * CZ_STATUS_NO_MEMORY; free it in any case. */
CZ_MUST_CHECK CzStatus cz_page_begin(CzPage *page, const CzProblem *problem,
                                     const CzEvaluation *evaluation, int scenario,
                                     const CzReportOptions *options, FILE *stream, CzError *error);
void cz_page_free(CzPage *page);

/* The scenario that decides: of a check that fails, else the smallest margin, else the first that
 * ran; -1 when none did. */
int cz_page_deciding(const CzEvaluation *evaluation);

/* Values of what the page draws (n_sample); NULL when there are none. */
const double *cz_page_values(const CzPage *page, CzDrawn drawn, int place);

/* Writes the whole report of a run: the checks of all scenarios and the figures of one. At the top
 * of a result folder it names the reports of the other scenarios, which stand in their folders.
 * Statuses: CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_run(const CzProblem *problem, const CzEvaluation *evaluation,
                                         int scenario, bool is_top, const CzReportOptions *options,
                                         FILE *stream, CzError *error);

/* Writes the report of a search: what it changed and reached, then the best design's run beside the
 * start's. `best` is the problem read with the best values. Statuses: CZ_STATUS_INPUT,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_outcome(const CzProblem *best, const CzEvaluator *evaluator,
                                             const CzOutcome *outcome,
                                             const CzReportOptions *options, FILE *stream,
                                             CzError *error);

/* The parts about one run, from the trains to the inputs, and the data for the script. */
CZ_MUST_CHECK CzStatus cz_page_write_parts(CzPage *page, CzError *error);

/* Hands what was written on to the page's stream, all of it or nothing. Status:
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_finish(CzPage *page, CzError *error);

/* The first and last lines of a page. */
void cz_page_write_head(CzMarkup *markup, const char *title);
void cz_page_write_foot(CzMarkup *markup);
/* Links to the sections of a page about a run; of a search to what stands before it, too. */
void cz_page_write_contents(CzPage *page, bool of_search);
/* Opens a section with its heading; closes it. */
void cz_page_open_section(CzMarkup *markup, const char *id, const char *heading);
void cz_page_close_section(CzMarkup *markup);
/* ---- parts, in the order of the page ---- */

/* page_checks.c, page_trains.c, page_figures.c, page_scene.c, page_inputs.c, page_data.c */
void cz_page_write_verdict(CzPage *page, bool is_top);
void cz_page_write_trains(CzPage *page);
CZ_MUST_CHECK CzStatus cz_page_write_figures(CzPage *page, CzError *error);
void cz_page_write_budget(CzPage *page); /* page_budget.c; nothing where no car is full */
void cz_page_write_animation(CzPage *page);
void cz_page_write_events(CzPage *page);
CZ_MUST_CHECK CzStatus cz_page_write_inputs(CzPage *page, CzError *error);
void cz_page_write_data(CzPage *page);

/* What happened, in words such as "anti-climber contact". */
void cz_page_event_words(CzEventKind kind, char words[48]);

/* The table of checks alone, with the values of a design before when there is one. */
void cz_page_write_checks(CzMarkup *markup, const CzEvaluation *evaluation,
                          const CzEvaluation *before);
/* A scenario's name as the name of a folder. */
void cz_page_folder_name(const char *scenario, char name[CZ_NAME_ROOM]);

#endif
