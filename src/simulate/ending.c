/* End of a run: by its end criterion, after its duration, or because it failed.
 *
 * End criterion: no neighbouring cars approach or can meet again faster than CZ_CLOSING_SPEED, no
 * interface that can open carries a force, none stores more than CZ_STORED_SHARE of the initial
 * energy, no plastic element crushes, and every wheel is on the rail, all for one body pitch
 * period. A brief run also ends when nothing has crushed for that long, no cars can meet again at
 * more than MEETING_SHARE of the first closing speed, and no interface stores more than that share.
 */
#include "simulate/run.h"

#include <math.h>
#include <stdio.h>

enum { LOOKS_BETWEEN_ENERGY_CHECKS = 64 }; /* (ours) */

#define MEETING_SHARE 0.4 /* a sixth of the first impact's energy (ours) */
#define ROUNDING 1e-9     /* relative difference of two equal means */
#define CRUSHING 1e-6     /* growth of the plastic strokes that counts as crushing [m] (ours) */
#define LARGEST_IMBALANCE 1e-2 /* of the initial energy */
#define LARGEST_RESIDUAL 1e-6  /* closure that a chain may leave unbalanced [m] (ours) */
#define LARGEST_LAW_ERROR                                                                          \
    1e-2 /* deviation of a member from its law over the largest force: as for the balance, since   \
            an error of the force causes at most the same error of its work */

static const char *const dof_text[CZ_N_DOF] = {
#define CZ_DOF_ENTRY(row, axis, dimension, what) [CZ_DOF(row)] = what,
#include "model/dof.def"
#undef CZ_DOF_ENTRY
};

static const char *const ledger_text[CZ_N_LEDGER] = {
#define CZ_LEDGER_ENTRY(row, class, dimension, doc) [CZ_LEDGER(row)] = doc,
#include "dynamics/ledger.def"
#undef CZ_LEDGER_ENTRY
};

static void end(CzProgressOfDesign *progress, CzEnded ended) {
    progress->ended = ended;
    progress->over = true;
}

static void fail(CzBatch *batch, int design, const char *car, const char *element,
                 const char *what) {
    CzProgressOfDesign *progress = &batch->design[design];
    snprintf(progress->failure, sizeof progress->failure, "%s: %s: %s at %.3f ms", car, element,
             what, 1e3 * batch->time);
    end(progress, CZ_ENDED_INCOMPLETE);
}

/* Whether all numbers of the state are finite; many at once. */
static bool is_finite(const CzDynamics *dynamics) {
    double sum = 0.0;
    for (int block = 0; block < dynamics->n_block; ++block) {
        const double *restrict position = dynamics->block[block].position.body.x,
                               *restrict velocity = dynamics->block[block].velocity.body.x;
#pragma omp simd reduction(+ : sum)
        for (size_t i = 0; i < dynamics->n_state; ++i)
            sum += (position[i] - position[i]) + (velocity[i] - velocity[i]);
    }
    return sum == 0.0;
}

/* Fails the design when a number is not finite; names the first degree of freedom. */
static bool fails_to_be_finite(CzBatch *batch, int design) {
    for (int car = 0; car < batch->n_car; ++car)
        for (int dof = 0; dof < CZ_N_DOF; ++dof) {
            const size_t lane = cz_lane(batch, car, design);
            if (isfinite(cz_velocity(batch, dof, lane)) && isfinite(cz_position(batch, dof, lane)))
                continue;
            fail(batch, design, cz_car(batch, car, design)->name, dof_text[dof],
                 "not a finite number");
            return true;
        }
    return false;
}

/* Fails the design when the energy balance does not close; names the kind of element with the most
 * work. */
static bool fails_to_balance(CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    const double residual = fabs(cz_balance_residual(batch, design));
    progress->balance = fmax(progress->balance, residual);
    if (residual <= LARGEST_IMBALANCE * progress->initial_energy) /* NaN fails too */
        return false;
    int worst_car = 0, worst_row = 0;
    double largest = 0.0;
    for (int car = 0; car < batch->n_car; ++car)
        for (int row = 0; row < CZ_N_LEDGER; ++row) {
            const double work = fabs(cz_work(batch, row, cz_lane(batch, car, design)));
            if (work > largest) {
                largest = work;
                worst_car = car;
                worst_row = row;
            }
        }
    fail(batch, design, cz_car(batch, worst_car, design)->name, ledger_text[worst_row],
         "energy balance lost (most work here)");
    return true;
}

/* Fails the design when its energies are inconsistent; examined at intervals and at the end.
 */
