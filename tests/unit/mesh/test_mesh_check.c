/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of mesh/mesh_check.h: each way in which a mesh is no body has its words. */
#include "mesh/mesh_check.h"
#include "unit/mesh/blocks.h"

static void brick(const double cube[3], double point[3])
{
    point[0] = 0.2 * cube[0];
    point[1] = 0.1 * cube[1];
    point[2] = 0.05 * cube[2];
}

static void huge_brick(const double cube[3], double point[3])
{
    for (int k = 0; k < 3; k++)
        point[k] = 250.0 * cube[k];
}

static void shell(const double cube[3], double point[3])
{
    double r = 0.006 + 0.004 * cube[0];
    point[0] = r * cos(2.4 * cube[1]);
    point[1] = r * sin(2.4 * cube[1]);
    point[2] = 0.048 * cube[2];
}

/* two elements round 2.4 rad */
static void coarse_shell(const double cube[3], double point[3])
{
    shell((double[3]){1.0 + cube[0], cube[1], cube[2]}, point);
}

static struct mesh_findings findings;
static struct fault fault;

static enum percuss_status check(const struct solid_mesh *mesh)
{
    struct surface surface;
    assert_int_equal(surface_make(mesh, &surface, &fault), PERCUSS_OK);
    assert_int_equal(surface_fit(mesh, &surface, &fault), PERCUSS_OK);
    enum percuss_status status = mesh_check(mesh, &surface, &findings, &fault);
    surface_free(&surface);
    return status;
}

static void refused(struct solid_mesh *mesh, const char *words)
{
    assert_int_equal(check(mesh), PERCUSS_BAD_REQUEST);
    if (!strstr(fault.text, words))
        fail_msg("\"%s\" has not \"%s\"", fault.text, words);
    solid_mesh_free(mesh);
}

static void passes_a_brick(void **state)
{
    (void)state;
    struct solid_mesh mesh = block_make(&(struct block){ELEMENT_TET10, {3, 2, 2}, brick, false});
    assert_int_equal(check(&mesh), PERCUSS_OK);
    assert_int_equal(findings.remark_count, 0);
    near_relative(findings.volume, 0.001, 1e-13);
    near_relative(findings.extent[0], 0.2, 1e-15);
    /* straight elements have one det J each */
    near(findings.least_jacobian, 1.0, 1e-12);
    solid_mesh_free(&mesh);
}

static void refuses_elements_inside_out(void **state)
{
    (void)state;
    /* a mid node beyond the end of its edge: the first corner's neighbour */
    struct solid_mesh mesh = block_make(&(struct block){ELEMENT_TET10, {2, 2, 2}, brick, false});
    size_t corner = mesh.nodes[0], middle = mesh.nodes[4];
    for (int k = 0; k < 3; k++)
        mesh.points[middle][k] -= 1.6 * (mesh.points[middle][k] - mesh.points[corner][k]);
    refused(&mesh, "elements are turned inside out (det J <= 0; element 1:");

    /* a mirror image */
    mesh = block_make(&(struct block){ELEMENT_HEX20, {2, 2, 2}, brick, false});
    for (size_t i = 0; i < mesh.node_count; i++)
        mesh.points[i][0] = -mesh.points[i][0];
    refused(&mesh, "8 of 8 elements have a negative volume (element 1 first)");
}

static void refuses_nodes_that_are_there_twice(void **state)
{
    (void)state;
    /* the second cell of a row gets nodes of its own where it meets the first */
    struct solid_mesh mesh = block_make(&(struct block){ELEMENT_HEX20, {2, 1, 1}, brick, false});
    size_t *nodes = mesh.nodes + 20, added = 0;
    mesh.points = realloc(mesh.points, (mesh.node_count + 20) * sizeof *mesh.points);
    mesh.labels = realloc(mesh.labels, (mesh.node_count + 20) * sizeof *mesh.labels);
    for (int i = 0; i < 20; i++)
        for (int j = 0; j < 20; j++)
            if (nodes[i] == mesh.nodes[j]) {
                size_t copy = mesh.node_count++;
                memcpy(mesh.points[copy], mesh.points[nodes[i]], sizeof mesh.points[copy]);
                mesh.labels[copy] = 1000 + added++;
                nodes[i] = copy;
            }
    assert_int_equal(added, 8);
    refused(&mesh, "8 pairs of nodes are in one place");
}

