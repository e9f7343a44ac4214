/* Requests of a design loop and their answers. */
#include "serve/serving.h"

#include "evaluate/evaluator.h"
#include "evaluate/small_problem.h"
#include "support/shipped.h"

#define TUBE "parts.tube.stages[0].force_kN"
#define STROKE "parts.anti-climber.stages[0].stroke_mm"

static const char variables[] =
    "optimise:\n"
    "  minimise: interfaces.peak_force_kN\n"
    "  variables:\n"
    "    - {path: \"" TUBE "\", min: 500, max: 1100}\n"
    "    - {name: stroke, path: \"" STROKE "\", min: 200, max: 500}\n"
    "  subject_to: [checks]\n"
    "checks:\n"
    "  limits:\n"
    "    - {name: force, metric: interfaces.peak_force_kN, max: 1500}\n";

static Serving serve_small(int n_job) {
    return serve(small_problem(variables), n_job);
}

/* ---- bits ---- */

/* The answer of a server whose problem was read with settings. */
static char *ask_file(const char *file, int n_set, const char *const *set, const char *line) {
    CzProblemOptions options = cz_problem_options_default();
    CzError error = {0};
    CzProblem *problem = NULL;
    options.set = set;
    options.n_set = n_set;
    options.share_folder = CZ_SOURCE_FOLDER "/problems";
    const CzStatus status = cz_problem_read(file, &options, &problem, &error);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    assert_int_equal(status, CZ_OK);
    Serving serving = serve(problem, 1);
    char *answer = ask(&serving, line);
    end_serving(&serving);
    return answer;
}

/* A value of a variable that a search may choose, different from its start. */
static double other_value(const CzVariableInfo *info) {
    const double step = info->increment > 0 ? info->increment : (info->max - info->min) / 64;
    return info->start + step <= info->max ? info->start + step : info->start - step;
}

/* Compares the answer to `set` with that of the file with these values, for the first or for all
 * variables of a problem; returns the number of variables, of a search whose values are those of
 * single places. */
static int compare_with_file(const char *file, bool first_only, bool *is_fast) {
    static const char *const shorter[] = {"simulation.duration_ms=40"};
    CzProblemOptions options = cz_problem_options_default();
    CzError error = {0};
    CzProblem *problem = NULL;
    options.set = shorter;
    options.n_set = 1;
    options.share_folder = CZ_SOURCE_FOLDER "/problems";
    assert_int_equal(cz_problem_read(file, &options, &problem, &error), CZ_OK);
    Serving serving = serve(problem, 2);
    CzEvaluator *evaluator = NULL;
    assert_int_equal(cz_evaluator_build(problem, NULL, &evaluator, &error), CZ_OK);
    const char *scenario = cz_problem_scenario_name(problem, 0);
    char request[8192], rest[256], set[20][300];
    const char *setting[21] = {shorter[0]}, *path[20];
    double number[20], x[200];
    int n = 0, at = snprintf(request, sizeof request, "{\"set\": {");
    const int n_variable = cz_evaluator_n_variable(evaluator);
    for (int i = 0; i < n_variable && n < 20 && !(first_only && n > 0); i++) {
        const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
        if (info->n_choice > 0 || info->n_place > 1 || info->is_fixed)
            continue;
        path[n] = info->place[0].path;
        number[n] = other_value(info);
        at += snprintf(request + at, sizeof request - (size_t)at, "%s\"%s\": %.17g",
                       n > 0 ? ", " : "", path[n], number[n]);
        snprintf(set[n], sizeof set[n], "%s=%.17g", path[n], number[n]);
        setting[n + 1] = set[n];
        n++;
    }
    snprintf(rest, sizeof rest,
             "\"scenarios\": [\"%s\"], \"want\": [\"checks\", \"interfaces.energy_kJ\", "
             "\"interfaces.peak_force_kN\"]}",
             scenario);
    snprintf(request + at, sizeof request - (size_t)at, "}, %s", rest);
    char line[300];
    snprintf(line, sizeof line, "{%s", rest);
    assert_true(n_variable <= 200);
    *is_fast |= n > 0 && cz_evaluator_take_settings(evaluator, n, path, number, x);
    char *answer = n > 0 ? ask(&serving, request) : NULL;
    char *expected = n > 0 ? ask_file(file, n + 1, setting, line) : NULL;
    if (n > 0)
        assert_string_equal(answer, expected);
    free(answer);
    free(expected);
    cz_evaluator_free(evaluator);
    end_serving(&serving);
    return n;
}

