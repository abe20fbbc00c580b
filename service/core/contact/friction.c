/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/friction.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
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

static bool take_history(struct friction *friction, struct arena *arena)
{
    size_t n = friction->count;
    friction->share = arena_take(arena, 3 * n, sizeof *friction->share);
    friction->traction[0] = friction->share + n;
    friction->traction[1] = friction->share + 2 * n;
    return friction->share != NULL;
}

bool friction_create(struct friction *friction, double coefficient, const double ratio[3],
                     size_t count, struct arena *arena)
{
    *friction = (struct friction){.coefficient = coefficient, .count = count};
    memcpy(friction->ratio, ratio, sizeof friction->ratio);
    friction->edge = arena_take(arena, 5 * count, sizeof *friction->edge);
    if (!friction->edge || !take_history(friction, arena))
        return false;
    friction->force = friction->edge + count;
    friction->slope = friction->edge + 2 * count;
    friction->base = friction->edge + 3 * count;
    friction->stiffness = friction->edge + 4 * count;
    return true;
}

bool friction_second(struct friction *second, const struct friction *friction, struct arena *arena)
{
    *second = *friction;
    return take_history(second, arena);
}

void friction_copy(struct friction *to, const struct friction *from)
{
    double *share = to->share;
    double *traction[2] = {to->traction[0], to->traction[1]};
    memcpy(share, from->share, 3 * from->count * sizeof *share);
    *to = *from;
    to->share = share;
    memcpy(to->traction, traction, sizeof traction);
}

void friction_touch(struct friction *friction, const struct contact_law *law, double depth)
{
    size_t n = friction->count;
    friction->law = law;
    friction->depth = depth;
    friction->indentation = friction->normal = friction->stuck = 0.0;
    friction->displacement[0] = friction->displacement[1] = 0.0;
    for (size_t i = 0; i < n; i++) {
        double part = (double)i / (double)n;
        friction->edge[i] = depth * part * part;
        friction->force[i] = contact_law_force(law, friction->edge[i], &friction->slope[i]);
    }
    for (size_t i = 0; i + 1 < n; i++) {
        double width = friction->edge[i + 1] - friction->edge[i];
        friction->stiffness[i] = friction->slope[i + 1] - friction->slope[i];
        friction->base[i] = friction->force[i + 1] - friction->force[i] -
                            width * friction->slope[i] -
                            friction->edge[i + 1] * friction->stiffness[i];
    }
    memset(friction->share, 0, 3 * n * sizeof *friction->share);
}

/* The cell that is closed in part at an indentation > 0, and those before it throughout. */
static size_t last_closed(const struct friction *friction, double indentation)
{
    size_t last = friction->count - 1;
    double place = (double)friction->count * sqrt(indentation / friction->depth);
    size_t i = place < (double)last ? (size_t)place : last;
    while (i > 0 && friction->edge[i] >= indentation)
        i--;
    while (i < last && friction->edge[i + 1] <= indentation)
        i++;
    return i;
}

/* The normal law at an indentation. */
struct normal {
    double indentation, force, slope;
    size_t last; /* cell closed in part */
};

static struct normal normal_at(const struct friction *friction, double indentation)
{
    struct normal at = {.indentation = indentation};
    if (indentation > 0.0) {
        at.force = contact_law_force(friction->law, indentation, &at.slope);
        at.last = last_closed(friction, indentation);
    }
    return at;
}

/* The normal force that a cell bears, and its stiffness over kappa. */
static double cell_share(const struct friction *friction, size_t i, const struct normal *at,
                         double *stiffness)
{
    double below = at->indentation - friction->edge[i];
    *stiffness = 0.0;
    if (!(below > 0.0))
        return 0.0;
    if (i < at->last) {
        *stiffness = friction->stiffness[i];
        return friction->base[i] + *stiffness * at->indentation;
    }
    *stiffness = at->slope - friction->slope[i];
    double share = at->force - friction->force[i] - below * friction->slope[i];
    return share > 0.0 ? share : 0.0;
}

/* x^T kappa^-1 x. */
static inline double over_ratio(const double ratio[3], double x, double y)
{
    return (ratio[2] * x * x - 2.0 * ratio[1] * x * y + ratio[0] * y * y) /
           (ratio[0] * ratio[2] - ratio[1] * ratio[1]);
}

/* A walk of the cells: the way of kappa times the displacement over mu, and sums; the loss over
 * mu^2. */
struct walk {
    double moved[2];
    double force[2], stuck, lost;
};

/* The end of a cell's way. */
struct cell_end {
    double share;
    double stiffness;     /* mean over the way */
    double before, after; /* of the part that was closed all the way, and at the end */
};

/* One cell: sticks, or slips at its limit, along the direction of the trial force. It slips by what
 * its elastic displacement lacks of the way, and loses that times the mean of the forces before and
 * after. */
