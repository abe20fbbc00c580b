/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "daemon/specimen_lane.h"

#include <errno.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "daemon/log.h"
#include "endpoint/reply_bytes.h"
#include "exchange/clock.h"
#include "exchange/encode.h"
#include "exchange/question.h"
#include "store/backup.h"
#include "store/database.h"
#include "store/database_check.h"
#include "store/specimens.h"

/* Problems that are logged one by one. */
enum { MOST_COMPLAINTS = 20 };

static void store_complain(void *context, const char *problem)
{
    int *count = context;
    if ((*count)++ < MOST_COMPLAINTS)
        log_line(LEVEL_ERROR, "store: %s", problem);
}

/* Checks the store and logs the result. */
static enum percuss_status store_look(struct specimen_store *store, struct audit *audit,
                                      struct fault *fault)
{
    int complaints = 0;
    audit->complain = store_complain;
    audit->context = &complaints;
    enum percuss_status status = specimen_store_audit(store, audit, fault);
    if (!status)
        log_line(audit->damaged ? LEVEL_ERROR : LEVEL_INFO,
                 "store: %zu specimens, %zu replies, %zu marks of clients: %zu damaged",
                 audit->specimens, audit->replies, audit->marks, audit->damaged);
    return status;
}

static enum percuss_status store_check(struct specimen_store *store, bool structure,
                                       struct fault *fault)
{
    struct audit audit = {.structure = structure};
    enum percuss_status status = store_look(store, &audit, fault);
    if (status || !audit.unusable)
        return status;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "the store of specimens is damaged: nobody knows what was answered: restore "
                     "it from a copy or move it away");
}

static void store_back_up(struct specimen_store *store, const char *path)
{
    struct fault fault;
    if (store_check(store, true, &fault))
        log_line(LEVEL_ERROR, "store: %s", fault.text);
    if (!*path)
        return;
    if (backup_write(store, path, &fault))
        log_line(LEVEL_ERROR, "store: not copied: %s", fault.text);
    else
        log_line(LEVEL_INFO, "store: copied to %s", path);
}

bool specimen_lane_check_file(const char *path)
{
    struct specimen_store *store = NULL;
    struct fault fault;
    enum percuss_status status = PERCUSS_OK;
    /* opening would make one */
    if (access(path, R_OK | W_OK) != 0)
        status = fault_set(&fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be used: %s", path,
                           strerror(errno));
    if (!status)
        status = specimen_store_open(path, UINT_MAX, &store, &fault);
    struct audit audit = {.structure = false};
    if (!status)
        status = store_look(store, &audit, &fault);
    specimen_store_close(store);
    if (status)
        log_line(LEVEL_ERROR, "%s", fault.text);
    return !status && !audit.damaged;
}

/* Not the id of any body. */
static const char DAMAGED_BODY[] = "(damaged)";

struct specimen_lane {
    const char *path;
    unsigned replies;
    struct specimen_store *store; /* NULL: there was no room for it yet */
    struct endpoint *endpoint;
    struct histogram *commits;
    atomic_size_t count;
    struct body_state *states[PERCUSS_MAX_BODIES]; /* of the request at hand */
};

static enum percuss_status lane_open_store(struct specimen_lane *lane, struct fault *fault)
{
    enum percuss_status status =
        specimen_store_open(lane->path, lane->replies, &lane->store, fault);
    /* the missing room in the message, where the volume tells it */
    if (status == PERCUSS_BUSY)
        database_room_check(lane->path, fault);
    if (!status)
        status = store_check(lane->store, false, fault);
    if (status) {
        specimen_store_close(lane->store);
        lane->store = NULL;
        return status;
    }
    atomic_store(&lane->count, specimen_store_count(lane->store));
    return PERCUSS_OK;
}

enum percuss_status specimen_lane_open(const char *path, unsigned replies,
                                       struct histogram *commits, struct specimen_lane **lane,
                                       struct fault *fault)
{
    struct specimen_lane *created = calloc(1, sizeof *created);
    *lane = NULL;
    if (!created)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    created->path = path;
    created->replies = replies;
    created->commits = commits;
    atomic_init(&created->count, 0);
    enum percuss_status status = lane_open_store(created, fault);
    if (status && status != PERCUSS_BUSY) {
        specimen_lane_close(created);
        return status;
    }
    /* it starts all the same: a daemon that ends answers no requests, and a restart finds no more
     * room */
    struct fault room;
    if (status || database_room_check(path, &room))
        log_line(LEVEL_WARNING, "store: %s: requests that name specimens are refused meanwhile",
                 status ? fault->text : room.text);
    *lane = created;
    return PERCUSS_OK;
}

void specimen_lane_close(struct specimen_lane *lane)
{
    if (!lane)
        return;
    specimen_store_close(lane->store);
    free(lane);
}

static void lane_announce(void *context, const struct specimen *specimen)
{
    struct specimen_lane *lane = context;
    /* a damaged one is seen, so that it can be cleared */
    const char *body = specimen->damaged ? DAMAGED_BODY : specimen->body;
    struct dents_notice notice = {specimen->name, body, specimen->impacts, specimen->state};
    endpoint_announce_dents(lane->endpoint, &notice);
}

