/* A problem as bytes. The other process does the same steps, so that all values are the same bits:
 * a resolved file would do for a problem, but not for factors on values of its own file. */
#include "problem/problem_bytes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "problem/reading.h"
#include "problem/varying.h"

/* Behind the last step. */
enum { END = -1 };

/* ---- to bytes -------------------------------------------------------------------------------- */

static void put_read(CzMemoryText *bytes, const CzProblem *problem) {
    cz_put_text(bytes, problem->file);
    cz_put_text(bytes, problem->text.byte);
    cz_put_text(bytes, problem->text.folder);
    cz_put_text(bytes, problem->given.share_folder);
    cz_put_texts(bytes, problem->given.n_set, problem->given.set);
    cz_put_text(bytes, problem->hash);
}

static void put_settings(CzMemoryText *bytes, const CzProblem *problem) {
    cz_put_int(bytes, problem->n_added);
    for (int i = problem->n_setting - problem->n_added; i < problem->n_setting; i++) {
        cz_put_text(bytes, problem->setting[i].path);
        cz_put_text(bytes, problem->setting[i].put.value->text);
    }
}

/* A scenario as cases.c has written it. */
static void put_case(CzMemoryText *bytes, const CzNode *scenario) {
    const CzNode *changes = cz_node_find_list(scenario, "changes")->value;
    cz_put_text(bytes, cz_node_find_text(scenario, "name"));
    cz_put_text(bytes, cz_node_find_text(scenario, "like"));
    cz_put_int(bytes, strcmp(cz_node_find_text(scenario, "reserves"), "true") == 0);
    cz_put_int(bytes, changes->n_entry);
    for (int i = 0; i < changes->n_entry; i++) {
        const CzEntry *entry = changes->entry[i].value->entry; /* path; value, factor or add */
        cz_put_text(bytes, entry[0].value->text);
        cz_put_text(bytes, entry[1].key->text);
        cz_put_text(bytes, entry[1].value->text);
    }
}

static void put_cases(CzMemoryText *bytes, const CzProblem *problem) {
    const CzNode *list = cz_node_find_list(problem->tree.root, "scenarios")->value;
    cz_put_int(bytes, problem->n_added);
    for (int i = list->n_entry - problem->n_added; i < list->n_entry; i++)
        put_case(bytes, list->entry[i].value);
}

/* Variables as varying.c has written them. */
static void put_varying(CzMemoryText *bytes, const CzProblem *problem) {
    const CzNode *optimise = cz_node_find(problem->tree.root, "optimise")->value;
    const CzNode *list = cz_node_find_list(optimise, "variables")->value;
    cz_put_int(bytes, list->n_entry);
    for (int i = 0; i < list->n_entry; i++) {
        const CzNode *variable = list->entry[i].value;
        cz_put_text(bytes, cz_node_find_text(variable, "path"));
        cz_put_text(bytes, cz_node_find_text(variable, "min"));
        cz_put_text(bytes, cz_node_find_text(variable, "max"));
    }
}

static void put_step(CzMemoryText *bytes, const CzProblem *problem) {
    if (problem->origin != NULL)
        put_step(bytes, problem->origin);
    cz_put_int(bytes, (int)problem->step);
    if (problem->step == CZ_STEP_READ)
        put_read(bytes, problem);
    else if (problem->step == CZ_STEP_SETTINGS)
        put_settings(bytes, problem);
    else if (problem->step == CZ_STEP_CASES)
        put_cases(bytes, problem);
    else if (problem->step == CZ_STEP_VARYING)
        put_varying(bytes, problem);
    else /* a worker cannot take this step: the owner runs all tasks */
        bytes->failed = true;
}

void cz_problem_put(CzMemoryText *bytes, const CzProblem *problem) {
    put_step(bytes, problem);
    cz_put_int(bytes, END);
}

/* ---- from bytes ------------------------------------------------------------------------------ */

static CzStatus get_read(CzReading *reading, CzArena *arena, CzProblem **problem, CzError *error) {
    CzProblemOptions options;
    const char *file = cz_get_text(reading, arena), *text = cz_get_text(reading, arena);
    const char *folder = cz_get_text(reading, arena);
    options.share_folder = cz_get_text(reading, arena);
    options.set = cz_get_texts(reading, arena, &options.n_set);
    const char *hash = cz_get_text(reading, arena);
    if (file == NULL || hash == NULL || options.set == NULL)
        return cz_no_memory(error, "a problem");
    CZ_TRY(text != NULL
               ? cz_problem_read_text(text, strlen(text), file, folder, &options, problem, error)
               : cz_problem_read(file, &options, problem, error));
    return strcmp(cz_problem_hash(*problem), hash) == 0
               ? CZ_OK
               : cz_fail(error, CZ_STATUS_INPUT,
                         "%.300s or a file that it uses is another one for this worker", file);
}

static CzStatus get_settings(CzReading *reading, CzArena *arena, const CzProblem *origin,
                             CzProblem **problem, CzError *error) {
    const int n = cz_get_int(reading);
    const bool is_short = n < 0 || (size_t)n > reading->n_left;
    const size_t room = is_short ? 1 : (size_t)n + 1;
    const char **path = cz_arena_allocate(arena, room, sizeof *path);
    const char **value = cz_arena_allocate(arena, room, sizeof *value);
    if (is_short || path == NULL || value == NULL)
        return cz_no_memory(error, "a problem");
    for (int i = 0; i < n; i++) {
        path[i] = cz_get_text(reading, arena);
        value[i] = cz_get_text(reading, arena);
    }
    return arena->out_of_memory || reading->has_ended
               ? cz_no_memory(error, "a problem")
               : cz_problem_read_again(origin, n, path, value, problem, error);
}

