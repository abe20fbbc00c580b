/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/friction.h"

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
    friction->indentation = friction->normal = friction->stuck = 0.0;
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

/* The normal law at an indentation, which counts from the bottom of the branch's dent. */
struct normal {
    double indentation, force, slope;
    size_t last; /* cell closed in part */
};

static struct normal normal_on_branch(const struct friction *friction, double indentation)
{
    const struct friction_branch *branch = &friction->branch;
    double back = indentation + friction->law->history.dent - branch->dent;
    struct normal at = {.indentation = larger(smaller(back, branch->span), 0.0)};
    at.force = branch_force(branch, sqrt(at.indentation / branch->span), &at.slope);
    size_t last = friction->placed - 1;
    double place = at.slope / friction->spacing;
    at.last = place < (double)last ? (size_t)place : last;
    return at;
}

static struct normal normal_at(const struct friction *friction, double indentation)
{
    struct normal at = {.indentation = 0.0};
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
static double cell_stiffness(const struct friction *friction, size_t i, const struct normal *at)
{
    if (i < at->last)
        return friction->stiffness[i];
    return i == at->last ? larger(at->slope - friction->slope[i], 0.0) : 0.0;
}

/* The normal force that a cell bears. */
static double cell_share(const struct friction *friction, size_t i, const struct normal *at)
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
    double stuck, turning[2]; /* stiffnesses of cells that stick, and of forces that turn */
};

/* A cell's way: its force and share at the beginning, what it has at the end. */
struct cell_way {
    double x, y, from;
    double share;
    double stiffness;     /* mean over the way */
    double before, after; /* compliances of the part that was closed all the way, and at the end */
};

/* The force at the end of a cell's way; what it lost over mu^2; stiffnesses. */
struct cell_end {
    double x, y, lost;
    double stuck, turning[2]; /* of a cell that sticks, and of a force that turns */
};

/* A cell that has slipped before is at its limit: but for rounding. */
static const double AT_LIMIT = 1e-12;

/* Part of a loop over cells, which is vectorised as a whole. */
#define EACH_CELL __attribute__((always_inline)) static inline

/* Where the force of a cell reaches its limit, its share there, and the part of the way that is
 * left then: |force + part way| = from + part grown, `way` elastic. Every value is found, also
 * those that do not count, so that a loop over cells needs no branch. */
struct slip {
    double x, y, share, left;
};

EACH_CELL struct slip slip_begin(const struct cell_way *cell, const double way[2])
{
    double grown = cell->share - cell->from;
    double a = way[0] * way[0] + way[1] * way[1] - grown * grown;
    double b = cell->x * way[0] + cell->y * way[1] - cell->from * grown;
    double square = cell->from * cell->from;
    double c = cell->x * cell->x + cell->y * cell->y - square;
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
    return (struct slip){cell->x + part * way[0], cell->y + part * way[1],
                         cell->from + part * grown, 1.0 - part};
}

/* Along a contact's ellipse the slip is not along kappa times the slip: the rest turns the force
 * that has the direction of `at`, of the size `share`, as a way of its own. `grown`: of the limit.
 */
EACH_CELL void across_kappa(const double ratio[3], const double at[2], double share, double grown,
                            double way[2])
{
    double apart = 0.5 * (ratio[0] - ratio[2]);
    double x = ratio[0] * at[0] + ratio[1] * at[1], y = ratio[1] * at[0] + ratio[2] * at[1];
    double slipped = (way[0] * at[0] + way[1] * at[1] - grown * share) / (x * at[0] + y * at[1]);
    slipped = slipped > 0.0 ? slipped : 0.0;
    way[0] -= slipped * (apart * at[0] + ratio[1] * at[1]);
    way[1] -= slipped * (ratio[1] * at[0] - apart * at[1]);
}

