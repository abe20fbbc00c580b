/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Allowed ranges of the numbers that describe a body: one list for the checks of the model, for the
 * keys of the catalogue and for the messages of both. */
#ifndef PERCUSS_MODEL_LIMITS_H
#define PERCUSS_MODEL_LIMITS_H

#include <stdbool.h>

#include "base/fault.h"
#include "base/units.h"

enum { LIMIT_MODES = 5000 }; /* fixed number of modes of a body, at most */

struct limit {
    double low, high; /* both finite; allowed themselves unless open */
    bool low_open, high_open;
    const char *text; /* the allowed range, in words that follow "must be" */
    enum quantity quantity;
};

extern const struct limit limit_length;         /* m */
extern const struct limit limit_diameter;       /* m */
extern const struct limit limit_young;          /* Pa */
extern const struct limit limit_poisson;        /* so that bulk and shear moduli are positive */
extern const struct limit limit_density;        /* kg/m^3 */
extern const struct limit limit_yield;          /* Pa */
extern const struct limit limit_tangent;        /* Pa */
extern const struct limit limit_damping;        /* ratio; 1 would no longer oscillate */
extern const struct limit limit_loss_factor;    /* ratio; half of it damps a mode */
extern const struct limit limit_loss_frequency; /* Hz */
extern const struct limit limit_share;          /* of a modulus that relaxes */
extern const struct limit limit_time;           /* s, in which it does */
extern const struct limit limit_shear_factor;   /* of a Timoshenko beam */
extern const struct limit limit_scale;          /* of a mesh's size */
extern const struct limit limit_friction;       /* Coulomb's coefficient */
extern const struct limit limit_deviation;      /* of such a coefficient */
extern const struct limit limit_law_stiffness;  /* of a power law: N/m^exponent */
extern const struct limit limit_law_exponent;
extern const struct limit limit_hysteresis;    /* share of the work */
extern const struct limit limit_dissipation;   /* s/m */
extern const struct limit limit_law_deviation; /* of a law's force, over it */
extern const struct limit limit_modes;         /* a whole number */

/* Of a yield stress that grows with the rate of strain, 1/s, as model/yield_rate.h has them. */
extern const struct limit limit_rate;
extern const struct limit limit_rate_exponent;
extern const struct limit limit_rate_coefficient;

/* False for NAN and the infinities too. */
bool limit_holds(const struct limit *limit, double value);

/* PERCUSS_OK, or PERCUSS_BAD_REQUEST with "field: value: must be ...". */
enum percuss_status limit_check(const struct limit *limit, const char *field, double value,
                                struct fault *fault);

#endif
