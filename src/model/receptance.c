/* Vector fitting of the track's receptance under a bogie. */
#include "model/receptance.h"

#include <string.h>

#include "base/error.h"
#include "base/least_squares.h"
#include "base/roots.h"
#include "model/storage.h"

/* Samples and first poles are evenly spaced in the logarithm of frequency: samples from 1/300 of
 * the cut-off frequency of the modes up to it, and on to 13 times the cut-off, where the fit must
 * fall off as the modes do; poles from 1/100 of the cut-off to the cut-off (ours). */
enum { N_BELOW = 200, N_BEYOND = 20, N_SAMPLE = N_BELOW + N_BEYOND };
#define LOG_300 5.703782474656201
#define LOG_100 4.605170185988092
#define LOG_13 2.564949357461537
#define FIRST_DAMPING 0.1 /* damping ratio of the first poles (ours) */

enum { MIN_PAIRS = 8, MAX_PAIRS = 16, N_ITERATION = 8, MAX_REPAIRS = 8 }; /* (ours) */
_Static_assert(CZ_MAX_PAIR_MODES >= 2 * MAX_PAIRS + MAX_REPAIRS, "every pole may be real");

#define LARGEST_ERROR 3e-3 /* of the largest receptance, at the samples (ours) */
#define NEARLY_REAL 1e-9   /* largest imaginary part of a real root, as a share of its size */
#define MIN_DAMPING 1e-12  /* smallest damping ratio of a mode that counts as damped */

/* Frequencies on the imaginary axis at which the fit is tested for passivity [rad/s] (ours). */
#define AXIS_FROM 1.0
#define AXIS_TO 1e7
#define AXIS_GROWTH 1.01
#define REPAIRED 1.05 /* factor on the smallest correction that makes the fit passive (ours) */

#define STORAGE_STEP 1e-6 /* time step for the stored energy of the modes [s] (ours) */

/* ---- the modal track ------------------------------------------------------------------------- */

/* Mean over a bay of the squared shape of a mode under two wheels: half the square of each wave,
 * but all of the one wave that is the same everywhere. From one wheel to the other the phase of a
 * wave grows by its wavenumber times the axle spacing. */
static CzComplex square_of(const CzTrackModes *modes, const CzTrackGroup *group, int i,
                           double axle_spacing, CzPairMotion motion) {
    const int j = group->vector * CZ_TRACK_WIDTH + i;
    const double turns = axle_spacing / modes->length;
    const double sign = motion == CZ_PAIR_BOUNCE ? 1.0 : -1.0;
    const double direct = 1.0 + sign * cz_turned(j * turns).re;
    const double alias = 1.0 + sign * cz_turned((j - modes->n_seat) * turns).re;
    const CzComplex g = group->direct[i], a = group->alias[i];
    return cz_complex_scaled(j == 0 ? 1.0 : 0.5,
                             cz_complex_sum(cz_complex_scaled(direct, cz_complex_product(g, g)),
                                            cz_complex_scaled(alias, cz_complex_product(a, a))));
}

bool cz_track_spectrum(const CzTrackModes *modes, double axle_spacing, CzArena *arena,
                       CzTrackSpectrum *spectrum) {
    const size_t most = (size_t)modes->n_group * CZ_TRACK_WIDTH;
    spectrum->n = 0;
    spectrum->lambda = cz_arena_allocate(arena, most, sizeof(CzComplex));
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++)
        spectrum->square[motion] = cz_arena_allocate(arena, most, sizeof(CzComplex));
    if (arena->out_of_memory)
        return false;
    for (int k = 0; k < modes->n_group; k++)
        for (int i = 0; i < CZ_TRACK_WIDTH; i++) {
            const CzTrackGroup *group = &modes->group[k];
            const CzComplex lambda = group->lambda[i];
            if (!(-lambda.re > MIN_DAMPING * cz_complex_size(lambda)))
                continue;
            const int n = spectrum->n++;
            spectrum->lambda[n] = lambda;
            for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++)
                spectrum->square[motion][n] =
                    square_of(modes, group, i, axle_spacing, (CzPairMotion)motion);
        }
    return true;
}

