/* The collisions in which a vehicle with every key is tested, for the test of every key. */
#ifndef CZ_TESTS_EVERY_KEY_H
#define CZ_TESTS_EVERY_KEY_H

#include "support/check.h"

#include "problem/answer.h"
#include "problem/problem.h"

enum { LONGEST = 32768 };

/* A collision that the tested vehicle T takes part in. */
typedef struct {
    CzVehicleModel model;
    const char *car; /* settings that make the part `car` the tested one */
    const char *trains;
} Setting;

#define FIRST_SCENARIO "level" /* of every setting */
#define HARD                                                                                       \
    "scenarios:\n"                                                                                 \
    "  - {name: level, payload_share: 1}\n"                                                        \
    "  - {name: offset, height_offset_m: 0.09}\n"                                                  \
    "  - {name: slow, speed_m_s: 4}\n"                                                             \
    "  - {name: bump, speed_m_s: 1.5, duration_s: 0.6}\n"
#define AHEAD                                                                                      \
    "scenarios:\n"                                                                                 \
    "  - {name: level, payload_share: 1}\n"                                                        \
    "  - {name: slow, partner_speed_m_s: -4}\n"
#define TRAINS(a, b)                                                                               \
    "trains:\n  - {name: A, speed_m_s: 14, brake: {ratio: 0.1, axle_share: 1}, vehicles: [" a      \
    "]}\n  - {name: B, brake: {ratio: 0.1, axle_share: 1}, vehicles: [" b "]}\n" HARD
#define WALL_BEHIND(b)                                                                             \
    "trains:\n  - {name: A, brake: {ratio: 0, axle_share: 0}, vehicles: [{name: T, use: "          \
    "tested}]}\n"                                                                                  \
    "  - {name: B, speed_m_s: -14, brake: {ratio: 0, axle_share: 0}, vehicles: [" b "]}\n" AHEAD
#define LIMITS                                                                                     \
    "checks: {limits: [{name: gaps, metric: interfaces.inner.gap_used, max: 1}, "                  \
    "{name: vestibules, metric: sections.temporary_share, max: 0.3}]}\n"
#define CAR(name) "{name: " name ", use: other-car}"
#define BARE(name) "{name: " name ", use: bare-car}"
#define MASS(name) "{name: " name ", use: mass}"
#define BUFFERED(name)                                                                             \
    "{name: " name ", use: other-car, front: {anti_climber: null, coupler: null, superstructure: " \
    "null}, rear: {anti_climber: null, coupler: null, superstructure: null}}"
#define NO_BUFFERS "side_buffers: null"
#define UNBUFFERED "front: {" NO_BUFFERS "}, rear: {" NO_BUFFERS "}"
#define ON_PLATES "{side_buffers: null, anti_climber: {in_line_with_buffers: true}}"
#define IN_LINE "front: " ON_PLATES ", rear: " ON_PLATES
#define TESTED "{name: T, use: tested}"
#define SLIDE "slide: {mass_kg: 2000, force_N: 300000, length_m: 0.2, bottom_stiffness_N_m: 1.0e+9}"

/* Keys that other keys act with are removed. */
#define WITHOUT                                                                                    \
    "front: {pitch: locked, vertical: locked, second_unloading_stiffness_N_m: null, "              \
    "anti_climber: "                                                                               \
    "{speed_factor: 0, trigger_N: null}, coupler: {tube: {trigger_N: null, installed_length_m: "   \
    "null}}}, bogie: {primary: {blow_off_N: null, bump_gap_m: null, lift_gap_m: null}}"

