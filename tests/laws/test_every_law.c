/* Every law: no output jumps when an input changes, whatever branch is left or entered.
 *
 * A scan along one input at a time finds the steepest pair of neighbours; halving the interval
 * towards the larger difference some fifty times makes the difference at a breakpoint vanish and
 * that at a jump remain.
 */
#include "support/check.h"

#include <dirent.h>
#include <stdbool.h>

#include "drive.h"
#include "laws/buffer.h"
#include "laws/coupler.h"
#include "laws/drag.h"
#include "laws/draw_gear.h"
#include "laws/face.h"
#include "laws/link.h"
#include "laws/plastic_member.h"
#include "laws/ribs.h"
#include "laws/shear_off.h"
#include "laws/slider.h"
#include "laws/superstructure.h"
#include "laws/suspension.h"
#include "laws/vehicle_end.h"
#include "laws/wheel_rail.h"

enum { MAX_INPUT = 5, MAX_OUTPUT = 2 };

typedef struct {
    const char *name, *header;
    void (*at)(const double *input, double *output);
    int n_input;
    double low[MAX_INPUT], high[MAX_INPUT];
    int n_output;
    double scale[MAX_OUTPUT]; /* of the outputs: a thousand-millionth of it counts as no jump */
} Law;

static const Backbone four_stages = {
    5, {0, 0.02, 0.08, 0.40, 0.60}, {0, 1.2e6, 1.0e6, 1.5e6, 4.5e6}, 1e9};
static const Backbone draft_gear = {3, {0, 0.03, 0.08}, {2e4, 1e5, 6e5}, 1e9};

/* Stroke, increment, rate, offset, step. */
static void cz_buffer_at(const double *input, double *output) {
    const CzBufferLaw law = {5e7, 0.35, 5e3, 3e4, 2e7, 0.002, 0.08};
    const CzBufferResponse response = cz_buffer(&law, backbone_value(&draft_gear, input[0]),
                                                backbone_slope(&draft_gear, input[0]), input[0],
                                                input[1], input[2], input[3], input[4]);
    output[0] = response.force;
    output[1] = response.offset;
}

/* Closure, damage. */
static void cz_coupler_engagement_at(const double *input, double *output) {
    const CzEngagement engagement = cz_coupler_engagement(1.0, 0.0, input[0], input[1]);
    output[0] = engagement.engaged;
    output[1] = engagement.grows;
}

/* Chain's force, closure, rate, slip, share that was released. */
static void cz_face_at(const double *input, double *output) {
    const CzFaceLaw law = {2e4, 0.1, 0.02};
    const CzFaceResponse response = cz_face(&law, input[0], input[1], input[2], input[3], input[4]);
    output[0] = response.normal;
    output[1] = response.remaining;
}

/* Force, strength, slope, rate factor, step. */
static void cz_plastic_crush_at(const double *input, double *output) {
    const double compliance = cz_plastic_compliance(input[1], input[2], input[3], input[4]);
    output[0] = cz_plastic_crush(input[0], input[1], compliance);
}

/* Travel, softening length, space. */
static void cz_shear_off_at(const double *input, double *output) {
    const CzShearOffResponse response =
        cz_shear_off(&(CzShearOffLaw){9.11e5, 1.1e5, input[1], input[2], 1e9}, input[0]);
    output[0] = response.strength;
    output[1] = response.damage;
}

/* Offset of the faces, closure, normal force, slip against meshed ribs. */
static void cz_ribs_at(const double *input, double *output) {
    const CzRibsLaw law = {0.05, 0.2, 0.03, 2.56e5, 0.2};
    const CzRibsResponse response = cz_ribs(&law, input[0], input[1], input[2], input[3]);
    output[0] = response.capacity;
    output[1] = response.mesh;
}

/* Closure, set, strength. */
static void cz_superstructure_at(const double *input, double *output) {
    const CzSuperstructureResponse response = cz_superstructure(5e7, input[2], input[0], input[1]);
    output[0] = response.force;
    output[1] = response.set;
}

/* Stiffness, slack, closure. */
static void cz_draw_gear_at(const double *input, double *output) {
    output[0] = cz_draw_gear(input[0], input[1], input[2]);
}

/* Mass, capacity, speed, sum of the other forces. */
static void cz_drag_at(const double *input, double *output) {
    output[0] = cz_drag(input[0], input[1], input[2], input[3]);
}

