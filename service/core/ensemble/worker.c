/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "ensemble/worker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ensemble/spec.h"
#include "model/vector.h"

/* The impact with its uncertain numbers replaced. */

/* One worker's. */
struct variation {
    const struct ensemble_spec *spec;
    struct solve_request request;
    struct body_set set; /* the bodies of the impact, changed ones included */
    double gap_rate;     /* of the contact as stated, m/s */
};

static void variation_release(struct variation *variation)
{
    free(variation->set.bodies);
    variation->set.bodies = NULL;
}

/* The bodies of the request, each once. */
static bool copy_bodies(struct variation *variation)
{
    const struct ensemble_spec *spec = variation->spec;
    struct body_set *set = &variation->set;
    *set = *spec->catalogue;
    set->count = 0;
    set->bodies = calloc(spec->request->body_count, sizeof *set->bodies);
    for (size_t i = 0; set->bodies && i < spec->request->body_count; i++) {
        const char *id = spec->request->bodies[i].id;
        const struct body *body = body_set_find(spec->catalogue, id);
        if (body && !body_set_find(set, id))
            set->bodies[set->count++] = *body;
    }
    return set->bodies != NULL;
}

static double gap_rate_of(const struct solve_request *request, size_t contact)
{
    double relative[3];
    solve_contact_velocity(request, contact, relative);
    return dot3(request->contacts[contact].normal, relative);
}

static bool is_beam(const struct body *body)
{
    return body->second_moment[0] > 0.0;
}

/* Whether the (only) contact is on the side of this body, not on its end: x is along its axis. */
static bool is_on_side(const struct solve_request *request, size_t body)
{
    double rotation[9], normal[3];
    rotation_matrix(request->bodies[body].orientation, rotation);
    rotate_back3(rotation, request->contacts[0].normal, normal);
    return fabs(normal[0]) < 0.5;
}

static enum percuss_status check_site(const struct variation *variation, size_t index,
                                      struct fault *fault)
{
    const struct ensemble_spec *spec = variation->spec;
    const struct ensemble_input *input = &spec->inputs[index];
    const char *id = spec->request->bodies[input->body].id;
    const struct body *body = body_set_find(spec->catalogue, id);
    const struct solve_contact *contact = &spec->request->contacts[0];
    bool touches = contact->a == input->body || contact->b == input->body;
    if (touches && is_beam(body) && is_on_side(spec->request, input->body))
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "inputs[%zu].body: %s: must be a beam that is hit on its side for the "
                     "quantity site",
                     index, id);
}

static enum percuss_status check_radius(const struct variation *variation, size_t index,
                                        struct fault *fault)
{
    const struct ensemble_spec *spec = variation->spec;
    const char *id = spec->request->bodies[spec->inputs[index].body].id;
    if (body_set_find(spec->catalogue, id)->radius > 0.0)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "inputs[%zu].body: %s: must be a body with a radius for the quantity radius",
                     index, id);
}

static enum percuss_status check_damping(const struct variation *variation, size_t index,
                                         struct fault *fault)
{
    const struct ensemble_spec *spec = variation->spec;
    const char *id = spec->request->bodies[spec->inputs[index].body].id;
    if (body_can_vibrate(body_set_find(spec->catalogue, id)))
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "inputs[%zu].body: %s: must be a body that vibrates for the quantity damping",
                     index, id);
}

static enum percuss_status check_scale(const struct variation *variation, size_t index,
                                       struct fault *fault)
{
    const struct ensemble_spec *spec = variation->spec;
    const char *id = spec->request->bodies[spec->inputs[index].body].id;
    if (body_set_find(spec->catalogue, id)->mesh)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BAD_REQUEST,
                     "inputs[%zu].body: %s: must be a mesh for the quantity scale", index, id);
}

/* PERCUSS_OK, INTERNAL without memory, or BAD_REQUEST for an input that this impact cannot have. */
static enum percuss_status variation_create(struct variation *variation,
                                            const struct ensemble_spec *spec, struct fault *fault)
{
    /* bodies to change */
    *variation = (struct variation){.spec = spec, .request = *spec->request};
    if (!copy_bodies(variation))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* the impact must suit each input */
    variation->gap_rate = gap_rate_of(spec->request, spec->contact);
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && i < spec->input_count; i++) {
        enum input_quantity quantity = spec->inputs[i].quantity;
        if (quantity == INPUT_SITE)
            status = check_site(variation, i, fault);
        else if (quantity == INPUT_RADIUS)
            status = check_radius(variation, i, fault);
        else if (quantity == INPUT_DAMPING)
            status = check_damping(variation, i, fault);
        else if (quantity == INPUT_SCALE)
            status = check_scale(variation, i, fault);
        else if (quantity == INPUT_SPEED && !(variation->gap_rate < 0.0))
            status = fault_set(fault, PERCUSS_BAD_REQUEST,
                               "inputs[%zu].name: speed: contacts[%zu] must approach (its gap rate "
                               "is %+g m/s): all velocities are scaled",
                               i, spec->contact, variation->gap_rate);
    }
    if (status)
        variation_release(variation);
    return status;
}

