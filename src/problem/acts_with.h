/* Keys that act only with something else: another key of their record, or what the vehicle end that
 * they belong to meets. */
#ifndef CZ_PROBLEM_ACTS_WITH_H
#define CZ_PROBLEM_ACTS_WITH_H

#include "problem/reading.h"

/* Whether the field of a key is required, or has what it needs to do something. */
bool cz_acts_with(const CzProblem *problem, const CzKey *key, const void *field);

/* Warns of written keys that lack it in every place where they are used. */
void cz_acts_with_check(CzProblem *problem);

/* Writes behind a key's range which key it needs beside it; nothing when none. */
void cz_acts_with_write(FILE *stream, const CzKey *key);

#endif
