/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/decode.h"

#include <math.h>
#include <string.h>

#include "exchange/check.h"
#include "exchange/text.h"
#include "percuss/fields.h"

static const double DELASSUS_ASYMMETRY = 1e-9; /* of the two contacts' own inverse masses */
/* 1/kg; what is lighter moves while its indentation is less than the rounding of a place, and the
 * energies no longer balance */
static const double DELASSUS_LARGEST = 1e12;

/* Checks a member of *from and puts it into *to. Indices are checked before, against the bodies;
 * tokens and specimens are not the solver's. */
#define TAKE(kind, name, ...) TAKE_##kind(name, __VA_ARGS__)

#define TAKE_NUMBER(name, low, high, ...)                                                          \
    check_range(check, #name, from->name, low, high);                                              \
    to->name = from->name;
#define TAKE_DEFAULTED(name, low, high, ...)                                                       \
    check_range_or_zero(check, #name, from->name, low, high);                                      \
    to->name = from->name;
#define TAKE_VECTOR(name, limit, ...)                                                              \
    check_vector(check, #name, from->name, limit);                                                 \
    memcpy(to->name, from->name, sizeof to->name);
#define TAKE_UNIT(name, size, ...) check_unit(check, #name, from->name, size, to->name);
#define TAKE_CHOICE(name, choice, count, ...)                                                      \
    check_choice(check, #name, from->name, count, choice##_name);                                  \
    to->name = from->name;
#define TAKE_FLAG(name, ...)  to->name = from->name;
#define TAKE_INDEX(name, ...) to->name = from->name;
#define TAKE_TEXT(name, ...)  check_text(check, #name, from->name);
#define TAKE_ID(name, ...)                                                                         \
    check_text(check, #name, from->name);                                                          \
    check_that(check, from->name[0] != '\0',                                                       \
               #name ": empty: must be the id of a body of the catalogue");                        \
    COPY_TEXT(to->name, from->name);

/* Ranges are the catalogue's, and the solver's to check. */
static void decode_overrides(struct check *check, const percuss_v1_BodyMotion *wire,
                             struct solve_body *body)
{
    size_t count = wire->overrides._length;
    check_that(check, count <= PERCUSS_PARAMETER_COUNT, "overrides: %zu given: must be at most %d",
               count, PERCUSS_PARAMETER_COUNT);
    body->variation_count = 0;
    for (size_t i = 0; !check->status && i < count; i++) {
        const percuss_v1_Override *override = &wire->overrides._buffer[i];
        check_choice(check, "overrides.parameter", override->parameter, PERCUSS_PARAMETER_COUNT,
                     parameter_name);
        body->variations[body->variation_count++] =
            (struct body_variation){override->parameter, override->value};
    }
}

static void decode_body(struct check *check, const percuss_v1_BodyMotion *from,
                        struct solve_body *to)
{
    PERCUSS_BODY_FIELDS(TAKE, PERCUSS_NONE)
    check_that(check, !from->specimen[0] || !from->state[0],
               "specimen: %s: must be empty where a state is given: a specimen is at rest",
               from->specimen);
    to->state = NULL;
    decode_overrides(check, from, to);
}

static void check_index(struct check *check, const char *field, unsigned index, size_t count)
{
    check_that(check, index < count, "%s: %u: must be an index into bodies, 0 to %zu", field, index,
               count - 1);
}

static void decode_contact(struct check *check, const percuss_v1_Contact *from, size_t body_count,
                           struct solve_contact *to)
{
    check_index(check, "a", from->a, body_count);
    check_index(check, "b", from->b, body_count);
    check_that(check, from->a != from->b, "b: %u: must be another body than a", from->b);
    PERCUSS_CONTACT_FIELDS(TAKE)
}

static void decode_options(struct check *check, const percuss_v1_Options *from,
                           struct solve_options *to)
{
    PERCUSS_OPTION_FIELDS(TAKE)
}

/* Rounding of a coupling that is none is as large as that of the diagonals. */
static void check_delassus_pair(struct check *check, const double *matrix, size_t count, size_t row,
                                size_t column)
{
    double upper = matrix[row * count + column], lower = matrix[column * count + row];
    double size = sqrt(matrix[row * (count + 1)]) * sqrt(matrix[column * (count + 1)]);
    check_that(check, isfinite(upper) && isfinite(lower),
               "delassus[%zu][%zu]: %g: must be finite, as its mirror image %g", row, column, upper,
               lower);
    check_that(check, fabs(upper - lower) <= DELASSUS_ASYMMETRY * size,
               "delassus[%zu][%zu]: %.17g: must equal [%zu][%zu], %.17g, within %g", row, column,
               upper, column, row, lower, DELASSUS_ASYMMETRY * size);
}

static void check_delassus(struct check *check, const dds_sequence_double *matrix, size_t count)
{
    check_that(check, matrix->_length == count * count,
               "delassus: %u numbers: must be none or %zu x %zu, a row for every contact",
               matrix->_length, count, count);
    for (size_t row = 0; !check->status && row < count; row++) {
        double diagonal = matrix->_buffer[row * count + row];
        check_that(check, isfinite(diagonal) && diagonal > 0.0,
                   "delassus[%zu][%zu]: %g: must be finite and > 0", row, row, diagonal);
        check_that(check, diagonal <= DELASSUS_LARGEST,
                   "delassus[%zu][%zu]: %g: must be at most %g", row, row, diagonal,
                   DELASSUS_LARGEST);
        for (size_t column = 0; column < row; column++)
            check_delassus_pair(check, matrix->_buffer, count, row, column);
    }
}

/* An object is in one place at a time. */
static void check_specimens(struct check *check, const percuss_v1_BodyMotion *bodies, size_t count)
{
    for (size_t i = 0; !check->status && i < count; i++) {
        check_enter(check, "bodies", i);
        for (size_t j = 0; bodies[i].specimen[0] && j < i; j++)
            check_that(check, strcmp(bodies[i].specimen, bodies[j].specimen) != 0,
                       "specimen: %s: must be another one than that of bodies[%zu]",
                       bodies[i].specimen, j);
    }
}

static void check_count(struct check *check, const char *list, size_t count, size_t most)
{
    check_that(check, count >= 1 && count <= most, "%s: %zu given: must be 1 to %zu", list, count,
               most);
}

enum percuss_status decode_request(const percuss_v1_Request *wire, struct solve_request *request,
                                   struct fault *fault)
{
    struct check check = {.fault = fault};
    size_t body_count = wire->bodies._length, contact_count = wire->contacts._length;
    /* as many as the solver has room for */
    check_count(&check, "bodies", body_count, PERCUSS_MAX_BODIES);
    check_count(&check, "contacts", contact_count, PERCUSS_MAX_CONTACTS);
    /* the bodies, and which objects they are */
    for (size_t i = 0; !check.status && i < body_count; i++) {
        check_enter(&check, "bodies", i);
        decode_body(&check, &wire->bodies._buffer[i], &request->bodies[i]);
    }
    check_specimens(&check, wire->bodies._buffer, check.status ? 0 : body_count);
    /* the contacts between them */
    for (size_t i = 0; !check.status && i < contact_count; i++) {
        check_enter(&check, "contacts", i);
        decode_contact(&check, &wire->contacts._buffer[i], body_count, &request->contacts[i]);
    }
    /* the scene as a whole, by the models as they are */
    memset(request->model_shift, 0, sizeof request->model_shift);
    check_enter(&check, NULL, CHECK_NO_LIST);
    if (wire->delassus._length > 0)
        check_delassus(&check, &wire->delassus, contact_count);
    check_enter(&check, "options", CHECK_NO_LIST);
    decode_options(&check, &wire->options, &request->options);
    request->body_count = body_count;
    request->contact_count = contact_count;
    request->delassus = wire->delassus._length > 0 ? wire->delassus._buffer : NULL;
    return check.status;
}