static inline void cell_walk(struct friction *friction, size_t i, const struct cell_end *end,
                             struct walk *walk)
{
    double *x = &friction->traction[0][i], *y = &friction->traction[1][i];
    const double *moved = walk->moved;
    double share = end->share;
    double trial[2] = {*x + end->stiffness * moved[0], *y + end->stiffness * moved[1]};
    double square = trial[0] * trial[0] + trial[1] * trial[1];
    friction->share[i] = share;
    if (square <= share * share) {
        walk->stuck += end->stiffness;
    } else {
        double size = sqrt(square);
        double along[2] = {trial[0] / size, trial[1] / size};
        double before = *x * along[0] + *y * along[1];
        double slip = moved[0] * along[0] + moved[1] * along[1];
        slip += end->before > 0.0 ? before / end->before : 0.0;
        slip -= end->after > 0.0 ? share / end->after : 0.0;
        if (slip > 0.0)
            walk->lost += 0.5 * (share + larger(before, 0.0)) * slip *
                          over_ratio(friction->ratio, along[0], along[1]);
        trial[0] = share * along[0];
        trial[1] = share * along[1];
    }
    *x = trial[0];
    *y = trial[1];
    walk->force[0] += trial[0];
    walk->force[1] += trial[1];
}

/* The part of a cell that opens gives up its part of the force, whose elastic energy is lost. */
static void cell_open(struct friction *friction, size_t i, double before, double after,
                      struct walk *walk)
{
    double *x = &friction->traction[0][i], *y = &friction->traction[1][i];
    double left = after / before;
    walk->lost += 0.5 * over_ratio(friction->ratio, *x, *y) * (1.0 - left) / before;
    *x *= left;
    *y *= left;
}

/* A way shorter than this share of the indentation has the stiffness of its end: differences of
 * shares over it would lose digits. */
static const double SHORT = 1e-6;

/* From one indentation >= 0 to another. */
static void walk_cells(struct friction *friction, const struct normal *from,
                       const struct normal *to, struct walk *walk)
{
    double way = to->indentation - from->indentation;
    bool is_short = !(fabs(way) > SHORT * larger(to->indentation, from->indentation));
    size_t first = to->last < from->last ? to->last : from->last;
    size_t last = to->last > from->last ? to->last : from->last;
    /* closed throughout, before and after */
    for (size_t i = 0; i < first; i++) {
        double stiffness = friction->stiffness[i];
        const struct cell_end end = {friction->base[i] + stiffness * to->indentation, stiffness,
                                     stiffness, stiffness};
        cell_walk(friction, i, &end, walk);
    }
    /* those that open or close: a share is the integral of its stiffness, which gives the mean over
     * the way */
    for (size_t i = first; i <= last; i++) {
        double before;
        struct cell_end end;
        cell_share(friction, i, from, &before);
        end.share = cell_share(friction, i, to, &end.after);
        end.before = smaller(before, end.after);
        end.stiffness = is_short ? end.after : (end.share - friction->share[i]) / way;
        if (end.after < before)
            cell_open(friction, i, before, end.after, walk);
        cell_walk(friction, i, &end, walk);
    }
}

void friction_walk(struct friction *friction, double indentation, const double displacement[2],
                   double force[2])
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
    walk.moved[0] = kappa[0] * x + kappa[1] * y;
    walk.moved[1] = kappa[1] * x + kappa[2] * y;
    if (before > 0.0 || indentation > 0.0) {
        const struct normal from = normal_at(friction, larger(before, 0.0));
        const struct normal to = normal_at(friction, larger(indentation, 0.0));
        walk_cells(friction, &from, &to, &walk);
        friction->normal = to.force;
    }
    friction->indentation = indentation;
    friction->stuck = walk.stuck;
    friction->lost += friction->coefficient * friction->coefficient * walk.lost;
    for (int j = 0; j < 2; j++) {
        friction->displacement[j] = displacement[j];
        force[j] = friction->coefficient * walk.force[j];
    }
}

void friction_force(const struct friction *friction, double force[2])
{
    for (int j = 0; j < 2; j++) {
        double sum = 0.0;
        for (size_t i = 0; i < friction->count; i++)
            sum += friction->traction[j][i];
        force[j] = friction->coefficient * sum;
    }
}

double friction_stored(const struct friction *friction)
{
    const struct normal at = normal_at(friction, friction->indentation);
    double sum = 0.0;
    for (size_t i = 0; at.indentation > 0.0 && i <= at.last; i++) {
        double stiffness;
        double x = friction->traction[0][i], y = friction->traction[1][i];
        cell_share(friction, i, &at, &stiffness);
        if (stiffness > 0.0)
            sum += over_ratio(friction->ratio, x, y) / (2.0 * stiffness);
    }
    return sum * friction->coefficient * friction->coefficient;
}
