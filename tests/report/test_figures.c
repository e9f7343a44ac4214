/* Figures: well-formed, with complete peaks and loops, the same in every locale. */
#include "support/check.h"

#include <locale.h>

#include "report/markup.h"
#include "report/plot.h"
#include "report/decimation.h"
#include "report/well_formed.h"

typedef struct Text {
    char *text;
    size_t n;
    CzMarkup markup;
} Text;

static void begin(Text *text) {
    *text = (Text){0};
    text->markup.stream = open_memstream(&text->text, &text->n);
    assert_non_null(text->markup.stream);
}

static const char *end(Text *text) {
    fclose(text->markup.stream);
    return text->text;
}

/* ---- markup ---- */

static void text_and_attributes_cannot_break_out(void **state) {
    (void)state;
    Text text;
    begin(&text);
    cz_markup_write(&text.markup, "<p title='%s'>%s</p>", "\"><script>alert('1')</script>",
                    "</p><b>&amp;\x01");
    end(&text);
    assert_true(is_well_formed(text.text));
    assert_null(strstr(text.text, "<script"));
    assert_null(strstr(text.text, "<b>"));
    assert_non_null(strstr(text.text, "&amp;amp;?"));
    free(text.text);
}

static void numbers_are_short_and_follow_no_locale(void **state) {
    (void)state;
    const bool has_comma = setlocale(LC_ALL, "de_DE.UTF-8") != NULL;
    Text text;
    begin(&text);
    cz_markup_write(&text.markup, "<g a='%.2f' b='%.2f' c='%.1f' d='%.1f' e='%d' f='%ld'/>%%", 1.5,
                    -0.001, 100.04, NAN, -7, 1234567890L);
    setlocale(LC_ALL, "C");
    assert_string_equal(end(&text),
                        "<g a=\"1.5\" b=\"0\" c=\"100\" d=\"0\" e=\"-7\" f=\"1234567890\"/>%");
    free(text.text);
    if (!has_comma)
        print_message("no locale with a decimal comma here: tried in C only\n");
}

/* ---- decimation ---- */

enum { N = 5000 };

static void decimation_keeps_a_peak_of_one_sample(void **state) {
    (void)state;
    static double x[N], y[N];
    static bool keep[N];
    for (int i = 0; i < N; i++) {
        x[i] = 400.0 * i / N;
        y[i] = 100;
    }
    y[1234] = 5;
    assert_true(cz_decimate(N, x, y, 0.25, 2000, keep) > 0);
    assert_true(keep[0] && keep[N - 1] && keep[1233] && keep[1234] && keep[1235]);
    int n = 0;
    for (int i = 0; i < N; i++)
        n += keep[i];
    assert_int_equal(n, 5);
}

/* Every point lies within the tolerance of the line between its kept neighbours, in their order:
 * the guarantee of the method. */
static void a_decimated_loop_keeps_its_path(void **state) {
    (void)state;
    static double x[N], y[N];
    static bool keep[N];
    for (int i = 0; i < N; i++) { /* up along a curve, back along another one, twice */
        const double s = 4.0 * i / (N - 1), part = s - floor(s);
        const bool up = (int)s % 2 == 0;
        x[i] = 300 * (up ? part : 1 - part);
        y[i] = up ? 200 * part * part : 150 * (1 - part) * (1 - part) * (1 - part);
    }
    const double tolerance = cz_decimate(N, x, y, 0.25, 2000, keep);
    assert_near(tolerance, 0.25, 0, 0);
    int from = 0, n_kept = 1;
    for (int to = 1; to < N; to++) {
        if (!keep[to])
            continue;
        n_kept++;
        const double dx = x[to] - x[from], dy = y[to] - y[from], length = hypot(dx, dy);
        for (int i = from + 1; i < to; i++)
            assert_true(fabs((x[i] - x[from]) * dy - (y[i] - y[from]) * dx) <= 0.2501 * length);
        from = to;
    }
    assert_true(n_kept > 8 && n_kept < 200);
}

static void a_noisy_curve_stays_below_the_largest_number_of_points(void **state) {
    (void)state;
    static double x[N], y[N];
    static bool keep[N];
    for (int i = 0; i < N; i++) {
        x[i] = 400.0 * i / N;
        y[i] = (i * 7919 % 101) * 2.0;
    }
    y[77] = 900;
    cz_decimate(N, x, y, 0.25, 500, keep);
    int n = 0;
    for (int i = 0; i < N; i++)
        n += keep[i];
    assert_true(n <= 500);
    assert_true(keep[77]);
}

/* ---- plots ---- */

static void write(Text *text, const CzPlot *plot) {
    begin(text);
    cz_plot_write(plot, &text->markup);
    end(text);
}

