/* Linear spring and damper of a traction link, an axle guidance or the guidance of an end mass.
 *
 *   spring(s) = k s,   damper(s') = c s'
 */
#ifndef CZ_LAWS_LINK_H
#define CZ_LAWS_LINK_H

static inline double cz_link_spring(double stiffness, double stretch) {
    return stiffness * stretch;
}

static inline double cz_link_damper(double damping, double rate) {
    return damping * rate;
}

#endif
