/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/deck_element.h"

#include <string.h>

#include "mesh/builder.h"
#include "mesh/element.h"

/* the deck's node of each node in Gmsh's order: Abaqus Elements Reference, 28.1.4 */
static const unsigned char TET_ORDER[10] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
static const unsigned char WEDGE_ORDER[15] = {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10};
static const unsigned char HEX_ORDER[20] = {0,  1, 2,  3,  4,  5,  6,  7,  8,  11,
                                            16, 9, 17, 10, 18, 19, 12, 15, 13, 14};

/* faces in the deck's order of nodes: corners, then mid nodes */
static const unsigned char TET_FACES[4][6] = {
    {0, 1, 2, 4, 5, 6}, {0, 3, 1, 7, 8, 4}, {1, 3, 2, 8, 9, 5}, {2, 3, 0, 9, 7, 6}};
static const unsigned char WEDGE_FACES[5][8] = {{0, 1, 2, 6, 7, 8},
                                                {3, 4, 5, 9, 10, 11},
                                                {0, 1, 4, 3, 6, 13, 9, 12},
                                                {1, 2, 5, 4, 7, 14, 10, 13},
                                                {2, 0, 3, 5, 8, 12, 11, 14}};
static const unsigned char HEX_FACES[6][8] = {
    {0, 1, 2, 3, 8, 9, 10, 11},  {4, 7, 6, 5, 15, 14, 13, 12}, {0, 4, 5, 1, 16, 12, 17, 8},
    {1, 5, 6, 2, 17, 13, 18, 9}, {2, 6, 7, 3, 18, 14, 19, 10}, {3, 7, 4, 0, 19, 15, 16, 11}};

size_t deck_element_nodes(enum deck_element_kind kind)
{
    static const size_t COUNTS[] = {10, 15, 20, 4, 6, 8, 0};
    return COUNTS[kind];
}

/* the kind of second order, of a solid */
static enum deck_element_kind raised(enum deck_element_kind kind)
{
    return kind < DECK_C3D4 ? kind : kind - DECK_C3D4 + DECK_C3D10;
}

size_t deck_element_face(enum deck_element_kind kind, int face, const unsigned char **nodes)
{
    static const int MOST[] = {4, 5, 6};
    enum deck_element_kind whole = raised(kind);
    if (kind == DECK_OTHER || face < 1 || face > MOST[whole])
        return 0;
    if (whole == DECK_C3D10)
        *nodes = TET_FACES[face - 1];
    else if (whole == DECK_C3D15)
        *nodes = WEDGE_FACES[face - 1];
    else
        *nodes = HEX_FACES[face - 1];
    size_t corners = whole == DECK_C3D10 || (whole == DECK_C3D15 && face < 3) ? 3 : 4;
    return whole == kind ? 2 * corners : corners;
}

/* ---- bricks with a face that is a line or a point ---- */

/* The node of a brick at natural coordinates of -1, 0, 1. */
static size_t hex_node_at(const int at[3])
{
    for (size_t n = 0; n < 20; n++) {
        double place[3];
        element_node(ELEMENT_HEX20, n, place);
        if (place[0] == at[0] && place[1] == at[1] && place[2] == at[2])
            return n;
    }
    return 0;
}

/* The brick (Gmsh's order) with its natural axes turned: new axis k is the old one axes[k] % 3,
 * reversed from 3 on. False: that would mirror it. */
static bool turn_brick(const int axes[3], const size_t *nodes, size_t turned[20])
{
    int sign = 1;
    for (int k = 0; k < 3; k++)
        sign *= axes[k] < 3 ? 1 : -1;
    bool even = (axes[1] % 3 - axes[0] % 3 + 3) % 3 == 1;
    if ((even ? 1 : -1) * sign < 0)
        return false;
    for (size_t n = 0; n < 20; n++) {
        double place[3];
        int at[3];
        element_node(ELEMENT_HEX20, n, place);
        for (int k = 0; k < 3; k++)
            at[axes[k] % 3] = (int)place[k] * (axes[k] < 3 ? 1 : -1);
        turned[n] = nodes[hex_node_at(at)];
    }
    return true;
}

static bool all_apart(const size_t *nodes, size_t count, size_t *twice)
{
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (nodes[i] == nodes[j]) {
                *twice = nodes[i];
                return false;
            }
    return true;
}

