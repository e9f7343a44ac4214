/* All searches of one optimisation. */
#include "optimise/combinations.h"
#include "base/error.h"
#include "evaluate/evaluator.h"
#include "optimise/strategy.h"

#include <math.h>
#include <string.h>

/* With many scenarios a verdict often hangs on one whose response is chaotic: this part of the
 * evaluations is left for the case that the best design is not verified (ours). */
enum { RESERVED_PART = 4 };

/* The record with the smallest largest violation, on the increments where `on_grid` is set: what a
 * search minimises that maximises the smallest margin, while it ranks designs by the sum. */
static long least_violated(const CzSearch *search, bool on_grid) {
    long least = -1;
    for (long i = 0; i < search->n_record; i++) {
        const CzRecord *record = &search->record[i];
        if (!isnan(record->objective) && !record->is_barred && !record->is_partial &&
            (record->on_grid || !on_grid) &&
            (least < 0 || record->violation < search->record[least].violation))
            least = i;
    }
    return least;
}

/* The best on the catalogue increments when there are any. Otherwise the best of all: when the
 * search ended before it reached the increments, or when designs that pass, or that are valid in a
 * file, exist only between them. */
static long best_record(const CzSearch *search) {
    const long best = search->best, on_grid = search->best_on_grid;
    if (!cz_search_has_steps(search) || !search->is_snapped || on_grid < 0)
        return best;
    const CzRecord *between = &search->record[best], *snapped = &search->record[on_grid];
    const bool passes_only_between = between->violation <= 0 && snapped->violation > 0;
    const bool reads_only_between = !between->is_barred && snapped->is_barred;
    return passes_only_between || reads_only_between ? best : on_grid;
}

long cz_combinations_record(const CzSearch *search) {
    long record = best_record(search);
    if (record >= 0 && search->function->is_minimax && search->record[record].violation > 0)
        record = least_violated(search, record == search->best_on_grid);
    return record >= 0 && search->record[record].is_barred ? -1 : record;
}

/* ---- one search ------------------------------------------------------------------------------ */

static CzStatus run(CzSearch *search, const CzOptimiseOptions *options, CzError *error) {
    const char *algorithm = strcmp(options->algorithm, "auto") == 0 ? NULL : options->algorithm;
    CzStatus status = CZ_OK;
    if (search->function->n_variable == 0) /* only choices vary */
        cz_search_evaluate_start(search, "choices");
    else
        status = cz_strategy(search, algorithm, (unsigned long)options->seed, error);
    if (status != CZ_OK || search->status == CZ_OK || search->status == CZ_STATUS_INTERRUPTED)
        return status;
    if (search->status == CZ_STATUS_RUN_FAILED)
        return cz_fail(error, search->status, "%s: the bounds of the variables may be too wide",
                       search->why);
    if (error != NULL)
        *error = search->error;
    return search->status;
}

/* ---- several --------------------------------------------------------------------------------- */

/* Whether the best design of one search is better than that of another. */
static bool is_better(const CzSearch *search, const CzSearch *other) {
    const long a = cz_combinations_record(search), b = cz_combinations_record(other);
    if (a < 0 || b < 0)
        return a >= 0;
    const CzRecord *mine = &search->record[a], *theirs = &other->record[b];
    if ((mine->violation <= 0) != (theirs->violation <= 0))
        return mine->violation <= 0;
    if (mine->violation <= 0 && mine->on_grid != theirs->on_grid)
        return mine->on_grid;
    return mine->violation <= 0 ? cz_record_is_better(mine, theirs)
                                : mine->penalty < theirs->penalty;
}

/* Begins and runs a further search. */
static CzStatus begin(CzCombinations *combinations, int combination, const double *start,
                      long evaluations, const CzOptimiseOptions *options, CzError *error) {
    CzSubspace *subspace = &combinations->subspace[combinations->n];
    CzSearch *search = &subspace->search;
    CzOptimiseOptions own = *options;
    long n_earlier = 0;
    for (int i = 0; i < combinations->n; i++)
        n_earlier += combinations->subspace[i].search.n_record;
    own.evaluations = evaluations;
    if (!cz_subspace_create(&combinations->replay, combination, start, &combinations->arena,
                            subspace))
        return cz_no_memory(error, "a search");
    cz_search_init(search, &subspace->function, &own);
    search->n_earlier = n_earlier;
    search->most_in_all = options->evaluations;
    combinations->n++;
    const CzStatus status = run(search, &own, error);
    if (is_better(search, &combinations->subspace[combinations->chosen].search))
        combinations->chosen = combinations->n - 1;
    return status;
}

/* The combination of the file's own choices. */
static int own_combination(const CzEvaluator *evaluator, int n, double *made) {
    for (int combination = 0; combination < n; combination++) {
        bool is_own = true;
        cz_evaluator_set_combination(evaluator, combination, made);
        for (int i = 0; i < cz_evaluator_n_variable(evaluator); i++) {
            const CzVariableInfo *info = cz_evaluator_variable(evaluator, i);
            is_own &= info->n_choice == 0 || made[i] == info->start;
        }
        if (is_own)
            return combination;
    }
    return 0;
}

