/* Files as text. */
#include "text/source.h"

#include "base/stream.h"
#include "base/text.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

void cz_sources_hash(CzSources *sources, const char *bytes, size_t n_byte) {
    const uint64_t prime = UINT64_C(1099511628211);
    uint64_t hash = sources->hash;
    for (size_t i = 0; i < n_byte; i++)
        hash = (hash ^ (unsigned char)bytes[i]) * prime;
    sources->hash = (hash ^ 0xff) * prime; /* no text contains a byte 0xff */
}

/* Length in bytes of a line end at the start of a text; 0 when there is none. With `is_yaml` these
 * are CR LF, CR, LF, NEL, LS and PS, so that lines are counted as by its parser. */
static size_t line_end_length(const char *text, bool is_yaml) {
    if (text[0] == '\r' || text[0] == '\n')
        return text[0] == '\r' && text[1] == '\n' ? 2 : 1;
    if (is_yaml && strncmp(text, "\xc2\x85", 2) == 0)
        return 2;
    const bool separates =
        is_yaml && (strncmp(text, "\xe2\x80\xa8", 3) == 0 || strncmp(text, "\xe2\x80\xa9", 3) == 0);
    return separates ? 3 : 0;
}

/* The next line end, with its length in bytes; NULL without one. */
static char *find_line_end(char *at, const char *end, bool is_yaml, size_t *n_end) {
    for (; at < end; at++) {
        *n_end = line_end_length(at, is_yaml);
        if (*n_end > 0)
            return at;
    }
    return NULL;
}

bool cz_source_cut(CzArena *arena, CzSource *source, char *text, size_t n_byte, bool is_yaml) {
    const char *end = text + n_byte;
    int n_line = 1;
    size_t n = 0;
    for (char *at = find_line_end(text, end, is_yaml, &n); at != NULL;
         at = find_line_end(at + n, end, is_yaml, &n))
        n_line++;
    const char **line = cz_arena_allocate(arena, (size_t)n_line, sizeof *line);
    if (line == NULL)
        return false;
    line[0] = text;
    for (int i = 1; i < n_line; i++) {
        char *at = find_line_end(text, end, is_yaml, &n);
        *at = '\0';
        line[i] = text = at + n;
    }
    source->n_line = n_line;
    source->line = line;
    return true;
}

CzSource *cz_sources_add(CzSources *sources, const char *name, const char *folder, const char *text,
                         size_t n_byte) {
    CzSource *source = cz_arena_allocate(sources->arena, 1, sizeof *source);
    if (source == NULL)
        return NULL;
    source->name = cz_arena_copy_text(sources->arena, name, strlen(name));
    source->folder = cz_arena_copy_text(sources->arena, folder, strlen(folder));
    char *copy = cz_arena_copy_text(sources->arena, text, n_byte);
    if (source->name == NULL || source->folder == NULL || copy == NULL ||
        !cz_source_cut(sources->arena, source, copy, n_byte, true))
        return NULL;
    source->order = sources->n_source++;
    if (sources->last != NULL)
        sources->last->next = source;
    else
        sources->first = source;
    sources->last = source;
    cz_sources_hash(sources, text, n_byte);
    return source;
}

/* Reason why the last call on a file failed, in the same words in every locale. */
static const char *why_failed(void) {
    switch (errno) {
    case ENOENT:
    case ENOTDIR:
        return "the file does not exist";
    case EACCES:
    case EPERM:
        return "permission is denied";
    case ENAMETOOLONG:
        return "the name is too long";
    default:
        return "the system refuses to read it";
    }
}

/* Opens a file; NULL with a sentence's end when it cannot be read. */
static FILE *open_file(const char *path, const char **why) {
    struct stat status;
    if (strcmp(path, "-") == 0)
        return stdin;
    *why = NULL;
    if (stat(path, &status) != 0)
        *why = why_failed();
    else if (S_ISDIR(status.st_mode))
        *why = "it is a folder";
    else if (!S_ISREG(status.st_mode) && !S_ISFIFO(status.st_mode))
        *why = "it is not a regular file";
    else if (status.st_size > CZ_MAX_BYTES)
        *why = "it is larger than 16 MiB";
    if (*why != NULL)
        return NULL;
    FILE *stream = fopen(path, "rb");
    if (stream == NULL && errno != ENOMEM) /* then it is not a mistake about the file */
        *why = why_failed();
    return stream;
}

