/* The modal track in motion: it stays at rest, deflects as its statics, its energy is the work done
 * on it, and the wheel forces depend neither on the window nor on the solver.
 */
#include "physics/motion.h"
#include "physics/rails.h"
#include "physics/roadbed.h"

#include "dynamics/track_energy.h"
#include "laws/wheel_rail.h"
#include "model/track_bound.h"

#define SPAN 18.26 /* of the cars of the catalogue [m] */

static const double usual_place[4] = {-9.13, -6.57, 6.57, 9.13};

/* ---- the track alone ---- */

/* A track under one car with modes up to a cut [Hz], at rest under its loads. */
static CzTrackMotion *track_under(const double place[4], const double load[4], double cut,
                                  int n_seat, double step, CzArena *arena) {
    const CzTrackModes *modes = usual_modes(SPAN, n_seat, cut, arena);
    CzTrackMotion *track = cz_track_motion_create(modes, step, 1, arena);
    assert_non_null(track);
    assert_true(cz_track_lay(track, 0, place, load, arena));
    return track;
}

/* Modes and the flexibility under the force add up to the exact statics for any cut and step, at
 * every place in a bay. The error of the flexibility's four powers falls with the fourth power from
 * the 0.9 % of the first: 1e-2 / 5^4. */
static void a_load_at_rest_deflects_the_track_as_its_statics(void **state) {
    (void)state;
    static const double cut[] = {1000.0, 1500.0, 3000.0};
    for (size_t c = 0; c < 3; ++c)
        for (double step = 1e-5; step < 2e-4; step *= 3.0)
            for (double place = 0.0; place < 0.6; place += 0.05) {
                CzArena arena = {0};
                const double at[4] = {place, 0.0, 0.0, 0.0}, load[4] = {70e3, 0.0, 0.0, 0.0};
                CzTrackMotion *track = track_under(at, load, cut[c], 0, step, &arena);
                double deflection[4], flexibility[4];
                cz_track_deflection(track, 0, at, deflection, flexibility);
                const double exact =
                    cz_ring_flexibility(&track->modes->seats, track->modes->n_seat, place / 0.6);
                assert_near(flexibility[0] * load[0] - deflection[0], exact * load[0], 2e-5, 0.0);
                assert_true(flexibility[0] > 0.0);
                cz_arena_free(&arena);
            }
}

/* Two wheels of a bogie, 2.56 m apart, interact through the modes only: so far from the load the
 * waves beyond the cut add less than 2 permille of the deflection under it. */
static void wheels_interact_as_in_the_statics(void **state) {
    (void)state;
    CzArena arena = {0};
    const double load[4] = {70e3, 0.0, 0.0, 0.0};
    CzTrackMotion *track = track_under(usual_place, load, 1500.0, 0, 1e-4, &arena);
    CzTrackMotion *fine = track_under(usual_place, load, 20e3, 0, 1e-6, &arena);
    double usual[4], all[4], flexibility[4];
    cz_track_deflection(track, 0, usual_place, usual, flexibility);
    cz_track_deflection(fine, 0, usual_place, all, flexibility);
    for (int wheel = 1; wheel < 4; ++wheel)
        assert_near(usual[wheel], all[wheel], 0.0, 2e-3 * 0.45e-3);
    cz_arena_free(&arena);
}

/* ---- the steps against each mode on its own ---- */

/* The cosine or sine of wave k at a place, or its change along the track. */
static double wave_at(const CzTrackModes *modes, int k, int copy, bool change, double x) {
    const CzComplex turned = cz_turned(k * (x / modes->length));
    if (!change)
        return copy == 0 ? turned.re : turned.im;
    return 2.0 * CZ_PI * k / modes->length * (copy == 0 ? -turned.im : turned.re);
}

/* g(x) of a mode of a group, or its change along the track. */
static CzComplex shape_at(const CzTrackModes *modes, const CzTrackGroup *group, int i, bool change,
                          double x) {
    const int j = group->vector * CZ_TRACK_WIDTH + i;
    return cz_complex_sum(
        cz_complex_scaled(wave_at(modes, j, group->copy, change, x), group->direct[i]),
        cz_complex_scaled(wave_at(modes, j - modes->n_seat, group->copy, change, x),
                          group->alias[i]));
}

/* Deflection at a place, or its change along the track, by the amplitudes of all modes, each turned
 * by `lambda t`. */
