/* Impulses that pitched and lifted the bodies, by source, as bars. */
#include "report/page.h"

#include "report/figure.h"
#include "report/table.h"
#include "report/units.h"

#include <math.h>

/* An impulse in kilo-units; one that rounds to zero has no sign. */
static const char *in_kilo(char text[CZ_FIGURE_SIZE], double impulse) {
    const double value = impulse / CZ_KILO;
    return cz_figure_fixed(text, 1, fabs(value) < 0.05 ? 0 : value);
}

static void put_row(CzReportTable *table, const char *name, double moment, double lift, double most,
                    const char *remark) {
    static const CzBar bar = {"budget", NULL, 90, 92, "#d55e00", "#0072b2"};
    char text[CZ_FIGURE_SIZE];
    cz_table_put(table, name);
    cz_table_put(table, in_kilo(text, moment));
    cz_table_put_bar(table, &bar, most > 0 ? moment / most : 0); /* of the longest */
    cz_table_put(table, in_kilo(text, lift));
    cz_table_put_styled(table, remark, CZ_STYLE_SMALL);
}

static void write_car(CzMarkup *markup, const char *car, const CzVehicleBudget *budget) {
    int order[CZ_N_BUDGET];
    char time[CZ_FIGURE_SIZE];
    const int n = cz_budget_order(budget, order);
    const double most = n > 0 ? fabs(budget->moment[order[0]]) : 0;
    cz_markup_write(markup, "<h3>%s, until its largest %s at %s ms</h3>", car,
                    budget->of_lift ? "wheel lift" : "pitch",
                    cz_figure_fixed(time, 0, budget->time * CZ_MILLI_PER_UNIT));
    CzReportTable table;
    cz_table_begin(&table, "source;>moment kNms;nose-down | nose-up;>lift kNs;");
    for (int i = 0; i < n; i++) {
        const CzBudgetSource source = (CzBudgetSource)order[i];
        put_row(&table, cz_budget_text(source), budget->moment[source], budget->lift[source], most,
                cz_budget_counts(source) ? "" : "through the end mass");
    }
    put_row(&table, "the body then", budget->spin, budget->rise, most,
            "its momenta: sum of all direct contributions");
    cz_table_write_page(&table, markup);
}

/* The car with the largest wheel lift, or with the largest pitch where no wheel lifts; -1 without
 * cars with running gear. */
static int worst_car(const CzRunSummary *run) {
    int found = -1;
    double most_lift = 0, most_pitch = 0;
    for (int i = 0; i < run->n_vehicle; i++) {
        double lift = 0;
        for (int k = 0; k < 4; k++)
            lift = fmax(lift, run->vehicle[i].wheel_lift[k]);
        if (!run->budget[i].of_lift)
            lift = 0;
        const double pitch = run->vehicle[i].max_pitch;
        const bool is_worse = lift > most_lift || (lift == most_lift && pitch > most_pitch);
        if (!is_worse || !(run->budget[i].time > 0))
            continue;
        found = i;
        most_lift = lift;
        most_pitch = pitch;
    }
    return found;
}

void cz_page_write_budget(CzPage *page) {
    const CzRunSummary *run = page->summary;
    CzMarkup *markup = &page->markup;
    const int worst = run->budget != NULL ? worst_car(run) : -1;
    if (worst < 0)
        return;
    cz_markup_write(markup,
                    "<section id='budget'>\n<h2>Pitch: moments and impulses</h2>\n"
                    "<p>Impulses about the centre of gravity of a body by source, from the first "
                    "contact to its largest wheel lift, or to its largest pitch "
                    "where the lift is below 0.1 mm. Nose-up is positive for a car facing +x.</p>");
    write_car(markup, run->vehicle[worst].name, &run->budget[worst]);
    cz_markup_write(markup, "<details><summary>The other cars</summary>");
    for (int i = 0; i < run->n_vehicle; i++)
        if (i != worst && run->budget[i].time > 0)
            write_car(markup, run->vehicle[i].name, &run->budget[i]);
    cz_markup_write(markup, "</details></section>\n");
}
