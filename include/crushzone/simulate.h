/* One collision: run, events, extrema, energy ledger, recorded channels. */
#ifndef CRUSHZONE_SIMULATE_H
#define CRUSHZONE_SIMULATE_H

#include <stdbool.h>
#include <stddef.h>

#include "crushzone/channel.h"
#include "crushzone/model.h"

CZ_BEGIN_DECLARATIONS

typedef enum CzEnded {
#define CZ_ENDED(constant, key, text) constant,
#include "crushzone/ended.def"
#undef CZ_ENDED
} CzEnded;
CZ_API const char *cz_ended_key(CzEnded ended); /* such as "by rule", for documents */
CZ_API const char *
cz_ended_text(CzEnded ended); /* such as "end criterion met", for tables and messages */

/* Time integrators. The references have the same laws and the same end criterion, take about ten
 * times as long, and are for comparison. */
typedef enum CzIntegrator {
#define CZ_INTEGRATOR(constant, text, doc) constant,
#include "crushzone/integrators.def"
#undef CZ_INTEGRATOR
    CZ_N_INTEGRATOR
} CzIntegrator;
CZ_API const char *cz_integrator_text(CzIntegrator integrator);

typedef enum CzEventKind {
#define CZ_EVENT(constant, text, doc) constant,
#include "crushzone/events.def"
#undef CZ_EVENT
} CzEventKind;
CZ_API const char *cz_event_text(CzEventKind kind);

/* First occurrence of an event at a place. */
typedef struct CzEvent {
    double time; /* [s] */
    CzEventKind what;
    char where[CZ_WHERE_SIZE]; /* such as "coupler A4" or "A4 wheelset 2" */
    int interface; /* interface of the event, because a vehicle has two couplers of one name; -1 for
                      an event of a vehicle */
} CzEvent;

/* One energy absorber or connection of an interface. */
typedef enum CzElementKind {
#define CZ_ELEMENT(constant, text) constant,
#include "crushzone/elements.def"
#undef CZ_ELEMENT
    CZ_N_ELEMENT_KIND
} CzElementKind;
CZ_API const char *cz_element_text(CzElementKind kind);

typedef struct CzElementResult {
    char name[CZ_WHERE_SIZE]; /* "coupler A4" */
    CzElementKind kind;
    int vehicle;   /* vehicle that owns it */
    double energy; /* net dissipated [J] */
    double stored; /* still stored at the end [J] */
    double stroke; /* plastic stroke: tubes, anti-climber stages or crush zone together; of a buffer
                      without a tube its largest stroke [m] */
    double stroke_used;  /* largest share of any one device's usable stroke over the run [-]; 0 when
                            it has none; of a coupler that has sheared off, the share of its
                            retraction space. A buffer counts only without a tube or shear-off behind
                            it */
    double peak_force;   /* unfiltered largest force over all steps [N] */
    double tube_energy;  /* energy dissipated by the tubes and the shear-off of a coupler [J]; for
                            other elements all of it */
    double early_energy; /* part of it before the stroke of an earlier device of the end was
                            exhausted, in the sequence coupler or side buffers, anti-climber, end
                            [J]; NaN of runs without pulses */
    bool sheared;        /* the coupler has sheared off */
    bool bottomed_out; /* a device used its whole stroke, and no other device of the element follows
                          it */
    double zone_energy[3]; /* plastic energy by zone: crush, temporary, survival [J] */
} CzElementResult;

enum { CZ_MAX_ELEMENTS = 12 };

