/* Loopholes that need cars with running gear or an unlucky time step, tried on the simulator
 * itself. Every number of the problems is chosen so that the loophole pays: the optimum without the
 * rule violates it, and is better than the optimum with the rule.
 */
#include "optimise/loopholes.h"

/* Two trains of two full cars of the generic catalogue. Runs have a duration: the time after the
 * crash is of no interest here. */
#define TWO_AND_TWO(scenario, parts)                                                               \
    "schema: 1\n"                                                                                  \
    "title: two cars onto two\n"                                                                   \
    "catalogue: [problems/catalogue/generic.yaml]\n"                                               \
    "simulation: {track: rigid, adhesion: {friction: 0.3}}\n"                                      \
    "trains:\n"                                                                                    \
    "  - name: A\n"                                                                                \
    "    brake: {ratio: 0, axle_share: 0}\n"                                                       \
    "    vehicles: [{name: A1, use: middle-car}, {name: A2, use: driving-car}]\n"                  \
    "  - {name: B, copy: A, reversed: true, brake: {ratio: 0.1, axle_share: 1}}\n"                 \
    "scenarios: [{name: crash, " scenario "}]\n"                                                   \
    "parts:\n"                                                                                     \
    "  front-end:\n"                                                                               \
    "    face_gap_mm: 1000\n"                                                                      \
    "    available_length_mm: 1800\n" parts

/* Weak tubes between the cars unload the anti-climbers, and close the gangways beyond their
 * clearance.
 */
static void optimiser_cannot_win_by_closing_inner_gaps_beyond_the_gangway(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .problem = TWO_AND_TWO("speed_km_h: 25, duration_ms: 600",
                               "  inner-end: {gangway_block_mm: 220}\n"
                               "  inner-coupler: {tube: {stages: [{stroke_mm: 450, force_kN: "
                               "700}]}}\n"),
        .limits = "{name: visible, metric: interfaces.inner.gap_used, max: 1e9}",
        .minimise = "elements.anti-climber *.stroke_used",
        .variables = "{path: \"parts.inner-coupler.tube.stages[0].force_kN\", min: 410, max: 900}",
        .check = "closure of inner gaps",
        .scenario = "crash"});
}

/* A strong front tube folds the couplers upwards; the faces pass each other, and anti-climbers
 * without overlap carry no force. */
static void optimiser_cannot_win_by_climbing(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .problem = TWO_AND_TWO("speed_km_h: 22, duration_ms: 600, height_offset_mm: 160",
                               "  anti-climber: {rib_strength_kN: 0, friction: 0,\n"
                               "    stages: [{stroke_mm: 600, force_kN: 900}]}\n"),
        .limits = "{name: visible, metric: override, max: 1e9}",
        .minimise = "elements.anti-climber *.peak_force_kN",
        .variables = "{path: \"parts.front-coupler.tube.stages[0].force_kN\", min: 690, "
                     "max: 850, start: 700}",
        .check = "override",
        .scenario = "crash"});
}

/* Faces that overlap by less than a rib carry less force. */
static void optimiser_cannot_win_by_losing_the_overlap_of_the_anti_climbers(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .problem = TWO_AND_TWO("speed_km_h: 25, duration_ms: 600, height_offset_mm: 140",
                               "  anti-climber: {stages: [{stroke_mm: 600, force_kN: 500}]}\n"),
        .limits = "{name: visible, metric: interfaces.overlap_ribs, min: -1e9}",
        .minimise = "interfaces.colliding.peak_force_kN",
        .variables = "{path: \"parts.front-coupler.tube.stages[0].force_kN\", min: 450, max: 850}",
        .check = "overlap of the anti-climbers",
        .scenario = "crash"});
}

/* A strong coupler unloads the anti-climbers, until they slip under its moment. */
static void optimiser_cannot_win_with_anti_climbers_that_slip(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .problem = TWO_AND_TWO("speed_km_h: 25, duration_ms: 600, height_offset_mm: 60",
                               "  anti-climber: {rib_strength_kN: 8, friction: 0.05,\n"
                               "    stages: [{stroke_mm: 600, force_kN: 500}]}\n"),
        .limits = "{name: visible, metric: interfaces.vertical_margin_kN, min: -1e9}",
        .minimise = "elements.anti-climber *.energy_kJ",
        .variables = "{path: \"parts.front-coupler.tube.stages[0].force_kN\", min: 450, max: 850}",
        .check = "vertical capacity of the anti-climbers",
        .scenario = "crash"});
}

/* With a late anti-climber heavy bogies oscillate at their links, which then absorb its share. */
static void optimiser_cannot_win_by_absorbing_energy_in_the_running_gear(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .problem = TWO_AND_TWO("speed_km_h: 18, duration_ms: 600",
                               "  middle-car: {mass_t: 42}\n"
                               "  bogie: {mass_kg: 6000}\n"
                               "  anti-climber: {stages: [{stroke_mm: 600, force_kN: 500}]}\n"),
        .limits = "{name: visible, metric: energy.running_gear_share, max: 1e9}",
        .minimise = "elements.anti-climber *.energy_kJ",
        .variables = "{path: parts.anti-climber.gap_mm, min: 320, max: 700}",
        .check = "share of energy in the running gear",
        .scenario = "crash"});
}

