/* Problems made of typed records: defaults from keys.def, and stand-ins for the reader's functions.
 */
#include "support/typed_problem.h"

#include <string.h>

/* ---- defaults ---- */

#define ABSENT_REQUIRED(value) NAN
#define ABSENT_REQUIRED_FULL(value) NAN
#define ABSENT_OPTIONAL(value) NAN
#define ABSENT_DEFAULT(value) (value)
#define CZ_RECORD(type, name, doc, keys)                                                           \
    type default_##type(void) {                                                                    \
        type record;                                                                               \
        memset(&record, 0, sizeof record);                                                         \
        keys return record;                                                                        \
    }
#define CZ_NUMBER(type, stem, dimension, lo, hi, usual, presence, absent, kind, doc)               \
    record.stem = ABSENT_##presence(absent);
#define CZ_COUNT(type, stem, lo, hi, presence, absent, doc) record.stem = absent;
#define CZ_CHOICE(type, stem, set, presence, absent, doc) record.stem = absent;
#define CZ_FLAG(type, stem, absent, doc) record.stem = absent;
#define CZ_TEXT(type, stem, presence, doc)
#define CZ_CHILD(type, stem, child, presence, doc) record.stem = default_##child();
#define CZ_STAGES(type, stem, presence, doc)
#define CZ_TABLE(type, stem, x, x_dimension, y, y_dimension, presence, doc)
#define CZ_LIST(type, stem, child, presence, doc)
#define CZ_NAMED(type, stem, child, presence, doc)
#define CZ_TEXTS(type, stem, presence, doc)
#include "problem/keys.def"

/* ---- stand-ins for the reader ---- */

const CzInput *cz_problem_input(const CzProblem *problem) {
    return &problem->input;
}

const CzVehicle *cz_problem_vehicles(const CzProblem *problem, int *n_vehicle) {
    *n_vehicle = problem->train[0].n_vehicles + problem->train[1].n_vehicles;
    return problem->vehicle;
}

const CzProblem *cz_problem_in_scenario(const CzProblem *problem, int scenario) {
    (void)scenario;
    return problem;
}

/* Line n is vehicle n of the problem, counted from 1; 0 for anything else. */
void cz_problem_place(const CzProblem *problem, const void *field, CzError *error) {
    const char *first = (const char *)problem->vehicle, *place = field;
    const bool is_inside = place >= first && place < first + sizeof problem->vehicle;
    if (error == NULL)
        return;
    error->status = CZ_STATUS_INPUT;
    error->line = is_inside ? (int)((size_t)(place - first) / sizeof(CzVehicle)) + 1 : 0;
}

/* ---- problems ---- */

void typed_problem_init(struct CzProblem *problem, int n_behind, const CzVehicle *behind,
                        int n_ahead, const CzVehicle *ahead, double speed) {
    memset(problem, 0, sizeof *problem);
    problem->input = default_CzInput();
    problem->input.simulation.given = true;
    problem->input.simulation.adhesion.given = true;
    problem->input.simulation.adhesion.friction = 0.3;
    problem->input.trains = problem->train;
    problem->input.n_trains = 2;
    problem->input.scenarios = problem->scenario;
    for (int i = 0; i < TYPED_MAX_SCENARIO; i++) {
        problem->scenario[i] = default_CzScenario();
        problem->scenario[i].name = "scenario";
    }
    memcpy(problem->vehicle, behind, (size_t)n_behind * sizeof *behind);
    memcpy(problem->vehicle + n_behind, ahead, (size_t)n_ahead * sizeof *ahead);
    for (int i = 0; i < 2; i++) {
        CzTrain *train = &problem->train[i];
        *train = default_CzTrain();
        train->name = i == 0 ? "A" : "B";
        train->speed = i == 0 ? speed : 0.0;
        train->brake.given = true;
        train->brake.ratio = 0.0;
        train->brake.axle_share = 0.0;
        train->vehicles = i == 0 ? problem->vehicle : problem->vehicle + n_behind;
        train->n_vehicles = i == 0 ? n_behind : n_ahead;
    }
}

static CzStage stage(double stroke, double force) {
    CzStage made = default_CzStage();
    made.stroke = stroke;
    made.force = force;
    return made;
}

CzEnd typed_bare_end(void) {
    CzEnd end = default_CzEnd();
    end.given = true;
    end.face_gap = 0.0;
    end.unloading_stiffness = 1e10;
    return end;
}

CzVehicle typed_rigid(double mass) {
    CzVehicle vehicle = default_CzVehicle();
    vehicle.given = true;
    vehicle.model = CZ_MODEL_RIGID;
    vehicle.mass = mass;
    vehicle.front = typed_bare_end();
    vehicle.rear = typed_bare_end();
    return vehicle;
}

