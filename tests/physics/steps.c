/* Time steps, energy checks, other solvers, and the equivalence of a wall and an identical partner.
 */
#include "physics/steps.h"

#include "base/complex.h"
#include "support/shipped.h"

Collision collide_with(const char *file, int scenario, double step) {
    CzSimulateOptions options = cz_simulate_options_default();
    options.time_step = step;
    return collide_so(file, AS_WRITTEN, scenario, &options);
}

/* ---- an elastic collision ---- */

/* Two masses of 40 t and 20 MN/m: x_A - 5 t = 5 sin(w t) / w, v_A = 5 + 5 cos(w t), w^2 = k / mu;
 * after half a period they have exchanged their speeds. */
static double error_at_80_ms(double step) {
    Collision elastic = collide_with("tests/physics/cases/elastic.yaml", 0, step);
    assert_completed(&elastic);
    const double w = sqrt(20e6 / 20e3);
    const double truth = 5.0 + 5.0 * cos(w * 0.08);
    const double error = fabs(elastic.summary->vehicle[0].final_speed - truth);
    collision_free(&elastic);
    return error;
}

void rows_of_elastic_order(Rows *rows) {
    for (double step = 1e-3; step > 1.2e-4; step *= 0.5)
        ROW(rows, "", log2(error_at_80_ms(step) / error_at_80_ms(0.5 * step)), 2.0, 0.0, 0.1,
            "elastic collision: order, step %g to %g ms", 1e3 * step, 0.5e3 * step);
}

void rows_of_elastic_exchange(Rows *rows) {
    Collision elastic =
        collide("tests/physics/cases/elastic.yaml",
                WITH("simulation.duration_ms=200", "simulation.time_step_ms=0.01"), 0);
    assert_completed(&elastic);
    const CzRunSummary *summary = elastic.summary;
    const double stiffness = 20e6, reduced = 20e3, speed = 10.0;
    ROW(rows, "kN", 1e-3 * summary->interface[0].peak_force,
        1e-3 * speed * sqrt(stiffness * reduced), 1e-5, 0.0, "elastic collision: largest force");
    ROW(rows, "mm", 1e3 * summary->interface[0].shortening, 1e3 * speed * sqrt(reduced / stiffness),
        1e-5, 0.0, "elastic collision: largest closure");
    ROW(rows, "ms",
        1e3 * time_of_opening(&elastic, channel(&elastic, CZ_CHANNEL_INTERFACE_FORCE, "A1-B1")),
        1e3 * CZ_PI * sqrt(reduced / stiffness), 1e-4, 0.0, "elastic collision: duration");
    ROW(rows, "m/s", summary->vehicle[0].final_speed, 0.0, 0.0, 1e-4,
        "elastic collision: speed of the car behind");
    ROW(rows, "m/s", summary->vehicle[1].final_speed, 10.0, 1e-5, 0.0,
        "elastic collision: speed of the car ahead");
    ROW(rows, "", summary->energy.dissipated / summary->energy.initial, 0.0, 0.0, 1e-5,
        "elastic collision: share of the energy that is lost");
    collision_free(&elastic);
}

/* ---- shipped problems ---- */

/* A device that yields at first contact loses half a step of its impulse, so shipped problems
 * converge with the first power of the step; the order of changes below a few parts in ten thousand
 * has no meaning. */
enum { N_VALUE = 3 };
static const char *const value_names[N_VALUE] = {"closure of the colliding interface",
                                                 "dissipated energy", "largest pitch"};
static const char *const short_trains[] = {"problems/first-collision.yaml",
                                           "problems/two-cars-25kmh.yaml", "problems/wall.yaml"};
enum { N_SHORT = sizeof short_trains / sizeof short_trains[0] };

/* Name of a file in a row. */
static const char *name_of(const char *file) {
    return file + strlen("problems/");
}

static void values_at(const char *file, double step, double *value) {
    Collision collision = collide_with(file, 0, step);
    assert_completed(&collision);
    const int at = cz_model_colliding_interface(collision.model);
    value[0] = collision.summary->interface[at].shortening;
    value[1] = collision.summary->energy.dissipated;
    value[2] = collision.summary->vehicle[0].max_pitch;
    collision_free(&collision);
}

