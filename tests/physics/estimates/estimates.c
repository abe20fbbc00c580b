/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* How honest the error estimates are: random scenes of each class, answered at three tolerances
 * and compared with what they converge to (docs/lab/accuracy.md).
 *   estimates [--class WORD] [--first N] [--count N] [--effort W] [--cvode K] [--plain]
 *             [--csv | --list]
 *   estimates --class WORD --scene N [--plain]   one scene, with everything
 *   estimates --draw [--seed N]              a bounded draw of every class, judged; the seed is
 *                                            the week's (weekly.h) unless given
 * --effort: work of a scene's reference (impact_settings.max_work). --cvode K: every K-th scene's
 * reference is compared with CVODE's; of class oblique CVODE judges all scenes that it solves
 * within the effort. --plain: with plain friction, which CVODE does not have: solutions with more
 * modes and shorter steps judge. --list: each answer as a line of CSV. Exit 1: the draw, or an
 * answer that breaks an invariant. Exit 2: usage. */
#include <getopt.h>

#include "physics/estimates/campaign.h"
#include "physics/estimates/weekly.h"

struct options {
    struct campaign_settings settings; /* class CLASS_COUNT: all */
    unsigned long seed;
    bool draw;
};

static bool read_options(int count, char **words, struct options *options)
{
    static const struct option names[] = {
        {"class", required_argument, NULL, 'k'}, {"first", required_argument, NULL, 'f'},
        {"count", required_argument, NULL, 'n'}, {"effort", required_argument, NULL, 'e'},
        {"cvode", required_argument, NULL, 'v'}, {"scene", required_argument, NULL, 's'},
        {"seed", required_argument, NULL, 'r'},  {"plain", no_argument, NULL, 'p'},
        {"csv", no_argument, NULL, 'c'},         {"list", no_argument, NULL, 'l'},
        {"draw", no_argument, NULL, 'd'},        {0}};
    struct campaign_settings *settings = &options->settings;
    *options =
        (struct options){{.class = CLASS_COUNT, .count = 100, .effort = 1e8}, weekly_seed(), false};
    for (int c; (c = getopt_long(count, words, "", names, NULL)) != -1;) {
        if (c == 'k' && (settings->class = scene_class_find(optarg)) == CLASS_COUNT)
            return false;
        if (c == 'f' || c == 's')
            settings->first = strtoull(optarg, NULL, 10);
        if (c == 'n' || c == 's')
            settings->count = c == 's' ? 1 : strtoull(optarg, NULL, 10);
        if (c == 'e')
            settings->effort = strtod(optarg, NULL);
        if (c == 'v')
            settings->cvode = strtoull(optarg, NULL, 10);
        if (c == 'r')
            options->seed = strtoul(optarg, NULL, 10);
        if (c == '?')
            return false;
        settings->chatty = settings->chatty || c == 's';
        settings->plain = settings->plain || c == 'p';
        settings->csv = settings->csv || c == 'c';
        settings->list = settings->list || c == 'l';
        options->draw = options->draw || c == 'd';
    }
    return optind == count && !(settings->chatty && settings->class == CLASS_COUNT);
}

static int run_all(struct campaign_settings settings)
{
    enum scene_class only = settings.class;
    size_t broken = 0;
    if (settings.list)
        printf("class,scene,tolerance,met,reported,true_error,spread,sub_impacts,true_sub_impacts,"
               "modes,seconds,tangential_share\n");
    else if (!settings.chatty)
        tally_head(stdout, settings.csv);
    for (int k = 0; k < CLASS_COUNT; k++) {
        static struct campaign campaign;
        settings.class = (enum scene_class)k;
        if (only != CLASS_COUNT && only != settings.class)
            continue;
        campaign_run(&campaign, &settings);
        if (!settings.list && !settings.chatty)
            campaign_print(&campaign);
        broken += campaign.broken;
        campaign_release(&campaign);
    }
    return broken > 0;
}

int main(int count, char **words)
{
    struct options options;
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (read_options(count, words, &options))
        return options.draw ? weekly_draw(options.seed) : run_all(options.settings);
    fprintf(stderr, "usage: estimates [--class WORD] [--first N] [--count N] [--effort W] "
                    "[--cvode K] [--plain] [--csv | --list]\n"
                    "       estimates --class WORD --scene N [--plain]\n"
                    "       estimates --draw [--seed N]\nclasses:\n");
    for (int k = 0; k < CLASS_COUNT; k++)
        fprintf(stderr, "  %-10s %s\n", scene_class_word((enum scene_class)k),
                scene_class_text((enum scene_class)k));
    return 2;
}
