/* Conditions on the energies of a run, examined while it runs.
 *
 *   sums      elements, running gear, wheels, brakes and track add up to the ledger
 *   passive   no element has returned more than it received or stores less than 0
 *   springs   the work on the springs of the running gear is the energy that they store
 *   agreed    the work of the bodies on the chains of an interface, or on a crush zone, is the
 *             energy that these received: the integral of the force over the closure
 *
 * What an element has received is the mean force of each step times its stroke, or the mean power
 * times the step. In a step that passes a corner of a law the error is up to 1/2 of the rise of the
 * force times the stroke of the step at first touch, and 1/8 of it at a later corner; if that
 * stroke is a share s of the total, it is s^2 / 4 of the energy. An element may seem to return
 *
 *   CORNERS * energy + (preload + transition * v h) * v h        v: closing speed of the trains
 *
 * the second term for buffers, which reach their preload within a step: four corners at a hundredth
 * of the stroke, a first touch and four more corners. For superstructures, which may reach their
 * strength within a step, the strength is in place of preload and transition. A bottomed-out
 * element may seem to return STOP times its largest force times its largest stroke, the error of a
 * step of h = 0.1 ms at a stop of k = 1 GN/m and an end mass of m = 1 t: h^2 k / (12 m). Crush
 * zones, guidances and tubes have no such error: their energy follows from their state, or they
 * crush under a force that is never negative.
 */
#include "simulate/devices.h"
#include "simulate/run.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#define SUM_SHARE 1e-9 /* of the initial energy: rounding of some hundred thousand sums */
#define CORNERS 1e-4   /* of the energy of an element, as above */
#define STOP 1e-3      /* as above */
/* Of the initial energy: springs of the running gear, whose power is summed over oscillations of up
 * to half the largest stable step; four times the largest of 400 random designs (ours). */
#define SPRINGS_SHARE 1e-5
/* Of the initial energy: as for the energy balance, which is the sum of these differences (ours).
 */
#define AGREED_SHARE 1e-2

/* An inconsistency and its place. */
typedef struct Fault {
    char *where, *what; /* (CZ_FAULT_SIZE) */
} Fault;

/* Records an inconsistency at an element of a vehicle or an interface; returns true. */
__attribute__((format(printf, 4, 5))) static bool
note(const Fault *fault, const char *name, const char *element, const char *format, ...) {
    va_list values;
    snprintf(fault->where, CZ_FAULT_SIZE, "%s %s", name, element);
    va_start(values, format);
    vsnprintf(fault->what, CZ_FAULT_SIZE, format, values);
    va_end(values);
    return true;
}

/* Energy that an element of side A (0) or B (1) of an interface may seem to return because of
 * corners passed within a step. */
static double apparent_return(const CzBatch *batch, const CzElementResult *element, int interface,
                              int design, int side) {
    const size_t lane = cz_lane(batch, interface, design);
    const double corners = CORNERS * fmax(element->energy + element->stored, 0.0);
    const double stroke = fabs(batch->design[design].closing_speed) * batch->step;
    if (element->kind == CZ_ELEMENT_COUPLER)
        return corners + cz_coupler_touch(batch->dynamics, lane, side, stroke);
    if (element->kind == CZ_ELEMENT_SIDE_BUFFERS)
        return corners + cz_side_touch(batch->dynamics, lane, side, stroke);
    if (element->kind == CZ_ELEMENT_SUPERSTRUCTURE)
        return corners + 0.5 * cz_superstructure_touch(batch->dynamics, lane, stroke);
    return corners;
}

/* The same for an element that has bottomed out. */
static double apparent_return_at_stop(const CzBatch *batch, CzElementResult *element, int interface,
                                      int design, int side) {
    cz_devices_judge(batch, interface, design, side, 1, element);
    return element->bottomed_out ? STOP * element->peak_force * element->stroke : 0.0;
}

/* Whether an element has returned more than it received, beyond what is allowed, or stores less
 * than 0. */
static bool creates_energy(const char *vehicle, const CzElementResult *element, double allowed,
                           double rounding, const Fault *fault) {
    const bool has_returned = !(element->energy >= -allowed - rounding); /* true for NaN */
    if (!has_returned && element->stored >= -rounding)
        return false;
    return has_returned ? note(fault, vehicle, cz_element_text(element->kind),
                               "returned %.4g kJ more than it received", -1e-3 * element->energy)
                        : note(fault, vehicle, cz_element_text(element->kind),
                               "stores a negative energy of %.4g kJ", 1e-3 * element->stored);
}

/* Adds up the elements of all interfaces and outer ends; returns whether one of them creates
 * energy. */
static bool some_element_creates_energy(const CzBatch *batch, int design, double rounding,
                                        double *sum, const Fault *fault) {
    CzElementResult element[CZ_MAX_ELEMENTS];
    bool found = false;
    for (int i = 0; i + 1 < batch->n_car; ++i) {
        const int n = cz_interface_elements(batch, i, design, element);
        for (int k = 0; k < n; ++k) {
            const int side = element[k].vehicle - i;
            double allowed = apparent_return(batch, &element[k], i, design, side);
            if (element[k].energy < -allowed - rounding)
                allowed =
                    fmax(allowed, apparent_return_at_stop(batch, &element[k], i, design, side));
            *sum += element[k].energy;
            found = found || creates_energy(cz_car(batch, element[k].vehicle, design)->name,
                                            &element[k], allowed, rounding, fault);
        }
    }
    for (int side = 0; side < 2; ++side)
        if (cz_outer_end_fill(batch, design, side, element)) {
            *sum += element[0].energy;
            found = found || creates_energy(cz_car(batch, element->vehicle, design)->name, element,
                                            0.0, rounding, fault);
        }
    return found;
}

