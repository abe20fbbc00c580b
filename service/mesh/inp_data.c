/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <stdint.h>
#include <string.h>

#include "mesh/element.h"
#include "mesh/inp_parts.h"

/* *NSET, GENERATE makes no more: the file would be larger than this by far */
static const size_t MOST_GENERATED = 20000000;

/* the deck's order of the nodes of an element, by Gmsh's: Abaqus Elements Reference, 28.1.4 */
static const unsigned char TET_ORDER[10] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
static const unsigned char HEX_ORDER[20] = {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                            16, 9, 17, 10, 18, 19, 12, 15, 13, 14};

enum percuss_status inp_out_of_memory(const struct inp *inp)
{
    return fault_set(inp->scan->fault, PERCUSS_INTERNAL, "%s: out of memory", inp->scan->file);
}

enum percuss_status inp_read_node(struct inp *inp, char *line)
{
    size_t label;
    double point[3] = {0.0, 0.0, 0.0};
    if (!card_label(inp->scan, "*NODE", card_field(&line), &label))
        return PERCUSS_BAD_REQUEST;
    for (int k = 0; k < 3; k++) {
        char *field = card_field(&line);
        if (field && *field && !card_real(inp->scan, "*NODE", field, &point[k]))
            return PERCUSS_BAD_REQUEST;
    }
    if (!builder_add_node(&inp->deck.builder, label, point) ||
        (inp->set != SIZE_MAX && !builder_append(&inp->deck.builder.sets[inp->set].labels, label)))
        return inp_out_of_memory(inp);
    return PERCUSS_OK;
}

