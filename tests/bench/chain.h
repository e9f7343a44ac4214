/* The simple chain that all programs of the benchmark compute, and its coupler's law.
 *
 *   car 0 --coupler 0-- car 1 --coupler 1-- ... car 2N-1      car i ahead of car i-1
 *
 * Point masses on a line: the first N at speed, the others standing. A coupler pushes as it is
 * shortened by x and pulls nothing:
 *   F = max(min(envelope(x), k (x - p)), 0),    p' = x - F / k  where the envelope bounds it
 * The permanent set p is committed once a step, so that the force is a function of the state.
 */
#ifndef CZ_BENCH_CHAIN_H
#define CZ_BENCH_CHAIN_H

#ifdef __cplusplus
extern "C" {
#endif

#define CHAIN_MASS 50e3    /* [kg] */
#define CHAIN_SPEED 10.0   /* of the moving cars [m/s] */
#define CHAIN_DURATION 0.5 /* [s] */
#define CHAIN_STEP 1e-4    /* [s] */

enum { CHAIN_MAX_CARS = 32, CHAIN_POINTS = 7 };

typedef struct Coupler {
    double stroke[CHAIN_POINTS], force[CHAIN_POINTS]; /* envelope [m], [N] */
    double slope[CHAIN_POINTS];                       /* from a point on [N/m] */
    double unloading;                                 /* k [N/m] */
} Coupler;

/* Coupler i of a chain of n cars: the one in the middle is the colliding one. */
const Coupler *chain_coupler(int n, int i);

/* Force [N] at the shortening x [m] and the permanent set p [m]. */
double chain_force(const Coupler *coupler, double x, double p);

/* Permanent set after a step that ended at x with a force. */
double chain_next_set(const Coupler *coupler, double x, double p, double force);

/* What the programs are compared by. */
typedef struct ChainResult {
    double force[CHAIN_MAX_CARS];      /* largest of each coupler [N] */
    double shortening[CHAIN_MAX_CARS]; /* largest of each coupler [m] */
    double speed[CHAIN_MAX_CARS];      /* of each car at the end [m/s] */
} ChainResult;

/* In plain C: semi-implicit Euler. */
void chain_run(int n, double step, ChainResult *result);

/* Largest difference from a reference: of forces over the largest force, of shortenings over the
 * largest shortening, of speeds over the impact speed. */
double chain_error(int n, const ChainResult *result, const ChainResult *reference);

/* Another program that computes the chain: its model is made once, and run any number of times. */
typedef struct ChainPeer {
    const char *name;   /* such as "MuJoCo" */
    const char *method; /* time integration */
    const char *(*version)(void);
    void *(*create)(int n); /* NULL when that fails */
    void (*run)(void *model, ChainResult *result);
    void (*destroy)(void *model);
} ChainPeer;
extern const ChainPeer chain_mujoco, chain_simbody;

#ifdef __cplusplus
}
#endif
#endif
