/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/program.h"

#include <stdio.h>
#include <stdlib.h>

#include "reduce/report.h"

int program_run(int argc, char **argv)
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
