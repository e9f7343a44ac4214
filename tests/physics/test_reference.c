/* The fixed-step scheme against two adaptive solvers of another family, and all three against
 * closed forms. */
#include "physics/steps.h"

static const CzIntegrator references[] = {CZ_INTEGRATOR_ERK, CZ_INTEGRATOR_ADAMS};
static const CzIntegrator all[] = {CZ_INTEGRATOR_ZHAI, CZ_INTEGRATOR_ERK, CZ_INTEGRATOR_ADAMS};

#define STEP_OF_10_US "simulation.time_step_ms=0.01", "simulation.output_step_ms=0.01"
#define UNTIL_OPEN "simulation.duration_s=0.3"

static Collision collide_by(CzIntegrator integrator, const char *file, const char *const *set,
                            int scenario) {
    CzSimulateOptions options = cz_simulate_options_default();
    options.integrator = integrator;
    return collide_so(file, set, scenario, &options);
}

/* ---- closed forms, by every integrator ---- */

/* A step of 0.01 ms is 5e-5 of the 0.2 s until a mass turns, and a breakpoint within a step costs a
 * fraction of it, because forces are continuous. */
#define LEFT_BY_STEP 1e-5

/* One mass on an elastic and plastic spring: the numbers of test_closed_forms.c. */
static void every_integrator_follows_the_elastic_and_plastic_spring(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        Collision collision = collide_by(all[i], "tests/physics/cases/spring-and-plateau.yaml",
                                         WITH(STEP_OF_10_US, UNTIL_OPEN), 0);
        assert_completed(&collision);
        const CzRunSummary *summary = collision.summary;
        assert_int_equal(summary->integrator, all[i]);
        assert_near(summary->interface[0].shortening, 0.680504115, LEFT_BY_STEP, 0.0);
        assert_near(
            time_of_fall(&collision, channel(&collision, CZ_CHANNEL_BODY_SPEED, "A1"), NULL),
            0.190611, LEFT_BY_STEP, 1e-6);
        assert_near(summary->vehicle[0].final_speed, -0.838525492, LEFT_BY_STEP, 0.0);
        assert_near(summary->interface[0].energy, 950.443673e3, LEFT_BY_STEP, 0.0);
        assert_near(
            time_of_opening(&collision, channel(&collision, CZ_CHANNEL_INTERFACE_FORCE, "A1-wall")),
            0.225736, LEFT_BY_STEP, 0.0);
        collision_free(&collision);
    }
}

static void every_integrator_follows_four_stages_and_two_back(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        Collision collision = collide_by(all[i], "tests/physics/cases/four-stages.yaml",
                                         WITH(STEP_OF_10_US, UNTIL_OPEN), 0);
        assert_completed(&collision);
        const CzRunSummary *summary = collision.summary;
        assert_near(summary->interface[0].shortening, 0.573619, LEFT_BY_STEP, 0.0);
        assert_near(summary->interface[0].peak_force, 4104.289e3, LEFT_BY_STEP, 0.0);
        assert_near(summary->vehicle[0].final_speed, -2.582225, LEFT_BY_STEP, 0.0);
        assert_near(summary->interface[0].energy, 831.148e3, LEFT_BY_STEP, 0.0);
        collision_free(&collision);
    }
}

/* Two masses of 40 t and 20 MN/m: v_A = 5 + 5 cos(w t) until they part, with w^2 = k / mu, and 0
 * m/s ever after. The references need no event location here: the force is continuous. */
static void every_integrator_exchanges_the_speeds_of_equal_masses(void **state) {
    (void)state;
    for (int i = 0; i < 3; i++) {
        Collision elastic = collide_by(all[i], "tests/physics/cases/elastic.yaml",
                                       WITH("simulation.duration_ms=400", STEP_OF_10_US), 0);
        assert_completed(&elastic);
        const double *v = channel(&elastic, CZ_CHANNEL_BODY_SPEED, "A1");
        const double truth = 5.0 + 5.0 * cos(sqrt(20e6 / 20e3) * 0.05);
        assert_near(value_at(&elastic, v, 0.05), truth, 1e-5, 0.0);
        assert_near(elastic.summary->vehicle[0].final_speed, 0.0, 0.0, 1e-4);
        assert_near(elastic.summary->vehicle[1].final_speed, 10.0, 1e-5, 0.0);
        /* A freely moving body keeps its speed. */
        assert_near(last_value(&elastic, v), value_at(&elastic, v, 0.2), 0.0, 1e-12);
        assert_near(elastic.summary->momentum_error, 0.0, 0.0, 1e-12);
        collision_free(&elastic);
    }
}

