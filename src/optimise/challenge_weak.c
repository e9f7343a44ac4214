/* Weak points: selected among the points of the search, run in full, and listed worst first.
 *
 * Each check that fails is listed with its worst point, and again with points far from those listed
 * for it. Where nothing fails, the points with the smallest margins are listed. A point that passes
 * in full is replaced by the next one of its check.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "evaluate/tasks.h"
#include "optimise/challenge.h"

enum {
    MAX_TRIES = 4,    /* rounds of full runs */
    MAX_OF_CHECK = 2, /* points for one check */
    MAX_PASSING = 3   /* points that are listed where nothing fails */
};

/* Root mean square distances of scaled values: of another region, and of the same point. */
static const double far = 0.25, near = 0.05; /* ours */

/* A check at a point, or a point without a result. */
typedef struct Pair {
    int class; /* 0 without a result, 1 fails by margin, 2 fails without, 3 passes by margin */
    double margin;
    int point, check;
} Pair;

/* Pairs in order, and what is known of them. */
typedef struct Finder {
    CzChallenge *challenge;
    int n_pair;
    Pair *pair;     /* (n_pair) */
    bool *is_tried; /* points that were run in full (n_point) */
    int n_chosen;
    Pair *chosen; /* those whose full run is listed, then those of this round (most_weak) */
} Finder;

static int compare_pair(const void *one, const void *other) {
    const Pair *a = one, *b = other;
    if (a->class != b->class)
        return a->class - b->class;
    if (a->margin != b->margin)
        return a->margin < b->margin ? -1 : 1;
    return a->point != b->point ? a->point - b->point : a->check - b->check;
}

/* ---- selection ------------------------------------------------------------------------------- */

static void add_pair(Finder *finder, int class, double margin, int point, int check) {
    finder->pair[finder->n_pair++] = (Pair){class, margin, point, check};
}

static void list_pairs(Finder *finder) {
    const CzChallenge *challenge = finder->challenge;
    for (int i = 0; i < challenge->n_point; i++) {
        const CzChallengePoint *point = &challenge->point[i];
        bool fails = false;
        if (point->state != CZ_SAMPLE_DONE)
            add_pair(finder, 0, 0, i, -1);
        for (int c = 0; c < challenge->n_check; c++) {
            const long at = (long)i * challenge->n_check + c;
            const double margin = cz_challenge_margin(challenge, i, c);
            if (challenge->verdict[at] == CZ_VERDICT_FAIL)
                add_pair(finder, isnan(margin) ? 2 : 1, isnan(margin) ? 0 : margin, i, c);
            else if (isfinite(margin))
                add_pair(finder, 3, margin, i, c);
            fails |= challenge->verdict[at] == CZ_VERDICT_FAIL;
        }
        if (!fails && point->state == CZ_SAMPLE_DONE && point->verdict == CZ_VERDICT_FAIL)
            add_pair(finder, 2, 0, i, -1); /* a vehicle climbed, and no check says so */
    }
    qsort(finder->pair, (size_t)finder->n_pair, sizeof *finder->pair, compare_pair);
}

static double distance(const CzChallenge *challenge, int a, int b) {
    const double *u = challenge->parts->u;
    const long n = challenge->n_draw;
    double sum = 0;
    for (long d = 0; d < n; d++)
        sum += (u[a * n + d] - u[b * n + d]) * (u[a * n + d] - u[b * n + d]);
    return sqrt(sum / (double)n);
}

/* Whether a chosen point stands for a pair: it fails the same check there, or nearby. In the first
 * pass, one point for each check is enough. */
static bool is_covered(const Finder *finder, const Pair *pair, bool first_pass) {
    const CzChallenge *challenge = finder->challenge;
    for (int i = 0; i < finder->n_chosen; i++) {
        const Pair *chosen = &finder->chosen[i];
        const bool is_same = chosen->check == pair->check && chosen->class == pair->class;
        if (chosen->point == pair->point && pair->class == 3)
            return true;
        const bool fails_too =
            pair->check >= 0 &&
            challenge->verdict[(long)chosen->point * challenge->n_check + pair->check] ==
                CZ_VERDICT_FAIL;
        const double apart = distance(challenge, chosen->point, pair->point);
        if (is_same ? first_pass || apart < far : fails_too && apart < near)
            return true;
    }
    return false;
}

/* How often a check is chosen. */
static int n_of_check(const Finder *finder, const Pair *pair) {
    int n = 0;
    for (int i = 0; i < finder->n_chosen; i++)
        n += finder->chosen[i].check == pair->check && finder->chosen[i].class == pair->class;
    return n;
}

