/* Sets up and reads the modal track; its steps are in track_motion.h. */
#include "dynamics/track.h"

#include <string.h>

/* ---- constants of a step ---- */

static void put(CzComplex value, int i, CzTrackRow re, CzTrackRow im) {
    re[i] = value.re;
    im[i] = value.im;
}

static bool is_mode(const CzTrackGroup *group, int i) {
    return cz_complex_square_size(group->direct[i]) > 0.0;
}

static CzTrackRows rows_of(const CzTrackGroup *group, double step) {
    CzTrackRows rows;
    memset(&rows, 0, sizeof rows);
    for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
        if (!is_mode(group, i))
            continue;
        const CzComplex lambda = group->lambda[i];
        const CzComplex flight = cz_complex_exponential(cz_complex_scaled(step, lambda));
        const CzComplex kick = cz_track_kick(lambda, step);
        const CzComplex back = cz_complex_exponential(cz_complex_scaled(-0.5 * step, lambda));
        const CzComplex direct = group->direct[i], alias = group->alias[i];
        put(flight, i, rows.flight_re, rows.flight_im);
        put(cz_complex_product(kick, direct), i, rows.kick_re, rows.kick_im);
        put(cz_complex_product(kick, alias), i, rows.alias_kick_re, rows.alias_kick_im);
        put(direct, i, rows.now_re, rows.now_im);
        put(alias, i, rows.alias_now_re, rows.alias_now_im);
        put(cz_complex_product(back, direct), i, rows.past_re, rows.past_im);
        put(cz_complex_product(back, alias), i, rows.alias_past_re, rows.alias_past_im);
    }
    return rows;
}

static void add_amplitudes(const CzTrackBlock *block, const CzTrackGroup *group, int i, double step,
                           CzTrackAmplitudes *amplitudes) {
    const CzSeats *seats = block->seats;
    const CzComplex lambda = group->lambda[i], pad = group->pad[i];
    CzTrackRow *re = amplitudes->part_re, *im = amplitudes->part_im;
    put(lambda, i, amplitudes->lambda_re, amplitudes->lambda_im);
    put(cz_complex_exponential(cz_complex_scaled(-0.5 * step, lambda)), i, amplitudes->back_re,
        amplitudes->back_im);
    put(group->direct[i], i, re[CZ_RAIL_WAVE], im[CZ_RAIL_WAVE]);
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

/* Blocks and their modes' amplitudes; false when there is no memory. */
static bool prepare_energy(CzTrackMotion *track, CzArena *arena) {
    const CzTrackModes *modes = track->modes;
    const size_t n_block = (size_t)modes->n_seat / 2 + 1;
    CzTrackBlock *block = cz_arena_allocate(arena, n_block, sizeof *block);
    CzTrackAmplitudes *amplitudes =
        cz_arena_allocate(arena, (size_t)modes->n_group, sizeof *amplitudes);
    if (block == NULL || amplitudes == NULL)
        return false;
    for (size_t j = 0; j < n_block; ++j)
        block[j] = cz_track_block(&modes->seats, modes->n_seat, (int)j);
    for (int k = 0; k < modes->n_group; ++k)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i)
            if (is_mode(&modes->group[k], i))
                add_amplitudes(&block[modes->group[k].vector * CZ_TRACK_WIDTH + i],
                               &modes->group[k], i, track->step, &amplitudes[k]);
    track->block = block;
    track->amplitudes = amplitudes;
    return true;
}

static void fill_spans(const CzTrackModes *modes, CzTrackSpan *span) {
    for (int k = 0; k < modes->n_group; ++k) {
        const CzTrackGroup *group = &modes->group[k];
        CzTrackSpan *own = &span[group->copy * modes->n_vector + group->vector];
        own->first = own->end == 0 ? k : own->first;
        own->end = k + 1;
    }
}

static void fill_wavenumbers(const CzTrackModes *modes, CzTrackRow *wavenumber) {
    for (int v = 0; v < modes->n_vector; ++v)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            const int j = v * CZ_TRACK_WIDTH + i;
            wavenumber[2 * v][i] = 2.0 * CZ_PI * j / modes->length;
            wavenumber[2 * v + 1][i] = 2.0 * CZ_PI * (j - modes->n_seat) / modes->length;
        }
}

