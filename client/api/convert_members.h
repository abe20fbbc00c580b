/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* From structs of the wire to public ones by the lists of percuss/fields.h.
 *
 *     CONVERTER(sub_impact, SubImpact, PERCUSS_SUB_IMPACT_FIELDS)
 *
 * defines convert_sub_impact(from, storage, to); those of the elements of its lists must have been
 * defined before. Arrays are put into the storage; where memory runs out they stay empty. How many
 * NUMBERS, COUNTS and EDGES there are is the caller's to say: several lists may share it. */
#ifndef PERCUSS_API_CONVERT_MEMBERS_H
#define PERCUSS_API_CONVERT_MEMBERS_H

#include <percuss/fields.h>
#include <percuss/percuss.h>
#include <string.h>

#include "percuss_wire.h"
#include "storage.h"

#define CONVERTER(element, wire, fields)                                                           \
    static void convert_##element(const percuss_v1_##wire *from, struct storage *storage,          \
                                  struct percuss_##element *to)                                    \
    {                                                                                              \
        (void)storage;                                                                             \
        fields(PERCUSS_COPY, CONVERT)                                                              \
    }

#define CONVERT(kind, name, ...) CONVERT_##kind(name, __VA_ARGS__)

#define CONVERT_OBJECT(name, element, ...) convert_##element(&from->name, storage, &to->name);
#define CONVERT_LIST(name, count, element, ...)                                                    \
    to->name = storage_take(storage, from->name._length, sizeof *to->name);                        \
    to->count = to->name ? from->name._length : 0;                                                 \
    for (size_t i = 0; i < to->count; i++)                                                         \
        convert_##element(&from->name._buffer[i], storage, &to->name[i]);
#define CONVERT_TEXTS(name, count, ...)                                                            \
    to->name = storage_take(storage, from->name._length, sizeof *to->name);                        \
    to->count = to->name ? from->name._length : 0;                                                 \
    for (size_t i = 0; i < to->count; i++)                                                         \
        to->name[i] =                                                                              \
            storage_copy(storage, from->name._buffer[i], strlen(from->name._buffer[i]) + 1, 1);
#define CONVERT_OPTIONAL(name, element, ...)                                                       \
    undefine_##element(&to->name);                                                                 \
    if (from->name._length > 0)                                                                    \
        convert_##element(&from->name._buffer[0], storage, &to->name);
#define CONVERT_NUMBERS(name, ...)                                                                 \
    to->name = storage_copy(storage, from->name._buffer, from->name._length, sizeof *to->name);
#define CONVERT_COUNTS(name, ...) CONVERT_NUMBERS(name)
#define CONVERT_EDGES(name, ...)  CONVERT_NUMBERS(name)

#endif
