/* Large files: the reading time grows linearly with the size, and a file that would grow without
 * bounds is refused. */
#include "problem/read_problem.h"

#include <stdarg.h>
#include <time.h>

static const char vehicle[] =
    "{model: rigid, mass_t: 40, front: {coupler: {buffer: {stages: [{stroke_mm: 50, force_kN: "
    "400}]}}}, rear: {coupler: {buffer: {stages: [{stroke_mm: 50, force_kN: 400}]}}}}";

/* A text that grows. */
typedef struct {
    char *text;
    size_t n, room;
} Text;

__attribute__((format(printf, 2, 3))) static void add(Text *text, const char *format, ...) {
    va_list arguments;
    if (text->n + 1024 > text->room) {
        text->room = 2 * text->room + 4096;
        text->text = realloc(text->text, text->room);
        assert_non_null(text->text);
    }
    va_start(arguments, format);
    text->n += (size_t)vsnprintf(text->text + text->n, 1024, format, arguments);
    va_end(arguments);
}

static void add_trains(Text *text, int n_vehicle) {
    add(text, "schema: 1\ntitle: large\ntrains:\n- name: A\n  speed_km_h: 10\n  vehicles:\n");
    for (int i = 0; i < n_vehicle; i++)
        add(text, "  - %s\n", vehicle);
    add(text, "- name: B\n  vehicles:\n  - %s\n", vehicle);
}

typedef enum { VEHICLES, LIMITS, SCENARIOS, PARTS, MISTAKES, N_KIND } Kind;

/* A file whose size grows with n. */
static void write_file(Text *text, Kind kind, int n) {
    text->n = 0;
    add_trains(text, kind == VEHICLES ? n / 4 : 1);
    if (kind == LIMITS)
        add(text, "checks:\n  limits:\n");
    else if (kind == SCENARIOS)
        add(text, "scenarios:\n");
    else if (kind == PARTS)
        add(text, "parts:\n  p0: {face_gap_mm: 1}\n");
    else if (kind == MISTAKES)
        add(text, "optimise:\n  variables:\n");
    for (int i = 1; i < n; i++) {
        if (kind == LIMITS)
            add(text, "  - {name: l%d, metric: interfaces.peak_force_kN, max: 10}\n", i);
        else if (kind == SCENARIOS)
            add(text, "- {name: s%d}\n", i);
        else if (kind == PARTS && i < 1900)
            add(text, "  p%d: {front: {use: p%d}, rear: {use: p%d}}\n", i, i % 30 > 0 ? i - 1 : 0,
                i % 30 > 0 ? i - 1 : 0);
        else if (kind == MISTAKES)
            add(text, "  - {nam: x}\n");
    }
}

/* Processor time of a read [s], the best of three. */
static double time_of(const Text *text) {
    double best = INFINITY;
    for (int i = 0; i < 3; i++) {
        CzProblem *problem = NULL;
        const clock_t start = clock();
        (void)!cz_problem_read_text(text->text, text->n, "large.yaml", GOOD_FOLDER, NULL, &problem,
                                    NULL);
        best = fmin(best, (double)(clock() - start) / CLOCKS_PER_SEC);
        cz_problem_free(problem);
    }
    return best;
}

/* Ten times the size may take 25 times the time, where the caches overflow; quadratic growth would
 * be a hundred times. Times below two milliseconds are too short to compare. */
static void reading_time_grows_linearly_with_the_size(void **state) {
    (void)state;
    Text text = {0};
    for (Kind kind = 0; kind < N_KIND; kind++) {
        write_file(&text, kind, 300);
        const double small = time_of(&text);
        write_file(&text, kind, 3000);
        const double large = time_of(&text);
        printf("kind %d: %.4f s, %.4f s\n", (int)kind, small, large);
        assert_true(large <= 25 * fmax(small, 0.002));
    }
    free(text.text);
}

/* All messages about a file as one text. */
static void tell(const Text *text, char *told, size_t room) {
    CzProblem *problem = NULL;
    told[0] = '\0';
    (void)!cz_problem_read_text(text->text, text->n, "large.yaml", GOOD_FOLDER, NULL, &problem,
                                NULL);
    for (int i = 0; i < cz_problem_n_mistake(problem); i++)
        snprintf(told + strlen(told), room - strlen(told), "%s\n",
                 cz_problem_mistake(problem, i)->message);
    cz_problem_free(problem);
}

/* The number of branches doubles with every step of a search without a memory. */
static void parts_that_use_one_another_in_branching_circles_are_refused_at_once(void **state) {
    (void)state;
    char told[4096];
    Text text = {0};
    add_trains(&text, 1);
    add(&text, "set: {parts.a.mass_kg: 1}\nparts:\n  a: {front: {use: b}, rear: {use: b}}\n"
               "  b: {front: {use: a}, rear: {use: b}}\n");
    tell(&text, told, sizeof told);
    assert_non_null(strstr(told, "part 'a' uses itself"));
    assert_non_null(strstr(told, "part 'b' uses itself"));
    free(text.text);
}

static void chains_of_parts_that_are_too_long_are_refused(void **state) {
    (void)state;
    char told[4096];
    Text text = {0};
    add_trains(&text, 1);
    add(&text, "parts:\n  p0: {mass_kg: 1}\n");
    for (int i = 1; i < 60; i++)
        add(&text, "  p%d: {use: p%d}\n", i, i - 1);
    tell(&text, told, sizeof told);
    assert_non_null(strstr(told, "more than 40 parts use one another in a chain"));
    text.n = 0;
    add_trains(&text, 1);
    add(&text, "parts:\n");
    for (int i = 1; i < 60; i++)
        add(&text, "  p%d: {use: p%d}\n", i, i + 1);
    add(&text, "  p60: {mass_kg: 1}\n");
    tell(&text, told, sizeof told);
    assert_non_null(strstr(told, "more than 40 parts use one another in a chain"));
    free(text.text);
}

static void too_many_scenarios_are_refused(void **state) {
    (void)state;
    char told[4096];
    Text text = {0};
    add_trains(&text, 1);
    add(&text, "scenarios:\n");
    for (int i = 0; i < 1000; i++)
        add(&text, "- {name: s%d, sweep: {speed_km_h: 10:20:500}}\n", i);
    tell(&text, told, sizeof told);
    assert_non_null(strstr(told, "more than 10000 scenarios"));
    free(text.text);
}

/* Every setting creates a new mapping on the path to each place. */
static void too_many_settings_are_refused(void **state) {
    (void)state;
    char told[8192];
    Text text = {0};
    add_trains(&text, 500);
    add(&text, "set:\n");
    for (int i = 0; i < 500; i++)
        add(&text, "  trains.A.vehicles[*].front.coupler.key%d: 1\n", i);
    tell(&text, told, sizeof told);
    assert_non_null(strstr(told, "the settings change more than 20000 values"));
    free(text.text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading_time_grows_linearly_with_the_size),
        cmocka_unit_test(parts_that_use_one_another_in_branching_circles_are_refused_at_once),
        cmocka_unit_test(chains_of_parts_that_are_too_long_are_refused),
        cmocka_unit_test(too_many_settings_are_refused),
        cmocka_unit_test(too_many_scenarios_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
