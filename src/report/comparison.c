/* Differences of compared runs: inputs, from the resolved problems, and numbers of the compared
 * scenario. */
#include "report/compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/index.h"
#include "problem/values.h"
#include "report/compared_names.h"

/* The values or numbers of one run, found by their paths. */
typedef struct Listed {
    int n;
    CzProblemValue *value; /* of the problem (n) */
    CzIndex by_path;
    CzIndex prefix; /* every beginning of a path, up to a point or bracket */
} Listed;

typedef struct Comparing {
    CzComparison comparison; /* the first member, which the caller owns */
    CzArena arena;
    const CzReport *report;
    Listed listed[CZ_MAX_COMPARED];
    CzIndex missing; /* parts that only some problems have and that were listed */
} Comparing;

/* ---- names ---- */

static bool has_train(const CzInput *input, const char *name) {
    for (int i = 0; i < input->n_trains; i++)
        if (strcmp(input->trains[i].name, name) == 0)
            return true;
    return false;
}

static bool has_vehicle(const CzProblem *problem, const char *name) {
    int n;
    const CzVehicle *vehicle = cz_problem_vehicles(problem, &n);
    for (int i = 0; i < n; i++)
        if (strcmp(vehicle[i].name, name) == 0)
            return true;
    return false;
}

static void add_name(Comparing *comparing, int run, const char *first, const char *other) {
    CzComparison *comparison = &comparing->comparison;
    CzComparedName *grown = cz_arena_grow(&comparing->arena, comparison->name, comparison->n_name,
                                          sizeof *comparison->name);
    if (grown == NULL)
        return;
    comparison->name = grown;
    grown[comparison->n_name++] = (CzComparedName){run, first, other};
}

static void pair_vehicles(Comparing *comparing, int run, const CzTrain *first,
                          const CzTrain *other) {
    const CzReportRun *compared = comparing->report->compared;
    if (first->n_vehicles != other->n_vehicles)
        return;
    for (int i = 0; i < first->n_vehicles; i++) {
        const char *name = first->vehicles[i].name, *its = other->vehicles[i].name;
        if (!has_vehicle(compared[0].problem, its) && !has_vehicle(compared[run].problem, name))
            add_name(comparing, run, name, its);
    }
}

static void pair_trains(Comparing *comparing, int run) {
    const CzReportRun *compared = comparing->report->compared;
    const CzInput *first = cz_problem_input(compared[0].problem);
    const CzInput *other = cz_problem_input(compared[run].problem);
    for (int i = 0; i < first->n_trains && i < other->n_trains; i++) {
        const CzTrain *train = &first->trains[i], *its = &other->trains[i];
        const bool is_same = strcmp(train->name, its->name) == 0;
        if (!is_same && (has_train(first, its->name) || has_train(other, train->name)))
            continue;
        if (!is_same)
            add_name(comparing, run, train->name, its->name);
        pair_vehicles(comparing, run, train, its);
    }
}

/* Pairs trains by their order, and vehicles of trains of equal length by their place. A name that
 * both problems have is that of one thing, and is not paired. */
static void pair_names(Comparing *comparing) {
    for (int run = 1; run < comparing->report->n_compared; run++)
        pair_trains(comparing, run);
}

/* ---- inputs ---- */

/* Adds every beginning of a path. */
static void add_prefixes(Listed *listed, const char *path) {
    for (size_t n = 1; path[n] != '\0'; n++)
        if ((path[n] == '.' || path[n] == '[') && cz_index_find(&listed->prefix, path, n) < 0)
            cz_index_add(&listed->prefix, path, n, 0);
}

static CzStatus list_inputs(Comparing *comparing, CzError *error) {
    for (int i = 0; i < comparing->comparison.n_run; i++) {
        Listed *listed = &comparing->listed[i];
        listed->by_path.arena = listed->prefix.arena = &comparing->arena;
        CZ_TRY(cz_problem_list_values(comparing->report->compared[i].problem, &comparing->arena,
                                      &listed->n, &listed->value, error));
        for (int k = 0; k < listed->n; k++) {
            CzProblemValue *value = &listed->value[k];
            const char *path = value->path =
                cz_compared_names_in(&comparing->comparison, i, value->path, &comparing->arena);
            value->text =
                cz_compared_names_in(&comparing->comparison, i, value->text, &comparing->arena);
            if (path == NULL || value->text == NULL)
                return cz_no_memory(error, "a comparison");
            if (cz_index_find(&listed->by_path, path, strlen(path)) < 0)
                cz_index_add(&listed->by_path, path, strlen(path), k);
            add_prefixes(listed, path);
        }
    }
    return CZ_OK;
}

