/* Progress of a search: one rewritten line on a terminal. On a dumb terminal, and on any other
 * stream with --verbose, it is a line every ten seconds. */
#ifndef CZ_CLI_PROGRESS_H
#define CZ_CLI_PROGRESS_H

#include "cli/arguments.h"
#include "crushzone/optimise.h"

typedef struct CzProgressLine {
    bool is_silent, is_terminal;
    bool is_margin;        /* the objective is the negative of the smallest margin */
    const char *unit;      /* of the objective */
    double started, shown; /* [s], of a steady clock */
} CzProgressLine;

void cz_progress_begin(CzProgressLine *line, const CzArguments *arguments, bool is_margin,
                       const char *unit);

/* The callback of CzOptimiseOptions; `data` is the CzProgressLine. */
void cz_progress_show(const CzProgress *progress, void *data);

/* Shows the number of completed runs of all, on a terminal; `data` is the CzArguments. */
void cz_progress_count(int n_done, int n_all, void *data);

/* Clears the line. */
void cz_progress_end(CzProgressLine *line);

#endif
