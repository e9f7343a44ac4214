/* Events are what the largest values of the run say, and happen when they are reached. */
#include "physics/collision.h"

/* Time of the first event of a kind at a place; NaN when there is none. */
static double time_of(const Collision *collision, CzEventKind what, const char *where,
                      int interface) {
    for (int i = 0; i < collision->summary->n_event; i++) {
        const CzEvent *event = &collision->summary->event[i];
        if (event->what == what && event->interface == interface &&
            strcmp(event->where, where) == 0)
            return event->time;
    }
    return NAN;
}

/* Couplers of one interface stand at unequal heights, so that they are turned from the start. */
static void a_swing_stop_is_met_just_when_the_largest_swing_is_beyond_it(void **state) {
    (void)state;
    static const char *const stops[] = {
        "trains.A.vehicles.A3.front.coupler.hinge.swing_stop_deg=4",
        "trains.A.vehicles.A3.front.coupler.hinge.swing_stop_deg=3",
        "trains.A.vehicles.A3.front.coupler.hinge.swing_stop_deg=1"};
    int n_met = 0;
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
        Collision collision = collide("problems/metro-6-car.yaml",
                                      WITH("trains.A.vehicles.A3.front.coupler.height_mm=900",
                                           stops[i], "simulation.duration_s=0.6"),
                                      5);
        assert_completed(&collision);
        for (int k = 0; k < collision.summary->n_interface; k++) {
            const CzInterfaceResult *interface = &collision.summary->interface[k];
            for (int side = 0; side < 2; side++) {
                char where[64];
                snprintf(where, sizeof where, "coupler %s",
                         collision.summary->vehicle[k + side].name);
                const bool beyond = interface->swing[side] > interface->swing_stop[side];
                const double time = time_of(&collision, CZ_EVENT_SWING_STOP, where, k);
                assert_true(beyond == !isnan(time));
                if (beyond)
                    assert_true(time > 1e-3); /* nothing swings before the impact arrives */
                n_met += beyond;
            }
        }
        collision_free(&collision);
    }
    assert_true(n_met > 0 && n_met < 3 * 22); /* both were tried */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_swing_stop_is_met_just_when_the_largest_swing_is_beyond_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
