/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/impact_complete.h"

#include <math.h>
#include <string.h>

/* Part of the available energy that the balance may miss. Steps leave up to 1.5e-3 on coarse
 * meshes, falling with their square; more is a mistake. */
static const double ENERGY_KEPT = 1e-2;

/* Part told as done once twice the duration expected has passed: the end may come at any time. */
static const double NEARLY_DONE = 0.99;

/* Beyond what the setup holds: where a run stands. */
struct progress {
    struct complete_run run;
    size_t n;            /* smallest steps done */
    double quiet;        /* s: shorter openings do not divide a contact */
    bool open;           /* a sub-impact is under way */
    double last_touch;   /* s */
    double window_start; /* s, of the mean of the force */
    double window_impulse;
    struct complete_result *result;
};

static double now(const struct progress *progress)
{
    return (double)progress->n * progress->run.dynamics.step;
}

static struct complete_sub_impact *current(struct progress *progress)
{
    size_t count = progress->result->sub_impacts;
    size_t last = count < COMPLETE_SUB_IMPACTS ? count : COMPLETE_SUB_IMPACTS;
    return &progress->result->sub_impact[last - 1];
}

static void close_sub_impact(struct progress *progress)
{
    if (progress->open)
        current(progress)->end = progress->last_touch;
    progress->open = false;
}

/* An impulse between now and the end of the step. */
static void note_touch(struct progress *progress, double impulse)
{
    struct complete_result *result = progress->result;
    double time = now(progress);
    if (!progress->open) {
        progress->open = true;
        if (result->sub_impacts++ < COMPLETE_SUB_IMPACTS)
            current(progress)->start = time;
    }
    current(progress)->impulse += impulse;
    progress->last_touch = time + progress->run.dynamics.step;
    progress->window_impulse += impulse;
}

/* One step of the coarsest level: all nodes meet before and after it. */
static void advance(struct progress *progress)
{
    struct dynamics *dynamics = &progress->run.dynamics;
    size_t period = dynamics_period(dynamics);
    for (size_t i = 0; i < period; i++) {
        dynamics_kick(dynamics, progress->n);
        double impulse = node_contact_close(&progress->run.contact, dynamics);
        if (impulse > 0.0)
            note_touch(progress, impulse);
        dynamics_drift(dynamics, progress->n);
        progress->n++;
    }
}

/* Radius of the outermost pair that has no gap. */
static double touching_radius(const struct complete_run *run)
{
    const struct node_contact *contact = &run->contact;
    const double *y = run->dynamics.y;
    double radius = 0.0;
    for (size_t i = 0; i < contact->pairs; i++) {
        double gap = contact->gap[i] - y[contact->at[0][i]] * contact->scale[0][i] -
                     y[contact->at[1][i]] * contact->scale[1][i];
        if (gap <= 1e-9 * run->patch)
            radius = run->dynamics.at[contact->at[0][i] / 2][0];
    }
    return radius;
}

/* Mean force since the last look: long enough for the closing of single nodes to vanish in it. */
static void look(struct progress *progress)
{
    struct complete_result *result = progress->result;
    const struct complete_problem *problem = progress->run.problem;
    double time = now(progress);
    double span = time - progress->window_start;
    /* open for long enough: the sub-impact is over */
    if (progress->open && time - progress->last_touch > progress->quiet)
        close_sub_impact(progress);
    /* means since the last look */
    struct complete_sample sample = {.time = time,
                                     .force = progress->window_impulse / span,
                                     .indentation = complete_indentation(&progress->run),
                                     .radius = touching_radius(&progress->run)};
    progress->window_start = time;
    progress->window_impulse = 0.0;
    /* the largest of each, of all and of the sub-impact under way */
    result->peak_force = fmax(result->peak_force, sample.force);
    if (sample.force > 0.0) {
        struct complete_sub_impact *here = current(progress);
        here->peak_force = fmax(here->peak_force, sample.force);
        if (sample.indentation > here->max_indentation) {
            here->max_indentation = sample.indentation;
            here->compression_end = time;
            here->compression_impulse = here->impulse;
        }
        result->contact_radius = fmax(result->contact_radius, sample.radius);
        result->max_indentation = fmax(result->max_indentation, sample.indentation);
    }
    /* for who follows it */
    if (problem->sample)
        problem->sample(problem->context, &sample);
}

