/* Events agree with the largest values of the run, and have the time at which these are reached;
 * values after an override are marked. */
#include "physics/collision.h"

#include "crushzone/evaluate.h"
#include "evaluate/metric.h"

/* Time of the first event of a kind at a place; NaN when there is none. */
static double time_of(const Collision *collision, CzEventKind what, const char *where,
                      int interface) {
    for (int i = 0; i < collision->summary->n_event; i++) {
        const CzEvent *event = &collision->summary->event[i];
        if (event->what == what && event->interface == interface &&
            strcmp(event->where, where) == 0)
            return event->time;
    }
    return NAN;
}

/* A collision for each kind of event. At 2 km/h only contact occurs in each of them.
 */
static const struct {
    const char *file, *where; /* begins with */
} happens[] = {
    [CZ_EVENT_CONTACT] = {"problems/wall.yaml", "A1-wall"},
    [CZ_EVENT_TUBE_ACTIVATION] = {"problems/wall.yaml", "coupler A1"},
    [CZ_EVENT_TUBE_EXHAUSTED] = {"problems/override-bottoming-lifts.yaml", "coupler tube B1"},
    [CZ_EVENT_SHEAR_OFF] = {"problems/wall.yaml", "coupler A1"},
    [CZ_EVENT_ANTI_CLIMBER_CONTACT] = {"problems/wall.yaml", "A1-wall"},
    [CZ_EVENT_ANTI_CLIMBER_ACTIVATION] = {"problems/wall.yaml", "anti-climber A1"},
    [CZ_EVENT_END_CRUSH] = {"problems/override-bottoming-lifts.yaml", "end A1"},
    [CZ_EVENT_SUPERSTRUCTURE_CRUSH] = {"problems/override-overlap-climbs.yaml", "superstructures"},
    [CZ_EVENT_BOTTOMED_OUT] = {"problems/wagon.yaml", "side buffers A2"},
    [CZ_EVENT_LIFT_STOP] = {"problems/override-bottoming-lifts.yaml", "rear bogie A1"},
    [CZ_EVENT_BUMP_STOP] = {"problems/override-bottoming-lifts.yaml", "front bogie A1"},
    [CZ_EVENT_SWING_STOP] = {"problems/override-hinge-folds.yaml", "coupler A2"},
    [CZ_EVENT_WHEEL_LIFT] = {"problems/override-bottoming-lifts.yaml", "wheelset 2 A1"},
    [CZ_EVENT_OVERRIDE] = {"problems/override-overlap-climbs.yaml", "A1-B1"},
};

static void every_kind_of_event_occurs_and_only_contact_at_walking_pace(void **state) {
    (void)state;
    static const CzEventKind kinds[] = {
#define CZ_EVENT(constant, text, doc) constant,
#include "crushzone/events.def"
#undef CZ_EVENT
    };
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const CzEventKind kind = kinds[i];
        if ((size_t)kind >= sizeof happens / sizeof happens[0] || happens[kind].file == NULL)
            fail_msg("no collision for event '%s'", cz_event_text(kind));
        Collision fast = collide(happens[kind].file, WITH("simulation.duration_s=0.6"), 0);
        const double time = event_time(&fast, kind, happens[kind].where);
        const double contact = event_time(&fast, CZ_EVENT_CONTACT, "");
        if (!(time >= contact))
            fail_msg("event '%s' at %g s, contact at %g s", cz_event_text(kind), time, contact);
        collision_free(&fast);
        Collision slow = collide(
            happens[kind].file,
            WITH("simulation.duration_s=0.6", "trains[0].speed_km_h=2", "trains[1].speed_km_h=0"),
            0);
        for (int k = 0; k < slow.summary->n_event; k++)
            assert_int_equal(slow.summary->event[k].what, CZ_EVENT_CONTACT);
        collision_free(&slow);
    }
}