typedef struct CzInterfaceResult {
    char name[CZ_INTERFACE_SIZE]; /* "A4-B1" */
    double peak_force;            /* largest total longitudinal force over all steps [N] */
    double peak_time;             /* [s] */
    double peak_force_cfc180;     /* largest force through a filter CFC 180, every step counted [N];
                                     NaN without pulses, and where the time step is too long */
    double shortening;            /* largest closure between the bodies at this interface [m] */
    double energy;                /* dissipated [J] */
    double energy_share;          /* of the dissipated energy [-] */
    bool bottomed_out;
    double section_force[2]; /* largest force through the section behind the end, rear vehicle's and
                                front vehicle's [N] */
    double min_overlap; /* smallest remaining vertical overlap of the anti-climber faces while they
                           push [m]; NaN when they never did */
    double vertical_demand; /* largest vertical force between the anti-climbers [N] */
    double vertical_margin; /* smallest (capacity - demand) while they push [N], below 0 once they
                               slip by the force that would have held the slip; NaN when they never
                               did */
    double overlap_time;    /* time of the smallest overlap [s]; NaN likewise */
    double margin_time;     /* time of the smallest vertical margin [s]; NaN likewise */
    double ramp;            /* largest slope of the faces while they push [-]; NaN likewise */
    double friction;        /* of the faces, for comparison [-]; NaN without anti-climbers */
    double underframe_rise; /* largest change of the height of one underframe over the other, at the
                               pivots of the couplers or, without couplers, at the bare end
                               structures [m]; NaN where neither can rise, and at a wall */
    double swing[2];        /* largest angle of the engaged coupler against its car, rear vehicle's
                               and front vehicle's [rad]; NaN without couplers */
    double swing_stop[2];   /* angle of their stops [rad]; NaN without */
    double critical_force;  /* F_crit, at which the undamaged trains fold here as a chain of
                               coupler struts [N]; NaN without couplers */
    int n_element;
    CzElementResult element[CZ_MAX_ELEMENTS];
} CzInterfaceResult;

enum { CZ_N_FREE_FLIGHT = 10 }; /* distances for which the secondary impact is listed */

typedef struct CzVehicleResult {
    char name[CZ_NAME_SIZE];
    double final_speed;               /* of the body [m/s] */
    double peak_deceleration;         /* largest |acceleration| of the body, unfiltered [m/s2] */
    double mean_deceleration_contact; /* largest mean over a window of net contact force [m/s2] */
    double mean_deceleration_120ms;   /* largest mean over any window of 120 ms or more [m/s2] */
    double contact_window[2];         /* start and end of the first of these windows, and */
    double window_120ms[2];           /* of the second [s]; equal where there is none */
    double peak_deceleration_cfc60;   /* largest |acceleration| through a filter CFC 60 [m/s2]; NaN
                                         without a pulse */
    double secondary_impact[CZ_N_FREE_FLIGHT]; /* velocity of a free occupant against the vehicle
                                                  after 0.1, 0.2, ... m [m/s]; NaN likewise */
    double wheel_lift[4];      /* largest lift of each wheelset, rear to front [m] */
    double wheel_lift_time[4]; /* [s] */
    double bogie_lift_time;    /* time of the next [s] */
    int lifted_bogie;          /* where: 0 rear, 1 front */
    double bogie_lift;         /* largest over bogies and time of the lower wheelset's lift [m] */
    double max_pitch;          /* largest |pitch| of the body [rad] */
    double link_force;         /* largest traction link force [N] */
    double
        link_travel; /* largest travel of a bogie relative to the body at its traction link [m] */
    double bogie_acceleration;  /* largest |longitudinal acceleration| of a bogie frame, unfiltered
                                   [m/s2] */
    double survival_loss[2];    /* stroke of the survival zones of the rear and the front end [m];
                                   NaN where an end has none */
    double survival_shortening; /* sum of both [m]; NaN when neither end has a survival zone */
    bool checks_override;       /* bump and lift stops are given, so that override can be judged */
} CzVehicleResult;

/* A time over which the net contact force on a vehicle keeps its sign above a floor. */
typedef struct CzContactWindow {
    double from, to; /* [s] */
    double mean;     /* |change of speed| / time [m/s2] */
} CzContactWindow;

/* Speed of a body and net contact force on its vehicle over time, unfiltered, from t = 0. */
typedef struct CzPulse {
    int n_sample, n_step;
    double step;              /* between samples of the speed [s] */
    double time_step;         /* of the run [s] */
    const double *speed;      /* [m/s] (n_sample) */
    const double *step_speed; /* the same after every time step [m/s] (n_step) */
    const double *force;      /* push from behind less push from ahead [N] (n_step) */
    int n_window;
    const CzContactWindow
        *window; /* contact windows with at least half of the largest mean, however
                    short, with a floor of 1 % of the largest force (n_window) */
} CzPulse;

/* Sources of the pitch and lift of a body. */
typedef enum CzBudgetSource {
#define CZ_BUDGET(constant, text, counts, doc) constant,
#include "crushzone/budget.def"
#undef CZ_BUDGET
    CZ_N_BUDGET
} CzBudgetSource;
CZ_API const char *cz_budget_text(CzBudgetSource source);

