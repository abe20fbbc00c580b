/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "scene.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "column.h"
#include "others.h"
#include "percuss/similar.h"
#include "quantity.h"

enum scene_key {
    KEY_A = 'a',
    KEY_B = 'b',
    KEY_AT = OPTION_SCENE,
    KEY_TOLERANCE,
    KEY_HORIZON,
    KEY_CONTACT_MODEL,
    KEY_METHOD,
    KEY_COMPLIANCE,
    KEY_AT_A,
    KEY_AT_B,
    KEY_FRICTION,
    KEY_FRICTION_LAW,
    KEY_ANGLE,
    KEY_SPIN
};

static const struct argp_option scene_options[] = {
    {"a", KEY_A, "ID", 0, "the moving body", 10},
    {"b", KEY_B, "ID", 0, "the body at rest; percuss bodies lists them", 10},
    {"at", KEY_AT, "S", 0,
     "place of the impact along a beam: 0..1 (default 0.5), 25%, a length from its end at -x such "
     "as 250mm, middle, or of a beam that is held at one end tip or root",
     10},
    {"at-a", KEY_AT_A, "NAME", 0, "place of the impact on the moving body: a site's name", 10},
    {"at-b", KEY_AT_B, "NAME", 0, "the same on the body at rest (default: its first site)", 10},
    {"friction", KEY_FRICTION, "MU", 0,
     "coefficient of friction, 0 to 10 (default: the catalogue's for the two materials, none if it "
     "states none); 0: none",
     11},
    {"friction-law", KEY_FRICTION_LAW, "L", 0,
     "micro-slip (default), plain or none, where there is a coefficient", 11},
    {"angle", KEY_ANGLE, "DEG", 0,
     "of query, sweep, ensemble: angle of A's flight from the normal, degrees; --speed is along "
     "the flight: its part V sin DEG is along the first tangent of the surface, of a beam its axis "
     "(sweep: LO:HI:N, too)",
     11},
    {"spin", KEY_SPIN, "W", 0,
     "of query, sweep, ensemble: spin of A, rad/s, about the axis first tangent x normal: a "
     "positive one adds to the slip of A's surface along the tangent, one of -V sin DEG / radius "
     "lets a sphere roll",
     11},
    {"tolerance", KEY_TOLERANCE, "T", 0, "wanted accuracy of the restitution (default 1e-3)", 20},
    {"horizon", KEY_HORIZON, "T", 0,
     "s, or with a unit: give up watching the bodies after this time", 20},
    {"contact-model", KEY_CONTACT_MODEL, "M", 0,
     "auto, hertz, closed-form, table, concurrent-fe, complete-fe, viscoelastic or law", 20},
    {"method", KEY_METHOD, "M", 0, "modal or cvode", 20},
    {"compliance", KEY_COMPLIANCE, "C", 0, "default, half-space or matched", 20},
    {0},
};

/* The number that the name stands for. */
static unsigned parse_choice(const char *option, const char *text, unsigned count,
                             const char *(*name_of)(unsigned), struct argp_state *state)
{
    char allowed[256] = "";
    for (unsigned i = 0; i < count; i++) {
        if (!strcmp(text, name_of(i)))
            return i;
        size_t length = strlen(allowed);
        snprintf(allowed + length, sizeof allowed - length, "%s%s", i ? ", " : "", name_of(i));
    }
    argp_error(state, "--%s: '%s' is not one of: %s", option, text, allowed);
    return 0;
}

/* A place by its name. */
static bool read_place(const char *text, struct scene *scene)
{
    scene->at = 0.5;
    scene->at_length = NAN;
    scene->place = !strcmp(text, "tip")    ? PLACE_TIP
                   : !strcmp(text, "root") ? PLACE_ROOT
                                           : PLACE_NUMBER;
    return scene->place != PLACE_NUMBER || !strcmp(text, "middle");
}

/* A fraction of the length or so many per cent of it, or else a length. */
static bool read_place_number(const char *text, struct scene *scene)
{
    struct quantity_fault fault;
    size_t length = strlen(text);
    bool percent = length > 0 && text[length - 1] == '%';
    /* a number alone is no length */
    if (!quantity_read(text, percent ? length - 1 : length, QUANTITY_NUMBER, &scene->at, &fault))
        return quantity_read(text, length, QUANTITY_LENGTH, &scene->at_length, &fault) &&
               scene->at_length >= 0.0;
    if (percent)
        scene->at /= 100.0;
    return scene->at >= 0.0 && scene->at <= 1.0;
}

