/* Weak points of a challenge as problem files. */
#ifndef CZ_REPORT_CHALLENGE_FILES_H
#define CZ_REPORT_CHALLENGE_FILES_H

#include "crushzone/report.h"

#define CZ_COUNTER_EXAMPLE "counter-example.yaml"
#define CZ_COUNTER_EXAMPLES "with-counter-examples.yaml"

/* Whether a challenge has counter-examples that can be written: a weak point with values that a
 * problem may have, and a problem in a file. */
bool cz_challenge_has_files(const CzReport *report);

/* Writes a file that extends the problem: with the worst weak point as a further scenario, which
 * `check` fails with the same results, or with all of them; `folder` is the final path of the
 * result folder. */
void cz_challenge_write_file(const CzReport *report, bool all, const char *folder, FILE *stream);

#endif
