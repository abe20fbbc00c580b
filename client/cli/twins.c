/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "twins.h"

#include <stdio.h>

#include "column.h"
#include "waiting.h"

int twins_open(struct twins *twins, const struct common *common, const struct scene *scene)
{
    *twins = (struct twins){.common = common, .scene = scene, .warnings.unit = "twins"};
    struct percuss_client *client = NULL;
    int code = open_client(common, NULL, &client);
    if (code == EXIT_ANSWERED)
        code = scene_find_bodies(scene, common, client, &twins->bodies);
    twins->question =
        (struct twin_question){client, twins->bodies.pair, scene->options, common_timeout(common)};
    if (code == EXIT_ANSWERED)
        waiting_begin(common, client, "impacts");
    else
        twins_close(twins);
    return code;
}

void twins_close(struct twins *twins)
{
    waiting_end();
    percuss_body_list_free(&twins->bodies.list);
    if (twins->question.client)
        percuss_client_free(twins->question.client);
    tally_clear(&twins->warnings);
    *twins = (struct twins){0};
}

static int judge(const struct twins *twins, const struct percuss_request *request,
                 const struct percuss_reply *reply)
{
    int code = status_exit_code(reply->status);
    if (code == EXIT_ANSWERED || code == EXIT_ANSWERED_WITH_WARNING)
        return EXIT_ANSWERED;
    complain("%s: %s", percuss_status_name(reply->status), reply->message);
    if (reply->status == PERCUSS_UNKNOWN_BODY)
        scene_explain_unknown(twins->common, twins->question.client, request, &twins->bodies.list);
    return code;
}

static bool take(void *context, const struct percuss_request *request,
                 const struct percuss_reply *reply, size_t index)
{
    struct twins *twins = context;
    char place[32];
    snprintf(place, sizeof place, "impact %zu", index + 1);
    if (index == 0)
        tally_clear(&twins->warnings);
    twins->code = judge(twins, request, reply);
    if (twins->code == EXIT_ANSWERED && !tally_take(&twins->warnings, reply, place))
        twins->code = complain_memory();
    if (!waiting_count(1) && twins->code == EXIT_ANSWERED)
        twins->code = complain_interrupted();
    return twins->code == EXIT_ANSWERED;
}

struct twin_listener twins_listener(struct twins *twins)
{
    return (struct twin_listener){take, twins};
}

int twins_code(const struct twins *twins, enum percuss_result result)
{
    if (result == PERCUSS_RESULT_OK)
        return EXIT_ANSWERED;
    if (result == PERCUSS_RESULT_PENDING)
        return twins->code;
    return result == PERCUSS_RESULT_NO_MEMORY ? complain_memory() : complain_result(result);
}

int twins_ask(struct twins *twins, const struct measured_set *set,
              const struct twin_changes *changes, struct twin *list)
{
    const struct twin_listener listener = twins_listener(twins);
    return twins_code(twins, twin_ask(&twins->question, set, changes, &listener, list));
}

/* What the motion tells may be no restitution at all: a unit, a scale or a rate is wrong. */
static int twins_check(const struct measured_set *set)
{
    const struct column_kind *kind = &IMPACT_KINDS[IMPACT_RESTITUTION];
    for (size_t i = 0; i < set->count; i++) {
        double e = set->impacts[i].restitution;
        if (!(e < kind->low) && !(e > kind->high))
            continue;
        complain(
            "impact %zu: its restitution would be %g: must be %g to %g: are its units, --scale, "
            "--rate and --gravity right, and are all readings there?",
            i + 1, e, kind->low, kind->high);
        return EXIT_USAGE;
    }
    return EXIT_ANSWERED;
}

int twins_complete(const struct twins *twins, struct measured_set *set, const struct twin *list)
{
    size_t done = twin_complete(&twins->question, set, list);
    if (done == set->count)
        return twins_check(set);
    const bool of_b = set->impacts[done].momentum_of_b == 1.0;
    complain("impact %zu: the motion of %s does not tell the impulse, because it vibrates%s",
             done + 1, of_b ? twins->scene->b : twins->scene->a,
             of_b ? " or is held" : "; name the compact body with --a");
    return EXIT_USAGE;
}
