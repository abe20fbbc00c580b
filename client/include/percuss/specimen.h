/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Specimens: bodies with dents that a server keeps on disk, as on a rig. */
#ifndef PERCUSS_SPECIMEN_H
#define PERCUSS_SPECIMEN_H

#include <percuss/request.h>

/* A patch of the surface that yielded. */
struct percuss_dent {
    double point[3];             /* its middle, body frame, m */
    double size;                 /* radius of the patch, m */
    double max_indentation;      /* m */
    double max_force;            /* N */
    double residual_indentation; /* depth that stays, m */
    double contact_radius;       /* at the largest force, m */
};

struct percuss_specimen {
    char name[PERCUSS_ID_SIZE], body[PERCUSS_ID_SIZE];
    uint64_t impacts; /* counted on it */
    size_t dent_count;
    struct percuss_dent *dents;
};

struct percuss_specimen_list {
    size_t count;
    struct percuss_specimen *specimens; /* sorted by name */
};

struct percuss_client;

#ifdef __cplusplus
extern "C" {
#endif

/* The specimens of the connected server, for percuss_specimen_list_free. */
PERCUSS_API enum percuss_result percuss_specimens(struct percuss_client *client, double timeout,
                                                  struct percuss_specimen_list *list);

/* Has the connected server forget a specimen, its dents and which body it is, and waits until it
 * has; replies to its requests stay. INVALID_ARGUMENT: it keeps none of that name. */
PERCUSS_API enum percuss_result percuss_clear_specimen(struct percuss_client *client,
                                                       const char *name, double timeout);

/* Releases the list of percuss_specimens; NULL and empty lists are allowed. */
PERCUSS_API void percuss_specimen_list_free(struct percuss_specimen_list *list);

#ifdef __cplusplus
}
#endif

#endif
