/* Curves of LS-DYNA keyword files: *DEFINE_CURVE and *DEFINE_CURVE_TITLE.
 *
 *   *DEFINE_CURVE_TITLE
 *   a title                                      only with _TITLE
 *   LCID, SIDR, SFA, SFO, OFFA, OFFO             fields of 10 characters, or with commas
 *   abscissa, ordinate                           fields of 20 characters, or with commas
 *
 *   x = SFA (abscissa + OFFA),   y = SFO (ordinate + OFFO)
 *
 * Lines that begin with $ are comments; one of them in the curve may be its titles with units, such
 * as "$ stroke_mm, force_kN". Other keywords are skipped, so that a whole model can be read.
 */
#ifndef CZ_TEXT_CURVE_DYNA_H
#define CZ_TEXT_CURVE_DYNA_H

#include "text/curve_columns.h"

/* Whether a file has such a keyword. */
bool cz_dyna_is(const CzSource *source);

/* Reads the curve that is requested by its title or its number, "lcid 12", as the column of the
 * ordinate; without a request the only one. The reading has its lines. False with a mistake, or
 * without memory. */
bool cz_dyna_read(CzCurveReading *reading);

#endif
