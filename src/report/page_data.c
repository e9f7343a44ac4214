/* The numbers behind the cursor and the animation: rows of the recorded channels, as whole numbers
 * of a decimal unit. Each is given by its second difference, the deviation from the line through
 * the two values before it:
 *
 *   +3, -12   a second difference
 *   z, z5     one that is zero, five of them
 *   n, n5     a value that is not a number, five of them
 */
#include "report/page.h"

#include "report/assets.h"
#include "report/figure.h"
#include "report/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    EVEN_SAMPLES = 240,
    DIGITS = 5,
    FINEST_TIME = 6,    /* decimals of a millisecond */
    PAGE_SIZE = 900000, /* largest size of a page that leaves out rows [byte]; ours */
    FOOT_SIZE = 1000    /* size of what follows the numbers, without the script [byte] */
};

/* Largest number of decimals of the channels in the data of the page, 0 for other channels; fewer
 * for those that only the animation uses. */
static const int most_decimals[CZ_N_DRAWN] = {[CZ_DRAWN_TIME] = FINEST_TIME,
                                              [CZ_DRAWN_BODY_DISPLACEMENT] = 3,
                                              [CZ_DRAWN_BODY_SPEED] = 3,
                                              [CZ_DRAWN_BODY_ACCELERATION] = 3,
                                              [CZ_DRAWN_FILTERED_ACCELERATION] = 3,
                                              [CZ_DRAWN_BODY_RISE] = 1,
                                              [CZ_DRAWN_BODY_PITCH] = 2,
                                              [CZ_DRAWN_WHEEL_LIFT] = 2,
                                              [CZ_DRAWN_END_STROKE] = 1,
                                              [CZ_DRAWN_ANTI_CLIMBER_STROKE] = 1,
                                              [CZ_DRAWN_ANTI_CLIMBER_OVERLAP] = 2,
                                              [CZ_DRAWN_INTERFACE_FORCE] = 1,
                                              [CZ_DRAWN_INTERFACE_CLOSURE] = 2,
                                              [CZ_DRAWN_KINETIC_ENERGY] = 2,
                                              [CZ_DRAWN_STORED_ENERGY] = 2,
                                              [CZ_DRAWN_WHEEL_RAIL_ENERGY] = 2,
                                              [CZ_DRAWN_RUNNING_GEAR_ENERGY] = 2,
                                              [CZ_DRAWN_TRACK_ENERGY] = 2,
                                              [CZ_DRAWN_INTERFACES_ENERGY] = 2,
                                              [CZ_DRAWN_BALANCE_ERROR] = 6};

/* Adds the samples at which a channel is largest and smallest. */
static void mark_extremes(const double *value, int n, bool *taken) {
    int high = 0, low = 0;
    for (int i = 1; i < n; i++) {
        high = value[i] > value[high] ? i : high;
        low = value[i] < value[low] ? i : low;
    }
    taken[high] = taken[low] = true;
}

/* Rows that are always in the data: evenly spaced ones, extremes of forces and accelerations,
 * events. */
static void choose(const CzPage *page, bool *taken) {
    const int n = page->n_sample;
    for (int i = 0; i < EVEN_SAMPLES; i++)
        taken[(long)i * (n - 1) / (EVEN_SAMPLES - 1)] = true;
    for (int i = 0; i < cz_run_n_column(page->run); i++) {
        const CzColumn column = cz_run_column(page->run, i);
        if (column.channel == CZ_CHANNEL_INTERFACE_FORCE ||
            column.channel == CZ_CHANNEL_BODY_ACCELERATION)
            mark_extremes(cz_run_channel(page->run, column.channel, column.place), n, taken);
    }
    for (int i = 0; i < page->summary->n_event; i++) {
        const double time = page->summary->event[i].time * CZ_MILLI_PER_UNIT;
        int nearest = 0;
        for (int k = 1; k < n; k++)
            nearest = fabs(page->time[k] - time) < fabs(page->time[nearest] - time) ? k : nearest;
        taken[nearest] = true;
    }
}

/* Fewest decimals that give the time of every row, at most FINEST_TIME. */
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

/* Decimals for which the largest value has DIGITS digits. */
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
    while (most > 0 && decimals < most_decimals[drawn] && most * 10 < room) {
        most *= 10;
        decimals++;
    }
    return decimals;
}

/* A JSON string that cannot end the script element it is in. */
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

/* The rows that are written: all of the first n_first, and some after them. */
typedef struct Rows {
    int n, n_first;
    const bool *later; /* (n) */
} Rows;

/* Ends a run of zeros or of values that are not numbers. */
static void write_run(FILE *stream, int n, bool is_gap) {
    if (n > 0)
        fputc(is_gap ? 'n' : 'z', stream);
    if (n > 1)
        fprintf(stream, "%d", n);
}

/* The second differences of the rows, in 10^-decimals of the unit. */
static void write_differences(FILE *stream, const double *value, int decimals, const Rows *rows) {
    long long last = 0, step = 0;
    double unit = 1;
    int n_run = 0;
    bool is_gap = false; /* whether the run is of missing values */
    for (int i = 0; i < decimals; i++)
        unit *= 10;
    for (int i = 0; i < rows->n; i++) {
        if (i >= rows->n_first && !rows->later[i])
            continue;
        const bool is_number = isfinite(value[i]);
        const long long whole = is_number ? llround(value[i] * unit) : last + step;
        const long long difference = whole - last - step;
        if (n_run > 0 && (difference != 0 || is_gap == is_number)) {
            write_run(stream, n_run, is_gap);
            n_run = 0;
        }
        if (difference != 0)
            fprintf(stream, "%+lld", difference);
        else
            n_run++;
        is_gap = !is_number;
        if (is_number) {
            step = whole - last;
            last = whole;
        }
    }
    write_run(stream, n_run, is_gap);
}

