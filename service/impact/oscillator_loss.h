/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What a damper takes from one oscillator during a step with a cubic force. */
#ifndef PERCUSS_IMPACT_OSCILLATOR_LOSS_H
#define PERCUSS_IMPACT_OSCILLATOR_LOSS_H

#include "impact/collocation.h"

enum { LOSS_INPUTS = NODES + 2 };

/* 2 zeta omega int_0^h v^2 dt as a symmetric quadratic form of (q, v, f_1..f_4). */
void oscillator_loss_form(double omega, double damping, double h,
                          double form[LOSS_INPUTS][LOSS_INPUTS]);

#endif
