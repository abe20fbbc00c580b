/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/inp.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh/builder.h"
#include "mesh/card.h"
#include "mesh/element.h"
#include "mesh/grow.h"

/* ---- deck: its statements beyond nodes and elements (sets of elements, materials, sections,
 * surfaces), and how parts and sets of nodes follow from them ---- */

struct deck_set {
    char name[MESH_NAME_SIZE];
    struct builder_list labels; /* of elements */
};

/* In units of N, s and the file's length. */
struct deck_material {
    char name[MESH_NAME_SIZE];
    bool elastic, dense;
    double young, poisson, density;
    size_t stress_count; /* of *PLASTIC: its first two rows */
    double stress[2], strain[2];
};

struct deck_section {
    size_t set, material;
};

/* An element that is no solid: a shell, a line; it names nodes only. */
struct deck_other {
    size_t label, first, count; /* nodes are others_nodes[first] .. */
};

/* Faces of elements (by label, or of a set of them) that belong to a surface. */
struct deck_faces {
    size_t surface; /* set of nodes */
    size_t label;   /* of an element, where set is SIZE_MAX */
    size_t set;
    int face; /* 1 to 6 */
};

/* Zero it before use. Functions that add return false or SIZE_MAX when out of memory. */
struct deck {
    struct builder builder;
    size_t set_count, set_room;
    struct deck_set *sets;
    size_t material_count, material_room;
    struct deck_material *materials;
    size_t section_count, section_room;
    struct deck_section *sections;
    size_t other_count, other_room;
    struct deck_other *others;
    struct builder_list others_nodes;
    size_t face_count, face_room;
    struct deck_faces *faces;
};

/* no solid is softer, stiffer, lighter or heavier: values outside are in other units */
static const double LEAST_YOUNG = 1e4, MOST_YOUNG = 5e12, LEAST_DENSITY = 5.0, MOST_DENSITY = 3e4;

/* nodes of the faces S1 to S4, S1 to S6 in the order of Gmsh */
static const unsigned char TET_FACES[4][6] = {
    {0, 1, 2, 4, 5, 6}, {0, 3, 1, 7, 9, 4}, {1, 3, 2, 9, 8, 5}, {2, 3, 0, 8, 7, 6}};
static const unsigned char HEX_FACES[6][8] = {
    {0, 1, 2, 3, 8, 11, 13, 9},   {4, 7, 6, 5, 17, 19, 18, 16}, {0, 4, 5, 1, 10, 16, 12, 8},
    {1, 5, 6, 2, 12, 18, 14, 11}, {2, 6, 7, 3, 14, 19, 15, 13}, {3, 7, 4, 0, 15, 17, 10, 9}};

/* an element by its label: a solid, or another one */
struct place {
    size_t label, index;
    bool solid;
};

struct places {
    size_t count;
    struct place *places; /* ascending */
};

/* Sets and materials are found in any case of their letters; SIZE_MAX: there is none. */
static size_t deck_find_element_set(const struct deck *deck, const char *name)
{
    for (size_t i = 0; i < deck->set_count; i++)
        if (strcasecmp(deck->sets[i].name, name) == 0)
            return i;
    return SIZE_MAX;
}

static size_t deck_find_node_set(const struct deck *deck, const char *name)
{
    for (size_t i = 0; i < deck->builder.set_count; i++)
        if (strcasecmp(deck->builder.sets[i].name, name) == 0)
            return i;
    return SIZE_MAX;
}

/* Found, or made if there is none; SIZE_MAX: out of memory. */
static size_t deck_element_set(struct deck *deck, const char *name)
{
    size_t found = deck_find_element_set(deck, name);
    if (found != SIZE_MAX || !GROW(deck->sets, deck->set_count, deck->set_room))
        return found;
    struct deck_set *set = &deck->sets[deck->set_count];
    memset(set, 0, sizeof *set);
    snprintf(set->name, sizeof set->name, "%s", name);
    return deck->set_count++;
}

