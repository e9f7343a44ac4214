/* A run during and after its simulation: common data of the files of this folder. */
#ifndef CZ_SIMULATE_RUN_H
#define CZ_SIMULATE_RUN_H

#include "base/arena.h"
#include "crushzone/simulate.h"
#include "dynamics/dynamics.h"
#include "dynamics/equipment.h"
#include "dynamics/stored.h"
#include "model/model.h"

/* Columns of the recorded channels and their values. */
typedef struct CzChannels {
    int n_column, n_sample, capacity;
    CzColumn *column; /* (n_column) */
    double **value;   /* (n_column x capacity), each row from malloc */
} CzChannels;

struct CzRun {
    CzArena arena; /* results */
    CzRunSummary summary;
    CzChannels channels;
};

/* Body speeds and interface forces of a design after every time step. */
typedef struct CzHistory {
    int n_step;
    int n_chunk;
    double **chunk; /* CZ_CHUNK steps each: speeds and forces of each car in turn */
} CzHistory;
enum { CZ_CHUNK = 1024 };

/* State of one design of a batch. */
typedef struct CzProgressOfDesign {
    const CzModel *model;      /* borrowed, as are the vehicles */
    const CzVehicle *vehicles; /* of the model's problem, with the design's values */
    CzRun *run;                /* receives the summary */
    double closing_speed;      /* of the trains at t = 0 [m/s] */
    CzHistory history;
    long last; /* step with which its duration ends; 0 without one */
    bool over, has_summary;
    CzEnded ended;
    char failure[256];
    double initial_energy;
    double balance;       /* largest |residual| so far [J] */
    long accounts_taken;  /* steps after which the accounts were taken, plus 1; 0 at first */
    double kinetic, work; /* of the bodies and of all laws, when they were taken [J] */
    int n_look;           /* examinations of the end criterion so far */
    const char *awaited;  /* what the end criterion waits for; NULL when it is met */
    double quiet_since;   /* since when the end criterion is met; NaN when it is not */
    double settled_since; /* likewise the criterion of a brief run */
    double plastic;       /* sum of the plastic strokes at the last examination [m] */
    double dissipated;    /* dissipated energy when it last changed [J] */
    double dissipated_at; /* when that was [s] */
    double wheel_rail; /* work at wheels and brakes until the trains first had the same speed [J];
                          NaN before */
    double override_time; /* NaN until it happens */
} CzProgressOfDesign;

/* Energy stored in the track under the cars of a block, computed for all of them when one is
 * requested. */
typedef struct CzTrackAccount {
    long taken;   /* as CzProgressOfDesign.accounts_taken */
    CzRow stored; /* [J] */
} CzTrackAccount;

/* A batch that is simulated: designs, each in its own scenario. */
typedef struct CzBatch {
    CzArena arena;
    CzArena laid; /* lanes, dynamics and all other data by lane or block */
    int n_car;    /* of every design */
    const CzKernel *kernel;
    CzLanes *lanes;
    CzDynamics *dynamics;
    CzInterfaceEquipment *equipment; /* by lane */
    CzCarEquipment *car_equipment;   /* by lane */
    CzStored *stored;                /* by lane, when the accounts were taken */
    CzTrackAccount *in_track;        /* by block */
    int n_design;                    /* in the lanes: runs that are over may have left them */
    bool brief;                      /* end as soon as the results are final */
    bool keeps_pulses;
    CzTrack track;
    CzIntegrator integrator;
    struct CzReference *reference; /* NULL under the fixed-step scheme */
    double step, time;             /* [s] */
    long n_step;
    long sampling;                /* steps between samples of pulses and sequences */
    CzProgressOfDesign *design;   /* (n_design) */
    struct CzInterfaceLoad *load; /* by lane */
    struct CzSequence *sequence;  /* by lane; NULL without pulses */
} CzBatch;

/* Lane of a car of a design. */
static inline size_t cz_lane(const CzBatch *batch, int car, int design) {
    return (size_t)car * (size_t)batch->n_design + (size_t)design;
}

