/* Values in increments: the multiples of a step. */
#ifndef CZ_BASE_INCREMENT_H
#define CZ_BASE_INCREMENT_H

/* The largest multiple of a step (above 0) that is not above a value, and the smallest that is not
 * below it. A value that differs from a multiple in its last bits only counts as one. */
double cz_increment_not_above(double step, double value);
double cz_increment_not_below(double step, double value);

/* Number of multiples of a step between two bounds; 2 stands for two or more. */
int cz_increment_count(double step, double min, double max);

#endif
