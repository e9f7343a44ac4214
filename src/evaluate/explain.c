/* Explanation of checks, and the cause of an override: the run with the smallest climbing margin,
 * its indicators, and searches over one value at a time.
 *
 * Each value is changed by the steps of a list, up and down, and then between the last step that
 * keeps the verdict and the first that changes it. All candidates of a round are designs of one
 * model and run side by side in lanes.
 */
#include "crushzone/explain.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/error.h"
#include "base/text.h"
#include "evaluate/candidate_changes.h"
#include "evaluate/candidate_runs.h"
#include "evaluate/climbing.h"
#include "evaluate/explain_parts.h"

/* Steps of the list, as changes relative to the value (ours). */
static const double up[] = {0.05, 0.1, 0.2, 0.5, 1, 3, 9};
static const double down[] = {-0.05, -0.1, -0.2, -0.35, -0.5, -0.75, -0.9};
enum {
    N_STEP = sizeof up / sizeof up[0],
    N_BETWEEN = 7 /* values tried between two steps */
};

typedef struct Search {
    const CzEvaluator *evaluator;
    const CzExplainOptions *options;
    CzClimbing climbing;
    bool is_broken; /* the verdict to be changed */
    long n_run;
    int n_all; /* largest number of candidates of all rounds */
} Search;

CzExplainOptions cz_explain_options_default(void) {
    return (CzExplainOptions){.search = true};
}

/* Runs a round of candidates. */
static CzStatus run_round(Search *search, CzCandidate *candidate, int n, CzError *error) {
    const CzStatus status = cz_candidates_run(search->evaluator, &search->climbing,
                                              search->options->stop, n, candidate, error);
    search->n_run += n;
    if (search->options->progress != NULL)
        search->options->progress((int)search->n_run, search->n_all,
                                  search->options->progress_data);
    return status;
}

/* ---- one value ------------------------------------------------------------------------------- */

/* Size of a change, the same for a doubling and a halving. */
static double size_of(double change) {
    return fabs(log1p(fmax(change, -0.999)));
}

static bool turns(const Search *search, double margin) {
    return search->is_broken ? margin >= 0 : margin < 0;
}

static bool is_better(const Search *search, double margin, double than) {
    return search->is_broken ? margin > than : margin < than;
}

/* Finds the smallest change that changes the verdict among candidates in one direction, in order of
 * size, after `start`, which does not. */
static void find_change(const Search *search, const CzCandidate *candidate, int n, double start,
                        CzCandidateChange *varied) {
    double last = start;
    for (int i = 0; i < n; i++) {
        const bool turned = turns(search, candidate[i].margin);
        const bool first =
            turned && (!varied->turns || size_of(candidate[i].change) < size_of(varied->change));
        const bool nearer = !turned && !varied->turns && !isnan(candidate[i].margin) &&
                            is_better(search, candidate[i].margin, varied->margin);
        if (first || nearer) {
            varied->turns = turned;
            varied->needed = candidate[i].value;
            varied->change = candidate[i].change;
            varied->margin = candidate[i].margin;
            varied->not_yet = turned ? last : NAN;
        }
        if (turned)
            return;
        last = candidate[i].change;
    }
}

/* Tries the steps of every value, up and down. */
static CzStatus try_steps(Search *search, int n, const int *kind, CzCandidateChange *varied,
                          CzError *error) {
    CzCandidate *candidate = calloc((size_t)n * 2 * N_STEP + 1, sizeof *candidate);
    if (candidate == NULL)
        return cz_no_memory(error, "the candidate changes");
    for (int i = 0; i < n * 2 * N_STEP; i++) {
        const int step = i % N_STEP;
        candidate[i].kind = kind[i / (2 * N_STEP)];
        candidate[i].change = i / N_STEP % 2 == 0 ? up[step] : down[step];
    }
    const CzStatus status = run_round(search, candidate, n * 2 * N_STEP, error);
    for (int i = 0; status == CZ_OK && i < 2 * n; i++)
        find_change(search, &candidate[i * N_STEP], N_STEP, 0, &varied[i / 2]);
    free(candidate);
    return status;
}

