/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "others.h"
#include "quantity.h"
#include "similar.h"

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
    KEY_AT_B
};

static const struct argp_option scene_options[] = {
    {"a", KEY_A, "ID", 0, "the moving body", 10},
    {"b", KEY_B, "ID", 0, "the body at rest; percuss bodies lists them", 10},
    {"at", KEY_AT, "S", 0,
     "place of the impact along a beam, 0..1 (default 0.5), or from its end at -x, such as 250mm",
     10},
    {"at-a", KEY_AT_A, "NAME", 0, "place of the impact on the moving body: a site's name", 10},
    {"at-b", KEY_AT_B, "NAME", 0, "the same on the body at rest (default: its first site)", 10},
    {"tolerance", KEY_TOLERANCE, "T", 0, "wanted accuracy of the restitution (default 1e-3)", 20},
    {"horizon", KEY_HORIZON, "T", 0,
     "s, or with a unit: give up watching the bodies after this time", 20},
    {"contact-model", KEY_CONTACT_MODEL, "M", 0,
     "auto, hertz, closed-form, table, concurrent-fe or complete-fe", 20},
    {"method", KEY_METHOD, "M", 0, "modal or cvode", 20},
    {"compliance", KEY_COMPLIANCE, "C", 0, "default, half-space or matched", 20},
    {0},
};

/* The number whose name was given. */
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

static void parse_site(const char *text, struct scene *scene, struct argp_state *state)
{
    struct quantity_fault fault;
    size_t length = strlen(text);
    /* a number alone is no length */
    bool good = quantity_read(text, length, QUANTITY_NUMBER, &scene->at, &fault);
    if (good) {
        good = scene->at >= 0.0 && scene->at <= 1.0;
        scene->at_length = NAN;
    } else {
        good = quantity_read(text, length, QUANTITY_LENGTH, &scene->at_length, &fault) &&
               scene->at_length >= 0.0;
    }
    scene->at_given = true;
    if (!good)
        argp_error(state,
                   "--at: '%s': a fraction of the length, 0..1, or a length from the end at -x, "
                   "such as 250mm, is needed",
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
    default:
        return ARGP_ERR_UNKNOWN;
    }
    scene->given = true;
    return 0;
}

const struct argp scene_argp = {.options = scene_options, .parser = parse_scene};

struct scene scene_default(void)
{
    return (struct scene){.at = 0.5, .at_length = NAN, .options = percuss_options_default()};
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
    /* of two beams the one at rest is hit at S */
    bool b_is_beam = !strcmp(bodies->pair.b->shape, "beam");
    if (scene->at_given && !b_is_beam && strcmp(bodies->pair.a->shape, "beam") != 0)
        complain("--at has no effect: neither body is a beam");
    double *at = b_is_beam ? &bodies->pair.at_b : &bodies->pair.at_a;
    *at = scene->at;
    return isnan(scene->at_length)
               ? EXIT_ANSWERED
               : place_length(scene, b_is_beam ? bodies->pair.b : bodies->pair.a, at);
}

int scene_request(const struct scene *scene, const struct scene_bodies *bodies, double speed,
                  struct percuss_request *request)
{
    struct percuss_pair pair = bodies->pair;
    pair.speed = speed;
    enum percuss_result result = percuss_contact_pair(&pair, request);
    request->options = scene->options;
    return result == PERCUSS_RESULT_OK ? EXIT_ANSWERED : complain_result(result);
}

void scene_explain_unknown(const struct common *common, struct percuss_client *client,
                           const struct percuss_request *request,
                           const struct percuss_body_list *list)
{
    for (size_t i = 0; i < request->body_count; i++) {
        const char *id = request->bodies[i].id;
        if (percuss_body_find(list, id))
            continue;
        const struct percuss_body *nearest = similar_body(list, id);
        if (nearest)
            complain("'%s': did you mean '%s'?", id, nearest->id);
        fprintf(stderr, "percuss: the server knows:");
        for (size_t j = 0; j < list->count; j++)
            fprintf(stderr, " %s", list->bodies[j].id);
        fputc('\n', stderr);
        others_explain(common, client);
        return;
    }
}
