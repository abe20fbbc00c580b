/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A disk for SQLite, in memory, that writes down all that is done to it: it can fail at the n-th
 * operation, and be as it may be when power was lost before any of them. What was not synchronised
 * then is there, is not, or is there in part, whatever the order it was written in. One thread. */
#ifndef PERCUSS_TEST_DISK_H
#define PERCUSS_TEST_DISK_H

#include <stdbool.h>
#include <stddef.h>

/* Makes it the one that SQLite uses when a file is opened. Once. */
void disk_install(void);

/* An empty disk, with nothing written down. */
void disk_clear(void);

/* From now on the n-th operation (1: the next one) fails, once or with all after it; with `full`
 * only those that need room. 0: none fails. */
void disk_fail(unsigned long n, bool for_good, bool full);

/* Whether one has failed since disk_fail. */
bool disk_has_failed(void);

/* Operations (opening, reading, writing, cutting, synchronising, deleting) since disk_clear. */
unsigned long disk_operations(void);

/* Changes written down since disk_clear. */
size_t disk_changes(void);

/* Puts aside what is written down, for disk_lose_power, and clears the disk. */
void disk_keep_record(void);

/* The disk of the record as it is when power was lost before its change number `cut`; chance
 * decides by the seed. Changes are asked for in rising order. */
void disk_lose_power(size_t cut, unsigned seed);

/* A file's size and bytes, and other ones in their place; the file is cut off. */
size_t disk_size(const char *name);
unsigned char disk_byte(const char *name, size_t at);
void disk_write(const char *name, size_t at, const void *bytes, size_t size);
void disk_cut(const char *name, size_t size);

/* A whole number below `below`, the same in every run. */
unsigned disk_draw(unsigned below);

/* Whether all of a test is asked for: PERCUSS_FAULTS=whole. */
bool disk_is_whole(void);

#endif
