/* `merge`: shards of `sample` or `sweep` become the results of one run; a shard that is missing or
 * incomplete is named with the command that runs it. */
#include "base/error.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/shard.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- shards that are due ---- */

/* Writes a word for a shell, in quotes where it needs them. */
static void write_word(const char *word, FILE *stream) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "-_./:,=+%@";
    if (word[0] != '\0' && word[strspn(word, plain)] == '\0') {
        fputs(word, stream);
        return;
    }
    fputc('\'', stream);
    for (; *word != '\0'; word++)
        if (*word == '\'')
            fputs("'\\''", stream);
        else
            fputc(*word, stream);
    fputc('\'', stream);
}

/* The folder of a missing shard: named as that of the first one, with the other number. */
static void name_folder(const CzShards *shards, int shard, size_t room, char *name) {
    const char *first = shards->folder[0];
    size_t n = strlen(first);
    while (n > 0 && first[n - 1] == '/')
        n--;
    const size_t n_name = n;
    while (n > 0 && isdigit((unsigned char)first[n - 1]))
        n--;
    if (n < n_name && strtol(first + n, NULL, 10) == shards->head[0].shard)
        snprintf(name, room, "%.*s%0*d", (int)n, first, (int)(n_name - n), shard);
    else
        snprintf(name, room, "part-%d", shard);
}

/* The command that runs a shard. */
static void write_command(const CzShards *shards, const CzShardDue *due, FILE *stream) {
    const CzShardHead *head = &shards->head[0];
    char folder[4096];
    if (due->folder != NULL)
        snprintf(folder, sizeof folder, "%s", due->folder);
    else
        name_folder(shards, due->shard, sizeof folder, folder);
    fprintf(stream, "crushzone %s ", head->command);
    write_word(head->file, stream);
    for (int i = 0; i < head->n_word; i++) {
        fputc(' ', stream);
        write_word(head->word[i], stream);
    }
    fprintf(stream, " --shard %d/%d -o ", due->shard, head->n_shard);
    write_word(folder, stream);
}

/* The numbers of the shards that are due, as many as have room. */
static void list_due(const CzShards *shards, size_t room, char *text) {
    size_t n = 0;
    for (int i = 0; i < shards->n_due && n + 24 < room; i++)
        n += (size_t)snprintf(text + n, room - n, "%s%d", i > 0 ? ", " : "", shards->due[i].shard);
    if (n + 24 >= room)
        snprintf(text + n, room - n, ", ...");
}

static void describe_due(const CzShards *shards, size_t room, char *text) {
    const CzShardDue *due = &shards->due[0];
    const int n_shard = shards->head[0].n_shard;
    char numbers[160];
    list_due(shards, sizeof numbers, numbers);
    if (shards->n_due > 1)
        snprintf(text, room, "shards %s of %d are missing or incomplete", numbers, n_shard);
    else if (due->folder == NULL)
        snprintf(text, room, "shard %d of %d is missing", due->shard, n_shard);
    else
        snprintf(text, room, "shard %d of %d is incomplete: %.200s has %d of its %d lines",
                 due->shard, n_shard, due->folder, due->n_row, due->n_of);
    const size_t n = strlen(text);
    if (shards->n_unreadable > 0)
        snprintf(text + n, room - n, "; %.100s %s", shards->unreadable[0],
                 shards->n_unreadable > 1 ? "and others cannot be read" : "cannot be read");
}

/* Names what has to be run, with the commands; a document has the first one. */
static int report_missing_parts(const CzArguments *arguments, const CzShards *shards) {
    CzError error = {.status = CZ_STATUS_RUN_FAILED};
    describe_due(shards, sizeof error.message, error.message);
    FILE *help = fmemopen(error.help, sizeof error.help, "w");
    if (help != NULL && arguments->text[CZ_OPTION_JSON] != NULL)
        write_command(shards, &shards->due[0], help);
    if (help != NULL && arguments->text[CZ_OPTION_JSON] == NULL)
        fputs("run these commands, and merge again:", help);
    if (help != NULL)
        fclose(help);
    const int code = cz_print_error(arguments, &error);
    for (int i = 0; i < shards->n_due && arguments->text[CZ_OPTION_JSON] == NULL; i++) {
        fputs("    ", stderr);
        write_command(shards, &shards->due[i], stderr);
        fputc('\n', stderr);
    }
    return code;
}

/* ---- the whole run ---- */

/* Appends options of `merge` to the words of the whole run's command line. */
static int add_options(const CzArguments *arguments, char **word) {
    static const CzOption passed[] = {CZ_OPTION_OUTPUT,  CZ_OPTION_REPLACE,     CZ_OPTION_JSON,
                                      CZ_OPTION_QUIET,   CZ_OPTION_JOBS,        CZ_OPTION_COLOR,
                                      CZ_OPTION_CSV_SEP, CZ_OPTION_CSV_DECIMAL, CZ_OPTION_JUNIT};
    static const char *const name[] = {"--output",  "--force",       "--json",
                                       "--quiet",   "--jobs",        "--color",
                                       "--csv-sep", "--csv-decimal", "--junit"};
    int n = 0;
    for (size_t i = 0; i < sizeof passed / sizeof *passed; i++) {
        const char *value = arguments->text[passed[i]];
        if (value == NULL)
            continue;
        word[n++] = (char *)name[i];
        if (cz_options[passed[i]].value != NULL)
            word[n++] = (char *)value;
    }
    return n;
}

/* Reads the command line of the run without shards; `word` has its memory. */
static CzStatus read_whole_run(const CzArguments *arguments, const CzShards *shards, char ***word,
                               CzArguments *whole, CzError *error) {
    const CzShardHead *head = &shards->head[0];
    int n = 0;
    *word = calloc((size_t)head->n_word + 2 * CZ_N_OPTION + 8, sizeof **word);
    if (*word == NULL)
        return cz_no_memory(error, "the command line");
    (*word)[n++] = (char *)"crushzone";
    (*word)[n++] = (char *)head->command;
    for (int i = 0; i < head->n_word; i++)
        (*word)[n++] = (char *)head->word[i];
    n += add_options(arguments, *word + n);
    (*word)[n++] = (char *)"--";
    (*word)[n++] = (char *)head->file;
    CZ_TRY(cz_arguments_read(n, *word, whole, error));
    if (access(head->file, R_OK) == 0)
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_INPUT,
                   "the problem file of the shards, %.200s, is not here" CZ_HELP
                   "merge in the folder in which the shards were run",
                   head->file);
}

static int merge(const CzArguments *arguments, CzShards *shards) {
    CzArguments whole = {0};
    CzError error = {0};
    char **word = NULL;
    int code;
    if (shards->n_due > 0)
        return report_missing_parts(arguments, shards);
    const CzStatus status = read_whole_run(arguments, shards, &word, &whole, &error);
    if (status != CZ_OK)
        code = cz_print_error(arguments, &error);
    else if (whole.command == CZ_COMMAND_SWEEP)
        code = cz_sweep_shards(&whole, shards);
    else
        code = cz_sample_shards(&whole, shards);
    cz_arguments_free(&whole);
    free(word);
    return code;
}

int cz_command_merge(const CzArguments *arguments) {
    CzShards *shards = NULL;
    CzError error = {0};
    if (cz_shards_read(arguments->n_operand, arguments->operand, &shards, &error) != CZ_OK)
        return cz_print_error(arguments, &error);
    const int code = merge(arguments, shards);
    cz_shards_free(shards);
    return code;
}
