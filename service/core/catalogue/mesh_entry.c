/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/mesh_entry.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "catalogue/keys.h"
#include "catalogue/mesh_order.h"
#include "catalogue/names.h"
#include "catalogue/shipped.h"
#include "mesh/body_file.h"
#include "model/mesh_surface.h"
#include "model/vector.h"

/* Directions that a person types are across the normal, and each other, up to a degree or so. */
static const double ACROSS = 0.02;

/* A site as its mapping states it. */
struct stated {
    double point[3], normal[3];
};

static const struct limit limit_coordinate = {-1e9,           1e9, false, false, "a finite number",
                                              QUANTITY_NUMBER};
static const struct limit limit_curvature = {
    -1e9, 1e9, false, false, "a finite curvature in 1/m, > 0 where convex", QUANTITY_CURVATURE};
static const struct key site_rows[] = {
    {"point", KEY_NUMBERS, &limit_coordinate, true, KEY_OF(stated, point),
     KEY_SAYS(NULL, "where it is, in the mesh's axes and unit of length: numbers without units")},
    {"normal", KEY_NUMBERS, &limit_coordinate, false, KEY_OF(stated, normal),
     KEY_SAYS("the surface's", "outward, of any length, in the mesh's axes")},
    {"curvatures", KEY_LIST, .required = false,
     .allowed = "a list of two, each a finite curvature in 1/m, > 0 where convex",
     KEY_SAYS("the surface's", "the principal curvatures; they must stand beside normal")},
    {"directions", KEY_LIST, .required = false,
     .allowed = "one direction of three numbers across the normal, or two that are across each "
                "other too",
     KEY_SAYS("none", "of the principal curvatures; needed where these differ")},
};
const struct key_table keys_site = {"a site", site_rows, sizeof site_rows / sizeof *site_rows,
                                    NULL};

static enum percuss_status out_of_memory(const struct reader *reader)
{
    return fault_set(reader->fault, PERCUSS_INTERNAL, "%s: out of memory",
                     reader_short_name(reader->name));
}

void mesh_files_free(struct mesh_files *files, const struct body_set *set)
{
    for (size_t i = 0; i < set->mesh_count; i++)
        free(files->paths[i]);
    free(files->paths);
    files->paths = NULL;
}

/* From the folder of the catalogue's file, else from the shipped files: catalogues are copied
 * without their files. For free(); NULL: out of memory. */
static char *resolve(const struct reader *reader, const char *file)
{
    const char *slash = strrchr(reader->name, '/');
    size_t folder = file[0] == '/' || !slash ? 0 : (size_t)(slash - reader->name) + 1;
    char *path = malloc(folder + strlen(file) + 1);
    if (!path)
        return NULL;
    sprintf(path, "%.*s%s", (int)folder, reader->name, file);
    if (file[0] == '/' || access(path, F_OK) == 0)
        return path;
    char *shipped = shipped_find(file);
    if (!shipped)
        return path;
    free(path);
    return shipped;
}

/* Adds a file's body to the set. */
static bool keep(struct mesh_files *files, struct body_set *set, struct mesh_body *mesh, char *path)
{
    size_t count = set->mesh_count + 1;
    struct mesh_body **meshes = realloc(set->meshes, count * sizeof *meshes);
    if (meshes)
        set->meshes = meshes;
    char **paths = realloc(files->paths, count * sizeof *paths);
    if (paths)
        files->paths = paths;
    if (!meshes || !paths)
        return false;
    meshes[count - 1] = mesh;
    paths[count - 1] = path;
    set->mesh_count = count;
    return true;
}

