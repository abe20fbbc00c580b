/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/radiation.h"

#include <math.h>

#include "contact/hertz.h"
#include "contact/plastic.h"
#include "impact/impact_scale.h"
#include "model/half_space.h"

/* Effect on the restitution, in tolerances, below which waves are left out. */
static const double NEGLIGIBLE = 0.05;
/* Share of a contact's compliance that the oscillator may take over: from 0.5 on contacts do not
 * bear it (contact_bears); an impact harder than the rigid masses' estimate needs the other
 * half. */
static const double BORNE = 0.25;
/* Frequency times duration of the contact that is fast enough; see ERROR. */
static const double FAST = 128.0;
/* Relative error of the loss times (frequency times duration)^2: spheres on a wall, integrated with
 * oscillators of 14 to 7000, differ from the limit by 0.5 to 3. */
static const double ERROR = 3.0;
/* Pivot of the shares up to which a contact has no waves of its own: FAR squared. */
static const double OWN = 1e-6;
/* Contacts that share less of their waves are far from each other. */
static const double FAR = 1e-3;

/* One half-space. */
struct radiator {
    size_t body;
    struct half_space_waves waves;
    size_t count;
    size_t contact[PERCUSS_MAX_CONTACTS];
    double stiffness; /* of the stiffest contact, N/m */
    double duration;  /* of the shortest, s */
    double loss;      /* see collision, the largest */
    double patch;     /* contact radius, the largest, m */
};

static bool is_half_space(const struct problem *problem, size_t body)
{
    return body_solid(problem->bodies[body]).form == SOLID_HALF_SPACE;
}

/* One contact's collision, as far as its scale tells. */
struct collision {
    double stiffness; /* the largest, N/m */
    double duration;  /* twice the shorter of approach and rebound, s */
    double loss;      /* twice the restitution's loss to a half-space's waves */
    double patch;     /* contact radius, m */
};

/* An elastic half of a collision, of the energy 0.4 F d, has int F'^2 dt = 0.35 K^2 v d (see
 * mode_choice.c). The rebound from a dent is another one than the approach, of energy e^2. */
static struct collision radiation_collide(const struct problem *problem, const struct scene *scene,
                                          size_t contact, double rate, double lag)
{
    struct contact_law law = scene->laws[contact];
    struct impact_scale scale = impact_scale_of(scene, contact, rate);
    double axes[2];
    double loading;
    /* the approach, into yield if it goes so far */
    contact_law_force(&law, scale.indentation, &loading);
    if (scale.indentation > contact_law_limit(&law))
        contact_law_yield(&law, scale.indentation);
    /* the rebound, by the elastic indentation */
    double back = fmin(scale.indentation, contact_law_limit(&law));
    double unloading = back < scale.indentation ? contact_law_unloading(&law) : loading;
    double e = sqrt(back / scale.indentation);
    /* int F'^2 dt of both */
    double squares =
        0.35 * rate * (loading * loading * scale.indentation + unloading * unloading * e * back);
    hertz_ellipse(&problem->hertz[contact], scale.force, axes);
    return (struct collision){
        .stiffness = fmax(loading, unloading),
        .duration = HERTZ_DURATION * fmin(scale.indentation, back / e) / rate,
        .loss = lag * squares / (HERTZ_WORK * scale.force * scale.indentation * e),
        .patch = sqrt(axes[0] * axes[1]),
    };
}

/* Rate equal in energy to the approach and a pressing acceleration together: at most twice the
 * acceleration's static load acts. */
static double pressed_rate(const struct scene *scene, size_t contact, double rate)
{
    const struct contact_law *law = &scene->laws[contact];
    double pressing = fmax(0.0, -scene->gap_acceleration[contact]);
    if (pressing == 0.0)
        return rate;
    double load = 2.0 * pressing / scene->w[contact * (scene->rows + 1)];
    return sqrt(rate * rate + 2.0 * pressing * law->operations->indentation(law, load));
}

/* Fastest rate that the energy of all approaches of a group can give one contact (a heavy ball on a
 * light one on a wall). */
static double driven_rate(const struct problem *problem, size_t contact, double rate)
{
    size_t n = problem->contact_count;
    double energy = 0.0;
    for (size_t c = 0; c < n; c++)
        energy += 0.5 * problem->impulse_compression[c] * fabs(problem->gap_rate[c]);
    return fmax(rate, sqrt(2.0 * energy * problem->w[contact * (n + 1)]));
}

