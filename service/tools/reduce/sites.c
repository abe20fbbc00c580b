/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/sites.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "model/facet.h"
#include "model/vector.h"
#include "reduce/forked.h"
#include "reduce/rates.h"
#include "reduce/site_faces.h"

/* ---- the choice of sites: places all over a surface, evenly far from each other ---- */

/* Flexibilities change like 1/distance from an edge: places near one stand in rows, each this many
 * times as far from it as the last, from as near as they are known out to where they change little
 * (the spacing). */
static const double ROWS = 1.7;
static const double LAST_ROW = 1.5;

struct site_choice {
    double spacing; /* m: no place of a patch is farther than this from a chosen one, nor, near a
                     * sharp edge, twice as far from that or half ... */
    size_t most;    /* ... unless so many are chosen */
    size_t wanted_count;
    const struct flexibility_place *wanted; /* these in any case */
};

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

static double edge_row_of(const struct candidates *candidates,
                          const struct flexibility_edges *edges, size_t face, double edge)
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

static bool add_candidate(struct candidates *candidates, const struct surface_rule *rule,
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
    next->row = edge_row_of(candidates, edges, face, edge);
    next->spacing = candidates->spacing * sqrt(edges->reach[face] / rule->surface->size);
    candidates->count += candidates->any || edge >= flexibility_edges_known(edges, face);
    return edge < candidates->farthest;
}

/* middles of faces, and of their parts near edges; the middles alone where that leaves a patch
 * without any */
static bool collect_candidates(struct candidates *candidates, const struct surface_rule *rule,
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
            if (add_candidate(candidates, rule, edges, f, whole[0])) {
                candidates->count = before;
                size_t count = part_middles(face->count, pass == 0 ? CUTS : 1, parts);
                for (size_t i = 0; i < count; i++)
                    add_candidate(candidates, rule, edges, f, parts[i]);
            }
        }
        /* which patches that served */
        for (size_t i = 0; i < candidates->count; i++)
            served[candidates->all[i].patch] = true;
    }
    free(served);
    return true;
}

static void choose_place(struct candidates *candidates, const struct surface_rule *rule,
                         const struct flexibility_edges *edges,
                         const struct flexibility_place *place)
{
    size_t patch = rule->surface->faces[place->face].patch;
    double row = edge_row_of(candidates, edges, place->face, place->edge);
    for (size_t i = 0; i < candidates->count; i++) {
        struct candidate *c = &candidates->all[i];
        if (c->patch != patch)
            continue;
        double offset[3];
        sub3(c->point, place->load.point, offset);
        c->distance = fmin(c->distance, hypot(norm3(offset) / c->spacing, c->row - row));
    }
}

/* Chosen places, one array to be freed; `*spacing` becomes the spacing reached far from edges.
 * NULL: no memory. */
static struct flexibility_place *site_choice_make(const struct site_choice *choice,
                                                  const struct surface_rule *rule,
                                                  const struct flexibility_edges *edges,
                                                  size_t *count, double *spacing)
{
    struct candidates candidates = {.spacing = choice->spacing,
                                    .farthest = LAST_ROW * choice->spacing};
    size_t room = choice->wanted_count + choice->most;
    struct flexibility_place *places = malloc((room + 1) * sizeof *places);
    *count = 0;
    if (!places || !collect_candidates(&candidates, rule, edges)) {
        free(places);
        free(candidates.all);
        return NULL;
    }
    for (; *count < choice->wanted_count; (*count)++) {
        places[*count] = choice->wanted[*count];
        choose_place(&candidates, rule, edges, &places[*count]);
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
        choose_place(&candidates, rule, edges, &places[*count]);
        farthest->distance = 0.0; /* one that was moved would be chosen for ever */
        (*count)++;
    }
    free(candidates.all);
    return places;
}

/* ---- the flexibility at them ---- */

/* of the mesh's edges: closer sites gain nothing that the mesh knows, wider ones lose a percent */
static const double SPACING = 1.4;
static const double CUT = 0.1;
/* the surface that comes back over a site nearer than so many edges of the mesh leaves tractions
 * that the mesh cannot take */
static const double LEAST_REACH = 0.35;
/* of the spacing: responses between nearer places rise like 1/distance between sites */
static const double NEAR = 3.0;

