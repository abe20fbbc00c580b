/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How honest the error estimates are: random scenes of each class, answered at three tolerances
 * and compared with what they converge to (docs/accuracy.md).
 *   estimates [--class WORD] [--first N] [--count N] [--effort W] [--cvode K] [--csv | --list]
 *   estimates --class WORD --scene N         one scene, with everything
 * --effort: work of a scene's reference (impact_settings.max_work). --cvode K: every K-th scene's
 * reference is compared with CVODE's. --list: each answer as a line of CSV.
 * Exit 2: usage. */
#include <getopt.h>
#include <time.h>

#include "physics/estimates/drawn.h"
#include "physics/estimates/tally.h"
#include "physics/estimates/truth.h"

/* Of a solution by CVODE: its right-hand sides are many and cheap. */
static const double CVODE_EFFORT = 1e9;
static const double tolerances[] = {1e-2, 1e-3, 1e-4};
enum { TOLERANCES = COUNT(tolerances), STRATA = 4 };
static const struct {
    const char *name;
    size_t most;
} strata[STRATA] = {{"1", 1}, {"2-9", 9}, {"10-29", 29}, {">=30", SIZE_MAX}};

struct settings {
    enum scene_class class; /* CLASS_COUNT: all */
    uint64_t first, count;
    double effort;
    uint64_t cvode;
    bool csv, list, scene;
};

struct campaign {
    struct settings settings;
    struct lab *lab;
    struct truth_room *room;
    struct tally all[TOLERANCES];
    struct tally strata[STRATA][TOLERANCES];
    size_t refused, compared, apart;
    double farthest;
    uint64_t farthest_scene;
};

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
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
    for (size_t c = 0; c < result->contact_count; c++)
        printf("    contact %zu: e %.9f, %zu sub-impacts\n", c, result->contacts[c].restitution,
               result->contacts[c].sub_impact_count);
    for (size_t w = 0; w < result->warning_count; w++)
        printf("    warning: %s\n", result->warnings[w]);
}

/* Answers at one tolerance. False: refused. */
static bool answer(struct campaign *campaign, struct scene_drawn *scene, double tolerance,
                   struct solve_result *result, struct verdict *verdict)
{
    scene->request.options.tolerance = tolerance;
    double before = seconds();
    enum percuss_status status =
        solve(campaign->lab->workspace, &campaign->lab->set, &scene->request, result);
    *verdict = (struct verdict){.tolerance = tolerance, .seconds = seconds() - before};
    if (status != PERCUSS_OK && status != PERCUSS_TRUNCATED) {
        if (campaign->settings.scene)
            printf("  refused: %s %s\n", status_name(status), result->fault.text);
        return false;
    }
    verdict->met = result->tolerance_met;
    verdict->reported = result->restitution_time + result->restitution_modes;
    verdict->reported_impulse = result->impulse_time + result->impulse_modes;
    for (size_t c = 0; c < result->contact_count; c++)
        verdict->sub_impacts += result->contacts[c].sub_impact_count;
    return true;
}

static void judge(const struct campaign *campaign, const struct truth *truth, bool found,
                  const struct solve_result *result, struct verdict *verdict)
{
    double impulse[PERCUSS_MAX_CONTACTS];
    bool solved = true;
    for (size_t c = 0; c < result->contact_count; c++) {
        impulse[c] = result->contacts[c].impulse;
        solved = solved && !(isnan(result->contacts[c].restitution) &&
                             result->contacts[c].impulse_compression > 0.0);
    }
    verdict->spread = found ? truth->spread : INFINITY;
    verdict->true_error = !solved ? NAN : found ? truth_distance(truth, impulse) : INFINITY;
    verdict->true_impulse_error = found ? truth_impulse_distance(truth, impulse) : INFINITY;
    verdict->impulse_spread = found ? truth->impulse_spread : INFINITY;
    verdict->true_sub_impacts = truth->sub_impacts;
    if (campaign->settings.scene)
        print_answer(result, verdict);
}

static void check_by_cvode(struct campaign *campaign, const struct scene_drawn *scene,
                           uint64_t number, size_t modes, const struct truth *truth)
{
    struct truth other;
    struct truth_settings settings = {
        .effort = CVODE_EFFORT, .modes = modes, .chatty = campaign->settings.scene};
    if (!truth_by_cvode(campaign->room, &campaign->lab->set, &scene->plain, &settings, &other))
        return;
    double distance = truth_distance(truth, other.impulse);
    campaign->compared++;
    campaign->apart += distance > TALLY_SETTLED * tolerances[TOLERANCES - 1];
    if (distance > campaign->farthest) {
        campaign->farthest = distance;
        campaign->farthest_scene = number;
    }
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
    printf("%s,%llu,%g,%d,%.4g,%.4g,%.4g,%zu,%zu,%.4g\n",
           scene_class_word(campaign->settings.class), (unsigned long long)verdict->scene,
           verdict->tolerance, verdict->met, verdict->reported, verdict->true_error,
           verdict->spread, verdict->sub_impacts, verdict->true_sub_impacts, verdict->seconds);
}