/* the first element and another one, with the nodes that they use */
static struct solid_mesh two_of(const struct block *block, size_t other)
{
    struct solid_mesh mesh = block_make(block);
    size_t each = mesh.first[1];
    memcpy(mesh.nodes + each, mesh.nodes + other * each, each * sizeof *mesh.nodes);
    mesh.element_labels[1] = mesh.element_labels[other];
    mesh.element_count = 2;
    bool *used = calloc(mesh.node_count, sizeof *used);
    size_t *number = calloc(mesh.node_count, sizeof *number), count = 0;
    for (size_t i = 0; i < 2 * each; i++)
        used[mesh.nodes[i]] = true;
    for (size_t i = 0; i < mesh.node_count; i++)
        if (used[i]) {
            memcpy(mesh.points[count], mesh.points[i], sizeof mesh.points[i]);
            number[i] = count++;
        }
    for (size_t i = 0; i < 2 * each; i++)
        mesh.nodes[i] = number[mesh.nodes[i]];
    mesh.node_count = count;
    free(used);
    free(number);
    return mesh;
}

static void refuses_two_bodies(void **state)
{
    (void)state;
    struct solid_mesh mesh = two_of(&(struct block){ELEMENT_HEX27, {3, 1, 1}, brick, false}, 2);
    refused(&mesh, "2 pieces that do not hang together: 1 elements (element 3 first)");
}

static void refuses_hinges(void **state)
{
    (void)state;
    /* cells that have an edge in common, and cells that have a corner */
    struct solid_mesh mesh = two_of(&(struct block){ELEMENT_HEX20, {2, 2, 1}, brick, false}, 3);
    refused(&mesh, "1 elements (element 4 first) hang on the other 1 by an edge or a node alone");
    mesh = two_of(&(struct block){ELEMENT_HEX27, {2, 2, 2}, brick, false}, 7);
    refused(&mesh, "1 elements (element 8 first) hang on the other 1 by an edge or a node alone");
}

static void remarks(struct solid_mesh *mesh, const char *words)
{
    assert_int_equal(check(mesh), PERCUSS_OK);
    bool found = false;
    for (size_t i = 0; i < findings.remark_count; i++)
        found = found || strstr(findings.remarks[i], words);
    if (!found)
        fail_msg("no remark has \"%s\"; the first of %zu: %s", words, findings.remark_count,
                 findings.remarks[0]);
    solid_mesh_free(mesh);
}

static void remarks_upon_what_is_odd(void **state)
{
    (void)state;
    struct solid_mesh mesh =
        block_make(&(struct block){ELEMENT_HEX20, {2, 2, 2}, huge_brick, false});
    remarks(&mesh, "extends 250 m, one unit of the file being 1 m: is the unit of length right");
    mesh = block_make(&(struct block){ELEMENT_TET10, {1, 8, 16}, shell, true});
    remarks(&mesh, "elements are straight-sided on round ground");
    mesh = block_make(&(struct block){ELEMENT_HEX20, {1, 2, 4}, coarse_shell, false});
    remarks(&mesh, "faces turn by more than 50 degrees");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(passes_a_brick),
        cmocka_unit_test(refuses_elements_inside_out),
        cmocka_unit_test(refuses_nodes_that_are_there_twice),
        cmocka_unit_test(refuses_two_bodies),
        cmocka_unit_test(refuses_hinges),
        cmocka_unit_test(remarks_upon_what_is_odd),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
