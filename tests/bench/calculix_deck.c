/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Writes an input deck for CalculiX: the indentation of our table, with the same far boundary
 * condition, on a mesh of its own. The contact force CalculiX finds is to be ours. usage:
 * calculix_deck INDENTATION YIELD RESOLUTION > deck.inp (our force and its relative error on
 * stderr) */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fe/boussinesq.h"
#include "fe/indentation.h"
#include "fe/mesh.h"

static const double RADIUS = 0.015;

/* Surface of the indenter over the flat: a paraboloid under the contact and well around it, then
 * level, so that the body stays a half-space at large. */
static double rise(double r, double reach)
{
    double x = fmin(r, reach);
    return 0.5 * x * x / RADIUS;
}

/* our table's force at the indentation: over Hertz's, linear in its logarithm between points */
static double own_force(const struct region_input *input)
{
    struct indentation_table table;
    struct fault fault = {{0}};
    double d = input->indentation;
    if (indentation_table_make(input, NULL, &table, &fault) != PERCUSS_OK) {
        fprintf(stderr, "%s\n", fault.text);
        exit(1);
    }
    double ratio = 1.0;
    for (size_t i = 1; i < table.points && table.indentation[i - 1] < d; i++) {
        double part = log(d / table.indentation[i - 1]) /
                      log(table.indentation[i] / table.indentation[i - 1]);
        double low = table.force[i - 1] / pow(table.indentation[i - 1], 1.5);
        double high = table.force[i] / pow(table.indentation[i], 1.5);
        ratio = (low + part * (high - low)) / table.hertz;
    }
    double force = ratio * table.hertz * pow(d, 1.5);
    fprintf(stderr, "%.8g %.2g\n", force, table.force_error);
    indentation_table_free(&table);
    return force;
}

/* body 0 below (z as it is), body 1 above (turned over); node numbers of body 1 follow */
static void write_body(const struct mesh *mesh, int body, double reach)
{
    size_t base = body * mesh->nodes;
    printf("*NODE\n");
    for (size_t i = 0; i < mesh->nodes; i++)
        printf("%zu, %.12e, %.12e, 0\n", base + i + 1, mesh->r[i],
               body ? -mesh->z[i] + rise(mesh->r[i], reach) : mesh->z[i]);
    printf("*ELEMENT, TYPE=CAX4, ELSET=E%d\n", body);
    for (size_t e = 0; e < mesh->elements; e++) {
        const uint32_t *q = mesh->quads[e];
        printf("%zu", body * mesh->elements + e + 1);
        for (int i = 0; i < 4; i++)
            printf(", %zu", base + q[body ? 3 - i : i] + 1);
        printf("\n");
    }
    printf("*NSET, NSET=AXIS%d\n", body);
    for (size_t i = 0; i < mesh->axis.count; i++)
        printf("%zu,\n", base + mesh->axis.index[i] + 1);
    printf("*NSET, NSET=FAR%d\n", body);
    for (size_t i = 0; i < mesh->far.count; i++)
        printf("%zu,\n", base + mesh->far.index[i] + 1);
}

/* element faces between neighbouring contact nodes */
static void write_surface(const struct mesh *mesh, int body, double reach)
{
    printf("*SURFACE, NAME=S%d, TYPE=ELEMENT\n", body);
    for (size_t k = 0; k + 1 < mesh->contact.count; k++) {
        uint32_t a = mesh->contact.index[k], b = mesh->contact.index[k + 1];
        if (mesh->r[b] > reach)
            break;
        for (size_t e = 0; e < mesh->elements; e++)
            for (int i = 0; i < 4; i++) {
                int j = (i + 1) % 4;
                uint32_t p = mesh->quads[e][body ? 3 - i : i];
                uint32_t q = mesh->quads[e][body ? 3 - j : j];
                if ((p == a && q == b) || (p == b && q == a))
                    printf("%zu, S%d\n", body * mesh->elements + e + 1, i + 1);
            }
    }
}

static void write_boundary(const struct mesh *mesh, int body, const struct material *material,
                           double force, double indentation)
{
    for (size_t i = 0; i < mesh->far.count; i++) {
        uint32_t n = mesh->far.index[i];
        double u[2];
        boussinesq_displacement(material->young, material->poisson, mesh->r[n], mesh->z[n], u);
        size_t id = body * mesh->nodes + n + 1;
        printf("%zu, 1, 1, %.12e\n", id, force * u[0]);
        printf("%zu, 2, 2, %.12e\n", id, body ? -force * u[1] - indentation : force * u[1]);
    }
}

static void write_material(const struct material *m, int body)
{
    printf("*MATERIAL, NAME=M%d\n*ELASTIC\n%.6e, %.4f\n", body, m->young, m->poisson);
    if (isfinite(m->yield))
        printf("*PLASTIC\n%.6e, 0\n%.6e, 1\n", m->yield, m->yield * 1.00001);
    printf("*SOLID SECTION, ELSET=E%d, MATERIAL=M%d\n", body, body);
}

int main(int count, char **arguments)
{
    if (count != 4) {
        fprintf(stderr, "usage: calculix_deck INDENTATION YIELD RESOLUTION\n");
        return 2;
    }
    double d = atof(arguments[1]);
    struct region_input input = {{{"flat", 70e9, 0.33, 2700.0, atof(arguments[2]), 0.0},
                                  {"indenter", 210e9, 0.30, 7800.0, INFINITY, 0.0}},
                                 RADIUS,
                                 d,
                                 12,
                                 0.0};
    double force = own_force(&input);
    double top = sqrt(2.0 * RADIUS * d);
    size_t core = (size_t)atoi(arguments[3]);
    struct mesh_grade grade = {.size = 1.1 * top / (double)core, .core = core, .growth = 1.1};
    struct mesh mesh;
    struct fault fault;
    if (mesh_half_space(15.0 * top, &grade, &mesh, &fault) != PERCUSS_OK) {
        fprintf(stderr, "%s\n", fault.text);
        return 1;
    }
    for (int body = 0; body < 2; body++) {
        write_body(&mesh, body, 2.5 * top);
        write_surface(&mesh, body, 2.0 * top);
        write_material(&input.materials[body], body);
    }
    printf("*SURFACE INTERACTION, NAME=SI\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n%.3e, "
           "1e3\n",
           50.0 * 210e9 / grade.size);
    printf("*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\nS0, S1\n");
    printf("*BOUNDARY\nAXIS0, 1, 1\nAXIS1, 1, 1\n");
    printf("*STEP, INC=1000\n*STATIC\n0.02, 1, 1e-6, 0.03\n*BOUNDARY\n");
    write_boundary(&mesh, 0, &input.materials[0], force, d);
    write_boundary(&mesh, 1, &input.materials[1], force, d);
    printf("*NODE PRINT, NSET=FAR0, TOTALS=ONLY, FREQUENCY=1000\nRF\n*END STEP\n");
    mesh_free(&mesh);
    return 0;
}
