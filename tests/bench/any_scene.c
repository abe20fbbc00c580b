/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "any_scene.h"

/* Most bodies yield, from annealed lead to bearing steel; some harden. */
static void draw_yield(uint64_t *r, struct material *material)
{
    if (pick(r, 10) < 3)
        return;
    material->yield = fmin(log_between(r, 1e6, 3e9), 0.05 * material->young);
    material->tangent = pick(r, 3) ? 0.0 : material->young * log_between(r, 1e-4, 0.3);
}

/* The materials of the shipped tables (config/tables), which any two of them share. */
static void draw_tabulated(uint64_t *r, struct lab *lab)
{
    static const struct material list[] = {{"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0},
                                           {"al-205", 70e9, 0.33, 2700.0, 205e6, 0.0},
                                           {"al-575", 70e9, 0.33, 2700.0, 575e6, 0.0}};
    for (size_t b = 0; b < lab->set.count; b++)
        lab->bodies[b].material = list[b ? 1 + pick(r, 2) : 0];
}

static void draw_materials(uint64_t *r, struct lab *lab)
{
    bool tabulated = pick(r, 5) == 0;
    if (tabulated)
        draw_tabulated(r, lab);
    for (size_t b = 0; b < lab->set.count; b++) {
        struct body body = lab->bodies[b];
        if (!tabulated)
            draw_yield(r, &body.material);
        lab_add(lab, body.id, body);
    }
}

static void draw_gaps(uint64_t *r, struct solve_request *request)
{
    for (size_t c = 0; c < request->contact_count; c++) {
        struct solve_contact *contact = &request->contacts[c];
        int kind = pick(r, 8);
        if (kind < 3)
            contact->gap = (kind ? -1.0 : 1.0) * log_between(r, 1e-10, 1e-3);
        if (pick(r, 3) == 0)
            contact->gap_acceleration = (pick(r, 3) ? -1.0 : 1.0) * log_between(r, 1e-2, 1e6);
    }
}

static void draw_options(uint64_t *r, struct solve_options *options)
{
    static const enum percuss_contact_model models[] = {
        PERCUSS_CONTACT_AUTO,        PERCUSS_CONTACT_AUTO,        PERCUSS_CONTACT_HERTZ,
        PERCUSS_CONTACT_CLOSED_FORM, PERCUSS_CONTACT_CLOSED_FORM, PERCUSS_CONTACT_TABLE};
    options->tolerance = pick(r, 8) ? log_between(r, 1e-6, 1e-2) : 0.0;
    options->contact_model = models[pick(r, (int)COUNT(models))];
    options->compliance = (enum percuss_compliance)pick(r, PERCUSS_COMPLIANCE_COUNT);
    options->dents = pick(r, 4) ? PERCUSS_DENTS_KEEP : PERCUSS_DENTS_IGNORE;
    options->conditioning = pick(r, 10) == 0;
    options->trace = pick(r, 3) == 0;
}

static void draw_blows(uint64_t *r, struct any_scene *scene)
{
    scene->blows = pick(r, 3) ? 1 : 2 + (size_t)pick(r, ANY_SCENE_MOST_BLOWS - 1);
    for (size_t i = 0; i < scene->blows; i++) {
        scene->elapsed[i] = pick(r, 4) ? log_between(r, 1e-7, 0.1) : 0.0;
        scene->faster[i] = i ? log_between(r, 0.05, 20.0) : 1.0;
        scene->horizon[i] = pick(r, 6) ? 0.0 : log_between(r, 1e-5, 1.0);
    }
}

/* A quarter of the scenes have friction, of half-spaces in the contact, with motion along it. */
static void draw_friction(uint64_t *r, struct solve_request *request)
{
    if (pick(r, 4))
        return;
    double fastest = 0.0;
    for (size_t b = 0; b < request->body_count; b++)
        fastest = fmax(fastest, norm3(request->bodies[b].velocity));
    for (size_t c = 0; c < request->contact_count; c++)
        request->contacts[c].friction = pick(r, 4) ? log_between(r, 0.01, 3.0) : 0.0;
    for (size_t b = 0; b < request->body_count; b++)
        for (int i = 0; pick(r, 2) && i < 3; i++) {
            request->bodies[b].velocity[i] += fastest * random_between(r, -0.5, 0.5);
            request->bodies[b].angular_velocity[i] = random_between(r, -20.0, 20.0);
        }
    request->options.contact_model = PERCUSS_CONTACT_HERTZ;
}

void any_scene_draw(struct lab *lab, uint64_t number, struct any_scene *scene)
{
    uint64_t r = 0xd1b54a32d192ed03u * (number + 1);
    for (int i = 0; i < 8; i++)
        random_between(&r, 0.0, 1.0);
    draw_scene(lab, number, &scene->drawn);
    draw_materials(&r, lab);
    if (pick(&r, 2))
        draw_gaps(&r, &scene->drawn.request);
    draw_options(&r, &scene->drawn.request.options);
    draw_blows(&r, scene);
    draw_friction(&r, &scene->drawn.request);
}

struct solve_request any_scene_request(const struct any_scene *scene, size_t blow)
{
    struct solve_request request = scene->drawn.request;
    request.options.horizon = scene->horizon[blow];
    for (size_t b = 0; b < request.body_count; b++) {
        request.bodies[b].elapsed = blow ? scene->elapsed[blow] : 0.0;
        scale3(scene->faster[blow], request.bodies[b].velocity, request.bodies[b].velocity);
    }
    return request;
}
