/* The force at which a train folds as a chain of struts, against closed forms and against the
 * energy of its exact geometry. */
#include "support/check.h"

#include "base/symmetric.h"
#include "model/strut_chain.h"

enum { MAX_CARS = 48 };

/* A chain of any number of cars of a metro. */
typedef struct Train {
    int n_car;
    CzChainCar car[MAX_CARS];
    CzChainStrut strut[MAX_CARS];
    double force[MAX_CARS];
} Train;

static const CzChainCar a_car = {.spring = 0.73e6, .half_spacing = 7.85};
static const CzChainPivot a_pivot = {.hinge = 0.6e6, .body_arm = 10.2};

static Train equal_train(int n_car) {
    Train train = {.n_car = n_car};
    for (int i = 0; i < n_car; i++) {
        train.car[i] = a_car;
        train.strut[i] = (CzChainStrut){.length = 2.4, .tilts = true, .pivot = {a_pivot, a_pivot}};
    }
    return train;
}

static void fold(Train *train) {
    CzArena scratch = {0};
    assert_int_equal(
        cz_strut_chain_fold(train->n_car, train->car, train->strut, &scratch, train->force), CZ_OK);
    cz_arena_free(&scratch);
}

static double lowest(const Train *train) {
    double least = INFINITY;
    for (int i = 0; i < train->n_car - 1; i++)
        least = fmin(least, train->force[i]);
    return least;
}

/* ---- closed forms ---- */

/* Two equal cars rotate equally by b and move apart by 2 z: two unknowns, det(K - F G) = 0. */
static void two_cars_fold_at_their_closed_form(void **state) {
    (void)state;
    Train train = equal_train(2);
    fold(&train);
    const double k = a_car.spring, lc = a_car.half_spacing, h = a_pivot.hinge;
    const double a = a_pivot.body_arm, l = 2.4, g = 1.0 + 2.0 * a / l;
    const double k11 = 2.0 * k + 4.0 * h / (l * l), k12 = -2.0 * g * h / l;
    const double k22 = 2.0 * k * lc * lc + h * g * g;
    const double g11 = 2.0 / l, g12 = -2.0 * a / l, g22 = 2.0 * a * (1.0 + a / l);
    const double p = g11 * g22 - g12 * g12, q = k11 * g22 + k22 * g11 - 2.0 * k12 * g12;
    const double r = k11 * k22 - k12 * k12;
    assert_near(train.force[0], (q - sqrt(q * q - 4.0 * p * r)) / (2.0 * p), 1e-12, 0.0);
}

static double endless_chain(void) {
    const double k = a_car.spring, lc = a_car.half_spacing, h = a_pivot.hinge;
    const double a = a_pivot.body_arm, g = 1.0 + 2.0 * a / 2.4;
    return (2.0 * k * lc * lc + 2.0 * h * g * g) / (2.0 * a * g);
}

/* F_saw: all cars rotate equally. A train of n cars folds in half a wave of this shape, at a force
 * that is higher by a part that falls with the square of n. */
static void longer_trains_approach_the_sawtooth_of_an_infinite_chain(void **state) {
    (void)state;
    double above[3];
    for (int i = 0; i < 3; i++) {
        Train train = equal_train(12 << i);
        fold(&train);
        above[i] = lowest(&train) - endless_chain();
        assert_true(above[i] > 0.0);
    }
    assert_near(above[0] / above[1], 4.0, 0.1, 0.0);
    assert_near(above[1] / above[2], 4.0, 0.05, 0.0);
    assert_near(above[2], 0.0, 0.0, 2e-4 * endless_chain());
}

/* Against a smooth wall a car rotates by itself: springs and one hinge against the shortening
 * between its two pivots. */
static void a_car_against_a_wall_rotates_between_its_pivots(void **state) {
    (void)state;
    Train train = equal_train(2);
    train.car[1].spring = 0.0;
    train.strut[0].tilts = false;
    fold(&train);
    const double k = a_car.spring, lc = a_car.half_spacing;
    assert_near(train.force[0], (2.0 * k * lc * lc + a_pivot.hinge) / (2.0 * a_pivot.body_arm),
                1e-12, 0.0);
}

static void fixed_cars_do_not_fold(void **state) {
    (void)state;
    Train train = equal_train(3);
    train.car[0].spring = train.car[1].spring = 0.0;
    fold(&train);
    assert_true(isnan(train.force[0]));
    assert_true(train.force[1] > 0.0);
    train.strut[1].length = 0.0;
    fold(&train);
    assert_true(isnan(train.force[0]) && isnan(train.force[1]));
}

/* An end mass that is guided stiffly is a part of the body. */
static void a_pivot_on_a_stiff_end_is_one_on_the_body(void **state) {
    (void)state;
    Train body = equal_train(4), end = equal_train(4);
    for (int side = 0; side < 2; side++) {
        CzChainPivot *pivot = &end.strut[1].pivot[side];
        pivot->body_arm = 9.5;
        pivot->end_arm = 0.7;
        pivot->end_guide = pivot->end_fold = 1e14;
    }
    fold(&body);
    fold(&end);
    for (int i = 0; i < 3; i++)
        assert_near(end.force[i], body.force[i], 1e-6, 0.0);
}

