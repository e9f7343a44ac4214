/* Natural frequencies of a car on its springs, wheels held.
 *
 *   K v = w^2 M v   with M diagonal, as   (M^-1/2 K M^-1/2) u = w^2 u,   u = M^1/2 v
 *
 * Body and end masses move as one, about their common centre of gravity. The symmetric eigenproblem
 * is solved by Jacobi's rotations.
 */
#include "model/vertical_modes.h"

enum { N = CZ_N_VERTICAL_MODE, Z = 0, PITCH = 1, BOGIE_Z = 2, BOGIE_PITCH = 3 };

/* Rotates rows and columns p and q so that a[p][q] vanishes; the vectors turn along. */
static void rotate(double a[N][N], double vectors[N][N], int p, int q) {
    const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    const double t = (theta >= 0.0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(theta * theta + 1.0));
    const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
    for (int k = 0; k < N; k++) {
        const double kp = a[k][p], kq = a[k][q];
        a[k][p] = c * kp - s * kq;
        a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < N; k++) {
        const double pk = a[p][k], qk = a[q][k];
        a[p][k] = c * pk - s * qk;
        a[q][k] = s * pk + c * qk;
        const double vp = vectors[k][p], vq = vectors[k][q];
        vectors[k][p] = c * vp - s * vq;
        vectors[k][q] = s * vp + c * vq;
    }
}

/* Eigenvalues end up on the diagonal of a, eigenvectors in the columns of vectors. */
static void diagonalise(double a[N][N], double vectors[N][N]) {
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            vectors[i][j] = i == j;
    for (int sweep = 0; sweep < 30; sweep++)
        for (int p = 0; p < N; p++)
            for (int q = p + 1; q < N; q++)
                if (fabs(a[p][q]) > 1e-18 * (fabs(a[p][p]) + fabs(a[q][q])))
                    rotate(a, vectors, p, q);
}

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
    diagonalise(stiffness, vectors);

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
