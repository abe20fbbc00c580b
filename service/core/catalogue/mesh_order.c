/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/mesh_order.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/sha256.h"
#include "mesh/mesh_read.h"
#include "model/key.h"

/* Version of percuss-reduce's results: raise it where they change for the same mesh. */
static const char METHOD[] = "percuss reduced body 2";
static const double MOST_FREQUENCY = 1e12; /* Hz, as far as percuss-reduce takes it */

static enum percuss_status out_of_memory(const struct reader *reader)
{
    return fault_set(reader->fault, PERCUSS_INTERNAL, "%s: out of memory",
                     reader_short_name(reader->name));
}

bool mesh_order_is_mesh(const char *path)
{
    size_t length = strlen(path);
    return length < 3 || strcmp(path + length - 3, ".h5") != 0;
}

/* Adds one to the order; there is room. */
static enum percuss_status __attribute__((format(printf, 3, 4)))
add(const struct reader *reader, struct body_order *order, const char *format, ...)
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
            return add(reader, order, "--unit=%s", units[i]);
    return reader_refuse_value(reader, value, key->allowed);
}

static enum percuss_status read_frequency(struct reader *reader, const yaml_node_t *value,
                                          const struct key *key, struct body_order *order)
{
    double frequency;
    if (!reader_quantity(value, QUANTITY_FREQUENCY, &frequency) ||
        !(frequency >= 1e-3 && frequency <= MOST_FREQUENCY))
        return reader_refuse_quantity(reader, value, QUANTITY_FREQUENCY, key->allowed);
    return add(reader, order, "--max-frequency=%.17g", frequency);
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
        status = add(reader, order, "--fixed=%s", (const char *)name->data.scalar.value);
    }
    return status;
}

/* Keys that stand beside a mesh alone. */
struct option_key {
    const char *name;
    enum percuss_status (*read)(struct reader *reader, const yaml_node_t *value,
                                const struct key *key, struct body_order *order);
};
static const struct option_key option_keys[] = {
    {"unit", read_unit}, {"max_frequency", read_frequency}, {"fixed", read_fixed}};
enum { OPTION_KEYS = sizeof option_keys / sizeof *option_keys };

enum percuss_status mesh_order_refuse(struct reader *reader, struct entry entry)
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
    return add(reader, order, "--material=%s", from->name);
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
static bool keep(struct body_set *set, const struct body_order *order)
{
    struct body_order *orders = realloc(set->orders, (set->order_count + 1) * sizeof *set->orders);
    if (!orders)
        return false;
    set->orders = orders;
    set->orders[set->order_count++] = *order;
    return true;
}

enum percuss_status mesh_order_read(struct reader *reader, struct entry entry, struct body_set *set,
                                    const struct body *body, char **path)
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
        if (keep(set, &order)) {
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

enum percuss_status mesh_order_missing(const struct reader *reader, struct body_set *set,
                                       const struct body *body)
{
    struct body_order order = {.missing = true};
    memcpy(order.id, body->id, sizeof order.id);
    bool begun = body_order_begin(&order);
    if (begun)
        body_order_tell(&order, PERCUSS_UNKNOWN_BODY, "its file is missing: %s",
                        reader->fault->text);
    if (begun && keep(set, &order)) {
        reader->fault->text[0] = '\0';
        return PERCUSS_OK;
    }
    body_order_clear(&order);
    return out_of_memory(reader);
}
