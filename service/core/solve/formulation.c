/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/formulation.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "base/watch.h"
#include "model/rigid.h"
#include "model/vector.h"
#include "numeric/lcp.h"
#include "numeric/linear.h"
#include "solve/contact_model.h"
#include "solve/error/deviation.h"
#include "solve/oblique.h"
#include "solve/relaxed.h"
#include "solve/vibration.h"

/* Faster approaches are outside the range of all models. */
static const double MAX_SPEED = 1e4;
/* So are masses outside this range. */
static const double MIN_INVERSE_MASS = 1e-100;

/* Share of the smallest radius that a point may lie off a surface: contacts of replayed lists
 * overlap by as much. */
static const double OFF_SURFACE = 0.1;
/* Relative rounding allowed in a symmetric matrix, and below zero in a semidefinite one. */
static const double ASYMMETRY = 1e-9;
static const double INDEFINITE = 1e-9;
/* Eigenvalues that count as zero, of the largest. */
static const double NULL_EIGENVALUE = 1e-12;
/* A contact that a mesh takes part in counts as a line below this ratio of its curvatures: across a
 * cylinder a fit leaves up to 2 % of its curvature along it (docs/lab/mesh.md). */
static const double FITTED_LINE_RATIO = 0.03;

/* Replaces a body by one with the request's own parameters. */
static enum percuss_status vary_body(struct problem *problem, size_t index, struct fault *fault)
{
    const struct solve_body *asked = &problem->request->bodies[index];
    struct body *varied = arena_take(problem->arena, 1, sizeof *varied);
    struct fault reason = {0};
    if (!varied)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (body_vary(problem->bodies[index], asked->variations, asked->variation_count, varied,
                  &reason))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "bodies[%zu].overrides: %.500s", index,
                         reason.text);
    problem->bodies[index] = varied;
    return PERCUSS_OK;
}

/* Refuses a body that is still being made of its mesh, or could not be. */
static enum percuss_status refuse_order(const struct body_order *order, size_t index,
                                        struct fault *fault)
{
    struct body_news news = body_order_news(order);
    return fault_set(fault, news.status, "bodies[%zu].id: '%s': %s", index, order->id, news.text);
}

static enum percuss_status find_bodies(struct problem *problem, const struct body_set *catalogue,
                                       struct fault *fault)
{
    for (size_t i = 0; i < problem->body_count; i++) {
        const struct solve_body *body = &problem->request->bodies[i];
        /* the catalogue's, or with parameters of the request's own */
        problem->bodies[i] = body_set_find(catalogue, body->id);
        if (!problem->bodies[i] && body_set_order(catalogue, body->id))
            return refuse_order(body_set_order(catalogue, body->id), i, fault);
        if (!problem->bodies[i])
            return fault_set(fault, PERCUSS_UNKNOWN_BODY,
                             "bodies[%zu].id: '%s': not in the catalogue (%zu bodies; percuss "
                             "bodies lists them)",
                             i, body->id, catalogue->count);
        enum percuss_status status = PERCUSS_OK;
        if (body->variation_count > 0)
            status = vary_body(problem, i, fault);
        if (status)
            return status;
        /* where it is */
        memcpy(problem->poses[i].position, body->position, sizeof body->position);
        rotation_matrix(body->orientation, problem->poses[i].rotation);
    }
    return PERCUSS_OK;
}

static enum percuss_status place_side(struct problem *problem, const struct solve_contact *contact,
                                      size_t index, int which, double allowed, struct fault *fault)
{
    struct contact_side *side = &problem->sides[index][which];
    side->body = which == 0 ? contact->a : contact->b;
    const struct body *body = problem->bodies[side->body];
    const struct pose *pose = &problem->poses[side->body];
    /* the force pushes a along +n and b along -n; outward normals are the opposite */
    double push[3];
    double outward[3];
    scale3(which == 0 ? 1.0 : -1.0, contact->normal, push);
    scale3(-1.0, push, outward);
    /* the point on the body, and how it loads the modes */
    enum percuss_status status =
        site_locate(body, pose, contact->point, outward, allowed, index, &side->site, fault);
    if (status)
        return status;
    side->material = body_material_at(body, &side->site);
    rotate_back3(pose->rotation, push, side->direction);
    site_load_find(body, &side->site, side->direction, false, &side->load);
    return PERCUSS_OK;
}

