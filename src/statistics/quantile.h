/* Numbers that describe a set of values. */
#ifndef CZ_STATISTICS_QUANTILE_H
#define CZ_STATISTICS_QUANTILE_H

/* Sorts n numbers upwards; none is NaN. */
void cz_sort_numbers(int n, double *value);

/* The quantile of a share p of n sorted numbers: linear between the neighbours at (n - 1) p,
 * counted from 0 (definition 7 of Hyndman and Fan, The American Statistician 50, 1996, as in R).
 * Infinite numbers count by their order: the quantile is infinite when a neighbour that it needs
 * is. NaN for n = 0. */
double cz_quantile_of(int n, const double *sorted, double p);

/* Mean, and standard deviation of a sample (divisor n - 1); NaN when there are too few numbers. */
double cz_mean_of(int n, const double *value);
double cz_deviation_of(int n, const double *value);

#endif
