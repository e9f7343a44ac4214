/* Models of the shipped problems, from their files. */
#include "support/check.h"

#include "crushzone/model.h"
#include "support/shipped.h"

static CzProblem *read_shipped(const char *name) {
    char path[512];
    snprintf(path, sizeof path, "%s/problems/%s", CZ_SOURCE_FOLDER, name);
    const CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzError error = {0};
    if (cz_problem_read(path, &options, &problem, &error) != CZ_OK)
        fail_msg("%s: %s", path, error.message);
    return problem;
}

static void check_vehicles(const CzModel *model) {
    for (int i = 0; i < cz_model_n_vehicle(model); i++) {
        const CzVehicleProperties properties = cz_model_vehicle_properties(model, i);
        if (isnan(properties.mass))
            continue; /* rigid or fixed */
        double load = 0.0;
        for (int axle = 0; axle < 4; axle++)
            load += properties.axle_load[axle];
        assert_near(load, properties.mass * 9.80665, 1e-12, 0.0);
        assert_true(properties.bounce_frequency > 0.5 && properties.bounce_frequency < 3.0);
        assert_true(properties.pitch_frequency > 0.5 && properties.pitch_frequency < 3.0);
    }
}

static void check_scenarios(const char *name) {
    CzProblem *problem = read_shipped(name);
    for (int scenario = 0; scenario < cz_problem_n_scenario(problem); scenario++) {
        CzModel *model = NULL;
        CzError error = {0};
        if (cz_model_build(problem, scenario, &model, &error) != CZ_OK)
            fail_msg("%s: %s", name, error.message);
        check_vehicles(model);
        assert_true(cz_model_n_step_bound(model) > 0);
        assert_true(cz_model_time_step(model) <= 0.5 * cz_model_step_bound(model, 0)->bound);
        cz_model_free(model);
    }
    cz_problem_free(problem);
}

static void every_scenario_of_every_shipped_problem_makes_a_model(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++)
        check_scenarios(shipped.name[i]);
}

static void a_problem_without_a_model_is_refused_at_its_place(void **state) {
    (void)state;
    char path[512];
    snprintf(path, sizeof path, "%s/problems/metro-6-car.yaml", CZ_SOURCE_FOLDER);
    const char *const settings[] = {"parts.inner-coupler-half.gap_mm=500"};
    CzProblemOptions options = cz_problem_options_default();
    options.set = settings;
    options.n_set = 1;
    CzProblem *problem = NULL;
    CzModel *model = NULL;
    CzError error = {0};
    assert_int_equal(cz_problem_read(path, &options, &problem, &error), CZ_OK);
    assert_int_equal(cz_model_build(problem, 0, &model, &error), CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, "overlap by 200 mm when its couplers touch"));
    assert_string_equal(error.file, "--set");
    assert_int_equal(error.column, 26);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scenario_of_every_shipped_problem_makes_a_model),
        cmocka_unit_test(a_problem_without_a_model_is_refused_at_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
