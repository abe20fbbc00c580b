/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/modal_basis.h"

#include <math.h>
#include <stdlib.h>

#include "model/torsion.h"

/* Smaller parts of a unit force are rounding of the pose. */
static const double NEGLIGIBLE = 1e-9;

static void find_bending(const struct body *body, struct site_load *load)
{
    for (int plane = 0; plane < 2; plane++) {
        const struct beam_load *bending = &load->bending[plane];
        double arm = fabs(bending->moment) / body_smallest_radius(body);
        load->acts[FAMILY_BENDING_Y + plane] =
            fabs(bending->force) > NEGLIGIBLE || arm > NEGLIGIBLE;
    }
}

struct site_load site_load_make(const struct body *body, const struct site *site,
                                const double direction[3])
{
    struct site_load load = {0};
    if (!body_is_flexible(body))
        return load;
    bool on_end = site->face == SITE_END;
    double half = 0.5 * body->length;
    double x = fmax(-half, fmin(half, site->point[0]));
    load.end = site->point[0] > 0.0;
    load.axial = on_end ? direction[0] : 0.0;
    load.acts[FAMILY_AXIAL] = fabs(load.axial) > NEGLIGIBLE;
    for (int plane = 0; plane < 2 && body->kind == &beam_kind; plane++) {
        /* a section turning by psi moves a point at the height y by -psi y along the axis */
        struct beam_load *bending = &load.bending[plane];
        bending->x = on_end ? copysign(half, site->point[0]) : x;
        bending->force = direction[1 + plane];
        bending->moment = on_end ? -site->point[1 + plane] * direction[0] : 0.0;
    }
    find_bending(body, &load);
    if (body->kind == &beam_kind && body->radius == 0.0 && !on_end)
        load.torque = site->point[1] * direction[2] - site->point[2] * direction[1];
    load.acts[FAMILY_TORSION] = fabs(load.torque) > NEGLIGIBLE * body_smallest_radius(body);
    return load;
}

bool modal_planes_alike(const struct body *body)
{
    bool timoshenko = body->theory == THEORY_TIMOSHENKO;
    return body->kind == &beam_kind && body->second_moment[0] == body->second_moment[1] &&
           (!timoshenko || body->shear_factor[0] == body->shear_factor[1]);
}

void site_load_turn(const struct body *body, double cosine, double sine, struct site_load *load)
{
    const struct beam_load y = load->bending[0];
    struct beam_load *turned = load->bending;
    turned[0].force = cosine * y.force - sine * turned[1].force;
    turned[0].moment = cosine * y.moment - sine * turned[1].moment;
    turned[1].force = cosine * turned[1].force + sine * y.force;
    turned[1].moment = cosine * turned[1].moment + sine * y.moment;
    find_bending(body, load);
}

struct beam_plane modal_beam_plane(const struct body *body, enum mode_family family)
{
    int plane = family == FAMILY_BENDING_Z;
    const struct material *material = &body->material;
    bool timoshenko = body->theory == THEORY_TIMOSHENKO;
    double shear = timoshenko
                       ? body->shear_factor[plane] * material_shear_modulus(material) * body->area
                       : INFINITY;
    return (struct beam_plane){
        .length = body->length,
        .bending_stiffness = material->young * body->second_moment[plane],
        .shear_stiffness = shear,
        .line_mass = material->density * body->area,
        .line_inertia = timoshenko ? material->density * body->second_moment[plane] : 0.0,
        .supports = {body->supports[0], body->supports[1]},
    };
}

/* Ends that hold the axis: any support does. */
static int axial_supports(const struct body *body)
{
    return (body->supports[0] != SUPPORT_FREE) + (body->supports[1] != SUPPORT_FREE);
}

/* Wave number of longitudinal mode k = 0, 1, ..., rad/m. */
static double axial_wave_number(const struct body *body, size_t k)
{
    double half_waves = axial_supports(body) == 1 ? (double)k + 0.5 : (double)k + 1.0;
    return half_waves * M_PI / body->length;
}

/* Lateral inertia: kinetic energy grows by this share, (nu r_p k)^2 with the polar radius of
 * gyration (Love; Graff, Wave Motion in Elastic Solids, section 2.5.3). */
static double lateral_share(const struct body *body, double wave_number)
{
    if (!body->lateral_inertia)
        return 0.0;
    double x = body->material.poisson * wave_number * body->radius * M_SQRT1_2;
    return x * x;
}

static void axial_modes(const struct body *body, struct modal_family *modes)
{
    double speed = sqrt(body->material.young / body->material.density);
    for (size_t k = 0; k < modes->count; k++) {
        double wave_number = axial_wave_number(body, k);
        modes->omega[k] = wave_number * speed / sqrt(1.0 + lateral_share(body, wave_number));
    }
}

