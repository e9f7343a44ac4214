/* Resistance along the track: brakes, rolling resistance, the friction jaws of a buffer stop; and
 * the damping of crush zones without end mass. */
#include "physics/collision.h"

#include "model/fill.h"

#define GRAVITY 9.80665
static const char *const two_masses = "tests/physics/cases/drag.yaml";
static const char *const two_cars = "tests/physics/cases/drag-of-full-cars.yaml";
static const char *const damped = "tests/physics/cases/damped-zone.yaml";
static const char *const slide = "tests/physics/cases/slide.yaml";

/* ---- brakes ---- */

/* v^2 / (2 a): the travel of a mass that a constant drag of `share` of its weight brings to rest;
 * it stays there. All its energy is dissipated at the wheels. */
static void assert_stops(const char *setting, double share) {
    Collision collision = collide(two_masses, WITH(setting, "trains.B.brake.ratio=0.1"), 0);
    const int last = n_sample(&collision) - 1;
    const double travel = 10.0 * 10.0 / (2.0 * share * GRAVITY);
    const double *x = channel(&collision, CZ_CHANNEL_BODY_DISPLACEMENT, "A1"),
                 *v = channel(&collision, CZ_CHANNEL_BODY_SPEED, "A1");
    assert_near(x[last], travel, 1e-4, 0.0);
    assert_near(v[last], 0.0, 0.0, 1e-9);
    assert_near(x[last], x[last - 500], 0.0, 1e-9);
    for (int i = 1; i <= last; i++)
        assert_true(v[i] <= v[i - 1]);
    assert_true(collision.summary->energy.balance_error < 1e-5);
    collision_free(&collision);
}

static void a_braked_mass_stops_at_its_braking_distance_and_stays_there(void **state) {
    (void)state;
    assert_stops("trains.A.brake.ratio=0.25", 0.25);
    assert_stops("trains.A.brake.ratio=0.3", 0.3);
}

/* Locked wheels slide: mu(v) = mu_s + (mu_p - mu_s) / (1 + v / w) gives
 * t = (v / mu_s + w (1 - mu_p / mu_s) ln(1 + mu_s v / (mu_p w)) / mu_s) / g. */
static void brakes_beyond_the_friction_lock_the_wheels(void **state) {
    (void)state;
    const double peak = 0.3, sliding = 0.1, w = 3.0, v = 10.0;
    const double time =
        (v / sliding + w * (1.0 - peak / sliding) * log(1.0 + sliding * v / (peak * w)) / sliding) /
        GRAVITY;
    Collision collision = collide(two_masses, WITH("trains.A.brake.ratio=1"), 0);
    const double *speed = channel(&collision, CZ_CHANNEL_BODY_SPEED, "A1");
    int i = 0;
    while (speed[i] > 1e-3)
        i++;
    assert_near(i * 1e-3, time, 0.0, 2e-3); /* two samples */
    collision_free(&collision);
}

static void the_share_of_braked_axles_is_one_of_the_weight(void **state) {
    (void)state;
    Collision all = collide(two_masses, WITH("trains.A.brake.ratio=0.1"), 0);
    Collision half =
        collide(two_masses, WITH("trains.A.brake.ratio=0.2", "trains.A.brake.axle_share=0.5"), 0);
    assert_near(half.summary->vehicle[0].final_speed, all.summary->vehicle[0].final_speed,
                ROUNDING_OF_A_SUM, 0.0);
    collision_free(&all);
    collision_free(&half);
}

/* A share that is not a whole number of axles brakes the last one in part. */
static void a_share_of_braked_axles_is_not_rounded(void **state) {
    (void)state;
    static const char *const braked[][2] = {
        {"trains.A.brake.ratio=0.2", "trains.A.brake.axle_share=0.1"},
        {"trains.A.brake.ratio=0.05", "trains.A.brake.axle_share=0.4"}};
    for (int i = 0; i < 2; i++) {
        Collision all = collide(two_cars, WITH("trains.A.brake.ratio=0.02"), 0);
        Collision part = collide(two_cars, WITH(braked[i][0], braked[i][1]), 0);
        assert_near(10.0 - part.summary->vehicle[0].final_speed,
                    10.0 - all.summary->vehicle[0].final_speed, 2e-2, 0.0);
        collision_free(&all);
        collision_free(&part);
    }
}

