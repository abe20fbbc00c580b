/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "model/body.h"

#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "model/body_kind.h"
#include "model/key.h"
#include "model/ritz.h"
#include "model/ritz_store.h"

static enum percuss_status key_refuse_number(const struct key *key, unsigned number,
                                             struct fault *fault)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %u: must be %s", key->name, number,
                     key_allowed(key).text);
}

static enum percuss_status check_sizes(const struct key *key, const double sizes[3],
                                       struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    for (int i = 0; !status && i < 3; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s[%d]", key->name, i);
        status = limit_check(key->limit, name, sizes[i], fault);
    }
    return status;
}

/* Checks the value of one field; words are checked as numbers because a program may set them. */
static enum percuss_status check_key(const struct key *key, const void *field, struct fault *fault)
{
    const double *number = field;
    const unsigned *choice = field;
    /* numbers by their limits; an optional one may be absent */
    switch (key->type) {
    case KEY_NUMBER:
    case KEY_DAMPING:
        if (!key->required && *number == key->absent)
            return PERCUSS_OK;
        return limit_check(key->limit, key->name, *number, fault);
    case KEY_NUMBERS:
        return check_sizes(key, number, fault);
    case KEY_WHOLE:
        return *choice <= key->limit->high ? PERCUSS_OK : key_refuse_number(key, *choice, fault);
    /* words by their index */
    case KEY_WORD:
    case KEY_ENDS:
        for (int i = 0; i < (key->type == KEY_ENDS ? 2 : 1); i++)
            if (choice[i] >= key->word_count || !key->words[choice[i]])
                return key_refuse_number(key, choice[i], fault);
        return PERCUSS_OK;
    case KEY_SHEAR:
        return *choice <= SHEAR_NUMBER ? PERCUSS_OK : key_refuse_number(key, *choice, fault);
    default:
        return PERCUSS_OK;
    }
}

static enum percuss_status check_material(const struct body *body, struct fault *fault)
{
    struct fault inner = {0};
    enum percuss_status status = material_check(&body->material, &inner);
    return status ? fault_set(fault, status, "material.%s", inner.text) : PERCUSS_OK;
}

/* Checks all that a catalogue states of a body, its material included. */
static enum percuss_status body_check(const struct body *body, struct fault *fault)
{
    const struct body_kind *kind = body->kind;
    bool ends = false;
    enum percuss_status status = check_material(body, fault);
    for (size_t i = 0; !status && i < kind->key_count; i++) {
        const struct key *key = &kind->keys[i];
        ends = ends || key->type == KEY_ENDS;
        status = check_key(key, (const char *)body + key->offset, fault);
    }
    if (!status && !ends && (body->supports[0] || body->supports[1]))
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "ends: %u: must be free for a %s",
                           body->supports[0] ? body->supports[0] : body->supports[1], kind->name);
    return !status && kind->check ? kind->check(body, fault) : status;
}

enum percuss_status body_complete(struct body *body, struct fault *fault)
{
    enum percuss_status status = body_check(body, fault);
    if (status)
        return status;
    body->area = 0.0;
    memset(body->products, 0, sizeof body->products);
    for (int plane = 0; plane < 2; plane++) {
        body->second_moment[plane] = 0.0;
        body->shear_factor[plane] = NAN;
    }
    return body->kind->complete(body, fault);
}

bool body_can_vibrate(const struct body *body)
{
    return body->kind->family_count > 0 && !body->rigid;
}

bool body_is_flexible(const struct body *body)
{
    return body_can_vibrate(body) && (!body->kind->box || body->ritz);
}

bool body_is_solid(const struct body *body)
{
    return (body->mesh || body->ritz) && body_is_flexible(body);
}

bool body_bends(const struct body *body)
{
    bool bends = false;
    for (size_t f = 0; f < body->kind->family_count; f++)
        bends = bends || body->kind->families[f]->bends;
    return bends;
}

double body_smallest_radius(const struct body *body)
{
    return body->kind->smallest_radius(body);
}

struct solid body_solid(const struct body *body)
{
    return body->kind->solid ? body->kind->solid(body) : (struct solid){.form = SOLID_NONE};
}