/* Whether a source acts on the body itself; the impulses of these sources add up to its momenta. */
CZ_API bool cz_budget_counts(CzBudgetSource source);

/* Impulses on the body of one vehicle from the start to the time of its largest wheel lift, of its
 * largest pitch when no wheel lifts by 0.1 mm, or to the override, which ends the validity of the
 * model.
 */
typedef struct CzVehicleBudget {
    bool of_lift;               /* to the largest wheel lift */
    double time;                /* where it ends [s] */
    double moment[CZ_N_BUDGET]; /* about the body's centre of gravity, nose-up [N m s] */
    double lift[CZ_N_BUDGET];   /* upwards, in excess of the weight [N s] */
    double spin;                /* angular momentum of the body then, nose-up [N m s] */
    double rise;                /* its vertical momentum [N s] */
} CzVehicleBudget;

/* The sources with an impulse, largest moment first; returns their number. */
CZ_API int cz_budget_order(const CzVehicleBudget *budget, int order[CZ_N_BUDGET]);

/* Energy at the end of the run [J]. */
typedef struct CzEnergy {
    double initial;
    double final_kinetic;
    double dissipated; /* plastic, friction, damping: net over the run */
    double stored; /* elastic energy above that at rest, gravitational energy, and kinetic energy of
                      the track */
    double moving_load;  /* neither: work of the longitudinal force of a sloping elastic rail, which
                            the model does not apply to the wheels */
    double wheel_rail;   /* part of `dissipated` at wheels and brakes */
    double running_gear; /* part of `dissipated` in links, stops, suspensions and dampers */
    double track;        /* part of `dissipated` in pads, ballast and subgrade */
    double absorbers; /* part of `dissipated` in couplers, anti-climbers, ends and side buffers */
    double survival;  /* part of `absorbers` in survival zones */
    double balance_error; /* |residual| over the initial energy [-], the largest over the run */
} CzEnergy;

/* Results of a run. Open, borrowed from the run. Failed results are NaN. */
typedef struct CzRunSummary {
    const char *scenario;
    CzStatus status;   /* CZ_OK or CZ_STATUS_RUN_FAILED */
    char failure[256]; /* car, element and time when failed; empty otherwise */
    CzEnded ended;
    const char *awaited; /* unmet part of the end criterion of an incomplete run */
    double simulated;    /* [s] */
    CzIntegrator integrator;
    double time_step; /* [s]; steps of a reference are at most half of it */
    long n_step;
    CzEnergy energy;
    double momentum_error;
    double law_error;     /* largest distance of a member of a series chain from its law, over the
                             largest force of the interface [-] */
    long n_searched;      /* solutions of series chains that needed a search */
    double rest_residual; /* largest force left unbalanced at rest over the weight of its vehicle
                             [-]; NaN without full vehicles, and of runs that are not recorded */
    double closing_speed; /* largest closing speed of neighbours at the end [m/s] */
    double
        plastic_energy; /* energy that a perfectly plastic collision would dissipate, less the work
                           at wheels and brakes until the trains first have the same speed [J] */
    bool beyond_validity;        /* an override occurred: later values are beyond the model */
    double beyond_validity_time; /* [s]; NaN when not */
    int n_interface;
    const CzInterfaceResult *interface; /* (n_interface) */
    int n_outer_end;
    CzElementResult outer_end[2]; /* the two ends that face no other vehicle, rear and front of the
                                     row, whose masses move too */
    int n_vehicle;
    const CzVehicleResult *vehicle; /* (n_vehicle) */
    const CzPulse *pulse; /* of a run that is recorded or keeps pulses, else NULL (n_vehicle) */
    const CzVehicleBudget *budget; /* of a recorded run of the usual integrator, else NULL; all 0
                                      for vehicles that are not full (n_vehicle) */
    int n_event;
    const CzEvent *event;   /* (n_event), in time order */
    double setup_s, wall_s; /* for run_info only */
} CzRunSummary;

/* Track of a run in place of an elastic one; a rigid one stays rigid. */
typedef enum CzTrackUse {
    CZ_TRACK_USE_OWN,    /* the problem's */
    CZ_TRACK_USE_SEARCH, /* `receptance`; the problem's where it has no such fit */
    CZ_TRACK_USE_MODAL,  /* `modal` */
    CZ_TRACK_USE_FE      /* `fe` */
} CzTrackUse;

