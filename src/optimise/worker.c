/* A worker: the studies that another process has sent to it. */
#include "crushzone/executor.h"

#include <stdint.h>
#include <stdlib.h>

#include "base/error.h"
#include "evaluate/study.h"

static const CzStudyKind *const kinds[CZ_N_STUDY_KIND] = {
    [CZ_STUDY_OF_RUNS] = &cz_study_of_runs,
    [CZ_STUDY_OF_SAMPLES] = &cz_study_of_samples,
    [CZ_STUDY_OF_POINTS] = &cz_study_of_points,
    [CZ_STUDY_OF_CANDIDATES] = &cz_study_of_candidates,
    [CZ_STUDY_OF_CHALLENGE] = &cz_study_of_challenge,
    [CZ_STUDY_OF_CORRIDOR] = &cz_study_of_corridor};

/* A study that was opened. */
typedef struct Known {
    uint64_t name;
    const CzStudyKind *kind;
    void *study;
    CzStatus status; /* of opening it */
    CzError error;
    struct Known *next;
} Known;

struct CzWorker {
    Known *known; /* the newest first */
};

CzWorker *cz_worker_create(void) {
    return calloc(1, sizeof(CzWorker));
}

static void close_study(Known *known) {
    if (known->kind != NULL)
        known->kind->close(known->study);
    free(known);
}

void cz_worker_free(CzWorker *worker) {
    while (worker != NULL && worker->known != NULL) {
        Known *known = worker->known;
        worker->known = known->next;
        close_study(known);
    }
    free(worker);
}

/* Where the worker refers to a study; to NULL for one that it does not know. */
static Known **find(CzWorker *worker, uint64_t name) {
    Known **at = &worker->known;
    while (*at != NULL && (*at)->name != name)
        at = &(*at)->next;
    return at;
}

static void forget(CzWorker *worker, uint64_t name) {
    Known **at = find(worker, name), *known = *at;
    if (known == NULL)
        return;
    *at = known->next;
    close_study(known);
}

static void open_study(CzWorker *worker, uint64_t name, CzReading *reading) {
    Known *known = calloc(1, sizeof *known);
    if (known == NULL)
        return; /* its requests are answered as those of an unknown study */
    const int kind = cz_get_int(reading);
    known->name = name;
    known->next = worker->known;
    worker->known = known;
    if (kind >= 0 && kind < CZ_N_STUDY_KIND)
        known->kind = kinds[kind];
    known->status = known->kind != NULL ? known->kind->open(reading, &known->study, &known->error)
                                        : cz_no_memory(&known->error, "a study");
}

void cz_worker_receive(CzWorker *worker, const CzBytes *message) {
    CzReading reading = {.next = message->byte, .n_left = message->n};
    uint64_t name;
    cz_get(&reading, &name, 1, sizeof name);
    forget(worker, name);
    if (cz_get_int(&reading) != 0)
        open_study(worker, name, &reading);
}

/* Runs a task; its results are behind the status, which is put first. */
static int run(CzWorker *worker, CzReading *reading, CzMemoryText *text, CzError *error) {
    uint64_t name;
    cz_get(reading, &name, 1, sizeof name);
    Known *known = *find(worker, name);
    if (known == NULL)
        return cz_no_memory(error, "a study");
    if (known->status != CZ_OK)
        *error = known->error;
    CZ_TRY(known->status);
    const CzStatus status = known->kind->answer(known->study, reading, text, error);
    if (status == CZ_STATUS_INPUT)
        return CZ_RUN_HERE;
    CZ_TRY(status);
    return text->failed ? cz_no_memory(error, "the results of a task") : CZ_OK;
}

CzStatus cz_worker_answer(CzWorker *worker, const CzBytes *request, CzBytes *answer) {
    CzReading reading = {.next = request->byte, .n_left = request->n};
    CzMemoryText text = {0};
    CzError error = {0};
    cz_put_int(&text, CZ_OK);
    const int status = run(worker, &reading, &text, &error);
    if (status != CZ_OK) {
        cz_memory_text_free(&text);
        cz_put_int(&text, status);
        cz_put(&text, &error, 1, sizeof error);
    }
    *answer = (CzBytes){.n = text.n, .byte = text.text};
    if (text.failed)
        cz_bytes_free(answer);
    return text.failed ? CZ_STATUS_NO_MEMORY : CZ_OK;
}
