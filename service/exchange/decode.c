/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "exchange/decode.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "exchange/text.h"
#include "percuss/fields.h"

/* Checks of foreign values, one after the other: the first that fails writes the message "PLACE:
 * VALUE: must be ALLOWED", and later ones write nothing. */

/* How far from 1 the norm of a unit vector may be. */
static const double UNIT_TOLERANCE = 1e-4;

struct check {
    enum percuss_status status; /* PERCUSS_OK or PERCUSS_BAD_REQUEST */
    struct fault *fault;
    const char *place; /* that the fields belong to; NULL: the request itself */
    size_t index;      /* in it; CHECK_NO_LIST: it is no list */
};

#define CHECK_NO_LIST SIZE_MAX

/* Sets the place to "NAME[INDEX]" or "NAME"; the name stays the caller's and must outlive the
 * checks of this place. No text is formatted before a check fails: most requests are good. */
static void check_enter(struct check *check, const char *name, size_t index)
{
    check->place = name;
    check->index = index;
}

/* Writes the message if `good` is false. */
static void __attribute__((format(printf, 3, 4)))
check_that(struct check *check, bool good, const char *format, ...)
{
    if (good || check->status)
        return;
    char message[sizeof check->fault->text], place[32] = "";
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    if (check->place && check->index == CHECK_NO_LIST)
        snprintf(place, sizeof place, "%s.", check->place);
    else if (check->place)
        snprintf(place, sizeof place, "%s[%zu].", check->place, check->index);
    check->status = fault_set(check->fault, PERCUSS_BAD_REQUEST, "%s%s", place, message);
}

static bool is_within(double value, double low, double high)
{
    return value >= low && value <= high; /* false for NaN */
}

/* Finite and within low .. high. */
static void check_range(struct check *check, const char *field, double value, double low,
                        double high)
{
    check_that(check, is_within(value, low, high), "%s: %g: must be in [%g, %g]", field, value, low,
               high);
}

/* The same, or 0 for the default. */
static void check_range_or_zero(struct check *check, const char *field, double value, double low,
                                double high)
{
    check_that(check, value == 0.0 || is_within(value, low, high),
               "%s: %g: must be 0 (the default) or in [%g, %g]", field, value, low, high);
}

struct vector_text {
    char text[128];
};

static struct vector_text vector_text(const double *vector, size_t size)
{
    struct vector_text list = {"("};
    size_t used = 1;
    for (size_t i = 0; i < size && used < sizeof list.text; i++)
        used += (size_t)snprintf(list.text + used, sizeof list.text - used, "%g%s", vector[i],
                                 i + 1 < size ? ", " : ")");
    return list;
}

/* Three finite numbers of magnitude at most `limit`. */
static void check_vector(struct check *check, const char *field, const double vector[3],
                         double limit)
{
    bool good = true;
    for (size_t i = 0; i < 3; i++)
        good = good && is_within(vector[i], -limit, limit);
    if (!good)
        check_that(check, false, "%s: %s: each must be in [%g, %g]", field,
                   vector_text(vector, 3).text, -limit, limit);
}

/* A unit vector of 3 or 4 numbers to 1e-4; `unit` receives it normalised. */
static void check_unit(struct check *check, const char *field, const double *vector, size_t size,
                       double *unit)
{
    double square = 0.0;
    for (size_t i = 0; i < size; i++)
        square += vector[i] * vector[i];
    double norm = sqrt(square);
    if (!(fabs(norm - 1.0) <= UNIT_TOLERANCE))
        check_that(check, false, "%s: %s: must be a unit %s (norm within %g of 1)", field,
                   vector_text(vector, size).text, size == 4 ? "quaternion (w, x, y, z)" : "vector",
                   UNIT_TOLERANCE);
    for (size_t i = 0; i < size; i++)
        unit[i] = vector[i] / norm;
}

/* A number below `count`; the message names the allowed ones. */
static void check_choice(struct check *check, const char *field, unsigned value, unsigned count,
                         const char *(*name)(unsigned))
{
    char list[256] = "";
    size_t used = 0;
    for (unsigned i = 0; value >= count && i < count && used < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%u (%s)", i ? ", " : "", i,
                                 name(i));
    check_that(check, value < count, "%s: %u: must be one of %s", field, value, list);
}

