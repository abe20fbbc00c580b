/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact/friction.h"

#include <math.h>
#include <string.h>

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

bool friction_create(struct friction *friction, double coefficient, const double ratio[2],
                     size_t count, struct arena *arena)
{
    *friction = (struct friction){
        .coefficient = coefficient,
        .ratio = {ratio[0], ratio[1]},
        .count = count,
        .edge = arena_take(arena, count, sizeof *friction->edge),
        .force = arena_take(arena, count, sizeof *friction->force),
        .slope = arena_take(arena, count, sizeof *friction->slope),
        .share = arena_take(arena, count, sizeof *friction->share),
        .traction = arena_take(arena, count, sizeof *friction->traction),
    };
    return friction->edge && friction->force && friction->slope && friction->share &&
           friction->traction;
}

void friction_touch(struct friction *friction, const struct contact_law *law, double depth)
{
    size_t n = friction->count;
    friction->law = law;
    friction->indentation = 0.0;
    friction->displacement[0] = friction->displacement[1] = 0.0;
    for (size_t i = 0; i < n; i++) {
        double part = (double)i / (double)n;
        friction->edge[i] = depth * part * part;
        friction->force[i] = contact_law_force(law, friction->edge[i], &friction->slope[i]);
    }
    memset(friction->share, 0, n * sizeof *friction->share);
    memset(friction->traction, 0, n * sizeof *friction->traction);
}

/* The normal law at an indentation. */
struct normal {
    double indentation, force, slope;
};

/* The normal force that a cell bears, and its stiffness over kappa. */
static double cell_share(const struct friction *friction, size_t i, const struct normal *at,
                         double *stiffness)
{
    double below = at->indentation - friction->edge[i];
    bool whole = i + 1 < friction->count && at->indentation >= friction->edge[i + 1];
    *stiffness = 0.0;
    if (!(below > 0.0))
        return 0.0;
    if (!whole) {
        *stiffness = at->slope - friction->slope[i];
        return at->force - friction->force[i] - below * friction->slope[i];
    }
    /* the cell is closed throughout: its share is linear */
    double width = friction->edge[i + 1] - friction->edge[i];
    *stiffness = friction->slope[i + 1] - friction->slope[i];
    return friction->force[i + 1] - friction->force[i] - width * friction->slope[i] +
           (below - width) * *stiffness;
}

/* One cell from its share before to `share`: sticks, or slips at its limit. `moved`: the way of the
 * displacement times kappa over mu; `stiffness`: mean over the way. Adds its loss over mu^2. */
static void cell_walk(struct friction *friction, size_t i, double share, double stiffness,
                      const double moved[2])
{
    double *g = friction->traction[i];
    const double trial[2] = {g[0] + stiffness * moved[0], g[1] + stiffness * moved[1]};
    double size = hypot(trial[0], trial[1]);
    friction->share[i] = share;
    if (!(size > share)) {
        memcpy(g, trial, sizeof trial);
        return;
    }
    /* along the direction of the trial force; forces before and after count by halves */
    const double along[2] = {trial[0] / size, trial[1] / size};
    double before = fmax(g[0] * along[0] + g[1] * along[1], 0.0);
    double slip = stiffness > 0.0 ? (size - share) / stiffness : 0.0;
    double compliance =
        along[0] * along[0] / friction->ratio[0] + along[1] * along[1] / friction->ratio[1];
    friction->lost +=
        0.5 * (share + before) * slip * compliance * friction->coefficient * friction->coefficient;
    for (int j = 0; j < 2; j++)
        g[j] = share * along[j];
}

/* A way shorter than this share of the indentation has the stiffness of its end: differences of
 * shares over it would lose digits. */
static const double SHORT = 1e-6;

void friction_walk(struct friction *friction, double indentation, const double displacement[2],
                   double force[2])
{
    double way = indentation - friction->indentation;
    struct normal at = {.indentation = indentation};
    double moved[2];
    at.force = contact_law_force(friction->law, indentation, &at.slope);
    for (int j = 0; j < 2; j++)
        moved[j] = friction->ratio[j] * (displacement[j] - friction->displacement[j]) /
                   friction->coefficient;
    double sum[2] = {0.0, 0.0};
    for (size_t i = 0; i < friction->count; i++) {
        double stiffness;
        double share = cell_share(friction, i, &at, &stiffness);
        /* a share is the integral of its stiffness: the mean over the way, also of a cell that
         * opens or closes on it */
        if (fabs(way) > SHORT * indentation)
            stiffness = (share - friction->share[i]) / way;
        if (share > 0.0 || friction->share[i] > 0.0)
            cell_walk(friction, i, share, stiffness, moved);
        sum[0] += friction->traction[i][0];
        sum[1] += friction->traction[i][1];
    }
    friction->indentation = indentation;
    for (int j = 0; j < 2; j++) {
        friction->displacement[j] = displacement[j];
        force[j] = friction->coefficient * sum[j];
    }
}

double friction_stored(const struct friction *friction)
{
    struct normal at = {.indentation = friction->indentation};
    at.force = contact_law_force(friction->law, at.indentation, &at.slope);
    double sum = 0.0;
    for (size_t i = 0; i < friction->count; i++) {
        double stiffness;
        const double *g = friction->traction[i];
        cell_share(friction, i, &at, &stiffness);
        if (stiffness > 0.0)
            sum += (g[0] * g[0] / friction->ratio[0] + g[1] * g[1] / friction->ratio[1]) /
                   (2.0 * stiffness);
    }
    return sum * friction->coefficient * friction->coefficient;
}
