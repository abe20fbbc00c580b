/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/surface.h"
#include "model/vector.h"

/* ---- net: the nodes of a surface with their neighbours. A node on a sharp edge is one vertex for
 * each patch that meets there, so that walks from vertex to vertex stay on smooth ground. ---- */

/* Owns its arrays. */
struct net {
    size_t vertex_count;
    size_t *nodes;                       /* [vertex_count], of the mesh */
    double (*normals)[3];                /* [vertex_count]: mean of the faces', unit */
    double *spacing;                     /* [vertex_count]: mean distance of its neighbours, m */
    bool *left_out;                      /* [vertex_count]: mid nodes off the surface */
    size_t *first;                       /* [vertex_count + 1] */
    size_t *faces;                       /* faces at vertex i are faces[first[i]] .. */
    size_t (*vertices)[FACE_MOST_NODES]; /* [face_count]: of each face, in its order;
                                          * SIZE_MAX beyond its nodes */
};

/* an edge bends by L^2/(8R): below this part of its length the ground is flat, or the edge runs
 * along a cylinder, where the normals of faces have such errors */
static const double LEAST_BEND = 2e-3;
/* it is straight if its mid node has less than this part of the bend */
static const double STRAIGHT = 0.1;

/* a node of a face, sorted by node and patch */
struct visit {
    size_t node, patch, face;
    int local;
};

static int compare_visits(const void *left, const void *right)
{
    const struct visit *a = left, *b = right;
    if (a->node != b->node)
        return a->node < b->node ? -1 : 1;
    if (a->patch != b->patch)
        return a->patch < b->patch ? -1 : 1;
    return a->face < b->face ? -1 : a->face > b->face;
}

static size_t count_visits(const struct surface *surface)
{
    size_t count = 0;
    for (size_t f = 0; f < surface->face_count; f++)
        count += surface->faces[f].count;
    return count;
}

static void fill_visits(const struct surface *surface, struct visit *visits)
{
    size_t filled = 0;
    for (size_t f = 0; f < surface->face_count; f++)
        for (int i = 0; i < surface->faces[f].count; i++)
            visits[filled++] =
                (struct visit){surface->faces[f].nodes[i], surface->faces[f].patch, f, i};
}

static bool net_allocate(struct net *net, size_t faces, size_t visits)
{
    net->nodes = malloc(visits * sizeof *net->nodes);
    net->normals = calloc(visits, sizeof *net->normals);
    net->spacing = calloc(visits, sizeof *net->spacing);
    net->left_out = calloc(visits, sizeof *net->left_out);
    net->first = malloc((visits + 1) * sizeof *net->first);
    net->faces = malloc(visits * sizeof *net->faces);
    net->vertices = malloc(faces * sizeof *net->vertices);
    return net->nodes && net->normals && net->spacing && net->left_out && net->first &&
           net->faces && net->vertices;
}

/* numbers the vertices and lists the faces of each */
static void net_number(const struct visit *visits, size_t count, size_t faces, struct net *net)
{
    net->vertex_count = 0;
    memset(net->vertices, 0xFF, faces * sizeof *net->vertices);
    for (size_t i = 0; i < count; i++) {
        const struct visit *visit = &visits[i];
        if (i == 0 || visit->node != visits[i - 1].node || visit->patch != visits[i - 1].patch) {
            net->first[net->vertex_count] = i;
            net->nodes[net->vertex_count++] = visit->node;
        }
        net->faces[i] = visit->face;
        net->vertices[visit->face][visit->local] = net->vertex_count - 1;
    }
    net->first[net->vertex_count] = count;
}

/* mean distance from corner to corner of a face */
static double net_mean_edge(const struct surface_face *face, double (*points)[3])
{
    int corners = surface_face_corners(face);
    double sum = 0.0;
    for (int i = 0; i < corners; i++) {
        double way[3];
        sub3(points[i], points[(i + 1) % corners], way);
        sum += norm3(way);
    }
    return sum / corners;
}

