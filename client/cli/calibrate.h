/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a calibration found. */
#ifndef PERCUSS_CLI_CALIBRATE_H
#define PERCUSS_CLI_CALIBRATE_H

#include <percuss/percuss.h>

#include "fitting.h"
#include "tally_output.h"

struct calibrate_report {
    const struct calibrate_parameter *parameters;
    size_t count;
    const struct calibration *calibration;
    size_t impacts;
    const struct tally *warnings; /* of the twins with the calibrated values */
    const struct measured_set *set;
};

void calibrate_print_table(const struct calibrate_report *report);
void calibrate_print_json(const struct calibrate_report *report);

/* Says on stderr what the data do not determine; returns whether there is anything to say. */
bool calibrate_warn(const struct calibrate_report *report);

#endif
