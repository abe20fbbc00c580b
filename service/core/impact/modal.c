/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The modal method: in a contact phase the forces at four Gauss nodes of a step are the only
 * unknowns, and the modes follow them exactly. */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/extremes.h"
#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "impact/impact.h"
#include "impact/impact_scale.h"
#include "impact/march.h"
#include "impact/step_ends.h"
#include "impact/yielding.h"

/* ---- Limits of steps ---- */

/* Limits of the modal method's steps for an accuracy. */
struct step_limits {
    /* A force's cubic is accurate enough when its highest Legendre coefficient is this share of the
     * contact's force. The impulse converges with the eighth power of the step, the coefficient
     * with the third, hence about accuracy^(3/8). */
    double roughness;
    /* Largest share of a contact's duration (impact_scale.h) for the step in which it ends: the
     * impulse within it goes with about its 5/2 power, and the end lies between any two nodes. */
    double event_share;
    /* The same for the step in which it begins: the step begins with the contact, and its cubic
     * follows a force like t^(3/2) to a hundredth of the largest. */
    double opening_share;
    /* Both shares, event first, without and with projected ends (step_ends.h). `projected` 0: ends
     * are never projected. */
    double plain[2], projected[2];
    /* See step_limits_stable. 0.5 still closes the audit to 1e-5 over 20 wave passages, 2 does
     * not; 0.02 closes it to 1e-11. */
    double coupling;
};

/* omega h up to which a step of four nodes resolves a mode. */
static const double RESOLVED = 4.0;

/* The coupling is COUPLING accuracy^(1/5) but at most CLOSEST, so that the audit closes for any
 * accuracy (see step_limits). */
static const double COUPLING = 3.2;
static const double CLOSEST = 0.25;

/* Limits of steps for one profile. */
struct profile_limits {
    double roughness;                      /* factor of accuracy^(2/5) */
    double event, opening;                 /* of accuracy^(1/2) */
    double roughest;                       /* their largest values: beyond these a force is */
    double longest_event, longest_opening; /* no cubic; shares of a contact's duration */
};

/* With these the steps of a contact leave an error of some 0.1 accuracy^0.8 in the restitution
 * (docs/lab/accuracy.md, error.restitution_time). In a sequence the steps inside a contact
 * determine it: the first and last one may be twice as long before e changes as much. With the
 * steps of a single impact three times as many sequences would be accepted but wrong. Rough
 * solutions of sequences of three were within 3e-3 of careful ones. */
static const struct profile_limits profiles[STEP_PROFILES] = {
    [STEP_PROFILE_SEQUENCE] = {0.6, 4.0, 10.0, 0.02, 0.05, 0.5},
    [STEP_PROFILE_COMPARED] = {0.6, 1.5, 4.0, 0.02, 0.05, 0.5},
    [STEP_PROFILE_SINGLE] = {0.8, 17.0, 42.0, 0.05, 0.2, 0.7},
    [STEP_PROFILE_ROUGH] = {0.6, 20.0, 40.0, 0.1, 0.3, 0.7},
};

/* For several contacts with a sequence's profile, which open and close all the time: a step that
 * misses the beginning or the end of a force like t^(3/2) adds little to the total error. On 400
 * random groups on beams and as many rows of spheres, at accuracies of 1e-4 to 1e-9, these leave
 * the error of a sequence's limits with two thirds to four fifths of the steps. */
static const struct profile_limits several = {0.6, 30.0, 30.0, 0.02, 0.1, 0.1};
/* For a comparison solution: its first and last steps of a contact are longer than the projected
 * ones (below), as with equal steps both solutions have the same error. */
static const struct profile_limits several_compared = {0.6, 30.0, 30.0, 0.02, 0.4, 0.4};

/* The force of a contact that loses ends with a slope, not like t^(3/2): a step over its end
 * leaves some 0.06 of the square of its share in the impulse. */
static const double PARTING = 1.0;

/* Whether a scene has several contacts, none of which yields or is lossy: yielding depends on the
 * largest force, a loss on the way, and both need more care. */
static bool is_elastic_group(const struct scene *scene)
{
    for (size_t c = 0; c < scene->contacts; c++)
        if (scene->laws[c].operations->curve)
            return false;
    return scene->contacts > 1 && !scene_is_lossy(scene);
}

static struct step_limits step_limits_make(const struct scene *scene, double accuracy,
                                           enum step_profile profile)
{
    bool sequence = profile == STEP_PROFILE_SEQUENCE || profile == STEP_PROFILE_COMPARED;
    bool together = sequence && is_elastic_group(scene);
    const struct profile_limits *limits = &profiles[profile];
    if (together)
        limits = profile == STEP_PROFILE_COMPARED ? &several_compared : &several;
    double root = pow(accuracy, 0.2);
    double half = sqrt(accuracy);
    double event = scene_is_lossy(scene) ? PARTING : limits->event;
    return (struct step_limits){
        .roughness = smaller(limits->roughest, limits->roughness * root * root),
        .event_share = smaller(limits->longest_event, event * half),
        .opening_share = smaller(limits->longest_opening, limits->opening * half),
        .coupling = smaller(CLOSEST, COUPLING * root),
    };
}

