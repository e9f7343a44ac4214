/* Events, inputs, defaults, assumptions, and reproduction. */
#include "report/page.h"

#include "base/error.h"
#include "problem/keys.h"
#include "text/node.h"
#include "problem/problem.h"
#include "report/figure.h"
#include "report/inputs_text.h"
#include "report/runs.h"
#include "report/table.h"
#include "report/units.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_SOURCE_LINES = 600 };

static bool is_bad(CzEventKind what) {
    return what == CZ_EVENT_BOTTOMED_OUT || what == CZ_EVENT_OVERRIDE ||
           what == CZ_EVENT_WHEEL_LIFT;
}

void cz_page_event_words(CzEventKind kind, char words[48]) {
    static const char *const joined[] = {"anti climber", "shear off"};
    snprintf(words, 48, "%s", cz_event_text(kind));
    for (char *c = words; *c != '\0'; c++)
        *c = *c == '_' ? ' ' : *c;
    for (int i = 0; i < 2; i++)
        if (strncmp(words, joined[i], strlen(joined[i])) == 0)
            *strchr(words, ' ') = '-';
}

void cz_page_write_events(CzPage *page) {
    const CzRunSummary *run = page->summary;
    CzReportTable table;
    cz_markup_write(&page->markup, "<section id='events'>\n<h2>Events</h2>\n");
    cz_table_begin(&table, ">time ms;what;where;interface");
    for (int i = 0; i < run->n_event; i++) {
        const CzEvent *event = &run->event[i];
        const bool has_interface = event->interface >= 0 && event->interface < run->n_interface;
        char time[CZ_FIGURE_SIZE], what[48];
        cz_page_event_words(event->what, what);
        cz_table_put(&table, cz_figure_fixed(time, 1, event->time * CZ_MILLI_PER_UNIT));
        cz_table_put_styled(&table, what, is_bad(event->what) ? CZ_STYLE_BAD : CZ_STYLE_PLAIN);
        cz_table_put(&table, event->where);
        cz_table_put(&table, has_interface ? run->interface[event->interface].name : "");
    }
    cz_table_write_page(&table, &page->markup);
    cz_markup_write(&page->markup, "</section>\n");
}

/* ---- reproduction ---- */

static void quote(char *text, size_t room, const char *word) {
    const char *plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=+,:@%";
    size_t used = strlen(text);
    const bool needs = word[strspn(word, plain)] != '\0' || word[0] == '\0';
    if (!needs) {
        snprintf(text + used, room - used, " %s", word);
        return;
    }
    used += (size_t)snprintf(text + used, room - used, " '");
    for (; *word != '\0' && used + 8 < room; word++)
        used += (size_t)snprintf(text + used, room - used, *word == '\'' ? "'\\''" : "%c", *word);
    snprintf(text + used, room - used, "'");
}

static void write_command(CzPage *page) {
    char text[4096];
    const CzReportOptions *options = page->options;
    snprintf(text, sizeof text, "crushzone %s",
             options->command != NULL ? options->command : "run");
    quote(text, sizeof text,
          options->text != NULL
              ? "-"
              : cz_problem_reported_name(page->problem, cz_problem_file(page->problem)));
    for (int i = 0; i < options->n_word; i++)
        quote(text, sizeof text, options->word[i]);
    for (int i = 0; i < options->n_set && strlen(text) + 512 < sizeof text; i++) {
        snprintf(text + strlen(text), sizeof text - strlen(text), " --set");
        quote(text, sizeof text, options->set[i]);
    }
    cz_markup_write(&page->markup,
                    "<h3>Reproduction</h3><pre>%s</pre><p>or%s: crushzone run resolved.yaml. The "
                    "same version gives the same bytes on every machine.</p>",
                    text,
                    options->command != NULL ? " the best design alone, from the result folder"
                                             : ", from the result folder alone");
}

static void write_versions(CzPage *page) {
    char nlopt[32] = "", sundials[32] = "";
    cz_nlopt_version(nlopt, sizeof nlopt);
    cz_sundials_version(sundials, sizeof sundials);
    cz_markup_write(&page->markup,
                    "<p>crushzone %s, NLopt %s, SUNDIALS %s; problem file %s, content hash %s</p>",
                    cz_version(), nlopt, sundials,
                    cz_problem_reported_name(page->problem, cz_problem_file(page->problem)),
                    cz_problem_hash(page->problem));
}

static void write_assumptions(CzPage *page) {
    static const char *const assumptions[] = {
        "Motion is longitudinal, vertical and pitch; there is no lateral motion.",
        "Car bodies are rigid between their crush zones; their bending and the strength beyond "
        "the crush zones are not computed.",
        "Absorbers follow the given curves; beyond the last point they are stiff, which is "
        "reported as bottoming out.",
        "Override is judged until engagement is lost or a wheel is above its flange; later results "
        "are beyond the validity of the model.",
        "A pass is not a certificate; PROVISIONAL marks a limit or scenario that is not "
        "confirmed."};
    CzMarkup *markup = &page->markup;
    const CzWord *track =
        &cz_word_sets[CZ_WORDS_TRACK].word[cz_problem_input(page->problem)->simulation.track];
    cz_markup_write(markup, "<h3>Assumptions</h3><ul><li>Track: %s, %s.</li>", track->word,
                    track->doc);
    for (size_t i = 0; i < sizeof assumptions / sizeof *assumptions; i++)
        cz_markup_write(markup, "<li>%s</li>", assumptions[i]);
    for (int i = 0; i < cz_problem_n_warning(page->problem); i++)
        cz_markup_write(markup, "<li>Warning: %s</li>",
                        cz_problem_warning(page->problem, i)->message);
    cz_markup_write(markup, "</ul>\n");
}

/* ---- inputs ---- */

static void write_sources(CzPage *page) {
    CzMarkup *markup = &page->markup;
    cz_markup_write(markup, "<h3>Inputs as written</h3>");
    for (const CzSource *source = cz_problem_first_source(page->problem); source != NULL;
         source = source->next) {
        cz_markup_write(markup, "<details><summary>%s</summary><pre>",
                        cz_problem_reported_name(page->problem, source->name));
        for (int i = 0; i < source->n_line && i < MAX_SOURCE_LINES; i++)
            cz_markup_write(markup, "%s\n", source->line[i]);
        if (source->n_line > MAX_SOURCE_LINES)
            cz_markup_write(markup, "... and %d lines more", source->n_line - MAX_SOURCE_LINES);
        cz_markup_write(markup, "</pre></details>\n");
    }
}

void cz_page_write_inputs(CzPage *page) {
    CzMarkup *markup = &page->markup;
    cz_markup_write(markup, "<section id='inputs'>\n<h2>Inputs and reproduction</h2>\n");
    write_command(page);
    write_versions(page);
    write_assumptions(page);
    cz_markup_write(markup, "<h3>Defaults used</h3>");
    cz_inputs_text_write_defaults(&page->inputs, markup);
    write_sources(page);
    cz_markup_write(markup,
                    "<h3>Complete problem in SI units, with the origin of each value</h3>"
                    "<p>Parts of an origin are given where its record does not give them.</p>"
                    "<details><summary>resolved problem; of equal cars, and of equal ends and "
                    "bogies, only the first</summary>"
                    "<pre>");
    cz_inputs_text_write(&page->inputs, markup);
    cz_markup_write(markup, "</pre></details></section>\n");
}
