/* The share of a population, from a sample: Wilson's interval.
 *
 *   (p + z^2 / 2n +- z sqrt(p (1 - p) / n + z^2 / 4n^2)) / (1 + z^2 / n),   p = k / n
 *
 * of E. B. Wilson, J. Am. Stat. Assoc. 22 (1927); for 95 %, z = 1.96. It holds for few samples and
 * shares near 0 and 1 too. For a stratified sample it is wider than needed.
 */
#ifndef CZ_STATISTICS_SHARE_H
#define CZ_STATISTICS_SHARE_H

/* The interval that covers the share in 95 of 100 samples, when k of n have the property; 0 to 1
 * for n = 0. */
void cz_share_interval(int k, int n, double *low, double *high);

#endif
