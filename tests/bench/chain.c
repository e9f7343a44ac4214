/* The simple chain in plain C. */
#include "bench/chain.h"

#include <math.h>
#include <string.h>

#define SLOPE(x0, f0, x1, f1) (((f1) - (f0)) / ((x1) - (x0)))

static const Coupler between_cars = {
    .stroke = {0.0, 0.05, 0.055, 0.3, 0.32, 0.8, 0.9},
    .force = {0.0, 500e3, 800e3, 800e3, 1500e3, 1800e3, 10000e3},
    .slope = {SLOPE(0.0, 0.0, 0.05, 500e3), SLOPE(0.05, 500e3, 0.055, 800e3), 0.0,
              SLOPE(0.3, 800e3, 0.32, 1500e3), SLOPE(0.32, 1500e3, 0.8, 1800e3),
              SLOPE(0.8, 1800e3, 0.9, 10000e3), SLOPE(0.8, 1800e3, 0.9, 10000e3)},
    .unloading = 100e6,
};

static const Coupler colliding = {
    .stroke = {0.0, 0.08, 0.09, 0.35, 0.37, 0.9, 1.0},
    .force = {0.0, 600e3, 900e3, 900e3, 2000e3, 2600e3, 12000e3},
    .slope = {SLOPE(0.0, 0.0, 0.08, 600e3), SLOPE(0.08, 600e3, 0.09, 900e3), 0.0,
              SLOPE(0.35, 900e3, 0.37, 2000e3), SLOPE(0.37, 2000e3, 0.9, 2600e3),
              SLOPE(0.9, 2600e3, 1.0, 12000e3), SLOPE(0.9, 2600e3, 1.0, 12000e3)},
    .unloading = 100e6,
};

const Coupler *chain_coupler(int n, int i) {
    return i == n / 2 - 1 ? &colliding : &between_cars;
}

static double envelope(const Coupler *coupler, double x) {
    int i = 0;
    while (i < CHAIN_POINTS - 1 && x > coupler->stroke[i + 1])
        i++;
    return coupler->force[i] + coupler->slope[i] * (x - coupler->stroke[i]);
}

double chain_force(const Coupler *coupler, double x, double p) {
    if (x <= p)
        return 0.0;
    const double unloaded = coupler->unloading * (x - p);
    const double loaded = envelope(coupler, x);
    return unloaded < loaded ? unloaded : loaded;
}

double chain_next_set(const Coupler *coupler, double x, double p, double force) {
    const double set = x - force / coupler->unloading;
    return force > 0.0 && set > p ? set : p;
}

void chain_run(int n, double step, ChainResult *result) {
    const long n_step = lround(CHAIN_DURATION / step);
    const double per_mass = step / CHAIN_MASS;
    double x[CHAIN_MAX_CARS] = {0.0}, v[CHAIN_MAX_CARS] = {0.0}, p[CHAIN_MAX_CARS] = {0.0};
    memset(result, 0, sizeof *result);
    for (int i = 0; i < n / 2; i++)
        v[i] = CHAIN_SPEED;
    for (long k = 0; k < n_step; k++) {
        for (int i = 0; i < n - 1; i++) {
            const Coupler *coupler = chain_coupler(n, i);
            const double shortening = x[i] - x[i + 1];
            const double force = chain_force(coupler, shortening, p[i]);
            p[i] = chain_next_set(coupler, shortening, p[i], force);
            v[i] -= force * per_mass;
            v[i + 1] += force * per_mass;
            result->force[i] = fmax(result->force[i], force);
            result->shortening[i] = fmax(result->shortening[i], shortening);
        }
        for (int i = 0; i < n; i++)
            x[i] += step * v[i];
    }
    memcpy(result->speed, v, (size_t)n * sizeof *v);
}

/* Largest difference over the largest value of the reference, or over `scale` if that is given. */
static double difference(int n, const double *value, const double *reference, double scale) {
    double largest = 0.0;
    for (int i = 0; i < n; i++) {
        largest = fmax(largest, fabs(value[i] - reference[i]));
        scale = fmax(scale, fabs(reference[i]));
    }
    return largest / scale;
}

double chain_error(int n, const ChainResult *result, const ChainResult *reference) {
    const double force = difference(n - 1, result->force, reference->force, 0.0);
    const double shortening = difference(n - 1, result->shortening, reference->shortening, 0.0);
    const double speed = difference(n, result->speed, reference->speed, CHAIN_SPEED);
    return fmax(fmax(force, shortening), speed);
}
