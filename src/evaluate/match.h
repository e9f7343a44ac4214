/* Matches: measurements that a fit reproduces, and the residuals of a run.
 *
 *   residual = (value - measured) / tolerance,   of a time history the root of its mean square
 *   objective = sum of weight x residual^2
 *
 * A value that a run does not have counts as ten tolerances. For an event that does not occur, the
 * time from its measured time to the end of the run counts if it is more.
 */
#ifndef CZ_EVALUATE_MATCH_H
#define CZ_EVALUATE_MATCH_H

#include "base/arena.h"
#include "crushzone/evaluate.h"
#include "evaluate/metric.h"
#include "problem/problem.h"

typedef struct CzMatchItem {
    const CzMatch *written;
    int scenario;
    CzMetric metric;            /* kind NULL unless a metric is matched */
    CzEventKind event;          /* when `written->event` is given */
    CzColumn column;            /* when `written->channel` is */
    const CzMeasured *measured; /* time history; NULL unless one is matched */
    const char *unit;
} CzMatchItem;

typedef struct CzMatchList {
    int n_item;
    CzMatchItem *item; /* (n_item) */
    bool needs_record; /* events and channels exist only when a run is recorded */
} CzMatchList;

/* Lists the matches of a problem. Memory comes from the arena. Statuses: CZ_OK, CZ_STATUS_INPUT
 * with the place in the file, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_matches_build(const CzProblem *problem, int n_scene, const CzScene *scene,
                                        CzArena *arena, CzMatchList *list, CzError *error);

/* Number of residuals of a match, scaled by the root of its weight: one for a number, up to 100 for
 * a time history, each for a stretch of it. */
int cz_match_n_detail(const CzMatchItem *item);

/* A match without a value in the run: value and residual are NaN. */
CzMatchResult cz_match_begin(const CzMatchItem *item, const CzScene *scene);

/* Evaluates one match. `subject` has the run's summary, `run` its channels. `detail` receives its
 * residuals (n_detail) unless it is NULL. Status: CZ_STATUS_INPUT for a channel that the run does
 * not have. */
CZ_MUST_CHECK CzStatus cz_match_judge(const CzMatchItem *item, const CzSubject *subject,
                                      const CzRun *run, CzMatchResult *result, double *detail,
                                      CzError *error);

#endif