static void set_gives_the_bits_of_the_file(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    int n = 0;
    bool is_fast = false;
    for (int i = 0; i < shipped.n; i++) {
        char file[256];
        snprintf(file, sizeof file, CZ_SOURCE_FOLDER "/problems/%s", shipped.name[i]);
        n += compare_with_file(file, false, &is_fast);
        n += compare_with_file(file, true, &is_fast);
    }
    assert_true(n > 10 && is_fast);
}

/* Values that change the longest stable step are read again: a run with the former one would have
 * other bits. */
static void only_settings_that_keep_the_model_are_designs(void **state) {
    (void)state;
    CzProblem *problem =
        small_problem("optimise: {variables: [{path: \"" TUBE "\", min: 500, max: 1100}, {path: "
                      "\"parts.head.stages[0].force_kN\", min: 2000, max: 90000}]}\n");
    CzEvaluator *evaluator = NULL;
    CzError error = {0};
    assert_int_equal(cz_evaluator_build(problem, NULL, &evaluator, &error), CZ_OK);
    const char *const tube[] = {TUBE}, *const head[] = {"parts.head.stages[0].force_kN"},
                      *const mass[] = {"trains.A.vehicles.A1.mass_t"};
    double x[2];
    assert_true(cz_evaluator_take_settings(evaluator, 1, tube, &(double){900}, x));
    assert_near(x[0], 900, 0, 0);
    assert_near(x[1], 3000, 0, 0);
    assert_false(cz_evaluator_take_settings(evaluator, 1, tube, &(double){1101}, x));
    assert_false(cz_evaluator_take_settings(evaluator, 1, tube, &(double){NAN}, x));
    assert_false(cz_evaluator_take_settings(evaluator, 1, mass, &(double){41}, x));
    assert_false(cz_evaluator_take_settings(evaluator, 1, head, &(double){90000}, x));
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

static void variables_give_the_bits_of_a_search(void **state) {
    (void)state;
    Serving serving = serve_small(1);
    json_t *answer = ask_json(&serving, "{\"variables\": {\"stroke\": 300, \"" TUBE "\": 777}, "
                                        "\"want\": [\"constraints\"]}");
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation;
    CzError error = {0};
    const double x[] = {777, 300};
    assert_int_equal(cz_evaluator_build(serving.problem, NULL, &evaluator, &error), CZ_OK);
    assert_int_equal(cz_evaluate(evaluator, 1, x, false, &evaluation, &error), CZ_OK);
    assert_near(number_at(answer, "objective"), evaluation.objective, 0, 0);
    assert_near(number_at(answer, "violation"), evaluation.violation, 0, 0);
    const json_t *constraints = json_object_get(answer, "constraints");
    assert_int_equal(json_array_size(constraints), evaluation.n_constraint);
    for (int j = 0; j < evaluation.n_constraint; j++)
        assert_near(json_number_value(json_array_get(constraints, (size_t)j)),
                    evaluation.constraint[j], 0, 0);
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    json_decref(answer);
    end_serving(&serving);
}

static void a_list_has_the_answers_of_its_requests_in_order(void **state) {
    (void)state;
    static const char *const requests[] = {
        "{\"id\": 3, \"set\": {\"" TUBE "\": 900}}",
        "{\"id\": 2, \"variables\": {\"stroke\": 250}, \"want\": [\"checks\"]}",
        "{\"id\": 1, \"variables\": {\"stroke\": 251}, \"want\": [\"checks\"]}",
        "{\"id\": 0, \"set\": {\"trains.A.vehicles.A1.mass_t\": 41}}",
        "{\"id\": 5, \"wish\": 1}",
        "{\"id\": 6, \"set\": {\"" TUBE "\": 900}, \"variables\": {\"stroke\": 250}}",
        "{\"op\": \"gradient\", \"scenarios\": [\"crash\"], \"variables\": {\"stroke\": 250}}",
        "{\"op\": \"describe\"}",
        "{\"scenarios\": [\"crash\", \"buffing\"]}"};
    enum { N = sizeof requests / sizeof *requests };
    char all[2000] = "[", expected[60000] = "[";
    Serving one = serve_small(1), three = serve_small(3);
    for (int i = 0; i < N; i++) {
        char *answer = ask(&one, requests[i]);
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", requests[i],
                 i + 1 < N ? ", " : "]");
        snprintf(expected + strlen(expected), sizeof expected - strlen(expected), "%s%s", answer,
                 i + 1 < N ? ", " : "]");
        free(answer);
    }
    char *together = ask(&one, all), *by_threads = ask(&three, all);
    assert_string_equal(together, expected);
    assert_string_equal(by_threads, expected);
    free(together);
    free(by_threads);
    end_serving(&one);
    end_serving(&three);
}

