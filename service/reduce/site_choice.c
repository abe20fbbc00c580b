/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/site_choice.h"

#include <math.h>
#include <stdlib.h>

#include "model/facet.h"
#include "model/vector.h"

/* Flexibilities change like 1/distance from an edge: places near one stand in rows, each this many
 * times as far from it as the last, from as near as they are known out to where they change little
 * (the spacing). */
static const double ROWS = 1.7;
static const double LAST_ROW = 1.5;

/* A place that may be chosen. */
struct candidate {
    size_t face, patch;
    double u, v, point[3];
    double row;      /* logarithm of the distance from the edge, in rows */
    double spacing;  /* wanted about it, m */
    double distance; /* from the nearest chosen place of the patch, in units of the spacing */
};

/* All candidates. */
struct candidates {
    size_t count;
    struct candidate *all;
    double spacing;  /* m */
    double farthest; /* row, m from an edge */
    bool any;        /* candidates nearer to an edge than flexibility is known too */
};

static double row_of(const struct candidates *candidates, const struct flexibility_edges *edges,
                     size_t face, double edge)
{
    double within = fmin(fmax(edge, flexibility_edges_known(edges, face)), candidates->farthest);
    return log(within / candidates->farthest) / log(ROWS);
}

/* middles of the parts when each side of a face is cut in `cuts` */
static size_t part_middles(size_t count, size_t cuts, double at[][2])
{
    size_t filled = 0;
    double step = 1.0 / (double)cuts;
    for (size_t i = 0; i < cuts; i++)
        for (size_t j = 0; j < cuts; j++) {
            double a = ((double)i + 0.5) * step, b = ((double)j + 0.5) * step;
            if (count != FACE_TRIANGLE6) {
                at[filled][0] = 2.0 * a - 1.0;
                at[filled++][1] = 2.0 * b - 1.0;
            } else if (i + j < cuts) {
                at[filled][0] = a - step / 6.0;
                at[filled++][1] = b - step / 6.0;
            }
        }
    return filled;
}

static bool add(struct candidates *candidates, const struct surface_rule *rule,
                const struct flexibility_edges *edges, size_t face, const double at[2])
{
    const struct surface_face *f = &rule->surface->faces[face];
    struct candidate *next = &candidates->all[candidates->count];
    double nodes[FACE_MOST_NODES][3];
    surface_rule_nodes(rule, face, nodes);
    *next = (struct candidate){
        .face = face, .patch = f->patch, .u = at[0], .v = at[1], .distance = INFINITY};
    facet_place(f->count, (const double(*)[3])nodes, at[0], at[1], next->point, NULL);
    double edge = flexibility_edges_distance(edges, f->patch, next->point);
    next->row = row_of(candidates, edges, face, edge);
    next->spacing = candidates->spacing * sqrt(edges->reach[face] / rule->surface->size);
    candidates->count += candidates->any || edge >= flexibility_edges_known(edges, face);
    return edge < candidates->farthest;
}

/* middles of faces, and of their parts near edges; the middles alone where that leaves a patch
 * without any */
static bool collect(struct candidates *candidates, const struct surface_rule *rule,
                    const struct flexibility_edges *edges)
{
    enum { CUTS = 4 };
    /* parts of one face, and which patches have a place */
    const struct surface *surface = rule->surface;
    double parts[CUTS * CUTS][2], whole[1][2];
    bool *served = calloc(surface->patch_count, sizeof *served);
    candidates->all = malloc(CUTS * CUTS * surface->face_count * sizeof *candidates->all);
    if (!served || !candidates->all) {
        free(served);
        return false;
    }
    /* away from edges first; then, in patches without any, at any distance */
    for (int pass = 0; pass < 2; pass++) {
        candidates->any = pass > 0;
        for (size_t f = 0; f < surface->face_count; f++) {
            const struct surface_face *face = &surface->faces[f];
            if (pass == 1 && served[face->patch])
                continue;
            /* the middle; near an edge, the parts instead */
            size_t before = candidates->count;
            part_middles(face->count, 1, whole);
            if (add(candidates, rule, edges, f, whole[0])) {
                candidates->count = before;
                size_t count = part_middles(face->count, pass == 0 ? CUTS : 1, parts);
                for (size_t i = 0; i < count; i++)
                    add(candidates, rule, edges, f, parts[i]);
            }
        }
        /* which patches that served */
        for (size_t i = 0; i < candidates->count; i++)
            served[candidates->all[i].patch] = true;
    }
    free(served);
    return true;
}

static void choose(struct candidates *candidates, const struct surface_rule *rule,
                   const struct flexibility_edges *edges, const struct flexibility_place *place)
{
    size_t patch = rule->surface->faces[place->face].patch;
    double row = row_of(candidates, edges, place->face, place->edge);
    for (size_t i = 0; i < candidates->count; i++) {
        struct candidate *c = &candidates->all[i];
        if (c->patch != patch)
            continue;
        double offset[3];
        sub3(c->point, place->load.point, offset);
        c->distance = fmin(c->distance, hypot(norm3(offset) / c->spacing, c->row - row));
    }
}

struct flexibility_place *site_choice_make(const struct site_choice *choice,
                                           const struct surface_rule *rule,
                                           const struct flexibility_edges *edges, size_t *count,
                                           double *spacing)
{
    struct candidates candidates = {.spacing = choice->spacing,
                                    .farthest = LAST_ROW * choice->spacing};
    size_t room = choice->wanted_count + choice->most;
    struct flexibility_place *places = malloc((room + 1) * sizeof *places);
    *count = 0;
    if (!places || !collect(&candidates, rule, edges)) {
        free(places);
        free(candidates.all);
        return NULL;
    }
    for (; *count < choice->wanted_count; (*count)++) {
        places[*count] = choice->wanted[*count];
        choose(&candidates, rule, edges, &places[*count]);
    }

    /* the farthest one, again and again (Gonzalez 1985): twice as many as the best choice at most
     */
    for (;;) {
        struct candidate *farthest = &candidates.all[0];
        for (size_t i = 1; i < candidates.count; i++)
            if (candidates.all[i].distance > farthest->distance)
                farthest = &candidates.all[i];
        *spacing = choice->spacing * fmax(farthest->distance, 1.0);
        if (farthest->distance <= 1.0 || *count >= choice->most)
            break;
        places[*count] =
            flexibility_place_make(rule, edges, farthest->face, farthest->u, farthest->v);
        choose(&candidates, rule, edges, &places[*count]);
        farthest->distance = 0.0; /* one that was moved would be chosen for ever */
        (*count)++;
    }
    free(candidates.all);
    return places;
}
