/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/drawn_model.h"

static const struct {
    const char *word, *text;
} classes[MODEL_COUNT] = {
#define X(name, word, text) [MODEL_##name] = {word, text},
    MODEL_CLASSES(X)
#undef X
};

static const double LEAST_DEPTH = 2.0; /* indentations of first yield */
static const double DEEPEST = 0.02;    /* radii of the sphere: strains are small */

const char *model_class_word(enum model_class class)
{
    return classes[class].word;
}

const char *model_class_text(enum model_class class)
{
    return classes[class].text;
}

enum model_class model_class_find(const char *word)
{
    int class = 0;
    while (class < MODEL_COUNT && strcmp(word, classes[class].word) != 0)
        class ++;
    return (enum model_class) class;
}

/* From magnesium to tungsten in stiffness. */
static struct material draw_elastic(uint64_t *r, const char *name)
{
    struct material one = {.young = scene_log(r, 45e9, 400e9),
                           .poisson = random_between(r, 0.2, 0.36),
                           .density = scene_log(r, 1800.0, 12000.0),
                           .yield = INFINITY};
    snprintf(one.name, sizeof one.name, "%s", name);
    return one;
}

/* A third of them without hardening. */
static void draw_yield(uint64_t *r, struct material *metal)
{
    double share = scene_log(r, 0.005, 0.2);
    metal->yield = scene_log(r, 60e6, 700e6);
    metal->tangent = scene_pick(r, 3) ? share * metal->young : 0.0;
}

static struct spot draw_target(struct lab *lab, enum model_class class, uint64_t *r, double sphere,
                               struct material material)
{
    double ratio = scene_log(r, 0.6, 4.0);
    double radius = ratio * sphere;
    double slenderness = random_between(r, 8.0, 50.0);
    double length = random_between(r, 1.5, 4.0) * radius;
    struct body body = make_body(&cylinder_kind, material);
    if (class == MODEL_PAIR) {
        lab_add(lab, "target", make_sphere(material, radius));
        return (struct spot){"target", {0.0, 0.0, radius}, {0.0, 0.0, 1.0}, 0.0};
    }
    if (class == MODEL_CYLINDER) {
        body.radius = 1.5 * radius;
        body.length = length;
        lab_add(lab, "target", body);
        return end_spot("target", length);
    }
    if (class == MODEL_BLOCK) {
        body.kind = &block_kind;
        body.size[0] = body.size[1] = 3.0 * radius;
        body.size[2] = length;
        lab_add(lab, "target", body);
        return (struct spot){"target", {0.0, 0.0, 0.5 * length}, {0.0, 0.0, 1.0}, 0.0};
    }
    length = slenderness * radius;
    lab_add(lab, "target", make_bar(&rod_kind, material, radius, length));
    return end_spot("target", length);
}

static void draw_once(struct lab *lab, enum model_class class, uint64_t *r,
                      struct model_scene *scene)
{
    struct material ball = draw_elastic(r, "first");
    struct material target = draw_elastic(r, "second");
    double sphere = scene_log(r, 3e-3, 25e-3);
    double speed = scene_log(r, 0.1, 3.0);
    bool yields = class == MODEL_ROD || class == MODEL_BALL;
    if (class > MODEL_BALL)
        yields = scene_pick(r, 3) > 0;
    if (yields)
        draw_yield(r, class == MODEL_BALL ? &ball : &target);
    lab_add(lab, "ball", make_sphere(ball, sphere));
    struct spot spot = draw_target(lab, class, r, sphere, target);
    const struct body *hit = &lab->bodies[1];
    scene->request = strike(sphere_spot("ball", sphere), spot, speed);
    snprintf(scene->text, sizeof scene->text,
             "R %.3g mm on %s of %.3g mm, %.3g m/s; %.3g GPa/%.2f/%.0f %.3g MPa +%.3g GPa; %.3g "
             "GPa/%.2f/%.0f %.3g MPa +%.3g GPa",
             1e3 * sphere, hit->kind->name,
             1e3 * (hit->length + hit->size[2] + (class == MODEL_PAIR ? hit->radius : 0.0)), speed,
             1e-9 * ball.young, ball.poisson, ball.density, 1e-6 * ball.yield, 1e-9 * ball.tangent,
             1e-9 * target.young, target.poisson, target.density, 1e-6 * target.yield,
             1e-9 * target.tangent);
}

/* Whether it yields where it may, and not too deep. No solution is asked: scenes stay what they are
 * when laws change. All of the energy goes into Hertz's spring, or into a cap under 2.8 yield
 * stresses, pi p R d^2; first yield after Johnson, Contact Mechanics, section 6.1: p0 = 1.6 yield
 * stresses. */
static bool suits(const struct lab *lab, double speed)
{
    const struct body *ball = &lab->bodies[0];
    const struct body *target = &lab->bodies[1];
    double yield = fmin(ball->material.yield, target->material.yield);
    double radius = ball->radius;
    if (target->kind == &sphere_kind)
        radius = 1.0 / (1.0 / radius + 1.0 / target->radius);
    double k = sphere_plane_stiffness(ball->material, target->material, radius);
    double energy = 0.5 * speed * speed / (1.0 / ball->mass + 1.0 / target->mass);
    double elastic = pow(2.5 * energy / k, 0.4);
    double modulus = 0.75 * k / sqrt(radius);
    double first = pow(1.6 * M_PI * yield / (2.0 * modulus), 2.0) * radius;
    double plastic = sqrt(energy / (2.8 * yield * M_PI * radius));
    return (isinf(yield) || elastic > LEAST_DEPTH * first) &&
           fmax(elastic, plastic) < DEEPEST * radius;
}

void model_draw(struct lab *lab, enum model_class class, uint64_t number, struct model_scene *scene)
{
    uint64_t r = (number * MODEL_COUNT + class + 1) * 0xD1342543DE82EF95u;
    for (int i = 0; i < 20; i++) /* neighbouring seeds part */
        random_between(&r, 0.0, 1.0);
    for (int i = 0; i < 1000; i++) {
        draw_once(lab, class, &r, scene);
        if (suits(lab, -scene->request.bodies[0].velocity[2]))
            return;
    }
    fail_msg("%s %llu: nothing suits", classes[class].word, (unsigned long long)number);
}
