/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/campaign.h"

#include <time.h>

#include "model/ritz_store.h"
#include "physics/estimates/invariants.h"

/* Of a solution by CVODE: its right-hand sides are many and cheap. Its steps follow the highest
 * frequency: more modes take minutes. */
static const double CVODE_EFFORT = 2e8;
static const size_t CVODE_MODES = 200;
const double campaign_tolerances[CAMPAIGN_TOLERANCES] = {1e-2, 1e-3, 1e-4};
static const struct {
    const char *name;
    size_t most;
} strata[CAMPAIGN_STRATA] = {{"1", 1}, {"2-9", 9}, {"10-29", 29}, {">=30", SIZE_MAX}};

/* Of one scene. */
struct answers {
    struct solve_result results[CAMPAIGN_TOLERANCES];
    struct verdict verdicts[CAMPAIGN_TOLERANCES];
    size_t modes;
};

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void print_earlier(size_t number, const struct solve_result *result)
{
    printf("  blow %zu: e %.9f +- %.3g, met %d, %zu sub-impacts\n", number + 1,
           result->contacts[0].restitution, result->restitution_time + result->restitution_modes,
           result->tolerance_met, result->contacts[0].sub_impact_count);
}

static void print_answer(const struct solve_result *result, const struct verdict *verdict)
{
    printf("  tolerance %g: %s %s, met %d, true error %.3g, reported %.3g (time %.3g, modes %.3g), "
           "impulse error %.3g N s, reported %.3g, %zu sub-impacts, %.1f ms\n    %s\n",
           verdict->tolerance, status_name(result->status), end_reason_name(result->end_reason),
           verdict->met, verdict->true_error, verdict->reported, result->restitution_time,
           result->restitution_modes, verdict->true_impulse_error, verdict->reported_impulse,
           verdict->sub_impacts, 1e3 * verdict->seconds,
           result->status ? result->fault.text : result->reason);
    for (size_t c = 0; c < result->contact_count; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        printf("    contact %zu: e %.9f, %zu sub-impacts, impulse %.9g +- %.2g (models %.2g) N s\n",
               c, result->contacts[c].restitution, result->contacts[c].sub_impact_count,
               result->contacts[c].impulse, result->contacts[c].impulse_error,
               result->contacts[c].impulse_error_model);
        printf("      tangential impulse %.9g %.9g +- %.2g (models %.2g) N s\n",
               contact->impulse_tangential[0], contact->impulse_tangential[1],
               contact->impulse_tangential_error, contact->impulse_tangential_error_model);
    }
    for (size_t w = 0; w < result->warning_count; w++)
        printf("    warning: %s\n", result->warnings[w]);
}

/* The blows before the one that is judged, by token. False: refused. */
static bool strike_earlier(struct campaign *campaign, struct scene_drawn *scene, double tolerance,
                           struct solve_result *result)
{
    struct lab *lab = campaign->lab;
    double window = 0.0;
    for (size_t i = 0; i <= scene->earlier_count; i++) {
        /* from where the one before left them, whose end is not that of the reference's */
        bool last = i == scene->earlier_count;
        struct solve_request blow = last ? scene->plain : scene->earlier[i];
        blow.options.tolerance = tolerance;
        for (size_t b = 0; i && b < blow.body_count; b++) {
            blow.bodies[b].state = scene->states[b];
            blow.bodies[b].elapsed -= window;
            if (blow.bodies[b].state && blow.bodies[b].elapsed < 0.0)
                return false;
        }
        if (last) {
            scene->request = blow;
            return true;
        }
        enum percuss_status status = solve(lab->workspace, &lab->means, &blow, result);
        if (status != PERCUSS_OK)
            return false;
        if (campaign->settings.chatty)
            print_earlier(i, result);
        window = result->window;
        for (size_t b = 0; b < result->body_count; b++)
            scene_take_state(result->bodies[b].state_after, &scene->states[b]);
    }
    return true;
}

