/* Rank correlation of Spearman: how far one quantity rises whenever another one does, from -1 to 1,
 * whatever the form of the curve. It is Pearson's correlation of the ranks; equal values share the
 * mean of their ranks. */
#ifndef CZ_STATISTICS_RANK_H
#define CZ_STATISTICS_RANK_H

#include <stdbool.h>

/* Ranks from 1 of n numbers, none of which is NaN. False without memory. */
bool cz_rank(int n, const double *value, double *rank);

/* Correlation of two sets of ranks; NaN when all ranks of one are equal. */
double cz_rank_correlation(int n, const double *x_rank, const double *y_rank);

#endif
