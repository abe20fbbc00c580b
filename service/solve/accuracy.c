/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/accuracy.h"

#include <math.h>
#include <string.h>

/* Each level of the search takes modes up to a frequency higher by this factor. */
static const double CUT_RATIO = 1.6;
/* The error of the restitution falls at least like the cut-off frequency to the power of -2 (rod:
 * -2.8): what remains above the cut is at most this share of the difference between two levels,
 * 1/(1.6^2 - 1) = 0.64. */
static const double REMAINDER = 0.64;
enum { MAX_RAISES = 6, MAX_TIGHTENINGS = 3, MAX_SCENE_MODES = 1200 };
/* Finest accuracy of the time steps that is tried. */
static const double FINEST = 1e-17;
/* One solution: steps times modes. About a tenth of a second by the modal method. */
static const double MAX_WORK = 2e7;
/* CVODE's steps are cheaper and many more. */
static const double MAX_WORK_CVODE = 2e9;

/* One solution and what it was made with. */
struct attempt {
    struct assembly *assembly;
    struct impact_outcome outcome;
    struct assemble_choice choice;
    double accuracy;
};

struct search {
    const struct geometry *geometry;
    const struct solve_request *request;
    struct prepared_cache *cache;
    struct arena *arena;
    double tolerance;
};

double accuracy_restitution(const struct geometry *geometry, const struct impact_outcome *outcome,
                            size_t contact)
{
    double compression = geometry->impulse_compression[contact];
    return compression > 0.0 ? outcome->tracks[contact].impulse / compression - 1.0 : NAN;
}

/* The shortest duration of any contact as rigid bodies, s. */
static double contact_duration(const struct search *search, const struct scene *scene)
{
    double shortest = INFINITY;
    for (size_t c = 0; c < scene->contacts; c++)
        if (search->geometry->gap_rate[c] < 0.0)
            shortest = fmin(shortest, impact_scale_of(scene, c, scene->gap_rate[c]).duration);
    /* indentation over speed; the contact lasts 2.94 times that (Hertz) */
    return 2.94 * shortest;
}

/* Cut-off at which a rod's error is about a third of the tolerance: measured on the paper's rod,
 * 8e-5 at omega T = 31 and 1.2e-5 at 62, so error = 8e-5 (31/(omega T))^2.8. */
static double single_cut(const struct search *search, double duration)
{
    double angle = 31.0 * pow(8e-5 / (search->tolerance / 3.0), 1.0 / 2.8);
    return fmax(angle, 4.0) / duration;
}

/* The same for a sequence of sub-impacts, which amplifies what the first one misses: on the paper's
 * beam the median error is 2e-4 at omega T = 45 and falls with the third power. */
static double sequence_cut(const struct search *search, double duration)
{
    return 45.0 * fmax(1.0, cbrt(2e-4 / (search->tolerance / 3.0))) / duration;
}

/* Relative accuracy of the time steps for a tolerance: the audit must close to 1e-9 where the
 * tolerance is 1e-8 or less. */
static double first_accuracy(double tolerance)
{
    return fmax(tolerance <= 1e-8 ? 1e-3 * tolerance : 0.1 * tolerance, FINEST);
}

static double default_horizon(const struct scene *scene)
{
    return fmax(0.020, 2.0 * scene_longest_period(scene));
}

static enum percuss_status run(const struct search *search, struct attempt *attempt,
                               const struct scene *scene)
{
    struct impact_settings settings = {
        .accuracy = attempt->accuracy,
        .horizon = search->request->options.horizon,
        .max_work =
            search->request->options.method == PERCUSS_METHOD_CVODE ? MAX_WORK_CVODE : MAX_WORK,
    };
    if (settings.horizon == 0.0)
        settings.horizon = default_horizon(scene);
    if (!impact_create(&attempt->outcome, scene, search->arena))
        return PERCUSS_INTERNAL;
    if (search->request->options.method == PERCUSS_METHOD_CVODE)
        return impact_cvode(scene, &settings, search->arena, &attempt->outcome);
    if (impact_is_rigid_pair(scene))
        return impact_rigid_pair(scene, &settings, search->arena, &attempt->outcome);
    return impact_modal(scene, &settings, search->arena, &attempt->outcome);
}

