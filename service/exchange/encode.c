/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/encode.h"

#include <math.h>
#include <string.h>

#include "impact/trace.h"
#include "percuss/fields.h"

/* Gives a sequence its elements; the answer owns them, not the sample. */
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

/* Whether the same request may get another status later. */
static bool is_passing(enum percuss_status status)
{
    return status == PERCUSS_BUSY || status == PERCUSS_TIMEOUT || status == PERCUSS_INTERNAL;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

static void undefine_energy(percuss_v1_Energy *to)
{
    PERCUSS_ENERGY_FIELDS(PERCUSS_UNDEFINED, PERCUSS_NONE)
}

static void undefine_error(percuss_v1_ErrorEstimate *to)
{
    PERCUSS_ERROR_FIELDS(PERCUSS_UNDEFINED)
}

static void undefine_model(percuss_v1_Model *to)
{
    PERCUSS_MODEL_FIELDS(PERCUSS_UNDEFINED, PERCUSS_NONE)
}

static void undefine_reply(percuss_v1_Reply *to)
{
    PERCUSS_REPLY_FIELDS(PERCUSS_UNDEFINED, PERCUSS_NONE)
    undefine_energy(&to->energy);
    undefine_error(&to->error);
    undefine_model(&to->model);
}

static struct answer *create_blank(const struct envelope *envelope, enum percuss_status status,
                                   const char *message, size_t room)
{
    struct answer *answer =
        answer_create(EXCHANGE_SINGLE, room + answer_room(1, sizeof *answer->reply));
    if (!answer)
        return NULL;
    answer->reply = answer_take(answer, 1, sizeof *answer->reply);
    ENCODE_HEAD(answer->reply, envelope, status, message);
    undefine_reply(answer->reply);
    return answer;
}

struct answer *encode_refusal(const struct envelope *envelope, enum percuss_status status,
                              const char *message)
{
    struct answer *answer = create_blank(envelope, status, message, 0);
    if (answer)
        answer->passing = is_passing(status);
    return answer;
}

void encode_batch_head(percuss_v1_BatchReply *part, const struct envelope *envelope,
                       enum percuss_status status, const char *message)
{
    ENCODE_HEAD(part, envelope, status, message);
    part->part = 0;
    part->parts = 1;
}

struct answer *encode_batch_refusal(const struct envelope *envelope, enum percuss_status status,
                                    const char *message)
{
    struct answer *answer = answer_create(EXCHANGE_BATCH, answer_room(1, sizeof *answer->parts));
    if (!answer)
        return NULL;
    answer->parts = answer_take(answer, 1, sizeof *answer->parts);
    answer->part_count = 1;
    answer->passing = is_passing(status);
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
    answer->passing = is_passing(status);
    percuss_v1_EnsembleReply *to = answer->report;
    ENCODE_HEAD(to, envelope, status, message);
    PERCUSS_ENSEMBLE_REPLY_FIELDS(PERCUSS_UNDEFINED, PERCUSS_NONE)
    return answer;
}

static void fill_sub_impact(const struct sub_impact *from, percuss_v1_SubImpact *to)
{
    PERCUSS_SUB_IMPACT_FIELDS(PERCUSS_COPY)
}

static void fill_contact(struct answer *answer, const struct solve_contact_result *from,
                         percuss_v1_ContactResult *to, size_t listed)
{
    size_t count = least(from->sub_impacts_listed, listed);
    percuss_v1_SubImpact *list = answer_take(answer, count, sizeof *list);
    PERCUSS_CONTACT_RESULT_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    for (size_t i = 0; i < count; i++)
        fill_sub_impact(&from->sub_impacts[i], &list[i]);
    FILL_SEQUENCE(to->sub_impacts, list, count);
}

static void fill_contacts(struct answer *answer, const struct solve_result *result, size_t listed)
{
    percuss_v1_ContactResult *list = answer_take(answer, result->contact_count, sizeof *list);
    for (size_t i = 0; i < result->contact_count; i++)
        fill_contact(answer, &result->contacts[i], &list[i], listed);
    FILL_SEQUENCE(answer->reply->contacts, list, result->contact_count);
}

static void fill_velocity(const struct solve_body_result *from, percuss_v1_BodyVelocity *to)
{
    PERCUSS_BODY_VELOCITY_FIELDS(PERCUSS_COPY)
}

static void fill_velocities(struct answer *answer, const struct solve_result *result)
{
    percuss_v1_BodyVelocity *list = answer_take(answer, result->body_count, sizeof *list);
    for (size_t i = 0; i < result->body_count; i++)
        fill_velocity(&result->bodies[i], &list[i]);
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

static void fill_energy(const struct impact_energy *from, percuss_v1_Energy *to)
{
    PERCUSS_ENERGY_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
}

static void fill_error(const struct solve_result *from, percuss_v1_ErrorEstimate *to)
{
    PERCUSS_ERROR_FIELDS(PERCUSS_COPY)
}

static void fill_model(const struct solve_result *from, percuss_v1_Model *to)
{
    PERCUSS_MODEL_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
}

static void fill_reply(const struct solve_result *from, percuss_v1_Reply *to)
{
    PERCUSS_REPLY_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    fill_energy(&from->energy, &to->energy);
    fill_error(from, &to->error);
    fill_model(from, &to->model);
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

/* Time histories, cut into samples of bounded size. */

enum { TRACE_COLUMNS = 9, TRACE_FRICTION_COLUMNS = 4 };

static bool trace_has_friction(const struct trace *trace)
{
    for (size_t c = 0; c < trace->contacts; c++)
        if (trace->contact[c].slip[0])
            return true;
    return false;
}

/* Instants of a part: the fewer the more columns. */
static size_t trace_part(const struct trace *trace)
{
    size_t columns = TRACE_COLUMNS + (trace_has_friction(trace) ? TRACE_FRICTION_COLUMNS : 0);
    return TRACE_PART_INSTANTS * TRACE_COLUMNS / columns;
}

static size_t trace_parts(const struct trace *trace)
{
    return (trace->count + trace_part(trace) - 1) / trace_part(trace);
}

/* The room that fill_traces takes of an answer; 0 for NULL. */
static size_t trace_room(const struct trace *trace)
{
    if (!trace)
        return 0;
    return answer_room(trace->contacts * trace_parts(trace), sizeof(percuss_v1_Trace)) +
           trace->contacts * (TRACE_COLUMNS + TRACE_FRICTION_COLUMNS) *
               answer_room(trace->count, sizeof(double));
}

/* Part of a column in each sample of a contact. */
static void fill_trace_column(struct answer *answer, const struct trace *trace,
                              const double *values, dds_sequence_double *first)
{
    size_t instants = trace_part(trace);
    double *copy = answer_take(answer, trace->count, sizeof *copy);
    memcpy(copy, values, trace->count * sizeof *copy);
    for (size_t part = 0; part < trace_parts(trace); part++) {
        /* the same member of the next sample */
        dds_sequence_double *list =
            (dds_sequence_double *)((char *)first + part * sizeof(percuss_v1_Trace));
        size_t start = part * instants;
        size_t left = trace->count - start;
        list->_buffer = copy + start;
        list->_length = (uint32_t)(left < instants ? left : instants);
        list->_maximum = list->_length;
        list->_release = false;
    }
}

/* Fills answer->traces; nothing for NULL. */
static void fill_traces(struct answer *answer, const struct envelope *envelope,
                        const struct trace *trace)
{
    if (!trace)
        return;
    size_t parts = trace_parts(trace);
    answer->trace_count = trace->contacts * parts;
    answer->traces = answer_take(answer, answer->trace_count, sizeof *answer->traces);
    for (size_t c = 0; c < trace->contacts; c++) {
        const struct trace_contact *contact = &trace->contact[c];
        percuss_v1_Trace *first = &answer->traces[c * parts];
        /* of which request, contact and part each sample is */
        for (size_t part = 0; part < parts; part++) {
            memcpy(first[part].client, envelope->client, sizeof first[part].client);
            first[part].sequence = envelope->sequence;
            first[part].contact = (uint32_t)c;
            first[part].part = (uint32_t)part;
            first[part].parts = (uint32_t)parts;
        }
        /* the histories, cut into the parts */
        fill_trace_column(answer, trace, trace->time, &first->time);
        fill_trace_column(answer, trace, contact->force, &first->force);
        fill_trace_column(answer, trace, contact->indentation, &first->indentation);
        fill_trace_column(answer, trace, contact->gap, &first->gap);
        fill_trace_column(answer, trace, contact->gap_rate, &first->gap_rate);
        fill_trace_column(answer, trace, contact->displacement[0], &first->displacement_a);
        fill_trace_column(answer, trace, contact->velocity[0], &first->velocity_a);
        fill_trace_column(answer, trace, contact->displacement[1], &first->displacement_b);
        fill_trace_column(answer, trace, contact->velocity[1], &first->velocity_b);
        if (!contact->slip[0])
            continue;
        fill_trace_column(answer, trace, contact->tangential[0], &first->force_tangential_1);
        fill_trace_column(answer, trace, contact->tangential[1], &first->force_tangential_2);
        fill_trace_column(answer, trace, contact->slip[0], &first->slip_1);
        fill_trace_column(answer, trace, contact->slip[1], &first->slip_2);
    }
}

struct answer *encode_result(const struct envelope *envelope, const struct solve_result *result,
                             const char (*tokens)[PERCUSS_ID_SIZE], size_t listed)
{
    if (!encode_status_has_result(result->status))
        return encode_refusal(envelope, result->status, result->fault.text);
    struct answer *answer = create_blank(envelope, result->status, result->fault.text,
                                         lists_room(result, listed) + trace_room(result->trace));
    if (!answer)
        return NULL;
    fill_reply(result, answer->reply);
    fill_contacts(answer, result, listed);
    if (result->velocities_known)
        fill_velocities(answer, result);
    fill_bodies(answer, result, tokens);
    fill_warnings(answer, result);
    fill_traces(answer, envelope, result->trace);
    return answer;
}
