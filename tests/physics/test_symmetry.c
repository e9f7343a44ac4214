/* Symmetries of a collision: mirror image, speed of the observer, and a wall in place of the plane
 * between two identical cars. */
#include "physics/steps.h"

/* Results of one vehicle that are equal in the mirror image. */
static void assert_same_vehicle(const CzVehicleResult *a, const CzVehicleResult *b, double speed,
                                bool mirrored, double tolerance) {
    assert_near(a->final_speed, mirrored ? -b->final_speed : b->final_speed + speed, tolerance,
                tolerance);
    assert_near(a->peak_deceleration, b->peak_deceleration, tolerance, tolerance);
    assert_near(a->mean_deceleration_120ms, b->mean_deceleration_120ms, tolerance, tolerance);
    if (isnan(a->max_pitch)) {
        assert_true(isnan(b->max_pitch));
        return;
    }
    assert_near(a->max_pitch, b->max_pitch, tolerance, tolerance);
    assert_near(a->link_force, b->link_force, tolerance, tolerance);
    for (int wheel = 0; wheel < 4; wheel++)
        assert_near(a->wheel_lift[wheel], b->wheel_lift[mirrored ? 3 - wheel : wheel], tolerance,
                    tolerance);
}

static const CzVehicleResult *vehicle_named(const Collision *collision, const char *name) {
    for (int i = 0; i < collision->summary->n_vehicle; i++) {
        if (strcmp(collision->summary->vehicle[i].name, name) == 0)
            return &collision->summary->vehicle[i];
    }
    fail_msg("no vehicle %s", name);
    return NULL;
}

static void assert_same_interface(const CzInterfaceResult *a, const CzInterfaceResult *b,
                                  double tolerance) {
    assert_near(a->peak_force, b->peak_force, tolerance, tolerance);
    assert_near(a->shortening, b->shortening, tolerance, tolerance);
    assert_near(a->energy, b->energy, tolerance, tolerance);
}

static void assert_mirror_image(const char *file, const char *mirror_image) {
    const char *const *until = WITH("simulation.duration_s=0.4", "trains.A.brake.axle_share=1");
    Collision seen = collide(file, until, 0);
    Collision mirrored = collide(mirror_image, until, 0);
    assert_completed(&seen);
    assert_completed(&mirrored);
    for (int i = 0; i < 3; i++)
        assert_same_interface(&seen.summary->interface[i], &mirrored.summary->interface[2 - i],
                              1e-9);
    static const char *const names[] = {"A1", "A2", "B1", "B2"};
    for (int i = 0; i < 4; i++)
        assert_same_vehicle(vehicle_named(&seen, names[i]), vehicle_named(&mirrored, names[i]), 0.0,
                            true, 1e-9);
    collision_free(&seen);
    collision_free(&mirrored);
}

static void a_mirrored_collision_is_the_mirror_image(void **state) {
    (void)state;
    assert_mirror_image("tests/physics/cases/offset-collision.yaml",
                        "tests/physics/cases/offset-collision-mirrored.yaml");
}

static void a_mirrored_collision_of_unlike_ends_is_the_mirror_image(void **state) {
    (void)state;
    assert_mirror_image("tests/physics/cases/unlike-ends.yaml",
                        "tests/physics/cases/unlike-ends-mirrored.yaml");
}

/* Galileo: without friction on the rail, two trains that are both 4 m/s slower collide in the same
 * way. */
static void the_speed_of_the_observer_does_not_matter(void **state) {
    (void)state;
    static const struct {
        const char *file;
        double tolerance;
    } cases[] = {{"tests/physics/cases/rigid-pair.yaml", 1e-9},
                 {"tests/physics/cases/full-pair.yaml", 1e-9}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        Collision standing =
            collide(cases[i].file, WITH("trains.A.speed_m_s=8", "simulation.duration_s=0.4"), 0);
        Collision moving = collide(
            cases[i].file,
            WITH("trains.A.speed_m_s=4", "trains.B.speed_m_s=-4", "simulation.duration_s=0.4"), 0);
        assert_completed(&standing);
        assert_completed(&moving);
        assert_same_interface(&standing.summary->interface[0], &moving.summary->interface[0],
                              cases[i].tolerance);
        for (int car = 0; car < 2; car++)
            assert_same_vehicle(&standing.summary->vehicle[car], &moving.summary->vehicle[car], 4.0,
                                false, cases[i].tolerance);
        collision_free(&standing);
        collision_free(&moving);
    }
}

