/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/report.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "impact/oscillator.h"
#include "impact/trace.h"
#include "model/bar.h"
#include "model/damping.h"
#include "model/rigid.h"
#include "model/vector.h"
#include "solve/contact_model.h"
#include "solve/error/law.h"
#include "solve/error/total.h"
#include "solve/radiation.h"
#include "solve/validity.h"

/* Share of the window by which the last instant kept may lie before its end. */
static const double TRACE_LAST_INSTANT = 0.01;
/* A larger difference of restitutions is that of two methods. */
static const double TRACE_SAME_METHOD = 1e-9;
/* Accuracy of steps that stand for a closed form, to as many digits. */
static const double TRACE_CLOSED_FORM = 1e-9;

void report_warn(struct solve_result *result, const char *format, ...)
{
    size_t room = sizeof result->warnings / sizeof *result->warnings;
    if (result->warning_count >= room)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(result->warnings[result->warning_count++], sizeof *result->warnings, format, args);
    va_end(args);
}

void report_warnings(const struct warnings *warnings, struct solve_result *result)
{
    size_t room = sizeof result->warnings / sizeof *result->warnings;
    _Static_assert(sizeof *result->warnings == sizeof *warnings->text, "the texts are as long");
    for (size_t i = 0; i < warnings->count && result->warning_count < room; i++)
        memcpy(result->warnings[result->warning_count++], warnings->text[i], WARNING_SIZE);
}

/* The other two coefficients of restitution of a single contact: by the gap's rate, and by the work
 * of the normal force while the gap shrinks and grows (Stronge). */
static void fill_rebound(const struct problem *problem, const struct solution *solution, size_t c,
                         struct solve_contact_result *contact)
{
    const struct track *track = &solution->outcome.tracks[c];
    contact->restitution_kinematic =
        outcome_kinematic(problem, &solution->outcome, c, contact->restitution);
    contact->restitution_energetic = NAN;
    if (isnan(contact->restitution_kinematic))
        return;
    /* without friction the impulse is in proportion to the change of the rate, which it only raises
     */
    if (problem->friction_count == 0 && problem->request->contacts[c].gap_acceleration == 0.0)
        contact->restitution_energetic = fmax(contact->restitution, 0.0);
    else if (track->compressed > 0.0)
        contact->restitution_energetic = sqrt(track->released / track->compressed);
}

/* The state of all sub-impacts together. */
static enum percuss_friction_state friction_state_of(const struct track *track)
{
    enum percuss_friction_state state = PERCUSS_FRICTION_STATE_NONE;
    for (size_t i = 0; i < track->count && i < PERCUSS_MAX_SUB_IMPACTS; i++) {
        enum percuss_friction_state one = track->list[i].friction_state;
        if (state == PERCUSS_FRICTION_STATE_NONE || one == PERCUSS_FRICTION_STATE_REVERSED)
            state = one;
        else if (one != state && state != PERCUSS_FRICTION_STATE_REVERSED)
            state = PERCUSS_FRICTION_STATE_PARTLY;
    }
    return state;
}

static void fill_friction(const struct problem *problem, const struct impact_outcome *outcome,
                          size_t i, struct solve_contact_result *contact)
{
    const struct contact_friction *friction = &problem->friction[i];
    const struct track *track = &outcome->tracks[friction->contact];
    size_t row = problem->contact_count + 2 * i;
    contact->friction = friction->coefficient;
    contact->friction_state = friction_state_of(track);
    memcpy(contact->tangent, friction->tangent[0], sizeof contact->tangent);
    outcome_slip_after(problem, outcome, i, contact->slip_after);
    for (size_t t = 0; t < 2; t++) {
        contact->impulse_tangential[t] = track->tangential[t];
        contact->slip_before[t] = problem->gap_rate[row + t];
        add_scaled3(track->tangential[t], friction->tangent[t], contact->impulse_vector);
    }
    contact->tangential_restitution = outcome_tangential_restitution(problem, outcome, i);
}

