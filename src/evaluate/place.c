/* Places at which a metric may be read, and the selectors that pick them. */
#include "evaluate/place.h"

#include <stdio.h>
#include <string.h>

static void find_element(const CzRunSummary *run, const char *where, CzWhere *found) {
    for (int i = 0; i < run->n_interface; i++)
        for (int k = 0; k < run->interface[i].n_element; k++) {
            const CzElementResult *element = &run->interface[i].element[k];
            const bool is_larger =
                found->element == NULL || element->peak_force > found->element->peak_force;
            if (strcmp(element->name, where) != 0 || !is_larger)
                continue;
            found->element = element;
            found->interface[0] = i;
        }
}

CzWhere cz_where_find(const CzRunSummary *run, const char *where) {
    CzWhere found = {.vehicle = -1, .interface = {-1, -1}};
    for (int i = 0; i < run->n_interface; i++)
        if (cz_where_begins(where, run->interface[i].name))
            found.interface[0] = i;
    if (found.interface[0] < 0)
        find_element(run, where, &found);
    if (found.interface[0] >= 0 || (found.vehicle = cz_where_vehicle(run, where)) < 0)
        return found;
    const char *end = where + strlen(run->vehicle[found.vehicle].name);
    const int ahead = found.vehicle < run->n_interface ? found.vehicle : -1;
    const bool is_front = strcmp(end, " front") == 0, is_whole = *end == '\0';
    found.interface[0] = is_front ? ahead : found.vehicle - 1;
    found.interface[1] = is_whole ? ahead : -1;
    if (found.interface[0] < 0) {
        found.interface[0] = found.interface[1];
        found.interface[1] = -1;
    }
    return found;
}

bool cz_matches(const char *pattern, const char *text) {
    const char *star = NULL, *resume = NULL;
    while (*text != '\0') {
        if (*pattern == '*') {
            star = pattern++;
            resume = text;
        } else if (*pattern == '?' || *pattern == *text) {
            pattern++;
            text++;
        } else if (star != NULL) {
            pattern = star + 1;
            text = ++resume;
        } else {
            return false;
        }
    }
    while (*pattern == '*')
        pattern++;
    return *pattern == '\0';
}

/* Whether a selector picks an interface: by name, or as `colliding` or `inner`. */
static bool picks_interface(const char *selector, const char *name, bool is_colliding) {
    return cz_matches(selector, name) || (is_colliding && strcmp(selector, "colliding") == 0) ||
           (!is_colliding && strcmp(selector, "inner") == 0);
}

/* Whether a selector picks an element: by its name, or by interface and name. */
static bool picks_element(const char *selector, const char *interface, const char *element,
                          bool is_colliding) {
    if (cz_matches(selector, element))
        return true;
    const char *alias = is_colliding ? "colliding " : "inner ";
    const size_t n = strlen(alias);
    if (strncmp(selector, alias, n) == 0)
        return cz_matches(selector + n, element);
    char name[CZ_INTERFACE_SIZE + CZ_WHERE_SIZE];
    snprintf(name, sizeof name, "%s %s", interface, element);
    return cz_matches(selector, name);
}

static const char *vehicle_name(const CzVehicle *vehicle) {
    return vehicle->name != NULL ? vehicle->name : "";
}

/* An iteration over places. */
typedef struct Walk {
    const CzSubject *subject;
    CzLevel level;
    const char *selector;
    CzPlaceVisitor visit;
    void *data;
    CzPlace place;
} Walk;

static void call(Walk *walk, const char *name) {
    const size_t most = sizeof walk->place.name - 1; /* longer names are cut */
    const size_t n = strlen(name) < most ? strlen(name) : most;
    memcpy(walk->place.name, name, n);
    walk->place.name[n] = '\0';
    walk->visit(&walk->place, walk->data);
}

/* The same at a place of a vehicle, with the design's values. */
static void call_of(Walk *walk, const CzVehicle *record, const char *name) {
    walk->place.record = record;
    walk->place.must_declare = record->model == CZ_MODEL_FULL;
    call(walk, name);
}

/* The record of a vehicle of the scene with the design's values. */
static const CzVehicle *record_of(const CzSubject *subject, int vehicle) {
    return &subject->vehicles[subject->scene->record[vehicle]];
}

static bool has_wildcard(const char *selector) {
    return strpbrk(selector, "*?") != NULL;
}

