/* Prints docs/verification.md: every row of the verification, computed now. Ends with 1 when a row
 * is outside its tolerance. The tests of tests/physics check the same rows. */
#include "physics/closed_forms.h"
#include "physics/published.h"
#include "physics/rails.h"
#include "physics/scheme.h"
#include "physics/steps.h"

static Rows rows; /* of the current section */
static int n_row, n_wrong;

/* Six digits are enough to compare; more would differ between compilers and machines. */
static void put_value(double value) {
    if (value != 0.0 && (fabs(value) < 1e-3 || fabs(value) >= 1e6))
        printf("%.2e", value);
    else
        printf("%.7g", value);
}

static void put_number(double value, const char *unit) {
    put_value(value);
    printf("%s%s", unit[0] != '\0' ? " " : "", unit);
}

static void put_row(const Row *row) {
    const double difference = row->computed - row->expected;
    const bool is_relative = row->relative > 0.0 && row->expected != 0.0;
    printf("| %s | ", row->what);
    if (row->is_upper_bound) {
        printf("at most ");
        put_number(row->expected, row->unit);
        printf(" | ");
        if (fabs(row->computed) < 1e-9) /* rounding, which depends on the machine */
            printf("below %.0e", fmin(1e-9, row->expected));
        else if (row->unit[0] == '\0')
            printf("%.1e", row->computed);
        else
            put_number(row->computed, row->unit);
        printf(" | - | - | ");
    } else {
        put_number(row->expected, row->unit);
        printf(" | ");
        put_number(fabs(row->computed) < 1e-9 ? 0.0 : row->computed, row->unit);
        printf(" | ");
        const double shown = is_relative ? difference / fabs(row->expected) : difference;
        if (fabs(shown) < 1e-9)
            printf("0");
        else
            printf("%.0e", shown);
        printf(" | ");
        put_number(is_relative ? row->relative : row_allowed(row), is_relative ? "" : row->unit);
        printf(" | ");
    }
    puts(row_holds(row) ? "ok |" : "**FAILS** |");
    n_row++;
    n_wrong += !row_holds(row);
}

/* Starts a section; its rows are gathered until put_table. */
static void begin(const char *title, const char *text) {
    rows.n = 0;
    printf("\n### %s\n\n%s\n\n", title, text);
}

static void put_table(void) {
    puts(
        "| quantity | expected | computed | difference | tolerance | |\n|---|---|---|---|---|---|");
    for (int i = 0; i < rows.n; i++)
        put_row(&rows.row[i]);
}

static void put_with_steps(void (*rows_of)(Rows *, const Step *), const Step *a, const Step *b) {
    rows_of(&rows, a);
    rows_of(&rows, b);
    put_table();
}

static void put_with_both_steps(void (*rows_of)(Rows *, const Step *)) {
    put_with_steps(rows_of, &default_step, &fine_step);
}

static void put_intro(void) {
    puts("# Verification\n"
         "\n"
         "`scripts/write-verification` runs every case and writes this page; a test writes it "
         "again and compares.\n"
         "Both fail when a row is outside its tolerance.\n"
         "\n"
         "Differences are relative where the tolerance has no unit, otherwise in the unit of the "
         "quantity.\n"
         "In rows with \"at most\" the computed value is itself an error or a bound.\n"
         "The cases are the problem files in `tests/physics/cases`; the expected values are in "
         "`tests/physics/closed_forms.c`, `tests/physics/scheme.c`, `tests/physics/published.c`, "
         "`tests/physics/rails.c` and `tests/physics/steps.c`, which the tests use too.\n"
         "\n"
         "## Scope of this page\n"
         "\n"
         "**Numerical uncertainty** is the difference between the computed and the exact solution "
         "of the equations.\n"
         "Sections A and C give bounds for it: closed forms, other solvers, smaller steps, "
         "conservation.\n"
         "For short trains it is about 0.1 % at the default step. The response of long trains is "
         "chaotic: single values scatter by up to 2 % with every solver, because they depend "
         "sensitively on the initial state.\n"
         "\n"
         "**Model uncertainty** is the difference between the equations and a real train.\n"
         "This page gives no bound for it.\n"
         "Section B compares with published numbers of full-scale tests; because masses, curves "
         "and dimensions of those vehicles are not public, this checks momentum and energy only "
         "and is not a validation.\n"
         "Section 15 of [theory.md](theory.md) lists the limits of the model. Absorber curves, "
         "friction, stops and heights are input; vary them within their known range to find their "
         "influence.");
}

