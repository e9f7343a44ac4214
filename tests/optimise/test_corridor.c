/* Corridors: edges of a closed form, the same bytes for any threads, devices by name, failures. */
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "support/check.h"

#include "crushzone/corridor.h"
#include "problem/problem.h"

/* Two rigid vehicles of 40 t, 25 km/h, and one plateau F with an elastic stiffness k. It takes the
 * energy E = mu v^2 / 2 less the elastic part of its last force, and it must neither use more than
 * its stroke s nor reach more than a largest force:
 *
 *   E / F - F / (2 k) <= s,   F <= F_max
 */
#define TWO_MASSES(zone, front)                                                                    \
    "schema: 1\n"                                                                                  \
    "title: two rigid vehicles and one plateau\n"                                                  \
    "parts:\n"                                                                                     \
    "  zone: {gap_mm: 0, stiffness_MN_m: 500, " zone "}\n"                                         \
    "  spare: {gap_mm: 0, stages: [{stroke_mm: 100, force_kN: 500}]}\n"                            \
    "  buffer: {stages: [{stroke_mm: 50, force_kN: 400}]}\n"                                       \
    "  both: {buffer: {use: buffer}, tube: {stages: [{stroke_mm: 100, force_kN: 500}]}}\n"         \
    "trains:\n"                                                                                    \
    "  - name: A\n"                                                                                \
    "    speed_km_h: 25\n"                                                                         \
    "    vehicles: [{name: A1, model: rigid, mass_t: 40, front: {face_gap_m: 5, " front "}}]\n"    \
    "  - name: B\n"                                                                                \
    "    vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {face_gap_m: 0}}]\n"                \
    "simulation: {longest_s: 6}\n"                                                                 \
    "checks:\n"                                                                                    \
    "  design_rules: false\n"                                                                      \
    "  limits:\n"                                                                                  \
    "    - {name: stroke, metric: elements.anti-climber *.stroke_mm, max: 560, source: ours,\n"    \
    "       confidence: user}\n"                                                                   \
    "    - {name: force, metric: interfaces.peak_force_kN, max: 1180.2, source: ours,\n"           \
    "       confidence: user}\n"
#define USED "anti_climber: {use: zone}"

static const char level[] = TWO_MASSES("stages: [{stroke_mm: 560, force_kN: 1000}]", USED);
static const char peaked[] =
    TWO_MASSES("trigger_kN: 1100, stages: [{stroke_mm: 560, force_kN: 1000}]", USED);
static const char staged[] =
    TWO_MASSES("trigger_kN: 800, stages: [{stroke_mm: 150, force_kN: 700, end_force_kN: 820}, "
               "{stroke_mm: 30, force_kN: 900}, {stroke_mm: 300, force_kN: 1100}]",
               USED);
static const char coupled[] =
    TWO_MASSES("stages: [{stroke_mm: 560, force_kN: 1000}]", USED ", coupler: {use: both}");

static const double stiffness = 500e6, stroke = 0.56, largest_force = 1180.2e3;

static CzStatus try_corridor(const char *text, const char *more, CzCorridorOptions options,
                             CzCorridor **corridor, CzError *error) {
    char whole[8192];
    options.n_text = (size_t)snprintf(whole, sizeof whole, "%s%s", text, more);
    options.text = whole;
    return cz_corridor("", NULL, &options, corridor, error);
}

static CzCorridorOptions of_part(const char *part, int n_random) {
    CzCorridorOptions options = cz_corridor_options_default();
    options.part = part;
    options.n_random = n_random;
    options.n_job = 1;
    return options;
}

static CzCorridor *find(const char *text, const char *more, CzCorridorOptions options) {
    CzCorridor *corridor = NULL;
    CzError error = {0};
    if (try_corridor(text, more, options, &corridor, &error) != CZ_OK)
        print_error("%s\n%s\n", error.message, error.help);
    assert_non_null(corridor);
    return corridor;
}

/* The force at which the plateau uses its stroke [N], by bisection. */
static double least_force(double speed) {
    const double energy = 20e3 * speed * speed / 2;
    double low = 5e5, high = 2e6;
    for (int i = 0; i < 60; i++) {
        const double force = (low + high) / 2;
        *(energy / force - force / (2 * stiffness) > stroke ? &low : &high) = force;
    }
    return low;
}

/* A width is the largest step of the resolution below the closed form. */
static void assert_edge(const CzCorridor *corridor, int edge, double closed_form) {
    assert_true(corridor->edge[edge].width <= closed_form);
    assert_true(corridor->edge[edge].width > closed_form - corridor->resolution);
}

