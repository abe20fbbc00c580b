/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model/body.h"
#include "model/body_kind.h"
#include "model/damping.h"
#include "model/facet.h"
#include "model/key.h"
#include "model/mesh_family.h"
#include "model/mesh_surface.h"
#include "model/modal_basis.h"
#include "model/site.h"
#include "model/vector.h"

/* Poisson's ratios that differ by less are equal but for the digits of a catalogue. */
static const double SAME_POISSON = 1e-9;
/* The declared normal and curvature of a named site hold within this distance of it, in smallest
 * radii. */
static const double NAMED = 0.1;
/* Largest distance from the surface at which a named site may be declared: half an element, as a
 * curved surface is off its straight-sided mesh, but at most half of the smallest radius, beyond
 * which another side may be nearer. */
static const double NAMED_ELEMENT = 0.5;
static const double NAMED_MOST = 0.5;
/* Near an edge, other patches are searched within this distance, in smallest radii: more than a
 * point may lie off the surface (solve/formulation.c). */
static const double BESIDE = 0.15;
/* Doubt of a normal beyond which the surface counts as unknown: the largest allowed angle between
 * it and a stated normal. */
static const double MOST_DOUBT = SITE_MAX_ANGLE_DEGREES * M_PI / 180.0;

/* Largest distance of a curved edge from its chords, in elements; and the distance of a point from
 * its foot along the surface, in smallest radii, from which it is beyond the edge. */
static const double OVER = 0.1;
static const double ASIDE = 0.01;
/* A declared normal or curvature that differs more from the fit is remarked: degrees, parts. */
static const double MUCH_ASKEW = 2.0;
static const double MUCH_BENT = 0.1;

static const struct key keys[] = {
    {"file", KEY_TEXT, .required = true, .allowed = "the path of a file",
     KEY_SAYS(NULL, "a reduced body (.h5), or a mesh that percussd has reduced; from the "
                    "catalogue's folder, or "
                    "from share/percuss of the installation where it is not there")},
    {"damping", KEY_DAMPING, &limit_damping, KEY_OF(body, damping),
     KEY_SAYS("half of its material's loss factor (of its relaxation at each mode's frequency); 0 "
              "where that states none",
              "damping ratio of every elastic mode")},
    {"modes", KEY_WHOLE, &limit_modes, KEY_OF(body, modes),
     KEY_SAYS("as many as the tolerance asks for",
              "fixed number of modes, of those that the file has")},
    {"rigid", KEY_FLAG, KEY_OF(body, rigid), KEY_SAYS("false", "mass, inertia and surface only")},
    {"scale", KEY_NUMBER, &limit_scale, KEY_OF(body, scale), .absent = 0.0,
     KEY_SAYS("1", "its size over the file's")},
    {"sites", KEY_CALLER, .required = false,
     KEY_SAYS("none", "places on its surface by their names, which requests may name")},
    {"unit", KEY_TEXT, .required = false, .allowed = "m, cm, mm, um, in or ft",
     KEY_SAYS("the file is a reduced body", "unit of length of a mesh")},
    {"max_frequency", KEY_TEXT, .required = false, .allowed = "a frequency in Hz, 0.001 to 1e12",
     KEY_SAYS("as far as the mesh is good, at most 300 modes", "all modes of a mesh below it")},
    {"fixed", KEY_LIST, .required = false, .allowed = "a list of names of sets of the mesh",
     KEY_SAYS("it is free", "what of a mesh is held")},
    {"instance", KEY_TEXT, .required = false,
     .allowed = "the name of an instance in the assembly of a deck",
     KEY_SAYS("the only one with solids", "which part of a deck of Abaqus is the body")},
    {"flexibility", KEY_TEXT, .required = false, .allowed = "ahead or later",
     KEY_SAYS("ahead",
              "when that of a mesh's surface is solved for: everywhere at once, or at each "
              "place when a request first hits it")},
    {"raise", KEY_TEXT, .required = false, .allowed = "true or false",
     KEY_SAYS("false", "whether linear elements are taken, with mid nodes on straight edges")},
};

static enum percuss_status mesh_kind_check(const struct body *body, struct fault *fault)
{
    if (!body->mesh)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "file: must be a body file of percuss-reduce");
    double poisson = body->mesh->materials[0].poisson;
    if (!(fabs(body->material.poisson - poisson) <= SAME_POISSON))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "poisson: %.9g: must be %.9g, with which the mesh was reduced: reduce it "
                         "again for another one",
                         body->material.poisson, poisson);
    if (body->damping_count > body->mesh->mode_count)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "damping: %zu ratios: must be at most %zu, one of each mode in its file",
                         body->damping_count, body->mesh->mode_count);
    return PERCUSS_OK;
}

/* A body's point at the size of the file. */
static void to_mesh(const struct body *body, const double point[3], double p[3])
{
    scale3(1.0 / body->scale, point, p);
}

