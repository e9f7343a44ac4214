/* What must hold between the values of a problem. */
#include "problem/reader.h"

void cz_rules_check(CzProblem *problem) {
    (void)problem;
}
