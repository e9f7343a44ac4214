/* Distributions over a range: a number u within (0, 1), evenly distributed, becomes a value between
 * `low` and `high`. The bytes of every value are the same on every machine.
 *
 *   uniform     every value alike
 *   normal      about the middle, the ends at three standard deviations, and cut there
 *   triangular  most likely in the middle, falling linearly to the ends
 *   lognormal   the logarithm is normal as above, so that the median is sqrt(low high); low above 0
 */
#ifndef CZ_STATISTICS_DISTRIBUTION_H
#define CZ_STATISTICS_DISTRIBUTION_H

double cz_uniform_value(double u, double low, double high);
double cz_normal_value(double u, double low, double high);
double cz_triangular_value(double u, double low, double high);
double cz_lognormal_value(double u, double low, double high);

/* Index of one of n equally likely items. */
int cz_discrete_index(double u, int n);

/* The standard normal variable that is cut at three standard deviations: from -3 to 3. */
double cz_truncated_normal(double u);

#endif
