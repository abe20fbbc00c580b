/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The members of the structs of the wire, a list for each struct. The checks of a request, its
 * digest, the copies between the structs of the solver, of the wire and of the C API, JSON in both
 * directions and its schema follow from these lists. A new member of a request stands in
 * percuss_wire.idl, in the public header and in its list; the compiler finds what is missing.
 *
 * Members come in the order of JSON. F(KIND, name, ...) is called for those that are plain values:
 *   NUMBER, name, lowest, highest, what     a double in that range
 *   DEFAULTED, name, lowest, highest, what  the same, or 0 for the default
 *   VALUE, name, what                       a double that is NAN, or null, where it is undefined
 *   VECTOR, name, limit, what               double[3], each at most `limit` in magnitude
 *   PAIR, name, what                        double[2], along the tangents of a contact; undefined
 * as VALUE UNIT, name, size, what                  double[size] of norm 1 ID, name, what
 * char[PERCUSS_ID_SIZE], not empty TEXT, name, what                        char[] OCTETS, name,
 * what                      uint8_t[16] INDEX, name, what                       uint32_t, into the
 * bodies COUNT, name, what                       uint32_t or, of the solver, something wider
 *   LONG_COUNT, name, what                  uint64_t
 *   CHOICE, name, choice, count, what       a number of vocabulary.h, of an `enum percuss_<choice>`
 *   FLAG, name, what                        bool
 * and L(KIND, name, ...), often PERCUSS_NONE, for those that have members of their own:
 *   OBJECT, name, element, what             a struct percuss_<element>
 *   LIST, name, count, element, what        `count` of them, a sequence on the wire
 *   OPTIONAL, name, element, what           an object; on the wire a sequence of one, or of none
 *   TEXTS, name, count, what                `count` texts
 *   NUMBERS, name, count, what              `count` doubles
 *   COUNTS, name, count, what               `count` of uint64_t
 *   EDGES, name, count, what                one double more than `count`, none for none
 *   OVERRIDES, name, count, what            parameters and their values
 * where `what` begins with the unit. In a request that leaves out a member it is zero, or the
 * quaternion of no rotation. */
#ifndef PERCUSS_FIELDS_H
#define PERCUSS_FIELDS_H

#include "percuss/fields_ensemble_reply.h"
#include "percuss/fields_reply.h"
#include "percuss/fields_request.h"
#include "percuss/fields_server.h"

/* For members that nothing is done with. */
#define PERCUSS_NONE(kind, ...)

/* Copies a member from *from to *to, two pointers that are there where the list is expanded. */
#define PERCUSS_COPY(kind, name, ...) PERCUSS_COPY_##kind(name)

#define PERCUSS_COPY_NUMBER(name)     to->name = from->name;
#define PERCUSS_COPY_DEFAULTED(name)  to->name = from->name;
#define PERCUSS_COPY_VALUE(name)      to->name = from->name;
#define PERCUSS_COPY_INDEX(name)      to->name = from->name;
#define PERCUSS_COPY_COUNT(name)      to->name = (uint32_t)from->name;
#define PERCUSS_COPY_LONG_COUNT(name) to->name = from->name;
#define PERCUSS_COPY_CHOICE(name)     to->name = from->name;
#define PERCUSS_COPY_FLAG(name)       to->name = from->name;
#define PERCUSS_COPY_VECTOR(name)     PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_PAIR(name)       PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_UNIT(name)       PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_ID(name)         PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_TEXT(name)       PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_OCTETS(name)     PERCUSS_COPY_ARRAY(name)
#define PERCUSS_COPY_ARRAY(name)                                                                   \
    _Static_assert(sizeof to->name == sizeof from->name, #name " is as long on both sides");       \
    memcpy(to->name, from->name, sizeof to->name);

/* The same value in all of *to's members that may be undefined, see VALUE. */
#define PERCUSS_UNDEFINED(kind, name, ...) PERCUSS_UNDEFINED_##kind(name)
#define PERCUSS_UNDEFINED_PAIR(name)       to->name[0] = to->name[1] = NAN;
#define PERCUSS_UNDEFINED_VALUE(name)      to->name = NAN;
#define PERCUSS_UNDEFINED_COUNT(name)
#define PERCUSS_UNDEFINED_LONG_COUNT(name)
#define PERCUSS_UNDEFINED_CHOICE(name)
#define PERCUSS_UNDEFINED_FLAG(name)
#define PERCUSS_UNDEFINED_TEXT(name)

#endif
