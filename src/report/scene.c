/* A side view: body, crush zones, anti-climbers, couplers, bogies and wheels of each car.
 *
 * Lengths and heights at rest are to scale; vertical movement and pitch are magnified, so that
 * millimetres show. Floor and roof are drawn at usual heights, which the model does not have.
 */
#include "report/scene.h"

#include "report/figure.h"
#include "report/plot.h"

#include <math.h>

#define S CZ_SCENE_SCALE
#define FLOOR 0.75 /* of the drawn body above the rail [m] */
#define ROOF 3.6   /* [m] */
#define BARE 0.5   /* drawn length of an end without stages [m] */
#define DEGREES_PER_RAD 57.29577951308232

enum { REAR, FRONT };

/* One end of a car as it is drawn: distances from the body's centre of gravity, outwards [m]. */
typedef struct Outline {
    double body;  /* end of the body, where the crush zone begins */
    double bare;  /* bare end structure at rest */
    double face;  /* face of the anti-climber at rest; NaN without */
    double pivot; /* of the coupler; NaN without */
    double tip;   /* coupling face at rest */
} Outline;

/* Position of a car at a sample [m, rad]. */
typedef struct Pose {
    double x, z, pitch, lift[4];
    double end[2], anti_climber[2]; /* strokes */
} Pose;

static const CzVehicle *vehicle_of(const CzPage *page, int car) {
    return &page->vehicles[page->model->car[car].vehicle];
}

static const CzEnd *end_of(const CzPage *page, int car, int side) {
    const CzVehicle *vehicle = vehicle_of(page, car);
    return side == REAR ? &vehicle->rear : &vehicle->front;
}

static double sum_of_strokes(const CzEnd *end) {
    double sum = 0;
    for (int i = 0; i < end->n_stages; i++)
        sum += end->stages[i].stroke;
    if (end->curve.given)
        sum = end->curve.x[end->curve.n_point - 1];
    return sum > 0.1 ? fmin(sum, 3.0) : BARE;
}

static Outline outline_of(const CzPage *page, int car, int side) {
    const CzEnd *end = end_of(page, car, side);
    const double plane = page->stand[car].plane[side];
    Outline outline = {plane, plane, NAN, NAN, NAN};
    if (!end->given)
        return outline;
    outline.bare = plane - (isnan(end->face_gap) ? 0 : end->face_gap);
    outline.body = outline.bare - sum_of_strokes(end);
    if (end->anti_climber.given)
        outline.face = plane - end->anti_climber.gap;
    if (end->coupler.given && isfinite(end->coupler.length)) {
        outline.tip = plane - end->coupler.gap;
        outline.pivot = outline.tip - end->coupler.length;
    }
    return outline;
}

static double sampled(const CzPage *page, int sample, CzDrawn drawn, int place) {
    const double *values = cz_page_values(page, drawn, place);
    return values != NULL && isfinite(values[sample]) ? values[sample] : 0;
}

static Pose pose_of(const CzPage *page, int car, int sample) {
    Pose pose = {.x = sampled(page, sample, CZ_DRAWN_BODY_DISPLACEMENT, car),
                 .z = 1e-3 * sampled(page, sample, CZ_DRAWN_BODY_RISE, car),
                 .pitch = 1e-3 * sampled(page, sample, CZ_DRAWN_BODY_PITCH, car)};
    for (int i = 0; i < 4; i++)
        pose.lift[i] = 1e-3 * sampled(page, sample, CZ_DRAWN_WHEEL_LIFT, cz_wheelset_place(car, i));
    for (int side = REAR; side <= FRONT; side++) {
        const int end = cz_end_place(car, side);
        pose.end[side] = 1e-3 * sampled(page, sample, CZ_DRAWN_END_STROKE, end);
        pose.anti_climber[side] = 1e-3 * sampled(page, sample, CZ_DRAWN_ANTI_CLIMBER_STROKE, end);
    }
    return pose;
}

/* Draws a part that shortens as a thick line from `from` to `to`, outwards along the car. */
static void write_part(CzMarkup *markup, const char *kind, int side, double from, double to,
                       double height, double thickness, const char *colour) {
    const double sign = side == FRONT ? S : -S;
    cz_markup_open(markup, "line");
    cz_markup_format(markup, "class", "%s %s", kind, side == FRONT ? "front" : "rear");
    cz_markup_numbers(markup, 2, "x1 x2", (const double[]){sign * from, sign * to});
    cz_markup_numbers(markup, 1, "y1 y2", (const double[]){-S * height, -S * height});
    cz_markup_attribute(markup, "stroke", colour);
    cz_markup_number(markup, "stroke-width", 1, S * thickness);
    cz_markup_close(markup);
}

