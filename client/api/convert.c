/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Between structs of the wire and public ones. */

#include "convert.h"

#include <math.h>
#include <percuss/fields.h>
#include <percuss/percuss.h>
#include <stdalign.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"

/* Requests. */

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

/* A row for every contact, or three, as many as the wire has room for. */
static enum percuss_result convert_delassus(const struct percuss_request *request,
                                            percuss_v1_Request *wire)
{
    size_t contacts = request->contact_count;
    size_t rows = request->delassus_rows ? request->delassus_rows : contacts;
    if (rows != contacts && rows != 3 * contacts)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "delassus_rows: %zu: 0, %zu (contact_count) or %zu (3 contact_count) is "
                         "allowed",
                         rows, contacts, 3 * contacts);
    if (rows * rows > PERCUSS_MAX_DELASSUS)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "delassus_rows: %zu, 3 for each of %zu contacts: are too many; of normals "
                         "and tangents up to %d contacts are allowed",
                         rows, contacts, PERCUSS_MAX_CONTACTS_OBLIQUE);
    /* writing only reads it */
    wire->delassus._buffer = (double *)request->delassus;
    wire->delassus._length = wire->delassus._maximum = (uint32_t)(rows * rows);
    return PERCUSS_RESULT_OK;
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

    *wire = (percuss_v1_Request){0};
    convert_options(&request->options, &wire->options);
    wire->bodies._buffer = storage->bodies;
    wire->bodies._length = wire->bodies._maximum = (uint32_t)request->body_count;
    wire->contacts._buffer = storage->contacts;
    wire->contacts._length = wire->contacts._maximum = (uint32_t)request->contact_count;
    return request->delassus ? convert_delassus(request, wire) : PERCUSS_RESULT_OK;
}

/* Requests of ensembles. */

static enum percuss_result convert_input(const struct percuss_input *from, size_t index,
                                         percuss_v1_EnsembleInput *to)
{
    if (!memchr(from->name, '\0', sizeof from->name) ||
        !memchr(from->body, '\0', sizeof from->body))
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "inputs[%zu]: name or body is not terminated; up to %d bytes are allowed",
                         index, PERCUSS_ID_SIZE - 1);
    if (from->value_count > 0 && !from->values)
        return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                         "inputs[%zu].values: NULL: %zu numbers are needed", index,
                         from->value_count);
    *to = (percuss_v1_EnsembleInput){0};
    PERCUSS_INPUT_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    /* writing only reads it */
    to->values._buffer = (double *)from->values;
    to->values._length = to->values._maximum = (uint32_t)from->value_count;
    return PERCUSS_RESULT_OK;
}

static void convert_correlation(const struct percuss_correlation *from,
                                percuss_v1_EnsembleCorrelation *to)
{
    PERCUSS_CORRELATION_FIELDS(PERCUSS_COPY)
}

static enum percuss_result check_counts(const struct percuss_ensemble_request *request)
{
    const struct {
        const char *field;
        size_t count, most;
    } counts[] = {
        {"inputs", request->input_count, PERCUSS_MAX_INPUTS},
        {"correlations", request->correlation_count, PERCUSS_MAX_CORRELATIONS},
        {"quantiles", request->quantile_count, PERCUSS_MAX_QUANTILES},
    };
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        if (counts[i].count > counts[i].most)
            return error_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                             "%s: %zu are too many; up to %zu are allowed", counts[i].field,
                             counts[i].count, counts[i].most);
    return PERCUSS_RESULT_OK;
}

