/* When a run ends: by rule, after its duration, or because it failed.
 *
 * By rule: no neighbouring cars close in or can meet again faster than CLOSING_SPEED, no interface
 * that can open carries a force, none stores more than CZ_STORED_SHARE of the initial energy, no
 * plastic element has flowed, every wheel is on the rail, and all of that for one body pitch
 * period. A brief run also ends when nothing has flowed for that long, no cars can meet again at
 * more than MEETING_SHARE of the first closing speed, and no interface stores what could make them.
 */
#include "simulate/run.h"

#include <math.h>
#include <stdio.h>

enum { LOOKS_BETWEEN_BOOKS = 64 }; /* looks at the end between two at the books (ours) */

#define CLOSING_SPEED 0.1      /* [m/s] */
#define MEETING_SHARE 0.4      /* a sixth of the first impact's energy (ours) */
#define FLOW 1e-6              /* growth of the plastic strokes that counts as flow [m] (ours) */
#define LARGEST_IMBALANCE 1e-2 /* of the initial energy */
#define LARGEST_RESIDUAL 1e-6  /* closure that a chain may leave unbalanced [m] (ours) */
#define LARGEST_LAW_ERROR                                                                          \
    1e-2 /* distance of a member from its law, of the largest force: as for the balance, since a   \
            force that is off by a share does work that is off by no more */

static const char *const dof_text[CZ_N_DOF] = {
#define CZ_DOF(name, what) what,
#include "model/dof.def"
#undef CZ_DOF
};

static const char *const ledger_text[CZ_N_LEDGER] = {
#define CZ_LEDGER(name, class, doc) doc,
#include "dynamics/ledger.def"
#undef CZ_LEDGER
};

static void fail(CzBatch *batch, int design, const char *car, const char *element,
                 const char *what) {
    CzProgressOfDesign *progress = &batch->design[design];
    snprintf(progress->failure, sizeof progress->failure, "%s: %s: %s at %.3f ms", car, element,
             what, 1e3 * batch->time);
    progress->ended = CZ_ENDED_INCOMPLETE;
    progress->over = true;
}

/* Fails the design when a number is no longer one; names the first degree of freedom. */
static bool fails_to_be_finite(CzBatch *batch, int design) {
    for (int car = 0; car < batch->model->n_car; ++car)
        for (int dof = 0; dof < CZ_N_DOF; ++dof) {
            const size_t lane = cz_lane(batch, car, design);
            if (isfinite(cz_velocity(batch, dof, lane)) && isfinite(cz_position(batch, dof, lane)))
                continue;
            fail(batch, design, batch->model->car[car].name, dof_text[dof], "not a finite number");
            return true;
        }
    return false;
}

/* Fails the design when the energy books do not close; names the kind of element with the most
 * work. */
static bool fails_to_balance(CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    const double residual = fabs(cz_balance_residual(batch, design));
    progress->balance = fmax(progress->balance, residual);
    if (residual <= LARGEST_IMBALANCE * progress->initial_energy) /* not a number fails too */
        return false;
    int worst_car = 0, worst_row = 0;
    double largest = 0.0;
    for (int car = 0; car < batch->model->n_car; ++car)
        for (int row = 0; row < CZ_N_LEDGER; ++row) {
            const double work = fabs(cz_work(batch, row, cz_lane(batch, car, design)));
            if (work > largest) {
                largest = work;
                worst_car = car;
                worst_row = row;
            }
        }
    fail(batch, design, batch->model->car[worst_car].name, ledger_text[worst_row],
         "energy balance lost (most work here)");
    return true;
}

/* Fails the design when its energies cannot be: looked at now and then, and at the end. */
static void fail_its_books(CzBatch *batch, int design) {
    char where[CZ_FAULT_ROOM], what[CZ_FAULT_ROOM];
    CzProgressOfDesign *progress = &batch->design[design];
    const bool is_time = progress->n_look++ % LOOKS_BETWEEN_BOOKS == 0;
    if ((progress->over || is_time) && cz_books_are_wrong(batch, design, where, what))
        fail(batch, design, where, "energy", what);
}

