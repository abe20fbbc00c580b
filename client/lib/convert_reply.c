/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "error.h"

/* Public strings are as long as the wire's bounds. */
#define COPY_TEXT(target, source)                                                                  \
    do {                                                                                           \
        _Static_assert(sizeof(target) == sizeof(source), "text of the wire's length");             \
        memcpy(target, source, sizeof(target));                                                    \
    } while (0)

static size_t storage_size(const percuss_v1_Reply *wire)
{
    size_t size = wire->contacts._length * sizeof(struct percuss_contact_result) +
                  wire->velocity_after._length * sizeof(struct percuss_body_velocity) +
                  wire->states_after._length * sizeof(struct percuss_body_state) +
                  wire->energy.vibration._length * sizeof(struct percuss_body_energy) +
                  wire->model.bodies._length * sizeof(struct percuss_body_model) +
                  wire->warnings._length * sizeof(char *);
    for (uint32_t i = 0; i < wire->contacts._length; ++i)
        size += wire->contacts._buffer[i].sub_impacts._length * sizeof(struct percuss_sub_impact);
    for (uint32_t i = 0; i < wire->warnings._length; ++i)
        size += strlen(wire->warnings._buffer[i]) + 1;
    return size;
}

/* The next `size` bytes of the block. Everything but the warnings' text, which comes last, keeps
 * doubles and pointers aligned. */
static void *carve(char **cursor, size_t size)
{
    void *start = *cursor;
    *cursor += size;
    return start;
}

static void convert_sub_impact(const percuss_v1_SubImpact *wire, struct percuss_sub_impact *sub)
{
    *sub = (struct percuss_sub_impact){
        .start = wire->start,
        .compression_end = wire->compression_end,
        .end = wire->end,
        .impulse = wire->impulse,
        .compression_impulse = wire->compression_impulse,
        .peak_force = wire->peak_force,
        .max_indentation = wire->max_indentation,
        .gap_rate_before = wire->gap_rate_before,
        .gap_rate_after = wire->gap_rate_after,
        .negligible = wire->negligible,
    };
}

static void convert_contact(const percuss_v1_ContactResult *wire, char **cursor,
                            struct percuss_contact_result *contact)
{
    *contact = (struct percuss_contact_result){
        .impulse = wire->impulse,
        .impulse_compression = wire->impulse_compression,
        .restitution = wire->restitution,
        .inverse_effective_mass = wire->inverse_effective_mass,
        .end_time = wire->end_time,
        .sub_impact_count = wire->sub_impact_count,
        .sub_impacts_listed = wire->sub_impacts._length,
    };
    memcpy(contact->impulse_vector, wire->impulse_vector, sizeof contact->impulse_vector);
    contact->sub_impacts =
        carve(cursor, contact->sub_impacts_listed * sizeof *contact->sub_impacts);
    for (uint32_t i = 0; i < contact->sub_impacts_listed; ++i)
        convert_sub_impact(&wire->sub_impacts._buffer[i], &contact->sub_impacts[i]);
}

static void convert_contacts(const percuss_v1_Reply *wire, char **cursor,
                             struct percuss_reply *reply)
{
    reply->contact_count = wire->contacts._length;
    reply->contacts = carve(cursor, reply->contact_count * sizeof *reply->contacts);
    for (size_t i = 0; i < reply->contact_count; ++i)
        convert_contact(&wire->contacts._buffer[i], cursor, &reply->contacts[i]);
}

static void convert_bodies_after(const percuss_v1_Reply *wire, char **cursor,
                                 struct percuss_reply *reply)
{
    reply->velocity_after_count = wire->velocity_after._length;
    reply->velocity_after =
        carve(cursor, reply->velocity_after_count * sizeof *reply->velocity_after);
    for (size_t i = 0; i < reply->velocity_after_count; ++i) {
        const percuss_v1_BodyVelocity *source = &wire->velocity_after._buffer[i];
        struct percuss_body_velocity *after = &reply->velocity_after[i];
        COPY_TEXT(after->id, source->id);
        memcpy(after->velocity, source->velocity, sizeof after->velocity);
        memcpy(after->angular_velocity, source->angular_velocity, sizeof after->angular_velocity);
    }
    reply->states_after_count = wire->states_after._length;
    reply->states_after = carve(cursor, reply->states_after_count * sizeof *reply->states_after);
    for (size_t i = 0; i < reply->states_after_count; ++i) {
        COPY_TEXT(reply->states_after[i].id, wire->states_after._buffer[i].id);
        COPY_TEXT(reply->states_after[i].state, wire->states_after._buffer[i].state);
    }
}

