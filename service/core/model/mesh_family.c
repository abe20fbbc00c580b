/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/mesh_family.h"

#include <math.h>
#include <string.h>

#include "base/vector_clones.h"
#include "model/boussinesq3.h"
#include "model/mesh_surface.h"
#include "model/modal_basis.h"
#include "model/ritz.h"
#include "model/site.h"
#include "model/vector.h"

/* Modes beyond the file's: sum phi^2/omega^4 of an octave falls with the frequency as omega^-p,
 * p = 3 where modes are evenly spaced (bars), 2 for waves in a plate, 1 in a compact solid, where
 * the contact law has the fastest part. With 2 the octaves to come add up to this share of
 * the last one. */
static const double TAIL = 1.0 / 3.0;
static const double OCTAVE = 0.5;
/* Parts of a force as small as this do not act (modal_basis.h): shapes are floats. */
static const double LEAST_PART = 1e-9;
/* Modes that are summed at once. */
enum { AT_ONCE = 64 };

/* Over a file's body, or over a box of modulus, density and longest side 1. */
struct mesh_ratio mesh_ratio_of(const struct body *body)
{
    if (!body->mesh) {
        struct ritz_shape shape;
        body->kind->box(body, &shape);
        double longest = fmax(shape.side[0], fmax(shape.side[1], shape.side[2]));
        return (struct mesh_ratio){body->material.young, body->material.density, longest};
    }
    const struct material *file = &body->mesh->materials[0];
    return (struct mesh_ratio){body->material.young / file->young,
                               body->material.density / file->density, body->scale};
}

double mesh_ratio_flexibility(const struct body *body)
{
    struct mesh_ratio ratio = mesh_ratio_of(body);
    return 1.0 / (ratio.young * ratio.size);
}

void mesh_family_load(const struct body *body, const struct site *site, const double direction[3],
                      bool tangential, struct site_load *load)
{
    struct family_load *family = &load->family[0];
    (void)tangential;
    if (!body_is_flexible(body))
        return;
    double longest = mesh_ratio_of(body).size;
    family->acts = true;
    family->mesh.axis = RITZ_ROUND;
    for (int d = 0; d < 3; d++) {
        family->mesh.direction[d] = direction[d];
        family->mesh.point[d] = site->point[d] / longest;
        /* a face across an axis: the others of a cylinder are its side */
        if (fabs(site->outward[d]) > 0.5 && (d == 0 || !(body->radius > 0.0))) {
            family->mesh.axis = d;
            family->mesh.side = site->outward[d] > 0.0 ? 1 : -1;
        }
    }
}

const char *mesh_family_theory(const struct body *body)
{
    (void)body;
    return "ritz";
}

bool mesh_family_box(const struct body *body, struct ritz_shape *shape)
{
    const double *size = body->size;
    *shape = (struct ritz_shape){.side = {size[0], size[1], size[2]}};
    for (int end = 0; end < 2; end++)
        shape->held[end] = body->supports[end] == SUPPORT_CLAMPED;
    return ritz_reaches(shape);
}

static size_t mesh_family_most(const struct body *body)
{
    if (!body->ritz && !body->mesh) /* a box that stays rigid */
        return 0;
    return body->ritz ? ritz_mode_count(body->ritz) : body->mesh->mode_count;
}

static const double *frequencies(const struct body *body)
{
    if (!body->ritz && !body->mesh)
        return NULL;
    return body->ritz ? ritz_omega(body->ritz) : body->mesh->omega;
}

/* Lengths grow by s, moduli by e, densities by d: omega by sqrt(e/d)/s. */
static void mesh_family_find(const struct body *body, struct modal_family *modes)
{
    struct mesh_ratio ratio = mesh_ratio_of(body);
    double factor = sqrt(ratio.young / ratio.density) / ratio.size;
    size_t all = mesh_family_most(body);
    const double *omega = frequencies(body);
    if (modes->count > all)
        modes->count = all;
    for (size_t k = 0; k < modes->count; k++)
        modes->omega[k] = factor * omega[k];
    /* the next one: of the file, or no lower than its last */
    size_t next = modes->count < all ? modes->count : all - 1;
    if (all > 0)
        modes->omega[modes->count] = factor * omega[next];
    else
        modes->omega[0] = body->ritz ? factor * ritz_highest(body->ritz) : INFINITY;
}

