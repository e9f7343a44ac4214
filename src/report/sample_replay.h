/* Samples as problem files, which `check` judges with the same results. */
#ifndef CZ_REPORT_SAMPLE_REPLAY_H
#define CZ_REPORT_SAMPLE_REPLAY_H

#include "crushzone/report.h"
#include "problem/problem.h"

/* Whether a sample is written: it is the worst one of a check, or of all. */
bool cz_replay_is_written(const CzSampling *sampling, int sample);

enum { CZ_REPLAY_SIZE = 40 };
/* Name of its file in the result folder. */
void cz_replay_name(int sample, char name[CZ_REPLAY_SIZE]);

/* Begins the list of further scenarios of a problem, and writes one of them: like a scenario of the
 * problem, with these values (n_draw) of draws. */
void cz_replay_begin_scenarios(const CzProblem *problem, FILE *stream);
void cz_replay_write_scenario(const CzProblem *problem, int scenario, const char *name, int n_draw,
                              const CzDraw *draw, const double *value, FILE *stream);

/* Writes a further scenario of a problem with the changes of a case. */
void cz_replay_write_case(const CzProblem *problem, const CzCase *of, FILE *stream);

/* Writes the scenarios of a sample as a file that extends the problem; `folder` is the final path
 * of the result folder. */
void cz_replay_write(const CzReport *report, int sample, const char *folder, FILE *stream);

/* Whether settings alone make the values of a sample: each of its numbers is a value, and none is
 * of a vehicle, of which copies have their own in a sample, or of a scenario. */
bool cz_replay_is_settings(const CzSampling *sampling);

/* Writes the command that runs such a sample, without an end of line. */
void cz_replay_write_command(const CzReport *report, int sample, FILE *stream);

#endif