/* normals weighted by the area about the node */
static void net_average(const struct solid_mesh *mesh, const struct surface *surface,
                        struct net *net)
{
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        double points[FACE_MOST_NODES][3];
        surface_face_points(mesh, face, points);
        double edge = net_mean_edge(face, points);
        for (int i = 0; i < face->count; i++) {
            size_t vertex = net->vertices[f][i];
            double u, v, area[3];
            facet_node(face->count, i, &u, &v);
            facet_place(face->count, (const double(*)[3])points, u, v, NULL, area);
            add_scaled3(1.0, area, net->normals[vertex]);
            net->spacing[vertex] += edge / (double)(net->first[vertex + 1] - net->first[vertex]);
        }
    }
    for (size_t i = 0; i < net->vertex_count; i++) {
        double length = norm3(net->normals[i]);
        scale3(length > 0.0 ? 1.0 / length : 0.0, net->normals[i], net->normals[i]);
    }
}

/* if the normals turn by dn over the edge d, a parabola's middle lies dn.d/8 off the chord: leaves
 * out mid nodes that do not */
static void find_straight(const struct solid_mesh *mesh, struct surface *surface, struct net *net)
{
    surface->straight = surface->edges = 0;
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        int corners = surface_face_corners(face);
        for (int i = 0; i < corners; i++) {
            /* an edge: its ends, and the normals there */
            int j = (i + 1) % corners;
            size_t middle = net->vertices[f][corners + i];
            const double *a = net->normals[net->vertices[f][i]];
            const double *b = net->normals[net->vertices[f][j]];
            const double *from = mesh->points[face->nodes[i]], *to = mesh->points[face->nodes[j]];
            /* its mid node's distance from the chord */
            double turn[3], way[3], off[3];
            sub3(b, a, turn);
            sub3(to, from, way);
            for (int k = 0; k < 3; k++)
                off[k] = mesh->points[face->nodes[corners + i]][k] - 0.5 * (from[k] + to[k]);
            /* its distance on a parabola; leave it out if the ground is curved and the edge
             * straight */
            double bend = fabs(dot3(turn, way)) / 8.0;
            bool curved = bend > LEAST_BEND * norm3(way);
            bool straight = curved && norm3(off) < STRAIGHT * bend;
            surface->edges += curved;
            surface->straight += straight;
            net->left_out[middle] = net->left_out[middle] || straight;
        }
    }
}

/* leaves out the middle of a nine-node face with a straight edge */
static void leave_out_middles(const struct surface *surface, struct net *net)
{
    for (size_t f = 0; f < surface->face_count; f++) {
        if (surface->faces[f].count != FACE_QUAD9)
            continue;
        for (int i = 4; i < 8; i++)
            if (net->left_out[net->vertices[f][i]])
                net->left_out[net->vertices[f][8]] = true;
    }
}

/* nodes are half an edge apart, a whole one where mid nodes are left out */
static void net_space(const struct surface *surface, struct net *net)
{
    for (size_t i = 0; i < net->vertex_count; i++) {
        double kept = 0.0, all = 0.0;
        for (size_t k = net->first[i]; k < net->first[i + 1]; k++) {
            const struct surface_face *face = &surface->faces[net->faces[k]];
            int corners = surface_face_corners(face);
            for (int m = corners; m < 2 * corners; m++) {
                kept += !net->left_out[net->vertices[net->faces[k]][m]];
                all += 1.0;
            }
        }
        net->spacing[i] *= 1.0 - 0.5 * kept / all;
    }
}

static void net_free(struct net *net)
{
    free(net->nodes);
    free(net->normals);
    free(net->spacing);
    free(net->left_out);
    free(net->first);
    free(net->faces);
    free(net->vertices);
    memset(net, 0, sizeof *net);
}

