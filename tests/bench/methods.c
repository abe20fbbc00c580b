/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "methods.h"

#include <math.h>
#include <string.h>

#include "impact/impact_scale.h"

static const unsigned long MAX_INTERVALS = 100000000;

/* Eq. (6) with the compression impulse -gap rate / W: a rebound at the rate of approach is 1. */
static double restitution_of_rate(const struct scene *scene, double gap_rate)
{
    return -gap_rate / scene->gap_rate[0];
}

static void begin(struct method *method, const struct fixed_scene *fixed)
{
    memset(method, 0, sizeof *method);
    method->scene = fixed->scene;
    method->horizon = fixed->horizon;
}

bool method_open_modal(struct method *method, const struct fixed_scene *fixed, double accuracy)
{
    begin(method, fixed);
    method->accuracy = accuracy;
    return true;
}

bool method_run_modal(struct method *method)
{
    struct impact_outcome outcome;
    struct impact_settings settings = {
        .accuracy = method->accuracy, .horizon = method->horizon, .max_work = 1e12};
    arena_reset(&method->scratch);
    if (!impact_create(&outcome, method->scene, &method->scratch) ||
        impact_modal(method->scene, &settings, &method->scratch, &outcome))
        return false;
    method->restitution =
        outcome.tracks[0].impulse * method->scene->w[0] / -method->scene->gap_rate[0] - 1.0;
    return outcome.end_reason == PERCUSS_END_SEPARATED;
}

static bool open_ode(struct method *method, const struct fixed_scene *fixed)
{
    begin(method, fixed);
    return contact_ode_create(&method->ode, method->scene, &method->arena) &&
           motion_create(&method->motion, method->scene, &method->arena) &&
           flight_create(&method->flight, method->scene, &method->arena);
}

bool method_open_integrator(struct method *method, const struct fixed_scene *fixed,
                            integrator_maker *make, const struct integrator_settings *settings)
{
    if (!open_ode(method, fixed))
        return false;
    method->integrator = make(&method->ode, settings);
    return method->integrator != NULL;
}

/* From a touch to the end of the contact, y in `state`. */
typedef bool contact_phase(struct method *method, double *state);

/* Flights by the library, contacts by the method. */
static bool run_between_flights(struct method *method, double *state, contact_phase *contact)
{
    motion_start(&method->motion, method->scene);
    for (;;) {
        double time;
        size_t touched;
        enum flight_end end =
            flight_find(&method->flight, method->scene, &method->motion,
                        method->horizon - method->motion.time, MAX_INTERVALS, &time, &touched);
        if (end != FLIGHT_TOUCH) {
            method->restitution = restitution_of_rate(method->scene, method->motion.gap_rate[0]);
            return end == FLIGHT_COMPLETE;
        }
        motion_advance(&method->motion, method->scene, time);
        contact_ode_pack(&method->ode, &method->motion, state);
        if (!contact(method, state))
            return false;
        contact_ode_unpack(&method->ode, state, &method->motion);
    }
}

static double approach_rate(const struct method *method, const double *y)
{
    return contact_ode_approach(&method->ode, y + method->ode.stride);
}

static bool integrate_contact(struct method *method, double *y)
{
    struct integrator *integrator = method->integrator;
    double start = method->motion.time;
    double t = start;
    if (!integrator->operations->restart(integrator, start))
        return false;
    enum integrator_event event;
    do
        event = integrator->operations->advance(integrator, method->horizon, &t);
    while (event == INTEGRATOR_ROOT && approach_rate(method, y) > 0.0);
    method->motion.time = t;
    return event == INTEGRATOR_ROOT;
}

bool method_run_phases(struct method *method)
{
    return run_between_flights(method, method->integrator->y, integrate_contact);
}

bool method_run_whole(struct method *method)
{
    struct integrator *integrator = method->integrator;
    const struct contact_ode *ode = &method->ode;
    double *y = integrator->y;
    double look = method->horizon / 500.0;
    double t = 0.0;
    motion_start(&method->motion, method->scene);
    contact_ode_pack(ode, &method->motion, y);
    if (!integrator->operations->restart(integrator, t))
        return false;
    while (t < method->horizon) {
        enum integrator_event event = integrator->operations->advance(integrator, t + look, &t);
        if (event == INTEGRATOR_FAILED)
            return false;
        if (!(contact_ode_approach(ode, y) > 0.0) && contact_ode_complete(ode, y)) {
            method->restitution = restitution_of_rate(method->scene, -y[ode->stride]);
            return true;
        }
        /* the right-hand side is not smooth there */
        if (event == INTEGRATOR_ROOT && !integrator->operations->restart(integrator, t))
            return false;
    }
    return false;
}

bool method_open_verlet(struct method *method, const struct fixed_scene *fixed, double steps)
{
    if (!open_ode(method, fixed))
        return false;
    const struct contact_ode *ode = &method->ode;
    double duration = impact_scale_of(method->scene, 0, ode->speed).duration;
    double h = method->step = 2.94 * duration / steps; /* Hertz lasts 2.94 indentation / speed */
    double **arrays[] = {&method->cosine, &method->sine_by_omega, &method->omega_sine,
                         &method->kick, &method->state};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        *arrays[i] = arena_take(&method->arena, 2 * ode->stride, sizeof(double));
        if (!*arrays[i])
            return false;
    }
    for (size_t k = 0; k < ode->stride; k++) {
        double omega = ode->omega[k];
        method->cosine[k] = cos(omega * h);
        method->omega_sine[k] = omega * sin(omega * h);
        method->sine_by_omega[k] = omega > 0.0 ? sin(omega * h) / omega : h;
        method->kick[k] = h * ode->push[k];
    }
    return true;
}

/* The half kicks before and after a rotation belong to the same instants as their neighbours: whole
 * kicks between rotations, and the force at the touch is zero. */
static bool verlet_contact(struct method *method, double *y)
{
    struct contact_ode *ode = &method->ode;
    size_t stride = ode->stride;
    double *restrict z = y;
    double *restrict v = y + stride;
    const double *restrict cosine = method->cosine;
    const double *restrict sine_by_omega = method->sine_by_omega;
    const double *restrict omega_sine = method->omega_sine;
    const double *restrict kick = method->kick;
    double force = 0.0;
    for (unsigned long i = 0; i < 1000000000; i++) {
        for (size_t k = 0; k < stride; k++) {
            double pushed = v[k] - kick[k] * force;
            double old = z[k];
            z[k] = cosine[k] * old + sine_by_omega[k] * pushed;
            v[k] = cosine[k] * pushed - omega_sine[k] * old;
        }
        method->motion.time += method->step;
        double approach = contact_ode_approach(ode, z);
        if (!(approach > 0.0))
            return true;
        force = contact_ode_force(ode, approach);
    }
    return false;
}

bool method_run_verlet(struct method *method)
{
    return run_between_flights(method, method->state, verlet_contact);
}

void method_close(struct method *method)
{
    if (method->integrator)
        method->integrator->operations->free(method->integrator);
    arena_release(&method->arena);
    arena_release(&method->scratch);
}
