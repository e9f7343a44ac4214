/* The force at which a chain of cars and coupler struts folds.
 *
 *   stored     k (z^2 + l_c^2 beta^2)                     a body on the springs of its bogies
 *              K (phi - beta)^2 / 2                       a hinge between strut and body
 *              k_g w^2 / 2 + k_f (beta_e - beta)^2 / 2    an end mass that carries a pivot
 *
 *   shortened  l phi^2 / 2                                a strut
 *              a beta^2 / 2                               a body from its middle to a pivot
 *              x beta^2 / 2 + w beta + p beta_e^2 / 2     the same with an end mass
 *
 * phi = (z_B - z_A) / l is the angle of the line between the pivots, w = z_e - z - x beta the
 * travel of the end mass across its body.
 *
 *   K u = F G u    with the energies u^T K u / 2 and the shortening u^T G u / 2 under the force F
 *
 * The force is the same in every strut, and it acts on both ends of every body: on a body with one
 * strut it acts at the same distance from the middle of the other end. Eigenvalues F are found from
 * L^-1 G L^-T y = (1 / F) y, K = L L^T, u = L^-T y.
 *
 * A shape belongs to a strut when the shortening there is at least a hundredth (the swing a tenth)
 * of the largest one in the shape; for a smaller swing the force is increased in inverse proportion
 * to the swing, so that F_crit is continuous in every number (ours).
 */
#include "model/strut_chain.h"

#include "base/symmetric.h"

#include <math.h>

#define SWING_THROUGH                                                                              \
    0.1 /* smallest share of the largest swing in a shape that belongs to a strut (ours) */

/* The unknowns of one end of a strut: of the body, and of an end mass that carries the pivot. */
typedef enum Unknown { BODY_Z, BODY_PITCH, END_Z, END_PITCH, N_OF_PIVOT } Unknown;
enum { N_OF_STRUT = 2 * N_OF_PIVOT };

typedef struct Strut {
    int unknown[N_OF_STRUT]; /* their numbers in the chain; -1: held */
    double stiffness[N_OF_STRUT][N_OF_STRUT];
    double shortening[N_OF_STRUT][N_OF_STRUT];
} Strut;

typedef struct Chain {
    int n_car, n_strut, n; /* n: unknowns */
    const CzChainCar *car;
    const CzChainStrut *given;
    Strut *strut;
    int *body;          /* first of the two unknowns of each car; -1: held */
    double *stiffness;  /* (n x n) */
    double *shortening; /* (n x n) */
    double *shape;      /* (n x n) */
} Chain;

static bool is_given(const CzChainStrut *strut) {
    return strut->length > 0.0;
}

/* ---- one strut ---- */

/* Adds factor * (row . u)^2. */
static void add_square(double matrix[N_OF_STRUT][N_OF_STRUT], const double row[N_OF_STRUT],
                       double factor) {
    for (int i = 0; i < N_OF_STRUT; i++)
        for (int j = 0; j < N_OF_STRUT; j++)
            matrix[i][j] += factor * row[i] * row[j];
}

/* Adds 2 factor u_i u_j. */
static void add_product(double matrix[N_OF_STRUT][N_OF_STRUT], int i, int j, double factor) {
    matrix[i][j] += factor;
    matrix[j][i] += factor;
}

/* Contribution of an end mass to its pivot: its guidance, and its own rotation. */
static void add_end_mass(Strut *strut, const CzChainPivot *pivot, int first, double outwards) {
    double across[N_OF_STRUT] = {0}, turned[N_OF_STRUT] = {0};
    across[first + END_Z] = 1.0;
    across[first + BODY_Z] = -1.0;
    across[first + BODY_PITCH] = -outwards * pivot->body_arm;
    turned[first + END_PITCH] = 1.0;
    turned[first + BODY_PITCH] = -1.0;
    add_square(strut->stiffness, across, pivot->end_guide);
    add_square(strut->stiffness, turned, pivot->end_fold);
    for (int i = 0; i < N_OF_STRUT; i++)
        add_product(strut->shortening, i, first + BODY_PITCH, outwards * across[i]);
    strut->shortening[first + END_PITCH][first + END_PITCH] += pivot->end_arm;
}

