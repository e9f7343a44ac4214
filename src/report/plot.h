/* Diagrams of curves as SVG: axes, limits, shaded bands, and a legend below the axes.
 *
 * Colours are those of Okabe and Ito, which people with any colour vision distinguish; dashes
 * distinguish curves without colour. Ink is `currentColor`, so that a page may be light or dark.
 */
#ifndef CZ_REPORT_PLOT_H
#define CZ_REPORT_PLOT_H

#include "report/markup.h"

enum {
    CZ_PLOT_WIDTH = 480,      /* of every diagram, in the units of its text */
    CZ_PLOT_N_COLOUR = 7,     /* colours before they repeat */
    CZ_PLOT_QUIET = -1,       /* colour of a curve in the background */
    CZ_PLOT_MAX_POINTS = 2000 /* of a curve */
};

typedef enum CzSeriesForm {
    CZ_SERIES_CURVE,
    CZ_SERIES_AREA,   /* filled down to its first point's y, such as the bars of a histogram */
    CZ_SERIES_POINTS, /* small dots */
    CZ_SERIES_DOTS,   /* marks for single points, which may have numbers: dots, rings, crosses */
    CZ_SERIES_RINGS,
    CZ_SERIES_CROSSES
} CzSeriesForm;

/* One curve. Texts and numbers are borrowed; a point with a number that is not finite is a gap. */
typedef struct CzSeries {
    const char *name;                  /* in the legend; NULL: not there */
    const char *x_channel, *y_channel; /* recorded channels that it shows, for the cursor; NULL when
                                          none; x_channel NULL: time */
    int n;
    const double *x, *y; /* (n) */
    int colour;          /* index, repeated beyond CZ_PLOT_N_COLOUR, or CZ_PLOT_QUIET */
    CzSeriesForm form;
    int dash;          /* 0 solid, 1 dashed, 2 dotted, 3 dash-dotted */
    const int *number; /* beside each mark, 0 for none; NULL for none at all (n) */
} CzSeries;

/* A limit. */
typedef struct CzPlotLimit {
    const char *name;
    double at;
} CzPlotLimit;

/* A shaded band of the x axis. */
typedef struct CzPlotBand {
    const char *name; /* in the legend, once for bands of one name; NULL: not there */
    double from, to;
    int colour;
} CzPlotBand;

typedef struct CzPlot {
    const char *title; /* for screen readers */
    const char *x_label, *y_label;
    int n_series, n_limit, n_band;
    const CzSeries *series;   /* (n_series) */
    const CzPlotLimit *limit; /* (n_limit) */
    const CzPlotBand *band;   /* (n_band) */
    bool is_time;             /* the x axis is time, so that the page's cursor covers it */
    bool is_still;            /* no cursor covers it */
    bool from_zero;           /* the y axis includes 0 */
    bool counts;              /* the y axis has whole numbers only */
    double height;            /* of the area between the axes; 0: as usual */
} CzPlot;

/* Writes the diagram as an element `svg`, or as a figure of a page under its title; without memory
 * the markup has failed. */
void cz_plot_write(const CzPlot *plot, CzMarkup *markup);
void cz_plot_write_figure(const CzPlot *plot, CzMarkup *markup);

/* Begins a file that is one figure, which has a white background. */
void cz_svg_begin_document(CzMarkup *markup);
/* Opens an `svg` of that size with the attributes of every figure; the caller may add attributes,
 * ends the tag, and closes the element. */
void cz_svg_open(CzMarkup *markup, const char *title, double width, double height);
/* The same for n tiles in rows of two, each as wide as a diagram, of that height and with a
 * heading; opens tile i with its heading, `inset` from the left. */
void cz_svg_open_tiles(CzMarkup *markup, const char *title, int n, double height);
void cz_svg_open_tile(CzMarkup *markup, int i, double height, double inset, const char *heading);
/* Text in a figure, `anchor` being "start", "middle" or "end". */
void cz_svg_text(CzMarkup *markup, double x, double y, const char *anchor, const char *text);

/* Width of a text in a sans-serif font [font size]; an estimate on the large side. */
double cz_text_width(const char *text);

/* Colour of a curve, and its dash pattern; NULL for a solid one. */
const char *cz_plot_colour(int colour);
const char *cz_plot_dash(int dash);

/* A round step that divides a range into about `n` parts. */
double cz_plot_round_step(double range, int n);

#endif