/* All specimens, or one. */
static void lane_announce_again(struct specimen_lane *lane, const char *specimen)
{
    struct fault fault;
    if (specimen_store_visit(lane->store, specimen, lane_announce, lane, &fault))
        log_line(LEVEL_ERROR, "%s", fault.text);
}

void specimen_lane_announce(struct specimen_lane *lane, struct endpoint *endpoint)
{
    lane->endpoint = endpoint;
    if (lane->store)
        lane_announce_again(lane, NULL);
}

size_t specimen_lane_count(struct specimen_lane *lane)
{
    return atomic_load(&lane->count);
}

bool specimen_lane_concerns(const percuss_v1_Request *request)
{
    for (uint32_t i = 0; i < request->bodies._length; i++) {
        if (request->bodies._buffer[i].specimen[0])
            return true;
    }
    return false;
}

/* Opens the store where there was no room for it before. */
static enum percuss_status lane_need_store(struct specimen_lane *lane, struct fault *fault)
{
    if (lane->store)
        return PERCUSS_OK;
    enum percuss_status status = lane_open_store(lane, fault);
    if (status)
        return status;
    log_line(LEVEL_INFO, "store: %s: there is room", lane->path);
    lane_announce_again(lane, NULL);
    return PERCUSS_OK;
}

/* The message names the specimen; PERCUSS_BUSY: there is no room. */
static struct answer *lane_refuse_specimen(const struct question *question,
                                           enum percuss_status status, const char *problem)
{
    char text[640];
    const percuss_v1_Request *request = question->request;
    uint32_t i = 0;
    while (i + 1 < request->bodies._length && !request->bodies._buffer[i].specimen[0])
        i++;
    log_line(LEVEL_ERROR, "store: an impact on %s is refused: %s",
             request->bodies._buffer[i].specimen, problem);
    snprintf(text, sizeof text,
             "bodies[%u].specimen: %s: cannot be stored: %s: nothing has changed: %s and ask again",
             i, request->bodies._buffer[i].specimen, problem,
             status == PERCUSS_BUSY ? "make room there" : "mend the store");
    return encode_refusal(&question->envelope, PERCUSS_INTERNAL, text);
}

static void lane_release_states(struct specimen_lane *lane)
{
    for (size_t i = 0; i < PERCUSS_MAX_BODIES; i++) {
        free(lane->states[i]);
        lane->states[i] = NULL;
    }
}

/* Fills lane->states. */
static enum percuss_status lane_load_states(struct specimen_lane *lane,
                                            const struct question *question, struct fault *fault)
{
    for (uint32_t i = 0; i < question->request->bodies._length; i++) {
        const percuss_v1_BodyMotion *wire = &question->request->bodies._buffer[i];
        const struct body *body = body_set_find(question->snapshot->set, wire->id);
        struct fault reason;
        /* the solver refuses an unknown body */
        if (!wire->specimen[0] || !body)
            continue;
        enum percuss_status status =
            specimen_store_load(lane->store, wire->specimen, body, &lane->states[i], &reason);
        if (status == PERCUSS_INTERNAL)
            log_line(LEVEL_ERROR, "%s", reason.text);
        if (status)
            return fault_set(fault, status, "bodies[%u].specimen: %.560s", i, reason.text);
    }
    return PERCUSS_OK;
}

/* Fills the specimens' new dents; returns their number. A request that ignores dents leaves none.
 */
static size_t lane_find_changes(const struct question *question, const struct responder *responder,
                                struct specimen_change *changes)
{
    size_t count = 0;
    if (question->request->options.dents != PERCUSS_DENTS_KEEP)
        return 0;
    for (uint32_t i = 0; i < question->request->bodies._length; i++) {
        const percuss_v1_BodyMotion *wire = &question->request->bodies._buffer[i];
        if (wire->specimen[0])
            changes[count++] = (struct specimen_change){
                wire->specimen, body_set_find(question->snapshot->set, wire->id),
                responder->result.bodies[i].state_after};
    }
    return count;
}

/* Stores an answer with the new dents. After PERCUSS_INTERNAL nothing has changed. */
static enum percuss_status lane_commit(struct specimen_lane *lane, const struct question *question,
                                       const struct responder *responder,
                                       const struct answer *answer, struct stored_reply *reply,
                                       struct fault *fault)
{
    struct specimen_change changes[PERCUSS_MAX_BODIES];
    struct fault reason;
    size_t count = lane_find_changes(question, responder, changes);
    /* the reply as it is sent to a repeated request */
    reply->bytes = reply_bytes_write(answer, &reply->size);
    if (!reply->bytes)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* impact and reply are stored together or not at all */
    double begun = clock_now();
    enum percuss_status status = specimen_store_commit(lane->store, changes, count, reply, &reason);
    metrics_note_time(lane->commits, clock_now() - begun);
    free(reply->bytes);
    if (status)
        return fault_set(fault, status, "the store of specimens failed: %.400s", reason.text);
    /* announces the new dents */
    atomic_store(&lane->count, specimen_store_count(lane->store));
    for (size_t i = 0; i < count; i++)
        lane_announce_again(lane, changes[i].name);
    return PERCUSS_OK;
}

