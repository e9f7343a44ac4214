/* Largest values of bogies, underframes and filtered forces, against channels and simple bodies. */
#include "physics/collision.h"

#define PAIR "tests/physics/cases/full-pair.yaml"

/* Height of an underframe at its bare end structure [m], 11.02 m from the middle of the car. */
static double height(const Collision *collision, const char *car, double outwards, int sample) {
    const double rise = 1e-3 * channel(collision, CZ_CHANNEL_BODY_RISE, car)[sample];
    const double pitch = 1e-3 * channel(collision, CZ_CHANNEL_BODY_PITCH, car)[sample];
    return rise + outwards * (22.8 / 2 - 0.38) * sin(pitch);
}

/* Two cars without couplers, with centres of gravity at different heights, so that one pitches more
 * than the other. Every step is recorded. The pitch at rest is zero. */
static void underframes_without_couplers_rise_at_their_ends(void **state) {
    (void)state;
    Collision collision =
        collide(PAIR,
                WITH("trains.B.vehicles.B1.cg_height_m=2.2", "simulation.duration_s=0.4",
                     "simulation.output_step_ms=0.1", "simulation.time_step_ms=0.1"),
                0);
    double largest = 0;
    for (int i = 0; i < n_sample(&collision); i++)
        largest =
            fmax(largest, fabs(height(&collision, "B1", -1, i) - height(&collision, "A1", 1, i)));
    assert_true(largest > 5e-3);
    assert_near(collision.summary->interface[0].underframe_rise, largest, 1e-6, 0);
    collision_free(&collision);
}

/* A wall has no underframe, and rigid cars do not rise. */
static void there_is_no_rise_where_nothing_can_rise(void **state) {
    (void)state;
    Collision wall =
        collide("tests/physics/cases/full-wall.yaml", WITH("simulation.duration_s=0.1"), 0);
    assert_true(isnan(wall.summary->interface[0].underframe_rise));
    collision_free(&wall);
}

/* A bogie on a stiff link and stiff axle guidance follows its car: the largest accelerations are
 * the same but for the oscillation of the bogie on its link, at most twice the step of the car's.
 */
static void a_bogie_on_a_stiff_link_has_the_acceleration_of_its_car(void **state) {
    (void)state;
    Collision collision = collide(PAIR, WITH("simulation.duration_s=0.3"), 0);
    for (int i = 0; i < collision.summary->n_vehicle; i++) {
        const CzVehicleResult *vehicle = &collision.summary->vehicle[i];
        assert_true(vehicle->bogie_acceleration > 0.5 * vehicle->peak_deceleration);
        assert_true(vehicle->bogie_acceleration < 4 * vehicle->peak_deceleration);
    }
    collision_free(&collision);
    collision = collide("tests/physics/cases/rigid-pair.yaml", AS_WRITTEN, 0);
    assert_true(isnan(collision.summary->vehicle[0].bogie_acceleration));
    collision_free(&collision);
}

/* A plateau of 1 MN over 0.3 s passes the filter, whose steps overshoot it by a few percent,
 * whatever is recorded; runs without pulses have no such peak. */
static void a_filtered_force_is_beside_the_peak_of_every_step(void **state) {
    (void)state;
    static const char plateau[] = "tests/physics/cases/plateau.yaml";
    Collision recorded = collide(plateau, WITH("simulation.output_step_ms=1"), 0);
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = false;
    Collision bare = collide_so(plateau, AS_WRITTEN, 0, &options);
    options.keep_pulses = true;
    Collision kept = collide_so(plateau, AS_WRITTEN, 0, &options);
    const CzInterfaceResult *interface = &recorded.summary->interface[0];
    assert_near(interface->peak_force_cfc180, interface->peak_force, 0.1, 0);
    assert_near(kept.summary->interface[0].peak_force_cfc180, interface->peak_force_cfc180, 0, 0);
    assert_true(isnan(bare.summary->interface[0].peak_force_cfc180));
    collision_free(&recorded);
    collision_free(&bare);
    collision_free(&kept);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(underframes_without_couplers_rise_at_their_ends),
        cmocka_unit_test(there_is_no_rise_where_nothing_can_rise),
        cmocka_unit_test(a_filtered_force_is_beside_the_peak_of_every_step),
        cmocka_unit_test(a_bogie_on_a_stiff_link_has_the_acceleration_of_its_car),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
