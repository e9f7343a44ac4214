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

/* A scenario of a file with up to MAX_SET settings. */
enum { MAX_SET = 3 };
typedef struct Written {
    const char *file;
    int scenario;
    const char *set[MAX_SET];
} Written;

static Case case_written(const Written *written) {
    char path[512];
    snprintf(path, sizeof path, "%s/problems/%s", CZ_SOURCE_FOLDER, written->file);
    CzProblemOptions options = cz_problem_options_default();
    options.set = written->set;
    while (options.n_set < MAX_SET && written->set[options.n_set] != NULL)
        options.n_set++;
    CzError error = {0};
    Case opened = {0};
    if (cz_problem_read(path, &options, &opened.problem, &error) != CZ_OK ||
        cz_model_build(opened.problem, written->scenario, &opened.model, &error) != CZ_OK)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    return opened;
}

/* `set` is one setting, or NULL. */
static Case case_open(const char *file, const char *set) {
    return case_written(&(Written){file, 0, {set}});
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
        (double)summary->status,     (double)summary->ended,
        summary->simulated,          (double)summary->n_step,
        summary->energy.initial,     summary->energy.final_kinetic,
        summary->energy.dissipated,  summary->energy.stored,
        summary->energy.wheel_rail,  summary->energy.balance_error,
        summary->energy.absorbers,   summary->momentum_error,
        summary->energy.track,       summary->energy.moving_load,
        summary->closing_speed,      summary->law_error,
        (double)summary->n_searched, summary->plastic_energy,
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
        number[n++] = interface->peak_time;
        number[n++] = interface->min_overlap;
        number[n++] = interface->vertical_margin;
        for (int side = 0; side < 2; side++) {
            number[n++] = interface->section_force[side];
            number[n++] = interface->swing[side];
        }
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
        number[n++] = vehicle->mean_deceleration_contact;
        number[n++] = vehicle->contact_window[1];
        number[n++] = vehicle->link_force;
        number[n++] = vehicle->bogie_lift_time;
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
    CzPlannedRun design[N_DESIGN];
    for (int i = 0; i < N_DESIGN; i++) {
        CzVehicle *copy = &vehicles[i * n_vehicle];
        memcpy(copy, own, sizeof *own * (size_t)n_vehicle);
        if (i != OWN)
            vary(copy, n_vehicle, i);
        design[i] = (CzPlannedRun){opened.model, copy};
    }

    CzSimulateOptions options = cz_simulate_options_default();
    options.record = false; /* channels are recorded for one design only */
    CzRun *run[N_DESIGN] = {0};
    CzError error = {0};
    if (cz_simulate_batch(N_DESIGN, design, &options, run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    CzRun *alone = run_alone(opened.model, "auto", false);
    assert_same_run(run[OWN], alone);

    /* The neighbours differ from the design, and are the same alone. */
    assert_true(cz_run_summary(run[0])->energy.dissipated !=
                cz_run_summary(run[OWN])->energy.dissipated);
    CzRun *neighbour = NULL;
    if (cz_simulate_batch(1, &design[N_DESIGN - 1], &options, &neighbour, &error) != CZ_OK)
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

/* ---- runs of several models ---- */

enum { MAX_MIXED = 16 };

static void simulate_mixed(const Case *mixed, int first, int n, int step, bool brief, CzRun **run) {
    CzPlannedRun planned[MAX_MIXED];
    CzSimulateOptions options = cz_simulate_options_default();
    CzError error = {0};
    options.record = false;
    options.brief = brief;
    for (int i = 0; i < n; i++) {
        planned[i] = (CzPlannedRun){mixed[first + i * step].model, NULL};
        assert_true(cz_simulate_fits(planned[0].model, planned[i].model, &options));
    }
    if (cz_simulate_batch(n, planned, &options, run, &error) != CZ_OK)
        fail_msg("%s", error.message);
}

/* Runs each model alone, all in one batch, all in reverse order, and some of them. */
static void check_mixed(const Written *written, int n, bool brief) {
    Case mixed[MAX_MIXED];
    CzRun *alone[MAX_MIXED], *among[MAX_MIXED];
    for (int i = 0; i < n; i++) {
        mixed[i] = case_written(&written[i]);
        simulate_mixed(mixed, i, 1, 1, brief, &alone[i]);
    }
    const struct {
        int first, n, step;
    } order[] = {{0, n, 1}, {n - 1, n, -1}, {1, n / 2, 2}, {n / 3, 3, 1}};
    for (size_t k = 0; k < sizeof order / sizeof order[0]; k++) {
        simulate_mixed(mixed, order[k].first, order[k].n, order[k].step, brief, among);
        for (int i = 0; i < order[k].n; i++) {
            assert_same_run(among[i], alone[order[k].first + i * order[k].step]);
            cz_run_free(among[i]);
        }
    }
    long first = cz_run_summary(alone[0])->n_step;
    bool differ = false;
    for (int i = 0; i < n; i++) {
        differ = differ || cz_run_summary(alone[i])->n_step != first;
        cz_run_free(alone[i]);
        case_close(&mixed[i]);
    }
    assert_true(differ); /* some leave the lanes before others */
}

static void scenarios_side_by_side_are_what_they_are_alone(void **state) {
    (void)state;
    static const Written metro[] = {
        {.file = "metro-6-car.yaml", .scenario = 0}, {.file = "metro-6-car.yaml", .scenario = 1},
        {.file = "metro-6-car.yaml", .scenario = 2}, {.file = "metro-6-car.yaml", .scenario = 3},
        {.file = "metro-6-car.yaml", .scenario = 4}, {.file = "metro-6-car.yaml", .scenario = 5},
        {.file = "metro-6-car.yaml", .scenario = 6},
    };
    check_mixed(metro, sizeof metro / sizeof metro[0], true);
}

#define PAIR "two-cars-25kmh.yaml"
#define ELASTIC "simulation.track=receptance"
/* Masses, friction, brakes, speeds, heights, durations, and tracks of different stiffness. */
static const Written variants[] = {
    {PAIR, 0, {ELASTIC}},
    {PAIR, 0, {ELASTIC, "parts.paper-car.mass_t=39"}},
    {PAIR, 0, {ELASTIC, "trains.A.speed_km_h=20", "trains.B.speed_km_h=-10"}},
    {PAIR, 0, {ELASTIC, "simulation.adhesion.friction=0.2"}},
    {PAIR, 0, {ELASTIC, "trains.B.brake.ratio=0.1", "trains.B.brake.axle_share=1"}},
    {PAIR, 0, {ELASTIC, "trains.B.height_offset_mm=30"}},
    {PAIR, 0, {ELASTIC, "simulation.duration_ms=123.4"}},
    {PAIR, 0, {ELASTIC, "track.ballast_stiffness_N_m=6e7"}},
    {PAIR, 0, {ELASTIC, "track.sleeper_spacing_mm=650", "track.ballast_stiffness_N_m=2e8"}},
    {PAIR, 0, {ELASTIC, "trains.A.vehicles.A1.bogie.axle_spacing_mm=2200"}},
    {PAIR, 0, {ELASTIC, "trains.B.vehicles.B1.bogie_spacing_mm=11000"}},
    {PAIR, 0, {ELASTIC, "simulation.duration_ms=200"}},
};

static void variants_side_by_side_are_what_they_are_alone(void **state) {
    (void)state;
    check_mixed(variants, sizeof variants / sizeof variants[0], false);
}

/* A design without a valid model, and one whose numbers overflow because its ends are
 * ten thousand times lighter, do not change their neighbours. */
static void runs_that_fail_leave_their_neighbours_alone(void **state) {
    (void)state;
    enum { REFUSED = 1, UNSTABLE = 2, N = 5 };
    Case opened = case_open(PAIR, ELASTIC);
    CzSimulateOptions options = cz_simulate_options_default();
    int n_vehicle = 0;
    const CzVehicle *own = cz_problem_vehicles(opened.problem, &n_vehicle);
    CzVehicle *changed = malloc(sizeof *changed * (size_t)(2 * n_vehicle));
    assert_non_null(changed);
    for (int k = 0; k < 2; k++)
        memcpy(changed + k * n_vehicle, own, sizeof *own * (size_t)n_vehicle);
    changed[0].front.anti_climber.stages[0].stroke = -1.0;
    for (int i = 0; i < n_vehicle; i++)
        changed[n_vehicle + i].front.mass *= 1e-4;
    CzPlannedRun planned[N];
    for (int i = 0; i < N; i++)
        planned[i] = (CzPlannedRun){opened.model, NULL};
    planned[REFUSED].vehicles = changed;
    planned[UNSTABLE].vehicles = changed + n_vehicle;
    CzRun *run[N] = {NULL};
    CzError error = {0};
    options.record = false;
    if (cz_simulate_batch(N, planned, &options, run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    CzRun *alone = run_alone(opened.model, "auto", false);
    for (int i = 0; i < N; i++) {
        const CzRunSummary *summary = cz_run_summary(run[i]);
        if (i == REFUSED)
            assert_non_null(strstr(summary->failure, "no model was built"));
        else if (i == UNSTABLE)
            assert_non_null(strstr(summary->failure, "not a finite number"));
        else
            assert_same_run(run[i], alone);
        cz_run_free(run[i]);
    }
    cz_run_free(alone);
    free(changed);
    case_close(&opened);
}

/* Runs of other time steps, tracks or numbers of cars do not share a batch. */
static void only_models_that_fit_share_a_batch(void **state) {
    (void)state;
    static const Written others[] = {
        {PAIR, 0, {ELASTIC, "simulation.time_step_ms=0.05"}},
        {PAIR, 0, {"simulation.track=rigid"}},
        {PAIR, 0, {"simulation.track=modal"}},
        {.file = "metro-6-car.yaml"},
    };
    const CzSimulateOptions options = cz_simulate_options_default();
    Case own = case_open(PAIR, ELASTIC);
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        Case other = case_written(&others[i]);
        assert_false(cz_simulate_fits(own.model, other.model, &options));
        case_close(&other);
    }
    case_close(&own);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instruction_sets_agree_on_two_cars),
        cmocka_unit_test(instruction_sets_agree_on_two_trains),
        cmocka_unit_test(instruction_sets_agree_on_elastic_rails),
        cmocka_unit_test(a_design_among_others_is_what_it_is_alone_on_elastic_rails),
        cmocka_unit_test(a_design_among_others_is_what_it_is_alone_for_two_cars),
        cmocka_unit_test(a_design_among_others_is_what_it_is_alone_for_two_trains),
        cmocka_unit_test(scenarios_side_by_side_are_what_they_are_alone),
        cmocka_unit_test(variants_side_by_side_are_what_they_are_alone),
        cmocka_unit_test(runs_that_fail_leave_their_neighbours_alone),
        cmocka_unit_test(only_models_that_fit_share_a_batch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
