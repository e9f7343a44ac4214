/* Resuming a search: its options are those of its journal. */
#include "cli/resume.h"

#include "cli/messages.h"

#include <stdlib.h>
#include <string.h>

/* The value of an option in a journal, of one that is given several times the number-th; NULL when
 * there is none. */
static const char *written(const CzJournalHead *head, const char *option, int number) {
    for (int k = 0; k + 1 < head->n_word; k += 2)
        if (strcmp(head->word[k], option) == 0 && number-- == 0)
            return head->word[k + 1];
    return NULL;
}

static bool is_other_text(const char *typed, const char *kept) {
    return typed != NULL && strcmp(typed, kept) != 0;
}

/* Replaces options that are not given, or are the same, by those of the journal, so that pages show
 * the command that began the search. */
static void take_options(CzArguments *arguments, const CzJournalHead *head) {
    const char **text = arguments->text;
    const char *points = written(head, "--points", 0);
    if (!is_other_text(text[CZ_OPTION_ALGORITHM], head->algorithm))
        text[CZ_OPTION_ALGORITHM] = written(head, "--algorithm", 0);
    if (arguments->seed < 0 || arguments->seed == head->seed) {
        text[CZ_OPTION_SEED] = written(head, "--seed", 0);
        arguments->seed = head->seed;
    }
    if (arguments->evaluations == 0 || arguments->evaluations == head->evaluations) {
        text[CZ_OPTION_EVALUATIONS] = written(head, "--evaluations", 0);
        arguments->evaluations = head->evaluations;
    }
    if (arguments->width == 0 || arguments->width == head->width) {
        text[CZ_OPTION_WIDTH] = written(head, "--width", 0);
        arguments->width = head->width;
    }
    if (arguments->n_point == 0 && points != NULL) {
        text[CZ_OPTION_POINTS] = points;
        arguments->n_point = (int)strtol(points, NULL, 10);
    }
    for (int k = arguments->n_minimise; k < 2 && written(head, "--minimise", k) != NULL; k++)
        arguments->minimise[arguments->n_minimise++] = written(head, "--minimise", k);
    if (arguments->n_set == 0) {
        arguments->set = (const char **)head->set;
        arguments->n_set = head->n_set;
    }
}

int cz_resume_open(CzArguments *arguments, const char *folder, CzJournalFile **journal) {
    CzError error = {0};
    if (cz_journal_open(folder, arguments->text[CZ_OPTION_RESUME] != NULL, journal, &error) !=
        CZ_OK)
        return cz_print_error(arguments, &error);
    const CzJournalHead *head = cz_journal_head(*journal);
    if (head == NULL)
        return 0;
    take_options(arguments, head);
    cz_print_note(arguments, "resuming after %ld evaluations%s", head->n_answer,
                  head->was_torn ? "; the last line of the journal was incomplete and is left out"
                                 : "");
    return 0;
}

bool cz_resume_is_useless(CzStatus status) {
    return status == CZ_STATUS_INPUT || status == CZ_STATUS_RUN_FAILED;
}
