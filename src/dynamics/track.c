/* Sets up and reads the modal track; its steps are in track_motion.h. */
#include "dynamics/track.h"

#include "dynamics/track_energy.h"

#include <string.h>

/* ---- rows of modes ---- */

static void put(CzComplex value, int i, CzTrackRow re, CzTrackRow im) {
    re[i] = value.re;
    im[i] = value.im;
}

/* g of the wave that carries a mode: the direct one, but of the free sine its alias. */
static CzComplex carrier(const CzTrackGroup *group, int i) {
    return cz_complex_square_size(group->direct[i]) > 0.0 ? group->direct[i] : group->alias[i];
}

static bool is_mode(const CzTrackGroup *group, int i) {
    return cz_complex_square_size(carrier(group, i)) > 0.0;
}

/* The group that holds the sine of wave n_seat / 2, in the last place of the last vector; NULL
 * where it is cut off. */
static const CzTrackGroup *free_sine(const CzTrackModes *modes) {
    for (int k = 0; k < modes->n_group; ++k) {
        const CzTrackGroup *group = &modes->group[k];
        if (group->copy == 1 && group->vector == modes->n_vector - 1 &&
            is_mode(group, CZ_TRACK_WIDTH - 1))
            return group;
    }
    return NULL;
}

/* The groups of the cosine copy, which come first, and the free sine as an alias in the first group
 * of the last vector with a place for it, or in one more. Returns their number; `row`, unless NULL,
 * has space for one more than the cosine copy. */
static int gather_rows(const CzTrackModes *modes, CzTrackGroup *row) {
    const int last = CZ_TRACK_WIDTH - 1;
    const CzTrackGroup *free_wave = free_sine(modes);
    bool is_placed = free_wave == NULL;
    int n = 0;
    for (int k = 0; k < modes->n_group && modes->group[k].copy == 0; ++k) {
        const CzTrackGroup *group = &modes->group[k];
        const bool takes =
            !is_placed && group->vector == modes->n_vector - 1 && !is_mode(group, last);
        if (row != NULL)
            row[n] = *group;
        if (row != NULL && takes) {
            row[n].lambda[last] = free_wave->lambda[last];
            row[n].alias[last] = free_wave->direct[last];
        }
        is_placed = is_placed || takes;
        ++n;
    }
    if (!is_placed && row != NULL) {
        row[n] = (CzTrackGroup){.vector = modes->n_vector - 1};
        row[n].lambda[last] = free_wave->lambda[last];
        row[n].alias[last] = free_wave->direct[last];
    }
    return is_placed ? n : n + 1;
}

/* Turn of a mode from its state to half a step ago. */
static CzComplex back_of(CzComplex lambda, double step) {
    return cz_complex_exponential(cz_complex_scaled(-0.5 * step, lambda));
}

/* Y per deflections now and half a step ago, z and z' = Re(back Y): with back = b + i c,
 * Y = z + i (b z - z') / c. A mode without oscillation has Y = z. */
typedef struct Recovery {
    CzComplex now, past;
} Recovery;

static Recovery recovery_of(CzComplex back) {
    if (back.im == 0.0)
        return (Recovery){.now = {1.0, 0.0}};
    return (Recovery){.now = {1.0, back.re / back.im}, .past = {0.0, -1.0 / back.im}};
}

static void add_row(const CzTrackGroup *group, int i, double step, CzTrackRows *rows) {
    const CzComplex lambda = group->lambda[i], own = carrier(group, i);
    const CzComplex half = cz_complex_exponential(cz_complex_scaled(0.5 * step, lambda));
    const CzComplex back = back_of(lambda, step);
    const bool turns = lambda.im != 0.0;
    rows->twice[i] = turns ? 2.0 * half.re : half.re;
    rows->square[i] = turns ? cz_complex_square_size(half) : 0.0;

    const CzComplex kick = cz_complex_product(cz_track_kick(lambda, step), own);
    const CzComplex direct = cz_complex_product(kick, group->direct[i]);
    const CzComplex alias = cz_complex_product(kick, group->alias[i]);
    rows->kick[i] = direct.re;
    rows->past_kick[i] = cz_complex_product(back, direct).re;
    rows->alias_kick[i] = alias.re;
    rows->alias_past_kick[i] = cz_complex_product(back, alias).re;

    const Recovery of = recovery_of(back);
    const CzComplex ratio = cz_complex_ratio(group->alias[i], own);
    rows->alias[i] = cz_complex_product(ratio, of.now).re;
    rows->alias_past[i] = cz_complex_product(ratio, of.past).re;
}

