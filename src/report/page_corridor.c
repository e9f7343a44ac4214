/* A corridor as a page: what a supplier may deliver, and the conditions under which it was found.
 */
#include "report/page_corridor.h"

#include "base/error.h"
#include "problem/problem.h"
#include "report/corridor_table.h"
#include "report/figure.h"
#include "report/page.h"
#include "report/sample_table.h"
#include "report/table.h"
#include "report/verdict_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the device ---- */

static void write_banner(CzMarkup *markup, const CzCorridor *corridor) {
    char text[CZ_CORRIDOR_SENTENCE];
    cz_corridor_result_sentence(corridor, text);
    cz_markup_write(markup, "<header><p class='banner %s'>%s</p></header>\n",
                    !corridor->exists                                      ? "fail"
                    : corridor->curve[0].verdict == CZ_VERDICT_PROVISIONAL ? "careful"
                                                                           : "pass",
                    text);
    cz_corridor_device_sentence(corridor, text);
    cz_markup_write(markup, "<p><strong>Device: %s.</strong></p>\n", text);
    if (corridor->is_interrupted)
        cz_markup_write(markup, "<p class='fail'>Interrupted: not all curves were tried.</p>\n");
}

static void put_row(CzReportTable *table, const char *name, const char *low, const char *nominal,
                    const char *high) {
    cz_table_put(table, name);
    cz_table_put(table, low);
    cz_table_put(table, nominal);
    cz_table_put(table, high);
}

/* Peak, mean force, stroke and energy of both edges. */
static void write_summary(CzMarkup *markup, const CzCorridor *corridor) {
    CzReportTable table;
    char text[3][CZ_FIGURE_SIZE];
    const double stroke = corridor->stroke[corridor->n_point - 1];
    const double factor[] = {1 - corridor->edge[0].width, 1, 1 + corridor->edge[1].width};
    cz_table_begin(&table, "of one device;>lower;>nominal;>upper");
    if (corridor->peak_word != NULL) {
        for (int c = 0; c < 3; c++)
            cz_figure_digits(text[c], 6, 1e-3 * corridor->peak * factor[c]);
        char name[40];
        snprintf(name, sizeof name, "%s [kN]", corridor->peak_word);
        put_row(&table, name, text[0], text[1], text[2]);
    }
    for (int c = 0; c < 3; c++)
        cz_figure_digits(text[c], 5, 1e-3 * corridor->energy[c] / stroke);
    put_row(&table, "mean force [kN]", text[0], text[1], text[2]);
    for (int c = 0; c < 3; c++)
        cz_figure_digits(text[c], 5, 1e-3 * corridor->energy[c]);
    put_row(&table, "energy over the whole stroke [kJ]", text[0], text[1], text[2]);
    cz_figure_digits(text[0], 6, 1e3 * stroke);
    put_row(&table, "stroke [mm]", text[0], text[0], text[0]);
    cz_table_write_page(&table, markup);
}

static void write_corridor(CzMarkup *markup, const CzCorridor *corridor) {
    CzReportTable table;
    cz_markup_write(markup, "<section id='corridor'>\n<h2>Force-stroke corridor</h2>\n");
    if (corridor->exists)
        cz_markup_write(
            markup,
            "<p>The force of one device over its %s stroke lies between the lower and the "
            "upper curve at every stroke, and its stroke is not shorter. Between two "
            "strokes of the table the edges are straight lines.</p>\n",
            strcmp(corridor->what, "end") == 0 ? "total" : "crush");
    cz_markup_write(markup, "<div class='figures'>");
    cz_corridor_draw(corridor, true, markup);
    cz_markup_write(markup, "<div>");
    if (corridor->exists) {
        cz_corridor_begin_points(&table, corridor);
        cz_table_write_page(&table, markup);
        write_summary(markup, corridor);
    }
    cz_markup_write(markup, "</div></div>\n</section>\n");
}

