/* Ranges of evenly spaced values. */
#include "text/range.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"

bool cz_range_parse(const char *text, CzRange *range) {
    char part[2 * CZ_NUMBER_TEXT];
    const char *second = strchr(text, ':');
    const char *third = second != NULL ? strchr(second + 1, ':') : NULL;
    if (third == NULL || (size_t)(third - text) >= sizeof part)
        return false;
    snprintf(part, sizeof part, "%.*s", (int)(second - text), text);
    if (cz_number_parse(part, &range->from) != NULL)
        return false;
    snprintf(part, sizeof part, "%.*s", (int)(third - second - 1), second + 1);
    if (cz_number_parse(part, &range->to) != NULL)
        return false;
    char *end = NULL;
    const long n = strtol(third + 1, &end, 10);
    if (end == third + 1 || *end != '\0' || n < 2 || n > CZ_MAX_IN_RANGE)
        return false;
    range->n = (int)n;
    return true;
}

double cz_range_value(const CzRange *range, int index) {
    if (index == range->n - 1)
        return range->to;
    return range->from + (range->to - range->from) * index / (range->n - 1);
}
