/* The sections of figures of the report. */
#include "report/charts.h"

#include <math.h>

/* A figure with its heading; the script adds the values at the cursor below it. */
static void write_titled(const CzPage *page, CzChart chart, int index, const char *title,
                         CzMarkup *markup) {
    cz_markup_write(markup, "<figure><figcaption>%s</figcaption>\n", title);
    cz_chart_write(page, chart, index, markup);
    cz_markup_write(markup, "</figure>\n");
}

void cz_page_write_figure(CzPage *page, CzChart chart, int index) {
    char title[CZ_SENTENCE_SIZE];
    cz_chart_title(page, chart, index, sizeof title, title);
    write_titled(page, chart, index, title, &page->markup);
}

static void write_all(CzPage *page, CzChart chart) {
    for (int i = 0; i < cz_chart_count(page, chart); i++)
        cz_page_write_figure(page, chart, i);
}

/* Distribution of energy in the other runs, such as that of the design before. */
static void write_other_shares(CzPage *page) {
    for (int i = 0; i < page->n_other; i++) {
        char title[CZ_SENTENCE_SIZE];
        CzPage beside = *page;
        beside.summary = cz_run_summary(page->other[i].run);
        snprintf(title, sizeof title, "The same, %s", page->other[i].label);
        write_titled(&beside, CZ_CHART_ENERGY_SHARES, 0, title, &page->markup);
    }
}

/* A section with all figures of some kinds, up to CZ_N_CHART. */
static void write_section(CzPage *page, const char *id, const char *heading, const char *remark,
                          const CzChart *chart) {
    cz_markup_write(&page->markup, "<section id='%s'>\n<h2>%s</h2>\n", id, heading);
    if (remark != NULL)
        cz_markup_write(&page->markup, "<p>%s</p>", remark);
    cz_markup_write(&page->markup, "<div class='figures'>\n");
    for (; *chart != CZ_N_CHART; chart++) {
        write_all(page, *chart);
        if (*chart == CZ_CHART_ENERGY_SHARES)
            write_other_shares(page);
    }
    cz_markup_write(&page->markup, "</div>\n</section>\n");
}

static void write_motion(CzPage *page) {
    CzMarkup *markup = &page->markup;
    const int n = cz_chart_count(page, CZ_CHART_CAR_ACCELERATION);
    const int hardest = cz_chart_hardest_car(page->summary);
    cz_markup_write(markup,
                    "<section id='motion'>\n<h2>Speed and acceleration</h2>\n"
                    "<p>Accelerations are those of the car bodies along the track, positive "
                    "forwards. Raw curves are the recorded samples; peaks between samples are only "
                    "in the tables. The filter is the phaseless one of SAE J211, CFC 60.</p>"
                    "<div class='figures'>\n");
    write_all(page, CZ_CHART_VELOCITY);
    write_all(page, CZ_CHART_ACCELERATION);
    write_all(page, CZ_CHART_SECONDARY_IMPACT);
    if (n > 0)
        cz_page_write_figure(page, CZ_CHART_CAR_ACCELERATION, hardest);
    cz_markup_write(markup, "</div>\n");
    if (n > 1) {
        cz_markup_write(markup, "<details><summary>Acceleration of each other car</summary>"
                                "<div class='figures'>\n");
        for (int i = 0; i < n; i++)
            if (i != hardest)
                cz_page_write_figure(page, CZ_CHART_CAR_ACCELERATION, i);
        cz_markup_write(markup, "</div>\n</details>");
    }
    cz_markup_write(markup, "</section>\n");
}

void cz_page_write_figures(CzPage *page) {
    static const CzChart loops[] = {CZ_CHART_FORCE_CLOSURE, CZ_N_CHART};
    static const CzChart energy[] = {CZ_CHART_ENERGY_SHARES, CZ_CHART_ENERGY, CZ_CHART_FORCE,
                                     CZ_CHART_BALANCE, CZ_N_CHART};
    static const CzChart vertical[] = {CZ_CHART_WHEEL_LIFT, CZ_CHART_OVERLAP, CZ_CHART_PITCH,
                                       CZ_N_CHART};
    if (page->n_sample < 2)
        return;
    write_section(
        page, "loops", "Force over closure",
        "Closure is the shortening between the two car bodies. The grey curve is the input for "
        "slow closing of the interface: without rate effects, inertia and friction.",
        loops);
    write_section(page, "energy", "Energy", NULL, energy);
    write_motion(page);
    if (cz_chart_count(page, CZ_CHART_PITCH) > 0)
        write_section(page, "vertical", "Wheels, anti-climbers, pitch", NULL, vertical);
}
