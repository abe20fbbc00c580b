/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A generated scene (tests/bench/any_scene.h) by its number, then changes of any of its numbers, as
 * a request that the endpoint decodes. What is answered keeps the invariants of
 * physics/estimates/invariants.h with numbers that are numbers, and whoever stops it is obeyed. Now
 * and then it is asked anew, of a solver that has kept nothing: the same to the bit. */
#include "solve/solve.h"

#include <math.h>

#include "bench/any_scene.h"
#include "exchange/decode.h"
#include "fuzz.h"
#include "physics/estimates/invariants.h"

/* About a millisecond of work each, in an ordinary build. */
enum { MOST_ASKED = 150, MOST_NUMBERS = 32, MOST_CHANGES = 12 };

/* A request on the wire that can be changed. */
struct scene {
    percuss_v1_BodyMotion bodies[PERCUSS_MAX_BODIES];
    percuss_v1_Override overrides[PERCUSS_MAX_BODIES][PERCUSS_PARAMETER_COUNT];
    percuss_v1_Contact contacts[PERCUSS_MAX_CONTACTS];
    double delassus[PERCUSS_MAX_CONTACTS * PERCUSS_MAX_CONTACTS];
    percuss_v1_Request wire;
};

/* ---- from a request to the wire ---- */

#define PUT(kind, name, ...) PUT_##kind(name)
#define PUT_NUMBER(name)     PERCUSS_COPY_NUMBER(name)
#define PUT_DEFAULTED(name)  PERCUSS_COPY_NUMBER(name)
#define PUT_VECTOR(name)     PERCUSS_COPY_ARRAY(name)
#define PUT_UNIT(name)       PERCUSS_COPY_ARRAY(name)
#define PUT_ID(name)         PERCUSS_COPY_ARRAY(name)
#define PUT_TEXT(name)
#define PUT_INDEX(name)  PERCUSS_COPY_NUMBER(name)
#define PUT_CHOICE(name) PERCUSS_COPY_NUMBER(name)
#define PUT_FLAG(name)   PERCUSS_COPY_NUMBER(name)

static void put_body(const struct solve_body *from, percuss_v1_BodyMotion *to)
{
    PERCUSS_BODY_FIELDS(PUT, PERCUSS_NONE)
}

static void put_contact(const struct solve_contact *from, percuss_v1_Contact *to)
{
    PERCUSS_CONTACT_FIELDS(PUT)
}

static void put_options(const struct solve_options *from, percuss_v1_Options *to)
{
    PERCUSS_OPTION_FIELDS(PUT)
}

static void put_scene(const struct solve_request *request, struct scene *scene)
{
    memset(scene, 0, sizeof *scene);
    percuss_v1_Request *wire = &scene->wire;
    wire->bodies._buffer = scene->bodies;
    wire->bodies._length = (uint32_t)request->body_count;
    wire->contacts._buffer = scene->contacts;
    wire->contacts._length = (uint32_t)request->contact_count;
    wire->delassus._buffer = scene->delassus;
    for (size_t i = 0; i < request->body_count; i++) {
        put_body(&request->bodies[i], &scene->bodies[i]);
        scene->bodies[i].overrides._buffer = scene->overrides[i];
    }
    for (size_t i = 0; i < request->contact_count; i++)
        put_contact(&request->contacts[i], &scene->contacts[i]);
    put_options(&request->options, &wire->options);
}

/* ---- changes ---- */

/* The places of all numbers of a struct. */
struct places {
    size_t count;
    double *at[MOST_NUMBERS];
};

static void add_places(struct places *places, double *first, size_t count)
{
    for (size_t i = 0; i < count && places->count < MOST_NUMBERS; i++)
        places->at[places->count++] = first + i;
}

#define PLACE(kind, name, ...) PLACE_##kind(name)
#define PLACE_NUMBER(name)     add_places(&places, &to->name, 1);
#define PLACE_DEFAULTED(name)  PLACE_NUMBER(name)
#define PLACE_VECTOR(name)     add_places(&places, to->name, sizeof to->name / sizeof *to->name);
#define PLACE_UNIT(name)       PLACE_VECTOR(name)
#define PLACE_ID(name)
#define PLACE_TEXT(name)
#define PLACE_INDEX(name)
#define PLACE_CHOICE(name)
#define PLACE_FLAG(name)

