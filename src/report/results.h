/* The list of results: key, form, source in its record, and unit of each.
 *
 * It is made of results.def (results of a run) and documents.def (further results of documents).
 * JSON, CSV, tables and pages are written from it; no other file names a key.
 */
#ifndef CZ_REPORT_RESULTS_H
#define CZ_REPORT_RESULTS_H

#include "crushzone/report.h"
#include "evaluate/results.h"
#include "report/figure.h"
#include "report/table.h"

typedef enum CzRecord {
#define CZ_RECORD(record, type, doc) CZ_RECORD_##record,
#include "evaluate/result_records.def"
#include "report/document_records.def"
#undef CZ_RECORD
    CZ_N_RECORD
} CzRecord;

typedef struct CzRecordInfo {
    const char *name, *doc;
} CzRecordInfo;
extern const CzRecordInfo cz_result_records[CZ_N_RECORD];

typedef struct CzRunInfo {
    double wall_s, setup_s; /* [s] */
    int n_job;              /* 0 when unknown */
} CzRunInfo;

/* Sources of a document or a table, and the state while it is written. Only the sources that it
 * needs are set. */
typedef struct CzResultContext {
    const CzReport *report;
    const CzProblem *problem;
    const CzReportOptions *options;
    const CzEvaluation *evaluation;
    double wall_s;           /* computing, of the whole document [s] */
    const CzRunSummary *run; /* that is being written */
    const char *yaml;        /* of the fit */
    int n_order;             /* sources of a budget that are written, and in which order; */
    const int *order;        /* NULL: all of them, in their own */
    int index;               /* of the item of a list that is being written */
    CzRunInfo info;          /* filled for each request, as are the others */
    CzError warning;
    char format[32], text[64], words[CZ_CURVE_WORDS];
} CzResultContext;

/* Form of a result, or of each item of a list. */
typedef enum CzResultForm {
    CZ_FORM_UNWRITTEN, /* in no document */
    CZ_FORM_NUMBER,
    CZ_FORM_FLAG,
    CZ_FORM_WHOLE,
    CZ_FORM_TEXT,
    CZ_FORM_VERDICT,
    CZ_FORM_RECORD
} CzResultForm;

/* Format of a number in tables. */
typedef enum CzResultFormat { CZ_FORMAT_PLAIN, CZ_FORMAT_ROUND, CZ_FORMAT_PERCENT } CzResultFormat;

/* C type of a member of a record. */
typedef enum CzStored {
    CZ_STORED_NOTHING,
    CZ_STORED_DOUBLE,
    CZ_STORED_BOOL,
    CZ_STORED_INT,
    CZ_STORED_LONG,
    CZ_STORED_LETTERS, /* an array of char */
    CZ_STORED_TEXT,    /* a pointer to text */
    CZ_STORED_ENUM
} CzStored;

typedef enum CzDimension { CZ_DIMENSION_PLANE } CzDimension;

typedef struct CzResult {
    CzRecord record;
    const char *key;
    CzResultForm form;
    bool is_exact;        /* typed, or an error measure: never rounded to 0 (figure.h) */
    bool is_total;        /* blank where a part of the run is beyond model validity */
    bool is_null_below_0; /* of WHOLE */
    bool is_spread;       /* its records are members of the record itself, by name */
    struct {              /* the member that it is stored in */
        CzStored stored;
        size_t offset;
        int n; /* values of an array; 0: no array */
    } member;
    union { /* function that returns the value or an item, where it is not stored in a member */
        double (*real)(CzResultContext *context, const void *record);
        bool (*flag)(CzResultContext *context, const void *record);
        long (*whole)(CzResultContext *context, const void *record);
        const char *(*text)(CzResultContext *context, const void *record);
        const void *(*part)(CzResultContext *context, const void *record);
    } by;
    long (*number)(CzResultContext *context, const void *record);      /* items; NULL: no list */
    const char *(*name)(CzResultContext *context, const void *record); /* of an item; NULL: none */
    bool (*is_there)(CzResultContext *context, const void *record);    /* NULL: always */
    CzRecord of; /* of a part or of the items of a list */
    const CzResultUnit *unit;
    CzDimension dimension;
    const char *title, *heading; /* in comparisons and in tables; NULL when in none */
    CzResultFormat format;
    const char *doc;
} CzResult;

/* Every result by a name for the compiler: CZ_RESULT_INTERFACE_peak_force_kN. */
enum {
#define CZ_RESULT(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_QUANTITY CZ_RESULT
#define CZ_METRIC CZ_RESULT
#define CZ_METRIC_BY CZ_RESULT
#include "report/documents.def"
    CZ_N_RESULT
};
extern const CzResult cz_results[CZ_N_RESULT];

/* A result by its record and key, as in CZ_RESULT_AT(INTERFACE, peak_force_kN). */
#define CZ_RESULT_AT(record, key) (&cz_results[CZ_RESULT_##record##_##key])

/* A number of a record in its unit; NaN where it is not known or blank. Yes and no are 1 and 0. */
double cz_result_number(const CzResult *result, CzResultContext *context, const void *record);

/* The same as text for tables, in its format. */
const char *cz_result_text(char text[CZ_FIGURE_SIZE], const CzResult *result,
                           CzResultContext *context, const void *record);

/* Columns of a table with the headings of n results, and the cells of a record in them, marked when
 * they may be of the time beyond model validity. */
void cz_table_head_results(CzReportTable *table, int n, const CzResult *const *result);
void cz_table_put_results(CzReportTable *table, int n, const CzResult *const *result,
                          CzResultContext *context, const void *record, bool is_marked);

/* A yes or no, and a text (NULL for none). A verdict is given in full, provisional passes as such.
 */
bool cz_result_flag(const CzResult *result, CzResultContext *context, const void *record);
const char *cz_result_words(const CzResult *result, CzResultContext *context, const void *record);
/* The word of a document, whose verdicts are closed: a provisional pass is a pass. */
const char *cz_closed_verdict(CzVerdict verdict);

/* The record of the document of each kind. */
extern const CzRecord cz_document_records[CZ_N_REPORT];

/* Writes a record as a JSON document. Status: CZ_STATUS_OUTPUT. */
CZ_MUST_CHECK CzStatus cz_results_write(CzRecord record, CzResultContext *context, const void *data,
                                        FILE *stream, CzError *error);

/* The same on one line, without its end. */
void cz_results_write_line(CzRecord record, CzResultContext *context, const void *data,
                           FILE *stream);

/* Visits every number of a record and of the records in it, with its path, such as
 * interfaces.A4-B1.peak_force_kN; not computing times, nor events, which have no names. */
typedef void CzNumberVisitor(const char *path, const CzResult *result, double value, void *data);
void cz_results_visit(CzRecord record, CzResultContext *context, const void *data,
                      CzNumberVisitor *visit, void *visitor);

#endif
