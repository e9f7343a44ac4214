/* Reads result folders: the log of a run, and the search in a folder. */
#ifndef CZ_CLI_RECALL_H
#define CZ_CLI_RECALL_H

#include "cli/session.h"

/* Contents of run.log. */
typedef struct CzRunLog {
    bool is_ours;                /* written by this version */
    char scenario[CZ_NAME_SIZE]; /* the last one */
    bool is_of_search;
    CzOutcomeStatus status; /* of the search */
    char why_stopped[160];
} CzRunLog;

/* Reads run.log of a folder; missing entries are empty. */
CzRunLog cz_recall_log(const char *folder);

/* Whether a file is in a folder, or a folder is the result of a search. */
bool cz_recall_exists(const char *folder, const char *name);
bool cz_recall_is_search(const char *folder);

/* File from which to read the best design: optimised.yaml as long as the file that it extends is
 * still there, so that variables keep the paths of that file, else resolved.yaml. */
void cz_recall_problem(const char *folder, char path[4096]);

/* Reads run.log and history.csv of a folder and reconstructs the outcome with the evaluator of the
 * session; freed with cz_outcome_free. Returns the exit code. */
int cz_recall_outcome(const CzSession *session, const char *folder, CzOutcome **outcome);

#endif