/* Tries values between the steps where the verdict changes. */
static CzStatus refine(Search *search, int n, const int *kind, CzCandidateChange *varied,
                       CzError *error) {
    CzCandidate *candidate = calloc((size_t)n * N_BETWEEN + 1, sizeof *candidate);
    int *of = calloc((size_t)n + 1, sizeof *of);
    int n_turning = 0;
    CzStatus status = CZ_OK;
    if (candidate == NULL || of == NULL)
        status = cz_no_memory(error, "the candidate changes");
    for (int i = 0; status == CZ_OK && i < n; i++) {
        if (!varied[i].turns)
            continue;
        const double from = varied[i].not_yet, range = varied[i].change - from;
        for (int k = 0; k < N_BETWEEN; k++) {
            CzCandidate *next = &candidate[n_turning * N_BETWEEN + k];
            next->kind = kind[i];
            next->change = from + range * (k + 1) / (N_BETWEEN + 1);
        }
        of[n_turning++] = i;
    }
    if (status == CZ_OK)
        status = run_round(search, candidate, n_turning * N_BETWEEN, error);
    for (int i = 0; status == CZ_OK && i < n_turning; i++) {
        CzCandidateChange *found = &varied[of[i]];
        const double before = found->not_yet;
        const CzCandidate *between = &candidate[i * N_BETWEEN];
        find_change(search, between, N_BETWEEN, before, found);
        if (found->not_yet == before && found->change != between[0].change)
            found->not_yet = between[N_BETWEEN - 1].change; /* only the step itself changed it */
    }
    free(candidate);
    free(of);
    return status;
}

/* ---- all candidate changes --------------------------------------------------------------------
 */

/* Order of candidate changes: first by the size of the change that changes the verdict, then by the
 * margin. */
static bool goes_before(const Search *search, const CzCandidateChange *a,
                        const CzCandidateChange *b) {
    if (a->turns != b->turns)
        return a->turns;
    if (a->turns)
        return size_of(a->change) < size_of(b->change);
    return is_better(search, a->margin, b->margin);
}

static void sort(const Search *search, int n, CzCandidateChange *varied) {
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && goes_before(search, &varied[k], &varied[k - 1]); k--) {
            const CzCandidateChange swapped = varied[k];
            varied[k] = varied[k - 1];
            varied[k - 1] = swapped;
        }
}

/* Whether the run has an indicator of a cause; stops do not count, since every lift reaches
 * them. */
static bool shows(const CzExplanation *explanation, CzCause cause) {
    for (int i = 0; i < explanation->n_indicator; i++)
        if (explanation->indicator[i].cause == cause && cause != CZ_CAUSE_SUSPENSION)
            return true;
    return false;
}

/* Names the cause; the candidate changes are sorted. */
static void name_cause(CzExplanation *explanation) {
    for (int pass = 0; pass < 2 && !explanation->has_cause; pass++)
        for (int i = 0; i < explanation->n_candidate && !explanation->has_cause; i++) {
            const CzCandidateChange *varied = &explanation->candidate[i];
            if (!varied->turns || (pass == 0 && !shows(explanation, varied->cause)))
                continue;
            explanation->has_cause = true;
            explanation->cause = varied->cause;
        }
}

static CzStatus search_changes(Search *search, CzExplanation *explanation, CzError *error) {
    const CzEvaluator *evaluator = search->evaluator;
    int kind[64], n = 0;
    explanation->candidate =
        calloc((size_t)cz_n_candidate_kind() + 1, sizeof *explanation->candidate);
    if (explanation->candidate == NULL)
        return cz_no_memory(error, "the candidate changes");
    for (int k = 0; k < cz_n_candidate_kind() && n < 64; k++) {
        CzCandidateChange *varied = &explanation->candidate[n];
        if (!cz_candidate_find(k, evaluator->vehicles, evaluator->n_vehicle, varied))
            continue;
        varied->needed = varied->change = varied->not_yet = NAN;
        varied->margin = explanation->worst.margin;
        kind[n++] = k;
    }
    search->n_all = n * (2 * N_STEP + N_BETWEEN);
    CzStatus status = try_steps(search, n, kind, explanation->candidate, error);
    if (status == CZ_OK)
        status = refine(search, n, kind, explanation->candidate, error);
    if (status == CZ_OK)
        sort(search, n, explanation->candidate);
    explanation->n_candidate = n;
    if (status == CZ_OK)
        name_cause(explanation);
    return status;
}

