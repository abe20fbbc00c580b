/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "respond/responder.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/hash.h"
#include "exchange/batch.h"
#include "exchange/clock.h"
#include "exchange/decode.h"
#include "exchange/encode.h"
#include "exchange/text.h"

struct responder *responder_create(const struct respond_means *means)
{
    struct responder *responder = calloc(1, sizeof *responder);
    if (!responder)
        return NULL;
    responder->workspace = solve_workspace_create();
    if (!responder->workspace) {
        free(responder);
        return NULL;
    }
    responder->means = *means;
    solve_workspace_join(responder->workspace, means->account);
    table_maker_init(&responder->maker, &means->tables, means->limit);
    return responder;
}

void responder_free(struct responder *responder)
{
    if (!responder)
        return;
    solve_workspace_free(responder->workspace);
    free(responder);
}

static enum percuss_status check_deadline(const struct question *question, const char *when,
                                          struct fault *fault)
{
    double deadline = question->request->options.deadline;
    double passed = clock_now() - question->arrival;
    if (deadline == 0.0 || passed <= deadline)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_TIMEOUT,
                     "options.deadline: %g: had passed %s, %.3g s after the arrival", deadline,
                     when, passed);
}

/* The name of the body that has a state: a body with other parameters has other states. */
struct subject_name {
    char text[TOKEN_BODY_SIZE];
};

static struct token_subject subject_of(const struct question *question, size_t index,
                                       struct subject_name *name)
{
    const percuss_v1_BodyMotion *body = &question->request->bodies._buffer[index];
    struct token_subject subject = {question->snapshot->set->revision, name->text};
    COPY_TEXT(name->text, body->id);
    if (body->overrides._length == 0)
        return subject;
    /* and a hash of the overrides, of any number */
    struct hasher hasher = {0};
    for (uint32_t i = 0; i < body->overrides._length; i++) {
        hash_number(&hasher, body->overrides._buffer[i].parameter);
        hash_bytes(&hasher, &body->overrides._buffer[i].value, sizeof(double));
    }
    struct digest digest = hash_digest(&hasher);
    snprintf(name->text, sizeof name->text, "%s/%016llx%016llx", body->id,
             (unsigned long long)digest.first, (unsigned long long)digest.second);
    return subject;
}

/* Whether a question is to be answered, and if not, the refusal. */
struct inquiry {
    const struct respond_means *means;
    const struct question *question;
    double begun; /* monotonic, s */
    enum percuss_status status;
    struct fault fault;
};

static enum percuss_status check_limit(struct inquiry *inquiry)
{
    if (clock_now() - inquiry->begun <= inquiry->means->limit)
        return PERCUSS_OK;
    return fault_set(&inquiry->fault, PERCUSS_TIMEOUT,
                     "limits.seconds: %g: the server's time for one request had passed",
                     inquiry->means->limit);
}

static bool still_wanted(struct inquiry *inquiry, const char *when)
{
    const struct question *question = inquiry->question;
    inquiry->status = check_deadline(question, when, &inquiry->fault);
    if (!inquiry->status)
        inquiry->status = check_limit(inquiry);
    if (!inquiry->status)
        inquiry->status = question->still_wanted(question->context, &inquiry->fault);
    return inquiry->status == PERCUSS_OK;
}

/* Called by the solve now and then; false stops it. */
static bool goes_on(void *context, double done)
{
    struct inquiry *inquiry = context;
    if (done > 0.0 && inquiry->question->done)
        atomic_store(inquiry->question->done, done);
    if (inquiry->means->beat)
        inquiry->means->beat();
    return still_wanted(inquiry, "within the solve");
}

static struct answer *responder_refuse(const struct inquiry *inquiry)
{
    return encode_refusal(&inquiry->question->envelope, inquiry->status, inquiry->fault.text);
}

/* The owner of a specimen keeps it until the solve has ended. */
static enum percuss_status hold_specimen(const struct question *question, size_t index,
                                         struct solve_body *body, struct fault *fault)
{
    if (!question->specimens)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "bodies[%zu].specimen: %s: must be empty%s",
                         index, question->request->bodies._buffer[index].specimen,
                         question->in_batch
                             ? " in a batch: specimens are asked about one request at a time"
                             : ": this server keeps no specimens, its settings name no store");
    body->state = question->specimens[index];
    return PERCUSS_OK;
}