static void put_closed_forms(void) {
    puts("\n## A. Cases with a known solution");
    begin("A1. Two masses and one plateau",
          "Crush $\\mu\\,\\Delta v^2/(2F)$, duration $\\mu\\,\\Delta v/F$, common speed from the "
          "momentum, energy $\\mu\\,\\Delta v^2/2$ with $\\mu = m_1 m_2/(m_1 + m_2)$.\n"
          "A plateau that starts at contact loses up to half a step of its impulse; the tolerances "
          "allow for this.");
    put_with_both_steps(rows_of_plateaus);
    begin("A1b. Two masses and crush zones in series",
          "Two car ends of the same force, each yielding after a micrometre.");
    put_with_both_steps(rows_of_crush_zones_in_series);
    begin("A2. One mass, elastic and perfectly plastic, elastic unloading",
          "40 t at 25 km/h against a wall; 20 MN/m up to 1.5 MN, unloading with 80 MN/m; step "
          "0.01 ms.");
    rows_of_spring_and_plateau(&rows);
    put_table();
    begin("A3. Four loading and two unloading stages",
          "40 t at 25 km/h; 1.2 MN at 20 mm, 1.0 at 80, 1.5 at 400, 4.5 at 600, back along 100 "
          "MN/m to one half and 30 MN/m to zero; step 0.01 ms.");
    rows_of_four_stages(&rows);
    put_table();
    begin("A4a. Coupler, gap, anti-climber and end in sequence",
          "Head-on, 40 t at 25 km/h each: 0.6 MN over 0.30 m, nothing over 0.02 m, 1.0 MN over "
          "0.30 m, then 3.0 MN.");
    put_with_both_steps(rows_of_sequence);
    begin("A4b. Two cars into a wall",
          "40 t each at 12 m/s; 3.0 MN at the wall, 1.2 MN between the cars.\n"
          "The closed form has no elasticity. Elasticity delays the force of an interface that "
          "closes from rest by a time that falls with the square root of the stiffness, so the "
          "stiffness is far above that of any device, and the step is below its bound.");
    put_with_steps(rows_of_two_into_wall, &stiff_step, &stiffer_step);
    begin("A4c. Two trains of eight cars",
          "57.75 t each, 10 m/s onto a standing train; 2.9 MN between the trains, 1.5 MN between "
          "cars; the same stiffness as in A4b.");
    put_with_steps(rows_of_eight_and_eight, &stiff_step, &stiffer_step);
    begin("A5a. The elastic track: statics and free waves",
          "Zhai's set, one rail: CHN60 with shear coefficient 0.40 on seats 0.6 m apart.\n"
          "The numbers for discrete seats are from an independent solution with 80 spans; the "
          "tolerances are their last digit.");
    rows_of_winkler(&rows);
    rows_of_discrete_seats(&rows);
    rows_of_rail_waves(&rows);
    rows_of_pinned_mode(&rows);
    rows_of_running_tracks(&rows);
    put_table();
    begin("A5b. Vehicles on their springs",
          "Frequencies with the wheels held, from an independent eigenvalue routine (the "
          "published benchmark has about 1.07 and 1.3 Hz for the Manchester coach), static axle "
          "loads, and the load that a longitudinal force above or below the centre of gravity "
          "shifts from bogie to bogie, from the forces of the kernel.");
    rows_of_coaches(&rows);
    rows_of_pitch_by_force(&rows);
    rows_of_step_force(&rows);
    put_table();
    begin("A5c. Static equilibrium",
          "Static equilibrium solved from the laws by KINSOL (computed) against the closed forms "
          "of the model (expected), on the rigid and on the elastic track; the residual is the "
          "largest unbalanced force over the weight.");
    rows_of_rest(&rows);
    put_table();
    begin("A6. Bathe's example of time integration",
          "Two degrees of freedom, M = diag(2, 1), K = [6 -2; -2 4], a constant force of 10 on "
          "the second, from rest.");
    rows_of_published_answer(&rows);
    rows_of_known_errors(&rows);
    rows_of_order(&rows);
    rows_of_stability(&rows);
    put_table();
    begin("A7. Collision of equal cars and wall impact at half the speed",
          "A rigid car with coupler, anti-climber and end at 10 m/s onto an identical standing "
          "one (expected), and at 5 m/s into a wall (computed), with the speed factor's reference "
          "halved.\n"
          "Scaled tests of trains, which are not mirror images, gave 0.5248 times the speed and "
          "0.16 m/s (Yao et al. 2018, doi 10.1177/0954409718779940).");
    rows_of_equivalence(&rows);
    put_table();
    begin("A8. Impacts, and vibration of the rail",
          "Hertz's impact of two bodies (1882) with the law of wheel and rail; the rail under a "
          "harmonic force, its mean over a bay against a Timoshenko beam on the same layers as a "
          "continuous foundation (Grassie and others 1982), which is valid as long as half a wave "
          "is longer than a bay.\n"
          "The elastic impact of two cars is in C1.");
    rows_of_hertz_impact(&rows);
    rows_of_receptance(&rows);
    put_table();
}

