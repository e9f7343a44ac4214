/* Problem files drawn at random, see random_design.h.
 *
 * Ranges are wide on purpose: devices without effect, absorbers whose stroke is exhausted, falling
 * stages, partners without a device to meet, speeds of shunting and far beyond the design. A number
 * is drawn from a uniform distribution, of its logarithm where it spans more than a decade. The
 * order in which arguments are evaluated is the compiler's: no list of arguments holds two draws.
 */
#include "property/random_design.h"

#include <math.h>
#include <stdbool.h>

typedef struct {
    uint64_t state;
    FILE *file;
    bool full; /* cars with bogies, whose devices need heights */
} Draw;

/* Steele, Lea and Flood's splitmix64. */
static uint64_t next(Draw *draw) {
    uint64_t z = draw->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static double unit(Draw *draw) {
    return (double)(next(draw) >> 11) * 0x1p-53;
}

static bool chance(Draw *draw, double share) {
    return unit(draw) < share;
}

static int one_of(Draw *draw, int n) {
    return (int)(next(draw) % (uint64_t)n);
}

static double between(Draw *draw, double low, double high) {
    return low + (high - low) * unit(draw);
}

static double decades(Draw *draw, double low, double high) {
    return low * pow(high / low, unit(draw));
}

/* A key with a number of four digits. */
static void put(Draw *draw, const char *key, double value) {
    fprintf(draw->file, "%s: %.4g, ", key, value);
}

static void maybe(Draw *draw, double share, const char *key, double value) {
    if (chance(draw, share))
        put(draw, key, value);
}

/* Stages about a level of force; `rises`: as the reader requires for buffers. Returns the steepest
 * rise from one stage's end to the next one's [MN/m]. */
static double put_stages(Draw *draw, int most, double stroke, double force, bool rises) {
    const int n = 1 + one_of(draw, most);
    double level = force * between(draw, 0.3, 1), last = 0.0, steepest = 0.0;
    fprintf(draw->file, "stages: [");
    for (int stage = 0; stage < n; stage++) {
        const double length = stroke / n * between(draw, 0.3, 1.7);
        fprintf(draw->file, "%s{stroke_mm: %.4g, force_kN: %.4g}", stage ? ", " : "", length,
                level);
        steepest = fmax(steepest, (level - last) / length);
        last = level;
        level *= rises ? between(draw, 1.05, 2.5) : between(draw, 0.6, 1.8);
    }
    fprintf(draw->file, "], ");
    return steepest;
}

static void put_buffer(Draw *draw, double force) {
    fprintf(draw->file, "buffer: {");
    const double steepest = put_stages(draw, 3, decades(draw, 20, 150), force, true);
    put(draw, "transition_stiffness_MN_m", decades(draw, 1.1, 50) * fmax(steepest, 2));
    maybe(draw, 0.5, "preload_kN", between(draw, 0, 0.2 * force));
    maybe(draw, 0.5, "unloading_share", chance(draw, 0.2) ? 1 : between(draw, 0, 1));
    maybe(draw, 0.5, "damping_kN_s_m", chance(draw, 0.3) ? 0 : decades(draw, 1, 100));
    maybe(draw, 0.2, "quadratic_damping_kN_s2_m2", decades(draw, 1, 100));
    maybe(draw, 0.2, "draw_slack_mm", between(draw, 0, 20));
    fprintf(draw->file, "}, ");
}

static void put_tube(Draw *draw, const char *key, double force) {
    fprintf(draw->file, "%s: {", key);
    put_stages(draw, 2, decades(draw, 50, 800), force, false);
    maybe(draw, 0.3, "trigger_kN", force * between(draw, 1, 1.6));
    maybe(draw, 0.3, "stiffness_MN_m", decades(draw, 20, 2000));
    maybe(draw, 0.2, "rate_factor_s_m", between(draw, 0, 0.1));
    fprintf(draw->file, "}, ");
}

static void put_coupler(Draw *draw) {
    const double force = decades(draw, 200, 1500);
    fprintf(draw->file, "coupler: {");
    maybe(draw, 0.3, "gap_mm", between(draw, 0, 50));
    if (draw->full)
        fprintf(draw->file, "height_m: 0.72, length_m: %.4g, hinge: {use: coupler-hinge}, ",
                between(draw, 1.2, 2.5));
    else
        maybe(draw, 0.5, "length_m", between(draw, 0.8, 2.5));
    put_buffer(draw, force * between(draw, 0.3, 0.9));
    if (chance(draw, 0.7))
        put_tube(draw, "tube", force);
    if (chance(draw, 0.15))
        put_tube(draw, "second_tube", force * between(draw, 1, 1.4));
    if (chance(draw, 0.35)) {
        fprintf(draw->file, "shear_off: {");
        put(draw, "force_kN", force * between(draw, 1.1, 1.8));
        put(draw, "retraction_space_mm", between(draw, 200, 1500));
        fprintf(draw->file, "}, ");
    }
    fprintf(draw->file, "}, ");
}

/* An anti-climber in front of a bare end `behind` mm behind the foremost plane. */
static void put_anti_climber(Draw *draw, double behind) {
    fprintf(draw->file, "anti_climber: {");
    put(draw, "gap_mm", between(draw, fmin(50, 0.5 * behind), behind));
    fprintf(draw->file, "count: %d, ", 1 + one_of(draw, 3));
    const double stroke = decades(draw, 100, 900);
    put_stages(draw, 3, stroke, decades(draw, 150, 1200), false);
    maybe(draw, 0.3, "damping_kN_s_m", decades(draw, 1, 100));
    maybe(draw, 0.3, "speed_factor", between(draw, 0, 0.5));
    maybe(draw, 0.3, "stiffness_MN_m", decades(draw, 20, 2000));
    if (draw->full) {
        fprintf(draw->file, "face_height_mm: 200, rib_count: 4, rib_depth_mm: 30, ");
        put(draw, "height_m", between(draw, 0.9, 1.0));
        put(draw, "rib_strength_kN", decades(draw, 5, 100));
        put(draw, "friction", between(draw, 0, 0.4));
    }
    fprintf(draw->file, "}, ");
}

static void put_side_buffers(Draw *draw) {
    fprintf(draw->file, "side_buffers: {");
    maybe(draw, 0.3, "gap_mm", between(draw, 0, 100));
    if (draw->full)
        fprintf(draw->file, "height_m: 1.05, friction: %.4g, ", between(draw, 0, 0.3));
    put_buffer(draw, decades(draw, 200, 800));
    if (chance(draw, 0.4))
        put_tube(draw, "tube", decades(draw, 500, 1500));
    fprintf(draw->file, "}, ");
}

/* An end; `wall`: of a fixed vehicle. */
static void put_end(Draw *draw, const char *key, bool wall) {
    fprintf(draw->file, "    %s: {", key);
    if (draw->full && !wall)
        fprintf(draw->file,
                "mass_t: 1, pitch_inertia_kg_m2: 600, cg_height_m: 1.2, crush_height_m: 0.95, "
                "distance_m: 10.6, available_length_m: 4, ");
    const double face_gap = wall ? 0 : between(draw, 0, 900);
    put(draw, "face_gap_mm", face_gap);
    double steepest = 1;
    if (chance(draw, wall ? 0.1 : 0.85)) {
        const double stroke = decades(draw, 100, 1200);
        steepest = put_stages(draw, 4, stroke, decades(draw, 800, 4000), false);
    }
    put(draw, "unloading_stiffness_MN_m", decades(draw, 1.1, 50) * fmax(steepest, 100));
    maybe(draw, 0.3, "unloading_share", unit(draw));
    maybe(draw, 0.3, "damping_kN_s_m", decades(draw, 1, 300));
    maybe(draw, 0.3, "proof_strength_kN", between(draw, 800, 2500));
    if (chance(draw, wall ? 0.1 : 0.7))
        put_coupler(draw);
    if (!wall && chance(draw, 0.5))
        put_anti_climber(draw, face_gap);
    if (chance(draw, wall ? 0.1 : 0.2))
        put_side_buffers(draw);
    fprintf(draw->file, "}\n");
}

static void put_car_part(Draw *draw, const char *name) {
    fprintf(draw->file, "  %s:\n", name);
    const double mass = draw->full ? between(draw, 32, 50) : decades(draw, 10, 90);
    fprintf(draw->file, "    mass_t: %.4g\n", mass);
    if (draw->full)
        fprintf(draw->file, "    use: middle-car\n    pitch_inertia_t_m2: %.4g\n",
                between(draw, 600, 1300));
    else
        fprintf(draw->file, "    model: rigid\n    length_m: 20\n");
    put_end(draw, "front", false);
    put_end(draw, "rear", false);
}

static void put_train(Draw *draw, const char *name, double speed, int n_car, bool reversed) {
    fprintf(draw->file, "  - name: %s\n    speed_km_h: %.4g\n", name, speed);
    if (draw->full || chance(draw, 0.2)) {
        const double ratio = chance(draw, 0.5) ? 0 : between(draw, 0, 0.3);
        fprintf(draw->file, "    brake: {ratio: %.4g, axle_share: %.4g}\n", ratio,
                chance(draw, 0.7) ? 1 : 0.5);
    }
    fprintf(draw->file, "    vehicles:\n");
    for (int car = 0; car < n_car; car++)
        fprintf(draw->file, "      - {use: %s%s}\n", one_of(draw, 2) ? "car" : "other",
                reversed ? ", reversed: true" : "");
}

static void put_partner(Draw *draw, double speed, int n_car) {
    if (chance(draw, 0.2)) {
        fprintf(draw->file, "  - name: W\n    vehicles:\n      - use: wall\n");
        return;
    }
    const double own[] = {0, 0, -speed, -0.5 * speed};
    const double chosen = own[one_of(draw, 4)];
    put_train(draw, "B", chosen, 1 + one_of(draw, n_car + 1), true);
    if (draw->full && chance(draw, 0.4))
        fprintf(draw->file, "    height_offset_mm: %.4g\n", between(draw, -150, 150));
}

static void put_limits(Draw *draw) {
    fprintf(draw->file, "checks:\n");
    if (chance(draw, 0.5))
        fprintf(draw->file, "  profile: collision-limits\n");
    if (chance(draw, 0.3))
        fprintf(draw->file, "  design_rules: false\n");
    fprintf(draw->file,
            "  limits:\n    - {name: force, metric: interfaces.peak_force_kN, max: %.4g}\n",
            decades(draw, 500, 20000));
    if (chance(draw, 0.5))
        fprintf(draw->file, "    - {name: stroke, metric: elements.stroke_used, max: 0.9}\n");
    if (chance(draw, 0.3))
        fprintf(draw->file, "    - {name: bottoming, metric: interfaces.bottomed_out, max: 0}\n");
}

void random_design_write(uint64_t number, const char *catalogue, FILE *file) {
    Draw draw = {.state = number * 0xd1342543de82ef95u + 1, .file = file};
    draw.full = chance(&draw, 0.25);
    const int n_car = 1 + one_of(&draw, draw.full ? 2 : 4);
    const double speed = decades(&draw, 2, 90);
    fprintf(file, "schema: 1\ntitle: random design %llu\n", (unsigned long long)number);
    if (draw.full)
        fprintf(file, "catalogue: [%s]\n", catalogue);
    fprintf(file, "simulation:\n  track: %s\n  longest_s: 3\n",
            draw.full && chance(&draw, 0.2) ? "receptance" : "rigid");
    fprintf(file, "  adhesion: {friction: %.4g}\n", between(&draw, 0.05, 0.5));
    if (chance(&draw, 0.1))
        fprintf(file, "  duration_s: %.4g\n", decades(&draw, 0.02, 1));
    fprintf(file, "parts:\n");
    put_car_part(&draw, "car");
    put_car_part(&draw, "other");
    fprintf(file, "  wall:\n    model: fixed\n");
    put_end(&draw, "rear", true);
    fprintf(file, "trains:\n");
    put_train(&draw, "A", speed, n_car, false);
    put_partner(&draw, speed, n_car);
    if (chance(&draw, 0.7))
        put_limits(&draw);
}
