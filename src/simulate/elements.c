/* Results of each element, interface and vehicle. */
#include "simulate/run.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "simulate/devices.h"
#include "simulate/pulse.h"

#define CFC 60.0 /* channel frequency class of decelerations (SAE J211) [Hz] */

/* Usable stroke of a curve in a lane; infinite when it is unlimited. */
static double usable(const CzBatch *batch, int curve, size_t lane) {
    const double stroke = batch->lanes->curve[curve].usable[lane];
    return stroke < CZ_MISSING ? stroke : INFINITY;
}

static void name_element(CzElementResult *result, const CzBatch *batch, int design) {
    snprintf(result->name, sizeof result->name, "%s %s", cz_element_text(result->kind),
             cz_car(batch, result->vehicle, design)->name);
}

static void add_account(CzElementResult *result, CzAccount account) {
    result->stored += account.stored;
    result->energy += account.received - account.stored;
}

/* An extreme where it applies, else NaN. */
static double extreme_if(bool applies, const CzBatch *batch, int row, size_t lane) {
    return applies ? cz_extreme(batch, row, lane) : NAN;
}

/* Absorbers of side A and B of an interface, in the interface's lane. */
typedef struct Absorber {
    CzElementKind kind;
    CzAccount (*account)(const CzBatch *batch, size_t lane, int side);
    int tube_energy[2], stroke[2]; /* of the memory */
    int peak_force;                /* of the extremes */
} Absorber;

static const Absorber coupler = {CZ_ELEMENT_COUPLER, cz_coupler_account,
                                 CZ_MEMORY_PAIR(coupler.side, tube_energy),
                                 CZ_MEMORY_PAIR(coupler.side, tube), CZ_EXTREME(coupler_force)};
static const Absorber anti_climber = {CZ_ELEMENT_ANTI_CLIMBER, cz_anti_climber_account,
                                      CZ_MEMORY_PAIR(face.side, energy),
                                      CZ_MEMORY_PAIR(face.side, stroke), CZ_EXTREME(face_force)};
static const Absorber device_on_plates = {
    CZ_ELEMENT_ANTI_CLIMBER, cz_side_account, CZ_MEMORY_PAIR(side_buffers.side, tube_energy),
    CZ_MEMORY_PAIR(side_buffers.side, tube), CZ_EXTREME(side_force)};
static const Absorber side_buffers = {
    CZ_ELEMENT_SIDE_BUFFERS, cz_side_account, CZ_MEMORY_PAIR(side_buffers.side, tube_energy),
    CZ_MEMORY_PAIR(side_buffers.side, tube), CZ_EXTREME(side_force)};

/* False where the side has no such absorber, for example a bare wall. */
static bool fill_absorber(const CzBatch *batch, const Absorber *absorber, size_t lane, int side,
                          int car, CzElementResult *result) {
    if (!cz_has_element(batch, lane, side, absorber->kind))
        return false;
    result->kind = absorber->kind;
    result->vehicle = car;
    add_account(result, absorber->account(batch, lane, side));
    result->tube_energy = cz_memory(batch, absorber->tube_energy[side], lane);
    result->zone_energy[CZ_ZONE_CRUSH] = result->tube_energy;
    result->stroke = cz_memory(batch, absorber->stroke[side], lane);
    result->peak_force = cz_extreme(batch, absorber->peak_force, lane);
    if (absorber->kind == CZ_ELEMENT_COUPLER) {
        result->stroke += cz_memory(batch, CZ_MEMORY(coupler.side[side].second_tube), lane);
        result->sheared = cz_coupler_is_sheared(batch->dynamics, lane, side);
    }
    return true;
}

/* Fills a superstructure; both sides share one contact, which crushes survival space. */
static bool fill_superstructure(const CzBatch *batch, size_t lane, int car,
                                CzElementResult *result) {
    if (!cz_has_element(batch, lane, 0, CZ_ELEMENT_SUPERSTRUCTURE))
        return false;
    result->kind = CZ_ELEMENT_SUPERSTRUCTURE;
    result->vehicle = car;
    add_account(result, cz_superstructure_account(batch, lane));
    result->tube_energy = result->energy;
    result->zone_energy[CZ_ZONE_SURVIVAL] = fmax(result->energy, 0.0);
    result->stroke = 0.5 * cz_memory(batch, CZ_MEMORY(superstructure.set), lane);
    result->peak_force = cz_extreme(batch, CZ_EXTREME(superstructure_force), lane);
    return true;
}

