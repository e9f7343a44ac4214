/* Limits of a profile: changing one of them changes exactly the verdicts that depend on it. */
#include "support/work_folder.h"

#include <sys/stat.h>

#include "evaluate/judged_problem.h"
#include "evaluate/small_problem.h"

/* Judges the small problem by a profile with limits of a force and a shortening. */
static Case judge(double force, double shortening, const char *checks) {
    (void)mkdir("profiles", 0777);
    FILE *file = fopen("profiles/mine.yaml", "w");
    assert_non_null(file);
    fprintf(file,
            "schema: 1\nname: mine\nedition: none\nlimits:\n"
            "  - {name: force, metric: interfaces.peak_force_kN, max: %g, scenarios: [crash, "
            "between], clause: a, source: ours, confidence: user}\n"
            "  - {name: shortening, metric: interfaces.shortening_mm, max: %g, clause: b, source: "
            "ours, confidence: M2}\n",
            force, shortening);
    fclose(file);
    return judged(small_problem(checks), false);
}

/* Checks that differ, each of which must have the name. */
static int count_changed(const Case *before, const Case *after, const char *name) {
    int n = 0;
    assert_int_equal(before->evaluation.n_check, after->evaluation.n_check);
    for (int i = 0; i < before->evaluation.n_check; i++) {
        const CzCheckResult *a = &before->evaluation.check[i], *b = &after->evaluation.check[i];
        const bool is_same = a->verdict == b->verdict &&
                             memcmp(&a->limit, &b->limit, sizeof a->limit) == 0 &&
                             memcmp(&a->value, &b->value, sizeof a->value) == 0 &&
                             memcmp(&a->margin, &b->margin, sizeof a->margin) == 0;
        assert_string_equal(a->name, b->name);
        assert_string_equal(a->scenario, b->scenario);
        if (!is_same)
            assert_string_equal(a->name, name);
        n += !is_same;
    }
    return n;
}

static const char plain[] = "checks: {profile: mine}\n";

static void one_limit_changes_only_its_own_verdicts(void **state) {
    (void)state;
    Case before = judge(9000, 2000, plain), force = judge(100, 2000, plain),
         shortening = judge(9000, 10, plain);
    assert_int_equal(count_changed(&before, &force, "force"), 2);           /* in two scenarios */
    assert_int_equal(count_changed(&before, &shortening, "shortening"), 4); /* but overload */
    end(&shortening);
    end(&force);
    end(&before);
}

static void an_override_acts_as_the_number_in_the_profile(void **state) {
    (void)state;
    Case in_profile = judge(100, 2000, plain);
    Case over = judge(9000, 2000, "checks: {profile: mine, override: {force: {max: 100}}}\n");
    assert_int_equal(count_changed(&in_profile, &over, ""), 0);
    end(&over);
    end(&in_profile);
}

/* Also one of the file, whose place in messages stays. */
static void an_override_reaches_a_limit_of_the_file(void **state) {
    (void)state;
#define OWN "limits: [{name: own, metric: interfaces.peak_force_kN, max: 9000, confidence: M2}]"
    Case before = judge(9000, 2000, "checks: {profile: mine, " OWN "}\n");
    Case over =
        judge(9000, 2000, "checks: {profile: mine, override: {own: {max: 100}}, " OWN "}\n");
    assert_int_equal(find(&before, "own", "buffing")->verdict, CZ_VERDICT_PROVISIONAL);
    assert_int_equal(count_changed(&before, &over, "own"), 4); /* all but overload */
    assert_near(find(&over, "own", "crash")->limit, 100, 0, 0);
    end(&over);
    end(&before);
}

/* A rule of the design has its physical limit too, which an override does not tighten. */
static void an_override_reaches_one_design_rule(void **state) {
    (void)state;
    Case before = judge(9000, 2000, plain);
    Case over = judge(9000, 2000,
                      "checks: {profile: mine, override: {stroke used: {max: 0.2, source: test "
                      "9}}}\n");
    assert_in_range(count_changed(&before, &over, "stroke used"), 1, 4);
    const CzCheckResult *check = find(&over, "stroke used", "crash");
    assert_near(check->limit, 0.2, 0, 0);
    assert_string_equal(check->source, "test 9");
    assert_string_equal(check->confidence, "user");
    end(&over);
    end(&before);
}

