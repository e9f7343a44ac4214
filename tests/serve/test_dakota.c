/* Evaluations for Dakota: its files, the meaning of descriptors, values, gradients and failures. */
#include "support/work_folder.h"

#include "base/number.h"
#include "crushzone/dakota.h"
#include "crushzone/evaluate.h"

#define FORCE "parts.end.coupler.tube.stages[0].force_kN"
#define STROKE "parts.end.coupler.tube.stages[0].stroke_mm"

static CzProblem *problem;

static int read_problem(void **state) {
    CzError error = {0};
    (void)state;
    if (enter_work_folder() != 0)
        return -1;
    if (cz_problem_read(CZ_SOURCE_FOLDER "/problems/length-or-force.yaml", NULL, &problem,
                        &error) != CZ_OK)
        fail_msg("%s", error.message);
    return 0;
}

static int end(void **state) {
    (void)state;
    cz_problem_free(problem);
    return leave_work_folder();
}

/* Evaluates the text of a parameters file, and returns the text of the results file. */
static CzStatus evaluate(const char *parameters, char results[2000], CzError *error) {
    FILE *file = fopen("params.in", "w");
    CzDakota *dakota = NULL;
    assert_non_null(file);
    fputs(parameters, file);
    assert_int_equal(fclose(file), 0);
    *error = (CzError){0};
    results[0] = '\0';
    const CzStatus status = cz_dakota_evaluate(problem, "params.in", NULL, &dakota, error);
    if (status != CZ_OK)
        return status;
    file = fopen("results.out", "w+");
    assert_non_null(file);
    cz_dakota_write(dakota, file);
    rewind(file);
    results[fread(results, 1, 1999, file)] = '\0';
    assert_int_equal(fclose(file), 0);
    cz_dakota_free(dakota);
    return CZ_OK;
}

/* The number of a line, counted from 0; without its label. */
static double number_in(const char *results, int line) {
    char text[64] = "";
    double value = NAN;
    for (; line > 0; line--)
        results = strchr(results, '\n') + 1;
    sscanf(results, "%63s", text);
    assert_true(cz_number_scan(text, &value));
    return value;
}

/* The peak force of a design, as an evaluator of the library computes it. */
static double peak_of(double force, double stroke) {
    static const char *const metric[] = {"interfaces.peak_force_kN"};
    const double x[] = {force, stroke};
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation;
    CzError error = {0};
    assert_int_equal(cz_evaluator_build(problem, NULL, &evaluator, &error), CZ_OK);
    assert_int_equal(cz_evaluator_set_values(evaluator, 1, metric, &error), CZ_OK);
    assert_int_equal(cz_evaluate(evaluator, 1, x, false, &evaluation, &error), CZ_OK);
    const double peak = evaluation.value[0].value;
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    return peak;
}

static void both_formats_give_the_values_of_the_evaluator(void **state) {
    static const char *const files[] = {
        "                                          2 variables\n"
        "                      8.000000000000000e+02 " FORCE "\n"
        "                      3.500000000000000e+02 " STROKE "\n"
        "                                          2 functions\n"
        "                                          1 ASV_1:interfaces.peak_force_kN\n"
        "                                          0 ASV_2:objective\n"
        "                                          2 derivative_variables\n"
        "                                          1 DVV_1:" FORCE "\n"
        "                                          2 DVV_2:" STROKE "\n"
        "                                          0 analysis_components\n"
        "                                          1 eval_id\n",
        "                    { DAKOTA_VARS     =                      2 }\n"
        "                    { s               =  3.500000000000000e+02 }\n"
        "                    { f               =  8.000000000000000e+02 }\n"
        "                    { DAKOTA_FNS      =                      1 }\n"
        "                    { ASV_1:peak      =                      1 }\n"
        "                    { DAKOTA_DER_VARS =                      0 }\n"
        "                    { DAKOTA_AN_COMPS =                      3 }\n"
        "                    { AC_1:a driver   =      \"f=" FORCE "\" }\n"
        "                    { AC_2:a driver   =      \"s=" STROKE "\" }\n"
        "                    { AC_3:a driver   = \"peak=interfaces.peak_force_kN\" }\n"
        "                    { DAKOTA_EVAL_ID  =                  4:9:2 }\n"
        "                    { DAKOTA_METADATA =                      0 }\n",
        "1 variables\n800 " FORCE "\n1 functions\n1 ASV_1:interfaces.peak_force_kN\n"
        "0 derivative_variables\n1 analysis_components\nfoo=bar AC_1:python driver\n1 eval_id\n"};
    const double peak = peak_of(800, 350);
    char results[2000];
    CzError error;
    (void)state;
    for (int i = 0; i < 2; i++) {
        if (evaluate(files[i], results, &error) != CZ_OK)
            fail_msg("file %d: line %d: %s", i, error.line, error.message);
        assert_non_null(strstr(results, i == 0 ? " interfaces.peak_force_kN\n" : " peak\n"));
        assert_null(strstr(results, "objective"));
        assert_true(number_in(results, 0) == peak);
    }
    assert_int_equal(evaluate(files[2], results, &error), CZ_STATUS_INPUT); /* foo is nothing */
    assert_int_equal(error.line, 7);
}