/* Takes over the path. */
static enum percuss_status read_file(struct reader *reader, const yaml_node_t *value,
                                     struct mesh_files *files, struct body_set *set, char *path,
                                     struct body *body)
{
    struct mesh_body *mesh;
    struct fault fault = {{0}};
    /* known already */
    for (size_t i = 0; i < set->mesh_count; i++)
        if (strcmp(files->paths[i], path) == 0) {
            body->mesh = set->meshes[i];
            free(path);
            return PERCUSS_OK;
        }
    /* or read, and prepared for searches on its surface */
    enum percuss_status status = body_file_read(path, &mesh, &fault);
    if (status) {
        free(path);
        return status == PERCUSS_INTERNAL ? out_of_memory(reader)
                                          : reader_refuse(reader, value, "%s", fault.text);
    }
    if (!mesh_surface_prepare(mesh) || !keep(files, set, mesh, path)) {
        mesh_body_free(mesh);
        free(path);
        return out_of_memory(reader);
    }
    body->mesh = mesh;
    return PERCUSS_OK;
}

/* A list of `count` numbers. */
static bool read_numbers(const struct reader *reader, const yaml_node_t *list,
                         const struct limit *limit, size_t count, double *numbers)
{
    bool good = list->type == YAML_SEQUENCE_NODE && reader_count(list) == count;
    for (size_t i = 0; good && i < count; i++)
        good = reader_quantity(reader_element(reader, list, i), limit->quantity, &numbers[i]) &&
               limit_holds(limit, numbers[i]);
    return good;
}

/* Across the normal and of length 1; false: it has no such part. */
static bool lay_across(const double normal[3], double direction[3])
{
    double length = norm3(direction);
    double along = dot3(direction, normal);
    if (!(length > 0.0) || fabs(along) > ACROSS * length)
        return false;
    add_scaled3(-along, normal, direction);
    scale3(1.0 / norm3(direction), direction, direction);
    return true;
}

/* curvatures: the principal ones; directions: of the first, or of both. The tensor is
 * k1 t1 t1 + k2 t2 t2; equal curvatures need no directions. */
static enum percuss_status read_curvature(struct reader *reader, const yaml_node_t *mapping,
                                          struct body_site *site)
{
    const struct entry curvatures = reader_find(reader, mapping, "curvatures");
    const struct entry directions = reader_find(reader, mapping, "directions");
    double k[2], t[2][3] = {{0.0}};
    if (!curvatures.value)
        return directions.value ? reader_refuse(reader, directions.key,
                                                "directions: must stand beside curvatures")
                                : PERCUSS_OK;
    if (!read_numbers(reader, curvatures.value, &limit_curvature, 2, k))
        return reader_refuse(reader, curvatures.value, "curvatures: must be %s",
                             site_rows[2].allowed);
    if (!site->has_normal)
        return reader_refuse(reader, curvatures.key, "curvatures: must stand beside normal");
    /* any directions where both are alike */
    int smallest = fabs(site->normal[0]) < 0.6 ? 0 : 1;
    t[0][smallest] = 1.0;
    add_scaled3(-site->normal[smallest], site->normal, t[0]);
    scale3(1.0 / norm3(t[0]), t[0], t[0]);
    if (!directions.value && k[0] != k[1])
        return reader_refuse(reader, curvatures.key,
                             "directions: missing: curvatures that differ need the direction of "
                             "the first, a list of three numbers (or a list of both)");
    if (directions.value) {
        const yaml_node_t *first = directions.value;
        bool both = first->type == YAML_SEQUENCE_NODE && reader_count(first) == 2;
        if (both)
            first = reader_element(reader, directions.value, 0);
        bool good = read_numbers(reader, first, &limit_coordinate, 3, t[0]) &&
                    lay_across(site->normal, t[0]);
        if (good && both)
            good = read_numbers(reader, reader_element(reader, directions.value, 1),
                                &limit_coordinate, 3, t[1]) &&
                   lay_across(site->normal, t[1]) && fabs(dot3(t[0], t[1])) <= ACROSS;
        if (!good)
            return reader_refuse(reader, directions.value, "directions: must be %s",
                                 site_rows[3].allowed);
    }
    cross3(site->normal, t[0], t[1]);
    for (int i = 0; i < 9; i++)
        site->curvature[i] = k[0] * t[0][i / 3] * t[0][i % 3] + k[1] * t[1][i / 3] * t[1][i % 3];
    site->has_curvature = true;
    return PERCUSS_OK;
}