/* The direction of the force at the end of a slip that has a share > 0 at its beginning; *left
 * becomes the share of the trial force that the limit leaves.
 *
 * A force turns towards a straight way by tan(angle/2) = exp(-a) of it before, a the elastic force
 * of the way over the limit: it ends along at + m way, both unit, with m = [(1 + c) q + (1 - c)
 * q/(1 + q)]/2, c their cosine, q = exp(a) - 1 to fourth order. On a way that turns by `turn` it
 * ends further round, by turn ((1 + exp(-a))/2 - (1 - exp(-a))/a): half of it where the force
 * follows the slip, all but none where it hardly slips (a^2/12 and 1/2 - 1/a at the ends). */
EACH_CELL void slip_direction(const double ratio[3], const struct slip *slip, double share,
                              const double elastic[2], double turn, double along[2], double *left)
{
    double limit = 0.5 * (slip->share + share);
    const double at[2] = {slip->x, slip->y};
    /* the chord of what is left of the way */
    double past = 0.5 * turn * (1.0 - slip->left);
    double way[2] = {slip->left * (elastic[0] - past * elastic[1]),
                     slip->left * (elastic[1] + past * elastic[0])};
    across_kappa(ratio, at, slip->share, share - slip->share, way);
    double size = sqrt(way[0] * way[0] + way[1] * way[1]);
    /* a = moved/kept; q times kept^4, the force times kept^8 and what else has no quotient */
    double kept = limit / (limit + size), moved = 1.0 - kept;
    double fourth = kept * kept * kept * kept;
    double q = moved / 4.0 + kept;
    q = moved / 3.0 * q + kept * kept;
    q = moved / 2.0 * q + kept * kept * kept;
    q *= moved;
    double product = slip->share * size;
    double cosine = at[0] * way[0] + at[1] * way[1]; /* times the product */
    double keep = (fourth + q) * fourth * size * size;
    double follow = q * (fourth * product + 0.5 * q * (product + cosine));
    double x = keep * at[0] + follow * way[0], y = keep * at[1] + follow * way[1];
    double by = 0.5 * slip->left * turn * moved * moved /
                (moved * moved + 2.0 * moved * kept + 6.0 * kept * kept);
    double round_x = x - by * y, round_y = y + by * x;
    double square = round_x * round_x + round_y * round_y;
    /* as if it had not turned yet: shares may fall faster than forces */
    x = square > 0.0 ? round_x : at[0];
    y = square > 0.0 ? round_y : at[1];
    square = square > 0.0 ? square : slip->share * slip->share;
    double shorter = 1.0 / sqrt(square);
    along[0] = x * shorter;
    along[1] = y * shorter;
    *left = kept;
}

/* What the slip of a cell lost: what its elastic displacement lacks of the way times the mean of
 * the forces at the limit. */
EACH_CELL double slip_lost(const double over[3], const double moved[2], const struct cell_way *cell,
                           const struct slip *slip, const double next[2])
{
    double x = moved[0] + cell->before * cell->x - cell->after * next[0];
    double y = moved[1] + cell->before * cell->y - cell->after * next[1];
    double sum_x = slip->x + next[0], sum_y = slip->y + next[1];
    double lost = 0.5 * (sum_x * (over[0] * x + over[1] * y) + sum_y * (over[1] * x + over[2] * y));
    return lost > 0.0 ? lost : 0.0;
}

