/* Parameters files of Dakota. */
#include "serve/dakota_parameters.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"

enum { MAX_LABEL = 1000 }; /* of a label or a value [byte] */

/* The parts of a file in their order. */
typedef enum Part { VARIABLES, RESPONSES, DERIVATIVES, COMPONENTS, EVALUATION, METADATA } Part;

static const struct {
    const char *standard, *aprepro;
} tags[] = {{"variables", "DAKOTA_VARS"},
            {"functions", "DAKOTA_FNS"},
            {"derivative_variables", "DAKOTA_DER_VARS"},
            {"analysis_components", "DAKOTA_AN_COMPS"},
            {"eval_id", "DAKOTA_EVAL_ID"},
            {"metadata", "DAKOTA_METADATA"}};

typedef struct Reader {
    CzArena *arena;
    CzMistakes *mistakes;
    const CzSource *source;
    bool is_aprepro;
    int line; /* the next one, counted from 0 */
} Reader;

/* A part of a line. */
typedef struct Span {
    const char *at;
    size_t n;
} Span;

static bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

static Span trimmed(Span span) {
    for (; span.n > 0 && is_blank(*span.at); span.n--)
        span.at++;
    while (span.n > 0 && is_blank(span.at[span.n - 1]))
        span.n--;
    return span;
}

static bool is_word(Span span, const char *word) {
    return span.n == strlen(word) && memcmp(span.at, word, span.n) == 0;
}

/* Where the label of a standard line begins: its last word, or that of a component, whose driver
 * may have blanks. */
static size_t label_at(Span line) {
    size_t at = line.n;
    for (size_t i = 0; i + 3 < line.n; i++) {
        const size_t n = i > 0 && is_blank(line.at[i - 1]) && memcmp(line.at + i, "AC_", 3) == 0
                             ? strspn(line.at + i + 3, "0123456789")
                             : 0;
        if (n > 0 && i + 3 + n < line.n && line.at[i + 3 + n] == ':')
            return i;
    }
    while (at > 0 && !is_blank(line.at[at - 1]))
        at--;
    return at;
}

/* Splits a line into value and label. */
static bool split(const Reader *reader, Span line, Span *value, Span *label) {
    if (!reader->is_aprepro) {
        const size_t at = label_at(line);
        *label = (Span){line.at + at, line.n - at};
        *value = trimmed((Span){line.at, at});
        return value->n > 0;
    }
    const char *equals = memchr(line.at, '=', line.n);
    if (line.n < 2 || line.at[0] != '{' || line.at[line.n - 1] != '}' || equals == NULL)
        return false;
    const char *end = line.at + line.n - 1;
    *label = trimmed((Span){line.at + 1, (size_t)(equals - line.at) - 1});
    *value = trimmed((Span){equals + 1, (size_t)(end - equals) - 1});
    if (value->n >= 2 && value->at[0] == '"' && value->at[value->n - 1] == '"')
        *value = (Span){value->at + 1, value->n - 2};
    return label->n > 0;
}

/* The next line that is not empty; false at the end. */
static bool next_line(Reader *reader, Span *line) {
    for (; reader->line < reader->source->n_line; reader->line++) {
        const char *text = reader->source->line[reader->line];
        *line = trimmed((Span){text, strlen(text)});
        if (line->n > 0) {
            reader->line++;
            return true;
        }
    }
    return false;
}

/* Column of a place in the present line. */
static int column_of(const Reader *reader, const char *at) {
    int column = 1;
    for (const char *c = reader->source->line[reader->line - 1]; c < at; c++)
        column += ((unsigned char)*c & 0xc0) != 0x80;
    return column;
}

/* Adds a mistake at a place of the present line. */
#define REFUSE(reader, at, ...)                                                                    \
    (cz_mistake_at((reader)->mistakes, (reader)->source, (reader)->line, column_of(reader, at),    \
                   __VA_ARGS__),                                                                   \
     false)

/* Reads the next line as value and label. */
static bool next_pair(Reader *reader, const char *wanted, Span *value, Span *label) {
    Span line;
    if (!next_line(reader, &line)) {
        cz_mistake_at(reader->mistakes, reader->source, reader->source->n_line, 1,
                      "the file ends before '%s'", wanted);
        return false;
    }
    if (!split(reader, line, value, label))
        return REFUSE(reader, line.at,
                      reader->is_aprepro ? "this line is not '{ label = value }'"
                                         : "this line is not a value and its label");
    if (value->n < MAX_LABEL && label->n < MAX_LABEL)
        return true;
    return REFUSE(reader, line.at, "this line has a value or a label of %d bytes or more",
                  (int)MAX_LABEL);
}

/* Reads a whole number from 0 to the largest one. */
static bool read_whole(Reader *reader, Span value, int largest, int *whole) {
    char text[MAX_LABEL];
    double number;
    memcpy(text, value.at, value.n);
    text[value.n] = '\0';
    if (cz_number_scan(text, &number) && number >= 0 && number <= largest &&
        number == (double)(int)number) {
        *whole = (int)number;
        return true;
    }
    return REFUSE(reader, value.at, "'%.60s' is not a whole number from 0 to %d", text, largest);
}

/* Reads the line that begins a part. */
static bool begin_part(Reader *reader, Part part, Span *value) {
    const char *tag = reader->is_aprepro ? tags[part].aprepro : tags[part].standard;
    Span label;
    if (!next_pair(reader, tag, value, &label))
        return false;
    return is_word(label, tag) || REFUSE(reader, label.at, "'%s' must be here, not '%.*s'", tag,
                                         (int)(label.n < 60 ? label.n : 60), label.at);
}