/* Fills a draw gear; both sides share one link. */
static bool fill_draw_gear(const CzBatch *batch, size_t lane, int car, CzElementResult *result) {
    if (!cz_has_element(batch, lane, 0, CZ_ELEMENT_DRAW_GEAR))
        return false;
    result->kind = CZ_ELEMENT_DRAW_GEAR;
    result->vehicle = car;
    add_account(result, cz_draw_gear_account(batch, lane));
    result->peak_force = cz_extreme(batch, CZ_EXTREME(draw_gear_force), lane);
    return true;
}

/* Energy under the backbone between two shortenings. */
static double area(const CzBatch *batch, int curve, size_t lane, double from, double to) {
    const CzCurveLanes *lanes = &batch->lanes->curve[curve];
    const double stride_to = cz_curve_integral(lanes, lane, to);
    return to > from ? stride_to - cz_curve_integral(lanes, lane, from) : 0.0;
}

/* Splits the plastic energy of a crush zone among the zones of its stages, in proportion to the
 * areas; shortening beyond the last stage is that of survival space. */
static void split_zones(const CzBatch *batch, const CzEnd *end, int curve, size_t lane,
                        double largest, double energy, double zone_energy[3]) {
    double areas[3] = {0.0, 0.0, 0.0}, from = 0.0;
    const double whole = usable(batch, curve, lane);
    if (end->n_stages == 0)
        areas[CZ_ZONE_CRUSH] = area(batch, curve, lane, 0.0, fmin(largest, whole));
    for (int k = 0; k < end->n_stages; ++k) {
        const double to = from + end->stages[k].stroke;
        areas[end->stages[k].zone] += area(batch, curve, lane, from, fmin(to, largest));
        from = to;
    }
    if (isfinite(whole))
        areas[CZ_ZONE_SURVIVAL] += area(batch, curve, lane, whole, largest);
    const double sum = areas[0] + areas[1] + areas[2];
    for (int zone = 0; zone < 3; ++zone)
        zone_energy[zone] = sum > 0.0 ? fmax(energy, 0.0) * areas[zone] / sum : 0.0;
}

bool cz_has_end_mass(const CzBatch *batch, int car, int design, int side) {
    const CzCarEquipment of = batch->car_equipment[cz_lane(batch, car, design)];
    return !of.has_slaved_end[1 - side];
}

/* Whether the end of a car is an element: with its guidance if it has a mass, else with its crush
 * zone. */
static bool has_end(const CzBatch *batch, int car, int design, int side) {
    const CzEnd *end = cz_end_at(batch, car, design, side);
    return end->given &&
           (end->n_stages > 0 || end->curve.given || cz_has_end_mass(batch, car, design, side));
}

/* Share of an end in the bare faces of its interface. */
static double share_of_faces(const CzBatch *batch, int car, int design, int side) {
    const int other = side == 0 ? car + 1 : car - 1;
    return has_end(batch, other, design, 1 - side) ? 0.5 : 1.0;
}

static void add_faces(const CzBatch *batch, size_t lane, double share, CzElementResult *result) {
    const CzAccount faces = cz_bare_faces_account(batch, lane);
    add_account(result, (CzAccount){share * faces.received, share * faces.stored});
}

/* Crush zone of an end with mass, with the guidance and the hinge of the mass. */
static void fill_end_mass(const CzBatch *batch, size_t own, int which, CzElementResult *result) {
    result->kind = CZ_ELEMENT_END;
    add_account(result, cz_crush_account(batch, own, which));
    result->tube_energy = result->energy;
    add_account(result, cz_end_mass_account(batch, own, which));
    result->stroke = cz_memory(batch, CZ_MEMORY(end[which].peak), own);
    result->peak_force = cz_extreme(batch, CZ_EXTREME(end_force[which]), own);
}

