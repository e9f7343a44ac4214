/* Channels: the time histories that a run records, each a quantity at a place. */
#ifndef CRUSHZONE_CHANNEL_H
#define CRUSHZONE_CHANNEL_H

#include <stdbool.h>

#include "crushzone/names.h"
#include "crushzone/status.h"

CZ_BEGIN_DECLARATIONS

/* What is recorded. */
typedef enum CzChannel {
#define CZ_CHANNEL(constant, at, dimension, validity, pattern, unit, title, doc)                   \
    CZ_CHANNEL_##constant,
#include "crushzone/channels.def"
#undef CZ_CHANNEL
    CZ_N_CHANNEL
} CzChannel;

/* Where a channel is recorded, which determines its place. Vehicles are counted from 0 along +x,
 * interface i lies between the vehicles i and i + 1. */
typedef enum CzChannelAt {
    CZ_AT_RUN,      /* 0 */
    CZ_AT_VEHICLE,  /* the vehicle */
    CZ_AT_WHEELSET, /* cz_wheelset_place */
    CZ_AT_END,      /* cz_end_place */
    CZ_AT_INTERFACE /* the interface */
} CzChannelAt;

/* Place of a wheelset of a vehicle (0 to 3, from the rear), and of its end (0 rear, 1 front). */
static inline int cz_wheelset_place(int vehicle, int wheelset) {
    return 4 * vehicle + wheelset;
}
static inline int cz_end_place(int vehicle, int end) {
    return 2 * vehicle + end;
}

/* An entry of channels.def. */
typedef struct CzChannelInfo {
    CzChannelAt at;
    bool is_total;       /* an energy that is left out beyond the model's validity */
    const char *pattern; /* of the column's name, such as "F_{interface}_kN" */
    const char *unit;    /* of the values, as in the name: "kN", "m_s" */
    const char *title;   /* of an axis, such as "force" */
    const char *doc;     /* one sentence */
} CzChannelInfo;
CZ_API const CzChannelInfo *cz_channel_info(CzChannel channel);

/* A column of channels.csv. */
typedef struct CzColumn {
    CzChannel channel;
    int place;
} CzColumn;

/* The vehicle or the interface that a place belongs to, and its first place. */
CZ_API int cz_place_index(CzChannelAt at, int place);
CZ_API int cz_first_place(CzChannelAt at, int index);

/* Writes the name of a column, such as "F_A4-B1_kN", and returns it. `name` is that of the vehicle
 * or the interface (cz_place_index); for a channel of the run it is not used. */
CZ_API const char *cz_channel_name(const CzChannelInfo *info, int place, const char *name,
                                   char text[CZ_CHANNEL_SIZE]);

/* Finds the column that a text names in a run of n vehicles with these names, along +x. Whether the
 * run records it depends on the vehicles (cz_run_channel). When there is none, the column is not
 * changed, and `nearest`, unless NULL, becomes the nearest name, or empty. */
CZ_API bool cz_column_find(const char *text, int n_vehicle, const char *const *vehicle,
                           CzColumn *column, char nearest[CZ_CHANNEL_SIZE]);

CZ_END_DECLARATIONS
#endif