static void fill_contacts(const struct problem *problem, const struct solution *solution,
                          struct solve_result *result)
{
    size_t n = problem->contact_count;
    bool unsolved = outcome_is_unsolved(problem, &solution->outcome);
    result->contact_count = n;
    /* from the track of each contact */
    for (size_t c = 0; c < n; c++) {
        const struct track *track = &solution->outcome.tracks[c];
        struct solve_contact_result *contact = &result->contacts[c];
        /* a long list is cut; the count says how much */
        size_t listed =
            track->count < PERCUSS_MAX_SUB_IMPACTS ? track->count : PERCUSS_MAX_SUB_IMPACTS;
        *contact = (struct solve_contact_result){
            .impulse = track->impulse,
            .impulse_compression = problem->impulse_compression[c],
            .restitution = unsolved ? NAN : outcome_restitution(problem, &solution->outcome, c),
            .inverse_effective_mass = problem->w[c * n + c],
            .end_time = track->end_time,
            .sub_impact_count = track->count,
            .sub_impacts_listed = listed,
            .sub_impacts = track->list,
            .tangential_restitution = NAN,
            .restitution_kinematic = NAN,
            .restitution_energetic = NAN,
        };
        /* its impulse, along the normal */
        scale3(track->impulse, problem->request->contacts[c].normal, contact->impulse_vector);
        fill_rebound(problem, solution, c, contact);
    }
    for (size_t i = 0; i < problem->friction_count; i++)
        fill_friction(problem, &solution->outcome, i,
                      &result->contacts[problem->friction[i].contact]);
}

/* Adds the changes by a contact's tangential impulse, body frame. */
static void add_friction(const struct problem *problem, const struct solve_result *result, size_t i,
                         size_t body, double velocity[3], double angular[3])
{
    const struct contact_friction *friction = &problem->friction[i];
    for (int which = 0; which < 2; which++) {
        const struct contact_side *side = &problem->sides[friction->contact][which];
        for (int t = 0; side->body == body && t < 2; t++) {
            double impulse[3];
            scale3(result->contacts[friction->contact].impulse_tangential[t],
                   friction->sides[t][which].direction, impulse);
            rigid_apply_impulse(problem->bodies[body], side->site.point, impulse, velocity,
                                angular);
        }
    }
}

void report_velocities(const struct problem *problem, struct solve_result *result)
{
    for (size_t b = 0; b < problem->body_count; b++) {
        double velocity[3] = {0.0, 0.0, 0.0};
        double angular[3] = {0.0, 0.0, 0.0};
        /* changes by the impulses, body frame */
        for (size_t c = 0; c < problem->contact_count; c++) {
            for (int which = 0; which < 2; which++) {
                const struct contact_side *side = &problem->sides[c][which];
                double impulse[3];
                if (side->body != b)
                    continue;
                scale3(result->contacts[c].impulse, side->direction, impulse);
                rigid_apply_impulse(problem->bodies[b], side->site.point, impulse, velocity,
                                    angular);
            }
        }
        for (size_t i = 0; i < problem->friction_count; i++)
            add_friction(problem, result, i, b, velocity, angular);
        /* added to the velocities before, world */
        rotate3(problem->poses[b].rotation, velocity, result->bodies[b].velocity);
        rotate3(problem->poses[b].rotation, angular, result->bodies[b].angular_velocity);
        add_scaled3(1.0, problem->request->bodies[b].velocity, result->bodies[b].velocity);
        add_scaled3(1.0, problem->request->bodies[b].angular_velocity,
                    result->bodies[b].angular_velocity);
    }
    result->velocities_known = true;
}

/* How many modes of a family the new state holds. */
static size_t state_family_size(const struct assembly *assembly, const struct body_state *before,
                                size_t body, size_t family)
{
    size_t size = before ? before->count[family] : 0;
    for (size_t g = 0; g < assembly->scene.groups; g++) {
        const struct scene_group *group = &assembly->groups[g];
        if (group->body != body || assembly->families[g] != family)
            continue;
        size_t last = assembly->sources[g]->mode[group->count - 1] + 1;
        size = last > size ? last : size;
    }
    return size;
}

