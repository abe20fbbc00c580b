/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/encode.h"

#include <math.h>
#include <string.h>

#include "endpoint/encode_trace.h"
#include "endpoint/text.h"

/* The fields that every kind of reply begins with. */
#define FILL_ENVELOPE(wire, envelope)                                                              \
    do {                                                                                           \
        memcpy((wire)->client, (envelope)->client, sizeof(wire)->client);                          \
        memcpy((wire)->server, (envelope)->server, sizeof(wire)->server);                          \
        (wire)->sequence = (envelope)->sequence;                                                   \
        COPY_TEXT((wire)->catalogue_revision, (envelope)->revision);                               \
        COPY_TEXT((wire)->version, (envelope)->version);                                           \
    } while (0)

/* Gives a sequence its elements; they live and die with the answer, not with the sample. */
#define FILL_SEQUENCE(sequence, buffer, count)                                                     \
    do {                                                                                           \
        (sequence)._buffer = (buffer);                                                             \
        (sequence)._length = (sequence)._maximum = (uint32_t)(count);                              \
        (sequence)._release = false;                                                               \
    } while (0)

bool encode_status_has_result(enum percuss_status status)
{
    return status == PERCUSS_OK || status == PERCUSS_TRUNCATED;
}

bool encode_status_is_passing(enum percuss_status status)
{
    return status == PERCUSS_BUSY || status == PERCUSS_TIMEOUT || status == PERCUSS_INTERNAL;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static void fill_undefined(percuss_v1_Reply *reply)
{
    reply->window = reply->time_shift = NAN;
    percuss_v1_Energy *energy = &reply->energy;
    energy->available = energy->rigid_after = energy->damping = NAN;
    energy->plastic = energy->stored = energy->closure = NAN;
    percuss_v1_ErrorEstimate *error = &reply->error;
    error->restitution_time = error->restitution_modes = NAN;
    error->impulse_time = error->impulse_modes = error->restitution_by_speed = NAN;
    reply->model.omitted_error = NAN;
}

static struct answer *create_blank(const struct envelope *envelope, size_t room)
{
    struct answer *answer =
        answer_create(EXCHANGE_SINGLE, room + answer_room(1, sizeof *answer->reply));
    if (!answer)
        return NULL;
    answer->reply = answer_take(answer, 1, sizeof *answer->reply);
    FILL_ENVELOPE(answer->reply, envelope);
    fill_undefined(answer->reply);
    return answer;
}

struct answer *encode_refusal(const struct envelope *envelope, enum percuss_status status,
                              const char *message)
{
    struct answer *answer = create_blank(envelope, 0);
    if (answer) {
        answer->reply->status = status;
        answer->passing = encode_status_is_passing(status);
        COPY_TEXT(answer->reply->message, message);
    }
    return answer;
}

void encode_batch_head(percuss_v1_BatchReply *part, const struct envelope *envelope,
                       enum percuss_status status, const char *message)
{
    FILL_ENVELOPE(part, envelope);
    part->part = 0;
    part->parts = 1;
    part->status = status;
    COPY_TEXT(part->message, message);
}

struct answer *encode_batch_refusal(const struct envelope *envelope, enum percuss_status status,
                                    const char *message)
{
    struct answer *answer = answer_create(EXCHANGE_BATCH, answer_room(1, sizeof *answer->parts));
    if (!answer)
        return NULL;
    answer->parts = answer_take(answer, 1, sizeof *answer->parts);
    answer->part_count = 1;
    answer->passing = encode_status_is_passing(status);
    encode_batch_head(answer->parts, envelope, status, message);
    return answer;
}

struct answer *encode_ensemble_refusal(const struct envelope *envelope, enum percuss_status status,
                                       const char *message)
{
    struct answer *answer =
        answer_create(EXCHANGE_ENSEMBLE, answer_room(1, sizeof *answer->report));
    if (!answer)
        return NULL;
    answer->report = answer_take(answer, 1, sizeof *answer->report);
    FILL_ENVELOPE(answer->report, envelope);
    answer->report->status = status;
    answer->passing = encode_status_is_passing(status);
    COPY_TEXT(answer->report->message, message);
    percuss_v1_EnsembleReply *report = answer->report;
    report->possible_low = report->possible_high = report->cut = report->step_accuracy = NAN;
    return answer;
}

static void fill_sub_impacts(struct answer *answer, const struct solve_contact_result *from,
                             percuss_v1_ContactResult *to, size_t count)
{
    percuss_v1_SubImpact *list = answer_take(answer, count, sizeof *list);
    for (size_t i = 0; i < count; i++) {
        const struct sub_impact *sub = &from->sub_impacts[i];
        list[i] = (percuss_v1_SubImpact){
            .start = sub->start,
            .compression_end = sub->compression_end,
            .end = sub->end,
            .impulse = sub->impulse,
            .compression_impulse = sub->compression_impulse,
            .peak_force = sub->peak_force,
            .max_indentation = sub->max_indentation,
            .gap_rate_before = sub->gap_rate_before,
            .gap_rate_after = sub->gap_rate_after,
            .negligible = sub->negligible,
        };
    }
    FILL_SEQUENCE(to->sub_impacts, list, count);
}

static void fill_contacts(struct answer *answer, const struct solve_result *result, size_t listed)
{
    percuss_v1_ContactResult *list = answer_take(answer, result->contact_count, sizeof *list);
    for (size_t i = 0; i < result->contact_count; i++) {
        const struct solve_contact_result *from = &result->contacts[i];
        list[i].impulse = from->impulse;
        memcpy(list[i].impulse_vector, from->impulse_vector, sizeof from->impulse_vector);
        list[i].impulse_compression = from->impulse_compression;
        list[i].restitution = from->restitution;
        list[i].inverse_effective_mass = from->inverse_effective_mass;
        list[i].end_time = from->end_time;
        list[i].sub_impact_count = (uint32_t)from->sub_impact_count;
        fill_sub_impacts(answer, from, &list[i], least(from->sub_impacts_listed, listed));
    }
    FILL_SEQUENCE(answer->reply->contacts, list, result->contact_count);
}

static void fill_velocities(struct answer *answer, const struct solve_result *result)
{
    percuss_v1_BodyVelocity *list = answer_take(answer, result->body_count, sizeof *list);
    for (size_t i = 0; i < result->body_count; i++) {
        const struct solve_body_result *from = &result->bodies[i];
        COPY_TEXT(list[i].id, from->id);
        memcpy(list[i].velocity, from->velocity, sizeof from->velocity);
        memcpy(list[i].angular_velocity, from->angular_velocity, sizeof from->angular_velocity);
    }
    FILL_SEQUENCE(answer->reply->velocity_after, list, result->body_count);
}

static void fill_bodies(struct answer *answer, const struct solve_result *result,
                        const char (*tokens)[PERCUSS_ID_SIZE])
{
    size_t count = result->body_count;
    percuss_v1_BodyState *states = answer_take(answer, count, sizeof *states);
    percuss_v1_BodyEnergy *energies = answer_take(answer, count, sizeof *energies);
    percuss_v1_BodyModel *models = answer_take(answer, count, sizeof *models);
    for (size_t i = 0; i < count; i++) {
        const struct solve_body_result *from = &result->bodies[i];
        COPY_TEXT(states[i].id, from->id);
        COPY_TEXT(states[i].state, tokens[i]);
        COPY_TEXT(energies[i].id, from->id);
        energies[i].energy = from->vibration;
        COPY_TEXT(models[i].id, from->id);
        COPY_TEXT(models[i].theory, from->theory ? from->theory : "");
        models[i].modes = from->modes;
        models[i].rigid = from->rigid;
        models[i].shear_factor = from->shear_factor;
    }
    FILL_SEQUENCE(answer->reply->states_after, states, count);
    FILL_SEQUENCE(answer->reply->energy.vibration, energies, count);
    FILL_SEQUENCE(answer->reply->model.bodies, models, count);
}

static void fill_warnings(struct answer *answer, const struct solve_result *result)
{
    char **list = answer_take(answer, result->warning_count, sizeof *list);
    for (size_t i = 0; i < result->warning_count; i++) {
        list[i] = answer_take(answer, 1, sizeof result->warnings[i]);
        memcpy(list[i], result->warnings[i], sizeof result->warnings[i]);
    }
    FILL_SEQUENCE(answer->reply->warnings, list, result->warning_count);
}

static void fill_numbers(percuss_v1_Reply *reply, const struct solve_result *result)
{
    reply->complete = result->complete;
    reply->end_reason = result->end_reason;
    reply->window = result->window;
    reply->delassus_source = result->delassus_source;
    reply->time_shift = result->time_shift;
    percuss_v1_Energy *energy = &reply->energy;
    energy->available = result->energy.available;
    energy->rigid_after = result->energy.rigid_after;
    energy->damping = result->energy.damping;
    energy->plastic = result->energy.plastic;
    energy->stored = result->energy.stored;
    energy->closure = result->energy.closure;
    percuss_v1_ErrorEstimate *error = &reply->error;
    error->restitution_time = result->restitution_time;
    error->restitution_modes = result->restitution_modes;
    error->impulse_time = result->impulse_time;
    error->impulse_modes = result->impulse_modes;
    error->restitution_by_speed = result->restitution_by_speed;
    error->tolerance_met = result->tolerance_met;
    percuss_v1_Model *model = &reply->model;
    model->contact_model = result->contact_model;
    model->compliance = result->compliance;
    model->method = result->method;
    COPY_TEXT(model->reason, result->reason);
    model->omitted_error = result->omitted_error;
}

/* Room for all lists of a reply. */
static size_t lists_room(const struct solve_result *result, size_t listed)
{
    size_t bodies = result->body_count, warnings = result->warning_count;
    size_t room = answer_room(result->contact_count, sizeof(percuss_v1_ContactResult)) +
                  answer_room(bodies, sizeof(percuss_v1_BodyVelocity)) +
                  answer_room(bodies, sizeof(percuss_v1_BodyState)) +
                  answer_room(bodies, sizeof(percuss_v1_BodyEnergy)) +
                  answer_room(bodies, sizeof(percuss_v1_BodyModel)) +
                  answer_room(warnings, sizeof(char *)) +
                  warnings * answer_room(1, sizeof result->warnings[0]);
    for (size_t i = 0; i < result->contact_count; i++)
        room += answer_room(least(result->contacts[i].sub_impacts_listed, listed),
                            sizeof(percuss_v1_SubImpact));
    return room;
}

struct answer *encode_result(const struct envelope *envelope, const struct solve_result *result,
                             const char (*tokens)[PERCUSS_ID_SIZE], size_t listed)
{
    if (!encode_status_has_result(result->status))
        return encode_refusal(envelope, result->status, result->fault.text);
    struct answer *answer =
        create_blank(envelope, lists_room(result, listed) + encode_trace_room(result->trace));
    if (!answer)
        return NULL;
    answer->reply->status = result->status;
    COPY_TEXT(answer->reply->message, result->fault.text);
    fill_numbers(answer->reply, result);
    fill_contacts(answer, result, listed);
    if (result->velocities_known)
        fill_velocities(answer, result);
    fill_bodies(answer, result, tokens);
    fill_warnings(answer, result);
    encode_trace(answer, envelope, result->trace);
    return answer;
}
