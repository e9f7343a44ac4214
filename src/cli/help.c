/* Help, made from the tables of commands, options, units and metrics. */
#include "base/suggest.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "crushzone/report.h"

#include <stdio.h>
#include <string.h>

void cz_help_write_greeting(void) {
    puts("crushzone designs crush zones: it collides trains, judges the collision, sizes "
         "absorbers.\n"
         "\n"
         "  crushzone new two-trains && crushzone run two-trains.yaml    a first collision\n"
         "  crushzone optimise two-trains.yaml                           size its absorbers\n"
         "  crushzone help                                               all commands");
}

enum { WIDTH = 100 }; /* of help on a terminal [characters] */

/* Writes a text from column `indent` on, broken between words; the line is at that column. */
static void write_wrapped(const char *text, int indent) {
    int column = indent;
    while (*text != '\0') {
        const int n = (int)strcspn(text, " ");
        if (column > indent && column + 1 + n > WIDTH) {
            printf("\n%*s", indent, "");
            column = indent;
        }
        if (column > indent) {
            putchar(' ');
            column++;
        }
        printf("%.*s", n, text);
        column += n;
        text += n;
        text += strspn(text, " ");
    }
    putchar('\n');
}

static void write_option(const CzOptionInfo *option) {
    char left[64], letter[8] = "";
    if (option->letter != 0)
        snprintf(letter, sizeof letter, "-%c, ", option->letter);
    snprintf(left, sizeof left, "%s--%s%s%s", letter, option->name,
             option->value != NULL ? " " : "", option->value != NULL ? option->value : "");
    printf("  %-28s ", left);
    write_wrapped(option->doc, 31);
}

void cz_help_write_command(CzCommand command) {
    const CzCommandInfo *info = &cz_commands[command];
    printf("crushzone %s%s%s [OPTION...]\n%s\n\n", info->name, info->operands[0] != '\0' ? " " : "",
           info->operands, info->doc);
    for (int i = 0; i < CZ_N_OPTION; i++)
        if ((cz_options[i].commands & (1U << command)) != 0)
            write_option(&cz_options[i]);
    if (command == CZ_COMMAND_OPTIMISE)
        puts("\n'optimize' is the same command. The first Ctrl-C or SIGTERM ends the search and "
             "writes the best\ndesign so far, the second ends at once.");
}

static void write_exit_codes(const char *before) {
    static const char *const codes[] = {
        "0    done",
        ("1    a check fails or could not be made (check, run --strict), nothing feasible "
         "(optimise)"),
        "2    something is wrong with the command line or a problem file",
        "3    a run failed or is incomplete",
        "4    results cannot be written",
        "5    a fault of the program's own, or no memory",
        "130  interrupted (143 by SIGTERM); the best design so far is written"};
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++)
        printf("%s%s\n", before, codes[i]);
}

static void write_overview(void) {
    puts("crushzone COMMAND [OPTION...] [FILE...]\n");
    for (int i = 0; i < CZ_N_COMMAND; i++)
        printf("  %-10s %-12s %s\n", cz_commands[i].name, cz_commands[i].operands,
               cz_commands[i].doc);
    puts("\n'crushzone help COMMAND' lists a command's options; FILE may be - for standard "
         "input.\nExit codes:");
    write_exit_codes("  ");
}

static void write_overview_page(void) {
    puts("# Command line\n\nThis page is printed by `crushzone help --markdown`.\n");
    for (int command = 0; command < CZ_N_COMMAND; command++) {
        const CzCommandInfo *info = &cz_commands[command];
        printf("## crushzone %s\n\n`crushzone %s%s%s [OPTION...]`: %s.\n\n", info->name, info->name,
               info->operands[0] != '\0' ? " " : "", info->operands, info->doc);
        puts("| option | meaning |\n|---|---|");
        for (int i = 0; i < CZ_N_OPTION; i++) {
            const CzOptionInfo *option = &cz_options[i];
            if ((option->commands & (1U << command)) == 0)
                continue;
            printf("| `--%s", option->name);
            for (const char *c = option->value != NULL ? option->value : ""; *c != '\0'; c++)
                printf("%s%s", c == option->value ? " " : "", *c == '|' ? "\\|" : (char[]){*c, 0});
            putchar('`');
            if (option->letter != 0)
                printf(", `-%c`", option->letter);
            printf(" | %s |\n", option->doc);
        }
        putchar('\n');
    }
    puts("## Exit codes\n\n```");
    write_exit_codes("");
    puts("```");
}

