/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "desk.h"

#include <stdlib.h>

#include "moment.h"

enum percuss_status desk_is_wanted(void *context, struct fault *fault)
{
    struct patience *patience = context;
    if (!patience->over && !watching_asks(&patience->watching, &patience->ask))
        patience->cancelled = patience->over = true;
    patience->over = patience->over || moment_now() > patience->deadline;
    return patience->over ? fault_set(fault, PERCUSS_TIMEOUT, "nobody waits any more") : PERCUSS_OK;
}

/* While a contact table is computed for the question at hand. */
static enum percuss_status table_is_wanted(void *patience, const struct table_maker *maker,
                                           double done, struct fault *fault)
{
    (void)maker, (void)done;
    return desk_is_wanted(patience, fault);
}

static struct desk *create(const struct percuss_client *client)
{
    struct desk *desk = calloc(1, sizeof *desk);
    if (!desk)
        return NULL;
    const struct respond_means means = {
        .tokens = client->tokens,
        .limit = client->settings.limit_seconds,
        .tables = {.goes_on = table_is_wanted, .context = &desk->patience},
    };
    desk->responder = responder_create(&means);
    if (desk->responder)
        return desk;
    free(desk);
    return NULL;
}

struct desk *desk_take(struct percuss_client *client, double deadline)
{
    pthread_mutex_lock(&client->lock);
    const struct watching watching = client->watching;
    struct desk *desk = client->idle;
    if (desk)
        client->idle = desk->next;
    pthread_mutex_unlock(&client->lock);
    if (!desk)
        desk = create(client);
    if (desk)
        desk->patience = (struct patience){
            .deadline = deadline, .watching = watching, .ask = watching_first(&watching)};
    return desk;
}

void desk_give(struct percuss_client *client, struct desk *desk)
{
    pthread_mutex_lock(&client->lock);
    desk->next = client->idle;
    client->idle = desk;
    pthread_mutex_unlock(&client->lock);
}

void desk_free_all(struct percuss_client *client)
{
    for (struct desk *desk; (desk = client->idle);) {
        client->idle = desk->next;
        responder_free(desk->responder);
        free(desk);
    }
}
