/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/friction.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "base/vector_clones.h"
#include "contact/plastic.h"
#include "numeric/special.h"

void friction_ratios(const struct hertz_contact *hertz, const struct material *a,
                     const struct material *b, double ratio[2])
{
    const struct material *const materials[2] = {a, b};
    double q = hertz->axis_ratio * hertz->axis_ratio;
    double k = special_elliptic_rf0(q, 1.0);
    double d = special_elliptic_rd0(q, 1.0) / 3.0;
    double along[2] = {d, k - d};
    for (int j = 0; j < 2; j++) {
        double normal = 0.0, tangential = 0.0;
        for (int i = 0; i < 2; i++) {
            double nu = materials[i]->poisson;
            double shear = material_shear_modulus(materials[i]);
            normal += (1.0 - nu) * k / shear;
            tangential += ((1.0 - nu) * k + nu * along[j]) / shear;
        }
        ratio[j] = normal / tangential;
    }
}

/* Angle, rad, that a force turns by on its way, or its distance from an axis of kappa, below which
 * the turn, of second order in it, is rounding. */
static const double STRAIGHT = 1e-9;

/* What a history has of its own; the cells' edges move with the branch of a law that yields. */
static bool take_history(struct friction *friction, struct arena *arena)
{
    size_t n = friction->count;
    friction->share = arena_take(arena, 6 * n, sizeof *friction->share);
    friction->traction[0] = friction->share + n;
    friction->traction[1] = friction->share + 2 * n;
    friction->edge = friction->share + 3 * n;
    friction->force = friction->share + 4 * n;
    friction->base = friction->share + 5 * n;
    return friction->share != NULL;
}

/* Cells over those up to the depth: sixteen depths. Contacts that are wedged by friction, backed by
 * a group or pressed go several times as deep as their own bodies' speed lets expect. */
enum { DEEPER = 4 };

bool friction_create(struct friction *friction, double coefficient, const double ratio[3],
                     size_t parts, struct arena *arena)
{
    size_t count = DEEPER * parts;
    *friction = (struct friction){.coefficient = coefficient, .parts = parts, .count = count};
    memcpy(friction->ratio, ratio, sizeof friction->ratio);
    friction->slope = arena_take(arena, 3 * count, sizeof *friction->slope);
    if (!friction->slope || !take_history(friction, arena))
        return false;
    friction->stiffness = friction->slope + count;
    friction->compliance = friction->slope + 2 * count;
    return true;
}

bool friction_second(struct friction *second, const struct friction *friction, struct arena *arena)
{
    *second = *friction;
    return take_history(second, arena);
}

void friction_copy(struct friction *to, const struct friction *from)
{
    size_t cells = to->reached > from->reached ? to->reached : from->reached;
    size_t size = cells * sizeof *to->share;
    double *share = to->share, *edge = to->edge, *force = to->force, *base = to->base;
    double *traction[2] = {to->traction[0], to->traction[1]};
    memcpy(share, from->share, size);
    memcpy(traction[0], from->traction[0], size);
    memcpy(traction[1], from->traction[1], size);
    if (from->spacing > 0.0) {
        size = from->placed * sizeof *edge;
        memcpy(edge, from->edge, size);
        memcpy(force, from->force, size);
        memcpy(base, from->base, size);
    }
    *to = *from;
    to->share = share;
    memcpy(to->traction, traction, sizeof traction);
    if (from->spacing > 0.0) {
        to->edge = edge;
        to->force = force;
        to->base = base;
    }
}

/* A cell that is closed throughout, by its edges. */
static void close_cell(struct friction *friction, size_t i)
{
    double width = friction->edge[i + 1] - friction->edge[i];
    friction->base[i] = friction->force[i + 1] - friction->force[i] - width * friction->slope[i] -
                        friction->edge[i + 1] * friction->stiffness[i];
}

/* Cells of an elastic law. */
static void divide_indentation(struct friction *friction)
{
    for (size_t i = 0; i < friction->count; i++) {
        double part = (double)i / (double)friction->parts;
        friction->edge[i] = friction->depth * part * part;
        friction->force[i] =
            contact_law_force(friction->law, friction->edge[i], &friction->slope[i]);
    }
    for (size_t i = 0; i + 1 < friction->count; i++) {
        friction->stiffness[i] = friction->slope[i + 1] - friction->slope[i];
        close_cell(friction, i);
    }
}

/* The law's branch after a largest depth, its slopes made to rise. */
static void find_branch(struct friction_branch *branch, const struct contact_law *law,
                        double largest)
{
    const struct contact_law after = contact_law_after(law, largest);
    const struct contact_history *history = &after.history;
    double span = history->max_indentation - history->dent;
    *branch = (struct friction_branch){.largest = largest, .dent = history->dent, .span = span};
    for (int k = 1; k <= FRICTION_BRANCH; k++) {
        double root = (double)k / FRICTION_BRANCH, slope;
        after.operations->curve->branch(&after, root * root, &slope);
        branch->slope[k] = larger(slope, branch->slope[k - 1]);
    }
    /* the integral of the slope by the way, the square of the root; its scale */
    const double step = 1.0 / FRICTION_BRANCH;
    for (int k = 0; k < FRICTION_BRANCH; k++)
        branch->force[k + 1] = branch->force[k] + step * step *
                                                      ((k + 1.0 / 3.0) * branch->slope[k] +
                                                       (k + 2.0 / 3.0) * branch->slope[k + 1]);
    double unit = history->max_force / branch->force[FRICTION_BRANCH];
    for (int k = 0; k <= FRICTION_BRANCH; k++) {
        branch->force[k] *= unit;
        branch->slope[k] *= unit / span;
    }
}

