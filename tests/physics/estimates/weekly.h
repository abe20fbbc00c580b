/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A bounded draw of every class, other scenes each week, that fails where an honest program hardly
 * ever would. */
#ifndef PERCUSS_TEST_ESTIMATES_WEEKLY_H
#define PERCUSS_TEST_ESTIMATES_WEEKLY_H

/* ISO year times 100 plus week, of today in UTC. */
unsigned long weekly_seed(void);

/* Prints the seed, the tables and what is wrong. 0: nothing is; 1: something. */
int weekly_draw(unsigned long seed);

#endif