static void put_published(void) {
    puts("\n## B. Published full-scale tests");
    begin("B1. FRA train to train, 31 January 2002",
          "Two trains of about 635 kip (288 t), one at 30 mph, the other standing; the cab car was "
          "crushed by about 20 ft.\n"
          "Published: masses, speed, crush. Not published: the masses of single cars, any curve.\n"
          "The mean force follows from the other numbers and is input; equal crush therefore "
          "checks the energy balance only, not the force.");
    rows_of_train_to_train(&rows);
    put_table();
    begin("B2. FRA crash energy management, 2003 and 2004",
          "A single car at 35 mph, about 3 ft of crush; two cars at 29 mph, about 3 ft in front "
          "and 2 ft between them.\n"
          "Neither mass nor curve is published, so forces are per mass, and equal cars with the "
          "same lead crush are assumed.\n"
          "With constant forces of these means the two cars would stop together without crush "
          "between them: the published 2 ft show that the forces were not constant.\n"
          "This is a statement about the tests; only the first three rows check the program.");
    rows_of_crush_of_single_cars(&rows);
    put_table();
    begin("B3. FRA coupling tests, October 2017",
          "Six speeds from 1.8 to 8.85 mph; the push-back coupler was released at the last one "
          "only.\n"
          "Trigger force, draft gear and the mass of the second vehicle are not published; an "
          "elastic draft gear is assumed, with the trigger between the peak forces of the last two "
          "speeds, where it must be for any gear whose peak force grows with the speed.");
    rows_of_coupling_speeds(&rows);
    put_table();
    begin("B4. CRRC Changchun, March 2021",
          "Eight-car sets of 462 t, one at 36 km/h, the other standing.\n"
          "The curves are not published; those of A4c are used, because the three values do not "
          "depend on them.\n"
          "Without them it cannot be checked that no car climbed.");
    rows_of_eight_car_trains(&rows);
    put_table();
}

static void put_numerics(void) {
    puts("\n## C. Steps, solvers, conservation");
    begin("C1. Time step",
          "The elastic collision converges with the square of the step.\n"
          "Shipped problems converge in proportion to the step, because a device that yields at "
          "first contact loses half a step of its force; where the change is already below 3e-4, "
          "the order has no meaning and is left out.");
    rows_of_elastic_order(&rows);
    rows_of_elastic_exchange(&rows);
    rows_of_step_convergence(&rows);
    put_table();
    begin("C2. Solver against solver",
          "The explicit two-step scheme of production runs against two adaptive solvers of "
          "SUNDIALS with the same laws: ERKStep (`erk`) and the Adams method of CVODE (`adams`).\n"
          "Values are the largest relative differences of all interfaces, elements or vehicles; "
          "for short trains they are within 0.1 %.\n"
          "Four of them are compared at half or a quarter of the default step, because the "
          "difference at the default step is up to 0.14 %.\n"
          "Where cars continue to roll with applied brakes for many seconds, solvers are compared "
          "up to 2 s, long after the largest forces, closures and strokes.");
    rows_of_solvers_for_short_trains(&rows);
    put_table();
    begin("C3. Solver against solver, two trains of six cars",
          "The response of a long train is chaotic: whether the devices between two cars crush "
          "again when the cars meet a second time depends on the last digit. The scheme itself, at "
          "steps from 0.05 to 0.1 ms, scatters by 2 % in the energy of one interface.\n"
          "Differences of energies are relative to the total dissipated energy.");
    rows_of_solvers_for_the_metro(&rows);
    put_table();
    begin("C4. Modes of the track",
          "Modes up to a cut-off frequency, with the static flexibility of all others under the "
          "force, against the exact static deflection at twelve places between two sleepers; "
          "production runs cut off at 1500 Hz.\n"
          "Finite elements with lumped masses, an independent assembly, converge to it with the "
          "square of the element length.\n"
          "An impact of 1 ms on the rail, half a sine between two sleepers, shows the error of the "
          "cut-off: waves above it respond statically, without their inertia, which causes nearly "
          "all of the difference between the two tracks.\n"
          "Then shipped problems: peak force, closure, energy, pitch and link force on the modal "
          "track, by finite elements, and on the fitted receptance, on which runs are made.");
    rows_of_mode_convergence(&rows);
    rows_of_element_frequencies(&rows);
    rows_of_element_statics(&rows);
    rows_of_impact(&rows);
    rows_of_runs_on_rails(&rows);
    put_table();
    begin(
        "C5. Energy and momentum of every shipped problem",
        "On the elastic track up to 2 s, long after the largest forces, then on rigid rails where "
        "the file has them. Errors are relative to the initial energy, and to the sum of mass "
        "times speed.\n"
        "Every run of the program checks its own balance up to its end.");
    rows_of_balances(&rows);
    rows_of_balances_on_rigid_rails(&rows);
    put_table();
}

int main(void) {
    put_intro();
    put_closed_forms();
    put_published();
    put_numerics();
    printf("\n%d rows, %d of them fail.\n", n_row, n_wrong);
    return n_wrong == 0 ? 0 : 1;
}
