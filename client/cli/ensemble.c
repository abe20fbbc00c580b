/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss ensemble: no server answers ensembles yet. */

#include "cli.h"

int command_ensemble(int argc, char **argv, struct common *common)
{
    (void)argc, (void)argv, (void)common;
    complain("ensembles are not offered by percuss " PERCUSS_VERSION " yet; nothing was sent");
    return EXIT_USAGE;
}
