/* The pages of a real run: complete, in order, and never cut without a message. */
#include "support/check.h"

#include "evaluate/metric.h"
#include "report/page.h"
#include "report/well_formed.h"
#include "simulate/input_curve.h"

static int n_request;    /* so far */
static int failing = -1; /* number of the request that fails; -1: none */

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);

static bool is_failing(void) {
    return n_request++ == failing;
}
void *__wrap_malloc(size_t size) {
    return is_failing() ? NULL : __real_malloc(size);
}
void *__wrap_calloc(size_t n, size_t size) {
    return is_failing() ? NULL : __real_calloc(n, size);
}
void *__wrap_realloc(void *memory, size_t size) {
    return is_failing() ? NULL : __real_realloc(memory, size);
}
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return is_failing() ? NULL : __real_aligned_alloc(alignment, size);
}

/* A problem that was run, and the input of its page. */
typedef struct Ran {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzEvaluation evaluation;
    CzReportRun run;
} Ran;

static Ran run_set(const char *name, const char *scenario, int n_set, const char *const *set) {
    CzEvaluatorOptions choice = cz_evaluator_options_default();
    char path[300];
    Ran ran = {0};
    CzError error = {0};
    CzProblemOptions options = cz_problem_options_default();
    options.set = set;
    options.n_set = n_set;
    choice.scenario = scenario;
    options.share_folder = CZ_SOURCE_FOLDER "/problems";
    snprintf(path, sizeof path, CZ_SOURCE_FOLDER "/problems/%s", name);
    if (cz_problem_read(path, &options, &ran.problem, &error) != CZ_OK ||
        cz_evaluator_build(ran.problem, &choice, &ran.evaluator, &error) != CZ_OK ||
        cz_evaluate(ran.evaluator, 1, NULL, true, &ran.evaluation, &error) != CZ_OK)
        fail_msg("%s: %s", name, error.message);
    return ran;
}

static Ran run_problem(const char *name) {
    static const char *const set[] = {"simulation.duration_ms=150"};
    return run_set(name, NULL, 1, set);
}

/* The problem of two cars in two scenarios, of which the second fails more. */
static Ran run_two_scenarios(void) {
    static const char text[] = "extends: two-cars-25kmh.yaml\n"
                               "simulation: {duration_ms: 150}\n"
                               "scenarios: [{name: slow, speed_km_h: 10}, {name: usual}]\n";
    CzProblemOptions options = cz_problem_options_default();
    const CzEvaluatorOptions choice = cz_evaluator_options_default();
    CzError error = {0};
    Ran ran = {0};
    options.share_folder = CZ_SOURCE_FOLDER "/problems";
    if (cz_problem_read_text(text, sizeof text - 1, "two.yaml", CZ_SOURCE_FOLDER "/problems",
                             &options, &ran.problem, &error) != CZ_OK ||
        cz_evaluator_build(ran.problem, &choice, &ran.evaluator, &error) != CZ_OK ||
        cz_evaluate(ran.evaluator, 1, NULL, true, &ran.evaluation, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return ran;
}

static CzReport run_of(const Ran *ran) {
    return (CzReport){
        .kind = CZ_REPORT_RUN, .problem = ran->problem, .evaluation = &ran->evaluation};
}

static void free_ran(Ran *ran) {
    cz_evaluation_free(&ran->evaluation);
    cz_evaluator_free(ran->evaluator);
    cz_problem_free(ran->problem);
}

/* The page, or the status of its writer. */
static CzStatus write_page(const CzReport *run, char **text) {
    size_t n = 0;
    CzError error = {0};
    FILE *stream = open_memstream(text, &n);
    assert_non_null(stream);
    const CzStatus status = cz_report_write_page(run, stream, &error);
    fclose(stream);
    assert_true((status == CZ_OK) == (error.message[0] == '\0'));
    return status;
}

static void sections_are_in_order(void **state) {
    (void)state;
    static const char *const order[] = {
        "<h1>",          "id=\"checks\"", "id=\"trains\"",   "id=\"loops\"",
        "id=\"energy\"", "id=\"motion\"", "id=\"vertical\"", "id=\"animation\"",
        "id=\"events\"", "id=\"inputs\"", "id=\"data\""};
    Ran ran = run_problem("two-cars-25kmh.yaml");
    const CzReport run = run_of(&ran);
    char *text = NULL;
    assert_int_equal(write_page(&run, &text), CZ_OK);
    const char *from = text;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        const char *found = strstr(from, order[i]);
        if (found == NULL)
            print_error("%s is not where it belongs\n", order[i]);
        assert_non_null(found);
        from = found;
    }
    const char *doctype = strchr(text, '\n'); /* no element */
    assert_true(is_well_formed(doctype));
    assert_int_equal(count_of(text, "class=\"car\" transform"), 2 * (6 + 1)); /* frames and stage */
    free(text);
    free_ran(&ran);
}

static void every_lack_of_memory_is_reported(void **state) {
    (void)state;
    Ran ran = run_problem("two-cars-25kmh.yaml");
    const CzReport run = run_of(&ran);
    int n_failed = 0;
    for (bool has_failed = true; has_failed; n_failed++) {
        char *text = NULL;
        n_request = 0;
        failing = n_failed;
        const CzStatus status = write_page(&run, &text);
        has_failed = n_request > failing;
        failing = -1;
        free(text);
        assert_int_equal(status, has_failed ? CZ_STATUS_NO_MEMORY : CZ_OK);
    }
    assert_true(n_failed > 50);
    free_ran(&ran);
}

static void a_page_of_several_scenarios_begins_with_their_matrix(void **state) {
    (void)state;
    static const char *const order[] = {
        "id=\"matrix\"", "href=\"slow/report.html\"", "href=\"#check-1\"", "href=\"#deciding-1\"",
        "id=\"checks\"", "id=\"deciding\"",           "id=\"deciding-1\"", "id=\"trains\""};
    Ran ran = run_two_scenarios();
    const CzReport run = run_of(&ran);
    char *text = NULL;
    assert_int_equal(write_page(&run, &text), CZ_OK);
    const char *from = text;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        from = strstr(from, order[i]);
        if (from == NULL)
            print_error("%s is not where it belongs\n", order[i]);
        assert_non_null(from);
    }
    assert_true(is_well_formed(strchr(text, '\n')));
    free(text);
    for (int n = 0; n < 400; n += 13) { /* some of the requests for memory */
        text = NULL;
        n_request = 0;
        failing = n;
        const CzStatus status = write_page(&run, &text);
        const bool has_failed = n_request > failing;
        failing = -1;
        free(text);
        assert_int_equal(status, has_failed ? CZ_STATUS_NO_MEMORY : CZ_OK);
    }
    free_ran(&ran);
}

