/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "engine.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Equality constraints are springs in MuJoCo and not part of its mass matrix. An impulse is too
 * short for springs to be soft: its response must not violate them. Directions that depend on
 * others within this are left out. */
static const double dependent = 1e-8;

/* --- generalized directions --- */

/* The row w with along.(velocity of a's point less that of b's) = w.qvel. */
static void direction(const struct engine *engine, const struct percuss_slow_contact *contact,
                      const double along[3], double *w)
{
    const mjModel *model = engine->model;
    double jacobian[3 * model->nv];
    mju_zero(w, model->nv);
    for (int side = 0; side < 2; side++) {
        int body = engine->bodies[side == 0 ? contact->a : contact->b];
        mj_jac(model, engine->data, jacobian, NULL, contact->point, body);
        for (int i = 0; i < 3; i++)
            mju_addToScl(w, jacobian + i * model->nv, side == 0 ? along[i] : -along[i], model->nv);
    }
}

/* u = M^-1 w less the part that the constraints take away. */
static void respond(const struct engine *engine, const double *w, double *u)
{
    int nv = engine->model->nv;
    mj_solveM((mjModel *)engine->model, engine->data, u, w, 1);
    for (size_t k = 0; k < engine->constraint_count; k++) {
        const double *held = engine->constraints + k * (size_t)nv;
        mju_addToScl(u, held, -mju_dot(held, w, nv), nv);
    }
}

/* Orthonormal directions of the equality constraints that hold now (Gram-Schmidt in M). */
static void find_constraints(struct engine *engine)
{
    int nv = engine->model->nv;
    engine->constraint_count = 0;
    for (int row = 0; row < engine->data->ne && engine->constraint_count < (size_t)nv; row++) {
        const double *j = engine->data->efc_J + row * nv;
        double *u = engine->constraints + engine->constraint_count * (size_t)nv;
        double full[nv];
        mj_solveM(engine->model, engine->data, full, j, 1);
        respond(engine, j, u);
        double square = mju_dot(u, j, nv);
        if (!(square > dependent * mju_dot(full, j, nv)))
            continue;
        mju_scl(u, u, 1.0 / sqrt(square), nv);
        engine->constraint_count++;
    }
}

static void refresh(struct engine *engine)
{
    mj_forward(engine->model, engine->data);
    find_constraints(engine);
}

double engine_gap_rate(struct engine *engine, const struct percuss_slow_contact *contact)
{
    double w[engine->model->nv];
    direction(engine, contact, contact->normal, w);
    return mju_dot(w, engine->data->qvel, engine->model->nv);
}

double engine_kinetic_energy(const struct engine *engine)
{
    double momentum[engine->model->nv];
    mj_mulM(engine->model, engine->data, momentum, engine->data->qvel);
    return 0.5 * mju_dot(momentum, engine->data->qvel, engine->model->nv);
}

/* --- the callbacks --- */

/* How the catalogue's body moves. */
static void describe(const struct engine *engine, size_t body, struct percuss_body_motion *motion)
{
    static const double quarter_turn[4] = {M_SQRT1_2, 0.0, 0.0, M_SQRT1_2}; /* x to y, about z */
    const mjModel *model = engine->model;
    const mjData *data = engine->data;
    int number = engine->bodies[body];
    double linear[3 * model->nv], angular[3 * model->nv];
    mj_jacBodyCom(model, data, linear, angular, number);
    mju_mulMatVec(motion->velocity, linear, data->qvel, 3, model->nv);
    mju_mulMatVec(motion->angular_velocity, angular, data->qvel, 3, model->nv);
    mju_copy3(motion->position, data->xipos + 3 * number);
    mju_copy4(motion->orientation, data->xquat + 4 * number);
    if (engine->names[body].along_y)
        mju_mulQuat(motion->orientation, data->xquat + 4 * number, quarter_turn);
    mju_normalize4(motion->orientation);
}

static bool probe(void *context, struct percuss_slow_view *view)
{
    struct engine *engine = context;
    size_t n = view->count;
    int nv = engine->model->nv;
    double w[ENGINE_CONTACTS][nv], u[nv];
    if (n > ENGINE_CONTACTS)
        return false;
    for (size_t i = 0; i < n; i++) {
        direction(engine, &view->contacts[i], view->contacts[i].normal, w[i]);
        view->gap_rate[i] = mju_dot(w[i], engine->data->qvel, nv);
    }
    for (size_t i = 0; view->delassus && i < n; i++) {
        respond(engine, w[i], u);
        for (size_t j = 0; j < n; j++)
            view->delassus[i * n + j] = mju_dot(w[j], u, nv);
    }
    for (size_t i = 0; view->bodies && i < engine->body_count; i++)
        describe(engine, i, &view->bodies[i]);
    return true;
}

