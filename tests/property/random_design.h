/* Problem files drawn at random: cars, ends, devices, partners, speeds. */
#ifndef CZ_TESTS_PROPERTY_RANDOM_DESIGN_H
#define CZ_TESTS_PROPERTY_RANDOM_DESIGN_H

#include <stdint.h>
#include <stdio.h>

/* Writes the problem file of a number: the same number gives the same file on every machine. Its
 * full cars take parts of problems/catalogue/generic.yaml, whose path is `catalogue`. Some files
 * break a rule of the reader; most do not. */
void random_design_write(uint64_t number, const char *catalogue, FILE *file);

#endif