/* ---- rolling resistance ---- */

/* A single mass slows down by f g, a full car by less, as its wheels turn:
 * f m g / (m + 4 J / r^2). */
static void rolling_resistance_slows_every_kind_of_car(void **state) {
    (void)state;
    static const struct {
        const char *file, *a, *b;
    } cases[] = {{two_masses, "trains.A.vehicles.A1.rolling_resistance_N_kN=4",
                  "trains.B.vehicles.B1.rolling_resistance_N_kN=4"},
                 {two_cars, "trains.A.vehicles.A1.rolling_resistance_N_kN=4",
                  "trains.B.vehicles.B1.rolling_resistance_N_kN=4"}};
    for (int i = 0; i < 2; i++) {
        Collision collision =
            collide(cases[i].file, WITH(cases[i].a, cases[i].b, "simulation.duration_s=4"), 0);
        int n_vehicle;
        const CzVehicle *vehicle = cz_problem_vehicles(collision.problem, &n_vehicle);
        const double radius = vehicle->bogie.wheel_radius;
        const double turning =
            i == 0 ? 0.0 : 4.0 * vehicle->bogie.wheelset_inertia / (radius * radius);
        const double a = 0.004 * GRAVITY * vehicle->mass / (vehicle->mass + turning);
        assert_near(collision.summary->vehicle[0].final_speed, 10.0 - 4.0 * a, 2e-4, 0.0);
        assert_true(
            collision.summary->energy.wheel_rail >
            0.99 * (collision.summary->energy.initial - collision.summary->energy.final_kinetic));
        collision_free(&collision);
    }
}

/* A car pushed by less than its resistance does not creep, and a car that has rolled out stays at
 * rest. */
static void a_standing_car_is_held(void **state) {
    (void)state;
    static const char *const files[] = {two_masses, two_cars};
    for (int i = 0; i < 2; i++) {
        Collision collision = collide(files[i],
                                      WITH("trains.A.speed_m_s=0.5", "trains.B.speed_m_s=0",
                                           "trains.A.vehicles.A1.rolling_resistance_N_kN=50",
                                           "trains.B.vehicles.B1.rolling_resistance_N_kN=50"),
                                      0);
        const int last = n_sample(&collision) - 1;
        const double *v = channel(&collision, CZ_CHANNEL_BODY_SPEED, "A1"),
                     *x = channel(&collision, CZ_CHANNEL_BODY_DISPLACEMENT, "A1");
        assert_near(v[last], 0.0, 0.0, 1e-4);
        assert_near(x[last], x[last - 1000], 0.0, 1e-5);
        collision_free(&collision);
    }
}

/* A drag does not bound the default step. */
static void a_standing_train_does_not_bound_the_step(void **state) {
    (void)state;
    Collision free = collision_model(two_cars, AS_WRITTEN, 0);
    Collision held = collision_model(
        two_cars,
        WITH("trains.A.vehicles.A1.rolling_resistance_N_kN=50", "trains.A.brake.ratio=0.3"), 0);
    assert_true(cz_model_time_step(free.model) == cz_model_time_step(held.model));
    collision_free(&free);
    collision_free(&held);
}

/* ---- damping of crush zones without end mass ---- */

/* The same by Runge and Kutta: m x'' = -(k x + c min(x / 10 mm, 1) x') up to the turn. */
static double largest_stroke(double mass, double stiffness, double damping, double speed,
                             double *damped_energy) {
    const double h = 1e-6;
    double x = 0.0, v = speed;
    *damped_energy = 0.0;
    while (v > 0.0) {
        double k[4][2], dx = 0.0, dv = 0.0;
        for (int s = 0; s < 4; s++) {
            const double at = x + dx, rate = v + dv;
            const double resisted = damping * fmin(at / 0.01, 1.0) * rate;
            k[s][0] = rate;
            k[s][1] = -(stiffness * at + resisted) / mass;
            const double part = s == 2 ? h : 0.5 * h;
            dx = part * k[s][0];
            dv = part * k[s][1];
        }
        *damped_energy += h * damping * fmin(x / 0.01, 1.0) * v * v;
        x += h * (k[0][0] + 2.0 * k[1][0] + 2.0 * k[2][0] + k[3][0]) / 6.0;
        v += h * (k[0][1] + 2.0 * k[1][1] + 2.0 * k[2][1] + k[3][1]) / 6.0;
    }
    return x;
}