enum percuss_result convert_ensemble_request(const struct percuss_ensemble_request *from,
                                             struct ensemble_storage *storage,
                                             percuss_v1_EnsembleRequest *to)
{
    *to = (percuss_v1_EnsembleRequest){0};
    PERCUSS_ENSEMBLE_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    to->list_tangential = true;
    enum percuss_result result = check_counts(from);
    if (result == PERCUSS_RESULT_OK)
        result = convert_request(&from->scene, &storage->scene, &to->scene);
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < from->input_count; i++)
        result = convert_input(&from->inputs[i], i, &storage->inputs[i]);
    if (result != PERCUSS_RESULT_OK)
        return result;
    for (size_t i = 0; i < from->correlation_count; i++)
        convert_correlation(&from->correlations[i], &storage->correlations[i]);
    to->inputs._buffer = storage->inputs;
    to->inputs._length = to->inputs._maximum = (uint32_t)from->input_count;
    to->correlations._buffer = storage->correlations;
    to->correlations._length = to->correlations._maximum = (uint32_t)from->correlation_count;
    to->quantiles._buffer = (double *)from->quantiles;
    to->quantiles._length = to->quantiles._maximum = (uint32_t)from->quantile_count;
    return PERCUSS_RESULT_OK;
}

/* Memory that is freed as a whole: the arrays of a reply. */

struct storage {
    struct storage_block *blocks; /* for storage_free */
    bool failed;                  /* memory ran out */
};

/* Of a block; the reply of most impacts needs one. */
static const size_t LEAST_ROOM = 4096;

struct storage_block {
    struct storage_block *next;
    size_t used, room;
    max_align_t memory[];
};

/* As storage_take, not zeroed: of most replies a block is half empty. */
static void *reserve(struct storage *storage, size_t count, size_t size)
{
    size_t grain = alignof(max_align_t), bytes = (count * size + grain - 1) / grain * grain;
    struct storage_block *block = storage->blocks;
    if (!block || block->room - block->used < bytes) {
        size_t room = bytes > LEAST_ROOM ? bytes : LEAST_ROOM;
        block = malloc(sizeof *block + room);
        storage->failed = storage->failed || !block;
        if (!block)
            return NULL;
        *block = (struct storage_block){.next = storage->blocks, .room = room};
        storage->blocks = block;
    }
    void *taken = (char *)block->memory + block->used;
    block->used += bytes;
    return taken;
}

/* Zeroed room for `count` elements, aligned for any; NULL, and `failed`, when memory runs out. */
static void *storage_take(struct storage *storage, size_t count, size_t size)
{
    void *taken = reserve(storage, count, size);
    if (taken)
        memset(taken, 0, count * size);
    return taken;
}

/* The same with a copy of `count` elements; `source` may be NULL for none. */
static void *storage_copy(struct storage *storage, const void *source, size_t count, size_t size)
{
    void *copy = reserve(storage, count, size);
    if (copy && count > 0)
        memcpy(copy, source, count * size);
    return copy;
}

/* Gives the blocks back; NULL is allowed. */
static void storage_free(struct storage_block *blocks)
{
    while (blocks) {
        struct storage_block *next = blocks->next;
        free(blocks);
        blocks = next;
    }
}

/* From structs of the wire to public ones by the lists of percuss/fields.h.
 *
 *     CONVERTER(sub_impact, SubImpact, PERCUSS_SUB_IMPACT_FIELDS)
 *
 * defines convert_sub_impact(from, storage, to); those of the elements of its lists must have been
 * defined before. Arrays are put into the storage; where memory runs out they stay empty. How many
 * NUMBERS, COUNTS and EDGES there are is the caller's to say: several lists may share it. */

#define CONVERTER(element, wire, fields)                                                           \
    static void convert_##element(const percuss_v1_##wire *from, struct storage *storage,          \
                                  struct percuss_##element *to)                                    \
    {                                                                                              \
        (void)storage;                                                                             \
        fields(PERCUSS_COPY, CONVERT)                                                              \
    }

#define CONVERT(kind, name, ...) CONVERT_##kind(name, __VA_ARGS__)

#define CONVERT_OBJECT(name, element, ...) convert_##element(&from->name, storage, &to->name);
#define CONVERT_LIST(name, count, element, ...)                                                    \
    to->name = storage_take(storage, from->name._length, sizeof *to->name);                        \
    to->count = to->name ? from->name._length : 0;                                                 \
    for (size_t i = 0; i < to->count; i++)                                                         \
        convert_##element(&from->name._buffer[i], storage, &to->name[i]);
