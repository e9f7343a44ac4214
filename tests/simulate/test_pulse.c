/* Values of a collision pulse against closed forms. */
#include "support/check.h"

#include "simulate/pulse.h"

#define G 9.80665
#define STEP 1e-3
enum { N = 1001 };

static double speed[N], force[N];

static CzPulse a_pulse(void) {
    return (CzPulse){.n_sample = N,
                     .n_step = N,
                     .step = STEP,
                     .time_step = STEP,
                     .speed = speed,
                     .step_speed = speed,
                     .force = force};
}

/* Speed from 20 m/s under a deceleration of [g], whose integral is exact at the samples. */
static CzPulse decelerated(double (*fallen)(double time)) {
    for (int i = 0; i < N; i++) {
        speed[i] = 20 - G * fallen(i * STEP);
        force[i] = -1;
    }
    return a_pulse();
}

/* Integrals of the deceleration [s]. */
static double of_5_g(double time) {
    return 5 * time;
}
static double of_7_g_5(double time) {
    return 7.5 * time;
}
/* A triangle of 8 g over 250 ms. */
static double of_triangle(double time) {
    const double half = 0.125, left = fmax(0.25 - time, 0);
    return time < half ? 4 * time * time / half : 1 - 4 * left * left / half;
}

/* The published numbers have two digits after the point. */
static void assert_impacts(const CzPulse *pulse, const double expected[3]) {
    const double distance[] = {0.60, 0.75, 0.762};
    for (int i = 0; i < 3; i++) {
        double time;
        assert_near(cz_pulse_secondary_impact(pulse, distance[i], &time), expected[i], 0, 0.005);
        assert_in_range((long)(1e6 * time), 1, 1000000);
    }
}

/* A constant deceleration a gives sqrt(2 a d) exactly, but for the rounding of the sums. */
static void the_secondary_impact_is_that_of_a_free_particle(void **state) {
    (void)state;
    CzPulse pulse = decelerated(of_triangle);
    assert_near(speed[0] - speed[N - 1], 9.81, 0, 0.005);
    assert_impacts(&pulse, (double[]){8.40, 9.03, 9.07});
    pulse = decelerated(of_7_g_5);
    assert_impacts(&pulse, (double[]){9.39, 10.50, 10.59});
    pulse = decelerated(of_5_g);
    assert_impacts(&pulse, (double[]){7.67, 8.58, 8.64});
    for (int i = 1; i <= 10; i++) {
        double time;
        const double impact = cz_pulse_secondary_impact(&pulse, 0.1 * i, &time);
        assert_near(impact, sqrt(2 * 5 * G * 0.1 * i), 1e-9, 0);
        assert_near(time, impact / (5 * G), 1e-9, 0);
    }
}

/* An occupant of a vehicle that is pushed from behind meets the seat back. */
static void the_secondary_impact_has_no_sign(void **state) {
    (void)state;
    const CzPulse pulse = decelerated(of_5_g);
    for (int i = 0; i < N; i++)
        speed[i] = 40 - speed[i];
    assert_impacts(&pulse, (double[]){7.67, 8.58, 8.64});
}

/* A change of 2 m/s within 20 ms, and back: the particle comes to rest in the vehicle. */
static void the_largest_velocity_counts_when_the_distance_is_not_reached(void **state) {
    (void)state;
    for (int i = 0; i < N; i++)
        speed[i] = i <= 20 ? 10 - 0.1 * i : fmin(8 + 0.1 * (i - 20), 10);
    const CzPulse pulse = a_pulse();
    double time;
    assert_near(cz_pulse_secondary_impact(&pulse, 0.75, &time), 2, 1e-12, 0);
    assert_near(time, 0.020, 1e-12, 0);
    assert_true(cz_pulse_secondary_impact(&pulse, 0.03, &time) < 2);
}

/* ---- windows ---- */

/* Windows of a constant net force on 40 t: from, to [ms], force [kN]. */
typedef struct {
    int from, to;
    double force;
} Push;

static CzPulse pushed(int n, const Push *push) {
    for (int i = 0; i < N; i++) {
        force[i] = 0;
        for (int k = 0; k < n; k++)
            force[i] = i >= push[k].from && i < push[k].to ? 1e3 * push[k].force : force[i];
        speed[i] = i == 0 ? 0 : speed[i - 1] + force[i - 1] * STEP / 40e3;
    }
    return a_pulse();
}

static int n_windows(const CzPulse *pulse, double floor) {
    CzContactWindow window;
    int n = 0, next = 0;
    while (cz_pulse_next_contact(pulse, floor * cz_pulse_largest_force(pulse), &next, &window))
        n++;
    return n;
}

/* 5 g on 40 t is 1961 kN. */
static void a_constant_force_has_one_window_with_the_mean_of_its_force(void **state) {
    (void)state;
    const CzPulse pulse = pushed(1, (Push[]){{100, 300, -1961.33}});
    double window[2];
    assert_near(cz_pulse_contact_mean(&pulse, 0.01, 0.03, window), 5 * G, 1e-9, 0);
    assert_near(window[0], 0.1, 1e-12, 0);
    assert_near(window[1], 0.3, 1e-12, 0);
    assert_near(cz_pulse_sliding_mean(&pulse, 0.12, window), 5 * G, 1e-9, 0);
    assert_int_equal(n_windows(&pulse, 0.01), 1);
}

/* Three windows of a trailing car: the shortest has the largest mean, and counts when it is asked
 * for. A sliding window of 120 ms holds several of them. */
