/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* A body falls on another one, which is held, and bounces until it rests.
 *
 * The height h of A above the touch: h'' = -g, and at a touch h' becomes -e h', at once, with e of
 * the impact of bodies without vibration and weight. */
#include <float.h>
#include <math.h>

#include "fmu.h"

struct falling_body {
    struct shared shared;
    double gravity, rest_speed;
    double height, velocity;
    double height_rate, velocity_rate, touch;
    double energy, energy_lost;
    bool resting;
    /* not variables: */
    double mass;
    double flight_start, flight_height, flight_velocity; /* Co-Simulation: since the last touch */
};

#define FALLING(role, type, member, unit, start, meaning)                                          \
    VARIABLE_##role, VARIABLE_##type, unit, offsetof(struct falling_body, member), start, NULL,    \
        meaning

static const struct variable VARIABLES[] = {
    SHARED_VARIABLES("al-beam-pinned"),
    {"gravity", FALLING(PARAMETER, FLOAT64, gravity, "m/s2", 9.81, "pulls A on B")},
    {"rest_speed", FALLING(PARAMETER, FLOAT64, rest_speed, "m/s", 1e-3,
                           "who touches or leaves more slowly rests")},
    {"height", FALLING(STATE, FLOAT64, height, "m", 0.1, "of A above where it touches B")},
    {"der(height)", FALLING(DERIVATIVE, FLOAT64, height_rate, "m/s", 0.0, "velocity")},
    {"velocity", FALLING(STATE, FLOAT64, velocity, "m/s", 0.0, "of A, upward")},
    {"der(velocity)",
     FALLING(DERIVATIVE, FLOAT64, velocity_rate, "m/s2", 0.0, "less gravity, until A rests")},
    {"touch",
     FALLING(INDICATOR, FLOAT64, touch, "m", 0.0, "height, as indicator of the next touch")},
    {"energy", FALLING(CONTINUOUS, FLOAT64, energy, "J", 0.0, "of A: of motion and of height")},
    {"energy_lost", FALLING(DISCRETE, FLOAT64, energy_lost, "J", 0.0, "by A in impacts")},
    {"resting", FALLING(DISCRETE, BOOLEAN, resting, NULL, 0.0, "whether A rests on B")},
};

/* m; so far from zero an importer's root of the indicator may be */
static const double TOUCH = 1e-9;

/* W of a body that hits one that is held is 1/m: more means that B gives way */
static const double HELD = 1e-6;

static void refresh(void *numbers)
{
    struct falling_body *body = numbers;
    body->height_rate = body->resting ? 0.0 : body->velocity;
    body->velocity_rate = body->resting ? 0.0 : -body->gravity;
    /* on the positive side after a bounce, from where the next root is looked for */
    body->touch = body->resting ? 1.0 : body->height + DBL_MIN;
    body->energy =
        body->mass * (body->gravity * body->height + 0.5 * body->velocity * body->velocity);
}

/* From here on A flies. */
static void begin_flight(struct falling_body *body)
{
    body->flight_start = body->shared.time;
    body->flight_height = body->height;
    body->flight_velocity = body->velocity;
}

static void rest(struct falling_body *body)
{
    refresh(body);
    body->energy_lost += body->energy;
    body->height = body->velocity = 0.0;
    body->resting = true;
}

/* The impact at that speed. */
static fmi3Status ask(struct fmu *fmu, double speed, struct impact *impact)
{
    const struct falling_body *body = (const struct falling_body *)fmu->numbers;
    struct percuss_request request;
    fmi3Status status = fmu_pair(fmu, speed, &request);
    if (status != fmi3OK)
        return status;
    status = fmu_ask(fmu, &request, -speed, impact);
    if (status != fmi3OK)
        return status;
    if (!(impact->inverse_effective_mass * body->mass <= 1.0 + HELD))
        return fmu_error(fmu, "body_b: '%s' is free and would fly away: one that is held is needed",
                         body->shared.body_b);
    return fmi3OK;
}

/* A has come down to B. */
static fmi3Status bounce(struct fmu *fmu)
{
    struct falling_body *body = (struct falling_body *)fmu->numbers;
    /* too slow to be asked about */
    double speed = -body->velocity;
    body->height = 0.0;
    if (speed < body->rest_speed) {
        rest(body);
        return fmi3OK;
    }

    struct impact impact;
    fmi3Status status = ask(fmu, speed, &impact);
    if (status != fmi3OK)
        return status;

    /* A goes up, or stays */
    body->shared.last = impact;
    body->shared.impacts++;
    body->velocity = impact.gap_rate_after;
    body->energy_lost += 0.5 * body->mass * (speed * speed - body->velocity * body->velocity);
    if (body->velocity < body->rest_speed)
        rest(body);
    begin_flight(body);
    return fmi3OK;
}

static bool check_parameters(struct fmu *fmu)
{
    const struct falling_body *body = (const struct falling_body *)fmu->numbers;
    const struct {
        const char *name;
        double value;
        bool right;
        const char *allowed;
    } checks[] = {
        {"gravity", body->gravity, body->gravity > 0.0, "a number > 0"},
        {"rest_speed", body->rest_speed, body->rest_speed > 0.0, "a number > 0"},
        {"height", body->height, body->height >= 0.0, "a number >= 0"},
    };
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        if (checks[i].right)
            continue;
        fmu_error(fmu, "%s: %g: %s is needed", checks[i].name, checks[i].value, checks[i].allowed);
        return false;
    }
    return true;
}

