/* Histories of a run as a test folder in ISO-MME (ISO/TS 13499), which crash laboratories read:
 * NAME.mme, Channel/NAME.chn, Channel/NAME.001 and so on. Values are in SI units, with as many
 * digits as give the same number when they are read.
 */
#ifndef CZ_REPORT_ISO_MME_H
#define CZ_REPORT_ISO_MME_H

#include <stdio.h>

#include "crushzone/report.h"
#include "evaluate/scene.h"

/* A run with its scene. Borrowed. */
typedef struct CzIsoMme {
    const CzProblem *problem;
    const CzRun *run;
    const CzScene *scene;
    const char *test; /* name of the test, which the files have */
} CzIsoMme;

enum { CZ_ISO_MME_CODE = 17 }; /* characters of a code, with its end */

/* Number of channels, without the time. */
int cz_iso_mme_n_channel(const CzIsoMme *mme);

/* The code of a channel, counted from 0. */
void cz_iso_mme_code(const CzIsoMme *mme, int channel, char code[CZ_ISO_MME_CODE]);

void cz_iso_mme_write_test(const CzIsoMme *mme, FILE *stream);
void cz_iso_mme_write_index(const CzIsoMme *mme, FILE *stream);
void cz_iso_mme_write_channel(const CzIsoMme *mme, int channel, FILE *stream);

#endif
