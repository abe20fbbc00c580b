/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/content.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue/keys.h"
#include "catalogue/mesh_entry.h"
#include "catalogue/names.h"

struct materials {
    struct names names;
    struct stated_material *list; /* in the order of the file */
};

static enum percuss_status out_of_memory(const struct reader *reader)
{
    return fault_set(reader->fault, PERCUSS_INTERNAL, "%s: out of memory",
                     reader_short_name(reader->name));
}

/* Gives a message of the model, "field: value: must be ...", the line of that field. */
static enum percuss_status refuse_field(struct reader *reader, struct entry entry,
                                        const char *message)
{
    char field[64];
    size_t length = strcspn(message, ":");
    snprintf(field, sizeof field, "%.*s", (int)strcspn(message, ":.["), message);
    const yaml_node_t *at = reader_find(reader, entry.value, field).value;
    snprintf(field, sizeof field, "%.*s", (int)length, message);
    reader_enter(reader, field);
    const char *rest = message + length;
    return reader_refuse(reader, at ? at : entry.key, "%s", rest + strspn(rest, ": "));
}

static enum percuss_status read_material(struct reader *reader, struct entry entry,
                                         struct stated_material *stated)
{
    struct material *material = &stated->material;
    *stated = (struct stated_material){
        .material.yield = INFINITY, .loss_factor = NAN, .yield_unstated = true};
    memcpy(material->name, entry.key->data.scalar.value, entry.key->data.scalar.length);
    size_t mark = reader_enter(reader, material->name);
    enum percuss_status status = keys_read(reader, entry, &keys_material, stated);
    if (status)
        return status;
    struct fault fault = {0};
    if (material_check(material, &fault))
        return refuse_field(reader, entry, fault.text);
    reader_leave(reader, mark);
    return PERCUSS_OK;
}

static enum percuss_status read_materials(struct reader *reader, const yaml_node_t *mapping,
                                          struct materials *materials)
{
    size_t mark = reader_enter(reader, "materials");
    enum percuss_status status = names_read(reader, mapping, &materials->names);
    if (status)
        return status;
    materials->list = malloc(materials->names.count * sizeof *materials->list);
    if (!materials->list)
        return out_of_memory(reader);
    for (size_t i = 0; !status && i < materials->names.count; i++)
        status = read_material(reader, reader_entry(reader, mapping, i), &materials->list[i]);
    if (!status)
        reader_leave(reader, mark);
    return status;
}

static void materials_free(struct materials *materials)
{
    names_free(&materials->names);
    free(materials->list);
}

/* The kind decides which other keys are allowed. */
static enum percuss_status read_kind(struct reader *reader, struct entry entry, struct body *body)
{
    const struct key *key = &keys_body.keys[0];
    if (entry.value->type != YAML_MAPPING_NODE)
        return reader_refuse_value(reader, entry.value, "a mapping with shape, material, ...");
    const yaml_node_t *value = reader_find(reader, entry.value, key->name).value;
    size_t mark = reader_enter(reader, key->name);
    if (!value)
        return reader_refuse(reader, entry.key, "missing: must be %s", key_allowed(key).text);
    enum percuss_status status = keys_read_value(reader, value, key, body);
    if (!status)
        reader_leave(reader, mark);
    return status;
}

static enum percuss_status find_material(struct reader *reader, struct entry entry,
                                         const struct materials *materials, struct body *body)
{
    size_t position = names_find(&materials->names, body->material.name);
    if (position < materials->names.count) {
        body->material = materials->list[position].material;
        body->loss_factor = materials->list[position].loss_factor;
        body->yield_unstated = materials->list[position].yield_unstated;
        return PERCUSS_OK;
    }
    const yaml_node_t *value = reader_find(reader, entry.value, "material").value;
    reader_enter(reader, "material");
    return reader_refuse(reader, value, "%s: unknown material; must be one of %s",
                         reader_excerpt(value).text, names_list(&materials->names).text);
}

/* What its keys do not say: the material's numbers, and a file with all that follows. */
static enum percuss_status read_rest(struct reader *reader, struct entry entry,
                                     const struct materials *materials, struct mesh_files *files,
                                     struct body_set *set, struct body *body)
{
    enum percuss_status status = PERCUSS_OK;
    if (!body->kind->own_material || reader_find(reader, entry.value, "material").value)
        status = find_material(reader, entry, materials, body);
    if (!status && body->kind->own_material)
        status = mesh_entry_read(reader, entry, files, set, body);
    /* a mode of the ratio d loses 4 pi d of its energy in a cycle, the material 2 pi loss_factor */
    if (!status && body->loss_factor > 0.0 && body_can_vibrate(body) &&
        !reader_find(reader, entry.value, "damping").value)
        body->damping = 0.5 * body->loss_factor;
    return status;
}