/* Whether a vehicle of the scene is skipped: an obstacle is not judged unless it is named. */
static bool is_passed_over(const Walk *walk, int vehicle) {
    return has_wildcard(walk->selector) && cz_scene_has_obstacle_at(walk->subject->scene, vehicle);
}

static void visit_vehicles(Walk *walk) {
    const CzRunSummary *run = walk->subject->run;
    for (int i = 0; i < run->n_vehicle; i++) {
        const CzVehicle *record = record_of(walk->subject, i);
        if (record->model == CZ_MODEL_FIXED || is_passed_over(walk, i) ||
            !cz_matches(walk->selector, run->vehicle[i].name))
            continue;
        walk->place.vehicle = &run->vehicle[i];
        call_of(walk, record, run->vehicle[i].name);
    }
}

static void visit_elements(Walk *walk, bool is_colliding) {
    const CzInterfaceResult *interface = walk->place.interface;
    for (int i = 0; i < interface->n_element; i++) {
        const CzElementResult *element = &interface->element[i];
        if (is_passed_over(walk, element->vehicle) ||
            !picks_element(walk->selector, interface->name, element->name, is_colliding))
            continue;
        const CzVehicle *record = record_of(walk->subject, element->vehicle);
        walk->place.element = element;
        walk->place.end =
            element->vehicle == walk->place.interface_index ? &record->front : &record->rear;
        call_of(walk, record, element->name);
    }
}

/* The crush zone of a vehicle at an interface; NULL without one. */
static const CzElementResult *end_of(const CzInterfaceResult *interface, int vehicle) {
    for (int i = 0; i < interface->n_element; i++)
        if (interface->element[i].kind == CZ_ELEMENT_END &&
            interface->element[i].vehicle == vehicle)
            return &interface->element[i];
    return NULL;
}

/* A section is named by its interface, which an obstacle shares with the train. */
static void visit_sections(Walk *walk, bool is_colliding) {
    const CzInterfaceResult *interface = walk->place.interface;
    if (!picks_interface(walk->selector, interface->name, is_colliding))
        return;
    for (int side = 0; side < 2; side++) {
        const int vehicle = walk->place.interface_index + side;
        const CzVehicle *record = record_of(walk->subject, vehicle);
        if (record->model == CZ_MODEL_FIXED ||
            cz_scene_has_obstacle_at(walk->subject->scene, vehicle))
            continue;
        walk->place.end = side == 0 ? &record->front : &record->rear;
        walk->place.section_force = interface->section_force[side];
        walk->place.element = end_of(interface, vehicle);
        char name[CZ_WHERE_SIZE];
        snprintf(name, sizeof name, "%s %s", walk->subject->run->vehicle[vehicle].name,
                 side == 0 ? "front" : "rear");
        call_of(walk, record, name);
    }
}

/* Whether an interface of the scene is skipped: one between vehicles of an obstacle is not judged
 * unless it is named. */
static bool is_within_obstacle(const Walk *walk, int interface, const char *name) {
    const CzScene *scene = walk->subject->scene;
    return cz_scene_has_obstacle_at(scene, interface) &&
           cz_scene_has_obstacle_at(scene, interface + 1) && strcmp(walk->selector, name) != 0;
}

static void visit_interfaces(Walk *walk) {
    const CzRunSummary *run = walk->subject->run;
    for (int i = 0; i < run->n_interface; i++) {
        const bool is_colliding = i == walk->subject->scene->colliding;
        walk->place.interface = &run->interface[i];
        walk->place.interface_index = i;
        if (walk->level == CZ_LEVEL_ELEMENT) {
            visit_elements(walk, is_colliding);
        } else if (walk->level == CZ_LEVEL_SECTION) {
            visit_sections(walk, is_colliding);
        } else if (picks_interface(walk->selector, run->interface[i].name, is_colliding) &&
                   !is_within_obstacle(walk, i, run->interface[i].name)) {
            walk->place.must_declare = record_of(walk->subject, i)->model == CZ_MODEL_FULL ||
                                       record_of(walk->subject, i + 1)->model == CZ_MODEL_FULL;
            call(walk, run->interface[i].name);
        }
    }
}

