/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether every valid request ends: random ones of every kind (any_scene.h), each under a watchdog,
 * and what they cost.
 *   any_scenes [--first N] [--count N] [--limit S] [--work W] [--patience S] [--save FOLDER]
 *              [--list]
 * Prints the distributions of processor time and of work (base/watch.h: the same on every machine),
 * what the requests ended in, and the worst ones by number; with --save those are written as files
 * (any_scene_save). --list prints each answer.
 * Exit 1: a request hung (--patience, processor time), crashed, took more than --limit or --work,
 * or was refused or cut off without words; or fewer than half were answered, or to the tolerance.
 * Exit 2: usage, or the tables cannot be read. */
#include <getopt.h>

#include "any_scene.h"
#include "guarded.h"
#include "store/table_store.h"

enum { KEPT = 12, BINS = 256, BINS_PER_OCTAVE = 8, TEXTS = 24 };

/* A cost: 1 is bin 0. */
struct distribution {
    double unit;
    uint64_t bins[BINS], count;
    double largest;
};

struct noted {
    uint64_t scene;
    size_t blow;
    double seconds, work;
    enum percuss_status status;
    char text[160];
};

/* What the child adds up, in shared memory. */
struct figures {
    struct distribution seconds, work;
    struct noted worst[KEPT];
    struct noted wrong[KEPT];
    uint64_t wrongs, late, heavy, traced, ringing, met, answered;
    uint64_t statuses[PERCUSS_STATUS_COUNT], ends[PERCUSS_END_COUNT];
};

struct settings {
    uint64_t first, count;
    double limit, work;
    const char *save;
    bool list;
};

struct run {
    struct settings settings;
    struct figures *figures;
    struct lab *lab;
    unsigned long asked; /* how often the solver asked its watch */
};

static bool count_asking(void *context, double done)
{
    (void)done;
    ++*(unsigned long *)context;
    return true;
}

static void add_to(struct distribution *distribution, double value)
{
    double octaves = log2(fmax(value / distribution->unit, 1.0));
    int bin = (int)fmin(BINS_PER_OCTAVE * octaves, BINS - 1.0);
    distribution->bins[bin]++;
    distribution->count++;
    distribution->largest = fmax(distribution->largest, value);
}

/* The upper end of the bin that holds the share. */
static double quantile(const struct distribution *distribution, double share)
{
    uint64_t below = 0;
    for (int bin = 0; bin < BINS; bin++) {
        below += distribution->bins[bin];
        if ((double)below >= share * (double)distribution->count)
            return distribution->unit * exp2((bin + 1.0) / BINS_PER_OCTAVE);
    }
    return distribution->largest;
}

/* Keeps the slowest, in order. */
static void keep_slowest(struct noted list[KEPT], const struct noted *new)
{
    int at = KEPT;
    while (at > 0 && new->seconds > list[at - 1].seconds)
        at--;
    if (at == KEPT)
        return;
    memmove(list + at + 1, list + at, (size_t)(KEPT - 1 - at) * sizeof *list);
    list[at] = *new;
}

/* The energy closes to so many tolerances. */
static const double CLOSURE = 10.0;

/* What no answer may be; NULL: nothing is wrong. */
static const char *what_is_wrong(const struct solve_result *result)
{
    bool answered = result->status == PERCUSS_OK || result->status == PERCUSS_TRUNCATED;
    if (result->status == PERCUSS_INTERNAL)
        return "INTERNAL";
    if (result->status && !result->fault.text[0])
        return "no message";
    if (result->end_reason == PERCUSS_END_LIMIT && answered && result->tolerance_met)
        return "cut off, and the tolerance met";
    double missed = fabs(result->energy.closure);
    if (answered && result->tolerance_met &&
        !(missed <= CLOSURE * result->tolerance * result->energy.available))
        return "the energy does not close, and the tolerance met";
    for (size_t c = 0; answered && c < result->contact_count; c++) {
        const struct solve_contact_result *contact = &result->contacts[c];
        if (!isfinite(contact->impulse) || contact->impulse < 0.0)
            return "an impulse that is none";
        if (contact->impulse_compression > 0.0 && !isfinite(contact->restitution) &&
            result->end_reason != PERCUSS_END_LIMIT)
            return "no restitution";
    }
    return NULL;
}

static void describe(const struct run *run, const struct any_scene *scene, struct noted *noted,
                     const struct solve_result *result)
{
    const struct solve_options *options = &scene->drawn.request.options;
    snprintf(noted->text, sizeof noted->text, "%s %s%s%s: %s %s %.90s",
             contact_model_name(options->contact_model), run->lab->bodies[0].kind->name,
             options->trace ? " traced" : "", noted->blow ? " ringing" : "",
             status_name(result->status), end_reason_name(result->end_reason), result->fault.text);
}

