/* The metrics, one per entry of results.def, and the values that are judged. */
#include "evaluate/devices.h"
#include "evaluate/metric.h"
#include "evaluate/unfollowed.h"
#include "problem/meeting.h"
#include "simulate/pulse.h"

#include <math.h>
#include <string.h>

/* Energies below this have no shares [J]. */
static const double nothing = 100;

static double share_of(double part, double whole) {
    return whole > nothing ? part / whole : NAN;
}

/* Closing speed at the end of a run; 0 when the end criterion was met: then no neighbouring cars
 * approached for one pitch period, and the remaining speeds are chatter that depends on the time
 * step. */
static double left_to_close(const CzPlace *place) {
    const CzRunSummary *run = place->run;
    const bool over = run->ended == CZ_ENDED_BY_RULE || run->ended == CZ_ENDED_SETTLED;
    return over ? 0 : run->closing_speed;
}

/* Rib pitch of the coarser of the two faces at an interface; 0 without faces. */
static double rib_pitch(const CzPlace *place) {
    double pitch = 0;
    for (int side = 0; side < 2; side++) {
        const int vehicle = place->interface_index + side;
        const CzVehicle *record = &place->vehicles[place->scene->record[vehicle]];
        const CzAntiClimber *face =
            side == 0 ? &record->front.anti_climber : &record->rear.anti_climber;
        if (face->given && face->rib_count > 0)
            pitch = fmax(pitch, face->face_height / face->rib_count);
    }
    return pitch;
}

static bool is_judged(const CzPlace *place, int vehicle) {
    return !cz_scene_has_obstacle_at(place->scene, vehicle);
}

/* Whether a device at an interface, except those of an obstacle, bottomed out. */
static double judged_bottoming(const CzPlace *place) {
    const CzInterfaceResult *interface = place->interface;
    if (is_judged(place, place->interface_index) && is_judged(place, place->interface_index + 1))
        return interface->bottomed_out;
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].bottomed_out && is_judged(place, interface->element[i].vehicle))
            return 1;
    return 0;
}

/* Largest section force at an interface, except that of an obstacle. */
static double judged_section_force(const CzPlace *place) {
    double force = NAN;
    for (int side = 0; side < 2; side++)
        if (is_judged(place, place->interface_index + side))
            force = fmax(force, place->interface->section_force[side]);
    return force;
}

/* Peak force of an interface over the smaller proof strength of its ends, except those of an
 * obstacle and walls. */
static double force_over_strength(const CzPlace *place) {
    double strength = INFINITY;
    for (int side = 0; side < 2; side++) {
        const int vehicle = place->interface_index + side;
        const CzVehicle *record = &place->vehicles[place->scene->record[vehicle]];
        const CzEnd *end = side == 0 ? &record->front : &record->rear;
        if (!is_judged(place, vehicle) || record->model == CZ_MODEL_FIXED)
            continue;
        if (isnan(end->proof_strength))
            return NAN;
        strength = fmin(strength, end->proof_strength);
    }
    return isfinite(strength) ? place->interface->peak_force / strength : NAN;
}

/* Closure between the end structures over the clearance less the folded gangways; 0 at the
 * colliding interface, which has no gangway. */
static double inner_gap_used(const CzPlace *place) {
    if (place->interface_index == place->scene->colliding)
        return 0;
    double closure = place->interface->shortening;
    for (int i = 0; i < place->interface->n_element; i++)
        if (place->interface->element[i].kind == CZ_ELEMENT_END)
            closure -= place->interface->element[i].stroke;
    const int *record = &place->scene->record[place->interface_index];
    const CzEnd *behind = &place->vehicles[record[0]].front;
    const CzEnd *ahead = &place->vehicles[record[1]].rear;
    const double room =
        behind->face_gap - behind->gangway_block + ahead->face_gap - ahead->gangway_block;
    return room > 0 || isnan(room) ? closure / room : INFINITY;
}