/* Rate at which the bodies' mean motions part, m/s, when all nodes meet. */
static double parting(const struct complete_run *run)
{
    double sum = 0.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++)
        sum -= dynamics_mean(&run->dynamics, b, run->dynamics.v);
    return sum;
}

/* Whether the gap of the mean motions exceeds all that vibration can bridge: a displacement u of a
 * patch costs at least u^2/(2c). */
static bool is_over(const struct progress *progress)
{
    const struct complete_run *run = &progress->run;
    if (progress->open || progress->result->sub_impacts == 0 || !(parting(run) > 0.0))
        return false;
    struct dynamics_energy energy = dynamics_energy(&run->dynamics, run->dynamics.v);
    double gap = 0.0;
    double reach = 0.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        gap -= dynamics_mean(&run->dynamics, b, run->dynamics.y);
        reach += sqrt(2.0 * (energy.vibration[b] + energy.strain[b]) * run->compliance[b]);
    }
    return gap > reach;
}

/* Energies now: velocities half a step either side, so one more kick is given and not flown. */
static void audit(struct progress *progress)
{
    struct complete_run *run = &progress->run;
    struct dynamics *dynamics = &run->dynamics;
    struct complete_energy *total = &progress->result->energy;
    /* one more kick, so that velocities on both sides of this instant are known */
    memcpy(run->v_before, dynamics->v, 2 * dynamics->nodes * sizeof(double));
    double rate = parting(run);
    dynamics_kick(dynamics, progress->n);
    node_contact_close(&run->contact, dynamics);
    struct dynamics_energy energy = dynamics_energy(dynamics, run->v_before);
    /* of the relative motion, by the mean of both rates */
    double reduced = 1.0 / (1.0 / run->mass[0] + 1.0 / run->mass[1]);
    double speed = run->problem->speed;
    rate = 0.5 * (rate + parting(run));
    total->available = 0.5 * reduced * speed * speed;
    total->rebound = 0.5 * reduced * rate * rate;
    total->contact = run->contact.loss;
    /* what either body holds */
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        total->vibration_of[b] = energy.vibration[b] + energy.strain[b];
        total->vibration += total->vibration_of[b];
        total->plastic += energy.plastic[b];
    }
    /* and what is missing */
    total->closure =
        total->available - total->rebound - total->vibration - total->plastic - total->contact;
}

/* Fills the result; an answer that does not keep the energy is none. */
static enum percuss_status summarize(struct progress *progress, struct fault *fault)
{
    const struct complete_run *run = &progress->run;
    const struct dynamics *dynamics = &run->dynamics;
    struct complete_result *result = progress->result;
    close_sub_impact(progress);
    /* impulse, restitution by it, and what the bodies' momenta say of it */
    result->impulse = run->contact.impulse;
    result->restitution =
        result->impulse * (1.0 / run->mass[0] + 1.0 / run->mass[1]) / run->problem->speed - 1.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        double start = b == 0 ? run->problem->speed : 0.0;
        double change = run->mass[b] * (dynamics_mean(dynamics, b, dynamics->v) - start);
        result->mass[b] = run->mass[b];
        result->momentum_error =
            fmax(result->momentum_error, fabs(change + result->impulse) / result->impulse);
    }
    /* time in contact, of the listed sub-impacts */
    size_t listed =
        result->sub_impacts < COMPLETE_SUB_IMPACTS ? result->sub_impacts : COMPLETE_SUB_IMPACTS;
    for (size_t i = 0; i < listed; i++)
        result->contact_time += result->sub_impact[i].end - result->sub_impact[i].start;
    /* what it took */
    result->end_time = now(progress);
    result->elements = dynamics->elements;
    result->levels = dynamics->levels;
    result->step = dynamics->step;
    result->steps = progress->n;
    for (size_t e = 0; e < dynamics->elements; e++)
        result->plastic_elements += dynamics->plastic[e];
    /* the balance */
    audit(progress);
    double lost = result->energy.closure / result->energy.available;
    if (!(fabs(lost) <= ENERGY_KEPT))
        return fault_set(fault, PERCUSS_INTERNAL,
                         "complete finite elements: %.2g of the energy is unaccounted for", lost);
    return PERCUSS_OK;
}