/* Remarks a declared normal or curvature that differs much from the surface's own. */
static void compare_site(const struct mesh_spot *spot, struct body_site *site)
{
    double across[3];
    cross3(site->normal, spot->normal, across);
    double angle = atan2(norm3(across), dot3(site->normal, spot->normal)) * 180.0 / M_PI;
    double difference = 0.0, size = 0.0;
    for (int k = 0; k < 9; k++) {
        difference = fmax(difference, fabs(site->curvature[k] - spot->curvature[k]));
        size = fmax(size, fmax(fabs(site->curvature[k]), fabs(spot->curvature[k])));
    }
    site->remark[0] = '\0';
    if (site->has_normal && angle > MUCH_ASKEW)
        snprintf(site->remark, sizeof site->remark,
                 "its declared normal is %.2g degrees off the surface's", angle);
    else if (site->has_curvature && difference > MUCH_BENT * size)
        snprintf(site->remark, sizeof site->remark,
                 "its declared curvature is off the surface's by %.2g of %.2g 1/m", difference,
                 size);
}

/* Largest distance from the surface at which a named site may be declared: beyond a sharp edge that
 * of a contact's point. */
static double allowed_off(const struct mesh_body *mesh, const struct mesh_place *place)
{
    double half = mesh->volume / mesh->area;
    double element = mesh_surface_face_size(mesh, place->face);
    bool near_rim = place->to_rim < OVER * element;
    return near_rim ? NAMED * half
                    : fmax(NAMED * half, fmin(NAMED_ELEMENT * element, NAMED_MOST * half));
}

/* Moves a site onto the surface if it is farther off than a contact's point may be. */
static void move_site(const struct mesh_body *mesh, const struct mesh_place *place,
                      struct body_site *site)
{
    site->moved = 0.0;
    if (place->distance <= NAMED * mesh->volume / mesh->area)
        return;
    site->moved = place->distance;
    for (int k = 0; k < 3; k++)
        site->point[k] = (place->point[k] + mesh->centre[k]) / mesh->unit;
}

/* Finds the face of a named site, and its normal and curvature if they are not declared. */
static enum percuss_status complete_site(const struct body *body, struct body_site *site,
                                         struct fault *fault)
{
    /* the point in the frame of the mesh */
    struct mesh_place place;
    double point[3];
    double p[3];
    body_site_point(body, site, point);
    to_mesh(body, point, p);
    /* as near the surface as a named point must be */
    double allowed = mesh_surface_find(body->mesh, p, 0.0, &place, 1) > 0
                         ? allowed_off(body->mesh, &place)
                         : 0.0;
    if (!(place.distance <= allowed))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "sites.%s.point: lies %.3g m off the surface: at most %.3g m is allowed; "
                         "points are in the mesh's own frame and unit (%g m)",
                         site->name, place.distance, allowed, body->mesh->unit);
    /* the surface's own, where the site declares none */
    struct mesh_spot spot = mesh_surface_at(body->mesh, place.face, place.u, place.v);
    site->face = place.face;
    if (!site->has_normal)
        memcpy(site->normal, spot.normal, sizeof site->normal);
    if (!site->has_curvature)
        memcpy(site->curvature, spot.curvature, sizeof site->curvature);
    compare_site(&spot, site);
    move_site(body->mesh, &place, site);
    site->placed = true;
    return PERCUSS_OK;
}

static enum percuss_status mesh_kind_complete(struct body *body, struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    const struct mesh_body *mesh = body->mesh;
    if (body->scale == 0.0)
        body->scale = 1.0;
    /* mass grows with the cube of the size, inertia with its fifth power */
    struct mesh_ratio ratio = mesh_ratio_of(body);
    double square = ratio.size * ratio.size;
    double factor = ratio.density * ratio.size * square;
    body->mass = factor * mesh->mass;
    for (int k = 0; k < 3; k++)
        body->inertia[k] = factor * square * mesh->inertia[4 * k];
    body->products[0] = factor * square * mesh->inertia[5];
    body->products[1] = factor * square * mesh->inertia[6];
    body->products[2] = factor * square * mesh->inertia[1];
    for (size_t i = 0; !status && i < body->site_count; i++)
        if (!body->sites[i].placed)
            status = complete_site(body, &body->sites[i], fault);
    return status;
}

/* Half the thickness of a plate. */
static double mesh_kind_smallest_radius(const struct body *body)
{
    return body->scale * body->mesh->volume / body->mesh->area;
}

