/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/mesh_entry.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/sha256.h"
#include "catalogue/keys.h"
#include "catalogue/names.h"
#include "catalogue/shipped.h"
#include "mesh/body_file.h"
#include "mesh/mesh_read.h"
#include "model/key.h"
#include "model/mesh_surface.h"
#include "model/vector.h"

/* ---- orders of reductions, and the files' names ---- */

/* Version of percuss-reduce's results: raise it where they change for the same mesh. */
static const char METHOD[] = "percuss reduced body 3";
static const double MOST_FREQUENCY = 1e12; /* Hz, as far as percuss-reduce takes it */

static enum percuss_status out_of_memory(const struct reader *reader)
{
    return fault_set(reader->fault, PERCUSS_INTERNAL, "%s: out of memory",
                     reader_short_name(reader->name));
}

/* Whether the path is that of a mesh: any but a body file of percuss-reduce (.h5). */
static bool mesh_order_is_mesh(const char *path)
{
    size_t length = strlen(path);
    return length < 3 || strcmp(path + length - 3, ".h5") != 0;
}

/* Adds one to the order; there is room. */
static enum percuss_status __attribute__((format(printf, 3, 4)))
add_argument(const struct reader *reader, struct body_order *order, const char *format, ...)
{
    va_list arguments;
    char *text;
    va_start(arguments, format);
    int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (length < 0)
        return out_of_memory(reader);
    order->arguments[order->argument_count++] = text;
    return PERCUSS_OK;
}

static enum percuss_status read_unit(struct reader *reader, const yaml_node_t *value,
                                     const struct key *key, struct body_order *order)
{
    static const char *const units[] = {"m", "cm", "mm", "um", "in", "ft"};
    for (size_t i = 0; i < sizeof units / sizeof *units; i++)
        if (reader_is(value, units[i]))
            return add_argument(reader, order, "--unit=%s", units[i]);
    return reader_refuse_value(reader, value, key->allowed);
}

static enum percuss_status read_frequency(struct reader *reader, const yaml_node_t *value,
                                          const struct key *key, struct body_order *order)
{
    double frequency;
    if (!reader_quantity(value, QUANTITY_FREQUENCY, &frequency) ||
        !(frequency >= 1e-3 && frequency <= MOST_FREQUENCY))
        return reader_refuse_quantity(reader, value, QUANTITY_FREQUENCY, key->allowed);
    return add_argument(reader, order, "--max-frequency=%.17g", frequency);
}

static enum percuss_status read_fixed(struct reader *reader, const yaml_node_t *list,
                                      const struct key *key, struct body_order *order)
{
    (void)key;
    enum percuss_status status = PERCUSS_OK;
    size_t count = reader_count(list);
    if (count > BODY_ORDER_SETS)
        return reader_refuse(reader, list, "%zu sets: must be at most %d", count, BODY_ORDER_SETS);
    for (size_t i = 0; !status && i < count; i++) {
        const yaml_node_t *name = reader_element(reader, list, i);
        if (name->type != YAML_SCALAR_NODE || name->data.scalar.length == 0)
            return reader_refuse_value(reader, name, "the name of a set of the mesh");
        status = add_argument(reader, order, "--fixed=%s", (const char *)name->data.scalar.value);
    }
    return status;
}

static enum percuss_status read_instance(struct reader *reader, const yaml_node_t *value,
                                         const struct key *key, struct body_order *order)
{
    if (value->type != YAML_SCALAR_NODE || value->data.scalar.length == 0)
        return reader_refuse_value(reader, value, key->allowed);
    return add_argument(reader, order, "--instance=%s", (const char *)value->data.scalar.value);
}

static enum percuss_status read_raise(struct reader *reader, const yaml_node_t *value,
                                      const struct key *key, struct body_order *order)
{
    if (reader_is(value, "true"))
        return add_argument(reader, order, "--raise");
    return reader_is(value, "false") ? PERCUSS_OK
                                     : reader_refuse_value(reader, value, key->allowed);
}

static enum percuss_status read_flexibility(struct reader *reader, const yaml_node_t *value,
                                            const struct key *key, struct body_order *order)
{
    order->later = reader_is(value, "later");
    if (order->later)
        return add_argument(reader, order, "--flexibility=later");
    return reader_is(value, "ahead") ? PERCUSS_OK
                                     : reader_refuse_value(reader, value, key->allowed);
}

/* Keys that stand beside a mesh alone. */
struct option_key {
    const char *name;
    enum percuss_status (*read)(struct reader *reader, const yaml_node_t *value,
                                const struct key *key, struct body_order *order);
};
static const struct option_key option_keys[] = {
    {"unit", read_unit},         {"max_frequency", read_frequency}, {"fixed", read_fixed},
    {"instance", read_instance}, {"flexibility", read_flexibility}, {"raise", read_raise}};
