/* Temporary files and folders beside what they become: unique, exclusive, ours while we live.
 *
 * A name is .crushzone- and sixteen digits and letters, so it is as short for a long name as for a
 * short one. Its maker holds a lock on the file, or on the marker in the folder, and the system
 * lets the lock go when the maker dies, however it dies; so whoever gets the lock of such a name
 * knows that nobody is at work on it and may clear it away. Process numbers would not do: in a
 * container the next run has the number of the last.
 */
#ifndef CZ_REPORT_TEMPORARY_H
#define CZ_REPORT_TEMPORARY_H

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>

#include "crushzone/status.h"

/* Name of the marker in a folder of ours; what it holds is folder.c's. */
#define CZ_MARKER_NAME ".crushzone"
/* First line of a marker, and the line that says that its folder is whole. */
#define CZ_MARKER_HEAD "crushzone results\n"
#define CZ_MARKER_WHOLE "# whole\n"
/* Beginnings of lines with the name of the folder that one is to become, or was before another took
 * its place. */
#define CZ_MARKER_MADE_FOR "# for "
#define CZ_MARKER_MOVED "# was "

/* The folder above a path, "." for a plain name. */
void cz_parent_of(const char *path, char parent[PATH_MAX]);

/* A path inside a folder; CZ_STATUS_OUTPUT when it is too long. */
CZ_MUST_CHECK CzStatus cz_path_in(char path[PATH_MAX], const char *folder, const char *name,
                                  CzError *error);

/* The sentence that a path cannot be written, with the reason of an errno: CZ_STATUS_OUTPUT, or
 * CZ_STATUS_NO_MEMORY. */
CzStatus cz_cannot_write(const char *path, int why, CzError *error);

/* These return 0, or the errno of what could not be done. */

/* A name that nothing has. */
int cz_temporary_name(const char *folder, char path[PATH_MAX]);

/* Makes an empty file in a folder, locked and open for writing. Clears what dead makers left there.
 */
int cz_temporary_file(const char *folder, char path[PATH_MAX], FILE **stream);

/* Makes a folder in a folder, with a marker that is locked and open for writing. */
int cz_temporary_folder(const char *folder, char path[PATH_MAX], FILE **marker);

/* Removes the files that a folder's marker lists, temporary ones, the marker, and the folders that
 * are empty then. Links are removed, not followed. */
void cz_remove_listed(const char *folder);

/* Whether a name of a file or folder is that of a temporary one. */
bool cz_is_temporary(const char *name);

/* Reads the marker of a folder: the lines after its head, freed by the caller; NULL when the folder
 * is not ours, or without memory. */
char *cz_marker_read(const char *folder);

/* Whether a marker's folder is whole, and whether a line of it is `what` and a name. */
bool cz_marker_is_whole(const char *marker);
bool cz_marker_says(const char *marker, const char *what, const char *name);

/* Adds a line, such as CZ_MARKER_MOVED and a name, to the marker of a folder. */
void cz_marker_add(const char *folder, const char *what, const char *name);

/* Opens a file and takes its lock; -1 when somebody else has it. */
int cz_temporary_take(const char *path);

#endif
