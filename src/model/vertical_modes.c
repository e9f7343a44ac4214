/* Natural frequencies of a car on its springs, wheels held.
 *
 *   K v = w^2 M v   with M diagonal, as   (M^-1/2 K M^-1/2) u = w^2 u,   u = M^1/2 v
 *
 * Body and end masses move as one rigid body, about their common centre of gravity. The symmetric
 * eigenproblem is solved completely.
 */
#include "model/vertical_modes.h"

#include "base/symmetric.h"

enum { N = CZ_N_VERTICAL_MODE, Z = 0, PITCH = 1, BOGIE_Z = 2, BOGIE_PITCH = 3 };

static void assemble(const CzVehicle *vehicle, const CzStatics *statics, double stiffness[N][N],
                     double mass[N]) {
    const CzBogie *bogie = &vehicle->bogie;
    const CzEnd *rear = &vehicle->rear, *front = &vehicle->front;
    const double secondary = bogie->secondary.stiffness, primary = bogie->primary.stiffness;
    const double half_axle = bogie->axle_spacing / 2.0;

    /* Body with its ends, about the common centre of gravity. */
    const double moment = front->mass * front->distance - rear->mass * rear->distance;
    mass[Z] = statics->body_mass + rear->mass + front->mass;
    const double centre = moment / mass[Z];
    mass[PITCH] = statics->body_inertia + rear->pitch_inertia + front->pitch_inertia +
                  rear->mass * rear->distance * rear->distance +
                  front->mass * front->distance * front->distance - moment * centre;

    for (int which = CZ_REAR; which <= CZ_FRONT; which++) {
        const double half = vehicle->bogie_spacing / 2.0;
        const double arm = (which == CZ_FRONT ? half : -half) - centre;
        const int z = BOGIE_Z + 2 * which, pitch = BOGIE_PITCH + 2 * which;
        mass[z] = bogie->mass;
        mass[pitch] = bogie->pitch_inertia;
        stiffness[Z][Z] += secondary;
        stiffness[Z][PITCH] += secondary * arm;
        stiffness[PITCH][PITCH] += secondary * arm * arm;
        stiffness[Z][z] -= secondary;
        stiffness[PITCH][z] -= secondary * arm;
        stiffness[z][z] += secondary + 2.0 * primary;
        stiffness[pitch][pitch] += 2.0 * primary * half_axle * half_axle;
    }
}

/* Column of the mode in which one co-ordinate has the largest share. */
static int mode_of(double vectors[N][N], int coordinate) {
    int best = 0;
    for (int mode = 1; mode < N; mode++)
        if (fabs(vectors[coordinate][mode]) > fabs(vectors[coordinate][best]))
            best = mode;
    return best;
}

static double frequency_of(double square) {
    return sqrt(fmax(square, 0.0)) / (2.0 * 3.14159265358979323846);
}

CzVerticalModes cz_vertical_modes(const CzVehicle *vehicle, const CzStatics *statics) {
    double stiffness[N][N] = {{0}}, mass[N], vectors[N][N];
    assemble(vehicle, statics, stiffness, mass);
    for (int i = 0; i < N; i++)
        for (int j = i; j < N; j++) {
            stiffness[i][j] /= sqrt(mass[i] * mass[j]);
            stiffness[j][i] = stiffness[i][j];
        }
    cz_symmetric_diagonalise(N, &stiffness[0][0], &vectors[0][0]);

    CzVerticalModes modes;
    const int bounce = mode_of(vectors, Z), pitch = mode_of(vectors, PITCH);
    modes.bounce = frequency_of(stiffness[bounce][bounce]);
    modes.pitch = frequency_of(stiffness[pitch][pitch]);
    for (int mode = 0; mode < N; mode++) {
        const double frequency = frequency_of(stiffness[mode][mode]);
        int place = mode;
        for (; place > 0 && modes.frequency[place - 1] > frequency; place--)
            modes.frequency[place] = modes.frequency[place - 1];
        modes.frequency[place] = frequency;
    }
    return modes;
}
