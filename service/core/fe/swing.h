/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The swing of an impact's restitution with the places of a mesh's nodes.
 *
 * Nodes close one by one. As they are moved by an element against the patch's rim (the phase of
 * complete_problem, region_input) e swings once about its mean, nearly as a sine, where material
 * flows by +-0.02 on 4 elements across the patch and by +-0.006 on 8. A single mesh may lie
 * anywhere on that swing, and two or three may agree by chance. Evenly spread phases know the mean:
 * n of them are wrong only by the swing's harmonics n, 2n, ... */
#ifndef PERCUSS_FE_SWING_H
#define PERCUSS_FE_SWING_H

enum { SWING_PHASES = 6 };

/* Restitution on meshes of one fineness, at even phases: three of them, or six. */
struct swing {
    unsigned cells;
    unsigned phases;                  /* solved: 3 or 6; phase k / phases */
    double restitution[SWING_PHASES]; /* by phase */
    double mean;
    double width;  /* between the phases' extremes */
    double jitter; /* estimated error of the mean, as that of the limit of many phases */
};

/* The swing is a first-order effect of the element size where material flows; its mean is off by a
 * part of it, which two means may hide by coming close on their way: of 13 scenes
 * (docs/lab/complete-fe.md) by 1/12 at most, against meshes three and four times as fine. */
static const double SWING_IN_MEAN = 1.0 / 12.0;

/* Fills mean, width and jitter from the phases. */
void swing_judge(struct swing *swing);

/* Weights of the phases, their sum 1: as even as the mean `wanted` allows; tilted that way until
 * one vanishes where it lies too far from the mean. */
void swing_weigh(const struct swing *swing, double wanted, double weights[SWING_PHASES]);

/* Two phases, in order, and e less the wanted value there, of different signs. */
struct swing_bracket {
    double phase[2], off[2];
};

/* Phase, 0 ... 1, at which e goes through `wanted`, by the trigonometric polynomial through the
 * phases, and the two phases around it; NAN where `wanted` lies outside of them. */
double swing_phase(const struct swing *swing, double wanted, struct swing_bracket *bracket);

/* Replaces one end of the bracket by the value found at a phase: the line through both ends gives
 * the next phase. */
double swing_narrow(struct swing_bracket *bracket, double phase, double off);

#endif
