/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "source.h"

#include <dlfcn.h>
#include <math.h>
#include <percuss/local.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "percuss/similar.h"

/* s; a percussd is found within a second or two, and answers within milliseconds: the limits only
 * end a hang */
static const double CONNECT_TIMEOUT = 10.0;
static const double ANSWER_TIMEOUT = 60.0;

/* In this process, with the settings inside the FMU. */
static bool open_local(const struct source_choice *choice, const char *resources,
                       struct source *source, char message[SOURCE_MESSAGE_SIZE])
{
    char *settings;
    if (asprintf(&settings, "%s/percussd.yaml", resources) < 0) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "out of memory");
        return false;
    }
    struct percuss_local_config config = percuss_local_config_default();
    config.settings = settings;
    if (choice->catalogue[0])
        config.catalogue = choice->catalogue;
    bool opened = percuss_local_open(&config, &source->client) == PERCUSS_RESULT_OK;
    if (!opened)
        snprintf(message, SOURCE_MESSAGE_SIZE, "%s", percuss_error_text());
    free(settings);
    return opened;
}

/* By the functions of the client library, which stays where it is: threads of DDS outlive a client.
 */
static bool open_service(const struct source_choice *choice, struct source *source,
                         char message[SOURCE_MESSAGE_SIZE])
{
    /* the two functions that this FMU has not itself; a client finds the others */
    void *library = dlopen(choice->library, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "library: %s", dlerror());
        return false;
    }
    struct percuss_client_config (*config_default)(void) =
        (struct percuss_client_config(*)(void))dlsym(library, "percuss_client_config_default");
    enum percuss_result (*create)(const struct percuss_client_config *, struct percuss_client **) =
        (enum percuss_result(*)(const struct percuss_client_config *,
                                struct percuss_client **))dlsym(library, "percuss_client_create");
    if (!config_default || !create) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "library: '%s' is no libpercuss", choice->library);
        return false;
    }

    /* connected before anything is asked */
    struct percuss_client_config config = config_default();
    config.domain = (uint32_t)choice->domain;
    const char *(*error_text)(void) = (const char *(*)(void))dlsym(library, "percuss_error_text");
    if (create(&config, &source->client) != PERCUSS_RESULT_OK) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "%s", error_text ? error_text() : "no client");
        return false;
    }
    if (percuss_client_connect(source->client, CONNECT_TIMEOUT) != PERCUSS_RESULT_OK) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "domain %d: %s", (int)choice->domain,
                 percuss_error_text());
        return false;
    }
    return true;
}

struct source *source_open(const struct source_choice *choice, const char *resources,
                           char message[SOURCE_MESSAGE_SIZE])
{
    struct source *source = calloc(1, sizeof *source);
    if (!source) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "out of memory");
        return NULL;
    }
    memcpy(&source->choice, choice, sizeof *choice);
    bool opened = choice->service ? open_service(choice, source, message)
                                  : open_local(choice, resources, source, message);
    if (opened &&
        percuss_bodies(source->client, ANSWER_TIMEOUT, &source->bodies) != PERCUSS_RESULT_OK) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "%s", percuss_error_text());
        opened = false;
    }
    if (!opened) {
        source_close(source);
        return NULL;
    }
    return source;
}

void source_close(struct source *source)
{
    if (!source)
        return;
    percuss_body_list_free(&source->bodies);
    percuss_client_free(source->client);
    free(source);
}

static const struct percuss_body *find(const struct source *source, const char *variable,
                                       const char *id, char message[SOURCE_MESSAGE_SIZE])
{
    const struct percuss_body *body = percuss_body_find(&source->bodies, id);
    if (body)
        return body;
    struct similar similar = similar_to(id);
    for (size_t i = 0; i < source->bodies.count; i++)
        similar_offer(&similar, source->bodies.bodies[i].id);
    const char *meant = similar.nearest;
    int length = snprintf(message, SOURCE_MESSAGE_SIZE,
                          "%s: '%.64s' is not in the catalogue%s%s%s, which has:", variable, id,
                          meant ? " (did you mean '" : "", meant ? meant : "", meant ? "'?)" : "");
    for (size_t i = 0; i < source->bodies.count && length < SOURCE_MESSAGE_SIZE; i++)
        length += snprintf(message + length, SOURCE_MESSAGE_SIZE - (size_t)length, " %s",
                           source->bodies.bodies[i].id);
    return NULL;
}

