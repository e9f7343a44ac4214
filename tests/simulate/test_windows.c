/* The worst window of at least 120 ms equals the worst of all windows, computed one by one. */
#include "physics/collision.h"
#include "support/shipped.h"

#define SHORTEST 120 /* samples of 1 ms */

/* All windows up to twice the shortest length, of the recorded speed. */
static void assert_worst_window(const Collision *collision, int car) {
    const CzVehicleResult *vehicle = &collision->summary->vehicle[car];
    const double *speed = cz_run_channel(collision->run, CZ_CHANNEL_BODY_SPEED, car);
    const int n = n_sample(collision);
    double worst = 0.0, from = 0.0, to = 0.0;
    for (int length = SHORTEST; length <= 2 * SHORTEST; length++) {
        for (int start = 0; start + length < n; start++) {
            const double mean = fabs(speed[start + length] - speed[start]) / (length * 1e-3);
            if (mean > worst) {
                worst = mean;
                from = start * 1e-3;
                to = (start + length) * 1e-3;
            }
        }
    }
    assert_near(vehicle->mean_deceleration_120ms, worst, 1e-12, 0.0);
    assert_near(vehicle->window_120ms[0], from, 0.0, 1e-9);
    assert_near(vehicle->window_120ms[1], to, 0.0, 1e-9);
}

static void check_cars(const char *file, const char *const *set) {
    Collision collision = collide(file, set, 0);
    assert_completed(&collision);
    for (int car = 0; car < collision.summary->n_vehicle; car++)
        assert_worst_window(&collision, car);
    collision_free(&collision);
}

/* The largest mean over the windows of net force of the first of two cars, from a recording of
 * every step. */
static double mean_of_steps(const Collision *collision, double step) {
    const double *speed = cz_run_channel(collision->run, CZ_CHANNEL_BODY_SPEED, 0);
    const double *force = cz_run_channel(collision->run, CZ_CHANNEL_INTERFACE_FORCE, 0);
    const int n = n_sample(collision);
    double peak = 0.0, largest = 0.0;
    for (int i = 0; i < n; i++)
        peak = fmax(peak, fabs(force[i]));
    for (int from = 0, to; from < n - 1; from = to) {
        for (to = from; to < n - 1 && fabs(force[to]) > 0.01 * peak; to++)
            continue;
        if (to > from)
            largest = fmax(largest, fabs(speed[to] - speed[from]) / ((to - from) * step));
        else
            to++;
    }
    return largest;
}

/* Samples of 1 ms miss up to the first and the last millisecond of a window. */
static void contact_windows_count_every_step_whatever_is_recorded(void **state) {
    (void)state;
    static const char file[] = "problems/first-collision.yaml";
    Collision fine = collide(file, WITH("simulation.output_step_ms=0.1"), 0);
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = false;
    Collision bare = collide_so(file, AS_WRITTEN, 0, &options);
    const double step = fine.summary->time_step, mean = mean_of_steps(&fine, step);
    assert_near(step, 1e-4, 1e-12, 0);
    for (int i = 0; i < 2; i++) {
        const CzVehicleResult *vehicle = &(i == 0 ? &fine : &bare)->summary->vehicle[0];
        assert_near(vehicle->mean_deceleration_contact, mean, 1e-12, 0);
    }
    collision_free(&fine);
    collision_free(&bare);
}

static void the_worst_window_is_found_in_a_short_run_and_in_long_ones(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++) {
        char file[SHIPPED_SIZE + 16];
        snprintf(file, sizeof file, "problems/%s", shipped.name[i]);
        check_cars(file, WITH("simulation.output_step_ms=1", "simulation.duration_s=1"));
    }
    check_cars("problems/first-collision.yaml", WITH("simulation.output_step_ms=1"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_worst_window_is_found_in_a_short_run_and_in_long_ones),
        cmocka_unit_test(contact_windows_count_every_step_whatever_is_recorded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