/* The stiffness is that of rigid masses: energy that vibration takes from the first impact may come
 * back. */
static void add_contact(const struct problem *problem, const struct scene *scene, size_t contact,
                        double rate, struct radiator *radiator)
{
    struct scene rigid = *scene;
    rigid.groups = 0;
    double lag = radiator->waves.lag;
    double driven = driven_rate(problem, contact, rate);
    struct collision collision = radiation_collide(problem, scene, contact, rate, lag);
    double hardest = radiation_collide(problem, &rigid, contact, driven, lag).stiffness;
    radiator->stiffness = fmax(radiator->stiffness, hardest);
    radiator->duration = fmin(radiator->duration, collision.duration);
    radiator->loss = fmax(radiator->loss, collision.loss);
    radiator->patch = fmax(radiator->patch, collision.patch);
    radiator->contact[radiator->count++] = contact;
}

static struct radiator find_radiator(const struct problem *problem, const struct scene *scene,
                                     size_t body)
{
    struct radiator radiator = {.body = body, .duration = INFINITY};
    double rate = problem_approach(problem);
    radiator.waves = half_space_waves_of(&problem->bodies[body]->material);
    for (size_t c = 0; c < scene->contacts; c++)
        if (problem->sides[c][0].body == body || problem->sides[c][1].body == body)
            add_contact(problem, scene, c, pressed_rate(scene, c, rate), &radiator);
    return radiator;
}

/* Share of their waves that two contacts have in common: J0(k r), spread over the wave numbers of a
 * pulse; their mean square is that of Rayleigh's wave at half a period per contact. */
static double shared(const struct problem *problem, const struct radiator *radiator, size_t i,
                     size_t j)
{
    const struct contact_side *a = problem->sides[radiator->contact[i]];
    const struct contact_side *b = problem->sides[radiator->contact[j]];
    const double *p = a[a[0].body != radiator->body].site.point;
    const double *q = b[b[0].body != radiator->body].site.point;
    double number = M_PI / (radiator->duration * radiator->waves.rayleigh);
    double angle = number * hypot(p[0] - q[0], p[1] - q[1]);
    double share = exp(-0.25 * angle * angle);
    return share > FAR ? share : 0.0;
}

/* Waves of all contacts on a half-space as one of them feels them, relative to its own. */
static double felt(const struct problem *problem, const struct radiator *radiator, size_t i)
{
    double sum = 0.0;
    for (size_t j = 0; j < radiator->count; j++)
        sum += shared(problem, radiator, i, j);
    return sum;
}

/* Cholesky's factor of the shares, row-major lower triangle: they are positive semidefinite but for
 * shares below FAR, which are 0. */
static void factor_shares(const struct problem *problem, const struct radiator *radiator,
                          double *factor)
{
    size_t n = radiator->count;
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            double left = shared(problem, radiator, i, j);
            for (size_t k = 0; k < j; k++)
                left -= factor[i * n + k] * factor[j * n + k];
            double pivot = factor[j * (n + 1)];
            factor[i * n + j] = i == j ? sqrt(fmax(left, 0.0)) : pivot > OWN ? left / pivot : 0.0;
        }
    }
}

/* One more group: an oscillator that the contacts excite by a column of the factor. */
static bool radiation_add_group(struct arena *arena, const struct radiator *radiator,
                                struct oscillators *set, const double *factor, size_t column,
                                struct assembly *assembly, double *residual)
{
    size_t n = assembly->scene.rows;
    double omega = set->omega[0];
    double scale = omega * sqrt(radiator->waves.lag * omega * M_SQRT1_2);
    /* one oscillator for all contacts */
    struct scene_group *group = &assembly->groups[assembly->scene.groups];
    *group = (struct scene_group){.set = set, .body = radiator->body, .count = 1, .stride = LANES};
    group->participation = arena_take(arena, n, sizeof *group->participation);
    if (!group->participation)
        return false;
    /* excited by those that the column holds */
    for (size_t i = column; i < radiator->count; i++) {
        double part = factor[i * radiator->count + column];
        if (part == 0.0)
            continue;
        double *row = arena_take(arena, LANES, sizeof *row);
        if (!row)
            return false;
        row[0] = scale * part;
        group->participation[radiator->contact[i]] = row;
    }
    /* and taken from the residual flexibility */
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            if (group->participation[i] && group->participation[j])
                residual[i * n + j] -=
                    group->participation[i][0] * group->participation[j][0] / (omega * omega);
    assembly->sources[assembly->scene.groups] = NULL;
    assembly->families[assembly->scene.groups] = BODY_MOST_FAMILIES;
    assembly->scene.groups++;
    return true;
}

