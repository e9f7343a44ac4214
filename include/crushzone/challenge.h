/* Challenge: an optimiser as adversary looks for the weakest point of a design, within the envelope
 * of operation and the ranges of scatter that `uncertainty:` gives.
 *
 * A point is a value of every span of the envelope and of every draw of the scatter. At a point the
 * challenged scenarios run with these values; their checks are judged as those of samples are: the
 * bare physical limits hold, unless the file says otherwise. The adversary minimises margins. It
 * uses the runs of a search, which end early; every weak point that it reports was run in full.
 *
 * Points depend on the design, the seed and the number of runs alone, not on threads.
 */
#ifndef CRUSHZONE_CHALLENGE_H
#define CRUSHZONE_CHALLENGE_H

#include <signal.h>

#include "crushzone/sample.h"

CZ_BEGIN_DECLARATIONS

/* A check of a challenged scenario over all points. Texts are borrowed from the challenge. */
typedef struct CzChallengedCheck {
    const char *name, *scenario;
    bool is_flag;   /* a yes or no, without margins */
    double nominal; /* margin of the design without changes, judged as at points; NaN for none */
    double least;   /* smallest margin of all points; NaN for none */
    int worst;      /* point with it, or the first that fails without one; -1: none */
    int n_fail;     /* points that fail it */
} CzChallengedCheck;

/* One point, by the runs of a search. */
typedef struct CzChallengePoint {
    CzSampleState state;
    CzVerdict verdict; /* of its checks; FAIL unless done */
    double margin;     /* smallest of its checks; NaN when it has none */
    int check;         /* check with that margin, or the failing yes or no; -1 when none */
    const char *phase; /* "spread", "corner", "global" or "local"; static */
    char *message;     /* why it is invalid or its run failed; NULL otherwise */
} CzChallengePoint;

/* A point that was run in full: a weak one, or the weakest of those that pass. */
typedef struct CzWeakPoint {
    int point;
    CzSampleState state;
    CzVerdict verdict; /* of its checks; FAIL unless done */
    bool beyond_validity;
    CzCheckResult check; /* check for which it is listed, its texts borrowed from the challenge;
                            without a name when its run failed, or only climbing fails */
    int n_fail;          /* checks that fail there */
    int scenario;        /* challenged scenario of the check, by its number in the problem */
    char *message;       /* why it is invalid or its run failed; NULL otherwise */
} CzWeakPoint;

/* Open result, owns its memory. */
typedef struct CzChallenge {
    const CzProblem *problem; /* as given */
    long seed;
    int most_points; /* limit of points, the number of runs that was asked for */
    int n_scenario;
    const int *scenario; /* challenged scenarios, by their numbers in the problem (n_scenario) */
    int n_draw, n_span;  /* the first n_span draws are the envelope */
    const CzDraw *draw;  /* what varies (n_draw) */
    int n_check;
    CzChallengedCheck *check; /* (n_check) */
    int n_point, room;
    CzChallengePoint *point; /* in order (n_point) */
    double *value;           /* in the units of the draws (n_point x n_draw) */
    double *margin;     /* NaN for none, -infinity where the run went beyond validity without one
                           (n_point x n_check) */
    CzVerdict *verdict; /* (n_point x n_check) */
    int n_weak;
    CzWeakPoint *weak;    /* weak points, worst first; else the weakest that pass (n_weak) */
    bool is_broken;       /* whether any of them fails, or its run */
    int n_fail, n_failed; /* points that fail; of these without a result */
    CzVerdict judgement;  /* FAIL when broken, else that of the weakest point, NOT_CHECKED when
                             interrupted */
    bool is_interrupted;
    double wall_s;
    struct CzChallengeParts *parts; /* memory of texts */
} CzChallenge;

typedef struct CzChallengeOptions {
    int n_run;                         /* limit of points */
    long seed;                         /* -1: that of `uncertainty:` */
    int n_job;                         /* threads; 0: one per processor */
    const CzExecutor *executor;        /* where its tasks run; NULL: in n_job threads */
    int most_weak;                     /* limit of weak points in the result */
    const volatile sig_atomic_t *stop; /* a flag that ends the search when not 0; NULL: none */
    void (*progress)(int n_done, int n_run, void *data); /* NULL when none */
    void *progress_data;
} CzChallengeOptions;
CZ_API CzChallengeOptions cz_challenge_options_default(void);

/* Challenges a design: x in the units of the variables of `optimise:`, NULL for the file's own
 * values. The problem must outlive the challenge. *challenge is created whenever CZ_OK is returned,
 * also when interrupted. Statuses: CZ_OK, CZ_STATUS_INPUT for a problem without an envelope and
 * scatter, or whose values are refused at every point, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_challenge(const CzProblem *problem, const double *x,
                                           const CzChallengeOptions *options,
                                           CzChallenge **challenge, CzError *error);
CZ_API void cz_challenge_free(CzChallenge *challenge);

/* The value of a draw of a point that was run, in the unit of the draw. */
static inline double cz_challenge_value(const CzChallenge *challenge, int point, int draw) {
    return challenge->value[(long)point * challenge->n_draw + draw];
}

CZ_END_DECLARATIONS
#endif