/* Verdict of the whole problem with another force of the plateau. */
static bool passes_with(double force) {
    char setting[80];
    snprintf(setting, sizeof setting, "parts.zone.stages[0].force_kN=%.6f", 1e-3 * force);
    const char *const set[] = {setting};
    CzProblemOptions options = cz_problem_options_default();
    options.set = set;
    options.n_set = 1;
    CzProblem *problem = NULL;
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation = {0};
    const CzEvaluatorOptions usual = cz_evaluator_options_default();
    assert_int_equal(
        cz_problem_read_text(level, sizeof level - 1, "level", ".", &options, &problem, NULL),
        CZ_OK);
    assert_int_equal(cz_evaluator_build(problem, &usual, &evaluator, NULL), CZ_OK);
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, false, &evaluation, NULL), CZ_OK);
    const bool passes = cz_verdict_passes(evaluation.verdict);
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
    return passes;
}

static void the_edges_are_those_of_the_closed_form(void **state) {
    (void)state;
    CzCorridor *corridor = find(level, "", of_part("zone", 4));
    assert_true(corridor->exists);
    assert_int_equal(corridor->n_piece, 8);
    assert_edge(corridor, 0, 1 - least_force(25 / 3.6) / 1e6);
    assert_edge(corridor, 1, largest_force / 1e6 - 1);
    assert_true(passes_with(corridor->lower[0]));
    assert_true(passes_with(corridor->upper[0]));
    assert_false(passes_with(corridor->lower[0] - 0.02e6));
    assert_false(passes_with(corridor->upper[0] + 0.02e6));
    cz_corridor_free(corridor);
}

static void every_tried_curve_within_passes_and_one_beyond_each_edge_fails(void **state) {
    (void)state;
    CzCorridor *corridor = find(level, "", of_part("zone", 4));
    int n_inside = 0;
    for (int i = 0; i < corridor->n_curve; i++) {
        bool is_inside = true;
        for (int k = 0; k < corridor->n_piece; k++)
            is_inside &= corridor->curve[i].factor[k] > 1 - corridor->edge[0].width - 1e-9 &&
                         corridor->curve[i].factor[k] < 1 + corridor->edge[1].width + 1e-9;
        n_inside += is_inside;
        assert_true(!is_inside || cz_verdict_passes(corridor->curve[i].verdict));
    }
    assert_int_equal(n_inside, corridor->n_inside);
    for (int edge = 0; edge < 2; edge++) {
        const CzTriedCurve *curve = &corridor->curve[corridor->edge[edge].failing];
        assert_int_equal(curve->verdict, CZ_VERDICT_FAIL);
        assert_string_equal(curve->check, "force");
        assert_string_equal(curve->scenario, "collision");
    }
    cz_corridor_free(corridor);
}

static void a_peak_has_an_edge_of_its_own(void **state) {
    (void)state;
    CzCorridor *corridor = find(peaked, "", of_part("zone", 4));
    assert_string_equal(corridor->peak_word, "trigger");
    assert_edge(corridor, 0, 1 - least_force(25 / 3.6) / 1e6);
    assert_edge(corridor, 1, largest_force / 1.1e6 - 1);
    assert_int_equal(corridor->n_point, 3);
    const double width = corridor->edge[1].width;
    assert_near(corridor->upper[0], 1.1e6 * (1 + width), ROUNDING_OF_A_FORMULA, 0);
    assert_near(corridor->upper[1], 1e6 * (1 + width), ROUNDING_OF_A_FORMULA, 0);
    assert_near(corridor->stroke[1], 0.01, ROUNDING_OF_A_FORMULA, 0);
    cz_corridor_free(corridor);
}

/* ---- pieces ---- */

/* Strengths of pieces add up in another order: measured 7e-15 in crush and force. */
#define PIECES 1e-13

static CzProblem *read(const char *text) {
    CzProblem *problem = NULL;
    const CzProblemOptions options = cz_problem_options_default();
    assert_int_equal(
        cz_problem_read_text(text, strlen(text), "text", ".", &options, &problem, NULL), CZ_OK);
    return problem;
}

static void judge(const CzProblem *problem, CzEvaluator **evaluator, CzEvaluation *evaluation) {
    const CzEvaluatorOptions usual = cz_evaluator_options_default();
    assert_int_equal(cz_evaluator_build(problem, &usual, evaluator, NULL), CZ_OK);
    assert_int_equal(cz_evaluate(*evaluator, 1, NULL, false, evaluation, NULL), CZ_OK);
}