static void write_limits(CzMarkup *markup, const CzCorridor *corridor) {
    CzReportTable table;
    char text[CZ_CORRIDOR_SENTENCE];
    if (!corridor->exists)
        return;
    cz_markup_write(markup, "<section id='limits'>\n<h2>What limits it</h2>\n");
    cz_corridor_begin_edges(&table, corridor);
    cz_table_write_page(&table, markup);
    for (int edge = 0; edge < 2; edge++)
        if (cz_corridor_message(corridor, edge) != NULL)
            cz_markup_write(markup, "<p>%s edge: %s.</p>\n", edge == 0 ? "Lower" : "Upper",
                            cz_corridor_message(corridor, edge));
    cz_corridor_tried_sentence(corridor, text);
    cz_markup_write(markup, "<p>%s.</p>\n", text);
    if (corridor->n_refused > 0)
        cz_markup_write(markup,
                        "<p>%d curves violate a rule of problem files, such as an end that unloads "
                        "more softly than it loads; they count as failing.</p>\n",
                        corridor->n_refused);
    cz_markup_write(markup, "</section>\n");
}

/* ---- conditions ---- */

static void write_trains(CzMarkup *markup, const CzCorridor *corridor) {
    const CzInput *input = cz_problem_input(corridor->problem);
    CzReportTable table;
    char text[CZ_FIGURE_SIZE];
    cz_table_begin(&table, "train;>vehicles;>mass [t];>payload [t]");
    for (int i = 0; i < input->n_trains; i++) {
        const CzTrain *train = &input->trains[i];
        double mass = 0, payload = 0;
        for (int v = 0; v < train->n_vehicles; v++) {
            mass += isnan(train->vehicles[v].mass) ? 0 : train->vehicles[v].mass;
            payload += train->vehicles[v].payload;
        }
        cz_table_put(&table, train->name);
        cz_table_put(&table, cz_figure_digits(text, 6, train->n_vehicles));
        cz_table_put(&table, mass > 0 ? cz_figure_digits(text, 5, 1e-3 * mass) : "fixed");
        cz_table_put(&table, cz_figure_digits(text, 5, 1e-3 * payload));
    }
    cz_table_write_page(&table, markup);
}

static void put_number(CzReportTable *table, double value, double scale) {
    char text[CZ_FIGURE_SIZE];
    cz_table_put(table, isnan(value) ? "" : cz_figure_digits(text, 5, scale * value));
}

static void write_scenarios(CzMarkup *markup, const CzCorridor *corridor) {
    const CzInput *input = cz_problem_input(corridor->problem);
    CzReportTable table;
    cz_table_begin(&table, "scenario;train behind;>speed [km/h];train ahead;>speed [km/h];>height "
                           "offset [mm];>mass factor;>payload share");
    for (int s = 0; s < corridor->n_scenario; s++) {
        const CzScenario *scenario = &input->scenarios[corridor->scenario[s]];
        const double own[2] = {scenario->speed, scenario->partner_speed};
        cz_table_put(&table, scenario->name);
        for (int side = 0; side < 2; side++) {
            const CzTrain *train = cz_input_train(input, scenario, side);
            cz_table_put(&table, train != NULL ? train->name : "");
            put_number(&table,
                       !isnan(own[side]) ? own[side]
                       : train != NULL   ? train->speed
                                         : NAN,
                       3.6);
        }
        const CzTrain *ahead = cz_input_train(input, scenario, 1);
        put_number(&table,
                   !isnan(scenario->height_offset) ? scenario->height_offset
                   : ahead != NULL                 ? ahead->height_offset
                                                   : NAN,
                   1e3);
        put_number(&table, scenario->mass_factor, 1);
        put_number(&table, scenario->payload_share, 1);
    }
    cz_table_write_page(&table, markup);
}

