/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Of mesh/matrices_read.h: matrices of our own written in each format with their rows in disorder
 * are read as they were; those of CalculiX (where it is installed) are ours. */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "mesh/matrices_read.h"
#include "mesh/mesh_read.h"
#include "unit/mesh/blocks.h"

static char stiffness[96], mass[96], freedoms[96];
static struct fault fault;

static void brick(const double cube[3], double point[3])
{
    point[0] = 0.02 * cube[0];
    point[1] = 0.01 * cube[1] + 0.001 * cube[0];
    point[2] = 0.005 * cube[2];
}

static struct solid_mesh make_brick(void)
{
    struct solid_mesh mesh = block_make(&(struct block){ELEMENT_TET10, {2, 1, 1}, brick, false});
    mesh.unit = 0.001;
    mesh.part[0].has_material = true;
    mesh.part[0].material = (struct material){"", 70e9, 0.33, 2700.0, INFINITY, 0.0};
    return mesh;
}

static void name_files(const char *suffix, const char *mass_suffix)
{
    snprintf(stiffness, sizeof stiffness, "/tmp/percuss-k-%d%s", (int)getpid(), suffix);
    snprintf(mass, sizeof mass, "/tmp/percuss-m-%d%s", (int)getpid(), mass_suffix);
    snprintf(freedoms, sizeof freedoms, "/tmp/percuss-d-%d.dof", (int)getpid());
}

static void forget_files(void)
{
    unlink(stiffness);
    unlink(mass);
    unlink(freedoms);
}

/* row of a degree of freedom in the file: another order, in which neighbours are far apart */
static size_t row_of(size_t freedom, size_t n)
{
    return (freedom * 101 + 17) % n;
}

/* in N/mm and t; `what` is the header of Matrix Market, NULL: lines only; general: both triangles
 */
static void write_matrix(const char *path, const struct sparse *matrix, const char *what)
{
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    bool general = what && strcmp(what, "general") == 0;
    size_t entries = 0;
    for (size_t i = 0; i < matrix->n; i++)
        for (size_t p = matrix->start[i]; p < matrix->start[i + 1]; p++)
            entries += 1 + (general && matrix->column[p] != i);
    if (what)
        fprintf(stream, "%%%%MatrixMarket matrix coordinate real %s\n%% ours\n%zu %zu %zu\n", what,
                matrix->n, matrix->n, entries);
    for (size_t i = 0; i < matrix->n; i++)
        for (size_t p = matrix->start[i]; p < matrix->start[i + 1]; p++) {
            size_t a = row_of(i, matrix->n) + 1, b = row_of(matrix->column[p], matrix->n) + 1;
            double value = 0.001 * matrix->value[p];
            fprintf(stream, "%zu %zu %.17g\n", a > b ? a : b, a > b ? b : a, value);
            if (general && a != b)
                fprintf(stream, "%zu %zu %.17g\n", a > b ? b : a, a > b ? a : b, value);
        }
    fclose(stream);
}

static void write_freedoms(const struct solid_mesh *mesh)
{
    size_t n = 3 * mesh->node_count, *at = malloc(n * sizeof *at);
    FILE *stream = fopen(freedoms, "w");
    assert_non_null(stream);
    for (size_t i = 0; i < n; i++)
        at[row_of(i, n)] = i;
    for (size_t i = 0; i < n; i++)
        fprintf(stream, "%zu.%zu\n", mesh->labels[at[i] / 3], at[i] % 3 + 1);
    fclose(stream);
    free(at);
}

/* largest difference of entries over the largest entry */
static double difference(const struct sparse *a, const struct sparse *b)
{
    double most = 0.0, scale = 0.0;
    assert_int_equal(a->n, b->n);
    double *x = calloc(a->n, sizeof *x), *y = calloc(2 * a->n, sizeof *y);
    for (size_t j = 0; j < a->n; j++) {
        x[j] = 1.0;
        sparse_multiply(a, 1, x, y);
        sparse_multiply(b, 1, x, y + a->n);
        x[j] = 0.0;
        for (size_t i = 0; i < a->n; i++) {
            most = fmax(most, fabs(y[i] - y[a->n + i]));
            scale = fmax(scale, fabs(y[i]));
        }
    }
    free(x);
    free(y);
    return most / scale;
}