/* Force and slope of the branch at a root of the way back, 0..1. */
static double branch_force(const struct friction_branch *branch, double root, double *slope)
{
    double place = root * FRICTION_BRANCH;
    int k = place < FRICTION_BRANCH ? (int)place : FRICTION_BRANCH - 1;
    double rise = branch->slope[k + 1] - branch->slope[k];
    double part = place - k;
    const double step = branch->span / (FRICTION_BRANCH * FRICTION_BRANCH);
    *slope = branch->slope[k] + part * rise;
    return branch->force[k] +
           step * part *
               (branch->slope[k] * (2.0 * k + part) + rise * part * (k + 2.0 / 3.0 * part));
}

/* The law's largest depth at an indentation, m. */
static double largest_depth(const struct contact_law *law, double indentation)
{
    double so_far = larger(law->operations->curve->yield(law), law->history.max_indentation);
    return larger(so_far, indentation + law->history.dent);
}

/* Moves the cells' edges to the branch at an indentation. False: they are there. */
static bool follow_branch(struct friction *friction, double indentation)
{
    struct friction_branch *branch = &friction->branch;
    double largest = largest_depth(friction->law, indentation);
    if (largest == branch->largest)
        return false;
    find_branch(branch, friction->law, largest);
    double top = branch->slope[FRICTION_BRANCH];
    int k = 0;
    size_t i = 0;
    for (; i < friction->count && friction->slope[i] <= top; i++) {
        while (k + 1 < FRICTION_BRANCH && branch->slope[k + 1] < friction->slope[i])
            k++;
        double rise = branch->slope[k + 1] - branch->slope[k], slope;
        double part = rise > 0.0 ? (friction->slope[i] - branch->slope[k]) / rise : 0.0;
        double root = (k + part) / FRICTION_BRANCH;
        friction->edge[i] = branch->span * root * root;
        friction->force[i] = branch_force(branch, root, &slope);
        if (i > 0)
            close_cell(friction, i - 1);
    }
    friction->placed = i;
    return true;
}

/* Cells of a law that yields. */
static void divide_slope(struct friction *friction)
{
    struct friction_branch deepest;
    find_branch(&deepest, friction->law, largest_depth(friction->law, friction->depth));
    friction->spacing = deepest.slope[FRICTION_BRANCH] / (double)friction->parts;
    for (size_t i = 0; i < friction->count; i++) {
        friction->slope[i] = friction->spacing * (double)i;
        friction->stiffness[i] = friction->spacing;
    }
    friction->branch.largest = 0.0;
    follow_branch(friction, 0.0);
}

void friction_touch(struct friction *friction, const struct contact_law *law, double depth)
{
    const double *kappa = friction->ratio;
    double square = kappa[0] * kappa[2] - kappa[1] * kappa[1];
    friction->law = law;
    friction->depth = depth;
    friction->isotropic = kappa[0] == kappa[2] && kappa[1] == 0.0;
    friction->line = fabs(kappa[1]) <= STRAIGHT * kappa[0];
    friction->over_ratio[0] = kappa[2] / square;
    friction->over_ratio[1] = -kappa[1] / square;
    friction->over_ratio[2] = kappa[0] / square;
    friction->indentation = friction->stuck = 0.0;
    friction->at = (struct friction_normal){.indentation = 0.0};
    friction->displacement[0] = friction->displacement[1] = 0.0;
    friction->spacing = 0.0;
    if (law->operations->curve)
        divide_slope(friction);
    else
        divide_indentation(friction);
    for (size_t i = 0; i + 1 < friction->count; i++)
        friction->compliance[i] = friction->stiffness[i] > 0.0 ? 1.0 / friction->stiffness[i] : 0.0;
    memset(friction->share, 0, 3 * friction->count * sizeof *friction->share);
    friction->reached = 0;
}

void friction_deepen(struct friction *friction, double deeper)
{
    friction->indentation -= deeper;
}

/* The cell that is closed in part at an indentation > 0, and those before it throughout. */
static size_t last_closed(const struct friction *friction, double indentation)
{
    size_t last = friction->count - 1;
    double place = (double)friction->parts * sqrt(indentation / friction->depth);
    size_t i = place < (double)last ? (size_t)place : last;
    while (i > 0 && friction->edge[i] >= indentation)
        i--;
    while (i < last && friction->edge[i + 1] <= indentation)
        i++;
    return i;
}

