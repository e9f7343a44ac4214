/* Curves that figures draw and that are computed from recorded channels. */
#include "report/drawn.h"

#include "base/error.h"
#include "report/units.h"
#include "simulate/filter.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CFC 60.0
#define PPM 1e6

const CzChannelInfo *cz_drawn_info(CzDrawn drawn) {
    static const CzChannelInfo made[CZ_N_DRAWN - CZ_N_CHANNEL] = {
#define ANY false
#define TOTAL true
#define CZ_CHANNEL(constant, at, dimension, validity, pattern, unit, title, doc)                   \
    {CZ_AT_##at, validity, pattern, unit, title, doc},
#include "report/drawn.def"
#undef CZ_CHANNEL
#undef TOTAL
#undef ANY
    };
    const int beyond = (int)drawn - (int)CZ_N_CHANNEL;
    return beyond < 0 ? cz_channel_info((CzChannel)drawn) : &made[beyond];
}

const double *cz_drawn_values(const CzRun *run, const CzMadeCurves *made, CzDrawn drawn,
                              int place) {
    if ((int)drawn < (int)CZ_N_CHANNEL)
        return cz_run_channel(run, (CzChannel)drawn, place);
    for (int i = 0; i < made->n; i++)
        if (made->curve[i].drawn == drawn && made->curve[i].place == place)
            return made->curve[i].value;
    return NULL;
}

const double *cz_drawn_beside(const CzRunSummary *run, CzChannel channel, int place,
                              const CzRun *other) {
    const CzRunSummary *there = cz_run_summary(other);
    const CzChannelAt at = cz_channel_info(channel)->at;
    const bool of_interface = at == CZ_AT_INTERFACE;
    const int n = of_interface ? there->n_interface : there->n_vehicle;
    const char *name = cz_run_place_name(run, at, place);
    const int index = cz_place_index(at, place), first = cz_first_place(at, index);
    for (int i = 0; i < n; i++)
        if (strcmp(cz_run_place_name(there, at, cz_first_place(at, i)), name) == 0)
            return cz_run_channel(other, channel, cz_first_place(at, i) + place - first);
    return NULL;
}

const char *cz_drawn_name(const CzRunSummary *run, CzDrawn drawn, int place,
                          char name[CZ_CHANNEL_SIZE]) {
    const CzChannelInfo *info = cz_drawn_info(drawn);
    return cz_channel_name(info, place, cz_run_place_name(run, info->at, place), name);
}

const char *cz_drawn_label(CzDrawn drawn, char label[CZ_DRAWN_LABEL]) {
    const CzChannelInfo *info = cz_drawn_info(drawn);
    snprintf(label, CZ_DRAWN_LABEL, "%s [%s]", info->title, info->unit);
    char *mark = strchr(label, '_');
    if (mark != NULL) /* m_s is m/s */
        *mark = '/';
    return label;
}

/* Adds a curve of zeros; NULL without memory. */
static double *add(CzMadeCurves *made, int n_sample, CzDrawn drawn, int place) {
    double *value = calloc((size_t)n_sample, sizeof *value);
    if (value != NULL)
        made->curve[made->n++] = (CzMadeCurve){drawn, place, value};
    return value;
}

static bool make_dissipated(const CzRun *run, CzMadeCurves *made) {
    const int n = cz_run_n_sample(run);
    double *sum = add(made, n, CZ_DRAWN_INTERFACES_ENERGY, 0);
    for (int i = 0; sum != NULL && i < cz_run_summary(run)->n_interface; i++) {
        const double *part = cz_run_channel(run, CZ_CHANNEL_INTERFACE_ENERGY, i);
        for (int k = 0; part != NULL && k < n; k++)
            sum[k] += part[k];
    }
    return sum != NULL;
}

static bool make_balance(const CzRun *run, CzMadeCurves *made) {
    const double *off = cz_run_channel(run, CZ_CHANNEL_ENERGY_IMBALANCE, 0);
    const double initial = cz_run_summary(run)->energy.initial / CZ_KILO;
    if (off == NULL || !(initial > 0))
        return true;
    const int n = cz_run_n_sample(run);
    double *share = add(made, n, CZ_DRAWN_BALANCE_ERROR, 0);
    for (int i = 0; share != NULL && i < n; i++)
        share[i] = PPM * off[i] / initial;
    return share != NULL;
}

static bool make_filtered(const CzRun *run, CzMadeCurves *made) {
    const double *time = cz_run_channel(run, CZ_CHANNEL_TIME, 0);
    const double step = (time[1] - time[0]) / CZ_MILLI_PER_UNIT;
    const int n = cz_run_n_sample(run);
    bool fits = true;
    for (int i = 0; i < cz_run_summary(run)->n_vehicle && fits && cz_filter_fits(CFC, step); i++) {
        const double *raw = cz_run_channel(run, CZ_CHANNEL_BODY_ACCELERATION, i);
        if (raw == NULL)
            continue;
        double *smooth = add(made, n, CZ_DRAWN_FILTERED_ACCELERATION, i);
        fits = smooth != NULL && cz_filter_cfc(CFC, step, n, raw, smooth) == CZ_OK;
    }
    return fits;
}

/* A free occupant's displacement and velocity in a vehicle, up to a displacement of 1 m. */
static bool fly_freely(const double *speed, const double *time, int n, double *travel,
                       double *velocity) {
    const double farthest = 1; /* [m] */
    if (travel == NULL || velocity == NULL)
        return false;
    for (int i = 1; i < n; i++) {
        const double step = (time[i] - time[i - 1]) / CZ_MILLI_PER_UNIT;
        velocity[i] = speed[0] - speed[i];
        travel[i] = travel[i - 1] + 0.5 * step * (velocity[i - 1] + velocity[i]);
        if (!(fabs(travel[i]) <= farthest)) /* also behind one that was */
            travel[i] = velocity[i] = NAN;
    }
    for (int i = 0; i < n; i++) {
        travel[i] = fabs(travel[i]);
        velocity[i] = fabs(velocity[i]);
    }
    return true;
}

static bool make_free_flights(const CzRun *run, CzMadeCurves *made) {
    const double *time = cz_run_channel(run, CZ_CHANNEL_TIME, 0);
    const int n = cz_run_n_sample(run);
    bool fits = true;
    for (int i = 0; i < cz_run_summary(run)->n_vehicle && fits; i++) {
        const double *speed = cz_run_channel(run, CZ_CHANNEL_BODY_SPEED, i);
        if (speed == NULL)
            continue;
        double *travel = add(made, n, CZ_DRAWN_FREE_FLIGHT, i);
        fits = fly_freely(speed, time, n, travel, add(made, n, CZ_DRAWN_OCCUPANT_SPEED, i));
    }
    return fits;
}

CzStatus cz_drawn_make(const CzRun *run, CzMadeCurves *made, CzError *error) {
    *made = (CzMadeCurves){0};
    if (cz_run_n_sample(run) < 2 || cz_run_channel(run, CZ_CHANNEL_TIME, 0) == NULL)
        return CZ_OK;
    made->curve = calloc(3 * (size_t)cz_run_summary(run)->n_vehicle + 2, sizeof *made->curve);
    const bool fits = made->curve != NULL && make_dissipated(run, made) &&
                      make_balance(run, made) && make_filtered(run, made) &&
                      make_free_flights(run, made);
    return fits ? CZ_OK : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
}

void cz_drawn_free(CzMadeCurves *made) {
    for (int i = 0; i < made->n; i++)
        free(made->curve[i].value);
    free(made->curve);
    *made = (CzMadeCurves){0};
}
