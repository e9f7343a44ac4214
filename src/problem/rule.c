/* Reports the violated rule and its place. */
#include "problem/rules.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "base/number.h"

CzRules cz_rules_of(CzProblem *problem) {
    CzReader *reader = &problem->reader;
    return (CzRules){
        problem,           reader, &problem->input, problem->vehicle, &reader->mistakes,
        &reader->warnings, NULL};
}

/* Place of a field; a candidate's values are where the problem's own were written. */
static const CzPlace *find_place(const CzRules *rules, const void *field) {
    const uintptr_t at = (uintptr_t)field, start = (uintptr_t)rules->vehicle;
    const size_t n_byte = (size_t)rules->problem->n_vehicle * sizeof(CzVehicle);
    const void *own = field;
    if (at >= start && at - start < n_byte)
        own = (const char *)rules->problem->vehicle + (at - start);
    return cz_places_find(&rules->problem->places, own);
}

static void list_mistake(const CzRules *rules, CzMistakes *mistakes, const void *field,
                         const char *format, va_list arguments) {
    const CzPlace *place = find_place(rules, field);
    if (place == NULL || mistakes == NULL)
        return;
    const bool is_value = place->value != NULL && place->value->kind == CZ_NODE_TEXT;
    cz_mistake_list(mistakes, is_value ? place->value : place->node, place->trail, format,
                    arguments);
}

void cz_rule_broken(const CzRules *rules, const void *field, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    list_mistake(rules, rules->mistakes, field, format, arguments);
    va_end(arguments);
}

void cz_rule_warning(const CzRules *rules, const void *field, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    list_mistake(rules, rules->warnings, field, format, arguments);
    va_end(arguments);
}

void cz_rule_absent(const CzRules *rules, const void *field, const char *format, ...) {
    va_list arguments;
    if (rules->reader->has_holes)
        return;
    va_start(arguments, format);
    list_mistake(rules, rules->mistakes, field, format, arguments);
    va_end(arguments);
}

bool cz_rule_is_written(const CzRules *rules, const void *field) {
    const CzPlace *place = find_place(rules, field);
    return place != NULL && place->size == 0;
}

bool cz_rule_is_general(const CzRules *rules, const void *field) {
    const CzPlace *place = find_place(rules, field);
    return place != NULL && place->node->source->is_general;
}

const char *cz_rule_text(char text[48], double si, const char *unit, double unit_si) {
    snprintf(text, 48, "%s %s", CZ_SHORT(si / unit_si), unit);
    return text;
}

bool cz_rule_note(const CzRules *rules, CzValueRule rule, double value, double most) {
    if (rules->ratio != NULL && !isnan(value) && !isnan(most)) {
        const double far_off = 1e3; /* finite, for a limit of 0 */
        const double ratio = most > 0 ? fmin(value / most, far_off) : value > 0 ? far_off : 0;
        rules->ratio[rule] = fmax(rules->ratio[rule], ratio); /* ignores NaN */
    }
    return value > most;
}