static double modes_at(const CzTrackModes *modes, const CzComplex *y, double t, bool change,
                       double x) {
    double sum = 0.0;
    for (int k = 0; k < modes->n_group; ++k)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            const CzTrackGroup *group = &modes->group[k];
            const CzComplex turn = cz_complex_exponential(cz_complex_scaled(t, group->lambda[i]));
            const CzComplex at = cz_complex_product(turn, y[k * CZ_TRACK_WIDTH + i]);
            sum += cz_complex_product(shape_at(modes, group, i, change, x), at).re;
        }
    return sum;
}

/* y <- exp(lambda h) (y + (2 / lambda) sinh(lambda h / 2) g P) */
static void step_modes(const CzTrackModes *modes, double step, const double place[4],
                       const double force[4], CzComplex *y) {
    for (int k = 0; k < modes->n_group; ++k)
        for (int i = 0; i < CZ_TRACK_WIDTH; ++i) {
            const CzTrackGroup *group = &modes->group[k];
            const CzComplex lambda = group->lambda[i];
            if (cz_complex_square_size(lambda) == 0.0)
                continue;
            CzComplex *of = &y[k * CZ_TRACK_WIDTH + i], load = {0.0, 0.0};
            for (int wheel = 0; wheel < 4; ++wheel)
                load = cz_complex_sum(
                    load, cz_complex_scaled(force[wheel],
                                            shape_at(modes, group, i, false, place[wheel])));
            *of = cz_complex_sum(*of, cz_complex_product(cz_track_kick(lambda, step), load));
            *of = cz_complex_product(cz_complex_exponential(cz_complex_scaled(step, lambda)), *of);
        }
}

/* Slope of the modes at a place of the first wheel. */
static double slope_at(const CzTrackMotion *track, double place) {
    CzTrackTurns turns;
    const CzTrackRow at[4] = {{place}};
    cz_track_turn(track, at, &turns);
    return cz_track_move_wheel(track, &track->under[0], &turns, 0, 0).slope;
}

/* From an unloaded track, wheels roll at 60 m/s under forces at 90 and 900 Hz: deflections and work
 * are those of each mode's exact motion. Two deflections half a step of h apart are the state of a
 * mode, so that rounding grows by (2 / (w h))^2 for its angular frequency w: 4e3 for the slowest
 * mode in steps of 0.1 ms. */
static void steps_are_the_exact_motion_of_each_mode(const CzTrackModes *modes) {
    CzArena arena = {0};
    const double none[4] = {0.0}, step = 1e-4, allowed = 4e3 * 2e-16 * 1e-3; /* of a millimetre */
    CzTrackMotion *track = cz_track_motion_create(modes, step, 1, &arena);
    assert_non_null(track);
    assert_true(cz_track_lay(track, 0, usual_place, none, &arena));
    const double shortest = 2.0 * CZ_PI / modes->seats.spacing; /* wavenumber [1/m] */
    CzComplex *y = cz_arena_allocate(&arena, (size_t)modes->n_group * CZ_TRACK_WIDTH, sizeof *y);
    assert_non_null(y);
    for (int n = 0; n < 100; ++n) {
        const double t = n * step;
        double place[4], force[4], z[4], flexibility[4], work = 0.0;
        for (int wheel = 0; wheel < 4; ++wheel) {
            place[wheel] = usual_place[wheel] + 60.0 * t;
            force[wheel] = -70e3 * (1.0 + 0.3 * cz_turned((wheel % 2 == 0 ? 90.0 : 900.0) * t).im);
        }
        cz_track_deflection(track, 0, place, z, flexibility);
        for (int wheel = 0; wheel < 4 && n % 20 == 0; ++wheel) {
            assert_near(z[wheel], modes_at(modes, y, 0.0, false, place[wheel]), 0.0, allowed);
            assert_near(slope_at(track, place[wheel]), modes_at(modes, y, 0.0, true, place[wheel]),
                        0.0, allowed * shortest);
        }
        cz_track_deflection(track, 0, place, z, flexibility); /* after slope_at */
        for (int wheel = 0; wheel < 4; ++wheel)
            work -= force[wheel] * modes_at(modes, y, -0.5 * step, false, place[wheel]);
        step_modes(modes, step, place, force, y);
        for (int wheel = 0; wheel < 4; ++wheel)
            work += force[wheel] * modes_at(modes, y, -0.5 * step, false, place[wheel]);
        assert_near(cz_track_step(track, &track->under[0], force), work, 0.0, 280e3 * allowed);
    }
    cz_arena_free(&arena);
}