bool body_has_sphere(const struct body *body)
{
    struct solid solid = body_solid(body);
    return solid.form == SOLID_BALL || (solid.form == SOLID_CYLINDER && isfinite(solid.tip_radius));
}

const char *body_theory(const struct body *body)
{
    return body->kind->theory && body_is_flexible(body) ? body->kind->theory(body) : "rigid";
}

const struct body *body_set_find(const struct body_set *set, const char *id)
{
    for (size_t i = 0; i < set->count; i++)
        if (strcmp(set->bodies[i].id, id) == 0)
            return &set->bodies[i];
    return NULL;
}

const struct body_order *body_set_order(const struct body_set *set, const char *id)
{
    for (size_t i = 0; i < set->order_count; i++)
        if (strcmp(set->orders[i].id, id) == 0)
            return &set->orders[i];
    return NULL;
}

int friction_pair_order(const void *a, const void *b)
{
    const struct friction_pair *x = a, *y = b;
    int order = strcmp(x->between[0], y->between[0]);
    return order ? order : strcmp(x->between[1], y->between[1]);
}

const struct friction_pair *body_set_friction(const struct body_set *set, const struct material *a,
                                              const struct material *b)
{
    struct friction_pair wanted;
    bool swapped = strcmp(a->name, b->name) > 0;
    if (set->friction_count == 0)
        return NULL;
    memcpy(wanted.between[0], swapped ? b->name : a->name, PERCUSS_ID_SIZE);
    memcpy(wanted.between[1], swapped ? a->name : b->name, PERCUSS_ID_SIZE);
    return bsearch(&wanted, set->friction, set->friction_count, sizeof wanted, friction_pair_order);
}

const struct own_law *body_set_law(const struct body_set *set, const struct material *a,
                                   const struct material *b)
{
    for (size_t i = 0; i < set->law_count; i++)
        for (int swapped = 0; swapped < 2; swapped++)
            if (strcmp(set->laws[i].between[swapped], a->name) == 0 &&
                strcmp(set->laws[i].between[!swapped], b->name) == 0)
                return &set->laws[i];
    return NULL;
}

struct material body_material_at(const struct body *body, const struct site *site)
{
    return body->kind->material_at ? body->kind->material_at(body, site) : body->material;
}

const struct body_site *body_find_site(const struct body *body, const char *name)
{
    for (size_t i = 0; i < body->site_count; i++)
        if (strcmp(body->sites[i].name, name) == 0)
            return &body->sites[i];
    return NULL;
}

void body_site_point(const struct body *body, const struct body_site *site, double point[3])
{
    for (int k = 0; k < 3; k++)
        point[k] = body->scale * (site->point[k] * body->mesh->unit - body->mesh->centre[k]);
}

void body_set_clear(struct body_set *set)
{
    for (size_t i = 0; i < set->count; i++) {
        free(set->bodies[i].sites);
        free(set->bodies[i].damping_shares);
    }
    for (size_t i = 0; i < set->mesh_count; i++)
        mesh_body_free(set->meshes[i]);
    for (size_t i = 0; i < set->order_count; i++)
        body_order_clear(&set->orders[i]);
    for (size_t i = 0; i < set->law_count; i++)
        own_law_clear(&set->laws[i]);
    ritz_store_free(set->boxes);
    free(set->laws);
    free(set->friction);
    free(set->orders);
    free(set->meshes);
    free(set->bodies);
    *set = (struct body_set){0};
}

void body_set_free(struct body_set *set)
{
    if (set)
        body_set_clear(set);
    free(set);
}

/* Bodies that differ from the catalogue's in some parameters. */

/* The member of a parameter; NULL: a body of this shape has no such parameter. */
static double *find_parameter(struct body *body, unsigned parameter)
{
    /* of the material: every body has them */
    switch (parameter) {
    case PERCUSS_PARAMETER_YOUNG:
        return &body->material.young;
    case PERCUSS_PARAMETER_POISSON:
        return &body->material.poisson;
    case PERCUSS_PARAMETER_DENSITY:
        return &body->material.density;
    case PERCUSS_PARAMETER_YIELD:
        return &body->material.yield;
    case PERCUSS_PARAMETER_TANGENT:
        return &body->material.tangent;
    /* of the body: only some kinds */
    case PERCUSS_PARAMETER_DAMPING:
        return body_can_vibrate(body) ? &body->damping : NULL;
    case PERCUSS_PARAMETER_RADIUS:
        return body->radius > 0.0 ? &body->radius : NULL;
    case PERCUSS_PARAMETER_SCALE:
        return body->mesh ? &body->scale : NULL;
    default:
        return NULL;
    }
}

