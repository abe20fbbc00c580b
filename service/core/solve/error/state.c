/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/error/state.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/extremes.h"
#include "solve/error/attempt.h"
#include "solve/error/calibration.h"

/* Starts that are tried for the errors of modes and steps, and of the models: modes are wrong one
 * way or the other by chance. */
static const uint64_t STARTS[2] = {3, 2};

/* +1 or -1 for each mode of each start (Steele, Lea and Flood's SplitMix64, 2014). */
static double sign_of(uint64_t start, uint64_t group, uint64_t mode, uint64_t which)
{
    uint64_t z = (start * 64 + group) * 0x9e3779b97f4a7c15u + mode * 4 + which;
    z = (z + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (z ^ z >> 31) & 1 ? 1.0 : -1.0;
}

/* The share that a body's state says. */
static double share_of(const struct problem *problem, size_t body, bool model)
{
    const struct body_state *state = problem->states[body];
    double share = !state ? 0.0 : model ? state->unknown_model : state->unknown;
    return share < 1.0 ? share : 1.0; /* of all of itself */
}

/* The frequency of a group's vibration, root of its square's mean by energy, rad/s. */
static double usual_frequency(const struct scene_group *group)
{
    double energy = 0.0;
    double squares = 0.0;
    for (size_t k = 0; k < group->count; k++) {
        double omega = group->set->omega[k];
        double speeds = group->v[k] * group->v[k] + omega * omega * group->q[k] * group->q[k];
        energy += speeds;
        squares += omega * omega * speeds;
    }
    return energy > 0.0 ? sqrt(squares / energy) : INFINITY;
}

/* A force that begins as k v^1.5 t^1.5 strikes a mode that is fast against it to a speed of
 * Gamma(5/2) phi k v^1.5 omega^-2.5, and once more where it ends; of a Hertz contact of length T
 * k v^1.5 is (2.94/T)^1.5 times its largest force, which is J/(0.57 T). By squares: */
static const double ABRUPT = 16.6;

/* Speed of a mode that may have been left out of an earlier answer, as it acts here: participations
 * are about the same at all places. */
static double left_out(const struct problem *problem, const struct solution *solution, size_t g,
                       size_t k)
{
    const struct scene_group *group = &solution->scene->group[g];
    const struct body_state *state = problem->states[group->body];
    const struct assembly *assembly = solution->assembly;
    double omega = group->set->omega[k];
    double known = (double)state->known[assembly->families[g]];
    if ((double)assembly->sources[g]->mode[k] < STATE_LAST * known)
        return 0.0;
    double acts = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        if (group->participation[c])
            acts = larger(fabs(group->participation[c][k]), acts);
    double decayed =
        exp(-group->set->damping[k] * omega * problem->request->bodies[group->body].elapsed);
    return decayed * acts * state->abruptness / (omega * omega * sqrt(omega));
}

/* Amplitudes and phases of a group, each wrong by the share one way or the other; of fast modes, as
 * an instant that is wrong turns them, by more. */
static bool deviate(const struct problem *problem, const struct solution *solution, uint64_t start,
                    size_t index, bool model, struct scene_group *group)
{
    double share = share_of(problem, group->body, model);
    double *q = arena_take(problem->arena, group->stride, sizeof *q);
    double *v = arena_take(problem->arena, group->stride, sizeof *v);
    double usual = usual_frequency(group);
    if (!q || !v)
        return false;
    for (size_t k = 0; k < group->count; k++) {
        double omega = group->set->omega[k];
        double own = smaller(share * larger(omega / usual, 1.0), 1.0);
        double grown = 1.0 + own * sign_of(start, index, k, 0);
        double turned = own * sign_of(start, index, k, 1);
        double more = model ? 0.0 : left_out(problem, solution, index, k);
        q[k] = grown * group->q[k] - turned * group->v[k] / omega;
        v[k] = grown * group->v[k] + turned * group->q[k] * omega;
        q[k] += M_SQRT1_2 * more / omega * sign_of(start, index, k, 2);
        v[k] += M_SQRT1_2 * more * sign_of(start, index, k, 3);
    }
    group->q = q;
    group->v = v;
    return true;
}

/* The answer's scene with another start. False: out of memory. */
static bool make_scene(const struct problem *problem, const struct solution *solution,
                       uint64_t start, bool model, struct scene *scene)
{
    struct scene_group *groups = arena_take(problem->arena, scene->groups, sizeof *groups);
    if (!groups)
        return false;
    memcpy(groups, scene->group, scene->groups * sizeof *groups);
    scene->group = groups;
    for (size_t g = 0; g < scene->groups; g++) {
        bool rings = groups[g].q && share_of(problem, groups[g].body, model) > 0.0;
        if (rings && !deviate(problem, solution, start, g, model, &groups[g]))
            return false;
    }
    return true;
}

/* Distance of the farthest solution from the answer; unknown where one cannot be solved. */
static enum percuss_status solve_starts(struct attempt_context *context,
                                        const struct solution *solution, bool model,
                                        double *farthest, double *vibration)
{
    const double effort = PERTURBED_WORK * impact_work(solution->scene, &solution->outcome);
    for (uint64_t start = 0; start < STARTS[model]; start++) {
        struct scene scene = *solution->scene;
        struct attempt attempt = {.accuracy = solution->step_accuracy,
                                  .assembly = solution->assembly,
                                  .profile = solution->step_profile};
        if (!make_scene(context->problem, solution, start, model, &scene))
            return PERCUSS_INTERNAL;
        /* each takes a part of the rest of the effort */
        double left = context->work;
        context->work = smaller(left, effort);
        double allowed = context->work;
        enum percuss_status status = attempt_run(context, &attempt, &scene);
        context->work += left - allowed;
        if (status)
            return status;
        if (attempt_is_spent(&attempt) || attempt.outcome.always_overlapped) {
            *farthest = INFINITY;
            continue;
        }
        *farthest = larger(
            outcome_compare(context->problem, &solution->outcome, &attempt.outcome).restitution,
            *farthest);
        outcome_widen_vibration(context->problem, &solution->outcome, &attempt.outcome, vibration);
    }
    return PERCUSS_OK;
}

static bool any_share(const struct problem *problem, bool model)
{
    for (size_t b = 0; b < problem->body_count; b++)
        if (share_of(problem, b, model) > 0.0)
            return true;
    return false;
}

enum percuss_status state_find_error(const struct problem *problem, const struct solution *solution,
                                     struct pace *pace, struct state_error *error)
{
    struct attempt_context context = {
        .problem = problem, .arena = problem->arena, .pace = pace, .work = solution->work};
    double farthest[2] = {0.0, 0.0};
    *error = (struct state_error){0};
    if (solution->outcome.end_reason == PERCUSS_END_LIMIT)
        return PERCUSS_OK;
    for (int model = 0; model < 2; model++) {
        if (!any_share(problem, model))
            continue;
        error->vibration[model] =
            arena_take(problem->arena, problem->body_count, sizeof *error->vibration[model]);
        if (!error->vibration[model])
            return PERCUSS_INTERNAL;
        enum percuss_status status =
            solve_starts(&context, solution, model, &farthest[model], error->vibration[model]);
        if (status)
            return status;
    }
    if (farthest[0] == 0.0 && farthest[1] == 0.0)
        return PERCUSS_OK;
    double range = outcome_range(problem, &solution->outcome);
    error->restitution = smaller(FACTOR_COMPARED * farthest[0], range);
    error->model = smaller(FACTOR_COMPARED * farthest[1], range);
    return PERCUSS_OK;
}

/* Energy of a body's vibration at the stated instant, J. */
static double energy_before(const struct scene *scene, size_t body)
{
    double sum = 0.0;
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        for (size_t k = 0; group->q && group->body == body && k < group->count; k++) {
            double spring = group->set->omega[k] * group->q[k];
            sum += 0.5 * (group->v[k] * group->v[k] + spring * spring);
        }
    }
    return sum;
}