static void assemble_strut(const CzChainStrut *given, Strut *strut) {
    double angle[N_OF_STRUT] = {0}; /* of the strut, over the unknowns */
    for (int side = 0; side < 2; side++) {
        const CzChainPivot *pivot = &given->pivot[side];
        const int first = side * N_OF_PIVOT;
        const double outwards = side == 0 ? 1.0 : -1.0;
        const bool on_end = pivot->end_guide > 0.0;
        const int z = first + (on_end ? END_Z : BODY_Z);
        const double arm = on_end ? pivot->end_arm : pivot->body_arm;
        strut->shortening[first + BODY_PITCH][first + BODY_PITCH] += pivot->body_arm;
        if (on_end)
            add_end_mass(strut, pivot, first, outwards);
        if (given->tilts) {
            angle[z] = -outwards / given->length;
            angle[z + 1] = -arm / given->length;
        }
    }
    add_square(strut->shortening, angle, given->length);
    for (int side = 0; side < 2; side++) {
        const CzChainPivot *pivot = &given->pivot[side];
        double swing[N_OF_STRUT];
        for (int i = 0; i < N_OF_STRUT; i++)
            swing[i] = angle[i];
        swing[side * N_OF_PIVOT + (pivot->end_guide > 0.0 ? END_PITCH : BODY_PITCH)] -= 1.0;
        add_square(strut->stiffness, swing, pivot->hinge);
    }
}

/* ---- the chain ---- */

/* Numbers the unknowns of bodies and of end masses; the latter only of pivots that are on one. */
static void number_unknowns(Chain *chain) {
    chain->n = 0;
    for (int car = 0; car < chain->n_car; car++) {
        chain->body[car] = chain->car[car].spring > 0.0 ? chain->n : -1;
        chain->n += chain->car[car].spring > 0.0 ? 2 : 0;
    }
    for (int i = 0; i < chain->n_strut; i++)
        for (int side = 0; side < 2; side++) {
            int *unknown = &chain->strut[i].unknown[side * N_OF_PIVOT];
            const int body = chain->body[i + side];
            const bool moves = is_given(&chain->given[i]) && body >= 0;
            const bool on_end = moves && chain->given[i].pivot[side].end_guide > 0.0;
            unknown[BODY_Z] = moves ? body : -1;
            unknown[BODY_PITCH] = moves ? body + 1 : -1;
            unknown[END_Z] = on_end ? chain->n : -1;
            unknown[END_PITCH] = on_end ? chain->n + 1 : -1;
            chain->n += on_end ? 2 : 0;
        }
}

static void add_strut(Chain *chain, const Strut *strut) {
    for (int i = 0; i < N_OF_STRUT; i++)
        for (int j = 0; j < N_OF_STRUT; j++) {
            const int row = strut->unknown[i], column = strut->unknown[j];
            if (row < 0 || column < 0)
                continue;
            chain->stiffness[row * chain->n + column] += strut->stiffness[i][j];
            chain->shortening[row * chain->n + column] += strut->shortening[i][j];
        }
}

/* Distance of a pivot from the middle of its car; 0 without a strut. */
static double reach(const Chain *chain, int strut, int side) {
    if (strut < 0 || strut >= chain->n_strut || !is_given(&chain->given[strut]))
        return 0.0;
    const CzChainPivot *pivot = &chain->given[strut].pivot[side];
    return pivot->body_arm + pivot->end_arm;
}

static void add_body(Chain *chain, int car) {
    const int z = chain->body[car], pitch = z + 1, n = chain->n;
    if (z < 0)
        return;
    const CzChainCar *body = &chain->car[car];
    chain->stiffness[z * n + z] += 2.0 * body->spring;
    chain->stiffness[pitch * n + pitch] +=
        2.0 * body->spring * body->half_spacing * body->half_spacing;
    const double front = reach(chain, car, 0), rear = reach(chain, car - 1, 1);
    if (front == 0.0 || rear == 0.0) /* the other end of a body with one strut */
        chain->shortening[pitch * n + pitch] += front + rear;
}

