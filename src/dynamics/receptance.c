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
    steps->modes = modes;
    steps->receptance = receptance;
    steps->flexibility = cz_receptance_flexibility(modes, receptance, step);
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
        steps->n[motion] = receptance->motion[motion].n;
        for (int k = 0; k < steps->n[motion]; k++)
            steps->mode[motion][k] = step_of(&receptance->motion[motion].mode[k], step);
    }
}

/* Whether a track is among the first n. */
static bool is_among(const CzTrackModes *const *modes, int n, const CzTrackModes *track) {
    for (int i = 0; i < n; i++)
        if (modes[i] == track)
            return true;
    return false;
}

/* Space for as many modes as any of the receptances has. */
static void make_room(const CzReceptanceMotion *track, int n_block, CzArena *arena) {
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
        size_t most = 0;
        for (int i = 0; i < track->n_steps; i++)
            most =
                (size_t)track->steps[i].n[motion] > most ? (size_t)track->steps[i].n[motion] : most;
        for (int i = 0; i < n_block; i++) {
            CzReceptanceBlock *block = &track->block[i];
            block->mode[motion] = cz_arena_allocate(arena, most, sizeof *block->mode[motion]);
            for (int bogie = 0; bogie < 2; bogie++)
                block->state[bogie][motion] =
                    cz_arena_allocate(arena, 2 * most, sizeof *block->state[bogie][motion]);
        }
    }
}

CzReceptanceMotion *cz_receptance_create(const CzTrackModes *const *modes, int n, double step,
                                         int n_block, CzArena *arena) {
    size_t most = 0;
    for (int i = 0; i < n; i++)
        most += (size_t)modes[i]->n_receptance;
    CzReceptanceMotion *track = cz_arena_allocate(arena, 1, sizeof *track);
    CzReceptanceSteps *steps = cz_arena_allocate(arena, most, sizeof *steps);
    CzReceptanceBlock *block = cz_arena_allocate(arena, (size_t)n_block, sizeof *block);
    if (arena->out_of_memory)
        return NULL;
    *track = (CzReceptanceMotion){.steps = steps, .block = block};
    for (int i = 0; i < n; i++)
        for (int k = 0; k < modes[i]->n_receptance && !is_among(modes, i, modes[i]); k++)
            fill_steps(modes[i], &modes[i]->receptance[k], step, &steps[track->n_steps++]);
    make_room(track, n_block, arena);
    return arena->out_of_memory ? NULL : track;
}

/* ---- one car --------------------------------------------------------------------------------- */

static const CzReceptanceSteps *steps_for(const CzReceptanceMotion *track,
                                          const CzTrackModes *modes, double axle_spacing) {
    const CzReceptanceSteps *steps = track->steps;
    while (steps->modes != modes || steps->receptance->axle_spacing != axle_spacing)
        steps++;
    return steps;
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
static void read_states(CzReceptanceBlock *block, size_t i) {
    for (int wheel = 0; wheel < 4; wheel++)
        block->z[wheel][i] = block->past[wheel][i] = 0.0;
    for (int bogie = 0; bogie < 2; bogie++)
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
            const CzRow *state = block->state[bogie][motion];
            double now = 0.0, past = 0.0;
            for (int k = 0; k < block->under[i]->n[motion]; k++) {
                const CzPairStep *mode = &block->under[i]->mode[motion][k];
                const CzComplex y = {state[2 * k][i], state[2 * k + 1][i]};
                now += cz_complex_product(mode->now, y).re;
                past += cz_complex_product(mode->past, y).re;
            }
            CzRow *z = &block->z[2 * bogie], *before = &block->past[2 * bogie];
            add_deflection(now, motion, &z[0][i], &z[1][i]);
            add_deflection(past, motion, &before[0][i], &before[1][i]);
        }
}

