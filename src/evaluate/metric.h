/* Metrics: meaning and value of a text such as "interfaces.A4-B1.peak_force_kN".
 *
 *   LEVEL [. SELECTOR] . NAME [(PARAMETER=VALUE, ...)] [. max|min|sum|mean]
 *
 * The selector picks places by name, with `*` and `?`; `colliding` is the interface between
 * the trains and `inner` are all others. Elements are picked by their name ("coupler A4", "coupler
 * *") or by interface and name ("A4-B1 coupler A4", "colliding coupler *"). Without a word at the
 * end the worst place counts: the largest for an upper limit, the smallest for a lower one.
 * Parameters are those of metric_parameters.def.
 */
#ifndef CZ_EVALUATE_METRIC_H
#define CZ_EVALUATE_METRIC_H

#include "evaluate/activation.h"
#include "evaluate/place.h"
#include "evaluate/results.h"

/* A result that can be judged: an entry of results.def. */
typedef struct CzMetricKind {
    CzLevel level;
    const char *name;
    const CzResultUnit *unit;
    bool is_total; /* adds up over the whole run */
    double scale;  /* smallest scale of a margin, in the unit; CZ_FLAG_SCALE for a yes or no */
    bool may_be_unknown;
    const char *absent; /* reason why it does not apply, or the value that is not declared */
    double (*value)(const CzPlace *place);                /* SI */
    void (*when)(const CzPlace *place, double window[2]); /* NULL when its time is not stored [s] */
    const char *doc;
} CzMetricKind;

/* A parameter of a metric: an entry of metric_parameters.def. */
typedef struct CzMetricParameter {
    const char *metric, *name;
    double in_si, lo, hi, usual; /* NaN: it has no usual value and must be given */
    const char *doc;
} CzMetricParameter;

enum { CZ_MAX_METRIC_PARAMETERS = 2 }; /* of one metric */

/* Scale that marks a yes or no. */
#define CZ_FLAG_SCALE (-1.0)

typedef enum CzAggregate {
    CZ_AGGREGATE_WORST,
    CZ_AGGREGATE_MAX,
    CZ_AGGREGATE_MIN,
    CZ_AGGREGATE_SUM,
    CZ_AGGREGATE_MEAN
} CzAggregate;

typedef struct CzMetric {
    const CzMetricKind *kind;
    CzAggregate aggregate;
    char selector[CZ_PATH_SIZE];                /* "*" for all */
    double parameter[CZ_MAX_METRIC_PARAMETERS]; /* SI, in the order of the list */
} CzMetric;

typedef enum CzKnown {
    CZ_KNOWN,
    CZ_DOES_NOT_APPLY,
    CZ_UNKNOWN /* `value` is the worst known value, NaN when none is known */
} CzKnown;

typedef struct CzMetricValue {
    CzKnown known;
    double value;              /* in the metric's unit */
    char where[CZ_WHERE_SIZE]; /* place of the worst value */
    double when[2]; /* begin and end of the time at which it was reached [s]; NaN for a sum or mean,
                       or when the time is not stored */
    char unknown_where[CZ_WHERE_SIZE]; /* first place without the required declarations; empty when
                                        * none
                                        */
    const char *why;                   /* when not known; static */
} CzMetricValue;

/* Reads a metric's text. Status: CZ_STATUS_INPUT with the nearest name as help. */
CZ_MUST_CHECK CzStatus cz_metric_parse(const char *text, CzMetric *metric, CzError *error);

/* Value over all places that the selector picks; `worst_is_max` defines CZ_AGGREGATE_WORST. */
CzMetricValue cz_metric_value(const CzMetric *metric, const CzSubject *subject, bool worst_is_max);

/* Its value at one place, in its unit. */
double cz_metric_at(const CzMetric *metric, const CzPlace *place);
/* Time at which the value was reached at a place [s]: begin and end, NaN when it is not stored. */
void cz_metric_time_window(const CzMetric *metric, const CzPlace *place, double when[2]);

/* Why it has no value at a place. */
const char *cz_metric_absence(const CzMetricKind *kind, const CzPlace *place);

/* Parameters of a metric by its name: the first one; returns how many. */
int cz_metric_parameters(const char *metric, const CzMetricParameter **first);
/* Reads the text between the brackets, empty for none; the others get their usual values. Status:
 * CZ_STATUS_INPUT. */
CZ_MUST_CHECK CzStatus cz_metric_read_parameters(const char *text, CzMetric *metric,
                                                 CzError *error);
/* Whether a metric, unless its kind is NULL, reads the pulses, which a run keeps on request. */
bool cz_metric_needs_pulse(const CzMetric *metric);

/* Whether a metric is an energy that is zero before an activation; the activation at a place, its
 * size in the metric's unit, false where there is none. */
bool cz_metric_has_activation(const CzMetricKind *kind);
bool cz_metric_activation_at(const CzMetricKind *kind, const CzPlace *place,
                             CzActivation *activation);

/* Whether the selector picks any place in this scene, as written. */
bool cz_metric_picks(const CzMetric *metric, const CzScene *scene);

/* The metric of a rule between values: a ratio of an end, at most 1. */
const CzMetricKind *cz_metric_of_rule(CzValueRule rule);

/* All kinds, for documents and tests. */
int cz_n_metric_kind(void);
const CzMetricKind *cz_metric_kind(int index);

#endif
