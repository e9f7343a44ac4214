/* Setting up and looking at the modal track; its steps are in track_motion.h. */
#include "dynamics/track.h"

#include <string.h>

#include "dynamics/track_motion.h"
#include "model/track_block.h"

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

static CzTrackAmplitudes amplitudes_of(const CzTrackBlock *block, const CzTrackGroup *group, int i,
                                       double step) {
    const CzSeats *seats = block->seats;
    const CzComplex lambda = group->lambda[i], pad = group->pad[i];
    CzTrackAmplitudes amplitudes;
    memset(&amplitudes, 0, sizeof amplitudes);
    amplitudes.back = cz_complex_exponential(cz_complex_scaled(-0.5 * step, lambda));
    amplitudes.wave[0] = group->direct[i];
    if (cz_complex_square_size(pad) == 0.0)
        return amplitudes;
    for (int w = 1; w < block->n_wave; ++w)
        amplitudes.wave[w] = cz_complex_scaled(
            -block->crests, cz_complex_product(cz_track_wave_answer(block, w, lambda), pad));
    const CzTrackBelow below = cz_track_below(block, lambda);
    const CzComplex stiffness = {seats->pad_k + seats->pad_c * lambda.re, seats->pad_c * lambda.im};
    amplitudes.force = pad;
    amplitudes.stretch = cz_complex_ratio(pad, stiffness);
    amplitudes.sleeper = cz_complex_product(below.sleeper, pad);
    amplitudes.ballast = cz_complex_product(below.ballast, pad);
    return amplitudes;
}

/* Blocks and their modes' amplitudes; false when there is no memory. */
static bool prepare_energy(CzTrackMotion *track, CzArena *arena) {
    const CzTrackModes *modes = track->modes;
    const size_t n_block = (size_t)modes->n_seat / 2 + 1;
    CzTrackBlock *block = cz_arena_allocate(arena, n_block, sizeof *block);
    CzTrackAmplitudes *amplitudes =
        cz_arena_allocate(arena, (size_t)modes->n_group * CZ_TRACK_WIDTH, sizeof *amplitudes);
    if (block == NULL || amplitudes == NULL)
        return false;
    for (size_t j = 0; j < n_block; ++j)
        block[j] = cz_track_block(&modes->seats, modes->n_seat, (int)j);
    for (int k = 0; k < modes->n_group; ++k)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i)
            if (is_mode(&modes->group[k], i))
                amplitudes[CZ_TRACK_WIDTH * k + i] =
                    amplitudes_of(&block[modes->group[k].vector * CZ_TRACK_WIDTH + i],
                                  &modes->group[k], i, track->step);
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

static void look(const CzTrackMotion *track, const CzTrackUnder *under, const double place[4],
                 CzComplex seat[4]) {
    for (int wheel = 0; wheel < 4; ++wheel) {
        seat[wheel] = cz_turned(place[wheel] * track->per_spacing);
        cz_track_shape(track, cz_turned(place[wheel] * track->per_length), seat[wheel],
                       under->shape + 4 * wheel * track->modes->n_vector);
    }
}

/* g(x) of a mode at a wheel, where the shapes were taken. */
static CzComplex shape_under(const CzTrackModes *modes, const CzTrackUnder *under, int k, int i,
                             int wheel) {
    const CzTrackGroup *group = &modes->group[k];
    const CzTrackRow *shape = under->shape + 4 * (wheel * modes->n_vector + group->vector);
    return cz_complex_sum(cz_complex_scaled(shape[group->copy][i], group->direct[i]),
                          cz_complex_scaled(shape[2 + group->copy][i], group->alias[i]));
}

/* Load of a mode: sum of g(x) P. */
static CzComplex load_under(const CzTrackModes *modes, const CzTrackUnder *under, int k, int i) {
    CzComplex sum = {0.0, 0.0};
    for (int wheel = 0; wheel < 4; ++wheel)
        sum = cz_complex_sum(
            sum, cz_complex_scaled(under->force[wheel], shape_under(modes, under, k, i, wheel)));
    return sum;
}

/* The modes that the constant forces of the wheels make. */
static void rest_under(const CzTrackModes *modes, const CzTrackUnder *under, double step) {
    for (int k = 0; k < modes->n_group; ++k)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            CzComplex y = {0.0, 0.0};
            if (is_mode(&modes->group[k], i))
                y = cz_complex_product(load_under(modes, under, k, i),
                                       cz_track_constant_answer(modes->group[k].lambda[i], step));
            put(y, i, under->state[2 * k], under->state[2 * k + 1]);
        }
}

bool cz_track_lay(CzTrackMotion *track, size_t index, const double place[4], const double load[4],
                  CzArena *arena) {
    const CzTrackModes *modes = track->modes;
    CzTrackUnder *under = &track->under[index];
    const size_t n_vector = (size_t)modes->n_vector;
    under->state = cz_arena_allocate(arena, 2 * (size_t)modes->n_group, sizeof *under->state);
    under->wave = cz_arena_allocate(arena, 8 * n_vector, sizeof *under->wave);
    under->shape = cz_arena_allocate(arena, 16 * n_vector, sizeof *under->shape);
    if (under->state == NULL || under->wave == NULL || under->shape == NULL)
        return false;
    CzComplex seat[4];
    look(track, under, place, seat);
    for (int wheel = 0; wheel < 4; ++wheel)
        under->force[wheel] = -load[wheel];
    rest_under(modes, under, track->step);
    cz_track_read(track, under);
    return true;
}