/* Values as `run --set` has them, for numbers that are no design variables. */
static void a_path_is_set_as_in_a_file(void **state) {
    const char *file = "1 variables\n17 trains.A.speed_km_h\n1 functions\n"
                       "1 ASV_1:interfaces.peak_force_kN\n0 derivative_variables\n"
                       "0 analysis_components\n1 eval_id\n0 metadata\n";
    static const char *const set[] = {"trains.A.speed_km_h=17"}, *const metric[] = {
                                                                     "interfaces.peak_force_kN"};
    CzProblemOptions options = cz_problem_options_default();
    CzProblem *slower = NULL;
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation;
    char results[2000];
    CzError error;
    (void)state;
    options.set = set;
    options.n_set = 1;
    assert_int_equal(evaluate(file, results, &error), CZ_OK);
    assert_int_equal(cz_problem_read(CZ_SOURCE_FOLDER "/problems/length-or-force.yaml", &options,
                                     &slower, &error),
                     CZ_OK);
    assert_int_equal(cz_evaluator_build(slower, NULL, &evaluator, &error), CZ_OK);
    assert_int_equal(cz_evaluator_set_values(evaluator, 1, metric, &error), CZ_OK);
    assert_int_equal(cz_evaluate(evaluator, 1, NULL, false, &evaluation, &error), CZ_OK);
    assert_true(number_in(results, 0) == evaluation.value[0].value);
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(slower);
}

/* The stroke of a plateau F follows from the energy E of a side: with the reserve s0 and the work
 * of the buffer the use is u = a / (F s), so that du/dF = -u / F and du/ds = -u / s to within the
 * buffer's part of the work, 3 %, and the margin is (0.9 - u) / 0.9. */
static void gradients_follow_the_energy_of_the_tube(void **state) {
    const char *file = "3 variables\n800 " FORCE "\n20 trains.A.speed_km_h\n350 " STROKE "\n"
                       "2 functions\n2 ASV_1:margin.reserve_of_stroke\n3 ASV_2:smallest_margin\n"
                       "3 derivative_variables\n1 DVV_1:" FORCE "\n3 DVV_2:" STROKE "\n"
                       "2 DVV_3:trains.A.speed_km_h\n0 analysis_components\n1 eval_id\n";
    char results[2000];
    double by_force, by_stroke, by_speed;
    CzError error;
    (void)state;
    if (evaluate(file, results, &error) != CZ_OK)
        fail_msg("line %d: %s", error.line, error.message);
    const double use = 0.9 * (1 - number_in(results, 0));
    const char *gradient = strchr(results, '[');
    assert_non_null(gradient);
    assert_int_equal(sscanf(gradient, "[ %lf %lf %lf ]", &by_force, &by_stroke, &by_speed), 3);
    const double buffers_part = 0.05; /* of the work, with the difference's error */
    assert_near(by_force, use / 800 / 0.9, buffers_part, 0);
    assert_near(by_stroke, use / 350 / 0.9, buffers_part, 0);
    assert_near(by_speed, -2 * use / 20 / 0.9, buffers_part, 0);
    const char *second = strchr(gradient + 1, '[');
    assert_non_null(second);
    assert_int_equal(strncmp(gradient, second, (size_t)(second - gradient) - 1), 0);
}

/* Rounds of `fail`: what Dakota asks for cannot be computed, or the design cannot be run. */
static void a_failed_evaluation_says_why(void **state) {
    static const struct {
        const char *file, *reason;
    } files[] = {{"1 variables\n800 " FORCE "\n2 functions\n1 ASV_1:objective\n7 ASV_2:violation\n"
                  "1 derivative_variables\n1 DVV_1:" FORCE "\n0 analysis_components\n1 eval_id\n",
                  "second derivatives are asked for"},
                 {"1 variables\n0 simulation.longest_s\n1 functions\n1 ASV_1:objective\n"
                  "0 derivative_variables\n0 analysis_components\n1 eval_id\n",
                  "longest_s"},
                 {"1 variables\n0.01 simulation.longest_s\n1 functions\n1 ASV_1:objective\n"
                  "0 derivative_variables\n0 analysis_components\n1 eval_id\n",
                  "objective has no value: collision:"},
                 {"1 variables\n800 " FORCE "\n1 functions\n1 ASV_1:vehicles.bogie_lift_mm\n"
                  "0 derivative_variables\n0 analysis_components\n1 eval_id\n",
                  "vehicles.bogie_lift_mm has no value: it is not known, does not apply"}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char results[2000];
        CzError error;
        if (evaluate(files[i].file, results, &error) != CZ_OK)
            fail_msg("file %zu: line %d: %s", i, error.line, error.message);
        if (strncmp(results, "fail\n", 5) != 0 || strstr(results, files[i].reason) == NULL)
            fail_msg("file %zu: %s", i, results);
    }
}