static void bending_modes(const struct body *body, struct modal_family *modes)
{
    struct beam_plane plane = modal_beam_plane(body, modes->family);
    beam_modes(&plane, modes->count, modes->beam);
    bool alike = plane.supports[0] == plane.supports[1];
    for (size_t k = 0; k < modes->count; k++) {
        modes->omega[k] = modes->beam[k].omega;
        modes->odd[k] = alike && modes->beam[k].even[0] == 0.0 && modes->beam[k].even[1] == 0.0;
    }
}

static void torsion_modes(const struct body *body, struct modal_family *modes)
{
    for (size_t k = 0; k < modes->count; k++) {
        modes->omega[k] = torsion_frequency(body, k);
        modes->odd[k] = torsion_is_odd(body, k);
    }
}

static bool is_bending(enum mode_family family)
{
    return family == FAMILY_BENDING_Y || family == FAMILY_BENDING_Z;
}

struct modal_family *modal_family_create(const struct body *body, enum mode_family family,
                                         size_t count)
{
    struct modal_family *modes = calloc(1, sizeof *modes);
    if (!modes)
        return NULL;
    modes->family = family;
    modes->count = count;
    modes->omega = calloc(count + 1, sizeof *modes->omega);
    modes->odd = calloc(count + 1, sizeof *modes->odd);
    if (is_bending(family))
        modes->beam = calloc(count + 1, sizeof *modes->beam);
    if (!modes->omega || !modes->odd || (is_bending(family) && !modes->beam)) {
        modal_family_free(modes);
        return NULL;
    }
    if (family == FAMILY_AXIAL)
        axial_modes(body, modes);
    else if (family == FAMILY_TORSION)
        torsion_modes(body, modes);
    else
        bending_modes(body, modes);
    return modes;
}

void modal_family_free(struct modal_family *modes)
{
    if (!modes)
        return;
    free(modes->omega);
    free(modes->odd);
    free(modes->beam);
    free(modes);
}

/* u_k = sqrt(2/M) cos or sin, largest at a free end; sign by the number of half waves between. */
static double axial_participation(const struct body *body, size_t k, const struct site_load *load)
{
    double share = lateral_share(body, axial_wave_number(body, k));
    double amplitude = sqrt(2.0 / (body->mass * (1.0 + share)));
    if (axial_supports(body) == 2)
        return 0.0;
    /* free-free: cos(k pi (x/L + 1/2)) with k from 1; one end held: +1 at the free end */
    bool flips = axial_supports(body) == 0 && load->end == 1 && k % 2 == 0;
    return flips ? -amplitude * load->axial : amplitude * load->axial;
}

double modal_participation(const struct body *body, const struct modal_family *modes, size_t k,
                           const struct site_load *load)
{
    if (modes->family == FAMILY_AXIAL)
        return axial_participation(body, k, load);
    if (modes->family == FAMILY_TORSION)
        return load->torque * torsion_shape(body, k, modes->omega[k], load->bending[0].x);
    const struct beam_load *bending = &load->bending[modes->family - FAMILY_BENDING_Y];
    struct beam_plane plane = modal_beam_plane(body, modes->family);
    double w;
    double psi;
    beam_mode_at(&plane, &modes->beam[k], bending->x, &w, &psi);
    return bending->force * w + bending->moment * psi;
}

/* Free-free: L/(3EA) at the same end, -L/(6EA) across, both with inertia relief (u along x); one
 * end held: L/(EA). */
static double axial_compliance(const struct body *body, const struct site_load *i,
                               const struct site_load *j)
{
    double full = body->length / (body->material.young * body->area);
    double share = 1.0;
    if (axial_supports(body) == 0)
        share = i->end == j->end ? 1.0 / 3.0 : -1.0 / 6.0;
    else if (axial_supports(body) == 2)
        share = 0.0;
    return share * full * i->axial * j->axial;
}

double modal_compliance(const struct body *body, enum mode_family family, const struct site_load *i,
                        const struct site_load *j)
{
    if (!i->acts[family] || !j->acts[family])
        return 0.0;
    if (family == FAMILY_AXIAL)
        return axial_compliance(body, i, j);
    if (family == FAMILY_TORSION)
        return i->torque * j->torque * torsion_compliance(body, i->bending[0].x, j->bending[0].x);
    struct beam_plane plane = modal_beam_plane(body, family);
    return beam_compliance(&plane, &i->bending[family - FAMILY_BENDING_Y],
                           &j->bending[family - FAMILY_BENDING_Y]);
}

double modal_remainder_frequency(const struct body *body, const struct modal_family *modes,
                                 size_t first)
{
    bool crowded = modes->family == FAMILY_AXIAL && body->lateral_inertia;
    return (crowded ? 1.0 : sqrt(3.0)) * modes->omega[first];
}
