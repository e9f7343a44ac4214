/* HTML and SVG: markup with escaped texts and short numbers in it. */
#include "report/markup.h"

#include "report/figure.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

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

static void write_number(FILE *stream, int decimals, double value) {
    char text[CZ_FIGURE_SIZE];
    cz_figure_fixed(text, decimals, isfinite(value) ? value : 0);
    if (strchr(text, '.') != NULL && strchr(text, 'e') == NULL) {
        size_t n = strlen(text);
        while (text[n - 1] == '0')
            n--;
        text[text[n - 1] == '.' ? n - 1 : n] = '\0';
    }
    fputs(strcmp(text, "-0") == 0 ? "0" : text, stream);
}

void cz_markup_write(CzMarkup *markup, const char *format, ...) {
    FILE *stream = markup->stream;
    va_list values;
    va_start(values, format);
    for (const char *c = format; *c != '\0'; c++) {
        if (*c != '%') {
            fputc(*c == '\'' ? '"' : *c, stream);
            continue;
        }
        c++;
        const int decimals = *c == '.' ? c[1] - '0' : 0;
        c += *c == '.' ? 2 : 0;
        if (*c == 's')
            write_escaped(stream, va_arg(values, const char *));
        else if (*c == 'd')
            fprintf(stream, "%d", va_arg(values, int));
        else if (*c == 'l')
            fprintf(stream, "%ld", (c++, va_arg(values, long)));
        else if (*c == 'f')
            write_number(stream, decimals, va_arg(values, double));
        else
            fputc(*c, stream);
    }
    va_end(values);
}
