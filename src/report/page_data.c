/* The numbers behind the cursor and the animation: rows of the recorded channels, as whole numbers
 * of a decimal unit. Each is told by its bend, how far it leaves the line through the two before
 * it, which for most rows of most channels is one letter or none.
 *
 *   number   digits to base 44, the last one as it is, those before it 44 higher
 *   letter   of a digit: printable, but for what HTML, XML or JSON would take for their own
 *   bend b   the number 2 b for b >= 0, 2 |b| + 1 for b < 0
 *   1, m     m / 2 bends of nothing when m is even, (m - 1) / 2 values that are no number when odd
 */
#include "report/page.h"

#include "base/error.h"
#include "report/assets.h"
#include "report/figure.h"
#include "report/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    EVEN_SAMPLES = 240,
    DIGITS = 5,
    FINEST_TIME = 6, /* decimals of a millisecond */
    BASE = 44,
    SHORTEST_RUN = 3,    /* of bends of nothing; fewer take less room one by one */
    PAGE_ROOM = 1000000, /* bytes that a page may have where all rows do not fit; ours */
    FOOT_ROOM = 1000     /* of what follows the numbers, but for the script */
};

/* What the page has the numbers of, and the decimals beyond which nobody asks: what only moves the
 * animation needs no more than its drawing. */
static const struct {
    bool is_there;
    int decimals;
} shown[CZ_N_DRAWN] = {[CZ_DRAWN_TIME] = {true, FINEST_TIME},
                       [CZ_DRAWN_BODY_DISPLACEMENT] = {true, 3},
                       [CZ_DRAWN_BODY_SPEED] = {true, 3},
                       [CZ_DRAWN_BODY_ACCELERATION] = {true, 3},
                       [CZ_DRAWN_FILTERED_ACCELERATION] = {true, 3},
                       [CZ_DRAWN_BODY_RISE] = {true, 1},
                       [CZ_DRAWN_BODY_PITCH] = {true, 2},
                       [CZ_DRAWN_WHEEL_LIFT] = {true, 2},
                       [CZ_DRAWN_END_STROKE] = {true, 1},
                       [CZ_DRAWN_ANTI_CLIMBER_STROKE] = {true, 1},
                       [CZ_DRAWN_ANTI_CLIMBER_OVERLAP] = {true, 2},
                       [CZ_DRAWN_INTERFACE_FORCE] = {true, 1},
                       [CZ_DRAWN_INTERFACE_CLOSURE] = {true, 2},
                       [CZ_DRAWN_KINETIC_ENERGY] = {true, 2},
                       [CZ_DRAWN_STORED_ENERGY] = {true, 2},
                       [CZ_DRAWN_WHEEL_RAIL_ENERGY] = {true, 2},
                       [CZ_DRAWN_RUNNING_GEAR_ENERGY] = {true, 2},
                       [CZ_DRAWN_TRACK_ENERGY] = {true, 2},
                       [CZ_DRAWN_INTERFACES_ENERGY] = {true, 2},
                       [CZ_DRAWN_BALANCE_ERROR] = {true, 6}};

/* Adds the sample at which a channel is largest, and the one at which it is smallest. */
static void take_extremes(const double *value, int n, bool *taken) {
    int high = 0, low = 0;
    for (int i = 1; i < n; i++) {
        high = value[i] > value[high] ? i : high;
        low = value[i] < value[low] ? i : low;
    }
    taken[high] = taken[low] = true;
}

/* Rows that the cursor can stand at in any case: evenly spread, every extreme of a force or an
 * acceleration, every event. */
static void choose(const CzPage *page, bool *taken) {
    const int n = page->n_sample;
    for (int i = 0; i < EVEN_SAMPLES; i++)
        taken[(long)i * (n - 1) / (EVEN_SAMPLES - 1)] = true;
    for (int i = 0; i < cz_run_n_column(page->run); i++) {
        const CzColumn column = cz_run_column(page->run, i);
        if (column.channel == CZ_CHANNEL_INTERFACE_FORCE ||
            column.channel == CZ_CHANNEL_BODY_ACCELERATION)
            take_extremes(cz_run_channel(page->run, column.channel, column.place), n, taken);
    }
    for (int i = 0; i < page->summary->n_event; i++) {
        const double time = page->summary->event[i].time * CZ_MILLI_PER_UNIT;
        int nearest = 0;
        for (int k = 1; k < n; k++)
            nearest = fabs(page->time[k] - time) < fabs(page->time[nearest] - time) ? k : nearest;
        taken[nearest] = true;
    }
}

