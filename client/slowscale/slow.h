/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What one slow scale remembers between two calls. */
#ifndef PERCUSS_SLOW_H
#define PERCUSS_SLOW_H

#include <percuss/slowscale.h>

enum latch {
    LATCH_ARMED,
    LATCH_PLAYING, /* until the last sub-impact */
    LATCH_WAITING  /* for an open gap, or for a moment without approach */
};

struct pair {
    struct percuss_slow_contact contact; /* as last seen */
    double gap_rate;
    enum latch latch;
    double until;   /* s: end of PLAYING */
    bool continues; /* the answer was cut off: armed at its end whatever was seen */
    bool seen;      /* in the present call */
};

/* An impulse of an episode that is to be applied. */
struct entry {
    double time;       /* s: when it is applied */
    double start, end; /* of its sub-impact */
    size_t contact;
    double impulse;
};

/* An answer that is being played. */
struct episode {
    struct episode *next;
    double time;   /* s: of the impact */
    double window; /* s from then: the fast scale's, at whose end the tokens hold */
    bool revocable;
    struct percuss_request request; /* delassus is its own */
    struct percuss_slow_contact *contacts;
    size_t entry_count, played;
    struct entry *entries; /* by time */
};

/* The vibration of a body. */
struct token {
    char state[PERCUSS_ID_SIZE]; /* "": at rest */
    double time;                 /* s, when it holds */
};

struct percuss_slow {
    struct percuss_slow_config config;
    char (*ids)[PERCUSS_ID_SIZE]; /* [body] */
    struct percuss_slow_body *bodies;
    struct token *tokens; /* [body] */
    size_t pair_count, pair_capacity;
    struct pair *pairs;
    struct episode *episodes;
    struct percuss_slow_counts counts;
};

/* Contacts with what the engine says about them; one allocation. */
struct group {
    size_t count;
    double start; /* s: the instant that is asked about; before now if lists were revoked */
    struct percuss_slow_contact *contacts;
    double *moved; /* impulses taken back times how long they had been there, N s^2 */
    double *gap_rate, *delassus, *compression, *impulse, *restitution;
    struct percuss_body_motion *bodies; /* [bodies of the configuration] */
    const struct percuss_reply *reply;  /* NULL: declared */
    char message[512];
};

enum percuss_result slow_fail(enum percuss_result result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

struct group *group_create(const struct percuss_slow *slow, size_t count); /* NULL: no memory */

/* Asks the engine about the group's contacts: rates, and all else if `everything`. */
enum percuss_result group_probe(const struct percuss_slow *slow, struct group *group,
                                bool everything);

/* Appends to the message of a group. */
void group_note(struct group *group, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The pair of a contact, or NULL. */
struct pair *pairs_find(const struct percuss_slow *slow,
                        const struct percuss_slow_contact *contact);

/* Takes in the contacts of the present: new pairs are armed, pairs that are not there any more are
 * forgotten unless they are playing. False: no memory. */
bool pairs_take(struct percuss_slow *slow, size_t count,
                const struct percuss_slow_contact *contacts);

/* Moves the latches on, with the gap rates known. */
void pairs_update(struct percuss_slow *slow, double now);

/* Whether a contact in this state is due. */
bool pairs_is_due(const struct percuss_slow *slow, const struct percuss_slow_contact *contact,
                  double gap_rate);

/* Latches the group's pairs and enters what is to be applied: by the group's reply to `request`, or
 * without one the group's impulses now. */
enum percuss_result episode_begin(struct percuss_slow *slow, const struct group *group,
                                  const struct percuss_request *request, double now);

/* Applies all entries up to now and forgets episodes that are over; *applied counts them. */
enum percuss_result episodes_play(struct percuss_slow *slow, double now, size_t *applied);

/* The revocable episode that the contact is part of and whose window is not over, or NULL. */
struct episode *episode_of(const struct percuss_slow *slow,
                           const struct percuss_slow_contact *contact, double now);

/* The last time up to `time` at which none of its sub-impacts is under way. */
double episode_pause(const struct episode *episode, double time);

/* Revokes what happens after the group's start: drops it, or takes it back if it was applied. Asks
 * for the vibration at that time and forgets the episode. What is lost is noted in the group. */
enum percuss_result episode_preempt(struct percuss_slow *slow, struct episode *episode,
                                    struct group *group, double now);

void episodes_free(struct percuss_slow *slow);

/* The question about a group; false: too many contacts or bodies for one. */
bool question_make(const struct percuss_slow *slow, const struct group *group, double now,
                   struct percuss_request *request);

/* Puts it, again where that helps. False: no usable answer, noted in the group; else *reply is to
 * be released. */
bool question_ask(struct percuss_slow *slow, struct group *group, struct percuss_request *request,
                  struct percuss_reply *reply);

/* One question as it is; false: noted in `why`. */
bool question_put(struct percuss_slow *slow, const struct percuss_request *request,
                  struct percuss_reply *reply, char *why, size_t size);

/* Keeps the tokens of a reply to a request about these contacts; they hold at `time`. */
void tokens_keep(struct percuss_slow *slow, const struct percuss_slow_contact *contacts,
                 const struct percuss_request *request, const struct percuss_reply *reply,
                 double time);

/* Back to the tokens of a request at `time`. */
void tokens_restore(struct percuss_slow *slow, const struct percuss_slow_contact *contacts,
                    const struct percuss_request *request, double time);

/* The vibration of these contacts' bodies is unknown: taken as rest. */
void tokens_forget(struct percuss_slow *slow, size_t count,
                   const struct percuss_slow_contact *contacts);

/* Solves the impact of the due contact `first` of `seen`, a group that has been probed. */
enum percuss_result impact_solve(struct percuss_slow *slow, const struct group *seen, size_t first,
                                 double now);

#endif