/* The same where the ends are projected. Most of the remaining error is in the step after the first
 * one, where the force began before the step. It goes with the 5/2 power of the share: 1e-8 of the
 * impulse of a sphere on a beam at 1/8. The restitution of sequences there has half the error of
 * plain ends, with two steps for three. Comparison solutions have no projected ends: with the same
 * ends the two agree where both miss a sub-impact, and sequences of eight and more were accepted
 * but wrong. */
struct projected_ends {
    double end; /* factor of accuracy^(3/10) */
    double longest_event, longest_opening;
};
static const struct projected_ends projected[STEP_PROFILES] = {
    [STEP_PROFILE_SEQUENCE] = {4.0, 0.125, 0.125},
    [STEP_PROFILE_SINGLE] = {12.6, 0.4, 0.7},
    [STEP_PROFILE_ROUGH] = {12.6, 0.4, 0.7},
};

/* For several contacts with a sequence's profile, which begin and end anywhere on each other's
 * steps: the roughness of the others bounds these steps too. On 200 random groups on beams, at
 * tolerances of 1e-3 and 1e-4, these leave the error of steps an eighth as long with plain ends. */
static const struct projected_ends projected_several = {16.0, 0.25, 0.25};

static bool may_project(const struct scene *scene, enum step_profile profile)
{
    /* the tangential force would have to follow the normal one's correction */
    if (scene->frictions)
        return false;
    for (size_t c = 0; c < scene->contacts; c++)
        if (!scene->laws[c].operations->three_halves)
            return false;
    return profile != STEP_PROFILE_COMPARED && (scene->contacts == 1 || is_elastic_group(scene));
}

/* Allows longer first and last steps where their forces may be projected (step_ends.h): for a
 * single contact, or a group that does not yield. */
static void step_limits_project(struct step_limits *limits, const struct scene *scene,
                                const struct impact_settings *settings)
{
    enum step_profile profile = settings->profile;
    if (!may_project(scene, profile))
        return;
    bool together = scene->contacts > 1 && profile == STEP_PROFILE_SEQUENCE;
    const struct projected_ends *ends = together ? &projected_several : &projected[profile];
    double share = ends->end * pow(settings->accuracy, 0.3);
    limits->plain[0] = limits->event_share;
    limits->plain[1] = limits->opening_share;
    limits->projected[0] = larger(limits->event_share, smaller(ends->longest_event, share));
    limits->projected[1] = larger(limits->opening_share, smaller(ends->longest_opening, share));
}

/* Largest work of the acceleration along the scale's indentation, over the approach's energy, that
 * is negligible. A contact that opens with the speed of the approach, indentation over duration,
 * closes again after 2 speed/acceleration: here 40 durations. */
static const double PRESSED = 0.1;

/* A contact of that scale begins: chooses the shares, and whether its ends are projected. An
 * acceleration that presses closes it again soon after its end; a long step would miss that. */
static bool step_limits_open(struct step_limits *limits, const struct scene *scene, size_t contact,
                             const struct impact_scale *scale)
{
    if (!(limits->projected[0] > 0.0))
        return false;
    double pressing =
        2.0 * fabs(scene->gap_acceleration[contact]) * scale->duration * scale->duration;
    bool projects = pressing <= PRESSED * scale->indentation;
    const double *share = projects ? limits->projected : limits->plain;
    limits->event_share = share[0];
    limits->opening_share = share[1];
    /* in a group from here on */
    if (!projects && scene->contacts > 1)
        limits->projected[0] = 0.0;
    return projects;
}

/* For one contact, as if the strongest mode of a body were the slowest that its steps do not
 * resolve: the comparison solution of a sequence allows no longer steps. */
static double stable_alone(const struct scene_group *group, const double *phi, double stiffness,
                           double coupling)
{
    double largest = 0.0;
    for (size_t k = 0; k < group->count; k++)
        largest = phi[k] * phi[k] > largest ? phi[k] * phi[k] : largest;
    /* phi^2 (dF/dd) h/omega <= coupling with omega = RESOLVED/h; or a step that resolves all */
    double coupled = sqrt(RESOLVED * coupling / (largest * stiffness));
    return larger(coupled, RESOLVED / group->set->omega[group->count - 1]);
}

/* For a contact among several, mode by mode: omega h <= RESOLVED or phi^2 (dF/dd) h/omega <=
 * coupling. The mode that represents a body's omitted modes is strong, its frequency high. */
static double stable_beside(const struct scene_group *group, const double *phi, double stiffness,
                            double coupling)
{
    double longest = INFINITY;
    for (size_t k = 0; k < group->count; k++) {
        double omega = group->set->omega[k];
        double pumped = phi[k] * phi[k] * stiffness;
        if (omega * longest > RESOLVED && pumped * longest > coupling * omega)
            longest = larger(RESOLVED / omega, coupling * omega / pumped);
    }
    return longest;
}

/* The longest step of a contact of that scale, s, that pumps no mode. A mode that the step does not
 * resolve sees the law at four instants only and can be pumped by it. Its coupling to the contact
 * within a step, phi^2 (dF/dd) h / omega, must then stay small. Long contacts on light bodies need
 * this (hundreds of steps); an ordinary impact takes such steps anyway. */