/* A solution's free motions, s: from the state to the stated instant, back to a touch before it (0:
 * it lies after it), and on from there. */
struct free_times {
    double elapsed, back, on;
};

/* As those move that take part: nothing is damped on the way back, see motion_rewind. */
static void state_move_one(double omega, double damping, const struct free_times *times,
                           double pair[2])
{
    if (times->back == 0.0) {
        oscillator_advance(omega, damping, times->elapsed + times->on, &pair[0], &pair[1]);
        return;
    }
    oscillator_advance(omega, damping, times->elapsed, &pair[0], &pair[1]);
    oscillator_advance(omega, 0.0, times->back, &pair[0], &pair[1]);
    oscillator_advance(omega, damping, times->on, &pair[0], &pair[1]);
}

/* Frequencies of modes that took no part are asked of the body anew. */
static void state_move_freely(const struct body *body, size_t family,
                              const struct body_state *before, const struct free_times *times,
                              struct arena *arena, double *pairs)
{
    size_t count = before->count[family];
    struct modal_family *modes = modal_family_create(body, family, count);
    arena->lacks = arena->lacks || !modes;
    memcpy(pairs, body_state_family(before, family), 2 * count * sizeof *pairs);
    for (size_t k = 0; modes && k < count && k < modes->count; k++)
        state_move_one(modes->omega[k], damping_of(body, k, modes->omega[k]), times, pairs + 2 * k);
    modal_family_free(modes);
}

static void state_fill_modes(const struct assembly *assembly, const struct impact_outcome *outcome,
                             const struct problem *problem, double elapsed,
                             struct body_state *state, size_t index)
{
    const struct body *body = problem->bodies[index];
    const struct body_state *before = problem->states[index];
    double back = fmin(outcome->time_shift, 0.0);
    const struct free_times times = {elapsed, back, outcome->window - back};
    for (size_t f = 0; f < body->kind->family_count; f++) {
        double *family = (double *)body_state_family(state, f);
        /* modes that took no part vibrate on freely */
        if (before && before->count[f])
            state_move_freely(body, f, before, &times, problem->arena, family);
        /* the others are as the impact left them */
        for (size_t g = 0; g < assembly->scene.groups; g++) {
            const struct scene_group *group = &assembly->groups[g];
            if (group->body != index || assembly->families[g] != f)
                continue;
            for (size_t k = 0; k < group->count; k++) {
                size_t mode = assembly->sources[g]->mode[k];
                family[2 * mode] = outcome->motion.q[g][k];
                family[2 * mode + 1] = outcome->motion.v[g][k];
            }
        }
    }
}

/* A place for one more dent: the next one, or that of the shallowest. */
static struct dent *new_dent(struct dent *dents, size_t *count)
{
    if (*count < BODY_STATE_MAX_DENTS)
        return &dents[(*count)++];
    struct dent *shallowest = dents;
    for (size_t i = 1; i < *count; i++)
        if (dents[i].history.dent < shallowest->history.dent)
            shallowest = &dents[i];
    return shallowest;
}

/* The dents of a body after the impact; their number. */
static size_t dents_after(const struct impact_outcome *outcome, const struct problem *problem,
                          const struct body_state *before, size_t body, struct dent *dents)
{
    size_t count = before ? before->dents : 0;
    if (count)
        memcpy(dents, body_state_dents(before), count * sizeof *dents);
    for (size_t c = 0; c < problem->contact_count; c++) {
        const struct contact_choice *choice = &problem->contact_model.choices[c];
        if (choice->side < 0 || problem->sides[c][choice->side].body != body ||
            !contact_model_yielded(problem, outcome, c))
            continue;
        struct dent *dent = choice->dented ? &dents[choice->dent] : new_dent(dents, &count);
        dent->history = outcome->laws[c].history;
        dent->size = dent->history.contact_radius;
        if (!choice->dented)
            memcpy(dent->point, problem->sides[c][choice->side].site.point, sizeof dent->point);
    }
    return count;
}

