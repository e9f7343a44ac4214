/* The elastic track: statics, waves, modes, runs. */
#include "physics/rails.h"

#include "dynamics/track_elements.h"
#include "dynamics/track.h"
#include "model/receptance.h"
#include "model/track_block.h"
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
    ROW(rows, "MN/m2", 1e-6 * k, 46.886, 1e-4, 0.0, "continuous support: stiffness");
    ROW(rows, "1/m", beta, 1.15337, 1e-5, 0.0, "continuous support: beta");
    ROW(rows, "mm", 1e3 * LOAD * beta / (2.0 * k), 0.86098, 1e-5, 0.0,
        "continuous support: deflection under 70 kN");
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

/* Newton's method ends at 1e-11 of the weight: 5 uN on 0.5 MN, and 1e-11 of each deflection. */
void rows_of_rest(Rows *rows) {
    static const char *const tracks[] = {"rigid", "modal"};
    for (int t = 0; t < 2; ++t) {
        char set[48];
        CzRest rest[16];
        CzError error = {0};
        snprintf(set, sizeof set, "simulation.track=%s", tracks[t]);
        Collision collision = collision_model("tests/physics/cases/coaches.yaml", WITH(set), 0);
        assert_int_equal(cz_rest_find(collision.model, rest, &error), CZ_OK);
        for (int vehicle = 0; vehicle < 2; ++vehicle) {
            const char *name = vehicle == 0 ? "Manchester coach" : "Velaro coach";
            const CzVehicleProperties properties =
                cz_model_vehicle_properties(collision.model, vehicle);
            ROW_UP_TO(rows, "", rest[vehicle].residual, 1e-10, "%s, %s track: residual", name,
                      tracks[t]);
            ROW(rows, "kN", 1e-3 * rest[vehicle].axle_load[0], 1e-3 * properties.axle_load[0], 1e-9,
                0.0, "%s, %s track: load of an axle", name, tracks[t]);
            ROW(rows, "mm", 1e3 * rest[vehicle].primary_deflection[0],
                1e3 * properties.primary_deflection[0], 1e-9, 0.0, "%s, %s track: primary springs",
                name, tracks[t]);
            ROW(rows, "mm", 1e3 * rest[vehicle].secondary_deflection[0],
                1e3 * properties.secondary_deflection[0], 1e-9, 0.0,
                "%s, %s track: secondary springs", name, tracks[t]);
        }
        collision_free(&collision);
    }
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
    ROW(rows, "Hz", frequency(&seats, 60.0 * CZ_PI / 72.0), 360.52, 0.0, 0.005,
        "pinned rail of 72 m, mode 60, Euler's beam");
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
    cz_track_deflection(track, 0, at, deflection, flexibility);
    const double exact =
        LOAD * cz_ring_flexibility(&modes->seats, modes->n_seat, place / modes->seats.spacing);
    *of_modes = -deflection[0] / exact;
    *of_both = (flexibility[0] * load[0] - deflection[0]) / exact;
    cz_arena_free(&arena);
}

void rows_of_mode_convergence(Rows *rows) {
    /* Blocks have two rail waves each, so a cut above about 3 kHz has no effect. */
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
        /* The error of the flexibility's four powers falls with the fourth power from the 0.9 % of
         * the first: 1e-2 / 5^4. */
        ROW_UP_TO(rows, "", largest, 2e-5,
                  "modes to %g Hz with residual flexibility: error of the static deflection",
                  cuts[c]);
        ROW_UP_TO(
            rows, "", missing, missing_before,
            "modes to %g Hz only: error of the static deflection (at most that of fewer modes)",
            cuts[c]);
        missing_before = missing;
    }
}

/* The same statics by the models of a run: the production run's modes with their residual
 * flexibility, and finite elements, to half a per cent. */