/* Runs to its end, or until the patch turns out too small. */
static enum percuss_status march(struct progress *progress, struct fault *fault)
{
    struct complete_run *run = &progress->run;
    const struct complete_problem *problem = run->problem;
    while (!run->contact.outgrown) {
        advance(progress);
        double time = now(progress);
        double part = fmin(time / (2.0 * run->duration), NEARLY_DONE);
        if (!pace_ask(problem->pace, problem->done + problem->share * part))
            return fault_set(fault, PERCUSS_TIMEOUT, "stopped at %g s of the impact", time);
        /* stresses grow with the root of time at first, slowly later: no element can pass from
         * well below yield to beyond it between two looks */
        if (time - progress->window_start < fmin(progress->quiet, 0.1 * time) &&
            time < problem->horizon)
            continue;
        /* elements that come near yield, and the contact */
        dynamics_watch_yield(&run->dynamics);
        look(progress);
        /* the end, if this is one */
        if (is_over(progress)) {
            progress->result->end = PERCUSS_END_SEPARATED;
            return PERCUSS_OK;
        }
        if (time >= problem->horizon) {
            progress->result->end = progress->open ? PERCUSS_END_IN_CONTACT : PERCUSS_END_HORIZON;
            return PERCUSS_OK;
        }
    }
    return PERCUSS_OK;
}

/* time that shear waves need across the patch */
static double quiet_time(const struct complete_run *run)
{
    double longest = 0.0;
    for (size_t b = 0; b < DYNAMICS_BODIES; b++) {
        const struct material *material = &run->dynamics.body[b].material;
        longest = fmax(longest, 2.0 * run->patch *
                                    sqrt(material->density / material_shear_modulus(material)));
    }
    return longest;
}

static enum percuss_status solve_with_patch(const struct complete_problem *problem, double patch,
                                            struct complete_result *result, bool *outgrown,
                                            struct fault *fault)
{
    struct arena arena = {0};
    struct progress progress = {.result = result};
    *result = (struct complete_result){0};
    enum percuss_status status = complete_begin(problem, patch, &arena, &progress.run, fault);
    if (status == PERCUSS_OK) {
        progress.quiet = quiet_time(&progress.run);
        status = march(&progress, fault);
        *outgrown = progress.run.contact.outgrown;
    }
    if (status == PERCUSS_OK && !*outgrown)
        status = summarize(&progress, fault);
    complete_end(&progress.run);
    arena_release(&arena);
    return status;
}

enum percuss_status impact_complete_solve(const struct complete_problem *problem,
                                          struct complete_result *result, struct fault *fault)
{
    enum percuss_status status = complete_check(problem, fault);
    if (status != PERCUSS_OK)
        return status;
    bool outgrown = true;
    double shift = (problem->phase < 0.5 ? problem->phase : problem->phase - 1.0) / problem->cells;
    for (double patch = complete_patch(problem) / (1.0 - shift); outgrown; patch *= 1.5) {
        status = solve_with_patch(problem, patch, result, &outgrown, fault);
        if (status != PERCUSS_OK)
            return status;
    }
    return PERCUSS_OK;
}