CzVehicle typed_wall(void) {
    CzVehicle vehicle = default_CzVehicle();
    vehicle.given = true;
    vehicle.model = CZ_MODEL_FIXED;
    return vehicle;
}

static CzCoupler full_coupler(void) {
    CzCoupler coupler = default_CzCoupler();
    coupler.given = true;
    coupler.height = 0.7;
    coupler.length = 1.4;
    coupler.buffer.given = true;
    coupler.buffer.preload = 2e4;
    coupler.buffer.n_stages = 1;
    coupler.buffer.stages[0] = stage(0.05, 4e5);
    coupler.tube.given = true;
    coupler.tube.n_stages = 1;
    coupler.tube.stages[0] = stage(0.25, 6e5);
    coupler.shear_off.given = true;
    coupler.shear_off.force = 911e3;
    coupler.shear_off.retraction_space = 1.0;
    coupler.hinge.given = true;
    coupler.hinge.stiffness = 6e5;
    coupler.hinge.moment_capacity = 1e5;
    coupler.hinge.swing_stop = 0.1;
    return coupler;
}

static CzAntiClimber full_anti_climber(void) {
    CzAntiClimber anti_climber = default_CzAntiClimber();
    anti_climber.given = true;
    anti_climber.count = 2;
    anti_climber.gap = 0.32;
    anti_climber.height = 0.95;
    anti_climber.n_stages = 1;
    anti_climber.stages[0] = stage(0.3, 5e5);
    anti_climber.face_height = 0.2;
    anti_climber.rib_count = 4;
    anti_climber.rib_depth = 0.03;
    anti_climber.rib_strength = 32e3;
    anti_climber.friction = 0.2;
    return anti_climber;
}

static CzEnd full_end(void) {
    CzEnd end = typed_bare_end();
    end.mass = 1000.0;
    end.pitch_inertia = 600.0;
    end.cg_height = 1.2;
    end.crush_height = 0.95;
    end.distance = 10.6;
    end.face_gap = 0.7;
    end.n_stages = 4;
    end.stages[0] = stage(0.02, 1.2e6);
    end.stages[1] = stage(0.06, 1.0e6);
    end.stages[2] = stage(0.32, 1.5e6);
    end.stages[3] = stage(0.20, 4.5e6);
    end.unloading_stiffness = 1e8;
    end.second_unloading_stiffness = 3e7;
    end.coupler = full_coupler();
    end.anti_climber = full_anti_climber();
    return end;
}

/* Bogie of the Manchester benchmark coach (Iwnicki 1998); values missing in the benchmark are ours.
 */
static CzBogie full_bogie(void) {
    CzBogie bogie = default_CzBogie();
    bogie.given = true;
    bogie.mass = 2615.0;
    bogie.pitch_inertia = 1476.0;
    bogie.cg_height = 0.6;
    bogie.axle_spacing = 2.56;
    bogie.wheel_radius = 0.43;
    bogie.wheelset_mass = 1813.0;
    bogie.wheelset_inertia = 100.0;
    bogie.guidance_stiffness = 6e7;
    bogie.guidance_damping = 3e4;
    bogie.primary.given = true;
    bogie.primary.stiffness = 2.4e6;
    bogie.primary.damping = 8e3;
    bogie.primary.bump_gap = 0.035;
    bogie.primary.lift_gap = 0.025;
    bogie.secondary.given = true;
    bogie.secondary.stiffness = 8.6e5;
    bogie.secondary.damping = 4e4;
    bogie.secondary.blow_off = 2e4;
    bogie.secondary.damping_beyond = 4e3;
    bogie.secondary.bump_gap = 0.04;
    bogie.secondary.lift_gap = 0.03;
    bogie.link.given = true;
    bogie.link.height = 0.65;
    bogie.link.stiffness = 1e7;
    bogie.link.damping = 5e4;
    return bogie;
}

CzVehicle typed_full(void) {
    CzVehicle vehicle = default_CzVehicle();
    vehicle.given = true;
    vehicle.model = CZ_MODEL_FULL;
    vehicle.mass = 44482.0; /* body and ends 32 t, as the benchmark coach */
    vehicle.pitch_inertia = 1.97e6 - 2.0 * (600.0 + 1000.0 * 10.6 * 10.6);
    vehicle.cg_height = 1.6;
    vehicle.bogie_spacing = 19.0;
    vehicle.length = 22.8;
    vehicle.bogie = full_bogie();
    vehicle.front = full_end();
    vehicle.rear = full_end();
    return vehicle;
}