#define END "0 derivative_variables\n0 analysis_components\n1 eval_id\n"
#define ONE "1 functions\n1 ASV_1:objective\n"

static void a_mistake_is_reported_at_its_place(void **state) {
    static const struct {
        const char *file;
        int line, column;
        const char *sentence;
    } files[] = {
        {"\n", 2, 1, "the file ends before 'variables'"},
        {"0 variables\n" ONE, 4, 1, "the file ends before 'derivative_variables'"},
        {"2 variables\n800 " FORCE "\n" ONE END, 4, 3,
         "'functions' must be here, not 'ASV_1:objective'"},
        {"1 variable\n", 1, 3, "'variables' must be here, not 'variable'"},
        {"x variables\n", 1, 1, "'x' is not a whole number from 0 to"},
        {"-1 variables\n", 1, 1, "'-1' is not a whole number"},
        {"1e9 variables\n", 1, 1, "'1e9' is not a whole number"},
        {"variables\n", 1, 1, "this line is not a value and its label"},
        {"{ DAKOTA_VARS = 0\n", 1, 1, "this line is not '{ label = value }'"},
        {"{ DAKOTA_VARS = 0 }\n1 functions\n", 2, 1, "this line is not '{ label = value }'"},
        {"0 variables\n1 functions\n8 ASV_1:objective\n" END, 3, 1, "'8' is not a whole number"},
        {"0 variables\n1 functions\n1 ASV_2:objective\n" END, 3, 3,
         "'ASV_1' must be here, not 'ASV_2:objective'"},
        {"0 variables\n1 functions\n1 objective\n" END, 3, 3, "'ASV_1' must be here"},
        {"0 variables\n" ONE
         "1 derivative_variables\n1 DVV_1:x\n0 analysis_components\n1 eval_id\n",
         5, 1, "the file has no variable 1, but 0"},
        {"0 variables\n" ONE END "0 metadata\n0 variables\n", 8, 1,
         "the evaluation ends before this line"},
        {"0 variables\n" ONE END "1 metadata\nseconds MD_1\n", 8, 1,
         "metadata 'seconds' are not computed"},
        {"0 variables\n2 functions\n1 ASV_1:objective\n1 ASV_2:objective\n" END, 4, 1,
         "the descriptor 'objective' is also in line 3"},
        {"1 variables\n3 nothing_mm\n" ONE END, 2, 1,
         "'nothing_mm' is no design variable of the problem, nor a path"},
        {"1 variables\n3 trains.A.sped_km_h\n" ONE END, 2, 1, "unknown key 'sped_km_h'"},
        {"1 variables\n400 " FORCE "\n" ONE END, 2, 1, "400 is not within the bounds of"},
        {"1 variables\nmany " FORCE "\n" ONE END, 2, 1, "'many' is not a number for"},
        {"0 variables\n1 functions\n1 ASV_1:interfaces.peak_forc_kN\n" END, 3, 1,
         "there is no metric 'interfaces.peak_forc_kN'"},
        {"0 variables\n1 functions\n1 ASV_1:interfaces.peak_force_kN@crash\n" END, 3, 1, "'crash'"},
        {"0 variables\n1 functions\n1 ASV_1:interfaces.A1-C1.peak_force_kN\n" END, 3, 1,
         "no place of the problem has 'interfaces.A1-C1.peak_force_kN'"},
        {"0 variables\n1 functions\n1 ASV_1:margin.reserve_of_strokes\n" END, 3, 1,
         "there is no check 'reserve_of_strokes'"},
        {"0 variables\n1 functions\n1 ASV_1:margin.reserve_of_stroke@crash\n" END, 3, 1,
         "there is no check 'reserve_of_stroke' in scenario crash"},
        {"1 variables\nzhai simulation.track\n" ONE
         "1 derivative_variables\n1 DVV_1:x\n0 analysis_components\n1 eval_id\n",
         6, 1, "there is no derivative by 'simulation.track', which chooses or is fixed"}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char results[2000];
        CzError error;
        assert_int_equal(evaluate(files[i].file, results, &error), CZ_STATUS_INPUT);
        if (strstr(error.message, files[i].sentence) == NULL || error.line != files[i].line ||
            error.column != files[i].column)
            fail_msg("file %zu: %d:%d: %s", i, error.line, error.column, error.message);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_formats_give_the_values_of_the_evaluator),
        cmocka_unit_test(a_path_is_set_as_in_a_file),
        cmocka_unit_test(gradients_follow_the_energy_of_the_tube),
        cmocka_unit_test(a_failed_evaluation_says_why),
        cmocka_unit_test(a_mistake_is_reported_at_its_place)};
    return cmocka_run_group_tests(tests, read_problem, end);
}