/* The named site that a place belongs to, or NULL. */
static const struct body_site *site_near(const struct body *body, const struct mesh_place *place)
{
    const struct mesh_body_face *faces = body->mesh->faces;
    for (size_t i = 0; i < body->site_count; i++) {
        const struct body_site *site = &body->sites[i];
        double point[3];
        double apart[3];
        body_site_point(body, site, point);
        for (int k = 0; k < 3; k++)
            apart[k] = point[k] - body->scale * place->point[k];
        if (faces[site->face].patch == faces[place->face].patch &&
            norm3(apart) <= NAMED * mesh_kind_smallest_radius(body))
            return site;
    }
    return NULL;
}

/* A place in the mesh's own frame and unit. */
static void place_in_file(const struct mesh_body *mesh, const struct mesh_place *place,
                          double point[3])
{
    for (int k = 0; k < 3; k++)
        point[k] = (place->point[k] + mesh->centre[k]) / mesh->unit;
}

void body_order_want_sites(const struct body_order *order, const struct body *body)
{
    for (size_t i = 0; i < body->site_count; i++) {
        struct mesh_place place;
        double point[3], p[3];
        body_site_point(body, &body->sites[i], point);
        to_mesh(body, point, p);
        if (mesh_surface_find(body->mesh, p, 0.0, &place, 1) == 0 ||
            !mesh_surface_at(body->mesh, place.face, place.u, place.v).unsolved)
            continue;
        place_in_file(body->mesh, &place, point);
        body_order_want(order, point);
    }
}

static struct face face_at(const struct body *body, const struct mesh_place *place,
                           const double point[3])
{
    struct mesh_spot spot = mesh_surface_at(body->mesh, place->face, place->u, place->v);
    const struct body_site *site = site_near(body, place);
    double away[3];
    struct face face = {.kind = SITE_ROUND};
    /* declared values take precedence */
    bool normal = site && site->has_normal, curvature = site && site->has_curvature;
    memcpy(face.outward, normal ? site->normal : spot.normal, sizeof face.outward);
    memcpy(face.curvature, curvature ? site->curvature : spot.curvature, sizeof face.curvature);
    for (int k = 0; k < 9; k++)
        face.curvature[k] /= body->scale;
    /* along the normal, and beyond the edge */
    for (int k = 0; k < 3; k++)
        away[k] = point[k] - body->scale * place->point[k];
    face.distance = dot3(away, face.outward);
    double aside = sqrt(fmax(dot3(away, away) - face.distance * face.distance, 0.0));
    double edge = body->scale * place->to_rim;
    double element = body->scale * mesh_surface_face_size(body->mesh, place->face);
    /* from an inner foot the point is along the normal, but for kinks between faces */
    bool near_rim = edge < OVER * element;
    face.beyond = near_rim && aside > ASIDE * mesh_kind_smallest_radius(body) ? aside : -edge;
    face.spot = (struct face_spot){
        .on_mesh = true,
        .facet = place->face,
        .material = body->mesh->faces[place->face].material,
        .u = place->u,
        .v = place->v,
        .edge = edge,
        .element = element,
        .doubt = normal && curvature ? 0.0 : spot.doubt,
        .fitted = !curvature,
        .flexibility = spot.flexibility * mesh_ratio_flexibility(body),
        .slope = spot.slope * mesh_ratio_flexibility(body),
        .unsolved = spot.unsolved,
        .remark = site && site->remark[0] ? site->remark : NULL,
    };
    place_in_file(body->mesh, place, face.spot.foot);
    for (int k = 0; k < 6; k++)
        face.spot.tensor[k] = spot.tensor[k] * mesh_ratio_flexibility(body);
    return face;
}

static int mesh_kind_faces(const struct body *body, const double p[3], struct face *faces)
{
    struct mesh_place places[BODY_MOST_FACES];
    double point[3];
    to_mesh(body, p, point);
    double beside = BESIDE * body->mesh->volume / body->mesh->area;
    int count = mesh_surface_find(body->mesh, point, beside, places, BODY_MOST_FACES);
    for (int i = 0; i < count; i++)
        faces[i] = face_at(body, &places[i], p);
    return count;
}

static const char *mesh_kind_why_not(const struct body *body, const struct site *site)
{
    if (site->spot.doubt > MOST_DOUBT)
        return "the surface's normal and curvature are not known there within 5 degrees: declare a "
               "site with point, normal and curvatures, or refine the mesh";
    if (body->rigid || body->mesh->mode_count == 0 || !isnan(site->spot.flexibility))
        return NULL;
    /* a later solution may cover it */
    if (site->spot.unsolved)
        return NULL;
    if (site->spot.edge < site->spot.element)
        return "the body's flexibility is not known there: the mesh is too coarse so near to an "
               "edge: give percuss-reduce --site there, or elements no longer than the edge is "
               "away";
    return "the body's flexibility is not known there: its wall is thinner than 0.4 of an element, "
           "or its surface comes back over itself within a third of one: reduce a mesh of elements "
           "no longer than the wall is thick or the gap wide; or a mass stands on a node within an "
           "element";
}