/* Fails the design when a series chain was left open or one of its members off its law. */
static bool fails_to_solve(CzBatch *batch, int design) {
    for (int car = 0; car + 1 < batch->model->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        const double open = cz_extreme(batch, CZ_E_CHAIN_RESIDUAL, lane);
        const double off = cz_law_error(batch, lane);
        char what[96];
        if (!(open <= LARGEST_RESIDUAL))
            snprintf(what, sizeof what, "strokes that miss the closure by %.3g mm", 1e3 * open);
        else if (!(off <= LARGEST_LAW_ERROR))
            snprintf(what, sizeof what, "a member %.3g %% of the largest force off its law",
                     100.0 * off);
        else
            continue;
        fail(batch, design, batch->model->interface_name[car], "series chain", what);
        return true;
    }
    return false;
}

/* Fails the design when a device has crushed further than its interface ever closed. */
static bool fails_to_fit(CzBatch *batch, int design) {
    static const struct {
        const char *chain;
        int first, n; /* plastic strokes, CzMemory */
        int closure;  /* CzExtreme */
    } chains[] = {{"coupler", CZ_M_TUBE_A, 6, CZ_E_COUPLER_CLOSURE},
                  {"anti-climbers", CZ_M_FACE_A, 2, CZ_E_FACE_CLOSURE},
                  {"ends", CZ_M_LIMP_PEAK_A, 2, CZ_E_FACE_CLOSURE},
                  {"side buffers", CZ_M_SIDE_TUBE_A, 2, CZ_E_SIDE_CLOSURE}};
    for (int car = 0; car + 1 < batch->model->n_car; ++car)
        for (size_t k = 0; k < sizeof chains / sizeof chains[0]; ++k) {
            const size_t lane = cz_lane(batch, car, design);
            double largest = 0.0;
            for (int member = 0; member < chains[k].n; ++member)
                largest = fmax(largest, cz_memory(batch, chains[k].first + member, lane));
            if (largest <= fmax(cz_extreme(batch, chains[k].closure, lane), 0.0) + LARGEST_RESIDUAL)
                continue;
            fail(batch, design, batch->model->interface_name[car], chains[k].chain,
                 "a stroke beyond the closure");
            return true;
        }
    return false;
}

/* Fails the design when a coupler has shortened by all that lies between its pivot and its face:
 * there is no line between two pivots that have met. Cars that climbed before that slide on over
 * each other, which is beyond the model's validity anyway. */
static bool fails_to_keep_apart(CzBatch *batch, int design) {
    static const int rows[] = {CZ_M_BUFFER_A, CZ_M_TUBE_A, CZ_M_SECOND_TUBE_A, CZ_M_SHEAR_A};
    char what[160];
    for (int car = 0; car + 1 < batch->model->n_car && isnan(batch->design[design].override_time);
         ++car)
        for (int side = 0; side < 2; ++side) {
            const size_t lane = cz_lane(batch, car, design);
            const double length = cz_parameter(batch, CZ_P_STRUT_LENGTH_A + side, lane);
            double shortened = 0.0;
            for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k)
                shortened += cz_memory(batch, rows[k] + side, lane);
            if (shortened < length)
                continue;
            snprintf(what, sizeof what,
                     "shortened by %.0f mm, and no more than the %.0f mm from its pivot to its "
                     "face are there",
                     1e3 * shortened, 1e3 * length);
            fail(batch, design, batch->model->car[car + side].name, "coupler", what);
            return true;
        }
    return false;
}

