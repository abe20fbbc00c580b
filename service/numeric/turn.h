/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One thread at a time in BLAS and LAPACK: Debian's serial OpenBLAS gives all threads the same
 * buffers (its blas_memory_alloc has no lock), so that two that factor at once get wrong numbers.
 */
#ifndef PERCUSS_NUMERIC_TURN_H
#define PERCUSS_NUMERIC_TURN_H

void turn_begin(void);
void turn_end(void);

#endif
