/* The modes of the track: window, blocks in groups, and residual static flexibility. */
#include "model/track.h"

#include "base/error.h"
#include "model/track_block.h"

#define RECORD_CUT 1500.0     /* [Hz] */
#define DECAYS 16.0           /* of the static deflection around the ring (ours) */
#define LARGEST_RESIDUAL 1e-9 /* of a block's modes against its mass (ours; 1e-15 is usual) */
#define NEARLY_REAL 1e-9      /* imaginary part below which a root counts as real */

CzTrackOptions cz_track_options_default(double span) {
    return (CzTrackOptions){.n_rail = 2, .n_seat = 0, .span = span, .cut = RECORD_CUT};
}

/* Seats of a ring that is long enough: the static deflection falls with e^(-beta x), beta^4 = k /
 * (4 E I d) for seats of stiffness k. */
static int choose_seats(const CzSeats *seats, double span) {
    const double k = 1.0 / (cz_seat_flexibility(seats, 0.0) * seats->spacing);
    const double beta = sqrt(sqrt(k / (4.0 * seats->bending)));
    const double length = span + DECAYS / beta;
    const int n = 2 * CZ_TRACK_WIDTH;
    int n_seat = n - 2;
    while (n_seat * seats->spacing < length)
        n_seat += n;
    return n_seat;
}

/* ---- modes of a block ---- */

/* One retained eigenvalue; only one of a pair. */
typedef struct Mode {
    CzComplex lambda, direct, alias, pad;
} Mode;

typedef struct BlockModes {
    int n_mode;
    Mode mode[CZ_BLOCK_ROOTS];
} BlockModes;

static Mode mode_of(const CzTrackBlock *block, CzComplex root, const CzSecular *secular,
                    double cut) {
    const bool is_real = root.im == 0.0;
    const CzComplex residue = cz_complex_scaled(-block->crests, cz_complex_inverse(secular->slope));
    const CzComplex scale = cz_complex_scaled(is_real ? 1.0 : sqrt(2.0), cz_complex_root(residue));
    Mode mode = {.lambda = root};
    mode.direct = cz_complex_product(scale, cz_track_wave_answer(block, 0, root));
    /* The waves at an edge are their own aliases. */
    if (block->n_wave == CZ_BLOCK_WAVES && block->wave[1].bending < cut * cut)
        mode.alias = cz_complex_product(scale, cz_track_wave_answer(block, 1, root));
    /* f = sum of h load / F: its residue is -1 / n_j of that of the deflection. */
    mode.pad = cz_complex_scaled(-1.0 / block->crests, scale);
    return mode;
}

/* Modes of the cosine copy of a block; the slowest first. Fails when roots are missing: a load on
 * the first wave must accelerate it by its own mass. */
static bool find_modes(const CzTrackBlock *block, double cut, BlockModes *modes) {
    CzComplex root[CZ_BLOCK_ROOTS];
    const int n_root = cz_track_roots(block, root);
    double acceleration = 0.0;
    for (int i = 0; i < n_root; ++i) {
        const CzSecular secular = cz_track_secular(block, root[i]);
        const CzComplex h = cz_track_wave_answer(block, 0, root[i]);
        const CzComplex square = cz_complex_product(h, h);
        acceleration -=
            block->crests * cz_complex_ratio(cz_complex_product(square, root[i]), secular.slope).re;
        if (fabs(root[i].im) < NEARLY_REAL * cz_complex_size(root[i]))
            root[i].im = 0.0;
        if (root[i].im < 0.0 || !(cz_complex_size(root[i]) < cut))
            continue;
        const Mode mode = mode_of(block, root[i], &secular, cut);
        const double size = cz_complex_size(mode.lambda);
        int place = modes->n_mode++;
        for (; place > 0 && cz_complex_size(modes->mode[place - 1].lambda) > size; --place)
            modes->mode[place] = modes->mode[place - 1];
        modes->mode[place] = mode;
    }
    const double expected = block->wave[0].share / block->mass[0];
    return fabs(acceleration - expected) < LARGEST_RESIDUAL * expected;
}

