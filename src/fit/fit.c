/* Determines the values of a law from a curve: reading, fitting by kind, rounding, values of the
 * file. */
#include "fit/fit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"

CzFitOptions cz_fit_options_default(void) {
    return (CzFitOptions){
        .kind = CZ_FIT_ANTI_CLIMBER, .n_stage = -1, .scale = 1.0, .from = NAN, .to = NAN};
}

/* Builds the loading from stroke 0 on. A curve that begins a little later is extended to 0 with its
 * first force when it begins with force, else with zero. */
static CzStatus make_curve(CzFit *fit, CzError *error) {
    const CzTrace *trace = &fit->trace;
    const int top = trace->n_loading - 1;
    CzBranch path;
    if (!cz_branch_begin(&fit->arena, top + 2, &path) ||
        !cz_branch_begin(&fit->arena, top + 2, &fit->curve))
        return cz_no_memory(error, "a fit");
    if (trace->x[0] > 0.0) {
        const double mean = cz_work(trace->x, trace->f, 0, top) / trace->x[top];
        cz_branch_add(&path, 0.0, trace->f[0] > 0.2 * mean ? trace->f[0] : 0.0);
    }
    for (int i = 0; i <= top; i++)
        cz_branch_add(&path, trace->x[i], trace->f[i]);
    for (int i = 0; i < path.n; i++)
        cz_branch_add(&fit->curve, path.x[i], path.f[i]);
    if (!cz_branch_end(&fit->arena, &fit->curve))
        return cz_no_memory(error, "a fit");
    fit->path_x = path.x;
    fit->path_f = path.f;
    fit->summary.energy = fit->summary.whole_energy =
        cz_work(fit->path_x, fit->path_f, 0, path.n - 1);
    fit->summary.mean_force = fit->summary.energy / cz_branch_last(&fit->curve);
    return CZ_OK;
}

/* ---- values ---- */

/* Adds a value of a record [SI], in the unit of its typed key; `prefix` is the path before the key,
 * such as "tube.". */
static void put(CzFit *fit, CzRecordId record, const char *prefix, const char *typed, double si) {
    const CzUnit *unit = NULL;
    const CzKey *key = cz_record_match(&cz_records[record], typed, &unit);
    if (!isfinite(si) || fit->summary.n_value == CZ_FIT_MAX_VALUES)
        return;
    CzFitValue *next = &fit->value[fit->summary.n_value++];
    snprintf(next->path, sizeof next->path, "%s%s", prefix, typed);
    next->value = si * (1.0 / unit->si);
    const double rounded =
        cz_fit_round(next->value, 1.0); /* the conversion of units changes the last bits */
    if (fabs(rounded - next->value) <= CZ_FIT_ROUNDING * fabs(next->value))
        next->value = rounded;
    const bool is_idle = strcmp(key->stem, "force") == 0 && si <= 0.0; /* absorbs no energy */
    if (fit->beyond == NULL &&
        (is_idle || si < key->lo * (1 - 1e-12) || si > key->hi * (1 + 1e-12)))
        fit->beyond = next;
}

static void put_stages(CzFit *fit, const char *prefix, const CzStaged *staged) {
    for (int i = 0; i < staged->n_stage; i++) {
        char stage[32];
        snprintf(stage, sizeof stage, "%sstages[%d].", prefix, i);
        put(fit, CZ_RECORD_CzStage, stage, "stroke_mm", staged->stage[i].stroke);
        put(fit, CZ_RECORD_CzStage, stage, "force_kN", staged->stage[i].force);
    }
}

/* Adds a stiffness that differs from the problem file's default. */
static void put_unusual(CzFit *fit, CzRecordId record, const char *prefix, const char *typed,
                        double stiffness) {
    const CzUnit *unit = NULL;
    if (stiffness != cz_record_match(&cz_records[record], typed, &unit)->absent)
        put(fit, record, prefix, typed, stiffness);
}

static void put_member(CzFit *fit, CzRecordId record, const char *prefix) {
    const CzStaged *member = &fit->member;
    put_stages(fit, prefix, member);
    put(fit, record, prefix, "trigger_kN", member->trigger);
    if (!isnan(member->trigger))
        put(fit, record, prefix, "trigger_length_mm", member->trigger_length);
    if (fit->summary.is_dynamic)
        put(fit, record, prefix, "rate_factor_s_m", 0.0);
    put_unusual(fit, record, prefix, "stiffness_MN_m", fit->stiffness);
    put_unusual(fit, record, prefix, "bottom_stiffness_MN_m", member->bottom_stiffness);
}

static void put_buffer(CzFit *fit, CzRecordId record, const char *prefix) {
    const CzStaged *buffer = &fit->buffer;
    double steepest = 0.0, force = buffer->preload;
    if (buffer->preload > 0.0)
        put(fit, record, prefix, "preload_kN", buffer->preload);
    put_stages(fit, prefix, buffer);
    put(fit, record, prefix, "unloading_share", fit->share);
    for (int i = 0; i < buffer->n_stage; force = buffer->stage[i++].force)
        steepest = fmax(steepest, (buffer->stage[i].force - force) / buffer->stage[i].stroke);
    if (steepest > cz_fit_key(record, "transition_stiffness")->absent)
        put(fit, record, prefix, "transition_stiffness_MN_m", cz_fit_round(1.001 * steepest, 1e6));
    put_unusual(fit, record, prefix, "bottom_stiffness_MN_m", buffer->bottom_stiffness);
    if (fit->summary.is_dynamic)
        put(fit, record, prefix, "damping_kN_s_m", 0.0);
}

