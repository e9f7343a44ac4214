/* Sizes of names, in bytes.
 *
 * A name of a vehicle, a train or a scenario has at most CZ_MAX_NAME bytes, a label (of a check, a
 * variable, a match, a part) at most CZ_MAX_LABEL; readers refuse longer ones. Buffers for
 * combined names have room for the longest, so no name is cut.
 */
#ifndef CRUSHZONE_NAMES_H
#define CRUSHZONE_NAMES_H

enum {
    CZ_MAX_NAME = 48,
    CZ_MAX_LABEL = 96,
    CZ_MAX_TEXT = 1000, /* of a title, a source, a clause */

    CZ_NAME_SIZE = CZ_MAX_NAME + 1,
    CZ_LABEL_SIZE = CZ_MAX_LABEL + 1,
    CZ_INTERFACE_SIZE = 2 * CZ_MAX_NAME + 2,  /* "A4-B1" */
    CZ_CHANNEL_SIZE = CZ_INTERFACE_SIZE + 30, /* "Fz_anti-climber_A4-B1_kN" */
    CZ_WHERE_SIZE = CZ_CHANNEL_SIZE,          /* "A4 wheelset 2", "coupler A4", a channel */
    CZ_PATH_SIZE = 256,                       /* "trains.A.vehicles.A1.front.stages[0].force_kN" */
    CZ_PLACE_SIZE =
        CZ_WHERE_SIZE + 1 + CZ_NAME_SIZE /* a place and its scenario, a comma between them */
};

#endif
