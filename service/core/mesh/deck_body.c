/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/deck_body.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/builder.h"
#include "mesh/deck_material.h"
#include "mesh/grow.h"
#include "model/vector.h"

/* an element of the body by its label */
struct place {
    size_t label, index; /* index: of deck.elements */
};

/* Owns its lists; the deck is borrowed. */
struct body {
    struct deck *deck;
    struct builder builder;
    size_t part, instance; /* scopes of its mesh; the same where there is no instance */
    size_t count;
    struct place *places;      /* ascending */
    struct builder_list nodes; /* its labels, ascending */
    size_t missing;    /* elements and faces that the set under way names, and are not there */
    size_t *built;     /* [deck.element_count]: index in the builder; DECK_NONE: no solid of it */
    size_t *sectioned; /* [deck.element_count]: index of its deck.sections; DECK_NONE: none */
    struct fault *fault;
};

/* sets within sets, at most */
enum { DEEPEST_SET = 12 };

static enum percuss_status body_out_of_memory(const struct body *body)
{
    return fault_set(body->fault, PERCUSS_INTERNAL, "%s: out of memory", body->deck->files[0]);
}

/* ---- which body ---- */

static bool holds_solids(const struct deck *deck, size_t scope)
{
    for (size_t e = 0; e < deck->element_count; e++)
        if (deck->elements[e].scope == scope && deck->elements[e].kind != DECK_OTHER)
            return true;
    return false;
}

static size_t part_of(const struct deck *deck, size_t instance)
{
    for (size_t s = 0; s < deck->scope_count; s++)
        if (deck->scopes[s].kind == DECK_PART &&
            deck_same(deck->scopes[s].name, deck->scopes[instance].of))
            return s;
    return DECK_NONE;
}

/* Whether this scope is a body: the deck itself or an instance with solids, or a part where nothing
 * has instances. */
static bool is_body(const struct deck *deck, size_t scope, bool instances, size_t *part)
{
    enum deck_scope_kind kind = deck->scopes[scope].kind;
    *part = scope;
    if (kind == DECK_ASSEMBLY || (kind == DECK_PART && instances))
        return false;
    if (kind == DECK_INSTANCE && (*part = part_of(deck, scope)) == DECK_NONE)
        *part = scope;
    return holds_solids(deck, scope) || holds_solids(deck, *part);
}

static void join_name(char *list, size_t size, const char *name)
{
    size_t length = strlen(list);
    snprintf(list + length, size - length, "%s%s", length ? ", " : "",
             *name ? name : "the deck itself");
}

static enum percuss_status choose_body(struct body *body, const char *wanted)
{
    const struct deck *deck = body->deck;
    bool instances = false;
    size_t count = 0, part;
    char list[400] = "";
    for (size_t s = 0; s < deck->scope_count; s++)
        instances = instances || deck->scopes[s].kind == DECK_INSTANCE;
    body->part = body->instance = DECK_NONE;
    for (size_t s = 0; s < deck->scope_count; s++) {
        if (!is_body(deck, s, instances, &part))
            continue;
        join_name(list, sizeof list, deck->scopes[s].name);
        if (wanted && !deck_same(wanted, deck->scopes[s].name))
            continue;
        count++;
        body->part = part;
        body->instance = s;
    }
    if (count == 1)
        return PERCUSS_OK;
    if (list[0] == '\0')
        return fault_set(body->fault, PERCUSS_BAD_REQUEST,
                         "%s: no solid elements: must have C3D10, C3D15 or C3D20 (does the file "
                         "hold the surface only?)",
                         deck->files[0]);
    if (wanted)
        return fault_set(body->fault, PERCUSS_BAD_REQUEST,
                         "--instance: %s: must be one of those with solids: %s", wanted, list);
    return fault_set(body->fault, PERCUSS_BAD_REQUEST,
                     "%s: %zu bodies (%s): must be one: choose by --instance NAME, or export one "
                     "part",
                     deck->files[0], count, list);
}

static bool is_inside(const struct body *body, size_t scope)
{
    return scope == body->part || scope == body->instance;
}

/* ---- elements ---- */

