/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/bdf.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "mesh/bdf_material.h"
#include "mesh/builder.h"
#include "mesh/element.h"
#include "mesh/grow.h"
#include "model/vector.h"

/* ---- what the cards say, until all are read ---- */

struct bdf_grid {
    size_t label, frame, line;
    const char *file;
    double point[3];          /* in its frame */
    bool own_frame, own_hold; /* its fields are not blank: GRDSET does not fill them */
};

/* A coordinate system by three points: origin, one on the z-axis, one in the half-plane of x and z.
 */
struct bdf_frame {
    size_t label, line;
    const char *file;
    char kind; /* R, C, S */
    bool by_grids;
    size_t in, grids[3]; /* points stand in this frame, or are these GRIDs */
    double points[3][3];
    bool known, busy; /* busy: on the way to be known */
    double origin[3], axes[3][3];
};

/* Directions in which an SPC holds a node, a bit each. */
struct bdf_hold {
    size_t set, node;
    unsigned directions;
};

/* SPCADD: a set has those of another. */
struct bdf_sum {
    size_t set, member;
};

/* Where a solid stands. */
struct bdf_place {
    size_t label, line;
    const char *file;
};

/* Names of cards that are not read, with the line of the first one. */
struct bdf_other {
    char name[BDF_FIELD_SIZE];
    size_t line, count;
};

struct bdf {
    struct builder builder;
    struct fault *fault;
    const char *file;
    int depth;
    size_t grid_count, grid_room, frame_count, frame_room, hold_count, hold_room, sum_count,
        sum_room;
    size_t other_count, other_room, path_count, path_room, shells;
    size_t place_count, place_room;
    struct bdf_place *places; /* of the solids */
    struct bdf_grid *grids;
    struct bdf_frame *frames;
    struct bdf_hold *holds;
    struct bdf_sum *sums;
    struct bdf_other *others;
    char **paths;     /* of the files, for messages */
    const char *path; /* of the one that is read */
    size_t frame;     /* of GRDSET, with the directions that it holds */
    unsigned directions;
    struct bdf_materials materials;
};

enum { TRANSLATIONS = 7, MOST_CHAIN = 100 };

/* more would be a file of gigabytes */
static const size_t MOST_THRU = 20000000;

static enum percuss_status bdf_out_of_memory(const struct bdf *bdf)
{
    return fault_set(bdf->fault, PERCUSS_INTERNAL, "%s: out of memory", bdf->file);
}

/* ---- cards ---- */

typedef enum percuss_status bdf_reader(struct bdf *bdf, const struct bdf_card *card);

/* "123456" as bits; false with a message */
static bool bdf_directions(const struct bdf_card *card, size_t field, unsigned *directions)
{
    const char *text = bdf_field(card, field);
    *directions = 0;
    for (const char *c = text; *c; c++) {
        if (*c < '0' || *c > '6') {
            bdf_refuse(card, "field %zu: %s: must be directions, 1 to 6", field, text);
            return false;
        }
        if (*c > '0')
            *directions |= 1u << (*c - '1');
    }
    return true;
}

static bool bdf_hold_node(struct bdf *bdf, size_t set, size_t node, unsigned directions)
{
    if (!GROW(bdf->holds, bdf->hold_count, bdf->hold_room))
        return false;
    bdf->holds[bdf->hold_count++] = (struct bdf_hold){set, node, directions};
    return true;
}

static enum percuss_status read_grid(struct bdf *bdf, const struct bdf_card *card)
{
    struct bdf_grid grid = {.line = card->line,
                            .file = bdf->path,
                            .own_frame = !bdf_is_blank(card, 3),
                            .own_hold = !bdf_is_blank(card, 8)};
    unsigned directions;
    if (!bdf_label(card, 2, &grid.label) || !bdf_size(card, 3, &grid.frame))
        return PERCUSS_BAD_REQUEST;
    for (size_t k = 0; k < 3; k++)
        if (!bdf_real(card, 4 + k, &grid.point[k]))
            return PERCUSS_BAD_REQUEST;
    if (!bdf_directions(card, 8, &directions))
        return PERCUSS_BAD_REQUEST;
    if (!GROW(bdf->grids, bdf->grid_count, bdf->grid_room) ||
        ((directions & TRANSLATIONS) && !bdf_hold_node(bdf, 0, grid.label, directions)))
        return bdf_out_of_memory(bdf);
    bdf->grids[bdf->grid_count++] = grid;
    return PERCUSS_OK;
}

/* what blank fields of all GRIDs mean */
static enum percuss_status read_grdset(struct bdf *bdf, const struct bdf_card *card)
{
    return bdf_size(card, 3, &bdf->frame) && bdf_directions(card, 8, &bdf->directions)
               ? PERCUSS_OK
               : PERCUSS_BAD_REQUEST;
}