static struct places places_of_body(percuss_v1_BodyMotion *to)
{
    struct places places = {0};
    PERCUSS_BODY_FIELDS(PLACE, PERCUSS_NONE)
    return places;
}

static struct places places_of_contact(percuss_v1_Contact *to)
{
    struct places places = {0};
    PERCUSS_CONTACT_FIELDS(PLACE)
    return places;
}

static struct places places_of_options(percuss_v1_Options *to)
{
    struct places places = {0};
    PERCUSS_OPTION_FIELDS(PLACE)
    return places;
}

struct change {
    uint8_t kind, index, member, how;
    double value;
};

static void change_number(double *number, const struct change *change)
{
    if (change->how % 3 == 0)
        *number = change->value;
    else if (change->how % 3 == 1)
        *number *= change->value;
    else
        *number += change->value;
}

static void add_override(struct scene *scene, const struct change *change)
{
    percuss_v1_BodyMotion *body = &scene->bodies[change->index % scene->wire.bodies._length];
    if (body->overrides._length < PERCUSS_PARAMETER_COUNT)
        body->overrides._buffer[body->overrides._length++] =
            (percuss_v1_Override){change->member % PERCUSS_PARAMETER_COUNT, change->value};
}

/* The client's own inverse masses, of normals or of tangents too: first all alone, then couplings.
 */
static void change_delassus(struct scene *scene, const struct change *change)
{
    size_t n = scene->wire.contacts._length;
    bool oblique = change->how & 0x80 && n <= PERCUSS_MAX_CONTACTS_OBLIQUE;
    if (oblique || scene->wire.delassus._length == 9 * n * n)
        n *= 3;
    if (scene->wire.delassus._length != n * n) {
        memset(scene->delassus, 0, sizeof scene->delassus);
        for (size_t i = 0; i < n; i++)
            scene->delassus[i * (n + 1)] = 30.0;
    }
    scene->wire.delassus._length = (uint32_t)(n * n);
    size_t row = change->index % n, column = change->member % n;
    change_number(&scene->delassus[row * n + column], change);
    scene->delassus[column * n + row] = scene->delassus[row * n + column];
}

static void change_choice(percuss_v1_Options *options, const struct change *change)
{
    uint32_t *choices[] = {&options->contact_model, &options->method, &options->compliance,
                           &options->dents};
    *choices[change->index % 4] = change->member % 6;
}

static void apply(struct scene *scene, const struct change *change)
{
    percuss_v1_Request *wire = &scene->wire;
    struct places places = places_of_options(&wire->options);
    switch (change->kind % 8) {
    case 0:
        add_override(scene, change);
        return;
    case 1:
        change_delassus(scene, change);
        return;
    case 2:
        change_choice(&wire->options, change);
        return;
    case 3:
    case 4:
        places = places_of_body(&scene->bodies[change->index % wire->bodies._length]);
        break;
    case 5:
    case 6:
        places = places_of_contact(&scene->contacts[change->index % wire->contacts._length]);
        break;
    }
    change_number(places.at[change->member % places.count], change);
}

/* ---- the answer ---- */

struct patience {
    unsigned asked;
    bool refused;
};

static bool proceed(void *context, double done)
{
    struct patience *patience = context;
    FUZZ_REQUIRE(done >= 0.0 && done <= 1.0, "%g of it is done", done);
    /* whoever was told to stop does not go on working and asking */
    FUZZ_REQUIRE(patience->asked < MOST_ASKED + 16, "goes on after it was stopped");
    patience->refused = ++patience->asked > MOST_ASKED;
    return !patience->refused;
}

