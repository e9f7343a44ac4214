/* Blocks and their roots.
 *
 * P(s) = F(s) (k_p + s c_p) D(s) prod (s^2 + w_k^2), D the determinant of sleeper and ballast, is a
 * polynomial whose roots are those of F. Aberth's method moves all of them at once,
 *
 *   s_i <- s_i - 1 / (P'(s_i)/P(s_i) - sum over the others of 1 / (s_i - s_m))
 *
 * and P'/P is a sum over the factors, so no coefficient is formed.
 */
#include "model/track_block.h"

#include "base/roots.h"

CzTrackBlock cz_track_block(const CzSeats *seats, int n_seat, int j) {
    const int edge = j == 0 || 2 * j == n_seat;
    const double length = n_seat * seats->spacing;
    const int candidate[CZ_BLOCK_WAVES] = {j, n_seat - j, n_seat + j, 2 * n_seat - j};
    CzTrackBlock block = {
        .seats = seats, .turns = (double)j / n_seat, .crests = edge ? n_seat : 0.5 * n_seat};
    block.rest = cz_rail_flexibility(seats, block.turns, 0.0).re;
    for (int i = 0; i < CZ_BLOCK_WAVES; ++i) {
        const int k = candidate[i];
        if (i > 0 && (k == candidate[i - 1])) /* at an edge each wave counts twice */
            continue;
        const int w = block.n_wave++;
        block.wave[w] = cz_rail_wave(seats, 2.0 * CZ_PI * k / length);
        block.mass[w] = seats->mass * (k == 0 ? length : 0.5 * length);
        if (k > 0)
            block.rest -=
                block.crests * block.wave[w].share / (block.mass[w] * block.wave[w].bending);
    }
    return block;
}

static CzComplex square_of(CzComplex s) {
    return cz_complex_product(s, s);
}

static CzComplex plus(CzComplex a, double b) {
    return (CzComplex){a.re + b, a.im};
}

CzComplex cz_track_wave_answer(const CzTrackBlock *block, int wave, CzComplex s) {
    const CzComplex denominator = plus(square_of(s), block->wave[wave].bending);
    return cz_complex_scaled(block->wave[wave].share / block->mass[wave],
                             cz_complex_inverse(denominator));
}

/* Sleeper and ballast: B = numerator / determinant, with slopes. */
typedef struct Below {
    CzComplex numerator, numerator_slope, determinant, determinant_slope;
} Below;

static Below below_of(const CzTrackBlock *block, CzComplex s) {
    const CzSeats *seats = block->seats;
    const double half_step = cz_turned(0.5 * block->turns).im;
    const double coupled = 4.0 * half_step * half_step;
    const double k = seats->lower_k + coupled * seats->across_k;
    const double c = seats->lower_c + coupled * seats->across_c;
    const CzComplex upper = plus(cz_complex_scaled(seats->upper_c, s), seats->upper_k);
    const CzComplex lower = plus(cz_complex_scaled(c, s), k), s2 = square_of(s);
    const CzComplex top = cz_complex_sum(cz_complex_scaled(seats->sleeper, s2), upper);
    const CzComplex bottom =
        cz_complex_sum(cz_complex_sum(cz_complex_scaled(seats->ballast, s2), upper), lower);
    const CzComplex top_slope = plus(cz_complex_scaled(2.0 * seats->sleeper, s), seats->upper_c);
    const CzComplex bottom_slope =
        plus(cz_complex_scaled(2.0 * seats->ballast, s), seats->upper_c + c);
    /* top bottom - upper^2, without the difference of two large numbers at small s */
    const CzComplex rest =
        cz_complex_sum(cz_complex_scaled(seats->ballast, s2), lower); /* bottom - upper */
    Below below;
    below.numerator = bottom;
    below.numerator_slope = bottom_slope;
    below.determinant =
        cz_complex_sum(cz_complex_product(cz_complex_scaled(seats->sleeper, s2), bottom),
                       cz_complex_product(upper, rest));
    below.determinant_slope =
        cz_complex_difference(cz_complex_sum(cz_complex_product(top_slope, bottom),
                                             cz_complex_product(top, bottom_slope)),
                              cz_complex_scaled(2.0 * seats->upper_c, upper));
    return below;
}