static void a_rigid_car_onto_an_identical_one_is_a_car_at_half_the_speed_into_a_wall(void **state) {
    (void)state;
    assert_rows_of(rows_of_equivalence);
}

/* The same with full cars: a wall is a mirror, so they do not differ in pitch or lift either. */
static void a_full_car_onto_an_identical_one_is_a_car_at_half_the_speed_into_a_wall(void **state) {
    (void)state;
    const char *const *set = WITH("simulation.duration_s=0.4");
    Collision pair = collide("tests/physics/cases/full-pair.yaml", set, 0);
    Collision wall = collide("tests/physics/cases/full-wall.yaml", set, 0);
    assert_completed(&pair);
    assert_completed(&wall);
    const CzInterfaceResult *two = &pair.summary->interface[0];
    const CzInterfaceResult *one = &wall.summary->interface[0];
    assert_near(one->peak_force, two->peak_force, 1e-9, 0.0);
    assert_near(one->shortening, 0.5 * two->shortening, 1e-9, 0.0);
    assert_near(one->energy, 0.5 * two->energy, 1e-9, 0.0);
    const CzVehicleResult *alone = &wall.summary->vehicle[0];
    const CzVehicleResult *first = &pair.summary->vehicle[0];
    assert_near(alone->final_speed + 4.0, first->final_speed, 1e-9, 0.0);
    assert_near(alone->link_force, first->link_force, 1e-9, 0.0);
    assert_near(alone->max_pitch, first->max_pitch, 1e-9, 0.0);
    for (int axle = 0; axle < 4; axle++)
        assert_near(alone->wheel_lift[axle], first->wheel_lift[axle], 1e-9, 1e-12);
    collision_free(&pair);
    collision_free(&wall);
}

/* Against a wall an interface has one side, and that one has all of the energy. */
static void against_a_wall_no_energy_is_missing(void **state) {
    (void)state;
    Collision wall = collide("tests/physics/cases/rigid-wall.yaml", AS_WRITTEN, 0);
    assert_completed(&wall);
    assert_near(wall.summary->interface[0].energy, wall.summary->energy.dissipated, 1e-4, 0.0);
    double sum = 0.0;
    for (int i = 0; i < wall.summary->interface[0].n_element; i++)
        sum += wall.summary->interface[0].element[i].energy;
    assert_near(sum, wall.summary->interface[0].energy, 1e-9, 0.0);
    collision_free(&wall);
}

/* Smooth faces, without ribs or friction, carry the same axial force as others: two anti-climbers
 * of 0.5 MN. */
static void faces_without_ribs_carry_their_whole_axial_force(void **state) {
    (void)state;
    Collision pair =
        collide("tests/physics/cases/full-pair.yaml", WITH("simulation.duration_s=0.2"), 0);
    assert_near(pair.summary->interface[0].peak_force, 1e6, 1e-3, 0.0);
    collision_free(&pair);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mirrored_collision_is_the_mirror_image),
        cmocka_unit_test(a_mirrored_collision_of_unlike_ends_is_the_mirror_image),
        cmocka_unit_test(the_speed_of_the_observer_does_not_matter),
        cmocka_unit_test(a_rigid_car_onto_an_identical_one_is_a_car_at_half_the_speed_into_a_wall),
        cmocka_unit_test(a_full_car_onto_an_identical_one_is_a_car_at_half_the_speed_into_a_wall),
        cmocka_unit_test(against_a_wall_no_energy_is_missing),
        cmocka_unit_test(faces_without_ribs_carry_their_whole_axial_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
