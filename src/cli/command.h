/* Commands: each returns the program's exit code. */
#ifndef CZ_CLI_COMMAND_H
#define CZ_CLI_COMMAND_H

#include "cli/arguments.h"

int cz_command_run(const CzArguments *arguments); /* run and check */
int cz_command_optimise(const CzArguments *arguments);
int cz_command_sweep(const CzArguments *arguments);
int cz_command_study(const CzArguments *arguments); /* explain, verify, bench */
int cz_command_report(const CzArguments *arguments);
int cz_command_plot(const CzArguments *arguments);
int cz_command_compare(const CzArguments *arguments);
int cz_command_validate(const CzArguments *arguments);
int cz_command_show(const CzArguments *arguments);
int cz_command_fit(const CzArguments *arguments);
int cz_command_new(const CzArguments *arguments);
int cz_command_schema(const CzArguments *arguments);
int cz_command_help(const CzArguments *arguments);
int cz_command_version(const CzArguments *arguments);

/* The five lines of a program that was given no command, and the help of one command. */
void cz_help_write_greeting(void);
void cz_help_write_command(CzCommand command);

#endif
