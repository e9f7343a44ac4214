/* Sends descriptions of studies to workers. */
#include "evaluate/study.h"

#include <stdint.h>

/* The address names a study among those that are open. */
void cz_study_put(CzMemoryText *request, const CzStudy *study) {
    const uint64_t name = (uint64_t)(uintptr_t)study;
    cz_put(request, &name, 1, sizeof name);
}

static CzStatus broadcast(const CzStudy *study, CzMemoryText *message, CzError *error) {
    const CzBytes bytes = {.n = message->n, .byte = message->text};
    return study->executor.broadcast(&study->executor, &bytes, error);
}

CzStatus cz_study_begin(CzStudy *study, CzError *error) {
    if (study->is_known || study->executor.broadcast == NULL)
        return CZ_OK;
    CzMemoryText message = {0};
    cz_study_put(&message, study);
    cz_put_int(&message, true);
    cz_put_int(&message, (int)study->kind);
    study->describe(study->data, &message);
    const bool is_described = !message.failed;
    const CzStatus status = is_described ? broadcast(study, &message, error) : CZ_OK;
    study->is_known = is_described && status == CZ_OK;
    cz_memory_text_free(&message);
    return status;
}

void cz_study_end(CzStudy *study) {
    CzMemoryText message = {0};
    if (!study->is_known)
        return;
    cz_study_put(&message, study);
    cz_put_int(&message, false);
    if (!message.failed)
        (void)broadcast(study, &message,
                        NULL); /* a worker that cannot be reached is lost with all others */
    cz_memory_text_free(&message);
    study->is_known = false;
}