/* square / (s - lambda) and its conjugate, halved. */
static CzComplex pair_answer(CzComplex square, CzComplex lambda, CzComplex s) {
    const CzComplex one = {s.re - lambda.re, s.im - lambda.im};
    const CzComplex other = {s.re - lambda.re, s.im + lambda.im};
    const CzComplex conjugate = {square.re, -square.im};
    return cz_complex_scaled(
        0.5, cz_complex_sum(cz_complex_ratio(square, one), cz_complex_ratio(conjugate, other)));
}

CzComplex cz_track_receptance(const CzTrackSpectrum *spectrum, CzPairMotion motion, CzComplex s) {
    CzComplex sum = {0.0, 0.0};
    for (int k = 0; k < spectrum->n; k++)
        sum = cz_complex_sum(sum, pair_answer(spectrum->square[motion][k], spectrum->lambda[k], s));
    return sum;
}

static CzComplex answer_of_modes(const struct CzPairModes *modes, CzComplex s) {
    CzComplex sum = {0.0, 0.0};
    for (int k = 0; k < modes->n; k++) {
        const CzPairMode *mode = &modes->mode[k];
        const CzComplex square = cz_complex_product(mode->g, mode->g);
        sum = cz_complex_sum(sum, pair_answer(square, mode->lambda, s));
    }
    return sum;
}

CzComplex cz_fitted_receptance(const CzReceptance *receptance, CzPairMotion motion, CzComplex s) {
    return answer_of_modes(&receptance->motion[motion], s);
}

/* ---- vector fitting -------------------------------------------------------------------------- */

typedef struct Samples {
    double frequency[N_SAMPLE]; /* [rad/s] */
    CzComplex value[N_SAMPLE];
    double largest; /* of the values */
} Samples;

/* A rational function by its poles: for a conjugate pair the upper one, with two numbers for its
 * residue, for a real pole one. */
typedef struct Poles {
    int n_pole, n_number;
    CzComplex pole[2 * MAX_PAIRS];
    double number[2 * MAX_PAIRS];
} Poles;

static bool is_real(CzComplex pole) {
    return pole.im == 0.0;
}

static void add_pole(Poles *poles, CzComplex pole) {
    poles->pole[poles->n_pole++] = pole;
    poles->n_number += is_real(pole) ? 1 : 2;
}

static void take_samples(const CzTrackSpectrum *spectrum, CzPairMotion motion, double cut,
                         Samples *samples) {
    const double below = cz_exponential(LOG_300 / N_BELOW);
    const double beyond = cz_exponential(LOG_13 / N_BEYOND);
    double w = cut / 300.0;
    samples->largest = 0.0;
    for (int k = 0; k < N_SAMPLE; k++) {
        const CzComplex value = cz_track_receptance(spectrum, motion, (CzComplex){0.0, w});
        samples->frequency[k] = w;
        samples->value[k] = value;
        samples->largest = fmax(samples->largest, cz_complex_size(value));
        w *= k < N_BELOW ? below : beyond;
    }
}

static Poles first_poles(int n_pair, double cut) {
    const double factor = cz_exponential(LOG_100 / (n_pair - 1));
    Poles poles = {0};
    double w = cut / 100.0;
    for (int i = 0; i < n_pair; i++, w *= factor)
        add_pole(&poles, (CzComplex){-FIRST_DAMPING * w, w});
    return poles;
}

/* Contribution of each number of a residue at s. */
static int basis_at(CzComplex pole, CzComplex s, CzComplex basis[2]) {
    const CzComplex one = cz_complex_inverse((CzComplex){s.re - pole.re, s.im - pole.im});
    if (is_real(pole)) {
        basis[0] = one;
        return 1;
    }
    const CzComplex other = cz_complex_inverse((CzComplex){s.re - pole.re, s.im + pole.im});
    basis[0] = cz_complex_sum(one, other);
    basis[1] = (CzComplex){other.im - one.im, one.re - other.re};
    return 2;
}

