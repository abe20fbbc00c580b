/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/inp.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "mesh/inp_parts.h"

typedef enum percuss_status card_reader(struct inp *inp, const struct card *card);

static enum percuss_status read_deck(struct inp *inp, const char *path);

/* a parameter that must be there; NULL after a message */
static const char *need(const struct inp *inp, const struct card *card, const char *key)
{
    const char *value = card_value(card, key);
    if (value && *value)
        return value;
    scan_refuse(inp->scan, "*%.40s: %s=: must be there", card->name, key);
    return NULL;
}

/* what stands in an assembly beside its instance belongs to no body */
static bool is_outside(const struct inp *inp)
{
    return inp->assembly && !inp->instance;
}

static enum percuss_status node(struct inp *inp, const struct card *card)
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

/* which solids are read, and which are refused and why; others only name nodes */
static enum percuss_status check_type(struct inp *inp, const char *type)
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

static enum percuss_status element(struct inp *inp, const struct card *card)
{
    const char *type = need(inp, card, "TYPE"), *set = card_value(card, "ELSET");
    if (!type)
        return PERCUSS_BAD_REQUEST;
    if (is_outside(inp))
        return PERCUSS_OK;
    enum percuss_status status = check_type(inp, type);
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

static enum percuss_status node_set(struct inp *inp, const struct card *card)
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

static enum percuss_status element_set(struct inp *inp, const struct card *card)
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

/* of elements: faces; of nodes: a set like others */
static enum percuss_status surface(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "NAME"), *type = card_value(card, "TYPE");
    if (!name)
        return PERCUSS_BAD_REQUEST;
    inp->generate = false;
    inp->set = deck_node_set(&inp->deck, name);
    inp->read = type && strcasecmp(type, "NODE") == 0 ? inp_read_node_set : inp_read_surface;
    return inp->set == SIZE_MAX ? inp_out_of_memory(inp) : PERCUSS_OK;
}

static enum percuss_status material(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "NAME");
    if (!name)
        return PERCUSS_BAD_REQUEST;
    inp->material = deck_material(&inp->deck, name);
    return inp->material == SIZE_MAX ? inp_out_of_memory(inp) : PERCUSS_OK;
}

/* *ELASTIC, *DENSITY, *PLASTIC belong to the *MATERIAL above */
static enum percuss_status property(struct inp *inp, const struct card *card)
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

static enum percuss_status section(struct inp *inp, const struct card *card)
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

void inp_beside(const char *file, const char *name, char path[INP_PATH_SIZE])
{
    const char *slash = strrchr(file, '/');
    int folder = *name != '/' && slash ? (int)(slash + 1 - file) : 0;
    snprintf(path, INP_PATH_SIZE, "%.*s%s", folder, file, name);
}

/* a file beside this one, in place of the line: its lines of data may belong to the keyword above
 */
static enum percuss_status include(struct inp *inp, const struct card *card)
{
    const char *name = need(inp, card, "INPUT");
    char path[INP_PATH_SIZE];
    if (!name)
        return PERCUSS_BAD_REQUEST;
    if (inp->depth == INP_MOST_DEPTH)
        return scan_refuse(inp->scan, "*INCLUDE: must not be more than %d deep", INP_MOST_DEPTH);
    inp_beside(inp->scan->file, name, path);
    struct scan *outer = inp->scan;
    inp->depth++;
    enum percuss_status status = read_deck(inp, path);
    inp->depth--;
    inp->scan = outer;
    return status;
}

static enum percuss_status part(struct inp *inp, const struct card *card)
{
    (void)card;
    if (++inp->parts > 1)
        return scan_refuse(inp->scan,
                           "*PART: is the second one: must be one body; export one part");
    return PERCUSS_OK;
}

static enum percuss_status assembly(struct inp *inp, const struct card *card)
{
    inp->assembly = card->name[0] == 'A';
    return PERCUSS_OK;
}

static enum percuss_status instance(struct inp *inp, const struct card *card)
{
    inp->instance = card->name[0] == 'I';
    if (inp->instance && ++inp->instances > 1)
        return scan_refuse(inp->scan,
                           "*INSTANCE: is the second one: must be one body; export one part");
    inp->read = inp->instance ? inp_read_instance : NULL;
    return PERCUSS_OK;
}

static enum percuss_status step(struct inp *inp, const struct card *card)
{
    (void)card;
    inp->done = true;
    return PERCUSS_OK;
}

/* what makes nodes and elements by rule */
static enum percuss_status refuse(struct inp *inp, const struct card *card)
{
    return scan_refuse(inp->scan,
                       "*%.40s: is not read: nodes and elements must be written out one by one",
                       card->name);
}

static const struct {
    const char *name;
    card_reader *read;
} CARDS[] = {{"NODE", node},         {"ELEMENT", element},
             {"NSET", node_set},     {"ELSET", element_set},
             {"SURFACE", surface},   {"MATERIAL", material},
             {"ELASTIC", property},  {"DENSITY", property},
             {"PLASTIC", property},  {"SOLID SECTION", section},
             {"INCLUDE", include},   {"PART", part},
             {"ASSEMBLY", assembly}, {"END ASSEMBLY", assembly},
             {"INSTANCE", instance}, {"END INSTANCE", instance},
             {"STEP", step},         {"SYSTEM", refuse},
             {"NGEN", refuse},       {"NFILL", refuse},
             {"NCOPY", refuse},      {"ELGEN", refuse},
             {"ELCOPY", refuse}};

static enum percuss_status read_card(struct inp *inp, char *line)
{
    struct card card;
    card_parse(line, &card);
    inp->begun = true;
    /* lines of data go on in and after an included file */
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

/* reads a file, the deck or one that it includes */
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
