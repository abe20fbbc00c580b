/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether answers cover what their models are wrong by: random central impacts (drawn_model.h)
 * against complete finite elements, which are recorded, as they take seconds each.
 *   models [--data FILE] [--class WORD] [--list]
 *   models --draw [--seed N]          one fresh scene of each class; the seed is the week's unless
 *                                    given
 *   models --record FILE [--first N] [--count N] [--fe-tolerance T]
 *                                    computes such a file anew, beginning with its head
 * Answers by `auto` with the tables that come with percuss, by the closed form without any, and by
 * `auto` on half-spaces. Prints by class how often error.restitution_total and what finite elements
 * state cover the difference, and how wide they are. Exit 1: less than 95 % of an answer's scenes
 * are covered, or something was not answered. */
#include <getopt.h>
#include <time.h>

#include "physics/estimates/drawn_model.h"
#include "physics/estimates/weekly.h"
#include "store/table_store.h"

enum { ANSWERS = 3, MOST = 2000 };

static const struct {
    const char *word;
    enum percuss_contact_model model;
    enum percuss_compliance compliance;
    bool tables;
} answers[ANSWERS] = {
    {"auto", PERCUSS_CONTACT_AUTO, PERCUSS_COMPLIANCE_DEFAULT, true},
    {"closed-form", PERCUSS_CONTACT_AUTO, PERCUSS_COMPLIANCE_DEFAULT, false},
    {"half-space", PERCUSS_CONTACT_AUTO, PERCUSS_COMPLIANCE_HALF_SPACE, true},
};

static const double COVERED = 0.95;

struct tally {
    size_t judged, covered;
    double difference[MOST], width[MOST];
};

struct settings {
    const char *data, *record;
    enum model_class only;
    uint64_t first, count;
    double tolerance; /* of the finite elements */
    bool list, draw;
    unsigned long seed;
};

struct campaign {
    struct settings settings;
    struct lab *lab;
    struct table_store *store;
    struct tally tally[MODEL_COUNT][ANSWERS];
    bool fails;
};

/* What finite elements say of a scene. */
struct truth {
    double restitution, error, seconds;
};

static double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool compute(struct campaign *campaign, enum model_class class, uint64_t number,
                    struct truth *truth)
{
    static struct model_scene scene;
    static struct solve_result fe;
    struct lab *lab = campaign->lab;
    double start = processor_seconds();
    model_draw(lab, class, number, &scene);
    scene.request.options.contact_model = PERCUSS_CONTACT_COMPLETE_FE;
    scene.request.options.tolerance = campaign->settings.tolerance;
    if (solve(lab->workspace, &lab->means, &scene.request, &fe) != PERCUSS_OK) {
        fprintf(stderr, "%s %llu: %s: %s\n", model_class_word(class), (unsigned long long)number,
                scene.text, fe.fault.text);
        return false;
    }
    *truth = (struct truth){fe.contacts[0].restitution, fe.restitution_time + fe.restitution_modes,
                            processor_seconds() - start};
    return true;
}

static void judge_one(struct campaign *campaign, int a, struct model_scene *scene,
                      const struct truth *truth, struct tally *tally)
{
    static struct solve_result result;
    struct lab *lab = campaign->lab;
    lab->means.tables = answers[a].tables ? table_store_source(campaign->store) : NULL;
    scene->request.options.contact_model = answers[a].model;
    scene->request.options.compliance = answers[a].compliance;
    enum percuss_status status = solve(lab->workspace, &lab->means, &scene->request, &result);
    lab->means.tables = NULL;
    if (status != PERCUSS_OK || tally->judged == MOST) {
        printf("  %s: %s %s\n", answers[a].word, status_name(status), result.fault.text);
        campaign->fails = true;
        return;
    }
    double difference = fabs(result.contacts[0].restitution - truth->restitution);
    bool covered = difference <= result.restitution_total + truth->error;
    tally->difference[tally->judged] = difference;
    tally->width[tally->judged++] = result.restitution_total;
    tally->covered += covered;
    if (campaign->settings.list)
        printf("  %-12s %.5f +- %.5f off %+.5f%s, %zu sub-impacts, by %s\n", answers[a].word,
               result.contacts[0].restitution, result.restitution_total,
               result.contacts[0].restitution - truth->restitution, covered ? "" : " NOT COVERED",
               result.contacts[0].sub_impact_count, contact_model_name(result.contact_model));
}