/* From y to the state and back; on a track for a step of 0 they are the same. */
static void add_state(const CzTrackGroup *group, int i, double step, CzTrackAmplitudes *of) {
    CzComplex now = {1.0, 0.0}, past = {0.0, 1.0}, to_now = {1.0, 0.0}, to_past = {0.0, -1.0};
    if (step > 0.0) {
        const CzComplex back = back_of(group->lambda[i], step);
        const Recovery whole = recovery_of(back);
        to_now = carrier(group, i);
        to_past = cz_complex_product(back, to_now);
        const CzComplex per_g = cz_complex_ratio(back, to_now);
        now = cz_complex_product(per_g, whole.now);
        past = cz_complex_product(per_g, whole.past);
    }
    put(now, i, of->now_re, of->now_im);
    put(past, i, of->past_re, of->past_im);
    put(to_now, i, of->to_now_re, of->to_now_im);
    put(to_past, i, of->to_past_re, of->to_past_im);
}

static void add_parts(const CzTrackBlock *block, const CzTrackGroup *group, int i,
                      CzTrackAmplitudes *amplitudes) {
    const CzSeats *seats = block->seats;
    const CzComplex lambda = group->lambda[i], pad = group->pad[i];
    CzTrackRow *re = amplitudes->part_re, *im = amplitudes->part_im;
    put(carrier(group, i), i, re[CZ_RAIL_WAVE], im[CZ_RAIL_WAVE]);
    if (cz_complex_square_size(pad) == 0.0)
        return;
    for (int w = 1; w < block->n_wave; ++w)
        put(cz_complex_scaled(-block->crests,
                              cz_complex_product(cz_track_wave_answer(block, w, lambda), pad)),
            i, re[CZ_RAIL_WAVE + w], im[CZ_RAIL_WAVE + w]);
    const CzTrackBelow below = cz_track_below(block, lambda);
    const CzComplex stiffness = {seats->pad_k + seats->pad_c * lambda.re, seats->pad_c * lambda.im};
    put(pad, i, re[CZ_PAD_FORCE], im[CZ_PAD_FORCE]);
    put(cz_complex_ratio(pad, stiffness), i, re[CZ_PAD_STRETCH], im[CZ_PAD_STRETCH]);
    put(cz_complex_product(below.sleeper, pad), i, re[CZ_SLEEPER], im[CZ_SLEEPER]);
    put(cz_complex_product(below.ballast, pad), i, re[CZ_BALLAST], im[CZ_BALLAST]);
}

static void add_amplitudes(const CzTrackMotion *track, const CzTrackBlock *block,
                           const CzTrackGroup *group, int i, CzTrackAmplitudes *amplitudes) {
    const CzComplex rest = cz_track_constant_answer(group->lambda[i], track->step);
    put(rest, i, amplitudes->rest_re, amplitudes->rest_im);
    put(group->lambda[i], i, amplitudes->lambda_re, amplitudes->lambda_im);
    put(group->direct[i], i, amplitudes->direct_re, amplitudes->direct_im);
    put(group->alias[i], i, amplitudes->alias_re, amplitudes->alias_im);
    add_state(group, i, track->step, amplitudes);
    add_parts(&block[group->vector * CZ_TRACK_WIDTH + i], group, i, amplitudes);
}