void rows_of_running_tracks(Rows *rows) {
    static const double known[] = {0.8980, 0.9194};
    for (int i = 0; i < 2; ++i) {
        const double at[4] = {0.3 * i, 0.0, 0.0, 0.0}, load[4] = {2.0 * LOAD, 0.0, 0.0, 0.0};
        const char *where = i == 0 ? "over a sleeper" : "between two sleepers";
        double deflection[4], flexibility[4];
        CzArena arena = {0};
        const CzTrackModes *modes = usual_modes(18.26, 0, 0.0, &arena);
        CzTrackMotion *track = cz_track_motion_create(modes, 1e-4, 1, &arena);
        assert_non_null(track);
        assert_true(cz_track_lay(track, 0, at, load, &arena));
        cz_track_deflection(track, 0, at, deflection, flexibility);
        const double down = flexibility[0] * load[0] - deflection[0];
        ROW(rows, "mm", 1e3 * down, known[i], 5e-3, 0.0,
            "production track, 70 kN a rail %s: deflection", where);
        if (i == 0) /* at rest a seat presses by its stiffness times the rail's deflection there */
            ROW(rows, "kN", 0.5e-3 * down / cz_seat_flexibility(&modes->seats, 0.0), 25.26, 5e-3,
                0.0, "production track, 70 kN a rail %s: force on its seat", where);
        CzElements *elements = cz_elements_create(&modes->seats, 4, 18.26, 1e-4, 1, &arena);
        assert_non_null(elements);
        assert_true(cz_elements_lay(elements, 0, at, load, &arena));
        CzRailPoint point[4];
        cz_elements_deflection(elements, 0, at, point);
        ROW(rows, "mm", 1e3 * (point[0].flexibility * load[0] - point[0].z), known[i], 5e-3, 0.0,
            "finite elements, 70 kN a rail %s: deflection", where);
        const CzElementsUnder *under = &elements->under[0];
        const size_t bay = (size_t)lround((0.0 - under->from) / modes->seats.spacing);
        const CzElementsRow *rail = &elements->block[0].u[bay * elements->per_bay];
        if (i == 0)
            ROW(rows, "kN", 0.5e-3 * modes->seats.pad_k * (rail[2][0] - rail[0][0]), 25.26, 5e-3,
                0.0, "finite elements, 70 kN a rail %s: force on its seat", where);
        cz_arena_free(&arena);
    }
}

/* A Timoshenko beam on the same layers as a continuous foundation: the point receptance is the sum
 * over all waves of 1 / (kGA K^2 + k_d - m w^2 - (kGA K)^2 / (EI K^2 + kGA - rI w^2)). */
static CzComplex smeared_receptance(const CzSeats *seats, double w) {
    const CzComplex s = {0.0, w}, pad = {seats->pad_k, w * seats->pad_c};
    CzTrackBlock below_of = {.seats = seats};
    const CzComplex below = cz_track_below(&below_of, s).sleeper;
    const CzComplex k = cz_complex_scaled(
        1.0 / seats->spacing, cz_complex_inverse(cz_complex_sum(cz_complex_inverse(pad), below)));
    const double step = 1e-3;
    CzComplex sum = {0.0, 0.0};
    for (double wave = 0.5 * step; wave < 400.0; wave += step) {
        const double shear = seats->shear * wave, square = wave * wave;
        const double turning = seats->bending * square + seats->shear - seats->rotation * w * w;
        const CzComplex hardness = {
            seats->shear * square + k.re - seats->mass * w * w - shear * shear / turning, k.im};
        sum = cz_complex_sum(sum, cz_complex_scaled(step / CZ_PI, cz_complex_inverse(hardness)));
    }
    return sum;
}

/* Deflection under a wheel per force on it alone: the mean of bounce and pitch of a pair, and the
 * mean over a bay of the flexibility beside the modes, where the powers of the cosine have the
 * means 1, 0, 1/2, 0 and |sin| has 2 / pi. */
static CzComplex receptance_of_a_wheel(const CzTrackModes *modes, double w, CzArena *arena) {
    const CzTrackFlexibility flexibility = cz_track_flexibility(modes, 0.0);
    CzTrackSpectrum spectrum;
    if (!cz_track_spectrum(modes, 2.5, arena, &spectrum))
        fail_msg("no memory");
    CzComplex sum = {
        flexibility.corner * 2.0 / CZ_PI + flexibility.term[0] + 0.5 * flexibility.term[2], 0.0};
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++)
        sum = cz_complex_sum(
            sum, cz_complex_scaled(0.5, cz_track_receptance(&spectrum, (CzPairMotion)motion,
                                                            (CzComplex){0.0, w})));
    return sum;
}

