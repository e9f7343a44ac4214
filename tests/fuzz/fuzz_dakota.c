/* Any bytes as a parameters file of Dakota: read, or refused at a place; of what was read
 * derivatives name variables of the file. */
#include "fuzz/fuzz.h"

#include "serve/dakota_parameters.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte) {
    CzArena arena = {0};
    CzDakotaParameters parameters;
    CzError error = {0};
    const char *path = fuzz_write_file("params.in", data, n_byte);
    const CzStatus status = cz_dakota_parameters_read(&arena, path, &parameters, &error);
    FUZZ_DEMAND(status == CZ_OK || status == CZ_STATUS_INPUT);
    FUZZ_DEMAND(status == CZ_OK || error.message[0] != '\0');
    for (int i = 0; status == CZ_OK && i < parameters.derivative.n; i++)
        FUZZ_DEMAND(parameters.derivative.entry[i].number >= 0 &&
                    parameters.derivative.entry[i].number < parameters.variable.n);
    for (int i = 0; status == CZ_OK && i < parameters.response.n; i++)
        FUZZ_DEMAND(parameters.response.entry[i].number >= 0 &&
                    parameters.response.entry[i].number <= 7);
    cz_arena_free(&arena);
    return 0;
}
