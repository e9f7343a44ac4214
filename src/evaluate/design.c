/* Design map: assigns variables to places in the vehicle records. */
#include "evaluate/design.h"
#include "base/error.h"
#include "base/increment.h"
#include "base/number.h"
#include "model/breakpoints.h"
#include "problem/strokes.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Context for building the map. */
typedef struct Builder {
    const CzProblem *problem;
    const CzVehicle *vehicles; /* as written (n_vehicle) */
    int n_vehicle;
    int n_scene;
    const CzScene *scene;
    CzArena *arena;
    CzDesign *design;
    int most_variables;
    CzError *error;
} Builder;

/* ---- the identical partner ------------------------------------------------------------------- */

static bool same_number(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

/* Whether two vehicles have the same values; one may be a copy with the same texts. */
static bool vehicles_are_alike(const CzVehicle *a, const CzVehicle *b, bool mirrored) {
    return a->model == b->model && same_number(a->mass, b->mass) &&
           same_number(a->length, b->length) &&
           memcmp(&a->front, mirrored ? &b->rear : &b->front, sizeof a->front) == 0 &&
           memcmp(&a->rear, mirrored ? &b->front : &b->rear, sizeof a->rear) == 0;
}

/* Whether the train ahead is identical to the train behind, in the same or in reversed order. */
static bool partner_is_alike(const CzScene *scene, bool mirrored) {
    const int n = scene->colliding + 1;
    if (scene->train[0] == scene->train[1] || scene->n_vehicle != 2 * n)
        return false;
    for (int i = 0; i < n; i++) {
        const CzVehicle *partner = scene->vehicle[mirrored ? 2 * n - 1 - i : n + i];
        if (!vehicles_are_alike(scene->vehicle[i], partner, mirrored))
            return false;
    }
    return true;
}

/* Offset of the same place in a vehicle that is reversed. */
static size_t mirrored_offset(size_t offset) {
    const size_t front = offsetof(CzVehicle, front), rear = offsetof(CzVehicle, rear);
    if (offset >= front && offset < front + sizeof(CzEnd))
        return offset - front + rear;
    if (offset >= rear && offset < rear + sizeof(CzEnd))
        return offset - rear + front;
    return offset;
}

/* The place in the partner that corresponds to `place`; false when this vehicle has no identical
 * partner in this scene. */
static bool find_partner(const CzScene *scene, const CzDesignPlace *place, CzDesignPlace *partner) {
    const bool mirrored = partner_is_alike(scene, true);
    if (!mirrored && !partner_is_alike(scene, false))
        return false;
    const int n = scene->colliding + 1;
    for (int i = 0; i < 2 * n; i++) {
        if (scene->record[i] != place->vehicle)
            continue;
        const int other = mirrored ? 2 * n - 1 - i : (i + n) % (2 * n);
        *partner = *place;
        partner->vehicle = scene->record[other];
        partner->offset = mirrored ? mirrored_offset(place->offset) : place->offset;
        return true;
    }
    return false;
}

/* ---- one variable ---------------------------------------------------------------------------- */

static const char *name_of(const CzVehicle *vehicle) {
    return vehicle->name != NULL ? vehicle->name : "";
}

/* Whether a variable sets a place; one that chooses a buffer sets all values in it. */
static bool drives(const CzDesignVariable *variable, const CzDesignPlace *place) {
    const size_t size = variable->info.n_choice > 0 ? sizeof(CzBuffer) : 1;
    for (int i = 0; i < variable->n_place; i++)
        if (variable->place[i].vehicle == place->vehicle &&
            place->offset - variable->place[i].offset < size)
            return true;
    return false;
}

static CzStatus add_place(const Builder *builder, CzDesignVariable *variable,
                          const CzDesignPlace *place) {
    CzDesignPlace *places =
        cz_arena_grow(builder->arena, variable->place, variable->n_place, sizeof *places);
    if (places == NULL)
        return cz_no_memory(builder->error, "the design variables");
    variable->place = places;
    variable->place[variable->n_place++] = *place;
    return CZ_OK;
}

/* The drawn stroke of the anti-climber if the target is its stroke: a search lengthens a full car
 * with the stroke, so a file with a new stroke must also give the drawn one. NaN for other
 * numbers. */
static double drawn_stroke(const Builder *builder, const CzTarget *target) {
    if (target->vehicle < 0 || builder->design->is_fit)
        return NAN;
    const CzVehicle *vehicle = &builder->vehicles[target->vehicle];
    if (vehicle->model != CZ_MODEL_FULL)
        return NAN;
    const CzEnd *const ends[2] = {&vehicle->rear, &vehicle->front};
    for (int end = 0; end < 2; end++) {
        const CzAntiClimber *device = &ends[end]->anti_climber;
        const size_t first = (size_t)((const char *)device->stages - (const char *)vehicle);
        const size_t inside = target->offset - first;
        if (target->offset < first || inside >= sizeof device->stages ||
            inside % sizeof(CzStage) != offsetof(CzStage, stroke))
            continue;
        return isnan(device->drawn_stroke) ? cz_device_stroke(CZ_DEVICE(device))
                                           : device->drawn_stroke;
    }
    return NAN;
}

/* Adds a path that sets some of the variable's places, unless it is listed. */
static CzStatus add_shown(const Builder *builder, CzDesignVariable *variable,
                          const CzTarget *target, double factor) {
    const char *path = target->place;
    const double drawn = drawn_stroke(builder, target);
    for (int i = 0; i < variable->info.n_place; i++)
        if (strcmp(variable->info.place[i].path, path) == 0) {
            if (!isnan(drawn)) /* the part is used by rigid and by full cars */
                variable->info.place[i].drawn_stroke = drawn;
            return CZ_OK;
        }
    CzVariablePlace *shown =
        cz_arena_grow(builder->arena, variable->info.place, variable->info.n_place, sizeof *shown);
    const char *copy = cz_arena_copy_text(builder->arena, path, strlen(path));
    if (shown == NULL || copy == NULL)
        return cz_no_memory(builder->error, "the design variables");
    variable->info.place = shown;
    variable->info.place[variable->info.n_place++] =
        (CzVariablePlace){.path = copy, .factor = factor, .drawn_stroke = drawn};
    return CZ_OK;
}

/* Fails where a variable changes only one of two identical trains, because a search could then
 * soften the partner.
 */
static CzStatus check_partners(const Builder *builder, const void *field,
                               const CzDesignVariable *variable) {
    for (int i = 0; i < variable->n_place; i++)
        for (int s = 0; s < builder->n_scene; s++) {
            CzDesignPlace partner;
            if (!find_partner(&builder->scene[s], &variable->place[i], &partner) ||
                drives(variable, &partner))
                continue;
            return cz_problem_fail(
                builder->problem, field, builder->error,
                "'%s' changes '%s' but not its counterpart in '%s': the two trains are identical "
                "and must share every variable; vary a part, or tie both with 'paths'",
                variable->info.name, name_of(&builder->vehicles[variable->place[i].vehicle]),
                name_of(&builder->vehicles[partner.vehicle]));
        }
    return CZ_OK;
}

/* Field whose place in the file is reported for a variable. */
static const void *field_of(const CzVariable *written) {
    return written->path != NULL ? (const void *)&written->path : (const void *)&written->paths;
}

static CzStatus add_target(const Builder *builder, const CzTarget *target,
                           CzDesignVariable *variable) {
    if (variable->n_place == 0) {
        variable->info.unit =
            cz_arena_copy_text(builder->arena, target->suffix, strlen(target->suffix));
        variable->info.start = target->value / target->unit;
    }
    const double unit = variable->n_place == 0 ? target->unit : variable->place[0].scale;
    if (variable->info.unit == NULL)
        return cz_no_memory(builder->error, "the design variables");
    CZ_TRY(add_shown(builder, variable, target, unit / target->unit));
    const size_t elsewhere = (size_t)(uintptr_t)target->field;
    const CzDesignPlace place = {.vehicle = target->vehicle,
                                 .offset = target->vehicle >= 0 ? target->offset : elsewhere,
                                 .scale = unit};
    return drives(variable, &place) ? CZ_OK : add_place(builder, variable, &place);
}

/* Whether a vehicle belongs to the train behind of any scenario. */
static bool is_own(const Builder *builder, int vehicle) {
    for (int s = 0; s < builder->n_scene; s++)
        for (int i = 0; i <= builder->scene[s].colliding; i++)
            if (builder->scene[s].record[i] == vehicle)
                return true;
    return false;
}

static CzStatus check_variable(const Builder *builder, const CzVariable *written,
                               const CzDesignVariable *variable) {
    const CzVariableInfo *info = &variable->info;
    bool any_own = builder->design->is_fit;
    for (int i = 0; i < variable->n_place; i++)
        any_own |= is_own(builder, variable->place[i].vehicle);
    if (!any_own)
        return cz_problem_fail(
            builder->problem, field_of(written), builder->error,
            "'%s' changes only the partner; a softer partner does not improve the design",
            info->name);
    for (const CzDesignVariable *other = builder->design->variable; other != variable; other++) {
        bool shares = false;
        for (int i = 0; i < variable->n_place; i++)
            shares |= drives(other, &variable->place[i]);
        for (int i = 0; i < other->n_place; i++)
            shares |= drives(variable, &other->place[i]);
        if (shares)
            return cz_problem_fail(builder->problem, field_of(written), builder->error,
                                   "'%s' is driven by two variables", variable->info.place[0].path);
    }
    return CZ_OK;
}

/* ---- an entry of the file may define several variables
 * ------------------------------------------ */

/* Name of a variable: as given, with a number when there are several; else its path. */
static const char *name_variable(const Builder *builder, const CzVariable *written, int match,
                                 int n_match, const char *place) {
    char text[256];
    if (written->name != NULL && n_match > 1)
        snprintf(text, sizeof text, "%s[%d]", written->name, match);
    else if (written->name != NULL)
        snprintf(text, sizeof text, "%s", written->name);
    else
        snprintf(text, sizeof text, "%s", n_match == 1 && written->path ? written->path : place);
    return cz_arena_copy_text(builder->arena, text, strlen(text));
}

/* Sets the sizes of a list, which were checked when the problem was read. */
static CzStatus settle_values(const Builder *builder, const CzVariable *written,
                              CzVariableInfo *info) {
    const int n = written->values.n_text;
    double *value = cz_arena_numbers(builder->arena, (size_t)n);
    if (value == NULL)
        return cz_no_memory(builder->error, "the design variables");
    for (int i = 0; i < n; i++)
        cz_number_parse(written->values.text[i], &value[i]);
    info->n_value = n;
    info->value = value;
    info->min = value[0];
    info->max = value[n - 1];
    return CZ_OK;
}

/* A variable whose bounds allow one value only does not vary. */
static void settle_fixed(CzVariableInfo *info) {
    const bool by_bounds = info->min == info->max;
    const bool by_step =
        info->increment > 0 && cz_increment_count(info->increment, info->min, info->max) == 1;
    info->is_fixed = info->n_choice == 0 && (by_bounds || by_step);
    if (info->is_fixed)
        info->fixed_at = by_bounds ? info->min : cz_increment_not_below(info->increment, info->min);
}

/* A start outside a bound by a rounding error of units is moved to the bound. */
static void settle_start(CzVariableInfo *info) {
    const double bounds[2] = {info->min, info->max};
    for (int i = 0; i < 2; i++)
        if (fabs(info->start - bounds[i]) <= 4 * DBL_EPSILON * fabs(bounds[i]))
            info->start = bounds[i];
}

/* First target of a match; all targets are one match when `n_match` is 1. */
static const CzTarget *first_of(const CzTarget *target, int match, int n_match) {
    while (n_match > 1 && target->match != match)
        target++;
    return target;
}

/* Converts a variable to the number of one of its choices; the choice of the file is the first. */
static CzStatus settle_choice(const Builder *builder, const CzVariable *written,
                              CzDesignVariable *variable) {
    CzVariableInfo *info = &variable->info;
    const int n = written->choices.n_text;
    if (n > CZ_MAX_COMBINATIONS)
        return cz_problem_fail(builder->problem, &written->choices, builder->error,
                               "'%s' has more than %d choices", info->name,
                               (int)CZ_MAX_COMBINATIONS);
    info->n_choice = n;
    info->choice = written->choices.text;
    info->min = 0;
    info->max = n - 1;
    info->increment = 1;
    int own = 0;
    const CzStatus status = cz_choice_find_start(builder->problem, variable, &own, builder->error);
    info->start = own;
    return cz_problem_place_failure(builder->problem, &written->choices, status, builder->error);
}

static CzStatus add_variable(Builder *builder, const CzVariable *written, int match, int n_match,
                             const CzTargets *targets) {
    const CzTarget *target = targets->target;
    CzDesign *design = builder->design;
    if (design->n_variable == builder->most_variables)
        return cz_problem_fail(builder->problem, &written->min, builder->error,
                               "there are more than 1000 variables");
    CzDesignVariable *variable = &design->variable[design->n_variable];
    variable->info.name =
        name_variable(builder, written, match, n_match, first_of(target, match, n_match)->place);
    if (variable->info.name == NULL)
        return cz_no_memory(builder->error, "the design variables");
    for (int i = 0; i < targets->n; i++)
        if (n_match == 1 || target[i].match == match)
            CZ_TRY(add_target(builder, &target[i], variable));
    variable->info.min = written->min;
    variable->info.max = written->max;
    variable->info.increment = isnan(written->increment) ? 0 : written->increment;
    if (!isnan(written->start))
        variable->info.start = written->start;
    variable->start_field = isnan(written->start) ? &written->min : &written->start;
    if (written->values.n_text > 0) {
        CZ_TRY(settle_values(builder, written, &variable->info));
        if (isnan(written->start))
            variable->start_field = &written->values;
    }
    if (written->choices.n_text > 0)
        CZ_TRY(settle_choice(builder, written, variable));
    settle_fixed(&variable->info);
    settle_start(&variable->info);
    CZ_TRY(check_variable(builder, written, variable));
    if (!design->is_fit)
        CZ_TRY(check_partners(builder, field_of(written), variable));
    design->n_variable++;
    if (cz_design_n_combination(design) > CZ_MAX_COMBINATIONS)
        return cz_problem_fail(builder->problem, &written->choices, builder->error,
                               "there are more than %d combinations of choices",
                               (int)CZ_MAX_COMBINATIONS);
    return CZ_OK;
}

/* An entry of the file: one variable per match of its path, or one for all of its paths. */
static CzStatus add_entry(Builder *builder, const CzVariable *written, const CzTargets *targets) {
    int n_match = 1;
    for (int i = 0; written->path != NULL && i < targets->n; i++)
        n_match = targets->target[i].match >= n_match ? targets->target[i].match + 1 : n_match;
    for (int match = 0; match < n_match && targets->n > 0; match++)
        CZ_TRY(add_variable(builder, written, match, n_match, targets));
    return CZ_OK;
}

CzStatus cz_design_build(const CzProblem *problem, int n_scene, const CzScene *scene,
                         CzArena *arena, CzDesign *design, CzError *error) {
    const CzOptimise *optimise = &cz_problem_input(problem)->optimise;
    *design = (CzDesign){0};
    if (!optimise->given || optimise->n_variables == 0)
        return CZ_OK;
    Builder builder = {.problem = problem,
                       .n_scene = n_scene,
                       .scene = scene,
                       .arena = arena,
                       .design = design,
                       .most_variables = 1000,
                       .error = error};
    design->is_fit = optimise->n_match > 0;
    builder.vehicles = cz_problem_vehicles(problem, &builder.n_vehicle);
    design->variable =
        cz_arena_allocate(arena, (size_t)builder.most_variables, sizeof *design->variable);
    if (design->variable == NULL)
        return cz_no_memory(error, "the design variables");
    for (int i = 0; i < optimise->n_variables; i++)
        CZ_TRY(add_entry(&builder, &optimise->variables[i], cz_problem_targets(problem, i)));
    return CZ_OK;
}

CzStatus cz_design_check_start(const CzProblem *problem, const CzDesign *design, CzError *error) {
    for (int i = 0; i < design->n_variable; i++) {
        const CzVariableInfo *info = &design->variable[i].info;
        if (info->n_choice > 0 || (info->start >= info->min && info->start <= info->max))
            continue;
        char start[CZ_NUMBER_TEXT], min[CZ_NUMBER_TEXT], max[CZ_NUMBER_TEXT];
        return cz_problem_fail(problem, design->variable[i].start_field, error,
                               "the starting value %s of '%s' is outside its bounds, %s to %s %s",
                               cz_number_print(start, info->start), info->name,
                               cz_number_print(min, info->min), cz_number_print(max, info->max),
                               info->unit);
    }
    return CZ_OK;
}

static void write_number(CzVehicle *vehicles, const CzDesignPlace *place, double value) {
    memcpy((char *)&vehicles[place->vehicle] + place->offset, &value, sizeof value);
}

/* Writes the places that a variation changes once more; the changes of one place follow one
 * another. */
static void apply_changes(const CzDesign *design, int variation, const double *x,
                          CzVehicle *vehicles) {
    const CzDesignChange *last = NULL;
    double number = 0;
    for (int i = 0; i < design->n_change; i++) {
        const CzDesignChange *change = &design->change[i];
        if (change->variation != variation)
            continue;
        const CzDesignPlace *place = &design->variable[change->variable].place[change->place];
        const bool is_new =
            last == NULL || last->variable != change->variable || last->place != change->place;
        if (is_new)
            number = x[change->variable] * (place->scale / change->unit);
        number = change->kind == CZ_CASE_FACTOR ? number * change->number
                 : change->kind == CZ_CASE_ADD  ? number + change->number
                                                : change->number;
        write_number(vehicles, place, number * change->unit);
        last = change;
    }
}

void cz_design_apply(const CzDesign *design, int variation, const double *x, CzVehicle *vehicles) {
    for (int i = 0; i < design->n_variable && !design->is_fit; i++)
        for (int j = 0; j < design->variable[i].n_place && design->variable[i].info.n_choice == 0;
             j++)
            write_number(vehicles, &design->variable[i].place[j],
                         x[i] * design->variable[i].place[j].scale);
    apply_changes(design, variation, x, vehicles);
}