static void write_end(const CzPage *page, int car, int side, const Pose *pose,
                      const Outline *outline, double tip, CzMarkup *markup) {
    const CzEnd *end = end_of(page, car, side);
    if (!end->given)
        return;
    if (isfinite(outline->pivot)) {
        const double height = isnan(end->coupler.height) ? 0.8 : end->coupler.height;
        write_part(markup, "coupler", side, outline->pivot, tip, height, 0.16, "currentColor");
    }
    write_part(markup, "end", side, outline->body, outline->bare - pose->end[side],
               (FLOOR + ROOF) / 2, ROOF - FLOOR, cz_plot_colour(4));
    if (isfinite(outline->face)) {
        const CzAntiClimber *face = &end->anti_climber;
        const double stated = isnan(face->height) ? end->crush_height : face->height;
        const double height = stated > 0.3 ? stated : 1.0;
        const double thickness = isnan(face->face_height) ? 0.2 : fmax(face->face_height, 0.15);
        write_part(markup, "face", side, outline->bare - pose->end[side],
                   outline->face - pose->end[side] - pose->anti_climber[side], height, thickness,
                   cz_plot_colour(1));
    }
}

static void write_wheels(const CzPage *page, int car, const Pose *pose, CzMarkup *markup) {
    const CzVehicle *vehicle = vehicle_of(page, car);
    const CzBogie *bogie = &vehicle->bogie;
    if (page->model->car[car].model != CZ_MODEL_FULL)
        return;
    for (int i = 0; i < 4; i++) {
        const double side = i < 2 ? -1 : 1, axle = i % 2 == 0 ? -1 : 1;
        const double x = side * vehicle->bogie_spacing / 2 + axle * bogie->axle_spacing / 2;
        if (i % 2 == 0) {
            cz_markup_open_class(markup, "line", "frame");
            cz_markup_numbers(markup, 1, "x1 x2",
                              (const double[]){S * x - 6, S * (x + bogie->axle_spacing) + 6});
            cz_markup_numbers(
                markup, 2, "y1 y2",
                (const double[]){-S * (bogie->cg_height + CZ_SCENE_MAGNIFY * pose->lift[i]),
                                 -S * (bogie->cg_height + CZ_SCENE_MAGNIFY * pose->lift[i + 1])});
            cz_markup_attributes(markup, "stroke", "currentColor", "stroke-opacity", ".6",
                                 "stroke-width", "4", NULL);
            cz_markup_close(markup);
        }
        cz_markup_open(markup, "circle");
        cz_markup_number(markup, "cx", 1, S * x);
        cz_markup_number(markup, "cy", 2,
                         -S * (bogie->wheel_radius + CZ_SCENE_MAGNIFY * pose->lift[i]));
        cz_markup_number(markup, "r", 1, S * bogie->wheel_radius);
        cz_markup_attributes(markup, "stroke", "currentColor", "stroke-width", "2", "class",
                             "wheel", NULL);
        cz_markup_close(markup);
    }
}

static void write_body(const CzPage *page, int car, const Outline outline[2], CzMarkup *markup) {
    const CzCar *description = &page->model->car[car];
    cz_markup_shape(markup, "rect", "x y width height",
                    (const double[]){-S * outline[REAR].body, -S * ROOF,
                                     S * (outline[REAR].body + outline[FRONT].body),
                                     S * (ROOF - FLOOR)},
                    "fill", cz_plot_colour(description->train == 0 ? 0 : 2), "fill-opacity", ".25",
                    "stroke", "currentColor", NULL);
    for (int side = -1; side <= 1; side++)
        cz_svg_text(markup, side * 0.62 * S * outline[side > 0 ? FRONT : REAR].body,
                    -S * (FLOOR + ROOF) / 2, "middle", description->name);
}

/* End of the coupler of one side: the two couplers share the distance of their pivots in proportion
 * to their lengths, and neither is longer than undamaged. */
static double tip_of(const CzPage *page, int car, int side, int sample) {
    const Outline own = outline_of(page, car, side);
    const int other = side == FRONT ? car + 1 : car - 1;
    if (isnan(own.pivot) || other < 0 || other >= page->model->n_car)
        return own.tip;
    const Outline facing = outline_of(page, other, side == FRONT ? REAR : FRONT);
    if (isnan(facing.pivot))
        return own.tip;
    const double moved = sampled(page, sample, CZ_DRAWN_BODY_DISPLACEMENT, car) -
                         sampled(page, sample, CZ_DRAWN_BODY_DISPLACEMENT, other);
    const double apart = fabs(page->stand[other].x - page->stand[car].x) - own.pivot -
                         facing.pivot - (side == FRONT ? moved : -moved);
    const double length = own.tip - own.pivot, sum = length + facing.tip - facing.pivot;
    return own.pivot + fmin(length, fmax(apart, 0) * length / sum);
}