static const CzProblemValue *find(const Listed *listed, const char *path) {
    const int at = cz_index_find(&listed->by_path, path, strlen(path));
    return at >= 0 ? &listed->value[at] : NULL;
}

/* Length of the shortest beginning of a path that a problem does not have; that of the path when it
 * lacks the value alone. */
static size_t missing_length(const Listed *listed, const char *path) {
    for (size_t n = 1; path[n] != '\0'; n++)
        if ((path[n] == '.' || path[n] == '[') && cz_index_find(&listed->prefix, path, n) < 0)
            return n;
    return strlen(path);
}

/* Whether two differences are one value of the files at several places. */
static bool are_one(const CzInputDifference *a, const CzInputDifference *b, int n_run) {
    const char *end = strrchr(a->path, '.'), *other = strrchr(b->path, '.');
    bool are = end != NULL && other != NULL && strcmp(end, other) == 0;
    for (int i = 0; are && i < n_run; i++) {
        const bool is_there = a->value[i] != NULL && b->value[i] != NULL;
        are = (is_there || a->value[i] == b->value[i]) &&
              (!is_there ||
               (strcmp(a->value[i], b->value[i]) == 0 && strcmp(a->origin[i], b->origin[i]) == 0));
    }
    return are;
}

/* Adds a difference, or counts a further place of one. */
static void add_input(Comparing *comparing, const CzInputDifference *difference) {
    CzComparison *comparison = &comparing->comparison;
    for (int i = 0; i < comparison->n_input; i++)
        if (are_one(&comparison->input[i], difference, comparison->n_run)) {
            comparison->input[i].n_place++;
            return;
        }
    CzInputDifference *input = cz_arena_grow(&comparing->arena, comparison->input,
                                             comparison->n_input, sizeof *comparison->input);
    if (input == NULL)
        return;
    comparison->input = input;
    input[comparison->n_input++] = *difference;
}

/* A record that some problems lack, listed once. */
static void add_missing(Comparing *comparing, const char *path, size_t n) {
    const int n_run = comparing->comparison.n_run;
    CzArena *arena = &comparing->arena;
    const char **value = cz_arena_allocate(arena, (size_t)n_run, sizeof *value);
    const char **origin = cz_arena_allocate(arena, (size_t)n_run, sizeof *origin);
    double *number = cz_arena_numbers(arena, (size_t)n_run);
    const char *name = cz_arena_copy_text(arena, path, n);
    if (value == NULL || origin == NULL || number == NULL || name == NULL ||
        cz_index_find(&comparing->missing, path, n) >= 0)
        return;
    cz_index_add(&comparing->missing, name, n, 0);
    for (int i = 0; i < n_run; i++) {
        const bool has = cz_index_find(&comparing->listed[i].prefix, path, n) >= 0;
        value[i] = has ? "given" : NULL;
        origin[i] = "";
        number[i] = NAN;
    }
    add_input(comparing, &(CzInputDifference){name, 1, "", value, number, origin});
}

/* The number of a value in the unit of the first. */
static double in_unit_of(const CzProblemValue *first, const CzProblemValue *value) {
    return strcmp(value->unit, first->unit) != 0 && !isnan(first->number)
               ? cz_problem_value_in(value, first->unit)
               : value->number;
}

/* Compares the value at a path of all problems. */
static void compare_input(Comparing *comparing, const CzProblemValue *first) {
    const int n_run = comparing->comparison.n_run;
    CzArena *arena = &comparing->arena;
    const char **value = cz_arena_allocate(arena, (size_t)n_run, sizeof *value);
    const char **origin = cz_arena_allocate(arena, (size_t)n_run, sizeof *origin);
    double *number = cz_arena_numbers(arena, (size_t)n_run);
    bool differs = false;
    if (value == NULL || origin == NULL || number == NULL)
        return;
    for (int i = 0; i < n_run; i++) {
        const CzProblemValue *its = find(&comparing->listed[i], first->path);
        if (its == NULL) {
            const size_t n = missing_length(&comparing->listed[i], first->path);
            if (n < strlen(first->path)) {
                add_missing(comparing, first->path, n);
                return;
            }
        }
        differs |= its == NULL || strcmp(its->text, first->text) != 0;
        value[i] = its != NULL ? its->text : NULL;
        origin[i] = its != NULL ? its->origin : "";
        number[i] = its != NULL ? in_unit_of(first, its) : NAN;
    }
    if (differs)
        add_input(comparing,
                  &(CzInputDifference){first->path, 1, cz_problem_unit_symbol(first->unit), value,
                                       number, origin});
    else
        comparing->comparison.n_same_input++;
}

