/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Clients that want every request answered once, though samples get lost and the service dies: what
 * is not answered is asked again under its number, of whoever is there. Some requests are strikes,
 * half of them on a specimen of the client's own, one after the other and each of another speed, so
 * that dents and answers depend on their order; the others on specimens of all clients, who do not
 * know their order: those strikes are all the same. */
#include <inttypes.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <time.h>

#include "crowd.h"

enum { DIFFERENT = 64, RARELY = 20, MOST_OUTSTANDING = 1024 };

enum { OWN = 2 * RARELY }; /* from one strike on the client's own specimen to the next */

/* Without an answer for so long, s, a request is asked again: a reply can be lost with a server. */
static const double PATIENCE = 5.0;
static const double GIVING_UP = 300.0; /* s without any answer: something hangs */
static const long LOOK = 200000000;    /* ns from one line about the progress to the next */

/* What was answered, to the bit. */
struct outcome {
    bool known;
    uint64_t restitution, impulse;
};

struct member {
    const struct crowd *crowd;
    unsigned number;
    uint8_t id[16];
    struct percuss_client *client;
    struct outcome *outcomes; /* by sequence, from 1 */
    unsigned long sent;
    atomic_ulong done;
    atomic_bool ended;
    unsigned long strikes, reconnections, repeats, busy, wrong;
    bool good, refused;
    pthread_t thread;
};

/* Every so many requests one hits a specimen. */
static bool is_strike(const struct member *member, unsigned long sequence)
{
    return member->crowd->specimens && sequence % RARELY == 0;
}

static bool is_own(const struct member *member, unsigned long sequence)
{
    return is_strike(member, sequence) && sequence % OWN == 0;
}

/* Whether the strike before on the same specimen is not answered yet. */
static bool has_to_wait(const struct member *member, unsigned long sequence)
{
    return is_own(member, sequence) && sequence > OWN && !member->outcomes[sequence - OWN].known;
}

/* The specimen of all that a strike hits, in turn. */
static unsigned long shared_specimen(const struct member *member, unsigned long sequence)
{
    return sequence / OWN % member->crowd->specimens;
}

/* Rises from strike to strike, so that each deepens the dent and finds that of the one before,
 * m/s. */
static double own_speed(unsigned long sequence)
{
    return 0.1 + 1e-4 * (double)(sequence / OWN);
}

