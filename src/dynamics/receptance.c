/* Sets up and reads the receptance track; its steps are in kernel_track.h. */
#include "dynamics/receptance.h"

#include <string.h>

#include "model/state.h"

/* ---- constants of a step --------------------------------------------------------------------- */

static CzPairStep step_of(const CzPairMode *mode, double step) {
    const CzComplex lambda = mode->lambda, g = mode->g;
    const CzComplex back = cz_complex_exponential(cz_complex_scaled(-0.5 * step, lambda));
    return (CzPairStep){.flight = cz_complex_exponential(cz_complex_scaled(step, lambda)),
                        .kick = cz_complex_product(cz_track_kick(lambda, step), g),
                        .now = g,
                        .past = cz_complex_product(back, g),
                        .rest = cz_complex_product(cz_track_constant_answer(lambda, step), g),
                        .back = back};
}

static void fill_steps(const CzTrackModes *modes, const CzReceptance *receptance, double step,
                       CzReceptanceSteps *steps) {
    steps->receptance = receptance;
    steps->flexibility = cz_receptance_flexibility(modes, receptance, step);
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
        steps->n[motion] = receptance->motion[motion].n;
        for (int k = 0; k < steps->n[motion]; k++)
            steps->mode[motion][k] = step_of(&receptance->motion[motion].mode[k], step);
    }
}

CzReceptanceMotion *cz_receptance_create(const CzTrackModes *modes, double step, int n_block,
                                         CzArena *arena) {
    CzReceptanceMotion *track = cz_arena_allocate(arena, 1, sizeof *track);
    CzReceptanceSteps *steps = cz_arena_allocate(arena, (size_t)modes->n_receptance, sizeof *steps);
    CzReceptanceBlock *block = cz_arena_allocate(arena, (size_t)n_block, sizeof *block);
    if (arena->out_of_memory)
        return NULL;
    for (int i = 0; i < modes->n_receptance; i++)
        fill_steps(modes, &modes->receptance[i], step, &steps[i]);
    *track = (CzReceptanceMotion){.per_spacing = 1.0 / modes->seats.spacing,
                                  .n_steps = modes->n_receptance,
                                  .steps = steps,
                                  .block = block};
    return track;
}

/* ---- one car --------------------------------------------------------------------------------- */

/* States of one motion of a bogie. */
static CzRow *states_of(const CzReceptancePart *part, int bogie, int motion) {
    const int *n = part->steps->n;
    return part->state + 2 * (bogie * (n[0] + n[1]) + (motion == CZ_PAIR_PITCH ? n[0] : 0));
}

static const CzReceptancePart *part_under(const CzReceptanceBlock *block, size_t i) {
    for (int k = 0; k < block->n_part; k++)
        if (block->part[k].is_under[i] != 0.0)
            return &block->part[k];
    return NULL;
}

/* The part of a block for an axle spacing, created when missing. */
static CzReceptancePart *part_for(const CzReceptanceMotion *track, CzReceptanceBlock *block,
                                  double axle_spacing, CzArena *arena) {
    for (int k = 0; k < block->n_part; k++)
        if (block->part[k].steps->receptance->axle_spacing == axle_spacing)
            return &block->part[k];
    int i = 0;
    while (track->steps[i].receptance->axle_spacing != axle_spacing)
        i++;
    if (block->part == NULL)
        block->part = cz_arena_allocate(arena, CZ_LANE_BLOCK, sizeof *block->part);
    if (block->part == NULL)
        return NULL;
    CzReceptancePart *part = &block->part[block->n_part];
    const int *n = track->steps[i].n;
    part->steps = &track->steps[i];
    part->state = cz_arena_allocate(arena, 4 * (size_t)(n[0] + n[1]), sizeof *part->state);
    block->n_part += part->state != NULL;
    return part->state != NULL ? part : NULL;
}

/* Force on each wheel of a bogie in bounce or pitch. */
static double force_of(const double *force, int motion) {
    return 0.5 * (force[0] + (motion == CZ_PAIR_BOUNCE ? force[1] : -force[1]));
}

/* Adds a deflection in bounce or pitch to those of the wheels of a bogie. */
static void add_deflection(double deflection, int motion, double *rear, double *front) {
    *rear += deflection;
    *front += motion == CZ_PAIR_BOUNCE ? deflection : -deflection;
}

/* Deflections of a lane from its states. */
static void read_states(CzReceptanceBlock *block, const CzReceptancePart *part, size_t i) {
    for (int wheel = 0; wheel < 4; wheel++)
        block->z[wheel][i] = block->past[wheel][i] = 0.0;
    for (int bogie = 0; bogie < 2; bogie++)
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
            const CzRow *state = states_of(part, bogie, motion);
            double now = 0.0, past = 0.0;
            for (int k = 0; k < part->steps->n[motion]; k++) {
                const CzPairStep *mode = &part->steps->mode[motion][k];
                const CzComplex y = {state[2 * k][i], state[2 * k + 1][i]};
                now += cz_complex_product(mode->now, y).re;
                past += cz_complex_product(mode->past, y).re;
            }
            CzRow *z = &block->z[2 * bogie], *before = &block->past[2 * bogie];
            add_deflection(now, motion, &z[0][i], &z[1][i]);
            add_deflection(past, motion, &before[0][i], &before[1][i]);
        }
}

