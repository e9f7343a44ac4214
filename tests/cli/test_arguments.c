/* The command line: accepted and refused arguments, and the messages. */
#include "support/check.h"

#include "cli/arguments.h"

enum { MAX_WORDS = 20 };

/* Reads a command line given as one text of words. */
static CzStatus read_line(const char *line, CzArguments *arguments, CzError *error) {
    static char words[256];
    char *argv[MAX_WORDS + 1] = {"crushzone"};
    int argc = 1;
    snprintf(words, sizeof words, "%s", line);
    for (char *word = strtok(words, " "); word != NULL && argc < MAX_WORDS;
         word = strtok(NULL, " "))
        argv[argc++] = word;
    return cz_arguments_read(argc, argv, arguments, error);
}

static void refuses(const char *line, const char *sentence, const char *help) {
    CzArguments arguments;
    CzError error = {0};
    const CzStatus status = read_line(line, &arguments, &error);
    if (strstr(error.message, sentence) == NULL || strstr(error.help, help) == NULL)
        print_error("%s: %s | %s\n", line, error.message, error.help);
    assert_int_equal(status, CZ_STATUS_INPUT);
    assert_non_null(strstr(error.message, sentence));
    assert_non_null(strstr(error.help, help));
    cz_arguments_free(&arguments);
}

static void options_and_operands_mix(void **state) {
    (void)state;
    CzArguments arguments;
    CzError error = {0};
    assert_int_equal(read_line("run --json a.yaml -oout -q", &arguments, &error), CZ_OK);
    assert_int_equal(arguments.command, CZ_COMMAND_RUN);
    cz_arguments_free(&arguments);

    assert_int_equal(read_line("check a.yaml -o out --set x=1 - --set=y=2=3 --jobs=3 -q -- --b",
                               &arguments, &error),
                     CZ_OK);
    assert_int_equal(arguments.n_operand, 3);
    assert_string_equal(arguments.operand[1], "-");
    assert_string_equal(arguments.operand[2], "--b");
    assert_string_equal(arguments.text[CZ_OPTION_OUTPUT], "out");
    assert_int_equal(arguments.n_set, 2);
    assert_string_equal(arguments.set[1], "y=2=3");
    assert_int_equal(arguments.n_job, 3);
    assert_non_null(arguments.text[CZ_OPTION_QUIET]);
    assert_null(arguments.text[CZ_OPTION_JSON]);
    cz_arguments_free(&arguments);
}

static void defaults_are_the_files(void **state) {
    (void)state;
    CzArguments arguments;
    CzError error = {0};
    assert_int_equal(read_line("optimize a.yaml", &arguments, &error), CZ_OK);
    assert_int_equal(arguments.command, CZ_COMMAND_OPTIMISE);
    assert_int_equal(arguments.evaluations, 0);
    assert_int_equal(arguments.seed, -1);
    assert_int_equal(arguments.csv_separator, ',');
    assert_int_equal(arguments.csv_decimal, '.');
    assert_int_equal(arguments.colour, CZ_COLOUR_AUTO);
    cz_arguments_free(&arguments);
}

static void values_are_read(void **state) {
    (void)state;
    CzArguments arguments;
    CzError error = {0};
    assert_int_equal(read_line("optimise a.yaml --seed 0 --evaluations 7 --csv-sep ; "
                               "--csv-decimal , --color never",
                               &arguments, &error),
                     CZ_OK);
    assert_int_equal(arguments.seed, 0);
    assert_int_equal(arguments.evaluations, 7);
    assert_int_equal(arguments.csv_separator, ';');
    assert_int_equal(arguments.csv_decimal, ',');
    assert_int_equal(arguments.colour, CZ_COLOUR_NEVER);
    cz_arguments_free(&arguments);
    assert_int_equal(read_line("run a.yaml --time-step-ms 0.05 --csv-sep tab", &arguments, &error),
                     CZ_OK);
    assert_string_equal(arguments.set[0], "simulation.time_step_ms=0.05");
    assert_int_equal(arguments.csv_separator, '\t');
    cz_arguments_free(&arguments);
    assert_int_equal(read_line("run a.yaml --csv-decimal ,", &arguments, &error), CZ_OK);
    assert_int_equal(arguments.csv_separator, ';');
    cz_arguments_free(&arguments);
}

