/* Names of channels: made of the patterns of channels.def, and read from a text. */
#include "crushzone/channel.h"

#include "base/suggest.h"

#include <stdio.h>
#include <string.h>

static const CzChannelInfo channels[CZ_N_CHANNEL] = {
#define ANY false
#define TOTAL true
#define CZ_CHANNEL(constant, at, dimension, validity, pattern, unit, title, doc)                   \
    {CZ_AT_##at, validity, pattern, unit, title, doc},
#include "crushzone/channels.def"
#undef CZ_CHANNEL
#undef TOTAL
#undef ANY
};

/* Places of one vehicle, or one interface. */
static const int n_place[] = {[CZ_AT_RUN] = 1,
                              [CZ_AT_VEHICLE] = 1,
                              [CZ_AT_WHEELSET] = 4,
                              [CZ_AT_END] = 2,
                              [CZ_AT_INTERFACE] = 1};

const CzChannelInfo *cz_channel_info(CzChannel channel) {
    return &channels[channel];
}

int cz_place_index(CzChannelAt at, int place) {
    return place / n_place[at];
}

int cz_first_place(CzChannelAt at, int index) {
    return index * n_place[at];
}

/* Text for a placeholder of a pattern, given by its first letter in the braces. */
static const char *word_for(char part, const CzChannelInfo *info, int place, const char *name) {
    static const char *const wheelsets[] = {"1", "2", "3", "4"};
    static const char *const ends[] = {"rear", "front"};
    const int which = place % n_place[info->at];
    return part == 'w' ? wheelsets[which] : part == 'e' ? ends[which] : name;
}

const char *cz_channel_name(const CzChannelInfo *info, int place, const char *name,
                            char text[CZ_CHANNEL_SIZE]) {
    int n = 0;
    for (const char *at = info->pattern; *at != '\0';) {
        const size_t n_plain = strcspn(at, "{");
        n += snprintf(text + n, (size_t)(CZ_CHANNEL_SIZE - n), "%.*s", (int)n_plain, at);
        at += n_plain;
        if (*at == '\0')
            break;
        n += snprintf(text + n, (size_t)(CZ_CHANNEL_SIZE - n), "%s",
                      word_for(at[1], info, place, name));
        at = strchr(at, '}') + 1;
    }
    return text;
}

/* A text to search for, and the result. */
typedef struct Search {
    const char *text;
    CzColumn *column;
    bool suggests; /* search the nearest name */
    CzSuggestion suggestion;
} Search;

/* Whether a channel at one of the places has that name. */
static bool try_places(Search *search, CzChannel channel, int index, const char *name) {
    const CzChannelInfo *info = &channels[channel];
    for (int k = 0; k < n_place[info->at]; k++) {
        const int place = cz_first_place(info->at, index) + k;
        char text[CZ_CHANNEL_SIZE];
        if (strcmp(cz_channel_name(info, place, name, text), search->text) == 0) {
            *search->column = (CzColumn){channel, place};
            return true;
        }
        if (search->suggests)
            cz_suggest(&search->suggestion, search->text, text);
    }
    return false;
}

bool cz_column_find(const char *text, int n_vehicle, const char *const *vehicle, CzColumn *column,
                    char nearest[CZ_CHANNEL_SIZE]) {
    Search search = {.text = text, .column = column, .suggests = nearest != NULL};
    for (CzChannel channel = 0; channel < CZ_N_CHANNEL; channel++) {
        const CzChannelAt at = channels[channel].at;
        const int n = at == CZ_AT_RUN ? 1 : at == CZ_AT_INTERFACE ? n_vehicle - 1 : n_vehicle;
        for (int i = 0; i < n; i++) {
            char interface[CZ_INTERFACE_SIZE];
            const char *name = at == CZ_AT_RUN ? "" : vehicle[i];
            if (at == CZ_AT_INTERFACE) {
                snprintf(interface, sizeof interface, "%s-%s", vehicle[i], vehicle[i + 1]);
                name = interface;
            }
            if (try_places(&search, channel, i, name))
                return true;
        }
    }
    if (nearest != NULL)
        snprintf(nearest, CZ_CHANNEL_SIZE, "%s", search.suggestion.best);
    return false;
}