static void put_shear_off(CzFit *fit, CzRecordId record, const char *prefix) {
    put(fit, record, prefix, "force_kN", fit->shear_force);
    if (fit->residual > 0.0)
        put(fit, record, prefix, "residual_force_kN", fit->residual);
    put(fit, record, prefix, "softening_length_mm", fit->softening);
    put(fit, record, prefix, "retraction_space_mm", fit->retraction);
}

static void put_end(CzFit *fit, CzRecordId record) {
    put_stages(fit, "", &fit->member);
    put(fit, record, "", "unloading_stiffness_MN_m", fit->unloading);
    put(fit, record, "", "unloading_share", fit->share);
    put(fit, record, "", "second_unloading_stiffness_MN_m", fit->second_unloading);
    put_unusual(fit, record, "", "bottom_stiffness_MN_m", fit->member.bottom_stiffness);
}

/* Lists the values of the law; fails for one outside the range of its key. */
static CzStatus put_values(CzFit *fit, CzError *error) {
    char why[160];
    if (fit->summary.kind == CZ_FIT_END) {
        put_end(fit, CZ_RECORD_CzEnd);
    } else if (fit->summary.kind == CZ_FIT_ANTI_CLIMBER) {
        put_member(fit, CZ_RECORD_CzAntiClimber, "");
    } else {
        put_buffer(fit, CZ_RECORD_CzBuffer, "buffer.");
        if (fit->member.n_stage > 0)
            put_member(fit, CZ_RECORD_CzTube, "tube.");
        put_shear_off(fit, CZ_RECORD_CzShearOff, "shear_off.");
    }
    if (fit->beyond == NULL)
        return CZ_OK;
    snprintf(why, sizeof why, "%.80s would be %s, which is outside the range of a problem file",
             fit->beyond->path, CZ_SHORT(fit->beyond->value));
    return cz_fit_no_law(fit, error, why);
}

/* ---- the steps of a fit ---- */

static CzStatus check_stages(const CzFitOptions *options, CzError *error) {
    const int least = options->kind == CZ_FIT_COUPLER ? 0 : 1;
    const int most = options->kind == CZ_FIT_END ? 4 : CZ_MAX_STAGES;
    if (options->n_stage == -1 || (options->n_stage >= least && options->n_stage <= most))
        return CZ_OK;
    return cz_fail(error, CZ_STATUS_INPUT, "%d stages; a law of kind %s has %d to %d",
                   options->n_stage, cz_fit_kind_word(options->kind), least, most);
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
    summary->returned = trace->unloads ? -cz_work(trace->x, trace->f, top, trace->n - 1) : NAN;
    summary->law_returned = NAN;
    if (summary->kind == CZ_FIT_COUPLER)
        CZ_TRY(cz_fit_coupler(fit, n_stage, error));
    else if (summary->kind == CZ_FIT_END)
        CZ_TRY(cz_fit_end(fit, n_stage, error));
    else
        CZ_TRY(cz_fit_plastic(fit, n_stage, error));
    cz_fit_add_note(
        fit,
        summary->is_dynamic
            ? "dynamic: the curve contains the rate effect, so rate factor and damping are zero"
            : "static: the curve contains no rate effect");
    summary->law_energy = cz_fit_law_energy(fit);
    cz_fit_compare(fit);
    cz_fit_judge(fit);
    cz_fit_load_full_stroke(fit, &fit->whole);
    summary->value = fit->value;
    summary->curve = (CzFitLoading){fit->curve.n, fit->curve.x, fit->curve.f};
    summary->law = (CzFitLoading){fit->whole.n, fit->whole.x, fit->whole.f};
    return put_values(fit, error);
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

/* Fits the curve of a file, or of points when `path` is NULL. */
static CzStatus make(const char *path, int n_point, const double *stroke, const double *force,
                     const CzFitOptions *given, CzFit **fit, CzError *error) {
    const CzFitOptions usual = cz_fit_options_default();
    const CzFitOptions *options = given != NULL ? given : &usual;
    *fit = NULL;
    CZ_TRY(check_stages(options, error));
    CzFit *begun = begin(path, options);
    if (begun == NULL)
        return cz_no_memory(error, "a fit");
    CzStatus status = path != NULL
                          ? cz_fit_read_trace(begun, path, options, error)
                          : cz_fit_take_points(begun, n_point, stroke, force, options, error);
    if (status == CZ_OK)
        status = fit_law(begun, options->n_stage, error);
    if (status == CZ_OK && begun->arena.out_of_memory) /* a sentence may be missing */
        status = cz_no_memory(error, "a fit");
    if (status == CZ_OK)
        *fit = begun;
    else
        cz_fit_free(begun);
    return status;
}

CzStatus cz_fit_read(const char *path, const CzFitOptions *options, CzFit **fit, CzError *error) {
    return make(path, 0, NULL, NULL, options, fit, error);
}

CzStatus cz_fit_points(int n_point, const double *stroke, const double *force,
                       const CzFitOptions *options, CzFit **fit, CzError *error) {
    return make(NULL, n_point, stroke, force, options, fit, error);
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
