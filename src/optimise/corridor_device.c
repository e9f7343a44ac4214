/* The device of a corridor: its pieces, their values in a case, and its law.
 *
 * Each stage is divided into equal pieces. The stage with the longest pieces is divided once more
 * as long as the device may have a further stage and the pieces stay 50 mm long (ours). So the
 * ramps between two plateaus, a tenth of the shorter one and at most 5 mm, stay as they are, and
 * the divided law is that of the file.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "model/breakpoints.h"
#include "optimise/corridor.h"

#define SHORTEST_PIECE 50e-3 /* [m] (ours) */

/* ---- pieces ---- */

/* Chooses the number of pieces of each stage. */
static void choose_pieces(const CzPlacedDevice *device, int n_piece[CZ_MAX_STAGES]) {
    for (int i = 0; i < device->n_stage; i++)
        n_piece[i] = 1;
    for (int n = device->n_stage; n < device->most_stages; n++) {
        int longest = -1;
        double length = 0;
        for (int i = 0; i < device->n_stage; i++) {
            const double stroke = device->stage[i].stroke;
            const bool may = stroke / (n_piece[i] + 1) >= SHORTEST_PIECE * (1 - 1e-9);
            if (may && stroke / n_piece[i] > length * (1 + 1e-9)) {
                longest = i;
                length = stroke / n_piece[i];
            }
        }
        if (longest < 0)
            return;
        n_piece[longest]++;
    }
}

/* The k-th of n pieces of a plateau, which may rise or fall. */
static CzStage cut_plateau(const CzStage *stage, int k, int n) {
    CzStage piece = *stage;
    piece.stroke = stage->stroke / n;
    if (isnan(stage->end_force))
        return piece;
    const double rise = (stage->end_force - stage->force) / n;
    piece.force = stage->force + k * rise;
    piece.end_force = k + 1 < n ? stage->force + (k + 1) * rise : stage->end_force;
    return piece;
}

/* The k-th of n pieces of a stage of a loading curve that begins with a force. */
static CzStage cut_loading(const CzStage *stage, double begin, int k, int n) {
    CzStage piece = *stage;
    piece.stroke = stage->stroke / n;
    piece.force = k + 1 < n ? begin + (k + 1) * (stage->force - begin) / n : stage->force;
    return piece;
}

static void cut_stages(CzCorridor *corridor) {
    CzCorridorParts *parts = corridor->parts;
    const CzPlacedDevice *device = &parts->device;
    int n_of[CZ_MAX_STAGES], n = 0;
    double begin = device->is_loading && !isnan(device->peak) ? device->peak : 0;
    choose_pieces(device, n_of);
    for (int i = 0; i < device->n_stage; i++) {
        const CzStage *stage = &device->stage[i];
        for (int k = 0; k < n_of[i]; k++) {
            parts->piece[n] = device->is_loading ? cut_loading(stage, begin, k, n_of[i])
                                                 : cut_plateau(stage, k, n_of[i]);
            corridor->piece_stroke[n] = parts->piece[n].stroke;
            corridor->piece_force[n] = parts->piece[n].force;
            n++;
        }
        begin = stage->force;
    }
    corridor->n_piece = n;
}

/* Name of an end of a vehicle, such as "A6 front". */
static const char *name_end(const CzProblem *problem, const CzEnd *end, CzArena *arena) {
    int n_vehicle;
    const CzVehicle *vehicles = cz_problem_vehicles(problem, &n_vehicle);
    char name[CZ_NAME_SIZE + 8] = "";
    for (int v = 0; v < n_vehicle; v++)
        if (end == &vehicles[v].front || end == &vehicles[v].rear)
            snprintf(name, sizeof name, "%s %s", vehicles[v].name,
                     end == &vehicles[v].front ? "front" : "rear");
    return cz_arena_copy_text(arena, name, strlen(name));
}