static void check_energies(CzBatch *batch, int design) {
    char where[CZ_FAULT_SIZE], what[CZ_FAULT_SIZE];
    CzProgressOfDesign *progress = &batch->design[design];
    const bool is_time = progress->n_look++ % LOOKS_BETWEEN_ENERGY_CHECKS == 0;
    if ((progress->over || is_time) && cz_energy_checks_fail(batch, design, where, what))
        fail(batch, design, where, "energy", what);
}

/* Fails the design when a series chain was left unbalanced or a member deviates from its law. */
static bool fails_to_solve(CzBatch *batch, int design) {
    for (int car = 0; car + 1 < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        const double open = cz_extreme(batch, CZ_EXTREME(chain_residual), lane);
        const double off = cz_law_error(batch, lane);
        char what[96];
        if (!(open <= LARGEST_RESIDUAL))
            snprintf(what, sizeof what, "the strokes of a chain differ from its closure by %.3g mm",
                     1e3 * open);
        else if (!(off <= LARGEST_LAW_ERROR))
            snprintf(what, sizeof what,
                     "force error of a chain member: %.3g %% of the largest force", 100.0 * off);
        else
            continue;
        fail(batch, design, batch->design[design].model->interface_name[car], "series chain", what);
        return true;
    }
    return false;
}

/* Plastic strokes of the series chains of an interface; those of the coupler come first. */
enum { N_PLASTIC = 6, N_OF_COUPLER = 3 };
static const struct {
    const char *chain;
    int stroke[2]; /* of the memory, both sides */
    int closure;   /* of the extremes */
} plastic[N_PLASTIC] = {
    {"coupler", CZ_MEMORY_PAIR(coupler.side, tube), CZ_EXTREME(coupler_closure)},
    {"coupler", CZ_MEMORY_PAIR(coupler.side, second_tube), CZ_EXTREME(coupler_closure)},
    {"coupler", CZ_MEMORY_PAIR(coupler.side, shear), CZ_EXTREME(coupler_closure)},
    {"anti-climbers", CZ_MEMORY_PAIR(face.side, stroke), CZ_EXTREME(face_closure)},
    {"ends", CZ_MEMORY_PAIR(face.side, massless.peak), CZ_EXTREME(face_closure)},
    {"side buffers", CZ_MEMORY_PAIR(side_buffers.side, tube), CZ_EXTREME(side_closure)}};

/* Fails the design when a device has crushed further than its interface ever closed. */
static bool fails_to_fit(CzBatch *batch, int design) {
    for (int car = 0; car + 1 < batch->n_car; ++car)
        for (int k = 0; k < N_PLASTIC; ++k) {
            const size_t lane = cz_lane(batch, car, design);
            double largest = 0.0;
            for (int side = 0; side < 2; ++side)
                largest = fmax(largest, cz_memory(batch, plastic[k].stroke[side], lane));
            if (largest <=
                fmax(cz_extreme(batch, plastic[k].closure, lane), 0.0) + LARGEST_RESIDUAL)
                continue;
            fail(batch, design, batch->design[design].model->interface_name[car], plastic[k].chain,
                 "a stroke larger than the closure");
            return true;
        }
    return false;
}

/* Whether a coupler of an interface has sheared off, so that it no longer acts as a strut. */
static bool is_released(const CzBatch *batch, size_t lane) {
    return cz_coupler_is_sheared(batch->dynamics, lane, 0) ||
           cz_coupler_is_sheared(batch->dynamics, lane, 1);
}

/* Fails the design when a coupler that acts as a strut has shortened by its length from pivot to
 * face: two pivots at the same place define no line. Cars that have climbed slide over each other,
 * which is beyond the model's validity. */
static bool fails_to_keep_apart(CzBatch *batch, int design) {
    char what[160];
    for (int car = 0; car + 1 < batch->n_car && isnan(batch->design[design].override_time); ++car)
        for (int side = 0; side < 2; ++side) {
            const size_t lane = cz_lane(batch, car, design);
            if (is_released(batch, lane))
                continue;
            const double length = batch->equipment[lane].side[side].strut_length;
            double shortened = cz_memory(batch, CZ_MEMORY(coupler.side[side].buffer.stroke), lane);
            for (int k = 0; k < N_OF_COUPLER; ++k)
                shortened += cz_memory(batch, plastic[k].stroke[side], lane);
            if (shortened < length)
                continue;
            snprintf(what, sizeof what,
                     "shortened by %.0f mm, more than the %.0f mm from its pivot to its face "
                     "(length_m)",
                     1e3 * shortened, 1e3 * length);
            fail(batch, design, cz_car(batch, car + side, design)->name, "coupler", what);
            return true;
        }
    return false;
}