/* Seats at 0.6 m act almost like a continuous support: the statics of both, 6.49 and 6.48 mm/MN as
 * the mean over a bay, differ by half a per cent because of the shear at a seat; up to 200 Hz the
 * difference grows to two per cent at most. */
void rows_of_receptance(Rows *rows) {
    static const double frequency_of[] = {2.0, 20.0, 60.0, 100.0, 200.0};
    CzArena arena = {0};
    const CzTrackModes *modes = usual_modes(18.26, 0, 0.0, &arena);
    for (size_t i = 0; i < sizeof frequency_of / sizeof frequency_of[0]; ++i) {
        const double w = 2.0 * CZ_PI * frequency_of[i];
        const CzComplex smeared = smeared_receptance(&modes->seats, w);
        ROW(rows, "mm/MN", 1e9 * cz_complex_size(receptance_of_a_wheel(modes, w, &arena)),
            1e9 * cz_complex_size(smeared), 0.02, 0.0,
            "rail under a force of %g Hz, continuous layers: receptance", frequency_of[i]);
    }
    cz_arena_free(&arena);
}

/* ---- finite elements ---- */

/* The rail wave with its nodes at the seats, in a row of elements with lumped masses: too low by
 * the square of the nodes' distance. */
static double pinned_pinned_frequency(int nodes) {
    CzArena arena = {0};
    const CzRoadbed roadbed = usual_roadbed();
    const CzSeats seats = cz_seats(&roadbed, 2);
    const double step = 5e-6, none[4] = {0.0};
    CzElements *elements = cz_elements_create(&seats, nodes, 0.0, step, 1, &arena);
    assert_non_null(elements);
    assert_true(cz_elements_lay(elements, 0, none, none, &arena));
    const CzElementsBlock *block = &elements->block[0];
    for (size_t bay = 0; bay < (size_t)elements->n_bay; ++bay)
        for (size_t node = 0; node < (size_t)nodes; ++node) {
            const double phase = 0.5 * ((double)bay + (double)node / nodes);
            const size_t at = bay * elements->per_bay + (node == 0 ? 0 : 2 + 2 * node);
            block->v[at][0] = node == 0 ? 0.0 : cz_turned(phase).im;
            block->v[at + 1][0] = 0.9 * CZ_PI / seats.spacing * cz_turned(phase).re;
        }
    const size_t seen = (size_t)elements->n_bay / 2 * elements->per_bay + 2 + (size_t)nodes;
    double first = NAN, latest = NAN, before = 0.0;
    int n = -1;
    for (int k = 0; k < 20000; ++k) {
        cz_elements_step(elements, 0);
        const double now = block->u[seen][0];
        if (before < 0.0 && now >= 0.0) {
            latest = (k - now / (now - before)) * step;
            first = n < 0 ? latest : first;
            ++n;
        }
        before = now;
    }
    cz_arena_free(&arena);
    return n / (latest - first);
}

void rows_of_element_frequencies(Rows *rows) {
    const double exact = 1072.679, two = pinned_pinned_frequency(2) / exact - 1.0;
    const double four = pinned_pinned_frequency(4) / exact - 1.0;
    const double eight = pinned_pinned_frequency(8) / exact - 1.0;
    const char *const what = "elements, nodes at the sleepers: frequency less the exact one";
    ROW(rows, "", two, -0.046, 0.0, 5e-4, "%s, 2 nodes a bay", what);
    ROW(rows, "", four, -0.0106, 0.0, 5e-4, "%s, 4 nodes a bay", what);
    ROW(rows, "", eight, -0.0026, 0.0, 2e-4, "%s, 8 nodes a bay", what);
    ROW(rows, "", log2(two / four), 2.0, 0.0, 0.15, "elements: order, 2 to 4 nodes a bay");
    ROW(rows, "", log2(four / eight), 2.0, 0.0, 0.03, "elements: order, 4 to 8 nodes a bay");
}

