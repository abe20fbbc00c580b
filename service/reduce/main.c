/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* percuss-reduce: makes a body for the catalogue from a mesh. */
#include <stdio.h>
#include <stdlib.h>

#include "reduce/report.h"

int main(int argc, char **argv)
{
    struct options options = options_read(argc, argv);
    struct reduction reduction;
    struct fault fault = {""};
    enum percuss_status status = reduction_run(&options, &reduction, &fault);
    if (!status && options.json)
        report_json(&reduction);
    else if (!status)
        report_text(&reduction);
    reduction_free(&reduction);
    if (!status)
        return EXIT_SUCCESS;
    fprintf(stderr, "percuss-reduce: %s\n", fault.text);
    return EXIT_FAILURE;
}
