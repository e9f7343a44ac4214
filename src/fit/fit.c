/* From a curve to the values of a law: reading, fitting by kind, rounding, reporting. */
#include "fit/fit.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"

#define FAR_OFF 0.5    /* that equal energy may move a force by: more is no fit (ours) */
#define ROUNDING 1e-13 /* what a sum may be off by, as a share of it */

static const struct {
    const char *word, *doc;
} kinds[CZ_N_FIT] = {
#define CZ_FIT(constant, word, record, doc) [constant] = {word, doc},
#include "crushzone/fits.def"
#undef CZ_FIT
};

const char *cz_fit_kind_word(CzFitKind kind) {
    return kinds[kind].word;
}

const char *cz_fit_kind_doc(CzFitKind kind) {
    return kinds[kind].doc;
}

CzFitOptions cz_fit_options_default(void) {
    return (CzFitOptions){
        .kind = CZ_FIT_ANTI_CLIMBER, .n_stage = -1, .scale = 1.0, .from = NAN, .to = NAN};
}

const CzKey *cz_fit_key(CzRecordId record, const char *stem) {
    return cz_record_key(&cz_records[record], stem);
}

void cz_fit_note_down(CzFit *fit, const char *format, ...) {
    va_list arguments;
    if (fit->n_note == CZ_FIT_MOST_NOTES)
        return;
    va_start(arguments, format);
    vsnprintf(fit->note[fit->n_note], sizeof fit->note[0], format, arguments);
    va_end(arguments);
    fit->n_note++;
}

/* ---- curves ---- */

double cz_fit_work(const CzFit *fit, int point) {
    double work = 0.0;
    for (int i = 1; i <= point; i++)
        work += 0.5 * (fit->path_f[i] + fit->path_f[i - 1]) * (fit->path_x[i] - fit->path_x[i - 1]);
    return work;
}

