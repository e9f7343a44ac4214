/* Measured curves: reading and reducing. */
#include "problem/read_problem.h"

#include "problem/reduce_curve.h"
#include "text/node.h"

#include <unistd.h>

static double area(const double *x, const double *y, int n_point) {
    double sum = 0;
    for (int i = 1; i < n_point; i++)
        sum += 0.5 * (y[i] + y[i - 1]) * (x[i] - x[i - 1]);
    return sum;
}

static void points_in_the_file_are_read_in_their_units(void **state) {
    (void)state;
    CzProblem *problem = read_good("curves.yaml", 0, NULL);
    const CzTable *curve = &find_vehicle(problem, "A1")->front.curve;
    assert_true(curve->given);
    assert_int_equal(curve->n_point, 3);
    assert_int_equal(curve->basis, CZ_BASIS_STATIC);
    assert_near(curve->x[2], 0.45, ROUNDING_OF_A_VALUE, 0);
    assert_near(curve->y[1], 1e6, 0, 0);
    cz_problem_free(problem);
}

static void a_long_csv_curve_keeps_energy_ends_and_peak(void **state) {
    (void)state;
    CzProblem *problem = read_good("curves.yaml", 0, NULL);
    const CzTable *curve = &find_vehicle(problem, "A1")->front.anti_climber.curve;
    assert_int_equal(curve->n_point, CZ_MAX_CURVE_POINTS);
    assert_int_equal(curve->basis, CZ_BASIS_DYNAMIC);
    assert_near(curve->x[0], 0, 0, 0);
    assert_near(curve->x[curve->n_point - 1], 0.4, ROUNDING_OF_A_VALUE, 0);
    double peak = 0;
    for (int i = 0; i < curve->n_point; i++)
        peak = fmax(peak, curve->y[i]);
    assert_near(peak, 1436.393e3, 1e-12, 0); /* the highest number of absorber.csv */
    assert_near(area(curve->x, curve->y, curve->n_point), 370456.1125, 1e-6,
                0); /* trapezes of absorber.csv */
    assert_int_equal(cz_problem_n_warning(problem), OWN_WARNINGS + 1);
    const char *warning = cz_problem_warning(problem, 0)->message;
    assert_non_null(strstr(warning, "'curve' was reduced from 401 to 64 points: energy "));
    cz_problem_free(problem);
}

static void reducing_keeps_the_area(void **state) {
    (void)state;
    enum { N = 1000 };
    static double x[N], y[N];
    int n_point = N;
    for (int i = 0; i < N; i++) {
        x[i] = i * 1e-3 + (i % 3) * 1e-4;
        y[i] = 1e6 + 1e5 * ((i * 7919) % 101) / 101.0 + (i == 40 ? 5e5 : 0);
    }
    const double before = area(x, y, N);
    CzArena arena = {0};
    CzCurveChange change;
    assert_true(cz_reduce_curve(&arena, x, y, &n_point, 64, &change));
    cz_arena_free(&arena);
    assert_int_equal(n_point, 64);
    assert_near(change.area, before, ROUNDING_OF_A_FORMULA, 0);
    assert_near(area(x, y, n_point), before, ROUNDING_OF_A_SUM, 0);
    assert_in_range((int)change.largest_difference, 1, 150000);
}

static void a_straight_line_loses_nothing(void **state) {
    (void)state;
    double x[100], y[100];
    int n_point = 100;
    for (int i = 0; i < 100; i++) {
        x[i] = i;
        y[i] = 2 * i + 1;
    }
    CzArena arena = {0};
    CzCurveChange change;
    assert_true(cz_reduce_curve(&arena, x, y, &n_point, 3, &change));
    cz_arena_free(&arena);
    assert_int_equal(n_point, 3);
    assert_near(change.largest_difference, 0, 0, ROUNDING_OF_A_SUM);
    assert_near(y[2], 199, 0, 0);
}

static void a_short_curve_stays_as_it_is(void **state) {
    (void)state;
    double x[] = {0, 1, 2}, y[] = {0, 5, 1};
    int n_point = 3;
    CzArena arena = {0};
    CzCurveChange change;
    assert_true(cz_reduce_curve(&arena, x, y, &n_point, 64, &change));
    cz_arena_free(&arena);
    assert_int_equal(n_point, 3);
    assert_near(y[1], 5, 0, 0);
}

/* A tube's elastic part F / k is subtracted from total strokes: the same law as of plastic strokes.
 */
