/* Smooth response surfaces: fit and values. */
#include "optimise/response.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Details that are below the largest one by more than this in all designs do not count (ours). */
static const double no_matter = 0.8;

/* Largest number of points: more than these are too distant to say anything about the base. */
static int most_points(int n) {
    return 60 + 8 * n;
}

bool cz_response_create(CzResponse *response, const CzSurface *surface) {
    const int n = surface->n, most = most_points(n);
    const size_t size = (size_t)(most + 1 + n), n_value = (size_t)surface->m + 1;
    *response = (CzResponse){.surface = surface, .n = n, .most = most};
    CzArena *arena = &response->arena;
    response->point = cz_arena_numbers(arena, (size_t)(most * n));
    response->base = cz_arena_numbers(arena, (size_t)n);
    response->detail = cz_arena_allocate(arena, n_value, sizeof *response->detail);
    response->weight = cz_arena_numbers(arena, size * n_value);
    response->matrix = cz_arena_numbers(arena, size * size);
    response->nearness = cz_arena_numbers(arena, size * (size_t)(n + 1));
    response->value = cz_arena_numbers(arena, n_value + (size_t)n);
    response->record = cz_arena_allocate(arena, (size_t)most + 1, sizeof *response->record);
    response->distance = cz_arena_numbers(arena, (size_t)most + 1);
    return !arena->out_of_memory;
}

void cz_response_free(CzResponse *response) {
    cz_arena_free(&response->arena);
}

static double distance_between(const double *a, const double *b, int n) {
    double square = 0;
    for (int i = 0; i < n; i++)
        square += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(square);
}

/* Inserts a record among the nearest ones; `u` is its design. */
static void insert(CzResponse *response, long record, const double *u) {
    const int n = response->n;
    const double distance = distance_between(u, response->base, n);
    for (int p = 0; p < response->n_point; p++)
        if (fabs(response->distance[p] - distance) < 1e-6 &&
            distance_between(u, response->point + p * n, n) < 1e-6)
            return;
    if (response->n_point == response->most &&
        distance >= response->distance[response->n_point - 1])
        return;
    int at = response->n_point < response->most ? response->n_point++ : response->n_point - 1;
    for (; at > 0 && response->distance[at - 1] > distance; at--) {
        response->distance[at] = response->distance[at - 1];
        response->record[at] = response->record[at - 1];
        memcpy(response->point + at * n, response->point + (at - 1) * n, (size_t)n * sizeof *u);
    }
    response->distance[at] = distance;
    response->record[at] = record;
    memcpy(response->point + at * n, u, (size_t)n * sizeof *u);
}

static void choose_points(CzResponse *response) {
    const CzSearch *search = response->surface->search;
    double *u = response->value; /* has room for it */
    response->n_point = 0;
    for (long record = search->n_record - 1; record >= 0; record--) {
        if (isnan(search->record[record].objective))
            continue;
        cz_search_scale(search, cz_search_x(search, record), u);
        insert(response, record, u);
    }
}

/* Lists the details that may be violated or the largest near the base. */
static void choose_details(CzResponse *response) {
    const CzSurface *surface = response->surface;
    const CzSearch *search = surface->search;
    double least = 0; /* of the largest details */
    response->n_value = 0;
    response->detail[response->n_value++] = -1;
    for (int p = 0; p < response->n_point && search->function->is_minimax; p++) {
        const double *c = cz_search_detail(search, response->record[p]);
        double largest = -INFINITY;
        for (int k = 0; k < surface->m; k++)
            if (!isnan(c[k]))
                largest = cz_surface_counted(largest, surface, k, c[k]);
        least = fmin(least, largest);
    }
    for (int k = 0; k < surface->m; k++) {
        double largest = -INFINITY;
        for (int p = 0; p < response->n_point; p++)
            largest = fmax(largest, cz_search_detail(search, response->record[p])[k]);
        if (largest > least - no_matter)
            response->detail[response->n_value++] = k;
    }
}

/* Value of a detail at a point; that of the nearest point which has one where it is not known. */
static double detail_at(const CzResponse *response, int p, int k) {
    const CzSearch *search = response->surface->search;
    const double c = cz_search_detail(search, response->record[p])[k];
    if (!isnan(c))
        return cz_search_compressed(c);
    for (int q = 0; q < response->n_point; q++) {
        const double other = cz_search_detail(search, response->record[q])[k];
        if (!isnan(other))
            return fmin(other, -0.05);
    }
    return -0.05;
}

/* The equations of the weights. Tiny diagonals, of the order of their rounding, keep them solvable
 * where variables are fixed. */
static void fill_matrix(CzResponse *response) {
    const double tiny = 1e-9;
    const int n = response->n, n_point = response->n_point, size = n_point + 1 + n;
    memset(response->matrix, 0, (size_t)size * (size_t)size * sizeof *response->matrix);
    for (int p = 0; p < n_point; p++) {
        double *row = response->matrix + p * size;
        for (int q = 0; q < n_point; q++) {
            const double r = distance_between(response->point + p * n, response->point + q * n, n);
            row[q] = r * r * r;
        }
        row[p] = tiny;
        for (int j = 0; j <= n; j++) {
            const double term = j == 0 ? 1 : response->point[p * n + j - 1] - response->base[j - 1];
            row[n_point + j] = term;
            response->matrix[(n_point + j) * size + p] = term;
        }
    }
    for (int j = 1; j <= n; j++)
        response->matrix[(n_point + j) * size + n_point + j] = -tiny;
}

