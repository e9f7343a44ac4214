/* Optimality computed from the formulas, independently of the optimiser.
 *
 *   stationarity: gradient f + sum over active constraints and bounds of multiplier * gradient = 0,
 *   multipliers not negative
 *
 * found by projected gradient descent on |residual|^2 over the multipliers.
 */
#ifndef CZ_TESTS_KKT_H
#define CZ_TESTS_KKT_H

#include "optimise/analytic.h"

/* Central difference of objective (constraint -1) or of a constraint. */
static inline double slope(const Analytic *analytic, const double *x, int constraint,
                           int variable) {
    const double h = 1e-6;
    double value[2];
    for (int side = 0; side < 2; side++) {
        double moved[MAX_VARIABLES], c[MAX_CONSTRAINTS] = {0};
        memcpy(moved, x, sizeof(double) * (size_t)analytic->n_variable);
        moved[variable] += side == 0 ? -h : h;
        const double f = analytic->formula(moved, c);
        value[side] = constraint < 0 ? f : c[constraint];
    }
    return (value[1] - value[0]) / (2 * h);
}

/* Residual of the stationarity condition, relative to the gradient of the objective; constraints
 * within `tolerance` of 0 are taken as active. */
static inline double kkt_residual(const Analytic *analytic, const double *x, double tolerance) {
    const int n = analytic->n_variable;
    double c[MAX_CONSTRAINTS] = {0}, row[MAX_CONSTRAINTS + 2 * MAX_VARIABLES][MAX_VARIABLES];
    double residual[MAX_VARIABLES], scale = 0,
                                    multiplier[MAX_CONSTRAINTS + 2 * MAX_VARIABLES] = {0};
    int n_row = 0;
    analytic->formula(x, c);
    for (int j = 0; j < analytic->n_constraint; j++)
        if (c[j] > -tolerance) {
            for (int i = 0; i < n; i++)
                row[n_row][i] = slope(analytic, x, j, i);
            n_row++;
        }
    for (int i = 0; i < n; i++)
        for (int side = 0; side < 2; side++)
            if (fabs(x[i] - (side == 0 ? analytic->min[i] : analytic->max[i])) < tolerance) {
                memset(row[n_row], 0, sizeof row[n_row]);
                row[n_row++][i] = side == 0 ? -1 : 1;
            }
    for (int i = 0; i < n; i++)
        scale = fmax(scale, fabs(residual[i] = slope(analytic, x, -1, i)));
    for (int sweep = 0; sweep < 20000; sweep++)
        for (int k = 0; k < n_row; k++) { /* coordinate descent on each multiplier */
            double along = 0, square = 0;
            for (int i = 0; i < n; i++) {
                along += row[k][i] * residual[i];
                square += row[k][i] * row[k][i];
            }
            const double better = fmax(multiplier[k] - along / square, 0);
            for (int i = 0; i < n; i++)
                residual[i] += (better - multiplier[k]) * row[k][i];
            multiplier[k] = better;
        }
    double worst = 0;
    for (int i = 0; i < n; i++)
        worst = fmax(worst, fabs(residual[i]));
    return worst / fmax(scale, 1e-12);
}

#endif