static void a_step_is_the_exact_motion_of_each_mode(void **state) {
    (void)state;
    CzArena arena = {0};
    steps_are_the_exact_motion_of_each_mode(usual_modes(SPAN, 0, 1500.0, &arena));
    steps_are_the_exact_motion_of_each_mode(usual_modes(SPAN, 14, 1500.0, &arena));
    /* The free sine is above the cut; there are more aliases. */
    steps_are_the_exact_motion_of_each_mode(usual_modes(SPAN, 30, 1072.0, &arena));
    steps_are_the_exact_motion_of_each_mode(usual_modes(SPAN, 30, 3000.0, &arena));
    /* Modes without oscillation. */
    CzRoadbed roadbed = usual_roadbed();
    roadbed.subgrade_damping = 1e6;
    roadbed.ballast_shear_stiffness = 7.84e7;
    roadbed.ballast_shear_damping = 8e4;
    const CzTrackOptions options = cz_track_options_default(SPAN);
    CzTrackModes *modes = NULL;
    CzError error = {0};
    assert_int_equal(cz_track_build(&roadbed, &options, &arena, &modes, &error), CZ_OK);
    steps_are_the_exact_motion_of_each_mode(modes);
    cz_arena_free(&arena);
}

/* Smoothly varying forces of standing wheels: their work on the rail is the growth of kinetic and
 * potential energy plus the losses of pads, ballast and subgrade. The sum of the losses over steps
 * is of second order. */
static double energy_gap(double cut, double step) {
    CzArena arena = {0};
    const double load[4] = {70e3, 71e3, 72e3, 70e3};
    CzTrackMotion *track = track_under(usual_place, load, cut, 0, step, &arena);
    CzTrackUnder *under = &track->under[0];
    const long n_step = lround(0.05 / step);
    double work = 0.0, lost = 0.0, size = 0.0, deflection[4], flexibility[4];
    double rest_energy, grown, last, now;
    cz_track_energy(track, under, &rest_energy, &last);
    assert_near(last, 0.0, 0.0, 1e-9); /* [W] at rest */
    cz_track_deflection(track, 0, usual_place, deflection, flexibility);
    for (long n = 0; n < n_step; ++n) {
        const double s = (double)n / (double)n_step, bump = 16.0 * s * s * (1.0 - s) * (1.0 - s);
        const double force[4] = {-load[0], -load[1] * (1.0 + 2.0 * bump), -load[2],
                                 -load[3] * (1.0 - bump)};
        memcpy(under->force, force, sizeof force);
        work += cz_track_step(track, under, force);
        cz_track_energy(track, under, &grown, &now);
        lost += 0.5 * step * (last + now);
        last = now;
        size = fmax(size, lost);
    }
    grown -= rest_energy;
    assert_true(size > 5.0); /* [J]: the test is sensitive */
    cz_arena_free(&arena);
    return (grown + lost - work) / size;
}

static void work_on_the_track_is_its_energy_and_its_losses(void **state) {
    (void)state;
    /* Losses of modes that are faster than the step are counted to a quarter of a step, of 500. */
    const double allowed = 0.25 / 500.0;
    assert_near(energy_gap(1500.0, 1e-4), 0.0, 0.0, allowed);
    assert_near(energy_gap(1500.0, 2.5e-5), 0.0, 0.0, allowed);
    assert_near(energy_gap(8000.0, 2.5e-5), 0.0, 0.0, allowed);
}

/* Wheels roll one and a half times round the ring; a ring with three times the seats gives the same
 * result. Waves near 60 Hz decay slowest along the track, because sleepers and ballast resonate on
 * the subgrade: after one turn around the ring such a wave has half a percent of its amplitude
 * under the wheel, at any other frequency a tenth of that. */
