/* Figures of the scenarios that decide the criteria of a page. */
#ifndef CZ_REPORT_PAGE_DECIDING_H
#define CZ_REPORT_PAGE_DECIDING_H

#include "report/charts.h"

/* A figure on a page, of the page's own scenario or of another one. */
typedef struct CzDecidingFigure {
    const CzPage *page; /* of its scenario */
    CzChart chart;
    int index;
} CzDecidingFigure;

/* The figures of a page, each once. */
typedef struct CzDeciding {
    int n_page;
    CzPage *page; /* of other scenarios (n_page) */
    int n_figure;
    CzDecidingFigure *figure; /* (n_figure) */
    int *of_row; /* figure of each row of the matrix; -1 for none (rows of the matrix) */
} CzDeciding;

#endif