/* state of the search */
struct sites {
    const struct sites_task *task;
    struct flexibility *flexibility;
    struct flexibility_place *places;
    size_t count;
    double *values;       /* [count], m/N at the cut; NAN: not known */
    double (*tensors)[6]; /* [count], the same between all directions */
    float *between;       /* [count][count], row: the moved site; NULL: not wanted */
    double cut;
};

static void sites_free(struct sites *sites)
{
    flexibility_free(sites->flexibility);
    free(sites->places);
    free(sites->values);
    free(sites->tensors);
    free(sites->between);
}

/* the surface's own, by its fit, at a place */
static void curvature_at(const struct surface *surface, const struct flexibility_place *place,
                         double curvature[9])
{
    const struct surface_face *face = &surface->faces[place->face];
    double shape[FACE_MOST_NODES];
    facet_shape(face->count, place->u, place->v, shape, NULL, NULL);
    memset(curvature, 0, 9 * sizeof *curvature);
    for (size_t n = 0; n < face->count; n++)
        for (int k = 0; k < 9; k++)
            curvature[k] += shape[n] * surface->points[place->face][n].curvature[k];
}

/* the places nearest to the points asked for; NULL: no memory */
static struct flexibility_place *exact_places(const struct sites *sites)
{
    const struct sites_task *task = sites->task;
    struct flexibility_place *places = malloc((task->exact_count + 1) * sizeof *places);
    for (size_t i = 0; places && i < task->exact_count; i++) {
        struct surface_place at = surface_near(task->body.mesh, task->body.surface, task->exact[i]);
        places[i] = flexibility_place_make(flexibility_rule(sites->flexibility),
                                           flexibility_edges(sites->flexibility), at.face,
                                           at.foot.u, at.foot.v);
        places[i].loads = FLEXIBILITY_LOADS;
    }
    return places;
}

/* sites that were asked for, and others between */
static enum percuss_status choose_sites(struct sites *sites, double *spacing, struct fault *fault)
{
    const struct sites_task *task = sites->task;
    const struct flexibility_body *body = &task->body;
    const struct surface_rule *rule = flexibility_rule(sites->flexibility);
    const struct flexibility_edges *edges = flexibility_edges(sites->flexibility);
    struct flexibility_place *wanted = exact_places(sites);
    if (wanted) {
        /* others between, at that spacing */
        struct site_choice choice = {task->spacing > 0.0 ? task->spacing
                                                         : SPACING * body->surface->size,
                                     task->most, task->exact_count, wanted};
        sites->places = site_choice_make(&choice, rule, edges, &sites->count, spacing);
        for (size_t i = 0; i < sites->count; i++)
            sites->places[i].loads = FLEXIBILITY_LOADS;
        free(wanted);
    }
    /* room for the answers */
    sites->values = malloc((sites->count + 1) * sizeof *sites->values);
    sites->tensors = malloc((sites->count + 1) * sizeof *sites->tensors);
    if (task->between)
        sites->between = malloc((sites->count * sites->count + 1) * sizeof *sites->between);
    if (!sites->places || !sites->values || !sites->tensors || (task->between && !sites->between))
        return pace_fault(fault, PERCUSS_INTERNAL);
    return PERCUSS_OK;
}

/* flexibility for a contact of the radius `cut` from that at the face's own radius */
static double at_cut(const struct sites *sites, const struct flexibility_place *place,
                     struct flexibility_answer *answer)
{
    double young = place->load.young, poisson = place->load.poisson, curvature[9];
    double narrower = log(answer->radius / sites->cut);
    curvature_at(sites->task->body.surface, place, curvature);
    double mean = 0.5 * (curvature[0] + curvature[4] + curvature[8]);
    cerruti3_add_slope(young, poisson, place->load.inward, curvature, narrower, answer->tensor);
    cerruti3_add_contact(young, poisson, place->load.inward, curvature, answer->tensor);
    return answer->value + flexibility_of_contact(young, poisson, mean) +
           flexibility_slope(young, poisson, mean) * narrower;
}

/* of the wall: elements with which flexibility is good to 2 % (flexibility_place_thin) */
static const double GOOD_ELEMENT = 1.5;

