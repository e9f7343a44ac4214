/* The force of one series chain in one lane, from the laws themselves. Part of kernel.c only.
 *
 * The stroke x_j(F) that each member takes at a force grows with it up to the force at which its
 * law begins to fall, so up to the smallest of these forces there is one solution of
 *
 *   sum over members of x_j(F) + C F = closure
 *
 * found within a bracket that only shrinks. Where the closure requires more, the member that begins
 * to fall first is shortened further: F is its law at its own stroke, the others unload along their
 * rising parts, until the closure is reached or its law rises again. From there on all laws rise
 * once more, up to the smallest force at which one begins to fall, and so on. This is the path of a
 * chain that is closed slowly. Identical members move together.
 *
 * The result of a lane depends on that lane alone. Few steps need the search, so it need not be
 * fast.
 */
#ifndef CZ_DYNAMICS_KERNEL_CHAIN_SEARCH_H
#define CZ_DYNAMICS_KERNEL_CHAIN_SEARCH_H

#include "dynamics/kernel_chain.h"
#include "dynamics/law_rows.h"

enum {
    SEARCH_MEMBERS = 8,      /* two springs and up to six plastic members */
    SEARCH_ITERATIONS = 200, /* of a bracket that is halved at least every other time */
    SEARCH_TURNS = 100       /* falling parts that one step may pass (ours) */
};
#define SEARCH_STIFFNESS 1.0 /* makes the solution unique on level parts [N/m] (ours) */
#define SEARCH_CLOSURE 1e-14 /* largest closure left unbalanced [m] */
#define SEARCH_FORCE 1e-7    /* largest deviation of a stroke from its law [N] */
#define RIGID 1e25           /* from this stiffness or strength on a member is rigid */
#define ALIKE 1e-9           /* largest relative difference of identical members */
#define BEYOND_FALL 1e-4     /* stroke beyond the fall at which they are compared [m] (ours) */

typedef struct Search {
    const Chain *chain;
    size_t lane;
    int holds; /* shear-offs keep their present strength */
    int n_member;
    double start[SEARCH_MEMBERS];     /* committed stroke [m] */
    double from[SEARCH_MEMBERS];      /* stroke from which the law rises: start, or a minimum [m] */
    double force[SEARCH_MEMBERS];     /* of the law at this stroke [N] */
    double fall[SEARCH_MEMBERS];      /* stroke at which it begins to fall [m] */
    double strongest[SEARCH_MEMBERS]; /* its force there [N] */
    int is_there[SEARCH_MEMBERS];     /* neither missing nor rigid */
    double reach;                     /* no member moves further than this [m] */
    double compliance, closure, lowest;
    double last; /* force at the beginning of the step [N] */
} Search;

/* Strength s(x) with the rate effect and stiffness of the step: s(x) (1 + gain (x - start)) +
 * stiffness (x - start). */
typedef struct Resistance {
    double start, gain, stiffness;
} Resistance;

/* First stroke, not below `from`, at which a strength with these additions begins to fall, or,
 * where it falls at `from`, at which it rises again (`rises`); infinite where there is none. The
 * slope of the sum decreases along a falling part of the curve: its one root is where the sum
 * begins to fall, and the sum does not rise again before the end of that part. */
static double curve_turns_at(const CzBlockCurve *curve, size_t lane, double from, int rises,
                             const Resistance *added) {
    double slope = 0.0, value = curve->start[lane], begin = 0.0;
    for (int k = 0; k <= curve->n_breakpoint; ++k) {
        const int is_last = k == curve->n_breakpoint;
        const double end = is_last ? INFINITY : curve->breakpoint[k].at[lane];
        if (end > from) {
            const double gain = added->gain, first = cz_larger(begin, from);
            const double at_first = value + slope * (first - begin);
            const double sum =
                slope * (1.0 + gain * (first - added->start)) + at_first * gain + added->stiffness;
            const int falls_on = slope < 0.0 && begin <= from;
            if (rises ? sum >= 0.0 && !falls_on : sum < 0.0)
                return first;
            const double root =
                slope < 0.0 && gain > 0.0 ? first - sum / (2.0 * slope * gain) : INFINITY;
            if (!rises && root < end)
                return root;
        }
        if (!is_last && end < CZ_NEVER) {
            value += slope * (end - begin);
            begin = end;
            slope += curve->breakpoint[k].change[lane];
        }
    }
    return INFINITY;
}