bool cz_receptance_lay(CzReceptanceMotion *track, size_t lane, double axle_spacing,
                       const double load[4], CzArena *arena) {
    CzReceptanceBlock *block = &track->block[lane / CZ_LANE_BLOCK];
    const size_t i = lane % CZ_LANE_BLOCK;
    CzReceptancePart *part = part_for(track, block, axle_spacing, arena);
    if (part == NULL)
        return false;
    part->is_under[i] = 1.0;
    for (int bogie = 0; bogie < 2; bogie++)
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
            const double force = -force_of(load + 2 * bogie, motion);
            CzRow *state = states_of(part, bogie, motion);
            for (int k = 0; k < part->steps->n[motion]; k++) {
                const CzComplex y = cz_complex_scaled(force, part->steps->mode[motion][k].rest);
                state[2 * k][i] = y.re;
                state[2 * k + 1][i] = y.im;
            }
        }
    read_states(block, part, i);
    return true;
}

void cz_receptance_look(const CzReceptanceMotion *track, size_t lane, const double place[4],
                        double deflection[4], double flexibility[4]) {
    const CzReceptanceBlock *block = &track->block[lane / CZ_LANE_BLOCK];
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzReceptanceSteps *steps = part_under(block, i)->steps;
    for (int wheel = 0; wheel < 4; wheel++) {
        deflection[wheel] = block->z[wheel][i];
        flexibility[wheel] = cz_track_flexibility_at(
            &steps->flexibility, cz_turned(place[wheel] * track->per_spacing).re);
    }
}

/* Adds the energy that the modes of one motion of a bogie can return, half a step ago, in all lanes
 * of a part. */
static void add_stored(const CzReceptancePart *part, int bogie, int motion, CzRow energy) {
    const CzRow *state = states_of(part, bogie, motion);
    const double *storage = part->steps->receptance->motion[motion].storage;
    const int n = part->steps->n[motion];
    CzRow x[2 * CZ_MOST_PAIR_MODES];
    for (int k = 0; k < n; k++) {
        const CzComplex back = part->steps->mode[motion][k].back;
        for (int i = 0; i < CZ_LANE_BLOCK; i++) {
            const CzComplex now = {state[2 * k][i], state[2 * k + 1][i]};
            const CzComplex past = cz_complex_product(back, now);
            x[2 * k][i] = past.re;
            x[2 * k + 1][i] = past.im;
        }
    }
    for (int k = 0; k < 2 * n; k++) { /* the form is symmetric: half of it, twice */
        CzRow product;
        for (int i = 0; i < CZ_LANE_BLOCK; i++)
            product[i] = 0.5 * storage[2 * n * k + k] * x[k][i];
        for (int j = 0; j < k; j++)
            for (int i = 0; i < CZ_LANE_BLOCK; i++)
                product[i] += storage[2 * n * k + j] * x[j][i];
        for (int i = 0; i < CZ_LANE_BLOCK; i++)
            energy[i] += 4.0 * part->is_under[i] * x[k][i] * product[i]; /* of two wheels */
    }
}

void cz_receptance_energy(const CzReceptanceMotion *track, int block, CzRow energy) {
    const CzReceptanceBlock *under = &track->block[block];
    for (int i = 0; i < CZ_LANE_BLOCK; i++)
        energy[i] = 0.0;
    for (int k = 0; k < under->n_part; k++)
        for (int bogie = 0; bogie < 2; bogie++)
            for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++)
                add_stored(&under->part[k], bogie, motion, energy);
}

/* ---- for a solver of ordinary differential equations ----------------------------------------- */

size_t cz_receptance_n_state(const CzReceptanceMotion *track, size_t lane) {
    const CzReceptancePart *part =
        part_under(&track->block[lane / CZ_LANE_BLOCK], lane % CZ_LANE_BLOCK);
    return part == NULL ? 0 : 4 * (size_t)(part->steps->n[0] + part->steps->n[1]);
}

void cz_receptance_get_state(const CzReceptanceMotion *track, size_t lane, double *state) {
    const size_t i = lane % CZ_LANE_BLOCK, n = cz_receptance_n_state(track, lane);
    const CzReceptancePart *part = part_under(&track->block[lane / CZ_LANE_BLOCK], i);
    for (size_t k = 0; k < n; k++)
        state[k] = part->state[k][i];
}

void cz_receptance_set_state(CzReceptanceMotion *track, size_t lane, const double *state) {
    CzReceptanceBlock *block = &track->block[lane / CZ_LANE_BLOCK];
    const size_t i = lane % CZ_LANE_BLOCK, n = cz_receptance_n_state(track, lane);
    const CzReceptancePart *part = part_under(block, i);
    for (size_t k = 0; k < n; k++)
        part->state[k][i] = state[k];
    read_states(block, part, i);
}

void cz_receptance_rate(const CzReceptanceMotion *track, size_t lane, const double force[4],
                        double *rate, double rail_rate[4]) {
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzReceptancePart *part = part_under(&track->block[lane / CZ_LANE_BLOCK], i);
    memset(rail_rate, 0, 4 * sizeof *rail_rate);
    for (int bogie = 0; bogie < 2; bogie++)
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
            const struct CzPairModes *modes = &part->steps->receptance->motion[motion];
            const CzRow *state = states_of(part, bogie, motion);
            const double own = force_of(force + 2 * bogie, motion);
            double deflection = 0.0;
            for (int k = 0; k < modes->n; k++, rate += 2) {
                const CzComplex y = {state[2 * k][i], state[2 * k + 1][i]}, g = modes->mode[k].g;
                const CzComplex change = cz_complex_sum(
                    cz_complex_product(modes->mode[k].lambda, y), cz_complex_scaled(own, g));
                rate[0] = change.re;
                rate[1] = change.im;
                deflection += cz_complex_product(g, change).re;
            }
            add_deflection(deflection, motion, &rail_rate[2 * bogie], &rail_rate[2 * bogie + 1]);
        }
}