/* With a short anti-climber the end absorbs the remaining energy, first its crush zone and then the
 * cab. */
static void optimiser_cannot_win_by_crushing_the_survival_space(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .problem = TWO_AND_TWO("speed_km_h: 28, duration_ms: 600",
                               "    stages:\n" /* of the front end */
                               "      - {stroke_mm: 20, force_MN: 1.2}\n"
                               "      - {stroke_mm: 100, force_MN: 1.5}\n"
                               "      - {stroke_mm: 400, force_MN: 2.5, zone: survival}\n"),
        .limits = "{name: visible, metric: energy.survival_kJ, max: 1e9}",
        .minimise = "design.installed_length_mm",
        .variables =
            "{path: \"parts.anti-climber.stages[0].stroke_mm\", min: 10, max: 600, start: 500}",
        .check = "energy in survival space",
        .scenario = "crash"});
}

/* ---- the mean deceleration ------------------------------------------------------------------- */

/* A soft coupler in front of a stiff anti-climber makes the contact long and its mean deceleration
 * small. */
static Case run_diluted(const char *subject) {
    char more[1024];
    snprintf(more, sizeof more,
             "checks:\n"
             "  design_rules: false\n"
             "  limits:\n"
             "    - {name: worse, metric: vehicles.mean_deceleration_g, max: 1.6}\n"
             "    - {name: diluted, metric: vehicles.mean_deceleration_contact_g, max: 1.6}\n"
             "optimise:\n"
             "  minimise: interfaces.colliding.shortening_mm\n"
             "  subject_to: [%s]\n"
             "  evaluations: 60\n"
             "  variables: [{path: parts.anti-climber.gap_mm, min: 320, max: 600}]\n",
             subject);
    Case made =
        begin_with(problem_of_text(
                       TWO_AND_TWO("speed_km_h: 25, duration_ms: 600",
                                   "  anti-climber: {stages: [{stroke_mm: 600, force_kN: 500}]}\n"),
                       more),
                   2);
    optimise(&made, NULL);
    return made;
}