static size_t deck_node_set(struct deck *deck, const char *name)
{
    size_t found = deck_find_node_set(deck, name);
    return found != SIZE_MAX ? found : builder_set(&deck->builder, name);
}

static size_t deck_material(struct deck *deck, const char *name)
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

static bool deck_add_section(struct deck *deck, size_t set, size_t material)
{
    if (!GROW(deck->sections, deck->section_count, deck->section_room))
        return false;
    deck->sections[deck->section_count++] = (struct deck_section){set, material};
    return true;
}

static bool deck_add_other(struct deck *deck, size_t label, const size_t *nodes, size_t count)
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

static bool deck_add_faces(struct deck *deck, const struct deck_faces *faces)
{
    if (!GROW(deck->faces, deck->face_count, deck->face_room))
        return false;
    deck->faces[deck->face_count++] = *faces;
    return true;
}

static int deck_compare_labels(const void *left, const void *right)
{
    const struct place *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

static const struct place *deck_find_element(const struct places *places, size_t label)
{
    struct place key = {.label = label};
    return bsearch(&key, places->places, places->count, sizeof key, deck_compare_labels);
}

static bool deck_index_elements(const struct deck *deck, struct places *places)
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
    qsort(places->places, places->count, sizeof *places->places, deck_compare_labels);
    return true;
}

static enum percuss_status deck_check_labels(const struct places *places, const char *file,
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

/* stresses in N per square of the length; the unit of mass is 1 N s^2/unit of length. The tangent,
 * the slope of stress over total strain, from the first two rows of *PLASTIC with H = d stress/d
 * plastic strain: E H/(E + H) */
static enum percuss_status deck_convert_material(const struct deck_material *from, const char *file,
                                                 double unit, struct material *to,
                                                 struct fault *fault)
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
    /* values outside these limits have a wrong unit; the message is in the deck's terms */
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

/* a section's elements become a part of its name; `taken` marks elements with a section */
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
    /* a complete material; the command line must state others */
    if (material->elastic && material->dense) {
        part->has_material = true;
        enum percuss_status status =
            deck_convert_material(material, file, unit, &part->material, fault);
        if (status != PERCUSS_OK)
            return status;
    }
    /* its solid elements, in one part each */
    for (size_t i = 0; i < set->labels.count; i++) {
        const struct place *place = deck_find_element(places, set->labels.values[i]);
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
            const struct place *place = deck_find_element(places, set->labels.values[i]);
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

static bool deck_add_face(struct deck *deck, const struct deck_faces *faces,
                          const struct place *place)
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
            const struct place *place = deck_find_element(places, label);
            if (place && place->solid && !deck_add_face(deck, faces, place))
                return false;
        }
    }
    return true;
}

/* The mesh with parts by section, materials in SI, and sets of nodes. PERCUSS_BAD_REQUEST: an
 * element in two sections, materials outside the limits. */