/* Answers at one tolerance. False: refused. */
static bool answer(struct campaign *campaign, struct scene_drawn *scene, double tolerance,
                   struct solve_result *result, struct verdict *verdict)
{
    if (scene->earlier_count && !strike_earlier(campaign, scene, tolerance, result))
        return false;
    scene->request.options.tolerance = tolerance;
    double before = seconds();
    enum percuss_status status =
        solve(campaign->lab->workspace, &campaign->lab->means, &scene->request, result);
    *verdict = (struct verdict){.tolerance = tolerance, .seconds = seconds() - before};
    if (status != PERCUSS_OK && status != PERCUSS_TRUNCATED) {
        if (campaign->settings.chatty)
            printf("  refused: %s %s\n", status_name(status), result->fault.text);
        return false;
    }
    verdict->met = result->tolerance_met;
    verdict->reported = result->restitution_time + result->restitution_modes;
    verdict->reported_impulse = result->impulse_time + result->impulse_modes;
    for (size_t c = 0; c < result->contact_count; c++)
        verdict->sub_impacts += result->contacts[c].sub_impact_count;
    for (size_t b = 0; b < result->body_count; b++)
        verdict->modes += result->bodies[b].modes;
    return true;
}

/* The largest error of a tangential impulse over what modes, steps and cells state. */
static double tangential_share(const struct truth *truth, const struct solve_result *result)
{
    double worst = 0.0;
    for (size_t c = 0; c < truth->contacts; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        const double *t = contact->impulse_tangential, *right = truth->tangential[c];
        double given = contact->impulse_tangential_error - contact->impulse_tangential_error_model +
                       truth->impulse_spread + truth->tangential_spread;
        double error = hypot(t[0] - right[0], t[1] - right[1]);
        worst = fmax(worst, error > 0.0 ? error / given : 0.0);
    }
    return worst;
}

static void judge(const struct campaign *campaign, const struct truth *truth, bool found,
                  const struct solve_result *result, struct verdict *verdict)
{
    double impulse[PERCUSS_MAX_CONTACTS];
    double given[PERCUSS_MAX_CONTACTS]; /* by modes and steps */
    bool solved = true;
    for (size_t c = 0; c < result->contact_count; c++) {
        impulse[c] = result->contacts[c].impulse;
        given[c] = result->contacts[c].impulse_error - result->contacts[c].impulse_error_model;
        solved = solved && !(isnan(result->contacts[c].restitution) &&
                             result->contacts[c].impulse_compression > 0.0);
    }
    verdict->spread = found ? truth->spread : INFINITY;
    verdict->true_error = !solved ? NAN : found ? truth_distance(truth, impulse) : INFINITY;
    verdict->true_impulse_error = found ? truth_impulse_distance(truth, impulse) : INFINITY;
    verdict->impulse_spread = found ? truth->impulse_spread : INFINITY;
    verdict->impulses = found && truth_covers_impulses(truth, impulse, given);
    verdict->velocities = found && truth_covers_velocities(truth, impulse, given);
    verdict->tangential_share = found ? tangential_share(truth, result) : INFINITY;
    verdict->true_sub_impacts = truth->sub_impacts;
    if (campaign->settings.chatty)
        print_answer(result, verdict);
}

static void compare(struct campaign *campaign, uint64_t number, double distance)
{
    campaign->compared++;
    campaign->apart += distance > TALLY_SETTLED * campaign_tolerances[CAMPAIGN_TOLERANCES - 1];
    if (distance > campaign->farthest) {
        campaign->farthest = distance;
        campaign->farthest_scene = number;
    }
}

static void check_by_cvode(struct campaign *campaign, const struct scene_drawn *scene,
                           uint64_t number, size_t modes, const struct truth *truth)
{
    struct truth other;
    const struct truth_settings settings = {.effort = CVODE_EFFORT,
                                            .modes = modes,
                                            .earlier = scene->earlier,
                                            .earlier_count = scene->earlier_count,
                                            .chatty = campaign->settings.chatty};
    if (modes > CVODE_MODES)
        return;
    if (!truth_by_cvode(campaign->room, &campaign->lab->set, &scene->plain, &settings, &other))
        return;
    compare(campaign, number, truth_distance(truth, other.impulse));
}

static size_t stratum_of(size_t sub_impacts)
{
    size_t stratum = 0;
    while (sub_impacts > strata[stratum].most)
        stratum++;
    return stratum;
}

static void list_verdict(const struct campaign *campaign, const struct verdict *verdict)
{
    printf("%s,%llu,%g,%d,%.4g,%.4g,%.4g,%zu,%zu,%zu,%.4g,%.4g\n",
           scene_class_word(campaign->settings.class), (unsigned long long)verdict->scene,
           verdict->tolerance, verdict->met, verdict->reported, verdict->true_error,
           verdict->spread, verdict->sub_impacts, verdict->true_sub_impacts, verdict->modes,
           verdict->seconds, verdict->tangential_share);
}

