/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "specimens.h"

#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "error.h"
#include "exchange/encode.h"
#include "library.h"
#include "moment.h"

/* Not the id of any body. */
static const char DAMAGED_BODY[] = "(damaged)";

bool specimens_concern(const struct percuss_client *client, const struct question *question)
{
    bool named = false;
    for (uint32_t i = 0; i < question->request->bodies._length; i++)
        named = named || question->request->bodies._buffer[i].specimen[0];
    return named && client->specimens && !question->in_batch;
}

/* The dents of the bodies that are specimens, for free(). */
static enum percuss_status load(struct percuss_client *client, const struct question *question,
                                struct body_state **states, struct fault *fault)
{
    for (uint32_t i = 0; i < question->request->bodies._length; i++) {
        const percuss_v1_BodyMotion *wire = &question->request->bodies._buffer[i];
        const struct body *body = body_set_find(question->snapshot->set, wire->id);
        struct fault reason;
        /* an unknown body is the solver's to refuse */
        if (!wire->specimen[0] || !body)
            continue;
        enum percuss_status status =
            specimen_store_load(client->specimens, wire->specimen, body, &states[i], &reason);
        if (status)
            return fault_set(fault, status, "bodies[%u].specimen: %.560s", i, reason.text);
    }
    return PERCUSS_OK;
}

/* Stores the impact's dents; a request that ignores dents leaves none. */
static enum percuss_status store(struct percuss_client *client, const struct desk *desk,
                                 const struct question *question, struct fault *fault)
{
    struct specimen_change changes[PERCUSS_MAX_BODIES];
    size_t count = 0;
    if (question->request->options.dents != PERCUSS_DENTS_KEEP)
        return PERCUSS_OK;
    for (uint32_t i = 0; i < question->request->bodies._length; i++) {
        const percuss_v1_BodyMotion *wire = &question->request->bodies._buffer[i];
        if (wire->specimen[0])
            changes[count++] = (struct specimen_change){
                wire->specimen, body_set_find(question->snapshot->set, wire->id),
                desk->responder->result.bodies[i].state_after};
    }
    return specimen_store_commit(client->specimens, changes, count, NULL, fault);
}

struct answer *specimens_answer(struct percuss_client *client, struct desk *desk,
                                const struct question *question)
{
    struct body_state *states[PERCUSS_MAX_BODIES] = {NULL};
    struct question posed = *question;
    struct answer *answer = NULL;
    struct fault fault;
    posed.specimens = (const struct body_state *const *)states;
    /* the dents as they are, the impact, and the dents that it leaves */
    pthread_mutex_lock(&client->specimens_lock);
    enum percuss_status status = load(client, question, states, &fault);
    if (!status)
        answer = responder_answer(desk->responder, &posed);
    if (answer && encode_status_has_result(answer->reply->status))
        status = store(client, desk, question, &fault);
    pthread_mutex_unlock(&client->specimens_lock);
    for (size_t i = 0; i < PERCUSS_MAX_BODIES; i++)
        free(states[i]);
    if (!status)
        return answer;
    answer_release(answer);
    return encode_refusal(&question->envelope, status, fault.text);
}

/* A list that grows while the store is visited. */
struct collection {
    struct percuss_specimen_list *list;
    bool failed;
};

static void collect(void *context, const struct specimen *specimen)
{
    struct collection *collection = context;
    struct percuss_specimen_list *list = collection->list;
    struct percuss_specimen *made = &list->specimens[list->count];
    size_t dents = specimen->state ? specimen->state->dents : 0;
    if (collection->failed)
        return;
    /* one more, with room for its dents */
    *made = (struct percuss_specimen){.impacts = specimen->impacts, .dent_count = dents};
    made->dents = calloc(dents + 1, sizeof *made->dents);
    collection->failed = !made->dents;
    list->count++;
    /* a damaged one is seen, so that it can be cleared */
    strncpy(made->name, specimen->name, sizeof made->name - 1);
    strncpy(made->body, specimen->damaged ? DAMAGED_BODY : specimen->body, sizeof made->body - 1);
    /* as they are announced by a server */
    const struct dent *from = dents ? body_state_dents(specimen->state) : NULL;
    for (size_t i = 0; !collection->failed && i < dents; i++) {
        memcpy(made->dents[i].point, from[i].point, sizeof made->dents[i].point);
        made->dents[i].size = from[i].size;
        made->dents[i].max_indentation = from[i].history.max_indentation;
        made->dents[i].max_force = from[i].history.max_force;
        made->dents[i].residual_indentation = from[i].history.dent;
        made->dents[i].contact_radius = from[i].history.contact_radius;
    }
}

/* All that are kept; under their lock. */
static enum percuss_result visit(struct percuss_client *client, struct percuss_specimen_list *list)
{
    struct collection collection = {.list = list};
    struct fault fault = {{0}};
    list->specimens = calloc(specimen_store_count(client->specimens) + 1, sizeof *list->specimens);
    collection.failed = !list->specimens;
    enum percuss_status status =
        collection.failed
            ? PERCUSS_OK
            : specimen_store_visit(client->specimens, NULL, collect, &collection, &fault);
    if (!status && !collection.failed)
        return PERCUSS_RESULT_OK;
    percuss_specimen_list_free(list);
    return status ? error_set(PERCUSS_RESULT_TRANSPORT, "%s", fault.text)
                  : error_set(PERCUSS_RESULT_NO_MEMORY, "a list of specimens");
}

enum percuss_result local_specimens(struct percuss_client *client, double timeout,
                                    struct percuss_specimen_list *list)
{
    double deadline;
    *list = (struct percuss_specimen_list){0};
    enum percuss_result result = moment_deadline(timeout, &deadline);
    if (result != PERCUSS_RESULT_OK || !client->specimens)
        return result;
    pthread_mutex_lock(&client->specimens_lock);
    result = visit(client, list);
    pthread_mutex_unlock(&client->specimens_lock);
    return result;
}

enum percuss_result local_clear_specimen(struct percuss_client *client, const char *name,
                                         double timeout)
{
    struct percuss_specimen_list list;
    struct fault fault = {{0}};
    bool found = false;
    enum percuss_result result = local_specimens(client, timeout, &list);
    for (size_t i = 0; i < list.count; i++)
        found = found || strcmp(list.specimens[i].name, name) == 0;
    percuss_specimen_list_free(&list);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* only stored specimens can be cleared */
    if (!found)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "specimen: %.63s: the server keeps none of that name", name);
    pthread_mutex_lock(&client->specimens_lock);
    enum percuss_status status = specimen_store_clear(client->specimens, name, &fault);
    pthread_mutex_unlock(&client->specimens_lock);
    return status ? error_set(PERCUSS_RESULT_TRANSPORT, "%s", fault.text) : PERCUSS_RESULT_OK;
}
