/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/unv.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/builder.h"
#include "mesh/element.h"
#include "mesh/grow.h"
#include "mesh/scan.h"

enum { UNV_LINE = 256, UNV_FIELDS = 8 };

/* An element by its label, for the groups: a solid by its place in the builder, or nodes of a face
 * or line. */
struct unv_place {
    size_t label, first, count;
    bool solid;
};

struct unv {
    struct scan scan;
    struct builder builder;
    size_t place_count, place_room;
    struct unv_place *places;       /* sorted before the groups are read */
    struct builder_list flat_nodes; /* of faces and lines */
    struct builder_list grouped;    /* solids that are in a group */
    size_t flat;                    /* number of faces and lines */
    bool group_pass;                /* groups are read, and others passed over */
    double unit;                    /* m, of the caller */
};

static enum percuss_status unv_out_of_memory(const struct unv *unv)
{
    return fault_set(unv->scan.fault, PERCUSS_INTERNAL, "%s: out of memory", unv->scan.file);
}

/* ---- lines ---- */

/* Whether a line is the mark -1 between datasets. */
static bool is_mark(const char *line)
{
    const char *at = line + strspn(line, " ");
    return strncmp(at, "-1", 2) == 0 && at[2 + strspn(at + 2, " \t")] == '\0';
}

/* The next line of a dataset; false: its end, or with a message that of the file. */
static bool dataset_line(struct unv *unv, char line[UNV_LINE], enum percuss_status *status)
{
    *status = PERCUSS_OK;
    if (!scan_line(&unv->scan, line, UNV_LINE)) {
        *status = scan_refuse(&unv->scan, "a dataset must end with -1: is the file whole?");
        return false;
    }
    return !is_mark(line);
}

/* the line that must follow within a record */
static bool record_line(struct unv *unv, char line[UNV_LINE], enum percuss_status *status)
{
    if (dataset_line(unv, line, status))
        return true;
    if (*status == PERCUSS_OK)
        *status = scan_refuse(&unv->scan, "the dataset ends within a record: is the file whole?");
    return false;
}

/* Whole numbers of a line, up to `most`; returns how many, SIZE_MAX with a message: a word is none.
 */
static size_t unv_integers(const struct unv *unv, const char *line, size_t most, long *values)
{
    size_t count = 0;
    char *end;
    for (;;) {
        line += strspn(line, " \t");
        if (*line == '\0' || count == most)
            return count;
        errno = 0;
        values[count] = strtol(line, &end, 10);
        if (end == line || errno || (*end && !isspace((unsigned char)*end))) {
            scan_refuse(&unv->scan, "%.20s: must be a whole number", line);
            return SIZE_MAX;
        }
        count++;
        line = end;
    }
}

/* `count` whole numbers must stand in a line */
static enum percuss_status need_integers(const struct unv *unv, const char *line, size_t count,
                                         long *values)
{
    size_t found = unv_integers(unv, line, count, values);
    if (found == SIZE_MAX)
        return PERCUSS_BAD_REQUEST;
    return found == count ? PERCUSS_OK
                          : scan_refuse(&unv->scan, "must have %zu whole numbers", count);
}

/* three coordinates, whose exponents may be written with D */
static enum percuss_status unv_point(const struct unv *unv, char *line, double point[3])
{
    char *end;
    for (char *c = line; *c; c++)
        if (*c == 'D' || *c == 'd')
            *c = 'E';
    for (int k = 0; k < 3; k++) {
        point[k] = strtod(line, &end);
        if (end == line || (*end && !isspace((unsigned char)*end)))
            return scan_refuse(&unv->scan, "%.24s: must be a coordinate",
                               line + strspn(line, " \t"));
        line = end;
    }
    return PERCUSS_OK;
}

/* ---- nodes and elements ---- */

/* dataset 15: a line each; 781, 2411: two lines. Coordinates are the model's, whatever system the
 * node is shown in */