/* No touch lies behind an overlap: the request contradicts itself. */
static enum percuss_status refuse_overlap(const struct search *search, struct fault *fault)
{
    size_t deepest = 0;
    for (size_t c = 1; c < search->geometry->contact_count; c++)
        if (search->request->contacts[c].gap < search->request->contacts[deepest].gap)
            deepest = c;
    const struct solve_contact *contact = &search->request->contacts[deepest];
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "contacts[%zu].gap: %g m: the bodies overlap, and at the stated gap rate (%g m/s), "
        "acceleration and vibration they never touched before",
        deepest, contact->gap, search->geometry->gap_rate[deepest]);
}

static enum percuss_status attempt_solve(const struct search *search, struct attempt *attempt)
{
    attempt->assembly = arena_take(search->arena, 1, sizeof *attempt->assembly);
    if (!attempt->assembly || !assemble(attempt->assembly, search->geometry, search->request,
                                        search->cache, &attempt->choice, search->arena))
        return PERCUSS_INTERNAL;
    return run(search, attempt, &attempt->assembly->scene);
}

/* Largest difference between two solutions over the contacts. */
static void difference(const struct search *search, const struct attempt *a,
                       const struct attempt *b, double *restitution, double *impulse)
{
    *restitution = 0.0;
    *impulse = 0.0;
    for (size_t c = 0; c < search->geometry->contact_count; c++) {
        double change = fabs(a->outcome.tracks[c].impulse - b->outcome.tracks[c].impulse);
        double compression = search->geometry->impulse_compression[c];
        *impulse = fmax(*impulse, change);
        if (compression > 0.0)
            *restitution = fmax(*restitution, change / compression);
    }
}

/* Modes that turn out not to matter leave: a body without any is rigid. */
static void prefer_rigid(const struct search *search, const struct attempt *coarse,
                         struct attempt *best, struct accuracy *accuracy)
{
    double error = accuracy->restitution_modes / REMAINDER;
    if (coarse->assembly->all_modes == 0 && best->assembly->all_modes > 0 &&
        error <= 0.7 * search->tolerance) {
        *best = *coarse;
        accuracy->restitution_modes = error;
        accuracy->impulse_modes /= REMAINDER;
    }
}

/* Whether a contact closes more than once. */
static bool is_sequence(const struct search *search, const struct attempt *attempt)
{
    for (size_t c = 0; c < search->geometry->contact_count; c++)
        if (attempt->outcome.tracks[c].count > 1)
            return true;
    return false;
}

/* Relative difference of the first sub-impacts: what the later ones amplify. */
static double first_difference(const struct search *search, const struct attempt *a,
                               const struct attempt *b)
{
    double worst = 0.0;
    for (size_t c = 0; c < search->geometry->contact_count; c++) {
        const struct track *x = &a->outcome.tracks[c];
        const struct track *y = &b->outcome.tracks[c];
        if (x->count && y->count)
            worst = fmax(worst, fabs(x->list[0].impulse - y->list[0].impulse) / x->list[0].impulse);
    }
    return worst;
}

/* A solution with all gap rates scaled, compared at equal restitution scale. */
static enum percuss_status shifted_run(const struct search *search, const struct attempt *base,
                                       double factor, struct attempt *shifted)
{
    size_t n = search->geometry->contact_count;
    struct scene scene = base->assembly->scene;
    double *scaled = arena_take(search->arena, n, sizeof *scaled);
    if (!scaled)
        return PERCUSS_INTERNAL;
    for (size_t c = 0; c < n; c++)
        scaled[c] = factor * scene.gap_rate[c];
    scene.gap_rate = scaled;
    enum percuss_status status = run(search, shifted, &scene);
    for (size_t c = 0; !status && c < n; c++)
        shifted->outcome.tracks[c].impulse /= factor;
    return status;
}

