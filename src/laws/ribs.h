/* Ribs of two anti-climber faces: how many hold, how well they mesh, how they shear off.
 *
 *   r        = d - p round(d / p)                     offset of the faces modulo the rib pitch p
 *   mesh     = clamp(2 - 4 |r| / p, 0, 1)             1 flank to flank, 0 tip to tip
 *   left     = clamp(1 - w / (p / 2), 0, 1)           w: what the ribs were sheared by
 *   capacity = meshed ribs x strength x mesh x left x engaged + mu N
 *   ready    = meshed ribs x strength x mesh x left + mu max(N, 100 kN)
 *
 * Ribs that meet within a quarter of a pitch of their valleys lock where they are; ribs that meet
 * tip to tip slide over each other, held by friction, until the next valley takes them. A rib is
 * gone once the faces have slipped by half a pitch against it (ours).
 *
 * Faces that just touch, or just part, carry next to nothing, and that little depends on the moment
 * at which one looks. What they have left is therefore counted from `ready`: what the same ribs
 * hold once they are wholly in each other and pressed by a force that can lift a car at all (ours).
 */
#ifndef CZ_LAWS_RIBS_H
#define CZ_LAWS_RIBS_H

#include "laws/law.h"

typedef struct {
    double pitch;    /* p [m] */
    double overlap;  /* of level faces [m] */
    double depth;    /* closure over which ribs engage [m] */
    double strength; /* of all ribs of level faces [N] */
    double friction; /* mu */
} CzRibsLaw;

typedef struct {
    double capacity; /* [N] */
    double ready;    /* capacity of the ribs in full engagement [N] */
    double engaged;  /* share of the ribs' depth, and of the smallest normal force [-] */
    double mesh;     /* [-] */
} CzRibsResponse;

/* Normal force at which ribs are fully engaged [N] (ours). */
#define CZ_GRIP_FORCE 1e4
/* Smallest normal force that the friction of faces in full engagement counts with [N] (ours). */
#define CZ_READY_FORCE 1e5

/* Nearest whole number, halves to the even one: the sum leaves no room for a fraction. */
static inline double cz_nearest_whole(double value) {
    const double no_fraction = 6755399441055744.0; /* 1.5 x 2^52 */
    return (value + no_fraction) - no_fraction;
}

/* `slip` is the offset of the faces, `closure` how far they are in each other, `normal` the force
 * between them, `sheared` how far they have slipped against meshed ribs. */
static inline CzRibsResponse cz_ribs(const CzRibsLaw *law, double slip, double closure,
                                     double normal, double sheared) {
    const double pitches = slip / law->pitch;
    const double off = fabs(pitches - cz_nearest_whole(pitches));
    const double left = cz_clamp(1.0 - 2.0 * sheared / law->pitch, 0.0, 1.0);
    const double remaining = cz_clamp((law->overlap - fabs(slip)) / law->overlap, 0.0, 1.0);
    CzRibsResponse response;
    response.engaged = cz_clamp(closure / law->depth, 0.0, 1.0) *
                       cz_clamp(normal * (1.0 / CZ_GRIP_FORCE), 0.0, 1.0);
    response.mesh = cz_clamp(2.0 - 4.0 * off, 0.0, 1.0);
    const double ribs = remaining * response.mesh * left * law->strength;
    response.capacity = ribs * response.engaged + law->friction * normal;
    response.ready = ribs + law->friction * cz_larger(normal, CZ_READY_FORCE);
    return response;
}

#endif
