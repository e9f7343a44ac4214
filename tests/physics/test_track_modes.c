/* The track's statics and modes against closed forms and an independent assembly of the equations.
 *
 * Zhai's set per rail, CHN60 on sleepers 0.6 m apart, shear coefficient 0.40.
 */
#include "physics/rails.h"
#include "physics/roadbed.h"

#include "model/track_block.h"

/* ---- statics ---- */

static void a_continuous_support_is_winklers_foundation(void **state) {
    (void)state;
    assert_rows_of(rows_of_winkler);
}

static void discrete_seats_deflect_as_published(void **state) {
    (void)state;
    assert_rows_of(rows_of_discrete_seats);
}

static void seats_carry_the_whole_load(void **state) {
    (void)state;
    const CzRoadbed roadbed = usual_roadbed();
    const CzSeats seats = cz_seats(&roadbed, 2);
    for (double place = 0.0; place < 1.0; place += 0.125) {
        double sum = 0.0;
        for (int seat = 0; seat < 46; ++seat)
            sum += cz_ring_seat_share(&seats, 46, place, seat);
        assert_near(sum, 1.0, ROUNDING_OF_A_SUM, 0.0);
    }
}

/* ---- free waves ---- */

static void rail_waves_have_timoshenkos_frequencies(void **state) {
    (void)state;
    assert_rows_of(rows_of_rail_waves);
}

static void both_branches_of_a_wave_deflect_as_its_statics(void **state) {
    (void)state;
    const CzRoadbed roadbed = usual_roadbed();
    const CzSeats seats = cz_seats(&roadbed, 2);
    for (double k = 0.05; k < 50.0; k *= 1.7) {
        const CzRailWave wave = cz_rail_wave(&seats, k);
        const double travel =
            (wave.share / wave.bending + (1.0 - wave.share) / wave.shear) / seats.mass;
        assert_near(travel, 1.0 / (seats.bending * k * k * k * k) + 1.0 / (seats.shear * k * k),
                    ROUNDING_OF_A_SUM, 0.0);
    }
}

static void the_pinned_pinned_mode_is_among_the_modes(void **state) {
    (void)state;
    assert_rows_of(rows_of_pinned_mode);
}

/* ---- modes ---- */

/* P(s) of a block, straight from the masses, springs and dampers: det of (pad, sleeper, ballast)
 * with the rail waves condensed equals F. Here: residual of all equations for the mode's
 * amplitudes, each relative to its own terms. */
static double residual_of(const CzTrackBlock *block, CzComplex s) {
    const CzSeats *seats = block->seats;
    const CzComplex s2 = cz_complex_product(s, s);
    const CzTrackBelow below = cz_track_below(block, s);
    double largest = 0.0;
    /* f = 1. Rail at a seat: sum of the waves and the remainder; pad: elongation = f / (k + s c).
     */
    CzComplex rail = {-block->rest, 0.0};
    for (int w = 0; w < block->n_wave; ++w)
        rail = cz_complex_difference(
            rail, cz_complex_scaled(block->crests, cz_track_wave_answer(block, w, s)));
    const CzComplex pad = {seats->pad_k + seats->pad_c * s.re, seats->pad_c * s.im};
    const CzComplex pull = cz_complex_product(pad, cz_complex_difference(rail, below.sleeper));
    largest = fmax(largest, cz_complex_size(cz_complex_difference(pull, (CzComplex){1.0, 0.0})));
    /* Sleeper and ballast block. */
    const CzComplex upper = {seats->upper_k + seats->upper_c * s.re, seats->upper_c * s.im};
    const CzComplex lower = {seats->lower_k + seats->lower_c * s.re, seats->lower_c * s.im};
    const CzComplex between =
        cz_complex_product(upper, cz_complex_difference(below.sleeper, below.ballast));
    const CzComplex inertia =
        cz_complex_scaled(seats->sleeper, cz_complex_product(s2, below.sleeper));
    CzComplex sum = cz_complex_difference((CzComplex){1.0, 0.0}, between);
    largest = fmax(largest, cz_complex_size(cz_complex_difference(sum, inertia)));
    sum = cz_complex_difference(between, cz_complex_product(lower, below.ballast));
    sum = cz_complex_difference(
        sum, cz_complex_scaled(seats->ballast, cz_complex_product(s2, below.ballast)));
    return fmax(largest, cz_complex_size(sum) / fmax(1.0, cz_complex_size(between)));
}

