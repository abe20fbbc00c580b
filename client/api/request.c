/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <percuss/ensemble.h>
#include <string.h>

struct percuss_options percuss_options_default(void)
{
    /* on the wire 0 selects the default of every option */
    return (struct percuss_options){0};
}

void percuss_request_init(struct percuss_request *request)
{
    /* the 32 KiB of bodies and contacts are filled as they are added */
    request->sequence = 0;
    request->body_count = 0;
    request->contact_count = 0;
    request->delassus = NULL;
    request->options = percuss_options_default();
}

struct percuss_body_motion *percuss_request_add_body(struct percuss_request *request,
                                                     const char *id)
{
    if (request->body_count >= PERCUSS_MAX_BODIES || strlen(id) >= PERCUSS_ID_SIZE)
        return NULL;
    struct percuss_body_motion *body = &request->bodies[request->body_count++];
    *body = (struct percuss_body_motion){.orientation = {1.0, 0.0, 0.0, 0.0}};
    strcpy(body->id, id);
    return body;
}

struct percuss_contact *percuss_request_add_contact(struct percuss_request *request, uint32_t a,
                                                    uint32_t b)
{
    if (request->contact_count >= PERCUSS_MAX_CONTACTS)
        return NULL;
    struct percuss_contact *contact = &request->contacts[request->contact_count++];
    *contact = (struct percuss_contact){.a = a, .b = b};
    return contact;
}

void percuss_ensemble_request_init(struct percuss_ensemble_request *request)
{
    memset(request, 0, sizeof *request);
    percuss_request_init(&request->scene);
    request->samples = 1000;
}
