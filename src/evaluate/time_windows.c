/* When the value of a metric was reached, for those whose time a run keeps. */
#include "evaluate/when.h"

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

static void at(double time, double window[2]) {
    window[0] = window[1] = time;
}

static void over(const double from[2], double window[2]) {
    window[0] = from[0];
    window[1] = from[1];
}

void cz_when_peak_time(const CzPlace *place, double window[2]) {
    at(place->interface->peak_time, window);
}

void cz_when_bottomed_time(const CzPlace *place, double window[2]) {
    at(event_time(place, CZ_EVENT_BOTTOMED_OUT, NULL), window);
}

void cz_when_overlap_time(const CzPlace *place, double window[2]) {
    at(place->interface->overlap_time, window);
}

void cz_when_margin_time(const CzPlace *place, double window[2]) {
    at(place->interface->margin_time, window);
}

void cz_when_sheared_time(const CzPlace *place, double window[2]) {
    at(event_time(place, CZ_EVENT_SHEAR_OFF, place->element->name), window);
}

void cz_when_contact_window(const CzPlace *place, double window[2]) {
    over(place->vehicle->contact_window, window);
}

void cz_when_window_120ms(const CzPlace *place, double window[2]) {
    over(place->vehicle->window_120ms, window);
}

void cz_when_mean_window(const CzPlace *place, double window[2]) {
    const CzVehicleResult *vehicle = place->vehicle;
    over(vehicle->mean_deceleration_contact > vehicle->mean_deceleration_120ms
             ? vehicle->contact_window
             : vehicle->window_120ms,
         window);
}

void cz_when_wheel_lift_time(const CzPlace *place, double window[2]) {
    const CzVehicleResult *vehicle = place->vehicle;
    int highest = 0;
    for (int i = 1; i < 4; i++)
        if (vehicle->wheel_lift[i] > vehicle->wheel_lift[highest])
            highest = i;
    at(vehicle->wheel_lift_time[highest], window);
}

void cz_when_bogie_lift_time(const CzPlace *place, double window[2]) {
    at(place->vehicle->bogie_lift_time, window);
}

void cz_when_climb_time(const CzPlace *place, double window[2]) {
    at(place->run->beyond_validity_time, window);
}

void cz_metric_time_window(const CzMetricKind *kind, const CzPlace *place, double when[2]) {
    when[0] = when[1] = NAN;
    if (kind->when != NULL)
        kind->when(place, when);
    if (kind->value(place) == 0 || !(when[1] >= when[0]))
        when[0] = when[1] = NAN;
}
