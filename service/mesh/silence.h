/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* HDF5 as a guest of this process. */
#ifndef PERCUSS_MESH_SILENCE_H
#define PERCUSS_MESH_SILENCE_H

#include <hdf5.h>

/* What it would write to standard error. */
struct silence {
    H5E_auto2_t function;
    void *data;
};

/* What HDF5 writes about errors to standard error is said in faults, from here to silence_end. The
 * library stays loaded from now on, even if who uses it here is unloaded: it gives each thread that
 * calls it data of its own, which its code releases when the thread ends. */
struct silence silence_begin(void);
void silence_end(const struct silence *kept);

#endif
