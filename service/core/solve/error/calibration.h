/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* The numbers of the error estimates. Each was set by a campaign of random scenes against converged
 * solutions, finite elements or an independent solver; the comment above a group names the command
 * that prints the campaign anew, and docs/lab/accuracy.md has its tables. */
#ifndef PERCUSS_SOLVE_ERROR_CALIBRATION_H
#define PERCUSS_SOLVE_ERROR_CALIBRATION_H

/* ---- Modes and time steps: build/tests/estimates --class CLASS --count N ---- */

/* Shares of the tolerance: of modes, with the rest for steps; and of both where one comparison
 * covers both. */
static const double SHARE_MODES = 0.7;
#define SHARE_STEPS (1.0 - SHARE_MODES)
static const double SHARE_BOTH = 0.9;

/* True error over the largest difference between solutions of a sequence: below 2 for 19 of 20
 * random sequences of every class. Of vibration that begins otherwise (state.c) it covers 99 % of
 * 400 random chains. */
static const double FACTOR_COMPARED = 3.0;
/* True error over the first-order effect of the omitted modes: below 2 for 98 of 100 random scenes,
 * of single impacts and of sequences. */
static const double FACTOR_FIRST_ORDER = 2.5;
/* True error over the difference to the solution with fewer modes: below a tenth where errors grow
 * evenly, 1 where they have reached their range; half covers all of some hundred random sequences
 * of ten sub-impacts and more. */
static const double FACTOR_FEWER = 0.5;

/* First-order effect of the omitted modes, in tolerances, that the first attempt may have: of a
 * single impact, and of a sequence, which amplifies it five- to twentyfold as a rule. */
static const double FIRST_MODES_SINGLE = 0.2;
static const double FIRST_MODES_SEQUENCE = 0.02;
/* And its largest value, of one impact's restitution: with fewer modes these do not follow the
 * force slowly, and the next better model says little of them all; least of a contact in a group
 * that hardly approaches. */
static const double MOST_MODES_SINGLE = 4e-4;
static const double MOST_MODES_SEQUENCE = 1e-4;
static const double MOST_MODES_GROUP = 2e-5;
/* Share of the tolerance at which the next attempt aims. */
static const double AIM = 0.5;
/* Times the effect of the omitted modes that the solution with fewer modes has. */
static const double FEWER_MODES = 10.0;

/* Accuracy of the first time steps, in tolerances: of a single impact, of a sequence, and where
 * contacts open and close within steps, the audit must close, or only steps tell their error. And
 * its largest value. */
static const double FIRST_STEPS_SINGLE = 0.1;
static const double FIRST_STEPS_SEQUENCE = 0.01;
static const double FIRST_STEPS_FINE = 1e-3;
static const double MOST_STEPS_SEQUENCE = 1e-5;
static const double MOST_STEPS_GROUP = 1e-6;
/* Times the accuracy that longer steps have, for comparison. */
static const double LONGER_STEPS = 100.0;
/* Steps of an accuracy leave LEFT accuracy^LEFT_POWER of one impact's e. */
static const double STEPS_LEFT = 0.1;
static const double STEPS_LEFT_POWER = 0.8;
/* The same of a tangential impulse besides, over the coefficient times the impulse of compression,
 * by the accuracy's root: cells, and bends of the force (tests/unit/impact/test_friction_step.c).
 * Elastic balls leave 0.04, such that yield, whose cells move, up to 0.1 (estimates --class
 * oblique). */
static const double FRICTION_LEFT = 0.1;
/* The same of modes left out where plain friction sticks to a body that vibrates: a contact without
 * compliance answers to each of them, and the force converges slowly. 98 of 100 scenes leave less,
 * the worst twice as much, at a tolerance of 1e-2 (estimates --class oblique --plain). */
static const double PLAIN_MODES_LEFT = 0.01;
/* Root of the accuracy of the first steps of a contact with friction, in tolerances: the tangential
 * speed is right to the tolerance of the coefficient's (tests/physics/test_oblique.c). */
static const double FRICTION_STEPS = 3.0;
/* Share of what a contact's force moves it by that tangential forces at their limits may: the
 * errors of normal forces, found without them, are then wrong by as much. */