/* Refuses surfaces that do not touch in one point there: a line or a plane, or a hollow that is
 * narrower than the body in it. */
static enum percuss_status refuse_shape(const struct problem *problem, size_t index,
                                        const double curvature[2], struct fault *fault)
{
    const struct solve_contact *contact = &problem->request->contacts[index];
    const char *ids[2] = {problem->bodies[contact->a]->id, problem->bodies[contact->b]->id};
    double along[2];
    site_least_curvatures(&problem->sides[index][0].site, &problem->poses[contact->a],
                          &problem->sides[index][1].site, &problem->poses[contact->b],
                          contact->normal, along);
    int hollow = along[0] < along[1] ? 0 : 1;
    double largest = larger(fabs(along[0]), fabs(along[1]));
    /* neither lies closer than the other leaves room for */
    if (!(2.0 * curvature[0] < -HERTZ_LINE_RATIO * largest))
        return fault_set(
            fault, PERCUSS_UNSUPPORTED_GEOMETRY,
            "contacts[%zu]: %s on %s touch in a %s there (relative curvatures %.3g and "
            "%.3g 1/m): only a point contact of two smooth surfaces is supported",
            index, ids[0], ids[1], curvature[1] > 0.0 ? "line" : "face", 2.0 * curvature[0],
            2.0 * curvature[1]);
    return fault_set(
        fault, PERCUSS_UNSUPPORTED_GEOMETRY,
        "contacts[%zu]: %s does not fit into the hollow of %s there: its radius of curvature is "
        "%.3g m, the hollow's %.3g m; they touch %s",
        index, ids[1 - hollow], ids[hollow], 1.0 / along[1 - hollow], -1.0 / along[hollow],
        curvature[1] > 0.0 ? "in two places beside it, which are contacts of their own"
                           : "along a ring about it, which is not supported");
}

/* On both surfaces, and as an ellipse. */
static enum percuss_status find_place(struct problem *problem, size_t index, struct fault *fault)
{
    const struct solve_contact *contact = &problem->request->contacts[index];
    const struct body *a = problem->bodies[contact->a];
    const struct body *b = problem->bodies[contact->b];
    /* a contact is a point: no two planes */
    double smallest = smaller(body_smallest_radius(a), body_smallest_radius(b));
    if (!isfinite(smallest))
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "contacts[%zu]: %s on %s: two planes do not touch in a point", index,
                         a->id, b->id);
    /* on both surfaces */
    for (int which = 0; which < 2; which++) {
        enum percuss_status status =
            place_side(problem, contact, index, which, OFF_SURFACE * smallest, fault);
        if (status)
            return status;
    }
    /* with curvatures that make it an ellipse */
    double curvature[2];
    site_relative_curvature(&problem->sides[index][0].site, &problem->poses[contact->a],
                            &problem->sides[index][1].site, &problem->poses[contact->b],
                            contact->normal, curvature);
    if (!(curvature[0] > HERTZ_LINE_RATIO * curvature[1]))
        return refuse_shape(problem, index, curvature, fault);
    problem->hertz[index] =
        prepared_contact_get(problem->cache,
                             hertz_effective_modulus(problem_material(problem, index, 0),
                                                     problem_material(problem, index, 1)),
                             curvature);
    return PERCUSS_OK;
}

/* Whether the curvatures make a point as far as a mesh's fit knows them. */
static enum percuss_status check_fit(const struct problem *problem, size_t index,
                                     struct fault *fault)
{
    const struct contact_side *sides = problem->sides[index];
    const double *curvature = problem->hertz[index].curvature;
    bool fitted = sides[0].site.spot.fitted || sides[1].site.spot.fitted;
    if (!fitted || curvature[0] > FITTED_LINE_RATIO * curvature[1])
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                     "contacts[%zu]: %s on %s touch in a line there (relative curvatures %.3g and "
                     "%.3g 1/m, whose ratio a mesh does not know below %g: declare the site's)",
                     index, problem->bodies[sides[0].body]->id, problem->bodies[sides[1].body]->id,
                     2.0 * curvature[0], 2.0 * curvature[1], FITTED_LINE_RATIO);
}

static void find_rates(struct problem *problem, size_t index)
{
    const double *normal = problem->request->contacts[index].normal;
    double *sliding = problem->sliding[index];
    solve_contact_velocity(problem->request, index, sliding);
    problem->gap_rate[index] = dot3(normal, sliding);
    add_scaled3(-problem->gap_rate[index], normal, sliding);
}

