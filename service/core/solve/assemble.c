/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/assemble.h"

#include <math.h>
#include <string.h>

#include "base/extremes.h"
#include "impact/oscillator.h"
#include "model/damping.h"
#include "solve/mode_choice.h"
#include "solve/radiation.h"

/* The scene leaves out a group if all its shapes vanish at every contact, up to rounding. */
static const double NODE_SHARE = 1e-9;

/* Contribution of one family of one body. */
struct addition {
    struct assembly *assembly;
    const struct problem *problem;
    const struct body_state *state;
    double elapsed;
    size_t body;
    size_t family;
    const struct prepared_family *prepared;
    size_t count;       /* modes of the family that take part */
    double *compliance; /* [row], of the family by itself; NAN: not known yet */
};

static bool family_is_loaded(const struct problem *problem, size_t body, size_t family)
{
    for (size_t r = 0; r < problem_rows(problem); r++)
        if (problem_load(problem, r, body, family))
            return true;
    return false;
}

/* Initial coordinates of the group's modes: the state, `elapsed` later. */
static bool set_initial(const struct addition *add, struct scene_group *group,
                        const struct prepared_group *source)
{
    if (!add->state || add->state->count[add->family] == 0)
        return true;
    /* room, at rest where the state has no such mode */
    const double *pairs = body_state_family(add->state, add->family);
    double *q = arena_take(add->problem->arena, group->stride, sizeof *q);
    double *v = arena_take(add->problem->arena, group->stride, sizeof *v);
    if (!q || !v)
        return false;
    /* free vibration from the state until now */
    for (size_t k = 0; k < group->count; k++) {
        size_t mode = source->mode[k];
        if (mode >= add->state->count[add->family])
            continue;
        q[k] = pairs[2 * mode];
        v[k] = pairs[2 * mode + 1];
        oscillator_advance(group->set->omega[k], group->set->damping[k], add->elapsed, &q[k],
                           &v[k]);
    }
    group->q = q;
    group->v = v;
    return true;
}

/* Fills one row of participations; returns its largest magnitude. */
static double fill_row(const struct addition *add, const struct prepared_group *source,
                       const struct family_load *load, size_t count, double *row)
{
    double largest = 0.0;
    participations_get(add->prepared->participations, add->problem->bodies[add->body],
                       add->prepared->modes, source->mode, count, load, row);
    for (size_t k = 0; k < count; k++)
        largest = fabs(row[k]) > largest ? fabs(row[k]) : largest;
    return largest;
}

/* A mode of unit mass distribution has participations of about 1/sqrt(mass). */
static double participation_scale(const struct body *body)
{
    return 1.0 / sqrt(body->mass);
}

/* Part of the compliance between two rows that the modal sum holds. */
static double held_compliance(const struct scene_group *group, size_t i, size_t j)
{
    const double *a = group->participation[i];
    const double *b = group->participation[j];
    double sum = 0.0;
    /* small terms first: the residual is a small difference */
    for (size_t k = group->count; a && b && k-- > 0;)
        sum += a[k] * b[k] / (group->set->omega[k] * group->set->omega[k]);
    return sum;
}

/* The group as the scene excites it, with participations of those rows alone; *excited: any does.
 */
static bool make_group(const struct addition *add, const struct prepared_group *source,
                       struct scene_group *group, bool *excited)
{
    size_t n = problem_rows(add->problem);
    *group = (struct scene_group){.set = source->set, .body = add->body};
    /* the modes that the scene asks for */
    while (group->count < source->set->count && source->mode[group->count] < add->count)
        group->count++;
    group->stride = (group->count + LANES - 1) / LANES * LANES;
    group->participation = arena_take(add->problem->arena, n, sizeof *group->participation);
    if (!group->participation)
        return false;
    /* a row of participations for every one that excites one of them */
    double scale = participation_scale(add->problem->bodies[add->body]);
    *excited = false;
    for (size_t c = 0; c < n && group->count; c++) {
        const struct family_load *load = problem_load(add->problem, c, add->body, add->family);
        if (!load)
            continue;
        double *row = arena_take(add->problem->arena, group->stride, sizeof *row);
        if (!row)
            return false;
        if (fill_row(add, source, load, group->count, row) <= NODE_SHARE * scale)
            continue;
        group->participation[c] = row;
        *excited = true;
    }
    return true;
}