/* Force of a plastic member that has moved in the step. */
static double plastic_force(const Search *s, int number, double stroke) {
    const Plastic *member = &s->chain->plastic[number];
    const size_t i = s->lane;
    const double moved = stroke - s->start[2 + number];
    if (number < s->chain->n_curve) {
        double value, slope;
        curve_at(member->curve, i, stroke, &value, &slope);
        const double strength = value * (1.0 + member->rise[i]);
        return strength +
               moved / cz_plastic_compliance(strength, 0.0, member->rate[i], s->chain->step);
    }
    const PlasticState *plastic = &s->chain->now.plastic[number];
    if (s->holds)
        return plastic->strength[i] + moved / plastic->compliance[i];
    const CzShearOffLaw law = cz_shear_off_at(member->shear, i);
    return cz_shear_off(&law, stroke).strength + CZ_SMALLEST_RESISTANCE * moved;
}

static double law_at(const Search *s, int member, double stroke) {
    const double moved = stroke - s->start[member];
    const double force = member < 2 ? s->chain->law->force_at(s->chain, member, s->lane, stroke)
                                    : plastic_force(s, member - 2, stroke);
    return force + SEARCH_STIFFNESS * moved;
}

/* TurnsAt for a plastic member. */
static double plastic_turns_at(const Search *s, int number, double from, int rises) {
    const Plastic *member = &s->chain->plastic[number];
    if (number < s->chain->n_curve) {
        const Resistance added = {s->start[2 + number], member->rate[s->lane] / s->chain->step,
                                  CZ_SMALLEST_RESISTANCE};
        return curve_turns_at(member->curve, s->lane, from, rises, &added);
    }
    const double softening = member->shear->softening[s->lane];
    const int is_falling = !s->holds && from < softening;
    if (rises)
        return is_falling ? softening : from;
    return is_falling ? from : INFINITY;
}

static double turns_at(const Search *s, int member, double from, int rises) {
    if (member >= 2)
        return plastic_turns_at(s, member - 2, from, rises);
    if (s->chain->law->turns_at == NULL)
        return rises ? from : INFINITY;
    return s->chain->law->turns_at(s->chain, member, s->lane, from, rises);
}

/* ---- one unknown in a bracket ---------------------------------------------------------------- */

/* A bracket whose value at `low` is not positive and at `high` not negative: regula falsi, halved
 * where one end has stayed (Illinois), and bisected where that does not shrink it. */
typedef struct Bracket {
    double low, high, at_low, at_high;
    int stayed; /* which end stayed in the last step: -1 low, 1 high, 0 neither */
    double width;
} Bracket;

static Bracket bracket_of(double low, double high, double at_low, double at_high) {
    return (Bracket){low, high, at_low, at_high, 0, high - low};
}

static double guess_in(Bracket *b, int iteration) {
    const double middle = 0.5 * (b->low + b->high);
    const int is_slow = iteration % 4 == 3 && b->high - b->low > 0.25 * b->width;
    if (iteration % 4 == 3)
        b->width = b->high - b->low;
    const double change = b->at_high - b->at_low;
    const double secant = change > 0.0 ? b->low - b->at_low * (b->high - b->low) / change : middle;
    return !is_slow && secant > b->low && secant < b->high ? secant : middle;
}

static void shrink(Bracket *b, double x, double value) {
    if (value <= 0.0) {
        b->low = x;
        b->at_low = value;
        b->at_high *= b->stayed == 1 ? 0.5 : 1.0;
        b->stayed = 1;
    } else {
        b->high = x;
        b->at_high = value;
        b->at_low *= b->stayed == -1 ? 0.5 : 1.0;
        b->stayed = -1;
    }
}

static int is_shut(const Bracket *b) {
    const double middle = 0.5 * (b->low + b->high);
    return !(middle > b->low && middle < b->high);
}

/* ---- strokes at a force ---------------------------------------------------------------------- */

