/* Indicators: events before the climb, and forces beyond what a part can hold. */
#include "evaluate/override_indicators.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

__attribute__((format(printf, 4, 5))) static void add(CzExplanation *explanation, CzCause cause,
                                                      double time, const char *format, ...) {
    if (explanation->n_indicator == CZ_MOST_INDICATORS)
        return;
    CzIndicator *indicator = &explanation->indicator[explanation->n_indicator++];
    indicator->cause = cause;
    indicator->time = time;
    va_list values;
    va_start(values, format);
    vsnprintf(indicator->what, sizeof indicator->what, format, values);
    va_end(values);
}

static void add_event(CzExplanation *explanation, const CzEvent *event) {
    switch (event->what) {
    case CZ_EVENT_BOTTOMED_OUT:
        add(explanation, CZ_CAUSE_BOTTOMING, event->time, "%s bottomed out", event->where);
        return;
    case CZ_EVENT_SWING_STOP:
        add(explanation, CZ_CAUSE_STRUT, event->time, "%s met its swing stop", event->where);
        return;
    case CZ_EVENT_LIFT_STOP:
        add(explanation, CZ_CAUSE_SUSPENSION, event->time, "lift stop of the %s met", event->where);
        return;
    case CZ_EVENT_BUMP_STOP:
        add(explanation, CZ_CAUSE_SUSPENSION, event->time, "bump stop of the %s met", event->where);
        return;
    default:
        return;
    }
}

/* Whole kN for a sentence. */
static long kilonewton(double force) {
    return lround(force / 1e3);
}

static void add_of_interface(CzExplanation *explanation, const CzInterfaceResult *interface) {
    double coupler = 0;
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].kind == CZ_ELEMENT_COUPLER)
            coupler = fmax(coupler, interface->element[i].peak_force);
    if (coupler > interface->critical_force)
        add(explanation, CZ_CAUSE_STRUT, NAN, "%s: the coupler carried %ld kN, F_crit is %ld kN",
            interface->name, kilonewton(coupler), kilonewton(interface->critical_force));
    if (interface->vertical_margin < 0)
        add(explanation, CZ_CAUSE_CAPACITY, NAN,
            "%s: the anti-climbers slipped under a vertical force of %ld kN", interface->name,
            kilonewton(interface->vertical_demand));
    if (interface->min_overlap < 0)
        add(explanation, CZ_CAUSE_OVERLAP, NAN, "%s: the faces lost their overlap",
            interface->name);
}

void cz_override_indicators_find(const CzRunSummary *run, CzExplanation *explanation) {
    const double until = run->beyond_validity ? run->beyond_validity_time : INFINITY;
    for (int i = 0; i < run->n_interface; i++)
        add_of_interface(explanation, &run->interface[i]);
    for (int i = 0; i < run->n_event; i++)
        if (run->event[i].time <= until)
            add_event(explanation, &run->event[i]);
}
