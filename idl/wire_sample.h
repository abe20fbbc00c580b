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

#endif
