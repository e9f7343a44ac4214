/* Results by the list: what each is, how it is read from its record, and in which unit it is
 * written.
 *
 * The lists are results.def (what a run answers) and documents.def (what the documents add). Every
 * medium walks them; none names a key of its own.
 */
#ifndef CZ_REPORT_RESULTS_H
#define CZ_REPORT_RESULTS_H

#include "crushzone/report.h"
#include "evaluate/results.h"
#include "report/figure.h"

typedef enum CzRecord {
#define CZ_RECORD(record, type, doc) CZ_RECORD_##record,
#include "evaluate/result_records.def"
#include "report/document_records.def"
#undef CZ_RECORD
    CZ_N_RECORD
} CzRecord;

/* Records that are made for who asks. */
typedef struct CzRunInfo {
    double wall_s, setup_s; /* [s] */
    int n_job;              /* 0 when unknown */
} CzRunInfo;
typedef struct CzImpulse {
    CzBudgetSource source;
    double moment, lift; /* [N m s], [N s] */
} CzImpulse;

typedef struct CzVariableRow {
    const char *name, *unit;
    double min, max, start, value;
    bool at_bound, is_fixed;
    const char *start_choice, *choice; /* NULL for a number */
} CzVariableRow;
typedef struct CzConstraintRow {
    const char *name, *scenario, *where, *kind, *unit;
    double limit, start, value, margin;
    bool beyond_validity, is_checked, is_violated;
} CzConstraintRow;
typedef struct CzSensitivityRow {
    int variable;
    const char *name;
    double increment, objective_change;
} CzSensitivityRow;
typedef struct CzOptimumVerification {
    double half_step, reference, full_track;
    const char *verdict, *failure;
} CzOptimumVerification;
typedef struct CzMethodRow {
    bool is_done;
    double largest_change;
    const char *of, *where, *scenario;
    int n_flip;
} CzMethodRow;
typedef struct CzChangeRow {
    double value, change;
    bool flips;
} CzChangeRow;
typedef struct CzSweptMetric {
    const char *name, *unit;
} CzSweptMetric;
typedef struct CzPointMetric {
    double value;
    const char *where;
} CzPointMetric;
typedef struct CzCheckInRun {
    const CzCheckResult *check; /* NULL where the run does not have it */
    double value, margin;
    const char *where, *verdict;
    bool beyond_validity;
} CzCheckInRun;

typedef struct CzNamedNumber {
    const char *name;
    double value; /* in its unit */
} CzNamedNumber;

/* What documents are made of, and what is at hand while one is written. Only what a document needs
 * is set. */
typedef struct CzResultContext {
    const char *format; /* name of the document */
    const CzProblem *problem;
    const CzReportOptions *options;
    const CzEvaluation *evaluation;
    double wall_s;           /* computing, of the whole document [s] */
    const CzRunSummary *run; /* at hand */
    const CzEvaluator *evaluator;
    const CzOutcome *outcome;
    const CzSweep *sweep;
    const CzVerification *verification;
    const CzExplanation *explanation;
    int n_compared;
    const CzReportRun *compared;
    const CzFit *fit;
    const char *yaml; /* of the fit */
    int n_mistake;
    const CzError *const *mistake;
    const struct CzResult *at; /* the one whose numbers are requested */
    int n_order;               /* sources of a budget that are written, and in which order; */
    const int *order;          /* NULL: all of them, in their own */
    CzRunInfo info;            /* made, until the next is requested; so are the others */
    CzImpulse impulse;
    CzVariableRow variable;
    CzConstraintRow constraint;
    CzSensitivityRow sensitivity;
    CzOptimumVerification optimum;
    CzMethodRow method;
    CzChangeRow change;
    CzSweptMetric swept;
    CzPointMetric point;
    CzCheckInRun check;
    CzError warning;
    char text[64];
} CzResultContext;

