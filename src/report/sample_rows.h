/* Rows of samples.csv: the words that csv.c writes and sample_rows.c reads. */
#ifndef CZ_REPORT_SAMPLE_ROWS_H
#define CZ_REPORT_SAMPLE_ROWS_H

/* Columns before those of the draws and checks; the last column is the message. */
#define CZ_SAMPLE_HEADS                                                                            \
    "sample", "state", "verdict", "beyond_validity", "margin", "check", "scenario"
enum { CZ_SAMPLE_N_HEAD = 7 };

/* A check without a margin: of a yes or no, and of a run that failed. */
#define CZ_SAMPLE_PASSES "pass"
#define CZ_SAMPLE_FAILS "fail"
#define CZ_SAMPLE_FAILED "failed"

#endif
