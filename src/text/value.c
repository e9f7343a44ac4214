/* Converts texts to numbers, counts and flags. */
#include "text/value.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "crushzone/names.h"

/* Tolerance at the ends of a range for rounding in the conversion of units. */
static const double ROUNDING = 1e-12;

bool cz_value_exists(CzValue value) {
    const CzNode *node = value.node;
    if (node->kind != CZ_NODE_TEXT) {
        cz_mistake(value.mistakes, node, value.trail, "'%s' needs one value, but this is %s",
                   value.key, cz_node_what(node));
        return false;
    }
    if (cz_node_is_null(node) || (!node->quoted && node->text[0] == '\0')) {
        cz_mistake(value.mistakes, node, value.trail, "'%s' has no value", value.key);
        return false;
    }
    return true;
}

/* Whether a node is a value without quotes. */
static bool is_bare(CzValue value, const char *what) {
    if (!cz_value_exists(value))
        return false;
    if (value.node->quoted)
        cz_mistake(value.mistakes, value.node, value.trail,
                   "'%s' needs %s, but \"%.60s\" is text in quotes", value.key, what,
                   value.node->text);
    return !value.node->quoted;
}

/* Rejects a text of the wrong kind. */
static bool refuse(CzValue value, const char *wrong) {
    cz_mistake(value.mistakes, value.node, value.trail, "%s: '%.60s' %s", value.key,
               value.node->text, wrong);
    return false;
}

static bool is_in_range(CzValue value, const CzUnit *unit, double lo, double hi, double si) {
    const bool is_low = si < lo - ROUNDING * fabs(lo);
    const bool is_high = si > hi + ROUNDING * fabs(hi);
    if (!is_low && !is_high)
        return true;
    cz_mistake(value.mistakes, value.node, value.trail, "%s: %.60s is %s allowed %s%s%s", value.key,
               value.node->text, is_low ? "below the smallest" : "above the largest",
               CZ_SHORT((is_low ? lo : hi) / unit->si), unit->symbol[0] != '\0' ? " " : "",
               unit->symbol);
    return false;
}

bool cz_value_number(CzValue value, const CzUnit *unit, double lo, double hi, double *number) {
    double typed;
    if (value.node->match > 0)
        return true;
    *number = NAN; /* NaN violates no rule */
    if (!is_bare(value, "a number"))
        return false;
    const char *wrong = cz_number_parse(value.node->text, &typed);
    if (wrong != NULL)
        return refuse(value, wrong);
    if (!is_in_range(value, unit, lo, hi, typed * unit->si))
        return false;
    *number = typed * unit->si;
    return true;
}

bool cz_value_count(CzValue value, double lo, double hi, int *count) {
    double typed;
    if (!is_bare(value, "a whole number"))
        return false;
    const char *wrong = cz_number_parse(value.node->text, &typed);
    if (wrong == NULL && (typed != floor(typed) || strpbrk(value.node->text, ".eE") != NULL))
        wrong = "is not a whole number";
    if (wrong != NULL)
        return refuse(value, wrong);
    if (!is_in_range(value, cz_unit_si(CZ_DIMENSION_NONE), lo, hi, typed))
        return false;
    *count = (int)typed;
    return true;
}

bool cz_value_flag(CzValue value, bool *flag) {
    if (!is_bare(value, "true or false"))
        return false;
    const bool is_true = strcmp(value.node->text, "true") == 0;
    if (!is_true && strcmp(value.node->text, "false") != 0)
        return refuse(value, "is neither true nor false");
    *flag = is_true;
    return true;
}

const char *cz_value_text(CzValue value) {
    if (!cz_value_exists(value))
        return NULL;
    const char *text = value.node->text;
    if (text[strspn(text, " ")] == '\0') {
        cz_mistake(value.mistakes, value.node, value.trail, "'%s' is an empty text", value.key);
        return NULL;
    }
    if (strlen(text) > CZ_MAX_TEXT)
        cz_mistake(value.mistakes, value.node, value.trail, "'%s' has more than %d bytes",
                   value.key, (int)CZ_MAX_TEXT);
    return text;
}