/* The rail wave with its nodes at the seats: uncoupled from them and undamped. */
static BlockModes free_wave(const CzTrackBlock *block, double cut) {
    BlockModes modes = {0};
    const double w = sqrt(block->wave[0].bending);
    if (!(w < cut))
        return modes;
    /* g^2 = p / (M 2 i w), twice for the pair */
    const CzComplex square = {0.0, -block->wave[0].share / (block->mass[0] * w)};
    modes.n_mode = 1;
    modes.mode[0] = (Mode){.lambda = {0.0, w}, .direct = cz_complex_root(square)};
    return modes;
}

/* ---- groups ---- */

static CzStatus find_copies(const CzTrackModes *modes, BlockModes *copy[2], CzError *error) {
    for (int j = 0; j <= modes->n_seat / 2; ++j) {
        const CzTrackBlock block = cz_track_block(&modes->seats, modes->n_seat, j);
        if (!find_modes(&block, modes->cut, &copy[0][j]))
            return cz_fail(error, CZ_STATUS_INPUT,
                           "the modes of the track could not be computed with sufficient accuracy: "
                           "its masses, stiffnesses and damping differ too much");
        if (2 * j == modes->n_seat)
            copy[1][j] = free_wave(&block, modes->cut);
        else if (j > 0)
            copy[1][j] = copy[0][j];
    }
    return CZ_OK;
}

static int n_slot_of(const BlockModes *block) {
    int n_slot = 0;
    for (int i = 0; i < CZ_TRACK_WIDTH; ++i)
        n_slot = block[i].n_mode > n_slot ? block[i].n_mode : n_slot;
    return n_slot;
}

static void fill_group(CzTrackGroup *group, const BlockModes *block, int slot) {
    for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
        if (slot >= block[i].n_mode)
            continue;
        const Mode *mode = &block[i].mode[slot];
        group->lambda[i] = mode->lambda;
        group->direct[i] = mode->direct;
        group->alias[i] = mode->alias;
        group->pad[i] = mode->pad;
    }
}

static bool has_alias(const CzTrackGroup *group) {
    for (int i = 0; i < CZ_TRACK_WIDTH; ++i)
        if (cz_complex_square_size(group->alias[i]) > 0.0)
            return true;
    return false;
}

