/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What this library says of DDS and of servers. */
#ifndef PERCUSS_LIB_FAILURE_H
#define PERCUSS_LIB_FAILURE_H

#include <percuss/result.h>

/* TRANSPORT with what failed and Cyclone's word for the negative return code. */
enum percuss_result failure_dds(const char *what, int code);

/* NO_SERVER: the server of that name has gone. */
enum percuss_result failure_lost(const char *server);

#endif
