/* The command line as pages that other programs read: Markdown, man, completion of bash. */
#include "cli/help.h"

#include "cli/arguments.h"
#include "cli/templates.h"
#include "crushzone/report.h"

#include <stdio.h>
#include <string.h>

/* ---- Markdown ---- */

void cz_help_write_markdown(void) {
    puts("# Command line\n\nThis page is printed by `crushzone help --markdown`.\n");
    for (int command = 0; command < CZ_N_COMMAND; command++) {
        const CzCommandInfo *info = &cz_commands[command];
        printf("## crushzone %s\n\n`crushzone %s%s%s [OPTION...]`: %s.\n\n", info->name, info->name,
               info->operands[0] != '\0' ? " " : "", info->operands, info->doc);
        puts("| option | meaning |\n|---|---|");
        for (int i = 0; i < CZ_N_OPTION; i++) {
            const CzOptionInfo *option = &cz_options[i];
            if (!cz_command_takes(command, i))
                continue;
            printf("| `--%s", option->name);
            for (const char *c = option->value != NULL ? option->value : ""; *c != '\0'; c++)
                printf("%s%s", c == option->value ? " " : "", *c == '|' ? "\\|" : (char[]){*c, 0});
            putchar('`');
            if (option->letter != 0)
                printf(", `-%c`", option->letter);
            printf(" | %s |\n", option->doc);
        }
        if (command == CZ_COMMAND_NEW) {
            puts("\n| template | |\n|---|---|");
            for (int i = 0; i < CZ_N_TEMPLATE; i++)
                printf("| `%s` | %s |\n", cz_templates[i].name, cz_templates[i].doc);
        }
        putchar('\n');
    }
    puts("## Topics\n\n| `crushzone help` | |\n|---|---|");
    for (int i = 0; i < CZ_N_TOPIC; i++)
        printf("| `%s` | %s |\n", cz_topics[i].name, cz_topics[i].doc);
    puts("\n## Verdicts\n\n| verdict | when |\n|---|---|");
    for (const CzHelpEntry *rule = cz_verdict_rules; rule->name != NULL; rule++)
        printf("| %s | %s |\n", rule->name, rule->doc);
    printf("\n%s\n", cz_verdict_remark);
    puts("\n## Exit codes\n\n```");
    for (const CzHelpEntry *code = cz_exit_codes; code->name != NULL; code++)
        printf("%-4s %s\n", code->name, code->doc);
    puts("```");
}

/* ---- man ---- */

/* Text of roff: escapes backslashes, hyphens, and a first character that would begin a request.
 */
static void write_roff(const char *text) {
    if (text[0] == '.' || text[0] == '\'')
        fputs("\\&", stdout);
    for (const char *c = text; *c != '\0'; c++) {
        if (*c == '\\')
            fputs("\\e", stdout);
        else if (*c == '-')
            fputs("\\-", stdout);
        else
            putchar(*c);
    }
}

/* One entry of a list: typed text in bold, placeholders in italics, then the meaning. */
static void write_entry(const char *typed, const char *value, const char *doc) {
    fputs(".TP\n\\fB", stdout);
    write_roff(typed);
    fputs("\\fR", stdout);
    if (value != NULL) {
        fputs(" \\fI", stdout);
        write_roff(value);
        fputs("\\fR", stdout);
    }
    putchar('\n');
    write_roff(doc);
    putchar('\n');
}

static void write_man_commands(void) {
    puts(".SH COMMANDS");
    for (int command = 0; command < CZ_N_COMMAND; command++) {
        const CzCommandInfo *info = &cz_commands[command];
        fputs(".SS crushzone ", stdout);
        write_roff(info->name);
        fputs(" ", stdout);
        write_roff(info->operands);
        putchar('\n');
        write_roff(info->doc);
        puts(".");
        for (int i = 0; i < CZ_N_OPTION; i++) {
            const CzOptionInfo *option = &cz_options[i];
            if (!cz_command_takes(command, i) || i == CZ_OPTION_HELP)
                continue;
            char typed[64], letter[] = {'-', option->letter, ',', ' ', '\0'};
            snprintf(typed, sizeof typed, "%s--%s", option->letter != 0 ? letter : "",
                     option->name);
            write_entry(typed, option->value, option->doc);
        }
        for (int i = 0; command == CZ_COMMAND_NEW && i < CZ_N_TEMPLATE; i++)
            write_entry(cz_templates[i].name, NULL, cz_templates[i].doc);
    }
}

