/* Random numbers by their address: (seed, purpose, draw, sample) gives a number, in any order and
 * on any thread.
 *
 * Philox4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3",
 * SC11 (2011): ten rounds of multiplications turn a counter of four words into four random ones.
 */
#ifndef CZ_STATISTICS_RANDOM_H
#define CZ_STATISTICS_RANDOM_H

#include <stdint.h>

/* Use of a number, so that two uses never share one. */
typedef enum CzRandomPurpose { CZ_RANDOM_ORDER, CZ_RANDOM_PLACE, CZ_RANDOM_SHIFT } CzRandomPurpose;

/* Replaces the counter by its random words. */
void cz_random_words(const uint32_t key[2], uint32_t counter[4]);

/* 52 random bits as a number within (0, 1), ends excluded. */
double cz_random_unit(uint64_t seed, CzRandomPurpose purpose, int draw, int sample);

/* 32 random bits. */
uint32_t cz_random_bits(uint64_t seed, CzRandomPurpose purpose, int draw, int sample);

#endif
