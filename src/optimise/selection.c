/* The working set of scenarios of a search. */
#include "optimise/selection.h"
#include "base/error.h"

#include <string.h>

/* Fewer scenarios fill the lanes of a batch or two, and are all run (ours). */
enum { MIN_SCENARIOS = 16 };

/* A scenario joins when a margin in it is within this of a violation, or, where the smallest margin
 * counts, of the smallest one (ours). */
static const double near = 0.05;

CzStatus cz_selection_begin(CzSelection *selection, const CzEvaluator *evaluator, CzError *error) {
    CzArena *arena = &selection->arena;
    *selection = (CzSelection){.evaluator = evaluator,
                               .n_scenario = cz_evaluator_n_scenario(evaluator),
                               .n_constraint = cz_evaluator_n_constraint(evaluator),
                               .n_detail = cz_evaluator_n_detail(evaluator)};
    const size_t n = (size_t)selection->n_scenario, m = (size_t)selection->n_constraint;
    selection->of_constraint = cz_arena_allocate(arena, m + 1, sizeof(int));
    selection->of_detail = cz_arena_allocate(arena, (size_t)selection->n_detail + 1, sizeof(int));
    selection->has_run = cz_arena_allocate(arena, n, sizeof(bool));
    selection->works = cz_arena_allocate(arena, n, sizeof(bool));
    selection->last = cz_arena_numbers(arena, m);
    selection->n_run = cz_arena_allocate(arena, n, sizeof(long));
    if (arena->out_of_memory)
        return cz_no_memory(error, "the scenarios");
    int n_run = 0;
    for (size_t s = 0; s < n; s++) {
        selection->has_run[s] = cz_evaluator_has_run_of(evaluator, (int)s);
        selection->works[s] = true;
        n_run += selection->has_run[s];
    }
    selection->is_on = n_run >= MIN_SCENARIOS && cz_evaluator_can_select(evaluator);
    for (int j = 0, k = 0; j < selection->n_constraint && selection->is_on; j++) {
        selection->of_constraint[j] = cz_evaluator_constraint_scenario(evaluator, j);
        for (int i = cz_evaluator_n_detail_of(evaluator, j); i > 0; i--)
            selection->of_detail[k++] = selection->of_constraint[j];
    }
    return CZ_OK;
}

void cz_selection_free(CzSelection *selection) {
    cz_arena_free(&selection->arena);
}

static bool is_left_out(const CzSelection *selection, int scenario) {
    return scenario >= 0 && !selection->works[scenario];
}

bool cz_selection_is_whole(const CzSelection *selection) {
    for (int s = 0; s < selection->n_scenario; s++)
        if (selection->has_run[s] && !selection->works[s])
            return false;
    return true;
}

void cz_selection_blank(const CzSelection *selection, double *constraint, double *detail) {
    if (!selection->is_on)
        return;
    for (int j = 0; j < selection->n_constraint; j++)
        if (is_left_out(selection, selection->of_constraint[j]))
            constraint[j] = NAN;
    for (int k = 0; k < selection->n_detail && detail != NULL; k++)
        if (is_left_out(selection, selection->of_detail[k]))
            detail[k] = NAN;
}

bool cz_selection_is_of_set(const CzSelection *selection, const double *constraint) {
    for (int j = 0; j < selection->n_constraint && selection->is_on; j++)
        if (isnan(constraint[j]) != is_left_out(selection, selection->of_constraint[j]))
            return false;
    return true;
}

static bool is_graded(const CzSelection *selection, int j) {
    return cz_evaluator_constraint_kind(selection->evaluator, j) == CZ_CONSTRAINT_GRADED;
}

/* The value from which on a constraint limits a design. */
static double limiting_value(const CzSelection *selection, const double *constraint) {
    double largest = -INFINITY;
    for (int j = 0; j < selection->n_constraint; j++)
        if (is_graded(selection, j))
            largest = fmax(largest, constraint[j]);
    const bool is_minimax = cz_evaluator_maximises_margin(selection->evaluator);
    return (is_minimax ? fmin(largest, 0) : 0) - near;
}

/* Whether a constraint is the largest one of its check: of those of the same name. */
static bool leads_its_check(const CzSelection *selection, const double *constraint, int j) {
    const char *name = cz_evaluator_constraint_check(selection->evaluator, j);
    for (int i = 0; i < selection->n_constraint; i++)
        if ((constraint[i] > constraint[j] || (constraint[i] == constraint[j] && i < j)) &&
            strcmp(cz_evaluator_constraint_check(selection->evaluator, i), name) == 0)
            return false;
    return true;
}

/* The first working set: scenarios without a constraint, which may count in the objective, and
 * those with the smallest margin of a check. */
static void begin_set(CzSelection *selection, const double *constraint) {
    for (int s = 0; s < selection->n_scenario; s++) {
        bool has_any = false;
        for (int j = 0; j < selection->n_constraint && !has_any; j++)
            has_any = selection->of_constraint[j] == s;
        selection->works[s] = !has_any;
    }
    for (int j = 0; j < selection->n_constraint; j++)
        if (selection->of_constraint[j] >= 0 && is_graded(selection, j) &&
            leads_its_check(selection, constraint, j))
            selection->works[selection->of_constraint[j]] = true;
}

/* Adds the scenarios that limit a design. */
static void extend_set(CzSelection *selection, const double *constraint) {
    const double limiting = limiting_value(selection, constraint);
    for (int j = 0; j < selection->n_constraint; j++) {
        const double least = is_graded(selection, j) ? limiting : 0;
        if (selection->of_constraint[j] >= 0 && constraint[j] > least)
            selection->works[selection->of_constraint[j]] = true;
    }
}

void cz_selection_note(CzSelection *selection, bool is_whole, double objective,
                       const double *constraint) {
    const bool is_counted =
        is_whole && !isnan(objective); /* a journal does not say where it fails */
    for (int s = 0; s < selection->n_scenario; s++)
        selection->n_run[s] += selection->has_run[s] && (is_counted || selection->works[s]);
    selection->n_whole += is_counted;
    if (!selection->is_on || isnan(objective))
        return;
    for (int j = 0; j < selection->n_constraint; j++)
        if (!isnan(constraint[j]))
            selection->last[j] = constraint[j];
    if (!is_whole)
        return;
    if (!selection->has_begun)
        begin_set(selection, constraint);
    selection->has_begun = true;
    extend_set(selection, constraint);
}
