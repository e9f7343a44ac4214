/* Fits of parameters to measurements: the parameters of a run are recovered, and parameters that
 * cannot be identified are reported. */
#include "optimise/loopholes.h"

#include <unistd.h>

/* One full car onto its mirror image, 200 ms of it. %s: settings. */
static const char collision[] =
    "schema: 1\n"
    "title: a car whose parameters are sought\n"
    "catalogue: [problems/catalogue/generic.yaml]\n"
    "simulation: {track: rigid, adhesion: {friction: 0.3}, output_step_ms: 1}\n"
    "trains:\n"
    "  - {name: A, speed_km_h: 25, brake: {ratio: 0.1, axle_share: 1},\n"
    "     vehicles: [{name: A1, use: driving-car}]}\n"
    "  - {name: B, speed_km_h: -25, brake: {ratio: 0.1, axle_share: 1}, copy: A, reversed: true}\n"
    "scenarios: [{name: crash, duration_ms: 200}]\n";

static const char truth[] = "set: {parts.bogie.link.stiffness_MN_m: 6.3,\n"
                            "      parts.middle-car.mass_t: 35.5,\n"
                            "      simulation.adhesion.friction: 0.08,\n"
                            "      \"parts.anti-climber.stages[0].force_kN\": 571}\n";

/* Writes the channels of the true run, as `run` does, into a file whose name is returned. */
static const char *measured(void) {
    static char path[64];
    if (path[0] != '\0')
        return path;
    snprintf(path, sizeof path, "/tmp/crushzone-measured-%d.csv", (int)getpid());
    Case made = begin_with(problem_of_text(collision, truth), 1);
    CzEvaluation evaluation;
    CzError error = {0};
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, true, &evaluation, &error), CZ_OK);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    const CzRun *run = evaluation.run[0];
    const int n = cz_run_n_column(run);
    for (int i = 0; i < n; i++) {
        char name[CZ_CHANNEL_SIZE];
        const CzColumn column = cz_run_column(run, i);
        const CzChannelInfo *info = cz_channel_info(column.channel);
        const char *place = cz_run_place_name(cz_run_summary(run), info->at, column.place);
        fprintf(file, "%s%s", cz_channel_name(info, column.place, place, name),
                i + 1 < n ? "," : "\n");
    }
    for (int k = 0; k < cz_run_n_sample(run); k++)
        for (int i = 0; i < n; i++) {
            const CzColumn column = cz_run_column(run, i);
            fprintf(file, "%.17g%s", cz_run_channel(run, column.channel, column.place)[k],
                    i + 1 < n ? "," : "\n");
        }
    fclose(file);
    cz_evaluation_free(&evaluation);
    end(&made);
    return path;
}

static Case begin_fit(const char *matches, const char *variables, int evaluations) {
    char more[4096];
    snprintf(more, sizeof more,
             "optimise:\n"
             "  evaluations: %d\n"
             "  match: [%s]\n"
             "  variables: [%s]\n",
             evaluations, matches, variables);
    return begin_with(problem_of_text(collision, more), 2);
}

static const char variables[] =
    "{path: parts.bogie.link.stiffness_MN_m, min: 2, max: 20},\n"
    "{path: parts.middle-car.mass_t, min: 30, max: 42},\n"
    "{path: simulation.adhesion.friction, min: 0.02, max: 0.5},\n"
    "{path: \"parts.anti-climber.stages[0].force_kN\", min: 300, max: 800}";

/* Steps on residuals converge quadratically, so the error after 300 evaluations is the smallest
 * secant, 1e-6 of the range. */
static void parameters_of_a_run_are_found_in_its_time_histories(void **state) {
    (void)state;
    char matches[512];
    snprintf(matches, sizeof matches,
             "{name: speed, channel: v_A1_m_s, file: %s, tolerance: 0.02},\n"
             "{name: force, channel: F_A1-B1_kN, file: %s, from_ms: 20, to_ms: 150, tolerance: "
             "50}",
             measured(), measured());
    Case made = begin_fit(matches, variables, 300);
    optimise(&made, NULL);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_near(outcome->best[0], 6.3, 1e-6, 0);
    assert_near(outcome->best[1], 35.5, 1e-6, 0);
    assert_near(outcome->best[2], 0.08, 1e-6, 0);
    assert_near(outcome->best[3], 571, 1e-6, 0);
    assert_int_equal(outcome->best_evaluation.n_match, 2);
    for (int i = 0; i < 2; i++)
        assert_true(outcome->best_evaluation.match[i].is_history &&
                    fabs(outcome->best_evaluation.match[i].residual) < 1e-3);
    for (int i = 0; i < 4; i++)
        assert_false(outcome->at_bound[i]);
    assert_true(outcome->best_evaluation.objective < 1e-4);
    assert_true(outcome->start_evaluation.objective > 100);
    assert_int_equal(outcome->start_evaluation.n_match, 2);
    end(&made);
}

