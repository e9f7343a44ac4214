/* Metrics: names, parsing, aggregation. */
#include "evaluate/metric.h"
#include "base/error.h"
#include "base/suggest.h"

#include <stdio.h>
#include <string.h>

/* A value below this share of the smallest scale of a margin is rounding error and counts as 0. */
static const double rounding = 1e-9;

/* ---- reading the text ------------------------------------------------------------------------ */

/* Removes the word after the last dot from a text and returns it. */
static const char *cut_last_word(char *text) {
    char *dot = strrchr(text, '.');
    if (dot == NULL)
        return text;
    *dot = '\0';
    return dot + 1;
}

/* The aggregate of a word; CZ_AGGREGATE_WORST when it is not an aggregate. */
static CzAggregate aggregate_of(const char *word) {
    static const char *const words[] = {[CZ_AGGREGATE_MAX] = "max",
                                        [CZ_AGGREGATE_MIN] = "min",
                                        [CZ_AGGREGATE_SUM] = "sum",
                                        [CZ_AGGREGATE_MEAN] = "mean"};
    for (int i = CZ_AGGREGATE_MAX; i <= CZ_AGGREGATE_MEAN; i++)
        if (strcmp(word, words[i]) == 0)
            return (CzAggregate)i;
    return CZ_AGGREGATE_WORST;
}

/* Splits "LEVEL.SELECTOR.NAME" into "LEVEL.NAME" and the selector. */
static void split_selector(const char *text, char *name, size_t n_name, char *selector,
                           size_t n_selector) {
    snprintf(name, n_name, "%s", text);
    snprintf(selector, n_selector, "*");
    const char *first = strchr(text, '.');
    const char *last = strrchr(text, '.');
    if (first == NULL || first == last)
        return;
    snprintf(name, n_name, "%.*s%s", (int)(first - text), text, last);
    snprintf(selector, n_selector, "%.*s", (int)(last - first - 1), first + 1);
}

/* Moves the text between the last brackets of a metric out of it: "name(text).max" becomes
 * "name.max". */
static void cut_parameters(char *metric, char *text, size_t n_text) {
    char *open = strrchr(metric, '('), *close = open != NULL ? strchr(open, ')') : NULL;
    text[0] = '\0';
    if (close == NULL)
        return;
    snprintf(text, n_text, "%.*s", (int)(close - open - 1), open + 1);
    memmove(open, close + 1, strlen(close + 1) + 1);
}

CzStatus cz_metric_parse(const char *text, CzMetric *metric, CzError *error) {
    char copy[CZ_PATH_SIZE], name[CZ_PATH_SIZE], whole[CZ_PATH_SIZE], parameters[CZ_PATH_SIZE];
    if (strlen(text) >= sizeof copy)
        return cz_fail(error, CZ_STATUS_INPUT, "the metric '%.40s...' is longer than %d bytes",
                       text, CZ_PATH_SIZE - 1);
    snprintf(whole, sizeof whole, "%s", text);
    cut_parameters(whole, parameters, sizeof parameters);
    snprintf(copy, sizeof copy, "%s", whole);
    metric->aggregate = aggregate_of(cut_last_word(copy));
    if (metric->aggregate == CZ_AGGREGATE_WORST)
        snprintf(copy, sizeof copy, "%s", whole);
    split_selector(copy, name, sizeof name, metric->selector, sizeof metric->selector);
    CzSuggestion nearest = {0};
    const int kind =
        CZ_FIND_NAMED(name, CzMetricKind, cz_metric_kind(0), cz_n_metric_kind(), &nearest);
    metric->kind = kind >= 0 ? cz_metric_kind(kind) : NULL;
    if (kind >= 0)
        return cz_metric_read_parameters(parameters, metric, error);
    const CzStatus status = cz_fail(error, CZ_STATUS_INPUT, "there is no metric '%s'", text);
    cz_suggest_help(&nearest, error);
    return status;
}

bool cz_metric_picks(const CzMetric *metric, const CzScene *scene) {
    return cz_places_count(scene, metric->kind->level, metric->selector) > 0;
}

/* ---- value ----------------------------------------------------------------------------------- */

static const char no_pulse[] = "the run did not keep the pulses of the vehicles";

/* Sums over the places. */
typedef struct Sum {
    const CzMetric *metric;
    bool seeks_max;
    int n_known;
    double extreme, total; /* in the unit */
    double when[2];        /* of the extreme [s] */
    char where[CZ_WHERE_SIZE], unknown_where[CZ_WHERE_SIZE];
    bool any_unknown;
    const char *why; /* of the first place with an unknown value */
} Sum;

static void add_place(const CzPlace *place, void *data) {
    Sum *sum = data;
    const double value = cz_metric_at(sum->metric, place);
    if (isnan(value)) {
        const bool unknown = sum->metric->kind->may_be_unknown && place->must_declare;
        if (unknown && !sum->any_unknown) {
            memcpy(sum->unknown_where, place->name, sizeof sum->unknown_where);
            sum->why = cz_metric_absence(sum->metric->kind, place);
        }
        sum->any_unknown |= unknown;
        return;
    }
    const bool first = sum->n_known++ == 0;
    sum->total += value;
    if (first || (sum->seeks_max ? value > sum->extreme : value < sum->extreme)) {
        sum->extreme = value;
        memcpy(sum->where, place->name, sizeof sum->where);
        cz_metric_time_window(sum->metric, place, sum->when);
    }
}

static double aggregate_value(const Sum *sum, CzAggregate aggregate) {
    if (sum->n_known == 0)
        return NAN;
    if (aggregate == CZ_AGGREGATE_SUM)
        return sum->total;
    return aggregate == CZ_AGGREGATE_MEAN ? sum->total / sum->n_known : sum->extreme;
}

CzMetricValue cz_metric_value(const CzMetric *metric, const CzSubject *subject, bool worst_is_max) {
    const CzAggregate aggregate = metric->aggregate;
    if (subject->run != NULL && subject->run->pulse == NULL && cz_metric_needs_pulse(metric))
        return (CzMetricValue){
            .known = CZ_UNKNOWN, .value = NAN, .when = {NAN, NAN}, .why = no_pulse};
    Sum sum = {.metric = metric,
               .when = {NAN, NAN},
               .seeks_max = aggregate == CZ_AGGREGATE_MAX ||
                            (aggregate != CZ_AGGREGATE_MIN && worst_is_max)};
    cz_places_visit(subject, metric->kind->level, metric->selector, add_place, &sum);
    CzMetricValue value = {.known = CZ_KNOWN, .value = aggregate_value(&sum, aggregate)};
    if (fabs(value.value) < rounding * metric->kind->scale) /* not of a yes or no */
        value.value = 0;
    const bool is_one = aggregate != CZ_AGGREGATE_SUM && aggregate != CZ_AGGREGATE_MEAN;
    value.when[0] = is_one ? sum.when[0] : NAN;
    value.when[1] = is_one ? sum.when[1] : NAN;
    memcpy(value.where, sum.where, sizeof value.where);
    memcpy(value.unknown_where, sum.unknown_where, sizeof value.unknown_where);
    if (sum.any_unknown || (sum.n_known == 0 && metric->kind->may_be_unknown))
        value.known = CZ_UNKNOWN;
    else if (sum.n_known == 0)
        value.known = CZ_DOES_NOT_APPLY;
    if (value.known != CZ_KNOWN)
        value.why = sum.why != NULL ? sum.why : metric->kind->absent;
    return value;
}
