/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "calibration.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "distance.h"

enum { LEAST_ROUNDS = 3, MOST_ROUNDS = 6 };
/* Done when a round moves no parameter by more than this share of its standard deviation. */
static const double SETTLED = 0.3;
/* Before the first round the parameters may be far off: only a model far from the reading leaves it
 * out. */
static const double FAR = 0.3;
static const double OUTLIER = 4.0;
/* Below the solver's own accuracy no reading counts. */
static const double LEAST_NOISE = 1e-5;
/* Change of a parameter for a derivative: far above the solver's errors, and the quantities are
 * powers of the parameters, so that it costs half a per cent of the derivative. */
static const double DIFFERENCE = 1e-2;
/* A reading takes part where the model is smooth. Within this change of a parameter it changes by
 * not more than so many times as much, and bends by no more than a cube does: near the birth of a
 * sub-impact it jumps instead, and its derivative would promise more than the data hold. */
static const double NEIGHBOURHOOD = 0.02, STEEPEST = 5.0, BEND_OF_A_CUBE = 6.0;
/* The same for the speed, which was measured with an error: so many standard deviations of it. */
static const double SPEED_DEVIATIONS = 2.0;

const char *quantity_name(int quantity)
{
    static const char *const names[] = {"impulse of the first sub-impact",
                                        "duration of the first sub-impact",
                                        "start of the second sub-impact"};
    return names[quantity];
}

/* The quantity of an impact; NAN: unknown. */
static double quantity_of(const struct measured_impact *impact, int quantity)
{
    if (quantity == QUANTITY_FIRST_IMPULSE)
        return impact->first_impulse;
    return quantity == QUANTITY_FIRST_DURATION ? impact->first_duration : impact->second_start;
}

/* One reading of one quantity. */
struct reading {
    size_t impact;
    int quantity;
};

struct round {
    const struct calibration_problem *problem;
    struct measured_impact *twins, *sides[2];
    bool *smooth;             /* [impact][quantity] */
    struct reading *readings; /* those in use */
    size_t *groups;           /* of the readings: their impacts, counted through */
    size_t count, group_count;
    double noise[QUANTITIES];
};

/* Relative difference of model and measurement; NAN where one of them is unknown. */
static double deviation_of(const struct round *round, size_t impact, int quantity)
{
    double measured = quantity_of(&round->problem->set->impacts[impact], quantity);
    double twin = quantity_of(&round->twins[impact], quantity);
    return measured > 0.0 ? twin / measured - 1.0 : NAN;
}

static bool evaluate(void *context, const double *x, double *residuals)
{
    struct round *round = context;
    if (!round->problem->simulate(round->problem->context, x, 1.0, round->twins))
        return false;
    for (size_t i = 0; i < round->count; i++) {
        const struct reading *reading = &round->readings[i];
        double off = deviation_of(round, reading->impact, reading->quantity);
        /* a second sub-impact that the model has lost on the way pulls nowhere, and one that has
         * jumped not more than an outlier may */
        double bound = 2.0 * OUTLIER, residual = off / round->noise[reading->quantity];
        residuals[i] = isnan(off) ? 0.0 : fmax(-bound, fmin(residual, bound));
    }
    return true;
}

/* Clears `smooth` where a quantity jumps between the models on both sides of this one, which
 * differ from it by `change`. */
static void compare_sides(struct round *round, double change)
{
    for (size_t i = 0; i < round->problem->set->count; i++) {
        for (int q = 0; q < QUANTITIES; q++) {
            double here = quantity_of(&round->twins[i], q);
            double below = quantity_of(&round->sides[0][i], q) / here - 1.0;
            double above = quantity_of(&round->sides[1][i], q) / here - 1.0;
            bool steep = !(fabs(above) <= STEEPEST * change && fabs(below) <= STEEPEST * change);
            bool bent = fabs(above + below) > BEND_OF_A_CUBE * change * change;
            if (steep || bent)
                round->smooth[i * QUANTITIES + (size_t)q] = false;
        }
    }
}

/* Sets `smooth` about x, where round->twins are: along the speed and every parameter. */
static bool find_smooth(struct round *round, const double *x)
{
    const struct calibration_problem *problem = round->problem;
    double moved[FIT_PARAMETERS] = {0.0}, change = SPEED_DEVIATIONS * problem->noise;
    bool good = true;
    for (size_t i = 0; i < problem->set->count * QUANTITIES; i++)
        round->smooth[i] = true;
    for (int side = 0; good && side < 2; side++)
        good = problem->simulate(problem->context, x, side ? 1.0 + change : 1.0 - change,
                                 round->sides[side]);
    if (good)
        compare_sides(round, change);
    for (size_t k = 0; good && k < problem->parameters; k++) {
        for (int side = 0; good && side < 2; side++) {
            memcpy(moved, x, problem->parameters * sizeof *moved);
            moved[k] += side ? NEIGHBOURHOOD : -NEIGHBOURHOOD;
            good = problem->simulate(problem->context, moved, 1.0, round->sides[side]);
        }
        if (good)
            compare_sides(round, NEIGHBOURHOOD);
    }
    return good;
}

