/* Rows of the verification: the expected value beside the computed one. The tests check the
 * tolerance of every row; the verification page prints them. */
#ifndef CZ_TESTS_PHYSICS_ROWS_H
#define CZ_TESTS_PHYSICS_ROWS_H

#include "support/check.h"

#include <stdbool.h>

typedef struct Row {
    char what[120];      /* quantity and circumstances */
    const char *unit;    /* of both values; "" for none */
    double expected;     /* expected */
    double computed;     /* by the program */
    double relative;     /* tolerance as a share of the expected value */
    double absolute;     /* tolerance in the unit */
    bool is_upper_bound; /* the expected value is the most that is allowed */
} Row;

enum { MAX_ROWS = 400 };

typedef struct Rows {
    int n;
    Row row[MAX_ROWS];
} Rows;

static inline Row *add_row(Rows *rows, const char *unit, double computed, double expected,
                           double relative, double absolute) {
    assert_true(rows->n < MAX_ROWS);
    Row *row = &rows->row[rows->n++];
    *row = (Row){.unit = unit,
                 .expected = expected,
                 .computed = computed,
                 .relative = relative,
                 .absolute = absolute};
    return row;
}

/* Adds a row whose quantity is a sentence with values, as printf makes it. */
#define ROW(rows, unit, computed, expected, relative, absolute, ...)                               \
    snprintf(add_row((rows), (unit), (computed), (expected), (relative), (absolute))->what,        \
             sizeof((Row *)NULL)->what, __VA_ARGS__)

/* Adds a row whose value may be anything up to a bound. */
#define ROW_UP_TO(rows, unit, computed, most, ...)                                                 \
    do {                                                                                           \
        Row *up_to = add_row((rows), (unit), (computed), (most), 0.0, 0.0);                        \
        up_to->is_upper_bound = true;                                                              \
        snprintf(up_to->what, sizeof up_to->what, __VA_ARGS__);                                    \
    } while (0)

static inline double row_allowed(const Row *row) {
    return row->absolute + row->relative * fabs(row->expected);
}

/* Whether a row is within its tolerance; NaN is not. */
static inline bool row_holds(const Row *row) {
    if (row->is_upper_bound)
        return row->computed <= row->expected;
    return fabs(row->computed - row->expected) <= row_allowed(row);
}

/* Fails with every row outside its tolerance. */
static inline void assert_rows(const Rows *rows) {
    const char *scale = getenv("CZ_TOL_SCALE");
    int n_wrong = 0;
    assert_true(rows->n > 0);
    for (int i = 0; i < rows->n; i++) {
        const Row *row = &rows->row[i];
        if (scale != NULL || !row_holds(row))
            print_error("%s: %.10g %s, expected %.10g, difference %.3g, allowed %.3g\n", row->what,
                        row->computed, row->unit, row->expected, row->computed - row->expected,
                        row_allowed(row));
        n_wrong += !row_holds(row);
    }
    assert_int_equal(n_wrong, 0);
}

/* Collects rows and checks them. */
static inline void assert_rows_of(void (*rows_of)(Rows *)) {
    static Rows rows; /* large */
    rows.n = 0;
    rows_of(&rows);
    assert_rows(&rows);
}

#endif