/* ---- the energy of the exact geometry ---- */

/* Unknowns of a chain: z and pitch of each car, then of an end mass at each side of each strut. */
static double *of_end(double *u, const Train *train, int strut, int side) {
    return &u[2 * train->n_car + 4 * strut + 2 * side];
}

/* Place of a pivot from the middle of its car in its rest position; springs of its end mass are
 * added to *energy. */
static void pivot_at(const Train *train, double *u, int strut, int side, double at[2], double *turn,
                     double *energy) {
    const CzChainPivot *pivot = &train->strut[strut].pivot[side];
    const bool held = train->car[strut + side].spring == 0.0;
    const double *body = &u[2 * (strut + side)], *end = of_end(u, train, strut, side);
    const double s = side == 0 ? 1.0 : -1.0;
    const double z = held ? 0.0 : body[0], pitch = held ? 0.0 : body[1];
    double across = 0.0;
    *turn = pitch;
    if (pivot->end_guide > 0.0) {
        across = end[0];
        *turn = pitch + end[1];
        *energy +=
            0.5 * pivot->end_guide * end[0] * end[0] + 0.5 * pivot->end_fold * end[1] * end[1];
    } else /* no unknown of this chain */
        *energy += 0.5e6 * (end[0] * end[0] + end[1] * end[1]);
    at[0] =
        s * pivot->body_arm * cos(pitch) - across * sin(pitch) + s * pivot->end_arm * cos(*turn);
    at[1] = z + s * pivot->body_arm * sin(pitch) + across * cos(pitch) +
            s * pivot->end_arm * sin(*turn);
}

/* Elastic energy less the work of a force that pushes every pair of pivots apart and both ends of
 * the train inwards. */
static double energy_of(const Train *train, double *u, double force) {
    double energy = 0.0;
    for (int car = 0; car < train->n_car; car++)
        for (int bogie = -1; bogie <= 1; bogie += 2) {
            const double spring = train->car[car].spring > 0.0 ? train->car[car].spring : 1e6;
            const double lift = u[2 * car] + bogie * train->car[car].half_spacing * u[2 * car + 1];
            energy += 0.5 * spring * lift * lift;
        }
    for (int i = 0; i < train->n_car - 1; i++) {
        const CzChainStrut *strut = &train->strut[i];
        double a[2], b[2], turn[2];
        pivot_at(train, u, i, 0, a, &turn[0], &energy);
        pivot_at(train, u, i, 1, b, &turn[1], &energy);
        const double reach = strut->length + strut->pivot[0].body_arm + strut->pivot[0].end_arm +
                             strut->pivot[1].body_arm + strut->pivot[1].end_arm;
        const double dx = reach + b[0] - a[0], dz = strut->tilts ? b[1] - a[1] : 0.0;
        for (int side = 0; side < 2; side++) {
            const double swing = atan2(dz, dx) - turn[side];
            energy += 0.5 * strut->pivot[side].hinge * swing * swing;
        }
        energy -= force * (sqrt(dx * dx + dz * dz) - strut->length);
        for (int side = 0; side < 2; side++) { /* outer ends, as far out as the inner ones */
            const int car = i + side;
            if (car != 0 && car != train->n_car - 1)
                continue;
            const double arm = strut->pivot[side].body_arm + strut->pivot[side].end_arm;
            if (train->car[car].spring > 0.0)
                energy += force * arm * cos(u[2 * car + 1]);
        }
    }
    return energy;
}

/* Whether the energy has a minimum at rest: its second differences are positive definite. */
static bool is_stable(const Train *train, double force) {
    enum { MAX_UNKNOWN = 64 };
    double u[MAX_UNKNOWN] = {0};
    static double hessian[MAX_UNKNOWN * MAX_UNKNOWN];
    const int n = 2 * train->n_car + 4 * (train->n_car - 1);
    const double h = 1e-4;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double sum = 0.0;
            for (int corner = 0; corner < 4; corner++) {
                const double si = corner & 1 ? 1.0 : -1.0, sj = corner & 2 ? 1.0 : -1.0;
                u[i] += si * h;
                u[j] += sj * h;
                sum += si * sj * energy_of(train, u, force);
                u[i] = u[j] = 0.0;
            }
            hessian[i * n + j] = sum / (4.0 * h * h);
        }
    return cz_symmetric_factor(n, hessian);
}

static void assert_folds_where_its_energy_says(Train *train) {
    fold(train);
    const double force = lowest(train);
    assert_true(is_stable(train, 0.9995 * force));
    assert_false(is_stable(train, 1.0005 * force));
}

