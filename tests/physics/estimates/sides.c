/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Whether answers for bars that are hit on the side cover what beams are wrong by: random bars and
 * balls against meshes of the bars (meshed_bar.h), which are recorded, as they take seconds each.
 *   sides [--data FILE] [--class WORD] [--list]
 *   sides --draw [--seed N]          one fresh scene of each class; the seed is the week's unless
 *                                    given
 *   sides --record FILE [--first N] [--count N]
 * Prints by class how often error.restitution_total and what the meshes leave cover the difference,
 * and how many answers are within their tolerance by themselves (`met`), but wrong. Exit 1: less
 * than 95 % of an answer's scenes are covered, or something was not answered. */
#include <getopt.h>
#include <time.h>

#include "physics/estimates/drawn.h"
#include "physics/estimates/meshed_bar.h"
#include "physics/estimates/weekly.h"

#define CLASSES(X)                                                                                 \
    X(ROUND, "round", "a ball on the side of a round bar")                                         \
    X(SQUARE, "square", "on the axis of a square bar's side")                                      \
    X(FLAT, "flat", "on the axis of a rectangular bar's side")                                     \
    X(ASIDE, "aside", "beside the axis of a rectangular bar's side")                               \
    X(SHORT, "short", "on the axis of a thick bar: a shear wave hardly crosses it meanwhile")

enum side_class {
#define X(name, word, text) SIDE_##name,
    CLASSES(X)
#undef X
        SIDE_COUNT
};

static const struct {
    const char *word, *text;
} classes[SIDE_COUNT] = {
#define X(name, word, text) [SIDE_##name] = {word, text},
    CLASSES(X)
#undef X
};

static const struct {
    const char *word;
    enum percuss_compliance compliance;
} answers[] = {{"matched", PERCUSS_COMPLIANCE_MATCHED},
               {"half-space", PERCUSS_COMPLIANCE_HALF_SPACE}};
enum { ANSWERS = 2, MOST = 1000 };

static const double COVERED = 0.95;
static const double TOLERANCE = 1e-3;
/* Of a mesh of four elements on the depth, against one of six. */
static const double MESH = 3e-4;
/* Periods of the last mode that a contact takes. */
static const double PERIODS = 3.0;
/* Least and largest duration of a contact over the way of a shear wave across the depth: of most
 * classes, and of the short ones. */
static const double DURATIONS[2][2] = {{4.5, INFINITY}, {2.2, 4.5}};

/* Elements on the depth: three for the last mode's shear wave. */
static size_t fine_of(enum side_class class)
{
    return class == SIDE_SHORT ? 6 : 4;
}

struct scene {
    struct spot ball, target;
    double speed;
    double duration; /* of Hertz's contact */
    char text[240];
};

struct truth {
    double restitution, error;
};

struct tally {
    size_t judged, covered, met, wrong;
    double difference[MOST], width[MOST];
};

struct campaign {
    const char *data, *record;
    enum side_class only;
    uint64_t first, count;
    unsigned long seed;
    bool list, draw, fails;
    struct lab *lab;
    struct tally tally[SIDE_COUNT][ANSWERS];
};

static struct material draw_metal(uint64_t *r, const char *name, double poisson_low,
                                  double poisson_high)
{
    struct material one = {.young = scene_log(r, 45e9, 400e9),
                           .poisson = random_between(r, poisson_low, poisson_high),
                           .density = scene_log(r, 1800.0, 12000.0),
                           .yield = INFINITY};
    snprintf(one.name, sizeof one.name, "%s", name);
    return one;
}

/* The section and the place on its top. */
static struct body draw_bar(uint64_t *r, enum side_class class, struct spot *spot)
{
    struct body bar = make_body(&beam_kind, draw_metal(r, "bar", 0.1, 0.45));
    bool is_short = class == SIDE_SHORT;
    double depth = scene_log(r, 3e-3, 30e-3);
    double ratio = scene_log(r, 0.5, is_short ? 1.2 : 2.5);
    double place = random_between(r, -0.4, 0.4), aside = random_between(r, 0.05, 0.38);
    bar.length = depth * scene_log(r, 6.0, is_short ? 10.0 : 24.0);
    if (class == SIDE_ROUND || (is_short && ratio < 0.8)) {
        bar.radius = 0.5 * depth;
    } else {
        bar.height = depth;
        bar.width = class == SIDE_SQUARE ? depth : ratio * depth;
    }
    *spot = (struct spot){"bar", {place * bar.length, 0.0, 0.5 * depth}, {0.0, 0.0, 1.0}, 0.0};
    if (class == SIDE_ASIDE)
        spot->point[1] = aside * bar.width;
    return bar;
}

