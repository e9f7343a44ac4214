/* Series chains: of several equilibria the one of slow closing, and members that satisfy their
 * laws. */
#include "support/check.h"

#include <math.h>

#include "physics/collision.h"
#include "support/shipped.h"

/* Two rigid cars whose ends meet: a first stage shorter than a step, and a second stage whose force
 * falls. Forces in kN, strokes in mm. */
typedef struct Ends {
    double speed;   /* of A [m/s]; B stands */
    double first;   /* force of the first stage of both */
    double stroke;  /* of it */
    double last[2]; /* force at the end of the second stage, front of A and rear of B */
    double step;    /* [s]; 0: the model's own */
} Ends;

enum { SECOND_STROKE = 1000, MASS_T = 30 };

static Collision meet(const Ends *ends) {
    char text[2048];
    const int n = snprintf(
        text, sizeof text,
        "schema: 1\n"
        "title: ends in series\n"
        "simulation: {track: rigid}\n"
        "parts:\n"
        "  car: {model: rigid, mass_t: %d}\n"
        "trains:\n"
        "  - {name: A, speed_m_s: %.17g, vehicles: [{use: car, front: {face_gap_mm: 0, "
        "unloading_stiffness_MN_m: 1e4, stages: [{stroke_mm: %.17g, force_kN: %.17g}, "
        "{stroke_mm: %d, force_kN: %.17g}]}}]}\n"
        "  - {name: B, vehicles: [{use: car, rear: {face_gap_mm: 0, unloading_stiffness_MN_m: 1e4, "
        "stages: [{stroke_mm: %.17g, force_kN: %.17g}, {stroke_mm: %d, force_kN: %.17g}]}}]}\n",
        MASS_T, ends->speed, ends->stroke, ends->first, SECOND_STROKE, ends->last[0], ends->stroke,
        ends->first, SECOND_STROKE, ends->last[1]);
    assert_true(n > 0 && (size_t)n < sizeof text);
    const CzProblemOptions options = cz_problem_options_default();
    CzSimulateOptions how = cz_simulate_options_default();
    how.time_step = ends->step;
    Collision collision = {0};
    CzError error = {0};
    if (cz_problem_read_text(text, (size_t)n, "ends", ".", &options, &collision.problem, &error) !=
            CZ_OK ||
        cz_model_build(collision.problem, 0, &collision.model, &error) != CZ_OK ||
        cz_simulate(collision.model, &how, &collision.run, &error) != CZ_OK)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    collision.summary = cz_run_summary(collision.run);
    return collision;
}

/* Stroke at which the weaker end has absorbed an energy: F s + F x - k x^2 / 2 with the slope k of
 * the second stage. */
static double stroke_for(const Ends *ends, double weaker_last, double energy) {
    const double first = 1e3 * ends->first, stroke = 1e-3 * ends->stroke;
    const double slope = (first - 1e3 * weaker_last) / (1e-3 * SECOND_STROKE);
    const double left = energy - first * stroke;
    return stroke + (first - sqrt(first * first - 2.0 * slope * left)) / slope;
}

/* The stronger end absorbs at most its first stage, F s; this share and some 0.1 mm of elastic rise
 * are the tolerance of the closed form. */
