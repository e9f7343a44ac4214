/* The energies of the elements of a collision add up to that of the absorbers: none is counted
 * twice, and none is missing. */
#include "support/check.h"

#include <math.h>

#include "crushzone/crushzone.h"

static double sum_of_elements(const CzRunSummary *summary) {
    double sum = 0.0;
    for (int i = 0; i < summary->n_interface; i++) {
        double of_interface = 0.0;
        for (int element = 0; element < summary->interface[i].n_element; element++)
            of_interface += summary->interface[i].element[element].energy;
        assert_near(of_interface, summary->interface[i].energy, ROUNDING_OF_A_SUM,
                    ROUNDING_OF_A_SUM);
        sum += of_interface;
    }
    for (int i = 0; i < summary->n_outer_end; i++)
        sum += summary->outer_end[i].energy;
    return sum;
}

static CzProblem *problem_of(CzStatus status, CzProblem *problem, const CzError *error) {
    if (status != CZ_OK)
        fail_msg("%s:%d: %s", error->file, error->line, error->message);
    return problem;
}

static CzProblem *shipped_with(const char *file, const char *const *set, int n_set) {
    char path[512];
    snprintf(path, sizeof path, "%s/problems/%s", CZ_SOURCE_FOLDER, file);
    CzProblemOptions options = cz_problem_options_default();
    options.set = set;
    options.n_set = n_set;
    CzProblem *problem = NULL;
    CzError error = {0};
    const CzStatus status = cz_problem_read(path, &options, &problem, &error);
    return problem_of(status, problem, &error);
}

static CzProblem *shipped(const char *file) {
    return shipped_with(file, NULL, 0);
}

/* Cars of one mass each: only buffers, tubes, shear-off, anti-climbers and ends dissipate.
 */
static CzProblem *rigid(void) {
    static const char text[] =
        "schema: 1\n"
        "title: rigid cars\n"
        "parts:\n"
        "  draft-gear: {stages: [{stroke_mm: 50, force_kN: 400}]}\n"
        "  cab-end:\n"
        "    face_gap_mm: 900\n"
        "    stages: [{stroke_mm: 20, force_kN: 1500}, {stroke_mm: 300, force_kN: 2500}]\n"
        "    unloading_stiffness_MN_m: 100\n"
        "    coupler:\n"
        "      buffer: {use: draft-gear}\n"
        "      tube: {stages: [{stroke_mm: 250, force_kN: 700}]}\n"
        "      shear_off: {force_kN: 1000, retraction_space_mm: 1500}\n"
        "    anti_climber: {count: 2, gap_mm: 320, stages: [{stroke_mm: 500, force_kN: 500}]}\n"
        "  inner-end:\n"
        "    face_gap_mm: 350\n"
        "    stages: [{stroke_mm: 20, force_kN: 1500}, {stroke_mm: 100, force_kN: 2500}]\n"
        "    unloading_stiffness_MN_m: 100\n"
        "    coupler:\n"
        "      buffer: {use: draft-gear}\n"
        "      tube: {stages: [{stroke_mm: 200, force_kN: 700}]}\n"
        "  middle-car:\n"
        "    {model: rigid, mass_t: 38, front: {use: inner-end}, rear: {use: inner-end}}\n"
        "  driving-car: {use: middle-car, mass_t: 40, front: {use: cab-end}}\n"
        "trains:\n"
        "  - name: A\n"
        "    speed_km_h: 25\n"
        "    vehicles:\n"
        "      - {use: driving-car, reversed: true}\n"
        "      - {use: middle-car, repeat: 2}\n"
        "      - {use: driving-car}\n"
        "  - {name: B, copy: A, speed_km_h: 0}\n";
    const CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzError error = {0};
    const CzStatus status =
        cz_problem_read_text(text, sizeof text - 1, "rigid", ".", &options, &problem, &error);
    return problem_of(status, problem, &error);
}

/* Only elements absorb: sums in two orders differ by rounding.
 */
static void check_sum(CzProblem *problem) {
    CzError error = {0};
    for (int scenario = 0; scenario < cz_problem_n_scenario(problem); scenario++) {
        CzModel *model = NULL;
        CzRun *run = NULL;
        if (cz_model_build(problem, scenario, &model, &error) != CZ_OK ||
            cz_simulate(model, NULL, &run, &error) != CZ_OK)
            fail_msg("%s", error.message);
        const CzRunSummary *summary = cz_run_summary(run);
        assert_string_equal(summary->failure, "");
        assert_near(sum_of_elements(summary), summary->energy.absorbers, 0.0,
                    1e-9 * summary->energy.initial);
        assert_true(summary->energy.balance_error < 1e-4);
        cz_run_free(run);
        cz_model_free(model);
    }
    cz_problem_free(problem);
}

static void only_elements_absorb_between_rigid_cars(void **state) {
    (void)state;
    check_sum(rigid());
}

