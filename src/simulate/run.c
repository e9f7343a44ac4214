/* Access to a run, and the texts of its closed sets. */
#include "simulate/run.h"

#include "integrate/integrator.h"

static const struct {
    const char *key, *text;
} ends[] = {
#define CZ_ENDED(constant, key, text) [constant] = {key, text},
#include "crushzone/ended.def"
#undef CZ_ENDED
};

const char *cz_ended_key(CzEnded ended) {
    return ends[ended].key;
}

const char *cz_ended_text(CzEnded ended) {
    return ends[ended].text;
}

const char *cz_integrator_text(CzIntegrator integrator) {
    static const char *const text[] = {
#define CZ_INTEGRATOR(constant, text, doc) text,
#include "crushzone/integrators.def"
#undef CZ_INTEGRATOR
    };
    return text[integrator];
}

void cz_sundials_version(char *text, size_t n) {
    cz_solver_version(text, n);
}

const char *cz_event_text(CzEventKind kind) {
    static const char *const text[] = {
#define CZ_EVENT(constant, text, doc) text,
#include "crushzone/events.def"
#undef CZ_EVENT
    };
    return text[kind];
}

const char *cz_element_text(CzElementKind kind) {
    static const char *const text[] = {
#define CZ_ELEMENT(constant, text) text,
#include "crushzone/elements.def"
#undef CZ_ELEMENT
    };
    return text[kind];
}

const CzRunSummary *cz_run_summary(const CzRun *run) {
    return &run->summary;
}

int cz_run_n_sample(const CzRun *run) {
    return run->channels.n_sample;
}

int cz_run_n_column(const CzRun *run) {
    return run->channels.n_column;
}

CzColumn cz_run_column(const CzRun *run, int column) {
    return run->channels.column[column];
}

const double *cz_run_channel(const CzRun *run, CzChannel channel, int place) {
    const CzChannels *channels = &run->channels;
    for (int i = 0; i < channels->n_column; ++i)
        if (channels->column[i].channel == channel && channels->column[i].place == place)
            return channels->value[i];
    return NULL;
}

const char *cz_run_place_name(const CzRunSummary *run, CzChannelAt at, int place) {
    const int index = cz_place_index(at, place);
    if (at == CZ_AT_RUN)
        return "";
    return at == CZ_AT_INTERFACE ? run->interface[index].name : run->vehicle[index].name;
}