/* Forces of rolling and of locked wheels, fall speed, speed. */
static void cz_brake_capacity_at(const double *input, double *output) {
    output[0] = cz_brake_capacity(input[0], input[1], input[2], input[3]);
}

/* Displacement, offset, capacity. */
static void cz_slider_at(const double *input, double *output) {
    const CzSliderResponse response = cz_slider(2e7, input[2], input[0], input[1]);
    output[0] = response.force;
    output[1] = response.offset;
}

/* Displacement, range. */
static void cz_stop_at(const double *input, double *output) {
    output[0] = cz_stop(1e7, input[1], input[0]);
}

/* Stiffness, stretch. */
static void cz_link_spring_at(const double *input, double *output) {
    output[0] = cz_link_spring(input[0], input[1]);
}

/* Damping, rate. */
static void cz_link_damper_at(const double *input, double *output) {
    output[0] = cz_link_damper(input[0], input[1]);
}

static const CzSuspensionLaw suspension = {8.6e5, 1.4e5, 0.04, 2e7, 0.03, 2e7, 4e4, 0.5, 4e3};

static void cz_suspension_spring_at(const double *input, double *output) {
    output[0] = cz_suspension_spring(&suspension, input[0]);
}

static void cz_suspension_damper_at(const double *input, double *output) {
    output[0] = cz_suspension_damper(&suspension, input[0]);
}

/* Shortening, largest shortening. */
static void cz_vehicle_end_at(const double *input, double *output) {
    const CzVehicleEndLaw law = {1e8, 0.5, 3e7, 1e8};
    const CzVehicleEndResponse response =
        cz_vehicle_end(&law, backbone_value(&four_stages, input[0]),
                       backbone_value(&four_stages, input[1]), input[0], input[1]);
    output[0] = response.force;
    output[1] = response.residual;
}

static void cz_wheel_normal_force_at(const double *input, double *output) {
    output[0] = cz_wheel_normal_force(2.28e11, input[0]);
}

/* Deflection, slip, speed, normal force, step. */
static void cz_creep_deflection_at(const double *input, double *output) {
    const CzCreepLaw law = {3.5e8, 0.006, 0.3, 0.15, 3.0};
    output[0] = cz_creep_deflection(&law, 1.0 / law.stiffness, input[0], input[1], input[2],
                                    input[3], input[4]);
}

/* Ranges of the inputs, scales of the outputs. */
static const Law range_cz_buffer = {
    .n_input = 5,
    .low = {-0.02, -1e-3, -8, -0.02, 1e-5},
    .high = {0.1, 1e-3, 8, 0.1, 1e-3},
    .n_output = 2,
    .scale = {1e6, 0.1},
};
static const Law range_cz_plastic_crush = {
    .n_input = 5,
    .low = {0, 0, -1e8, 0, 1e-6},
    .high = {2e6, 2e6, 1e8, 0.2, 1e-3},
    .n_output = 1,
    .scale = {1.0},
};
static const Law range_cz_shear_off = {
    .n_input = 3,
    .low = {0, 0.001, 0},
    .high = {0.2, 0.1, 0.15},
    .n_output = 2,
    .scale = {1e6, 1.0},
};
static const Law range_cz_ribs = {
    .n_input = 4,
    .low = {-0.3, -0.01, 0, 0},
    .high = {0.3, 0.1, 1e6, 0.05},
    .n_output = 2,
    .scale = {1e6, 1.0},
};
static const Law range_cz_superstructure = {
    .n_input = 3,
    .low = {-0.1, 0, 0},
    .high = {0.5, 0.4, 2e6},
    .n_output = 2,
    .scale = {1e6, 0.5},
};
static const Law range_cz_draw_gear = {
    .n_input = 3,
    .low = {1e6, 0, -0.1},
    .high = {2e7, 0.05, 0.1},
    .n_output = 1,
    .scale = {1e6},
};
static const Law range_cz_slider = {
    .n_input = 3,
    .low = {-0.1, -0.1, 0},
    .high = {0.1, 0.1, 2e6},
    .n_output = 2,
    .scale = {1e6, 0.1},
};
static const Law range_cz_drag = {.n_input = 4,
                                  .low = {1e3, 0, -20, -2e6},
                                  .high = {8e4, 1e6, 20, 2e6},
                                  .n_output = 1,
                                  .scale = {1e6}};
