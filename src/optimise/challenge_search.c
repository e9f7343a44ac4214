/* The adversary: points that spread evenly, corners by the trend of each check, then algorithms of
 * NLopt side by side.
 *
 * Each adversary minimises the smallest margin, or the margin of one check of one scenario. A place
 * where another check takes over is a ridge of the smallest margin and never its minimum, so the
 * smallest over all places of a check needs no smoothing here. A yes or no has no margin; a margin
 * that stands for it is searched where there is one (challenge_flags.c), and a point that fails it
 * is kept in any case. A run that failed is above all others
 * for an algorithm, which then leaves its neighbourhood.
 *
 * The points of a round depend on those of earlier rounds and on their own adversary alone, and so
 * not on threads.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/least_squares.h"
#include "evaluate/tasks.h"
#include "optimise/challenge.h"
#include "optimise/nlopt_adapter.h"
#include "statistics/latin.h"
#include "statistics/sobol.h"

enum {
    MAX_ADVERSARIES = 16,
    CORNER_CHECKS = 8, /* most checks whose corners are tried */
    CORNER_ROUNDS = 2, /* the second one with the trends of the first */
    RUNS_PER_DRAW = 6  /* of an adversary, and as many more */
};

/* Shares of all points, of which the rest is for adversaries on single checks (ours; measured on
 * two trains and on the metro with 4 and 11 numbers). */
static const double spread_share = 0.3, corner_share = 0.04, global_share = 0.2;

/* ---- values for algorithms ------------------------------------------------------------------- */

/* Objective at a point: the margin of a check, or the smallest of all; NaN where there is none.
 * Margins far below 0 count logarithmically. */
static double objective_at(const CzChallenge *challenge, int point, int check) {
    const double margin = check < 0 ? challenge->point[point].margin
                                    : challenge->margin[(long)point * challenge->n_check + check];
    if (challenge->point[point].state != CZ_SAMPLE_DONE || !isfinite(margin))
        return NAN;
    return -cz_search_compressed(-margin);
}

static double *u_at(const CzChallenge *challenge, int point) {
    return challenge->parts->u + (long)point * challenge->n_draw;
}

/* The point with the smallest objective; -1 when there is none. */
static int best_point(const CzChallenge *challenge, int check) {
    int best = -1;
    double least = INFINITY;
    for (int i = 0; i < challenge->n_point; i++) {
        const double objective = objective_at(challenge, i, check);
        if (objective < least) {
            least = objective;
            best = i;
        }
    }
    return best;
}

/* ---- spread points --------------------------------------------------------------------------- */

static CzStatus run_new(CzChallenge *challenge, int n, const char *phase, CzError *error) {
    const int first = challenge->n_point;
    for (int k = 0; k < n; k++)
        challenge->point[first + k].phase = phase;
    const CzStatus status = cz_challenge_run_batch(challenge, first, n, error);
    for (int k = 0; k < n; k++) /* those that an interruption left out are dropped */
        if (challenge->point[first + k].state != CZ_SAMPLE_NOT_RUN)
            cz_challenge_move(challenge, first + k, challenge->n_point++);
    return status;
}

/* The next points of the sequence; the first one of all is the middle of all ranges. */
static CzStatus spread(CzChallenge *challenge, int n, CzError *error) {
    const int before = challenge->parts->n_spread, all = before + n;
    double *u = malloc((size_t)all * sizeof *u);
    if (u == NULL)
        return cz_no_memory(error, "the points of a challenge");
    for (int d = 0; d < challenge->n_draw; d++) {
        if (challenge->n_draw <= CZ_SOBOL_MAX_DRAWS)
            cz_sobol_draw((uint64_t)challenge->seed, d, all, u);
        else
            cz_latin_draw((uint64_t)challenge->seed + (uint64_t)before, d, all, u);
        for (int k = 0; k < n; k++)
            u_at(challenge, challenge->n_point + k)[d] = before + k == 0 ? 0.5 : u[before + k];
    }
    free(u);
    challenge->parts->n_spread = all;
    return run_new(challenge, n, "spread", error);
}

/* ---- corners --------------------------------------------------------------------------------- */

/* Linear trends of the objective of a check over all points. */
typedef struct Trends {
    double *slope;  /* along each draw (n_draw) */
    bool *is_clear; /* whether chance hardly makes it: twice its standard error (n_draw) */
} Trends;

