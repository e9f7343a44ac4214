/* A problem as the model and the evaluator use it: typed records, places in the file, design
 * targets. */
#ifndef CZ_PROBLEM_PROBLEM_H
#define CZ_PROBLEM_PROBLEM_H

#include <string.h>

#include "base/suggest.h"
#include "crushzone/names.h"
#include "crushzone/problem.h"
#include "problem/input.h"

/* The typed records, borrowed. trains[i].vehicles point into one array of all vehicles, trains in
 * file order. */
const CzInput *cz_problem_input(const CzProblem *problem);
const CzVehicle *cz_problem_vehicles(const CzProblem *problem, int *n_vehicle);

/* The train behind (side 0) or ahead (1) that collides in a scenario, NULL for the trains as
 * written; NULL when there is none. */
static inline const CzTrain *cz_input_train(const CzInput *input, const CzScenario *scenario,
                                            int side) {
    const bool has_names = scenario != NULL && scenario->trains.n_text == 2;
    if (!has_names)
        return side < input->n_trains ? &input->trains[side] : NULL;
    for (int i = 0; i < input->n_trains; i++)
        if (input->trains[i].name != NULL &&
            strcmp(input->trains[i].name, scenario->trains.text[side]) == 0)
            return &input->trains[i];
    return NULL;
}

/* Perturbed interface of a scenario: the first inner one of the train behind. */
#define CZ_FIRST_COUPLED "first-coupled"

/* The effective track: rigid where no vehicle has wheels. */
CzTrack cz_problem_track(const CzProblem *problem);
/* Its word in a file. */
const char *cz_track_word(CzTrack track);

/* The files that were read, in order, the problem file first; more by `next` (text/node.h). NULL
 * when none was read. */
const struct CzSource *cz_problem_first_source(const CzProblem *problem);

/* Name of a file as results report it: an absolute path is given relative to the problem file or
 * the share folder, so that results do not depend on the folder of installation. Borrowed. */
const char *cz_problem_reported_name(const CzProblem *problem, const char *name);

/* Fills file, line, column of the place where a field of the input was written (the innermost
 * record when the field itself was not), and the status CZ_STATUS_INPUT. `field` is an address
 * inside the input. */
void cz_problem_place(const CzProblem *problem, const void *field, CzError *error);

/* The same where the status is CZ_STATUS_INPUT and there is an error; returns the status. */
CzStatus cz_problem_place_failure(const CzProblem *problem, const void *field, CzStatus status,
                                  CzError *error);

/* Fails with CZ_STATUS_INPUT and a sentence at that place. */
CzStatus cz_problem_fail(const CzProblem *problem, const void *field, CzError *error,
                         const char *format, ...) __attribute__((format(printf, 4, 5)));

/* The folder that was searched after the file's own; NULL for none. Borrowed. */
const char *cz_problem_share_folder(const CzProblem *problem);

/* Checks the vehicles of a candidate design, one array like the problem's own, by the rules for the
 * vehicles of a file, so that a design that passes can be written to a file and read. Statuses:
 * CZ_OK, CZ_STATUS_INPUT with the first broken rule, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_problem_check_vehicles(const CzProblem *problem,
                                                 const CzVehicle *vehicles, CzError *error);

/* Rules between values that a design variable can violate. */
typedef enum CzValueRule {
#define CZ_VALUE_RULE(constant, name, doc) CZ_VALUE_RULE_##constant,
#include "problem/value_rules.def"
#undef CZ_VALUE_RULE
    CZ_N_VALUE_RULE
} CzValueRule;

/* Utilisation of each rule at an end of a candidate's vehicle: the limited number over its limit,
 * above 1 when the rule is violated, NaN where it does not apply. `vehicle` is one of `vehicles`,
 * `end` one of its ends; `ratio` is (CZ_N_VALUE_RULE). */
void cz_problem_rule_ratios(const CzProblem *problem, const CzVehicle *vehicles,
                            const CzVehicle *vehicle, const CzEnd *end, double *ratio);

