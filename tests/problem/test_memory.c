/* Every request for memory fails in turn: the status reports it and nothing leaks. The linker
 * redirects the allocations of the library (--wrap). */
#include "problem/read_problem.h"

static int n_request;    /* so far */
static int failing = -1; /* number of the request that fails; -1: none */

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);

static bool is_failing(void) {
    return n_request++ == failing;
}

void *__wrap_malloc(size_t size) {
    return is_failing() ? NULL : __real_malloc(size);
}

void *__wrap_calloc(size_t n, size_t size) {
    return is_failing() ? NULL : __real_calloc(n, size);
}

void *__wrap_realloc(void *memory, size_t size) {
    return is_failing() ? NULL : __real_realloc(memory, size);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return is_failing() ? NULL : __real_aligned_alloc(alignment, size);
}

/* Reads with the i-th request failing, until a read needs fewer requests. */
static int count_failures(const char *name, CzStatus wanted) {
    for (int i = 0; i < 5000; i++) {
        CzProblem *problem = NULL;
        CzError error = {0};
        n_request = 0;
        failing = i;
        const CzStatus status = cz_problem_read(name, NULL, &problem, &error);
        const bool has_failed = n_request > i;
        failing = -1;
        cz_problem_free(problem);
        if (!has_failed) {
            assert_int_equal(status, wanted);
            return i;
        }
        assert_int_equal(status, CZ_STATUS_NO_MEMORY);
        assert_true(error.message[0] != '\0');
    }
    fail_msg("more requests than expected");
    return 0;
}

static void reading_a_good_file_reports_every_lack_of_memory(void **state) {
    (void)state;
    assert_in_range(count_failures(GOOD_FOLDER "/overlay.yaml", CZ_OK), 5, 4999);
    assert_in_range(count_failures(GOOD_FOLDER "/curves.yaml", CZ_OK), 5, 4999);
    assert_in_range(count_failures(GOOD_FOLDER "/rigid.yaml", CZ_OK), 5, 4999);
    assert_in_range(count_failures(GOOD_FOLDER "/single.yaml", CZ_OK), 5, 4999);
}

static void reading_a_bad_file_reports_every_lack_of_memory(void **state) {
    (void)state;
    assert_in_range(count_failures(GOOD_FOLDER "/../bad/many-mistakes.yaml", CZ_STATUS_INPUT), 3,
                    4999);
}

static void finding_places_reports_every_lack_of_memory(void **state) {
    (void)state;
    CzProblem *problem = read_good("full.yaml", 0, NULL);
    for (int i = 0; i < 5000; i++) {
        CzTargets found = {0};
        n_request = 0;
        failing = i;
        const CzStatus status =
            cz_problem_find(problem, "parts.end.stages[*].force_kN", &found, NULL);
        const bool has_failed = n_request > i;
        failing = -1;
        free(found.target);
        assert_int_equal(status, has_failed ? CZ_STATUS_NO_MEMORY : CZ_OK);
        if (!has_failed)
            break;
    }
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading_a_good_file_reports_every_lack_of_memory),
        cmocka_unit_test(reading_a_bad_file_reports_every_lack_of_memory),
        cmocka_unit_test(finding_places_reports_every_lack_of_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