static void write_car(const CzPage *page, int car, int sample, double origin, bool moves,
                      CzMarkup *markup) {
    const Pose pose = pose_of(page, car, sample);
    const Outline outline[2] = {outline_of(page, car, REAR), outline_of(page, car, FRONT)};
    const double cg =
        isnan(vehicle_of(page, car)->cg_height) ? 1 : vehicle_of(page, car)->cg_height;
    char x[CZ_FIGURE_ROOM], z[CZ_FIGURE_ROOM], turn[CZ_FIGURE_ROOM], pivot[CZ_FIGURE_ROOM];
    cz_markup_open_class(markup, "g", "car");
    cz_markup_format(markup, "transform", "translate(%s 0)",
                     cz_figure_fixed(x, 2, S * (page->stand[car].x + pose.x - origin)));
    if (moves) {
        cz_markup_attribute(markup, "data-car", page->model->car[car].name);
        cz_markup_number(markup, "data-at", 4, page->stand[car].x);
        cz_markup_number(markup, "data-cg", 3, cg);
        for (int side = REAR; side <= FRONT; side++) {
            const bool front = side == FRONT;
            cz_markup_number(markup, front ? "data-front" : "data-rear", 4, outline[side].bare);
            if (isfinite(outline[side].face))
                cz_markup_number(markup, front ? "data-front-face" : "data-rear-face", 4,
                                 outline[side].face);
            if (isfinite(outline[side].pivot)) {
                cz_markup_numbers(markup, 4,
                                  front ? "data-front-pivot data-front-tip"
                                        : "data-rear-pivot data-rear-tip",
                                  (const double[]){outline[side].pivot, outline[side].tip});
            }
        }
    }
    cz_markup_open_class(markup, "g", "body");
    cz_markup_format(markup, "transform", "translate(0 %s) rotate(%s 0 %s)",
                     cz_figure_fixed(z, 2, -S * CZ_SCENE_MAGNIFY * pose.z),
                     cz_figure_fixed(turn, 3, -CZ_SCENE_MAGNIFY * pose.pitch * DEGREES_PER_RAD),
                     cz_figure_fixed(pivot, 1, -S * cg));
    for (int side = REAR; side <= FRONT; side++)
        write_end(page, car, side, &pose, &outline[side], tip_of(page, car, side, sample), markup);
    write_body(page, car, outline, markup);
    cz_markup_close(markup);
    write_wheels(page, car, &pose, markup);
    cz_markup_end(markup);
}

/* Place of an interface, halfway between the bare ends at the sample [m]. */
static double meeting_place(const CzPage *page, int interface, int sample) {
    double sum = 0;
    for (int side = 0; side < 2; side++) {
        const int car = interface + side;
        const double moved = sampled(page, sample, CZ_DRAWN_BODY_DISPLACEMENT, car);
        const Outline outline = outline_of(page, car, side == 0 ? FRONT : REAR);
        sum += page->stand[car].x + moved + (side == 0 ? outline.bare : -outline.bare);
    }
    return sum / 2;
}

void cz_scene_write(const CzPage *page, int interface, int sample, double width, bool moves,
                    CzMarkup *markup) {
    const double origin = meeting_place(page, interface, sample);
    cz_markup_open_class(markup, "g", "scene");
    cz_markup_format(markup, "transform", "translate(%d %d)", (int)(width / 2), (int)CZ_SCENE_RAIL);
    cz_markup_open_class(markup, "path", "rail");
    cz_markup_format(markup, "d", "M%d 2H%d", (int)(-width / 2), (int)(width / 2));
    cz_markup_attributes(markup, "stroke", "currentColor", "stroke-width", "3", NULL);
    cz_markup_close(markup);
    cz_markup_open(markup, "path"); /* sleepers every 0.6 m, fixed to the ground */
    cz_markup_attribute(markup, "class", "sleepers");
    cz_markup_format(markup, "d", "M%d 7H%d", (int)(-width / 2), (int)(width / 2));
    cz_markup_attributes(markup, "stroke", "currentColor", "stroke-opacity", ".5", "stroke-width",
                         "5", "stroke-dasharray", "6 8.4", NULL);
    cz_markup_number(markup, "stroke-dashoffset", 2, S * (origin - width / 2 / S));
    cz_markup_close(markup);
    for (int car = 0; car < page->model->n_car; car++) {
        const double x = page->stand[car].x - origin;
        const double half = fmax(page->stand[car].plane[0], page->stand[car].plane[1]) + BARE;
        if (moves || S * (fabs(x) - half - 20) < width / 2)
            write_car(page, car, sample, origin, moves, markup);
    }
    cz_markup_close(markup);
}
