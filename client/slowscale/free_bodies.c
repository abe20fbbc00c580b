/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies that no joint holds. */
#include <math.h>
#include <percuss/slow_equations.h>
#include <string.h>

#include "slow.h"

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Row-major world <- body. */
static void rotation(const double q[4], double r[9])
{
    double w = q[0], x = q[1], y = q[2], z = q[3];
    double s = 2.0 / (w * w + x * x + y * y + z * z);
    r[0] = 1.0 - s * (y * y + z * z);
    r[1] = s * (x * y - w * z);
    r[2] = s * (x * z + w * y);
    r[3] = s * (x * y + w * z);
    r[4] = 1.0 - s * (x * x + z * z);
    r[5] = s * (y * z - w * x);
    r[6] = s * (x * z - w * y);
    r[7] = s * (y * z + w * x);
    r[8] = 1.0 - s * (x * x + y * y);
}

/* Velocities that an impulse at a point gives the body. */
static void respond(const struct percuss_body_motion *body,
                    const struct percuss_slow_inertia *inertia, const double point[3],
                    const double impulse[3], double velocity[3], double turning[3])
{
    double arm[3], moment[3], r[9];
    /* P / m */
    for (int i = 0; i < 3; i++) {
        arm[i] = point[i] - body->position[i];
        velocity[i] = impulse[i] / inertia->mass;
        turning[i] = 0.0;
    }
    if (isinf(inertia->mass))
        return;
    /* I^-1 (arm x P), by the principal axes: the columns of r */
    cross(arm, impulse, moment);
    rotation(body->orientation, r);
    for (int axis = 0; axis < 3; axis++) {
        double about = r[axis] * moment[0] + r[3 + axis] * moment[1] + r[6 + axis] * moment[2];
        for (int i = 0; i < 3; i++)
            turning[i] += r[3 * i + axis] * about / inertia->moments[axis];
    }
}

/* direction.(v + omega x r) of a body at a contact. */
static double rate_at(const double position[3], const double velocity[3], const double turning[3],
                      const struct percuss_slow_contact *contact, const double direction[3])
{
    double arm[3], swing[3];
    for (int i = 0; i < 3; i++)
        arm[i] = contact->point[i] - position[i];
    cross(turning, arm, swing);
    return dot(direction, velocity) + dot(direction, swing);
}

void percuss_slow_gap_rates(const struct percuss_body_motion *bodies, size_t count,
                            const struct percuss_slow_contact *contacts, double *gap_rate)
{
    if (count > 0 && SLOW_NULL(bodies, contacts, gap_rate))
        return;
    for (size_t i = 0; i < count; i++) {
        const struct percuss_body_motion *a = &bodies[contacts[i].a];
        const struct percuss_body_motion *b = &bodies[contacts[i].b];
        const double *normal = contacts[i].normal;
        gap_rate[i] = rate_at(a->position, a->velocity, a->angular_velocity, &contacts[i], normal) -
                      rate_at(b->position, b->velocity, b->angular_velocity, &contacts[i], normal);
    }
}

/* Rate of contact `of` along one direction per unit impulse at contact `at` along another one, by
 * the motion of one body. */
static double coupling(const struct percuss_body_motion *bodies,
                       const struct percuss_slow_inertia *inertias, uint32_t body,
                       const struct percuss_slow_contact *at, const double push[3],
                       const struct percuss_slow_contact *of, const double along[3])
{
    double velocity[3], turning[3];
    respond(&bodies[body], &inertias[body], at->point, push, velocity, turning);
    double rate = rate_at(bodies[body].position, velocity, turning, of, along);
    return (at->a == body ? 1.0 : -1.0) * (of->a == body ? rate : -rate);
}

/* The same by all bodies that both contacts share. */
static double inverse_mass(const struct percuss_body_motion *bodies,
                           const struct percuss_slow_inertia *inertias,
                           const struct percuss_slow_contact *y, const double push[3],
                           const struct percuss_slow_contact *x, const double along[3])
{
    double sum = 0.0;
    if (x->a == y->a || x->a == y->b)
        sum += coupling(bodies, inertias, x->a, y, push, x, along);
    if (x->b == y->a || x->b == y->b)
        sum += coupling(bodies, inertias, x->b, y, push, x, along);
    return sum;
}

void percuss_slow_free_delassus(const struct percuss_body_motion *bodies,
                                const struct percuss_slow_inertia *inertias, size_t count,
                                const struct percuss_slow_contact *contacts, double *delassus)
{
    if (count > 0 && SLOW_NULL(bodies, inertias, contacts, delassus))
        return;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j <= i; j++)
            delassus[i * count + j] = delassus[j * count + i] =
                inverse_mass(bodies, inertias, &contacts[j], contacts[j].normal, &contacts[i],
                             contacts[i].normal);
}

/* As the service's oblique_find_tangent has it; a stated tangent closer to the normal than this
 * share of its length is none. */
static const double ALONG_NORMAL = 1e-6;

/* The part of a direction across the unit normal, as a unit vector. False: it is none. */
static bool lay_across(const double normal[3], const double direction[3], double tangent[3])
{
    double length = sqrt(dot(direction, direction));
    if (!(length > 0.0))
        return false;
    double along = dot(normal, direction) / length;
    for (int i = 0; i < 3; i++)
        tangent[i] = direction[i] / length - along * normal[i];
    double left = sqrt(dot(tangent, tangent));
    if (!(left > ALONG_NORMAL))
        return false;
    for (int i = 0; i < 3; i++)
        tangent[i] /= left;
    return true;
}

