/* Thousands of damaged files: the reader reports the mistakes of each, or reads it. The sequence is
 * the same on every run; the debug build runs it under sanitizers. */
#include "problem/read_problem.h"

enum { N_MUTANT = 2500, MAX_CHANGES = 6 };

static uint32_t random_state;

/* Marsaglia's xorshift, sufficient here. */
static uint32_t draw(uint32_t n) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state % n;
}

static char *load(const char *path, size_t *n_byte) {
    FILE *file = fopen(path, "rb");
    char *text = malloc(64 * 1024);
    assert_non_null(file);
    assert_non_null(text);
    *n_byte = fread(text, 1, 32 * 1024, file);
    fclose(file);
    return text;
}

/* Pieces with a meaning for the reader. */
static const char *const pieces[] = {"use: car",
                                     "{",
                                     "}",
                                     "[",
                                     "]",
                                     "&a ",
                                     "*a",
                                     "<<: ",
                                     ": ",
                                     "- ",
                                     "\n",
                                     "  ",
                                     "1e308",
                                     ".nan",
                                     "-",
                                     "null",
                                     "copy: A",
                                     "repeat: 9",
                                     "extends: full.yaml",
                                     "catalogue: [parts.yaml]",
                                     "set: {trains.A.speed_km_h: 3}",
                                     "\"",
                                     "'",
                                     "#",
                                     "\t",
                                     "front",
                                     "stages",
                                     "[*]",
                                     "true",
                                     "|",
                                     "\xff",
                                     "\xc3\xa4",
                                     "name: A1",
                                     "parts.car.",
                                     "0",
                                     "999999999999",
                                     "!!str ",
                                     "---\n"};

static size_t damage(char *text, size_t n_byte) {
    const uint32_t n_change = 1 + draw(MAX_CHANGES);
    for (uint32_t i = 0; i < n_change && n_byte > 20; i++) {
        const size_t at = draw((uint32_t)n_byte);
        const size_t n_cut = draw(12);
        const char *piece = pieces[draw(sizeof pieces / sizeof pieces[0])];
        const size_t n_piece = strlen(piece);
        if (draw(3) == 0) { /* copy a stretch of the text to another place */
            const size_t from = draw((uint32_t)(n_byte - 15));
            memmove(text + at, text + from, at + 15 < n_byte ? 15 : n_byte - at);
        } else if (draw(2) == 0 && at + n_cut < n_byte) {
            memmove(text + at, text + at + n_cut, n_byte - at - n_cut);
            n_byte -= n_cut;
        } else {
            memmove(text + at + n_piece, text + at, n_byte - at);
            memcpy(text + at, piece, n_piece);
            n_byte += n_piece;
        }
    }
    return n_byte;
}

static void check_mutants(const char *name) {
    char path[300];
    size_t n_original = 0;
    int n_read = 0, n_refused = 0;
    snprintf(path, sizeof path, GOOD_FOLDER "/%s", name);
    char *original = load(path, &n_original);
    char *text = malloc(64 * 1024);
    assert_non_null(text);
    for (int i = 0; i < N_MUTANT; i++) {
        CzProblem *problem = NULL;
        CzError error = {0};
        memcpy(text, original, n_original);
        const size_t n_byte = damage(text, n_original);
        const CzStatus status =
            cz_problem_read_text(text, n_byte, "mutant", GOOD_FOLDER, NULL, &problem, &error);
        assert_true(status == CZ_OK || status == CZ_STATUS_INPUT);
        n_read += status == CZ_OK;
        n_refused += status == CZ_STATUS_INPUT;
        if (status == CZ_STATUS_INPUT)
            assert_true(error.message[0] != '\0' && error.file[0] != '\0');
        assert_int_equal(status == CZ_OK, cz_problem_n_mistake(problem) == 0);
        cz_problem_free(problem);
    }
    assert_true(n_read > 0 && n_refused > N_MUTANT / 4);
    free(text);
    free(original);
}

static void damaged_rigid_problems_are_read_or_refused(void **state) {
    (void)state;
    random_state = 2463534242u;
    check_mutants("rigid.yaml");
}

static void damaged_full_problems_are_read_or_refused(void **state) {
    (void)state;
    random_state = 88172645u;
    check_mutants("full.yaml");
}

static void damaged_overlays_are_read_or_refused(void **state) {
    (void)state;
    random_state = 521288629u;
    check_mutants("overlay.yaml");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_rigid_problems_are_read_or_refused),
        cmocka_unit_test(damaged_full_problems_are_read_or_refused),
        cmocka_unit_test(damaged_overlays_are_read_or_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
