/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Writes the body file of a bar whose modes are the built-in rod's or beam's, in millimetres.
 * usage: write_mesh rod|beam MODES FILE */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bodies/made_mesh.h"
#include "mesh/body_file.h"

int main(int argc, char **argv)
{
    struct fault fault = {""};
    if (argc != 4) {
        fprintf(stderr, "usage: write_mesh rod|beam MODES FILE\n");
        return 2;
    }
    struct body bar = {.id = "bar",
                       .kind = strcmp(argv[1], "rod") == 0 ? &rod_kind : &beam_kind,
                       .radius = 0.01,
                       .length = 1.0,
                       .tip_radius = INFINITY,
                       .material = {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0}};
    struct made_mesh wanted = {
        .bar = &bar, .modes = strtoul(argv[2], NULL, 10), .removed = 12, .around = 16, .along = 40};
    struct mesh_body *body = body_complete(&bar, &fault) ? NULL : made_mesh_bar(&wanted);
    if (body) {
        body->unit = 1e-3;
        /* the frame of the mesh begins at the left end */
        body->centre[0] = 0.5;
    }
    if (!body || body_file_write(argv[3], body, &fault)) {
        fprintf(stderr, "write_mesh: %s\n", fault.text);
        return 1;
    }
    mesh_body_free(body);
    return 0;
}
