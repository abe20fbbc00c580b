/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Thousands of random scenes against what must hold for every answer; prints the worst cases.
 *   campaign [FIRST [COUNT [--ring]]]   a campaign; --ring strikes each body a second time while it
 *                                       rings from the first
 *   campaign NUMBER 1                   one scene, with its numbers
 * Not a ctest: it measures. Exit 1 when an invariant fails. */
#include <time.h>

#include "physics/hard/campaign_scene.h"

enum measure {
    WALL,
    PROCESSOR,
    CLOSURE,        /* relative, of any answer */
    CLOSURE_BROKEN, /* beyond what the tolerance asks for although tolerance_met */
    ABOVE_ONE,      /* e > 1 of bodies at rest without acceleration */
    BELOW_ZERO,     /* an impulse that pulls */
    NOT_FINITE,
    MOMENTUM,        /* of two free bodies, relative */
    PROMISE_BROKEN,  /* error over tolerance although tolerance_met */
    ESTIMATE_LOW,    /* error over reported error */
    MESSAGE_MISSING, /* a refusal or a cut answer without words */
    INTERNAL_FAULT,
    MEASURES
};

static const struct {
    const char *name;
    double allowed; /* more is a defect; INFINITY: only measured */
} measures[MEASURES] = {
    [WALL] = {"wall time, s", INFINITY},
    [PROCESSOR] = {"processor time, s", INFINITY},
    [CLOSURE] = {"energy closure / available", 0.1}, /* ten times the loosest tolerance drawn */
    [CLOSURE_BROKEN] = {"closure / allowed, tolerance met", 1.0},
    [ABOVE_ONE] = {"e - 1, closed passive system", 0.0},
    [BELOW_ZERO] = {"-impulse / compression impulse", 0.0},
    [NOT_FINITE] = {"numbers that are not finite", 0.0},
    [MOMENTUM] = {"momentum lost / impulse", 1e-9},
    [PROMISE_BROKEN] = {"error / tolerance, tolerance met", 1.0},
    [ESTIMATE_LOW] = {"error / reported error", INFINITY},
    [MESSAGE_MISSING] = {"no message", 0.0},
    [INTERNAL_FAULT] = {"INTERNAL", 0.0},
};

enum { KEPT = 6 };
struct worst {
    double value[KEPT];
    uint64_t number[KEPT];
    char text[KEPT][320];
    unsigned long beyond, counted;
};

struct campaign {
    struct lab *lab;
    struct worst worst[MEASURES];
    unsigned long statuses[PERCUSS_STATUS_COUNT], ends[PERCUSS_END_COUNT], met, answered;
    bool chatty;
};

static double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void note(struct campaign *campaign, enum measure which, double value, uint64_t number,
                 const char *text)
{
    struct worst *worst = &campaign->worst[which];
    worst->counted++;
    if (isnan(value))
        value = INFINITY;
    worst->beyond += value > measures[which].allowed;
    for (int i = 0; i < KEPT; i++) {
        if (worst->text[i][0] && value <= worst->value[i])
            continue;
        for (int j = KEPT - 1; j > i; j--) {
            worst->value[j] = worst->value[j - 1];
            worst->number[j] = worst->number[j - 1];
            memcpy(worst->text[j], worst->text[j - 1], sizeof worst->text[j]);
        }
        worst->value[i] = value;
        worst->number[i] = number;
        snprintf(worst->text[i], sizeof worst->text[i], "%s", text);
        return;
    }
}

static unsigned count_not_finite(const struct solve_result *result)
{
    const struct impact_energy *energy = &result->energy;
    const double numbers[] = {energy->available,        energy->rigid_after,
                              energy->vibration,        energy->damping,
                              energy->stored,           energy->closure,
                              result->window,           result->time_shift,
                              result->restitution_time, result->restitution_modes,
                              result->omitted_error};
    unsigned count = 0;
    for (size_t i = 0; i < COUNT(numbers); i++)
        count += !isfinite(numbers[i]);
    for (size_t c = 0; c < result->contact_count; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        count += !isfinite(contact->impulse) || !isfinite(contact->end_time);
        count += contact->impulse_compression > 0.0 && !isfinite(contact->restitution);
        for (size_t i = 0; i < contact->sub_impacts_listed; i++) {
            const struct sub_impact *sub = &contact->sub_impacts[i];
            count += !isfinite(sub->start) || !isfinite(sub->end) || !isfinite(sub->impulse) ||
                     !isfinite(sub->peak_force) || !isfinite(sub->max_indentation);
        }
    }
    for (size_t b = 0; b < result->body_count; b++)
        for (int i = 0; i < 3 && result->velocities_known; i++)
            count += !isfinite(result->bodies[b].velocity[i]);
    return count;
}