/* Numbers of all modes of the blocks; false when there is no memory. */
static bool fill_rows(CzTrackMotion *track, const CzTrackBlock *block, CzArena *arena) {
    const CzTrackModes *modes = track->modes;
    const size_t n_row = (size_t)gather_rows(modes, NULL);
    CzTrackGroup *group = cz_arena_allocate(arena, n_row, sizeof *group);
    CzTrackRows *rows = cz_arena_allocate(arena, n_row, sizeof *rows);
    CzTrackAmplitudes *amplitudes = cz_arena_allocate(arena, n_row, sizeof *amplitudes);
    CzTrackSpan *span = cz_arena_allocate(arena, (size_t)modes->n_vector, sizeof *span);
    if (arena->out_of_memory)
        return false;
    track->n_row = gather_rows(modes, group);
    for (int k = 0; k < track->n_row; ++k) {
        CzTrackSpan *own = &span[group[k].vector];
        own->first = own->end == 0 ? k : own->first;
        own->end = k + 1;
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i)
            if (is_mode(&group[k], i)) {
                add_row(&group[k], i, track->step, &rows[k]);
                add_amplitudes(track, block, &group[k], i, &amplitudes[k]);
            }
    }
    track->rows = rows;
    track->amplitudes = amplitudes;
    track->span = span;
    return true;
}

static void add_weights(const CzTrackBlock *block, int i, CzTrackWeights *weights) {
    const CzSeats *seats = block->seats;
    const double half_turn = 2.0 * cz_turned(0.5 * block->turns).im,
                 coupled = half_turn * half_turn;
    const double half = 0.5 * block->crests;
    for (int w = 0; w < block->n_wave; ++w) {
        weights->rate[CZ_RAIL_WAVE + w][i] = 0.5 * block->mass[w] / block->wave[w].share;
        weights->value[CZ_RAIL_WAVE + w][i] =
            weights->rate[CZ_RAIL_WAVE + w][i] * block->wave[w].bending;
    }
    weights->value[CZ_PAD_STRETCH][i] = half * seats->pad_k;
    weights->value[CZ_PAD_FORCE][i] = half * block->rest;
    weights->rate[CZ_SLEEPER][i] = half * seats->sleeper;
    weights->rate[CZ_BALLAST][i] = half * seats->ballast;
    weights->value[CZ_BALLAST][i] = half * (seats->lower_k + coupled * seats->across_k);
    weights->upper[i] = half * seats->upper_k;
    weights->pad_loss[i] = block->crests * seats->pad_c;
    weights->upper_loss[i] = block->crests * seats->upper_c;
    weights->ballast_loss[i] = block->crests * (seats->lower_c + coupled * seats->across_c);
}

static void fill_waves(const CzTrackModes *modes, CzTrackRow *wavenumber, CzTrackRow *inner) {
    for (int v = 0; v < modes->n_vector; ++v)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            const int j = v * CZ_TRACK_WIDTH + i;
            wavenumber[2 * v][i] = 2.0 * CZ_PI * j / modes->length;
            wavenumber[2 * v + 1][i] = 2.0 * CZ_PI * (j - modes->n_seat) / modes->length;
            inner[v][i] = 2 * j == modes->n_seat ? 0.0 : 1.0;
        }
}

CzTrackMotion *cz_track_motion_create(const CzTrackModes *modes, double step, size_t n_under,
                                      CzArena *arena) {
    const size_t n_block = (size_t)modes->n_seat / 2 + 1, n_vector = (size_t)modes->n_vector;
    CzTrackMotion *track = cz_arena_allocate(arena, 1, sizeof *track);
    CzTrackRow *wavenumber = cz_arena_allocate(arena, 2 * n_vector, sizeof *wavenumber);
    CzTrackRow *inner = cz_arena_allocate(arena, n_vector, sizeof *inner);
    CzTrackBlock *block = cz_arena_allocate(arena, n_block, sizeof *block);
    CzTrackWeights *weights = cz_arena_allocate(arena, n_vector, sizeof *weights);
    CzTrackUnder *under = cz_arena_allocate(arena, n_under, sizeof *under);
    if (arena->out_of_memory)
        return NULL;
    for (size_t j = 0; j < n_block; ++j) {
        block[j] = cz_track_block(&modes->seats, modes->n_seat, (int)j);
        add_weights(&block[j], (int)j % CZ_TRACK_WIDTH, &weights[j / CZ_TRACK_WIDTH]);
    }
    fill_waves(modes, wavenumber, inner);
    const int last = modes->n_vector - 1;
    *track = (CzTrackMotion){.modes = modes,
                             .step = step,
                             .per_length = 1.0 / modes->length,
                             .per_spacing = 1.0 / modes->seats.spacing,
                             .first_alias = modes->first_alias < last ? modes->first_alias : last,
                             .wavenumber = (const CzTrackRow *)wavenumber,
                             .inner = (const CzTrackRow *)inner,
                             .weights = weights,
                             .flexibility = cz_track_flexibility(modes, step),
                             .n_under = n_under,
                             .under = under};
    return fill_rows(track, block, arena) ? track : NULL;
}

