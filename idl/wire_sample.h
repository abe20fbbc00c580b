/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Samples inside of DDS, made and read by the plans of their types. */
#ifndef PERCUSS_WIRE_SAMPLE_H
#define PERCUSS_WIRE_SAMPLE_H

#include <dds/ddsi/ddsi_serdata_default.h>

#include "wire_plan.h"

/* A type of Cyclone DDS, and what we keep with it. */
struct wire_type {
    struct ddsi_sertype_default common;
    struct wire_plan *plan; /* atomic; NULL: none yet, or Cyclone DDS writes and reads it alone */
};

/* Gives a type of a domain its plan if that is possible: it has one for XCDR2, its key is short,
 * and DDS lays samples out as its header says. Any thread. */
void wire_sample_prepare(struct wire_type *type);
void wire_sample_forget(struct wire_type *type);

/* `otherwise`: the operations of Cyclone DDS, for what no plan serves. */
struct ddsi_serdata *wire_sample_write(const struct wire_type *type,
                                       const struct ddsi_serdata_ops *otherwise,
                                       enum ddsi_serdata_kind kind, const void *sample);

/* Of `size` bytes from the network, from the encapsulation header on. NULL: they are not a complete
 * sample of a type with a plan in this machine's byte order; DDS may still take them. */
struct ddsi_serdata *wire_sample_take(const struct wire_type *type, const uint8_t *data,
                                      size_t size);

bool wire_sample_read(const struct ddsi_serdata *taken, const struct ddsi_serdata_ops *otherwise,
                      void *sample, void **buffer, void *limit);

#endif