static void every_contact_window_is_found_and_the_largest_mean_counts(void **state) {
    (void)state;
    const CzPulse pulse = pushed(3, (Push[]){{100, 150, 840}, {160, 180, 1600}, {200, 300, 400}});
    double window[2];
    assert_int_equal(n_windows(&pulse, 0.01), 3);
    assert_near(cz_pulse_contact_mean(&pulse, 0.01, 0.03, window), 21, 1e-9, 0);
    assert_near(window[0], 0.100, 1e-12, 0);
    CzArena arena = {0};
    CzPulse listed = pulse;
    assert_true(cz_pulse_list_windows(&listed, &arena));
    assert_int_equal(listed.n_window, 2); /* 21 and 40 m/s2, but not 10 */
    assert_near(listed.window[0].mean, 21, 1e-9, 0);
    assert_near(listed.window[1].from, 0.160, 1e-12, 0);
    assert_near(listed.window[1].to, 0.180, 1e-12, 0);
    cz_arena_free(&arena);
    assert_near(cz_pulse_contact_mean(&pulse, 0.01, 0, window), 40, 1e-9, 0);
    assert_near(window[1], 0.180, 1e-12, 0);
    /* 1.05 + 0.8 + 0.2 m/s from 100 to 220 ms */
    assert_near(cz_pulse_sliding_mean(&pulse, 0.12, window), 2.05 / 0.12, 1e-9, 0);
    assert_near(window[0], 0.100, 1e-12, 0);
    /* the largest over 20 ms is the force of 1600 kN alone */
    assert_near(cz_pulse_sliding_mean(&pulse, 0.02, window), 40, 1e-9, 0);
}

/* Ten time steps to a sample: a force from 50.4 to 77.1 ms counts with its own duration, and no
 * window is too short to count. */
static void a_window_begins_and_ends_with_a_time_step(void **state) {
    (void)state;
    CzPulse pulse = pushed(2, (Push[]){{504, 771, 1000}, {771, 1000, 400}});
    pulse.time_step = 0.1 * STEP;
    for (int i = 0; i < N; i++)
        speed[i] *= 0.1;
    double window[2];
    assert_near(cz_pulse_contact_mean(&pulse, 0.5, CZ_PULSE_SHORTEST, window), 25, 1e-9, 0);
    assert_near(window[0], 0.0504, 1e-12, 0);
    assert_near(window[1], 0.0771, 1e-12, 0);
}

/* A weak push between two strong ones ends the window only above the floor. */
static void the_floor_decides_where_a_window_ends(void **state) {
    (void)state;
    const CzPulse pulse = pushed(3, (Push[]){{100, 200, 1000}, {200, 300, 15}, {300, 400, 1000}});
    double window[2];
    assert_int_equal(n_windows(&pulse, 0.01), 1);
    assert_int_equal(n_windows(&pulse, 0.02), 2);
    assert_near(cz_pulse_contact_mean(&pulse, 0.01, 0, window), 2.015e6 * 0.1 / 40e3 / 0.3, 1e-9,
                0);
    assert_near(cz_pulse_contact_mean(&pulse, 0.02, 0, window), 25, 1e-9, 0);
}

/* The speed is a sum of rounded terms. */
static void a_change_of_sign_begins_a_window(void **state) {
    (void)state;
    const CzPulse pulse = pushed(2, (Push[]){{100, 200, 1000}, {200, 300, -400}});
    double window[2];
    assert_int_equal(n_windows(&pulse, 0.01), 2);
    assert_near(cz_pulse_contact_mean(&pulse, 0.01, 0, window), 25, 1e-9, 0);
}

static void a_vehicle_without_contact_has_no_window(void **state) {
    (void)state;
    const CzPulse pulse = pushed(0, NULL);
    double window[2] = {-1, -1};
    assert_int_equal(n_windows(&pulse, 0.01), 0);
    assert_near(cz_pulse_contact_mean(&pulse, 0.01, 0, window), 0, 0, 0);
    assert_near(cz_pulse_sliding_mean(&pulse, 0.12, window), 0, 0, 0);
    assert_near(window[0], -1, 0, 0);
}

/* ---- filtered peak ---- */

/* A long constant deceleration passes the filter; a spike of one sample hardly does. */
static void the_filtered_peak_keeps_a_plateau_and_flattens_a_spike(void **state) {
    (void)state;
    CzPulse pulse = decelerated(of_5_g);
    double peak;
    assert_int_equal(cz_pulse_filtered_peak(&pulse, 60, &peak), CZ_OK);
    assert_near(peak, 5 * G, 1e-9, 0);
    pulse = pushed(1, (Push[]){{500, 501, 4000}});
    assert_int_equal(cz_pulse_filtered_peak(&pulse, 60, &peak), CZ_OK);
    assert_in_range((long)peak, 5, 30);
    pulse.step = 5e-3; /* too sparse for the class */
    assert_int_equal(cz_pulse_filtered_peak(&pulse, 60, &peak), CZ_OK);
    assert_true(isnan(peak));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_secondary_impact_is_that_of_a_free_particle),
        cmocka_unit_test(the_secondary_impact_has_no_sign),
        cmocka_unit_test(the_largest_velocity_counts_when_the_distance_is_not_reached),
        cmocka_unit_test(a_constant_force_has_one_window_with_the_mean_of_its_force),
        cmocka_unit_test(every_contact_window_is_found_and_the_largest_mean_counts),
        cmocka_unit_test(a_window_begins_and_ends_with_a_time_step),
        cmocka_unit_test(the_floor_decides_where_a_window_ends),
        cmocka_unit_test(a_change_of_sign_begins_a_window),
        cmocka_unit_test(a_vehicle_without_contact_has_no_window),
        cmocka_unit_test(the_filtered_peak_keeps_a_plateau_and_flattens_a_spike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
