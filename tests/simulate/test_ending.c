/* A run without a duration ends when the forces between the cars can no longer change the result.
 */
#include "physics/collision.h"

#define SPRINGS "tests/physics/cases/springs-that-part.yaml"

/* The last recorded force of an interface [kN]. */
static double last_force(const Collision *collision, const char *name) {
    return channel(collision, CZ_CHANNEL_INTERFACE_FORCE, name)[n_sample(collision) - 1];
}

static const char *const devices[] = {"parts.head.face_gap_m=0", "parts.head.coupler.gap_m=0",
                                      "parts.head.side_buffers.gap_m=0"};
enum { N_DEVICE = sizeof devices / sizeof devices[0] };

/* Two equal masses with springs between them exchange their speeds, for every device and any period
 * of the oscillation. The scheme's error of a half period is (omega h)^2 / 24. */
static void elastic_cars_exchange_their_speeds_without_a_duration(void **state) {
    (void)state;
    static const char *const masses[][2] = {
        {"trains.A.vehicles.A1.mass_t=40", "trains.B.vehicles.B1.mass_t=40"},
        {"trains.A.vehicles.A1.mass_t=160", "trains.B.vehicles.B1.mass_t=160"}};
    for (int i = 0; i < N_DEVICE; i++) {
        for (size_t k = 0; k < 2; k++) {
            Collision collision = collide(SPRINGS, WITH(devices[i], masses[k][0], masses[k][1]), 0);
            assert_completed(&collision);
            assert_near(collision.summary->vehicle[0].final_speed, 0.0, 0.0, 1e-3);
            assert_near(collision.summary->vehicle[1].final_speed, 10.0, 1e-4, 0.0);
            assert_near(collision.summary->energy.stored, 0.0, 0.0, 1.0);
            assert_true(last_force(&collision, "A1-B1") == 0.0);
            collision_free(&collision);
        }
    }
}

static void reference_and_brief_runs_include_the_rebound(void **state) {
    (void)state;
    const CzIntegrator integrators[] = {CZ_INTEGRATOR_ZHAI, CZ_INTEGRATOR_ERK, CZ_INTEGRATOR_ADAMS};
    for (int i = 0; i < N_DEVICE; i++) {
        for (int k = 0; k < 3; k++) {
            CzSimulateOptions options = cz_simulate_options_default();
            options.integrator = integrators[k];
            options.brief = k == 0;
            Collision collision = collide_so(SPRINGS, WITH(devices[i]), 0, &options);
            assert_completed(&collision);
            const double left = 1e-3; /* of the initial energy: the rule of the end */
            assert_true(collision.summary->energy.stored <=
                        left * collision.summary->energy.initial);
            collision_free(&collision);
        }
    }
}

/* Three coupled cars: only the first meets the wall, the others push it on. At the end of the run a
 * joint stores at most a thousandth of the initial energy, on average half of it as motion: the
 * cars have almost one speed. */
static void a_coupled_train_leaves_the_wall(void **state) {
    (void)state;
    Collision collision = collide("tests/physics/cases/train-and-wall.yaml", AS_WRITTEN, 0);
    assert_completed(&collision);
    assert_true(collision.summary->ended == CZ_ENDED_BY_RULE);
    assert_true(last_force(&collision, "A1-wall") == 0.0);
    const double rest = 1e-3 * collision.summary->energy.initial; /* [J] */
    for (int car = 0; car < 2; car++) {
        const double apart = collision.summary->vehicle[car].final_speed -
                             collision.summary->vehicle[car + 1].final_speed;
        assert_true(collision.summary->vehicle[car].final_speed < 0.0);
        assert_true(0.5 * 20e3 * apart * apart < 2.0 * rest);
    }
    collision_free(&collision);
}

/* Brakes can hold a compressed buffer permanently: the force remains, and the run is over.
 */
static void a_train_held_by_its_brakes_is_at_its_end(void **state) {
    (void)state;
    Collision collision = collide("tests/physics/cases/held-by-brakes.yaml", AS_WRITTEN, 0);
    assert_completed(&collision);
    assert_true(collision.summary->ended == CZ_ENDED_BY_RULE);
    const double left = last_force(&collision, "A1-wall");
    assert_true(left > 10.0);
    /* A tenth of a millimetre at the 5 Hz at which the body oscillates on its links. */
    assert_near(collision.summary->vehicle[0].final_speed, 0.0, 0.0, 3e-3);
    collision_free(&collision);
}

/* 750 kJ against jaws of 100 kN: the mass and the stop move as one for seconds, their closure
 * constant, until the stop stands and the buffers push the mass back. The jaws absorb all but the
 * energy of 0.2 t of stop and that of the buffers. */
