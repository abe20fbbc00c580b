/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/drawn.h"

static const struct {
    const char *word, *text;
} classes[CLASS_COUNT] = {
#define X(name, word, text) [CLASS_##name] = {word, text},
    SCENE_CLASSES(X)
#undef X
};

const char *scene_class_word(enum scene_class class)
{
    return classes[class].word;
}

const char *scene_class_text(enum scene_class class)
{
    return classes[class].text;
}

enum scene_class scene_class_find(const char *word)
{
    int class = 0;
    while (class < CLASS_COUNT && strcmp(word, classes[class].word) != 0)
        class ++;
    return (enum scene_class) class;
}

double scene_log(uint64_t *r, double low, double high)
{
    return exp(random_between(r, log(low), log(high)));
}

int scene_pick(uint64_t *r, int count)
{
    return (int)random_between(r, 0.0, count);
}

/* Metals and glass that never yield: the estimates are judged, not the laws. */
struct material scene_material(uint64_t *r)
{
    static const struct material list[] = {{"steel", 210e9, 0.30, 7800.0, INFINITY, 0.0},
                                           {"aluminium", 70e9, 0.33, 2700.0, INFINITY, 0.0},
                                           {"glass", 48e9, 0.20, 2800.0, INFINITY, 0.0},
                                           {"titanium", 114e9, 0.34, 4430.0, INFINITY, 0.0},
                                           {"brass", 100e9, 0.35, 8500.0, INFINITY, 0.0},
                                           {"acrylic", 3.2e9, 0.37, 1190.0, INFINITY, 0.0}};
    return list[scene_pick(r, scene_pick(r, 2) ? 2 : (int)COUNT(list))];
}

void scene_say(struct scene_drawn *scene, const char *format, ...)
{
    size_t used = strlen(scene->text);
    va_list args;
    va_start(args, format);
    vsnprintf(scene->text + used, sizeof scene->text - used, format, args);
    va_end(args);
}

static double draw_damping(uint64_t *r)
{
    return scene_pick(r, 3) ? 0.0 : scene_log(r, 1e-4, 0.05);
}

const struct body *scene_beam(struct lab *lab, uint64_t *r, const char *id)
{
    double radius = scene_log(r, 0.001, 0.02);
    struct body beam =
        make_bar(&beam_kind, scene_material(r), radius, radius * scene_log(r, 20.0, 200.0));
    beam.theory = scene_pick(r, 4) ? THEORY_TIMOSHENKO : THEORY_EULER_BERNOULLI;
    beam.damping = draw_damping(r);
    for (int end = 0; end < 2; end++)
        beam.supports[end] = (enum support)scene_pick(r, 3);
    return lab_add(lab, id, beam);
}

double scene_place(uint64_t *r, double length)
{
    int kind = scene_pick(r, 6);
    double side = scene_pick(r, 2) ? 1.0 : -1.0;
    if (kind == 0)
        return 0.0;
    if (kind < 4)
        return length * random_between(r, -0.5, 0.5);
    return side * length * (0.5 - scene_log(r, 1e-3, 0.1));
}

static void say_beam(struct scene_drawn *scene, const struct body *beam)
{
    static const char *const ends[] = {"free", "pinned", "clamped"};
    scene_say(scene, "%s %s-%s %s r %.4g mm L %.4g m zeta %.2g", beam->material.name,
              ends[beam->supports[0]], ends[beam->supports[1]],
              beam->kind == &rod_kind                  ? "rod"
              : beam->theory == THEORY_EULER_BERNOULLI ? "Euler beam"
                                                       : "beam",
              1e3 * beam->radius, beam->length, beam->damping);
}