CzTrackMotion *cz_track_motion_create(const CzTrackModes *modes, double step, size_t n_under,
                                      CzArena *arena) {
    CzTrackMotion *track = cz_arena_allocate(arena, 1, sizeof *track);
    CzTrackRows *rows = cz_arena_allocate(arena, (size_t)modes->n_group, sizeof *rows);
    CzTrackSpan *span = cz_arena_allocate(arena, 2 * (size_t)modes->n_vector, sizeof *span);
    CzTrackRow *wavenumber =
        cz_arena_allocate(arena, 2 * (size_t)modes->n_vector, sizeof *wavenumber);
    CzTrackUnder *under = cz_arena_allocate(arena, n_under, sizeof *under);
    if (track == NULL || rows == NULL || span == NULL || wavenumber == NULL || under == NULL)
        return NULL;
    for (int k = 0; k < modes->n_group; ++k)
        rows[k] = rows_of(&modes->group[k], step);
    fill_spans(modes, span);
    fill_wavenumbers(modes, wavenumber);
    *track = (CzTrackMotion){.modes = modes,
                             .step = step,
                             .per_length = 1.0 / modes->length,
                             .per_spacing = 1.0 / modes->seats.spacing,
                             .rows = rows,
                             .span = span,
                             .wavenumber = (const CzTrackRow *)wavenumber,
                             .flexibility = cz_track_flexibility(modes, step),
                             .n_under = n_under,
                             .under = under};
    return prepare_energy(track, arena) ? track : NULL;
}

/* ---- one car ---- */

/* Load of the modes of a group: sum of g(x) P over the wheels, at the places of the shapes. */
static void load_group(const CzTrackMotion *track, const CzTrackUnder *under, int k,
                       double *restrict re, double *restrict im) {
    const CzTrackGroup *group = &track->modes->group[k];
    const CzTrackRows *restrict rows = &track->rows[k];
    CZ_WAVES(i) {
        re[i] = im[i] = 0.0;
    }
    for (int wheel = 0; wheel < 4; ++wheel) {
        const CzTrackRow *shape =
            under->shape + 4 * (wheel * track->modes->n_vector + group->vector);
        const double *restrict direct = shape[group->copy], *restrict alias =
                                                                shape[2 + group->copy];
        const double force = under->force[wheel];
        CZ_WAVES(i) {
            re[i] += force * (direct[i] * rows->now_re[i] + alias[i] * rows->alias_now_re[i]);
            im[i] += force * (direct[i] * rows->now_im[i] + alias[i] * rows->alias_now_im[i]);
        }
    }
}

/* States of the modes under constant forces of the wheels. */
static void rest_under(const CzTrackMotion *track, const CzTrackUnder *under) {
    const CzTrackModes *modes = track->modes;
    for (int k = 0; k < modes->n_group; ++k) {
        CzTrackRow re, im;
        load_group(track, under, k, re, im);
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            CzComplex y = {0.0, 0.0};
            if (is_mode(&modes->group[k], i))
                y = cz_complex_product(
                    (CzComplex){re[i], im[i]},
                    cz_track_constant_answer(modes->group[k].lambda[i], track->step));
            put(y, i, under->state[2 * k], under->state[2 * k + 1]);
        }
    }
}

bool cz_track_lay(CzTrackMotion *track, size_t index, const double place[4], const double load[4],
                  CzArena *arena) {
    const CzTrackModes *modes = track->modes;
    CzTrackUnder *under = &track->under[index];
    const size_t n_vector = (size_t)modes->n_vector;
    if (under->state == NULL) {
        under->state = cz_arena_allocate(arena, 2 * (size_t)modes->n_group, sizeof *under->state);
        under->wave = cz_arena_allocate(arena, 8 * n_vector, sizeof *under->wave);
        under->shape = cz_arena_allocate(arena, 16 * n_vector, sizeof *under->shape);
    }
    if (under->state == NULL || under->wave == NULL || under->shape == NULL)
        return false;
    CzComplex seat[4];
    cz_track_shapes(track, place, under->shape, seat);
    for (int wheel = 0; wheel < 4; ++wheel)
        under->force[wheel] = -load[wheel];
    rest_under(track, under);
    cz_track_read(track, under);
    return true;
}