static void a_longer_window_changes_nothing(void **state) {
    (void)state;
    CzArena arena = {0};
    const double load[4] = {70e3, 71e3, 72e3, 70e3}, step = 1e-4;
    CzTrackMotion *usual = track_under(usual_place, load, 1500.0, 0, step, &arena);
    CzTrackMotion *longer = track_under(usual_place, load, 1500.0, 190, step, &arena);
    assert_int_equal(usual->modes->n_seat, 62);
    double largest = 0.0, moved = 0.0;
    for (int n = 0; n < 28000; ++n) { /* 56 m at 20 m/s */
        const double t = n * step, beat = cz_turned(70.0 * t).re * cz_turned(11.0 * t).im;
        double place[4], force[4], z[2][4], flexibility[4];
        for (int wheel = 0; wheel < 4; ++wheel) {
            place[wheel] = usual_place[wheel] + 20.0 * t;
            force[wheel] = -load[wheel] * (1.0 + (wheel % 2 == 0 ? beat : -0.5 * beat));
        }
        cz_track_deflection(usual, 0, place, z[0], flexibility);
        cz_track_deflection(longer, 0, place, z[1], flexibility);
        for (int wheel = 0; wheel < 4; ++wheel) {
            largest = fmax(largest, fabs(z[0][wheel] - z[1][wheel]));
            moved = fmax(moved, fabs(z[1][wheel]));
        }
        cz_track_step(usual, &usual->under[0], force);
        cz_track_step(longer, &longer->under[0], force);
    }
    print_message("largest deflection %.3g mm, window %.3g mm\n", 1e3 * moved, 1e3 * largest);
    assert_true(moved > 0.5e-3);
    assert_near(largest, 0.0, 0.0, 1e-2 * moved);
    cz_arena_free(&arena);
}

/* Wheels that roll at 20 m/s with a force that varies at 200 Hz by half of the static load. */
static void press(double t, double place[4], double load[4]) {
    const double swell = t < 0.015 ? t / 0.015 : 1.0;
    for (int wheel = 0; wheel < 4; ++wheel) {
        place[wheel] = usual_place[wheel] + 20.0 * t;
        load[wheel] = 70e3 * (1.0 + 0.5 * swell * swell * cz_turned(200.0 * t).im);
    }
}

