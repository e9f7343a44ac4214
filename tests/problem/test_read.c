/* Reading of whole problems: what good files become. */
#include "support/check.h"

#include "problem/problem.h"

#define FOLDER CZ_SOURCE_FOLDER "/tests/problem/good/"

static CzProblem *read_good(const char *path, int n_set, const char *const *set) {
    CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzError error = {0};
    options.set = set;
    options.n_set = n_set;
    const CzStatus status = cz_problem_read(path, &options, &problem, &error);
    if (status != CZ_OK)
        print_error("%s:%d:%d: %s (%s)\n", error.file, error.line, error.column, error.message,
                    error.help);
    assert_int_equal(status, CZ_OK);
    assert_non_null(problem);
    return problem;
}

static void values_are_in_si_units_and_absent_ones_have_their_defaults(void **state) {
    (void)state;
    CzProblem *problem = read_good(FOLDER "rigid.yaml", 0, NULL);
    const CzInput *input = cz_problem_input(problem);
    assert_string_equal(cz_problem_title(problem), "Two rigid cars");
    assert_int_equal(input->n_trains, 2);
    assert_near(input->trains[0].speed, 10, 1e-15, 0);
    const CzVehicle *car = &input->trains[0].vehicles[0];
    assert_string_equal(car->name, "A1");
    assert_int_equal(car->model, CZ_MODEL_RIGID);
    assert_near(car->mass, 44e3, 0, 0);
    assert_near(car->payload, 0, 0, 0);
    assert_true(isnan(car->length));
    assert_true(car->front.given);
    assert_false(car->bogie.given);
    assert_int_equal(car->front.n_stages, 2);
    assert_near(car->front.stages[1].force, 2e6, 0, 0);
    assert_true(isnan(car->front.stages[1].end_force));
    assert_int_equal(car->front.anti_climber.count, 1);
    assert_near(car->front.anti_climber.stiffness, 2e8, 0, 0);
    assert_near(input->trains[1].vehicles[0].front.anti_climber.gap, 0.12, 1e-15, 0);
    assert_near(input->trains[1].vehicles[0].rear.anti_climber.gap, 0.1, 1e-15, 0);
    cz_problem_free(problem);
}

static void copied_and_turned_trains_are_written_out_along_x(void **state) {
    (void)state;
    CzProblem *problem = read_good(FOLDER "full.yaml", 0, NULL);
    static const char *const names[] = {"A1", "A2", "A3", "A4", "B1", "B2", "B3", "B4"};
    int n_vehicle = 0;
    const CzVehicle *vehicle = cz_problem_vehicles(problem, &n_vehicle);
    assert_int_equal(n_vehicle, 8);
    for (int i = 0; i < 8; i++)
        assert_string_equal(vehicle[i].name, names[i]);
    assert_ptr_equal(cz_problem_input(problem)->trains[1].vehicles, &vehicle[4]);
    assert_true(vehicle[0].rear.anti_climber.given && !vehicle[0].front.anti_climber.given);
    assert_true(vehicle[3].front.anti_climber.given && !vehicle[3].rear.anti_climber.given);
    assert_true(vehicle[4].rear.anti_climber.given && !vehicle[4].front.anti_climber.given);
    assert_near(vehicle[4].mass, 39e3, 0, 0);
    assert_near(vehicle[7].mass, 38.7e3, 0, 0);
    assert_near(vehicle[3].front.coupler.tube.trigger, 950e3, 0, 0);
    assert_near(vehicle[3].front.coupler.tube.stages[0].force, 900e3, 0, 0);
    assert_near(vehicle[2].rear.coupler.tube.trigger, 1e6, 0, 0);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_in_si_units_and_absent_ones_have_their_defaults),
        cmocka_unit_test(copied_and_turned_trains_are_written_out_along_x),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