static void a_plot_has_every_curve_limit_and_name(void **state) {
    (void)state;
    const double x[] = {0, 1, 2, 3}, up[] = {0, 2, 4, 3}, down[] = {4, NAN, 1, 0};
    const CzSeries series[] = {{.name = "A & B", .y_channel = "F_A_kN", .n = 4, .x = x, .y = up},
                               {.name = "B", .n = 4, .x = x, .y = down, .colour = 1, .dash = 1}};
    const CzPlotLimit limit = {"force", 10};
    const CzPlotBand bands[] = {{"window", 0.5, 1, 2}, {"window", 2, 2.5, 2}};
    const CzPlot plot = {.title = "two <curves>",
                         .x_label = "time [ms]",
                         .y_label = "force [kN]",
                         .n_series = 2,
                         .n_limit = 1,
                         .n_band = 2,
                         .series = series,
                         .limit = &limit,
                         .band = bands};
    Text text;
    write(&text, &plot);
    assert_true(is_well_formed(text.text));
    assert_int_equal(count_of(text.text, "<path"), 2);
    assert_int_equal(count_of(text.text, "class=\"limit\""), 1);
    assert_int_equal(count_of(text.text, ">window<"), 1); /* bands of one name have one entry */
    assert_non_null(strstr(text.text, "data-y=\"F_A_kN\""));
    assert_non_null(strstr(text.text, "limit: force"));
    assert_non_null(strstr(text.text, "aria-label=\"two &lt;curves&gt;\""));
    const char *gap = strstr(text.text, "stroke-dasharray=\"60 30\"");
    assert_non_null(gap);
    const char *path = strstr(gap, " d=\"");
    const char *quote = strchr(path + 4, '"');
    int n_move = 0;
    for (const char *c = path; c < quote; c++)
        n_move += *c == 'M';
    assert_int_equal(n_move, 2); /* a gap is not bridged */
    free(text.text);
}

static void the_axes_show_the_whole_loop(void **state) {
    (void)state;
    const double x[] = {0, 300, 500, 420}, y[] = {0, 1000, 1000, 0};
    const CzSeries series = {.name = "loop", .n = 4, .x = x, .y = y};
    const CzPlot plot = {
        .title = "loop", .x_label = "", .y_label = "", .n_series = 1, .series = &series};
    Text text;
    write(&text, &plot);
    assert_non_null(strstr(text.text, "data-range=\"0 500 0 1050\""));
    const char *path = strstr(text.text, " d=\"M");
    int n_step = 0; /* points forwards and backwards: none is sorted or dropped */
    for (const char *c = path + 4; *c != '"'; c++)
        n_step += *c == 'l';
    assert_int_equal(n_step, 3);
    const char *box = strstr(text.text, "data-box=\"56 8 412 210\"");
    assert_non_null(box);
    const char *legend = strstr(text.text, ">loop</text>");
    while (strncmp(legend, " y=\"", 4) != 0)
        legend--;
    assert_true(atof(legend + 4) > 8 + 210 + 30); /* below the axis and its numbers */
    free(text.text);
}

static void a_plot_without_curves_is_a_figure(void **state) {
    (void)state;
    const double x[] = {0, 1}, constant[] = {5, 5}, none[] = {NAN, NAN};
    const CzSeries flat = {.name = "flat", .n = 2, .x = x, .y = constant};
    const CzSeries empty = {.name = "empty", .n = 2, .x = x, .y = none};
    const CzSeries *const curves[] = {&flat, &empty};
    for (int i = 0; i < 3; i++) {
        const CzPlot plot = {.title = "",
                             .x_label = "",
                             .y_label = "",
                             .n_series = i < 2,
                             .series = i < 2 ? curves[i] : NULL};
        Text text;
        write(&text, &plot);
        assert_true(is_well_formed(text.text));
        assert_null(strstr(text.text, "nan"));
        assert_null(strstr(text.text, "inf"));
        free(text.text);
    }
}

static void steps_of_axes_are_round(void **state) {
    (void)state;
    assert_near(cz_plot_round_step(7, 7), 1, ROUNDING_OF_A_SUM, 0);
    assert_near(cz_plot_round_step(1500, 6), 500, ROUNDING_OF_A_SUM, 0);
    assert_near(cz_plot_round_step(0.083, 6), 0.02, ROUNDING_OF_A_SUM, 0);
    assert_near(cz_plot_round_step(5354, 7), 1000, ROUNDING_OF_A_SUM, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_and_attributes_cannot_break_out),
        cmocka_unit_test(numbers_are_short_and_follow_no_locale),
        cmocka_unit_test(decimation_keeps_a_peak_of_one_sample),
        cmocka_unit_test(a_decimated_loop_keeps_its_path),
        cmocka_unit_test(a_noisy_curve_stays_below_the_largest_number_of_points),
        cmocka_unit_test(a_plot_has_every_curve_limit_and_name),
        cmocka_unit_test(the_axes_show_the_whole_loop),
        cmocka_unit_test(a_plot_without_curves_is_a_figure),
        cmocka_unit_test(steps_of_axes_are_round),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
