/* Rows that are summed or maximised over the steps of a run: work by kind of element, and largest
 * values.
 */
#ifndef CZ_DYNAMICS_LEDGER_H
#define CZ_DYNAMICS_LEDGER_H

#include "model/state.h"

/* Power of an evaluation [W], or work of a run [J], that the mechanical system transfers to each
 * kind of element; ledger.def describes each row. Pairs are ends, rear first, or sides A and B. */
typedef struct CzPower {
    CzRow coupler, hinge[2];
    CzRow face, face_damping, face_sliding;
    CzRow side_buffers, side_sliding;
    CzRow superstructure, draw_gear;
    CzRow end[2], end_damping[2], guide[2], guide_damping[2], fold[2], fold_damping[2];
    CzRow secondary, secondary_damping, primary, primary_damping;
    CzRow link, link_damping, axle_guidance, axle_guidance_damping;
    CzRow wheel_normal, track, moving_load, wheel_creep;
    CzRow brake, rolling, slide;
} CzPower;

/* A row by its name, such as CZ_LEDGER(end_damping[1]). */
#define CZ_LEDGER(member) CZ_ROW_OF(CzPower, member)
enum { CZ_N_LEDGER = CZ_ROWS_IN(CzPower) };

/* Initial value of an extreme that may stay below 0: lower than any value of a run. */
#define CZ_NOT_YET -1e300

/* Largest values over all steps; of smallest values the negative is kept. Those of an interface are
 * in the lane of the rear car. All start at 0 but for those marked CZ_NOT_YET. */
typedef struct CzExtremes {
    CzRow interface_force, interface_time; /* total longitudinal force [N], and when [s] */
    CzRow interface_shortening;            /* closure between the bodies [m] */
    CzRow draw_gear_force;                 /* tension [N] */
    CzRow coupler_force, face_force, superstructure_force, side_force; /* [N] */
    CzRow buffer[2], side_buffer[2];                                   /* strokes [m] */
    CzRow face_demand_vertical; /* vertical force between the anti-climbers [N] */
    CzRow face_lost_margin;  /* CZ_NOT_YET; vertical demand less capacity in full engagement while
                                the faces push, and once they slip the force that would have held
                                the slip [N] */
    CzRow face_lost_overlap; /* CZ_NOT_YET; minus the remaining overlap while the faces push [m] */
    CzRow face_overlap_time, face_margin_time; /* when overlap and margin were smallest [s] */
    CzRow face_ramp;                           /* slope of the faces while they push [-] */
    CzRow underframe_rise;         /* change of the height of one underframe over the other [m] */
    CzRow swing_vertical[2];       /* angle of the engaged coupler against its car [rad] */
    CzRow face_climbed;            /* 1 once the faces had no overlap left under load */
    CzRow end_force[2];            /* of the rear and the front crush zone [N] */
    CzRow section[2];              /* force through the section behind an end, all load paths [N] */
    CzRow link_force, link_travel; /* of a traction link [N], of a bogie there [m] */
    CzRow body_acceleration, bogie_acceleration; /* longitudinal, of either bogie frame [m/s2] */
    CzRow body_pitch;                            /* [rad] */
    CzRow lift[4], lift_time[4];                 /* of a wheelset over the rail [m], and when [s] */
    CzRow bogie_lift[2], bogie_lift_time[2];     /* of the lower wheelset of a bogie */
    CzRow climb_time;                /* CZ_NOT_YET; minus the time of the first override [s] */
    CzRow slide_travel, slide_force; /* of a buffer stop: travel [m]; jaws and end stop [N] */
    CzRow chain_residual;            /* closure that the series chains left unbalanced [m] */
    CzRow chain_distance; /* largest deviation of a member of a series chain from its law [N] */
    CzRow coupler_closure, face_closure, side_closure; /* [m] */
    CzRow searched; /* solutions of series chains that needed a search, sum over the steps */
} CzExtremes;

/* A row by its name, such as CZ_EXTREME(lift[0]). */
#define CZ_EXTREME(member) CZ_ROW_OF(CzExtremes, member)

#endif
