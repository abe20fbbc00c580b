/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/beam.h"

#include <math.h>

/* Here s = x/length in [-1/2, 1/2], lengths count in `length`, forces in the unit force, moments
 * accordingly; EI = 1 and compliances count in length^3/EI. The tighter support is on the left. */
struct statics {
    double inertia, shear; /* rhoI/(rhoA L^2), EI/(kGA L^2) */
    enum support supports[2];
};

/* Shear V and moment M in equilibrium with a load: V' + force density = 0 and
 * M' + V + moment density = 0, both integrated from the right end. */
struct field {
    double s, force, moment; /* the load */
    double shift, rotation;  /* acceleration w'' = shift + rotation s of the beam as a rigid body */
    double end_force, end_moment; /* the right support's reaction */
};

static double shear_at(const struct field *field, double s)
{
    double below = s < field->s ? 1.0 : 0.0;

    return below * field->force + field->end_force - field->shift * (0.5 - s) -
           0.5 * field->rotation * (0.5 - s) * (0.5 + s);
}

static double moment_at(const struct field *field, double inertia, double s)
{
    double below = s < field->s ? 1.0 : 0.0;
    double rest = 0.5 - s;

    return below * (field->force * (field->s - s) + field->moment) + field->end_moment +
           field->end_force * rest - 0.5 * field->shift * rest * rest -
           field->rotation * rest * (rest * (1.0 + s) / 6.0 + inertia);
}

/* Complementary energy of two fields over a part where both are cubic at most: four Gauss points
 * (Abramowitz & Stegun 25.4.30) are exact for the product's degree of six. */
static double energy_between(const struct statics *statics, const struct field *i,
                             const struct field *j, double from, double to)
{
    static const double node[2] = {0.33998104358485626480, 0.86113631159405257522};
    static const double weight[2] = {0.65214515486254614263, 0.34785484513745385737};
    double centre = 0.5 * (from + to), half = 0.5 * (to - from), sum = 0.0;

    if (!(half > 0.0))
        return 0.0;
    for (int k = 0; k < 4; k++) {
        double s = centre + (k % 2 ? half : -half) * node[k / 2];
        sum +=
            weight[k / 2] * (statics->shear * shear_at(i, s) * shear_at(j, s) +
                             moment_at(i, statics->inertia, s) * moment_at(j, statics->inertia, s));
    }
    return half * sum;
}

static double energy(const struct statics *statics, const struct field *i, const struct field *j)
{
    double first = fmin(i->s, j->s), last = fmax(i->s, j->s);

    return energy_between(statics, i, j, -0.5, first) + energy_between(statics, i, j, first, last) +
           energy_between(statics, i, j, last, 0.5);
}

/* The accelerations of the rigid motions that the supports allow take up the load (d'Alembert). */
static void balance_by_inertia(const struct statics *statics, struct field *field)
{
    double inertia = statics->inertia;

    if (statics->supports[0] == SUPPORT_FREE) {
        field->shift = field->force;
        field->rotation = (field->force * field->s + field->moment) / (1.0 / 12.0 + inertia);
    } else if (statics->supports[0] == SUPPORT_PINNED) {
        field->rotation = (field->force * (field->s + 0.5) + field->moment) / (1.0 / 3.0 + inertia);
        field->shift = 0.5 * field->rotation;
    }
}

/* The right support's reaction: from the moment about a pin on the left; on a beam clamped on the
 * left each redundant state of self-stress gets the share that makes the complementary energy least
 * (Castigliano, Menabrea). The states of two clamps, shear about the middle and pure bending, are
 * orthogonal. */
static void react(const struct statics *statics, struct field *field)
{
    struct field shear = {.end_force = 1.0}, bending = {.end_moment = 1.0};

    if (statics->supports[0] == SUPPORT_PINNED) {
        field->end_force = -(field->force * (field->s + 0.5) + field->moment);
        return;
    }
    if (statics->supports[1] == SUPPORT_CLAMPED) {
        shear.end_moment = -0.5;
        field->end_moment = -energy(statics, field, &bending);
    }
    double lever = 0.5 + shear.end_moment; /* of the state's moment, lever - s */
    double share = -energy(statics, field, &shear) / (statics->shear + 1.0 / 12.0 + lever * lever);
    field->end_force = share;
    field->end_moment += share * shear.end_moment;
}

static struct field field_of(const struct statics *statics, const struct beam_plane *plane,
                             const struct beam_load *load, bool mirrored)
{
    double sign = mirrored ? -1.0 : 1.0;
    struct field field = {
        .s = sign * load->x / plane->length,
        .force = load->force,
        .moment = sign * load->moment / plane->length,
    };

    if (statics->supports[1] != SUPPORT_FREE)
        react(statics, &field);
    else
        balance_by_inertia(statics, &field);
    return field;
}

/* A load as forces and moments at places: the mean of psi' is a difference of rotations. */
static size_t parts_of(const struct beam_plane *plane, const struct beam_load *load,
                       struct beam_load parts[3])
{
    double end = 0.5 * plane->length;
    double from = fmax(load->x - 0.5 * load->window, -end);
    double to = fmin(load->x + 0.5 * load->window, end);

    parts[0] = (struct beam_load){.x = load->x, .force = load->force, .moment = load->moment};
    if (load->curvature == 0.0)
        return 1;
    parts[1] = (struct beam_load){.x = from, .moment = -load->curvature / (to - from)};
    parts[2] = (struct beam_load){.x = to, .moment = load->curvature / (to - from)};
    return 3;
}

double beam_compliance(const struct beam_plane *plane, const struct beam_load *i,
                       const struct beam_load *j)
{
    double square = plane->length * plane->length;
    bool mirrored = plane->supports[0] < plane->supports[1];
    struct statics statics = {
        .inertia = plane->line_inertia / (plane->line_mass * square),
        .shear = plane->bending_stiffness / (plane->shear_stiffness * square),
        .supports = {plane->supports[mirrored], plane->supports[!mirrored]},
    };
    struct beam_load parts[2][3];
    struct field fields[2][3];
    size_t counts[2] = {parts_of(plane, i, parts[0]), parts_of(plane, j, parts[1])};
    double sum = 0.0;

    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < counts[side]; k++)
            fields[side][k] = field_of(&statics, plane, &parts[side][k], mirrored);
    /* of a load on itself each pair once */
    for (size_t k = 0; k < counts[0]; k++)
        for (size_t l = i == j ? k : 0; l < counts[1]; l++)
            sum += (i == j && l > k ? 2.0 : 1.0) * energy(&statics, &fields[0][k], &fields[1][l]);
    return square * plane->length / plane->bending_stiffness * sum;
}
