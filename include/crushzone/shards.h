/* Shards: parts of a sampling or of a sweep that were run by themselves, for example on several
 * machines, and are put together to the results of one run.
 *
 * The result folder of a shard has shard.jsonl: a head with all that shards of one study have in
 * common, a line for each sample or point with all digits, and a last line with their number.
 */
#ifndef CRUSHZONE_SHARDS_H
#define CRUSHZONE_SHARDS_H

#include "crushzone/sample.h"
#include "crushzone/sweep.h"

CZ_BEGIN_DECLARATIONS

/* The head of a shard. Texts belong to its shards. */
typedef struct CzShardHead {
    const char *version; /* of the program */
    const char *command; /* "sample" or "sweep" */
    const char *file;    /* problem file, as given on the command line */
    const char *problem; /* its hash, with settings */
    int shard, n_shard;  /* this one, from 1, and their number */
    int n;               /* samples or points of all shards */
    int begin, end;      /* those of this one, from 0, the last one excluded */
    int n_word;
    const char *const *word; /* options of the command line that results depend on (n_word) */
} CzShardHead;

/* A shard that has to be run, again or for the first time. */
typedef struct CzShardDue {
    int shard;
    const char *folder; /* of its incomplete results; NULL when there are none */
    int n_row, n_of;    /* samples or points that it has, and should have */
} CzShardDue;

/* Open result, owns its memory. */
typedef struct CzShards {
    int n_part;
    const char **folder; /* of the shards that were read (n_part) */
    CzShardHead *head;   /* (n_part) */
    int n_unreadable;
    const char **unreadable; /* folders that do not exist, or whose shard has no complete head */
    int n_due;
    CzShardDue *due; /* shards without complete results; in order (n_due) */
    struct CzArena *arena;
} CzShards;

/* Reads the shards of result folders. Statuses: CZ_OK, also when some are due; CZ_STATUS_INPUT for
 * a folder that has no shard, for shards of different studies, with the difference, for one that is
 * given twice, and when no folder can be read; CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_shards_read(int n, const char *const *folder, CzShards **shards,
                                             CzError *error);
CZ_API void cz_shards_free(CzShards *shards);

/* Fill the results of all shards, as CzSampleRecall and CzSweepRecall with `shards` as data.
 * Statuses: CZ_STATUS_INPUT for another problem than that of the shards, or a damaged line;
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_shards_fill_samples(CzSampling *sampling, void *shards,
                                                     CzError *error);
CZ_MUST_CHECK CZ_API CzStatus cz_shards_fill_sweep(CzSweep *sweep, void *shards, CzError *error);

CZ_END_DECLARATIONS
#endif
