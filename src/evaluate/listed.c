/* Places and values of variables with a list of sizes. */
#include "evaluate/listed.h"

#include <math.h>

double cz_listed_value(const CzVariableInfo *variable, double place) {
    const int last = variable->n_value - 1;
    const double below = floor(place);
    const int i = below < 0 ? 0 : below >= last ? last : (int)below;
    const double share = i == last || place < 0 ? 0 : place - i;
    return share == 0 ? variable->value[i]
                      : variable->value[i] + share * (variable->value[i + 1] - variable->value[i]);
}

double cz_listed_place(const CzVariableInfo *variable, double value) {
    const double *list = variable->value;
    int i = 0;
    while (i < variable->n_value - 1 && list[i + 1] <= value)
        i++;
    return i == variable->n_value - 1 || value <= list[i]
               ? i
               : i + (value - list[i]) / (list[i + 1] - list[i]);
}

CzSearchRange cz_search_range(const CzVariableInfo *variable, double start) {
    if (variable->n_value > 0)
        return (CzSearchRange){0, variable->n_value - 1, cz_listed_place(variable, start), 1};
    return (CzSearchRange){variable->min, variable->max, start, variable->increment};
}

double cz_search_value(const CzVariableInfo *variable, double number) {
    return variable->n_value > 0 ? cz_listed_value(variable, number) : number;
}

bool cz_variable_has(const CzVariableInfo *variable, double value) {
    const double step = variable->increment;
    if (variable->n_value > 0) {
        const double place = cz_listed_place(variable, value);
        return place == floor(place) && variable->value[(int)place] == value;
    }
    return !(step > 0) || round(value / step) * step == value;
}
