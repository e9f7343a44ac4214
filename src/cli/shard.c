/* The options of a shard, as words of a command line in one order. */
#include "cli/shard.h"

#include "base/error.h"
#include "cli/messages.h"

#include <stdio.h>
#include <stdlib.h>

/* Options that results depend on and that are given at most once. */
static const CzOption single[] = {CZ_OPTION_SCENARIO,   CZ_OPTION_TIME_STEP_MS, CZ_OPTION_SEED,
                                  CZ_OPTION_SAMPLES,    CZ_OPTION_STRICT,       CZ_OPTION_CSV_SEP,
                                  CZ_OPTION_CSV_DECIMAL};
enum { N_SINGLE = sizeof single / sizeof *single };

/* Words being listed. */
typedef struct Words {
    const char **word;
    int n;
    char *name; /* next of the names of options, which have room for OPTION_SIZE each */
} Words;

enum { OPTION_SIZE = 32 };

static void add(Words *words, CzOption option, const char *value) {
    snprintf(words->name, OPTION_SIZE, "--%s", cz_options[option].name);
    words->word[words->n++] = words->name;
    words->name += OPTION_SIZE;
    if (cz_options[option].value != NULL)
        words->word[words->n++] = value;
}

static void add_each(Words *words, CzOption option, int n, const char *const *value) {
    for (int i = 0; i < n; i++)
        add(words, option, value[i]);
}

/* Adds the words to the options of a report. */
static CzStatus add_words(const CzArguments *arguments, CzReportOptions *options, CzError *error) {
    const int n_several =
        arguments->n_set + arguments->n_vary + arguments->n_metric + arguments->n_check;
    const size_t most = (size_t)n_several + N_SINGLE;
    char *memory = malloc(most * (2 * sizeof(char *) + OPTION_SIZE));
    if (memory == NULL)
        return cz_no_memory(error, "the options of a shard");
    Words words = {.word = (const char **)memory, .name = memory + most * 2 * sizeof(char *)};
    for (int i = 0; i < arguments->n_set; i++)
        if (arguments->set[i] != arguments->time_step) /* it has an option of its own */
            add(&words, CZ_OPTION_SET, arguments->set[i]);
    add_each(&words, CZ_OPTION_VARY, arguments->n_vary, arguments->vary);
    add_each(&words, CZ_OPTION_METRIC, arguments->n_metric, arguments->metric);
    add_each(&words, CZ_OPTION_CHECK, arguments->n_check, arguments->check);
    for (int i = 0; i < N_SINGLE; i++)
        if (arguments->text[single[i]] != NULL)
            add(&words, single[i], arguments->text[single[i]]);
    options->shard_word = words.word;
    options->n_shard_word = words.n;
    return CZ_OK;
}

int cz_session_deliver_shard(CzSession *session, const CzReport *report) {
    CzError error = {0};
    if (session->arguments->text[CZ_OPTION_SHARD] == NULL)
        return cz_session_deliver(session, report);
    if (add_words(session->arguments, &session->options, &error) != CZ_OK)
        return cz_print_error(session->arguments, &error);
    const int code = cz_session_deliver(session, report);
    free((void *)session->options.shard_word);
    session->options.shard_word = NULL;
    return code;
}
