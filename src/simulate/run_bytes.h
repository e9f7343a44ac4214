/* A run as bytes, for another process. */
#ifndef CZ_SIMULATE_RUN_BYTES_H
#define CZ_SIMULATE_RUN_BYTES_H

#include "base/bytes.h"
#include "crushzone/simulate.h"

/* Appends summary and channels of a run. */
void cz_run_put(CzMemoryText *bytes, const CzRun *run);

/* Makes the run again; the caller frees it. Status: CZ_OK, CZ_STATUS_NO_MEMORY also for bytes that
 * are not those of a run. */
CZ_MUST_CHECK CzStatus cz_run_get(CzReading *reading, CzRun **run, CzError *error);

#endif
