/* HTML and SVG: tags, attributes, escaped text. */
#include "report/markup.h"

#include "report/figure.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

/* Elements without content: in HTML only these may be closed in their start tag. */
static bool is_empty_element(const char *element) {
    static const char *const names[] = {"meta",   "br",      "path",  "line", "rect",
                                        "circle", "polygon", "input", "wbr"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(names[i], element) == 0)
            return true;
    return false;
}

static void end_tag(CzMarkup *markup) {
    if (markup->in_tag)
        fputc('>', markup->stream);
    markup->in_tag = false;
}

static void write_escaped(FILE *stream, const char *text) {
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '&')
            fputs("&amp;", stream);
        else if (c == '<')
            fputs("&lt;", stream);
        else if (c == '>')
            fputs("&gt;", stream);
        else if (c == '"')
            fputs("&quot;", stream);
        else
            fputc((c < 0x20 && c != '\n' && c != '\t') || c == 0x7f ? '?' : c, stream);
    }
}

void cz_markup_open(CzMarkup *markup, const char *element) {
    end_tag(markup);
    fprintf(markup->stream, "<%s", element);
    markup->in_tag = true;
    if (markup->depth < CZ_MARKUP_DEPTH)
        markup->element[markup->depth] = element;
    markup->depth++;
}

void cz_markup_close(CzMarkup *markup) {
    const char *element = markup->element[--markup->depth];
    if (markup->in_tag && is_empty_element(element)) {
        fputs("/>", markup->stream);
        markup->in_tag = false;
        return;
    }
    end_tag(markup);
    fprintf(markup->stream, "</%s>", element);
}

void cz_markup_attribute(CzMarkup *markup, const char *name, const char *value) {
    fprintf(markup->stream, " %s=\"", name);
    write_escaped(markup->stream, value);
    fputc('"', markup->stream);
}

void cz_markup_write_number(FILE *stream, int decimals, double value) {
    char text[CZ_FIGURE_ROOM];
    cz_figure_fixed(text, decimals, isfinite(value) ? value : 0);
    if (strchr(text, '.') != NULL && strchr(text, 'e') == NULL) {
        size_t n = strlen(text);
        while (text[n - 1] == '0')
            n--;
        text[text[n - 1] == '.' ? n - 1 : n] = '\0';
    }
    fputs(strcmp(text, "-0") == 0 ? "0" : text, stream);
}

void cz_markup_number(CzMarkup *markup, const char *name, int decimals, double value) {
    fprintf(markup->stream, " %s=\"", name);
    cz_markup_write_number(markup->stream, decimals, value);
    fputc('"', markup->stream);
}

void cz_markup_open_class(CzMarkup *markup, const char *element, const char *class_name) {
    cz_markup_open(markup, element);
    cz_markup_attribute(markup, "class", class_name);
}

void cz_markup_numbers(CzMarkup *markup, int decimals, const char *names, const double *value) {
    for (const char *at = names; *at != '\0'; at += strspn(at, " ")) {
        char name[32];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
        cz_markup_number(markup, name, decimals, *value++);
        at += strlen(name);
    }
}

static void write_pairs(CzMarkup *markup, va_list arguments) {
    for (const char *name; (name = va_arg(arguments, const char *)) != NULL;)
        cz_markup_attribute(markup, name, va_arg(arguments, const char *));
}

void cz_markup_attributes(CzMarkup *markup, ...) {
    va_list arguments;
    va_start(arguments, markup);
    write_pairs(markup, arguments);
    va_end(arguments);
}

void cz_markup_shape(CzMarkup *markup, const char *element, const char *names, const double *value,
                     ...) {
    va_list arguments;
    cz_markup_open(markup, element);
    cz_markup_numbers(markup, 1, names, value);
    va_start(arguments, value);
    write_pairs(markup, arguments);
    va_end(arguments);
    cz_markup_close(markup);
}

void cz_markup_format(CzMarkup *markup, const char *name, const char *format, ...) {
    char text[CZ_SENTENCE_ROOM];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    cz_markup_attribute(markup, name, text);
}

void cz_markup_text(CzMarkup *markup, const char *text) {
    end_tag(markup);
    write_escaped(markup->stream, text);
}

void cz_markup_line(CzMarkup *markup) {
    end_tag(markup);
    fputc('\n', markup->stream);
}

void cz_markup_end(CzMarkup *markup) {
    cz_markup_close(markup);
    cz_markup_line(markup);
}

void cz_markup_raw(CzMarkup *markup, const char *text) {
    end_tag(markup);
    fputs(text, markup->stream);
}

void cz_markup_element(CzMarkup *markup, const char *element, const char *text) {
    cz_markup_open(markup, element);
    cz_markup_text(markup, text);
    cz_markup_close(markup);
}

void cz_markup_say(CzMarkup *markup, const char *element, const char *format, ...) {
    enum { ROOM = 4 * CZ_SENTENCE_ROOM };
    char text[ROOM];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    cz_markup_element(markup, element, text);
}

void cz_markup_classed(CzMarkup *markup, const char *element, const char *class_name,
                       const char *text) {
    cz_markup_open(markup, element);
    cz_markup_attribute(markup, "class", class_name);
    cz_markup_text(markup, text);
    cz_markup_close(markup);
}

double cz_text_width(const char *text) {
    double width = 0;
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c >= 0x80 && c < 0xc0)
            continue; /* a further byte of a character */
        if (strchr("il.,:;'|!()[] ft", c) != NULL)
            width += 0.36;
        else
            width += strchr("mwMW%", c) != NULL ? 0.92 : 0.62;
    }
    return width;
}