static double step_limits_stable(const struct scene *scene, size_t contact,
                                 const struct impact_scale *scale, double coupling)
{
    double stiffness;
    double longest = INFINITY;
    contact_law_force(&scene->laws[contact], scale->indentation, &stiffness);
    for (size_t g = 0; g < scene->groups; g++) {
        const struct scene_group *group = &scene->group[g];
        const double *phi = group->participation[contact];
        if (!phi || !group->count)
            continue;
        double of_group = scene->contacts > 1 ? stable_beside(group, phi, stiffness, coupling)
                                              : stable_alone(group, phi, stiffness, coupling);
        longest = smaller(longest, of_group);
    }
    return longest;
}

/* ---- Knots of interpolated laws ---- */

/* A step may pass knots of an interpolated law, where the force's third derivative jumps. Four
 * nodes give its moments with an error of the fourth power of the step, those of a smooth force
 * with one of the eighth. The indentation, a double integral of the force, stays smooth enough: the
 * force behind the jumps is evaluated along it, and its moments correct the forces at the nodes. */

/* Corrections of forces act on the approach, and by it on themselves: by a tenth or less on a step
 * that a contact's roughness allows. The last round changes them by less than this share. */
enum { ROUNDS = 8 };
static const double SMALL_CHANGE = 1e-2;

/* The only contact on the step. */
struct passage {
    const struct contact_law *law;
    const struct coupling_block *block;
    double compliance;       /* c, in series with it */
    const double *nodes;     /* indentations */
    const double *stiffness; /* of the law at the nodes */
    double least;            /* a smaller force of a knot is neglected, N */
    double missed[NODES];    /* force by the moments less force at the node */
};

/* Force that a knot adds behind it: a cube of the way from there times a factor like the force's
 * slope. */
static double behind(const struct contact_knot *knot, double d)
{
    double way = d - knot->indentation;
    return knot->cube * (way * way * way) * sqrt(d / knot->indentation);
}

/* Adds a knot that is passed at a share of the step: the moments of the force that it adds behind
 * it or takes before it, on the shorter side; the rest is smooth. Gauss's rule integrates it along
 * the cubic through the nodes; moments over a node's weight are a force at the node. */
static void add_knot(struct passage *passage, const struct contact_knot *knot, double share)
{
    bool before = share < 0.5;
    double length = before ? -share : 1.0 - share;
    const double *nodes = passage->nodes;
    for (int q = 0; q < NODES; q++) {
        double s = share + length * collocation.node[q];
        double by[NODES];
        for (int j = 0; j < NODES; j++) {
            const double *c = collocation.monomial[j];
            by[j] = ((c[3] * s + c[2]) * s + c[1]) * s + c[0];
        }
        double d = (nodes[0] * by[0] + nodes[1] * by[1]) + (nodes[2] * by[2] + nodes[3] * by[3]);
        double force = behind(knot, d) * length * collocation.weight[q];
        for (int j = 0; j < NODES; j++)
            passage->missed[j] += force * by[j] / collocation.weight[j];
    }
    for (int j = 0; j < NODES; j++)
        if ((collocation.node[j] < share) == before)
            passage->missed[j] += before ? behind(knot, nodes[j]) : -behind(knot, nodes[j]);
}

/* The share of the step at an indentation, by straight lines between the nodes. */
static double share_of(const struct passage *passage, const double ends[2], double indentation)
{
    double before = 0.0;
    double d = ends[0];
    for (int j = 0; j <= NODES; j++) {
        double after = j < NODES ? collocation.node[j] : 1.0;
        double next = j < NODES ? passage->nodes[j] : ends[1];
        if ((indentation - d) * (indentation - next) <= 0.0)
            return before + (after - before) * (indentation - d) / (next - d);
        before = after;
        d = next;
    }
    return 1.0;
}

/* Adds all knots that are not negligible. False: there is none. */
static bool add_knots(struct passage *passage, const double ends[2])
{
    const struct plastic_curve *curve = passage->law->operations->curve;
    struct contact_knot knots[CONTACT_KNOTS];
    double from = ends[0];
    bool any = false;
    size_t found;
    do {
        found = curve->knots(passage->law, from, ends[1], knots);
        for (size_t i = 0; i < found; i++) {
            from = knots[i].indentation;
            double way = -larger(-fabs(from - ends[0]), -fabs(ends[1] - from));
            if (!(fabs(knots[i].cube) * (way * way * way) > passage->least))
                continue;
            add_knot(passage, &knots[i], share_of(passage, ends, from));
            any = true;
        }
    } while (found == CONTACT_KNOTS);
    return any;
}

/* Decrease of the indentation at a node, or at the end, by forces at the nodes. The block of a node
 * contains the compliance, which is taken out. */
static double lessen(const struct passage *passage, int node, const double force[NODES])
{
    const double *by = passage->block->by[node];
    double sum = (by[0] * force[0] + by[1] * force[1]) + (by[2] * force[2] + by[3] * force[3]);
    double stiffness = passage->stiffness[node < NODES ? node : NODES - 1];
    if (node < NODES)
        sum -= passage->compliance * force[node];
    return sum / (1.0 + passage->compliance * stiffness);
}

/* Solves change = missed - F' lessen(change) by iteration. */
static bool find_change(const struct passage *passage, double change[NODES])
{
    double most = 0.0;
    for (int j = 0; j < NODES; j++) {
        change[j] = passage->missed[j];
        most = larger(most, fabs(change[j]));
    }
    for (int round = 0; round < ROUNDS; round++) {
        double last = 0.0;
        double less[NODES];
        for (int j = 0; j < NODES; j++)
            less[j] = passage->stiffness[j] * lessen(passage, j, change);
        for (int j = 0; j < NODES; j++) {
            double next = passage->missed[j] - less[j];
            last = larger(last, fabs(next - change[j]));
            change[j] = next;
        }
        if (last <= SMALL_CHANGE * most)
            return true;
    }
    return false;
}

