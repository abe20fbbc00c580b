/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The statements of an input deck of Abaqus or CalculiX as they stand there: nodes, elements, sets,
 * materials and sections, each in its scope. Names mean something within a scope only: that of
 * the deck itself, of a part, of the assembly or of an instance. deck_body.h makes a mesh of them.
 */
#ifndef PERCUSS_MESH_DECK_H
#define PERCUSS_MESH_DECK_H

#include <stdint.h>

#include "base/fault.h"
#include "mesh/deck_element.h"
#include "mesh/solid_mesh.h"

enum { DECK_LAW_SIZE = 200 };
#define DECK_NONE SIZE_MAX

/* Where a statement stands: an index of deck.files, and a line from 1. */
struct deck_place {
    size_t file, line;
};

enum deck_scope_kind { DECK_MODEL, DECK_PART, DECK_ASSEMBLY, DECK_INSTANCE };

struct deck_scope {
    enum deck_scope_kind kind;
    struct deck_place place;
    char name[MESH_NAME_SIZE];
    char of[MESH_NAME_SIZE]; /* an instance: its part */
    /* an instance is shifted, then turned about the axis through two points */
    double shift[3], axis[2][3], degrees;
};

struct deck_node {
    size_t label, scope;
    double point[3]; /* in units of the file */
};

struct deck_element {
    size_t label, scope;
    size_t first, count; /* its nodes, as the deck orders them: deck.connectivity[first] .. */
    size_t group;        /* deck.names: its ELSET */
    struct deck_place place;
    enum deck_element_kind kind;
};

/* Nodes and elements may have sets of one name, and surfaces too. */
enum deck_set_kind { DECK_NODES, DECK_ELEMENTS, DECK_SURFACE };

enum deck_item_kind {
    DECK_RANGE,         /* labels first, first + step, ... last: of nodes in a surface */
    DECK_SET,           /* the set `name` of the same kind (of nodes in a surface) */
    DECK_ELEMENT_NODES, /* nodes of the elements of the set `name` */
    DECK_FACES,         /* face of the elements first .. last */
    DECK_SET_FACES      /* face of the elements of the set `name` */
};

struct deck_item {
    enum deck_item_kind kind;
    int face;                 /* 1 to 6; DECK_WHOLE: all nodes of a shell */
    size_t first, last, step; /* labels */
    size_t name;              /* deck.names */
    size_t instance;          /* deck.names: whose labels or set; DECK_NONE: of the set's scope */
    struct deck_place place;
};
enum { DECK_WHOLE = 7 };

struct deck_set {
    char name[MESH_NAME_SIZE];
    enum deck_set_kind kind;
    size_t scope;
    size_t item_count, item_room;
    struct deck_item *items;
};

enum deck_property { DECK_ELASTIC, DECK_DENSITY, DECK_PLASTIC, DECK_PROPERTIES };

/* In units of N, s and the file's length. Each *MATERIAL is one, whatever the names of others. */
struct deck_material {
    char name[MESH_NAME_SIZE];
    struct deck_place place;
    size_t stated[DECK_PROPERTIES]; /* lines of the properties; 0: it has none */
    bool elastic, dense;
    double young, poisson, density;
    size_t stress_count; /* of *PLASTIC: its first two rows */
    double stress[2], strain[2];
    char refused[DECK_LAW_SIZE]; /* FILE:LINE and why its law cannot be taken, if the body is of it
                                  */
    size_t told_count, told_room;
    char (*told)[MESH_REMARK_SIZE]; /* what is left out of it */
};

struct deck_section {
    size_t scope, set, material; /* deck.names */
    struct deck_place place;
};

/* An element TYPE=MASS: a point. */
struct deck_point {
    size_t label, scope;
    size_t node, instance; /* deck.names: whose node it is; DECK_NONE: the scope's own */
    bool massive;          /* a *MASS has it */
};

/* A *MASS: that of each point in a set of elements. */
struct deck_mass {
    size_t scope, set; /* deck.names */
    double mass;       /* in units of N, s and the file's length */
    struct deck_place place;
};

/* deck_support.h */
struct deck_support {
    char set[MESH_NAME_SIZE];
    unsigned directions;
};

/* Zero it before use. Functions that add return false or DECK_NONE when out of memory. */
struct deck {
    size_t file_count, file_room;
    char **files;
    size_t name_count, name_room;
    char (*names)[MESH_NAME_SIZE];
    size_t scope_count, scope_room;
    struct deck_scope *scopes; /* the first one: the deck itself */
    size_t node_count, node_room;
    struct deck_node *nodes;
    size_t element_count, element_room;
    struct deck_element *elements;
    size_t connectivity_count, connectivity_room;
    size_t *connectivity;
    size_t set_count, set_room;
    struct deck_set *sets;
    size_t material_count, material_room;
    struct deck_material *materials;
    size_t section_count, section_room;
    struct deck_section *sections;
    size_t point_count, point_room;
    struct deck_point *points;
    size_t mass_count, mass_room;
    struct deck_mass *masses;
    size_t support_count, support_room;
    struct deck_support *supports;
    size_t remark_count, remark_room;
    char (*remarks)[MESH_REMARK_SIZE];
};

/* Names are the same in any case of their letters. */
bool deck_same(const char *a, const char *b);

size_t deck_file(struct deck *deck, const char *path);
size_t deck_name(struct deck *deck, const char *name);
size_t deck_add_scope(struct deck *deck, enum deck_scope_kind kind, const char *name);
bool deck_add_node(struct deck *deck, size_t scope, size_t label, const double point[3]);

/* `element` with its nodes, whose `first` is set here. */
bool deck_add_element(struct deck *deck, struct deck_element *element, const size_t *nodes);

/* The set of a name in a scope; DECK_NONE: there is none. deck_set makes it then, and
 * tells of one in other capitals. */
size_t deck_find_set(const struct deck *deck, enum deck_set_kind kind, size_t scope,
                     const char *name);
size_t deck_set(struct deck *deck, enum deck_set_kind kind, size_t scope, const char *name);

/* A range that goes on where the last item ended lengthens it. */
bool deck_add_item(struct deck *deck, size_t set, const struct deck_item *item);

/* The first material of a name; DECK_NONE: there is none. */
size_t deck_find_material(const struct deck *deck, const char *name);
size_t deck_add_material(struct deck *deck, const char *name, struct deck_place place);
/* What is left out of a material, to be told if the body is of it; the same twice is told once. */
bool deck_material_tell(struct deck *deck, size_t material, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
bool deck_add_section(struct deck *deck, const struct deck_section *section);
bool deck_add_point(struct deck *deck, const struct deck_point *point);
bool deck_add_mass(struct deck *deck, const struct deck_mass *mass);

/* What is left out, and what that means; the same twice is told once. */
bool deck_tell(struct deck *deck, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* "FILE:LINE: message" with PERCUSS_BAD_REQUEST. */
enum percuss_status deck_refuse(const struct deck *deck, struct deck_place place,
                                struct fault *fault, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

void deck_free(struct deck *deck);

#endif
