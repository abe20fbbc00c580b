/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The processes a benchmark starts for itself, in a domain that nobody else uses. They end with it,
 * however it ends. */
#ifndef PERCUSS_BENCH_CHILDREN_H
#define PERCUSS_BENCH_CHILDREN_H

#include <stdint.h>
#include <sys/types.h>

enum { CHILDREN_MOST = 256 };

/* A random domain of this machine, locked until this process ends. Also makes sure that DDS stays
 * on the loopback interface, here and in the children. Ends the program if none is free. */
uint32_t children_domain(void);

/* Starts a program; `arguments` begin with its path and end with NULL. Ends the program on failure.
 */
pid_t children_start(char *const arguments[]);

/* Ends with a message if one of the children has ended. */
void children_check(void);

/* Asks all to end, and waits until they have; the same happens at exit. */
void children_stop(void);

/* Processor time a child has used so far, s. */
double children_cpu(pid_t child);

#endif