static struct answer *lane_compute(struct specimen_lane *lane, struct responder *responder,
                                   const struct question *question, struct stored_reply *reply)
{
    struct fault fault, room;
    if (database_room_check(lane->path, &fault))
        return lane_refuse_specimen(question, PERCUSS_BUSY, fault.text);
    enum percuss_status status = lane_load_states(lane, question, &fault);
    if (status)
        return encode_refusal(&question->envelope, status, fault.text);
    struct question posed = *question;
    posed.specimens = (const struct body_state *const *)lane->states;
    struct answer *answer = responder_answer(responder, &posed);
    if (!answer || !encode_status_has_result(answer->reply->status))
        return answer;
    status = lane_commit(lane, question, responder, answer, reply, &fault);
    if (!status)
        return answer;
    answer_release(answer);
    if (database_room_check(lane->path, &room))
        return lane_refuse_specimen(question, PERCUSS_BUSY, room.text);
    return lane_refuse_specimen(question, status, fault.text);
}

/* Not stored, so that the first request of that number still finds its own reply. */
static struct answer *lane_refuse_number(const struct question *question,
                                         enum percuss_status status, const char *reason)
{
    char message[512];
    snprintf(message, sizeof message, "sequence: %llu: %s",
             (unsigned long long)question->envelope.sequence, reason);
    struct answer *answer = encode_refusal(&question->envelope, status, message);
    if (answer)
        answer->passing = true;
    return answer;
}

/* A stored reply that cannot be read: the dents of its impact stay. */
static struct answer *lane_refuse_damaged(const struct question *question, const char *problem)
{
    log_line(LEVEL_ERROR, "%s", problem);
    return lane_refuse_number(
        question, PERCUSS_INTERNAL,
        "was answered before, but the stored reply cannot be read any more (the "
        "server's log says why); its impact stays counted: another one needs a new "
        "number");
}

/* It is unknown now whether there is a stored reply. */
static struct answer *lane_refuse_for_now(const struct question *question, const char *problem)
{
    log_line(LEVEL_ERROR, "%s", problem);
    return encode_refusal(&question->envelope, PERCUSS_INTERNAL,
                          "the store of specimens cannot be read (the server's log says why): "
                          "nothing has changed, ask again with the same number");
}

/* The stored reply, if it is one to this request. */
static struct answer *lane_recall(const struct question *question, const struct stored_reply *reply,
                                  struct digest content)
{
    if (reply->content[0] != content.first || reply->content[1] != content.second)
        return lane_refuse_number(question, PERCUSS_BAD_REQUEST,
                                  "was used for another request: must be a new number");
    bool damaged;
    struct answer *answer = reply_bytes_read(reply->bytes, reply->size, &damaged);
    if (answer || !damaged)
        return answer;
    char problem[96];
    snprintf(problem, sizeof problem, "the stored reply to request %llu is damaged",
             (unsigned long long)reply->sequence);
    return lane_refuse_damaged(question, problem);
}

struct answer *specimen_lane_answer(struct specimen_lane *lane, struct responder *responder,
                                    const struct question *question)
{
    /* the key of the request and its reply */
    struct digest content = question_digest_single(question->request);
    struct stored_reply reply = {.sequence = question->envelope.sequence,
                                 .content = {content.first, content.second}};
    memcpy(reply.client, question->envelope.client, sizeof reply.client);
    struct stored_reply kept = reply;
    struct fault fault;
    enum percuss_status status = lane_need_store(lane, &fault);
    if (status)
        return lane_refuse_specimen(question, status, fault.text);
    /* a reply that is stored */
    status = specimen_store_find(lane->store, &kept, &fault);
    if (status == PERCUSS_INTERNAL)
        return kept.damaged ? lane_refuse_damaged(question, fault.text)
                            : lane_refuse_for_now(question, fault.text);
    if (status)
        return encode_refusal(&question->envelope, status, fault.text);
    /* repeats it, or solves the impact */
    struct answer *answer = kept.bytes ? lane_recall(question, &kept, content)
                                       : lane_compute(lane, responder, question, &reply);
    free(kept.bytes);
    lane_release_states(lane);
    return answer;
}

void specimen_lane_clear(struct specimen_lane *lane, const char *specimen)
{
    struct fault fault;
    if (lane_need_store(lane, &fault) || specimen_store_clear(lane->store, specimen, &fault)) {
        log_line(LEVEL_ERROR, "%s", fault.text);
        return;
    }
    log_line(LEVEL_INFO, "specimen %s: cleared", specimen);
    atomic_store(&lane->count, specimen_store_count(lane->store));
    endpoint_withdraw_dents(lane->endpoint, specimen);
}

void specimen_lane_back_up(struct specimen_lane *lane, const char *path)
{
    struct fault fault;
    if (lane_need_store(lane, &fault))
        log_line(LEVEL_ERROR, "store: not looked through: %s", fault.text);
    else
        store_back_up(lane->store, path);
}
