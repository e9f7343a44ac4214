/* `new`: writes a commented example that runs without changes. */
#include "base/error.h"
#include "base/suggest.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/templates.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const CzTemplate *find_template(const char *name, CzError *error) {
    CzSuggestion nearest = {0};
    const int found = CZ_FIND_NAMED(name, CzTemplate, cz_templates, CZ_N_TEMPLATE, &nearest);
    if (found >= 0)
        return &cz_templates[found];
    cz_fail(error, CZ_STATUS_INPUT,
            "there is no template '%.100s'" CZ_HELP "'crushzone help new' lists them", name);
    cz_suggest_help(&nearest, error);
    return NULL;
}

/* ---- categories of a template ---- */

static const char mark[] = "#:", placeholder[] = "@CATEGORY@";

/* Length of a line with its end. */
static size_t line_length(const char *line) {
    const size_t n = strcspn(line, "\n");
    return n + (line[n] == '\n');
}

/* Whether the words between two places of a text include one. */
static bool includes(const char *words, const char *end, const char *word) {
    const size_t n = strlen(word);
    for (const char *at = words; at < end; at += strcspn(at, " \n") + 1)
        if (strncmp(at, word, n) == 0 && (at[n] == ' ' || at[n] == '\n'))
            return true;
    return false;
}

/* Whether a template has lines for a category. */
static bool has_category(const char *text, const char *category) {
    for (const char *line = text; *line != '\0'; line += line_length(line))
        if (strncmp(line, mark, 2) == 0 && includes(line + 2, line + line_length(line), category))
            return true;
    return false;
}

static void write_line(FILE *stream, const char *line, size_t n, const char *category) {
    for (const char *end = line + n; line < end;) {
        if (strncmp(line, placeholder, sizeof placeholder - 1) == 0) {
            fputs(category, stream);
            line += sizeof placeholder - 1;
        } else {
            fputc(*line++, stream);
        }
    }
}

/* The lines of a template for a category. The caller frees it; NULL without memory. */
static char *text_of_category(const char *text, const char *category) {
    char *made = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&made, &size);
    bool is_kept = true;
    for (const char *line = text; stream != NULL && *line != '\0'; line += line_length(line)) {
        const size_t n = line_length(line);
        if (strncmp(line, mark, 2) == 0)
            is_kept = line[2] == '\n' || includes(line + 2, line + n, category);
        else if (is_kept)
            write_line(stream, line, n, category);
    }
    return stream != NULL && fclose(stream) == 0 ? made : NULL;
}

/* A template for the category of the command line. The caller frees it; NULL with the reason. */
static char *choose_text(const CzTemplate *template, const char *category, CzError *error) {
    const bool has_any = strstr(template->text, placeholder) != NULL;
    if (has_any && (category == NULL || !has_category(template->text, category))) {
        cz_fail(error, CZ_STATUS_INPUT, "template '%s' %s%.40s%s" CZ_HELP "it is: %s",
                template->name, category == NULL ? "needs --category" : "has no category '",
                category != NULL ? category : "", category != NULL ? "'" : "", template->doc);
        return NULL;
    }
    if (!has_any && category != NULL) {
        cz_fail(error, CZ_STATUS_INPUT, "template '%s' has no categories", template->name);
        return NULL;
    }
    char *text = text_of_category(template->text, category != NULL ? category : "");
    if (text == NULL)
        (void)cz_no_memory(error, "a template");
    return text;
}

/* ---- files ---- */

/* Writes a new file; an existing file may be the user's work and is kept. */
static CzStatus write_new(const char *path, const char *text, CzError *error) {
    FILE *stream = fopen(path, "wbx");
    int why = errno;
    if (stream != NULL) {
        const bool is_written = fputs(text, stream) != EOF;
        why = is_written ? 0 : errno;
        if (fclose(stream) == 0 && is_written)
            return CZ_OK;
        why = why != 0 ? why : errno;
        (void)remove(path); /* created above, so it is not a file of the user */
    }
    if (why == EEXIST)
        return cz_fail(error, CZ_STATUS_OUTPUT,
                       "%.300s cannot be written: the file exists" CZ_HELP
                       "choose another name with -o FILE, or -o - for standard output",
                       path);
    return cz_fail(error, CZ_STATUS_OUTPUT, "%.300s cannot be written: %s", path, strerror(why));
}

int cz_command_new(const CzArguments *arguments) {
    char room[256];
    CzError error = {0};
    const char *name = arguments->n_operand > 0 ? arguments->operand[0] : cz_templates[0].name;
    const char *path = arguments->text[CZ_OPTION_OUTPUT];
    const CzTemplate *template = find_template(name, &error);
    char *text = template != NULL
                     ? choose_text(template, arguments->text[CZ_OPTION_CATEGORY], &error)
                     : NULL;
    if (text == NULL)
        return cz_print_error(arguments, &error);
    if (path != NULL && strcmp(path, "-") == 0) {
        fputs(text, stdout);
        free(text);
        return 0;
    }
    if (path == NULL) {
        snprintf(room, sizeof room, "%s.yaml", name);
        path = room;
    }
    const CzStatus status = write_new(path, text, &error);
    free(text);
    if (status != CZ_OK)
        return cz_print_error(arguments, &error);
    cz_print_note(arguments, "wrote %s; next: crushzone run %s", path, path);
    return 0;
}
