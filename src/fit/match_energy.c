/* Functions for all kinds of laws: words, keys, sentences, elastic shortening, rounding, equal
 * energy.
 */
#include "fit/fit.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/error.h"

#define FAR_OFF 0.5 /* largest change of a force for equal energy, as a share of it (ours) */

const char *cz_fit_kind_word(CzFitKind kind) {
    static const char *const words[CZ_N_FIT] = {
#define CZ_FIT(constant, word, record, doc) [constant] = word,
#include "crushzone/fits.def"
#undef CZ_FIT
    };
    return words[kind];
}

const CzKey *cz_fit_key(CzRecordId record, const char *stem) {
    return cz_record_key(&cz_records[record], stem);
}

static const char *write_sentence(CzFit *fit, const char *format, va_list arguments) {
    char text[200];
    const int n = vsnprintf(text, sizeof text, format, arguments);
    return cz_arena_copy_text(&fit->arena, text,
                              n < (int)sizeof text ? (size_t)n : sizeof text - 1);
}

void cz_fit_add_note(CzFit *fit, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    if (fit->summary.n_note < CZ_FIT_MAX_NOTES)
        fit->summary.note[fit->summary.n_note++] = write_sentence(fit, format, arguments);
    va_end(arguments);
}

void cz_fit_doubt_that(CzFit *fit, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    if (fit->summary.verdict == CZ_FIT_GOOD)
        fit->summary.verdict = CZ_FIT_DOUBTFUL;
    if (fit->summary.n_doubt < CZ_FIT_MAX_DOUBTS)
        fit->summary.doubt[fit->summary.n_doubt++] = write_sentence(fit, format, arguments);
    va_end(arguments);
}

CzStatus cz_fit_branch(CzFit *fit, double stiffness, CzBranch *branch, CzError *error) {
    if (!cz_branch_begin(&fit->arena, fit->curve.n, branch))
        return cz_no_memory(error, "a fit");
    for (int i = 0; i < fit->curve.n; i++)
        cz_branch_add(branch, i > 0 ? fmax(fit->path_x[i] - fit->path_f[i] / stiffness, 0.0) : 0.0,
                      fit->path_f[i]);
    return cz_branch_end(&fit->arena, branch) ? CZ_OK : cz_no_memory(error, "a fit");
}

/* ---- rounding ---- */

double cz_fit_round(double value, double unit) {
    double scale = 1.0, mantissa = value / unit;
    if (!(mantissa > 0.0) || !isfinite(mantissa))
        return value;
    for (; mantissa * scale < 1e4; scale *= 10.0)
        ;
    for (; mantissa * scale >= 1e5; scale /= 10.0)
        ;
    return round(mantissa * scale) / scale * unit;
}

static void round_strokes(CzStaged *staged) {
    for (int i = 0; i < staged->n_stage; i++)
        staged->stage[i].stroke = cz_fit_round(staged->stage[i].stroke, 1e-3);
    staged->trigger = cz_fit_round(staged->trigger, 1e3);
    staged->trigger_length = cz_fit_round(staged->trigger_length, 1e-3);
}

static void round_forces(CzStaged *staged) {
    for (int i = 0; i < staged->n_stage; i++)
        staged->stage[i].force = cz_fit_round(staged->stage[i].force, 1e3);
    staged->preload = cz_fit_round(staged->preload, 1e3);
}

void cz_fit_round_staged(CzStaged *staged) {
    round_strokes(staged);
    round_forces(staged);
}

void cz_fit_scale_forces(CzStaged *staged, int stage, double factor) {
    for (int i = 0; i < staged->n_stage; i++)
        staged->stage[i].force *= stage < 0 || i == stage ? factor : 1.0;
    staged->preload *= stage < 0 ? factor : 1.0;
}

/* Newton's method with a slope by differences: the energy is almost linear in a force. Returns the
 * factor on the forces; stage -1 is all stages. */
static double match_energy(CzFit *fit, CzStaged *staged, int stage) {
    const CzStaged found = *staged;
    double factor = 1.0;
    for (int i = 0; i < 20; i++) {
        const double wanted = fit->summary.energy, by = 1e-6;
        const double now = cz_fit_law_energy(fit);
        if (fabs(wanted - now) <= CZ_FIT_ROUNDING * wanted)
            break;
        *staged = found;
        cz_fit_scale_forces(staged, stage, factor + by);
        const double slope = (cz_fit_law_energy(fit) - now) / by;
        factor += (wanted - now) / slope;
        *staged = found;
        cz_fit_scale_forces(staged, stage, factor);
    }
    return factor;
}

static int longest_of(const CzStaged *staged) {
    int longest = 0;
    for (int i = 1; i < staged->n_stage; i++)
        if (staged->stage[i].stroke > staged->stage[longest].stroke)
            longest = i;
    return longest;
}

void cz_fit_make_rising(CzStaged *staged) {
    double force = staged->preload;
    for (int i = 0; i < staged->n_stage; i++)
        force = staged->stage[i].force = fmax(staged->stage[i].force, force);
}

CzStatus cz_fit_no_law(const CzFit *fit, CzError *error, const char *why) {
    const CzStatus status =
        cz_fail(error, CZ_STATUS_VIOLATED, "no law of kind %s fits this curve: %s",
                cz_fit_kind_word(fit->summary.kind), why);
    if (error == NULL)
        return status;
    snprintf(error->file, sizeof error->file, "%s",
             fit->summary.file != NULL ? fit->summary.file : "");
    snprintf(error->help, sizeof error->help,
             "try another --as, --from or --to, and check the units");
    return status;
}

CzStatus cz_fit_match_energy(CzFit *fit, CzStaged *staged, const CzBranch *branch, CzError *error) {
    const bool must_rise = staged == &fit->buffer;
    round_strokes(staged);
    for (int i = 0; i < 3; i++) { /* the elastic part depends slightly on the last force */
        CzStaged found = *staged;
        const double others = cz_fit_law_energy(fit) - cz_staged_energy(staged);
        if (cz_staged_solve(&found, branch, fit->summary.energy - others) < INFINITY)
            *staged = found;
    }
    if (must_rise)
        cz_fit_make_rising(staged);
    round_forces(staged);
    const double factor = match_energy(fit, staged, must_rise ? -1 : longest_of(staged));
    if (staged->trigger < staged->stage[0].force) { /* it is not a peak any more */
        staged->trigger = NAN;
        return cz_fit_match_energy(fit, staged, branch, error);
    }
    if (fabs(factor - 1.0) <= FAR_OFF)
        return CZ_OK;
    return cz_fit_no_law(fit, error,
                         "the forces of stages with equal energy differ too much from it");
}