CzStatus cz_fit_branch(CzFit *fit, double stiffness, CzBranch *branch, CzError *error) {
    const int n = fit->curve.n;
    double *x = cz_arena_allocate(&fit->arena, (size_t)n, sizeof *x);
    if (x == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a fit");
    for (int i = 0; i < n; i++)
        x[i] = fmax(fit->path_x[i] - fit->path_f[i] / stiffness, 0.0);
    x[0] = 0.0;
    if (!cz_branch_build(&fit->arena, n, x, fit->path_f, branch))
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a fit");
    return CZ_OK;
}

/* The loading, from stroke 0 on: a curve that begins a little later has its first force there when
 * it begins with force, else none. */
static CzStatus make_curve(CzFit *fit, CzError *error) {
    const CzTrace *trace = &fit->trace;
    const size_t room = (size_t)trace->n_loading + 1;
    int n = 0;
    fit->path_x = cz_arena_allocate(&fit->arena, room, sizeof *fit->path_x);
    fit->path_f = cz_arena_allocate(&fit->arena, room, sizeof *fit->path_f);
    if (fit->path_x == NULL || fit->path_f == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a fit");
    if (trace->x[0] > 0.0) {
        const double mean =
            cz_trace_work(trace, 0, trace->n_loading - 1) / trace->x[trace->n_loading - 1];
        fit->path_f[n++] = trace->f[0] > 0.2 * mean ? trace->f[0] : 0.0;
    }
    for (int i = 0; i < trace->n_loading; i++) {
        fit->path_x[n] = trace->x[i];
        fit->path_f[n++] = trace->f[i];
    }
    if (!cz_branch_build(&fit->arena, n, fit->path_x, fit->path_f, &fit->curve))
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a fit");
    fit->summary.energy = fit->summary.whole_energy = cz_fit_work(fit, n - 1);
    fit->summary.mean_force = fit->summary.energy / cz_branch_last(&fit->curve);
    return CZ_OK;
}

/* ---- rounding ---- */

static bool is_close(double a, double b) {
    return fabs(a - b) <= ROUNDING * fabs(b);
}

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
 * factor that the forces got; stage -1 represents all. */
static double settle_energy(CzFit *fit, CzStaged *staged, int stage) {
    const CzStaged found = *staged;
    double factor = 1.0;
    for (int i = 0; i < 20; i++) {
        const double wanted = fit->summary.energy, by = 1e-6;
        const double now = cz_fit_law_energy(fit);
        if (fabs(wanted - now) <= ROUNDING * wanted)
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

void cz_fit_let_rise(CzStaged *staged) {
    double force = staged->preload;
    for (int i = 0; i < staged->n_stage; i++)
        force = staged->stage[i].force = fmax(staged->stage[i].force, force);
}

/* A curve that was read well and that no law follows: the same answer as a law that is refused. */
static CzStatus no_law(const CzFit *fit, CzError *error, const char *why) {
    const CzStatus status = cz_fail(error, CZ_STATUS_VIOLATED, "no law as %s fits this curve: %s",
                                    cz_fit_kind_word(fit->summary.kind), why);
    if (error == NULL)
        return status;
    snprintf(error->file, sizeof error->file, "%s",
             fit->summary.file != NULL ? fit->summary.file : "");
    snprintf(error->help, sizeof error->help,
             "try another --as, --from or --to, and check the units");
    return status;
}

CzStatus cz_fit_settle(CzFit *fit, CzStaged *staged, const CzBranch *branch, CzError *error) {
    const bool must_rise = staged == &fit->buffer;
    round_strokes(staged);
    for (int i = 0; i < 3; i++) { /* the elastic part depends on the last force a little */
        CzStaged found = *staged;
        const double others = cz_fit_law_energy(fit) - cz_staged_energy(staged);
        if (cz_staged_solve(&found, branch, fit->summary.energy - others) < INFINITY)
            *staged = found;
    }
    if (must_rise)
        cz_fit_let_rise(staged);
    round_forces(staged);
    const double factor = settle_energy(fit, staged, must_rise ? -1 : longest_of(staged));
    if (staged->trigger < staged->stage[0].force) { /* a peak that is none any more */
        staged->trigger = NAN;
        return cz_fit_settle(fit, staged, branch, error);
    }
    if (fabs(factor - 1.0) <= FAR_OFF)
        return CZ_OK;
    return no_law(fit, error, "stages of equal energy differ too much from its force");
}

/* ---- values ---- */

__attribute__((format(printf, 3, 4))) static void put(CzFit *fit, double value, const char *format,
                                                      ...) {
    va_list arguments;
    if (!isfinite(value) || fit->n_value == CZ_FIT_MOST_VALUES)
        return;
    va_start(arguments, format);
    vsnprintf(fit->value[fit->n_value].path, sizeof fit->value[0].path, format, arguments);
    va_end(arguments);
    const double rounded = cz_fit_round(value, 1.0); /* a change of units costs the last bits */
    fit->value[fit->n_value++].value = is_close(rounded, value) ? rounded : value;
}

static void put_stages(CzFit *fit, const char *record, const CzStaged *staged) {
    for (int i = 0; i < staged->n_stage; i++) {
        put(fit, 1e3 * staged->stage[i].stroke, "%sstages[%d].stroke_mm", record, i);
        put(fit, 1e-3 * staged->stage[i].force, "%sstages[%d].force_kN", record, i);
    }
}

/* A value that differs from the problem file's default. */
static void put_unusual(CzFit *fit, double value, CzRecordId id, const char *stem, double unit,
                        const char *path) {
    if (value != cz_fit_key(id, stem)->absent)
        put(fit, value / unit, "%s", path);
}

static void put_member(CzFit *fit, const char *record) {
    const CzStaged *member = &fit->member;
    put_stages(fit, record, member);
    put(fit, 1e-3 * member->trigger, "%strigger_kN", record);
    if (!isnan(member->trigger))
        put(fit, 1e3 * member->trigger_length, "%strigger_length_mm", record);
    if (fit->summary.is_dynamic)
        put(fit, 0.0, "%srate_factor_s_m", record);
}

static void put_coupler(CzFit *fit) {
    const CzStaged *buffer = &fit->buffer;
    double steepest = 0.0, force = buffer->preload;
    if (buffer->preload > 0.0)
        put(fit, 1e-3 * buffer->preload, "buffer.preload_kN");
    put_stages(fit, "buffer.", buffer);
    put(fit, fit->share, "buffer.unloading_share");
    for (int i = 0; i < buffer->n_stage; force = buffer->stage[i++].force)
        steepest = fmax(steepest, (buffer->stage[i].force - force) / buffer->stage[i].stroke);
    if (steepest > cz_fit_key(CZ_RECORD_CzBuffer, "transition_stiffness")->absent)
        put(fit, cz_fit_round(1.001 * steepest, 1e6) * 1e-6, "buffer.transition_stiffness_MN_m");
    put_unusual(fit, buffer->bottom_stiffness, CZ_RECORD_CzBuffer, "bottom_stiffness", 1e6,
                "buffer.bottom_stiffness_MN_m");
    if (fit->summary.is_dynamic)
        put(fit, 0.0, "buffer.damping_kN_s_m");
    if (fit->member.n_stage > 0) {
        put_member(fit, "tube.");
        put_unusual(fit, fit->stiffness, CZ_RECORD_CzTube, "stiffness", 1e6, "tube.stiffness_MN_m");
        put_unusual(fit, fit->member.bottom_stiffness, CZ_RECORD_CzTube, "bottom_stiffness", 1e6,
                    "tube.bottom_stiffness_MN_m");
    }
    put(fit, 1e-3 * fit->shear_force, "shear_off.force_kN");
    if (fit->residual > 0.0)
        put(fit, 1e-3 * fit->residual, "shear_off.residual_force_kN");
    put(fit, 1e3 * fit->softening, "shear_off.softening_length_mm");
    put(fit, 1e3 * fit->retraction, "shear_off.retraction_space_mm");
}

static void put_values(CzFit *fit) {
    switch (fit->summary.kind) {
    case CZ_FIT_COUPLER:
        put_coupler(fit);
        break;
    case CZ_FIT_END:
        put_stages(fit, "", &fit->member);
        put(fit, 1e-6 * fit->unloading, "unloading_stiffness_MN_m");
        put(fit, fit->share, "unloading_share");
        put(fit, 1e-6 * fit->second_unloading, "second_unloading_stiffness_MN_m");
        put_unusual(fit, fit->member.bottom_stiffness, CZ_RECORD_CzEnd, "bottom_stiffness", 1e6,
                    "bottom_stiffness_MN_m");
        break;
    default:
        put_member(fit, "");
        put_unusual(fit, fit->stiffness, CZ_RECORD_CzAntiClimber, "stiffness", 1e6,
                    "stiffness_MN_m");
        put_unusual(fit, fit->member.bottom_stiffness, CZ_RECORD_CzAntiClimber, "bottom_stiffness",
                    1e6, "bottom_stiffness_MN_m");
    }
}

/* The record of the problem file that a value's path leads into. */
static CzRecordId record_of(const CzFit *fit, const char *path) {
    if (strstr(path, "stages[") != NULL)
        return CZ_RECORD_CzStage;
    if (fit->summary.kind == CZ_FIT_END)
        return CZ_RECORD_CzEnd;
    return strncmp(path, "buffer.", 7) == 0       ? CZ_RECORD_CzBuffer
           : strncmp(path, "shear_off.", 10) == 0 ? CZ_RECORD_CzShearOff
           : strncmp(path, "tube.", 5) == 0       ? CZ_RECORD_CzTube
                                                  : CZ_RECORD_CzAntiClimber;
}

/* Every value is one that the problem file takes. */
static CzStatus check_values(const CzFit *fit, CzError *error) {
    char number[CZ_NUMBER_TEXT], why[160];
    for (int i = 0; i < fit->n_value; i++) {
        const char *path = fit->value[i].path, *point = strrchr(path, '.');
        const CzUnit *unit = NULL;
        const CzKey *key = cz_record_match(&cz_records[record_of(fit, path)],
                                           point != NULL ? point + 1 : path, &unit);
        const double value = key != NULL ? fit->value[i].value * unit->si : NAN;
        const bool is_force = key != NULL && strcmp(key->stem, "force") == 0;
        if (key != NULL && value >= key->lo * (1 - 1e-12) && value <= key->hi * (1 + 1e-12) &&
            !(is_force && value <= 0.0)) /* a stage without force absorbs nothing */
            continue;
        snprintf(why, sizeof why, "%.80s would be %s, which is outside the range of a problem file",
                 path, cz_number_print_short(number, fit->value[i].value));
        return no_law(fit, error, why);
    }
    return CZ_OK;
}

/* ---- the way through ---- */

static CzStatus check_stages(const CzFitOptions *options, CzError *error) {
    const int least = options->kind == CZ_FIT_COUPLER ? 0 : 1;
    const int most = options->kind == CZ_FIT_END ? 4 : CZ_MAX_STAGES;
    if (options->n_stage == -1 || (options->n_stage >= least && options->n_stage <= most))
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_INPUT, "%d stages; a law as %s has %d to %d", options->n_stage,
                   cz_fit_kind_word(options->kind), least, most);
}

static CzStatus fit_law(CzFit *fit, int n_stage, CzError *error) {
    CzFitSummary *summary = &fit->summary;
    const CzTrace *trace = &fit->trace;
    const int top = trace->n_loading - 1;
    CZ_TRY(make_curve(fit, error));
    summary->n_point = trace->n;
    summary->stroke = trace->x[top];
    for (int i = 0; i < trace->n; i++)
        summary->peak_force = fmax(summary->peak_force, trace->f[i]);
    summary->returned = trace->unloads ? -cz_trace_work(trace, top, trace->n - 1) : NAN;
    summary->law_returned = NAN;
    if (summary->kind == CZ_FIT_COUPLER)
        CZ_TRY(cz_fit_coupler(fit, n_stage, error));
    else if (summary->kind == CZ_FIT_END)
        CZ_TRY(cz_fit_end(fit, n_stage, error));
    else
        CZ_TRY(cz_fit_plastic(fit, n_stage, error));
    cz_fit_note_down(fit, summary->is_dynamic
                              ? "dynamic: the curve contains the rate effect, so nothing may "
                                "add it again"
                              : "static: the curve contains no rate effect");
    summary->law_energy = cz_fit_law_energy(fit);
    cz_fit_compare(fit);
    cz_fit_judge(fit);
    cz_fit_load_whole(fit, &fit->whole);
    put_values(fit);
    return check_values(fit, error);
}

/* Name of the part: the one requested, or the file's without folder and ending; in letters, digits,
 * '-' and '_'. */
static const char *part_name(CzArena *arena, const char *path, const CzFitOptions *options) {
    const char *slash = path != NULL ? strrchr(path, '/') : NULL;
    const char *base = slash != NULL ? slash + 1 : path;
    if (options->name != NULL)
        base = options->name;
    else if (base == NULL || strcmp(base, "-") == 0)
        base = cz_fit_kind_word(options->kind);
    const size_t n = strcspn(base, ".");
    char *name = cz_arena_copy_text(arena, n > 0 ? base : "curve", n > 0 ? n : 5);
    for (char *c = name; c != NULL && *c != '\0'; c++)
        if (!((*c >= 'a' && *c <= 'z') || (*c >= 'A' && *c <= 'Z') || (*c >= '0' && *c <= '9') ||
              *c == '_'))
            *c = '-';
    return name;
}

static CzFit *begin(const char *path, const CzFitOptions *options) {
    CzFit *fit = calloc(1, sizeof *fit);
    if (fit == NULL)
        return NULL;
    fit->buffer = cz_staged_begin(false);
    fit->member = cz_staged_begin(options->kind != CZ_FIT_END);
    fit->shear_force = fit->softening = fit->retraction = NAN;
    fit->unloading = fit->share = fit->second_unloading = fit->stop_force = NAN;
    fit->summary = (CzFitSummary){.kind = options->kind, .is_dynamic = options->is_dynamic != 0};
    if (path != NULL)
        fit->summary.file = cz_arena_copy_text(&fit->arena, path, strlen(path));
    fit->summary.name = part_name(&fit->arena, path, options);
    return fit;
}

/* Hands the fit over, or frees it and passes the failure on. */
static CzStatus finish(CzFit *fit, CzStatus status, CzFit **result) {
    if (status == CZ_OK)
        *result = fit;
    else
        cz_fit_free(fit);
    return status;
}

CzStatus cz_fit_read(const char *path, const CzFitOptions *options, CzFit **fit, CzError *error) {
    const CzFitOptions usual = cz_fit_options_default();
    const CzFitOptions *chosen = options != NULL ? options : &usual;
    *fit = NULL;
    CZ_TRY(check_stages(chosen, error));
    CzFit *begun = begin(path, chosen);
    if (begun == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a fit");
    CzStatus status = cz_fit_read_trace(begun, path, chosen, error);
    if (status == CZ_OK)
        status = fit_law(begun, chosen->n_stage, error);
    return finish(begun, status, fit);
}

CzStatus cz_fit_points(int n_point, const double *stroke, const double *force,
                       const CzFitOptions *options, CzFit **fit, CzError *error) {
    const CzFitOptions usual = cz_fit_options_default();
    const CzFitOptions *chosen = options != NULL ? options : &usual;
    *fit = NULL;
    CZ_TRY(check_stages(chosen, error));
    CzFit *begun = begin(NULL, chosen);
    if (begun == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for a fit");
    CzStatus status = cz_fit_take_points(begun, n_point, stroke, force, chosen, error);
    if (status == CZ_OK)
        status = fit_law(begun, chosen->n_stage, error);
    return finish(begun, status, fit);
}

void cz_fit_free(CzFit *fit) {
    if (fit == NULL)
        return;
    cz_arena_free(&fit->arena);
    free(fit);
}

const CzFitSummary *cz_fit_summary(const CzFit *fit) {
    return &fit->summary;
}

int cz_fit_n_value(const CzFit *fit) {
    return fit->n_value;
}

const char *cz_fit_value_path(const CzFit *fit, int index) {
    return fit->value[index].path;
}

double cz_fit_value(const CzFit *fit, int index) {
    return fit->value[index].value;
}

int cz_fit_n_note(const CzFit *fit) {
    return fit->n_note;
}

const char *cz_fit_note(const CzFit *fit, int index) {
    return fit->note[index];
}
