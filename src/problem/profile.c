/* Profiles of limits. */
#include "problem/reader.h"

void cz_profile_read(CzProblem *problem) {
    (void)problem;
}