/* Compares the work on springs of the running gear with their potential energy. */
static bool running_gear_creates_energy(const CzBatch *batch, int design, double allowed,
                                        const Fault *fault) {
    static const struct {
        const char *what;
        int row;
        size_t stored; /* of CzStored */
    } springs[] = {{"secondary suspension", CZ_LEDGER(secondary), offsetof(CzStored, secondary)},
                   {"primary suspension", CZ_LEDGER(primary), offsetof(CzStored, primary)},
                   {"traction links", CZ_LEDGER(link), offsetof(CzStored, link)},
                   {"axle guidance", CZ_LEDGER(axle_guidance), offsetof(CzStored, axle_guidance)}};
    for (int car = 0; car < batch->n_car; ++car) {
        if (cz_car(batch, car, design)->model != CZ_MODEL_FULL)
            continue;
        const size_t lane = cz_lane(batch, car, design);
        for (size_t k = 0; k < sizeof springs / sizeof springs[0]; ++k) {
            const double stored =
                *(const double *)((const char *)&batch->stored[lane] + springs[k].stored);
            const double given = stored - cz_work(batch, springs[k].row, lane);
            if (!(given <= allowed))
                return note(fault, cz_car(batch, car, design)->name, springs[k].what,
                            "returned %.4g kJ more than it received", 1e-3 * given);
        }
    }
    return false;
}

/* Whether the work of the bodies on an element differs from what it received. */
static bool differs(const char *name, const char *kind, double given, double received,
                    double allowed, const Fault *fault) {
    return !(fabs(given - received) <= allowed) &&
           note(fault, name, kind, "received %.4g kJ, but the work of its force is %.4g kJ",
                1e-3 * received, 1e-3 * given);
}

static bool bodies_differ(const CzBatch *batch, int design, double allowed, const Fault *fault) {
    const CzModel *model = batch->design[design].model;
    for (int car = 0; car < model->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        const double given = cz_work(batch, CZ_LEDGER(coupler), lane) +
                             cz_work(batch, CZ_LEDGER(face), lane) +
                             cz_work(batch, CZ_LEDGER(side_buffers), lane) +
                             cz_work(batch, CZ_LEDGER(draw_gear), lane);
        if (car + 1 < model->n_car &&
            differs(model->interface_name[car], "chains", given,
                    cz_chains_account(batch, lane).received, allowed, fault))
            return true;
        for (int end = 0; end < 2; ++end)
            if (differs(model->car[car].name, end == 0 ? "rear end" : "front end",
                        cz_work(batch, CZ_LEDGER(end[end]), lane),
                        cz_crush_account(batch, lane, end).received, allowed, fault))
                return true;
    }
    return false;
}

/* Energy that an elastic track may release when wheels come to rest between two seats instead of
 * over one: half the square of a load times the difference of the flexibilities. */
static double released_by_track(const CzBatch *batch, int design) {
    const CzTrackModes *track = batch->design[design].model->track;
    if (track == NULL)
        return 0.0;
    const double softer = cz_ring_flexibility(&track->seats, track->n_seat, 0.5) -
                          cz_ring_flexibility(&track->seats, track->n_seat, 0.0);
    double released = 0.0;
    for (int car = 0; car < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design), i = lane % CZ_LANE_BLOCK;
        for (int axle = 0; axle < 4; ++axle) {
            const double load = cz_block_of(batch->dynamics, lane)->constant.static_load[axle][i];
            released += 0.5 * load * load * softer;
        }
    }
    return released;
}

bool cz_energy_checks_fail(const CzBatch *batch, int design, char *where, char *what) {
    const CzEnergy energy = cz_energy_fill(batch, design);
    const double rounding = SUM_SHARE * energy.initial;
    const double open = batch->design[design].balance + rounding;
    const Fault fault = {where, what};
    double sum = 0.0;
    if (some_element_creates_energy(batch, design, rounding, &sum, &fault) ||
        running_gear_creates_energy(batch, design, SPRINGS_SHARE * energy.initial, &fault) ||
        bodies_differ(batch, design, AGREED_SHARE * energy.initial, &fault))
        return true;
    if (!(fabs(sum - energy.absorbers) <= rounding))
        return note(&fault, "sum of", "elements",
                    "differs from the ledger by %.4g J, an internal error", sum - energy.absorbers);
    const double available = energy.initial - energy.moving_load;
    return !(energy.dissipated <= available + open ||
             energy.dissipated <= available + open + released_by_track(batch, design)) &&
           note(&fault, "all", "elements", "dissipated %.4g kJ, more than the available %.4g kJ",
                1e-3 * energy.dissipated, 1e-3 * available);
}