const struct body_state *state_after(const struct assembly *assembly,
                                     const struct impact_outcome *outcome,
                                     const struct problem *problem, size_t body)
{
    bool flexible = body_is_flexible(problem->bodies[body]);
    const struct solve_body *stated = &problem->request->bodies[body];
    /* how much there is to keep */
    struct dent dents[BODY_STATE_MAX_DENTS];
    struct body_state sizes = {.dents = 0};
    if (problem->request->options.dents == PERCUSS_DENTS_KEEP)
        sizes.dents = dents_after(outcome, problem, stated->state, body, dents);
    if (!flexible && !sizes.dents)
        return NULL;
    for (size_t f = 0; f < problem->bodies[body]->kind->family_count; f++)
        sizes.count[f] = state_family_size(assembly, problem->states[body], body, f);
    /* one block of it */
    body_state_make_room(&problem->axes[body], &sizes);
    struct body_state *state = arena_take(problem->arena, 1, body_state_size(&sizes));
    if (!state)
        return NULL;
    *state = sizes;
    /* filled */
    if (flexible) {
        state_fill_modes(assembly, outcome, problem, stated->elapsed, state, body);
        body_state_turn_back(&problem->axes[body], state);
    }
    if (sizes.dents)
        memcpy((struct dent *)body_state_dents(state), dents, sizes.dents * sizeof *dents);
    return state;
}

static void fill_bodies(const struct problem *problem, const struct solution *solution,
                        struct solve_result *result)
{
    result->body_count = problem->body_count;
    for (size_t b = 0; b < problem->body_count; b++) {
        const struct body *body = problem->bodies[b];
        struct solve_body_result *out = &result->bodies[b];
        *out = (struct solve_body_result){
            .vibration = solution->outcome.vibration[b],
            .modes = (unsigned)solution->assembly->modes[b],
            .rigid = solution->assembly->modes[b] == 0,
            .theory = body_theory(body),
            .shear_factor = body->shear_factor[1],
            .state_after = state_after(solution->assembly, &solution->outcome, problem, b),
        };
        memcpy(out->id, body->id, sizeof out->id);
    }
    /* an articulated body moves as its simulator says */
    if (!problem->from_client)
        report_velocities(problem, result);
}

static void warn_dents(struct solve_result *result)
{
    for (size_t b = 0; b < result->body_count; b++) {
        const struct body_state *after = result->bodies[b].state_after;
        if (after && after->dents == BODY_STATE_MAX_DENTS)
            report_warn(result,
                        "bodies[%zu].state: %d dents: no more are kept, the shallowest makes place "
                        "for a new one",
                        b, BODY_STATE_MAX_DENTS);
    }
}

static double largest_restitution(const struct solve_result *result)
{
    double largest = 0.0;
    for (size_t c = 0; c < result->contact_count; c++)
        if (fabs(result->contacts[c].restitution) > largest)
            largest = fabs(result->contacts[c].restitution);
    return largest;
}

/* A body that bends and is hit where it is held: every mode has a node there. NULL: there is none.
 */
static const struct body *body_at_node(const struct problem *problem)
{
    const double near = 1e-6; /* of its length: rounding of the pose, and more */
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const struct body *body = problem_body(problem, c, which);
            if (!body_is_flexible(body) || !body_bends(body))
                continue;
            double x = bar_place(body, &problem->sides[c][which].site);
            bool held = body->supports[x > 0.0] != SUPPORT_FREE;
            if (held && fabs(x) >= (0.5 - near) * body->span)
                return body;
        }
    return NULL;
}

