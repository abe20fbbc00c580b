/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_limits.h"

#include <math.h>

/* omega h up to which a step of four nodes resolves a mode. */
static const double RESOLVED = 4.0;

/* Factor of accuracy^(1/5), and what the coupling is at most, so that the audit closes for any
 * accuracy (see the header). */
static const double COUPLING = 3.2;
static const double CLOSEST = 0.25;

/* What a care makes of the accuracy. */
struct care_limits {
    double roughness;      /* factor of accuracy^(2/5) */
    double event, opening; /* of accuracy^(1/2) */
    double roughest;       /* and what they come to at most: a force is a cubic to */
    double longest_event, longest_opening; /* that, shares of a contact's duration */
};

/* With these the steps of a contact leave some 0.1 accuracy^0.8 in the restitution
 * (docs/accuracy.md, error.restitution_time). Of a sequence's contact the steps between tell: those
 * that begin and end it may be twice as long before e changes as much. With the steps of a single
 * blow sequences would be met and wrong three times as often. Rough solutions of sequences of three
 * were within 3e-3 of careful ones. */
static const struct care_limits cares[IMPACT_CARES] = {
    [IMPACT_CARE_SEQUENCE] = {0.6, 4.0, 10.0, 0.02, 0.05, 0.5},
    [IMPACT_CARE_BESIDE] = {0.6, 1.5, 4.0, 0.02, 0.05, 0.5},
    [IMPACT_CARE_SINGLE] = {0.8, 17.0, 42.0, 0.05, 0.2, 0.7},
    [IMPACT_CARE_ROUGH] = {0.6, 20.0, 40.0, 0.1, 0.3, 0.7},
};

/* Of several contacts with a sequence's care, which open and close all the time: a step that misses
 * the beginning or the end of a force like t^(3/2) leaves little beside the others. Of 400 random
 * groups on beams and as many rows of spheres, at accuracies of 1e-4 to 1e-9, these leave as much
 * as a sequence's, by two thirds to four fifths of the steps. */
static const struct care_limits several = {0.6, 30.0, 30.0, 0.02, 0.1, 0.1};
/* Beside the answer a contact begins and ends with steps longer than the answer's projected ones
 * (below): with as long ones the two miss the same. */
static const struct care_limits several_beside = {0.6, 30.0, 30.0, 0.02, 0.4, 0.4};

/* The largest force, on which all depends that flows, takes more care. */
static bool is_elastic_group(const struct scene *scene)
{
    for (size_t c = 0; c < scene->contacts; c++)
        if (scene->laws[c].operations->curve)
            return false;
    return scene->contacts > 1;
}

struct step_limits step_limits_make(const struct scene *scene, double accuracy,
                                    enum impact_care care)
{
    bool sequence = care == IMPACT_CARE_SEQUENCE || care == IMPACT_CARE_BESIDE;
    bool together = sequence && is_elastic_group(scene);
    const struct care_limits *limits = &cares[care];
    if (together)
        limits = care == IMPACT_CARE_BESIDE ? &several_beside : &several;
    double root = pow(accuracy, 0.2);
    double half = sqrt(accuracy);
    return (struct step_limits){
        .roughness = fmin(limits->roughest, limits->roughness * root * root),
        .event_share = fmin(limits->longest_event, limits->event * half),
        .opening_share = fmin(limits->longest_opening, limits->opening * half),
        .coupling = fmin(CLOSEST, COUPLING * root),
    };
}

/* The same where the ends are projected. What is left is most of all what the step after the first
 * one misses of a force that began before it, and goes with the 5/2 power of their share: 1e-8 of
 * the impulse of a sphere on a beam at an eighth. The restitution of sequences there comes half as
 * far from what it converges to as with the other ends, by two steps for three. Not those beside an
 * answer: with the same ends the two agree where both miss a sub-impact, and sequences of eight and
 * more were met and wrong. */
struct projected_ends {
    double end; /* factor of accuracy^(3/10) */
    double longest_event, longest_opening;
};
static const struct projected_ends projected[IMPACT_CARES] = {
    [IMPACT_CARE_SEQUENCE] = {4.0, 0.125, 0.125},
    [IMPACT_CARE_SINGLE] = {12.6, 0.4, 0.7},
    [IMPACT_CARE_ROUGH] = {12.6, 0.4, 0.7},
};

/* Of several contacts with a sequence's care, which begin and end anywhere on each other's steps:
 * the roughness of the others bounds these steps too. Of 200 random groups on beams these leave at
 * tolerances of 1e-3 and 1e-4 what steps an eighth as long leave without projected ends. */
static const struct projected_ends projected_several = {16.0, 0.25, 0.25};

static bool may_project(const struct scene *scene, enum impact_care care)
{
    for (size_t c = 0; c < scene->contacts; c++)
        if (!scene->laws[c].operations->three_halves)
            return false;
    return care != IMPACT_CARE_BESIDE && (scene->contacts == 1 || is_elastic_group(scene));
}

void step_limits_project(struct step_limits *limits, const struct scene *scene,
                         const struct impact_settings *settings)
{
    enum impact_care care = settings->care;
    if (!may_project(scene, care))
        return;
    bool together = scene->contacts > 1 && care == IMPACT_CARE_SEQUENCE;
    const struct projected_ends *ends = together ? &projected_several : &projected[care];
    double share = ends->end * pow(settings->accuracy, 0.3);
    limits->plain[0] = limits->event_share;
    limits->plain[1] = limits->opening_share;
    limits->projected[0] = fmax(limits->event_share, fmin(ends->longest_event, share));
    limits->projected[1] = fmax(limits->opening_share, fmin(ends->longest_opening, share));
}

/* Work of the acceleration on the way to the scale's indentation, over the approach's energy: from
 * here on it counts. With the speed of the approach, indentation over duration, a contact comes
 * back 2 speed/acceleration after its end: here after 40 durations. */
static const double PRESSED = 0.1;

bool step_limits_open(struct step_limits *limits, const struct scene *scene, size_t contact,
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

/* Of one contact, as if the strongest mode of a body were the slowest that its steps do not
 * resolve: a sequence's comparison with longer steps bears no longer ones. */
static double stable_alone(const struct scene_group *group, const double *phi, double stiffness,
                           double coupling)
{
    double largest = 0.0;
    for (size_t k = 0; k < group->count; k++)
        largest = phi[k] * phi[k] > largest ? phi[k] * phi[k] : largest;
    /* phi^2 (dF/dd) h/omega <= coupling with omega = RESOLVED/h; or a step that resolves all */
    double coupled = sqrt(RESOLVED * coupling / (largest * stiffness));
    return fmax(coupled, RESOLVED / group->set->omega[group->count - 1]);
}

/* Of a contact among several, mode by mode: omega h <= RESOLVED or phi^2 (dF/dd) h/omega <=
 * coupling. What stands for all omitted modes of a body at once is strong and far away. */
static double stable_beside(const struct scene_group *group, const double *phi, double stiffness,
                            double coupling)
{
    double longest = INFINITY;
    for (size_t k = 0; k < group->count; k++) {
        double omega = group->set->omega[k];
        double pumped = phi[k] * phi[k] * stiffness;
        if (omega * longest > RESOLVED && pumped * longest > coupling * omega)
            longest = fmax(RESOLVED / omega, coupling * omega / pumped);
    }
    return longest;
}

double step_limits_stable(const struct scene *scene, size_t contact,
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
        longest = fmin(longest, of_group);
    }
    return longest;
}