/* Stroke of a member at a force, on the part of its law that rises. Springs may unload below their
 * stroke at the beginning of the step; plastic members and members that have passed a minimum may
 * not. */
static double stroke_at(const Search *s, int member, double force) {
    const double from = s->from[member];
    const int goes_on = force > s->force[member];
    const int stays = member >= 2 || from > s->start[member];
    if (!s->is_there[member] || force == s->force[member] || (stays && !goes_on))
        return from;
    if (force >= s->strongest[member])
        return s->fall[member];
    const double far = goes_on ? cz_smaller(s->fall[member], from + s->reach) : from - s->reach;
    const double at_from = s->force[member] - force, at_far = law_at(s, member, far) - force;
    if (goes_on ? at_far < 0.0 : at_far > 0.0)
        return far;
    Bracket b =
        goes_on ? bracket_of(from, far, at_from, at_far) : bracket_of(far, from, at_far, at_from);
    double stroke = from;
    for (int k = 0; k < SEARCH_ITERATIONS && !is_shut(&b); ++k) {
        stroke = guess_in(&b, k);
        const double missed = law_at(s, member, stroke) - force;
        if (fabs(missed) <= SEARCH_FORCE)
            return stroke;
        shrink(&b, stroke, missed);
    }
    return stroke;
}

/* Sum of the strokes and the deflection of the compliance, less the closure. */
static double open_at(const Search *s, double force, double *stroke) {
    double sum = s->compliance * force - s->closure;
    for (int member = 0; member < s->n_member; ++member) {
        stroke[member] = stroke_at(s, member, force);
        sum += stroke[member];
    }
    return sum;
}

/* The same, with the members that fall first, `goes_on`, at `beyond` the stroke where they
 * begin. */
static double open_beyond(const Search *s, const int *goes_on, int first, double beyond,
                          double *force, double *stroke) {
    *force = cz_larger(law_at(s, first, s->fall[first] + beyond), s->lowest);
    double sum = s->compliance * *force - s->closure;
    for (int member = 0; member < s->n_member; ++member) {
        stroke[member] = goes_on[member] ? s->fall[member] + beyond : stroke_at(s, member, *force);
        sum += stroke[member];
    }
    return sum;
}

/* The member that falls first, and those identical to it; -1 where none falls. */
static int find_falling(const Search *s, int *goes_on) {
    int first = -1;
    double of_first = 0.0, beyond_first = 0.0;
    for (int member = 0; member < s->n_member; ++member) {
        goes_on[member] = 0;
        if (!s->is_there[member] || !isfinite(s->fall[member]))
            continue;
        const double most = s->strongest[member];
        const double beyond = law_at(s, member, s->fall[member] + BEYOND_FALL);
        const double allowed = ALIKE * fabs(of_first);
        const int is_less = first < 0 || most < of_first - allowed;
        const int is_as_much = first >= 0 && fabs(most - of_first) <= allowed;
        if (is_less || (is_as_much && beyond < beyond_first - allowed)) {
            memset(goes_on, 0, sizeof(int) * (size_t)s->n_member);
            first = member;
            of_first = most;
            beyond_first = beyond;
            goes_on[member] = 1;
        } else if (is_as_much && fabs(beyond - beyond_first) <= allowed)
            goes_on[member] = 1;
    }
    return first;
}

/* ---- the search ------------------------------------------------------------------------------ */

/* Begins the rising part of a member's law at a stroke. */
static void rise_from(Search *s, int member, double from) {
    const int is_there = s->is_there[member];
    s->from[member] = from;
    s->force[member] = is_there ? law_at(s, member, from) : 0.0;
    s->fall[member] = is_there ? turns_at(s, member, from, 0) : INFINITY;
    s->strongest[member] =
        isfinite(s->fall[member]) ? law_at(s, member, s->fall[member]) : INFINITY;
}

static void list_member(Search *s, int member, double stroke, int is_there) {
    s->start[member] = stroke;
    s->is_there[member] = is_there;
    rise_from(s, member, stroke);
}

