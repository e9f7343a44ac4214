/* Inventory of parts: a part has no declared kind, so it is read as the record of the key that uses
 * it, or else as the first record in which it is complete, or has only known keys. */
#include "crushzone/parts.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "problem/reading.h"
#include "problem/strokes.h"
#include "problem/trace.h"
#include "tree/load.h"
#include "tree/merge.h"

struct CzInventory {
    CzProblem *problem; /* owner of the texts */
    int n_part;
    CzPartInfo *part; /* (n_part) */
};

/* ---- forces, strokes, energies ---- */

/* Numbers of one device or load path. */
typedef struct Load {
    double from, to, stroke, energy;
} Load;

static const Load no_load = {NAN, NAN, NAN, NAN};

static double sum(double a, double b) {
    return isnan(a) ? b : isnan(b) ? a : a + b;
}

static Load in_series(Load a, Load b) {
    return (Load){fmin(a.from, b.from), fmax(a.to, b.to), sum(a.stroke, b.stroke),
                  sum(a.energy, b.energy)};
}

static Load in_parallel(Load a, Load b) {
    Load both = in_series(a, b);
    both.stroke = fmax(a.stroke, b.stroke);
    return both;
}

static Load side_by_side(Load one, int count) {
    return (Load){count * one.from, count * one.to, one.stroke, count * one.energy};
}

static Load of_curve(const CzTable *curve) {
    const int last = curve->n_point - 1;
    Load load = {INFINITY, 0, curve->x[last], cz_work(curve->x, curve->y, 0, last)};
    for (int i = 0; i <= last; i++) {
        load.from = curve->y[i] > 0 ? fmin(load.from, curve->y[i]) : load.from;
        load.to = fmax(load.to, curve->y[i]);
    }
    return load;
}

/* Plateaus of a collapsing device, with its trigger peak, which falls to the first plateau. */
static Load of_device(CzDevice device, double trigger_length) {
    Load load = device.given && device.curve->given ? of_curve(device.curve) : no_load;
    if (!device.given)
        return no_load;
    for (int i = 0; i < device.n_stages && !device.curve->given; i++) {
        const CzStage *stage = &device.stages[i];
        const double end = isnan(stage->end_force) ? stage->force : stage->end_force;
        load = in_series(load, (Load){fmin(stage->force, end), fmax(stage->force, end),
                                      stage->stroke, stage->stroke * (stage->force + end) / 2});
    }
    if (!isnan(*device.trigger) && device.n_stages > 0) {
        load.to = fmax(load.to, *device.trigger);
        load.energy += (*device.trigger - device.stages[0].force) * trigger_length / 2;
    }
    return side_by_side(load, device.count);
}

/* Loading stages, which rise from the force before them; those of survival space do not count. */
static Load of_stages(const CzStage *stage, int n, double before) {
    Load load = no_load;
    for (int i = 0; i < n && stage[i].zone != CZ_ZONE_SURVIVAL; i++) {
        load = in_series(load, (Load){stage[i].force, stage[i].force, stage[i].stroke,
                                      stage[i].stroke * (before + stage[i].force) / 2});
        before = stage[i].force;
    }
    return load;
}

static Load of_tube(const CzTube *tube) {
    return of_device(CZ_DEVICE(tube), tube->trigger_length);
}

static Load of_buffer(const CzBuffer *buffer) {
    return buffer->given ? of_stages(buffer->stages, buffer->n_stages, buffer->preload) : no_load;
}

static Load of_coupler(const CzCoupler *coupler) {
    Load load = in_series(of_buffer(&coupler->buffer),
                          in_series(of_tube(&coupler->tube), of_tube(&coupler->second_tube)));
    if (coupler->shear_off.given)
        load.to = fmax(load.to, coupler->shear_off.force);
    return load;
}

static Load of_side_buffers(const CzSideBuffers *side) {
    return side_by_side(in_series(of_buffer(&side->buffer), of_tube(&side->tube)), side->count);
}

static Load of_end(const CzEnd *end) {
    const Load crush =
        end->curve.given ? of_curve(&end->curve) : of_stages(end->stages, end->n_stages, 0);
    Load load = in_parallel(crush, of_coupler(&end->coupler));
    load = in_parallel(load, of_side_buffers(&end->side_buffers));
    return in_parallel(load,
                       of_device(CZ_DEVICE(&end->anti_climber), end->anti_climber.trigger_length));
}

