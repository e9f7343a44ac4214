/* Every request for memory fails in turn: the status reports it and nothing leaks. The linker
 * redirects the allocations of the library (--wrap). */
#include "fit/curves.h"

#include "crushzone/report.h"

static int n_request;    /* so far */
static int failing = -1; /* number of the request that fails; -1: none */
static int n_live;       /* pieces not yet freed, of those requested while counting */
static bool counting;

void *__real_calloc(size_t n, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *memory);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *memory);

static void *counted(void *memory) {
    n_live += counting && memory != NULL;
    return memory;
}

void *__wrap_calloc(size_t n, size_t size) {
    return counting && n_request++ == failing ? NULL : counted(__real_calloc(n, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return counting && n_request++ == failing ? NULL
                                              : counted(__real_aligned_alloc(alignment, size));
}

void __wrap_free(void *memory) {
    n_live -= counting && memory != NULL;
    __real_free(memory);
}

static void every_lack_of_memory_is_reported(void **state) {
    (void)state;
    static Curve curve;
    const CzStage stage[] = {{.stroke = 0.3, .force = 5e5, .end_force = NAN}};
    load_plastic(&curve, stage, 1, 7e5, 0.01, 2e8);
    for (int kind = 0; kind < CZ_N_FIT; kind++) {
        CzFitOptions options = cz_fit_options_default();
        options.kind = (CzFitKind)kind;
        CzStatus status = CZ_STATUS_NO_MEMORY;
        int n_failed = 0;
        for (; status != CZ_OK; n_failed++) {
            CzFit *fit = NULL;
            CzError error = {0};
            n_request = n_live = 0;
            failing = n_failed;
            counting = true;
            status = cz_fit_points(curve.n, curve.x, curve.f, &options, &fit, &error);
            cz_fit_free(fit);
            counting = false;
            assert_int_equal(n_live, 0);
            if (status != CZ_OK) {
                assert_int_equal(status, CZ_STATUS_NO_MEMORY);
                assert_true(error.message[0] != '\0');
                assert_null(fit);
            }
        }
        printf("%d\n", n_failed);
    }
}

/* Titles are in the first line that is not a comment, with or without quotes. Only requests that
 * the linker redirects are counted. */
static void titles_are_read_or_the_lack_of_memory_is_reported(void **state) {
    (void)state;
    static const char path[] = "titles.csv";
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs("# a test\n\nt_ms; \"F; both [kN]\" ;v_A1_m_s\n0;1;2\n", stream);
    fclose(stream);
    CzStatus status = CZ_STATUS_NO_MEMORY;
    int n_failed = 0;
    for (; status != CZ_OK; n_failed++) {
        char **title = NULL;
        int n = 0;
        CzError error = {0};
        n_request = n_live = 0;
        failing = n_failed;
        counting = true;
        status = cz_curve_titles(path, 0, &n, &title, &error);
        counting = false;
        if (status == CZ_OK) {
            assert_int_equal(n, 3);
            assert_string_equal(title[0], "t_ms");
            assert_string_equal(title[1], "F; both [kN]");
            assert_string_equal(title[2], "v_A1_m_s");
            free(title);
            continue;
        }
        assert_int_equal(status, CZ_STATUS_NO_MEMORY);
        assert_null(title);
    }
    assert_true(n_failed > 1);
    remove(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_lack_of_memory_is_reported),
        cmocka_unit_test(titles_are_read_or_the_lack_of_memory_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
