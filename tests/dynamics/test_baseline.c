/* The copy of the kernel for every processor, which sanitizers check completely (CMakeLists.txt),
 * gives the same results on every shipped problem as the copy for this processor. */
#include "physics/collision.h"
#include "support/shipped.h"

static Collision run_on(const char *isa, const char *name) {
    char path[SHIPPED_SIZE + 16];
    snprintf(path, sizeof path, "problems/%s", name);
    CzSimulateOptions options = cz_simulate_options_default();
    options.isa = isa;
    return collide_so(path, WITH("simulation.duration_s=0.2"), 0, &options);
}

static void the_baseline_copy_gives_every_channel_to_the_last_bit(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++) {
        Collision a = run_on("baseline", shipped.name[i]), b = run_on("auto", shipped.name[i]);
        assert_string_equal(a.summary->failure, "");
        assert_int_equal(a.summary->n_event, b.summary->n_event);
        assert_int_equal(cz_run_n_column(a.run), cz_run_n_column(b.run));
        assert_int_equal(n_sample(&a), n_sample(&b));
        for (int k = 0; k < cz_run_n_column(a.run); k++) {
            const CzColumn column = cz_run_column(a.run, k);
            assert_memory_equal(cz_run_channel(a.run, column.channel, column.place),
                                cz_run_channel(b.run, column.channel, column.place),
                                sizeof(double) * (size_t)n_sample(&a));
        }
        collision_free(&a);
        collision_free(&b);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_baseline_copy_gives_every_channel_to_the_last_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
