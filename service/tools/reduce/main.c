/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-reduce: makes a body for the catalogue from a mesh. */
#include <argp.h>

#include "reduce/program.h"

const char *argp_program_version = "percuss-reduce " PERCUSS_VERSION;

int main(int argc, char **argv)
{
    return program_run(argc, argv);
}