/* After a step of a scene of one contact was solved, which began with an indentation `start`: where
 * it passes knots, the forces at its nodes become those of the cubic with the moments, up to the
 * third, of the law's force, and the indentations at nodes and end those under them. False: it
 * passes none, or is not closed throughout; all stays as it is. */
static bool step_knots_pass(struct contact_step *step, const struct scene *scene, int level,
                            double start)
{
    double *nodes = step->indentation[0];
    struct passage passage = {
        .law = &scene->laws[0],
        .block = coupling_own(&step->coupling, level, 0),
        .compliance = scene->residual[0],
        .nodes = nodes,
        .stiffness = step->stiffness[0],
    };
    double change[NODES];
    /* a law that has knots, in a contact that is closed throughout */
    const struct plastic_curve *curve = passage.law->operations->curve;
    if (!curve || !curve->knots || !(start > 0.0) || !(*step->end_indentation > 0.0))
        return false;
    for (int j = 0; j < NODES; j++)
        if (!(nodes[j] > 0.0))
            return false;
    /* the forces that the nodes miss, and the change that they cause */
    const double ends[2] = {start, *step->end_indentation};
    passage.least = step->last_change * larger(step->force[0][0], step->force[0][NODES - 1]);
    if (!add_knots(&passage, ends) || !find_change(&passage, change))
        return false;
    double less[STEP_POINTS];
    for (int i = 0; i < STEP_POINTS; i++)
        less[i] = lessen(&passage, i, change);
    for (int j = 0; j < NODES; j++) {
        step->force[0][j] += change[j];
        nodes[j] -= less[j];
    }
    *step->end_indentation -= less[NODES];
    return true;
}

/* ---- March of the modal method ---- */

struct modal_run {
    struct march march;
    const struct impact_settings *settings;
    struct step_limits limits;
    struct contact_step step;
    struct yielding yielding;
    struct contact_start *now;   /* [row], local */
    double *depth;               /* [contact], expected at most in this phase; with friction */
    struct impact_scale *scales; /* [contact], of the sub-impact under way */
    double *longest;             /* [contact], stable step, s */
    bool projects;               /* forces where contacts begin and end, step_ends.h */
    int finest;                  /* level that events and grading of the closed contacts need */
};

/* A contact that opens without speed has no duration of its own: its shortest step is that of a
 * contact as long as this share of the horizon. */
static const double SLOWEST_SHARE = 0.01;

/* A step covers at most this share of the time until a contact opens by its present motion. */
static const double SHARE_TO_OPENING = 0.85;

/* A tangential force bends where part of the contact begins or ends to slide: the steps there are
 * shorter by this factor of its roughness. Of any angle of a sphere (test_friction_step.c) the
 * tangential speed is wrong by 6e-4 of the coefficient's at an accuracy of 1e-4 and by 2.5e-4 at
 * 1e-5; with half the factor by 9e-4 and 3e-4, without it by two and ten times as much. */
static const double TANGENTIAL_ROUGHNESS = 10.0;
/* The same while it slides throughout: where the slip turns the force follows later. Of the slips
 * of two_inverse_masses (test_delassus.c) 5e-5 is left at the tolerance of 1e-4, with 1 2e-4. */
static const double SLIDING_ROUGHNESS = 3.0;

/* A contact that opens without speed in a group has no scale of its own: its roughness counts
 * against this share of the group's force. */
static const double SHARE_OF_GROUP = 0.01;

/* Half a step has an eighth of the roughness, a coefficient of the third power. A step is rejected
 * beyond nearly the geometric middle of the two: the next are shorter anyway. */
static const double LONGER_ROUGHER = 8.0;
static const double TOO_ROUGH = 3.0;

enum {
    /* Levels that roughness may add: a graze may be 2^11 shorter than its scale. */
    GRAZE_LEVELS = 11,
    /* A step takes two or three iterations; so many iterations count as one more step. */
    ITERATIONS_PER_STEP = 8
};

/* Finds the finest level anew after a change of the closed contacts or of their scales. */
static void find_finest(struct modal_run *run)
{
    double shortest = SLOWEST_SHARE * run->march.horizon;
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        if (run->march.closed[c])
            shortest = smaller(shortest, run->scales[c].duration);
    run->finest = step_level(shortest * run->limits.event_share);
}

/* Laws have yielded: their contacts take the scale of the unloading branches, which are shorter,
 * stiffest at the top and store less energy; the speed goes with its root. */
static void rescale(struct modal_run *run)
{
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        struct impact_scale *scale = &run->scales[c];
        double span = contact_law_limit(&run->march.scene.laws[c]);
        double force = run->march.scene.laws[c].history.max_force;
        if (!run->march.closed[c] || !(force > 0.0) || !(span < scale->indentation))
            continue;
        double slower = sqrt(force * span / (scale->force * scale->indentation));
        scale->duration *= span / (scale->indentation * slower);
        scale->indentation = span;
        scale->force = force;
        run->longest[c] = step_limits_stable(&run->march.scene, c, scale, run->limits.coupling);
    }
    find_finest(run);
}