static enum percuss_status add_frame(struct bdf *bdf, const struct bdf_card *card,
                                     struct bdf_frame *frame)
{
    frame->kind = card->name[5];
    frame->line = card->line;
    frame->file = bdf->path;
    if (!GROW(bdf->frames, bdf->frame_count, bdf->frame_room))
        return bdf_out_of_memory(bdf);
    bdf->frames[bdf->frame_count++] = *frame;
    return PERCUSS_OK;
}

/* CORD1R, C, S: one or two systems by three GRIDs each */
static enum percuss_status read_frame_of_grids(struct bdf *bdf, const struct bdf_card *card)
{
    enum percuss_status status = PERCUSS_OK;
    for (size_t at = 2; status == PERCUSS_OK && at <= 6; at += 4) {
        struct bdf_frame frame = {.by_grids = true};
        if (at > 2 && bdf_is_blank(card, at))
            break;
        if (!bdf_label(card, at, &frame.label))
            return PERCUSS_BAD_REQUEST;
        for (size_t k = 0; k < 3; k++)
            if (!bdf_label(card, at + 1 + k, &frame.grids[k]))
                return PERCUSS_BAD_REQUEST;
        status = add_frame(bdf, card, &frame);
    }
    return status;
}

/* CORD2R, C, S: one system by three points in another one */
static enum percuss_status read_frame_of_points(struct bdf *bdf, const struct bdf_card *card)
{
    struct bdf_frame frame = {0};
    if (!bdf_label(card, 2, &frame.label) || !bdf_size(card, 3, &frame.in))
        return PERCUSS_BAD_REQUEST;
    for (size_t k = 0; k < 9; k++)
        if (!bdf_real(card, 4 + k, &frame.points[k / 3][k % 3]))
            return PERCUSS_BAD_REQUEST;
    return add_frame(bdf, card, &frame);
}

/* Solids by the second letter of their cards, with the card's node of each node in Gmsh's order
 * (MSC Nastran Quick Reference Guide: mid nodes of the first face, of the edges between the faces,
 * of the other face, each in turn). */
