/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/deck.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh/element.h"
#include "mesh/grow.h"

/* nothing solid is softer, stiffer, lighter or heavier: what is outside is in other units */
static const double LEAST_YOUNG = 1e4, MOST_YOUNG = 5e12, LEAST_DENSITY = 5.0, MOST_DENSITY = 3e4;

/* nodes of the faces S1 to S4, S1 to S6 in the order of Gmsh */
static const unsigned char TET_FACES[4][6] = {
    {0, 1, 2, 4, 5, 6}, {0, 3, 1, 7, 9, 4}, {1, 3, 2, 9, 8, 5}, {2, 3, 0, 8, 7, 6}};
static const unsigned char HEX_FACES[6][8] = {
    {0, 1, 2, 3, 8, 11, 13, 9},   {4, 7, 6, 5, 17, 19, 18, 16}, {0, 4, 5, 1, 10, 16, 12, 8},
    {1, 5, 6, 2, 12, 18, 14, 11}, {2, 6, 7, 3, 14, 19, 15, 13}, {3, 7, 4, 0, 15, 17, 10, 9}};

/* an element found by its label: a solid, or another one */
struct place {
    size_t label, index;
    bool solid;
};

struct places {
    size_t count;
    struct place *places; /* ascending */
};

size_t deck_find_element_set(const struct deck *deck, const char *name)
{
    for (size_t i = 0; i < deck->set_count; i++)
        if (strcasecmp(deck->sets[i].name, name) == 0)
            return i;
    return SIZE_MAX;
}

size_t deck_find_node_set(const struct deck *deck, const char *name)
{
    for (size_t i = 0; i < deck->builder.set_count; i++)
        if (strcasecmp(deck->builder.sets[i].name, name) == 0)
            return i;
    return SIZE_MAX;
}

size_t deck_element_set(struct deck *deck, const char *name)
{
    size_t found = deck_find_element_set(deck, name);
    if (found != SIZE_MAX || !GROW(deck->sets, deck->set_count, deck->set_room))
        return found;
    struct deck_set *set = &deck->sets[deck->set_count];
    memset(set, 0, sizeof *set);
    snprintf(set->name, sizeof set->name, "%s", name);
    return deck->set_count++;
}

size_t deck_node_set(struct deck *deck, const char *name)
{
    size_t found = deck_find_node_set(deck, name);
    return found != SIZE_MAX ? found : builder_set(&deck->builder, name);
}

size_t deck_material(struct deck *deck, const char *name)
{
    for (size_t i = 0; i < deck->material_count; i++)
        if (strcasecmp(deck->materials[i].name, name) == 0)
            return i;
    if (!GROW(deck->materials, deck->material_count, deck->material_room))
        return SIZE_MAX;
    struct deck_material *material = &deck->materials[deck->material_count];
    memset(material, 0, sizeof *material);
    snprintf(material->name, sizeof material->name, "%s", name);
    return deck->material_count++;
}

bool deck_add_section(struct deck *deck, size_t set, size_t material)
{
    if (!GROW(deck->sections, deck->section_count, deck->section_room))
        return false;
    deck->sections[deck->section_count++] = (struct deck_section){set, material};
    return true;
}

bool deck_add_other(struct deck *deck, size_t label, const size_t *nodes, size_t count)
{
    size_t first = deck->others_nodes.count;
    if (!GROW(deck->others, deck->other_count, deck->other_room))
        return false;
    for (size_t i = 0; i < count; i++)
        if (!builder_append(&deck->others_nodes, nodes[i]))
            return false;
    deck->others[deck->other_count++] = (struct deck_other){label, first, count};
    return true;
}

bool deck_add_faces(struct deck *deck, const struct deck_faces *faces)
{
    if (!GROW(deck->faces, deck->face_count, deck->face_room))
        return false;
    deck->faces[deck->face_count++] = *faces;
    return true;
}

