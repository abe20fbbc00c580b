/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/problem.h"

#include <math.h>

#include "base/extremes.h"
#include "model/rigid.h"
#include "model/vector.h"

struct problem *problem_create(const struct solve_request *request, struct prepared_cache *cache,
                               struct arena *arena)
{
    struct problem *problem = arena_take(arena, 1, sizeof *problem);
    if (!problem)
        return NULL;
    problem->request = request;
    problem->cache = cache;
    problem->arena = arena;
    problem->tolerance = solve_tolerance(&request->options);
    problem->body_count = request->body_count;
    problem->contact_count = request->contact_count;
    /* arrays over the bodies */
    size_t bodies = request->body_count;
    problem->bodies = arena_take(arena, bodies, sizeof *problem->bodies);
    problem->poses = arena_take(arena, bodies, sizeof *problem->poses);
    problem->axes = arena_take(arena, bodies, sizeof *problem->axes);
    problem->states = arena_take(arena, bodies, sizeof *problem->states);
    bool whole = problem->bodies && problem->poses && problem->axes && problem->states;
    return whole ? problem : NULL;
}

double problem_approach(const struct problem *problem)
{
    double speed = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        speed = larger(-problem->gap_rate[c], speed);
    return speed;
}

double problem_indentation(const struct problem *problem, size_t c, double speed)
{
    double w = problem->w[c * (problem->contact_count + 1)];
    return pow(0.5 * speed * speed / w / (HERTZ_WORK * problem->hertz[c].stiffness), 0.4);
}

double problem_touching_speed(const struct problem *problem, size_t c)
{
    const struct solve_contact *contact = &problem->request->contacts[c];
    const double rate = smaller(problem->gap_rate[c], 0.0);
    return sqrt(rate * rate - 2.0 * contact->gap_acceleration * larger(0.0, contact->gap));
}

double problem_frequency(const struct problem *problem, size_t c)
{
    double speed = problem_touching_speed(problem, c);
    return M_PI * speed / (HERTZ_DURATION * problem_indentation(problem, c, speed));
}

/* Whether two contacts have a body in common. */
static bool share_body(const struct problem *problem, size_t a, size_t b)
{
    for (int i = 0; i < 4; i++)
        if (problem->sides[a][i / 2].body == problem->sides[b][i % 2].body)
            return true;
    return false;
}

double problem_frequency_near(const struct problem *problem, size_t c)
{
    double near = 0.0, any = 0.0;
    for (size_t other = 0; other < problem->contact_count; other++) {
        double omega = problem_frequency(problem, other);
        if (!(omega > 0.0))
            continue;
        if (other == c)
            return omega;
        any = fmax(any, omega);
        near = fmax(near, share_body(problem, c, other) ? omega : 0.0);
    }
    return near > 0.0 ? near : any;
}

double problem_largest_compression(const struct problem *problem)
{
    double largest = 0.0;
    for (size_t c = 0; c < problem->contact_count; c++)
        largest = larger(problem->impulse_compression[c], largest);
    return largest;
}

const struct family_load *problem_load(const struct problem *problem, size_t row, size_t body,
                                       size_t family)
{
    /* The modes of a solid at a point sum up to the contact's own flexibility, without bound. A
     * contact law has its share of that; plain friction has none, and solids are rigid along their
     * surface. */
    if (row >= problem->contact_count && problem_is_plain(problem) &&
        body_is_solid(problem->bodies[body]))
        return NULL;
    const struct contact_side *sides = problem->sides[problem_row_contact(problem, row)];
    for (int which = 0; which < 2; which++) {
        if (sides[which].body != body)
            continue;
        const struct family_load *load =
            &problem_row_side(problem, row, which).load->family[family];
        return load->acts ? load : NULL;
    }
    return NULL;
}

size_t problem_stated_place(const struct problem *problem, size_t i, size_t j)
{
    size_t n = problem->contact_count;
    if (!problem->request->delassus_oblique)
        return i * n + j;
    /* normals and tangents contact by contact */
    const size_t row[2] = {i, j};
    size_t at[2];
    for (int k = 0; k < 2; k++)
        at[k] = 3 * problem_row_contact(problem, row[k]) + (row[k] < n ? 0 : 1 + (row[k] - n) % 2);
    return at[0] * 3 * n + at[1];
}

double problem_row_scale(const struct problem *problem, size_t row)
{
    size_t rows = problem_rows(problem);
    double largest = 0.0;
    for (size_t r = 0; r < rows; r++)
        if (problem_row_contact(problem, r) == problem_row_contact(problem, row))
            largest = larger(largest, problem->row_w[r * (rows + 1)]);
    return largest;
}

double problem_inverse_mass(const struct problem *problem, size_t i, size_t j)
{
    const struct row_side of[2] = {problem_row_side(problem, i, 0),
                                   problem_row_side(problem, i, 1)};
    const struct row_side by[2] = {problem_row_side(problem, j, 0),
                                   problem_row_side(problem, j, 1)};
    double sum = 0.0;
    for (int p = 0; p < 2; p++)
        for (int q = 0; q < 2; q++)
            if (of[p].body == by[q].body)
                sum += rigid_inverse_mass(problem->bodies[of[p].body], of[p].point, of[p].direction,
                                          by[q].point, by[q].direction);
    return sum;
}

bool problem_is_plain(const struct problem *problem)
{
    return problem->request->options.friction == PERCUSS_FRICTION_PLAIN;
}
