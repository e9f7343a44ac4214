/* Force-stroke curves as start value and breakpoints, made from stages or from a table of points.
 *
 *   y(x) = start + sum of slope_change_i * max(x - at_i, 0)
 *
 * Strength of tubes and anti-climbers: plateaus from f_i to e_i (e_i = f_i when it is level) over
 * strokes s_i. A jump between two plateaus becomes a ramp of length r = min(5 mm, s / 10) of the
 * shorter one (ours), centred on the boundary: the energy of level plateaus is kept exactly, that
 * of sloping ones to r^2 / 8 times the difference of the slopes. A trigger peak T adds a triangle:
 * T at the start, falling to the curve over its length l, with energy (T - f_1) l / 2 of its own.
 *
 * Buffers and vehicle ends: straight lines through the forces at the ends of the stages.
 *
 * The last breakpoint is the one where the stroke is exhausted and the slope becomes the bottom
 * stiffness.
 */
#ifndef CZ_MODEL_BREAKPOINTS_H
#define CZ_MODEL_BREAKPOINTS_H

#include "model/state.h"
#include "problem/input.h"

enum { CZ_MAX_BREAKPOINTS = CZ_MAX_CURVE_POINTS + 2 };

typedef struct CzBreakpoints {
    int n;
    double start;                            /* value at 0 [N] */
    double usable;                           /* stroke at which it bottoms out [m] */
    double at[CZ_MAX_BREAKPOINTS];           /* [m] (n) */
    double slope_change[CZ_MAX_BREAKPOINTS]; /* [N/m] (n) */
} CzBreakpoints;

/* Number of breakpoints of a strength or a loading curve, for any values. */
int cz_breakpoints_in_strength(int n_stage, const CzTable *table);
int cz_breakpoints_in_loading(int n_stage, const CzTable *table);

/* Strength over the plastic stroke, from the table when it is given. `trigger` may be NaN. */
void cz_breakpoints_strength(CzBreakpoints *breakpoints, const CzStage *stage, int n_stage,
                             const CzTable *table, double trigger, double trigger_length,
                             double bottom_stiffness);

/* Loading curve from `first` at no stroke, from the table when it is given (without `first`). */
void cz_breakpoints_loading(CzBreakpoints *breakpoints, double first, const CzStage *stage,
                            int n_stage, const CzTable *table, double bottom_stiffness);

/* A plastic member that never crushes, and a spring of constant stiffness (CZ_NEVER: it never
 * deflects).
 */
void cz_breakpoints_rigid_member(CzBreakpoints *breakpoints);
void cz_breakpoints_spring(CzBreakpoints *breakpoints, double stiffness);

/* Multiplies all forces: `count` devices side by side. */
void cz_breakpoints_scale(CzBreakpoints *breakpoints, double count);

double cz_breakpoints_value(const CzBreakpoints *breakpoints, double x);

#endif
