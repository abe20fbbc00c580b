/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/kept_factor.h"

#include <stdlib.h>
#include <string.h>
#include <zmumps_c.h>

/* MUMPS's own word for "the communicator of everybody" where there is no MPI */
static const MUMPS_INT COMM_WORLD = -987654;
enum { JOB_INIT = -1, JOB_END = -2, JOB_ANALYSE_FACTOR = 4, JOB_SOLVE = 3 };
enum { SYMMETRIC = 2, HOST_WORKS = 1, SCOTCH = 3 };
/* Right-hand sides solved at a time: more take memory and save nothing. */
static const MUMPS_INT SIDES_AT_A_TIME = 32;

struct kept_factor {
    ZMUMPS_STRUC_C mumps;
    MUMPS_INT *rows, *columns;
    mumps_double_complex *values;
    size_t freedoms;
};

/* entries of the upper triangle; a held freedom has its own equation 1 x = right */
static size_t fill(const struct system3 *system, double complex s, struct kept_factor *factor)
{
    size_t used = 0;
    for (size_t i = 0; i < system->nodes; i++)
        for (size_t b = system->first[i]; b < system->first[i + 1]; b++)
            for (size_t c = 0; c < 9; c++) {
                size_t row = 3 * i + c / 3, column = 3 * system->columns[b] + c % 3;
                bool held = system->held[row] || system->held[column];
                if (row > column || (held && row != column))
                    continue;
                double complex value = system->stiffness[b][c];
                if (c / 3 == c % 3)
                    value += s * system->mass[b];
                if (held)
                    value = 1.0;
                factor->rows[used] = (MUMPS_INT)row + 1;
                factor->columns[used] = (MUMPS_INT)column + 1;
                factor->values[used++] = (mumps_double_complex){creal(value), cimag(value)};
            }
    return used;
}

static bool prepare(const struct system3 *system, double complex s, struct kept_factor *factor)
{
    size_t room = 9 * system->first[system->nodes];
    factor->freedoms = system->freedoms;
    factor->rows = malloc(room * sizeof *factor->rows);
    factor->columns = malloc(room * sizeof *factor->columns);
    factor->values = malloc(room * sizeof *factor->values);
    if (!factor->rows || !factor->columns || !factor->values)
        return false;
    ZMUMPS_STRUC_C *mumps = &factor->mumps;
    mumps->n = (MUMPS_INT)system->freedoms;
    mumps->nnz = (MUMPS_INT8)fill(system, s, factor);
    mumps->irn = factor->rows;
    mumps->jcn = factor->columns;
    mumps->a = factor->values;
    return true;
}

enum percuss_status kept_factor_create(const struct system3 *system, double complex s,
                                       struct kept_factor **made, struct fault *fault)
{
    *made = NULL;
    struct kept_factor *factor = calloc(1, sizeof *factor);
    if (!factor)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    ZMUMPS_STRUC_C *mumps = &factor->mumps;
    mumps->job = JOB_INIT;
    mumps->par = HOST_WORKS;
    mumps->sym = SYMMETRIC;
    mumps->comm_fortran = COMM_WORLD;
    zmumps_c(mumps);
    /* silent; fill-reducing order by Scotch; numbers of control as its manual counts them, from 1
     */
    mumps->icntl[0] = mumps->icntl[1] = mumps->icntl[2] = -1;
    mumps->icntl[3] = 0;
    mumps->icntl[6] = SCOTCH;
    mumps->icntl[26] = SIDES_AT_A_TIME;
    bool prepared = prepare(system, s, factor);
    if (prepared) {
        mumps->job = JOB_ANALYSE_FACTOR;
        zmumps_c(mumps);
    }
    if (!prepared || mumps->infog[0] < 0) {
        int code = prepared ? (int)mumps->infog[0] : 0;
        kept_factor_free(factor);
        return fault_set(fault, PERCUSS_INTERNAL, "MUMPS: error %d for %zu freedoms", code,
                         system->freedoms);
    }
    /* the factor is in MUMPS's own memory now */
    free(factor->rows);
    free(factor->columns);
    free(factor->values);
    factor->rows = factor->columns = NULL;
    factor->values = NULL;
    *made = factor;
    return PERCUSS_OK;
}

void kept_factor_free(struct kept_factor *factor)
{
    if (!factor)
        return;
    factor->mumps.job = JOB_END;
    zmumps_c(&factor->mumps);
    free(factor->rows);
    free(factor->columns);
    free(factor->values);
    free(factor);
}

bool kept_factor_solve(struct kept_factor *factor, size_t count, double complex *right)
{
    ZMUMPS_STRUC_C *mumps = &factor->mumps;
    /* C's complex numbers lie in memory as MUMPS's do: real, imaginary */
    mumps->rhs = (mumps_double_complex *)right;
    mumps->nrhs = (MUMPS_INT)count;
    mumps->lrhs = (MUMPS_INT)factor->freedoms;
    mumps->job = JOB_SOLVE;
    zmumps_c(mumps);
    return mumps->infog[0] >= 0;
}

double kept_factor_size(const struct kept_factor *factor)
{
    /* INFOG(29); in millions where negative */
    double size = factor->mumps.infog[28];
    return size < 0.0 ? -1e6 * size : size;
}
