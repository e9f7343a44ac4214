/* Strokes of curves: total ones include the elastic shortening, plastic ones do not.
 *
 *   tube, anti-climber   d = s + F / k            the law is over s, k its stiffness
 *   end                  d = s + c F,  c = (1 - r) / Ku1 + r / Ku2   the law is over d
 *
 * with the unloading stiffnesses Ku1 and Ku2 of the end and the share r between them.
 */
#ifndef CZ_PROBLEM_STROKES_H
#define CZ_PROBLEM_STROKES_H

#include "problem/input.h"
#include "tree/reader.h"

/* Common properties of tubes and anti-climbers, the collapsing devices. */
typedef struct CzDevice {
    bool given;
    int count;
    const CzStage *stages;
    int n_stages;
    const CzTable *curve;
    const double *trigger, *rate_factor, *installed_length;
    double efficiency, mass_per_stroke;
} CzDevice;

/* The common part of a tube or an anti-climber at an address. */
#define CZ_DEVICE(device)                                                                          \
    ((CzDevice){(device)->given, (device)->count, (device)->stages, (device)->n_stages,            \
                &(device)->curve, &(device)->trigger, &(device)->rate_factor,                      \
                &(device)->installed_length, (device)->efficiency, (device)->mass_per_stroke})

/* Usable stroke of a device; 0 when there is none [m]. */
double cz_device_stroke(CzDevice device);

/* Stroke of the crush zone of an end in front of the survival space [m]. */
double cz_free_stroke(const CzEnd *end);

/* Usable stroke [m]: the last point of a curve that is given, or the sum of the stages. NULL: there
 * is no curve. */
double cz_total_stroke(const CzStage *stage, int n_stage, const CzTable *curve);

/* Converts the strokes of a device's curve to those of its law: plastic ones of a tube or
 * anti-climber, total ones of an end. Other records are unchanged. */
void cz_bind_strokes(CzReader *reader, const CzRecord *record, const CzNode *node,
                     const CzTrail *trail, void *memory);

/* Whether the strokes of a curve were converted with this number, which then cannot vary. */
bool cz_strokes_depend_on(const CzInput *input, const double *field);

#endif