static void parse_site(const char *text, struct scene *scene, struct argp_state *state)
{
    scene->at_given = true;
    if (!read_place(text, scene) && !read_place_number(text, scene))
        argp_error(state,
                   "--at: '%s': a fraction of the length, 0..1, or a length from the end at -x, "
                   "such as 250mm, is needed, or 25%%, middle, tip, root",
                   text);
}

static void parse_b(char *text, struct scene *scene, struct argp_state *state)
{
    if (scene->b_count == SCENE_CHOICES)
        argp_error(state, "--b: up to %d bodies are allowed", SCENE_CHOICES);
    scene->b = scene->all_b[scene->b_count++] = text;
}

static void parse_contact_model(const char *text, struct scene *scene, struct argp_state *state)
{
    if (scene->model_count == SCENE_CHOICES)
        argp_error(state, "--contact-model: up to %d are allowed", SCENE_CHOICES);
    unsigned model = parse_choice("contact-model", text, PERCUSS_CONTACT_COUNT,
                                  percuss_contact_model_name, state);
    scene->options.contact_model = scene->models[scene->model_count++] = model;
}

void scene_check_given(const struct scene *scene, const struct scene_need *others, size_t count,
                       const char *instead, struct argp_state *state)
{
    char missing[256] = "";
    const struct scene_need bodies[] = {{"--a ID", scene->a}, {"--b ID", scene->b}};
    for (size_t i = 0; i < 2 + count; i++) {
        const struct scene_need *need = i < 2 ? &bodies[i] : &others[i - 2];
        size_t length = strlen(missing);
        if (!need->given)
            snprintf(missing + length, sizeof missing - length, "%s%s", length ? ", " : "",
                     need->what);
    }
    if (*missing)
        argp_error(state, "missing: %s%s", missing, instead);
}

void scene_check_body(const struct scene *scene, const char *option, const char *id,
                      struct argp_state *state)
{
    struct similar similar = similar_to(id);
    similar_offer(&similar, scene->a);
    similar_offer(&similar, scene->b);
    if (!strcmp(id, scene->a) || !strcmp(id, scene->b))
        return;
    argp_error(state, "--%s: '%s' is neither --a nor --b%s%s%s", option, id,
               similar.nearest ? ": did you mean '" : "", similar.nearest ? similar.nearest : "",
               similar.nearest ? "'?" : "");
}

void scene_check_one_b(const struct scene *scene, struct argp_state *state)
{
    if (scene->b_count > 1)
        argp_error(state, "--b: one body is needed, not %zu", scene->b_count);
}

void scene_check_single(const struct scene *scene, struct argp_state *state)
{
    scene_check_one_b(scene, state);
    if (scene->model_count > 1)
        argp_error(state, "--contact-model: one is needed, not %zu", scene->model_count);
}

/* A number that may bear the unit in which it is counted anyway. */
static bool read_counted(const char *text, size_t length, const char *unit, double *number,
                         struct quantity_fault *fault)
{
    size_t tail = strlen(unit);
    if (length > tail && !strncmp(text + length - tail, unit, tail))
        length -= tail;
    while (length > 0 && text[length - 1] == ' ')
        length--;
    return quantity_read(text, length, QUANTITY_NUMBER, number, fault);
}

/* At more than a right angle A flies away. */
static const double LEAST_ANGLE = -90.0, MOST_ANGLE = 90.0;
enum { MOST_ANGLES = 1000000 };

/* LO:HI:N, of which only a sweep makes something. */
static bool read_angles(const char *text, struct scene *scene, struct quantity_fault *fault)
{
    const char *high = strchr(text, ':'), *count = high ? strchr(high + 1, ':') : NULL;
    if (!count || strspn(count + 1, "0123456789") != strlen(count + 1) || strlen(count + 1) > 7)
        return false;
    scene->angle_list = true;
    scene->angle_count = (unsigned)strtoul(count + 1, NULL, 10);
    return scene->angle_count >= 1 && scene->angle_count <= MOST_ANGLES &&
           read_counted(text, (size_t)(high - text), "deg", &scene->angle, fault) &&
           read_counted(high + 1, (size_t)(count - high - 1), "deg", &scene->last_angle, fault) &&
           scene->angle <= scene->last_angle;
}

/* Ends the process where impacts that were measured are compared. */
static void check_askew(const char *option, const char *text, const struct scene *scene,
                        struct argp_state *state)
{
    if (scene->angles == ANGLES_NONE)
        argp_error(state, "--%s: '%s': only straight impacts are compared with measured ones",
                   option, text);
}