/* Couplers of one interface are at unequal heights, so that they are turned from the start. */
static void a_swing_stop_is_reported_exactly_when_the_largest_swing_is_beyond_it(void **state) {
    (void)state;
    static const char *const stops[] = {
        "trains.A.vehicles.A3.front.coupler.hinge.swing_stop_deg=4",
        "trains.A.vehicles.A3.front.coupler.hinge.swing_stop_deg=3",
        "trains.A.vehicles.A3.front.coupler.hinge.swing_stop_deg=1"};
    int n_met = 0;
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
        Collision collision = collide("problems/metro-6-car.yaml",
                                      WITH("trains.A.vehicles.A3.front.coupler.height_mm=900",
                                           stops[i], "simulation.duration_s=0.6"),
                                      5);
        assert_completed(&collision);
        for (int k = 0; k < collision.summary->n_interface; k++) {
            const CzInterfaceResult *interface = &collision.summary->interface[k];
            for (int side = 0; side < 2; side++) {
                char where[CZ_WHERE_SIZE + 16];
                snprintf(where, sizeof where, "coupler %s",
                         collision.summary->vehicle[k + side].name);
                const bool beyond = interface->swing[side] > interface->swing_stop[side];
                const double time = time_of(&collision, CZ_EVENT_SWING_STOP, where, k);
                assert_true(beyond == !isnan(time));
                if (beyond)
                    assert_true(time > 1e-3); /* no coupler swings before the impact arrives */
                n_met += beyond;
            }
        }
        collision_free(&collision);
    }
    assert_true(n_met > 0 && n_met < 3 * 22); /* both cases occurred */
}

/* Checks of totals are not made, those of other numbers are marked; neither can pass. */
static void assert_marked(const CzEvaluation *evaluation) {
    int n_total = 0;
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        const bool is_of_run = strcmp(check->scenario, "design") != 0;
        const bool is_total = strstr(check->name, "energy") != NULL;
        if (!is_of_run)
            continue;
        assert_true(check->beyond_validity);
        assert_true(!is_total || check->verdict == CZ_VERDICT_NOT_CHECKED);
        assert_true(!is_total || isnan(check->value));
        n_total += is_total;
    }
    assert_int_equal(n_total, 3);
    assert_int_equal(evaluation->verdict, CZ_VERDICT_FAIL);
}

static void numbers_after_an_override_are_marked_and_totals_blank(void **state) {
    (void)state;
    CzProblem *problem = NULL;
    CzEvaluator *evaluator = NULL;
    CzEvaluation evaluation = {0};
    CzError error = {0};
    if (cz_problem_read(CZ_SOURCE_FOLDER "/problems/override-bottoming-lifts.yaml", NULL, &problem,
                        &error) != CZ_OK ||
        cz_evaluator_build(problem, NULL, &evaluator, &error) != CZ_OK ||
        cz_evaluate(evaluator, 1, NULL, true, &evaluation, &error) != CZ_OK)
        fail_msg("%s", error.message);
    assert_marked(&evaluation);
    const Collision collision = {.run = evaluation.run[0],
                                 .summary = cz_run_summary(evaluation.run[0])};
    assert_true(collision.summary->beyond_validity);
    assert_true(isnan(cz_run_total(collision.summary, 1.0)));
    const double *t = channel(&collision, CZ_CHANNEL_TIME, "");
    static const CzChannel energies[] = {CZ_CHANNEL_STORED_ENERGY, CZ_CHANNEL_KINETIC_ENERGY,
                                         CZ_CHANNEL_INTERFACE_ENERGY};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < n_sample(&collision); i++) {
            const bool late = 1e-3 * t[i] > collision.summary->beyond_validity_time;
            assert_true(late == !isfinite(cz_run_channel(collision.run, energies[k], 0)[i]));
        }
    cz_evaluation_free(&evaluation);
    cz_evaluator_free(evaluator);
    cz_problem_free(problem);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_event_occurs_and_only_contact_at_walking_pace),
        cmocka_unit_test(a_swing_stop_is_reported_exactly_when_the_largest_swing_is_beyond_it),
        cmocka_unit_test(numbers_after_an_override_are_marked_and_totals_blank),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
