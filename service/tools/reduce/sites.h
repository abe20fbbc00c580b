/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The regular flexibility everywhere on a body's surface, and between places, for several contacts:
 * solved for at sites and interpolated. */
#ifndef PERCUSS_REDUCE_SITES_H
#define PERCUSS_REDUCE_SITES_H

#include "base/watch.h"
#include "model/mesh_body.h"
#include "reduce/flexibility.h"

/* All borrowed. */
struct sites_task {
    struct flexibility_body body; /* its surface fitted (surface_fit) */
    double spacing;               /* m between sites; 0: 1.4 edges of the mesh */
    size_t most;                  /* sites at most; spacing grows instead */
    double cut;                   /* m, contact radius to state flexibilities for; 0: a tenth of an
                                   * edge of the mesh */
    size_t exact_count;
    const double (*exact)[3];  /* m, the mesh's frame: a site at each, where the surface is plane;
                                * within a sixth of a face from it where it is not */
    bool between;              /* wanted */
    size_t processes;          /* that solve, see forked.h; 0: one */
    const struct watch *watch; /* told the part done; NULL: no watch */
};

/* How it went, for people. Errors are of leaving a site out: its own value less that interpolated
 * from its neighbours; the interpolation between all sites is better. */
struct sites_report {
    size_t count;         /* sites */
    size_t unknown;       /* of these, where nothing could be said: the body comes back within a
                           * face's size over the surface, the mesh's forces do not balance, or */
    size_t thin;          /* the wall is too thin for the mesh (flexibility_place_thin) */
    double thinnest;      /* wall that wants finer elements, of 1.5 times it, m; INFINITY: none */
    size_t withdrawn;     /* faces that are left without a flexibility (site_faces_check) */
    size_t removed;       /* modes */
    double spacing;       /* reached, m */
    double usual_error;   /* root of the mean square, m/N, of sites a spacing off the edges */
    double largest_error; /* of all, m/N */
    double imbalance;     /* largest, of the forces, over the force */
    double asymmetry;     /* largest difference of two responses that ought to be one, m/N */
};

/* Before there is a factor or a mode. */
struct sites_sample {
    size_t count;   /* sites that there will be */
    double seconds; /* for the integrals of one, the mean of a few */
    double faces;   /* s for the interpolation between all of them, by one process */
};

/* The task's body needs neither factor nor modes. PERCUSS_INTERNAL without memory. */
enum percuss_status sites_sample(const struct sites_task *task, struct sites_sample *sample,
                                 struct fault *fault);

/* The body's modes are removed as far as that makes the flexibility smoother: they have peaks and
 * nodes of their own, which sites catch less the higher they are. The error at an omitted site,
 * interpolated from its neighbours, decides how many, at most as many as the task's body says.
 *
 * Fills of `body`: faces' flexibility and flexibility_slope, cut, removed, sites and between. Its
 * faces, those of the surface in their order, and its centre are there. PERCUSS_TIMEOUT: the watch
 * stopped it; PERCUSS_INTERNAL without memory. */
enum percuss_status sites_find(const struct sites_task *task, struct mesh_body *body,
                               struct sites_report *report, struct fault *fault);

/* A site that was solved for by itself. */
struct site_alone {
    struct mesh_body_site site; /* point: the surface's nearest to the one asked for */
    double aside;               /* the place that was solved for is so far from there, off the rim
                                 * of its face on curved ground, m */
    const char *unknown;        /* the reason why the mesh cannot say it; NULL: it is known */
};

/* The flexibility at the task's exact places alone, one for each, without the first `removed` modes
 * of `body`, whose own shapes are taken for them: the task's body needs a factor and rigid motions,
 * but no modes. Errors as below. */
enum percuss_status sites_solve_alone(const struct sites_task *task, const struct mesh_body *body,
                                      struct site_alone *alone, struct fault *fault);

/* Makes `body` one whose flexibility is solved for later: it is unknown on all faces, and goes
 * without the first `removed` modes. Its faces are those of the surface in their order. */
void sites_leave(const struct flexibility_body *from, size_t removed, struct mesh_body *body);

#endif
