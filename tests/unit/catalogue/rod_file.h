/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A folder with the file of a body, that of the same one with a mass on a node, and nothing else.
 */
#ifndef PERCUSS_TEST_ROD_FILE_H
#define PERCUSS_TEST_ROD_FILE_H

#include <stdio.h>
#include <unistd.h>

#include "bodies/made_mesh.h"
#include "check.h"
#include "mesh/body_file.h"

static char rod_folder[64];

/* A rod's file in millimetres, whose frame has its origin at the left end. */
static inline int rod_file_make(void **state)
{
    (void)state;
    struct body rod = {.id = "rod",
                       .kind = &rod_kind,
                       .radius = 0.01,
                       .length = 0.3,
                       .tip_radius = INFINITY,
                       .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0}};
    struct fault fault = {""};
    char path[96];
    snprintf(rod_folder, sizeof rod_folder, "/tmp/test_mesh_entry_%d", (int)getpid());
    snprintf(path, sizeof path, "mkdir -p %s", rod_folder);
    if (system(path) || body_complete(&rod, &fault))
        return -1;
    struct mesh_body *body = made_mesh_bar(
        &(struct made_mesh){.bar = &rod, .modes = 8, .removed = 4, .around = 16, .along = 12});
    if (!body)
        return -1;
    body->unit = 1e-3;
    body->centre[0] = 0.15;
    snprintf(path, sizeof path, "%s/rod.h5", rod_folder);
    int failed = body_file_write(path, body, &fault);
    body->mass += 0.1;
    snprintf(path, sizeof path, "%s/massive.h5", rod_folder);
    failed = failed || body_file_write(path, body, &fault);
    mesh_body_free(body);
    return failed;
}

static inline int rod_file_remove(void **state)
{
    (void)state;
    char path[96];
    snprintf(path, sizeof path, "%s/rod.h5", rod_folder);
    remove(path);
    snprintf(path, sizeof path, "%s/massive.h5", rod_folder);
    remove(path);
    return rmdir(rod_folder);
}

#endif
