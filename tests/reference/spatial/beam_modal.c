/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/beam_modal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps between two checks of the energies. */
static const size_t LOOK_EVERY = 100;
/* Of a force: halving the bounds alone takes 40. */
enum { MOST_ITERATIONS = 100 };
/* Last change of an indentation over the overlap. */
static const double SETTLED = 1e-12;

bool beam_modal_create(const struct beam_plane *plane, double sphere, size_t modes,
                       struct beam_modal *modal)
{
    *modal = (struct beam_modal){.mass = {plane->line_mass * plane->length, sphere}};
    struct beam_mode *all = calloc(2 * modes, sizeof *all);
    modal->omega = calloc(modes, sizeof(double));
    modal->share = calloc(modes, sizeof(double));
    if (!all || !modal->omega || !modal->share) {
        free(all);
        beam_modal_free(modal);
        return false;
    }
    /* even and odd ones alternate, but where those above the cut-off mix with those below */
    beam_modes(plane, 2 * modes, all);
    struct beam_load load = {.x = 0.0, .force = 1.0};
    modal->compliance = modal->residual = beam_compliance(plane, &load, &load);
    for (size_t k = 0; k < 2 * modes && modal->modes < modes; k++) {
        double share, rotation;
        beam_mode_at(plane, &all[k], 0.0, &share, &rotation);
        if (share == 0.0)
            continue;
        modal->omega[modal->modes] = all[k].omega;
        modal->share[modal->modes++] = share;
        modal->residual -= share * share / (all[k].omega * all[k].omega);
    }
    free(all);
    return true;
}

void beam_modal_free(struct beam_modal *modal)
{
    free(modal->omega);
    free(modal->share);
    memset(modal, 0, sizeof *modal);
}

static double press_patch(void *context, double overlap, double series)
{
    return patch_press(context, overlap, series);
}

struct beam_modal_contact beam_modal_patch(struct patch *patch)
{
    return (struct beam_modal_contact){press_patch, patch};
}

/* Newton's method for F = law(overlap - series F), with bounds, as the left side less the right
 * rises with F */
static double press_law(void *context, double overlap, double series)
{
    const struct contact_law *law = context;
    double low = 0.0, high = overlap, depth = 0.5 * overlap, slope;
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        double force = law->operations->force(law, depth, &slope);
        double excess = depth + series * force - overlap;
        *(excess > 0.0 ? &high : &low) = depth;
        double next = depth - excess / (1.0 + series * slope);
        next = next > low && next < high ? next : 0.5 * (low + high);
        if (fabs(next - depth) <= SETTLED * overlap)
            return law->operations->force(law, next, &slope);
        depth = next;
    }
    return NAN;
}

struct beam_modal_contact beam_modal_law(const struct contact_law *law)
{
    return (struct beam_modal_contact){press_law, (void *)law};
}

/* Gap of the rigid bodies and each mode's coordinate, driven by the force that opens the gap:
 *     gap'' = W F,  q'' + w^2 q = share F,  indentation = -(gap + sum share q) - residual F. */
struct state {
    const struct beam_modal *modal;
    double step, mobility; /* s, W in 1/kg */
    double gap, rate;
    double *q, *v;
    /* of each mode over a step: its rotation, and its response to a force that rises to 1 N */
    double *cosine, *sine, *rise, *rise_rate;
    double series; /* m/N, of all that gives way to such a force by the step's end */
};

static bool state_create(const struct beam_modal *modal, double step, double approach,
                         struct state *state)
{
    /* at rest, approaching as rigid bodies */
    size_t n = modal->modes;
    double *room = calloc(6 * n, sizeof(double));
    *state = (struct state){.modal = modal,
                            .step = step,
                            .mobility = 1.0 / modal->mass[0] + 1.0 / modal->mass[1],
                            .rate = -approach,
                            .q = room};
    if (!room)
        return false;
    /* rows of one array */
    state->v = room + n;
    state->cosine = room + 2 * n;
    state->sine = room + 3 * n;
    state->rise = room + 4 * n;
    state->rise_rate = room + 5 * n;
    /* motion by a force that rises to 1 N in a step: rigid and residual, then by each mode */
    state->series = modal->residual + state->mobility * step * step / 6.0;
    for (size_t k = 0; k < n; k++) {
        double w = modal->omega[k], angle = w * step;
        state->cosine[k] = cos(angle);
        state->sine[k] = sin(angle);
        state->rise[k] = modal->share[k] * (1.0 - sin(angle) / angle) / (w * w);
        state->rise_rate[k] = modal->share[k] * (1.0 - cos(angle)) / (w * angle);
        state->series += modal->share[k] * state->rise[k];
    }
    return true;
}

