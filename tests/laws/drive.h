/* Driving a law by its shortening: an element is a law with its parameters, memory and last force.
 */
#ifndef CZ_TESTS_LAWS_DRIVE_H
#define CZ_TESTS_LAWS_DRIVE_H

#include <stdint.h>

/* Curve through points, the first slope and the last one carried on; for backbones and loading
 * curves. */
typedef struct {
    int n_point;
    double x[8], y[8];
    double stop; /* slope beyond the last point [N/m] */
} Backbone;

static inline double backbone_slope(const Backbone *backbone, double x) {
    if (x < backbone->x[0])
        return 0.0;
    for (int i = 1; i < backbone->n_point; i++) {
        if (x < backbone->x[i])
            return (backbone->y[i] - backbone->y[i - 1]) / (backbone->x[i] - backbone->x[i - 1]);
    }
    return backbone->stop;
}

static inline double backbone_value(const Backbone *backbone, double x) {
    const int last = backbone->n_point - 1;
    if (x < backbone->x[0])
        return backbone->y[0];
    for (int i = 1; i <= last; i++) {
        if (x < backbone->x[i])
            return backbone->y[i] - backbone_slope(backbone, x) * (backbone->x[i] - x);
    }
    return backbone->y[last] + backbone->stop * (x - backbone->x[last]);
}

/* Numbers in [0, 1) that are the same everywhere. */
static inline double next_random(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

typedef struct Element Element;
struct Element {
    double (*force)(Element *element, double x); /* moves to x, commits the memory [N] */
    const void *law;
    const Backbone *backbone;
    double memory[2];
    double x; /* [m] */
    double f; /* [N] */
};

/* Moves the element to x in small steps and returns the work done on it [J]. */
static inline double drive(Element *element, double x, double step) {
    const double start = element->x;
    const double travel = x - start;
    const int n = 1 + (int)((travel < 0 ? -travel : travel) / step);
    double work = 0.0;
    for (int i = 1; i <= n; i++) {
        const double last_x = element->x, last_f = element->f;
        element->x = i == n ? x : start + travel * i / n;
        element->f = element->force(element, element->x);
        work += 0.5 * (last_f + element->f) * (element->x - last_x);
    }
    return work;
}

/* Energy that the element returns while it unloads to zero force [J]; the element is not changed.
 */
static inline double recoverable(const Element *element, double step) {
    Element copy = *element;
    double work = 0.0;
    const double direction = copy.f > 0 ? -1.0 : 1.0;
    for (int i = 0; i < 1000000 && copy.f * direction < 0; i++)
        work -= drive(&copy, copy.x + direction * step, step);
    return work;
}

#endif