/* Fewest decimals that tell every row's time, as far as FINEST_TIME. */
static int decimals_of_time(const double *time, int n) {
    double unit = 1;
    int decimals = 0;
    for (int i = 0; i < n && decimals < FINEST_TIME; i++)
        while (decimals < FINEST_TIME && fabs(time[i] - round(time[i] * unit) / unit) > 1e-7) {
            unit *= 10;
            decimals++;
        }
    return decimals;
}

/* Decimals that give the largest value DIGITS digits. */
static int decimals_for(CzDrawn drawn, const double *value, int n) {
    if (drawn == CZ_DRAWN_TIME)
        return decimals_of_time(value, n);
    double most = 0;
    for (int i = 0; i < n; i++)
        most = isfinite(value[i]) && fabs(value[i]) > most ? fabs(value[i]) : most;
    int decimals = 0;
    double room = 1;
    for (int i = 0; i < DIGITS; i++)
        room *= 10;
    while (most > 0 && decimals < shown[drawn].decimals && most * 10 < room) {
        most *= 10;
        decimals++;
    }
    return decimals;
}

/* A JSON string that cannot end the script element it stands in. */
static void write_json_text(FILE *stream, const char *text) {
    fputc('"', stream);
    for (; *text != '\0'; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c < 0x20 || c == '"' || c == '\\' || c == '<')
            fprintf(stream, "\\u%04x", c);
        else
            fputc(c, stream);
    }
    fputc('"', stream);
}

/* Where letters go: a stream, or NULL to count them only. */
typedef struct Letters {
    FILE *stream;
    long n;
} Letters;

static void put_letter(Letters *letters, int digit) {
    int c = '#' + digit;
    c += c >= '&';
    c += c >= '<';
    c += c >= '>';
    c += c >= '\\';
    if (letters->stream != NULL)
        fputc(c, letters->stream);
    letters->n++;
}

static void put_number(Letters *letters, unsigned long long number) {
    int digit[16], n = 0;
    do {
        digit[n++] = (int)(number % BASE);
        number /= BASE;
    } while (number > 0);
    while (n-- > 0)
        put_letter(letters, digit[n] + (n > 0 ? BASE : 0));
}

static void put_bend(Letters *letters, long long bend) {
    put_number(letters,
               bend >= 0 ? 2 * (unsigned long long)bend : 2 * (unsigned long long)-bend + 1);
}

static void put_run(Letters *letters, int n, bool is_gap) {
    if (!is_gap && n < SHORTEST_RUN) {
        while (n-- > 0)
            put_bend(letters, 0);
        return;
    }
    put_number(letters, 1);
    put_number(letters, 2 * (unsigned long long)n + is_gap);
}

/* Rows that are taken: the first ones, and some of those after them. */
typedef struct Rows {
    int n, n_first;
    const bool *later; /* (n) */
} Rows;

/* What a channel takes beside its name and its letters. */
enum { CHANNEL_ROOM = sizeof ",\n\"\":[0,\"\"]" - 1 };

/* ,"name":[decimals,"letters"] */
static void put_curve(Letters *letters, const CzPage *page, CzDrawn drawn, int place,
                      const Rows *rows) {
    const double *value = cz_page_values(page, drawn, place);
    const int decimals = decimals_for(drawn, value, rows->n);
    double unit = 1;
    char name[CZ_CHANNEL_ROOM];
    cz_drawn_name(page->summary, drawn, place, name);
    for (int i = 0; i < decimals; i++)
        unit *= 10;
    if (letters->stream != NULL) {
        fputs(",\n", letters->stream);
        write_json_text(letters->stream, name);
        fprintf(letters->stream, ":[%d,\"", decimals);
    }
    letters->n += (long)strlen(name) + CHANNEL_ROOM;
    long long last = 0, step = 0;
    int n_run = 0;
    bool is_gap = false; /* what the run is of */
    for (int i = 0; i < rows->n; i++) {
        if (i >= rows->n_first && !rows->later[i])
            continue;
        const bool is_number = isfinite(value[i]);
        const long long whole = is_number ? llround(value[i] * unit) : 0;
        const long long bend = is_number ? whole - last - step : 0;
        if (n_run > 0 && (bend != 0 || is_gap == is_number)) {
            put_run(letters, n_run, is_gap);
            n_run = 0;
        }
        if (bend != 0)
            put_bend(letters, bend);
        else
            n_run++;
        is_gap = !is_number;
        if (is_number) {
            step = whole - last;
            last = whole;
        }
    }
    if (n_run > 0)
        put_run(letters, n_run, is_gap);
    if (letters->stream != NULL)
        fputs("\"]", letters->stream);
}

