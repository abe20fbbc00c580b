/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/outcome.h"

#include <math.h>
#include <stdio.h>

#include "base/extremes.h"

bool outcome_is_complete(const struct impact_outcome *outcome)
{
    return outcome->end_reason == PERCUSS_END_SEPARATED ||
           outcome->end_reason == PERCUSS_END_HANDED_BACK;
}

bool outcome_is_unsolved(const struct problem *problem, const struct impact_outcome *outcome)
{
    bool touched = false;
    for (size_t c = 0; c < problem->contact_count; c++)
        touched = touched || outcome->tracks[c].impulse > 0.0;
    return outcome->end_reason == PERCUSS_END_LIMIT && !touched;
}

double outcome_restitution(const struct problem *problem, const struct impact_outcome *outcome,
                           size_t contact)
{
    double compression = problem->impulse_compression[contact];
    return compression > 0.0 ? outcome->tracks[contact].impulse / compression - 1.0 : NAN;
}

/* A blow that nothing but the approach has energy for, solved to its end. */
static bool is_plain_impact(const struct problem *problem, const struct impact_outcome *outcome)
{
    const struct contact_side *sides = problem->sides[0];
    return problem->contact_count == 1 && problem->impulse_compression[0] > 0.0 &&
           problem->friction_count == 0 && problem->request->contacts[0].gap_acceleration == 0.0 &&
           !problem->states[sides[0].body] && !problem->states[sides[1].body] &&
           outcome_is_complete(outcome);
}

double outcome_range(const struct problem *problem, const struct impact_outcome *outcome)
{
    /* from 0 to 1, of which this answer is somewhere */
    if (is_plain_impact(problem, outcome)) {
        double e = outcome_restitution(problem, outcome, 0);
        return larger(e, 1.0 - e);
    }
    /* from -1 to 1, or to the largest */
    double most = 1.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        most = larger(outcome_restitution(problem, outcome, c), most);
    return 1.0 + most;
}

/* The sub-impacts of a track that are listed. */
static size_t track_listed(const struct track *track)
{
    return track->count < PERCUSS_MAX_SUB_IMPACTS ? track->count : PERCUSS_MAX_SUB_IMPACTS;
}

double outcome_peak_force(const struct impact_outcome *outcome, size_t contact)
{
    const struct track *track = &outcome->tracks[contact];
    double largest = 0.0;
    for (size_t i = 0; i < track_listed(track); i++)
        largest = larger(track->list[i].peak_force, largest);
    return largest;
}

double outcome_deepest(const struct impact_outcome *outcome, size_t contact)
{
    const struct track *track = &outcome->tracks[contact];
    double largest = 0.0;
    for (size_t i = 0; i < track_listed(track); i++)
        largest = larger(track->list[i].max_indentation, largest);
    return largest;
}

double outcome_rebound(const struct problem *problem, const struct impact_outcome *outcome,
                       size_t contact)
{
    const struct track *track = &outcome->tracks[contact];
    double back = 0.0;
    for (size_t i = 0; i < track_listed(track); i++)
        back += track->list[i].impulse - track->list[i].compression_impulse;
    double compression = problem->impulse_compression[contact];
    return compression > 0.0 ? fabs(back) / compression : 0.0;
}

void outcome_slip_after(const struct problem *problem, const struct impact_outcome *outcome,
                        size_t index, double slip[2])
{
    size_t n = problem->contact_count, rows = problem_rows(problem);
    for (size_t t = 0; t < 2; t++) {
        size_t row = n + 2 * index + t;
        const double *w = problem->row_w + row * rows;
        slip[t] = problem->gap_rate[row];
        for (size_t c = 0; c < n; c++)
            slip[t] += w[c] * outcome->tracks[c].impulse;
        for (size_t j = 0; j < problem->friction_count; j++)
            for (size_t s = 0; s < 2; s++)
                slip[t] +=
                    w[n + 2 * j + s] * outcome->tracks[problem->friction[j].contact].tangential[s];
    }
}

double outcome_tangential_restitution(const struct problem *problem,
                                      const struct impact_outcome *outcome, size_t index)
{
    const double *before = problem->gap_rate + problem->contact_count + 2 * index;
    double after[2], square = 0.0, product = 0.0;
    outcome_slip_after(problem, outcome, index, after);
    for (size_t t = 0; t < 2; t++) {
        square += before[t] * before[t];
        product += before[t] * after[t];
    }
    return square > 0.0 ? -product / square : NAN;
}