/* Duration, and whether the contact is slow enough for the mesh and small enough for Hertz's law.
 */
static bool suits(const struct lab *lab, enum side_class class, struct scene *scene)
{
    const double *allowed = DURATIONS[class == SIDE_SHORT];
    const struct body *ball = &lab->bodies[0], *bar = &lab->bodies[1];
    double curvature[2] = {1.0 / ball->radius,
                           1.0 / ball->radius + (bar->radius > 0.0 ? 1.0 / bar->radius : 0.0)};
    double radius = 1.0 / sqrt(curvature[0] * curvature[1]);
    double flexible =
        (1.0 - ball->material.poisson * ball->material.poisson) / ball->material.young +
        (1.0 - bar->material.poisson * bar->material.poisson) / bar->material.young;
    double stiffness = 4.0 / 3.0 * sqrt(radius) / flexible;
    double mass = 1.0 / (1.0 / ball->mass + 1.0 / bar->mass);
    double deep = pow(1.25 * mass * scene->speed * scene->speed / stiffness, 0.4);
    double depth = bar->radius > 0.0 ? 2.0 * bar->radius : bar->height;
    double shear =
        sqrt(0.5 * bar->material.young / ((1.0 + bar->material.poisson) * bar->material.density));
    scene->duration = 2.94 * deep / scene->speed;
    return sqrt(radius * deep) < 0.1 * fmin(depth, bar->radius > 0.0 ? depth : bar->width) &&
           deep < 0.02 * ball->radius && shear * scene->duration > allowed[0] * depth &&
           shear * scene->duration < allowed[1] * depth;
}

static void draw_scene(struct lab *lab, enum side_class class, uint64_t number, struct scene *scene)
{
    for (uint64_t again = 0;; again++) {
        uint64_t seed =
            0x9E3779B97F4A7C15u * (number + 1) + 77777u * (uint64_t) class + 31u * again;
        for (int i = 0; i < 8; i++)
            random_between(&seed, 0.0, 1.0);
        lab->set.count = 0;
        struct body bar = draw_bar(&seed, class, &scene->target);
        double depth = 2.0 * scene->target.point[2];
        double radius = depth * scene_log(&seed, 0.25, 2.0);
        scene->speed = scene_log(&seed, 0.02, 3.0);
        lab_add(lab, "ball", make_sphere(draw_metal(&seed, "ball", 0.2, 0.36), radius));
        const struct body *added = lab_add(lab, "bar", bar);
        if (!suits(lab, class, scene))
            continue;
        meshed_bar_snap(added, fine_of(class), scene->target.point, scene->target.outward);
        scene->ball = sphere_spot("ball", radius);
        snprintf(scene->text, sizeof scene->text,
                 "R %.3g mm (%.3g GPa, %.0f) at %.3g m/s on %.3g x %.3g x %.3g mm (%.3g GPa, %.2f, "
                 "%.0f), %.2f along, %.2f aside, r/cT %.3f",
                 1e3 * radius, 1e-9 * lab->bodies[0].material.young,
                 lab->bodies[0].material.density, scene->speed, 1e3 * depth,
                 1e3 * (added->radius > 0.0 ? 0.0 : added->width), 1e3 * added->length,
                 1e-9 * added->material.young, added->material.poisson, added->material.density,
                 scene->target.point[0] / added->length,
                 added->width > 0.0 ? scene->target.point[1] / added->width : 0.0,
                 0.5 * depth /
                     (sqrt(added->material.young / added->material.density) * scene->duration));
        return;
    }
}