static void parse_angle(const char *text, struct scene *scene, struct argp_state *state)
{
    struct quantity_fault fault;
    bool swept = scene->angles == ANGLES_SWEPT;
    bool several = swept && strchr(text, ':');
    bool good = several ? read_angles(text, scene, &fault)
                        : read_counted(text, strlen(text), "deg", &scene->angle, &fault);
    check_askew("angle", text, scene, state);
    if (!several) {
        scene->last_angle = scene->angle;
        scene->angle_count = 1;
        scene->angle_list = false;
    }
    if (!good || !(scene->angle > LEAST_ANGLE && scene->last_angle < MOST_ANGLE))
        argp_error(state,
                   "--angle: '%s': degrees from the normal, more than %g and less than %g, are "
                   "needed%s",
                   text, LEAST_ANGLE, MOST_ANGLE, swept ? ", or LO:HI:N, for example 0:80:9" : "");
}

static void parse_spin(const char *text, struct scene *scene, struct argp_state *state)
{
    struct quantity_fault fault;
    check_askew("spin", text, scene, state);
    if (!read_counted(text, strlen(text), "rad/s", &scene->spin, &fault))
        argp_error(state, "--spin: '%s': a number of rad/s is needed", text);
}

static void parse_friction(const char *text, struct scene *scene, struct argp_state *state)
{
    struct quantity_fault fault;
    const double most = 10.0;
    if (!quantity_read(text, strlen(text), QUANTITY_NUMBER, &scene->friction, &fault) ||
        !(scene->friction >= 0.0 && scene->friction <= most))
        argp_error(state, "--friction: '%s': a coefficient of 0 to %g is needed", text, most);
}

