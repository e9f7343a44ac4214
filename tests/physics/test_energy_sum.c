/* What the elements of a collision dissipate adds up to what the absorbers do: nobody counts twice,
 * and nothing is missing. */
#include "support/check.h"

#include "crushzone/crushzone.h"

static double sum_of_elements(const CzRunSummary *summary) {
    double sum = 0.0;
    for (int i = 0; i < summary->n_interface; i++) {
        double of_interface = 0.0;
        for (int element = 0; element < summary->interface[i].n_element; element++)
            of_interface += summary->interface[i].element[element].energy;
        assert_near(of_interface, summary->interface[i].energy, 1e-9, 1e-6);
        sum += of_interface;
    }
    return sum;
}

static CzProblem *problem_of(CzStatus status, CzProblem *problem, const CzError *error) {
    if (status != CZ_OK)
        fail_msg("%s:%d: %s", error->file, error->line, error->message);
    return problem;
}

static CzProblem *shipped(const char *file) {
    char path[512];
    snprintf(path, sizeof path, "%s/problems/%s", CZ_SOURCE_FOLDER, file);
    const CzProblemOptions options = cz_problem_options_default();
    CzProblem *problem = NULL;
    CzError error = {0};
    const CzStatus status = cz_problem_read(path, &options, &problem, &error);
    return problem_of(status, problem, &error);
}

/* Cars of one mass each: buffers, tubes, shear-off, anti-climbers and ends are all that dissipates.
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

/* `rest` is the share of the initial energy that may belong to no element of an interface: with
 * full cars what hinges, folding ends and their guidance take; with rigid cars nothing. Elements
 * take the mean force of a step times the way in it, the books the mean power: the same up to the
 * square of the step, a millionth at the default one. */
static void check_sum(CzProblem *problem, double rest) {
    CzError error = {0};
    for (int scenario = 0; scenario < cz_problem_n_scenario(problem); scenario++) {
        CzModel *model = NULL;
        CzRun *run = NULL;
        if (cz_model_build(problem, scenario, &model, &error) != CZ_OK ||
            cz_simulate(model, NULL, &run, &error) != CZ_OK)
            fail_msg("%s", error.message);
        const CzRunSummary *summary = cz_run_summary(run);
        assert_string_equal(summary->failure, "");
        const double left = summary->energy.absorbers - sum_of_elements(summary);
        const double initial = summary->energy.initial;
        assert_near(left, 0.5 * rest * initial, 0, (0.5 * rest + 1e-6) * initial);
        cz_run_free(run);
        cz_model_free(model);
    }
    cz_problem_free(problem);
}

static void elements_of_rigid_cars_are_all_that_absorbs(void **state) {
    (void)state;
    check_sum(rigid(), 0.0);
}

static void elements_absorb_all_but_little_where_full_cars_meet(void **state) {
    (void)state;
    check_sum(shipped("two-cars-25kmh.yaml"), 0.02);
}

static void elements_absorb_all_but_little_in_two_trains(void **state) {
    (void)state;
    check_sum(shipped("first-collision.yaml"), 0.02);
}

static void elements_absorb_all_but_little_against_a_wall(void **state) {
    (void)state;
    check_sum(shipped("wall.yaml"), 0.02);
}

static void elements_absorb_all_but_little_with_side_buffers(void **state) {
    (void)state;
    check_sum(shipped("wagon.yaml"), 0.02);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elements_of_rigid_cars_are_all_that_absorbs),
        cmocka_unit_test(elements_absorb_all_but_little_where_full_cars_meet),
        cmocka_unit_test(elements_absorb_all_but_little_in_two_trains),
        cmocka_unit_test(elements_absorb_all_but_little_against_a_wall),
        cmocka_unit_test(elements_absorb_all_but_little_with_side_buffers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