/* Every entry of the list of figures names a metric. */
static void figures_that_decide_belong_to_metrics(void **state) {
    (void)state;
    static const char *const named[] = {
#define CZ_FIGURE_OF(metric, chart) metric,
#include "report/deciding_figures.def"
    };
    for (size_t i = 0; i < sizeof named / sizeof *named; i++) {
        bool exists = false;
        for (int k = 0; k < cz_n_metric_kind(); k++)
            exists |= strcmp(cz_metric_kind(k)->name, named[i]) == 0;
        if (!exists)
            fail_msg("there is no metric %s", named[i]);
    }
}

static void a_run_that_was_not_kept_has_no_page(void **state) {
    (void)state;
    Ran ran = run_problem("two-cars-25kmh.yaml");
    CzEvaluation none = ran.evaluation;
    none.run = NULL;
    const CzReport run = {.kind = CZ_REPORT_RUN, .problem = ran.problem, .evaluation = &none};
    char *text = NULL;
    assert_int_equal(write_page(&run, &text), CZ_STATUS_INPUT);
    free(text);
    free_ran(&ran);
}

/* The hand check of the problem file: each coupler has 20 kN rising to 0.4 MN over 50 mm of its
 * buffer and 0.6 MN over 250 mm of its tube, two of them 321 kJ, and then releases at 911 kN; two
 * anti-climbers push with 1 MN. Members advance by the spacing of the points, so the tolerance of
 * the areas is one spacing times the force for each of six members. */
static void the_input_curve_is_that_of_the_weakest_member(void **state) {
    (void)state;
    enum { N = 4001 };
    static double closure[N], force[N];
    Ran ran = run_problem("two-cars-25kmh.yaml");
    CzModel *model = NULL;
    assert_int_equal(cz_model_build(ran.problem, 0, &model, NULL), CZ_OK);
    const int colliding = cz_model_colliding_interface(model);
    assert_int_equal(cz_input_curve(model, colliding, 1.0, N, closure, force, NULL), CZ_OK);
    const double step = closure[1];
    assert_near(closure[N - 1], 1.0, 1e-12, 0);
    assert_near(force[(int)lround(0.05 / step)], 210e3, 0, 2 * 400e3 / 0.05 * step);
    assert_near(force[(int)lround(0.35 / step)], 600e3, 0, 1);
    double area = 0, largest = 0;
    int i = 0;
    for (; force[i] < 911e3; i++) {
        area += force[i] * step;
        largest = fmax(largest, force[i]);
    }
    assert_near(closure[i], 0.6, 0, 8 * step + 2e-3); /* two buffers and tubes exhausted */
    assert_near(area, 321e3, 0, 6 * step * 911e3 + 2e-3 * 911e3);
    for (; force[i] > 0; i++)
        assert_true(force[i] <= 911e3); /* it releases */
    while (force[i] < 990e3)
        i++;
    assert_near(force[i + 40], 1e6, 0.01, 0);
    cz_model_free(model);
    free_ran(&ran);
}