static enum percuss_status hold_state(struct responder *responder, const struct question *question,
                                      size_t index, struct fault *fault)
{
    const percuss_v1_BodyMotion *wire = &question->request->bodies._buffer[index];
    const char *token = wire->state;
    struct solve_body *body = &responder->request.bodies[index];
    if (wire->specimen[0])
        return hold_specimen(question, index, body, fault);
    /* an unknown body is the solver's to refuse */
    if (!*token || !body_set_find(question->snapshot->set, body->id))
        return PERCUSS_OK;
    struct subject_name name;
    struct token_subject subject = subject_of(question, index, &name);
    struct fault reason;
    body->state = token_store_hold(responder->means.tokens, token, &subject, clock_now(), &reason);
    if (body->state)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_UNKNOWN_STATE, "bodies[%zu].state: %.500s", index, reason.text);
}

static void release_states(struct responder *responder, const struct question *question)
{
    for (size_t i = 0; i < responder->request.body_count; i++) {
        bool is_token = question->request->bodies._buffer[i].state[0] != '\0';
        if (is_token && responder->request.bodies[i].state)
            token_store_release(responder->means.tokens, responder->request.bodies[i].state);
        responder->request.bodies[i].state = NULL;
    }
}

/* Fills responder->request; after a failure it holds no states. */
static enum percuss_status prepare(struct responder *responder, const struct question *question,
                                   struct fault *fault)
{
    enum percuss_status status = decode_request(question->request, &responder->request, fault);
    if (!status && question->in_batch && responder->request.options.trace)
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "options.trace: true: must be false in a batch: ask by itself");
    if (status)
        return status;
    for (size_t i = 0; !status && i < responder->request.body_count; i++)
        status = hold_state(responder, question, i, fault);
    if (status)
        release_states(responder, question);
    return status;
}

/* False: out of memory. */
static bool name_states(struct responder *responder, const struct question *question)
{
    double now = clock_now();
    for (size_t i = 0; i < responder->result.body_count; i++) {
        const struct solve_body_result *body = &responder->result.bodies[i];
        responder->states_after[i][0] = '\0';
        if (!body->state_after)
            continue;
        struct subject_name name;
        struct token_subject subject = subject_of(question, i, &name);
        if (!token_store_put(responder->means.tokens, &subject, body->state_after, now,
                             responder->states_after[i]))
            return false;
    }
    return true;
}

/* Solves responder->request and makes the reply. */
static struct answer *compute(struct responder *responder, const struct question *question)
{
    const struct envelope *envelope = &question->envelope;
    struct solve_result *result = &responder->result;
    struct inquiry inquiry = {&responder->means, question, clock_now(), PERCUSS_OK, {""}};
    /* the client may want it no more */
    if (!still_wanted(&inquiry, "before the solve began"))
        return responder_refuse(&inquiry);
    /* the solve, as long as it does */
    const struct solve_context means = {
        question->snapshot->set,
        table_maker_begin(&responder->maker, question->snapshot->tables, question->request,
                          envelope->client, question->arrival),
        {goes_on, &inquiry}};
    responder->maker.still_wanted = question->still_wanted;
    responder->maker.wanted_context = question->context;
    responder->maker.done = question->done;
    solve(responder->workspace, &means, &responder->request, result);
    /* why there is no result */
    if (responder->maker.status)
        return encode_refusal(envelope, responder->maker.status, responder->maker.fault.text);
    if (result->status == PERCUSS_INTERNAL && responder->means.complain)
        responder->means.complain(envelope, result->fault.text);
    if (!inquiry.status)
        inquiry.status = check_deadline(question, "when the solve ended", &inquiry.fault);
    if (inquiry.status)
        return responder_refuse(&inquiry);
    if (!encode_status_has_result(result->status))
        return encode_refusal(envelope, result->status, result->fault.text);
    /* the reply on it */
    if (!name_states(responder, question))
        return encode_refusal(envelope, PERCUSS_INTERNAL, "out of memory");
    const char(*names)[PERCUSS_ID_SIZE] = (const char(*)[PERCUSS_ID_SIZE])responder->states_after;
    if (question->in_batch)
        return batch_encode_member(envelope, result, names);
    return encode_result(envelope, result, names, PERCUSS_MAX_SUB_IMPACTS);
}

void responder_settle(struct responder *responder)
{
    solve_workspace_settle(responder->workspace);
}

struct answer *responder_answer(struct responder *responder, const struct question *question)
{
    struct fault fault;
    double start = clock_now();
    enum percuss_status status = prepare(responder, question, &fault);
    if (status)
        return encode_refusal(&question->envelope, status, fault.text);
    struct answer *answer = compute(responder, question);
    release_states(responder, question);
    if (answer) {
        answer->reply->timing.queue = start - question->arrival;
        answer->reply->timing.solve = clock_now() - start;
    }
    return answer;
}
