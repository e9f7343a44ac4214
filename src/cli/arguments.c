/* The command line: command first, then options and operands in any order. */
#include "cli/arguments.h"

#include "base/error.h"
#include "base/number.h"
#include "base/suggest.h"
#include "base/text.h"
#include "crushzone/optimise.h"
#include "crushzone/sweep.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const CzCommandInfo cz_commands[CZ_N_COMMAND] = {
#define CZ_COMMAND(constant, name, function, operands, fewest, most, doc)                          \
    {name, operands, doc, fewest, most},
#include "cli/commands.def"
#undef CZ_COMMAND
};

#define IN(command) (1U << CZ_COMMAND_##command)
const CzOptionInfo cz_options[CZ_N_OPTION] = {
#define CZ_OPTION(constant, name, letter, value, commands, doc)                                    \
    {name, value, doc, letter, commands},
#include "cli/options.def"
#undef CZ_OPTION
};
#undef IN

/* State of reading the command line. */
typedef struct Reader {
    int argc, next; /* next: index of the next word */
    char **argv;
    bool only_operands; /* after -- */
    CzArguments *arguments;
    CzError *error;
} Reader;

CzCommand cz_command_named(const char *name, CzSuggestion *nearest) {
    if (strcmp(name, "optimize") == 0)
        return CZ_COMMAND_OPTIMISE;
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        return CZ_COMMAND_HELP;
    if (strcmp(name, "--version") == 0)
        return CZ_COMMAND_VERSION;
    const int command = CZ_FIND_NAMED(name, CzCommandInfo, cz_commands, CZ_N_COMMAND, nearest);
    return command >= 0 ? (CzCommand)command : CZ_N_COMMAND;
}

static CzStatus unknown_command(const char *name, const CzSuggestion *nearest, CzError *error) {
    cz_fail(error, CZ_STATUS_INPUT,
            "there is no command '%.100s'" CZ_HELP "'crushzone help' lists the commands", name);
    if (nearest->best[0] != '\0')
        cz_error_help(error, "did you mean 'crushzone %s'?", nearest->best);
    else if (strstr(name, ".yaml") != NULL)
        cz_error_help(error, "did you mean 'crushzone run %.100s'?", name);
    return CZ_STATUS_INPUT;
}

bool cz_command_takes(int command, int option) {
    return (cz_options[option].commands & (1U << command)) != 0;
}

/* The option that a long name means for this command, or an error with the nearest name. */
static CzStatus find_long(CzCommand command, const char *name, size_t n, int *option,
                          CzError *error) {
    char typed[64];
    CzSuggestion suggestion = {0};
    const char *longer = NULL;   /* an option that begins with the typed name */
    const char *of_other = NULL; /* an option of that name, of another command */
    snprintf(typed, sizeof typed, "%.*s", (int)n, name);
    for (int i = 0; i < CZ_N_OPTION; i++) {
        const char *known = cz_options[i].name;
        if (strlen(known) == n && strncmp(known, name, n) == 0) {
            *option = i;
            if (cz_command_takes(command, i))
                return CZ_OK;
            of_other = known; /* several options may have the same name */
        }
        if (!cz_command_takes(command, i))
            continue;
        cz_suggest(&suggestion, typed, known);
        if (n > 0 && strncmp(known, name, n) == 0)
            longer = known;
    }
    if (of_other != NULL)
        return cz_fail(error, CZ_STATUS_INPUT, "'crushzone %s' takes no option '--%s'",
                       cz_commands[command].name, of_other);
    cz_fail(error, CZ_STATUS_INPUT,
            "there is no option '--%s'%s" CZ_HELP "'crushzone help %s' lists its options", typed,
            longer != NULL ? "; options are not abbreviated" : "", cz_commands[command].name);
    if (longer != NULL)
        cz_error_help(error, "did you mean '--%s'?", longer);
    else if (suggestion.best[0] != '\0')
        cz_error_help(error, "did you mean '--%s'?", suggestion.best);
    return CZ_STATUS_INPUT;
}

static CzStatus find_letter(CzCommand command, char letter, int *option, CzError *error) {
    for (int i = 0; i < CZ_N_OPTION; i++)
        if (cz_options[i].letter == letter && cz_command_takes(command, i)) {
            *option = i;
            return CZ_OK;
        }
    return cz_fail(error, CZ_STATUS_INPUT,
                   "'crushzone %s' takes no option '-%c'" CZ_HELP
                   "'crushzone help %s' lists its options",
                   cz_commands[command].name, letter, cz_commands[command].name);
}

