/* A challenge as tables and sentences, for the terminal, the page and files. */
#ifndef CZ_REPORT_CHALLENGE_TABLE_H
#define CZ_REPORT_CHALLENGE_TABLE_H

#include "crushzone/challenge.h"
#include "report/table.h"

enum { CZ_CHALLENGE_SENTENCE = 4000 };

/* Sentences without their full stop: the outcome; what was varied; a weak point with its check and
 * margin; the values of a point. */
void cz_challenge_outcome_sentence(const CzChallenge *challenge, char text[CZ_CHALLENGE_SENTENCE]);
void cz_challenge_method_sentence(const CzChallenge *challenge, char text[CZ_CHALLENGE_SENTENCE]);
void cz_challenge_weak_sentence(const CzChallenge *challenge, int weak,
                                char text[CZ_CHALLENGE_SENTENCE]);
void cz_challenge_values_sentence(const CzChallenge *challenge, int point,
                                  char text[CZ_CHALLENGE_SENTENCE]);

/* Table of weak points; with their values on a page. */
void cz_challenge_begin_weak(CzReportTable *table, const CzChallenge *challenge, bool on_page);

#endif
