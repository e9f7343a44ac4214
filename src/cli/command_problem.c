/* `validate` and `show`: mistakes and properties of a problem, without a run. */
#include "cli/command.h"
#include "cli/messages.h"
#include "cli/result.h"
#include "cli/session.h"
#include "crushzone/optimise.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Names of interfaces that have been reported, since several scenarios have the same ones. */
typedef struct Printed {
    char names[8192]; /* each between line ends */
} Printed;

static bool was_printed(Printed *printed, const char *name) {
    char line[CZ_INTERFACE_SIZE + 2];
    snprintf(line, sizeof line, "\n%s\n", name);
    if (strstr(printed->names, line) != NULL)
        return true;
    const size_t used = strlen(printed->names);
    snprintf(printed->names + used, sizeof printed->names - used, "%s%s\n", used == 0 ? "\n" : "",
             name);
    return false;
}

/* Prints the force at which the train folds at each interface. Tubes with a higher force may fold
 * the train before their stroke is used. */
static void print_folding(const CzArguments *arguments, const CzModel *model, Printed *printed) {
    for (int i = 0; i < cz_model_n_interface(model); i++) {
        const CzInterfaceProperties properties = cz_model_interface_properties(model, i);
        const char *name = cz_model_interface_name(model, i);
        if (isnan(properties.critical_force) || was_printed(printed, name))
            continue;
        if (arguments->text[CZ_OPTION_JSON] == NULL) {
            printf("  interface %s: F_crit %.1f kN", name, 1e-3 * properties.critical_force);
            if (!isnan(properties.tube_force))
                printf(", tubes up to %.1f kN", 1e-3 * properties.tube_force);
            putchar('\n');
        }
        if (properties.tube_force > properties.critical_force)
            cz_print_note(
                arguments,
                "warning: interface %s: the collapse tubes carry up to %.1f kN, more than "
                "F_crit, %.1f kN, at which the train folds there; weaker tubes or stiffer "
                "coupler hinges avoid it",
                name, 1e-3 * properties.tube_force, 1e-3 * properties.critical_force);
    }
}

/* Builds the model of every scenario, because the last rules are checked there. */
static int build_models(const CzSession *session, int *n_vehicle) {
    for (int i = 0; i < cz_problem_n_scenario(session->problem); i++) {
        CzModel *model = NULL;
        CzError error = {0};
        if (cz_model_build(session->problem, i, &model, &error) != CZ_OK)
            return cz_session_fail(session, &error);
        *n_vehicle = cz_model_n_vehicle(model);
        cz_model_free(model);
    }
    return 0;
}

static int print_models(const CzSession *session) {
    Printed printed = {""};
    for (int i = 0; i < cz_problem_n_scenario(session->problem); i++) {
        CzModel *model = NULL;
        CzError error = {0};
        if (cz_model_build(session->problem, i, &model, &error) != CZ_OK)
            return cz_session_fail(session, &error);
        print_folding(session->arguments, model, &printed);
        cz_model_free(model);
    }
    return 0;
}

/* Reports what a search would reject; a problem without variables is not checked. */
static int check_search(const CzSession *session) {
    CzError error = {0};
    if (cz_evaluator_n_variable(session->evaluator) == 0 ||
        cz_optimise_check(session->evaluator, NULL, &error) == CZ_OK)
        return 0;
    return cz_session_fail(session, &error);
}

/* Devices that yield before those in front of them. */
static void print_force_order(const CzSession *session) {
    enum { MAX_FORCE_STEPS = 20 };
    CzForceStep step[MAX_FORCE_STEPS];
    const int n = cz_evaluator_force_order(session->evaluator, MAX_FORCE_STEPS, step);
    for (int i = 0; i < n; i++)
        cz_print_note(
            session->arguments,
            "warning: force ladder out of order at %s: %s is %.2f, above 1 (docs/theory.md, "
            "Force ladder)",
            step[i].where, step[i].what, step[i].ratio);
}