/* An evaluation equals the run of the file with the numbers typed in, to the last bit. */
static void parameters_equal_the_file_with_these_numbers(void **state) {
    (void)state;
    Case fit = begin_fit("{name: peak, metric: interfaces.peak_force_kN, value: 0, tolerance: 1}",
                         variables, 10);
    Case typed = begin_with(problem_of_text(collision, truth), 1);
    const double x[] = {6.3, 35.5, 0.08, 571};
    CzEvaluation by_numbers, by_file;
    CzError error = {0};
    assert_int_equal(cz_evaluate(fit.evaluator, 1, x, true, &by_numbers, &error), CZ_OK);
    assert_int_equal(cz_evaluate(typed.evaluator, 1, NULL, true, &by_file, &error), CZ_OK);
    const CzRunSummary *a = cz_run_summary(by_numbers.run[0]);
    const CzRunSummary *b = cz_run_summary(by_file.run[0]);
    assert_string_equal(a->scenario, b->scenario);
    assert_int_equal(a->n_step, b->n_step);
    assert_memory_equal(&a->interface[0].peak_force, &b->interface[0].peak_force, sizeof(double));
    assert_memory_equal(&a->energy.wheel_rail, &b->energy.wheel_rail, sizeof(double));
    assert_memory_equal(&a->vehicle[1].final_speed, &b->vehicle[1].final_speed, sizeof(double));
    cz_evaluation_free(&by_numbers);
    cz_evaluation_free(&by_file);
    end(&fit);
    end(&typed);
}

/* Metrics, times of events and values of channels at a time, against the true run. */
static void scalars_and_times_of_events_are_matched(void **state) {
    (void)state;
    Case made = begin_with(problem_of_text(collision, truth), 1);
    CzEvaluation run;
    CzError error = {0};
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, true, &run, &error), CZ_OK);
    const CzRunSummary *summary = cz_run_summary(run.run[0]);
    double touch = NAN, speed = NAN;
    for (int i = 0; i < summary->n_event; i++)
        if (summary->event[i].what == CZ_EVENT_ANTI_CLIMBER_CONTACT)
            touch = summary->event[i].time;
    speed = cz_run_channel(run.run[0], CZ_CHANNEL_BODY_SPEED, 0)[150];
    char matches[1024], with_truth[2048];
    snprintf(matches, sizeof matches,
             "{name: peak, metric: interfaces.peak_force_kN, value: %.17g, tolerance: 45},\n"
             "{name: touch, event: anti_climber_contact, where: A1-B1, value: %.17g, tolerance: "
             "2},\n"
             "{name: speed, channel: v_A1_m_s, time_ms: 150, value: %.17g, tolerance: 0.14, "
             "weight: 2}",
             summary->interface[0].peak_force / 1e3, 1e3 * touch + 1, speed);
    snprintf(with_truth, sizeof with_truth,
             "%soptimise: {match: [%s], variables: [{path: parts.middle-car.mass_t, min: 30, max: "
             "40}]}\n",
             truth, matches);
    cz_evaluation_free(&run);
    end(&made);
    made = begin_with(problem_of_text(collision, with_truth), 1);
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, true, &run, &error), CZ_OK);
    assert_int_equal(run.n_match, 3);
    assert_near(run.match[0].residual, 0, 0, 1e-9);
    assert_near(run.match[1].residual, -0.5, 1e-9, 0);
    assert_near(run.match[2].residual, 0, 0, 1e-9);
    assert_near(run.objective, 0.25, 1e-9, 0);
    assert_int_equal(run.n_constraint, 3); /* checks are not constraints of a fit */
    assert_near(run.constraint[1], -0.5, 1e-9, 0);
    assert_near(run.violation, 0, 0, 0);
    cz_evaluation_free(&run);
    end(&made);
}

static void a_missing_value_counts_as_many_tolerances(void **state) {
    (void)state;
    Case made = begin_fit("{name: never, event: override, value: 199, tolerance: 5},\n"
                          "{name: early, event: override, value: 50, tolerance: 5}",
                          "{path: parts.middle-car.mass_t, min: 30, max: 40}", 1);
    CzEvaluation run;
    CzError error = {0};
    assert_int_equal(cz_evaluate(made.evaluator, 1, NULL, true, &run, &error), CZ_OK);
    assert_near(run.match[0].residual, 10, 0, 0);
    assert_near(run.match[1].residual, 30, 1e-9, 0); /* (200 - 50) / 5 */
    assert_true(isnan(run.match[0].value));
    assert_string_equal(run.constraint_check[0].why, "the run does not record it");
    cz_evaluation_free(&run);
    end(&made);
}