/* Crush zone of the end at side A (0) or B (1); `lane` is the interface's, `car` the owner. */
static bool fill_end(const CzBatch *batch, size_t lane, int side, int car, int design,
                     CzElementResult *result) {
    if (!has_end(batch, car, design, side))
        return false;
    if (cz_has_end_mass(batch, car, design, side))
        fill_end_mass(batch, cz_lane(batch, car, design), 1 - side, result);
    else {
        result->kind = CZ_ELEMENT_END;
        add_account(result, cz_massless_account(batch, lane, side));
        result->tube_energy = result->energy;
        result->energy += cz_memory(batch, CZ_MEMORY(face.side[side].massless.damped), lane);
        result->stroke = cz_memory(batch, CZ_MEMORY(face.side[side].massless.peak), lane);
        result->peak_force = cz_extreme(batch, CZ_EXTREME(face_force), lane);
    }
    result->vehicle = car;
    add_faces(batch, lane, share_of_faces(batch, car, design, side), result);
    return true;
}

bool cz_outer_end_fill(const CzBatch *batch, int design, int side, CzElementResult *result) {
    const int car = side == 0 ? batch->n_car - 1 : 0;
    *result = (CzElementResult){0};
    if (!cz_has_end_mass(batch, car, design, side))
        return false;
    fill_end_mass(batch, cz_lane(batch, car, design), 1 - side, result);
    result->vehicle = car;
    name_element(result, batch, design);
    return true;
}

/* Fills the zones of an end after fill_end. */
static void fill_zones(const CzBatch *batch, size_t lane, int side, int design,
                       CzElementResult *result) {
    const int car = result->vehicle;
    const bool slaved = !cz_has_end_mass(batch, car, design, side);
    const int which = side == 0 ? 1 : 0; /* front or rear end of the car */
    split_zones(batch, cz_end_at(batch, car, design, side),
                slaved ? CZ_CURVE(massless[side]) : CZ_CURVE(end[which]),
                slaved ? lane : cz_lane(batch, car, design), result->stroke, result->tube_energy,
                result->zone_energy);
}

/* Friction jaws of a buffer stop. */
static bool fill_slide(const CzBatch *batch, int side, int car, int design,
                       CzElementResult *result) {
    const CzEnd *end = cz_end_at(batch, car, design, side);
    const size_t lane = cz_lane(batch, car, design);
    if (!end->given || !end->slide.given)
        return false;
    result->kind = CZ_ELEMENT_SLIDE;
    result->vehicle = car;
    result->stored = batch->stored[lane].slide;
    result->energy = cz_work(batch, CZ_LEDGER(slide), lane) - result->stored;
    result->tube_energy = result->energy;
    result->stroke = cz_extreme(batch, CZ_EXTREME(slide_travel), lane);
    result->peak_force = cz_extreme(batch, CZ_EXTREME(slide_force), lane);
    return true;
}

/* Elements of one side of an interface; returns how many. */
static int fill_side(const CzBatch *batch, size_t lane, int side, int car, int design,
                     CzElementResult *element) {
    CzElementResult *next = element;
    const bool presses_plates = batch->equipment[lane].side[side].presses_plates;
    memset(element, 0, CZ_MAX_ELEMENTS / 2 * sizeof *element);
    next += fill_absorber(batch, &coupler, lane, side, car, next);
    next += fill_absorber(batch, presses_plates ? &device_on_plates : &anti_climber, lane, side,
                          car, next);
    next += fill_end(batch, lane, side, car, design, next);
    next += fill_absorber(batch, &side_buffers, lane, side, car, next);
    next += fill_superstructure(batch, lane, car, next);
    next += fill_draw_gear(batch, lane, car, next);
    next += fill_slide(batch, side, car, design, next);
    return (int)(next - element);
}

/* Energy of an element that counts for its interface; that of a slide is dissipated in the
 * ground. */
static double energy_at_interface(const CzElementResult *element) {
    return element->kind == CZ_ELEMENT_SLIDE ? 0.0 : element->energy;
}

int cz_interface_elements(const CzBatch *batch, int interface, int design,
                          CzElementResult element[CZ_MAX_ELEMENTS]) {
    const size_t lane = cz_lane(batch, interface, design);
    const int n = fill_side(batch, lane, 0, interface, design, element);
    return n + fill_side(batch, lane, 1, interface + 1, design, &element[n]);
}

double cz_interface_energy(const CzBatch *batch, int interface, int design) {
    CzElementResult element[CZ_MAX_ELEMENTS];
    const int n = cz_interface_elements(batch, interface, design, element);
    double energy = 0.0;
    for (int k = 0; k < n; ++k)
        energy += energy_at_interface(&element[k]);
    return energy;
}