/* Against a wall one coupler acts, over its own softening; then two anti-climbers carry 1 MN alone.
 */
static void a_sheared_coupler_carries_no_force_against_a_wall(void **state) {
    (void)state;
    enum { N = 1201 };
    static double closure[N], force[N];
    Ran ran = run_set("wall.yaml", "16-km-h", 0, NULL);
    CzModel *model = NULL;
    assert_int_equal(cz_model_build(ran.problem, 0, &model, NULL), CZ_OK);
    assert_int_equal(cz_input_curve(model, 0, 0.6, N, closure, force, NULL), CZ_OK);
    int lowest = 620;
    for (int i = 620; i < 700; i++) /* 0.31 to 0.35 m, the faces touch at 0.32 m */
        lowest = force[i] < force[lowest] ? i : lowest;
    assert_true(force[lowest] < 0.5 * 911e3);
    for (int i = 720; i < 1200; i++)
        assert_near(force[i], 1e6, 0.01, 0);
    cz_model_free(model);
    free_ran(&ran);
}

/* ---- the numbers behind the cursor ---- */

/* Reads a channel from the page: how many values. Those of a NULL `value` are counted only. */
static int read_channel(const char *page, const char *name, int *decimals, double *value) {
    char head[96];
    int n = 0;
    double last = 0, step = 0;
    snprintf(head, sizeof head, "\"%s\":[", name);
    const char *at = strstr(page, head);
    assert_non_null(at);
    *decimals = atoi(at + strlen(head));
    for (at = strchr(at + strlen(head), '"') + 1; *at != '"';) {
        const bool is_run = *at == 'z' || *at == 'n', is_gap = *at == 'n';
        const bool has_number = !is_run || (at[1] >= '0' && at[1] <= '9');
        char *end = (char *)at + 1;
        const long number = has_number ? strtol(at + is_run, &end, 10) : 1;
        const long n_more = is_run ? number : 1;
        assert_true(end > at);
        for (long k = 0; k < n_more; k++, n++) {
            if (!is_gap) {
                step += is_run ? 0 : (double)number;
                last += step;
            }
            if (value != NULL)
                value[n] = is_gap ? NAN : last / pow(10, *decimals);
        }
        at = end;
    }
    return n;
}

static void name_column(const CzRun *run, CzColumn column, char name[CZ_CHANNEL_SIZE]) {
    const CzChannelInfo *info = cz_channel_info(column.channel);
    const CzRunSummary *summary = cz_run_summary(run);
    cz_channel_name(info, column.place, cz_run_place_name(summary, info->at, column.place), name);
}

/* Every channel has its recorded value at each row that the page has, to half of its last digit. */
static void compare_rows(const char *page, const CzRun *run, int n_row) {
    double *time = malloc((size_t)n_row * sizeof *time),
           *value = malloc((size_t)n_row * sizeof *value);
    int decimals, n_channel = 0;
    const double *at = cz_run_channel(run, CZ_CHANNEL_TIME, 0);
    assert_int_equal(read_channel(page, "t_ms", &decimals, time), n_row);
    for (int k = 1; k < cz_run_n_column(run); k++) {
        const CzColumn column = cz_run_column(run, k);
        const double *real = cz_run_channel(run, column.channel, column.place);
        char name[CZ_CHANNEL_SIZE], head[CZ_CHANNEL_SIZE + 8];
        name_column(run, column, name);
        snprintf(head, sizeof head, "\"%s\":[", name);
        if (strstr(page, head) == NULL)
            continue;
        assert_int_equal(read_channel(page, name, &decimals, value), n_row);
        for (int i = 0, row = 0; i < n_row; i++, row++) {
            while (fabs(at[row] - time[i]) > 1e-9)
                row++;
            assert_true(isnan(value[i]) == isnan(real[row]));
            if (isfinite(real[row]))
                assert_near(value[i], real[row], 0, 0.5000001 * pow(10, -decimals));
        }
        n_channel++;
    }
    assert_true(n_channel > 25);
    free(time);
    free(value);
}