/* The reference begins with more modes than the tightest answer took, and doubles them. */
static void run_scene(struct campaign *campaign, uint64_t number)
{
    static struct scene_drawn scene;
    static struct solve_result results[TOLERANCES];
    struct verdict verdicts[TOLERANCES];
    struct truth truth;
    const struct settings *settings = &campaign->settings;
    bool drawn = scene_draw(campaign->lab, settings->class, number, &scene);
    if (settings->scene)
        printf("%s %llu: %s\n", scene_class_word(settings->class), (unsigned long long)number,
               scene.text);
    size_t modes = 8;
    for (int t = 0; drawn && t < TOLERANCES; t++) {
        drawn = answer(campaign, &scene, tolerances[t], &results[t], &verdicts[t]);
        for (size_t b = 0; drawn && b < results[t].body_count; b++)
            modes = results[t].bodies[b].modes > modes ? results[t].bodies[b].modes : modes;
    }
    campaign->refused += !drawn;
    if (drawn) {
        struct truth_settings wanted = {.goal = 0.2 * TALLY_SETTLED * tolerances[TOLERANCES - 1],
                                        .effort = settings->effort,
                                        .modes = modes + 8,
                                        .chatty = settings->scene};
        bool found = truth_find(campaign->room, &campaign->lab->set, &scene.plain, &wanted, &truth);
        for (int t = 0; t < TOLERANCES; t++) {
            verdicts[t].scene = number;
            judge(campaign, &truth, found, &results[t], &verdicts[t]);
            tally_add(&campaign->all[t], &verdicts[t]);
            if (found)
                tally_add(&campaign->strata[stratum_of(truth.sub_impacts)][t], &verdicts[t]);
            if (settings->list)
                list_verdict(campaign, &verdicts[t]);
        }
        if (found && settings->cvode && number % settings->cvode == 0 &&
            truth.spread <= wanted.goal)
            check_by_cvode(campaign, &scene, number, wanted.modes, &truth);
    }
    scene_release(&scene);
}

static void print_tables(const struct campaign *campaign)
{
    bool csv = campaign->settings.csv;
    const char *word = scene_class_word(campaign->settings.class);
    for (int s = -1; s < STRATA; s++) {
        char name[64];
        snprintf(name, sizeof name, "%s%s%s", word, s < 0 ? "" : " ", s < 0 ? "" : strata[s].name);
        for (int t = 0; t < TOLERANCES; t++) {
            const struct tally *tally = s < 0 ? &campaign->all[t] : &campaign->strata[s][t];
            if (tally->judged + tally->unsettled + tally->unsolved)
                tally_print(stdout, tally, name, tolerances[t], csv);
        }
    }
    if (!csv && campaign->refused)
        printf("%s: %zu refused\n", word, campaign->refused);
    if (!csv && campaign->compared)
        printf("%s: %zu references compared with CVODE, %zu more than %g apart, farthest %.3g "
               "(scene %llu)\n",
               word, campaign->compared, campaign->apart,
               TALLY_SETTLED * tolerances[TOLERANCES - 1], campaign->farthest,
               (unsigned long long)campaign->farthest_scene);
    fflush(stdout);
}

static void run_class(const struct settings *settings)
{
    static struct campaign campaign;
    campaign = (struct campaign){.settings = *settings, .lab = lab_create()};
    campaign.room = truth_room_create();
    assert_non_null(campaign.room);
    for (uint64_t n = settings->first; n < settings->first + settings->count; n++)
        run_scene(&campaign, n);
    if (!settings->list && !settings->scene)
        print_tables(&campaign);
    for (int t = 0; t < TOLERANCES; t++) {
        tally_free(&campaign.all[t]);
        for (int s = 0; s < STRATA; s++)
            tally_free(&campaign.strata[s][t]);
    }
    truth_room_free(campaign.room);
    lab_free(campaign.lab);
}

static bool read_settings(int count, char **words, struct settings *settings)
{
    static const struct option options[] = {{"class", required_argument, NULL, 'k'},
                                            {"first", required_argument, NULL, 'f'},
                                            {"count", required_argument, NULL, 'n'},
                                            {"effort", required_argument, NULL, 'e'},
                                            {"cvode", required_argument, NULL, 'v'},
                                            {"scene", required_argument, NULL, 's'},
                                            {"csv", no_argument, NULL, 'c'},
                                            {"list", no_argument, NULL, 'l'},
                                            {0}};
    *settings = (struct settings){.class = CLASS_COUNT, .count = 100, .effort = 1e8};
    for (int c; (c = getopt_long(count, words, "", options, NULL)) != -1;) {
        if (c == 'k' && (settings->class = scene_class_find(optarg)) == CLASS_COUNT)
            return false;
        if (c == 'f' || c == 's')
            settings->first = strtoull(optarg, NULL, 10);
        if (c == 'n')
            settings->count = strtoull(optarg, NULL, 10);
        if (c == 's')
            settings->count = 1;
        if (c == 'e')
            settings->effort = strtod(optarg, NULL);
        if (c == 'v')
            settings->cvode = strtoull(optarg, NULL, 10);
        if (c == '?')
            return false;
        settings->scene = settings->scene || c == 's';
        settings->csv = settings->csv || c == 'c';
        settings->list = settings->list || c == 'l';
    }
    return optind == count && !(settings->scene && settings->class == CLASS_COUNT);
}

int main(int count, char **words)
{
    struct settings settings;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (!read_settings(count, words, &settings)) {
        fprintf(stderr, "usage: estimates [--class WORD] [--first N] [--count N] [--effort W] "
                        "[--cvode K] [--csv | --list]\n"
                        "       estimates --class WORD --scene N\nclasses:\n");
        for (int k = 0; k < CLASS_COUNT; k++)
            fprintf(stderr, "  %-10s %s\n", scene_class_word((enum scene_class)k),
                    scene_class_text((enum scene_class)k));
        return 2;
    }
    if (settings.list)
        printf("class,scene,tolerance,met,reported,true_error,spread,sub_impacts,true_sub_impacts,"
               "seconds\n");
    else if (!settings.scene)
        tally_head(stdout, settings.csv);
    enum scene_class only = settings.class;
    for (int k = 0; k < CLASS_COUNT; k++) {
        settings.class = (enum scene_class)k;
        if (only == CLASS_COUNT || only == settings.class)
            run_class(&settings);
    }
    return 0;
}
