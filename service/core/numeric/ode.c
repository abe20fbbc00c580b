/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "numeric/ode.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

struct ode {
    struct ode_problem problem;
    SUNContext context;
    N_Vector y, absolute;
    SUNNonlinearSolver fixed_point;
    SUNMatrix matrix;
    SUNLinearSolver linear;
    void *cvode;
    unsigned long rhs;
    unsigned long steps; /* of the restarts before */
};

static int call_rhs(double t, N_Vector y, N_Vector rate, void *data)
{
    struct ode *ode = data;
    ode->rhs++;
    ode->problem.rhs(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rate), ode->problem.context);
    return 0;
}

static int call_roots(double t, N_Vector y, double *roots, void *data)
{
    struct ode *ode = data;
    ode->problem.roots(t, N_VGetArrayPointer(y), roots, ode->problem.context);
    return 0;
}

/* CVODE reports through return values; its own messages stay quiet. */
static void quiet(int code, const char *module, const char *function, char *message, void *data)
{
    (void)code;
    (void)module;
    (void)function;
    (void)message;
    (void)data;
}

static bool attach_solver(struct ode *ode)
{
    if (!ode->problem.stiff) {
        ode->fixed_point = SUNNonlinSol_FixedPoint(ode->y, 0, ode->context);
        return ode->fixed_point && CVodeSetNonlinearSolver(ode->cvode, ode->fixed_point) == 0;
    }
    sunindextype size = (sunindextype)ode->problem.size;
    ode->matrix = SUNDenseMatrix(size, size, ode->context);
    ode->linear = ode->matrix ? SUNLinSol_Dense(ode->y, ode->matrix, ode->context) : NULL;
    return ode->linear && CVodeSetLinearSolver(ode->cvode, ode->linear, ode->matrix) == 0;
}

static bool open_cvode(struct ode *ode)
{
    sunindextype size = (sunindextype)ode->problem.size;
    if (SUNContext_Create(NULL, &ode->context))
        return false;
    /* variables, their tolerances and the integrator */
    ode->y = N_VNew_Serial(size, ode->context);
    ode->absolute = N_VNew_Serial(size, ode->context);
    ode->cvode = CVodeCreate(ode->problem.stiff ? CV_BDF : CV_ADAMS, ode->context);
    if (!ode->y || !ode->absolute || !ode->cvode)
        return false;
    /* the caller's tolerances are copied */
    N_VConst(0.0, ode->y);
    memcpy(N_VGetArrayPointer(ode->absolute), ode->problem.absolute,
           ode->problem.size * sizeof(double));
    ode->problem.absolute = NULL;
    /* quiet, with no limit of steps, stopping at roots */
    return CVodeSetErrHandlerFn(ode->cvode, quiet, NULL) == 0 &&
           CVodeInit(ode->cvode, call_rhs, 0.0, ode->y) == 0 &&
           CVodeSVtolerances(ode->cvode, ode->problem.relative, ode->absolute) == 0 &&
           CVodeSetUserData(ode->cvode, ode) == 0 && attach_solver(ode) &&
           CVodeSetMaxNumSteps(ode->cvode, -1) == 0 && CVodeSetMaxHnilWarns(ode->cvode, -1) == 0 &&
           CVodeRootInit(ode->cvode, (int)ode->problem.root_count, call_roots) == 0 &&
           CVodeSetNoInactiveRootWarn(ode->cvode) == 0;
}

struct ode *ode_create(const struct ode_problem *problem)
{
    struct ode *ode = calloc(1, sizeof *ode);
    if (!ode)
        return NULL;
    ode->problem = *problem;
    if (!open_cvode(ode)) {
        ode_free(ode);
        return NULL;
    }
    return ode;
}

void ode_free(struct ode *ode)
{
    if (!ode)
        return;
    /* the integrator before the objects that it uses */
    if (ode->cvode)
        CVodeFree(&ode->cvode);
    if (ode->fixed_point)
        SUNNonlinSolFree(ode->fixed_point);
    if (ode->linear)
        SUNLinSolFree(ode->linear);
    if (ode->matrix)
        SUNMatDestroy(ode->matrix);
    if (ode->y)
        N_VDestroy(ode->y);
    if (ode->absolute)
        N_VDestroy(ode->absolute);
    if (ode->context)
        SUNContext_Free(&ode->context);
    free(ode);
}

static unsigned long steps_since_restart(const struct ode *ode)
{
    long steps = 0;
    return CVodeGetNumSteps(ode->cvode, &steps) == 0 ? (unsigned long)steps : 0;
}

bool ode_set(struct ode *ode, double t, const double *y)
{
    ode->steps += steps_since_restart(ode);
    memcpy(N_VGetArrayPointer(ode->y), y, ode->problem.size * sizeof *y);
    return CVodeReInit(ode->cvode, t, ode->y) == 0;
}

bool ode_set_longest_step(struct ode *ode, double step)
{
    return CVodeSetMaxStep(ode->cvode, step) == 0;
}

enum ode_event ode_step(struct ode *ode, double until, double *t, double *y, int *found)
{
    if (CVodeSetStopTime(ode->cvode, until))
        return ODE_FAILED;
    int code = CVode(ode->cvode, until, ode->y, t, CV_ONE_STEP);
    memcpy(y, N_VGetArrayPointer(ode->y), ode->problem.size * sizeof *y);
    if (code == CV_ROOT_RETURN)
        return CVodeGetRootInfo(ode->cvode, found) == 0 ? ODE_ROOT : ODE_FAILED;
    if (code == CV_TSTOP_RETURN)
        return ODE_REACHED;
    return code == CV_SUCCESS ? ODE_STEP : ODE_FAILED;
}

void ode_effort(const struct ode *ode, unsigned long *rhs, unsigned long *steps)
{
    *rhs = ode->rhs;
    *steps = ode->steps + steps_since_restart(ode);
}
