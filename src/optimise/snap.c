/* From the best design to the best one that can be bought: every variable on its catalogue step. */
#include "optimise/strategy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A batch of designs on the catalogue steps that have not been evaluated yet. */
typedef struct Batch {
    CzSearch *search;
    long limit; /* evaluations of the search at which snapping ends */
    int n_point, room;
    double *x;                      /* (room x n_variable) */
    double *objective, *constraint; /* what the search wants to answer into */
} Batch;

static bool batch_create(Batch *batch, CzSearch *search, long limit, int room) {
    const size_t n = (size_t)search->function->n_variable;
    const size_t m = (size_t)search->function->n_constraint + 1;
    *batch = (Batch){.search = search, .limit = limit, .room = room};
    batch->x = calloc((size_t)room * n, sizeof(double));
    batch->objective = calloc((size_t)room, sizeof(double));
    batch->constraint = calloc((size_t)room * m, sizeof(double));
    return batch->x != NULL && batch->objective != NULL && batch->constraint != NULL;
}

static void batch_free(Batch *batch) {
    free(batch->x);
    free(batch->objective);
    free(batch->constraint);
}

/* Adds a design unless it is known, in the batch already, or does not fit. */
static void batch_add(Batch *batch, const double *x) {
    const int n = batch->search->function->n_variable;
    const size_t size = (size_t)n * sizeof *x;
    if (batch->n_point == batch->room || cz_search_find(batch->search, x) >= 0)
        return;
    for (int i = 0; i < batch->n_point; i++)
        if (memcmp(batch->x + i * n, x, size) == 0)
            return;
    memcpy(batch->x + batch->n_point++ * n, x, size);
}

/* Evaluates what fits into the limit; false when nothing more can be done. */
static bool batch_evaluate(Batch *batch) {
    CzSearch *search = batch->search;
    long left = batch->limit - search->n_record;
    if (cz_search_left(search) < left)
        left = cz_search_left(search);
    const int n = batch->n_point < left ? batch->n_point : (int)left;
    const bool whole = n == batch->n_point;
    batch->n_point = 0;
    if (n <= 0)
        return false;
    return cz_search_evaluate(search, "snap", n, batch->x, batch->objective, batch->constraint) &&
           whole;
}

/* Moves one variable by whole steps from `x`; false when it has no step or leaves its bounds. */
static bool move(const CzSearch *search, double *x, int variable, int n_step) {
    const CzFunction *function = search->function;
    const double step = function->step[variable];
    if (!(step > 0))
        return false;
    const double value = (round(x[variable] / step) + n_step) * step;
    if (value < function->min[variable] || value > function->max[variable])
        return false;
    x[variable] = value;
    return true;
}

/* The corners of the cell of catalogue steps around a design: the nearest one, and the others that
 * differ from it in one variable. */
static void add_cell(Batch *batch, const double *x, double *near, double *scratch) {
    const CzSearch *search = batch->search;
    const int n = search->function->n_variable;
    cz_search_round(search, x, near);
    batch_add(batch, near);
    for (int i = 0; i < n; i++) {
        memcpy(scratch, near, (size_t)n * sizeof *near);
        if (move(search, scratch, i, x[i] > near[i] ? 1 : -1))
            batch_add(batch, scratch);
    }
}

/* All designs one step away. */
static void add_neighbours(Batch *batch, const double *x, double *scratch) {
    const int n = batch->search->function->n_variable;
    for (int i = 0; i < 2 * n; i++) {
        memcpy(scratch, x, (size_t)n * sizeof *x);
        if (move(batch->search, scratch, i / 2, i % 2 == 0 ? 1 : -1))
            batch_add(batch, scratch);
    }
}

/* All designs that differ by one step in each of two variables. */
static void add_pairs(Batch *batch, const double *x, double *scratch) {
    const int n = batch->search->function->n_variable;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++)
            for (int sign = 0; sign < 4; sign++) {
                memcpy(scratch, x, (size_t)n * sizeof *x);
                if (move(batch->search, scratch, i, sign % 2 == 0 ? 1 : -1) &&
                    move(batch->search, scratch, j, sign / 2 == 0 ? 1 : -1))
                    batch_add(batch, scratch);
            }
}

/* Walks from the best design on the steps to a better neighbour until there is none. */
static void descend(Batch *batch, double *at, double *scratch) {
    CzSearch *search = batch->search;
    const size_t size = (size_t)search->function->n_variable * sizeof *at;
    bool with_pairs = false;
    while (search->best_on_grid >= 0) {
        const long before = search->best_on_grid;
        memcpy(at, cz_search_x(search, before), size);
        if (with_pairs)
            add_pairs(batch, at, scratch);
        else
            add_neighbours(batch, at, scratch);
        if (batch->n_point > 0 && !batch_evaluate(batch))
            return;
        if (search->best_on_grid != before) {
            with_pairs = false;
        } else {
            if (with_pairs)
                return;
            with_pairs = true;
        }
    }
}

long cz_snap_reserve(const CzSearch *search) {
    if (!cz_search_has_steps(search))
        return 0;
    const long wanted = 6L * search->function->n_variable + 2;
    const long share = search->most_evaluations / 4;
    return wanted < share ? wanted : share;
}

void cz_snap(CzSearch *search, long evaluations) {
    if (!cz_search_has_steps(search) || search->best < 0)
        return;
    cz_search_resume(search);
    const int n = search->function->n_variable;
    Batch batch;
    double *near = calloc(2 * (size_t)n, sizeof *near);
    const long limit = search->n_record + evaluations;
    if (batch_create(&batch, search, limit, 2 * n * n + 2 * n + 1) && near != NULL) {
        add_cell(&batch, cz_search_x(search, search->best), near, near + n);
        const bool known = batch.n_point == 0;
        const bool whole = known || batch_evaluate(&batch);
        search->is_snapped = cz_search_find(search, near) >= 0;
        if (whole)
            descend(&batch, near, near + n);
    }
    batch_free(&batch);
    free(near);
}
