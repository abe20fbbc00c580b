/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The impact law for a simulator that has the bodies: it reports a touch, and gets the impulse, by
 * which it changes their velocities. */
#include <math.h>
#include <string.h>

#include "fmu.h"

struct pose {
    double position[3], orientation[4], velocity[3], angular_velocity[3];
};

struct impact_law {
    struct shared shared;
    bool by_poses;
    double gap, gap_rate, gap_acceleration, inverse_effective_mass;
    struct pose a, b;
    double point[3], normal[3];
    double touch;
    double friction;
    double angular_a[3], angular_b[3]; /* N m s, of the last impact, about the centres of mass */
    double tangent[3];
    double tangential_mass[2], coupling[3]; /* 1/kg */
    /* not a variable: until the bodies have separated there is no other impact */
    int32_t waits;
};

#define LAW(role, type, member, unit, start, meaning)                                              \
    VARIABLE_##role, VARIABLE_##type, unit, offsetof(struct impact_law, member), start, NULL,      \
        meaning
#define LAW_INPUT(name, member, unit, start, meaning)                                              \
    {                                                                                              \
        name, LAW(INPUT, FLOAT64, member, unit, start, meaning)                                    \
    }
#define LAW_VECTOR(name, member, unit, meaning)                                                    \
    LAW_INPUT(name "[1]", member[0], unit, 0.0, meaning " (by_poses)"),                            \
        LAW_INPUT(name "[2]", member[1], unit, 0.0, meaning " (by_poses)"),                        \
        LAW_INPUT(name "[3]", member[2], unit, 0.0, meaning " (by_poses)")
#define LAW_RESULT(name, member, unit, meaning)                                                    \
    {name "[1]", LAW(DISCRETE, FLOAT64, member[0], unit, 0.0, meaning " (by_poses)")},             \
        {name "[2]", LAW(DISCRETE, FLOAT64, member[1], unit, 0.0, meaning " (by_poses)")},         \
    {                                                                                              \
        name "[3]", LAW(DISCRETE, FLOAT64, member[2], unit, 0.0, meaning " (by_poses)")            \
    }
