/* Lays the designs of a batch in lanes, and takes those that are over out of them.
 *
 * A design that is over would be computed on with its neighbours. So the others move together where
 * they then need fewer blocks: what they have reached is copied lane by lane. The tracks `modal`
 * and `fe` are computed car by car, and their designs stay where they are.
 */
#include "simulate/run.h"

#include <string.h>

#include "base/error.h"
#include "simulate/batch.h"

/* Stores the equipment of interfaces and cars, which does not change in a run. */
static void list_equipment(CzBatch *batch, size_t n) {
    for (size_t lane = 0; lane < n; lane++) {
        batch->equipment[lane] = cz_interface_equipment(batch->lanes, lane);
        batch->car_equipment[lane] = cz_car_equipment(batch->lanes, lane);
    }
}

/* Lays the track of each design's model. */
static bool lay_tracks(CzBatch *batch) {
    const CzTrackModes **modes =
        cz_arena_allocate(&batch->laid, (size_t)batch->n_design, sizeof *modes);
    const double step = batch->integrator == CZ_INTEGRATOR_ZHAI ? batch->step : 0.0;
    for (int design = 0; modes != NULL && design < batch->n_design; design++)
        modes[design] = batch->design[design].model->track;
    return modes != NULL &&
           (modes[0] == NULL ||
            cz_dynamics_lay_track(batch->dynamics, modes, batch->track, step, &batch->laid));
}

CzStatus cz_batch_set_up(CzBatch *batch, CzError *error) {
    const size_t n = (size_t)batch->n_car * (size_t)batch->n_design;
    const size_t n_block = batch->lanes->n_lane / CZ_LANE_BLOCK;
    CzArena *arena = &batch->laid;
    batch->stored = cz_arena_allocate(arena, n, sizeof *batch->stored);
    batch->equipment = cz_arena_allocate(arena, n, sizeof *batch->equipment);
    batch->car_equipment = cz_arena_allocate(arena, n, sizeof *batch->car_equipment);
    batch->load = cz_interface_loads_begin(batch, arena);
    if (batch->keeps_pulses)
        batch->sequence = cz_sequence_begin(batch, arena);
    batch->in_track = cz_arena_allocate(arena, n_block, sizeof *batch->in_track);
    batch->dynamics = cz_dynamics_create(batch->lanes, arena);
    if (arena->out_of_memory || batch->dynamics == NULL)
        return cz_no_memory(error, "the designs");
    list_equipment(batch, n);
    return lay_tracks(batch) ? CZ_OK : cz_no_memory(error, "the track");
}

/* Lanes of the designs that are not over; their numbers go to `from`. */
static CzLanes *lanes_of_rest(const CzBatch *batch, int n_left, CzArena *arena, int *from) {
    int n_breakpoint[CZ_N_CURVE], n = 0;
    for (int id = 0; id < CZ_N_CURVE; id++)
        n_breakpoint[id] = batch->lanes->curve[id].n_breakpoint;
    CzLanes *lanes = cz_lanes_create(batch->n_car, n_left, n_breakpoint, arena);
    for (int design = 0; lanes != NULL && design < batch->n_design; design++)
        if (!batch->design[design].over) {
            from[n] = design;
            cz_lanes_copy_design(lanes, n++, batch->lanes, design);
        }
    return lanes;
}

/* Moves a design from the lanes of a batch to those of another one. */
static void move_design(CzBatch *batch, int design, const CzBatch *from, int from_design) {
    for (int car = 0; car < batch->n_car; car++) {
        const size_t lane = cz_lane(batch, car, design);
        const size_t from_lane = cz_lane(from, car, from_design);
        cz_dynamics_move(batch->dynamics, lane, from->dynamics, from_lane);
        batch->stored[lane] = from->stored[from_lane];
        cz_interface_load_move(batch, lane, from, from_lane);
        if (batch->sequence != NULL)
            cz_sequence_move(batch, lane, from, from_lane);
    }
    batch->design[design] = from->design[from_design];
}

CzStatus cz_batch_compact(CzBatch *batch, int n_left, CzError *error) {
    if (cz_simulate_n_block(batch->design[0].model, n_left) == batch->dynamics->n_block ||
        batch->dynamics->track != NULL || batch->dynamics->elements != NULL)
        return CZ_OK;
    CzBatch rest = *batch;
    memset(&rest.laid, 0, sizeof rest.laid);
    int *from = cz_arena_allocate(&rest.laid, (size_t)n_left, sizeof *from);
    rest.lanes = from != NULL ? lanes_of_rest(batch, n_left, &rest.laid, from) : NULL;
    rest.design = cz_arena_allocate(&rest.laid, (size_t)n_left, sizeof *rest.design);
    rest.n_design = n_left;
    CzStatus status = CZ_OK;
    if (rest.lanes == NULL || rest.design == NULL)
        status = cz_no_memory(error, "the designs");
    for (int design = 0; status == CZ_OK && design < n_left; design++)
        rest.design[design] = batch->design[from[design]];
    if (status == CZ_OK)
        status = cz_batch_set_up(&rest, error);
    for (int design = 0; status == CZ_OK && design < n_left; design++)
        move_design(&rest, design, batch, from[design]);
    if (status != CZ_OK) {
        cz_arena_free(&rest.laid);
        return status;
    }
    cz_arena_free(&batch->laid);
    *batch = rest;
    return CZ_OK;
}
