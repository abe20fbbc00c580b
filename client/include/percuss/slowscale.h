/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The slow scale of a co-simulation: tells a multibody engine when an impact is due, asks a service
 * for its outcome, and applies the answer. It knows the engine by three callbacks and the service
 * by one (slow_link.h has it for percussd). docs/integrating.md is the way through.
 *
 * After every accepted step the engine hands over all pairs that are near each other. A pair that
 * overlaps and approaches is due; with everything it is coupled to it becomes one question. While
 * the answer's sub-impacts are played, bodies may overlap by some tenths of a millimetre: the pair
 * is latched until its last one and armed again, at that very moment or later, once its gap is open
 * or it does not approach; and at the end of the answer's window in any case. Which body of a pair
 * is called a may differ from call to call. No globals; one thread at a time for each object.
 *
 * A pointer may be NULL only where it is said so, or as an array of no elements. Otherwise NULL is
 * INVALID_ARGUMENT; a function without a result returns false, INFINITY or zeros then, and
 * percuss_slow_error_text names the argument. */
#ifndef PERCUSS_SLOWSCALE_H
#define PERCUSS_SLOWSCALE_H

#include <percuss/slow_engine.h>

enum percuss_slow_application {
    PERCUSS_SLOW_LIST, /* each sub-impact at its time; those to come can be revoked */
    PERCUSS_SLOW_TOTAL /* the whole impulse at the start */
};

/* The treatment of an impact; borrowed for the time of the call. */
struct percuss_slow_report {
    double time;
    size_t count; /* contacts of the group */
    const struct percuss_slow_contact *contacts;
    const double *gap_rate, *delassus, *impulse, *restitution; /* restitution NAN: no compression */
    const struct percuss_reply *reply; /* NULL: the declared restitution was used */
    const char *message;               /* the reason, and other notes to the user; "": none */
    uint64_t declared; /* impacts with the declared restitution so far, this one included */
};

struct percuss_slow_body {
    const char *id; /* in the service's catalogue */
    bool fixed;     /* holds still in any impact: does not couple the impacts on it */
    bool free; /* no joint holds it, and its inertia is the catalogue's: allows friction without
                  `oblique`, see below */
};

/* Friction: the whole impulse vector of the answer acts at the contact's point. An impact has
 * friction where the engine gives `apply_vector` or `push`, options.friction is not `none`, and
 * the service can know how the bodies move along the surface: by the engine's `oblique`, of up to
 * PERCUSS_MAX_CONTACTS_OBLIQUE contacts; or else by the catalogue, where all of the bodies are
 * `free` or `fixed`: the question then has no matrix. Other impacts are asked about with the matrix
 * of their normals and with options.friction `none`; a contact of theirs that states a coefficient
 * is refused by name, unless options.friction is `none`. The declared restitution has no friction.
 */

struct percuss_slow_config {
    size_t body_count;
    const struct percuss_slow_body *bodies; /* copied */
    struct percuss_slow_engine engine;
    struct percuss_slow_service service;
    struct percuss_options options;
    enum percuss_slow_application application;
    double restitution; /* declared, 0..1: used without a service, or by fall_back */
    double rest_speed;  /* m/s; slower approaches are no impacts: the engine's own contact holds
                           them. 0: the speed that a pair that lay together gains by the acceleration
                           pressing it (its gap acceleration; earth's gravity if that is 0) in one
                           step of the engine */
    double group_gap;   /* m; a coupled pair this near joins an impact */
    void (*report)(void *context, const struct percuss_slow_report *report); /* may be NULL */
    void *report_context;
    /* Where no answer comes, or the question is refused, the declared restitution is used, reported
     * and counted: results then depend on whether the service could be had in time. false: such an
     * impact is an error of percuss_slow_advance. */
    bool fall_back;
    /* With the engine's context: changes the positions by M^-1 w moment, as `apply` does the
     * velocities; moment in N s^2: an impulse times how late it is applied, < 0 if early. The
     * impulses of ringing bodies often lie before the instant of the question, and a step may end
     * behind one. NULL: they are applied late without it, which takes energy, and TOTAL is refused
     * where the gap accelerates; touches within a step are taken as at its end. False: failure, as
     * of the engine's callbacks. */
    bool (*move)(void *context, const struct percuss_slow_contact *contact, double moment);
    /* Beside `move`, or instead: as `apply_vector` is to `apply`. Without it, positions along the
     * surface lack what friction did between an impulse's time and the one when it is applied. */
    bool (*move_vector)(void *context, const struct percuss_slow_contact *contact,
                        const double moment[3]);
    /* s: how long before the state's time the engine's velocities hold. With steps of fixed size h:
     * h / 2 where a step moves the positions by the velocities of its end (symplectic Euler), -h /
     * 2 where by those of its start; 0: they hold at the state's time. */
    double velocity_lag;
};

