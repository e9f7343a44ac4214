/* Numbers of the rail, its free waves, and its static flexibility in closed form.
 *
 * Waves e^(i K x) with K = (2 pi turns + 2 pi m) / d agree at the seats, for every whole m. Sums
 * over all of them are splines between the seats: with t = 2 pi turns and a place xi in [0, 1]
 *
 *   S2 = sum e^(i (t + 2 pi m) xi) / (t + 2 pi m)^2 = A (1 - xi + e^(i t) xi)
 *   S4 = sum e^(i (t + 2 pi m) xi) / (t + 2 pi m)^4 = a + b xi - A (xi^2/2 - xi^3/6 + e^(it)
 * xi^3/6) A = 1 / (4 sin^2(t/2))   a = A^2 - A/6   b = a (e^(it) - 1) + A (1/3 + e^(it)/6)
 *
 * because -S2'' is a row of unit loads at the seats, -S4'' = S2, and both are taken from one seat
 * to the next by the phase. For t = 0 without m = 0 they are Bernoulli's polynomials, B2/2 and
 * -B4/24.
 */
#include "model/rail.h"

CzSeats cz_seats(const CzRoadbed *roadbed, int n_rail) {
    const CzRail *rail = &roadbed->rail;
    const double n = n_rail;
    return (CzSeats){
        .bending = n * rail->youngs_modulus * rail->second_moment,
        .shear = n * rail->shear_coefficient * rail->shear_modulus * rail->area,
        .mass = n * rail->mass,
        .rotation = n * rail->mass / rail->area * rail->second_moment,
        .spacing = roadbed->sleeper_spacing,
        .pad_k = n * roadbed->pad_stiffness,
        .pad_c = n * roadbed->pad_damping,
        .sleeper = n * roadbed->sleeper_mass,
        .upper_k = n * roadbed->ballast_stiffness,
        .upper_c = n * roadbed->ballast_damping,
        .ballast = n * roadbed->ballast_mass,
        .across_k = n * roadbed->ballast_shear_stiffness,
        .across_c = n * roadbed->ballast_shear_damping,
        .lower_k = n * roadbed->subgrade_stiffness,
        .lower_c = n * roadbed->subgrade_damping,
    };
}

CzRailWave cz_rail_wave(const CzSeats *seats, double wavenumber) {
    const double square = wavenumber * wavenumber;
    const double a = seats->shear * square / seats->mass;
    const double c = (seats->bending * square + seats->shear) / seats->rotation;
    const double product =
        seats->shear / seats->mass * (seats->bending / seats->rotation) * square * square;
    const double cross = a * c - product; /* square of the coupling term */
    const double half = 0.5 * (a + c), away = 0.5 * (c - a);
    const double shear = half + sqrt(away * away + cross);
    const double bending = product / shear;
    return (CzRailWave){wavenumber, bending, shear, (c - bending) / (shear - bending)};
}

/* 4 sin^2 of half the phase from one seat to the next. */
static double step_square(double turns) {
    const double sine = cz_turned(0.5 * turns).im;
    return 4.0 * sine * sine;
}

double cz_seat_flexibility(const CzSeats *seats, double turns) {
    const double ground = seats->lower_k + step_square(turns) * seats->across_k;
    return 1.0 / seats->pad_k + 1.0 / seats->upper_k + 1.0 / ground;
}

CzComplex cz_rail_flexibility(const CzSeats *seats, double turns, double place) {
    const double d = seats->spacing, x = place;
    const double shear = d / seats->shear, bending = d * d * d / seats->bending;
    if (turns == 0.0) {
        const double b2 = x * x - x + 1.0 / 6.0;
        const double b4 = x * x * (x * x - 2.0 * x + 1.0) - 1.0 / 30.0;
        return (CzComplex){shear * b2 / 2.0 - bending * b4 / 24.0, 0.0};
    }
    const CzComplex phase = cz_turned(turns);
    const double A = 1.0 / step_square(turns), a = A * A - A / 6.0;
    const double cube = x * x * x / 6.0;
    const CzComplex b = {a * (phase.re - 1.0) + A * (1.0 / 3.0 + phase.re / 6.0),
                         (a + A / 6.0) * phase.im};
    const CzComplex s2 = {A * (1.0 - x + phase.re * x), A * phase.im * x};
    const CzComplex s4 = {a + b.re * x - A * (x * x / 2.0 - cube + phase.re * cube),
                          b.im * x - A * phase.im * cube};
    return cz_complex_sum(cz_complex_scaled(shear, s2), cz_complex_scaled(bending, s4));
}

/* In both functions below the seat forces follow from equal deflections of rail and seat at each
 * seat.
 */
double cz_ring_flexibility(const CzSeats *seats, int n_seat, double place) {
    double sum = 0.0;
    for (int j = 0; j < n_seat; ++j) {
        const double turns = (double)j / n_seat, seat = cz_seat_flexibility(seats, turns);
        const double own = cz_rail_flexibility(seats, turns, 0.0).re;
        const CzComplex here = cz_rail_flexibility(seats, turns, place);
        sum += j == 0 ? seat + 2.0 * own - 2.0 * here.re
                      : own - cz_complex_square_size(here) / (seat + own);
    }
    return sum / n_seat;
}

double cz_ring_seat_share(const CzSeats *seats, int n_seat, double place, int seat) {
    double sum = 0.0;
    for (int j = 0; j < n_seat; ++j) {
        const double turns = (double)j / n_seat;
        const double below =
            cz_seat_flexibility(seats, turns) + cz_rail_flexibility(seats, turns, 0.0).re;
        const CzComplex here = cz_rail_flexibility(seats, turns, place);
        const CzComplex phase = cz_turned((double)((long)j * seat % n_seat) / n_seat);
        sum += j == 0 ? 1.0 : (here.re * phase.re + here.im * phase.im) / below;
    }
    return sum / n_seat;
}
