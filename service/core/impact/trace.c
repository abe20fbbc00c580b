/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/trace.h"

#include <math.h>
#include <string.h>

#include "impact/impact_scale.h"
#include "impact/kernel.h"

/* Bounds of the instants: of one contact, of all contacts together. */
enum { MOST_INSTANTS = 4096, MOST_VALUES = 16384, LEAST_INSTANTS = 256 };
/* A step of a contact phase is shown in 2^FINER parts, in fewer where most would be dropped. */
enum { FINER = 3, DROPPED = 4 };
/* A flight is shown in this share of the contact phase before, as that excited its modes. */
static const double PHASE_SHARE = 1.0 / 16.0;
enum { LEAST_FLIGHT = 32, MOST_FLIGHT = 1500 };

/* An opening shorter than this share of the step after it is rounding of the time. */
static const double NO_FLIGHT = 1e-3;

struct tracer {
    const struct scene *scene;
    const struct trace_sides *sides;
    struct trace *trace;
    struct motion now, next;
    double *impulse, *travel;  /* [row]: integral of the force and its integral */
    double (*silent)[NODES];   /* [row]: no force */
    double *none;              /* [row]: zeros */
    size_t room, stride, skip; /* every stride-th instant is kept */
    int finer;
    struct pace *pace;
    double cost; /* of a step */
    double left; /* work that steps may still take */
};

/* The arrays of a contact; those of friction come last. */
enum { FRICTIONLESS = 8, HISTORIES = 12 };

static void list_histories(struct trace_contact *contact, double **arrays[HISTORIES])
{
    double **all[HISTORIES] = {
        &contact->force,         &contact->indentation,     &contact->gap,
        &contact->gap_rate,      &contact->displacement[0], &contact->displacement[1],
        &contact->velocity[0],   &contact->velocity[1],     &contact->tangential[0],
        &contact->tangential[1], &contact->slip[0],         &contact->slip[1],
    };
    memcpy(arrays, all, sizeof all);
}

static bool create(struct tracer *tracer, struct arena *arena)
{
    struct trace *trace = tracer->trace;
    size_t n = tracer->scene->contacts;
    size_t rows = tracer->scene->rows;
    /* room for instants: the fewer the more contacts */
    tracer->room = MOST_VALUES / n;
    if (tracer->room > MOST_INSTANTS)
        tracer->room = MOST_INSTANTS;
    if (tracer->room < LEAST_INSTANTS)
        tracer->room = LEAST_INSTANTS;
    /* instants, and the tracer's own state */
    *trace = (struct trace){.contacts = n};
    trace->time = arena_take(arena, tracer->room, sizeof(double));
    trace->contact = arena_take(arena, n, sizeof *trace->contact);
    tracer->impulse = arena_take(arena, rows, sizeof(double));
    tracer->travel = arena_take(arena, rows, sizeof(double));
    tracer->silent = arena_take(arena, rows, sizeof *tracer->silent);
    tracer->none = arena_take(arena, rows, sizeof(double));
    if (!trace->time || !trace->contact || !tracer->impulse || !tracer->travel || !tracer->silent ||
        !tracer->none || !motion_create(&tracer->now, tracer->scene, arena) ||
        !motion_create(&tracer->next, tracer->scene, arena))
        return false;
    /* histories of the contacts */
    for (size_t c = 0; c < n; c++) {
        double **arrays[HISTORIES];
        bool friction = scene_friction_of(tracer->scene, c) < tracer->scene->frictions;
        list_histories(&trace->contact[c], arrays);
        for (size_t i = 0; i < (friction ? HISTORIES : FRICTIONLESS); i++)
            if (!(*arrays[i] = arena_take(arena, tracer->room, sizeof(double))))
                return false;
    }
    return true;
}

/* Drops every second instant; from now on half as many are kept. */
static void thin(struct tracer *tracer)
{
    struct trace *trace = tracer->trace;
    size_t half = trace->count / 2;
    for (size_t i = 0; i < half; i++) {
        trace->time[i] = trace->time[2 * i];
        for (size_t c = 0; c < trace->contacts; c++) {
            double **arrays[HISTORIES];
            list_histories(&trace->contact[c], arrays);
            for (size_t k = 0; k < HISTORIES && *arrays[k]; k++)
                (*arrays[k])[i] = (*arrays[k])[2 * i];
        }
    }
    trace->count = half;
    tracer->stride *= 2;
}

/* Displacement and velocity of one side's contact point along the normal. The residual flexibility
 * follows the force at once; its rate is omitted. */