static void unlike_cars_fold_where_their_energy_loses_its_minimum(void **state) {
    (void)state;
    Train train = equal_train(5);
    train.car[1] = (CzChainCar){.spring = 0.5e6, .half_spacing = 8.5};
    train.car[3] = (CzChainCar){.spring = 0.9e6, .half_spacing = 7.0};
    train.strut[0].pivot[0].body_arm = 10.6;
    train.strut[1].length = 3.0;
    train.strut[1].pivot[0].hinge = 0.1e6;
    train.strut[2].length = 1.7;
    train.strut[2].pivot[1].body_arm = 9.0;
    assert_folds_where_its_energy_says(&train);
}

static void cars_with_pivots_on_their_ends_fold_there_too(void **state) {
    (void)state;
    Train train = equal_train(4);
    train.strut[1].pivot[0] = (CzChainPivot){0.6e6, 9.2, 1.0, 8e6, 9e6};
    train.strut[1].pivot[1] = (CzChainPivot){0.3e6, 9.4, 1.3, 20e6, 30e6};
    train.strut[2].pivot[1] = (CzChainPivot){0.6e6, 9.2, 0.8, 30e6, 5e6};
    assert_folds_where_its_energy_says(&train);
    Train body = equal_train(4);
    fold(&body);
    assert_true(lowest(&train) < 0.97 * lowest(&body));
}

static void trains_against_a_wall_or_a_held_body_fold_at_their_energy_minimum(void **state) {
    (void)state;
    Train train = equal_train(4);
    train.car[3].spring = 0.0;
    assert_folds_where_its_energy_says(&train);
    train.strut[2].tilts = false;
    assert_folds_where_its_energy_says(&train);
}

/* ---- each strut has the lowest shape that belongs to it ---- */

/* Eight struts away; a shape falls by more than half from strut to strut. */
static void a_soft_strut_does_not_change_a_distant_one(void **state) {
    (void)state;
    Train train = equal_train(12), alone = equal_train(12);
    train.strut[9].pivot[0].hinge = train.strut[9].pivot[1].hinge = 0.1e6;
    fold(&alone);
    fold(&train);
    assert_true(train.force[9] < 0.75 * alone.force[9]);
    assert_near(train.force[1], alone.force[1], pow(0.5, 8.0), 0.0);
}

static void all_struts_of_a_train_of_equal_cars_fold_together(void **state) {
    (void)state;
    Train train = equal_train(6);
    fold(&train);
    for (int i = 0; i < 5; i++)
        assert_near(train.force[i], lowest(&train), ROUNDING_OF_A_SUM, 0.0);
}

static void unconnected_parts_of_a_chain_are_independent(void **state) {
    (void)state;
    Train train = equal_train(6), half = equal_train(3);
    train.strut[2].length = 0.0;
    train.car[5].spring = 0.4e6;
    fold(&train);
    fold(&half);
    assert_true(isnan(train.force[2]));
    assert_near(train.force[0], half.force[0], ROUNDING_OF_A_SUM, 0.0);
    assert_near(train.force[1], half.force[1], ROUNDING_OF_A_SUM, 0.0);
    assert_true(train.force[4] < half.force[1]);
}

/* Largest relative change of any strut's force from one of n_step hinges to the next. */
static double largest_change(int n_step) {
    double before[5] = {0}, largest = 0.0;
    for (int step = 0; step <= n_step; step++) {
        Train train = equal_train(6);
        train.car[3].spring = 0.6e6;
        for (int side = 0; side < 2; side++)
            train.strut[4].pivot[side].hinge = 0.1e6 + 1.0e6 * step / n_step;
        fold(&train);
        for (int i = 0; i < 5; i++) {
            if (step > 0)
                largest = fmax(largest, fabs(train.force[i] / before[i] - 1.0));
            before[i] = train.force[i];
        }
    }
    return largest;
}

/* At a quarter of the distance the largest change falls to a quarter; over a jump it would not. */
static void the_force_has_no_jump_where_another_shape_takes_over(void **state) {
    (void)state;
    const double coarse = largest_change(1000), fine = largest_change(4000);
    if (getenv("CZ_TOL_SCALE") != NULL)
        print_message("largest change %g, at a quarter of the distance %g\n", coarse, fine);
    assert_true(fine < 0.3 * coarse);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_cars_fold_at_their_closed_form),
        cmocka_unit_test(longer_trains_approach_the_sawtooth_of_an_infinite_chain),
        cmocka_unit_test(a_car_against_a_wall_rotates_between_its_pivots),
        cmocka_unit_test(fixed_cars_do_not_fold),
        cmocka_unit_test(a_pivot_on_a_stiff_end_is_one_on_the_body),
        cmocka_unit_test(unlike_cars_fold_where_their_energy_loses_its_minimum),
        cmocka_unit_test(cars_with_pivots_on_their_ends_fold_there_too),
        cmocka_unit_test(trains_against_a_wall_or_a_held_body_fold_at_their_energy_minimum),
        cmocka_unit_test(a_soft_strut_does_not_change_a_distant_one),
        cmocka_unit_test(all_struts_of_a_train_of_equal_cars_fold_together),
        cmocka_unit_test(unconnected_parts_of_a_chain_are_independent),
        cmocka_unit_test(the_force_has_no_jump_where_another_shape_takes_over),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
