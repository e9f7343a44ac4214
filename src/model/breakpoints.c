/* Force-stroke curves as start value and breakpoints: from plateaus, stage ends and tables. */
#include "model/breakpoints.h"

#define LONGEST_RAMP 5e-3 /* between two plateaus [m] (ours) */
#define RAMP_SHARE 0.1    /* of the shorter of the two (ours) */

int cz_breakpoints_in_strength(int n_stage, const CzTable *table) {
    return table->given ? table->n_point + 2 : 2 * n_stage + 1;
}

int cz_breakpoints_in_loading(int n_stage, const CzTable *table) {
    return table->given ? table->n_point : n_stage + 1;
}

/* Adds a breakpoint in order of stroke: a trigger may end within the ramp to the next plateau. */
static void add(CzBreakpoints *breakpoints, double at, double slope_change) {
    int k = breakpoints->n++;
    for (; k > 0 && breakpoints->at[k - 1] > at; k--) {
        breakpoints->at[k] = breakpoints->at[k - 1];
        breakpoints->slope_change[k] = breakpoints->slope_change[k - 1];
    }
    breakpoints->at[k] = at;
    breakpoints->slope_change[k] = slope_change;
}

/* Straight lines through the points of a table; constant before the first. */
static void add_points(CzBreakpoints *breakpoints, const CzTable *table, double bottom_stiffness) {
    double slope = 0.0;
    for (int i = 0; i + 1 < table->n_point; i++) {
        const double next = (table->y[i + 1] - table->y[i]) / (table->x[i + 1] - table->x[i]);
        add(breakpoints, table->x[i], next - slope);
        slope = next;
    }
    breakpoints->usable = table->x[table->n_point - 1];
    add(breakpoints, breakpoints->usable, bottom_stiffness - slope);
}

static double end_force(const CzStage *stage) {
    return isnan(stage->end_force) ? stage->force : stage->end_force;
}

static double plateau_slope(const CzStage *stage) {
    return (end_force(stage) - stage->force) / stage->stroke;
}

/* Ramp from one plateau to the next, centred on their boundary. */
static void add_ramp(CzBreakpoints *breakpoints, const CzStage *stage, double boundary) {
    const double shorter = fmin(stage[0].stroke, stage[1].stroke);
    const double ramp = fmin(LONGEST_RAMP, RAMP_SHARE * shorter);
    const double before = plateau_slope(&stage[0]), after = plateau_slope(&stage[1]);
    const double first = end_force(&stage[0]) - before * ramp / 2.0;
    const double last = stage[1].force + after * ramp / 2.0;
    const double slope = (last - first) / ramp;
    add(breakpoints, boundary - ramp / 2.0, slope - before);
    add(breakpoints, boundary + ramp / 2.0, after - slope);
}

static void add_plateaus(CzBreakpoints *breakpoints, const CzStage *stage, int n_stage,
                         double bottom_stiffness) {
    double stroke = stage[0].stroke;
    for (int i = 0; i + 1 < n_stage; i++) {
        add_ramp(breakpoints, &stage[i], stroke);
        stroke += stage[i + 1].stroke;
    }
    breakpoints->usable = stroke;
    add(breakpoints, stroke, bottom_stiffness - plateau_slope(&stage[n_stage - 1]));
}

void cz_breakpoints_strength(CzBreakpoints *breakpoints, const CzStage *stage, int n_stage,
                             const CzTable *table, double trigger, double trigger_length,
                             double bottom_stiffness) {
    const double first = table->given ? table->y[0] : stage[0].force;
    const double first_slope = table->given ? 0.0 : plateau_slope(&stage[0]);
    const double peak = isnan(trigger) ? 0.0 : trigger - first;
    breakpoints->n = 0;
    breakpoints->start = first + peak;
    add(breakpoints, 0.0, first_slope - peak / trigger_length);
    add(breakpoints, trigger_length, peak / trigger_length);
    if (table->given)
        add_points(breakpoints, table, bottom_stiffness);
    else
        add_plateaus(breakpoints, stage, n_stage, bottom_stiffness);
}

void cz_breakpoints_loading(CzBreakpoints *breakpoints, double first, const CzStage *stage,
                            int n_stage, const CzTable *table, double bottom_stiffness) {
    breakpoints->n = 0;
    breakpoints->start = first;
    if (table->given) {
        breakpoints->start = table->y[0];
        add_points(breakpoints, table, bottom_stiffness);
        return;
    }
    double force = first, slope = 0.0, stroke = 0.0;
    for (int i = 0; i < n_stage; i++) {
        const double next = (stage[i].force - force) / stage[i].stroke;
        add(breakpoints, stroke, next - slope);
        slope = next;
        force = stage[i].force;
        stroke += stage[i].stroke;
    }
    breakpoints->usable = stroke;
    add(breakpoints, stroke, bottom_stiffness - slope);
}

void cz_breakpoints_rigid_member(CzBreakpoints *breakpoints) {
    breakpoints->n = 0;
    breakpoints->start = CZ_NEVER;
    breakpoints->usable = CZ_NEVER;
}

void cz_breakpoints_spring(CzBreakpoints *breakpoints, double stiffness) {
    breakpoints->n = 0;
    breakpoints->start = 0.0;
    breakpoints->usable = CZ_NEVER;
    add(breakpoints, 0.0, stiffness);
}

void cz_breakpoints_scale(CzBreakpoints *breakpoints, double count) {
    breakpoints->start *= count;
    for (int i = 0; i < breakpoints->n; i++)
        breakpoints->slope_change[i] *= count;
}

double cz_breakpoints_value(const CzBreakpoints *breakpoints, double x) {
    double value = breakpoints->start;
    for (int i = 0; i < breakpoints->n; i++)
        value += breakpoints->slope_change[i] * fmax(x - breakpoints->at[i], 0.0);
    return value;
}