static void the_cursor_shows_every_recorded_row(void **state) {
    (void)state;
    static const char *const set[] = {"simulation.duration_ms=900"};
    Ran ran = run_set("two-cars-25kmh.yaml", NULL, 1, set);
    const CzReport run = run_of(&ran);
    char *text = NULL;
    assert_int_equal(write_page(&run, &text), CZ_OK);
    assert_int_equal(cz_run_n_sample(ran.evaluation.run[0]), 901);
    compare_rows(text, ran.evaluation.run[0], 901);
    assert_non_null(strstr(text, "cover all 901 rows"));
    free(text);
    free_ran(&ran);
}

/* 10,001 rows of 177 curves are too many: the page has the first ones and some of the later ones.
 */
static void late_rows_of_a_large_page_are_left_out(void **state) {
    (void)state;
    static const char *const set[] = {"simulation.duration_ms=1000",
                                      "simulation.output_step_ms=0.1"};
    Ran ran = run_set("metro-6-car.yaml", "25-km-h", 2, set);
    const CzReport run = run_of(&ran);
    char *text = NULL;
    int decimals;
    assert_int_equal(write_page(&run, &text), CZ_OK);
    assert_non_null(strstr(text, "        rear: (as front of A1)               # "));
    assert_null(strstr(text, "part bogie, part metro-car"));
    assert_true(strlen(text) <= 900000 && strlen(text) > 800000);
    const int n = read_channel(text, "t_ms", &decimals, NULL);
    double *time = malloc((size_t)n * sizeof *time);
    read_channel(text, "t_ms", &decimals, time);
    const char *said = strstr(text, "every row of channels.csv until ");
    assert_non_null(said);
    const double until = atof(said + strlen("every row of channels.csv until "));
    int i = 1;
    while (time[i] - time[i - 1] < 0.1001)
        i++;
    assert_near(time[i - 1], until, 1e-2, 0); /* reported with three digits */
    for (; i < n; i++)
        assert_true(time[i] - time[i - 1] < 1000.0 / 239 + 0.2);
    assert_near(time[n - 1], 1000, 1e-9, 0);
    compare_rows(text, ran.evaluation.run[0], n);
    free(time);
    free(text);
    free_ran(&ran);
}

/* The car ahead is the second of two and the seventh of twelve; A6 is in the longer trains only.
 */
static void curves_of_another_run_are_those_of_the_same_names(void **state) {
    (void)state;
    static const char *const set[] = {"simulation.duration_ms=5"};
    Ran two = run_set("two-cars-25kmh.yaml", NULL, 1, set);
    Ran twelve = run_set("metro-6-car.yaml", "25-km-h", 1, set);
    const CzRunSummary *own = cz_run_summary(two.evaluation.run[0]);
    const CzRunSummary *its = cz_run_summary(twelve.evaluation.run[0]);
    const CzRun *run = two.evaluation.run[0], *other = twelve.evaluation.run[0];
    assert_string_equal(own->vehicle[1].name, its->vehicle[6].name);
    assert_ptr_equal(cz_drawn_beside(own, CZ_CHANNEL_BODY_SPEED, 1, other),
                     cz_run_channel(other, CZ_CHANNEL_BODY_SPEED, 6));
    assert_ptr_equal(cz_drawn_beside(own, CZ_CHANNEL_WHEEL_LIFT, cz_wheelset_place(1, 2), other),
                     cz_run_channel(other, CZ_CHANNEL_WHEEL_LIFT, cz_wheelset_place(6, 2)));
    assert_null(cz_drawn_beside(own, CZ_CHANNEL_INTERFACE_FORCE, 0, other)); /* A1-B1 */
    assert_null(cz_drawn_beside(its, CZ_CHANNEL_BODY_SPEED, 5, run));
    free_ran(&two);
    free_ran(&twelve);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sections_are_in_order),
        cmocka_unit_test(every_lack_of_memory_is_reported),
        cmocka_unit_test(a_page_of_several_scenarios_begins_with_their_matrix),
        cmocka_unit_test(figures_that_decide_belong_to_metrics),
        cmocka_unit_test(a_run_that_was_not_kept_has_no_page),
        cmocka_unit_test(curves_of_another_run_are_those_of_the_same_names),
        cmocka_unit_test(the_cursor_shows_every_recorded_row),
        cmocka_unit_test(late_rows_of_a_large_page_are_left_out),
        cmocka_unit_test(a_sheared_coupler_carries_no_force_against_a_wall),
        cmocka_unit_test(the_input_curve_is_that_of_the_weakest_member),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
