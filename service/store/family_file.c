/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/family_file.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fe/indentation.h"
#include "store/json_lists.h"
#include "store/table_key.h"

/* In the file's order; the first three are the axes. */
enum { DEPTH = CONTACT_FAMILY_AXES, FORCE, AREA, LARGEST, BACK, SHARE, LISTS };

static const char *const names[LISTS] = {"hardening", "poisson", "share", "depth",   "force",
                                         "area",      "largest", "back",  "branches"};
static const char FORMAT_NAME[] = "percuss contact family 1";

struct lists {
    size_t count[LISTS];
    double *values[LISTS];
    size_t branches, samples;
    double computed, error;
};

static void lists_free(struct lists *lists)
{
    for (size_t i = 0; i < LISTS; i++)
        free(lists->values[i]);
}

static struct contact_family_samples samples_of(const struct lists *lists)
{
    return (struct contact_family_samples){
        .count = {lists->count[0], lists->count[1], lists->count[2]},
        .axis = {lists->values[0], lists->values[1], lists->values[2]},
        .depths = lists->count[DEPTH],
        .depth = lists->values[DEPTH],
        .force = lists->values[FORCE],
        .area = lists->values[AREA],
        .springs = lists->count[LARGEST],
        .largest = lists->values[LARGEST],
        .back = lists->values[BACK],
        .branches = lists->branches,
        .samples = lists->samples,
        .share = lists->values[SHARE],
        .computed = lists->computed,
        .error = lists->error,
    };
}

static json_t *family_object(const struct contact_family_samples *samples,
                             const struct family_origin *origin)
{
    size_t tables = samples->count[0] * samples->count[1] * samples->count[2];
    /* lists in the order of `names` */
    const size_t counts[LISTS] = {samples->count[0],
                                  samples->count[1],
                                  samples->count[2],
                                  samples->depths,
                                  tables * samples->depths,
                                  tables * samples->depths,
                                  samples->springs,
                                  tables * samples->springs,
                                  tables * samples->branches * samples->samples};
    const double *values[LISTS] = {samples->axis[0], samples->axis[1], samples->axis[2],
                                   samples->depth,   samples->force,   samples->area,
                                   samples->largest, samples->back,    samples->share};
    /* head and origin, then the lists */
    json_t *object = json_pack(
        "{s:s, s:s, s:I, s:{s:I, s:I, s:f}, s:f, s:f, s:I, s:I}", "format", FORMAT_NAME, "made_by",
        origin->program, "indentation_version", (json_int_t)INDENTATION_VERSION, "effort", "coarse",
        (json_int_t)origin->coarse, "fine", (json_int_t)origin->fine, "seconds", origin->seconds,
        "computed", samples->computed, "error", samples->error, "branch_count",
        (json_int_t)samples->branches, "samples", (json_int_t)samples->samples);
    for (size_t i = 0; object && i < LISTS; i++)
        json_object_set_new(object, names[i], json_numbers(counts[i], values[i]));
    return object;
}

static enum percuss_status family_read_head(const json_t *root, struct lists *lists,
                                            struct fault *fault)
{
    const char *format = json_string_value(json_object_get(root, "format"));
    size_t version;
    /* format and version */
    if (!format || strcmp(format, FORMAT_NAME) != 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "format: %.60s: must be %s",
                         format ? format : "missing", FORMAT_NAME);
    enum percuss_status status = json_numbers_take_whole(
        json_object_get(root, "indentation_version"), "indentation_version", &version, fault);
    if (!status && version != INDENTATION_VERSION)
        status = fault_set(fault, PERCUSS_BAD_REQUEST,
                           "indentation_version: %zu: must be %d: compute the family anew", version,
                           INDENTATION_VERSION);
    /* range, error, and the counts of its lists */
    if (!status)
        status = json_numbers_take(json_object_get(root, "computed"), "computed", &lists->computed,
                                   fault);
    if (!status)
        status = json_numbers_take(json_object_get(root, "error"), "error", &lists->error, fault);
    if (!status)
        status = json_numbers_take_whole(json_object_get(root, "branch_count"), "branch_count",
                                         &lists->branches, fault);
    if (!status)
        status = json_numbers_take_whole(json_object_get(root, "samples"), "samples",
                                         &lists->samples, fault);
    return status;
}