static void visit_ends(Walk *walk) {
    const CzSubject *subject = walk->subject;
    for (int i = 0; i < 2 * subject->n_vehicle; i++) {
        const CzVehicle *record = &subject->vehicles[i / 2];
        const CzEnd *end = i % 2 == 0 ? &record->rear : &record->front;
        char name[CZ_WHERE_SIZE];
        snprintf(name, sizeof name, "%s %s", vehicle_name(record), i % 2 == 0 ? "rear" : "front");
        const bool is_passed_over = subject->is_obstacle != NULL && subject->is_obstacle[i / 2] &&
                                    has_wildcard(walk->selector);
        if (!end->given || record->model == CZ_MODEL_FIXED || is_passed_over ||
            !cz_matches(walk->selector, name))
            continue;
        walk->place.end = end;
        call_of(walk, record, name);
    }
}

static bool any_vehicle_is_full(const CzSubject *subject) {
    for (int i = 0; i < subject->n_vehicle; i++)
        if (subject->vehicles[i].model == CZ_MODEL_FULL)
            return true;
    return false;
}

void cz_places_visit(const CzSubject *subject, CzLevel level, const char *selector,
                     CzPlaceVisitor visit, void *data) {
    Walk walk = {.subject = subject,
                 .level = level,
                 .selector = selector,
                 .visit = visit,
                 .data = data,
                 .place = {.scene = subject->scene, .run = subject->run, .rate = subject->rate}};
    walk.place.problem = subject->problem;
    walk.place.vehicles = subject->vehicles;
    if (level == CZ_LEVEL_RUN) {
        walk.place.must_declare = any_vehicle_is_full(subject);
        call(&walk, "");
    } else if (level == CZ_LEVEL_DESIGN) {
        walk.place.record = subject->vehicles;
        walk.place.n_record = subject->n_first_train;
        call(&walk, "");
    } else if (level == CZ_LEVEL_VEHICLE) {
        visit_vehicles(&walk);
    } else if (level == CZ_LEVEL_END) {
        visit_ends(&walk);
    } else {
        visit_interfaces(&walk);
    }
}

/* Number of elements of one end, as written, that a selector picks. */
static int count_elements(const CzEnd *end, const char *vehicle, const char *interface,
                          const char *selector, bool is_colliding) {
    const bool has[CZ_N_ELEMENT_KIND] = {[CZ_ELEMENT_COUPLER] = end->coupler.given,
                                         [CZ_ELEMENT_ANTI_CLIMBER] = end->anti_climber.given,
                                         [CZ_ELEMENT_END] = end->given,
                                         [CZ_ELEMENT_SIDE_BUFFERS] = end->side_buffers.given,
                                         [CZ_ELEMENT_SUPERSTRUCTURE] = end->superstructure.given,
                                         [CZ_ELEMENT_DRAW_GEAR] = end->draw_gear.given,
                                         [CZ_ELEMENT_SLIDE] = end->slide.given};
    int n = 0;
    for (int kind = 0; kind < CZ_N_ELEMENT_KIND; kind++) {
        char name[CZ_WHERE_SIZE];
        snprintf(name, sizeof name, "%s %s", cz_element_text((CzElementKind)kind), vehicle);
        n += has[kind] && picks_element(selector, interface, name, is_colliding);
    }
    return n;
}

int cz_places_count(const CzScene *scene, CzLevel level, const char *selector) {
    if (level == CZ_LEVEL_RUN || level == CZ_LEVEL_DESIGN)
        return 1;
    int n = 0;
    if (level == CZ_LEVEL_VEHICLE) {
        for (int i = 0; i < scene->n_vehicle; i++)
            n += cz_matches(selector, vehicle_name(scene->vehicle[i]));
        return n;
    }
    for (int i = 0; i + 1 < scene->n_vehicle; i++) {
        const CzVehicle *behind = scene->vehicle[i], *ahead = scene->vehicle[i + 1];
        const bool is_colliding = i == scene->colliding;
        char name[CZ_WHERE_SIZE];
        snprintf(name, sizeof name, "%s-%s", vehicle_name(behind), vehicle_name(ahead));
        if (level == CZ_LEVEL_ELEMENT) {
            n += count_elements(&behind->front, vehicle_name(behind), name, selector, is_colliding);
            n += count_elements(&ahead->rear, vehicle_name(ahead), name, selector, is_colliding);
        } else if (level == CZ_LEVEL_END) {
            n += 1; /* selectors of ends are checked with the design */
        } else {
            n +=
                picks_interface(selector, name, is_colliding) * (level == CZ_LEVEL_SECTION ? 2 : 1);
        }
    }
    return n;
}
