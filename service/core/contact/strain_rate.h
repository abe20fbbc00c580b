/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The rate of strain that counts in a contact which yields. */
#ifndef PERCUSS_CONTACT_STRAIN_RATE_H
#define PERCUSS_CONTACT_STRAIN_RATE_H

#include "contact/hertz.h"
#include "model/yield_rate.h"

/* One impact on a contact. */
struct strain_rate_blow {
    double speed; /* m/s, at the touch */
    double work;  /* J, that the contact takes up until its largest indentation; > 0 */
};

/* Of one body. */
struct strain_rate {
    double rate;   /* 1/s; 0: its yield stress does not depend on it */
    double factor; /* yield stress at that rate over the stated one, >= 1 */
};

/* Of both bodies, at least one of which can yield: the one rate whose yield stress, in the place of
 * each point's own, gives the same restitution. To first order in the sensitivity s of the yield
 * stress to the rate it is the energy-weighted mean of its logarithm:
 *
 * - of the energies D that flows and E that springs back, D ~ p_l a^4 and E ~ p_e^2 a^3 with the
 *   mean pressures p_l of loading and p_e of its end; their sum is given, so that ln E changes as
 *   (8 ln p_e - 3 ln p_l) D / (4 D + 3 E). The rate counts as r_e^(8/5) r_l^(-3/5).
 * - while the contact flows the rate is c d'/a, with d ~ sin of time and a^2 ~ d; in the mean over
 *   the work of loading ln r_l = ln(c v/a) - 1/4, a at the end.
 * - near the largest indentation d' is the sum of a plastic part and of the elastic one, of the
 *   share q = F / (k d), k being the unloading stiffness. With the plastic part r over v and the
 *   time t over d/v from the largest indentation on, s q r' = -r (t + r): r is sqrt(s q) times
 *   exp(-x^2/2) over its integral up to x = t / sqrt(s q), so sqrt(2 s q / pi) at t = 0. What flows
 *   after that, s q ln 2 of d, lowers the force as half of this rate would: r_e = sqrt(s q / (2
 *   pi)) of c v/a.
 *
 * Together the rate is 0.267 c (s q)^(4/5) v/a, with c = c_e^(8/5) c_l^(-3/5) of the means,
 * weighted by the work of flow, of the logarithm of the plastic strain over that of d'/a at the end
 * and while loading: 0.6 to 1.2 by complete finite elements without a rate, of dents of 0.04 to 0.1
 * of the sphere's radius. Nine impacts of complete finite elements with the rate of each point have
 * 0.35 (s q)^(4/5) v/a in the geometric mean, which is used; docs/lab/contact-models.md has their
 * scatter. q, a and s are those at the yield stresses so found, by the closed form. */
void strain_rate_of(const struct hertz_contact *hertz, const struct material *const materials[2],
                    const struct yield_rate *const stated[2], const struct strain_rate_blow *blow,
                    struct strain_rate found[2]);

#endif