static enum percuss_status read_unv_nodes(struct unv *unv, int dataset)
{
    enum percuss_status status;
    char line[UNV_LINE];
    while (dataset_line(unv, line, &status)) {
        long head[4];
        double point[3];
        char *at = line;
        status = need_integers(unv, line, dataset == 15 ? 4 : 1, head);
        if (status == PERCUSS_OK && dataset == 15)
            for (int i = 0; i < 4; i++)
                (void)strtol(at, &at, 10);
        else if (status == PERCUSS_OK && !record_line(unv, at = line, &status))
            return status;
        if (status == PERCUSS_OK)
            status = unv_point(unv, at, point);
        if (status != PERCUSS_OK)
            return status;
        if (head[0] <= 0)
            return scan_refuse(&unv->scan, "node %ld: must have a number > 0", head[0]);
        if (!builder_add_node(&unv->builder, (size_t)head[0], point))
            return unv_out_of_memory(unv);
    }
    return status;
}

/* Kinds of elements by I-deas' number ("fe descriptor"), with the file's node of each node in
 * Gmsh's order: corners and mid nodes take turns round the faces. */
static const struct unv_kind {
    long number;
    enum element_type type;
    size_t nodes;
    const char *name;
    unsigned char order[20];
} KINDS[] = {{111, ELEMENT_TET10, 4, "linear tetrahedron", {0, 1, 2, 3}},
             {112, ELEMENT_WEDGE15, 6, "linear wedge", {0, 1, 2, 3, 4, 5}},
             {115, ELEMENT_HEX20, 8, "linear brick", {0, 1, 2, 3, 4, 5, 6, 7}},
             {118, ELEMENT_TET10, 10, "parabolic tetrahedron", {0, 2, 4, 9, 1, 3, 5, 6, 8, 7}},
             {113,
              ELEMENT_WEDGE15,
              15,
              "parabolic wedge",
              {0, 2, 4, 9, 11, 13, 1, 5, 6, 3, 7, 8, 10, 14, 12}},
             {116, ELEMENT_HEX20, 20, "parabolic brick", {0, 2, 4, 6, 12, 14, 16, 18, 1,  7,
                                                          8, 3, 9, 5, 10, 11, 13, 19, 15, 17}}};

/* beams have a line on their cross section */
static bool is_beam(long number)
{
    return number == 11 || number == 21 || number == 22 || number == 23 || number == 24;
}

static enum percuss_status add_unv_solid(struct unv *unv, size_t label, long property,
                                         const struct unv_kind *kind, const size_t *nodes)
{
    size_t ordered[ELEMENT_MOST_NODES];
    char name[MESH_NAME_SIZE];
    if (kind->nodes <= 8 && !unv->builder.raise)
        return scan_refuse(
            &unv->scan,
            "element %zu: %s (%ld): must be parabolic (118, 116, 113), as linear ones are too "
            "stiff "
            "(first frequency 4 to 15 %% high): Salome: Modification, Convert to/from quadratic; "
            "FreeCAD: ElementOrder 2nd; or raise them by --raise",
            label, kind->name, kind->number);
    for (size_t i = 0; i < element_node_count(kind->type); i++)
        ordered[i] = i < kind->nodes ? nodes[kind->order[i]] : BUILDER_MIDDLE;
    snprintf(name, sizeof name, "property %ld", property);
    size_t part = builder_part(&unv->builder, name);
    return part != SIZE_MAX && builder_add_element(&unv->builder, kind->type, label, part, ordered)
               ? PERCUSS_OK
               : unv_out_of_memory(unv);
}

/* the nodes of an element, eight in a line */
static enum percuss_status read_element_nodes(struct unv *unv, size_t count, size_t *nodes)
{
    enum percuss_status status;
    char line[UNV_LINE];
    long values[UNV_FIELDS];
    for (size_t at = 0; at < count; at += UNV_FIELDS) {
        size_t here = count - at < UNV_FIELDS ? count - at : UNV_FIELDS;
        if (!record_line(unv, line, &status))
            return status;
        if ((status = need_integers(unv, line, here, values)) != PERCUSS_OK)
            return status;
        for (size_t i = 0; i < here; i++) {
            if (values[i] < 0)
                return scan_refuse(&unv->scan, "%ld: must be the number of a node", values[i]);
            if (at + i < ELEMENT_MOST_NODES)
                nodes[at + i] = (size_t)values[i];
        }
    }
    return PERCUSS_OK;
}