/* Keeps an option; `value` is the text after it in the same word, NULL when there is none. */
static CzStatus keep_option(Reader *reader, int option, const char *value) {
    const CzOptionInfo *info = &cz_options[option];
    CzArguments *arguments = reader->arguments;
    if (info->value == NULL && value != NULL)
        return cz_fail(reader->error, CZ_STATUS_INPUT, "'--%s' takes no value", info->name);
    if (info->value != NULL && value == NULL) {
        if (reader->next == reader->argc)
            return cz_fail(reader->error, CZ_STATUS_INPUT, "'--%s' needs a value: --%s %s",
                           info->name, info->name, info->value);
        value = reader->argv[reader->next++];
    }
    arguments->text[option] = value != NULL ? value : "";
    if (option == CZ_OPTION_SET)
        arguments->set[arguments->n_set++] = value;
    else if (option == CZ_OPTION_VARY)
        arguments->vary[arguments->n_vary++] = value;
    else if (option == CZ_OPTION_METRIC)
        arguments->metric[arguments->n_metric++] = value;
    else if (option == CZ_OPTION_MINIMISE)
        arguments->minimise[arguments->n_minimise++] = value;
    else if (option == CZ_OPTION_CHECK)
        arguments->check[arguments->n_check++] = value;
    return CZ_OK;
}

static CzStatus read_word(Reader *reader) {
    const char *word = reader->argv[reader->next++];
    const CzCommand command = reader->arguments->command;
    int option = 0;
    if (reader->only_operands || word[0] != '-' || word[1] == '\0') {
        reader->arguments->operand[reader->arguments->n_operand++] = word;
        return CZ_OK;
    }
    if (strcmp(word, "--") == 0) {
        reader->only_operands = true;
        return CZ_OK;
    }
    if (word[1] == '-') {
        const char *equals = strchr(word, '=');
        const size_t n = equals != NULL ? (size_t)(equals - word) - 2 : strlen(word) - 2;
        CZ_TRY(find_long(command, word + 2, n, &option, reader->error));
        return keep_option(reader, option, equals != NULL ? equals + 1 : NULL);
    }
    CZ_TRY(find_letter(command, word[1], &option, reader->error));
    return keep_option(reader, option, word[2] != '\0' ? word + 2 : NULL);
}

static CzStatus read_whole(const CzArguments *arguments, CzOption option, long lo, long hi,
                           long *value, CzError *error) {
    const char *text = arguments->text[option];
    if (text == NULL)
        return CZ_OK;
    char *end = NULL;
    errno = 0;
    *value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || errno != 0 || *value < lo || *value > hi)
        return cz_fail(error, CZ_STATUS_INPUT, "'--%s %.40s' is not a whole number from %ld to %ld",
                       cz_options[option].name, text, lo, hi);
    return CZ_OK;
}

/* Reads a time with its unit, such as 30s. */
static CzStatus read_time(const CzArguments *arguments, CzOption option, double *value,
                          CzError *error) {
    static const struct {
        const char *name;
        double factor; /* [s] */
    } unit[] = {{"s", 1}, {"min", 60}, {"h", 3600}};
    static const double longest = 1e7; /* [s] */
    const char *text = arguments->text[option];
    char number[32] = "";
    if (text == NULL)
        return CZ_OK;
    const size_t n = strspn(text, "0123456789.");
    for (size_t i = 0; i < sizeof unit / sizeof *unit && n < sizeof number; i++) {
        snprintf(number, sizeof number, "%.*s", (int)n, text);
        if (strcmp(text + n, unit[i].name) == 0 && cz_number_parse(number, value) == NULL) {
            *value *= unit[i].factor;
            if (*value > 0 && *value <= longest)
                return CZ_OK;
        }
    }
    return cz_fail(error, CZ_STATUS_INPUT,
                   "'--%s %.40s' is not a time" CZ_HELP "write it with s, min or h, such as 90s",
                   cz_options[option].name, text);
}

/* Reads "I/N", a part and the number of parts. */
static CzStatus read_shard(CzArguments *arguments, CzError *error) {
    const char *text = arguments->text[CZ_OPTION_SHARD];
    int n_read = 0;
    arguments->shard = arguments->n_shard = 1;
    if (text == NULL ||
        (sscanf(text, "%9d/%9d%n", &arguments->shard, &arguments->n_shard, &n_read) == 2 &&
         text[n_read] == '\0' && arguments->shard >= 1 && arguments->shard <= arguments->n_shard))
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_INPUT,
                   "'--shard %.40s' is not a part and their number, such as 1/4", text);
}

/* Reads one of the words, separated by |; *index is unchanged when the option is absent. */
static CzStatus read_choice(const CzArguments *arguments, CzOption option, const char *words,
                            int *index, CzError *error) {
    const char *text = arguments->text[option];
    char known[120] = "";
    if (text == NULL)
        return CZ_OK;
    for (int i = 0; *words != '\0'; i++) {
        const size_t n = strcspn(words, "|"), used = strlen(known);
        if (strlen(text) == n && strncmp(words, text, n) == 0) {
            *index = i;
            return CZ_OK;
        }
        snprintf(known + used, sizeof known - used, "%s%.*s", i > 0 ? " or " : "", (int)n, words);
        words += n + (words[n] == '|');
    }
    return cz_fail(error, CZ_STATUS_INPUT, "'--%s %.40s' is not known" CZ_HELP "it takes %s",
                   cz_options[option].name, text, known);
}

