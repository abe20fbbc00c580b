/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The my_... of engine.c, which is the loop of docs/integrating.md: the smallest engine. A steel
 * sphere moves towards the middle of a free beam; no forces act and nothing turns. An engine of
 * your own has all of this in its own terms. */
#ifndef MY_ENGINE_H
#define MY_ENGINE_H

#include <percuss/slowscale.h>
#include <stdio.h>
#include <string.h>

enum { MY_SPHERE, MY_BEAM, MY_BODIES, MY_CONTACTS = 1 };
static const double MY_SPHERE_RADIUS = 0.015, MY_BEAM_RADIUS = 0.010, MY_BEAM_LENGTH = 1.0; /* m */

struct my_world {
    double time; /* s */
    struct percuss_body_motion bodies[MY_BODIES];
    struct percuss_slow_inertia inertias[MY_BODIES];
};

/* The bodies as the shipped catalogue has them, 1 mm apart, at 0.2 m/s. */
static struct my_world my_world_create(void)
{
    const double sphere = 0.110269, beam = 0.848230; /* kg */
    const double rolled = 0.4 * sphere * MY_SPHERE_RADIUS * MY_SPHERE_RADIUS;
    const double along = 0.5 * beam * MY_BEAM_RADIUS * MY_BEAM_RADIUS; /* the beam's axis, x */
    const double across = 0.5 * along + beam * MY_BEAM_LENGTH * MY_BEAM_LENGTH / 12.0;
    struct my_world world = {
        .inertias = {{sphere, {rolled, rolled, rolled}}, {beam, {along, across, across}}}};
    for (int i = 0; i < MY_BODIES; i++)
        world.bodies[i].orientation[0] = 1.0;
    world.bodies[MY_SPHERE].position[2] = MY_BEAM_RADIUS + MY_SPHERE_RADIUS + 1e-3;
    world.bodies[MY_SPHERE].velocity[2] = -0.2;
    return world;
}

static void my_integrate(struct my_world *world, double h)
{
    world->time += h;
    for (int i = 0; i < MY_BODIES; i++)
        for (int axis = 0; axis < 3; axis++)
            world->bodies[i].position[axis] += h * world->bodies[i].velocity[axis];
}

/* All pairs nearer than a few millimetres; returns how many. */
static size_t my_contacts(const struct my_world *world, struct percuss_slow_contact *contacts)
{
    const double *sphere = world->bodies[MY_SPHERE].position;
    double top = world->bodies[MY_BEAM].position[2] + MY_BEAM_RADIUS;
    double gap = sphere[2] - MY_SPHERE_RADIUS - top;
    contacts[0] = (struct percuss_slow_contact){.a = MY_SPHERE,
                                                .b = MY_BEAM,
                                                /* halfway between the surfaces */
                                                .point = {sphere[0], sphere[1], top + 0.5 * gap},
                                                .normal = {0.0, 0.0, 1.0}, /* from b to a */
                                                .gap = gap};
    return gap < 5e-3 ? 1 : 0;
}

/* Goes back to `before` and on by the part of h after which an impact is due, to 1 ns. */
static size_t my_bisect(struct my_world *world, const struct my_world *before,
                        const struct percuss_slow *slow, double h,
                        struct percuss_slow_contact *contacts)
{
    double early = 0.0, late = h;
    while (late - early > 1e-9) {
        double middle = 0.5 * (early + late);
        *world = *before;
        my_integrate(world, middle);
        size_t n = my_contacts(world, contacts);
        *(percuss_slow_due(slow, n, contacts) ? &late : &early) = middle;
    }
    *world = *before;
    my_integrate(world, late);
    return my_contacts(world, contacts);
}

/* The callbacks. */

static bool my_probe(void *context, struct percuss_slow_view *view)
{
    struct my_world *world = context;
    percuss_slow_gap_rates(world->bodies, view->count, view->contacts, view->gap_rate);
    if (view->delassus)
        percuss_slow_free_delassus(world->bodies, world->inertias, view->count, view->contacts,
                                   view->delassus);
    for (int i = 0; view->bodies && i < MY_BODIES; i++) {
        struct percuss_body_motion *asked = &view->bodies[i]; /* its id is set already */
        memcpy(asked->position, world->bodies[i].position, sizeof asked->position);
        memcpy(asked->orientation, world->bodies[i].orientation, sizeof asked->orientation);
        memcpy(asked->velocity, world->bodies[i].velocity, sizeof asked->velocity);
        memcpy(asked->angular_velocity, world->bodies[i].angular_velocity,
               sizeof asked->angular_velocity);
    }
    return true;
}

static bool my_apply(void *context, const struct percuss_slow_contact *contact, double impulse)
{
    struct my_world *world = context;
    percuss_slow_free_apply(world->bodies, world->inertias, contact, impulse);
    return true;
}

static double my_now(void *context)
{
    const struct my_world *world = context;
    return world->time;
}

static bool my_move(void *context, const struct percuss_slow_contact *contact, double moment)
{
    struct my_world *world = context;
    percuss_slow_free_move(world->bodies, world->inertias, contact, moment);
    return true;
}

static void my_log(void *context, const struct percuss_slow_report *report)
{
    (void)context;
    for (size_t i = 0; i < report->count; i++)
        printf("%.6f s: e = %.5f, impulse %.6f N s %s\n", report->time, report->restitution[i],
               report->impulse[i], report->message);
}

/* Asked some ten times a second while a call waits. */
static bool my_wait(void *context)
{
    unsigned *asked = context;
    if (++*asked == 20)
        fputs("looking for a percussd, or waiting for its answer ...\n", stderr);
    return true; /* false gives the call up */
}

#endif
