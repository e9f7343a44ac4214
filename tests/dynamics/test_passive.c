/* No element creates energy: springs pass closed loops and return the work done on them.
 */
#include "physics/motion.h"

#include <math.h>

#include "dynamics/stored.h"

enum { N_STEP = 20000 };

static double work_of(const Motion *motion, int row) {
    return work_at(motion, row, 0);
}

/* A degree of freedom of the first car with the motion size * sin(phase + shift). */
typedef struct Leads {
    int dof;
    double size, shift;
} Leads;

enum { MAX_LEADS = 6 };

/* Puts the car at its place in step `i` of a loop, everything else at rest. */
static void lead_car(const Motion *motion, const Leads leads[MAX_LEADS], int i) {
    const double pi = 3.14159265358979323846, rate = 2.0 * pi / (N_STEP * motion->step);
    for (int dof = 0; dof < CZ_N_DOF; dof++)
        *position(motion, dof, 0) = *velocity(motion, dof, 0) = 0.0;
    for (int k = 0; k < MAX_LEADS && leads[k].size > 0.0; k++) {
        const double phase = 2.0 * pi * i / N_STEP + leads[k].shift;
        *position(motion, leads[k].dof, 0) = leads[k].size * (sin(phase) - sin(leads[k].shift));
        *velocity(motion, leads[k].dof, 0) = leads[k].size * rate * cos(phase);
    }
}

/* Moves a standing car around a loop: the work on two rows of the ledger rises and returns. The
 * error of the trapezoidal rule over 20,000 steps of a loop is some 1e-7 of this work, a little
 * more at the breakpoints of the springs. */
static void check_loop(const Leads leads[MAX_LEADS], const int rows[2]) {
    Motion motion = motion_open("tests/physics/cases/standing.yaml", AS_WRITTEN);
    motion_start(&motion);
    double largest[2] = {0.0}, before[2] = {0.0};
    for (int i = 0; i <= N_STEP; i++) {
        motion_advance(&motion);
        lead_car(&motion, leads, i);
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

/* The front bogie turns by up to a radian each way while its body and its axles move out of step
 * with it. */
static void springs_of_a_pitching_bogie_return_their_work(void **state) {
    (void)state;
    static const int rows[] = {CZ_LEDGER(primary), CZ_LEDGER(axle_guidance)};
    static const Leads leads[MAX_LEADS] = {{CZ_DOF(bogie[1].pitch), 1.0, 0.3},
                                           {CZ_DOF(bogie[1].x), 0.02, 1.9},
                                           {CZ_DOF(bogie[1].z), 0.03, 4.0},
                                           {CZ_DOF(wheelset[2].z), 0.04, 2.5},
                                           {CZ_DOF(wheelset[3].x), 0.02, 5.0}};
    check_loop(leads, rows);
}

/* The body turns by up to a fifth of a radian each way while its front bogie moves out of step. */
static void springs_of_a_pitching_body_return_their_work(void **state) {
    (void)state;
    static const int rows[] = {CZ_LEDGER(secondary), CZ_LEDGER(link)};
    static const Leads leads[MAX_LEADS] = {{CZ_DOF(body.pitch), 0.2, 0.3},
                                           {CZ_DOF(body.x), 0.02, 5.0},
                                           {CZ_DOF(bogie[1].pitch), 0.1, 2.5},
                                           {CZ_DOF(bogie[1].x), 0.05, 1.9},
                                           {CZ_DOF(bogie[1].z), 0.1, 4.0}};
    check_loop(leads, rows);
}

/* An end mass that is pushed up and returns stores k z^2 / 2 in its guidance at every step, to
 * rounding; a sum of power over time would end below zero. */
static void guidance_of_an_end_mass_stores_the_energy_of_its_displacement(void **state) {
    (void)state;
    Motion motion = motion_open("tests/physics/cases/standing.yaml", AS_WRITTEN);
    motion_start(&motion);
    const double stiffness = *parameter(&motion, CZ_PARAMETER(end[1].guide_vertical.stiffness), 0);
    static const Leads leads[MAX_LEADS] = {{CZ_DOF(end[1].z), 0.01, 1.0}};
    for (int i = 0; i <= N_STEP; i++) {
        motion_advance(&motion);
        lead_car(&motion, leads, i);
        motion_evaluate(&motion);
        const double across = *position(&motion, CZ_DOF(end[1].z), 0);
        const double stored = 0.5 * stiffness * across * across;
        CzStored found = {0};
        cz_stored_fill(motion.dynamics, 0, &found);
        assert_near(found.guide[1], stored, 1e-12, 1e-12 * stored);
    }
    motion_close(&motion);
}

/* Two cars whose couplers only push close to some 9 mm and part again while one of them turns out
 * of step with that, so that their faces part at another angle than that at which they met. The
 * hinges return the work of the push that flattens the faces, and store the work done on them,
 * within (2 pi h)^2 of the trapezoidal rule; moments stay below the hinges' capacity. */
static void hinges_of_faces_that_meet_at_an_angle_return_their_work(void **state) {
    (void)state;
    enum { OWN = 1, N_CAR = 4 };
    Motion motion = motion_open("tests/physics/cases/offset-collision.yaml", AS_WRITTEN);
    motion_start(&motion);
    const double reach = *parameter(&motion, CZ_PARAMETER(coupler.pivot.distance), OWN) -
                         *parameter(&motion, CZ_PARAMETER(coupler.length), OWN);
    const double pi = 3.14159265358979323846;
    double largest = 0.0, worst = 0.0;
    for (int i = 0; i <= N_STEP; i++) {
        motion_advance(&motion);
        for (int car = 0; car < N_CAR; car++)
            for (int dof = 0; dof < CZ_N_DOF; dof++)
                *position(&motion, dof, car) = *velocity(&motion, dof, car) = 0.0;
        const double phase = 2.0 * pi * i / N_STEP, rate = 2.0 * pi / (N_STEP * motion.step);
        *position(&motion, CZ_DOF(body.x), OWN) = reach + 0.003 - 0.006 * cos(phase);
        *velocity(&motion, CZ_DOF(body.x), OWN) = 0.006 * rate * sin(phase);
        *position(&motion, CZ_DOF(body.pitch), OWN) = 2e-3 * sin(phase + 1.0);
        *velocity(&motion, CZ_DOF(body.pitch), OWN) = 2e-3 * rate * cos(phase + 1.0);
        motion_evaluate(&motion);
        CzStored found = {0};
        cz_stored_fill(motion.dynamics, OWN, &found);
        const double stored = found.hinge[0] + found.hinge[1];
        double work = 0.0;
        for (int side = 0; side < 2; side++)
            work += work_at(&motion, CZ_LEDGER(hinge[side]), OWN);
        largest = fmax(largest, stored);
        worst = fmax(worst, fabs(work - stored));
    }
    assert_true(largest > 1.0);
    assert_near(worst, 0.0, 0.0, 2e-7 * largest);
    motion_close(&motion);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(springs_of_a_pitching_bogie_return_their_work),
        cmocka_unit_test(springs_of_a_pitching_body_return_their_work),
        cmocka_unit_test(hinges_of_faces_that_meet_at_an_angle_return_their_work),
        cmocka_unit_test(guidance_of_an_end_mass_stores_the_energy_of_its_displacement),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
