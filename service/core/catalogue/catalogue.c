/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/catalogue.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "catalogue/keys.h"
#include "catalogue/law_entry.h"
#include "catalogue/mesh_entry.h"
#include "catalogue/names.h"
#include "catalogue/reader.h"
#include "catalogue/revision.h"

static enum percuss_status out_of_memory(const char *name, struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", reader_short_name(name));
}

/* The guard refuses, before a document is built, parts of YAML that a catalogue does not need and a
 * hostile text could abuse. */

enum { MAX_DEPTH = 8, MAX_VALUES = 3000000 };

struct guard {
    const char *text;
    const char *name;
    struct fault *fault;
    size_t depth, values, documents;
};

static enum percuss_status guard_refuse(const struct guard *guard, size_t line, const char *message)
{
    return fault_set(guard->fault, PERCUSS_BAD_REQUEST, "%s:%zu: %s",
                     reader_short_name(guard->name), line + 1, message);
}

static size_t lines_before(const struct guard *guard, size_t offset)
{
    size_t line = 0;
    for (size_t i = 0; i < offset; i++)
        line += guard->text[i] == '\n';
    return line;
}

/* libyaml compares each tag directive with all before it, within one step of the parser. */
static enum percuss_status check_directives(const struct guard *guard, size_t size)
{
    static const char directive[] = "%TAG";
    const char *found = memmem(guard->text, size, directive, sizeof directive - 1);
    if (!found)
        return PERCUSS_OK;
    return guard_refuse(guard, lines_before(guard, (size_t)(found - guard->text)),
                        "%TAG must not be used: write plain values");
}

/* A bad byte comes with its offset only. */
static enum percuss_status encoding_fault(const struct guard *guard, const yaml_parser_t *parser,
                                          size_t size)
{
    size_t offset = parser->problem_offset;
    size_t line = lines_before(guard, offset < size ? offset : size);
    char message[160];
    snprintf(message, sizeof message, "must be UTF-8 text without control characters: %s",
             parser->problem);
    return guard_refuse(guard, line, message);
}

static enum percuss_status syntax_fault(const struct guard *guard, const yaml_parser_t *parser,
                                        size_t size)
{
    if (parser->error == YAML_MEMORY_ERROR)
        return out_of_memory(guard->name, guard->fault);
    if (parser->error == YAML_READER_ERROR)
        return encoding_fault(guard, parser, size);
    char message[320];
    int length = snprintf(message, sizeof message, "must be valid YAML: %s",
                          parser->problem ? parser->problem : "unknown error");
    if (parser->context && length < (int)sizeof message)
        snprintf(message + length, sizeof message - (size_t)length, " (%s, from line %zu)",
                 parser->context, parser->context_mark.line + 1);
    return guard_refuse(guard, parser->problem_mark.line, message);
}

static bool has_anchor(const yaml_event_t *event)
{
    return event->type == YAML_ALIAS_EVENT ||
           (event->type == YAML_SCALAR_EVENT && event->data.scalar.anchor) ||
           (event->type == YAML_SEQUENCE_START_EVENT && event->data.sequence_start.anchor) ||
           (event->type == YAML_MAPPING_START_EVENT && event->data.mapping_start.anchor);
}

static bool has_tag(const yaml_event_t *event)
{
    return (event->type == YAML_SCALAR_EVENT && event->data.scalar.tag) ||
           (event->type == YAML_SEQUENCE_START_EVENT && event->data.sequence_start.tag) ||
           (event->type == YAML_MAPPING_START_EVENT && event->data.mapping_start.tag);
}

static void guard_count(struct guard *guard, const yaml_event_t *event)
{
    switch (event->type) {
    case YAML_DOCUMENT_START_EVENT:
        guard->documents++;
        break;
    case YAML_SEQUENCE_START_EVENT:
    case YAML_MAPPING_START_EVENT:
        guard->depth++;
        guard->values++;
        break;
    case YAML_SCALAR_EVENT:
        guard->values++;
        break;
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT:
        guard->depth--;
        break;
    default:
        break;
    }
}