/* The chain of a lane at its committed state. */
static Search search_of(const Chain *chain, int holds, size_t lane) {
    Search s = {.chain = chain, .lane = lane, .holds = holds, .n_member = 2 + chain->n_plastic};
    s.compliance = chain->compliance[lane];
    s.closure = chain->closure[lane];
    s.lowest = chain->now.lowest[lane];
    s.last = chain->last[lane];
    double sum = s.compliance * s.last, size = fabs(sum);
    for (int side = 0; side < 2; ++side) {
        const double stroke = chain->spring[side].stroke[lane];
        const int gives = chain->now.spring[side].up[lane] > 1.0 / RIGID;
        list_member(&s, side, stroke, gives);
        sum += stroke;
        size += fabs(stroke);
    }
    for (int member = 0; member < chain->n_plastic; ++member) {
        const double stroke = chain->plastic[member].stroke[lane];
        const int is_there =
            !chain->plastic[member].is_missing && chain->now.plastic[member].strength[lane] < RIGID;
        list_member(&s, 2 + member, stroke, is_there);
        sum += stroke;
    }
    s.reach = fabs(s.closure - sum) + size + 1e-3;
    return s;
}

/* The solution between two forces, where all laws rise; false where the closure requires more. */
static int search_rising(const Search *s, double least, double most, double *force,
                         double *stroke) {
    *force = least;
    const double at_least = open_at(s, least, stroke);
    if (at_least >= 0.0)
        return 1; /* slack */
    double high = cz_smaller(most, cz_larger(2.0 * fabs(s->last), 1e6));
    double at_high = open_at(s, high, stroke);
    while (at_high < 0.0 && high < most && high < RIGID) {
        high = cz_smaller(most, 4.0 * high);
        at_high = open_at(s, high, stroke);
    }
    *force = high;
    if (at_high < 0.0)
        return 0;
    Bracket b = bracket_of(least, high, at_least, at_high);
    for (int k = 0; k < SEARCH_ITERATIONS && !is_shut(&b); ++k) {
        *force = guess_in(&b, k);
        const double left = open_at(s, *force, stroke);
        if (fabs(left) <= SEARCH_CLOSURE)
            break;
        shrink(&b, *force, left);
    }
    return 1;
}

/* The solution while the first member falls, up to `most` beyond the stroke where it begins; false
 * where the closure requires more. The stroke is doubled until it brackets the first solution. */
static int search_falling(const Search *s, const int *goes_on, int first, double most,
                          double *force, double *stroke) {
    double low = 0.0, high = cz_smaller(most, 1e-6 * s->reach);
    double at_low = open_beyond(s, goes_on, first, low, force, stroke);
    double at_high = open_beyond(s, goes_on, first, high, force, stroke);
    while (at_high < 0.0 && high < most) {
        low = high;
        at_low = at_high;
        high = cz_smaller(most, 2.0 * high);
        at_high = open_beyond(s, goes_on, first, high, force, stroke);
    }
    if (at_high < 0.0)
        return 0;
    Bracket b = bracket_of(low, high, at_low, at_high);
    for (int k = 0; k < SEARCH_ITERATIONS && !is_shut(&b); ++k) {
        const double beyond = guess_in(&b, k);
        const double left = open_beyond(s, goes_on, first, beyond, force, stroke);
        if (fabs(left) <= SEARCH_CLOSURE)
            break;
        shrink(&b, beyond, left);
    }
    return 1;
}

/* Stroke over which the members `goes_on` fall before one of them rises again. */
static double falling_length(const Search *s, const int *goes_on) {
    double length = s->reach;
    for (int member = 0; member < s->n_member; ++member)
        if (goes_on[member])
            length = cz_smaller(length, turns_at(s, member, s->fall[member], 1) - s->fall[member]);
    return length;
}

/* Follows the chain through rising and falling parts in turn, up to its closure. */
static void search_branch(Search *s, double *force, double *stroke) {
    double least = s->lowest;
    for (int turn = 0; turn < SEARCH_TURNS; ++turn) {
        int goes_on[SEARCH_MEMBERS];
        const int first = find_falling(s, goes_on);
        const double most = first < 0 ? INFINITY : cz_larger(s->strongest[first], least);
        if (search_rising(s, least, most, force, stroke) || first < 0)
            return;
        const double length = falling_length(s, goes_on);
        if (search_falling(s, goes_on, first, length, force, stroke))
            return;
        for (int member = 0; member < s->n_member; ++member)
            if (goes_on[member])
                rise_from(s, member, s->fall[member] + length);
        least = *force;
    }
}