static void reads_what_was_written(void **state)
{
    (void)state;
    static const char *const FORMATS[] = {"symmetric", "general", NULL};
    struct solid_mesh mesh = make_brick();
    struct matrices ours, read;
    assert_int_equal(matrices_make(&mesh, &ours, &fault), PERCUSS_OK);
    /* row_of must reach every row */
    assert_true((3 * mesh.node_count) % 101 != 0);
    for (size_t f = 0; f < COUNT(FORMATS); f++) {
        name_files(FORMATS[f] ? ".mtx" : ".sti", FORMATS[f] ? ".mtx" : ".mas");
        write_matrix(stiffness, &ours.stiffness, FORMATS[f]);
        write_matrix(mass, &ours.mass, FORMATS[f]);
        write_freedoms(&mesh);
        assert_int_equal(matrices_read(&(struct matrices_files){stiffness, mass, freedoms}, &mesh,
                                       &read, &fault),
                         PERCUSS_OK);
        /* 17 digits, times .001 and 1000 */
        near(difference(&read.stiffness, &ours.stiffness), 0.0, 1e-15);
        near(difference(&read.mass, &ours.mass), 0.0, 1e-15);
        assert_null(read.held);
        matrices_free(&read);
        forget_files();
    }
    matrices_free(&ours);
    solid_mesh_free(&mesh);
}

static void refused(const struct solid_mesh *mesh, const char *words)
{
    struct matrices read;
    if (matrices_read(&(struct matrices_files){stiffness, mass, freedoms}, mesh, &read, &fault) !=
        PERCUSS_BAD_REQUEST)
        fail_msg("not refused, but should be for: %s", words);
    if (!strstr(fault.text, words))
        fail_msg("\"%s\" has not \"%s\"", fault.text, words);
}

static void put(const char *path, const char *text)
{
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
}

static void refuses_what_does_not_fit(void **state)
{
    (void)state;
    struct solid_mesh mesh = make_brick();
    struct matrices ours;
    assert_int_equal(matrices_make(&mesh, &ours, &fault), PERCUSS_OK);
    name_files(".mtx", ".mtx");
    write_matrix(stiffness, &ours.stiffness, "symmetric");
    write_matrix(mass, &ours.mass, "symmetric");
    put(freedoms, "1.1\n1.2\n1.3\n");
    refused(&mesh, "must be 3, as many as there are degrees of freedom");
    put(freedoms, "1.1\n1.1\n");
    refused(&mesh, "1.1: is there twice");
    put(freedoms, "1.4\n");
    refused(&mesh, "direction must be 1, 2 or 3");
    put(freedoms, "4711.1\n");
    refused(&mesh, ".dof:1: 4711.1: must be a node of the mesh");
    write_freedoms(&mesh);
    put(stiffness, "1 1 1\n");
    refused(&mesh, "must begin with %%MatrixMarket matrix coordinate real");
    name_files(".sti", ".mas");
    write_freedoms(&mesh);
    put(stiffness, "1 1 1e3\n1 2\n");
    refused(&mesh, ": value: the file ends here");
    put(stiffness, "1 1 1e3\n1 2000 5.\n");
    refused(&mesh, "row 1, column 2000: must be 1 to ");
    put(stiffness, "1 1 1e3\n2 2 nan\n");
    refused(&mesh, "row 2, column 2: nan: must be a finite number");
    /* a file that ends between two lines */
    put(stiffness, "1 1 1e3\n");
    put(mass, "1 1 1e3\n");
    refused(&mesh, ": row 2 (node ");
    refused(&mesh, "0 on the diagonal: must be > 0; is the file whole?");
    /* a mass along x only, as good as */
    write_matrix(stiffness, &ours.stiffness, NULL);
    FILE *stream = fopen(mass, "w");
    assert_non_null(stream);
    for (size_t row = 0; row < ours.mass.n; row++)
        fprintf(stream, "%zu %zu %s\n", row + 1, row + 1,
                row == row_of(0, ours.mass.n) ? "1e-3" : "1e-30");
    fclose(stream);
    refused(&mesh, "moves with 1, 4.5e-26 and 4.5e-26 kg along x, y and z: must be one mass");
    forget_files();

    name_files(".mtx", ".mtx");
    write_freedoms(&mesh);
    write_matrix(mass, &ours.mass, "symmetric");
    char text[256];
    snprintf(text, sizeof text,
             "%%%%MatrixMarket matrix coordinate real general\n%zu %zu 2\n1 2 5\n2 1 4\n",
             ours.mass.n, ours.mass.n);
    put(stiffness, text);
    refused(&mesh, ": must be a symmetric matrix");
    forget_files();
    matrices_free(&ours);
    solid_mesh_free(&mesh);
}