double outcome_kinematic(const struct problem *problem, const struct impact_outcome *outcome,
                         size_t contact, double restitution)
{
    if (problem->contact_count > 1 || !(problem->impulse_compression[contact] > 0.0) ||
        isnan(restitution))
        return NAN;
    const struct track *track = &outcome->tracks[contact];
    double rate = problem->gap_rate[contact];
    for (size_t r = 0; r < problem_rows(problem); r++)
        rate += problem->row_w[r] * (r == 0 ? track->impulse : track->tangential[r - 1]);
    return -rate / problem->gap_rate[contact];
}

double outcome_tangential_change(const struct impact_outcome *a, const struct impact_outcome *b,
                                 size_t contact)
{
    const double *x = a->tracks[contact].tangential, *y = b->tracks[contact].tangential;
    return hypot(x[0] - y[0], x[1] - y[1]);
}

struct outcome_difference outcome_compare(const struct problem *problem,
                                          const struct impact_outcome *a,
                                          const struct impact_outcome *b)
{
    struct outcome_difference largest = {0.0, 0.0};
    for (size_t c = 0; c < problem->contact_count; c++) {
        double change = fabs(a->tracks[c].impulse - b->tracks[c].impulse);
        double compression = problem->impulse_compression[c];
        largest.impulse = larger(change, largest.impulse);
        if (compression > 0.0)
            largest.restitution = larger(change / compression, largest.restitution);
    }
    return largest;
}

void outcome_widen_impulses(const struct problem *problem, const struct impact_outcome *a,
                            const struct impact_outcome *b, double *change)
{
    for (size_t c = 0; c < problem->contact_count; c++)
        change[c] = larger(fabs(a->tracks[c].impulse - b->tracks[c].impulse), change[c]);
}

static bool is_alike(const struct scene_group *a, const struct scene_group *b)
{
    return a->body == b->body && a->set->omega[0] == b->set->omega[0];
}

/* The group of the same oscillators in another solution, told by its first frequency, and among
 * equal ones (two planes of a square bar) by its place: sets are made anew where more modes are
 * asked for, so that their addresses depend on earlier requests. Its number of groups: none is. */
static size_t same_group(const struct impact_outcome *outcome, const struct impact_outcome *other,
                         size_t group)
{
    size_t before = 0, g = 0;
    for (size_t k = 0; k < group; k++)
        before += is_alike(&outcome->group[k], &outcome->group[group]);
    for (; g < other->groups; g++)
        if (is_alike(&other->group[g], &outcome->group[group]) && before-- == 0)
            break;
    return g;
}

/* The modes of a solution, as a scene without contacts: motions move freely by it. */
static struct scene outcome_modes(const struct impact_outcome *outcome)
{
    return (struct scene){.groups = outcome->groups, .group = outcome->group};
}

/* A solution's motion at an instant not before its end. False: out of memory. */
static bool find_motion(const struct impact_outcome *outcome, double time, struct arena *arena,
                        struct motion *motion)
{
    const struct scene modes = outcome_modes(outcome);
    *motion = outcome->motion;
    if (outcome->window >= time)
        return true;
    if (!motion_create(motion, &modes, arena))
        return false;
    motion_copy(motion, &outcome->motion, &modes);
    motion_turn(motion, &modes, time - outcome->window);
    return true;
}

/* Subtracts the free motion of the stated start from a motion. False: out of memory. */
static bool take_stated(const struct impact_outcome *outcome, double time, struct arena *arena,
                        struct motion *motion)
{
    const struct scene modes = outcome_modes(outcome);
    struct motion free;
    struct motion forced = *motion;
    if (!motion_create(&free, &modes, arena) || !motion_create(motion, &modes, arena))
        return false;
    motion_start(&free, &modes);
    motion_turn(&free, &modes, time);
    for (size_t g = 0; g < modes.groups; g++)
        for (size_t k = 0; k < modes.group[g].count; k++) {
            motion->q[g][k] = forced.q[g][k] - free.q[g][k];
            motion->v[g][k] = forced.v[g][k] - free.v[g][k];
        }
    return true;
}