static enum percuss_status guard_inspect(struct guard *guard, const yaml_event_t *event)
{
    size_t line = event->start_mark.line;
    guard_count(guard, event);
    if (has_anchor(event))
        return guard_refuse(
            guard, line,
            "anchors and aliases (&name, *name) must not be used: write the value out");
    if (has_tag(event))
        return guard_refuse(guard, line, "tags (!name) must not be used: write the plain value");
    if (guard->documents > 1)
        return guard_refuse(guard, line, "a second document: must be a single one");
    if (guard->depth > MAX_DEPTH)
        return guard_refuse(guard, line, "nested too deeply: must be at most 8 levels");
    if (guard->values > MAX_VALUES)
        return guard_refuse(guard, line, "too many values: must be at most 3000000");
    return PERCUSS_OK;
}

static enum percuss_status guard_scan(struct guard *guard, yaml_parser_t *parser, size_t size)
{
    enum percuss_status status = PERCUSS_OK;
    bool more = true;
    while (!status && more) {
        yaml_event_t event;
        if (!yaml_parser_parse(parser, &event))
            return syntax_fault(guard, parser, size);
        status = guard_inspect(guard, &event);
        more = event.type != YAML_STREAM_END_EVENT;
        yaml_event_delete(&event);
    }
    if (!status && guard->documents == 0)
        status = guard_refuse(guard, 0, "an empty file: must hold materials and bodies");
    return status;
}

/* PERCUSS_OK if the text is exactly one YAML document without anchors, aliases and tags, of bounded
 * depth and number of values; else PERCUSS_BAD_REQUEST with "NAME:LINE: ...", or PERCUSS_INTERNAL
 * without memory. */
static enum percuss_status guard_check(const char *text, size_t size, const char *name,
                                       struct fault *fault)
{
    struct guard guard = {.text = text, .name = name, .fault = fault};
    yaml_parser_t parser;
    enum percuss_status status = check_directives(&guard, size);
    if (status)
        return status;
    if (!yaml_parser_initialize(&parser))
        return out_of_memory(name, fault);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    status = guard_scan(&guard, &parser, size);
    yaml_parser_delete(&parser);
    return status;
}

/* The content: a document becomes a set of bodies. */

struct materials {
    struct names names;
    struct stated_material *list; /* in the order of the file */
};

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

static enum percuss_status read_terms(struct reader *reader, const yaml_node_t *list,
                                      struct relaxation *relaxation)
{
    double sum = 0.0;
    for (size_t i = 0; i < reader_count(list); i++) {
        const yaml_node_t *mapping = reader_element(reader, list, i);
        struct stated_term term;
        char index[24];
        snprintf(index, sizeof index, "[%zu]", i);
        size_t mark = reader_enter(reader, index);
        enum percuss_status status =
            keys_read(reader, (struct entry){mapping, mapping}, &keys_relaxation, &term);
        if (status)
            return status;
        sum += term.share;
        if (!(sum < 1.0))
            return reader_refuse(reader, mapping,
                                 "share: %.9g: all shares up to this one must add up to less than "
                                 "1, not %.9g",
                                 term.share, sum);
        relaxation_add(relaxation, term.share, term.time);
        reader_leave(reader, mark);
    }
    return PERCUSS_OK;
}

