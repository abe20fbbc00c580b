/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/bulk.h"

#include <math.h>
#include <stdint.h>

#include "mesh/element.h"
#include "model/vector.h"

/* det J at the nodes, where a curved element folds first. */
static double smallest_at_nodes(enum element_type type, double (*points)[3])
{
    double smallest = INFINITY;
    for (size_t n = 0; n < element_node_count(type); n++) {
        double at[3], shape[ELEMENT_MOST_NODES], gradient[ELEMENT_MOST_NODES][3];
        struct element_point here;
        element_node(type, n, at);
        element_shapes(type, at, shape, gradient);
        element_map(element_node_count(type), points, shape, gradient, &here);
        smallest = fmin(smallest, here.volume);
    }
    return smallest;
}

/* first and second moments about the origin */
static void bulk_add_point(double mass, const double place[3], struct bulk *bulk)
{
    add_scaled3(mass, place, bulk->centre);
    double square = dot3(place, place);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            bulk->inertia[3 * i + j] += mass * ((i == j ? square : 0.0) - place[i] * place[j]);
}

/* Adds one element's volume, first and second moments of mass about the origin. */
static double bulk_add_element(const struct element_rule *rule, double (*points)[3], double density,
                               struct bulk *bulk, double *smallest)
{
    double volume = 0.0;
    for (size_t p = 0; p < rule->point_count; p++) {
        struct element_point here;
        element_at(rule, p, points, &here);
        double mass = density * here.volume;
        volume += here.volume;
        *smallest = fmin(*smallest, here.volume / rule->weight[p]);
        bulk_add_point(mass, here.position, bulk);
    }
    bulk->mass += density * volume;
    bulk->volume += volume;
    return volume;
}

double bulk_element_det(const struct solid_mesh *mesh, size_t element, double *volume)
{
    enum element_type type = mesh->types[element];
    struct element_rule rule;
    struct bulk none = {0};
    double points[ELEMENT_MOST_NODES][3];
    element_rule_make(type, &rule);
    element_points(mesh, element, points);
    double smallest = smallest_at_nodes(type, points);
    *volume = bulk_add_element(&rule, points, 0.0, &none, &smallest);
    return smallest * element_natural_volume(type) / fabs(*volume);
}

/* the elements of a part; `part` SIZE_MAX: all */
static void bulk_add_elements(const struct solid_mesh *mesh, size_t part, struct bulk *bulk)
{
    /* type by type, each with its rule */
    for (enum element_type type = ELEMENT_TET10; type < ELEMENT_TYPES; type++) {
        struct element_rule rule;
        element_rule_make(type, &rule);
        for (size_t e = 0; e < mesh->element_count; e++) {
            if (mesh->types[e] != type || (part != SIZE_MAX && mesh->parts[e] != part))
                continue;
            double points[ELEMENT_MOST_NODES][3];
            element_points(mesh, e, points);
            double smallest = smallest_at_nodes(type, points);
            double density = mesh->part[mesh->parts[e]].material.density;
            double volume = bulk_add_element(&rule, points, density, bulk, &smallest);
            smallest *= element_natural_volume(type) / fabs(volume);
            if (smallest < bulk->smallest_det) {
                bulk->smallest_det = smallest;
                bulk->smallest_at = e;
            }
            bulk->smallest_volume = fmin(bulk->smallest_volume, volume);
            bulk->largest_volume = fmax(bulk->largest_volume, volume);
            bulk->element_count++;
        }
    }
}

static void bulk_sum(const struct solid_mesh *mesh, size_t part, struct bulk *bulk)
{
    *bulk = (struct bulk){.smallest_det = INFINITY, .smallest_volume = INFINITY};
    bulk_add_elements(mesh, part, bulk);
    for (size_t i = 0; part == SIZE_MAX && i < mesh->mass_count; i++) {
        bulk_add_point(mesh->masses[i].mass, mesh->points[mesh->masses[i].node], bulk);
        bulk->nodes_mass += mesh->masses[i].mass;
    }
    bulk->mass += bulk->nodes_mass;
    /* inertia about the centre of mass (Steiner) */
    scale3(1.0 / bulk->mass, bulk->centre, bulk->centre);
    double square = dot3(bulk->centre, bulk->centre);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            bulk->inertia[3 * i + j] -=
                bulk->mass * ((i == j ? square : 0.0) - bulk->centre[i] * bulk->centre[j]);
}

void bulk_of(const struct solid_mesh *mesh, struct bulk *bulk)
{
    bulk_sum(mesh, SIZE_MAX, bulk);
}

void bulk_of_part(const struct solid_mesh *mesh, size_t part, struct bulk *bulk)
{
    bulk_sum(mesh, part, bulk);
}