/* One step of the classical Runge-Kutta method of fourth order; `work` holds 3 n numbers. */
static void runge_kutta(CzTrackMotion *track, double t, double h, double *y, double *work) {
    static const double share[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
    const size_t n = cz_track_n_state(track->modes);
    double *stage = work, *rate = work + n, *sum = work + 2 * n;
    memcpy(sum, y, n * sizeof *sum);
    memset(rate, 0, n * sizeof *rate);
    for (int part = 0; part < 4; ++part) {
        double place[4], load[4], force[4], z[4], flexibility[4], rail_rate[4];
        press(t + share[part] * h, place, load);
        for (int wheel = 0; wheel < 4; ++wheel)
            force[wheel] = -load[wheel];
        for (size_t i = 0; i < n; ++i)
            stage[i] = y[i] + share[part] * h * rate[i];
        cz_track_set_state(track, 0, stage);
        cz_track_deflection(track, 0, place, z, flexibility);
        cz_track_rate(track, 0, force, rate, rail_rate);
        for (size_t i = 0; i < n; ++i)
            sum[i] += weight[part] * h / 6.0 * rate[i];
    }
    memcpy(y, sum, n * sizeof *sum);
}

/* The same modes integrated by a solver of ordinary differential equations with a tenth of the
 * step. The track's own steps take each force as constant over h: at an angular frequency w the
 * error is (w h)^2 / 24, here 7e-4 of the part at 200 Hz. */
static void a_solver_of_differential_equations_finds_the_same(void **state) {
    (void)state;
    enum { PARTS = 10 };
    CzArena arena = {0};
    double place[4], load[4], largest = 0.0;
    press(0.0, place, load);
    CzTrackMotion *track = track_under(place, load, 1500.0, 0, 1e-4, &arena);
    CzTrackMotion *other = track_under(place, load, 1500.0, 0, 0.0, &arena);
    const size_t n = cz_track_n_state(track->modes);
    double *y = cz_arena_allocate(&arena, 4 * n, sizeof *y);
    assert_non_null(y);
    cz_track_get_state(other, 0, y);
    for (int k = 0; k < 300; ++k) {
        double stepped[4], solved[4], quick[4], flexibility[4], force[4];
        press(k * track->step, place, load);
        cz_track_deflection(track, 0, place, stepped, quick);
        cz_track_set_state(other, 0, y);
        cz_track_deflection(other, 0, place, solved, flexibility);
        for (int wheel = 0; wheel < 4; ++wheel) {
            force[wheel] = -load[wheel];
            largest = fmax(largest, fabs((stepped[wheel] - quick[wheel] * load[wheel]) -
                                         (solved[wheel] - flexibility[wheel] * load[wheel])));
        }
        cz_track_step(track, &track->under[0], force);
        for (int part = 0; part < PARTS; ++part)
            runge_kutta(other, (k + (double)part / PARTS) * track->step, track->step / PARTS, y,
                        y + n);
    }
    print_message("largest difference %.3g mm\n", 1e3 * largest);
    assert_near(largest, 0.0, 0.0, 1e-3 * 0.45e-3);
    cz_arena_free(&arena);
}

/* ---- the contact in series with the rail ---- */

static void contact_and_rail_share_the_approach(void **state) {
    (void)state;
    const double hertz = 2.28e11;
    for (double approach = 1e-7; approach < 3e-3; approach *= 1.3)
        for (double flexibility = 0.0; flexibility < 4e-10; flexibility += 5e-11) {
            const double force = cz_wheel_force_on_spring(hertz, flexibility, approach);
            const double left = approach - flexibility * force;
            assert_near(cz_wheel_normal_force(hertz, left), force, ROUNDING_OF_A_SUM, 0.0);
        }
    assert_true(cz_wheel_force_on_spring(hertz, 1e-10, 0.0) == 0.0);
    assert_true(cz_wheel_force_on_spring(hertz, 1e-10, -1e-3) == 0.0);
}

/* ---- under cars ---- */

static void go(Motion *motion, double duration) {
    const long n = lround(duration / motion->step);
    for (long i = 0; i < n; i++) {
        motion_advance(motion);
        motion_evaluate(motion);
    }
}

static void stays_at_rest(const char *track) {
    Motion motion = motion_open("tests/physics/cases/standing.yaml", WITH(track));
    for (size_t k = 0; k < motion.lanes->stride / CZ_LANE_BLOCK; k++)
        memset(&motion.lanes->block[k].velocity, 0, sizeof motion.lanes->block[k].velocity);
    motion_start(&motion);
    for (int i = 0; i < 5; i++) {
        go(&motion, 0.05);
        for (int car = 0; car < 3; car++)
            for (int dof = 0; dof < CZ_N_DOF; dof++) {
                assert_near(*position(&motion, dof, car), 0.0, 0.0, ROUNDING_OF_A_SUM);
                assert_near(*velocity(&motion, dof, car), 0.0, 0.0, ROUNDING_OF_A_SUM);
            }
    }
    motion_close(&motion);
}

static void cars_at_rest_on_any_track_stay_at_rest(void **state) {
    (void)state;
    stays_at_rest("simulation.track=modal");
    stays_at_rest("simulation.track=receptance");
    stays_at_rest("simulation.track=fe");
}

/* A standing car whose first wheel is nudged by a nanometre, in steps of a share of the bound: the
 * displacement of a wheel at the end. Its wheels stand over sleepers, where the rail deflects
 * least, with an almost rigid contact. */
static double swing_after(double share) {
    Motion motion =
        motion_open("tests/physics/cases/standing.yaml", WITH("simulation.track=modal"));
    for (size_t k = 0; k < motion.lanes->stride / CZ_LANE_BLOCK; k++)
        memset(&motion.lanes->block[k].velocity, 0, sizeof motion.lanes->block[k].velocity);
    double *hertz = parameter(&motion, CZ_PARAMETER(wheel.hertz), 0);
    *hertz *= 1e3;
    for (int axle = 0; axle < 4; axle++)
        *parameter(&motion, CZ_PARAMETER(wheel.indentation[axle]), 0) *= 1e-2;
    *parameter(&motion, CZ_PARAMETER(bogie_x), 0) = 13 * 0.6;
    *parameter(&motion, CZ_PARAMETER(axle_x), 0) = 2 * 0.6;
    const double indentation = *parameter(&motion, CZ_PARAMETER(wheel.indentation[0]), 0);
    const double contact = 1.5 * *hertz * sqrt(indentation);
    motion.step =
        share * cz_track_longest_step(motion.collision.model->track, 1.0 / contact,
                                      *parameter(&motion, CZ_PARAMETER(inverse.wheelset.mass), 0),
                                      *parameter(&motion, CZ_PARAMETER(primary.stiffness), 0));
    assert_true(motion.step < 2e-4 * share); /* not the one that the modes themselves set */
    motion_start(&motion);
    *position(&motion, CZ_DOF(wheelset[0].z), 0) = 1e-9;
    motion_evaluate(&motion);
    double largest = 0.0;
    for (int i = 0; i < 4000; i++) {
        motion_advance(&motion);
        motion_evaluate(&motion);
        largest = fmax(largest, fabs(*position(&motion, CZ_DOF(wheelset[0].z), 0)));
    }
    motion_close(&motion);
    return largest;
}

static void a_wheel_on_the_rail_is_stable_up_to_its_bound(void **state) {
    (void)state;
    assert_true(swing_after(0.98) < 3e-9);
    assert_true(swing_after(1.02) > 1e-6);
}

/* ---- finite elements ---- */

static void elements_converge_to_the_pinned_pinned_frequency(void **state) {
    (void)state;
    assert_rows_of(rows_of_element_frequencies);
}

static void elements_deflect_as_the_closed_form(void **state) {
    (void)state;
    assert_rows_of(rows_of_element_statics);
}

/* Rolling wheels with pulses of 6 ms of three times the static force: elements and modes agree to
 * 0.4 % of the deflection. Two permille are the modes' cut at 1.5 kHz. */
static void modes_and_elements_have_equal_deflections(void **state) {
    (void)state;
    CzArena arena = {0};
    const double step = 5e-5, load[4] = {70e3, 70e3, 70e3, 70e3};
    CzTrackMotion *track = track_under(usual_place, load, 1500.0, 0, step, &arena);
    CzElements *elements = cz_elements_create(&track->modes->seats, 8, SPAN, step, 1, &arena);
    assert_non_null(elements);
    assert_true(cz_elements_lay(elements, 0, usual_place, load, &arena));
    double largest = 0.0, moved = 0.0;
    for (int n = 0; n < 6000; ++n) {
        double place[4], force[4], z[4], flexibility[4];
        CzRailPoint point[4];
        for (int wheel = 0; wheel < 4; ++wheel) {
            const double beat = fmod(20.0 * n * step + 0.25 * wheel, 1.0) * 8.0;
            const double pulse =
                beat < 1.0 ? 16.0 * beat * beat * (1.0 - beat) * (1.0 - beat) : 0.0;
            place[wheel] = usual_place[wheel] + 20.0 * n * step;
            force[wheel] = -load[wheel] * (1.0 + 2.0 * pulse);
        }
        cz_track_deflection(track, 0, place, z, flexibility);
        cz_elements_deflection(elements, 0, place, point);
        for (int wheel = 0; wheel < 4; ++wheel) {
            const double of_modes = z[wheel] + flexibility[wheel] * force[wheel];
            const double of_elements = point[wheel].z + point[wheel].flexibility * force[wheel];
            largest = fmax(largest, fabs(of_modes - of_elements));
            moved = fmax(moved, fabs(of_elements));
        }
        cz_track_step(track, &track->under[0], force);
        memcpy(elements->under[0].force, force, sizeof force);
        cz_elements_step(elements, 0);
    }
    print_message("largest deflection %.4g mm, difference %.3g mm\n", 1e3 * moved, 1e3 * largest);
    assert_true(moved > 1e-3);
    assert_near(largest, 0.0, 0.0, 4e-3 * moved);
    cz_arena_free(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_load_at_rest_deflects_the_track_as_its_statics),
        cmocka_unit_test(wheels_interact_as_in_the_statics),
        cmocka_unit_test(a_step_is_the_exact_motion_of_each_mode),
        cmocka_unit_test(work_on_the_track_is_its_energy_and_its_losses),
        cmocka_unit_test(a_longer_window_changes_nothing),
        cmocka_unit_test(a_solver_of_differential_equations_finds_the_same),
        cmocka_unit_test(contact_and_rail_share_the_approach),
        cmocka_unit_test(cars_at_rest_on_any_track_stay_at_rest),
        cmocka_unit_test(a_wheel_on_the_rail_is_stable_up_to_its_bound),
        cmocka_unit_test(elements_converge_to_the_pinned_pinned_frequency),
        cmocka_unit_test(elements_deflect_as_the_closed_form),
        cmocka_unit_test(modes_and_elements_have_equal_deflections),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
