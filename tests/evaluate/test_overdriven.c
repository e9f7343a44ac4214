/* Every class of device is driven beyond its stroke, on either side of an interface, by rigid and
 * by full cars, against a car and a wall, and releases again: the results give the largest stroke
 * of the run, not the remaining one. */
#include "support/check.h"

#include <stdbool.h>

#include "crushzone/evaluate.h"
#include "problem/problem.h"

enum { MAX_TEXT = 8000 };

typedef struct {
    const char
        *devices;      /* in devices.def: of a rigid car, and of a full one where it is different */
    const char *where; /* of the event */
    CzElementKind element;
    const char *weak, *strong; /* devices of the end that is overdriven, and of the one it meets */
} Class;

#define STRONG "500, force_kN: 20000"
#define WEAK "100, force_kN: 500"
#define SOFT "50, force_kN: 300"
#define A_TUBE "{stages: [{stroke_mm: 100, force_kN: 500}]}"
#define STRONG_COUPLER "coupler: {@coupler, buffer: {stages: [{stroke_mm: " STRONG "}]}}"
#define STRONG_BUFFERS "side_buffers: {@buffers, buffer: {stages: [{stroke_mm: " STRONG "}]}}"

static const Class classes[] = {
    {"COUPLER_BUFFER", "coupler buffer", CZ_ELEMENT_COUPLER,
     "coupler: {@coupler, buffer: {stages: [{stroke_mm: " WEAK "}]}}", STRONG_COUPLER},
    {"TUBE", "coupler tube", CZ_ELEMENT_COUPLER,
     "coupler: {@coupler, buffer: {stages: [{stroke_mm: " SOFT "}]}, tube: " A_TUBE "}",
     STRONG_COUPLER},
    {"SECOND_TUBE", "second coupler tube", CZ_ELEMENT_COUPLER,
     "coupler: {@coupler, buffer: {stages: [{stroke_mm: " SOFT "}]}, tube: {stages: [{stroke_mm: "
     "900, force_kN: 9000}]}, second_tube: " A_TUBE "}",
     STRONG_COUPLER},
    {"RETRACTION", "retraction space", CZ_ELEMENT_COUPLER,
     "coupler: {@coupler, buffer: {stages: [{stroke_mm: " SOFT
     "}]}, shear_off: {force_kN: 500, retraction_space_mm: 100}}",
     STRONG_COUPLER},
    {"ANTI_CLIMBER", "anti-climber", CZ_ELEMENT_ANTI_CLIMBER,
     "anti_climber: {@anti-climber, stages: [{stroke_mm: 100, force_kN: 500}]}",
     "anti_climber: {@anti-climber, stages: [{stroke_mm: 500, force_kN: 20000}]}"},
    {"MASSLESS_END END", "end", CZ_ELEMENT_END,
     "face_gap_m: 0, stages: [{stroke_mm: 10, force_kN: 500}, {stroke_mm: 100, force_kN: 500}]",
     "face_gap_m: 0, stages: [{stroke_mm: 500, force_kN: 50000}]"},
    {"SIDE_BUFFER", "side buffers", CZ_ELEMENT_SIDE_BUFFERS,
     "side_buffers: {@buffers, buffer: {stages: [{stroke_mm: " WEAK "}]}}", STRONG_BUFFERS},
    {"SIDE_TUBE", "side buffers", CZ_ELEMENT_SIDE_BUFFERS,
     "side_buffers: {@buffers, buffer: {stages: [{stroke_mm: " SOFT "}]}, tube: " A_TUBE "}",
     STRONG_BUFFERS},
};

/* Further keys of full cars. */
#define OF_RIGID_END "unloading_stiffness_MN_m: 200"
#define OF_FULL_END                                                                                \
    OF_RIGID_END ", mass_t: 1, pitch_inertia_kg_m2: 600, cg_height_m: 1, crush_height_m: 1, "      \
                 "distance_m: 10.6"
typedef struct {
    const char *mark, *rigid, *full;
} Piece;
static const Piece pieces[] = {
    {"@coupler", "gap_m: 0",
     "gap_m: 0, height_m: 1, length_m: 1.9, hinge: {stiffness_kNm_rad: 600, moment_capacity_kNm: "
     "100, swing_stop_deg: 6}"},
    {"@anti-climber", "gap_m: 0",
     "gap_m: 0, height_m: 1, face_height_mm: 400, rib_count: 4, rib_depth_mm: 30, "
     "rib_strength_kN: 100, friction: 0.3"},
    {"@buffers", "gap_m: 0", "gap_m: 0, height_m: 1, friction: 0.3"},
};