/* Rows of the least squares: real and imaginary parts of all samples. */
enum { N_ROW = 2 * N_SAMPLE, MAX_COLUMNS = 4 * MAX_PAIRS };

/* Writes the columns of the basis, each times a factor per sample, to `a`. */
static void put_basis(const Samples *samples, const Poles *poles, bool times_value, double *a) {
    for (int k = 0; k < N_SAMPLE; k++) {
        const CzComplex s = {0.0, samples->frequency[k]};
        double *column = a;
        for (int i = 0; i < poles->n_pole; i++) {
            CzComplex basis[2];
            const int n = basis_at(poles->pole[i], s, basis);
            for (int part = 0; part < n; part++, column += N_ROW) {
                const CzComplex own =
                    times_value ? cz_complex_product(basis[part], samples->value[k]) : basis[part];
                column[2 * k] = own.re;
                column[2 * k + 1] = own.im;
            }
        }
    }
}

static void put_values(const Samples *samples, double *b) {
    for (int k = 0; k < N_SAMPLE; k++) {
        b[2 * k] = samples->value[k].re;
        b[2 * k + 1] = samples->value[k].im;
    }
}

/* sigma = 1 + the rational function, its slope, and the sum of 1 / (s - pole). */
typedef struct Sigma {
    CzComplex value, slope, sum;
} Sigma;

static void add_term(Sigma *sigma, CzComplex pole, CzComplex residue, CzComplex s) {
    const CzComplex one = cz_complex_inverse(cz_complex_difference(s, pole));
    const CzComplex term = cz_complex_product(residue, one);
    sigma->value = cz_complex_sum(sigma->value, term);
    sigma->slope = cz_complex_difference(sigma->slope, cz_complex_product(term, one));
    sigma->sum = cz_complex_sum(sigma->sum, one);
}

static CzComplex conjugate_of(CzComplex a) {
    return (CzComplex){a.re, -a.im};
}

/* The residue whose numbers begin at `number`. */
static CzComplex residue_of(CzComplex pole, const double *number) {
    return (CzComplex){number[0], is_real(pole) ? 0.0 : number[1]};
}

/* P'/P of P = sigma times the product of (s - pole). */
static CzComplex slope_of_sigma(const void *function, CzComplex s) {
    const Poles *poles = function;
    const double *number = poles->number;
    Sigma sigma = {.value = {1.0, 0.0}};
    for (int i = 0; i < poles->n_pole; i++) {
        const CzComplex pole = poles->pole[i], residue = residue_of(pole, number);
        add_term(&sigma, pole, residue, s);
        if (!is_real(pole))
            add_term(&sigma, conjugate_of(pole), conjugate_of(residue), s);
        number += is_real(pole) ? 1 : 2;
    }
    return cz_complex_sum(sigma.sum, cz_complex_ratio(sigma.slope, sigma.value));
}

/* The zeros of sigma, mirrored to the stable side. The starting values are near the poles, and no
 * two of them are conjugate, because two real roots could not separate then. */
static void move_poles(Poles *poles) {
    CzComplex root[2 * MAX_PAIRS];
    int n = 0;
    for (int i = 0; i < poles->n_pole; i++) {
        const CzComplex pole = poles->pole[i];
        root[n++] = (CzComplex){1.01 * pole.re, 1.02 * pole.im};
        if (!is_real(pole))
            root[n++] = (CzComplex){0.98 * pole.re, -1.01 * pole.im};
    }
    cz_find_roots(slope_of_sigma, poles, n, root);
    poles->n_pole = poles->n_number = 0;
    for (int i = 0; i < n; i++) {
        const bool real = fabs(root[i].im) < NEARLY_REAL * cz_complex_size(root[i]);
        if (real || root[i].im > 0.0)
            add_pole(poles, (CzComplex){-fabs(root[i].re), real ? 0.0 : root[i].im});
    }
}

/* Improves the poles, from G sigma = the rational function and sigma = 1 + the same function with
 * other residues. */
