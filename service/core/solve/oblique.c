/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/oblique.h"

#include <math.h>
#include <stdio.h>

#include "contact/friction.h"
#include "model/vector.h"
#include "solve/contact_model.h"

/* A stated tangent closer to the normal than this share of its length is none. */
static const double ALONG_NORMAL = 1e-6;

/* Coefficient and deviation of a contact; false: none. */
static bool find_coefficient(const struct problem *problem, const struct body_set *catalogue,
                             size_t contact, struct contact_friction *friction)
{
    double stated = problem->request->contacts[contact].friction;
    if (problem->request->options.friction == PERCUSS_FRICTION_NONE)
        return false;
    const struct friction_pair *pair = body_set_friction(
        catalogue, problem_material(problem, contact, 0), problem_material(problem, contact, 1));
    bool by_pair = stated == 0.0 && pair;
    friction->coefficient = by_pair ? pair->coefficient : stated;
    friction->deviation = by_pair ? pair->deviation : FRICTION_USUAL_DEVIATION * stated;
    double shift = problem->request->model_shift[SOLVE_SHIFT_FRICTION];
    if (shift != 0.0 && friction->coefficient > 0.0) {
        double variation = friction->deviation / friction->coefficient;
        friction->coefficient *= exp(shift * sqrt(log1p(variation * variation)));
    }
    const struct solve_friction *other = &problem->request->friction;
    if (other->given && other->contact == contact)
        friction->coefficient = other->coefficient;
    return friction->coefficient > 0.0;
}

static void across(const double normal[3], double tangent[3])
{
    add_scaled3(-dot3(normal, tangent), normal, tangent);
}

/* The first tangent of a contact: as stated, or by a fixed rule (the world's axis that is least
 * along the normal), made normal to it; world, unit. The second is normal x first. */
static void oblique_find_tangent(const struct solve_contact *contact, double tangent[3])
{
    double length = norm3(contact->tangent);
    if (length > 0.0) {
        scale3(1.0 / length, contact->tangent, tangent);
        across(contact->normal, tangent);
    }
    if (!(length > 0.0 && norm3(tangent) > ALONG_NORMAL)) {
        int least = 0;
        for (int i = 1; i < 3; i++)
            if (fabs(contact->normal[i]) < fabs(contact->normal[least]))
                least = i;
        for (int i = 0; i < 3; i++)
            tangent[i] = i == least;
        across(contact->normal, tangent);
    }
    scale3(1.0 / norm3(tangent), tangent, tangent);
}

/* The ratio of the stiffnesses, from the axes of the contact's ellipse to its tangents. */
static void find_ratio(const struct problem *problem, struct contact_friction *friction)
{
    size_t c = friction->contact;
    const struct solve_contact *contact = &problem->request->contacts[c];
    const struct contact_side *sides = problem->sides[c];
    double along[2], major[3];
    friction_ratios(&problem->hertz[c], problem_material(problem, c, 0),
                    problem_material(problem, c, 1), along);
    site_least_direction(&sides[0].site, &problem->poses[contact->a], &sides[1].site,
                         &problem->poses[contact->b], contact->normal, major);
    double x = dot3(major, friction->tangent[0]);
    double y = dot3(major, friction->tangent[1]);
    friction->ratio[0] = along[1] + (along[0] - along[1]) * x * x;
    friction->ratio[1] = (along[0] - along[1]) * x * y;
    friction->ratio[2] = along[1] + (along[0] - along[1]) * y * y;
}

static void place_tangents(const struct problem *problem, struct contact_friction *friction)
{
    const struct contact_side *sides = problem->sides[friction->contact];
    for (int t = 0; t < 2; t++)
        for (int which = 0; which < 2; which++) {
            struct contact_tangent *at = &friction->sides[t][which];
            double push[3];
            scale3(which == 0 ? 1.0 : -1.0, friction->tangent[t], push);
            rotate_back3(problem->poses[sides[which].body].rotation, push, at->direction);
            site_load_find(problem->bodies[sides[which].body], &sides[which].site, at->direction,
                           true, &at->load);
        }
}

