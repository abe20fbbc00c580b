/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fe/plasticity.h"

#include <math.h>
#include <stddef.h>

struct plastic_law plastic_law_make(const struct material *material)
{
    double young = material->young;
    return (struct plastic_law){
        .bulk = young / (3.0 * (1.0 - 2.0 * material->poisson)),
        .shear = material_shear_modulus(material),
        .yield = material->yield,
        .hardening = young * material->tangent / (young - material->tangent),
    };
}

double stress_equivalent(const double stress[STRESS_COMPONENTS])
{
    double mean = (stress[0] + stress[1] + stress[2]) / 3.0;
    double a = stress[0] - mean;
    double b = stress[1] - mean;
    double c = stress[2] - mean;
    return sqrt(1.5 * (a * a + b * b + c * c + 2.0 * stress[3] * stress[3]));
}

/* bulk m m^T + 2 deviator P - rank n n^T with m = (1, 1, 1, 0), P the projector on deviators (1/2
 * in its shear entry: the shear strain is an engineering one) and n a unit deviator */
static void moduli(double bulk, double deviator, double rank,
                   const double direction[STRESS_COMPONENTS], double *matrix)
{
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 3; j++)
            matrix[4 * i + j] =
                bulk + 2.0 * deviator * ((i == j) - 1.0 / 3.0) - rank * direction[i] * direction[j];
    for (size_t i = 0; i < 3; i++)
        matrix[4 * i + 3] = matrix[12 + i] = -rank * direction[i] * direction[3];
    matrix[15] = deviator - rank * direction[3] * direction[3];
}

void plastic_law_moduli(const struct plastic_law *law,
                        double matrix[STRESS_COMPONENTS * STRESS_COMPONENTS])
{
    static const double none[STRESS_COMPONENTS] = {0.0};
    moduli(law->bulk, law->shear, 0.0, none, matrix);
}

/* Rounds of Newton's method, and the change of the unknown after which the root is found. */
enum { INCREMENT_ROUNDS = 60 };
static const double INCREMENT_FOUND = 1e-12;

double plasticity_increment(const struct plastic_law *law, const struct yield_rate *stated,
                            double accumulated, double trial, double step)
{
    /* without the rate: more than with it, and all of it while the stress is not raised */
    double yield = law->yield + law->hardening * accumulated;
    double most = (trial - yield) / (3.0 * law->shear + law->hardening);
    double raise = yield_rate_factor(stated, most / step) - 1.0;
    if (!(raise > 0.0))
        return most;
    /* The unknown is by how much the stress is raised, of which the rate is a convex function (for
     * exponents of 1 and more): from above Newton's method comes down to the root, beginning where
     * the excess alone is the elastic part or the raised stress. */
    raise = fmin(raise, trial / yield - 1.0);
    double slope;
    for (int i = 0; i < INCREMENT_ROUNDS; i++) {
        double increment = step * yield_rate_at(stated, raise, &slope);
        slope *= step;
        double stress = yield + law->hardening * increment;
        double over = 3.0 * law->shear * increment + stress * (1.0 + raise) - trial;
        double change =
            over / ((3.0 * law->shear + law->hardening * (1.0 + raise)) * slope + stress);
        raise = fmax(raise - change, 0.0);
        if (fabs(change) <= INCREMENT_FOUND * (1.0 + raise))
            break;
    }
    return step * yield_rate_at(stated, raise, &slope);
}

bool plasticity_return(const struct plastic_law *law, const struct plastic_state *before,
                       const double strain[STRESS_COMPONENTS], struct plastic_state *after,
                       double stress[STRESS_COMPONENTS],
                       double tangent[STRESS_COMPONENTS * STRESS_COMPONENTS])
{
    /* trial: no flow */
    double volume = strain[0] + strain[1] + strain[2];
    double trial[STRESS_COMPONENTS];
    for (size_t i = 0; i < 3; i++)
        trial[i] = 2.0 * law->shear * (strain[i] - volume / 3.0 - before->strain[i]);
    trial[3] = law->shear * (strain[3] - before->strain[3]);
    double length = sqrt(trial[0] * trial[0] + trial[1] * trial[1] + trial[2] * trial[2] +
                         2.0 * trial[3] * trial[3]);
    double yield = law->yield + law->hardening * before->accumulated;
    double excess = sqrt(1.5) * length - yield;
    double pressure = law->bulk * volume;
    *after = *before;
    /* a state just returned lies on the yield surface but for rounding: it does not flow until it
     * moves on, so that a step begins with the elastic tangent whichever way it goes */
    if (!(excess > 1e-10 * yield)) {
        for (size_t i = 0; i < STRESS_COMPONENTS; i++)
            stress[i] = trial[i] + (i < 3 ? pressure : 0.0);
        if (tangent)
            plastic_law_moduli(law, tangent);
        return false;
    }
    /* the return is along the trial deviator: linear in the increment of accumulated strain */
    double increment = excess / (3.0 * law->shear + law->hardening);
    double scale = 1.0 - sqrt(6.0) * law->shear * increment / length;
    double direction[STRESS_COMPONENTS];
    for (size_t i = 0; i < STRESS_COMPONENTS; i++) {
        direction[i] = trial[i] / length;
        double flow = sqrt(1.5) * increment * direction[i];
        after->strain[i] += i < 3 ? flow : 2.0 * flow;
        stress[i] = scale * trial[i] + (i < 3 ? pressure : 0.0);
    }
    after->accumulated += increment;
    /* the tangent that is consistent with it */
    if (tangent) {
        double slope = 2.0 * law->shear / (1.0 + law->hardening / (3.0 * law->shear));
        double rank = slope - 2.0 * law->shear * (1.0 - scale);
        moduli(law->bulk, law->shear * scale, rank, direction, tangent);
    }
    return true;
}