/* Interprets the values of options. */
static CzStatus read_values(CzArguments *arguments, CzError *error) {
    static const CzOption by_words[] = {CZ_OPTION_COLOR, CZ_OPTION_INTEGRATOR, CZ_OPTION_BASIS,
                                        CZ_OPTION_FLIP, CZ_OPTION_COMPLETION};
    int chosen[] = {CZ_COLOUR_AUTO, CZ_INTEGRATOR_ZHAI, -1, -1, 0}, separator = 0, decimal = 0;
    long n_job = 0, n_stage = -1, n_point = 0;
    CZ_TRY(read_whole(arguments, CZ_OPTION_JOBS, 1, 1024, &n_job, error));
    CZ_TRY(
        read_whole(arguments, CZ_OPTION_EVALUATIONS, 1, 100000000, &arguments->evaluations, error));
    CZ_TRY(read_whole(arguments, CZ_OPTION_WIDTH, CZ_USUAL_WIDTH, CZ_MAX_WIDTH, &arguments->width,
                      error));
    CZ_TRY(read_time(arguments, CZ_OPTION_MAX_TIME, &arguments->max_time, error));
    CZ_TRY(read_whole(arguments, CZ_OPTION_ROUNDS, 1, 10000, &arguments->rounds, error));
    CZ_TRY(read_whole(arguments, CZ_OPTION_SEED, 0, 2000000000, &arguments->seed, error));
    CZ_TRY(read_whole(arguments, CZ_OPTION_RUNS, 1, 1000000, &arguments->n_run, error));
    CZ_TRY(read_whole(arguments, CZ_OPTION_SAMPLES, 1, 1000000, &arguments->n_sample, error));
    CZ_TRY(read_whole(arguments, CZ_OPTION_CURVES, 1, 10000, &arguments->n_curve, error));
    CZ_TRY(read_shard(arguments, error));
    CZ_TRY(read_whole(arguments, CZ_OPTION_STAGES, 0, 100, &n_stage, error));
    CZ_TRY(read_whole(arguments, CZ_OPTION_POINTS, 2, 99, &n_point, error));
    for (size_t i = 0; i < sizeof by_words / sizeof *by_words; i++)
        CZ_TRY(
            read_choice(arguments, by_words[i], cz_options[by_words[i]].value, &chosen[i], error));
    CZ_TRY(read_choice(arguments, CZ_OPTION_CSV_SEP, ",|;|tab", &separator, error));
    CZ_TRY(read_choice(arguments, CZ_OPTION_CSV_DECIMAL, ".|,", &decimal, error));
    arguments->colour = (CzColour)chosen[0];
    arguments->integrator = (CzIntegrator)chosen[1];
    arguments->basis = chosen[2];
    arguments->flip = chosen[3];
    arguments->n_job = (int)n_job;
    arguments->n_stage = (int)n_stage;
    arguments->n_point = (int)n_point;
    arguments->csv_decimal = ".,"[decimal];
    /* With decimal commas the fields are separated by semicolons. */
    const bool implied = arguments->text[CZ_OPTION_CSV_SEP] == NULL && decimal == 1;
    arguments->csv_separator = ",;\t"[implied ? 1 : separator];
    if (arguments->csv_separator == arguments->csv_decimal)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "CSV files cannot have a comma both between fields and in numbers" CZ_HELP
                       "add --csv-sep ';'");
    if (arguments->text[CZ_OPTION_TIME_STEP_MS] != NULL) {
        snprintf(arguments->time_step, sizeof arguments->time_step, "simulation.time_step_ms=%.30s",
                 arguments->text[CZ_OPTION_TIME_STEP_MS]);
        arguments->set[arguments->n_set++] = arguments->time_step;
    }
    return CZ_OK;
}

/* Names of files and folders are texts like any other (base/text.h): other bytes cannot be reported
 * in a message, a log or a document. */
static CzStatus check_file_name(const char *name, CzError *error) {
    char what[CZ_FAULT_SIZE];
    size_t at;
    if (name == NULL || !cz_text_fault(name, strlen(name), false, &at, what))
        return CZ_OK;
    return cz_fail(
        error, CZ_STATUS_INPUT,
        "the name of a file or folder on the command line contains %s" CZ_HELP "rename it", what);
}