static const struct bdf_solid {
    char letter;
    enum element_type type;
    size_t corners, nodes;
    const char *name; /* by which preprocessors know it */
    unsigned char order[20];
} SOLIDS[] = {
    {'T', ELEMENT_TET10, 4, 10, "Tet10", {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
    {'P', ELEMENT_WEDGE15, 6, 15, "Wedge15", {0, 1, 2, 3, 4, 5, 6, 8, 9, 7, 10, 11, 12, 14, 13}},
    {'H', ELEMENT_HEX20, 8, 20, "Hex20", {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                          12, 9, 13, 10, 14, 15, 16, 19, 17, 18}}};

static const struct bdf_solid *find_solid(const struct bdf_card *card)
{
    const struct bdf_solid *solid = SOLIDS;
    while (solid->letter != card->name[1])
        solid++;
    return solid;
}

/* the nodes of the card, the number of mid nodes that it has */
static bool read_solid_nodes(const struct bdf_card *card, const struct bdf_solid *solid,
                             size_t *nodes, size_t *middles)
{
    *middles = 0;
    for (size_t i = 0; i < solid->nodes; i++) {
        nodes[i] = 0;
        if (!(i < solid->corners ? bdf_label(card, 4 + i, &nodes[i])
                                 : bdf_size(card, 4 + i, &nodes[i])))
            return false;
        *middles += i >= solid->corners && nodes[i] > 0;
    }
    for (size_t field = 4 + solid->nodes; field < card->count + 2; field++)
        if (!bdf_is_blank(card, field)) {
            bdf_refuse(card, "%s: has more than %zu nodes (%s)", bdf_field(card, 2), solid->nodes,
                       bdf_field(card, field));
            return false;
        }
    return true;
}

static enum percuss_status check_middles(const struct bdf *bdf, const struct bdf_card *card,
                                         const struct bdf_solid *solid, size_t middles)
{
    size_t all = solid->nodes - solid->corners;
    if (middles == all || bdf->builder.raise)
        return PERCUSS_OK;
    if (middles > 0)
        return bdf_refuse(card,
                          "%s: has %zu of %zu mid nodes: must have all (--raise puts the others in "
                          "the middle of their edges)",
                          bdf_field(card, 2), middles, all);
    return bdf_refuse(card,
                      "%s: has %zu nodes: must be of second order, %zu nodes, as linear ones are "
                      "too stiff (first frequency 4 to 15 %% high): mesh with mid-side nodes "
                      "(%s) and export again, or raise them by --raise",
                      bdf_field(card, 2), solid->corners, solid->nodes, solid->name);
}

static enum percuss_status read_solid(struct bdf *bdf, const struct bdf_card *card)
{
    const struct bdf_solid *solid = find_solid(card);
    size_t label, nodes[20], ordered[20], middles;
    if (!bdf_label(card, 2, &label))
        return PERCUSS_BAD_REQUEST;
    size_t property = label;
    if (!bdf_size(card, 3, &property) || !read_solid_nodes(card, solid, nodes, &middles))
        return PERCUSS_BAD_REQUEST;
    enum percuss_status status = check_middles(bdf, card, solid, middles);
    if (status != PERCUSS_OK)
        return status;
    for (size_t i = 0; i < solid->nodes; i++) {
        size_t node = nodes[solid->order[i]];
        ordered[i] = node > 0 ? node : BUILDER_MIDDLE;
    }
    size_t part = bdf_property_part(&bdf->builder, property);
    if (part == SIZE_MAX || !GROW(bdf->places, bdf->place_count, bdf->place_room) ||
        !builder_add_element(&bdf->builder, solid->type, label, part, ordered))
        return bdf_out_of_memory(bdf);
    bdf->places[bdf->place_count++] = (struct bdf_place){label, card->line, bdf->path};
    return PERCUSS_OK;
}

/* the set of a kind and number */
static size_t numbered_set(struct bdf *bdf, const char *kind, size_t number)
{
    char name[MESH_NAME_SIZE];
    snprintf(name, sizeof name, "%s %zu", kind, number);
    return builder_set(&bdf->builder, name);
}

/* CTRIA3, CTRIA6, CQUAD8; CTRIAR and CQUADR have corners only */
static size_t shell_nodes(const char *name)
{
    char last = name[strlen(name) - 1];
    return last == '6' ? 6 : last == '8' ? 8 : name[1] == 'T' ? 3 : 4;
}

/* shells name nodes only */
static enum percuss_status read_shell(struct bdf *bdf, const struct bdf_card *card)
{
    size_t label;
    if (!bdf_label(card, 2, &label))
        return PERCUSS_BAD_REQUEST;
    size_t property = label;
    if (!bdf_size(card, 3, &property))
        return PERCUSS_BAD_REQUEST;
    size_t set = numbered_set(bdf, "PSHELL", property);
    if (set == SIZE_MAX)
        return bdf_out_of_memory(bdf);
    for (size_t i = 0; i < shell_nodes(card->name); i++) {
        size_t node = 0;
        if (!bdf_size(card, 4 + i, &node))
            return PERCUSS_BAD_REQUEST;
        if (node > 0 && !builder_append(&bdf->builder.sets[set].labels, node))
            return bdf_out_of_memory(bdf);
    }
    bdf->shells++;
    return PERCUSS_OK;
}

/* Calls `add` for each node of a list from `field` on: numbers, A THRU B; ends at a number with a
 * point. */
static enum percuss_status
each_node(struct bdf *bdf, const struct bdf_card *card, size_t field,
          bool (*add)(struct bdf *bdf, const size_t what[2], size_t node), const size_t what[2])
{
    size_t before = 0, node;
    for (; field < card->count + 2 && !strchr(bdf_field(card, field), '.'); field++) {
        bool thru = strcmp(bdf_field(card, field), "THRU") == 0 ||
                    strcmp(bdf_field(card, field), "thru") == 0;
        if (bdf_is_blank(card, field))
            continue;
        if (!bdf_label(card, field + thru, &node))
            return PERCUSS_BAD_REQUEST;
        if (thru && (before == 0 || node < before || node - before > MOST_THRU))
            return bdf_refuse(card, "%zu THRU %zu: must be two numbers, the smaller first", before,
                              node);
        for (size_t i = thru ? before + 1 : node; i <= node; i++)
            if (!add(bdf, what, i))
                return bdf_out_of_memory(bdf);
        field += thru;
        before = node;
    }
    return PERCUSS_OK;
}

static bool add_held(struct bdf *bdf, const size_t what[2], size_t node)
{
    return bdf_hold_node(bdf, what[0], node, (unsigned)what[1]);
}

static bool add_named(struct bdf *bdf, const size_t what[2], size_t node)
{
    return builder_append(&bdf->builder.sets[what[0]].labels, node);
}

static bool add_sum(struct bdf *bdf, const size_t what[2], size_t member)
{
    if (!GROW(bdf->sums, bdf->sum_count, bdf->sum_room))
        return false;
    bdf->sums[bdf->sum_count++] = (struct bdf_sum){what[0], member};
    return true;
}

/* SPC1: set, directions, nodes */
static enum percuss_status read_spc1(struct bdf *bdf, const struct bdf_card *card)
{
    size_t what[2];
    unsigned directions;
    if (!bdf_label(card, 2, &what[0]) || !bdf_directions(card, 3, &directions))
        return PERCUSS_BAD_REQUEST;
    what[1] = directions;
    return each_node(bdf, card, 4, add_held, what);
}

/* SPC: set, then twice node, directions, displacement */
static enum percuss_status read_spc(struct bdf *bdf, const struct bdf_card *card)
{
    size_t set, node;
    unsigned directions;
    if (!bdf_label(card, 2, &set))
        return PERCUSS_BAD_REQUEST;
    for (size_t at = 3; at <= 6; at += 3) {
        if (bdf_is_blank(card, at))
            continue;
        if (!bdf_label(card, at, &node) || !bdf_directions(card, at + 1, &directions))
            return PERCUSS_BAD_REQUEST;
        if (!bdf_hold_node(bdf, set, node, directions))
            return bdf_out_of_memory(bdf);
    }
    return PERCUSS_OK;
}

static enum percuss_status read_spcadd(struct bdf *bdf, const struct bdf_card *card)
{
    size_t what[2] = {0};
    return bdf_label(card, 2, &what[0]) ? each_node(bdf, card, 3, add_sum, what)
                                        : PERCUSS_BAD_REQUEST;
}

/* a name of a card that is not read, for the note */
static enum percuss_status count_other(struct bdf *bdf, const struct bdf_card *card)
{
    for (size_t i = 0; i < bdf->other_count; i++)
        if (strcmp(bdf->others[i].name, card->name) == 0) {
            bdf->others[i].count++;
            return PERCUSS_OK;
        }
    if (!GROW(bdf->others, bdf->other_count, bdf->other_room))
        return bdf_out_of_memory(bdf);
    struct bdf_other *other = &bdf->others[bdf->other_count++];
    *other = (struct bdf_other){.line = card->line, .count = 1};
    memcpy(other->name, card->name, sizeof other->name);
    return PERCUSS_OK;
}

/* RBE2: its dependent nodes have a name; it is no part of the body */
static enum percuss_status read_rbe2(struct bdf *bdf, const struct bdf_card *card)
{
    size_t label, what[2] = {0};
    if (!bdf_label(card, 2, &label))
        return PERCUSS_BAD_REQUEST;
    what[0] = numbered_set(bdf, "RBE2", label);
    if (what[0] == SIZE_MAX)
        return bdf_out_of_memory(bdf);
    enum percuss_status status = each_node(bdf, card, 5, add_named, what);
    return status == PERCUSS_OK ? count_other(bdf, card) : status;
}

/* CONM2: label, node, the system of its offset, mass, offset; its inertia. A node of a solid does
 * not turn: an offset would be of no use. */
static enum percuss_status read_mass(struct bdf *bdf, const struct bdf_card *card)
{
    size_t node;
    double mass = 0.0, offset[3] = {0.0, 0.0, 0.0}, inertia = 0.0;
    if (!bdf_label(card, 3, &node) || !bdf_real(card, 5, &mass))
        return PERCUSS_BAD_REQUEST;
    for (size_t k = 0; k < 3; k++)
        if (!bdf_real(card, 6 + k, &offset[k]))
            return PERCUSS_BAD_REQUEST;
    for (size_t k = 0; k < 6 && inertia == 0.0; k++)
        if (!bdf_real(card, 10 + k, &inertia))
            return PERCUSS_BAD_REQUEST;
    if (!(mass >= 0.0 && isfinite(mass)))
        return bdf_refuse(card, "%s: %g: must be a finite mass >= 0", bdf_field(card, 2), mass);
    if (norm3(offset) != 0.0 || bdf_field(card, 4)[0] == '-')
        return builder_remark(&bdf->builder,
                              "CONM2 %s: its mass has an offset from its node: left out: the body "
                              "here is lighter by it",
                              bdf_field(card, 2))
                   ? PERCUSS_OK
                   : bdf_out_of_memory(bdf);
    if (inertia != 0.0 &&
        !builder_remark(&bdf->builder,
                        "CONM2 %s: its inertia is left out: masses on nodes have none here",
                        bdf_field(card, 2)))
        return bdf_out_of_memory(bdf);
    return mass == 0.0 || builder_add_mass(&bdf->builder, node, mass) ? PERCUSS_OK
                                                                      : bdf_out_of_memory(bdf);
}

static enum percuss_status read_property(struct bdf *bdf, const struct bdf_card *card)
{
    return bdf_property_read(&bdf->materials, card, bdf->path);
}

static enum percuss_status read_material(struct bdf *bdf, const struct bdf_card *card)
{
    return bdf_material_read(&bdf->materials, card, bdf->path);
}

static enum percuss_status read_parameter(struct bdf *bdf, const struct bdf_card *card)
{
    return bdf_parameter_read(&bdf->materials, card);
}

/* cards that make a mesh of something else, so that passing them over would change the body */
static enum percuss_status refuse_card(struct bdf *bdf, const struct bdf_card *card)
{
    (void)bdf;
    return bdf_refuse(card, "is not read: must be GRID, CORD1R to CORD2S, CTETRA of 10, CPENTA of "
                            "15 or CHEXA of 20 nodes");
}

static const struct {
    const char *name;
    bdf_reader *read;
} CARDS[] = {{"GRID", read_grid},
             {"GRDSET", read_grdset},
             {"CORD1R", read_frame_of_grids},
             {"CORD1C", read_frame_of_grids},
             {"CORD1S", read_frame_of_grids},
             {"CORD2R", read_frame_of_points},
             {"CORD2C", read_frame_of_points},
             {"CORD2S", read_frame_of_points},
             {"CTETRA", read_solid},
             {"CHEXA", read_solid},
             {"CPENTA", read_solid},
             {"CTETRA_", read_solid}, /* as meshio writes them */
             {"CHEXA_", read_solid},
             {"CPENTA_", read_solid},
             {"CTRIA3", read_shell},
             {"CTRIA6", read_shell},
             {"CTRIAR", read_shell},
             {"CQUAD4", read_shell},
             {"CQUAD8", read_shell},
             {"CQUADR", read_shell},
             {"SPC1", read_spc1},
             {"SPC", read_spc},
             {"SPCADD", read_spcadd},
             {"RBE2", read_rbe2},
             {"CONM2", read_mass},
             {"PSOLID", read_property},
             {"MAT1", read_material},
             {"PARAM", read_parameter},
             {"CORD3G", refuse_card},
             {"CORD1RX", refuse_card},
             {"CORD2RX", refuse_card},
             {"CORD3R", refuse_card},
             {"CPYRAM", refuse_card},
             {"CPYRA", refuse_card},
             {"CTETRA1", refuse_card},
             {"CHEXA1", refuse_card},
             {"CHEXA2", refuse_card},
             {"CHEXA8", refuse_card},
             {"CHEXA20", refuse_card},
             {"CHEXAN", refuse_card},
             {"GRIDB", refuse_card},
             {"GRIDG", refuse_card},
             {"EGRID", refuse_card},
             {"CGEN", refuse_card},
             {"SPCG", refuse_card},
             {"BEGIN", refuse_card},
             {"=", refuse_card}};

static enum percuss_status read_card(struct bdf *bdf, const struct bdf_card *card)
{
    for (size_t i = 0; i < sizeof CARDS / sizeof *CARDS; i++)
        if (strcmp(card->name, CARDS[i].name) == 0)
            return CARDS[i].read(bdf, card);
    return card->name[0] == '=' ? refuse_card(bdf, card) : count_other(bdf, card);
}

/* ---- files ---- */

static enum percuss_status read_bdf_file(struct bdf *bdf, const char *path, enum bdf_start start,
                                         bool *begun);

/* reads a file in place of the line that includes it */
static enum percuss_status include_file(struct bdf *bdf, struct bdf_lines *lines,
                                        const struct bdf_card *card)
{
    char path[BDF_PATH_SIZE];
    if (bdf->depth == BDF_MOST_DEPTH)
        return bdf_refuse(card, "must not be more than %d deep", BDF_MOST_DEPTH);
    enum percuss_status status = bdf_include(lines, path);
    if (status != PERCUSS_OK)
        return status;
    if (access(path, R_OK) != 0)
        return bdf_refuse(card, "%s: %s", path, strerror(errno));
    enum bdf_start start = lines->alone ? BDF_WHOLE : lines->bulk ? BDF_BULK : BDF_CONTROL;
    bool begun = false;
    bdf->depth++;
    status = read_bdf_file(bdf, path, start, &begun);
    bdf->depth--;
    /* BEGIN BULK of a head counts for the file that includes it */
    lines->alone = lines->alone && !begun;
    lines->bulk = lines->bulk || begun;
    return status;
}

/* the path stays for messages about what is read */
static bool keep_path(struct bdf *bdf, const char *path)
{
    if (!GROW(bdf->paths, bdf->path_count, bdf->path_room))
        return false;
    bdf->paths[bdf->path_count] = strdup(path);
    return bdf->paths[bdf->path_count] && ++bdf->path_count;
}

/* *begun: the file has BEGIN BULK, or one that it includes */
static enum percuss_status read_bdf_file(struct bdf *bdf, const char *path, enum bdf_start start,
                                         bool *begun)
{
    struct bdf_lines lines;
    struct bdf_card card = {0};
    const char *outer = bdf->path;
    if (!keep_path(bdf, path))
        return bdf_out_of_memory(bdf);
    bdf->path = bdf->paths[bdf->path_count - 1];
    enum percuss_status status = bdf_open(&lines, path, start, bdf->fault);
    if (status != PERCUSS_OK)
        return status;
    while (bdf_next(&lines, &card, &status)) {
        status = strcmp(card.name, "INCLUDE") == 0 ? include_file(bdf, &lines, &card)
                                                   : read_card(bdf, &card);
        if (status != PERCUSS_OK)
            break;
    }
    *begun = lines.bulk && !lines.alone;
    bdf->path = outer;
    bdf_card_free(&card);
    scan_close(&lines.scan);
    return status;
}

static void bdf_free(struct bdf *bdf)
{
    builder_free(&bdf->builder);
    free(bdf->places);
    free(bdf->grids);
    free(bdf->frames);
    bdf_materials_free(&bdf->materials);
    free(bdf->holds);
    free(bdf->sums);
    free(bdf->others);
    for (size_t i = 0; i < bdf->path_count; i++)
        free(bdf->paths[i]);
    free(bdf->paths);
}

/* ---- coordinate systems ---- */

static int compare_grids(const void *left, const void *right)
{
    const struct bdf_grid *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

static int compare_frames(const void *left, const void *right)
{
    const struct bdf_frame *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

static struct bdf_frame *find_frame(struct bdf *bdf, size_t label)
{
    struct bdf_frame key = {.label = label};
    return bdf->frame_count
               ? bsearch(&key, bdf->frames, bdf->frame_count, sizeof key, compare_frames)
               : NULL;
}

/* a point of a known frame in the basic one; angles are in degrees, a sphere's the one from z first
 */
static void frame_place(const struct bdf_frame *frame, const double point[3], double place[3])
{
    double degree = M_PI / 180.0, local[3] = {point[0], point[1], point[2]};
    if (frame->kind == 'C') {
        local[0] = point[0] * cos(degree * point[1]);
        local[1] = point[0] * sin(degree * point[1]);
    } else if (frame->kind == 'S') {
        double across = point[0] * sin(degree * point[1]);
        local[0] = across * cos(degree * point[2]);
        local[1] = across * sin(degree * point[2]);
        local[2] = point[0] * cos(degree * point[1]);
    }
    memcpy(place, frame->origin, sizeof frame->origin);
    for (int k = 0; k < 3; k++)
        add_scaled3(local[k], frame->axes[k], place);
}

static enum percuss_status know_frame(struct bdf *bdf, struct bdf_frame *frame, int depth);

/* a point in a frame by its number, 0 the basic one; `subject` names who asks */
static enum percuss_status place_point(struct bdf *bdf, size_t label, const double point[3],
                                       int depth, const char *subject, double place[3])
{
    memcpy(place, point, 3 * sizeof *place);
    if (label == 0)
        return PERCUSS_OK;
    struct bdf_frame *frame = find_frame(bdf, label);
    if (!frame)
        return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                         "%s: coordinate system %zu: must be one of the file's (CORD1R, CORD2R, "
                         "CORD2C, ...)",
                         subject, label);
    enum percuss_status status = know_frame(bdf, frame, depth + 1);
    if (status == PERCUSS_OK)
        frame_place(frame, point, place);
    return status;
}

static enum percuss_status place_grid(struct bdf *bdf, const struct bdf_grid *grid, int depth,
                                      double place[3])
{
    char subject[BDF_PATH_SIZE + 64];
    snprintf(subject, sizeof subject, "%s:%zu: GRID %zu", grid->file, grid->line, grid->label);
    return place_point(bdf, grid->own_frame ? grid->frame : bdf->frame, grid->point, depth, subject,
                       place);
}

/* the three points of a frame */
static enum percuss_status place_frame_points(struct bdf *bdf, const struct bdf_frame *frame,
                                              int depth, const char *subject, double points[3][3])
{
    enum percuss_status status = PERCUSS_OK;
    for (int i = 0; i < 3 && status == PERCUSS_OK; i++) {
        if (!frame->by_grids) {
            status = place_point(bdf, frame->in, frame->points[i], depth, subject, points[i]);
            continue;
        }
        struct bdf_grid key = {.label = frame->grids[i]};
        const struct bdf_grid *grid =
            bdf->grid_count ? bsearch(&key, bdf->grids, bdf->grid_count, sizeof key, compare_grids)
                            : NULL;
        if (!grid)
            return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                             "%s: GRID %zu: must be one of the file's", subject, frame->grids[i]);
        status = place_grid(bdf, grid, depth, points[i]);
    }
    return status;
}

/* origin and axes of a frame from those that it stands in */
static enum percuss_status know_frame(struct bdf *bdf, struct bdf_frame *frame, int depth)
{
    char subject[BDF_PATH_SIZE + 64];
    double points[3][3], *x = frame->axes[0], *y = frame->axes[1], *z = frame->axes[2];
    if (frame->known)
        return PERCUSS_OK;
    snprintf(subject, sizeof subject, "%s:%zu: CORD%c%c %zu", frame->file, frame->line,
             frame->by_grids ? '1' : '2', frame->kind, frame->label);
    if (frame->busy || depth > MOST_CHAIN)
        return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                         "%s: stands in itself, or in more than %d "
                         "others",
                         subject, MOST_CHAIN);
    frame->busy = true;
    enum percuss_status status = place_frame_points(bdf, frame, depth, subject, points);
    frame->busy = false;
    if (status != PERCUSS_OK)
        return status;
    memcpy(frame->origin, points[0], sizeof frame->origin);
    sub3(points[1], points[0], z);
    sub3(points[2], points[0], x);
    cross3(z, x, y);
    if (!(norm3(y) > 1e-9 * norm3(z) * norm3(x)))
        return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                         "%s: its three points must not lie on a line", subject);
    scale3(1.0 / norm3(z), z, z);
    scale3(1.0 / norm3(y), y, y);
    cross3(y, z, x);
    frame->known = true;
    return PERCUSS_OK;
}

