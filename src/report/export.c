/* Result folders as a database: every CSV file is a table, every JSON document a row of
 * `documents`.
 *
 * Rows begin with the folder and the scenario, which is that of the file or its subfolder, or NULL.
 * A column is of numbers when all its fields are; the same table of several folders has the columns
 * of all.
 */
#include "crushzone/report.h"

#include "base/arena.h"
#include "base/error.h"
#include "base/number.h"
#include "base/stream.h"
#include "report/database.h"
#include "report/temporary.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { N_KEY = 2 }; /* columns before those of the file */

/* A file of a result folder. */
typedef struct Part {
    const char *folder;   /* as it was given */
    const char *name;     /* in the folder, such as "25-km-h/channels.csv" */
    const char *scenario; /* the subfolder; NULL at the top */
    char *text;           /* whole content, cut in place */
} Part;

/* A table while it is read. Fields are in the text of the file. */
typedef struct Table {
    CzArena arena;
    int n_column, n_row;
    const char **column; /* with the keys (n_column) */
    char ***row;         /* fields of each row, NULL for empty ones (n_row x n_column - N_KEY) */
    bool *is_number;     /* of each column behind the keys (n_column - N_KEY) */
    char separator;
    bool has_scenario; /* the file has a column of that name, which takes the place of the key */
} Table;

/* ---- a CSV file ---- */

/* Cuts the next field, in place: quotes around it are removed, doubled ones within made single.
 * `at` is moved to the next field, to NULL behind the last one of the row. */
static char *cut_field(char **at, char separator) {
    char *field = *at, *from = field, *to = field;
    bool in_quotes = false;
    for (; *from != '\0' && (in_quotes || (*from != separator && *from != '\n')); from++) {
        if (*from == '"' && in_quotes && from[1] == '"')
            *to++ = *from++;
        else if (*from == '"')
            in_quotes = !in_quotes;
        else if (*from != '\r')
            *to++ = *from;
    }
    *at = *from == separator ? from + 1 : NULL;
    *to = '\0';
    return field;
}

/* The beginning of the next row; NULL at the end. The rows are found before fields are cut. */
static char *find_row(char *at) {
    bool in_quotes = false;
    for (; *at != '\0'; at++) {
        in_quotes ^= *at == '"';
        if (*at == '\n' && !in_quotes)
            return at[1] != '\0' ? at + 1 : NULL;
    }
    return NULL;
}

/* The separator of a line of titles. */
static char find_separator(const char *text) {
    static const char separators[] = ";\t,";
    const size_t n = strcspn(text, "\n");
    for (const char *separator = separators; *separator != '\0'; separator++)
        if (memchr(text, *separator, n) != NULL)
            return *separator;
    return ',';
}

/* The field without the apostrophe that keeps spreadsheets from reading a formula. */
static char *without_guard(char *field) {
    return field[0] == '\'' && field[1] != '\0' && strchr("=+-@", field[1]) != NULL ? field + 1
                                                                                    : field;
}

/* Reads a number; with another separator than a comma its decimal sign may be one. */
static bool read_number(const Table *table, const char *field, double *number) {
    char text[CZ_NUMBER_TEXT + 8];
    if (strlen(field) >= sizeof text)
        return false;
    strcpy(text, field);
    char *comma = table->separator != ',' ? strchr(text, ',') : NULL;
    if (comma != NULL)
        *comma = '.';
    return cz_number_parse(text, number) == NULL;
}

static bool cut_titles(char *at, Table *table) {
    int n = N_KEY;
    for (const char *c = at; *c != '\0' && *c != '\n'; c++)
        n += *c == table->separator;
    table->column = cz_arena_allocate(&table->arena, (size_t)n + 1, sizeof *table->column);
    table->is_number = cz_arena_allocate(&table->arena, (size_t)n + 1, sizeof(bool));
    if (table->column == NULL || table->is_number == NULL)
        return false;
    table->column[0] = "folder";
    table->column[1] = "scenario";
    table->n_column = N_KEY;
    while (at != NULL && table->n_column <= n) {
        const char *title = without_guard(cut_field(&at, table->separator));
        table->is_number[table->n_column - N_KEY] = true;
        table->has_scenario |= strcmp(title, "scenario") == 0;
        table->column[table->n_column++] = title;
    }
    return true;
}

static bool cut_row(char *at, Table *table) {
    const int n = table->n_column - N_KEY;
    char ***rows = cz_arena_grow(&table->arena, table->row, table->n_row, sizeof *rows);
    char **field = cz_arena_allocate(&table->arena, (size_t)n, sizeof *field);
    if (rows == NULL || field == NULL)
        return false;
    table->row = rows;
    for (int i = 0; i < n && at != NULL; i++) {
        double number;
        field[i] = without_guard(cut_field(&at, table->separator));
        if (field[i][0] == '\0')
            field[i] = NULL;
        else
            table->is_number[i] &= read_number(table, field[i], &number);
    }
    table->row[table->n_row++] = field;
    return true;
}

static bool read_table(char *text, Table *table) {
    table->separator = find_separator(text);
    char *next = find_row(text);
    if (!cut_titles(text, table))
        return false;
    while (next != NULL) {
        char *row = next;
        next = find_row(row);
        if (!cut_row(row, table))
            return false;
    }
    return true;
}

/* ---- into the database ---- */

