/* Every kind of element of an interface carries force in a collision, and absorbs energy unless it
 * is elastic. */
#include "physics/collision.h"

/* A collision in which each kind of element acts. */
static const struct {
    const char *file;
    bool is_elastic;
} acts[] = {
    [CZ_ELEMENT_COUPLER] = {"problems/two-cars-25kmh.yaml", false},
    [CZ_ELEMENT_ANTI_CLIMBER] = {"problems/wall.yaml", false},
    [CZ_ELEMENT_END] = {"problems/override-bottoming-lifts.yaml", false},
    [CZ_ELEMENT_SIDE_BUFFERS] = {"problems/wagon.yaml", false},
    [CZ_ELEMENT_SUPERSTRUCTURE] = {"problems/override-overlap-climbs.yaml", false},
    [CZ_ELEMENT_DRAW_GEAR] = {"tests/physics/cases/draw-gear.yaml", true},
    [CZ_ELEMENT_SLIDE] = {"problems/buffer-stop.yaml", false},
};

/* Whether an element of a kind acts. */
static bool acts_in_its_collision(CzElementKind kind) {
    Collision collision = collide(acts[kind].file, WITH("simulation.duration_s=0.6"), 0);
    bool does = false;
    assert_completed(&collision);
    for (int i = 0; i < collision.summary->n_interface; i++)
        for (int k = 0; k < collision.summary->interface[i].n_element; k++) {
            const CzElementResult *element = &collision.summary->interface[i].element[k];
            does |= element->kind == kind && element->peak_force > 0.0 &&
                    (acts[kind].is_elastic || element->energy > 0.0);
        }
    collision_free(&collision);
    return does;
}

static void every_kind_of_element_carries_force_and_absorbs_energy_unless_elastic(void **state) {
    (void)state;
    static const CzElementKind kinds[] = {
#define CZ_ELEMENT(constant, text) constant,
#include "crushzone/elements.def"
#undef CZ_ELEMENT
    };
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const CzElementKind kind = kinds[i];
        if ((size_t)kind >= sizeof acts / sizeof acts[0] || acts[kind].file == NULL)
            fail_msg("no collision for element '%s'", cz_element_text(kind));
        if (!acts_in_its_collision(kind))
            fail_msg("element '%s' does nothing in %s", cz_element_text(kind), acts[kind].file);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_element_carries_force_and_absorbs_energy_unless_elastic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