static void move(double position[3], const double along[3], double distance)
{
    for (int i = 0; i < 3; i++)
        position[i] += distance * along[i];
}

/* A body with another radius there is moved along the normal, so that it still touches. */
static void keep_touching(struct variation *variation, const char *id, double growth)
{
    struct solve_request *request = &variation->request;
    const struct solve_contact *contact = &request->contacts[0];
    const struct body *body = body_set_find(&variation->set, id);
    for (int side = 0; side < 2; side++) {
        size_t index = side == 0 ? contact->a : contact->b;
        bool round =
            body_solid(body).form == SOLID_BALL || (is_beam(body) && is_on_side(request, index));
        if (round && strcmp(request->bodies[index].id, id) == 0)
            move(request->bodies[index].position, contact->normal, side == 0 ? growth : -growth);
    }
}

/* A body that grows about its centre of mass is moved so that the contact point stays. */
static void keep_place(struct variation *variation, const char *id, double growth)
{
    struct solve_request *request = &variation->request;
    const struct solve_contact *contact = &request->contacts[0];
    for (int side = 0; side < 2; side++) {
        struct solve_body *body = &request->bodies[side == 0 ? contact->a : contact->b];
        double arm[3];
        sub3(contact->point, body->position, arm);
        if (strcmp(body->id, id) == 0)
            move(body->position, arm, -growth);
    }
}

static void change_body(struct variation *variation, const struct ensemble_input *input,
                        double value)
{
    /* the ensemble's own copy of it */
    const char *id = variation->spec->request->bodies[input->body].id;
    struct body *body = NULL;
    for (size_t i = 0; i < variation->set.count; i++)
        if (strcmp(variation->set.bodies[i].id, id) == 0)
            body = &variation->set.bodies[i];
    /* the property, and with another radius the place in which it still touches */
    switch (input->quantity) {
    case INPUT_YOUNG:
        body->material.young = value;
        break;
    case INPUT_POISSON:
        body->material.poisson = value;
        break;
    case INPUT_DENSITY:
        body->material.density = value;
        break;
    case INPUT_YIELD:
        body->material.yield = value;
        break;
    case INPUT_DAMPING:
        body->damping = value;
        break;
    case INPUT_RADIUS:
        keep_touching(variation, id, value - body_set_find(variation->spec->catalogue, id)->radius);
        body->radius = value;
        break;
    case INPUT_SCALE:
        keep_place(variation, id, value / body->scale - 1.0);
        body->scale = value;
        break;
    default:
        break;
    }
}

/* Moves the contact and the other body along the beam. */
static void change_site(struct variation *variation, const struct ensemble_input *input,
                        double fraction)
{
    struct solve_request *request = &variation->request;
    struct solve_contact *contact = &request->contacts[0];
    size_t other = contact->a == input->body ? contact->b : contact->a;
    const struct solve_body *beam = &request->bodies[input->body];
    double rotation[9], from_centre[3], local[3];
    rotation_matrix(beam->orientation, rotation);
    sub3(contact->point, beam->position, from_centre);
    rotate_back3(rotation, from_centre, local);
    double length = body_set_find(&variation->set, beam->id)->length;
    double axis[3] = {rotation[0], rotation[3], rotation[6]};
    double distance = (fraction - 0.5) * length - local[0];
    move(contact->point, axis, distance);
    move(request->bodies[other].position, axis, distance);
}

static void scale_velocities(struct solve_request *request, double factor)
{
    for (size_t b = 0; b < request->body_count; b++)
        for (int i = 0; i < 3; i++) {
            request->bodies[b].velocity[i] *= factor;
            request->bodies[b].angular_velocity[i] *= factor;
        }
}