static const double WEAK_FRICTION = 0.1;
/* Of the energy, what the cells' books of it miss, by the accuracy's root: it is none of the normal
 * force's. */
static const double FRICTION_BOOKS = 0.04;
/* Root of the accuracy of the steps of solutions with other coefficients, over the coefficients'
 * relative deviation: they leave a sixtieth of its effect (FRICTION_LEFT). */
static const double PERTURBED_FRICTION = 1.0 / 6.0;
/* A tolerance that demands an energy audit of a tenth of it; others close to CLOSURE tolerances. */
static const double TOLERANCE_AUDITED = 1e-8;
static const double CLOSURE = 10.0;
/* The audit's defect counts so many times. */
static const double DEFECT_FACTOR = 4.0;
/* Tolerances below which longer steps are tried for comparison of single impacts, too. */
static const double TOLERANCE_COMPARED = 1e-5;
/* Steps leave less than this of e of 98 of 100 random sequences where the omitted modes do not
 * tell: from 10 times it on first order along the answer says the error of a sequence with the
 * usual steps; down to the least tolerance that it fits into with fine ones, which cost less than
 * another solution. */
static const double STRAY = 6e-5;
#define TOLERANCE_FOLLOWED      (10.0 * STRAY)
#define TOLERANCE_FOLLOWED_FINE (STRAY / SHARE_BOTH)

/* A sequence amplifies strongly if e changes by so many times the effect of the omitted modes (10
 * and less are the rule). */
static const double STRONG = 30.0;
/* A share that counts as nothing: of the tolerance, an effect of omitted modes; of a group's
 * largest impulse of compression, that of a contact, which others strike then; of a half-space's
 * waves, those that a body leaves (a fast impact loses a per cent of e to all of them). */
static const double NEGLIGIBLE = 0.01;
/* A contact is struck by others if its restitution is larger (they give it a fifth of its impulse
 * and more). */
static const double STRUCK = 1.5;
/* Least restitution that a loss of energy is counted against. */
static const double LEAST_REBOUND = 0.1;

/* Change of a sub-impact's impulse up to which first order holds: for omitted modes within 2 % of
 * random sequences; for the models within a quarter of perturbed solutions of 350 random sequences,
 * of groups within a tenth for nine in ten of 115, and second order no less than 0.7 of them for
 * all but one of 103. */
static const double STRAIN_MODES = 0.1;
static const double STRAIN_MODELS = 0.05;
static const double STRAIN_MODELS_GROUP = 0.2;
static const double STRAIN_MODELS_CURVED = 0.5;

/* ---- Models: build/tests/models, build/tests/sides, ctest -R independent/campaign ---- */

/* Change of e per unit of the stiffness's logarithm, of a single contact: by the share s of the
 * energy that vibrates, at most LOST s + SWUNG sqrt(s) of 97 in 100 random bars (waves that leave;
 * a mode that the contact catches in its swing). */
static const double LOST = 0.3;
static const double SWUNG = 0.2;
/* Accuracy of the steps of perturbed solutions: they say e to 2 % of 7 in 8 random scenes. */
static const double PERTURBED_STEPS = 1e-3;
static const double PERTURBED_STEPS_GROUP = 1e-4;
/* Between the answer and perturbed ones e may lie outside of theirs. */
static const double BETWEEN = 1.5;
/* No impulse is known better than by this share of the largest relative change of any. */
static const double AGREED = 0.2;

/* Estimates of a mean, times this, are exceeded by one of twenty: bending of rigid bodies (half a
 * sine holds less of the spectrum than Hertz's force), and size and shape of contacts that flow. */
static const double MEAN_TO_MOST = 1.25;
/* Hertz's parabolas and half-spaces: share of the force by (half-axis / radius)^2. */
static const double PATCH = 0.3;

/* Unknown regular compliance, times E and the body's radius: where it is matched; of a rod's end
 * on a half-space (-0.59 of it); of a beam's side; of the same without shear; of a body that is
 * rigid but for its contact (-0.3 of a sphere). */
static const double UNKNOWN_MATCHED = 0.03;
/* Of a mesh along its surface, as its file says it: between sites twice as far off as along the
 * normal (tests/unit/reduce/test_sites.c), on narrow faces of few elements three times. */
