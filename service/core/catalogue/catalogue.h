/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Bodies and materials from YAML. The keys, their units and ranges stand in keys.c; the
 * shipped example is config/catalogue.yaml. */
#ifndef PERCUSS_CATALOGUE_CATALOGUE_H
#define PERCUSS_CATALOGUE_CATALOGUE_H

#include <stddef.h>

#include "base/fault.h"
#include "model/body.h"

/* Largest accepted text. */
enum { CATALOGUE_MAX_BYTES = 16 * 1024 * 1024 };

/* Reads a file. PERCUSS_OK and a set for body_set_free; otherwise *set is NULL and the fault reads
 * "FILE:LINE: bodies.al-rod.radius: -0.01: must be ...": PERCUSS_BAD_REQUEST for a file that cannot
 * be read or accepted, PERCUSS_INTERNAL without memory. */
enum percuss_status catalogue_load(const char *path, struct body_set **set, struct fault *fault);

/* The same for a daemon, which answers about the bodies that are there. Bodies may be given as
 * meshes: they are taken from the folder of reduced bodies, and those that it lacks become orders
 * of the set, all of them if the folder is empty text; without one (NULL) meshes are refused. A
 * body without its own file becomes an order that is `missing`. */
enum percuss_status catalogue_load_reducing(const char *path, const char *folder,
                                            struct body_set **set, struct fault *fault);

/* The same from memory; `name` stands for the file in messages. The text need not end with zero and
 * is not kept. */
enum percuss_status catalogue_parse(const char *text, size_t size, const char *name,
                                    struct body_set **set, struct fault *fault);

/* A material of a catalogue's file, whether or not a body is of it; nothing else of the file need
 * be good. PERCUSS_BAD_REQUEST names those that there are. */
enum percuss_status catalogue_material(const char *path, const char *name,
                                       struct material *material, struct fault *fault);

#endif
