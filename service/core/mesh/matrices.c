/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/matrices.h"

#include <stdlib.h>
#include <string.h>

#include "mesh/element.h"
#include "model/vector.h"

/* ---- symmetric sparse matrices ---- */

static bool sparse_reserve(struct sparse *matrix, size_t n, size_t entries)
{
    *matrix = (struct sparse){.n = n, .start = calloc(n + 1, sizeof *matrix->start)};
    matrix->column = malloc((entries + 1) * sizeof *matrix->column);
    matrix->value = calloc(entries + 1, sizeof *matrix->value);
    return matrix->start && matrix->column && matrix->value;
}

static int compare_sparse_entries(const void *left, const void *right)
{
    const struct sparse_entry *a = left, *b = right;
    if (a->row != b->row)
        return a->row < b->row ? -1 : 1;
    return a->column < b->column ? -1 : a->column > b->column;
}

/* Copies entries to the upper triangle (with `both` drops those below it) and sorts them; returns
 * their number. */
static size_t upper_entries(size_t count, const struct sparse_entry *entries, bool both,
                            struct sparse_entry *upper)
{
    size_t kept = 0;
    for (size_t e = 0; e < count; e++) {
        struct sparse_entry entry = entries[e];
        if (entry.row > entry.column) {
            if (both)
                continue;
            entry.row = entries[e].column;
            entry.column = entries[e].row;
        }
        upper[kept++] = entry;
    }
    qsort(upper, kept, sizeof *upper, compare_sparse_entries);
    return kept;
}

bool sparse_from_entries(struct sparse *matrix, size_t n, size_t count,
                         const struct sparse_entry *entries, bool both)
{
    struct sparse_entry *upper = malloc((count + 1) * sizeof *upper);
    *matrix = (struct sparse){.n = n, .start = calloc(n + 1, sizeof *matrix->start)};
    matrix->column = malloc((count + 1) * sizeof *matrix->column);
    matrix->value = malloc((count + 1) * sizeof *matrix->value);
    bool fine = upper && matrix->start && matrix->column && matrix->value;
    size_t filled = 0, kept = fine ? upper_entries(count, entries, both, upper) : 0;
    for (size_t e = 0; e < kept; e++) {
        /* add entries of the same place */
        if (e > 0 && compare_sparse_entries(&upper[e - 1], &upper[e]) == 0) {
            matrix->value[filled - 1] += upper[e].value;
            continue;
        }
        matrix->column[filled] = upper[e].column;
        matrix->value[filled++] = upper[e].value;
        matrix->start[upper[e].row + 1]++;
    }
    for (size_t i = 0; fine && i < n; i++)
        matrix->start[i + 1] += matrix->start[i];
    free(upper);
    if (!fine)
        sparse_free(matrix);
    return fine;
}

/* y = A x for one vector */
static void multiply_one(const struct sparse *matrix, const double *x, double *y)
{
    memset(y, 0, matrix->n * sizeof *y);
    for (size_t i = 0; i < matrix->n; i++) {
        double sum = 0.0, here = x[i];
        size_t p = matrix->start[i], end = matrix->start[i + 1];
        /* the diagonal once, other entries for both triangles */
        if (p < end && matrix->column[p] == i)
            sum = matrix->value[p++] * here;
        for (; p < end; p++) {
            size_t j = matrix->column[p];
            sum += matrix->value[p] * x[j];
            y[j] += matrix->value[p] * here;
        }
        y[i] += sum;
    }
}

enum { MULTIPLY_TOGETHER = 8 };

/* The same, to the last bit, for MULTIPLY_TOGETHER vectors: the matrix comes from memory once. x
 * and y of one row lie side by side in `both`, [n][2][MULTIPLY_TOGETHER]. */
static void multiply_together(const struct sparse *matrix, const double *x, double *y,
                              double (*both)[2][MULTIPLY_TOGETHER])
{
    size_t n = matrix->n;
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < MULTIPLY_TOGETHER; c++) {
            both[i][0][c] = x[c * n + i];
            both[i][1][c] = 0.0;
        }
    for (size_t i = 0; i < n; i++) {
        double sum[MULTIPLY_TOGETHER] = {0.0}, here[MULTIPLY_TOGETHER];
        size_t p = matrix->start[i], end = matrix->start[i + 1];
        memcpy(here, both[i][0], sizeof here);
        if (p < end && matrix->column[p] == i) {
            for (size_t c = 0; c < MULTIPLY_TOGETHER; c++)
                sum[c] = matrix->value[p] * here[c];
            p++;
        }
        for (; p < end; p++) {
            double value = matrix->value[p], (*row)[MULTIPLY_TOGETHER] = both[matrix->column[p]];
            for (size_t c = 0; c < MULTIPLY_TOGETHER; c++) {
                sum[c] += value * row[0][c];
                row[1][c] += value * here[c];
            }
        }
        for (size_t c = 0; c < MULTIPLY_TOGETHER; c++)
            both[i][1][c] += sum[c];
    }
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; c < MULTIPLY_TOGETHER; c++)
            y[c * n + i] = both[i][1][c];
}

