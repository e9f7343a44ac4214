/* Side elevation of the two colliding ends, to scale, with the chain of strokes below. */
#include "report/elevation.h"

#include "problem/strokes.h"
#include "report/figure.h"
#include "report/plot.h"
#include "report/units.h"

#include <math.h>
#include <string.h>

#define WIDTH 960.0
#define SCALE 72.0   /* units of the drawing in a metre */
#define COLUMN 150.0 /* room for labels at both sides */
#define RAIL 212.0   /* height of the rail head in the drawing */
#define FLOOR 0.75   /* of the drawn body above rail [m] */
#define ROOF 2.6     /* where the drawing is cut [m] */
#define LABEL_ROW 14.0
#define UNSTATED 0.95 /* where faces without a given height are drawn [m] */
#define CHAIN_TOP 240.0
#define CHAIN_ROW 36.0
enum { REAR, FRONT, MAX_LABELS = 6 };

/* One of the two ends. */
typedef struct Side {
    const CzVehicle *vehicle;
    const CzEnd *end;
    const char *name;
    double centre; /* of its body in the drawing */
    double sign;   /* direction of outwards in the drawing */
    double plane;  /* foremost plane from the centre [m] */
    double edge;   /* inner edge of its label column in the drawing */
    double rise;   /* height of its end above the drawn one [m] */
} Side;

/* Place in the drawing of a distance from the body's centre, outwards. */
static double place(const Side *side, double outwards) {
    return side->centre + side->sign * SCALE * outwards;
}

static double height(double z) {
    return RAIL - SCALE * z;
}

static double end_stroke(const CzEnd *end) {
    return cz_total_stroke(end->stages, end->n_stages, &end->curve);
}

static void write_bar(CzMarkup *markup, double from, double to, double y, double thickness,
                      const char *colour, const char *title) {
    cz_markup_write(markup,
                    "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='%s' "
                    "fill-opacity='.55' stroke='currentColor' stroke-width='.7'>"
                    "<title>%s</title></rect>",
                    fmin(from, to), y - thickness / 2, fabs(to - from), thickness, colour, title);
}

/* ---- parts ---- */

static void write_parts(CzMarkup *markup, const Side *side) {
    const CzEnd *end = side->end;
    const double bare = side->plane - (end->given && isfinite(end->face_gap) ? end->face_gap : 0);
    const double body = bare - (end->given ? end_stroke(end) : 0);
    const double middle = height((FLOOR + ROOF) / 2), tall = SCALE * (ROOF - FLOOR);
    write_bar(markup, side->edge, place(side, body), middle, tall, cz_plot_colour(5), "body");
    if (!end->given)
        return;
    if (body < bare)
        write_bar(markup, place(side, body), place(side, bare), middle, tall, cz_plot_colour(4),
                  "crush zone of the end");
    if (end->side_buffers.given)
        write_bar(markup, place(side, bare), place(side, side->plane - end->side_buffers.gap),
                  height(side->rise +
                         (isnan(end->side_buffers.height) ? 1.05 : end->side_buffers.height)),
                  14, cz_plot_colour(3), "side buffers");
    if (end->anti_climber.given) {
        const CzAntiClimber *face = &end->anti_climber;
        const double stated = isnan(face->height) ? end->crush_height : face->height;
        const double z = side->rise + (isnan(stated) ? UNSTATED : stated);
        const double tall_face = isnan(face->face_height) ? 0.2 : face->face_height;
        write_bar(markup, place(side, bare), place(side, side->plane - face->gap), height(z),
                  SCALE * tall_face, cz_plot_colour(1), "anti-climber");
    }
    if (end->coupler.given && isfinite(end->coupler.length) && isfinite(end->coupler.height)) {
        const double tip = side->plane - end->coupler.gap, pivot = tip - end->coupler.length;
        const double y = height(side->rise + end->coupler.height);
        write_bar(markup, place(side, pivot), place(side, tip), y, 9, cz_plot_colour(0), "coupler");
        cz_markup_write(
            markup, "<circle cx='%.1f' cy='%.1f' r='5' stroke='currentColor' stroke-width='2'/>",
            place(side, pivot), y);
    }
}

/* ---- heights ---- */

typedef struct Label {
    const char *what;
    double z;  /* above rail [m] */
    double to; /* where the line to the part ends, from the centre [m] */
    double y;  /* of the text in the drawing */
} Label;

static void add_label(Label *label, int *n, const char *what, double z, double to) {
    if (isfinite(z) && z > 0 && *n < MAX_LABELS)
        label[(*n)++] = (Label){what, z, to, height(z) + 4};
}

