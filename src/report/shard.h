/* The lines of shard.jsonl. */
#ifndef CZ_REPORT_SHARD_H
#define CZ_REPORT_SHARD_H

#include "crushzone/report.h"
#include "report/lines.h"

#define CZ_SHARD_FILE "shard.jsonl"

/* Whether the results of a report are those of a shard, and their file. */
bool cz_shard_is(const CzReport *report);
void cz_shard_write(const CzReport *report, FILE *stream);

/* Reads a head; false when the line is damaged, or without memory. */
bool cz_shard_read_head(CzLineCursor *cursor, CzShardHead *head);

/* Reads the line of a sample, whose values must be those that the sampling draws, or of a point;
 * `k` counts from 0. False when the line is damaged, or without memory. */
bool cz_shard_read_sample(CzLineCursor *cursor, int k, CzSampling *sampling);
bool cz_shard_read_point(CzLineCursor *cursor, int k, CzSweep *sweep);

#endif