/* a brick whose edges 2-3 and 6-7 are points */
static bool is_wedge(const size_t *h)
{
    return h[3] == h[2] && h[13] == h[2] && h[7] == h[6] && h[19] == h[6] && h[15] == h[14];
}

/* ... and whose face 4-5-6-7 is a point as well */
static bool is_tetrahedron(const size_t *h)
{
    return is_wedge(h) && h[5] == h[4] && h[6] == h[4] && h[16] == h[4] && h[17] == h[4] &&
           h[18] == h[4];
}

static void pick(const size_t *from, const unsigned char *order, size_t count, size_t *to)
{
    for (size_t i = 0; i < count; i++)
        to[i] = from[order[i]];
}

static bool make_collapsed(const size_t *brick, enum element_type *type, size_t *made)
{
    /* of the brick's nodes, in Gmsh's order */
    static const unsigned char TET[10] = {0, 1, 2, 4, 8, 11, 9, 10, 14, 12};
    static const unsigned char WEDGE[15] = {0, 1, 2, 4, 5, 6, 8, 9, 10, 11, 12, 14, 16, 17, 18};
    size_t turned[20], twice;
    for (int code = 0; code < 216; code++) {
        int axes[3] = {code % 6, code / 6 % 6, code / 36};
        if (axes[0] % 3 == axes[1] % 3 || axes[1] % 3 == axes[2] % 3 ||
            axes[2] % 3 == axes[0] % 3 || !turn_brick(axes, brick, turned))
            continue;
        bool tetrahedron = is_tetrahedron(turned);
        if (!tetrahedron && !is_wedge(turned))
            continue;
        *type = tetrahedron ? ELEMENT_TET10 : ELEMENT_WEDGE15;
        pick(turned, tetrahedron ? TET : WEDGE, element_node_count(*type), made);
        if (all_apart(made, element_node_count(*type), &twice))
            return true;
    }
    return false;
}

/* ---- linear elements ---- */

/* Stand-ins for mid nodes that are to be made, above all labels: edges with the same ends have the
 * same one, and an edge that is a point has its corner. */
static const size_t FIRST_STAND_IN = BUILDER_MIDDLE - ELEMENT_MOST_NODES;

static void add_stand_ins(enum element_type type, size_t *made)
{
    size_t ends[2], others[2];
    for (size_t i = element_corner_count(type); i < element_node_count(type); i++) {
        element_edge(type, i, ends);
        size_t a = made[ends[0]], b = made[ends[1]];
        made[i] = a == b ? a : FIRST_STAND_IN + i;
        for (size_t j = element_corner_count(type); j < i && a != b; j++) {
            element_edge(type, j, others);
            size_t c = made[others[0]], d = made[others[1]];
            if ((a == c && b == d) || (a == d && b == c))
                made[i] = made[j];
        }
    }
}

static void drop_stand_ins(enum element_type type, size_t *made)
{
    for (size_t i = 0; i < element_node_count(type); i++)
        made[i] = made[i] < FIRST_STAND_IN ? made[i] : BUILDER_MIDDLE;
}

/* ---- all of them ---- */

const char *deck_element_make(enum deck_element_kind kind, const size_t *nodes,
                              enum element_type *type, size_t made[ELEMENT_MOST_NODES],
                              size_t *node)
{
    static const unsigned char *const ORDERS[] = {TET_ORDER, WEDGE_ORDER, HEX_ORDER};
    static const enum element_type TYPES[] = {ELEMENT_TET10, ELEMENT_WEDGE15, ELEMENT_HEX20};
    enum deck_element_kind whole = raised(kind);
    size_t brick[20];
    *type = TYPES[whole];
    /* corners come first, in the same order */
    pick(nodes, ORDERS[whole], deck_element_nodes(kind), made);
    if (whole != kind)
        add_stand_ins(*type, made);
    if (!all_apart(made, element_node_count(*type), node)) {
        if (whole != DECK_C3D20)
            return "is in it more than once: must be nodes of their own";
        memcpy(brick, made, sizeof brick);
        if (!make_collapsed(brick, type, made))
            return "is in it more than once, and it is neither a wedge nor a tetrahedron (with the "
                   "mid nodes of the edges that vanish): must be C3D10, C3D15 or a whole C3D20";
    }
    drop_stand_ins(*type, made);
    return NULL;
}
