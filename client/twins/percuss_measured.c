/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* <percuss/measured.h>: impacts, and their comparison with their twins. */
#include <percuss/measured.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "column.h"
#include "differences.h"
#include "report.h"

/* All errors of a file, a line each. */
static enum percuss_result percuss_measured_refuse(const struct measured_remarks *remarks)
{
    char text[REMARKS_KEPT * sizeof remarks->error[0]];
    size_t length = 0, kept = remarks->errors < REMARKS_KEPT ? remarks->errors : REMARKS_KEPT;
    for (size_t i = 0; i < kept; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%s", i ? "\n" : "",
                                   remarks->error[i].text);
    if (remarks->errors > kept && length < sizeof text)
        snprintf(text + length, sizeof text - length, "\nand %zu errors more",
                 remarks->errors - kept);
    return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "%s", text);
}

/* The texts of a member, each taken by `add`. */
static enum percuss_result take_texts(const char *name, size_t count, const char *const *texts,
                                      bool (*add)(struct column_map *map, const char *text,
                                                  struct measured_fault *fault),
                                      struct column_map *map)
{
    struct measured_fault fault;
    if (count > 0 && !texts)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "%s: NULL: a pointer is needed", name);
    for (size_t i = 0; i < count; i++) {
        if (!texts[i])
            return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "%s[%zu]: NULL: a pointer is needed",
                              name, i);
        if (!add(map, texts[i], &fault))
            return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "%s[%zu]: %s", name, i, fault.text);
    }
    return PERCUSS_RESULT_OK;
}

static enum percuss_result take_positive(const char *name, const char *unit, double value,
                                         double *taken)
{
    if (!(value >= 0.0) || isinf(value))
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                          "%s: %g: %s > 0, or 0 where it is not said, is allowed", name, value,
                          unit);
    *taken = value;
    return PERCUSS_RESULT_OK;
}

static enum percuss_result take_map(const struct percuss_measured_file *file,
                                    struct column_map *map)
{
    enum percuss_result result =
        take_texts("columns", file->column_count, file->columns, column_map_add, map);
    if (result == PERCUSS_RESULT_OK)
        result = take_texts("uncertainties", file->uncertainty_count, file->uncertainties,
                            column_map_doubt, map);
    if (result == PERCUSS_RESULT_OK)
        result = take_positive("scale", "m", file->scale, &map->scale);
    if (result == PERCUSS_RESULT_OK)
        result = take_positive("rate", "Hz", file->rate, &map->rate);
    if (result == PERCUSS_RESULT_OK)
        result = take_positive("gravity", "m/s^2", file->gravity, &map->gravity);
    return result;
}

enum percuss_result percuss_measured_read_file(const struct percuss_measured_file *file,
                                               struct percuss_measured **measured)
{
    struct column_map map = {0};
    if (measured)
        *measured = NULL;
    if (REPORT_NULL(file, measured))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    if (!file->file)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "file: NULL: a pointer is needed");
    enum percuss_result result = take_map(file, &map);
    if (result != PERCUSS_RESULT_OK)
        return result;
    struct percuss_measured *made = calloc(1, sizeof *made);
    if (!made)
        return report_set(PERCUSS_RESULT_NO_MEMORY, "out of memory: %s", file->file);
    if (measured_read(file->file, &map, &made->set, &made->remarks)) {
        *measured = made;
        return PERCUSS_RESULT_OK;
    }
    result = percuss_measured_refuse(&made->remarks);
    percuss_measured_free(made);
    return result;
}

enum percuss_result percuss_measured_read(const char *file, size_t column_count,
                                          const char *const *columns,
                                          struct percuss_measured **measured)
{
    const struct percuss_measured_file asked = {
        .file = file, .column_count = column_count, .columns = columns};
    return percuss_measured_read_file(&asked, measured);
}