static void total_strokes_lose_their_elastic_part(void **state) {
    static const char *const text[] = {
        "extends: rigid.yaml\n"
        "parts: {bumper: {anti_climber: {stages: null, stiffness_MN_m: 100, curve: {columns: "
        "[stroke_mm, force_kN], points: [[0, 0], [4, 400], [5, 500], [106, 600]], basis: static, "
        "strokes: total}}}}\noptimise: null\n",
        "extends: rigid.yaml\n"
        "parts: {bumper: {anti_climber: {stages: null, stiffness_MN_m: 100, curve: {columns: "
        "[stroke_mm, force_kN], points: [[0, 500], [100, 600]], basis: static, strokes: "
        "plastic}}}}\noptimise: null\n"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        CzProblem *problem = NULL;
        assert_int_equal(read_text(text[i], &problem), CZ_OK);
        const CzTable *curve = &find_vehicle(problem, "A1")->front.anti_climber.curve;
        assert_int_equal(curve->strokes, CZ_STROKES_PLASTIC);
        assert_int_equal(curve->n_point, 2);
        assert_near(curve->x[0], 0, 0, 0);
        assert_near(curve->y[0], 5e5, 1e-12, 0);
        assert_near(curve->x[1], 0.1, 1e-12, 0);
        assert_near(curve->y[1], 6e5, 1e-12, 0);
        assert_int_equal(cz_problem_n_warning(problem), OWN_WARNINGS);
        cz_problem_free(problem);
    }
}

/* A test begins a little before the contact: the rise behind it is elastic all the same, and a
 * second one behind a drop, too. Points of one stroke are 2e-6 of the stroke apart. */
static void an_elastic_rise_is_taken_off_wherever_it_begins(void **state) {
    static const char text[] =
        "extends: rigid.yaml\n"
        "parts: {bumper: {anti_climber: {stages: null, stiffness_MN_m: 100, curve: {columns: "
        "[stroke_mm, force_kN], points: [[0, 0], [1, 0], [5, 400], [6, 500], [55, 400], [57, 600], "
        "[107, 600]], basis: static, strokes: total}}}}\noptimise: null\n";
    static const double x[] = {0, 0.001, 0.001, 0.051, 0.051, 0.101},
                        y[] = {0, 0, 5e5, 4e5, 6e5, 6e5};
    CzProblem *problem = NULL;
    (void)state;
    assert_int_equal(read_text(text, &problem), CZ_OK);
    const CzTable *curve = &find_vehicle(problem, "A1")->front.anti_climber.curve;
    assert_int_equal(curve->n_point, 6);
    for (int i = 0; i < 6; i++) {
        assert_near(curve->x[i], x[i], 0, 3e-6 * 0.107);
        assert_near(curve->y[i], y[i], 1e-12, 0);
        assert_true(i == 0 || curve->x[i] > curve->x[i - 1]);
    }
    cz_problem_free(problem);
}

/* A densification of 500 MN/m behind an elasticity of 100 MN/m: 2500 kN are reached after 25 mm,
 * not 5. */
static void a_law_that_cannot_follow_its_curve_is_warned_of(void **state) {
    static const char text[] =
        "extends: rigid.yaml\n"
        "parts: {bumper: {anti_climber: {stages: null, stiffness_MN_m: 100, curve: {columns: "
        "[stroke_mm, force_kN], points: [[0, 0], [5, 500], [105, 500], [110, 3000]], basis: "
        "static, strokes: total}}}}\noptimise: null\n";
    (void)state;
    CzProblem *problem = NULL;
    assert_int_equal(read_text(text, &problem), CZ_OK);
    assert_int_equal(cz_problem_n_warning(problem), OWN_WARNINGS + 1);
    assert_non_null(strstr(cz_problem_warning(problem, 0)->message,
                           "'curve' rises more steeply than its law can follow with a stiffness of "
                           "100 MN/m: the law is up to 20 mm behind it"));
    cz_problem_free(problem);
}

/* The keys beside a file, against the same curve given by points. */
static void keys_beside_a_file_shape_its_curve(void **state) {
    static const char content[] = "a test\nTime;Weg;Kraft A;Kraft B\ns;mm;N;N\n"
                                  "0;-120,5;0;9\n1;-125,5;-1.000.000;9\n2;-525,5;-2.400.000;9\n"
                                  "3;-620,5;-3.000.000;9\n4;-600;-100;9\n";
    char path[] = "/tmp/crushzone-curve-XXXXXX", text[600];
    const int descriptor = mkstemp(path);
    (void)state;
    assert_true(descriptor >= 0);
    assert_int_equal(write(descriptor, content, sizeof content - 1), sizeof content - 1);
    close(descriptor);
    snprintf(text, sizeof text,
             "extends: rigid.yaml\nparts: {bumper: {anti_climber: {stages: null, curve: {file: %s, "
             "columns: [Weg, Kraft A], basis: static, strokes: plastic, scale: 0.5, flip: both, "
             "zero_mm: 120.5, to_mm: 525.5}}}}\noptimise: null\n",
             path);
    CzProblem *problem = NULL;
    assert_int_equal(read_text(text, &problem), CZ_OK);
    const CzTable *curve = &find_vehicle(problem, "A1")->front.anti_climber.curve;
    assert_int_equal(curve->n_point, 3);
    const double x[] = {0, 0.005, 0.405}, y[] = {0, 5e5, 1.2e6};
    for (int i = 0; i < 3; i++) {
        assert_near(curve->x[i], x[i], 1e-12, 1e-15);
        assert_near(curve->y[i], y[i], 1e-12, 0);
    }
    cz_problem_free(problem);
    unlink(path);
}

