/* Which figures of a run there are, and what their axes show. */
#include "report/chart.h"

#include "text/curve_title.h"

static const char *const names[CZ_N_CHART] = {
#define CZ_CHART(constant, name, doc) name,
#include "crushzone/charts.def"
#undef CZ_CHART
};

#define OF_CURVES(number, x_axis, y_axis)                                                          \
    .count = CZ_CHART_##number, .is_of_curves = true, .x = CZ_DRAWN_##x_axis, .y = CZ_DRAWN_##y_axis

static const CzChartInfo charts[CZ_N_CHART] = {
    [CZ_CHART_FORCE_CLOSURE] = {.title = "Force over closure",
                                OF_CURVES(PER_INTERFACE, INTERFACE_CLOSURE, INTERFACE_FORCE)},
    [CZ_CHART_ENERGY_SHARES] = {.title = "Dissipated energy by interface and element"},
    [CZ_CHART_ENERGY] = {.title = "Energy over time", OF_CURVES(ONE, TIME, KINETIC_ENERGY)},
    [CZ_CHART_BALANCE] = {.title = "Error of the energy balance",
                          OF_CURVES(ONE, TIME, BALANCE_ERROR)},
    [CZ_CHART_FORCE] = {.title = "Force of the interfaces", OF_CURVES(ONE, TIME, INTERFACE_FORCE)},
    [CZ_CHART_VELOCITY] = {.title = "Speed of the cars", OF_CURVES(ONE, TIME, BODY_SPEED)},
    [CZ_CHART_ACCELERATION] = {.title = "Acceleration of the cars, CFC 60",
                               OF_CURVES(ONE, TIME, BODY_ACCELERATION)},
    [CZ_CHART_CAR_ACCELERATION] = {.title = "Acceleration",
                                   OF_CURVES(PER_CAR, TIME, BODY_ACCELERATION)},
    [CZ_CHART_DISPLACEMENT] = {.title = "Displacement of the cars",
                               OF_CURVES(ONE, TIME, BODY_DISPLACEMENT)},
    [CZ_CHART_SHORTENING] = {.title = "Shortening",
                             OF_CURVES(PER_INTERFACE, TIME, INTERFACE_CLOSURE)},
    [CZ_CHART_WHEEL_LIFT] = {.title = "Lift of the wheelsets that rise most",
                             OF_CURVES(ONE, TIME, WHEEL_LIFT)},
    [CZ_CHART_OVERLAP] = {.title = "Overlap of the anti-climbers",
                          OF_CURVES(ONE, TIME, ANTI_CLIMBER_OVERLAP)},
    [CZ_CHART_PITCH] = {.title = "Pitch of the cars, nose up", OF_CURVES(ONE, TIME, BODY_PITCH)},
    [CZ_CHART_FRAMES] = {.title = "The collision from the side"},
    [CZ_CHART_PANELS] = {.title = "Force, speed, displacement and shortening"}};

const CzChartInfo *cz_chart_info(CzChart chart) {
    return &charts[chart];
}

const char *cz_chart_name(CzChart chart) {
    return names[chart];
}

bool cz_chart_axes(CzChart chart, CzChartAxes *axes) {
    const CzChartInfo *info = &charts[chart];
    const CzUnit *x = cz_curve_unit_find(CZ_N_DIMENSION, cz_drawn_info(info->x)->unit);
    const CzUnit *y = cz_curve_unit_find(CZ_N_DIMENSION, cz_drawn_info(info->y)->unit);
    if (!info->is_of_curves || x == NULL || y == NULL)
        return false;
    *axes = (CzChartAxes){cz_dimension_text[x->dimension], x->si, cz_dimension_text[y->dimension],
                          y->si};
    return true;
}
