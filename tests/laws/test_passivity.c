/* No law creates energy: on random walks the work done on an element, less the energy that it can
 * return, never falls. */
#include "support/check.h"

#include <stdbool.h>

#include "drive.h"
#include "laws/buffer.h"
#include "laws/plastic_member.h"
#include "laws/shear_off.h"
#include "laws/slider.h"
#include "laws/suspension.h"
#include "laws/vehicle_end.h"
#include "laws/wheel_rail.h"

/* ---- elements ---- */

static double buffer_force(Element *element, double x) {
    const CzBufferResponse response =
        cz_buffer(element->law, backbone_value(element->backbone, x),
                  backbone_slope(element->backbone, x), x, 0.0, 0.0, element->memory[0], 1e-4);
    element->memory[0] = response.offset;
    return response.force;
}

static double end_force(Element *element, double x) {
    const Backbone *backbone = element->backbone;
    const double usable = backbone->x[backbone->n_point - 1];
    const double reached = cz_smaller(x, usable);
    if (reached > element->memory[0])
        element->memory[0] = reached;
    return cz_vehicle_end(element->law, backbone_value(backbone, x),
                          backbone_value(backbone, element->memory[0]), x, element->memory[0])
        .force;
}

static double slider_force(Element *element, double x) {
    const CzSliderResponse response = cz_slider(2e7, 4e5, x, element->memory[0]);
    element->memory[0] = response.offset;
    return response.force;
}

static double spring_force(Element *element, double x) {
    return cz_suspension_spring(element->law, x);
}

static double stop_force(Element *element, double x) {
    (void)element;
    return cz_stop(1e7, 0.02, x);
}

static double wheel_force(Element *element, double x) {
    (void)element;
    return cz_wheel_normal_force(2.28e11, x);
}

/* Force of a spring in series with one plastic member; no tension. */
static double series_force(double stiffness, double elastic, double strength, double compliance) {
    const double trial = stiffness * elastic;
    const double flowing =
        (trial + stiffness * compliance * strength) / (1.0 + stiffness * compliance);
    return cz_positive_part(trial > strength ? flowing : trial);
}

static double tube_force(Element *element, double x) {
    const double stroke = element->memory[0];
    const double strength = backbone_value(element->backbone, stroke);
    const double compliance =
        cz_plastic_compliance(strength, backbone_slope(element->backbone, stroke), 0.0, 1e-4);
    const double force = series_force(2e8, x - stroke, strength, compliance);
    element->memory[0] += cz_plastic_crush(force, strength, compliance);
    return force;
}

static double shear_force(Element *element, double x) {
    const CzShearOffResponse device =
        cz_shear_off(&(CzShearOffLaw){9e5, 2e5, 0.01, 0.06, 1e9}, element->memory[0]);
    const double compliance = cz_plastic_compliance(device.strength, device.slope, 0.0, 1e-4);
    const double force = series_force(2e8, x - element->memory[0], device.strength, compliance);
    element->memory[0] += cz_plastic_crush(force, device.strength, compliance);
    return force;
}

/* ---- walks ---- */

typedef struct {
    const char *name;
    double (*force)(Element *, double);
    const void *law;
    const Backbone *backbone;
    double low, high, step; /* range of the walk and step of the integration [m] */
} Walk;

static const Backbone four_stages = {
    5, {0, 0.02, 0.08, 0.40, 0.60}, {0, 1.2e6, 1.0e6, 1.5e6, 4.5e6}, 1e9};
static const Backbone stiff_first = {3, {0, 0.001, 0.10}, {0, 1.5e6, 2.0e6}, 1e9};
static const Backbone draft_gear = {3, {0, 0.03, 0.08}, {2e4, 1e5, 6e5}, 1e9};
static const Backbone trigger = {3, {0, 0.01, 0.2}, {8e5, 6e5, 6e5}, 1e9};
static const CzVehicleEndLaw two_stages = {1e8, 0.5, 3e7, 1e8};
static const CzVehicleEndLaw one_stage = {1e8, 0.0, 1e8, 0.0};
static const CzVehicleEndLaw low_second = {2e8, 0.9, 2.5e7, 1e8};
static const CzBufferLaw coupled = {5e7, 0.35, 0.0, 0.0, 2e7, 0.002, 0.08};
static const CzBufferLaw one_sided = {2e7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.08};
static const CzBufferLaw elastic = {5e7, 1.0, 0.0, 0.0, 2e7, 0.0, 0.08};
static const CzSuspensionLaw suspension = {8.6e5, 1.4e5, 0.04, 2e7, 0.03, 2e7, 4e4, 0.5, 4e3};

