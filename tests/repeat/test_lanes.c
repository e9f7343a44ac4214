/* The result of a design is the same to the last bit alone and among others, on every instruction
 * set.
 */
#include "support/check.h"

#include "problem/problem.h"
#include "simulate/batch.h"

typedef struct Case {
    CzProblem *problem;
    CzModel *model;
} Case;

/* `set` is one setting, or NULL. */
static Case case_open(const char *file, const char *set) {
    char path[512];
    snprintf(path, sizeof path, "%s/problems/%s", CZ_SOURCE_FOLDER, file);
    CzProblemOptions options = cz_problem_options_default();
    options.set = &set;
    options.n_set = set != NULL;
    CzError error = {0};
    Case opened = {0};
    if (cz_problem_read(path, &options, &opened.problem, &error) != CZ_OK ||
        cz_model_build(opened.problem, 0, &opened.model, &error) != CZ_OK)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    return opened;
}

static void case_close(Case *opened) {
    cz_model_free(opened->model);
    cz_problem_free(opened->problem);
}

/* All results of a run, one after the other. */
static size_t numbers_of(const CzRun *run, double *number, size_t n_most) {
    size_t n = 0;
    const CzRunSummary *summary = cz_run_summary(run);
    const double scalars[] = {
        (double)summary->status,       (double)summary->ended,      summary->simulated,
        (double)summary->n_step,       summary->energy.initial,     summary->energy.final_kinetic,
        summary->energy.dissipated,    summary->energy.stored,      summary->energy.wheel_rail,
        summary->energy.balance_error, summary->energy.absorbers,   summary->momentum_error,
        summary->energy.track,         summary->energy.moving_load, summary->closing_speed,
        (double)summary->n_event,
    };
    for (size_t i = 0; i < sizeof scalars / sizeof *scalars; i++)
        number[n++] = scalars[i];
    for (int i = 0; i < summary->n_event; i++)
        number[n++] = summary->event[i].time;
    for (int i = 0; i < summary->n_interface; i++) {
        const CzInterfaceResult *interface = &summary->interface[i];
        number[n++] = interface->peak_force;
        number[n++] = interface->shortening;
        number[n++] = interface->energy;
        for (int element = 0; element < interface->n_element; element++) {
            number[n++] = interface->element[element].energy;
            number[n++] = interface->element[element].stroke;
            number[n++] = interface->element[element].peak_force;
        }
    }
    for (int i = 0; i < summary->n_vehicle; i++) {
        const CzVehicleResult *vehicle = &summary->vehicle[i];
        number[n++] = vehicle->final_speed;
        number[n++] = vehicle->peak_deceleration;
        number[n++] = vehicle->mean_deceleration_120ms;
        number[n++] = vehicle->max_pitch;
        for (int wheelset = 0; wheelset < 4; wheelset++)
            number[n++] = vehicle->wheel_lift[wheelset];
    }
    assert_true(n <= n_most);
    return n;
}

static void assert_same_run(const CzRun *a, const CzRun *b) {
    static double first[4096], second[4096];
    assert_string_equal(cz_run_summary(a)->failure, cz_run_summary(b)->failure);
    const size_t n = numbers_of(a, first, 4096);
    assert_int_equal(numbers_of(b, second, 4096), n);
    for (size_t i = 0; i < n; i++) {
        if (memcmp(&first[i], &second[i], sizeof first[i]) != 0)
            fail_msg("number %zu: %.17g is not %.17g", i, first[i], second[i]);
    }
    assert_int_equal(cz_run_n_column(a), cz_run_n_column(b));
    assert_int_equal(cz_run_n_sample(a), cz_run_n_sample(b));
    for (int i = 0; i < cz_run_n_column(a); i++) {
        const CzColumn column = cz_run_column(a, i);
        assert_int_equal(column.channel, cz_run_column(b, i).channel);
        assert_int_equal(column.place, cz_run_column(b, i).place);
        assert_memory_equal(cz_run_channel(a, column.channel, column.place),
                            cz_run_channel(b, column.channel, column.place),
                            sizeof(double) * (size_t)cz_run_n_sample(a));
    }
}

