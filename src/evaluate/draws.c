/* Draws: parameters of `uncertainty:` to random numbers and their values.
 *
 *   path --problem/find.c--> places --group--> draws --u of Latin hypercube or Sobol--> values
 */
#include "evaluate/draws.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "problem/keys.h"
#include "statistics/distribution.h"
#include "statistics/latin.h"
#include "statistics/random.h"
#include "statistics/sobol.h"
#include "text/units.h"

/* ---- list ------------------------------------------------------------------------------------ */

/* A parameter while its draws are listed. */
typedef struct Lister {
    const CzProblem *problem;
    CzArena *arena;
    CzError *error;
    const CzScatter *scatter;
    const CzTexts *paths;
    CzTargets targets; /* of all paths */
    CzDraw like;       /* what its draws have in common */
    int n, room;
    CzDraw *draw; /* of all parameters, in the arena (room) */
} Lister;

static const char *keep(const Lister *lister, const char *text) {
    return cz_arena_copy_text(lister->arena, text, strlen(text));
}

static CzStatus no_memory(const Lister *lister) {
    return cz_no_memory(lister->error, "the draws of a sample");
}

/* Reads the numbers of a list and their range. */
static CzStatus read_values(Lister *lister) {
    const CzTexts *values = &lister->scatter->values;
    double *value = cz_arena_allocate(lister->arena, (size_t)values->n_text, sizeof *value);
    if (value == NULL)
        return no_memory(lister);
    for (int i = 0; i < values->n_text; i++) {
        const char *fault = cz_number_parse(values->text[i], &value[i]);
        if (fault != NULL)
            return cz_problem_fail(lister->problem, &lister->scatter->values, lister->error,
                                   "'%.60s' %s", values->text[i], fault);
        lister->like.low = i == 0 ? value[i] : fmin(lister->like.low, value[i]);
        lister->like.high = i == 0 ? value[i] : fmax(lister->like.high, value[i]);
    }
    lister->like.distribution = "values";
    lister->like.n_value = values->n_text;
    lister->like.value = value;
    return CZ_OK;
}

/* Range and effect of a parameter. */
static CzStatus set_range(Lister *lister) {
    const CzScatter *scatter = lister->scatter;
    CzDraw *draw = &lister->like;
    const bool is_lognormal = scatter->distribution == CZ_DISTRIBUTION_LOGNORMAL;
    draw->distribution = cz_word_sets[CZ_WORDS_DISTRIBUTION].word[scatter->distribution].word;
    if (scatter->values.n_text > 0)
        return read_values(lister);
    if (!isnan(scatter->tolerance_percent)) {
        const double share = scatter->tolerance_percent / 100;
        draw->effect = CZ_DRAW_FACTOR;
        draw->high = 1 + share;
        draw->low = is_lognormal ? 1 / draw->high : 1 - share;
    } else if (!isnan(scatter->tolerance)) {
        draw->effect = CZ_DRAW_ADD;
        draw->low = -scatter->tolerance;
        draw->high = scatter->tolerance;
    } else {
        draw->low = scatter->min;
        draw->high = scatter->max;
    }
    if (is_lognormal && !(draw->low > 0))
        return cz_problem_fail(lister->problem, &scatter->distribution, lister->error,
                               "a lognormal number is above 0: give 'tolerance_percent', or 'min' "
                               "and 'max' above 0");
    return CZ_OK;
}

/* Appends the draw of some paths; `of` names its part or place, NULL for all places. */
static bool add(Lister *lister, int n_path, const char *const *path, const char *of, int n_place) {
    char name[CZ_LABEL_SIZE + CZ_PATH_SIZE + 4];
    if (lister->n == lister->room) {
        const int room = 2 * lister->room + 8;
        CzDraw *more = cz_arena_allocate(lister->arena, (size_t)room, sizeof *more);
        if (more == NULL)
            return false;
        if (lister->n > 0)
            memcpy(more, lister->draw, (size_t)lister->n * sizeof *more);
        lister->draw = more;
        lister->room = room;
    }
    if (lister->scatter->name == NULL)
        snprintf(name, sizeof name, "%s", path[0]);
    else
        snprintf(name, sizeof name, "%s%s%s", lister->scatter->name, of != NULL ? ", " : "",
                 of != NULL ? of : "");
    CzDraw *draw = &lister->draw[lister->n++];
    *draw = lister->like;
    draw->name = keep(lister, name);
    draw->n_path = n_path;
    draw->path = path;
    draw->n_place = n_place;
    return draw->name != NULL;
}

/* Length of "parts.NAME" at the start of a place. */
static size_t part_length(const char *place) {
    const char *dot = strchr(place, '.');
    return dot != NULL ? (size_t)(dot + 1 - place) + strcspn(dot + 1, ".[") : strlen(place);
}

