/* The journal of a search, and the options of one that is resumed. */
#ifndef CZ_CLI_RESUME_H
#define CZ_CLI_RESUME_H

#include "cli/session.h"

/* Opens the journal in a folder; with --resume its options are added to those of the command line.
 * Returns the exit code. The caller ends the journal in any case. */
CZ_MUST_CHECK int cz_resume_open(CzArguments *arguments, const char *folder,
                                 CzJournalFile **journal);

/* Whether the journal of a search that failed with this status has nothing worth keeping. */
bool cz_resume_is_useless(CzStatus status);

#endif