/* The oscillator's frequency: fast, but not of more compliance than the contacts bear together; a
 * quarter octave of a ladder, so that few are ever made. */
static int frequency_step(const struct radiator *radiator, double together)
{
    double fast = FAST / radiator->duration;
    double most = BORNE * M_SQRT2 / (radiator->waves.lag * radiator->stiffness * together);
    return (int)fmin(ceil(PREPARED_STEPS * log2(fast)), floor(PREPARED_STEPS * log2(most)));
}

/* Error of the radiated share: the oscillator's own, and that of a point's waves for a contact of
 * finite size. */
static double left_out(const struct radiator *radiator, double omega)
{
    double angle = omega * radiator->duration;
    double size = M_PI * radiator->patch / (radiator->waves.transverse * radiator->duration);
    return radiator->loss * fmin(1.0, ERROR / (angle * angle) + size * size);
}

static bool add_radiator(const struct problem *problem, const struct radiator *radiator,
                         struct assembly *assembly, double *residual)
{
    size_t n = radiator->count;
    double together = 0.0;
    double *factor = arena_take(problem->arena, n * n, sizeof *factor);
    if (!factor)
        return false;
    /* how the contacts share the waves */
    factor_shares(problem, radiator, factor);
    /* an oscillator of no more compliance than they bear together */
    for (size_t i = 0; i < n; i++)
        together = fmax(together, felt(problem, radiator, i));
    struct oscillators *set = prepared_radiation_get(
        problem->cache, problem->bodies[radiator->body], frequency_step(radiator, together));
    if (!set)
        return false;
    /* a group of it for each column of the factor */
    for (size_t k = 0; k < n; k++)
        if (!radiation_add_group(problem->arena, radiator, set, factor, k, assembly, residual))
            return false;
    /* e^2 = 1 - share */
    assembly->radiated_error =
        fmax(assembly->radiated_error, 0.5 * left_out(radiator, set->omega[0]));
    return true;
}

bool radiation_add(const struct problem *problem, struct assembly *assembly, double *residual)
{
    double negligible = NEGLIGIBLE * problem->tolerance;
    const struct scene scene = assembly->scene;
    for (size_t b = 0; b < problem->body_count; b++) {
        if (!is_half_space(problem, b))
            continue;
        /* the waves of the contacts on it */
        struct radiator radiator = find_radiator(problem, &scene, b);
        if (radiator.count == 0)
            continue;
        /* oscillators where that matters */
        if (!problem->compliance.still && 0.5 * radiator.loss > negligible) {
            if (!add_radiator(problem, &radiator, assembly, residual))
                return false;
            continue;
        }
        /* omitted viscosity where it does not, or where contacts do not bear oscillators */
        for (size_t i = 0; i < radiator.count; i++)
            assembly->omitted[radiator.contact[i]].viscosity +=
                radiator.waves.lag * felt(problem, &radiator, i);
    }
    return true;
}

bool radiation_is_in(const struct problem *problem, const struct scene *scene)
{
    for (size_t g = 0; g < scene->groups; g++)
        if (is_half_space(problem, scene->group[g].body))
            return true;
    return false;
}

bool radiation_is_shared(const struct problem *problem, const struct scene *scene)
{
    for (size_t g = 0; g < scene->groups; g++) {
        size_t count = 0;
        for (size_t c = 0; c < scene->contacts; c++)
            count += scene->group[g].participation[c] != NULL;
        if (count > 1 && is_half_space(problem, scene->group[g].body))
            return true;
    }
    return false;
}

bool radiation_is_possible(const struct problem *problem)
{
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++)
            if (is_half_space(problem, problem->sides[c][which].body))
                return true;
    return false;
}