/* Every root solves the equations; none is found twice; they come in pairs to the left. */
static void check_roots(const CzRoadbed *roadbed) {
    const CzSeats seats = cz_seats(roadbed, 2);
    for (int j = 0; j <= 23; ++j) {
        const CzTrackBlock block = cz_track_block(&seats, 46, j);
        CzComplex root[CZ_BLOCK_ROOTS];
        const int n = cz_track_roots(&block, root);
        assert_int_equal(n, 2 * block.n_wave + 5);
        CzComplex mass = {0.0, 0.0};
        for (int i = 0; i < n; ++i) {
            assert_true(root[i].re < 0.0);
            assert_near(residual_of(&block, root[i]), 0.0, 0.0, 1e-8);
            const CzComplex h = cz_track_wave_answer(&block, 0, root[i]);
            const CzComplex slope = cz_track_secular(&block, root[i]).slope;
            mass = cz_complex_sum(
                mass,
                cz_complex_ratio(cz_complex_product(cz_complex_product(h, h), root[i]), slope));
            for (int m = 0; m < i; ++m)
                assert_true(cz_complex_size(cz_complex_difference(root[i], root[m])) >
                            1e-6 * cz_complex_size(root[i]));
        }
        /* A load accelerates a wave by the wave's mass. */
        assert_near(-block.crests * mass.re, block.wave[0].share / block.mass[0], 1e-11, 0.0);
        assert_near(mass.im, 0.0, 0.0, 1e-11 / block.mass[0] / block.crests);
    }
}

static void roots_solve_the_equations_of_rail_pads_sleepers_and_ballast(void **state) {
    (void)state;
    const CzRoadbed usual = usual_roadbed();
    check_roots(&usual);
    /* Soft and hard pads, hardly damped and overdamped; stiff ballast. */
    static const double factor[][3] = {
        {0.05, 0.1, 1.0}, {20.0, 1.0, 1.0}, {1.0, 10.0, 1.0}, {1.0, 0.02, 1.0}, {3.0, 0.3, 20.0}};
    for (size_t i = 0; i < sizeof factor / sizeof factor[0]; ++i) {
        CzRoadbed other = usual;
        other.pad_stiffness *= factor[i][0];
        other.pad_damping *= factor[i][1];
        other.ballast_stiffness *= factor[i][2];
        check_roots(&other);
    }
}

static void cars_at_rest_follow_the_closed_form(void **state) {
    (void)state;
    assert_rows_of(rows_of_rest);
}

static void modes_converge_to_the_statics(void **state) {
    (void)state;
    assert_rows_of(rows_of_mode_convergence);
}

static void the_models_of_a_run_deflect_as_published(void **state) {
    (void)state;
    assert_rows_of(rows_of_running_tracks);
}

/* Below 200 Hz, where no half wave is as short as a bay, seats act as a continuous support. */
static void a_harmonic_force_finds_the_track_of_continuous_layers(void **state) {
    (void)state;
    assert_rows_of(rows_of_receptance);
}

static void an_impact_deflects_modes_and_elements_equally(void **state) {
    (void)state;
    assert_rows_of(rows_of_impact);
}

static void shipped_problems_keep_their_energy_balance_on_rails(void **state) {
    (void)state;
    assert_rows_of(rows_of_runs_on_rails);
}

static void a_track_with_overdamped_modes_is_built(void **state) {
    (void)state;
    CzRoadbed roadbed = usual_roadbed();
    roadbed.subgrade_damping = 1e6;
    roadbed.ballast_shear_stiffness = 7.84e7;
    roadbed.ballast_shear_damping = 8e4;
    const CzTrackOptions options = cz_track_options_default(18.0);
    CzArena arena = {0};
    CzTrackModes *modes = NULL;
    CzError error = {0};
    assert_int_equal(cz_track_build(&roadbed, &options, &arena, &modes, &error), CZ_OK);
    int n_real = 0;
    for (int k = 0; k < modes->n_group; ++k)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i)
            n_real += modes->group[k].lambda[i].im == 0.0 && modes->group[k].lambda[i].re < 0.0;
    assert_true(n_real > 10);
    cz_arena_free(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_continuous_support_is_winklers_foundation),
        cmocka_unit_test(discrete_seats_deflect_as_published),
        cmocka_unit_test(seats_carry_the_whole_load),
        cmocka_unit_test(rail_waves_have_timoshenkos_frequencies),
        cmocka_unit_test(both_branches_of_a_wave_deflect_as_its_statics),
        cmocka_unit_test(the_pinned_pinned_mode_is_among_the_modes),
        cmocka_unit_test(roots_solve_the_equations_of_rail_pads_sleepers_and_ballast),
        cmocka_unit_test(cars_at_rest_follow_the_closed_form),
        cmocka_unit_test(modes_converge_to_the_statics),
        cmocka_unit_test(the_models_of_a_run_deflect_as_published),
        cmocka_unit_test(a_harmonic_force_finds_the_track_of_continuous_layers),
        cmocka_unit_test(an_impact_deflects_modes_and_elements_equally),
        cmocka_unit_test(shipped_problems_keep_their_energy_balance_on_rails),
        cmocka_unit_test(a_track_with_overdamped_modes_is_built),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
