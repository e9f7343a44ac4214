/* A search read back from its result folder. */
#ifndef CZ_CLI_RECALL_H
#define CZ_CLI_RECALL_H

#include "cli/result.h"

/* Whether the folder holds a search. */
bool cz_recall_is_search(const char *folder);

/* What to read the best design from: optimised.yaml while the file that it extends is where it was,
 * so that variables keep the paths of that file, else resolved.yaml. */
void cz_recall_problem(const char *folder, char path[4096]);

/* Reads run.log and history.csv of the folder that the result was begun with and makes the outcome
 * anew; freed with cz_outcome_free. Returns the exit code. */
int cz_recall_outcome(const CzResult *result, const char *folder, CzOutcome **outcome);

#endif
