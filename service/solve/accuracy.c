/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/accuracy.h"

#include <math.h>
#include <string.h>

/* Each level of the search takes modes up to a frequency higher by this factor. */
static const double CUT_RATIO = 1.6;
/* What remains above a cut against the difference to the level below. Once the error falls like the
 * cut-off frequency to the power of -2 (rod: -2.8) that is 1/(1.6^2 - 1) = 0.64; with a handful of
 * modes it does not yet, and four times as much covers 19 of 20 random scenes (docs/accuracy.md).
 */
static const double REMAINDER = 2.5;
/* The same where the level below has no modes at all. */
static const double RIGID_REMAINDER = 2.0;
enum { MAX_RAISES = 6, MAX_TIGHTENINGS = 3, MAX_SCENE_MODES = 1200 };
/* Finest accuracy of the time steps that is tried. */
static const double FINEST = 1e-17;
/* Steps times (modes + 16 contacts^3) of all solutions of a request: about a second by the modal
 * method, whose steps cost some 20 ns of that each; CVODE's right-hand sides are many more and
 * cheaper. */
static const double MAX_WORK = 4e7;
static const double MAX_WORK_CVODE = 4e9;

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
    double *work; /* left for the request, see MAX_WORK */
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
        .max_work = *search->work,
    };
    if (settings.horizon == 0.0)
        settings.horizon = default_horizon(scene);
    if (!impact_create(&attempt->outcome, scene, search->arena))
        return PERCUSS_INTERNAL;
    enum percuss_status status;
    if (search->request->options.method == PERCUSS_METHOD_CVODE)
        status = impact_cvode(scene, &settings, search->arena, &attempt->outcome);
    else if (impact_is_rigid_pair(scene))
        status = impact_rigid_pair(scene, &settings, search->arena, &attempt->outcome);
    else
        status = impact_modal(scene, &settings, search->arena, &attempt->outcome);
    *search->work -= impact_work(scene, &attempt->outcome);
    return status;
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
    double error = accuracy->restitution_modes * (RIGID_REMAINDER / REMAINDER);
    if (coarse->assembly->all_modes == 0 && best->assembly->all_modes > 0 &&
        error <= 0.7 * search->tolerance) {
        *best = *coarse;
        accuracy->restitution_modes = error;
        accuracy->impulse_modes *= RIGID_REMAINDER / REMAINDER;
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

/* Relative change of the first sub-impact's impulse from one solution to the next, of the contact
 * where it is largest: what the later ones amplify. */
static double first_change(const struct search *search, const struct attempt *from,
                           const struct attempt *to)
{
    double worst = 0.0;
    for (size_t c = 0; c < search->geometry->contact_count; c++) {
        const struct track *x = &from->outcome.tracks[c];
        const struct track *y = &to->outcome.tracks[c];
        if (!x->count || !y->count)
            continue;
        double change = (y->list[0].impulse - x->list[0].impulse) / y->list[0].impulse;
        if (fabs(change) > fabs(worst))
            worst = change;
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

/* A sequence amplifies errors, and not evenly: a shift of the speed that changes the first
 * sub-impact as much as, and in the direction in which, its error does shows by how much here. */
static enum percuss_status amplify(const struct search *search, const struct attempt *best,
                                   double change, struct accuracy *accuracy)
{
    struct attempt shifted = *best;
    double e;
    double p;
    double shift = fmax(-0.5, fmin(change, 0.5));
    enum percuss_status status = shifted_run(search, best, 1.0 + shift, &shifted);
    if (status)
        return status;
    difference(search, best, &shifted, &e, &p);
    accuracy->restitution_modes = fmax(accuracy->restitution_modes, e);
    accuracy->impulse_modes = fmax(accuracy->impulse_modes, p);
    accuracy->amplification = fmax(1.0, e / fabs(shift));
    return PERCUSS_OK;
}

/* Compares two levels. Differences can vanish by accident: the error is not taken to be below a
 * tenth of what the cut-off aims at. */
static enum percuss_status estimate_modes(const struct search *search, const struct attempt *coarse,
                                          const struct attempt *best, struct accuracy *accuracy)
{
    difference(search, best, coarse, &accuracy->restitution_modes, &accuracy->impulse_modes);
    accuracy->restitution_modes *= REMAINDER;
    accuracy->impulse_modes *= REMAINDER;
    accuracy->amplification = 1.0;
    if (best->assembly->lowest_omitted < INFINITY)
        accuracy->restitution_modes = fmax(accuracy->restitution_modes, 0.03 * search->tolerance);
    double change = REMAINDER * first_change(search, coarse, best);
    bool spent = best->outcome.end_reason == PERCUSS_END_LIMIT;
    if (!is_sequence(search, best) || change == 0.0 || spent)
        return PERCUSS_OK;
    return amplify(search, best, change, accuracy);
}

/* Whether a contact bends a beam: then a sequence of sub-impacts is likely. */
static bool may_bend(const struct search *search)
{
    for (size_t c = 0; c < search->geometry->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const bool *acts = search->geometry->sides[c][which].load.acts;
            if (acts[FAMILY_BENDING_Y] || acts[FAMILY_BENDING_Z])
                return true;
        }
    return false;
}

/* Two levels with the same modes of a body say nothing about those it lacks: the cut that adds one
 * to each such body, 0 when there is none. */
static double unverified(const struct search *search, const struct attempt *coarse,
                         const struct attempt *best)
{
    double next = 0.0;
    for (size_t b = 0; b < search->geometry->body_count; b++) {
        double omitted = best->assembly->omitted[b];
        if (isfinite(omitted) && coarse->assembly->modes[b] == best->assembly->modes[b])
            next = fmax(next, omitted);
    }
    return next;
}

/* More modes until those left out matter less than the tolerance. */
static enum percuss_status search_modes(const struct search *search, double duration,
                                        struct attempt *best, struct accuracy *accuracy)
{
    struct attempt coarse = *best;
    accuracy->restitution_modes = 0.0;
    best->choice.cut =
        may_bend(search) ? sequence_cut(search, duration) : single_cut(search, duration);
    coarse.choice.cut = best->choice.cut / CUT_RATIO;
    coarse.choice.fixed_share = 1.0 / CUT_RATIO;
    enum percuss_status status = attempt_solve(search, &coarse);
    if (status || coarse.outcome.always_overlapped) {
        *best = coarse;
        return status;
    }
    if (!may_bend(search) && is_sequence(search, &coarse)) {
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
        double next = status ? 0.0 : unverified(search, &coarse, best);
        bool same = next > 0.0;
        bool none_left = !status && best->assembly->lowest_omitted == INFINITY;
        if (status || none_left || capped || best->outcome.end_reason == PERCUSS_END_LIMIT ||
            (!same && accuracy->restitution_modes <= 0.7 * search->tolerance) ||
            raise >= MAX_RAISES || best->assembly->all_modes > MAX_SCENE_MODES)
            break;
        coarse = *best;
        /* the next mode at least, or nothing would change */
        best->choice.cut = fmax(best->choice.cut * CUT_RATIO, next);
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

/* Share of the energy that the solution gains or loses. What acceleration takes may leave next to
 * nothing available: the approach counts too. */
static double energy_defect(const struct search *search, const struct attempt *attempt)
{
    const struct impact_energy *energy = &attempt->outcome.energy;
    return fabs(energy->closure) / fmax(energy->available, approach_energy(search));
}

/* Effect of the time steps on the restitution without a second solution: the energy that the phases
 * gain or lose, as if all of it were the rebound's (e^2 is its share of what is available), and not
 * less than what the accuracy asked for has been seen to leave (docs/accuracy.md). */
static double error_of_steps(const struct search *search, const struct attempt *best,
                             double amplification)
{
    double rebound = 0.2;
    for (size_t c = 0; c < search->geometry->contact_count; c++) {
        double e = accuracy_restitution(search->geometry, &best->outcome, c);
        if (isfinite(e))
            rebound = fmax(rebound, 2.0 * fabs(e));
    }
    double defect = energy_defect(search, best);
    return amplification * fmax(4.0 * defect / rebound, 0.1 * pow(best->accuracy, 0.8));
}

/* Compares with a solution of longer steps where the tolerance is tight, estimates otherwise. */
static enum percuss_status estimate_steps(const struct search *search, const struct attempt *best,
                                          struct accuracy *accuracy)
{
    double largest = 0.0;
    for (size_t c = 0; c < search->geometry->contact_count; c++)
        largest = fmax(largest, search->geometry->impulse_compression[c]);
    if (search->tolerance >= 1e-5) {
        accuracy->restitution_time = error_of_steps(search, best, accuracy->amplification);
        accuracy->impulse_time = accuracy->restitution_time * largest;
        return PERCUSS_OK;
    }
    struct attempt coarse = *best;
    coarse.accuracy *= 100.0;
    enum percuss_status status = run(search, &coarse, &best->assembly->scene);
    if (!status)
        difference(search, best, &coarse, &accuracy->restitution_time, &accuracy->impulse_time);
    return status;
}

/* Shorter steps until they matter less than the tolerance and the energy audit closes. */
static enum percuss_status search_steps(const struct search *search, struct attempt *best,
                                        struct accuracy *accuracy)
{
    double closure_allowed = search->tolerance <= 1e-8 ? 1e-9 : 10.0 * search->tolerance;
    enum percuss_status status = PERCUSS_OK;
    for (int i = 0; !status; i++) {
        status = estimate_steps(search, best, accuracy);
        accuracy->energy_defect = energy_defect(search, best);
        accuracy->energy_closes = accuracy->energy_defect <= closure_allowed;
        bool enough =
            accuracy->restitution_time <= 0.3 * search->tolerance && accuracy->energy_closes;
        if (status || enough || i >= MAX_TIGHTENINGS || best->accuracy < 1.01 * FINEST ||
            best->outcome.end_reason == PERCUSS_END_LIMIT)
            break;
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
    double work = request->options.method == PERCUSS_METHOD_CVODE ? MAX_WORK_CVODE : MAX_WORK;
    struct search search = {
        geometry, request, cache, memory, tolerance > 0.0 ? tolerance : 1e-3, &work,
    };
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