static int compare_places(const void *left, const void *right)
{
    const struct place *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

static const struct deck_element *find_element(const struct body *body, size_t label)
{
    struct place key = {.label = label};
    const struct place *found =
        bsearch(&key, body->places, body->count, sizeof key, compare_places);
    return found ? &body->deck->elements[found->index] : NULL;
}

static enum percuss_status index_elements(struct body *body)
{
    const struct deck *deck = body->deck;
    body->places = malloc((deck->element_count + 1) * sizeof *body->places);
    body->built = malloc((deck->element_count + 1) * sizeof *body->built);
    body->sectioned = malloc((deck->element_count + 1) * sizeof *body->sectioned);
    if (!body->places || !body->built || !body->sectioned)
        return body_out_of_memory(body);
    for (size_t e = 0; e < deck->element_count; e++)
        if (is_inside(body, deck->elements[e].scope))
            body->places[body->count++] = (struct place){deck->elements[e].label, e};
    qsort(body->places, body->count, sizeof *body->places, compare_places);
    for (size_t i = 1; i < body->count; i++)
        if (body->places[i].label == body->places[i - 1].label)
            return deck_refuse(deck, deck->elements[body->places[i].index].place, body->fault,
                               "element %zu: is there twice: each must have a number of its own",
                               body->places[i].label);
    return PERCUSS_OK;
}

static enum percuss_status build_element(struct body *body, size_t index)
{
    const struct deck *deck = body->deck;
    const struct deck_element *element = &deck->elements[index];
    size_t made[ELEMENT_MOST_NODES], node;
    enum element_type type;
    body->built[index] = body->sectioned[index] = DECK_NONE;
    if (!is_inside(body, element->scope) || element->kind == DECK_OTHER)
        return PERCUSS_OK;
    const char *wrong =
        deck_element_make(element->kind, deck->connectivity + element->first, &type, made, &node);
    if (wrong)
        return deck_refuse(deck, element->place, body->fault, "element %zu: node %zu: %s",
                           element->label, node, wrong);
    size_t part = builder_part(&body->builder, deck->names[element->group]);
    body->built[index] = body->builder.element_count;
    return part != SIZE_MAX && builder_add_element(&body->builder, type, element->label, part, made)
               ? PERCUSS_OK
               : body_out_of_memory(body);
}

/* ---- nodes ---- */

/* An instance is shifted, then turned about its axis (Rodrigues' formula). */
static void place_point(const struct deck_scope *scope, const double point[3], double placed[3])
{
    double axis[3], arm[3], across[3], angle = scope->degrees * M_PI / 180.0;
    memcpy(placed, point, 3 * sizeof *placed);
    add_scaled3(1.0, scope->shift, placed);
    if (angle == 0.0)
        return;
    sub3(scope->axis[1], scope->axis[0], axis);
    scale3(1.0 / norm3(axis), axis, axis);
    sub3(placed, scope->axis[0], arm);
    cross3(axis, arm, across);
    double along = dot3(axis, arm);
    memcpy(placed, scope->axis[0], 3 * sizeof *placed);
    add_scaled3(cos(angle), arm, placed);
    add_scaled3(sin(angle), across, placed);
    add_scaled3((1.0 - cos(angle)) * along, axis, placed);
}

static int compare_labels(const void *left, const void *right)
{
    size_t a = *(const size_t *)left, b = *(const size_t *)right;
    return a < b ? -1 : a > b;
}

static enum percuss_status build_nodes(struct body *body)
{
    const struct deck *deck = body->deck;
    const struct deck_scope *scope = &deck->scopes[body->instance];
    for (size_t i = 0; i < deck->node_count; i++) {
        double point[3];
        if (!is_inside(body, deck->nodes[i].scope))
            continue;
        place_point(scope, deck->nodes[i].point, point);
        if (!builder_add_node(&body->builder, deck->nodes[i].label, point) ||
            !builder_append(&body->nodes, deck->nodes[i].label))
            return body_out_of_memory(body);
    }
    if (body->nodes.count)
        qsort(body->nodes.values, body->nodes.count, sizeof *body->nodes.values, compare_labels);
    return PERCUSS_OK;
}

/* ---- sets ---- */

static enum percuss_status resolve_set(struct body *body, const struct deck_set *set, int depth,
                                       struct builder_list *labels);

/* The set that an item names, in the scopes where it may stand. DECK_NONE with *other: it is of
 * another instance. */
static size_t find_named(const struct body *body, enum deck_set_kind kind, size_t scope,
                         const struct deck_item *item, bool *other)
{
    const struct deck *deck = body->deck;
    const char *name = deck->names[item->name];
    const struct deck_scope *own = &deck->scopes[body->instance];
    *other = item->instance != DECK_NONE && !deck_same(deck->names[item->instance], own->name);
    if (*other)
        return DECK_NONE;
    if (item->instance == DECK_NONE && !is_inside(body, scope))
        return deck_find_set(deck, kind, scope, name);
    size_t found = deck_find_set(deck, kind, body->instance, name);
    return found != DECK_NONE ? found : deck_find_set(deck, kind, body->part, name);
}

/* The labels of a set that an item names; `of`: what names it. */
static enum percuss_status resolve_named(struct body *body, enum deck_set_kind kind,
                                         const struct deck_set *of, const struct deck_item *item,
                                         int depth, struct builder_list *labels)
{
    static const char *const KINDS[] = {"nodes", "elements", "surfaces"};
    bool other;
    size_t found = find_named(body, kind, of->scope, item, &other);
    if (other)
        return PERCUSS_OK;
    if (found == DECK_NONE)
        return deck_refuse(body->deck, item->place, body->fault,
                           "set %s: %.60s: must be the name of a set of %s", of->name,
                           body->deck->names[item->name], KINDS[kind]);
    if (depth == DEEPEST_SET)
        return deck_refuse(body->deck, item->place, body->fault,
                           "set %s: %.60s: must not name itself, nor be more than %d deep",
                           of->name, body->deck->names[item->name], DEEPEST_SET);
    return resolve_set(body, &body->deck->sets[found], depth + 1, labels);
}

/* Nodes of an element, or of a face of it; counts it where it is not there. */
static bool add_nodes(struct body *body, size_t label, int face, struct builder_list *labels)
{
    const struct deck_element *element = find_element(body, label);
    const size_t *nodes = element ? body->deck->connectivity + element->first : NULL;
    const unsigned char *local = NULL;
    bool whole = face == 0 || (face == DECK_WHOLE && element && element->kind == DECK_OTHER);
    size_t count = !element ? 0
                   : whole  ? element->count
                            : deck_element_face(element->kind, face, &local);
    body->missing += count == 0;
    for (size_t i = 0; i < count; i++)
        if (!builder_append(labels, nodes[whole ? i : local[i]]))
            return false;
    return true;
}

/* nodes of the elements of a named set */
static enum percuss_status resolve_elements(struct body *body, const struct deck_set *set,
                                            const struct deck_item *item, int depth,
                                            struct builder_list *labels)
{
    struct builder_list elements = {0};
    int face = item->kind == DECK_SET_FACES ? item->face : 0;
    enum percuss_status status = resolve_named(body, DECK_ELEMENTS, set, item, depth, &elements);
    for (size_t i = 0; !status && i < elements.count; i++)
        if (!add_nodes(body, elements.values[i], face, labels))
            status = body_out_of_memory(body);
    free(elements.values);
    return status;
}

static enum percuss_status resolve_item(struct body *body, const struct deck_set *set,
                                        const struct deck_item *item, int depth,
                                        struct builder_list *labels)
{
    enum deck_set_kind kind = set->kind == DECK_ELEMENTS ? DECK_ELEMENTS : DECK_NODES;
    if (item->kind == DECK_SET)
        return resolve_named(body, kind, set, item, depth, labels);
    if (item->kind == DECK_ELEMENT_NODES || item->kind == DECK_SET_FACES)
        return resolve_elements(body, set, item, depth, labels);
    /* labels of another scope are not this body's */
    bool here = item->instance == DECK_NONE ? is_inside(body, set->scope)
                                            : deck_same(body->deck->names[item->instance],
                                                        body->deck->scopes[body->instance].name);
    size_t last = here ? (item->last - item->first) / item->step : 0;
    for (size_t i = 0, k = item->first; here && i <= last; i++, k += item->step)
        if (!(item->kind == DECK_FACES ? add_nodes(body, k, item->face, labels)
                                       : builder_append(labels, k)))
            return body_out_of_memory(body);
    return PERCUSS_OK;
}

/* Appends the labels of nodes, or of elements where it is a set of elements. */
static enum percuss_status resolve_set(struct body *body, const struct deck_set *set, int depth,
                                       struct builder_list *labels)
{
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && i < set->item_count; i++)
        status = resolve_item(body, set, &set->items[i], depth, labels);
    return status;
}

