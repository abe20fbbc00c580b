/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Denormal, huge and undefined numbers in every field of a request: an answer in finite numbers, or
 * a refusal that names a field. */
#include "physics/hard/hard.h"

static const double extremes[] = {0.0,      -0.0,     5e-324,    -5e-324, 1e-310, 1e-300,
                                  -1e-300,  1e-150,   1e150,     1e300,   -1e300, 1.7e308,
                                  -1.7e308, INFINITY, -INFINITY, NAN};

/* Words of which a refusal must have one: the field itself, or the quantity made of it. */
struct field {
    const char *name;
    double *value;
    const char *words[4];
};

static void check_answer(const struct field *field, double value, const struct solve_result *result)
{
    if (result->status == PERCUSS_OK || result->status == PERCUSS_TRUNCATED)
        return; /* hard_solve has seen that it is finite */
    for (size_t i = 0; i < COUNT(field->words) && field->words[i]; i++)
        if (strstr(result->fault.text, field->words[i]))
            return;
    fail_msg("%s = %g: %s: %s", field->name, value, status_name(result->status),
             result->fault.text);
}

static void try_values(struct lab *lab, struct solve_request *request, const struct field *field,
                       const double *values, size_t count)
{
    static struct solve_result result;
    double good = *field->value;
    for (size_t i = 0; i < count; i++) {
        *field->value = values[i];
        if (getenv("PERCUSS_MEASURE"))
            print_message("    %s = %g\n", field->name, values[i]);
        hard_solve(lab, request, &result);
        check_answer(field, values[i], &result);
    }
    *field->value = good;
}

static void try_field(struct lab *lab, struct solve_request *request, const struct field *field)
{
    try_values(lab, request, field, extremes, COUNT(extremes));
}

static void every_field_of_a_request(void **state)
{
    (void)state;
    struct lab *lab = paper_lab(0.0);
    struct solve_request request = on_beam(0.1, 0.2);
    struct solve_body *ball = &request.bodies[0];
    struct solve_body *beam = &request.bodies[1];
    struct solve_contact *contact = &request.contacts[0];
    const struct field fields[] = {
        {"ball.position[0]", &ball->position[0], {"contacts[0].point", "position", "gap rate"}},
        {"ball.position[2]", &ball->position[2], {"contacts[0].point", "position"}},
        {"ball.velocity[0]", &ball->velocity[0], {"velocity", "gap rate"}},
        {"ball.velocity[2]", &ball->velocity[2], {"velocity", "gap rate"}},
        {"ball.angular_velocity[1]", &ball->angular_velocity[1], {"velocity", "gap rate"}},
        {"beam.position[1]", &beam->position[1], {"contacts[0].point", "position"}},
        {"beam.velocity[2]", &beam->velocity[2], {"velocity", "gap rate"}},
        {"beam.angular_velocity[1]", &beam->angular_velocity[1], {"velocity", "gap rate"}},
        {"contacts[0].point[0]", &contact->point[0], {"contacts[0].point"}},
        {"contacts[0].point[2]", &contact->point[2], {"contacts[0].point"}},
    };
    for (size_t i = 0; i < COUNT(fields); i++)
        try_field(lab, &request, &fields[i]);
    lab_free(lab);
}

/* What the endpoint lets through of the fields that it bounds. */
static void every_time_gap_and_acceleration(void **state)
{
    (void)state;
    static const double horizons[] = {0.0, 1e-9, 1e-6, 10.0};
    static const double gaps[] = {0.0,     -0.0,  5e-324, -5e-324, 1e-310, -1e-310, 1e-150,
                                  -1e-150, 1e-20, -1e-20, 1.0,     -1.0,   1e6,     -1e6};
    static const double accelerations[] = {0.0,    -0.0,    5e-324, -5e-324, 1e-310, -1e-310,
                                           1e-150, -1e-150, 1.0,    -1.0,    1e9,    -1e9};
    struct lab *lab = paper_lab(0.0);
    struct solve_request request = on_beam(0.1, 0.2);
    struct field horizon = {"options.horizon", &request.options.horizon, {"horizon"}};
    struct field gap = {"contacts[0].gap", &request.contacts[0].gap, {"contacts[0].gap"}};
    struct field acceleration = {"contacts[0].gap_acceleration",
                                 &request.contacts[0].gap_acceleration,
                                 {"contacts[0].gap_acceleration"}};
    static const double tolerances[] = {0.0, 1e-12, 5e-324, 1e-310, 1.0};
    struct field tolerance = {"options.tolerance", &request.options.tolerance, {"tolerance"}};
    try_values(lab, &request, &tolerance, tolerances, COUNT(tolerances));
    try_values(lab, &request, &horizon, horizons, COUNT(horizons));
    try_values(lab, &request, &gap, gaps, COUNT(gaps));
    try_values(lab, &request, &acceleration, accelerations, COUNT(accelerations));
    lab_free(lab);
}

