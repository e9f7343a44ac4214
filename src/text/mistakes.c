/* Mistakes: collecting, sorting, naming the part that they came through. */
#include "text/mistakes.h"

#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Cuts a text that did not fit at a character's start. */
static void end_at_character(char *text, size_t size) {
    size_t n = strlen(text);
    if (n + 1 < size)
        return;
    while (n > 0 && ((unsigned char)text[n - 1] & 0xc0) == 0x80)
        n--;
    if (n > 0 && (unsigned char)text[n - 1] >= 0xc0)
        n--;
    text[n] = '\0';
}

static void append_trail(CzError *error, const CzTrail *trail) {
    for (; trail != NULL && trail->part != NULL; trail = trail->from) {
        size_t n = strlen(error->message);
        snprintf(error->message + n, sizeof error->message - n, "; in part '%s' (%s:%d)",
                 trail->part, trail->written->source->name, trail->written->line);
        n = strlen(error->message);
        if (trail->used != NULL)
            snprintf(error->message + n, sizeof error->message - n, ", used at %s:%d",
                     trail->used->source->name, trail->used->line);
    }
    end_at_character(error->message, sizeof error->message);
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

static void add(CzMistakes *mistakes, CzError *error, int order, const CzTrail *trail) {
    end_at_character(error->message, sizeof error->message);
    cz_text_repair(error->message);
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
    error->status = CZ_STATUS_INPUT;
    mistake->error = *error;
    mistake->order = order;
    mistake->n_stated = (int)strlen(error->message);
    append_trail(&mistake->error, trail);
    mistakes->mistake[mistakes->n_mistake++] = mistake;
    mistakes->last = mistake;
}

void cz_error_place(CzError *error, const CzNode *place) {
    snprintf(error->file, sizeof error->file, "%s", place->source->name);
    end_at_character(error->file, sizeof error->file);
    error->line = place->line;
    error->column = place->column;
}

/* Adds a mistake at a place, of whose node only source, line and column count. */
static void tell(CzMistakes *mistakes, const CzNode *place, const CzTrail *trail,
                 const char *format, va_list arguments) {
    CzError error = {0};
    cz_error_place(&error, place);
    vsnprintf(error.message, sizeof error.message, format, arguments);
    add(mistakes, &error, place->source->order, trail);
}

void cz_mistake(CzMistakes *mistakes, const CzNode *place, const CzTrail *trail, const char *format,
                ...) {
    va_list arguments;
    va_start(arguments, format);
    tell(mistakes, place, trail, format, arguments);
    va_end(arguments);
}

void cz_mistake_at(CzMistakes *mistakes, const CzSource *source, int line, int column,
                   const char *format, ...) {
    const CzNode place = {.source = source, .line = line, .column = column};
    va_list arguments;
    va_start(arguments, format);
    tell(mistakes, &place, NULL, format, arguments);
    va_end(arguments);
}

void cz_mistake_help(CzMistakes *mistakes, const char *format, ...) {
    if (mistakes->last == NULL)
        return;
    CzError *error = &mistakes->last->error;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->help, sizeof error->help, format, arguments);
    va_end(arguments);
    end_at_character(error->help, sizeof error->help);
    cz_text_repair(error->help);
}

void cz_mistake_suggest(CzMistakes *mistakes, const char *best) {
    if (best != NULL)
        cz_mistake_help(mistakes, "did you mean '%s'?", best);
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
