/* Histories of test folders in ISO-MME (ISO/TS 13499).
 *
 *   NAME.mme            the test
 *   Channel/NAME.chn    the channels, lines "Name of channel 001 :CODE / NAME"
 *   Channel/NAME.001    a channel: lines "KEY :VALUE", then one value a line
 *
 * A code has 16 characters: test object, position, main location (4), fine locations (3 x 2),
 * physical dimension (2), direction, filter class; '?' is any character. Samples are equidistant in
 * time: the value k is at "Time of first sample" + k "Sampling interval". The value NOVALUE is
 * missing.
 */
#ifndef CZ_TEXT_CURVE_MME_H
#define CZ_TEXT_CURVE_MME_H

#include "text/curve_columns.h"

enum { CZ_MME_CODE = 16 }; /* characters of a code */

/* Whether a path is that of a test: it ends in .mme. */
bool cz_mme_is_test(const char *path);

/* Whether the lines are those of a channel. */
bool cz_mme_is_channel(const CzSource *source);

/* Reads a channel whose lines the reading has. False with a mistake, or without memory. */
bool cz_mme_read_channel(CzCurveReading *reading);

/* Finds the file of the channel that is requested as the column of the ordinate: by its name with
 * or without a unit, by its code, by its number as a column behind that of the time, or as the only
 * one of its dimension. NULL with a mistake, or without memory. */
const char *cz_mme_find_channel(CzSources *sources, CzMistakes *mistakes, const char *path,
                                const CzNode *place, const CzCurveRequest *request);

/* The names of the time and of all channels as titles between tabs; NULL with a mistake, or without
 * memory. */
const char *cz_mme_titles(CzSources *sources, CzMistakes *mistakes, const char *path);

#endif
