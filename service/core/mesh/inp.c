/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/inp.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "mesh/card.h"
#include "mesh/deck_body.h"
#include "mesh/deck_support.h"
#include "mesh/inp_keywords.h"
#include "mesh/inp_material.h"

/* ---- lines of data: the keyword before them sets their reader ---- */

struct inp;
typedef enum percuss_status inp_line_reader(struct inp *inp, char *line);

/* State of reading. */
struct inp {
    struct scan *scan;
    struct deck deck;
    inp_line_reader *read; /* reader of lines of data after the last keyword; NULL: skip them */
    const char *path;      /* of the deck itself */
    size_t file;           /* deck.files: that of `scan` */
    int depth;
    bool raise;          /* linear elements are taken */
    bool begun, step;    /* after the first keyword; after *STEP */
    size_t scope, outer; /* scopes: that of the statements; that of the assembly */
    size_t set, instance;
    struct inp_material material; /* under way */
    bool generate;
    int row;                     /* lines of an instance so far */
    struct deck_element element; /* under way */
    bool point;                  /* it is a TYPE=MASS */
    size_t masses;               /* deck.names: the set of the *MASS under way */
    size_t nodes[ELEMENT_MOST_NODES], filled, wanted; /* wanted: 0 where a line is an element */
};

/* limit of GENERATE: a file with that many labels would be huge */
static const size_t MOST_GENERATED = 20000000;

static enum percuss_status inp_out_of_memory(const struct inp *inp)
{
    return fault_set(inp->scan->fault, PERCUSS_INTERNAL, "%s: out of memory", inp->scan->file);
}

static struct deck_place inp_place(const struct inp *inp)
{
    return (struct deck_place){inp->file, inp->scan->line};
}

/* Makes a name of a field; refuses what is too long for one. */
static bool read_name(const struct inp *inp, char *field)
{
    card_name(field);
    if (strlen(field) < MESH_NAME_SIZE)
        return true;
    scan_refuse(inp->scan, "%.80s: must have at most %d letters", field, MESH_NAME_SIZE - 1);
    return false;
}

static bool is_number(const char *field)
{
    return isdigit((unsigned char)*field);
}

static enum percuss_status inp_read_node(struct inp *inp, char *line)
{
    struct deck_item item = {.kind = DECK_RANGE, .instance = DECK_NONE, .step = 1};
    double point[3] = {0.0, 0.0, 0.0};
    if (!card_label(inp->scan, "*NODE", card_field(&line), &item.first))
        return PERCUSS_BAD_REQUEST;
    for (int k = 0; k < 3; k++) {
        char *field = card_field(&line);
        if (field && *field && !card_real(inp->scan, "*NODE", field, &point[k]))
            return PERCUSS_BAD_REQUEST;
    }
    for (int k = 0; k < 3; k++)
        if (!isfinite(point[k]))
            return scan_refuse(inp->scan, "node %zu: %g: coordinates must be finite numbers",
                               item.first, point[k]);
    item.last = item.first;
    if (!deck_add_node(&inp->deck, inp->scope, item.first, point) ||
        (inp->set != DECK_NONE && !deck_add_item(&inp->deck, inp->set, &item)))
        return inp_out_of_memory(inp);
    return PERCUSS_OK;
}

