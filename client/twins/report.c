/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "report.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PERMUTATIONS = 1000000 };

/* all that is wrong with a file */
static _Thread_local char error_text[REMARKS_KEPT * sizeof(struct measured_fault)];

enum percuss_result report_set(enum percuss_result result, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error_text, sizeof error_text, format, arguments);
    va_end(arguments);
    return result;
}

enum percuss_result report_null(struct missing missing)
{
    return missing.name
               ? report_set(PERCUSS_RESULT_INVALID_ARGUMENT, MISSING_FORMAT, MISSING_TEXT(missing))
               : PERCUSS_RESULT_OK;
}

const char *percuss_measured_error_text(void)
{
    return error_text;
}

enum percuss_result report_check(const struct percuss_measured_question *asked)
{
    if (!asked->client)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "client: NULL: one is needed");
    if (!asked->pair.a || !asked->pair.b)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "pair.%s: NULL: a body is needed",
                          asked->pair.a ? "b" : "a");
    if (asked->permutations < 1 || asked->permutations > MOST_PERMUTATIONS)
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "permutations: %u: 1..%d is allowed",
                          asked->permutations, MOST_PERMUTATIONS);
    if (!(asked->noise > 0.0 && asked->noise < 1.0))
        return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                          "noise: %g: a number between 0 and 1 is allowed", asked->noise);
    return PERCUSS_RESULT_OK;
}

static bool take(void *context, const struct percuss_request *request,
                 const struct percuss_reply *reply, size_t index)
{
    struct report *report = context;
    char place[32];
    (void)request;
    snprintf(place, sizeof place, "impact %zu", index + 1);
    if (index == 0)
        tally_clear(&report->warnings);
    if (reply->status != PERCUSS_OK && reply->status != PERCUSS_TRUNCATED &&
        reply->status != PERCUSS_NOT_APPROACHING) {
        report_set(PERCUSS_RESULT_INVALID_ARGUMENT, "%s: %s: %.800s", place,
                   percuss_status_name(reply->status), reply->message);
        return false;
    }
    if (tally_take(&report->warnings, reply, place))
        return true;
    report_set(PERCUSS_RESULT_NO_MEMORY, "out of memory: warnings");
    return false;
}

enum percuss_result report_result(enum percuss_result result)
{
    switch (result) {
    case PERCUSS_RESULT_OK:
        return result;
    case PERCUSS_RESULT_PENDING: /* the listener has said why */
        return PERCUSS_RESULT_INVALID_ARGUMENT;
    case PERCUSS_RESULT_NO_MEMORY:
        return report_set(result, "out of memory: twins");
    default:
        return report_set(result, "%s", percuss_error_text());
    }
}

static enum percuss_result copy(const struct measured_set *set, struct report *report)
{
    report->list = calloc(set->count, sizeof *report->list);
    bool good = report->list;
    for (size_t i = 0; good && i < set->count; i++)
        good = measured_append(&report->set, &set->impacts[i]);
    return good ? PERCUSS_RESULT_OK
                : report_set(PERCUSS_RESULT_NO_MEMORY, "out of memory: impacts");
}

enum percuss_result report_begin(const struct percuss_measured *measured,
                                 const struct percuss_measured_question *asked,
                                 struct report *report)
{
    *report =
        (struct report){.asked = asked,
                        .question = {asked->client, asked->pair, asked->options, asked->timeout},
                        .warnings.unit = "twins",
                        .listener = {take, report}};
    enum percuss_result result = copy(&measured->set, report);
    if (result != PERCUSS_RESULT_OK)
        return result;
    /* the twins as the catalogue has them know the masses */
    const struct twin_changes none = {.faster = 1.0};
    result = report_result(
        twin_ask(&report->question, &report->set, &none, &report->listener, report->list));
    if (result != PERCUSS_RESULT_OK)
        return result;
    size_t done = twin_complete(&report->question, &report->set, report->list);
    if (done == report->set.count)
        return PERCUSS_RESULT_OK;
    return report_set(PERCUSS_RESULT_INVALID_ARGUMENT,
                      "impact %zu: a history of %s does not tell the impulse, because it "
                      "vibrates: a compact body is needed as a",
                      done + 1, asked->pair.a->id);
}

void report_end(struct report *report)
{
    measured_set_free(&report->set);
    free(report->list);
    tally_clear(&report->warnings);
}

char **report_warnings(const struct report *report)
{
    char line[TALLY_LINE];
    size_t count = report->warnings.count;
    char **warnings = calloc(count + 1, sizeof *warnings);
    for (size_t i = 0; warnings && i < count; i++) {
        tally_line(&report->warnings, i, line);
        warnings[i] = strdup(line);
        if (!warnings[i]) {
            report_free_warnings(i, warnings);
            return NULL;
        }
    }
    return warnings;
}

void report_free_warnings(size_t count, char **warnings)
{
    for (size_t i = 0; warnings && i < count; i++)
        free(warnings[i]);
    free(warnings);
}