/* Name of the table of a file: "channels" of "25-km-h/channels.csv". */
static void name_table(const Part *part, char name[CZ_NAME_SIZE]) {
    const char *slash = strrchr(part->name, '/');
    const char *file = slash != NULL ? slash + 1 : part->name;
    snprintf(name, CZ_NAME_SIZE, "%.*s", (int)strcspn(file, "."), file);
}

static CzStatus put_table(CzDatabase *database, const Part *part, Table *table, CzError *error) {
    char name[CZ_NAME_SIZE];
    CzCell *cell = cz_arena_allocate(&table->arena, (size_t)table->n_column, sizeof *cell);
    if (cell == NULL)
        return cz_no_memory(error, "the tables");
    name_table(part, name);
    /* Without the key of the scenario, the folder is in its place. */
    const int first = table->has_scenario ? 1 : 0, n = table->n_column - first;
    cell[1].text = part->scenario;
    cell[first].text = part->folder;
    table->column[first] = "folder";
    CZ_TRY(cz_database_table(database, name, n, table->column + first, error));
    for (int i = 0; i < table->n_row; i++) {
        for (int k = N_KEY; k < table->n_column; k++) {
            const char *field = table->row[i][k - N_KEY];
            cell[k] = (CzCell){.text = field};
            if (field != NULL && table->is_number[k - N_KEY])
                cell[k].is_number = read_number(table, field, &cell[k].number);
        }
        CZ_TRY(cz_database_put(database, n, cell + first, error));
    }
    return CZ_OK;
}

static CzStatus put_document(CzDatabase *database, const Part *part, CzError *error) {
    static const char *const columns[] = {"folder", "name", "document"};
    char name[CZ_NAME_SIZE];
    name_table(part, name);
    const CzCell cell[] = {{.text = part->folder}, {.text = name}, {.text = part->text}};
    CZ_TRY(cz_database_table(database, "documents", 3, columns, error));
    return cz_database_put(database, 3, cell, error);
}

/* ---- the files of a folder ---- */

/* Reads a file whole; NULL without memory, or with the reason in errno. */
static char *read_file(const char *path) {
    FILE *stream = fopen(path, "rb");
    size_t n;
    char *text = stream != NULL ? cz_stream_read(stream, SIZE_MAX, &n) : NULL;
    if (stream != NULL)
        fclose(stream);
    return text;
}

static bool ends_in(const char *name, const char *end) {
    const size_t n = strlen(name), n_end = strlen(end);
    return n > n_end && strcmp(name + n - n_end, end) == 0;
}

/* Whether a file is a copy of input, or is of an unfinished search. */
static bool is_left_out(const char *name) {
    static const char *const folders[] = {"measured/", "profiles/", "replay/", "unfinished/",
                                          "iso-mme/"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++)
        if (strncmp(name, folders[i], strlen(folders[i])) == 0)
            return true;
    return false;
}

static CzStatus put_part(CzDatabase *database, Part *part, CzError *error) {
    char path[PATH_MAX];
    CZ_TRY(cz_path_in(path, part->folder, part->name, error));
    part->text = read_file(path);
    if (part->text == NULL)
        return cz_fail(error, CZ_STATUS_INPUT, "%.300s cannot be read", path);
    Table table = {0};
    CzStatus status = CZ_OK;
    if (ends_in(part->name, ".json"))
        status = put_document(database, part, error);
    else if (read_table(part->text, &table))
        status = put_table(database, part, &table, error);
    else
        status = cz_no_memory(error, "the tables");
    cz_arena_free(&table.arena);
    free(part->text);
    return status;
}

static CzStatus put_folder(CzDatabase *database, const char *folder, CzError *error) {
    char *marker = cz_marker_read(folder);
    CzStatus status = CZ_OK;
    if (marker == NULL)
        return cz_fail(error, CZ_STATUS_INPUT, "%.300s is not a result folder of crushzone",
                       folder);
    for (char *line = marker; line != NULL && status == CZ_OK;) {
        char *end = strchr(line, '\n'), scenario[CZ_NAME_SIZE];
        if (end != NULL)
            *end = '\0';
        const size_t n_scenario = strcspn(line, "/");
        const bool is_deep = line[n_scenario] == '/' && n_scenario < sizeof scenario;
        Part part = {.folder = folder, .name = line};
        if (is_deep) {
            snprintf(scenario, sizeof scenario, "%.*s", (int)n_scenario, line);
            part.scenario = scenario;
        }
        if ((ends_in(line, ".csv") || ends_in(line, ".json")) && !is_left_out(line))
            status = put_part(database, &part, error);
        line = end != NULL ? end + 1 : NULL;
    }
    free(marker);
    return status;
}

CzStatus cz_report_export(int n_folder, const char *const *folder, const char *path,
                          CzError *error) {
    char above[PATH_MAX], temporary[PATH_MAX];
    FILE *stream = NULL;
    CzDatabase *database = NULL;
    CZ_TRY(cz_report_check_file(NULL, path, false, error));
    cz_parent_of(path, above);
    int why = cz_temporary_file(above, temporary, &stream);
    if (why != 0)
        return cz_cannot_write(path, why, error);
    CzStatus status = cz_database_begin(temporary, &database, error);
    for (int i = 0; i < n_folder && status == CZ_OK; i++)
        status = put_folder(database, folder[i], error);
    const CzStatus ended = cz_database_end(database, status == CZ_OK, error);
    status = status == CZ_OK ? ended : status;
    if (status == CZ_OK && rename(temporary, path) != 0)
        status = cz_cannot_write(path, errno, error);
    if (status != CZ_OK)
        (void)unlink(temporary);
    fclose(stream); /* releases the lock */
    return status;
}
