/* Finds the command, runs it, returns its exit code. */
#include "cli/program.h"
#include "cli/command.h"
#include "cli/messages.h"
#include "crushzone/report.h"
#include "crushzone/serve.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

int cz_command_schema(const CzArguments *arguments) {
    CzError error = {0};
    if (arguments->n_operand == 0)
        cz_keys_write_schema(stdout);
    else if (strcmp(arguments->operand[0], "request") == 0)
        cz_server_write_request_schema(stdout);
    else if (cz_report_write_document_schema(arguments->operand[0], stdout, &error) != CZ_OK) {
        snprintf(error.help, sizeof error.help, "'crushzone help results' lists the documents");
        return cz_print_error(arguments, &error);
    }
    return 0;
}

int cz_command_version(const CzArguments *arguments) {
    char nlopt[32] = "", sundials[32] = "";
    cz_nlopt_version(nlopt, sizeof nlopt);
    cz_sundials_version(sundials, sizeof sundials);
    if (arguments->text[CZ_OPTION_JSON] != NULL)
        printf("{\"format\": \"crushzone.version\", \"version\": \"%s\", \"sundials\": \"%s\", "
               "\"nlopt\": \"%s\", \"isa\": \"%s\"}\n",
               cz_version(), sundials, nlopt, cz_isa_name());
    else
        printf("crushzone %s (NLopt %s, SUNDIALS %s, kernel for %s)\n", cz_version(), nlopt,
               sundials, cz_isa_name());
    return 0;
}

static int (*const commands[CZ_N_COMMAND])(const CzArguments *) = {
#define CZ_COMMAND(constant, name, function, ...) cz_command_##function,
#include "cli/commands.def"
#undef CZ_COMMAND
};

/* Whether --json is among the options: then a mistake in the command line is a JSON document too.
 */
static bool has_json_option(int argc, char **argv) {
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (strcmp(argv[i], "--json") == 0)
            return true;
    return false;
}

static int dispatch(const CzArguments *arguments) {
    if (arguments->nothing) {
        cz_help_write_greeting();
        return 0;
    }
    if (arguments->text[CZ_OPTION_HELP] != NULL) {
        cz_help_write_command(arguments->command);
        return 0;
    }
    return commands[arguments->command](arguments);
}

/* Opens the descriptors of standard streams that are closed at the start, so that no later file
 * gets one of them and receives printed text. Writing to such a descriptor fails. */
static void hold_closed_streams(void) {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; descriptor++)
        if (fcntl(descriptor, F_GETFD) == -1)
            (void)open("/dev/null", O_RDONLY); /* takes the lowest free descriptor */
}

int cz_program(int argc, char **argv, const CzExecutor *executor) {
    hold_closed_streams();
    /* A closed pipe is an error of writing and must not end the program silently. */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);

    CzArguments arguments;
    CzError error = {0};
    int code;
    if (cz_arguments_read(argc, argv, &arguments, &error) == CZ_OK) {
        arguments.executor = executor;
        code = dispatch(&arguments);
    } else {
        if (has_json_option(argc, argv))
            arguments.text[CZ_OPTION_JSON] = "";
        code = cz_print_error(&arguments, &error);
    }
    code = cz_end_output(&arguments, code);
    cz_arguments_free(&arguments);
    return code;
}