static void mesh_kind_load(const struct body *body, const struct site *site,
                           const double direction[3], bool tangential, struct site_load *load)
{
    struct family_load *family = &load->family[0];
    const struct mesh_body_face *face = &body->mesh->faces[site->spot.facet];
    if (body->rigid || body->mesh->mode_count == 0)
        return;
    family->acts = true;
    family->mesh.face = site->spot.facet;
    family->mesh.count = face->count;
    family->mesh.flexibility = site->spot.flexibility;
    facet_shape(face->count, site->spot.u, site->spot.v, family->mesh.share, NULL, NULL);
    memcpy(family->mesh.direction, direction, sizeof family->mesh.direction);
    to_mesh(body, site->point, family->mesh.point);
    family->mesh.all_ways = body->mesh->all_ways && !isnan(site->spot.tensor[0]);
    memcpy(family->mesh.tensor, site->spot.tensor, sizeof family->mesh.tensor);
    if (tangential)
        mesh_family_along(body, site, &family->mesh);
}

/* Moduli and densities of all materials scale as those of the first. */
static struct material mesh_kind_material_at(const struct body *body, const struct site *site)
{
    unsigned which = site->spot.on_mesh ? site->spot.material : 0;
    if (which == 0)
        return body->material;
    struct material material = body->mesh->materials[which];
    struct mesh_ratio ratio = mesh_ratio_of(body);
    material.young *= ratio.young;
    material.density *= ratio.density;
    return material;
}

static const char *mesh_kind_theory_name(const struct body *body)
{
    return body->mesh->mode_count > 0 ? "mesh" : "rigid";
}

/* Named sites that are not where they were declared. */
static void describe_moved(const struct body *body, struct body_description *description)
{
    unsigned count = 0;
    double farthest = 0.0;
    for (size_t i = 0; i < body->site_count; i++) {
        count += body->sites[i].moved > 0.0;
        farthest = fmax(farthest, body->scale * body->sites[i].moved);
    }
    if (count > 0)
        describe_add(description, "%u site%s moved onto the surface by up to %.2g m", count,
                     count > 1 ? "s" : "", farthest);
}

static void mesh_kind_describe(const struct body *body, struct body_description *description)
{
    const struct mesh_body *mesh = body->mesh;
    double half[3];
    double size[3];
    double centre[3];
    for (int k = 0; k < 3; k++) {
        /* in the file's unit; a millionth of the mesh is rounding */
        bool is_off = fabs(mesh->centre[k]) > 1e-6 * (mesh->high[k] - mesh->low[k]);
        centre[k] = is_off ? mesh->centre[k] / mesh->unit : 0.0;
        half[k] = body->scale * fmax(mesh->high[k], -mesh->low[k]);
        size[k] = body->scale * (mesh->high[k] - mesh->low[k]);
    }
    describe_extents(description, half[0], half[1], half[2]);
    describe_add(description, "%.4g m x %.4g m x %.4g m", size[0], size[1], size[2]);
    /* its frame */
    describe_add(description, "centre of mass at (%.6g, %.6g, %.6g) of the mesh's frame", centre[0],
                 centre[1], centre[2]);
    describe_add(description, "in units of %g m", mesh->unit);
    if (body->scale != 1.0)
        describe_add(description, "%g times its size", body->scale);
    if (mesh->supported)
        describe_add(description, "held by %s", mesh->supports[0] ? mesh->supports : "its nodes");
    /* its vibration */
    if (body->rigid || mesh->mode_count == 0)
        describe_add(description, "rigid");
    else
        describe_add(description, "%zu modes up to %.4g Hz", mesh->mode_count,
                     mesh->omega[mesh->mode_count - 1] *
                         sqrt(mesh_ratio_of(body).young / mesh_ratio_of(body).density) /
                         (body->scale * 2.0 * M_PI));
    if (mesh_body_is_later(mesh) && !body->rigid)
        describe_add(description, "flexibility at %zu place%s", mesh->added_count,
                     mesh->added_count == 1 ? "" : "s");
    damping_describe(body, description);
    if (body->modes > 0)
        describe_add(description, "%u of them taking part", body->modes);
    describe_moved(body, description);
}

const struct body_kind mesh_kind = {
    .name = "mesh",
    .keys = keys,
    .key_count = sizeof keys / sizeof *keys,
    .own_material = true,
    .check = mesh_kind_check,
    .complete = mesh_kind_complete,
    .smallest_radius = mesh_kind_smallest_radius,
    .faces = mesh_kind_faces,
    .why_not = mesh_kind_why_not,
    .families = mesh_family_alone,
    .family_count = 1,
    .load = mesh_kind_load,
    .material_at = mesh_kind_material_at,
    .theory = mesh_kind_theory_name,
    .describe = mesh_kind_describe,
};
