/* Wheel and rail: Hertzian normal force with lift-off, and a tangential force that rises, peaks and
 * falls with slip.
 *
 *   N = H d^(3/2) for an indentation d > 0, else 0
 *
 * is Zhai's vertical law, for the two wheels of a wheelset: H = 2 G^-1.5. A rail with a static
 * deflection of r N is in series with it: with an approach A of wheel and rail, s = sqrt(d) solves
 *
 *   s^2 + r H s^3 = A
 *
 * Tangentially
 *
 *   e' = (e + h w) / (1 + h |V| / a),  held within |e'| <= mu(w) N / k
 *   T  = -k e'
 *   mu(w) = mu_s + (mu_p - mu_s) / (1 + |w| / w_f)
 *
 * with a deflection e that is advanced implicitly over the step h.
 * w is the slip speed of the wheel's contact point, V the speed along the rail, a the contact
 * length. For a rolling wheel e = w a / |V|: the force is proportional to creepage. A standing
 * wheel keeps its deflection: a spring that slips at mu N. One law covers both, without a smallest
 * speed and without a step bound from friction.
 */
#ifndef CZ_LAWS_WHEEL_RAIL_H
#define CZ_LAWS_WHEEL_RAIL_H

#include "laws/law.h"

static inline double cz_wheel_normal_force(double hertz, double indentation) {
    const double pressed = cz_positive_part(indentation);
    return hertz * pressed * sqrt(pressed);
}

/* Normal force under an approach A on a rail of flexibility r [m/N]. In t = s / sqrt(A) the
 * equation is t^2 + u t^3 = 1 with u = r H sqrt(A). It begins with a fraction that is within 1 % of
 * the root up to u = 5 and within 25 % up to 100; two steps of Halley's method leave rounding up to
 * u = 10, fifteen times that of a usual axle load, and 1e-6 at u = 100. */
static inline double cz_wheel_force_on_spring(double hertz, double flexibility, double approach) {
    const double pressed = cz_positive_part(approach), root = sqrt(pressed);
    const double u = flexibility * hertz * root;
    double t = (1.0 + 0.355 * u) / (1.0 + u * (0.782 + 0.0144 * u));
    for (int k = 0; k < 2; ++k) {
        const double ut = u * t;
        const double value = t * t * (1.0 + ut) - 1.0, slope = t * (2.0 + 3.0 * ut);
        const double bend = 2.0 + 6.0 * ut;
        t -= 2.0 * value * slope / (2.0 * slope * slope - value * bend);
    }
    const double s = t * root;
    return hertz * s * s * s;
}

typedef struct {
    double stiffness;        /* k [N/m] */
    double length;           /* a [m] */
    double friction_peak;    /* mu_p [-] */
    double friction_sliding; /* mu_s [-] */
    double fall_speed;       /* w_f [m/s] */
} CzCreepLaw;

/* Next tangential deflection e [m]; the force on the wheel is -k e. `inverse_stiffness` is 1/k, 0
 * without wheels. */
static inline double cz_creep_deflection(const CzCreepLaw *law, double inverse_stiffness,
                                         double deflection, double slip, double speed,
                                         double normal, double step) {
    /* One division each: (e + h w) / (1 + h |V| / a) and (mu_p - mu_s) / (1 + |w| / w_f). */
    const double carried =
        (deflection + step * slip) * law->length / (law->length + step * fabs(speed));
    const double fall = (law->friction_peak - law->friction_sliding) * law->fall_speed /
                        (law->fall_speed + fabs(slip));
    const double limit = (law->friction_sliding + fall) * normal * inverse_stiffness;
    return cz_clamp(carried, -limit, limit);
}

#endif