/* Sets of elements name the nodes of their shells and lines. */
static enum percuss_status shell_nodes(struct body *body, const struct builder_list *elements,
                                       struct builder_list *nodes)
{
    for (size_t i = 0; i < elements->count; i++) {
        const struct deck_element *element = find_element(body, elements->values[i]);
        body->missing += !element;
        if (element && element->kind == DECK_OTHER &&
            !add_nodes(body, elements->values[i], 0, nodes))
            return body_out_of_memory(body);
    }
    return PERCUSS_OK;
}

/* Tells how much of what a set names is not there; solvers pass over that too. */
static enum percuss_status tell_missing(struct body *body, const struct deck_set *set,
                                        const struct builder_list *labels)
{
    static const char *const KINDS[] = {"nodes", "elements", "surface"};
    static const char *const MISSING[] = {"nodes or elements", "elements", "faces or nodes"};
    size_t missing = body->missing;
    for (size_t i = 0; set->kind != DECK_ELEMENTS && i < labels->count; i++)
        missing += body->nodes.count == 0 ||
                   !bsearch(&labels->values[i], body->nodes.values, body->nodes.count,
                            sizeof *body->nodes.values, compare_labels);
    return missing == 0 ||
                   deck_tell(body->deck, "set %s (%s): %zu of the %s that it names are not there",
                             set->name, KINDS[set->kind], missing, MISSING[set->kind])
               ? PERCUSS_OK
               : body_out_of_memory(body);
}