static struct friction_normal normal_on_branch(const struct friction *friction, double indentation)
{
    const struct friction_branch *branch = &friction->branch;
    double back = indentation + friction->law->history.dent - branch->dent;
    struct friction_normal at = {.indentation = larger(smaller(back, branch->span), 0.0)};
    at.force = branch_force(branch, sqrt(at.indentation / branch->span), &at.slope);
    size_t last = friction->placed - 1;
    double place = at.slope / friction->spacing;
    at.last = place < (double)last ? (size_t)place : last;
    return at;
}

static struct friction_normal normal_at(const struct friction *friction, double indentation)
{
    struct friction_normal at = {.indentation = 0.0};
    if (!(indentation > 0.0))
        return at;
    if (friction->spacing > 0.0)
        return normal_on_branch(friction, indentation);
    at.indentation = indentation;
    at.force = contact_law_force(friction->law, indentation, &at.slope);
    at.last = last_closed(friction, indentation);
    return at;
}

/* The stiffness of a cell over kappa. */
static double cell_stiffness(const struct friction *friction, size_t i,
                             const struct friction_normal *at)
{
    if (i < at->last)
        return friction->stiffness[i];
    return i == at->last ? larger(at->slope - friction->slope[i], 0.0) : 0.0;
}

/* The normal force that a cell bears. */
static double cell_share(const struct friction *friction, size_t i,
                         const struct friction_normal *at)
{
    double below = at->indentation - friction->edge[i];
    if (i > at->last || !(below > 0.0))
        return 0.0;
    if (i < at->last)
        return friction->base[i] + friction->stiffness[i] * at->indentation;
    return larger(at->force - friction->force[i] - below * friction->slope[i], 0.0);
}

/* (x, y)^T kappa^-1 of another vector. */
static inline double over_ratio(const double over[3], double x, double y, const double other[2])
{
    return x * (over[0] * other[0] + over[1] * other[1]) +
           y * (over[1] * other[0] + over[2] * other[1]);
}

/* A walk of the cells: the way of kappa times the displacement over mu, and sums, all along the
 * axis and across it; the loss over mu^2. */
struct walk {
    double moved[2], turn; /* the angle that it turns by, rad */
    double force[2], lost;
    double stuck,
        turning[3]; /* stiffnesses of cells that stick, and of forces that turn, xx, yy, xy */
};

/* Part of a loop over cells, which is vectorised as a whole. */
#define EACH_CELL __attribute__((always_inline)) static inline

/* Cells at a time, a multiple of LANES: their ways, and those that slip. */
enum { STRIP = 64, LANES = 4 };

struct strip {
    /* of each cell: share at the end, mean stiffness over the way, compliances of the part that was
     * closed all the way and at the end; the square of its elastic force over its limit, > 0: it
     * slips */
    double share[STRIP], stiffness[STRIP], before[STRIP], after[STRIP], excess[STRIP];
    /* cells from `slips` up to `sticks` slip; from `begins` up to `begun` they stuck before */
    size_t slips, sticks, begins, begun;
    /* of those that slip, where it begins to: the force, its limit, and the part of the way that is
     * left; what is left of the way, elastic */
    double x[STRIP], y[STRIP], limit[STRIP], left[STRIP], way[2][STRIP];
    /* the direction of the force there, that of the way, and the elastic force of the way over the
     * mean limit */
    double at[2][STRIP], along[2][STRIP], ratio[STRIP];
    double turning[3][STRIP], lost[STRIP];
};

