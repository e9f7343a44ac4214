/* The sections of figures of the report. */
#include "report/charts.h"

#include <math.h>

/* A figure with its heading; the script adds the values at the cursor below it. */
static void write_titled(const CzPage *page, CzChart chart, int index, const char *title,
                         CzMarkup *markup) {
    cz_markup_open(markup, "figure");
    cz_markup_element(markup, "figcaption", title);
    cz_markup_line(markup);
    cz_chart_write(page, chart, index, markup);
    cz_markup_end(markup);
}

void cz_page_write_figure(CzPage *page, CzChart chart, int index) {
    char title[CZ_SENTENCE_ROOM];
    cz_chart_title(page, chart, index, sizeof title, title);
    write_titled(page, chart, index, title, &page->markup);
}

static void write_all(CzPage *page, CzChart chart) {
    for (int i = 0; i < cz_chart_count(page, chart); i++)
        cz_page_write_figure(page, chart, i);
}

static void open_figures(CzPage *page) {
    cz_markup_open_class(&page->markup, "div", "figures");
    cz_markup_line(&page->markup);
}

static void close_figures(CzPage *page) {
    cz_markup_end(&page->markup);
}

/* Distribution of energy in the other runs, such as that of the design before. */
static void write_other_shares(CzPage *page) {
    for (int i = 0; i < page->n_other; i++) {
        char title[CZ_SENTENCE_ROOM];
        CzPage beside = *page;
        beside.summary = cz_run_summary(page->other[i].run);
        snprintf(title, sizeof title, "The same, %s", page->other[i].label);
        write_titled(&beside, CZ_CHART_ENERGY_SHARES, 0, title, &page->markup);
    }
}

/* A section with all figures of some kinds. */
static void write_section(CzPage *page, const char *id, const char *heading, const char *remark,
                          int n, const CzChart *charts) {
    cz_page_open_section(&page->markup, id, heading);
    if (remark != NULL)
        cz_markup_element(&page->markup, "p", remark);
    open_figures(page);
    for (int i = 0; i < n; i++) {
        write_all(page, charts[i]);
        if (charts[i] == CZ_CHART_ENERGY_SHARES)
            write_other_shares(page);
    }
    close_figures(page);
    cz_markup_end(&page->markup);
}

static void write_motion(CzPage *page) {
    const int n = cz_chart_count(page, CZ_CHART_CAR_ACCELERATION);
    const int hardest = cz_chart_hardest_car(page->summary);
    cz_page_open_section(&page->markup, "motion", "Speed and acceleration");
    cz_markup_element(&page->markup, "p",
                      "Accelerations are those of the car bodies along the track, positive "
                      "forwards. Raw curves are the recorded samples; peaks between samples stand "
                      "in the tables only. The filter is the phaseless one of SAE J211, CFC 60.");
    open_figures(page);
    write_all(page, CZ_CHART_VELOCITY);
    write_all(page, CZ_CHART_ACCELERATION);
    if (n > 0)
        cz_page_write_figure(page, CZ_CHART_CAR_ACCELERATION, hardest);
    close_figures(page);
    if (n > 1) {
        cz_markup_open(&page->markup, "details");
        cz_markup_element(&page->markup, "summary", "Acceleration of each other car");
        open_figures(page);
        for (int i = 0; i < n; i++)
            if (i != hardest)
                cz_page_write_figure(page, CZ_CHART_CAR_ACCELERATION, i);
        close_figures(page);
        cz_markup_close(&page->markup);
    }
    cz_markup_end(&page->markup);
}

void cz_page_write_figures(CzPage *page) {
    static const CzChart loops[] = {CZ_CHART_FORCE_CLOSURE};
    static const CzChart energy[] = {CZ_CHART_ENERGY_SHARES, CZ_CHART_ENERGY, CZ_CHART_FORCE,
                                     CZ_CHART_BALANCE};
    static const CzChart vertical[] = {CZ_CHART_WHEEL_LIFT, CZ_CHART_OVERLAP, CZ_CHART_PITCH};
    if (page->n_sample < 2)
        return;
    write_section(
        page, "loops", "Force over closure",
        "Closure is the shortening between the two car bodies. The grey curve is what "
        "the input says when the interface is closed slowly: without rate, inertia and friction.",
        1, loops);
    write_section(page, "energy", "Energy", NULL, 4, energy);
    write_motion(page);
    if (cz_chart_count(page, CZ_CHART_PITCH) > 0)
        write_section(page, "vertical", "Wheels, anti-climbers, pitch", NULL, 3, vertical);
}
