/* Aberth's method. */
#include "base/roots.h"

enum { MAX_SWEEPS = 200 };
#define LAST_MOVE 1e-15 /* of a root's size: largest move of the last sweep */

void cz_find_roots(CzLogarithmicSlope *slope, const void *polynomial, int n, CzComplex *root) {
    for (int sweep = 0; sweep < MAX_SWEEPS; sweep++) {
        double move = 0.0;
        for (int i = 0; i < n; i++) {
            CzComplex pull = slope(polynomial, root[i]);
            for (int m = 0; m < n; m++)
                if (m != i)
                    pull = cz_complex_difference(
                        pull, cz_complex_inverse(cz_complex_difference(root[i], root[m])));
            const CzComplex correction = cz_complex_inverse(pull);
            if (!(cz_complex_square_size(correction) < 1e300)) /* at a root P'/P is infinite */
                continue;
            root[i] = cz_complex_difference(root[i], correction);
            move = fmax(move, cz_complex_size(correction) / cz_complex_size(root[i]));
        }
        if (move < LAST_MOVE)
            return;
    }
}