static const double UNKNOWN_ALONG = 0.1;
static const double UNKNOWN_HALF_SPACE = 0.8;
static const double UNKNOWN_SIDE = 0.6;
static const double UNKNOWN_WITHOUT_SHEAR = 1.0;
static const double UNKNOWN_COMPACT = 0.3;
/* Of a beam's side more by the square of the distance from the axis over half the breadth; nearer
 * to an edge than the fit goes, by (half thickness / distance) beyond that; and near an end, by the
 * square of that. */
static const double SIDE_ASIDE = 0.08;
static const double SIDE_EDGE = 0.2;
static const double SIDE_END = 0.05;
/* No contact counts as nearer to an edge than this, half thicknesses. */
static const double NEAREST_EDGE = 0.05;
/* Of a mesh nearer to a sharp edge than an element, times E and the distance: neighbouring points
 * of a wall of one element differ by so much (there an edge itself is worth 0.27). */
static const double NEAR_MESH_EDGE = 0.5;
/* Frequencies of a bar's theory, share by r = radius / way of a wave during the contact: r^2 for
 * rods and for beams with Hutchinson's shear factor (1e-3 at 29 kHz of a bar of 10 mm), r^2 times
 * this for rods with lateral inertia; r times this for beams with Cowper's factor (1e-2 there) and
 * without shear, where the error goes with the wave number's square, that is with the frequency. */
static const double THEORY_RAYLEIGH_LOVE = 0.5;
static const double THEORY_COWPER = 0.25;
static const double THEORY_WITHOUT_SHEAR = 5.0;
/* A clamp in three dimensions holds a section's own deformation, too: near it a bar is stiffer than
 * its theory, by the square of (half section / distance). Of 120 impacts on clamped bars of 6 to 24
 * depths and the same as blocks 103 were covered without this. */
static const double NEAR_CLAMP = 0.16;

/* ---- Contacts that lose what their materials do ---- */

/* Of a loss factor or a series, as a share: what measurements of one material leave of the loss
 * modulus (26 %: J. W. Adams, C. G. Merrett, Polym. Eng. Sci. 63 (2023) 1459). Ranges of handbooks
 * are wider by far (docs/lab/contact-models.md). */
static const double LOSS_DEVIATION = 0.3;

/* ---- Contact laws that yield: build/tests/plastic, physics/test_family ---- */

/* Error of the family between its places, and once more where both bodies flow, as only one of them
 * is in it: against finer meshes. */
static const double LAW_FAMILY = 0.004;
/* A table of just the two materials, against complete meshes, besides its own mesh's error. */
static const double LAW_OWN_TABLE = 0.002;
/* For each decade beyond 30 times the indentation of yield: little springs back then. */
static const double LAW_DEEP = 0.006;
/* For each step outside the axes, and each decade beyond the computed depths. */
static const double LAW_OUTSIDE = 0.03;
static const double LAW_BEYOND = 0.02;

/* Share of a sub-impact's rebound from which on the next ones differ altogether, where a metal of
 * unstated yield flows. */
static const double OTHER_SUB_IMPACTS = 0.05;

/* ---- States of bodies that vibrate already: build/tests/estimates --class chain ---- */

/* Modes from this share of those that took part on stand for the ones behind them. */
static const double STATE_LAST = 0.75;

/* ---- Effort: build/tests/estimates (its columns of ms) ---- */

/* Work (impact.h) of all solutions of a request: most of a second by the modal method, with some
 * 20 ns a unit; CVODE's right-hand sides are many more and cheaper. */
static const double MOST_WORK = 3e7;
static const double MOST_WORK_CVODE = 4e9;
/* Times the answer's own work that a perturbed solution may take. */
static const double PERTURBED_WORK = 10.0;
/* Share of that work which shorter steps get at least where those before lose the energy. */
static const double LAST_WORK = 0.5;
/* Finest accuracy of time steps that is tried. */
static const double FINEST_STEPS = 1e-17;
/* Share of the approach's energy that the work of acceleration may be in a single impact. */
static const double PRESSED = 0.1;
/* Effect on the impulse of the modes that a truncated scene may lack, of first order along a
 * sequence, which is compared with nothing; perturbed solutions have MOST_MODES_SEQUENCE. */
static const double TRUNCATED_FIRST_ORDER = 1e-3;

#endif