/* Laws have yielded. False: an unloading branch is too stiff for the series compliance. */
static bool unload(struct modal_run *run)
{
    rescale(run);
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        if (!contact_bears(&run->march.scene, c, contact_law_unloading(&run->march.scene.laws[c])))
            run->march.outcome->too_stiff = true;
    return !run->march.outcome->too_stiff;
}

/* A sub-impact of a contact begins at `time` with an approach rate. */
static void open_contact(struct modal_run *run, size_t contact, double time, double rate)
{
    struct march *march = &run->march;
    if (run->step.way)
        way_contact_touch(&run->step.way->contact[contact], time);
    run->scales[contact] = impact_scale_of(&march->scene, contact, rate);
    run->projects = step_limits_open(&run->limits, &march->scene, contact, &run->scales[contact]);
    run->longest[contact] =
        step_limits_stable(&march->scene, contact, &run->scales[contact], run->limits.coupling);
    march_open(march, contact, time, march->outcome->motion.gap_rate[contact]);
    find_finest(run);
}

static bool is_lossy(const struct modal_run *run, size_t contact)
{
    return run->step.way && run->march.scene.laws[contact].operations->lossy;
}

/* It ends at `time`; the motion is a little later. One whose force depends on its way has parted
 * before, while other contacts went on (keep_way). */
static void close_contact(struct modal_run *run, size_t contact, double time)
{
    struct march *march = &run->march;
    const struct motion *motion = &march->outcome->motion;
    double since = march->scene.gap_acceleration[contact] * (motion->time - time);
    if (is_lossy(run, contact))
        march_close(march, contact, run->step.way->contact[contact].parted_at,
                    march->outcome->tracks[contact].open.gap_rate_after);
    else
        march_close(march, contact, time, motion->gap_rate[contact] - since);
    find_finest(run);
}

/* A step must not jump over a contact's end, nor pump a mode, nor pass the horizon. */
static int limit_level(const struct modal_run *run, int level, int finest)
{
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        if (!run->march.closed[c])
            continue;
        double left = smaller(run->longest[c], SHARE_TO_OPENING * step_values_opens(run->now + c));
        while (level < finest && step_length(level) > left)
            level++;
    }
    double remaining = run->march.horizon - run->march.outcome->motion.time;
    while (level < STEP_LEVELS - 1 && step_length(level) > remaining)
        level++;
    return level;
}

/* The largest scale of a contact that is closed; 0 where there is but one contact. */
static double group_force(const struct modal_run *run)
{
    double group = 0.0;
    for (size_t c = 0; run->march.scene.contacts > 1 && c < run->march.scene.contacts; c++)
        if (run->march.closed[c])
            group = larger(group, run->scales[c].force);
    return group;
}

/* Reference force of a contact's roughness: its scale, or its force on the step. */
static inline double force_scale(const struct modal_run *run, size_t contact, double group)
{
    const double *force = run->step.force[contact];
    double own = larger(larger(force[0], force[1]), larger(force[2], force[3]));
    own = larger(own, run->scales[contact].force);
    return larger(own, SHARE_OF_GROUP * group);
}

/* The highest coefficient of a force's cubic. `to_end`: or what it misses of the force at the end,
 * as where a contact of a group closes after the last node. */
static inline double rough_part(const struct modal_run *run, size_t row, bool to_end)
{
    const double *force = run->step.force[row];
    double highest = 0.0;
    for (int j = 0; j < NODES; j++)
        highest += collocation.highest[j] * force[j];
    double off = to_end ? run->step.end_force[row] - collocation_last(force) : 0.0;
    return larger(fabs(highest), fabs(off));
}

/* What the roughness of a tangential force counts for. Where a contact slides throughout the force
 * follows the normal one and turns; else micro-slip's may bend at any instant, and plain friction's
 * where some points stick and others slide. Where a slide ends the slope jumps: half a step has
 * half of that, so the step itself must be short enough. */
static double tangential_factor(const struct modal_run *run, size_t friction)
{
    const struct friction_step *step = run->step.friction;
    const double *stuck = step->stuck[friction];
    if (run->march.scene.plain) {
        bool same = stuck[0] == stuck[1] && stuck[1] == stuck[2] && stuck[2] == stuck[3];
        return same ? 1.0 : TANGENTIAL_ROUGHNESS;
    }
    if (!friction_step_slid(step, friction))
        return TANGENTIAL_ROUGHNESS;
    return friction_step_slides(step, friction) ? SLIDING_ROUGHNESS
                                                : TOO_ROUGH * TANGENTIAL_ROUGHNESS;
}

/* Of the tangential forces, which bend where part of a contact begins or ends to slide, over their
 * limits, as far as their error counts. They may bend after the last node: there the cubic misses
 * the force at the end. */
NOT_INLINE static double tangents_roughness(const struct modal_run *run, double group)
{
    const struct scene *scene = &run->march.scene;
    double worst = 0.0;
    for (size_t i = 0; i < scene->frictions; i++) {
        const struct scene_friction *friction = &scene->friction[i];
        double limit = friction->coefficient * force_scale(run, friction->contact, group);
        double rounding = friction_step_rounding(run->step.friction, i);
        double factor = tangential_factor(run, i);
        for (size_t t = 0; t < 2; t++) {
            double rough = rough_part(run, scene_tangent(scene, i) + t, true);
            worst = larger(worst, factor * (rough - rounding) / limit);
        }
    }
    return worst;
}

