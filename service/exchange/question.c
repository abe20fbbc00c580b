/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/question.h"

#include <stdalign.h>
#include <stdlib.h>
#include <string.h>

#include "percuss/fields.h"

/* Adds a member of *from. The order of the lists matters: stored digests are compared. */
#define HASH(kind, name, ...) HASH_##kind(name)

#define HASH_NUMBER(name)     hash_bytes(hasher, &from->name, sizeof from->name);
#define HASH_DEFAULTED(name)  HASH_NUMBER(name)
#define HASH_VALUE(name)      HASH_NUMBER(name)
#define HASH_VECTOR(name)     HASH_NUMBER(name)
#define HASH_UNIT(name)       HASH_NUMBER(name)
#define HASH_INDEX(name)      hash_number(hasher, from->name);
#define HASH_COUNT(name)      HASH_INDEX(name)
#define HASH_LONG_COUNT(name) HASH_INDEX(name)
#define HASH_CHOICE(name)     HASH_INDEX(name)
#define HASH_FLAG(name)       HASH_INDEX(name)
#define HASH_TEXT(name)       hash_text(hasher, from->name);
#define HASH_ID(name)         HASH_TEXT(name)

static void hash_body(struct hasher *hasher, const percuss_v1_BodyMotion *from)
{
    PERCUSS_BODY_FIELDS(HASH, PERCUSS_NONE)
    hash_number(hasher, from->overrides._length);
    for (uint32_t i = 0; i < from->overrides._length; i++) {
        hash_number(hasher, from->overrides._buffer[i].parameter);
        hash_bytes(hasher, &from->overrides._buffer[i].value, sizeof(double));
    }
}

static void hash_contact(struct hasher *hasher, const percuss_v1_Contact *from)
{
    PERCUSS_CONTACT_PLACE_FIELDS(HASH)
}

static void hash_options(struct hasher *hasher, const percuss_v1_Options *from)
{
    PERCUSS_OPTION_FIRST_FIELDS(HASH)
}

static bool contact_states_friction(const percuss_v1_Contact *contact)
{
    const double *tangent = contact->tangent;
    return contact->friction != 0.0 || tangent[0] != 0.0 || tangent[1] != 0.0 || tangent[2] != 0.0;
}

static void hash_contact_friction(struct hasher *hasher, const percuss_v1_Contact *from)
{
    PERCUSS_CONTACT_FRICTION_FIELDS(HASH)
}

static void hash_option_friction(struct hasher *hasher, const percuss_v1_Options *from)
{
    PERCUSS_OPTION_FRICTION_FIELDS(HASH)
}

/* Only what is stated: a question without friction has the digest that it had before there was
 * friction, by which stores know their replies. */
static void hash_friction(struct hasher *hasher, const percuss_v1_Request *request)
{
    bool stated = request->options.friction != 0;
    for (uint32_t i = 0; i < request->contacts._length; i++)
        stated = stated || contact_states_friction(&request->contacts._buffer[i]);
    if (!stated)
        return;
    hash_text(hasher, "friction");
    for (uint32_t i = 0; i < request->contacts._length; i++)
        hash_contact_friction(hasher, &request->contacts._buffer[i]);
    hash_option_friction(hasher, &request->options);
}

static void hash_request(struct hasher *hasher, const percuss_v1_Request *request)
{
    hash_number(hasher, request->bodies._length);
    for (uint32_t i = 0; i < request->bodies._length; i++)
        hash_body(hasher, &request->bodies._buffer[i]);
    hash_number(hasher, request->contacts._length);
    for (uint32_t i = 0; i < request->contacts._length; i++)
        hash_contact(hasher, &request->contacts._buffer[i]);
    hash_bytes(hasher, request->delassus._buffer, request->delassus._length * sizeof(double));
    hash_options(hasher, &request->options);
    hash_friction(hasher, request);
}

struct digest question_digest_single(const percuss_v1_Request *request)
{
    struct hasher hasher = {0};
    hash_request(&hasher, request);
    return hash_digest(&hasher);
}

struct digest question_digest_batch(const percuss_v1_BatchRequest *batch)
{
    struct hasher hasher = {0};
    for (uint32_t i = 0; i < batch->requests._length; i++) {
        hash_number(&hasher, batch->requests._buffer[i].sequence);
        hash_request(&hasher, &batch->requests._buffer[i]);
    }
    return hash_digest(&hasher);
}

static void hash_input(struct hasher *hasher, const percuss_v1_EnsembleInput *from)
{
    PERCUSS_INPUT_FIELDS(HASH, PERCUSS_NONE)
    hash_bytes(hasher, from->values._buffer, from->values._length * sizeof(double));
}

