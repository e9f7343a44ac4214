/* The command line, read against one table of commands and one of options. */
#ifndef CZ_CLI_ARGUMENTS_H
#define CZ_CLI_ARGUMENTS_H

#include <stdbool.h>

#include "base/suggest.h"
#include "crushzone/executor.h"
#include "crushzone/simulate.h"

typedef enum CzCommand {
#define CZ_COMMAND(constant, name, function, operands, fewest, most, doc) CZ_COMMAND_##constant,
#include "cli/commands.def"
#undef CZ_COMMAND
    CZ_N_COMMAND
} CzCommand;

typedef enum CzOption {
#define CZ_OPTION(constant, name, letter, value, commands, doc) CZ_OPTION_##constant,
#include "cli/options.def"
#undef CZ_OPTION
    CZ_N_OPTION
} CzOption;

typedef struct CzCommandInfo {
    const char *name, *operands, *doc;
    int fewest, most; /* operands */
} CzCommandInfo;

typedef struct CzOptionInfo {
    const char *name, *value, *doc; /* value: name of its argument, NULL for a flag */
    char letter;                    /* 0 when it has none */
    unsigned commands;              /* bit 1 << CzCommand for each command that has it */
} CzOptionInfo;

extern const CzCommandInfo cz_commands[CZ_N_COMMAND];
extern const CzOptionInfo cz_options[CZ_N_OPTION];

typedef enum CzColour { CZ_COLOUR_AUTO, CZ_COLOUR_ALWAYS, CZ_COLOUR_NEVER } CzColour;

/* What was requested. Texts are borrowed from argv; arrays are owned. */
typedef struct CzArguments {
    bool nothing; /* no command given */
    CzCommand command;
    const char *text[CZ_N_OPTION]; /* value of each option, NULL when absent; "" for a flag */
    const char **operand;          /* file names, topic or template (n_operand) */
    int n_operand;
    const char **set; /* "path=value" texts in order (n_set) */
    int n_set;
    const char **vary; /* "path=a:b:n" texts (n_vary) */
    int n_vary;
    const char **metric; /* names (n_metric) */
    int n_metric;
    const char **minimise; /* names (n_minimise) */
    int n_minimise;
    const char **check; /* names (n_check) */
    int n_check;
    char time_step[64];         /* room for the setting that --time-step-ms represents */
    int n_job;                  /* 0: number of processors */
    const CzExecutor *executor; /* NULL: threads */
    long evaluations;           /* 0: that of the file */
    long seed;                  /* -1: that of the file */
    long width;                 /* 0: the default */
    double max_time;            /* [s]; 0 for none */
    long rounds;                /* 0: the default */
    long n_run;                 /* 0: the default */
    long n_sample;              /* 0: that of the file */
    long n_curve;               /* 0: the default */
    int shard, n_shard;         /* 1 and 1: all samples or points */
    int n_point;                /* 0: the default */
    int n_stage;                /* -1: as many as the curve requires */
    int basis, flip;            /* words of these options, counted from 0; -1: not given */
    CzIntegrator integrator;
    char csv_separator, csv_decimal;
    CzColour colour;
} CzArguments;

/* Reads the command line. Names must be written out: an abbreviation that works today would change
 * its meaning when an option is added. Free with cz_arguments_free also after a failure. Statuses:
 * CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_arguments_read(int argc, char **argv, CzArguments *arguments,
                                         CzError *error);
void cz_arguments_free(CzArguments *arguments);

/* The command of a name or of another spelling of it; CZ_N_COMMAND when there is none, and then the
 * nearest name. */
CzCommand cz_command_named(const char *name, CzSuggestion *nearest);
bool cz_command_takes(int command, int option);

#endif