/* a GRID that is there again must be in the same place; `grid` follows its like */
static enum percuss_status check_same(const struct bdf *bdf, const struct bdf_grid *grid,
                                      const double before[3], const double place[3])
{
    const struct bdf_grid *other = grid - 1;
    if (before[0] == place[0] && before[1] == place[1] && before[2] == place[2])
        return PERCUSS_OK;
    return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                     "%s:%zu: GRID %zu: is at %g, %g, %g and by %s:%zu at %g, %g, %g: each must "
                     "have a number of its own",
                     grid->file, grid->line, grid->label, place[0], place[1], place[2], other->file,
                     other->line, before[0], before[1], before[2]);
}

static int compare_places(const void *left, const void *right)
{
    const struct bdf_place *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

/* each solid must have a label of its own */
static enum percuss_status check_labels(struct bdf *bdf)
{
    if (bdf->place_count)
        qsort(bdf->places, bdf->place_count, sizeof *bdf->places, compare_places);
    for (size_t i = 1; i < bdf->place_count; i++) {
        const struct bdf_place *a = &bdf->places[i - 1], *b = a + 1;
        if (a->label == b->label)
            return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                             "%s:%zu: element %zu: is also at %s:%zu: each must have a number of "
                             "its own",
                             b->file, b->line, b->label, a->file, a->line);
    }
    return PERCUSS_OK;
}

