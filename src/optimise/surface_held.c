/* Details that are held because no variable lowers them. */
#include "optimise/surface_held.h"

#include <math.h>

/* Change of a margin over the range of a variable below which the variable does not matter, and by
 * which a margin may still grow when it is capped (ours). */
static const double least_change = 1e-3;

/* The largest detail that counts, -1 when none does. */
static int find_largest(const CzSurface *surface) {
    int largest = -1;
    for (int k = 0; k < surface->m; k++)
        if (cz_surface_counts(surface, k) && (largest < 0 || surface->c[k] > surface->c[largest]))
            largest = k;
    return largest;
}

/* The most that the variables which are not frozen could lower a detail within their bounds. */
static double reach_of(const CzSurface *surface, int k) {
    double reach = 0;
    for (int i = 0; i < surface->n; i++) {
        const double slope = surface->dc[k * surface->n + i];
        if (!surface->is_frozen[i])
            reach += slope > 0 ? slope * surface->u[i] : -slope * (1 - surface->u[i]);
    }
    return reach;
}

static bool is_capped(const CzSurface *surface, int k) {
    return k >= 0 && reach_of(surface, k) < least_change;
}

bool cz_surface_is_capped(const CzSurface *surface) {
    const CzSearch *search = surface->search;
    const CzFunction *function = search->function;
    const int largest = find_largest(surface);
    if (!function->is_minimax || surface->record < 0 || largest < 0 ||
        cz_detail_kind(function, largest) != CZ_DETAIL_OF_DESIGN)
        return false;
    const CzRecord *base = &search->record[surface->record];
    return base->penalty <= 0 && base->objective <= search->record[search->best].objective &&
           is_capped(surface, largest);
}

static void freeze_variables_of(CzSurface *surface, int k) {
    for (int i = 0; i < surface->n; i++)
        if (!surface->is_frozen[i] && fabs(surface->dc[k * surface->n + i]) > least_change) {
            surface->is_frozen[i] = true;
            surface->frozen_at[i] = surface->u[i];
        }
}

bool cz_surface_hold_capped(CzSurface *surface) {
    bool is_free = false;
    const int before = surface->n_held;
    for (int k; is_capped(surface, k = find_largest(surface)); surface->n_held++) {
        surface->is_held[k] = true;
        freeze_variables_of(surface, k);
    }
    for (int i = 0; i < surface->n; i++)
        is_free |= !surface->is_frozen[i];
    return surface->n_held > before && is_free && find_largest(surface) >= 0;
}