static void note(const struct run *run, const struct any_scene *scene, struct noted *noted,
                 const struct solve_result *result)
{
    struct figures *figures = run->figures;
    const char *wrong = what_is_wrong(result);
    noted->status = result->status;
    describe(run, scene, noted, result);
    add_to(&figures->seconds, noted->seconds);
    figures->statuses[result->status]++;
    add_to(&figures->work, noted->work);
    figures->late += noted->seconds > run->settings.limit;
    figures->heavy += noted->work > run->settings.work;
    figures->traced += scene->drawn.request.options.trace;
    figures->ringing += noted->blow > 0;
    if (result->status == PERCUSS_OK || result->status == PERCUSS_TRUNCATED) {
        figures->answered++;
        figures->met += result->tolerance_met;
        figures->ends[result->end_reason]++;
    }
    keep_slowest(figures->worst, noted);
    if (wrong && figures->wrongs++ < KEPT)
        figures->wrong[figures->wrongs - 1] = *noted;
    if (run->settings.list)
        printf("%llu.%zu %.3g ms work %.3g e %.17g met %d %s%s\n", (unsigned long long)noted->scene,
               noted->blow, 1e3 * noted->seconds, noted->work, result->contacts[0].restitution,
               result->tolerance_met, noted->text, wrong ? wrong : "");
}

static struct body_state *copy_state(const struct body_state *state)
{
    struct body_state *copy = state ? malloc(body_state_size(state)) : NULL;
    if (copy)
        memcpy(copy, state, body_state_size(state));
    return copy;
}

/* The bodies as the last answer left them. */
static void take_states(struct body_state **states, const struct solve_result *result)
{
    for (size_t b = 0; b < result->body_count; b++) {
        struct body_state *after = copy_state(result->bodies[b].state_after);
        free(states[b]);
        states[b] = after;
    }
}

static void strike_all(struct run *run, uint64_t number)
{
    static struct any_scene scene;
    static struct solve_result result;
    struct body_state *states[PERCUSS_MAX_BODIES] = {0};
    any_scene_draw(run->lab, number, &scene);
    for (size_t blow = 0; blow < scene.blows; blow++) {
        struct solve_request request = any_scene_request(&scene, blow);
        struct noted noted = {.scene = number, .blow = blow};
        for (size_t b = 0; b < request.body_count; b++)
            request.bodies[b].state = states[b];
        run->asked = 0;
        double start = guarded_clock();
        solve(run->lab->workspace, &run->lab->means, &request, &result);
        noted.seconds = guarded_clock() - start;
        noted.work = PACE_WORK * (double)run->asked;
        note(run, &scene, &noted, &result);
        if (result.status != PERCUSS_OK && result.status != PERCUSS_TRUNCATED)
            break;
        take_states(states, &result);
    }
    for (size_t b = 0; b < COUNT(states); b++)
        free(states[b]);
}

static void complain(const struct fault *fault)
{
    fprintf(stderr, "any_scenes: %s\n", fault->text);
}

/* The tables that come with percuss; NULL, and said why: they cannot be read. */
static struct table_store *load_tables(void)
{
    struct table_store *store = table_store_create();
    struct fault fault = {.text = "out of memory"};
    size_t count;
    if (store &&
        !table_store_load(store, PERCUSS_SOURCE_DIR "/config/tables", complain, &count, &fault))
        return store;
    complain(&fault);
    table_store_free(store);
    return NULL;
}

/* In the child. */
static void work(void *context, struct guarded_place *place, uint64_t end)
{
    struct run *run = context;
    struct table_store *store = load_tables();
    run->lab = lab_create();
    if (!store)
        abort();
    run->lab->means.tables = table_store_source(store);
    run->lab->means.watch = (struct watch){count_asking, &run->asked};
    for (uint64_t n = place->resume; n < end; n++) {
        place->started = guarded_clock();
        place->job = n;
        strike_all(run, n);
        place->resume = n + 1;
    }
    lab_free(run->lab);
    table_store_free(store);
}

static void save(const struct run *run, uint64_t number)
{
    static struct any_scene scene;
    char prefix[4000];
    if (!run->settings.save)
        return;
    any_scene_draw(run->lab, number, &scene);
    snprintf(prefix, sizeof prefix, "%s/scene-%llu", run->settings.save,
             (unsigned long long)number);
    if (!any_scene_save(run->lab, &scene, prefix))
        perror(prefix);
}

