/* A database of tables that a program for SQLite reads. sqlite_adapter.c writes it; where the
 * library is missing, no_sqlite.c takes its place, and nothing can be written.
 */
#ifndef CZ_REPORT_DATABASE_H
#define CZ_REPORT_DATABASE_H

#include <stdbool.h>

#include "crushzone/status.h"

typedef struct CzDatabase CzDatabase;

/* A value of a row. */
typedef struct CzCell {
    const char *text; /* NULL for a missing value */
    bool is_number;
    double number;
} CzCell;

/* Whether databases can be written. */
bool cz_database_is_available(void);

/* Begins a database in an empty file. Statuses: CZ_OK, CZ_STATUS_INPUT where databases cannot be
 * written, CZ_STATUS_OUTPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_database_begin(const char *path, CzDatabase **database, CzError *error);

/* Adds a table, or columns to a table that exists; names are as they are. Then rows of these
 * columns, in this order, are put. Statuses: CZ_OK, CZ_STATUS_OUTPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_database_table(CzDatabase *database, const char *name, int n_column,
                                         const char *const *column, CzError *error);
CZ_MUST_CHECK CzStatus cz_database_put(CzDatabase *database, int n_column, const CzCell *cell,
                                       CzError *error);

/* Ends the database, with success only when `is_whole`, and frees it; NULL is allowed. Statuses:
 * CZ_OK, CZ_STATUS_OUTPUT. */
CZ_MUST_CHECK CzStatus cz_database_end(CzDatabase *database, bool is_whole, CzError *error);

#endif
