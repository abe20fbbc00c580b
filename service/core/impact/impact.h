/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The fast time scale of one impact: contact phases and flights until vibration can cause no
 * further contact. */
#ifndef PERCUSS_IMPACT_IMPACT_H
#define PERCUSS_IMPACT_IMPACT_H

#include "base/watch.h"
#include "impact/force_log.h"
#include "impact/motion.h"
#include "impact/result.h"
#include "impact/track.h"

/* Care that a solution needs for its accuracy. */
enum step_profile {
    /* later sub-impacts amplify the step errors of the first ones */
    STEP_PROFILE_SEQUENCE,
    /* a sequence for comparison with another: contacts begin and end by short steps, not by
     * projected moments (step_ends.h), so that the two do not miss the same sub-impact */
    STEP_PROFILE_COMPARED,
    /* one impact: nothing later is amplified */
    STEP_PROFILE_SINGLE,
    /* only estimates another solution's error */
    STEP_PROFILE_ROUGH,
    STEP_PROFILES
};

struct impact_settings {
    double accuracy; /* relative error of an impulse that the time steps may cause */
    double horizon;  /* s from the stated instant */
    double max_work; /* contact steps and flight intervals, times modes + 8 contacts (contacts that
                        each feels)^2 + 2 contacts^2 + 6 contacts */
    struct force_log *log; /* records the contact forces; NULL: none. Only impact_modal */
    struct pace *pace;     /* NULL: nothing stops it; otherwise the status may be PERCUSS_TIMEOUT */
    enum step_profile profile; /* of impact_modal's steps */
};

/* Everything here lives in the arena given to impact_create. */
struct impact_outcome {
    enum percuss_end_reason end_reason;
    double window;            /* s: the end of the fast scale */
    bool always_overlapped;   /* no touch before an overlap: nothing was solved */
    bool beyond_horizon;      /* ... within the horizon, which ended the search */
    bool too_stiff;           /* a law became too stiff for its series compliance: cut off */
    double time_shift;        /* the touch before (< 0) or after the stated instant, s */
    struct track *tracks;     /* [contact] */
    struct contact_law *laws; /* [contact], with their final histories */
    double plastic;           /* dissipated by yielding, J */
    double relaxed;           /* lost by a lossy law, J */
    double slid, sheared;     /* lost by friction, and stored in it at the end, J */
    struct impact_energy energy;
    double *vibration;         /* [body], J, at the end */
    struct motion motion;      /* at the end; gaps count to the bottoms of the dents */
    struct scene_group *group; /* [groups], of the scene that was solved */
    size_t groups;
    unsigned long steps; /* contact steps accepted */
    unsigned long rejected;
    unsigned long effort; /* of all that, in steps; failures to converge count as several */
};

/* Memory for outcomes of a scene (and of scenes with fewer oscillators). */
bool impact_create(struct impact_outcome *outcome, const struct scene *scene, struct arena *arena);

/* Begins a solution: no sub-impacts yet, the laws as the scene states them. */
void impact_begin(struct impact_outcome *outcome, const struct scene *scene);

/* Solves by exact modal propagation. `arena` holds scratch memory until its next reset. PERCUSS_OK,
 * PERCUSS_INTERNAL when memory runs out, or PERCUSS_TIMEOUT where settings->pace stopped it: the
 * outcome is then undefined. */
enum percuss_status impact_modal(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome);

/* Whether a scene is one elastic contact without modes, acceleration and residual flexibility. */
bool impact_is_rigid_pair(const struct scene *scene);

/* Solves such a scene in closed form (by impact_modal if the horizon cuts it). */
enum percuss_status impact_rigid_pair(const struct scene *scene,
                                      const struct impact_settings *settings, struct arena *arena,
                                      struct impact_outcome *outcome);

/* The same by CVODE with root finding: the independent reference. */
enum percuss_status impact_cvode(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome);

/* Number of steps and intervals of the allowed work on a scene. */
unsigned long impact_max_steps(const struct scene *scene, const struct impact_settings *settings);

/* The work that a solution took, in the same unit. */
double impact_work(const struct scene *scene, const struct impact_outcome *outcome);

#endif