static void assemble(Chain *chain) {
    for (int i = 0; i < chain->n_strut; i++)
        if (is_given(&chain->given[i])) {
            assemble_strut(&chain->given[i], &chain->strut[i]);
            add_strut(chain, &chain->strut[i]);
        }
    for (int car = 0; car < chain->n_car; car++)
        add_body(chain, car);
}

/* ---- shapes ---- */

/* Computes the shapes in the columns of `shape`, and 1 / F on the diagonal of `shortening`. */
static bool find_shapes(Chain *chain) {
    const int n = chain->n;
    if (!cz_symmetric_factor(n, chain->stiffness))
        return false;
    for (int column = 0; column < n; column++)
        cz_lower_solve(n, chain->stiffness, &chain->shortening[column], n);
    for (int row = 0; row < n; row++)
        cz_lower_solve(n, chain->stiffness, &chain->shortening[row * n], 1);
    for (int row = 0; row < n; row++) /* symmetric to the last bit */
        for (int column = 0; column < row; column++)
            chain->shortening[row * n + column] = chain->shortening[column * n + row];
    cz_symmetric_diagonalise(n, chain->shortening, chain->shape);
    for (int column = 0; column < n; column++)
        cz_upper_solve(n, chain->stiffness, &chain->shape[column], n);
    return true;
}

/* Shortening at one strut in a shape: of the strut and of the two bodies at it. */
static double shortening_at(const Chain *chain, const Strut *strut, int shape) {
    double sum = 0.0;
    for (int i = 0; i < N_OF_STRUT; i++)
        for (int j = 0; j < N_OF_STRUT; j++) {
            const int row = strut->unknown[i], column = strut->unknown[j];
            if (row >= 0 && column >= 0)
                sum += chain->shape[row * chain->n + shape] * strut->shortening[i][j] *
                       chain->shape[column * chain->n + shape];
        }
    return fmax(sum, 0.0);
}

/* Lowers the force of each strut to that of a shape that belongs to it. */
static void count_shape(const Chain *chain, int shape, double *force) {
    const double inverse = chain->shortening[shape * chain->n + shape];
    double largest = 0.0;
    if (!(inverse > 0.0))
        return;
    for (int i = 0; i < chain->n_strut; i++)
        largest = fmax(largest, shortening_at(chain, &chain->strut[i], shape));
    for (int i = 0; i < chain->n_strut; i++) {
        const double swing = sqrt(shortening_at(chain, &chain->strut[i], shape) / largest);
        if (swing > 0.0)
            force[i] = fmin(force[i], fmax(1.0, SWING_THROUGH / swing) / inverse);
    }
}

static void find_forces(Chain *chain, double *force) {
    if (!find_shapes(chain))
        return;
    for (int i = 0; i < chain->n_strut; i++)
        force[i] = INFINITY;
    for (int shape = 0; shape < chain->n; shape++)
        count_shape(chain, shape, force);
    for (int i = 0; i < chain->n_strut; i++)
        if (isinf(force[i]))
            force[i] = NAN;
}

CzStatus cz_strut_chain_fold(int n_car, const CzChainCar *car, const CzChainStrut *strut,
                             CzArena *scratch, double *force) {
    Chain chain = {.n_car = n_car, .n_strut = n_car - 1, .car = car, .given = strut};
    for (int i = 0; i < chain.n_strut; i++)
        force[i] = NAN;
    chain.body = cz_arena_allocate(scratch, (size_t)n_car, sizeof *chain.body);
    chain.strut = cz_arena_allocate(scratch, (size_t)n_car, sizeof *chain.strut);
    if (chain.body == NULL || chain.strut == NULL)
        return CZ_STATUS_NO_MEMORY;
    number_unknowns(&chain);
    if (chain.n == 0)
        return CZ_OK;
    const size_t size = (size_t)chain.n * (size_t)chain.n;
    chain.stiffness = cz_arena_allocate(scratch, size, sizeof *chain.stiffness);
    chain.shortening = cz_arena_allocate(scratch, size, sizeof *chain.shortening);
    chain.shape = cz_arena_allocate(scratch, size, sizeof *chain.shape);
    if (chain.stiffness == NULL || chain.shortening == NULL || chain.shape == NULL)
        return CZ_STATUS_NO_MEMORY;
    assemble(&chain);
    find_forces(&chain, force);
    return CZ_OK;
}