static void move_of_side(const struct tracer *tracer, size_t c, int s, const double *force,
                         double *displacement, double *velocity)
{
    const struct scene *scene = tracer->scene;
    const struct trace_sides *sides = tracer->sides;
    const struct motion *now = &tracer->now;
    double sign = s == 0 ? 1.0 : -1.0;
    double fall = s == 0 ? scene->gap_acceleration[c] : 0.0;
    /* a side that is unknown */
    *displacement = *velocity = NAN;
    if (!sides->w[s])
        return;
    /* the motion of the rigid body and of the residual flexibility by the forces */
    double x = 0.0;
    double v = 0.0;
    for (size_t j = 0; j < scene->rows; j++) {
        double w = sides->w[s][c * scene->rows + j];
        x += w * tracer->travel[j] + sides->residual[s][c * scene->rows + j] * force[j];
        v += w * tracer->impulse[j];
    }
    /* the body's modes */
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        double part;
        double part_rate;
        if (group->body != sides->body[s][c] || !group->participation[c])
            continue;
        kernel_dot2(group->stride, group->participation[c], now->q[g], now->v[g], &part,
                    &part_rate);
        x += part;
        v += part_rate;
    }
    /* on top of its free motion */
    double t = now->time;
    *displacement = t * (sides->velocity[s][c] + 0.5 * fall * t) + sign * x;
    *velocity = sides->velocity[s][c] + fall * t + sign * v;
}

/* Tangential force and slip at instant i. Between the nodes of a step its cubics may leave
 * Coulomb's circle by their own error; the law does not. */
static void sample_friction(const struct tracer *tracer, size_t friction, size_t i,
                            const double *force)
{
    const struct scene *scene = tracer->scene;
    struct trace_contact *contact = &tracer->trace->contact[scene->friction[friction].contact];
    size_t row = scene_tangent(scene, friction);
    double most = scene->friction[friction].coefficient * contact->force[i];
    double size = hypot(force[row], force[row + 1]);
    double share = size > most ? most / size : 1.0;
    for (size_t t = 0; t < 2; t++) {
        double approach;
        double rate;
        motion_approach(&tracer->now, scene, row + t, &approach, &rate);
        contact->tangential[t][i] = share * force[row + t];
        contact->slip[t][i] = -rate;
    }
}

/* Records the present instant; deepened: growth of each dent since the touch, m. */
static void sample(struct tracer *tracer, const double *force, const double *indentation,
                   const double *deepened)
{
    struct trace *trace = tracer->trace;
    /* steps shorter than the time's rounding show nothing new */
    if (trace->count > 0 && !(tracer->now.time > trace->time[trace->count - 1]))
        return;
    /* only every stride-th is kept */
    if (tracer->skip > 0) {
        tracer->skip--;
        return;
    }
    if (trace->count == tracer->room)
        thin(tracer);
    tracer->skip = tracer->stride - 1;
    /* forces, indentations and motion of each contact */
    size_t i = trace->count++;
    trace->time[i] = tracer->now.time;
    for (size_t c = 0; c < trace->contacts; c++) {
        struct trace_contact *contact = &trace->contact[c];
        /* beyond the instant of release a step's cubic may rise once more */
        contact->force[i] = indentation[c] > 0.0 ? fmax(0.0, force[c]) : 0.0;
        contact->indentation[i] = indentation[c] > 0.0 ? indentation[c] + deepened[c] : 0.0;
        contact->gap[i] = tracer->now.gap[c];
        contact->gap_rate[i] = tracer->now.gap_rate[c];
        for (int s = 0; s < 2; s++)
            move_of_side(tracer, c, s, force, &contact->displacement[s][i],
                         &contact->velocity[s][i]);
    }
    for (size_t f = 0; f < tracer->scene->frictions; f++)
        sample_friction(tracer, f, i, force);
}

/* A step of a level with these forces at its nodes. False: out of memory or work, or stopped. */
static bool step(struct tracer *tracer, int level, double (*const force)[NODES])
{
    const struct scene *scene = tracer->scene;
    double h = step_length(level);
    /* the work it takes, and the tables of the level */
    tracer->left -= tracer->cost;
    if (tracer->left < 0.0 || !pace_keeps(tracer->pace, tracer->cost))
        return false;
    if (scene_prepare(scene, level, tracer->pace) != PERCUSS_OK)
        return false;
    /* integrals of the forces */
    for (size_t c = 0; c < scene->rows; c++) {
        double impulse = 0.0;
        double travel = 0.0;
        for (int j = 0; j < NODES; j++) {
            impulse += h * collocation.weight[j] * force[c][j];
            travel += h * h * collocation.position_end[j] * force[c][j];
        }
        tracer->travel[c] += h * tracer->impulse[c] + travel;
        tracer->impulse[c] += impulse;
    }
    /* the motion at its end */
    motion_step(&tracer->next, &tracer->now, scene, level);
    motion_push(&tracer->next, scene, level, force);
    struct motion old = tracer->now;
    tracer->now = tracer->next;
    tracer->next = old;
    return true;
}

