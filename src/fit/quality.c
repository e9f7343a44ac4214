/* Judges how well a law describes its curve over the whole loading.
 *
 * Equal energy alone is not sufficient: a plateau through a curve with a rupture has it as well.
 * The levels are ours; a doubtful law is written with the reason, a refused one is not written.
 */
#include "fit/fit.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/number.h"

/* Levels of a relative error. */
typedef struct Level {
    double doubtful, refused;
} Level;

static const Level mean_square = {0.2, 0.5}; /* over the mean force (ours) */
static const Level stretch = {0.4, 1.0};     /* over a tenth of the stroke, over the mean (ours) */
static const Level energy = {0.03, 0.1};     /* difference over the curve's (ours) */
static const Level too_high = {0.15, 0.3};   /* peak of the law over the curve's, less 1 (ours) */
static const Level too_low = {0.45, 0.7}; /* 1 less the peak of the law over the curve's (ours) */

const char *cz_fit_verdict_word(CzFitVerdict verdict) {
    static const char *const words[] = {"good", "doubtful", "refused"};
    return words[verdict];
}

__attribute__((format(printf, 4, 5))) static void
judge(CzFit *fit, double share, const Level *level, const char *format, ...) {
    char text[160];
    va_list arguments;
    const bool is_refused = !(share <= level->refused); /* NaN is rejected */
    if (share <= level->doubtful)
        return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    cz_fit_doubt_that(fit, "%s; more than %g %% is %s", text,
                      100.0 * (is_refused ? level->refused : level->doubtful),
                      is_refused ? "refused" : "doubtful");
    if (is_refused)
        fit->summary.verdict = CZ_FIT_REFUSED;
}

void cz_fit_judge(CzFit *fit) {
    CzFitSummary *summary = &fit->summary;
    char a[CZ_NUMBER_TEXT], b[CZ_NUMBER_TEXT];
    const double peak = summary->law_peak / summary->peak_force;
    const double taken = summary->law_whole_energy / summary->whole_energy - 1.0;
    judge(fit, summary->mean_square / summary->mean_force, &mean_square,
          "the root mean square difference is %.0f %% of the mean force of %s kN",
          100.0 * summary->mean_square / summary->mean_force,
          cz_number_print_short(a, 1e-3 * summary->mean_force));
    judge(fit, summary->stretch_difference / summary->mean_force, &stretch,
          "over a tenth of the stroke the force differs by %.0f %% of the mean force",
          100.0 * summary->stretch_difference / summary->mean_force);
    judge(fit, fabs(taken), &energy, "over the whole curve the law absorbs %.0f %% %s energy",
          100.0 * fabs(taken), taken > 0.0 ? "more" : "less");
    judge(fit, peak - 1.0, &too_high, "the law's peak of %s kN is %.0f %% above the curve's",
          cz_number_print_short(b, 1e-3 * summary->law_peak), 100.0 * (peak - 1.0));
    judge(fit, 1.0 - peak, &too_low, "the law's peak of %s kN is %.0f %% below the curve's",
          cz_number_print_short(b, 1e-3 * summary->law_peak), 100.0 * (1.0 - peak));
}