/* Description of a car of a design. */
static inline const CzCar *cz_car(const CzBatch *batch, int car, int design) {
    return &batch->design[design].model->car[car];
}

/* Values in a lane. */
static inline double cz_position(const CzBatch *batch, int dof, size_t lane) {
    return cz_row_of(&cz_block_of(batch->dynamics, lane)->position, dof)[lane % CZ_LANE_BLOCK];
}
static inline double cz_velocity(const CzBatch *batch, int dof, size_t lane) {
    return cz_row_of(&cz_block_of(batch->dynamics, lane)->velocity, dof)[lane % CZ_LANE_BLOCK];
}
static inline double cz_memory(const CzBatch *batch, int row, size_t lane) {
    return cz_row_of(cz_block_of(batch->dynamics, lane)->memory, row)[lane % CZ_LANE_BLOCK];
}
static inline double cz_extreme(const CzBatch *batch, int row, size_t lane) {
    return cz_row_of(&cz_block_of(batch->dynamics, lane)->extreme, row)[lane % CZ_LANE_BLOCK];
}
static inline double cz_work(const CzBatch *batch, int row, size_t lane) {
    return cz_row_of(&cz_block_of(batch->dynamics, lane)->work, row)[lane % CZ_LANE_BLOCK];
}
static inline double cz_published(const CzBatch *batch, int row, size_t lane) {
    return cz_row_of(&cz_block_of(batch->dynamics, lane)->published, row)[lane % CZ_LANE_BLOCK];
}

/* Speed at which the cars of an interface approach one another [m/s]. */
static inline double cz_closing_speed(const CzBatch *batch, int interface, int design) {
    return cz_velocity(batch, CZ_DOF(body.x), cz_lane(batch, interface, design)) -
           cz_velocity(batch, CZ_DOF(body.x), cz_lane(batch, interface + 1, design));
}

/* Speed below which neighbouring cars have ceased to close in, for the end criterion [m/s]. */
#define CZ_CLOSING_SPEED 0.1

/* The largest of them, at least 0. */
double cz_largest_closing_speed(const CzBatch *batch, int design);

/* The end of a car at side A (0) or B (1) of an interface; side A is a front end. */
static inline const CzEnd *cz_end_at(const CzBatch *batch, int car, int design, int side) {
    const CzVehicle *vehicle = &batch->design[design].vehicles[cz_car(batch, car, design)->vehicle];
    return side == 0 ? &vehicle->front : &vehicle->rear;
}

/* Rows of both ends of a car, or both sides of an interface. */
#define CZ_MEMORY_PAIR(pair, member)                                                               \
    { CZ_MEMORY(pair[0].member), CZ_MEMORY(pair[1].member) }
#define CZ_EXTREME_PAIR(pair)                                                                      \
    { CZ_EXTREME(pair[0]), CZ_EXTREME(pair[1]) }
#define CZ_CURVE_PAIR(pair)                                                                        \
    { CZ_CURVE(pair[0]), CZ_CURVE(pair[1]) }

/* history.c */
CZ_MUST_CHECK CzStatus cz_history_add(const CzBatch *batch, int design);
void cz_history_free(CzHistory *history);
/* The pulse of a car, in memory of the arena; false when there is none left. */
bool cz_history_pulse(const CzBatch *batch, int car, int design, CzArena *arena, CzPulse *pulse);
/* Forces of an interface after every step (n_step of the history). */
void cz_history_forces(const CzBatch *batch, int interface, int design, double *force);

/* sequence.c: notes the sequence of the devices at a sample; sets the early energy of the elements
 * of a side, NaN where it was not noted. */
typedef struct CzSequence CzSequence;
CzSequence *cz_sequence_begin(const CzBatch *batch, CzArena *arena);
void cz_sequence_move(CzBatch *batch, size_t lane, const CzBatch *from, size_t from_lane);
void cz_sequence_update(const CzBatch *batch, int design);
void cz_sequence_judge(const CzBatch *batch, int interface, int design, int side, int n_element,
                       CzElementResult *element);

