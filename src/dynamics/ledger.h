/* Rows that are summed or maximised over the steps of a run: work by kind of element, and largest
 * values.
 */
#ifndef CZ_DYNAMICS_LEDGER_H
#define CZ_DYNAMICS_LEDGER_H

#include "model/state.h"

/* Power of an evaluation [W], or work of a run [J], that the mechanical system gives to each kind
 * of element; ledger.def says what each row is. Pairs are ends, rear first, or sides A and B. */
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

/* A row of it by its name, such as CZ_LEDGER(end_damping[1]). */
#define CZ_LEDGER(member) CZ_ROW_OF(CzPower, member)
enum { CZ_N_LEDGER = CZ_ROWS_IN(CzPower) };

#define CZ_NOT_YET                                                                                 \
    -1e300 /* start of an extreme that may stay below 0: below all that a run reaches */

/* Largest values over all steps; extremes.def says what each row is. */
typedef struct CzExtremes {
    CzRow interface_force, interface_time, interface_shortening;
    CzRow coupler_force, face_force, superstructure_force, draw_gear_force;
    CzRow buffer[2], side_buffer[2], side_force;
    CzRow face_demand_vertical, face_lost_margin, face_lost_overlap;
    CzRow face_overlap_time, face_margin_time, face_ramp;
    CzRow underframe_rise, swing_vertical[2], face_climbed;
    CzRow end_force[2], section[2];
    CzRow link_force, link_travel;
    CzRow body_acceleration, body_pitch;
    CzRow lift[4], lift_time[4], bogie_lift[2], bogie_lift_time[2];
    CzRow climb_time;
    CzRow slide_travel, slide_force;
    CzRow chain_residual, chain_distance;
    CzRow coupler_closure, face_closure, side_closure;
    CzRow searched;
} CzExtremes;

/* A row of it by its name, such as CZ_EXTREME(lift[0]). */
#define CZ_EXTREME(member) CZ_ROW_OF(CzExtremes, member)
enum { CZ_N_EXTREME = CZ_ROWS_IN(CzExtremes) };

#endif