/* By the mesh with all its modes; its error: what two thirds of them change, and its elements. */
static bool compute(struct campaign *campaign, enum side_class class, uint64_t number,
                    struct truth *truth)
{
    static struct solve_result result;
    struct lab *lab = campaign->lab;
    struct scene scene;
    struct fault fault = {""};
    draw_scene(lab, class, number, &scene);
    struct meshed_bar wanted = {
        &lab->bodies[1],
        {scene.target.point[0], scene.target.point[1], scene.target.point[2]},
        2.0 * M_PI * PERIODS / scene.duration,
        fine_of(class)};
    struct mesh_body *made = meshed_bar_make(&wanted, &fault);
    if (!made) {
        fprintf(stderr, "%s %llu: %s: %s\n", classes[class].word, (unsigned long long)number,
                scene.text, fault.text);
        return false;
    }
    double found[2];
    for (int few = 0; few < 2; few++) {
        struct body body = make_body(&mesh_kind, made->materials[0]);
        body.mesh = made;
        body.scale = 1.0;
        body.modes = (unsigned)(few ? made->mode_count * 2 / 3 : made->mode_count);
        struct spot spot = scene.target;
        spot.id = few ? "few" : "mesh";
        lab_add(lab, spot.id, body);
        struct solve_request request = strike(scene.ball, spot, scene.speed);
        request.options.tolerance = 1e-5;
        lab_solve(lab, &request, &result);
        found[few] = result.contacts[0].restitution;
        if (!few)
            truth->error = result.restitution_time + MESH;
    }
    truth->restitution = found[0];
    truth->error += fabs(found[1] - found[0]);
    mesh_body_free(made);
    lab->set.count = 0;
    return true;
}