/* False: out of memory. Also counts the edges on curved ground and the straight ones among them. */
static bool net_make(const struct solid_mesh *mesh, struct surface *surface, struct net *net)
{
    memset(net, 0, sizeof *net);
    size_t count = count_visits(surface);
    struct visit *visits = malloc(count * sizeof *visits);
    bool done = visits && net_allocate(net, surface->face_count, count);
    if (done) {
        fill_visits(surface, visits);
        qsort(visits, count, sizeof *visits, compare_visits);
        net_number(visits, count, surface->face_count, net);
        net_average(mesh, surface, net);
        find_straight(mesh, surface, net);
        leave_out_middles(surface, net);
        net_space(surface, net);
    } else {
        net_free(net);
    }
    free(visits);
    return done;
}

/* ---- fit of polynomials about each vertex ---- */

enum {
    MOST_TERMS = 15,    /* of a polynomial of fourth order in two variables */
    MOST_SAMPLES = 400, /* an even mesh has some 200 within 4 edges */
    MOST_ORDER = 4
};

/* radii to try, in distances of nodes, until there are enough samples: some 1.5 to 2 edges of an
 * element, 3 to 4 where mid nodes are left out */
static const double RADII[] = {3.0, 3.5, 4.0};
static const size_t ENOUGH = 30;
/* with fewer samples for each term the order is lowered */
static const double SAMPLES_PER_TERM = 1.4;
/* exponent of the weight at the radius: near samples weigh more */
static const double WEIGHT_FALL = 6.0;
/* steeper ground is no function of the tangent plane's coordinates: cos 60 degrees */
static const double STEEPEST_COSINE = 0.5;
/* least pivots of the normal equations over their diagonals. Those of the slopes, which come last,
 * measure the part of a slope that is independent of the higher terms: .1 inside, .001 where the
 * samples are on one side only and the slope would be an extrapolation */
static const double LEAST_PIVOT = 1e-9, LEAST_SLOPE_PIVOT = 1e-2;

/* samples of a fit */
struct fit {
    double frame[3][3]; /* two tangents and the mean normal */
    double radius;      /* m */
    bool through;       /* the surface goes through the node itself */
    size_t count;
    double at[MOST_SAMPLES][3]; /* in the frame, by radius */
};

/* the walk over the net; its memory serves all vertices */
struct walk {
    const struct solid_mesh *mesh;
    const struct net *net;
    size_t *stamps, stamp; /* [vertex_count] */
    size_t *queue;         /* [vertex_count] */
};

/* slopes and second derivatives in the frame, at its origin */
struct shape {
    double slope[2], bend[3]; /* xx, xy, yy; by radius */
};

static void make_frame(const double normal[3], double frame[3][3])
{
    int least = fabs(normal[0]) < fabs(normal[1]) ? 0 : 1;
    least = fabs(normal[2]) < fabs(normal[least]) ? 2 : least;
    double axis[3] = {0.0, 0.0, 0.0};
    axis[least] = 1.0;
    memcpy(frame[2], normal, sizeof frame[2]);
    cross3(normal, axis, frame[0]);
    scale3(1.0 / norm3(frame[0]), frame[0], frame[0]);
    cross3(normal, frame[0], frame[1]);
}

/* collects the vertices within `radius` of the first, from neighbour to neighbour */
static void fit_gather(struct walk *walk, size_t start, double radius, struct fit *fit)
{
    const struct net *net = walk->net;
    const double *origin = walk->mesh->points[net->nodes[start]];
    size_t head = 0, tail = 0;
    fit->count = 0;
    fit->radius = radius;
    fit->through = !net->left_out[start];
    walk->stamps[start] = ++walk->stamp;
    walk->queue[tail++] = start;
    while (head < tail && fit->count < MOST_SAMPLES) {
        size_t vertex = walk->queue[head++];
        double way[3];
        sub3(walk->mesh->points[net->nodes[vertex]], origin, way);
        if (!net->left_out[vertex]) {
            double *at = fit->at[fit->count++];
            for (int k = 0; k < 3; k++)
                at[k] = dot3(fit->frame[k], way) / radius;
        }

        /* its neighbours that are near and not steep */
        for (size_t i = net->first[vertex]; i < net->first[vertex + 1]; i++)
            for (int k = 0; k < FACE_MOST_NODES; k++) {
                size_t next = net->vertices[net->faces[i]][k];
                if (next == SIZE_MAX || walk->stamps[next] == walk->stamp)
                    continue;
                sub3(walk->mesh->points[net->nodes[next]], origin, way);
                if (norm3(way) > radius ||
                    dot3(net->normals[next], fit->frame[2]) < STEEPEST_COSINE)
                    continue;
                walk->stamps[next] = walk->stamp;
                walk->queue[tail++] = next;
            }
    }
}

