/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "option_hint.h"

#include <string.h>

#include "cli.h"
#include "complete_line.h"
#include "percuss/similar.h"

/* The option that begins so, as getopt allows it to be written; NULL: none. */
static const struct argp_option *find_begun(const struct argp *argp, const char *name,
                                            size_t length)
{
    for (const struct argp_option *o = argp->options; o && !line_options_end(o); o++)
        if (o->name && !strncmp(o->name, name, length))
            return o;
    const struct argp_option *found = NULL;
    for (const struct argp_child *child = argp->children; child && child->argp && !found; child++)
        found = find_begun(child->argp, name, length);
    return found;
}

/* Those that argp adds. */
static bool is_built_in(const char *name, size_t length)
{
    static const char *const names[] = {"help", "usage", "version"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strncmp(names[i], name, length))
            return true;
    return false;
}

static void find_nearest(const struct argp *argp, const char *name, unsigned *best,
                         const char **nearest)
{
    for (const struct argp_option *o = argp->options; o && !line_options_end(o); o++) {
        unsigned distance = o->name ? similar_distance(name, o->name) : *best;
        if (distance < *best) {
            *best = distance;
            *nearest = o->name;
        }
    }
    for (const struct argp_child *child = argp->children; child && child->argp; child++)
        find_nearest(child->argp, name, best, nearest);
}

bool option_hint_find(const struct argp *argp, int argc, char **argv, struct option_hint *hint)
{
    *hint = (struct option_hint){0};
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        const char *word = argv[i];
        const bool is_long = !strncmp(word, "--", 2);
        if (word[0] != '-' || !word[1])
            continue;
        size_t length = is_long ? strcspn(word + 2, "=") : 0;
        const struct argp_option *option = is_long ? line_find_option(argp, word + 2, length, 0)
                                                   : line_find_option(argp, NULL, 0, word[1]);
        if (!option && is_long)
            option = find_begun(argp, word + 2, length);
        /* the next word may be its value */
        bool whole = is_long ? !word[2 + length] : !word[2];
        if (option && option->arg && whole && !(option->flags & OPTION_ARG_OPTIONAL))
            i++;
        if (option || !is_long || is_built_in(word + 2, length) || length >= sizeof hint->name)
            continue;
        memcpy(hint->name, word + 2, length);
        unsigned best = (unsigned)(length + 1) / 2;
        find_nearest(argp, hint->name, &best, &hint->meant);
        return true;
    }
    return false;
}

void option_hint_say(const struct argp *argp, int argc, char **argv)
{
    struct option_hint hint;
    if (option_hint_find(argp, argc, argv, &hint) && hint.meant)
        complain("--%s: did you mean --%s?", hint.name, hint.meant);
}