enum { OPTION_KEYS = sizeof option_keys / sizeof *option_keys };

/* Refuses keys that may only stand beside a mesh. */
static enum percuss_status mesh_order_refuse(struct reader *reader, struct entry entry)
{
    for (size_t i = 0; i < OPTION_KEYS; i++) {
        struct entry key = reader_find(reader, entry.value, option_keys[i].name);
        if (key.value)
            return reader_refuse(reader, key.key,
                                 "%s: must be absent: the file is a reduced body already",
                                 option_keys[i].name);
    }
    return PERCUSS_OK;
}

/* The material as a catalogue that holds nothing else, so that a later reduction has its present
 * numbers. */
static enum percuss_status add_material(const struct reader *reader, const struct material *from,
                                        struct body_order *order)
{
    int used = snprintf(order->material, sizeof order->material,
                        "materials:\n  %s: {young: %.17g, poisson: %.17g, density: %.17g",
                        from->name, from->young, from->poisson, from->density);
    if (isfinite(from->yield))
        used += snprintf(order->material + used, sizeof order->material - (size_t)used,
                         ", yield: %.17g, tangent: %.17g", from->yield, from->tangent);
    snprintf(order->material + used, sizeof order->material - (size_t)used, "}\nbodies: {}\n");
    return add_argument(reader, order, "--material=%s", from->name);
}

/* The order's name: of the method, the bytes of the mesh, the material and the options. */
static enum percuss_status write_name(struct reader *reader, const yaml_node_t *value,
                                      struct body_order *order)
{
    struct fault fault;
    struct sha256 hash = sha256_begin();
    sha256_add(&hash, METHOD, sizeof METHOD);
    sha256_add(&hash, order->material, strlen(order->material) + 1);
    for (size_t i = 0; i < order->argument_count; i++)
        sha256_add(&hash, order->arguments[i], strlen(order->arguments[i]) + 1);
    /* its kind too, by which it is read */
    const char *kind = strrchr(order->mesh, '.');
    sha256_add(&hash, kind ? kind : "", kind ? strlen(kind) + 1 : 1);
    enum percuss_status status = mesh_digest(order->mesh, &hash, &fault);
    sha256_end(&hash, order->name);
    if (status == PERCUSS_INTERNAL)
        return out_of_memory(reader);
    return status ? reader_refuse(reader, value, "%s", reader_short_name(fault.text)) : PERCUSS_OK;
}

/* The reason that a failure left in the folder. */
static void read_reason(const char *folder, const struct body_order *order)
{
    static const char *const suffixes[] = {"failed", "killed"};
    for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes; i++) {
        char *path, reason[400];
        if (asprintf(&path, "%s/%s.%s", folder, order->name, suffixes[i]) < 0)
            return;
        FILE *file = fopen(path, "re");
        free(path);
        if (!file)
            continue;
        reason[fread(reason, 1, sizeof reason - 1, file)] = '\0';
        fclose(file);
        body_order_tell(order, PERCUSS_UNKNOWN_BODY, "its mesh could not be reduced: %s", reason);
    }
}

/* The key of that name, which the kind has. */
static const struct key *find_key(const struct body_kind *kind, const char *name)
{
    const struct key *key = kind->keys;
    while (strcmp(key->name, name) != 0)
        key++;
    return key;
}

static enum percuss_status read_options(struct reader *reader, struct entry entry,
                                        const struct body *body, struct body_order *order)
{
    enum percuss_status status = PERCUSS_OK;
    if (!reader_find(reader, entry.value, "unit").value)
        return reader_refuse(reader, entry.key,
                             "unit: missing: must be m, cm, mm, um, in or ft, the mesh's unit");
    for (size_t i = 0; !status && i < OPTION_KEYS; i++) {
        const yaml_node_t *value = reader_find(reader, entry.value, option_keys[i].name).value;
        if (!value)
            continue;
        size_t mark = reader_enter(reader, option_keys[i].name);
        status =
            option_keys[i].read(reader, value, find_key(body->kind, option_keys[i].name), order);
        if (!status)
            reader_leave(reader, mark);
    }
    if (!status && reader_find(reader, entry.value, "material").value)
        status = add_material(reader, &body->material, order);
    return status;
}

/* Gives the order to the set; false: no memory. */
static bool keep_order(struct body_set *set, const struct body_order *order)
{
    struct body_order *orders = realloc(set->orders, (set->order_count + 1) * sizeof *set->orders);
    if (!orders)
        return false;
    set->orders = orders;
    set->orders[set->order_count++] = *order;
    return true;
}