static void a_run_waits_until_a_buffer_stop_has_come_to_rest(void **state) {
    (void)state;
    for (int scenario = 2; scenario < 4; scenario++) {
        const int stop = scenario == 2 ? 1 : 0;
        for (int brief = 0; brief < 2; brief++) {
            CzSimulateOptions options = cz_simulate_options_default();
            options.brief = brief == 1;
            Collision collision = collide_so(
                "tests/physics/cases/slide.yaml",
                WITH("parts.jaws.force_kN=100", "parts.jaws.length_m=20", "parts.jaws.mass_t=0.2"),
                scenario, &options);
            assert_completed(&collision);
            assert_near(collision.summary->vehicle[stop].final_speed, 0.0, 0.0, 1e-6);
            assert_near(collision.summary->energy.dissipated, 750e3, 0.01, 0.0);
            collision_free(&collision);
        }
    }
}

/* Coupled cars roll and stop as one: only the second car ahead has rolling resistance, and
 * the two still come to rest in front of the one that follows. */
static void a_coupled_car_that_rolls_freely_is_slowed_with_its_train(void **state) {
    (void)state;
    const char *const file = "tests/physics/cases/rolling-train.yaml";
    Collision collision = collide(file, AS_WRITTEN, 0);
    assert_true(collision.summary->ended == CZ_ENDED_INCOMPLETE);
    assert_string_equal(collision.summary->awaited, "cars that have parted can meet again");
    collision_free(&collision);
    collision = collide(file, WITH("trains.A.vehicles.A1.rolling_resistance_N_kN=20"), 0);
    assert_completed(&collision);
    assert_true(collision.summary->ended == CZ_ENDED_BY_RULE);
    collision_free(&collision);
}

/* 60 t at 1 m/s push 30 t to 4/3 m/s and follow at 1/3. Slowed at 0.05 g the light car is met
 * again after 2 / 0.49 = 4.1 s, and pushed until the closing speed stays below 0.1 m/s; where both
 * decelerate equally, the car behind never reaches it. */
static void cars_meet_again_where_rolling_resistance_slows_the_one_ahead(void **state) {
    (void)state;
    static const char *const slowed[][2] = {{"trains.A.vehicles.A1.rolling_resistance_N_kN=0",
                                             "trains.B.vehicles.B1.rolling_resistance_N_kN=50"},
                                            {"trains.A.vehicles.A1.rolling_resistance_N_kN=50",
                                             "trains.B.vehicles.B1.rolling_resistance_N_kN=50"}};
    for (int both = 0; both < 2; both++) {
        Collision collision = collide(SPRINGS,
                                      WITH(devices[0], "trains.A.vehicles.A1.mass_t=60",
                                           "trains.B.vehicles.B1.mass_t=30", "trains.A.speed_m_s=1",
                                           slowed[both][0], slowed[both][1]),
                                      0);
        assert_completed(&collision);
        assert_true(collision.summary->ended == CZ_ENDED_BY_RULE);
        if (both)
            assert_true(collision.summary->simulated < 1.0);
        else
            assert_true(collision.summary->vehicle[0].final_speed <= 0.1);
        collision_free(&collision);
    }
}

/* After a plastic collision at 10 m/s both cars continue at 5 m/s, the one ahead decelerated by
 * 0.05 g: the cars meet again repeatedly until both stand, at speeds limited by the gap of less
 * than a millimetre between them. A brief run does not wait for that. */
static void a_brief_run_does_not_wait_for_cars_that_are_close(void **state) {
    (void)state;
    const char *const file = "tests/physics/cases/plateau.yaml";
    double simulated[2], shortening[2];
    for (int brief = 0; brief < 2; brief++) {
        CzSimulateOptions options = cz_simulate_options_default();
        options.brief = brief == 1;
        Collision collision =
            collide_so(file, WITH("trains.B.vehicles.B1.rolling_resistance_N_kN=50"), 0, &options);
        assert_completed(&collision);
        simulated[brief] = collision.summary->simulated;
        shortening[brief] = collision.summary->interface[0].shortening;
        collision_free(&collision);
    }
    assert_true(simulated[0] > 10.0);
    assert_true(simulated[1] < 0.5);
    assert_near(shortening[0], shortening[1], 1e-3, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_cars_exchange_their_speeds_without_a_duration),
        cmocka_unit_test(reference_and_brief_runs_include_the_rebound),
        cmocka_unit_test(a_brief_run_does_not_wait_for_cars_that_are_close),
        cmocka_unit_test(a_coupled_train_leaves_the_wall),
        cmocka_unit_test(a_train_held_by_its_brakes_is_at_its_end),
        cmocka_unit_test(a_run_waits_until_a_buffer_stop_has_come_to_rest),
        cmocka_unit_test(a_coupled_car_that_rolls_freely_is_slowed_with_its_train),
        cmocka_unit_test(cars_meet_again_where_rolling_resistance_slows_the_one_ahead),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
