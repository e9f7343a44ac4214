/* Commands: each returns the program's exit code. */
#ifndef CZ_CLI_COMMAND_H
#define CZ_CLI_COMMAND_H

#include "cli/arguments.h"

#define CZ_COMMAND(constant, name, function, ...)                                                  \
    int cz_command_##function(const CzArguments *arguments);
#include "cli/commands.def"
#undef CZ_COMMAND

/* The five lines of a program that was given no command, and the help of one command. */
void cz_help_write_greeting(void);
void cz_help_write_command(CzCommand command);

#endif