static void print_list(const struct run *run, const struct noted list[KEPT], double least)
{
    for (size_t i = 0; i < KEPT && list[i].text[0]; i++) {
        printf("    %.4g s  %.3g  scene %llu.%zu  %s\n", list[i].seconds, list[i].work,
               (unsigned long long)list[i].scene, list[i].blow, list[i].text);
        if (list[i].seconds >= least)
            save(run, list[i].scene);
    }
}

static void print_distribution(const char *what, double unit,
                               const struct distribution *distribution)
{
    printf("%s: median %.3g, 90 %% %.3g, 99 %% %.3g, 99.9 %% %.3g, largest %.4g\n", what,
           unit * quantile(distribution, 0.5), unit * quantile(distribution, 0.9),
           unit * quantile(distribution, 0.99), unit * quantile(distribution, 0.999),
           unit * distribution->largest);
}

static void print_figures(const struct run *run)
{
    const struct figures *f = run->figures;
    printf("requests %llu (traced %llu, on bodies that were struck before %llu), answered %llu, "
           "tolerance met %llu\n",
           (unsigned long long)f->seconds.count, (unsigned long long)f->traced,
           (unsigned long long)f->ringing, (unsigned long long)f->answered,
           (unsigned long long)f->met);
    for (unsigned s = 0; s < PERCUSS_STATUS_COUNT; s++)
        if (f->statuses[s])
            printf("  %s %llu\n", status_name(s), (unsigned long long)f->statuses[s]);
    for (unsigned e = 0; e < PERCUSS_END_COUNT; e++)
        if (f->ends[e])
            printf("    ended %s %llu\n", end_reason_name(e), (unsigned long long)f->ends[e]);
    print_distribution("processor time, ms", 1e3, &f->seconds);
    print_distribution("work, millions", 1e-6, &f->work);
    print_list(run, f->worst, run->settings.limit);
    printf("more than %g s: %llu, more work than %g: %llu\n", run->settings.limit,
           (unsigned long long)f->late, run->settings.work, (unsigned long long)f->heavy);
    printf("wrong: %llu\n", (unsigned long long)f->wrongs);
    print_list(run, f->wrong, 0.0);
}

static bool print_lost(const struct run *run, const struct guarded *guarded)
{
    printf("hung or crashed: %zu\n", guarded->lost_count);
    for (size_t i = 0; i < guarded->lost_count && i < GUARDED_MOST_LOST; i++) {
        int signal = guarded->lost[i].signal;
        printf("    scene %llu: %s\n", (unsigned long long)guarded->lost[i].job,
               signal ? strsignal(signal) : "hung");
        save(run, guarded->lost[i].job);
    }
    return guarded->lost_count > 0;
}

/* Whoever refuses everything is never late. */
static bool answers_most(const struct figures *figures)
{
    uint64_t half = figures->seconds.count / 2;
    return figures->answered >= half && figures->met >= half;
}

int main(int count, char **words)
{
    static const struct option options[] = {
        {"first", required_argument, NULL, 'f'},    {"count", required_argument, NULL, 'n'},
        {"limit", required_argument, NULL, 'l'},    {"work", required_argument, NULL, 'w'},
        {"patience", required_argument, NULL, 'p'}, {"save", required_argument, NULL, 's'},
        {"list", no_argument, NULL, 'i'},           {0}};
    struct run run = {.settings = {.count = 1000, .limit = 1.0, .work = INFINITY}};
    struct guarded guarded = {.work = work, .context = &run, .patience = 30.0};
    for (int c; (c = getopt_long(count, words, "", options, NULL)) != -1;) {
        switch (c) {
        case 'f':
            run.settings.first = strtoull(optarg, NULL, 10);
            break;
        case 'n':
            run.settings.count = strtoull(optarg, NULL, 10);
            break;
        case 'l':
            run.settings.limit = strtod(optarg, NULL);
            break;
        case 'w':
            run.settings.work = strtod(optarg, NULL);
            break;
        case 'p':
            guarded.patience = strtod(optarg, NULL);
            break;
        case 's':
            run.settings.save = optarg;
            break;
        case 'i':
            run.settings.list = true;
            break;
        default:
            return 2;
        }
    }
    struct table_store *store = load_tables();
    if (!store)
        return 2;
    table_store_free(store);
    run.figures = guarded_memory(sizeof *run.figures);
    run.figures->seconds.unit = 1e-6;
    run.figures->work.unit = PACE_WORK;
    guarded_run(&guarded, run.settings.first, run.settings.first + run.settings.count);
    run.lab = lab_create();
    print_figures(&run);
    bool failed = print_lost(&run, &guarded);
    lab_free(run.lab);
    if (!answers_most(run.figures)) {
        printf("fewer than half of the requests were answered to their tolerance\n");
        failed = true;
    }
    return failed || run.figures->late || run.figures->heavy || run.figures->wrongs;
}
