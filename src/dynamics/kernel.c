/* The force evaluation and the commit of a step, compiled once per instruction set.
 *
 * An evaluation is a sequence of passes over blocks of lanes: rotations, couplers, anti-climbers,
 * side buffers, crush zones, running gear, and the division by the masses. Each pass gathers rows,
 * calls laws and scatters forces; the passes exchange rows only. No allocation, no library call, no
 * branch on data: every lane does the same arithmetic, and a lane's bits do not depend on the
 * values of the others or on the width of a register.
 */
#include "dynamics/dynamics.h"

#include "dynamics/kernel_coupler.h"
#include "dynamics/kernel_drag.h"
#include "dynamics/kernel_draw_gear.h"
#include "dynamics/kernel_end.h"
#include "dynamics/kernel_extremes.h"
#include "dynamics/kernel_face.h"
#include "dynamics/kernel_gear.h"
#include "dynamics/kernel_neighbours.h"
#include "dynamics/kernel_side_buffers.h"
#include "dynamics/kernel_superstructure.h"
#include "dynamics/kernel_track.h"
#include "dynamics/kernel_track_energy.h"
#include "dynamics/kernel_track_rate.h"
#include "dynamics/kernel_wheel.h"
#include "integrate/two_step.h"

#ifndef CZ_ISA
#define CZ_ISA baseline
#endif
#define PASTE(a, b) a##b
#define KERNEL_NAME(isa) PASTE(cz_kernel_, isa)
#define TEXT(a) #a
#define ISA_TEXT(isa) TEXT(isa)

extern const CzKernel KERNEL_NAME(CZ_ISA);

/* Sets to zero the rows to which the passes add. */
static void clear(const CzDynamics *dynamics, CzBlock *d) {
    clear_rows(&d->force, dynamics->n_state * sizeof(double));
    clear_rows(d->power, dynamics->n_power * sizeof(double));
    clear_rows(&d->pushed, sizeof d->pushed);
    clear_rows(&d->published.interface, sizeof d->published.interface);
    clear_rows(d->published.section, sizeof d->published.section);
    clear_rows(d->published.adhesion, sizeof d->published.adhesion);
    clear_rows(&d->published.chain, sizeof d->published.chain);
    clear_rows(d->published.coupler.top, sizeof(CzRow));
    clear_rows(d->published.face.top, sizeof(CzRow));
    clear_rows(d->published.side_buffers.top, sizeof(CzRow));
}

static void divide(const double *restrict force, const double *restrict inverse,
                   double *restrict acceleration) {
    CZ_LANES (i) {
        acceleration[i] = force[i] * inverse[i];
    }
}

/* Body and end masses along x: ends without mass move with the body and transfer their force to it.
 * The external force is that on a fixed vehicle and that at the wheels. */
static void divide_along(CzBlock *d) {
    const CzParameters *restrict rows = &d->parameter;
    const CzState *restrict force = &d->force;
    CzState *restrict acceleration = &d->acceleration;
    const double *restrict adhesion = d->published.adhesion;
    double *restrict external = d->impulse.force;
    CZ_LANES (i) {
        const double slaved_rear = rows->slaved_ends[0][i], slaved_front = rows->slaved_ends[1][i];
        const double inverse = rows->inverse.body.mass[i];
        const double rear = force->end[0].x[i], front = force->end[1].x[i];
        const double handed = slaved_rear * rear + slaved_front * front;
        const double total = force->body.x[i] + handed;
        const double a = total * inverse;
        acceleration->body.x[i] = a;
        acceleration->end[0].x[i] =
            slaved_rear * a + (1.0 - slaved_rear) * rear * rows->inverse.end[0].mass[i];
        acceleration->end[1].x[i] =
            slaved_front * a + (1.0 - slaved_front) * front * rows->inverse.end[1].mass[i];
        external[i] = adhesion[i] - (inverse > 0.0 ? 0.0 : total);
    }
}

/* Vertical acceleration of a body or an end mass; those of rigid cars move along the track only. */
static void divide_up(const double *restrict rises, const double *restrict force,
                      const double *restrict inverse, double *restrict acceleration) {
    CZ_LANES (i) {
        acceleration[i] = rises[i] * force[i] * inverse[i];
    }
}

/* Accelerations that only a car with running gear has. */
static void divide_full(CzBlock *d) {
    const CzState *force = &d->force;
    CzState *a = &d->acceleration;
    const CzParameters *rows = &d->parameter;
    divide_up(rows->rises, force->body.z, rows->inverse.body.mass, a->body.z);
    divide(force->body.pitch, rows->inverse.body.inertia_pitch, a->body.pitch);
    for (int k = 0; k < 2; ++k) {
        divide_up(rows->rises, force->end[k].z, rows->inverse.end[k].mass, a->end[k].z);
        divide(force->end[k].pitch, rows->inverse.end[k].inertia_pitch, a->end[k].pitch);
        divide(force->bogie[k].x, rows->inverse.bogie.mass, a->bogie[k].x);
        divide(force->bogie[k].z, rows->inverse.bogie.mass, a->bogie[k].z);
        divide(force->bogie[k].pitch, rows->inverse.bogie.inertia_pitch, a->bogie[k].pitch);
    }
    for (int axle = 0; axle < 4; ++axle) {
        divide(force->wheelset[axle].x, rows->inverse.wheelset.mass, a->wheelset[axle].x);
        divide(force->wheelset[axle].z, rows->inverse.wheelset.mass, a->wheelset[axle].z);
        divide(force->wheelset[axle].spin, rows->inverse.wheelset.inertia_pitch,
               a->wheelset[axle].spin);
    }
}