/* Plastic energy of the end structure behind an anti-climber [J]. */
static double energy_behind(const CzPlace *place) {
    for (int i = 0; i < place->interface->n_element; i++) {
        const CzElementResult *element = &place->interface->element[i];
        if (element->kind == CZ_ELEMENT_END && element->vehicle == place->element->vehicle)
            return element->energy;
    }
    return 0;
}

/* The stroke of a bottomed-out device hardly depends on the impact. Beyond its usable stroke two
 * quantities therefore represent the missing stroke: the rise of the force F over the largest
 * plastic one P, up to a tenth of the stroke, and for an anti-climber the energy E that the end
 * structure behind it had to absorb instead:
 *
 *   demand = used + 0.1 (1 - P / F) + E / (P stroke)
 *
 * The demand is continuous at the usable stroke. A coupler with a shear-off has no demand until it
 * shears off, because its tubes may be exhausted. */
static double stroke_demand(const CzPlace *place) {
    const CzElementResult *element = place->element;
    if (element->kind == CZ_ELEMENT_COUPLER && place->end->coupler.shear_off.given &&
        !element->sheared)
        return 0;
    const double plastic = cz_plastic_force(place->end, element->kind, place->rate);
    if (!element->bottomed_out || !(element->peak_force > plastic))
        return element->stroke_used;
    double demand = element->stroke_used + 0.1 * (1 - plastic / element->peak_force);
    if (element->kind == CZ_ELEMENT_ANTI_CLIMBER && element->stroke > 0 && plastic > 0)
        demand += energy_behind(place) / (plastic * element->stroke);
    return demand;
}

static double shear_load(const CzPlace *place) {
    const CzCoupler *coupler = &place->end->coupler;
    if (place->element->kind != CZ_ELEMENT_COUPLER || !coupler->shear_off.given)
        return NAN;
    const double load = place->element->peak_force / coupler->shear_off.force;
    return place->element->sheared ? fmax(load, 1) : load;
}

static double judged_wheel_lift(const CzPlace *place) {
    double lift = place->vehicle->checks_override ? 0 : NAN;
    for (int i = 0; i < 4; i++)
        lift = isnan(lift) ? lift : fmax(lift, place->vehicle->wheel_lift[i]);
    return lift;
}

static double judged_bogie_lift(const CzPlace *place) {
    return place->vehicle->checks_override ? place->vehicle->bogie_lift : NAN;
}

/* Plastic energy in the survival space of all vehicles except obstacles [J]. */
static double judged_survival(const CzPlace *place) {
    const CzRunSummary *run = place->run;
    double energy = 0.0;
    for (int i = 0; i < run->n_interface; i++)
        for (int k = 0; k < run->interface[i].n_element; k++)
            if (is_judged(place, run->interface[i].element[k].vehicle))
                energy += run->interface[i].element[k].zone_energy[CZ_ZONE_SURVIVAL];
    return energy;
}

/* Largest reduction in length of the survival space within a stretch of the length `over`. A loss
 * is at one end of the space, so that a stretch has both only where the space is not longer. */
static double survival_loss(const CzPlace *place) {
    const double *loss = place->vehicle->survival_loss, over = place->parameter[0];
    const double space = place->record->length - cz_length_before(&place->record->front) -
                         cz_length_before(&place->record->rear);
    if (space > over)
        return fmax(loss[0], loss[1]); /* ignores NaN */
    const double sum = place->vehicle->survival_shortening;
    return space > 0 ? sum * over / space : sum;
}

/* Stroke of an end in its stages of zone `temporary`. */
static double temporary_shortening(const CzPlace *place) {
    const double stroke = place->element != NULL ? place->element->stroke : 0;
    double from = 0, taken = 0;
    for (int k = 0; k < place->end->n_stages; k++) {
        const double to = from + place->end->stages[k].stroke;
        if (place->end->stages[k].zone == CZ_ZONE_TEMPORARY)
            taken += fmax(fmin(stroke, to) - from, 0);
        from = to;
    }
    return taken;
}

