/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Files that come with the program, or with the library that this is part of, wherever its tree is
 * installed or built. */
#ifndef PERCUSS_CATALOGUE_SHIPPED_H
#define PERCUSS_CATALOGUE_SHIPPED_H

/* The path of a file by its name in share/percuss, for free(); NULL: it is not there, or there is
 * no memory. */
char *shipped_find(const char *name);

/* The path of a file that a catalogue names: from the folder of the catalogue's own, else as
 * shipped_find, since catalogues are copied without their files; where neither is there the first.
 * For free(); NULL: out of memory. */
char *shipped_resolve(const char *catalogue, const char *file);

/* The path of the default settings of a program, for free(): those in the folder for configuration
 * that belongs to its own, or else those in share/percuss. NULL as above. */
char *shipped_settings(void);

/* The same without a look into the folder for configuration. */
char *shipped_plain_settings(void);

/* A shipped program, as a user types it, for free(): its whole path, or its name alone where it
 * lies in a folder for the commands of all, or is not there. NULL: no memory. */
char *shipped_program(const char *name);

#endif