/* Assembled from elements and solved as one band, the static deflection is that of the closed form,
 * for any number of nodes and any place. */
void rows_of_element_statics(Rows *rows) {
    const CzRoadbed roadbed = usual_roadbed();
    const CzSeats seats = cz_seats(&roadbed, 2);
    for (int nodes = 1; nodes <= 8; nodes *= 2) {
        double largest = 0.0;
        for (double x = 0.0; x < 0.6; x += 0.07) {
            CzArena arena = {0};
            const double place[4] = {x, 0.0, 0.0, 0.0}, load[4] = {LOAD, 0.0, 0.0, 0.0};
            CzElements *elements = cz_elements_create(&seats, nodes, 18.26, 1e-4, 1, &arena);
            assert_non_null(elements);
            assert_true(cz_elements_lay(elements, 0, place, load, &arena));
            CzRailPoint point[4];
            cz_elements_deflection(elements, 0, place, point);
            const double exact = load[0] * cz_ring_flexibility(&seats, 62, x / 0.6);
            const double found = point[0].flexibility * load[0] - point[0].z;
            largest = fmax(largest, fabs(found / exact - 1.0));
            cz_arena_free(&arena);
        }
        ROW_UP_TO(rows, "", largest, 1e-9, "elements, %d nodes a bay: error of the statics", nodes);
    }
}

/* ---- an impact ---- */

#define IMPACT 1e-3      /* duration of the push [s] */
#define IMPACT_STEP 1e-5 /* [s] */
enum { N_IMPACT = 300 }; /* compared steps: the push, and 2 ms after it */
#define OFF_THE_SEATS 0.2

/* A wheel that hits the rail: half a sine of 100 kN. */
static double impact(int step) {
    const double phase = 0.5 * step * IMPACT_STEP / IMPACT;
    return phase < 0.5 ? 100e3 * cz_turned(phase).im : 0.0;
}

/* Deflection of the rail under it [m], by the modes up to a cut and their residual flexibility. */
static void impact_on_modes(double cut, double travel[N_IMPACT]) {
    const double at[4] = {OFF_THE_SEATS, 0.0, 0.0, 0.0}, none[4] = {0.0};
    CzArena arena = {0};
    const CzTrackModes *modes = usual_modes(18.26, 0, cut, &arena);
    CzTrackMotion *track = cz_track_motion_create(modes, IMPACT_STEP, 1, &arena);
    assert_non_null(track);
    assert_true(cz_track_lay(track, 0, at, none, &arena));
    for (int i = 0; i < N_IMPACT; ++i) {
        const double force[4] = {-impact(i), 0.0, 0.0, 0.0};
        double deflection[4], flexibility[4];
        cz_track_deflection(track, 0, at, deflection, flexibility);
        travel[i] = flexibility[0] * impact(i) - deflection[0];
        cz_track_step(track, &track->under[0], force);
    }
    cz_arena_free(&arena);
}

/* By finite elements, `nodes` to a bay. */
static void impact_on_elements(int nodes, double travel[N_IMPACT]) {
    const CzRoadbed roadbed = usual_roadbed();
    const CzSeats seats = cz_seats(&roadbed, 2);
    const double at[4] = {OFF_THE_SEATS, 0.0, 0.0, 0.0}, none[4] = {0.0};
    CzArena arena = {0};
    CzElements *elements = cz_elements_create(&seats, nodes, 18.26, IMPACT_STEP, 1, &arena);
    assert_non_null(elements);
    assert_true(cz_elements_lay(elements, 0, at, none, &arena));
    for (int i = 0; i < N_IMPACT; ++i) {
        const double force[4] = {-impact(i), 0.0, 0.0, 0.0};
        CzRailPoint point[4];
        cz_elements_deflection(elements, 0, at, point);
        travel[i] = point[0].flexibility * impact(i) - point[0].z;
        memcpy(elements->under[0].force, force, sizeof force);
        cz_elements_step(elements, 0);
    }
    cz_arena_free(&arena);
}