/* row += share shape, mode by mode: the same bits for any vector unit. */
VECTOR_CLONES static void add_shape(size_t count, double share, const float *shape, double *row)
{
    for (size_t k = 0; k < count; k++)
        row[k] += share * (double)shape[k];
}

/* Modes first, ... at a load; shapes go with the inverse root of mass. */
static void load_shapes(const struct body *body, size_t first, size_t count,
                        const struct family_load *load, double *row)
{
    const struct mesh_body *mesh = body->mesh;
    const struct mesh_load *at = &load->mesh;
    struct mesh_ratio ratio = mesh_ratio_of(body);
    double factor = 1.0 / sqrt(ratio.density * ratio.size * ratio.size * ratio.size);
    if (body->ritz) {
        ritz_shapes(body->ritz, at->point, at->direction, first, count, row);
        for (size_t k = 0; k < count; k++)
            row[k] *= factor;
        return;
    }
    memset(row, 0, count * sizeof *row);
    for (int i = 0; i < at->count; i++) {
        size_t node = mesh->faces[at->face].nodes[i];
        for (int axis = 0; axis < 3; axis++) {
            double part = at->share[i] * at->direction[axis];
            if (fabs(part) > LEAST_PART)
                add_shape(count, factor * part,
                          mesh->shapes + (3 * node + axis) * mesh->mode_count + first, row);
        }
    }
}

static void mesh_family_participations(const struct body *body, const struct modal_family *modes,
                                       const size_t *which, size_t count,
                                       const struct family_load *load, double *row)
{
    (void)modes;
    /* as a rule the first ones */
    if (count > 0 && which[0] == 0 && which[count - 1] == count - 1)
        load_shapes(body, 0, count, load, row);
    else
        for (size_t i = 0; i < count; i++)
            load_shapes(body, which[i], 1, load, &row[i]);
}

/* The sum of participation_i participation_j / omega^2 over modes from, ... to - 1, small terms
 * first. */
static double held_by(const struct body *body, size_t from, size_t to, const struct family_load *i,
                      const struct family_load *j)
{
    struct mesh_ratio ratio = mesh_ratio_of(body);
    double factor = ratio.young / (ratio.density * ratio.size * ratio.size);
    double rows[2][AT_ONCE];
    double sum = 0.0;
    while (to > from) {
        size_t count = to - from < AT_ONCE ? to - from : AT_ONCE;
        const double *other = i == j ? rows[0] : rows[1];
        to -= count;
        load_shapes(body, to, count, i, rows[0]);
        if (i != j)
            load_shapes(body, to, count, j, rows[1]);
        for (size_t k = count; k-- > 0;) {
            double omega = frequencies(body)[to + k];
            sum += rows[0][k] * other[k] / (omega * omega);
        }
    }
    return sum / factor;
}

/* Between two places. */

/* Sites closer than this are one place, in elements (the longer one of both). */
static const double ONE_PLACE = 0.5;
/* Sites that a place is interpolated from: enough for a plane through them. */
enum { NEIGHBOURS = 6 };

/* A place as a weighted mean of sites. */
struct mean {
    int count;
    size_t site[NEIGHBOURS];
    double weight[NEIGHBOURS];
};

/* The nearest sites of the place's own patch, by distance; their distances. */
static void find_neighbours(const struct mesh_body *mesh, const struct mesh_push *push,
                            struct mean *mean, double distances[NEIGHBOURS])
{
    unsigned patch = mesh->faces[push->face].patch;
    mean->count = 0;
    for (size_t s = 0; s < mesh->site_count; s++) {
        double apart[3];
        if (mesh->faces[mesh->site_face[s]].patch != patch)
            continue;
        sub3(mesh->site_point[s], push->point, apart);
        double distance = norm3(apart);
        int at = mean->count < NEIGHBOURS ? mean->count++ : NEIGHBOURS;
        if (at == NEIGHBOURS && !(distance < distances[--at]))
            continue;
        for (; at > 0 && distance < distances[at - 1]; at--) {
            distances[at] = distances[at - 1];
            mean->site[at] = mean->site[at - 1];
        }
        distances[at] = distance;
        mean->site[at] = s;
    }
}

