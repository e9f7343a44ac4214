/* The lines that a report is filed under. Nothing is taken from the clock or the host. */
#include "report/document_lines.h"

#include "crushzone/report.h"
#include "problem/problem.h"

#include <stdio.h>

enum { PROJECT, AUTHOR, REVISION, DATE, PROGRAM, PROBLEM_FILE, HASH, PROFILE };

const char *cz_document_title(int line) {
    static const char *const titles[CZ_N_DOCUMENT_LINE] = {
        [PROJECT] = "project",      [AUTHOR] = "author",
        [REVISION] = "revision",    [DATE] = "date",
        [PROGRAM] = "program",      [PROBLEM_FILE] = "problem file",
        [HASH] = "hash of content", [PROFILE] = "profile"};
    return titles[line];
}

/* "en15227-2008, EN 15227:2008+A1:2010, category C-I". */
static const char *profile_text(const CzProblem *problem, char text[CZ_DOCUMENT_SIZE]) {
    const CzProfile *profile = cz_problem_profile(problem);
    const char *category = cz_problem_input(problem)->checks.category;
    if (profile == NULL)
        return NULL;
    snprintf(text, CZ_DOCUMENT_SIZE, "%s, %s%s%s", profile->name, profile->edition,
             category != NULL ? ", category " : "", category != NULL ? category : "");
    return text;
}

const char *cz_document_text(const CzProblem *problem, int line, char text[CZ_DOCUMENT_SIZE]) {
    const CzDocument *document = &cz_problem_input(problem)->document;
    switch (line) {
    case PROJECT:
        return document->project;
    case AUTHOR:
        return document->author;
    case REVISION:
        return document->revision;
    case DATE:
        return document->date;
    case PROGRAM:
        snprintf(text, CZ_DOCUMENT_SIZE, "crushzone %s", cz_version());
        return text;
    case PROBLEM_FILE:
        return cz_problem_reported_name(problem, cz_problem_file(problem));
    case HASH:
        return cz_problem_hash(problem);
    default:
        return profile_text(problem, text);
    }
}