/* Marks the slopes that are clear; a is scratch, `rest` the sum of the squared residuals. */
static void mark_clear(const CzChallenge *challenge, int check, int n, double rest,
                       Trends *trends) {
    for (int d = 0; d < challenge->n_draw; d++) {
        double sum = 0, squares = 0;
        for (int i = 0; i < challenge->n_point; i++) {
            const double u = u_at(challenge, i)[d];
            if (isnan(objective_at(challenge, i, check)))
                continue;
            sum += u;
            squares += u * u;
        }
        const double spread = squares - sum * sum / n;
        const double deviation = sqrt(rest / (n - challenge->n_draw - 1));
        trends->is_clear[d] = fabs(trends->slope[d]) * sqrt(fmax(spread, 0)) > 2 * deviation;
    }
}

/* Finds the trends by least squares; false where there are too few points, or no memory. */
static bool find_trends(const CzChallenge *challenge, int check, CzArena *arena, Trends *trends) {
    const int n_draw = challenge->n_draw, width = n_draw + 1;
    const size_t most = (size_t)challenge->n_point;
    double *a = cz_arena_numbers(arena, most * (size_t)width), *b = cz_arena_numbers(arena, most);
    trends->slope = cz_arena_numbers(arena, (size_t)n_draw);
    trends->is_clear = cz_arena_allocate(arena, (size_t)n_draw, sizeof *trends->is_clear);
    int n = 0;
    for (int i = 0; !arena->out_of_memory && i < challenge->n_point; i++)
        n += !isnan(objective_at(challenge, i, check));
    if (arena->out_of_memory || n < width + 2)
        return false;
    for (int i = 0, row = 0; i < challenge->n_point; i++) {
        const double objective = objective_at(challenge, i, check);
        if (isnan(objective))
            continue;
        b[row] = objective;
        a[row] = 1;
        for (int d = 0; d < n_draw; d++)
            a[(d + 1) * n + row] = u_at(challenge, i)[d];
        row++;
    }
    if (!cz_least_squares(n, width, a, 1, b))
        return false;
    memcpy(trends->slope, b + 1, (size_t)n_draw * sizeof *b);
    double rest = 0;
    for (int i = 0; i < challenge->n_point; i++) {
        double difference = objective_at(challenge, i, check) - b[0];
        for (int d = 0; d < n_draw; d++)
            difference -= trends->slope[d] * u_at(challenge, i)[d];
        rest += isnan(difference) ? 0 : difference * difference;
    }
    mark_clear(challenge, check, n, rest, trends);
    return true;
}

/* Points that the search has had with these scaled values; -1 when there is none. */
static int find_point(const CzChallenge *challenge, int begin, int end, const double *u) {
    const size_t size = (size_t)challenge->n_draw * sizeof *u;
    for (int i = begin; i < end; i++)
        if (memcmp(u_at(challenge, i), u, size) == 0)
            return i;
    return -1;
}

/* Adds a point: the best one of a check, moved to the end of the ranges along which it falls, of
 * all or of those with a clear trend. Returns whether it is new. */
static bool add_corner(CzChallenge *challenge, int next, int check, const Trends *trends,
                       bool of_all) {
    double *u = u_at(challenge, next);
    memcpy(u, u_at(challenge, best_point(challenge, check)), (size_t)challenge->n_draw * sizeof *u);
    for (int d = 0; d < challenge->n_draw; d++)
        if (of_all || trends->is_clear[d])
            u[d] = trends->slope[d] > 0 ? 0 : 1;
    return find_point(challenge, 0, next, u) < 0;
}

/* Corners by the trends of each check. */
static CzStatus corners(CzChallenge *challenge, int n_check, const int *check, CzError *error) {
    const int begin = challenge->n_point;
    CzArena arena = {0};
    Trends trends;
    int n = 0;
    for (int c = 0; c < n_check; c++) {
        const bool has_trends = find_trends(challenge, check[c], &arena, &trends);
        for (int k = 0; has_trends && k < 2 && begin + n < challenge->most_points; k++)
            n += add_corner(challenge, begin + n, check[c], &trends, k == 0);
    }
    const bool has_memory = !arena.out_of_memory;
    cz_arena_free(&arena);
    if (!has_memory)
        return cz_no_memory(error, "the corners of a challenge");
    return n > 0 ? run_new(challenge, n, "corner", error) : CZ_OK;
}

/* ---- adversaries ----------------------------------------------------------------------------- */

/* A scaled value on a fine grid, so that an algorithm that comes back meets the same point. */
static double on_grid(double u) {
    return round(u * 0x1p20) * 0x1p-20;
}

