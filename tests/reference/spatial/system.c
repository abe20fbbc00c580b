/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "spatial/system.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* adds the part of one point: lambda g_i g_j' + mu (g_j g_i' + (g_i . g_j) 1) for each two nodes */
static void add_point(const double *shape, double (*gradient)[3], const double modulus[3],
                      double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS],
                      double mass[BRICK_NODES][BRICK_NODES])
{
    double lambda = modulus[0], mu = modulus[1];
    for (int i = 0; i < BRICK_NODES; i++)
        for (int j = 0; j <= i; j++) {
            const double *a = gradient[i], *b = gradient[j];
            double dot = mu * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
            for (int x = 0; x < 3; x++)
                for (int y = 0; y < 3; y++)
                    stiffness[3 * i + x][3 * j + y] +=
                        lambda * a[x] * b[y] + mu * b[x] * a[y] + (x == y ? dot : 0.0);
            mass[i][j] += modulus[2] * shape[i] * shape[j];
        }
}

bool brick_matrices(double points[ELEMENT_MOST_NODES][3], const struct material *material,
                    double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS],
                    double mass[BRICK_NODES][BRICK_NODES])
{
    memset(stiffness, 0, sizeof(double) * BRICK_FREEDOMS * BRICK_FREEDOMS);
    memset(mass, 0, sizeof(double) * BRICK_NODES * BRICK_NODES);
    double mu = material_shear_modulus(material);
    double lambda = 2.0 * mu * material->poisson / (1.0 - 2.0 * material->poisson);
    struct element_rule rule;
    element_rule_make(ELEMENT_HEX27, &rule);
    /* the lower triangle point by point; the map has one hand throughout */
    double hand = 0.0;
    for (size_t p = 0; p < rule.point_count; p++) {
        struct element_point point;
        element_at(&rule, p, points, &point);
        hand = p == 0 ? point.volume : hand;
        if (!(point.volume * hand > 0.0))
            return false;
        double volume = fabs(point.volume);
        double modulus[3] = {lambda * volume, mu * volume, material->density * volume};
        add_point(rule.shape[p], point.gradient, modulus, stiffness, mass);
    }
    /* the upper one */
    for (int i = 0; i < BRICK_FREEDOMS; i++)
        for (int j = 0; j < i; j++)
            stiffness[j][i] = stiffness[i][j];
    for (int i = 0; i < BRICK_NODES; i++)
        for (int j = 0; j < i; j++)
            mass[j][i] = mass[i][j];
    return true;
}

/* Nodes nearer than this to a plane of symmetry lie on it: m. */
static const double ON_PLANE = 1e-9;
/* The same for the held edge, over its distance. */
static const double AT_EDGE = 1e-9;

/* A brick's matrices in the free nodes that its own nodes depend on. */
enum { MOST_MASTERS = 128 };
struct reduced {
    size_t count, masters[MOST_MASTERS];
    double share[BRICK_NODES][MOST_MASTERS]; /* of each own node */
};

static size_t column_of(struct reduced *reduced, size_t master)
{
    for (size_t i = 0; i < reduced->count; i++)
        if (reduced->masters[i] == master)
            return i;
    if (reduced->count == MOST_MASTERS)
        return SIZE_MAX;
    reduced->masters[reduced->count] = master;
    return reduced->count++;
}

static bool reduce(const struct refined *mesh, const struct system3 *system,
                   const struct refined_brick *brick, struct reduced *reduced)
{
    memset(reduced, 0, sizeof *reduced);
    for (int n = 0; n < BRICK_NODES; n++) {
        size_t node = brick->nodes[n], from = mesh->first[node], to = mesh->first[node + 1];
        size_t own = system->index[node];
        for (size_t i = from; i < to || (i == from && from == to); i++) {
            size_t master = from == to ? own : system->index[mesh->masters[i]];
            size_t column = column_of(reduced, master);
            if (column == SIZE_MAX)
                return false;
            reduced->share[n][column] += from == to ? 1.0 : mesh->weights[i];
        }
    }
    return true;
}

