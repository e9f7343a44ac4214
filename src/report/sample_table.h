/* A sampling as tables and sentences, for the terminal and the page. */
#ifndef CZ_REPORT_SAMPLE_TABLE_H
#define CZ_REPORT_SAMPLE_TABLE_H

#include "crushzone/sample.h"
#include "report/table.h"

enum { CZ_SAMPLE_SENTENCE = 300 };

/* Checks in the order of interest: those that fail most often first, then by their margins; to be
 * freed (n_check), NULL without memory. */
int *cz_sample_order(const CzSampling *sampling);

/* Sentences without their full stop: how many samples pass, and how they were drawn. */
void cz_sample_share_sentence(const CzSampling *sampling, char text[CZ_SAMPLE_SENTENCE]);
void cz_sample_method_sentence(const CzSampling *sampling, char text[CZ_SAMPLE_SENTENCE]);

/* how many samples have no verdict, and the first check that cannot be made; false for none. */
bool cz_sample_unjudged_sentence(const CzSampling *sampling, char text[CZ_SAMPLE_SENTENCE]);

/* The table of checks, or of the worst one of each name; returns the number of those left out. */
int cz_sample_begin_checks(CzReportTable *table, const CzSampling *sampling, const int *order,
                           bool each_name_once);
/* The table of numbers that vary, below these heads. */
#define CZ_DRAW_HEADS(number) number ";distribution;range;>values"
void cz_sample_begin_draws(CzReportTable *table, const char *heads, int n_draw, const CzDraw *draw);

/* Puts a margin: "failed" for -infinity, that of a failed run, "-" for NaN. */
void cz_sample_put_margin(CzReportTable *table, double margin);

#endif