static void put_curves(Letters *letters, const CzPage *page, const Rows *rows) {
    for (int i = 0; i < cz_run_n_column(page->run); i++) {
        const CzColumn column = cz_run_column(page->run, i);
        if (shown[column.channel].is_there)
            put_curve(letters, page, (CzDrawn)column.channel, column.place, rows);
    }
    for (int i = 0; i < page->made.n; i++)
        put_curve(letters, page, page->made.curve[i].drawn, page->made.curve[i].place, rows);
}

/* All rows where they fit into the page, else as many of the first ones as do. */
static void fill(const CzPage *page, Rows *rows) {
    const long room = PAGE_ROOM - FOOT_ROOM - (long)strlen(cz_report_js) - (long)page->text.n;
    const int fine = rows->n / 64 + 1;
    int most = rows->n + 1, least = 0; /* fit, do not fit */
    for (rows->n_first = rows->n; most - least > fine; rows->n_first = (least + most) / 2) {
        Letters letters = {NULL, 0};
        put_curves(&letters, page, rows);
        if (letters.n <= room)
            least = rows->n_first;
        else
            most = rows->n_first;
    }
    rows->n_first = least;
}

/* Which rows the cursor stands at; for people, at the end of the page. */
static void write_rows(CzPage *page, const Rows *rows) {
    CzMarkup *markup = &page->markup;
    char until[CZ_FIGURE_ROOM], every[CZ_FIGURE_ROOM], text[400];
    if (rows->n_first == rows->n) {
        snprintf(text, sizeof text,
                 "Cursor and animation stand at every one of the %d rows of channels.csv.",
                 rows->n);
    } else {
        char first[96] = "";
        if (rows->n_first > 1)
            snprintf(first, sizeof first, "every row of channels.csv until %s ms, later at ",
                     cz_figure_plain(until, page->time[rows->n_first - 1]));
        snprintf(
            text, sizeof text,
            "Cursor and animation stand at %severy event, every extreme of a force or an "
            "acceleration, and at least every %s ms: with all %d rows this page would be "
            "larger than 1 MB.",
            first,
            cz_figure_plain(every, (page->time[rows->n - 1] - page->time[0]) / (EVEN_SAMPLES - 1)),
            rows->n);
    }
    cz_markup_classed(markup, "p", "script", text);
    cz_markup_line(markup);
}

static void write_events(const CzPage *page, FILE *stream) {
    fputs("\"events\":[", stream);
    for (int i = 0; i < page->summary->n_event; i++) {
        const CzEvent *event = &page->summary->event[i];
        char time[CZ_FIGURE_ROOM], words[48], text[CZ_WHERE_ROOM + 48];
        cz_page_event_words(event->what, words);
        snprintf(text, sizeof text, "%s %s", words, event->where);
        fprintf(stream, "%s[%s,", i > 0 ? "," : "",
                cz_figure_fixed(time, 1, event->time * CZ_MILLI_PER_UNIT));
        write_json_text(stream, text);
        fputc(']', stream);
    }
    fputc(']', stream);
}

CzStatus cz_page_write_data(CzPage *page, CzError *error) {
    CzMarkup *markup = &page->markup;
    if (page->n_sample < 2)
        return CZ_OK;
    cz_markup_open(markup, "script");
    cz_markup_attribute(markup, "type", "application/json");
    cz_markup_attribute(markup, "id", "data");
    cz_markup_raw(markup, "{");
    write_events(page, markup->stream);
    bool *later = calloc((size_t)page->n_sample, sizeof *later);
    if (later == NULL || fflush(markup->stream) != 0) { /* which tells how long the page is */
        free(later);
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    }
    choose(page, later);
    Rows rows = {.n = page->n_sample, .later = later};
    fill(page, &rows);
    Letters letters = {markup->stream, 0};
    put_curves(&letters, page, &rows);
    cz_markup_raw(markup, "}");
    cz_markup_close(markup);
    cz_markup_line(markup);
    write_rows(page, &rows);
    free(later);
    return CZ_OK;
}