/* How a result is read and written; results.def describes them. */
typedef enum CzResultForm {
    CZ_FORM_REAL,
    CZ_FORM_REAL_BY,
    CZ_FORM_REAL_IF_BY, /* left out where it is NaN */
    CZ_FORM_EXACT,
    CZ_FORM_EXACT_BY,
    CZ_FORM_TOTAL,
    CZ_FORM_FLAG,
    CZ_FORM_FLAG_BY,
    CZ_FORM_FLAG_IF_BY, /* left out below 0 */
    CZ_FORM_WHOLE,
    CZ_FORM_WHOLE_BY, /* null below 0 */
    CZ_FORM_TEXT,
    CZ_FORM_TEXT_OR_NULL,
    CZ_FORM_TEXT_BY,
    CZ_FORM_TEXT_IF, /* left out where it is NULL */
    CZ_FORM_TEXT_IF_BY,
    CZ_FORM_VERDICT,
    CZ_FORM_PROVISIONAL,
    CZ_FORM_SHOWN_BY,
    CZ_FORM_METRIC,
    CZ_FORM_METRIC_TOTAL,
    CZ_FORM_PART,
    CZ_FORM_PART_IF, /* left out where it is NULL */
    CZ_FORM_LIST,
    CZ_FORM_LIST_IF, /* left out where it is not there */
    CZ_FORM_MAP,     /* records by name; left out when there are none */
    CZ_FORM_SPREAD,  /* the same, in the record itself */
    CZ_FORM_TEXTS,
    CZ_FORM_REALS,
    CZ_FORM_EXACTS,
    CZ_FORM_NAMED_REALS,
    CZ_FORM_NAMED_EXACTS
} CzResultForm;

/* How a number is printed in tables. */
typedef enum CzResultFormat { CZ_FORMAT_PLAIN, CZ_FORMAT_ROUND, CZ_FORMAT_PERCENT } CzResultFormat;

/* What a member of a record holds. */
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
    struct { /* the member that it is stored in */
        CzStored stored;
        size_t offset;
        int n; /* values of an array; 0: no array */
    } member;
    union { /* the function that gives it, by the form */
        double (*real)(CzResultContext *context, const void *record);
        bool (*flag)(CzResultContext *context, const void *record);
        long (*whole)(CzResultContext *context, const void *record);
        const char *(*text)(CzResultContext *context, const void *record);
        const void *(*part)(CzResultContext *context, const void *record);
        const void *(*item)(CzResultContext *context, const void *record, int index);
        const void *(*entry)(CzResultContext *context, const void *record, int index,
                             const char **name);
        const char *(*nth_text)(CzResultContext *context, const void *record, int index);
        bool (*nth_number)(CzResultContext *context, const void *record, int index,
                           CzNamedNumber *number); /* false beyond the last */
    } by;
    bool (*is_there)(CzResultContext *context, const void *record); /* of a LIST_IF */
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
#define CZ_METRIC(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_METRIC_BY(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_PART(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_PART_IF(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_LIST(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_ITEMS(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_WORD(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_TEXTS(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_LIST_IF(record, key, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_MAP(record, key, form, ...) CZ_RESULT_##record##_##key,
#define CZ_RESULT_NUMBERS(record, key, ...) CZ_RESULT_##record##_##key,
#include "report/documents.def"
    CZ_N_RESULT
};
extern const CzResult cz_results[CZ_N_RESULT];
extern const char *const cz_record_names[CZ_N_RECORD], *const cz_record_docs[CZ_N_RECORD];

/* A result by its record and key, as in CZ_RESULT_AT(INTERFACE, peak_force_kN). */
#define CZ_RESULT_AT(record, key) (&cz_results[CZ_RESULT_##record##_##key])

/* A number of a record in its unit; NaN where it is not known or blank. Yes and no are 1 and 0. */
double cz_result_number(const CzResult *result, CzResultContext *context, const void *record);

/* The same as a table prints it, by its format. */
const char *cz_result_text(char text[CZ_FIGURE_ROOM], const CzResult *result,
                           CzResultContext *context, const void *record);

/* A yes or no, and a text (NULL for none). A verdict is given in full, provisional passes as such.
 */
bool cz_result_flag(const CzResult *result, CzResultContext *context, const void *record);
const char *cz_result_words(const CzResult *result, CzResultContext *context, const void *record);
/* The word of a document, whose verdicts are closed: a provisional pass is a pass. */
const char *cz_closed_verdict(CzVerdict verdict);
/* Whether a number was typed or measures an error, so that it keeps its size; figure.h. */
bool cz_result_is_exact(const CzResult *result);

/* Writes a record as a JSON document. Statuses: CZ_STATUS_OUTPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_results_write(CzRecord record, CzResultContext *context, const void *data,
                                        FILE *stream, CzError *error);

#endif