/* how many places are on walls too thin for the mesh, and the thinnest that wants finer elements */
static void look_at_walls(const struct sites *sites, struct sites_report *report)
{
    report->thin = 0;
    report->thinnest = INFINITY;
    for (size_t i = 0; i < sites->count; i++) {
        const struct flexibility_place *place = &sites->places[i];
        report->thin += flexibility_place_thin(place);
        if (GOOD_ELEMENT * place->wall < place->element)
            report->thinnest = fmin(report->thinnest, place->wall);
    }
}

/* what blocks of sites compute, in memory that processes share */
struct blocks {
    struct sites *sites;
    double *values, *imbalances; /* [count] */
    double (*tensors)[6];        /* [count] */
    float *between; /* [count][count], a row for each that is solved; NULL: not wanted */
};

/* Places solved for together. */
enum { BLOCK = FLEXIBILITY_BLOCK / FLEXIBILITY_LOADS };

/* One block: values at the cut, unknown where the elements are too coarse, and responses at the
 * other sites. */
static enum percuss_status solve_block(void *context, size_t block, struct fault *fault)
{
    const struct blocks *blocks = context;
    const struct sites *sites = blocks->sites;
    struct flexibility_answer answers[BLOCK];
    double least = LEAST_REACH * sites->task->body.surface->size;
    size_t first = block * BLOCK, left = sites->count - first;
    size_t count = left < BLOCK ? left : BLOCK;
    const struct flexibility_place *places = sites->places + first;
    enum percuss_status status =
        flexibility_solve(sites->flexibility, count, places, answers, fault);
    for (size_t c = 0; c < count && status == PERCUSS_OK; c++) {
        bool massive = flexibility_place_massive(&places[c], sites->task->body.mesh);
        double value = massive ? NAN : at_cut(sites, &places[c], &answers[c]);
        bool known = places[c].load.reach >= least && !flexibility_place_thin(&places[c]) &&
                     !isnan(answers[c].tensor[0]);
        blocks->values[first + c] = known ? value : NAN;
        memcpy(blocks->tensors[first + c], answers[c].tensor, sizeof answers[c].tensor);
        blocks->imbalances[first + c] = answers[c].imbalance;
        for (size_t i = 0; blocks->between && i < sites->count; i++)
            blocks->between[(first + c) * sites->count + i] =
                (float)(i == first + c
                            ? value
                            : flexibility_response(sites->flexibility, c, &sites->places[i]));
    }
    return status;
}

/* the results of all blocks, the responses turned: a column for each site that is solved */
static void take_blocks(const struct blocks *blocks, struct sites_report *report)
{
    struct sites *sites = blocks->sites;
    size_t count = sites->count;
    for (size_t c = 0; c < count; c++) {
        sites->values[c] = blocks->values[c];
        memcpy(sites->tensors[c], blocks->tensors[c], sizeof sites->tensors[c]);
        report->imbalance = fmax(report->imbalance, blocks->imbalances[c]);
        for (size_t i = 0; blocks->between && i < count; i++)
            sites->between[i * count + c] = blocks->between[c * count + i];
    }
}

/* all sites, a block at a time */
static enum percuss_status solve_sites(struct sites *sites, struct sites_report *report,
                                       struct fault *fault)
{
    size_t count = sites->count, values = 8 * count * sizeof(double);
    size_t bytes = values + (sites->between ? count * count * sizeof *sites->between : 0) + 1;
    double *memory = forked_memory(bytes);
    if (!memory)
        return pace_fault(fault, PERCUSS_INTERNAL);
    struct blocks blocks = {.sites = sites,
                            .values = memory,
                            .imbalances = memory + count,
                            .tensors = (double(*)[6])(memory + 2 * count),
                            .between = sites->between ? (float *)(memory + 8 * count) : NULL};
    const struct forked_work work = {.parts = (count + BLOCK - 1) / BLOCK,
                                     .processes = sites->task->processes,
                                     .part = solve_block,
                                     .context = &blocks,
                                     .watch = sites->task->watch};
    enum percuss_status status = forked_run(&work, fault);
    if (status == PERCUSS_OK)
        take_blocks(&blocks, report);
    forked_memory_free(memory, bytes);
    return status;
}

/* a response and its reciprocal are one: their mean; the largest difference where they are far
 * enough from each other to matter */
