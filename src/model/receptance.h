/* The receptance of the track under a bogie: deflection under its two wheels per force, as a sum of
 * few damped modes that move with the bogie.
 *
 * Averaged over the place in a bay, the track does not couple the mean deflection of two wheels
 * (bounce) with half their difference (pitch). The receptance of each, a sum over the modes of the
 * track, is fitted by few modes,
 *
 *   G(s) = sum of g^2 / (s - lambda)
 *
 * by vector fitting: with given poles, the residues of G sigma and of sigma follow from linear
 * least squares over frequencies, and the zeros of sigma are better poles. Poles are mirrored to
 * the stable side, and a real mode is added where the fit would supply energy. Undamped waves with
 * their nodes at the seats are left out. The static deflection is that of the track at every place
 * in a bay, by the flexibility added to the modes.
 */
#ifndef CZ_MODEL_RECEPTANCE_H
#define CZ_MODEL_RECEPTANCE_H

#include "model/track.h"

/* Motions of the two wheels of a bogie. */
typedef enum CzPairMotion { CZ_PAIR_BOUNCE, CZ_PAIR_PITCH, CZ_N_PAIR_MOTION } CzPairMotion;

/* The damped modes of a track in bounce or pitch of two wheels: receptance = sum of square / (s -
 * lambda) and of its conjugate, halved. */
typedef struct CzTrackSpectrum {
    int n;
    CzComplex *lambda;                   /* [1/s] (n) */
    CzComplex *square[CZ_N_PAIR_MOTION]; /* g^2, the mean over a bay [1/(kg s)] (n) */
} CzTrackSpectrum;

/* Fills the spectrum; the arena owns it. False when there is no memory. */
bool cz_track_spectrum(const CzTrackModes *modes, double axle_spacing, CzArena *arena,
                       CzTrackSpectrum *spectrum);

/* Deflection of both wheels in bounce or pitch per force on each, without the additional
 * flexibility [m/N]. */
CzComplex cz_track_receptance(const CzTrackSpectrum *spectrum, CzPairMotion motion, CzComplex s);

enum { CZ_MAX_PAIR_MODES = 40 };

/* deflection = real part of g y, y' = lambda y + g force. One of a pair is stored; a real lambda
 * has a g that is real or imaginary. */
typedef struct CzPairMode {
    CzComplex lambda; /* [1/s] */
    CzComplex g;      /* [1/sqrt(kg s)] */
} CzPairMode;

typedef struct CzReceptance {
    double axle_spacing; /* of the bogie [m] */
    struct CzPairModes {
        int n;
        CzPairMode mode[CZ_MAX_PAIR_MODES];
        double error;    /* largest over the samples, relative to the largest receptance */
        double *storage; /* H: x' H x of the real and imaginary parts of the modes' y in turn is the
                            energy per wheel that they can still return (2 n x 2 n) */
    } motion[CZ_N_PAIR_MOTION];
} CzReceptance;

/* Fits the receptance of a track under bogies of one axle spacing; the arena owns the storage.
 * Statuses: CZ_OK, CZ_STATUS_INPUT when no fit is accurate enough, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_receptance_fit(const CzTrackModes *modes, double axle_spacing,
                                         CzArena *arena, CzReceptance *receptance, CzError *error);
CzComplex cz_fitted_receptance(const CzReceptance *receptance, CzPairMotion motion, CzComplex s);

/* Flexibility under each wheel in addition to the fitted modes, so that a wheel at rest has the
 * static deflection of the track; `step` as in track.h. */
CzTrackFlexibility cz_receptance_flexibility(const CzTrackModes *modes,
                                             const CzReceptance *receptance, double step);

#endif
