/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "unit/slowscale/toy.h"

double toy_momentum(const struct percuss_body_motion *bodies,
                    const struct percuss_slow_inertia *inertias, size_t count,
                    const double about[3])
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        const struct percuss_body_motion *body = &bodies[i];
        double w = body->orientation[0], n = 0.0, p[3], arm[3], turned[3], spin[3];
        const double *u = body->orientation + 1, *o = body->angular_velocity;
        for (int k = 0; k < 4; k++)
            n += body->orientation[k] * body->orientation[k];
        for (int k = 0; k < 3; k++) {
            p[k] = inertias[i].mass * body->velocity[k];
            arm[k] = body->position[k] - about[k];
        }
        /* omega into the body by the conjugate quaternion, moments there, and back */
        double local[3], twice[3];
        for (int pass = 0; pass < 2; pass++) {
            const double *from = pass ? local : o;
            double sign = pass ? 1.0 : -1.0;
            for (int k = 0; k < 3; k++) {
                int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
                twice[k] = 2.0 * sign * (u[k1] * from[k2] - u[k2] * from[k1]) / n;
            }
            for (int k = 0; k < 3; k++) {
                int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
                turned[k] = from[k] + w * twice[k] + sign * (u[k1] * twice[k2] - u[k2] * twice[k1]);
            }
            for (int k = 0; k < 3; k++) {
                local[k] = turned[k] * (pass ? 1.0 : inertias[i].moments[k]);
                spin[k] = turned[k];
            }
        }
        for (int k = 0; k < 3; k++) {
            int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
            sum += (k + 1) * p[k] + (k + 7) * (arm[k1] * p[k2] - arm[k2] * p[k1] + spin[k]);
        }
    }
    return sum;
}

size_t toy_contacts(struct toy *toy, struct percuss_slow_contact *contacts)
{
    bool flipped = toy->flips && toy->looks++ % 2;
    size_t n = 0;
    for (uint32_t i = 0; i + 1 < toy->count; i++) {
        double apart = toy->bodies[i + 1].position[0] - toy->bodies[i].position[0];
        contacts[n++] =
            (struct percuss_slow_contact){.a = i + 1,
                                          .b = i,
                                          .point = {toy->bodies[i].position[0] + 0.5 * apart},
                                          .normal = {1.0},
                                          .feature = i,
                                          .gap = apart - 2.0 * toy->radius,
                                          .friction = toy->friction};
        contacts[n - 1].normal[0] = cos(toy->tilt);
        contacts[n - 1].normal[2] = sin(toy->tilt);
        memcpy(contacts[n - 1].tangent, toy->tangent, sizeof toy->tangent);
        if (flipped) {
            contacts[n - 1].a = i;
            contacts[n - 1].b = i + 1;
            contacts[n - 1].normal[0] *= -1.0;
            contacts[n - 1].normal[2] *= -1.0;
        }
    }
    return n;
}

bool toy_probe(void *context, struct percuss_slow_view *view)
{
    struct toy *toy = context;
    percuss_slow_gap_rates(toy->bodies, view->count, view->contacts, view->gap_rate);
    if (view->delassus)
        percuss_slow_free_delassus(toy->bodies, toy->inertias, view->count, view->contacts,
                                   view->delassus);
    for (size_t i = 0; view->bodies && i < toy->count; i++) {
        memcpy(view->bodies[i].position, toy->bodies[i].position, sizeof(double[3]));
        memcpy(view->bodies[i].velocity, toy->bodies[i].velocity, sizeof(double[3]));
    }
    return true;
}

bool toy_oblique(void *context, size_t count, const struct percuss_slow_contact *contacts,
                 double *delassus)
{
    struct toy *toy = context;
    percuss_slow_free_oblique(toy->bodies, toy->inertias, count, contacts, delassus);
    return true;
}

bool toy_apply(void *context, const struct percuss_slow_contact *contact, double impulse)
{
    struct toy *toy = context;
    percuss_slow_free_apply(toy->bodies, toy->inertias, contact, impulse);
    toy->applied[contact->feature] += impulse;
    return true;
}