/* Appends a text with its marks replaced. */
static void append(char *text, const char *devices, bool full) {
    while (*devices != '\0') {
        const Piece *piece = NULL;
        for (size_t i = 0; i < sizeof pieces / sizeof pieces[0]; i++)
            if (strncmp(devices, pieces[i].mark, strlen(pieces[i].mark)) == 0)
                piece = &pieces[i];
        const char one[] = {*devices, '\0'};
        strcat(text, piece == NULL ? one : full ? piece->full : piece->rigid);
        devices += piece == NULL ? 1 : strlen(piece->mark);
    }
}

static void append_end(char *text, const char *name, const char *devices, bool full) {
    strcat(text, "  ");
    strcat(text, name);
    strcat(text, ": {");
    strcat(text, full ? OF_FULL_END : OF_RIGID_END);
    const bool is_structure = strstr(devices, "face_gap_m") != NULL;
    strcat(text, is_structure ? ", " : ", face_gap_m: 2, ");
    strcat(text, full && !is_structure ? "stages: [{stroke_mm: 500, force_kN: 50000}], " : "");
    append(text, devices, full);
    strcat(text, "}\n");
}

typedef enum { CAR_BEHIND, CAR_AHEAD, AGAINST_WALL, N_SETTING } Setting;

/* The problem in which the weak end is that of the car behind, of the car ahead, or of a car
 * against a wall. */
static void write_problem(char *text, const Class *class, Setting setting, bool full) {
    strcpy(text,
           "schema: 1\ntitle: An overdriven device\n"
           "catalogue: [../../../problems/catalogue/generic.yaml]\n"
           "simulation: {track: rigid, duration_s: 0.4, adhesion: {friction: 0.3}}\nparts:\n");
    append_end(text, "weak", class->weak, full);
    append_end(text, "strong", class->strong, full);
    strcat(text, full ? "  car: {mass_t: 40, pitch_inertia_t_m2: 850, cg_height_m: 1.6, "
                        "bogie_spacing_m: 15.7, length_m: 22.8, bogie: {use: bogie}, "
                        "front: {use: strong}, rear: {use: strong}}\n"
                      : "  car: {model: rigid, mass_t: 40}\n");
    strcat(text, "trains:\n  - {name: A, speed_m_s: 8, brake: {ratio: 0, axle_share: 0}, vehicles: "
                 "[{name: A1, use: car, front: {use: ");
    strcat(text, setting == CAR_AHEAD ? "strong" : "weak");
    strcat(text, "}}]}\n  - {name: B, ");
    if (setting == AGAINST_WALL)
        strcat(text, "vehicles: [{name: B1, model: fixed, rear: {face_gap_m: 0, "
                     "unloading_stiffness_MN_m: 10000}}]}\n");
    else
        strcat(text, setting == CAR_AHEAD ? "brake: {ratio: 0, axle_share: 0}, vehicles: "
                                            "[{name: B1, use: car, rear: {use: weak}}]}\n"
                                          : "brake: {ratio: 0, axle_share: 0}, vehicles: "
                                            "[{name: B1, use: car, rear: {use: strong}}]}\n");
}

static void assert_check_fails(const CzEvaluation *evaluation, const char *name) {
    for (int i = 0; i < evaluation->n_check; i++)
        if (strcmp(evaluation->check[i].name, name) == 0) {
            assert_int_equal(evaluation->check[i].verdict, CZ_VERDICT_FAIL);
            return;
        }
    fail_msg("no check '%s'", name);
}

static void assert_used_up(const CzRunSummary *run, const Class *class, const char *car) {
    bool has_event = false;
    for (int i = 0; i < run->n_event; i++) {
        char where[CZ_WHERE_SIZE + 16];
        snprintf(where, sizeof where, "%s %s", class->where, car);
        has_event |=
            run->event[i].what == CZ_EVENT_BOTTOMED_OUT && strcmp(run->event[i].where, where) == 0;
    }
    assert_true(has_event);
    for (int k = 0; k < run->interface[0].n_element; k++) {
        const CzElementResult *element = &run->interface[0].element[k];
        if (element->kind != class->element ||
            strcmp(run->vehicle[element->vehicle].name, car) != 0)
            continue;
        assert_true(element->bottomed_out);
        assert_true(element->stroke_used > 1.0);
        return;
    }
    fail_msg("no such element");
}