/* GRIDs as nodes in the basic frame */
static enum percuss_status place_grids(struct bdf *bdf)
{
    if (bdf->grid_count)
        qsort(bdf->grids, bdf->grid_count, sizeof *bdf->grids, compare_grids);
    if (bdf->frame_count)
        qsort(bdf->frames, bdf->frame_count, sizeof *bdf->frames, compare_frames);
    for (size_t i = 1; i < bdf->frame_count; i++)
        if (bdf->frames[i].label == bdf->frames[i - 1].label)
            return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                             "%s:%zu: coordinate system %zu: is there twice", bdf->frames[i].file,
                             bdf->frames[i].line, bdf->frames[i].label);
    double place[3], before[3] = {0};
    for (size_t i = 0; i < bdf->grid_count; i++) {
        const struct bdf_grid *grid = &bdf->grids[i];
        enum percuss_status status = place_grid(bdf, grid, 0, place);
        if (status == PERCUSS_OK && i > 0 && grid[-1].label == grid->label)
            status = check_same(bdf, grid, before, place);
        if (status != PERCUSS_OK)
            return status;
        memcpy(before, place, sizeof before);
        if (!builder_add_node(&bdf->builder, grid->label, place) ||
            (!grid->own_hold && (bdf->directions & TRANSLATIONS) &&
             !bdf_hold_node(bdf, 0, grid->label, bdf->directions)))
            return bdf_out_of_memory(bdf);
    }
    return PERCUSS_OK;
}