static enum percuss_status deck_finish(struct deck *deck, const char *file, double unit,
                                       struct solid_mesh *mesh, struct fault *fault)
{
    struct places places = {0};
    memset(mesh, 0, sizeof *mesh);
    enum percuss_status status =
        deck_index_elements(deck, &places)
            ? deck_check_labels(&places, file, fault)
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

static void deck_free(struct deck *deck)
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

/* ---- lines of data: the keyword before them sets their reader ---- */

struct inp;
typedef enum percuss_status inp_line_reader(struct inp *inp, char *line);

/* State of reading. */
struct inp {
    struct scan *scan;
    struct deck deck;
    inp_line_reader *read; /* reader of lines of data after the last keyword; NULL: skip them */
    int depth, parts, instances;
    bool assembly, instance; /* inside *ASSEMBLY, *INSTANCE */
    bool begun, done;        /* after the first keyword; after *STEP */
    size_t set, material, part;
    bool generate, solid;
    enum element_type type;
    size_t label, nodes[ELEMENT_MOST_NODES], filled; /* the element under way */
};

/* limit of GENERATE: a file with that many labels would be huge */
static const size_t MOST_GENERATED = 20000000;

/* the deck's node of each node in Gmsh's order: Abaqus Elements Reference, 28.1.4 */
static const unsigned char TET_ORDER[10] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
static const unsigned char HEX_ORDER[20] = {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                            16, 9, 17, 10, 18, 19, 12, 15, 13, 14};

static enum percuss_status inp_out_of_memory(const struct inp *inp)
{
    return fault_set(inp->scan->fault, PERCUSS_INTERNAL, "%s: out of memory", inp->scan->file);
}

static enum percuss_status inp_read_node(struct inp *inp, char *line)
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

/* a solid's nodes may take several lines; another element takes one */
static enum percuss_status inp_read_element(struct inp *inp, char *line)
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
static enum percuss_status generate_labels(struct inp *inp, char *line, struct builder_list *list)
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

/* labels, and names of sets; adds the labels of those */
static enum percuss_status read_set_labels(struct inp *inp, char *line, bool of_nodes)
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
        /* or the name of a set above; skip an unknown one in an assembly */
        size_t other =
            of_nodes ? deck_find_node_set(deck, field) : deck_find_element_set(deck, field);
        if (other == SIZE_MAX && !inp->assembly)
            return scan_refuse(inp->scan, "set: %.60s: must be the name of a set above", field);
        if (other == SIZE_MAX || other == inp->set)
            continue;
        /* add its labels */
        const struct builder_list *from =
            of_nodes ? &deck->builder.sets[other].labels : &deck->sets[other].labels;
        for (size_t i = 0; i < from->count; i++)
            if (!builder_append(list, from->values[i]))
                return inp_out_of_memory(inp);
    }
    return PERCUSS_OK;
}

static enum percuss_status inp_read_node_set(struct inp *inp, char *line)
{
    return inp->generate ? generate_labels(inp, line, &inp->deck.builder.sets[inp->set].labels)
                         : read_set_labels(inp, line, true);
}

static enum percuss_status inp_read_element_set(struct inp *inp, char *line)
{
    return inp->generate ? generate_labels(inp, line, &inp->deck.sets[inp->set].labels)
                         : read_set_labels(inp, line, false);
}

/* an element or a set of elements, then S1 to S6 */
static enum percuss_status inp_read_surface(struct inp *inp, char *line)
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

/* the first row, at the lowest temperature */
static enum percuss_status inp_read_elastic(struct inp *inp, char *line)
{
    struct deck_material *material = &inp->deck.materials[inp->material];
    inp->read = NULL;
    if (!card_real(inp->scan, "*ELASTIC", card_field(&line), &material->young) ||
        !card_real(inp->scan, "*ELASTIC", card_field(&line), &material->poisson))
        return PERCUSS_BAD_REQUEST;
    material->elastic = true;
    return PERCUSS_OK;
}

static enum percuss_status inp_read_density(struct inp *inp, char *line)
{
    struct deck_material *material = &inp->deck.materials[inp->material];
    inp->read = NULL;
    if (!card_real(inp->scan, "*DENSITY", card_field(&line), &material->density))
        return PERCUSS_BAD_REQUEST;
    material->dense = true;
    return PERCUSS_OK;
}

static enum percuss_status inp_read_plastic(struct inp *inp, char *line)
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

static enum percuss_status inp_read_instance(struct inp *inp, char *line)
{
    (void)line;
    return scan_refuse(inp->scan,
                       "*INSTANCE: is moved or turned: must be in its own frame; export the part "
                       "itself");
}

/* ---- keywords ---- */

typedef enum percuss_status card_reader(struct inp *inp, const struct card *card);

static enum percuss_status read_deck(struct inp *inp, const char *path);

/* a required parameter; NULL after a message */
static const char *need(const struct inp *inp, const struct card *card, const char *key)
{
    const char *value = card_value(card, key);
    if (value && *value)
        return value;
    scan_refuse(inp->scan, "*%.40s: %s=: must be there", card->name, key);
    return NULL;
}

