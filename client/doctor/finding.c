/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "finding.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

const char *finding_level_name(enum finding_level level)
{
    static const char *const names[] = {"ok", "warning", "problem"};
    return names[level];
}

void findings_keep(struct findings *findings, const struct finding *finding)
{
    struct finding *more = realloc(findings->each, (findings->count + 1) * sizeof *findings->each);
    if (!more)
        return;
    findings->each = more;
    findings->each[findings->count++] = *finding;
}

void findings_add(struct findings *findings, enum finding_level level, const char *subject,
                  const char *advice, const char *format, ...)
{
    struct finding finding = {.level = level};
    va_list arguments;
    snprintf(finding.subject, sizeof finding.subject, "%s", subject);
    snprintf(finding.advice, sizeof finding.advice, "%s", advice ? advice : "");
    va_start(arguments, format);
    vsnprintf(finding.found, sizeof finding.found, format, arguments);
    va_end(arguments);
    if (!findings->pipe)
        findings_keep(findings, &finding);
    else if (write(findings->pipe, &finding, sizeof finding) != sizeof finding)
        fprintf(stderr, "%s: %s\n", finding.subject, finding.found);
}