void rows_of_step_convergence(Rows *rows) {
    for (int file = 0; file < N_SHORT; file++) {
        double coarse[N_VALUE], middle[N_VALUE], fine[N_VALUE];
        values_at(short_trains[file], 1e-4, coarse);
        values_at(short_trains[file], 4e-5, middle);
        values_at(short_trains[file], 1.6e-5, fine);
        for (int i = 0; i < N_VALUE; i++) {
            const double change = fabs(coarse[i] - fine[i]) / fabs(fine[i]);
            const double order =
                log(fabs(coarse[i] - middle[i]) / fabs(middle[i] - fine[i])) / log(2.5);
            ROW_UP_TO(rows, "", change, 1e-3, "%s: %s, change from 0.1 to 0.016 ms",
                      name_of(short_trains[file]), value_names[i]);
            if (change >= 3e-4)
                ROW_UP_TO(rows, "", -order, -0.9, "%s: %s, order (with its sign turned)",
                          name_of(short_trains[file]), value_names[i]);
        }
    }
}

/* Worst errors of the energy balance of a file's first scenarios. */
typedef struct EnergyChecks {
    int n_scenario;
    double balance, momentum, sum;
} EnergyChecks;

static EnergyChecks energy_checks_of(const char *file, const char *const *set, int n_scenario) {
    EnergyChecks checks = {.n_scenario = n_scenario};
    for (int scenario = 0; scenario < checks.n_scenario; scenario++) {
        Collision collision = collide(file, set, scenario);
        assert_completed(&collision);
        const CzEnergy *energy = &collision.summary->energy;
        const double parts = energy->final_kinetic + energy->dissipated + energy->stored;
        checks.balance = fmax(checks.balance, fabs(energy->balance_error));
        checks.momentum = fmax(checks.momentum, fabs(collision.summary->momentum_error));
        checks.sum = fmax(checks.sum, fabs(parts / energy->initial - 1.0));
        collision_free(&collision);
    }
    return checks;
}

/* Of a family of scenarios with offsets, which are the same trains at other heights, one is run.
 */
enum { MAX_SCENARIOS = 20, OF_A_FAMILY = 1 };

static int n_looked_at(const char *file) {
    Collision first = collision_model(file, AS_WRITTEN, 0);
    const int n = cz_problem_n_scenario(first.problem);
    collision_free(&first);
    return n > MAX_SCENARIOS ? OF_A_FAMILY : n;
}

/* Up to 2 s, long after the largest forces; cars roll under their brakes for up to 14 s. Every run
 * of the program checks its own balance up to its end. */
void rows_of_balances(Rows *rows) {
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++) {
        const char *name = shipped.name[i];
        char file[SHIPPED_SIZE + 16];
        snprintf(file, sizeof file, "problems/%s", name);
        const EnergyChecks checks = energy_checks_of(
            file, WITH("simulation.track=modal", "simulation.duration_s=2"), n_looked_at(file));
        ROW_UP_TO(rows, "", checks.balance, 1e-4, "%s: energy balance, worst of %d scenario%s",
                  name, checks.n_scenario, checks.n_scenario > 1 ? "s" : "");
        ROW_UP_TO(rows, "", checks.sum, 1e-4,
                  "%s: kinetic + dissipated + stored over initial energy", name);
        ROW_UP_TO(rows, "", checks.momentum, 1e-9, "%s: momentum", name);
    }
}

static bool asks_for_rigid_rails(const char *file) {
    Collision first = collision_model(file, AS_WRITTEN, 0);
    const bool is_rigid = cz_problem_input(first.problem)->simulation.track == CZ_TRACK_RIGID;
    collision_free(&first);
    return is_rigid;
}

/* In the pair that bottoms out and climbs, wheels hit rigid rails; 1e-3 is the limit of the
 * warning.
 */
static double bound_on_rigid_rails(const char *name) {
    return strcmp(name, "override-bottoming-lifts.yaml") == 0 ? 1e-3 : 1e-4;
}

void rows_of_balances_on_rigid_rails(Rows *rows) {
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++) {
        const char *name = shipped.name[i];
        char file[SHIPPED_SIZE + 16];
        snprintf(file, sizeof file, "problems/%s", name);
        if (!asks_for_rigid_rails(file))
            continue;
        const EnergyChecks checks = energy_checks_of(file, AS_WRITTEN, n_looked_at(file));
        ROW_UP_TO(rows, "", checks.balance, bound_on_rigid_rails(name),
                  "%s, rigid rails: energy balance", name);
        ROW_UP_TO(rows, "", checks.momentum, 1e-9, "%s, rigid rails: momentum", name);
    }
}