/* Why no mode takes part. */
static void explain_no_modes(const struct problem *problem, const struct assembly *assembly,
                             struct text *reason)
{
    const struct body *held = body_at_node(problem);
    if (held) {
        text_format(reason, "; the modes of %s have a node at the contact, where it is held",
                    held->id);
    } else {
        text_add(reason, "; no mode takes enough of the blow to matter (lowest ");
        text_add_number(reason, assembly->lowest_omitted / (2.0 * M_PI), 4);
        text_add(reason, " Hz)");
    }
    text_add(reason, ": static flexibility only");
}

static void explain_modes(const struct problem *problem, const struct assembly *assembly,
                          struct text *reason)
{
    if (assembly->all_modes) {
        text_add(reason, "; ");
        text_add_count(reason, assembly->all_modes);
        text_add(reason, " modes up to ");
        text_add_number(reason, assembly->highest / (2.0 * M_PI), 4);
        text_add(reason, " Hz, residual flexibility for the others");
    } else if (isfinite(assembly->lowest_omitted)) {
        explain_no_modes(problem, assembly, reason);
    }
}

static void fill_model(const struct problem *problem, const struct solution *solution,
                       struct solve_result *result)
{
    /* the models in use */
    result->contact_model = contact_model_used(problem)->model;
    result->compliance = problem->compliance.used;
    result->method = problem->request->options.method;
    result->delassus_source =
        problem->from_client ? PERCUSS_DELASSUS_CLIENT : PERCUSS_DELASSUS_SERVICE;
    const struct assembly *assembly = solution->assembly;
    /* why, in words */
    struct text reason = text_begin(result->reason, sizeof result->reason);
    contact_model_explain(problem, &solution->outcome, &reason);
    unstated_explain(problem, &solution->outcome, &reason);
    explain_modes(problem, assembly, &reason);
    if (radiation_is_in(problem, &assembly->scene))
        text_add(&reason, "; waves leave through the half-space: their energy counts as damping");
    if (solution->error.states.restitution > 0.0)
        text_format(&reason, "; what the states are wrong by changes the restitution by %.2g",
                    solution->error.states.restitution);
    if (problem->compliance.reason[0])
        text_format(&reason, "; half-space: %s", problem->compliance.reason);
    /* effects that it omits */
    result->omitted_error =
        solution->error.modes.restitution + assembly->radiated_error + validity_wave_loss(problem) +
        law_error_worst(problem, &solution->outcome) * largest_restitution(result) +
        loss_worst(problem, &solution->outcome);
}

/* A body of which every mode that a file holds or that is computed takes part, or NULL. */
static const struct body *all_of_one(const struct problem *problem, const struct assembly *assembly)
{
    for (size_t b = 0; b < problem->body_count; b++)
        if (body_is_solid(problem->bodies[b]) && assembly->offered[b] > 0 &&
            assembly->offered[b] == modal_family_most(problem->bodies[b], 0))
            return problem->bodies[b];
    return NULL;
}

/* Why the estimated error is no smaller: the end of the search for its larger part, or else the
 * cause that amplifies small differences. */
static const char *reason_of_error(const struct problem *problem, const struct solution *solution)
{
    const struct assembly *assembly = solution->assembly;
    bool sequence = problem->contact_count > 1 || solution->outcome.tracks[0].count > 1;
    bool modes = solution->error.modes.restitution > solution->error.steps.restitution;
    bool omitted = isfinite(assembly->lowest_omitted);
    /* the end of the search */
    if (solution->spent || solution->outcome.end_reason == PERCUSS_END_LIMIT)
        return "the effort allowed is spent";
    if (solution->tolerance_met && solution->scene->plain)
        return "plain friction of a contact that sticks answers to every mode that is left out "
               "(options.friction micro-slip does not)";
    if (solution->tolerance_met)
        return "the states that the bodies begin from are as wrong as the answers that left them";
    if (!solution->error.steps.energy_closes)
        return "the shortest steps allowed do not keep the energy";
    /* the limit of the modes, or an amplified effect of the omitted ones */
    if (modes && omitted && problem->compliance.most > 0)
        return "more modes of the mesh would leave too negative a compliance for so stiff a "
               "contact";
    const struct body *all = all_of_one(problem, assembly);
    if (modes && omitted && all && all->ritz)
        return "the modes that are computed of a block or cylinder are too few for so short a "
               "contact: a mesh may have more, a half-space lets waves leave";
    if (modes && omitted && all)
        return "the modes in the body's file are too few: reduce its mesh to a higher frequency";
    if (modes && omitted && assembly->capped)
        return sequence ? "the most modes that are tried of a body are too few for what the "
                          "sequence of sub-impacts makes of the others"
                        : "the most modes that are tried of a body are too few";
    if (modes && omitted && !assembly->adjustable)
        return "the catalogue fixes the number of modes";
    if (modes && problem->compliance.still)
        return "waves that leave through half-spaces are left out: a contact is too stiff for "
               "them, or too many share them";
    /* or an amplification */
    return sequence ? "the sequence of sub-impacts amplifies small differences"
                    : "the search for more modes or shorter steps ended";
}