#ifdef __cplusplus
extern "C" {
#endif

/* LIST, declared restitution 0.5, rest_speed derived (0), group_gap 10 um, no fall_back, the rest
 * empty. */
PERCUSS_API struct percuss_slow_config percuss_slow_config_default(void);

struct percuss_slow;

/* The caller frees it. INVALID_ARGUMENT and NO_MEMORY leave *slow NULL. */
PERCUSS_API enum percuss_result percuss_slow_create(const struct percuss_slow_config *config,
                                                    struct percuss_slow **slow);
PERCUSS_API void percuss_slow_free(struct percuss_slow *slow); /* NULL is allowed */

/* Whether an impact is due among these contacts, all those near touching at a trial state: for
 * event location. Changes nothing and asks no service. */
PERCUSS_API bool percuss_slow_due(const struct percuss_slow *slow, size_t count,
                                  const struct percuss_slow_contact *contacts);

/* Time of the next sub-impact to be played: let the step end there. INFINITY: none. */
PERCUSS_API double percuss_slow_next(const struct percuss_slow *slow);

/* To be called at every accepted state, with all contacts near touching: plays the sub-impacts that
 * are due, then solves the impacts that are due. Velocities may have changed afterwards. With
 * `move` a pair that overlaps is asked about as it was when it touched, up to one step ago: by its
 * gap, gap rate and gap acceleration; velocities and positions are then those after that impact.
 * Without fall_back, an impact that has no answer is an error: NO_SERVER, TIMEOUT or another result
 * of the service, INVALID_ARGUMENT for a question that it refuses. The impact then has not happened
 * and nothing is lost: call again at the same state, or later, and it is asked about again.
 * INVALID_ARGUMENT, NO_MEMORY otherwise: see percuss_slow_error_text. */
PERCUSS_API enum percuss_result percuss_slow_advance(struct percuss_slow *slow, size_t count,
                                                     const struct percuss_slow_contact *contacts);

/* Whether the pair lay together at the last advance, slower than rest_speed: a permanent contact,
 * which the engine's own contact has to carry. */
PERCUSS_API bool percuss_slow_rests(const struct percuss_slow *slow, uint32_t a, uint32_t b,
                                    uint32_t feature);

struct percuss_slow_counts {
    uint64_t impacts;   /* groups solved */
    uint64_t requests;  /* questions put; one an impact, unless one of the next two */
    uint64_t repeated;  /* questions put again: state unknown, horizon too short */
    uint64_t preempted; /* questions put again up to the moment when another body hit: for the
                           vibration then */
    uint64_t declared;  /* impacts solved with the declared restitution */
};
/* The work done since percuss_slow_create. */
PERCUSS_API struct percuss_slow_counts percuss_slow_counts(const struct percuss_slow *slow);

/* The error of the thread's last call that did not return OK, or was given a NULL. */
PERCUSS_API const char *percuss_slow_error_text(void);

#ifdef __cplusplus
}
#endif

#endif
