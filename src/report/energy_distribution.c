/* Distribution of the dissipated energy: a bar per interface, split by kind of element. */
#include "report/charts.h"
#include "report/figure.h"
#include "report/plot.h"
#include "report/units.h"

#include <math.h>

#define LEFT 76.0
#define RIGHT 118.0 /* space for the number after a bar */
#define ROW 20.0
#define TOP 6.0

static double energy_of_kind(const CzInterfaceResult *interface, int kind) {
    double sum = 0;
    for (int i = 0; i < interface->n_element; i++)
        if ((int)interface->element[i].kind == kind && isfinite(interface->element[i].energy))
            sum += fmax(interface->element[i].energy, 0);
    return sum;
}

static void write_bar(CzMarkup *markup, double x, double y, double width, double height, int kind) {
    cz_markup_write(markup,
                    "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='%s' "
                    "stroke='currentColor' stroke-width='.5'><title>%s</title></rect>",
                    x, y, width, height, cz_plot_colour(kind),
                    cz_element_text((CzElementKind)kind));
}

static void write_row(const CzRunSummary *run, const CzInterfaceResult *interface, double y,
                      double scale, CzMarkup *markup) {
    char number[CZ_FIGURE_SIZE], share[CZ_FIGURE_SIZE], text[2 * CZ_FIGURE_SIZE + 8];
    cz_svg_text(markup, LEFT - 6, y + 13, "end", interface->name);
    double x = LEFT;
    for (int kind = 0; kind < CZ_N_ELEMENT_KIND; kind++) {
        const double width = cz_run_total(run, scale * energy_of_kind(interface, kind));
        if (width >= 0.1)
            write_bar(markup, x, y + 2, width, ROW - 6, kind);
        x += width > 0 ? width : 0;
    }
    snprintf(text, sizeof text, "%s kJ  %s",
             cz_figure_plain(number, cz_run_total(run, interface->energy) / CZ_KILO),
             cz_figure_percent(share, cz_run_total(run, interface->energy_share)));
    cz_svg_text(markup, x + 6, y + 13, "start", text);
}

/* Whether the train has elements of a kind, for the legend. */
static bool has_kind(const CzRunSummary *run, int kind) {
    for (int i = 0; i < run->n_interface; i++)
        for (int k = 0; k < run->interface[i].n_element; k++)
            if ((int)run->interface[i].element[k].kind == kind)
                return true;
    return false;
}

void cz_chart_write_shares(const CzPage *page, CzMarkup *markup) {
    const CzRunSummary *run = page->summary;
    double most = 0;
    for (int i = 0; i < run->n_interface; i++) {
        double sum = 0;
        for (int kind = 0; kind < CZ_N_ELEMENT_KIND; kind++)
            sum += energy_of_kind(&run->interface[i], kind);
        most = fmax(most, sum);
    }
    const double scale = most > 0 ? (CZ_PLOT_WIDTH - LEFT - RIGHT) / most : 0;
    const double bottom = TOP + ROW * run->n_interface;
    cz_svg_open(markup, "Dissipated energy by interface and element", CZ_PLOT_WIDTH, bottom + 24);
    cz_markup_write(markup, ">");
    for (int i = 0; i < run->n_interface; i++)
        write_row(run, &run->interface[i], TOP + ROW * i, scale, markup);
    double x = LEFT;
    for (int kind = 0; kind < CZ_N_ELEMENT_KIND; kind++) {
        const char *name = cz_element_text((CzElementKind)kind);
        if (!has_kind(run, kind))
            continue;
        write_bar(markup, x, bottom + 8, 12, 10, kind);
        cz_svg_text(markup, x + 16, bottom + 17, "start", name);
        x += 16 + 11 * cz_text_width(name) + 14;
    }
    cz_markup_write(markup, "</svg>\n");
}