/* ---- indicators: events before the override, and forces above the capacity of a part
 * ------------ */

__attribute__((format(printf, 4, 5))) static void
indicate(CzExplanation *explanation, CzCause cause, double time, const char *format, ...) {
    if (explanation->n_indicator == CZ_MAX_INDICATORS)
        return;
    CzIndicator *indicator = &explanation->indicator[explanation->n_indicator++];
    indicator->cause = cause;
    indicator->time = time;
    va_list values;
    va_start(values, format);
    vsnprintf(indicator->what, sizeof indicator->what, format, values);
    va_end(values);
}

/* Events that indicate a cause, with the sentence on their place. */
static const struct {
    CzEventKind what;
    CzCause cause;
    const char *before, *behind;
} indicating[] = {{CZ_EVENT_BOTTOMED_OUT, CZ_CAUSE_BOTTOMING, "", " bottomed out"},
                  {CZ_EVENT_SWING_STOP, CZ_CAUSE_STRUT, "", " met its swing stop"},
                  {CZ_EVENT_LIFT_STOP, CZ_CAUSE_SUSPENSION, "lift stop of the ", " met"},
                  {CZ_EVENT_BUMP_STOP, CZ_CAUSE_SUSPENSION, "bump stop of the ", " met"}};

static void add_event(CzExplanation *explanation, const CzEvent *event) {
    for (size_t i = 0; i < sizeof indicating / sizeof *indicating; i++)
        if (indicating[i].what == event->what)
            indicate(explanation, indicating[i].cause, event->time, "%s%s%s", indicating[i].before,
                     event->where, indicating[i].behind);
}

/* Whole kN for a sentence. */
static long kilonewton(double force) {
    return lround(force / 1e3);
}

static void add_of_interface(CzExplanation *explanation, const CzInterfaceResult *interface) {
    double coupler = 0;
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].kind == CZ_ELEMENT_COUPLER)
            coupler = fmax(coupler, interface->element[i].peak_force);
    if (coupler > interface->critical_force)
        indicate(explanation, CZ_CAUSE_STRUT, NAN,
                 "%s: the coupler carried %ld kN, F_crit is %ld kN", interface->name,
                 kilonewton(coupler), kilonewton(interface->critical_force));
    if (interface->vertical_margin < 0)
        indicate(explanation, CZ_CAUSE_CAPACITY, NAN,
                 "%s: the anti-climbers slipped under a vertical force of %ld kN", interface->name,
                 kilonewton(interface->vertical_demand));
    if (interface->min_overlap < 0)
        indicate(explanation, CZ_CAUSE_OVERLAP, NAN, "%s: the faces lost their overlap",
                 interface->name);
}

/* Finds the indicators of a run up to its override, or over the whole run when there is none. */
static void find_indicators(const CzRunSummary *run, CzExplanation *explanation) {
    const double until = run->beyond_validity ? run->beyond_validity_time : INFINITY;
    for (int i = 0; i < run->n_interface; i++)
        add_of_interface(explanation, &run->interface[i]);
    for (int i = 0; i < run->n_event; i++)
        if (run->event[i].time <= until)
            add_event(explanation, &run->event[i]);
}

/* ---- the run to explain ---------------------------------------------------------------------- */

/* The vehicle at a place: the vehicle of that name, or the one behind an interface. */
static int vehicle_at(const CzRunSummary *run, const char *where) {
    for (int i = 0; i < run->n_vehicle; i++)
        if (strcmp(run->vehicle[i].name, where) == 0)
            return i;
    for (int i = 0; i < run->n_interface; i++)
        if (strcmp(run->interface[i].name, where) == 0)
            return i;
    return 0;
}

