/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "physics/estimates/tally.h"

#include <math.h>
#include <stdlib.h>

/* Errors that rounding leaves of a sequence that amplifies it are nobody's estimate. */
static const double ROUNDING = 1e-11;
/* Of the spread of a reference that did not settle: its own error is hardly more. */
static const double FAR = 5.0;

/* Names a scene that is met and wrong. */
static void name_wrong(struct tally *tally, uint64_t scene)
{
    if (tally->wrong < TALLY_NAMED)
        tally->wrong_scenes[tally->wrong] = scene;
    tally->wrong++;
}

bool tally_add(struct tally *tally, const struct verdict *verdict)
{
    tally->seconds += verdict->seconds;
    tally->slowest = fmax(tally->slowest, verdict->seconds);
    if (isnan(verdict->true_error)) {
        tally->unsolved++;
        return false;
    }
    if (!(verdict->spread <= TALLY_SETTLED * verdict->tolerance)) {
        tally->unsettled++;
        tally->unsettled_met += verdict->met;
        /* wrong all the same where what the reference leaves open cannot explain it */
        bool far = verdict->met && isfinite(verdict->spread) &&
                   verdict->true_error - FAR * verdict->spread > verdict->tolerance;
        if (far)
            name_wrong(tally, verdict->scene);
        return far;
    }
    /* what the reference itself leaves open is in the answer's favour */
    double error = fmax(verdict->true_error - verdict->spread, 0.0);
    if (tally->judged == tally->room) {
        size_t room = 2 * tally->room + 64;
        double *over = realloc(tally->over, room * sizeof *over);
        if (!over)
            abort();
        tally->over = over;
        tally->room = room;
    }
    tally->over[tally->judged++] = verdict->reported / fmax(verdict->true_error, ROUNDING);
    tally->met += verdict->met;
    tally->covered += error <= verdict->reported + ROUNDING;
    tally->impulse_covered +=
        verdict->true_impulse_error <=
        (verdict->reported_impulse + verdict->impulse_spread) * (1.0 + 1e-9) + 1e-300;
    tally->impulses += verdict->impulses;
    tally->velocities += verdict->velocities;
    tally->tangential += verdict->tangential_share <= 1.0;
    tally->miscounted += verdict->sub_impacts != verdict->true_sub_impacts;
    bool wrong = verdict->met && error > verdict->tolerance;
    if (wrong)
        name_wrong(tally, verdict->scene);
    double share = error / fmax(verdict->reported, ROUNDING);
    if (error > ROUNDING && share > tally->worst_share) {
        tally->worst_share = share;
        tally->worst_scene = verdict->scene;
    }
    return wrong;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

double tally_median_over(const struct tally *tally)
{
    if (tally->judged == 0)
        return 0.0;
    qsort(tally->over, tally->judged, sizeof *tally->over, compare);
    return tally->over[tally->judged / 2];
}

void tally_head(FILE *file, bool csv)
{
    if (csv)
        fprintf(file, "class,tolerance,judged,met,covered,impulse_covered,median_over,worst_under,"
                      "worst_scene,"
                      "met_and_wrong,miscounted,unsettled,unsettled_met,unsolved,cpu_mean,cpu_max,"
                      "impulses_covered,velocities_covered,wrong_scenes\n");
    else
        fprintf(file, "%-22s %6s %6s %6s %8s %8s %8s %8s %6s %9s %8s %6s %6s %13s %8s %8s %s\n",
                "class", "tol", "judged", "met %", "covered%", "largest%", "impuls.%", "veloc.%",
                "over", "under", "(scene)", "wrong", "count%", "unsettled/met", "unsolved",
                "ms mean", "ms max; scenes met and wrong");
}

void tally_print(FILE *file, const struct tally *tally, const char *name, double tolerance,
                 bool csv)
{
    double share = tally->judged ? 100.0 / (double)tally->judged : 0.0;
    size_t all = tally->judged + tally->unsettled + tally->unsolved;
    double mean = all ? tally->seconds / (double)all : 0.0;
    if (csv)
        fprintf(file, "%s,%g,%zu,%zu,%zu,%zu,%.4g,%.4g,%llu,%zu,%zu,%zu,%zu,%zu,%.4g,%.4g,%zu,%zu,",
                name, tolerance, tally->judged, tally->met, tally->covered, tally->impulse_covered,
                tally_median_over(tally), tally->worst_share,
                (unsigned long long)tally->worst_scene, tally->wrong, tally->miscounted,
                tally->unsettled, tally->unsettled_met, tally->unsolved, mean, tally->slowest,
                tally->impulses, tally->velocities);
    else
        fprintf(file,
                "%-22s %6.0e %6zu %6.1f %8.1f %8.1f %8.1f %8.1f %6.3g %9.3g %8llu %6zu %6.1f "
                "%9zu/%-3zu %8zu %8.2f "
                "%.0f",
                name, tolerance, tally->judged, share * (double)tally->met,
                share * (double)tally->covered, share * (double)tally->impulse_covered,
                share * (double)tally->impulses, share * (double)tally->velocities,
                tally_median_over(tally), tally->worst_share,
                (unsigned long long)tally->worst_scene, tally->wrong,
                share * (double)tally->miscounted, tally->unsettled, tally->unsettled_met,
                tally->unsolved, 1e3 * mean, 1e3 * tally->slowest);
    for (size_t i = 0; i < tally->wrong && i < TALLY_NAMED; i++)
        fprintf(file, "%s%llu", i || !csv ? " " : "", (unsigned long long)tally->wrong_scenes[i]);
    fprintf(file, "\n");
}

void tally_free(struct tally *tally)
{
    free(tally->over);
}
