/* A problem once more with further settings, from the tree that was read: no file is opened but
 * those of curves. */
#include <string.h>

#include "base/error.h"
#include "problem/rules.h"

/* The problem's settings and after them the further ones; NULL without memory. */
static CzSetting *join_settings(CzProblem *again, const CzProblem *problem, int n_more,
                                const char *const *path, const char *const *value) {
    CzReader *reader = &again->reader;
    const int n = problem->n_setting;
    CzSetting *setting = cz_arena_allocate(&reader->arena, (size_t)(n + n_more), sizeof *setting);
    const CzSource *source = cz_sources_add(&reader->sources, "(settings)", ".", "", 0);
    if (setting == NULL || source == NULL)
        return NULL;
    if (n > 0)
        memcpy(setting, problem->setting, (size_t)n * sizeof *setting);
    const CzNode place = {.source = source, .line = 1, .column = 1};
    for (int i = 0; i < n_more; i++) {
        setting[n + i].place = cz_node_text(&reader->arena, path[i], &place);
        setting[n + i].value = cz_node_text(&reader->arena, value[i], &place);
        if (setting[n + i].place == NULL || setting[n + i].value == NULL)
            return NULL;
        setting[n + i].path = setting[n + i].place->text;
    }
    again->n_setting = n + n_more;
    return setting;
}

CzStatus cz_problem_read_again(const CzProblem *problem, int n_more, const char *const *path,
                               const char *const *value, CzProblem **again, CzError *error) {
    *again = NULL;
    CzProblem *made = cz_problem_create_again(problem);
    if (made == NULL)
        return cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory to read the problem again");
    CzReader *reader = &made->reader;
    made->setting = join_settings(made, problem, n_more, path, value);
    if (made->setting != NULL && !reader->arena.out_of_memory)
        cz_problem_bind(made, &made->tree);
    const CzRules rules = cz_rules_of(made);
    if (!reader->arena.out_of_memory)
        cz_rules_check_collision(&rules);
    CzStatus status = CZ_OK;
    if (reader->arena.out_of_memory) {
        status = cz_fail(error, CZ_STATUS_NO_MEMORY, "no memory to read the problem again");
    } else if (reader->mistakes.n_mistake > 0) {
        cz_mistakes_finish(&reader->mistakes);
        status = CZ_STATUS_INPUT;
        if (error != NULL)
            *error = reader->mistakes.mistake[0]->error;
    }
    if (status != CZ_OK) {
        cz_problem_free(made);
        return status;
    }
    *again = made;
    return CZ_OK;
}
