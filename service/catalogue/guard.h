/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Refuses, before a document is built, what a catalogue does not need and a hostile text could
 * abuse. */
#ifndef PERCUSS_CATALOGUE_GUARD_H
#define PERCUSS_CATALOGUE_GUARD_H

#include <stddef.h>
#include <yaml.h>

#include "base/fault.h"

/* PERCUSS_OK if the text is exactly one YAML document without anchors, aliases and tags, of bounded
 * depth and number of values; else PERCUSS_BAD_REQUEST with "NAME:LINE: ...", or PERCUSS_INTERNAL
 * without memory. */
enum percuss_status guard_check(const char *text, size_t size, const char *name,
                                struct fault *fault);

#endif
