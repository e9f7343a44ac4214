/* Lays the track under the cars at t = 0. */
#include "dynamics/dynamics.h"

/* Place and load of each wheelset of a car at rest, and the deflection of the track under all
 * four. */
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
    cz_track_deflection(dynamics->track, lane, standing->place, standing->deflection,
                        standing->flexibility);
    return true;
}

static bool lay_elements(CzDynamics *dynamics, size_t lane, Standing *standing, CzArena *arena) {
    CzRailPoint point[4];
    if (!cz_elements_lay(dynamics->elements, lane, standing->place, standing->load, arena))
        return false;
    cz_elements_deflection(dynamics->elements, lane, standing->place, point);
    for (int axle = 0; axle < 4; ++axle) {
        standing->deflection[axle] = point[axle].z;
        standing->flexibility[axle] = point[axle].flexibility;
    }
    return true;
}

static void lay_receptance(CzDynamics *dynamics, size_t lane, const CzTrackModes *modes,
                           Standing *standing) {
    const CzBlock *block = cz_block_of(dynamics, lane);
    const double axle_spacing = 2.0 * block->parameter.axle_x[lane % CZ_LANE_BLOCK];
    cz_receptance_lay(dynamics->receptance, lane, modes, axle_spacing, standing->load);
    cz_receptance_deflection(dynamics->receptance, lane, standing->place, standing->deflection,
                             standing->flexibility);
}

static bool lay_under(CzDynamics *dynamics, size_t lane, const CzTrackModes *modes,
                      CzArena *arena) {
    CzBlock *block = cz_block_of(dynamics, lane);
    const size_t i = lane % CZ_LANE_BLOCK;
    if (!has_wheels(block, i))
        return true;
    Standing standing = standing_of(block, i);
    if (dynamics->track != NULL && !lay_modes(dynamics, lane, &standing, arena))
        return false;
    if (dynamics->elements != NULL && !lay_elements(dynamics, lane, &standing, arena))
        return false;
    if (dynamics->receptance != NULL)
        lay_receptance(dynamics, lane, modes, &standing);
    for (int axle = 0; axle < 4; ++axle)
        block->constant.wheel_rest[axle][i] = block->parameter.wheel.indentation[axle][i] +
                                              standing.flexibility[axle] * standing.load[axle] -
                                              standing.deflection[axle];
    return true;
}

static bool make_track(CzDynamics *dynamics, const CzTrackModes *const *modes, CzTrack kind,
                       double step, CzArena *arena) {
    const size_t n_lane = (size_t)dynamics->n_block * CZ_LANE_BLOCK;
    switch (kind) {
    case CZ_TRACK_MODAL:
        dynamics->track = cz_track_motion_create(modes[0], step, n_lane, arena);
        return dynamics->track != NULL;
    case CZ_TRACK_FE:
        dynamics->elements = cz_elements_create(&modes[0]->seats, modes[0]->nodes, modes[0]->span,
                                                step, n_lane, arena);
        return dynamics->elements != NULL;
    case CZ_TRACK_RECEPTANCE:
        dynamics->receptance =
            cz_receptance_create(modes, dynamics->lanes->n_design, step, dynamics->n_block, arena);
        return dynamics->receptance != NULL;
    case CZ_TRACK_RIGID:
        break;
    }
    return true;
}

bool cz_dynamics_lay_track(CzDynamics *dynamics, const CzTrackModes *const *modes, CzTrack kind,
                           double step, CzArena *arena) {
    const size_t n_design = (size_t)dynamics->lanes->n_design;
    if (!make_track(dynamics, modes, kind, step, arena))
        return false;
    if (kind == CZ_TRACK_RIGID)
        return true;
    for (size_t lane = 0; lane < n_design * (size_t)dynamics->lanes->n_car; ++lane)
        if (!lay_under(dynamics, lane, modes[lane % n_design], arena))
            return false;
    for (int i = 0; i < dynamics->n_block; ++i)
        cz_kernel("baseline")->track_energy(dynamics, i, dynamics->block[i].rail_rest_energy);
    return true;
}

size_t cz_dynamics_track_n_state(const CzDynamics *dynamics, int block) {
    const CzTrackMotion *track = dynamics->track;
    size_t n = 0;
    if (dynamics->receptance != NULL)
        return cz_receptance_n_state(&dynamics->receptance->block[block]);
    for (size_t i = 0; track != NULL && i < CZ_LANE_BLOCK; ++i)
        if (track->under[(size_t)block * CZ_LANE_BLOCK + i].state != NULL)
            n += cz_track_n_state(track->modes);
    return n;
}

void cz_dynamics_track_get_state(const CzDynamics *dynamics, int block, double *state) {
    const CzTrackMotion *track = dynamics->track;
    if (dynamics->receptance != NULL)
        cz_receptance_get_state(&dynamics->receptance->block[block], state);
    for (size_t i = 0; track != NULL && i < CZ_LANE_BLOCK; ++i) {
        const size_t lane = (size_t)block * CZ_LANE_BLOCK + i;
        if (track->under[lane].state == NULL)
            continue;
        cz_track_get_state(track, lane, state);
        state += cz_track_n_state(track->modes);
    }
}