/* Nothing where the key is absent. */
static enum percuss_status read_relaxation(struct reader *reader, struct entry entry,
                                           struct stated_material *stated)
{
    struct entry item = reader_find(reader, entry.value, "relaxation");
    if (!item.value)
        return PERCUSS_OK;
    size_t mark = reader_enter(reader, "relaxation"), count = reader_count(item.value);
    if (count < 1 || count > RELAXATION_TERMS)
        return reader_refuse(reader, item.value, "%zu terms: must be 1 to %d", count,
                             RELAXATION_TERMS);
    enum percuss_status status = read_terms(reader, item.value, &stated->relaxation);
    if (!status)
        reader_leave(reader, mark);
    return status;
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
    if (!status)
        status = read_relaxation(reader, entry, stated);
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
        return out_of_memory(reader->name, reader->fault);
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

/* Friction between materials. */

struct stated_pair {
    struct friction_pair pair;
    size_t position; /* in the list */
    size_t line;
};

/* Two names of materials, in order. */
static enum percuss_status read_between(struct reader *reader, const yaml_node_t *list,
                                        const struct materials *materials, const char *allowed,
                                        char between[2][PERCUSS_ID_SIZE])
{
    size_t mark = reader_enter(reader, "between");
    if (reader_count(list) != 2)
        return reader_refuse_value(reader, list, allowed);
    for (size_t i = 0; i < 2; i++) {
        const yaml_node_t *name = reader_element(reader, list, i);
        size_t position = name->type == YAML_SCALAR_NODE
                              ? names_find(&materials->names, (const char *)name->data.scalar.value)
                              : materials->names.count;
        if (position == materials->names.count)
            return reader_refuse(reader, name, "%s: unknown material; must be one of %s",
                                 reader_excerpt(name).text, names_list(&materials->names).text);
        memcpy(between[i], materials->list[position].material.name, PERCUSS_ID_SIZE);
    }
    if (strcmp(between[0], between[1]) > 0) {
        char first[PERCUSS_ID_SIZE];
        memcpy(first, between[0], PERCUSS_ID_SIZE);
        memcpy(between[0], between[1], PERCUSS_ID_SIZE);
        memcpy(between[1], first, PERCUSS_ID_SIZE);
    }
    reader_leave(reader, mark);
    return PERCUSS_OK;
}

static enum percuss_status read_pair(struct reader *reader, const yaml_node_t *mapping,
                                     const struct materials *materials, struct friction_pair *pair)
{
    *pair = (struct friction_pair){.deviation = NAN};
    enum percuss_status status =
        keys_read(reader, (struct entry){mapping, mapping}, &keys_friction, pair);
    if (!status)
        status = read_between(reader, reader_find(reader, mapping, "between").value, materials,
                              key_allowed(&keys_friction.keys[0]).text, pair->between);
    if (isnan(pair->deviation))
        pair->deviation = FRICTION_USUAL_DEVIATION * pair->coefficient;
    return status;
}

/* Equal ones by their place in the file. */
static int stated_pair_order(const void *a, const void *b)
{
    const struct stated_pair *x = a, *y = b;
    int order = friction_pair_order(&x->pair, &y->pair);
    return order ? order : (x->position > y->position) - (x->position < y->position);
}

/* Sorts them, and refuses a pair that stands twice. */
static enum percuss_status sort_pairs(struct reader *reader, const yaml_node_t *list,
                                      struct stated_pair *pairs, size_t count)
{
    qsort(pairs, count, sizeof *pairs, stated_pair_order);
    for (size_t i = 1; i < count; i++) {
        const struct stated_pair *first = &pairs[i - 1], *again = &pairs[i];
        char index[24];
        if (friction_pair_order(&first->pair, &again->pair) != 0)
            continue;
        snprintf(index, sizeof index, "[%zu]", again->position);
        reader_enter(reader, index);
        return reader_refuse(reader, reader_element(reader, list, again->position),
                             "between %s and %s: must stand once, but is on line %zu already",
                             again->pair.between[0], again->pair.between[1], first->line);
    }
    return PERCUSS_OK;
}

static enum percuss_status read_pairs(struct reader *reader, const yaml_node_t *list,
                                      const struct materials *materials, struct stated_pair *pairs,
                                      size_t count)
{
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && i < count; i++) {
        const yaml_node_t *mapping = reader_element(reader, list, i);
        char index[24];
        snprintf(index, sizeof index, "[%zu]", i);
        size_t mark = reader_enter(reader, index);
        status = read_pair(reader, mapping, materials, &pairs[i].pair);
        pairs[i].position = i;
        pairs[i].line = mapping->start_mark.line + 1;
        if (!status)
            reader_leave(reader, mark);
    }
    return status ? status : sort_pairs(reader, list, pairs, count);
}