/* Whether its mesh is still to be reduced. */
static bool is_ordered(const struct body *body)
{
    return body->kind->own_material && !body->mesh;
}

static enum percuss_status read_body(struct reader *reader, struct entry entry,
                                     const struct materials *materials, struct mesh_files *files,
                                     struct body_set *set, struct body *body)
{
    memcpy(body->id, entry.key->data.scalar.value, entry.key->data.scalar.length);
    size_t mark = reader_enter(reader, body->id);
    /* its kind first, which says what other keys there are */
    enum percuss_status status = read_kind(reader, entry, body);
    if (status)
        return status;
    const struct key_table keys = {body->kind->name, body->kind->keys, body->kind->key_count,
                                   body->kind->own_material ? &keys_own : &keys_body};
    status = keys_read(reader, entry, &keys, body);
    if (!status)
        status = read_rest(reader, entry, materials, files, set, body);
    if (status)
        return status;
    /* what follows from them, if they make a body already */
    if (is_ordered(body)) {
        reader_leave(reader, mark);
        return PERCUSS_OK;
    }
    struct fault fault = {0};
    if (body_complete(body, &fault))
        return refuse_field(reader, entry, fault.text);
    reader_leave(reader, mark);
    return PERCUSS_OK;
}

static enum percuss_status read_bodies(struct reader *reader, const yaml_node_t *mapping,
                                       const struct materials *materials, struct body_set *set)
{
    struct names names;
    size_t mark = reader_enter(reader, "bodies");
    enum percuss_status status = names_read(reader, mapping, &names);
    if (status)
        return status;
    size_t count = names.count;
    names_free(&names);
    set->bodies = malloc(count * sizeof *set->bodies);
    if (!set->bodies)
        return out_of_memory(reader);
    struct mesh_files files = {NULL};
    for (size_t i = 0; !status && i < count; i++) {
        /* counted with what it owns, whether it is accepted or not */
        set->bodies[set->count++] =
            (struct body){.tip_radius = INFINITY, .loss_factor = NAN, .yield_unstated = true};
        struct body *body = &set->bodies[set->count - 1];
        status = read_body(reader, reader_entry(reader, mapping, i), materials, &files, set, body);
        /* what is not there yet is no body of the set */
        if (!status && is_ordered(body)) {
            free(body->sites);
            free(body->damping_shares);
            set->count--;
        }
    }
    mesh_files_free(&files, set);
    if (!status)
        reader_leave(reader, mark);
    return status;
}

/* A file that is written while it is read, or was cut off, has lost its end. */
static enum percuss_status check_marks(struct reader *reader, const yaml_node_t *root,
                                       const struct body_set *set)
{
    if (set->begin == set->end)
        return PERCUSS_OK;
    struct entry mark = reader_find(reader, root, set->begin ? "begin" : "end");
    return reader_refuse(reader, mark.key,
                         set->begin ? "begin: stands without end: must have a last line `end: "
                                      "true`: the file may be cut off"
                                    : "end: stands without begin: must have a first line `begin: "
                                      "true`: the file may be cut off");
}

enum percuss_status content_read(struct reader *reader, struct body_set *set)
{
    struct materials materials = {0};
    const yaml_node_t *root = yaml_document_get_root_node(reader->document);
    *set = (struct body_set){.compliance = PERCUSS_COMPLIANCE_MATCHED};
    enum percuss_status status = keys_read(reader, (struct entry){root, root}, &keys_top, set);
    if (!status)
        status = check_marks(reader, root, set);
    if (!status)
        status = read_materials(reader, reader_find(reader, root, "materials").value, &materials);
    if (!status)
        status = read_bodies(reader, reader_find(reader, root, "bodies").value, &materials, set);
    materials_free(&materials);
    if (status)
        body_set_clear(set);
    return status;
}

enum percuss_status content_read_material(struct reader *reader, const char *name,
                                          struct material *material)
{
    struct materials materials = {0};
    const yaml_node_t *root = yaml_document_get_root_node(reader->document);
    struct entry mapping = reader_find(reader, root, "materials");
    if (!mapping.value || mapping.value->type != YAML_MAPPING_NODE)
        return reader_refuse(reader, root, "materials: missing: must be a mapping of names");
    enum percuss_status status = read_materials(reader, mapping.value, &materials);
    size_t position = status ? 0 : names_find(&materials.names, name);
    if (!status && position < materials.names.count)
        *material = materials.list[position].material;
    else if (!status)
        status = reader_refuse(reader, mapping.key,
                               "materials: %.63s: unknown material; must be one of %s", name,
                               names_list(&materials.names).text);
    materials_free(&materials);
    return status;
}