/* ,"name":[decimals,"differences"] */
static void write_curve(FILE *stream, const CzPage *page, CzDrawn drawn, int place,
                        const Rows *rows) {
    const double *value = cz_page_values(page, drawn, place);
    const int decimals = decimals_for(drawn, value, rows->n);
    char name[CZ_CHANNEL_SIZE];
    fputs(",\n", stream);
    write_json_text(stream, cz_drawn_name(page->summary, drawn, place, name));
    fprintf(stream, ":[%d,\"", decimals);
    write_differences(stream, value, decimals, rows);
    fputs("\"]", stream);
}

static void write_curves(FILE *stream, const CzPage *page, const Rows *rows) {
    for (int i = 0; i < cz_run_n_column(page->run); i++) {
        const CzColumn column = cz_run_column(page->run, i);
        if (most_decimals[column.channel] > 0)
            write_curve(stream, page, (CzDrawn)column.channel, column.place, rows);
    }
    for (int i = 0; i < page->made.n; i++)
        write_curve(stream, page, page->made.curve[i].drawn, page->made.curve[i].place, rows);
}

/* The curves as a text of their own; false without memory. */
static bool make_text(const CzPage *page, const Rows *rows, CzMemoryText *text) {
    *text = (CzMemoryText){0};
    FILE *stream = cz_memory_text_open(text);
    if (stream != NULL)
        write_curves(stream, page, rows);
    return stream != NULL && fclose(stream) == 0 && !text->failed;
}

/* Makes the text of all rows, or of as many first rows as fit into the page. False without memory.
 */
static bool fill(const CzPage *page, Rows *rows, CzMemoryText *text) {
    const size_t taken = FOOT_SIZE + strlen(cz_report_js) + page->text.n;
    const int fine = rows->n / 64 + 1;
    int most = rows->n + 1, least = 0; /* rows that do not fit, rows that fit */
    bool is_whole = true;
    for (rows->n_first = rows->n; is_whole && most - least > fine;
         rows->n_first = (least + most) / 2) {
        cz_memory_text_free(text);
        is_whole = make_text(page, rows, text);
        if (taken + text->n <= PAGE_SIZE)
            least = rows->n_first;
        else
            most = rows->n_first;
    }
    rows->n_first = least;
    cz_memory_text_free(text);
    return is_whole && make_text(page, rows, text);
}

/* Writes at the end of the page which rows the cursor covers. */
static void write_rows(CzPage *page, const Rows *rows) {
    CzMarkup *markup = &page->markup;
    const double spacing = (page->time[rows->n - 1] - page->time[0]) / (EVEN_SAMPLES - 1);
    char until[CZ_FIGURE_SIZE], every[CZ_FIGURE_SIZE];
    cz_markup_write(markup, "<p class='script'>Cursor and animation cover ");
    if (rows->n_first == rows->n) {
        cz_markup_write(markup, "all %d rows of channels.csv.</p>\n", rows->n);
        return;
    }
    if (rows->n_first > 1)
        cz_markup_write(markup, "every row of channels.csv until %s ms, later at ",
                        cz_figure_plain(until, page->time[rows->n_first - 1]));
    cz_markup_write(markup,
                    "every event, every extreme of a force or an acceleration, and at least every "
                    "%s ms: with all %d rows this page would be larger than 0.9 MB.</p>\n",
                    cz_figure_plain(every, spacing), rows->n);
}

static void write_events(const CzPage *page, FILE *stream) {
    fputs("\"events\":[", stream);
    for (int i = 0; i < page->summary->n_event; i++) {
        const CzEvent *event = &page->summary->event[i];
        char time[CZ_FIGURE_SIZE], words[48], text[CZ_WHERE_SIZE + 48];
        cz_page_event_words(event->what, words);
        snprintf(text, sizeof text, "%s %s", words, event->where);
        fprintf(stream, "%s[%s,", i > 0 ? "," : "",
                cz_figure_fixed(time, 1, event->time * CZ_MILLI_PER_UNIT));
        write_json_text(stream, text);
        fputc(']', stream);
    }
    fputc(']', stream);
}

void cz_page_write_data(CzPage *page) {
    CzMarkup *markup = &page->markup;
    if (page->n_sample < 2)
        return;
    bool *later = calloc((size_t)page->n_sample, sizeof *later);
    Rows rows = {.n = page->n_sample, .later = later};
    CzMemoryText text = {0};
    cz_markup_write(markup, "<script type='application/json' id='data'>{");
    write_events(page, markup->stream);
    fflush(markup->stream); /* so that the size of the page is known */
    if (later != NULL)
        choose(page, later);
    if (later == NULL || !fill(page, &rows, &text))
        markup->failed = true;
    fputs(text.text != NULL ? text.text : "", markup->stream);
    cz_markup_write(markup, "}</script>\n");
    write_rows(page, &rows);
    cz_memory_text_free(&text);
    free(later);
}