static void judge(struct campaign *campaign, enum model_class class, uint64_t number,
                  const struct truth *truth)
{
    static struct model_scene scene;
    model_draw(campaign->lab, class, number, &scene);
    if (campaign->settings.list)
        printf("%s %llu: %s\n  %-12s %.5f +- %.5f\n", model_class_word(class),
               (unsigned long long)number, scene.text, "complete-fe", truth->restitution,
               truth->error);
    for (int a = 0; a < ANSWERS; a++)
        judge_one(campaign, a, &scene, truth, &campaign->tally[class][a]);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_line(const char *class, const char *answer, struct tally *t)
{
    qsort(t->difference, t->judged, sizeof(double), compare);
    qsort(t->width, t->judged, sizeof(double), compare);
    printf("%-9s %-12s %6zu %8.1f %% %10.4f %10.4f %10.4f\n", class, answer, t->judged,
           100.0 * (double)t->covered / (double)t->judged, t->width[t->judged / 2],
           t->difference[t->judged / 2], t->difference[t->judged - 1]);
}

/* Each class, and all of them by answer, which are what must be covered. */
static void print(struct campaign *campaign)
{
    static struct tally all[ANSWERS];
    printf("%-9s %-12s %6s %10s %10s %10s %10s\n", "class", "answer", "judged", "covered", "width",
           "median", "largest");
    for (int k = 0; k < MODEL_COUNT; k++)
        for (int a = 0; a < ANSWERS; a++) {
            struct tally *t = &campaign->tally[k][a];
            if (t->judged == 0)
                continue;
            for (size_t i = 0; i < t->judged && all[a].judged < MOST; i++) {
                all[a].difference[all[a].judged] = t->difference[i];
                all[a].width[all[a].judged++] = t->width[i];
            }
            all[a].covered += t->covered;
            print_line(model_class_word((enum model_class)k), answers[a].word, t);
        }
    for (int a = 0; a < ANSWERS; a++) {
        double least = COVERED * (double)all[a].judged;
        if (all[a].judged > 0)
            print_line("all", answers[a].word, &all[a]);
        /* of a few scenes one may be off */
        if ((double)all[a].covered < fmin(least, (double)all[a].judged - 1.0))
            campaign->fails = true;
    }
}

/* Lines of class,number,restitution,error,seconds after the head. */
static bool read_data(struct campaign *campaign)
{
    char line[256], word[32];
    FILE *file = fopen(campaign->settings.data, "r");
    if (!file) {
        fprintf(stderr, "models: %s: not there\n", campaign->settings.data);
        return false;
    }
    while (fgets(line, sizeof line, file)) {
        unsigned long long number;
        struct truth truth;
        if (sscanf(line, "%31[^,],%llu,%lf,%lf,%lf", word, &number, &truth.restitution,
                   &truth.error, &truth.seconds) != 5)
            continue;
        enum model_class class = model_class_find(word);
        if (class == MODEL_COUNT)
            return !fprintf(stderr, "models: %s: %s is no class\n", campaign->settings.data, word);
        if (campaign->settings.only == MODEL_COUNT || campaign->settings.only == class)
            judge(campaign, class, number, &truth);
    }
    fclose(file);
    return true;
}

static bool record(struct campaign *campaign)
{
    const struct settings *settings = &campaign->settings;
    FILE *file = fopen(settings->record, "w");
    if (!file)
        return false;
    fprintf(file,
            "# complete finite elements: build/tests/models --record FILE --first %llu --count "
            "%llu --fe-tolerance %g\nclass,number,restitution,error,seconds\n",
            (unsigned long long)settings->first, (unsigned long long)settings->count,
            settings->tolerance);
    for (uint64_t n = settings->first; n < settings->first + settings->count; n++)
        for (int k = 0; k < MODEL_COUNT; k++) {
            struct truth truth;
            if (!compute(campaign, (enum model_class)k, n, &truth))
                continue;
            fprintf(file, "%s,%llu,%.6f,%.6f,%.1f\n", model_class_word((enum model_class)k),
                    (unsigned long long)n, truth.restitution, truth.error, truth.seconds);
            fflush(file);
        }
    return fclose(file) == 0;
}

/* One scene of each class that nobody has seen before. */
static bool draw(struct campaign *campaign)
{
    struct settings *settings = &campaign->settings;
    printf("seed %lu: the same scenes again with --draw --seed %lu\n", settings->seed,
           settings->seed);
    settings->list = true;
    for (int k = 0; k < MODEL_COUNT; k++) {
        struct truth truth;
        uint64_t number = 1000 + settings->seed;
        if (!compute(campaign, (enum model_class)k, number, &truth))
            return false;
        judge(campaign, (enum model_class)k, number, &truth);
    }
    return true;
}

static bool read_settings(int count, char **words, struct settings *settings)
{
    static const struct option options[] = {
        {"data", required_argument, NULL, 'd'},  {"record", required_argument, NULL, 'r'},
        {"class", required_argument, NULL, 'k'}, {"first", required_argument, NULL, 'f'},
        {"count", required_argument, NULL, 'n'}, {"fe-tolerance", required_argument, NULL, 't'},
        {"seed", required_argument, NULL, 's'},  {"list", no_argument, NULL, 'l'},
        {"draw", no_argument, NULL, 'w'},        {0}};
    *settings = (struct settings){.data = PERCUSS_SOURCE_DIR "/tests/data/complete-fe.csv",
                                  .only = MODEL_COUNT,
                                  .count = 4,
                                  .tolerance = 4e-3,
                                  .seed = weekly_seed()};
    for (int c; (c = getopt_long(count, words, "", options, NULL)) != -1;) {
        if (c == '?' || (c == 'k' && (settings->only = model_class_find(optarg)) == MODEL_COUNT))
            return false;
        settings->data = c == 'd' ? optarg : settings->data;
        settings->record = c == 'r' ? optarg : settings->record;
        settings->first = c == 'f' ? strtoull(optarg, NULL, 10) : settings->first;
        settings->count = c == 'n' ? strtoull(optarg, NULL, 10) : settings->count;
        settings->tolerance = c == 't' ? strtod(optarg, NULL) : settings->tolerance;
        settings->seed = c == 's' ? strtoul(optarg, NULL, 10) : settings->seed;
        settings->list = settings->list || c == 'l';
        settings->draw = settings->draw || c == 'w';
    }
    return optind == count && settings->tolerance > 0.0;
}

static void complain(const struct fault *fault)
{
    fprintf(stderr, "models: %s\n", fault->text);
}

int main(int count, char **words)
{
    static struct campaign campaign;
    struct fault fault = {""};
    size_t tables;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (!read_settings(count, words, &campaign.settings)) {
        fprintf(stderr, "usage: models [--data FILE] [--class WORD] [--list]\n"
                        "       models --draw [--seed N]\n"
                        "       models --record FILE [--first N] [--count N] [--fe-tolerance T]\n"
                        "classes:\n");
        for (int k = 0; k < MODEL_COUNT; k++)
            fprintf(stderr, "  %-10s %s\n", model_class_word((enum model_class)k),
                    model_class_text((enum model_class)k));
        return 2;
    }
    campaign.store = table_store_create();
    if (!campaign.store || table_store_load(campaign.store, PERCUSS_SOURCE_DIR "/config/tables",
                                            complain, &tables, &fault)) {
        complain(&fault);
        return 2;
    }
    campaign.lab = lab_create();
    /* as the daemon's default: what a rod's own shape adds to Hertz's half-space */
    campaign.lab->set.compliance = PERCUSS_COMPLIANCE_MATCHED;
    bool ok = campaign.settings.record ? record(&campaign)
              : campaign.settings.draw ? draw(&campaign)
                                       : read_data(&campaign);
    if (!campaign.settings.record)
        print(&campaign);
    lab_free(campaign.lab);
    table_store_free(campaign.store);
    return ok && !campaign.fails ? 0 : 1;
}