static enum percuss_status finish_element(struct inp *inp)
{
    size_t label = inp->element.label;
    struct deck_item item = {DECK_RANGE, 0, label, label, 1, 0, DECK_NONE, {0, 0}};
    inp->element.count = inp->filled;
    inp->filled = 0;
    if (inp->point && inp->element.count != 1)
        return scan_refuse(inp->scan, "*ELEMENT: %zu: TYPE=MASS: must have 1 node", label);
    const struct deck_point point = {label, inp->scope, inp->nodes[0], DECK_NONE, false};
    return deck_add_element(&inp->deck, &inp->element, inp->nodes) &&
                   deck_add_item(&inp->deck, inp->set, &item) &&
                   (!inp->point || deck_add_point(&inp->deck, &point))
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

/* the nodes of a solid, of heat and sound too, may take several lines; another element takes one */
static enum percuss_status inp_read_element(struct inp *inp, char *line)
{
    size_t wanted = inp->wanted;
    size_t most = wanted ? wanted : ELEMENT_MOST_NODES;
    char *field;
    if (inp->filled == 0) {
        if (!card_label(inp->scan, "*ELEMENT", card_field(&line), &inp->element.label))
            return PERCUSS_BAD_REQUEST;
        inp->element.place = inp_place(inp);
    }
    while ((field = card_field(&line))) {
        if (inp->filled == most)
            return scan_refuse(inp->scan, "*ELEMENT: %zu: must have %zu nodes", inp->element.label,
                               most);
        /* elements of networks have ends without a node */
        if (!wanted && strcmp(field, "0") == 0)
            continue;
        if (!card_label(inp->scan, "*ELEMENT", field, &inp->nodes[inp->filled]))
            return PERCUSS_BAD_REQUEST;
        inp->filled++;
    }
    return inp->filled == most || !wanted ? finish_element(inp) : PERCUSS_OK;
}

/* first, last and step of the labels to generate; the step may lead down */
static enum percuss_status generate_labels(struct inp *inp, char *line)
{
    struct deck_item item = {.kind = DECK_RANGE, .instance = inp->instance, .step = 1};
    char *field;
    if (!card_label(inp->scan, "GENERATE", card_field(&line), &item.first) ||
        !card_label(inp->scan, "GENERATE", card_field(&line), &item.last))
        return PERCUSS_BAD_REQUEST;
    field = card_field(&line);
    bool down = field && *field == '-';
    if (field && *field && !card_label(inp->scan, "GENERATE", field + down, &item.step))
        return PERCUSS_BAD_REQUEST;
    if (down) {
        size_t first = item.first;
        if (item.last > first)
            return scan_refuse(inp->scan, "GENERATE: %zu to %zu by -%zu: must lead down", first,
                               item.last, item.step);
        item.first = first - (first - item.last) / item.step * item.step;
        item.last = first;
    }
    if (item.last < item.first || (item.last - item.first) / item.step > MOST_GENERATED)
        return scan_refuse(inp->scan, "GENERATE: %zu to %zu: must be at most %zu numbers",
                           item.first, item.last, MOST_GENERATED);
    item.last -= (item.last - item.first) % item.step;
    return deck_add_item(&inp->deck, inp->set, &item) ? PERCUSS_OK : inp_out_of_memory(inp);
}

static bool is_instance(const struct inp *inp, const char *name)
{
    for (size_t i = 0; i < inp->deck.scope_count; i++)
        if (inp->deck.scopes[i].kind == DECK_INSTANCE && deck_same(inp->deck.scopes[i].name, name))
            return true;
    return false;
}

/* The label or the name of a field, which INSTANCE. may precede in an assembly; `labels` and
 * `names`: what an item of them is. */
static enum percuss_status read_item(struct inp *inp, char *field, struct deck_item *item,
                                     enum deck_item_kind labels, enum deck_item_kind names)
{
    item->instance = inp->instance;
    item->place = inp_place(inp);
    bool quoted = *field == '"';
    if (!read_name(inp, field))
        return PERCUSS_BAD_REQUEST;
    char *dot = inp->scope == inp->outer ? strchr(field, '.') : NULL;
    if (dot) {
        *dot = '\0';
        if (is_instance(inp, field)) {
            if ((item->instance = deck_name(&inp->deck, field)) == DECK_NONE)
                return inp_out_of_memory(inp);
            field = dot + 1;
        } else {
            *dot = '.';
        }
    }
    item->kind = !quoted && is_number(field) ? labels : names;
    item->step = 1;
    if (item->kind == names)
        return (item->name = deck_name(&inp->deck, field)) != DECK_NONE ? PERCUSS_OK
                                                                        : inp_out_of_memory(inp);
    if (!card_label(inp->scan, "set", field, &item->first))
        return PERCUSS_BAD_REQUEST;
    item->last = item->first;
    return PERCUSS_OK;
}

/* labels, and names of sets */
static enum percuss_status inp_read_set(struct inp *inp, char *line)
{
    char *field;
    if (inp->generate)
        return generate_labels(inp, line);
    while ((field = card_field(&line))) {
        struct deck_item item = {0};
        if (*field == '\0')
            continue;
        enum percuss_status status = read_item(inp, field, &item, DECK_RANGE, DECK_SET);
        if (status)
            return status;
        if (!deck_add_item(&inp->deck, inp->set, &item))
            return inp_out_of_memory(inp);
    }
    return PERCUSS_OK;
}

/* a TYPE=MASS of an assembly: its label, INSTANCE.NODE */
static enum percuss_status inp_read_assembly_point(struct inp *inp, char *line)
{
    struct deck_item node = {0}, item = {.kind = DECK_RANGE, .instance = DECK_NONE, .step = 1};
    struct deck_point point = {.scope = inp->scope};
    if (!card_label(inp->scan, "*ELEMENT", card_field(&line), &point.label))
        return PERCUSS_BAD_REQUEST;
    char *field = card_field(&line);
    inp->instance = DECK_NONE;
    enum percuss_status status =
        field ? read_item(inp, field, &node, DECK_RANGE, DECK_SET) : PERCUSS_OK;
    if (!status && (!field || node.kind != DECK_RANGE))
        return scan_refuse(inp->scan, "*ELEMENT: %zu: TYPE=MASS: must have 1 node", point.label);
    if (status)
        return status;
    point.node = node.first;
    point.instance = node.instance;
    item.first = item.last = point.label;
    return deck_add_point(&inp->deck, &point) && deck_add_item(&inp->deck, inp->set, &item)
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

static enum percuss_status inp_read_mass(struct inp *inp, char *line)
{
    struct deck_mass mass = {.scope = inp->scope, .set = inp->masses, .place = inp_place(inp)};
    if (!card_real(inp->scan, "*MASS", card_field(&line), &mass.mass))
        return PERCUSS_BAD_REQUEST;
    if (!(mass.mass >= 0.0 && isfinite(mass.mass)))
        return scan_refuse(inp->scan, "*MASS: %g: must be a finite number >= 0", mass.mass);
    inp->read = NULL;
    return deck_add_mass(&inp->deck, &mass) ? PERCUSS_OK : inp_out_of_memory(inp);
}

/* a surface of nodes: a node or a set, and an area that stands behind it */
static enum percuss_status inp_read_node_surface(struct inp *inp, char *line)
{
    struct deck_item item = {0};
    char *field = card_field(&line);
    enum percuss_status status =
        field ? read_item(inp, field, &item, DECK_RANGE, DECK_SET) : PERCUSS_OK;
    if (status || !field)
        return status;
    return deck_add_item(&inp->deck, inp->set, &item) ? PERCUSS_OK : inp_out_of_memory(inp);
}

/* S1 to S6, or a side of shells; 0: neither */
static int face_of(const char *text)
{
    if (strcasecmp(text, "SPOS") == 0 || strcasecmp(text, "SNEG") == 0 ||
        strcasecmp(text, "S") == 0)
        return DECK_WHOLE;
    return (text[0] == 'S' || text[0] == 's') && text[1] >= '1' && text[1] <= '6' && !text[2]
               ? text[1] - '0'
               : 0;
}

/* an element or a set of elements, then S1 to S6 */
static enum percuss_status inp_read_surface(struct inp *inp, char *line)
{
    struct deck_item item = {0};
    char *whose = card_field(&line), *face = card_field(&line);
    if (whose && *whose && (!face || !*face))
        return deck_tell(
                   &inp->deck,
                   "*SURFACE, NAME=%s: is the whole outside of %.60s: left out, as no list of "
                   "faces",
                   inp->deck.sets[inp->set].name, whose)
                   ? PERCUSS_OK
                   : inp_out_of_memory(inp);
    if (!whose || !*whose || !(item.face = face_of(face)))
        return scan_refuse(inp->scan, "*SURFACE: must be: element or set, S1 to S6");
    enum percuss_status status = read_item(inp, whose, &item, DECK_FACES, DECK_SET_FACES);
    if (status)
        return status;
    return deck_add_item(&inp->deck, inp->set, &item) ? PERCUSS_OK : inp_out_of_memory(inp);
}

static enum percuss_status inp_read_property(struct inp *inp, char *line)
{
    return inp_material_row(&inp->material, inp->scan, line);
}

/* where an instance stands: its shift, then two points of an axis and degrees */
static enum percuss_status inp_read_instance(struct inp *inp, char *line)
{
    struct deck_scope *scope = &inp->deck.scopes[inp->scope];
    double *values = inp->row == 0 ? scope->shift : scope->axis[0], degrees = 0.0;
    int count = inp->row == 0 ? 3 : 6;
    if (inp->row++ > 1)
        return scan_refuse(inp->scan, "*INSTANCE: must have at most two lines");
    for (int k = 0; k < count; k++) {
        char *field = card_field(&line);
        if (field && *field && !card_real(inp->scan, "*INSTANCE", field, &values[k]))
            return PERCUSS_BAD_REQUEST;
    }
    char *further = count == 3 ? card_field(&line) : NULL;
    if (further && *further)
        return scan_refuse(inp->scan,
                           "*INSTANCE: %.40s: its first line must be the shift, three numbers: "
                           "0, 0, 0 where it is turned alone",
                           further);
    if (count == 3)
        return PERCUSS_OK;
    if (!card_real(inp->scan, "*INSTANCE", card_field(&line), &degrees))
        return PERCUSS_BAD_REQUEST;
    scope->degrees = degrees;
    if (degrees != 0.0 && memcmp(scope->axis[0], scope->axis[1], sizeof scope->axis[0]) == 0)
        return scan_refuse(inp->scan, "*INSTANCE: its axis must have two different points");
    return PERCUSS_OK;
}

/* The node or set of a *BOUNDARY, and the directions in which it is held. */
static enum percuss_status inp_read_boundary(struct inp *inp, char *line)
{
    char *whose = card_field(&line), *first = card_field(&line), *last = card_field(&line);
    if (!whose || !*whose)
        return PERCUSS_OK;
    bool single = is_number(whose);
    card_name(whose);
    char *dot = strchr(whose, '.');
    if (dot && is_number(dot + 1)) {
        *dot = '\0';
        single = single || is_instance(inp, whose);
        *dot = '.';
    }
    return deck_support_add(&inp->deck, single ? "" : whose, deck_support_directions(first, last))
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

/* ---- keywords ---- */

typedef enum percuss_status card_reader(struct inp *inp, const struct card *card);

static enum percuss_status read_deck(struct inp *inp, const char *path);

/* a parameter's name, or NULL: too long, or none where it is required, with a message */
static const char *need(const struct inp *inp, const struct card *card, const char *key)
{
    const char *value = card_value(card, key);
    if (value && *value && strlen(value) < MESH_NAME_SIZE)
        return value;
    if (value && *value)
        scan_refuse(inp->scan, "*%.40s: %s=%.80s: must have at most %d letters", card->name, key,
                    value, MESH_NAME_SIZE - 1);
    else
        scan_refuse(inp->scan, "*%.40s: %s=: must be there", card->name, key);
    return NULL;
}

/* INSTANCE= of sets in an assembly */
static enum percuss_status read_instance_name(struct inp *inp, const struct card *card)
{
    const char *name = card_value(card, "INSTANCE");
    inp->instance = DECK_NONE;
    if (!name)
        return PERCUSS_OK;
    if (!is_instance(inp, name))
        return scan_refuse(inp->scan, "*%.40s: INSTANCE=%.60s: must be the name of an instance",
                           card->name, name);
    inp->instance = deck_name(&inp->deck, name);
    return inp->instance == DECK_NONE ? inp_out_of_memory(inp) : PERCUSS_OK;
}

static enum percuss_status keyword_node(struct inp *inp, const struct card *card)
{
    const char *set = card_value(card, "NSET"), *frame = card_value(card, "SYSTEM");
    if (frame && strcasecmp(frame, "R") != 0)
        return scan_refuse(inp->scan, "*NODE: SYSTEM=%.20s: must be R (rectangular)", frame);
    inp->set = DECK_NONE;
    if (set && *set && !(set = need(inp, card, "NSET")))
        return PERCUSS_BAD_REQUEST;
    if (set && *set && (inp->set = deck_set(&inp->deck, DECK_NODES, inp->scope, set)) == DECK_NONE)
        return inp_out_of_memory(inp);
    inp->read = inp_read_node;
    return PERCUSS_OK;
}

/* takes or refuses a type of solid; other elements only name nodes */
static enum percuss_status inp_check_type(struct inp *inp, const char *type)
{
    static const char *const SOLIDS[] = {"C3D10", "C3D15", "C3D20", "C3D4", "C3D6", "C3D8"};
    inp->element.kind = DECK_OTHER;
    inp->point = strcasecmp(type, "MASS") == 0;
    if (strncasecmp(type, "C3D", 3) != 0)
        return inp->point || keyword_is_surface(type) ||
                       deck_tell(&inp->deck, "*ELEMENT, TYPE=%.20s: %s", type,
                                 "left out: no solids of second order")
                   ? PERCUSS_OK
                   : inp_out_of_memory(inp);
    for (int kind = 0; kind < DECK_OTHER; kind++) {
        size_t length = strlen(SOLIDS[kind]);
        if (strncasecmp(type, SOLIDS[kind], length) != 0 || isdigit((unsigned char)type[length]))
            continue;
        if (kind >= DECK_C3D4 && !inp->raise)
            return scan_refuse(inp->scan,
                               "*ELEMENT: TYPE=%.20s: must be of second order (C3D10, C3D15, "
                               "C3D20), as linear ones are too stiff (first frequency 4 to 15 %% "
                               "high): mesh with mid-side nodes, or raise them by --raise",
                               type);
        inp->element.kind = (enum deck_element_kind)kind;
        return PERCUSS_OK;
    }
    return scan_refuse(
        inp->scan, "*ELEMENT: TYPE=%.20s: must be C3D10, C3D15 or C3D20, or a kind of them", type);
}

static enum percuss_status keyword_element(struct inp *inp, const struct card *card)
{
    const char *type = need(inp, card, "TYPE"), *set = card_value(card, "ELSET");
    if (!type || (set && *set && !need(inp, card, "ELSET")))
        return PERCUSS_BAD_REQUEST;
    enum percuss_status status = inp_check_type(inp, type);
    if (status != PERCUSS_OK)
        return status;
    inp->wanted = inp->element.kind == DECK_OTHER ? keyword_solid_nodes(type)
                                                  : deck_element_nodes(inp->element.kind);
    /* in an assembly they name nodes of instances */
    if (inp->scope == inp->outer && !inp->point) {
        if (inp->element.kind == DECK_OTHER)
            return PERCUSS_OK;
        return scan_refuse(inp->scan, "*ELEMENT: solids must be in a *PART or an *INSTANCE");
    }
    set = set && *set ? set : inp->element.kind != DECK_OTHER ? "body" : "shells";
    inp->set = deck_set(&inp->deck, DECK_ELEMENTS, inp->scope, set);
    if (inp->set != DECK_NONE)
        inp->element.group = deck_name(&inp->deck, inp->deck.sets[inp->set].name);
    if (inp->set == DECK_NONE || inp->element.group == DECK_NONE)
        return inp_out_of_memory(inp);
    inp->element.scope = inp->scope;
    inp->filled = 0;
    inp->read = inp->scope == inp->outer ? inp_read_assembly_point : inp_read_element;
    return PERCUSS_OK;
}

/* *NSET, ELSET=: the nodes of its elements, without lines of data */
static enum percuss_status nodes_of_elements(struct inp *inp, const struct card *card)
{
    const char *elements = need(inp, card, "ELSET");
    struct deck_item item = {.kind = DECK_ELEMENT_NODES,
                             .instance = inp->instance,
                             .name = elements ? deck_name(&inp->deck, elements) : 0,
                             .place = inp_place(inp)};
    if (!elements)
        return PERCUSS_BAD_REQUEST;
    return item.name != DECK_NONE && deck_add_item(&inp->deck, inp->set, &item)
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

static enum percuss_status keyword_set(struct inp *inp, const struct card *card)
{
    bool nodes = card->name[0] == 'N';
    const char *name = need(inp, card, nodes ? "NSET" : "ELSET");
    enum percuss_status status = name ? read_instance_name(inp, card) : PERCUSS_BAD_REQUEST;
    if (status)
        return status;
    inp->generate = card_value(card, "GENERATE") != NULL;
    inp->set = deck_set(&inp->deck, nodes ? DECK_NODES : DECK_ELEMENTS, inp->scope, name);
    inp->read = inp_read_set;
    if (inp->set == DECK_NONE)
        return inp_out_of_memory(inp);
    return nodes && card_value(card, "ELSET") ? nodes_of_elements(inp, card) : PERCUSS_OK;
}

/* a surface of elements lists faces; one of nodes is a set of nodes */
static enum percuss_status keyword_surface(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "NAME"), *type = card_value(card, "TYPE");
    bool nodes = type && strcasecmp(type, "NODE") == 0;
    if (!name)
        return PERCUSS_BAD_REQUEST;
    if ((type && !nodes && strcasecmp(type, "ELEMENT") != 0) || card_value(card, "COMBINE"))
        return deck_tell(&inp->deck, "*SURFACE, NAME=%s: left out: no list of faces or nodes", name)
                   ? PERCUSS_OK
                   : inp_out_of_memory(inp);
    inp->instance = DECK_NONE;
    inp->set = deck_set(&inp->deck, DECK_SURFACE, inp->scope, name);
    inp->read = nodes ? inp_read_node_surface : inp_read_surface;
    return inp->set == DECK_NONE ? inp_out_of_memory(inp) : PERCUSS_OK;
}

static enum percuss_status keyword_material(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "NAME");
    if (!name)
        return PERCUSS_BAD_REQUEST;
    inp->material.at = deck_add_material(&inp->deck, name, inp_place(inp));
    return inp->material.at == DECK_NONE ? inp_out_of_memory(inp) : PERCUSS_OK;
}

static enum percuss_status keyword_property(struct inp *inp, const struct card *card)
{
    bool lines = false;
    enum percuss_status status = inp_material_property(&inp->material, inp->scan, card, &lines);
    if (lines)
        inp->read = inp_read_property;
    return status;
}

static enum percuss_status keyword_section(struct inp *inp, const struct card *card)
{
    const char *set = need(inp, card, "ELSET");
    const char *material = set ? need(inp, card, "MATERIAL") : NULL;
    if (!material)
        return PERCUSS_BAD_REQUEST;
    struct deck_section section = {inp->scope, deck_name(&inp->deck, set),
                                   deck_name(&inp->deck, material), inp_place(inp)};
    return section.set != DECK_NONE && section.material != DECK_NONE &&
                   deck_add_section(&inp->deck, &section)
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

static enum percuss_status keyword_mass(struct inp *inp, const struct card *card)
{
    const char *set = need(inp, card, "ELSET"), *type = card_value(card, "TYPE");
    if (!set)
        return PERCUSS_BAD_REQUEST;
    if (type && strncasecmp(type, "ISO", 3) != 0)
        return deck_tell(&inp->deck,
                         "*MASS, ELSET=%s (line %zu): TYPE=%.20s: left out, as no mass in all "
                         "directions: the body here is lighter by it",
                         set, inp->scan->line, type)
                   ? PERCUSS_OK
                   : inp_out_of_memory(inp);
    inp->masses = deck_name(&inp->deck, set);
    inp->read = inp_read_mass;
    return inp->masses == DECK_NONE ? inp_out_of_memory(inp) : PERCUSS_OK;
}

/* reads another file in place of the line; its first lines of data may belong to the keyword above
 */
static enum percuss_status read_other_file(struct inp *inp, const struct card *card)
{
    const char *name = card_value(card, "INPUT");
    char path[INP_PATH_SIZE];
    if (!name || !*name)
        return scan_refuse(inp->scan, "*%.40s: INPUT=: must be there", card->name);
    if (inp->depth == INP_MOST_DEPTH)
        return scan_refuse(inp->scan, "*INCLUDE: must not be more than %d deep", INP_MOST_DEPTH);
    inp_include_path(inp->path, inp->scan->file, name, path);
    if (access(path, R_OK) != 0)
        return scan_refuse(inp->scan,
                           "*%.40s: INPUT=%.200s: %s: must be in the deck's folder, in that of the "
                           "file that names it or in the current one",
                           card->name, name, strerror(errno));
    struct scan *outer = inp->scan;
    size_t file = inp->file;
    inp->depth++;
    enum percuss_status status = read_deck(inp, path);
    inp->depth--;
    inp->scan = outer;
    inp->file = file;
    return status;
}

static enum percuss_status open_scope(struct inp *inp, enum deck_scope_kind kind, const char *name)
{
    inp->scope = deck_add_scope(&inp->deck, kind, name);
    return inp->scope == DECK_NONE ? inp_out_of_memory(inp) : PERCUSS_OK;
}

static enum percuss_status keyword_scope(struct inp *inp, const struct card *card)
{
    bool part = card->name[0] == 'P';
    const char *name = need(inp, card, "NAME");
    if (!name)
        return PERCUSS_BAD_REQUEST;
    if (inp->scope != 0)
        return scan_refuse(inp->scan, "*%s: must not be inside another one, nor inside *%s",
                           card->name, part ? "ASSEMBLY" : "PART");
    enum percuss_status status = open_scope(inp, part ? DECK_PART : DECK_ASSEMBLY, name);
    if (!part)
        inp->outer = inp->scope;
    return status;
}

static enum percuss_status keyword_end_scope(struct inp *inp, const struct card *card)
{
    bool instance = strcmp(card->name, "ENDINSTANCE") == 0;
    inp->scope = instance && inp->outer != DECK_NONE ? inp->outer : 0;
    if (!instance)
        inp->outer = DECK_NONE;
    return PERCUSS_OK;
}

static enum percuss_status keyword_instance(struct inp *inp, const struct card *card)
{
    const char *name = card_value(card, "NAME"), *part = card_value(card, "PART");
    if (inp->outer == DECK_NONE || inp->scope != inp->outer)
        return scan_refuse(inp->scan, "*INSTANCE: must be in an *ASSEMBLY");
    if (card_value(card, "LIBRARY"))
        return scan_refuse(inp->scan, "*INSTANCE: LIBRARY=: must be of a part of this deck");
    if ((name && !need(inp, card, "NAME")) || (part && !need(inp, card, "PART")))
        return PERCUSS_BAD_REQUEST;
    if (is_instance(inp, name ? name : "instance"))
        return scan_refuse(inp->scan, "*INSTANCE: NAME=%s: is the second of this name", name);
    enum percuss_status status = open_scope(inp, DECK_INSTANCE, name ? name : "instance");
    if (!status)
        snprintf(inp->deck.scopes[inp->scope].of, MESH_NAME_SIZE, "%s", part ? part : "");
    inp->row = 0;
    inp->read = inp_read_instance;
    return status;
}

static enum percuss_status keyword_step(struct inp *inp, const struct card *card)
{
    (void)card;
    inp->step = true;
    return PERCUSS_OK;
}

static enum percuss_status keyword_boundary(struct inp *inp, const struct card *card)
{
    (void)card;
    inp->read = inp_read_boundary;
    return PERCUSS_OK;
}

/* stresses at the beginning stiffen a body, other conditions do not matter here */
static enum percuss_status keyword_conditions(struct inp *inp, const struct card *card)
{
    const char *type = card_value(card, "TYPE");
    if (type && strncasecmp(type, "STRESS", 6) != 0 && strncasecmp(type, "PLASTIC", 7) != 0 &&
        strncasecmp(type, "HARDENING", 9) != 0)
        return PERCUSS_OK;
    return deck_tell(&inp->deck,
                     "*INITIAL CONDITIONS, TYPE=%.20s: left out: the body has no "
                     "prestress here",
                     type ? type : "")
               ? PERCUSS_OK
               : inp_out_of_memory(inp);
}

static const struct {
    const char *name;
    card_reader *read;
} CARDS[] = {{"NODE", keyword_node},
             {"ELEMENT", keyword_element},
             {"NSET", keyword_set},
             {"ELSET", keyword_set},
             {"SURFACE", keyword_surface},
             {"MATERIAL", keyword_material},
             {"ELASTIC", keyword_property},
             {"DENSITY", keyword_property},
             {"PLASTIC", keyword_property},
             {"SOLIDSECTION", keyword_section},
             {"MASS", keyword_mass},
             {"INCLUDE", read_other_file},
             {"PART", keyword_scope},
             {"ASSEMBLY", keyword_scope},
             {"ENDPART", keyword_end_scope},
             {"ENDASSEMBLY", keyword_end_scope},
             {"INSTANCE", keyword_instance},
             {"ENDINSTANCE", keyword_end_scope},
             {"STEP", keyword_step},
             {"BOUNDARY", keyword_boundary},
             {"INITIALCONDITIONS", keyword_conditions}};

/* a keyword that says nothing of nodes and elements */
static enum percuss_status read_other_card(struct inp *inp, const struct card *card)
{
    const char *meaning;
    bool told = true;
    switch (keyword_find(card->name, &meaning)) {
    case KEYWORD_REFUSED:
        return scan_refuse(inp->scan, "*%.40s: is not read: %s", card->name, meaning);
    case KEYWORD_LAW:
        return inp_material_law(&inp->material, inp->scan, card);
    case KEYWORD_TOLD:
        told = deck_tell(&inp->deck, "*%.40s (line %zu): %s", card->name, inp->scan->line, meaning);
        break;
    case KEYWORD_HARMLESS:
        break;
    case KEYWORD_UNKNOWN:
        told = deck_tell(&inp->deck, "*%.40s (line %zu): is not known here: left out", card->name,
                         inp->scan->line);
        break;
    }
    return told ? PERCUSS_OK : inp_out_of_memory(inp);
}

/* steps tell of supports and of loads before a frequency is asked for; the rest is no matter of the
 * body */
static enum percuss_status read_step_card(struct inp *inp, const struct card *card)
{
    const char *meaning;
    if (strcmp(card->name, "BOUNDARY") == 0)
        return keyword_boundary(inp, card);
    if (keyword_find_in_step(card->name, &meaning) &&
        !deck_tell(&inp->deck, "*%.40s (line %zu): %s", card->name, inp->scan->line, meaning))
        return inp_out_of_memory(inp);
    return PERCUSS_OK;
}

/* The keyword above has no unfinished element. */
static enum percuss_status end_element(const struct inp *inp)
{
    if (inp->read != inp_read_element || inp->filled == 0)
        return PERCUSS_OK;
    return scan_refuse(inp->scan, "*ELEMENT: %zu: has %zu nodes: must have more",
                       inp->element.label, inp->filled);
}

static enum percuss_status read_keyword(struct inp *inp, const struct card *card)
{
    if (inp->step)
        return read_step_card(inp, card);
    for (size_t i = 0; i < sizeof CARDS / sizeof *CARDS; i++)
        if (strcmp(card->name, CARDS[i].name) == 0)
            return CARDS[i].read(inp, card);
    return read_other_card(inp, card);
}

/* Refuses a number among the parameters, which is data, and tells of those that are not known. */
static enum percuss_status check_parameters(struct inp *inp, const struct card *card)
{
    for (int i = 0; i < card->parameter_count; i++) {
        const char *key = card->parameters[i].key;
        if (keyword_parameter(card->name, key) != PARAMETER_UNKNOWN)
            continue;
        if (!isalpha((unsigned char)*key))
            return scan_refuse(inp->scan, "*%.40s: %.60s: must be a parameter, KEY or KEY=VALUE",
                               card->name, key);
        if (!deck_tell(&inp->deck, "*%.40s (line %zu): %.60s: is no parameter known here: left out",
                       card->name, inp->scan->line, key))
            return inp_out_of_memory(inp);
    }
    return PERCUSS_OK;
}

static enum percuss_status read_card(struct inp *inp, char *line)
{
    struct card card;
    bool whole = card_parse(line, &card);
    inp->begun = true;
    if (!whole)
        return scan_refuse(inp->scan, "*%.40s: must have at most %d parameters", card.name,
                           CARD_MOST_PARAMETERS);
    enum percuss_status status = inp->step ? PERCUSS_OK : check_parameters(inp, &card);
    if (status)
        return status;
    /* lines of data may continue in and after an included file */
    bool include = !inp->step && strcmp(card.name, "INCLUDE") == 0;
    if (!include) {
        status = end_element(inp);
        if (status)
            return status;
        inp->read = NULL;
    }
    status = read_keyword(inp, &card);
    /* any keyword may have its lines of data in a file */
    return status || include || !inp->read || !card_value(&card, "INPUT")
               ? status
               : read_other_file(inp, &card);
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
    inp->file = deck_file(&inp->deck, path);
    if (inp->file == DECK_NONE)
        status = inp_out_of_memory(inp);
    while (!status && card_line(&scan, line, &status))
        status = line[0] == '*' ? read_card(inp, line)
                 : inp->read    ? inp->read(inp, line)
                 : inp->begun   ? PERCUSS_OK
                                : scan_refuse(&scan, "must begin with a keyword, such as *NODE: is "
                                                       "it a deck of Abaqus or CalculiX?");
    if (!status && inp->depth == 0)
        status = end_element(inp);
    scan_close(&scan);
    return status;
}

enum percuss_status inp_read(const char *path, double unit, const char *instance, bool raise,
                             struct solid_mesh *mesh, struct fault *fault)
{
    struct scan scan = {.file = path, .fault = fault};
    struct inp inp = {.scan = &scan,
                      .path = path,
                      .raise = raise,
                      .set = DECK_NONE,
                      .outer = DECK_NONE,
                      .instance = DECK_NONE};
    inp.material = (struct inp_material){.deck = &inp.deck, .at = DECK_NONE};
    memset(mesh, 0, sizeof *mesh);
    enum percuss_status status = open_scope(&inp, DECK_MODEL, "");
    if (status == PERCUSS_OK)
        status = read_deck(&inp, path);
    if (status == PERCUSS_OK && !deck_support_tell(&inp.deck))
        status = inp_out_of_memory(&inp);
    if (status == PERCUSS_OK)
        status = deck_body_make(&inp.deck, unit, instance, mesh, fault);
    deck_free(&inp.deck);
    return status;
}

/* `name` in the folder of `file` */
static void join_path(const char *file, const char *name, char path[INP_PATH_SIZE])
{
    const char *slash = strrchr(file, '/');
    int folder = *name != '/' && slash ? (int)(slash + 1 - file) : 0;
    snprintf(path, INP_PATH_SIZE, "%.*s%s", folder, file, name);
}

void inp_include_path(const char *deck, const char *file, const char *name,
                      char path[INP_PATH_SIZE])
{
    const char *const folders[] = {deck, file, ""};
    for (int i = 0; i < 3; i++) {
        join_path(folders[i], name, path);
        if (access(path, R_OK) == 0)
            return;
    }
    join_path(deck, name, path);
}
