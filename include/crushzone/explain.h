/* Explanation of checks: when and where the deciding value arose, what carried the force, and which
 * changes would help. Of an override, or the margin against one, also its causes in order. */
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
    char what[CZ_WHERE_SIZE + 96]; /* a sentence without its time */
    double time;                   /* [s]; NaN for one of the whole run */
} CzIndicator;

/* Most indicators of one run. */
enum { CZ_MAX_INDICATORS = 24 };

enum { CZ_MAX_CARRIERS = 8, CZ_MAX_STATES = 12, CZ_MAX_EXPLAINED = 16 };

/* What the amounts of carriers are. */
typedef enum CzCarried {
    CZ_CARRIED_NOTHING, /* a check of the design alone */
    CZ_CARRIED_FORCE,   /* force at the time, or mean force over the window [N] */
    CZ_CARRIED_ENERGY,  /* dissipated energy of the run [J] */
    CZ_CARRIED_MOMENT   /* size of the impulses that pitched a vehicle until its largest lift, of a
                           check of wheel lift [N m s] */
} CzCarried;

/* A load path, or an element, with its part of the whole. */
typedef struct CzCarrier {
    char what[CZ_INTERFACE_SIZE + CZ_WHERE_SIZE]; /* such as "couplers of A4-B1" */
    double amount;
    double share; /* of the sum over all carriers */
} CzCarrier;

/* State of an element at the time of a check. */
typedef struct CzElementState {
    char interface[CZ_INTERFACE_SIZE];
    char element[CZ_WHERE_SIZE];
    const char *state;  /* "bottomed out", "sheared off", "tube exhausted", "stroke left" or "not
                           used"; static */
    double time;        /* of the event [s]; NaN without */
    double stroke_used; /* largest over the whole run [-] */
} CzElementState;

/* A change of one number that was run in all scenarios, and its effect. */
typedef struct CzTriedChange {
    char name[CZ_PATH_SIZE]; /* of the variable of the file, or the path where it is written */
    char unit[16];
    double value, tried;
    double change; /* relative; of a value of 0 over that of CzVaryingNumber */
    double margin; /* of the check, the smallest over its scenarios; 1 for a satisfied yes or no,
                      -0.01 for a violated one */
    bool passes;   /* the check passes in all of them */
    int n_broken;  /* other checks that fail now and did not before */
    char other[CZ_LABEL_SIZE], other_scenario[CZ_NAME_SIZE]; /* the other check with the smallest
                                                                margin now; empty for none */
    double other_margin, other_before;                       /* its margin now and before */
} CzTriedChange;

/* One check, explained at its worst scenario. */
typedef struct CzExplainedCheck {
    CzCheckResult check;
    double time[2]; /* begin and end of the deciding time [s]; NaN when unknown */
    char interface[CZ_INTERFACE_SIZE]; /* the place, or the one behind it; empty for none */
    CzCarried carried;
    int n_carrier;
    CzCarrier carrier[CZ_MAX_CARRIERS]; /* the largest first */
    int n_state;
    CzElementState state[CZ_MAX_STATES];
    double margin; /* of all its scenarios in the runs of the changes, without a change */
    int n_change;
    CzTriedChange *change; /* those that raise its margin: first those with which it passes and no
                              other check breaks, by their size, then by margin (n_change) */
} CzExplainedCheck;

/* Open result, owns its memory; texts are borrowed from the evaluator. */
typedef struct CzExplanation {
    int n_check;
    CzExplainedCheck *check; /* failing checks, each once, or those asked for; the one with the
                                smallest margin when none fails (n_check) */
    int n_tried;             /* numbers whose changes were run */
    bool has_climbing;       /* the following members are filled; else no vehicle could climb, or
                                no check of climbing was asked for, and `run` is NULL */
    const char *scenario;    /* the one with the smallest margin against override */
    bool climbed;            /* an override occurred in it */
    double climb_time;       /* [s]; NaN when not */
    CzVerdict verdict;   /* FAIL when a margin against override is violated, NOT CHECKED when one is
                            unknown */
    CzCheckResult worst; /* the check with the smallest margin against override */
    int vehicle; /* vehicle of the budget: that of the worst check, or the one behind its interface
                  */
    int n_indicator;
    CzIndicator indicator[CZ_MAX_INDICATORS]; /* in order of time */
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
    int n_check;
    const char *const *check; /* names of the checks to explain; 0: those that fail (n_check) */
    bool search; /* search for the changes that would reverse the verdict; else indicators only
                  */
    const volatile sig_atomic_t *stop; /* a flag that ends the search when not 0; NULL when none */
    void (*progress)(int n_done, int n_all, void *data); /* NULL when none */
    void *progress_data;
} CzExplainOptions;
CZ_API CzExplainOptions cz_explain_options_default(void);

/* Runs the evaluator's scenarios as written and explains its checks. Then each number that a search
 * may change is changed by itself and run in all scenarios: the variables of the problem, or
 * without them every such number of the trains behind.
 *
 * The scenario with the smallest margin against override is explained too: wheel lift, overlap and
 * vertical capacity of the anti-climbers, by the problem's own limits, else by 75 % of the flange
 * height, one rib pitch, and the whole capacity. There each value of a list is varied by itself,
 * upwards and downwards, in batches. Statuses: CZ_OK, CZ_STATUS_RUN_FAILED when a run failed or is
 * incomplete, CZ_STATUS_INPUT for a name that is no check, or when there is no check and no vehicle
 * can climb, CZ_STATUS_INTERRUPTED, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_explain(CzEvaluator *evaluator, const CzExplainOptions *options,
                                         CzExplanation **explanation, CzError *error);
CZ_API void cz_explanation_free(CzExplanation *explanation);

CZ_END_DECLARATIONS
#endif