/* Evaluates points of an adversary; those that are known are not run again. */
static CzStatus evaluate(void *data, int n_point, const double *u, double *objective,
                         double *constraint, double *detail, CzError *error) {
    CzAdversary *own = data;
    CzChallenge *challenge = own->challenge;
    const size_t n_draw = (size_t)challenge->n_draw;
    (void)constraint;
    (void)detail;
    for (int k = 0; k < n_point; k++) {
        const int next = own->first + own->n_run;
        double *at = own->scaled;
        for (size_t d = 0; d < n_draw; d++)
            at[d] = on_grid(u[(size_t)k * n_draw + d]);
        int point = find_point(challenge, 0, challenge->n_point, at);
        if (point < 0)
            point = find_point(challenge, own->first, next, at);
        if (point < 0 && own->n_run == own->n)
            return CZ_STATUS_INTERRUPTED; /* no further point is allowed */
        if (point < 0) {
            point = next;
            memcpy(u_at(challenge, point), at, n_draw * sizeof *at);
            challenge->point[point].phase = own->phase;
            CZ_TRY(cz_challenge_run(challenge, point, 1, error));
            own->n_run++;
        }
        objective[k] = objective_at(challenge, point, own->check);
    }
    return CZ_OK;
}

CzStatus cz_adversary_run(CzAdversary *own, CzError *error) {
    CzChallenge *challenge = own->challenge;
    const int n = challenge->n_draw;
    CzArena arena = {0};
    double *zero = cz_arena_numbers(&arena, (size_t)n), *one = cz_arena_numbers(&arena, (size_t)n);
    own->scaled = cz_arena_numbers(&arena, (size_t)n);
    if (arena.out_of_memory)
        return cz_no_memory(error, "the search of a challenge");
    for (int d = 0; d < n; d++)
        one[d] = 1;
    const CzFunction function = {.n_variable = n,
                                 .min = zero,
                                 .max = one,
                                 .start = u_at(challenge, own->start),
                                 .step = zero,
                                 .is_minimax = true,
                                 .evaluate = evaluate,
                                 .data = own};
    CzOptimiseOptions options = cz_optimise_options_default();
    options.evaluations = 4 * (long)own->n + 4; /* known points count here */
    options.stop = challenge->parts->options.stop;
    CzSearch search;
    cz_search_init(&search, &function, &options);
    CzNloptRun run = cz_nlopt_run_default(own->algorithm);
    run.phase = own->phase;
    run.seed = (unsigned long)challenge->seed;
    run.first_step = own->first_step;
    run.tolerance = 2e-3; /* of the range */
    CzStatus status = cz_nlopt_run(&search, &run, function.start, error);
    if (status == CZ_OK && search.status != CZ_OK && search.status != CZ_STATUS_INTERRUPTED &&
        search.status != CZ_STATUS_RUN_FAILED) {
        status = search.status;
        if (error != NULL)
            *error = search.error;
    }
    cz_search_free(&search);
    cz_arena_free(&arena);
    return status;
}

static CzStatus run_task(int index, void *data, CzError *error) {
    CzAdversary *adversary = data;
    return cz_adversary_run(&adversary[index], error);
}

/* Runs adversaries side by side; each has its share of the points. */
static CzStatus run_round(CzChallenge *challenge, int n_adversary, CzAdversary *adversary,
                          CzError *error) {
    int next = challenge->n_point;
    for (int a = 0; a < n_adversary; a++) {
        adversary[a].challenge = challenge;
        adversary[a].first = next;
        next += adversary[a].n;
    }
    const CzTaskData plain = cz_adversaries_as_data(challenge);
    const CzStatus status = cz_tasks_share(&plain, n_adversary, run_task, adversary, error);
    for (int a = 0; a < n_adversary; a++)
        for (int k = 0; k < adversary[a].n; k++) {
            const int from = adversary[a].first + k;
            if (challenge->point[from].state == CZ_SAMPLE_NOT_RUN)
                continue;
            if (find_point(challenge, 0, challenge->n_point, u_at(challenge, from)) < 0)
                cz_challenge_move(challenge, from, challenge->n_point++);
            else
                cz_challenge_drop(challenge, from);
        }
    return status == CZ_OK && cz_challenge_is_stopped(challenge) ? CZ_STATUS_INTERRUPTED : status;
}

/* ---- choice of checks ------------------------------------------------------------------------ */

/* A check, and the smallest objective that was found. */
typedef struct Rank {
    double least;
    int check;
} Rank;

static int compare_rank(const void *one, const void *other) {
    const Rank *a = one, *b = other;
    if (a->least != b->least)
        return a->least < b->least ? -1 : 1;
    return a->check - b->check;
}

/* Selects checks with a margin: the smallest margins, and in turn with these the smallest that are
 * not broken yet; at most `most`. Status: CZ_STATUS_NO_MEMORY. */
