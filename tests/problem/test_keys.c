/* The tables of keys and the documents written from them. */
#include "problem/read_problem.h"

#include <jansson.h>

#include "problem/keys.h"

static char *capture(void (*write)(FILE *stream)) {
    char *text = NULL;
    size_t n_byte = 0;
    FILE *stream = open_memstream(&text, &n_byte);
    assert_non_null(stream);
    write(stream);
    fclose(stream);
    return text;
}

static void every_key_is_found_by_each_of_its_spellings(void **state) {
    (void)state;
    char typed[100];
    for (int r = 0; r < CZ_N_RECORD; r++)
        for (int k = 0; k < cz_records[r].n_key; k++) {
            const CzKey *key = &cz_records[r].key[k];
            for (int u = 0; u < cz_n_unit; u++) {
                const CzUnit *unit = NULL;
                if (cz_units[u].dimension != key->dimension)
                    continue;
                snprintf(typed, sizeof typed, "%s%s%s", key->stem,
                         cz_units[u].suffix[0] != '\0' ? "_" : "", cz_units[u].suffix);
                if (key->kind == CZ_KEY_TABLE)
                    snprintf(typed, sizeof typed, "%s", key->stem);
                assert_ptr_equal(cz_record_match(&cz_records[r], typed, &unit), key);
                if (key->kind == CZ_KEY_NUMBER)
                    assert_ptr_equal(unit, &cz_units[u]);
            }
        }
}

static void defaults_lie_within_their_ranges(void **state) {
    (void)state;
    for (int r = 0; r < CZ_N_RECORD; r++)
        for (int k = 0; k < cz_records[r].n_key; k++) {
            const CzKey *key = &cz_records[r].key[k];
            if (key->kind != CZ_KEY_NUMBER && key->kind != CZ_KEY_COUNT)
                continue;
            assert_true(key->lo < key->hi || key->lo == key->hi);
            if (key->presence == CZ_PRESENCE_DEFAULT)
                assert_true(key->absent >= key->lo && key->absent <= key->hi);
        }
}

static void units_have_their_si_values(void **state) {
    (void)state;
    static const struct {
        CzDimension dimension;
        const char *suffix;
        double si;
    } known[] = {
        {CZ_DIMENSION_LENGTH, "mm", 1e-3},
        {CZ_DIMENSION_FORCE, "MN", 1e6},
        {CZ_DIMENSION_MASS, "t", 1e3},
        {CZ_DIMENSION_SPEED, "km_h", 1000.0 / 3600},
        {CZ_DIMENSION_ENERGY, "kJ", 1e3},
        {CZ_DIMENSION_ACCELERATION, "g", 9.80665},
        {CZ_DIMENSION_TIME, "ms", 1e-3},
        {CZ_DIMENSION_STIFFNESS, "kN_mm", 1e6},
        {CZ_DIMENSION_DAMPING, "kN_s_m", 1e3},
        {CZ_DIMENSION_QUADRATIC_DAMPING, "kN_s2_m2", 1e3},
        {CZ_DIMENSION_TORSION, "MNm_rad", 1e6},
        {CZ_DIMENSION_TORSION_DAMPING, "kNms_rad", 1e3},
        {CZ_DIMENSION_MOMENT, "kNm", 1e3},
        {CZ_DIMENSION_INERTIA, "t_m2", 1e3},
        {CZ_DIMENSION_ANGLE, "deg", 3.14159265358979323846 / 180},
        {CZ_DIMENSION_MASS_PER_LENGTH, "kg_m", 1},
        {CZ_DIMENSION_RATE_FACTOR, "s_m", 1},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const CzUnit *unit = cz_unit_find(known[i].dimension, known[i].suffix);
        assert_non_null(unit);
        assert_near(unit->si, known[i].si, ROUNDING_OF_A_VALUE, 0);
        assert_near(cz_unit_si(known[i].dimension)->si, 1, 0, 0);
    }
    assert_null(cz_unit_find(CZ_DIMENSION_LENGTH, "kN"));
}

static void stems_are_the_part_before_the_unit(void **state) {
    (void)state;
    assert_int_equal(cz_key_stem_length("stroke_mm"), 6);
    assert_int_equal(cz_key_stem_length("damping_kN_s_m"), 7);
    assert_int_equal(cz_key_stem_length("mass_per_stroke_kg_m"), 15);
    assert_int_equal(cz_key_stem_length("rate_factor_s_m"), 11);
    assert_int_equal(cz_key_stem_length("friction"), 8);
    assert_true(cz_key_same_stem("force_kN", "force_MN"));
    assert_true(cz_key_same_stem("stages", "stages"));
    assert_false(cz_key_same_stem("force", "force_MN"));
    assert_false(cz_key_same_stem("force_kN", "end_force_kN"));
}

static void the_schema_is_json_and_contains_every_spelling(void **state) {
    (void)state;
    char *text = capture(cz_keys_write_schema);
    json_error_t error;
    json_t *schema = json_loads(text, JSON_REJECT_DUPLICATES, &error);
    assert_non_null(schema);
    const json_t *definitions = json_object_get(schema, "definitions");
    assert_int_equal(json_object_size(definitions), CZ_N_RECORD);
    for (int r = 0; r < CZ_N_RECORD; r++) {
        const json_t *record = json_object_get(definitions, cz_records[r].name);
        const json_t *properties = json_object_get(record, "properties");
        assert_true(json_is_false(json_object_get(record, "additionalProperties")));
        assert_non_null(json_object_get(properties, "use"));
        for (int k = 0; k < cz_records[r].n_key; k++) {
            const CzKey *key = &cz_records[r].key[k];
            for (int u = 0; u < cz_n_unit && key->kind == CZ_KEY_NUMBER; u++) {
                char typed[100];
                if (cz_units[u].dimension != key->dimension)
                    continue;
                snprintf(typed, sizeof typed, "%s%s%s", key->stem,
                         cz_units[u].suffix[0] != '\0' ? "_" : "", cz_units[u].suffix);
                assert_non_null(json_object_get(properties, typed));
            }
            if (key->kind != CZ_KEY_NUMBER)
                assert_non_null(json_object_get(properties, key->stem));
        }
    }
    json_decref(schema);
    free(text);
}

static void help_and_reference_name_every_key(void **state) {
    (void)state;
    char *help = capture(cz_keys_write_help), *reference = capture(cz_keys_write_reference);
    for (int r = 0; r < CZ_N_RECORD; r++)
        for (int k = 0; k < cz_records[r].n_key; k++) {
            assert_non_null(strstr(help, cz_records[r].key[k].stem));
            assert_non_null(strstr(help, cz_records[r].key[k].doc));
            assert_non_null(strstr(reference, cz_records[r].key[k].doc));
        }
    for (int i = 0; i < cz_n_reuse_key; i++)
        assert_non_null(strstr(reference, cz_reuse_keys[i].doc));
    free(help);
    free(reference);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_key_is_found_by_each_of_its_spellings),
        cmocka_unit_test(defaults_lie_within_their_ranges),
        cmocka_unit_test(units_have_their_si_values),
        cmocka_unit_test(stems_are_the_part_before_the_unit),
        cmocka_unit_test(the_schema_is_json_and_contains_every_spelling),
        cmocka_unit_test(help_and_reference_name_every_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
