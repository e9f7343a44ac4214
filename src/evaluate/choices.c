/* Choices of parts, and designs that are reread. */
#include "evaluate/design.h"
#include "base/error.h"
#include "base/number.h"

#include <string.h>

/* ---- the buffer of a choice ------------------------------------------------------------------ */

static const CzBuffer *buffer_at(const CzVehicle *vehicles, const CzDesignPlace *place) {
    return (const CzBuffer *)(const void *)((const char *)&vehicles[place->vehicle] +
                                            place->offset);
}

static bool same_buffers(const CzVehicle *a, const CzVehicle *b, const CzDesignVariable *variable) {
    for (int i = 0; i < variable->n_place; i++)
        if (memcmp(buffer_at(a, &variable->place[i]), buffer_at(b, &variable->place[i]),
                   sizeof(CzBuffer)) != 0)
            return false;
    return true;
}

/* The problem with one choice made and all others as in the file. */
static CzStatus read_choice(const CzProblem *problem, const CzDesignVariable *variable, int choice,
                            CzProblem **chosen, CzError *error) {
    CzArena arena = {0};
    const size_t n = (size_t)variable->info.n_place;
    const char **path = cz_arena_allocate(&arena, n, sizeof *path);
    const char **value = cz_arena_allocate(&arena, n, sizeof *value);
    CzStatus status;
    for (int i = 0; path != NULL && value != NULL && i < variable->info.n_place; i++) {
        path[i] = variable->info.place[i].path;
        value[i] = variable->info.choice[choice];
    }
    if (path != NULL && value != NULL)
        status = cz_problem_read_again(problem, variable->info.n_place, path, value, chosen, error);
    else
        status = cz_no_memory(error, "the choices");
    cz_arena_free(&arena);
    return status;
}

CzStatus cz_choice_find_start(const CzProblem *problem, const CzDesignVariable *variable, int *own,
                              CzError *error) {
    CzProblem *chosen[CZ_MAX_COMBINATIONS] = {NULL};
    int n_vehicle;
    const CzVehicle *vehicles = cz_problem_vehicles(problem, &n_vehicle);
    CzStatus status = CZ_OK;
    *own = -1;
    for (int k = 0; k < variable->info.n_choice && status == CZ_OK; k++) {
        status = read_choice(problem, variable, k, &chosen[k], error);
        if (status != CZ_OK)
            break;
        const CzVehicle *mine = cz_problem_vehicles(chosen[k], &n_vehicle);
        if (*own < 0 && same_buffers(mine, vehicles, variable))
            *own = k;
        for (int j = 0; j < k && status == CZ_OK; j++)
            if (same_buffers(mine, cz_problem_vehicles(chosen[j], &n_vehicle), variable))
                status = cz_fail(error, CZ_STATUS_INPUT, "'%s' gives '%s' and '%s' the same values",
                                 variable->info.name, variable->info.choice[j],
                                 variable->info.choice[k]);
    }
    if (status == CZ_OK && *own < 0)
        status = cz_fail(error, CZ_STATUS_INPUT,
                         "the buffer of the file at '%s' is not one of the choices",
                         variable->info.name);
    for (int k = 0; k < variable->info.n_choice; k++)
        cz_problem_free(chosen[k]);
    return status;
}

/* ---- combinations ---------------------------------------------------------------------------- */

int cz_design_n_combination(const CzDesign *design) {
    int n = 1;
    for (int i = 0; i < design->n_variable; i++)
        if (design->variable[i].info.n_choice > 0)
            n *= design->variable[i].info.n_choice;
    return n;
}

int cz_design_combination(const CzDesign *design, const double *x) {
    int combination = 0, stride = 1;
    for (int i = 0; i < design->n_variable; i++) {
        const int n_choice = design->variable[i].info.n_choice;
        if (n_choice == 0)
            continue;
        const double choice = fmin(fmax(floor(x[i] + 0.5), 0), n_choice - 1);
        combination += stride * (int)choice;
        stride *= n_choice;
    }
    return combination;
}

int cz_design_choice(const CzDesign *design, int combination, int variable) {
    for (int i = 0; i < variable; i++)
        if (design->variable[i].info.n_choice > 0)
            combination /= design->variable[i].info.n_choice;
    return combination % design->variable[variable].info.n_choice;
}

bool cz_design_settings(const CzDesign *design, int combination, const double *x, CzArena *arena,
                        CzVariantSettings *settings) {
    size_t room = 1;
    for (int i = 0; i < design->n_variable; i++)
        room += (size_t)design->variable[i].info.n_place;
    const char **path = cz_arena_allocate(arena, room, sizeof *path);
    const char **value = cz_arena_allocate(arena, room, sizeof *value);
    *settings = (CzVariantSettings){.path = path, .value = value};
    if (path == NULL || value == NULL)
        return false;
    for (int i = 0; i < design->n_variable; i++) {
        const CzDesignVariable *variable = &design->variable[i];
        for (int k = 0; k < variable->info.n_place; k++) {
            char number[CZ_NUMBER_TEXT];
            if (variable->info.n_choice == 0 && x == NULL)
                continue;
            if (variable->info.n_choice > 0) {
                value[settings->n] =
                    variable->info.choice[cz_design_choice(design, combination, i)];
            } else {
                cz_number_print(number, x[i] * variable->info.place[k].factor);
                value[settings->n] = cz_arena_copy_text(arena, number, strlen(number));
            }
            if (value[settings->n] == NULL)
                return false;
            path[settings->n++] = variable->info.place[k].path;
        }
    }
    return true;
}