void sparse_multiply(const struct sparse *matrix, size_t count, const double *x, double *y)
{
    size_t n = matrix->n, c = 0;
    /* without memory for it, one by one */
    double(*both)[2][MULTIPLY_TOGETHER] =
        count >= MULTIPLY_TOGETHER ? malloc(n * sizeof *both) : NULL;
    for (; both && c + MULTIPLY_TOGETHER <= count; c += MULTIPLY_TOGETHER)
        multiply_together(matrix, x + c * n, y + c * n, both);
    free(both);
    for (; c < count; c++)
        multiply_one(matrix, x + c * n, y + c * n);
}

double sparse_product(const struct sparse *matrix, const double *x, const double *y)
{
    double total = 0.0;
    for (size_t i = 0; i < matrix->n; i++)
        for (size_t p = matrix->start[i]; p < matrix->start[i + 1]; p++) {
            size_t j = matrix->column[p];
            total += matrix->value[p] * (i == j ? x[i] * y[i] : x[i] * y[j] + x[j] * y[i]);
        }
    return total;
}

void sparse_hold(struct sparse *matrix, const bool *held, bool keep_diagonal)
{
    size_t filled = 0, p = 0;
    for (size_t i = 0; i < matrix->n; i++) {
        size_t end = matrix->start[i + 1];
        for (matrix->start[i] = filled; p < end; p++) {
            size_t j = matrix->column[p];
            if (i == j ? held[i] && !keep_diagonal : held[i] || held[j])
                continue;
            matrix->column[filled] = (uint32_t)j;
            matrix->value[filled++] = matrix->value[p];
        }
    }
    matrix->start[matrix->n] = filled;
}

void sparse_free(struct sparse *matrix)
{
    free(matrix->start);
    free(matrix->column);
    free(matrix->value);
    *matrix = (struct sparse){0};
}

/* ---- stiffness and mass ---- */

/* Nodes that share an element: of each node, itself and those with higher numbers, ascending. */
struct adjacency {
    size_t *start; /* [node_count + 1] */
    uint32_t *node;
};

static void adjacency_free(struct adjacency *adjacency)
{
    free(adjacency->start);
    free(adjacency->node);
}

/* Elements of each node i: element[start[i]] to element[start[i + 1] - 1]. */
static bool list_elements(const struct solid_mesh *mesh, size_t *start, size_t **element)
{
    size_t total = mesh->first[mesh->element_count];
    *element = malloc((total + 1) * sizeof **element);
    if (!*element)
        return false;
    memset(start, 0, (mesh->node_count + 2) * sizeof *start);
    for (size_t i = 0; i < total; i++)
        start[mesh->nodes[i] + 2]++;
    for (size_t i = 0; i < mesh->node_count; i++)
        start[i + 2] += start[i + 1];
    for (size_t e = 0; e < mesh->element_count; e++)
        for (size_t i = mesh->first[e]; i < mesh->first[e + 1]; i++)
            (*element)[start[mesh->nodes[i] + 1]++] = e;
    return true;
}

static int compare_nodes(const void *left, const void *right)
{
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return a < b ? -1 : a > b;
}

/* Collects the neighbours of one node in `found`, each once; mark[] is node + 1 for collected
 * ones. */
static size_t gather_neighbours(const struct solid_mesh *mesh, uint32_t node,
                                const size_t *elements, size_t count, uint32_t *mark,
                                uint32_t *found)
{
    size_t total = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t k = mesh->first[elements[i]]; k < mesh->first[elements[i] + 1]; k++) {
            size_t other = mesh->nodes[k];
            if (other < node || mark[other] == node + 1)
                continue;
            mark[other] = node + 1;
            found[total++] = (uint32_t)other;
        }
    qsort(found, total, sizeof *found, compare_nodes);
    return total;
}

