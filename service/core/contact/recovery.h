/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The surface that a viscoelastic contact leaves recovers by itself: a circle that is free
 * (contact/memory.h: f(y) = 0) has
 *
 *   u(y) = sum_i share_i m_i(y),     time_i m_i' = u(y) - m_i(y)
 *
 * with the same matrix for all y. Its modes fade with the times T_l of creep, where the modulus
 * vanishes, 1 = sum_i share_i / (1 - time_i/T_l): m_i = T_l / (T_l - time_i), each of u = 1, and
 * orthogonal with the weights share_i time_i. */
#ifndef PERCUSS_CONTACT_RECOVERY_H
#define PERCUSS_CONTACT_RECOVERY_H

#include "model/relaxation.h"

struct recovery_modes {
    size_t count;
    double time[RELAXATION_MOST];                  /* s */
    double mode[RELAXATION_MOST][RELAXATION_MOST]; /* [mode][term] */
    double onto[RELAXATION_MOST][RELAXATION_MOST]; /* [mode][term]: amplitude by a term */
    double driven[RELAXATION_MOST]; /* amplitude by a constant load, u = sum share m + load, in the
                                       end */
};

struct recovery_modes recovery_modes_make(const struct relaxation *relaxation);

/* Amplitudes of terms, and the terms of amplitudes. */
void recovery_modes_split(const struct recovery_modes *modes, const double terms[RELAXATION_MOST],
                          double amplitudes[RELAXATION_MOST]);
void recovery_modes_join(const struct recovery_modes *modes,
                         const double amplitudes[RELAXATION_MOST], double terms[RELAXATION_MOST]);

/* The form center (1 - t) (1 - y/width) + center t (1 - y/width)^2 with its integral `total` = 3/4
 * int y^(-1/2) dy, as shape[0] + shape[1] y + shape[2] y^2. */
void recovery_parabola(double center, double total, double width, double shape[3]);

/* Amplitudes of the middle circle, m, and of all circles together, 3/4 int m y^(-1/2) dy, m^(3/2).
 * The shape between is that parabola of the width
 * `reach`. */
struct recovery {
    double reach; /* m; 0: nothing is left */
    double center[RELAXATION_MOST], total[RELAXATION_MOST];
};

/* Free for a time, s. */
void recovery_fade(struct recovery *left, const struct recovery_modes *modes, double time);

/* u(y) = shape[0] + shape[1] y + shape[2] y^2 up to the reach, after the modes have faded to
 * `kept` of themselves. */
void recovery_shape(const struct recovery *left, const struct recovery_modes *modes,
                    const double kept[RELAXATION_MOST], double shape[3]);

#endif
