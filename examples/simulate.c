// RUN: simulate problems/two-cars-25kmh.yaml
// RUN: simulate problems/first-collision.yaml
/* One collision: read a problem file, run its first scenario, print the energy of each interface.
 *
 *   simulate PROBLEM.yaml
 */
#include <stdio.h>
#include <stdlib.h>

#include <crushzone/crushzone.h>

static void print_mistakes(const CzProblem *problem, const CzError *error) {
    const int n_mistake = problem != NULL ? cz_problem_n_mistake(problem) : 0;
    for (int i = 0; i < n_mistake; i++) {
        const CzError *mistake = cz_problem_mistake(problem, i);
        fprintf(stderr, "%s:%d:%d: %s\n", mistake->file, mistake->line, mistake->column,
                mistake->message);
    }
    if (n_mistake == 0)
        fprintf(stderr, "%s\n", error->message);
}

static void print_interfaces(const CzRunSummary *summary) {
    printf("%s: %.3f s in %ld steps, energy balance %.1e\n", summary->scenario, summary->simulated,
           summary->n_step, summary->energy.balance_error);
    printf("%-12s %10s %10s %12s\n", "interface", "peak kN", "crush mm", "energy kJ");
    for (int i = 0; i < summary->n_interface; i++) {
        const CzInterfaceResult *interface = &summary->interface[i];
        printf("%-12s %10.0f %10.0f %12.1f%s\n", interface->name, interface->peak_force / 1e3,
               interface->shortening * 1e3, interface->energy / 1e3,
               interface->bottomed_out ? "  bottomed out" : "");
    }
}

int main(int n_argument, char **argument) {
    if (n_argument != 2) {
        fprintf(stderr, "usage: simulate PROBLEM.yaml\n");
        return 2;
    }
    CzProblem *problem = NULL;
    CzModel *model = NULL;
    CzRun *run = NULL;
    CzError error = {0};

    CzStatus status = cz_problem_read(argument[1], NULL, &problem, &error);
    if (status == CZ_OK)
        status = cz_model_build(problem, 0, &model, &error);
    if (status == CZ_OK)
        status = cz_simulate(model, NULL, &run, &error);

    if (status != CZ_OK)
        print_mistakes(problem, &error);
    else if (cz_run_summary(run)->status != CZ_OK)
        fprintf(stderr, "%s\n", cz_run_summary(run)->failure);
    else
        print_interfaces(cz_run_summary(run));
    if (status == CZ_OK)
        status = cz_run_summary(run)->status;

    cz_run_free(run);
    cz_model_free(model);
    cz_problem_free(problem);
    return cz_status_exit_code(status);
}