/* Numbers of a record by its type. */
static Load load_of(CzRecordId type, const void *memory) {
    const CzVehicle *vehicle = memory;
    const CzAntiClimber *climber = memory;
    const CzShearOff *shear = memory;
    const CzSlide *slide = memory;
    switch (type) {
    case CZ_RECORD_CzVehicle:
        return vehicle->front.given || vehicle->rear.given
                   ? of_end(vehicle->front.given ? &vehicle->front : &vehicle->rear)
                   : no_load;
    case CZ_RECORD_CzEnd:
        return of_end(memory);
    case CZ_RECORD_CzCoupler:
        return of_coupler(memory);
    case CZ_RECORD_CzAntiClimber:
        return of_device(CZ_DEVICE(climber), climber->trigger_length);
    case CZ_RECORD_CzSideBuffers:
        return of_side_buffers(memory);
    case CZ_RECORD_CzTube:
        return of_tube(memory);
    case CZ_RECORD_CzBuffer:
        return of_buffer(memory);
    case CZ_RECORD_CzShearOff:
        return (Load){shear->force, shear->force, NAN, NAN};
    case CZ_RECORD_CzSlide:
        return (Load){slide->force, slide->force, slide->length, slide->force * slide->length};
    default:
        return no_load;
    }
}

static double mass_of(CzRecordId type, const void *memory) {
    return type == CZ_RECORD_CzVehicle ? ((const CzVehicle *)memory)->mass
           : type == CZ_RECORD_CzEnd   ? ((const CzEnd *)memory)->mass
           : type == CZ_RECORD_CzBogie ? ((const CzBogie *)memory)->mass
           : type == CZ_RECORD_CzSlide ? ((const CzSlide *)memory)->mass
                                       : NAN;
}

/* ---- the kind of a part ---- */

/* The record inside another one under a key; CZ_N_RECORD when there is none. */
static CzRecordId record_under(const char *stem) {
    for (int i = 0; i < CZ_N_RECORD; i++) {
        const CzKey *key = cz_record_key(&cz_records[i], stem);
        if (key != NULL && key->kind == CZ_KEY_CHILD)
            return (CzRecordId)(key->child - cz_records);
    }
    return CZ_N_RECORD;
}

/* The record of a key under a node that uses a part; CZ_N_RECORD when there is none. */
static CzRecordId record_of_use(const CzNode *node, const char *part) {
    CzRecordId found = CZ_N_RECORD;
    for (int i = 0; node->kind != CZ_NODE_TEXT && i < node->n_entry && found == CZ_N_RECORD; i++) {
        const CzEntry *entry = &node->entry[i];
        const char *used = cz_node_find_text(entry->value, "use");
        if (entry->key != NULL && used != NULL && strcmp(used, part) == 0)
            found = record_under(entry->key->text);
        if (found == CZ_N_RECORD)
            found = record_of_use(entry->value, part);
    }
    return found;
}

/* Reads a part as a record; whether it has no mistake. A partial one may lack keys. */
static bool is_read(CzProblem *problem, CzRecordId type, const CzPart *part, bool is_partial,
                    void *memory) {
    CzBinder binder = cz_problem_binder(problem, &problem->tree);
    binder.is_partial = is_partial;
    CzMistakes *mistakes = &problem->reader.mistakes;
    const int n_before = mistakes->n_mistake, n_left_out = mistakes->n_left_out;
    memset(memory, 0, cz_records[type].size);
    cz_bind_record(binder, &cz_records[type], part->node, &cz_no_trail, memory);
    const bool is_clean = mistakes->n_mistake == n_before && mistakes->n_left_out == n_left_out;
    mistakes->n_mistake = n_before; /* of an attempt */
    mistakes->n_left_out = n_left_out;
    return is_clean;
}

/* Records of which parts are made, those with more required keys first. */
static const CzRecordId tried[] = {
    CZ_RECORD_CzVehicle,        CZ_RECORD_CzEnd,        CZ_RECORD_CzCoupler,
    CZ_RECORD_CzAntiClimber,    CZ_RECORD_CzBogie,      CZ_RECORD_CzSideBuffers,
    CZ_RECORD_CzSuperstructure, CZ_RECORD_CzSlide,      CZ_RECORD_CzTube,
    CZ_RECORD_CzBuffer,         CZ_RECORD_CzShearOff,   CZ_RECORD_CzHinge,
    CZ_RECORD_CzLink,           CZ_RECORD_CzSuspension, CZ_RECORD_CzDrawGear,
    CZ_RECORD_CzRoadbed,        CZ_RECORD_CzRail};
enum { N_TRIED = sizeof tried / sizeof *tried };

/* Reads a part as what it is; CZ_N_RECORD when it is none of the records. */
static CzRecordId read_part(CzProblem *problem, const CzPart *part, void *memory) {
    CzRecordId used = record_of_use(problem->tree.root, part->name);
    for (int i = 0; i < problem->tree.n_part && used == CZ_N_RECORD; i++)
        used = record_of_use(problem->tree.part[i].node, part->name);
    if (used != CZ_N_RECORD && is_read(problem, used, part, true, memory))
        return used;
    for (int is_partial = 0; is_partial < 2; is_partial++)
        for (int i = 0; i < N_TRIED; i++)
            if (is_read(problem, tried[i], part, is_partial != 0, memory))
                return tried[i];
    return CZ_N_RECORD;
}

