/* Side view of the cars, to scale, at one sample of a run. */
#ifndef CZ_REPORT_SCENE_H
#define CZ_REPORT_SCENE_H

#include "report/page.h"

#define CZ_SCENE_SCALE 24.0   /* units of the drawing in a metre */
#define CZ_SCENE_MAGNIFY 10.0 /* of vertical movements and pitch */
#define CZ_SCENE_HEIGHT 118.0
#define CZ_SCENE_RAIL 104.0 /* height of the rail head in the drawing */

/* Draws rail and cars at a sample, in a window of `width` centred between the two faces of an
 * interface. `moves` adds the data with which the page's script moves them, and draws all cars
 * instead of the visible ones. */
void cz_scene_write(const CzPage *page, int interface, int sample, double width, bool moves,
                    CzMarkup *markup);

#endif