/* Sum of all plastic strokes: it grows while anything flows. */
static double plastic_strokes(const CzBatch *batch, int design) {
    static const int rows[] = {CZ_M_TUBE_A,        CZ_M_TUBE_B,         CZ_M_SECOND_TUBE_A,
                               CZ_M_SECOND_TUBE_B, CZ_M_SHEAR_A,        CZ_M_SHEAR_B,
                               CZ_M_FACE_A,        CZ_M_FACE_B,         CZ_M_LIMP_PEAK_A,
                               CZ_M_LIMP_PEAK_B,   CZ_M_SIDE_TUBE_A,    CZ_M_SIDE_TUBE_B,
                               CZ_M_END_PEAK_REAR, CZ_M_END_PEAK_FRONT, CZ_M_SUPERSTRUCTURE_SET};
    double sum = 0.0;
    for (int car = 0; car < batch->model->n_car; ++car)
        for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k)
            sum += cz_memory(batch, rows[k], cz_lane(batch, car, design));
    return sum;
}

static bool closes_in(const CzBatch *batch, int design) {
    for (int car = 0; car + 1 < batch->model->n_car; ++car) {
        const double behind = cz_velocity(batch, CZ_DOF_BODY_X, cz_lane(batch, car, design));
        const double ahead = cz_velocity(batch, CZ_DOF_BODY_X, cz_lane(batch, car + 1, design));
        if (behind - ahead > CLOSING_SPEED)
            return true;
    }
    return false;
}

static double rolling_resistance(const CzBatch *batch, int car, int design) {
    const CzCar *description = &batch->model->car[car];
    return batch->vehicles[design][description->vehicle].rolling_resistance;
}

/* Speed that a car keeps at least: that of rest where it brakes or is slowed by rolling more than
 * the car behind it, its own where it rolls. */
static double rest_or_speed(const CzBatch *batch, int car, int design) {
    const size_t lane = cz_lane(batch, car, design);
    const bool is_slowed = car > 0 && rolling_resistance(batch, car, design) >
                                          rolling_resistance(batch, car - 1, design);
    const double speed = cz_velocity(batch, CZ_DOF_BODY_X, lane);
    const bool brakes = cz_parameter(batch, CZ_P_BRAKE_MOMENT_0, lane) > 0.0 ||
                        cz_parameter(batch, CZ_P_BRAKE_MOMENT_3, lane) > 0.0 ||
                        cz_parameter(batch, CZ_P_DRAG_BRAKE, lane) > 0.0 ||
                        cz_parameter(batch, CZ_P_DRAG_SLIDE, lane) > 0.0;
    return brakes || is_slowed ? fmin(speed, 0.0) : speed;
}

/* Largest speed at which cars that are apart now can still meet: what is ahead may come to rest
 * where it is slowed. */
static double meeting_speed(const CzBatch *batch, int design) {
    double slowest = INFINITY, largest = 0.0;
    for (int car = batch->model->n_car - 1; car >= 0; --car) {
        const double speed = cz_velocity(batch, CZ_DOF_BODY_X, cz_lane(batch, car, design));
        largest = fmax(largest, speed - slowest);
        slowest = fmin(slowest, rest_or_speed(batch, car, design));
    }
    return largest;
}

/* Whether cars that have parted can meet again: what is ahead may come to rest where it is slowed.
 */
static bool can_meet_again(const CzBatch *batch, int design) {
    static const int forces[] = {CZ_M_COUPLER_FORCE, CZ_M_FACE_FORCE, CZ_M_SIDE_FORCE};
    for (int car = 0; car + 1 < batch->model->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        bool together = cz_parameter(batch, CZ_P_COUPLED, lane) > 0.5;
        for (size_t k = 0; k < sizeof forces / sizeof forces[0]; ++k)
            together |= cz_memory(batch, forces[k], lane) > 0.0;
        const double behind = cz_velocity(batch, CZ_DOF_BODY_X, lane);
        if (!together && behind - rest_or_speed(batch, car + 1, design) > CLOSING_SPEED)
            return true;
    }
    return false;
}

/* When a condition began to hold: kept while it does, forgotten when it does not. */
static double holds_since(bool holds, double since, double now) {
    return !holds ? NAN : isnan(since) ? now : since;
}

