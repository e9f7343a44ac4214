/* Side elevation of the two colliding ends. */
#ifndef CZ_REPORT_ELEVATION_H
#define CZ_REPORT_ELEVATION_H

#include "model/model.h"
#include "model/layout.h"
#include "report/markup.h"

/* Writes an element `svg`: both ends of the colliding interface to scale at first contact, heights
 * above rail, and below each end the available length in front of the survival space against the
 * strokes of the devices. */
void cz_elevation_write(const CzModel *model, const CzLayout *layout, CzMarkup *markup);

#endif
