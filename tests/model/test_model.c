/* The model of a scenario: cars, lanes, facts, step bounds, refusals. */
#include "support/check.h"

#include "model/own_design.h"
#include "support/typed_problem.h"

static CzModel *built(struct CzProblem *problem) {
    CzModel *model = NULL;
    CzError error = {0};
    if (cz_model_build(problem, 0, &model, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return model;
}

static void the_benchmark_coach_has_its_published_frequencies(void **state) {
    (void)state;
    const CzVehicle coach = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &coach, 1, &coach, 10.0);
    CzModel *model = built(&problem);
    const CzVehicleFacts facts = cz_model_vehicle_facts(model, 0);
    assert_near(facts.bounce_frequency, 1.0725, 0.0, 5e-5);
    assert_near(facts.pitch_frequency, 1.2973, 0.0, 5e-5);
    for (int axle = 0; axle < 4; axle++)
        assert_near(facts.axle_load[axle], 91.275e3 + 17.779e3, 0.0, 1.0);
    cz_model_free(model);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_benchmark_coach_has_its_published_frequencies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