/* The number of values that a list must have, by the counts of the lists before it; 0: any. */
static size_t expected_count(const struct lists *lists, size_t list)
{
    size_t tables = lists->count[0] * lists->count[1] * lists->count[2];
    switch (list) {
    case FORCE:
    case AREA:
        return tables * lists->count[DEPTH];
    case BACK:
        return tables * lists->count[LARGEST];
    case SHARE:
        return tables * lists->branches * lists->samples;
    default:
        return 0;
    }
}

static enum percuss_status family_read_lists(const json_t *root, struct json_lists *long_ones,
                                             struct lists *lists, struct fault *fault)
{
    enum percuss_status status = family_read_head(root, lists, fault);
    for (size_t i = 0; i < LISTS && !status; i++) {
        lists->count[i] = expected_count(lists, i);
        status =
            json_lists_take(long_ones, root, names[i], &lists->count[i], &lists->values[i], fault);
        if (!status && i < CONTACT_FAMILY_AXES && lists->count[i] > CONTACT_FAMILY_MOST)
            status = fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %zu places: must be at most %d",
                               names[i], lists->count[i], CONTACT_FAMILY_MOST);
    }
    if (!status && (lists->branches == 0 || lists->samples == 0))
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "branches: none");
    return status;
}

static void family_content_key(const struct lists *lists, char key[TABLE_KEY_SIZE])
{
    table_numbers_key(LISTS, lists->count, (const double *const *)lists->values, key);
}

/* The object as text, with the hash of its numbers after they are rounded to text and read back. */
static char *family_text(json_t *object)
{
    struct lists lists = {0};
    struct json_lists none = {0};
    struct fault fault;
    char key[TABLE_KEY_SIZE];
    char *text = json_numbers_text(object, JSON_REAL_PRECISION(7) | JSON_COMPACT);
    json_t *again = text ? json_loads(text, 0, NULL) : NULL;
    free(text);
    text = NULL;
    if (again && family_read_lists(again, &none, &lists, &fault) == PERCUSS_OK) {
        family_content_key(&lists, key);
        json_object_set_new(object, "content", json_string(key));
        text = json_numbers_text(object, JSON_REAL_PRECISION(7) | JSON_COMPACT);
    }
    lists_free(&lists);
    json_decref(again);
    return text;
}

enum percuss_status family_file_save(const char *folder,
                                     const struct contact_family_samples *samples,
                                     const struct family_origin *origin, char path[TABLE_PATH_SIZE],
                                     struct fault *fault)
{
    if (snprintf(path, TABLE_PATH_SIZE, "%s/" FAMILY_FILE_NAME, folder) >= TABLE_PATH_SIZE)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: too long a path", folder);
    json_t *object = family_object(samples, origin);
    char *text = object ? family_text(object) : NULL;
    json_decref(object);
    if (!text)
        return fault_set(fault, PERCUSS_INTERNAL, "contact family: out of memory");
    enum percuss_status status = table_file_write(folder, text, path, fault);
    free(text);
    return status;
}

static struct contact_family *family_of(const json_t *root, struct json_lists *long_ones,
                                        struct fault *fault)
{
    struct lists lists = {0};
    struct contact_family *family = NULL;
    char key[TABLE_KEY_SIZE];
    enum percuss_status status = family_read_lists(root, long_ones, &lists, fault);
    if (!status) {
        family_content_key(&lists, key);
        status = json_numbers_check_hash(root, "content", key, fault);
    }
    if (!status) {
        struct contact_family_samples samples = samples_of(&lists);
        family = contact_family_create(&samples, fault);
    }
    lists_free(&lists);
    return family;
}

struct contact_family *family_file_load(const char *path, struct fault *fault)
{
    size_t size = 0;
    struct fault reason = {""};
    char *text;
    if (table_file_read(path, &text, &size, fault))
        return NULL;
    struct contact_family *family = NULL;
    struct json_lists lists;
    json_t *root;
    text[size] = '\0';
    if (!json_lists_parse(text, size, &lists, &root, &reason))
        family = family_of(root, &lists, &reason);
    json_lists_free(&lists);
    free(text);
    json_decref(root);
    if (!family)
        fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: %.300s", path, reason.text);
    return family;
}