typedef struct CzSimulateOptions {
    double time_step; /* [s]; 0: that of the model */
    bool record;      /* keep channels at the output step */
    const char *isa;  /* "auto", or one of cz_isa_name: for tests and benchmarks */
    bool brief; /* for a search: end also when no device crushes any more and no later contact can
                   exceed 0.4 of the first closing speed; such a run ends with CZ_ENDED_SETTLED and
                   is not a production run */
    bool keep_pulses; /* keep the pulses of the vehicles, and results that are made of them, also
                         where nothing is recorded: some metrics need them */
    CzTrackUse track;
    CzIntegrator integrator; /* CZ_INTEGRATOR_ZHAI for production runs; the others support all
                                tracks but `fe` */
    double tolerance; /* of a reference: local error of a step, relative to 1 m/s or 1 rad/s in
                         velocities and to 10 mm or 10 mrad in displacements. With the default of
                         1e-6 the total is far below the error of the largest step (ours) */
} CzSimulateOptions;
CZ_API CzSimulateOptions cz_simulate_options_default(void);

/* One collision with everything recorded. Opaque, owns its memory. */
typedef struct CzRun CzRun;

/* Runs the model. A run that becomes non-finite, violates its energy balance or does not end is a
 * result, not an error: the function returns CZ_OK and the summary reports it. Statuses: CZ_OK,
 * CZ_STATUS_INPUT for a track that the integrator does not support, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_simulate(const CzModel *model, const CzSimulateOptions *options,
                                          CzRun **run, CzError *error);
CZ_API void cz_run_free(CzRun *run);
CZ_API const CzRunSummary *cz_run_summary(const CzRun *run);

/* A total of a run, such as an energy, for output: NaN when the run went beyond the model's
 * validity, because it includes the time after that. Other values of such a run are given and
 * marked. */
CZ_API double cz_run_total(const CzRunSummary *run, double total);

/* A full vehicle at rest on its springs, wheels and track, found by Newton's method (KINSOL) from
 * the laws alone; the model uses closed forms, which this tests. Displacements count from unloaded
 * springs and wheels that just touch. All NaN for rigid and fixed vehicles. */
typedef struct CzRest {
    double axle_load[4];            /* of each wheelset on the rails, rear to front [N] */
    double secondary_deflection[2]; /* rear and front [m] */
    double primary_deflection[4];   /* [m] */
    double rail_deflection[4];      /* downwards under each wheelset; 0 on a rigid track [m] */
    double indentation[4];          /* of wheel and rail [m] */
    double body_sag, body_pitch;    /* downwards [m]; nose-up [rad] */
    double residual;                /* largest force left unbalanced over the weight [-] */
} CzRest;

/* Fills the rest of every vehicle (n_vehicle). Statuses: CZ_OK, CZ_STATUS_RUN_FAILED when there is
 * no equilibrium, CZ_STATUS_NO_MEMORY. */
CZ_MUST_CHECK CZ_API CzStatus cz_rest_find(const CzModel *model, CzRest *rest, CzError *error);

/* Recorded channels (channels.def). Values of a channel at a place, one for each sample, in the
 * unit of the channel's entry; borrowed from the run. NULL when the run did not record it: there is
 * no such place, the vehicles do not have the quantity, or nothing was recorded. Samples are the
 * output step apart from t = 0 on; CZ_CHANNEL_TIME has their times. A missing value is NaN, such as
 * the overlap of anti-climbers that do not push. */
CZ_API int cz_run_n_sample(const CzRun *run);
CZ_API const double *cz_run_channel(const CzRun *run, CzChannel channel, int place);

/* The recorded channels one after the other, as the columns of channels.csv; the first is the time.
 */
CZ_API int cz_run_n_column(const CzRun *run);
CZ_API CzColumn cz_run_column(const CzRun *run, int column);

/* Name of the vehicle or the interface that a place belongs to, for cz_channel_name; empty for the
 * run as a whole. */
CZ_API const char *cz_run_place_name(const CzRunSummary *run, CzChannelAt at, int place);

/* Version of the SUNDIALS libraries in use, such as "6.4.1". Writes at most n bytes. */
CZ_API void cz_sundials_version(char *text, size_t n);

/* Instruction set of the kernel with "auto" on this machine. */
CZ_API const char *cz_isa_name(void);

CZ_END_DECLARATIONS
#endif