static int compare(const void *left, const void *right)
{
    const struct place *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

static const struct place *find(const struct places *places, size_t label)
{
    struct place key = {.label = label};
    return bsearch(&key, places->places, places->count, sizeof key, compare);
}

static bool make_places(const struct deck *deck, struct places *places)
{
    size_t solids = deck->builder.element_count;
    places->count = solids + deck->other_count;
    places->places = malloc((places->count + 1) * sizeof *places->places);
    if (!places->places)
        return false;
    for (size_t i = 0; i < solids; i++)
        places->places[i] = (struct place){deck->builder.elements[i].label, i, true};
    for (size_t i = 0; i < deck->other_count; i++)
        places->places[solids + i] = (struct place){deck->others[i].label, i, false};
    qsort(places->places, places->count, sizeof *places->places, compare);
    return true;
}

static enum percuss_status check_places(const struct places *places, const char *file,
                                        struct fault *fault)
{
    for (size_t i = 1; i < places->count; i++)
        if (places->places[i].label == places->places[i - 1].label)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "%s: element %zu: is there twice: each must have a number of its own",
                             file, places->places[i].label);
    return PERCUSS_OK;
}

static enum percuss_status refuse_material(const struct deck_material *material, const char *file,
                                           const char *card, double stated, double value,
                                           struct fault *fault)
{
    bool young = card[1] == 'E';
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "%s: material %s: %s: %g is %g %s in units of N, s and the file's length: must "
        "be %g to %g; is the unit of length right?",
        file, material->name, card, stated, value, young ? "Pa" : "kg/m^3",
        young ? LEAST_YOUNG : LEAST_DENSITY, young ? MOST_YOUNG : MOST_DENSITY);
}

/* stresses in N per square of the length; the unit of mass moves by 1 unit of length a second
 * faster each second under 1 N: 1 N s^2/unit. Slope of stress over total strain from the first two
 * rows of *PLASTIC, H = d stress/d plastic strain: E H/(E + H) */
static enum percuss_status convert(const struct deck_material *from, const char *file, double unit,
                                   struct material *to, struct fault *fault)
{
    /* in SI */
    double stress = 1.0 / (unit * unit), density = stress * stress;
    memset(to, 0, sizeof *to);
    snprintf(to->name, sizeof to->name, "%.*s", (int)sizeof to->name - 1, from->name);
    to->young = from->young * stress;
    to->poisson = from->poisson;
    to->density = from->density * density;
    to->yield = from->stress_count ? from->stress[0] * stress : INFINITY;
    /* hardening from the slope of plastic strain */
    if (from->stress_count > 1 && from->strain[1] > from->strain[0]) {
        double hardening =
            (from->stress[1] - from->stress[0]) / (from->strain[1] - from->strain[0]) * stress;
        to->tangent = hardening > 0.0 ? to->young * hardening / (to->young + hardening) : 0.0;
    }
    /* limits that tell a wrong unit, in the words of the deck */
    if (!(to->young >= LEAST_YOUNG && to->young <= MOST_YOUNG))
        return refuse_material(from, file, "*ELASTIC", from->young, to->young, fault);
    if (!(to->density >= LEAST_DENSITY && to->density <= MOST_DENSITY))
        return refuse_material(from, file, "*DENSITY", from->density, to->density, fault);
    /* limits of every material */
    struct fault inner;
    if (material_check(to, &inner) != PERCUSS_OK)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: material %s: %.400s", file, from->name,
                         inner.text);
    return PERCUSS_OK;
}

/* a section's elements become a part of its name; `taken` holds which ones have a section */
static enum percuss_status apply_section(struct deck *deck, const struct deck_section *section,
                                         const struct places *places, bool *taken, const char *file,
                                         double unit, struct fault *fault)
{
    const struct deck_set *set = &deck->sets[section->set];
    const struct deck_material *material = &deck->materials[section->material];
    size_t index = builder_part(&deck->builder, set->name);
    if (index == SIZE_MAX)
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", file);
    struct mesh_part *part = &deck->builder.parts[index];
    /* a material that says enough; else the command line must */
    if (material->elastic && material->dense) {
        part->has_material = true;
        enum percuss_status status = convert(material, file, unit, &part->material, fault);
        if (status != PERCUSS_OK)
            return status;
    }
    /* its solid elements, in one part each */
    for (size_t i = 0; i < set->labels.count; i++) {
        const struct place *place = find(places, set->labels.values[i]);
        if (!place || !place->solid)
            continue;
        if (taken[place->index] && deck->builder.elements[place->index].part != index)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "%s: element %zu: is in the solid sections of %s and %s: must be in "
                             "one",
                             file, place->label,
                             deck->builder.parts[deck->builder.elements[place->index].part].name,
                             set->name);
        taken[place->index] = true;
        deck->builder.elements[place->index].part = index;
    }
    return PERCUSS_OK;
}

