/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/tools/reduce/vtk.c. */
#include <string.h>
#include <unistd.h>

#include "reduce/vtk.h"
#include "unit/reduce/solve_mesh.h"

static const struct material STEEL = {"steel", 210e9, 0.3, 7800.0, INFINITY, 0.0};
enum { LARGEST = 1 << 20 };

static size_t read_file(const char *path, char *text)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t size = fread(text, 1, LARGEST - 1, file);
    fclose(file);
    text[size] = '\0';
    return size;
}

/* Where the array of that name begins, behind its size. */
static const char *find_array(const char *text, const char *base, const char *name, uint64_t *bytes)
{
    char label[80];
    unsigned long offset;
    snprintf(label, sizeof label, "Name=\"%s\"", name);
    const char *at = strstr(text, label);
    assert_non_null(at);
    assert_int_equal(sscanf(strstr(at, "offset="), "offset=\"%lu\"", &offset), 1);
    memcpy(bytes, base + offset, sizeof *bytes);
    return base + offset + sizeof *bytes;
}

/* In VTK's order the node after corners i and j of an edge is its middle: edges as VTK's manual
 * lists them. */
static void check_cells(enum element_type type, const unsigned char (*edges)[2], size_t corners,
                        size_t count)
{
    char path[] = "/tmp/percuss-vtk-XXXXXX", *text = malloc(LARGEST);
    struct solid_mesh mesh;
    struct solved solved;
    struct fault fault;
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    solid_shape_block(type, (double[3]){0.1, 0.05, 0.02}, (size_t[3]){2, 1, 1}, &STEEL, &mesh);
    solve_mesh(&mesh, 0, INFINITY, 3, &solved);
    assert_int_equal(vtk_write(path, &mesh, &solved.modes, &fault), PERCUSS_OK);
    read_file(path, text);
    uint64_t bytes;
    const char *base = text;
    const char mark[] = "encoding=\"raw\">\n_";
    while (memcmp(base, mark, sizeof mark - 1) != 0)
        base++;
    base += sizeof mark - 1;
    const char *cells = find_array(text, base, "connectivity", &bytes);
    assert_int_equal(bytes, 8 * mesh.first[mesh.element_count]);
    for (size_t e = 0; e < mesh.element_count; e++) {
        int64_t nodes[27];
        memcpy(nodes, cells + 8 * mesh.first[e], 8 * (mesh.first[e + 1] - mesh.first[e]));
        for (size_t i = 0; i < count; i++)
            for (int k = 0; k < 3; k++)
                near(mesh.points[nodes[corners + i]][k],
                     0.5 *
                         (mesh.points[nodes[edges[i][0]]][k] + mesh.points[nodes[edges[i][1]]][k]),
                     1e-12);
    }
    char name[64];
    snprintf(name, sizeof name, "mode 3: %.6g Hz", solved.modes.omega[2] / (2.0 * M_PI));
    const char *shape = find_array(text, base, name, &bytes);
    float value;
    assert_int_equal(bytes, 12 * mesh.node_count);
    memcpy(&value, shape + 4 * 7, sizeof value);
    near(value, (float)solved.modes.shapes[2 * solved.modes.n + 7], 0.0);
    unlink(path);
    free(text);
    solved_free(&solved);
    solid_mesh_free(&mesh);
}

static void test_cells(void **state)
{
    (void)state;
    static const unsigned char tet[][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    /* and the middles of faces x, y, z and of the whole, between corners across them */
    static const unsigned char hex[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7},
                                           {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {0, 7}, {1, 6},
                                           {0, 5}, {3, 6}, {0, 2}, {4, 6}, {0, 6}};
    static const unsigned char wedge[][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                             {5, 3}, {0, 3}, {1, 4}, {2, 5}};
    check_cells(ELEMENT_TET10, tet, 4, 6);
    check_cells(ELEMENT_WEDGE15, wedge, 6, 9);
    check_cells(ELEMENT_HEX20, hex, 8, 12);
    check_cells(ELEMENT_HEX27, hex, 8, 19);
}

static void test_says_why_it_cannot(void **state)
{
    (void)state;
    struct solid_mesh mesh = {.node_count = 0};
    struct modes modes = {0};
    struct fault fault;
    assert_int_equal(vtk_write("/nowhere/at.vtu", &mesh, &modes, &fault), PERCUSS_BAD_REQUEST);
    assert_string_equal(fault.text, "/nowhere/at.vtu: No such file or directory");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cells),
        cmocka_unit_test(test_says_why_it_cannot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