static int by_number(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* sorted, each once */
static size_t unique(uint64_t *keys, size_t count)
{
    size_t kept = 0;
    /* an empty list has no array */
    if (count > 0)
        qsort(keys, count, sizeof *keys, by_number);
    for (size_t i = 0; i < count; i++)
        if (i == 0 || keys[i] != keys[i - 1])
            keys[kept++] = keys[i];
    return kept;
}

/* the blocks, as row << 32 | column; NULL: no memory */
static uint64_t *list_blocks(const struct refined *mesh, const struct system3 *system,
                             size_t *count)
{
    size_t used = 0, room = 0;
    uint64_t *keys = NULL;
    struct reduced reduced;
    for (size_t b = 0; b < mesh->brick_count; b++) {
        bool fits = reduce(mesh, system, &mesh->bricks[b], &reduced);
        /* room for this brick's blocks: first by dropping duplicates */
        size_t more = reduced.count * reduced.count;
        if (fits && used + more > room) {
            used = unique(keys, used);
            if (2 * used + more > room) {
                room = 4 * (used + more) + 100000;
                uint64_t *grown = realloc(keys, room * sizeof *keys);
                fits = grown != NULL;
                keys = grown ? grown : keys;
            }
        }
        if (!fits) {
            free(keys);
            return NULL;
        }
        for (size_t i = 0; i < reduced.count; i++)
            for (size_t j = 0; j < reduced.count; j++)
                if (reduced.masters[i] <= reduced.masters[j])
                    keys[used++] = (uint64_t)reduced.masters[i] << 32 | reduced.masters[j];
    }
    *count = unique(keys, used);
    return keys;
}

static bool make_pattern(const struct refined *mesh, struct system3 *system)
{
    size_t count = 0;
    uint64_t *keys = list_blocks(mesh, system, &count);
    system->first = calloc(system->nodes + 1, sizeof *system->first);
    system->columns = malloc(count * sizeof *system->columns);
    system->stiffness = calloc(count, sizeof *system->stiffness);
    system->mass = calloc(count, sizeof *system->mass);
    bool made = keys && system->first && system->columns && system->stiffness && system->mass;
    for (size_t i = 0; made && i < count; i++) {
        system->first[(keys[i] >> 32) + 1] = i + 1;
        system->columns[i] = (size_t)(keys[i] & 0xffffffffu);
    }
    free(keys);
    return made;
}

static size_t block_of(const struct system3 *system, size_t row, size_t column)
{
    size_t low = system->first[row], high = system->first[row + 1];
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        *(system->columns[middle] <= column ? &low : &high) = middle;
    }
    return low;
}

/* one block of a brick's matrices in its masters: sums over its own nodes that have a share */
static void add_block(const struct reduced *reduced, const size_t which[2],
                      const double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS],
                      const double mass[BRICK_NODES][BRICK_NODES], struct system3 *system)
{
    size_t row = reduced->masters[which[0]], column = reduced->masters[which[1]];
    size_t block = block_of(system, row, column);
    double *sum = system->stiffness[block];
    for (int m = 0; m < BRICK_NODES; m++) {
        double left = reduced->share[m][which[0]];
        for (int n = 0; left != 0.0 && n < BRICK_NODES; n++) {
            double share = left * reduced->share[n][which[1]];
            if (share == 0.0)
                continue;
            system->mass[block] += share * mass[m][n];
            for (int c = 0; c < 9; c++)
                if (!system->held[3 * row + c / 3] && !system->held[3 * column + c % 3])
                    sum[c] += share * stiffness[3 * m + c / 3][3 * n + c % 3];
        }
    }
}

static enum percuss_status fill(const struct refined *mesh, const struct material *material,
                                struct system3 *system, struct fault *fault)
{
    struct reduced reduced;
    double points[ELEMENT_MOST_NODES][3], mass[BRICK_NODES][BRICK_NODES];
    double stiffness[BRICK_FREEDOMS][BRICK_FREEDOMS];
    for (size_t b = 0; b < mesh->brick_count; b++) {
        /* a brick's own matrices */
        const struct refined_brick *brick = &mesh->bricks[b];
        for (int n = 0; n < BRICK_NODES; n++)
            memcpy(points[n], mesh->points[brick->nodes[n]], sizeof points[n]);
        if (!brick_matrices(points, material, stiffness, mass))
            return fault_set(fault, PERCUSS_INTERNAL,
                             "brick %zu of block %zu with a corner at (%g, %g, %g) m is folded", b,
                             brick->block, points[0][0], points[0][1], points[0][2]);
        /* hanging nodes to their masters, then the blocks above the diagonal */
        reduce(mesh, system, brick, &reduced);
        for (size_t i = 0; i < reduced.count; i++)
            for (size_t j = 0; j < reduced.count; j++)
                if (reduced.masters[i] <= reduced.masters[j])
                    add_block(&reduced, (const size_t[2]){i, j},
                              (const double(*)[BRICK_FREEDOMS])stiffness,
                              (const double(*)[BRICK_NODES])mass, system);
        /* its mass, for any shares */
        for (int m = 0; m < BRICK_NODES; m++)
            for (int n = 0; n < BRICK_NODES; n++)
                system->whole += mass[m][n];
    }
    return PERCUSS_OK;
}

