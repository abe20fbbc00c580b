/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One mesh from its file to the body's, step by step, with all that is known on the way. */
#ifndef PERCUSS_REDUCE_REDUCTION_H
#define PERCUSS_REDUCE_REDUCTION_H

#include "mesh/mesh_check.h"
#include "reduce/modes.h"
#include "reduce/options.h"
#include "reduce/progress.h"
#include "reduce/reduced_body.h"
#include "reduce/sites.h"

struct reduction {
    const struct options *options;
    struct progress progress;
    /* the mesh */
    struct solid_mesh mesh;
    struct surface surface;
    struct mesh_findings findings;
    struct bulk bulk;
    double enclosed;                     /* by the surface, m^3 */
    double good_to;                      /* Hz: eight elements for a shear wave */
    double sites_asked[OPTIONS_MOST][3]; /* m */
    char supports[128];
    /* its vibration */
    struct matrices matrices;
    double *rigid;
    struct modes_task task;
    struct rates rates;
    struct factor_cost factor_cost;
    struct modes_cost cost;
    struct sites_sample sample;
    double statics; /* s that the sites are expected to take */
    struct modes modes;
    struct factor *factor;
    /* results */
    struct mesh_body *body;
    struct sites_report sites;
    struct site_alone alone[OPTIONS_MOST]; /* those asked for, where others are solved for later */
    size_t added;                          /* of these: new in the body's file */
    double modes_seconds, sites_seconds, seconds;
};

/* Everything up to and with the files that were asked for. The report tells the results, the
 * fault the error; reduction_free afterwards in any case. PERCUSS_BAD_REQUEST: an error of the
 * mesh or the options; PERCUSS_INTERNAL without memory. */
enum percuss_status reduction_run(const struct options *options, struct reduction *reduction,
                                  struct fault *fault);

/* Solves for the flexibility at the sites asked for and adds them to options->add_to; the other
 * options are taken from that file. reduction_free afterwards in any case. Errors as above, and a
 * mesh that is not the one that the body was made of. */
enum percuss_status reduction_add_sites(struct options *options, struct reduction *reduction,
                                        struct fault *fault);

void reduction_free(struct reduction *reduction);

#endif