/* Cuts "ASV_3:" off a label: false when it has another beginning. */
static bool cut_number(const char *kind, int number, Span *label) {
    const size_t n_kind = strlen(kind);
    const char *at = label->at;
    size_t n = 0;
    if (label->n <= n_kind || memcmp(at, kind, n_kind) != 0)
        return false;
    while (n_kind + n < label->n && at[n_kind + n] >= '0' && at[n_kind + n] <= '9')
        n++;
    if (n == 0 || n > 9 || strtol(at + n_kind, NULL, 10) != number)
        return false;
    *label = (Span){at + n_kind + n, label->n - n_kind - n};
    if (label->n == 0)
        return true;
    if (*label->at != ':')
        return false;
    label->at++;
    label->n--;
    return true;
}

/* Reads the entries of a part; `kind` begins their labels, "" for variables. */
static bool read_part(Reader *reader, Part part, const char *kind, CzDakotaList *list) {
    Span value, label;
    int n;
    if (!begin_part(reader, part, &value) || !read_whole(reader, value, reader->source->n_line, &n))
        return false;
    list->entry = cz_arena_allocate(reader->arena, (size_t)n + 1, sizeof *list->entry);
    if (list->entry == NULL)
        return false;
    for (; list->n < n; list->n++) {
        char wanted[40];
        snprintf(wanted, sizeof wanted, "%s%d", kind[0] != '\0' ? kind : "variable ", list->n + 1);
        if (!next_pair(reader, wanted, &value, &label))
            return false;
        const char *at = label.at;
        if (kind[0] != '\0' && !cut_number(kind, list->n + 1, &label))
            return REFUSE(reader, at, "'%s' must be here, not '%.*s'", wanted,
                          (int)(label.n < 60 ? label.n : 60), at);
        CzDakotaEntry *entry = &list->entry[list->n];
        *entry = (CzDakotaEntry){.label = cz_arena_copy_text(reader->arena, label.at, label.n),
                                 .text = cz_arena_copy_text(reader->arena, value.at, value.n),
                                 .line = reader->line,
                                 .column = column_of(reader, value.at)};
        if (entry->label == NULL || entry->text == NULL)
            return false;
        if (part == RESPONSES && !read_whole(reader, value, 7, &entry->number))
            return false;
        if (part == DERIVATIVES && !read_whole(reader, value, 1000000, &entry->number))
            return false;
    }
    return true;
}

/* Derivatives name variables by their numbers from 1; labels of variables and responses differ. */
static bool check_lists(Reader *reader, CzDakotaParameters *parameters) {
    const CzDakotaList *lists[] = {&parameters->variable, &parameters->response};
    for (int i = 0; i < parameters->derivative.n; i++) {
        CzDakotaEntry *entry = &parameters->derivative.entry[i];
        if (entry->number-- >= 1 && entry->number < parameters->variable.n)
            continue;
        cz_mistake_at(reader->mistakes, reader->source, entry->line, entry->column,
                      "the file has no variable %s, but %d", entry->text, parameters->variable.n);
        return false;
    }
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < lists[k]->n; i++)
            for (int j = 0; j < i; j++)
                if (strcmp(lists[k]->entry[i].label, lists[k]->entry[j].label) == 0) {
                    cz_mistake_at(reader->mistakes, reader->source, lists[k]->entry[i].line, 1,
                                  "the descriptor '%.100s' is also in line %d",
                                  lists[k]->entry[i].label, lists[k]->entry[j].line);
                    return false;
                }
    return true;
}

static bool read_all(Reader *reader, CzDakotaParameters *parameters) {
    Span value, line;
    CzDakotaList metadata = {0};
    if (next_line(reader, &line))
        reader->is_aprepro = *line.at == '{';
    reader->line = 0;
    if (!read_part(reader, VARIABLES, "", &parameters->variable) ||
        !read_part(reader, RESPONSES, "ASV_", &parameters->response) ||
        !read_part(reader, DERIVATIVES, "DVV_", &parameters->derivative) ||
        !read_part(reader, COMPONENTS, "AC_", &parameters->component) ||
        !begin_part(reader, EVALUATION, &value))
        return false;
    parameters->evaluation = cz_arena_copy_text(reader->arena, value.at, value.n);
    const int end = reader->line;
    if (next_line(reader, &line)) {
        reader->line = end;
        if (!read_part(reader, METADATA, "MD_", &metadata))
            return false;
    }
    if (metadata.n > 0) {
        const CzDakotaEntry *entry = metadata.entry;
        cz_mistake_at(reader->mistakes, reader->source, entry->line, entry->column,
                      "metadata '%.60s' are not computed" CZ_HELP
                      "remove 'metadata' from the responses of the study",
                      entry->text);
        return false;
    }
    if (next_line(reader, &line))
        return REFUSE(reader, line.at,
                      "the evaluation ends before this line: a file has one evaluation" CZ_HELP
                      "an interface with 'batch' writes several into one file, which is not read");
    return check_lists(reader, parameters);
}

CzStatus cz_dakota_parameters_read(CzArena *arena, const char *path, CzDakotaParameters *parameters,
                                   CzError *error) {
    CzMistakes mistakes = {.arena = arena};
    CzSources sources = {.arena = arena, .hash = CZ_HASH_START};
    char *text = NULL;
    size_t n_byte = 0;
    *parameters = (CzDakotaParameters){0};
    const CzSource *source = cz_sources_read(&sources, &mistakes, path, NULL, &text, &n_byte);
    Reader reader = {.arena = arena, .mistakes = &mistakes, .source = source};
    parameters->source = source;
    if (source != NULL && cz_source_is_text(&mistakes, source, text, n_byte))
        (void)read_all(&reader, parameters); /* mistakes follow */
    free(text);
    return cz_mistakes_status(&mistakes, path, error);
}
