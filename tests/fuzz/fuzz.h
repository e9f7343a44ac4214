/* Functions that all fuzz targets use. A target is one source with LLVMFuzzerTestOneInput: it
 * passes one input to one reader and checks the conditions that every input must satisfy. Linked
 * with libFuzzer it searches for inputs, linked with replay.c it tries given files. */
#ifndef CZ_TESTS_FUZZ_H
#define CZ_TESTS_FUZZ_H

#include "crushzone/problem.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte);

/* Ends the program, as a crash does, when a condition is violated. */
#define FUZZ_DEMAND(condition)                                                                     \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #condition);         \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

#define FUZZ_SHARE_FOLDER CZ_SOURCE_FOLDER "/problems"

/* Checks that the status agrees with the problem: mistakes with place and sentence when it was
 * refused, none when it was read. */
void fuzz_check_told(const CzProblem *problem, CzStatus status, const CzError *error);

/* Writes the input to a file in the current folder, for readers that take a path; returns it. */
const char *fuzz_write_file(const char *name, const uint8_t *data, size_t n_byte);

#endif
