/* Measured time histories in files, read as curve files are (text/curve_file.h).
 *
 * Times rise from line to line, so what `run` writes as channels.csv can be read as well. A value
 * without a unit is in that of its channel.
 */
#ifndef CZ_PROBLEM_MEASURED_H
#define CZ_PROBLEM_MEASURED_H

#include "problem/reading.h"

/* Reads the time histories that the problem's matches name. */
void cz_measured_read(CzProblem *problem);

#endif
