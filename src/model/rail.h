/* A rail as a Timoshenko beam on discrete supports: numbers, free waves, static flexibility.
 *
 *   m z'' = k G A (z_xx - psi_x) + load      rho I psi'' = E I psi_xx + k G A (z_x - psi)
 *
 * A wave of wavenumber K is free of all others. Its two branches, bending and shear, have
 *
 *   w_b^2 w_s^2 = kGA EI K^4 / (m rho I)     w_b^2 + w_s^2 = kGA K^2 / m + (EI K^2 + kGA) / (rho I)
 *
 * and share the response of the deflection to a load: z = load / m [p / (s^2 + w_b^2) + (1 - p) /
 * (s^2 + w_s^2)]. At rest z = load [1 / (EI K^4) + 1 / (kGA K^2)].
 */
#ifndef CZ_MODEL_RAIL_H
#define CZ_MODEL_RAIL_H

#include "base/complex.h"
#include "problem/input.h"

/* The rail and its support at each seat. The numbers of a file are those of one rail; a wheelset is
 * on two rails, so those of the model are twice as large throughout, from the rail to the subgrade.
 */
typedef struct CzSeats {
    double bending;            /* E I [N m2] */
    double shear;              /* kappa G A [N] */
    double mass;               /* of the rail per length [kg/m] */
    double rotation;           /* rho I [kg m] */
    double spacing;            /* of the seats [m] */
    double pad_k, pad_c;       /* [N/m], [N s/m] */
    double sleeper;            /* [kg] */
    double upper_k, upper_c;   /* sleeper to ballast block */
    double ballast;            /* [kg] */
    double across_k, across_c; /* between neighbouring ballast blocks */
    double lower_k, lower_c;   /* ballast block to ground */
} CzSeats;

/* The numbers of n_rail rails side by side. */
CzSeats cz_seats(const CzRoadbed *roadbed, int n_rail);

/* A free wave of the rail. */
typedef struct CzRailWave {
    double wavenumber;     /* K [1/m] */
    double bending, shear; /* w_b^2, w_s^2 [1/s2] */
    double share;          /* p: share of the bending branch in the deflection under a load */
} CzRailWave;
CzRailWave cz_rail_wave(const CzSeats *seats, double wavenumber);

/* Flexibility of a seat for a static wave with a phase of `turns` from one seat to the next: pad,
 * ballast and subgrade in series [m/N]. */
double cz_seat_flexibility(const CzSeats *seats, double turns);

/* Static flexibility of rail waves that agree at the seats up to a phase of `turns` from one seat
 * to the next, summed over all of them: deflection per force per seat [m/N], a share `place` of the
 * spacing past the seat. For turns = 0 the uniform wave, which no bending stiffness supports, is
 * left out. */
CzComplex cz_rail_flexibility(const CzSeats *seats, double turns, double place);

/* Static deflection per force under a force on a ring of n_seat seats [m/N]. */
double cz_ring_flexibility(const CzSeats *seats, int n_seat, double place);

/* Share of that force carried by the seat n seats away [-]. */
double cz_ring_seat_share(const CzSeats *seats, int n_seat, double place, int seat);

#endif