static void require_numbers(const struct solve_result *result)
{
    for (size_t b = 0; b < result->body_count; b++) {
        const struct solve_body_result *body = &result->bodies[b];
        FUZZ_REQUIRE(isfinite(body->vibration), "body %zu: vibration %g", b, body->vibration);
        for (int k = 0; result->velocities_known && k < 3; k++)
            FUZZ_REQUIRE(isfinite(body->velocity[k]) && isfinite(body->angular_velocity[k]),
                         "body %zu: velocities", b);
    }
    for (size_t c = 0; c < result->contact_count; c++)
        for (int k = 0; k < 3; k++)
            FUZZ_REQUIRE(isfinite(result->contacts[c].impulse_vector[k]), "contact %zu", c);
    FUZZ_REQUIRE(isfinite(result->energy.available) && isfinite(result->energy.plastic) &&
                     isfinite(result->energy.vibration) && isfinite(result->window),
                 "energies");
}

/* Where the numerics fail, and say so: no answer is given, and scenes.py counts them. */
static bool is_unanswered(const struct solve_result *result)
{
    bool known = result->status == PERCUSS_INTERNAL &&
                 (strncmp(result->fault.text, "energy.closure: ", 16) == 0 ||
                  strncmp(result->fault.text, "contact region: no equilibrium", 30) == 0);
    if (known)
        fprintf(stderr, "unanswered: %s\n", result->fault.text);
    return known;
}

static void judge(const struct solve_result *result, const struct solve_request *request,
                  const struct patience *patience)
{
    if (is_unanswered(result))
        return;
    const char *broken = invariant_broken(result, solve_tolerance(&request->options));
    FUZZ_REQUIRE(!broken, "%s; status %d: %s", broken, result->status, result->fault.text);
    FUZZ_REQUIRE(!patience->refused || result->status != PERCUSS_OK || patience->asked,
                 "stopped and OK");
    if (result->status == PERCUSS_OK || result->status == PERCUSS_TRUNCATED)
        require_numbers(result);
    else
        fuzz_refused(result->status, result->fault.text);
}

/* Whether both answers are the same to the bit, but for pointers. */
static void compare(const struct solve_result *a, const struct solve_result *b)
{
    FUZZ_REQUIRE(a->status == b->status, "status %d, then %d", a->status, b->status);
    for (size_t c = 0; a->status == PERCUSS_OK && c < a->contact_count; c++)
        FUZZ_REQUIRE(memcmp(&a->contacts[c].impulse, &b->contacts[c].impulse,
                            sizeof a->contacts[c].impulse) == 0,
                     "contact %zu: %.17g N s, then %.17g", c, a->contacts[c].impulse,
                     b->contacts[c].impulse);
    FUZZ_REQUIRE(memcmp(&a->energy, &b->energy, sizeof a->energy) == 0, "other energies");
}

static void ask(struct lab *lab, const struct solve_request *request, bool twice)
{
    static struct solve_result result, again;
    struct patience patience = {0};
    struct solve_context means = lab->means;
    means.watch = (struct watch){proceed, &patience};
    solve(lab->workspace, &means, request, &result);
    judge(&result, request, &patience);
    if (!twice || patience.refused)
        return;
    struct solve_workspace *fresh = solve_workspace_create();
    patience = (struct patience){0};
    solve(fresh, &means, request, &again);
    if (!patience.refused)
        compare(&result, &again);
    solve_workspace_free(fresh);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct lab *lab;
    static struct scene scene;
    static struct solve_request request;
    struct any_scene drawn;
    struct fuzz_bytes bytes = {data, size};
    uint16_t number;
    struct fault fault = {""};
    if (!lab)
        lab = lab_create();
    fuzz_take(&bytes, &number, sizeof number);
    any_scene_draw(lab, number, &drawn);
    struct solve_request plain = any_scene_request(&drawn, 0);
    put_scene(&plain, &scene);
    for (int i = 0; i < MOST_CHANGES && bytes.left; i++) {
        struct change change;
        fuzz_take(&bytes, &change.kind, 4);
        fuzz_take(&bytes, &change.value, sizeof change.value);
        apply(&scene, &change);
    }
    enum percuss_status status = decode_request(&scene.wire, &request, &fault);
    if (status)
        fuzz_refused(status, fault.text);
    else
        ask(lab, &request, size % 8 == 3);
    return 0;
}
