/* The report of a run as one page: its contents and sections.
 *
 * A page depends on the results only: it has no time, host or thread, so that equal runs give equal
 * bytes.
 */
#ifndef CZ_REPORT_PAGE_H
#define CZ_REPORT_PAGE_H

#include "crushzone/report.h"
#include "base/memory_text.h"
#include "crushzone/names.h"
#include "model/model.h"
#include "model/layout.h"
#include "report/drawn.h"
#include "report/inputs_text.h"
#include "report/markup.h"

/* Another run that figures compare with the page's own. */
typedef struct CzPageOther {
    const char *label; /* such as "before" */
    const CzRun *run;
} CzPageOther;

/* Quasi-static curve of an interface by the input, up to the largest closure of the run. */
typedef struct CzInputCurve {
    int n;          /* 0 where the interface was not closed in the run */
    double *points; /* closures [mm], then forces [kN], NaN far above those of the run (2 n) */
} CzInputCurve;

/* A page. Its contents are collected before it is written; writing changes only the text, and fails
 * only without memory. */
typedef struct CzPage {
    /* Set by the caller, all borrowed. */
    const CzProblem
        *problem; /* that the run was computed from, an optimum's with its best values */
    const CzEvaluation *evaluation; /* with kept runs */
    const CzReportOptions *options;
    int scenario;      /* the one that the figures show */
    const char *label; /* of the page's own run where there are others; NULL otherwise */
    int n_other;
    const CzPageOther *other; /* (n_other) */
    bool is_top;    /* in a folder that has the reports of the scenarios in folders below */
    bool is_beside; /* its figures are on the page of another run, without the cursor */
    int n_measured;
    const struct CzChartCurve *measured; /* curves laid over figures (n_measured) */

    /* Collected by cz_page_begin. */
    const CzRun *run;
    const CzRunSummary *summary;
    CzModel *model;
    CzLayout *layout;   /* (n_vehicle) */
    const double *time; /* [ms] (n_sample) */
    int n_sample;
    CzMadeCurves made;
    CzInputCurve *input;       /* by interface (n_interface) */
    double flange_height;      /* lowest of the full vehicles [m]; infinite without one */
    const CzVehicle *vehicles; /* the problem's array; model->car[].vehicle is an index into it */

    /* Collected by cz_page_collect_deciding, freed by cz_page_free_deciding. */
    struct CzMatrix *matrix;     /* criteria and scenarios */
    struct CzDeciding *deciding; /* figures that decide; NULL for none */

    /* Collected by cz_page_collect_parts. */
    CzInputsText inputs;
    struct CzChartCurve *fitted; /* measured time histories of a fit; `measured` points to them */

    /* Drawn so far. */
    CzMarkup
        markup; /* writes into memory, because the size of the page decides how many rows it has */
    CzMemoryText text; /* what was written, known once the markup's stream was flushed */
} CzPage;

/* Collects the contents of figures. Statuses: CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY; free the page
 * in any case. */
CZ_MUST_CHECK CzStatus cz_page_begin(CzPage *page, CzError *error);
/* Collects the other contents of the page of a run: the text of the problem, the measured histories
 * of a fit. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_collect_parts(CzPage *page, CzError *error);
void cz_page_free(CzPage *page);

/* Collects the matrix and, at the top of several scenarios, the figures that decide its rows
 * (page_deciding.c). Statuses: CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY; free them in any case, before
 * the page. */
CZ_MUST_CHECK CzStatus cz_page_collect_deciding(CzPage *page, CzError *error);
void cz_page_free_deciding(CzPage *page);

/* Values of a curve of the page (n_sample); NULL when there are none. */
static inline const double *cz_page_values(const CzPage *page, CzDrawn drawn, int place) {
    return cz_drawn_values(page->run, &page->made, drawn, place);
}

/* Writes the report of a run: the matrix and the checks of all scenarios and the figures of one.
 * With is_top it links the reports of the other scenarios in their folders. Statuses:
 * CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_run(const CzReport *report, int scenario, bool is_top,
                                         FILE *stream, CzError *error);

/* Writes the report of a search: variables, checks before and after, then the run of the best
 * design compared with that of the start. The problem is the one read with the best values.
 * Statuses: CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_write_outcome(const CzReport *report, FILE *stream, CzError *error);

/* Writes a comparison: differing results, and curves over each other. Statuses: as above. */
CZ_MUST_CHECK CzStatus cz_page_write_comparison(const CzReport *report, FILE *stream,
                                                CzError *error);

/* The sections about one run, from the trains to the inputs, and the data for the script. */
void cz_page_write_parts(CzPage *page);

/* Copies the whole page to a stream. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_page_finish(CzPage *page, FILE *stream, CzError *error);

/* The first and last lines of a page. */
void cz_page_write_head(CzMarkup *markup, const char *title);
void cz_page_write_foot(CzMarkup *markup);
/* What a report is filed under: project, author, date, program, profile. */
void cz_page_write_document(CzMarkup *markup, const CzProblem *problem);
/* Links to the sections of the page of a run; for a search also to its own sections. */
void cz_page_write_contents(CzPage *page, bool of_search);

/* ---- parts, in the order of the page ---- */

/* page_matrix.c: criteria by scenarios, and the figures that decide them, where there are several
 * scenarios. */
bool cz_page_has_matrix(const CzPage *page);
void cz_page_write_matrix(CzPage *page);
void cz_page_write_deciding(CzPage *page);

/* page_checks.c, page_trains.c, page_figures.c, page_scene.c, page_inputs.c, page_data.c */
void cz_page_write_verdict(CzPage *page);
void cz_page_write_trains(CzPage *page);
void cz_page_write_figures(CzPage *page);
void cz_page_write_budget(CzPage *page); /* page_budget.c; nothing where no car has running gear */
void cz_page_write_animation(CzPage *page);
void cz_page_write_events(CzPage *page);
void cz_page_write_inputs(CzPage *page);
void cz_page_write_data(CzPage *page);

/* The words for an event, such as "anti-climber contact". */
void cz_page_event_words(CzEventKind kind, char words[48]);

/* The table of checks, with the values of a design before unless that is NULL. */
void cz_page_write_checks(CzMarkup *markup, const CzEvaluation *evaluation,
                          const CzEvaluation *before);
/* Address of the report of a scenario, from this page. */
enum { CZ_ADDRESS_SIZE = 512 };
void cz_page_address(const CzPage *page, const char *scenario, char address[CZ_ADDRESS_SIZE]);
/* A scenario's name as the name of a folder. */
void cz_page_folder_name(const char *scenario, char name[CZ_NAME_SIZE]);

/* ---- parts of the report of a search ---- */

/* The most critical constraint that is not among the first n; -1 when there is none. */
int cz_page_next_constraint(const CzEvaluation *evaluation, int n_listed, const int *listed);

/* All designs of the search as lines over the variables (page_designs.c); nothing for fewer than
 * two variables. */
CZ_MUST_CHECK CzStatus cz_page_write_designs(CzMarkup *markup, const CzReport *report,
                                             CzError *error);
/* Change of objective and critical margins per increment of each variable (page_designs.c). */
void cz_page_write_sensitivities(CzMarkup *markup, const CzReport *report);

#endif