/* Nothing where the key is absent or its list empty. */
static enum percuss_status read_friction(struct reader *reader, const yaml_node_t *list,
                                         const struct materials *materials, struct body_set *set)
{
    size_t count = list ? reader_count(list) : 0;
    if (count == 0)
        return PERCUSS_OK;
    struct stated_pair *pairs = malloc(count * sizeof *pairs);
    set->friction = malloc(count * sizeof *set->friction);
    size_t mark = reader_enter(reader, "friction");
    enum percuss_status status = pairs && set->friction
                                     ? read_pairs(reader, list, materials, pairs, count)
                                     : out_of_memory(reader->name, reader->fault);
    if (!status) {
        for (size_t i = 0; i < count; i++)
            set->friction[set->friction_count++] = pairs[i].pair;
        reader_leave(reader, mark);
    }
    free(pairs);
    return status;
}

/* Laws of contacts. */

/* Refuses a law for materials that another one is for. */
static enum percuss_status check_other_laws(struct reader *reader, struct entry entry,
                                            const struct own_law *law, const struct body_set *set)
{
    for (size_t i = 0; i < set->law_count; i++)
        if (memcmp(set->laws[i].between, law->between, sizeof law->between) == 0)
            return reader_refuse(reader, entry.key,
                                 "between %s and %s: must have one law, and has that of %s",
                                 law->between[0], law->between[1], set->laws[i].name);
    return PERCUSS_OK;
}

static enum percuss_status read_law(struct reader *reader, struct entry entry,
                                    const struct materials *materials, struct body_set *set)
{
    struct own_law law = {.exponent = 1.5, .deviation = OWN_LAW_USUAL_DEVIATION};
    memcpy(law.name, entry.key->data.scalar.value, entry.key->data.scalar.length);
    size_t mark = reader_enter(reader, law.name);
    enum percuss_status status = keys_read(reader, entry, &keys_law, &law);
    if (!status)
        status = read_between(reader, reader_find(reader, entry.value, "between").value, materials,
                              key_allowed(&keys_law.keys[0]).text, law.between);
    if (!status)
        status = check_other_laws(reader, entry, &law, set);
    if (!status)
        status = law_entry_read(reader, entry, &law);
    if (status) {
        own_law_clear(&law);
        return status;
    }
    set->laws[set->law_count++] = law;
    reader_leave(reader, mark);
    return PERCUSS_OK;
}

static int by_name(const void *a, const void *b)
{
    const struct own_law *x = a, *y = b;
    return strcmp(x->name, y->name);
}

/* By their names, so that their order in the file does not matter. */
static enum percuss_status read_laws(struct reader *reader, const yaml_node_t *mapping,
                                     const struct materials *materials, struct body_set *set)
{
    struct names names;
    if (!mapping)
        return PERCUSS_OK;
    size_t mark = reader_enter(reader, "laws");
    enum percuss_status status = names_read(reader, mapping, &names);
    if (status)
        return status;
    set->laws = malloc((names.count + 1) * sizeof *set->laws);
    if (!set->laws)
        status = out_of_memory(reader->name, reader->fault);
    for (size_t i = 0; !status && i < names.count; i++)
        status = read_law(reader, reader_entry(reader, mapping, i), materials, set);
    names_free(&names);
    if (status)
        return status;
    qsort(set->laws, set->law_count, sizeof *set->laws, by_name);
    reader_leave(reader, mark);
    return PERCUSS_OK;
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
        body->loss_frequency = materials->list[position].loss_frequency;
        body->relaxation = materials->list[position].relaxation;
        body->yield_rate = materials->list[position].yield_rate;
        body->yield_unstated = materials->list[position].yield_unstated;
        return PERCUSS_OK;
    }
    const yaml_node_t *value = reader_find(reader, entry.value, "material").value;
    reader_enter(reader, "material");
    return reader_refuse(reader, value, "%s: unknown material; must be one of %s",
                         reader_excerpt(value).text, names_list(&materials->names).text);
}