static bool number_free(const struct refined *mesh, struct system3 *system)
{
    system->index = malloc(mesh->node_count * sizeof *system->index);
    system->held = calloc(3 * mesh->node_count, sizeof *system->held);
    system->points = malloc(mesh->node_count * sizeof *system->points);
    if (!system->index || !system->held || !system->points)
        return false;
    for (size_t n = 0; n < mesh->node_count; n++) {
        system->index[n] = SIZE_MAX;
        if (mesh->first[n + 1] > mesh->first[n])
            continue;
        /* nodes stay on their plane of symmetry, the edge is held */
        const double *point = mesh->points[n];
        size_t i = system->nodes++;
        system->index[n] = i;
        memcpy(system->points[i], point, sizeof *system->points);
        bool at_edge = false;
        for (int c = 0; c < 3; c++)
            at_edge |= mesh->edge > 0.0 && fabs(point[c]) > (1.0 - AT_EDGE) * mesh->edge;
        for (size_t c = 0; c < 3; c++)
            system->held[3 * i + c] = at_edge || (c < 2 && fabs(point[c]) < ON_PLANE);
    }
    system->freedoms = 3 * system->nodes;
    return true;
}

enum percuss_status system3_create(const struct refined *mesh, const struct material *material,
                                   struct system3 *system, struct fault *fault)
{
    memset(system, 0, sizeof *system);
    enum percuss_status status = PERCUSS_OK;
    if (!number_free(mesh, system) || !make_pattern(mesh, system))
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory for the matrices of %zu nodes",
                           mesh->node_count);
    else
        status = fill(mesh, material, system, fault);
    if (status != PERCUSS_OK)
        system3_free(system);
    return status;
}

void system3_free(struct system3 *system)
{
    free(system->index);
    free(system->held);
    free(system->first);
    free(system->columns);
    free(system->stiffness);
    free(system->mass);
    free(system->points);
    memset(system, 0, sizeof *system);
}

void system3_stiffness(const struct system3 *system, const double *x, double *result)
{
    memset(result, 0, system->freedoms * sizeof *result);
    for (size_t i = 0; i < system->nodes; i++)
        for (size_t b = system->first[i]; b < system->first[i + 1]; b++) {
            size_t j = system->columns[b];
            const double *k = system->stiffness[b];
            for (size_t r = 0; r < 3; r++)
                for (size_t c = 0; c < 3; c++) {
                    result[3 * i + r] += k[3 * r + c] * x[3 * j + c];
                    if (i != j)
                        result[3 * j + c] += k[3 * r + c] * x[3 * i + r];
                }
        }
}

void system3_mass(const struct system3 *system, const double *x, double *result)
{
    memset(result, 0, system->freedoms * sizeof *result);
    for (size_t i = 0; i < system->nodes; i++)
        for (size_t b = system->first[i]; b < system->first[i + 1]; b++) {
            size_t j = system->columns[b];
            double m = system->mass[b];
            for (size_t c = 0; c < 3; c++) {
                result[3 * i + c] += m * x[3 * j + c];
                if (i != j)
                    result[3 * j + c] += m * x[3 * i + c];
            }
        }
    for (size_t f = 0; f < system->freedoms; f++)
        if (system->held[f])
            result[f] = 0.0;
}

double system3_mean(const struct system3 *system, const double *x, int c)
{
    double sum = 0.0;
    for (size_t i = 0; i < system->nodes; i++)
        for (size_t b = system->first[i]; b < system->first[i + 1]; b++) {
            size_t j = system->columns[b];
            sum += system->mass[b] * (x[3 * j + (size_t)c] + (i == j ? 0.0 : x[3 * i + (size_t)c]));
        }
    return sum / system->whole;
}
