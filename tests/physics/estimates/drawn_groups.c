/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/drawn.h"

/* A sphere of that radius at a height, moving along z. */
static void add_sphere(struct lab *lab, uint64_t *r, struct solve_request *request,
                       const double at[3], double radius)
{
    struct solve_body *body = &request->bodies[request->body_count];
    *body = (struct solve_body){.orientation = {1.0, 0.0, 0.0, 0.0}};
    snprintf(body->id, sizeof body->id, "s%zu", request->body_count);
    memcpy(body->position, at, sizeof body->position);
    lab_add(lab, body->id, make_sphere(scene_material(r), radius));
    request->body_count++;
}

static void add_contact(struct solve_request *request, size_t a, size_t b, const double point[3],
                        double gap)
{
    struct solve_contact *contact = &request->contacts[request->contact_count++];
    *contact = (struct solve_contact){
        .a = (unsigned)a, .b = (unsigned)b, .normal = {0.0, 0.0, 1.0}, .gap = gap};
    memcpy(contact->point, point, sizeof contact->point);
}

/* In half of the scenes all touch. */
void scene_draw_group(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    struct solve_request *request = &scene->request;
    size_t count = 2 + (size_t)scene_pick(r, 4);
    const struct body *beam = scene_beam(lab, r, "beam");
    double length = beam->length;
    bool touching = scene_pick(r, 2);
    bool together = scene_pick(r, 2);
    bool stacked = scene_pick(r, 4) == 0;
    bool resting = stacked && scene_pick(r, 2); /* nobody comes but the one on top */
    double speed = scene_log(r, 0.03, 1.0);
    double fastest = 0.0;
    request->bodies[0] = (struct solve_body){.id = "beam", .orientation = {1.0, 0.0, 0.0, 0.0}};
    request->body_count = 1;
    for (size_t i = 0; i < count; i++) {
        /* apart from each other, in slots of the length */
        double x =
            length * ((0.5 + (double)i + random_between(r, -0.4, 0.4)) / (double)count - 0.5);
        double ball = beam->radius * scene_log(r, 0.3, 4.0);
        double gap = touching ? 0.0 : scene_log(r, 1e-8, 1e-4);
        add_sphere(lab, r, request, (double[]){x, 0.0, beam->radius + ball + gap}, ball);
        add_contact(request, i + 1, 0, (double[]){x, 0.0, beam->radius}, gap);
        double v = together ? speed : speed * random_between(r, -0.1, 1.0);
        v = resting ? 0.0 : v;
        fastest = fmax(fastest, v);
        request->bodies[i + 1].velocity[2] = -v;
    }
    if (stacked) { /* one more comes down on the last, which rests */
        const struct solve_body *below = &request->bodies[count];
        double ball = lab->bodies[count].radius;
        double upper = ball * scene_log(r, 0.5, 2.0);
        double top = below->position[2] + ball;
        double x = below->position[0];
        request->bodies[count].velocity[2] = 0.0;
        add_sphere(lab, r, request, (double[]){x, 0.0, top + upper}, upper);
        add_contact(request, count + 1, count, (double[]){x, 0.0, top}, 0.0);
        request->bodies[count + 1].velocity[2] = -speed;
        fastest = speed;
    }
    if (fastest == 0.0) /* nobody approaches */
        request->bodies[1].velocity[2] = -speed;
    scene_say(scene, "%zu spheres%s on a beam r %.4g mm L %.4g m zeta %.2g, %s, up to %.4g m/s",
              count,
              resting   ? " at rest, one more on the last,"
              : stacked ? ", one more on the last,"
                        : "",
              1e3 * beam->radius, length, beam->damping, touching ? "touching" : "with gaps",
              fmax(fastest, speed));
}

/* In contact, with gaps, or some of both; hit from one end, from both, or all in motion. */
void scene_draw_row(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    struct solve_request *request = &scene->request;
    size_t count = 2 + (size_t)scene_pick(r, 19);
    int gaps = scene_pick(r, 3);
    int motion = scene_pick(r, 3);
    bool equal = scene_pick(r, 2);
    double usual = scene_log(r, 0.002, 0.02);
    double speed = scene_log(r, 0.03, 1.0);
    struct material material = scene_material(r);
    double z = 0.0;
    for (size_t i = 0; i < count; i++) {
        double radius = equal ? usual : usual * scene_log(r, 0.5, 2.0);
        double gap = gaps == 0 || (gaps == 1 && scene_pick(r, 2)) ? 0.0 : scene_log(r, 1e-9, 1e-4);
        gap = i ? gap : 0.0;
        z -= gap;
        add_sphere(lab, r, request, (double[]){0.0, 0.0, z - radius}, radius);
        if (equal)
            lab_add(lab, request->bodies[i].id, make_sphere(material, radius));
        if (i)
            add_contact(request, i - 1, i, (double[]){0.0, 0.0, z + 0.5 * gap}, gap);
        if (motion == 2)
            request->bodies[i].velocity[2] =
                speed * random_between(r, -1.0, 1.0) * (scene_pick(r, 2) ? 1.0 : 0.0);
        z -= 2.0 * radius;
    }
    request->bodies[0].velocity[2] = -speed;
    if (motion)
        request->bodies[count - 1].velocity[2] = speed * random_between(r, 0.2, 1.0);
    scene_say(scene, "row of %zu %s spheres, R %.4g mm, %.4g m/s, %s, %s", count,
              equal ? "equal" : "unlike", 1e3 * usual, speed,
              gaps == 0   ? "touching"
              : gaps == 1 ? "gaps between some"
                          : "gaps",
              motion == 0   ? "hit from one end"
              : motion == 1 ? "hit from both ends"
                            : "in motion");
}
