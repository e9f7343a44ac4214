/* Common parts of pages: head, links to the sections, foot. */
#include "report/page.h"

#include "report/assets.h"
#include "report/document_lines.h"
#include "report/page_deciding.h"

void cz_page_write_head(CzMarkup *markup, const char *title) {
    char policy[400]; /* nothing may be loaded or sent; script and style are allowed by their hashes
                       */
    snprintf(policy, sizeof policy,
             "default-src 'none'; script-src 'sha256-%s'; style-src 'sha256-%s'; img-src data:; "
             "base-uri 'none'; form-action 'none'",
             cz_report_js_sha256, cz_report_css_sha256);
    cz_markup_write(markup,
                    "<!DOCTYPE html>\n<html lang='en'>\n<head><meta charset='utf-8'/>\n"
                    "<meta http-equiv='Content-Security-Policy' content='%s'/>\n"
                    "<meta name='viewport' content='width=device-width, initial-scale=1'/>\n"
                    "<title>%s</title>\n<style>",
                    policy, title);
    fputs(cz_report_css, markup->stream);
    cz_markup_write(markup, "</style>\n</head>\n<body>\n");
}

void cz_page_write_document(CzMarkup *markup, const CzProblem *problem) {
    char text[CZ_DOCUMENT_SIZE];
    cz_markup_write(markup, "<dl class='document'>");
    for (int i = 0; i < CZ_N_DOCUMENT_LINE; i++) {
        const char *line = cz_document_text(problem, i, text);
        if (line != NULL)
            cz_markup_write(markup, "<div><dt>%s</dt><dd>%s</dd></div>", cz_document_title(i),
                            line);
    }
    cz_markup_write(markup, "</dl>\n");
}

void cz_page_write_foot(CzMarkup *markup) {
    cz_markup_write(markup, "<script>");
    fputs(cz_report_js, markup->stream);
    cz_markup_write(markup, "</script>\n</body></html>\n");
}

void cz_page_write_contents(CzPage *page, bool of_search) {
    enum {
        ALWAYS = 0,
        OF_FIGURES = 1,
        OF_FULL_CARS = 2,
        OF_BUDGET = 4,
        OF_SEARCH = 8,
        OF_SEVERAL = 16,
        OF_TOP = 32
    };
    static const struct {
        const char *id, *name;
        int where; /* required results */
    } parts[] = {{"matrix", "criteria and scenarios", OF_SEVERAL},
                 {"checks", "checks", ALWAYS},
                 {"variables", "variables", OF_SEARCH},
                 {"active", "active constraints", OF_SEARCH},
                 {"verification", "verification", OF_SEARCH},
                 {"values", "new values", OF_SEARCH},
                 {"deciding", "figures that decide", OF_TOP},
                 {"trains", "trains", ALWAYS},
                 {"loops", "force over closure", OF_FIGURES},
                 {"energy", "energy", OF_FIGURES},
                 {"motion", "speed and acceleration", OF_FIGURES},
                 {"vertical", "wheels and pitch", OF_FIGURES | OF_FULL_CARS},
                 {"budget", "pitch: moments and impulses", OF_FULL_CARS | OF_BUDGET},
                 {"animation", "animation", OF_FIGURES},
                 {"events", "events", ALWAYS},
                 {"inputs", "inputs", ALWAYS}};
    int there = (page->n_sample > 1 ? OF_FIGURES : 0) | (of_search ? OF_SEARCH : 0) |
                (page->summary->budget != NULL ? OF_BUDGET : 0) |
                (cz_page_has_matrix(page) ? OF_SEVERAL : 0) |
                (page->deciding != NULL && page->deciding->n_figure > 0 ? OF_TOP : 0);
    for (int car = 0; car < page->model->n_car; car++)
        there |= page->model->car[car].model == CZ_MODEL_FULL ? OF_FULL_CARS : 0;
    cz_markup_write(&page->markup, "<nav>");
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if ((parts[i].where & ~there) == 0)
            cz_markup_write(&page->markup, "<a href='#%s'>%s</a> ", parts[i].id, parts[i].name);
    cz_markup_write(&page->markup, "</nav>\n");
}
