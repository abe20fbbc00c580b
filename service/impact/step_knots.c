/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact/step_knots.h"

#include <math.h>

#include "contact/plastic.h"

/* The forces that are missed act on the approach, and so on themselves: by a tenth or less on a
 * step that a contact's roughness allows. Until the last round changes them by so little. */
enum { ROUNDS = 8 };
static const double SMALL_CHANGE = 1e-2;

/* The only contact on the step. */
struct passage {
    const struct contact_law *law;
    const struct coupling_block *block;
    double compliance;       /* c, in series with it */
    const double *nodes;     /* indentations */
    const double *stiffness; /* of the law at the nodes */
    double least;            /* what a knot adds that counts, N */
    double missed[NODES];    /* force by the moments less force at the node */
};

/* fmax is a call; this is for numbers. */
static double larger(double a, double b)
{
    return a > b ? a : b;
}

/* What a knot adds to the force behind it: a cube of the way from there times what goes like the
 * force's slope. */
static double behind(const struct contact_knot *knot, double d)
{
    double way = d - knot->indentation;
    return knot->cube * (way * way * way) * sqrt(d / knot->indentation);
}

/* A knot is passed at a share of the step. What its force adds behind it, or takes before it, on
 * the shorter side, as the other one is that and a smooth force: by the rule whose places the nodes
 * are, on the cubic through them, divided by a node's weight as a cubic's moments are. */
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

/* The share of the step with an indentation, where straight lines between the nodes have it. */
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

/* All knots that count. False: there is none. */
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

/* By how much forces at the nodes lessen the indentation at one of them, or at the end. What a node
 * has of the compliance itself is in its block. */
static double lessen(const struct passage *passage, int node, const double force[NODES])
{
    const double *by = passage->block->by[node];
    double sum = (by[0] * force[0] + by[1] * force[1]) + (by[2] * force[2] + by[3] * force[3]);
    double stiffness = passage->stiffness[node < NODES ? node : NODES - 1];
    if (node < NODES)
        sum -= passage->compliance * force[node];
    return sum / (1.0 + passage->compliance * stiffness);
}

/* change = missed - F' lessen(change), the law's answer to what they do. */
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

bool step_knots_pass(struct contact_step *step, const struct scene *scene, int level, double start)
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
    /* what the nodes miss, and what that does */
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