/* Chooses pairs up to a class that are not covered, at most `most` in all. */
static void choose(Finder *finder, int class, bool first_pass, int most) {
    for (int i = 0; i < finder->n_pair && finder->n_chosen < most; i++) {
        const Pair *pair = &finder->pair[i];
        if (pair->class > class || finder->is_tried[pair->point] ||
            n_of_check(finder, pair) >= MAX_OF_CHECK || is_covered(finder, pair, first_pass))
            continue;
        finder->chosen[finder->n_chosen++] = *pair;
    }
}

/* ---- full runs ------------------------------------------------------------------------------- */

CzStatus cz_full_run(CzFullRun *run, CzError *error) {
    CzChallenge *challenge = run->challenge;
    CzEvaluation evaluation = {0};
    CzError mistake = {0};
    CzStatus status = cz_case_bench_build(&challenge->parts->cases, 1, &run->point,
                                          challenge->value, &run->bench, &mistake);
    if (status == CZ_STATUS_INPUT) {
        run->judged =
            (CzJudgedCase){.state = CZ_SAMPLE_INVALID, .verdict = CZ_VERDICT_FAIL, .check = -1};
        run->judged.message = malloc(sizeof mistake.message);
        if (run->judged.message == NULL)
            return cz_no_memory(error, "a weak point");
        memcpy(run->judged.message, mistake.message, sizeof mistake.message);
        return CZ_OK;
    }
    if (status != CZ_OK && error != NULL)
        *error = mistake;
    CZ_TRY(status);
    CZ_TRY(cz_evaluator_repeat(run->bench.evaluator, 1, &run->bench.evaluator->manner,
                               challenge->parts->x, &evaluation, error));
    run->result = malloc(((size_t)challenge->n_check + 1) * sizeof *run->result);
    status = run->result != NULL ? cz_challenge_judge(challenge, &run->bench, &evaluation, 0,
                                                      run->result, &run->judged, error)
                                 : cz_no_memory(error, "a weak point");
    cz_evaluation_free(&evaluation);
    return status;
}

void cz_full_run_free(CzFullRun *run) {
    free(run->judged.message);
    free(run->result);
    cz_case_bench_free(&run->bench);
    cz_arena_free(&run->texts);
}

static CzStatus run_task(int index, void *data, CzError *error) {
    CzFullRun *run = data;
    return cz_full_run(&run[index], error);
}

static const char *keep(CzChallenge *challenge, const char *text) {
    return text == NULL ? NULL : cz_arena_copy_text(&challenge->parts->arena, text, strlen(text));
}

/* The check for which a full run is listed: that of its pair where it fails, else the worst; of a
 * run that failed none that passes. */
static int check_of(const CzFullRun *run, const Pair *pair) {
    const int own = pair->check, worst = run->judged.check;
    if (run->result == NULL)
        return -1;
    if (own >= 0 &&
        (run->judged.verdict != CZ_VERDICT_FAIL || run->result[own].verdict == CZ_VERDICT_FAIL))
        return own;
    return worst >= 0 && run->result[worst].verdict == CZ_VERDICT_FAIL ? worst : -1;
}

static CzStatus add_weak(CzChallenge *challenge, CzFullRun *run, const Pair *pair, CzError *error) {
    CzWeakPoint *weak = &challenge->weak[challenge->n_weak++];
    const int check = check_of(run, pair);
    *weak = (CzWeakPoint){.point = pair->point,
                          .state = run->judged.state,
                          .verdict = run->judged.verdict,
                          .beyond_validity = run->judged.beyond_validity,
                          .n_fail = run->judged.n_fail,
                          .scenario = challenge->scenario[0],
                          .message = run->judged.message};
    run->judged.message = NULL;
    weak->check = (CzCheckResult){.limit = NAN, .value = NAN, .margin = NAN, .when = {NAN, NAN}};
    if (check < 0)
        return CZ_OK;
    CzCheckResult *kept = &weak->check;
    *kept = run->result[check];
    kept->name = challenge->check[check].name;
    kept->scenario = challenge->check[check].scenario;
    kept->family = NULL;
    kept->unit = keep(challenge, kept->unit);
    kept->why = keep(challenge, kept->why);
    kept->profile = keep(challenge, kept->profile);
    kept->clause = keep(challenge, kept->clause);
    kept->source = keep(challenge, kept->source);
    kept->confidence = keep(challenge, kept->confidence);
    weak->scenario = challenge->scenario[challenge->parts->checks.check[check].scenario];
    return challenge->parts->arena.out_of_memory ? cz_no_memory(error, "a weak point") : CZ_OK;
}