static void fill(const struct member *member, unsigned long sequence,
                 struct percuss_request *request)
{
    bool strikes = is_strike(member, sequence);
    question_fill(QUESTION_CHEAP, strikes ? 0 : sequence % DIFFERENT, request);
    request->sequence = sequence;
    if (!strikes)
        return;
    strcpy(request->bodies[1].id, "al-rod-1");
    request->contacts[0].point[0] = 0.5;
    request->bodies[0].position[0] = 0.515;
    request->options.contact_model = PERCUSS_CONTACT_CLOSED_FORM;
    request->options.compliance = PERCUSS_COMPLIANCE_HALF_SPACE;
    request->options.tolerance = 1e-3;
    char *specimen = request->bodies[1].specimen;
    if (is_own(member, sequence)) {
        request->bodies[0].velocity[0] = -own_speed(sequence);
        snprintf(specimen, sizeof request->bodies[1].specimen, "own-%u", member->number);
    } else {
        snprintf(specimen, sizeof request->bodies[1].specimen, "shared-%lu",
                 shared_specimen(member, sequence));
    }
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
        if (member->outcomes[i].known)
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

static bool is_same(const struct outcome *a, const struct outcome *b)
{
    return a->restitution == b->restitution && a->impulse == b->impulse;
}

/* Notes an answer. False: none of the requests, or another one than before to the same request. */
static bool note(struct member *member, const struct percuss_reply *reply)
{
    if (reply->sequence == 0 || reply->sequence > member->sent)
        return false;
    struct outcome told = {.known = true}, *outcome = &member->outcomes[reply->sequence];
    memcpy(&told.restitution, &reply->contacts[0].restitution, sizeof told.restitution);
    memcpy(&told.impulse, &reply->contacts[0].impulse, sizeof told.impulse);
    if (outcome->known)
        return is_same(outcome, &told);
    *outcome = told;
    member->done++;
    member->strikes += is_strike(member, reply->sequence);
    return true;
}

/* A reply; BUSY is asked again. */
static void take(struct member *member, const struct percuss_reply *reply, bool *lost)
{
    if (reply->status == PERCUSS_OK) {
        if (!note(member, reply))
            member->wrong++;
    } else if (reply->status == PERCUSS_BUSY) {
        member->busy++;
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
        *lost = !send(member, reply->sequence);
    } else {
        fprintf(stderr, "request %llu: %s: %s\n", (unsigned long long)reply->sequence,
                percuss_status_name(reply->status), reply->message);
        member->wrong++;
        member->refused = true;
    }
}

/* Sends what may be outstanding. False: see send. */
static bool send_more(struct member *member)
{
    const struct crowd *crowd = member->crowd;
    bool good = true;
    for (;
         good && member->sent < crowd->requests &&
         member->sent - member->done < crowd->outstanding && !has_to_wait(member, member->sent + 1);
         member->sent++)
        good = send(member, member->sent + 1);
    return good;
}

static bool ask_all(struct member *member)
{
    double heard = crowd_now();
    while (member->done < member->crowd->requests && !member->refused) {
        bool lost = !send_more(member);
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
    return !member->refused;
}

static void *run(void *argument)
{
    struct member *member = argument;
    member->good = getrandom(member->id, sizeof member->id, 0) == sizeof member->id;
    member->client = crowd_connect(member->crowd, member->id);
    member->good = member->good && member->client && ask_all(member);
    percuss_client_free(member->client);
    atomic_store(&member->ended, true);
    return NULL;
}

static bool begin(const struct crowd *crowd, struct member *member)
{
    member->crowd = crowd;
    member->outcomes = calloc(crowd->requests + 1, sizeof *member->outcomes);
    return member->outcomes && pthread_create(&member->thread, NULL, run, member) == 0;
}

/* Prints how many are answered until all members have ended. */
static void look_on(const struct crowd *crowd, struct member *all)
{
    bool goes_on = true;
    while (goes_on) {
        unsigned long done = 0;
        goes_on = false;
        for (unsigned i = 0; i < crowd->clients; i++) {
            done += atomic_load(&all[i].done);
            goes_on = goes_on || !atomic_load(&all[i].ended);
        }
        printf("%lu of %lu\n", done, crowd->clients * crowd->requests);
        fflush(stdout);
        nanosleep(&(struct timespec){.tv_nsec = LOOK}, NULL);
    }
}

/* How many answers to one and the same question differ from the first one. */
static unsigned long count_others(const struct crowd *crowd, const struct member *all)
{
    const struct outcome *first[DIFFERENT] = {NULL};
    unsigned long others = 0;
    for (unsigned i = 0; i < crowd->clients; i++)
        for (unsigned long sequence = 1; sequence <= crowd->requests; sequence++) {
            const struct outcome *outcome = &all[i].outcomes[sequence];
            if (is_strike(&all[i], sequence) || !outcome->known)
                continue;
            const struct outcome **known = &first[sequence % DIFFERENT];
            *known = *known ? *known : outcome;
            others += !is_same(*known, outcome);
        }
    return others;
}

/* A line for each answer to a strike, and for the first ones of other requests: those of two runs
 * are the same when sorted. */
static bool record(const struct crowd *crowd, const struct member *all)
{
    FILE *file = fopen(crowd->record, "w");
    for (unsigned i = 0; file && i < crowd->clients; i++)
        for (unsigned long sequence = 1; sequence <= crowd->requests; sequence++) {
            const struct member *member = &all[i];
            const struct outcome *outcome = &member->outcomes[sequence];
            if (is_own(member, sequence))
                fprintf(file, "own-%u %lu", i, sequence);
            else if (is_strike(member, sequence))
                fprintf(file, "shared-%lu", shared_specimen(member, sequence));
            else if (i == 0 &&
                     sequence <= 2 * DIFFERENT) /* each question, where some are strikes */
                fprintf(file, "question %lu", sequence % DIFFERENT);
            else
                continue;
            fprintf(file, " %016" PRIx64 " %016" PRIx64 "\n", outcome->restitution,
                    outcome->impulse);
        }
    bool good = file && !ferror(file);
    return file && fclose(file) == 0 && good;
}

static void add(struct member *sum, const struct member *member)
{
    sum->good = sum->good && member->good;
    sum->done += member->done;
    sum->strikes += member->strikes;
    sum->repeats += member->repeats;
    sum->reconnections += member->reconnections;
    sum->busy += member->busy;
    sum->wrong += member->wrong;
}

bool crowd_steady(const struct crowd *crowd)
{
    struct member *all = calloc(crowd->clients, sizeof *all);
    struct member sum = {.good = all != NULL};
    if (!sum.good || crowd->outstanding > MOST_OUTSTANDING)
        return false;
    for (unsigned i = 0; i < crowd->clients; i++) {
        all[i].number = i;
        if (!begin(crowd, &all[i]))
            abort();
    }
    look_on(crowd, all);
    for (unsigned i = 0; i < crowd->clients; i++) {
        pthread_join(all[i].thread, NULL);
        add(&sum, &all[i]);
    }
    sum.wrong += count_others(crowd, all);
    if (crowd->record && !record(crowd, all)) {
        fprintf(stderr, "%s: cannot be written\n", crowd->record);
        sum.good = false;
    }
    printf("%lu answered, %lu strikes, %lu wrong, %lu repeated, %lu busy, %lu reconnections\n",
           sum.done, sum.strikes, sum.wrong, sum.repeats, sum.busy, sum.reconnections);
    for (unsigned i = 0; i < crowd->clients; i++)
        free(all[i].outcomes);
    free(all);
    return sum.good && sum.wrong == 0;
}
