/* Equipment of interfaces and cars, read from the parameters of their laws, for folders that may
 * not read these parameters. */
#ifndef CZ_DYNAMICS_EQUIPMENT_H
#define CZ_DYNAMICS_EQUIPMENT_H

#include "dynamics/dynamics.h"

/* Equipment of the interface whose rear car is in a lane; side 0 is its front end, 1 the rear end
 * of the car ahead. */
typedef struct CzInterfaceEquipment {
    bool has_couplers;     /* two that meet, or one that strikes a bare end */
    bool is_coupled;       /* they carry tension, or draw gears do */
    bool couplers_on_ends; /* one of them at least is fixed to an end mass */
    bool has_side_buffers; /* likewise */
    bool has_superstructures, has_draw_gears;
    bool tilts;      /* one of the cars can rise and pitch, and the other one is not a wall */
    bool can_climb;  /* the overlap of its faces is limited */
    bool has_ribs;   /* two anti-climbers meet */
    double friction; /* of the faces [-] */
    struct {
        bool has_coupler, has_anti_climber, has_side_buffers; /* on this side */
        bool presses_plates; /* its anti-climber, on the side buffers of the other side */
        bool shears_off;
        bool has_massless_end;
        double retraction_space; /* includes the softening length of the shear-off; CZ_NEVER if none
                                    [m] */
        double swing_stop;       /* infinite if none [rad] */
        double strut_length; /* by which the coupler cannot shorten; CZ_NEVER where it always acts
                                along the track [m] */
    } side[2];
} CzInterfaceEquipment;

CzInterfaceEquipment cz_interface_equipment(const CzLanes *lanes, size_t lane);

/* Equipment of the car in a lane. */
typedef struct CzCarEquipment {
    bool has_slaved_end[2];      /* rear and front: it moves with the body */
    bool is_held;                /* by brakes or friction jaws */
    double slowing;              /* largest deceleration by brakes and rolling resistance; infinite
                                    with friction jaws [m/s2] */
    double lift_stop, bump_stop; /* extension and compression of the secondary suspension [m] */
    double slide_length;         /* CZ_NEVER if none [m] */
    double inverse_mass;         /* of the body; 0 where it cannot move [1/kg] */
} CzCarEquipment;

CzCarEquipment cz_car_equipment(const CzLanes *lanes, size_t lane);

/* Whether the coupler of a side has sheared off. */
bool cz_coupler_is_sheared(const CzDynamics *dynamics, size_t lane, int side);

#endif
