/* Temporary files and folders beside their final path: with unique names, locked by the process
 * that creates them.
 *
 * A name is .crushzone- and sixteen digits and letters, whatever the length of the final name. That
 * process holds a lock on the file, or on the marker in the folder. The system releases the lock
 * when the process ends, so another process that gets the lock may remove the file or folder.
 * Process numbers do not suffice: in a container the next run may have the number of the last.
 */
#ifndef CZ_REPORT_TEMPORARY_H
#define CZ_REPORT_TEMPORARY_H

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <sys/stat.h>

#include "crushzone/status.h"

/* Name of the marker in a result folder; folder.c writes it. */
#define CZ_MARKER_NAME ".crushzone"
/* First line of a marker, and the line of a complete folder. */
#define CZ_MARKER_HEAD "crushzone results\n"
#define CZ_MARKER_WHOLE "# whole\n"
/* Beginnings of lines with the final name of the folder, and with its name before it was replaced.
 */
#define CZ_MARKER_MADE_FOR "# for "
#define CZ_MARKER_MOVED "# was "

/* The folder above a path, "." for a plain name. */
void cz_parent_of(const char *path, char parent[PATH_MAX]);

/* A path inside a folder; CZ_STATUS_OUTPUT when it is too long. */
CZ_MUST_CHECK CzStatus cz_path_in(char path[PATH_MAX], const char *folder, const char *name,
                                  CzError *error);

/* Reports that a path cannot be written, with the reason of an errno: CZ_STATUS_OUTPUT, or
 * CZ_STATUS_NO_MEMORY. */
CzStatus cz_cannot_write(const char *path, int why, CzError *error);

/* These return 0, or the errno of the failure. */

/* A name that is not used yet. */
int cz_temporary_name(const char *folder, char path[PATH_MAX]);

/* Removes temporary files and folders of dead processes in a folder. */
void cz_temporary_clear(const char *folder);

/* Creates an empty file in a folder, locked and open for writing; removes temporary files of dead
 * processes there. */
int cz_temporary_file(const char *folder, char path[PATH_MAX], FILE **stream);

/* Creates a folder in a folder, with a marker that is locked and open for writing. */
int cz_temporary_folder(const char *folder, char path[PATH_MAX], FILE **marker);

/* Removes the files that the marker of a folder lists, temporary files, the marker, then the empty
 * folders. Links are removed, not followed. */
void cz_remove_listed(const char *folder);
/* The same with a marker that was read before. */
void cz_remove_files(const char *folder, const char *marker);

/* Whether a name is that of a temporary file or folder; passes each of these in a folder to `look`.
 */
bool cz_is_temporary(const char *name);
typedef void CzLook(const char *path, const struct stat *info, void *data);
void cz_each_temporary(const char *folder, CzLook *look, void *data);

/* Reads the marker of a folder: the lines after its head, freed by the caller; NULL when it has
 * none, or without memory. */
char *cz_marker_read(const char *folder);

/* Whether the folder of a marker is complete; whether one of its lines is `what`, the name, and
 * `end`. */
bool cz_marker_is_whole(const char *marker);
bool cz_marker_lists(const char *marker, const char *what, const char *name, char end);

/* Adds a line, such as CZ_MARKER_MOVED and a name, to the marker of a folder. */
void cz_marker_add(const char *folder, const char *what, const char *name);

/* Opens a file and locks it; -1 when another process holds the lock. */
int cz_temporary_take(const char *path);

#endif