/* The numbers of an impact, and of which they must be. */
static const struct {
    const char *name, *allowed;
    size_t public_offset, offset;
    double low, high;
} NUMBERS[] = {
#define NUMBER(name, low, high, allowed)                                                           \
    {#name,                                                                                        \
     allowed,                                                                                      \
     offsetof(struct percuss_measured_impact, name),                                               \
     offsetof(struct measured_impact, name),                                                       \
     low,                                                                                          \
     high},
    /* as in files (column.c) */
    NUMBER(speed, 1e-9, 1e6, "m/s > 0")              /**/
    NUMBER(restitution, -1.0, 2.0, "a number -1..2") /**/
    NUMBER(impulse, 0.0, 1e12, "N s >= 0")           /**/
    NUMBER(sub_impacts, 0.0, 1e6, "a count >= 0")    /**/
    NUMBER(first_impulse, 0.0, 1e12, "N s >= 0")     /**/
    NUMBER(first_duration, 0.0, 1e6, "s >= 0")       /**/
    NUMBER(second_start, 0.0, 1e6, "s >= 0")         /**/
    NUMBER(at, 0.0, 1.0, "a fraction 0..1")
#undef NUMBER
};
enum { NUMBER_COUNT = sizeof NUMBERS / sizeof NUMBERS[0] };

/* The interval of a restitution that is stated. */
static enum percuss_result take_interval(size_t index, const struct percuss_measured_impact *given,
                                         struct measured_impact *impact)
{
    const double half = given->restitution_half_width;
    if (half < 0.0 || isinf(half))
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                          "impacts[%zu].restitution_half_width: %g: a number > 0, or 0 or NAN "
                          "where it is not known, is allowed",
                          index, half);
    if (half > 0.0 && isnan(impact->restitution))
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                          "impacts[%zu].restitution_half_width: %g: must be 0 or NAN where the "
                          "restitution is unknown",
                          index, half);
    if (half > 0.0)
        impact->doubt = half / (1.0 + impact->restitution);
    return PERCUSS_RESULT_OK;
}

static enum percuss_result take(size_t index, const struct percuss_measured_impact *given,
                                struct measured_impact *impact, struct measured_remarks *remarks)
{
    *impact = measured_impact_unknown();
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        double value = *(const double *)((const char *)given + NUMBERS[i].public_offset);
        if (value < NUMBERS[i].low || value > NUMBERS[i].high)
            return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                              "impacts[%zu].%s: %g: %s or NAN is allowed", index, NUMBERS[i].name,
                              value, NUMBERS[i].allowed);
        *(double *)((char *)impact + NUMBERS[i].offset) = value;
        /* as of a file */
        const struct column_kind *kind = column_find(NUMBERS[i].name);
        if (kind->usual > 0.0 && value > kind->usual)
            remarks_note(remarks, "impacts[%zu].%s: %g: above %g: %s", index, kind->name, value,
                         kind->usual, kind->question);
    }
    if (isnan(impact->speed))
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                          "impacts[%zu].speed: unknown: a number > 0 is needed", index);
    if (isnan(impact->restitution) && isnan(impact->impulse))
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                          "impacts[%zu].restitution: unknown: it or the impulse is needed", index);
    return take_interval(index, given, impact);
}

enum percuss_result percuss_measured_create(size_t count,
                                            const struct percuss_measured_impact *impacts,
                                            struct percuss_measured **measured)
{
    if (measured)
        *measured = NULL;
    if (REPORT_NULL(measured) || (count > 0 && REPORT_NULL(impacts)))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    if (count == 0)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "impacts: none: at least one is needed");
    struct percuss_measured *made = calloc(1, sizeof *made);
    enum percuss_result result = PERCUSS_RESULT_OK;
    for (size_t i = 0; made && result == PERCUSS_RESULT_OK && i < count; i++) {
        struct measured_impact impact;
        result = take(i, &impacts[i], &impact, &made->remarks);
        if (result == PERCUSS_RESULT_OK && !measured_append(&made->set, &impact))
            result = report_set(PERCUSS_RESULT_NO_MEMORY, "out of memory: impacts");
    }
    if (!made)
        return report_set(PERCUSS_RESULT_NO_MEMORY, "out of memory: impacts");
    if (result == PERCUSS_RESULT_OK)
        *measured = made;
    else
        percuss_measured_free(made);
    return result;
}

void percuss_measured_free(struct percuss_measured *measured)
{
    if (measured)
        measured_set_free(&measured->set);
    free(measured);
}

