/* Requirements of a profile that this program cannot check. */
#include "evaluate/not_covered.h"

#include "problem/problem.h"

const char *const *cz_not_covered(const CzProblem *problem, int *n) {
    const CzProfile *profile = cz_problem_profile(problem);
    *n = profile != NULL ? profile->not_checked.n_text : 0;
    return *n > 0 ? (const char *const *)profile->not_checked.text : NULL;
}
