/* Parts of a challenge, and its steps. */
#ifndef CZ_OPTIMISE_CHALLENGE_H
#define CZ_OPTIMISE_CHALLENGE_H

#include <stdatomic.h>

#include "crushzone/challenge.h"
#include "evaluate/cases.h"
#include "evaluate/tasks.h"

/* Memory that a challenge owns besides its arrays, and what its steps share. */
typedef struct CzChallengeParts {
    CzArena arena; /* of draws and texts */
    CzChallengeOptions options;
    CzStudy study;   /* for workers of its executor */
    const double *x; /* the design; NULL for the file's own values */
    CzCases cases;
    CzCaseChecks checks;      /* the checks of the challenge */
    double *u;                /* points scaled to 0..1 (room x n_draw) */
    int n_spread;             /* points of the even sequence that were used */
    atomic_int n_done;        /* points that were run, for the progress */
    atomic_flag is_reporting; /* a thread is in the progress function */
} CzChallengeParts;

/* ---- for the robust optimiser ---- */

/* Number of changes of a point, and the changes of a scenario that has its values, as a case has
 * them (problem/problem.h). Their paths are borrowed from the challenge. */
int cz_challenge_n_change(const CzChallenge *challenge);
void cz_challenge_changes(const CzChallenge *challenge, int point, CzCaseChange *change);

/* Name of a weak point's scenario in a file, such as "25-km-h-challenge-1", unlike those of the
 * problem. */
static inline void cz_weak_point_name(const CzChallenge *challenge, int weak,
                                      char name[CZ_NAME_SIZE]) {
    int scenario = 0;
    while (challenge->scenario[scenario] != challenge->weak[weak].scenario)
        scenario++;
    cz_case_name(&challenge->parts->cases, scenario, weak, name);
}

/* ---- before the first run (challenge.c) ---- */

/* A challenge without points; NULL without memory. */
CzChallenge *cz_challenge_create(const CzProblem *problem, const CzChallengeOptions *options);

/* Lists scenarios, draws and checks and makes room for the points, but runs nothing: the nominal
 * margins are NaN. Statuses: CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_challenge_begin(CzChallenge *challenge, const CzCaseBench *unchanged,
                                          CzError *error);

/* The bench of the design without changes, whose cases and draws are listed first. */
CZ_MUST_CHECK CzStatus cz_challenge_unchanged(CzChallenge *challenge, CzCaseBench *bench,
                                              CzError *error);

/* ---- workers (challenge_study.c) ---- */

/* How tasks become plain data: points (CzPointBatch), adversaries (an array of them) and full runs
 * (an array of them). */
CzStudy cz_challenge_study(const CzChallenge *challenge, CzExecutor executor);
CzTaskData cz_points_as_data(CzChallenge *challenge);
CzTaskData cz_adversaries_as_data(CzChallenge *challenge);
CzTaskData cz_full_runs_as_data(CzChallenge *challenge);

/* ---- points (challenge_points.c) ---- */

/* Value of a draw at u within 0..1; of a list the nearest number. */
double cz_challenge_value_at(const CzDraw *draw, double u);

/* A case as it is judged. */
typedef struct CzJudgedCase {
    CzSampleState state;
    CzVerdict verdict;
    bool beyond_validity;
    int check;     /* the worst, by its place in the list of checks; -1 for none */
    int n_fail;    /* checks that fail */
    char *message; /* why a run failed or the case is invalid; NULL otherwise */
} CzJudgedCase;

/* Judges the k-th case of a bench; result is (n_check), with verdict NOT_CHECKED where the case has
 * no such check. Status: CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_challenge_judge(const CzChallenge *challenge, const CzCaseBench *bench,
                                          const CzEvaluation *evaluation, int k,
                                          CzCheckResult *result, CzJudgedCase *judged,
                                          CzError *error);

/* Margin that stands for a yes or no of a run in the search, by the results of all checks
 * (n_check); NaN where another check serves, or there is none (challenge_flags.c). */
double cz_challenge_flag_margin(const CzChallenge *challenge, const CzCaseBench *bench, int scene,
                                const CzRunSummary *run, const CzCheckResult *result, int check);

/* Margin of a check at a point; NaN of a yes or no. */
static inline double cz_challenge_margin(const CzChallenge *challenge, int point, int check) {
    return challenge->check[check].is_flag
               ? NAN
               : challenge->margin[(long)point * challenge->n_check + check];
}

/* Whether the caller asked for an end. */
bool cz_challenge_is_stopped(const CzChallenge *challenge);

/* Runs n points from `first` on as a search does, in one thread or in several: `u` has been filled.
 * Points that an interruption left out have the state CZ_SAMPLE_NOT_RUN. Statuses: CZ_OK,
 * CZ_STATUS_INTERRUPTED, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_challenge_run(CzChallenge *challenge, int first, int n, CzError *error);
CZ_MUST_CHECK CzStatus cz_challenge_run_batch(CzChallenge *challenge, int first, int n,
                                              CzError *error);

/* Points that are run side by side. */
typedef struct CzPointBatch {
    CzChallenge *challenge;
    int first, n;
} CzPointBatch;
enum { CZ_POINTS_PER_TASK = 4 };

/* The points of a task: their first one, and *n of them. */
static inline int cz_points_of(const CzPointBatch *batch, int index, int *n) {
    const int first = index * CZ_POINTS_PER_TASK, left = batch->n - first;
    *n = left < CZ_POINTS_PER_TASK ? left : CZ_POINTS_PER_TASK;
    return batch->first + first;
}

/* Counts points that were run, for the progress. */
void cz_challenge_report(CzChallenge *challenge, int n);

/* Moves a point to an unused place, and drops one. */
void cz_challenge_move(CzChallenge *challenge, int from, int to);
void cz_challenge_drop(CzChallenge *challenge, int point);

/* ---- search (challenge_search.c) ---- */

/* One algorithm on one check, with points of its own. */
typedef struct CzAdversary {
    CzChallenge *challenge;
    int check;             /* -1: the smallest margin of all */
    const char *algorithm; /* of NLopt */
    const char *phase;     /* static */
    int start;             /* point where it begins */
    int first, n;          /* its points, and their limit */
    int n_run;             /* of these that were run */
    double first_step;     /* share of the range; 0: chosen by the algorithm */
    double *scaled;        /* scratch (n_draw) */
} CzAdversary;
CZ_MUST_CHECK CzStatus cz_adversary_run(CzAdversary *adversary, CzError *error);

/* Searches until all points are used or nothing is left to try; n_point, point, value and margin
 * are filled. Statuses: as above. */
CZ_MUST_CHECK CzStatus cz_challenge_search(CzChallenge *challenge, CzError *error);

/* ---- weak points (challenge_weak.c) ---- */

/* A full run of a point. */
typedef struct CzFullRun {
    CzChallenge *challenge;
    int point;
    CzCaseBench bench;     /* owns the texts of the result, or else */
    CzArena texts;         /* of a run in a worker */
    CzCheckResult *result; /* (n_check); NULL for a point that the reader refuses */
    CzJudgedCase judged;
} CzFullRun;
CZ_MUST_CHECK CzStatus cz_full_run(CzFullRun *run, CzError *error);
void cz_full_run_free(CzFullRun *run);

/* Selects points and runs them in full. Statuses: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_challenge_find_weak(CzChallenge *challenge, CzError *error);

#endif