#define CONVERT_TEXTS(name, count, ...)                                                            \
    to->name = storage_take(storage, from->name._length, sizeof *to->name);                        \
    to->count = to->name ? from->name._length : 0;                                                 \
    for (size_t i = 0; i < to->count; i++)                                                         \
        to->name[i] =                                                                              \
            storage_copy(storage, from->name._buffer[i], strlen(from->name._buffer[i]) + 1, 1);
#define CONVERT_OPTIONAL(name, element, ...)                                                       \
    undefine_##element(&to->name);                                                                 \
    if (from->name._length > 0)                                                                    \
        convert_##element(&from->name._buffer[0], storage, &to->name);
#define CONVERT_NUMBERS(name, ...)                                                                 \
    to->name = storage_copy(storage, from->name._buffer, from->name._length, sizeof *to->name);
#define CONVERT_COUNTS(name, ...) CONVERT_NUMBERS(name)
#define CONVERT_EDGES(name, ...)  CONVERT_NUMBERS(name)

/* Replies. */

CONVERTER(sub_impact, SubImpact, PERCUSS_SUB_IMPACT_FIELDS)

static void convert_contact_result(const percuss_v1_ContactResult *from, struct storage *storage,
                                   struct percuss_contact_result *to)
{
    PERCUSS_CONTACT_RESULT_FIELDS(PERCUSS_COPY, CONVERT)
    /* a server that knows friction leaves the first undefined where there is none */
    if (from->friction == 0.0 && from->tangential_restitution == 0.0)
        to->tangential_restitution = to->restitution_kinematic = to->restitution_energetic = NAN;
}

CONVERTER(body_velocity, BodyVelocity, PERCUSS_BODY_VELOCITY_FIELDS)
CONVERTER(body_state, BodyState, PERCUSS_BODY_STATE_FIELDS)
CONVERTER(body_energy, BodyEnergy, PERCUSS_BODY_ENERGY_FIELDS)
CONVERTER(energy, Energy, PERCUSS_ENERGY_FIELDS)
CONVERTER(error_estimate, ErrorEstimate, PERCUSS_ERROR_FIELDS)
CONVERTER(body_model, BodyModel, PERCUSS_BODY_MODEL_FIELDS)
CONVERTER(model, Model, PERCUSS_MODEL_FIELDS)
CONVERTER(timing, Timing, PERCUSS_TIMING_FIELDS)

enum percuss_result convert_reply(const percuss_v1_Reply *from, struct percuss_reply *to)
{
    struct storage all = {0}, *storage = &all;
    *to = (struct percuss_reply){0};
    PERCUSS_HEAD_FIELDS(PERCUSS_COPY)
    PERCUSS_REPLY_FIELDS(PERCUSS_COPY, CONVERT)
    to->storage = all.blocks;
    if (!all.failed)
        return PERCUSS_RESULT_OK;
    percuss_reply_free(to);
    return error_set(PERCUSS_RESULT_NO_MEMORY, "a reply");
}

void percuss_reply_free(struct percuss_reply *reply)
{
    if (!reply)
        return;
    storage_free(reply->storage);
    *reply = (struct percuss_reply){0};
}

/* Replies of ensembles. */

/* A copy without its undefined values; an element that is absent. */
#define UNDEFINER(element, fields)                                                                 \
    static void undefine_##element(struct percuss_##element *to)                                   \
    {                                                                                              \
        fields(PERCUSS_UNDEFINED)                                                                  \
    }
UNDEFINER(beta_fit, PERCUSS_BETA_FIT_FIELDS)
UNDEFINER(ensemble_check, PERCUSS_ENSEMBLE_CHECK_FIELDS)