/* A matrix of the normals alone says nothing of the tangents. */
static enum percuss_status refuse_normals(const struct problem *problem, struct fault *fault)
{
    size_t n = problem->contact_count;
    char instead[48] = "left out";
    if (n <= PERCUSS_MAX_CONTACTS_OBLIQUE)
        snprintf(instead, sizeof instead, "%zu x %zu", 3 * n, 3 * n);
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "delassus: %zu x %zu numbers: where a contact has friction it must be %s: 3 "
                     "rows for each of up to %d contacts, of its normal, first and second tangent "
                     "(options.friction none leaves friction out)",
                     n, n, instead, PERCUSS_MAX_CONTACTS_OBLIQUE);
}

enum percuss_status oblique_find(struct problem *problem, const struct body_set *catalogue,
                                 struct fault *fault)
{
    struct contact_friction friction;
    size_t count = 0;
    bool stated = catalogue->friction_count > 0 || problem->request->friction.given;
    for (size_t c = 0; c < problem->contact_count; c++)
        stated = stated || problem->request->contacts[c].friction > 0.0;
    if (!stated)
        return PERCUSS_OK;
    for (size_t c = 0; c < problem->contact_count; c++)
        count += find_coefficient(problem, catalogue, c, &friction);
    if (count == 0)
        return PERCUSS_OK;
    if (problem->request->delassus && !problem->request->delassus_oblique)
        return refuse_normals(problem, fault);
    problem->friction = arena_reserve(problem->arena, count, sizeof *problem->friction);
    if (!problem->friction)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    for (size_t c = 0; c < problem->contact_count; c++) {
        struct contact_friction *next = &problem->friction[problem->friction_count];
        *next = (struct contact_friction){.contact = c};
        if (!find_coefficient(problem, catalogue, c, next))
            continue;
        oblique_find_tangent(&problem->request->contacts[c], next->tangent[0]);
        cross3(problem->request->contacts[c].normal, next->tangent[0], next->tangent[1]);
        find_ratio(problem, next);
        place_tangents(problem, next);
        problem->friction_count++;
    }
    return PERCUSS_OK;
}

void oblique_turn(struct problem *problem, size_t body)
{
    for (size_t i = 0; i < problem->friction_count; i++) {
        struct contact_friction *friction = &problem->friction[i];
        for (int which = 0; which < 2; which++)
            for (int t = 0; t < 2; t++)
                if (problem->sides[friction->contact][which].body == body)
                    bending_axes_turn_load(problem->bodies[body], &problem->axes[body],
                                           &friction->sides[t][which].load);
    }
}

/* The request's own reason, and how to go on. */
static enum percuss_status refuse_friction(size_t contact, const char *reason, struct fault *fault)
{
    return fault_set(fault, PERCUSS_UNSUPPORTED_GEOMETRY,
                     "contacts[%zu].friction: %s (options.friction none leaves friction out)",
                     contact, reason);
}

enum percuss_status oblique_check(const struct problem *problem, struct fault *fault)
{
    const struct solve_options *options = &problem->request->options;
    if (problem->friction_count > 0 && options->friction == PERCUSS_FRICTION_PLAIN &&
        options->method == PERCUSS_METHOD_CVODE)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.friction: plain: method cvode has no contact that sticks without "
                         "compliance (method modal has; micro-slip or none)");
    for (size_t i = 0; i < problem->friction_count; i++) {
        size_t c = problem->friction[i].contact;
        if (contact_law_asked(options->contact_model)->method != CONTACT_BY_LAW)
            return refuse_friction(c, "finite elements have no friction: contact_model auto has",
                                   fault);
    }
    return PERCUSS_OK;
}

const struct contact_friction *oblique_of(const struct problem *problem, size_t contact)
{
    for (size_t i = 0; i < problem->friction_count; i++)
        if (problem->friction[i].contact == contact)
            return &problem->friction[i];
    return NULL;
}