/* Adds a group if a row excites it, and takes its static compliance from the residual. */
static bool add_group(const struct addition *add, const struct prepared_group *source,
                      double *residual, double *left)
{
    struct assembly *assembly = add->assembly;
    size_t n = problem_rows(add->problem);
    struct scene_group *group = &assembly->groups[assembly->scene.groups];
    bool excited;
    if (!make_group(add, source, group, &excited))
        return false;
    if (!excited)
        return true;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            double held = held_compliance(group, i, j);
            residual[i * n + j] -= held;
            left[i] -= i == j ? held : 0.0;
        }
    }
    /* without modes of a mesh that hardly take part; a place excites a bar's families whole */
    assembly->offered[add->body] += group->count;
    if (body_is_solid(add->problem->bodies[add->body]) &&
        !mode_choice_leave_out(add->problem, add->state, add->family, &source, group))
        return false;
    if (group->count == 0)
        return true;
    if (!set_initial(add, group, source))
        return false;
    assembly->sources[assembly->scene.groups] = source;
    assembly->families[assembly->scene.groups] = add->family;
    assembly->scene.groups++;
    assembly->modes[add->body] += group->count;
    assembly->all_modes += group->count;
    assembly->highest = larger(assembly->highest, group->set->omega[group->count - 1]);
    return true;
}

/* Adds the omitted modes from add->count on at each row; `left`: the family's compliance
 * without that of its groups. */
static void add_omitted(const struct addition *add, const double *left)
{
    struct assembly *assembly = add->assembly;
    const struct body *body = add->problem->bodies[add->body];
    double omega = add->prepared->modes->omega[add->count];
    double stand_in = modal_remainder_frequency(body, add->prepared->modes, add->count);
    double damping = damping_from(body, add->count, omega);
    for (size_t i = 0; i < problem_rows(add->problem); i++) {
        const struct family_load *load = problem_load(add->problem, i, add->body, add->family);
        if (!load)
            continue;
        /* rounding may leave it below zero */
        double beyond =
            modal_beyond(body, add->prepared->modes, add->count, load, larger(left[i], 0.0));
        /* the sums of struct omitted as integrals, shapes alike and frequencies evenly spaced:
         * phi^2/omega^2 adds up to beyond, 2 damping phi^2/omega^3 to damping beyond/omega */
        assembly->omitted[i].inertia += beyond / (stand_in * stand_in);
        assembly->omitted[i].viscosity += damping * beyond / omega;
        /* for assemble_remainder */
        assembly->parts[assembly->part_count++] =
            (struct omitted_part){add->body, i, add->family, add->count, beyond, omega};
    }
    assembly->lowest_omitted = smaller(assembly->lowest_omitted, omega);
}

static bool add_family(const struct addition *add, double *residual)
{
    const struct problem *problem = add->problem;
    const struct body *body = problem->bodies[add->body];
    size_t n = problem_rows(problem);
    double *left = arena_take(problem->arena, n, sizeof *left);
    if (!left)
        return false;
    /* all of its static compliance */
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            const struct family_load *a = problem_load(problem, i, add->body, add->family);
            const struct family_load *b = problem_load(problem, j, add->body, add->family);
            bool known = i == j && !isnan(add->compliance[i]);
            double all = known    ? add->compliance[i]
                         : a && b ? modal_compliance(body, add->family, a, b)
                                  : 0.0;
            residual[i * n + j] += all;
            left[i] = i == j ? all : left[i];
        }
    }
    /* less that of its modes */
    for (size_t g = 0; g < add->prepared->group_count; g++)
        if (!add_group(add, &add->prepared->groups[g], residual, left))
            return false;
    /* the omitted modes do not follow a force at once */
    add_omitted(add, left);
    return true;
}

