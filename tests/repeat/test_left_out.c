/* Couplers and faces without force are not evaluated: every number of every step is the same to the
 * last bit as with their evaluation.
 */
#include "physics/motion.h"

/* State and results after a step. */
static void assert_same_block(const CzBlock *a, const CzBlock *b, long n_step) {
    const struct {
        const char *what;
        const void *a, *b;
        size_t size;
    } rows[] = {
        {"position", &a->position, &b->position, sizeof a->position},
        {"velocity", &a->velocity, &b->velocity, sizeof a->velocity},
        {"acceleration", &a->acceleration, &b->acceleration, sizeof a->acceleration},
        {"impulse", &a->impulse, &b->impulse, sizeof a->impulse},
        {"work", &a->work, &b->work, sizeof a->work},
        {"extreme", &a->extreme, &b->extreme, sizeof a->extreme},
        {"memory", a->memory, b->memory, sizeof *a->memory},
        {"interface force", a->published.interface.force, b->published.interface.force,
         sizeof(CzRow)},
        {"coupler force", a->published.coupler.force, b->published.coupler.force, sizeof(CzRow)},
        {"face force", a->published.face.force, b->published.face.force, sizeof(CzRow)},
        {"face demand", a->published.face.demand_vertical, b->published.face.demand_vertical,
         sizeof(CzRow)},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        if (memcmp(rows[k].a, rows[k].b, rows[k].size) != 0)
            fail_msg("%s differs after step %ld", rows[k].what, n_step);
    }
}

static void evaluate_everything(Motion *motion) {
    for (int i = 0; i < motion->dynamics->n_block; i++)
        motion->dynamics->block[i].leaves_nothing_out = 1;
}

/* Shares of the steps in which the couplers and the faces of a block were left out. */
typedef struct {
    double couplers, faces;
} LeftOut;

static LeftOut compare(const char *file, const char *const *set, const char *isa, double duration) {
    Motion quick = motion_open(file, set), whole = motion_open(file, set);
    quick.kernel = whole.kernel = cz_kernel(isa);
    motion_start(&quick);
    motion_lay(&whole);
    evaluate_everything(&whole);
    whole.kernel->evaluate(whole.dynamics, whole.step);
    whole.kernel->commit(whole.dynamics, 0.0, 0.0);

    LeftOut left_out = {0.0, 0.0};
    const long n_step = lround(duration / quick.step);
    const double share = 1.0 / ((double)n_step * quick.dynamics->n_block);
    for (long step = 1; step <= n_step; step++) {
        const double time = (double)step * quick.step;
        quick.kernel->step(quick.dynamics, quick.step, step == 1, time);
        whole.kernel->step(whole.dynamics, whole.step, step == 1, time);
        for (int i = 0; i < quick.dynamics->n_block; i++) {
            const CzBlock *block = &quick.dynamics->block[i];
            assert_same_block(block, &whole.dynamics->block[i], step);
            left_out.couplers += block->couplers_rest ? share : 0.0;
            left_out.faces += block->faces_rest ? share : 0.0;
        }
    }
    motion_close(&quick);
    motion_close(&whole);
    return left_out;
}

static void check(const char *file, const char *const *set, double duration, double least_couplers,
                  double least_faces) {
    static const char *const isas[] = {"baseline", "v3", "v4"};
    for (size_t i = 0; i < sizeof isas / sizeof isas[0]; i++) {
        if (cz_kernel(isas[i]) == NULL)
            continue;
        const LeftOut left_out = compare(file, set, isas[i], duration);
        print_message("%s, %s: couplers %.3f, faces %.3f of the steps left out\n", file, isas[i],
                      left_out.couplers, left_out.faces);
        assert_true(left_out.couplers >= least_couplers);
        assert_true(left_out.faces >= least_faces);
    }
}

/* They part finally after 0.25 s; oscillating end masses touch until 0.31 s. */
static void interfaces_of_two_parted_cars_are_not_evaluated(void **state) {
    (void)state;
    check("problems/two-cars-25kmh.yaml", AS_WRITTEN, 0.95, 0.7, 0.6);
}

/* A rolling car meets the braked car ahead again: couplers and faces are not evaluated in between.
 */
static void interfaces_of_cars_that_meet_again_are_evaluated(void **state) {
    (void)state;
    check("problems/two-cars-25kmh.yaml",
          WITH("trains.A.speed_km_h=15", "trains.B.speed_km_h=0", "trains.B.brake.ratio=0.12",
               "trains.B.brake.axle_share=1"),
          3.0, 0.1, 0.1);
}

static void open_interfaces_of_trains_are_not_evaluated(void **state) {
    (void)state;
    check("problems/first-collision.yaml", AS_WRITTEN, 1.0, 0.0, 0.9);
    check("problems/metro-6-car.yaml", AS_WRITTEN, 1.0, 0.0, 0.4);
}

static void the_interface_of_a_car_that_leaves_a_wall_is_not_evaluated(void **state) {
    (void)state;
    check("problems/wall.yaml", AS_WRITTEN, 0.5, 0.5, 0.5);
    check("problems/buffer-stop.yaml", AS_WRITTEN, 0.5, 0.0, 0.9);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interfaces_of_two_parted_cars_are_not_evaluated),
        cmocka_unit_test(interfaces_of_cars_that_meet_again_are_evaluated),
        cmocka_unit_test(open_interfaces_of_trains_are_not_evaluated),
        cmocka_unit_test(the_interface_of_a_car_that_leaves_a_wall_is_not_evaluated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