bool source_find(const struct source *source, const struct shared *shared,
                 const struct percuss_body *bodies[2], char message[SOURCE_MESSAGE_SIZE])
{
    bodies[0] = find(source, "body_a", shared->body_a, message);
    bodies[1] = bodies[0] ? find(source, "body_b", shared->body_b, message) : NULL;
    return bodies[1] != NULL;
}

bool source_pair(const struct source *source, const struct shared *shared, double speed,
                 struct percuss_request *request, char message[SOURCE_MESSAGE_SIZE])
{
    const struct percuss_body *bodies[2];
    if (!source_find(source, shared, bodies, message))
        return false;
    struct percuss_pair pair = percuss_pair_default(bodies[0], bodies[1]);
    pair.speed = speed;
    pair.site_a = shared->site_a[0] ? shared->site_a : NULL;
    pair.site_b = shared->site_b[0] ? shared->site_b : NULL;
    /* of two beams the one that is hit, as on the command line */
    *(strcmp(pair.b->shape, "beam") == 0 ? &pair.at_b : &pair.at_a) = shared->at;
    if (percuss_contact_pair(&pair, request) != PERCUSS_RESULT_OK) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "%s", percuss_error_text());
        return false;
    }
    request->options.tolerance = shared->tolerance;
    /* along the normal nothing slides */
    request->options.friction = PERCUSS_FRICTION_NONE;
    return true;
}

/* That the answer is not a whole one, and all that it warns of, a line each. */
static void take_warnings(const struct percuss_reply *reply, char warning[SOURCE_MESSAGE_SIZE])
{
    size_t length = 0;
    warning[0] = '\0';
    if (!reply->complete)
        length = (size_t)snprintf(warning, SOURCE_MESSAGE_SIZE,
                                  "the impact was not over when its solution ended (%s)",
                                  percuss_end_reason_name(reply->end_reason));
    for (size_t i = 0; i < reply->warning_count && length < SOURCE_MESSAGE_SIZE; i++)
        length += (size_t)snprintf(warning + length, SOURCE_MESSAGE_SIZE - length, "%s%s",
                                   length > 0 ? "\n" : "", reply->warnings[i]);
}

bool source_ask(const struct source *source, const struct percuss_request *request,
                struct impact *impact, char warning[SOURCE_MESSAGE_SIZE],
                char message[SOURCE_MESSAGE_SIZE])
{
    /* no other process can hang here */
    double timeout = source->choice.service ? ANSWER_TIMEOUT : INFINITY;
    struct percuss_reply reply;
    if (percuss_solve(source->client, request, timeout, &reply) != PERCUSS_RESULT_OK) {
        snprintf(message, SOURCE_MESSAGE_SIZE, "%s", percuss_error_text());
        return false;
    }

    /* a refusal is an answer, too */
    bool answered = reply.status == PERCUSS_OK && reply.contact_count == 1;
    if (answered) {
        const struct percuss_contact_result *contact = &reply.contacts[0];
        impact->impulse = contact->impulse;
        impact->restitution = contact->restitution;
        /* a tangential impulse, too, changes the gap rate */
        bool rubs = contact->friction > 0.0 && !isnan(contact->restitution_kinematic);
        impact->rebound = rubs ? contact->restitution_kinematic : contact->restitution;
        memcpy(impact->vector, contact->impulse_vector, sizeof impact->vector);
        impact->friction_loss = contact->friction > 0.0 ? reply.energy.friction : 0.0;
        impact->duration = contact->end_time;
        impact->sub_impacts = (int32_t)contact->sub_impact_count;
        impact->error = reply.error.restitution_time + reply.error.restitution_modes;
        impact->total_error = reply.error.restitution_total;
        impact->inverse_effective_mass = contact->inverse_effective_mass;
        take_warnings(&reply, warning);
    } else
        snprintf(message, SOURCE_MESSAGE_SIZE, "%s: %s", percuss_status_name(reply.status),
                 reply.message);
    percuss_reply_free(&reply);
    return answered;
}