static bool same_part(const char *a, const char *b) {
    const size_t n = part_length(a);
    return n == part_length(b) && strncmp(a, b, n) == 0;
}

/* Number of targets that have the part of the i-th one; 0 when it is not the first of them. */
static int n_of_part(const CzTargets *targets, int i) {
    int n = 0;
    for (int k = 0; k < targets->n; k++) {
        if (!same_part(targets->target[k].place, targets->target[i].place))
            continue;
        if (k < i)
            return 0;
        n++;
    }
    return n;
}

/* Adds the draw of the part of the i-th target: every path of the parameter that names this part,
 * with its name in place of the star. */
static bool add_part(Lister *lister, int i, int n_place) {
    const char *place = lister->targets.target[i].place;
    const size_t n = part_length(place);
    const char **path =
        cz_arena_allocate(lister->arena, (size_t)lister->paths->n_text, sizeof *path);
    int n_path = 0;
    for (int k = 0; path != NULL && k < lister->paths->n_text; k++) {
        const char *pattern = lister->paths->text[k];
        char text[CZ_PATH_SIZE];
        const bool is_any = strncmp(pattern, "parts.*", 7) == 0;
        if (!is_any && !same_part(pattern, place))
            continue;
        snprintf(text, sizeof text, "%.*s%s", (int)n, place, pattern + part_length(pattern));
        path[n_path] = keep(lister, text);
        if (path[n_path++] == NULL)
            return false;
    }
    char of[CZ_PATH_SIZE];
    snprintf(of, sizeof of, "%.*s", (int)(n - 6), place + 6);
    return path != NULL && add(lister, n_path, path, of, n_place);
}

static bool add_parts(Lister *lister) {
    for (int i = 0; i < lister->targets.n; i++) {
        const int n_place = n_of_part(&lister->targets, i);
        if (n_place > 0 && !add_part(lister, i, n_place))
            return false;
    }
    return true;
}

/* Adds a draw for each place; the targets of one match are one place. */
static bool add_places(Lister *lister) {
    const CzTargets *targets = &lister->targets;
    for (int i = 0, next; i < targets->n; i = next) {
        for (next = i + 1; next < targets->n &&
                           strcmp(targets->target[next].place, targets->target[i].place) == 0;)
            next++;
        const char **path = cz_arena_allocate(lister->arena, 1, sizeof *path);
        if (path == NULL || (*path = keep(lister, targets->target[i].place)) == NULL ||
            !add(lister, 1, path, *path, next - i))
            return false;
    }
    return true;
}

/* The unit of a path's key: its suffix, "" for none. */
static const char *suffix_of(const char *path) {
    const char *dot = strrchr(path, '.'), *key = dot != NULL ? dot + 1 : path;
    const char *suffix = key + cz_key_stem_length(key);
    return suffix[0] == '_' ? suffix + 1 : suffix;
}

/* The same for people, such as "MN/m" for MN_m. */
static const char *symbol_of(const char *suffix) {
    for (int i = 0; i < cz_n_unit; i++)
        if (strcmp(cz_units[i].suffix, suffix) == 0)
            return cz_units[i].symbol;
    return "";
}

/* Finds the places of all paths of a parameter. A value that is set or added needs one unit. */
static CzStatus find_places(Lister *lister, int scenario) {
    const CzScatter *scatter = lister->scatter;
    const void *field = scatter->path != NULL ? (const void *)&scatter->path : &scatter->paths;
    const char *unit = suffix_of(lister->paths->text[0]);
    for (int i = 0; i < lister->paths->n_text; i++) {
        const char *path = lister->paths->text[i];
        CZ_TRY(cz_problem_place_failure(lister->problem, field,
                                        cz_problem_find_changed(lister->problem, scenario, path,
                                                                &lister->targets, lister->error),
                                        lister->error));
        if (strcmp(suffix_of(path), unit) != 0 && lister->like.effect != CZ_DRAW_FACTOR)
            return cz_problem_fail(lister->problem, field, lister->error,
                                   "the paths have different units: '%.20s' and '%.20s'", unit,
                                   suffix_of(path));
    }
    lister->like.unit = lister->like.effect == CZ_DRAW_FACTOR ? "" : symbol_of(unit);
    return CZ_OK;
}

static CzStatus add_parameter(Lister *lister, int scenario) {
    const CzScatter *scatter = lister->scatter;
    CZ_TRY(set_range(lister));
    CZ_TRY(find_places(lister, scenario));
    const int n_place = lister->targets.n;
    bool fits;
    if (scatter->group == CZ_GROUP_PART)
        fits = add_parts(lister);
    else if (scatter->group == CZ_GROUP_EACH && n_place > 0)
        fits = add_places(lister);
    else /* a key of a scenario that is not written has no place that could be found */
        fits = add(lister, lister->paths->n_text, lister->paths->text, NULL,
                   n_place > 0 ? n_place : 1);
    return fits ? CZ_OK : no_memory(lister);
}