/* All three answers; `modes`: the most that a body took. False: refused. */
static bool answer_all(struct campaign *campaign, struct scene_drawn *scene, uint64_t number,
                       struct answers *answers)
{
    answers->modes = 8;
    for (int t = 0; t < CAMPAIGN_TOLERANCES; t++) {
        struct solve_result *result = &answers->results[t];
        struct verdict *verdict = &answers->verdicts[t];
        bool answered = answer(campaign, scene, campaign_tolerances[t], result, verdict);
        verdict->scene = number;
        const char *broken = invariant_broken(result, campaign_tolerances[t]);
        if (broken)
            printf("BROKEN: %s %llu at %g: %s\n", scene_class_word(campaign->settings.class),
                   (unsigned long long)number, campaign_tolerances[t], broken);
        campaign->broken += broken != NULL;
        if (!answered)
            return false;
        for (size_t b = 0; b < result->body_count; b++)
            if (result->bodies[b].modes > answers->modes)
                answers->modes = result->bodies[b].modes;
    }
    return true;
}

/* Contacts with friction: an answer at a hundredth of the tightest tolerance, with more cells. */
static bool find_by_answer(struct campaign *campaign, const struct scene_drawn *scene,
                           struct truth *truth)
{
    static struct solve_result result;
    struct lab *lab = campaign->lab;
    struct solve_request request = scene->plain;
    request.options.tolerance = 0.01 * campaign_tolerances[CAMPAIGN_TOLERANCES - 1];
    if (solve(lab->workspace, &lab->means, &request, &result))
        return false;
    truth_by_answer(&result, truth);
    return true;
}

/* Answers have the waves of half-spaces where the tolerance asks for them; CVODE's scene has none.
 */
static bool has_waves(const struct body_set *set)
{
    for (size_t b = 0; b < set->count; b++)
        if (set->bodies[b].kind == &half_space_kind)
            return true;
    return false;
}

static bool has_friction(enum scene_class class)
{
    return class == CLASS_OBLIQUE || class == CLASS_RUBBED;
}

/* CVODE judges alone where two of its solutions agree within the effort, and our own reference is
 * compared with it; elsewhere, as where bodies have a loss, that one judges. CVODE has no plain
 * friction: there solutions below solve() judge, none of whose choices is an answer's. */
static bool find_oblique(struct campaign *campaign, const struct scene_drawn *scene,
                         uint64_t number, const struct truth_settings *wanted, struct truth *truth)
{
    struct truth cvode;
    const double settled = TALLY_SETTLED * campaign_tolerances[CAMPAIGN_TOLERANCES - 1];
    if (campaign->settings.plain)
        return truth_find(campaign->room, &campaign->lab->set, &scene->plain, wanted, truth);
    bool found = find_by_answer(campaign, scene, truth);
    bool by_cvode = campaign->settings.class != CLASS_RUBBED && wanted->modes <= CVODE_MODES &&
                    !has_waves(&campaign->lab->set) &&
                    truth_find(campaign->room, &campaign->lab->set, &scene->plain, wanted, &cvode);
    if (!by_cvode || cvode.spread > settled)
        return found;
    if (found && truth->spread <= settled)
        compare(campaign, number, truth_distance(&cvode, truth->impulse));
    *truth = cvode;
    campaign->by_cvode++;
    return true;
}

/* The reference begins with more modes than any answer took, and doubles them. */
static void judge_all(struct campaign *campaign, struct scene_drawn *scene, uint64_t number,
                      struct answers *answers)
{
    const struct campaign_settings *settings = &campaign->settings;
    const double tightest = campaign_tolerances[CAMPAIGN_TOLERANCES - 1];
    const bool oblique = has_friction(settings->class);
    const struct truth_settings wanted = {.goal = 0.2 * TALLY_SETTLED * tightest,
                                          .effort = settings->effort,
                                          .cvode = oblique && !settings->plain,
                                          .modes = answers->modes + 8,
                                          .earlier = scene->earlier,
                                          .earlier_count = scene->earlier_count,
                                          .chatty = settings->chatty};
    struct truth truth;
    bool found =
        oblique ? find_oblique(campaign, scene, number, &wanted, &truth)
                : truth_find(campaign->room, &campaign->lab->set, &scene->plain, &wanted, &truth);
    size_t stratum = found ? stratum_of(truth.sub_impacts) : 0;
    bool wrong = false;
    for (int t = 0; t < CAMPAIGN_TOLERANCES; t++) {
        struct verdict *verdict = &answers->verdicts[t];
        judge(campaign, &truth, found, &answers->results[t], verdict);
        wrong = tally_add(&campaign->all[t], verdict) || wrong;
        if (found)
            tally_add(&campaign->strata[stratum][t], verdict);
        if (settings->list)
            list_verdict(campaign, verdict);
    }
    campaign->wrong += wrong;
    if (found && !oblique && settings->cvode && number % settings->cvode == 0 &&
        truth.spread <= wanted.goal)
        check_by_cvode(campaign, scene, number, wanted.modes, &truth);
}