static enum percuss_status finish_solid(struct inp *inp)
{
    size_t nodes[ELEMENT_MOST_NODES];
    const unsigned char *order = inp->type == ELEMENT_TET10 ? TET_ORDER : HEX_ORDER;
    for (size_t i = 0; i < element_node_count(inp->type); i++)
        nodes[i] = inp->nodes[order[i]];
    inp->filled = 0;
    return builder_add_element(&inp->deck.builder, inp->type, inp->label, inp->part, nodes) &&
                   builder_append(&inp->deck.sets[inp->set].labels, inp->label)
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

/* a solid's nodes may go over several lines; another element is what stands on its line */
enum percuss_status inp_read_element(struct inp *inp, char *line)
{
    size_t most = inp->solid ? element_node_count(inp->type) : ELEMENT_MOST_NODES;
    char *field;
    if (inp->filled == 0 && !card_label(inp->scan, "*ELEMENT", card_field(&line), &inp->label))
        return PERCUSS_BAD_REQUEST;
    while ((field = card_field(&line))) {
        if (inp->filled == most)
            return scan_refuse(inp->scan, "*ELEMENT: %zu: must have %zu nodes", inp->label, most);
        if (!card_label(inp->scan, "*ELEMENT", field, &inp->nodes[inp->filled]))
            return PERCUSS_BAD_REQUEST;
        inp->filled++;
    }
    if (inp->solid)
        return inp->filled == most ? finish_solid(inp) : PERCUSS_OK;
    size_t count = inp->filled;
    inp->filled = 0;
    return deck_add_other(&inp->deck, inp->label, inp->nodes, count) &&
                   builder_append(&inp->deck.sets[inp->set].labels, inp->label)
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

/* first, last and step of the labels to generate */
static enum percuss_status generate(struct inp *inp, char *line, struct builder_list *list)
{
    size_t first, last, step = 1;
    char *field;
    if (!card_label(inp->scan, "GENERATE", card_field(&line), &first) ||
        !card_label(inp->scan, "GENERATE", card_field(&line), &last))
        return PERCUSS_BAD_REQUEST;
    if ((field = card_field(&line)) && *field && !card_label(inp->scan, "GENERATE", field, &step))
        return PERCUSS_BAD_REQUEST;
    if (last < first || (last - first) / step > MOST_GENERATED)
        return scan_refuse(inp->scan, "GENERATE: %zu to %zu: must be at most %zu numbers", first,
                           last, MOST_GENERATED);
    for (size_t label = first; label <= last; label += step)
        if (!builder_append(list, label))
            return inp_out_of_memory(inp);
    return PERCUSS_OK;
}

/* labels, and names of sets whose labels are taken over */
static enum percuss_status read_set(struct inp *inp, char *line, bool of_nodes)
{
    struct deck *deck = &inp->deck;
    char *field;
    while ((field = card_field(&line))) {
        /* a label */
        struct builder_list *list =
            of_nodes ? &deck->builder.sets[inp->set].labels : &deck->sets[inp->set].labels;
        if (*field >= '0' && *field <= '9') {
            size_t label;
            if (!card_label(inp->scan, "set", field, &label))
                return PERCUSS_BAD_REQUEST;
            if (!builder_append(list, label))
                return inp_out_of_memory(inp);
            continue;
        }
        /* or the name of a set above; in an assembly, one that is not known is left out */
        size_t other =
            of_nodes ? deck_find_node_set(deck, field) : deck_find_element_set(deck, field);
        if (other == SIZE_MAX && !inp->assembly)
            return scan_refuse(inp->scan, "set: %.60s: must be the name of a set above", field);
        if (other == SIZE_MAX || other == inp->set)
            continue;
        /* whose labels follow */
        const struct builder_list *from =
            of_nodes ? &deck->builder.sets[other].labels : &deck->sets[other].labels;
        for (size_t i = 0; i < from->count; i++)
            if (!builder_append(list, from->values[i]))
                return inp_out_of_memory(inp);
    }
    return PERCUSS_OK;
}

enum percuss_status inp_read_node_set(struct inp *inp, char *line)
{
    return inp->generate ? generate(inp, line, &inp->deck.builder.sets[inp->set].labels)
                         : read_set(inp, line, true);
}

enum percuss_status inp_read_element_set(struct inp *inp, char *line)
{
    return inp->generate ? generate(inp, line, &inp->deck.sets[inp->set].labels)
                         : read_set(inp, line, false);
}

/* an element or a set of them, S1 to S6 */
enum percuss_status inp_read_surface(struct inp *inp, char *line)
{
    struct deck_faces faces = {.surface = inp->set, .set = SIZE_MAX};
    char *whose = card_field(&line), *face = card_field(&line);
    if (!whose || !face || (face[0] != 'S' && face[0] != 's') || face[1] < '1' || face[1] > '6' ||
        face[2] != '\0')
        return scan_refuse(inp->scan, "*SURFACE: must be: element or set, S1 to S6");
    faces.face = face[1] - '0';
    if (*whose >= '0' && *whose <= '9') {
        if (!card_label(inp->scan, "*SURFACE", whose, &faces.label))
            return PERCUSS_BAD_REQUEST;
    } else if ((faces.set = deck_find_element_set(&inp->deck, whose)) == SIZE_MAX) {
        return scan_refuse(inp->scan, "*SURFACE: %.60s: must be the name of a set above", whose);
    }
    return deck_add_faces(&inp->deck, &faces) ? PERCUSS_OK : inp_out_of_memory(inp);
}

/* the first row counts: at the lowest temperature */
enum percuss_status inp_read_elastic(struct inp *inp, char *line)
{
    struct deck_material *material = &inp->deck.materials[inp->material];
    inp->read = NULL;
    if (!card_real(inp->scan, "*ELASTIC", card_field(&line), &material->young) ||
        !card_real(inp->scan, "*ELASTIC", card_field(&line), &material->poisson))
        return PERCUSS_BAD_REQUEST;
    material->elastic = true;
    return PERCUSS_OK;
}

enum percuss_status inp_read_density(struct inp *inp, char *line)
{
    struct deck_material *material = &inp->deck.materials[inp->material];
    inp->read = NULL;
    if (!card_real(inp->scan, "*DENSITY", card_field(&line), &material->density))
        return PERCUSS_BAD_REQUEST;
    material->dense = true;
    return PERCUSS_OK;
}

enum percuss_status inp_read_plastic(struct inp *inp, char *line)
{
    struct deck_material *material = &inp->deck.materials[inp->material];
    size_t i = material->stress_count;
    if (i == 2)
        return PERCUSS_OK;
    if (!card_real(inp->scan, "*PLASTIC", card_field(&line), &material->stress[i]) ||
        !card_real(inp->scan, "*PLASTIC", card_field(&line), &material->strain[i]))
        return PERCUSS_BAD_REQUEST;
    material->stress_count++;
    return PERCUSS_OK;
}

enum percuss_status inp_read_instance(struct inp *inp, char *line)
{
    (void)line;
    return scan_refuse(inp->scan,
                       "*INSTANCE: is moved or turned: must be in its own frame; export the part "
                       "itself");
}