/* The request's w_i^T M^-1 w_j, or that of the bodies which both rows share. */
static double inverse_mass(const struct problem *problem, size_t i, size_t j)
{
    return problem->from_client ? problem->request->delassus[problem_stated_place(problem, i, j)]
                                : problem_inverse_mass(problem, i, j);
}

/* Of the tangents too. Symmetric to the bit: rows of which one moves the other by rounding alone
 * are not coupled one way. False: out of memory. */
static bool fill_row_w(struct problem *problem)
{
    size_t n = problem->contact_count, rows = problem_rows(problem);
    problem->row_w = problem->w;
    if (problem->friction_count == 0)
        return true;
    problem->row_w = arena_take(problem->arena, rows * rows, sizeof *problem->row_w);
    if (!problem->row_w)
        return false;
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j <= i; j++)
            problem->row_w[i * rows + j] = problem->row_w[j * rows + i] =
                i < n ? problem->w[i * n + j] : inverse_mass(problem, i, j);
    return true;
}

/* Every contact must be able to move along its normal. */
static enum percuss_status check_motion(const struct problem *problem, struct fault *fault)
{
    size_t n = problem->contact_count;
    for (size_t i = 0; i < n; i++) {
        if (problem->w[i * n + i] >= MIN_INVERSE_MASS &&
            problem->w[i * n + i] <= 1.0 / MIN_INVERSE_MASS)
            continue;
        if (problem->from_client)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "delassus[%zu]: %g: the diagonal must be between %g and %g 1/kg",
                             problem_stated_place(problem, i, i), problem->w[i * n + i],
                             MIN_INVERSE_MASS, 1.0 / MIN_INVERSE_MASS);
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contacts[%zu]: neither %s nor %s can move rigidly there: at least one "
                         "partner must (or send the simulator's delassus)",
                         i, problem_body(problem, i, 0)->id, problem_body(problem, i, 1)->id);
    }
    return PERCUSS_OK;
}

/* A matrix of all rows must be symmetric, to the rounding of their contacts' inverse masses. */
static enum percuss_status check_symmetry(const struct problem *problem, struct fault *fault)
{
    size_t rows = problem_rows(problem);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < i; j++) {
            double scale =
                sqrt(problem_row_scale(problem, i)) * sqrt(problem_row_scale(problem, j));
            double a = inverse_mass(problem, i, j);
            double b = inverse_mass(problem, j, i);
            if (!(fabs(a - b) <= ASYMMETRY * scale))
                return fault_set(fault, PERCUSS_BAD_REQUEST,
                                 "delassus[%zu] and [%zu]: %g and %g: the matrix must be symmetric",
                                 problem_stated_place(problem, i, j),
                                 problem_stated_place(problem, j, i), a, b);
        }
    return PERCUSS_OK;
}

/* And positive semidefinite: normals and tangents together. */
static enum percuss_status check_definite(const struct problem *problem, struct fault *fault)
{
    size_t rows = problem_rows(problem);
    double *scratch = arena_take(problem->arena, rows * (2 * rows + 1), sizeof *scratch);
    if (!scratch)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    double ratio = linear_pseudo_inverse(rows, problem->row_w, NULL_EIGENVALUE, scratch,
                                         scratch + rows * rows);
    if (!(ratio >= -INDEFINITE))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "delassus: smallest eigenvalue is %g of the largest: the matrix must be "
                         "positive semidefinite",
                         ratio);
    return PERCUSS_OK;
}

/* A tangent along which a mechanism hardly moves is one along which it does not: the rest is
 * rounding, of which the tolerances of rates would be made. */
static void hold_tangents(struct problem *problem)
{
    size_t rows = problem_rows(problem);
    for (size_t r = problem->contact_count; r < rows; r++) {
        if (problem->row_w[r * (rows + 1)] > NULL_EIGENVALUE * problem_row_scale(problem, r))
            continue;
        for (size_t i = 0; i < rows; i++)
            problem->row_w[r * rows + i] = problem->row_w[i * rows + r] = 0.0;
    }
}

/* The simulator's own where it sends one. */
static enum percuss_status choose_w(struct problem *problem, struct fault *fault)
{
    size_t n = problem->contact_count;
    problem->from_client = problem->request->delassus != NULL;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            problem->w[i * n + j] = inverse_mass(problem, i, j);
    if (!fill_row_w(problem))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = check_motion(problem, fault);
    if (status || !problem->from_client)
        return status;
    status = check_symmetry(problem, fault);
    if (!status && problem_rows(problem) > 1)
        status = check_definite(problem, fault);
    if (!status)
        hold_tangents(problem);
    return status;
}