static void parameter_at_its_bound_is_reported(void **state) {
    (void)state;
    char match[256];
    snprintf(match, sizeof match, "{name: speed, channel: v_A1_m_s, file: %s, tolerance: 0.02}",
             measured());
    Case made = begin_fit(match, "{path: parts.middle-car.mass_t, min: 37, max: 42}", 40);
    optimise(&made, NULL);
    assert_true(made.outcome->at_bound[0]);
    assert_near(made.outcome->best[0], 37, ROUNDING_OF_A_VALUE, 0);
    assert_int_equal(made.outcome->status, CZ_OUTCOME_INFEASIBLE); /* not within its tolerance */
    end(&made);
}

/* One number cannot identify two parameters. */
static void sets_that_fit_equally_well_are_reported(void **state) {
    (void)state;
    Case made = begin_fit("{name: touch, event: anti_climber_contact, value: 50, tolerance: 1}",
                          "{path: parts.middle-car.mass_t, min: 30, max: 42},\n"
                          "{path: parts.anti-climber.gap_mm, min: 300, max: 360}",
                          150);
    optimise(&made, NULL);
    const CzOutcome *outcome = made.outcome;
    assert_int_equal(outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_true(outcome->n_alternative >= 2);
    for (int i = 0; i < outcome->n_alternative; i++) {
        const double *set = outcome->alternative + 2 * i;
        const double apart =
            hypot((set[0] - outcome->best[0]) / 12, (set[1] - outcome->best[1]) / 60);
        assert_true(apart / sqrt(2) >= 0.1 * (1 - 1e-9));
        CzEvaluation run;
        CzError error = {0};
        assert_int_equal(cz_evaluate(made.evaluator, 1, set, false, &run, &error), CZ_OK);
        assert_true(run.violation <= 0);
        assert_memory_equal(&run.objective, &outcome->alternative_objective[i], sizeof(double));
        cz_evaluation_free(&run);
    }
    end(&made);
}

/* The tube no longer fits into the coupler: no run, and never the best design. */
static void parameters_that_the_reader_refuses_are_failed_designs(void **state) {
    (void)state;
    Case made = begin_fit(
        "{name: peak, metric: interfaces.peak_force_kN, value: 3000, tolerance: 1e3}",
        "{path: \"parts.front-coupler.tube.stages[0].stroke_mm\", min: 200, max: 3000}", 60);
    CzEvaluation run;
    CzError error = {0};
    const double x = 2900;
    assert_int_equal(cz_evaluate(made.evaluator, 1, &x, false, &run, &error), CZ_OK);
    assert_int_equal(run.status, CZ_STATUS_RUN_FAILED);
    assert_true(isnan(run.objective));
    cz_evaluation_free(&run);
    optimise(&made, NULL);
    assert_int_equal(made.outcome->best_evaluation.status, CZ_OK);
    end(&made);
}

/* A fit that cannot begin: the error of its only match, on line 12. */
static void assert_refused(const char *match, const char *message, const char *help) {
    char more[1024];
    CzEvaluator *evaluator = NULL;
    CzError error = {0};
    snprintf(more, sizeof more, "optimise:\n  evaluations: 10\n  match: [%s]\n  variables: [%s]\n",
             match, variables);
    CzProblem *problem = problem_of_text(collision, more);
    CzOutcome *outcome = NULL;
    const CzEvaluatorOptions options = {.n_job = 1, .step_factor = 1};
    CzStatus status = cz_evaluator_build(problem, &options, &evaluator, &error);
    if (status == CZ_OK)
        status = cz_optimise(evaluator, NULL, &outcome, &error);
    assert_int_equal(status, CZ_STATUS_INPUT);
    assert_string_equal(error.message, message);
    assert_non_null(strstr(error.help, help));
    assert_int_equal(error.line, 12);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

static void unknown_channel_is_reported_with_its_place(void **state) {
    (void)state;
    assert_refused("{name: speed, channel: v_A2_m_s, time_ms: 150, value: 1, tolerance: 0.1}",
                   "there is no channel 'v_A2_m_s'", "did you mean 'v_A1_m_s'?");
}

static void channel_that_these_vehicles_lack_is_reported_with_its_place(void **state) {
    (void)state;
    assert_refused(
        "{name: buffers, channel: F_side-buffers_A1-B1_kN, time_ms: 9, value: 1, tolerance: 1}",
        "a run of scenario 'crash' does not record 'F_side-buffers_A1-B1_kN'", "channels.csv");
}

static int remove_measured(void **state) {
    (void)state;
    return remove(measured());
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parameters_of_a_run_are_found_in_its_time_histories),
        cmocka_unit_test(parameters_equal_the_file_with_these_numbers),
        cmocka_unit_test(scalars_and_times_of_events_are_matched),
        cmocka_unit_test(a_missing_value_counts_as_many_tolerances),
        cmocka_unit_test(parameter_at_its_bound_is_reported),
        cmocka_unit_test(sets_that_fit_equally_well_are_reported),
        cmocka_unit_test(parameters_that_the_reader_refuses_are_failed_designs),
        cmocka_unit_test(unknown_channel_is_reported_with_its_place),
        cmocka_unit_test(channel_that_these_vehicles_lack_is_reported_with_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, remove_measured);
}