/* By friction the bodies move along the tangents as well, as the joints let them. */
static bool oblique(void *context, size_t count, const struct percuss_slow_contact *contacts,
                    double *delassus)
{
    struct engine *engine = context;
    int nv = engine->model->nv;
    size_t rows = 3 * count;
    double w[3 * ENGINE_CONTACTS][nv], u[nv];
    if (count > ENGINE_CONTACTS)
        return false;
    for (size_t i = 0; i < count; i++) {
        double second[3];
        mju_cross(second, contacts[i].normal, contacts[i].tangent);
        direction(engine, &contacts[i], contacts[i].normal, w[3 * i]);
        direction(engine, &contacts[i], contacts[i].tangent, w[3 * i + 1]);
        direction(engine, &contacts[i], second, w[3 * i + 2]);
    }
    for (size_t i = 0; i < rows; i++) {
        respond(engine, w[i], u);
        for (size_t j = 0; j < rows; j++)
            delassus[i * rows + j] = mju_dot(w[j], u, nv);
    }
    return true;
}

/* M^-1 w of a direction, with its constraints. */
static void respond_to(const struct engine *engine, const struct percuss_slow_contact *contact,
                       const double along[3], double *u)
{
    double w[engine->model->nv];
    direction(engine, contact, along, w);
    respond(engine, w, u);
}

/* `impulse` times a direction changes the velocities. */
static bool push(struct engine *engine, const struct percuss_slow_contact *contact,
                 const double along[3], double impulse)
{
    int nv = engine->model->nv;
    double u[nv];
    engine->taken += engine_kinetic_energy(engine);
    respond_to(engine, contact, along, u);
    mju_addToScl(engine->data->qvel, u, impulse, nv);
    engine->taken -= engine_kinetic_energy(engine);
    engine->applied[contact->a][contact->b] += impulse * mju_dot3(contact->normal, along);
    return true;
}

static bool apply(void *context, const struct percuss_slow_contact *contact, double impulse)
{
    return push(context, contact, contact->normal, impulse);
}

/* By friction: M^-1 (w_n P_n + w_t P_t), which is the response to the impulse's own direction. */
static bool apply_vector(void *context, const struct percuss_slow_contact *contact,
                         const double impulse[3])
{
    return push(context, contact, impulse, 1.0);
}

static bool move(void *context, const struct percuss_slow_contact *contact, double moment)
{
    struct engine *engine = context;
    double u[engine->model->nv];
    respond_to(engine, contact, contact->normal, u);
    mj_integratePos(engine->model, engine->data->qpos, u, moment);
    return true;
}

static bool move_vector(void *context, const struct percuss_slow_contact *contact,
                        const double moment[3])
{
    struct engine *engine = context;
    double u[engine->model->nv];
    respond_to(engine, contact, moment, u);
    mj_integratePos(engine->model, engine->data->qpos, u, 1.0);
    return true;
}

static double now(void *context)
{
    return ((struct engine *)context)->data->time;
}

void engine_configure(struct engine *engine, struct percuss_slow_config *config)
{
    config->engine = (struct percuss_slow_engine){.context = engine,
                                                  .probe = probe,
                                                  .apply = apply,
                                                  .now = now,
                                                  .apply_vector = apply_vector,
                                                  .oblique = oblique};
    config->move = move;
    config->move_vector = move_vector;
    /* Euler's steps move positions by the velocities of their ends; those of Runge and Kutta do not
     */
    if (engine->fixed && engine->model->opt.integrator == mjINT_EULER)
        config->velocity_lag = 0.5 * engine->model->opt.timestep;
}

/* --- contacts and steps --- */

static bool find_body(const struct engine *engine, int geom, uint32_t *body)
{
    for (size_t i = 0; i < engine->body_count; i++)
        if (engine->bodies[i] == engine->model->geom_bodyid[geom]) {
            *body = (uint32_t)i;
            return true;
        }
    return false;
}

static size_t collect(const struct engine *engine,
                      struct percuss_slow_contact contacts[ENGINE_CONTACTS])
{
    size_t count = 0;
    for (int i = 0; i < engine->data->ncon && count < ENGINE_CONTACTS; i++) {
        const mjContact *from = &engine->data->contact[i];
        struct percuss_slow_contact *to = &contacts[count];
        *to = (struct percuss_slow_contact){.gap = from->dist, .friction = engine->friction};
        /* MuJoCo's normal goes from geom1 to geom2, ours from b to a */
        if (!find_body(engine, from->geom2, &to->a) || !find_body(engine, from->geom1, &to->b))
            continue;
        mju_copy3(to->point, from->pos);
        mju_copy3(to->normal, from->frame);
        for (size_t j = 0; j < count; j++)
            to->feature += (contacts[j].a == to->a && contacts[j].b == to->b) ||
                           (contacts[j].a == to->b && contacts[j].b == to->a);
        count++;
    }
    return count;
}

