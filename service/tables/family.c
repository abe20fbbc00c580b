/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "tables/family.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "store/family_file.h"
#include "tables/bar.h"
#include "tables/family_make.h"

/* A passage on the fine mesh takes as long as some ten on the coarse one. */
enum { FINE_COST = 10 };

struct work {
    struct indentation_run in_long, in_short;
    struct bar bar;
};

/* Two passages over the same region, the first some third of the time. */
static enum percuss_status compute_point(void *context, const struct contact_family_place *place,
                                         size_t resolution, struct family_point *point,
                                         struct fault *fault)
{
    const double first = 0.35;
    struct work *work = context;
    struct watch watch = {bar_show, &work->bar};
    struct region_input input = family_input(place, resolution);
    /* in long steps, loading alone */
    struct indentation_plan plan = {input, FAMILY_LONG, 0, 0.0, first, &watch};
    size_t all = family_passages() + family_fine_passages() * (FINE_COST - 1);
    work->bar.share = (resolution == FAMILY_FINE ? FINE_COST : 1) / (double)all;
    enum percuss_status status = indentation_run(&plan, &work->in_long, fault);
    /* in steps half as long, with unloadings */
    plan = (struct indentation_plan){input, 2 * FAMILY_LONG, FAMILY_BRANCH_EVERY,
                                     first, 1.0 - first,     &watch};
    if (!status)
        status = indentation_run(&plan, &work->in_short, fault);
    /* both together: the error of the steps is taken out */
    if (!status && !family_point_fill(&work->in_long, &work->in_short, &input, point))
        status = fault_set(fault, PERCUSS_INTERNAL, "family: too few points");
    work->bar.from += work->bar.share;
    return status;
}

enum percuss_status family_compute(const char *folder, struct fault *fault)
{
    clock_t start = clock();
    /* all its points, under one bar */
    struct work *work = calloc(1, sizeof *work);
    if (!work)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    work->bar = bar_begin("the family of tables");
    struct family_source source = {compute_point, work};
    struct family_numbers *numbers = family_numbers_make(&source, fault);
    bar_clear(&work->bar);
    free(work);
    if (!numbers)
        return PERCUSS_INTERNAL;
    /* saved with who made it, in how long, on which meshes */
    struct contact_family_samples samples = family_numbers_samples(numbers);
    struct family_origin origin = {"percuss-tables " PERCUSS_VERSION,
                                   (double)(clock() - start) / CLOCKS_PER_SEC, FAMILY_COARSE,
                                   FAMILY_FINE};
    char path[TABLE_PATH_SIZE];
    enum percuss_status status = family_file_save(folder, &samples, &origin, path, fault);
    if (!status)
        printf("the family: error of the force %.2g, %.0f s, %s\n", samples.error, origin.seconds,
               path);
    family_numbers_free(numbers);
    return status;
}
