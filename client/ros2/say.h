/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#ifndef PERCUSS_ROS2_SAY_H
#define PERCUSS_ROS2_SAY_H

/* A line on standard error. */
__attribute__((format(printf, 1, 2))) void say(const char *format, ...);

#endif