static void long_lists_are_answered_whole(void **state) {
    (void)state;
    enum { N = 150 };
    static char all[N * 64];
    Serving serving = serve(small_problem("simulation: {duration_ms: 1}\n"), 2);
    strcpy(all, "[");
    for (int i = 0; i < N; i++)
        snprintf(all + strlen(all), 64, "{\"id\": %d}%s", i, i + 1 < N ? "," : "]");
    json_t *answers = ask_json(&serving, all);
    assert_int_equal(json_array_size(answers), N);
    for (int i = 0; i < N; i++)
        assert_near(number_at(json_array_get(answers, (size_t)i), "id"), i, 0, 0);
    json_decref(answers);
    end_serving(&serving);
}

/* ---- contents ---- */

static void only_named_scenarios_are_run(void **state) {
    (void)state;
    Serving serving = serve_small(1);
    json_t *all = ask_json(&serving, "{\"want\": [\"interfaces.peak_force_kN\", "
                                     "\"interfaces.peak_force_kN.min\"]}");
    json_t *one = ask_json(&serving, "{\"scenarios\": [\"buffing\"], \"want\": "
                                     "[\"interfaces.peak_force_kN\", \"checks\"]}");
    const json_t *values = json_object_get(all, "values");
    assert_true(number_at(values, "interfaces.peak_force_kN") >
                number_at(json_object_get(one, "values"), "interfaces.peak_force_kN"));
    assert_near(number_at(values, "interfaces.peak_force_kN.min"),
                number_at(json_object_get(one, "values"), "interfaces.peak_force_kN"), 0, 0);
    const json_t *check = json_array_get(json_object_get(one, "checks"), 0);
    assert_string_equal(text_at(check, "scenario"), "crash");
    assert_string_equal(text_at(check, "verdict"), "not checked");
    json_decref(all);
    json_decref(one);
    end_serving(&serving);
}

static void a_description_lists_the_variables(void **state) {
    (void)state;
    Serving serving = serve_small(1);
    json_t *answer = ask_json(&serving, "{\"op\": \"describe\", \"id\": 9}");
    const json_t *list = json_object_get(answer, "variables");
    const json_t *second = json_array_get(list, 1);
    assert_near(number_at(answer, "id"), 9, 0, 0);
    assert_int_equal(json_array_size(list), 2);
    assert_string_equal(text_at(second, "name"), "stroke");
    assert_string_equal(text_at(second, "unit"), "mm");
    assert_near(number_at(second, "min"), 200, 0, 0);
    assert_near(number_at(second, "start"), 400, 0, 0);
    assert_string_equal(text_at(json_array_get(json_object_get(second, "places"), 0), "path"),
                        STROKE);
    assert_string_equal(text_at(json_object_get(answer, "minimises"), "unit"), "kN");
    assert_int_equal(json_array_size(json_object_get(answer, "scenarios")), 5);
    assert_true(json_array_size(json_object_get(answer, "metrics")) > 10);
    json_decref(answer);
    end_serving(&serving);
}

