/* Comparison of runs as a page: checks, numbers, and curves over each other. */
#include "crushzone/report.h"

#include "base/error.h"
#include "report/charts.h"
#include "report/compare.h"
#include "report/compared_names.h"
#include "report/options.h"
#include "report/verdict_words.h"

#include <limits.h>

static void write_checks(CzMarkup *markup, const CzReport *report) {
    CzReportTable table;
    int n_same;
    cz_markup_write(markup, "<section id='checks'>\n<h2>Checks that differ</h2>\n");
    cz_compared_begin_checks(&table, report, &n_same);
    table.class_name = "cards";
    cz_table_write_page(&table, markup);
    if (n_same > 0)
        cz_markup_write(markup, "<p>%d checks are the same.</p>", n_same);
    cz_screening_write(report->compared[0].problem, markup);
    cz_markup_write(markup, "</section>\n");
}

static void write_inputs(CzMarkup *markup, const CzReport *report) {
    const CzComparison *comparison = report->comparison;
    CzReportTable table;
    if (comparison == NULL)
        return;
    cz_markup_write(markup, "<section id='inputs'>\n<h2>Inputs</h2>\n");
    if (comparison->n_input == 0) {
        cz_markup_write(markup, "<p>The inputs are equal: %d values.</p></section>\n",
                        comparison->n_same_input);
        return;
    }
    cz_compared_begin_inputs(&table, report, INT_MAX);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "<p>%d values are the same.</p></section>\n", comparison->n_same_input);
}

/* Every number that differs. */
static void write_differences(CzMarkup *markup, const CzReport *report) {
    CzReportTable table;
    if (report->comparison == NULL || report->comparison->n_number == 0)
        return;
    cz_markup_write(markup, "<details><summary>All %d numbers that differ</summary>",
                    report->comparison->n_number);
    cz_compared_begin_differences(&table, report);
    cz_table_write_page(&table, markup);
    cz_markup_write(markup, "</details>\n");
}

static void write_numbers(CzMarkup *markup, const CzReport *report, bool of_interface) {
    CzReportTable table;
    cz_compared_begin_numbers(&table, report, of_interface, true);
    cz_table_write_page(&table, markup);
}

/* One channel of all runs over time. */
static void write_overlay(CzMarkup *markup, const CzReport *report, const char *title,
                          CzChannel channel, int place) {
    const CzRunSummary *first = cz_compared_run(report, 0);
    CzSeries series[CZ_MAX_COMPARED];
    CzPlotBand band[CZ_MAX_COMPARED];
    char label[2][CZ_DRAWN_LABEL];
    int n_series = 0, n_band = 0;
    for (int i = 0; i < report->n_compared; i++) {
        const int scenario = cz_compared_scenario(report, i);
        const CzRun *own = scenario >= 0 ? report->compared[i].evaluation->run[scenario] : NULL;
        const double *time = own != NULL ? cz_run_channel(own, CZ_CHANNEL_TIME, 0) : NULL;
        const double *y = own != NULL ? cz_drawn_beside(first, channel, place, own) : NULL;
        if (time != NULL && y != NULL && cz_compared_is_beyond(report, i))
            band[n_band++] = cz_band_beyond(cz_compared_run(report, i), time, cz_run_n_sample(own));
        if (time != NULL && y != NULL)
            series[n_series++] = (CzSeries){.name = report->compared[i].label,
                                            .n = cz_run_n_sample(own),
                                            .x = time,
                                            .y = y,
                                            .colour = i,
                                            .dash = i};
    }
    if (n_series == 0)
        return;
    const CzPlot plot = {.title = title,
                         .x_label = cz_drawn_label(CZ_DRAWN_TIME, label[0]),
                         .y_label = cz_drawn_label((CzDrawn)channel, label[1]),
                         .n_series = n_series,
                         .series = series,
                         .n_band = n_band,
                         .band = band,
                         .from_zero = true};
    cz_plot_write_figure(&plot, markup);
}