void cz_track_look(const CzTrackMotion *track, size_t index, const double place[4],
                   double deflection[4], double flexibility[4]) {
    CzComplex seat[4];
    look(track, &track->under[index], place, seat);
    for (int wheel = 0; wheel < 4; ++wheel) {
        deflection[wheel] = cz_track_at(track, &track->under[index], wheel).z;
        flexibility[wheel] =
            cz_track_spring(&track->flexibility, track->per_spacing, seat[wheel]).flexibility;
    }
}

/* ---- energy ---- */

/* What moves in one block: displacement and rate of each part at its crest. */
typedef struct Parts {
    double wave[CZ_BLOCK_WAVES], wave_rate[CZ_BLOCK_WAVES];
    double force, stretch, stretch_rate; /* of a pad */
    double sleeper, sleeper_rate, ballast, ballast_rate;
} Parts;

/* A mode and its rate, the force that still acts included. */
typedef struct Motion {
    CzComplex y, rate;
} Motion;

static void add_part(CzComplex amplitude, const Motion *motion, double *value, double *rate) {
    *value += cz_complex_product(amplitude, motion->y).re;
    *rate += cz_complex_product(amplitude, motion->rate).re;
}

static void add_mode(const CzTrackAmplitudes *amplitudes, int n_wave, const Motion *motion,
                     Parts *parts) {
    for (int w = 0; w < n_wave; ++w)
        add_part(amplitudes->wave[w], motion, &parts->wave[w], &parts->wave_rate[w]);
    double none = 0.0;
    add_part(amplitudes->force, motion, &parts->force, &none);
    add_part(amplitudes->stretch, motion, &parts->stretch, &parts->stretch_rate);
    add_part(amplitudes->sleeper, motion, &parts->sleeper, &parts->sleeper_rate);
    add_part(amplitudes->ballast, motion, &parts->ballast, &parts->ballast_rate);
}

static double square(double value) {
    return value * value;
}

static void parts_energy(const CzTrackBlock *block, const Parts *parts, double *energy,
                         double *loss) {
    const CzSeats *seats = block->seats;
    const double coupled = square(2.0 * cz_turned(0.5 * block->turns).im);
    for (int w = 0; w < block->n_wave; ++w)
        *energy += 0.5 * block->mass[w] / block->wave[w].share *
                   (square(parts->wave_rate[w]) + block->wave[w].bending * square(parts->wave[w]));
    const double upper = parts->sleeper - parts->ballast;
    const double upper_rate = parts->sleeper_rate - parts->ballast_rate;
    *energy += 0.5 * block->crests *
               (seats->pad_k * square(parts->stretch) + block->rest * square(parts->force) +
                seats->sleeper * square(parts->sleeper_rate) + seats->upper_k * square(upper) +
                seats->ballast * square(parts->ballast_rate) +
                (seats->lower_k + coupled * seats->across_k) * square(parts->ballast));
    *loss += block->crests *
             (seats->pad_c * square(parts->stretch_rate) + seats->upper_c * square(upper_rate) +
              (seats->lower_c + coupled * seats->across_c) * square(parts->ballast_rate));
}

/* A mode when the last force was about to end: the present state without half a flight. */
static Motion half_a_step_ago(const CzTrackMotion *track, size_t index, int k, int i) {
    const CzTrackUnder *under = &track->under[index];
    const CzComplex lambda = track->modes->group[k].lambda[i];
    const CzComplex now = {under->state[2 * k][i], under->state[2 * k + 1][i]};
    const CzComplex y = cz_complex_product(track->amplitudes[CZ_TRACK_WIDTH * k + i].back, now);
    return (Motion){
        y, cz_complex_sum(cz_complex_product(lambda, y), load_under(track->modes, under, k, i))};
}

static void add_up(const CzTrackMotion *track, size_t index, double *energy, double *loss) {
    const CzTrackModes *modes = track->modes;
    for (int row = 0; row < 2 * modes->n_vector; ++row)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            const int j = row % modes->n_vector * CZ_TRACK_WIDTH + i;
            if (2 * j > modes->n_seat)
                continue;
            const CzTrackBlock *block = &track->block[j];
            Parts parts;
            memset(&parts, 0, sizeof parts);
            for (int k = track->span[row].first; k < track->span[row].end; ++k) {
                if (!is_mode(&modes->group[k], i))
                    continue;
                const Motion motion = half_a_step_ago(track, index, k, i);
                add_mode(&track->amplitudes[CZ_TRACK_WIDTH * k + i], block->n_wave, &motion,
                         &parts);
            }
            parts_energy(block, &parts, energy, loss);
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

/* Rates of one group of modes under the load of its row of waves; what they move on the rail is
 * added to the waves. */
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
    cz_track_give(rows, rate_re, rate_im, aliased, waves);
}

/* What a row of waves moves at the wheels. */
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
