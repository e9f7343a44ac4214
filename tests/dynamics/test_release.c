/* A shear-off releases within a step: its force is the peak, and results depend on it smoothly. */
#include "physics/collision.h"

#define MASS 40e3      /* [kg] */
#define STIFFNESS 20e6 /* of the buffer [N/m] */
#define FORCE 0.6e6    /* of the shear-off [N] */

/* One mass onto a wall: the coupler absorbs a F^2 + b F until it is released at the force F. */
typedef struct {
    const char *speed, *softening; /* settings */
    double before;                 /* [m/s] */
    double a, b;
} Case;

/* Where the softening is shorter than the buffer's return travel F / k, the force drops at once,
 * and the coupler has absorbed F^2 / (2 k). Where it is longer the force falls along it: F s / 2.
 */
static const Case sudden = {"trains.A.speed_m_s=1.2",
                            "trains.A.vehicles.A1.front.coupler.shear_off.softening_length_mm=10",
                            1.2, 0.5 / STIFFNESS, 0.0};
static const Case gradual = {"trains.A.speed_m_s=2",
                             "trains.A.vehicles.A1.front.coupler.shear_off.softening_length_mm=100",
                             2.0, 0.0, 0.5 * 0.1};

static Collision let_go(const Case *c, double force, const char *step) {
    char set[96];
    snprintf(set, sizeof set, "trains.A.vehicles.A1.front.coupler.shear_off.force_N=%.17g", force);
    Collision collision =
        collide("tests/physics/cases/shear-off.yaml", WITH(c->speed, c->softening, step, set), 0);
    assert_completed(&collision);
    return collision;
}

static double speed_after(const Case *c, double force, const char *step) {
    Collision collision = let_go(c, force, step);
    const double speed = collision.summary->vehicle[0].final_speed;
    collision_free(&collision);
    return speed;
}

/* The force rises by k v h = 2 kN in a step of 0.1 ms: the crossing is searched for all over a
 * step.
 */
static void the_peak_is_the_force_of_the_shear_off(void **state) {
    (void)state;
    for (int i = 0; i < 11; i++) {
        const double force = FORCE + 200.0 * i;
        Collision collision = let_go(&sudden, force, "simulation.time_step_ms=0.1");
        const CzInterfaceResult *interface = &collision.summary->interface[0];
        assert_near(interface->peak_force, force, 1e-9, 0.0);
        assert_near(interface->element[0].peak_force, force, 1e-9, 0.0);
        assert_near(interface->section_force[0], force, 1e-9, 0.0);
        assert_true(interface->element[0].sheared);
        collision_free(&collision);
    }
}

/* The strength falls from its trigger peak to the plateau over ten steps: the peak is at the start
 * of the first one. */
static void the_peak_of_a_trigger_is_the_given_force(void **state) {
    (void)state;
    static const char *const steps[] = {"simulation.time_step_ms=0.1",
                                        "simulation.time_step_ms=0.03"};
    for (int i = 0; i < 2; i++) {
        Collision collision =
            collide("tests/physics/cases/plateau.yaml",
                    WITH("trains.A.vehicles.A1.front.anti_climber.trigger_MN=2", steps[i]), 0);
        const CzInterfaceResult *interface = &collision.summary->interface[0];
        assert_completed(&collision);
        assert_near(interface->peak_force, 2e6, 1e-9, 0.0);
        assert_near(interface->element[0].peak_force, 2e6, 1e-9, 0.0);
        assert_near(interface->section_force[0], 2e6, 1e-9, 0.0);
        assert_near(interface->section_force[1], 2e6, 1e-9, 0.0);
        collision_free(&collision);
    }
}

/* In the paper's case the coupler's line is level to a few millionths. */
static void couplers_of_two_full_cars_shear_off_at_the_given_force(void **state) {
    (void)state;
    Collision collision = collide("problems/two-cars-25kmh.yaml", AS_WRITTEN, 0);
    assert_completed(&collision);
    for (int i = 0; i < collision.summary->interface[0].n_element; i++) {
        const CzElementResult *element = &collision.summary->interface[0].element[i];
        if (element->kind == CZ_ELEMENT_COUPLER)
            assert_near(element->peak_force, 911e3, 1e-3, 0.0);
    }
    collision_free(&collision);
}

/* The closing speed at the end of a step represents that in it: a relative error of a h / v in the
 * time that is left after the release, so in the derivative. The force after the release is some
 * ten newtons, from the smallest resistance of a plastic member: 1e-5 of the speed.
 */
static void follows(const Case *c, const char *step, double step_length) {
    for (int i = 0; i < 5; i++) {
        const double force = FORCE * (1.0 + 7e-4 * i), change = 1e-6 * FORCE;
        const double taken = c->a * force * force + c->b * force;
        const double after = sqrt(c->before * c->before - 2.0 * taken / MASS);
        const double slope = -(2.0 * c->a * force + c->b) / (MASS * after);
        const double derivative =
            (speed_after(c, force + change, step) - speed_after(c, force - change, step)) /
            (2.0 * change);
        assert_near(derivative, slope, force / MASS * step_length / after, 0.0);
        assert_near(speed_after(c, force, step), after, 1e-4, 0.0);
    }
}

static void the_speed_after_a_drop_follows_the_force_as_in_closed_form(void **state) {
    (void)state;
    follows(&sudden, "simulation.time_step_ms=0.1", 1e-4);
    follows(&sudden, "simulation.time_step_ms=0.01", 1e-5);
}

static void the_speed_after_a_fall_follows_the_force_as_in_closed_form(void **state) {
    (void)state;
    follows(&gradual, "simulation.time_step_ms=0.1", 1e-4);
    follows(&gradual, "simulation.time_step_ms=0.01", 1e-5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_peak_is_the_force_of_the_shear_off),
        cmocka_unit_test(the_peak_of_a_trigger_is_the_given_force),
        cmocka_unit_test(couplers_of_two_full_cars_shear_off_at_the_given_force),
        cmocka_unit_test(the_speed_after_a_drop_follows_the_force_as_in_closed_form),
        cmocka_unit_test(the_speed_after_a_fall_follows_the_force_as_in_closed_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