void percuss_slow_tangents(const struct percuss_slow_contact *contact, double first[3],
                           double second[3])
{
    if (SLOW_NULL(contact, first, second))
        return;
    double normal[3], length = sqrt(dot(contact->normal, contact->normal));
    double axis[3] = {0.0};
    int least = 0;
    for (int i = 0; i < 3; i++) {
        normal[i] = length > 0.0 ? contact->normal[i] / length : 0.0;
        least = fabs(contact->normal[i]) < fabs(contact->normal[least]) ? i : least;
    }
    axis[least] = 1.0;
    if (!lay_across(normal, contact->tangent, first))
        lay_across(normal, axis, first);
    cross(normal, first, second);
}

void percuss_slow_free_oblique(const struct percuss_body_motion *bodies,
                               const struct percuss_slow_inertia *inertias, size_t count,
                               const struct percuss_slow_contact *contacts, double *delassus)
{
    size_t rows = 3 * count;
    if (count > 0 && SLOW_NULL(bodies, inertias, contacts, delassus))
        return;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j <= i; j++) {
            double x[3][3], y[3][3];
            memcpy(x[0], contacts[i].normal, sizeof x[0]);
            memcpy(y[0], contacts[j].normal, sizeof y[0]);
            percuss_slow_tangents(&contacts[i], x[1], x[2]);
            percuss_slow_tangents(&contacts[j], y[1], y[2]);
            for (size_t k = 0; k < 9; k++) {
                size_t row = 3 * i + k / 3, column = 3 * j + k % 3;
                delassus[row * rows + column] = delassus[column * rows + row] =
                    inverse_mass(bodies, inertias, &contacts[j], y[k % 3], &contacts[i], x[k / 3]);
            }
        }
}

/* Adds `factor` times the velocities by a unit impulse in a direction, + on a and - on b. */
static void push_pair(struct percuss_body_motion *bodies,
                      const struct percuss_slow_inertia *inertias,
                      const struct percuss_slow_contact *contact, const double direction[3],
                      double factor)
{
    for (int side = 0; side < 2; side++) {
        uint32_t body = side == 0 ? contact->a : contact->b;
        double velocity[3], turning[3];
        respond(&bodies[body], &inertias[body], contact->point, direction, velocity, turning);
        for (int i = 0; i < 3; i++) {
            bodies[body].velocity[i] += (side == 0 ? factor : -factor) * velocity[i];
            bodies[body].angular_velocity[i] += (side == 0 ? factor : -factor) * turning[i];
        }
    }
}

void percuss_slow_free_apply(struct percuss_body_motion *bodies,
                             const struct percuss_slow_inertia *inertias,
                             const struct percuss_slow_contact *contact, double impulse)
{
    if (!SLOW_NULL(bodies, inertias, contact))
        push_pair(bodies, inertias, contact, contact->normal, impulse);
}

void percuss_slow_free_apply_vector(struct percuss_body_motion *bodies,
                                    const struct percuss_slow_inertia *inertias,
                                    const struct percuss_slow_contact *contact,
                                    const double impulse[3])
{
    if (!SLOW_NULL(bodies, inertias, contact, impulse))
        push_pair(bodies, inertias, contact, impulse, 1.0);
}

/* Turns by a rotation vector, world. */
static void turn(double q[4], const double by[3])
{
    double angle = sqrt(dot(by, by));
    double s = angle > 0.0 ? sin(0.5 * angle) / angle : 0.5;
    double r[4] = {cos(0.5 * angle), s * by[0], s * by[1], s * by[2]};
    double turned[4] = {r[0] * q[0] - r[1] * q[1] - r[2] * q[2] - r[3] * q[3],
                        r[0] * q[1] + r[1] * q[0] + r[2] * q[3] - r[3] * q[2],
                        r[0] * q[2] + r[2] * q[0] + r[3] * q[1] - r[1] * q[3],
                        r[0] * q[3] + r[3] * q[0] + r[1] * q[2] - r[2] * q[1]};
    for (int i = 0; i < 4; i++)
        q[i] = turned[i];
}

/* As push_pair, of places. */
static void move_pair(struct percuss_body_motion *bodies,
                      const struct percuss_slow_inertia *inertias,
                      const struct percuss_slow_contact *contact, const double direction[3],
                      double factor)
{
    for (int side = 0; side < 2; side++) {
        uint32_t body = side == 0 ? contact->a : contact->b;
        double signed_factor = side == 0 ? factor : -factor;
        double velocity[3], turning[3], by[3];
        respond(&bodies[body], &inertias[body], contact->point, direction, velocity, turning);
        for (int i = 0; i < 3; i++) {
            bodies[body].position[i] += signed_factor * velocity[i];
            by[i] = signed_factor * turning[i];
        }
        turn(bodies[body].orientation, by);
    }
}

void percuss_slow_free_move(struct percuss_body_motion *bodies,
                            const struct percuss_slow_inertia *inertias,
                            const struct percuss_slow_contact *contact, double moment)
{
    if (!SLOW_NULL(bodies, inertias, contact))
        move_pair(bodies, inertias, contact, contact->normal, moment);
}

void percuss_slow_free_move_vector(struct percuss_body_motion *bodies,
                                   const struct percuss_slow_inertia *inertias,
                                   const struct percuss_slow_contact *contact,
                                   const double moment[3])
{
    if (!SLOW_NULL(bodies, inertias, contact, moment))
        move_pair(bodies, inertias, contact, moment, 1.0);
}