static double make_symmetric(struct sites *sites, double near_it)
{
    double largest = 0.0;
    for (size_t i = 0; sites->between && i < sites->count; i++)
        for (size_t j = 0; j < i; j++) {
            float *a = &sites->between[i * sites->count + j];
            float *b = &sites->between[j * sites->count + i];
            double offset[3];
            sub3(sites->places[i].load.point, sites->places[j].load.point, offset);
            bool kept = !isnan(sites->values[i]) && !isnan(sites->values[j]);
            if (norm3(offset) >= near_it && kept)
                largest = fmax(largest, fabs((double)*a - (double)*b));
            *a = *b = 0.5f * (*a + *b);
        }
    return largest;
}

/* A removed mode's displacement at a place, over its frequency: along the inward normal, and in the
 * mesh's frame. */
static double mode_at(const struct sites *sites, size_t mode, size_t place, double moved[3])
{
    const struct flexibility_place *at = &sites->places[place];
    double omega = sites->task->body.omega[mode], parts[FLEXIBILITY_LOADS];
    memset(moved, 0, 3 * sizeof *moved);
    for (int load = 0; load < FLEXIBILITY_LOADS; load++) {
        parts[load] = flexibility_mode(sites->flexibility, mode, at, load) / omega;
        add_scaled3(parts[load], flexibility_place_direction(at, load), moved);
    }
    return parts[0];
}

/* Gives the mode back to the values along the normal alone. */
static void give_back_value(struct sites *sites, size_t mode)
{
    for (size_t i = 0; i < sites->count; i++) {
        double moved[3], shape = mode_at(sites, mode, i, moved);
        sites->values[i] += shape * shape;
    }
}

/* Gives the mode back to values and responses: it is no longer removed. `shape`: room, [count]. */
static void give_back(struct sites *sites, size_t mode, double *shape)
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};
    for (size_t i = 0; i < sites->count; i++) {
        double moved[3];
        shape[i] = mode_at(sites, mode, i, moved);
        for (int k = 0; k < 6; k++)
            sites->tensors[i][k] += moved[ROW[k]] * moved[COLUMN[k]];
    }
    for (size_t i = 0; i < sites->count; i++) {
        sites->values[i] += shape[i] * shape[i];
        for (size_t j = 0; sites->between && j < sites->count; j++)
            sites->between[i * sites->count + j] += (float)(shape[i] * shape[j]);
    }
}

/* The field of the values as they are; with the tensors where `along`. */
static enum percuss_status make_field(const struct sites *sites, bool along, double spacing,
                                      struct site_field *field, struct fault *fault)
{
    bool made =
        site_field_make(field, flexibility_rule(sites->flexibility),
                        flexibility_edges(sites->flexibility), sites->count, sites->places,
                        sites->values, along ? (const double(*)[6])sites->tensors : NULL, spacing);
    return made ? PERCUSS_OK : pace_fault(fault, PERCUSS_INTERNAL);
}

/* How good it is: each site from its neighbours alone. */
static void measure_field(const struct sites *sites, const struct site_field *field,
                          struct sites_report *report)
{
    double sum = 0.0, inside = 0.0;
    report->unknown = 0;
    report->largest_error = 0.0;
    for (size_t i = 0; i < sites->count; i++) {
        double error = fabs(site_field_error(field, i));
        report->unknown += isnan(sites->values[i]);
        if (isnan(error))
            continue;
        report->largest_error = fmax(report->largest_error, error);
        /* the usual error: away from edges */
        if (sites->places[i].edge > report->spacing) {
            sum += error * error;
            inside += 1.0;
        }
    }
    report->usual_error = inside > 0.0 ? sqrt(sum / inside) : report->largest_error;
}

/* The report with as many modes removed as suits the interpolation best, found by the values along
 * the normal alone, which it leaves changed. */
static enum percuss_status seek_smoothest(struct sites *sites, struct sites_report *report,
                                          struct fault *fault)
{
    enum { TRIALS = 12 };
    size_t most = sites->task->body.removed, step = most / TRIALS + 1;
    struct sites_report best = *report;
    struct site_field field;
    best.usual_error = INFINITY;
    enum percuss_status status = make_field(sites, false, report->spacing, &field, fault);
    for (size_t removed = most; status == PERCUSS_OK;) {
        struct sites_report now = *report;
        now.removed = removed;
        measure_field(sites, &field, &now);
        if (now.usual_error < best.usual_error)
            best = now;
        if (removed == 0)
            break;
        for (size_t i = 0; i < step && removed > 0; i++)
            give_back_value(sites, --removed);
        if (!site_field_refit(&field, sites->values))
            status = pace_fault(fault, PERCUSS_INTERNAL);
    }
    if (status == PERCUSS_OK)
        *report = best;
    site_field_free(&field);
    return status;
}

