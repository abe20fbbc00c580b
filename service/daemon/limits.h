/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The limits that the system sets to this process. They are checked before DDS starts, which ends
 * the process where it lacks a descriptor or memory. */
#ifndef PERCUSS_DAEMON_LIMITS_H
#define PERCUSS_DAEMON_LIMITS_H

#include "base/fault.h"
#include "respond/settings.h"

/* PERCUSS_BAD_REQUEST with the limit, its value and the number that is needed. A soft limit of
 * descriptors is raised as far as the hard one allows. */
enum percuss_status limits_check(const struct settings *settings, struct fault *fault);

/* Has the caches, and the allocator, keep to limits.megabytes and to the memory that the control
 * group and the process may have, and logs that. Before there are threads. */
void limits_fit(struct settings *settings);

/* Whether the process may access a file or folder in that `mode` (access(2)), or can make it.
 * PERCUSS_BAD_REQUEST with "PATH: ...". */
enum percuss_status limits_check_place(const char *path, int mode, struct fault *fault);

/* Bytes that a control group's memory.max (of version 1: memory.limit_in_bytes) allows, or those of
 * a group above it; 0: no limit is known. `root` is where control groups are mounted,
 * `membership` a file as /proc/self/cgroup. */
unsigned long long limits_cgroup(const char *root, const char *membership);

/* KiB of address space that a daemon of these settings needs, with threads of so large a stack. */
unsigned long long limits_address_space(const struct settings *settings, size_t stack);

/* Threads that may solve, each with bodies that it has prepared. */
unsigned limits_solving_threads(const struct settings *settings);

/* The caches' megabytes with so many bytes of memory and of address space (0: no limit). True: one
 * of them is told so, or there is a limit for their sum. */
bool limits_fit_caches(struct settings *settings, unsigned long long memory,
                       unsigned long long address_space);

#endif
