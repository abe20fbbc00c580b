/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/request.h"

#include "model/vector.h"

static void point_velocity(const struct solve_body *body, const double point[3], double velocity[3])
{
    double arm[3];
    double turning[3];
    sub3(point, body->position, arm);
    cross3(body->angular_velocity, arm, turning);
    for (int i = 0; i < 3; i++)
        velocity[i] = body->velocity[i] + turning[i];
}

void solve_contact_velocity(const struct solve_request *request, size_t contact, double velocity[3])
{
    const struct solve_contact *at = &request->contacts[contact];
    double a[3];
    double b[3];
    point_velocity(&request->bodies[at->a], at->point, a);
    point_velocity(&request->bodies[at->b], at->point, b);
    sub3(a, b, velocity);
}