static enum percuss_status build_set(struct body *body, const struct deck_set *set)
{
    static const char *const KINDS[] = {"nodes", "elements", "surface"};
    const struct deck_scope *scope = &body->deck->scopes[set->scope];
    struct builder_list labels = {0}, elements = {0};
    bool shells = set->kind == DECK_ELEMENTS;
    body->missing = 0;
    enum percuss_status status = resolve_set(body, set, 0, shells ? &elements : &labels);
    if (!status && shells)
        status = shell_nodes(body, &elements, &labels);
    free(elements.values);
    if (!status)
        status = tell_missing(body, set, &labels);
    size_t index = !status && labels.count ? builder_add_set(&body->builder, set->name) : SIZE_MAX;
    if (status || (labels.count && index == SIZE_MAX) || !labels.count) {
        bool lost = !status && labels.count;
        free(labels.values);
        return lost ? body_out_of_memory(body) : status;
    }
    struct builder_set *made = &body->builder.sets[index];
    made->labels = labels;
    made->kind = KINDS[set->kind];
    snprintf(made->scope, sizeof made->scope, "%s", scope->name);
    if (set->scope == body->part && body->instance != body->part)
        snprintf(made->instance, sizeof made->instance, "%s",
                 body->deck->scopes[body->instance].name);
    return PERCUSS_OK;
}

static bool is_seen(const struct body *body, size_t scope)
{
    enum deck_scope_kind kind = body->deck->scopes[scope].kind;
    return is_inside(body, scope) || kind == DECK_ASSEMBLY || kind == DECK_MODEL;
}

/* ---- sections ---- */

/* Puts the solids of a section into a part of its name; *taken: how many. *others: elements that
 * are no solids. */
static enum percuss_status take_elements(struct body *body, const struct deck_section *section,
                                         const struct builder_list *labels, size_t part,
                                         size_t *taken, size_t *others)
{
    struct deck *deck = body->deck;
    *taken = *others = 0;
    for (size_t i = 0; i < labels->count; i++) {
        const struct deck_element *element = find_element(body, labels->values[i]);
        size_t at = element ? (size_t)(element - deck->elements) : 0;
        /* the set tells of those that are not there */
        if (!element)
            continue;
        if (body->built[at] == DECK_NONE) {
            ++*others;
            continue;
        }
        struct builder_element *built = &body->builder.elements[body->built[at]];
        const struct deck_section *other =
            body->sectioned[at] != DECK_NONE ? &deck->sections[body->sectioned[at]] : NULL;
        if (other && (built->part != part ||
                      !deck_same(deck->names[other->material], deck->names[section->material])))
            return deck_refuse(deck, section->place, body->fault,
                               "element %zu: is in the solid sections of %s and %s: must be in "
                               "one; the other, of %s, is in line %zu of %s",
                               element->label, body->builder.parts[built->part].name,
                               deck->names[section->set], deck->names[other->material],
                               other->place.line, deck->files[other->place.file]);
        body->sectioned[at] = (size_t)(section - deck->sections);
        built->part = part;
        ++*taken;
    }
    return PERCUSS_OK;
}

