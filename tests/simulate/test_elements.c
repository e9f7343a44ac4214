/* Every kind of element of an interface carries force and absorbs energy in a collision. */
#include "physics/collision.h"

/* A collision in which each kind of element absorbs energy. */
static const char *const absorbs[] = {
    [CZ_ELEMENT_COUPLER] = "problems/two-cars-25kmh.yaml",
    [CZ_ELEMENT_ANTI_CLIMBER] = "problems/wall.yaml",
    [CZ_ELEMENT_END] = "problems/override-bottoming-lifts.yaml",
    [CZ_ELEMENT_SIDE_BUFFERS] = "problems/wagon.yaml",
    [CZ_ELEMENT_SUPERSTRUCTURE] = "problems/override-overlap-climbs.yaml",
    [CZ_ELEMENT_SLIDE] = "problems/buffer-stop.yaml",
};

/* Whether an element of a kind carries force and absorbs energy. */
static bool acts_in(const char *file, CzElementKind kind) {
    Collision collision = collide(file, WITH("simulation.duration_s=0.6"), 0);
    bool acts = false;
    assert_completed(&collision);
    for (int i = 0; i < collision.summary->n_interface; i++)
        for (int k = 0; k < collision.summary->interface[i].n_element; k++) {
            const CzElementResult *element = &collision.summary->interface[i].element[k];
            acts |= element->kind == kind && element->peak_force > 0.0 && element->energy > 0.0;
        }
    collision_free(&collision);
    return acts;
}

static void every_kind_of_element_carries_force_and_absorbs_energy(void **state) {
    (void)state;
    static const CzElementKind kinds[] = {
#define CZ_ELEMENT(constant, text) constant,
#include "crushzone/elements.def"
#undef CZ_ELEMENT
    };
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const CzElementKind kind = kinds[i];
        if ((size_t)kind >= sizeof absorbs / sizeof absorbs[0] || absorbs[kind] == NULL)
            fail_msg("no collision for element '%s'", cz_element_text(kind));
        if (!acts_in(absorbs[kind], kind))
            fail_msg("element '%s' does nothing in %s", cz_element_text(kind), absorbs[kind]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_element_carries_force_and_absorbs_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
