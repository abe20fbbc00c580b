/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/rigid.h"

#include "model/vector.h"

/* Mobility of a body as a whole: inverse mass, inverse inertia about `centre` (body frame). */
struct mobility {
    double inverse_mass;
    double inverse_inertia[3];
    double inverse_products[3]; /* yz, zx, xy of the inverse tensor */
    double centre[3];
};

/* The inverse of a symmetric tensor with products of inertia, by cofactors. */
static void invert_tensor(const struct body *body, struct mobility *mobility)
{
    const double *j = body->inertia, *p = body->products;
    double yz = p[1] * p[2] - j[0] * p[0];
    double zx = p[2] * p[0] - j[1] * p[1];
    double xy = p[0] * p[1] - j[2] * p[2];
    double xx = j[1] * j[2] - p[0] * p[0];
    double share = 1.0 / (j[0] * xx + p[2] * xy + p[1] * zx);
    const double inverse[3] = {xx, j[2] * j[0] - p[1] * p[1], j[0] * j[1] - p[2] * p[2]};
    scale3(share, inverse, mobility->inverse_inertia);
    scale3(share, (const double[3]){yz, zx, xy}, mobility->inverse_products);
}

/* turn = inverse inertia times moment. */
static void turn_by(const struct mobility *mobility, const double moment[3], double turn[3])
{
    const double *p = mobility->inverse_products;
    for (int k = 0; k < 3; k++)
        turn[k] = mobility->inverse_inertia[k] * moment[k];
    if (p[0] == 0.0 && p[1] == 0.0 && p[2] == 0.0)
        return;
    turn[0] += p[2] * moment[1] + p[1] * moment[2];
    turn[1] += p[2] * moment[0] + p[0] * moment[2];
    turn[2] += p[1] * moment[0] + p[0] * moment[1];
}

static struct mobility mobility_of(const struct body *body)
{
    struct mobility mobility = {0};
    /* held: neither turns nor moves */
    if (body->mesh && body->mesh->supported)
        return mobility;
    /* free at both ends */
    bool free[2] = {body->supports[0] == SUPPORT_FREE, body->supports[1] == SUPPORT_FREE};
    if (free[0] && free[1]) {
        mobility.inverse_mass = 1.0 / body->mass;
        for (int i = 0; i < 3; i++)
            mobility.inverse_inertia[i] = 1.0 / body->inertia[i];
        if (body->products[0] != 0.0 || body->products[1] != 0.0 || body->products[2] != 0.0)
            invert_tensor(body, &mobility);
        return mobility;
    }
    /* pinned at one: turns about that end; all else is held */
    int held = free[0] ? 1 : 0;
    if (body->supports[held] == SUPPORT_PINNED && free[1 - held]) {
        double arm = held == 0 ? -0.5 * body->span : 0.5 * body->span;
        mobility.centre[0] = arm;
        for (int i = 1; i < 3; i++)
            mobility.inverse_inertia[i] = 1.0 / (body->inertia[i] + body->mass * arm * arm);
    }
    return mobility;
}

static void moment_about(const struct mobility *mobility, const double point[3],
                         const double force[3], double moment[3])
{
    double arm[3];
    sub3(point, mobility->centre, arm);
    cross3(arm, force, moment);
}

double rigid_inverse_mass(const struct body *body, const double point_i[3],
                          const double direction_i[3], const double point_j[3],
                          const double direction_j[3])
{
    struct mobility mobility = mobility_of(body);
    double moment_i[3];
    double moment_j[3];
    moment_about(&mobility, point_i, direction_i, moment_i);
    moment_about(&mobility, point_j, direction_j, moment_j);
    double sum = mobility.inverse_mass * dot3(direction_i, direction_j);
    if (body->mesh) {
        double turn[3];
        turn_by(&mobility, moment_j, turn);
        return sum + dot3(moment_i, turn);
    }
    for (int k = 0; k < 3; k++)
        sum += mobility.inverse_inertia[k] * moment_i[k] * moment_j[k];
    return sum;
}

void rigid_apply_impulse(const struct body *body, const double point[3], const double impulse[3],
                         double velocity[3], double angular_velocity[3])
{
    struct mobility mobility = mobility_of(body);
    double moment[3];
    double turn[3];
    double to_centre_of_mass[3];
    double carried[3];
    moment_about(&mobility, point, impulse, moment);
    turn_by(&mobility, moment, turn);
    scale3(-1.0, mobility.centre, to_centre_of_mass);
    cross3(turn, to_centre_of_mass, carried);
    for (int k = 0; k < 3; k++) {
        velocity[k] += mobility.inverse_mass * impulse[k] + carried[k];
        angular_velocity[k] += turn[k];
    }
}