CONVERTER(input_part, InputPart, PERCUSS_INPUT_PART_FIELDS)
CONVERTER(sigma_interval, SigmaInterval, PERCUSS_SIGMA_INTERVAL_FIELDS)
CONVERTER(beta_fit, BetaFit, PERCUSS_BETA_FIT_FIELDS)

static size_t least(uint32_t a, uint32_t b)
{
    return a < b ? a : b;
}

/* Lists that belong together are as long as the shortest, for any server. */
static void convert_statistic(const percuss_v1_Statistic *from, struct storage *storage,
                              struct percuss_statistic *to)
{
    PERCUSS_STATISTIC_FIELDS(PERCUSS_COPY, CONVERT)
    to->quantile_count = least(least(from->probabilities._length, from->quantiles._length),
                               least(from->quantiles_low._length, from->quantiles_high._length));
    to->bin_count =
        from->bin_edges._length ? least(from->bin_counts._length, from->bin_edges._length - 1) : 0;
    to->curve_count = least(from->curve_values._length, from->curve_shares._length);
}

/* A server that does not know intervals leaves them 0, which no upper bound is. */
static void convert_sensitivity(const percuss_v1_Sensitivity *from, struct storage *storage,
                                struct percuss_sensitivity *to)
{
    PERCUSS_SENSITIVITY_FIELDS(PERCUSS_COPY, CONVERT)
    if (from->first_order_high == 0.0)
        to->first_order_low = to->first_order_high = to->total_low = to->total_high = NAN;
}

static void convert_ensemble_check(const percuss_v1_EnsembleCheck *from, struct storage *storage,
                                   struct percuss_ensemble_check *to)
{
    (void)storage;
    PERCUSS_ENSEMBLE_CHECK_FIELDS(PERCUSS_COPY)
    if (from->within_high == 0.0)
        to->within_low = to->within_high = NAN;
}

enum percuss_result convert_ensemble_reply(const percuss_v1_EnsembleReply *from,
                                           struct percuss_ensemble_reply *to)
{
    struct storage all = {0}, *storage = &all;
    *to = (struct percuss_ensemble_reply){0};
    PERCUSS_HEAD_FIELDS(PERCUSS_COPY)
    PERCUSS_ENSEMBLE_REPLY_FIELDS(PERCUSS_COPY, CONVERT)
    to->count_length = least(from->sub_impact_counts._length, from->significant_counts._length);
    to->storage = all.blocks;
    if (!all.failed)
        return PERCUSS_RESULT_OK;
    percuss_ensemble_reply_free(to);
    return error_set(PERCUSS_RESULT_NO_MEMORY, "the reply of an ensemble");
}

void percuss_ensemble_reply_free(struct percuss_ensemble_reply *reply)
{
    if (!reply)
        return;
    storage_free(reply->storage);
    free(reply->rows);
    *reply = (struct percuss_ensemble_reply){0};
}

/* Announcements. */

