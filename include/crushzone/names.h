/* Sizes of names, in bytes.
 *
 * A name of a vehicle, a train or a scenario has at most CZ_MOST_NAME bytes, a label (of a check, a
 * variable, a match, a part) at most CZ_MOST_LABEL; readers refuse longer ones. Buffers for
 * combined names have room for the longest, so no name is cut.
 */
#ifndef CRUSHZONE_NAMES_H
#define CRUSHZONE_NAMES_H

enum {
    CZ_MOST_NAME = 48,
    CZ_MOST_LABEL = 96,
    CZ_MOST_TEXT = 1000, /* of a title, a source, a clause */

    CZ_NAME_ROOM = CZ_MOST_NAME + 1,
    CZ_LABEL_ROOM = CZ_MOST_LABEL + 1,
    CZ_INTERFACE_ROOM = 2 * CZ_MOST_NAME + 2, /* "A4-B1" */
    CZ_CHANNEL_ROOM = CZ_INTERFACE_ROOM + 30, /* "Fz_anti-climber_A4-B1_kN" */
    CZ_WHERE_ROOM = CZ_CHANNEL_ROOM,          /* "A4 wheelset 2", "coupler A4", a channel */
    CZ_PATH_ROOM = 256,                       /* "trains.A.vehicles.A1.front.stages[0].force_kN" */
    CZ_PLACE_ROOM =
        CZ_WHERE_ROOM + 1 + CZ_NAME_ROOM /* a place and its scenario, a comma between them */
};

#endif