static int gather_labels(const Side *side, Label label[MAX_LABELS]) {
    const CzEnd *end = side->end;
    const double inside = side->plane - (WIDTH / 2 - COLUMN) / SCALE + 0.2;
    int n = 0;
    add_label(label, &n, "centre of gravity", side->vehicle->cg_height, inside);
    if (side->vehicle->bogie.given)
        add_label(label, &n, "traction link", side->vehicle->bogie.link.height, inside);
    if (!end->given)
        return n;
    const double bare = side->plane - (isfinite(end->face_gap) ? end->face_gap : 0);
    add_label(label, &n, "crush zone", side->rise + end->crush_height, bare - end_stroke(end) / 2);
    if (end->anti_climber.given)
        add_label(label, &n, "anti-climber", side->rise + end->anti_climber.height,
                  side->plane - end->anti_climber.gap);
    if (end->coupler.given && isfinite(end->coupler.length))
        add_label(label, &n, "coupler", side->rise + end->coupler.height,
                  side->plane - end->coupler.gap - end->coupler.length);
    if (end->side_buffers.given)
        add_label(label, &n, "side buffers", side->rise + end->side_buffers.height,
                  side->plane - end->side_buffers.gap);
    return n;
}

/* Places labels from top to bottom, at least a row apart and above the rail. */
static void spread(Label *label, int n) {
    for (int i = 1; i < n; i++)
        for (int k = i; k > 0 && label[k].y < label[k - 1].y; k--) {
            const Label other = label[k];
            label[k] = label[k - 1];
            label[k - 1] = other;
        }
    for (int i = 1; i < n; i++)
        label[i].y = fmax(label[i].y, label[i - 1].y + LABEL_ROW);
    double lowest = RAIL - 2;
    for (int i = n - 1; i >= 0; i--) {
        label[i].y = fmin(label[i].y, lowest);
        lowest = label[i].y - LABEL_ROW;
    }
}

static void write_heights(CzMarkup *markup, const Side *side) {
    Label label[MAX_LABELS];
    const int n = gather_labels(side, label);
    if (n == 0 && side->end->given)
        cz_svg_text(markup, side->sign > 0 ? 4 : WIDTH - 4, height(UNSTATED),
                    side->sign > 0 ? "start" : "end", "heights not stated");
    spread(label, n);
    for (int i = 0; i < n; i++) {
        char number[CZ_FIGURE_SIZE], text[96];
        snprintf(text, sizeof text, "%s %s m", label[i].what,
                 cz_figure_fixed(number, 3, label[i].z));
        cz_svg_text(markup, side->sign > 0 ? 4 : WIDTH - 4, label[i].y,
                    side->sign > 0 ? "start" : "end", text);
        cz_markup_write(markup,
                        "<path d='M%d %dL%d %dH%d' stroke='currentColor' stroke-width='.8' "
                        "stroke-dasharray='3 2'/>",
                        (int)(side->edge - side->sign * 4), (int)label[i].y - 4,
                        (int)(side->edge + side->sign * 8), (int)height(label[i].z),
                        (int)place(side, label[i].to));
    }
}

/* ---- the chain of strokes ---- */

typedef struct Link {
    const char *what;
    double length; /* [m] */
    int colour;    /* CZ_PLOT_QUIET for a gap */
} Link;

static double tube_stroke(const CzTube *tube) {
    return cz_total_stroke(tube->stages, tube->n_stages, &tube->curve);
}

/* Draws lengths in series from the foremost plane inwards, with a text above. */
static void write_chain(CzMarkup *markup, const Side *side, int row, const char *name, int n,
                        const Link *link) {
    const double y = CHAIN_TOP + CHAIN_ROW * row;
    char text[256];
    size_t used = (size_t)snprintf(text, sizeof text, "%s:", name);
    const char *between = " ";
    double at = side->plane;
    for (int i = 0; i < n; i++) {
        char number[CZ_FIGURE_SIZE];
        if (!(link[i].length > 0))
            continue;
        write_bar(markup, place(side, at), place(side, at - link[i].length), y + 14, 10,
                  link[i].colour < 0 ? "none" : cz_plot_colour(link[i].colour), link[i].what);
        at -= link[i].length;
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s %s", between, link[i].what,
                                 cz_figure_fixed(number, 0, link[i].length * CZ_MILLI_PER_UNIT));
        between = ", ";
    }
    const bool is_empty = at == side->plane;
    snprintf(text + used, sizeof text - used, is_empty ? " not stated" : " mm");
    cz_svg_text(markup, side->sign > 0 ? WIDTH / 2 - 12 : WIDTH / 2 + 12, y + 4,
                side->sign > 0 ? "end" : "start", text);
}