static void optimiser_cannot_dilute_the_mean_deceleration(void **state) {
    (void)state;
    Case exploited = run_diluted("diluted"), honest = run_diluted("worse");
    assert_int_equal(exploited.outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_int_equal(honest.outcome->status, CZ_OUTCOME_FEASIBLE);
    assert_true(value_of(&exploited, "diluted", "crash") <= 1.6);
    assert_true(value_of(&exploited, "worse", "crash") > 1.6);
    assert_true(value_of(&honest, "worse", "crash") <= 1.6);
    assert_true(honest.outcome->best_evaluation.objective >
                exploited.outcome->best_evaluation.objective);
    end(&exploited);
    end(&honest);
}

/* ---- runs without a result ---------------------------------------------------------------- */

#define TWO_RIGID(simulation)                                                                      \
    "schema: 1\n"                                                                                  \
    "title: two rigid cars\n"                                                                      \
    "simulation: {" simulation "}\n"                                                               \
    "parts:\n"                                                                                     \
    "  tube: {stages: [{stroke_mm: 250, force_kN: 800}]}\n"                                        \
    "  head:\n"                                                                                    \
    "    face_gap_mm: 900\n"                                                                       \
    "    unloading_stiffness_MN_m: 600\n"                                                          \
    "    coupler:\n"                                                                               \
    "      length_m: 1.4\n"                                                                        \
    "      buffer: {stages: [{stroke_mm: 50, force_kN: 400}]}\n"                                   \
    "      tube: {use: tube}\n"                                                                    \
    "    anti_climber: {count: 2, gap_mm: 400, stages: [{stroke_mm: 400, force_kN: 300}]}\n"       \
    "trains:\n"                                                                                    \
    "  - {name: A, vehicles: [{name: A1, model: rigid, mass_t: 40, front: {use: head}}]}\n"        \
    "  - {name: B, vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {use: head}}]}\n"

#define AT(scenario) "scenarios: [{name: crash, " scenario "}]\n"

static void optimiser_cannot_win_with_a_tube_longer_than_its_coupler(void **state) {
    (void)state;
    check_loophole(
        &(Loophole){.problem = TWO_RIGID("") AT("speed_km_h: 15"),
                    .limits = "{name: visible, metric: ends.coupler_length_used, max: 1e9}",
                    .minimise = "elements.coupler *.stroke_used",
                    .variables = "{path: \"parts.tube.stages[0].stroke_mm\", min: 100, max: 3000}",
                    .check = "buffer and tubes / coupler length",
                    .scenario = "design"});
}

/* A soft tube unloads the other devices, and collapses at every coupling. */
static void optimiser_cannot_win_with_a_tube_that_collapses_in_service(void **state) {
    (void)state;
    check_loophole(&(Loophole){
        .problem = TWO_RIGID("") AT("speed_km_h: 6"),
        .limits = "{name: visible, metric: elements.coupler *.tube_energy_kJ, max: 1e9}",
        .minimise = "interfaces.peak_force_kN",
        .variables = "{path: \"parts.tube.stages[0].force_kN\", min: 410, max: 1500}",
        .check = "collapse tubes inactive at 8 km/h (buffing)",
        .scenario = "crash"});
}

/* A tube that is almost strong enough reaches the end of its stroke after the end of the run. */
static void optimiser_cannot_win_by_letting_the_collision_outlast_the_run(void **state) {
    (void)state;
    check_loophole(
        &(Loophole){.problem = TWO_RIGID("") AT("speed_km_h: 25, duration_ms: 130"),
                    .limits = "{name: visible, metric: closing_speed_m_s, max: 1e9}",
                    .minimise = "interfaces.peak_force_kN",
                    .variables = "{path: \"parts.tube.stages[0].force_kN\", min: 410, max: 800}",
                    .check = "residual closing speed",
                    .scenario = "crash"});
}

/* A short tube makes a short coupler and is compressed beyond its stroke. */
static void optimiser_cannot_win_by_bottoming_out(void **state) {
    (void)state;
    check_loophole(
        &(Loophole){.problem = TWO_RIGID("") AT("speed_km_h: 15"),
                    .limits = "{name: visible, metric: elements.bottomed_out, max: 1e9}",
                    .minimise = "ends.coupler_length_used",
                    .variables = "{path: \"parts.tube.stages[0].stroke_mm\", min: 5, max: 400}",
                    .check = "bottoming out",
                    .scenario = "crash"});
}

/* Searches, and returns the evaluation of the value that would be best if its run counted. */
static Case run_failing(const char *problem, const char *minimise, const char *variable,
                        double winner, CzStatus *status) {
    char more[1024];
    snprintf(more, sizeof more,
             "checks: {design_rules: false}\n"
             "optimise: {minimise: %s, evaluations: 60, variables: [%s]}\n",
             minimise, variable);
    Case made = begin_with(problem_of_text(problem, more), 2);
    optimise(&made, NULL);
    CzEvaluation evaluation;
    CzError error = {0};
    assert_int_equal(cz_evaluate(made.evaluator, 1, &winner, false, &evaluation, &error), CZ_OK);
    *status = evaluation.status;
    assert_true(isnan(evaluation.objective));
    cz_evaluation_free(&evaluation);
    return made;
}

/* The step of 10 ms is just stable for the buffer of the file; a shorter buffer is stiffer, and its
 * run violates the energy balance. */
static void optimiser_cannot_win_where_the_run_fails(void **state) {
    (void)state;
    CzStatus status = CZ_OK;
    Case made = run_failing(TWO_RIGID("time_step_ms: 10, output_step_ms: 10") AT("speed_km_h: 25"),
                            "ends.coupler_length_used",
                            "{path: \"parts.head.coupler.buffer.stages[0].stroke_mm\", min: 10, "
                            "max: 60}",
                            10, &status);
    assert_int_equal(status, CZ_STATUS_RUN_FAILED);
    assert_true(made.outcome->best[0] > 10);
    assert_int_equal(made.outcome->best_evaluation.status, CZ_OK);
    end(&made);
}

/* The strongest tube has the lowest peak behind it, and its run does not end within the longest
 * time. */
static void optimiser_cannot_win_with_a_run_that_does_not_end(void **state) {
    (void)state;
    CzStatus status = CZ_OK;
    Case made =
        run_failing(TWO_RIGID("longest_s: 0.23") AT("speed_km_h: 25"), "interfaces.peak_force_kN",
                    "{path: \"parts.tube.stages[0].force_kN\", min: 450, max: 800, "
                    "start: 500}",
                    800, &status);
    assert_int_equal(status, CZ_STATUS_RUN_FAILED);
    assert_true(made.outcome->best[0] < 800);
    assert_true(made.outcome->best[0] > 500);
    assert_int_equal(made.outcome->best_evaluation.status, CZ_OK);
    end(&made);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(optimiser_cannot_win_by_closing_inner_gaps_beyond_the_gangway),
        cmocka_unit_test(optimiser_cannot_win_by_climbing),
        cmocka_unit_test(optimiser_cannot_win_by_losing_the_overlap_of_the_anti_climbers),
        cmocka_unit_test(optimiser_cannot_win_with_anti_climbers_that_slip),
        cmocka_unit_test(optimiser_cannot_win_by_absorbing_energy_in_the_running_gear),
        cmocka_unit_test(optimiser_cannot_win_by_crushing_the_survival_space),
        cmocka_unit_test(optimiser_cannot_dilute_the_mean_deceleration),
        cmocka_unit_test(optimiser_cannot_win_with_a_tube_longer_than_its_coupler),
        cmocka_unit_test(optimiser_cannot_win_with_a_tube_that_collapses_in_service),
        cmocka_unit_test(optimiser_cannot_win_by_letting_the_collision_outlast_the_run),
        cmocka_unit_test(optimiser_cannot_win_by_bottoming_out),
        cmocka_unit_test(optimiser_cannot_win_where_the_run_fails),
        cmocka_unit_test(optimiser_cannot_win_with_a_run_that_does_not_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
