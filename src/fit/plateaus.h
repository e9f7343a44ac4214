/* Plateaus of a plastic member, and lines of an end or a buffer: their number and strokes. */
#ifndef CZ_FIT_PLATEAUS_H
#define CZ_FIT_PLATEAUS_H

#include "fit/staged.h"

/* Best plateaus of a branch that begins at stroke 0, a trigger peak kept when there is one.
 * `n_stage` -1: as many as reduce the error enough. The length of a trigger is such that its fall
 * is softer than `stiffness`. False without memory. */
bool cz_fit_plateaus(CzArena *arena, const CzBranch *branch, int n_stage, double stiffness,
                     CzStaged *staged);

/* Requirements on lines that meet at the ends of stages. */
typedef struct CzLines {
    int n_stage;      /* -1: as many as reduce the error enough, at most n_most */
    int n_most;       /* at most 4 */
    bool has_preload; /* they start at a force that is also fitted, else at 0 */
    double shortest;  /* of a stage, as a share of the stroke */
} CzLines;

/* Best lines of a branch that begins at stroke 0. False without memory. */
bool cz_fit_lines(CzArena *arena, const CzBranch *branch, const CzLines *lines, CzStaged *staged);

/* Squared error of the best line over the first part of a branch, through zero or from a
 * preload. */
double cz_fit_left_by_line(const CzBranch *branch, double to);

/* Stroke with the least squares for one line before and plateaus after it (`n_stage`, -1: the most
 * that are used unless requested). False without memory. */
bool cz_fit_split(CzArena *arena, const CzBranch *branch, int n_stage, double *at);

#endif
