/* Faces that have rotated with their ends form a ramp: direction and size of their force, by hand.
 */
#include "physics/motion.h"

#define TURN 0.12 /* of an end [rad] */

/* One pair of faces without ribs, friction 0.2, apart. */
static Motion faces_apart(void) {
    Motion motion =
        motion_open("problems/two-cars-25kmh.yaml", WITH("parts.anti-climber.rib_strength_kN=0",
                                                         "parts.anti-climber.friction=0.2"));
    motion_start(&motion);
    for (int car = 0; car < 2; car++)
        for (int dof = 0; dof < CZ_N_DOF; dof++)
            *velocity(&motion, dof, car) = 0.0;
    return motion;
}

/* Turns the front end of car A and the rear end of car B, nose-up for a car that faces +x. */
static void turn(Motion *motion, double a, double b) {
    *position(motion, CZ_DOF(end[1].pitch), 0) = a;
    *position(motion, CZ_DOF(end[0].pitch), 1) = b;
}

static void move(Motion *motion, int axis, double travel) {
    *position(motion, (axis == 0 ? CZ_DOF(body.x) : CZ_DOF(body.z)), 0) += travel;
    *position(motion, (axis == 0 ? CZ_DOF(end[0].x) : CZ_DOF(end[0].z)), 0) += travel;
    *position(motion, (axis == 0 ? CZ_DOF(end[1].x) : CZ_DOF(end[1].z)), 0) += travel;
    motion_evaluate(motion);
}

/* Slope of the faces' force on the end of car A: vertical over horizontal. All other forces on the
 * end are the same when the faces are apart. */
static double slope_of_push(double a, double b, double slide) {
    double fx[2], fz[2];
    for (int touch = 0; touch < 2; touch++) {
        Motion motion = faces_apart();
        turn(&motion, a, b);
        /* Couplers do not act on an end mass here. */
        const double gap = *parameter(&motion, CZ_PARAMETER(face.contact.distance), 0);
        move(&motion, 0, touch ? gap + 0.05 : gap - 0.05);
        move(&motion, 1, slide);
        fx[touch] = force(&motion, CZ_DOF(end[1].x), 0);
        fz[touch] = force(&motion, CZ_DOF(end[1].z), 0);
        motion_close(&motion);
    }
    return (fz[1] - fz[0]) / (fx[1] - fx[0]);
}

static double ramp_of(double a, double b) {
    Motion motion = faces_apart();
    turn(&motion, a, b);
    move(&motion, 0, *parameter(&motion, CZ_PARAMETER(face.contact.distance), 0) + 0.05);
    const double ramp = cz_block_of(motion.dynamics, 0)->published.face.ramp[0];
    motion_close(&motion);
    return ramp;
}

/* Faces that rotate as mirror images have an upright mean; a single one gives half its rotation.
 * The slope of a face is the tangent of its rotation. */
static void the_ramp_is_the_mean_rotation_of_the_faces(void **state) {
    (void)state;
    assert_near(ramp_of(0.0, 0.0), 0.0, 0.0, 1e-15);
    assert_near(ramp_of(TURN, TURN), tan(TURN), 1e-12, 0.0);
    assert_near(ramp_of(-TURN, -TURN), tan(TURN), 1e-12, 0.0);
    assert_near(ramp_of(TURN, 0.0), tan(TURN / 2), 1e-12, 0.0);
    assert_near(ramp_of(TURN, -TURN), 0.0, 0.0, 1e-15);
}

/* A body on an incline: its force is inclined by the slope minus or plus the angle of friction,
 * depending on the direction of sliding. The difference of two forces loses some digits. */
static void the_force_on_a_sliding_face_is_inclined_by_the_angle_of_friction(void **state) {
    (void)state;
    const double incline = TURN, friction = atan(0.2);
    assert_near(slope_of_push(TURN, TURN, 0.03), tan(incline + friction), 1e-9, 0.0);
    assert_near(slope_of_push(TURN, TURN, -0.03), tan(incline - friction), 1e-9, 0.0);
    assert_near(slope_of_push(0.0, 0.0, 0.03), tan(friction), 1e-9, 0.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ramp_is_the_mean_rotation_of_the_faces),
        cmocka_unit_test(the_force_on_a_sliding_face_is_inclined_by_the_angle_of_friction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
