/* The arena: memory is zeroed and aligned, impossible sizes are refused, everything is freed at
 * once. */
#include "support/check.h"

#include "base/arena.h"

static void memory_is_zeroed_and_aligned(void **state) {
    (void)state;
    CzArena arena = {0};
    for (size_t n = 1; n < 200000; n = n * 3 + 1) {
        unsigned char *memory = cz_arena_allocate(&arena, n, 1);
        assert_non_null(memory);
        assert_int_equal((uintptr_t)memory % 64, 0);
        for (size_t i = 0; i < n; i++)
            assert_int_equal(memory[i], 0);
        memset(memory, 0xff, n);
    }
    cz_arena_free(&arena);
}

static void pieces_do_not_overlap(void **state) {
    (void)state;
    enum { N_PIECE = 500, SIZE = 300 };
    CzArena arena = {0};
    unsigned char *piece[N_PIECE];
    for (int i = 0; i < N_PIECE; i++) {
        piece[i] = cz_arena_allocate(&arena, SIZE, 1);
        assert_non_null(piece[i]);
        memset(piece[i], i % 251, SIZE);
    }
    for (int i = 0; i < N_PIECE; i++) {
        for (int byte = 0; byte < SIZE; byte++)
            assert_int_equal(piece[i][byte], i % 251);
    }
    cz_arena_free(&arena);
}

static void a_size_that_overflows_is_refused(void **state) {
    (void)state;
    CzArena arena = {0};
    assert_null(cz_arena_allocate(&arena, SIZE_MAX / 2, 4));
    assert_null(cz_arena_allocate(&arena, SIZE_MAX, 1));
    cz_arena_free(&arena);
}

static void a_copied_text_ends_where_it_was_cut(void **state) {
    (void)state;
    CzArena arena = {0};
    assert_string_equal(cz_arena_copy_text(&arena, "anti-climber", 4), "anti");
    assert_string_equal(cz_arena_copy_text(&arena, "", 0), "");
    cz_arena_free(&arena);
}

static void an_empty_arena_can_be_freed_twice(void **state) {
    (void)state;
    CzArena arena = {0};
    cz_arena_free(&arena);
    assert_non_null(cz_arena_allocate(&arena, 1, 1));
    cz_arena_free(&arena);
    cz_arena_free(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_zeroed_and_aligned),
        cmocka_unit_test(pieces_do_not_overlap),
        cmocka_unit_test(a_size_that_overflows_is_refused),
        cmocka_unit_test(a_copied_text_ends_where_it_was_cut),
        cmocka_unit_test(an_empty_arena_can_be_freed_twice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
