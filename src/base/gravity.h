/* Standard acceleration of gravity. */
#ifndef CZ_BASE_GRAVITY_H
#define CZ_BASE_GRAVITY_H

#define CZ_GRAVITY 9.80665 /* [m/s2], ISO 80000-3 */

#endif
