/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "give.h"

#include <math.h>
#include <percuss/fields.h>
#include <stdlib.h>
#include <string.h>

/* Numbers of the .msg files are those of the vocabulary. */
#define SAME(message, constant) _Static_assert(percuss_msgs_msg_dds__##message == (constant), "")
#define SAME_STATUS(name, text) SAME(Answer_STATUS_##name, (unsigned)PERCUSS_##name);
#define SAME_END(name, text)    SAME(Answer_END_REASON_##name, (unsigned)PERCUSS_END_##name);
#define SAME_SOURCE(name, text)                                                                    \
    SAME(Answer_DELASSUS_SOURCE_##name, (unsigned)PERCUSS_DELASSUS_##name);
#define SAME_STATE(name, text)                                                                     \
    SAME(SubImpact_FRICTION_STATE_##name, (unsigned)PERCUSS_FRICTION_STATE_##name);
PERCUSS_STATUS_LIST(SAME_STATUS)
PERCUSS_END_REASON_LIST(SAME_END)
PERCUSS_DELASSUS_SOURCE_LIST(SAME_SOURCE)
PERCUSS_FRICTION_STATE_LIST(SAME_STATE)
SAME(Body_SUPPORT_FREE, (unsigned)PERCUSS_SUPPORT_FREE);
SAME(Body_SUPPORT_PINNED, (unsigned)PERCUSS_SUPPORT_PINNED);
SAME(Body_SUPPORT_CLAMPED, (unsigned)PERCUSS_SUPPORT_CLAMPED);

struct give_piece {
    struct give_piece *before;
    _Alignas(max_align_t) unsigned char data[];
};

/* Zeroed memory; NULL: there is none. */
static void *piece(struct give_pieces *pieces, size_t count, size_t size)
{
    struct give_piece *made = calloc(1, sizeof *made + count * size);
    if (!made)
        return NULL;
    made->before = pieces->last;
    pieces->last = made;
    return made->data;
}

void give_pieces_free(struct give_pieces *pieces)
{
    while (pieces->last) {
        struct give_piece *last = pieces->last;
        pieces->last = last->before;
        free(last);
    }
}

/* Copies a member from *from to *to. */
#define GIVE(kind, name, ...)      GIVE_##kind(name, __VA_ARGS__)
#define GIVE_VALUE(name, ...)      to->name = from->name;
#define GIVE_COUNT(name, ...)      to->name = from->name;
#define GIVE_LONG_COUNT(name, ...) to->name = from->name;
#define GIVE_CHOICE(name, ...)     to->name = from->name;
#define GIVE_FLAG(name, ...)       to->name = from->name;
#define GIVE_ID(name, ...)         to->name = (char *)from->name;
#define GIVE_TEXT(name, ...)       to->name = (char *)from->name;
#define GIVE_OCTETS(name, ...)     memcpy(to->name, from->name, sizeof to->name);
#define GIVE_VECTOR(name, ...)                                                                     \
    to->name.x = from->name[0];                                                                    \
    to->name.y = from->name[1];                                                                    \
    to->name.z = from->name[2];
#define GIVE_PAIR(name, ...) memcpy(to->name, from->name, sizeof to->name);
/* And those with members of their own. */
#define GIVE_OBJECT(name, element, ...)                                                            \
    if (!give_##element(pieces, &from->name, &to->name))                                           \
        return false;
#define GIVE_OPTIONAL GIVE_OBJECT
#define GIVE_BUFFER(name, count)                                                                   \
    to->name._length = to->name._maximum = (uint32_t)from->count;                                  \
    to->name._buffer = piece(pieces, from->count, sizeof *to->name._buffer);                       \
    if (!to->name._buffer)                                                                         \
        return false;
#define GIVE_LIST(name, count, element, ...)                                                       \
    GIVE_BUFFER(name, count)                                                                       \
    for (size_t i = 0; i < from->count; i++)                                                       \
        if (!give_##element(pieces, &from->name[i], &to->name._buffer[i]))                         \
            return false;
#define GIVE_TEXTS(name, count, ...)                                                               \
    GIVE_BUFFER(name, count)                                                                       \
    for (size_t i = 0; i < from->count; i++)                                                       \
        to->name._buffer[i] = (char *)from->name[i];

#define GIVE_STRUCT(element, Message, FIELDS)                                                      \
    static bool give_##element(struct give_pieces *pieces, const struct percuss_##element *from,   \
                               percuss_msgs_msg_dds__##Message##_ *to)                             \
    {                                                                                              \
        (void)pieces;                                                                              \
        FIELDS(GIVE, GIVE)                                                                         \
        return true;                                                                               \
    }
GIVE_STRUCT(sub_impact, SubImpact, PERCUSS_SUB_IMPACT_FIELDS)
GIVE_STRUCT(contact_result, ContactResult, PERCUSS_CONTACT_RESULT_FIELDS)
GIVE_STRUCT(body_velocity, BodyVelocity, PERCUSS_BODY_VELOCITY_FIELDS)
GIVE_STRUCT(body_state, BodyState, PERCUSS_BODY_STATE_FIELDS)
GIVE_STRUCT(body_energy, BodyEnergy, PERCUSS_BODY_ENERGY_FIELDS)
GIVE_STRUCT(energy, Energy, PERCUSS_ENERGY_FIELDS)
GIVE_STRUCT(error_estimate, ErrorEstimate, PERCUSS_ERROR_FIELDS)
GIVE_STRUCT(body_model, BodyModel, PERCUSS_BODY_MODEL_FIELDS)
GIVE_STRUCT(model, Model, PERCUSS_MODEL_FIELDS)
GIVE_STRUCT(timing, Timing, PERCUSS_TIMING_FIELDS)

/* The head's client and sequence are the bridge's own. */
static bool give_members(struct give_pieces *pieces, const struct percuss_reply *from,
                         percuss_msgs_msg_dds__Answer_ *to)
{
    GIVE_OCTETS(server)
    GIVE_TEXT(catalogue_revision)
    GIVE_TEXT(version)
    GIVE_CHOICE(status)
    GIVE_TEXT(message)
    PERCUSS_REPLY_FIELDS(GIVE, GIVE)
    return true;
}

bool give_answer(struct give_pieces *pieces, const struct percuss_reply *reply,
                 percuss_msgs_msg_dds__Answer_ *answer)
{
    memset(answer, 0, sizeof *answer);
    return give_members(pieces, reply, answer);
}

GIVE_STRUCT(relaxation_term, RelaxationTerm, PERCUSS_RELAXATION_TERM_FIELDS)
GIVE_STRUCT(contact_law, ContactLaw, PERCUSS_CONTACT_LAW_FIELDS)
GIVE_STRUCT(material_pair, MaterialPair, PERCUSS_MATERIAL_PAIR_FIELDS)

static bool give_site(struct give_pieces *pieces, const struct percuss_site *from,
                      percuss_msgs_msg_dds__BodySite_ *to)
{
    (void)pieces;
    GIVE_ID(name)
    GIVE_VECTOR(point)
    GIVE_VECTOR(normal)
    return true;
}

_Static_assert(sizeof((struct percuss_body *)NULL)->parameters ==
                   sizeof((percuss_msgs_msg_dds__Body_ *)NULL)->parameters,
               "as many as in the message");

static bool give_body(struct give_pieces *pieces, const struct percuss_body *from,
                      percuss_msgs_msg_dds__Body_ *to)
{
    GIVE_ID(id)
    GIVE_TEXT(shape)
    GIVE_TEXT(material)
    GIVE_VALUE(mass)
    GIVE_TEXT(description)
    GIVE_VECTOR(half_extents)
    GIVE_VALUE(radius)
    GIVE_VALUE(tip_radius)
    for (int end = 0; end < 2; end++)
        to->end_supports[end] = from->supports[end];
    memcpy(to->parameters, from->parameters, sizeof to->parameters);
    GIVE_VECTOR(inertia)
    GIVE_VECTOR(products)
    GIVE_LIST(sites, site_count, site)
    GIVE_VALUE(loss_factor)
    GIVE_VALUE(loss_frequency)
    GIVE_LIST(relaxation, relaxation_count, relaxation_term)
    GIVE_VALUE(rate_reference)
    GIVE_VALUE(rate_exponent)
    GIVE_VALUE(rate_coefficient)
    return true;
}

bool give_bodies(struct give_pieces *pieces, const struct percuss_body_list *from,
                 percuss_msgs_msg_dds__BodyList_ *to)
{
    GIVE_TEXT(catalogue_revision)
    GIVE_LIST(bodies, count, body)
    GIVE_LIST(pairs, pair_count, material_pair)
    return true;
}

void give_refusal(uint32_t status, const char *message, percuss_msgs_msg_dds__Answer_ *answer)
{
    static char nothing[] = "";
    memset(answer, 0, sizeof *answer);
    answer->status = status;
    answer->message = (char *)message;
    answer->catalogue_revision = answer->version = answer->model.reason = nothing;
    /* as the server leaves numbers that it does not compute */
    answer->window = NAN;
}