/* |sum m dv| over the impulses, where both bodies are free. */
static double momentum_lost(const struct lab *lab, const struct solve_request *request,
                            const struct solve_result *result)
{
    double sum[3] = {0.0, 0.0, 0.0};
    double scale = 0.0;
    for (size_t b = 0; b < result->body_count; b++) {
        const struct body *body = body_set_find(&lab->set, request->bodies[b].id);
        if (!isfinite(body->mass) || body->supports[0] || body->supports[1])
            return 0.0;
        for (int i = 0; i < 3; i++)
            sum[i] += body->mass * (result->bodies[b].velocity[i] - request->bodies[b].velocity[i]);
        /* what rounding of the velocities themselves leaves */
        scale += 1e-6 * body->mass * norm3(request->bodies[b].velocity);
    }
    for (size_t c = 0; c < result->contact_count; c++)
        scale += result->contacts[c].impulse;
    return scale > 0.0 ? norm3(sum) / scale : 0.0;
}

static double approach_energy(const struct solve_result *result)
{
    double sum = 0.0;
    for (size_t c = 0; c < result->contact_count; c++) {
        double p = result->contacts[c].impulse_compression;
        sum += 0.5 * p * p * result->contacts[c].inverse_effective_mass;
    }
    return sum;
}

static void check_answer(struct campaign *campaign, uint64_t number, const struct drawn *drawn,
                         const struct solve_result *result)
{
    double tolerance = drawn->request.options.tolerance;
    double allowed = tolerance <= 1e-8 ? 1e-9 : 10.0 * tolerance;
    double scale = fmax(result->energy.available, approach_energy(result));
    double closure = fabs(result->energy.closure) / scale;
    note(campaign, NOT_FINITE, count_not_finite(result), number, drawn->text);
    note(campaign, CLOSURE, closure, number, drawn->text);
    if (result->tolerance_met)
        note(campaign, CLOSURE_BROKEN, closure / allowed, number, drawn->text);
    for (size_t c = 0; c < result->contact_count; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        double compression =
            contact->impulse_compression > 0.0 ? contact->impulse_compression : 1.0;
        note(campaign, BELOW_ZERO, -contact->impulse / compression, number, drawn->text);
        /* what the tolerance leaves open, and rounding of the quotient */
        if (drawn->passive && result->complete)
            note(campaign, ABOVE_ONE,
                 contact->restitution - 1.0 - (result->tolerance_met ? tolerance : 0.0) - 1e-12,
                 number, drawn->text);
    }
    if (result->velocities_known)
        note(campaign, MOMENTUM, momentum_lost(campaign->lab, &drawn->request, result), number,
             drawn->text);
}

/* The same scene a thousand times tighter; the answer's own promise is judged by it. */
static void check_promise(struct campaign *campaign, uint64_t number, const struct drawn *drawn,
                          const struct solve_result *loose)
{
    static struct solve_result tight;
    struct solve_request request = drawn->request;
    request.options.tolerance = fmax(1e-3 * request.options.tolerance, 1e-10);
    if (solve(campaign->lab->workspace, &campaign->lab->set, &request, &tight) ||
        !tight.tolerance_met)
        return;
    double error = 0.0;
    for (size_t c = 0; c < tight.contact_count; c++)
        if (tight.contacts[c].impulse_compression > 0.0)
            error = fmax(error, fabs(tight.contacts[c].impulse - loose->contacts[c].impulse) /
                                    tight.contacts[c].impulse_compression);
    double reported = loose->restitution_time + loose->restitution_modes;
    if (campaign->chatty)
        printf("  error against tight %.3g, reported %.3g\n", error, reported);
    if (loose->tolerance_met)
        note(campaign, PROMISE_BROKEN, error / drawn->request.options.tolerance, number,
             drawn->text);
    note(campaign, ESTIMATE_LOW, error / fmax(reported, 1e-12), number, drawn->text);
}

static void print_answer(const struct drawn *drawn, const struct solve_result *result)
{
    printf("  %s\n  %s %s complete %d met %d error %.3g + %.3g\n  %s\n", drawn->text,
           status_name(result->status), end_reason_name(result->end_reason), result->complete,
           result->tolerance_met, result->restitution_time, result->restitution_modes,
           result->status ? result->fault.text : result->reason);
    for (size_t c = 0; c < result->contact_count; c++)
        printf("  contact %zu: e %.12g impulse %.6g sub-impacts %zu last end %.6g s\n", c,
               result->contacts[c].restitution, result->contacts[c].impulse,
               result->contacts[c].sub_impact_count, result->contacts[c].end_time);
    printf("  available %.6g closure %.3g damping %.3g window %.4g s shift %.3g s\n",
           result->energy.available, result->energy.closure, result->energy.damping, result->window,
           result->time_shift);
    for (size_t b = 0; b < result->body_count; b++)
        printf("  body %zu: %s, %u modes\n", b, result->bodies[b].theory, result->bodies[b].modes);
    for (size_t w = 0; w < result->warning_count; w++)
        printf("  warning: %s\n", result->warnings[w]);
}