/* Warns of the range of the solutions near an answer that does not meet its tolerance. */
static void warn_range(const struct problem *problem, const struct solution *solution,
                       struct solve_result *result)
{
    const struct neighbours *neighbours = solution->neighbours;
    size_t widest = 0;
    double width = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        if (neighbours->high[c] - neighbours->low[c] >
            width) { /* false: NAN, it has no restitution */
            width = neighbours->high[c] - neighbours->low[c];
            widest = c;
        }
    if (!(width > 0.0))
        return;
    /* of numbers around one, as many digits as tell the ends apart */
    int digits = (int)fmin(17.0, fmax(9.0, 2.0 - floor(log10(width))));
    report_warn(result,
                "contacts[%zu].restitution: %.*g: solutions near this one span %.*g to %.*g",
                widest, digits, outcome_restitution(problem, &solution->outcome, widest), digits,
                neighbours->low[widest], digits, neighbours->high[widest]);
}

/* Warns of counts that these solutions do not confirm. */
static void warn_counts(const struct problem *problem, const struct solution *solution,
                        struct solve_result *result)
{
    const struct neighbours *neighbours = solution->neighbours;
    for (size_t c = 0; c < problem->contact_count; c++)
        if (neighbours->fewest[c] != neighbours->most[c])
            report_warn(result,
                        "contacts[%zu].sub_impact_count: %zu: uncertain: solutions near this one "
                        "count %zu to %zu",
                        c, solution->outcome.tracks[c].count, neighbours->fewest[c],
                        neighbours->most[c]);
}

static void fill_errors(const struct problem *problem, const struct solution *solution,
                        struct solve_result *result)
{
    total_report(problem, solution, result);
    result->restitution_by_speed = solution->restitution_by_speed;
    for (size_t t = 0; t < 2; t++)
        result->impulse_tangential_by_speed[t] = solution->tangential_by_speed[t];
    result->energy = solution->outcome.energy;
    result->time_shift = solution->outcome.time_shift;
    result->window = solution->outcome.window;
    /* why it is not met */
    if (!result->tolerance_met) {
        report_warn(
            result,
            "error.tolerance_met: false: the estimated error of the restitution is %.2g: %s",
            result->restitution_time + result->restitution_modes,
            reason_of_error(problem, solution));
        warn_range(problem, solution, result);
    }
    warn_counts(problem, solution, result);
}

static void fill_end(const struct solution *solution, struct solve_result *result)
{
    static const char *const why[] = {
        [PERCUSS_END_HORIZON] = "the horizon was reached before vibration could cause no further "
                                "contact: the restitution is not final",
        [PERCUSS_END_IN_CONTACT] =
            "the horizon was reached inside a contact: the restitution is not "
            "final",
        [PERCUSS_END_LIMIT] = "the effort allowed was spent: the restitution is not final",
    };
    result->end_reason = solution->outcome.end_reason;
    result->complete = outcome_is_complete(&solution->outcome);
    result->status = result->complete ? PERCUSS_OK : PERCUSS_TRUNCATED;
    if (!result->complete)
        fault_set(&result->fault, result->status, "%s", why[result->end_reason]);
}

