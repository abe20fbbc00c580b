/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* <percuss/measured.h>: parameters of bodies from measured impacts. */
#include <math.h>
#include <percuss/measured.h>
#include <stdio.h>
#include <string.h>

#include "fitting.h"
#include "report.h"

_Static_assert((int)PERCUSS_MAX_FITTED == (int)FIT_PARAMETERS, "as many as the fit takes");
_Static_assert((int)PERCUSS_FITTED_QUANTITIES == (int)QUANTITIES, "what is fitted");

static enum percuss_result check_parameter(const struct percuss_pair *pair,
                                           const struct percuss_calibration *calibration, size_t i)
{
    const struct percuss_fitted *one = &calibration->parameters[i];
    const int size = PERCUSS_ID_SIZE - 1;
    if ((unsigned)one->parameter >= PERCUSS_PARAMETER_COUNT)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                          "parameters[%zu].parameter: %d: below %d is allowed", i,
                          (int)one->parameter, (int)PERCUSS_PARAMETER_COUNT);
    if (strncmp(one->body, pair->a->id, PERCUSS_ID_SIZE) &&
        strncmp(one->body, pair->b->id, PERCUSS_ID_SIZE))
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                          "parameters[%zu].body: '%.*s': %s or %s is allowed", i, size, one->body,
                          pair->a->id, pair->b->id);
    for (size_t k = 0; k < i; k++)
        if (calibration->parameters[k].parameter == one->parameter &&
            !strcmp(calibration->parameters[k].body, one->body))
            return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                              "parameters[%zu]: %s of %s: is parameters[%zu] already", i,
                              percuss_parameter_name(one->parameter), one->body, k);
    return PERCUSS_RESULT_OK;
}

static enum percuss_result percuss_calibrate_check(const struct percuss_pair *pair,
                                                   const struct percuss_calibration *calibration)
{
    size_t count = calibration->parameter_count;
    if (count < 1 || count > PERCUSS_MAX_FITTED)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "parameters: %zu: 1..%d are allowed",
                          count, (int)PERCUSS_MAX_FITTED);
    enum percuss_result result = PERCUSS_RESULT_OK;
    for (size_t i = 0; result == PERCUSS_RESULT_OK && i < count; i++)
        result = check_parameter(pair, calibration, i);
    return result;
}

static enum percuss_result start(struct fitting *fitting)
{
    size_t which;
    enum fitting_lack lack = fitting_start(fitting, &which);
    if (lack == FITTING_LACKS_NOTHING)
        return PERCUSS_RESULT_OK;
    const struct calibrate_parameter *one = &fitting->parameters[which];
    const char *name = percuss_parameter_name(one->parameter);
    if (lack == FITTING_LACKS_PARAMETER)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "parameters[%zu]: %s has no %s", which,
                          one->body, name);
    return report_set(
        PERCUSS_RESULT_INVALID_ARGUMENT,
        "parameters[%zu].start: the catalogue has no %s of %s to start from: a number "
        "is needed",
        which, name, one->body);
}

static enum percuss_result explain(const struct fitting *fitting, const struct calibration *found)
{
    if (fitting->result != PERCUSS_RESULT_OK)
        return report_result(fitting->result);
    size_t used = 0, known = 0;
    for (int q = 0; q < QUANTITIES; q++) {
        used += found->used[q];
        known += found->known[q];
    }
    return report_set(
        PERCUSS_RESULT_INVALID_ARGUMENT,
        "impacts: %zu usable numbers of %zu do not suffice for %zu parameters; used are "
        "first_impulse, first_duration and second_start where they are smooth functions of the "
        "parameters and less than 30 %% off the model: start nearer",
        used, known, fitting->count);
}

static void fill(const struct fitting *fitting, const struct calibration *found,
                 struct percuss_calibration *calibration)
{
    for (size_t i = 0; i < fitting->count; i++) {
        const struct calibrate_parameter *from = &fitting->parameters[i];
        struct percuss_fitted *to = &calibration->parameters[i];
        to->start = from->start;
        to->value = from->value;
        to->low = from->value - from->half_width;
        to->high = from->value + from->half_width;
        to->determined = fitting_determines(from);
        for (size_t j = 0; j < fitting->count; j++)
            calibration->correlation[i][j] = found->fit.correlation[i][j];
    }
    for (int q = 0; q < QUANTITIES; q++) {
        calibration->known[q] = found->known[q];
        calibration->used[q] = found->used[q];
        calibration->scatter[q] = found->noise[q];
    }
    calibration->impacts = fitting->set->count;
    calibration->freedom = found->fit.freedom;
}

static enum percuss_result calibrate(struct report *report, struct percuss_calibration *calibration)
{
    struct calibrate_parameter parameters[FIT_PARAMETERS] = {0};
    struct calibration found;
    struct fitting fitting = {
        .question = &report->question,
        .set = &report->set,
        .parameters = parameters,
        .count = calibration->parameter_count,
        .noise = report->asked->noise,
        .list = report->list,
        .listener = report->listener,
    };
    for (size_t i = 0; i < fitting.count; i++) {
        parameters[i].parameter = calibration->parameters[i].parameter;
        parameters[i].start = calibration->parameters[i].start;
        snprintf(parameters[i].body, sizeof parameters[i].body, "%s",
                 calibration->parameters[i].body);
    }
    enum percuss_result result = start(&fitting);
    if (result == PERCUSS_RESULT_OK && !fitting_solve(&fitting, &found))
        result = explain(&fitting, &found);
    /* warnings are of the twins with the best values */
    if (result == PERCUSS_RESULT_OK)
        result = report_result(fitting_ask(&fitting, found.fit.x, 1.0));
    if (result != PERCUSS_RESULT_OK)
        return result;
    fill(&fitting, &found, calibration);
    calibration->warnings = report_warnings(report);
    calibration->warning_count = calibration->warnings ? report->warnings.count : 0;
    return calibration->warnings ? PERCUSS_RESULT_OK
                                 : report_set(PERCUSS_RESULT_NO_MEMORY, "out of memory: warnings");
}

enum percuss_result percuss_measured_calibrate(const struct percuss_measured *measured,
                                               const struct percuss_measured_question *question,
                                               struct percuss_calibration *calibration)
{
    struct report report;
    if (calibration) {
        calibration->warning_count = 0;
        calibration->warnings = NULL;
    }
    if (REPORT_NULL(measured, question, calibration))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    struct percuss_measured_question fine = *question;
    if (fine.options.tolerance == 0.0)
        fine.options.tolerance = FITTING_TOLERANCE;
    enum percuss_result result = report_check(question);
    if (result == PERCUSS_RESULT_OK)
        result = percuss_calibrate_check(&question->pair, calibration);
    if (result != PERCUSS_RESULT_OK)
        return result;
    result = report_begin(measured, &fine, &report);
    if (result == PERCUSS_RESULT_OK)
        result = calibrate(&report, calibration);
    report_end(&report);
    return result;
}

void percuss_calibration_free(struct percuss_calibration *calibration)
{
    if (!calibration)
        return;
    report_free_warnings(calibration->warning_count, calibration->warnings);
    calibration->warning_count = 0;
    calibration->warnings = NULL;
}