/* Looks at the wheels: off the rail now, and higher than their flange ever. Without stops a body
 * lifts its wheels by any amount or none, which tells nothing of a climb. */
static bool wheels_are_off(CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    bool off = false;
    for (int car = 0; car < batch->model->n_car; ++car) {
        const CzCar *description = &batch->model->car[car];
        if (description->model != CZ_MODEL_FULL)
            continue;
        const size_t lane = cz_lane(batch, car, design);
        const double flange = batch->vehicles[design][description->vehicle].bogie.flange_height;
        for (int axle = 0; axle < 4; ++axle) {
            const double lift = -cz_scratch(batch, CZ_S_WHEEL_APPROACH_0 + axle, lane);
            off |= lift > 0.0;
            if (isnan(progress->override_time) && description->has_stops &&
                cz_extreme(batch, CZ_E_LIFT_0 + axle, lane) > flange)
                progress->override_time = batch->time;
        }
    }
    return off;
}

static void look_for_climbing(CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    for (int car = 0; car + 1 < batch->model->n_car; ++car) {
        const size_t lane = cz_lane(batch, car, design);
        if (cz_extreme(batch, CZ_E_FACE_CLIMBED, lane) > 0.0)
            progress->override_time =
                fmin(isnan(progress->override_time) ? INFINITY : progress->override_time,
                     -cz_extreme(batch, CZ_E_CLIMB_TIME, lane));
    }
}

static void look_at(CzBatch *batch, int design) {
    CzProgressOfDesign *progress = &batch->design[design];
    if (fails_to_be_finite(batch, design) || fails_to_balance(batch, design) ||
        fails_to_solve(batch, design) || fails_to_fit(batch, design) ||
        fails_to_keep_apart(batch, design))
        return;
    look_for_climbing(batch, design);
    if (isnan(progress->wheel_rail) &&
        cz_train_speed(batch, 0, design) <= cz_train_speed(batch, 1, design))
        progress->wheel_rail = cz_wheel_rail_work(batch, design);
    const double strokes = plastic_strokes(batch, design);
    const bool flows = strokes - progress->plastic > FLOW;
    progress->plastic = strokes;
    const bool off = wheels_are_off(batch, design);
    const CzLoadLeft left = cz_interface_loads_look(batch, design);
    const double initial = progress->initial_energy;
    const bool quiet = !off && !flows && !left.force && left.energy <= CZ_STORED_SHARE * initial &&
                       !closes_in(batch, design) && !can_meet_again(batch, design);
    const bool settled = batch->brief && !off && !flows &&
                         left.energy <= MEETING_SHARE * MEETING_SHARE * initial &&
                         meeting_speed(batch, design) <= MEETING_SHARE * batch->closing_speed;
    progress->quiet_since = holds_since(quiet, progress->quiet_since, batch->time);
    progress->settled_since = holds_since(settled, progress->settled_since, batch->time);

    const CzModel *model = batch->model;
    if (!isnan(model->duration)) {
        if (batch->time >= model->duration - 0.5 * batch->step) {
            progress->ended = CZ_ENDED_DURATION;
            progress->over = true;
        }
    } else if (batch->time - progress->quiet_since >= model->hold) { /* not while it is no number */
        progress->ended = CZ_ENDED_BY_RULE;
        progress->over = true;
    } else if (batch->time - progress->settled_since >= model->hold) {
        progress->ended = CZ_ENDED_SETTLED;
        progress->over = true;
    } else if (batch->time >= model->longest) {
        progress->ended = CZ_ENDED_INCOMPLETE;
        progress->over = true;
    }
    fail_its_books(batch, design);
}

bool cz_ending_look(CzBatch *batch) {
    bool all_over = true;
    for (int design = 0; design < batch->n_design; ++design) {
        if (!batch->design[design].over)
            look_at(batch, design);
        all_over &= batch->design[design].over;
    }
    return all_over;
}