/* Bytes of the UTF-8 character at `text`; 0: none, or a control character. */
static size_t character_size(const unsigned char *text)
{
    /* forms of one to four octets (RFC 3629): how the first begins, and the least code of each */
    static const struct {
        unsigned char mask, lead;
        unsigned least; /* longer than needed is not UTF-8 */
    } forms[] = {
        {0x80, 0x00, 0x20}, {0xe0, 0xc0, 0xa0}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}};
    for (size_t extra = 0; extra < 4; extra++) {
        if ((text[0] & forms[extra].mask) != forms[extra].lead)
            continue;
        /* six bits of the code from each octet that follows */
        unsigned code = text[0] & (unsigned char)~forms[extra].mask;
        for (size_t i = 1; i <= extra; i++) {
            if ((text[i] & 0xc0) != 0x80)
                return 0;
            code = code << 6 | (text[i] & 0x3f);
        }
        /* neither a control character nor half of a UTF-16 pair */
        bool surrogate = code >= 0xd800 && code < 0xe000;
        bool allowed = code >= forms[extra].least && code != 0x7f && code < 0x110000;
        return allowed && !surrogate ? extra + 1 : 0;
    }
    return 0;
}

/* Text in UTF-8 without control characters. */
static void check_text(struct check *check, const char *field, const char *text)
{
    const unsigned char *at = (const unsigned char *)text;
    while (*at && character_size(at))
        at += character_size(at);
    check_that(check, !*at, "%s: byte 0x%02x at %td: must be UTF-8 without control characters",
               field, *at, (const char *)at - text);
}

/* A request. */

static const double DELASSUS_ASYMMETRY = 1e-9; /* of the two contacts' own inverse masses */
/* 1/kg; a lighter body moves while its indentation is less than the rounding of a place, and the
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

/* Sine of the angle to the normal below which a direction says nothing about the tangent plane. */
static const double TANGENT_LEAST = 1e-6;

/* Makes a stated tangent normal to the unit normal, and a unit vector; zero stays zero. */
static void project_tangent(struct check *check, const double stated[3], const double normal[3],
                            double tangent[3])
{
    double size = fmax(fabs(stated[0]), fmax(fabs(stated[1]), fabs(stated[2])));
    if (check->status || size == 0.0)
        return;
    /* of a size of which squares are neither 0 nor infinite */
    for (int i = 0; i < 3; i++)
        tangent[i] = stated[i] / size;
    double along = tangent[0] * normal[0] + tangent[1] * normal[1] + tangent[2] * normal[2];
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        tangent[i] -= along * normal[i];
        square += tangent[i] * tangent[i];
    }
    double norm = sqrt(square);
    if (norm < TANGENT_LEAST)
        check_that(check, false, "tangent: %s: must not be parallel to the normal, %s",
                   vector_text(stated, 3).text, vector_text(normal, 3).text);
    for (int i = 0; i < 3; i++)
        tangent[i] /= norm;
}

static void decode_contact(struct check *check, const percuss_v1_Contact *from, size_t body_count,
                           struct solve_contact *to)
{
    check_index(check, "a", from->a, body_count);
    check_index(check, "b", from->b, body_count);
    check_that(check, from->a != from->b, "b: %u: must be another body than a", from->b);
    PERCUSS_CONTACT_FIELDS(TAKE)
    project_tangent(check, from->tangent, to->normal, to->tangent);
}

static void decode_options(struct check *check, const percuss_v1_Options *from,
                           struct solve_options *to)
{
    PERCUSS_OPTION_FIELDS(TAKE)
}

/* The matrix of a request, with `each` rows a contact: its normal's, or those of both tangents too.
 */
struct stated_matrix {
    const double *values;
    size_t rows, each;
};

/* The largest inverse mass of a row's contact: along a tangent a mechanism may not move, and what
 * its numbers are rounded by are those of the other directions. */
static double matrix_row_scale(const struct stated_matrix *matrix, size_t row)
{
    size_t first = row / matrix->each * matrix->each;
    double largest = 0.0;
    for (size_t r = first; r < first + matrix->each; r++)
        largest = fmax(largest, matrix->values[r * (matrix->rows + 1)]);
    return largest;
}