/* Sum of all plastic strokes and the travel of a buffer stop: it grows while anything crushes. */
static double plastic_strokes(const CzBatch *batch, int design) {
    double sum = 0.0;
    for (int car = 0; car < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        for (int k = 0; k < 2 * N_PLASTIC; ++k)
            sum += cz_memory(batch, plastic[k / 2].stroke[k % 2], lane);
        for (int end = 0; end < 2; ++end)
            sum += cz_memory(batch, CZ_MEMORY(end[end].peak), lane);
        sum += cz_memory(batch, CZ_MEMORY(superstructure.set), lane);
        if (batch->car_equipment[lane].slide_length < CZ_NEVER)
            sum += cz_extreme(batch, CZ_EXTREME(slide_travel), lane);
    }
    return sum;
}

/* Rolling resistance over weight of a car and all cars coupled to it. */
static double rolling_resistance(const CzBatch *batch, int car, int design) {
    int first = car, last = car;
    while (first > 0 && !cz_interface_can_open(batch, first - 1, design))
        --first;
    while (last + 1 < batch->n_car && !cz_interface_can_open(batch, last, design))
        ++last;
    double mass = 0.0, slowed = 0.0;
    for (int i = first; i <= last; ++i) {
        const CzVehicle *vehicle =
            &batch->design[design].vehicles[cz_car(batch, i, design)->vehicle];
        mass += vehicle->mass;
        slowed += vehicle->mass * vehicle->rolling_resistance;
    }
    return slowed / fmax(mass, 1.0);
}

/* Lower bound of the later speed of a car: zero where it brakes or its rolling resistance exceeds
 * that of the car behind it, its present speed where it rolls. */
static double lowest_speed(const CzBatch *batch, int car, int design) {
    const size_t lane = cz_lane(batch, car, design);
    const bool is_slowed =
        car > 0 && rolling_resistance(batch, car, design) >
                       (1.0 + ROUNDING) * rolling_resistance(batch, car - 1, design);
    const double speed = cz_velocity(batch, CZ_DOF(body.x), lane);
    const bool is_held = batch->car_equipment[lane].is_held;
    return is_held || is_slowed ? fmin(speed, 0.0) : speed;
}

/* A car ahead of others: its speed, the lower bound of that, and its deceleration. */
typedef struct Ahead {
    double speed, kept, slowing;
} Ahead;

static Ahead car_ahead(const CzBatch *batch, int car, int design) {
    const size_t lane = cz_lane(batch, car, design);
    return (Ahead){cz_velocity(batch, CZ_DOF(body.x), lane), lowest_speed(batch, car, design),
                   batch->car_equipment[lane].slowing};
}

/* Largest speed at which a car can still meet one ahead of it that is `room` away; the car ahead
 * may slow down meanwhile, at most to its lower bound. */
static double speed_at_meeting(double speed, const Ahead *ahead, double room) {
    const double closing = speed - ahead->speed, at_most = speed - ahead->kept;
    if (!(at_most > closing))
        return at_most;
    const double met = sqrt(closing * closing + 2.0 * ahead->slowing * room);
    return fmin(at_most, met); /* also for 0 times infinity */
}

/* Largest speed at which cars can still meet. Neighbours meet again at the latest at their largest
 * closure so far: nothing between them is longer. */
static double meeting_speed(const CzBatch *batch, int design) {
    double largest = 0.0;
    for (int car = 1; car < batch->n_car; ++car) {
        const Ahead ahead = car_ahead(batch, car, design);
        double room = 0.0;
        for (int behind = car - 1; behind >= 0; --behind) {
            const size_t lane = cz_lane(batch, behind, design);
            const double closure =
                cz_position(batch, CZ_DOF(body.x), lane) -
                cz_position(batch, CZ_DOF(body.x), cz_lane(batch, behind + 1, design));
            room += fmax(cz_extreme(batch, CZ_EXTREME(interface_shortening), lane) - closure, 0.0);
            largest = fmax(
                largest, speed_at_meeting(cz_velocity(batch, CZ_DOF(body.x), lane), &ahead, room));
        }
    }
    return largest;
}

/* Whether cars that have separated can meet again faster than the end criterion allows. */
static bool can_meet_again(const CzBatch *batch, int design) {
    static const int forces[] = {CZ_MEMORY(coupler.force), CZ_MEMORY(face.force),
                                 CZ_MEMORY(side_buffers.force)};
    for (int car = 0; car + 1 < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        bool together = !cz_interface_can_open(batch, car, design);
        for (size_t k = 0; k < sizeof forces / sizeof forces[0]; ++k)
            together |= cz_memory(batch, forces[k], lane) > 0.0;
        const double behind = cz_velocity(batch, CZ_DOF(body.x), lane);
        if (!together && behind - lowest_speed(batch, car + 1, design) > CZ_CLOSING_SPEED)
            return true;
    }
    return false;
}

