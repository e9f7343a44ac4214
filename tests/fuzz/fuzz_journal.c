/* Any bytes as the journal of a search. */
#include "fuzz/fuzz.h"

#include "report/journal.h"

#include <math.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte) {
    CzArena arena = {0};
    CzJournalText text;
    CzError error = {0};
    FILE *stream = fopen(fuzz_write_file("history.jsonl", data, n_byte), "r");
    FUZZ_DEMAND(stream != NULL);
    const CzStatus status = cz_journal_read("history.jsonl", stream, &arena, &text, &error);
    fclose(stream);
    FUZZ_DEMAND(status == CZ_OK || (status == CZ_STATUS_INPUT && error.message[0] != '\0'));
    FUZZ_DEMAND(text.n_whole <= (long)n_byte);
    const CzJournalHead *head = &text.start.head;
    for (int i = 0; status == CZ_OK && i < head->n_set; i++)
        FUZZ_DEMAND(strlen(head->set[i]) <= n_byte);
    double sum = 0; /* all numbers can be read */
    for (long i = 0; status == CZ_OK && i < head->n_answer; i++) {
        const CzAnswer *answer = &text.answer[i];
        for (int k = 0; k < text.start.n_variable; k++)
            sum += answer->x[k];
        for (int k = 0; k < answer->n_constraint; k++)
            sum += answer->constraint[k];
        for (int k = 0; k < answer->n_detail; k++)
            sum += answer->detail[k];
    }
    FUZZ_DEMAND(isnan(sum) || !isnan(sum));
    cz_arena_free(&arena);
    return 0;
}
