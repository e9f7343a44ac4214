/* A fitted law as a catalogue with one part. */
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "fit/fit.h"

static const char *const records[CZ_N_FIT] = {
#define CZ_FIT(constant, word, record, doc) [constant] = record,
#include "crushzone/fits.def"
#undef CZ_FIT
};

static const char *text_of(char text[CZ_NUMBER_TEXT], double value) {
    return cz_number_print_short(text, value);
}

/* A share in percent with one decimal. */
static const char *percent_of(char text[CZ_NUMBER_TEXT], double share) {
    return cz_number_print_short(text, round(1e3 * share) / 10.0);
}

/* A force in kN; rounding errors of zero are 0. */
static const char *force_of(char text[CZ_NUMBER_TEXT], double force, double mean) {
    return text_of(text, fabs(force) <= 1e-12 * mean ? 0.0 : 1e-3 * force);
}

static void write_head(const CzFitSummary *summary, FILE *stream) {
    char a[CZ_NUMBER_TEXT], b[CZ_NUMBER_TEXT], c[CZ_NUMBER_TEXT];
    fprintf(stream, "# %s of %d points (%s) as %s\n",
            summary->file != NULL ? summary->file : "curve", summary->n_point,
            summary->is_dynamic ? "dynamic" : "static", cz_fit_kind_word(summary->kind));
    const double error = summary->law_energy - summary->energy;
    fprintf(stream, "#   energy      %s kJ, law %s kJ, error %s J\n",
            text_of(a, 1e-3 * summary->energy), text_of(b, 1e-3 * summary->law_energy),
            fabs(error) <= 1e-11 * summary->energy ? "0" : text_of(c, error));
    if (!isnan(summary->returned) && !isnan(summary->law_returned))
        fprintf(stream, "#   returned    %s kJ, law %s kJ\n", text_of(a, 1e-3 * summary->returned),
                text_of(b, 1e-3 * summary->law_returned));
    fprintf(stream, "#   force       differs by at most %s kN, at %s mm; root mean square %s kN\n",
            force_of(a, summary->largest_difference, summary->mean_force),
            text_of(b, 1e3 * summary->at_stroke),
            force_of(c, summary->mean_square, summary->mean_force));
    fprintf(
        stream,
        "#   quality     %s: root mean square %s %% of the mean force, peak %s %% and energy %s "
        "%% of the curve's\n",
        cz_fit_verdict_word(summary->verdict),
        percent_of(a, summary->mean_square / summary->mean_force),
        percent_of(b, summary->law_peak / summary->peak_force),
        percent_of(c, summary->law_whole_energy / summary->whole_energy));
}

/* Writes one line of stages: stroke and force, which are successive values. */
static void write_stage(const CzFit *fit, int i, int indent, FILE *stream) {
    char stroke[CZ_NUMBER_TEXT], force[CZ_NUMBER_TEXT];
    if (strstr(fit->value[i].path, "stages[0]") != NULL)
        fprintf(stream, "%*sstages:\n", indent, "");
    fprintf(stream, "%*s- {stroke_mm: %s, force_kN: %s}\n", indent + 2, "",
            cz_number_print(stroke, fit->value[i].value),
            cz_number_print(force, fit->value[i + 1].value));
}

static void write_values(const CzFit *fit, FILE *stream) {
    char number[CZ_NUMBER_TEXT];
    const char *record = "";
    size_t n_record = 0;
    for (int i = 0; i < fit->summary.n_value; i++) {
        const char *path = fit->value[i].path;
        const char *point = strchr(path, '.');
        const bool is_stage = strstr(path, "stages[") != NULL;
        const size_t n = is_stage && strncmp(path, "stages[", 7) == 0 ? 0
                         : point != NULL                              ? (size_t)(point - path)
                                                                      : 0;
        if (n > 0 && (n != n_record || strncmp(path, record, n) != 0))
            fprintf(stream, "    %.*s:\n", (int)n, path);
        record = path;
        n_record = n;
        const int indent = n > 0 ? 6 : 4;
        if (is_stage)
            write_stage(fit, i++, indent, stream);
        else
            fprintf(stream, "%*s%s: %s\n", indent, "", path + (n > 0 ? n + 1 : 0),
                    cz_number_print(number, fit->value[i].value));
    }
}

void cz_fit_write_yaml(const CzFit *fit, FILE *stream) {
    if (fit->summary.verdict == CZ_FIT_REFUSED)
        return;
    write_head(&fit->summary, stream);
    for (int i = 0; i < fit->summary.n_doubt; i++)
        fprintf(stream, "# DOUBTFUL: %s\n", fit->summary.doubt[i]);
    for (int i = 0; i < fit->summary.n_note; i++)
        fprintf(stream, "# note: %s\n", fit->summary.note[i]);
    fprintf(stream,
            "# Use it as %s: {use: %s, ...} in a problem file that lists this file under "
            "`catalogue`.\n",
            records[fit->summary.kind], fit->summary.name);
    fprintf(stream, "parts:\n  %s:\n", fit->summary.name);
    write_values(fit, stream);
}