static bool fill_friction(struct assembly *assembly, const struct problem *problem)
{
    size_t n = problem->friction_count;
    struct scene_friction *friction = n ? arena_take(problem->arena, n, sizeof *friction) : NULL;
    if (n && !friction)
        return false;
    for (size_t i = 0; i < n; i++) {
        const struct contact_friction *of = &problem->friction[i];
        friction[i] = (struct scene_friction){.contact = of->contact,
                                              .coefficient = of->coefficient,
                                              .ratio = {of->ratio[0], of->ratio[1], of->ratio[2]}};
    }
    scene_set_frictions(&assembly->scene, n);
    assembly->scene.plain = problem_is_plain(problem);
    assembly->scene.friction = friction;
    return true;
}

static bool fill_scene(struct assembly *assembly, const struct problem *problem)
{
    size_t n = problem->contact_count;
    size_t rows = problem_rows(problem);
    /* gaps, wider by the depth of dents; tangents begin with no displacement */
    double *gap = arena_take(problem->arena, rows, sizeof *gap);
    double *acceleration = arena_take(problem->arena, rows, sizeof *acceleration);
    assembly->scene.contacts = n;
    if (!gap || !acceleration || !fill_friction(assembly, problem))
        return false;
    for (size_t c = 0; c < n; c++) {
        gap[c] = problem->request->contacts[c].gap + problem->contact_model.depth[c];
        acceleration[c] = problem->request->contacts[c].gap_acceleration;
    }
    /* all else is the problem's */
    assembly->scene.bodies = problem->body_count;
    assembly->scene.w = problem->row_w;
    assembly->scene.gap = gap;
    assembly->scene.gap_rate = problem->gap_rate;
    assembly->scene.gap_acceleration = acceleration;
    assembly->scene.laws = problem->contact_model.laws;
    assembly->scene.group = assembly->groups;
    return true;
}

/* How many modes of the family take part. */
static size_t assembly_wanted_modes(const struct addition *add, const struct scene *rigid,
                                    const struct mode_choice *choice)
{
    size_t fixed = add->problem->bodies[add->body]->modes;
    size_t count = fixed;
    if (!fixed || choice->unfixed)
        count =
            mode_choice_count(choice, add->problem, rigid, add->body, add->family, add->compliance);
    count = count > fixed ? count : fixed;
    size_t allowed = add->problem->compliance.most;
    if (body_is_solid(add->problem->bodies[add->body]) && allowed > 0 && count > allowed)
        count = allowed;
    if (add->state && add->state->count[add->family] > count)
        count = add->state->count[add->family];
    size_t most = modal_family_most(add->problem->bodies[add->body], add->family);
    return count < most ? count : most;
}

static bool assembly_create(struct assembly *assembly, const struct problem *problem)
{
    /* two parities of every family of a body, and the half-spaces' waves of each contact */
    size_t groups = 2 * BODY_MOST_FAMILIES * problem->body_count + problem->contact_count;
    *assembly = (struct assembly){.lowest_omitted = INFINITY};
    assembly->groups = arena_take(problem->arena, groups, sizeof *assembly->groups);
    assembly->sources = arena_take(problem->arena, groups, sizeof(struct prepared_group *));
    assembly->families = arena_take(problem->arena, groups, sizeof *assembly->families);
    assembly->modes = arena_take(problem->arena, 2 * problem->body_count, sizeof(size_t));
    /* either side of a row, every family */
    size_t rows = problem_rows(problem);
    assembly->parts =
        arena_take(problem->arena, 2 * BODY_MOST_FAMILIES * rows, sizeof *assembly->parts);
    assembly->omitted = arena_take(problem->arena, rows, sizeof *assembly->omitted);
    if (!assembly->groups || !assembly->sources || !assembly->families || !assembly->modes ||
        !assembly->parts || !assembly->omitted)
        return false;
    assembly->offered = assembly->modes + problem->body_count;
    return true;
}