/* That over the length of the space; 0 for an end without such stages, whose crush zone is
 * unoccupied. */
static double temporary_share(const CzPlace *place) {
    bool is_occupied = false;
    for (int k = 0; k < place->end->n_stages; k++)
        is_occupied |= place->end->stages[k].zone == CZ_ZONE_TEMPORARY;
    return is_occupied ? temporary_shortening(place) / place->end->temporary_length : 0;
}

/* Largest force of a coupler of the interface; NaN when it has none. */
static double coupler_force(const CzPlace *place) {
    double force = NAN;
    for (int i = 0; i < place->interface->n_element; i++)
        if (place->interface->element[i].kind == CZ_ELEMENT_COUPLER)
            force = fmax(force, place->interface->element[i].peak_force);
    return force;
}

static double ramp_over_friction(const CzPlace *place) {
    const CzInterfaceResult *interface = place->interface;
    return interface->friction > 0 ? interface->ramp / interface->friction : NAN;
}

static double swing_over_stop(const CzPlace *place) {
    const CzInterfaceResult *interface = place->interface;
    return fmax(interface->swing[0] / interface->swing_stop[0],
                interface->swing[1] / interface->swing_stop[1]);
}

/* Whether the reader would reject the design. Lack of memory counts as a broken rule, so that such
 * a design cannot become the best. */
static double breaks_rules(const CzPlace *place) {
    return cz_problem_check_vehicles(place->problem, place->vehicles, NULL) != CZ_OK;
}

static bool lacks_stops(const CzPlace *place) {
    for (int i = 0; i < place->run->n_vehicle; i++)
        if (place->vehicles[place->scene->record[i]].model == CZ_MODEL_FULL &&
            !place->run->vehicle[i].checks_override)
            return true;
    return false;
}

/* An override in a run always counts; the absence of one is known only when every full vehicle
 * declares its stops, and the model follows all contacts of the colliding ends. */
static double climbed(const CzPlace *place) {
    if (place->run->beyond_validity)
        return 1;
    return place->must_declare && !lacks_stops(place) && cz_contact_unfollowed(place) == NULL ? 0
                                                                                              : NAN;
}

/* ---- pulses ---- */

static const CzPulse *pulse_of(const CzPlace *place) {
    const CzRunSummary *run = place->run;
    return run->pulse != NULL ? &run->pulse[place->vehicle - run->vehicle] : NULL;
}

/* Mean over the contact windows, by the parameters floor and shortest. */
static double contact_mean(const CzPlace *place, double window[2]) {
    const CzVehicleResult *vehicle = place->vehicle;
    const double floor = place->parameter[0], shortest = place->parameter[1];
    memcpy(window, vehicle->contact_window, 2 * sizeof *window);
    if (pulse_of(place) == NULL || (floor == CZ_PULSE_FLOOR && shortest == CZ_PULSE_SHORTEST))
        return vehicle->mean_deceleration_contact;
    window[0] = window[1] = 0;
    return cz_pulse_contact_mean(pulse_of(place), floor, shortest, window);
}

/* Mean over a sliding window, by the parameter window. */
static double sliding_mean(const CzPlace *place, double window[2]) {
    const CzVehicleResult *vehicle = place->vehicle;
    memcpy(window, vehicle->window_120ms, 2 * sizeof *window);
    if (pulse_of(place) == NULL || place->parameter[0] == CZ_PULSE_WINDOW)
        return vehicle->mean_deceleration_120ms;
    window[0] = window[1] = 0;
    return cz_pulse_sliding_mean(pulse_of(place), place->parameter[0], window);
}

/* Secondary impact by the parameter gap; NaN without a pulse. */
static double secondary_impact(const CzPlace *place, double *time) {
    *time = NAN;
    return pulse_of(place) == NULL
               ? NAN
               : cz_pulse_secondary_impact(pulse_of(place), place->parameter[0], time);
}

