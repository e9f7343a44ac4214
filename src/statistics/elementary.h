/* Logarithm and exponential whose last bit is the same on every machine: additions,
 * multiplications, divisions and exact scalings only. Mathematics libraries differ in it, and the
 * values of a sample are compared byte by byte. */
#ifndef CZ_STATISTICS_ELEMENTARY_H
#define CZ_STATISTICS_ELEMENTARY_H

/* Natural logarithm of a finite number above 0; relative error below 1e-15. */
double cz_logarithm(double x);

/* e^x for |x| up to 700; relative error below 1e-15. */
double cz_exponential(double x);

#endif