static bool iterate(const Samples *samples, Poles *poles, double *a) {
    double b[N_ROW];
    const int n = poles->n_number;
    put_basis(samples, poles, false, a);
    put_basis(samples, poles, true, a + (size_t)n * N_ROW);
    put_values(samples, b);
    if (!cz_least_squares(N_ROW, 2 * n, a, 1, b))
        return false;
    for (int i = 0; i < n; i++)
        poles->number[i] = -b[n + i];
    move_poles(poles);
    return poles->n_number == n;
}

/* Fits the modes for given poles, with residues by least squares. */
static bool fit_residues(const Samples *samples, const Poles *poles, double *a,
                         struct CzPairModes *modes) {
    double b[N_ROW];
    const double *number = b;
    put_basis(samples, poles, false, a);
    put_values(samples, b);
    if (!cz_least_squares(N_ROW, poles->n_number, a, 1, b))
        return false;
    modes->n = poles->n_pole;
    for (int i = 0; i < poles->n_pole; i++) {
        const CzComplex pole = poles->pole[i];
        const CzComplex square =
            cz_complex_scaled(is_real(pole) ? 1.0 : 2.0, residue_of(pole, number));
        modes->mode[i] = (CzPairMode){pole, cz_complex_root(square)};
        number += is_real(pole) ? 1 : 2;
    }
    return true;
}

/* ---- passivity ------------------------------------------------------------------------------- */

/* The frequency at which the fit supplies most energy, and the imaginary part there; a passive
 * track lags behind the force at all frequencies [rad/s, m/N]. */
typedef struct Lead {
    double frequency, size;
} Lead;

static Lead largest_lead(const struct CzPairModes *modes) {
    Lead largest = {0.0, 0.0};
    for (double w = AXIS_FROM; w < AXIS_TO; w *= AXIS_GROWTH) {
        const double size = answer_of_modes(modes, (CzComplex){0.0, w}).im;
        if (size > largest.size)
            largest = (Lead){w, size};
    }
    return largest;
}

/* Adds real modes, each passive by itself, until the fit is passive: a / (s + w) has the imaginary
 * part -a / (2 w) at w. */
static bool make_passive(struct CzPairModes *modes) {
    for (int i = 0; i < MAX_REPAIRS; i++) {
        const Lead lead = largest_lead(modes);
        if (lead.size == 0.0)
            return true;
        modes->mode[modes->n++] =
            (CzPairMode){.lambda = {-lead.frequency, 0.0},
                         .g = {sqrt(2.0 * REPAIRED * lead.size * lead.frequency), 0.0}};
    }
    return largest_lead(modes).size == 0.0;
}

static double largest_error(const Samples *samples, const struct CzPairModes *modes) {
    double error = 0.0;
    for (int k = 0; k < N_SAMPLE; k++) {
        const CzComplex fitted = answer_of_modes(modes, (CzComplex){0.0, samples->frequency[k]});
        error = fmax(error, cz_complex_size(cz_complex_difference(fitted, samples->value[k])));
    }
    return error / samples->largest;
}

/* ---- energy ---------------------------------------------------------------------------------- */

/* Available storage under forces that are constant over a short step. */
static bool find_storage(struct CzPairModes *modes, CzArena *arena, CzArena *scratch) {
    const int n = 2 * modes->n;
    double *a = cz_arena_allocate(scratch, (size_t)(n * n), sizeof *a);
    double *b = cz_arena_allocate(scratch, (size_t)n, sizeof *b);
    double *c = cz_arena_allocate(scratch, (size_t)n, sizeof *c);
    modes->storage = cz_arena_allocate(arena, (size_t)(n * n), sizeof *modes->storage);
    if (scratch->out_of_memory || modes->storage == NULL)
        return false;
    for (int k = 0; k < modes->n; k++) {
        const CzComplex lambda = modes->mode[k].lambda, g = modes->mode[k].g;
        const CzComplex flight = cz_complex_exponential(cz_complex_scaled(STORAGE_STEP, lambda));
        const CzComplex held = {(flight.re - 1.0), flight.im};
        const CzComplex kicked = cz_complex_product(cz_complex_ratio(held, lambda), g);
        double *row = a + 2 * k * n + 2 * k;
        row[0] = row[n + 1] = flight.re;
        row[1] = -flight.im;
        row[n] = flight.im;
        b[2 * k] = kicked.re;
        b[2 * k + 1] = kicked.im;
        c[2 * k] = g.re;
        c[2 * k + 1] = -g.im;
    }
    return cz_available_storage(n, a, b, c, modes->storage, scratch);
}

