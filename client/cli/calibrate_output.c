/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <jansson.h>
#include <math.h>
#include <stdio.h>

#include "calibrate.h"
#include "cli.h"
#include "json_writer.h"
#include "measured_file.h"

/* Parameters more alike than this can stand in for each other. */
static const double ALIKE = 0.95;
/* Some second sub-impacts are always near a jump; more than this share tell of another fault. */
static const double MANY = 0.5;

static void name_parameter(const struct calibrate_parameter *parameter, char name[128])
{
    snprintf(name, 128, "%s of %s", percuss_parameter_name(parameter->parameter), parameter->body);
}

void calibrate_print_table(const struct calibrate_report *report)
{
    const struct calibration *calibration = report->calibration;
    char name[128];
    /* the values, and how well they are determined */
    printf("%-36s %12s %12s   %-28s\n", "parameter", "start", "value", "95 % interval");
    for (size_t i = 0; i < report->count; i++) {
        const struct calibrate_parameter *parameter = &report->parameters[i];
        name_parameter(parameter, name);
        printf("%-36s %12.6g %12.6g   ", name, parameter->start, parameter->value);
        if (isinf(parameter->half_width))
            puts("unbounded");
        else
            printf("%.6g to %.6g (+- %.2g %%)%s\n", parameter->value - parameter->half_width,
                   parameter->value + parameter->half_width,
                   100.0 * parameter->half_width / fabs(parameter->value),
                   fitting_determines(parameter) ? "" : " not determined");
    }
    /* the readings that they rest on */
    printf("\nfitted to %zu impacts:\n", report->impacts);
    for (int q = 0; q < QUANTITIES; q++)
        if (calibration->known[q] > 0)
            printf("  %-34s %4zu of %zu readings used, scatter %.2g %%\n", quantity_name(q),
                   calibration->used[q], calibration->known[q], 100.0 * calibration->noise[q]);
}

static json_t *quantities_to_json(const struct calibration *calibration)
{
    json_t *array = json_array();
    for (int q = 0; q < QUANTITIES; q++) {
        json_t *object = json_object();
        json_object_set_new(object, "quantity", json_string(quantity_name(q)));
        json_object_set_new(object, "known", json_integer((json_int_t)calibration->known[q]));
        json_object_set_new(object, "used", json_integer((json_int_t)calibration->used[q]));
        json_object_set_new(object, "scatter", json_number(calibration->noise[q]));
        json_array_append_new(array, object);
    }
    return array;
}

void calibrate_print_json(const struct calibrate_report *report)
{
    const struct fit *fit = &report->calibration->fit;
    json_t *root = json_object(), *array = json_array(), *correlation = json_array();
    /* parameter by parameter, with its row of correlations */
    for (size_t i = 0; i < report->count; i++) {
        const struct calibrate_parameter *parameter = &report->parameters[i];
        json_t *object = json_object(), *row = json_array();
        json_object_set_new(object, "parameter",
                            json_string(percuss_parameter_name(parameter->parameter)));
        json_object_set_new(object, "body", json_string(parameter->body));
        json_object_set_new(object, "start", json_number(parameter->start));
        json_object_set_new(object, "value", json_number(parameter->value));
        json_object_set_new(object, "low", json_number(parameter->value - parameter->half_width));
        json_object_set_new(object, "high", json_number(parameter->value + parameter->half_width));
        json_object_set_new(object, "determined", json_boolean(fitting_determines(parameter)));
        json_array_append_new(array, object);
        for (size_t j = 0; j < report->count; j++)
            json_array_append_new(row, json_number(fit->correlation[i][j]));
        json_array_append_new(correlation, row);
    }
    /* with the readings that they rest on */
    json_object_set_new(root, "parameters", array);
    json_object_set_new(root, "correlation", correlation);
    json_object_set_new(root, "quantities", quantities_to_json(report->calibration));
    json_object_set_new(root, "impacts", json_integer((json_int_t)report->impacts));
    json_object_set_new(root, "freedom", json_number(fit->freedom));
    json_object_set_new(root, "left_out", measured_file_left_to_json(report->set));
    json_object_set_new(root, "warnings", tally_to_json(report->warnings));
    json_print(root);
}

bool calibrate_warn(const struct calibrate_report *report)
{
    const struct calibration *calibration = report->calibration;
    char name[128], other[128];
    bool warned = false;
    /* parameters that cannot be told, or not from each other */
    for (size_t i = 0; i < report->count; i++) {
        name_parameter(&report->parameters[i], name);
        if (!fitting_determines(&report->parameters[i])) {
            complain("these data do not determine the %s: leave it at a known value", name);
            warned = true;
        }
        for (size_t j = 0; j < i; j++) {
            if (!(fabs(calibration->fit.correlation[i][j]) > ALIKE))
                continue;
            name_parameter(&report->parameters[j], other);
            complain("these data hardly tell the %s from the %s (correlation %.3f): fit one only",
                     name, other, calibration->fit.correlation[i][j]);
            warned = true;
        }
    }
    /* quantities of which most readings were of no use */
    for (int q = 0; q < QUANTITIES; q++) {
        size_t left = calibration->known[q] - calibration->used[q];
        if ((double)left <= MANY * (double)calibration->known[q])
            continue;
        complain("%s: %zu of %zu readings are no smooth function of the parameters, or off by more "
                 "than four standard deviations, and were left out",
                 quantity_name(q), left, calibration->known[q]);
        warned = true;
    }
    return warned;
}