static void hash_correlation(struct hasher *hasher, const percuss_v1_EnsembleCorrelation *from)
{
    PERCUSS_CORRELATION_FIELDS(HASH)
}

static void hash_ensemble(struct hasher *hasher, const percuss_v1_EnsembleRequest *from)
{
    hash_request(hasher, &from->scene);
    PERCUSS_ENSEMBLE_FIELDS(HASH, PERCUSS_NONE)
    hash_number(hasher, from->inputs._length);
    for (uint32_t i = 0; i < from->inputs._length; i++)
        hash_input(hasher, &from->inputs._buffer[i]);
    hash_number(hasher, from->correlations._length);
    for (uint32_t i = 0; i < from->correlations._length; i++)
        hash_correlation(hasher, &from->correlations._buffer[i]);
    hash_bytes(hasher, from->quantiles._buffer, from->quantiles._length * sizeof(double));
}

struct digest question_digest_ensemble(const percuss_v1_EnsembleRequest *request)
{
    struct hasher hasher = {0};
    hash_ensemble(&hasher, request);
    return hash_digest(&hasher);
}

static size_t round_up(size_t bytes)
{
    return (bytes + alignof(max_align_t) - 1) / alignof(max_align_t) * alignof(max_align_t);
}

/* Copies a list to `at` and returns the place behind it. */
static char *copy_list(char *at, const void *list, size_t bytes)
{
    if (bytes > 0)
        memcpy(at, list, bytes);
    return at + round_up(bytes);
}

/* Copies the sequence `name` of a request to `at` and moves on. */
#define COPY_SEQUENCE(to, from, name, at)                                                          \
    do {                                                                                           \
        (to)->name._buffer = (void *)(at);                                                         \
        (to)->name._release = false;                                                               \
        (at) = copy_list(at, (from)->name._buffer, LIST_BYTES((from)->name));                      \
    } while (0)

#define LIST_BYTES(sequence) ((sequence)._length * sizeof *(sequence)._buffer)

static size_t lists_size(const percuss_v1_Request *request)
{
    size_t size = round_up(LIST_BYTES(request->bodies)) + round_up(LIST_BYTES(request->contacts)) +
                  round_up(LIST_BYTES(request->delassus));
    for (uint32_t i = 0; i < request->bodies._length; i++)
        size += round_up(LIST_BYTES(request->bodies._buffer[i].overrides));
    return size;
}

/* Copies the lists within the bodies of a copied request to `at` and returns the place behind. */
static char *copy_overrides(percuss_v1_Request *copy, const percuss_v1_Request *request, char *at)
{
    for (uint32_t i = 0; i < request->bodies._length; i++)
        COPY_SEQUENCE(&copy->bodies._buffer[i], &request->bodies._buffer[i], overrides, at);
    return at;
}

percuss_v1_Request *question_copy(const percuss_v1_Request *requests, size_t count)
{
    size_t size = round_up(count * sizeof *requests);
    for (size_t i = 0; i < count; i++)
        size += lists_size(&requests[i]);
    percuss_v1_Request *copies = malloc(size + !size);
    if (!copies)
        return NULL;
    if (count > 0)
        memcpy(copies, requests, count * sizeof *requests);
    char *at = (char *)copies + round_up(count * sizeof *requests);
    for (size_t i = 0; i < count; i++) {
        COPY_SEQUENCE(&copies[i], &requests[i], bodies, at);
        COPY_SEQUENCE(&copies[i], &requests[i], contacts, at);
        COPY_SEQUENCE(&copies[i], &requests[i], delassus, at);
        at = copy_overrides(&copies[i], &requests[i], at);
    }
    return copies;
}

percuss_v1_EnsembleRequest *question_copy_ensemble(const percuss_v1_EnsembleRequest *request)
{
    size_t size = round_up(sizeof *request) + round_up(LIST_BYTES(request->inputs)) +
                  round_up(LIST_BYTES(request->correlations)) +
                  round_up(LIST_BYTES(request->quantiles));
    for (uint32_t i = 0; i < request->inputs._length; i++)
        size += round_up(LIST_BYTES(request->inputs._buffer[i].values));
    percuss_v1_EnsembleRequest *copy = malloc(size);
    if (!copy)
        return NULL;
    *copy = *request;
    char *at = (char *)copy + round_up(sizeof *request);
    COPY_SEQUENCE(copy, request, inputs, at);
    COPY_SEQUENCE(copy, request, correlations, at);
    COPY_SEQUENCE(copy, request, quantiles, at);
    for (uint32_t i = 0; i < request->inputs._length; i++)
        COPY_SEQUENCE(&copy->inputs._buffer[i], &request->inputs._buffer[i], values, at);
    return copy;
}
