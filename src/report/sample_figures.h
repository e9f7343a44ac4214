/* Figures of a sampling: histograms of margins, rank correlations, convergence. */
#ifndef CZ_REPORT_SAMPLE_FIGURES_H
#define CZ_REPORT_SAMPLE_FIGURES_H

#include "crushzone/sample.h"
#include "report/markup.h"

/* Without memory the markup has failed. */

/* Number of samples by the margin of a check. */
void cz_sample_draw_histogram(const CzSampling *sampling, int check, CzMarkup *markup);
/* Rank correlation of the strongest draws with a check, as bars. */
void cz_sample_draw_tornado(const CzSampling *sampling, int check, CzMarkup *markup);
/* Margin of a check and its strongest draws against one another. */
void cz_sample_draw_matrix(const CzSampling *sampling, int check, CzMarkup *markup);
/* Share of passing samples over their number. */
void cz_sample_draw_convergence(const CzSampling *sampling, CzMarkup *markup);

#endif