static void a_choice_is_given_by_name(void **state) {
    (void)state;
    CzProblem *problem = NULL;
    CzError error = {0};
    CzProblemOptions options = cz_problem_options_default();
    static const char *const shorter[] = {"simulation.duration_ms=40"};
    options.set = shorter;
    options.n_set = 1;
    assert_int_equal(cz_problem_read(CZ_SOURCE_FOLDER "/problems/buffer-choice.yaml", &options,
                                     &problem, &error),
                     CZ_OK);
    Serving serving = serve(problem, 1);
    json_t *described = ask_json(&serving, "{\"op\": \"describe\"}");
    const json_t *list = json_object_get(described, "variables"), *chooses = NULL;
    for (size_t i = 0; i < json_array_size(list); i++)
        if (json_object_get(json_array_get(list, i), "choices") != NULL)
            chooses = json_array_get(list, i);
    assert_non_null(chooses);
    const json_t *choices = json_object_get(chooses, "choices");
    char line[2][300];
    for (size_t k = 0; k < 2; k++)
        snprintf(line[k], sizeof line[k],
                 "{\"variables\": {\"%s\": \"%s\"}, \"want\": [\"interfaces.energy_kJ\"]}",
                 text_at(chooses, "name"), json_string_value(json_array_get(choices, k)));
    char *first = ask(&serving, line[0]), *second = ask(&serving, line[1]);
    assert_string_not_equal(first, second);
    free(first);
    free(second);
    json_t *wrong = ask_json(&serving, "{\"variables\": {\"tube\": \"soft\"}}");
    assert_string_equal(text_at(wrong, "status"), "error");
    json_decref(wrong);
    json_decref(described);
    end_serving(&serving);
}

/* The difference of two designs on a straight line of the objective: a mean force of a tube. */
static void a_gradient_is_the_difference_of_designs(void **state) {
    (void)state;
    Serving serving = serve_small(2);
    json_t *answer =
        ask_json(&serving, "{\"op\": \"gradient\", \"variables\": {\"" TUBE "\": 900, \"stroke\": "
                           "500}, \"step\": 0.01, \"want\": [\"constraints\", "
                           "\"interfaces.energy_kJ\"]}");
    json_t *at = ask_json(&serving, "{\"variables\": {\"" TUBE "\": 900, \"stroke\": 500}}");
    json_t *inside = ask_json(&serving, "{\"variables\": {\"" TUBE "\": 900, \"stroke\": 497}}");
    json_t *beside = ask_json(&serving, "{\"variables\": {\"" TUBE "\": 906, \"stroke\": 500}}");
    const json_t *gradient = json_object_get(answer, "gradient");
    const json_t *objective = json_array_get(gradient, 0);
    const json_t *by = json_object_get(objective, "by");
    assert_string_equal(text_at(objective, "of"), "objective");
    assert_string_equal(text_at(json_array_get(gradient, 1), "of"), "interfaces.energy_kJ");
    assert_near(number_at(objective, "value"), number_at(at, "objective"), 0, 0);
    assert_near(number_at(by, TUBE),
                (number_at(beside, "objective") - number_at(at, "objective")) / 6,
                ROUNDING_OF_A_SUM, 0);
    assert_near(number_at(by, "stroke"),
                (number_at(inside, "objective") - number_at(at, "objective")) / -3,
                ROUNDING_OF_A_SUM, 0);
    assert_int_equal(json_array_size(gradient),
                     2 + json_array_size(json_object_get(answer, "constraints")));
    json_decref(answer);
    json_decref(at);
    json_decref(inside);
    json_decref(beside);
    end_serving(&serving);
}

/* ---- errors ---- */

typedef struct Wrong {
    const char *line, *message, *help;
} Wrong;