/* 0 <= W P + gap rate, complementary to P >= 0: Eq. (4) for one contact. */
static enum percuss_status find_compression(struct problem *problem, struct fault *fault)
{
    size_t n = problem->contact_count;
    if (n == 1) {
        problem->impulse_compression[0] = larger(0.0, -problem->gap_rate[0] / problem->w[0]);
        return PERCUSS_OK;
    }
    enum lcp_outcome outcome =
        lcp_solve(n, problem->w, problem->gap_rate, problem->impulse_compression);
    if (outcome == LCP_NO_MEMORY)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (outcome == LCP_UNSOLVED)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "delassus: no impulses satisfy 0 <= W P + gap rate with P >= 0: check the "
                         "matrix");
    return PERCUSS_OK;
}

static enum percuss_status check_approach(const struct problem *problem, struct fault *fault)
{
    double fastest = 0.0;
    bool approaches = false;
    for (size_t i = 0; i < problem->contact_count; i++) {
        fastest = larger(fabs(problem->gap_rate[i]), fastest);
        approaches = approaches || problem->gap_rate[i] < 0.0;
    }
    if (!(fastest <= MAX_SPEED))
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "bodies[].velocity: a gap rate of %g m/s: at most %g m/s is allowed",
                         fastest, MAX_SPEED);
    if (!approaches)
        return fault_set(fault, PERCUSS_NOT_APPROACHING,
                         "contacts[0]: gap rate n.(v_a - v_b) = %+g m/s: at least one contact must "
                         "approach (gap rate < 0; the normal points from b to a)",
                         problem->gap_rate[0]);
    return PERCUSS_OK;
}

/* The planes of a body's modes: those that the first load that bends it excites. */
static void choose_planes(struct problem *problem, size_t body)
{
    const struct body *bent = problem->bodies[body];
    struct bending_axes *axes = &problem->axes[body];
    bool chosen = false;
    *axes = (struct bending_axes){0, 1.0, 0.0};
    for (size_t i = 0; !chosen && i < 2 * problem->contact_count; i++) {
        const struct contact_side *side = &problem->sides[i / 2][i % 2];
        chosen = side->body == body && bending_axes_choose(bent, &side->load, axes);
    }
    for (size_t i = 0; !chosen && i < 4 * problem->friction_count; i++) {
        const struct contact_friction *friction = &problem->friction[i / 4];
        const struct contact_tangent *tangent = &friction->sides[i / 2 % 2][i % 2];
        chosen = problem->sides[friction->contact][i % 2].body == body &&
                 bending_axes_choose(bent, &tangent->load, axes);
    }
    if (axes->sine != 0.0)
        oblique_turn(problem, body);
    for (size_t i = 0; axes->sine != 0.0 && i < 2 * problem->contact_count; i++) {
        struct contact_side *side = &problem->sides[i / 2][i % 2];
        if (side->body == body)
            bending_axes_turn_load(bent, axes, &side->load);
    }
}

/* Of all bodies, after the contacts are placed; states are turned with them. False: out of memory.
 */
static bool choose_all_planes(struct problem *problem)
{
    for (size_t b = 0; b < problem->body_count; b++) {
        const struct body_state *state = problem->request->bodies[b].state;
        choose_planes(problem, b);
        problem->states[b] = state;
        if (state && problem->axes[b].sine != 0.0)
            problem->states[b] = body_state_turned(state, &problem->axes[b], problem->arena);
        if (state && !problem->states[b])
            return false;
    }
    return true;
}

static bool allocate_contacts(struct problem *problem)
{
    size_t n = problem->contact_count;
    problem->sides = arena_reserve(problem->arena, n, sizeof *problem->sides); /* large */
    problem->hertz = arena_take(problem->arena, n, sizeof *problem->hertz);
    problem->gap_rate = arena_take(problem->arena, 3 * n, sizeof(double));
    problem->sliding = arena_take(problem->arena, n, sizeof *problem->sliding);
    problem->w = arena_take(problem->arena, n * n, sizeof(double));
    problem->impulse_compression = arena_take(problem->arena, n, sizeof(double));
    return problem->sides && problem->hertz && problem->gap_rate && problem->sliding &&
           problem->w && problem->impulse_compression;
}

