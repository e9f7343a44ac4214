/* One block of the track's modes: the waves that agree at the seats. */
#ifndef CZ_MODEL_TRACK_BLOCK_H
#define CZ_MODEL_TRACK_BLOCK_H

#include "model/rail.h"

enum {
    CZ_BLOCK_WAVES = 4,                     /* rail waves with a dynamic bending branch */
    CZ_BLOCK_ROOTS = 2 * CZ_BLOCK_WAVES + 5 /* with pad, sleeper and ballast */
};

typedef struct CzTrackBlock {
    const CzSeats *seats;
    double turns;  /* phase from one seat to the next */
    double crests; /* n_j: sum over the seats of the squared sleeper wave */
    int n_wave;
    CzRailWave wave[CZ_BLOCK_WAVES]; /* direct, alias, and beyond */
    double mass[CZ_BLOCK_WAVES];     /* M_k: of a wave of unit crest [kg] */
    double rest;                     /* R [m/N] */
} CzTrackBlock;

/* The cosine copy's block j of a ring; the sine copy's is the same, and has none for j = 0 and j =
 * n_seat / 2. */
CzTrackBlock cz_track_block(const CzSeats *seats, int n_seat, int j);

/* F(s) and its slope. */
typedef struct CzSecular {
    CzComplex value, slope;
    CzComplex degrees; /* slope over value of the polynomial that has the roots of F */
} CzSecular;
CzSecular cz_track_secular(const CzTrackBlock *block, CzComplex s);

/* Deflections of sleeper and ballast block under a force on the sleeper at rate s [m/N]: B, and
 * that of the ballast. */
typedef struct CzTrackBelow {
    CzComplex sleeper, ballast;
} CzTrackBelow;
CzTrackBelow cz_track_below(const CzTrackBlock *block, CzComplex s);

/* h_k(s). */
CzComplex cz_track_wave_answer(const CzTrackBlock *block, int wave, CzComplex s);

/* All roots of F; returns their number. */
int cz_track_roots(const CzTrackBlock *block, CzComplex root[CZ_BLOCK_ROOTS]);

#endif
