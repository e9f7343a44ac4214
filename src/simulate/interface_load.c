/* Forces and energies of interfaces that can still change the motion, so that a run is not over.
 *
 *   held      both cars have stood within STILL_PLACE for STILL_TIME: brakes or a wall carry the
 *             force, which stays as it is. Cars that move on with a constant closure are not held:
 *             a buffer stop that slides, or brakes, still take their energy
 *   force     of an interface that can open and is not held
 *   energy    elastic, of an interface that can open and is not held; of undamaged couplers with
 *             the kinetic energy mu v^2 / 2 of their oscillation
 *
 * Undamaged couplers cannot open. The energy that they store oscillates until it is dissipated;
 * without dissipation only the first unloading can lead to new results.
 */
#include "simulate/run.h"

#include <math.h>

#define SMALLEST_FORCE 1.0 /* [N]: rounding of a chain's balance and no more (ours) */
#define STILL_PLACE 1e-4   /* [m] (ours) */
#define STILL_TIME 0.2 /* in this time a force of 100 N moves 20 t by more than that [s] (ours) */
#define CLOSURE_GROWS 1e-6 /* [m] (ours) */
#define CYCLE_TIME                                                                                 \
    1.0 /* oscillation of heavy wagons on soft draw gear, which dissipate under compression [s]    \
           (ours) */

struct CzInterfaceLoad {
    double place;        /* about which the car behind is at rest [m] */
    double still_since;  /* [s] */
    double largest;      /* closure [m] */
    bool to_be_unloaded; /* it has not returned its energy since then */
};

CzInterfaceLoad *cz_interface_loads_begin(const CzBatch *batch, CzArena *arena) {
    const size_t n = (size_t)batch->n_car * (size_t)batch->n_design;
    return cz_arena_allocate(arena, n, sizeof(CzInterfaceLoad));
}

void cz_interface_load_move(CzBatch *batch, size_t lane, const CzBatch *from, size_t from_lane) {
    batch->load[lane] = from->load[from_lane];
}

bool cz_interface_can_open(const CzBatch *batch, int interface, int design) {
    const size_t lane = cz_lane(batch, interface, design);
    bool whole = batch->equipment[lane].is_coupled;
    for (int side = 0; side < 2; ++side)
        whole &= !cz_coupler_is_sheared(batch->dynamics, lane, side);
    return !whole;
}

/* Whether the car has not moved for long enough. */
static bool is_at_rest(const CzBatch *batch, int car, int design) {
    const size_t lane = cz_lane(batch, car, design);
    const double place = cz_position(batch, CZ_DOF(body.x), lane);
    CzInterfaceLoad *load = &batch->load[lane];
    if (fabs(place - load->place) > STILL_PLACE) {
        load->place = place;
        load->still_since = batch->time;
    }
    return batch->time - load->still_since >= STILL_TIME;
}

/* Whether the first unloading has not occurred yet. */
static bool is_to_be_unloaded(CzInterfaceLoad *load, double largest, bool stores) {
    if (largest > load->largest + CLOSURE_GROWS) {
        load->largest = largest;
        load->to_be_unloaded = true;
    }
    load->to_be_unloaded &= stores;
    return load->to_be_unloaded;
}

/* Kinetic energy of two cars relative to their common motion. */
static double relative_energy(const CzBatch *batch, int interface, int design) {
    const size_t lane = cz_lane(batch, interface, design);
    const double inverse = batch->car_equipment[lane].inverse_mass +
                           batch->car_equipment[cz_lane(batch, interface + 1, design)].inverse_mass;
    const double rate = cz_closing_speed(batch, interface, design);
    return inverse > 0.0 ? 0.5 * rate * rate / inverse : 0.0;
}

/* Whether the trains have dissipated energy within CYCLE_TIME, more than the share that counts. */
static bool still_dissipates(const CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    const double lost = cz_dissipated_above_track(batch, design);
    if (fabs(lost - progress->dissipated) > CZ_STORED_SHARE * progress->initial_energy) {
        progress->dissipated = lost;
        progress->dissipated_at = batch->time;
    }
    return batch->time - progress->dissipated_at < CYCLE_TIME;
}

CzLoadLeft cz_interface_loads_update(const CzBatch *batch, int design) {
    const double least = CZ_STORED_SHARE * batch->design[design].initial_energy;
    CzLoadLeft left = {.force = false};
    double stored = 0.0; /* largest elastic energy of an interface */
    double oscillating = 0.0;
    bool rests = is_at_rest(batch, 0, design);
    for (int interface = 0; interface + 1 < batch->n_car; ++interface) {
        const size_t lane = cz_lane(batch, interface, design);
        const bool rests_behind = rests;
        rests = is_at_rest(batch, interface + 1, design);
        const double largest = cz_extreme(batch, CZ_EXTREME(interface_shortening), lane);
        const double force = cz_published(batch, CZ_PUBLISHED(interface.force), lane);
        const double energy = cz_interface_stored(batch, interface, design);
        const bool opens = cz_interface_can_open(batch, interface, design);
        const bool unloads = is_to_be_unloaded(&batch->load[lane], largest, energy > least);
        if (rests_behind && rests)
            continue;
        left.force |= opens && fabs(force) > SMALLEST_FORCE;
        stored = fmax(stored, opens || unloads ? energy : 0.0);
        if (!opens)
            oscillating = fmax(oscillating, energy + relative_energy(batch, interface, design));
    }
    if (oscillating > fmax(least, stored) && still_dissipates(batch, design))
        stored = oscillating;
    left.stores = !(stored <= least); /* also for NaN */
    return left;
}