/* Options of friction and of impacts that are not straight. */
static error_t parse_askew(int key, char *text, struct argp_state *state)
{
    struct scene *scene = state->input;
    switch (key) {
    case KEY_FRICTION:
        parse_friction(text, scene, state);
        break;
    case KEY_FRICTION_LAW:
        scene->options.friction = parse_choice("friction-law", text, PERCUSS_FRICTION_COUNT,
                                               percuss_friction_name, state);
        break;
    case KEY_ANGLE:
        parse_angle(text, scene, state);
        break;
    case KEY_SPIN:
        parse_spin(text, scene, state);
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    scene->given = scene->askew = true;
    return 0;
}

static error_t parse_scene(int key, char *text, struct argp_state *state)
{
    struct scene *scene = state->input;
    struct percuss_options *options = &scene->options;
    switch (key) {
    /* the bodies, and where they touch */
    case KEY_A:
        scene->a = text;
        break;
    case KEY_B:
        parse_b(text, scene, state);
        break;
    case KEY_AT:
        parse_site(text, scene, state);
        break;
    case KEY_AT_A:
        scene->at_a = text;
        break;
    case KEY_AT_B:
        scene->at_b = text;
        break;
    /* how it is solved */
    case KEY_TOLERANCE:
        options->tolerance = parse_positive_quantity("tolerance", text, QUANTITY_NUMBER, state);
        break;
    case KEY_HORIZON:
        options->horizon = parse_positive_quantity("horizon", text, QUANTITY_TIME, state);
        break;
    case KEY_CONTACT_MODEL:
        parse_contact_model(text, scene, state);
        break;
    case KEY_METHOD:
        options->method =
            parse_choice("method", text, PERCUSS_METHOD_COUNT, percuss_method_name, state);
        break;
    case KEY_COMPLIANCE:
        options->compliance = parse_choice("compliance", text, PERCUSS_COMPLIANCE_COUNT,
                                           percuss_compliance_name, state);
        break;
    /* all are read: without a coefficient there is no law */
    case ARGP_KEY_END:
        if (scene->friction == 0.0)
            options->friction = PERCUSS_FRICTION_NONE;
        return 0;
    default:
        return parse_askew(key, text, state);
    }
    scene->given = true;
    return 0;
}

const struct argp scene_argp = {.options = scene_options, .parser = parse_scene};

struct scene scene_default(void)
{
    return (struct scene){
        .at = 0.5, .at_length = NAN, .friction = NAN, .options = percuss_options_default()};
}

struct scene scene_straight(void)
{
    struct scene scene = scene_default();
    scene.angles = ANGLES_NONE;
    return scene;
}

/* The body of that id, or the stranger made to look like a point. */
static const struct percuss_body *find_or_invent(const struct percuss_body_list *list,
                                                 const char *id, struct percuss_body *stranger)
{
    const struct percuss_body *body = percuss_body_find(list, id);
    if (body)
        return body;
    *stranger = (struct percuss_body){.shape = "sphere"};
    snprintf(stranger->id, sizeof stranger->id, "%s", id);
    return stranger;
}

/* From a length along a beam to the fraction of it. */
static int place_length(const struct scene *scene, const struct percuss_body *beam, double *at)
{
    double whole = 2.0 * beam->half_extents[0];
    if (strcmp(beam->shape, "beam") != 0 || scene->at_length <= whole) {
        *at = whole > 0.0 ? fmin(1.0, scene->at_length / whole) : *at;
        return EXIT_ANSWERED;
    }
    complain("--at: %g m from its end is beyond %s, which is %g m long", scene->at_length, beam->id,
             whole);
    return EXIT_USAGE;
}

static const char *support_name(enum percuss_support support)
{
    static const char *const names[] = {"free", "pinned", "clamped"};
    return (unsigned)support < sizeof names / sizeof *names ? names[support] : "?";
}

/* The free end of a beam that is held at the other one, or that other end. */
static int place_end(enum scene_place place, const struct percuss_body *beam, double *at)
{
    bool free_at[2] = {beam->supports[0] == PERCUSS_SUPPORT_FREE,
                       beam->supports[1] == PERCUSS_SUPPORT_FREE};
    if (strcmp(beam->shape, "beam") != 0)
        return EXIT_ANSWERED;
    if (free_at[0] == free_at[1]) {
        complain("--at: %s: the ends of %s are %s and %s, so that it has no tip and no root: --at "
                 "0 is its end at -x, --at 1 the one at +x",
                 place == PLACE_TIP ? "tip" : "root", beam->id, support_name(beam->supports[0]),
                 support_name(beam->supports[1]));
        return EXIT_USAGE;
    }
    *at = free_at[1] == (place == PLACE_TIP) ? 1.0 : 0.0;
    return EXIT_ANSWERED;
}

/* As the flags say how A meets B. */
static void lean_pair(const struct scene *scene, struct percuss_pair *pair)
{
    pair->angle = scene->angle * (M_PI / 180.0);
    pair->spin = scene->spin;
    pair->friction = scene->friction > 0.0 ? scene->friction : 0.0;
}

double scene_normal_share(const struct scene *scene)
{
    return cos(scene->angle * (M_PI / 180.0));
}

int scene_find_bodies(const struct scene *scene, const struct common *common,
                      struct percuss_client *client, struct scene_bodies *bodies)
{
    *bodies = (struct scene_bodies){0};
    enum percuss_result result = percuss_bodies(client, common_timeout(common), &bodies->list);
    if (result != PERCUSS_RESULT_OK)
        return complain_result(result);
    bodies->pair =
        percuss_pair_default(find_or_invent(&bodies->list, scene->a, &bodies->strangers[0]),
                             find_or_invent(&bodies->list, scene->b, &bodies->strangers[1]));
    bodies->pair.site_a = scene->at_a;
    bodies->pair.site_b = scene->at_b;
    lean_pair(scene, &bodies->pair);
    /* of two beams the one at rest is hit at S */
    bool b_is_beam = !strcmp(bodies->pair.b->shape, "beam");
    if (scene->at_given && !b_is_beam && strcmp(bodies->pair.a->shape, "beam") != 0)
        complain("--at has no effect: neither body is a beam");
    double *at = b_is_beam ? &bodies->pair.at_b : &bodies->pair.at_a;
    *at = scene->at;
    const struct percuss_body *beam = b_is_beam ? bodies->pair.b : bodies->pair.a;
    if (scene->place != PLACE_NUMBER)
        return place_end(scene->place, beam, at);
    return isnan(scene->at_length) ? EXIT_ANSWERED : place_length(scene, beam, at);
}

/* A text that grows as far as it has room. */
static void add(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static void add(char *text, size_t size, const char *format, ...)
{
    size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, size - length, format, arguments);
    va_end(arguments);
}

#define ADD(array, ...) add(array, sizeof array, __VA_ARGS__)

/* Where A (0) or B (1) is hit; nothing where its shape leaves no choice. */
static void describe_place(const struct scene *scene, const struct percuss_pair *pair, int which,
                           char *text, size_t size)
{
    const struct percuss_body *body = which == 0 ? pair->a : pair->b;
    const char *site = which == 0 ? pair->site_a : pair->site_b;
    const double at = which == 0 ? pair->at_a : pair->at_b;
    /* of two beams --at places the one at rest */
    const bool placed = which == 1 || strcmp(pair->b->shape, "beam") != 0;
    /* by the name of a site */
    if (!strcmp(body->shape, "mesh") && (site || body->site_count > 0)) {
        add(text, size, "at the site %s of %s", site ? site : body->sites[0].name, body->id);
        if (!site && body->site_count > 1)
            add(text, size, " (default; --at-%c NAME)", 'a' + which);
    }
    /* the only place of a pair, as percuss_contact_pair chooses it */
    if (!strcmp(body->shape, "rod"))
        add(text, size, "on the end of %s at %cx", body->id,
            body->supports[1] == PERCUSS_SUPPORT_FREE ? '+' : '-');
    else if (!strcmp(body->shape, "cylinder"))
        add(text, size, "in the middle of the end of %s at +x", body->id);
    else if (!strcmp(body->shape, "block"))
        add(text, size, "in the middle of the face of %s at +z", body->id);
    /* along a beam */
    if (strcmp(body->shape, "beam") != 0)
        return;
    if (at == 0.0 || at == 1.0)
        add(text, size, "at the %s end of %s at %cx", support_name(body->supports[at > 0.5]),
            body->id, at > 0.5 ? '+' : '-');
    else if (at == 0.5)
        add(text, size, "in the middle of %s", body->id);
    else
        add(text, size, "at %.4g %% of the length of %s", 100.0 * at, body->id);
    if (placed && !scene->at_given)
        add(text, size, " (default; --at S)");
}

/* "steel-sphere of steel", and its ends if it has any. */
static void describe_body(const struct percuss_body *body, char *text, size_t size)
{
    add(text, size, "%s", body->id);
    /* percuss-reduce was given numbers without a name */
    if (body->material[0] && strcmp(body->material, "given") != 0)
        add(text, size, " of %s", body->material);
    bool held =
        body->supports[0] != PERCUSS_SUPPORT_FREE || body->supports[1] != PERCUSS_SUPPORT_FREE;
    if (held || !strcmp(body->shape, "beam") || !strcmp(body->shape, "rod"))
        add(text, size, ", ends %s and %s", support_name(body->supports[0]),
            support_name(body->supports[1]));
}

struct scene_text scene_describe(const struct scene *scene, const struct scene_bodies *bodies)
{
    struct scene_text text = {0};
    const struct percuss_pair *pair = &bodies->pair;
    if (!pair->a || !pair->b) {
        ADD(text.title, "%s on %s", scene->a, scene->b);
        return text;
    }
    /* the bodies */
    describe_body(pair->a, text.bodies, sizeof text.bodies);
    ADD(text.bodies, "; ");
    describe_body(pair->b, text.bodies, sizeof text.bodies);
    /* B's place before A's */
    char of_a[200] = "";
    describe_place(scene, pair, 1, text.place, sizeof text.place);
    describe_place(scene, pair, 0, of_a, sizeof of_a);
    if (*of_a)
        ADD(text.place, "%s%s", text.place[0] ? ", " : "", of_a);
    /* all in one line, without the options in brackets */
    describe_body(pair->a, text.title, sizeof text.title);
    ADD(text.title, " on ");
    describe_body(pair->b, text.title, sizeof text.title);
    const int length = (int)strcspn(text.place, "(");
    if (length > 0)
        ADD(text.title, ", %.*s", text.place[length] ? length - 1 : length, text.place);
    if (scene->angle_count == 1 && scene->angle != 0.0)
        ADD(text.title, ", at %g degrees", scene->angle);
    return text;
}

int scene_request(const struct scene *scene, const struct scene_bodies *bodies, double speed,
                  struct percuss_request *request)
{
    struct percuss_pair pair = bodies->pair;
    pair.speed = speed;
    lean_pair(scene, &pair);
    enum percuss_result result = percuss_contact_pair(&pair, request);
    request->options = scene->options;
    return result == PERCUSS_RESULT_OK ? EXIT_ANSWERED : complain_result(result);
}

void scene_doubt_speed(double speed)
{
    const struct column_kind *kind = &IMPACT_KINDS[IMPACT_SPEED];
    if (speed > kind->usual)
        complain("warning: --speed: %g m/s: above %g m/s: %s", speed, kind->usual, kind->question);
}

void scene_explain_unknown(const struct common *common, struct percuss_client *client,
                           const struct percuss_request *request,
                           const struct percuss_body_list *list)
{
    for (size_t i = 0; i < request->body_count; i++) {
        const char *id = request->bodies[i].id;
        if (percuss_body_find(list, id))
            continue;
        struct similar similar = similar_to(id);
        for (size_t j = 0; j < list->count; j++)
            similar_offer(&similar, list->bodies[j].id);
        if (similar.nearest)
            complain("'%s': did you mean '%s'?", id, similar.nearest);
        fprintf(stderr, "percuss: the server knows:");
        for (size_t j = 0; j < list->count; j++)
            fprintf(stderr, " %s", list->bodies[j].id);
        fputc('\n', stderr);
        others_explain(common, client);
        return;
    }
}