/* An end's law is over the total shortening: c F with c = (1 - r) / Ku1 + r / Ku2 is added. */
static void plastic_strokes_of_an_end_get_their_elastic_part(void **state) {
    (void)state;
    CzProblem *problem = NULL;
    assert_int_equal(
        read_text("extends: rigid.yaml\n"
                  "parts: {bumper: {stages: null, unloading_stiffness_MN_m: 200, "
                  "unloading_share: 0.25, second_unloading_stiffness_MN_m: 100, "
                  "curve: {columns: [stroke_mm, force_kN], points: [[0, 0], [50, 1000], "
                  "[450, 2000]], basis: static, strokes: plastic}}}\noptimise: null\n",
                  &problem),
        CZ_OK);
    const CzTable *curve = &find_vehicle(problem, "A1")->front.curve;
    const double compliance = 0.75 / 200e6 + 0.25 / 100e6;
    assert_near(curve->x[1], 0.05 + 1e6 * compliance, 1e-12, 0);
    assert_near(curve->x[2], 0.45 + 2e6 * compliance, 1e-12, 0);
    cz_problem_free(problem);
}

/* How many of the files that were read have this name. */
static int count_sources(const CzProblem *problem, const char *name) {
    int n = 0;
    for (const CzSource *source = cz_problem_first_source(problem); source != NULL;
         source = source->next)
        n += strcmp(source->name, name) == 0;
    return n;
}

static void a_curve_file_of_a_part_is_read_once_and_not_again(void **state) {
    (void)state;
    char path[] = "/tmp/crushzone-curve-XXXXXX", text[1000];
    static const char curve[] = "stroke_mm,force_kN\n0,500\n200,600\n";
    const int file = mkstemp(path);
    assert_true(file >= 0);
    assert_int_equal(write(file, curve, sizeof curve - 1), (int)sizeof curve - 1);
    close(file);
    snprintf(
        text, sizeof text,
        "schema: 1\ntitle: a curve of a part\n"
        "parts:\n"
        "  tube: {curve: {file: %s, basis: dynamic, strokes: plastic}}\n"
        "  end: {face_gap_mm: 900, unloading_stiffness_MN_m: 600,\n"
        "    coupler: {buffer: {stages: [{stroke_mm: 50, force_kN: 400}]}, tube: {use: tube}}}\n"
        "  car: {model: rigid, mass_t: 40, front: {use: end}, rear: {use: end}}\n"
        "trains:\n"
        "  - {name: A, speed_m_s: 5, vehicles: [{use: car}]}\n"
        "  - {name: B, vehicles: [{use: car}]}\n",
        path);
    CzProblem *problem = read_good_text(text), *again = NULL;
    assert_int_equal(count_sources(problem, path), 1);
    unlink(path);

    const char *const set[] = {"parts.tube.trigger_kN"}, *const value[] = {"700"};
    CzTargets found = {0};
    int n_vehicle = 0;
    assert_int_equal(cz_problem_find(problem, "parts.car.mass_t", &found, NULL), CZ_OK);
    assert_int_equal(found.n, 2);
    assert_int_equal(cz_problem_read_again(problem, 1, set, value, &again, NULL), CZ_OK);
    const CzVehicle *vehicle = cz_problem_vehicles(again, &n_vehicle);
    for (int i = 0; i < 2; i++) {
        const CzTube *tubes[] = {&vehicle[i].front.coupler.tube, &vehicle[i].rear.coupler.tube};
        for (int k = 0; k < 2; k++) {
            assert_near(tubes[k]->trigger, 700e3, 0, 0);
            assert_int_equal(tubes[k]->curve.n_point, 2);
            assert_near(tubes[k]->curve.y[1], 600e3, 0, 0);
        }
    }
    free(found.target);
    cz_problem_free(again);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_in_the_file_are_read_in_their_units),
        cmocka_unit_test(a_long_csv_curve_keeps_energy_ends_and_peak),
        cmocka_unit_test(total_strokes_lose_their_elastic_part),
        cmocka_unit_test(an_elastic_rise_is_taken_off_wherever_it_begins),
        cmocka_unit_test(a_law_that_cannot_follow_its_curve_is_warned_of),
        cmocka_unit_test(keys_beside_a_file_shape_its_curve),
        cmocka_unit_test(a_curve_file_of_a_part_is_read_once_and_not_again),
        cmocka_unit_test(plastic_strokes_of_an_end_get_their_elastic_part),
        cmocka_unit_test(reducing_keeps_the_area),
        cmocka_unit_test(a_straight_line_loses_nothing),
        cmocka_unit_test(a_short_curve_stays_as_it_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