/* Sums in the same order for any vectors. */
static double sum_of(const double *values, size_t count)
{
    double sum[LANES] = {0.0};
    size_t i = 0;
    for (; i + LANES <= count; i += LANES)
        for (size_t k = 0; k < LANES; k++)
            sum[k] += values[i + k];
    for (; i < count; i++)
        sum[0] += values[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* So that compilers see a multiple of the lanes, too. */
EACH_CELL size_t whole(size_t cells)
{
    return cells / LANES * LANES;
}

/* Of as many values as lanes. */
static inline bool any_above_zero(const double *of)
{
    return larger(larger(of[0], of[1]), larger(of[2], of[3])) > 0.0;
}

static inline bool all_one(const double *of)
{
    return smaller(smaller(of[0], of[1]), smaller(of[2], of[3])) == 1.0;
}

/* A cell that has slipped before is at its limit: but for rounding. */
static const double AT_LIMIT = 1e-12;

/* The elastic forces at the end of the way, and which cells slip. */
EACH_CELL void try_to_stick(const struct walk *walk, size_t n, const double *x, const double *y,
                            struct strip *strip)
{
    for (size_t i = 0; i < n; i++) {
        double to_x = x[i] + strip->stiffness[i] * walk->moved[0];
        double to_y = y[i] + strip->stiffness[i] * walk->moved[1];
        double share = strip->share[i];
        strip->excess[i] = to_x * to_x + to_y * to_y - share * share;
    }
    size_t first = 0, end = whole(n + LANES - 1);
    while (first < end && !any_above_zero(strip->excess + first))
        first += LANES;
    while (end > first && !any_above_zero(strip->excess + end - LANES))
        end -= LANES;
    strip->slips = first;
    strip->sticks = end;
}

/* Finds the cells up to `closed` that begin to slip on the way. All others have slipped before and
 * go on: they slip from its beginning. */
EACH_CELL void find_begins(const struct walk *walk, size_t closed, const double *from,
                           const double *x, const double *y, struct strip *strip)
{
    for (size_t i = whole(strip->slips); i < whole(strip->sticks); i++) {
        double way = x[i] * walk->moved[0] + y[i] * walk->moved[1];
        double grown = strip->share[i] - from[i], square = from[i] * from[i];
        bool on = strip->stiffness[i] * way >= from[i] * grown &&
                  x[i] * x[i] + y[i] * y[i] - square >= -AT_LIMIT * square;
        strip->left[i] = on || !(strip->excess[i] > 0.0) ? 1.0 : 0.0;
        strip->x[i] = x[i];
        strip->y[i] = y[i];
        strip->limit[i] = from[i];
    }
    size_t first = strip->slips, end = whole(closed);
    while (first < end && all_one(strip->left + first))
        first += LANES;
    while (end > first && all_one(strip->left + end - LANES))
        end -= LANES;
    strip->begins = first;
    strip->begun = end;
}

/* Where the forces reach their limits: |force + part way| = from + part grown, `way` elastic. Every
 * value is found, also those that do not count, so that a loop over cells needs no branch. */
EACH_CELL void begin_slip(const struct walk *walk, size_t first, size_t end, const double *from,
                          const double *x, const double *y, struct strip *strip)
{
    for (size_t i = whole(first); i < whole(end); i++) {
        double stiffness = strip->stiffness[i], grown = strip->share[i] - from[i];
        const double way[2] = {stiffness * walk->moved[0], stiffness * walk->moved[1]};
        double a = way[0] * way[0] + way[1] * way[1] - grown * grown;
        double b = x[i] * way[0] + y[i] * way[1] - from[i] * grown;
        double square = from[i] * from[i];
        double c = x[i] * x[i] + y[i] * y[i] - square;
        double under = b * b - a * c;
        double root = sqrt(under > 0.0 ? under : 0.0);
        double above = b > 0.0 ? -c : root - b;
        double below = b > 0.0 ? b + root : a;
        double part = above / (below > 0.0 ? below : 1.0);
        part = below > 0.0 ? part : 0.0;
        part = part > 0.0 ? part : 0.0;
        part = part < 1.0 ? part : 1.0;
        double goes_on = b >= 0.0 ? c : -1.0;
        double least = goes_on == c ? -AT_LIMIT * square : 0.0;
        part = goes_on >= least ? 0.0 : part;
        strip->x[i] = x[i] + part * way[0];
        strip->y[i] = y[i] + part * way[1];
        strip->limit[i] = from[i] + part * grown;
        strip->left[i] = 1.0 - part;
    }
}

/* What is left of the way, by its chord, and the direction of the force. Along a contact's ellipse
 * the slip is not along kappa times the slip: the rest turns the force as a way of its own.
 * Products below DBL_MIN, as of the forces of a first touch, have no inverse that is a number. */
EACH_CELL void find_ways(const double kappa[3], const struct walk *walk, struct strip *strip)
{
    double apart = 0.5 * (kappa[0] - kappa[2]);
    for (size_t i = whole(strip->slips); i < whole(strip->sticks); i++) {
        double x = strip->x[i], y = strip->y[i], limit = strip->limit[i];
        double past = 0.5 * walk->turn * (1.0 - strip->left[i]);
        double part = strip->left[i] * strip->stiffness[i];
        double way_x = part * (walk->moved[0] - past * walk->moved[1]);
        double way_y = part * (walk->moved[1] + past * walk->moved[0]);
        double square = x * (kappa[0] * x + kappa[1] * y) + y * (kappa[1] * x + kappa[2] * y);
        double product = square * limit;
        double over = 1.0 / (product > DBL_MIN ? product : 1.0);
        double slipped = (way_x * x + way_y * y - (strip->share[i] - limit) * limit) * limit * over;
        slipped = slipped > 0.0 ? slipped : 0.0;
        strip->way[0][i] = way_x - slipped * (apart * x + kappa[1] * y);
        strip->way[1][i] = way_y - slipped * (kappa[1] * x - apart * y);
        strip->at[0][i] = x * square * over;
        strip->at[1][i] = y * square * over;
    }
}

/* Beyond this ratio the force has the direction of the way, whatever it was. */
static const double FOLLOWS = 1e6;

EACH_CELL void find_ratios(struct strip *strip)
{
    for (size_t i = whole(strip->slips); i < whole(strip->sticks); i++) {
        double x = strip->way[0][i], y = strip->way[1][i];
        double size = sqrt(x * x + y * y);
        double limit = 0.5 * (strip->limit[i] + strip->share[i]);
        double product = size * limit;
        double over = product > DBL_MIN ? 1.0 / product : 0.0;
        double ratio = size * size * over;
        strip->along[0][i] = x * limit * over;
        strip->along[1][i] = y * limit * over;
        strip->ratio[i] = ratio < FOLLOWS ? ratio : FOLLOWS;
    }
}

/* The forces at the end of the slip, and the slopes across them.
 *
 * A force turns towards a straight way by tan(angle/2) = exp(-a) of it before, a the ratio: from
 * the direction n it ends along 2 (1 + q) n + q (2 + (1 + c) q) way, of size 2 + (1 + c) q (2 + q),
 * with n and the way unit, c their cosine, q = exp(a) - 1 to fourth order. On a way that turns by
 * `turn` it ends further round, by turn ((1 + exp(-a))/2 - (1 - exp(-a))/a): half of it where the
 * force follows the slip, all but none where it hardly slips (a^2/12 and 1/2 - 1/a at the ends);
 * half of that is the tangent of half the angle here. */
EACH_CELL void turn_forces(const struct walk *walk, struct strip *strip)
{
    for (size_t i = whole(strip->slips); i < whole(strip->sticks); i++) {
        const double at[2] = {strip->at[0][i], strip->at[1][i]};
        const double way[2] = {strip->along[0][i], strip->along[1][i]};
        double a = strip->ratio[i];
        double cosine = at[0] * way[0] + at[1] * way[1];
        double q = a * (1.0 + a * (1.0 / 2.0 + a * (1.0 / 6.0 + a * (1.0 / 24.0))));
        double more = (1.0 + cosine) * q;
        double keep = 2.0 + 2.0 * q, follow = q * (2.0 + more), size = 2.0 + more * (2.0 + q);
        double from_x = keep * at[0] + follow * way[0], from_y = keep * at[1] + follow * way[1];
        double by = 0.25 * strip->left[i] * walk->turn * a * a, whole = a * a + 2.0 * a + 6.0;
        double with = whole * whole - by * by, across = 2.0 * whole * by;
        size *= whole * whole + by * by;
        double kept = 1.0 / ((1.0 + a) * size);
        double over = (1.0 + a) * kept;
        double to_x = over * (with * from_x - across * from_y);
        double to_y = over * (with * from_y + across * from_x);
        /* unit but for rounding */
        double square = to_x * to_x + to_y * to_y, unit = 1.5 - 0.5 * square;
        to_x *= unit;
        to_y *= unit;
        double turning = strip->stiffness[i] * size * kept;
        bool slips = strip->excess[i] > 0.0;
        strip->turning[0][i] = slips ? turning * (1.0 - to_x * to_x) : 0.0;
        strip->turning[1][i] = slips ? turning * (1.0 - to_y * to_y) : 0.0;
        strip->turning[2][i] = slips ? -turning * to_x * to_y : 0.0;
        strip->along[0][i] = strip->share[i] * to_x;
        strip->along[1][i] = strip->share[i] * to_y;
    }
}

/* What the slips lost: what elastic displacements lack of the way times the mean of the forces at
 * the limits. */
EACH_CELL void lose(const double over[3], const struct walk *walk, const double *x, const double *y,
                    struct strip *strip)
{
    const double o[3] = {0.5 * over[0], 0.5 * over[1], 0.5 * over[2]};
    for (size_t i = whole(strip->slips); i < whole(strip->sticks); i++) {
        double next_x = strip->along[0][i], next_y = strip->along[1][i];
        double moved_x = walk->moved[0] + strip->before[i] * x[i] - strip->after[i] * next_x;
        double moved_y = walk->moved[1] + strip->before[i] * y[i] - strip->after[i] * next_y;
        double sum_x = strip->x[i] + next_x, sum_y = strip->y[i] + next_y;
        double lost =
            sum_x * (o[0] * moved_x + o[1] * moved_y) + sum_y * (o[1] * moved_x + o[2] * moved_y);
        strip->lost[i] = strip->excess[i] > 0.0 && lost > 0.0 ? lost : 0.0;
    }
}

/* The forces at the end of the way of all cells. */
EACH_CELL void take_ends(const struct walk *walk, size_t n, double *x, double *y,
                         struct strip *strip)
{
    for (size_t i = whole(strip->slips); i < whole(strip->sticks); i++) {
        bool slips = strip->excess[i] > 0.0;
        double to_x = x[i] + strip->stiffness[i] * walk->moved[0];
        double to_y = y[i] + strip->stiffness[i] * walk->moved[1];
        x[i] = slips ? strip->along[0][i] : to_x;
        y[i] = slips ? strip->along[1][i] : to_y;
        strip->stiffness[i] = slips ? 0.0 : strip->stiffness[i];
    }
    const size_t begin[2] = {0, strip->sticks}, end[2] = {strip->slips, n};
    for (int side = 0; side < 2; side++)
        for (size_t i = begin[side]; i < end[side]; i++) {
            x[i] += strip->stiffness[i] * walk->moved[0];
            y[i] += strip->stiffness[i] * walk->moved[1];
        }
}

/* Not 0: its inverse is a number. */
static double size_of(const double v[2])
{
    return sqrt(larger(v[0] * v[0] + v[1] * v[1], DBL_MIN));
}

/* A cell that has just begun to touch has no direction yet: that of its way, in two rounds, each of
 * which leaves its part of kappa's anisotropy. */
static void begin_from_rest(const double kappa[3], const struct walk *walk, size_t i,
                            struct strip *strip)
{
    double apart = 0.5 * (kappa[0] - kappa[2]), stiffness = strip->stiffness[i];
    const double way[2] = {stiffness * walk->moved[0], stiffness * walk->moved[1]};
    double turned[2] = {way[0], way[1]};
    for (int round = 0; round < 2; round++) {
        double over = 1.0 / size_of(turned);
        double x = turned[0] * over, y = turned[1] * over;
        double slipped = (way[0] * x + way[1] * y - strip->share[i]) /
                         (x * (kappa[0] * x + kappa[1] * y) + y * (kappa[1] * x + kappa[2] * y));
        slipped = slipped > 0.0 ? slipped : 0.0;
        turned[0] = way[0] - slipped * (apart * x + kappa[1] * y);
        turned[1] = way[1] - slipped * (kappa[1] * x - apart * y);
    }
    double over = 1.0 / size_of(turned);
    for (int j = 0; j < 2; j++) {
        strip->way[j][i] = turned[j];
        strip->at[j][i] = turned[j] * over;
    }
}

/* Cells of a history in the plane; those from `closed` on open or close on the way. */
VECTOR_CLONES static void walk_plane(const struct friction *friction, size_t closed, size_t n,
                                     const double *from, double *x, double *y, struct strip *strip,
                                     struct walk *walk)
{
    /* copies that no store into the cells can change */
    const struct walk way = {.moved = {walk->moved[0], walk->moved[1]}, .turn = walk->turn};
    const double kappa[3] = {friction->ratio[0], friction->ratio[1], friction->ratio[2]};
    const double *of = friction->over_ratio, over[3] = {of[0], of[1], of[2]};
    try_to_stick(&way, n, x, y, strip);
    if (strip->slips < strip->sticks) {
        size_t edge = closed > strip->slips ? closed : strip->slips;
        find_begins(&way, edge < strip->sticks ? edge : strip->sticks, from, x, y, strip);
        begin_slip(&way, strip->begins, strip->begun, from, x, y, strip);
        begin_slip(&way, edge, strip->sticks, from, x, y, strip);
        find_ways(kappa, &way, strip);
        for (size_t i = closed; i < n; i++)
            if (!(from[i] > 0.0) && strip->excess[i] > 0.0)
                begin_from_rest(kappa, &way, i, strip);
        find_ratios(strip);
        turn_forces(&way, strip);
        lose(over, &way, x, y, strip);
        size_t first = strip->slips, slipping = strip->sticks - first;
        walk->lost += sum_of(strip->lost + first, slipping);
        walk->turning[0] += sum_of(strip->turning[0] + first, slipping);
        walk->turning[1] += sum_of(strip->turning[1] + first, slipping);
        walk->turning[2] += sum_of(strip->turning[2] + first, slipping);
    }
    take_ends(&way, n, x, y, strip);
    walk->stuck += sum_of(strip->stiffness, n);
    walk->force[0] += sum_of(x, n);
    walk->force[1] += sum_of(y, n);
}

/* The same of a history along one line. */
VECTOR_CLONES static void walk_line(const struct friction *friction, size_t n, double *x,
                                    struct strip *strip, struct walk *walk)
{
    double moved = walk->moved[0];
    for (size_t i = 0; i < n; i++) {
        double share = strip->share[i];
        double trial = x[i] + strip->stiffness[i] * moved;
        double next = trial < share ? trial : share;
        next = next > -share ? next : -share;
        double slip = moved + strip->before[i] * x[i] - strip->after[i] * next;
        double before = x[i] * next > 0.0 ? x[i] : 0.0;
        double lost = (next + before) * slip;
        bool slips = next != trial;
        strip->lost[i] = slips && lost > 0.0 ? lost : 0.0;
        strip->stiffness[i] = slips ? 0.0 : strip->stiffness[i];
        x[i] = next;
    }
    walk->force[0] += sum_of(x, n);
    walk->stuck += sum_of(strip->stiffness, n);
    walk->lost += 0.5 * friction->over_ratio[0] * sum_of(strip->lost, n);
}

/* The part of a cell that opens gives up its part of the force, whose elastic energy is lost. */
static void cell_open(struct friction *friction, size_t i, double before, double after,
                      struct walk *walk)
{
    double *x = &friction->traction[0][i], *y = &friction->traction[1][i];
    double left = after / before;
    walk->lost += 0.5 * over_ratio(friction->over_ratio, *x, *y, (const double[2]){*x, *y}) *
                  (1.0 - left) / before;
    *x *= left;
    *y *= left;
}

/* A way leaves the line by an elastic force across it that is more than rounding of the limit. */
static bool stays_on_line(const struct friction *friction, const struct friction_normal *to,
                          const struct walk *walk)
{
    return friction->line &&
           fabs(walk->moved[1]) * to->slope <= STRAIGHT * larger(to->force, friction->at.force);
}

/* A way shorter than this share of the indentation has the stiffness of its end: differences of
 * shares over it would lose digits. */
static const double SHORT = 1e-6;

/* The ends of a walk's way >= 0, and whether the branch has moved between them. */
struct span {
    struct friction_normal from, to;
    bool yielded, is_short;
};

/* Cell `first + i`, which opens or closes: on one branch a share is the integral of its stiffness,
 * which gives the mean over the way. */
static void set_edge(struct friction *friction, const struct span *span, size_t first, size_t i,
                     struct strip *strip, struct walk *walk)
{
    size_t cell = first + i;
    double before = cell_stiffness(friction, cell, &span->from);
    double after = cell_stiffness(friction, cell, &span->to);
    double share = cell_share(friction, cell, &span->to);
    double mean = span->yielded    ? 0.5 * (before + after)
                  : span->is_short ? after
                                   : (share - friction->share[cell]) /
                                         (span->to.indentation - span->from.indentation);
    if (after < before)
        cell_open(friction, cell, before, after, walk);
    before = smaller(before, after);
    strip->share[i] = share;
    strip->stiffness[i] = share > 0.0 ? mean : 0.0;
    strip->before[i] = before > 0.0 ? 1.0 / before : 0.0;
    strip->after[i] = after > 0.0 ? 1.0 / after : 0.0;
}

/* Cells from `first` on: those that are closed throughout, before and after, then the others, then
 * none up to whole lanes. */
static void fill_strip(struct friction *friction, const struct span *span, size_t first,
                       size_t closed, size_t n, struct strip *strip, struct walk *walk)
{
    const double *restrict base = friction->base + first;
    const double *restrict stiffness = friction->stiffness + first;
    const double *restrict compliance = friction->compliance + first;
    for (size_t i = 0; i < closed; i++) {
        strip->share[i] = base[i] + stiffness[i] * span->to.indentation;
        strip->stiffness[i] = stiffness[i];
        strip->before[i] = strip->after[i] = compliance[i];
    }
    for (size_t i = closed; i < n; i++)
        set_edge(friction, span, first, i, strip, walk);
    for (size_t i = n; i < whole(n + LANES - 1); i++)
        strip->share[i] = strip->stiffness[i] = strip->before[i] = strip->after[i] =
            strip->excess[i] = 0.0;
}

static void walk_cells(struct friction *friction, const struct span *span, struct walk *walk)
{
    const struct friction_normal *from = &span->from, *to = &span->to;
    size_t closed = to->last < from->last ? to->last : from->last;
    size_t end = (to->last > from->last ? to->last : from->last) + 1;
    struct strip strip;
    if (end > friction->reached)
        friction->reached = end;
    friction->line = stays_on_line(friction, to, walk);
    for (size_t first = 0; first < end; first += STRIP) {
        double *share = friction->share + first;
        double *x = friction->traction[0] + first, *y = friction->traction[1] + first;
        size_t n = end - first < STRIP ? end - first : STRIP;
        size_t before = closed < first ? 0 : closed - first < n ? closed - first : n;
        fill_strip(friction, span, first, before, n, &strip, walk);
        if (friction->line)
            walk_line(friction, n, x, &strip, walk);
        else
            walk_plane(friction, before, n, share, x, y, &strip, walk);
        memcpy(share, strip.share, n * sizeof *share);
    }
}

/* The direction of the first way from the touch, where the stiffness is the same in all: cells that
 * go on along it are on a line. */
static void set_axis(struct friction *friction, const double moved[2])
{
    double size = sqrt(moved[0] * moved[0] + moved[1] * moved[1]);
    friction->axis[0] = size > 0.0 && friction->isotropic ? moved[0] / size : 1.0;
    friction->axis[1] = size > 0.0 && friction->isotropic ? moved[1] / size : 0.0;
}

/* From the tangents to the axis and the direction across it. */
static void to_axis(const struct friction *friction, const double of[2], double at[2])
{
    const double *axis = friction->axis;
    at[0] = axis[0] * of[0] + axis[1] * of[1];
    at[1] = axis[0] * of[1] - axis[1] * of[0];
}

/* Times the coefficient, and back. */
static void from_axis(const struct friction *friction, const double at[2], double force[2])
{
    const double *axis = friction->axis;
    force[0] = friction->coefficient * (axis[0] * at[0] - axis[1] * at[1]);
    force[1] = friction->coefficient * (axis[1] * at[0] + axis[0] * at[1]);
}

/* The slopes of the force by the displacement. */
static void find_slopes(struct friction *friction, const struct walk *walk)
{
    const double *kappa = friction->ratio, *axis = friction->axis;
    const double *turning = walk->turning;
    double first = axis[0] * axis[0], second = axis[1] * axis[1], both = axis[0] * axis[1];
    double x = first * turning[0] + second * turning[1] - 2.0 * both * turning[2];
    double y = second * turning[0] + first * turning[1] + 2.0 * both * turning[2];
    double between = both * (turning[0] - turning[1]) + (first - second) * turning[2];
    friction->stuck = walk->stuck;
    friction->resists[0] = kappa[0] * (walk->stuck + x);
    friction->resists[1] = kappa[2] * (walk->stuck + y);
    friction->resists[2] = kappa[1] * walk->stuck + 0.5 * (kappa[0] + kappa[2]) * between;
}

/* The angle by which a way turns between its ends, of which the chord has the direction of its
 * middle: twice that to the rate at its end, in the plane where kappa is in both. By its sine,
 * which fades out to a right angle: a way that turns back is its chord. */
static double turn_of(const double moved[2], const double rate[2])
{
    double squares =
        (moved[0] * moved[0] + moved[1] * moved[1]) * (rate[0] * rate[0] + rate[1] * rate[1]);
    double with = moved[0] * rate[0] + moved[1] * rate[1];
    double across = moved[0] * rate[1] - moved[1] * rate[0];
    return with > 0.0 && squares > 0.0 ? 2.0 * across * with / squares : 0.0;
}

/* Between a way's curve and its chord, of indentation and displacement: the integral of d du along
 * both. `rates`: at the end of the way times its time, of the indentation and the displacement. */
static void find_area(double deeper, const double moved[2], double deepens, const double moves[2],
                      double area[2])
{
    for (int j = 0; j < 2; j++)
        area[j] = (deeper * moves[j] - deepens * moved[j]) / 6.0;
}

/* Where a contact slides throughout it loses by its limit, of which the cells take the mean of the
 * ends along the chord (walk_plane, walk_line). What is missing: the way curves; cells that close
 * on it grow with the square of what is left, so that their mean is a third and not the half; and
 * what opens on it gives up its elastic energy alone (cell_open), not this third. Their force at
 * the end where all are closed is half of the law's change of slope times the way. */
static void correct_loss(const struct friction *friction, const struct span *span,
                         const double area[2], struct walk *walk)
{
    double x = walk->force[0], y = walk->force[1], size = sqrt(x * x + y * y);
    if (span->yielded || walk->stuck > 0.0 || !(size > 0.0))
        return;
    double deeper = span->to.indentation - span->from.indentation;
    double force = 0.5 * (span->to.slope - span->from.slope) * deeper;
    double missing = deeper > 0.0 ? -force / 6.0 : force / 3.0;
    const double by[2] = {span->to.slope * area[0] + missing * walk->moved[0],
                          span->to.slope * area[1] + missing * walk->moved[1]};
    walk->lost = larger(walk->lost + over_ratio(friction->over_ratio, x, y, by) / size, 0.0);
}

void friction_walk(struct friction *friction, double indentation, const double displacement[2],
                   double force[2])
{
    friction_walk_curved(friction, indentation, displacement, NULL, force);
}

void friction_walk_curved(struct friction *friction, double indentation,
                          const double displacement[2], const double *rate, double force[2])
{
    double before = friction->indentation;
    /* the part of the way with a contact */
    double part = 1.0;
    if (before < 0.0 && indentation > 0.0)
        part = indentation / (indentation - before);
    else if (before > 0.0 && indentation < 0.0)
        part = before / (before - indentation);
    struct walk walk = {.lost = 0.0};
    const double *kappa = friction->ratio;
    double scale = part / friction->coefficient;
    double x = scale * (displacement[0] - friction->displacement[0]);
    double y = scale * (displacement[1] - friction->displacement[1]);
    const double moved[2] = {kappa[0] * x + kappa[1] * y, kappa[1] * x + kappa[2] * y};
    if (friction->reached == 0)
        set_axis(friction, moved);
    to_axis(friction, moved, walk.moved);
    double area[2] = {0.0, 0.0};
    if (rate) {
        const double with[2] = {scale * (kappa[0] * rate[1] + kappa[1] * rate[2]),
                                scale * (kappa[1] * rate[1] + kappa[2] * rate[2])};
        double heading[2];
        to_axis(friction, with, heading);
        walk.turn = part * turn_of(walk.moved, heading);
        if (part == 1.0)
            find_area(indentation - before, walk.moved, rate[0], heading, area);
    }
    if (before > 0.0 || indentation > 0.0) {
        struct span span = {.from = friction->at};
        span.yielded = friction->spacing > 0.0 && follow_branch(friction, indentation);
        span.to = normal_at(friction, indentation);
        double way = fabs(span.to.indentation - span.from.indentation);
        span.is_short = !(way > SHORT * larger(span.to.indentation, span.from.indentation));
        walk_cells(friction, &span, &walk);
        friction->at = span.to;
        correct_loss(friction, &span, area, &walk);
    }
    friction->indentation = indentation;
    find_slopes(friction, &walk);
    friction->lost += friction->coefficient * friction->coefficient * walk.lost;
    friction->displacement[0] = displacement[0];
    friction->displacement[1] = displacement[1];
    from_axis(friction, walk.force, force);
}

void friction_force(const struct friction *friction, double force[2])
{
    double sum[2] = {0.0, 0.0};
    for (int j = 0; j < 2; j++)
        for (size_t i = 0; i < friction->reached; i++)
            sum[j] += friction->traction[j][i];
    from_axis(friction, sum, force);
}

double friction_stored(const struct friction *friction)
{
    double sum = 0.0;
    for (size_t i = 0; friction->at.indentation > 0.0 && i <= friction->at.last; i++) {
        double stiffness = cell_stiffness(friction, i, &friction->at);
        const double force[2] = {friction->traction[0][i], friction->traction[1][i]};
        if (stiffness > 0.0)
            sum += over_ratio(friction->over_ratio, force[0], force[1], force) / (2.0 * stiffness);
    }
    return sum * friction->coefficient * friction->coefficient;
}
