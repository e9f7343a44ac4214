/* The elastic track: statics, waves, modes, runs. */
#include "physics/rails.h"

#include "dynamics/track_motion.h"
#include "physics/collision.h"
#include "physics/roadbed.h"

#define LOAD 70e3 /* [N] */

/* ---- statics ---- */

/* k = seat stiffness over spacing, beta^4 = k / (4 E I), y = P beta / (2 k). */
void rows_of_winkler(Rows *rows) {
    const CzRoadbed roadbed = usual_roadbed();
    const CzSeats seats = cz_seats(&roadbed, 1);
    const double seat = 1.0 / cz_seat_flexibility(&seats, 0.0);
    const double k = seat / seats.spacing, beta = sqrt(sqrt(k / (4.0 * seats.bending)));
    ROW(rows, "MN/m", 1e-6 * seat, 28.1315, 1e-5, 0.0, "stiffness of a seat");
    ROW(rows, "MN/m2", 1e-6 * k, 46.886, 1e-4, 0.0, "seats smeared out: foundation");
    ROW(rows, "1/m", beta, 1.15337, 1e-5, 0.0, "seats smeared out: beta");
    ROW(rows, "mm", 1e3 * LOAD * beta / (2.0 * k), 0.86098, 1e-5, 0.0,
        "seats smeared out: deflection under 70 kN");
}

static void rows_of_beam(Rows *rows, const CzSeats *seats, const char *beam,
                         const double expected[3]) {
    ROW(rows, "mm", 1e3 * LOAD * cz_ring_flexibility(seats, 80, 0.0), expected[0], 0.0, 0.5e-4,
        "%s, 70 kN over a sleeper: deflection", beam);
    ROW(rows, "mm", 1e3 * LOAD * cz_ring_flexibility(seats, 80, 0.5), expected[1], 0.0, 0.5e-4,
        "%s, 70 kN between two sleepers: deflection", beam);
    ROW(rows, "kN", 1e-3 * LOAD * cz_ring_seat_share(seats, 80, 0.0, 0), expected[2], 0.0, 5e-3,
        "%s, 70 kN over a sleeper: force on its seat", beam);
}

/* Without shear: Euler's beam. */
static void make_eulers(CzSeats *seats) {
    seats->shear *= 1e6;
    seats->rotation *= 1e-6;
}

void rows_of_discrete_seats(Rows *rows) {
    const CzRoadbed roadbed = usual_roadbed();
    CzSeats seats = cz_seats(&roadbed, 1);
    rows_of_beam(rows, &seats, "Timoshenko", (const double[]){0.8980, 0.9194, 25.26});
    make_eulers(&seats);
    rows_of_beam(rows, &seats, "Euler", (const double[]){0.8592, 0.8642, 24.17});
}

/* ---- waves ---- */

static double frequency(const CzSeats *seats, double wavenumber) {
    return sqrt(cz_rail_wave(seats, wavenumber).bending) / (2.0 * CZ_PI);
}

void rows_of_rail_waves(Rows *rows) {
    static const struct {
        int mode;
        double frequency, digit;
    } pinned[] = {
        {1, 0.1001, 0.5e-4}, {10, 9.9849, 0.5e-4}, {60, 327.864, 0.5e-3}, {120, 1072.679, 0.5e-3}};
    static const struct {
        double coefficient, frequency, digit;
    } sleepers[] = {{0.40, 1072.68, 0.005}, {0.38, 1061.7, 0.05}, {0.34, 1037.2, 0.1}};
    CzRoadbed roadbed = usual_roadbed();
    CzSeats seats = cz_seats(&roadbed, 1);
    for (size_t i = 0; i < sizeof pinned / sizeof pinned[0]; ++i)
        ROW(rows, "Hz", frequency(&seats, pinned[i].mode * CZ_PI / 72.0), pinned[i].frequency, 0.0,
            pinned[i].digit, "pinned rail of 72 m, mode %d", pinned[i].mode);
    for (size_t i = 0; i < sizeof sleepers / sizeof sleepers[0]; ++i) {
        roadbed.rail.shear_coefficient = sleepers[i].coefficient;
        seats = cz_seats(&roadbed, 1);
        ROW(rows, "Hz", frequency(&seats, CZ_PI / 0.6), sleepers[i].frequency, 0.0,
            sleepers[i].digit, "nodes at the sleepers, shear coefficient %.2f",
            sleepers[i].coefficient);
    }
    make_eulers(&seats);
    ROW(rows, "Hz", frequency(&seats, CZ_PI / 0.6), 1442.09, 0.0, 0.02,
        "nodes at the sleepers, Euler's beam");
}