/* Tangents of the surface at a place. */
static void push_tangents(const double n[3], double t[2][3])
{
    int smallest = fabs(n[0]) < 0.6 ? 0 : 1;
    double axis[3] = {0.0, 0.0, 0.0};
    axis[smallest] = 1.0;
    cross3(n, axis, t[0]);
    scale3(1.0 / norm3(t[0]), t[0], t[0]);
    cross3(n, t[0], t[1]);
}

/* Weights of the plane fitted to the neighbours, larger for nearer ones (moving least squares):
 * with p = (1, x, y) of each, w_a = g_a p_a . A^-1 e_1, A = sum g p p^T. False: the neighbours lie
 * on a line. */
static bool fit_plane(const struct mesh_body *mesh, const struct mesh_push *push, struct mean *mean,
                      const double distances[NEIGHBOURS])
{
    double t[2][3], p[NEIGHBOURS][3], g[NEIGHBOURS], a[3][3] = {{0.0}};
    double reach = distances[mean->count - 1];
    push_tangents(push->direction, t);
    for (int i = 0; i < mean->count; i++) {
        double apart[3];
        sub3(mesh->site_point[mean->site[i]], push->point, apart);
        p[i][0] = 1.0;
        p[i][1] = dot3(apart, t[0]) / reach;
        p[i][2] = dot3(apart, t[1]) / reach;
        /* much more for the nearest, so that the mean is its own where it lies on a site */
        double near = distances[i] / reach;
        g[i] = 1.0 / (near * near + 1e-6) - 1.0 / (1.0 + 1e-6) + 1e-3;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                a[r][c] += g[i] * p[i][r] * p[i][c];
    }
    /* the first column of the inverse, by cofactors */
    double cofactor[3] = {a[1][1] * a[2][2] - a[1][2] * a[2][1],
                          a[1][2] * a[2][0] - a[1][0] * a[2][2],
                          a[1][0] * a[2][1] - a[1][1] * a[2][0]};
    double determinant = a[0][0] * cofactor[0] + a[0][1] * cofactor[1] + a[0][2] * cofactor[2];
    if (!(determinant > 1e-9 * a[0][0] * a[1][1] * a[2][2]))
        return false;
    for (int i = 0; i < mean->count; i++)
        mean->weight[i] = g[i] *
                          (p[i][0] * cofactor[0] + p[i][1] * cofactor[1] + p[i][2] * cofactor[2]) /
                          determinant;
    return true;
}

static struct mean find_mean(const struct mesh_body *mesh, const struct mesh_push *push)
{
    struct mean mean;
    double distances[NEIGHBOURS];
    find_neighbours(mesh, push, &mean, distances);
    if (mean.count > 3 && distances[mean.count - 1] > 0.0 &&
        fit_plane(mesh, push, &mean, distances))
        return mean;
    /* the nearest alone */
    mean.count = mean.count > 0 ? 1 : 0;
    mean.weight[0] = 1.0;
    return mean;
}

/* The half-space's part of the response between forces on one patch: (1 - nu^2)/(pi E r) times the
 * cosine between their normals. It is the singular part. */
static double half_space_field(const struct mesh_body *mesh, unsigned face, double distance,
                               double alike)
{
    const struct material *material = &mesh->materials[mesh->faces[face].material];
    double nu = material->poisson;
    return fmax(alike, 0.0) * (1.0 - nu * nu) / (M_PI * material->young * distance);
}

/* The part of the response between two sites beside the half-space's; for sites of one place,
 * closer than a part of an element, the mean of their own. That the whole response is not smooth
 * between neighbours (mesh->near) does not matter here. */
static double regular_part(const struct mesh_body *mesh, size_t a, size_t b, bool one_patch)
{
    double apart[3];
    sub3(mesh->site_point[a], mesh->site_point[b], apart);
    double distance = norm3(apart);
    size_t n = mesh->site_count;
    double element = fmax(mesh_surface_face_size(mesh, mesh->site_face[a]),
                          mesh_surface_face_size(mesh, mesh->site_face[b]));
    if (one_patch && distance < ONE_PLACE * element)
        return 0.5 * ((double)mesh->between[a * n + a] + (double)mesh->between[b * n + b]);
    double all = (double)mesh->between[a * n + b];
    return one_patch ? all - half_space_field(mesh, mesh->site_face[a], distance,
                                              dot3(mesh->site_normal[a], mesh->site_normal[b]))
                     : all;
}