static bool is_finite(const struct solve_result *result)
{
    double sum = result->energy.closure + result->window + result->time_shift;
    for (size_t c = 0; c < result->contact_count; c++)
        sum += result->contacts[c].impulse + result->contacts[c].end_time;
    return isfinite(sum);
}

void report_fill(const struct problem *problem, const struct solution *solution,
                 struct solve_result *result)
{
    /* the answer */
    fill_contacts(problem, solution, result);
    fill_bodies(problem, solution, result);
    fill_errors(problem, solution, result);
    fill_model(problem, solution, result);
    warn_dents(result);
    fill_end(solution, result);
    /* limits of the models */
    struct warnings warnings;
    validity_find(problem, &solution->outcome, &warnings);
    validity_find_waves(problem, solution->assembly->radiated_error, &warnings);
    report_warnings(&warnings, result);
    /* numbers outside all bounds */
    if (!outcome_keeps_energy(solution->error.steps.energy_defect))
        result->status =
            fault_set(&result->fault, PERCUSS_INTERNAL,
                      "energy.closure: %.3g J of %.3g J available: the solution does not "
                      "keep the energy and is not to be used",
                      result->energy.closure, result->energy.available);
    if (!is_finite(result))
        result->status = fault_set(&result->fault, PERCUSS_INTERNAL,
                                   "no finite answer: the numbers of the request are out of scale");
}

/* Compliance between two rows on a body, that no mode of the scene holds. */
static double residual_of_side(const struct problem *problem, const struct assembly *assembly,
                               const struct row_side *a, size_t row_a, const struct row_side *b,
                               size_t row_b)
{
    double sum = 0.0;
    const struct body *body = problem->bodies[a->body];
    for (size_t f = 0; f < body->kind->family_count; f++)
        sum += modal_compliance(body, f, &a->load->family[f], &b->load->family[f]);
    for (size_t g = 0; g < assembly->scene.groups; g++) {
        const struct scene_group *group = &assembly->groups[g];
        const double *phi = group->participation[row_a];
        const double *other = group->participation[row_b];
        if (group->body != a->body)
            continue;
        for (size_t k = group->count; phi && other && k-- > 0;)
            sum -= phi[k] * other[k] / (group->set->omega[k] * group->set->omega[k]);
    }
    return sum;
}

/* The part of the coupling of a contact's normal with all rows that goes through side `which`. */
static void share_of_side(const struct problem *problem, const struct assembly *assembly, size_t c,
                          int which, double *w, double *residual)
{
    size_t rows = problem_rows(problem);
    const struct row_side side = problem_row_side(problem, c, which);
    residual[c * rows + c] = problem->compliance.sides[c][which];
    for (size_t j = 0; j < rows; j++) {
        for (int q = 0; q < 2; q++) {
            const struct row_side other = problem_row_side(problem, j, q);
            if (other.body != side.body)
                continue;
            w[c * rows + j] += rigid_inverse_mass(problem->bodies[side.body], side.point,
                                                  side.direction, other.point, other.direction);
            residual[c * rows + j] += residual_of_side(problem, assembly, &side, c, &other, j);
        }
    }
}

static double velocity_along_normal(const struct solve_request *request, size_t contact,
                                    size_t body)
{
    const struct solve_contact *at = &request->contacts[contact];
    const struct solve_body *moving = &request->bodies[body];
    double arm[3];
    double turning[3];
    sub3(at->point, moving->position, arm);
    cross3(moving->angular_velocity, arm, turning);
    return dot3(at->normal, moving->velocity) + dot3(at->normal, turning);
}