/* Energy of the difference of the modes of two groups, in motion. */
static double vibration_difference(const struct scene_group *group, size_t count,
                                   const double *const q[2], const double *const v[2])
{
    double squares = 0.0;
    for (size_t k = 0; k < count; k++) {
        double spring = group->set->omega[k] * (q[0][k] - q[1][k]);
        double speed = v[0][k] - v[1][k];
        squares += speed * speed + spring * spring;
    }
    return 0.5 * squares;
}

void outcome_widen_vibration(const struct problem *problem, const struct impact_outcome *a,
                             const struct impact_outcome *b, double *energy)
{
    struct motion ends[2];
    double sum[PERCUSS_MAX_BODIES] = {0.0};
    double time = larger(a->window, b->window);
    if (!find_motion(a, time, problem->arena, &ends[0]) ||
        !find_motion(b, time, problem->arena, &ends[1]))
        return;
    /* begun otherwise, they have that in them, too */
    bool alike = true;
    for (size_t g = 0; g < a->groups; g++) {
        size_t h = same_group(a, b, g);
        alike = alike && (h == b->groups || a->group[g].q == b->group[h].q);
    }
    if (!alike && (!take_stated(a, time, problem->arena, &ends[0]) ||
                   !take_stated(b, time, problem->arena, &ends[1])))
        return;
    for (size_t g = 0; g < a->groups; g++) {
        const struct scene_group *group = &a->group[g];
        size_t h = same_group(a, b, g);
        size_t count = h == b->groups                     ? 0
                       : b->group[h].count < group->count ? b->group[h].count
                                                          : group->count;
        if (count > 0)
            sum[group->body] +=
                vibration_difference(group, count, (const double *[]){ends[0].q[g], ends[1].q[h]},
                                     (const double *[]){ends[0].v[g], ends[1].v[h]});
    }
    for (size_t g = 0; g < a->groups; g++)
        energy[a->group[g].body] = larger(sum[a->group[g].body], energy[a->group[g].body]);
}

double outcome_impulse_scale(const struct problem *problem, const struct impact_outcome *outcome,
                             size_t contact)
{
    const struct track *track = &outcome->tracks[contact];
    double compressed = 0.0;
    for (size_t i = 0; i < track_listed(track); i++)
        compressed += track->list[i].compression_impulse;
    return larger(problem->impulse_compression[contact], compressed);
}

/* Energy of the rates at which contacts close, J. */
static double approach_energy(const struct problem *problem)
{
    double approach = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        approach += 0.5 * problem->impulse_compression[c] * fabs(problem->gap_rate[c]);
    return approach;
}

double outcome_energy_defect(const struct problem *problem, const struct impact_outcome *outcome)
{
    double lost = fabs(outcome->energy.closure);
    /* the slowest approach of all has no energy that doubles can hold */
    return lost == 0.0 ? 0.0 : lost / larger(outcome->energy.available, approach_energy(problem));
}

/* Of the approach's energy: as closely as any audit must close. */
static const double ROUNDING = 1e-9;

bool outcome_energy_closes(const struct problem *problem, const struct impact_outcome *outcome,
                           double share)
{
    double lost = fabs(outcome->energy.closure);
    return lost <= share * outcome->energy.available || lost <= ROUNDING * approach_energy(problem);
}

bool outcome_keeps_energy(double defect)
{
    return defect <= OUTCOME_WORST_DEFECT;
}

enum percuss_status outcome_refuse_overlap(const struct problem *problem,
                                           const struct impact_outcome *outcome, double horizon,
                                           struct fault *fault)
{
    /* the contact that overlaps most */
    const struct solve_contact *contacts = problem->request->contacts;
    bool group = problem->contact_count > 1;
    size_t deepest = 0;
    for (size_t c = 1; c < problem->contact_count; c++)
        if (contacts[c].gap < contacts[deepest].gap)
            deepest = c;
    /* whether a longer horizon may help */
    char within[96] = "";
    if (outcome->beyond_horizon)
        snprintf(within, sizeof within, " within options.horizon (%g s) before: raise it", horizon);
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "contacts[%zu].gap: %g m: the bodies overlap, and at the stated gap rate (%g m/s), "
        "acceleration and vibration %s%s",
        deepest, contacts[deepest].gap, problem->gap_rate[deepest],
        group ? "there was no instant at which every contact was open" : "they never touched",
        within[0] ? within : " before");
}