static double impact_time(const CzPlace *place) {
    double time;
    (void)secondary_impact(place, &time);
    return time;
}

/* ---- times of values ---- */

/* Time of the first event of a kind at a place; NaN when there was none. */
static double event_time(const CzPlace *place, CzEventKind what, const char *where) {
    for (int i = 0; i < place->run->n_event; i++) {
        const CzEvent *event = &place->run->event[i];
        if (event->what == what && event->interface == place->interface_index &&
            (where == NULL || strcmp(event->where, where) == 0))
            return event->time;
    }
    return NAN;
}

static const double *worse_window(const CzVehicleResult *vehicle) {
    return vehicle->mean_deceleration_contact > vehicle->mean_deceleration_120ms
               ? vehicle->contact_window
               : vehicle->window_120ms;
}

static double wheel_lift_time(const CzVehicleResult *vehicle) {
    int highest = 0;
    for (int i = 1; i < 4; i++)
        if (vehicle->wheel_lift[i] > vehicle->wheel_lift[highest])
            highest = i;
    return vehicle->wheel_lift_time[highest];
}

/* ---- the list ---- */

/* The record of each level. */
#define CZ_RECORD_AT_RUN place->run
#define CZ_RECORD_AT_ENERGY (&place->run->energy)
#define CZ_RECORD_AT_INTERFACE place->interface
#define CZ_RECORD_AT_ELEMENT place->element
#define CZ_RECORD_AT_VEHICLE place->vehicle

/* The value of a metric, and its time. */
#define AT(time) window[0] = window[1] = (time)
#define OVER(from) memcpy(window, from, 2 * sizeof *window)
#define BY(function) (void)(function)(place, window)
#define NO_TIME window[0] = window[1] = NAN
#define FUNCTIONS(record, key, judged, when)                                                       \
    static double judge_##record##_##key(const CzPlace *place) {                                   \
        return judged;                                                                             \
    }                                                                                              \
    static void when_##record##_##key(const CzPlace *place, double window[2]) {                    \
        (void)place;                                                                               \
        when;                                                                                      \
    }
#define CZ_RESULT(...)
#define CZ_QUANTITY(...)
#define CZ_METRIC(record, key, form, source, unit, dimension, heading, scale, absent, when, doc)   \
    FUNCTIONS(record, key, CZ_RECORD_AT_##record->source, when)
#define CZ_METRIC_BY(record, key, form, source, unit, dimension, heading, judged, scale, absent,   \
                     when, doc)                                                                    \
    FUNCTIONS(record, key, judged, when)
#include "evaluate/results.def"

#define CZ_LEVEL_ENERGY CZ_LEVEL_RUN /* energies are those of the run */

/* Forms of a result that are totals over the whole run. */
enum {
    IS_TOTAL_REAL = false,
    IS_TOTAL_REAL_BY = false,
    IS_TOTAL_EXACT = false,
    IS_TOTAL_FLAG = false,
    IS_TOTAL_METRIC = false,
    IS_TOTAL_TOTAL = true,
    IS_TOTAL_METRIC_TOTAL = true
};

#define ABSENT_SKIP(why) false, why
#define ABSENT_UNKNOWN(why) true, why
#define KIND(record, key, form, unit, scale, absent, doc)                                          \
    {CZ_LEVEL_##record,                                                                            \
     CZ_METRIC_PREFIX_##record #key,                                                               \
     &cz_result_units[CZ_UNIT_OF_##unit],                                                          \
     IS_TOTAL_##form,                                                                              \
     scale,                                                                                        \
     ABSENT_##absent,                                                                              \
     judge_##record##_##key,                                                                       \
     when_##record##_##key,                                                                        \
     doc},
#define CZ_RESULT(...)
#define CZ_QUANTITY(...)
#define CZ_METRIC(record, key, form, source, unit, dimension, heading, scale, absent, when, doc)   \
    KIND(record, key, form, unit, scale, absent, doc)
#define CZ_METRIC_BY(record, key, form, source, unit, dimension, heading, judged, scale, absent,   \
                     when, doc)                                                                    \
    KIND(record, key, form, unit, scale, absent, doc)
