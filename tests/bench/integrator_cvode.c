/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_linearsolver.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "integrator.h"

struct cvode_integrator {
    struct integrator base;
    SUNContext context;
    N_Vector y, absolute;
    SUNNonlinearSolver fixed_point; /* Adams */
    SUNLinearSolver linear;         /* BDF */
    void *cvode;
};

static int rate(double t, N_Vector y, N_Vector result, void *data)
{
    (void)t;
    struct cvode_integrator *own = data;
    contact_ode_rate(own->base.ode, N_VGetArrayPointer(y), N_VGetArrayPointer(result));
    return 0;
}

static int roots(double t, N_Vector y, double *values, void *data)
{
    (void)t;
    struct cvode_integrator *own = data;
    values[0] = contact_ode_approach(own->base.ode, N_VGetArrayPointer(y));
    return 0;
}

/* Newton's linear systems solved exactly in O(modes): the right-hand side has just been evaluated
 * at the iterate, so that the tangent is the current one. */
static int solve_linear(SUNLinearSolver solver, SUNMatrix none, N_Vector x, N_Vector b,
                        double tolerance)
{
    (void)none;
    (void)tolerance;
    struct cvode_integrator *own = solver->content;
    double gamma;
    if (CVodeGetCurrentGamma(own->cvode, &gamma))
        return 1;
    memcpy(N_VGetArrayPointer(x), N_VGetArrayPointer(b),
           2 * own->base.ode->stride * sizeof(double));
    contact_ode_newton(own->base.ode, gamma, N_VGetArrayPointer(x));
    return 0;
}

static SUNLinearSolver_Type linear_type(SUNLinearSolver solver)
{
    (void)solver;
    return SUNLINEARSOLVER_MATRIX_EMBEDDED;
}

static int free_linear(SUNLinearSolver solver)
{
    solver->content = NULL; /* belongs to the integrator */
    SUNLinSolFreeEmpty(solver);
    return 0;
}

static bool attach_newton(struct cvode_integrator *own)
{
    own->linear = SUNLinSolNewEmpty(own->context);
    if (!own->linear)
        return false;
    own->linear->content = own;
    own->linear->ops->gettype = linear_type;
    own->linear->ops->solve = solve_linear;
    own->linear->ops->free = free_linear;
    return CVodeSetLinearSolver(own->cvode, own->linear, NULL) == 0;
}

static bool attach_fixed_point(struct cvode_integrator *own)
{
    own->fixed_point = SUNNonlinSol_FixedPoint(own->y, 0, own->context);
    return own->fixed_point && CVodeSetNonlinearSolver(own->cvode, own->fixed_point) == 0;
}

static bool restart(struct integrator *integrator, double t)
{
    struct cvode_integrator *own = (struct cvode_integrator *)integrator;
    return CVodeReInit(own->cvode, t, own->y) == 0;
}

static enum integrator_event advance(struct integrator *integrator, double until, double *t)
{
    struct cvode_integrator *own = (struct cvode_integrator *)integrator;
    int code = CVode(own->cvode, until, own->y, t, CV_NORMAL);
    if (code == CV_ROOT_RETURN)
        return INTEGRATOR_ROOT;
    return code == CV_SUCCESS ? INTEGRATOR_REACHED : INTEGRATOR_FAILED;
}

static void release(struct integrator *integrator)
{
    struct cvode_integrator *own = (struct cvode_integrator *)integrator;
    if (own->cvode)
        CVodeFree(&own->cvode);
    if (own->fixed_point)
        SUNNonlinSolFree(own->fixed_point);
    if (own->linear)
        SUNLinSolFree(own->linear);
    if (own->y)
        N_VDestroy(own->y);
    if (own->absolute)
        N_VDestroy(own->absolute);
    if (own->context)
        SUNContext_Free(&own->context);
    free(own);
}

static const struct integrator_operations operations = {restart, advance, release};

static bool open_cvode(struct cvode_integrator *own, bool bdf,
                       const struct integrator_settings *settings)
{
    sunindextype size = (sunindextype)(2 * own->base.ode->stride);
    if (SUNContext_Create(NULL, &own->context))
        return false;
    own->y = N_VNew_Serial(size, own->context);
    own->absolute = N_VNew_Serial(size, own->context);
    own->cvode = CVodeCreate(bdf ? CV_BDF : CV_ADAMS, own->context);
    if (!own->y || !own->absolute || !own->cvode)
        return false;
    own->base.y = N_VGetArrayPointer(own->y);
    N_VConst(0.0, own->y);
    contact_ode_weights(own->base.ode, settings->tolerance, settings->energetic,
                        N_VGetArrayPointer(own->absolute));
    return CVodeInit(own->cvode, rate, 0.0, own->y) == 0 &&
           CVodeSVtolerances(own->cvode, settings->tolerance, own->absolute) == 0 &&
           CVodeSetUserData(own->cvode, own) == 0 &&
           (bdf ? attach_newton(own) : attach_fixed_point(own)) &&
           CVodeSetMaxNumSteps(own->cvode, 100000000) == 0 &&
           CVodeSetMaxHnilWarns(own->cvode, -1) == 0 && CVodeRootInit(own->cvode, 1, roots) == 0 &&
           CVodeSetNoInactiveRootWarn(own->cvode) == 0 &&
           (settings->order == 0 || CVodeSetMaxOrd(own->cvode, settings->order) == 0);
}

static struct integrator *make(struct contact_ode *ode, bool bdf,
                               const struct integrator_settings *settings)
{
    struct cvode_integrator *own = calloc(1, sizeof *own);
    if (!own)
        return NULL;
    own->base.operations = &operations;
    own->base.ode = ode;
    if (!open_cvode(own, bdf, settings)) {
        release(&own->base);
        return NULL;
    }
    return &own->base;
}

struct integrator *integrator_adams(struct contact_ode *ode,
                                    const struct integrator_settings *settings)
{
    return make(ode, false, settings);
}

struct integrator *integrator_bdf(struct contact_ode *ode,
                                  const struct integrator_settings *settings)
{
    return make(ode, true, settings);
}