static bool adjacency_make(const struct solid_mesh *mesh, struct adjacency *adjacency)
{
    size_t nodes = mesh->node_count, *element = NULL, room = 40 * nodes + 1000, filled = 0;
    size_t *of_node = malloc((nodes + 2) * sizeof *of_node);
    uint32_t *mark = calloc(nodes + 1, sizeof *mark);
    uint32_t *found = malloc((nodes + 1) * sizeof *found);
    adjacency->start = calloc(nodes + 1, sizeof *adjacency->start);
    adjacency->node = malloc(room * sizeof *adjacency->node);
    bool fine = of_node && mark && found && adjacency->start && adjacency->node &&
                list_elements(mesh, of_node, &element);
    for (size_t i = 0; fine && i < nodes; i++) {
        size_t count = gather_neighbours(mesh, (uint32_t)i, element + of_node[i],
                                         of_node[i + 1] - of_node[i], mark, found);
        /* more room where nodes have many neighbours */
        if (filled + count > room) {
            room = 2 * (filled + count);
            uint32_t *more = realloc(adjacency->node, room * sizeof *more);
            fine = more != NULL;
            adjacency->node = more ? more : adjacency->node;
        }
        if (fine)
            memcpy(adjacency->node + filled, found, count * sizeof *found);
        filled += fine ? count : 0;
        adjacency->start[i + 1] = filled;
    }
    free(of_node);
    free(mark);
    free(found);
    free(element);
    return fine;
}

/* The place of `other` among the neighbours of `node`, which have it. */
static size_t place_of(const struct adjacency *adjacency, size_t node, size_t other)
{
    size_t low = adjacency->start[node], high = adjacency->start[node + 1] - 1;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (adjacency->node[middle] < other)
            low = middle + 1;
        else
            high = middle;
    }
    return low - adjacency->start[node];
}

/* Three rows a node: all directions of a neighbour for the stiffness, the same direction for the
 * mass, which couples equal directions only. */
static bool lay_out_rows(const struct adjacency *adjacency, size_t nodes, struct matrices *matrices)
{
    size_t pairs = adjacency->start[nodes];
    if (!sparse_reserve(&matrices->stiffness, 3 * nodes, 9 * pairs - 3 * nodes) ||
        !sparse_reserve(&matrices->mass, 3 * nodes, 3 * pairs))
        return false;
    size_t filled = 0, massive = 0;
    for (size_t i = 0; i < nodes; i++)
        for (size_t k = 0; k < 3; k++) {
            for (size_t p = adjacency->start[i]; p < adjacency->start[i + 1]; p++) {
                uint32_t other = 3 * adjacency->node[p];
                for (size_t m = other == 3 * i ? k : 0; m < 3; m++)
                    matrices->stiffness.column[filled++] = other + (uint32_t)m;
                matrices->mass.column[massive++] = other + (uint32_t)k;
            }
            matrices->stiffness.start[3 * i + k + 1] = filled;
            matrices->mass.start[3 * i + k + 1] = massive;
        }
    return true;
}

/* One element's stiffness by blocks of three and its mass, upper triangle of nodes. */
struct element_matrices {
    double stiffness[ELEMENT_MOST_NODES][ELEMENT_MOST_NODES][9];
    double mass[ELEMENT_MOST_NODES][ELEMENT_MOST_NODES];
};

/* K_ab = lambda g_a g_b^T + mu g_b g_a^T + mu (g_a . g_b) I with gradients g of shape functions N,
 * M_ab = rho N_a N_b: both integrated over the element. */
static void integrate_element(const struct element_rule *rule, double (*points)[3],
                              const struct material *material, struct element_matrices *result)
{
    double nu = material->poisson, mu = material_shear_modulus(material);
    double lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
    memset(result, 0, sizeof *result);
    for (size_t p = 0; p < rule->point_count; p++) {
        struct element_point here;
        element_at(rule, p, points, &here);
        double l = lambda * here.volume, m = mu * here.volume, r = material->density * here.volume;
        for (size_t a = 0; a < rule->node_count; a++)
            for (size_t b = a; b < rule->node_count; b++) {
                const double *g = here.gradient[a], *h = here.gradient[b];
                double *block = result->stiffness[a][b], both = m * dot3(g, h);
                for (int i = 0; i < 3; i++) {
                    for (int j = 0; j < 3; j++)
                        block[3 * i + j] += l * g[i] * h[j] + m * h[i] * g[j];
                    block[4 * i] += both;
                }
                result->mass[a][b] += r * rule->shape[p][a] * rule->shape[p][b];
            }
    }
}

/* Adds one pair of nodes, the first not above the second; `turned`: the block has the other
 * order. */