/* accounts.c: updates the accounts of a design for this step. */
void cz_accounts_take(const CzBatch *batch, int design);
/* From the last accounts: energy that an element has received, and its stored part [J]. The lane is
 * that of the interface, or of the car for elements of one car. */
typedef struct CzAccount {
    double received, stored;
} CzAccount;
/* Whether a side has a coupler, an anti-climber, side buffers, a superstructure or a draw gear. */
bool cz_has_element(const CzBatch *batch, size_t lane, int side, CzElementKind kind);
CzAccount cz_coupler_account(const CzBatch *batch, size_t lane, int side);
CzAccount cz_anti_climber_account(const CzBatch *batch, size_t lane, int side);
CzAccount cz_side_account(const CzBatch *batch, size_t lane, int side);
CzAccount cz_superstructure_account(const CzBatch *batch, size_t lane); /* of one side */
CzAccount cz_draw_gear_account(const CzBatch *batch, size_t lane);      /* of one side */
/* Faces of two bare ends, both sides together; nothing where an anti-climber is. */
CzAccount cz_bare_faces_account(const CzBatch *batch, size_t lane);
/* Crush zone of an end with mass, and the rest of that end; crush zone of an end without. */
CzAccount cz_crush_account(const CzBatch *batch, size_t lane, int end);
CzAccount cz_guide_account(const CzBatch *batch, size_t lane, int end);
CzAccount cz_end_mass_account(const CzBatch *batch, size_t lane, int end);
CzAccount cz_massless_account(const CzBatch *batch, size_t lane, int side);
/* All series chains of an interface together. */
CzAccount cz_chains_account(const CzBatch *batch, size_t lane);
/* Elastic energy in the elements of an interface [J]. */
double cz_interface_stored(const CzBatch *batch, int interface, int design);
/* Energy stored in the track under a car now [J]. */
double cz_track_account(const CzBatch *batch, size_t lane);
/* Springs of the running gear and the wheels' contact. */
CzAccount cz_gear_account(const CzBatch *batch, size_t lane);
/* Energy stored in the sliders and stops of a lane; their powers are in the ledger. */
CzAccount cz_springs_account(const CzBatch *batch, size_t lane);

/* energy_checks.c: whether the energies of a design are inconsistent, with the place and the
 * inconsistency. */
enum { CZ_FAULT_SIZE = 96 };
bool cz_energy_checks_fail(const CzBatch *batch, int design, char *where, char *what);

/* balance.c */
double cz_kinetic_energy(const CzBatch *batch, int design);
/* Residual of the energy balance [J]: kinetic energy and work of the laws less the initial energy,
 * when the accounts were taken. */
double cz_balance_residual(const CzBatch *batch, int design);
/* Work that all laws have received; classes as in ledger.def. */
double cz_total_work(const CzBatch *batch, int design);
double cz_wheel_rail_work(const CzBatch *batch, int design);
/* Mean speed of the movable vehicles of a train, weighted by mass. */
double cz_train_speed(const CzBatch *batch, int train, int design);
double cz_momentum_error(const CzBatch *batch, int design);
/* Largest deviation of a member of the interface's series chains from its law, over the largest
 * force of the interface. */
double cz_law_error(const CzBatch *batch, size_t lane);
/* interface_load.c: forces and energies of the interfaces of a design that can still change the
 * motion. */
#define CZ_STORED_SHARE 1e-3 /* of the initial energy: less does not change the results (ours) */
typedef struct CzInterfaceLoad CzInterfaceLoad;
typedef struct CzLoadLeft {
    bool force;  /* an interface that can open carries a force */
    bool stores; /* an interface stores more elastic energy than CZ_STORED_SHARE */
} CzLoadLeft;
/* Whether the two sides can part. */
bool cz_interface_can_open(const CzBatch *batch, int interface, int design);
CzInterfaceLoad *cz_interface_loads_begin(const CzBatch *batch, CzArena *arena);
void cz_interface_load_move(CzBatch *batch, size_t lane, const CzBatch *from, size_t from_lane);
CzLoadLeft cz_interface_loads_update(const CzBatch *batch, int design);

