/* Sweeps: one or two values of a problem file are varied over a range, and every point is judged.
 *
 * Each point is the problem read again with its values set, as with `--set`, so that any path may
 * be varied: speeds, offsets, masses, stiffnesses, gaps. Points are independent and run on all
 * threads; the result of a point is that of the same problem run by itself, to the last bit.
 */
#ifndef CRUSHZONE_SWEEP_H
#define CRUSHZONE_SWEEP_H

#include <signal.h>
#include <stddef.h>

#include "crushzone/evaluate.h"

CZ_BEGIN_DECLARATIONS

enum { CZ_MAX_AXES = 2, CZ_MAX_SWEPT_METRICS = 8, CZ_MAX_LISTED = 64 };

/* A path with its values, in the unit of the path's key: n evenly spaced ones from `from` to `to`,
 * or a list in rising order. */
typedef struct CzSweepAxis {
    char path[CZ_PATH_SIZE];
    double from, to; /* of a list its first and last value */
    int n;           /* at least 2 */
    bool is_list;
    double listed[CZ_MAX_LISTED]; /* of a list (n) */
} CzSweepAxis;

/* Reads a text such as "trains.A.speed_km_h=5:40:8" or "trains.A.speed_km_h=8,15,25", whose values
 * it sorts. Status: CZ_OK, CZ_STATUS_INPUT. */
CZ_MUST_CHECK CZ_API CzStatus cz_sweep_axis_parse(const char *text, CzSweepAxis *axis,
                                                  CzError *error);

/* The index-th value of an axis. */
CZ_API double cz_sweep_axis_value(const CzSweepAxis *axis, int index);

/* State of a point. */
typedef enum CzSweepState {
    CZ_SWEEP_DONE,
    CZ_SWEEP_RUN_FAILED, /* a run failed or is incomplete */
    CZ_SWEEP_INVALID,    /* the reader refuses these values; `message` has the reason */
    CZ_SWEEP_NOT_RUN     /* of another shard, or interrupted before */
} CzSweepState;
CZ_API const char *cz_sweep_state_text(CzSweepState state);

typedef struct CzSweepPoint {
    double value[CZ_MAX_AXES]; /* in the units of the paths */
    CzSweepState state;
    CzVerdict verdict; /* over the checks requested; CZ_VERDICT_NOT_CHECKED unless done */
    double margin;     /* smallest margin of them; NaN when none has one, or only a yes-or-no check
                          fails */
    char check[CZ_LABEL_SIZE]; /* the check with that margin, or the failing yes-or-no check, its
                                  scenario and place; empty when none */
    char scenario[CZ_NAME_SIZE];
    char where[CZ_WHERE_SIZE];
    bool beyond_validity; /* an override occurred: metrics may be of the time after it, and totals
                             are NaN */
    double metric[CZ_MAX_SWEPT_METRICS]; /* in the metrics' units; NaN when unknown (n_metric) */
    char metric_where[CZ_MAX_SWEPT_METRICS][CZ_PLACE_SIZE]; /* place and scenario (n_metric) */
    char message[512];                                      /* why it is invalid or failed */
} CzSweepPoint;

/* A scenario that a varied value does not reach, because the scenario sets it itself. Texts are
 * borrowed from the sweep's problem. */
typedef struct CzUnreached {
    int axis;
    const char *scenario;
    const char *by; /* key of the scenario that sets it, such as "speed_km_h"; "trains" where it
                       does not run the train */
} CzUnreached;

enum { CZ_MAX_SWEPT_CURVES = 12 };

/* Histories of a point in the scenario of the curves, in the units of the channels. Missing ones
 * are NULL, such as those of a run that failed. */
typedef struct CzSweepCurve {
    int point;
    int n;
    double *time;    /* [ms] (n) */
    double *force;   /* of the colliding interface [kN] (n) */
    double *closure; /* of the colliding interface, NaN where its cars have parted [mm] (n) */
    double *speed;   /* of the car behind it [m/s] (n) */
} CzSweepCurve;

/* Open result, owns its memory. */
typedef struct CzSweep {
    int n_axis;
    CzSweepAxis axis[CZ_MAX_AXES];
    int n_metric;
    char metric[CZ_MAX_SWEPT_METRICS][96];
    const char *metric_unit[CZ_MAX_SWEPT_METRICS]; /* static */
    const char *metric_doc[CZ_MAX_SWEPT_METRICS];  /* what it is; static */
    int n_point;                                   /* product of the axes' lengths */
    CzSweepPoint *point;                           /* the last axis changes fastest (n_point) */
    int shard, n_shard; /* this one, from 1, and their number: 1 and 1 without shards */
    int begin, end;     /* its points, from 0, the last one excluded */
    int worst; /* a point whose run failed, else one that fails, else the one with the smallest
                  margin; -1 when none is done */
    bool is_interrupted;
    int n_unreached;
    CzUnreached *unreached; /* axis by axis, scenarios in the order of the file (n_unreached) */
    int n_curve;            /* 0 when none were asked for, and of a shard or an interrupted sweep */
    CzSweepCurve *curve;    /* of all completed points, or of CZ_MAX_SWEPT_CURVES of them at equal
                               distances, with both ends (n_curve) */
    char
        curve_scenario[CZ_NAME_SIZE]; /* the one that was asked for, else that of the worst check */
    CzProblem *problem;               /* as written, for titles and warnings */
    double wall_s;
} CzSweep;

/* Fills the points whose results are known already, such as those of other shards; they are not
 * run. */
typedef CzStatus (*CzSweepRecall)(CzSweep *sweep, void *data, CzError *error);

typedef struct CzSweepOptions {
    int n_axis;
    const CzSweepAxis *axis; /* one or two (n_axis) */
    int n_metric;
    const char *const
        *metric; /* to be reported each point, such as "vehicles.bogie_lift_mm"; the largest of all
                    places and scenarios, with ".min" at the end the smallest (n_metric) */
    int n_check;
    const char *const *check; /* names of checks that points are judged by; all when 0 (n_check) */
    const char *scenario;     /* this scenario or family only; NULL for all */
    bool curves;        /* run points once more, in one scenario, and keep histories for figures */
    int shard, n_shard; /* only these points: the shard-th of n_shard equal runs of points */
    int n_job;          /* threads; 0: one per processor */
    const CzExecutor *executor; /* where its tasks run; NULL: in n_job threads */
    const char *text;           /* text that is read in place of the file; NULL for the file */
    size_t n_text;              /* [byte] */
    const volatile sig_atomic_t *stop; /* a flag that ends the sweep when not 0; NULL when none */
    void (*progress)(int n_done, int n_point, void *data); /* NULL when none */
    void *progress_data;
    CzSweepRecall recall; /* NULL when no point is known */
    void *recall_data;
} CzSweepOptions;
CZ_API CzSweepOptions cz_sweep_options_default(void);

/* Sweeps a problem file. *sweep is created whenever CZ_OK is returned, also for an interrupted
 * sweep. Statuses: CZ_OK, CZ_STATUS_INPUT for a file, path, metric or check that is wrong at every
 * point, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_sweep(const char *file, const CzProblemOptions *problem_options,
                                       const CzSweepOptions *options, CzSweep **sweep,
                                       CzError *error);
CZ_API void cz_sweep_free(CzSweep *sweep);

CZ_END_DECLARATIONS
#endif
