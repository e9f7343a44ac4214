/* Inverse distribution functions. That of the normal distribution is algorithm AS 241 of M. J.
 * Wichura, Applied Statistics 37 (1988), without its range beyond 5 standard deviations. */
#include "statistics/distribution.h"

#include "statistics/elementary.h"

#include <math.h>

static double polynomial(const double coefficient[8], double r) {
    double sum = 0;
    for (int i = 7; i >= 0; i--)
        sum = sum * r + coefficient[i];
    return sum;
}

/* The standard normal variable below which a share p lies. */
static double normal_quantile(double p) {
    static const double a[8] = {3.3871328727963666080e0, 1.3314166789178437745e2,
                                1.9715909503065514427e3, 1.3731693765509461125e4,
                                4.5921953931549871457e4, 6.7265770927008700853e4,
                                3.3430575583588128105e4, 2.5090809287301226727e3};
    static const double b[8] = {1.0,
                                4.2313330701600911252e1,
                                6.8718700749205790830e2,
                                5.3941960214247511077e3,
                                2.1213794301586595867e4,
                                3.9307895800092710610e4,
                                2.8729085735721942674e4,
                                5.2264952788528545610e3};
    static const double c[8] = {1.42343711074968357734e0,  4.63033784615654529590e0,
                                5.76949722146069140550e0,  3.64784832476320460504e0,
                                1.27045825245236838258e0,  2.41780725177450611770e-1,
                                2.27238449892691845833e-2, 7.74545014278341407640e-4};
    static const double d[8] = {1.0,
                                2.05319162663775882187e0,
                                1.67638483018380384940e0,
                                6.89767334985100004550e-1,
                                1.48103976427480074590e-1,
                                1.51986665636164571966e-2,
                                5.47593808499534494600e-4,
                                1.05075007164441684324e-9};
    const double q = p - 0.5;
    if (fabs(q) <= 0.425) {
        const double r = 0.180625 - q * q;
        return q * polynomial(a, r) / polynomial(b, r);
    }
    const double r = sqrt(-cz_logarithm(q < 0 ? p : 1 - p)) - 1.6;
    const double size = polynomial(c, r) / polynomial(d, r);
    return q < 0 ? -size : size;
}

double cz_truncated_normal(double u) {
    static const double below = 1.3498980316300933e-3; /* share below -3 standard deviations */
    return fmin(fmax(normal_quantile(below + u * (1 - 2 * below)), -3), 3);
}

/* The value at a share between -1 and 1 of the way from the middle to the ends. */
static double at(double share, double low, double high) {
    return fmin(fmax((low + high) / 2 + share * ((high - low) / 2), low), high);
}

double cz_uniform_value(double u, double low, double high) {
    return fmin(low + u * (high - low), high);
}

double cz_normal_value(double u, double low, double high) {
    return at(cz_truncated_normal(u) / 3, low, high);
}

double cz_triangular_value(double u, double low, double high) {
    return at(u < 0.5 ? sqrt(2 * u) - 1 : 1 - sqrt(2 * (1 - u)), low, high);
}

double cz_lognormal_value(double u, double low, double high) {
    const double spread = cz_logarithm(high / low) / 2; /* of the logarithm, to each side */
    const double value = sqrt(low * high) * cz_exponential(cz_truncated_normal(u) / 3 * spread);
    return fmin(fmax(value, low), high);
}

int cz_discrete_index(double u, int n) {
    const int index = (int)(u * n);
    return index < n ? index : n - 1;
}