double mesh_between(const struct mesh_body *mesh, const struct mesh_push *i,
                    const struct mesh_push *j)
{
    if (!mesh->between)
        return NAN;
    struct mean at_i = find_mean(mesh, i), at_j = find_mean(mesh, j);
    if (at_i.count == 0 || at_j.count == 0)
        return NAN;
    /* the smooth part between all pairs */
    bool one_patch = mesh->faces[i->face].patch == mesh->faces[j->face].patch;
    double sum = 0.0;
    for (int a = 0; a < at_i.count; a++)
        for (int b = 0; b < at_j.count; b++)
            sum += at_i.weight[a] * at_j.weight[b] *
                   regular_part(mesh, at_i.site[a], at_j.site[b], one_patch);
    /* and the other one, no nearer than a contact is wide */
    double apart[3];
    sub3(i->point, j->point, apart);
    double distance = fmax(norm3(apart), mesh->cut);
    if (one_patch && distance > 0.0)
        sum += half_space_field(mesh, i->face, distance, dot3(i->direction, j->direction));
    return sum;
}

/* A load as a push on the file's surface. */
static struct mesh_push push_of(const struct mesh_load *load)
{
    struct mesh_push push = {.face = load->face};
    memcpy(push.point, load->point, sizeof push.point);
    memcpy(push.direction, load->direction, sizeof push.direction);
    return push;
}

double mesh_load_between(const struct mesh_load *i, const struct mesh_load *j)
{
    const double *t = i->tensor, *a = i->direction, *b = j->direction;
    return t[0] * a[0] * b[0] + t[1] * a[1] * b[1] + t[2] * a[2] * b[2] +
           t[3] * (a[0] * b[1] + a[1] * b[0]) + t[4] * (a[1] * b[2] + a[2] * b[1]) +
           t[5] * (a[2] * b[0] + a[0] * b[2]);
}

/* Files without tensors. Half-spaces are singular to normal and tangential forces alike, and modes
 * cut off either: what the modes up to a frequency leave of the tangential flexibility is that of
 * the normal one to 0.83 ... 1.27 in cubes, bars, plates, discs, on sides and ends (by
 * ritz_tensor).
 */
static const double LEFT_ALONG = 0.3;
/* A curved surface changes the tangential flexibility with the logarithm of the contact's radius by
 * up to (1 + nu) 9/4/pi of its mean curvature over E (ritz_tensor_narrow); contacts are this much
 * narrower than `cut`, as a logarithm. */
static const double NARROWER = 2.0;

/* The material of a load's face, with the body's modulus. */
static struct material material_of(const struct body *body, const struct mesh_load *load)
{
    const struct mesh_body *mesh = body->mesh;
    struct material material = mesh->materials[mesh->faces[load->face].material];
    material.young *= mesh_ratio_of(body).young;
    return material;
}

static double mean_curvature(const struct site *site)
{
    return 0.5 * (site->curvature[0] + site->curvature[4] + site->curvature[8]);
}

static void estimate_along(const struct body *body, const struct site *site, struct mesh_load *load)
{
    const struct mesh_body *mesh = body->mesh;
    const struct material material = material_of(body, load);
    struct family_load along = {.acts = true, .mesh = *load}, normal = along;
    scale3(-1.0, site->outward, normal.mesh.direction);
    double left =
        load->flexibility - held_by(body, mesh->removed, mesh->mode_count, &normal, &normal);
    load->flexibility = left + held_by(body, mesh->removed, mesh->mode_count, &along, &along);
    load->unknown = LEFT_ALONG * fabs(left) + NARROWER * 2.25 * (1.0 + material.poisson) *
                                                  fabs(mean_curvature(site)) /
                                                  (M_PI * material.young);
}

void mesh_family_along(const struct body *body, const struct site *site, struct mesh_load *load)
{
    load->along = true;
    if (!load->all_ways) {
        estimate_along(body, site, load);
        return;
    }
    const struct material material = material_of(body, load);
    double image[3];
    rotate3(site->curvature, load->direction, image);
    load->flexibility = mesh_load_between(load, load);
    load->unknown = cerruti3_contact_doubt(material.young, material.poisson,
                                           dot3(load->direction, image), mean_curvature(site));
}