static void errors_are_answers(void **state) {
    (void)state;
    static const Wrong wrong[] = {
        {"", "the line is not JSON: ", "a request is one JSON object"},
        {"{\"id\": 1", "the line is not JSON: ", ""},
        {"{\"id\": 1, \"id\": 2}", "duplicate object key", ""},
        {"{\"id\": 1e999}", "real number overflow", ""},
        {"{\"id\": NaN}", "the line is not JSON: ", ""},
        {"5", "'request' needs an object, but this is a number", ""},
        {"null", "'request' needs an object, but this is null", ""},
        {"{\"id\": \"a\"}", "'id' needs a whole number of at most 2^53, but this is a text", ""},
        {"{\"id\": 1.5}", "'id' needs a whole number", ""},
        {"{\"id\": 1e17}", "'id' needs a whole number", ""},
        {"{\"op\": 1}", "'op' needs a text, but this is a number", ""},
        {"{\"op\": \"descibe\"}", "there is no operation 'descibe'", "did you mean 'describe'?"},
        {"{\"op\": \"describe\", \"set\": {}}", "'set' does not belong to the operation", ""},
        {"{\"step\": 1}", "'step' does not belong to the operation 'evaluate'", ""},
        {"{\"op\": \"gradient\", \"step\": 0.6}", "'step' needs a number above 0, up to 0.5", ""},
        {"{\"wants\": []}", "a request has no key 'wants'", "did you mean 'want'?"},
        {"{\"want\": \"checks\"}", "'want' needs a list of texts, but this is a text", ""},
        {"{\"want\": [true]}", "'want' needs a list of texts, but this is true or false", ""},
        {"{\"want\": [\"interfaces.peak_forces_kN\"]}", "there is no metric", "did you mean"},
        {"{\"want\": [\"interfaces.A7-B1.peak_force_kN\"]}", "names no place of the problem", ""},
        {"{\"scenarios\": [\"crsh\"]}", "there is no scenario 'crsh'", "did you mean 'crash'?"},
        {"{\"set\": [1]}", "'set' needs an object of values by name, but this is a list", ""},
        {"{\"set\": {\"trains.A.speed_km_h\": null}}", "'set' needs numbers or texts", ""},
        {"{\"set\": {\"parts.tube.stages[0].forse_kN\": 1}}", "forse_kN", "force_kN"},
        {"{\"set\": {\"" TUBE "\": -900}}", "-900", ""},
        {"{\"set\": {\"title\": \"a\\nb\"}}", "a text of 'set' contains ", ""},
        {"{\"set\": {\"title\": \"a\\u0000b\"}}", "\\u0000", ""},
        {"{\"variables\": {\"stroke\": 501}}", "'stroke' is 501; it must be a number from 200", ""},
        {"{\"variables\": {\"stroke\": \"long\"}}", "'stroke' is long; it must be a number", ""},
        {"{\"variables\": {\"strike\": 300}}", "there is no design variable 'strike'",
         "did you mean 'stroke'?"},
        {"\xff\xfe{}", "the line is not JSON: ", ""},
    };
    Serving serving = serve_small(1);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        json_t *answer = ask_json(&serving, wrong[i].line);
        const json_t *error = json_object_get(answer, "error");
        assert_string_equal(text_at(answer, "status"), "error");
        if (strstr(text_at(error, "message"), wrong[i].message) == NULL ||
            strstr(text_at(error, "help"), wrong[i].help) == NULL)
            print_error("%s: %s (%s)\n", wrong[i].line, text_at(error, "message"),
                        text_at(error, "help"));
        assert_non_null(strstr(text_at(error, "message"), wrong[i].message));
        assert_non_null(strstr(text_at(error, "help"), wrong[i].help));
        json_decref(answer);
    }
    end_serving(&serving);
}

static void an_error_has_its_place(void **state) {
    (void)state;
    Serving serving = serve_small(1);
    json_t *answer = ask_json(&serving, "{\"id\": 4, \"set\": {\"title\": \"x\", "
                                        "\"parts.tube.stages[0].forse_kN\": 1}}");
    const json_t *error = json_object_get(answer, "error");
    assert_near(number_at(answer, "id"), 4, 0, 0);
    assert_string_equal(text_at(error, "file"), "--set");
    assert_near(number_at(error, "line"), 2, 0, 0);
    json_decref(answer);
    answer = ask_json(&serving, "{\"id\": 1,}");
    assert_near(number_at(json_object_get(answer, "error"), "column"), 10, 0, 0);
    json_decref(answer);
    answer = ask_json(&serving, "{\"set\": {\"scenarios[0].speed_km_h\": -3}}");
    assert_string_equal(text_at(answer, "status"), "error");
    json_decref(answer);
    end_serving(&serving);
}