/* ---- sets and notes ---- */

static int compare_holds(const void *left, const void *right)
{
    const struct bdf_hold *a = left, *b = right;
    if (a->set != b->set)
        return a->set < b->set ? -1 : 1;
    return a->node < b->node ? -1 : a->node > b->node;
}

/* a set has what its members hold, once, as MSC's sums do */
static bool add_sums(struct bdf *bdf)
{
    size_t count = bdf->hold_count;
    for (size_t s = 0; s < bdf->sum_count; s++)
        for (size_t i = 0; i < count; i++)
            if (bdf->holds[i].set == bdf->sums[s].member &&
                !bdf_hold_node(bdf, bdf->sums[s].set, bdf->holds[i].node, bdf->holds[i].directions))
                return false;
    return true;
}

/* one set, from `first` to `end`: it has a name if it holds all its nodes in all directions, as
 * --fixed does */
static bool name_held(struct bdf *bdf, size_t first, size_t end)
{
    size_t label = bdf->holds[first].set;
    char name[MESH_NAME_SIZE] = "GRID PS";
    if (label > 0)
        snprintf(name, sizeof name, "SPC %zu", label);
    for (size_t i = first, next; i < end; i = next) {
        unsigned directions = 0;
        for (next = i; next < end && bdf->holds[next].node == bdf->holds[i].node; next++)
            directions |= bdf->holds[next].directions;
        if ((directions & TRANSLATIONS) != TRANSLATIONS)
            return builder_remark(
                &bdf->builder,
                "%s holds node %zu in some directions alone, which --fixed cannot: "
                "this set is not taken",
                name, bdf->holds[i].node);
    }
    size_t set = builder_set(&bdf->builder, name);
    for (size_t i = first; i < end && set != SIZE_MAX; i++)
        if (!builder_append(&bdf->builder.sets[set].labels, bdf->holds[i].node))
            return false;
    return set != SIZE_MAX &&
           builder_remark(&bdf->builder, "%s is not held here: --fixed '%s' holds it", name, name);
}