/* A coupling of zero has rounding errors as large as those of the diagonals. */
static void check_delassus_pair(struct check *check, const struct stated_matrix *matrix, size_t row,
                                size_t column)
{
    double upper = matrix->values[row * matrix->rows + column];
    double lower = matrix->values[column * matrix->rows + row];
    double size = sqrt(matrix_row_scale(matrix, row)) * sqrt(matrix_row_scale(matrix, column));
    check_that(check, isfinite(upper) && isfinite(lower),
               "delassus[%zu][%zu]: %g: must be finite, as its mirror image %g", row, column, upper,
               lower);
    check_that(check, fabs(upper - lower) <= DELASSUS_ASYMMETRY * size,
               "delassus[%zu][%zu]: %.17g: must equal [%zu][%zu], %.17g, within %g", row, column,
               upper, column, row, lower, DELASSUS_ASYMMETRY * size);
}

/* A contact moves along its normal; along a tangent it need not. */
static void check_delassus_diagonal(struct check *check, const struct stated_matrix *matrix,
                                    size_t row)
{
    double diagonal = matrix->values[row * (matrix->rows + 1)];
    bool normal = row % matrix->each == 0;
    check_that(check, isfinite(diagonal) && (normal ? diagonal > 0.0 : diagonal >= 0.0),
               "delassus[%zu][%zu]: %g: must be finite and %s 0", row, row, diagonal,
               normal ? ">" : ">=");
    check_that(check, diagonal <= DELASSUS_LARGEST, "delassus[%zu][%zu]: %g: must be at most %g",
               row, row, diagonal, DELASSUS_LARGEST);
}

static void check_delassus(struct check *check, const struct stated_matrix *matrix)
{
    for (size_t row = 0; !check->status && row < matrix->rows; row++)
        check_delassus_diagonal(check, matrix, row);
    for (size_t row = 0; !check->status && row < matrix->rows; row++)
        for (size_t column = 0; column < row; column++)
            check_delassus_pair(check, matrix, row, column);
}

/* Whether some contact has friction is the solver's to find: the catalogue may say so. */
static void decode_delassus(struct check *check, const dds_sequence_double *from, size_t contacts,
                            struct solve_request *request)
{
    size_t numbers = from->_length;
    request->delassus_oblique = numbers > 0 && numbers == 9 * contacts * contacts;
    request->delassus = numbers > 0 ? from->_buffer : NULL;
    size_t each = request->delassus_oblique ? 3 : 1, rows = each * contacts;
    check_that(check, numbers == 0 || numbers == rows * rows,
               "delassus: %zu numbers: must be none, %zu x %zu, a row for every contact, or %zu x "
               "%zu, rows for its normal and both tangents",
               numbers, contacts, contacts, 3 * contacts, 3 * contacts);
    if (!check->status && numbers > 0)
        check_delassus(check, &(struct stated_matrix){from->_buffer, rows, each});
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
    request->friction = (struct solve_friction){.given = false};
    check_enter(&check, NULL, CHECK_NO_LIST);
    decode_delassus(&check, &wire->delassus, contact_count, request);
    check_enter(&check, "options", CHECK_NO_LIST);
    decode_options(&check, &wire->options, &request->options);
    request->body_count = body_count;
    request->contact_count = contact_count;
    return check.status;
}

/* An ensemble. */

/* The quantity, and the body that has it. */
static void decode_owner(struct check *check, const percuss_v1_EnsembleInput *wire,
                         const struct solve_request *request, struct ensemble_input *input)
{
    check_text(check, "name", wire->name);
    check_text(check, "body", wire->body);
    /* the quantity that varies */
    input->quantity = input_quantity_find(wire->name);
    check_that(check, input->quantity < INPUT_QUANTITY_COUNT,
               "name: '%s': must be one of speed, direction, model-force, model-compliance, "
               "model-yield, model-friction, friction, site (or at), young, poisson, density, "
               "radius, yield, damping, scale",
               wire->name);
    /* a quantity of the contact has no body */
    input->body = 0;
    if (!input_is_of_body(input->quantity)) {
        check_that(check, !wire->body[0], "body: '%s': must be empty: %s is the contact's",
                   wire->body, wire->name);
        return;
    }
    /* any other one is of a body of the scene */
    while (input->body < request->body_count &&
           strcmp(request->bodies[input->body].id, wire->body) != 0)
        input->body++;
    check_that(check, input->body < request->body_count,
               "body: '%s': must be the id of a body of the scene, whose %s it is", wire->body,
               wire->name);
}