/* Two statements of one material are the same. */
static bool same_material(const struct deck_material *a, const struct deck_material *b)
{
    bool same = a->elastic == b->elastic && a->dense == b->dense &&
                a->stress_count == b->stress_count && !a->refused[0] == !b->refused[0];
    if (a->elastic)
        same = same && a->young == b->young && a->poisson == b->poisson;
    if (a->dense)
        same = same && a->density == b->density;
    for (size_t i = 0; same && i < a->stress_count; i++)
        same = a->stress[i] == b->stress[i] && a->strain[i] == b->strain[i];
    return same;
}

/* solvers take the first one or the last one, and rarely is either meant */
static enum percuss_status refuse_others(const struct body *body, size_t found)
{
    const struct deck *deck = body->deck;
    const struct deck_material *material = &deck->materials[found];
    for (size_t i = found + 1; i < deck->material_count; i++)
        if (deck_same(deck->materials[i].name, material->name) &&
            !same_material(&deck->materials[i], material))
            return deck_refuse(deck, deck->materials[i].place, body->fault,
                               "*MATERIAL, NAME=%s: is in line %zu of %s with other values: must "
                               "be there once (names are the same in any case)",
                               deck->materials[i].name, material->place.line,
                               deck->files[material->place.file]);
    return PERCUSS_OK;
}

static enum percuss_status give_material(struct body *body, const struct deck_section *section,
                                         double unit, struct mesh_part *part)
{
    struct deck *deck = body->deck;
    const char *name = deck->names[section->material];
    size_t found = deck_find_material(deck, name);
    if (found == DECK_NONE) {
        snprintf(part->lacks, sizeof part->lacks, "there is no *MATERIAL, NAME=%s", name);
        return PERCUSS_OK;
    }
    const struct deck_material *material = &deck->materials[found];
    for (size_t i = 0; i < material->told_count; i++)
        if (!deck_tell(deck, "%s", material->told[i]))
            return body_out_of_memory(body);
    enum percuss_status status = refuse_others(body, found);
    return status ? status : deck_material_give(deck, material, unit, part, body->fault);
}

static enum percuss_status apply_section(struct body *body, const struct deck_section *section,
                                         double unit)
{
    struct deck *deck = body->deck;
    const char *name = deck->names[section->set];
    struct deck_item item = {.name = section->set, .instance = DECK_NONE, .place = section->place};
    struct builder_list labels = {0};
    bool other;
    size_t found = find_named(body, DECK_ELEMENTS, section->scope, &item, &other);
    size_t taken = 0, others = 0;
    if (found == DECK_NONE)
        return deck_refuse(deck, section->place, body->fault,
                           "*SOLID SECTION: ELSET=%s: must be the name of a set of elements", name);
    size_t part = builder_part(&body->builder, deck->sets[found].name);
    enum percuss_status status = part == SIZE_MAX
                                     ? body_out_of_memory(body)
                                     : resolve_set(body, &deck->sets[found], 0, &labels);
    if (!status)
        status = take_elements(body, section, &labels, part, &taken, &others);
    if (!status && others > 0 &&
        !deck_tell(deck, "*SOLID SECTION, ELSET=%s: elements that are no solids are left out",
                   name))
        status = body_out_of_memory(body);
    free(labels.values);
    /* a part without elements is none of this body */
    return status || !taken ? status
                            : give_material(body, section, unit, &body->builder.parts[part]);
}

/* A section in the assembly or before it is no part's: a body's own is in its part. */
static enum percuss_status tell_section(struct body *body, const struct deck_section *section)
{
    struct deck *deck = body->deck;
    return !is_seen(body, section->scope) ||
                   deck_tell(deck,
                             "*SOLID SECTION, ELSET=%s (line %zu): left out: must be in the *PART",
                             deck->names[section->set], section->place.line)
               ? PERCUSS_OK
               : body_out_of_memory(body);
}

/* ---- masses ---- */

