/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <percuss/ensemble.h>
#include <string.h>

#include "error.h"

struct percuss_options percuss_options_default(void)
{
    /* on the wire 0 selects the default of every option */
    return (struct percuss_options){0};
}

void percuss_request_init(struct percuss_request *request)
{
    if (ERROR_NULL(request))
        return;
    /* the 32 KiB of bodies and contacts are filled as they are added */
    request->sequence = 0;
    request->body_count = 0;
    request->contact_count = 0;
    request->delassus = NULL;
    request->delassus_rows = 0;
    request->options = percuss_options_default();
}

struct percuss_body_motion *percuss_request_add_body(struct percuss_request *request,
                                                     const char *id)
{
    if (ERROR_NULL(request, id))
        return NULL;
    if (request->body_count >= PERCUSS_MAX_BODIES) {
        error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "bodies: up to %d are allowed",
                  PERCUSS_MAX_BODIES);
        return NULL;
    }
    if (strlen(id) >= PERCUSS_ID_SIZE) {
        error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "id: '%.80s': up to %d bytes are allowed", id,
                  PERCUSS_ID_SIZE - 1);
        return NULL;
    }
    struct percuss_body_motion *body = &request->bodies[request->body_count++];
    *body = (struct percuss_body_motion){.orientation = {1.0, 0.0, 0.0, 0.0}};
    strcpy(body->id, id);
    return body;
}

struct percuss_contact *percuss_request_add_contact(struct percuss_request *request, uint32_t a,
                                                    uint32_t b)
{
    if (ERROR_NULL(request))
        return NULL;
    if (request->contact_count >= PERCUSS_MAX_CONTACTS) {
        error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "contacts: up to %d are allowed",
                  PERCUSS_MAX_CONTACTS);
        return NULL;
    }
    struct percuss_contact *contact = &request->contacts[request->contact_count++];
    *contact = (struct percuss_contact){.a = a, .b = b};
    return contact;
}

void percuss_ensemble_request_init(struct percuss_ensemble_request *request)
{
    if (ERROR_NULL(request))
        return;
    memset(request, 0, sizeof *request);
    percuss_request_init(&request->scene);
    request->samples = 1000;
}