static void lists_have_at_most_a_thousand_entries(void **state) {
    (void)state;
    Serving serving = serve_small(1);
    static char line[6000] = "{\"want\": [\"checks\"";
    for (int i = 0; i < 1000; i++)
        strcat(line, ",\"\"");
    json_t *answer = ask_json(&serving, strcat(line, "]}"));
    assert_string_equal(text_at(json_object_get(answer, "error"), "message"),
                        "'want' has 1001 entries, of at most 1000");
    json_decref(answer);
    end_serving(&serving);
}

static void a_metric_that_is_wanted_twice_is_there_once(void **state) {
    (void)state;
    Serving serving = serve_small(1);
    json_t *answer = ask_json(&serving, "{\"scenarios\": [\"buffing\", \"buffing\"], \"want\": "
                                        "[\"interfaces.energy_kJ\", \"interfaces.energy_kJ\"]}");
    assert_int_equal(json_object_size(json_object_get(answer, "values")), 1);
    json_decref(answer);
    end_serving(&serving);
}

static void deep_and_binary_lines_are_answered(void **state) {
    (void)state;
    enum { DEPTH = 100000 };
    Serving serving = serve_small(1);
    char *deep = malloc(DEPTH);
    assert_non_null(deep);
    memset(deep, '[', DEPTH);
    char *answer = ask_bytes(&serving, deep, DEPTH);
    assert_non_null(strstr(answer, "maximum parsing depth"));
    free(answer);
    memset(deep, 0, DEPTH);
    answer = ask_bytes(&serving, deep, DEPTH);
    assert_non_null(strstr(answer, "the line is not JSON"));
    free(answer);
    free(deep);
    end_serving(&serving);
}

static void a_failed_run_is_an_answer(void **state) {
    (void)state;
    Serving serving = serve_small(1);
    json_t *answer = ask_json(&serving, "{\"set\": {\"simulation.longest_s\": 0.01}, \"want\": "
                                        "[\"interfaces.energy_kJ\", \"constraints\"]}");
    assert_string_equal(text_at(answer, "status"), "failed");
    assert_non_null(strstr(text_at(answer, "failure"), "crash: "));
    assert_null(json_object_get(answer, "objective"));
    assert_true(
        json_is_null(json_object_get(json_object_get(answer, "values"), "interfaces.energy_kJ")));
    json_decref(answer);
    end_serving(&serving);
}

static void an_answer_stops_when_the_flag_is_set(void **state) {
    (void)state;
    static volatile sig_atomic_t stop = 1;
    CzProblem *problem = small_problem("");
    const CzServerOptions options = {.n_job = 1, .stop = &stop};
    CzServer *server = NULL;
    CzError error = {0};
    char text[100];
    FILE *stream = fmemopen(text, sizeof text, "w");
    assert_int_equal(cz_server_build(problem, &options, &server, &error), CZ_OK);
    assert_int_equal(cz_server_answer(server, "{}", 2, stream, &error), CZ_STATUS_INTERRUPTED);
    fclose(stream);
    cz_server_free(server);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(set_gives_the_bits_of_the_file),
        cmocka_unit_test(only_settings_that_keep_the_model_are_designs),
        cmocka_unit_test(variables_give_the_bits_of_a_search),
        cmocka_unit_test(a_list_has_the_answers_of_its_requests_in_order),
        cmocka_unit_test(long_lists_are_answered_whole),
        cmocka_unit_test(only_named_scenarios_are_run),
        cmocka_unit_test(a_description_lists_the_variables),
        cmocka_unit_test(a_choice_is_given_by_name),
        cmocka_unit_test(a_gradient_is_the_difference_of_designs),
        cmocka_unit_test(errors_are_answers),
        cmocka_unit_test(an_error_has_its_place),
        cmocka_unit_test(lists_have_at_most_a_thousand_entries),
        cmocka_unit_test(a_metric_that_is_wanted_twice_is_there_once),
        cmocka_unit_test(deep_and_binary_lines_are_answered),
        cmocka_unit_test(a_failed_run_is_an_answer),
        cmocka_unit_test(an_answer_stops_when_the_flag_is_set),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