bool assemble(struct assembly *assembly, const struct problem *problem,
              const struct mode_choice *choice)
{
    size_t n = problem->contact_count;
    size_t rows = problem_rows(problem);
    double *residual = arena_take(problem->arena, rows * rows, sizeof *residual);
    double compliance[SCENE_MOST_ROWS];
    if (!residual || !assembly_create(assembly, problem) || !fill_scene(assembly, problem))
        return false;
    /* compliance in series with the laws */
    for (size_t c = 0; problem->compliance.series && c < n; c++)
        residual[c * rows + c] = problem->compliance.series[c];
    for (size_t c = 0; problem->shift && c < n; c++)
        residual[c * rows + c] += problem->shift[c];
    assembly->scene.residual = residual;
    const struct scene rigid = assembly->scene;
    /* every loaded family of every body that vibrates */
    for (size_t b = 0; b < problem->body_count; b++) {
        const struct body *body = problem->bodies[b];
        for (size_t f = 0; f < body->kind->family_count; f++) {
            struct addition add = {.assembly = assembly,
                                   .problem = problem,
                                   .state = problem->states[b],
                                   .elapsed = problem->request->bodies[b].elapsed,
                                   .body = b,
                                   .family = f,
                                   .compliance = compliance};
            if (!family_is_loaded(problem, b, add.family))
                continue;
            for (size_t r = 0; r < rows; r++)
                compliance[r] = NAN;
            add.count = assembly_wanted_modes(&add, &rigid, choice);
            if (add.count > MODE_CHOICE_MOST)
                return false;
            assembly->adjustable = assembly->adjustable || body->modes == 0;
            assembly->capped = assembly->capped || add.count == choice->most ||
                               (body_is_solid(body) && add.count == problem->compliance.most) ||
                               add.count == modal_family_most(body, f);
            add.prepared = prepared_family_get(problem->cache, body, add.family, add.count + 1);
            if (!add.prepared || !add_family(&add, residual))
                return false;
        }
    }
    /* and the waves that leave through half-spaces */
    return radiation_add(problem, assembly, residual);
}

bool assembly_same_modes(const struct assembly *a, const struct assembly *b)
{
    bool same = a->scene.groups == b->scene.groups;
    for (size_t g = 0; same && g < a->scene.groups; g++) {
        size_t count = a->groups[g].count;
        same = count == b->groups[g].count && a->families[g] == b->families[g] &&
               a->groups[g].body == b->groups[g].body;
        if (same && a->sources[g])
            same = memcmp(a->sources[g]->mode, b->sources[g]->mode, count * sizeof(size_t)) == 0;
    }
    return same;
}

bool assemble_remainder(const struct assembly *assembly, const struct problem *problem,
                        struct scene *scene)
{
    size_t n = problem_rows(problem);
    *scene = assembly->scene;
    scene->group =
        arena_take(problem->arena, scene->groups + assembly->part_count, sizeof *scene->group);
    double *residual = arena_take(problem->arena, n * n, sizeof *residual);
    if (!scene->group || !residual)
        return false;
    /* the scene as it is */
    memcpy(scene->group, assembly->groups, scene->groups * sizeof *scene->group);
    memcpy(residual, assembly->scene.residual, n * n * sizeof *residual);
    scene->residual = residual;
    /* one oscillator more for each part, in the place of its compliance */
    for (size_t p = 0; p < assembly->part_count; p++) {
        const struct omitted_part *part = &assembly->parts[p];
        struct scene_group *group = &scene->group[scene->groups++];
        double *row = arena_take(problem->arena, LANES, sizeof *row);
        *group = (struct scene_group){.body = part->body, .count = 1, .stride = LANES};
        group->participation = arena_take(problem->arena, n, sizeof *group->participation);
        group->set = prepared_remainder_get(problem->cache, problem->bodies[part->body],
                                            part->family, part->first);
        if (!row || !group->participation || !group->set)
            return false;
        row[0] = sqrt(part->compliance) * group->set->omega[0];
        group->participation[part->row] = row;
        residual[part->row * n + part->row] -= part->compliance;
    }
    return true;
}