static CzStatus choose_checks(const CzChallenge *challenge, int most, int *n, int *check,
                              CzError *error) {
    Rank *rank = malloc(((size_t)challenge->n_check + 1) * sizeof *rank);
    int n_rank = 0, n_broken = 0, n_chosen = 0;
    if (rank == NULL)
        return cz_no_memory(error, "the checks of a challenge");
    for (int c = 0; c < challenge->n_check; c++) {
        const int best = best_point(challenge, c);
        if (best >= 0)
            rank[n_rank++] = (Rank){objective_at(challenge, best, c), c};
    }
    qsort(rank, (size_t)n_rank, sizeof *rank, compare_rank);
    while (n_broken < n_rank && rank[n_broken].least < 0)
        n_broken++;
    for (int lowest = 0, whole = n_broken; n_chosen < most && n_chosen < n_rank;) {
        const bool is_broken = lowest < n_broken && (n_chosen % 2 == 0 || whole == n_rank);
        check[n_chosen++] = rank[is_broken ? lowest++ : whole++].check;
    }
    free(rank);
    *n = n_chosen;
    return CZ_OK;
}

/* ---- the search ------------------------------------------------------------------------------ */

static int left_of(const CzChallenge *challenge) {
    return challenge->most_points - challenge->n_point;
}

static int limited(const CzChallenge *challenge, double share) {
    const int n = (int)(share * challenge->most_points), left = left_of(challenge);
    return n < 1 && left > 0 ? 1 : n < left ? n : left;
}

/* DIRECT-L divides the whole space; CRS2 joins it where its share is larger than the population
 * with which it begins. */
static CzStatus search_global(CzChallenge *challenge, CzError *error) {
    const int n = limited(challenge, global_share), best = best_point(challenge, -1);
    const int n_population = 10 * (challenge->n_draw + 1);
    CzAdversary adversary[2] = {{.algorithm = "GN_DIRECT_L", .n = n}, {.algorithm = "GN_CRS2_LM"}};
    const int n_adversary = n / 2 > n_population ? 2 : 1;
    if (best < 0)
        return CZ_OK;
    for (int a = 0; a < n_adversary; a++) {
        adversary[a].check = -1;
        adversary[a].phase = "global";
        adversary[a].start = best;
        adversary[a].n = n / n_adversary;
    }
    return run_round(challenge, n_adversary, adversary, error);
}

/* COBYLA from the best points of some checks, as many as the points allow; later rounds take the
 * next checks in turn, and other first steps. */
static CzStatus search_local(CzChallenge *challenge, int round, CzError *error) {
    static const double first_steps[] = {0.2, 0.05, 0.4};
    int check[MAX_ADVERSARIES];
    CzAdversary adversary[MAX_ADVERSARIES];
    const int budget = (left_of(challenge) + 1) / 2;
    const int affords = budget / (RUNS_PER_DRAW * (challenge->n_draw + 1));
    const int most = affords < 1 ? 1 : affords > MAX_ADVERSARIES ? MAX_ADVERSARIES : affords;
    int n_ranked;
    CZ_TRY(choose_checks(challenge, MAX_ADVERSARIES, &n_ranked, check, error));
    const int n = most < n_ranked ? most : n_ranked;
    for (int a = 0; a < n; a++) {
        const int own = check[(round * n + a) % n_ranked];
        adversary[a] = (CzAdversary){.check = own,
                                     .algorithm = "LN_COBYLA",
                                     .phase = "local",
                                     .start = best_point(challenge, own),
                                     .n = budget / n,
                                     .first_step = first_steps[round % 3]};
    }
    return n > 0 ? run_round(challenge, n, adversary, error) : CZ_OK;
}

CzStatus cz_challenge_search(CzChallenge *challenge, CzError *error) {
    int check[MAX_ADVERSARIES];
    CZ_TRY(spread(challenge, limited(challenge, spread_share), error));
    const int share = limited(challenge, corner_share);
    const int n_corner = share < CORNER_CHECKS ? share : CORNER_CHECKS;
    for (int k = 0; k < CORNER_ROUNDS && left_of(challenge) > 0; k++) {
        int n;
        CZ_TRY(choose_checks(challenge, n_corner, &n, check, error));
        CZ_TRY(corners(challenge, n, check, error));
    }
    if (left_of(challenge) > 0)
        CZ_TRY(search_global(challenge, error));
    for (int round = 0; left_of(challenge) > 0; round++) {
        CZ_TRY(search_local(challenge, round, error));
        if (round > 0 && left_of(challenge) > 0) /* elsewhere, where the best points are known */
            CZ_TRY(spread(challenge, (left_of(challenge) + 3) / 4, error));
    }
    return CZ_OK;
}