static void only_elements_absorb_between_full_cars(void **state) {
    (void)state;
    check_sum(shipped("two-cars-25kmh.yaml"));
}

static void only_elements_absorb_in_two_trains(void **state) {
    (void)state;
    check_sum(shipped("first-collision.yaml"));
}

static void only_elements_absorb_against_a_wall(void **state) {
    (void)state;
    check_sum(shipped("wall.yaml"));
}

static void only_elements_absorb_with_side_buffers(void **state) {
    (void)state;
    check_sum(shipped("wagon.yaml"));
}

static const char *const damped[] = {"parts.front-end.damping_kN_s_m=200",
                                     "parts.front-end.anti_climber.damping_kN_s_m=30",
                                     "parts.front-end.anti_climber.speed_factor=0.2",
                                     "parts.front-end.coupler.tube.rate_factor_s_m=0.02"};

static void damping_and_rates_of_an_end_belong_to_it(void **state) {
    (void)state;
    check_sum(shipped_with("two-cars-25kmh.yaml", damped, 4));
    check_sum(shipped_with("paper-25kmh.yaml", NULL, 0));
}

/* Both ends of a car are damped, and only one of them has a partner. */
static void a_damped_end_without_a_partner_dissipates_nothing(void **state) {
    (void)state;
    CzProblem *problem = shipped_with("two-cars-25kmh.yaml", damped, 4);
    CzModel *model = NULL;
    CzRun *run = NULL;
    CzError error = {0};
    if (cz_model_build(problem, 0, &model, &error) != CZ_OK ||
        cz_simulate(model, NULL, &run, &error) != CZ_OK)
        fail_msg("%s", error.message);
    const CzRunSummary *summary = cz_run_summary(run);
    const CzInterfaceResult *met = &summary->interface[0];
    double of_ends = 0.0, of_masses = 0.0;
    for (int k = 0; k < met->n_element; k++)
        if (met->element[k].kind == CZ_ELEMENT_END)
            of_ends += met->element[k].energy - met->element[k].tube_energy;
    for (int k = 0; k < summary->n_outer_end; k++)
        of_masses += fabs(summary->outer_end[k].energy);
    assert_true(of_ends > 1e4);
    assert_true(of_masses < 0.02 * of_ends);
    cz_run_free(run);
    cz_model_free(model);
    cz_problem_free(problem);
}

/* Pressed at its plateau P against a wall, an anti-climber of stiffness k stores P^2 / 2 k. The
 * smallest resistance of the crush adds some ten newtons to P. */
static void an_anti_climber_against_a_wall_stores_f_squared_over_2k(void **state) {
    (void)state;
    static const char text[] =
        "schema: 1\n"
        "title: anti-climber against a wall\n"
        "simulation: {duration_ms: 30, track: rigid}\n"
        "trains:\n"
        "  - name: A\n"
        "    speed_m_s: 3\n"
        "    vehicles:\n"
        "      - {model: rigid, mass_t: 40, front: {face_gap_m: 1, unloading_stiffness_MN_m: 1e5,\n"
        "         anti_climber: {gap_m: 0, stiffness_MN_m: 80,\n"
        "                        stages: [{stroke_mm: 600, force_kN: 1000}]}}}\n"
        "  - name: W\n"
        "    vehicles: [{model: fixed, rear: {face_gap_m: 0, unloading_stiffness_MN_m: 1e5}}]\n";
    const CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzModel *model = NULL;
    CzRun *run = NULL;
    CzError error = {0};
    if (cz_problem_read_text(text, sizeof text - 1, "wall", ".", &options, &problem, &error) !=
            CZ_OK ||
        cz_model_build(problem, 0, &model, &error) != CZ_OK ||
        cz_simulate(model, NULL, &run, &error) != CZ_OK)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    const CzInterfaceResult *wall = &cz_run_summary(run)->interface[0];
    int n = 0;
    for (int k = 0; k < wall->n_element; k++)
        if (wall->element[k].kind == CZ_ELEMENT_ANTI_CLIMBER) {
            assert_near(wall->element[k].stored, 1e12 / (2.0 * 80e6), 1e-3, 0.0);
            n++;
        }
    assert_int_equal(n, 1);
    cz_run_free(run);
    cz_model_free(model);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damping_and_rates_of_an_end_belong_to_it),
        cmocka_unit_test(a_damped_end_without_a_partner_dissipates_nothing),
        cmocka_unit_test(an_anti_climber_against_a_wall_stores_f_squared_over_2k),
        cmocka_unit_test(only_elements_absorb_between_rigid_cars),
        cmocka_unit_test(only_elements_absorb_between_full_cars),
        cmocka_unit_test(only_elements_absorb_in_two_trains),
        cmocka_unit_test(only_elements_absorb_against_a_wall),
        cmocka_unit_test(only_elements_absorb_with_side_buffers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