/* Judges a train that meets the partners of a profile, whose scenario of a wagon is of confidence
 * M2. */
static Case meet(const char *more) {
    char text[1000];
    CzProblem *problem = NULL;
    CzError error = {0};
    snprintf(text, sizeof text, "extends: " CZ_SOURCE_FOLDER "/tests/problem/good/single.yaml\n%s",
             more);
    if (cz_problem_read_text(text, strlen(text), "more.yaml", ".", NULL, &problem, &error) != CZ_OK)
        fail_msg("%s", error.message);
    return judged(problem, false);
}

static CzVerdict verdict_onto_wagon(const char *more) {
    Case made = meet(more);
    const CzCheckResult *check = find(&made, "residual closing speed", "wagon");
    assert_non_null(check);
    const CzVerdict verdict = check->verdict;
    end(&made);
    return verdict;
}

static void a_pass_in_an_unconfirmed_scenario_is_provisional(void **state) {
    (void)state;
    assert_int_equal(verdict_onto_wagon(""), CZ_VERDICT_PROVISIONAL);
    assert_int_equal(verdict_onto_wagon("checks: {override: {wagon: {confidence: user}}}\n"),
                     CZ_VERDICT_PASS);
    assert_int_equal(verdict_onto_wagon("scenarios: [{name: wagon, speed_km_h: 11, trains: [A, "
                                        "wagon]}]\n"),
                     CZ_VERDICT_PASS);
}

/* Lines of a rule and of the scenario that it needs. */
static int n_lines(const Case *made, const char *name) {
    int n = 0;
    for (int i = 0; i < made->evaluation.n_check; i++)
        n += strcmp(made->evaluation.check[i].name, name) == 0;
    return n;
}

static void a_scenario_that_is_left_out_is_one_line(void **state) {
    (void)state;
    Case made = meet("checks: {scenarios: [wagon]}\n");
    assert_int_equal(n_lines(&made, "alike-heavy"), 1);
    assert_int_equal(n_lines(&made, "bottoming out under overload"), 0);
    assert_non_null(
        strstr(find(&made, "alike-heavy", "design")->why, "bottoming out under overload"));
    end(&made);
}

/* Scenarios of the category that a problem of one train does not have as its profile has them. */
static int n_changed_scenarios(const char *more) {
    Case made = meet(more);
    const int n = made.evaluation.n_changed_scenario;
    for (int i = 0; i < n; i++)
        assert_non_null(strstr(more, made.evaluation.changed_scenario[i]));
    end(&made);
    return n;
}

/* A verdict by a profile lists which of its scenarios the problem has changed, not repeated. */
static void a_changed_scenario_is_listed(void **state) {
    (void)state;
    assert_int_equal(n_changed_scenarios(""), 0);
    assert_int_equal(
        n_changed_scenarios("scenarios: [{name: alike, speed_km_h: 20, trains: [A, B]}]\n"), 1);
#define CROSSING "scenarios: [{name: crossing, speed_km_h: 110, payload_share: 0.5, trains: "
    assert_int_equal(n_changed_scenarios(CROSSING "[A, wagon]}]\n"), 0);
    assert_int_equal(n_changed_scenarios(CROSSING "[A, B]}]\n"), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_limit_changes_only_its_own_verdicts),
        cmocka_unit_test(an_override_acts_as_the_number_in_the_profile),
        cmocka_unit_test(an_override_reaches_a_limit_of_the_file),
        cmocka_unit_test(an_override_reaches_one_design_rule),
        cmocka_unit_test(a_pass_in_an_unconfirmed_scenario_is_provisional),
        cmocka_unit_test(a_scenario_that_is_left_out_is_one_line),
        cmocka_unit_test(a_changed_scenario_is_listed),
    };
    if (enter_work_folder() != 0)
        return 1;
    const int n_failed = cmocka_run_group_tests(tests, NULL, NULL);
    return leave_work_folder() != 0 ? 1 : n_failed;
}