/* in an assembly, statements outside its instance belong to no body */
static bool is_outside(const struct inp *inp)
{
    return inp->assembly && !inp->instance;
}

static enum percuss_status keyword_node(struct inp *inp, const struct card *card)
{
    const char *set = card_value(card, "NSET"), *frame = card_value(card, "SYSTEM");
    if (frame && strcasecmp(frame, "R") != 0)
        return scan_refuse(inp->scan, "*NODE: SYSTEM=%.20s: must be R (rectangular)", frame);
    if (is_outside(inp))
        return PERCUSS_OK;
    inp->set = SIZE_MAX;
    if (set && *set && (inp->set = deck_node_set(&inp->deck, set)) == SIZE_MAX)
        return inp_out_of_memory(inp);
    inp->read = inp_read_node;
    return PERCUSS_OK;
}

/* takes or refuses a type of solid; other elements only name nodes */
static enum percuss_status inp_check_type(struct inp *inp, const char *type)
{
    static const char *const LINEAR[] = {"C3D4", "C3D5", "C3D6", "C3D8"};
    inp->solid = strncasecmp(type, "C3D", 3) == 0;
    if (!inp->solid)
        return PERCUSS_OK;
    if (strncasecmp(type, "C3D10", 5) == 0 || strncasecmp(type, "C3D20", 5) == 0) {
        inp->type = type[3] == '1' ? ELEMENT_TET10 : ELEMENT_HEX20;
        return PERCUSS_OK;
    }
    for (size_t i = 0; i < sizeof LINEAR / sizeof *LINEAR; i++)
        if (strncasecmp(type, LINEAR[i], 4) == 0)
            return scan_refuse(inp->scan,
                               "*ELEMENT: TYPE=%.20s: must be of second order (C3D10, C3D20), as "
                               "linear ones are too stiff (first frequency 4 to 15 %% high)",
                               type);
    return scan_refuse(inp->scan, "*ELEMENT: TYPE=%.20s: must be C3D10 or C3D20, or a kind of them",
                       type);
}

static enum percuss_status keyword_element(struct inp *inp, const struct card *card)
{
    const char *type = need(inp, card, "TYPE"), *set = card_value(card, "ELSET");
    if (!type)
        return PERCUSS_BAD_REQUEST;
    if (is_outside(inp))
        return PERCUSS_OK;
    enum percuss_status status = inp_check_type(inp, type);
    if (status != PERCUSS_OK)
        return status;
    set = set && *set ? set : inp->solid ? "body" : "shells";
    inp->set = deck_element_set(&inp->deck, set);
    inp->part = inp->solid ? builder_part(&inp->deck.builder, set) : 0;
    if (inp->set == SIZE_MAX || inp->part == SIZE_MAX)
        return inp_out_of_memory(inp);
    inp->filled = 0;
    inp->read = inp_read_element;
    return PERCUSS_OK;
}

static enum percuss_status keyword_node_set(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "NSET");
    if (!name)
        return PERCUSS_BAD_REQUEST;
    if (card_value(card, "ELSET"))
        return scan_refuse(inp->scan, "*NSET: ELSET: must be a list of nodes and sets of nodes");
    if (is_outside(inp) && !card_value(card, "INSTANCE"))
        return PERCUSS_OK;
    inp->generate = card_value(card, "GENERATE") != NULL;
    inp->set = deck_node_set(&inp->deck, name);
    inp->read = inp_read_node_set;
    return inp->set == SIZE_MAX ? inp_out_of_memory(inp) : PERCUSS_OK;
}

static enum percuss_status keyword_element_set(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "ELSET");
    if (!name)
        return PERCUSS_BAD_REQUEST;
    if (is_outside(inp) && !card_value(card, "INSTANCE"))
        return PERCUSS_OK;
    inp->generate = card_value(card, "GENERATE") != NULL;
    inp->set = deck_element_set(&inp->deck, name);
    inp->read = inp_read_element_set;
    return inp->set == SIZE_MAX ? inp_out_of_memory(inp) : PERCUSS_OK;
}

