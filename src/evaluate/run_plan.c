/* Cuts the runs of an evaluation into batches.
 *
 * Runs of models that fit together form a group. In a group the runs that are expected to take long
 * come first, so that neighbours end at about the same time and no thread is left with a long run
 * at the end.
 */
#include "evaluate/run_plan.h"
#include "base/error.h"

#include <stdlib.h>

CzStatus cz_run_plan_begin(CzRunPlan *plan, int n, CzError *error) {
    *plan = (CzRunPlan){0};
    plan->item = calloc((size_t)n + 1, sizeof *plan->item);
    plan->chunk = calloc((size_t)n + 1, sizeof *plan->chunk);
    return plan->item != NULL && plan->chunk != NULL ? CZ_OK : cz_no_memory(error, "the runs");
}

void cz_run_plan_free(CzRunPlan *plan) {
    free(plan->item);
    free(plan->chunk);
    *plan = (CzRunPlan){0};
}

/* Numbers the groups; returns how many there are. */
static CzStatus find_groups(CzRunPlan *plan, const CzSimulateOptions *options, CzError *error) {
    const CzModel **first = calloc((size_t)plan->n_item + 1, sizeof *first);
    int n_group = 0;
    if (first == NULL)
        return cz_no_memory(error, "the runs");
    for (int i = 0; i < plan->n_item; i++) {
        CzRunItem *item = &plan->item[i];
        item->group = 0;
        while (item->group < n_group && !cz_simulate_fits(first[item->group], item->model, options))
            item->group++;
        if (item->group == n_group)
            first[n_group++] = item->model;
    }
    free(first);
    return CZ_OK;
}

static int by_group_and_length(const void *a, const void *b) {
    const CzRunItem *x = a, *y = b;
    if (x->group != y->group)
        return x->group - y->group;
    if (x->length != y->length)
        return x->length > y->length ? -1 : 1;
    return x->scene != y->scene ? x->scene - y->scene : x->design - y->design;
}

/* Number of chunks for n runs of a model: as many as fill the lanes, a multiple of the places, but
 * not so many that they do not fill a block of lanes. */
static int count_chunks(const CzModel *model, int n, bool is_single, int n_place) {
    if (is_single)
        return n;
    const int width = cz_simulate_batch_width(model);
    const int n_block = cz_simulate_n_block(model, n);
    const int n_full = (n + width - 1) / width;
    const int n_even = (n_full + n_place - 1) / n_place * n_place;
    const int most = n_block < n ? n_block : n;
    return n_even < most ? n_even : n_full > most ? n_full : most;
}

/* Weight of an item in the sum that the chunks share equally. */
static double weight_of(const CzRunItem *item) {
    return item->length > 0.0 ? item->length : 1.0;
}

/* Cuts one group into chunks of about the same sum of lengths. */
static void cut_group(CzRunPlan *plan, int first, int end, int n_chunk) {
    double sum = 0.0, done = 0.0;
    for (int i = first; i < end; i++)
        sum += weight_of(&plan->item[i]);
    for (int chunk = 0; chunk < n_chunk; chunk++) {
        const int left = n_chunk - chunk - 1;
        const double until = sum * (chunk + 1) / n_chunk;
        int last = first;
        do
            done += weight_of(&plan->item[last++]);
        while (last < end - left &&
               (left == 0 || done + 0.5 * weight_of(&plan->item[last]) <= until));
        plan->chunk[plan->n_chunk++] = (CzRunChunk){first, last - first};
        first = last;
    }
}

CzStatus cz_run_plan_cut(CzRunPlan *plan, const CzSimulateOptions *options, bool is_single,
                         int n_place, CzError *error) {
    CZ_TRY(find_groups(plan, options, error));
    qsort(plan->item, (size_t)plan->n_item, sizeof *plan->item, by_group_and_length);
    plan->n_chunk = 0;
    for (int first = 0, end = 0; first < plan->n_item; first = end) {
        while (end < plan->n_item && plan->item[end].group == plan->item[first].group)
            end++;
        const CzModel *model = plan->item[first].model;
        cut_group(plan, first, end, count_chunks(model, end - first, is_single, n_place));
    }
    return CZ_OK;
}
