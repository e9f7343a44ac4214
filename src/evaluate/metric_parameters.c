/* Parameters of metrics: the list, and reading "(gap_m=0.75)". */
#include "evaluate/metric.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/suggest.h"
#include "simulate/pulse.h"

#define CZ_METRIC_PARAMETER(record, key, name, in_si, lo, hi, usual, doc)                          \
    {CZ_METRIC_PREFIX_##record #key, #name, in_si, lo, hi, usual, doc},
#define CZ_METRIC_OF_PULSE(...)
static const CzMetricParameter parameters[] = {
#include "evaluate/metric_parameters.def"
};

enum { N_PARAMETER = sizeof parameters / sizeof parameters[0] };

typedef enum { ALWAYS, UNUSUAL } When;

#define CZ_METRIC_PARAMETER(...)
#define CZ_METRIC_OF_PULSE(record, key, when) {CZ_METRIC_PREFIX_##record #key, when},
static const struct {
    const char *metric;
    When when;
} of_pulse[] = {
#include "evaluate/metric_parameters.def"
};

int cz_metric_parameters(const char *metric, const CzMetricParameter **first) {
    int n = 0;
    *first = NULL;
    for (int i = 0; i < N_PARAMETER; i++) {
        if (strcmp(parameters[i].metric, metric) != 0)
            continue;
        *first = n++ == 0 ? &parameters[i] : *first;
    }
    return n;
}

bool cz_metric_needs_pulse(const CzMetric *metric) {
    if (metric->kind == NULL)
        return false;
    const CzMetricParameter *parameter;
    const int n = cz_metric_parameters(metric->kind->name, &parameter);
    bool is_usual = true;
    for (int i = 0; i < n; i++)
        is_usual &= metric->parameter[i] == parameter[i].usual * parameter[i].in_si;
    for (size_t i = 0; i < sizeof of_pulse / sizeof of_pulse[0]; i++)
        if (strcmp(of_pulse[i].metric, metric->kind->name) == 0)
            return of_pulse[i].when == ALWAYS || !is_usual;
    return false;
}

/* Reads one "name=value". */
static CzStatus read_parameter(const char *text, int n, const CzMetricParameter *parameter,
                               CzMetric *metric, CzError *error) {
    const char *equals = strchr(text, '=');
    char name[CZ_PATH_SIZE];
    double value;
    snprintf(name, sizeof name, "%.*s", equals != NULL ? (int)(equals - text) : 0, text);
    if (equals == NULL || !cz_number_scan(equals + 1, &value))
        return cz_fail(error, CZ_STATUS_INPUT,
                       "'%s' is not a parameter and its number, such as gap_m=0.75", text);
    CzSuggestion nearest = {0};
    const int i = CZ_FIND_NAMED(name, CzMetricParameter, parameter, n, &nearest);
    if (i < 0) {
        const CzStatus status =
            cz_fail(error, CZ_STATUS_INPUT, "%s has no parameter '%s'", metric->kind->name, name);
        cz_suggest_help(&nearest, error);
        return status;
    }
    if (!(value >= parameter[i].lo && value <= parameter[i].hi))
        return cz_fail(error, CZ_STATUS_INPUT, "%s of %s must be from %s to %s", name,
                       metric->kind->name, CZ_SHORT(parameter[i].lo), CZ_SHORT(parameter[i].hi));
    metric->parameter[i] = value * parameter[i].in_si;
    return CZ_OK;
}

CzStatus cz_metric_read_parameters(const char *text, CzMetric *metric, CzError *error) {
    const CzMetricParameter *parameter;
    const int n = cz_metric_parameters(metric->kind->name, &parameter);
    for (int i = 0; i < n; i++)
        metric->parameter[i] = parameter[i].usual * parameter[i].in_si;
    for (const char *next = text; *next != '\0';) {
        const size_t length = strcspn(next, ",");
        char one[CZ_PATH_SIZE];
        const size_t blank = strspn(next, " ");
        snprintf(one, sizeof one, "%.*s", (int)(length > blank ? length - blank : 0), next + blank);
        CZ_TRY(read_parameter(one, n, parameter, metric, error));
        next += length + (next[length] == ',');
    }
    for (int i = 0; i < n; i++)
        if (metric->parameter[i] != metric->parameter[i])
            return cz_fail(error, CZ_STATUS_INPUT, "%s needs its %s: %s(%s=...)",
                           metric->kind->name, parameter[i].doc, metric->kind->name,
                           parameter[i].name);
    return CZ_OK;
}
