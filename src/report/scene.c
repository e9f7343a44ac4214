/* A side view: body, crush zones, anti-climbers, couplers, bogies and wheels of each car.
 *
 * Lengths and heights at rest are to scale; vertical movement and pitch are magnified, so that
 * millimetres show. Floor and roof are drawn at usual heights, because the model has none.
 */
#include "report/scene.h"

#include "problem/strokes.h"
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
    double face;  /* face of the anti-climber at rest; NaN if none */
    double pivot; /* of the coupler; NaN if none */
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

static Outline outline_of(const CzPage *page, int car, int side) {
    const CzEnd *end = end_of(page, car, side);
    const double plane = page->layout[car].plane[side];
    Outline outline = {plane, plane, NAN, NAN, NAN};
    if (!end->given)
        return outline;
    outline.bare = plane - (isnan(end->face_gap) ? 0 : end->face_gap);
    const double stroke = cz_total_stroke(end->stages, end->n_stages, &end->curve);
    outline.body = outline.bare - (stroke > 0.1 ? fmin(stroke, 3.0) : BARE);
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
    cz_markup_write(markup,
                    "<line class='%s %s' x1='%.2f' x2='%.2f' y1='%.1f' y2='%.1f' stroke='%s' "
                    "stroke-width='%.1f'/>",
                    kind, side == FRONT ? "front" : "rear", sign * from, sign * to, -S * height,
                    -S * height, colour, S * thickness);
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
        if (i % 2 == 0)
            cz_markup_write(markup,
                            "<line class='frame' x1='%.1f' x2='%.1f' y1='%.2f' y2='%.2f' "
                            "stroke='currentColor' stroke-opacity='.6' stroke-width='4'/>",
                            S * x - 6, S * (x + bogie->axle_spacing) + 6,
                            -S * (bogie->cg_height + CZ_SCENE_MAGNIFY * pose->lift[i]),
                            -S * (bogie->cg_height + CZ_SCENE_MAGNIFY * pose->lift[i + 1]));
        cz_markup_write(markup,
                        "<circle cx='%.1f' cy='%.2f' r='%.1f' stroke='currentColor' "
                        "stroke-width='2' class='wheel'/>",
                        S * x, -S * (bogie->wheel_radius + CZ_SCENE_MAGNIFY * pose->lift[i]),
                        S * bogie->wheel_radius);
    }
}

static void write_body(const CzPage *page, int car, const Outline outline[2], CzMarkup *markup) {
    const CzCar *description = &page->model->car[car];
    cz_markup_write(markup,
                    "<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='%s' "
                    "fill-opacity='.25' stroke='currentColor'/>",
                    -S * outline[REAR].body, -S * ROOF,
                    S * (outline[REAR].body + outline[FRONT].body), S * (ROOF - FLOOR),
                    cz_plot_colour(description->train == 0 ? 0 : 2));
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
    const double apart = fabs(page->layout[other].x - page->layout[car].x) - own.pivot -
                         facing.pivot - (side == FRONT ? moved : -moved);
    const double length = own.tip - own.pivot, sum = length + facing.tip - facing.pivot;
    return own.pivot + fmin(length, fmax(apart, 0) * length / sum);
}

/* Data for the script that moves a car: its place at rest, and the ends of its parts. */
static void write_places(const CzPage *page, int car, const Outline outline[2], double cg,
                         CzMarkup *markup) {
    cz_markup_write(markup, " data-car='%s' data-at='%.4f' data-cg='%.3f'",
                    page->model->car[car].name, page->layout[car].x, cg);
    for (int side = REAR; side <= FRONT; side++) {
        const char *name = side == FRONT ? "front" : "rear";
        cz_markup_write(markup, " data-%s='%.4f'", name, outline[side].bare);
        if (isfinite(outline[side].face))
            cz_markup_write(markup, " data-%s-face='%.4f'", name, outline[side].face);
        if (isfinite(outline[side].pivot))
            cz_markup_write(markup, " data-%s-pivot='%.4f' data-%s-tip='%.4f'", name,
                            outline[side].pivot, name, outline[side].tip);
    }
}

static void write_car(const CzPage *page, int car, int sample, double origin, bool moves,
                      CzMarkup *markup) {
    const Pose pose = pose_of(page, car, sample);
    const Outline outline[2] = {outline_of(page, car, REAR), outline_of(page, car, FRONT)};
    const double cg =
        isnan(vehicle_of(page, car)->cg_height) ? 1 : vehicle_of(page, car)->cg_height;
    char x[CZ_FIGURE_SIZE], z[CZ_FIGURE_SIZE], turn[CZ_FIGURE_SIZE], pivot[CZ_FIGURE_SIZE];
    cz_markup_write(markup, "<g class='car' transform='translate(%s 0)'",
                    cz_figure_fixed(x, 2, S * (page->layout[car].x + pose.x - origin)));
    if (moves)
        write_places(page, car, outline, cg, markup);
    cz_markup_write(markup, "><g class='body' transform='translate(0 %s) rotate(%s 0 %s)'>",
                    cz_figure_fixed(z, 2, -S * CZ_SCENE_MAGNIFY * pose.z),
                    cz_figure_fixed(turn, 3, -CZ_SCENE_MAGNIFY * pose.pitch * DEGREES_PER_RAD),
                    cz_figure_fixed(pivot, 1, -S * cg));
    for (int side = REAR; side <= FRONT; side++)
        write_end(page, car, side, &pose, &outline[side], tip_of(page, car, side, sample), markup);
    write_body(page, car, outline, markup);
    cz_markup_write(markup, "</g>");
    write_wheels(page, car, &pose, markup);
    cz_markup_write(markup, "</g>\n");
}

/* Place of an interface, halfway between the bare ends at the sample [m]. */
static double meeting_place(const CzPage *page, int interface, int sample) {
    double sum = 0;
    for (int side = 0; side < 2; side++) {
        const int car = interface + side;
        const double moved = sampled(page, sample, CZ_DRAWN_BODY_DISPLACEMENT, car);
        const Outline outline = outline_of(page, car, side == 0 ? FRONT : REAR);
        sum += page->layout[car].x + moved + (side == 0 ? outline.bare : -outline.bare);
    }
    return sum / 2;
}

void cz_scene_write(const CzPage *page, int interface, int sample, double width, bool moves,
                    CzMarkup *markup) {
    const double origin = meeting_place(page, interface, sample);
    const int half_width = (int)(width / 2);
    cz_markup_write(markup,
                    "<g class='scene' transform='translate(%d %d)'>"
                    "<path class='rail' d='M%d 2H%d' stroke='currentColor' stroke-width='3'/>",
                    half_width, (int)CZ_SCENE_RAIL, -half_width, half_width);
    cz_markup_write(markup, /* sleepers every 0.6 m, fixed to the ground */
                    "<path class='sleepers' d='M%d 7H%d' stroke='currentColor' "
                    "stroke-opacity='.5' stroke-width='5' stroke-dasharray='6 8.4' "
                    "stroke-dashoffset='%.2f'/>",
                    -half_width, half_width, S * (origin - width / 2 / S));
    for (int car = 0; car < page->model->n_car; car++) {
        const double x = page->layout[car].x - origin;
        const double half = fmax(page->layout[car].plane[0], page->layout[car].plane[1]) + BARE;
        if (moves || S * (fabs(x) - half - 20) < width / 2)
            write_car(page, car, sample, origin, moves, markup);
    }
    cz_markup_write(markup, "</g>");
}
