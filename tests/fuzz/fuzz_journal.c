/* Any bytes as the journal of a search, or as shards. */
#include "fuzz/fuzz.h"

#include "crushzone/shards.h"
#include "report/journal.h"
#include "report/shard.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The lines behind the head, as samples and as points of a study of two lines. */
static void read_rows(const uint8_t *data, size_t n_byte) {
    enum { N = 2 };
    CzSample sample[N];
    CzSweepPoint point[N];
    memset(sample, 0, sizeof sample);
    memset(point, 0, sizeof point);
    double value[N * N] = {1, 2, 1, 2}, margin[N * N];
    CzVerdict verdict[N * N];
    CzSampling sampling = {.n_sample = N,
                           .n_draw = N,
                           .value = value,
                           .n_check = N,
                           .sample = sample,
                           .margin = margin,
                           .verdict = verdict};
    CzSweep sweep = {.n_point = N, .n_metric = 1, .point = point};
    char *text = malloc(n_byte + 1), *next = NULL;
    FUZZ_DEMAND(text != NULL);
    for (int samples = 0; samples < 2; samples++) {
        memcpy(text, data, n_byte);
        text[n_byte] = '\0';
        for (char *line = strtok_r(text, "\n", &next); line != NULL;
             line = strtok_r(NULL, "\n", &next)) {
            CzArena arena = {0};
            CzLineCursor cursor = {.at = line, .arena = &arena};
            if (samples ? cz_shard_read_sample(&cursor, 0, &sampling)
                        : cz_shard_read_point(&cursor, 0, &sweep))
                FUZZ_DEMAND(sample->check < N && strlen(point->message) < sizeof point->message);
            cz_arena_free(&arena);
        }
    }
    free(sample[0].message);
    free(text);
}

/* The heads of shards have what merge needs: every shard is there once, or is due. */
static void read_shards(const uint8_t *data, size_t n_byte) {
    const char *folder = ".";
    CzShards *shards = NULL;
    CzError error = {0};
    (void)fuzz_write_file("shard.jsonl", data, n_byte);
    const CzStatus status = cz_shards_read(1, &folder, &shards, &error);
    FUZZ_DEMAND(status == CZ_OK || (status == CZ_STATUS_INPUT && error.message[0] != '\0'));
    FUZZ_DEMAND((status == CZ_OK) == (shards != NULL));
    for (int i = 0; shards != NULL && i < shards->n_due; i++) {
        FUZZ_DEMAND(shards->due[i].shard >= 1 && shards->due[i].shard <= shards->head[0].n_shard);
        FUZZ_DEMAND(i == 0 || shards->due[i].shard > shards->due[i - 1].shard);
    }
    cz_shards_free(shards);
    read_rows(data, n_byte);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte) {
    static const char shard[] = "{\"format\": \"crushzone.shard\"";
    if (n_byte >= sizeof shard && memcmp(data, shard, sizeof shard - 1) == 0) {
        read_shards(data, n_byte);
        return 0;
    }
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