void mesh_family_narrow(const struct body *body, const struct site *site, double patch,
                        struct mesh_load *load)
{
    const struct material material = material_of(body, load);
    double cut = body->scale * body->mesh->cut;
    if (!load->all_ways || !(cut > 0.0 && patch > 0.0))
        return;
    cerruti3_add_slope(material.young, material.poisson, site->outward, site->curvature,
                       log(cut / patch), load->tensor);
    if (load->along)
        load->flexibility = mesh_load_between(load, load);
}

static bool same_place(const struct mesh_load *i, const struct mesh_load *j)
{
    return i->all_ways && j->all_ways && i->axis == j->axis && i->side == j->side &&
           i->face == j->face && memcmp(i->point, j->point, sizeof i->point) == 0;
}

/* Box: at one place the flexibility of all modes, between two places the sum over its own modes.
 * Mesh: at one place the regular flexibility and that of the removed modes; between two places the
 * same from the file's sites, or without sites the sum over the modes, which converges there as no
 * field is singular. */
static double mesh_family_compliance(const struct body *body, size_t family,
                                     const struct family_load *i, const struct family_load *j)
{
    (void)family;
    const struct mesh_body *mesh = body->mesh;
    if (i != j && same_place(&i->mesh, &j->mesh))
        return mesh_load_between(&i->mesh, &j->mesh) +
               (mesh ? held_by(body, 0, mesh->removed, i, j) : 0.0);
    if (body->ritz)
        return i == j ? i->mesh.flexibility : held_by(body, 0, mesh_family_most(body), i, j);
    double removed = held_by(body, 0, mesh->removed, i, j);
    if (i == j)
        return i->mesh.flexibility + removed;
    /* between places the file knows nothing of forces along the surface but its modes, whose sum
     * converges */
    if (i->mesh.along || j->mesh.along)
        return removed + held_by(body, mesh->removed, mesh->mode_count, i, j);
    const struct mesh_push at_i = push_of(&i->mesh), at_j = push_of(&j->mesh);
    double between = mesh_between(mesh, &at_i, &at_j);
    return isnan(between) ? removed + held_by(body, mesh->removed, mesh->mode_count, i, j)
                          : removed + between * mesh_ratio_flexibility(body);
}

/* phi^2/omega^4, mode by mode. */
VECTOR_CLONES static void find_inertias(size_t count, const double *row, const double *omega,
                                        double *inertia)
{
    for (size_t k = 0; k < count; k++) {
        double square = omega[k] * omega[k];
        inertia[k] = row[k] * row[k] / (square * square);
    }
}

static double mesh_family_beyond(const struct body *body, const struct modal_family *modes,
                                 size_t first, const struct family_load *load)
{
    const double *omega = frequencies(body);
    size_t all = mesh_family_most(body);
    struct mesh_ratio ratio = mesh_ratio_of(body);
    double factor = sqrt(ratio.young / ratio.density) / ratio.size;
    double row[AT_ONCE], inertia[AT_ONCE];
    /* the last octave begins at its lowest mode, or at the file's */
    size_t last = all;
    while (last > 0 && omega[last - 1] >= OCTAVE * omega[all - 1])
        last--;
    /* sums from the last mode back: of the octave, and from `first` on */
    double sum = 0.0, octave = 0.0;
    size_t low = first < last ? first : last;
    for (size_t end = all; end > low;) {
        size_t begin = end > low + AT_ONCE ? end - AT_ONCE : low;
        load_shapes(body, begin, end - begin, load, row);
        find_inertias(end - begin, row, omega + begin, inertia);
        for (size_t k = end; k > begin && k > first; k--)
            sum += inertia[k - 1 - begin];
        for (size_t k = end; k > begin && k > last; k--)
            octave += inertia[k - 1 - begin];
        end = begin;
    }
    /* of frequencies that are `factor` times the file's */
    double scale = modes->omega[first] / (factor * factor);
    return (sum + TAIL * octave) * scale * scale;
}

static bool mesh_family_crowds(const struct body *body)
{
    (void)body;
    return true;
}

const struct mode_family mesh_family = {
    .returns = true,
    .find = mesh_family_find,
    .participations = mesh_family_participations,
    .compliance = mesh_family_compliance,
    .most = mesh_family_most,
    .beyond = mesh_family_beyond,
    .crowds = mesh_family_crowds,
};

const struct mode_family *const mesh_family_alone[1] = {&mesh_family};
