/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/respond.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/hash.h"
#include "daemon/log.h"
#include "endpoint/batch.h"
#include "endpoint/clock.h"
#include "endpoint/decode.h"
#include "endpoint/encode.h"

struct seat *seat_create(struct table_shelf *shelf, bool makes)
{
    struct seat *seat = calloc(1, sizeof *seat);
    if (!seat)
        return NULL;
    seat->workspace = solve_workspace_create();
    if (!seat->workspace) {
        free(seat);
        return NULL;
    }
    table_maker_init(&seat->maker, shelf, makes);
    return seat;
}

void seat_free(struct seat *seat)
{
    if (!seat)
        return;
    solve_workspace_free(seat->workspace);
    free(seat);
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

/* Whose state it is: a body with other parameters has other states. */
struct subject_name {
    char text[TOKEN_BODY_SIZE];
};

static struct token_subject subject_of(const struct question *question, size_t index,
                                       struct subject_name *name)
{
    const percuss_v1_BodyMotion *body = &question->request->bodies._buffer[index];
    struct hasher hasher = {0};
    for (uint32_t i = 0; i < body->overrides._length; i++) {
        hash_number(&hasher, body->overrides._buffer[i].parameter);
        hash_bytes(&hasher, &body->overrides._buffer[i].value, sizeof(double));
    }
    struct digest digest = hash_digest(&hasher);
    if (body->overrides._length > 0)
        snprintf(name->text, sizeof name->text, "%s/%016llx%016llx", body->id,
                 (unsigned long long)digest.first, (unsigned long long)digest.second);
    else
        snprintf(name->text, sizeof name->text, "%s", body->id);
    return (struct token_subject){question->set->revision, name->text};
}

/* Whether a question is to be answered, and if not, what it is refused with. */
struct vigil {
    const struct question *question;
    enum percuss_status status;
    struct fault fault;
};

static bool vigil_look(struct vigil *vigil, const char *when)
{
    const struct question *question = vigil->question;
    vigil->status = check_deadline(question, when, &vigil->fault);
    if (!vigil->status && question->still_wanted)
        vigil->status = question->still_wanted(question->context, &vigil->fault);
    return vigil->status == PERCUSS_OK;
}

/* What a solve asks now and then. */
static bool goes_on(void *context, double done)
{
    (void)done;
    return vigil_look(context, "within the solve");
}

static struct answer *refuse(const struct vigil *vigil)
{
    return encode_refusal(&vigil->question->envelope, vigil->status, vigil->fault.text);
}

/* What keeps a specimen outlives the solve. */
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

static enum percuss_status hold_state(struct seat *seat, struct token_store *tokens,
                                      const struct question *question, size_t index,
                                      struct fault *fault)
{
    const percuss_v1_BodyMotion *wire = &question->request->bodies._buffer[index];
    const char *token = wire->state;
    struct solve_body *body = &seat->request.bodies[index];
    if (wire->specimen[0])
        return hold_specimen(question, index, body, fault);
    /* an unknown body is the solver's to refuse */
    if (!*token || !body_set_find(question->set, body->id))
        return PERCUSS_OK;
    struct subject_name name;
    struct token_subject subject = subject_of(question, index, &name);
    struct fault reason;
    body->state = token_store_hold(tokens, token, &subject, clock_now(), &reason);
    if (body->state)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_UNKNOWN_STATE, "bodies[%zu].state: %.500s", index, reason.text);
}

static void release_states(struct seat *seat, struct token_store *tokens,
                           const struct question *question)
{
    for (size_t i = 0; i < seat->request.body_count; i++) {
        bool is_token = question->request->bodies._buffer[i].state[0] != '\0';
        if (is_token && seat->request.bodies[i].state)
            token_store_release(tokens, seat->request.bodies[i].state);
        seat->request.bodies[i].state = NULL;
    }
}

/* Fills seat->request; after a failure it holds no states. */
static enum percuss_status prepare(struct seat *seat, struct token_store *tokens,
                                   const struct question *question, struct fault *fault)
{
    enum percuss_status status = decode_request(question->request, &seat->request, fault);
    if (!status && question->in_batch && seat->request.options.trace)
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "options.trace: true: must be false in a batch: ask by itself");
    if (status)
        return status;
    for (size_t i = 0; !status && i < seat->request.body_count; i++)
        status = hold_state(seat, tokens, question, i, fault);
    if (status)
        release_states(seat, tokens, question);
    return status;
}

static void name_states(struct seat *seat, struct token_store *tokens,
                        const struct question *question)
{
    double now = clock_now();
    for (size_t i = 0; i < seat->result.body_count; i++) {
        const struct solve_body_result *body = &seat->result.bodies[i];
        struct subject_name name;
        struct token_subject subject = subject_of(question, i, &name);
        seat->tokens[i][0] = '\0';
        if (body->state_after)
            token_store_put(tokens, &subject, body->state_after, now, seat->tokens[i]);
    }
}

/* Who leaves the choice takes the tables that are there. */
static void use_tables(struct seat *seat, const struct question *question)
{
    bool insists = seat->request.options.contact_model == PERCUSS_CONTACT_TABLE;
    const struct contact_table_source *made = table_maker_begin(
        &seat->maker, question->request, question->envelope.client, question->arrival);
    solve_workspace_set_tables(seat->workspace,
                               insists ? made : table_store_source(seat->maker.shelf->loaded));
}

/* Solves seat->request and makes the reply. */
static struct answer *compute(struct seat *seat, struct token_store *tokens,
                              const struct question *question)
{
    const struct envelope *envelope = &question->envelope;
    struct solve_result *result = &seat->result;
    struct vigil vigil = {.question = question};
    if (!vigil_look(&vigil, "before the solve began"))
        return refuse(&vigil);
    use_tables(seat, question);
    solve_workspace_watch(seat->workspace, (struct watch){goes_on, &vigil});
    solve(seat->workspace, question->set, &seat->request, result);
    solve_workspace_watch(seat->workspace, (struct watch){0});
    if (seat->maker.status)
        return encode_refusal(envelope, seat->maker.status, seat->maker.fault.text);
    if (result->status == PERCUSS_INTERNAL)
        log_line(LEVEL_ERROR, "request %llu: internal: %s", (unsigned long long)envelope->sequence,
                 result->fault.text);
    if (!vigil.status)
        vigil.status = check_deadline(question, "when the solve ended", &vigil.fault);
    if (vigil.status)
        return refuse(&vigil);
    if (!encode_status_has_result(result->status))
        return encode_refusal(envelope, result->status, result->fault.text);
    name_states(seat, tokens, question);
    const char(*names)[PERCUSS_ID_SIZE] = (const char(*)[PERCUSS_ID_SIZE])seat->tokens;
    if (question->in_batch)
        return batch_encode_member(envelope, result, names);
    return encode_result(envelope, result, names, PERCUSS_MAX_SUB_IMPACTS);
}

struct answer *respond(struct seat *seat, struct token_store *tokens,
                       const struct question *question)
{
    struct fault fault;
    double start = clock_now();
    enum percuss_status status = prepare(seat, tokens, question, &fault);
    if (status)
        return encode_refusal(&question->envelope, status, fault.text);
    struct answer *answer = compute(seat, tokens, question);
    release_states(seat, tokens, question);
    if (answer) {
        answer->reply->timing.queue = start - question->arrival;
        answer->reply->timing.solve = clock_now() - start;
    }
    return answer;
}
