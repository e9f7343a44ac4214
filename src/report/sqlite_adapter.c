/* Databases by SQLite: the only file that includes it. */
#include "report/database.h"

#include "base/error.h"

#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

struct CzDatabase {
    sqlite3 *handle;
    sqlite3_stmt *row; /* that puts a row of the present table; NULL before the first */
};

/* Largest whole number that a double has with all smaller ones. */
static const double largest_whole = 9007199254740992.0;

bool cz_database_is_available(void) {
    return true;
}

static CzStatus refuse(const CzDatabase *database, int code, CzError *error) {
    if (code == SQLITE_NOMEM)
        return cz_no_memory(error, "the database");
    return cz_fail(error, CZ_STATUS_OUTPUT, "the database cannot be written: %.300s",
                   database->handle != NULL ? sqlite3_errmsg(database->handle)
                                            : sqlite3_errstr(code));
}

static CzStatus execute(const CzDatabase *database, const char *statement, CzError *error) {
    if (statement == NULL)
        return cz_no_memory(error, "the database");
    const int code = sqlite3_exec(database->handle, statement, NULL, NULL, NULL);
    return code == SQLITE_OK ? CZ_OK : refuse(database, code, error);
}

/* Executes a statement that SQLite made, and frees it. */
static CzStatus execute_made(const CzDatabase *database, char *statement, CzError *error) {
    const CzStatus status = execute(database, statement, error);
    sqlite3_free(statement);
    return status;
}

CzStatus cz_database_begin(const char *path, CzDatabase **database, CzError *error) {
    CzDatabase *made = calloc(1, sizeof *made);
    *database = made;
    if (made == NULL)
        return cz_no_memory(error, "the database");
    const int code = sqlite3_open_v2(path, &made->handle, SQLITE_OPEN_READWRITE, NULL);
    if (code != SQLITE_OK)
        return refuse(made, code, error);
    /* The file is new and is put in place at the end, so that no journal has to undo anything. */
    return execute(made, "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; BEGIN", error);
}

/* Whether the present tables have a column. */
static bool has_column(const CzDatabase *database, const char *table, const char *column) {
    return sqlite3_table_column_metadata(database->handle, NULL, table, column, NULL, NULL, NULL,
                                         NULL, NULL) == SQLITE_OK;
}

/* Prepares the statement that puts a row. */
static CzStatus prepare_row(CzDatabase *database, const char *name, int n_column,
                            const char *const *column, CzError *error) {
    char *text = sqlite3_mprintf("INSERT INTO \"%w\" (", name);
    for (int i = 0; i < n_column && text != NULL; i++)
        text = sqlite3_mprintf("%z%s\"%w\"", text, i > 0 ? ", " : "", column[i]);
    for (int i = 0; i < n_column && text != NULL; i++)
        text = sqlite3_mprintf("%z%s?", text, i > 0 ? ", " : ") VALUES (");
    if (text != NULL)
        text = sqlite3_mprintf("%z)", text);
    if (text == NULL)
        return cz_no_memory(error, "the database");
    sqlite3_finalize(database->row);
    database->row = NULL;
    const int code = sqlite3_prepare_v2(database->handle, text, -1, &database->row, NULL);
    sqlite3_free(text);
    return code == SQLITE_OK ? CZ_OK : refuse(database, code, error);
}

CzStatus cz_database_table(CzDatabase *database, const char *name, int n_column,
                           const char *const *column, CzError *error) {
    CZ_TRY(execute_made(
        database, sqlite3_mprintf("CREATE TABLE IF NOT EXISTS \"%w\" (\"%w\")", name, column[0]),
        error));
    for (int i = 1; i < n_column; i++)
        if (!has_column(database, name, column[i]))
            CZ_TRY(execute_made(
                database, sqlite3_mprintf("ALTER TABLE \"%w\" ADD COLUMN \"%w\"", name, column[i]),
                error));
    return prepare_row(database, name, n_column, column, error);
}

CzStatus cz_database_put(CzDatabase *database, int n_column, const CzCell *cell, CzError *error) {
    for (int i = 0; i < n_column; i++) {
        const double number = cell[i].number;
        const bool is_whole = cell[i].is_number && number > -largest_whole &&
                              number < largest_whole && number == (double)(sqlite3_int64)number;
        const int code =
            cell[i].text == NULL ? sqlite3_bind_null(database->row, i + 1)
            : is_whole           ? sqlite3_bind_int64(database->row, i + 1, (sqlite3_int64)number)
            : cell[i].is_number
                ? sqlite3_bind_double(database->row, i + 1, number)
                : sqlite3_bind_text(database->row, i + 1, cell[i].text, -1, SQLITE_STATIC);
        if (code != SQLITE_OK)
            return refuse(database, code, error);
    }
    const int code = sqlite3_step(database->row);
    (void)sqlite3_reset(database->row); /* reports the failure of the step again */
    return code == SQLITE_DONE ? CZ_OK : refuse(database, code, error);
}

CzStatus cz_database_end(CzDatabase *database, bool is_whole, CzError *error) {
    CzStatus status = CZ_OK;
    if (database == NULL)
        return CZ_OK;
    sqlite3_finalize(database->row);
    if (is_whole)
        status = execute(database, "COMMIT", error);
    sqlite3_close(database->handle);
    free(database);
    return status;
}