bool toy_apply_vector(void *context, const struct percuss_slow_contact *contact,
                      const double impulse[3])
{
    struct toy *toy = context;
    percuss_slow_free_apply_vector(toy->bodies, toy->inertias, contact, impulse);
    return true;
}

/* Free spheres by the textbook: m dv = P, I dw = r x P, with the moments of a sphere. */
bool toy_push(void *context, uint32_t body, const double impulse[3], const double point[3])
{
    struct toy *toy = context;
    struct percuss_body_motion *motion = &toy->bodies[body];
    const struct percuss_slow_inertia *inertia = &toy->inertias[body];
    for (int k = 0; k < 3; k++) {
        int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        motion->velocity[k] += impulse[k] / inertia->mass;
        motion->angular_velocity[k] += ((point[k1] - motion->position[k1]) * impulse[k2] -
                                        (point[k2] - motion->position[k2]) * impulse[k1]) /
                                       inertia->moments[k];
    }
    return true;
}

bool toy_shift(void *context, const struct percuss_slow_contact *contact, double moment)
{
    struct toy *toy = context;
    percuss_slow_free_move(toy->bodies, toy->inertias, contact, moment);
    return true;
}

bool toy_shift_vector(void *context, const struct percuss_slow_contact *contact,
                      const double moment[3])
{
    struct toy *toy = context;
    percuss_slow_free_move_vector(toy->bodies, toy->inertias, contact, moment);
    return true;
}

double toy_now(void *context)
{
    return ((struct toy *)context)->time;
}

static void toy_release(struct percuss_reply *reply)
{
    for (size_t i = 0; i < reply->contact_count; i++)
        free(reply->contacts[i].sub_impacts);
    free(reply->contacts);
    free(reply->states_after);
    *reply = (struct percuss_reply){0};
}

static void toy_fill(const struct toy_answer *answer, const struct percuss_request *request,
                     size_t number, struct percuss_reply *reply)
{
    reply->contact_count = request->contact_count;
    reply->contacts = calloc(request->contact_count, sizeof *reply->contacts);
    reply->states_after = calloc(request->body_count, sizeof *reply->states_after);
    reply->states_after_count = request->body_count;
    reply->window = answer->window;
    if (answer->revision)
        snprintf(reply->catalogue_revision, sizeof reply->catalogue_revision, "%s",
                 answer->revision);
    reply->complete = !answer->truncated;
    reply->end_reason = answer->spent       ? PERCUSS_END_LIMIT
                        : answer->truncated ? PERCUSS_END_HORIZON
                                            : PERCUSS_END_SEPARATED;
    for (size_t i = 0; i < request->body_count; i++)
        snprintf(reply->states_after[i].state, PERCUSS_ID_SIZE, "token-%zu-%zu", number, i);
    for (size_t i = 0; i < request->contact_count; i++) {
        struct percuss_contact_result *contact = &reply->contacts[i];
        contact->sub_impact_count = contact->sub_impacts_listed = answer->count[i];
        contact->inverse_effective_mass = answer->inverse_mass > 0.0 ? answer->inverse_mass : 20.0;
        contact->friction = answer->friction;
        contact->tangent[1] = answer->friction > 0.0 ? 1.0 : 0.0;
        contact->sub_impacts = calloc(TOY_SUBS, sizeof *contact->sub_impacts);
        memcpy(contact->sub_impacts, answer->subs[i], sizeof answer->subs[i]);
        for (uint32_t j = 0; j < answer->count[i]; j++) {
            contact->impulse += answer->subs[i][j].impulse;
            for (int k = 0; k < 2; k++)
                contact->impulse_tangential[k] += answer->subs[i][j].impulse_tangential[k];
            contact->end_time = answer->subs[i][j].end;
            contact->sub_impacts[j].compression_impulse = 0.5 * answer->subs[i][j].impulse;
        }
    }
}

