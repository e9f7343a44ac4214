/* The program as a function. */
#ifndef CZ_CLI_PROGRAM_H
#define CZ_CLI_PROGRAM_H

#include "crushzone/executor.h"

/* Runs the command of the command line; `executor` NULL: in threads. Returns the exit code. */
int cz_program(int argc, char **argv, const CzExecutor *executor);

#endif