/* Runs the pairs chosen from `first` on, and lists those that fail, or all. A run that fails in
 * full only says nothing of its check, for which the next point is tried. */
static CzStatus confirm(Finder *finder, int first, bool lists_passing, CzError *error) {
    CzChallenge *challenge = finder->challenge;
    const int n = finder->n_chosen - first;
    const Pair *chosen = &finder->chosen[first];
    CzFullRun *run = calloc((size_t)n + 1, sizeof *run);
    if (run == NULL)
        return cz_no_memory(error, "the weak points");
    for (int i = 0; i < n; i++) {
        run[i].challenge = challenge;
        run[i].point = chosen[i].point;
        finder->is_tried[run[i].point] = true;
    }
    const CzTaskData plain = cz_full_runs_as_data(challenge);
    CzStatus status = cz_tasks_share(&plain, n, run_task, run, error);
    finder->n_chosen = first;
    for (int i = 0; i < n; i++) {
        Pair pair = chosen[i]; /* its place may be taken by an earlier one that remains */
        const bool fails = run[i].judged.verdict == CZ_VERDICT_FAIL;
        challenge->is_broken |= fails;
        if (run[i].judged.state != CZ_SAMPLE_DONE)
            pair = (Pair){.point = pair.point, .check = -1};
        const bool is_new = pair.check >= 0 || !is_covered(finder, &pair, true);
        if (status == CZ_OK && (fails || lists_passing) && is_new) {
            finder->chosen[finder->n_chosen++] = pair;
            status = add_weak(challenge, &run[i], &pair, error);
        }
        cz_full_run_free(&run[i]);
    }
    free(run);
    return status;
}

/* ---- the list -------------------------------------------------------------------------------- */

static int class_of(const CzWeakPoint *weak) {
    if (weak->state != CZ_SAMPLE_DONE)
        return 0;
    if (weak->verdict != CZ_VERDICT_FAIL)
        return 3;
    return isnan(weak->check.margin) ? 2 : 1;
}

static int compare_weak(const void *one, const void *other) {
    const CzWeakPoint *a = one, *b = other;
    const Pair mine = {class_of(a), isnan(a->check.margin) ? 0 : a->check.margin, a->point, 0};
    const Pair theirs = {class_of(b), isnan(b->check.margin) ? 0 : b->check.margin, b->point, 0};
    return compare_pair(&mine, &theirs);
}

/* Sorts the list, and drops points that pass from one with a point that fails. */
static void order(CzChallenge *challenge) {
    int n = 0;
    qsort(challenge->weak, (size_t)challenge->n_weak, sizeof *challenge->weak, compare_weak);
    for (int i = 0; i < challenge->n_weak; i++) {
        if (!challenge->is_broken || challenge->weak[i].verdict == CZ_VERDICT_FAIL)
            challenge->weak[n++] = challenge->weak[i];
        else
            free(challenge->weak[i].message);
    }
    challenge->n_weak = n;
}

static CzStatus find(Finder *finder, CzError *error) {
    CzChallenge *challenge = finder->challenge;
    const int most = challenge->parts->options.most_weak;
    list_pairs(finder);
    for (int round = 0; round < MAX_TRIES; round++) {
        const int first = finder->n_chosen;
        choose(finder, 2, true, most);
        choose(finder, 2, false, most);
        if (finder->n_chosen == first)
            break;
        CZ_TRY(confirm(finder, first, false, error));
    }
    if (!challenge->is_broken) {
        choose(finder, 3, true, most < MAX_PASSING ? most : MAX_PASSING);
        CZ_TRY(confirm(finder, 0, true, error));
    }
    order(challenge);
    return CZ_OK;
}

CzStatus cz_challenge_find_weak(CzChallenge *challenge, CzError *error) {
    const size_t n_point = (size_t)challenge->n_point;
    const size_t most = (size_t)challenge->parts->options.most_weak + 1;
    Finder finder = {
        .challenge = challenge,
        .pair = malloc((n_point * ((size_t)challenge->n_check + 2) + 1) * sizeof *finder.pair),
        .is_tried = calloc(n_point + 1, sizeof *finder.is_tried),
        .chosen = malloc(most * sizeof *finder.chosen)};
    challenge->weak = calloc(most, sizeof *challenge->weak);
    CzStatus status = CZ_STATUS_NO_MEMORY;
    if (finder.pair == NULL || finder.is_tried == NULL || finder.chosen == NULL ||
        challenge->weak == NULL)
        cz_no_memory(error, "the weak points");
    else
        status = find(&finder, error);
    free(finder.pair);
    free(finder.is_tried);
    free(finder.chosen);
    return status;
}
