/* The two-step scheme on an example with an exact solution. */
#include "physics/scheme.h"

#include "integrate/two_step.h"
#include "laws/wheel_rail.h"

void exact_answer(double t, double *u) {
    const double slow = cos(sqrt(2.0) * t), fast = cos(sqrt(5.0) * t);
    u[0] = 1.0 - 5.0 / 3.0 * slow + 2.0 / 3.0 * fast;
    u[1] = 3.0 - 5.0 / 3.0 * slow - 4.0 / 3.0 * fast;
}

void rows_of_published_answer(Rows *rows) {
    static const double published[][2] = {
        {.00251, .38188},   {.03807, 1.41160},  {.17559, 2.78095},  {.48603, 4.09356},
        {.99635, 4.99623},  {1.65696, 5.29051}, {2.33820, 4.98571}, {2.86081, 4.27665},
        {3.05171, 3.45748}, {2.80572, 2.80622}, {2.13058, 2.48433}, {1.15723, 2.48876}};
    double worst = 0.0;
    for (int i = 0; i < 12; i++) {
        double u[2];
        exact_answer(0.28 * (i + 1), u);
        worst = fmax(worst, fmax(fabs(u[0] - published[i][0]), fabs(u[1] - published[i][1])));
    }
    ROW(rows, "", worst, 0.0, 0.0, 6e-6, /* half of the published last digit, and rounding */
        "exact answer against the 24 published numbers: largest difference");
}

static void accelerate(const double *u, double *a) {
    a[0] = 0.5 * -(6.0 * u[0] - 2.0 * u[1]);
    a[1] = 10.0 - (4.0 * u[1] - 2.0 * u[0]);
}

double largest_error(int per_instant) {
    const double step = 0.28 / per_instant;
    double u[2] = {0}, v[2] = {0}, a[2], last[2] = {0}, worst = 0.0;
    accelerate(u, a);
    for (int i = 1; i <= 12 * per_instant; i++) {
        cz_two_step_advance(2, step, i == 1, u, v, a, last);
        accelerate(u, a);
        if (i % per_instant != 0)
            continue;
        double truth[2];
        exact_answer(i * step, truth);
        worst = fmax(worst, fmax(fabs(u[0] - truth[0]), fabs(u[1] - truth[1])));
    }
    return worst;
}

void rows_of_known_errors(Rows *rows) {
    ROW(rows, "", largest_error(1), 0.1349, 1e-3, 0.0, "largest error, step 0.28");
    ROW(rows, "", largest_error(10), 1.289e-3, 1e-3, 0.0, "largest error, step 0.028");
    ROW(rows, "", largest_error(100), 1.288e-5, 1e-3, 0.0, "largest error, step 0.0028");
}

void rows_of_order(Rows *rows) {
    for (int n = 10; n <= 160; n *= 2)
        ROW(rows, "", log2(largest_error(n) / largest_error(2 * n)), 2.0, 0.0, 0.1,
            "order, step %g to %g", 0.28 / n, 0.14 / n);
}

/* A wheelset that drops on a rail without springs: Hertz's impact (1882). The approach is (5 m v^2
 * / (4 H))^(2/5), the duration 2.943275 times the approach over the speed, and the rebound speed
 * equals the impact speed. */
void rows_of_hertz_impact(Rows *rows) {
    const double mass = 1000.0, speed = 0.2, step = 1e-6;
    const double g = 4.22e-8, hertz = 2.0 / (g * sqrt(g)); /* a worn tread of 0.46 m */
    const double energy = 1.25 * mass * speed * speed / hertz;
    const double travel = cbrt(energy) * pow(energy, 1.0 / 15.0); /* ^(2/5) */
    double u = 0.0, v = speed, a = 0.0, last = 0.0, most = 0.0, deepest = 0.0, before = 0.0;
    double duration = NAN;
    for (int i = 1; isnan(duration) && i < 10000; i++) {
        before = u;
        cz_two_step_advance(1, step, i == 1, &u, &v, &a, &last);
        const double force = cz_wheel_normal_force(hertz, u);
        a = -force / mass;
        most = fmax(most, force);
        deepest = fmax(deepest, u);
        if (u <= 0.0)
            duration = step * (i - u / (u - before));
    }
    ROW(rows, "mm", 1e3 * deepest, 1e3 * travel, 1e-5, 0.0,
        "wheelset of 1 t at 0.2 m/s onto a rail: indentation");
    ROW(rows, "kN", 1e-3 * most, 1e-3 * hertz * travel * sqrt(travel), 1e-5, 0.0,
        "wheelset of 1 t at 0.2 m/s onto a rail: largest force");
    ROW(rows, "ms", 1e3 * duration, 1e3 * 2.943275 * travel / speed, 1e-5, 0.0,
        "wheelset of 1 t at 0.2 m/s onto a rail: duration");
    ROW(rows, "m/s", v, -speed, 1e-5, 0.0, "wheelset of 1 t at 0.2 m/s onto a rail: rebound");
}

bool is_stable(double step) {
    double u = 1.0, v = 0.0, a = -1.0, last = 0.0;
    for (int i = 0; i < 20000; i++) {
        cz_two_step_advance(1, step, i == 0, &u, &v, &a, &last);
        a = -u;
        if (!(fabs(u) < 1e6))
            return false;
    }
    return true;
}

/* Bisection between a step that is stable and one that is not. */
void rows_of_stability(Rows *rows) {
    double stable = 1.0, unstable = 3.0;
    while (unstable - stable > 1e-4) {
        const double middle = 0.5 * (stable + unstable);
        if (is_stable(middle))
            stable = middle;
        else
            unstable = middle;
    }
    ROW(rows, "", stable, 2.0, 1e-3, 0.0, "largest stable step times frequency, undamped");
}
