/* Curves over time in figures: recorded channels, and curves computed from them (drawn.def). */
#ifndef CZ_REPORT_DRAWN_H
#define CZ_REPORT_DRAWN_H

#include "crushzone/simulate.h"

/* Recorded channels first, with the values of CzChannel. */
typedef enum CzDrawn {
#define CZ_CHANNEL(constant, at, dimension, validity, pattern, unit, title, doc)                   \
    CZ_DRAWN_##constant,
#include "crushzone/channels.def"
#include "report/drawn.def"
#undef CZ_CHANNEL
    CZ_N_DRAWN
} CzDrawn;

/* As cz_channel_info. */
const CzChannelInfo *cz_drawn_info(CzDrawn drawn);

/* A computed curve. */
typedef struct CzMadeCurve {
    CzDrawn drawn;
    int place;
    double *value; /* (n_sample) */
} CzMadeCurve;

typedef struct CzMadeCurves {
    int n;
    CzMadeCurve *curve; /* (n) */
} CzMadeCurves;

/* Computes the curves of a run: energy dissipated at all interfaces; error of the energy balance,
 * unless the initial energy is zero; accelerations through a filter CFC 60, where samples are close
 * enough; displacement and velocity of a free occupant. None for a run that was not recorded.
 * Status: CZ_STATUS_NO_MEMORY; free the curves in any case. */
CZ_MUST_CHECK CzStatus cz_drawn_make(const CzRun *run, CzMadeCurves *made, CzError *error);
void cz_drawn_free(CzMadeCurves *made);

/* Values of a curve at a place (n_sample); NULL where there are none. */
const double *cz_drawn_values(const CzRun *run, const CzMadeCurves *made, CzDrawn drawn, int place);

/* Values of a channel in another run, at the vehicle or interface of the same name, because the
 * trains may differ; NULL when there are none. */
const double *cz_drawn_beside(const CzRunSummary *run, CzChannel channel, int place,
                              const CzRun *other);

/* Label of an axis, such as "force [kN]"; returns it. */
enum { CZ_DRAWN_LABEL = 48 };
const char *cz_drawn_label(CzDrawn drawn, char label[CZ_DRAWN_LABEL]);

/* Name of a curve, as of a column of channels.csv; returns it. */
const char *cz_drawn_name(const CzRunSummary *run, CzDrawn drawn, int place,
                          char name[CZ_CHANNEL_SIZE]);

#endif