static void refuse_file(CzMistakes *mistakes, const char *path, const CzNode *place,
                        const char *why) {
    const CzSource source = {.name = path};
    const CzNode itself = {.source = &source};
    char resolved[4096];
    snprintf(resolved, sizeof resolved, "%.4000s/resolved.yaml", path);
    const bool is_folder = cz_path_exists(resolved);
    cz_mistake(mistakes, place != NULL ? place : &itself, NULL,
               "cannot read '%s': %s" CZ_HELP "%s%s", path, why,
               is_folder ? "the problem of a result folder is its " : "",
               is_folder ? resolved : "");
}

/* Folder of a path: the text before its last slash, "." without one. */
static const char *folder_of(CzArena *arena, const char *path) {
    const char *slash = strrchr(path, '/');
    if (slash == NULL)
        return ".";
    return cz_arena_copy_text(arena, path, slash == path ? 1 : (size_t)(slash - path));
}

size_t cz_source_mark(const char *text, size_t n_byte) {
    static const char mark[] = "\xef\xbb\xbf";
    return n_byte >= 3 && memcmp(text, mark, 3) == 0 ? 3 : 0;
}

CzSource *cz_sources_read(CzSources *sources, CzMistakes *mistakes, const char *path,
                          const CzNode *place, char **text, size_t *n_byte) {
    const char *why = NULL;
    *text = NULL;
    FILE *stream = open_file(path, &why);
    if (stream == NULL) {
        if (why != NULL)
            refuse_file(mistakes, path, place, why);
        else
            mistakes->arena->out_of_memory = true;
        return NULL;
    }
    *text = cz_stream_read(stream, CZ_MAX_BYTES, n_byte);
    if (*text != NULL && *n_byte <= CZ_MAX_BYTES) {
        const size_t n_mark = cz_source_mark(*text, *n_byte);
        *n_byte -= n_mark;
        memmove(*text, *text + n_mark, *n_byte);
    }
    if (*text != NULL && ferror(stream))
        why = "it cannot be read completely";
    else if (*text != NULL && *n_byte > CZ_MAX_BYTES)
        why = "it is larger than 16 MiB";
    else if (*text != NULL && *n_byte == 0)
        why = "it is empty";
    if (stream != stdin)
        fclose(stream);
    const char *folder = folder_of(sources->arena, path);
    CzSource *source = NULL;
    if (why != NULL)
        refuse_file(mistakes, path, place, why);
    else if (*text != NULL && folder != NULL)
        source = cz_sources_add(sources, strcmp(path, "-") == 0 ? "standard input" : path, folder,
                                *text, *n_byte);
    if (*text == NULL)
        mistakes->arena->out_of_memory = true;
    if (source == NULL) {
        free(*text);
        *text = NULL;
    }
    return source;
}

bool cz_source_is_utf8(const char *text, size_t n_byte) {
    size_t n = 1;
    for (size_t at = 0; at < n_byte && n > 0; at += n)
        n = cz_text_character(text + at, n_byte - at);
    return n > 0;
}

bool cz_source_is_text(CzMistakes *mistakes, const CzSource *source, const char *text,
                       size_t n_byte) {
    char what[CZ_FAULT_SIZE];
    size_t at;
    if (!cz_text_fault(text, n_byte, true, &at, what))
        return true;
    int line = 1, column = 1;
    for (size_t i = 0; i < at;) {
        const size_t n_end = line_end_length(text + i, true);
        column = n_end > 0 ? 1 : column + 1;
        line += n_end > 0;
        i += n_end > 0 ? n_end : cz_text_character(text + i, n_byte - i);
    }
    cz_mistake_at(mistakes, source, line, column, "the file contains %s" CZ_HELP "%s", what,
                  cz_text_character(text + at, n_byte - at) == 0
                      ? "save it as UTF-8"
                      : "remove it, or replace it by a space");
    return false;
}

const char *cz_path_join(CzArena *arena, const char *folder, const char *path) {
    const size_t n_folder = strlen(folder), n_path = strlen(path);
    if (path[0] == '/' || strcmp(folder, ".") == 0)
        return cz_arena_copy_text(arena, path, n_path);
    char *joined = cz_arena_allocate(arena, n_folder + n_path + 2, 1);
    if (joined == NULL)
        return NULL;
    memcpy(joined, folder, n_folder);
    joined[n_folder] = '/';
    memcpy(joined + n_folder + 1, path, n_path);
    return joined;
}

bool cz_path_exists(const char *path) {
    struct stat status;
    return stat(path, &status) == 0;
}
