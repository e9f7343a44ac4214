/* The text of a journal: a JSON document on each line, first the head, then the evaluations. */
#ifndef CZ_REPORT_JOURNAL_H
#define CZ_REPORT_JOURNAL_H

#include "base/arena.h"
#include "crushzone/report.h"

/* Everything that two searches must have in common to give the same evaluations. */
typedef struct CzJournalStart {
    const char *command;         /* "optimise" or "pareto" */
    const char *version, *nlopt; /* of the program and of the library */
    const char *problem;         /* its hash */
    int n_variable, n_constraint, n_detail;
    long n_earlier; /* of CzJournal */
    CzJournalHead head;
} CzJournalStart;

/* A journal that was read; memory is that of the arena. */
typedef struct CzJournalText {
    CzJournalStart start;
    CzAnswer *answer; /* (start.head.n_answer) */
    long n_head;      /* length of the first line [byte] */
    long n_whole;     /* length of all complete lines [byte] */
} CzJournalText;

/* The start of the search of a report; version texts come from the arena. False without memory. */
bool cz_journal_start(const CzReport *report, const CzOptimiseOptions *options, CzArena *arena,
                      CzJournalStart *start);

/* Write a line each; a full disk shows when the stream is flushed. The head also names variables,
 * constraints and checks. Status: CZ_OK, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_journal_write_head(const CzJournalStart *start, const CzReport *report,
                                             FILE *stream, CzError *error);
void cz_journal_write_entry(const CzJournalStart *start, const CzNews *news, int design,
                            FILE *stream);

/* Reads a journal. Statuses: CZ_STATUS_INPUT with the number of a damaged line,
 * CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_journal_read(const char *name, FILE *stream, CzArena *arena,
                                       CzJournalText *text, CzError *error);

#endif
