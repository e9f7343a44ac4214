/* Sobol points in Gray-code order, with a digital shift. */
#include "statistics/sobol.h"

#include "statistics/random.h"

enum { N_DIGIT = 32, HIGHEST_DEGREE = 11 };

/* A dimension after the first: its primitive polynomial over two elements, without the first and
 * the last coefficient, and the first direction numbers, as many as its degree. */
typedef struct Dimension {
    int degree;
    uint32_t coefficients;
    uint32_t first[HIGHEST_DEGREE];
} Dimension;

static const Dimension dimensions[] = {
#define CZ_SOBOL(degree, coefficients, ...) {degree, coefficients, {__VA_ARGS__}},
#include "statistics/sobol.def"
#undef CZ_SOBOL
};
_Static_assert(sizeof dimensions / sizeof *dimensions == CZ_SOBOL_MAX_DRAWS - 1,
               "the list has all dimensions but the first");

/* The k-th direction number is m_k / 2^k; the further m_k follow from the polynomial. */
static void set_directions(int draw, uint32_t direction[N_DIGIT]) {
    if (draw == 0) {
        for (int k = 0; k < N_DIGIT; k++)
            direction[k] = UINT32_C(1) << (N_DIGIT - 1 - k);
        return;
    }
    const Dimension *dimension = &dimensions[draw - 1];
    const int degree = dimension->degree;
    for (int k = 0; k < N_DIGIT; k++) {
        if (k < degree) {
            direction[k] = dimension->first[k] << (N_DIGIT - 1 - k);
            continue;
        }
        direction[k] = direction[k - degree] ^ direction[k - degree] >> degree;
        for (int i = 1; i < degree; i++)
            if ((dimension->coefficients >> (degree - 1 - i) & 1) != 0)
                direction[k] ^= direction[k - i];
    }
}

static uint32_t digits_of(const uint32_t direction[N_DIGIT], uint32_t point) {
    const uint32_t gray = point ^ point >> 1;
    uint32_t digits = 0;
    for (int k = 0; k < N_DIGIT; k++)
        if ((gray >> k & 1) != 0)
            digits ^= direction[k];
    return digits;
}

uint32_t cz_sobol_digits(int draw, uint32_t point) {
    uint32_t direction[N_DIGIT];
    set_directions(draw, direction);
    return digits_of(direction, point);
}

void cz_sobol_draw(uint64_t seed, int draw, int n, double *u) {
    uint32_t direction[N_DIGIT];
    set_directions(draw, direction);
    const uint32_t shift = cz_random_bits(seed, CZ_RANDOM_SHIFT, draw, 0);
    for (int i = 0; i < n; i++)
        u[i] = ((double)(digits_of(direction, (uint32_t)i) ^ shift) + 0.5) * 0x1p-32;
}