/* Its largest share of the contacts' forces. */
static double step_roughness(const struct modal_run *run)
{
    double worst = 0.0;
    size_t contacts = run->march.scene.contacts;
    double group = group_force(run);
    for (size_t c = 0; c < contacts; c++)
        worst = larger(worst, rough_part(run, c, contacts > 1) / force_scale(run, c, group));
    if (run->march.scene.frictions)
        worst = larger(worst, tangents_roughness(run, group));
    return worst;
}

/* Whether the force of any contact that depends on its way bends. */
NOT_INLINE static bool any_bends(const struct modal_run *run)
{
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        if (way_contact_bends(&run->step.way->contact[c]))
            return true;
    return false;
}

/* The only closed contact ends inside the step: the step is cut there, as its force has no
 * derivative there. While several are closed they open and close all the time, mostly with little
 * force: all of them are in the equations throughout, and roughness alone decides. */
static bool has_event(const struct modal_run *run)
{
    size_t closed = 0;
    bool ends = false;
    if (run->step.way)
        return any_bends(run);
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        closed += run->march.closed[c];
        ends = ends || (run->march.closed[c] && !(run->step.end_indentation[c] > 0.0));
    }
    return closed == 1 && ends;
}

/* Whether a contact bears a force at any node of the step. */
static bool bears(const struct modal_run *run, size_t contact)
{
    for (int j = 0; j < NODES; j++)
        if (run->step.force[contact][j] > 0.0)
            return true;
    return false;
}

/* The work on a contact's rigid gap during a step that has been taken. */
static void keep_work(struct modal_run *run, size_t contact, double h)
{
    const struct scene *scene = &run->march.scene;
    const double *w = scene->w + contact * scene->rows;
    double rate[NODES];
    for (int i = 0; i < NODES; i++) {
        rate[i] = run->march.outcome->motion.gap_rate[contact];
        for (size_t r = 0; r < scene->rows; r++)
            for (int j = 0; j < NODES; j++)
                rate[i] -= w[r] * h * (collocation.weight[j] - collocation.velocity[i][j]) *
                           run->step.force[r][j];
    }
    track_work(&run->march.outcome->tracks[contact], h, run->step.force[contact], rate);
}

/* Of a contact's friction. */
NOT_INLINE static void keep_slide(struct modal_run *run, size_t contact, double h)
{
    const struct scene *scene = &run->march.scene;
    size_t friction = scene_friction_of(scene, contact);
    if (friction == scene->frictions)
        return;
    keep_work(run, contact, h);
    track_slide(&run->march.outcome->tracks[contact], h, run->step.force[contact],
                run->step.force + scene_tangent(scene, friction),
                run->step.friction->stuck[friction]);
}

/* The instant at which the contact ended on a step that began at `start`. */
static double end_of(const struct modal_run *run, const struct step_values *step, double start,
                     double h)
{
    return start + h * (run->projects ? step_ends_release : step_values_release)(step);
}

/* The books of a contact whose force depends on its way: it may part before its indentation ends.
 */
NOT_INLINE static void keep_way(struct modal_run *run, size_t c, double start)
{
    const struct way_contact *way = &run->step.way->contact[c];
    const struct motion *motion = &run->march.outcome->motion;
    struct track *track = &run->march.outcome->tracks[c];
    if (!is_lossy(run, c))
        return;
    way_step_take(run->step.way, c, start);
    if (!run->march.closed[c])
        return;
    track->largest_force = way->largest;
    track->open.start = way->touched_at;
    if (way->parted_at >= start)
        track->open.gap_rate_after = motion->gap_rate[c] - run->march.scene.gap_acceleration[c] *
                                                               (motion->time - way->parted_at);
}

/* The books of one contact after a step: sub-impacts begin, go on, end (also all of it within one
 * step of a group). */
static void keep_books(struct modal_run *run, size_t c, double start, double h)
{
    double end = run->step.end_indentation[c];
    const struct step_values step = {run->now[c].indentation, end, run->step.indentation[c]};
    struct track_values values = {step.start, end, step.nodes, run->step.force[c],
                                  run->step.stiffness[c]};
    struct contact_start after = step_values_after(&step, h);
    if (!run->march.closed[c] && (end > 0.0 || bears(run, c)))
        open_contact(run, c, start + h * step_values_closing(&step),
                     larger(run->now[c].rate, after.rate));
    if (run->step.way)
        keep_way(run, c, start);
    if (run->march.closed[c]) {
        track_step(&run->march.outcome->tracks[c], start, h, &values);
        if (run->march.scene.frictions)
            keep_slide(run, c, h);
        if (end <= 0.0)
            close_contact(run, c, end_of(run, &step, start, h));
    }
    run->now[c] = after;
}

/* Corrects the forces at the nodes where contacts begin or end, and at a single law's knots. */
static void correct_forces(struct modal_run *run, int level)
{
    const struct scene *scene = &run->march.scene;
    bool corrected = run->projects && step_ends_project_all(scene, run->now, &run->step);
    if (!corrected && scene->contacts == 1)
        corrected = step_knots_pass(&run->step, scene, level, run->now[0].indentation);
    if (corrected)
        run->step.loss =
            contact_step_loss(scene, &run->march.outcome->motion, level, run->step.force);
}

