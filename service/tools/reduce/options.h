/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The command line of percuss-reduce. */
#ifndef PERCUSS_REDUCE_OPTIONS_H
#define PERCUSS_REDUCE_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "base/fault.h"

enum { OPTIONS_MOST = 32, OPTIONS_MODES = 300 };

/* A part of the mesh with the material it is made of. */
struct part_option {
    const char *part, *material;
};

struct options {
    const char *file, *body, *vtk; /* the mesh, the body's file; NULL: no file for ParaView */
    const char *add_to;            /* a body's file that sites are added to; NULL: one is made */
    const char *instance;          /* of a deck's assembly; NULL: the only one */
    const char *catalogue, *material;
    const char *stiffness, *mass, *freedoms; /* matrices that another program has assembled */
    double young, poisson, density;          /* NAN: not given; fewer than all fill gaps */
    double unit, size;                       /* m; 0: size not given, unit that of the body */
    double max_frequency;                    /* Hz; 0: from the mesh */
    size_t modes;                            /* 0: from the frequency */
    size_t fixed_count, part_count, site_count;
    const char *fixed[OPTIONS_MOST];
    struct part_option parts[OPTIONS_MOST];
    double sites[OPTIONS_MOST][3]; /* in the unit of the mesh */
    double progress;               /* s between its lines; 0: not given */
    bool json, raise, later;       /* later: sites are solved for when they are added */
    const char *size_text, *site_texts[OPTIONS_MOST]; /* size and sites as they were given */
};

/* Ends the program for --help, --version and, with exit code 2, wrong usage. */
struct options options_read(int argc, char **argv);

/* Reads the sites' texts in the unit. PERCUSS_BAD_REQUEST names the first that is none. */
enum percuss_status options_read_sites(struct options *options, struct fault *fault);

#endif
