/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Samples go from thread to thread under locks of Cyclone DDS, which is not instrumented and which
 * the thread sanitizer is told to overlook (tests/tsan.supp). So it is told here who had a sample
 * before. */
#ifndef PERCUSS_WIRE_HAND_H
#define PERCUSS_WIRE_HAND_H

#ifdef __SANITIZE_THREAD__

void __tsan_acquire(void *address);
void __tsan_release(void *address);

static inline void wire_hand_take(const void *sample)
{
    __tsan_acquire((void *)sample);
}

static inline void wire_hand_give(const void *sample)
{
    if (sample)
        __tsan_release((void *)sample);
}

#else

static inline void wire_hand_take(const void *sample)
{
    (void)sample;
}

static inline void wire_hand_give(const void *sample)
{
    (void)sample;
}

#endif

#endif
