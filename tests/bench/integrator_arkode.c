/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>

#include "integrator.h"

struct arkode_integrator {
    struct integrator base;
    SUNContext context;
    N_Vector y, absolute;
    void *arkode;
};

static int rate(double t, N_Vector y, N_Vector result, void *data)
{
    (void)t;
    struct arkode_integrator *own = data;
    contact_ode_rate(own->base.ode, N_VGetArrayPointer(y), N_VGetArrayPointer(result));
    return 0;
}

static int roots(double t, N_Vector y, double *values, void *data)
{
    (void)t;
    struct arkode_integrator *own = data;
    values[0] = contact_ode_approach(own->base.ode, N_VGetArrayPointer(y));
    return 0;
}

static bool restart(struct integrator *integrator, double t)
{
    struct arkode_integrator *own = (struct arkode_integrator *)integrator;
    return ERKStepReInit(own->arkode, rate, t, own->y) == 0;
}

static enum integrator_event advance(struct integrator *integrator, double until, double *t)
{
    struct arkode_integrator *own = (struct arkode_integrator *)integrator;
    int code = ERKStepEvolve(own->arkode, until, own->y, t, ARK_NORMAL);
    if (code == ARK_ROOT_RETURN)
        return INTEGRATOR_ROOT;
    return code == ARK_SUCCESS ? INTEGRATOR_REACHED : INTEGRATOR_FAILED;
}

static void release(struct integrator *integrator)
{
    struct arkode_integrator *own = (struct arkode_integrator *)integrator;
    if (own->arkode)
        ERKStepFree(&own->arkode);
    if (own->y)
        N_VDestroy(own->y);
    if (own->absolute)
        N_VDestroy(own->absolute);
    if (own->context)
        SUNContext_Free(&own->context);
    free(own);
}

static const struct integrator_operations operations = {restart, advance, release};

static bool open_arkode(struct arkode_integrator *own, const struct integrator_settings *settings)
{
    sunindextype size = (sunindextype)(2 * own->base.ode->stride);
    int table = settings->order == 8 ? ARKODE_FEHLBERG_13_7_8 : ARKODE_DORMAND_PRINCE_7_4_5;
    if (SUNContext_Create(NULL, &own->context))
        return false;
    own->y = N_VNew_Serial(size, own->context);
    own->absolute = N_VNew_Serial(size, own->context);
    if (!own->y || !own->absolute)
        return false;
    own->base.y = N_VGetArrayPointer(own->y);
    N_VConst(0.0, own->y);
    contact_ode_weights(own->base.ode, settings->tolerance, settings->energetic,
                        N_VGetArrayPointer(own->absolute));
    own->arkode = ERKStepCreate(rate, 0.0, own->y, own->context);
    /* roots are found on a cubic between steps: order 8 must not outrun it */
    double contact = own->base.ode->magnitude / own->base.ode->speed;
    double longest = settings->order == 8 ? contact / 30.0 : 0.0; /* 0: no limit */
    return own->arkode && ERKStepSetMaxStep(own->arkode, longest) == 0 &&
           ERKStepSetTableNum(own->arkode, table) == 0 &&
           ERKStepSVtolerances(own->arkode, settings->tolerance, own->absolute) == 0 &&
           ERKStepSetUserData(own->arkode, own) == 0 &&
           ERKStepSetMaxNumSteps(own->arkode, 100000000) == 0 &&
           ERKStepSetMaxHnilWarns(own->arkode, -1) == 0 &&
           ERKStepRootInit(own->arkode, 1, roots) == 0 &&
           ERKStepSetNoInactiveRootWarn(own->arkode) == 0;
}

struct integrator *integrator_explicit(struct contact_ode *ode,
                                       const struct integrator_settings *settings)
{
    struct arkode_integrator *own = calloc(1, sizeof *own);
    if (!own)
        return NULL;
    own->base.operations = &operations;
    own->base.ode = ode;
    if (!open_arkode(own, settings)) {
        release(&own->base);
        return NULL;
    }
    return &own->base;
}