/* Fills the margins of an interface against climbing, with their times. */
static void fill_climbing(const CzBatch *batch, int interface, int design,
                          CzInterfaceResult *result) {
    const size_t lane = cz_lane(batch, interface, design);
    const bool pushed = !isnan(result->min_overlap);
    const CzInterfaceEquipment *of = &batch->equipment[lane];
    result->overlap_time = extreme_if(pushed, batch, CZ_EXTREME(face_overlap_time), lane);
    result->margin_time =
        extreme_if(!isnan(result->vertical_margin), batch, CZ_EXTREME(face_margin_time), lane);
    result->ramp = extreme_if(pushed, batch, CZ_EXTREME(face_ramp), lane);
    result->friction = pushed ? of->friction : NAN;
    result->underframe_rise = extreme_if(of->tilts || (of->has_couplers && !of->couplers_on_ends),
                                         batch, CZ_EXTREME(underframe_rise), lane);
    for (int side = 0; side < 2; ++side) {
        const double stop = of->side[side].swing_stop;
        result->swing[side] =
            extreme_if(of->has_couplers, batch, CZ_EXTREME(swing_vertical[side]), lane);
        result->swing_stop[side] = of->has_couplers && isfinite(stop) ? stop : NAN;
    }
}

void cz_interface_fill(const CzBatch *batch, int interface, int design, CzInterfaceResult *result) {
    const CzModel *model = batch->design[design].model;
    const size_t lane = cz_lane(batch, interface, design);
    snprintf(result->name, sizeof result->name, "%s", model->interface_name[interface]);
    result->peak_force = cz_extreme(batch, CZ_EXTREME(interface_force), lane);
    result->peak_time = cz_extreme(batch, CZ_EXTREME(interface_time), lane);
    result->shortening = cz_extreme(batch, CZ_EXTREME(interface_shortening), lane);
    result->section_force[0] = cz_extreme(batch, CZ_EXTREME(section[1]), lane);
    result->section_force[1] =
        cz_extreme(batch, CZ_EXTREME(section[0]), cz_lane(batch, interface + 1, design));
    const double lost_overlap = cz_extreme(batch, CZ_EXTREME(face_lost_overlap), lane);
    const double lost_margin = cz_extreme(batch, CZ_EXTREME(face_lost_margin), lane);
    const bool can_climb = batch->equipment[lane].can_climb;
    const bool has_ribs = batch->equipment[lane].has_ribs;
    result->min_overlap = can_climb && lost_overlap > CZ_NOT_YET ? -lost_overlap : NAN;
    result->vertical_margin =
        can_climb && has_ribs && lost_margin > CZ_NOT_YET ? -lost_margin : NAN;
    result->vertical_demand = cz_extreme(batch, CZ_EXTREME(face_demand_vertical), lane);
    fill_climbing(batch, interface, design, result);
    result->n_element = 0;
    for (int side = 0; side < 2; ++side) {
        CzElementResult *first = &result->element[result->n_element];
        const int n = fill_side(batch, lane, side, interface + side, design, first);
        cz_devices_judge(batch, interface, design, side, n, first);
        cz_sequence_judge(batch, interface, design, side, n, first);
        for (int k = 0; k < n; ++k) {
            name_element(&first[k], batch, design);
            if (first[k].kind == CZ_ELEMENT_END)
                fill_zones(batch, lane, side, design, &first[k]);
        }
        result->n_element += n;
    }
    for (int k = 0; k < result->n_element; ++k) {
        result->energy += energy_at_interface(&result->element[k]);
        result->bottomed_out |= result->element[k].bottomed_out;
    }
}

/* Shortening of survival space at the end at side A (0) or B (1) of its interface; NaN when the end
 * declares no such zone and was not crushed beyond its stages. */
static double survival_loss(const CzBatch *batch, int car, int design, int side) {
    const CzEnd *end = cz_end_at(batch, car, design, side);
    const int interface = side == 0 ? car : car - 1;
    CzElementResult result = {0};
    if (interface < 0 || interface >= batch->n_car - 1 ||
        !fill_end(batch, cz_lane(batch, interface, design), side, car, design, &result))
        return NAN;
    cz_devices_judge(batch, interface, design, side, 1, &result);
    double from = 0.0, taken = 0.0;
    bool declares = result.bottomed_out;
    for (int k = 0; k < end->n_stages; ++k) {
        const double to = from + end->stages[k].stroke;
        if (end->stages[k].zone == CZ_ZONE_SURVIVAL) {
            declares = true;
            taken += fmax(fmin(result.stroke, to) - from, 0.0);
        }
        from = to;
    }
    if (result.bottomed_out)
        taken += result.stroke - result.stroke / result.stroke_used;
    return declares ? taken : NAN;
}

