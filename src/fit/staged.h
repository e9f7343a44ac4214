/* A staged curve of the problem file, fitted to a branch.
 *
 *   g(x) = fixed(x) + sum over i of c_i phi_i(x)
 *
 * is the curve that the model builds from stages (model/breakpoints.h): phi_i is the curve whose
 * i-th force is 1 N and whose other forces are 0. Given the strokes of the stages, the forces c
 * that minimise
 *
 *   integral of (f(x) - g(x))^2 dx     under     integral of g(x) dx = energy
 *
 * are the least squares of a small linear system with lower bounds. The strokes are found by
 * searches over that minimum.
 */
#ifndef CZ_FIT_STAGED_H
#define CZ_FIT_STAGED_H

#include "fit/branch.h"
#include "model/breakpoints.h"

#define CZ_LONGEST_TRIGGER 0.2 /* trigger_length of the problem file [m] */
#define CZ_SHORTEST_STAGE 1e-4 /* stroke of a stage there [m] */

typedef struct CzStaged {
    bool is_strength; /* plateaus of a plastic member; else lines through the stages' ends */
    bool has_preload; /* lines start at a preload that is also fitted */
    int n_stage;
    CzStage stage[CZ_MAX_STAGES]; /* stroke and force; other members are not used */
    double preload;               /* [N] */
    double trigger;               /* [N]; NaN if none */
    double trigger_length;        /* [m] */
    double bottom_stiffness;      /* [N/m] */
} CzStaged;

/* Plateaus or lines without stages. */
CzStaged cz_staged_begin(bool is_strength);

/* The curve as the model builds it. */
void cz_staged_breakpoints(const CzStaged *staged, CzBreakpoints *breakpoints);

double cz_staged_stroke(const CzStaged *staged);

/* Energy over the whole stroke [J]. */
double cz_staged_energy(const CzStaged *staged);

/* Strokes of the curve's breakpoints, from 0 to its end, rising; returns how many. */
enum { CZ_MAX_STAGED_BREAKPOINTS = 2 * CZ_MAX_STAGES + 4 };
int cz_staged_breakpoint_strokes(const CzStaged *staged, double at[CZ_MAX_STAGED_BREAKPOINTS]);

/* Finds the forces for given strokes, none below a thousandth of the mean force; without the
 * condition when `energy` is NaN. Returns the integral of the squared difference, INFINITY when no
 * such forces give the energy. */
double cz_staged_solve(CzStaged *staged, const CzBranch *branch, double energy);

/* Moves breaks between stages (and the length of a trigger) until the integral no longer falls. No
 * stage becomes shorter than `shortest`. Returns the integral. */
double cz_staged_refine(CzStaged *staged, const CzBranch *branch, double energy, double shortest);

/* Integral of the squared difference that counts as zero because of rounding. */
double cz_staged_rounding(const CzBranch *branch);

#endif
