/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The state of one slow scale between two calls. */
#ifndef PERCUSS_SLOW_H
#define PERCUSS_SLOW_H

#include <percuss/slowscale.h>

#include "missing.h"

enum latch {
    LATCH_ARMED,
    LATCH_PLAYING, /* until the last sub-impact */
    LATCH_WAITING  /* for an open gap, a moment without approach, or the end of the answer */
};

struct pair {
    struct percuss_slow_contact contact; /* as last seen */
    double gap_rate;                     /* m/s, at `when` */
    double when; /* s; NAN: not seen at the last call, and unknown since then */
    enum latch latch;
    double until;        /* s: end of PLAYING */
    double over;         /* s: end of WAITING: the answer's window ends here; -INFINITY: none */
    double touch;        /* s: of its last impact; -INFINITY: none */
    bool seen;           /* in the present call */
    bool lies;           /* touched and did not approach as an impact at the end of the last call */
    bool observed;       /* at two calls, so that its acceleration is known: */
    double acceleration; /* m/s^2, of the gap in the last step without an impulse */
    double gap_before;   /* m: at the end of the last call */
    double lag;          /* s: how old its rates are for the way that the gap then went */
    double had;          /* m/s: approach then, if it lay above the touch */
    bool rests;          /* was slow then as well */
};

/* An impulse of an episode that is to be applied. */
struct entry {
    double time;       /* s: where it belongs */
    double play;       /* s: when it is applied */
    double start, end; /* of its sub-impact */
    size_t contact;
    double impulse;       /* along the normal */
    double tangential[3]; /* world, on a of the episode's contact; zero without friction */
    bool taken_back;      /* was applied, and is not any more */
};

/* An answer that is being played. */
struct episode {
    struct episode *next;
    double time;   /* s: of the impact */
    double window; /* s from then: the fast scale's; the tokens hold at its end */
    bool revocable;
    bool rubs;                      /* has friction */
    bool revoked;                   /* until its successor is known */
    struct percuss_request request; /* delassus is its own or NULL, as it was asked */
    double *delassus, *oblique;     /* the engine's, as of a group */
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
    char catalogue[64];   /* revision that the last impact was answered with; "": none yet */
    size_t pair_count, pair_capacity;
    struct pair *pairs;
    struct episode *episodes;
    double time; /* s: of the last call that ended well; NAN: there was none */
    struct percuss_slow_counts counts;
};

/* Whether the engine sets positions back. */
static inline bool slow_moves(const struct percuss_slow *slow)
{
    return slow->config.move || slow->config.move_vector;
}

/* s: an engine's clock rarely ends on the very bit asked for */
#define SLOW_INSTANT 1e-12

/* Whether a time has come. */
static inline bool slow_has_come(double time, double now)
{
    return time <= now + SLOW_INSTANT;
}

/* INVALID_ARGUMENT, with its name in the text, where one of these pointers is NULL; else OK. */
#define SLOW_NULL(...) slow_null(MISSING(__VA_ARGS__))
enum percuss_result slow_null(struct missing missing);

enum percuss_result slow_no_memory(void);
enum percuss_result slow_fail(enum percuss_result result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
