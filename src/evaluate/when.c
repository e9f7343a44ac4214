/* When the value of a metric was reached, for those whose time a run keeps. */
#include "evaluate/metric.h"

#include <math.h>
#include <string.h>

/* The first event of a kind that happened there; NaN when there was none. */
static double event_time(const CzPlace *place, CzEventKind what, const char *where) {
    for (int i = 0; i < place->run->n_event; i++) {
        const CzEvent *event = &place->run->event[i];
        if (event->what == what && event->interface == place->interface_index &&
            (where == NULL || strcmp(event->where, where) == 0))
            return event->time;
    }
    return NAN;
}

static double wheel_lift_time(const CzVehicleResult *vehicle) {
    int highest = 0;
    for (int i = 1; i < 4; i++)
        if (vehicle->wheel_lift[i] > vehicle->wheel_lift[highest])
            highest = i;
    return vehicle->wheel_lift_time[highest];
}

static double bottomed_time(const CzPlace *place) {
    return event_time(place, CZ_EVENT_BOTTOMED_OUT, NULL);
}

static double sheared_time(const CzPlace *place) {
    return event_time(place, CZ_EVENT_SHEAR_OFF, place->element->name);
}

static const double *mean_window(const CzVehicleResult *vehicle) {
    return vehicle->mean_deceleration_contact > vehicle->mean_deceleration_120ms
               ? vehicle->contact_window
               : vehicle->window_120ms;
}

/* One function per line of the list, that writes begin and end [s]. */
#define CZ_PASTE(a, b) a##b
#define CZ_READER(line) CZ_PASTE(read_, line)
#define CZ_WHEN(name, begin, end)                                                                  \
    static void CZ_READER(__LINE__)(const CzPlace *place, double when[2]) {                        \
        when[0] = begin;                                                                           \
        when[1] = end;                                                                             \
    }
#include "evaluate/when.def"
#undef CZ_WHEN

#define CZ_WHEN(name, begin, end) {name, CZ_READER(__LINE__)},
static const struct {
    const char *name;
    void (*read)(const CzPlace *place, double when[2]);
} readers[] = {
#include "evaluate/when.def"
};
#undef CZ_WHEN

void cz_metric_when(const CzMetricKind *kind, const CzPlace *place, double when[2]) {
    when[0] = when[1] = NAN;
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        if (strcmp(readers[i].name, kind->name) == 0)
            readers[i].read(place, when);
    if (kind->value(place) == 0 || !(when[1] >= when[0]))
        when[0] = when[1] = NAN;
}