void cz_track_deflection(const CzTrackMotion *track, size_t index, const double place[4],
                         double deflection[4], double flexibility[4]) {
    CzComplex seat[4];
    cz_track_shapes(track, place, track->under[index].shape, seat);
    for (int wheel = 0; wheel < 4; ++wheel) {
        deflection[wheel] = cz_track_at(track, &track->under[index], wheel).z;
        flexibility[wheel] = cz_track_flexibility_at(&track->flexibility, seat[wheel].re);
    }
}

/* ---- energy ---- */

/* Displacement and rate of each part of eight neighbouring blocks at its crest. */
typedef struct Parts {
    CzTrackRow value[CZ_TRACK_PARTS], rate[CZ_TRACK_PARTS];
} Parts;

/* Adds the modes of a group half a step ago, at the end of the last force: their state then, and
 * its rate with that force still acting. */
static void add_group(const CzTrackMotion *track, const CzTrackUnder *under, int k, Parts *parts) {
    const CzTrackAmplitudes *restrict of = &track->amplitudes[k];
    const double *restrict re = under->state[2 * k], *restrict im = under->state[2 * k + 1];
    CzTrackRow y_re, y_im, rate_re, rate_im, load_re, load_im;
    load_group(track, under, k, load_re, load_im);
    CZ_WAVES(i) {
        y_re[i] = of->back_re[i] * re[i] - of->back_im[i] * im[i];
        y_im[i] = of->back_re[i] * im[i] + of->back_im[i] * re[i];
        rate_re[i] = of->lambda_re[i] * y_re[i] - of->lambda_im[i] * y_im[i] + load_re[i];
        rate_im[i] = of->lambda_re[i] * y_im[i] + of->lambda_im[i] * y_re[i] + load_im[i];
    }
    for (int part = 0; part < CZ_TRACK_PARTS; ++part) {
        const double *restrict a_re = of->part_re[part], *restrict a_im = of->part_im[part];
        double *restrict value = parts->value[part], *restrict rate = parts->rate[part];
        CZ_WAVES(i) {
            value[i] += a_re[i] * y_re[i] - a_im[i] * y_im[i];
            rate[i] += a_re[i] * rate_re[i] - a_im[i] * rate_im[i];
        }
    }
}

static double square(double value) {
    return value * value;
}

static void parts_energy(const CzTrackBlock *block, const Parts *parts, int i, double *energy,
                         double *loss) {
    const CzSeats *seats = block->seats;
    const double coupled = square(2.0 * cz_turned(0.5 * block->turns).im);
    const CzTrackRow *value = parts->value, *rate = parts->rate;
    for (int w = 0; w < block->n_wave; ++w)
        *energy += 0.5 * block->mass[w] / block->wave[w].share *
                   (square(rate[CZ_RAIL_WAVE + w][i]) +
                    block->wave[w].bending * square(value[CZ_RAIL_WAVE + w][i]));
    const double upper = value[CZ_SLEEPER][i] - value[CZ_BALLAST][i];
    const double upper_rate = rate[CZ_SLEEPER][i] - rate[CZ_BALLAST][i];
    *energy += 0.5 * block->crests *
               (seats->pad_k * square(value[CZ_PAD_STRETCH][i]) +
                block->rest * square(value[CZ_PAD_FORCE][i]) +
                seats->sleeper * square(rate[CZ_SLEEPER][i]) + seats->upper_k * square(upper) +
                seats->ballast * square(rate[CZ_BALLAST][i]) +
                (seats->lower_k + coupled * seats->across_k) * square(value[CZ_BALLAST][i]));
    *loss += block->crests *
             (seats->pad_c * square(rate[CZ_PAD_STRETCH][i]) + seats->upper_c * square(upper_rate) +
              (seats->lower_c + coupled * seats->across_c) * square(rate[CZ_BALLAST][i]));
}

static void add_up(const CzTrackMotion *track, size_t index, double *energy, double *loss) {
    const CzTrackModes *modes = track->modes;
    for (int row = 0; row < 2 * modes->n_vector; ++row) {
        const int first = row % modes->n_vector * CZ_TRACK_WIDTH;
        Parts parts;
        memset(&parts, 0, sizeof parts);
        for (int k = track->span[row].first; k < track->span[row].end; ++k)
            add_group(track, &track->under[index], k, &parts);
        for (int i = 0; i < CZ_TRACK_WIDTH && 2 * (first + i) <= modes->n_seat; ++i)
            parts_energy(&track->block[first + i], &parts, i, energy, loss);
    }
}

