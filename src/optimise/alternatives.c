/* Further parameter sets that fit about as well. A fit with more parameters than measurements, or
 * with insensitive ones, has many solutions, which a report of one would hide.
 */
#include "base/error.h"
#include "optimise/outcome.h"

#include <math.h>

/* Largest number of reported sets, largest ratio of their objective to the best one when that
 * exceeds a tolerance, and smallest distance between sets as a root mean square share of the ranges
 * (all ours). */
enum { MAX_ALTERNATIVES = 5 };
static const double about_as_well = 1.2;
static const double apart = 0.1;

/* Whether a record fits about as well as the best one: within every tolerance like it, or with
 * nearly the same sum of squares, constraints included. */
static bool fits(const CzSearch *search, long record, long best) {
    const CzRecord *mine = &search->record[record];
    if (isnan(mine->objective))
        return false;
    return search->record[best].violation <= 0
               ? mine->violation <= 0
               : mine->penalty <= about_as_well * search->record[best].penalty;
}

/* The best record that fits and is distant from the n chosen ones, -1 when there is none; u is
 * scratch. */
static long next_apart(const CzSearch *search, long best, int n_chosen, const double *chosen,
                       double *u) {
    long found = -1;
    for (long record = 0; record < search->n_record; record++) {
        if (!fits(search, record, best) ||
            (found >= 0 && search->record[record].objective >= search->record[found].objective))
            continue;
        if (cz_search_is_apart(search, record, n_chosen, chosen, apart, u))
            found = record;
    }
    return found;
}

CzStatus cz_alternatives_find(const CzSubspace *subspace, long best, CzOutcome *outcome,
                              CzError *error) {
    const CzSearch *search = &subspace->search;
    const int n = search->function->n_variable;
    if (best < 0 || n == 0)
        return CZ_OK;
    double *chosen = cz_outcome_numbers(outcome, (size_t)((MAX_ALTERNATIVES + 2) * n));
    outcome->alternative =
        cz_outcome_numbers(outcome, (size_t)(MAX_ALTERNATIVES * subspace->n_all));
    outcome->alternative_objective = cz_outcome_numbers(outcome, MAX_ALTERNATIVES);
    if (chosen == NULL || outcome->alternative == NULL || outcome->alternative_objective == NULL)
        return cz_no_memory(error, "further parameter sets");
    double *u = chosen + (MAX_ALTERNATIVES + 1) * n;
    cz_search_scale(search, cz_search_x(search, best), chosen);
    for (int i = 0; i < MAX_ALTERNATIVES; i++) {
        const long record = next_apart(search, best, i + 1, chosen, u);
        if (record < 0)
            break;
        cz_search_scale(search, cz_search_x(search, record), chosen + (i + 1) * n);
        cz_subspace_expand(subspace, cz_search_x(search, record),
                           outcome->alternative + i * subspace->n_all);
        outcome->alternative_objective[outcome->n_alternative++] = search->record[record].objective;
    }
    return CZ_OK;
}