#define LAW_POSE(body)                                                                             \
    LAW_VECTOR(#body ".position", body.position, "m", "centre of mass, world"),                    \
        LAW_INPUT(#body ".orientation[1]", body.orientation[0], NULL, 1.0,                         \
                  "unit quaternion (w, x, y, z), world = R(q) body (by_poses)"),                   \
        LAW_INPUT(#body ".orientation[2]", body.orientation[1], NULL, 0.0, "x (by_poses)"),        \
        LAW_INPUT(#body ".orientation[3]", body.orientation[2], NULL, 0.0, "y (by_poses)"),        \
        LAW_INPUT(#body ".orientation[4]", body.orientation[3], NULL, 0.0, "z (by_poses)"),        \
        LAW_VECTOR(#body ".velocity", body.velocity, "m/s", "of the centre of mass, world"),       \
        LAW_VECTOR(#body ".angular_velocity", body.angular_velocity, "rad/s", "world")

static const struct variable VARIABLES[] = {
    SHARED_VARIABLES("al-beam"),
    {"by_poses", LAW(PARAMETER, BOOLEAN, by_poses, NULL, 0.0,
                     "bodies are where the inputs a, b, point and normal say, not at their sites")},
    LAW_INPUT("gap", gap, "m", 1.0,
              "distance of the surfaces; an impact begins where it falls to 0"),
    LAW_INPUT("gap_rate", gap_rate, "m/s", 0.0, "its rate; negative: the bodies come together"),
    LAW_INPUT("gap_acceleration", gap_acceleration, "m/s2", 0.0, "negative presses"),
    LAW_INPUT("inverse_effective_mass", inverse_effective_mass, "1/kg", 0.0,
              "of the contact, as the simulator has it; 0: that of the catalogue's bodies"),
    LAW_POSE(a),
    LAW_POSE(b),
    LAW_VECTOR("point", point, "m", "of the contact, world"),
    LAW_VECTOR("normal", normal, NULL, "of the contact, unit, from B to A, world"),
    {"touch", LAW(INDICATOR, FLOAT64, touch, "m", 0.0, "the gap")},
    {"friction", LAW(PARAMETER, FLOAT64, friction, NULL, 0.0,
                     "coefficient; 0: the catalogue's for the two materials, if any (by_poses)")},
    LAW_RESULT("impulse_vector", shared.last.vector, "N.s",
               "of the last impact: on A at the point, against it on B, world"),
    LAW_RESULT("angular_impulse_a", angular_a, "N.m.s",
               "its moment on A about the centre of mass, world"),
    LAW_RESULT("angular_impulse_b", angular_b, "N.m.s", "the same on B"),
    {"friction_loss",
     LAW(DISCRETE, FLOAT64, shared.last.friction_loss, "J", 0.0, "by sliding in the last impact")},
    LAW_VECTOR("tangent", tangent, NULL,
               "first one of the contact, world; zero: the axis least parallel to the normal; the "
               "second is normal x first"),
    LAW_INPUT("inverse_mass_tangential[1]", tangential_mass[0], "1/kg", 0.0,
              "of the contact along the first tangent, beside inverse_effective_mass: friction of "
              "bodies in joints; both 0: no friction (by_poses)"),
    LAW_INPUT("inverse_mass_tangential[2]", tangential_mass[1], "1/kg", 0.0,
              "along the second one (by_poses)"),
    LAW_INPUT(
        "inverse_mass_coupling[1]", coupling[0], "1/kg", 0.0,
        "of the normal and the first tangent: velocity along one by an impulse of 1 N.s along "
        "the other (by_poses)"),
    LAW_INPUT("inverse_mass_coupling[2]", coupling[1], "1/kg", 0.0,
              "of the normal and the second tangent (by_poses)"),
    LAW_INPUT("inverse_mass_coupling[3]", coupling[2], "1/kg", 0.0, "of both tangents (by_poses)"),
};

/* m; so far from zero an importer's root of the indicator may be */
static const double TOUCH = 1e-9;

static void refresh(void *numbers)
{
    struct impact_law *law = numbers;
    law->touch = law->gap;
}

/* Of the point of the contact, as one of the body. */
static void point_velocity(const struct pose *pose, const double point[3], double velocity[3])
{
    const double *w = pose->angular_velocity;
    double r[3];
    for (int i = 0; i < 3; i++)
        r[i] = point[i] - pose->position[i];
    for (int i = 0; i < 3; i++)
        velocity[i] =
            pose->velocity[i] + w[(i + 1) % 3] * r[(i + 2) % 3] - w[(i + 2) % 3] * r[(i + 1) % 3];
}

/* Of the poses, or the input. */
static double current_gap_rate(const struct impact_law *law)
{
    if (!law->by_poses)
        return law->gap_rate;
    double of_a[3], of_b[3], rate = 0.0;
    point_velocity(&law->a, law->point, of_a);
    point_velocity(&law->b, law->point, of_b);
    for (int i = 0; i < 3; i++)
        rate += law->normal[i] * (of_a[i] - of_b[i]);
    return rate;
}

static bool add_body(struct percuss_request *request, const char *id, const struct pose *pose)
{
    struct percuss_body_motion *body = percuss_request_add_body(request, id);
    if (!body)
        return false;
    memcpy(body->position, pose->position, sizeof body->position);
    memcpy(body->orientation, pose->orientation, sizeof body->orientation);
    memcpy(body->velocity, pose->velocity, sizeof body->velocity);
    memcpy(body->angular_velocity, pose->angular_velocity, sizeof body->angular_velocity);
    return true;
}

static fmi3Status request_by_poses(struct fmu *fmu, struct percuss_request *request)
{
    const struct impact_law *law = (const struct impact_law *)fmu->numbers;
    percuss_request_init(request);
    if (!add_body(request, law->shared.body_a, &law->a) ||
        !add_body(request, law->shared.body_b, &law->b))
        return fmu_error(fmu, "body_a, body_b: an id has up to %d bytes", PERCUSS_ID_SIZE - 1);
    struct percuss_contact *contact = percuss_request_add_contact(request, 0, 1);
    memcpy(contact->point, law->point, sizeof contact->point);
    memcpy(contact->normal, law->normal, sizeof contact->normal);
    request->options.tolerance = law->shared.tolerance;
    memcpy(contact->tangent, law->tangent, sizeof contact->tangent);
    contact->friction = law->friction;
    return fmi3OK;
}

/* Whether the simulator states its inverse masses along the surface. */
static bool states_tangents(const struct impact_law *law)
{
    return law->by_poses && (law->tangential_mass[0] != 0.0 || law->tangential_mass[1] != 0.0);
}

/* The simulator's own inverse masses; without those of the tangents there is no friction. */
static void state_masses(const struct impact_law *law, double matrix[9],
                         struct percuss_request *request)
{
    const double *along = law->tangential_mass, *w = law->coupling;
    const double all[9] = {
        law->inverse_effective_mass, w[0], w[1], w[0], along[0], w[2], w[1], w[2], along[1]};
    memcpy(matrix, all, sizeof all);
    request->delassus = matrix;
    request->delassus_rows = states_tangents(law) ? 3 : 1;
    if (!states_tangents(law))
        request->options.friction = PERCUSS_FRICTION_NONE;
}

/* The moment about the body's centre of mass of `sign` times an impulse at the point. */
static void take_moment(const double point[3], const struct pose *pose, double sign,
                        const double impulse[3], double moment[3])
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        moment[i] = sign * ((point[j] - pose->position[j]) * impulse[k] -
                            (point[k] - pose->position[k]) * impulse[j]);
    }
}

/* Friction needs more of the simulator's own inverse masses than the normal's. */
static fmi3Status check_friction(struct fmu *fmu)
{
    const struct impact_law *law = (const struct impact_law *)fmu->numbers;
    if (law->friction == 0.0)
        return fmi3OK;
    if (!law->by_poses)
        return fmu_error(fmu, "friction: %g: only 0 is allowed without by_poses", law->friction);
    if (law->inverse_effective_mass != 0.0 && !states_tangents(law))
        return fmu_error(fmu,
                         "friction: %g: only 0 is allowed with inverse_effective_mass and without "
                         "inverse_mass_tangential",
                         law->friction);
    return fmi3OK;
}

static bool touches(const struct impact_law *law)
{
    return !law->waits && law->gap <= TOUCH && current_gap_rate(law) < 0.0;
}

/* Once the bodies have separated, another impact may begin. */
static void rearm(struct impact_law *law)
{
    if (law->gap > TOUCH || current_gap_rate(law) >= 0.0)
        law->waits = 0;
}

static bool completed(void *numbers)
{
    rearm(numbers);
    return false;
}

/* Answers an impact that has begun. */
static fmi3Status answer(struct fmu *fmu)
{
    struct impact_law *law = (struct impact_law *)fmu->numbers;
    double gap_rate = current_gap_rate(law);
    rearm(law);
    if (!touches(law))
        return fmi3OK;

    /* the bodies as the importer has them */
    struct percuss_request request;
    fmi3Status status = check_friction(fmu);
    if (status != fmi3OK)
        return status;
    status = law->by_poses ? request_by_poses(fmu, &request) : fmu_pair(fmu, -gap_rate, &request);
    if (status != fmi3OK)
        return status;
    request.contacts[0].gap_acceleration = law->gap_acceleration;
    if (law->inverse_effective_mass < 0.0)
        return fmu_error(fmu, "inverse_effective_mass: %g: a number > 0 is needed, or 0",
                         law->inverse_effective_mass);
    double matrix[9];
    if (law->inverse_effective_mass != 0.0)
        state_masses(law, matrix, &request);
    else if (states_tangents(law))
        return fmu_error(fmu,
                         "inverse_mass_tangential: %g, %g: inverse_effective_mass is needed too",
                         law->tangential_mass[0], law->tangential_mass[1]);

    /* the outputs keep the last impact that was answered */
    struct impact impact;
    status = fmu_ask(fmu, &request, gap_rate, &impact);
    if (status != fmi3OK)
        return status;
    /* a pair at its sites lies somewhere in space */
    if (!law->by_poses)
        memset(impact.vector, 0, sizeof impact.vector);
    law->shared.last = impact;
    law->shared.impacts++;
    law->waits = 1;
    take_moment(law->point, &law->a, 1.0, impact.vector, law->angular_a);
    take_moment(law->point, &law->b, -1.0, impact.vector, law->angular_b);
    return fmi3OK;
}

/* A question without an answer fails before anything moves. */
static fmi3Status initialize(struct fmu *fmu)
{
    const struct impact_law *law = (const struct impact_law *)fmu->numbers;
    struct percuss_request request;
    fmi3Status status = check_friction(fmu);
    if (status != fmi3OK)
        return status;
    if (!law->by_poses)
        return fmu_pair(fmu, 1.0, &request);
    const struct percuss_body *bodies[2];
    char message[SOURCE_MESSAGE_SIZE];
    return source_find(fmu->source, &law->shared, bodies, message) ? fmi3OK
                                                                   : fmu_error(fmu, "%s", message);
}

static fmi3Status update(struct fmu *fmu, bool *states_changed)
{
    *states_changed = false;
    return answer(fmu);
}

/* Inputs are constant in a step: an impact that has begun is answered in it, or in event mode. */
static fmi3Status step(struct fmu *fmu, double end, struct model_step *outcome)
{
    struct impact_law *law = (struct impact_law *)fmu->numbers;
    rearm(law);
    outcome->event = fmu->event_mode_used && touches(law);
    fmi3Status status = fmu->event_mode_used ? fmi3OK : answer(fmu);
    if (status == fmi3OK)
        law->shared.time = outcome->time = end;
    return status;
}

const struct model MODEL = {
    .identifier = "percuss_impact_law",
    .meaning = "What an impact of two bodies does",
    .token = "percuss impact law " PERCUSS_VERSION,
    .variables = VARIABLES,
    .variable_count = sizeof VARIABLES / sizeof *VARIABLES,
    .size = sizeof(struct impact_law),
    .initialize = initialize,
    .refresh = refresh,
    .update = update,
    .completed = completed,
    .step = step,
};
