/* Random designs are the same ones on every machine. */
#include "property/random_design.h"
#include "support/check.h"

/* FNV-1a of the text of designs 1 to 200. The same for gcc, clang and sanitizers; a change of
 * how designs are drawn changes it. */
static void every_compiler_draws_the_same_designs(void **state) {
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    for (uint64_t number = 1; number <= 200; number++)
        random_design_write(number, "generic.yaml", file);
    fclose(file);
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ (unsigned char)text[i]) * 0x100000001b3u;
    free(text);
    assert_int_equal(hash, 0xcf5684bec3a9f9a7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_compiler_draws_the_same_designs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