static void a_device_in_pieces_has_the_same_results(void **state) {
    (void)state;
    CzCorridor *corridor = find(staged, "", of_part("zone", 1));
    assert_int_equal(corridor->n_piece, 8); /* 3 of 50 mm, 1 of 30 mm, 4 of 75 mm */
    CzStage piece[CZ_MAX_PIECES] = {0};
    for (int i = 0; i < corridor->n_piece; i++)
        piece[i] = (CzStage){.given = true,
                             .stroke = corridor->piece_stroke[i],
                             .force = corridor->piece_force[i],
                             .end_force = i < 3 ? 740e3 + i * 40e3 : NAN};
    CzProblem *whole = read(staged), *divided = NULL;
    assert_int_equal(cz_problem_read_stages(whole, "parts.zone", 8, piece, &divided, NULL), CZ_OK);
    CzEvaluator *evaluator[2];
    CzEvaluation evaluation[2] = {{0}, {0}};
    judge(whole, &evaluator[0], &evaluation[0]);
    judge(divided, &evaluator[1], &evaluation[1]);
    for (int i = 0; i < evaluation[0].n_check; i++)
        assert_near(evaluation[1].check[i].value, evaluation[0].check[i].value, PIECES, 0);
    for (int i = 0; i < 2; i++) {
        cz_evaluation_free(&evaluation[i]);
        cz_evaluator_free(evaluator[i]);
    }
    cz_problem_free(divided);
    cz_problem_free(whole);
    cz_corridor_free(corridor);
}

static void a_path_names_a_device_too(void **state) {
    (void)state;
    CzCorridor *of_name = find(level, "", of_part("zone", 2));
    CzCorridor *of_path = find(level, "", of_part("trains.A.vehicles.A1.front.anti_climber", 2));
    assert_string_equal(of_path->place[0], "A1 front");
    assert_memory_equal(of_path->edge, of_name->edge, sizeof of_name->edge);
    cz_corridor_free(of_path);
    cz_corridor_free(of_name);
}

