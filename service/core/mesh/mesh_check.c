/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/mesh_check.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/bulk.h"
#include "mesh/element.h"
#include "mesh/joined.h"
#include "model/vector.h"

/* nodes nearer than this part of an edge are one place */
static const double SAME_PLACE = 1e-5;
/* a direction that is normal to hardly any plane of a mesh: nodes sorted along it are well apart */
static const double SORTING[3] = {0.61803398874989485, 0.54030230586813977, 0.57107655817564230};
/* elements below this are worth a remark: .2 is common in meshes of Gmsh */
static const double POOR_JACOBIAN = 0.05;
/* m: bodies beyond these sizes are rare, and wrong units common */
static const double SMALLEST_BODY = 1e-3, LARGEST_BODY = 20.0;
/* faces that turn by more than 50 degrees: normals and curvatures are poor */
static const double COARSE_COSINE = 0.64278760968653933;

struct sorted_node {
    double along;
    size_t node;
};

static void remark(struct mesh_findings *findings, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void remark(struct mesh_findings *findings, const char *format, ...)
{
    if (findings->remark_count == MESH_REMARKS)
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(findings->remarks[findings->remark_count++], MESH_REMARK_SIZE, format, args);
    va_end(args);
}

/* det J of all elements */
static enum percuss_status check_shapes(const struct solid_mesh *mesh,
                                        struct mesh_findings *findings, struct fault *fault)
{
    size_t bad = 0, first = 0, reversed = 0;
    double volume, first_ratio = 0.0;
    findings->least_jacobian = INFINITY;
    /* the least det J over its mean, the volume, and the first bad element */
    for (size_t e = 0; e < mesh->element_count; e++) {
        double ratio = bulk_element_det(mesh, e, &volume);
        bool inside_out = !(ratio > 0.0) || !(volume > 0.0);
        if (inside_out && bad++ == 0) {
            first = mesh->element_labels[e];
            first_ratio = ratio;
        }
        reversed += volume < 0.0;
        findings->volume += volume;
        if (ratio < findings->least_jacobian) {
            findings->least_jacobian = ratio;
            findings->least_element = mesh->element_labels[e];
        }
    }
    /* most are reversed: the mesh is mirrored */
    if (reversed > 0 && 2 * reversed > mesh->element_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%zu of %zu elements have a negative volume (element %zu first): their "
                         "nodes run the wrong way round, as in a mirrored mesh: turn them over",
                         reversed, mesh->element_count, first);
    /* a few: they are bent too far */
    if (bad > 0)
        return fault_set(
            fault, PERCUSS_BAD_REQUEST,
            "%zu of %zu elements are turned inside out (det J <= 0; element %zu: %.2g of its "
            "mean): "
            "curved elements must be smaller at round places, or their edges straight (Gmsh: "
            "Mesh.HighOrderOptimize=2, or Mesh.SecondOrderLinear = 1)",
            bad, mesh->element_count, first, first_ratio);
    /* all are good; the worst is worth a remark */
    if (findings->least_jacobian < POOR_JACOBIAN)
        remark(findings, "element %zu is badly shaped: least det J %.2g of its mean",
               findings->least_element, findings->least_jacobian);
    return PERCUSS_OK;
}

static int compare_along(const void *left, const void *right)
{
    const struct sorted_node *a = left, *b = right;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return a->node < b->node ? -1 : a->node > b->node;
}

/* refuses pairs of nodes in one place: the body is cut there */
static enum percuss_status check_same_places(const struct solid_mesh *mesh, double size,
                                             struct fault *fault)
{
    /* along one direction, nodes in one place are neighbours */
    struct sorted_node *nodes = malloc(mesh->node_count * sizeof *nodes);
    size_t pairs = 0, one = 0, other = 0;
    if (!nodes)
        return fault_set(fault, PERCUSS_INTERNAL, "%zu nodes: out of memory", mesh->node_count);
    for (size_t i = 0; i < mesh->node_count; i++)
        nodes[i] = (struct sorted_node){dot3(SORTING, mesh->points[i]), i};
    qsort(nodes, mesh->node_count, sizeof *nodes, compare_along);
    /* each with those that follow closely */
    double near = SAME_PLACE * size;
    for (size_t i = 0; i < mesh->node_count; i++)
        for (size_t j = i + 1; j < mesh->node_count && nodes[j].along - nodes[i].along <= near;
             j++) {
            double way[3];
            sub3(mesh->points[nodes[i].node], mesh->points[nodes[j].node], way);
            if (norm3(way) <= near && pairs++ == 0) {
                one = mesh->labels[nodes[i].node];
                other = mesh->labels[nodes[j].node];
            }
        }
    free(nodes);
    if (pairs == 0)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "%zu pairs of nodes are in one place (nodes %zu and %zu): elements must share "
                     "their nodes, else the body is cut there; merge them (Gmsh: Coherence Mesh)",
                     pairs, one, other);
}

/* ---- seams: elements that meet without sharing a face ---- */

