/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <string.h>

#include "convert.h"
#include "error.h"
#include "percuss/fields.h"

/* The text that a caller has filled to the brim; NULL: none. */
static const char *find_unterminated(const struct percuss_body_motion *body)
{
    if (!memchr(body->id, '\0', sizeof body->id))
        return "id";
    if (!memchr(body->state, '\0', sizeof body->state))
        return "state";
    return memchr(body->specimen, '\0', sizeof body->specimen) ? NULL : "specimen";
}

static enum percuss_result convert_body(const struct percuss_body_motion *from, size_t index,
                                        struct request_storage *storage)
{
    percuss_v1_BodyMotion *to = &storage->bodies[index];
    const char *field = find_unterminated(from);
    if (field)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "bodies[%zu].%s: not terminated; up to %d bytes are allowed", index, field,
                         PERCUSS_ID_SIZE - 1);
    if (from->override_count > PERCUSS_PARAMETER_COUNT)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "bodies[%zu].override_count: %u are too many; up to %d are allowed", index,
                         from->override_count, PERCUSS_PARAMETER_COUNT);
    PERCUSS_BODY_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    for (uint32_t i = 0; i < from->override_count; i++)
        storage->overrides[index][i] =
            (percuss_v1_Override){from->overrides[i].parameter, from->overrides[i].value};
    to->overrides._buffer = storage->overrides[index];
    to->overrides._length = to->overrides._maximum = from->override_count;
    to->overrides._release = false;
    return PERCUSS_RESULT_OK;
}

static void convert_contact(const struct percuss_contact *from, percuss_v1_Contact *to)
{
    PERCUSS_CONTACT_FIELDS(PERCUSS_COPY)
}

static void convert_options(const struct percuss_options *from, percuss_v1_Options *to)
{
    PERCUSS_OPTION_FIELDS(PERCUSS_COPY)
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
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < request->body_count; i++)
        result = convert_body(&request->bodies[i], i, storage);
    if (result != PERCUSS_RESULT_OK)
        return result;
    for (size_t i = 0; i < request->contact_count; i++)
        convert_contact(&request->contacts[i], &storage->contacts[i]);

    uint32_t contacts = (uint32_t)request->contact_count;
    *wire = (percuss_v1_Request){0};
    convert_options(&request->options, &wire->options);
    wire->bodies._buffer = storage->bodies;
    wire->bodies._length = wire->bodies._maximum = (uint32_t)request->body_count;
    wire->contacts._buffer = storage->contacts;
    wire->contacts._length = wire->contacts._maximum = contacts;
    if (request->delassus) {
        /* writing only reads it */
        wire->delassus._buffer = (double *)request->delassus;
        wire->delassus._length = wire->delassus._maximum = contacts * contacts;
    }
    return PERCUSS_RESULT_OK;
}