static CzStatus check_file_names(const CzArguments *arguments, CzError *error) {
    static const CzOption files[] = {CZ_OPTION_OUTPUT, CZ_OPTION_RESUME, CZ_OPTION_SVG,
                                     CZ_OPTION_MEASURED};
    for (int i = 0; i < arguments->n_operand; i++)
        CZ_TRY(check_file_name(arguments->operand[i], error));
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        CZ_TRY(check_file_name(arguments->text[files[i]], error));
    return CZ_OK;
}

static CzStatus check_operands(const CzArguments *arguments, CzError *error) {
    const CzCommandInfo *info = &cz_commands[arguments->command];
    if (arguments->text[CZ_OPTION_HELP] != NULL)
        return CZ_OK;
    if (arguments->n_operand < info->fewest && info->fewest > 1)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "'crushzone %s' needs %d to %d result folders or problem files, but has %d",
                       info->name, info->fewest, info->most, arguments->n_operand);
    if (arguments->n_operand < info->fewest)
        return cz_fail(error, CZ_STATUS_INPUT, "'crushzone %s' needs %s", info->name,
                       info->operands);
    if (arguments->n_operand > info->most)
        return cz_fail(error, CZ_STATUS_INPUT, "'crushzone %s' takes no argument '%.100s'",
                       info->name, arguments->operand[info->most]);
    for (int i = 0; i < arguments->n_set; i++)
        if (strchr(arguments->set[i], '=') == NULL || arguments->set[i][0] == '=')
            return cz_fail(error, CZ_STATUS_INPUT, "'--set %.100s' is not of the form PATH=VALUE",
                           arguments->set[i]);
    const bool lacks_vary = arguments->command == CZ_COMMAND_SWEEP && arguments->n_vary < 1;
    if (lacks_vary || arguments->n_vary > CZ_MAX_AXES)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "'crushzone %s' needs --vary PATH=A:B:N once or twice", info->name);
    if (arguments->text[CZ_OPTION_SHARD] != NULL && arguments->text[CZ_OPTION_OUTPUT] == NULL)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "--shard needs -o DIR, the folder that 'crushzone merge' reads");
    if (arguments->text[CZ_OPTION_SHARD] != NULL && strcmp(arguments->operand[0], "-") == 0)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "--shard needs a problem file, which 'crushzone merge' reads again, and not "
                       "standard input");
    if (arguments->command == CZ_COMMAND_CORRIDOR && arguments->text[CZ_OPTION_PART] == NULL)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "'crushzone corridor' needs --part NAME" CZ_HELP
                       "NAME is a part with stages, or a path such as "
                       "trains.A.vehicles.A6.front.anti_climber");
    if (arguments->command == CZ_COMMAND_PARETO && arguments->n_minimise != 2 &&
        (arguments->n_minimise > 0 || arguments->text[CZ_OPTION_RESUME] == NULL))
        return cz_fail(error, CZ_STATUS_INPUT,
                       "'crushzone pareto' needs --minimise NAME twice" CZ_HELP
                       "one of them may be margin, the smallest margin of all checks");
    if (arguments->text[CZ_OPTION_RESUME] != NULL && arguments->text[CZ_OPTION_OUTPUT] != NULL)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "--resume takes no -o: the search continues in its own folder");
    if (arguments->text[CZ_OPTION_JSON] != NULL && arguments->n_operand > 1 &&
        arguments->command != CZ_COMMAND_COMPARE && arguments->command != CZ_COMMAND_MERGE)
        return cz_fail(error, CZ_STATUS_INPUT,
                       "with --json 'crushzone %s' takes one FILE: it prints one document",
                       info->name);
    return CZ_OK;
}

CzStatus cz_arguments_read(int argc, char **argv, CzArguments *arguments, CzError *error) {
    memset(arguments, 0, sizeof *arguments);
    arguments->seed = -1;
    arguments->csv_separator = ',';
    arguments->csv_decimal = '.';
    arguments->nothing = argc < 2;
    if (arguments->nothing)
        return CZ_OK;
    CzSuggestion nearest = {0};
    arguments->command = cz_command_named(argv[1], &nearest);
    if (arguments->command == CZ_N_COMMAND)
        return unknown_command(argv[1], &nearest, error);
    const size_t most = (size_t)argc + 1; /* of each list */
    const char **room = calloc(6 * most, sizeof *room);
    if (room == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the command line");
    arguments->operand = room;
    arguments->set = room + most;
    arguments->vary = room + 2 * most;
    arguments->metric = room + 3 * most;
    arguments->check = room + 4 * most;
    arguments->minimise = room + 5 * most;
    Reader reader = {.argc = argc, .next = 2, .argv = argv, .arguments = arguments, .error = error};
    while (reader.next < argc)
        CZ_TRY(read_word(&reader));
    CZ_TRY(read_values(arguments, error));
    CZ_TRY(check_file_names(arguments, error));
    return check_operands(arguments, error);
}

void cz_arguments_free(CzArguments *arguments) {
    free(arguments->operand);
    arguments->operand = NULL;
}
