/* The one reader of curve files: two columns of numbers from files of testing machines,
 * spreadsheets and programs, or a curve of an LS-DYNA keyword file (curve_dyna.h).
 *
 *   lines before the titles                 skipped (a preamble), as are comments
 *   one line of titles, perhaps one of units
 *   points to the end of the file
 *
 * A file without titles is read when columns and units are given, as numbers or as titles that end
 * in units. An ambiguous file is rejected
 * with both readings.
 */
#ifndef CZ_TEXT_CURVE_FILE_H
#define CZ_TEXT_CURVE_FILE_H

#include "text/curve_columns.h"

/* Reads a file that `place` names (NULL: none does) and adds it to the sources, its lines as they
 * are read: UTF-8, whatever the encoding of the file. False with a mistake, or without memory. */
bool cz_curve_points_read(CzSources *sources, CzMistakes *mistakes, const char *path,
                          const CzNode *place, const CzCurveRequest *request,
                          CzCurvePoints *points);

/* Reads a file ("-" is standard input), or the same from memory, whose name in messages is `name`.
 * Statuses: CZ_OK, CZ_STATUS_INPUT with the first mistake, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_curve_points_read_file(CzArena *arena, const char *path,
                                                 const CzCurveRequest *request,
                                                 CzCurvePoints *points, CzError *error);
CZ_MUST_CHECK CzStatus cz_curve_points_read_memory(CzArena *arena, const char *name,
                                                   const char *text, size_t n_byte,
                                                   const CzCurveRequest *request,
                                                   CzCurvePoints *points, CzError *error);

/* The line of titles of a file, and the separator of its fields, which is searched for unless it is
 * given. Statuses as above. */
CZ_MUST_CHECK CzStatus cz_curve_titles_read(CzArena *arena, const char *path, char *separator,
                                            const char **titles, CzError *error);

#endif
