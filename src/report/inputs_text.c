/* The resolved problem by lines, as cz_problem_write_resolved writes it: two spaces per level, one
 * key a line, the origin after #. */
#include "report/inputs_text.h"

#include "base/error.h"
#include "base/memory_text.h"
#include "text/node.h"
#include "problem/problem.h"
#include "report/table.h"

#include <stdlib.h>
#include <string.h>

enum { CAR_INDENT = 6, MAX_LEVELS = 16, MAX_DEFAULTS = 400 };

static int indent_of(const char *line) {
    return (int)strspn(line, " ");
}

/* The parts at the end of a line's origin, as ", part tube, part coupler"; its end for none. */
static char *parts_of(char *line) {
    char *origin = strchr(line, '#');
    char *parts = origin != NULL ? strstr(origin, ", part ") : NULL;
    return parts != NULL ? parts : line + strlen(line);
}

/* The line of the record around a line; NULL for none. */
static char *around(const CzInputsText *inputs, int i) {
    const int indent = indent_of(inputs->line[i]);
    while (--i >= 0)
        if (indent_of(inputs->line[i]) < indent)
            return inputs->line[i];
    return NULL;
}

/* Leaves out of each origin the parts that the record around has, too. From the last line to the
 * first, so that records around still have all of theirs. */
static void shorten_origins(CzInputsText *inputs) {
    for (int i = inputs->n_line - 1; i >= 0; i--) {
        char *parts = parts_of(inputs->line[i]), *record = around(inputs, i);
        const char *known = record != NULL ? parts_of(record) : "";
        const size_t n = strlen(parts), n_known = strlen(known);
        if (n_known > 0 && n >= n_known && strcmp(parts + n - n_known, known) == 0)
            parts[n - n_known] = '\0';
    }
}

CzStatus cz_inputs_text_begin(CzInputsText *inputs, const CzProblem *problem, CzError *error) {
    CzMemoryText memory = {0};
    *inputs = (CzInputsText){0};
    const CzSource *source = cz_problem_first_source(problem);
    inputs->folder = source != NULL ? source->folder : "";
    FILE *stream = cz_memory_text_open(&memory);
    if (stream != NULL) {
        cz_problem_write_resolved(problem, stream);
        if (fclose(stream) == 0 && !memory.failed && memory.text != NULL)
            inputs->line = malloc((memory.n + 1) * sizeof *inputs->line);
    }
    inputs->text = memory.text;
    if (inputs->line == NULL) {
        cz_inputs_text_free(inputs);
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the inputs");
    }
    char *next = NULL;
    for (char *line = strtok_r(inputs->text, "\n", &next); line != NULL;
         line = strtok_r(NULL, "\n", &next))
        inputs->line[inputs->n_line++] = line;
    shorten_origins(inputs);
    return CZ_OK;
}

void cz_inputs_text_free(CzInputsText *inputs) {
    free(inputs->line);
    free(inputs->text);
    *inputs = (CzInputsText){0};
}

/* Writes a line, with names of files relative to the problem's folder. */
static void write_line(const CzInputsText *inputs, const char *line, CzMarkup *markup) {
    const size_t n = strlen(inputs->folder);
    char text[2048];
    size_t used = 0;
    while (*line != '\0' && used + 1 < sizeof text) {
        if (n > 0 && strncmp(line, inputs->folder, n) == 0 && line[n] == '/')
            line += n + 1;
        else
            text[used++] = *line++;
    }
    text[used] = '\0';
    cz_markup_write(markup, "%s\n", text);
}

static bool begins_car(const char *line) {
    return indent_of(line) == CAR_INDENT && strncmp(line + CAR_INDENT, "- name: ", 8) == 0;
}

/* The first line after a car or another record. */
static int end_of(const CzInputsText *inputs, int first) {
    int i = first + 1;
    while (i < inputs->n_line && indent_of(inputs->line[i]) > indent_of(inputs->line[first]))
        i++;
    return i;
}

/* Whether two records have the same lines below their first ones. */
static bool are_equal(const CzInputsText *inputs, int a, int b) {
    const int n = end_of(inputs, a) - a;
    if (end_of(inputs, b) - b != n)
        return false;
    for (int i = 1; i < n; i++)
        if (strcmp(inputs->line[a + i], inputs->line[b + i]) != 0)
            return false;
    return true;
}

/* The first line of an earlier car with the same values; -1 when there is none. */
static int same_car(const CzInputsText *inputs, int car) {
    for (int i = 0; i < car; i++)
        if (begins_car(inputs->line[i]) && are_equal(inputs, i, car))
            return i;
    return -1;
}

/* Whether a line begins a record of a car, such as an end, that is worth a reference. */
static bool begins_part_of_car(const CzInputsText *inputs, int i) {
    enum { MIN_LINES = 5 };
    return indent_of(inputs->line[i]) == CAR_INDENT + 2 && end_of(inputs, i) - i >= MIN_LINES;
}

/* The first line of an equal record of an earlier car, and that car; -1 when there is none. */
static int same_part_of_car(const CzInputsText *inputs, int part, int *car) {
    int last = -1;
    for (int i = 0; i < part; i++) {
        if (indent_of(inputs->line[i]) < CAR_INDENT)
            last = -1;
        if (begins_car(inputs->line[i]))
            last = *car = i;
        if (last >= 0 && begins_part_of_car(inputs, i) && are_equal(inputs, i, part))
            return i;
    }
    return -1;
}

static void name_of(const char *line, char name[64]) {
    const char *from = line + CAR_INDENT + 8;
    snprintf(name, 64, "%.*s", (int)strcspn(from, " "), from);
}