/* ending.c: whether a design is examined after this step, which is one after which all are or the
 * end of its own duration. */
static inline bool cz_ending_is_due(const CzBatch *batch, int design, bool is_time) {
    return is_time || batch->design[design].last == batch->n_step;
}
/* Examines the designs; returns how many are not over. */
int cz_ending_check(CzBatch *batch, bool is_time);

/* batch_lanes.c: creates the dynamics, the tracks and all other data of filled lanes. */
CZ_MUST_CHECK CzStatus cz_batch_set_up(CzBatch *batch, CzError *error);
/* Takes the designs that are over out of the lanes where the other n_left > 0 then need fewer
 * blocks; these are counted anew. */
CZ_MUST_CHECK CzStatus cz_batch_compact(CzBatch *batch, int n_left, CzError *error);

/* summary.c */
CZ_MUST_CHECK CzStatus cz_summary_fill(const CzBatch *batch, int design, CzRun *run);
CzEnergy cz_energy_fill(const CzBatch *batch, int design);
/* Energy dissipated in the trains and at their wheels [J]: cheaper, as that in the track is not
 * summed up. */
double cz_dissipated_above_track(const CzBatch *batch, int design);

/* elements.c */
void cz_interface_fill(const CzBatch *batch, int interface, int design, CzInterfaceResult *result);
/* Elements of an interface with their energies, without names and device results; returns how
 * many. */
int cz_interface_elements(const CzBatch *batch, int interface, int design,
                          CzElementResult element[CZ_MAX_ELEMENTS]);
/* Whether the end of a car at side A (0) or B (1) of an interface has a mass of its own. */
bool cz_has_end_mass(const CzBatch *batch, int car, int design, int side);
/* The outer end at the front (0) or the rear (1) of all vehicles; false where it has no mass. */
bool cz_outer_end_fill(const CzBatch *batch, int design, int side, CzElementResult *result);
/* What the elements of an interface have dissipated so far [J], as cz_interface_fill reports it. */
double cz_interface_energy(const CzBatch *batch, int interface, int design);
/* Fills the results of a car, whose pulse is kept in the arena unless it is NULL. */
CZ_MUST_CHECK CzStatus cz_vehicle_fill(const CzBatch *batch, int car, int design, CzArena *arena,
                                       CzPulse *pulse, CzVehicleResult *result);

/* rest.c: of the cars of a single design; all NaN for a car without running gear (n_car). */
CZ_MUST_CHECK CzStatus cz_rest_of_cars(const CzModel *model, const CzLanes *lanes, CzRest *rest,
                                       CzError *error);

/* channels.c: a single design only. */
CZ_MUST_CHECK CzStatus cz_channels_begin(CzChannels *channels, const CzBatch *batch);
CZ_MUST_CHECK CzStatus cz_channels_add(CzChannels *channels, const CzBatch *batch);
/* Sets the energies of a run beyond the validity of the model to NaN; the error of their balance
 * remains.
 */
void cz_channels_blank_totals(CzChannels *channels, double from);
void cz_channels_free(CzChannels *channels);

/* budget.c: impulses that pitch and lift the bodies of a single design. */
typedef struct CzBudget CzBudget;
/* NULL when there is no memory. */
CzBudget *cz_budget_begin(CzBatch *batch, CzArena *arena);
void cz_budget_add(CzBudget *budget, const CzBatch *batch);
const CzVehicleBudget *cz_budget_result(const CzBudget *budget); /* (n_car) */

/* watch.c: events of a single design. */
typedef struct CzWatch CzWatch;
CzWatch *cz_watch_begin(const CzBatch *batch, CzArena *arena);
void cz_watch_update(CzWatch *watch, const CzBatch *batch);
const CzEvent *cz_watch_events(const CzWatch *watch, int *n_event);

#endif