double body_parameter(const struct body *body, enum percuss_parameter parameter)
{
    struct body copy = *body;
    const double *value = find_parameter(&copy, parameter);
    return value ? *value : NAN;
}

enum percuss_status body_vary(const struct body *body, const struct body_variation *variations,
                              size_t count, struct body *varied, struct fault *fault)
{
    bool given[PERCUSS_PARAMETER_COUNT] = {false};
    *varied = *body;
    for (size_t i = 0; i < count; i++) {
        const struct body_variation *variation = &variations[i];
        const char *name = parameter_name(variation->parameter);
        double *parameter = find_parameter(varied, variation->parameter);
        if (!parameter)
            return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %g: a %s has no such parameter", name,
                             variation->value, body->kind->name);
        if (given[variation->parameter])
            return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %g: must be given once only", name,
                             variation->value);
        given[variation->parameter] = true;
        *parameter = variation->value;
    }
    varied->varied = count > 0;
    return body_complete(varied, fault);
}

bool body_same_modes(const struct body *a, const struct body *b)
{
    return strcmp(a->id, b->id) == 0 && a->material.young == b->material.young &&
           a->material.poisson == b->material.poisson &&
           a->material.density == b->material.density && a->radius == b->radius &&
           a->damping == b->damping && a->scale == b->scale && a->supports[0] == b->supports[0] &&
           a->supports[1] == b->supports[1];
}

/* Orders. */

struct body_board {
    atomic_flag taken; /* held while a thread copies the news */
    struct body_news news;
    size_t wanted_count;
    double wanted[BODY_ORDER_PLACES][3];
};

static void board_take(struct body_board *board)
{
    while (atomic_flag_test_and_set_explicit(&board->taken, memory_order_acquire))
        ;
}

static void board_give_back(struct body_board *board)
{
    atomic_flag_clear_explicit(&board->taken, memory_order_release);
}

bool body_order_begin(struct body_order *order)
{
    order->board = calloc(1, sizeof *order->board);
    if (!order->board)
        return false;
    atomic_flag_clear(&order->board->taken);
    body_order_tell(order, PERCUSS_BUSY, "its mesh waits to be reduced: ask again later");
    return true;
}

void body_order_tell(const struct body_order *order, enum percuss_status status, const char *format,
                     ...)
{
    struct body_news news = {.status = status};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(news.text, sizeof news.text, format, arguments);
    va_end(arguments);
    board_take(order->board);
    order->board->news = news;
    board_give_back(order->board);
}

struct body_news body_order_news(const struct body_order *order)
{
    board_take(order->board);
    struct body_news news = order->board->news;
    board_give_back(order->board);
    return news;
}

void body_order_want(const struct body_order *order, const double place[3])
{
    struct body_board *board = order->board;
    board_take(board);
    size_t i = 0;
    while (i < board->wanted_count && memcmp(board->wanted[i], place, sizeof board->wanted[i]) != 0)
        i++;
    if (i == board->wanted_count && i < BODY_ORDER_PLACES)
        memcpy(board->wanted[board->wanted_count++], place, sizeof board->wanted[i]);
    board_give_back(board);
}

size_t body_order_take(const struct body_order *order, double places[BODY_ORDER_PLACES][3])
{
    struct body_board *board = order->board;
    board_take(board);
    size_t count = board->wanted_count;
    memcpy(places, board->wanted, sizeof board->wanted);
    board->wanted_count = 0;
    board_give_back(board);
    return count;
}

void body_order_clear(struct body_order *order)
{
    for (size_t i = 0; i < order->argument_count; i++)
        free(order->arguments[i]);
    free(order->mesh);
    free(order->board);
    *order = (struct body_order){.argument_count = 0};
}
