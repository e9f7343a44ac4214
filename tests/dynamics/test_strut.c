/* A coupler is a strut where a car can pitch, and acts along the track where none can. */
#include "physics/collision.h"

#define FORCE 1e6
#define ENERGY 3e6    /* of 60 t at 10 m/s, and of two such masses at 10 sqrt(2) m/s */
#define BUFFER 25e3   /* 50 mm up to the tube's force */
#define ELASTIC 2.5e3 /* of the tube: F^2 / (2 * 200 MN/m) */
static const char *const long_tube = "tests/physics/cases/long-tube.yaml";

static const CzElementResult *coupler_of(const CzRunSummary *summary, const char *name) {
    const CzInterfaceResult *interface = &summary->interface[0];
    for (int i = 0; i < interface->n_element; i++)
        if (strcmp(interface->element[i].name, name) == 0)
            return &interface->element[i];
    fail_msg("no element '%s'", name);
    return NULL;
}

/* The plateau carries until the energy is absorbed after 3 m, more than the length of any coupler.
 * In the scenario with a partner the stiff buffer ahead absorbs some joules. */
static void a_plateau_between_single_masses_acts_at_any_closure(void **state) {
    (void)state;
    const double stroke = (ENERGY - BUFFER - ELASTIC) / FORCE;
    for (int scenario = 0; scenario < 3; scenario++) {
        Collision collision = collide(long_tube, AS_WRITTEN, scenario);
        const CzElementResult *coupler = coupler_of(collision.summary, "coupler A1");
        assert_int_equal(collision.summary->status, CZ_OK);
        assert_near(coupler->stroke, stroke, 1e-3, 0.0);
        assert_near(coupler->peak_force, FORCE, 1e-3, 0.0);
        collision_free(&collision);
    }
}

/* Where no car pitches the length has no influence on the motion. */
static void the_length_of_a_coupler_does_not_move_single_masses(void **state) {
    (void)state;
    static const char *const lengths[] = {"parts.head.coupler.length_m=4.9",
                                          "parts.head.coupler.length_m=5"};
    for (int scenario = 0; scenario < 3; scenario++) {
        Collision without = collide(long_tube, AS_WRITTEN, scenario);
        for (int i = 0; i < 2; i++) {
            Collision with = collide(long_tube, WITH(lengths[i]), scenario);
            assert_true(with.summary->interface[0].peak_force ==
                        without.summary->interface[0].peak_force);
            assert_true(with.summary->vehicle[0].final_speed ==
                        without.summary->vehicle[0].final_speed);
            assert_true(coupler_of(with.summary, "coupler A1")->stroke ==
                        coupler_of(without.summary, "coupler A1")->stroke);
            collision_free(&with);
        }
        collision_free(&without);
    }
}

/* Couplers at different heights do not lift masses that have one co-ordinate. */
static void a_height_does_not_move_single_masses(void **state) {
    (void)state;
    Collision level = collide(long_tube, AS_WRITTEN, 2);
    Collision offset =
        collide(long_tube,
                WITH("parts.head.coupler.height_m=0.7", "parts.hard-head.coupler.height_m=1.0"), 2);
    assert_true(level.summary->vehicle[0].final_speed == offset.summary->vehicle[0].final_speed);
    assert_near(offset.summary->momentum_error, 0.0, 0.0, 1e-9);
    collision_free(&level);
    collision_free(&offset);
}

/* A released coupler of a full car may retract past its own pivot, since it no longer acts along
 * the line between two pivots: against a car and against a wall. */
static void a_released_coupler_may_retract_by_more_than_its_length(void **state) {
    (void)state;
    static const char *const files[] = {"problems/two-cars-25kmh.yaml", "problems/wall.yaml"};
    for (int i = 0; i < 2; i++) {
        Collision collision =
            collide(files[i],
                    WITH(i == 0 ? "trains.A.speed_km_h=60" : "trains.A.speed_km_h=40",
                         "parts.front-coupler.length_m=0.7",
                         "parts.front-coupler.shear_off.retraction_space_mm=3000"),
                    0);
        assert_string_equal(collision.summary->failure, "");
        assert_true(collision.summary->interface[0].shortening > (i == 0 ? 1.4 : 0.7));
        assert_true(collision.summary->energy.balance_error < 1e-3);
        collision_free(&collision);
    }
}

/* Bottomed out behind a tube that takes nearly the whole length; a longer one is refused. */
static void a_strut_that_closes_by_its_whole_length_fails_the_run(void **state) {
    (void)state;
    Collision collision = collide("problems/two-cars-25kmh.yaml",
                                  WITH("trains.A.speed_km_h=60", "parts.front-coupler.length_m=0.7",
                                       "parts.front-coupler.tube.stages[0].stroke_mm=645",
                                       "parts.front-coupler.shear_off.force_kN=8000"),
                                  0);
    const CzRunSummary *summary = collision.summary;
    assert_int_equal(summary->status, CZ_STATUS_RUN_FAILED);
    assert_non_null(strstr(summary->failure, ": coupler: shortened by "));
    assert_non_null(strstr(summary->failure, " the 700 mm from its pivot to its face (length_m)"));
    collision_free(&collision);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plateau_between_single_masses_acts_at_any_closure),
        cmocka_unit_test(the_length_of_a_coupler_does_not_move_single_masses),
        cmocka_unit_test(a_height_does_not_move_single_masses),
        cmocka_unit_test(a_released_coupler_may_retract_by_more_than_its_length),
        cmocka_unit_test(a_strut_that_closes_by_its_whole_length_fails_the_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