static CzStatus describe(CzCorridor *corridor, CzError *error) {
    CzCorridorParts *parts = corridor->parts;
    const CzPlacedDevice *device = &parts->device;
    const size_t n_place = (size_t)device->n_place;
    const char **place = cz_arena_allocate(&parts->arena, n_place, sizeof *place);
    corridor->path = device->path;
    corridor->what = device->what;
    corridor->count = device->count;
    corridor->peak = device->peak;
    if (!isnan(device->peak))
        corridor->peak_word = device->is_loading ? "preload" : "trigger";
    corridor->place = place;
    for (int i = 0; place != NULL && i < device->n_place; i++) {
        place[i] = name_end(corridor->problem, device->place[i], &parts->arena);
        corridor->n_place += place[i] != NULL;
    }
    return corridor->n_place == device->n_place ? CZ_OK
                                                : cz_no_memory(error, "the places of a device");
}

/* Whether the pieces are at all places of the device, and nowhere else. */
static CzStatus check_divided(const CzCorridor *corridor, CzError *error) {
    CzPlacedDevice divided;
    const CzStatus status =
        cz_problem_find_device(corridor->parts->divided, corridor->path, &divided, error);
    const bool is_whole = status == CZ_OK && divided.n_stage == corridor->n_piece &&
                          divided.n_place == corridor->n_place;
    if (status == CZ_OK)
        cz_placed_device_free(&divided);
    return status != CZ_OK || is_whole
               ? status
               : cz_fail(error, CZ_STATUS_INPUT,
                         "a vehicle that has '%.200s' sets a stage of it" CZ_HELP
                         "name one place, such as trains.A.vehicles.A1.front.anti_climber",
                         corridor->path);
}

CzStatus cz_corridor_divide(CzCorridor *corridor, CzError *error) {
    CzCorridorParts *parts = corridor->parts;
    CZ_TRY(cz_problem_find_device(corridor->problem, parts->options.part, &parts->device, error));
    CZ_TRY(describe(corridor, error));
    cut_stages(corridor);
    CZ_TRY(cz_problem_read_stages(corridor->problem, corridor->path, corridor->n_piece,
                                  parts->piece, &parts->divided, error));
    return check_divided(corridor, error);
}

/* ---- values in a case ---- */

int cz_corridor_n_draw(const CzCorridor *corridor) {
    int n = corridor->peak_word != NULL;
    for (int i = 0; i < corridor->n_piece; i++)
        n += isnan(corridor->parts->piece[i].end_force) ? 2 : 3;
    return n;
}

/* Fills a draw that sets one number of the device; `piece` -1: beside its stages. */
static bool set_draw(const CzCorridor *corridor, int piece, const char *key, CzDraw *draw) {
    CzArena *arena = &corridor->parts->arena;
    char text[CZ_PATH_SIZE + 40];
    if (piece < 0)
        snprintf(text, sizeof text, "%s.%s", corridor->path, key);
    else
        snprintf(text, sizeof text, "%s.stages[%d].%s", corridor->path, piece, key);
    const char **path = cz_arena_allocate(arena, 1, sizeof *path);
    if (path == NULL || (*path = cz_arena_copy_text(arena, text, strlen(text))) == NULL)
        return false;
    *draw = (CzDraw){.name = *path, .n_path = 1, .path = path, .effect = CZ_DRAW_VALUE};
    return true;
}

bool cz_corridor_list_draws(CzCorridor *corridor, CzDraw *draw) {
    bool fits = true;
    for (int i = 0; i < corridor->n_piece; i++) {
        fits = fits && set_draw(corridor, i, "stroke_m", draw++) &&
               set_draw(corridor, i, "force_N", draw++);
        if (!isnan(corridor->parts->piece[i].end_force))
            fits = fits && set_draw(corridor, i, "end_force_N", draw++);
    }
    return corridor->peak_word == NULL
               ? fits
               : fits && set_draw(corridor, -1, corridor->parts->device.peak_key, draw);
}

/* Pieces and peak of a curve. The rules of problem files hold: a trigger is raised to the first
 * plateau, and the force of a buffer, which must not fall, to that before. Both stay within the
 * corridor, because the same holds for its edges. */