#define SAME_KIND(name, text)                                                                      \
    _Static_assert((unsigned)PERCUSS_TASK_##name == percuss_v1_TASK_##name, text);
PERCUSS_TASK_KIND_LIST(SAME_KIND)

static void convert_task(const percuss_v1_Task *from, struct percuss_task *to)
{
    PERCUSS_TASK_FIELDS(PERCUSS_COPY)
}

bool convert_announced_server(const percuss_v1_ServerStatus *from, struct percuss_server *to)
{
    size_t count = from->tasks._length;
    PERCUSS_SERVER_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    to->task_count = 0;
    to->tasks = NULL;
    if (count == 0)
        return true;
    to->tasks = calloc(count, sizeof *to->tasks);
    for (size_t i = 0; to->tasks && i < count; i++)
        convert_task(&from->tasks._buffer[i], &to->tasks[to->task_count++]);
    return to->tasks;
}

UNDEFINER(contact_law, PERCUSS_CONTACT_LAW_FIELDS)

static void convert_law(const percuss_v1_ContactLaw *from, struct percuss_contact_law *to)
{
    PERCUSS_CONTACT_LAW_FIELDS(PERCUSS_COPY)
}

void convert_announced_pair(const percuss_v1_MaterialPair *from, struct percuss_material_pair *to)
{
    *to = (struct percuss_material_pair){.friction = NAN};
    PERCUSS_MATERIAL_PAIR_FIELDS(PERCUSS_COPY, PERCUSS_NONE)
    if (from->law._length > 0)
        convert_law(from->law._buffer, &to->law);
    else
        undefine_contact_law(&to->law);
}

static void convert_term(const percuss_v1_RelaxationTerm *from, struct percuss_relaxation_term *to)
{
    PERCUSS_RELAXATION_TERM_FIELDS(PERCUSS_COPY)
}

static void convert_losses(const percuss_v1_MaterialLosses *from, struct percuss_body *to)
{
    to->loss_factor = from->loss_factor;
    to->loss_frequency = from->loss_frequency;
    to->rate_reference = from->rate_reference;
    to->rate_exponent = from->rate_exponent;
    to->rate_coefficient = from->rate_coefficient;
    for (uint32_t i = 0; i < from->relaxation._length && i < PERCUSS_MAX_RELAXATION; i++)
        convert_term(&from->relaxation._buffer[i], &to->relaxation[to->relaxation_count++]);
}

void convert_announced_body(const percuss_v1_Body *wire, struct percuss_body *body)
{
    *body = (struct percuss_body){
        .mass = wire->mass,
        .radius = wire->radius,
        .tip_radius = wire->tip_radius,
        .supports = {wire->supports[0], wire->supports[1]},
        .loss_factor = NAN,
        .loss_frequency = NAN,
        .rate_reference = NAN,
        .rate_exponent = NAN,
        .rate_coefficient = NAN,
    };
    if (wire->losses._length > 0)
        convert_losses(wire->losses._buffer, body);
    memcpy(body->id, wire->id, sizeof body->id);
    memcpy(body->shape, wire->shape, sizeof body->shape);
    memcpy(body->material, wire->material, sizeof body->material);
    memcpy(body->description, wire->description, sizeof body->description);
    _Static_assert(sizeof body->parameters == sizeof wire->parameters + sizeof wire->scale,
                   "as many as on the wire");
    memcpy(body->parameters, wire->parameters, sizeof wire->parameters);
    body->parameters[PERCUSS_PARAMETER_SCALE] = wire->scale;
    memcpy(body->inertia, wire->inertia, sizeof body->inertia);
    memcpy(body->products, wire->products, sizeof body->products);
    for (uint32_t i = 0; i < wire->sites._length && i < PERCUSS_MAX_SITES; i++) {
        struct percuss_site *site = &body->sites[body->site_count++];
        memcpy(site->name, wire->sites._buffer[i].name, sizeof site->name);
        memcpy(site->point, wire->sites._buffer[i].point, sizeof site->point);
        memcpy(site->normal, wire->sites._buffer[i].normal, sizeof site->normal);
    }
    memcpy(body->half_extents, wire->half_extents, sizeof body->half_extents);
}

static void convert_dent(const percuss_v1_Dent *from, struct percuss_dent *to)
{
    PERCUSS_DENT_FIELDS(PERCUSS_COPY)
}

bool convert_announced_specimen(const percuss_v1_Dents *wire, struct percuss_specimen *specimen)
{
    *specimen = (struct percuss_specimen){
        .impacts = wire->impacts,
        .dent_count = wire->patches._length,
    };
    memcpy(specimen->name, wire->specimen, sizeof specimen->name);
    memcpy(specimen->body, wire->body, sizeof specimen->body);
    specimen->dents = calloc(specimen->dent_count + 1, sizeof *specimen->dents);
    for (size_t i = 0; specimen->dents && i < specimen->dent_count; i++)
        convert_dent(&wire->patches._buffer[i], &specimen->dents[i]);
    return specimen->dents;
}
