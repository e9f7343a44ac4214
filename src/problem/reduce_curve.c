/* Fewer points for a measured curve. */
#include "problem/reduce_curve.h"

#include <math.h>

static double area_under(const double *x, const double *y, const int *kept, int n_kept) {
    double area = 0;
    for (int i = 1; i < n_kept; i++)
        area += 0.5 * (y[kept[i]] + y[kept[i - 1]]) * (x[kept[i]] - x[kept[i - 1]]);
    return area;
}

static double triangle(const double *x, const double *y, int a, int b, int c) {
    return 0.5 * fabs((x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a]));
}

/* Removable points in a heap whose root changes the curve least; of equal ones the first is removed
 * first. */
typedef struct Heap {
    const double *x, *y;
    double *area;        /* of the triangle with the neighbours (n_point) */
    int *before, *after; /* neighbours that remain (n_point) */
    int *item, *place;   /* points in the heap (n), and the place of each in it (n_point) */
    int n;
} Heap;

static bool goes_first(const Heap *heap, int a, int b) {
    return heap->area[a] < heap->area[b] || (heap->area[a] == heap->area[b] && a < b);
}

static void put(Heap *heap, int at, int point) {
    heap->item[at] = point;
    heap->place[point] = at;
}

/* Moves the point at a place up or down to restore the heap. */
static void settle(Heap *heap, int at) {
    const int point = heap->item[at];
    for (; at > 0 && goes_first(heap, point, heap->item[(at - 1) / 2]); at = (at - 1) / 2)
        put(heap, at, heap->item[(at - 1) / 2]);
    for (;;) {
        int next = 2 * at + 1;
        if (next + 1 < heap->n && goes_first(heap, heap->item[next + 1], heap->item[next]))
            next++;
        if (next >= heap->n || !goes_first(heap, heap->item[next], point))
            break;
        put(heap, at, heap->item[next]);
        at = next;
    }
    put(heap, at, point);
}

static void measure(Heap *heap, int point) {
    heap->area[point] = triangle(heap->x, heap->y, heap->before[point], point, heap->after[point]);
}

/* The peak and the ends are not in the heap. */
static void fill(Heap *heap, int n_point, int peak) {
    for (int i = 0; i < n_point; i++) {
        heap->before[i] = i - 1;
        heap->after[i] = i + 1;
        heap->place[i] = -1;
        if (i == 0 || i == n_point - 1 || i == peak)
            continue;
        measure(heap, i);
        put(heap, heap->n++, i);
        settle(heap, heap->n - 1);
    }
}

static void drop_one(Heap *heap) {
    const int point = heap->item[0], before = heap->before[point], after = heap->after[point];
    heap->n--;
    if (heap->n > 0) {
        put(heap, 0, heap->item[heap->n]);
        settle(heap, 0);
    }
    heap->after[before] = after;
    heap->before[after] = before;
    const int neighbour[] = {before, after};
    for (int i = 0; i < 2; i++)
        if (heap->place[neighbour[i]] >= 0) {
            measure(heap, neighbour[i]);
            settle(heap, heap->place[neighbour[i]]);
        }
}

/* Lists the points that stay; false without memory. */
static bool choose(CzArena *arena, const double *x, const double *y, int n_point, int n_most,
                   int peak, int *kept) {
    const size_t n = (size_t)n_point;
    Heap heap = {.x = x, .y = y, .area = cz_arena_allocate(arena, n, sizeof(double))};
    int **const rows[] = {&heap.before, &heap.after, &heap.item, &heap.place};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        *rows[i] = cz_arena_allocate(arena, n, sizeof(int));
    if (heap.area == NULL || heap.before == NULL || heap.after == NULL || heap.item == NULL ||
        heap.place == NULL)
        return false;
    fill(&heap, n_point, peak);
    for (int left = n_point; left > n_most; left--)
        drop_one(&heap);
    for (int i = 0, k = 0; i < n_point; i = heap.after[i])
        kept[k++] = i;
    return true;
}

/* Factor on the kept points other than the ends and the peak that restores the area. */
static double scale_for(const double *x, const double *y, int peak, const int *kept, int n_kept,
                        double wanted) {
    double movable = 0;
    for (int i = 1; i < n_kept - 1; i++)
        if (kept[i] != peak)
            movable += 0.5 * y[kept[i]] * (x[kept[i + 1]] - x[kept[i - 1]]);
    const double lost = wanted - area_under(x, y, kept, n_kept);
    return movable > 0 && movable + lost > 0 ? (movable + lost) / movable : 1;
}

/* Largest difference between the reduced, scaled curve and the full one, at the points of the
 * latter. */
static double largest_difference(const double *x, const double *y, int peak, const int *kept,
                                 int n_kept, double scale) {
    double largest = 0;
    for (int i = 1; i < n_kept; i++) {
        const int a = kept[i - 1], b = kept[i];
        const double y_a = i - 1 == 0 || a == peak ? y[a] : y[a] * scale;
        const double y_b = i == n_kept - 1 || b == peak ? y[b] : y[b] * scale;
        for (int k = a; k <= b; k++) {
            const double share = (x[k] - x[a]) / (x[b] - x[a]);
            largest = fmax(largest, fabs(y_a + share * (y_b - y_a) - y[k]));
        }
    }
    return largest;
}

bool cz_reduce_curve(CzArena *arena, double *x, double *y, int *n_point, int n_most,
                     CzCurveChange *change) {
    int *kept = cz_arena_allocate(arena, (size_t)*n_point, sizeof *kept);
    int n_kept = *n_point, peak = 0;
    if (kept == NULL)
        return false;
    for (int i = 0; i < n_kept; i++) {
        kept[i] = i;
        peak = y[i] > y[peak] ? i : peak;
    }
    *change = (CzCurveChange){.area = area_under(x, y, kept, n_kept)};
    if (n_kept <= n_most)
        return true;
    if (!choose(arena, x, y, n_kept, n_most, peak, kept))
        return false;
    n_kept = n_most;
    const double scale = scale_for(x, y, peak, kept, n_kept, change->area);
    change->largest_difference = largest_difference(x, y, peak, kept, n_kept, scale);
    for (int i = 0; i < n_kept; i++) {
        const bool is_fixed = i == 0 || i == n_kept - 1 || kept[i] == peak;
        x[i] = x[kept[i]];
        y[i] = is_fixed ? y[kept[i]] : y[kept[i]] * scale;
    }
    *n_point = n_kept;
    return true;
}
