/* Models that are built beside others use their track where it is the same. */
#include "physics/collision.h"

#include "model/build.h"
#include "model/model.h"

#define FILE_OF_PAIR "problems/two-cars-25kmh.yaml"
#define ELASTIC "simulation.track=receptance"

/* Whether a model with settings uses the track of one without them. */
static bool shares(const char *const *set) {
    Collision own = collision_model(FILE_OF_PAIR, WITH(ELASTIC), 0);
    Collision other = collision_model(FILE_OF_PAIR, set, 0);
    CzModel *const made[] = {NULL, own.model};
    CzModel *beside = NULL;
    CzError error = {0};
    if (cz_model_build_beside(other.problem, 0, 2, made, &beside, &error) != CZ_OK)
        fail_msg("%s", error.message);
    const bool is_shared = beside->track != NULL && beside->track == own.model->track;
    cz_model_free(beside);
    collision_free(&other);
    collision_free(&own);
    return is_shared;
}

static void other_speeds_and_masses_leave_the_track_the_same(void **state) {
    (void)state;
    assert_true(shares(WITH(ELASTIC)));
    assert_true(shares(WITH("simulation.track=modal")));
    assert_true(shares(WITH(ELASTIC, "trains.A.speed_km_h=10")));
    assert_true(shares(WITH(ELASTIC, "parts.paper-car.mass_t=39", "simulation.time_step_ms=0.05")));
}

static void another_ballast_bogie_or_length_gives_another_track(void **state) {
    (void)state;
    assert_false(shares(WITH(ELASTIC, "track.ballast_stiffness_N_m=6e7")));
    assert_false(shares(WITH(ELASTIC, "track.nodes_per_bay=8")));
    assert_false(shares(WITH(ELASTIC, "trains.A.vehicles.A1.bogie.axle_spacing_mm=2200")));
    assert_false(shares(WITH(ELASTIC, "trains.A.vehicles.A1.bogie_spacing_mm=17000")));
    assert_false(shares(WITH("simulation.track=rigid")));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(other_speeds_and_masses_leave_the_track_the_same),
        cmocka_unit_test(another_ballast_bogie_or_length_gives_another_track),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
