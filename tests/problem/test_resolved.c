/* The resolved problem is a problem with the same meaning to the last bit. */
#include "problem/read_problem.h"

#include "problem/keys.h"
#include "support/shipped.h"

static void check_same_texts(const CzTexts *a, const CzTexts *b) {
    assert_int_equal(a->n_text, b->n_text);
    for (int i = 0; i < a->n_text; i++)
        assert_string_equal(a->text[i], b->text[i]);
}

static void check_same_text(const char *a, const char *b) {
    assert_int_equal(a == NULL, b == NULL);
    if (a != NULL)
        assert_string_equal(a, b);
}

static void check_same_record(const CzRecord *record, const char *a, const char *b);

static void check_same_items(const CzKey *key, const char *a, const char *b) {
    const int n_item = *(const int *)(const void *)(a + key->n_offset);
    const size_t size = key->child->size;
    const char *first = a + key->offset, *second = b + key->offset;
    assert_int_equal(n_item, *(const int *)(const void *)(b + key->n_offset));
    if (key->kind == CZ_KEY_LIST || key->kind == CZ_KEY_NAMED) {
        first = *(const char *const *)(const void *)first;
        second = *(const char *const *)(const void *)second;
    }
    for (int i = 0; i < n_item; i++)
        check_same_record(key->child, first + (size_t)i * size, second + (size_t)i * size);
}

/* Compares two records value by value; design variables are written in another form and compared by
 * their places, uncertain numbers with other paths to the same places. */
static void check_same_record(const CzRecord *record, const char *a, const char *b) {
    assert_int_equal(*(const bool *)a, *(const bool *)b);
    const bool has_other_paths = record == &cz_records[CZ_RECORD_CzScatter];
    for (int i = 0; i < record->n_key; i++) {
        const CzKey *key = &record->key[i];
        const char *first = a + key->offset, *second = b + key->offset;
        if (has_other_paths && (key->kind == CZ_KEY_TEXT || strcmp(key->stem, "paths") == 0))
            continue;
        switch (key->kind) {
        case CZ_KEY_NUMBER:
            assert_memory_equal(first, second, sizeof(double));
            break;
        case CZ_KEY_COUNT:
        case CZ_KEY_CHOICE:
            assert_memory_equal(first, second, sizeof(int));
            break;
        case CZ_KEY_FLAG:
            assert_memory_equal(first, second, sizeof(bool));
            break;
        case CZ_KEY_TEXT:
            check_same_text(*(const char *const *)(const void *)first,
                            *(const char *const *)(const void *)second);
            break;
        case CZ_KEY_CHILD:
            check_same_record(key->child, first, second);
            break;
        case CZ_KEY_TABLE:
            assert_memory_equal(first, second, sizeof(CzTable));
            break;
        case CZ_KEY_TEXTS:
            check_same_texts((const CzTexts *)(const void *)first,
                             (const CzTexts *)(const void *)second);
            break;
        default:
            if (key->child != &cz_records[CZ_RECORD_CzVariable])
                check_same_items(key, a, b);
        }
    }
}

static void check_round_trip(const char *name, const char *folder) {
    CzProblem *problem = NULL, *again = NULL;
    char path[400];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_int_equal(cz_problem_read(path, NULL, &problem, NULL), CZ_OK);
    char *text = resolved_text(problem);
    const CzStatus status =
        cz_problem_read_text(text, strlen(text), "resolved.yaml", folder, NULL, &again, NULL);
    if (status != CZ_OK)
        print_mistakes(again);
    assert_int_equal(status, CZ_OK);
    check_same_record(&cz_records[CZ_RECORD_CzInput], (const char *)cz_problem_input(problem),
                      (const char *)cz_problem_input(again));
    cz_problem_free(again);
    cz_problem_free(problem);
    free(text);
}

static void reading_the_resolved_file_gives_the_same_input(void **state) {
    (void)state;
    check_round_trip("rigid.yaml", GOOD_FOLDER);
    check_round_trip("full.yaml", GOOD_FOLDER);
    check_round_trip("overlay.yaml", GOOD_FOLDER);
    check_round_trip("curves.yaml", GOOD_FOLDER);
    check_round_trip("single.yaml", GOOD_FOLDER);
}

static void shipped_problems_resolve_to_themselves(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++)
        check_round_trip(shipped.name[i], CZ_SOURCE_FOLDER "/problems");
}

static void variables_of_the_resolved_file_drive_the_same_places(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL), *again = NULL;
    char *text = resolved_text(problem);
    assert_int_equal(read_text(text, &again), CZ_OK);
    const CzOptimise *optimise = &cz_problem_input(again)->optimise;
    assert_int_equal(optimise->n_variables, 3); /* two stages of one path, and the gap */
    assert_string_equal(optimise->variables[1].name,
                        "parts.cab-end.anti_climber.stages[1].force_kN");
    assert_int_equal(optimise->variables[1].paths.n_text, 4);
    assert_string_equal(optimise->variables[1].paths.text[2],
                        "trains.B.vehicles.B1.rear.anti_climber.stages[1].force_kN");
    assert_near(optimise->variables[1].max, 1500, 0, 0);
    assert_string_equal(optimise->variables[2].name, "gap");
    cz_problem_free(again);
    cz_problem_free(problem);
    free(text);
}

static void the_origin_of_every_value_is_given_behind_it(void **state) {
    (void)state;
    static const char *const set[] = {"trains.A.speed_km_h=18"};
    CzProblem *problem = read_good("rigid.yaml", 1, set);
    char *text = resolved_text(problem);
    assert_non_null(
        strstr(text, "speed_m_s: 5                             # --set:1, speed_km_h: 18\n"));
    assert_non_null(strstr(text, "rigid.yaml:12, gap_mm: 100, part bumper, part car\n"));
    assert_non_null(strstr(text, "stiffness_N_m: 200000000         # default (ours)\n"));
    assert_non_null(strstr(text, "#   longest_s: 20                            # default\n"));
    cz_problem_free(problem);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading_the_resolved_file_gives_the_same_input),
        cmocka_unit_test(shipped_problems_resolve_to_themselves),
        cmocka_unit_test(variables_of_the_resolved_file_drive_the_same_places),
        cmocka_unit_test(the_origin_of_every_value_is_given_behind_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
