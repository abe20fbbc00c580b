/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Clients that want every request answered once, though samples get lost and the service dies: what
 * is not answered is asked again under its number, of whoever is there. */
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <time.h>

#include "crowd.h"

enum { DIFFERENT = 64, RARELY = 20, MOST_OUTSTANDING = 1024 };

/* Without an answer for so long, s, a request is asked again: a reply can be lost with a server. */
static const double PATIENCE = 5.0;
static const double GIVING_UP = 300.0; /* s without any answer: something hangs */

/* What all clients expect: the answer to each of the different questions, the same bits always. */
struct expected {
    _Atomic uint64_t bits[DIFFERENT]; /* 0: not known yet */
};

struct member {
    const struct crowd *crowd;
    struct expected *expected;
    unsigned number;
    uint8_t id[16];
    struct percuss_client *client;
    uint8_t *answered; /* by sequence, from 1: how many replies were handed over */
    unsigned long sent, done;
    unsigned long strikes, reconnections, repeats, busy, wrong;
    bool good;
    pthread_t thread;
};

/* Every so many requests one hits a specimen. */
static bool is_strike(const struct member *member, unsigned long sequence)
{
    return member->crowd->specimens && sequence % RARELY == 0;
}

static void fill(const struct member *member, unsigned long sequence,
                 struct percuss_request *request)
{
    question_fill(QUESTION_CHEAP, sequence % DIFFERENT, request);
    request->sequence = sequence;
    if (!is_strike(member, sequence))
        return;
    /* a specimen of this client alone, or of all, in turn */
    strcpy(request->bodies[1].id, "al-rod-1");
    request->contacts[0].point[0] = 0.5;
    request->bodies[0].position[0] = 0.515;
    request->options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
    request->options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    request->options.tolerance = 1e-3;
    snprintf(request->bodies[1].specimen, sizeof request->bodies[1].specimen, "rig-%lu",
             sequence / RARELY % member->crowd->specimens);
}

/* Sends the request, new or once more. False: the server has gone, or the client cannot. */
static bool send(struct member *member, unsigned long sequence)
{
    static _Thread_local struct percuss_request request;
    fill(member, sequence, &request);
    return percuss_submit(member->client, &request, NULL) == PERCUSS_RESULT_OK;
}

static bool send_unanswered(struct member *member)
{
    bool good = true;
    for (unsigned long i = 1; good && i <= member->sent; i++) {
        if (member->answered[i])
            continue;
        member->repeats++;
        good = send(member, i);
    }
    return good;
}

/* Finds a server and asks it for all that is outstanding. */
static bool come_back(struct member *member)
{
    member->reconnections++;
    double end = crowd_now() + GIVING_UP;
    while (crowd_now() < end) {
        percuss_client_free(member->client);
        member->client = crowd_connect(member->crowd, member->id);
        if (member->client && send_unanswered(member))
            return true;
    }
    return false;
}

static bool check(struct member *member, const struct percuss_reply *reply)
{
    /* each once, whatever was repeated */
    if (reply->sequence == 0 || reply->sequence > member->sent)
        return false;
    if (member->answered[reply->sequence])
        return true;
    member->answered[reply->sequence] = 1;
    member->done++;
    if (is_strike(member, reply->sequence)) {
        member->strikes++;
        return true;
    }
    /* the answer to this question and no other */
    uint64_t bits, none = 0;
    memcpy(&bits, &reply->contacts[0].impulse, sizeof bits);
    _Atomic uint64_t *known = &member->expected->bits[reply->sequence % DIFFERENT];
    return atomic_compare_exchange_strong(known, &none, bits) || none == bits;
}

/* A reply; BUSY is asked again. */
static void take(struct member *member, const struct percuss_reply *reply, bool *lost)
{
    if (reply->status == PERCUSS_OK) {
        if (!check(member, reply))
            member->wrong++;
    } else if (reply->status == PERCUSS_BUSY) {
        member->busy++;
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
        *lost = !send(member, reply->sequence);
    } else {
        fprintf(stderr, "request %llu: %s: %s\n", (unsigned long long)reply->sequence,
                percuss_status_name(reply->status), reply->message);
        member->wrong++;
        member->answered[reply->sequence] = 1;
        member->done++;
    }
}

static bool ask_all(struct member *member)
{
    unsigned long all = member->crowd->requests;
    double heard = crowd_now();
    while (member->done < all) {
        bool lost = false;
        for (; !lost && member->sent < all &&
               member->sent - member->done < member->crowd->outstanding;
             member->sent++)
            lost = !send(member, member->sent + 1);
        struct percuss_reply reply;
        enum percuss_result result =
            lost ? PERCUSS_RESULT_NO_SERVER : percuss_wait(member->client, 0, PATIENCE, &reply);
        if (result == PERCUSS_RESULT_OK) {
            take(member, &reply, &lost);
            percuss_reply_free(&reply);
            heard = crowd_now();
        } else if (result == PERCUSS_RESULT_TIMEOUT) {
            lost = !send_unanswered(member);
        }
        if (crowd_now() - heard > GIVING_UP)
            return false;
        if ((lost || (result && result != PERCUSS_RESULT_TIMEOUT)) && !come_back(member))
            return false;
    }
    return true;
}

static void *run(void *argument)
{
    struct member *member = argument;
    member->good = getrandom(member->id, sizeof member->id, 0) == sizeof member->id;
    member->client = crowd_connect(member->crowd, member->id);
    member->good = member->good && member->client && ask_all(member);
    percuss_client_free(member->client);
    return NULL;
}

bool crowd_steady(const struct crowd *crowd)
{
    struct expected *expected = calloc(1, sizeof *expected);
    struct member *all = calloc(crowd->clients, sizeof *all);
    struct member sum = {.good = expected && all};
    if (!sum.good || crowd->outstanding > MOST_OUTSTANDING)
        return false;
    for (unsigned i = 0; i < crowd->clients; i++) {
        all[i] = (struct member){.crowd = crowd, .expected = expected, .number = i};
        all[i].answered = calloc(crowd->requests + 1, 1);
        if (!all[i].answered || pthread_create(&all[i].thread, NULL, run, &all[i]))
            abort();
    }
    for (unsigned i = 0; i < crowd->clients; i++) {
        pthread_join(all[i].thread, NULL);
        sum.good = sum.good && all[i].good;
        sum.done += all[i].done;
        sum.strikes += all[i].strikes;
        sum.repeats += all[i].repeats;
        sum.reconnections += all[i].reconnections;
        sum.busy += all[i].busy;
        sum.wrong += all[i].wrong;
        free(all[i].answered);
    }
    printf("%lu answered, %lu strikes, %lu wrong, %lu repeated, %lu busy, %lu reconnections\n",
           sum.done, sum.strikes, sum.wrong, sum.repeats, sum.busy, sum.reconnections);
    free(all);
    free(expected);
    return sum.good && sum.wrong == 0;
}