CzStatus cz_draws_list(const CzProblem *problem, int scenario, CzArena *arena, int *n_draw,
                       CzDraw **draw, CzError *error) {
    const CzUncertainty *uncertainty = &cz_problem_input(problem)->uncertainty;
    Lister lister = {.problem = problem, .arena = arena, .error = error};
    for (int i = 0; i < uncertainty->n_parameters; i++) {
        lister.scatter = &uncertainty->parameters[i];
        lister.like = (CzDraw){.effect = CZ_DRAW_VALUE};
        lister.targets = (CzTargets){0};
        const CzTexts single = {1, &lister.scatter->path};
        lister.paths = lister.scatter->path != NULL ? &single : &lister.scatter->paths;
        const CzStatus status = add_parameter(&lister, scenario);
        free(lister.targets.target);
        CZ_TRY(status);
    }
    *n_draw = lister.n;
    *draw = lister.draw;
    return CZ_OK;
}

CzStatus cz_draw_of_span(const CzProblem *problem, int scenario, const CzSpan *span, CzDraw *draw,
                         CzError *error) {
    CzTargets targets = {0};
    CZ_TRY(cz_problem_place_failure(
        problem, &span->path,
        cz_problem_find_changed(problem, scenario, span->path, &targets, error), error));
    *draw = (CzDraw){.name = span->name != NULL ? span->name : span->path,
                     .n_path = 1,
                     .path = &span->path,
                     .effect = CZ_DRAW_VALUE,
                     .unit = symbol_of(suffix_of(span->path)),
                     .distribution = "envelope",
                     .low = span->min,
                     .high = span->max,
                     .n_place = targets.n};
    free(targets.target);
    return CZ_OK;
}

/* ---- values ---------------------------------------------------------------------------------- */

/* Value of a draw at u within (0, 1). */
static double value_at(const CzDraw *draw, int distribution, double u) {
    if (draw->n_value > 0)
        return draw->value[cz_discrete_index(u, draw->n_value)];
    switch ((CzDistribution)distribution) {
    case CZ_DISTRIBUTION_NORMAL:
        return cz_normal_value(u, draw->low, draw->high);
    case CZ_DISTRIBUTION_TRIANGULAR:
        return cz_triangular_value(u, draw->low, draw->high);
    case CZ_DISTRIBUTION_LOGNORMAL:
        return cz_lognormal_value(u, draw->low, draw->high);
    case CZ_DISTRIBUTION_UNIFORM:
        break;
    }
    return cz_uniform_value(u, draw->low, draw->high);
}

/* Values of one draw in all samples, within (0, 1); u is (n). */
static void fill_units(CzSamplingMethod method, long seed, int draw, int n, double *u) {
    if (method == CZ_SAMPLING_SOBOL) {
        cz_sobol_draw((uint64_t)seed, draw, n, u);
    } else if (method == CZ_SAMPLING_LATIN_HYPERCUBE) {
        cz_latin_draw((uint64_t)seed, draw, n, u);
    } else {
        for (int k = 0; k < n; k++)
            u[k] = cz_random_unit((uint64_t)seed, CZ_RANDOM_PLACE, draw, k);
    }
}

/* The distribution of a draw, by its word. */
static int distribution_of(const CzDraw *draw) {
    const CzWordSet *set = &cz_word_sets[CZ_WORDS_DISTRIBUTION];
    for (int i = 0; i < set->n_word; i++)
        if (strcmp(set->word[i].word, draw->distribution) == 0)
            return i;
    return CZ_DISTRIBUTION_UNIFORM;
}

CzStatus cz_draws_fill(const CzProblem *problem, long seed, int n, int n_draw, const CzDraw *draw,
                       double *value, CzError *error) {
    const CzUncertainty *uncertainty = &cz_problem_input(problem)->uncertainty;
    const CzSamplingMethod method = (CzSamplingMethod)uncertainty->sampling;
    if (method == CZ_SAMPLING_SOBOL && n_draw > CZ_SOBOL_MAX_DRAWS)
        return cz_problem_fail(problem, &uncertainty->sampling, error,
                               "'sobol' has points of at most %d dimensions, and the parameters "
                               "have %d draws" CZ_HELP "use 'sampling: latin_hypercube'",
                               (int)CZ_SOBOL_MAX_DRAWS, n_draw);
    double *u = malloc((size_t)n * sizeof *u);
    if (u == NULL)
        return cz_no_memory(error, "the values of a sample");
    for (int d = 0; d < n_draw; d++) {
        const int distribution = distribution_of(&draw[d]);
        fill_units(method, seed, d, n, u);
        for (int k = 0; k < n; k++)
            value[(size_t)k * (size_t)n_draw + (size_t)d] = value_at(&draw[d], distribution, u[k]);
    }
    free(u);
    return CZ_OK;
}