/* The state after a step in which the force falls from `before` to nothing. A force that stays is
 * one that falls and one that rises. */
static void fall(struct state *state, double before)
{
    const struct beam_modal *modal = state->modal;
    double h = state->step;
    state->gap += h * state->rate + state->mobility * before * h * h / 3.0;
    state->rate += state->mobility * before * h / 2.0;
    for (size_t k = 0; k < modal->modes; k++) {
        double w = modal->omega[k], q = state->q[k], v = state->v[k];
        double stays = modal->share[k] * (1.0 - state->cosine[k]) / (w * w);
        double stays_rate = modal->share[k] * state->sine[k] / w;
        state->q[k] =
            q * state->cosine[k] + v * state->sine[k] / w + before * (stays - state->rise[k]);
        state->v[k] = v * state->cosine[k] - q * w * state->sine[k] +
                      before * (stays_rate - state->rise_rate[k]);
    }
}

static void rise(struct state *state, double after)
{
    double h = state->step;
    state->gap += state->mobility * after * h * h / 6.0;
    state->rate += state->mobility * after * h / 2.0;
    for (size_t k = 0; k < state->modal->modes; k++) {
        state->q[k] += after * state->rise[k];
        state->v[k] += after * state->rise_rate[k];
    }
}

static double bent(const struct state *state)
{
    double sum = 0.0;
    for (size_t k = 0; k < state->modal->modes; k++)
        sum += state->modal->share[k] * state->q[k];
    return sum;
}

/* quantities of the report, from the state */
static void describe(const struct state *state, double approach, struct collision *now)
{
    const double *mass = state->modal->mass;
    now->speed[PAIR_BEAM] = -now->impulse / mass[PAIR_BEAM];
    now->speed[PAIR_SPHERE] = now->impulse / mass[PAIR_SPHERE] - approach;
    for (int b = 0; b < 2; b++)
        now->place[b] += state->step * now->speed[b];
    now->middle = now->place[PAIR_BEAM] - bent(state);
}

static void look(const struct state *state, double approach, struct collision *now)
{
    now->available = 0.5 * approach * approach / state->mobility;
    now->rebound = 0.5 * state->rate * state->rate / state->mobility;
    now->vibration = 0.0;
    for (size_t k = 0; k < state->modal->modes; k++) {
        double w = state->modal->omega[k], q = state->q[k], v = state->v[k];
        now->vibration += 0.5 * (v * v + w * w * q * q);
    }
    now->restitution = now->impulse * state->mobility / approach - 1.0;
    now->over = now->force == 0.0 && state->rate > 0.0 &&
                state->gap > sqrt(2.0 * now->vibration * state->modal->compliance);
}

enum percuss_status beam_modal_run(const struct beam_modal *modal,
                                   const struct beam_modal_contact *contact,
                                   const struct beam_modal_settings *settings,
                                   struct collision *now, struct fault *fault)
{
    struct state state;
    memset(now, 0, sizeof *now);
    if (!state_create(modal, settings->step, settings->approach, &state))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory for %zu modes", modal->modes);
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 1; status == PERCUSS_OK && !now->over && now->time < settings->horizon; i++) {
        /* first with a force that falls to 0 at the step's end, then with the force there added */
        double before = now->force, after = 0.0;
        fall(&state, before);
        double overlap = -(state.gap + bent(&state));
        if (overlap > 0.0)
            after = contact->press(contact->context, overlap, state.series);
        if (isnan(after)) {
            status = fault_set(fault, PERCUSS_INTERNAL, "no force was found at %g s", now->time);
            break;
        }
        rise(&state, after);
        now->time += settings->step;
        collision_keep(now, before, after, settings->step);
        describe(&state, settings->approach, now);
        now->contact_steps += after > 0.0;
        now->flight_steps += after == 0.0;
        if (settings->record)
            settings->record(settings->context, 0, now);
        if (i % LOOK_EVERY == 0)
            look(&state, settings->approach, now);
    }
    look(&state, settings->approach, now);
    free(state.q);
    return status;
}