static void check_weaker_is_crushed(const Ends *ends) {
    Collision collision = meet(ends);
    const CzInterfaceResult *interface = &collision.summary->interface[0];
    const int weaker = ends->last[0] < ends->last[1] ? 0 : 1;
    const double energy = 0.25 * 1e3 * MASS_T * ends->speed * ends->speed;
    const double of_stage = ends->first * ends->stroke; /* [J] */
    assert_string_equal(collision.summary->failure, "");
    assert_int_equal(interface->n_element, 2);
    const CzElementResult *crushed = &interface->element[weaker],
                          *kept = &interface->element[1 - weaker];
    /* Both ends return F^2 / 2 k, and the cars part with this energy. */
    const double elastic = 1e6 * ends->first * ends->first / 1e10;
    assert_near(interface->energy, energy, 1e-3, elastic);
    assert_near(crushed->energy, energy - 0.5 * of_stage, 0.0,
                0.5 * of_stage + 1e-3 * energy + elastic);
    assert_true(kept->energy >= -1e-6 * energy && kept->energy <= of_stage);
    assert_true(kept->stroke <= 1.1e-3 * ends->stroke);
    const double most = stroke_for(ends, ends->last[weaker], energy);
    const double least = stroke_for(ends, ends->last[weaker], energy - of_stage - elastic);
    assert_true(crushed->stroke <= most + 3e-4 && crushed->stroke >= least - 3e-4);
    assert_true(interface->shortening >= crushed->stroke);
    assert_true(interface->shortening <= crushed->stroke + kept->stroke + 3e-4);
    collision_free(&collision);
}

static void of_two_ends_in_series_the_one_that_falls_deeper_is_crushed(void **state) {
    (void)state;
    const double speeds[] = {3.0, 5.5, 8.0, 10.0};
    const double strokes[] = {0.3, 1.0, 4.0, 30.0};
    for (size_t i = 0; i < sizeof speeds / sizeof *speeds; i++)
        for (size_t k = 0; k < sizeof strokes / sizeof *strokes; k++)
            check_weaker_is_crushed(&(Ends){speeds[i], 1600.0, strokes[k], {1100.0, 1250.0}, 0.0});
}

static void the_same_end_is_crushed_on_the_other_side(void **state) {
    (void)state;
    check_weaker_is_crushed(&(Ends){9.0, 1600.0, 1.0, {1250.0, 1100.0}, 0.0});
    check_weaker_is_crushed(&(Ends){9.0, 1600.0, 0.4, {1250.0, 1100.0}, 0.0});
}

static void the_end_that_is_crushed_does_not_depend_on_the_step(void **state) {
    (void)state;
    const double steps[] = {1e-4, 3e-5, 1e-5};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        check_weaker_is_crushed(&(Ends){9.0, 1600.0, 1.0, {1100.0, 1250.0}, steps[i]});
}

/* The weaker end falls up to its stop; the other one then begins to fall in the same step. Until
 * then the stronger end has absorbed its first stage at most; the stop deflects by some 0.1 mm. */
static void once_the_weaker_end_has_bottomed_out_the_other_one_is_crushed(void **state) {
    (void)state;
    const Ends ends = {8.0, 450.0, 1.0, {340.0, 260.0}, 2e-4};
    const double total = 1e-3 * (ends.stroke + SECOND_STROKE);
    for (double speed = 8.0; speed < 9.0; speed += 0.1) {
        Ends faster = ends;
        faster.speed = speed;
        Collision collision = meet(&faster);
        const CzInterfaceResult *interface = &collision.summary->interface[0];
        const double energy = 0.25 * 1e3 * MASS_T * speed * speed;
        const double of_stop = 500.0 * (ends.first + ends.last[1]) * 1e-3 * SECOND_STROKE;
        assert_string_equal(collision.summary->failure, "");
        assert_near(interface->element[1].stroke, total, 0.0, 2e-3);
        const double left = energy - of_stop, of_stage = ends.first * ends.stroke;
        assert_true(interface->element[0].stroke <=
                    stroke_for(&faster, ends.last[0], left + of_stage) + 3e-4);
        assert_true(interface->element[0].stroke >=
                    stroke_for(&faster, ends.last[0], left - of_stage) - 2e-3);
        collision_free(&collision);
    }
}

