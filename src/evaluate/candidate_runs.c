/* Candidates of a round: designs of one model, side by side in lanes, in batches for an executor.
 */
#include "evaluate/candidate_runs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "evaluate/candidate_changes.h"
#include "evaluate/tasks.h"
#include "simulate/batch.h"

enum { MAX_WIDTH = 64 /* designs of a batch */ };

typedef struct Round {
    const CzEvaluator *evaluator;
    const CzClimbing *climbing;
    const volatile sig_atomic_t *stop;
    CzStudy study;
    int n;
    CzCandidate *candidate; /* (n) */
    int width;              /* designs of a batch */
} Round;

static bool is_stopped(const Round *round) {
    return round->stop != NULL && *round->stop != 0;
}

/* ---- runs ------------------------------------------------------------------------------------ */

/* Runs the candidates of a batch that are valid in a problem file; `vehicles` has room for all. */
static CzStatus run_batch(const Round *round, CzCandidate *candidate, int n, CzVehicle *vehicles,
                          CzError *error) {
    const CzEvaluator *evaluator = round->evaluator;
    const int scenario = round->climbing->scenario;
    const size_t n_vehicle = (size_t)evaluator->n_vehicle;
    const CzModel *model = evaluator->model[scenario];
    CzPlannedRun design[MAX_WIDTH];
    CzRun *run[MAX_WIDTH] = {NULL};
    CzCandidate *of_design[MAX_WIDTH];
    int n_design = 0;
    for (int i = 0; i < n; i++) {
        CzVehicle *own = vehicles + (size_t)n_design * n_vehicle;
        memcpy(own, cz_vehicles_in(evaluator, evaluator->vehicles, scenario),
               n_vehicle * sizeof *own);
        candidate[i].value =
            cz_candidate_apply(candidate[i].kind, candidate[i].change, own, evaluator->n_vehicle);
        candidate[i].margin = NAN;
        if (cz_problem_check_vehicles(evaluator->problem, own, NULL) != CZ_OK)
            continue;
        of_design[n_design] = &candidate[i];
        design[n_design++] = (CzPlannedRun){model, own};
    }
    CzSimulateOptions options = cz_simulate_options_default();
    options.record = false;
    options.track = CZ_TRACK_USE_SEARCH;
    options.brief = true; /* an override occurs long before all wheels are at rest */
    const CzStatus status =
        n_design > 0 ? cz_simulate_batch(n_design, design, &options, run, error) : CZ_OK;
    for (int i = 0; i < n_design; i++) {
        if (status == CZ_OK)
            of_design[i]->margin = cz_climbing_judge(round->climbing, evaluator, design[i].vehicles,
                                                     cz_run_summary(run[i]))
                                       .margin;
        cz_run_free(run[i]);
    }
    return status;
}

static CzStatus run_candidates(const Round *round, int n, CzCandidate *candidate, CzError *error) {
    CzVehicle *vehicles =
        malloc((size_t)n * (size_t)round->evaluator->n_vehicle * sizeof *vehicles);
    const CzStatus status = vehicles != NULL ? run_batch(round, candidate, n, vehicles, error)
                                             : cz_no_memory(error, "the designs");
    free(vehicles);
    return status;
}

/* Candidates of a task; *n is their number. */
static CzCandidate *candidates_of(const Round *round, int index, int *n) {
    const int first = index * round->width, left = round->n - first;
    *n = left < round->width ? left : round->width;
    return round->candidate + first;
}

static CzStatus run_task(int index, void *data, CzError *error) {
    const Round *round = data;
    int n;
    CzCandidate *candidate = candidates_of(round, index, &n);
    if (is_stopped(round))
        return cz_fail(error, CZ_STATUS_INTERRUPTED, "the search was interrupted");
    return run_candidates(round, n, candidate, error);
}

/* ---- in workers ------------------------------------------------------------------------------ */

static bool request_task(int index, void *data, CzMemoryText *request) {
    const Round *round = data;
    int n;
    const CzCandidate *candidate = candidates_of(round, index, &n);
    cz_put_int(request, n);
    cz_put(request, candidate, (size_t)n, sizeof *candidate);
    return !is_stopped(round);
}

static CzStatus take_task(int index, void *data, CzReading *answer, CzError *error) {
    int n;
    CzCandidate *candidate = candidates_of(data, index, &n);
    cz_get(answer, candidate, (size_t)n, sizeof *candidate);
    return answer->has_ended ? cz_no_memory(error, "the results of a change") : CZ_OK;
}

static void describe(const void *data, CzMemoryText *description) {
    const Round *round = data;
    cz_evaluator_describe(round->evaluator, description);
    cz_put_int(description, round->climbing->scenario);
}

/* The study of a worker. */
typedef struct Opened {
    void *evaluator;
    CzClimbing climbing;
} Opened;

static CzStatus open_round(CzReading *description, void **study, CzError *error) {
    Opened *opened = *study = calloc(1, sizeof *opened);
    if (opened == NULL)
        return cz_no_memory(error, "a study");
    CZ_TRY(cz_evaluator_open(description, &opened->evaluator, error));
    const CzEvaluator *evaluator = cz_evaluator_opened(opened->evaluator);
    const int scenario = cz_get_int(description);
    if (scenario < 0 || scenario >= evaluator->n_scene || evaluator->model[scenario] == NULL)
        return cz_no_memory(error, "a study");
    opened->climbing = cz_climbing_of(evaluator, scenario);
    return CZ_OK;
}

static CzStatus answer_task(void *study, CzReading *request, CzMemoryText *answer, CzError *error) {
    const Opened *opened = study;
    const Round round = {.evaluator = cz_evaluator_opened(opened->evaluator),
                         .climbing = &opened->climbing};
    CzCandidate candidate[MAX_WIDTH];
    const int n = cz_get_int(request);
    if (n < 1 || n > MAX_WIDTH)
        return cz_no_memory(error, "a task");
    cz_get(request, candidate, (size_t)n, sizeof *candidate);
    CZ_TRY(run_candidates(&round, n, candidate, error));
    cz_put(answer, candidate, (size_t)n, sizeof *candidate);
    return CZ_OK;
}

static void close_round(void *study) {
    Opened *opened = study;
    if (opened != NULL)
        cz_evaluator_close(opened->evaluator);
    free(opened);
}

const CzStudyKind cz_study_of_candidates = {open_round, answer_task, close_round};

/* ---- a round --------------------------------------------------------------------------------- */

CzStatus cz_candidates_run(const CzEvaluator *evaluator, const CzClimbing *climbing,
                           const volatile sig_atomic_t *stop, int n, CzCandidate *candidate,
                           CzError *error) {
    const int width = cz_simulate_batch_width(evaluator->model[climbing->scenario]);
    Round round = {.evaluator = evaluator,
                   .climbing = climbing,
                   .stop = stop,
                   .n = n,
                   .candidate = candidate,
                   .width = width < MAX_WIDTH ? width : MAX_WIDTH};
    round.study = (CzStudy){.executor = evaluator->executor,
                            .kind = CZ_STUDY_OF_CANDIDATES,
                            .describe = describe,
                            .data = &round};
    const CzTaskData plain = {&round.study, request_task, take_task};
    const CzStatus status =
        cz_tasks_share(&plain, (n + round.width - 1) / round.width, run_task, &round, error);
    cz_study_end(&round.study);
    return status;
}