static const Setting settings[] = {
    {CZ_MODEL_FULL, "model: full", TRAINS(CAR("A1") ", " TESTED, CAR("B1")) LIMITS},
    {CZ_MODEL_FULL, "model: full, " UNBUFFERED, TRAINS(BARE("A1") ", " TESTED, BARE("B1")) LIMITS},
    {CZ_MODEL_RIGID, "model: rigid", TRAINS(CAR("A1") ", " TESTED, CAR("B1")) LIMITS},
    {CZ_MODEL_RIGID, "model: rigid, " UNBUFFERED,
     TRAINS(BARE("A1") ", " TESTED, BARE("B1")) LIMITS},
    {CZ_MODEL_RIGID, "model: rigid", TRAINS(MASS("A1") ", " TESTED, MASS("B1")) LIMITS},
    {CZ_MODEL_FULL,
     "model: full, front: {" NO_BUFFERS ", anti_climber: {friction: 0}}, rear: {" NO_BUFFERS
     "}, bogie: {primary: {lift_gap_m: null, stiffness_N_m: 5.0e+7}, secondary: {lift_gap_m: null, "
     "stiffness_N_m: 1.0e+7}}",
     TRAINS(BARE("A1") ", " TESTED, BARE("B1")) LIMITS},
    {CZ_MODEL_RIGID,
     "model: rigid, front: {" NO_BUFFERS ", anti_climber: {friction: 0}}, rear: {" NO_BUFFERS "}",
     TRAINS(BARE("A1") ", " TESTED, BARE("B1")) LIMITS},
    {CZ_MODEL_RIGID,
     "model: rigid, front: {" NO_BUFFERS
     ", anti_climber: {friction: 0, rib_strength_N: 3000}}, rear: {" NO_BUFFERS "}",
     TRAINS(BARE("A1") ", " TESTED, BARE("B1")) LIMITS},
    {CZ_MODEL_RIGID,
     "model: rigid, front: {" NO_BUFFERS ", anti_climber: null}, rear: {" NO_BUFFERS "}",
     TRAINS(BARE("A1") ", " TESTED, BARE("B1")) LIMITS},
    {CZ_MODEL_FULL, "model: full, " WITHOUT, TRAINS(BARE("A1") ", " TESTED, MASS("B1")) LIMITS},
    {CZ_MODEL_RIGID, "model: rigid, front: {stages: null, anti_climber: {rib_strength_N: 20000}}",
     TRAINS(MASS("A1") ", " TESTED, MASS("B1")) LIMITS},
    {CZ_MODEL_FIXED,
     "model: fixed, rear: {anti_climber: null, coupler: null, side_buffers: null, stages: "
     "[{stroke_m: 0.05, force_N: 1200000}]}",
     TRAINS("{name: A1, use: mass, front: {anti_climber: null, coupler: null, side_buffers: null}}",
            TESTED)},
    {CZ_MODEL_FIXED, "model: fixed, rear: {" SLIDE "}", TRAINS(CAR("A1"), TESTED)},
    {CZ_MODEL_FIXED, "model: fixed, rear: {side_buffers: null}", TRAINS(BARE("A1"), TESTED)},
    {CZ_MODEL_FIXED, "model: fixed", TRAINS(MASS("A1"), TESTED)},
    {CZ_MODEL_FIXED, "model: fixed", TRAINS(MASS("A1"), MASS("B1") ", " TESTED)},
    {CZ_MODEL_FIXED, "model: fixed, front: {" SLIDE "}", WALL_BEHIND(CAR("B1"))},
    {CZ_MODEL_FULL, "model: full, " IN_LINE,
     TRAINS(BUFFERED("A1") ", " TESTED, BUFFERED("B1")) LIMITS},
    {CZ_MODEL_FULL, "model: full, " UNBUFFERED,
     TRAINS(BUFFERED("A1") ", " TESTED, BUFFERED("B1")) LIMITS},
    {CZ_MODEL_RIGID, "model: rigid, " UNBUFFERED,
     TRAINS(BUFFERED("A1") ", " TESTED, BUFFERED("B1")) LIMITS},
    {CZ_MODEL_FIXED, "model: fixed, " UNBUFFERED, TRAINS(BUFFERED("A1"), TESTED)},
    {CZ_MODEL_FULL, "model: full, front: {coupler: null}",
     TRAINS(BARE("A1") ", " TESTED, MASS("B1")) LIMITS},
    {CZ_MODEL_RIGID, "model: rigid, front: {coupler: null}",
     TRAINS(BARE("A1") ", " TESTED, BARE("B1")) LIMITS},
    {CZ_MODEL_FIXED, "model: fixed, rear: {coupler: null}", TRAINS(BARE("A1"), TESTED)},
};
enum { N_SETTING = sizeof settings / sizeof settings[0] };
enum { N_WHOLE = 17 }; /* settings behind leave out keys whose lack others show */

static char base[LONGEST];

static inline void read_base(void) {
    FILE *file = fopen(CZ_SOURCE_FOLDER "/tests/problem/cases/every-key.yaml", "r");
    assert_non_null(file);
    base[fread(base, 1, sizeof base - 1, file)] = '\0';
    fclose(file);
}

/* The problem of a setting with a text for the tested vehicle; the caller frees it.
 */
static inline char *problem_text(const Setting *setting, const char *written) {
    char *text = NULL;
    size_t n = 0;
    FILE *stream = open_memstream(&text, &n);
    assert_non_null(stream);
    fprintf(stream, "%s  tuned: {use: car, %s}\n  tested: {use: tuned%s%s}\n%s", base, setting->car,
            written[0] != '\0' ? ", " : "", written, setting->trains);
    fclose(stream);
    return text;
}

/* The answer of all scenarios, or of one alone. */
static inline Answer answer_with(const Setting *setting, const char *written,
                                 const char *scenario) {
    char *text = problem_text(setting, written);
    Answer answer = answer_in(text, scenario);
    free(text);
    return answer;
}

/* The tested vehicle as it is read in a setting; the caller frees the problem. */
static inline const CzVehicle *read_tested(const Setting *setting, CzProblem **read) {
    char *text = problem_text(setting, "");
    CzProblem *problem = NULL;
    const CzVehicle *vehicle = NULL;
    CzError error = {0};
    CzProblemOptions options = cz_problem_options_default();
    if (cz_problem_read_text(text, strlen(text), "key.yaml", ".", &options, &problem, &error) !=
        CZ_OK)
        fail_msg("%d:%d: %s", error.line, error.column, error.message);
    int n_vehicle;
    const CzVehicle *all = cz_problem_vehicles(problem, &n_vehicle);
    for (int i = 0; i < n_vehicle; i++)
        if (all[i].name != NULL && strcmp(all[i].name, "T") == 0)
            vehicle = &all[i];
    assert_non_null(vehicle);
    free(text);
    *read = problem;
    return vehicle;
}

#endif