static void convert_energy(const percuss_v1_Energy *wire, char **cursor,
                           struct percuss_energy *energy)
{
    *energy = (struct percuss_energy){
        .available = wire->available,
        .rigid_after = wire->rigid_after,
        .vibration_count = wire->vibration._length,
        .damping = wire->damping,
        .plastic = wire->plastic,
        .stored = wire->stored,
        .closure = wire->closure,
    };
    energy->vibration = carve(cursor, energy->vibration_count * sizeof *energy->vibration);
    for (size_t i = 0; i < energy->vibration_count; ++i) {
        COPY_TEXT(energy->vibration[i].id, wire->vibration._buffer[i].id);
        energy->vibration[i].energy = wire->vibration._buffer[i].energy;
    }
}

static void convert_error(const percuss_v1_ErrorEstimate *wire,
                          struct percuss_error_estimate *error)
{
    *error = (struct percuss_error_estimate){
        .restitution_time = wire->restitution_time,
        .restitution_modes = wire->restitution_modes,
        .impulse_time = wire->impulse_time,
        .impulse_modes = wire->impulse_modes,
        .restitution_by_speed = wire->restitution_by_speed,
        .tolerance_met = wire->tolerance_met,
    };
}

static void convert_model(const percuss_v1_Model *wire, char **cursor, struct percuss_model *model)
{
    model->contact_model = wire->contact_model;
    model->compliance = wire->compliance;
    model->method = wire->method;
    COPY_TEXT(model->reason, wire->reason);
    model->omitted_error = wire->omitted_error;
    model->body_count = wire->bodies._length;
    model->bodies = carve(cursor, model->body_count * sizeof *model->bodies);
    for (size_t i = 0; i < model->body_count; ++i) {
        const percuss_v1_BodyModel *source = &wire->bodies._buffer[i];
        struct percuss_body_model *body = &model->bodies[i];
        *body = (struct percuss_body_model){
            .modes = source->modes, .rigid = source->rigid, .shear_factor = source->shear_factor};
        COPY_TEXT(body->id, source->id);
        COPY_TEXT(body->theory, source->theory);
    }
}

static void convert_warnings(const percuss_v1_Reply *wire, char **cursor,
                             struct percuss_reply *reply)
{
    reply->warning_count = wire->warnings._length;
    reply->warnings = carve(cursor, reply->warning_count * sizeof *reply->warnings);
    for (size_t i = 0; i < reply->warning_count; ++i) {
        size_t size = strlen(wire->warnings._buffer[i]) + 1;
        reply->warnings[i] = memcpy(carve(cursor, size), wire->warnings._buffer[i], size);
    }
}

static void convert_header(const percuss_v1_Reply *wire, struct percuss_reply *reply)
{
    memcpy(reply->client, wire->client, sizeof reply->client);
    reply->sequence = wire->sequence;
    memcpy(reply->server, wire->server, sizeof reply->server);
    COPY_TEXT(reply->catalogue_revision, wire->catalogue_revision);
    COPY_TEXT(reply->version, wire->version);
    reply->status = wire->status;
    COPY_TEXT(reply->message, wire->message);
    reply->complete = wire->complete;
    reply->end_reason = wire->end_reason;
    reply->window = wire->window;
    reply->delassus_source = wire->delassus_source;
    reply->time_shift = wire->time_shift;
    reply->timing.queue = wire->timing.queue;
    reply->timing.solve = wire->timing.solve;
}

enum percuss_result convert_reply(const percuss_v1_Reply *wire, struct percuss_reply *reply)
{
    *reply = (struct percuss_reply){0};
    char *cursor = malloc(storage_size(wire) + 1);
    if (!cursor)
        return error_set(PERCUSS_RESULT_NO_MEMORY, "a reply of %zu bytes", storage_size(wire));
    reply->storage = cursor;
    convert_header(wire, reply);
    convert_contacts(wire, &cursor, reply);
    convert_bodies_after(wire, &cursor, reply);
    convert_energy(&wire->energy, &cursor, &reply->energy);
    convert_error(&wire->error, &reply->error);
    convert_model(&wire->model, &cursor, &reply->model);
    convert_warnings(wire, &cursor, reply);
    return PERCUSS_RESULT_OK;
}

void percuss_reply_free(struct percuss_reply *reply)
{
    free(reply->storage);
    *reply = (struct percuss_reply){0};
}
