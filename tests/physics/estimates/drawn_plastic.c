/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/drawn_plastic.h"

static const struct {
    const char *word, *text;
} classes[PLASTIC_COUNT] = {
#define X(name, word, text) [PLASTIC_##name] = {word, text},
    PLASTIC_CLASSES(X)
#undef X
};

static const double LEAST_DEPTH = 3.0; /* indentations of first yield */
static const double DEEPEST = 0.02;    /* radii of the sphere */

const char *plastic_class_word(enum plastic_class class)
{
    return classes[class].word;
}

const char *plastic_class_text(enum plastic_class class)
{
    return classes[class].text;
}

enum plastic_class plastic_class_find(const char *word)
{
    int class = 0;
    while (class < PLASTIC_COUNT && strcmp(word, classes[class].word) != 0)
        class ++;
    return (enum plastic_class) class;
}

/* From lead to tungsten in stiffness; a third of them without hardening. */
static struct material draw_metal(uint64_t *r, const char *name)
{
    struct material metal = {.young = scene_log(r, 45e9, 220e9),
                             .poisson = random_between(r, 0.27, 0.36),
                             .density = scene_log(r, 1800.0, 8900.0),
                             .yield = scene_log(r, 60e6, 700e6)};
    double share = scene_log(r, 0.005, 0.2);
    metal.tangent = scene_pick(r, 3) ? share * metal.young : 0.0;
    snprintf(metal.name, sizeof metal.name, "%s", name);
    return metal;
}

/* Hardened steel, ceramics: what leaves dents and has none. */
static struct material draw_elastic(uint64_t *r)
{
    return (struct material){.name = "elastic",
                             .young = scene_log(r, 60e9, 600e9),
                             .poisson = random_between(r, 0.2, 0.32),
                             .density = scene_log(r, 2500.0, 15000.0),
                             .yield = INFINITY};
}

static void draw_once(struct lab *lab, enum plastic_class class, uint64_t *r,
                      struct plastic_scene *scene)
{
    struct material metal = draw_metal(r, "metal");
    struct material other = draw_elastic(r);
    double sphere = scene_log(r, 3e-3, 25e-3);
    double ratio =
        class == PLASTIC_THICK ? random_between(r, 1.5, 4.0) : random_between(r, 0.6, 1.2);
    double length = ratio * sphere * random_between(r, 8.0, 50.0);
    double speed = scene_log(r, 0.15, 3.0);
    bool soft_ball = class == PLASTIC_BALL;
    scene->radius = sphere;
    lab_add(lab, "ball", make_sphere(soft_ball ? metal : other, sphere));
    lab_add(lab, "rod", make_bar(&rod_kind, soft_ball ? other : metal, ratio * sphere, length));
    scene->request = strike(sphere_spot("ball", sphere), end_spot("rod", length), speed);
    snprintf(scene->text, sizeof scene->text,
             "R %.3g mm, rod %.3g mm x %.3g m, %.3g m/s, metal %.3g GPa/%.2f/%.0f %.3g MPa tangent "
             "%.3g GPa, other %.3g GPa/%.2f/%.0f",
             1e3 * sphere, 1e3 * ratio * sphere, length, speed, 1e-9 * metal.young, metal.poisson,
             metal.density, 1e-6 * metal.yield, 1e-9 * metal.tangent, 1e-9 * other.young,
             other.poisson, other.density);
}

/* Whether it yields, and not too deep. No solution is asked: scenes stay what they are when laws
 * change. All of the energy goes into Hertz's spring, or into a cap under 2.8 yield stresses, pi p
 * R d^2; first yield after Johnson, Contact Mechanics, section 6.1: p0 = 1.6 yield stresses. */
static bool suits(const struct lab *lab, enum plastic_class class, double speed)
{
    const struct body *ball = &lab->bodies[0];
    const struct body *rod = &lab->bodies[1];
    const double yield = class == PLASTIC_BALL ? ball->material.yield : rod->material.yield;
    double radius = ball->radius;
    double k = sphere_plane_stiffness(ball->material, rod->material, radius);
    double energy = 0.5 * speed * speed / (1.0 / ball->mass + 1.0 / rod->mass);
    double elastic = pow(2.5 * energy / k, 0.4);
    double modulus = 0.75 * k / sqrt(radius);
    double first = pow(1.6 * M_PI * yield / (2.0 * modulus), 2.0) * radius;
    double plastic = sqrt(energy / (2.8 * yield * M_PI * radius));
    return elastic > LEAST_DEPTH * first && fmax(elastic, plastic) < DEEPEST * radius;
}

void plastic_draw(struct lab *lab, enum plastic_class class, uint64_t number,
                  struct plastic_scene *scene)
{
    uint64_t r = (number * PLASTIC_COUNT + class + 1) * 0x9E3779B97F4A7C15u;
    for (int i = 0; i < 20; i++) /* neighbouring seeds part */
        random_between(&r, 0.0, 1.0);
    for (int i = 0; i < 1000; i++) {
        draw_once(lab, class, &r, scene);
        if (suits(lab, class, -scene->request.bodies[0].velocity[2]))
            return;
    }
    fail_msg("%s %llu: nothing suits", classes[class].word, (unsigned long long)number);
}