static void every_delassus(void **state)
{
    (void)state;
    static const double values[] = {0.0,  -0.0,  -1e-310, 1e-300,    1e-150,
                                    1e-9, 1e150, -1e300,  -INFINITY, NAN};
    struct lab *lab = paper_lab(0.0);
    double w = 1.0;
    struct solve_request request = on_beam(0.1, 0.2);
    request.delassus = &w;
    try_values(lab, &request, &(struct field){"delassus", &w, {"delassus"}}, values, COUNT(values));
    lab_free(lab);
}

/* Bodies: what the catalogue may say is bounded, and its bounds are solved. */
static void every_number_of_a_body(void **state)
{
    (void)state;
    struct body ball = make_sphere(STEEL, 0.015);
    struct body beam = make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0);
    const struct {
        const char *name;
        double *value;
        struct body *body;
    } fields[] = {{"radius", &ball.radius, &ball},
                  {"young", &ball.material.young, &ball},
                  {"density", &ball.material.density, &ball},
                  {"poisson", &ball.material.poisson, &ball},
                  {"length", &beam.length, &beam},
                  {"damping", &beam.damping, &beam}};
    for (size_t f = 0; f < COUNT(fields); f++) {
        double good = *fields[f].value;
        for (size_t i = 0; i < COUNT(extremes); i++) {
            struct fault fault = {0};
            *fields[f].value = extremes[i];
            struct body trial = *fields[f].body;
            if (body_complete(&trial, &fault))
                assert_non_null(strstr(fault.text, fields[f].name));
            else
                assert_true(isfinite(trial.mass) && trial.mass > 0.0);
        }
        *fields[f].value = good;
    }
}

static void the_bounds_of_the_catalogue(void **state)
{
    (void)state;
    static struct solve_result result;
    static const double lengths[] = {1e-9, 1e3};
    static const double youngs[] = {1e3, 1e13};
    static const double densities[] = {1e-3, 1e5};
    struct lab *lab = paper_lab(0.0);
    for (int i = 0; i < 8; i++) {
        double radius = lengths[i & 1];
        struct material stuff = {"stuff", youngs[i >> 1 & 1], 0.3, densities[i >> 2 & 1], INFINITY,
                                 0.0};
        lab_add(lab, "ball", make_sphere(stuff, radius));
        lab_add(lab, "wall", make_body(&half_space_kind, stuff));
        struct solve_request request = strike(sphere_spot("ball", radius), wall_spot("wall"), 1e-3);
        request.options.horizon = 1e9;
        hard_solve(lab, &request, &result);
        assert_separated(&result);
        /* waves take 1.13 (v/c)^(3/5) of the energy (Poisson's ratio 0.3, both alike), less some
         * two thirds of the square of that; a twentieth of the tolerance is left out */
        double share = 1.1318 * pow(1e-3 * sqrt(stuff.density / stuff.young), 0.6);
        double e = sqrt(1.0 - share + 0.64 * share * share);
        measured("e", result.contacts[0].restitution, e, 1e-4 + 0.1 * share * share);
    }
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_field_of_a_request),
        cmocka_unit_test(every_time_gap_and_acceleration),
        cmocka_unit_test(every_delassus),
        cmocka_unit_test(every_number_of_a_body),
        cmocka_unit_test(the_bounds_of_the_catalogue),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
