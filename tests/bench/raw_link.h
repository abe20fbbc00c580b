/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The bare round trip that the service is compared with: octets to another process and back through
 * Cyclone DDS, with the service's quality of service, a waitset at both ends, nothing else. */
#ifndef PERCUSS_BENCH_RAW_LINK_H
#define PERCUSS_BENCH_RAW_LINK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct raw_link;

/* Joins the domain and waits until the echo answers; NULL: it did not within 20 s. */
struct raw_link *raw_link_open(uint32_t domain);
void raw_link_close(struct raw_link *link);

/* Seconds of a round trip of samples that take `request` and `reply` octets serialised, what DDS
 * puts before the data included; the other end keeps its processor busy for `busy` seconds before
 * it answers. Negative: no answer. */
double raw_link_trip(struct raw_link *link, size_t request, size_t reply, double busy);

/* The other process: answers until it is ended by a signal. Returns only if DDS fails. */
void raw_echo(uint32_t domain);

#endif