/* The values at the points, in the place of the weights. */
static void fill_values(CzResponse *response) {
    const CzSearch *search = response->surface->search;
    for (int p = 0; p < response->n_point + 1 + response->n; p++)
        for (int v = 0; v < response->n_value; v++) {
            const int k = response->detail[v];
            response->weight[p * response->n_value + v] =
                p >= response->n_point ? 0
                : k < 0                ? search->record[response->record[p]].objective
                                       : detail_at(response, p, k);
        }
}

static void exchange_rows(double *matrix, int n, int one, int other) {
    for (int j = 0; j < n && one != other; j++) {
        const double kept = matrix[one * n + j];
        matrix[one * n + j] = matrix[other * n + j];
        matrix[other * n + j] = kept;
    }
}

/* Subtracts a multiple of row `from` from row `to`, from column `first` on. */
static void subtract_row(double *matrix, int n, int to, int from, double factor, int first) {
    for (int j = first; j < n && factor != 0; j++)
        matrix[to * n + j] -= factor * matrix[from * n + j];
}

/* Solves the equations in place by elimination with row pivots. False when they are singular. */
static bool solve(double *matrix, int size, double *right, int n_right) {
    for (int i = 0; i < size; i++) {
        int pivot = i;
        for (int r = i + 1; r < size; r++)
            if (fabs(matrix[r * size + i]) > fabs(matrix[pivot * size + i]))
                pivot = r;
        if (!(fabs(matrix[pivot * size + i]) > 1e-13))
            return false;
        exchange_rows(matrix, size, i, pivot);
        exchange_rows(right, n_right, i, pivot);
        for (int r = i + 1; r < size; r++) {
            const double factor = matrix[r * size + i] / matrix[i * size + i];
            subtract_row(matrix, size, r, i, factor, i);
            subtract_row(right, n_right, r, i, factor, 0);
        }
    }
    for (int i = size - 1; i >= 0; i--) {
        for (int r = i + 1; r < size; r++)
            subtract_row(right, n_right, i, r, matrix[i * size + r], 0);
        for (int j = 0; j < n_right; j++)
            right[i * n_right + j] /= matrix[i * size + i];
    }
    return true;
}

bool cz_response_fit(CzResponse *response, const double *base, double reach) {
    memcpy(response->base, base, (size_t)response->n * sizeof *base);
    choose_points(response);
    while (response->n_point > response->n + 1 && response->distance[response->n_point - 1] > reach)
        response->n_point--;
    if (response->n_point < 2)
        return false;
    choose_details(response);
    fill_matrix(response);
    fill_values(response);
    return solve(response->matrix, response->n_point + 1 + response->n, response->weight,
                 response->n_value);
}

/* Terms of the values at u, and their slopes. */
static void set_terms(const CzResponse *response, const double *u, bool values_only) {
    const int n = response->n, n_point = response->n_point, size = n_point + 1 + n;
    double *term = response->nearness;
    for (int p = 0; p < n_point; p++) {
        const double *point = response->point + p * n;
        const double r = distance_between(u, point, n);
        term[p] = r * r * r;
        for (int i = 0; i < n && !values_only; i++)
            term[(i + 1) * size + p] = 3 * r * (u[i] - point[i]);
    }
    for (int j = 0; j <= n; j++) {
        term[n_point + j] = j == 0 ? 1 : u[j - 1] - response->base[j - 1];
        for (int i = 0; i < n && !values_only; i++)
            term[(i + 1) * size + n_point + j] = j == i + 1;
    }
}

static void sum_terms(const CzResponse *response, int row) {
    const int size = response->n_point + 1 + response->n, n_value = response->n_value;
    const double *term = response->nearness + row * size;
    memset(response->value, 0, (size_t)n_value * sizeof *response->value);
    for (int p = 0; p < size; p++)
        for (int v = 0; v < n_value; v++)
            response->value[v] += term[p] * response->weight[p * n_value + v];
}

void cz_response_linearise(const CzResponse *response, const double *u, bool values_only,
                           CzSurface *surface) {
    const int n = response->n, m = surface->m;
    set_terms(response, u, values_only);
    memcpy(surface->u, u, (size_t)n * sizeof *u);
    for (int k = 0; k < m; k++)
        surface->c[k] = -2;
    sum_terms(response, 0);
    surface->f = response->value[0];
    for (int v = 1; v < response->n_value; v++)
        surface->c[response->detail[v]] = cz_search_expanded(response->value[v]);
    if (values_only)
        return;
    memset(surface->dc, 0, (size_t)(m * n) * sizeof *surface->dc);
    for (int i = 0; i < n; i++) {
        sum_terms(response, i + 1);
        surface->df[i] = response->value[0];
        for (int v = 1; v < response->n_value; v++) {
            const int k = response->detail[v];
            surface->dc[k * n + i] = response->value[v] / cz_search_compressed_slope(surface->c[k]);
        }
    }
}