/* A sequence amplifies errors, and not evenly: a shift of the speed as large as the first
 * sub-impact's error shows by how much here. */
static enum percuss_status amplified_error(const struct search *search, const struct attempt *best,
                                           double relative, double *restitution, double *impulse)
{
    for (int side = 0; side < 2; side++) {
        struct attempt shifted = *best;
        double e;
        double p;
        enum percuss_status status =
            shifted_run(search, best, side == 0 ? 1.0 - relative : 1.0 + relative, &shifted);
        if (status)
            return status;
        difference(search, best, &shifted, &e, &p);
        *restitution = fmax(*restitution, e);
        *impulse = fmax(*impulse, p);
    }
    return PERCUSS_OK;
}

static enum percuss_status estimate_modes(const struct search *search, const struct attempt *coarse,
                                          const struct attempt *best, struct accuracy *accuracy)
{
    difference(search, best, coarse, &accuracy->restitution_modes, &accuracy->impulse_modes);
    accuracy->restitution_modes *= REMAINDER;
    accuracy->impulse_modes *= REMAINDER;
    double first = REMAINDER * first_difference(search, best, coarse);
    bool spent = best->outcome.end_reason == PERCUSS_END_LIMIT;
    if (!is_sequence(search, best) || first == 0.0 || spent)
        return PERCUSS_OK;
    return amplified_error(search, best, first, &accuracy->restitution_modes,
                           &accuracy->impulse_modes);
}

/* More modes until those left out matter less than the tolerance. */
static enum percuss_status search_modes(const struct search *search, double duration,
                                        struct attempt *best, struct accuracy *accuracy)
{
    struct attempt coarse = *best;
    accuracy->restitution_modes = 0.0;
    coarse.choice.cut = single_cut(search, duration) / CUT_RATIO;
    coarse.choice.fixed_share = 1.0 / CUT_RATIO;
    enum percuss_status status = attempt_solve(search, &coarse);
    if (status || coarse.outcome.always_overlapped) {
        *best = coarse;
        return status;
    }
    best->choice.cut = coarse.choice.cut * CUT_RATIO;
    if (is_sequence(search, &coarse)) {
        best->choice.cut = sequence_cut(search, duration);
        coarse.choice.cut = best->choice.cut / CUT_RATIO;
        status = attempt_solve(search, &coarse);
    }
    for (int raise = 0; !status; raise++) {
        status = attempt_solve(search, best);
        bool capped = !status && best->assembly->capped;
        if (capped) {
            /* no more to be had: the estimate needs a solution with fewer */
            coarse.choice.cut = best->assembly->highest / CUT_RATIO;
            status = attempt_solve(search, &coarse);
        }
        if (!status)
            status = estimate_modes(search, &coarse, best, accuracy);
        bool same = !status && coarse.assembly->all_modes == best->assembly->all_modes;
        bool none_left = !status && best->assembly->lowest_omitted == INFINITY;
        if (status || none_left || capped || best->outcome.end_reason == PERCUSS_END_LIMIT ||
            (!same && accuracy->restitution_modes <= 0.7 * search->tolerance) ||
            raise >= MAX_RAISES || best->assembly->all_modes > MAX_SCENE_MODES)
            break;
        coarse = *best;
        /* the next mode at least, or nothing would change */
        best->choice.cut =
            fmax(best->choice.cut * CUT_RATIO, same ? coarse.assembly->lowest_omitted : 0.0);
    }
    if (!status)
        prefer_rigid(search, &coarse, best, accuracy);
    return status;
}

/* Energy that stops the approach, J. */
static double approach_energy(const struct search *search)
{
    double sum = 0.0;
    for (size_t c = 0; c < search->geometry->contact_count; c++)
        sum += 0.5 * search->geometry->impulse_compression[c] * fabs(search->geometry->gap_rate[c]);
    return sum;
}

