/* Numbers as text, with a decimal point in every locale.
 *
 * One rule holds in tables, JSON, CSV and pages: a quantity below 1e-9 in its printed unit is a
 * rounding residue and prints as 0; zero has no sign. Typed numbers and error measures are never
 * rounded to 0.
 */
#ifndef CZ_REPORT_FIGURE_H
#define CZ_REPORT_FIGURE_H

#include <stdbool.h>

enum { CZ_FIGURE_SIZE = 48 }; /* for any number written here [byte] */

/* A quantity by this rule: the value itself, or 0. */
double cz_figure_quantity(double value);

/* Any other number: the value itself, 0 for minus zero. */
double cz_figure_exact(double value);

/* `digits` significant digits, as %.*g. Returns text, as the others do. */
const char *cz_figure_digits(char text[CZ_FIGURE_SIZE], int digits, double value);

/* `decimals` places after the point, as %.*f; numbers from 1e15 on as %.15g. */
const char *cz_figure_fixed(char text[CZ_FIGURE_SIZE], int decimals, double value);

/* Three to four digits: 3483, 21.5, 2.31; "-" when it is not finite. */
const char *cz_figure_plain(char text[CZ_FIGURE_SIZE], double value);

/* Share as a percentage: "56 %", "0.5 %"; ">999 %" and "<-999 %" beyond; "-" for NaN. */
const char *cz_figure_percent(char text[CZ_FIGURE_SIZE], double share);

/* A share with its sign: "+54 %", "-0.03 %"; a negative share never reads as zero. */
const char *cz_figure_margin(char text[CZ_FIGURE_SIZE], double share);

/* A change as a percentage with two digits, so that a change of one in a million is not "0 %";
 * ">999 %" beyond; "-" for NaN. */
const char *cz_figure_change(char text[CZ_FIGURE_SIZE], double change);

/* Marks a number that may belong to the time beyond model validity: "3483*"; "-" stays. */
const char *cz_figure_mark(char text[CZ_FIGURE_SIZE], bool beyond_validity);
/* The meaning of the mark, printed with the table or figure. */
#define CZ_FIGURE_MARK_MEANS "*: may be of later; totals are blank"
#define CZ_FIGURE_CAUTION "Override: a run went beyond model validity (" CZ_FIGURE_MARK_MEANS ")."

#endif