typedef struct {
    CzProblem *problem;
    CzEvaluator *evaluator;
    CzEvaluation evaluation;
    const CzRunSummary *run;
} Judged;

static Judged judge(const Class *class, Setting setting, bool full) {
    char text[MAX_TEXT];
    write_problem(text, class, setting, full);
    Judged judged = {0};
    CzError error = {0};
    if (cz_problem_read_text(text, strlen(text), "text.yaml",
                             CZ_SOURCE_FOLDER "/tests/problem/good", NULL, &judged.problem,
                             &error) != CZ_OK ||
        cz_evaluator_build(judged.problem, NULL, &judged.evaluator, &error) != CZ_OK ||
        cz_evaluate(judged.evaluator, 1, NULL, true, &judged.evaluation, &error) != CZ_OK)
        fail_msg("%s: %s\n%s", class->where, error.message, text);
    judged.run = cz_run_summary(judged.evaluation.run[0]);
    if (judged.run->status != CZ_OK)
        fail_msg("%s: %s", class->where, judged.run->failure);
    return judged;
}

static void forget(Judged *judged) {
    cz_evaluation_free(&judged->evaluation);
    cz_evaluator_free(judged->evaluator);
    cz_problem_free(judged->problem);
}

static void overdrive(const Class *class, Setting setting, bool full) {
    Judged judged = judge(class, setting, full);
    assert_used_up(judged.run, class, setting == CAR_AHEAD ? "B1" : "A1");
    assert_check_fails(&judged.evaluation, "bottoming out");
    assert_check_fails(&judged.evaluation, "stroke used");
    forget(&judged);
}

static void overdrive_all(bool full) {
    for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++)
        for (int setting = 0; setting < N_SETTING; setting++)
            overdrive(&classes[i], (Setting)setting, full);
}

static void every_device_of_a_rigid_car_reports_that_it_bottomed_out(void **state) {
    (void)state;
    overdrive_all(false);
}

static void every_device_of_a_full_car_reports_that_it_bottomed_out(void **state) {
    (void)state;
    overdrive_all(true);
}

/* A superstructure has no usable stroke: crushing it reduces survival space at once. */
static void superstructures_that_meet_report_it_and_fail(void **state) {
    (void)state;
    const char *const devices =
        "superstructure: {gap_m: 0, height_m: 1.9, strength_kN: 300, stiffness_MN_m: 50}";
    const Class class = {"", "superstructures", CZ_ELEMENT_SUPERSTRUCTURE, devices, devices};
    Judged judged = judge(&class, CAR_BEHIND, true);
    bool has_event = false;
    for (int i = 0; i < judged.run->n_event; i++)
        has_event |= judged.run->event[i].what == CZ_EVENT_SUPERSTRUCTURE_CRUSH &&
                     strcmp(judged.run->event[i].where, "superstructures A1-B1") == 0;
    assert_true(has_event);
    assert_check_fails(&judged.evaluation, "energy in survival space");
    forget(&judged);
}

/* The slide of a buffer stop has no car to be on: tests/dynamics/test_drag.c overdrives it. */
static void no_class_of_device_is_left_out(void **state) {
    (void)state;
    static const char *const devices[] = {
#define CZ_DEVICE(name, ...) #name,
#include "simulate/devices.def"
#undef CZ_DEVICE
    };
    char tried[400] = " SLIDE ";
    for (size_t i = 0; i < sizeof classes / sizeof classes[0]; i++) {
        strcat(tried, classes[i].devices);
        strcat(tried, " ");
    }
    for (size_t i = 0; i < sizeof devices / sizeof devices[0]; i++) {
        char name[64];
        snprintf(name, sizeof name, " %s ", devices[i]);
        if (strstr(tried, name) == NULL)
            fail_msg("no collision overdrives %s", devices[i]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_class_of_device_is_left_out),
        cmocka_unit_test(every_device_of_a_rigid_car_reports_that_it_bottomed_out),
        cmocka_unit_test(every_device_of_a_full_car_reports_that_it_bottomed_out),
        cmocka_unit_test(superstructures_that_meet_report_it_and_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