static CzStatus gather_groups(CzTrackModes *modes, BlockModes *copy[2], CzArena *arena,
                              CzError *error) {
    int n_group = 0;
    for (int c = 0; c < 2; ++c)
        for (int v = 0; v < modes->n_vector; ++v)
            n_group += n_slot_of(copy[c] + v * CZ_TRACK_WIDTH);
    modes->group = cz_arena_allocate(arena, (size_t)n_group, sizeof *modes->group);
    if (modes->group == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the track's modes");
    modes->first_alias = modes->n_vector;
    for (int c = 0; c < 2; ++c)
        for (int v = 0; v < modes->n_vector; ++v) {
            const BlockModes *block = copy[c] + v * CZ_TRACK_WIDTH;
            for (int slot = 0; slot < n_slot_of(block); ++slot) {
                CzTrackGroup *group = &modes->group[modes->n_group++];
                group->copy = c;
                group->vector = v;
                fill_group(group, block, slot);
                if (v < modes->first_alias && has_alias(group))
                    modes->first_alias = v;
            }
        }
    return CZ_OK;
}

CzStatus cz_track_build(const CzRoadbed *roadbed, const CzTrackOptions *options, CzArena *arena,
                        CzTrackModes **modes, CzError *error) {
    CzTrackModes *made = cz_arena_allocate(arena, 1, sizeof *made);
    *modes = made;
    if (made == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the track");
    made->seats = cz_seats(roadbed, options->n_rail);
    made->n_seat =
        options->n_seat > 0 ? options->n_seat : choose_seats(&made->seats, options->span);
    made->n_vector = (made->n_seat / 2 + CZ_TRACK_WIDTH) / CZ_TRACK_WIDTH;
    made->length = made->n_seat * made->seats.spacing;
    made->span = options->span;
    made->nodes = roadbed->nodes_per_bay;
    made->cut = 2.0 * CZ_PI * options->cut;
    const size_t n = (size_t)made->n_vector * CZ_TRACK_WIDTH;
    CzArena scratch = {0};
    BlockModes *blocks = cz_arena_allocate(&scratch, 2 * n, sizeof *blocks);
    CzStatus status = CZ_OK;
    if (blocks == NULL) {
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the track");
    } else {
        BlockModes *copy[2] = {blocks, blocks + n};
        status = find_copies(made, copy, error);
        if (status == CZ_OK)
            status = gather_groups(made, copy, arena, error);
    }
    cz_arena_free(&scratch);
    return status;
}

/* ---- residual static flexibility ---- */

CzComplex cz_track_kick(CzComplex lambda, double step) {
    const CzComplex half = cz_complex_scaled(0.5 * step, lambda);
    const CzComplex twice_sinh = cz_complex_difference(
        cz_complex_exponential(half), cz_complex_exponential(cz_complex_scaled(-1.0, half)));
    return cz_complex_ratio(twice_sinh, lambda);
}

CzComplex cz_track_constant_answer(CzComplex lambda, double step) {
    const CzComplex half = cz_complex_exponential(cz_complex_scaled(0.5 * step, lambda));
    return cz_complex_scaled(-1.0, cz_complex_ratio(half, lambda));
}

void cz_track_add_modes(const CzTrackModes *modes, CzTrackAnswer *answer_of, double step,
                        double sum[2]) {
    for (int k = 0; k < modes->n_group; ++k) {
        const CzTrackGroup *group = &modes->group[k];
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            const CzComplex g = group->direct[i], a = group->alias[i], lambda = group->lambda[i];
            if (cz_complex_square_size(g) == 0.0)
                continue;
            const int j = group->vector * CZ_TRACK_WIDTH + i;
            const CzComplex answer = answer_of(lambda, step);
            const double of_direct = cz_complex_product(cz_complex_product(g, g), answer).re;
            const double of_alias = cz_complex_product(cz_complex_product(a, a), answer).re;
            const double of_both = cz_complex_product(cz_complex_product(g, a), answer).re;
            sum[0] += 0.5 * (of_direct + of_alias) + (j == 0 ? 0.5 * of_direct : 0.0);
            sum[1] += of_both;
            if (2 * j == modes->n_seat)
                sum[1] += group->copy == 0 ? 0.5 * of_direct : -0.5 * of_direct;
        }
    }
}

/* A series of cos(2 pi k xi) as powers of cos(2 pi xi), by the recurrence of its polynomials. */
static void powers_of_series(const double series[CZ_TRACK_FLEX_TERMS],
                             double power[CZ_TRACK_FLEX_TERMS]) {
    double before[CZ_TRACK_FLEX_TERMS] = {1.0}, now[CZ_TRACK_FLEX_TERMS] = {0.0, 1.0};
    for (int i = 0; i < CZ_TRACK_FLEX_TERMS; ++i)
        power[i] = series[0] * before[i] + series[1] * now[i];
    for (int k = 2; k < CZ_TRACK_FLEX_TERMS; ++k) {
        double next[CZ_TRACK_FLEX_TERMS];
        for (int i = 0; i < CZ_TRACK_FLEX_TERMS; ++i)
            next[i] = 2.0 * (i > 0 ? now[i - 1] : 0.0) - before[i];
        for (int i = 0; i < CZ_TRACK_FLEX_TERMS; ++i) {
            before[i] = now[i];
            now[i] = next[i];
            power[i] += series[k] * next[i];
        }
    }
}

CzTrackFlexibility cz_track_flexibility(const CzTrackModes *modes, double step) {
    enum { n = CZ_TRACK_FLEX_TERMS };
    const CzSeats *seats = &modes->seats;
    CzTrackFlexibility flexibility;
    const double beside = 1e-6;
    flexibility.corner = (cz_ring_flexibility(seats, modes->n_seat, beside) -
                          cz_ring_flexibility(seats, modes->n_seat, 0.0)) /
                         cz_turned(0.5 * beside).im;

    /* The residual of the exact static deflection at Chebyshev's points. */
    double series[n] = {0.0};
    for (int i = 0; i < n; ++i) {
        const double place = (i + 0.5) / (2.0 * n);
        const double exact = cz_ring_flexibility(seats, modes->n_seat, place);
        const double smooth = exact - flexibility.corner * cz_turned(0.5 * place).im;
        for (int k = 0; k < n; ++k)
            series[k] += (k == 0 ? 1.0 : 2.0) / n * smooth * cz_turned(k * place).re;
    }
    double of_modes[2] = {0.0, 0.0};
    cz_track_add_modes(modes, cz_track_constant_answer, step, of_modes);
    series[0] -= of_modes[0];
    series[1] -= of_modes[1];
    powers_of_series(series, flexibility.term);
    return flexibility;
}