/* Turns all velocities by an angle about a tangent of the contact (Rodrigues). */
static void turn_velocities(struct variation *variation, double angle)
{
    struct solve_request *request = &variation->request;
    const double *n = request->contacts[variation->spec->contact].normal;
    double other[3] = {0.0, 0.0, 0.0}, axis[3];
    other[fabs(n[0]) < 0.5 ? 0 : 1] = 1.0;
    cross3(n, other, axis);
    double length = sqrt(dot3(axis, axis));
    for (int i = 0; i < 3; i++)
        axis[i] /= length;
    for (size_t b = 0; b < request->body_count; b++) {
        double *v = request->bodies[b].velocity, across[3];
        double along = dot3(axis, v) * (1.0 - cos(angle));
        cross3(axis, v, across);
        for (int i = 0; i < 3; i++)
            v[i] = v[i] * cos(angle) + across[i] * sin(angle) + axis[i] * along;
    }
}

/* Back to the request's values. */
static void restore(struct variation *variation)
{
    const struct ensemble_spec *spec = variation->spec;
    struct solve_request *request = &variation->request;
    memcpy(request->bodies, spec->request->bodies, request->body_count * sizeof *request->bodies);
    memcpy(request->contacts, spec->request->contacts,
           request->contact_count * sizeof *request->contacts);
    for (size_t i = 0; spec_changes_bodies(spec) && i < variation->set.count; i++)
        variation->set.bodies[i] = *body_set_find(spec->catalogue, variation->set.bodies[i].id);
}

static enum percuss_status complete_bodies(struct variation *variation, struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    for (size_t i = 0; !status && i < variation->set.count; i++)
        status = body_complete(&variation->set.bodies[i], fault);
    return status;
}

/* Puts one value an input in place: variation->request and ->set. BAD_REQUEST: such a body cannot
 * exist. */
static enum percuss_status variation_apply(struct variation *variation, const double *values,
                                           struct fault *fault)
{
    const struct ensemble_spec *spec = variation->spec;
    restore(variation);
    /* bodies before places, and the speed before it is turned, in any order of the inputs */
    for (int quantity = INPUT_QUANTITY_COUNT - 1; quantity > INPUT_SITE; quantity--)
        for (size_t i = 0; i < spec->input_count; i++)
            if (spec->inputs[i].quantity == (enum input_quantity)quantity)
                change_body(variation, &spec->inputs[i], values[i]);
    /* the place of the impact, and its velocity */
    double angle = 0.0;
    for (size_t i = 0; i < spec->input_count; i++) {
        if (spec->inputs[i].quantity == INPUT_SITE)
            change_site(variation, &spec->inputs[i], values[i]);
        else if (spec->inputs[i].quantity == INPUT_SPEED)
            scale_velocities(&variation->request, values[i] / -variation->gap_rate);
        else if (spec->inputs[i].quantity == INPUT_DIRECTION)
            angle = values[i];
        else if (spec->inputs[i].quantity == INPUT_FRICTION)
            variation->request.friction = (struct solve_friction){true, spec->contact, values[i]};
        else if (input_is_of_model(spec->inputs[i].quantity))
            variation->request
                .model_shift[spec->inputs[i].quantity - INPUT_MODEL_FORCE + SOLVE_SHIFT_FORCE] =
                values[i];
    }
    if (angle != 0.0)
        turn_velocities(variation, angle);
    return spec_changes_bodies(spec) ? complete_bodies(variation, fault) : PERCUSS_OK;
}

/* Whether the inputs change a body of the set, but for its yield stress, so that nothing prepared
 * of it (modes, compliance) holds for other values. */
static bool variation_changes_body(const struct variation *variation, const struct body *body)
{
    const struct ensemble_spec *spec = variation->spec;
    bool changes = false;
    for (size_t i = 0; i < spec->input_count; i++) {
        const struct ensemble_input *input = &spec->inputs[i];
        bool matters = input_is_of_body(input->quantity) && input->quantity != INPUT_SITE &&
                       input->quantity != INPUT_YIELD;
        changes =
            changes || (matters && strcmp(spec->request->bodies[input->body].id, body->id) == 0);
    }
    return changes;
}

struct ensemble_worker {
    const struct ensemble *ensemble;
    struct repeat *repeat;
    struct variation variation;
    struct solve_context means; /* with the variation's bodies for a catalogue */
};