static void decode_input(struct check *check, const percuss_v1_EnsembleInput *wire,
                         const struct solve_request *request, struct ensemble_input *input)
{
    decode_owner(check, wire, request, input);
    check_choice(check, "distribution", wire->distribution, DISTRIBUTION_KINDS, distribution_name);
    check_that(check, wire->values._length <= ENSEMBLE_MAX_VALUES,
               "values: %u given: must be at most %d", wire->values._length, ENSEMBLE_MAX_VALUES);
    input->distribution = wire->distribution;
    input->first = wire->first;
    input->second = wire->second;
    input->lower = wire->lower;
    input->upper = wire->upper;
    input->values = wire->values._buffer;
    input->value_count = wire->values._length;
}

static void decode_correlations(struct check *check, const percuss_v1_EnsembleRequest *wire,
                                struct decoded_ensemble *decoded)
{
    size_t count = wire->correlations._length;
    check_that(check, count <= DECODE_MAX_CORRELATIONS,
               "correlations: %zu given: must be at most %d", count, DECODE_MAX_CORRELATIONS);
    for (size_t i = 0; !check->status && i < count; i++) {
        const percuss_v1_EnsembleCorrelation *pair = &wire->correlations._buffer[i];
        decoded->correlations[i] =
            (struct copula_pair){pair->first, pair->second, pair->coefficient};
    }
}

static void check_scene(struct check *check, const percuss_v1_Request *scene)
{
    for (uint32_t i = 0; i < scene->bodies._length; i++) {
        const char *state = scene->bodies._buffer[i].state;
        check_that(check, !state[0],
                   "scene.bodies[%u].state: %s: must be empty: a token names one state, which an "
                   "ensemble cannot vary",
                   i, state);
        const char *specimen = scene->bodies._buffer[i].specimen;
        check_that(
            check, !specimen[0],
            "scene.bodies[%u].specimen: %s: must be empty: no sample of an ensemble leaves a "
            "dent in it",
            i, specimen);
    }
}

enum percuss_status decode_ensemble(const percuss_v1_EnsembleRequest *wire,
                                    struct decoded_ensemble *decoded, struct fault *fault)
{
    struct check check = {.fault = fault};
    /* a scene as in a single request, of bodies without a history */
    enum percuss_status status = decode_request(&wire->scene, &decoded->request, fault);
    if (status)
        return status;
    check_scene(&check, &wire->scene);
    /* its uncertain inputs */
    check_that(&check, wire->inputs._length <= ENSEMBLE_MAX_INPUTS,
               "inputs: %u given: must be at most %d", wire->inputs._length, ENSEMBLE_MAX_INPUTS);
    for (uint32_t i = 0; !check.status && i < wire->inputs._length; i++) {
        check_enter(&check, "inputs", i);
        decode_input(&check, &wire->inputs._buffer[i], &decoded->request, &decoded->inputs[i]);
    }
    /* how they depend on each other and are sampled */
    check.place = NULL;
    decode_correlations(&check, wire, decoded);
    check_choice(&check, "sampling", wire->sampling, SAMPLING_METHODS, sampling_name);
    /* the specification of the ensemble */
    decoded->spec = (struct ensemble_spec){
        .request = &decoded->request,
        .contact = wire->contact,
        .input_count = wire->inputs._length,
        .inputs = decoded->inputs,
        .correlation_count = wire->correlations._length,
        .correlations = decoded->correlations,
        .sampling = wire->sampling,
        .samples = wire->samples,
        .seed = wire->seed,
        .half_width = wire->half_width,
        .quantile_half_width = wire->quantile_half_width,
        .quantile_count = wire->quantiles._length,
        .quantiles = wire->quantiles._buffer,
        .bins = wire->bins,
        .list_tangential = wire->list_tangential,
    };
    return check.status;
}
