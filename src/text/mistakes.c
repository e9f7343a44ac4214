/* Collects and sorts mistakes, and names the part through which they came. */
#include "text/mistakes.h"

#include "base/error.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void append_trail(CzError *error, const CzTrail *trail) {
    char sentence[2 * sizeof error->message];
    size_t n = (size_t)snprintf(sentence, sizeof sentence, "%s", error->message);
    for (; trail != NULL && trail->part != NULL && n < sizeof sentence; trail = trail->from) {
        n += (size_t)snprintf(sentence + n, sizeof sentence - n, "; in part '%s' (%s:%d)",
                              trail->part, trail->written->source->name, trail->written->line);
        if (trail->used != NULL && n < sizeof sentence)
            n += (size_t)snprintf(sentence + n, sizeof sentence - n, ", used at %s:%d",
                                  trail->used->source->name, trail->used->line);
    }
    cz_text_copy(error->message, sizeof error->message, sentence);
}

static bool is_known(const CzMistakes *mistakes, const CzError *error) {
    const size_t n = strlen(error->message);
    for (int i = 0; i < mistakes->n_mistake; i++) {
        const CzMistake *known = mistakes->mistake[i];
        if (known->error.line == error->line && known->error.column == error->column &&
            (size_t)known->n_stated == n && memcmp(known->error.message, error->message, n) == 0 &&
            strcmp(known->error.file, error->file) == 0)
            return true;
    }
    return false;
}

static void add(CzMistakes *mistakes, const CzError *error, int order, const CzTrail *trail) {
    mistakes->last = NULL;
    if (is_known(mistakes, error))
        return;
    if (mistakes->n_mistake == CZ_MAX_MISTAKES) {
        mistakes->n_left_out++;
        return;
    }
    CzMistake *mistake = cz_arena_allocate(mistakes->arena, 1, sizeof *mistake);
    if (mistake == NULL)
        return;
    mistake->error = *error;
    mistake->order = order;
    mistake->n_stated = (int)strlen(error->message);
    append_trail(&mistake->error, trail);
    mistakes->mistake[mistakes->n_mistake++] = mistake;
    mistakes->last = mistake;
}

void cz_error_place(CzError *error, const CzNode *place) {
    cz_text_copy(error->file, sizeof error->file, place->source->name);
    error->line = place->line;
    error->column = place->column;
}

void cz_mistake_list(CzMistakes *mistakes, const CzNode *place, const CzTrail *trail,
                     const char *format, va_list arguments) {
    CzError error = {.status = CZ_STATUS_INPUT};
    cz_error_place(&error, place);
    cz_error_format(&error, format, arguments);
    add(mistakes, &error, place->source->order, trail);
}

void cz_mistake(CzMistakes *mistakes, const CzNode *place, const CzTrail *trail, const char *format,
                ...) {
    va_list arguments;
    va_start(arguments, format);
    cz_mistake_list(mistakes, place, trail, format, arguments);
    va_end(arguments);
}

void cz_mistake_at(CzMistakes *mistakes, const CzSource *source, int line, int column,
                   const char *format, ...) {
    const CzNode place = {.source = source, .line = line, .column = column};
    va_list arguments;
    va_start(arguments, format);
    cz_mistake_list(mistakes, &place, NULL, format, arguments);
    va_end(arguments);
}

void cz_mistake_help(CzMistakes *mistakes, const char *help) {
    if (mistakes->last != NULL && help != NULL)
        cz_error_help(&mistakes->last->error, "%s", help);
}

void cz_mistake_suggest(CzMistakes *mistakes, const CzSuggestion *suggestion) {
    if (mistakes->last != NULL)
        cz_suggest_help(suggestion, &mistakes->last->error);
}

static int compare_numbers(int a, int b) {
    return (a > b) - (a < b);
}

static int compare_places(const void *a, const void *b) {
    const CzMistake *first = *(CzMistake *const *)a, *second = *(CzMistake *const *)b;
    int order = compare_numbers(first->order, second->order);
    if (order == 0)
        order = compare_numbers(first->error.line, second->error.line);
    if (order == 0)
        order = compare_numbers(first->error.column, second->error.column);
    if (order == 0)
        order = strcmp(first->error.message, second->error.message);
    return order;
}

void cz_mistakes_finish(CzMistakes *mistakes) {
    if (mistakes->n_mistake == 0)
        return;
    qsort(mistakes->mistake, (size_t)mistakes->n_mistake, sizeof mistakes->mistake[0],
          compare_places);
    if (mistakes->n_left_out == 0)
        return;
    CzMistake *rest = cz_arena_allocate(mistakes->arena, 1, sizeof *rest);
    if (rest == NULL)
        return;
    rest->error = mistakes->mistake[mistakes->n_mistake - 1]->error;
    rest->error.line = rest->error.column = 0;
    rest->error.help[0] = '\0';
    snprintf(rest->error.message, sizeof rest->error.message, "%d more mistakes are not shown",
             mistakes->n_left_out);
    mistakes->mistake[mistakes->n_mistake++] = rest;
    mistakes->n_left_out = 0;
}

CzStatus cz_mistakes_status(const CzMistakes *mistakes, const char *what, CzError *error) {
    if (mistakes->arena->out_of_memory)
        return cz_no_memory(error, what);
    if (mistakes->n_mistake > 0 && error != NULL)
        *error = mistakes->mistake[0]->error;
    return mistakes->n_mistake > 0 ? CZ_STATUS_INPUT : CZ_OK;
}