static void the_device_must_be_found(void **state) {
    (void)state;
    static const struct {
        const char *part, *message, *help;
    } cases[] = {
        {"zonne", "there is no part 'zonne'", "did you mean 'zone'?"},
        {"spare", "no vehicle has a device 'spare' with stages", "that a vehicle uses"},
        {"both", "'both' has several devices", "name one: both.tube, both.buffer"},
        {"trains.A.vehicles.A2.front.anti_climber", "there is no 'A2' in trains.A.vehicles", "A1"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        CzCorridor *corridor = NULL;
        CzError error = {0};
        assert_int_equal(try_corridor(coupled, "", of_part(cases[i].part, 1), &corridor, &error),
                         CZ_STATUS_INPUT);
        assert_non_null(strstr(error.message, cases[i].message));
        assert_non_null(strstr(error.help, cases[i].help));
    }
}

static void vehicles_with_other_values_are_not_taken_along(void **state) {
    (void)state;
    CzCorridor *corridor = NULL;
    CzError error = {0};
    assert_int_equal(try_corridor(level,
                                  "set: {'trains.A.vehicles.A1.front.anti_climber.stages[0]."
                                  "force_kN': 990}\n",
                                  of_part("zone", 1), &corridor, &error),
                     CZ_STATUS_INPUT);
    assert_null(corridor);
}

/* ---- scatter ---- */

static const char scatter[] =
    "uncertainty:\n"
    "  parameters:\n"
    "    - {name: speed, path: trains.A.speed_km_h, tolerance_percent: 4}\n"
    "    - {name: force, path: 'parts.*.stages[*].force_kN', tolerance_percent: 30}\n"
    "    - {name: stroke, path: 'parts.zone.stages[0].stroke_mm', min: 500, max: 540}\n";

/* The force and the stroke of the device are those of its curves; the speed scatters. */
static void the_edges_hold_in_every_sample(void **state) {
    (void)state;
    CzCorridor *corridor = find(level, scatter, of_part("zone", 6));
    double fastest = 0;
    assert_int_equal(corridor->n_draw, 3);
    for (int k = 0; k < corridor->n_random; k++)
        fastest = fmax(fastest, corridor->value[3 * k]);
    assert_true(fastest > 1.02);
    assert_edge(corridor, 0, 1 - least_force(fastest * 25 / 3.6) / 1e6);
    assert_edge(corridor, 1, largest_force / 1e6 - 1);
    assert_true(corridor->curve[corridor->edge[0].failing].sample >= 0);
    cz_corridor_free(corridor);
    CzCorridorOptions without = of_part("zone", 6);
    without.has_scatter = false;
    corridor = find(level, scatter, without);
    assert_int_equal(corridor->n_draw, 0);
    assert_edge(corridor, 0, 1 - least_force(25 / 3.6) / 1e6);
    cz_corridor_free(corridor);
}

/* ---- the same bytes, failures, interruption ---- */

static void threads_change_nothing(void **state) {
    (void)state;
    CzCorridorOptions options = of_part("zone", 5);
    CzCorridor *one = find(peaked, scatter, options);
    options.n_job = 3;
    CzCorridor *three = find(peaked, scatter, options);
    assert_int_equal(three->n_curve, one->n_curve);
    assert_memory_equal(three->edge, one->edge, sizeof one->edge);
    for (int i = 0; i < one->n_curve; i++) {
        assert_memory_equal(three->curve[i].factor, one->curve[i].factor,
                            sizeof one->curve[i].factor);
        assert_true(three->curve[i].margin == one->curve[i].margin);
    }
    cz_corridor_free(three);
    cz_corridor_free(one);
}

static void a_failing_nominal_design_has_no_corridor(void **state) {
    (void)state;
    CzCorridor *corridor = find(level, "set: {trains.A.speed_km_h: 28}\n", of_part("zone", 2));
    assert_false(corridor->exists);
    assert_string_equal(cz_corridor_failure(corridor)->check, "force");
    assert_int_equal(corridor->n_curve, 1);
    assert_true(corridor->edge[0].width == 0 && corridor->edge[1].width == 0);
    cz_corridor_free(corridor);
}

static volatile sig_atomic_t stop;

static void stop_at_third(int n_done, int n_all, void *data) {
    (void)n_all;
    (void)data;
    stop = n_done >= 3;
}

static void an_interrupted_search_keeps_the_widths_it_reached(void **state) {
    (void)state;
    CzCorridorOptions options = of_part("zone", 2);
    options.stop = &stop;
    options.progress = stop_at_third;
    stop = 0;
    CzCorridor *corridor = find(level, "", options);
    assert_true(corridor->is_interrupted && corridor->exists);
    assert_true(corridor->edge[0].width > 0 && corridor->edge[0].width < 0.15);
    cz_corridor_free(corridor);
    stop = 1; /* before the first run */
    options.progress = NULL;
    corridor = find(level, "", options);
    assert_true(corridor->is_interrupted && !corridor->exists);
    assert_int_equal(corridor->n_curve, 0);
    assert_null(cz_corridor_failure(corridor));
    cz_corridor_free(corridor);
}

/* An end must unload at least as stiffly as it loads: 1 MN over 50 mm against 25 MN/m. */
static void a_curve_that_no_problem_may_have_fails(void **state) {
    (void)state;
    static const char end[] =
        TWO_MASSES("stages: [{stroke_mm: 560, force_kN: 1000}]",
                   USED ", stages: [{stroke_mm: 50, force_kN: 1000}, {stroke_mm: 550, "
                        "force_kN: 1001}], unloading_stiffness_MN_m: 25");
    CzCorridor *corridor = find(end, "", of_part("trains.A.vehicles.A1.front", 2));
    assert_edge(corridor, 1, 0.25 + 1e-9);
    const CzTriedCurve *curve = &corridor->curve[corridor->edge[1].failing];
    assert_int_equal(curve->state, CZ_SAMPLE_INVALID);
    assert_non_null(strstr(curve->message, "the unloading of an end must be at least as stiff"));
    assert_true(corridor->n_refused > 0);
    cz_corridor_free(corridor);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_edges_are_those_of_the_closed_form),
        cmocka_unit_test(every_tried_curve_within_passes_and_one_beyond_each_edge_fails),
        cmocka_unit_test(a_peak_has_an_edge_of_its_own),
        cmocka_unit_test(a_device_in_pieces_has_the_same_results),
        cmocka_unit_test(a_path_names_a_device_too),
        cmocka_unit_test(the_device_must_be_found),
        cmocka_unit_test(vehicles_with_other_values_are_not_taken_along),
        cmocka_unit_test(the_edges_hold_in_every_sample),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(a_failing_nominal_design_has_no_corridor),
        cmocka_unit_test(an_interrupted_search_keeps_the_widths_it_reached),
        cmocka_unit_test(a_curve_that_no_problem_may_have_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