/* the brick as a deck for CalculiX, whose fields hold 20 characters */
static void write_deck(const struct solid_mesh *mesh, const char *path)
{
    static const int ORDER[10] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fprintf(stream, "*NODE, NSET=ALL\n");
    for (size_t i = 0; i < mesh->node_count; i++)
        fprintf(stream, "%zu, %.12g, %.12g, %.12g\n", mesh->labels[i], 1e3 * mesh->points[i][0],
                1e3 * mesh->points[i][1], 1e3 * mesh->points[i][2]);
    fprintf(stream, "*ELEMENT, TYPE=C3D10, ELSET=BRICK\n");
    for (size_t e = 0; e < mesh->element_count; e++) {
        fprintf(stream, "%zu", mesh->element_labels[e]);
        for (int i = 0; i < 10; i++)
            fprintf(stream, ", %zu", mesh->labels[mesh->nodes[mesh->first[e] + ORDER[i]]]);
        fprintf(stream, "\n");
    }
    fprintf(stream, "*MATERIAL, NAME=AL\n*ELASTIC\n70000., .33\n*DENSITY\n2.7e-9\n"
                    "*SOLID SECTION, ELSET=BRICK, MATERIAL=AL\n"
                    "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n6\n*END STEP\n");
    fclose(stream);
}

/* its stiffness is ours, for elements with straight edges: to the 14 digits it writes and the 12 of
 * the nodes. Its mass is of the same body, but its four points of quadrature are too few for the
 * squares of shape functions: entries differ by a quarter of the largest */
static void agrees_with_calculix(void **state)
{
    (void)state;
    if (system("command -v ccx >/dev/null") != 0)
        skip();
    char folder[64], deck[96], command[256];
    snprintf(folder, sizeof folder, "/tmp/percuss-ccx-%d", (int)getpid());
    snprintf(command, sizeof command, "mkdir -p %s", folder);
    assert_int_equal(system(command), 0);
    snprintf(deck, sizeof deck, "%s/brick.inp", folder);
    struct solid_mesh made = make_brick(), mesh;
    write_deck(&made, deck);
    snprintf(command, sizeof command, "cd %s && timeout 60 ccx brick >said 2>&1", folder);
    assert_int_equal(system(command), 0);

    /* the deck is the mesh */
    struct mesh_options options = {.unit = 0.001};
    struct matrices ours, read;
    assert_int_equal(mesh_read(deck, &options, &mesh, &fault), PERCUSS_OK);
    assert_int_equal(matrices_make(&mesh, &ours, &fault), PERCUSS_OK);
    snprintf(stiffness, sizeof stiffness, "%s/brick.sti", folder);
    snprintf(mass, sizeof mass, "%s/brick.mas", folder);
    snprintf(freedoms, sizeof freedoms, "%s/brick.dof", folder);
    assert_int_equal(
        matrices_read(&(struct matrices_files){stiffness, mass, freedoms}, &mesh, &read, &fault),
        PERCUSS_OK);
    near(difference(&ours.stiffness, &read.stiffness), 0.0, 1e-10);
    double *way = calloc(ours.mass.n, sizeof *way);
    for (size_t i = 0; i < ours.mass.n; i += 3)
        way[i] = 1.0;
    near_relative(sparse_product(&read.mass, way, way), 2700.0 * 1e-6, 1e-11);
    near_relative(sparse_product(&ours.mass, way, way), 2700.0 * 1e-6, 1e-13);
    free(way);
    matrices_free(&ours);
    matrices_free(&read);
    solid_mesh_free(&made);
    solid_mesh_free(&mesh);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_what_was_written),
        cmocka_unit_test(refuses_what_does_not_fit),
        cmocka_unit_test(agrees_with_calculix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