/* a solid, or what names nodes alone; other solids are refused */
static enum percuss_status add_unv_element(struct unv *unv, const long head[6], const size_t *nodes,
                                           size_t count)
{
    struct unv_place place = {.label = (size_t)head[0]};
    for (size_t i = 0; i < sizeof KINDS / sizeof *KINDS; i++) {
        if (KINDS[i].number != head[1])
            continue;
        if (KINDS[i].nodes != count)
            return scan_refuse(&unv->scan, "element %ld: %s: has %zu nodes: must have %zu", head[0],
                               KINDS[i].name, count, KINDS[i].nodes);
        place.solid = true;
        place.first = unv->builder.element_count;
        enum percuss_status status = add_unv_solid(unv, place.label, head[2], &KINDS[i], nodes);
        if (status != PERCUSS_OK)
            return status;
    }
    if (!place.solid && head[1] >= 101 && head[1] <= 119)
        return scan_refuse(&unv->scan,
                           "element %ld: kind %ld: must be a parabolic tetrahedron (118), brick "
                           "(116) or wedge (113)",
                           head[0], head[1]);
    place.count = place.solid ? 0 : count < ELEMENT_MOST_NODES ? count : ELEMENT_MOST_NODES;
    if (!place.solid)
        place.first = unv->flat_nodes.count;
    unv->flat += !place.solid;
    for (size_t i = 0; i < place.count; i++)
        if (!builder_append(&unv->flat_nodes, nodes[i]))
            return unv_out_of_memory(unv);
    if (!GROW(unv->places, unv->place_count, unv->place_room))
        return unv_out_of_memory(unv);
    unv->places[unv->place_count++] = place;
    return PERCUSS_OK;
}

/* datasets 780 and 2412: label, kind, (780: a second one of each) property, ..., number of nodes */
static enum percuss_status read_unv_elements(struct unv *unv, int dataset)
{
    enum percuss_status status;
    char line[UNV_LINE];
    size_t fields = dataset == 780 ? 8 : 6, nodes[ELEMENT_MOST_NODES];
    while (dataset_line(unv, line, &status)) {
        long head[UNV_FIELDS], count;
        if ((status = need_integers(unv, line, fields, head)) != PERCUSS_OK)
            return status;
        count = head[fields - 1];
        if (dataset == 780)
            head[2] = head[3];
        if (head[0] <= 0 || count < 0 || count > INT_MAX)
            return scan_refuse(&unv->scan, "element %ld of %ld nodes: must be numbers > 0", head[0],
                               count);
        if (is_beam(head[1]) && !record_line(unv, line, &status))
            return status;
        status = read_element_nodes(unv, (size_t)count, nodes);
        if (status == PERCUSS_OK)
            status = add_unv_element(unv, head, nodes, (size_t)count);
        if (status != PERCUSS_OK)
            return status;
    }
    return status;
}

/* ---- groups ---- */

static int compare_places(const void *left, const void *right)
{
    const struct unv_place *a = left, *b = right;
    return a->label < b->label ? -1 : a->label > b->label;
}

static const struct unv_place *find_place(struct unv *unv, size_t label)
{
    struct unv_place key = {.label = label};
    if (unv->place_count == 0)
        return NULL;
    return bsearch(&key, unv->places, unv->place_count, sizeof key, compare_places);
}

/* a solid goes to the first group that has it */
static bool group_solid(struct unv *unv, size_t element, const char *name)
{
    while (unv->grouped.count <= element)
        if (!builder_append(&unv->grouped, 0))
            return false;
    if (unv->grouped.values[element])
        return true;
    size_t part = builder_part(&unv->builder, name);
    if (part == SIZE_MAX)
        return false;
    unv->builder.elements[element].part = part;
    unv->grouped.values[element] = 1;
    return true;
}