/* terms by falling degree, slopes last; 1 comes first where the surface does not pass through the
 * node */
static int polynomial_terms(bool through, int order, double x, double y, double *term)
{
    int count = 0;
    if (!through)
        term[count++] = 1.0;
    for (int degree = order; degree >= 1; degree--)
        for (int i = 0; i <= degree; i++) {
            double value = 1.0;
            for (int k = 0; k < degree - i; k++)
                value *= x;
            for (int k = 0; k < i; k++)
                value *= y;
            term[count++] = value;
        }
    return count;
}

/* Cholesky's decomposition of the normal equations and the solution in b; false: they are singular
 */
static bool solve_normal_equations(int n, double (*a)[MOST_TERMS], double *b)
{
    /* L in the lower half of a; the last two terms, the slopes, need larger pivots */
    for (int i = 0; i < n; i++) {
        double diagonal = a[i][i];
        for (int j = 0; j <= i; j++) {
            for (int k = 0; k < j; k++)
                a[i][j] -= a[i][k] * a[j][k];
            if (j < i)
                a[i][j] /= a[j][j];
        }
        if (!(a[i][i] > (i >= n - 2 ? LEAST_SLOPE_PIVOT : LEAST_PIVOT) * diagonal))
            return false;
        a[i][i] = sqrt(a[i][i]);
    }
    /* L y = b */
    for (int i = 0; i < n; i++) {
        for (int k = 0; k < i; k++)
            b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    /* L^T x = y */
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++)
            b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return true;
}

/* least squares, near samples weighing more */
static bool fit_order(const struct fit *fit, int order, struct shape *shape)
{
    double a[MOST_TERMS][MOST_TERMS] = {{0}}, b[MOST_TERMS] = {0}, term[MOST_TERMS];
    /* enough samples for its terms */
    int n = polynomial_terms(fit->through, order, 0.0, 0.0, term);
    if ((double)fit->count < SAMPLES_PER_TERM * n)
        return false;
    /* the normal equations, lower half */
    for (size_t i = 0; i < fit->count; i++) {
        const double *at = fit->at[i];
        double weight = exp(-WEIGHT_FALL * dot3(at, at));
        polynomial_terms(fit->through, order, at[0], at[1], term);
        for (int j = 0; j < n; j++) {
            for (int k = 0; k <= j; k++)
                a[j][k] += weight * term[j] * term[k];
            b[j] += weight * term[j] * at[2];
        }
    }
    /* slopes and second derivatives at the vertex */
    if (!solve_normal_equations(n, a, b))
        return false;
    *shape = (struct shape){{b[n - 2], b[n - 1]}, {0}};
    if (order >= 2)
        memcpy(shape->bend, (double[]){2.0 * b[n - 5], b[n - 4], 2.0 * b[n - 3]},
               sizeof shape->bend);
    return true;
}

/* normal and curvature tensor of z(x, y): II/sqrt(1 + z_x^2 + z_y^2) on the dual of the tangents,
 * convex where z bends down (do Carmo, Differential Geometry of Curves and Surfaces, 3.3) */
static void place_shape(const struct fit *fit, const struct shape *shape,
                        struct surface_point *point)
{
    double p = shape->slope[0], q = shape->slope[1], g = 1.0 + p * p + q * q;
    for (int k = 0; k < 3; k++)
        point->normal[k] =
            (fit->frame[2][k] - p * fit->frame[0][k] - q * fit->frame[1][k]) / sqrt(g);

