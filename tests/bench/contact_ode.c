/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "contact_ode.h"

#include <math.h>
#include <string.h>

#include "base/vector_clones.h"
#include "impact/impact_scale.h"
#include "impact/kernel.h"

/* Four numbers at any address; compiled twice like the library's own kernels. */
typedef double lanes __attribute__((vector_size(LANES * sizeof(double)), aligned(8)));
#define AT(array, k)  (*(const lanes *)((array) + (k)))
#define PUT(array, k) (*(lanes *)((array) + (k)))

bool contact_ode_create(struct contact_ode *ode, const struct scene *scene, struct arena *arena)
{
    size_t count = 1;
    for (size_t g = 0; g < scene->groups; g++) {
        if (scene->group[g].set->most_damping != 0.0)
            return false;
        count += scene->group[g].count;
    }
    if (scene->contacts != 1 || scene->gap_acceleration[0] != 0.0)
        return false;
    size_t stride = (count + LANES - 1) / LANES * LANES;
    *ode = (struct contact_ode){.scene = scene, .count = count, .stride = stride};
    ode->square = arena_take(arena, stride, sizeof(double));
    ode->push = arena_take(arena, stride, sizeof(double));
    ode->omega = arena_take(arena, stride, sizeof(double));
    if (!ode->square || !ode->push || !ode->omega)
        return false;
    ode->push[0] = scene->w[0];
    size_t at = 1;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        for (size_t k = 0; k < group->count; k++, at++) {
            double phi = group->participation[0][k];
            ode->omega[at] = group->set->omega[k];
            ode->square[at] = ode->omega[at] * ode->omega[at];
            ode->push[at] = phi * phi;
        }
    }
    ode->stiffness = scene->laws[0].parameters[0];
    ode->residual = scene->residual[0];
    ode->speed = fabs(scene->gap_rate[0]);
    ode->magnitude = impact_scale_of(scene, 0, ode->speed).indentation;
    return true;
}

/* With s the root of the local indentation: s^2 + (residual stiffness) s^3 = approach. The left
 * side is convex for s > 0, so Newton's method from above never overshoots. */
double contact_ode_force(struct contact_ode *ode, double approach)
{
    ode->tangent = 0.0;
    if (!(approach > 0.0))
        return 0.0;
    double c = ode->residual * ode->stiffness;
    double s = sqrt(approach);
    for (int i = 0; i < 8 && c > 0.0; i++) {
        double step = (s * s * (1.0 + c * s) - approach) / (s * (2.0 + 3.0 * c * s));
        s -= step;
        if (fabs(step) <= 1e-9 * s) /* the next one is its square */
            break;
    }
    double slope = 1.5 * ode->stiffness * s;
    ode->tangent = slope / (1.0 + ode->residual * slope);
    return ode->stiffness * s * s * s;
}

VECTOR_CLONES static double sum(size_t stride, const double *z)
{
    lanes even = {0}, odd = {0};
    size_t k = 0;
    for (; k + 2 * LANES <= stride; k += 2 * LANES) {
        even += AT(z, k);
        odd += AT(z, k + LANES);
    }
    if (k < stride)
        even += AT(z, k);
    even += odd;
    return (even[0] + even[1]) + (even[2] + even[3]);
}

VECTOR_CLONES static void accelerate(const struct contact_ode *ode, double force, const double *z,
                                     double *rate)
{
    const double *square = ode->square;
    const double *push = ode->push;
    for (size_t k = 0; k < ode->stride; k += LANES)
        PUT(rate, k) = -AT(square, k) * AT(z, k) - AT(push, k) * force;
}

double contact_ode_approach(const struct contact_ode *ode, const double *z)
{
    return sum(ode->stride, z);
}

void contact_ode_rate(struct contact_ode *ode, const double *y, double *rate)
{
    double force = contact_ode_force(ode, sum(ode->stride, y));
    memcpy(rate, y + ode->stride, ode->stride * sizeof *y);
    accelerate(ode, force, y, rate + ode->stride);
}

void contact_ode_newton(const struct contact_ode *ode, double gamma, double *x)
{
    double *z = x;
    double *v = x + ode->stride;
    double square = gamma * gamma;
    double held = 0.0; /* 1^T D^-1 (b_z + gamma b_v) */
    double felt = 0.0; /* 1^T D^-1 push */
    for (size_t k = 0; k < ode->stride; k++) {
        double inverse = 1.0 / (1.0 + square * ode->square[k]);
        z[k] = (z[k] + gamma * v[k]) * inverse;
        held += z[k];
        felt += ode->push[k] * inverse;
    }
    double total = held / (1.0 + square * ode->tangent * felt);
    double force = ode->tangent * total;
    for (size_t k = 0; k < ode->stride; k++) {
        z[k] -= square * force * ode->push[k] / (1.0 + square * ode->square[k]);
        v[k] -= gamma * (ode->square[k] * z[k] + ode->push[k] * force);
    }
}

void contact_ode_weights(const struct contact_ode *ode, double tolerance, bool energetic,
                         double *absolute)
{
    for (size_t k = 0; k < ode->stride; k++) {
        double share = tolerance;
        double length = tolerance * ode->magnitude;
        if (energetic && k && k < ode->count && ode->push[k] > 0.0) {
            share = tolerance * sqrt(ode->push[k] / ode->push[0]);
            length = share * ode->speed / ode->omega[k];
        }
        absolute[k] = length;
        absolute[ode->stride + k] = share * ode->speed;
    }
}

bool contact_ode_complete(const struct contact_ode *ode, const double *y)
{
    const double *v = y + ode->stride;
    double reach = y[0];
    for (size_t k = 1; k < ode->count; k++)
        reach += hypot(y[k], v[k] / ode->omega[k]);
    return reach < 0.0 && v[0] < 0.0;
}

void contact_ode_pack(const struct contact_ode *ode, const struct motion *motion, double *y)
{
    size_t stride = ode->stride;
    memset(y, 0, 2 * stride * sizeof *y);
    y[0] = -motion->gap[0];
    y[stride] = -motion->gap_rate[0];
    size_t at = 1;
    for (size_t g = 0; g < ode->scene->groups; g++) {
        const struct scene_group *group = &ode->scene->group[g];
        for (size_t k = 0; k < group->count; k++, at++) {
            y[at] = -group->participation[0][k] * motion->q[g][k];
            y[stride + at] = -group->participation[0][k] * motion->v[g][k];
        }
    }
}

void contact_ode_unpack(const struct contact_ode *ode, const double *y, struct motion *motion)
{
    size_t stride = ode->stride;
    motion->gap[0] = -y[0];
    motion->gap_rate[0] = -y[stride];
    size_t at = 1;
    for (size_t g = 0; g < ode->scene->groups; g++) {
        const struct scene_group *group = &ode->scene->group[g];
        for (size_t k = 0; k < group->count; k++, at++) {
            double phi = group->participation[0][k];
            motion->q[g][k] = phi != 0.0 ? -y[at] / phi : 0.0;
            motion->v[g][k] = phi != 0.0 ? -y[stride + at] / phi : 0.0;
        }
    }
}