/* adds a node (code 7) or an element (8) to a group */
static bool add_to_group(struct unv *unv, const char *name, long code, size_t label)
{
    const struct unv_place *place = code == 8 ? find_place(unv, label) : NULL;
    if (code != 7 && !place)
        return true;
    if (place && place->solid)
        return group_solid(unv, place->first, name);
    size_t set = builder_set(&unv->builder, name);
    if (set == SIZE_MAX)
        return false;
    struct builder_list *labels = &unv->builder.sets[set].labels;
    if (code == 7)
        return builder_append(labels, label);
    for (size_t i = 0; i < place->count; i++)
        if (!builder_append(labels, unv->flat_nodes.values[place->first + i]))
            return false;
    return true;
}

static void trim_name(char *line)
{
    size_t length = strlen(line), blank = strspn(line, " \t");
    while (length > blank && isspace((unsigned char)line[length - 1]))
        line[--length] = '\0';
    memmove(line, line + blank, length - blank + 1);
}

/* the entities of one group: code and label, and in later datasets two numbers more */
static enum percuss_status read_entities_of(struct unv *unv, const char *name, size_t count,
                                            size_t each)
{
    enum percuss_status status;
    char line[UNV_LINE];
    long values[UNV_FIELDS];
    for (size_t done = 0; done < count;) {
        size_t here = (count - done) * each;
        if (!record_line(unv, line, &status))
            return status;
        here = here < UNV_FIELDS ? here : UNV_FIELDS;
        size_t found = unv_integers(unv, line, here, values);
        if (found == SIZE_MAX)
            return PERCUSS_BAD_REQUEST;
        if (found == 0 || found % each != 0)
            return scan_refuse(&unv->scan, "group %.40s: must have %zu numbers of each entity",
                               name, each);
        for (size_t i = 0; i < found; i += each, done++)
            if (values[i + 1] > 0 && !add_to_group(unv, name, values[i], (size_t)values[i + 1]))
                return unv_out_of_memory(unv);
    }
    return PERCUSS_OK;
}

/* numbers of the group, the last one that of its entities; then its name */
static enum percuss_status read_unv_groups(struct unv *unv, int dataset)
{
    enum percuss_status status;
    char line[UNV_LINE];
    bool four = dataset == 2435 || dataset == 2452 || dataset == 2467 || dataset == 2477;
    while (dataset_line(unv, line, &status)) {
        long head[UNV_FIELDS];
        size_t fields = unv_integers(unv, line, UNV_FIELDS, head);
        if (fields == SIZE_MAX)
            return PERCUSS_BAD_REQUEST;
        if (fields < 6 || head[fields - 1] < 0)
            return scan_refuse(&unv->scan, "group: must have 6 to 8 whole numbers");
        if (!record_line(unv, line, &status))
            return status;
        trim_name(line);
        char name[MESH_NAME_SIZE];
        snprintf(name, sizeof name, "%.*s", (int)sizeof name - 1, line);
        if (name[0] == '\0')
            snprintf(name, sizeof name, "group %ld", head[0]);
        status = read_entities_of(unv, name, (size_t)head[fields - 1], four ? 4 : 2);
        if (status != PERCUSS_OK)
            return status;
    }
    return status;
}

/* ---- units ---- */

/* Dataset 164: name of the units, then factors, the first one units of length in a metre. Programs
 * write metres whatever the model's unit is, so that the caller's is taken, and a remark made. */
static enum percuss_status read_unv_units(struct unv *unv, int dataset)
{
    enum percuss_status status;
    char line[UNV_LINE], name[31] = "";
    (void)dataset;
    for (int row = 0; dataset_line(unv, line, &status); row++) {
        if (row == 0 && strlen(line) > 10) {
            snprintf(name, sizeof name, "%.*s", (int)sizeof name - 1, line + 10);
            trim_name(name);
            char *behind = strstr(name, "  "); /* kind of temperatures */
            if (behind)
                *behind = '\0';
        }
        for (char *c = line; *c; c++)
            if (*c == 'D' || *c == 'd')
                *c = 'E';
        double unit = row == 1 ? 1.0 / strtod(line, NULL) : 0.0;
        if (unit > 0.0 && isfinite(unit) && fabs(unit - unv->unit) > 1e-6 * unit &&
            !builder_remark(&unv->builder,
                            "the file states a unit of %g m (%s, dataset 164); it is read in %g m, "
                            "that of --unit",
                            unit, name, unv->unit))
            return unv_out_of_memory(unv);
    }
    return status;
}

