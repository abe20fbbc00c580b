/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One contact on the steps of its contact phase whose force may depend on its way: a law that
 * remembers (impact/memory_step.h), one that has the rate of the approach in it, or one of the
 * indentation alone beside such. The force at a point of a step, a node or its end, depends on the
 * indentations at all of them.
 *
 * The rate is that of the bodies' approach, which is d and the series compliance under the forces:
 * that of d alone would not be defined by the present state, and with a negative compliance would
 * grow without bounds. */
#ifndef PERCUSS_IMPACT_WAY_CONTACT_H
#define PERCUSS_IMPACT_WAY_CONTACT_H

#include "base/arena.h"
#include "impact/memory_step.h"

enum { WAY_PLACES = STEP_POINTS + 1 }; /* start, nodes, end of a step */

/* Slopes at the points of a step of the polynomial through all places, for a step of length 1:
 * under a cubic force a body moves along one of the fifth degree. */
struct way_slopes {
    double by[STEP_POINTS][WAY_PLACES];
};

struct way_contact {
    const struct contact_law *law;
    struct memory_step *memory; /* of a law that remembers, else NULL */
    double compliance;          /* its own, in series, m/N */
    double approach;            /* of the bodies, where the step begins, m */
    double own_approach;        /* d + compliance F there */
    double indentation[STEP_POINTS], force[STEP_POINTS];
    double slope[STEP_POINTS][STEP_POINTS]; /* of the law's forces by all indentations, N/m */
    double viscosity[STEP_POINTS];          /* and by the approach's rates there, N s/m */
    bool parted;                            /* no force since, */
    double touched_at, parted_at;           /* the first force, and the end of the last one, s */
    double largest;                         /* force since the touch, N */
    double work;                            /* of all forces on d + compliance F, J */
};

/* False: out of memory. */
bool way_contact_create(struct way_contact *contact, const struct contact_law *law,
                        double compliance, struct arena *arena);

/* Makes sure of a level. False: out of memory. */
bool way_contact_prepare(struct way_contact *contact, int level, struct arena *arena);

/* A contact phase begins, with an approach without force: 0 of a contact that touches. */
void way_contact_begin(struct way_contact *contact, double time, double approach, bool touches);

/* A sub-impact begins. */
void way_contact_touch(struct way_contact *contact, double time);

/* A step of a prepared level, without a turn yet. */
void way_contact_start(struct way_contact *contact, int level);

/* The law's forces at the points for the contact's indentations and these rates of the approach,
 * m/s, with their slopes. */
void way_contact_forces(struct way_contact *contact, const double rate[STEP_POINTS],
                        double force[STEP_POINTS]);

/* Finds where the contact turns from growing to shrinking, for its indentations. False: nowhere,
 * now and before. */
bool way_contact_turns(struct way_contact *contact);

/* Whether the step just solved has a kink that the next one should begin with. */
bool way_contact_bends(const struct way_contact *contact);

/* Accepts the step just solved, which began at `time`; the approach at its end. */
void way_contact_take(struct way_contact *contact, const struct way_slopes *slopes, int level,
                      double time, double approach);

/* What the contact has taken of the work so far, less what it gives back at an indentation under a
 * force, J. */
double way_contact_lost(const struct way_contact *contact, double indentation, double force);

#endif
