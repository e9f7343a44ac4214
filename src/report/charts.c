/* The list of figures: names, axes, numbers, titles. */
#include "report/charts.h"

#include "text/curve_title.h"

#include <string.h>

const CzChartInfo cz_charts[CZ_N_CHART] = {
#define AXES_DRAWING .is_of_curves = false
#define AXES_CURVES(x_axis, y_axis)                                                                \
    .is_of_curves = true, .x = CZ_DRAWN_##x_axis, .y = CZ_DRAWN_##y_axis
#define CZ_CHART(constant, name, title, number, axes, doc)                                         \
    {name, title, CZ_CHART_##number, AXES_##axes},
#include "crushzone/charts.def"
#undef CZ_CHART
};

bool cz_chart_axes(CzChart chart, CzChartAxes *axes) {
    const CzChartInfo *info = &cz_charts[chart];
    const CzUnit *x = cz_curve_unit_find(CZ_N_DIMENSION, cz_drawn_info(info->x)->unit);
    const CzUnit *y = cz_curve_unit_find(CZ_N_DIMENSION, cz_drawn_info(info->y)->unit);
    if (!info->is_of_curves || x == NULL || y == NULL)
        return false;
    *axes = (CzChartAxes){cz_dimension_text[x->dimension], x->si, cz_dimension_text[y->dimension],
                          y->si};
    return true;
}

int cz_chart_hardest_car(const CzRunSummary *run) {
    int found = 0;
    for (int i = 1; i < run->n_vehicle; i++)
        if (run->vehicle[i].mean_deceleration_120ms > run->vehicle[found].mean_deceleration_120ms)
            found = i;
    return found;
}

/* Whether a channel has values at any place. */
static bool has_any(const CzPage *page, CzDrawn drawn) {
    const CzChannelAt at = cz_drawn_info(drawn)->at;
    const int n = at == CZ_AT_RUN         ? 1
                  : at == CZ_AT_INTERFACE ? page->summary->n_interface
                                          : page->summary->n_vehicle;
    for (int place = 0; place < cz_first_place(at, n); place++)
        if (cz_page_values(page, drawn, place) != NULL)
            return true;
    return false;
}

int cz_chart_count(const CzPage *page, CzChart chart) {
    const CzChartInfo *info = &cz_charts[chart];
    if (page->n_sample < 2)
        return 0;
    return info->count == CZ_CHART_PER_INTERFACE ? page->summary->n_interface
           : info->count == CZ_CHART_PER_CAR     ? page->summary->n_vehicle
           : info->is_of_curves                  ? has_any(page, info->y)
                                                 : 1;
}

void cz_chart_title(const CzPage *page, CzChart chart, int index, size_t room, char *title) {
    const CzChartInfo *info = &cz_charts[chart];
    const char *of = info->count == CZ_CHART_PER_INTERFACE ? page->summary->interface[index].name
                     : info->count == CZ_CHART_PER_CAR     ? page->summary->vehicle[index].name
                                                           : NULL;
    snprintf(title, room, "%s%s%s", info->title, of != NULL ? ", " : "", of != NULL ? of : "");
}
