/* Ranges: evenly spaced values that are written as from:to:n. */
#ifndef CZ_TEXT_RANGE_H
#define CZ_TEXT_RANGE_H

#include <stdbool.h>

enum { CZ_MAX_IN_RANGE = 500 };

/* The values include both ends. */
typedef struct CzRange {
    double from, to;
    int n; /* 2 to CZ_MAX_IN_RANGE */
} CzRange;

/* Reads a text such as "5:40:8"; false when it is not a range. */
bool cz_range_parse(const char *text, CzRange *range);

/* The index-th value. */
double cz_range_value(const CzRange *range, int index);

#endif