static enum percuss_status read_site(struct reader *reader, struct entry entry,
                                     struct body_site *site)
{
    struct stated stated = {.normal = {0.0}};
    memcpy(site->name, entry.key->data.scalar.value, entry.key->data.scalar.length);
    size_t mark = reader_enter(reader, site->name);
    enum percuss_status status = keys_read(reader, entry, &keys_site, &stated);
    if (status)
        return status;
    memcpy(site->point, stated.point, sizeof site->point);
    /* the normal, of any length */
    const yaml_node_t *normal = reader_find(reader, entry.value, "normal").value;
    double length = norm3(stated.normal);
    if (normal && !(length > 0.0))
        return reader_refuse(reader, normal, "normal: must not be zero");
    site->has_normal = normal;
    if (normal)
        scale3(1.0 / length, stated.normal, site->normal);
    status = read_curvature(reader, entry.value, site);
    if (!status)
        reader_leave(reader, mark);
    return status;
}

static enum percuss_status read_sites(struct reader *reader, const yaml_node_t *mapping,
                                      struct body *body)
{
    struct names names;
    size_t mark = reader_enter(reader, "sites");
    enum percuss_status status = names_read(reader, mapping, &names);
    if (status)
        return status;
    size_t count = names.count;
    names_free(&names);
    if (count > BODY_MOST_SITES)
        return reader_refuse(reader, mapping, "%zu sites: must be at most %d", count,
                             BODY_MOST_SITES);
    body->sites = calloc(count + 1, sizeof *body->sites);
    if (!body->sites)
        return out_of_memory(reader);
    body->site_count = count;
    for (size_t i = 0; !status && i < count; i++)
        status = read_site(reader, reader_entry(reader, mapping, i), &body->sites[i]);
    if (!status)
        reader_leave(reader, mark);
    return status;
}

enum percuss_status mesh_entry_read(struct reader *reader, struct entry entry,
                                    struct mesh_files *files, struct body_set *set,
                                    struct body *body)
{
    const yaml_node_t *file = reader_find(reader, entry.value, "file").value;
    const yaml_node_t *material = reader_find(reader, entry.value, "material").value;
    const yaml_node_t *sites = reader_find(reader, entry.value, "sites").value;
    /* the body's own file, or the one that its mesh was reduced to or will be */
    char *path = resolve(reader, (const char *)file->data.scalar.value);
    if (!path)
        return out_of_memory(reader);
    bool is_mesh = mesh_order_is_mesh(path);
    enum percuss_status status = is_mesh ? mesh_order_read(reader, entry, set, body, &path)
                                         : mesh_order_refuse(reader, entry);
    if (status) {
        free(path);
        return status;
    }
    if (!path)
        return sites ? read_sites(reader, sites, body) : PERCUSS_OK;
    size_t mark = reader_enter(reader, "file");
    bool missing = access(path, F_OK) != 0 && errno == ENOENT;
    status = read_file(reader, file, files, set, path, body);
    if (status == PERCUSS_BAD_REQUEST && missing && reader->lenient)
        status = mesh_order_missing(reader, set, body);
    if (status)
        return status;
    reader_leave(reader, mark);
    if (!body->mesh)
        return sites ? read_sites(reader, sites, body) : PERCUSS_OK;
    /* a catalogue's material replaces a single one of the file, not several */
    if (material && !is_mesh && body->mesh->material_count > 1)
        return reader_refuse(reader, material,
                             "material: must be absent: the file holds %zu materials of its own",
                             body->mesh->material_count);
    if (!material)
        body->material = body->mesh->materials[0];
    return sites ? read_sites(reader, sites, body) : PERCUSS_OK;
}
