/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The steps in which samples of a type are written and read in this machine's byte order.
 *
 * Cyclone DDS goes through a type's instructions member by member, some hundred instructions of the
 * processor for each number. A plan has numbers that lie side by side in memory and on the wire as
 * one step, which is one copy. It is for XCDR2 of @appendable structs alone. */
#ifndef PERCUSS_WIRE_PLAN_H
#define PERCUSS_WIRE_PLAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum wire_kind { WIRE_END, WIRE_NUMBERS, WIRE_TEXT, WIRE_STRING, WIRE_STRUCT, WIRE_LIST };

struct wire_step {
    enum wire_kind kind;
    enum wire_kind element; /* of a list */
    bool booleans;          /* numbers that are 0 or 1 */
    uint32_t offset;        /* in the struct in memory */
    uint32_t size;          /* bytes in memory of a number, a text, an element */
    uint32_t count;         /* of numbers */
    uint32_t bound;         /* of a list; 0: none */
    uint32_t inner;         /* the first step of a struct, or of a list's structs */
};

/* Of each struct the steps up to a WIRE_END. */
struct wire_plan {
    struct wire_step *steps;
    uint32_t count;
    uint32_t first; /* step of the type itself */
};

/* `ops`: instructions as in wire_whole.h. NULL: a type that plans are not for, or no memory. */
struct wire_plan *wire_plan_create(const uint32_t *ops);
void wire_plan_free(struct wire_plan *plan); /* may be NULL */

/* Where numbers of that size begin: those of 8 bytes are aligned to 4. */
static inline size_t wire_plan_align(size_t at, size_t size)
{
    size_t alignment = size < 4 ? size : 4;
    return (at + alignment - 1) & ~(alignment - 1);
}

#endif