    /* tangents, their dual vectors */
    double x[3], y[3], dual[2][3];
    for (int k = 0; k < 3; k++) {
        x[k] = fit->frame[0][k] + p * fit->frame[2][k];
        y[k] = fit->frame[1][k] + q * fit->frame[2][k];
        dual[0][k] = ((1.0 + q * q) * x[k] - p * q * y[k]) / g;
        dual[1][k] = ((1.0 + p * p) * y[k] - p * q * x[k]) / g;
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            point->curvature[3 * i + j] =
                -(shape->bend[0] * dual[0][i] * dual[0][j] +
                  shape->bend[1] * (dual[0][i] * dual[1][j] + dual[1][i] * dual[0][j]) +
                  shape->bend[2] * dual[1][i] * dual[1][j]) /
                (sqrt(g) * fit->radius);
}

static double angle_between(const double a[3], const double b[3])
{
    double cross[3];
    cross3(a, b, cross);
    return atan2(norm3(cross), dot3(a, b));
}

/* the highest order that the samples determine, and its difference from the next lower one */
static void fit_vertex(struct walk *walk, size_t vertex, struct fit *fit,
                       struct surface_point *point)
{
    const struct net *net = walk->net;
    /* without a fit: the mean normal, in doubt by pi */
    const double *normal = net->normals[vertex];
    *point = (struct surface_point){.doubt = M_PI};
    memcpy(point->normal, normal, sizeof point->normal);
    if (!(norm3(normal) > 0.0))
        return;
    /* a circle wide enough to hold samples */
    make_frame(normal, fit->frame);
    for (size_t r = 0; r < sizeof RADII / sizeof *RADII; r++) {
        fit_gather(walk, vertex, RADII[r] * net->spacing[vertex], fit);
        if (fit->count >= ENOUGH)
            break;
    }
    /* the highest order */
    struct shape shape, lower;
    int order = MOST_ORDER;
    while (order > 0 && !fit_order(fit, order, &shape))
        order--;
    if (order == 0)
        return;
    place_shape(fit, &shape, point);
    /* and the next lower one */
    if (order > 1 && fit_order(fit, order - 1, &lower)) {
        struct surface_point other;
        place_shape(fit, &lower, &other);
        point->doubt = angle_between(point->normal, other.normal);
    }
}

enum percuss_status surface_fit(const struct solid_mesh *mesh, struct surface *surface,
                                struct fault *fault)
{
    struct net net;
    if (!net_make(mesh, surface, &net))
        return fault_set(fault, PERCUSS_INTERNAL, "surface of %zu faces: out of memory",
                         surface->face_count);
    /* room for a walk from each vertex */
    struct walk walk = {mesh, &net, calloc(net.vertex_count, sizeof *walk.stamps), 0,
                        malloc(net.vertex_count * sizeof *walk.queue)};
    struct surface_point *points = malloc(net.vertex_count * sizeof *points);
    struct fit *fit = malloc(sizeof *fit);
    free(surface->points);
    surface->points = calloc(surface->face_count, sizeof *surface->points);
    enum percuss_status status = PERCUSS_OK;
    /* fit each vertex once, and copy it to its faces */
    if (walk.stamps && walk.queue && points && fit && surface->points) {
        for (size_t i = 0; i < net.vertex_count; i++)
            fit_vertex(&walk, i, fit, &points[i]);
        for (size_t f = 0; f < surface->face_count; f++)
            for (int i = 0; i < surface->faces[f].count; i++)
                surface->points[f][i] = points[net.vertices[f][i]];
    } else {
        status = fault_set(fault, PERCUSS_INTERNAL, "surface of %zu faces: out of memory",
                           surface->face_count);
        free(surface->points);
        surface->points = NULL;
    }
    free(walk.stamps);
    free(walk.queue);
    free(points);
    free(fit);
    net_free(&net);
    return status;
}