/* Gives the set an order for a mesh. *path, which came from malloc, becomes that of the reduced
 * body, or NULL where that is not there yet; after a failure it stays. */
static enum percuss_status mesh_order_read(struct reader *reader, struct entry entry,
                                           struct body_set *set, const struct body *body,
                                           char **path)
{
    const yaml_node_t *file = reader_find(reader, entry.value, "file").value;
    struct body_order order = {.mesh = *path};
    char *reduced = NULL;
    size_t mark = reader_enter(reader, "file");
    if (!reader->folder)
        return reader_refuse(reader, file,
                             "%s: must be a body file of percuss-reduce (.h5); a mesh is "
                             "reduced by percussd where its settings name a folder for bodies",
                             reader_excerpt(file).text);
    reader_leave(reader, mark);
    /* its id and options */
    memcpy(order.id, body->id, sizeof order.id);
    enum percuss_status status = body_order_begin(&order)
                                     ? read_options(reader, entry, body, &order)
                                     : out_of_memory(reader);
    if (!status)
        status = write_name(reader, file, &order);
    if (!status && asprintf(&reduced, "%s/%s.h5", reader->folder, order.name) < 0)
        status = out_of_memory(reader);
    /* the set keeps the order with the mesh's path; the caller gets the body's, if it is there */
    if (!status) {
        bool somewhere = reader->folder[0];
        order.made = somewhere && access(reduced, F_OK) == 0;
        if (somewhere && !order.made)
            read_reason(reader->folder, &order);
        if (order.made)
            body_order_tell(&order, PERCUSS_BUSY,
                            "its flexibility there waits to be solved for: ask again later");
        if (keep_order(set, &order)) {
            *path = order.made ? reduced : NULL;
            if (!order.made)
                free(reduced);
            return PERCUSS_OK;
        }
        free(reduced);
        status = out_of_memory(reader);
    }
    order.mesh = NULL;
    body_order_clear(&order);
    return status;
}

/* Gives the set an order for a body without its file, with the fault's text. PERCUSS_OK, or
 * PERCUSS_INTERNAL. */
static enum percuss_status mesh_order_missing(const struct reader *reader, struct body_set *set,
                                              const struct body *body)
{
    struct body_order order = {.missing = true};
    memcpy(order.id, body->id, sizeof order.id);
    bool begun = body_order_begin(&order);
    if (begun)
        body_order_tell(&order, PERCUSS_UNKNOWN_BODY, "its file is missing: %s",
                        reader->fault->text);
    if (begun && keep_order(set, &order)) {
        reader->fault->text[0] = '\0';
        return PERCUSS_OK;
    }
    body_order_clear(&order);
    return out_of_memory(reader);
}

/* ---- the entry of a body ---- */

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

void mesh_files_free(struct mesh_files *files, const struct body_set *set)
{
    for (size_t i = 0; i < set->mesh_count; i++)
        free(files->paths[i]);
    free(files->paths);
    files->paths = NULL;
}

/* Adds a file's body to the set. */
static bool keep_file(struct mesh_files *files, struct body_set *set, struct mesh_body *mesh,
                      char *path)
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
    if (!mesh_surface_prepare(mesh) || !keep_file(files, set, mesh, path)) {
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

/* kg, of the body's volume */
static double material_mass(const struct mesh_body *mesh)
{
    return mesh->volume * mesh->materials[0].density;
}

/* Of a body of one material: whether it has more mass than that, but for rounding. */
static bool has_masses(const struct mesh_body *mesh)
{
    return mesh->mass > (1.0 + 1e-9) * material_mass(mesh);
}

enum percuss_status mesh_entry_read(struct reader *reader, struct entry entry,
                                    struct mesh_files *files, struct body_set *set,
                                    struct body *body)
{
    const yaml_node_t *file = reader_find(reader, entry.value, "file").value;
    const yaml_node_t *material = reader_find(reader, entry.value, "material").value;
    const yaml_node_t *sites = reader_find(reader, entry.value, "sites").value;
    /* the body's own file, or the one that its mesh was reduced to or will be */
    char *path = shipped_resolve(reader->name, (const char *)file->data.scalar.value);
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
    if (material && !is_mesh && has_masses(body->mesh))
        return reader_refuse(
            reader, material,
            "material: must be absent: the file has masses on nodes, %g kg of %g kg, "
            "which no material scales",
            body->mesh->mass - material_mass(body->mesh), body->mesh->mass);
    if (!material)
        body->material = body->mesh->materials[0];
    return sites ? read_sites(reader, sites, body) : PERCUSS_OK;
}
