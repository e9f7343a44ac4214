/* Force-stroke curves as start value and breakpoints: from plateaus, stage ends and tables. */
#include "model/kinks.h"

#define LONGEST_RAMP 5e-3 /* between two plateaus [m] (ours) */
#define RAMP_SHARE 0.1    /* of the shorter of the two (ours) */

int cz_kinks_in_strength(int n_stage, const CzTable *table) {
    return table->given ? table->n_point + 2 : 2 * n_stage + 1;
}

int cz_kinks_in_loading(int n_stage, const CzTable *table) {
    return table->given ? table->n_point : n_stage + 1;
}

/* Adds a breakpoint in order of stroke: a trigger may end within the ramp to the next plateau. */
static void add(CzKinks *kinks, double at, double slope_change) {
    int k = kinks->n++;
    for (; k > 0 && kinks->at[k - 1] > at; k--) {
        kinks->at[k] = kinks->at[k - 1];
        kinks->slope_change[k] = kinks->slope_change[k - 1];
    }
    kinks->at[k] = at;
    kinks->slope_change[k] = slope_change;
}

/* Straight lines through the points of a table; constant before the first. */
static void add_points(CzKinks *kinks, const CzTable *table, double bottom_stiffness) {
    double slope = 0.0;
    for (int i = 0; i + 1 < table->n_point; i++) {
        const double next = (table->y[i + 1] - table->y[i]) / (table->x[i + 1] - table->x[i]);
        add(kinks, table->x[i], next - slope);
        slope = next;
    }
    kinks->usable = table->x[table->n_point - 1];
    add(kinks, kinks->usable, bottom_stiffness - slope);
}

static double end_force(const CzStage *stage) {
    return isnan(stage->end_force) ? stage->force : stage->end_force;
}

static double plateau_slope(const CzStage *stage) {
    return (end_force(stage) - stage->force) / stage->stroke;
}

/* Ramp from one plateau to the next, centred on their boundary. */
static void add_ramp(CzKinks *kinks, const CzStage *stage, double boundary) {
    const double shorter = fmin(stage[0].stroke, stage[1].stroke);
    const double ramp = fmin(LONGEST_RAMP, RAMP_SHARE * shorter);
    const double before = plateau_slope(&stage[0]), after = plateau_slope(&stage[1]);
    const double first = end_force(&stage[0]) - before * ramp / 2.0;
    const double last = stage[1].force + after * ramp / 2.0;
    const double slope = (last - first) / ramp;
    add(kinks, boundary - ramp / 2.0, slope - before);
    add(kinks, boundary + ramp / 2.0, after - slope);
}

static void add_plateaus(CzKinks *kinks, const CzStage *stage, int n_stage,
                         double bottom_stiffness) {
    double stroke = stage[0].stroke;
    for (int i = 0; i + 1 < n_stage; i++) {
        add_ramp(kinks, &stage[i], stroke);
        stroke += stage[i + 1].stroke;
    }
    kinks->usable = stroke;
    add(kinks, stroke, bottom_stiffness - plateau_slope(&stage[n_stage - 1]));
}

void cz_kinks_strength(CzKinks *kinks, const CzStage *stage, int n_stage, const CzTable *table,
                       double trigger, double trigger_length, double bottom_stiffness) {
    const double first = table->given ? table->y[0] : stage[0].force;
    const double first_slope = table->given ? 0.0 : plateau_slope(&stage[0]);
    const double peak = isnan(trigger) ? 0.0 : trigger - first;
    kinks->n = 0;
    kinks->start = first + peak;
    add(kinks, 0.0, first_slope - peak / trigger_length);
    add(kinks, trigger_length, peak / trigger_length);
    if (table->given)
        add_points(kinks, table, bottom_stiffness);
    else
        add_plateaus(kinks, stage, n_stage, bottom_stiffness);
}

void cz_kinks_loading(CzKinks *kinks, double first, const CzStage *stage, int n_stage,
                      const CzTable *table, double bottom_stiffness) {
    kinks->n = 0;
    kinks->start = first;
    if (table->given) {
        kinks->start = table->y[0];
        add_points(kinks, table, bottom_stiffness);
        return;
    }
    double force = first, slope = 0.0, stroke = 0.0;
    for (int i = 0; i < n_stage; i++) {
        const double next = (stage[i].force - force) / stage[i].stroke;
        add(kinks, stroke, next - slope);
        slope = next;
        force = stage[i].force;
        stroke += stage[i].stroke;
    }
    kinks->usable = stroke;
    add(kinks, stroke, bottom_stiffness - slope);
}

void cz_kinks_rigid_member(CzKinks *kinks) {
    kinks->n = 0;
    kinks->start = CZ_NEVER;
    kinks->usable = CZ_NEVER;
}

void cz_kinks_spring(CzKinks *kinks, double stiffness) {
    kinks->n = 0;
    kinks->start = 0.0;
    kinks->usable = CZ_NEVER;
    add(kinks, 0.0, stiffness);
}

void cz_kinks_scale(CzKinks *kinks, double count) {
    kinks->start *= count;
    for (int i = 0; i < kinks->n; i++)
        kinks->slope_change[i] *= count;
}

double cz_kinks_value(const CzKinks *kinks, double x) {
    double value = kinks->start;
    for (int i = 0; i < kinks->n; i++)
        value += kinks->slope_change[i] * fmax(x - kinks->at[i], 0.0);
    return value;
}
