/* The receptance track: its fit, its static deflection, and the energy that it can return. */
#include "physics/collision.h"
#include "physics/roadbed.h"

#include "model/receptance.h"
#include "model/storage.h"

#define SPAN 18.26 /* of the cars of the catalogue [m] */

static const double spacings[] = {1.8, 2.56, 3.0};
enum { N_SPACING = sizeof spacings / sizeof spacings[0] };

static CzReceptance fitted(const CzTrackModes *modes, double axle_spacing, CzArena *arena) {
    CzReceptance receptance;
    CzError error = {0};
    if (cz_receptance_fit(modes, axle_spacing, arena, &receptance, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return receptance;
}

/* Between the samples, too, up to where waves of the rail with their nodes near the seats are
 * hardly damped: within the tolerance of the fit at the samples, relative to the largest
 * receptance. */
static void the_fit_is_within_its_error_of_the_modes(void **state) {
    (void)state;
    CzArena arena = {0};
    const CzTrackModes *modes = usual_modes(SPAN, 0, 0.0, &arena);
    for (int i = 0; i < N_SPACING; i++) {
        const CzReceptance receptance = fitted(modes, spacings[i], &arena);
        CzTrackSpectrum spectrum;
        assert_true(cz_track_spectrum(modes, spacings[i], &arena, &spectrum));
        for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
            double largest = 0.0, off = 0.0;
            for (double f = 1.0; f < 1000.0; f *= 1.013) {
                const CzComplex s = {0.0, 2.0 * CZ_PI * f};
                const CzComplex exact = cz_track_receptance(&spectrum, (CzPairMotion)motion, s);
                const CzComplex own = cz_fitted_receptance(&receptance, (CzPairMotion)motion, s);
                largest = fmax(largest, cz_complex_size(exact));
                off = fmax(off, cz_complex_size(cz_complex_difference(own, exact)));
            }
            assert_true(off < 3e-3 * largest);
        }
    }
    cz_arena_free(&arena);
}

/* Half as stiff or heavy, twice as stiff or heavy as the usual track, and other bogies. */
static void tracks_of_other_lines_are_fitted(void **state) {
    (void)state;
    const CzRoadbed usual = usual_roadbed();
    for (int i = 0; i < 64; i++) {
        CzArena arena = {0};
        CzRoadbed roadbed = usual;
        roadbed.pad_stiffness *= i & 1 ? 2.0 : 0.5;
        roadbed.pad_damping *= i & 2 ? 1.5 : 0.7;
        roadbed.sleeper_mass *= i & 4 ? 1.5 : 0.5;
        roadbed.ballast_mass *= i & 8 ? 1.5 : 0.7;
        roadbed.ballast_stiffness *= i & 16 ? 2.0 : 0.5;
        roadbed.subgrade_stiffness *= i & 32 ? 2.0 : 0.5;
        const CzTrackOptions options = cz_track_options_default(SPAN);
        CzTrackModes *modes = NULL;
        CzError error = {0};
        assert_int_equal(cz_track_build(&roadbed, &options, &arena, &modes, &error), CZ_OK);
        fitted(modes, spacings[i % N_SPACING], &arena);
        cz_arena_free(&arena);
    }
}

/* A track with hardly any damping: the default model is refused with the advice to use `modal`,
 * which runs, and a search on `modal` stays on it. */
static void a_track_that_cannot_be_fitted_is_refused_with_an_alternative(void **state) {
    (void)state;
#define UNDAMPED                                                                                   \
    "track.pad_damping_N_s_m=1000", "track.ballast_damping_N_s_m=0",                               \
        "track.subgrade_damping_N_s_m=0"
    const char *file = CZ_SOURCE_FOLDER "/problems/two-cars-25kmh.yaml";
    CzProblemOptions options = cz_problem_options_default();
    options.set = WITH("simulation.track=receptance", UNDAMPED);
    options.n_set = 4;
    CzProblem *problem = NULL;
    CzModel *model = NULL;
    CzError error = {0};
    assert_int_equal(cz_problem_read(file, &options, &problem, &error), CZ_OK);
    assert_int_equal(cz_model_build(problem, 0, &model, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "receptance"));
    assert_non_null(strstr(error.help, "track: modal"));
    cz_problem_free(problem);
    CzSimulateOptions brief = cz_simulate_options_default();
    brief.brief = true;
    brief.track = CZ_TRACK_USE_SEARCH;
    brief.record = false;
    for (int i = 0; i < 2; i++) {
        CzSimulateOptions simulate = i == 0 ? cz_simulate_options_default() : brief;
        Collision collision = collide_so("problems/two-cars-25kmh.yaml",
                                         WITH("simulation.track=modal", UNDAMPED), 0, &simulate);
        assert_true(collision.summary->interface[0].peak_force > 0.0);
        collision_free(&collision);
    }
}

/* As on the modal track: the error of the static deflection with four powers of a cosine
 * (test_track.c). */
static void one_wheel_at_rest_deflects_the_track_as_its_statics(void **state) {
    (void)state;
    CzArena arena = {0};
    const CzTrackModes *modes = usual_modes(SPAN, 0, 0.0, &arena);
    for (int i = 0; i < N_SPACING; i++) {
        const CzReceptance receptance = fitted(modes, spacings[i], &arena);
        const CzTrackFlexibility beside = cz_receptance_flexibility(modes, &receptance, 0.0);
        const CzComplex rest = {0.0, 0.0};
        const double of_modes = 0.5 * (cz_fitted_receptance(&receptance, CZ_PAIR_BOUNCE, rest).re +
                                       cz_fitted_receptance(&receptance, CZ_PAIR_PITCH, rest).re);
        for (double place = 0.0; place < 1.0; place += 0.09) {
            const double exact = cz_ring_flexibility(&modes->seats, modes->n_seat, place);
            const double own = of_modes + cz_track_flexibility_at(&beside, cz_turned(place).re);
            assert_near(own, exact, 2e-5, 0.0);
        }
    }
    cz_arena_free(&arena);
}

/* ---- energy ---- */

/* A mass on a spring and a damper: all energy that is not yet dissipated can be extracted, if
 * forces act fast compared with its decay, which takes 1 / 500 of a second here and a millionth in
 * a step. */
static void a_swinging_mass_stores_its_energy(void **state) {
    (void)state;
    const double k = 4e7, m = 50.0, decay = 500.0, step = 1e-6, w = sqrt(k / m - decay * decay);
    const CzComplex lambda = {-decay, w};
    const CzComplex g = cz_complex_root((CzComplex){0.0, -1.0 / (w * m)});
    const CzComplex flight = cz_complex_exponential(cz_complex_scaled(step, lambda));
    const CzComplex kicked =
        cz_complex_product(cz_complex_ratio((CzComplex){flight.re - 1.0, flight.im}, lambda), g);
    const double a[4] = {flight.re, -flight.im, flight.im, flight.re};
    const double b[2] = {kicked.re, kicked.im}, c[2] = {g.re, -g.im};
    double storage[4];
    CzArena scratch = {0};
    assert_true(cz_available_storage(2, a, b, c, storage, &scratch));
    cz_arena_free(&scratch);
    for (double angle = 0.0; angle < 6.0; angle += 0.7) {
        const CzComplex y = {cos(angle), sin(angle)};
        const double z = cz_complex_product(g, y).re;
        const double rate = cz_complex_product(cz_complex_product(lambda, g), y).re;
        const double energy =
            storage[0] * y.re * y.re + 2.0 * storage[1] * y.re * y.im + storage[3] * y.im * y.im;
        assert_near(energy, 0.5 * (k * z * z + m * rate * rate), 2e-3, 0.0);
    }
}

/* The fitted modes of one motion under random forces: the energy received is never less than the
 * stored energy, which is never negative. */
static void fitted_modes_return_no_more_energy_than_they_received(void **state) {
    (void)state;
    CzArena arena = {0};
    const CzTrackModes *modes = usual_modes(SPAN, 0, 0.0, &arena);
    const CzReceptance receptance = fitted(modes, 2.56, &arena);
    const double step = 5e-5;
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
        const struct CzPairModes *own = &receptance.motion[motion];
        double x[2 * CZ_MAX_PAIR_MODES] = {0.0}, taken = 0.0, z = 0.0, force = 0.0;
        uint64_t random = 12345;
        for (int i = 0; i < 40000; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            const double draw = (double)(random >> 11) / 9007199254740992.0 - 0.5;
            force = i < 20000 ? 2e5 * draw : 0.99 * force + 2e4 * draw; /* hard, then slow */
            double next = 0.0, stored = 0.0;
            for (int k = 0; k < own->n; k++) {
                const CzComplex lambda = own->mode[k].lambda, g = own->mode[k].g;
                const CzComplex flight = cz_complex_exponential(cz_complex_scaled(step, lambda));
                const CzComplex held =
                    cz_complex_ratio((CzComplex){flight.re - 1.0, flight.im}, lambda);
                const CzComplex y = {x[2 * k], x[2 * k + 1]};
                const CzComplex after =
                    cz_complex_sum(cz_complex_product(flight, y),
                                   cz_complex_scaled(force, cz_complex_product(held, g)));
                x[2 * k] = after.re;
                x[2 * k + 1] = after.im;
                next += cz_complex_product(g, after).re;
            }
            taken += force * (next - z);
            z = next;
            for (int j = 0; j < 2 * own->n; j++)
                for (int k = 0; k < 2 * own->n; k++)
                    stored += x[j] * own->storage[2 * own->n * j + k] * x[k];
            /* Rounding, relative to the energy received and returned. */
            assert_true(stored > -1e-9 * taken);
            assert_true(stored < (1.0 + 1e-6) * taken);
        }
    }
    cz_arena_free(&arena);
}