static bool name_all_held(struct bdf *bdf)
{
    if (!add_sums(bdf))
        return false;
    if (bdf->hold_count)
        qsort(bdf->holds, bdf->hold_count, sizeof *bdf->holds, compare_holds);
    for (size_t first = 0, end; first < bdf->hold_count; first = end) {
        for (end = first; end < bdf->hold_count && bdf->holds[end].set == bdf->holds[first].set;)
            end++;
        if (!name_held(bdf, first, end))
            return false;
    }
    return true;
}

/* names of the cards that are not read, with the line of the first one of each */
static void name_others(const struct bdf *bdf, char names[MESH_REMARK_SIZE])
{
    size_t filled = 0, i = 0;
    names[0] = '\0';
    for (; i < bdf->other_count && filled < MESH_REMARK_SIZE - 100; i++)
        filled += (size_t)snprintf(names + filled, MESH_REMARK_SIZE - filled, "%s%s (line %zu)",
                                   i ? ", " : "", bdf->others[i].name, bdf->others[i].line);
    if (i < bdf->other_count)
        snprintf(names + filled, MESH_REMARK_SIZE - filled, " and more");
}

static bool remark_others(struct bdf *bdf)
{
    char names[MESH_REMARK_SIZE];
    name_others(bdf, names);
    return bdf->other_count == 0 ||
           builder_remark(&bdf->builder, "cards that are not read, and no part of the body: %s",
                          names);
}

