/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Contact models: the law that each contact follows, the dents of earlier impacts under it, and the
 * matched compliance in series with the law, so that law, modes and residual flexibility together
 * are the real bodies' static compliance (fe/matched.h). */
#ifndef PERCUSS_SOLVE_CONTACT_MODEL_H
#define PERCUSS_SOLVE_CONTACT_MODEL_H

#include "base/text.h"
#include "contact/family.h"
#include "impact/impact.h"
#include "model/relaxation.h"
#include "solve/problem.h"

/* The law of a contact with what its materials lose. */
struct contact_loss {
    struct contact_law law;       /* in place of Hertz's */
    struct relaxation relaxation; /* of both bodies */
    double frequency;             /* the contact's, Hz */
    double loss_factor;           /* of both, there */
};

/* One contact. */
struct contact_choice {
    struct contact_law plastic; /* the law that yields; Hertz where neither body can */
    double yield;               /* indentation at which Hertz ends, m; INFINITY: never */
    int side;                   /* of the body that yields: 0: a, 1: b; -1: neither */
    size_t dent;                /* index in that body's state of the dent that the law remembers */
    bool yields;                /* it is likely to, or did in a solution */
    bool dented, tabulated;
    bool family;               /* the table is one of the family's */
    bool both;                 /* ... where both bodies flow */
    double outside;            /* ... and this far outside its axes */
    const struct own_law *own; /* the catalogue's law, which is `plastic` then; NULL: none */
    struct contact_loss *loss; /* what the materials lose; NULL: nothing is stated, or it cannot be
                                  in the law */
    struct contact_law compared; /* the family's law, where the closed form is used; or without
                                    operations: there is none */
};

/* Finds the laws that the request asks for, the likely ones where it leaves the choice, and makes
 * them the problem's. `tables` may be NULL. PERCUSS_OK, BAD_REQUEST (a table or a law of the
 * catalogue is asked for that does not exist), INTERNAL. */
enum percuss_status contact_model_choose(struct problem *problem, const struct body_set *catalogue,
                                         const struct contact_table_source *tables,
                                         struct fault *fault);

/* Looks at a solution: true: other laws are in order (Hertz exceeded yield, a law that yields was
 * not needed) and are now the problem's. At most once. */
bool contact_model_revise(struct problem *problem, const struct impact_outcome *outcome);

/* The law that the reply names for all contacts. */
const struct contact_law_operations *contact_model_used(const struct problem *problem);

/* Whether a contact deepened its history: it yielded in this impact. */
bool contact_model_yielded(const struct problem *problem, const struct impact_outcome *outcome,
                           size_t contact);

/* How far beyond the end of its table a contact went, over that end; 0: not at all, or no table. */
double contact_model_beyond_table(const struct impact_outcome *outcome, size_t contact);

/* Writes the reason for the law, and its approximations. */
void contact_model_explain(const struct problem *problem, const struct impact_outcome *outcome,
                           struct text *text);

/* The request's choice, or `otherwise` where it makes none: matched where every contact has it.
 * Without being asked for, contacts of bodies that do not vibrate stay Hertz's: no basis there
 * holds anything twice. PERCUSS_OK or PERCUSS_INTERNAL. */
enum percuss_status compliance_choose(struct problem *problem, enum percuss_compliance otherwise,
                                      struct fault *fault);

/* Contact radius (m) of a collision of the rigid masses at the fastest approach: corrections depend
 * on its logarithm at most. */
double contact_patch_radius(const struct problem *problem, size_t c);

/* Looks at a solution: true: the series compliance (residual flexibility included) is too negative
 * for the law's stiffness, |C| dF/dd >= 0.5: half-spaces are still now or, where they were, all
 * contacts' compliance is the half-space's. They are still too where the effort was spent on
 * contacts that share their waves: each by itself takes far less. */
bool compliance_revise(struct problem *problem, const struct scene *scene,
                       const struct impact_outcome *outcome);

#endif
