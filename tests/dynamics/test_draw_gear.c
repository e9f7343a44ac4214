/* Draw gears: they carry tension between two coupled cars and return all of its energy. */
#include "physics/motion.h"

#define STIFFNESS 4e6 /* two of 8 MN/m in series [N/m] */
#define MASS 30e3     /* reduced mass of two cars of 60 t [kg] */

static const char draw[] = "tests/physics/cases/draw-gear.yaml";

static const CzElementResult *draw_gear_of(const Collision *collision, const char *name) {
    for (int i = 0; i < collision->summary->n_interface; i++) {
        const CzInterfaceResult *interface = &collision->summary->interface[i];
        for (int k = 0; k < interface->n_element; k++)
            if (strcmp(interface->element[k].name, name) == 0)
                return &interface->element[k];
    }
    return NULL;
}

/* Largest speed at which the cars of train B part; it is constant within the slack. */
static double parting_speed(const Collision *collision) {
    const double *behind = channel(collision, CZ_CHANNEL_BODY_SPEED, "B1");
    const double *ahead = channel(collision, CZ_CHANNEL_BODY_SPEED, "B2");
    double largest = 0.0;
    for (int i = 0; i < n_sample(collision); i++)
        largest = fmax(largest, ahead[i] - behind[i]);
    return largest;
}

/* The first pull is half an oscillation of two masses on a spring: F = v sqrt(k m). Its peak lies
 * between two steps, which costs (w h)^2 / 8 = 2e-7 of it at w = 12 rad/s and h = 0.1 ms. */
static void the_tension_follows_from_the_speed_of_parting(void **state) {
    (void)state;
    Collision collision = collide(draw, AS_WRITTEN, 0);
    const CzElementResult *gear = draw_gear_of(&collision, "draw gear B1");
    const double speed = parting_speed(&collision);
    assert_completed(&collision);
    assert_non_null(gear);
    assert_true(speed > 1.0);
    assert_near(gear->peak_force, speed * sqrt(STIFFNESS * MASS), 1e-6, 0.0);
    assert_true(collision.summary->momentum_error < 1e-9);
    assert_true(collision.summary->energy.balance_error < 1e-4);
    collision_free(&collision);
}

/* The stored energy of an end at the end of the run is half of F^2 / 2 k, and nothing is
 * dissipated. */
static void a_draw_gear_returns_all_of_its_energy(void **state) {
    (void)state;
    for (int ms = 300; ms <= 1200; ms += 300) {
        char duration[40];
        snprintf(duration, sizeof duration, "simulation.duration_s=%g", 1e-3 * ms);
        Collision collision = collide(draw, WITH(duration), 0);
        const double *force = channel(&collision, CZ_CHANNEL_INTERFACE_FORCE, "B1-B2");
        const double tension = 1e3 * fmin(force[n_sample(&collision) - 1], 0.0);
        const CzElementResult *gear = draw_gear_of(&collision, "draw gear B2");
        assert_near(gear->stored, 0.25 * tension * tension / STIFFNESS, 1e-9, 1e-6);
        assert_near(gear->energy, 0.0, 0.0, 1e-9);
        collision_free(&collision);
    }
}

/* The colliding ends have draw gears too, and part. */
static void draw_gears_of_two_trains_do_not_couple(void **state) {
    (void)state;
    Collision collision = collide(draw, AS_WRITTEN, 0);
    const double *force = channel(&collision, CZ_CHANNEL_INTERFACE_FORCE, "A1-B1");
    assert_null(draw_gear_of(&collision, "draw gear A1"));
    for (int i = 0; i < n_sample(&collision); i++)
        assert_true(force[i] >= 0.0);
    collision_free(&collision);
}

/* Moment on the body of A1 when the draw gear behind A2 is tightened by 0.3 m, with one hook at a
 * height and the other at 1 m. */
static double moment_of(const char *height) {
    Motion motion = motion_open("tests/physics/cases/offset-collision.yaml", WITH(height));
    *parameter(&motion, CZ_PARAMETER(draw_gear.slack), 0) = -0.3;
    motion_start(&motion);
    const double moment = force(&motion, CZ_DOF(body.pitch), 0);
    motion_close(&motion);
    return moment;
}

/* Two of 10 MN/m in series pull with 1.5 MN midway between the hooks: one hook 1 m higher raises
 * the line of force by 0.5 m. */
static void the_tension_acts_midway_between_the_hooks(void **state) {
    (void)state;
    const double low = moment_of("parts.cab.rear.draw_gear.height_m=0.6");
    const double high = moment_of("parts.cab.rear.draw_gear.height_m=1.6");
    assert_near(high - low, -0.5 * 1.5e6, 1e-12, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tension_follows_from_the_speed_of_parting),
        cmocka_unit_test(a_draw_gear_returns_all_of_its_energy),
        cmocka_unit_test(draw_gears_of_two_trains_do_not_couple),
        cmocka_unit_test(the_tension_acts_midway_between_the_hooks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