static void write_scatter(CzMarkup *markup, const CzCorridor *corridor) {
    CzReportTable table;
    if (corridor->n_draw == 0) {
        cz_markup_write(markup, "<h3>Scatter</h3>\n<p>None: everything but this device has its "
                                "nominal value.</p>\n");
        return;
    }
    cz_markup_write(markup,
                    "<h3>Scatter</h3>\n<p>Sampled %d times. The forces and strokes of this device "
                    "are those of each curve and do not scatter beside it.</p>\n",
                    corridor->n_random);
    cz_sample_begin_draws(&table, CZ_DRAW_HEADS("random number"), corridor->n_draw, corridor->draw);
    cz_table_write_page(&table, markup);
}

static void write_conditions(CzMarkup *markup, const CzCorridor *corridor) {
    cz_markup_write(markup, "<section id='conditions'>\n<h2>Conditions</h2>\n<h3>Trains and "
                            "collisions</h3>\n");
    write_trains(markup, corridor);
    write_scenarios(markup, corridor);
    write_scatter(markup, corridor);
    cz_markup_write(markup, "<h3>Checks</h3>\n<p>");
    for (int i = 0; i < corridor->n_check; i++)
        cz_markup_write(markup, "%s%s", i > 0 ? "; " : "", corridor->check[i]);
    cz_markup_write(markup,
                    ".</p>\n<p>Design rules hold as physical limits here, except those whose "
                    "reserves the file keeps. The design as written, with its reserves: %s.</p>\n",
                    cz_verdict_words(corridor->design.verdict, corridor->design.n_not_covered));
    cz_markup_write(markup, "</section>\n");
}

/* What the corridor does not say. */
static void write_open(CzMarkup *markup, const CzCorridor *corridor) {
    cz_markup_write(markup, "<section id='open'>\n<h2>Not covered</h2>\n<ul>\n"
                            "<li>That no other curve within the corridor fails is not proved; the "
                            "number of curves that were tried is given above.</li>\n"
                            "<li>The corridor is that of the curve as the problem file gives it. "
                            "The law of the device adds its rate and speed factors, which stay "
                            "nominal, as do its stiffness and its stroke.</li>\n");
    if (corridor->n_place * corridor->count > 1)
        cz_markup_write(markup,
                        "<li>All %d devices have the same curve at a time; differences between "
                        "them were not tried.</li>\n",
                        corridor->n_place * corridor->count);
    cz_markup_write(markup,
                    "<li>A curve is made of pieces of constant or evenly rising force, %d "
                    "of them here; oscillations within a piece were not tried.</li>\n",
                    corridor->n_piece);
    if (corridor->n_scenario < cz_problem_n_scenario(corridor->problem))
        cz_markup_write(markup,
                        "<li>%d scenarios of the problem were left out, such as overload "
                        "cases.</li>\n",
                        cz_problem_n_scenario(corridor->problem) - corridor->n_scenario);
    cz_markup_write(markup, "</ul>\n");
    cz_not_checked_write(&corridor->design, markup);
    cz_markup_write(markup, "</section>\n");
}

CzStatus cz_page_write_corridor(const CzReport *report, FILE *stream, CzError *error) {
    const CzCorridor *corridor = report->corridor;
    CzMarkup markup = {.stream = stream};
    char title[CZ_SENTENCE_SIZE];
    snprintf(title, sizeof title, "%s: corridor of %s", cz_problem_title(corridor->problem),
             corridor->path);
    cz_page_write_head(&markup, title);
    cz_markup_write(&markup, "<h1>%s</h1>", title);
    cz_page_write_document(&markup, corridor->problem);
    write_banner(&markup, corridor);
    cz_markup_write(&markup,
                    "<nav><a href='#corridor'>corridor</a> <a href='#limits'>what limits it</a> "
                    "<a href='#conditions'>conditions</a> <a href='#open'>not covered</a></nav>\n");
    write_corridor(&markup, corridor);
    write_limits(&markup, corridor);
    write_conditions(&markup, corridor);
    write_open(&markup, corridor);
    cz_markup_write(&markup, "<p>Problem %s, hash %s; crushzone %s.</p>\n",
                    cz_problem_file(corridor->problem), cz_problem_hash(corridor->problem),
                    cz_version());
    cz_page_write_foot(&markup);
    return markup.failed ? cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory for the report") : CZ_OK;
}