/* The field of all sites with as many modes removed as suits its interpolation best. */
static enum percuss_status smoothen(struct sites *sites, struct site_field *field,
                                    struct sites_report *report, struct fault *fault)
{
    size_t count = sites->count;
    double *spare = malloc((count + 1) * sizeof *spare);
    if (!spare)
        return pace_fault(fault, PERCUSS_INTERNAL);
    memcpy(spare, sites->values, count * sizeof *spare);
    enum percuss_status status = seek_smoothest(sites, report, fault);
    if (status == PERCUSS_OK) {
        memcpy(sites->values, spare, count * sizeof *spare);
        for (size_t mode = sites->task->body.removed; mode > report->removed; mode--)
            give_back(sites, mode - 1, spare);
        status = make_field(sites, true, report->spacing, field, fault);
    }
    if (status == PERCUSS_OK)
        measure_field(sites, field, report);
    free(spare);
    return status;
}

/* Rows and columns of the sites that are kept, moved to the front; `kept` ascends. */
static void keep_between(struct sites *sites, size_t count, const size_t *kept)
{
    for (size_t a = 0; sites->between && a < count; a++)
        for (size_t b = 0; b < count; b++)
            sites->between[a * count + b] = sites->between[kept[a] * sites->count + kept[b]];
}

/* Sites and the responses between them, which the body takes over; not those with forces out
 * of balance, as responses to them would be too. */
static enum percuss_status hand_over(struct sites *sites, struct mesh_body *body,
                                     struct fault *fault)
{
    size_t count = sites->count;
    size_t *kept = malloc((count + 1) * sizeof *kept);
    body->site_count = 0;
    body->site_face = malloc((count + 1) * sizeof *body->site_face);
    body->site_point = malloc((count + 1) * sizeof *body->site_point);
    body->site_normal = malloc((count + 1) * sizeof *body->site_normal);
    if (!kept || !body->site_face || !body->site_point || !body->site_normal) {
        free(kept);
        return pace_fault(fault, PERCUSS_INTERNAL);
    }
    /* the places */
    for (size_t i = 0; i < count; i++) {
        size_t at = body->site_count;
        if (sites->between && isnan(sites->between[i * (count + 1)]))
            continue;
        body->site_face[at] = (unsigned)sites->places[i].face;
        sub3(sites->places[i].load.point, body->centre, body->site_point[at]);
        scale3(-1.0, sites->places[i].load.inward, body->site_normal[at]);
        kept[body->site_count++] = i;
    }
    /* and between them */
    keep_between(sites, body->site_count, kept);
    body->between = sites->between;
    sites->between = NULL;
    free(kept);
    return PERCUSS_OK;
}

/* Places that a sample is taken at, all over the surface. */
enum { SAMPLES = 8 };

static size_t sample_place(const struct sites *sites, size_t sample)
{
    return sample * sites->count / SAMPLES;
}

/* Seconds for the integrals of one place; the first finds no memory in the caches. */
static double sample_integrals(const struct sites *sites)
{
    flexibility_integrate(sites->flexibility, &sites->places[0]);
    double start = rates_clock();
    for (size_t i = 0; i < SAMPLES; i++)
        flexibility_integrate(sites->flexibility, &sites->places[sample_place(sites, i)]);
    return (rates_clock() - start) / SAMPLES;
}

/* Seconds for the interpolation between sites, with a field of zeros: two are made of it, the
 * second of which says all that is wanted at the nodes. */
static enum percuss_status sample_faces(struct sites *sites, double spacing, double *seconds,
                                        struct fault *fault)
{
    struct site_field field;
    double start = rates_clock(), numbers[SITE_FIELD_NUMBERS];
    memset(sites->values, 0, sites->count * sizeof *sites->values);
    memset(sites->tensors, 0, sites->count * sizeof *sites->tensors);
    enum percuss_status status = make_field(sites, true, spacing, &field, fault);
    if (status != PERCUSS_OK)
        return status;
    *seconds = 2.0 * (rates_clock() - start);
    start = rates_clock();
    for (size_t i = 0; i < SAMPLES; i++) {
        size_t at = sample_place(sites, i);
        site_field_at(&field, field.faces[at], field.points[at], field.normals[at], numbers);
    }
    *seconds += (rates_clock() - start) / SAMPLES *
                (double)site_faces_points(&field, flexibility_rule(sites->flexibility));
    site_field_free(&field);
    return PERCUSS_OK;
}

