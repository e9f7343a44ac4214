/* A folder of result files that is put in place as a whole.
 *
 * Files are written into a temporary folder beside the final one, which is renamed at the end. An
 * existing folder is replaced only when crushzone wrote it: it has a marker that lists its files,
 * and no other files. The result of a search is replaced only by another search, or on request.
 */
#ifndef CZ_REPORT_FOLDER_H
#define CZ_REPORT_FOLDER_H

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>

#include "crushzone/status.h"

typedef struct CzFolder {
    char target[PATH_MAX];    /* final path */
    char temporary[PATH_MAX]; /* path while it is being written; empty when there is none */
    FILE *marker;             /* list of files, open and locked while writing */
    FILE *file;               /* file being written, NULL between files */
    char file_name[PATH_MAX];
    bool replaces_search;
} CzFolder;

/* Checks that a folder can be written, without writing it. Status: CZ_STATUS_OUTPUT. */
CZ_MUST_CHECK CzStatus cz_folder_check(const char *path, bool replaces_search, CzError *error);

/* Whether a file is in a folder or its subfolders, following links. */
bool cz_folder_holds(const char *folder, const char *file);

/* Whether a file is listed in the marker of a result folder. */
bool cz_folder_lists(const char *file);

/* Creates the folders above a path; a failure shows when something is created in them. */
void cz_make_parents(const char *path);

/* Begins a folder and creates missing folders above it. After a success the caller ends with
 * cz_folder_finish or cz_folder_abandon. Statuses: CZ_STATUS_OUTPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_folder_begin(CzFolder *folder, const char *path, bool replaces_search,
                                       CzError *error);

/* Opens the next file, such as "summary.json" or "25kmh/channels.csv". The stream belongs to the
 * folder. */
CZ_MUST_CHECK CzStatus cz_folder_open(CzFolder *folder, const char *name, FILE **stream,
                                      CzError *error);

/* Closes the file; fails when a part of it could not be written. */
CZ_MUST_CHECK CzStatus cz_folder_close(CzFolder *folder, CzError *error);

/* Moves the folder to its final path; on failure it is abandoned. */
CZ_MUST_CHECK CzStatus cz_folder_finish(CzFolder *folder, CzError *error);

/* Removes what was written. */
void cz_folder_abandon(CzFolder *folder);

/* Closes a stream; returns 0, or the errno of a failure to write. */
int cz_stream_close(FILE *stream);

#endif