static const CzMetricKind kinds[] = {
#include "evaluate/results.def"
};

enum { N_KIND = sizeof kinds / sizeof kinds[0] };

int cz_n_metric_kind(void) {
    return N_KIND;
}

double cz_metric_at(const CzMetric *metric, const CzPlace *place) {
    CzPlace at = *place;
    at.parameter = metric->parameter;
    return metric->kind->value(&at) / metric->kind->unit->in_si;
}

void cz_metric_time_window(const CzMetric *metric, const CzPlace *place, double when[2]) {
    CzPlace at = *place;
    at.parameter = metric->parameter;
    when[0] = when[1] = NAN;
    if (metric->kind->when != NULL)
        metric->kind->when(&at, when);
    if (metric->kind->value(&at) == 0 || !(when[1] >= when[0]))
        when[0] = when[1] = NAN;
}

const CzMetricKind *cz_metric_kind(int index) {
    return &kinds[index];
}

const char *cz_metric_absence(const CzMetricKind *kind, const CzPlace *place) {
    const bool is_of_contact =
        kind->value == judge_RUN_contact_unfollowed ||
        (kind->value == judge_RUN_override && place->must_declare && !lacks_stops(place));
    return is_of_contact ? cz_contact_unfollowed(place) : kind->absent;
}

/* ---- activation ---- */

/* The energies that are zero before an activation. */
static const struct {
    double (*value)(const CzPlace *place);
    bool (*activation)(const CzPlace *place, CzActivation *activation);
} activations[] = {
    {judge_ELEMENT_energy_kJ, cz_activation_of_element},
    {judge_ELEMENT_tube_energy_kJ, cz_activation_of_tubes},
    {judge_ELEMENT_temporary_energy_kJ, cz_activation_of_temporary_space},
    {judge_ELEMENT_survival_energy_kJ, cz_activation_of_survival_space},
    {judge_ENERGY_survival_kJ, cz_activation_of_survival_spaces},
};

enum { N_ACTIVATION = sizeof activations / sizeof activations[0] };

static int find_activation(const CzMetricKind *kind) {
    int i = 0;
    while (i < N_ACTIVATION && activations[i].value != kind->value)
        i++;
    return i;
}

bool cz_metric_has_activation(const CzMetricKind *kind) {
    return find_activation(kind) < N_ACTIVATION;
}

bool cz_metric_activation_at(const CzMetricKind *kind, const CzPlace *place,
                             CzActivation *activation) {
    const int i = find_activation(kind);
    if (i == N_ACTIVATION || !activations[i].activation(place, activation))
        return false;
    activation->size /= kind->unit->in_si;
    return true;
}

/* ---- rules between values ---- */

static double rule_ratio(const CzPlace *place, CzValueRule rule) {
    double ratio[CZ_N_VALUE_RULE];
    cz_problem_rule_ratios(place->problem, place->vehicles, place->record, place->end, ratio);
    return ratio[rule];
}

#define CZ_VALUE_RULE(constant, name, doc)                                                         \
    static double read_rule_##constant(const CzPlace *place) {                                     \
        return rule_ratio(place, CZ_VALUE_RULE_##constant);                                        \
    }
#include "problem/value_rules.def"
#undef CZ_VALUE_RULE

const CzMetricKind *cz_metric_of_rule(CzValueRule rule) {
#define CZ_VALUE_RULE(constant, name, doc)                                                         \
    {CZ_LEVEL_END, name,  &cz_result_units[CZ_UNIT_OF_NONE], false,                                \
     0.01,         false, "no end has such a value",         read_rule_##constant,                 \
     NULL,         doc},
    static const CzMetricKind of_rule[] = {
#include "problem/value_rules.def"
    };
#undef CZ_VALUE_RULE
    return &of_rule[rule];
}