/* ---- under cars ---- */

/* Bogies of two axle spacings side by side in one block of lanes; the track has a share of less
 * than 1 % in a pitch, and the fit is within 0.3 %. */
static void cars_with_other_bogies_have_their_own_track(void **state) {
    (void)state;
    const char *const track[] = {"simulation.track=modal", "simulation.track=receptance"};
    double pitch[2][2];
    for (int i = 0; i < 2; i++) {
        Collision collision =
            collide("problems/two-cars-25kmh.yaml",
                    WITH(track[i], "trains.B.vehicles[0].bogie.axle_spacing_m=1.9"), 0);
        assert_completed(&collision);
        for (int car = 0; car < 2; car++)
            pitch[i][car] = collision.summary->vehicle[car].max_pitch;
        collision_free(&collision);
    }
    for (int car = 0; car < 2; car++)
        assert_near(pitch[1][car], pitch[0][car], 3e-5, 0.0);
    assert_true(fabs(pitch[0][0] / pitch[0][1] - 1.0) > 1e-4);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_fit_is_within_its_error_of_the_modes),
        cmocka_unit_test(tracks_of_other_lines_are_fitted),
        cmocka_unit_test(a_track_that_cannot_be_fitted_is_refused_with_an_alternative),
        cmocka_unit_test(one_wheel_at_rest_deflects_the_track_as_its_statics),
        cmocka_unit_test(a_swinging_mass_stores_its_energy),
        cmocka_unit_test(fitted_modes_return_no_more_energy_than_they_received),
        cmocka_unit_test(cars_with_other_bogies_have_their_own_track),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