static void write_loops(CzPage *page) {
    CzMarkup *markup = &page->markup;
    cz_markup_write(markup, "<section id='loops'>\n<h2>Force over closure</h2>\n"
                            "<div class='figures'>");
    for (int i = 0; i < cz_chart_count(page, CZ_CHART_FORCE_CLOSURE); i++)
        cz_page_write_figure(page, CZ_CHART_FORCE_CLOSURE, i);
    cz_markup_write(markup, "</div></section>\n");
}

static void write_overlays(CzPage *page, const CzReport *report) {
    static const struct {
        const char *title;
        CzChannel channel;
    } overlays[] = {{"Force of the colliding interface", CZ_CHANNEL_INTERFACE_FORCE},
                    {"Energy of the colliding interface", CZ_CHANNEL_INTERFACE_ENERGY},
                    {"Speed of the car behind it", CZ_CHANNEL_BODY_SPEED},
                    {"Pitch of the car behind it, nose up", CZ_CHANNEL_BODY_PITCH}};
    const int colliding = page->model->colliding;
    cz_markup_write(&page->markup,
                    "<section id='time'>\n<h2>Over time</h2>\n<div class='figures'>");
    for (size_t i = 0; i < sizeof overlays / sizeof *overlays; i++)
        write_overlay(&page->markup, report, overlays[i].title, overlays[i].channel, colliding);
    cz_markup_write(&page->markup, "</div></section>\n");
}

static void write_page(CzPage *page, const CzReport *report) {
    CzMarkup *markup = &page->markup;
    char title[CZ_SENTENCE_SIZE];
    snprintf(title, sizeof title, "%s, compared", cz_problem_title(page->problem));
    cz_page_write_head(markup, title);
    cz_markup_write(markup, "<h1>%s</h1><p>Figures are those of scenario %s.</p>", title,
                    page->summary->scenario);
    if (cz_compared_caution(report)[0] != '\0')
        cz_markup_write(markup, "<p class='fail'>%s</p>", cz_compared_caution(report));
    for (int i = 1; i < report->n_compared; i++)
        if (cz_compared_names_sentence(report, i, sizeof title, title))
            cz_markup_write(markup, "<p>%s.</p>", title);
    write_inputs(markup, report);
    write_checks(markup, report);
    cz_markup_write(markup, "<section id='numbers'>\n<h2>Interfaces and cars</h2>\n"
                            "<div class='tables'>");
    write_numbers(markup, report, true);
    write_numbers(markup, report, false);
    cz_markup_write(markup, "</div>\n");
    write_differences(markup, report);
    cz_markup_write(markup, "</section>\n");
    write_loops(page);
    write_overlays(page, report);
    cz_page_write_foot(markup);
}

CzStatus cz_page_write_comparison(const CzReport *report, FILE *stream, CzError *error) {
    const CzReportRun *run = report->compared;
    CzPageOther other[CZ_MAX_COMPARED];
    if (report->n_compared < 1 || cz_compared_run(report, 0) == NULL)
        return cz_fail(error, CZ_STATUS_INPUT, "no run was kept to compare");
    CzPage page = {.problem = run[0].problem,
                   .evaluation = run[0].evaluation,
                   .options = cz_report_options_of(report),
                   .scenario = cz_compared_scenario(report, 0),
                   .label = run[0].label,
                   .other = other};
    for (int i = 1; i < report->n_compared; i++) {
        const int its = cz_compared_scenario(report, i);
        if (cz_compared_run(report, i) != NULL)
            other[page.n_other++] = (CzPageOther){run[i].label, run[i].evaluation->run[its]};
    }
    CzStatus status = cz_page_begin(&page, error);
    if (status == CZ_OK) {
        write_page(&page, report);
        status = cz_page_finish(&page, stream, error);
    }
    cz_page_free(&page);
    return status;
}