/* One cell that had a share > 0: sticks, or slips at its limit. */
EACH_CELL struct cell_end cell_follow(const double ratio[3], const double over[3],
                                      const struct walk *walk, const struct cell_way *cell)
{
    const double moved[2] = {walk->moved[0], walk->moved[1]};
    double way[2] = {cell->stiffness * moved[0], cell->stiffness * moved[1]};
    double trial[2] = {cell->x + way[0], cell->y + way[1]};
    double excess = trial[0] * trial[0] + trial[1] * trial[1] - cell->share * cell->share;
    const struct slip slip = slip_begin(cell, way);
    double along[2], left;
    slip_direction(ratio, &slip, cell->share, way, walk->turn, along, &left);
    double next[2] = {cell->share * along[0], cell->share * along[1]};
    double lost = slip_lost(over, moved, cell, &slip, next);
    double turning = cell->stiffness * left;
    return (struct cell_end){
        .x = excess > 0.0 ? next[0] : trial[0],
        .y = excess > 0.0 ? next[1] : trial[1],
        .lost = excess > 0.0 ? lost : 0.0,
        .stuck = excess > 0.0 ? 0.0 : cell->stiffness,
        .turning = {excess > 0.0 ? turning * (1.0 - along[0] * along[0]) : 0.0,
                    excess > 0.0 ? turning * (1.0 - along[1] * along[1]) : 0.0},
    };
}

/* A cell that has just begun to touch has no direction yet: that of its way, in rounds, each of
 * which leaves its part of kappa's anisotropy. */
static struct cell_end cell_from_rest(const double ratio[3], const double over[3],
                                      const double moved[2], const struct cell_way *cell)
{
    const double way[2] = {cell->stiffness * moved[0], cell->stiffness * moved[1]};
    double turned[2] = {way[0], way[1]}, n[2] = {0.0, 0.0};
    double size = sqrt(way[0] * way[0] + way[1] * way[1]);
    if (size <= cell->share)
        return (struct cell_end){.x = way[0], .y = way[1], .stuck = cell->stiffness};
    for (int round = 0; round < 4 && size > 0.0; round++) {
        n[0] = turned[0] / size;
        n[1] = turned[1] / size;
        memcpy(turned, way, sizeof turned);
        across_kappa(ratio, n, 1.0, cell->share, turned);
        size = sqrt(turned[0] * turned[0] + turned[1] * turned[1]);
    }
    n[0] = size > 0.0 ? turned[0] / size : n[0];
    n[1] = size > 0.0 ? turned[1] / size : n[1];
    const struct slip slip = {.share = 0.0, .left = 1.0};
    const double next[2] = {cell->share * n[0], cell->share * n[1]};
    double limit = 0.5 * cell->share, trial = larger(size, limit);
    double turning = trial > 0.0 ? cell->stiffness * limit / trial : 0.0;
    return (struct cell_end){
        .x = next[0],
        .y = next[1],
        .lost = slip_lost(over, moved, cell, &slip, next),
        .turning = {turning * (1.0 - n[0] * n[0]), turning * (1.0 - n[1] * n[1])},
    };
}

/* A cell of a history along one line. */
static struct cell_end cell_on_line(const double over[3], double moved, const struct cell_way *cell)
{
    double trial = cell->x + cell->stiffness * moved;
    double next = larger(-cell->share, smaller(trial, cell->share));
    if (next == trial)
        return (struct cell_end){.x = next, .stuck = cell->stiffness};
    double slip = moved + cell->before * cell->x - cell->after * next;
    double force = next + (next > 0.0 ? larger(cell->x, 0.0) : smaller(cell->x, 0.0));
    return (struct cell_end){.x = next, .lost = 0.5 * over[0] * larger(force * slip, 0.0)};
}

