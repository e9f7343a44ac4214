/* The file of --junit. */
#ifndef CZ_CLI_JUNIT_FILE_H
#define CZ_CLI_JUNIT_FILE_H

#include "cli/arguments.h"
#include "crushzone/report.h"

/* Begins the document where --junit asks for one; refuses a file that cannot be written. Returns
 * the exit code of a failure, 0 without. *junit is NULL where there is none. */
CZ_MUST_CHECK int cz_junit_file_begin(const CzArguments *arguments, CzJunit **junit);

/* Writes and frees the document, if any; returns the exit code of a failure, 0 without. */
CZ_MUST_CHECK int cz_junit_file_end(const CzArguments *arguments, CzJunit *junit);

/* Adds a file that was not judged; nothing without a document. */
void cz_junit_file_add_unjudged(CzJunit *junit, const char *file);

#endif
