/* Building a model when memory is short: every request fails once, with a status and without a
 * leak. This test brings its own arena. */
#include "support/check.h"

#include "base/arena.h"
#include "crushzone/model.h"
#include "support/typed_problem.h"

static int n_allowed; /* requests that succeed from now on; -1: all */
static int n_live;    /* pieces not yet freed */

struct CzArenaBlock {
    struct CzArenaBlock *next;
    double memory[];
};

void *cz_arena_allocate(CzArena *arena, size_t n, size_t size) {
    if (n_allowed == 0) {
        arena->out_of_memory = true;
        return NULL;
    }
    n_allowed -= n_allowed > 0;
    struct CzArenaBlock *block = calloc(1, sizeof *block + n * size);
    assert_non_null(block);
    block->next = arena->block;
    arena->block = block;
    n_live++;
    return block->memory;
}

char *cz_arena_copy_text(CzArena *arena, const char *text, size_t n) {
    char *copy = cz_arena_allocate(arena, n + 1, 1);
    return copy == NULL ? NULL : memcpy(copy, text, n);
}

void cz_arena_free(CzArena *arena) {
    while (arena->block != NULL) {
        struct CzArenaBlock *next = arena->block->next;
        free(arena->block);
        arena->block = next;
        n_live--;
    }
}

static void every_failing_request_is_reported_and_nothing_leaks(void **state) {
    (void)state;
    const CzVehicle car = typed_full();
    struct CzProblem problem;
    typed_problem_init(&problem, 1, &car, 1, &car, 10.0);
    problem.input.simulation.given = false; /* the default one is allocated too */
    int n_failed = 0;
    for (;; n_failed++) {
        CzModel *model = NULL;
        CzError error = {0};
        n_allowed = n_failed;
        const CzStatus status = cz_model_build(&problem, 0, &model, &error);
        n_allowed = -1;
        if (status == CZ_OK) {
            assert_near(cz_model_time_step(model), 1e-4, 0.0, 0.0);
            cz_model_free(model);
            break;
        }
        assert_int_equal(status, CZ_STATUS_NO_MEMORY);
        assert_int_equal(error.status, CZ_STATUS_NO_MEMORY);
        assert_true(error.message[0] != '\0');
        assert_null(model);
        assert_int_equal(n_live, 0);
    }
    assert_int_equal(n_live, 0);
    assert_true(n_failed > 10);
    cz_model_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_failing_request_is_reported_and_nothing_leaks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