/* Largest deviation of the members of a lane from their laws at given strokes and force [N]. */
static double distance_of(const Search *s, const double *stroke, double force) {
    double distance = 0.0;
    for (int member = 0; member < s->n_member; ++member) {
        if (!s->is_there[member])
            continue;
        const double moved = stroke[member] - s->start[member];
        const double law = law_at(s, member, stroke[member]) - SEARCH_STIFFNESS * moved;
        const int rests = member >= 2 && moved == 0.0;
        distance = cz_larger(distance, rests ? cz_positive_part(force - law) : fabs(force - law));
    }
    return distance;
}

/* Strokes of the linearised members of a lane under the chain's force. */
static void strokes_of(const Search *s, double *stroke) {
    const ChainState *now = &s->chain->now;
    const size_t i = s->lane;
    const double force = now->force[i];
    for (int side = 0; side < 2; ++side) {
        const SpringState *spring = &now->spring[side];
        const double excess = force - spring->force[i];
        stroke[side] = spring->at[i] + excess * (excess > 0.0 ? spring->up : spring->down)[i];
    }
    for (int member = 0; member < s->chain->n_plastic; ++member)
        stroke[2 + member] =
            s->start[2 + member] + (s->is_there[2 + member]
                                        ? cz_plastic_crush(force, now->plastic[member].strength[i],
                                                           now->plastic[member].compliance[i])
                                        : 0.0);
}

/* Stores the solution as a linearisation that reproduces it exactly. */
static void store_solution(ChainState *now, const Search *s, const double *stroke, double force) {
    const size_t i = s->lane;
    now->force[i] = force;
    for (int side = 0; side < 2; ++side) {
        now->spring[side].at[i] = stroke[side];
        now->spring[side].force[i] = force;
    }
    for (int member = 0; member < s->chain->n_plastic; ++member) {
        PlasticState *plastic = &now->plastic[member];
        const double moved = stroke[2 + member] - s->start[2 + member];
        if (!s->is_there[2 + member])
            continue;
        if (moved > 0.0) {
            plastic->strength[i] = force - CZ_SMALLEST_RESISTANCE * moved;
            plastic->compliance[i] = 1.0 / CZ_SMALLEST_RESISTANCE;
        } else
            plastic->strength[i] = cz_larger(plastic->strength[i], force);
    }
}

/* Closure that the strokes of a lane and its compliance leave unbalanced. */
static double open_by(const Search *s, double force, const double *stroke) {
    double sum = s->compliance * force - s->closure;
    for (int member = 0; member < s->n_member; ++member)
        sum += stroke[member];
    return sum;
}

/* Searches the force of the chain in one lane where a member does not satisfy its law, or `always`;
 * publishes the residual, which the run checks. */
static void search_lane(Chain *chain, CzPublished *published, int holds, size_t lane, int always) {
    Search s = search_of(chain, holds, lane);
    double stroke[SEARCH_MEMBERS], force = chain->now.force[lane];
    strokes_of(&s, stroke);
    double sum = open_by(&s, force, stroke);
    const double tolerance = CHAIN_TOLERANCE;
    const int is_open = force <= s.lowest ? sum < -tolerance : fabs(sum) > tolerance;
    double distance = distance_of(&s, stroke, force);
    if (always || is_open || !(distance <= LAW_TOLERANCE)) {
        search_branch(&s, &force, stroke);
        store_solution(&chain->now, &s, stroke, force);
        distance = distance_of(&s, stroke, force);
        published->chain.searched[lane] += 1.0;
        sum = open_by(&s, force, stroke);
    }
    const double left = force <= s.lowest ? cz_positive_part(-sum) : fabs(sum);
    chain->now.distance[lane] = distance;
    published->chain.residual[lane] = cz_larger(published->chain.residual[lane], left);
}

#endif