static void write_units(void) {
    static const struct {
        const char *dimension, *suffix, *text;
    } units[] = {
#define CZ_DIMENSION(dimension, text) {#dimension, NULL, text},
#define CZ_UNIT(dimension, suffix, value) {#dimension, suffix, NULL},
#include "problem/units.def"
#undef CZ_DIMENSION
#undef CZ_UNIT
    };
    puts("Every key with a dimension ends in one of its units, such as force_kN or stroke_mm:\n");
    const char *before = "";
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(units[i].dimension, "NONE") == 0)
            continue;
        if (units[i].text != NULL)
            printf("%s  %-20s", before, units[i].text);
        else
            printf(" _%s", units[i].suffix);
        before = "\n";
    }
    putchar('\n');
}

static void write_checks(void) {
    static const struct {
        const char *name, *unit, *doc;
    } metrics[] = {
#define CZ_METRIC(level, name, unit, per_unit, scale, absent, expression, doc) {name, unit, doc},
#include "evaluate/metrics.def"
#undef CZ_METRIC
    };
    puts("What a limit, a target or the objective can be about. The worst place counts unless the "
         "name picks\none: interfaces.A4-B1.peak_force_kN, vehicles.A1.max_pitch_mrad.\n");
    for (size_t i = 0; i < sizeof metrics / sizeof *metrics; i++) {
        printf("  %-40s ", metrics[i].name);
        write_wrapped(metrics[i].doc, 43);
    }
}

static void write_algorithms(void) {
    puts("auto: the program's own strategy. Others, by NLopt's names:\n");
    for (int i = 0; i < cz_n_algorithm(); i++)
        printf("  %s\n", cz_algorithm_name(i));
}

static int unknown_topic(const CzArguments *arguments, const char *topic) {
    static const char *const topics[] = {"keys", "units", "checks", "algorithms"};
    CzSuggestion suggestion = {0};
    for (int i = 0; i < CZ_N_COMMAND; i++)
        cz_suggest(&suggestion, topic, cz_commands[i].name);
    for (int i = 0; i < 4; i++)
        cz_suggest(&suggestion, topic, topics[i]);
    CzError error = {.status = CZ_STATUS_INPUT};
    snprintf(error.message, sizeof error.message, "there is no help on '%.100s'", topic);
    if (suggestion.best != NULL)
        snprintf(error.help, sizeof error.help, "did you mean 'crushzone help %s'?",
                 suggestion.best);
    return cz_tell_error(arguments, &error);
}

int cz_command_help(const CzArguments *arguments) {
    const bool is_page = arguments->text[CZ_OPTION_MARKDOWN] != NULL;
    const char *topic = arguments->n_operand > 0 ? arguments->operand[0] : NULL;
    if (topic == NULL && is_page)
        write_overview_page();
    else if (topic == NULL)
        write_overview();
    else if (strcmp(topic, "keys") == 0 && is_page)
        cz_keys_write_reference(stdout);
    else if (strcmp(topic, "keys") == 0)
        cz_keys_write_help(stdout);
    else if (strcmp(topic, "units") == 0)
        write_units();
    else if (strcmp(topic, "checks") == 0)
        write_checks();
    else if (strcmp(topic, "algorithms") == 0)
        write_algorithms();
    else if (cz_command_named(topic) != CZ_N_COMMAND)
        cz_help_write_command(cz_command_named(topic));
    else
        return unknown_topic(arguments, topic);
    return 0;
}