/* Copies the numbers of a track to a lane. */
static void put_steps(CzReceptanceBlock *block, size_t i, const CzReceptanceSteps *steps) {
    block->same = block->n_under == 0 || block->same == steps ? steps : NULL;
    block->lane[block->n_under++] = (int)i;
    block->under[i] = steps;
    block->per_spacing[i] = 1.0 / steps->modes->seats.spacing;
    block->corner[i] = steps->flexibility.corner;
    for (int k = 0; k < CZ_TRACK_FLEX_TERMS; k++)
        block->term[k][i] = steps->flexibility.term[k];
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
        const int n = steps->n[motion];
        block->n[motion] = n > block->n[motion] ? n : block->n[motion];
        for (int k = 0; k < n; k++) {
            const CzPairStep *mode = &steps->mode[motion][k];
            CzPairStepRows *rows = &block->mode[motion][k];
            rows->flight_re[i] = mode->flight.re;
            rows->flight_im[i] = mode->flight.im;
            rows->kick_re[i] = mode->kick.re;
            rows->kick_im[i] = mode->kick.im;
            rows->now_re[i] = mode->now.re;
            rows->now_im[i] = mode->now.im;
            rows->past_re[i] = mode->past.re;
            rows->past_im[i] = mode->past.im;
            rows->lambda_re[i] = steps->receptance->motion[motion].mode[k].lambda.re;
            rows->lambda_im[i] = steps->receptance->motion[motion].mode[k].lambda.im;
        }
    }
}

void cz_receptance_lay(CzReceptanceMotion *track, size_t lane, const CzTrackModes *modes,
                       double axle_spacing, const double load[4]) {
    CzReceptanceBlock *block = &track->block[lane / CZ_LANE_BLOCK];
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzReceptanceSteps *steps = steps_for(track, modes, axle_spacing);
    put_steps(block, i, steps);
    for (int bogie = 0; bogie < 2; bogie++)
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
            const double force = -force_of(load + 2 * bogie, motion);
            CzRow *state = block->state[bogie][motion];
            for (int k = 0; k < steps->n[motion]; k++) {
                const CzComplex y = cz_complex_scaled(force, steps->mode[motion][k].rest);
                state[2 * k][i] = y.re;
                state[2 * k + 1][i] = y.im;
            }
        }
    read_states(block, i);
}

void cz_receptance_move(CzReceptanceMotion *track, size_t lane, const CzReceptanceMotion *from,
                        size_t from_lane) {
    CzReceptanceBlock *to = &track->block[lane / CZ_LANE_BLOCK];
    const CzReceptanceBlock *old = &from->block[from_lane / CZ_LANE_BLOCK];
    const size_t i = lane % CZ_LANE_BLOCK, k = from_lane % CZ_LANE_BLOCK;
    for (int bogie = 0; bogie < 2 && to->under[i] != NULL; bogie++)
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++)
            cz_copy_lane(to->state[bogie][motion], i, old->state[bogie][motion], k,
                         2 * (size_t)to->under[i]->n[motion] * sizeof(CzRow));
    cz_copy_lane(to->z, i, old->z, k, sizeof to->z);
    cz_copy_lane(to->past, i, old->past, k, sizeof to->past);
}

void cz_receptance_deflection(const CzReceptanceMotion *track, size_t lane, const double place[4],
                              double deflection[4], double flexibility[4]) {
    const CzReceptanceBlock *block = &track->block[lane / CZ_LANE_BLOCK];
    const size_t i = lane % CZ_LANE_BLOCK;
    for (int wheel = 0; wheel < 4; wheel++) {
        deflection[wheel] = block->z[wheel][i];
        flexibility[wheel] = cz_track_flexibility_at(
            &block->under[i]->flexibility, cz_turned(place[wheel] * block->per_spacing[i]).re);
    }
}

/* ---- for a solver of ordinary differential equations ----------------------------------------- */

size_t cz_receptance_n_state(const CzReceptanceBlock *block) {
    return 4 * (size_t)((block->n[0] + block->n[1]) * block->n_under);
}

void cz_receptance_get_state(const CzReceptanceBlock *block, double *state) {
    for (int bogie = 0; bogie < 2; bogie++)
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++)
            for (int k = 0; k < 2 * block->n[motion]; k++)
                for (int j = 0; j < block->n_under; j++)
                    *state++ = block->state[bogie][motion][k][block->lane[j]];
}