/* The condition that the end criterion still waits for; NULL when it is met. */
static const char *awaited(const CzBatch *batch, int design, bool off, bool crushes,
                           const CzLoadLeft *left) {
    const bool closes_in = cz_largest_closing_speed(batch, design) > CZ_CLOSING_SPEED;
    return off                             ? "a wheel is off its rail"
           : crushes                       ? "a device still crushes or slides"
           : left->force                   ? "cars that can part still carry a contact force"
           : left->stores                  ? "elastic energy is still stored between cars"
           : closes_in                     ? "neighbouring cars close in"
           : can_meet_again(batch, design) ? "cars that have parted can meet again"
                                           : NULL;
}

/* Time since which a condition is met; NaN when it is not. */
static double holds_since(bool holds, double since, double now) {
    return !holds ? NAN : isnan(since) ? now : since;
}

/* Whether a wheel is off the rail now. Records an override when one was ever higher than its
 * flange; without lift stops the lift of the wheels does not indicate an override. */
static bool wheels_are_off(CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    bool off = false;
    for (int car = 0; car < batch->n_car; ++car) {
        const CzCar *description = cz_car(batch, car, design);
        if (description->model != CZ_MODEL_FULL)
            continue;
        const size_t lane = cz_lane(batch, car, design);
        const double flange =
            batch->design[design].vehicles[description->vehicle].bogie.flange_height;
        for (int axle = 0; axle < 4; ++axle) {
            const double lift = -cz_published(batch, CZ_PUBLISHED(wheel[axle].approach), lane);
            off |= lift > 0.0;
            if (isnan(progress->override_time) && description->has_stops &&
                cz_extreme(batch, CZ_EXTREME(lift[axle]), lane) > flange)
                progress->override_time = batch->time;
        }
    }
    return off;
}

static void look_for_climbing(CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    for (int car = 0; car + 1 < batch->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        if (cz_extreme(batch, CZ_EXTREME(face_climbed), lane) > 0.0)
            progress->override_time =
                fmin(isnan(progress->override_time) ? INFINITY : progress->override_time,
                     -cz_extreme(batch, CZ_EXTREME(climb_time), lane));
    }
}

static void look_at(CzBatch *batch, int design, bool finite) {
    CzProgressOfDesign *progress = &batch->design[design];
    cz_accounts_take(batch, design);
    if ((!finite && fails_to_be_finite(batch, design)) || fails_to_balance(batch, design) ||
        fails_to_solve(batch, design) || fails_to_fit(batch, design) ||
        fails_to_keep_apart(batch, design))
        return;
    look_for_climbing(batch, design);
    if (isnan(progress->wheel_rail) &&
        cz_train_speed(batch, 0, design) <= cz_train_speed(batch, 1, design))
        progress->wheel_rail = cz_wheel_rail_work(batch, design);
    const double strokes = plastic_strokes(batch, design);
    const bool crushes = strokes - progress->plastic > CRUSHING;
    progress->plastic = strokes;
    const bool off = wheels_are_off(batch, design);
    const CzLoadLeft left = cz_interface_loads_update(batch, design);
    progress->awaited = awaited(batch, design, off, crushes, &left);
    const bool settled =
        batch->brief && !off && !crushes && !left.stores &&
        meeting_speed(batch, design) <= MEETING_SHARE * batch->design[design].closing_speed;
    progress->quiet_since =
        holds_since(progress->awaited == NULL, progress->quiet_since, batch->time);
    progress->settled_since = holds_since(settled, progress->settled_since, batch->time);

    const CzModel *model = batch->design[design].model;
    if (!isnan(model->duration)) {
        if (batch->time >= model->duration - 0.5 * batch->step)
            end(progress, CZ_ENDED_DURATION);
    } else if (batch->time - progress->quiet_since >= model->hold) { /* false of NaN */
        end(progress, CZ_ENDED_BY_RULE);
    } else if (batch->time - progress->settled_since >= model->hold) {
        end(progress, CZ_ENDED_SETTLED);
    } else if (batch->time >= model->longest) {
        end(progress, CZ_ENDED_INCOMPLETE);
    }
    check_energies(batch, design);
}

int cz_ending_check(CzBatch *batch, bool is_time) {
    int n_left = 0;
    const bool finite = is_finite(batch->dynamics);
    for (int design = 0; design < batch->n_design; ++design) {
        if (!batch->design[design].over && cz_ending_is_due(batch, design, is_time))
            look_at(batch, design, finite);
        n_left += !batch->design[design].over;
    }
    return n_left;
}