/* Amplitudes go with the root of the energy: the error before stays, and the impact's share
 * of the change joins it, at most all of both; but no less than the energy by which other solutions
 * differ, in energy: sub-impacts trade impulse where its sum hardly changes. */
static double share_after(double share, double before, double impact, double differs, double after)
{
    double changed = larger(impact * (sqrt(before) + sqrt(after)), sqrt(differs));
    double wrong = sqrt((share * share * before + changed * changed) / after);
    return !(after > 0.0) ? 0.0 : wrong < 1.0 ? wrong : 1.0;
}

/* Of all impacts on a body, by squares. */
static double abruptness_after(const struct problem *problem, const struct solution *solution,
                               size_t body)
{
    const struct body_state *before = problem->states[body];
    double sum = before ? before->abruptness * before->abruptness : 0.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        const struct contact_side *sides = problem->sides[c];
        const struct track *track = &solution->outcome.tracks[c];
        if (sides[0].body != body && sides[1].body != body)
            continue;
        for (size_t i = 0; i < track->count && i < PERCUSS_MAX_SUB_IMPACTS; i++) {
            double length = track->list[i].end - track->list[i].start;
            double struck = ABRUPT * track->list[i].impulse / (length * length * sqrt(length));
            sum += length > 0.0 ? struck * struck : 0.0;
        }
    }
    return sqrt(sum);
}

/* How many modes of a family took part in all answers so far; all that there are, where no impact
 * has loaded it. */
static size_t known_after(const struct problem *problem, const struct solution *solution,
                          size_t body, size_t family)
{
    const struct assembly *assembly = solution->assembly;
    const struct body_state *before = problem->states[body];
    size_t known = before ? before->known[family] : SIZE_MAX;
    for (size_t g = 0; g < assembly->scene.groups; g++) {
        const struct scene_group *group = &assembly->groups[g];
        if (group->body != body || assembly->families[g] != family)
            continue;
        size_t taken = assembly->sources[g]->mode[group->count - 1] + 1;
        known = taken < known ? taken : known;
    }
    return known;
}

static double changed_by(const struct state_error *error, bool model, size_t body)
{
    return error->vibration[model] ? error->vibration[model][body] : 0.0;
}

void state_error_after(const struct problem *problem, const struct solution *solution,
                       const struct state_shares *shares, size_t body, struct body_state *state)
{
    double before = energy_before(solution->scene, body);
    double after = solution->outcome.vibration[body];
    double differs = larger(solution->neighbours->vibration[body],
                            changed_by(&solution->error.states, false, body));
    state->unknown =
        share_after(share_of(problem, body, false), before, shares->numerical, differs, after);
    state->abruptness = abruptness_after(problem, solution, body);
    for (size_t f = 0; f < problem->bodies[body]->kind->family_count; f++)
        state->known[f] = known_after(problem, solution, body, f);
    /* both planes of a state that was turned back lack the modes of either */
    const struct bending_axes *axes = &problem->axes[body];
    size_t *planes = &state->known[axes->first];
    if (axes->sine != 0.0)
        planes[0] = planes[1] = planes[0] < planes[1] ? planes[0] : planes[1];
    state->unknown_model = share_after(share_of(problem, body, true), before, shares->model,
                                       changed_by(&solution->error.states, true, body), after);
}