enum percuss_status ensemble_worker_create(struct ensemble_worker **worker,
                                           const struct ensemble *ensemble,
                                           const struct watch *watch, struct fault *fault)
{
    *worker = calloc(1, sizeof **worker);
    if (!*worker)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* bodies to vary, and their solver */
    (*worker)->ensemble = ensemble;
    enum percuss_status status = variation_create(&(*worker)->variation, &ensemble->spec, fault);
    (*worker)->repeat = status ? NULL : repeat_create();
    if (!status && !(*worker)->repeat)
        status = fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    (*worker)->means = (struct solve_context){&(*worker)->variation.set, ensemble->spec.tables,
                                              watch ? *watch : (struct watch){0}};
    /* nothing on failure */
    if (status) {
        ensemble_worker_free(*worker);
        *worker = NULL;
    }
    return status;
}

void ensemble_worker_free(struct ensemble_worker *worker)
{
    if (!worker)
        return;
    variation_release(&worker->variation);
    repeat_free(worker->repeat);
    free(worker);
}

const struct ensemble *worker_ensemble(const struct ensemble_worker *worker)
{
    return worker->ensemble;
}

/* Puts the values in place. */
static enum percuss_status apply(struct ensemble_worker *worker, const double *values,
                                 struct fault *fault)
{
    struct variation *variation = &worker->variation;
    enum percuss_status status = variation_apply(variation, values, fault);
    for (size_t i = 0; !status && i < variation->set.count; i++)
        if (variation_changes_body(variation, &variation->set.bodies[i])) {
            variation->set.bodies[i].varied = true;
            repeat_forget(worker->repeat);
        }
    return status;
}

enum percuss_status worker_solve(struct ensemble_worker *worker, const double *values,
                                 struct repeat_outcome *outcome, struct fault *fault)
{
    const struct ensemble *ensemble = worker->ensemble;
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    outcome->status = apply(worker, values, fault);
    if (outcome->status)
        return outcome->status;
    return repeat_solve(worker->repeat, &worker->means, &worker->variation.request,
                        ensemble->spec.contact, &ensemble->model.model, ensemble->same_scene,
                        outcome, fault);
}

enum percuss_status worker_search(struct ensemble_worker *worker, const double *values,
                                  struct solution_model *model, struct repeat_outcome *outcome,
                                  struct fault *fault)
{
    *outcome = (struct repeat_outcome){.restitution = NAN, .error = NAN};
    outcome->status = apply(worker, values, fault);
    if (outcome->status)
        return outcome->status;
    return repeat_search(worker->repeat, &worker->means, &worker->variation.request,
                         worker->ensemble->spec.contact, model, outcome, fault);
}

/* Along a tangent without slip rounding leaves a trace, which is no scatter. */
static double tangential_of(const struct repeat_outcome *outcome, bool good, int tangent)
{
    static const double ROUNDING = 1e-12;
    double impulse = outcome->tangential[tangent];
    if (!good)
        return NAN;
    return fabs(impulse) > ROUNDING * outcome->impulse ? impulse : 0.0;
}

void ensemble_solve(struct ensemble_worker *worker, uint64_t index, struct ensemble_sample *sample,
                    struct fault *fault)
{
    /* the sample's inputs, solved */
    double values[ENSEMBLE_MAX_INPUTS];
    struct repeat_outcome outcome;
    ensemble_inputs(worker->ensemble, index, values);
    enum percuss_status status = worker_solve(worker, values, &outcome, fault);
    bool good = ensemble_has_result(status);
    /* summary of the outcome; NAN where refused */
    *sample = (struct ensemble_sample){
        .restitution = good ? outcome.restitution : NAN,
        .impulse = good ? outcome.impulse : NAN,
        .end_time = good ? outcome.end_time : NAN,
        .peak_force = good ? outcome.peak_force : NAN,
        .compression = good ? outcome.compression : NAN,
        .tangential = {tangential_of(&outcome, good, 0), tangential_of(&outcome, good, 1)},
        .tangential_restitution = good ? outcome.tangential_restitution : NAN,
        .restitution_kinematic = good ? outcome.restitution_kinematic : NAN,
        .sub_impacts =
            (uint16_t)(outcome.sub_impacts < UINT16_MAX ? outcome.sub_impacts : UINT16_MAX),
        .significant = (uint16_t)outcome.significant,
        .warnings = good ? outcome.warnings : 0,
        .status = (uint32_t)status,
        .contact_model = (uint32_t)outcome.contact_model,
    };
}

const struct warnings *ensemble_warnings(const struct ensemble_worker *worker)
{
    return repeat_warnings(worker->repeat);
}
