/* Energy that a device dissipates before the stroke of an earlier one is exhausted. */
#include "physics/collision.h"

#define SEQUENCE "tests/physics/cases/sequence.yaml"

static const CzElementResult *element(const Collision *collision, CzElementKind kind, int vehicle) {
    const CzInterfaceResult *interface = &collision->summary->interface[0];
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].kind == kind && interface->element[i].vehicle == vehicle)
            return &interface->element[i];
    fail_msg("there is no %s", cz_element_text(kind));
    return NULL;
}

/* Couplers of 300 mm, then anti-climbers behind a gap of 320 mm, then ends, which deflect by 0.1 mm
 * before they crush: the work of 1 MN on a third of that is 17 J. */
static void devices_that_work_one_after_the_other_have_no_early_energy(void **state) {
    (void)state;
    Collision collision = collide(SEQUENCE, WITH("parts.front.face_gap_mm=620"), 0);
    for (int vehicle = 0; vehicle < 2; vehicle++) {
        assert_true(element(&collision, CZ_ELEMENT_END, vehicle)->energy > 0);
        assert_near(element(&collision, CZ_ELEMENT_ANTI_CLIMBER, vehicle)->early_energy, 0, 0, 0);
        assert_near(element(&collision, CZ_ELEMENT_END, vehicle)->early_energy, 17, 0, 1);
    }
    collision_free(&collision);
}

/* With a gap of 220 mm the anti-climbers touch at a closure of 440 mm, and the couplers are
 * exhausted at 600 mm: each anti-climber takes 80 mm with 1 MN before. The samples of 1 ms miss up
 * to 1 ms at 10 m/s, 5 mm of each. */
static void an_anti_climber_beside_a_tube_takes_its_energy_early(void **state) {
    (void)state;
    Collision collision = collide(SEQUENCE, WITH("parts.front.anti_climber.gap_mm=220"), 0);
    for (int vehicle = 0; vehicle < 2; vehicle++) {
        const CzElementResult *face = element(&collision, CZ_ELEMENT_ANTI_CLIMBER, vehicle);
        assert_near(face->early_energy, 80e3, 0, 5e3);
        assert_near(face->energy, 300e3, 1e-2, 0);
        assert_near(element(&collision, CZ_ELEMENT_COUPLER, vehicle)->early_energy, 0, 0, 0);
    }
    collision_free(&collision);
}

/* Runs that keep nothing do not note the sequence. */
static void a_bare_run_does_not_have_it(void **state) {
    (void)state;
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = false;
    Collision bare = collide_so(SEQUENCE, AS_WRITTEN, 0, &options);
    assert_true(isnan(element(&bare, CZ_ELEMENT_END, 0)->early_energy));
    assert_null(bare.summary->pulse);
    collision_free(&bare);
    options.keep_pulses = true;
    Collision kept = collide_so(SEQUENCE, AS_WRITTEN, 0, &options);
    assert_false(isnan(element(&kept, CZ_ELEMENT_END, 0)->early_energy));
    assert_non_null(kept.summary->pulse);
    collision_free(&kept);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(devices_that_work_one_after_the_other_have_no_early_energy),
        cmocka_unit_test(an_anti_climber_beside_a_tube_takes_its_energy_early),
        cmocka_unit_test(a_bare_run_does_not_have_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
