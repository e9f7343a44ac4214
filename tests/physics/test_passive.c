/* No element gives energy: springs are led around closed loops, and give back what they took. */
#include "physics/motion.h"

#include <math.h>

#include "dynamics/stored.h"

enum { N_STEP = 20000 };

static double work_of(const Motion *motion, int row) {
    return cz_block_of(motion->dynamics, 0)->work[row][0];
}

/* Leads a degree of freedom of the first car along size * sin(phase + shift). */
static void lead(const Motion *motion, int dof, double size, double shift, int i) {
    const double pi = 3.14159265358979323846;
    const double phase = 2.0 * pi * i / N_STEP + shift, rate = 2.0 * pi / (N_STEP * motion->step);
    *position(motion, dof, 0) = size * (sin(phase) - sin(shift));
    *velocity(motion, dof, 0) = size * rate * cos(phase);
}

/* The front bogie turns by up to a radian each way while its body and its axles move out of step
 * with it. The trapezoidal rule over 20,000 steps of a loop is off by some 1e-7 of what goes in and
 * out, the springs' kinks by a little more. */
static void springs_of_a_bogie_that_turns_give_back_what_they_took(void **state) {
    (void)state;
    static const int rows[] = {CZ_L_PRIMARY, CZ_L_AXLE_GUIDANCE};
    Motion motion = motion_open("tests/physics/cases/standing.yaml", AS_WRITTEN);
    motion_start(&motion);
    double largest[2] = {0.0}, before[2] = {0.0};
    for (int i = 0; i <= N_STEP; i++) {
        motion_advance(&motion);
        for (int dof = 0; dof < CZ_N_DOF; dof++)
            *position(&motion, dof, 0) = *velocity(&motion, dof, 0) = 0.0;
        lead(&motion, CZ_DOF_BOGIE_PITCH_FRONT, 1.0, 0.3, i);
        lead(&motion, CZ_DOF_BOGIE_X_FRONT, 0.02, 1.9, i);
        lead(&motion, CZ_DOF_BOGIE_Z_FRONT, 0.03, 4.0, i);
        lead(&motion, CZ_DOF_WHEEL_Z_2, 0.04, 2.5, i);
        lead(&motion, CZ_DOF_WHEEL_X_3, 0.02, 5.0, i);
        motion_evaluate(&motion);
        for (int k = 0; k < 2; k++) {
            before[k] = i == 0 ? work_of(&motion, rows[k]) : before[k];
            largest[k] = fmax(largest[k], fabs(work_of(&motion, rows[k]) - before[k]));
        }
    }
    for (int k = 0; k < 2; k++) {
        assert_true(largest[k] > 1e4);
        assert_near(work_of(&motion, rows[k]), before[k], 0.0, 1e-5 * largest[k]);
    }
    motion_close(&motion);
}

/* The body turns by up to a fifth of a radian each way while its front bogie moves out of step. */
static void springs_of_a_body_that_turns_give_back_what_they_took(void **state) {
    (void)state;
    static const int rows[] = {CZ_L_SECONDARY, CZ_L_LINK};
    Motion motion = motion_open("tests/physics/cases/standing.yaml", AS_WRITTEN);
    motion_start(&motion);
    double largest[2] = {0.0}, before[2] = {0.0};
    for (int i = 0; i <= N_STEP; i++) {
        motion_advance(&motion);
        for (int dof = 0; dof < CZ_N_DOF; dof++)
            *position(&motion, dof, 0) = *velocity(&motion, dof, 0) = 0.0;
        lead(&motion, CZ_DOF_BODY_PITCH, 0.2, 0.3, i);
        lead(&motion, CZ_DOF_BODY_X, 0.02, 5.0, i);
        lead(&motion, CZ_DOF_BOGIE_PITCH_FRONT, 0.1, 2.5, i);
        lead(&motion, CZ_DOF_BOGIE_X_FRONT, 0.05, 1.9, i);
        lead(&motion, CZ_DOF_BOGIE_Z_FRONT, 0.1, 4.0, i);
        motion_evaluate(&motion);
        for (int k = 0; k < 2; k++) {
            before[k] = i == 0 ? work_of(&motion, rows[k]) : before[k];
            largest[k] = fmax(largest[k], fabs(work_of(&motion, rows[k]) - before[k]));
        }
    }
    for (int k = 0; k < 2; k++) {
        assert_true(largest[k] > 1e4);
        assert_near(work_of(&motion, rows[k]), before[k], 0.0, 1e-5 * largest[k]);
    }
    motion_close(&motion);
}

/* An end mass that is pushed up and comes back holds k z^2 / 2 in its guidance all the while, to
 * the rounding of that: what is added up of powers would leave less than nothing. */
static void guidance_of_an_end_mass_stores_what_its_displacement_says(void **state) {
    (void)state;
    Motion motion = motion_open("tests/physics/cases/standing.yaml", AS_WRITTEN);
    motion_start(&motion);
    const double stiffness = *parameter(&motion, CZ_P_GUIDE_STIFFNESS_FRONT, 0);
    for (int i = 0; i <= N_STEP; i++) {
        motion_advance(&motion);
        for (int dof = 0; dof < CZ_N_DOF; dof++)
            *position(&motion, dof, 0) = *velocity(&motion, dof, 0) = 0.0;
        lead(&motion, CZ_DOF_END_Z_FRONT, 0.01, 1.0, i);
        motion_evaluate(&motion);
        const double across = *position(&motion, CZ_DOF_END_Z_FRONT, 0);
        const double stored = 0.5 * stiffness * across * across;
        assert_near(cz_guide_stored(motion.dynamics, 0, 1), stored, 1e-12, 1e-12 * stored);
    }
    motion_close(&motion);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(springs_of_a_bogie_that_turns_give_back_what_they_took),
        cmocka_unit_test(springs_of_a_body_that_turns_give_back_what_they_took),
        cmocka_unit_test(guidance_of_an_end_mass_stores_what_its_displacement_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
