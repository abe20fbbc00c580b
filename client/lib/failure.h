/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Errors of DDS and of servers in words. */
#ifndef PERCUSS_LIB_FAILURE_H
#define PERCUSS_LIB_FAILURE_H

#include <percuss/result.h>

/* TRANSPORT with the failed step and Cyclone's word for the negative return code. */
enum percuss_result failure_dds(const char *what, int code);

/* NO_SERVER: the server of that name has gone. */
enum percuss_result failure_lost(const char *server);

#endif