/* no solid: what the file has instead */
static enum percuss_status check_solids(const struct bdf *bdf)
{
    char names[MESH_REMARK_SIZE];
    if (bdf->builder.element_count > 0)
        return PERCUSS_OK;
    if (bdf->shells > 0)
        return fault_set(
            bdf->fault, PERCUSS_BAD_REQUEST,
            "%s: has %zu shells (CQUAD4, CTRIA3, ...) and no solid: mesh the volume "
            "with CTETRA of 10, CPENTA of 15 or CHEXA of 20 nodes, or give the part as STEP",
            bdf->file, bdf->shells);
    if (bdf->grid_count == 0 && bdf->other_count == 0)
        return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                         "%s: no cards of bulk data: must have BEGIN BULK, then GRID, CTETRA, "
                         "CPENTA or CHEXA, PSOLID, MAT1",
                         bdf->file);
    name_others(bdf, names);
    return fault_set(bdf->fault, PERCUSS_BAD_REQUEST,
                     "%s: no solid elements: must have CTETRA of 10, CPENTA of 15 or CHEXA of 20 "
                     "nodes%s%s",
                     bdf->file, names[0] ? "; cards that are not read: " : "", names);
}

enum percuss_status bdf_read(const char *path, double unit, bool raise, struct solid_mesh *mesh,
                             struct fault *fault)
{
    struct bdf bdf = {.fault = fault, .file = path, .materials = {.mass_factor = 1.0}};
    bdf.builder.raise = raise;
    memset(mesh, 0, sizeof *mesh);
    bool begun;
    enum percuss_status status = read_bdf_file(&bdf, path, BDF_WHOLE, &begun);
    if (status == PERCUSS_OK)
        status = check_solids(&bdf);
    if (status == PERCUSS_OK)
        status = check_labels(&bdf);
    if (status == PERCUSS_OK)
        status = place_grids(&bdf);
    if (status == PERCUSS_OK)
        status = bdf_materials_give(&bdf.materials, unit, &bdf.builder, fault);
    if (status == PERCUSS_OK && !(name_all_held(&bdf) && remark_others(&bdf)))
        status = bdf_out_of_memory(&bdf);
    for (size_t i = 0; i < bdf.builder.mass_count; i++)
        bdf.builder.masses[i].mass *= bdf.materials.mass_factor;
    if (status == PERCUSS_OK)
        status = builder_finish(&bdf.builder, path, unit, mesh, fault);
    bdf_free(&bdf);
    return status;
}
