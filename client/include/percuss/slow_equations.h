/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The slow scale's equations: impacts as jumps of rigid velocities (Schiehlen and Seifried, Eqs.
 * (3) to (6); Pfeiffer and Glocker for several contacts at once). n contacts; W = w^T M^-1 w is
 * their n x n row-major Delassus matrix, 1/kg, symmetric and positive semidefinite; gap rates in
 * m/s, < 0 approaches; impulses in N s. Pure functions: nothing is kept. A pointer may be NULL
 * where it is said so, and where no element is read; otherwise the function does nothing and
 * returns false or NAN, and percuss_slow_error_text (slowscale.h) names the argument. */
#ifndef PERCUSS_SLOW_EQUATIONS_H
#define PERCUSS_SLOW_EQUATIONS_H

#include <percuss/request.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Impulses that stop the approach: 0 <= W impulse + gap_rate, complementary to impulse >= 0; Eq.
 * (4) for one contact. One contact is solved directly, several by Lemke's method, with the residual
 * checked. False: no solution (W is no Delassus matrix), or no memory. */
PERCUSS_API bool percuss_slow_compression(size_t n, const double *W, const double *gap_rate,
                                          double *impulse);

/* The outcome of an impact with the given coefficients, Eq. (5). */
struct percuss_slow_outcome {
    double *compression;    /* [n], as percuss_slow_compression; may be NULL */
    double *impulse;        /* [n] */
    double *gap_rate_after; /* [n]; may be NULL */
};

/* Two phases after Poisson: compression as above; then expansion, in which each contact gives back
 * at least restitution[i] times its compression impulse and none approaches any more. A permanent
 * contact (gap rate 0) takes part with any coefficient and opens if the impact drives it apart. No
 * energy is created for coefficients in [0, 1], equal or not: the expansion impulse P has the least
 * energy P.W P / 2 + rate.P of all P >= restitution * compression, and one of those is the
 * compression impulse itself, which would just bring back the energy that it took. False as above.
 */
PERCUSS_API bool percuss_slow_poisson(size_t n, const double *W, const double *gap_rate,
                                      const double *restitution,
                                      struct percuss_slow_outcome *outcome);

/* Eq. (6): impulse / compression impulse - 1 of each contact; NAN where the compression impulse is
 * 0. False as above. */
PERCUSS_API bool percuss_slow_restitution(size_t n, const double *W, const double *gap_rate,
                                          const double *impulse, double *restitution);

/* W impulse + gap_rate. */
PERCUSS_API void percuss_slow_gap_rate_after(size_t n, const double *W, const double *gap_rate,
                                             const double *impulse, double *after);

struct percuss_sub_impact; /* percuss/reply.h */

/* The centre in time of a sub-impact's force, s from the stated instant: an impulse applied then
 * leaves the positions that the force would. From the impulses, lengths and the peak of its two
 * halves: within 1e-3 of its length where the bodies do not vibrate, else within some hundredths.
 */
PERCUSS_API double percuss_slow_force_centre(const struct percuss_sub_impact *sub);

/* Two bodies that touch, or nearly, as the engine sees them now. */
struct percuss_slow_contact {
    uint32_t a, b;           /* indices of the engine's bodies */
    uint32_t feature;        /* tells several contacts of the same two bodies apart; else 0 */
    double point[3];         /* world, m; halfway between the surfaces */
    double normal[3];        /* world, unit, from b to a */
    double gap;              /* m; negative: overlap */
    double gap_acceleration; /* m/s^2 without contact forces; negative presses; 0 if unknown */
    double friction;         /* coefficient; 0: the catalogue's for the two materials, if any */
    double tangent[3];       /* first tangential direction, as in struct percuss_contact */
};

/* Inertia of a body that no joint holds. */
struct percuss_slow_inertia {
    double mass;       /* kg; INFINITY: immovable, the moments are then not read */
    double moments[3]; /* principal ones, about the axes of the motion's orientation through the
                          centre of mass, kg m^2; infinite ones are allowed */
};

/* Rates of approach of `count` contacts of moving bodies: n.(v_a - v_b) at the contact's point. */
PERCUSS_API void percuss_slow_gap_rates(const struct percuss_body_motion *bodies, size_t count,
                                        const struct percuss_slow_contact *contacts,
                                        double *gap_rate);

/* The Delassus matrix [count x count] of contacts of free bodies. Its diagonal holds the inverse
 * effective masses 1/m_a + 1/m_b + (r_a x n).I_a^-1 (r_a x n) + (r_b x n).I_b^-1 (r_b x n). */
PERCUSS_API void percuss_slow_free_delassus(const struct percuss_body_motion *bodies,
                                            const struct percuss_slow_inertia *inertias,
                                            size_t count,
                                            const struct percuss_slow_contact *contacts,
                                            double *delassus);

/* The tangents of a contact as a service takes them, world, unit: the stated one made normal to the
 * normal, or where that is zero or along it the world axis least parallel to it (x before y before
 * z); and normal x first. */
PERCUSS_API void percuss_slow_tangents(const struct percuss_slow_contact *contact, double first[3],
                                       double second[3]);

/* The same with both tangents [3 count x 3 count], in the order of `oblique` (slow_engine.h). */
PERCUSS_API void percuss_slow_free_oblique(const struct percuss_body_motion *bodies,
                                           const struct percuss_slow_inertia *inertias,
                                           size_t count,
                                           const struct percuss_slow_contact *contacts,
                                           double *delassus);

/* Eq. (3): gives free bodies the velocities after `impulse` at the contact, + on a and - on b. */
PERCUSS_API void percuss_slow_free_apply(struct percuss_body_motion *bodies,
                                         const struct percuss_slow_inertia *inertias,
                                         const struct percuss_slow_contact *contact,
                                         double impulse);

/* The same with all components: `impulse`, world, on a at the contact's point, and against it on b.
 * The normal of the contact is not read. */
PERCUSS_API void percuss_slow_free_apply_vector(struct percuss_body_motion *bodies,
                                                const struct percuss_slow_inertia *inertias,
                                                const struct percuss_slow_contact *contact,
                                                const double impulse[3]);

/* Moves free bodies, and turns them, by M^-1 w moment; moment in N s^2. */
PERCUSS_API void percuss_slow_free_move(struct percuss_body_motion *bodies,
                                        const struct percuss_slow_inertia *inertias,
                                        const struct percuss_slow_contact *contact, double moment);

/* The same with all components, as percuss_slow_free_apply_vector. */
PERCUSS_API void percuss_slow_free_move_vector(struct percuss_body_motion *bodies,
                                               const struct percuss_slow_inertia *inertias,
                                               const struct percuss_slow_contact *contact,
                                               const double moment[3]);

#ifdef __cplusplus
}
#endif

#endif