/* Variables that a search will not vary. */
static void print_fixed(const CzSession *session) {
    for (int i = 0; i < cz_evaluator_n_variable(session->evaluator); i++) {
        const CzVariableInfo *info = cz_evaluator_variable(session->evaluator, i);
        if (info->is_fixed)
            printf("  variable %s is fixed at %.10g %s: its bounds contain no other %s\n",
                   info->name, info->fixed_at, info->unit,
                   info->min == info->max ? "value" : "increment");
    }
}

static int validate_file(const CzArguments *arguments, const char *file) {
    CzSession session;
    int n_vehicle = 0;
    int code = cz_session_begin(&session, arguments, file);
    if (code == 0)
        code = build_models(&session, &n_vehicle);
    if (code == 0)
        code = check_search(&session);
    if (code == 0 && arguments->text[CZ_OPTION_JSON] != NULL)
        printf("{\"format\": \"crushzone.validation\", \"version\": 1, \"status\": \"ok\", "
               "\"hash\": \"%s\", \"scenarios\": %d, \"vehicles\": %d, \"variables\": %d}\n",
               cz_problem_hash(session.problem), cz_problem_n_scenario(session.problem), n_vehicle,
               cz_evaluator_n_variable(session.evaluator));
    else if (code == 0)
        printf("%s: ok, %d scenarios, %d vehicles, %d design variables\n", file,
               cz_problem_n_scenario(session.problem), n_vehicle,
               cz_evaluator_n_variable(session.evaluator));
    if (code == 0 && arguments->text[CZ_OPTION_JSON] == NULL)
        print_fixed(&session);
    if (code == 0)
        code = print_models(&session);
    if (code == 0)
        print_force_order(&session);
    cz_session_end(&session);
    return code;
}

int cz_command_validate(const CzArguments *arguments) {
    int worst = 0;
    for (int i = 0; i < arguments->n_operand; i++) {
        const int code = validate_file(arguments, arguments->operand[i]);
        worst = code > worst ? code : worst;
    }
    return worst;
}

static void put_number(double value, double unit, int decimals) {
    if (isnan(value))
        printf(" %9s", "-");
    else
        printf(" %9.*f", decimals, value / unit);
}

static void show_vehicles(const CzModel *model) {
    printf("#\n# %-9s %9s %9s %9s %9s %9s %9s %9s %9s %9s\n", "vehicle", "mass t", "axle 1 kN",
           "axle 2 kN", "axle 3 kN", "axle 4 kN", "prim. mm", "sec. mm", "bounce Hz", "pitch Hz");
    for (int i = 0; i < cz_model_n_vehicle(model); i++) {
        const CzVehicleProperties properties = cz_model_vehicle_properties(model, i);
        printf("# %-9s", cz_model_vehicle_name(model, i));
        put_number(properties.mass, 1e3, 3);
        for (int axle = 0; axle < 4; axle++)
            put_number(properties.axle_load[axle], 1e3, 1);
        put_number(properties.primary_deflection[0], 1e-3, 1);
        put_number(properties.secondary_deflection[0], 1e-3, 1);
        put_number(properties.bounce_frequency, 1, 3);
        put_number(properties.pitch_frequency, 1, 3);
        putchar('\n');
    }
}