/* The stroke may be wrong by the closure in half a step. */
static void the_damping_of_a_crush_zone_without_end_mass_acts(void **state) {
    (void)state;
    double energy = 0.0;
    const double speed = 5.0, stroke = largest_stroke(50e3, 45e6, 4e5, speed, &energy);
    for (int scenario = 0; scenario < 3; scenario++) {
        Collision collision = collide(damped, AS_WRITTEN, scenario);
        const CzInterfaceResult *interface = &collision.summary->interface[0];
        for (int i = 0; i < interface->n_element; i++) {
            const CzElementResult *end = &interface->element[i];
            assert_int_equal(end->kind, CZ_ELEMENT_END);
            assert_near(end->stroke, stroke, 0.0, 0.5 * speed * collision.summary->time_step);
            assert_true(end->energy > energy); /* and on the way back */
            assert_near(end->tube_energy, 0.0, 0.0, 1.0);
        }
        assert_true(collision.summary->energy.balance_error < 1e-4);
        collision_free(&collision);
    }
}

/* ---- buffer stops ---- */

static const CzElementResult *element_of(const Collision *collision, CzElementKind kind) {
    const CzInterfaceResult *interface = &collision->summary->interface[0];
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].kind == kind)
            return &interface->element[i];
    fail_msg("no element of kind %d", kind);
    return NULL;
}

/* The drag dissipates F s for any push; the frame that slides with the buffer is never touched.
 */
static void a_buffer_stop_is_dragged_with_its_frame(void **state) {
    (void)state;
    for (int scenario = 0; scenario < 2; scenario++) {
        Collision collision = collide(slide, AS_WRITTEN, scenario);
        const CzElementResult *jaws = element_of(&collision, CZ_ELEMENT_SLIDE);
        const CzRunSummary *summary = collision.summary;
        assert_near(jaws->peak_force, 500e3, 1e-12, 0.0);
        assert_near(jaws->energy, 500e3 * jaws->stroke, 1e-3, 0.0);
        assert_true(jaws->stroke > 1.0 && !jaws->bottomed_out);
        assert_near(jaws->stroke_used, jaws->stroke / 3.0, 1e-12, 0.0);
        assert_true(summary->interface[0].peak_force < 900e3);
        assert_near(jaws->energy + summary->interface[0].energy, summary->energy.dissipated, 1e-6,
                    0.0);
        assert_true(summary->momentum_error < 1e-9);
        collision_free(&collision);
    }
}

/* It stops abruptly at the end of its travel, and this is reported. */
static void a_buffer_stop_at_the_end_of_its_travel_bottoms_out(void **state) {
    (void)state;
    Collision collision = collide(slide, WITH("parts.jaws.length_m=0.5"), 0);
    const CzElementResult *jaws = element_of(&collision, CZ_ELEMENT_SLIDE);
    int n_bottomed = 0;
    assert_true(jaws->bottomed_out && jaws->stroke_used > 1.0 && jaws->peak_force > 2e6);
    const CzEvent *event = collision.summary->event;
    for (int i = 0; i < collision.summary->n_event; i++)
        n_bottomed +=
            event[i].what == CZ_EVENT_BOTTOMED_OUT && strcmp(event[i].where, "slide S1") == 0;
    assert_int_equal(n_bottomed, 1);
    assert_true(collision.summary->energy.balance_error < 1e-3);
    collision_free(&collision);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_braked_mass_stops_at_its_braking_distance_and_stays_there),
        cmocka_unit_test(brakes_beyond_the_friction_lock_the_wheels),
        cmocka_unit_test(the_share_of_braked_axles_is_one_of_the_weight),
        cmocka_unit_test(a_share_of_braked_axles_is_not_rounded),
        cmocka_unit_test(rolling_resistance_slows_every_kind_of_car),
        cmocka_unit_test(a_standing_car_is_held),
        cmocka_unit_test(a_standing_train_does_not_bound_the_step),
        cmocka_unit_test(the_damping_of_a_crush_zone_without_end_mass_acts),
        cmocka_unit_test(a_buffer_stop_is_dragged_with_its_frame),
        cmocka_unit_test(a_buffer_stop_at_the_end_of_its_travel_bottoms_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