/* a surface of elements lists faces; one of nodes is a set of nodes */
static enum percuss_status keyword_surface(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "NAME"), *type = card_value(card, "TYPE");
    if (!name)
        return PERCUSS_BAD_REQUEST;
    inp->generate = false;
    inp->set = deck_node_set(&inp->deck, name);
    inp->read = type && strcasecmp(type, "NODE") == 0 ? inp_read_node_set : inp_read_surface;
    return inp->set == SIZE_MAX ? inp_out_of_memory(inp) : PERCUSS_OK;
}

static enum percuss_status keyword_material(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "NAME");
    if (!name)
        return PERCUSS_BAD_REQUEST;
    inp->material = deck_material(&inp->deck, name);
    return inp->material == SIZE_MAX ? inp_out_of_memory(inp) : PERCUSS_OK;
}

/* *ELASTIC, *DENSITY, *PLASTIC belong to the *MATERIAL above */
static enum percuss_status keyword_property(struct inp *inp, const struct card *card)
{
    const char *type = card_value(card, "TYPE");
    if (inp->material == SIZE_MAX)
        return scan_refuse(inp->scan, "*%.20s: must come after a *MATERIAL", card->name);
    if (card->name[0] == 'E' && type && strncasecmp(type, "ISO", 3) != 0)
        return scan_refuse(inp->scan, "*ELASTIC: TYPE=%.40s: must be ISOTROPIC", type);
    inp->read = card->name[0] == 'E'   ? inp_read_elastic
                : card->name[0] == 'D' ? inp_read_density
                                       : inp_read_plastic;
    return PERCUSS_OK;
}

static enum percuss_status keyword_section(struct inp *inp, const struct card *card)
{
    const char *set = need(inp, card, "ELSET");
    const char *name = set ? need(inp, card, "MATERIAL") : NULL;
    if (!name)
        return PERCUSS_BAD_REQUEST;
    size_t elements = deck_element_set(&inp->deck, set), found = deck_material(&inp->deck, name);
    return elements != SIZE_MAX && found != SIZE_MAX &&
                   deck_add_section(&inp->deck, elements, found)
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

/* reads a file beside this one in place of the line; its first lines of data may belong to the
 * keyword above */
static enum percuss_status keyword_include(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "INPUT");
    char path[INP_PATH_SIZE];
    if (!name)
        return PERCUSS_BAD_REQUEST;
    if (inp->depth == INP_MOST_DEPTH)
        return scan_refuse(inp->scan, "*INCLUDE: must not be more than %d deep", INP_MOST_DEPTH);
    inp_include_path(inp->scan->file, name, path);
    struct scan *outer = inp->scan;
    inp->depth++;
    enum percuss_status status = read_deck(inp, path);
    inp->depth--;
    inp->scan = outer;
    return status;
}

static enum percuss_status keyword_part(struct inp *inp, const struct card *card)
{
    (void)card;
    if (++inp->parts > 1)
        return scan_refuse(inp->scan,
                           "*PART: is the second one: must be one body; export one part");
    return PERCUSS_OK;
}

static enum percuss_status keyword_assembly(struct inp *inp, const struct card *card)
{
    inp->assembly = card->name[0] == 'A';
    return PERCUSS_OK;
}

static enum percuss_status keyword_instance(struct inp *inp, const struct card *card)
{
    inp->instance = card->name[0] == 'I';
    if (inp->instance && ++inp->instances > 1)
        return scan_refuse(inp->scan,
                           "*INSTANCE: is the second one: must be one body; export one part");
    inp->read = inp->instance ? inp_read_instance : NULL;
    return PERCUSS_OK;
}

static enum percuss_status keyword_step(struct inp *inp, const struct card *card)
{
    (void)card;
    inp->done = true;
    return PERCUSS_OK;
}

