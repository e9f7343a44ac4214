/* Any bytes as a measured curve: for a fit, as a table of a problem, as a time history of a match,
 * as columns to draw, and as list and channel of a test in ISO-MME. The first two bytes choose how
 * the curve is read. */
#include "fuzz/fuzz.h"

#include "crushzone/fit.h"

#include <math.h>
#include <string.h>

#define RIGID_CARS                                                                                 \
    "schema: 1\n"                                                                                  \
    "title: two rigid cars\n"                                                                      \
    "trains:\n"                                                                                    \
    "  - {name: A, speed_km_h: 25, vehicles: [{model: rigid, mass_t: 20, front: {face_gap_mm: 0, " \
    "unloading_stiffness_MN_m: 100, %s}}]}\n"                                                      \
    "  - {name: B, vehicles: [{model: rigid, mass_t: 20}]}\n"                                      \
    "%s"

#define STAGES "stages: [{stroke_mm: 500, force_kN: 800}]"
#define MATCH                                                                                      \
    "optimise: {variables: [{path: 'trains.A.vehicles.A1.front.stages[0].force_kN', min: 100, "    \
    "max: 900}], match: [{name: force, channel: F_A1-B1_kN, file: curve.csv, tolerance: 1}]}\n"

/* A fit may also end without a law that follows the curve. */
static void check_refusal(CzStatus status, const CzError *error) {
    FUZZ_DEMAND(status == CZ_OK || status == CZ_STATUS_INPUT || status == CZ_STATUS_VIOLATED);
    FUZZ_DEMAND(status == CZ_OK || error->message[0] != '\0');
}

/* The law of a fit is finite and absorbs the energy of the curve. */
static void check_fit(const CzFit *fit) {
    const CzFitSummary *summary = cz_fit_summary(fit);
    FUZZ_DEMAND(isfinite(summary->stroke) && isfinite(summary->peak_force));
    FUZZ_DEMAND(isfinite(summary->energy) && isfinite(summary->law_energy));
    FUZZ_DEMAND(isfinite(summary->mean_square) && isfinite(summary->largest_difference));
    for (int i = 0; i < summary->n_value; i++)
        FUZZ_DEMAND(isfinite(summary->value[i].value));
    for (int i = 0; i < summary->n_note; i++)
        FUZZ_DEMAND(summary->note[i][0] != '\0');
}

static void fit_curve(const char *path, unsigned choice) {
    CzFitOptions options = cz_fit_options_default();
    CzFit *fit = NULL;
    CzError error = {0};
    options.kind = (CzFitKind)(choice % CZ_N_FIT);
    options.is_dynamic = (choice / 8) % 2;
    options.n_stage = (int)(choice / 16) % 4 - 1;
    if (choice & 64)
        options.decimal = ',';
    options.flips_stroke = choice >> 8 & 1;
    options.flips_force = choice >> 9 & 1;
    options.zero = (CzFitZero)(choice >> 10 & 3);
    options.zero_stroke = 1.5;
    options.scale = choice >> 12 & 1 ? 0.5 : 1.0;
    if (choice >> 13 & 1)
        options.from = 5.0;
    if (choice >> 14 & 1)
        options.to = 100.0;
    if (choice & 128) {
        options.stroke = "1";
        options.force = "2";
        options.stroke_unit = "mm";
        options.force_unit = "kN";
    }
    const CzStatus status = cz_fit_read(path, &options, &fit, &error);
    check_refusal(status, &error);
    FUZZ_DEMAND((status == CZ_OK) == (fit != NULL));
    if (fit != NULL)
        check_fit(fit);
    cz_fit_free(fit);
}

static void draw_curve(const char *path, unsigned choice) {
    const CzCurveColumns columns = {"time", "force", "1", "2", 0, choice & 64 ? ',' : 0};
    CzCurve *curve = NULL;
    CzError error = {0};
    const CzStatus status = cz_curve_read(path, &columns, &curve, &error);
    check_refusal(status, &error);
    for (int i = 0; status == CZ_OK && i < curve->n; i++)
        FUZZ_DEMAND(isfinite(curve->x[i]) && isfinite(curve->y[i]));
    cz_curve_free(curve);
    char **title = NULL;
    int n = 0;
    check_refusal(cz_curve_titles(path, 0, &n, &title, &error), &error);
    for (int i = 0; title != NULL && i < n; i++)
        FUZZ_DEMAND(title[i] != NULL);
    free(title);
}

/* The bytes as the list of channels of a test, whose channels are the bytes too. */
static void read_test(const uint8_t *data, size_t n_byte) {
    const CzCurveColumns columns = {"time", "force", "1", "2", 0, 0};
    CzCurve *curve = NULL;
    CzError error = {0};
    char **title = NULL;
    int n = 0;
    (void)fuzz_write_file("curve.chn", data, n_byte);
    (void)fuzz_write_file("curve.001", data, n_byte);
    check_refusal(cz_curve_titles("curve.mme", 0, &n, &title, &error), &error);
    for (int i = 0; title != NULL && i < n; i++)
        FUZZ_DEMAND(title[i] != NULL);
    free(title);
    check_refusal(cz_curve_read("curve.mme", &columns, &curve, &error), &error);
    cz_curve_free(curve);
}

static void read_problem(const char *end, const char *optimise) {
    char text[1200];
    CzProblem *problem = NULL;
    CzError error = {0};
    snprintf(text, sizeof text, RIGID_CARS, end, optimise);
    const CzStatus status =
        cz_problem_read_text(text, strlen(text), "input.yaml", ".", NULL, &problem, &error);
    fuzz_check_told(problem, status, &error);
    cz_problem_free(problem);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_byte) {
    const size_t n_head = n_byte < 2 ? n_byte : 2;
    const unsigned choice = n_byte < 2 ? 0 : data[0] | (unsigned)data[1] << 8;
    const char *path = fuzz_write_file("curve.csv", data + n_head, n_byte - n_head);
    fit_curve(path, choice);
    draw_curve(path, choice);
    read_test(data + n_head, n_byte - n_head);
    read_problem("curve: {file: curve.csv, basis: dynamic}", "");
    read_problem(STAGES, MATCH);
    return 0;
}