/* One number of the input that a path names. */
typedef struct CzTarget {
    const double *field;      /* in the input */
    int vehicle;              /* index into cz_problem_vehicles; -1 for a number elsewhere */
    size_t offset;            /* of the double inside CzVehicle [byte]; 0 elsewhere */
    double value;             /* the file's own value [SI] */
    double unit;              /* SI value of one unit of the path's key, such as 1000 for kN */
    const char *suffix;       /* unit as typed, such as "kN"; "" when none; borrowed */
    int match;                /* which match of a [*] this belongs to, from 0 */
    bool may_vary;            /* the key is one of the kinds an optimiser may change */
    bool may_fit;             /* or one that may be fitted to measurements */
    char place[CZ_PATH_SIZE]; /* path of this match without any *, as in `set:`; the targets
                        of one match share it */
} CzTarget;

/* The targets of a variable's paths, path by path. */
typedef struct CzTargets {
    int n;
    CzTarget *target; /* (n) */
} CzTargets;

/* Targets of the index-th variable of `optimise:`, found when the problem was read. For a variable
 * with choices each target is a whole buffer: `offset` is that of the buffer, `place` of its `use`,
 * and value and unit are 1. None in a problem that was read again. Borrowed. */
const CzTargets *cz_problem_targets(const CzProblem *problem, int variable);

/* Adds all numbers that setting a path would change, ordered by match. Through `parts.NAME` those
 * of every vehicle that uses the part and does not override the key; through a vehicle of a train
 * those of this vehicle and of all that repeat or copy it (they have no values of their own); after
 * a * the items that have the record. The array of targets is allocated with malloc and freed by
 * the caller. Statuses: CZ_OK, CZ_STATUS_INPUT with a did-you-mean, CZ_STATUS_NO_MEMORY.
 */
CZ_MUST_CHECK CzStatus cz_problem_find(const CzProblem *problem, const char *path,
                                       CzTargets *targets, CzError *error);

/* Reads the problem again with further settings "path" = "value", and checks all rules except those
 * on limits and variables. Shares the problem's tree, so it must not outlive it; freed by the
 * caller. May be called from several threads. Statuses: CZ_OK, CZ_STATUS_INPUT with the first
 * mistake, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_problem_read_again(const CzProblem *problem, int n_more,
                                             const char *const *path, const char *const *value,
                                             CzProblem **again, CzError *error);

/* Reads the problem again as if the command line had these further settings "path=value" (n_set);
 * only its profile, measured histories and further files of curves are opened. All rules are
 * checked. As cz_problem_read_again. */
CZ_MUST_CHECK CzStatus cz_problem_read_with(const CzProblem *problem, int n_set,
                                            const char *const *set, CzProblem **made,
                                            CzError *error);

/* The same for a path of a change of a scenario: outside of parts every vehicle of the trains has
 * places of its own, also that of a copy. */
CZ_MUST_CHECK CzStatus cz_problem_find_changed(const CzProblem *problem, int scenario,
                                               const char *path, CzTargets *targets,
                                               CzError *error);

/* The key by which a scenario sets all numbers of some targets itself, such as "speed_km_h", so
 * that their values elsewhere have no effect in it: a key of its own, "changes", or "trains" where
 * they belong to a train that it does not run. NULL when one of them has an effect. Borrowed. */
const char *cz_problem_replaced_by(const CzProblem *problem, int scenario,
                                   const CzTargets *targets);

/* The problem with the values that a scenario changes: the problem itself where it changes none.
 * Borrowed. */
const CzProblem *cz_problem_in_scenario(const CzProblem *problem, int scenario);

/* ---- changed values and further scenarios ---- */

typedef enum CzCaseKind { CZ_CASE_VALUE, CZ_CASE_FACTOR, CZ_CASE_ADD } CzCaseKind;

/* Kind and number of a change of a file. */
CzCaseKind cz_change_kind(const CzChange *change, double *number);

/* One changed value, as a scenario has it in a file. */
typedef struct CzCaseChange {
    const char *path;
    CzCaseKind kind;
    double number; /* value or sum in the unit of the path's key, or a factor */
} CzCaseChange;

/* A further scenario: a sample or a challenge. Texts and arrays are borrowed. */
typedef struct CzCase {
    const char *name; /* unlike that of any other scenario */
    int scenario;     /* that it is like */
    bool reserves;    /* whether design rules require their reserves */
    int n_change;
    const CzCaseChange *change; /* (n_change) */
} CzCase;

/* Reads the problem again with further scenarios behind its own, in the order of `cases` (n_case).
 * Cases with equal changes should follow one another: they share their changed problem. Shares the
 * problem's tree, so it must not outlive it; freed by the caller. May be called from several
 * threads. Statuses: CZ_OK, CZ_STATUS_INPUT with the first mistake, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_problem_read_cases(const CzProblem *problem, int n_case,
                                             const CzCase *cases, CzProblem **extended,
                                             CzError *error);

/* Finds the places of the variables where they are in another reading of the same file; false
 * without memory. */