static CzStatus get_change(CzReading *reading, CzArena *arena, CzCaseChange *change,
                           CzError *error) {
    change->path = cz_get_text(reading, arena);
    const char *kind = cz_get_text(reading, arena), *number = cz_get_text(reading, arena);
    if (change->path == NULL || kind == NULL || number == NULL ||
        !cz_number_scan(number, &change->number))
        return cz_no_memory(error, "a problem");
    change->kind = strcmp(kind, "factor") == 0 ? CZ_CASE_FACTOR
                   : strcmp(kind, "add") == 0  ? CZ_CASE_ADD
                                               : CZ_CASE_VALUE;
    return CZ_OK;
}

static CzStatus get_case(CzReading *reading, CzArena *arena, const CzProblem *origin, CzCase *made,
                         CzError *error) {
    made->name = cz_get_text(reading, arena);
    const char *like = cz_get_text(reading, arena);
    made->reserves = cz_get_int(reading) != 0;
    made->n_change = cz_get_int(reading);
    CzCaseChange *change = NULL;
    if (made->n_change >= 0 && (size_t)made->n_change <= reading->n_left)
        change = cz_arena_allocate(arena, (size_t)made->n_change + 1, sizeof *change);
    if (made->name == NULL || like == NULL || change == NULL)
        return cz_no_memory(error, "a problem");
    made->change = change;
    for (int i = 0; i < made->n_change; i++)
        CZ_TRY(get_change(reading, arena, &change[i], error));
    return cz_problem_find_scenario(origin, like, &made->scenario, error);
}

static CzStatus get_cases(CzReading *reading, CzArena *arena, const CzProblem *origin,
                          CzProblem **problem, CzError *error) {
    const int n = cz_get_int(reading);
    CzCase *made = NULL;
    if (n >= 0 && (size_t)n <= reading->n_left)
        made = cz_arena_allocate(arena, (size_t)n + 1, sizeof *made);
    if (made == NULL)
        return cz_no_memory(error, "a problem");
    for (int i = 0; i < n; i++)
        CZ_TRY(get_case(reading, arena, origin, &made[i], error));
    return cz_problem_read_cases(origin, n, made, problem, error);
}

/* Numbers with the ranges of their variables. */
static CzStatus get_varying(CzReading *reading, CzArena *arena, const CzProblem *origin,
                            CzProblem **problem, CzError *error) {
    const int n = cz_get_int(reading);
    CzVaryingNumber *number = NULL;
    if (n >= 0 && (size_t)n <= reading->n_left)
        number = cz_arena_allocate(arena, (size_t)n + 1, sizeof *number);
    if (number == NULL)
        return cz_no_memory(error, "a problem");
    for (int i = 0; i < n; i++) {
        const char *path = cz_get_text(reading, arena);
        const char *min = cz_get_text(reading, arena), *max = cz_get_text(reading, arena);
        if (path == NULL || min == NULL || max == NULL || !cz_number_scan(min, &number[i].min) ||
            !cz_number_scan(max, &number[i].max))
            return cz_no_memory(error, "a problem");
        snprintf(number[i].path, sizeof number[i].path, "%s", path);
        number[i].size = INFINITY; /* so that the range alone is the limit */
    }
    return cz_problem_read_varying(origin, n, number, problem, error);
}

static CzStatus get_step(CzReading *reading, CzArena *arena, int step, CzProblemSteps *steps,
                         CzError *error) {
    CzProblem **next = &steps->step[steps->n];
    const CzProblem *origin = steps->n > 0 ? steps->step[steps->n - 1] : NULL;
    *next = NULL;
    steps->n++;
    if (step == CZ_STEP_READ && origin == NULL)
        return get_read(reading, arena, next, error);
    if (step == CZ_STEP_SETTINGS && origin != NULL)
        return get_settings(reading, arena, origin, next, error);
    if (step == CZ_STEP_CASES && origin != NULL)
        return get_cases(reading, arena, origin, next, error);
    if (step == CZ_STEP_VARYING && origin != NULL)
        return get_varying(reading, arena, origin, next, error);
    return cz_fail(error, CZ_STATUS_INPUT, "a worker cannot make this problem");
}

CzStatus cz_problem_get(CzReading *reading, CzProblemSteps *steps, CzError *error) {
    CzArena arena = {0};
    CzStatus status = CZ_OK;
    *steps = (CzProblemSteps){0};
    for (int step = cz_get_int(reading); status == CZ_OK && step != END;
         step = status == CZ_OK ? cz_get_int(reading) : END)
        status = steps->n < CZ_MAX_STEPS && !reading->has_ended
                     ? get_step(reading, &arena, step, steps, error)
                     : cz_no_memory(error, "a problem");
    cz_arena_free(&arena);
    return status;
}

void cz_problem_steps_free(CzProblemSteps *steps) {
    while (steps->n > 0)
        cz_problem_free(steps->step[--steps->n]);
}