/* A cell that opens or closes on the way. */
static void cell_walk(struct friction *friction, size_t i, const struct cell_way *cell,
                      struct walk *walk)
{
    struct cell_end end = {.x = 0.0};
    const double *ratio = friction->ratio, *over = friction->over_ratio, *moved = walk->moved;
    if (friction->line)
        end = cell_on_line(over, moved[0], cell);
    else if (cell->share > 0.0)
        end = cell->from > 0.0 ? cell_follow(ratio, over, walk, cell)
                               : cell_from_rest(ratio, over, moved, cell);
    friction->share[i] = cell->share;
    friction->traction[0][i] = end.x;
    friction->traction[1][i] = end.y;
    walk->force[0] += end.x;
    walk->force[1] += end.y;
    walk->lost += end.lost;
    walk->stuck += end.stuck;
    for (int j = 0; j < 2; j++)
        walk->turning[j] += end.turning[j];
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

/* A way shorter than this share of the indentation has the stiffness of its end: differences of
 * shares over it would lose digits. */
static const double SHORT = 1e-6;

/* Sums in the same order for any vectors. */
enum { SUMS = 4 };

static double sum_of(const double *values, size_t count)
{
    double sum[SUMS] = {0.0};
    size_t i = 0;
    for (; i + SUMS <= count; i += SUMS)
        for (size_t k = 0; k < SUMS; k++)
            sum[k] += values[i + k];
    for (; i < count; i++)
        sum[0] += values[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Cells at a time of walk_line. */
enum { STRIP = 64 };

/* Cells that are closed throughout, before and after, of a history along one line: as cell_walk. */
VECTOR_CLONES static void walk_line(struct friction *friction, size_t count, double indentation,
                                    struct walk *walk)
{
    double moved = walk->moved[0];
    for (size_t first = 0; first < count; first += STRIP) {
        double stuck[STRIP], lost[STRIP];
        size_t n = count - first < STRIP ? count - first : STRIP;
        const double *restrict base = friction->base + first;
        const double *restrict stiffness = friction->stiffness + first;
        const double *restrict compliance = friction->compliance + first;
        double *restrict share = friction->share + first;
        double *restrict x = friction->traction[0] + first;
        for (size_t i = 0; i < n; i++) {
            double limit = base[i] + stiffness[i] * indentation;
            double trial = x[i] + stiffness[i] * moved;
            double next = trial < limit ? trial : limit;
            next = next > -limit ? next : -limit;
            double slip = trial - next; /* times the stiffness */
            double before = x[i] * slip;
            before = before > 0.0 ? before : 0.0;
            lost[i] = (next * slip + before) * compliance[i];
            stuck[i] = slip == 0.0 ? stiffness[i] : 0.0;
            share[i] = limit;
            x[i] = next;
        }
        walk->force[0] += sum_of(x, n);
        walk->stuck += sum_of(stuck, n);
        walk->lost += 0.5 * friction->over_ratio[0] * sum_of(lost, n);
    }
}

/* The same of a history in the plane. */
VECTOR_CLONES static void walk_plane(struct friction *friction, size_t count, double indentation,
                                     struct walk *walk)
{
    const double ratio[3] = {friction->ratio[0], friction->ratio[1], friction->ratio[2]};
    const double over[3] = {friction->over_ratio[0], friction->over_ratio[1],
                            friction->over_ratio[2]};
    const struct walk way = {.moved = {walk->moved[0], walk->moved[1]}, .turn = walk->turn};
    for (size_t first = 0; first < count; first += STRIP) {
        double stuck[STRIP], lost[STRIP], turning[2][STRIP];
        size_t n = count - first < STRIP ? count - first : STRIP;
        const double *restrict base = friction->base + first;
        const double *restrict stiffness = friction->stiffness + first;
        const double *restrict compliance = friction->compliance + first;
        double *restrict share = friction->share + first;
        double *restrict x = friction->traction[0] + first;
        double *restrict y = friction->traction[1] + first;
        VECTOR_APART
        for (size_t i = 0; i < n; i++) {
            const struct cell_way cell = {
                x[i],         y[i],          share[i],     base[i] + stiffness[i] * indentation,
                stiffness[i], compliance[i], compliance[i]};
            const struct cell_end end = cell_follow(ratio, over, &way, &cell);
            share[i] = cell.share;
            x[i] = end.x;
            y[i] = end.y;
            lost[i] = end.lost;
            stuck[i] = end.stuck;
            turning[0][i] = end.turning[0];
            turning[1][i] = end.turning[1];
        }
        walk->force[0] += sum_of(x, n);
        walk->force[1] += sum_of(y, n);
        walk->lost += sum_of(lost, n);
        walk->stuck += sum_of(stuck, n);
        walk->turning[0] += sum_of(turning[0], n);
        walk->turning[1] += sum_of(turning[1], n);
    }
}

/* A way leaves the line by an elastic force across it that is more than rounding of the limit. */
static bool stays_on_line(const struct friction *friction, const struct normal *to,
                          const struct walk *walk)
{
    return friction->line &&
           fabs(walk->moved[1]) * to->slope <= STRAIGHT * larger(to->force, friction->normal);
}

/* From one indentation >= 0 to another, whether the branch has moved between them. */
static void walk_cells(struct friction *friction, const struct normal *from,
                       const struct normal *to, bool yielded, struct walk *walk)
{
    double way = to->indentation - from->indentation;
    bool is_short = !(fabs(way) > SHORT * larger(to->indentation, from->indentation));
    size_t first = to->last < from->last ? to->last : from->last;
    size_t last = to->last > from->last ? to->last : from->last;
    if (last >= friction->reached)
        friction->reached = last + 1;
    /* closed throughout, before and after */
    friction->line = stays_on_line(friction, to, walk);
    (friction->line ? walk_line : walk_plane)(friction, first, to->indentation, walk);
    /* those that open or close: on one branch a share is the integral of its stiffness, which gives
     * the mean over the way */
    for (size_t i = first; i <= last; i++) {
        double before = cell_stiffness(friction, i, from), after = cell_stiffness(friction, i, to);
        double share = cell_share(friction, i, to);
        double mean = yielded    ? 0.5 * (before + after)
                      : is_short ? after
                                 : (share - friction->share[i]) / way;
        if (after < before)
            cell_open(friction, i, before, after, walk);
        before = smaller(before, after);
        const struct cell_way cell = {friction->traction[0][i],
                                      friction->traction[1][i],
                                      friction->share[i],
                                      share,
                                      mean,
                                      before > 0.0 ? 1.0 / before : 0.0,
                                      after > 0.0 ? 1.0 / after : 0.0};
        cell_walk(friction, i, &cell, walk);
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

/* The slope of the force by the displacement along each tangent. */
static void find_slopes(struct friction *friction, const struct walk *walk)
{
    const double *kappa = friction->ratio, *axis = friction->axis;
    double first = axis[0] * axis[0], second = axis[1] * axis[1];
    friction->stuck = walk->stuck;
    friction->resists[0] =
        kappa[0] * (walk->stuck + first * walk->turning[0] + second * walk->turning[1]);
    friction->resists[1] =
        kappa[2] * (walk->stuck + second * walk->turning[0] + first * walk->turning[1]);
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
    if (rate) {
        const double with[2] = {kappa[0] * rate[0] + kappa[1] * rate[1],
                                kappa[1] * rate[0] + kappa[2] * rate[1]};
        double heading[2];
        to_axis(friction, with, heading);
        walk.turn = part * turn_of(walk.moved, heading);
    }
    if (before > 0.0 || indentation > 0.0) {
        const struct normal from = normal_at(friction, before);
        bool yielded = friction->spacing > 0.0 && follow_branch(friction, indentation);
        const struct normal to = normal_at(friction, indentation);
        walk_cells(friction, &from, &to, yielded, &walk);
        friction->normal = to.force;
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
    const struct normal at = normal_at(friction, friction->indentation);
    double sum = 0.0;
    for (size_t i = 0; at.indentation > 0.0 && i <= at.last; i++) {
        double stiffness = cell_stiffness(friction, i, &at);
        const double force[2] = {friction->traction[0][i], friction->traction[1][i]};
        if (stiffness > 0.0)
            sum += over_ratio(friction->over_ratio, force[0], force[1], force) / (2.0 * stiffness);
    }
    return sum * friction->coefficient * friction->coefficient;
}
