/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "take.h"

#include <percuss/fields.h>
#include <stdio.h>
#include <string.h>

/* Numbers of the .msg files are those of the vocabulary. */
#define SAME(message, constant)    _Static_assert(percuss_msgs_msg_dds__##message == (constant), "")
#define SAME_PARAMETER(name, text) SAME(Override_##name, (unsigned)PERCUSS_PARAMETER_##name);
#define SAME_MODEL(name, text)     SAME(Options_CONTACT_MODEL_##name, (unsigned)PERCUSS_CONTACT_##name);
#define SAME_METHOD(name, text)    SAME(Options_METHOD_##name, (unsigned)PERCUSS_METHOD_##name);
#define SAME_COMPLIANCE(name, text)                                                                \
    SAME(Options_COMPLIANCE_##name, (unsigned)PERCUSS_COMPLIANCE_##name);
#define SAME_DENTS(name, text)    SAME(Options_DENTS_##name, (unsigned)PERCUSS_DENTS_##name);
#define SAME_FRICTION(name, text) SAME(Options_FRICTION_##name, (unsigned)PERCUSS_FRICTION_##name);
PERCUSS_PARAMETER_LIST(SAME_PARAMETER)
PERCUSS_CONTACT_MODEL_LIST(SAME_MODEL)
PERCUSS_METHOD_LIST(SAME_METHOD)
PERCUSS_COMPLIANCE_LIST(SAME_COMPLIANCE)
PERCUSS_DENTS_LIST(SAME_DENTS)
PERCUSS_FRICTION_LIST(SAME_FRICTION)

/* Copies a member from *from to *to; the texts of body `index` may be too long. */
#define TAKE(kind, name, ...)     TAKE_##kind(name, __VA_ARGS__)
#define TAKE_NUMBER(name, ...)    to->name = from->name;
#define TAKE_DEFAULTED(name, ...) to->name = from->name;
#define TAKE_INDEX(name, ...)     to->name = from->name;
#define TAKE_FLAG(name, ...)      to->name = from->name;
#define TAKE_CHOICE(name, ...)    to->name = from->name;
#define TAKE_VECTOR(name, ...)                                                                     \
    to->name[0] = from->name.x;                                                                    \
    to->name[1] = from->name.y;                                                                    \
    to->name[2] = from->name.z;
#define TAKE_UNIT(name, size, ...) TAKE_UNIT_##size(name)
#define TAKE_UNIT_3(name)          TAKE_VECTOR(name)
#define TAKE_UNIT_4(name)                                                                          \
    to->name[0] = from->name.w;                                                                    \
    to->name[1] = from->name.x;                                                                    \
    to->name[2] = from->name.y;                                                                    \
    to->name[3] = from->name.z;
#define TAKE_ID(name, ...) TAKE_TEXT(name)
#define TAKE_TEXT(name, ...)                                                                       \
    if (!take_text(from->name, to->name, index, #name, problem))                                   \
        return false;

static bool take_text(const char *from, char to[PERCUSS_ID_SIZE], uint32_t index, const char *name,
                      char *problem)
{
    size_t length = strlen(from);
    if (length >= PERCUSS_ID_SIZE) {
        snprintf(problem, TAKE_PROBLEM_SIZE, "bodies[%u].%s has %zu bytes, at most %d are allowed",
                 index, name, length, PERCUSS_ID_SIZE - 1);
        return false;
    }
    memcpy(to, from, length + 1);
    return true;
}

static bool fits(const char *name, size_t count, size_t most, char *problem)
{
    if (count > most)
        snprintf(problem, TAKE_PROBLEM_SIZE, "%s: %zu, at most %zu are allowed", name, count, most);
    return count <= most;
}

static bool take_body(const percuss_msgs_msg_dds__BodyMotion_ *from, uint32_t index,
                      struct percuss_body_motion *to, char *problem)
{
    char name[40];
    PERCUSS_BODY_FIELDS(TAKE, PERCUSS_NONE)
    snprintf(name, sizeof name, "bodies[%u].overrides", index);
    if (!fits(name, from->overrides._length, PERCUSS_PARAMETER_COUNT, problem))
        return false;
    to->override_count = from->overrides._length;
    for (uint32_t i = 0; i < to->override_count; i++) {
        to->overrides[i].parameter = from->overrides._buffer[i].parameter;
        to->overrides[i].value = from->overrides._buffer[i].value;
    }
    return true;
}

static void take_contact(const percuss_msgs_msg_dds__Contact_ *from, struct percuss_contact *to)
{
    PERCUSS_CONTACT_FIELDS(TAKE, PERCUSS_NONE)
}

/* But for `trace`: time histories do not go to ROS 2. */
static void take_options(const percuss_msgs_msg_dds__Options_ *from, struct percuss_options *to)
{
    *to = (struct percuss_options){.tolerance = from->tolerance,
                                   .horizon = from->horizon,
                                   .contact_model = from->contact_model,
                                   .method = from->method,
                                   .compliance = from->compliance,
                                   .dents = from->dents,
                                   .conditioning = from->conditioning,
                                   .deadline = from->deadline,
                                   .friction = from->friction};
}

bool take_question(const percuss_msgs_msg_dds__Question_ *question, struct percuss_request *request,
                   char problem[TAKE_PROBLEM_SIZE])
{
    const uint32_t bodies = question->bodies._length, contacts = question->contacts._length;
    const uint32_t numbers = question->delassus._length;
    /* lists that do not fit */
    if (!fits("bodies", bodies, PERCUSS_MAX_BODIES, problem) ||
        !fits("contacts", contacts, PERCUSS_MAX_CONTACTS, problem))
        return false;
    bool oblique = numbers == 9 * contacts * contacts;
    if (numbers != 0 && numbers != contacts * contacts && !oblique) {
        snprintf(problem, TAKE_PROBLEM_SIZE,
                 "delassus: %u numbers, %u, %u (with both tangents) or none are allowed", numbers,
                 contacts * contacts, 9 * contacts * contacts);
        return false;
    }
    if (!fits("delassus", numbers, PERCUSS_MAX_DELASSUS, problem))
        return false;
    /* the rest as it is */
    percuss_request_init(request);
    request->body_count = bodies;
    for (uint32_t i = 0; i < bodies; i++)
        if (!take_body(&question->bodies._buffer[i], i, &request->bodies[i], problem))
            return false;
    request->contact_count = contacts;
    for (uint32_t i = 0; i < contacts; i++)
        take_contact(&question->contacts._buffer[i], &request->contacts[i]);
    request->delassus = numbers ? question->delassus._buffer : NULL;
    request->delassus_rows = numbers && oblique ? 3 * contacts : 0;
    take_options(&question->options, &request->options);
    return true;
}
