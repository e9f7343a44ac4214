/* The energy of an interface is the integral of its force over its closure, on every shipped
 * problem with damping, rate and speed factors switched on: the energy of an end or a device is
 * counted at its interface.
 */
#include "physics/collision.h"
#include "support/shipped.h"

/* Damping, rate and speed factors at every end; a share of their largest values. */
static void switch_on(CzVehicle *vehicle, double share) {
    CzEnd *const ends[2] = {&vehicle->rear, &vehicle->front};
    for (int i = 0; i < 2; i++) {
        if (!ends[i]->given)
            continue;
        const bool moves = vehicle->model != CZ_MODEL_FIXED;
        ends[i]->damping = moves ? share * 200e3 : 0.0;
        ends[i]->coupler.tube.rate_factor = share * 0.05;
        ends[i]->coupler.second_tube.rate_factor = share * 0.05;
        ends[i]->side_buffers.tube.rate_factor = share * 0.05;
        ends[i]->anti_climber.damping = share * 50e3;
        ends[i]->anti_climber.rate_factor = share * 0.05;
        ends[i]->anti_climber.speed_factor = share * 0.3;
    }
}

/* Work of forces at a height over the closure that the pitch of both cars adds there, up to its
 * largest value and half of its return: no line of force of the shipped problems is further than
 * 1.1 m from the height of a car's middle. */
static double work_of_pitch(const CzRunSummary *summary, int interface) {
    const double pitch =
        fmax(summary->vehicle[interface].max_pitch, summary->vehicle[interface + 1].max_pitch);
    const double travel = 2.0 * 1.1 * 1.5 * pitch;
    return isnan(pitch) ? 0.0 : summary->interface[interface].peak_force * travel;
}

static void check_interface(const Collision *collision, int interface) {
    const CzRunSummary *summary = collision->summary;
    const CzInterfaceResult *result = &summary->interface[interface];
    const double *force = cz_run_channel(collision->run, CZ_CHANNEL_INTERFACE_FORCE, interface);
    const double *closure = cz_run_channel(collision->run, CZ_CHANNEL_INTERFACE_CLOSURE, interface);
    const int last = n_sample(collision) - 1;
    double work = 0.0, expected = result->energy; /* [J] */
    for (int i = 1; i <= last; i++)
        work += 0.5 * (force[i] + force[i - 1]) * (closure[i] - closure[i - 1]);
    for (int k = 0; k < result->n_element; k++)
        expected += result->element[k].stored;
    /* A force that falls within a step, such as at a shear-off, is read at both ends of the step.
     */
    const double rounding = 1e-3 * summary->energy.initial;
    const double allowed = rounding + work_of_pitch(summary, interface);
    assert_near(work, expected, 0.0, allowed);
}

static void check_problem(const char *file) {
    char path[300];
    snprintf(path, sizeof path, "problems/%s", file);
    Collision collision =
        collide_changed(path,
                        WITH("simulation.track=rigid", "simulation.duration_ms=400",
                             "simulation.output_step_ms=0.1"),
                        switch_on, 1.0, 1e-4);
    assert_completed(&collision);
    for (int i = 0; i < collision.summary->n_interface; i++)
        if (!collision.summary->beyond_validity)
            check_interface(&collision, i);
    collision_free(&collision);
}

static void energies_are_the_work_of_the_forces_on_every_shipped_problem(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++)
        check_problem(shipped.name[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energies_are_the_work_of_the_forces_on_every_shipped_problem),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