CzTrackBelow cz_track_below(const CzTrackBlock *block, CzComplex s) {
    const Below below = below_of(block, s);
    const CzSeats *seats = block->seats;
    const CzComplex upper = plus(cz_complex_scaled(seats->upper_c, s), seats->upper_k);
    const CzComplex inverse = cz_complex_inverse(below.determinant);
    return (CzTrackBelow){cz_complex_product(below.numerator, inverse),
                          cz_complex_product(upper, inverse)};
}

CzSecular cz_track_secular(const CzTrackBlock *block, CzComplex s) {
    const CzSeats *seats = block->seats;
    CzSecular secular = {.value = {block->rest, 0.0}};
    for (int i = 0; i < block->n_wave; ++i) {
        const CzComplex h = cz_track_wave_answer(block, i, s);
        const double c = block->wave[i].share / block->mass[i];
        const CzComplex h_slope = cz_complex_scaled(-2.0 / c, cz_complex_product(s, square_of(h)));
        secular.value = cz_complex_sum(secular.value, cz_complex_scaled(block->crests, h));
        secular.slope = cz_complex_sum(secular.slope, cz_complex_scaled(block->crests, h_slope));
        secular.degrees =
            cz_complex_sum(secular.degrees, cz_complex_product(cz_complex_scaled(2.0 / c, s), h));
    }
    const CzComplex pad =
        cz_complex_inverse(plus(cz_complex_scaled(seats->pad_c, s), seats->pad_k));
    const Below below = below_of(block, s);
    const CzComplex inverse = cz_complex_inverse(below.determinant);
    const CzComplex relative = cz_complex_product(below.determinant_slope, inverse);
    const CzComplex sleeper = cz_complex_product(below.numerator, inverse);
    const CzComplex below_slope = cz_complex_difference(
        cz_complex_product(below.numerator_slope, inverse), cz_complex_product(sleeper, relative));
    secular.value = cz_complex_sum(secular.value, cz_complex_sum(pad, sleeper));
    secular.slope = cz_complex_sum(
        secular.slope,
        cz_complex_difference(below_slope, cz_complex_scaled(seats->pad_c, square_of(pad))));
    secular.degrees = cz_complex_sum(
        secular.degrees, cz_complex_sum(relative, cz_complex_scaled(seats->pad_c, pad)));
    secular.degrees =
        cz_complex_sum(secular.degrees, cz_complex_ratio(secular.slope, secular.value));
    return secular;
}

/* Starting values: each part by itself, with light damping. */
static int guess(const CzTrackBlock *block, CzComplex root[CZ_BLOCK_ROOTS]) {
    const CzSeats *seats = block->seats;
    double frequency[CZ_BLOCK_WAVES + 2];
    int n = 0;
    for (int i = 0; i < block->n_wave; ++i)
        frequency[n++] =
            sqrt(block->wave[i].bending + seats->pad_k / (seats->mass * seats->spacing));
    frequency[n++] = sqrt((seats->pad_k + seats->upper_k) / seats->sleeper);
    frequency[n++] = sqrt((seats->upper_k + seats->lower_k) / seats->ballast);
    int n_root = 0;
    for (int i = 0; i < n; ++i) {
        const double w = frequency[i] * (1.0 + 0.01 * i);
        root[n_root++] = (CzComplex){-0.2 * w, w};
        root[n_root++] = (CzComplex){-0.2 * w, -w};
    }
    root[n_root++] = (CzComplex){-1.0 / (block->rest * seats->pad_c), 0.0};
    return n_root;
}

static CzComplex slope_of(const void *block, CzComplex s) {
    return cz_track_secular(block, s).degrees;
}

int cz_track_roots(const CzTrackBlock *block, CzComplex root[CZ_BLOCK_ROOTS]) {
    const int n = guess(block, root);
    cz_find_roots(slope_of, block, n, root);
    return n;
}
