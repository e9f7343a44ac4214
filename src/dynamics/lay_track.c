/* Laying the track under the cars at t = 0, and what it holds of energy. */
#include "dynamics/dynamics.h"

/* A wheelset's place and load at rest, and what a car's track deflects under all four. */
typedef struct Standing {
    double place[4], load[4], deflection[4], flexibility[4];
} Standing;

static bool has_wheels(const CzBlock *block, size_t i) {
    return block->parameter.wheel.hertz[i] > 0.0;
}

static Standing standing_of(const CzBlock *block, size_t i) {
    Standing standing;
    for (int axle = 0; axle < 4; ++axle) {
        standing.place[axle] =
            cz_wheel_place(block->parameter.bogie_x[i], block->parameter.axle_x[i], axle);
        standing.load[axle] = block->constant.static_load[axle][i];
    }
    return standing;
}

static bool lay_modes(CzDynamics *dynamics, size_t lane, Standing *standing, CzArena *arena) {
    if (!cz_track_lay(dynamics->track, lane, standing->place, standing->load, arena))
        return false;
    cz_track_look(dynamics->track, lane, standing->place, standing->deflection,
                  standing->flexibility);
    return true;
}

static bool lay_elements(CzDynamics *dynamics, size_t lane, Standing *standing, CzArena *arena) {
    CzElementsPoint point[4];
    if (!cz_elements_lay(dynamics->elements, lane, standing->place, standing->load, arena))
        return false;
    cz_elements_look(dynamics->elements, lane, standing->place, point);
    for (int axle = 0; axle < 4; ++axle) {
        standing->deflection[axle] = point[axle].z;
        standing->flexibility[axle] = point[axle].flexibility;
    }
    return true;
}

static void lay_co_running(CzDynamics *dynamics, size_t lane, Standing *standing) {
    CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    const CzCoRunningStep *track = dynamics->co_running;
    for (int axle = 0; axle < 4; ++axle) {
        const CzComplex y = cz_complex_scaled(-standing->load[axle], track->rest);
        block->rail_mode[axle][0][i] = y.re;
        block->rail_mode[axle][1][i] = y.im;
        standing->deflection[axle] = track->now.re * y.re - track->now.im * y.im;
        standing->flexibility[axle] = track->flexibility;
    }
}

static bool lay_under(CzDynamics *dynamics, size_t lane, CzArena *arena) {
    CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    if (!has_wheels(block, i))
        return true;
    Standing standing = standing_of(block, i);
    if (dynamics->track != NULL && !lay_modes(dynamics, lane, &standing, arena))
        return false;
    if (dynamics->elements != NULL && !lay_elements(dynamics, lane, &standing, arena))
        return false;
    if (dynamics->co_running != NULL)
        lay_co_running(dynamics, lane, &standing);
    for (int axle = 0; axle < 4; ++axle)
        block->constant.wheel_rest[axle][i] = block->parameter.wheel.indentation[axle][i] +
                                              standing.flexibility[axle] * standing.load[axle] -
                                              standing.deflection[axle];
    return true;
}

/* g of a mass on a spring with its pair lambda: g^2 = 1 / (i w m), stored once for the pair. */
static CzCoRunningStep co_running_step(const CzCoRunning *part, double step) {
    const double decay = 0.5 * part->damping / part->mass;
    const double w = sqrt(part->stiffness / part->mass - decay * decay);
    const CzComplex lambda = {-decay, w}, square = {0.0, -1.0 / (w * part->mass)};
    const CzComplex g = cz_complex_root(square);
    const CzComplex back = cz_complex_exponential(cz_complex_scaled(-0.5 * step, lambda));
    const CzComplex answer = cz_track_constant_answer(lambda, step);
    return (CzCoRunningStep){.flight = cz_complex_exponential(cz_complex_scaled(step, lambda)),
                             .kick = cz_complex_product(cz_track_kick(lambda, step), g),
                             .rest = cz_complex_product(answer, g),
                             .now = g,
                             .past = cz_complex_product(back, g),
                             .past_rate = cz_complex_product(lambda, cz_complex_product(back, g)),
                             .flexibility =
                                 1.0 / part->stiffness - cz_complex_product(square, answer).re,
                             .part = *part};
}

static bool make_track(CzDynamics *dynamics, const CzTrackModes *modes, CzTrack kind, double step,
                       CzArena *arena) {
    const size_t n_lane = (size_t)dynamics->n_block * CZ_LANE_BLOCK;
    switch (kind) {
    case CZ_TRACK_MODAL:
        dynamics->track = cz_track_motion_create(modes, step, n_lane, arena);
        return dynamics->track != NULL;
    case CZ_TRACK_FE:
        dynamics->elements =
            cz_elements_create(&modes->seats, modes->nodes, modes->span, step, n_lane, arena);
        return dynamics->elements != NULL;
    case CZ_TRACK_CO_RUNNING: {
        CzCoRunningStep *made = cz_arena_allocate(arena, 1, sizeof *made);
        const CzCoRunning part = cz_co_running(modes);
        if (made != NULL)
            *made = co_running_step(&part, step);
        dynamics->co_running = made;
        return made != NULL;
    }
    case CZ_TRACK_RIGID:
        break;
    }
    return true;
}

bool cz_dynamics_lay_track(CzDynamics *dynamics, const CzTrackModes *modes, CzTrack kind,
                           double step, CzArena *arena) {
    const size_t n_lane = (size_t)dynamics->n_block * CZ_LANE_BLOCK;
    if (!make_track(dynamics, modes, kind, step, arena))
        return false;
    if (kind == CZ_TRACK_RIGID)
        return true;
    for (size_t lane = 0; lane < n_lane; ++lane) {
        if (!lay_under(dynamics, lane, arena))
            return false;
        cz_block_of(dynamics, lane)->rail_rest_energy[lane % CZ_LANE_BLOCK] =
            cz_dynamics_track_energy(dynamics, lane);
    }
    return true;
}

static double co_running_energy(const CzCoRunningStep *track, const CzBlock *block, size_t i) {
    double energy = 0.0;
    for (int axle = 0; axle < 4; ++axle) {
        const CzComplex y = {block->rail_mode[axle][0][i], block->rail_mode[axle][1][i]};
        const double z = cz_complex_product(track->past, y).re;
        const double rate = cz_complex_product(track->past_rate, y).re;
        energy += 0.5 * (track->part.stiffness * z * z + track->part.mass * rate * rate);
    }
    return energy;
}

double cz_dynamics_track_energy(const CzDynamics *dynamics, size_t lane) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    if (!has_wheels(block, lane % CZ_LANE_BLOCK))
        return 0.0;
    if (dynamics->track != NULL)
        return cz_track_energy(dynamics->track, lane);
    if (dynamics->elements != NULL)
        return cz_elements_energy(dynamics->elements, lane);
    if (dynamics->co_running != NULL)
        return co_running_energy(dynamics->co_running, block, lane % CZ_LANE_BLOCK);
    return 0.0;
}

void cz_dynamics_track_rate(CzDynamics *dynamics, size_t lane, double *rate) {
    CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    double force[4], rail_rate[4], power = 0.0;
    for (int axle = 0; axle < 4; ++axle)
        force[axle] = -block->published.wheel[axle].force[i];
    cz_track_rate(dynamics->track, lane, force, rate, rail_rate);
    for (int axle = 0; axle < 4; ++axle)
        power += force[axle] * rail_rate[axle];
    block->power->track[i] += power;
    block->power->wheel_normal[i] -= power;
}