static void write_reference_to_car(const CzInputsText *inputs, int car, int same,
                                   CzMarkup *markup) {
    char name[64], first[64];
    name_of(inputs->line[car], name);
    name_of(inputs->line[same], first);
    cz_markup_write(markup, "      - name: %s   (otherwise as %s)\n", name, first);
}

/* As "front: (as rear of A1)", with its origin. */
static void write_reference_to_part(const CzInputsText *inputs, int part, int same, int car,
                                    CzMarkup *markup) {
    const char *key = inputs->line[part], *other = inputs->line[same] + CAR_INDENT + 2;
    const char *origin = strchr(key, '#');
    char text[CZ_SENTENCE_SIZE], name[64];
    name_of(inputs->line[car], name);
    snprintf(text, sizeof text, "%.*s (as %.*s of %s)", (int)strcspn(key, ":") + 1, key,
             (int)strcspn(other, ":"), other, name);
    const size_t used = strlen(text);
    if (origin != NULL)
        snprintf(text + used, sizeof text - used, "%*s%s",
                 (int)(origin - key) > (int)used ? (int)(origin - key) - (int)used : 1, "", origin);
    write_line(inputs, text, markup);
}

void cz_inputs_text_write(const CzInputsText *inputs, CzMarkup *markup) {
    bool in_car = false;
    for (int i = 0; i < inputs->n_line;) {
        const bool is_car = begins_car(inputs->line[i]);
        int car = -1, same = is_car ? same_car(inputs, i) : -1;
        in_car = is_car || (in_car && indent_of(inputs->line[i]) > CAR_INDENT);
        if (same >= 0)
            write_reference_to_car(inputs, i, same, markup);
        else if (in_car && begins_part_of_car(inputs, i))
            same = same_part_of_car(inputs, i, &car);
        if (same < 0)
            write_line(inputs, inputs->line[i++], markup);
        else if (!is_car)
            write_reference_to_part(inputs, i, same, car, markup);
        if (same >= 0)
            i = end_of(inputs, i);
    }
}

/* ---- defaults ---- */

typedef struct Default {
    char path[256], value[64];
    bool is_ours;
    int n; /* places */
} Default;

/* Splits " - key: value # default (ours)" into its parts; false when it is not a default. */
static bool read_default(const char *line, char value[64], bool *is_ours) {
    const char *origin = strstr(line, "# default");
    const char *colon = strchr(line, ':');
    if (origin == NULL || colon == NULL || colon > origin)
        return false;
    const char *from = colon + 1 + strspn(colon + 1, " ");
    const char *to = origin;
    while (to > from && to[-1] == ' ')
        to--;
    *is_ours = strstr(origin, "(ours") != NULL;
    snprintf(value, 64, "%.*s", (int)(to - from), from);
    return to > from;
}

/* Makes the key of a line the last one of the path. */
static void follow_path(char keys[MAX_LEVELS][64], int *n_level, const char *line) {
    const char *lead = line + strspn(line, "# ");
    const bool is_item = strncmp(lead, "- ", 2) == 0;
    const char *key = is_item ? lead + 2 : lead;
    const int level = (int)(key - line) / 2;
    if (level >= MAX_LEVELS)
        return;
    for (int i = *n_level; i < level; i++)
        keys[i][0] = '\0';
    snprintf(keys[level], 64, "%.*s", (int)strcspn(key, ":"), key);
    *n_level = level + 1;
}

static void join_path(char keys[MAX_LEVELS][64], int n_level, char path[256]) {
    size_t used = 0;
    path[0] = '\0';
    for (int i = 0; i < n_level; i++)
        if (keys[i][0] != '\0' && strcmp(keys[i], "front") != 0 && strcmp(keys[i], "rear") != 0 &&
            used < 200)
            used +=
                (size_t)snprintf(path + used, 256 - used, "%s%.60s", used > 0 ? "." : "", keys[i]);
}

static void add_default(Default *list, int *n, const char *path, const char *value, bool is_ours) {
    for (int i = 0; i < *n; i++)
        if (strcmp(list[i].path, path) == 0 && strcmp(list[i].value, value) == 0) {
            list[i].n++;
            return;
        }
    if (*n == MAX_DEFAULTS)
        return;
    Default *added = &list[(*n)++];
    snprintf(added->path, sizeof added->path, "%s", path);
    snprintf(added->value, sizeof added->value, "%s", value);
    added->is_ours = is_ours;
    added->n = 1;
}

static void put_default(CzReportTable *table, const Default *found) {
    cz_table_put(table, found->path);
    cz_table_put(table, found->value);
    cz_table_put_format(table, "%d", found->n);
    cz_table_put(table, found->is_ours ? "ours, without a published source" : "");
}

void cz_inputs_text_write_defaults(const CzInputsText *inputs, CzMarkup *markup) {
    Default *list = malloc(MAX_DEFAULTS * sizeof *list);
    char keys[MAX_LEVELS][64], path[256], value[64];
    int n = 0, n_level = 0;
    markup->failed |= list == NULL;
    for (int i = 0; list != NULL && i < inputs->n_line; i++) {
        bool is_ours = false;
        follow_path(keys, &n_level, inputs->line[i]);
        if (!read_default(inputs->line[i], value, &is_ours))
            continue;
        join_path(keys, n_level, path);
        add_default(list, &n, path, value, is_ours);
    }
    cz_markup_write(markup, "<details><summary>%s</summary>",
                    n == 0 ? "none" : "every value that no file states, with its default");
    CzReportTable table;
    cz_table_begin(&table, "key;>value;>places;");
    for (int i = 0; i < n; i++)
        put_default(&table, &list[i]);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</details>\n");
    free(list);
}