/* The i-th combination to be searched: the file's own first. */
static int combination_at(int i, int own) {
    return i == 0 ? own : i <= own ? i - 1 : i;
}

/* Runs a short search of every combination, the file's own first, then uses all remaining
 * evaluations for the best one. */
static CzStatus search_choices(int n, const CzOptimiseOptions *options,
                               CzCombinations *combinations, CzError *error) {
    const long half = options->evaluations / (2 * (long)n);
    long left = options->evaluations;
    int n_failed = 0;
    const CzEvaluator *evaluator = combinations->replay.evaluator;
    double *made =
        cz_arena_numbers(&combinations->arena, (size_t)cz_evaluator_n_variable(evaluator));
    if (made == NULL)
        return cz_no_memory(error, "the search");
    const int own = own_combination(evaluator, n, made);
    for (int i = 0; i < n && left > 0; i++) {
        const CzStatus status = begin(combinations, combination_at(i, own), options->start,
                                      half > 0 ? half : 1, options, error);
        const CzSearch *search = &combinations->subspace[combinations->n - 1].search;
        n_failed += status == CZ_STATUS_RUN_FAILED;
        if (status != CZ_OK && (status != CZ_STATUS_RUN_FAILED || n_failed == n))
            return status;
        left -= search->n_record;
        if (search->status == CZ_STATUS_INTERRUPTED)
            return CZ_OK;
    }
    const CzSubspace *chosen = &combinations->subspace[combinations->chosen];
    const CzSearch *best = &chosen->search;
    const long record = cz_combinations_record(best);
    if (record < 0 || left < 1 || best->function->n_variable == 0)
        return CZ_OK;
    double *start = cz_arena_numbers(&combinations->arena, (size_t)chosen->n_all);
    if (start == NULL)
        return cz_no_memory(error, "a search");
    cz_subspace_expand(chosen, cz_search_x(best, record), start);
    const int i = combinations->chosen;
    return begin(combinations, combination_at(i, own), start, left, options, error);
}

CzStatus cz_combinations(CzEvaluator *evaluator, const CzOptimiseOptions *options,
                         CzCombinations *combinations, CzError *error) {
    const int n = cz_evaluator_n_combination(evaluator);
    *combinations = (CzCombinations){0};
    combinations->subspace = cz_arena_allocate(&combinations->arena, (size_t)n + 1 + CZ_MAX_FURTHER,
                                               sizeof *combinations->subspace);
    if (combinations->subspace == NULL)
        return cz_no_memory(error, "the search");
    CZ_TRY(cz_replay_begin(&combinations->replay, evaluator, options->journal, error));
    if (n > 1)
        return search_choices(n, options, combinations, error);
    const long part = options->evaluations / RESERVED_PART;
    if (combinations->replay.selection.is_on && options->verify_methods != 0 &&
        part >= CZ_FEWEST_EVALUATIONS)
        combinations->n_reserved = part;
    return begin(combinations, 0, options->start, options->evaluations - combinations->n_reserved,
                 options, error);
}

CzStatus cz_combinations_go_on(CzCombinations *combinations, const double *x, long evaluations,
                               const CzRequired *required, const CzOptimiseOptions *options,
                               CzError *error) {
    CzEvaluator *evaluator = combinations->replay.evaluator;
    const size_t size = (size_t)cz_evaluator_n_variable(evaluator) * sizeof *x;
    const int n = cz_evaluator_n_combination(evaluator);
    double *made = cz_arena_numbers(&combinations->arena, size / sizeof *x);
    if (made == NULL)
        return cz_no_memory(error, "a search");
    int own = 0;
    for (int i = 0; i < n; i++) { /* the choices of the design */
        memcpy(made, x, size);
        cz_evaluator_set_combination(evaluator, i, made);
        if (memcmp(made, x, size) == 0)
            own = i;
    }
    combinations->replay.required = required;
    return begin(combinations, own, x, evaluations, options, error);
}

void cz_combinations_free(CzCombinations *combinations) {
    for (int i = 0; i < combinations->n; i++)
        cz_search_free(&combinations->subspace[i].search);
    cz_replay_free(&combinations->replay);
    cz_arena_free(&combinations->arena);
}

long cz_combinations_n_record(const CzCombinations *combinations) {
    long n = 0;
    for (int k = 0; k < combinations->n; k++)
        n += combinations->subspace[k].search.n_record;
    return n;
}

void cz_combinations_history(const CzCombinations *combinations, int n_variable, CzTrial *trial,
                             double *x) {
    for (int k = 0; k < combinations->n; k++) {
        const CzSubspace *subspace = &combinations->subspace[k];
        for (long i = 0; i < subspace->search.n_record; i++, x += n_variable) {
            const CzRecord *record = &subspace->search.record[i];
            cz_subspace_expand(subspace, cz_search_x(&subspace->search, i), x);
            *trial++ = (CzTrial){.objective = record->objective,
                                 .violation = record->violation,
                                 .feasible = record->violation <= 0 && !record->is_partial,
                                 .phase = record->phase};
        }
    }
}
