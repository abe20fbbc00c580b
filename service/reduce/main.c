/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-reduce: makes a body for the catalogue from a mesh. */
#include "reduce/program.h"

int main(int argc, char **argv)
{
    return program_run(argc, argv);
}