/* Shares of the two bodies in each contact; unknown with the client's own W. */
static bool trace_find_sides(const struct problem *problem, const struct assembly *assembly,
                             struct trace_sides *sides)
{
    struct arena *arena = problem->arena;
    size_t n = problem->contact_count;
    *sides = (struct trace_sides){0};
    for (int s = 0; s < 2 && !problem->from_client; s++) {
        /* the four arrays of this side */
        size_t rows = problem_rows(problem);
        double *w = arena_take(arena, rows * rows, sizeof *w);
        double *residual = arena_take(arena, rows * rows, sizeof *residual);
        double *velocity = arena_take(arena, n, sizeof *velocity);
        size_t *body = arena_take(arena, n, sizeof *body);
        if (!w || !residual || !velocity || !body)
            return false;
        /* contact by contact */
        for (size_t c = 0; c < n; c++) {
            body[c] = problem->sides[c][s].body;
            velocity[c] = velocity_along_normal(problem->request, c, body[c]);
            share_of_side(problem, assembly, c, s, w, residual);
        }
        sides->w[s] = w;
        sides->residual[s] = residual;
        sides->velocity[s] = velocity;
        sides->body[s] = body;
    }
    return true;
}

/* Work allowed for the traced solution; an answer that was cut off is cut off again. */
static double trace_work(const struct solution *solution)
{
    double allowed = attempt_work_allowed(PERCUSS_METHOD_MODAL);
    double taken = impact_work(&solution->assembly->scene, &solution->outcome);
    return solution->outcome.end_reason == PERCUSS_END_LIMIT ? fmin(taken, allowed) : allowed;
}

/* Warns where the effort ended the histories, and where the answer came from another method. */
static void trace_warn(const struct problem *problem, const struct solution *solution,
                       const struct impact_outcome *again, struct solve_result *result)
{
    const struct trace *trace = result->trace;
    double last = trace->time[trace->count - 1];
    /* the last instant that is kept may lie a little before the end */
    if (last < result->window - TRACE_LAST_INSTANT * fabs(result->window)) {
        report_warn(result,
                    "options.trace: the histories end at %g s of %g s: the effort allowed for them "
                    "was spent",
                    last, result->window);
        return;
    }
    /* another method, another answer */
    double off = outcome_compare(problem, again, &solution->outcome).restitution;
    if (off > TRACE_SAME_METHOD)
        report_warn(result,
                    "options.trace: the histories are the modal method's, whose restitution "
                    "differs by %.2g from the answer",
                    off);
}

enum percuss_status report_trace(const struct problem *problem, const struct solution *solution,
                                 struct pace *pace, struct solve_result *result)
{
    struct arena *arena = problem->arena;
    const struct scene *scene = &solution->assembly->scene;
    struct force_log log = force_log_make(arena, scene->rows);
    log.dents = true;
    struct impact_settings settings = {.accuracy = solution->step_accuracy,
                                       .horizon = attempt_horizon(problem, scene),
                                       .max_work = trace_work(solution),
                                       .log = &log,
                                       .pace = pace,
                                       .profile = solution->step_profile};
    /* the closed form of a rigid pair is exact */
    if (impact_is_rigid_pair(scene))
        settings.accuracy = fmin(settings.accuracy, TRACE_CLOSED_FORM);
    /* the same solution once more, with a log of its forces */
    struct impact_outcome again;
    struct trace_sides sides;
    struct trace *trace = arena_take(arena, 1, sizeof *trace);
    enum percuss_status status = PERCUSS_INTERNAL;
    if (trace && impact_create(&again, scene, arena) &&
        trace_find_sides(problem, solution->assembly, &sides))
        status = impact_modal(scene, &settings, arena, &again);
    if (!status)
        status =
            trace_make(&(struct trace_task){scene, &log, &sides, again.time_shift, again.window,
                                            attempt_work_allowed(PERCUSS_METHOD_MODAL), pace},
                       arena, trace);
    if (status) {
        result->status = pace_fault(&result->fault, status);
        return result->status;
    }
    result->trace = trace;
    trace_warn(problem, solution, &again, result);
    return result->status;
}