/* ---- the fit --------------------------------------------------------------------------------- */

/* Fits one motion with the fewest pairs that are accurate enough. */
static bool fit_motion(const Samples *samples, double cut, double *a, struct CzPairModes *modes) {
    for (int n_pair = MIN_PAIRS; n_pair <= MAX_PAIRS; n_pair += 2) {
        Poles poles = first_poles(n_pair, cut);
        bool is_found = true;
        for (int i = 0; i < N_ITERATION && is_found; i++)
            is_found = iterate(samples, &poles, a);
        if (!is_found || !fit_residues(samples, &poles, a, modes) || !make_passive(modes))
            continue;
        modes->error = largest_error(samples, modes);
        if (modes->error < LARGEST_ERROR)
            return true;
    }
    return false;
}

static CzStatus fit(const CzTrackModes *modes, CzArena *arena, CzArena *scratch,
                    CzReceptance *receptance, CzError *error) {
    CzTrackSpectrum spectrum;
    Samples *samples = cz_arena_allocate(scratch, 1, sizeof *samples);
    double *a = cz_arena_allocate(scratch, (size_t)N_ROW * MAX_COLUMNS, sizeof *a);
    if (!cz_track_spectrum(modes, receptance->axle_spacing, scratch, &spectrum) ||
        samples == NULL || a == NULL)
        return cz_no_memory(error, "the track's receptance");
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++) {
        struct CzPairModes *own = &receptance->motion[motion];
        take_samples(&spectrum, (CzPairMotion)motion, modes->cut, samples);
        if (!fit_motion(samples, modes->cut, a, own) || !find_storage(own, arena, scratch))
            return scratch->out_of_memory || arena->out_of_memory
                       ? cz_no_memory(error, "the track's receptance")
                       : cz_fail(error, CZ_STATUS_INPUT,
                                 "the receptance of this track under a bogie with an axle spacing "
                                 "of %g m cannot be fitted by few modes to 0.3 %%: its masses, "
                                 "stiffnesses and damping differ too much" CZ_HELP
                                 "use simulation: {track: modal}, which has all of its modes",
                                 receptance->axle_spacing);
    }
    return CZ_OK;
}

CzStatus cz_receptance_fit(const CzTrackModes *modes, double axle_spacing, CzArena *arena,
                           CzReceptance *receptance, CzError *error) {
    CzArena scratch = {0};
    memset(receptance, 0, sizeof *receptance);
    receptance->axle_spacing = axle_spacing;
    const CzStatus status = fit(modes, arena, &scratch, receptance, error);
    cz_arena_free(&scratch);
    return status;
}

CzTrackFlexibility cz_receptance_flexibility(const CzTrackModes *modes,
                                             const CzReceptance *receptance, double step) {
    CzTrackFlexibility flexibility = cz_track_flexibility(modes, step);
    double of_modes[2] = {0.0, 0.0}, of_fit = 0.0;
    cz_track_add_modes(modes, cz_track_constant_answer, step, of_modes);
    for (int motion = 0; motion < CZ_N_PAIR_MOTION; motion++)
        for (int k = 0; k < receptance->motion[motion].n; k++) {
            const CzPairMode *mode = &receptance->motion[motion].mode[k];
            const CzComplex square = cz_complex_product(mode->g, mode->g);
            of_fit +=
                0.5 * cz_complex_product(square, cz_track_constant_answer(mode->lambda, step)).re;
        }
    flexibility.term[0] += of_modes[0] - of_fit;
    flexibility.term[1] += of_modes[1];
    return flexibility;
}
