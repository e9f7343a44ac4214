/* Cause of an override, or the margin against one: causes in order, and changes that would prevent
 * or lead to it. */
#ifndef CRUSHZONE_EXPLAIN_H
#define CRUSHZONE_EXPLAIN_H

#include <signal.h>

#include "crushzone/evaluate.h"

CZ_BEGIN_DECLARATIONS

typedef enum CzCause {
#define CZ_CAUSE(constant, text, doc) constant,
#include "crushzone/causes.def"
#undef CZ_CAUSE
    CZ_N_CAUSE
} CzCause;
CZ_API const char *cz_cause_text(CzCause cause);
CZ_API const char *cz_cause_doc(CzCause cause);

/* One value, changed equally in all vehicles while all others are constant, and the smallest change
 * found that reverses the verdict on override: it restores a violated margin, or violates a
 * satisfied one. */
typedef struct CzCandidateChange {
    const char *name; /* such as "height of the anti-climber faces"; static */
    const char *key;  /* key in a file, such as "face_height_mm"; static */
    CzCause cause;
    double value;   /* the file's, of the first vehicle that has it, in the key's unit */
    bool turns;     /* a change that reverses the verdict was found */
    double needed;  /* value that reverses the verdict, or the nearest one of those tried, in that
                       unit; NaN when none of them changes the margin in that direction */
    double change;  /* relative change to there, signed; of a value near 0, over its reference */
    double not_yet; /* largest tried change that does not reverse it; NaN without */
    double margin;  /* smallest margin against override at that value */
} CzCandidateChange;

/* An indicator of a cause at an interface or element. */
typedef struct CzIndicator {
    CzCause cause;
    char what[CZ_WHERE_ROOM + 96]; /* a sentence without its time */
    double time;                   /* [s]; NaN for one of the whole run */
} CzIndicator;

/* Most indicators of one run. */
enum { CZ_MOST_INDICATORS = 24 };

/* Open result, owns its memory; texts are borrowed from the evaluator. */
typedef struct CzExplanation {
    const char *scenario; /* the one with the smallest margin against override */
    bool climbed;         /* an override occurred in it */
    double climb_time;    /* [s]; NaN when not */
    CzVerdict verdict;   /* FAIL when a margin against override is violated, NOT CHECKED when one is
                            unknown */
    CzCheckResult worst; /* the check with the smallest margin against override */
    int vehicle; /* vehicle of the budget: that of the worst check, or the one behind its interface
                  */
    int n_indicator;
    CzIndicator indicator[CZ_MOST_INDICATORS]; /* in order of time */
    int n_candidate;
    CzCandidateChange *candidate; /* those that reverse the verdict by the size of the change, then
                                     the others by the margin that they reach (n_candidate) */
    bool has_cause;               /* some change reverses the verdict */
    CzCause cause; /* of the smallest reversing change among the causes with an indicator in the run
                      (stops excepted, because every lift ends at a stop), else among all causes */
    CzRun *run;    /* of the scenario, with its events */
    long n_run;    /* collisions run for the search */
    double wall_s;
} CzExplanation;

typedef struct CzExplainOptions {
    bool search; /* search for the changes that would reverse the verdict; else indicators only
                  */
    const volatile sig_atomic_t *stop; /* a flag that ends the search when not 0; NULL when none */
    void (*progress)(int n_done, int n_all, void *data); /* NULL when none */
    void *progress_data;
} CzExplainOptions;
CZ_API CzExplainOptions cz_explain_options_default(void);

/* Runs the evaluator's scenarios as written and explains the one with the smallest margin against
 * override: wheel lift, overlap and vertical capacity of the anti-climbers, by the problem's own
 * limits, else by 75 % of the flange height, one rib pitch, and the whole capacity. Then each value
 * of a list is varied by itself, upwards and downwards, in batches. Statuses: CZ_OK,
 * CZ_STATUS_RUN_FAILED when a run failed or is incomplete, CZ_STATUS_INPUT when no vehicle can
 * climb, CZ_STATUS_INTERRUPTED, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_explain(CzEvaluator *evaluator, const CzExplainOptions *options,
                                         CzExplanation **explanation, CzError *error);
CZ_API void cz_explanation_free(CzExplanation *explanation);

CZ_END_DECLARATIONS
#endif
