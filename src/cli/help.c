/* Help on a terminal, made from the tables of commands and options. */
#include "cli/help.h"

#include "base/error.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/templates.h"
#include "crushzone/report.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

void cz_help_write_greeting(void) {
    puts("crushzone designs crush zones: it simulates the collision of trains, checks limits, "
         "sizes absorbers.\n"
         "\n"
         "  crushzone new two-trains && crushzone run two-trains.yaml    a first collision\n"
         "  crushzone optimise two-trains.yaml                           size its absorbers\n"
         "  crushzone help                                               all commands");
}

static void write_option(const CzOptionInfo *option) {
    char left[64], letter[8] = "";
    if (option->letter != 0)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    snprintf(left, sizeof left, "%s--%s%s%s", letter, option->name,
             option->value != NULL ? " " : "", option->value != NULL ? option->value : "");
    printf("  %-28s ", left);
    cz_help_write_wrapped(option->doc, 31);
}

static void write_templates(void) {
    puts("\nTemplates:");
    for (int i = 0; i < CZ_N_TEMPLATE; i++)
        printf("  %-12s %s\n", cz_templates[i].name, cz_templates[i].doc);
}

void cz_help_write_command(CzCommand command) {
    const CzCommandInfo *info = &cz_commands[command];
    printf("crushzone %s%s%s [OPTION...]\n%s\n\n", info->name, info->operands[0] != '\0' ? " " : "",
           info->operands, info->doc);
    for (int i = 0; i < CZ_N_OPTION; i++)
        if (cz_command_takes(command, i))
            write_option(&cz_options[i]);
    if (command == CZ_COMMAND_OPTIMISE)
        puts("\n'optimize' is the same command. The first Ctrl-C or SIGTERM ends the search and "
             "writes the best\ndesign so far, the second ends at once.");
    if (command == CZ_COMMAND_NEW)
        write_templates();
}

static void write_overview(void) {
    puts("crushzone COMMAND [OPTION...] [FILE...]\n");
    for (int i = 0; i < CZ_N_COMMAND; i++)
        printf("  %-10s %-12s %s\n", cz_commands[i].name, cz_commands[i].operands,
               cz_commands[i].doc);
    puts("\n'crushzone help COMMAND' lists a command's options; FILE may be - for standard input.\n"
         "'crushzone help TOPIC' explains:");
    for (int i = 0; i < CZ_N_TOPIC; i++)
        printf("  %-12s %s\n", cz_topics[i].name, cz_topics[i].doc);
}

static int unknown_topic(const CzArguments *arguments, const char *topic,
                         const CzSuggestion *nearest) {
    CzError error;
    cz_fail(&error, CZ_STATUS_INPUT,
            "there is no help on '%.100s'" CZ_HELP "'crushzone help' lists commands and topics",
            topic);
    if (nearest->best[0] != '\0')
        cz_error_help(&error, "did you mean 'crushzone help %s'?", nearest->best);
    return cz_print_error(arguments, &error);
}

/* Only `help parts` takes a file. */
static int refuse_file(const CzArguments *arguments) {
    CzError error;
    cz_fail(&error, CZ_STATUS_INPUT,
            "'help %.100s' takes no file" CZ_HELP
            "crushzone help parts FILE lists the parts of a file",
            arguments->operand[0]);
    return cz_print_error(arguments, &error);
}

int cz_command_help(const CzArguments *arguments) {
    const bool is_page = arguments->text[CZ_OPTION_MARKDOWN] != NULL;
    const char *name = arguments->n_operand > 0 ? arguments->operand[0] : NULL;
    CzSuggestion nearest = {0};
    const CzCommand command = name != NULL ? cz_command_named(name, &nearest) : CZ_N_COMMAND;
    const int topic =
        name != NULL ? CZ_FIND_NAMED(name, CzHelpEntry, cz_topics, CZ_N_TOPIC, &nearest) : -1;
    if (arguments->n_operand > 1 && topic != CZ_TOPIC_PARTS)
        return refuse_file(arguments);
    if (topic == CZ_TOPIC_PARTS)
        return cz_help_write_parts(arguments,
                                   arguments->n_operand > 1 ? arguments->operand[1] : NULL);
    if (name == NULL && arguments->text[CZ_OPTION_MAN] != NULL)
        cz_help_write_man();
    else if (name == NULL && arguments->text[CZ_OPTION_COMPLETION] != NULL)
        cz_help_write_bash();
    else if (name == NULL && is_page)
        cz_help_write_markdown();
    else if (name == NULL)
        write_overview();
    else if (is_page && topic == CZ_TOPIC_KEYS)
        cz_keys_write_reference(stdout);
    else if (is_page && topic == CZ_TOPIC_CHANNELS)
        cz_help_write_channels_markdown();
    else if (is_page && topic == CZ_TOPIC_RESULTS)
        cz_report_write_results_page(stdout);
    else if (topic >= 0)
        cz_help_write_topic((CzTopic)topic);
    else if (command != CZ_N_COMMAND)
        cz_help_write_command(command);
    else
        return unknown_topic(arguments, name, &nearest);
    return 0;
}
