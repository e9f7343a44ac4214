/* A kernel whose parts that line up and put are copies under other names (second_kernel.sh), all
 * the rest being the kernel's own, computes every step to the same bits: the kinematics can be
 * replaced without a copy of chains, laws, memory, ledger and commit.
 */
#include "physics/motion.h"

extern const CzKernel cz_kernel_second;

static void assert_same_bits(const Motion *a, const Motion *b, long n_step) {
    for (int i = 0; i < a->dynamics->n_block; i++) {
        const CzBlock *own = &a->dynamics->block[i], *second = &b->dynamics->block[i];
        const bool same = memcmp(&own->position, &second->position, sizeof own->position) == 0 &&
                          memcmp(&own->velocity, &second->velocity, sizeof own->velocity) == 0 &&
                          memcmp(&own->force, &second->force, sizeof own->force) == 0 &&
                          memcmp(&own->work, &second->work, sizeof own->work) == 0 &&
                          memcmp(&own->extreme, &second->extreme, sizeof own->extreme) == 0 &&
                          memcmp(&own->published, &second->published, sizeof own->published) == 0 &&
                          memcmp(own->memory, second->memory, sizeof *own->memory) == 0;
        if (!same)
            fail_msg("block %d differs after step %ld", i, n_step);
    }
}

static void compare(const char *file, const char *const *set, double duration) {
    Motion own = motion_open(file, set), second = motion_open(file, set);
    own.kernel = cz_kernel("baseline");
    second.kernel = &cz_kernel_second;
    motion_start(&own);
    motion_start(&second);
    const long n_step = lround(duration / own.step);
    for (long step = 1; step <= n_step; step++) {
        motion_advance(&own);
        motion_evaluate(&own);
        motion_advance(&second);
        motion_evaluate(&second);
        assert_same_bits(&own, &second, step);
    }
    motion_close(&own);
    motion_close(&second);
}

static void a_train_on_its_track_moves_to_the_same_bits(void **state) {
    (void)state;
    compare("problems/metro-override.yaml", AS_WRITTEN, 0.2);
}

static void couplers_and_faces_push_to_the_same_bits(void **state) {
    (void)state;
    compare("problems/two-cars-25kmh.yaml", AS_WRITTEN, 0.2);
}

static void side_buffers_push_to_the_same_bits(void **state) {
    (void)state;
    compare("problems/wagon.yaml", AS_WRITTEN, 0.2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_train_on_its_track_moves_to_the_same_bits),
        cmocka_unit_test(couplers_and_faces_push_to_the_same_bits),
        cmocka_unit_test(side_buffers_push_to_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