/* Damps the modes of a body that states no damping by what its material loses. A mode of the ratio
 * d loses 4 pi d of its energy in a cycle, the material 2 pi times its loss factor. */
static enum percuss_status damp(struct reader *reader, struct entry entry, struct body *body)
{
    if (!body_can_vibrate(body) || reader_find(reader, entry.value, "damping").value)
        return PERCUSS_OK;
    body->damping_peak = relaxation_peak_loss(&body->relaxation, 0.0);
    double loss_factor = body->relaxation.count > 0 ? body->damping_peak : body->loss_factor;
    if (loss_factor > 0.0)
        body->damping = 0.5 * loss_factor;
    if (body->damping < limit_damping.high)
        return PERCUSS_OK;
    reader_enter(reader, "damping");
    return reader_refuse(reader, entry.key,
                         "missing: must be stated, as the loss factor of %s reaches %.3g (its "
                         "modes are damped by half of it, which must be < 1)",
                         body->material.name, loss_factor);
}

/* The rest of a body: the material's numbers, and its file. */
static enum percuss_status read_rest(struct reader *reader, struct entry entry,
                                     const struct materials *materials, struct mesh_files *files,
                                     struct body_set *set, struct body *body)
{
    enum percuss_status status = PERCUSS_OK;
    if (!body->kind->own_material || reader_find(reader, entry.value, "material").value)
        status = find_material(reader, entry, materials, body);
    if (!status && body->kind->own_material)
        status = mesh_entry_read(reader, entry, files, set, body);
    return status ? status : damp(reader, entry, body);
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
    /* its kind first, which decides the other keys */
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
    /* the derived numbers, unless the mesh is still to be reduced */
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
        return out_of_memory(reader->name, reader->fault);
    struct mesh_files files = {NULL};
    for (size_t i = 0; !status && i < count; i++) {
        /* counted even if it is refused: the set frees its memory */
        set->bodies[set->count++] =
            (struct body){.tip_radius = INFINITY, .loss_factor = NAN, .yield_unstated = true};
        struct body *body = &set->bodies[set->count - 1];
        status = read_body(reader, reader_entry(reader, mapping, i), materials, &files, set, body);
        /* a body that is not reduced yet is not in the set */
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

/* Reads a whole document into an empty set: materials, friction, laws, bodies (completed), contact;
 * the revision is left to the caller. After a failure the set holds nothing. */
static enum percuss_status content_read(struct reader *reader, struct body_set *set)
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
        status =
            read_friction(reader, reader_find(reader, root, "friction").value, &materials, set);
    if (!status)
        status = read_laws(reader, reader_find(reader, root, "laws").value, &materials, set);
    if (!status)
        status = read_bodies(reader, reader_find(reader, root, "bodies").value, &materials, set);
    materials_free(&materials);
    if (status)
        body_set_clear(set);
    return status;
}

/* Reads the materials alone, and takes the one of that name. */
static enum percuss_status content_read_material(struct reader *reader, const char *name,
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

/* Files and texts. */

/* The guard has parsed the same text before: only memory can fail here. */
static enum percuss_status load_document(const char *text, size_t size, const char *name,
                                         yaml_document_t *document, struct fault *fault)
{
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser))
        return out_of_memory(name, fault);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    int loaded = yaml_parser_load(&parser, document);
    yaml_parser_delete(&parser);
    return loaded ? PERCUSS_OK : out_of_memory(name, fault);
}

/* The product of a document. */
struct product {
    struct body_set *set;
    const char *folder; /* of reduced bodies; NULL: none */
    bool lenient;       /* a body without its file becomes an order */
    const char *name;   /* of the material wanted; NULL: the whole set is */
    struct material *material;
};

static enum percuss_status read_product(struct reader *reader, const struct product *product)
{
    if (product->name)
        return content_read_material(reader, product->name, product->material);
    enum percuss_status status = content_read(reader, product->set);
    return status ? status : revision_write(product->set, reader->fault);
}

