/* Steps of the force ladder that are out of order, in the trains as written.
 *
 * Each step is a ratio of two forces (devices.h); above 1 the device behind yields before the one
 * in front of it. Published designs differ, so these are warnings and no checks.
 */
#include <stdio.h>
#include <string.h>

#include "evaluate/devices.h"
#include "evaluate/evaluator_parts.h"

typedef struct Order {
    double rate; /* of crushing [m/s] */
    CzForceStep *step;
    int n, most;
} Order;

/* Adds a step that is out of order, unless it was found at a like end. */
static void add(Order *order, const char *what, double ratio, const CzVehicle *vehicle,
                bool is_front) {
    if (!(ratio > 1.0))
        return;
    for (int i = 0; i < order->n; i++)
        if (strcmp(order->step[i].what, what) == 0 && order->step[i].ratio == ratio)
            return;
    if (order->n == order->most)
        return;
    CzForceStep *step = &order->step[order->n++];
    *step = (CzForceStep){.what = what, .ratio = ratio};
    snprintf(step->where, sizeof step->where, "%s %s", vehicle->name, is_front ? "front" : "rear");
}

static void look_at_end(Order *order, const CzVehicle *vehicle, bool is_front) {
    const CzEnd *end = is_front ? &vehicle->front : &vehicle->rear;
    const double rate = order->rate;
    if (!end->given)
        return;
    add(order, "the end of the buffer over the start of its tube", cz_buffer_over_tube(end),
        vehicle, is_front);
    add(order, "the tube over the shear-off", cz_tube_over_shear_off(end, rate), vehicle, is_front);
    add(order, "the shear-off over the proof strength", cz_shear_off_over_strength(end), vehicle,
        is_front);
    add(order, "the anti-climbers over the crush zone behind them",
        cz_anti_climber_over_end(end, rate), vehicle, is_front);
    add(order, "the crush zone over the proof strength", cz_end_over_strength(end), vehicle,
        is_front);
}

static double tube_force(const CzEnd *end) {
    return cz_crushing_force(end, CZ_ELEMENT_COUPLER, 0.0);
}

/* The tubes between the cars of the moving train should begin after those of its front. */
static void look_at_train(Order *order, const CzScene *scene) {
    const CzVehicle *const *vehicle = scene->vehicle;
    const double front = tube_force(&vehicle[scene->colliding]->front);
    if (scene->is_obstacle[0] || front == 0.0)
        return;
    for (int i = 0; i <= scene->colliding; i++) {
        const double rear = i > 0 ? tube_force(&vehicle[i]->rear) : 0.0;
        const double ahead = i < scene->colliding ? tube_force(&vehicle[i]->front) : 0.0;
        if (rear > 0.0)
            add(order, "the tube of the front over this one", front / rear, vehicle[i], false);
        if (ahead > 0.0)
            add(order, "the tube of the front over this one", front / ahead, vehicle[i], true);
    }
}

int cz_evaluator_force_order(const CzEvaluator *evaluator, int most, CzForceStep *step) {
    Order order = {.rate = evaluator->rate[0], .step = step, .most = most};
    for (int s = 0; s < evaluator->n_scene; s++) {
        const CzScene *scene = &evaluator->scene[s];
        for (int i = 0; i < scene->n_vehicle; i++) {
            if (cz_scene_has_obstacle_at(scene, i))
                continue;
            look_at_end(&order, scene->vehicle[i], false);
            look_at_end(&order, scene->vehicle[i], true);
        }
        look_at_train(&order, scene);
    }
    return order.n;
}