/* Whether a set of the deck names an element itself, in sets of the same scope too. */
static bool names_element(const struct deck *deck, size_t scope, const char *name, size_t label,
                          int depth)
{
    size_t found = deck_find_set(deck, DECK_ELEMENTS, scope, name);
    const struct deck_set *set = found == DECK_NONE ? NULL : &deck->sets[found];
    for (size_t i = 0; set && depth < DEEPEST_SET && i < set->item_count; i++) {
        const struct deck_item *item = &set->items[i];
        if (item->instance != DECK_NONE)
            continue;
        if (item->kind == DECK_RANGE && label >= item->first && label <= item->last &&
            (label - item->first) % item->step == 0)
            return true;
        if (item->kind == DECK_SET &&
            names_element(deck, scope, deck->names[item->name], label, depth + 1))
            return true;
    }
    return false;
}

/* The node of a point, if it is the body's. */
static enum percuss_status add_point(struct body *body, const struct deck_mass *mass,
                                     const struct deck_point *point)
{
    struct deck *deck = body->deck;
    bool own = is_inside(body, point->scope) && point->instance == DECK_NONE;
    bool fine = true;
    if (own || (point->instance != DECK_NONE &&
                deck_same(deck->names[point->instance], deck->scopes[body->instance].name)))
        fine = mass->mass == 0.0 || builder_add_mass(&body->builder, point->node, mass->mass);
    else if (point->instance == DECK_NONE)
        fine = deck_tell(deck,
                         "*MASS, ELSET=%s (line %zu): node %zu of the assembly is no part of the "
                         "body: left out: the body here is lighter by it",
                         deck->names[mass->set], mass->place.line, point->node);
    return fine ? PERCUSS_OK : body_out_of_memory(body);
}

static enum percuss_status build_mass(struct body *body, const struct deck_mass *mass)
{
    struct deck *deck = body->deck;
    const char *name = deck->names[mass->set];
    bool any = false;
    for (size_t i = 0; i < deck->point_count; i++) {
        struct deck_point *point = &deck->points[i];
        if (point->scope != mass->scope || !names_element(deck, mass->scope, name, point->label, 0))
            continue;
        enum percuss_status status = add_point(body, mass, point);
        if (status)
            return status;
        any = point->massive = true;
    }
    return any || deck_tell(deck,
                            "*MASS, ELSET=%s (line %zu): has no element TYPE=MASS: left out: the "
                            "body here is lighter by it",
                            name, mass->place.line)
               ? PERCUSS_OK
               : body_out_of_memory(body);
}

static enum percuss_status build_masses(struct body *body)
{
    struct deck *deck = body->deck;
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && i < deck->mass_count; i++)
        if (is_seen(body, deck->masses[i].scope))
            status = build_mass(body, &deck->masses[i]);
    for (size_t i = 0; !status && i < deck->point_count; i++)
        if (is_seen(body, deck->points[i].scope) && !deck->points[i].massive &&
            !deck_tell(deck, "element %zu: TYPE=MASS without a *MASS: is taken without one",
                       deck->points[i].label))
            status = body_out_of_memory(body);
    return status;
}

/* ---- all of it ---- */

static enum percuss_status build(struct body *body, double unit)
{
    struct deck *deck = body->deck;
    enum percuss_status status = index_elements(body);
    for (size_t e = 0; !status && e < deck->element_count; e++)
        status = build_element(body, e);
    if (!status)
        status = build_nodes(body);
    for (size_t i = 0; !status && i < deck->section_count; i++)
        status = is_inside(body, deck->sections[i].scope)
                     ? apply_section(body, &deck->sections[i], unit)
                     : tell_section(body, &deck->sections[i]);
    for (size_t i = 0; !status && i < deck->set_count; i++)
        if (is_seen(body, deck->sets[i].scope))
            status = build_set(body, &deck->sets[i]);
    if (!status)
        status = build_masses(body);
    return status;
}

enum percuss_status deck_body_make(struct deck *deck, double unit, const char *instance,
                                   struct solid_mesh *mesh, struct fault *fault)
{
    struct body body = {.deck = deck, .fault = fault};
    memset(mesh, 0, sizeof *mesh);
    enum percuss_status status = choose_body(&body, instance);
    if (!status)
        status = build(&body, unit);
    for (size_t i = 0; !status && i < deck->remark_count; i++)
        if (!builder_remark(&body.builder, "%s", deck->remarks[i]))
            status = fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", deck->files[0]);
    if (!status)
        status = builder_finish(&body.builder, deck->files[0], unit, mesh, fault);
    builder_free(&body.builder);
    free(body.places);
    free(body.nodes.values);
    free(body.built);
    free(body.sectioned);
    return status;
}