enum percuss_status sites_sample(const struct sites_task *task, struct sites_sample *sample,
                                 struct fault *fault)
{
    struct sites_task bare = *task;
    struct sites sites = {.task = &bare};
    double spacing;
    bare.body.rigid_count = bare.body.removed = 0;
    bare.between = false;
    *sample = (struct sites_sample){0};
    sites.flexibility = flexibility_make(&bare.body);
    enum percuss_status status = sites.flexibility ? choose_sites(&sites, &spacing, fault)
                                                   : pace_fault(fault, PERCUSS_INTERNAL);
    if (status == PERCUSS_OK && sites.count > 0) {
        sample->count = sites.count;
        sample->seconds = sample_integrals(&sites);
        status = sample_faces(&sites, spacing, &sample->faces, fault);
    }
    sites_free(&sites);
    return status;
}

enum percuss_status sites_find(const struct sites_task *task, struct mesh_body *body,
                               struct sites_report *report, struct fault *fault)
{
    struct sites sites = {.task = task};
    struct site_field field = {0};
    *report = (struct sites_report){0};
    sites.cut = task->cut > 0.0 ? task->cut : CUT * task->body.surface->size;
    sites.flexibility = flexibility_make(&task->body);
    enum percuss_status status = PERCUSS_INTERNAL;
    if (!sites.flexibility) {
        pace_fault(fault, status);
        goto done;
    }

    /* values at the sites */
    status = choose_sites(&sites, &report->spacing, fault);
    if (status != PERCUSS_OK)
        goto done;
    report->count = sites.count;
    look_at_walls(&sites, report);
    status = solve_sites(&sites, report, fault);
    if (status != PERCUSS_OK)
        goto done;
    body->near = NEAR * report->spacing;
    report->asymmetry = make_symmetric(&sites, body->near);

    /* and everywhere */
    status = smoothen(&sites, &field, report, fault);
    if (status != PERCUSS_OK)
        goto done;
    body->cut = sites.cut;
    body->removed = report->removed;
    status = site_faces_fill(&field, flexibility_rule(sites.flexibility), body, fault);
    if (status == PERCUSS_OK) {
        report->withdrawn = site_faces_check(&field, flexibility_rule(sites.flexibility), body);
        status = hand_over(&sites, body, fault);
    }

done:
    site_field_free(&field);
    sites_free(&sites);
    return status;
}

/* ---- sites by themselves ---- */

/* Of an element: nearer to an edge a solution is off by more than answers allow for there
 * (NEAR_MESH_EDGE of solve/error). */
static const double EDGE_KNOWN = 0.1;
/* A contact's own compliance, Hertz's pressure on a half-space, is 3/5 (1 - nu^2) / (E radius). */
static const double HERTZ_MEAN = 0.6;

/* Takes the first `removed` modes out of a flexibility between all directions, and of that along
 * `inward`: those that a reader of the body adds again, single precision included. */
static void remove_modes(const struct mesh_body *body, const struct flexibility_place *place,
                         double *value, double tensor[6])
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2}, COLUMN[6] = {0, 1, 2, 1, 2, 0};
    const struct mesh_body_face *face = &body->faces[place->face];
    double shape[FACE_MOST_NODES];
    facet_shape(face->count, place->u, place->v, shape, NULL, NULL);
    for (size_t mode = 0; mode < body->removed; mode++) {
        double moved[3] = {0.0}, along;
        for (int n = 0; n < face->count; n++)
            for (size_t k = 0; k < 3; k++)
                moved[k] +=
                    shape[n] *
                    (double)body->shapes[(3 * face->nodes[n] + k) * body->mode_count + mode];
        scale3(1.0 / body->omega[mode], moved, moved);
        along = dot3(moved, place->load.inward);
        *value -= along * along;
        for (int k = 0; k < 6; k++)
            tensor[k] -= moved[ROW[k]] * moved[COLUMN[k]];
    }
}