static fmi3Status initialize(struct fmu *fmu)
{
    struct falling_body *body = (struct falling_body *)fmu->numbers;
    if (!check_parameters(fmu))
        return fmi3Error;

    /* the first touch, so that a question without an answer fails before anything moves */
    double speed = sqrt(body->velocity * body->velocity + 2.0 * body->gravity * body->height);
    struct percuss_request request;
    fmi3Status status = fmu_pair(fmu, fmax(speed, body->rest_speed), &request);
    if (status != fmi3OK)
        return status;
    body->mass = percuss_body_find(&fmu->source->bodies, body->shared.body_a)->mass;
    if (!isfinite(body->mass))
        return fmu_error(fmu, "body_a: '%s' cannot fall", body->shared.body_a);
    struct impact impact;
    status = ask(fmu, fmax(speed, body->rest_speed), &impact);
    if (status != fmi3OK)
        return status;

    if (body->height == 0.0 && speed < body->rest_speed)
        rest(body);
    begin_flight(body);
    return fmi3OK;
}

/* Goes back to the touch of a fall that has come below it, and says by how much, s: by the root of
 * h - v s - g s^2/2, and by the formula that loses no digits. 0: A was not above B. */
static double go_back_to_touch(struct falling_body *body)
{
    double g = body->gravity, v = body->velocity, h = body->height;
    double squared = v * v + 2.0 * g * h;
    if (h >= 0.0 || !(squared > 0.0))
        return 0.0;
    double late = 2.0 * h / (v - sqrt(squared));
    body->height = 0.0;
    body->velocity = v + g * late;
    return late;
}

/* An importer of fixed steps sees a touch at the end of its step, too low: the bounce is at the
 * touch all the same, and so are those that follow within the step. */
static fmi3Status bounce_late(struct fmu *fmu)
{
    struct falling_body *body = (struct falling_body *)fmu->numbers;
    double late = go_back_to_touch(body);
    fmi3Status status = bounce(fmu);
    while (status == fmi3OK && !body->resting && late > 0.0) {
        double flight = fmin(late, 2.0 * body->velocity / body->gravity);
        body->height = flight * (body->velocity - 0.5 * body->gravity * flight);
        body->velocity -= body->gravity * flight;
        if (flight == late)
            break;
        late -= flight;
        status = bounce(fmu);
    }
    return status;
}

static fmi3Status update(struct fmu *fmu, bool *states_changed)
{
    struct falling_body *body = (struct falling_body *)fmu->numbers;
    *states_changed = !body->resting && body->height <= TOUCH && body->velocity < 0.0;
    return *states_changed ? bounce_late(fmu) : fmi3OK;
}

/* Whether A is below the touch without its root having been found. */
static bool completed(void *numbers)
{
    const struct falling_body *body = numbers;
    return !body->resting && body->height < -TOUCH && body->velocity < 0.0;
}

/* The root of h + v t - g t^2/2, by the formula that loses no digits. */
static double time_to_touch(const struct falling_body *body)
{
    double g = body->gravity, v = body->flight_velocity, h = body->flight_height;
    double speed = sqrt(v * v + 2.0 * g * h);
    return v > 0.0 ? (v + speed) / g : h > 0.0 ? 2.0 * h / (speed - v) : 0.0;
}

/* Flights are closed forms from their beginning, so that no result depends on the steps. */
static fmi3Status step(struct fmu *fmu, double end, struct model_step *outcome)
{
    struct falling_body *body = (struct falling_body *)fmu->numbers;
    bool stops = fmu->event_mode_used && fmu->early_return_allowed;

    /* bounce by bounce, as long as the next touch is within the step */
    fmi3Status status = fmi3OK;
    while (status == fmi3OK && !body->resting) {
        double touch = body->flight_start + time_to_touch(body);
        if (!(touch <= end))
            break;
        body->shared.time = touch;
        body->velocity = -sqrt(body->flight_velocity * body->flight_velocity +
                               2.0 * body->gravity * body->flight_height);
        body->height = 0.0;
        if (stops) {
            *outcome = (struct model_step){.time = touch, .event = true};
            return fmi3OK;
        }
        status = bounce(fmu);
    }
    if (status != fmi3OK) {
        outcome->time = body->shared.time;
        return status;
    }

    /* the rest of the step is flight or rest */
    body->shared.time = outcome->time = end;
    if (!body->resting) {
        double t = end - body->flight_start;
        body->height = body->flight_height + t * (body->flight_velocity - 0.5 * body->gravity * t);
        body->velocity = body->flight_velocity - body->gravity * t;
    }
    return fmi3OK;
}

const struct model MODEL = {
    .identifier = "percuss_falling_body",
    .meaning = "A body falls on one that is held, and bounces until it rests",
    .token = "percuss falling body " PERCUSS_VERSION,
    .variables = VARIABLES,
    .variable_count = sizeof VARIABLES / sizeof *VARIABLES,
    .size = sizeof(struct falling_body),
    .initialize = initialize,
    .refresh = refresh,
    .update = update,
    .completed = completed,
    .step = step,
};