static size_t largest_record(void) {
    size_t largest = 0;
    for (int i = 0; i < CZ_N_RECORD; i++)
        largest = cz_records[i].size > largest ? cz_records[i].size : largest;
    return largest;
}

static CzPartInfo describe(CzProblem *problem, const CzPart *part, void *memory) {
    CzPartInfo info = {.name = part->name,
                       .file = cz_problem_reported_name(problem, part->written->source->name),
                       .length = NAN};
    const CzRecordId type = read_part(problem, part, memory);
    const Load load = type != CZ_N_RECORD ? load_of(type, memory) : no_load;
    info.kind = type != CZ_N_RECORD ? cz_records[type].name : NULL;
    info.force_from = load.from;
    info.force_to = load.to;
    info.stroke = load.stroke;
    info.energy = load.energy;
    info.mass = type != CZ_N_RECORD ? mass_of(type, memory) : NAN;
    if (type == CZ_RECORD_CzVehicle)
        info.length = ((const CzVehicle *)memory)->length;
    return info;
}

/* ---- the parts of a file ---- */

/* Marks the parts that a node uses, and those that they use (n_part). */
static void mark_used(const CzTree *tree, const CzNode *node, bool *is_used) {
    for (int i = 0; node->kind != CZ_NODE_TEXT && i < node->n_entry; i++) {
        const CzNode *value = node->entry[i].value;
        const char *name = node->entry[i].key != NULL ? node->entry[i].key->text : "";
        const bool uses = strcmp(name, "use") == 0 && value->kind == CZ_NODE_TEXT;
        const CzPart *part = uses ? cz_tree_part(tree, value->text, strlen(value->text)) : NULL;
        mark_used(tree, value, is_used);
        if (part == NULL || is_used[part - tree->part])
            continue;
        is_used[part - tree->part] = true;
        mark_used(tree, part->node, is_used);
    }
}

static CzStatus list_parts(CzProblem *problem, const CzNode *top, CzInventory *inventory,
                           CzError *error) {
    const CzTree *tree = &problem->tree;
    CzArena *arena = &problem->reader.arena;
    bool *is_listed = cz_arena_allocate(arena, (size_t)tree->n_part + 1, sizeof *is_listed);
    void *memory = cz_arena_allocate(arena, 1, largest_record());
    inventory->part = cz_arena_allocate(arena, (size_t)tree->n_part + 1, sizeof *inventory->part);
    if (is_listed == NULL || memory == NULL || inventory->part == NULL)
        return cz_no_memory(error, "the parts");
    if (cz_node_find(tree->root, "trains") != NULL)
        mark_used(tree, tree->root, is_listed);
    else
        for (int i = 0; i < tree->n_part; i++)
            is_listed[i] = tree->part[i].written->source == top->source;
    for (int i = 0; i < tree->n_part; i++)
        if (is_listed[i])
            inventory->part[inventory->n_part++] = describe(problem, &tree->part[i], memory);
    return arena->out_of_memory ? cz_no_memory(error, "the parts") : CZ_OK;
}

CzStatus cz_inventory_read(const char *path, const CzProblemOptions *options,
                           CzInventory **inventory, CzError *error) {
    CzInventory *made = calloc(1, sizeof *made);
    CzProblem *problem = cz_problem_create(options != NULL ? options->share_folder : NULL);
    *inventory = NULL;
    if (made == NULL || problem == NULL) {
        free(made);
        cz_problem_free(problem);
        return cz_no_memory(error, path);
    }
    made->problem = problem;
    const CzNode *top = cz_load_file(&problem->reader, path, NULL);
    if (top != NULL)
        problem->tree = cz_load_tree(&problem->reader, top);
    cz_mistakes_finish(&problem->reader.mistakes);
    CzStatus status = cz_mistakes_status(&problem->reader.mistakes, path, error);
    if (status == CZ_OK && problem->tree.root != NULL)
        status = list_parts(problem, top, made, error);
    if (status == CZ_OK)
        *inventory = made;
    else
        cz_inventory_free(made);
    return status;
}

void cz_inventory_free(CzInventory *inventory) {
    if (inventory == NULL)
        return;
    cz_problem_free(inventory->problem);
    free(inventory);
}

int cz_inventory_n_part(const CzInventory *inventory) {
    return inventory->n_part;
}

const CzPartInfo *cz_inventory_part(const CzInventory *inventory, int index) {
    return &inventory->part[index];
}