/* Prints the static equilibrium of the vehicles, solved from the laws; returns the exit code. */
static int show_rest(const CzSession *session, const CzModel *model) {
    const int n = cz_model_n_vehicle(model);
    CzRest *rest = calloc((size_t)n, sizeof *rest);
    CzError error = {.status = CZ_STATUS_NO_MEMORY, .message = "no memory for the vehicles"};
    if (rest == NULL || cz_rest_find(model, rest, &error) != CZ_OK) {
        free(rest);
        return cz_session_fail(session, &error);
    }
    printf("#\n# at rest by the laws: mm, and the largest force left unbalanced over the weight\n"
           "# %-9s %9s %9s %9s %9s %9s\n",
           "vehicle", "sec. mm", "prim. mm", "rail mm", "dent mm", "residual");
    for (int i = 0; i < n; i++) {
        printf("# %-9s", cz_model_vehicle_name(model, i));
        put_number(rest[i].secondary_deflection[0], 1e-3, 3);
        put_number(rest[i].primary_deflection[0], 1e-3, 3);
        put_number(rest[i].rail_deflection[0], 1e-3, 3);
        put_number(rest[i].indentation[0], 1e-3, 3);
        if (isnan(rest[i].residual))
            printf(" %9s\n", "-");
        else /* its digits depend on rounding, so only its magnitude is reported */
            printf(" %9s\n", rest[i].residual < 1e-10 ? "< 1e-10" : ">= 1e-10");
    }
    free(rest);
    return 0;
}

static void show_interfaces(const CzModel *model) {
    printf("#\n# %-11s %9s %9s %9s %9s\n", "interface", "strut mm", "F_crit kN", "tube kN",
           "gap mm");
    for (int i = 0; i < cz_model_n_interface(model); i++) {
        const CzInterfaceProperties properties = cz_model_interface_properties(model, i);
        printf("# %-11s", cz_model_interface_name(model, i));
        put_number(properties.strut_length, 1e-3, 0);
        put_number(properties.critical_force, 1e3, 1);
        put_number(properties.tube_force, 1e3, 1);
        put_number(properties.anti_climber_gap, 1e-3, 0);
        printf("%s\n", i == cz_model_colliding_interface(model) ? "   colliding" : "");
        if (properties.tube_force > properties.critical_force)
            printf("#   warning: the collapse tubes carry more than F_crit, at which the train "
                   "folds there\n");
    }
}

static void show_steps(const CzModel *model) {
    enum { SHOWN = 8 };
    printf("#\n# time step %.6g ms; largest stable steps:\n", 1e3 * cz_model_time_step(model));
    for (int i = 0; i < cz_model_n_step_bound(model) && i < SHOWN; i++) {
        const CzStepBound *bound = cz_model_step_bound(model, i);
        printf("#   %10.6g ms  %s\n", 1e3 * bound->bound, bound->element);
    }
}

typedef struct Elevation {
    const CzProblem *problem;
    int scenario;
} Elevation;

static CzStatus write_elevation(const void *data, FILE *stream, CzError *error) {
    const Elevation *elevation = data;
    return cz_report_write_elevation(elevation->problem, elevation->scenario, stream, error);
}

static int show_properties(const CzSession *session) {
    CzModel *model = NULL;
    CzError error = {0};
    const char *requested = session->arguments->text[CZ_OPTION_SCENARIO];
    int scenario = 0;
    if (requested != NULL &&
        cz_problem_find_scenario(session->problem, requested, &scenario, &error) != CZ_OK)
        return cz_session_fail(session, &error);
    const char *svg = session->arguments->text[CZ_OPTION_SVG];
    const int code_of_file = cz_result_check(session->arguments, session->problem, svg);
    if (code_of_file != 0)
        return code_of_file;
    if (svg != NULL)
        return cz_result_write(session->arguments, svg, write_elevation,
                               &(Elevation){session->problem, scenario});
    if (cz_model_build(session->problem, scenario, &model, &error) != CZ_OK)
        return cz_session_fail(session, &error);
    cz_problem_write_resolved(session->problem, stdout);
    printf("\n# Known before the run, scenario %s; axles and ends are counted from the rear.\n",
           cz_problem_scenario_name(session->problem, scenario));
    show_vehicles(model);
    const int code = show_rest(session, model);
    show_interfaces(model);
    show_steps(model);
    cz_model_free(model);
    return code;
}

int cz_command_show(const CzArguments *arguments) {
    CzSession session;
    int code = cz_session_read(&session, arguments, arguments->operand[0]);
    if (code == 0)
        code = show_properties(&session);
    cz_session_end(&session);
    return code;
}
