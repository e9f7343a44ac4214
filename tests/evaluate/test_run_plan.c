/* Runs are cut into batches that fill the lanes, of models that fit, for all threads. */
#include "support/check.h"

#include "evaluate/run_plan.h"
#include "model/model.h"

/* Two scenarios of 2 cars, one of 6. */
static CzModel pair, other_pair, six;

static void set_up_models(void) {
    static CzSimulation simulation = {.track = CZ_TRACK_RIGID};
    CzModel *const model[] = {&pair, &other_pair, &six};
    for (int i = 0; i < 3; i++)
        *model[i] = (CzModel){.simulation = &simulation, .n_car = i < 2 ? 2 : 6, .time_step = 1e-4};
}

/* Plans n designs in the scenarios; every run is in one chunk, and a chunk is of models that fit.
 */
static CzRunPlan plan_of(int n_design, int n_scene, CzModel *const *model, const double *length,
                         bool is_single, int n_job) {
    const CzSimulateOptions options = cz_simulate_options_default();
    CzRunPlan plan;
    assert_int_equal(cz_run_plan_begin(&plan, n_design * n_scene, NULL), CZ_OK);
    for (int design = 0; design < n_design; design++)
        for (int scene = 0; scene < n_scene; scene++)
            plan.item[plan.n_item++] = (CzRunItem){
                .design = design, .scene = scene, .model = model[scene], .length = length[scene]};
    assert_int_equal(cz_run_plan_cut(&plan, &options, is_single, n_job, NULL), CZ_OK);
    int n = 0;
    for (int i = 0; i < plan.n_chunk; i++) {
        const CzRunChunk *chunk = &plan.chunk[i];
        assert_int_equal(chunk->first, n);
        assert_true(chunk->n > 0);
        for (int k = 0; k < chunk->n; k++)
            assert_true(cz_simulate_fits(plan.item[n].model, plan.item[n + k].model, &options));
        n += chunk->n;
    }
    assert_int_equal(n, n_design * n_scene);
    return plan;
}

static void scenarios_of_trains_of_one_length_share_a_batch(void **state) {
    (void)state;
    CzModel *const model[] = {&pair, &six, &other_pair};
    const double length[] = {0.0, 0.0, 0.0};
    set_up_models();
    CzRunPlan plan = plan_of(2, 3, model, length, false, 1);
    assert_int_equal(plan.n_chunk, 2);
    assert_int_equal(plan.chunk[0].n, 4);
    assert_int_equal(plan.chunk[1].n, 2);
    cz_run_plan_free(&plan);
}

static void few_runs_are_shared_by_the_threads_where_they_fill_more_than_a_block(void **state) {
    (void)state;
    CzModel *const pairs[] = {&pair, &other_pair}, *const sixes[] = {&six};
    const double length[] = {0.0, 0.0};
    set_up_models();
    CzRunPlan plan = plan_of(2, 2, pairs, length, false, 2);
    assert_int_equal(plan.n_chunk, 1); /* 8 lanes */
    cz_run_plan_free(&plan);
    plan = plan_of(4, 1, sixes, length, false, 2);
    assert_int_equal(plan.n_chunk, 2); /* of 12 lanes each */
    assert_int_equal(plan.chunk[0].n, 2);
    cz_run_plan_free(&plan);
    plan = plan_of(64, 1, sixes, length, false, 2);
    assert_int_equal(plan.n_chunk, 4); /* 64 x 6 lanes in batches of 96 */
    cz_run_plan_free(&plan);
}

static void long_runs_come_first_and_chunks_take_as_long_as_one_another(void **state) {
    (void)state;
    CzModel *const model[] = {&six, &six, &six, &six, &six};
    const double length[] = {1.0, 1.0, 4.0, 1.0, 1.0};
    set_up_models();
    CzRunPlan plan = plan_of(1, 5, model, length, false, 2);
    assert_int_equal(plan.n_chunk, 2);
    assert_int_equal(plan.chunk[0].n, 1);
    assert_int_equal(plan.item[0].scene, 2);
    assert_int_equal(plan.chunk[1].n, 4);
    cz_run_plan_free(&plan);
}

static void recorded_runs_are_single(void **state) {
    (void)state;
    CzModel *const model[] = {&pair, &other_pair};
    const double length[] = {1.0, 2.0};
    set_up_models();
    CzRunPlan plan = plan_of(3, 2, model, length, true, 2);
    assert_int_equal(plan.n_chunk, 6);
    cz_run_plan_free(&plan);
}

static void no_runs_are_no_chunks(void **state) {
    (void)state;
    set_up_models();
    CzRunPlan plan = plan_of(0, 0, NULL, NULL, false, 2);
    assert_int_equal(plan.n_chunk, 0);
    cz_run_plan_free(&plan);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenarios_of_trains_of_one_length_share_a_batch),
        cmocka_unit_test(few_runs_are_shared_by_the_threads_where_they_fill_more_than_a_block),
        cmocka_unit_test(long_runs_come_first_and_chunks_take_as_long_as_one_another),
        cmocka_unit_test(recorded_runs_are_single),
        cmocka_unit_test(no_runs_are_no_chunks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