/* keywords that generate nodes and elements */
static enum percuss_status keyword_refuse(struct inp *inp, const struct card *card)
{
    return scan_refuse(inp->scan,
                       "*%.40s: is not read: nodes and elements must be written out one by one",
                       card->name);
}

static const struct {
    const char *name;
    card_reader *read;
} CARDS[] = {{"NODE", keyword_node},         {"ELEMENT", keyword_element},
             {"NSET", keyword_node_set},     {"ELSET", keyword_element_set},
             {"SURFACE", keyword_surface},   {"MATERIAL", keyword_material},
             {"ELASTIC", keyword_property},  {"DENSITY", keyword_property},
             {"PLASTIC", keyword_property},  {"SOLID SECTION", keyword_section},
             {"INCLUDE", keyword_include},   {"PART", keyword_part},
             {"ASSEMBLY", keyword_assembly}, {"END ASSEMBLY", keyword_assembly},
             {"INSTANCE", keyword_instance}, {"END INSTANCE", keyword_instance},
             {"STEP", keyword_step},         {"SYSTEM", keyword_refuse},
             {"NGEN", keyword_refuse},       {"NFILL", keyword_refuse},
             {"NCOPY", keyword_refuse},      {"ELGEN", keyword_refuse},
             {"ELCOPY", keyword_refuse}};

static enum percuss_status read_card(struct inp *inp, char *line)
{
    struct card card;
    card_parse(line, &card);
    inp->begun = true;
    /* lines of data may continue in and after an included file */
    if (strcmp(card.name, "INCLUDE") != 0) {
        if (inp->read == inp_read_element && inp->filled > 0)
            return scan_refuse(inp->scan, "*ELEMENT: %zu: has %zu nodes: must have more",
                               inp->label, inp->filled);
        inp->read = NULL;
    }
    for (size_t i = 0; i < sizeof CARDS / sizeof *CARDS; i++)
        if (strcmp(card.name, CARDS[i].name) == 0)
            return CARDS[i].read(inp, &card);
    return PERCUSS_OK;
}

/* reads the deck or a file that it includes */
static enum percuss_status read_deck(struct inp *inp, const char *path)
{
    struct scan scan;
    struct fault *fault = inp->scan->fault;
    char line[CARD_LINE_SIZE];
    enum percuss_status status = scan_open(path, &scan, fault);
    if (status != PERCUSS_OK)
        return status;
    inp->scan = &scan;
    while (!inp->done && card_line(&scan, line, &status)) {
        status = line[0] == '*' ? read_card(inp, line)
                 : inp->read    ? inp->read(inp, line)
                 : inp->begun   ? PERCUSS_OK
                                : scan_refuse(&scan, "must begin with a keyword, such as *NODE: is "
                                                       "it a deck of Abaqus or CalculiX?");
        if (status != PERCUSS_OK)
            break;
    }
    if (status == PERCUSS_OK && inp->depth == 0 && inp->read == inp_read_element && inp->filled > 0)
        status = scan_refuse(&scan, "*ELEMENT: %zu: has %zu nodes: must have more", inp->label,
                             inp->filled);
    scan_close(&scan);
    return status;
}

enum percuss_status inp_read(const char *path, double unit, struct solid_mesh *mesh,
                             struct fault *fault)
{
    struct scan scan = {.file = path, .fault = fault};
    struct inp inp = {.scan = &scan, .set = SIZE_MAX, .material = SIZE_MAX};
    memset(mesh, 0, sizeof *mesh);
    enum percuss_status status = read_deck(&inp, path);
    if (status == PERCUSS_OK)
        status = deck_finish(&inp.deck, path, unit, mesh, fault);
    deck_free(&inp.deck);
    return status;
}

void inp_include_path(const char *file, const char *name, char path[INP_PATH_SIZE])
{
    const char *slash = strrchr(file, '/');
    int folder = *name != '/' && slash ? (int)(slash + 1 - file) : 0;
    snprintf(path, INP_PATH_SIZE, "%.*s%s", folder, file, name);
}