/* ---- one car ---- */

/* Adds the waves of one copy of a row of modes with the complex amplitudes y. */
static void add_waves(const CzTrackAmplitudes *of, int copy, const double *restrict re,
                      const double *restrict im, CzTrackShape *wave) {
    double *restrict direct = wave->of[copy], *restrict alias = wave->of[CZ_ALIAS_COSINE + copy];
    CZ_WAVES(i) {
        direct[i] += of->direct_re[i] * re[i] - of->direct_im[i] * im[i];
        alias[i] += of->alias_re[i] * re[i] - of->alias_im[i] * im[i];
    }
}

/* Lays one copy of a row of modes at rest under constant loads of its waves. */
static void rest_row(const CzTrackMotion *track, const CzTrackUnder *under,
                     const CzTrackShape *load, int row, int copy, CzTrackWave *wave) {
    const CzTrackAmplitudes *restrict of = &track->amplitudes[row];
    double *restrict now = under->state[row].now[copy];
    double *restrict past = under->state[row].past[copy];
    CzTrackRow load_re, load_im, re, im, past_re, past_im;
    cz_track_load_row(track, load, row, copy, load_re, load_im);
    CZ_WAVES(i) {
        re[i] = of->rest_re[i] * load_re[i] - of->rest_im[i] * load_im[i];
        im[i] = of->rest_re[i] * load_im[i] + of->rest_im[i] * load_re[i];
        now[i] = of->to_now_re[i] * re[i] - of->to_now_im[i] * im[i];
        past[i] = of->to_past_re[i] * re[i] - of->to_past_im[i] * im[i];
    }
    cz_track_past_row(of, &under->state[row], copy, past_re, past_im);
    add_waves(of, copy, re, im, &wave->now);
    add_waves(of, copy, past_re, past_im, &wave->past);
}

/* The modes at rest under constant forces of the wheels. */
static void rest_under(const CzTrackMotion *track, const CzTrackUnder *under) {
    for (int v = 0; v < track->modes->n_vector; ++v) {
        CzTrackShape load = {0};
        cz_track_load(&under->shape[4 * v], under->force, cz_track_is_aliased(track, v), &load);
        memset(&under->wave[v], 0, sizeof under->wave[v]);
        for (int row = track->span[v].first; row < track->span[v].end; ++row)
            for (int copy = 0; copy < 2; ++copy)
                rest_row(track, under, &load, row, copy, &under->wave[v]);
    }
}

/* Turns of the wheels of one car, the first of eight. */
static void turn_one(const CzTrackMotion *track, const double place[4], CzTrackTurns *turns) {
    CzTrackRow of[4] = {{0.0}};
    for (int wheel = 0; wheel < 4; ++wheel)
        of[wheel][0] = place[wheel];
    cz_track_turn(track, (const CzTrackRow *)of, turns);
}

bool cz_track_lay(CzTrackMotion *track, size_t index, const double place[4], const double load[4],
                  CzArena *arena) {
    CzTrackUnder *under = &track->under[index];
    const size_t n_row = (size_t)track->n_row, n_vector = (size_t)track->modes->n_vector;
    if (under->state == NULL) {
        under->state = cz_arena_allocate(arena, n_row, sizeof *under->state);
        under->wave = cz_arena_allocate(arena, n_vector, sizeof *under->wave);
        under->shape = cz_arena_allocate(arena, 4 * n_vector, sizeof *under->shape);
    }
    if (under->state == NULL || under->wave == NULL || under->shape == NULL)
        return false;
    CzTrackTurns turns;
    turn_one(track, place, &turns);
    for (int wheel = 0; wheel < 4; ++wheel) {
        cz_track_move_wheel(track, under, &turns, 0, wheel);
        under->force[wheel] = -load[wheel];
    }
    rest_under(track, under);
    return true;
}