/* three corners of an outer face, ascending: of a triangle, or of a quadrilateral */
struct seam_corners {
    size_t corners[3], element;
    bool quadrilateral;
};

static int compare_seams(const void *left, const void *right)
{
    const struct seam_corners *a = left, *b = right;
    for (int k = 0; k < 3; k++)
        if (a->corners[k] != b->corners[k])
            return a->corners[k] < b->corners[k] ? -1 : 1;
    return (int)a->quadrilateral - (int)b->quadrilateral;
}

/* the corners of a face without one of them; `without` 3 of a triangle: none */
static struct seam_corners corners_without(const struct surface_face *face, int without)
{
    struct seam_corners seam = {.element = face->element,
                                .quadrilateral = surface_face_corners(face) == 4};
    for (int k = 0, i = 0; k < 3; k++, i++) {
        i += i == without;
        seam.corners[k] = face->nodes[i];
    }
    for (int i = 1; i < 3; i++)
        for (int k = i; k > 0 && seam.corners[k - 1] > seam.corners[k]; k--) {
            size_t swap = seam.corners[k];
            seam.corners[k] = seam.corners[k - 1];
            seam.corners[k - 1] = swap;
        }
    return seam;
}

/* A triangle of the surface whose corners are all a quadrilateral's lies on it: the body is cut
 * there, as where tetrahedra meet bricks. */
static enum percuss_status check_triangles(const struct solid_mesh *mesh,
                                           const struct surface *surface, struct fault *fault)
{
    struct seam_corners *all = malloc((4 * surface->face_count + 1) * sizeof *all);
    enum percuss_status status = PERCUSS_OK;
    size_t count = 0;
    if (!all)
        return fault_set(fault, PERCUSS_INTERNAL, "%zu faces: out of memory", surface->face_count);
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        for (int i = surface_face_corners(face) == 4 ? 0 : 3; i < 4; i++)
            all[count++] = corners_without(face, i);
    }
    qsort(all, count, sizeof *all, compare_seams);
    for (size_t i = 1; i < count && status == PERCUSS_OK; i++)
        if (!all[i - 1].quadrilateral && all[i].quadrilateral &&
            memcmp(all[i - 1].corners, all[i].corners, sizeof all[i].corners) == 0)
            status = fault_set(
                fault, PERCUSS_BAD_REQUEST,
                "elements %zu and %zu meet with a triangle on a quadrilateral: the body is cut "
                "there: must share whole faces: mesh it with elements of one kind, or wedges the "
                "other way",
                mesh->element_labels[all[i - 1].element], mesh->element_labels[all[i].element]);
    free(all);
    return status;
}

/* A node that is a corner of one element and a mid node of another one hangs between its corners,
 * as where elements of half the size begin. */
static enum percuss_status check_hanging(const struct solid_mesh *mesh, struct fault *fault)
{
    size_t *corner_of = malloc((mesh->node_count + 1) * sizeof *corner_of);
    enum percuss_status status = PERCUSS_OK;
    if (!corner_of)
        return fault_set(fault, PERCUSS_INTERNAL, "%zu nodes: out of memory", mesh->node_count);
    for (size_t i = 0; i < mesh->node_count; i++)
        corner_of[i] = SIZE_MAX;
    for (size_t e = 0; e < mesh->element_count; e++)
        for (size_t i = 0; i < element_corner_count(mesh->types[e]); i++)
            corner_of[mesh->nodes[mesh->first[e] + i]] = e;
    for (size_t e = 0; e < mesh->element_count && status == PERCUSS_OK; e++)
        for (size_t i = mesh->first[e] + element_corner_count(mesh->types[e]);
             i < mesh->first[e + 1] && status == PERCUSS_OK; i++) {
            size_t node = mesh->nodes[i];
            if (corner_of[node] != SIZE_MAX)
                status = fault_set(
                    fault, PERCUSS_BAD_REQUEST,
                    "node %zu is a mid node of element %zu and a corner of element %zu: elements "
                    "must share whole faces: mesh the whole at once",
                    mesh->labels[node], mesh->element_labels[e],
                    mesh->element_labels[corner_of[node]]);
        }
    free(corner_of);
    return status;
}

/* ---- pieces ---- */

/* counts elements outside the first one's piece, in `parent`; *example is the first of them */
static size_t count_apart(size_t *parent, size_t count, size_t *example)
{
    size_t apart = 0, whole = joined_root(parent, 0);
    for (size_t e = 0; e < count; e++)
        if (joined_root(parent, e) != whole && apart++ == 0)
            *example = e;
    return apart;
}

/* joins elements that share a node */
static bool join_by_nodes(const struct solid_mesh *mesh, size_t *parent)
{
    size_t *owner = malloc((mesh->node_count + 1) * sizeof *owner);
    if (!owner)
        return false;
    for (size_t i = 0; i < mesh->node_count; i++)
        owner[i] = SIZE_MAX;
    joined_begin(parent, mesh->element_count);
    for (size_t e = 0; e < mesh->element_count; e++)
        for (size_t i = mesh->first[e]; i < mesh->first[e + 1]; i++) {
            size_t *first = &owner[mesh->nodes[i]];
            if (*first == SIZE_MAX)
                *first = e;
            joined_unite(parent, *first, e);
        }
    free(owner);
    return true;
}