/* The coupler of sequence.yaml releases when its tube of 299.5 mm is exhausted and 0.1 mm of its
 * softening length is used, so at the speed that follows from its energy: v^2 = v0^2 - 2 * 0.6 MN *
 * 0.2996 m / 40 t, after (v0 - v) m / F. The buffer's 0.06 mm are neglected; their effect is 9 us.
 */
static void every_integrator_finds_the_time_at_which_a_coupler_shears_off(void **state) {
    (void)state;
    const double start = 25.0 / 3.6, deceleration = 0.6e6 / 40e3;
    const double left = sqrt(start * start - 2.0 * deceleration * 0.2996);
    for (int i = 0; i < 3; i++) {
        Collision collision =
            collide_by(all[i], "tests/physics/cases/sequence.yaml", WITH(STEP_OF_10_US), 0);
        assert_completed(&collision);
        assert_near(event_time(&collision, CZ_EVENT_SHEAR_OFF, "coupler A1"),
                    (start - left) / deceleration, 0.0, 2e-5);
        const double *v = channel(&collision, CZ_CHANNEL_BODY_SPEED, "A1");
        assert_near(value_at(&collision, v, 0.048), 6.263011, 1e-4, 0.0);
        assert_near(collision.summary->interface[0].energy, 1929.012e3, 1e-4, 0.0);
        collision_free(&collision);
    }
}

/* The located time does not depend on the step: a reference at 0.1 ms finds it within a tenth of
 * the step, the difference of the motion before it, while the fixed step reports it at the end of a
 * step.
 */
static void a_located_drop_does_not_depend_on_the_step(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        double time[2];
        const char *const steps[] = {"simulation.time_step_ms=0.1", "simulation.time_step_ms=0.01"};
        for (int k = 0; k < 2; k++) {
            Collision collision =
                collide_by(references[i], "tests/physics/cases/sequence.yaml", WITH(steps[k]), 0);
            time[k] = event_time(&collision, CZ_EVENT_SHEAR_OFF, "coupler A1");
            collision_free(&collision);
        }
        assert_near(time[0], time[1], 0.0, 1e-5);
    }
}

/* ---- solver against solver ----
 *
 * Short trains on their own tracks, and two trains of six cars, are compared by the verification
 * page only (tests/verification), which takes longer.
 */

/* The track's modes are advanced exactly by the production run, and as differential equations by
 * the references. The track absorbs some joules, most of them in the first milliseconds of each
 * contact: two per cent. */
static void two_cars_on_an_elastic_track_agree(void **state) {
    (void)state;
    const char *file = "problems/two-cars-25kmh.yaml";
    const char *const *elastic = WITH("simulation.track=modal");
    Collision zhai = collide_by(CZ_INTEGRATOR_ZHAI, file, elastic, 0);
    assert_completed(&zhai);
    assert_true(zhai.summary->energy.track > 1.0);
    for (int i = 0; i < 2; i++) {
        Collision other = collide_by(references[i], file, elastic, 0);
        assert_completed(&other);
        const Difference d = difference_of(zhai.summary, other.summary, 0.01);
        assert_near(d.force, 0.0, 0.0, 1e-3);
        assert_near(d.stroke, 0.0, 0.0, 1e-3);
        assert_near(d.energy, 0.0, 0.0, 1e-3);
        assert_near(d.motion, 0.0, 0.0, 1e-3);
        assert_near(other.summary->energy.track, zhai.summary->energy.track, 2e-2, 0.0);
        assert_near(other.summary->energy.moving_load, zhai.summary->energy.moving_load, 2e-2, 0.0);
        assert_near(other.summary->energy.balance_error, 0.0, 0.0, 1e-4);
        collision_free(&other);
    }
    collision_free(&zhai);
}

/* Residual capacity of two faces, of 276 kN when level: tip to tip, with friction alone, and at 40
 * mm, where they lock. It is the smallest value of a continuous function, so a step changes it by
 * the slip of the faces in that step, some hundredths of a millimetre. */