static void abbreviations_are_refused(void **state) {
    (void)state;
    refuses("run a.yaml --js", "there is no option '--js'; options are not abbreviated",
            "did you mean '--json'?");
    refuses("run a.yaml --eval 3", "there is no option '--eval'", "'crushzone help run'");
    refuses("opti a.yaml", "there is no command 'opti'", "");
}

static void typing_mistakes_get_a_suggestion(void **state) {
    (void)state;
    refuses("rnu a.yaml", "there is no command 'rnu'", "did you mean 'crushzone run'?");
    refuses("xyzzy", "there is no command 'xyzzy'", "'crushzone help' lists the commands");
    refuses("run a.yaml --jsno", "there is no option '--jsno'", "did you mean '--json'?");
    refuses("run a.yaml --colour never", "there is no option '--colour'",
            "did you mean '--color'?");
}

static void options_belong_to_commands(void **state) {
    (void)state;
    refuses("run a.yaml --seed 3", "'crushzone run' takes no option '--seed'", "");
    refuses("schema -o x", "'crushzone schema' takes no option '-o'", "");
    refuses("check a.yaml -Z", "takes no option '-Z'", "'crushzone help check'");
}

static void invalid_values_are_refused(void **state) {
    (void)state;
    refuses("run a.yaml --json=yes", "'--json' takes no value", "");
    refuses("run a.yaml --output", "'--output' needs a value: --output DIR", "");
    refuses("run a.yaml --jobs 0", "'--jobs 0' is not a whole number from 1 to 1024", "");
    refuses("run a.yaml --jobs 2x", "'--jobs 2x' is not a whole number", "");
    refuses("optimise a.yaml --seed -1", "'--seed -1' is not a whole number", "");
    refuses("optimise a.yaml --evaluations 99999999999999999999", "is not a whole number", "");
    refuses("run a.yaml --color blue", "'--color blue' is not known",
            "it takes auto or always or never");
    refuses("run a.yaml --csv-decimal , --csv-sep ,", "a comma both between fields and in numbers",
            "add --csv-sep ';'");
    refuses("run a.yaml --set x", "'--set x' is not of the form PATH=VALUE", "");
    refuses("run a.yaml --set =1", "'--set =1' is not of the form PATH=VALUE", "");
}

static void files_are_counted(void **state) {
    (void)state;
    refuses("run", "'crushzone run' needs FILE...", "");
    refuses("optimise a.yaml b.yaml", "takes no argument 'b.yaml'", "");
    refuses("run a.yaml b.yaml --json", "with --json 'crushzone run' takes one FILE", "");
    CzArguments arguments;
    CzError error = {0};
    assert_int_equal(read_line("run --help", &arguments, &error), CZ_OK);
    cz_arguments_free(&arguments);
}

static void every_option_belongs_to_a_command_and_says_what_it_does(void **state) {
    (void)state;
    for (int i = 0; i < CZ_N_OPTION; i++) {
        assert_true(cz_options[i].commands != 0);
        assert_true(strlen(cz_options[i].doc) > 10);
        for (int k = 0; k < i; k++) {
            if ((cz_options[i].commands & cz_options[k].commands) == 0)
                continue; /* options of different commands may have the same name and letter */
            assert_string_not_equal(cz_options[i].name, cz_options[k].name);
            if (cz_options[i].letter != 0)
                assert_true(cz_options[i].letter != cz_options[k].letter);
        }
    }
    CzSuggestion nearest = {0};
    for (int i = 0; i < CZ_N_COMMAND; i++)
        assert_int_equal(cz_command_named(cz_commands[i].name, &nearest), i);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options_and_operands_mix),
        cmocka_unit_test(defaults_are_the_files),
        cmocka_unit_test(values_are_read),
        cmocka_unit_test(abbreviations_are_refused),
        cmocka_unit_test(typing_mistakes_get_a_suggestion),
        cmocka_unit_test(options_belong_to_commands),
        cmocka_unit_test(invalid_values_are_refused),
        cmocka_unit_test(files_are_counted),
        cmocka_unit_test(every_option_belongs_to_a_command_and_says_what_it_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