static void run_scene(struct campaign *campaign, uint64_t number)
{
    static struct scene_drawn scene;
    static struct answers answers;
    bool drawn = scene_draw(campaign->lab, campaign->settings.class, number, &scene);
    if (campaign->settings.plain)
        scene.plain.options.friction = scene.request.options.friction = PERCUSS_FRICTION_PLAIN;
    if (campaign->settings.chatty)
        printf("%s %llu: %s\n", scene_class_word(campaign->settings.class),
               (unsigned long long)number, scene.text);
    bool answered = drawn && answer_all(campaign, &scene, number, &answers);
    if (answered)
        judge_all(campaign, &scene, number, &answers);
    campaign->answered += answered;
    campaign->refused += !answered;
    scene_release(&scene);
}

void campaign_print(const struct campaign *campaign)
{
    bool csv = campaign->settings.csv;
    const char *word = scene_class_word(campaign->settings.class);
    for (int s = -1; s < CAMPAIGN_STRATA; s++) {
        char name[64];
        snprintf(name, sizeof name, "%s%s%s", word, s < 0 ? "" : " ", s < 0 ? "" : strata[s].name);
        for (int t = 0; t < CAMPAIGN_TOLERANCES; t++) {
            const struct tally *tally = s < 0 ? &campaign->all[t] : &campaign->strata[s][t];
            if (tally->judged + tally->unsettled + tally->unsolved)
                tally_print(stdout, tally, name, campaign_tolerances[t], csv);
        }
    }
    if (!csv && campaign->refused + campaign->broken)
        printf("%s: %zu refused, %zu broken invariants\n", word, campaign->refused,
               campaign->broken);
    for (int t = 0; !csv && has_friction(campaign->settings.class) && t < CAMPAIGN_TOLERANCES; t++)
        printf("%s: at %g tangential impulses of %zu in %zu are covered\n", word,
               campaign_tolerances[t], campaign->all[t].tangential, campaign->all[t].judged);
    if (!csv && campaign->by_cvode)
        printf("%s: CVODE judges %zu scenes\n", word, campaign->by_cvode);
    if (!csv && campaign->compared)
        printf("%s: %zu references compared with CVODE, %zu more than %g apart, farthest %.3g "
               "(scene %llu)\n",
               word, campaign->compared, campaign->apart,
               TALLY_SETTLED * campaign_tolerances[CAMPAIGN_TOLERANCES - 1], campaign->farthest,
               (unsigned long long)campaign->farthest_scene);
    fflush(stdout);
}

void campaign_run(struct campaign *campaign, const struct campaign_settings *settings)
{
    *campaign = (struct campaign){.settings = *settings, .lab = lab_create()};
    campaign->room = truth_room_create();
    assert_non_null(campaign->room);
    /* A solid's vibration takes seconds: references take the answers'. */
    campaign->lab->set.boxes = ritz_store_create(RITZ_STORE_BYTES);
    assert_non_null(campaign->lab->set.boxes);
    for (uint64_t n = settings->first; n < settings->first + settings->count; n++)
        run_scene(campaign, n);
}

void campaign_release(struct campaign *campaign)
{
    for (int t = 0; t < CAMPAIGN_TOLERANCES; t++) {
        tally_free(&campaign->all[t]);
        for (int s = 0; s < CAMPAIGN_STRATA; s++)
            tally_free(&campaign->strata[s][t]);
    }
    struct ritz_store *boxes = campaign->lab->set.boxes;
    truth_room_free(campaign->room);
    lab_free(campaign->lab);
    ritz_store_free(boxes);
}