/* A logged step in parts: the cubic of a step is a cubic on each of them. */
static bool show_step(struct tracer *tracer, const struct force_step *logged)
{
    size_t n = tracer->scene->rows;
    int finer = logged->level + tracer->finer < STEP_LEVELS ? tracer->finer : 0;
    int parts = 1 << finer;
    double force[SCENE_MOST_ROWS][NODES];
    double end_force[SCENE_MOST_ROWS];
    double end_indentation[SCENE_MOST_ROWS];
    for (int p = 0; p < parts; p++) {
        /* the cubics at the part's nodes and at its end */
        for (size_t c = 0; c < n; c++) {
            double end = (p + 1.0) / parts;
            for (int j = 0; j < NODES; j++)
                force[c][j] =
                    collocation_value(logged->force[c], (p + collocation.node[j]) / parts);
            end_force[c] = collocation_value(logged->force[c], end);
            end_indentation[c] = collocation_value(logged->indentation[c], end);
        }
        /* the motion under them */
        if (!step(tracer, logged->level + finer, force))
            return false;
        sample(tracer, end_force, end_indentation, logged->deepened);
    }
    return true;
}

/* Free motion until `end`. `phase`: how long the contact phase before was, 0: none. */
static bool show_flight(struct tracer *tracer, double end, double phase)
{
    double length = end - tracer->now.time;
    if (!(length > 0.0))
        return true;
    /* instants by the length of the phase before, neither too few nor too many */
    double part = phase > 0.0 ? PHASE_SHARE * phase : length;
    part = fmax(length / MOST_FLIGHT, fmin(part, length / LEAST_FLIGHT));
    int level = step_level(part);
    double h = step_length(level);
    /* a flight as short as the time's rounding has no instants within it: its steps would not move
     * the time, and never come to the end */
    while (end - tracer->now.time > 1.5 * h && tracer->now.time + h > tracer->now.time) {
        if (!step(tracer, level, tracer->silent))
            return false;
        sample(tracer, tracer->none, tracer->none, tracer->none);
    }
    /* the rest is shorter than a step */
    double left = end - tracer->now.time;
    for (size_t c = 0; c < tracer->scene->rows; c++)
        tracer->travel[c] += left * tracer->impulse[c];
    motion_advance(&tracer->now, tracer->scene, left);
    sample(tracer, tracer->none, tracer->none, tracer->none);
    return true;
}

/* Goes through the log. False: out of memory or work, or stopped. */
static bool follow(struct tracer *tracer, const struct force_log *log, double end)
{
    double phase_start = tracer->now.time;
    double phase = 0.0;
    for (size_t i = 0; i < log->count && log->steps[i].start < end; i++) {
        const struct force_step *logged = &log->steps[i];
        /* a flight shorter than a share of the step is rounding */
        if (logged->start - tracer->now.time > NO_FLIGHT * step_length(logged->level)) {
            if (!show_flight(tracer, logged->start, phase))
                return false;
            phase_start = tracer->now.time;
        }
        if (!show_step(tracer, logged))
            return false;
        phase = tracer->now.time - phase_start;
    }
    if (!show_flight(tracer, end, phase))
        return false;
    /* the last instant is always kept */
    tracer->skip = 0;
    sample(tracer, tracer->none, tracer->none, tracer->none);
    return true;
}

enum percuss_status trace_make(const struct trace_task *task, struct arena *arena,
                               struct trace *trace)
{
    struct tracer tracer = {.scene = task->scene,
                            .sides = task->sides,
                            .trace = trace,
                            .stride = 1,
                            .pace = task->pace,
                            .cost = step_cost(task->scene),
                            .left = task->max_work};
    if (!task->log->complete || !create(&tracer, arena))
        return PERCUSS_INTERNAL;
    /* parts of a step, so that few of them are dropped */
    for (tracer.finer = FINER; tracer.finer > 0; tracer.finer--)
        if (task->log->count << tracer.finer <= DROPPED * tracer.room)
            break;
    /* from the first instant to the end of the log */
    motion_start(&tracer.now, task->scene);
    if (task->shift < 0.0)
        motion_rewind(&tracer.now, task->scene, -task->shift);
    sample(&tracer, tracer.none, tracer.none, tracer.none);
    if (follow(&tracer, task->log, task->end) || tracer.left < 0.0)
        return PERCUSS_OK;
    return pace_status(task->pace) ? PERCUSS_TIMEOUT : PERCUSS_INTERNAL;
}