void cz_track_deflection(const CzTrackMotion *track, size_t index, const double place[4],
                         double deflection[4], double flexibility[4]) {
    CzTrackTurns turns;
    turn_one(track, place, &turns);
    for (int wheel = 0; wheel < 4; ++wheel) {
        deflection[wheel] = cz_track_move_wheel(track, &track->under[index], &turns, 0, wheel).z;
        flexibility[wheel] = cz_track_flexibility_at(&track->flexibility, turns.seat_re[wheel][0]);
    }
}

/* ---- for a solver of ordinary differential equations ---- */

size_t cz_track_n_state(const CzTrackModes *modes) {
    return (size_t)gather_rows(modes, NULL) * sizeof(CzTrackState) / sizeof(double);
}

void cz_track_get_state(const CzTrackMotion *track, size_t index, double *state) {
    memcpy(state, track->under[index].state, (size_t)track->n_row * sizeof(CzTrackState));
}

void cz_track_set_state(CzTrackMotion *track, size_t index, const double *state) {
    const CzTrackUnder *under = &track->under[index];
    memcpy(under->state, state, (size_t)track->n_row * sizeof(CzTrackState));
    for (int v = 0; v < track->modes->n_vector; ++v) {
        CzTrackShape *wave = &under->wave[v].now;
        memset(wave, 0, sizeof *wave);
        for (int row = track->span[v].first; row < track->span[v].end; ++row)
            for (int copy = 0; copy < 2; ++copy)
                add_waves(&track->amplitudes[row], copy, under->state[row].now[copy],
                          under->state[row].past[copy], wave);
    }
}

/* Rates of one copy of a row of modes under the load of its waves; adds the rates of the waves. */
static void rate_copy(const CzTrackMotion *track, const CzTrackShape *load, int row, int copy,
                      const CzTrackState *state, CzTrackState *rate, CzTrackShape *rising) {
    const CzTrackAmplitudes *restrict of = &track->amplitudes[row];
    const double *restrict re = state->now[copy], *restrict im = state->past[copy];
    double *restrict rate_re = rate->now[copy], *restrict rate_im = rate->past[copy];
    CzTrackRow load_re, load_im;
    cz_track_load_row(track, load, row, copy, load_re, load_im);
    CZ_WAVES(i) {
        rate_re[i] = of->lambda_re[i] * re[i] - of->lambda_im[i] * im[i] + load_re[i];
        rate_im[i] = of->lambda_re[i] * im[i] + of->lambda_im[i] * re[i] + load_im[i];
    }
    add_waves(of, copy, rate_re, rate_im, rising);
}

void cz_track_rate(CzTrackMotion *track, size_t index, const double force[4], double *rate,
                   double rail_rate[4]) {
    CzTrackUnder *under = &track->under[index];
    memcpy(under->force, force, sizeof under->force);
    memset(rail_rate, 0, 4 * sizeof *rail_rate);
    for (int v = 0; v < track->modes->n_vector; ++v) {
        CzTrackShape load = {0}, rising = {0};
        cz_track_load(&under->shape[4 * v], force, cz_track_is_aliased(track, v), &load);
        for (int row = track->span[v].first; row < track->span[v].end; ++row) {
            CzTrackState of_row;
            for (int copy = 0; copy < 2; ++copy)
                rate_copy(track, &load, row, copy, &under->state[row], &of_row, &rising);
            memcpy((char *)rate + (size_t)row * sizeof of_row, &of_row, sizeof of_row);
        }
        for (int wheel = 0; wheel < 4; ++wheel)
            for (int k = 0; k < (cz_track_is_aliased(track, v) ? CZ_N_SHAPE : CZ_ALIAS_COSINE);
                 ++k) {
                CzTrackRow moved;
                CZ_WAVES(i) {
                    moved[i] = under->shape[4 * v + wheel].of[k][i] * rising.of[k][i];
                }
                rail_rate[wheel] += cz_track_sum(moved);
            }
    }
}
