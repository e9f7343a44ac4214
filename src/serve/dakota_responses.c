/* Responses of an evaluation by their names. */
#include "serve/dakota_responses.h"

#include "base/error.h"
#include "base/suggest.h"
#include "evaluate/evaluator.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- names ---- */

static const char *skip_signs(const char *at) {
    while (*at != '\0' && !isalnum((unsigned char)*at) && (unsigned char)*at < 0x80)
        at++;
    return at;
}

/* Whether two names have the same letters and digits. */
static bool reads_alike(const char *a, const char *b) {
    for (a = skip_signs(a), b = skip_signs(b); *a != '\0' && *a == *b;
         a = skip_signs(a + 1), b = skip_signs(b + 1))
        ;
    return *a == *b;
}

/* Writes a name as one word: "margin.interface_force". */
static void write_word(char *word, size_t size, const char *name) {
    size_t n = (size_t)snprintf(word, size, "margin.");
    for (const char *c = name; *c != '\0' && n + 1 < size; c++) {
        const bool is_sign = *c == ' ' || *c == ',';
        if (is_sign && word[n - 1] == '_')
            continue;
        word[n++] = is_sign ? '_' : *c;
    }
    word[n] = '\0';
}

/* Finds checks of a name and a scenario; else reports the nearest name. */
static CzStatus find_checks(const CzEvaluator *evaluator, const char *text,
                            const CzResponse *response, CzError *error) {
    const size_t n = (size_t)cz_evaluator_n_check(evaluator);
    const char **names = calloc(2 * n + 1, sizeof *names), **scenario = names + n;
    CzSuggestion nearest = {0};
    bool is_there = false;
    if (names == NULL)
        return cz_no_memory(error, "the checks");
    cz_evaluator_name_checks(evaluator, names, scenario);
    for (size_t i = 0; i < n && !is_there; i++) {
        char word[CZ_LABEL_SIZE + 16];
        is_there = reads_alike(names[i], response->name) &&
                   (response->scenario == NULL ||
                    (scenario[i] != NULL && strcmp(scenario[i], response->scenario) == 0));
        write_word(word, sizeof word, names[i]);
        cz_suggest(&nearest, text, word);
    }
    free(names);
    if (is_there)
        return CZ_OK;
    cz_fail(error, CZ_STATUS_INPUT, "there is no check '%.100s'%s%.60s", response->name,
            response->scenario != NULL ? " in scenario " : "",
            response->scenario != NULL ? response->scenario : "");
    cz_suggest_help(&nearest, error);
    return CZ_STATUS_INPUT;
}

CzStatus cz_response_read(const CzEvaluator *evaluator, CzArena *arena, const char *text,
                          CzResponse *response, CzError *error) {
    static const char margin[] = "margin.";
    static const struct {
        const char *name;
        CzResponseKind kind;
    } words[] = {{"objective", CZ_RESPONSE_OBJECTIVE},
                 {"violation", CZ_RESPONSE_VIOLATION},
                 {"smallest_margin", CZ_RESPONSE_SMALLEST_MARGIN}};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(text, words[i].name) == 0) {
            *response = (CzResponse){.kind = words[i].kind, .name = words[i].name};
            return CZ_OK;
        }
    *response = (CzResponse){.kind = CZ_RESPONSE_METRIC, .name = text};
    if (strncmp(text, margin, sizeof margin - 1) != 0)
        return CZ_OK;
    char *name = cz_arena_copy_text(arena, text + sizeof margin - 1, strlen(text));
    if (name == NULL)
        return cz_no_memory(error, "the responses");
    response->kind = CZ_RESPONSE_MARGIN;
    response->name = name;
    char *at = strrchr(name, '@');
    if (at != NULL) {
        *at = '\0';
        response->scenario = at + 1;
    }
    return find_checks(evaluator, text, response, error);
}

/* ---- values ---- */

/* The margin of a check as a number: without one 1 where it is satisfied or does not apply, -1
 * where it fails; NaN when it was not made. */
static double margin_of(const CzCheckResult *check) {
    if (check->verdict == CZ_VERDICT_NOT_CHECKED)
        return NAN;
    if (!isnan(check->margin))
        return check->margin;
    return check->verdict == CZ_VERDICT_FAIL ? -1 : 1;
}

static double smallest_margin(const CzEvaluation *evaluation, const char **why) {
    double smallest = INFINITY;
    for (int i = 0; i < evaluation->n_check; i++)
        smallest = fmin(smallest, evaluation->check[i].margin); /* ignores NaN */
    *why = "no check has a margin";
    return isfinite(smallest) ? smallest : NAN;
}

static double margin_of_name(const CzResponse *response, const CzEvaluation *evaluation,
                             const char **why) {
    double smallest = INFINITY;
    for (int i = 0; i < evaluation->n_check; i++) {
        const CzCheckResult *check = &evaluation->check[i];
        if (!reads_alike(check->name, response->name) ||
            (response->scenario != NULL && strcmp(check->scenario, response->scenario) != 0))
            continue;
        const double margin = margin_of(check);
        *why = check->why != NULL ? check->why : "the check was not made";
        if (isnan(margin))
            return NAN;
        smallest = fmin(smallest, margin);
    }
    if (isfinite(smallest))
        return smallest;
    *why = "the design has no such check";
    return NAN;
}

double cz_response_value(const CzResponse *response, const CzEvaluation *evaluation,
                         const char **why) {
    *why = "it is not known";
    switch (response->kind) {
    case CZ_RESPONSE_OBJECTIVE:
        return evaluation->objective;
    case CZ_RESPONSE_VIOLATION:
        return evaluation->violation;
    case CZ_RESPONSE_SMALLEST_MARGIN:
        return smallest_margin(evaluation, why);
    case CZ_RESPONSE_MARGIN:
        return margin_of_name(response, evaluation, why);
    case CZ_RESPONSE_METRIC:
        *why = "it is not known, does not apply, or is a total of a run with an override";
        return evaluation->value[response->metric].value;
    }
    return NAN;
}