/* elements that share no node are two bodies; those that share only an edge or a corner turn about
 * it */
static enum percuss_status refuse_pieces(const struct solid_mesh *mesh, size_t *parent,
                                         struct fault *fault)
{
    size_t pieces = 0, apart = 0, count = mesh->element_count, example = 0;
    /* a hinge: all are joined by nodes */
    size_t hinged = count_apart(parent, count, &example);
    size_t label = mesh->element_labels[example];
    if (hinged > 0 && !join_by_nodes(mesh, parent))
        return fault_set(fault, PERCUSS_INTERNAL, "%zu elements: out of memory", count);
    apart = hinged > 0 ? count_apart(parent, count, &example) : 0;
    if (hinged > 0 && apart == 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%zu elements (element %zu first) hang on the other %zu by an edge or a "
                         "node alone, as on a hinge: must be one body, whose elements share faces",
                         hinged, label, count - hinged);
    if (apart == 0)
        return PERCUSS_OK;
    /* separate pieces */
    for (size_t e = 0; e < count; e++)
        pieces += parent[e] == e;
    return fault_set(
        fault, PERCUSS_BAD_REQUEST,
        "%zu pieces that do not hang together: %zu elements (element %zu first) share "
        "no node with the other %zu: must be one body; in CAD unite the parts, in Gmsh "
        "BooleanFragments, or mesh one of them",
        pieces, apart, mesh->element_labels[example], count - apart);
}

/* elements joined by faces are one piece */
static enum percuss_status check_pieces(const struct solid_mesh *mesh, struct fault *fault)
{
    size_t *parent = malloc(mesh->element_count * sizeof *parent);
    if (!parent)
        return fault_set(fault, PERCUSS_INTERNAL, "%zu elements: out of memory",
                         mesh->element_count);
    enum percuss_status status = boundary_join(mesh, parent, fault);
    if (status == PERCUSS_OK)
        status = refuse_pieces(mesh, parent, fault);
    free(parent);
    return status;
}

static void check_extent(const struct solid_mesh *mesh, struct mesh_findings *findings)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < mesh->node_count; i++)
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], mesh->points[i][k]);
            high[k] = fmax(high[k], mesh->points[i][k]);
        }
    sub3(high, low, findings->extent);
    double most = fmax(findings->extent[0], fmax(findings->extent[1], findings->extent[2]));
    if (most > LARGEST_BODY || most < SMALLEST_BODY)
        remark(findings,
               "extends %.3g m, one unit of the file being %g m: is the unit of length "
               "right (mm)?",
               most, mesh->unit);
}

/* the largest angle between normals at two corners of a face, as a cosine */
static double turn_cosine(const struct surface_face *face, const struct surface_point *points)
{
    int corners = surface_face_corners(face);
    double least = 1.0;
    for (int i = 0; i < corners; i++)
        for (int j = 0; j < i; j++)
            least = fmin(least, dot3(points[i].normal, points[j].normal));
    return least;
}

/* remarks on coarse or straight-sided faces */
static void check_surface(const struct surface *surface, struct mesh_findings *findings)
{
    size_t coarse = 0;
    if (!surface->points)
        return;
    if (2 * surface->straight > surface->edges && surface->edges > 0)
        remark(findings,
               "elements are straight-sided on round ground (%zu of %zu edges): curvatures come "
               "from their corners alone; second order with the geometry (gmsh -order 2) is better",
               surface->straight, surface->edges);
    for (size_t f = 0; f < surface->face_count; f++)
        coarse += turn_cosine(&surface->faces[f], surface->points[f]) < COARSE_COSINE;
    if (coarse > 0)
        remark(findings,
               "%zu of %zu faces turn by more than 50 degrees: elements must be smaller there for "
               "normals and curvatures to be good",
               coarse, surface->face_count);
}

enum percuss_status mesh_check(const struct solid_mesh *mesh, const struct surface *surface,
                               struct mesh_findings *findings, struct fault *fault)
{
    memset(findings, 0, sizeof *findings);
    if (mesh->element_count == 0)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "elements: 0: a mesh must have some");
    enum percuss_status status = check_shapes(mesh, findings, fault);
    if (status == PERCUSS_OK)
        status = check_same_places(mesh, surface->size, fault);
    if (status == PERCUSS_OK)
        status = check_hanging(mesh, fault);
    if (status == PERCUSS_OK)
        status = check_triangles(mesh, surface, fault);
    if (status == PERCUSS_OK)
        status = check_pieces(mesh, fault);
    if (status != PERCUSS_OK)
        return status;
    check_extent(mesh, findings);
    check_surface(surface, findings);
    return PERCUSS_OK;
}
