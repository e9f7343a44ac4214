/* Curves that are drawn and were not recorded: made of what was. */
#include "report/page.h"

#include "base/error.h"
#include "report/units.h"
#include "simulate/filter.h"

#include <stdlib.h>

#define CFC 60.0
#define PPM 1e6

/* Adds a curve of zeros; NULL without memory. */
static double *add(CzPage *page, const char *stem, const char *name, const char *unit) {
    CzPageCurve *curve = &page->made[page->n_made];
    curve->value = calloc((size_t)page->n_sample, sizeof *curve->value);
    snprintf(curve->name, sizeof curve->name, "%s%s%s", stem, name, unit);
    page->n_made += curve->value != NULL;
    return curve->value;
}

static bool make_dissipated(CzPage *page) {
    double *sum = add(page, "E_interfaces", "", "_kJ");
    for (int i = 0; sum != NULL && i < page->summary->n_interface; i++) {
        const double *part = cz_page_channel(page, "E_%s_kJ", page->summary->interface[i].name);
        for (int k = 0; part != NULL && k < page->n_sample; k++)
            sum[k] += part[k];
    }
    return sum != NULL;
}

static bool make_imbalance(CzPage *page) {
    const double *off = cz_page_channel(page, "E_imbalance_kJ");
    const double initial = page->summary->energy.initial / CZ_KILO;
    if (off == NULL || !(initial > 0))
        return true;
    double *share = add(page, "imbalance", "", "_ppm");
    for (int i = 0; share != NULL && i < page->n_sample; i++)
        share[i] = PPM * off[i] / initial;
    return share != NULL;
}

static bool make_filtered(CzPage *page) {
    const double step = (page->time[1] - page->time[0]) / CZ_MILLI_PER_UNIT;
    bool fits = true;
    for (int i = 0; i < page->summary->n_vehicle && fits && cz_filter_fits(CFC, step); i++) {
        const char *car = page->summary->vehicle[i].name;
        const double *raw = cz_page_channel(page, "a_%s_g", car);
        if (raw == NULL)
            continue;
        double *smooth = add(page, "c_", car, "_g");
        fits = smooth != NULL && cz_filter_cfc(CFC, step, page->n_sample, raw, smooth) == CZ_OK;
    }
    return fits;
}

CzStatus cz_page_make_curves(CzPage *page, CzError *error) {
    if (page->n_sample < 2)
        return CZ_OK;
    page->made = calloc((size_t)page->summary->n_vehicle + 2, sizeof *page->made);
    const bool fits =
        page->made != NULL && make_dissipated(page) && make_imbalance(page) && make_filtered(page);
    return fits ? CZ_OK : cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
}

void cz_page_free_curves(CzPage *page) {
    for (int i = 0; i < page->n_made; i++)
        free(page->made[i].value);
    free(page->made);
    page->made = NULL;
    page->n_made = 0;
}