static void judge(struct campaign *campaign, enum side_class class, uint64_t number,
                  const struct truth *truth)
{
    static struct solve_result result;
    struct scene scene;
    struct lab *lab = campaign->lab;
    draw_scene(lab, class, number, &scene);
    if (campaign->list)
        printf("%s %llu: %s\n  %-12s %.5f +- %.5f\n", classes[class].word,
               (unsigned long long)number, scene.text, "mesh", truth->restitution, truth->error);
    for (int a = 0; a < ANSWERS; a++) {
        struct tally *tally = &campaign->tally[class][a];
        struct solve_request request = strike(scene.ball, scene.target, scene.speed);
        request.options.tolerance = TOLERANCE;
        request.options.compliance = answers[a].compliance;
        if (solve(lab->workspace, &lab->means, &request, &result) != PERCUSS_OK ||
            tally->judged == MOST) {
            printf("  %s: %s %s\n", answers[a].word, status_name(result.status), result.fault.text);
            campaign->fails = true;
            continue;
        }
        double off = result.contacts[0].restitution - truth->restitution;
        bool covered = fabs(off) <= result.restitution_total + truth->error;
        tally->difference[tally->judged] = fabs(off);
        tally->width[tally->judged++] = result.restitution_total;
        tally->covered += covered;
        tally->met += result.total_met;
        tally->wrong += result.total_met && fabs(off) > TOLERANCE + truth->error;
        if (campaign->list)
            printf("  %-12s %.5f +- %.5f off %+.5f%s, %zu sub-impacts, %s\n", answers[a].word,
                   result.contacts[0].restitution, result.restitution_total, off,
                   covered ? "" : " NOT COVERED", result.contacts[0].sub_impact_count,
                   result.compliance == PERCUSS_COMPLIANCE_MATCHED ? "matched" : "half-space");
    }
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print(struct campaign *campaign)
{
    size_t judged[ANSWERS] = {0}, covered[ANSWERS] = {0};
    printf("%-8s %-11s %6s %9s %5s %6s %10s %10s %10s\n", "class", "answer", "judged", "covered",
           "met", "wrong", "width", "median", "largest");
    for (int k = 0; k < SIDE_COUNT; k++)
        for (int a = 0; a < ANSWERS; a++) {
            struct tally *t = &campaign->tally[k][a];
            if (t->judged == 0)
                continue;
            qsort(t->difference, t->judged, sizeof(double), compare);
            qsort(t->width, t->judged, sizeof(double), compare);
            printf("%-8s %-11s %6zu %7.1f %% %5zu %6zu %10.5f %10.5f %10.5f\n", classes[k].word,
                   answers[a].word, t->judged, 100.0 * (double)t->covered / (double)t->judged,
                   t->met, t->wrong, t->width[t->judged / 2], t->difference[t->judged / 2],
                   t->difference[t->judged - 1]);
            judged[a] += t->judged;
            covered[a] += t->covered;
        }
    /* of a few scenes one may be off */
    for (int a = 0; a < ANSWERS; a++)
        if ((double)covered[a] < fmin(COVERED * (double)judged[a], (double)judged[a] - 1.0))
            campaign->fails = true;
}

static enum side_class find_class(const char *word)
{
    int class = 0;
    while (class < SIDE_COUNT && strcmp(word, classes[class].word) != 0)
        class ++;
    return (enum side_class) class;
}

static bool read_data(struct campaign *campaign)
{
    char line[256], word[32];
    FILE *file = fopen(campaign->data, "r");
    if (!file)
        return !fprintf(stderr, "sides: %s: not there\n", campaign->data);
    while (fgets(line, sizeof line, file)) {
        unsigned long long number;
        struct truth truth;
        if (sscanf(line, "%31[^,],%llu,%lf,%lf", word, &number, &truth.restitution, &truth.error) !=
            4)
            continue;
        enum side_class class = find_class(word);
        if (class == SIDE_COUNT)
            return !fprintf(stderr, "sides: %s: %s is no class\n", campaign->data, word);
        if (campaign->only == SIDE_COUNT || campaign->only == class)
            judge(campaign, class, number, &truth);
    }
    fclose(file);
    return true;
}

static bool record(struct campaign *campaign)
{
    FILE *file = fopen(campaign->record, "w");
    if (!file)
        return !fprintf(stderr, "sides: %s: cannot be written\n", campaign->record);
    fprintf(file,
            "# meshes: build/tests/sides --record FILE --first %llu --count %llu\n"
            "class,number,restitution,error\n",
            (unsigned long long)campaign->first, (unsigned long long)campaign->count);
    for (uint64_t n = campaign->first; n < campaign->first + campaign->count; n++)
        for (int k = 0; k < SIDE_COUNT; k++) {
            struct truth truth;
            if (campaign->only != SIDE_COUNT && campaign->only != (enum side_class)k)
                continue;
            if (!compute(campaign, (enum side_class)k, n, &truth))
                continue;
            fprintf(file, "%s,%llu,%.6f,%.6f\n", classes[k].word, (unsigned long long)n,
                    truth.restitution, truth.error);
            fflush(file);
        }
    return fclose(file) == 0;
}

/* One scene of each class that nobody has seen before. */
static bool draw(struct campaign *campaign)
{
    printf("seed %lu: the same scenes again with --draw --seed %lu\n", campaign->seed,
           campaign->seed);
    campaign->list = true;
    for (int k = 0; k < SIDE_COUNT; k++) {
        struct truth truth;
        uint64_t number = 1000 + campaign->seed;
        if (!compute(campaign, (enum side_class)k, number, &truth))
            return false;
        judge(campaign, (enum side_class)k, number, &truth);
    }
    return true;
}

static bool read_settings(int count, char **words, struct campaign *campaign)
{
    static const struct option options[] = {{"data", required_argument, NULL, 'd'},
                                            {"record", required_argument, NULL, 'r'},
                                            {"class", required_argument, NULL, 'k'},
                                            {"first", required_argument, NULL, 'f'},
                                            {"count", required_argument, NULL, 'n'},
                                            {"seed", required_argument, NULL, 's'},
                                            {"list", no_argument, NULL, 'l'},
                                            {"draw", no_argument, NULL, 'w'},
                                            {0}};
    campaign->data = PERCUSS_SOURCE_DIR "/tests/data/beam-sides.csv";
    campaign->only = SIDE_COUNT;
    campaign->count = 4;
    campaign->seed = weekly_seed();
    for (int c; (c = getopt_long(count, words, "", options, NULL)) != -1;) {
        if (c == '?' || (c == 'k' && (campaign->only = find_class(optarg)) == SIDE_COUNT))
            return false;
        campaign->data = c == 'd' ? optarg : campaign->data;
        campaign->record = c == 'r' ? optarg : campaign->record;
        campaign->first = c == 'f' ? strtoull(optarg, NULL, 10) : campaign->first;
        campaign->count = c == 'n' ? strtoull(optarg, NULL, 10) : campaign->count;
        campaign->seed = c == 's' ? strtoul(optarg, NULL, 10) : campaign->seed;
        campaign->list = campaign->list || c == 'l';
        campaign->draw = campaign->draw || c == 'w';
    }
    return optind == count;
}

int main(int count, char **words)
{
    static struct campaign campaign;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (!read_settings(count, words, &campaign)) {
        fprintf(stderr, "usage: sides [--data FILE] [--class WORD] [--list]\n"
                        "       sides --draw [--seed N]\n"
                        "       sides --record FILE [--first N] [--count N] [--class WORD]\n"
                        "classes:\n");
        for (int k = 0; k < SIDE_COUNT; k++)
            fprintf(stderr, "  %-8s %s\n", classes[k].word, classes[k].text);
        return 2;
    }
    campaign.lab = lab_create();
    bool ok = campaign.record ? record(&campaign)
              : campaign.draw ? draw(&campaign)
                              : read_data(&campaign);
    if (!campaign.record)
        print(&campaign);
    lab_free(campaign.lab);
    return ok && !campaign.fails ? 0 : 1;
}