size_t percuss_measured_count(const struct percuss_measured *measured)
{
    return REPORT_NULL(measured) ? 0 : measured->set.count;
}

const char *percuss_measured_note(const struct percuss_measured *measured, size_t index)
{
    if (REPORT_NULL(measured))
        return NULL;
    size_t count = measured->remarks.notes;
    return index < count && index < REMARKS_KEPT ? measured->remarks.note[index].text : NULL;
}

struct percuss_measured_question percuss_measured_question_default(struct percuss_client *client,
                                                                   const struct percuss_body *a,
                                                                   const struct percuss_body *b)
{
    return (struct percuss_measured_question){.client = client,
                                              .pair = percuss_pair_default(a, b),
                                              .options = percuss_options_default(),
                                              .timeout = 60.0,
                                              .permutations = 1999,
                                              .seed = 1,
                                              .noise = 0.01};
}

static struct percuss_measured_impact give(const struct measured_impact *impact)
{
    struct percuss_measured_impact given;
    for (size_t i = 0; i < NUMBER_COUNT; i++)
        *(double *)((char *)&given + NUMBERS[i].public_offset) =
            *(const double *)((const char *)impact + NUMBERS[i].offset);
    given.restitution_half_width = measured_half_width(impact);
    return given;
}

static void fill(const struct differences *differences, struct percuss_comparison *comparison)
{
    comparison->measured_mean = differences->measured_mean;
    comparison->measured_deviation = differences->measured_deviation;
    comparison->simulated_mean = differences->simulated_mean;
    comparison->simulated_deviation = differences->simulated_deviation;
    comparison->residual_mean = differences->residual_mean;
    comparison->residual_half_width = differences->residual_half_width;
    comparison->residual_rms = differences->residual_rms;
    comparison->kolmogorov_smirnov = (struct percuss_measured_distance){
        differences->kolmogorov.value, differences->kolmogorov.p};
    comparison->energy_distance =
        (struct percuss_measured_distance){differences->energy.value, differences->energy.p};
    comparison->sub_impacts_known = differences->counted;
    comparison->sub_impacts_equal = differences->counts_equal;
}

static enum percuss_result compare(const struct report *report,
                                   struct percuss_comparison *comparison)
{
    const struct measured_set *set = &report->set;
    struct differences differences;
    if (!differences_find(set, report->list, report->asked->permutations, report->asked->seed,
                          &differences))
        return report_set(PERCUSS_RESULT_NO_MEMORY, "out of memory: distances");
    fill(&differences, comparison);
    /* impact by impact */
    comparison->impacts = calloc(set->count, sizeof *comparison->impacts);
    comparison->warnings = report_warnings(report);
    if (!comparison->impacts || !comparison->warnings)
        return report_set(PERCUSS_RESULT_NO_MEMORY, "out of memory: a comparison");
    comparison->warning_count = report->warnings.count;
    comparison->impact_count = set->count;
    for (size_t i = 0; i < set->count; i++) {
        const struct twin *twin = &report->list[i];
        comparison->impacts[i] = (struct percuss_measured_twin){
            give(&set->impacts[i]), give(&twin->impact), twin->status,
            twin->impact.restitution - set->impacts[i].restitution};
    }
    return PERCUSS_RESULT_OK;
}

enum percuss_result percuss_measured_compare(const struct percuss_measured *measured,
                                             const struct percuss_measured_question *question,
                                             struct percuss_comparison *comparison)
{
    struct report report;
    if (comparison)
        *comparison = (struct percuss_comparison){0};
    if (REPORT_NULL(measured, question, comparison))
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    enum percuss_result result = report_check(question);
    if (result != PERCUSS_RESULT_OK)
        return result;
    result = report_begin(measured, question, &report);
    if (result == PERCUSS_RESULT_OK)
        result = compare(&report, comparison);
    if (result != PERCUSS_RESULT_OK)
        percuss_comparison_free(comparison);
    report_end(&report);
    return result;
}

void percuss_comparison_free(struct percuss_comparison *comparison)
{
    if (!comparison)
        return;
    free(comparison->impacts);
    report_free_warnings(comparison->warning_count, comparison->warnings);
    *comparison = (struct percuss_comparison){0};
}