/* ---- other solvers ---- */

static void widen(double *largest, double a, double b, double floor_of) {
    *largest = fmax(*largest, fabs(a - b) / fmax(fabs(b), floor_of));
}

Difference difference_of(const CzRunSummary *a, const CzRunSummary *b, double share) {
    Difference d = {0};
    assert_int_equal(a->n_interface, b->n_interface);
    const double dissipated = b->energy.dissipated;
    widen(&d.energy, a->energy.dissipated, dissipated, 1e3);
    for (int i = 0; i < a->n_interface; i++) {
        const CzInterfaceResult *p = &a->interface[i], *q = &b->interface[i];
        widen(&d.force, p->peak_force, q->peak_force, 1e4);
        widen(&d.stroke, p->shortening, q->shortening, 1e-3);
        widen(&d.energy, p->energy, q->energy, share * dissipated);
        for (int k = 0; k < p->n_element; k++)
            widen(&d.stroke, p->element[k].stroke, q->element[k].stroke, 1e-2);
    }
    for (int i = 0; i < a->n_vehicle; i++) {
        const CzVehicleResult *p = &a->vehicle[i], *q = &b->vehicle[i];
        widen(&d.motion, p->mean_deceleration_120ms, q->mean_deceleration_120ms, 1e-3);
        if (isfinite(q->max_pitch))
            widen(&d.motion, p->max_pitch, q->max_pitch, 1e-4);
    }
    if (getenv("CZ_TOL_SCALE") != NULL)
        print_message("%s: force %.1e stroke %.1e energy %.1e motion %.1e, %ld against %ld steps, "
                      "%.0f times the time, balance %.1e\n",
                      b->scenario, d.force, d.stroke, d.energy, d.motion, b->n_step, a->n_step,
                      b->wall_s / a->wall_s, b->energy.balance_error);
    return d;
}

/* A file with the step of the production run and the time up to which solvers are compared [s]: 0
 * are the file's own. Where trains keep rolling with their brakes on, the compared values are final
 * long before the trains stand. */
typedef struct Compared {
    const char *file;
    double step, until;
} Compared;

static Collision collide_by(CzIntegrator integrator, const Compared *compared, double step) {
    CzSimulateOptions options = cz_simulate_options_default();
    options.integrator = integrator;
    options.time_step = step;
    char until[48];
    snprintf(until, sizeof until, "simulation.duration_s=%g", compared->until);
    const char *const *set = compared->until > 0.0 ? WITH(until) : AS_WRITTEN;
    Collision collision = collide_so(compared->file, set, 0, &options);
    assert_completed(&collision);
    return collision;
}

/* Difference of the production run from both references, within these tolerances; `motion` NaN
 * leaves that out. A production run with another step is named by it. */
static void solvers(Rows *rows, const Compared *compared, double share, const Difference *allowed) {
    Collision zhai = collide_by(CZ_INTEGRATOR_ZHAI, compared, compared->step);
    char of[64];
    int n = snprintf(of, sizeof of, "%s", name_of(compared->file));
    if (compared->step > 0.0)
        n += snprintf(of + n, sizeof of - (size_t)n, " at %g ms", 1e3 * compared->step);
    if (compared->until > 0.0)
        snprintf(of + n, sizeof of - (size_t)n, " up to %g s", compared->until);
    for (int i = CZ_INTEGRATOR_ERK; i <= CZ_INTEGRATOR_ADAMS; i++) {
        Collision other = collide_by((CzIntegrator)i, compared, 0.0);
        const Difference d = difference_of(zhai.summary, other.summary, share);
        const char *name = cz_integrator_text((CzIntegrator)i);
        ROW_UP_TO(rows, "", d.force, allowed->force, "%s: peak forces against %s", of, name);
        ROW_UP_TO(rows, "", d.stroke, allowed->stroke, "%s: closures, strokes against %s", of,
                  name);
        ROW_UP_TO(rows, "", d.energy, allowed->energy, "%s: energies against %s", of, name);
        if (!isnan(allowed->motion))
            ROW_UP_TO(rows, "", d.motion, allowed->motion, "%s: deceleration, pitch against %s", of,
                      name);
        ROW_UP_TO(rows, "", other.summary->energy.balance_error, 1e-4, "%s: energy balance of %s",
                  of, name);
        ROW_UP_TO(rows, "", other.summary->momentum_error, 1e-9, "%s: momentum of %s", of, name);
        collision_free(&other);
    }
    collision_free(&zhai);
}