static const Law range_cz_brake_capacity = {.n_input = 4,
                                            .low = {1e4, 1e3, 1, -20},
                                            .high = {3e5, 1e5, 10, 20},
                                            .n_output = 1,
                                            .scale = {1e5}};
static const Law range_cz_stop = {
    .n_input = 2, .low = {-0.2, 0}, .high = {0.2, 0.1}, .n_output = 1, .scale = {1e6}};
static const Law range_cz_link_spring = {
    .n_input = 2, .low = {1e6, -0.1}, .high = {4e7, 0.1}, .n_output = 1, .scale = {1e6}};
static const Law range_cz_link_damper = {
    .n_input = 2, .low = {1e4, -3}, .high = {1e5, 3}, .n_output = 1, .scale = {1e5}};
static const Law range_cz_suspension_spring = {
    .n_input = 1, .low = {-0.3}, .high = {0.1}, .n_output = 1, .scale = {1e6}};
static const Law range_cz_suspension_damper = {
    .n_input = 1, .low = {-3}, .high = {3}, .n_output = 1, .scale = {1e4}};
static const Law range_cz_vehicle_end = {
    .n_input = 2,
    .low = {-0.05, 0},
    .high = {0.65, 0.6},
    .n_output = 2,
    .scale = {5e6, 0.6},
};
static const Law range_cz_wheel_normal_force = {
    .n_input = 1, .low = {-1e-3}, .high = {1e-3}, .n_output = 1, .scale = {1e5}};
static const Law range_cz_creep_deflection = {
    .n_input = 5,
    .low = {-1e-4, -5, -30, 0, 1e-6},
    .high = {1e-4, 5, 30, 3e5, 1e-3},
    .n_output = 1,
    .scale = {1e-4},
};

static const Law range_cz_coupler_engagement = {
    .n_input = 2,
    .low = {-0.01, 0},
    .high = {0.02, 1},
    .n_output = 2,
    .scale = {1, 300},
};
static const Law range_cz_face = {
    .n_input = 5,
    .low = {0, -0.01, -5, -0.15, 0},
    .high = {3e6, 0.3, 20, 0.15, 1},
    .n_output = 2,
    .scale = {1e6, 0.1},
};

static Law law_named(const char *name, const char *header, Law law,
                     void (*at)(const double *, double *)) {
    law.name = name;
    law.header = header;
    law.at = at;
    return law;
}

enum {
#define CZ_LAW(function, header, doc) LAW_##function,
#include "laws/laws.def"
#undef CZ_LAW
    N_LAW
};