/* Makes the step just solved the present. */
static void accept(struct modal_run *run, int level)
{
    struct impact_outcome *outcome = run->march.outcome;
    double start = outcome->motion.time;
    if (run->projects || (run->yielding.any && run->march.scene.contacts == 1))
        correct_forces(run, level);
    if (run->settings->log)
        force_log_add(run->settings->log, start, level, run->step.force, run->step.indentation,
                      run->march.scene.contacts, outcome->tracks);
    contact_step_take(&run->step, &run->march.scene, &outcome->motion);
    run->march.damping += run->step.loss;
    outcome->steps++;
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        keep_books(run, c, start, step_length(level));
    for (size_t r = run->march.scene.contacts; r < run->march.scene.rows; r++) {
        const struct step_values values = {run->now[r].indentation, run->step.end_indentation[r],
                                           run->step.indentation[r]};
        run->now[r] = step_values_after(&values, step_length(level));
    }
}

/* Indentation under twice the load of an acceleration that presses: as far as it swings. */
static double pressed(const struct scene *scene, size_t contact)
{
    const struct contact_law *law = &scene->laws[contact];
    double load = -2.0 * scene->gap_acceleration[contact] / scene->w[contact * (scene->rows + 1)];
    return load > 0.0 ? law->operations->indentation(law, load) : 0.0;
}

/* The tangents at the beginning of a phase: contacts of a group may close at any instant of it. */
NOT_INLINE static void begin_friction(struct modal_run *run)
{
    const struct scene *scene = &run->march.scene;
    const struct motion *motion = &run->march.outcome->motion;
    double fastest = 0.0, at[SCENE_MOST_ROWS], rates[SCENE_MOST_ROWS];
    for (size_t c = 0; c < scene->contacts; c++) {
        fastest = larger(fastest, fabs(run->now[c].rate));
        at[c] = run->now[c].indentation;
        rates[c] = run->now[c].rate;
    }
    for (size_t r = scene->contacts; r < scene->rows; r++) {
        motion_approach(motion, scene, r, &at[r], &rates[r]);
        run->now[r] = (struct contact_start){at[r], rates[r], 0.0, 0.0};
        memset(run->step.force[r], 0, sizeof run->step.force[r]);
    }
    for (size_t c = 0; c < scene->contacts; c++)
        run->depth[c] = larger(impact_scale_of(scene, c, fastest).indentation, pressed(scene, c));
    friction_step_begin(run->step.friction, scene, motion->time, at, rates, run->depth);
}

/* The touch that ended the flight, and starting values of the contacts that are still open. */
static void begin_phase(struct modal_run *run, size_t contact)
{
    const struct motion *motion = &run->march.outcome->motion;
    for (size_t c = 0; c < run->march.scene.contacts; c++) {
        double d, rate;
        motion_approach(motion, &run->march.scene, c, &d, &rate);
        run->now[c] = (struct contact_start){c == contact ? 0.0 : smaller(d, 0.0), rate, 0.0, 0.0};
        if (c == contact)
            open_contact(run, c, motion->time, rate);
        if (run->step.way)
            way_contact_begin(&run->step.way->contact[c], motion->time, run->now[c].indentation,
                              c == contact);
    }
    if (run->march.scene.frictions)
        begin_friction(run);
}

/* Whether a step is too long: it is rough, or the only contact ends within it. */
static bool is_coarse(const struct modal_run *run, double roughness)
{
    return roughness > TOO_ROUGH * run->limits.roughness || has_event(run);
}

/* The level after an accepted step. */
static int next_level(const struct modal_run *run, int level, double roughness)
{
    if (roughness < run->limits.roughness / LONGER_ROUGHER && level > 0)
        return level - 1;
    return roughness > run->limits.roughness ? level + 1 : level;
}

/* The level that a phase begins with: contacts of a group close within its steps. */
static int first_level(const struct modal_run *run)
{
    if (run->march.scene.contacts > 1)
        return run->finest;
    int level = step_level(run->scales[0].duration * run->limits.opening_share);
    return level < run->finest ? level : run->finest;
}

/* Solves the step of a level and counts the work. */
static enum contact_step_end solve_step(struct modal_run *run, int level)
{
    unsigned long before = run->step.iterations;
    enum contact_step_end end = contact_step_solve(&run->step, &run->march.scene,
                                                   &run->march.outcome->motion, level, run->now);
    run->march.used += (run->step.iterations - before) / ITERATIONS_PER_STEP;
    return end;
}

/* At the horizon. Contacts may have parted, though their surfaces have not come back
 * yet: without vibration nothing brings them together again. */
static enum percuss_end_reason end_at_horizon(struct modal_run *run)
{
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        if (run->march.closed[c] && is_lossy(run, c) && run->step.way->contact[c].parted)
            close_contact(run, c, run->march.horizon);
    if (march_in_contact(&run->march))
        return PERCUSS_END_IN_CONTACT;
    return run->march.scene.groups > 0 ? PERCUSS_END_HORIZON : march_parted(&run->march);
}