static enum percuss_status apply_sections(struct deck *deck, const struct places *places,
                                          const char *file, double unit, struct fault *fault)
{
    bool *taken = calloc(deck->builder.element_count + 1, sizeof *taken);
    if (!taken)
        return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", file);
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < deck->section_count && status == PERCUSS_OK; i++)
        status = apply_section(deck, &deck->sections[i], places, taken, file, unit, fault);
    free(taken);
    return status;
}

/* sets of shells and lines name their nodes */
static bool name_others(struct deck *deck, const struct places *places)
{
    for (size_t s = 0; s < deck->set_count; s++) {
        const struct deck_set *set = &deck->sets[s];
        size_t named = SIZE_MAX;
        for (size_t i = 0; i < set->labels.count; i++) {
            const struct place *place = find(places, set->labels.values[i]);
            if (!place || place->solid)
                continue;
            if (named == SIZE_MAX && (named = deck_node_set(deck, set->name)) == SIZE_MAX)
                return false;
            const struct deck_other *other = &deck->others[place->index];
            for (size_t k = 0; k < other->count; k++)
                if (!builder_append(&deck->builder.sets[named].labels,
                                    deck->others_nodes.values[other->first + k]))
                    return false;
        }
    }
    return true;
}

static bool add_face(struct deck *deck, const struct deck_faces *faces, const struct place *place)
{
    const struct builder_element *element = &deck->builder.elements[place->index];
    bool tet = element->type == ELEMENT_TET10;
    if (tet && faces->face > 4)
        return true;
    const unsigned char *local = tet ? TET_FACES[faces->face - 1] : HEX_FACES[faces->face - 1];
    for (int k = 0; k < (tet ? 6 : 8); k++)
        if (!builder_append(&deck->builder.sets[faces->surface].labels,
                            deck->builder.connectivity.values[element->first + local[k]]))
            return false;
    return true;
}

/* surfaces name the nodes of their faces */
static bool name_faces(struct deck *deck, const struct places *places)
{
    for (size_t f = 0; f < deck->face_count; f++) {
        const struct deck_faces *faces = &deck->faces[f];
        bool whole = faces->set != SIZE_MAX;
        size_t count = whole ? deck->sets[faces->set].labels.count : 1;
        for (size_t i = 0; i < count; i++) {
            size_t label = whole ? deck->sets[faces->set].labels.values[i] : faces->label;
            const struct place *place = find(places, label);
            if (place && place->solid && !add_face(deck, faces, place))
                return false;
        }
    }
    return true;
}

enum percuss_status deck_finish(struct deck *deck, const char *file, double unit,
                                struct solid_mesh *mesh, struct fault *fault)
{
    struct places places = {0};
    memset(mesh, 0, sizeof *mesh);
    enum percuss_status status =
        make_places(deck, &places) ? check_places(&places, file, fault)
                                   : fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", file);
    if (status == PERCUSS_OK && !(name_others(deck, &places) && name_faces(deck, &places)))
        status = fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", file);
    if (status == PERCUSS_OK)
        status = apply_sections(deck, &places, file, unit, fault);
    if (status == PERCUSS_OK)
        status = builder_finish(&deck->builder, file, unit, mesh, fault);
    free(places.places);
    return status;
}

void deck_free(struct deck *deck)
{
    builder_free(&deck->builder);
    for (size_t i = 0; i < deck->set_count; i++)
        free(deck->sets[i].labels.values);
    free(deck->sets);
    free(deck->materials);
    free(deck->sections);
    free(deck->others);
    free(deck->others_nodes.values);
    free(deck->faces);
    memset(deck, 0, sizeof *deck);
}
