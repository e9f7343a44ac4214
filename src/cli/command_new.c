/* `new`: writes a commented example that runs without changes. */
#include "base/error.h"
#include "base/suggest.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/templates.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

static const char *find_template(const char *name, CzError *error) {
    CzSuggestion nearest = {0};
    const int found = CZ_FIND_NAMED(name, CzTemplate, cz_templates, CZ_N_TEMPLATE, &nearest);
    if (found >= 0)
        return cz_templates[found].text;
    cz_fail(error, CZ_STATUS_INPUT,
            "there is no template '%.100s'" CZ_HELP "'crushzone help new' lists them", name);
    cz_suggest_help(&nearest, error);
    return NULL;
}

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
    const char *text = find_template(name, &error);
    if (text == NULL)
        return cz_tell_error(arguments, &error);
    if (path != NULL && strcmp(path, "-") == 0) {
        fputs(text, stdout);
        return 0;
    }
    if (path == NULL) {
        snprintf(room, sizeof room, "%s.yaml", name);
        path = room;
    }
    if (write_new(path, text, &error) != CZ_OK)
        return cz_tell_error(arguments, &error);
    cz_tell(arguments, "wrote %s; next: crushzone run %s", path, path);
    return 0;
}