/* Shorter steps until they matter less than the tolerance and the energy audit closes. */
static enum percuss_status search_steps(const struct search *search, struct attempt *best,
                                        struct accuracy *accuracy)
{
    double closure_allowed = search->tolerance <= 1e-8 ? 1e-9 : 10.0 * search->tolerance;
    struct attempt coarse = *best;
    coarse.accuracy *= 100.0;
    enum percuss_status status = run(search, &coarse, &best->assembly->scene);
    for (int i = 0; !status; i++) {
        difference(search, best, &coarse, &accuracy->restitution_time, &accuracy->impulse_time);
        const struct impact_energy *energy = &best->outcome.energy;
        /* what acceleration takes may leave next to nothing available: compare with the approach
         * too */
        accuracy->energy_closes =
            fabs(energy->closure) <=
            closure_allowed * fmax(energy->available, approach_energy(search));
        if ((accuracy->restitution_time <= 0.3 * search->tolerance && accuracy->energy_closes) ||
            i >= MAX_TIGHTENINGS || best->accuracy < 1.01 * FINEST ||
            best->outcome.end_reason == PERCUSS_END_LIMIT)
            break;
        coarse = *best;
        best->accuracy = fmax(best->accuracy / 100.0, FINEST);
        status = run(search, best, &best->assembly->scene);
    }
    return status;
}

/* d(restitution)/d(speed) of the contact with the largest impulse, by central difference with all
 * gap rates scaled. */
static enum percuss_status find_conditioning(const struct search *search,
                                             const struct attempt *best, struct accuracy *accuracy)
{
    const double step = 1e-5;
    size_t n = search->geometry->contact_count;
    size_t main_contact = 0;
    for (size_t c = 1; c < n; c++)
        if (best->outcome.tracks[c].impulse > best->outcome.tracks[main_contact].impulse)
            main_contact = c;
    double restitution[2];
    for (int side = 0; side < 2; side++) {
        struct attempt shifted = *best;
        shifted.accuracy = fmin(best->accuracy, 1e-9);
        enum percuss_status status =
            shifted_run(search, best, side == 0 ? 1.0 - step : 1.0 + step, &shifted);
        if (status)
            return status;
        restitution[side] = accuracy_restitution(search->geometry, &shifted.outcome, main_contact);
    }
    accuracy->restitution_by_speed = (restitution[1] - restitution[0]) /
                                     (2.0 * step * fabs(search->geometry->gap_rate[main_contact]));
    return PERCUSS_OK;
}

enum percuss_status accuracy_solve(struct accuracy *accuracy, const struct geometry *geometry,
                                   const struct solve_request *request,
                                   struct prepared_cache *cache, struct arena *memory,
                                   struct fault *fault)
{
    double tolerance = request->options.tolerance;
    struct search search = {geometry, request, cache, memory, tolerance > 0.0 ? tolerance : 1e-3};
    struct attempt best = {.choice = {0.0, 1.0}, .accuracy = first_accuracy(search.tolerance)};
    memset(accuracy, 0, sizeof *accuracy);
    accuracy->restitution_by_speed = NAN;

    /* without any mode: for the contacts' scales only */
    struct assembly *rigid = arena_take(memory, 1, sizeof *rigid);
    struct assemble_choice no_modes = {0.0, 0.0};
    if (!rigid || !assemble(rigid, geometry, request, cache, &no_modes, memory))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    double duration = contact_duration(&search, &rigid->scene);
    enum percuss_status status = search_modes(&search, duration, &best, accuracy);
    if (!status && best.outcome.always_overlapped)
        return refuse_overlap(&search, fault);
    if (!status)
        status = search_steps(&search, &best, accuracy);
    if (!status && request->options.conditioning)
        status = find_conditioning(&search, &best, accuracy);
    if (status)
        return fault_set(fault, status, "out of memory");
    accuracy->assembly = best.assembly;
    accuracy->outcome = best.outcome;
    accuracy->tolerance_met =
        accuracy->energy_closes &&
        accuracy->restitution_time + accuracy->restitution_modes <= search.tolerance;
    return PERCUSS_OK;
}