CZ_MUST_CHECK bool cz_problem_take_targets(CzProblem *made, const CzProblem *problem);

/* ---- devices ---- */

/* A device that a part or a path names, at all its places, which have one curve. Borrowed from the
 * problem. */
typedef struct CzPlacedDevice {
    char path[CZ_PATH_SIZE]; /* such as parts.front-zone; a key of the device follows */
    const char *what;        /* such as "anti-climber" */
    bool is_loading; /* the force of a stage is that at its end, as of buffers and ends; else a
                        plateau */
    int count;       /* devices side by side at each place; forces are of one of them */
    int n_stage;
    const CzStage *stage;  /* (n_stage) */
    int most_stages;       /* that such a device may have */
    double peak;           /* trigger or preload [N]; NaN for none */
    const char *peak_key;  /* its key, such as "trigger_N" */
    double trigger_length; /* of a plateau's trigger [m] */
    int n_place;
    const CzEnd *const *place; /* ends with the device; freed by cz_placed_device_free (n_place) */
} CzPlacedDevice;

/* Finds the device of a part by the part's name, or that of a path such as
 * trains.A.vehicles.A6.front.anti_climber; of a part with one device in it, such as the tube of a
 * coupler, that one. Statuses: CZ_OK, CZ_STATUS_INPUT with a did-you-mean, or when there are
 * several, none, or none that a vehicle uses; CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CzStatus cz_problem_find_device(const CzProblem *problem, const char *name,
                                              CzPlacedDevice *device, CzError *error);
void cz_placed_device_free(CzPlacedDevice *device);

/* Reads the problem again with other stages at the path of a device, and without `optimise:`. As
 * cz_problem_read_again. */
CZ_MUST_CHECK CzStatus cz_problem_read_stages(const CzProblem *problem, const char *path,
                                              int n_stage, const CzStage *stage, CzProblem **made,
                                              CzError *error);

/* A measured time history, borrowed from the problem. */
typedef struct CzMeasured {
    int n_point;
    const double *time;            /* rising [s] (n_point) */
    const double *value;           /* in the unit of its channel (n_point) */
    const struct CzSource *source; /* its file */
    int number;                    /* of the file among those that matches name, from 1 */
} CzMeasured;

/* The time history that the i-th match of the problem names, cut to its window; without points when
 * it names none. */
const CzMeasured *cz_problem_measured(const CzProblem *problem, int match);

/* The file of time histories that has this number, from 1, and the name of its copy in a result
 * folder, such as "measured/1-test.csv"; NULL beyond the last. */
const struct CzSource *cz_problem_measured_file(const CzProblem *problem, int number, size_t room,
                                                char *name);

/* cz_problem_write_resolved for a result folder: it names the copies of the time histories there.
 */
void cz_problem_write_resolved_in_folder(const CzProblem *problem, FILE *stream);

/* The profile of the problem: NAME.yaml in profiles/ beside the problem file, then in the share
 * folder. It has the limits and scenarios of the problem's category. Borrowed; NULL for none. */
const CzProfile *cz_problem_profile(const CzProblem *problem);

/* Whether a profile has a scenario or family of a name, in any category. */
bool cz_profile_has_scenario(const CzProfile *profile, const char *name, CzSuggestion *nearest);

/* Why a scenario of a profile is run, or not. */
typedef enum CzStanding {
    CZ_STANDING_RUN,          /* as the profile has it */
    CZ_STANDING_REPLACED,     /* by one of the file, of its name or family */
    CZ_STANDING_NOT_SELECTED, /* by `checks: {scenarios: ...}` */
    CZ_STANDING_NOT_APPLICABLE
} CzStanding;

/* A scenario of the profile in this problem. Borrowed from the problem. */
typedef struct CzAskedScenario {
    const CzProfileScenario *scenario;
    CzStanding standing;
    const char *why; /* it does not apply, or what replaces it; NULL otherwise */
    double speed;    /* that the profile asks for [m/s] */
} CzAskedScenario;

/* The scenarios of the problem's profile: those of the category, then those that do not apply. */
const CzAskedScenario *cz_problem_profile_scenarios(const CzProblem *problem, int *n_asked);

#endif
