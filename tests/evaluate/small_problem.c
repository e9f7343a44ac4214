/* A small problem for evaluator and optimiser. */
#include "evaluate/small_problem.h"
#include "support/check.h"

static const char base[] =
    "schema: 1\n"
    "title: two rigid cars\n"
    "parts:\n"
    "  tube: {stages: [{stroke_mm: 250, force_kN: 800}]}\n"
    "  shear-off: {force_kN: 1300, retraction_space_mm: 1500}\n"
    "  anti-climber: {count: 2, gap_mm: 400, stages: [{stroke_mm: 400, force_kN: 300}]}\n"
    "  head:\n"
    "    face_gap_mm: 900\n"
    "    unloading_stiffness_MN_m: 600\n"
    "    stages: [{stroke_mm: 5, force_MN: 3, zone: survival}]\n"
    "    proof_strength_kN: 1650\n"
    "    available_length_m: 2.5\n"
    "    coupler:\n"
    "      buffer: {stages: [{stroke_mm: 50, force_kN: 400}]}\n"
    "      tube: {use: tube}\n"
    "      shear_off: {use: shear-off}\n"
    "    anti_climber: {use: anti-climber}\n"
    "trains:\n"
    "  - name: A\n"
    "    vehicles: [{name: A1, model: rigid, mass_t: 40, front: {use: head}}]\n"
    "  - name: B\n"
    "    vehicles: [{name: B1, model: rigid, mass_t: 40, rear: {use: head}}]\n"
    "scenarios:\n"
    "  - {name: crash, speed_km_h: 25}\n"
    "  - {name: between, speed_km_h: 20}\n"
    "  - {name: service, speed_km_h: 15}\n"
    "  - {name: buffing, speed_km_h: 8}\n"
    "  - {name: overload, speed_km_h: 27.5, mass_factor: 1.1}\n";

static CzStatus read_text(const char *problem_text, const char *more, int n_set,
                          const char *const *set, CzProblem **problem, CzError *error) {
    char text[8192];
    const int n = snprintf(text, sizeof text, "%s%s", problem_text, more);
    assert_true(n > 0 && (size_t)n < sizeof text);
    CzProblemOptions options = cz_problem_options_default();
    options.n_set = n_set;
    options.set = set;
    return cz_problem_read_text(text, (size_t)n, "small.yaml", ".", &options, problem, error);
}

CzStatus small_problem_read(const char *more, int n_set, const char *const *set,
                            CzProblem **problem, CzError *error) {
    return read_text(base, more, n_set, set, problem, error);
}

CzProblem *problem_of_text(const char *text, const char *more) {
    CzProblem *problem = NULL;
    CzError error = {0};
    const CzStatus status = read_text(text, more, 0, NULL, &problem, &error);
    for (int i = 0; i < cz_problem_n_mistake(problem); i++) {
        const CzError *mistake = cz_problem_mistake(problem, i);
        print_error("%s:%d:%d: %s\n", mistake->file, mistake->line, mistake->column,
                    mistake->message);
    }
    assert_int_equal(status, CZ_OK);
    return problem;
}

CzProblem *small_problem(const char *more) {
    return problem_of_text(base, more);
}
