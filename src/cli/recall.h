/* Result folders read back: the log of a run, and the search that a folder holds. */
#ifndef CZ_CLI_RECALL_H
#define CZ_CLI_RECALL_H

#include "cli/session.h"

/* Contents of run.log. */
typedef struct CzRunLog {
    bool is_ours;                /* of this version */
    char scenario[CZ_NAME_ROOM]; /* the last one */
    bool is_of_search;
    CzOutcomeStatus status; /* of the search */
    char why_stopped[160];
} CzRunLog;

/* Reads run.log of a folder; what is not in it is empty. */
CzRunLog cz_recall_log(const char *folder);

/* Whether a file is in a folder, or a folder holds a search. */
bool cz_recall_is_there(const char *folder, const char *name);
bool cz_recall_is_search(const char *folder);

/* What to read the best design from: optimised.yaml while the file that it extends is where it was,
 * so that variables keep the paths of that file, else resolved.yaml. */
void cz_recall_problem(const char *folder, char path[4096]);

/* Reads run.log and history.csv of a folder and makes the outcome anew, with the evaluator of the
 * session; freed with cz_outcome_free. Returns the exit code. */
int cz_recall_outcome(const CzSession *session, const char *folder, CzOutcome **outcome);

#endif
