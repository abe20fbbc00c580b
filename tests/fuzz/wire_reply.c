/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bytes from the network as replies and announcements in the client library, and what the command
 * line makes of them. */
#include <math.h>

#include "batch.h"
#include "convert.h"
#include "ensemble_exchange.h"
#include "ensemble_output.h"
#include "gather.h"
#include "reply_json.h"
#include "samples.h"

/* Asked for: so many replies, traced contacts and inputs. */
enum { ASKED = 3 };

struct exchanges {
    struct batch batch;
    struct gather gather;
    struct ensemble_exchange ensemble;
};

static void require_reply(const struct percuss_reply *reply)
{
    FUZZ_REQUIRE(reply->contact_count == 0 || reply->contacts, "contacts that are not there");
    for (uint32_t i = 0; i < reply->contact_count; i++)
        FUZZ_REQUIRE(reply->contacts[i].sub_impacts_listed == 0 || reply->contacts[i].sub_impacts,
                     "sub-impacts that are not there");
    json_t *json = reply_to_json(reply);
    FUZZ_REQUIRE(json, "a reply that is no JSON");
    char *text = json_dumps(json, 0);
    free(text);
    json_decref(json);
}

static void take_reply(const percuss_v1_Reply *wire)
{
    struct percuss_reply reply;
    if (convert_reply(wire, &reply) == PERCUSS_RESULT_OK)
        require_reply(&reply);
    percuss_reply_free(&reply);
}

static void take_ensemble(struct ensemble_exchange *exchange, const percuss_v1_EnsembleReply *wire)
{
    if (exchange->reply.storage)
        return;
    if (convert_ensemble_reply(wire, &exchange->reply) != PERCUSS_RESULT_OK)
        return;
    json_decref(ensemble_to_json(&exchange->reply));
    ensemble_exchange_is_complete(exchange);
}

static void take_body(const percuss_v1_Body *wire)
{
    struct percuss_body body;
    struct percuss_request request;
    convert_announced_body(wire, &body);
    FUZZ_REQUIRE(body.site_count <= PERCUSS_MAX_SITES, "%zu sites", body.site_count);
    FUZZ_REQUIRE(body.relaxation_count <= PERCUSS_MAX_RELAXATION, "%zu terms",
                 body.relaxation_count);
    for (uint32_t i = 0; i < wire->pairs._length; i++) {
        struct percuss_material_pair pair;
        convert_announced_pair(&wire->pairs._buffer[i], &pair);
    }
    struct percuss_pair pair = percuss_pair_default(&body, &body);
    pair.speed = 1.0;
    percuss_contact_pair(&pair, &request);
}

static void take_server(const percuss_v1_ServerStatus *wire)
{
    struct percuss_server server;
    FUZZ_REQUIRE(convert_announced_server(wire, &server) && server.task_count <= PERCUSS_MAX_TASKS,
                 "%zu tasks", server.task_count);
    free(server.tasks);
}

static void take_announcement(int type, const void *sample)
{
    struct percuss_specimen specimen;
    if (type == 9)
        take_server(sample);
    else if (type == 10)
        take_body(sample);
    else if (convert_announced_specimen(sample, &specimen))
        free(specimen.dents);
}

static void visit(void *context, int type, const void *sample)
{
    struct exchanges *all = context;
    switch (type) {
    case 1:
        take_reply(sample);
        break;
    case 3:
        batch_add_part(&all->batch, sample);
        break;
    case 5:
        ensemble_exchange_note(&all->ensemble, sample);
        break;
    case 6:
        ensemble_exchange_add(&all->ensemble, sample);
        break;
    case 7:
        take_ensemble(&all->ensemble, sample);
        break;
    case 8:
        gather_add(&all->gather, sample);
        break;
    default:
        take_announcement(type, sample);
    }
}

static void collect(struct exchanges *all)
{
    struct percuss_reply replies[ASKED] = {0};
    struct percuss_trace trace = {0};
    if (all->batch.parts && !all->batch.missing) {
        batch_collect(&all->batch, replies, ASKED);
        for (int i = 0; i < ASKED; i++) {
            require_reply(&replies[i]);
            percuss_reply_free(&replies[i]);
        }
    }
    batch_clear(&all->batch);
    if (gather_is_complete(&all->gather, 1)) {
        gather_collect(&all->gather, 1, &trace);
        percuss_trace_free(&trace);
    }
    gather_clear(&all->gather);
    percuss_ensemble_reply_free(&all->ensemble.reply);
    free(all->ensemble.rows);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct exchanges all;
    memset(&all, 0, sizeof all);
    all.ensemble.columns = ASKED;
    samples_give(data, size, 0xfea, visit, &all);
    collect(&all);
    return 0;
}