static void write_chains(CzMarkup *markup, const Side *side) {
    const CzEnd *end = side->end;
    if (!end->given)
        return;
    const CzCoupler *coupler = &end->coupler;
    const CzAntiClimber *face = &end->anti_climber;
    if (coupler->given) {
        const Link chain[] = {
            {"gap", coupler->gap, CZ_PLOT_QUIET},
            {"buffer", cz_total_stroke(coupler->buffer.stages, coupler->buffer.n_stages, NULL), 5},
            {"tube", tube_stroke(&coupler->tube), 0},
            {"second tube", tube_stroke(&coupler->second_tube), 0},
            {"retraction", coupler->shear_off.given ? coupler->shear_off.retraction_space : 0,
             CZ_PLOT_QUIET}};
        write_chain(markup, side, 0, "coupler", 5, chain);
    } else if (end->side_buffers.given) {
        const CzSideBuffers *set = &end->side_buffers;
        const Link chain[] = {
            {"gap", set->gap, CZ_PLOT_QUIET},
            {"buffer", cz_total_stroke(set->buffer.stages, set->buffer.n_stages, NULL), 5},
            {"tube", tube_stroke(&set->tube), 3}};
        write_chain(markup, side, 0, "side buffers", 3, chain);
    }
    if (!face->given && end_stroke(end) == 0)
        return;
    const Link chain[] = {
        {"gap", face->given ? face->gap : end->face_gap, CZ_PLOT_QUIET},
        {"anti-climber",
         face->given ? cz_total_stroke(face->stages, face->n_stages, &face->curve) : 0, 1},
        {"end", end_stroke(end), 4}};
    write_chain(markup, side, 1, face->given ? "anti-climber and end" : "end", 3, chain);
    const Link room[] = {{"in front of the survival space", end->available_length, 2}};
    write_chain(markup, side, 2, "room", 1, room);
}

/* ---- the drawing ---- */

/* Writes the name of the car, and the height offset of its end. */
static void write_name(CzMarkup *markup, const Side *side) {
    char text[128], number[CZ_FIGURE_SIZE];
    snprintf(text, sizeof text, "%s", side->name);
    if (side->rise != 0)
        snprintf(text, sizeof text, "%.60s, its end %s mm %s", side->name,
                 cz_figure_fixed(number, 0, fabs(side->rise) * CZ_MILLI_PER_UNIT),
                 side->rise > 0 ? "higher" : "lower");
    cz_svg_text(markup, side->edge + side->sign * 10, height(ROOF) - 5,
                side->sign > 0 ? "start" : "end", text);
}

/* Height offset of an end in the scenario: 0 the rear train, 1 the front one. */
static double offset_of(const CzModel *model, int which) {
    const CzTrain *train = &cz_problem_input(model->problem)->trains[model->train[which]];
    const double of_scenario = model->scenario->height_offset;
    return which == 1 && isfinite(of_scenario) ? of_scenario : train->height_offset;
}

static Side make_side(const CzModel *model, const CzLayout *layout, int which, double origin) {
    int n_vehicle;
    const CzVehicle *vehicles = cz_problem_vehicles(model->problem, &n_vehicle);
    const int car = model->colliding + which;
    const CzVehicle *vehicle = &vehicles[model->car[car].vehicle];
    return (Side){.vehicle = vehicle,
                  .end = which == 0 ? &vehicle->front : &vehicle->rear,
                  .name = model->car[car].name,
                  .centre = WIDTH / 2 + SCALE * (layout[car].x - origin),
                  .sign = which == 0 ? 1 : -1,
                  .plane = layout[car].plane[which == 0 ? FRONT : REAR],
                  .edge = which == 0 ? COLUMN : WIDTH - COLUMN,
                  .rise = offset_of(model, which)};
}

void cz_elevation_write(const CzModel *model, const CzLayout *layout, CzMarkup *markup) {
    const CzLayout *a = &layout[model->colliding], *b = a + 1;
    const double origin = (a->x + a->plane[FRONT] + b->x - b->plane[REAR]) / 2;
    cz_svg_open(markup, "The two ends that collide, to scale, with heights and strokes", WIDTH,
                CHAIN_TOP + 3 * CHAIN_ROW);
    cz_markup_write(markup, " class='elevation'>\n");
    for (int which = 0; which < 2; which++) {
        const Side side = make_side(model, layout, which, origin);
        write_parts(markup, &side);
        write_name(markup, &side);
        write_heights(markup, &side);
        write_chains(markup, &side);
        cz_markup_write(markup, "\n");
    }
    cz_markup_write(markup,
                    "<path d='M%d %dH%d' stroke='currentColor' stroke-width='2.5'/></svg>\n",
                    (int)COLUMN, (int)RAIL, (int)(WIDTH - COLUMN));
}