/* Whether a contact as narrow as `cut` has a compliance in all directions. */
static bool is_tensor_possible(const struct mesh_body *body, const struct mesh_body_site *site)
{
    struct mesh_body_face face = body->faces[site->face];
    for (int k = 0; k < 6; k++)
        face.tensor[0][k] = (float)site->tensor[k];
    return mesh_body_tensor_possible(body, &face, 0);
}

/* The reason why the flexibility cannot be had at a place; NULL: it can. */
static const char *why_unknown(const struct sites *sites, size_t i)
{
    static const char EDGE[] = "the mesh is too coarse so near to an edge";
    const struct flexibility_place *place = &sites->places[i];
    const struct boussinesq3 *load = &place->load;
    if (flexibility_place_thin(place))
        return "its wall is thinner than 0.4 of an element";
    if (place->load.reach < LEAST_REACH * sites->task->body.surface->size)
        return "the surface comes back over it within a third of an element";
    if (flexibility_place_massive(place, sites->task->body.mesh))
        return "a mass stands on a node within an element";
    if (place->edge < EDGE_KNOWN * place->element)
        return EDGE;
    if (isnan(sites->values[i]))
        return "the mesh's forces do not balance there";
    /* half the distance from an edge is the widest contact */
    double own =
        HERTZ_MEAN * (1.0 - load->poisson * load->poisson) / (load->young * 0.5 * place->edge);
    bool near = place->edge < sites->task->body.surface->size;
    return near && sites->values[i] < -own ? EDGE : NULL;
}

static void tell_alone(const struct sites *sites, const struct mesh_body *body, size_t i,
                       struct site_alone *alone)
{
    const struct sites_task *task = sites->task;
    const struct flexibility_place *place = &sites->places[i];
    struct mesh_body_site *site = &alone->site;
    struct surface_place foot = surface_near(task->body.mesh, task->body.surface, task->exact[i]);
    double apart[3];
    sub3(place->load.point, foot.foot.point, apart);
    alone->aside = norm3(apart);
    site->face = (unsigned)foot.face;
    sub3(foot.foot.point, body->centre, site->point);
    site->flexibility = sites->values[i];
    memcpy(site->tensor, sites->tensors[i], sizeof site->tensor);
    remove_modes(body, place, &site->flexibility, site->tensor);
    sites->values[i] = site->flexibility;
    alone->unknown = why_unknown(sites, i);
    bool tensor = !alone->unknown && is_tensor_possible(body, site);
    if (alone->unknown)
        site->flexibility = NAN;
    for (int k = 0; k < 6 && !tensor; k++)
        site->tensor[k] = NAN;
}

enum percuss_status sites_solve_alone(const struct sites_task *task, const struct mesh_body *body,
                                      struct site_alone *alone, struct fault *fault)
{
    struct sites sites = {.task = task, .count = task->exact_count, .cut = body->cut};
    struct sites_report report = {0};
    enum percuss_status status = PERCUSS_OK;
    sites.flexibility = flexibility_make(&task->body);
    sites.places = sites.flexibility ? exact_places(&sites) : NULL;
    sites.values = malloc((sites.count + 1) * sizeof *sites.values);
    sites.tensors = malloc((sites.count + 1) * sizeof *sites.tensors);
    if (!sites.places || !sites.values || !sites.tensors)
        status = pace_fault(fault, PERCUSS_INTERNAL);
    if (!status)
        status = solve_sites(&sites, &report, fault);
    for (size_t i = 0; !status && i < sites.count; i++)
        tell_alone(&sites, body, i, &alone[i]);
    sites_free(&sites);
    return status;
}

void sites_leave(const struct flexibility_body *from, size_t removed, struct mesh_body *body)
{
    body->cut = CUT * from->surface->size;
    body->removed = removed;
    body->all_ways = true;
    for (size_t f = 0; f < body->face_count; f++) {
        struct mesh_body_face *face = &body->faces[f];
        const struct material *material = &from->mesh->part[from->surface->faces[f].part].material;
        for (int n = 0; n < face->count; n++) {
            face->flexibility[n] = NAN;
            face->flexibility_slope[n] =
                flexibility_slope(material->young, material->poisson,
                                  site_faces_curvature(&from->surface->points[f][n]));
            for (int k = 0; k < 6; k++)
                face->tensor[n][k] = NAN;
        }
    }
}