static CzRun *run_alone(const CzModel *model, const char *isa, bool record) {
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = record;
    options.isa = isa;
    CzRun *run = NULL;
    CzError error = {0};
    if (cz_simulate(model, &options, &run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_string_equal(cz_run_summary(run)->failure, "");
    return run;
}

static void check_instruction_sets(const char *file, const char *set) {
    /* Each set includes the ones before it. */
    const char *const isa[] = {"baseline", "v3", "v4"};
    Case opened = case_open(file, set);
    CzRun *reference = run_alone(opened.model, "auto", true);
    bool is_here = true;
    for (int i = 0; i < 3 && is_here; i++) {
        CzRun *run = run_alone(opened.model, isa[i], true);
        assert_same_run(reference, run);
        cz_run_free(run);
        is_here = strcmp(cz_isa_name(), isa[i]) != 0;
    }
    assert_false(is_here); /* the set of this machine was among them */
    cz_run_free(reference);
    case_close(&opened);
}

static void instruction_sets_agree_on_two_cars(void **state) {
    (void)state;
    check_instruction_sets("two-cars-25kmh.yaml", NULL);
}

static void instruction_sets_agree_on_two_trains(void **state) {
    (void)state;
    check_instruction_sets("first-collision.yaml", NULL);
}

/* On elastic rails, with wheels that lift off. */
static const char *const elastic[] = {"simulation.track=modal", "simulation.track=receptance"};

static void instruction_sets_agree_on_elastic_rails(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++)
        check_instruction_sets("paper-25kmh.yaml", elastic[i]);
}

enum { N_DESIGN = 11, OWN = 6 };

/* Neighbours differ from the design in the middle: every one has other anti-climbers and tubes. */
static void vary(CzVehicle *vehicle, int n_vehicle, int design) {
    const double factor = 1 + 0.03 * (design - OWN);
    for (int i = 0; i < n_vehicle; i++) {
        CzEnd *ends[] = {&vehicle[i].front, &vehicle[i].rear};
        for (int end = 0; end < 2; end++) {
            for (int stage = 0; stage < ends[end]->anti_climber.n_stages; stage++)
                ends[end]->anti_climber.stages[stage].force *= factor;
            for (int stage = 0; stage < ends[end]->coupler.tube.n_stages; stage++)
                ends[end]->coupler.tube.stages[stage].force *= factor;
        }
    }
}

static void check_batch(const char *file, const char *set) {
    Case opened = case_open(file, set);
    int n_vehicle = 0;
    const CzVehicle *own = cz_problem_vehicles(opened.problem, &n_vehicle);
    CzVehicle *vehicles = malloc(sizeof *vehicles * (size_t)(N_DESIGN * n_vehicle));
    assert_non_null(vehicles);
    const CzVehicle *design[N_DESIGN];
    for (int i = 0; i < N_DESIGN; i++) {
        CzVehicle *copy = &vehicles[i * n_vehicle];
        memcpy(copy, own, sizeof *own * (size_t)n_vehicle);
        if (i != OWN)
            vary(copy, n_vehicle, i);
        design[i] = copy;
    }

    CzSimulateOptions options = cz_simulate_options_default();
    options.record = false; /* channels are recorded for one design only */
    CzRun *run[N_DESIGN] = {0};
    CzError error = {0};
    if (cz_simulate_batch(opened.model, N_DESIGN, design, &options, run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    CzRun *alone = run_alone(opened.model, "auto", false);
    assert_same_run(run[OWN], alone);

    /* The neighbours differ from the design, and are the same alone. */
    assert_true(cz_run_summary(run[0])->energy.dissipated !=
                cz_run_summary(run[OWN])->energy.dissipated);
    CzRun *neighbour = NULL;
    if (cz_simulate_batch(opened.model, 1, &design[N_DESIGN - 1], &options, &neighbour, &error) !=
        CZ_OK)
        fail_msg("%s", error.message);
    assert_same_run(run[N_DESIGN - 1], neighbour);

    for (int i = 0; i < N_DESIGN; i++)
        cz_run_free(run[i]);
    cz_run_free(neighbour);
    cz_run_free(alone);
    free(vehicles);
    case_close(&opened);
}

static void a_design_among_others_is_what_it_is_alone_for_two_cars(void **state) {
    (void)state;
    check_batch("two-cars-25kmh.yaml", NULL);
}

static void a_design_among_others_is_what_it_is_alone_for_two_trains(void **state) {
    (void)state;
    check_batch("first-collision.yaml", NULL);
}

static void a_design_among_others_is_what_it_is_alone_on_elastic_rails(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++)
        check_batch("paper-25kmh.yaml", elastic[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instruction_sets_agree_on_two_cars),
        cmocka_unit_test(instruction_sets_agree_on_two_trains),
        cmocka_unit_test(instruction_sets_agree_on_elastic_rails),
        cmocka_unit_test(a_design_among_others_is_what_it_is_alone_on_elastic_rails),
        cmocka_unit_test(a_design_among_others_is_what_it_is_alone_for_two_cars),
        cmocka_unit_test(a_design_among_others_is_what_it_is_alone_for_two_trains),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