void cz_help_write_man(void) {
    puts(".\\\" Printed by crushzone help --man.\n"
         ".TH CRUSHZONE 1 \"\" crushzone\n"
         ".SH NAME\ncrushzone \\- design of the crush zones of railway trains\n"
         ".SH SYNOPSIS\n.B crushzone\n.I COMMAND\n[\\fIOPTION\\fR...] [\\fIFILE\\fR...]\n"
         ".SH DESCRIPTION\n"
         "crushzone simulates the collision of trains that a problem file describes, judges the "
         "collision against\n"
         "limits, and sizes couplers, collapse tubes, anti\\-climbers and car ends until every "
         "check\n"
         "passes.\n.PP\n"
         "Results go to standard output, progress and warnings to standard error. A\n"
         ".I FILE\nmay be \\- for standard input. Options cannot be abbreviated; they may follow\n"
         "files. Every command takes \\fB\\-h\\fR, \\fB\\-\\-help\\fR.");
    write_man_commands();
    puts(".SH TOPICS\n.B crushzone help\n.I TOPIC\nexplains:");
    for (int i = 0; i < CZ_N_TOPIC; i++)
        write_entry(cz_topics[i].name, NULL, cz_topics[i].doc);
    puts(".SH \"EXIT STATUS\"");
    for (const CzHelpEntry *code = cz_exit_codes; code->name != NULL; code++)
        write_entry(code->name, NULL, code->doc);
    puts(".SH ENVIRONMENT");
    write_entry("NO_COLOR", NULL, "when set and not empty: no colours unless requested");
    write_entry("TERM", NULL, "dumb: no colours and no progress line");
    puts(".SH EXAMPLE\n.nf\n"
         "crushzone new two\\-trains\n"
         "crushzone run two\\-trains.yaml\n"
         "crushzone optimise two\\-trains.yaml\n"
         ".fi");
}

/* ---- bash ---- */

static void write_bash_values(void) {
    puts("    case $before in");
    for (int i = 0; i < CZ_N_OPTION; i++) {
        const CzOptionInfo *option = &cz_options[i];
        if (option->value == NULL)
            continue;
        printf("    --%s", option->name);
        if (option->letter != 0)
            printf(" | -%c", option->letter);
        fputs(") ", stdout);
        if (i == CZ_OPTION_WHAT) {
            fputs("words='", stdout);
            for (int k = 0; cz_report_chart_name(k) != NULL; k++)
                printf("%s%s", k > 0 ? " " : "", cz_report_chart_name(k));
            puts("' ;;");
        } else if (strncmp(option->value, "FILE", 4) == 0 || strcmp(option->value, "DIR") == 0) {
            puts("COMPREPLY=($(compgen -f -- \"$word\")); return ;;");
        } else if (strchr(option->value, '|') != NULL) {
            fputs("words='", stdout);
            for (const char *c = option->value; *c != '\0'; c++)
                putchar(*c == '|' ? ' ' : *c);
            puts("' ;;");
        } else {
            puts("return ;;");
        }
    }
    puts("    esac");
}

static void write_bash_options(void) {
    puts("    case ${COMP_WORDS[1]} in");
    for (int command = 0; command < CZ_N_COMMAND; command++) {
        printf("    %s%s) options='", cz_commands[command].name,
               command == CZ_COMMAND_OPTIMISE ? " | optimize" : "");
        for (int i = 0, n = 0; i < CZ_N_OPTION; i++)
            if (cz_command_takes(command, i))
                printf("%s--%s", n++ > 0 ? " " : "", cz_options[i].name);
        puts("' ;;");
    }
    puts("    esac");
}

void cz_help_write_bash(void) {
    puts("# Completion of crushzone for bash. Printed by crushzone help --completion bash.\n"
         "_crushzone() {\n"
         "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words='' "
         "options=''\n"
         "    COMPREPLY=()");
    fputs("    if [ \"$COMP_CWORD\" = 1 ]; then\n        words='", stdout);
    for (int command = 0; command < CZ_N_COMMAND; command++)
        printf("%s%s", command > 0 ? " " : "", cz_commands[command].name);
    puts("'\n        COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n        return\n    fi");
    write_bash_values();
    puts("    if [ -n \"$words\" ]; then\n"
         "        COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n        return\n    fi");
    write_bash_options();
    fputs("    if [[ $word == -* ]]; then\n"
          "        COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
          "    elif [ \"${COMP_WORDS[1]}\" = help ]; then\n"
          "        COMPREPLY=($(compgen -W '",
          stdout);
    for (int i = 0; i < CZ_N_TOPIC; i++)
        printf("%s ", cz_topics[i].name);
    for (int command = 0; command < CZ_N_COMMAND; command++)
        printf("%s%s", command > 0 ? " " : "", cz_commands[command].name);
    puts("' -- \"$word\"))\n"
         "    elif [ \"${COMP_WORDS[1]}\" != new ]; then\n"
         "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "    else");
    fputs("        COMPREPLY=($(compgen -W '", stdout);
    for (int i = 0; i < CZ_N_TEMPLATE; i++)
        printf("%s%s", i > 0 ? " " : "", cz_templates[i].name);
    puts("' -- \"$word\"))\n"
         "    fi\n"
         "}\n"
         "complete -o filenames -F _crushzone crushzone");
}