/* Removes the run with the smallest climbing margin from an evaluation and keeps it. */
static void choose_run(const CzEvaluator *evaluator, CzEvaluation *evaluation, Search *search,
                       CzExplanation *explanation) {
    int chosen = -1, chosen_run = -1, run = 0;
    for (int s = 0; s < evaluator->n_scene; s++) {
        if (evaluator->model[s] == NULL)
            continue;
        const CzRunSummary *summary = cz_run_summary(evaluation->run[run]);
        const CzClimbing climbing = cz_climbing_of(evaluator, s);
        const CzCheckResult worst = cz_climbing_judge(
            &climbing, evaluator, cz_vehicles_in(evaluator, evaluator->vehicles, climbing.scenario),
            summary);
        if (!isnan(worst.margin) && (chosen < 0 || worst.margin < explanation->worst.margin)) {
            chosen = s;
            chosen_run = run;
            explanation->worst = worst;
            search->climbing = climbing;
        }
        run++;
    }
    explanation->has_climbing = chosen >= 0;
    if (chosen < 0)
        return;
    explanation->run = evaluation->run[chosen_run];
    evaluation->run[chosen_run] = NULL;
    const CzRunSummary *summary = cz_run_summary(explanation->run);
    explanation->scenario = summary->scenario;
    explanation->vehicle = vehicle_at(summary, explanation->worst.where);
    explanation->climbed = summary->beyond_validity;
    explanation->climb_time = summary->beyond_validity_time;
    explanation->verdict = summary->beyond_validity ? CZ_VERDICT_FAIL : explanation->worst.verdict;
    search->is_broken = explanation->worst.margin < 0;
    find_indicators(summary, explanation);
}

/* Whether a check of climbing is to be explained. */
static bool wants_climbing(const CzExplainOptions *options, const CzEvaluator *evaluator) {
    bool wants = options->n_check == 0;
    for (int i = 0; i < evaluator->list.n_check && !wants; i++) {
        const CzCheck *check = &evaluator->list.check[i];
        wants = check->metric.kind != NULL && cz_climbing_judges(check->metric.kind) &&
                cz_text_is_among(check->name, options->n_check, options->check);
    }
    return wants;
}

static CzStatus explain(CzEvaluator *evaluator, const CzExplainOptions *options,
                        CzExplanation *explanation, CzError *error) {
    CzEvaluation evaluation = {0};
    Search search = {.evaluator = evaluator, .options = options};
    cz_evaluator_set_stop(evaluator, options->stop);
    explanation->climb_time = explanation->worst.margin = explanation->worst.value =
        explanation->worst.limit = NAN;
    explanation->verdict = CZ_VERDICT_NOT_CHECKED;
    CZ_TRY(cz_evaluate(evaluator, 1, NULL, true, &evaluation, error));
    CzStatus status = evaluation.status == CZ_OK
                          ? CZ_OK
                          : cz_fail(error, CZ_STATUS_RUN_FAILED, "%s", evaluation.failure);
    if (status == CZ_OK)
        status = cz_explain_checks(evaluator, &evaluation, options, explanation, error);
    if (status == CZ_OK && wants_climbing(options, evaluator))
        choose_run(evaluator, &evaluation, &search, explanation);
    cz_evaluation_free(&evaluation);
    if (status == CZ_OK && explanation->n_check == 0 && !explanation->has_climbing)
        status = cz_fail(error, CZ_STATUS_INPUT,
                         "the problem has no check, and no full vehicle with declared bump and "
                         "lift stops and no pair of anti-climbers could climb");
    if (status == CZ_OK && options->search && explanation->n_check > 0)
        status = cz_explain_changes(evaluator, options, explanation, error);
    if (status == CZ_OK && options->search && explanation->has_climbing)
        status = search_changes(&search, explanation, error);
    explanation->n_run += search.n_run;
    return status;
}

CzStatus cz_explain(CzEvaluator *evaluator, const CzExplainOptions *options,
                    CzExplanation **explanation, CzError *error) {
    const double started = cz_clock();
    const CzExplainOptions usual = cz_explain_options_default();
    *explanation = calloc(1, sizeof **explanation);
    if (*explanation == NULL)
        return cz_no_memory(error, "an explanation");
    const CzStatus status =
        explain(evaluator, options != NULL ? options : &usual, *explanation, error);
    (*explanation)->wall_s = cz_clock() - started;
    if (status == CZ_OK)
        return CZ_OK;
    cz_explanation_free(*explanation);
    *explanation = NULL;
    return status;
}

void cz_explanation_free(CzExplanation *explanation) {
    if (explanation == NULL)
        return;
    for (int i = 0; i < explanation->n_check; i++)
        free(explanation->check[i].change);
    free(explanation->check);
    cz_run_free(explanation->run);
    free(explanation->candidate);
    free(explanation);
}
