/* The inventory of parts: kinds, forces, strokes and energies in closed form. */
#include "support/check.h"

#include <stdbool.h>
#include <unistd.h>

#include "crushzone/parts.h"

static const char text[] =
    "schema: 1\n"
    "parts:\n"
    "  plain-buffer: {preload_kN: 20, stages: [{stroke_mm: 50, force_kN: 400}]}\n"
    "  rising-tube: {count: 2, trigger_kN: 600, trigger_length_mm: 10, stages: [{stroke_mm: 100, "
    "force_kN: 400, "
    "end_force_kN: 500}]}\n"
    "  used-as-buffer: {stages: [{stroke_mm: 100, force_kN: 400}]}\n"
    "  chain: {buffer: {use: used-as-buffer}, tube: {use: rising-tube}, "
    "shear_off: {force_kN: 1500, retraction_space_mm: 900}}\n"
    "  front: {face_gap_mm: 500, stages: [{stroke_mm: 100, force_kN: 1000}, {stroke_mm: 300, "
    "force_kN: 4000, zone: "
    "survival}], unloading_stiffness_MN_m: 100, coupler: {use: chain}}\n"
    "  car: {model: rigid, mass_t: 40, length_m: 20, front: {use: front}}\n"
    "  half-a-car: {model: rigid, length_m: 20}\n"
    "  riddle: {what: 1}\n";

static CzInventory *inventory;

static int read_parts(void **state) {
    (void)state;
    char path[] = "/tmp/inventory-XXXXXX";
    const int file = mkstemp(path);
    CzError error = {0};
    assert_true(file >= 0 && write(file, text, sizeof text - 1) == (ssize_t)(sizeof text - 1));
    close(file);
    const CzStatus status = cz_inventory_read(path, NULL, &inventory, &error);
    unlink(path);
    if (status != CZ_OK)
        print_error("%s\n", error.message);
    return status == CZ_OK ? 0 : -1;
}

static int free_parts(void **state) {
    (void)state;
    cz_inventory_free(inventory);
    return 0;
}

static const CzPartInfo *part(const char *name) {
    for (int i = 0; i < cz_inventory_n_part(inventory); i++)
        if (strcmp(cz_inventory_part(inventory, i)->name, name) == 0)
            return cz_inventory_part(inventory, i);
    fail_msg("no part '%s'", name);
    return NULL;
}

static void has(const char *name, const char *kind, double from, double to, double stroke,
                double energy) {
    const CzPartInfo *found = part(name);
    assert_string_equal(found->kind, kind);
    assert_near(found->force_from, from, ROUNDING_OF_A_FORMULA, 0);
    assert_near(found->force_to, to, ROUNDING_OF_A_FORMULA, 0);
    assert_near(found->stroke, stroke, ROUNDING_OF_A_FORMULA, 0);
    assert_near(found->energy, energy, ROUNDING_OF_A_FORMULA, 0);
}

static void a_device_has_the_energy_of_its_closed_form(void **state) {
    (void)state;
    has("plain-buffer", "buffer", 400e3, 400e3, 0.05, 0.05 * 210e3);
    has("rising-tube", "tube", 800e3, 1200e3, 0.1, 2 * (0.1 * 450e3 + 200e3 * 0.01 / 2));
}

static void a_part_is_what_its_key_says(void **state) {
    (void)state;
    has("used-as-buffer", "buffer", 400e3, 400e3, 0.1, 20e3);
}

static void devices_in_series_add_up(void **state) {
    (void)state;
    has("chain", "coupler", 400e3, 1500e3, 0.2, 20e3 + 92e3);
}

static void an_end_counts_up_to_its_survival_space(void **state) {
    (void)state;
    has("front", "end", 400e3, 1500e3, 0.2, 112e3 + 50e3);
}

static void a_vehicle_has_mass_and_length(void **state) {
    (void)state;
    has("car", "vehicle", 400e3, 1500e3, 0.2, 162e3);
    assert_near(part("car")->mass, 40e3, ROUNDING_OF_A_FORMULA, 0);
    assert_near(part("car")->length, 20, ROUNDING_OF_A_FORMULA, 0);
}

static void a_part_that_lacks_keys_has_a_kind(void **state) {
    (void)state;
    assert_string_equal(part("half-a-car")->kind, "vehicle");
    assert_null(part("riddle")->kind);
}

static void a_problem_lists_the_parts_that_it_uses(void **state) {
    (void)state;
    CzInventory *used = NULL;
    CzError error = {0};
    assert_int_equal(cz_inventory_read("problems/metro-6-car.yaml", NULL, &used, &error), CZ_OK);
    bool has_tube = false, has_wagon = false;
    for (int i = 0; i < cz_inventory_n_part(used); i++) {
        has_tube |= strcmp(cz_inventory_part(used, i)->name, "head-tube") == 0;
        has_wagon |= strcmp(cz_inventory_part(used, i)->name, "wagon-80t") == 0;
    }
    assert_true(has_tube);
    assert_false(has_wagon);
    cz_inventory_free(used);
}

static void a_file_that_cannot_be_read_is_refused(void **state) {
    (void)state;
    CzInventory *none = NULL;
    CzError error = {0};
    assert_int_equal(cz_inventory_read("problems/nothing.yaml", NULL, &none, &error),
                     CZ_STATUS_INPUT);
    assert_null(none);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_device_has_the_energy_of_its_closed_form),
        cmocka_unit_test(a_part_is_what_its_key_says),
        cmocka_unit_test(devices_in_series_add_up),
        cmocka_unit_test(an_end_counts_up_to_its_survival_space),
        cmocka_unit_test(a_vehicle_has_mass_and_length),
        cmocka_unit_test(a_part_that_lacks_keys_has_a_kind),
        cmocka_unit_test(a_problem_lists_the_parts_that_it_uses),
        cmocka_unit_test(a_file_that_cannot_be_read_is_refused),
    };
    return cmocka_run_group_tests(tests, read_parts, free_parts);
}
