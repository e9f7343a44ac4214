/* Laws that decide on climbing: ribs, and the superstructure behind the faces. */
#include "support/check.h"

#include <stdbool.h>

#include "drive.h"
#include "laws/ribs.h"
#include "laws/superstructure.h"

/* Four ribs of 50 mm pitch and 64 kN, 30 mm deep, 200 mm faces, friction 0.2. */
static const CzRibsLaw ribs = {0.05, 0.2, 0.03, 4 * 64e3, 0.2};

static double capacity_at(double slip) {
    return cz_ribs(&ribs, slip, 0.1, 1e5, 0.0).capacity;
}

/* Two ribs of four are engaged at an offset of two pitches. */
static void capacity_is_engaged_ribs_and_friction(void **state) {
    (void)state;
    assert_near(capacity_at(0.0), 4 * 64e3 + 0.2e5, 1e-14, 0.0);
    assert_near(capacity_at(0.05), 3 * 64e3 + 0.2e5, 1e-14, 0.0);
    assert_near(capacity_at(-0.1), 2 * 64e3 + 0.2e5, 1e-14, 0.0);
    assert_near(capacity_at(0.2), 0.2e5, 1e-14, 0.0);
    assert_near(capacity_at(-0.3), 0.2e5, 1e-14, 0.0);
}

/* The offset modulo the pitch decides: flank to flank within a quarter, tip to tip at a half. */
static void ribs_mesh_by_the_offset_modulo_the_pitch(void **state) {
    (void)state;
    for (int pitches = -3; pitches <= 3; pitches++) {
        const double valley = 0.05 * pitches;
        assert_near(cz_ribs(&ribs, valley + 0.012, 0.1, 1e5, 0.0).mesh, 1.0, 0.0, 0.0);
        assert_near(cz_ribs(&ribs, valley - 0.012, 0.1, 1e5, 0.0).mesh, 1.0, 0.0, 0.0);
        assert_near(cz_ribs(&ribs, valley + 0.01875, 0.1, 1e5, 0.0).mesh, 0.5, 0.0, 1e-12);
        assert_near(cz_ribs(&ribs, valley + 0.025, 0.1, 1e5, 0.0).mesh, 0.0, 0.0, 1e-12);
    }
    /* 40 mm is 10 mm from a valley: the offset of EN 15227 locks as in the valley. */
    assert_near(cz_ribs(&ribs, 0.04, 0.1, 1e5, 0.0).mesh, 1.0, 0.0, 0.0);
}

static void ribs_engage_over_their_depth(void **state) {
    (void)state;
    assert_near(cz_ribs(&ribs, 0.0, 0.0, 1e5, 0.0).capacity, 0.2e5, ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(cz_ribs(&ribs, 0.0, 0.015, 1e5, 0.0).capacity, 0.5 * 256e3 + 0.2e5,
                ROUNDING_OF_A_FORMULA, 0.0);
    assert_near(cz_ribs(&ribs, 0.0, 0.1, 0.5 * CZ_GRIP_FORCE, 0.0).engaged, 0.5,
                ROUNDING_OF_A_FORMULA, 0.0);
}

/* The residual capacity is that at full depth: the same above depth and force of full engagement,
 * and for faces that just touch that of the ribs and of the friction at the smallest force. */
static void residual_capacity_does_not_depend_on_the_first_touch(void **state) {
    (void)state;
    const CzRibsResponse deep = cz_ribs(&ribs, 0.01, 0.1, 5e5, 0.01);
    assert_near(deep.ready, deep.capacity, 1e-14, 0.0);
    const CzRibsResponse touch = cz_ribs(&ribs, 0.01, 1e-9, 1.0, 0.01);
    assert_true(touch.capacity < 1.0);
    assert_near(touch.ready, cz_ribs(&ribs, 0.01, 0.1, CZ_READY_FORCE, 0.01).capacity, 1e-14, 0.0);
    assert_near(cz_ribs(&ribs, 0.025, 1e-9, 1.0, 0.0).ready, 0.2 * CZ_READY_FORCE, 1e-9, 0.0);
}

/* After half a pitch of slip against meshed ribs only friction remains. */
static void ribs_shear_off_over_half_a_pitch(void **state) {
    (void)state;
    assert_near(cz_ribs(&ribs, 0.0, 0.1, 1e5, 0.0125).capacity, 0.5 * 256e3 + 0.2e5, 1e-13, 0.0);
    assert_near(cz_ribs(&ribs, 0.0, 0.1, 1e5, 0.025).capacity, 0.2e5, 1e-13, 0.0);
    assert_near(cz_ribs(&ribs, 0.0, 0.1, 1e5, 1.0).capacity, 0.2e5, 1e-13, 0.0);
}

static void nearest_whole_numbers(void **state) {
    (void)state;
    static const double value[] = {0.0, 0.49, -0.49, 0.51, -0.51, 2.5, 1e6 + 0.4, -3.6};
    static const double whole[] = {0, 0, 0, 1, -1, 2, 1e6, -4};
    for (size_t i = 0; i < sizeof value / sizeof *value; i++)
        assert_near(cz_nearest_integer(value[i]), whole[i], 0.0, 0.0);
}

static double superstructure_force(Element *element, double x) {
    const CzSuperstructureResponse response = cz_superstructure(5e7, 4e5, x, element->memory[0]);
    element->memory[0] = response.set;
    return response.force;
}

/* 400 kN over 100 mm less the 8 mm that are elastic: 400 kN x (0.1 - 0.004) m in all. */
static void superstructure_absorbs_its_strength_times_the_travel(void **state) {
    (void)state;
    Element element = {.force = superstructure_force};
    const double work = drive(&element, 0.1, 1e-5);
    assert_near(element.f, 4e5, 1e-14, 0.0);
    /* The trapezoidal rule misses at most k step^2 / 8 at the corner. */
    assert_near(work, 4e5 * (0.1 - 0.004), 0.0, 5e7 * 1e-10 / 8.0);
    assert_near(element.memory[0], 0.092, 1e-12, 0.0);
    /* Unloading returns the elastic energy only; apart there is no force. */
    assert_near(-drive(&element, 0.0, 1e-5), 0.5 * 4e5 * 0.008, 1e-5, 0.0);
    assert_near(element.f, 0.0, 0.0, 0.0);
    assert_near(element.memory[0], 0.092, 1e-12, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(capacity_is_engaged_ribs_and_friction),
        cmocka_unit_test(residual_capacity_does_not_depend_on_the_first_touch),
        cmocka_unit_test(ribs_mesh_by_the_offset_modulo_the_pitch),
        cmocka_unit_test(ribs_engage_over_their_depth),
        cmocka_unit_test(ribs_shear_off_over_half_a_pitch),
        cmocka_unit_test(nearest_whole_numbers),
        cmocka_unit_test(superstructure_absorbs_its_strength_times_the_travel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
