/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* One elastic-plastic body of a contact region: a half-space, meshed near the contact, with a far
 * boundary that moves as the point load's exact field, so that displacements are relative to
 * infinity.
 *
 * Nodes count from the outside in, and plastic flow stays inside: the far rings are elastic, their
 * rows are factored once, and a Newton step factors only the plastic zone. */
#ifndef PERCUSS_FE_SOLID_H
#define PERCUSS_FE_SOLID_H

#include "base/fault.h"
#include "fe/mesh.h"
#include "fe/quad.h"

struct solid;

/* `mesh` is a mesh_half_space and `quads` has its elements; both stay the caller's and must outlive
 * the solid. `candidates`: most contact nodes that will ever carry force. NULL: no memory, or the
 * elastic matrix is not positive definite. */
struct solid *solid_create(const struct mesh *mesh, const struct quad *quads,
                           const struct material *material, size_t candidates);
void solid_destroy(struct solid *solid);

/* Stresses and trial histories of the present displacements, from the histories at the step's
 * start. Returns the largest force out of balance when contact node i < count carries forces[i] >=
 * 0 N inward. */
double solid_balance(struct solid *solid, size_t count, const double *forces);

/* Linearises about the present displacements. With contact forces f (count of them, inward) the
 * outward displacement of contact node i would be offset[i] - sum_j compliance[i * count + j] f_j.
 * Follows solid_balance. `loading`: points at their yield stress are about to flow on; else only
 * those that do flow are soft. False: the tangent is not positive definite. */
bool solid_linearise(struct solid *solid, size_t count, bool loading, double *offset,
                     double *compliance);

/* Moves to the linearised solution with these forces. */
void solid_move(struct solid *solid, size_t count, const double *forces);

/* Whether an element that was taken for elastic would flow; widens the plastic zone if so. */
bool solid_zone_grew(struct solid *solid);

/* False: the plastic zone has come within reach of the far boundary. */
bool solid_fits(const struct solid *solid);

/* A step's start: solid_begin takes up the last commit, solid_advance the present state (a step
 * within a step), solid_retreat goes back to the start, solid_commit makes the present state the
 * one to return to. */
void solid_begin(struct solid *solid);
void solid_advance(struct solid *solid);
void solid_retreat(struct solid *solid);
void solid_commit(struct solid *solid);

/* Outward displacement of contact node i, m. */
double solid_surface(struct solid *solid, size_t i);

/* Largest accumulated plastic strain at the last solid_balance; 0: elastic. */
double solid_flow(const struct solid *solid);

/* Work that has gone into plastic flow from the virgin state to the present, J (hardening's share
 * included), and the energy of the elastic strains within the mesh, J. */
double solid_plastic_work(const struct solid *solid);
double solid_elastic_energy(struct solid *solid);

#endif