static const Walk walks[] = {
    {"end with two unloading stages", end_force, &two_stages, &four_stages, -0.03, 0.61, 1e-5},
    {"end with one unloading stage", end_force, &one_stage, &four_stages, -0.03, 0.61, 1e-5},
    {"end with a late second stage", end_force, &low_second, &stiff_first, -0.03, 0.104, 1e-5},
    {"coupled buffer", buffer_force, &coupled, &draft_gear, -0.02, 0.084, 2e-6},
    {"buffer without unloading force", buffer_force, &one_sided, &draft_gear, -0.02, 0.084, 2e-6},
    {"buffer without hysteresis", buffer_force, &elastic, &draft_gear, -0.02, 0.084, 2e-6},
    {"slider", slider_force, NULL, NULL, -0.1, 0.1, 1e-5},
    {"suspension spring", spring_force, &suspension, NULL, -0.3, 0.06, 1e-5},
    {"stop", stop_force, NULL, NULL, -0.05, 0.05, 1e-5},
    {"wheel contact", wheel_force, NULL, NULL, -1e-3, 5e-4, 1e-8},
    {"tube with a trigger", tube_force, NULL, &trigger, -0.05, 0.21, 1e-5},
    {"shear-off", shear_force, NULL, NULL, -0.05, 0.065, 1e-6},
};
enum { N_WALK = sizeof walks / sizeof walks[0], N_SEED = 5, N_TURN = 60 };

/* Whether dissipation never falls from reversal to reversal of one walk. A few parts in a million
 * of the work are lost to the trapezoids at breakpoints. */
static bool only_takes(const Walk *walk, uint64_t seed) {
    Element element = {.force = walk->force, .law = walk->law, .backbone = walk->backbone};
    element.f = element.force(&element, 0.0);
    double work = 0.0, dissipated = 0.0, moved = 0.0;
    for (int turn = 0; turn < N_TURN; turn++) {
        /* Half of the reversals are near the previous one: small loops inside large ones. */
        const double far = walk->low + next_random(&seed) * (walk->high - walk->low);
        const double near =
            element.x + 0.05 * (next_random(&seed) - 0.5) * (walk->high - walk->low);
        const double to = turn % 2 == 0 ? far : cz_clamp(near, walk->low, walk->high);
        const double gained = drive(&element, to, walk->step);
        work += gained;
        moved += fabs(gained);
        const double lost = work - recoverable(&element, walk->step);
        if (!(lost >= dissipated - 1e-5 * moved - 1e-6))
            return false;
        dissipated = lost;
    }
    return true;
}

static void no_random_walk_creates_energy(void **state) {
    (void)state;
    for (int i = 0; i < N_WALK; i++) {
        for (uint64_t seed = 1; seed <= N_SEED; seed++) {
            if (!only_takes(&walks[i], seed)) {
                print_error("%s makes energy on walk %d\n", walks[i].name, (int)seed);
                fail();
            }
        }
    }
}

/* Errors that the walks find: a stop that is part of a curve with hysteresis instead of parallel to
 * it, and a stage that rises faster than its unloading. */
static void a_random_walk_finds_an_element_that_creates_energy(void **state) {
    (void)state;
    CzBufferLaw stop_in_curve = coupled;
    stop_in_curve.usable = 1e30;
    const Backbone steep = {4, {0, 0.02, 0.10, 0.12}, {0, 1e6, 1e6, 4e6}, 1e9};
    assert_true(backbone_slope(&steep, 0.11) > cz_vehicle_end_steepest(&one_stage));
    const Walk wrong[] = {
        {"buffer", buffer_force, &stop_in_curve, &draft_gear, -0.02, 0.084, 2e-6},
        {"end", end_force, &one_stage, &steep, -0.03, 0.12, 1e-5},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        int n_found = 0;
        for (uint64_t seed = 1; seed <= N_SEED; seed++)
            n_found += only_takes(&wrong[i], seed) ? 0 : 1;
        assert_true(n_found > 0);
    }
}

/* The same for dampers: force times rate is never negative. */
static void a_damper_only_dissipates(void **state) {
    (void)state;
    for (double rate = -3.0; rate <= 3.0; rate += 0.01)
        assert_true(cz_suspension_damper(&suspension, rate) * rate >= 0.0);
}

/* Tangential contact: the spring's energy less the work of the slip never grows, rolling, standing
 * or reversing, with a varying normal force. */
static void a_creeping_wheel_only_dissipates(void **state) {
    (void)state;
    const CzCreepLaw law = {3.5e8, 0.006, 0.3, 0.15, 3.0};
    uint64_t seed = 7;
    double deflection = 0.0;
    for (int i = 0; i < 200000; i++) {
        const double step = 1e-5 + 1e-3 * next_random(&seed);
        const double slip = (next_random(&seed) - 0.5) * (next_random(&seed) < 0.5 ? 0.01 : 10.0);
        const double speed = next_random(&seed) < 0.3 ? 0.0 : 20.0 * (next_random(&seed) - 0.5);
        const double normal = next_random(&seed) < 0.1 ? 0.0 : 2e5 * next_random(&seed);
        const double next =
            cz_creep_deflection(&law, 1.0 / law.stiffness, deflection, slip, speed, normal, step);
        const double given = law.stiffness * next * slip * step;
        const double stored = 0.5 * law.stiffness * (next * next - deflection * deflection);
        assert_true(given - stored >= -1e-9);
        deflection = next;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_random_walk_creates_energy),
        cmocka_unit_test(a_random_walk_finds_an_element_that_creates_energy),
        cmocka_unit_test(a_damper_only_dissipates),
        cmocka_unit_test(a_creeping_wheel_only_dissipates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