static void add_pair(const struct adjacency *adjacency, const size_t pair[2], const double block[9],
                     bool turned, struct sparse *stiffness)
{
    size_t place = place_of(adjacency, pair[0], pair[1]);
    for (size_t i = 0; i < 3; i++) {
        double *row = stiffness->value + stiffness->start[3 * pair[0] + i];
        for (size_t j = place == 0 ? i : 0; j < 3; j++)
            row[3 * place + j - i] += turned ? block[3 * j + i] : block[3 * i + j];
    }
}

static void add_element_matrices(const struct adjacency *adjacency, const size_t *nodes,
                                 size_t count, const struct element_matrices *element,
                                 struct matrices *matrices)
{
    for (size_t a = 0; a < count; a++)
        for (size_t b = a; b < count; b++) {
            bool turned = nodes[a] > nodes[b];
            size_t pair[2] = {nodes[turned ? b : a], nodes[turned ? a : b]};
            add_pair(adjacency, pair, element->stiffness[a][b], turned, &matrices->stiffness);
            size_t place = place_of(adjacency, pair[0], pair[1]);
            for (size_t k = 0; k < 3; k++)
                matrices->mass.value[matrices->mass.start[3 * pair[0] + k] + place] +=
                    element->mass[a][b];
        }
}

static void add_type(const struct solid_mesh *mesh, enum element_type type,
                     const struct adjacency *adjacency, struct element_matrices *element,
                     struct matrices *matrices)
{
    struct element_rule rule;
    element_rule_make(type, &rule);
    for (size_t e = 0; e < mesh->element_count; e++) {
        if (mesh->types[e] != type)
            continue;
        double points[ELEMENT_MOST_NODES][3];
        element_points(mesh, e, points);
        integrate_element(&rule, points, &mesh->part[mesh->parts[e]].material, element);
        add_element_matrices(adjacency, mesh->nodes + mesh->first[e], rule.node_count, element,
                             matrices);
    }
}

/* a mass on a node is in its three diagonal entries, the first of their rows */
static void add_masses(const struct solid_mesh *mesh, struct sparse *mass)
{
    for (size_t i = 0; i < mesh->mass_count; i++)
        for (size_t k = 0; k < 3; k++)
            mass->value[mass->start[3 * mesh->masses[i].node + k]] += mesh->masses[i].mass;
}

/* Row numbers have 32 bits, and MUMPS counts in signed integers. */
static const size_t MOST_NODES = 700000000;

static enum percuss_status check_nodes(const struct solid_mesh *mesh, struct fault *fault)
{
    if (mesh->node_count > MOST_NODES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%zu nodes: must be at most %zu",
                         mesh->node_count, MOST_NODES);
    bool *used = calloc(mesh->node_count + 1, sizeof *used);
    if (!used)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (size_t i = 0; i < mesh->first[mesh->element_count]; i++)
        used[mesh->nodes[i]] = true;
    size_t i = 0;
    while (i < mesh->node_count && used[i])
        i++;
    free(used);
    return i == mesh->node_count
               ? PERCUSS_OK
               : fault_set(fault, PERCUSS_BAD_REQUEST, "node %zu: belongs to no element",
                           mesh->labels ? mesh->labels[i] : i);
}

enum percuss_status matrices_make(const struct solid_mesh *mesh, struct matrices *matrices,
                                  struct fault *fault)
{
    *matrices = (struct matrices){.mesh = mesh};
    enum percuss_status status = check_nodes(mesh, fault);
    if (status)
        return status;
    struct adjacency adjacency = {0};
    struct element_matrices *element = malloc(sizeof *element);
    if (element && adjacency_make(mesh, &adjacency) &&
        lay_out_rows(&adjacency, mesh->node_count, matrices)) {
        for (enum element_type type = ELEMENT_TET10; type < ELEMENT_TYPES; type++)
            add_type(mesh, type, &adjacency, element, matrices);
        add_masses(mesh, &matrices->mass);
    } else {
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        matrices_free(matrices);
    }
    adjacency_free(&adjacency);
    free(element);
    return status;
}

enum percuss_status matrices_hold(struct matrices *matrices, const struct mesh_set *set,
                                  struct fault *fault)
{
    if (!matrices->held)
        matrices->held = calloc(matrices->stiffness.n, sizeof *matrices->held);
    if (!matrices->held)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (size_t i = 0; i < set->count; i++)
        for (size_t k = 0; k < 3; k++)
            matrices->held[3 * set->nodes[i] + k] = true;
    sparse_hold(&matrices->stiffness, matrices->held, true);
    sparse_hold(&matrices->mass, matrices->held, false);
    return PERCUSS_OK;
}

void matrices_free(struct matrices *matrices)
{
    sparse_free(&matrices->stiffness);
    sparse_free(&matrices->mass);
    free(matrices->held);
    matrices->held = NULL;
}
