/* The numbers behind the cursor and the animation: samples of the recorded channels, as whole
 * numbers of a decimal unit, each the difference to the one before.
 */
#include "report/page.h"

#include "base/error.h"
#include "report/figure.h"
#include "report/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { EVEN_SAMPLES = 240, DIGITS = 5, MOST_DECIMALS = 4 };

static bool is_shown(const char *name) {
    static const char *const prefixes[] = {"x_", "v_", "a_", "z_",      "pitch_",
                                           "F_", "d_", "E_", "overlap_"};
    static const char *const others[] = {"F_end_",          "F_coupler_",  "F_anti-climber_",
                                         "F_side-buffers_", "E_taken_up_", "E_imbalance_"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (strncmp(name, others[i], strlen(others[i])) == 0)
            return false;
    for (size_t i = 0; i < sizeof prefixes / sizeof *prefixes; i++)
        if (strncmp(name, prefixes[i], strlen(prefixes[i])) == 0)
            return true;
    return false;
}

/* Adds the sample at which a channel is largest, and the one at which it is smallest. */
static void take_extremes(const double *value, int n, bool *taken) {
    int high = 0, low = 0;
    for (int i = 1; i < n; i++) {
        high = value[i] > value[high] ? i : high;
        low = value[i] < value[low] ? i : low;
    }
    taken[high] = taken[low] = true;
}

/* Samples that the cursor can stand at: evenly spread, every extreme of a force or an acceleration,
 * every event. */
static void choose(const CzPage *page, bool *taken) {
    const int n = page->n_sample;
    for (int i = 0; i < EVEN_SAMPLES; i++)
        taken[(long)i * (n - 1) / (EVEN_SAMPLES - 1)] = true;
    for (int channel = 1; channel < cz_run_n_channel(page->run); channel++) {
        const char *name = cz_run_channel_name(page->run, channel);
        if (strchr("Fa", name[0]) != NULL && is_shown(name))
            take_extremes(cz_run_channel(page->run, channel), n, taken);
    }
    for (int i = 0; i < page->summary->n_event; i++) {
        const double time = page->summary->event[i].time * CZ_MILLI_PER_UNIT;
        int nearest = 0;
        for (int k = 1; k < n; k++)
            nearest = fabs(page->time[k] - time) < fabs(page->time[nearest] - time) ? k : nearest;
        taken[nearest] = true;
    }
}

/* Decimals beyond which nobody asks, by the unit at the end of a channel's name. */
static int most_decimals(const char *name) {
    static const struct {
        const char *unit;
        int decimals;
    } units[] = {{"_mm", 3}, {"_kN", 1}, {"_kJ", 2}, {"_mrad", 3}};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        const size_t n = strlen(name), n_unit = strlen(units[i].unit);
        if (n > n_unit && strcmp(name + n - n_unit, units[i].unit) == 0)
            return units[i].decimals;
    }
    return MOST_DECIMALS;
}

/* Decimals that give the largest value DIGITS digits. */
static int decimals_for(const char *name, const double *value, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = isfinite(value[i]) && fabs(value[i]) > most ? fabs(value[i]) : most;
    int decimals = 0;
    double room = 1;
    for (int i = 0; i < DIGITS; i++)
        room *= 10;
    while (most > 0 && decimals < most_decimals(name) && most * 10 < room) {
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

/* "name":[decimals,first,difference,...]; null for a value that is no number. */
static void write_channel(FILE *stream, const char *name, const double *value, int n,
                          const bool *taken) {
    const int decimals = decimals_for(name, value, n);
    double unit = 1;
    for (int i = 0; i < decimals; i++)
        unit *= 10;
    write_json_text(stream, name);
    fprintf(stream, ":[%d", decimals);
    long long last = 0;
    for (int i = 0; i < n; i++) {
        if (!taken[i])
            continue;
        if (!isfinite(value[i])) {
            fputs(",null", stream);
            continue;
        }
        const long long whole = llround(value[i] * unit);
        fprintf(stream, ",%lld", whole - last);
        last = whole;
    }
    fputc(']', stream);
}

static void write_events(const CzPage *page, FILE *stream) {
    fputs("\"events\":[", stream);
    for (int i = 0; i < page->summary->n_event; i++) {
        const CzEvent *event = &page->summary->event[i];
        char time[CZ_FIGURE_ROOM], text[128];
        snprintf(text, sizeof text, "%s %s", cz_event_text(event->what), event->where);
        for (char *c = text; c < text + strlen(cz_event_text(event->what)); c++)
            *c = *c == '_' ? ' ' : *c;
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
    bool *taken = calloc((size_t)page->n_sample, sizeof *taken);
    if (taken == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report");
    choose(page, taken);
    cz_markup_open(markup, "script");
    cz_markup_attribute(markup, "type", "application/json");
    cz_markup_attribute(markup, "id", "data");
    cz_markup_raw(markup, "{");
    write_channel(markup->stream, "t_ms", page->time, page->n_sample, taken);
    for (int channel = 1; channel < cz_run_n_channel(page->run); channel++) {
        const char *name = cz_run_channel_name(page->run, channel);
        if (!is_shown(name))
            continue;
        fputs(",\n", markup->stream);
        write_channel(markup->stream, name, cz_run_channel(page->run, channel), page->n_sample,
                      taken);
    }
    fputs(",\n", markup->stream);
    write_events(page, markup->stream);
    cz_markup_raw(markup, "}");
    cz_markup_close(markup);
    cz_markup_line(markup);
    free(taken);
    return CZ_OK;
}