/* A chain is solved until each member is within 1 N of its law. */
static void members_of_chains_satisfy_their_laws_within_a_newton(void **state) {
    (void)state;
    const Shipped shipped = shipped_problems();
    for (int i = 0; i < shipped.n; i++) {
        char path[SHIPPED_SIZE + 16];
        snprintf(path, sizeof path, "problems/%s", shipped.name[i]);
        Collision collision = collide(path, WITH("simulation.duration_s=1"), 0);
        double weakest = INFINITY;
        for (int k = 0; k < collision.summary->n_interface; k++)
            weakest = fmin(weakest, fmax(1e4, collision.summary->interface[k].peak_force));
        assert_string_equal(collision.summary->failure, "");
        assert_true(collision.summary->law_error <= 1.0 / weakest);
        collision_free(&collision);
    }
}

/* A crush zone whose force falls faster than the anti-climber in front of it can follow, against a
 * wall: along the elastic line through (x_1, F_1) it snaps to where its last stage meets that line.
 * The area between the line and the backbone is dissipated by the zone. F_1 is known to within the
 * rise of the force in a step. */
static void a_zone_that_snaps_dissipates_what_the_elasticity_released(void **state) {
    (void)state;
    static const char text[] =
        "schema: 1\n"
        "title: a zone that snaps\n"
        "simulation: {track: rigid}\n"
        "trains:\n"
        "  - name: A\n"
        "    speed_m_s: 10\n"
        "    vehicles:\n"
        "      - model: rigid\n"
        "        mass_t: 30\n"
        "        front:\n"
        "          face_gap_mm: 300\n"
        "          unloading_stiffness_MN_m: 200\n"
        "          stages: [{stroke_mm: 20, force_kN: 2000}, {stroke_mm: 20, force_kN: 1000}, "
        "{stroke_mm: 500, force_kN: 3000}]\n"
        "          anti_climber: {gap_mm: 0, stiffness_MN_m: 10, stages: [{stroke_mm: 100, "
        "force_kN: 9000}]}\n"
        "  - {name: W, vehicles: [{model: fixed}]}\n";
    const CzProblemOptions options = cz_problem_options_default();
    const CzSimulateOptions how = cz_simulate_options_default();
    Collision collision = {0};
    CzError error = {0};
    if (cz_problem_read_text(text, sizeof text - 1, "snap", ".", &options, &collision.problem,
                             &error) != CZ_OK ||
        cz_model_build(collision.problem, 0, &collision.model, &error) != CZ_OK ||
        cz_simulate(collision.model, &how, &collision.run, &error) != CZ_OK)
        fail_msg("%s:%d: %s", error.file, error.line, error.message);
    collision.summary = cz_run_summary(collision.run);
    assert_completed(&collision);
    assert_true(collision.summary->energy.balance_error < 1e-4);
    const double elastic = 10e6, rise = 2000e3 / 0.5, fall_end = 0.04, top = 2000e3;
    const double landed = (top + elastic * 0.02 - 1000e3 + rise * fall_end) / (rise + elastic);
    const double force = top - elastic * (landed - 0.02);
    const double line = 0.5 * (top + force) * (landed - 0.02);
    const double backbone = 1500e3 * 0.02 + 0.5 * (1000e3 + force) * (landed - fall_end);
    const double of_step = elastic * 10.0 * collision.summary->time_step;
    const CzElementResult *element = collision.summary->interface[0].element;
    while (element->kind != CZ_ELEMENT_END)
        element++;
    assert_near(element->energy - element->tube_energy, line - backbone, 0.0,
                of_step * (landed - 0.02));
    collision_free(&collision);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_two_ends_in_series_the_one_that_falls_deeper_is_crushed),
        cmocka_unit_test(the_same_end_is_crushed_on_the_other_side),
        cmocka_unit_test(the_end_that_is_crushed_does_not_depend_on_the_step),
        cmocka_unit_test(once_the_weaker_end_has_bottomed_out_the_other_one_is_crushed),
        cmocka_unit_test(members_of_chains_satisfy_their_laws_within_a_newton),
        cmocka_unit_test(a_zone_that_snaps_dissipates_what_the_elasticity_released),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