/* Largest difference of two methods over the largest value of the second. */
static double largest_difference(const double *travel, const double *other) {
    double largest = 0.0, size = 0.0;
    for (int i = 0; i < N_IMPACT; ++i) {
        largest = fmax(largest, fabs(travel[i] - other[i]));
        size = fmax(size, fabs(other[i]));
    }
    return largest / size;
}

void rows_of_impact(Rows *rows) {
    static const double cuts[] = {800.0, 1500.0, 3000.0};
    static double finest[N_IMPACT], travel[N_IMPACT];
    double most = 0.1; /* modes to 800 Hz leave 5 % of the statics; a millisecond doubles it */
    impact_on_elements(16, finest);
    for (int nodes = 4; nodes <= 8; nodes *= 2) {
        impact_on_elements(nodes, travel);
        /* At most the error of the wave with its nodes at the sleepers. */
        ROW_UP_TO(rows, "", largest_difference(travel, finest), 0.0106 * 16.0 / (nodes * nodes),
                  "impact, elements with %d nodes a bay: difference from 16", nodes);
    }
    for (size_t c = 0; c < sizeof cuts / sizeof cuts[0]; ++c) {
        impact_on_modes(cuts[c], travel);
        const double difference = largest_difference(travel, finest);
        ROW_UP_TO(
            rows, "", difference, most,
            "impact, modes to %g Hz with residual flexibility: difference from 16 nodes a bay",
            cuts[c]);
        most = 0.5 * difference; /* twice the cut: half of the residual flexibility, with half of
                                    the delay */
    }
}

/* ---- runs ---- */

static Collision run_on(const char *track, const char *file, double step) {
    char set[48];
    CzSimulateOptions options = cz_simulate_options_default();
    options.time_step = step;
    snprintf(set, sizeof set, "simulation.track=%s", track);
    Collision collision = collide_so(file, WITH(set), 0, &options);
    assert_completed(&collision);
    return collision;
}

static const char *const runs[] = {"problems/two-cars-25kmh.yaml", "problems/wall.yaml"};
enum { N_RUN = sizeof runs / sizeof runs[0] };

/* Compared results of a run on rails; the largest relative difference of two runs. */
static double difference_of_runs(const Collision *a, const Collision *b) {
    const int at = cz_model_colliding_interface(a->model);
    const CzInterfaceResult *p = &a->summary->interface[at], *q = &b->summary->interface[at];
    const CzVehicleResult *v = &a->summary->vehicle[0], *w = &b->summary->vehicle[0];
    const double pairs[][2] = {{p->peak_force, q->peak_force},
                               {p->shortening, q->shortening},
                               {p->energy, q->energy},
                               {v->max_pitch, w->max_pitch},
                               {v->link_force, w->link_force}};
    double largest = 0.0;
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; ++i)
        largest = fmax(largest, fabs(pairs[i][0] / pairs[i][1] - 1.0));
    return largest;
}

void rows_of_runs_on_rails(Rows *rows) {
    for (int i = 0; i < N_RUN; i++) {
        const char *name = runs[i] + strlen("problems/");
        Collision coarse = run_on("modal", runs[i], 1e-4), fine = run_on("modal", runs[i], 4e-5);
        ROW_UP_TO(rows, "", difference_of_runs(&coarse, &fine), 1e-3,
                  "%s, modal track: largest change from 0.1 to 0.04 ms", name);
        collision_free(&fine);
        Collision elements = run_on("fe", runs[i], 1e-4);
        ROW_UP_TO(rows, "", difference_of_runs(&coarse, &elements), 1e-3,
                  "%s: finite elements, largest difference from the modal track", name);
        collision_free(&elements);
        /* A fit within 0.3 % of the largest receptance changes a pitch, in which the track has a
         * share of less than 1 %, by less than 3e-5. */
        Collision fitted = run_on("receptance", runs[i], 1e-4);
        ROW_UP_TO(rows, "", difference_of_runs(&coarse, &fitted), 3e-5,
                  "%s: receptance track, largest difference from the modal track", name);
        collision_free(&fitted);
        collision_free(&coarse);
    }
}