/* Evaluates the interfaces of a block. */
static void evaluate_interfaces(const CzDynamics *dynamics, int index, double step) {
    const CzLanes *lanes = dynamics->lanes;
    CzBlock *d = &dynamics->block[index];
    Normal of_ends;
    if (lanes->has.couplers)
        couplers(d, step);
    line_up_normal(d, end_at(d, 0), end_at(d, 1), &of_ends);
    faces(dynamics, index, &of_ends, step);
    if (lanes->has.side_buffers)
        side_buffers(d, &of_ends, step);
    if (lanes->has.superstructures)
        superstructures(d, &of_ends);
    if (lanes->has.draw_gears)
        draw_gears(d);
}

/* Evaluates the bogies of a block for a budget. */
static void note_bogies(CzBlock *d, double step) {
    OfBogies of = {0};
    for (int bogie = 0; bogie < 2; ++bogie) {
        const CzPlane before = d->force.body;
        bogie_to_body(d, bogie);
        note_bogie(d, bogie, &before, &of);
    }
    add_bogies(d->budget, &of, step);
}

/* Evaluates the cars of a block, whose rails have been read. */
static void evaluate_cars(const CzDynamics *dynamics, int index, double step) {
    CzBlock *d = &dynamics->block[index];
    for (int end = 0; end < 2; ++end)
        vehicle_end(d, end, step);
    if (d->budget != NULL)
        note_bogies(d, step);
    else
        for (int bogie = 0; bogie < 2; ++bogie)
            bogie_to_body(d, bogie);
    for (int axle = 0; axle < 4; ++axle)
        axle_to_bogie(d, axle);
    const bool elastic = is_elastic(dynamics);
    for (int axle = 0; axle < 4; ++axle) {
        if (elastic)
            press_on_elastic(d, axle);
        else
            press_on_rigid(d, axle);
        wheel(d, axle, step);
        if (dynamics->lanes->has.rolling)
            roll(d, axle);
    }
}

/* Evaluations of a block before its interfaces. */
static void begin_block(const CzDynamics *dynamics, CzBlock *d) {
    clear(dynamics, d);
    if (dynamics->lanes->has.full_cars)
        rotations(d);
}

/* Evaluations of a block after its interfaces. */
static void end_block(const CzDynamics *dynamics, int index, double step) {
    CzBlock *d = &dynamics->block[index];
    take_over(dynamics, index);
    if (dynamics->lanes->has.full_cars)
        evaluate_cars(dynamics, index, step);
    push_bodies(&d->force.body, &d->from_behind);
    if (dynamics->lanes->has.drag)
        drag(d);
    divide_along(d);
    if (dynamics->lanes->has.full_cars)
        divide_full(d);
}

static void all_interfaces(const CzDynamics *dynamics, double step) {
    for (int i = 0; i < dynamics->n_block; ++i) {
        look_ahead(dynamics, i);
        evaluate_interfaces(dynamics, i, step);
    }
}

static void evaluate(CzDynamics *dynamics, double step) {
    for (int i = 0; i < dynamics->n_block; ++i) {
        look_at_rails(dynamics, i);
        begin_block(dynamics, &dynamics->block[i]);
    }
    all_interfaces(dynamics, step);
    for (int i = 0; i < dynamics->n_block; ++i)
        end_block(dynamics, i, step);
}

static void commit(CzDynamics *dynamics, double step, double time) {
    for (int i = 0; i < dynamics->n_block; ++i)
        commit_block(dynamics, &dynamics->block[i], step, time);
}

/* Cars without running gear move along the track only. */
static void advance_along(CzBlock *d, double step, int first) {
    static const int along[] = {CZ_DOF(body.x), CZ_DOF(end[0].x), CZ_DOF(end[1].x)};
    for (int k = 0; k < 3; ++k)
        cz_two_step_advance(CZ_LANE_BLOCK, step, first, cz_row_of(&d->position, along[k]),
                            cz_row_of(&d->velocity, along[k]),
                            cz_const_row_of(&d->acceleration, along[k]),
                            cz_row_of(&d->last_acceleration, along[k]));
}

/* State and impulse are each one piece of rows. */
static void advance_block(const CzDynamics *dynamics, int index, double step, int first) {
    CzBlock *d = &dynamics->block[index];
    if (dynamics->lanes->has.full_cars)
        cz_two_step_advance(dynamics->n_state, step, first, d->position.body.x, d->velocity.body.x,
                            d->acceleration.body.x, d->last_acceleration.body.x);
    else
        advance_along(d, step, first);
    cz_two_step_advance(CZ_LANE_BLOCK, step, first, d->impulse.position, d->impulse.velocity,
                        d->impulse.force, d->impulse.last_force);
}

static void advance(CzDynamics *dynamics, double step, int first) {
    for (int i = 0; i < dynamics->n_block; ++i) {
        advance_block(dynamics, i, step, first);
        advance_rails(dynamics, i);
    }
}

/* Advances, evaluates and commits each block while it is in the cache. */
static void whole_step(CzDynamics *dynamics, double step, int first, double time) {
    for (int i = 0; i < dynamics->n_block; ++i) {
        advance_block(dynamics, i, step, first);
        move_rails(dynamics, i);
        begin_block(dynamics, &dynamics->block[i]);
    }
    all_interfaces(dynamics, step);
    for (int i = 0; i < dynamics->n_block; ++i) {
        end_block(dynamics, i, step);
        commit_block(dynamics, &dynamics->block[i], step, time);
    }
}

const CzKernel KERNEL_NAME(CZ_ISA) = {ISA_TEXT(CZ_ISA), advance,    evaluate,    commit,
                                      whole_step,       set_tracks, rate_tracks, track_energy};