/* Chooses the smooth readings that are within `allowed` of the model, quantity by quantity. */
static void choose(struct round *round, const double allowed[QUANTITIES],
                   struct calibration *calibration)
{
    round->count = 0;
    for (int q = 0; q < QUANTITIES; q++) {
        calibration->known[q] = calibration->used[q] = 0;
        for (size_t i = 0; i < round->problem->set->count; i++) {
            calibration->known[q] += !isnan(quantity_of(&round->problem->set->impacts[i], q));
            if (!round->smooth[i * QUANTITIES + (size_t)q] ||
                !(fabs(deviation_of(round, i, q)) <= allowed[q]))
                continue;
            round->readings[round->count++] = (struct reading){i, q};
            calibration->used[q]++;
        }
    }
}

/* Readings of one impact share the error of its speed. */
static void find_groups(struct round *round)
{
    round->group_count = 0;
    for (size_t i = 0; i < round->problem->set->count; i++) {
        bool any = false;
        for (size_t k = 0; k < round->count; k++) {
            if (round->readings[k].impact != i)
                continue;
            round->groups[k] = round->group_count;
            any = true;
        }
        round->group_count += any;
    }
}

/* Scatter of a quantity about its median, robust against outliers; NAN without readings. */
static double scatter(const struct round *round, int quantity, double *room)
{
    size_t count = 0;
    for (size_t i = 0; i < round->count; i++)
        if (round->readings[i].quantity == quantity)
            room[count++] = deviation_of(round, round->readings[i].impact, quantity);
    double middle = sample_median(room, count);
    for (size_t i = 0; i < count; i++)
        room[i] = fabs(room[i] - middle);
    return fmax(1.4826 * sample_median(room, count), LEAST_NOISE);
}

static bool solve_rounds(struct round *round, double *room, struct calibration *calibration)
{
    const struct calibration_problem *problem = round->problem;
    double allowed[QUANTITIES];
    for (int q = 0; q < QUANTITIES; q++) {
        round->noise[q] = problem->noise;
        allowed[q] = FAR;
    }
    bool settled = false;
    for (int k = 0; k < MOST_ROUNDS && !settled; k++) {
        double before[FIT_PARAMETERS];
        memcpy(before, calibration->fit.x, sizeof before);
        /* the model here, and where it is smooth */
        if (!problem->simulate(problem->context, calibration->fit.x, 1.0, round->twins) ||
            !find_smooth(round, calibration->fit.x))
            return false;
        /* fitted to the readings that are smooth and not off */
        choose(round, allowed, calibration);
        find_groups(round);
        struct fit_problem fit = {problem->parameters, round->count,  evaluate,          round,
                                  DIFFERENCE,          round->groups, round->group_count};
        if (!fit_solve(&fit, &calibration->fit) ||
            !problem->simulate(problem->context, calibration->fit.x, 1.0, round->twins))
            return false;
        for (int q = 0; q < QUANTITIES; q++) {
            if (calibration->used[q] > 0)
                round->noise[q] = calibration->noise[q] = scatter(round, q, room);
            allowed[q] = OUTLIER * round->noise[q];
        }
        /* until no parameter moves much */
        settled = k + 1 >= LEAST_ROUNDS;
        for (size_t i = 0; i < problem->parameters; i++)
            settled = settled && fabs(calibration->fit.x[i] - before[i]) <=
                                     SETTLED * calibration->fit.deviation[i];
    }
    return true;
}

bool calibration_solve(const struct calibration_problem *problem, struct calibration *calibration)
{
    size_t n = problem->set->count;
    struct round round = {.problem = problem};
    round.twins = calloc(n, sizeof *round.twins);
    round.readings = calloc(n * QUANTITIES, sizeof *round.readings);
    round.groups = calloc(n * QUANTITIES, sizeof *round.groups);
    round.sides[0] = calloc(n, sizeof *round.twins);
    round.sides[1] = calloc(n, sizeof *round.twins);
    round.smooth = calloc(n * QUANTITIES, sizeof *round.smooth);
    double *room = calloc(n * QUANTITIES, sizeof *room);
    bool good = round.twins && round.readings && round.groups && round.sides[0] && round.sides[1] &&
                round.smooth && room && solve_rounds(&round, room, calibration);
    free(round.twins);
    free(round.readings);
    free(round.groups);
    free(round.sides[0]);
    free(round.sides[1]);
    free(round.smooth);
    free(room);
    return good;
}
