/* Shards on the command line: the options that their results depend on. */
#ifndef CZ_CLI_SHARD_H
#define CZ_CLI_SHARD_H

#include "cli/session.h"
#include "crushzone/shards.h"

/* As cz_session_deliver; with --shard the folder has the options that results depend on. */
CZ_MUST_CHECK int cz_session_deliver_shard(CzSession *session, const CzReport *report);

/* The commands `sample` and `sweep` with results that are known; `shards` NULL: none. */
int cz_sample_shards(const CzArguments *arguments, CzShards *shards);
int cz_sweep_shards(const CzArguments *arguments, CzShards *shards);

#endif