enum percuss_status placement_find_rates(struct problem *problem, struct fault *fault)
{
    for (size_t i = 0; i < problem->request->contact_count; i++)
        find_rates(problem, i);
    for (size_t i = 0; i < problem->friction_count; i++) {
        const struct contact_friction *friction = &problem->friction[i];
        for (size_t t = 0; t < 2; t++)
            problem->gap_rate[problem->contact_count + 2 * i + t] =
                dot3(friction->tangent[t], problem->sliding[friction->contact]);
    }
    enum percuss_status status = check_approach(problem, fault);
    return status ? status : find_compression(problem, fault);
}

/* Refuses a place whose flexibility is not solved for yet. A daemon that has made the body itself
 * is asked for it. */
static enum percuss_status refuse_unsolved(const struct body *body, const struct body_order *order,
                                           const double foot[3], size_t index, struct fault *fault)
{
    if (!order)
        return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                         "contacts[%zu].point: on mesh %s: its flexibility there is not solved for "
                         "yet: percuss-reduce --add-sites '%s' --site %.9g,%.9g,%.9g solves it",
                         index, body->id, body->mesh->path ? body->mesh->path : "BODY.h5", foot[0],
                         foot[1], foot[2]);
    body_order_want(order, foot);
    struct body_news news = body_order_news(order);
    return fault_set(fault, news.status, "contacts[%zu].point: on mesh %s: %s", index, body->id,
                     news.text);
}

/* All places of the request that wait are asked for together. */
static enum percuss_status check_solved(const struct problem *problem,
                                        const struct body_set *catalogue, struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; i < problem->contact_count; i++)
        for (int which = 0; which < 2; which++) {
            const struct contact_side *side = &problem->sides[i][which];
            const struct body *body = problem->bodies[side->body];
            if (side->site.spot.unsolved && body_is_flexible(body))
                status = refuse_unsolved(body, body_set_order(catalogue, body->id),
                                         side->site.spot.foot, i, fault);
        }
    return status;
}

/* All contacts on the problem's bodies, with W and the rates. */
static enum percuss_status place_contacts(struct problem *problem, const struct body_set *catalogue,
                                          struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    problem->friction_count = 0;
    for (size_t i = 0; !status && i < problem->contact_count; i++) {
        status = find_place(problem, i, fault);
        if (!status)
            status = check_fit(problem, i, fault);
    }
    if (!status)
        status = oblique_find(problem, catalogue, fault);
    if (!status && !choose_all_planes(problem))
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    if (!status)
        status = choose_w(problem, fault);
    return status ? status : placement_find_rates(problem, fault);
}

enum percuss_status placement_find(struct problem *problem, const struct body_set *catalogue,
                                   struct fault *fault)
{
    if (!allocate_contacts(problem))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_status status = find_bodies(problem, catalogue, fault);
    if (!status)
        status = place_contacts(problem, catalogue, fault);
    /* once more, on bodies as their materials have relaxed */
    if (!status && relaxed_any(problem)) {
        status = relaxed_bodies(problem, fault);
        if (!status)
            status = place_contacts(problem, catalogue, fault);
    }
    return status ? status : check_solved(problem, catalogue, fault);
}

enum percuss_status formulate(struct problem *problem, const struct solve_context *context,
                              struct fault *fault)
{
    struct pace pace = {.watch = &context->watch};
    enum percuss_status status = placement_find(problem, context->catalogue, fault);
    if (!status)
        status = contact_model_choose(problem, context->catalogue, context->tables, fault);
    if (!status && problem->request->options.contact_model != PERCUSS_CONTACT_COMPLETE_FE)
        status = vibration_lend(problem, context->catalogue->boxes, &pace, fault);
    if (!status)
        status = oblique_check(problem, fault);
    if (!status)
        status = compliance_choose(problem, context->catalogue->compliance, fault);
    if (!status)
        status = deviation_shift(problem, fault);
    return status;
}

bool formulation_revise(struct problem *problem, const struct scene *scene,
                        const struct impact_outcome *outcome)
{
    struct fault lost; /* of memory: the arena tells */
    bool laws = contact_model_revise(problem, outcome);
    bool revised = laws || compliance_revise(problem, scene, outcome);
    if (laws)
        deviation_shift(problem, &lost);
    return revised;
}