/* A sphere of about the bar's thickness: as a rule one impact, or few. */
static void draw_single(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    double speed = scene_log(r, 0.01, 2.0);
    double radius = scene_log(r, 0.002, 0.02);
    bool rod = scene_pick(r, 2);
    struct spot at;
    const struct body *bar;
    if (rod) {
        struct body body =
            make_bar(&rod_kind, scene_material(r), radius, radius * scene_log(r, 5.0, 300.0));
        body.damping = draw_damping(r);
        body.lateral_inertia = scene_pick(r, 4) == 0;
        body.supports[0] = scene_pick(r, 3) ? SUPPORT_FREE : SUPPORT_CLAMPED;
        bar = lab_add(lab, "bar", body);
        at = end_spot("bar", bar->length);
    } else {
        bar = scene_beam(lab, r, "bar");
        at = side_spot("bar", scene_place(r, bar->length), bar->radius, 0.0);
    }
    double ball = bar->radius * scene_log(r, 0.2, 2.0);
    lab_add(lab, "ball", make_sphere(scene_material(r), ball));
    scene->request = strike(sphere_spot("ball", ball), at, speed);
    scene_say(scene, "sphere R %.4g mm, %.4g m/s, at %.4g m of a ", 1e3 * ball, speed, at.point[0]);
    say_beam(scene, bar);
}

static void draw_heavy(struct lab *lab, uint64_t *r, struct scene_drawn *scene)
{
    const struct body *beam = scene_beam(lab, r, "beam");
    struct material material = scene_material(r);
    double ratio = scene_log(r, 0.3, 30.0);
    double ball = cbrt(0.75 * ratio * beam->mass / (M_PI * material.density));
    double speed = scene_log(r, 0.03, 1.0);
    double x = scene_place(r, beam->length);
    lab_add(lab, "ball", make_sphere(material, ball));
    scene->request =
        strike(sphere_spot("ball", ball), side_spot("beam", x, beam->radius, 0.0), speed);
    scene_say(scene, "%s sphere R %.4g mm (%.3g of the beam's mass), %.4g m/s, at %.4g of a ",
              material.name, 1e3 * ball, ratio, speed, x / beam->length);
    say_beam(scene, beam);
}

/* Classes when their scenes were numbered first: those stay what they are. */
enum { SEEDS = 7 };

bool scene_draw(struct lab *lab, enum scene_class class, uint64_t number, struct scene_drawn *scene)
{
    /* xorshift needs some rounds to forget small seeds */
    uint64_t r = 0x9e3779b97f4a7c15u * (number * SEEDS + (uint64_t) class + 1);
    for (int i = 0; i < 16; i++)
        random_between(&r, 0.0, 1.0);
    lab->set.count = lab->set.friction_count = 0;
    memset(scene, 0, sizeof *scene);
    bool drawn = true;
    if (class == CLASS_SINGLE)
        draw_single(lab, &r, scene);
    else if (class == CLASS_HEAVY)
        draw_heavy(lab, &r, scene);
    else if (class == CLASS_GROUP)
        scene_draw_group(lab, &r, scene);
    else if (class == CLASS_ROW)
        scene_draw_row(lab, &r, scene);
    else if (class == CLASS_RINGING)
        drawn = scene_draw_ringing(lab, &r, scene);
    else if (class == CLASS_ECCENTRIC)
        scene_draw_eccentric(lab, &r, scene);
    else if (class == CLASS_CHAIN)
        scene_draw_chain(lab, &r, number, scene);
    else if (class == CLASS_OBLIQUE)
        scene_draw_oblique(lab, &r, scene);
    else if (class == CLASS_LOSSY)
        scene_draw_lossy(lab, &r, scene);
    else if (class == CLASS_LOSSY_GROUP)
        scene_draw_lossy_group(lab, &r, scene);
    else if (class == CLASS_RUBBED)
        scene_draw_rubbed(lab, &r, scene);
    else
        scene_draw_rolled(lab, &r, scene);
    if (class != CLASS_ROLLED)
        scene->plain = scene->request;
    return drawn;
}

void scene_take_state(const struct body_state *state, struct body_state **place)
{
    size_t size = state ? body_state_size(state) : 0;
    struct body_state *copy = state ? malloc(size) : NULL;
    assert_true(copy || !state);
    if (copy)
        memcpy(copy, state, size);
    free(*place);
    *place = copy;
}

void scene_release(struct scene_drawn *scene)
{
    for (size_t b = 0; b < COUNT(scene->states); b++) {
        free(scene->states[b]);
        scene->states[b] = NULL;
    }
}
