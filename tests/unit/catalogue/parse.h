/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the catalogue's tests share. */
#ifndef PERCUSS_TESTS_CATALOGUE_PARSE_H
#define PERCUSS_TESTS_CATALOGUE_PARSE_H

#include <stdio.h>
#include <string.h>

#include "catalogue/catalogue.h"
#include "check.h"

/* The catalogue in this text; fails the test with the message if it is refused. */
static inline struct body_set *parse_good(const char *text)
{
    struct body_set *set;
    struct fault fault = {0};
    if (catalogue_parse(text, strlen(text), "good.yaml", &set, &fault))
        fail_msg("%s", fault.text);
    return set;
}

/* Asserts that the text is refused on this line with a message that holds the fragment. */
static inline void parse_bad(const char *text, unsigned line, const char *fragment)
{
    struct body_set *set;
    struct fault fault = {0};
    char start[32];
    snprintf(start, sizeof start, "bad.yaml:%u: ", line);
    enum percuss_status status = catalogue_parse(text, strlen(text), "bad.yaml", &set, &fault);
    if (status != PERCUSS_BAD_REQUEST || strncmp(fault.text, start, strlen(start)) != 0 ||
        !strstr(fault.text, fragment))
        fail_msg("status %d, \"%s\"\nexpected %s ... %s\nfor\n%s", status, fault.text, start,
                 fragment, text);
    assert_null(set);
}

#endif