static void compare_inputs(Comparing *comparing) {
    for (int i = 0; i < comparing->comparison.n_run; i++)
        for (int k = 0; k < comparing->listed[i].n; k++) {
            const CzProblemValue *value = &comparing->listed[i].value[k];
            bool is_known = false; /* from a run before */
            for (int before = 0; before < i; before++)
                is_known |= find(&comparing->listed[before], value->path) != NULL;
            if (!is_known)
                compare_input(comparing, value);
        }
}

/* ---- numbers ---- */

/* A number of a run. */
typedef struct RunNumber {
    const char *path;
    const CzResult *result;
    double value;
} RunNumber;

typedef struct RunNumbers {
    CzArena *arena;
    CzIndex by_path;
    const CzComparison *comparison; /* with the names of the run */
    int run;
    int n;
    RunNumber *number;
} RunNumbers;

static void take_number(const char *path, const CzResult *result, double value, void *data) {
    RunNumbers *numbers = data;
    RunNumber *grown =
        cz_arena_grow(numbers->arena, numbers->number, numbers->n, sizeof *numbers->number);
    const char *named =
        cz_compared_names_in(numbers->comparison, numbers->run, path, numbers->arena);
    const char *copy =
        named != NULL ? cz_arena_copy_text(numbers->arena, named, strlen(named)) : NULL;
    if (grown == NULL || copy == NULL)
        return;
    numbers->number = grown;
    cz_index_add(&numbers->by_path, copy, strlen(copy), numbers->n);
    grown[numbers->n++] = (RunNumber){copy, result, value};
}

static void compare_number(Comparing *comparing, const RunNumbers *numbers, int index) {
    CzComparison *comparison = &comparing->comparison;
    const RunNumber *first = &numbers[0].number[index];
    double *value = cz_arena_numbers(&comparing->arena, (size_t)comparison->n_run);
    bool differs = false;
    if (value == NULL)
        return;
    for (int i = 0; i < comparison->n_run; i++) {
        const int at = cz_index_find(&numbers[i].by_path, first->path, strlen(first->path));
        value[i] = at >= 0 ? numbers[i].number[at].value : NAN;
        differs |= value[i] != first->value && !(isnan(value[i]) && isnan(first->value));
    }
    if (!differs) {
        comparison->n_same_number++;
        return;
    }
    CzNumberDifference *grown = cz_arena_grow(&comparing->arena, comparison->number,
                                              comparison->n_number, sizeof *comparison->number);
    if (grown == NULL)
        return;
    comparison->number = grown;
    grown[comparison->n_number++] = (CzNumberDifference){
        first->path, first->result->unit != NULL ? first->result->unit->text : "", value};
}

static void compare_numbers(Comparing *comparing) {
    RunNumbers numbers[CZ_MAX_COMPARED] = {{0}};
    for (int i = 0; i < comparing->comparison.n_run; i++) {
        const CzRunSummary *run = cz_compared_run(comparing->report, i);
        CzResultContext context = {.report = comparing->report,
                                   .problem = comparing->report->compared[i].problem,
                                   .evaluation = comparing->report->compared[i].evaluation,
                                   .run = run};
        numbers[i].arena = numbers[i].by_path.arena = &comparing->arena;
        numbers[i].comparison = &comparing->comparison;
        numbers[i].run = i;
        if (run != NULL)
            cz_results_visit(CZ_RECORD_RUN, &context, run, take_number, &numbers[i]);
    }
    for (int k = 0; k < numbers[0].n; k++)
        compare_number(comparing, numbers, k);
}

/* ---- the comparison ---- */

CzStatus cz_comparison_make(const CzReport *report, CzComparison **comparison, CzError *error) {
    Comparing *comparing = calloc(1, sizeof *comparing);
    *comparison = NULL;
    if (comparing == NULL)
        return cz_no_memory(error, "a comparison");
    comparing->report = report;
    comparing->comparison.n_run = report->n_compared;
    comparing->missing.arena = &comparing->arena;
    pair_names(comparing);
    CzStatus status = list_inputs(comparing, error);
    if (status == CZ_OK) {
        compare_inputs(comparing);
        compare_numbers(comparing);
        if (comparing->arena.out_of_memory)
            status = cz_no_memory(error, "a comparison");
    }
    if (status == CZ_OK)
        *comparison = &comparing->comparison;
    else
        cz_comparison_free(&comparing->comparison);
    return status;
}

void cz_comparison_free(CzComparison *comparison) {
    Comparing *comparing = (Comparing *)comparison;
    if (comparing == NULL)
        return;
    cz_arena_free(&comparing->arena);
    free(comparing);
}
