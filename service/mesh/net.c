/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "mesh/net.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/vector.h"

/* an edge bends by L^2/(8R): below this part of its length it is flat ground, or straight on a
 * cylinder where the normals of faces are off by so much */
static const double LEAST_BEND = 2e-3;
/* and is straight where its mid node has less than this part of the bend */
static const double STRAIGHT = 0.1;

/* a node of a face, found again by node and patch */
struct visit {
    size_t node, patch, face;
    int local;
};

static int compare(const void *left, const void *right)
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

static bool take_memory(struct net *net, size_t faces, size_t visits)
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
static void number(const struct visit *visits, size_t count, size_t faces, struct net *net)
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
static double mean_edge(const struct surface_face *face, double (*points)[3])
{
    int corners = face->count == FACE_TRIANGLE6 ? 3 : 4;
    double sum = 0.0;
    for (int i = 0; i < corners; i++) {
        double way[3];
        sub3(points[i], points[(i + 1) % corners], way);
        sum += norm3(way);
    }
    return sum / corners;
}

/* normals weighted by the area about the node */
static void average(const struct solid_mesh *mesh, const struct surface *surface, struct net *net)
{
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        double points[FACE_MOST_NODES][3];
        surface_face_points(mesh, face, points);
        double edge = mean_edge(face, points);
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

/* a parabola whose normals turn by dn over the edge d has its middle dn.d/8 off the chord: mid
 * nodes that have not are left out */
static void find_straight(const struct solid_mesh *mesh, struct surface *surface, struct net *net)
{
    surface->straight = surface->edges = 0;
    for (size_t f = 0; f < surface->face_count; f++) {
        const struct surface_face *face = &surface->faces[f];
        int corners = face->count == FACE_TRIANGLE6 ? 3 : 4;
        for (int i = 0; i < corners; i++) {
            /* an edge: its ends, and the normals there */
            int j = (i + 1) % corners;
            size_t middle = net->vertices[f][corners + i];
            const double *a = net->normals[net->vertices[f][i]];
            const double *b = net->normals[net->vertices[f][j]];
            const double *from = mesh->points[face->nodes[i]], *to = mesh->points[face->nodes[j]];
            /* how far its middle lies off the chord */
            double turn[3], way[3], off[3];
            sub3(b, a, turn);
            sub3(to, from, way);
            for (int k = 0; k < 3; k++)
                off[k] = mesh->points[face->nodes[corners + i]][k] - 0.5 * (from[k] + to[k]);
            /* and how far it should: one that is bent, yet straight, is left out */
            double bend = fabs(dot3(turn, way)) / 8.0;
            bool curved = bend > LEAST_BEND * norm3(way);
            bool straight = curved && norm3(off) < STRAIGHT * bend;
            surface->edges += curved;
            surface->straight += straight;
            net->left_out[middle] = net->left_out[middle] || straight;
        }
    }
}

/* the middle of a nine-node face is no better than its edges */
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
static void space(const struct surface *surface, struct net *net)
{
    for (size_t i = 0; i < net->vertex_count; i++) {
        double kept = 0.0, all = 0.0;
        for (size_t k = net->first[i]; k < net->first[i + 1]; k++) {
            const struct surface_face *face = &surface->faces[net->faces[k]];
            int corners = face->count == FACE_TRIANGLE6 ? 3 : 4;
            for (int m = corners; m < 2 * corners; m++) {
                kept += !net->left_out[net->vertices[net->faces[k]][m]];
                all += 1.0;
            }
        }
        net->spacing[i] *= 1.0 - 0.5 * kept / all;
    }
}

bool net_make(const struct solid_mesh *mesh, struct surface *surface, struct net *net)
{
    memset(net, 0, sizeof *net);
    size_t count = count_visits(surface);
    struct visit *visits = malloc(count * sizeof *visits);
    bool done = visits && take_memory(net, surface->face_count, count);
    if (done) {
        fill_visits(surface, visits);
        qsort(visits, count, sizeof *visits, compare);
        number(visits, count, surface->face_count, net);
        average(mesh, surface, net);
        find_straight(mesh, surface, net);
        leave_out_middles(surface, net);
        space(surface, net);
    } else {
        net_free(net);
    }
    free(visits);
    return done;
}

void net_free(struct net *net)
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