static enum percuss_result toy_solve(void *context, const struct percuss_request *request,
                                     struct percuss_reply *reply)
{
    struct toy *toy = context;
    size_t number = toy->asked++;
    if (number >= toy->answers)
        fail_msg("question %zu was not expected", number);
    toy->question[number] = *request;
    size_t rows = request->delassus_rows ? request->delassus_rows : request->contact_count;
    if (request->delassus)
        memcpy(toy->matrix[number], request->delassus, rows * rows * sizeof(double));
    const struct toy_answer *answer = &toy->answer[number];
    reply->status = answer->truncated ? PERCUSS_TRUNCATED : answer->status;
    if (!answer->result && !answer->status)
        toy_fill(answer, request, number, reply);
    return answer->result;
}

static void toy_report(void *context, const struct percuss_slow_report *report)
{
    struct toy *toy = context;
    toy->reports++;
    toy->service_used = report->reply != NULL;
    toy->declared = report->declared;
    for (size_t i = 0; i < report->count; i++) {
        toy->impulse[report->contacts[i].feature] = report->impulse[i];
        toy->restitution[report->contacts[i].feature] = report->restitution[i];
    }
    snprintf(toy->message, sizeof toy->message, "%s", report->message);
}

struct toy *toy_create(size_t count, const struct percuss_slow_config *wishes)
{
    static const struct percuss_slow_body names[TOY_BODIES] = {
        {.id = "s0"}, {.id = "s1"}, {.id = "s2"}, {.id = "s3"}};
    struct toy *toy = calloc(1, sizeof *toy);
    assert_non_null(toy);
    toy->count = count;
    toy->radius = 0.01;
    for (size_t i = 0; i < count; i++) {
        toy->bodies[i].orientation[0] = 1.0;
        toy->bodies[i].position[0] = 0.02 * (double)i;
        toy->inertias[i] = (struct percuss_slow_inertia){0.1, {4e-6, 4e-6, 4e-6}};
    }
    toy->bodies[0].velocity[0] = 0.2;
    struct percuss_slow_config config = *wishes;
    config.body_count = count;
    config.bodies = wishes->bodies ? wishes->bodies : names;
    const struct percuss_slow_engine *wish = &wishes->engine;
    config.engine = (struct percuss_slow_engine){.context = toy,
                                                 .probe = toy_probe,
                                                 .apply = wish->push ? NULL : toy_apply,
                                                 .now = toy_now,
                                                 .push = wish->push,
                                                 .apply_vector = wish->apply_vector,
                                                 .oblique = wish->oblique};
    config.report = toy_report;
    config.report_context = toy;
    if (config.service.solve)
        config.service = (struct percuss_slow_service){toy, toy_solve, toy_release, NULL};
    assert_int_equal(percuss_slow_create(&config, &toy->slow), PERCUSS_RESULT_OK);
    return toy;
}

struct percuss_slow_config toy_wishes(void)
{
    struct percuss_slow_config config = percuss_slow_config_default();
    config.service.solve = toy_solve;
    return config;
}

void toy_move(struct toy *toy, double dt)
{
    toy->time += dt;
    for (size_t i = 0; i < toy->count; i++)
        toy->bodies[i].position[0] += dt * toy->bodies[i].velocity[0];
}

void toy_step(struct toy *toy, double dt)
{
    struct percuss_slow_contact contacts[TOY_BODIES];
    toy_move(toy, dt);
    size_t n = toy_contacts(toy, contacts);
    if (percuss_slow_advance(toy->slow, n, contacts))
        fail_msg("%s", percuss_slow_error_text());
}

void toy_run(struct toy *toy, double end, double dt)
{
    while (toy->time < end)
        toy_step(toy, fmin(fmin(dt, end - toy->time), percuss_slow_next(toy->slow) - toy->time));
}

void toy_free(struct toy *toy)
{
    percuss_slow_free(toy->slow);
    free(toy);
}