static double make_curve(const CzCorridor *corridor, const double *factor,
                         CzStage piece[CZ_MAX_PIECES]) {
    const CzPlacedDevice *device = &corridor->parts->device;
    const bool rises = device->is_loading && strcmp(device->what, "end") != 0;
    double peak = corridor->peak_word != NULL ? corridor->peak * factor[corridor->n_piece] : NAN;
    double before = rises && !isnan(peak) ? peak : 0;
    for (int i = 0; i < corridor->n_piece; i++) {
        piece[i] = corridor->parts->piece[i];
        piece[i].force *= factor[i];
        piece[i].end_force *= factor[i];
        if (rises)
            before = piece[i].force = fmax(piece[i].force, before);
    }
    return device->is_loading || isnan(peak) ? peak : fmax(peak, piece[0].force);
}

void cz_corridor_set_values(const CzCorridor *corridor, const double *factor, double *value) {
    CzStage piece[CZ_MAX_PIECES];
    const double peak = make_curve(corridor, factor, piece);
    for (int i = 0; i < corridor->n_piece; i++) {
        *value++ = piece[i].stroke;
        *value++ = piece[i].force;
        if (!isnan(piece[i].end_force))
            *value++ = piece[i].end_force;
    }
    if (corridor->peak_word != NULL)
        *value = peak;
}

/* ---- the law ---- */

int cz_corridor_law(const CzCorridor *corridor, const double factor[CZ_MAX_FACTORS],
                    double stroke[CZ_MAX_CORRIDOR_POINTS], double force[CZ_MAX_CORRIDOR_POINTS]) {
    const CzPlacedDevice *device = &corridor->parts->device;
    const CzTable none = {.given = false};
    CzStage piece[CZ_MAX_PIECES];
    CzBreakpoints law;
    const double peak = make_curve(corridor, factor, piece);
    if (device->is_loading)
        cz_breakpoints_loading(&law, isnan(peak) ? 0 : peak, piece, corridor->n_piece, &none, 0);
    else
        cz_breakpoints_strength(&law, piece, corridor->n_piece, &none, peak, device->trigger_length,
                                0);
    int n = 0;
    stroke[n++] = 0;
    for (int i = 0; i < law.n; i++)
        if (law.at[i] > stroke[n - 1] && law.at[i] <= law.usable)
            stroke[n++] = law.at[i];
    for (int i = 0; i < n; i++)
        force[i] = cz_breakpoints_value(&law, stroke[i]);
    return n;
}

static double energy_of(int n, const double *stroke, const double *force) {
    double sum = 0;
    for (int i = 1; i < n; i++)
        sum += (stroke[i] - stroke[i - 1]) * (force[i] + force[i - 1]) / 2;
    return sum;
}

/* Whether a point is on the line between its neighbours, up to rounding. */
static bool is_on_line(const double *stroke, const double *force, int i) {
    const double share = (stroke[i] - stroke[i - 1]) / (stroke[i + 1] - stroke[i - 1]);
    const double between = force[i - 1] + share * (force[i + 1] - force[i - 1]);
    return fabs(between - force[i]) <= 1e-9 * fabs(force[i]);
}

void cz_corridor_fill_points(CzCorridor *corridor) {
    double factor[3][CZ_MAX_FACTORS], stroke[CZ_MAX_CORRIDOR_POINTS];
    double *force[3] = {corridor->lower, corridor->nominal, corridor->upper};
    int n = 0;
    for (int i = 0; i < CZ_MAX_FACTORS; i++) {
        factor[0][i] = 1 - corridor->edge[0].width;
        factor[1][i] = 1;
        factor[2][i] = 1 + corridor->edge[1].width;
    }
    for (int c = 0; c < 3; c++) {
        n = cz_corridor_law(corridor, factor[c], stroke, force[c]);
        corridor->energy[c] = energy_of(n, stroke, force[c]);
    }
    corridor->n_point = 0;
    for (int i = 0; i < n; i++) {
        if (i > 0 && i + 1 < n && is_on_line(stroke, force[0], i) &&
            is_on_line(stroke, force[1], i) && is_on_line(stroke, force[2], i))
            continue;
        const int to = corridor->n_point++;
        corridor->stroke[to] = stroke[i];
        for (int c = 0; c < 3; c++)
            force[c][to] = force[c][i];
    }
}