static enum percuss_status parse(const char *text, size_t size, const char *name,
                                 const struct product *product, struct fault *fault)
{
    yaml_document_t document;
    enum percuss_status status = guard_check(text, size, name, fault);
    if (!status)
        status = load_document(text, size, name, &document, fault);
    if (status)
        return status;
    struct reader reader = {.document = &document,
                            .name = name,
                            .folder = product->folder,
                            .lenient = product->lenient,
                            .fault = fault};
    status = read_product(&reader, product);
    yaml_document_delete(&document);
    return status;
}

/* Numbers have a decimal point in every locale, in the file and in messages. */
static enum percuss_status parse_plainly(const char *text, size_t size, const char *name,
                                         const struct product *product, struct fault *fault)
{
    if (size > CATALOGUE_MAX_BYTES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: too long: must be at most %d bytes",
                         reader_short_name(name), CATALOGUE_MAX_BYTES);
    locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (!plain)
        return out_of_memory(name, fault);
    locale_t caller = uselocale(plain);
    enum percuss_status status = parse(text ? text : "", text ? size : 0, name, product, fault);
    uselocale(caller);
    freelocale(plain);
    return status;
}

static enum percuss_status parse_set(const char *text, size_t size, const char *name,
                                     struct product product, struct body_set **set,
                                     struct fault *fault)
{
    /* the caller gets a whole set or none */
    struct body_set *fresh = calloc(1, sizeof *fresh);
    *set = NULL;
    if (!fresh)
        return out_of_memory(name, fault);
    product.set = fresh;
    enum percuss_status status = parse_plainly(text, size, name, &product, fault);
    if (status)
        body_set_free(fresh);
    else
        *set = fresh;
    return status;
}

enum percuss_status catalogue_parse(const char *text, size_t size, const char *name,
                                    struct body_set **set, struct fault *fault)
{
    return parse_set(text, size, name, (struct product){.set = NULL}, set, fault);
}

static enum percuss_status unreadable(const char *path, struct fault *fault)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: cannot be read: %s", reader_short_name(path),
                     strerror(errno));
}

/* The text of a file, for free(). */
static enum percuss_status read_file(const char *path, char **text, size_t *size,
                                     struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    size_t got;
    *size = 0;
    FILE *file = fopen(path, "rbe");
    if (!file)
        return unreadable(path, fault);
    /* one byte more than allowed tells a file that is too long */
    *text = malloc(CATALOGUE_MAX_BYTES + 1);
    if (!*text) {
        status = out_of_memory(path, fault);
        goto close;
    }
    while ((got = fread(*text + *size, 1, CATALOGUE_MAX_BYTES + 1 - *size, file)) > 0)
        *size += got;
    if (ferror(file)) {
        status = unreadable(path, fault);
        free(*text);
    }
close:
    fclose(file);
    return status;
}

static enum percuss_status load(const char *path, struct product product, struct body_set **set,
                                struct fault *fault)
{
    char *text;
    size_t size;
    *set = NULL;
    enum percuss_status status = read_file(path, &text, &size, fault);
    if (status)
        return status;
    status = parse_set(text, size, path, product, set, fault);
    free(text);
    return status;
}

enum percuss_status catalogue_load(const char *path, struct body_set **set, struct fault *fault)
{
    return load(path, (struct product){.set = NULL}, set, fault);
}

enum percuss_status catalogue_load_reducing(const char *path, const char *folder,
                                            struct body_set **set, struct fault *fault)
{
    return load(path, (struct product){.folder = folder, .lenient = true}, set, fault);
}

enum percuss_status catalogue_material(const char *path, const char *name,
                                       struct material *material, struct fault *fault)
{
    char *text;
    size_t size;
    const struct product product = {.name = name, .material = material};
    enum percuss_status status = read_file(path, &text, &size, fault);
    if (status)
        return status;
    status = parse_plainly(text, size, path, &product, fault);
    free(text);
    return status;
}