static void run_scene(struct campaign *campaign, uint64_t number, struct drawn *drawn,
                      struct solve_result *result)
{
    double wall = seconds(CLOCK_MONOTONIC);
    double processor = seconds(CLOCK_PROCESS_CPUTIME_ID);
    solve(campaign->lab->workspace, &campaign->lab->set, &drawn->request, result);
    processor = seconds(CLOCK_PROCESS_CPUTIME_ID) - processor;
    wall = seconds(CLOCK_MONOTONIC) - wall;
    note(campaign, WALL, wall, number, drawn->text);
    note(campaign, PROCESSOR, processor, number, drawn->text);
    campaign->statuses[result->status]++;
    note(campaign, INTERNAL_FAULT, result->status == PERCUSS_INTERNAL, number, drawn->text);
    note(campaign, MESSAGE_MISSING, result->status && !result->fault.text[0], number, drawn->text);
    if (campaign->chatty)
        print_answer(drawn, result);
    if (result->status != PERCUSS_OK && result->status != PERCUSS_TRUNCATED)
        return;
    campaign->answered++;
    campaign->met += result->tolerance_met;
    campaign->ends[result->end_reason]++;
    check_answer(campaign, number, drawn, result);
}

static struct body_state *copy_state(const struct body_state *state)
{
    struct body_state *copy = state ? malloc(body_state_size(state)) : NULL;
    if (copy)
        memcpy(copy, state, body_state_size(state));
    return copy;
}

/* Strikes again while the bodies ring; the second answer is judged. */
static void ring(struct campaign *campaign, uint64_t number, struct drawn *drawn,
                 struct solve_result *result)
{
    struct body_state *states[PERCUSS_MAX_BODIES] = {0};
    uint64_t r = number + 77;
    if (solve(campaign->lab->workspace, &campaign->lab->set, &drawn->request, result))
        return;
    for (size_t b = 0; b < result->body_count; b++) {
        states[b] = copy_state(result->bodies[b].state_after);
        drawn->request.bodies[b].state = states[b];
        drawn->request.bodies[b].elapsed = log_between(&r, 1e-6, 1.0);
    }
    drawn->passive = false;
    strcat(drawn->text, " ringing");
    run_scene(campaign, number, drawn, result);
    for (size_t b = 0; b < COUNT(states); b++)
        free(states[b]);
}

static int summary(const struct campaign *campaign)
{
    int failed = 0;
    printf("\nanswered %lu, tolerance met %lu\n", campaign->answered, campaign->met);
    for (unsigned s = 0; s < PERCUSS_STATUS_COUNT; s++)
        if (campaign->statuses[s])
            printf("  %s %lu\n", status_name(s), campaign->statuses[s]);
    for (unsigned e = 0; e < PERCUSS_END_COUNT; e++)
        if (campaign->ends[e])
            printf("  %s %lu\n", end_reason_name(e), campaign->ends[e]);
    for (int m = 0; m < MEASURES; m++) {
        const struct worst *worst = &campaign->worst[m];
        failed += worst->beyond > 0;
        printf("%s: %lu of %lu beyond %g\n", measures[m].name, worst->beyond, worst->counted,
               measures[m].allowed);
        for (int i = 0; i < KEPT && worst->text[i][0] && (worst->beyond || m <= CLOSURE || i == 0);
             i++)
            printf("    %.4g  scene %llu: %s\n", worst->value[i],
                   (unsigned long long)worst->number[i], worst->text[i]);
    }
    return failed != 0;
}

int main(int count, char **words)
{
    static struct campaign campaign;
    static struct solve_result result;
    static struct drawn drawn;
    uint64_t first = count > 1 ? strtoull(words[1], NULL, 10) : 0;
    uint64_t scenes = count > 2 ? strtoull(words[2], NULL, 10) : 3000;
    bool ringing = count > 3 && strcmp(words[3], "--ring") == 0;
    campaign.lab = lab_create();
    campaign.chatty = scenes == 1;
    for (uint64_t n = first; n < first + scenes; n++) {
        draw_scene(campaign.lab, n, &drawn);
        if (ringing)
            ring(&campaign, n, &drawn, &result);
        else
            run_scene(&campaign, n, &drawn, &result);
        if (result.status != PERCUSS_OK || ringing || n % 2)
            continue;
        check_promise(&campaign, n, &drawn, &result);
    }
    int failed = summary(&campaign);
    lab_free(campaign.lab);
    return failed;
}