/* By a short free motion: the effect of gravity and of the bodies' swing on the gap rate. It is
 * that of the gap, whose place moves on over bodies that slide and spin. */
static void find_accelerations(struct engine *engine, size_t count,
                               struct percuss_slow_contact *contacts)
{
    const double look_ahead = 1e-4;
    struct percuss_slow_contact later[ENGINE_CONTACTS];
    double rates[ENGINE_CONTACTS];
    for (size_t i = 0; i < count; i++)
        rates[i] = engine_gap_rate(engine, &contacts[i]);
    mj_copyData(engine->trial, engine->model, engine->data);
    engine->model->opt.timestep = look_ahead;
    mj_step(engine->model, engine->data);
    mj_forward(engine->model, engine->data);
    size_t near = collect(engine, later);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < near; j++)
            if (later[j].a == contacts[i].a && later[j].b == contacts[i].b &&
                later[j].feature == contacts[i].feature)
                contacts[i].gap_acceleration =
                    (engine_gap_rate(engine, &later[j]) - rates[i]) / look_ahead;
    mj_copyData(engine->data, engine->model, engine->trial);
}

size_t engine_contacts(struct engine *engine, bool accelerations,
                       struct percuss_slow_contact contacts[ENGINE_CONTACTS])
{
    size_t count = collect(engine, contacts);
    if (accelerations && count)
        find_accelerations(engine, count, contacts);
    return count;
}

static void step_from_start(struct engine *engine, double step)
{
    mj_copyData(engine->data, engine->model, engine->start);
    engine->model->opt.timestep = step;
    mj_step(engine->model, engine->data);
    refresh(engine);
}

static bool is_due(struct engine *engine, const struct percuss_slow *slow)
{
    struct percuss_slow_contact contacts[ENGINE_CONTACTS];
    return percuss_slow_due(slow, engine_contacts(engine, false, contacts), contacts);
}

enum percuss_result engine_step(struct engine *engine, struct percuss_slow *slow, double step)
{
    struct percuss_slow_contact contacts[ENGINE_CONTACTS];
    double before = 0.0;
    double after = engine->fixed ? step : fmin(step, percuss_slow_next(slow) - engine->data->time);
    mj_copyData(engine->start, engine->model, engine->data);
    step_from_start(engine, after);
    bool due = is_due(engine, slow);
    bool goes_back = due && !engine->fixed;
    /* the touch, to the last bits of the clock, from the side where the bodies overlap */
    while (goes_back && after - before > 1e-15) {
        double middle = 0.5 * (before + after);
        if (!(middle > before && middle < after))
            break;
        step_from_start(engine, middle);
        *(is_due(engine, slow) ? &after : &before) = middle;
    }
    if (goes_back)
        step_from_start(engine, after);
    size_t count = engine_contacts(engine, due, contacts);
    enum percuss_result result = percuss_slow_advance(slow, count, contacts);
    refresh(engine); /* velocities and positions may be others */
    return result;
}

/* --- life --- */

bool engine_open(struct engine *engine, const char *file, size_t body_count,
                 const struct engine_body *bodies)
{
    char error[512];
    *engine = (struct engine){.body_count = body_count};
    engine->model = mj_loadXML(file, NULL, error, sizeof error);
    if (!engine->model) {
        fprintf(stderr, "%s: %s\n", file, error);
        return false;
    }
    engine->model->opt.jacobian = mjJAC_DENSE;
    engine->data = mj_makeData(engine->model);
    engine->start = mj_makeData(engine->model);
    engine->trial = mj_makeData(engine->model);
    size_t nv = (size_t)engine->model->nv;
    engine->constraints = mju_malloc(nv * nv * sizeof(double));
    for (size_t i = 0; i < body_count; i++) {
        engine->names[i] = bodies[i];
        engine->bodies[i] = mj_name2id(engine->model, mjOBJ_BODY, bodies[i].name);
        if (engine->bodies[i] < 0) {
            fprintf(stderr, "%s: there is no body '%s'\n", file, bodies[i].name);
            engine_close(engine);
            return false;
        }
    }
    return true;
}

void engine_close(struct engine *engine)
{
    mju_free(engine->constraints);
    mj_deleteData(engine->trial);
    mj_deleteData(engine->start);
    mj_deleteData(engine->data);
    mj_deleteModel(engine->model);
}
