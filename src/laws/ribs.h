/* Ribs of two anti-climber faces: number in contact, meshing, shearing off.
 *
 *   r        = d - p round(d / p)                     offset of the faces modulo the rib pitch p
 *   mesh     = clamp(2 - 4 |r| / p, 0, 1)             1 flank to flank, 0 tip to tip
 *   left     = clamp(1 - w / (p / 2), 0, 1)           w: slip against meshed ribs
 *   capacity = meshed ribs x strength x mesh x left x engaged + mu N
 *   ready    = meshed ribs x strength x mesh x left + mu max(N, 100 kN)
 *
 * Ribs that meet within a quarter of a pitch of their valleys lock where they are; ribs that meet
 * tip to tip slide over each other, held by friction, until they reach the next valley. A rib is
 * sheared off once the faces have slipped by half a pitch against it (ours).
 *
 * Faces that just touch, or just part, carry almost no force, which depends on the time step. The
 * residual capacity is therefore taken from `ready`: the capacity of the same ribs at full depth
 * under a normal force that is large enough to lift a car (ours).
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
/* Smallest normal force for the friction of fully engaged faces [N] (ours). */
#define CZ_READY_FORCE 1e5

/* Nearest whole number, halves to the even one: the sum has no bits for a fraction. */
static inline double cz_nearest_integer(double value) {
    const double no_fraction = 6755399441055744.0; /* 1.5 x 2^52 */
    return (value + no_fraction) - no_fraction;
}

/* `slip` is the offset of the faces, `closure` their penetration, `normal` the force between them,
 * `sheared` their slip against meshed ribs. */
static inline CzRibsResponse cz_ribs(const CzRibsLaw *law, double slip, double closure,
                                     double normal, double sheared) {
    const double pitches = slip / law->pitch;
    const double off = fabs(pitches - cz_nearest_integer(pitches));
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
