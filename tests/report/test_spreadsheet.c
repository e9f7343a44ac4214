/* CSV files opened by a spreadsheet: text stays text, whatever separator the program uses. */
#include "support/check.h"

#include "report/csv.h"
#include "report/stand_in.h"

/* Whether a spreadsheet that separates cells by this sign, and knows quotes only around a whole
 * cell, would run a cell as a formula; a number is not a formula. */
static bool runs_a_cell(const char *line, char separator) {
    bool begins = true;
    for (const char *c = line; *c != '\0'; c++) {
        double value;
        char sign = '\0';
        const bool is_number = sscanf(c, "%lf%c", &value, &sign) >= 1 && sign != '!';
        if (begins && *c != '\0' && strchr("=+-@", *c) != NULL && !is_number)
            return true;
        begins = *c == separator || *c == '\n' || (begins && strchr("\" \t\r", *c) != NULL);
    }
    return false;
}

static void csv_has_no_text_that_a_spreadsheet_would_run(void **state) {
    (void)state;
    static const char *const texts[] = {"=cmd|' /C calc'!A0",
                                        "+1+cmd",
                                        "-2+3!A1",
                                        "@SUM(A1)",
                                        "\t=1+1",
                                        "\r=1+1",
                                        " =1+1",
                                        "fine;=1+1",
                                        "fine,=1+1",
                                        "fine\t=1",
                                        "fine\n=1+1",
                                        "\"=1+1",
                                        "a\"b,\"=1+1"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        for (const char *separator = ",;\t"; *separator != '\0'; separator++) {
            StandIn s;
            stand_in_fill(&s);
            CzReportOptions options = cz_report_options_default();
            options.csv_separator = *separator;
            s.check[0].name = texts[i];
            char *written = NULL;
            size_t n_byte = 0;
            FILE *stream = open_memstream(&written, &n_byte);
            assert_non_null(stream);
            cz_csv_write_checks(&s.evaluation, &options, stream);
            fclose(stream);
            for (const char *opened = ",;\t"; *opened != '\0'; opened++)
                if (runs_a_cell(written, *opened))
                    fail_msg("'%s' runs when parted by '%c':\n%s", texts[i], *opened, written);
            free(written);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv_has_no_text_that_a_spreadsheet_would_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
