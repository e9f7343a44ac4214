/* What a corridor needs before its first run: scenarios, scatter, quasi-random curves. */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "evaluate/draws.h"
#include "optimise/corridor.h"
#include "statistics/latin.h"
#include "statistics/sobol.h"

/* The scatter, if it is sampled, and the draws of the pieces behind it. */
static CzStatus list_draws(CzCorridor *corridor, CzError *error) {
    CzCorridorParts *parts = corridor->parts;
    const CzUncertainty *uncertainty = &cz_problem_input(corridor->problem)->uncertainty;
    const bool has_scatter = parts->options.has_scatter && uncertainty->n_parameters > 0;
    CzDraw *scatter = NULL;
    if (has_scatter)
        CZ_TRY(cz_draws_list(corridor->problem, corridor->scenario[0], &parts->arena,
                             &corridor->n_draw, &scatter, error));
    const int n = cz_corridor_n_draw(corridor);
    CzDraw *draw = cz_arena_allocate(&parts->arena, (size_t)(corridor->n_draw + n), sizeof *draw);
    if (draw == NULL || !cz_corridor_list_draws(corridor, draw + corridor->n_draw))
        return cz_no_memory(error, "the numbers of a corridor");
    if (corridor->n_draw > 0)
        memcpy(draw, scatter, (size_t)corridor->n_draw * sizeof *draw);
    corridor->draw = draw;
    parts->with_scatter = (CzCases){.problem = parts->divided,
                                    .n_scenario = corridor->n_scenario,
                                    .scenario = corridor->scenario,
                                    .n_draw = corridor->n_draw + n,
                                    .draw = draw,
                                    .word = "corridor",
                                    .n_earlier = cz_cases_n_earlier(corridor->problem, "corridor")};
    parts->bare = parts->with_scatter;
    parts->bare.n_draw = n;
    parts->bare.draw = draw + corridor->n_draw;
    return CZ_OK;
}

/* Values of the scatter, and factors of the quasi-random curves within 0..1. Their dimensions are
 * behind those of the scatter, so that the two do not depend on one another. */
static CzStatus draw_numbers(CzCorridor *corridor, CzError *error) {
    CzCorridorParts *parts = corridor->parts;
    const int n = corridor->n_random, n_factor = cz_corridor_n_factor(corridor);
    double *value = cz_arena_numbers(&parts->arena, (size_t)n * (size_t)corridor->n_draw + 1);
    double *u = cz_arena_numbers(&parts->arena, (size_t)n);
    parts->u = cz_arena_numbers(&parts->arena, (size_t)n * (size_t)n_factor);
    if (value == NULL || u == NULL || parts->u == NULL)
        return cz_no_memory(error, "the curves of a corridor");
    corridor->value = value;
    if (corridor->n_draw > 0)
        CZ_TRY(cz_draws_fill(corridor->problem, corridor->seed, n, corridor->n_draw, corridor->draw,
                             value, error));
    for (int i = 0; i < n_factor; i++) {
        const int dimension = corridor->n_draw + i;
        if (corridor->n_draw + n_factor <= CZ_SOBOL_MAX_DRAWS)
            cz_sobol_draw((uint64_t)corridor->seed, dimension, n, u);
        else
            cz_latin_draw((uint64_t)corridor->seed, dimension, n, u);
        for (int k = 0; k < n; k++)
            parts->u[k * n_factor + i] = u[k];
    }
    return CZ_OK;
}

CzStatus cz_corridor_begin(CzCorridor *corridor, CzError *error) {
    CzCorridorParts *parts = corridor->parts;
    const CzUncertainty *uncertainty = &cz_problem_input(corridor->problem)->uncertainty;
    const CzTexts all = {0};
    CZ_TRY(cz_cases_scenarios(corridor->problem,
                              uncertainty->given ? &uncertainty->scenarios : &all, &parts->arena,
                              &corridor->n_scenario, &corridor->scenario, error));
    CZ_TRY(list_draws(corridor, error));
    return draw_numbers(corridor, error);
}
