/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "endpoint/decode.h"

#include <math.h>
#include <string.h>

#include "endpoint/check.h"
#include "endpoint/text.h"

/* Beyond these no impact makes sense and sums of squares would lose their digits or overflow. */
static const double max_length = 1e6;                         /* m */
static const double max_speed = 1e6;                          /* m/s */
static const double max_rotation = 1e6;                       /* rad/s */
static const double max_acceleration = 1e9;                   /* m/s^2 */
static const double max_time = 1e9;                           /* s */
static const double least_horizon = 1e-9, max_horizon = 10.0; /* s */
static const double least_tolerance = 1e-12;   /* of double precision nothing finer is left */
static const double delassus_asymmetry = 1e-9; /* of the two contacts' own inverse masses */

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

static void decode_body(struct check *check, const percuss_v1_BodyMotion *wire,
                        struct solve_body *body)
{
    check_text(check, "id", wire->id);
    check_that(check, wire->id[0] != '\0', "id: empty: must be the id of a body of the catalogue");
    check_vector(check, "position", wire->position, max_length);
    check_unit(check, "orientation", wire->orientation, 4, body->orientation);
    check_vector(check, "velocity", wire->velocity, max_speed);
    check_vector(check, "angular_velocity", wire->angular_velocity, max_rotation);
    check_text(check, "state", wire->state);
    check_range(check, "elapsed", wire->elapsed, 0.0, max_time);
    check_text(check, "specimen", wire->specimen);
    check_that(check, !wire->specimen[0] || !wire->state[0],
               "specimen: %s: must be empty where a state is given: a specimen is at rest",
               wire->specimen);
    COPY_TEXT(body->id, wire->id);
    memcpy(body->position, wire->position, sizeof body->position);
    memcpy(body->velocity, wire->velocity, sizeof body->velocity);
    memcpy(body->angular_velocity, wire->angular_velocity, sizeof body->angular_velocity);
    body->state = NULL;
    body->elapsed = wire->elapsed;
    decode_overrides(check, wire, body);
}

static void check_index(struct check *check, const char *field, unsigned index, size_t count)
{
    check_that(check, index < count, "%s: %u: must be an index into bodies, 0 to %zu", field, index,
               count - 1);
}

static void decode_contact(struct check *check, const percuss_v1_Contact *wire, size_t body_count,
                           struct solve_contact *contact)
{
    check_index(check, "a", wire->a, body_count);
    check_index(check, "b", wire->b, body_count);
    check_that(check, wire->a != wire->b, "b: %u: must be another body than a", wire->b);
    check_vector(check, "point", wire->point, max_length);
    check_unit(check, "normal", wire->normal, 3, contact->normal);
    check_range(check, "gap", wire->gap, -max_length, max_length);
    check_range(check, "gap_acceleration", wire->gap_acceleration, -max_acceleration,
                max_acceleration);
    contact->a = wire->a;
    contact->b = wire->b;
    memcpy(contact->point, wire->point, sizeof contact->point);
    contact->gap = wire->gap;
    contact->gap_acceleration = wire->gap_acceleration;
}

static const char *dents_name(unsigned number)
{
    return number == PERCUSS_DENTS_KEEP ? "keep" : "ignore";
}

static void decode_options(struct check *check, const percuss_v1_Options *wire,
                           struct solve_options *options)
{
    check_range_or_zero(check, "tolerance", wire->tolerance, least_tolerance, 1.0);
    check_range_or_zero(check, "horizon", wire->horizon, least_horizon, max_horizon);
    check_choice(check, "contact_model", wire->contact_model, PERCUSS_CONTACT_COUNT,
                 contact_model_name);
    check_choice(check, "method", wire->method, PERCUSS_METHOD_COUNT, method_name);
    check_choice(check, "compliance", wire->compliance, PERCUSS_COMPLIANCE_COUNT, compliance_name);
    check_choice(check, "dents", wire->dents, PERCUSS_DENTS_COUNT, dents_name);
    check_range(check, "deadline", wire->deadline, 0.0, max_time);
    *options = (struct solve_options){
        .tolerance = wire->tolerance,
        .horizon = wire->horizon,
        .contact_model = wire->contact_model,
        .method = wire->method,
        .compliance = wire->compliance,
        .dents = wire->dents,
        .conditioning = wire->conditioning,
        .trace = wire->trace,
    };
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
    check_that(check, fabs(upper - lower) <= delassus_asymmetry * size,
               "delassus[%zu][%zu]: %.17g: must equal [%zu][%zu], %.17g, within %g", row, column,
               upper, column, row, lower, delassus_asymmetry * size);
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
    check_count(&check, "bodies", body_count, PERCUSS_MAX_BODIES);
    check_count(&check, "contacts", contact_count, PERCUSS_MAX_CONTACTS);
    for (size_t i = 0; !check.status && i < body_count; i++) {
        check_enter(&check, "bodies", i);
        decode_body(&check, &wire->bodies._buffer[i], &request->bodies[i]);
    }
    check_specimens(&check, wire->bodies._buffer, check.status ? 0 : body_count);
    for (size_t i = 0; !check.status && i < contact_count; i++) {
        check_enter(&check, "contacts", i);
        decode_contact(&check, &wire->contacts._buffer[i], body_count, &request->contacts[i]);
    }
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