static void list_laws(Law *law) {
#define CZ_LAW(function, header, doc)                                                              \
    law[LAW_##function] = law_named(#function, header, range_##function, function##_at);
#include "laws/laws.def"
#undef CZ_LAW
}

/* Largest difference of the outputs over an interval of one input, in their scales. */
static double difference(const Law *law, const double *base, int input, double from, double to) {
    double point[MAX_INPUT], left[MAX_OUTPUT], right[MAX_OUTPUT];
    memcpy(point, base, sizeof point);
    point[input] = from;
    law->at(point, left);
    point[input] = to;
    law->at(point, right);
    double largest = 0.0;
    for (int i = 0; i < law->n_output; i++) {
        assert_true(isfinite(left[i]) && isfinite(right[i]));
        largest = fmax(largest, fabs(right[i] - left[i]) / law->scale[i]);
    }
    return largest;
}

/* The interval is halved towards the larger difference until it cannot be halved again. */
static double jump(const Law *law, const double *base, int input, double from, double to) {
    for (int i = 0; i < 60; i++) {
        const double middle = from + 0.5 * (to - from);
        if (!(middle > from && middle < to))
            break;
        if (difference(law, base, input, from, middle) > difference(law, base, input, middle, to))
            to = middle;
        else
            from = middle;
    }
    return difference(law, base, input, from, to);
}

static void no_output_jumps_along_any_input(void **state) {
    (void)state;
    enum { N_BASE = 200, N_PAIR = 60 };
    Law laws[N_LAW];
    list_laws(laws);
    uint64_t seed = 1;
    for (int which = 0; which < N_LAW; which++) {
        const Law *law = &laws[which];
        double worst = 0.0;
        for (int trial = 0; trial < N_BASE; trial++) {
            double base[MAX_INPUT] = {0};
            for (int i = 0; i < law->n_input; i++)
                base[i] = law->low[i] + next_random(&seed) * (law->high[i] - law->low[i]);
            const int input = trial % law->n_input;
            const double width = (law->high[input] - law->low[input]) / N_PAIR;
            for (int pair = 0; pair < N_PAIR; pair++) {
                const double from = law->low[input] + pair * width;
                const double left = jump(law, base, input, from, from + width);
                if (left > 1e-9)
                    print_error("%s jumps by %g of its scale along input %d near %g\n", law->name,
                                left, input, from);
                worst = fmax(worst, left);
            }
        }
        assert_true(worst <= 1e-9);
    }
}

/* A coupler that releases at once instead of over its softening length. */
static void sudden_shear_off_at(const double *input, double *output) {
    output[0] = input[0] < 0.0123456789 ? 9.11e5 : 0.0;
}

static void the_search_for_jumps_finds_one(void **state) {
    (void)state;
    const Law law = {.at = sudden_shear_off_at, .n_input = 1, .n_output = 1, .scale = {1e6}};
    const double base[MAX_INPUT] = {0};
    assert_near(jump(&law, base, 0, 0.0, 0.1), 0.911, ROUNDING_OF_A_SUM, 0.0);
}

static void every_header_of_a_law_is_in_the_list(void **state) {
    (void)state;
    Law laws[N_LAW];
    list_laws(laws);
    DIR *folder = opendir(CZ_SOURCE_FOLDER "/src/laws");
    assert_non_null(folder);
    for (const struct dirent *entry = readdir(folder); entry != NULL; entry = readdir(folder)) {
        const char *ending = strrchr(entry->d_name, '.');
        if (ending == NULL || strcmp(ending, ".h") != 0 || strcmp(entry->d_name, "law.h") == 0)
            continue;
        bool listed = false;
        for (int i = 0; i < N_LAW; i++)
            listed = listed || strcmp(laws[i].header, entry->d_name) == 0;
        if (!listed)
            print_error("src/laws/%s is not in laws.def\n", entry->d_name);
        assert_true(listed);
    }
    closedir(folder);
}

/* Laws of signed quantities: which inputs change sign with the direction, and whether the outputs
 * do.
 */
static const struct {
    int law;
    double turns[MAX_INPUT]; /* -1 for those that do */
    double sign;
} signed_laws[] = {
    {LAW_cz_slider, {-1, -1, 1}, -1},     {LAW_cz_stop, {-1, 1}, -1},
    {LAW_cz_suspension_damper, {-1}, -1}, {LAW_cz_creep_deflection, {-1, -1, -1, 1, 1}, -1},
    {LAW_cz_link_spring, {1, -1}, -1},    {LAW_cz_link_damper, {1, -1}, -1},
    {LAW_cz_drag, {1, 1, -1, -1}, -1},    {LAW_cz_ribs, {-1, 1, 1, 1}, 1},
};

/* To the last bit, and at zero of either sign. */
static void laws_of_signed_quantities_are_odd(void **state) {
    (void)state;
    Law laws[N_LAW];
    list_laws(laws);
    uint64_t seed = 4711;
    for (size_t k = 0; k < sizeof signed_laws / sizeof signed_laws[0]; k++) {
        const Law *law = &laws[signed_laws[k].law];
        for (int n = 0; n < 2000; n++) {
            double input[MAX_INPUT], turned[MAX_INPUT], output[MAX_OUTPUT], mirrored[MAX_OUTPUT];
            for (int i = 0; i < law->n_input; i++) {
                const double at = next_random(&seed), size = law->high[i] - law->low[i];
                const bool is_zero = signed_laws[k].turns[i] < 0 && (n >> i) % 4 == 0;
                input[i] = is_zero ? 0.0 : law->low[i] + at * size;
                turned[i] = signed_laws[k].turns[i] * input[i];
            }
            law->at(input, output);
            law->at(turned, mirrored);
            for (int i = 0; i < law->n_output; i++)
                if (mirrored[i] != signed_laws[k].sign * output[i])
                    fail_msg("%s: %.17g turned round gives %.17g", law->name, output[i],
                             mirrored[i]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_output_jumps_along_any_input),
        cmocka_unit_test(the_search_for_jumps_finds_one),
        cmocka_unit_test(every_header_of_a_law_is_in_the_list),
        cmocka_unit_test(laws_of_signed_quantities_are_odd),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
