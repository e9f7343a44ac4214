/* Inventory of parts: kind, forces, strokes and energy of each part of a catalogue or problem. */
#ifndef CRUSHZONE_PARTS_H
#define CRUSHZONE_PARTS_H

#include "crushzone/problem.h"

CZ_BEGIN_DECLARATIONS

/* One part. Texts are borrowed from the inventory. Of devices in series strokes and energies add
 * up; of the load paths of a vehicle end the energies, and the stroke is that of the longest path;
 * of a vehicle the numbers are those of its front end, or of the rear one without it. */
typedef struct CzPartInfo {
    const char *name;
    const char *kind;  /* such as "tube", "vehicle", as in `crushzone help keys`; NULL: unknown */
    const char *file;  /* in which it is written, relative to the problem or the share folder */
    double force_from; /* smallest force of a stage, of all devices side by side [N]; NaN: none */
    double force_to;   /* largest force: also a trigger, or the force that shears off [N] */
    double stroke;     /* usable stroke, of an end in front of the survival space [m]; NaN: none */
    double energy;     /* of these forces over the stroke [J]; NaN: none */
    double mass;       /* of a vehicle without payload, an end or a bogie [kg]; NaN: none */
    double length;     /* of a vehicle [m]; NaN: none */
} CzPartInfo;

typedef struct CzInventory CzInventory;

/* Reads the parts of a file: of a problem those that its vehicles use, in the order of reading; of
 * a catalogue those that are written in it. Settings of the options do not apply. The inventory is
 * freed by the caller. Statuses: CZ_OK, CZ_STATUS_INPUT, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_inventory_read(const char *path, const CzProblemOptions *options,
                                                CzInventory **inventory, CzError *error);
CZ_API void cz_inventory_free(CzInventory *inventory);

CZ_API int cz_inventory_n_part(const CzInventory *inventory);
CZ_API const CzPartInfo *cz_inventory_part(const CzInventory *inventory, int index);

CZ_END_DECLARATIONS
#endif
