/* The figures of the report, in the order in which engineers ask. */
#include "report/charts.h"

#include <math.h>

/* One figure with its heading; what is under the cursor stands below it. */
static CzStatus write_figure(CzPage *page, CzChart chart, int index, CzError *error) {
    char title[CZ_SENTENCE_ROOM];
    cz_chart_title(page, chart, index, sizeof title, title);
    cz_markup_open(&page->markup, "figure");
    cz_markup_element(&page->markup, "figcaption", title);
    cz_markup_line(&page->markup);
    const CzStatus status = cz_chart_write(page, chart, index, &page->markup, error);
    cz_markup_close(&page->markup);
    cz_markup_line(&page->markup);
    return status;
}

static CzStatus write_all(CzPage *page, CzChart chart, CzError *error) {
    CzStatus status = CZ_OK;
    for (int i = 0; i < cz_chart_count(page, chart) && status == CZ_OK; i++)
        status = write_figure(page, chart, i, error);
    return status;
}

static void open_figures(CzPage *page) {
    cz_markup_open(&page->markup, "div");
    cz_markup_attribute(&page->markup, "class", "figures");
    cz_markup_line(&page->markup);
}

static void close_figures(CzPage *page) {
    cz_markup_close(&page->markup);
    cz_markup_line(&page->markup);
}

/* Who absorbs what in the runs beside the page's own, such as the design before. */
static CzStatus write_other_shares(CzPage *page, CzError *error) {
    CzStatus status = CZ_OK;
    for (int i = 0; i < page->n_other && status == CZ_OK; i++) {
        char title[CZ_SENTENCE_ROOM];
        CzPage beside = *page;
        beside.summary = cz_run_summary(page->other[i].run);
        snprintf(title, sizeof title, "The same, %s", page->other[i].label);
        cz_markup_open(&page->markup, "figure");
        cz_markup_element(&page->markup, "figcaption", title);
        cz_markup_line(&page->markup);
        status = cz_chart_write(&beside, CZ_CHART_ENERGY_SHARES, 0, &page->markup, error);
        cz_markup_close(&page->markup);
        cz_markup_line(&page->markup);
    }
    return status;
}

/* A section of one figure of each kind. */
static CzStatus write_section(CzPage *page, const char *id, const char *heading, const char *remark,
                              int n, const CzChart *charts, CzError *error) {
    CzStatus status = CZ_OK;
    cz_page_open_section(&page->markup, id, heading);
    if (remark != NULL)
        cz_markup_element(&page->markup, "p", remark);
    open_figures(page);
    for (int i = 0; i < n && status == CZ_OK; i++) {
        status = write_all(page, charts[i], error);
        if (status == CZ_OK && charts[i] == CZ_CHART_ENERGY_SHARES)
            status = write_other_shares(page, error);
    }
    close_figures(page);
    cz_page_close_section(&page->markup);
    return status;
}

static CzStatus write_motion(CzPage *page, CzError *error) {
    static const CzChart charts[] = {CZ_CHART_VELOCITY, CZ_CHART_ACCELERATION};
    const int n = cz_chart_count(page, CZ_CHART_CAR_ACCELERATION);
    CzStatus status = CZ_OK;
    cz_page_open_section(&page->markup, "motion", "Speed and acceleration");
    cz_markup_element(&page->markup, "p",
                      "Accelerations are those of the car bodies along the track, positive "
                      "forwards. Raw curves are the recorded samples; peaks between samples stand "
                      "in the tables only. The filter is the phaseless one of SAE J211, CFC 60.");
    open_figures(page);
    for (int i = 0; i < 2 && status == CZ_OK; i++)
        status = write_all(page, charts[i], error);
    if (status == CZ_OK && n > 0)
        status = write_figure(page, CZ_CHART_CAR_ACCELERATION, cz_chart_hardest_car(page->summary),
                              error);
    close_figures(page);
    if (n > 1) {
        cz_markup_open(&page->markup, "details");
        cz_markup_element(&page->markup, "summary", "Acceleration of each other car");
        open_figures(page);
        for (int i = 0; i < n && status == CZ_OK; i++)
            if (i != cz_chart_hardest_car(page->summary))
                status = write_figure(page, CZ_CHART_CAR_ACCELERATION, i, error);
        close_figures(page);
        cz_markup_close(&page->markup);
    }
    cz_page_close_section(&page->markup);
    return status;
}

CzStatus cz_page_write_figures(CzPage *page, CzError *error) {
    static const CzChart loops[] = {CZ_CHART_FORCE_CLOSURE};
    static const CzChart energy[] = {CZ_CHART_ENERGY_SHARES, CZ_CHART_ENERGY, CZ_CHART_FORCE,
                                     CZ_CHART_BALANCE};
    static const CzChart vertical[] = {CZ_CHART_WHEEL_LIFT, CZ_CHART_OVERLAP, CZ_CHART_PITCH};
    if (page->n_sample < 2)
        return CZ_OK;
    CzStatus status = write_section(
        page, "loops", "Force over closure",
        "Closure is how much nearer the two car bodies are than at rest. The curve behind is what "
        "the input says when the interface is closed slowly: without rate, inertia and friction.",
        1, loops, error);
    if (status == CZ_OK)
        status = write_section(page, "energy", "Energy", NULL, 4, energy, error);
    if (status == CZ_OK)
        status = write_motion(page, error);
    if (status == CZ_OK && cz_chart_count(page, CZ_CHART_PITCH) > 0)
        status = write_section(page, "vertical", "Wheels, anti-climbers, pitch", NULL, 3, vertical,
                               error);
    return status;
}
