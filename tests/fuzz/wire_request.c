/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bytes from the network as requests to the daemon: what is decoded keeps the ranges that the
 * solver counts on, and a copy is the same question. Kept replies are read too. */
#include <math.h>

#include "endpoint/reply_bytes.h"
#include "exchange/decode.h"
#include "exchange/question.h"
#include "samples.h"

enum { REQUEST = 0, REPLY = 1, BATCH = 2, ENSEMBLE = 4, DENTS = 11 };

static void require_vector(const double v[3], double most, const char *name)
{
    for (int k = 0; k < 3; k++)
        FUZZ_REQUIRE(fabs(v[k]) <= most, "%s: %g", name, v[k]);
}

static void require_ranges(const struct solve_request *request)
{
    FUZZ_REQUIRE(request->body_count <= PERCUSS_MAX_BODIES &&
                     request->contact_count <= PERCUSS_MAX_CONTACTS,
                 "too many");
    for (size_t i = 0; i < request->body_count; i++) {
        const struct solve_body *body = &request->bodies[i];
        const double *q = body->orientation;
        FUZZ_REQUIRE(memchr(body->id, 0, sizeof body->id) && body->id[0], "an id without an end");
        require_vector(body->position, 1e6, "position");
        require_vector(body->velocity, 1e6, "velocity");
        require_vector(body->angular_velocity, 1e6, "angular velocity");
        /* normalised: to rounding */
        FUZZ_REQUIRE(fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0) < 1e-14,
                     "orientation");
    }
    for (size_t i = 0; i < request->contact_count; i++) {
        const struct solve_contact *contact = &request->contacts[i];
        FUZZ_REQUIRE(contact->a < request->body_count && contact->b < request->body_count &&
                         contact->a != contact->b,
                     "bodies %u, %u", contact->a, contact->b);
        require_vector(contact->point, 1e6, "point");
        require_vector(contact->normal, 1.0 + 1e-14, "normal");
        FUZZ_REQUIRE(fabs(contact->gap) <= 1e3, "gap %g", contact->gap);
    }
    FUZZ_REQUIRE(request->options.contact_model < PERCUSS_CONTACT_COUNT &&
                     request->options.method < PERCUSS_METHOD_COUNT &&
                     request->options.tolerance >= 0.0 && request->options.tolerance <= 1.0,
                 "options");
}

static void check_copy(const percuss_v1_Request *request, size_t count)
{
    percuss_v1_Request *copy = question_copy(request, count);
    FUZZ_REQUIRE(copy, "no memory for a copy");
    for (size_t i = 0; i < count; i++) {
        struct digest before = question_digest_single(&request[i]);
        struct digest after = question_digest_single(&copy[i]);
        FUZZ_REQUIRE(memcmp(&before, &after, sizeof before) == 0, "a copy is another question");
    }
    free(copy);
}

static void visit(void *context, int type, const void *sample)
{
    static struct solve_request request;
    static struct decoded_ensemble decoded;
    struct fault fault = {""};
    enum percuss_status status = PERCUSS_OK;
    (void)context;
    if (type == REQUEST) {
        status = decode_request(sample, &request, &fault);
        if (!status)
            require_ranges(&request);
        check_copy(sample, 1);
    } else if (type == BATCH) {
        const percuss_v1_BatchRequest *batch = sample;
        question_digest_batch(batch);
        check_copy(batch->requests._buffer, batch->requests._length);
    } else if (type == ENSEMBLE) {
        status = decode_ensemble(sample, &decoded, &fault);
        if (!status)
            require_ranges(&decoded.request);
        question_digest_ensemble(sample);
        free(question_copy_ensemble(sample));
    }
    if (status)
        fuzz_refused(status, fault.text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bool damaged;
    samples_give(data, size, 1u << REQUEST | 1u << BATCH | 1u << ENSEMBLE | 1u << DENTS, visit,
                 NULL);
    /* what the store gives back, in the place of the first sample */
    if (size > 4 && data[0] % ANY_TYPES == REPLY)
        answer_release(reply_bytes_read(data + 4, size - 4, &damaged));
    return 0;
}