/* The losses at both ends and their sum; NaN when neither end has one. */
static void fill_survival(const CzBatch *batch, int car, int design, CzVehicleResult *result) {
    double *loss = result->survival_loss;
    for (int end = 0; end < 2; ++end)
        loss[end] = survival_loss(batch, car, design, 1 - end);
    result->survival_shortening = isnan(loss[1])   ? loss[0]
                                  : isnan(loss[0]) ? loss[1]
                                                   : loss[1] + loss[0];
}

/* Fills the decelerations, and the results that only a kept pulse has. */
static CzStatus fill_decelerations(const CzPulse *pulse, bool is_kept, CzVehicleResult *result) {
    result->mean_deceleration_contact =
        cz_pulse_contact_mean(pulse, CZ_PULSE_FLOOR, CZ_PULSE_SHORTEST, result->contact_window);
    result->mean_deceleration_120ms =
        cz_pulse_sliding_mean(pulse, CZ_PULSE_WINDOW, result->window_120ms);
    result->peak_deceleration_cfc60 = NAN;
    for (int i = 0; i < CZ_N_FREE_FLIGHT; ++i) {
        double time;
        result->secondary_impact[i] =
            is_kept ? cz_pulse_secondary_impact(pulse, 0.1 * (i + 1), &time) : NAN;
    }
    return is_kept ? cz_pulse_filtered_peak(pulse, CFC, &result->peak_deceleration_cfc60) : CZ_OK;
}

CzStatus cz_vehicle_fill(const CzBatch *batch, int car, int design, CzArena *arena, CzPulse *kept,
                         CzVehicleResult *result) {
    const CzCar *description = cz_car(batch, car, design);
    const size_t lane = cz_lane(batch, car, design);
    snprintf(result->name, sizeof result->name, "%s", description->name);
    result->final_speed = cz_velocity(batch, CZ_DOF(body.x), lane);
    result->peak_deceleration = cz_extreme(batch, CZ_EXTREME(body_acceleration), lane);
    CzArena own = {0};
    CzPulse pulse;
    CzStatus status = CZ_STATUS_NO_MEMORY;
    if (cz_history_pulse(batch, car, design, kept != NULL ? arena : &own, &pulse))
        status = fill_decelerations(&pulse, kept != NULL, result);
    if (kept != NULL && status == CZ_OK)
        status = cz_pulse_list_windows(&pulse, arena) ? CZ_OK : CZ_STATUS_NO_MEMORY;
    if (kept != NULL)
        *kept = pulse;
    cz_arena_free(&own);
    CZ_TRY(status);
    const bool full = description->model == CZ_MODEL_FULL;
    for (int axle = 0; axle < 4; ++axle) {
        result->wheel_lift[axle] = extreme_if(full, batch, CZ_EXTREME(lift[axle]), lane);
        result->wheel_lift_time[axle] = extreme_if(full, batch, CZ_EXTREME(lift_time[axle]), lane);
    }
    const double of_rear = cz_extreme(batch, CZ_EXTREME(bogie_lift[0]), lane);
    const double of_front = cz_extreme(batch, CZ_EXTREME(bogie_lift[1]), lane);
    result->lifted_bogie = of_front > of_rear;
    result->bogie_lift = full ? fmax(of_rear, of_front) : NAN;
    result->bogie_lift_time =
        extreme_if(full, batch, CZ_EXTREME(bogie_lift_time[result->lifted_bogie]), lane);
    result->max_pitch = extreme_if(full, batch, CZ_EXTREME(body_pitch), lane);
    result->link_force = extreme_if(full, batch, CZ_EXTREME(link_force), lane);
    result->link_travel = extreme_if(full, batch, CZ_EXTREME(link_travel), lane);
    result->bogie_acceleration = extreme_if(full, batch, CZ_EXTREME(bogie_acceleration), lane);
    fill_survival(batch, car, design, result);
    result->checks_override = full && description->has_stops;
    return CZ_OK;
}