static void residual_capacity_depends_neither_on_step_nor_on_solver(void **state) {
    (void)state;
    static const char *const offset[] = {"trains.B.height_offset_mm=25",
                                         "trains.B.height_offset_mm=40"};
    static const double step[] = {1e-4, 5e-5, 2e-5};
    for (int k = 0; k < 2; k++) {
        const char *const *set = WITH(offset[k], "simulation.duration_ms=250");
        double by_step[3];
        for (int i = 0; i < 3; i++) {
            CzSimulateOptions options = cz_simulate_options_default();
            options.time_step = step[i];
            Collision run = collide_so("problems/two-cars-25kmh.yaml", set, 0, &options);
            by_step[i] = run.summary->interface[0].vertical_margin;
            collision_free(&run);
        }
        assert_near(by_step[0], by_step[2], 0.0, 1e3);
        assert_true(fabs(by_step[1] - by_step[2]) < 0.5 * fabs(by_step[0] - by_step[2]));
        for (int i = 0; i < 2; i++) {
            Collision other = collide_by(references[i], "problems/two-cars-25kmh.yaml", set, 0);
            assert_near(other.summary->interface[0].vertical_margin, by_step[2], 0.0, 1e3);
            collision_free(&other);
        }
    }
}

static void a_track_without_differential_equations_is_refused(void **state) {
    (void)state;
    Collision collision =
        collision_model("problems/two-cars-25kmh.yaml", WITH("simulation.track=fe"), 0);
    CzSimulateOptions options = cz_simulate_options_default();
    options.integrator = CZ_INTEGRATOR_ERK;
    CzError error = {0};
    assert_int_equal(cz_simulate(collision.model, &options, &collision.run, &error),
                     CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "receptance and modal"));
    assert_null(collision.run);
    collision_free(&collision);
}

/* ---- the reference itself ---- */

/* Rate-dependent strokes and creep are advanced implicitly, so a reference converges at least with
 * the first power of its step, and to the same limit as the fixed-step scheme. */
static void a_reference_converges_to_the_limit_of_the_fixed_step(void **state) {
    (void)state;
    const char *file = "problems/two-cars-25kmh.yaml";
    CzSimulateOptions options = cz_simulate_options_default();
    options.time_step = 5e-6;
    Collision limit = collide_so(file, AS_WRITTEN, 0, &options);
    for (int i = 0; i < 2; i++) {
        double error[2];
        for (int k = 0; k < 2; k++) {
            options.integrator = references[i];
            options.time_step = k == 0 ? 1e-4 : 2e-5;
            options.tolerance = k == 0 ? 1e-6 : 1e-8;
            Collision other = collide_so(file, AS_WRITTEN, 0, &options);
            assert_completed(&other);
            const Difference d = difference_of(limit.summary, other.summary, 0.01);
            error[k] = d.force + d.stroke;
            assert_near(d.energy, 0.0, 0.0, k == 0 ? 1e-4 : 1e-5);
            collision_free(&other);
        }
        assert_true(error[1] < 0.4 * error[0]);
    }
    collision_free(&limit);
}

/* With a long largest step the tolerance decides: an elastic collision at 10 ms. */
static void the_error_of_a_reference_falls_with_its_tolerance(void **state) {
    (void)state;
    const double truth = 5.0 + 5.0 * cos(sqrt(20e6 / 20e3) * 0.08);
    for (int i = 0; i < 2; i++) {
        double error[2];
        for (int k = 0; k < 2; k++) {
            CzSimulateOptions options = cz_simulate_options_default();
            options.integrator = references[i];
            options.time_step = 1e-2;
            options.tolerance = k == 0 ? 1e-4 : 1e-8;
            Collision elastic =
                collide_so("tests/physics/cases/elastic.yaml", AS_WRITTEN, 0, &options);
            assert_completed(&elastic);
            error[k] = fabs(elastic.summary->vehicle[0].final_speed - truth);
            collision_free(&elastic);
        }
        assert_true(error[1] < 0.05 * error[0]);
        assert_near(error[1], 0.0, 0.0, 1e-6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_integrator_follows_the_elastic_and_plastic_spring),
        cmocka_unit_test(every_integrator_follows_four_stages_and_two_back),
        cmocka_unit_test(every_integrator_exchanges_the_speeds_of_equal_masses),
        cmocka_unit_test(every_integrator_finds_the_time_at_which_a_coupler_shears_off),
        cmocka_unit_test(a_located_drop_does_not_depend_on_the_step),
        cmocka_unit_test(two_cars_on_an_elastic_track_agree),
        cmocka_unit_test(residual_capacity_depends_neither_on_step_nor_on_solver),
        cmocka_unit_test(a_track_without_differential_equations_is_refused),
        cmocka_unit_test(a_reference_converges_to_the_limit_of_the_fixed_step),
        cmocka_unit_test(the_error_of_a_reference_falls_with_its_tolerance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