void rows_of_pinned_mode(Rows *rows) {
    CzArena arena = {0};
    const CzTrackModes *modes = usual_modes(18.0, 0, 0.0, &arena);
    double nearest = INFINITY;
    for (int k = 0; k < modes->n_group; ++k)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            const CzComplex lambda = modes->group[k].lambda[i];
            const double now = lambda.im / (2.0 * CZ_PI);
            if (lambda.re == 0.0 && lambda.im > 0.0 &&
                fabs(now - 1072.68) < fabs(nearest - 1072.68))
                nearest = now;
        }
    ROW(rows, "Hz", nearest, 1072.68, 0.0, 0.005,
        "undamped mode of the whole track with nodes at the sleepers");
    cz_arena_free(&arena);
}

/* ---- modes ---- */

/* Deflection of the modes, and with the flexibility beside them, over the exact one at a place. */
static void statics_with(double cut, double place, double *of_modes, double *of_both) {
    const double at[4] = {place, 0.0, 0.0, 0.0}, load[4] = {LOAD, 0.0, 0.0, 0.0};
    double deflection[4], flexibility[4];
    CzArena arena = {0};
    const CzTrackModes *modes = usual_modes(18.26, 0, cut, &arena);
    CzTrackMotion *track = cz_track_motion_create(modes, 1e-6, 1, &arena);
    assert_non_null(track);
    assert_true(cz_track_lay(track, 0, at, load, &arena));
    cz_track_look(track, 0, at, deflection, flexibility);
    const double exact =
        LOAD * cz_ring_flexibility(&modes->seats, modes->n_seat, place / modes->seats.spacing);
    *of_modes = -deflection[0] / exact;
    *of_both = (flexibility[0] * load[0] - deflection[0]) / exact;
    cz_arena_free(&arena);
}

void rows_of_mode_convergence(Rows *rows) {
    /* Blocks keep two rail waves each, so beyond some 3 kHz a higher cut adds nothing. */
    static const double cuts[] = {500.0, 1000.0, 1500.0, 3000.0};
    double missing_before = 1.0; /* no modes leave all of it */
    for (size_t c = 0; c < sizeof cuts / sizeof cuts[0]; ++c) {
        double largest = 0.0, missing = 0.0;
        for (double place = 0.0; place < 0.6; place += 0.05) {
            double of_modes, of_both;
            statics_with(cuts[c], place, &of_modes, &of_both);
            largest = fmax(largest, fabs(of_both - 1.0));
            missing = fmax(missing, fabs(of_modes - 1.0));
        }
        /* What the flexibility's four powers leave out falls with their fourth power from the 0.9 %
         * that the first stands for: 1e-2 / 5^4. */
        ROW_UP_TO(rows, "", largest, 2e-5,
                  "modes to %g Hz and what they leave: error of the static deflection", cuts[c]);
        ROW_UP_TO(rows, "", missing, missing_before,
                  "modes to %g Hz alone: what they leave (at most as much as fewer modes)",
                  cuts[c]);
        missing_before = missing;
    }
}

/* ---- runs ---- */

static Collision run_on_rails(const char *file, double step) {
    CzSimulateOptions options = cz_simulate_options_default();
    options.time_step = step;
    Collision collision = collide_so(file, WITH("simulation.track=modal"), 0, &options);
    assert_completed(&collision);
    return collision;
}

void rows_of_runs_on_rails(Rows *rows) {
    static const char *const files[] = {"problems/two-cars-25kmh.yaml", "problems/wall.yaml"};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        const char *name = files[i] + strlen("problems/");
        Collision coarse = run_on_rails(files[i], 1e-4), fine = run_on_rails(files[i], 4e-5);
        const int at = cz_model_colliding_interface(coarse.model);
        const double closure = coarse.summary->interface[at].shortening;
        const double pitch = coarse.summary->vehicle[0].max_pitch;
        ROW_UP_TO(rows, "", fabs(coarse.summary->energy.balance_error), 1e-4,
                  "%s on rails: energy balance", name);
        ROW_UP_TO(rows, "", fabs(coarse.summary->momentum_error), 1e-9, "%s on rails: momentum",
                  name);
        ROW_UP_TO(rows, "", fabs(closure / fine.summary->interface[at].shortening - 1.0), 1e-3,
                  "%s on rails: closure, change from 0.1 to 0.04 ms", name);
        ROW_UP_TO(rows, "", fabs(pitch / fine.summary->vehicle[0].max_pitch - 1.0), 1e-3,
                  "%s on rails: largest pitch, change from 0.1 to 0.04 ms", name);
        collision_free(&coarse);
        collision_free(&fine);
    }
}