/* ---- datasets ---- */

typedef enum percuss_status unv_reader(struct unv *unv, int dataset);

static const struct {
    int number;
    unv_reader *read;
} DATASETS[] = {{15, read_unv_nodes},     {781, read_unv_nodes},     {2411, read_unv_nodes},
                {780, read_unv_elements}, {2412, read_unv_elements}, {2417, read_unv_groups},
                {2429, read_unv_groups},  {2430, read_unv_groups},   {2432, read_unv_groups},
                {2435, read_unv_groups},  {2452, read_unv_groups},   {2467, read_unv_groups},
                {2477, read_unv_groups},  {164, read_unv_units}};

static enum percuss_status skip_dataset(struct unv *unv)
{
    enum percuss_status status;
    char line[UNV_LINE];
    while (dataset_line(unv, line, &status))
        ;
    return status;
}

static enum percuss_status read_dataset(struct unv *unv, int number)
{
    if (number == 71)
        return scan_refuse(&unv->scan, "dataset 71: elements of that age are not read: must be "
                                       "780 or 2412");
    for (size_t i = 0; i < sizeof DATASETS / sizeof *DATASETS; i++)
        if (number == DATASETS[i].number &&
            (DATASETS[i].read == read_unv_groups) == unv->group_pass)
            return DATASETS[i].read(unv, number);
    return skip_dataset(unv);
}

static enum percuss_status read_datasets(struct unv *unv)
{
    char line[UNV_LINE];
    enum percuss_status status = PERCUSS_OK;
    while (status == PERCUSS_OK && scan_line(&unv->scan, line, sizeof line)) {
        long number;
        if (line[strspn(line, " \t")] == '\0')
            continue;
        if (!is_mark(line))
            return scan_refuse(&unv->scan, "must be -1, between datasets: is it a universal file?");
        if (!scan_line(&unv->scan, line, sizeof line))
            return status;
        if ((status = need_integers(unv, line, 1, &number)) == PERCUSS_OK)
            status = read_dataset(unv, number > 0 && number < 100000 ? (int)number : 0);
    }
    return status;
}

/* groups last, as they may stand before what they are of */
static enum percuss_status read_both_passes(struct unv *unv)
{
    struct scan front = unv->scan;
    enum percuss_status status = read_datasets(unv);
    if (status != PERCUSS_OK)
        return status;
    if (unv->place_count)
        qsort(unv->places, unv->place_count, sizeof *unv->places, compare_places);
    unv->scan = front;
    unv->group_pass = true;
    return read_datasets(unv);
}

static enum percuss_status check_unv_solids(const struct unv *unv)
{
    if (unv->builder.element_count > 0 || unv->flat == 0)
        return PERCUSS_OK;
    return fault_set(unv->scan.fault, PERCUSS_BAD_REQUEST,
                     "%s: has %zu shells or lines and no solid: mesh the volume and export it, too "
                     "(Salome: a 3D algorithm, Compute; FreeCAD: mesh the solid itself), or give "
                     "the part as STEP",
                     unv->scan.file, unv->flat);
}

enum percuss_status unv_read(const char *path, double unit, bool raise, struct solid_mesh *mesh,
                             struct fault *fault)
{
    struct unv unv = {.unit = unit};
    memset(mesh, 0, sizeof *mesh);
    unv.builder.raise = raise;
    enum percuss_status status = scan_open(path, &unv.scan, fault);
    if (status == PERCUSS_OK)
        status = read_both_passes(&unv);
    if (status == PERCUSS_OK)
        status = check_unv_solids(&unv);
    if (status == PERCUSS_OK)
        status = builder_finish(&unv.builder, path, unit, mesh, fault);
    scan_close(&unv.scan);
    builder_free(&unv.builder);
    free(unv.places);
    free(unv.flat_nodes.values);
    free(unv.grouped.values);
    return status;
}