/* Few cars: both sides are accurate to some parts in ten thousand at the default step. Four of the
 * files have parts whose stroke or pitch the default step leaves at 1.2 to 1.4 parts in a thousand;
 * the error goes with the step, so they have to satisfy the same bound at a half or a quarter of
 * it. */
void rows_of_solvers_for_short_trains(Rows *rows) {
    static const Compared compared[] = {
        {"problems/first-collision.yaml", 0.0, 0.0},
        {"problems/two-cars-25kmh.yaml", 0.0, 0.0},
        {"problems/wall.yaml", 0.0, 0.0},
        {"problems/wagon.yaml", 0.0, 0.0},
        {"problems/buffer-stop.yaml", 0.0, 0.0},
        {"problems/paper-25kmh.yaml", 2.5e-5, 0.0},
        {"problems/override-overlap-climbs.yaml", 0.0, 2.0},
        {"problems/override-overlap-holds.yaml", 0.0, 2.0},
        {"problems/override-bottoming-lifts.yaml", 0.0, 0.0},
        {"problems/override-bottoming-holds.yaml", 0.0, 0.0},
        {"problems/override-hinge-folds.yaml", 5e-5, 2.0},
        {"problems/override-hinge-holds.yaml", 5e-5, 2.0},
        {"problems/paper-trains-25kmh.yaml", 5e-5, 0.0},
    };
    const Difference allowed = {1e-3, 1e-3, 1e-3, 1e-3};
    for (size_t i = 0; i < sizeof compared / sizeof compared[0]; i++)
        solvers(rows, &compared[i], 0.01, &allowed);
}

/* The response of six and six cars is chaotic, so single values scatter: forces and strokes within
 * 2 %, energies within 1 % of all that is dissipated. The fixed-step scheme itself, at steps of
 * 0.05 to 0.1 ms, scatters by 2 % in the energy of one inner interface and by 0.3 % in its closure,
 * because two cars that have parted may or may not crush again when they meet seconds later. */
void rows_of_solvers_for_the_metro(Rows *rows) {
    const Difference allowed = {2e-2, 2e-2, 1e-2, NAN};
    const Compared metro = {"problems/metro-6-car.yaml", 0.0, 3.0};
    solvers(rows, &metro, 1.0, &allowed);
}

/* ---- a wall is half of an identical partner ---- */

/* A car at v onto an identical one equals the car at v / 2 against a wall: half the closure, half
 * the energy, the same force. The damping of anti-climbers sets in over the first 10 mm of closure,
 * which is twice as long for one as for two, so it is left out. */
void rows_of_equivalence(Rows *rows) {
    static const char *const names[] = {"coupler", "anti-climber", "end"};
    const char *const *set =
        WITH("simulation.duration_s=0.5", "parts.front.anti_climber.damping_kN_s_m=0");
    Collision pair = collide("tests/physics/cases/rigid-pair.yaml", set, 0);
    Collision wall = collide("tests/physics/cases/rigid-wall.yaml", set, 0);
    assert_completed(&pair);
    assert_completed(&wall);
    const CzInterfaceResult *two = &pair.summary->interface[0];
    const CzInterfaceResult *one = &wall.summary->interface[0];
    ROW(rows, "kN", 1e-3 * one->peak_force, 1e-3 * two->peak_force, 1e-9, 0.0, "largest force");
    ROW(rows, "m", one->shortening, 0.5 * two->shortening, 1e-9, 0.0, "closure, half of it");
    ROW(rows, "kJ", 1e-3 * one->energy, 0.5e-3 * two->energy, 1e-9, 0.0, "energy, half of it");
    ROW(rows, "m/s", wall.summary->vehicle[0].final_speed + 5.0,
        pair.summary->vehicle[0].final_speed, 1e-9, 0.0, "speed after, 5 m/s more");
    for (int i = 0; i < 3; i++) {
        ROW(rows, "kJ", 1e-3 * one->element[i].energy, 1e-3 * two->element[i].energy, 1e-6, 1e-3,
            "energy of the %s", names[i]);
        ROW(rows, "m", one->element[i].stroke, two->element[i].stroke, 1e-6, 1e-9,
            "stroke of the %s", names[i]);
    }
    collision_free(&pair);
    collision_free(&wall);
}