/* Steps until every contact is open again, the horizon, or the limit. */
static enum percuss_end_reason go_through(struct modal_run *run)
{
    struct march *march = &run->march;
    int level = first_level(run);
    while (march_in_contact(march)) {
        if (++march->used > march->most || !pace_keeps(march->pace, march->cost))
            return PERCUSS_END_LIMIT;
        /* the length of the next step */
        int finest = run->finest;
        int deepest = finest + GRAZE_LEVELS < STEP_LEVELS ? finest + GRAZE_LEVELS : STEP_LEVELS - 1;
        level = limit_level(run, level < deepest ? level : deepest, finest);
        if (run->yielding.any)
            level = yielding_level(&run->yielding, level);
        double h = step_length(level), time = march->outcome->motion.time;
        if (time + h == time || march->horizon - time < step_length(deepest))
            return end_at_horizon(run);
        /* a step without a solution, or too coarse, is tried again with half its length */
        enum contact_step_end end = solve_step(run, level);
        if (end == STEP_MEMORY)
            return march_fail(march, PERCUSS_INTERNAL);
        bool solved = end == STEP_SOLVED;
        double roughness = solved ? step_roughness(run) : INFINITY;
        if (!solved || (level < finest && is_coarse(run, roughness))) {
            if (level >= (solved ? STEP_LEVELS - 1 : deepest))
                return PERCUSS_END_LIMIT;
            march->outcome->rejected++;
            level++;
            continue;
        }
        /* a step that passes the instant at which a law changes is solved again */
        if (run->yielding.any && yielding_passes(&run->yielding, h, &level)) {
            if (!unload(run))
                return PERCUSS_END_LIMIT;
            march->outcome->rejected++;
            continue;
        }
        /* an accepted step: the next is as long as its roughness allows */
        accept(run, level);
        level = next_level(run, level, roughness);
        if (run->yielding.any && yielding_meet(&run->yielding, h, &level) && !unload(run))
            return PERCUSS_END_LIMIT;
    }
    return PERCUSS_END_NONE;
}

/* From the first touch on. */
static enum percuss_end_reason contact_phase(void *state, size_t contact)
{
    struct modal_run *run = state;
    begin_phase(run, contact);
    enum percuss_end_reason end = go_through(run);
    contact_step_leave(&run->step, &run->march.scene, &run->march.outcome->motion);
    return end;
}

/* Loss and store of the friction, and the tangents' forces. */
static void end_friction(struct modal_run *run)
{
    const struct scene *scene = &run->march.scene;
    struct impact_outcome *outcome = run->march.outcome;
    for (size_t i = 0; i < scene->frictions; i++) {
        const struct friction_step *friction = run->step.friction;
        outcome->slid += friction_step_lost(friction, i);
        if (!run->march.closed[scene->friction[i].contact])
            continue;
        outcome->sheared += friction_step_stored(friction, i);
        friction_step_force(friction, i, run->march.tangential + 2 * i);
    }
}

/* Contacts whose force depends on their way have lost the work on it, but for what they give back.
 */
static void end_way(struct modal_run *run)
{
    if (!run->step.way)
        return;
    run->march.outcome->relaxed = way_step_lost(run->step.way, run->march.indentation);
    run->march.force = run->step.way->present;
}

/* The window ends: contacts under load yield up to here, and all store their indentation. */
static void end_march(void *state)
{
    struct modal_run *run = state;
    yielding_end(&run->yielding);
    for (size_t c = 0; c < run->march.scene.contacts; c++)
        run->march.indentation[c] = run->march.closed[c] ? run->now[c].indentation : 0.0;
    end_friction(run);
    end_way(run);
}

static bool run_create(struct modal_run *run, struct arena *arena)
{
    const struct scene *scene = &run->march.scene;
    if (!march_create(&run->march, arena))
        return false;
    run->now = arena_take(arena, scene->rows, sizeof *run->now);
    if (scene->frictions)
        run->depth = arena_take(arena, scene->contacts, sizeof *run->depth);
    run->scales = arena_take(arena, scene->contacts, sizeof *run->scales);
    run->longest = arena_take(arena, scene->contacts, sizeof *run->longest);
    run->yielding = (struct yielding){.scene = scene,
                                      .outcome = run->march.outcome,
                                      .step = &run->step,
                                      .now = run->now,
                                      .closed = run->march.closed,
                                      .scales = run->scales,
                                      .accuracy = run->settings->accuracy};
    if (!run->now || (scene->frictions && !run->depth) || !run->scales || !run->longest ||
        !contact_step_create(&run->step, scene, run->settings->accuracy, arena) ||
        !yielding_create(&run->yielding, arena))
        return false;
    run->step.pace = run->march.pace;
    step_limits_project(&run->limits, scene, run->settings);
    return true;
}

enum percuss_status impact_modal(const struct scene *scene, const struct impact_settings *settings,
                                 struct arena *arena, struct impact_outcome *outcome)
{
    static const struct march_method method = {.contact_phase = contact_phase, .end = end_march};
    struct modal_run run = {.march = {.stated = scene,
                                      .outcome = outcome,
                                      .horizon = settings->horizon,
                                      .accuracy = settings->accuracy,
                                      .most = impact_max_steps(scene, settings),
                                      .pace = settings->pace},
                            .settings = settings,
                            .limits =
                                step_limits_make(scene, settings->accuracy, settings->profile)};
    return run_create(&run, arena) ? march_run(&run.march, &method, &run, arena) : PERCUSS_INTERNAL;
}
