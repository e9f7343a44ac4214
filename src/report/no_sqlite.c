/* Databases of a program that was built without SQLite: there are none. */
#include "report/database.h"

#include "base/error.h"

#include <stddef.h>

static CzStatus refuse(CzError *error) {
    return cz_fail(error, CZ_STATUS_INPUT,
                   "this program was built without SQLite" CZ_HELP
                   "build it where libsqlite3-dev is installed; tables are in the CSV files too");
}

bool cz_database_is_available(void) {
    return false;
}

CzStatus cz_database_begin(const char *path, CzDatabase **database, CzError *error) {
    (void)path;
    *database = NULL;
    return refuse(error);
}

CzStatus cz_database_table(CzDatabase *database, const char *name, int n_column,
                           const char *const *column, CzError *error) {
    (void)database;
    (void)name;
    (void)n_column;
    (void)column;
    return refuse(error);
}

CzStatus cz_database_put(CzDatabase *database, int n_column, const CzCell *cell, CzError *error) {
    (void)database;
    (void)n_column;
    (void)cell;
    return refuse(error);
}

CzStatus cz_database_end(CzDatabase *database, bool is_whole, CzError *error) {
    (void)database;
    (void)is_whole;
    (void)error;
    return CZ_OK;
}