double cz_track_energy(const CzTrackMotion *track, size_t index) {
    double energy = 0.0, loss = 0.0;
    add_up(track, index, &energy, &loss);
    return energy;
}

double cz_track_loss(const CzTrackMotion *track, size_t index) {
    double energy = 0.0, loss = 0.0;
    add_up(track, index, &energy, &loss);
    return loss;
}

/* ---- for a solver of ordinary differential equations ---- */

size_t cz_track_n_state(const CzTrackModes *modes) {
    return (size_t)modes->n_group * 2 * CZ_TRACK_WIDTH;
}

void cz_track_get_state(const CzTrackMotion *track, size_t index, double *state) {
    memcpy(state, track->under[index].state, cz_track_n_state(track->modes) * sizeof *state);
}

void cz_track_set_state(CzTrackMotion *track, size_t index, const double *state) {
    memcpy(track->under[index].state, state, cz_track_n_state(track->modes) * sizeof *state);
    cz_track_read(track, &track->under[index]);
}

/* Rates of one group of modes under the load of its row of waves; the rate of the rail is added to
 * the waves. */
static void rate_of_group(const CzTrackGroup *group, const CzTrackRows *rows, bool aliased,
                          const double *restrict re, const double *restrict im,
                          double *restrict rate_re, double *restrict rate_im, CzTrackWaves *waves) {
    CZ_WAVES(i) {
        const CzComplex lambda = group->lambda[i];
        rate_re[i] = lambda.re * re[i] - lambda.im * im[i] + rows->now_re[i] * waves->load[i];
        rate_im[i] = lambda.re * im[i] + lambda.im * re[i] + rows->now_im[i] * waves->load[i];
    }
    if (aliased)
        CZ_WAVES(i) {
            rate_re[i] += rows->alias_now_re[i] * waves->alias_load[i];
            rate_im[i] += rows->alias_now_im[i] * waves->alias_load[i];
        }
    cz_track_add_displacement(rows, rate_re, rate_im, aliased, waves);
}

/* Rate of the rail at the wheels by a row of waves. */
static void add_rail_rate(const CzTrackMotion *track, const CzTrackUnder *under, int copy, int v,
                          bool aliased, const CzTrackWaves *waves, double rail_rate[4]) {
    for (int wheel = 0; wheel < 4; ++wheel) {
        const CzTrackRow *shape = under->shape + 4 * (wheel * track->modes->n_vector + v);
        CzTrackRow moved;
        CZ_WAVES(i) {
            moved[i] = shape[copy][i] * waves->direct[i];
        }
        if (aliased)
            CZ_WAVES(i) {
                moved[i] += shape[2 + copy][i] * waves->alias[i];
            }
        rail_rate[wheel] += cz_track_sum(moved);
    }
}

void cz_track_rate(CzTrackMotion *track, size_t index, const double force[4], double *rate,
                   double rail_rate[4]) {
    const CzTrackModes *modes = track->modes;
    CzTrackUnder *under = &track->under[index];
    memcpy(under->force, force, sizeof under->force);
    memset(rail_rate, 0, 4 * sizeof *rail_rate);
    for (int copy = 0; copy < 2; ++copy)
        for (int v = 0; v < modes->n_vector; ++v) {
            const CzTrackSpan span = track->span[copy * modes->n_vector + v];
            const bool aliased = v >= modes->first_alias;
            CzTrackWaves waves;
            cz_track_no_waves(&waves);
            cz_track_load(track, under, copy, v, force, aliased, &waves);
            for (int k = span.first; k < span.end; ++k) {
                double *own = rate + 2 * k * CZ_TRACK_WIDTH;
                rate_of_group(&modes->group[k], &track->rows[k], aliased, under->state[2 * k],
                              under->state[2 * k + 1], own, own + CZ_TRACK_WIDTH, &waves);
            }
            add_rail_rate(track, under, copy, v, aliased, &waves, rail_rate);
        }
}
