/* The reader warns of numbers that are allowed but unusual, and of no others. */
#include "problem/read_problem.h"

#include "problem/keys.h"
#include "support/shipped.h"

/* Each range belongs to a number with that unit, and lies within the allowed range. */
static void every_usual_range_is_one_of_a_key(void **state) {
    (void)state;
    for (int r = 0; r < CZ_N_RECORD; r++)
        for (int i = 0; i < 2 * cz_records[r].n_key; i++) {
            const CzKey *key = &cz_records[r].key[i / 2];
            const CzUsual *usual = &key->usual[i % 2];
            if (usual->unit == NULL)
                continue;
            assert_int_equal(key->kind, CZ_KEY_NUMBER);
            const CzUnit *unit = cz_unit_find(key->dimension, usual->unit);
            assert_non_null(unit);
            assert_true(usual->lo < usual->hi);
            assert_true(usual->lo * unit->si >= key->lo || key->lo <= 0);
            assert_true(usual->hi * unit->si <= key->hi * (1 + 1e-12));
            if (!isnan(key->absent) && key->absent != 0) /* a default is usual */
                assert_true(fabs(key->absent) >= usual->lo * unit->si &&
                            fabs(key->absent) <= usual->hi * unit->si);
        }
}

/* Number of a problem's warnings of unusual numbers; only those with `word`. */
static int count_unusual(const CzProblem *problem, const char *word) {
    int n = 0;
    for (int i = 0; i < cz_problem_n_warning(problem); i++) {
        const char *message = cz_problem_warning(problem, i)->message;
        n += strstr(message, " is unusual: ") != NULL && strstr(message, word) != NULL;
    }
    return n;
}

static int count_with(const char *setting, const char *word) {
    CzProblem *problem = read_good("rigid.yaml", 1, &setting);
    const int n = count_unusual(problem, word);
    assert_int_equal(count_unusual(problem, ""), n);
    cz_problem_free(problem);
    return n;
}

static void common_typing_mistakes_are_warned_of(void **state) {
    (void)state;
    assert_int_equal(count_with("parts.car.mass_kg=38", "38 kg, where 1000 to 250000 kg is"), 1);
    assert_int_equal(count_with("trains.A.speed_m_s=25", "25 m/s, where 0.3 to 20 m/s is"), 1);
    assert_int_equal(count_with("parts.bumper.unloading_stiffness_kN_m=2e7",
                                "2e+07 kN/m, where 5000 to 1e+07 kN/m is"),
                     1);
    assert_int_equal(count_with("simulation.time_step_ms=0.0002", "0.0002 ms, where 0.001"), 1);
    assert_int_equal(
        count_with("parts.bumper.anti_climber.stages[0].stroke_mm=0.25", "0.25 mm, where"), 1);
}

static void usual_numbers_and_edges_are_not_warned_of(void **state) {
    (void)state;
    assert_int_equal(count_with("parts.car.mass_t=1", ""), 0);
    assert_int_equal(count_with("parts.car.mass_kg=250000", ""), 0);
    assert_int_equal(count_with("trains.A.speed_km_h=90", ""), 0); /* where km/h is typed */
    assert_int_equal(count_with("trains.B.speed_km_h=-30", ""), 0);
    assert_int_equal(count_with("trains.B.speed_km_h=0", ""), 0);
}

static void shipped_problems_have_usual_numbers(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++) {
        char path[600];
        CzProblem *problem = NULL;
        snprintf(path, sizeof path, CZ_SOURCE_FOLDER "/problems/%s", shipped.name[i]);
        assert_int_equal(cz_problem_read(path, NULL, &problem, NULL), CZ_OK);
        if (count_unusual(problem, "") > 0)
            fail_msg("%s: %s", path, cz_problem_warning(problem, 0)->message);
        cz_problem_free(problem);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_usual_range_is_one_of_a_key),
        cmocka_unit_test(common_typing_mistakes_are_warned_of),
        cmocka_unit_test(usual_numbers_and_edges_are_not_warned_of),
        cmocka_unit_test(shipped_problems_have_usual_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
