/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <string.h>

#include "convert.h"
#include "error.h"

/* Copies a public string of PERCUSS_ID_SIZE bytes that a caller may have filled to the brim. */
static bool copy_text(char *target, const char *source)
{
    size_t length = strnlen(source, PERCUSS_ID_SIZE);
    if (length == PERCUSS_ID_SIZE)
        return false;
    memcpy(target, source, length + 1);
    return true;
}

static enum percuss_result convert_body(const struct percuss_body_motion *body, size_t index,
                                        struct request_storage *storage)
{
    percuss_v1_BodyMotion *wire = &storage->bodies[index];
    const char *field = NULL;
    if (!copy_text(wire->id, body->id))
        field = "id";
    else if (!copy_text(wire->state, body->state))
        field = "state";
    else if (!copy_text(wire->specimen, body->specimen))
        field = "specimen";
    if (field)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "bodies[%zu].%s: not terminated; up to %d bytes are allowed", index, field,
                         PERCUSS_ID_SIZE - 1);
    if (body->override_count > PERCUSS_PARAMETER_COUNT)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "bodies[%zu].override_count: %u are too many; up to %d are allowed", index,
                         body->override_count, PERCUSS_PARAMETER_COUNT);
    for (uint32_t i = 0; i < body->override_count; ++i)
        storage->overrides[index][i] =
            (percuss_v1_Override){body->overrides[i].parameter, body->overrides[i].value};
    wire->overrides._buffer = storage->overrides[index];
    wire->overrides._length = wire->overrides._maximum = body->override_count;
    wire->overrides._release = false;
    memcpy(wire->position, body->position, sizeof wire->position);
    memcpy(wire->orientation, body->orientation, sizeof wire->orientation);
    memcpy(wire->velocity, body->velocity, sizeof wire->velocity);
    memcpy(wire->angular_velocity, body->angular_velocity, sizeof wire->angular_velocity);
    wire->elapsed = body->elapsed;
    return PERCUSS_RESULT_OK;
}

static void convert_contact(const struct percuss_contact *contact, percuss_v1_Contact *wire)
{
    wire->a = contact->a;
    wire->b = contact->b;
    memcpy(wire->point, contact->point, sizeof wire->point);
    memcpy(wire->normal, contact->normal, sizeof wire->normal);
    wire->gap = contact->gap;
    wire->gap_acceleration = contact->gap_acceleration;
}

static percuss_v1_Options convert_options(const struct percuss_options *options)
{
    return (percuss_v1_Options){
        .tolerance = options->tolerance,
        .horizon = options->horizon,
        .contact_model = options->contact_model,
        .method = options->method,
        .compliance = options->compliance,
        .dents = options->dents,
        .conditioning = options->conditioning,
        .trace = options->trace,
        .deadline = options->deadline,
    };
}

static enum percuss_result check_count(const char *field, size_t count, size_t most)
{
    if (count <= most)
        return PERCUSS_RESULT_OK;
    return error_set(PERCUSS_RESULT_INVALID_ARGUMENT, "%s: %zu are too many; up to %zu are allowed",
                     field, count, most);
}

enum percuss_result convert_request(const struct percuss_request *request,
                                    struct request_storage *storage, percuss_v1_Request *wire)
{
    enum percuss_result result = check_count("bodies", request->body_count, PERCUSS_MAX_BODIES);
    if (result == PERCUSS_RESULT_OK)
        result = check_count("contacts", request->contact_count, PERCUSS_MAX_CONTACTS);
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < request->body_count; ++i)
        result = convert_body(&request->bodies[i], i, storage);
    if (result != PERCUSS_RESULT_OK)
        return result;
    for (size_t i = 0; i < request->contact_count; ++i)
        convert_contact(&request->contacts[i], &storage->contacts[i]);

    uint32_t contacts = (uint32_t)request->contact_count;
    *wire = (percuss_v1_Request){.options = convert_options(&request->options)};
    wire->bodies._buffer = storage->bodies;
    wire->bodies._length = wire->bodies._maximum = (uint32_t)request->body_count;
    wire->contacts._buffer = storage->contacts;
    wire->contacts._length = wire->contacts._maximum = contacts;
    if (request->delassus) {
        // writing only reads it
        wire->delassus._buffer = (double *)request->delassus;
        wire->delassus._length = wire->delassus._maximum = contacts * contacts;
    }
    return PERCUSS_RESULT_OK;
}
