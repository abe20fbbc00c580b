/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/modes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reduce/lanczos.h"

/* Modes beyond those that are wanted, among which a gap is sought to count below; how often modes
 * are sought anew when some are missed. */
enum { SPARE = 4, ATTEMPTS = 3 };

/* Parts of the work: the count, the factor, the modes. */
static const double COUNTED = 0.15, FACTORED = 0.25;

/* Operations a second: of factors and products of long vectors, and of solves, which wait for
 * memory. */
static const double FACTOR_RATE = 8e9, SOLVE_RATE = 5e9;

struct modes_cost modes_cost(const struct factor *factor, size_t n, size_t count)
{
    struct factor_cost cost = factor_cost(factor);
    double vectors = (double)lanczos_expected_vectors(count), length = (double)n;
    /* a solve passes all entries twice; each new vector meets all before it four times, twice; an
     * indefinite factor counts the modes first */
    double solves = 4.0 * cost.entries * vectors;
    double products = 4.0 * length * vectors * vectors + 2.0 * length * vectors * (double)count;
    double arrays = 8.0 * (length * (vectors + (double)count) + 3.0 * vectors * vectors);
    return (struct modes_cost){cost.memory + arrays,
                               (2.5 * cost.operations + products) / FACTOR_RATE +
                                   solves / SOLVE_RATE};
}

/* A watch for one stage of the work. */
struct stage {
    const struct watch *watch;
    double from, share;
};

static bool stage_proceed(void *context, double done)
{
    const struct stage *stage = context;
    return stage->watch->proceed(stage->watch->context, stage->from + stage->share * done);
}

static bool tell(const struct modes_task *task, double done)
{
    const struct watch *watch = task->watch;
    return !watch || !watch->proceed || watch->proceed(watch->context, done);
}

enum percuss_status modes_count(const struct modes_task *task, double omega, size_t *count,
                                struct fault *fault)
{
    struct factor *factor;
    enum percuss_status status = factor_analyse(task->matrices, FACTOR_INDEFINITE, &factor, fault);
    if (!status)
        status = factor_compute(factor, -omega * omega, fault);
    *count = status ? 0 : factor_negatives(factor);
    *count -= *count < task->rigid.count ? *count : task->rigid.count;
    factor_free(factor);
    return status;
}

static enum percuss_status make_factor(const struct modes_task *task, struct factor **factor,
                                       struct fault *fault)
{
    enum percuss_status status = factor_analyse(task->matrices, FACTOR_POSITIVE, factor, fault);
    if (!status)
        status = factor_compute(*factor, task->scale, fault);
    if (status) {
        factor_free(*factor);
        *factor = NULL;
    }
    return status;
}

static enum percuss_status seek(const struct modes_task *task, struct factor *factor, size_t count,
                                uint64_t seed, struct modes *modes, struct fault *fault)
{
    struct stage stage = {task->watch, COUNTED + FACTORED, 1.0 - COUNTED - FACTORED};
    struct watch watch = {task->watch && task->watch->proceed ? stage_proceed : NULL, &stage};
    struct lanczos_input input = {.matrices = task->matrices,
                                  .factor = factor,
                                  .shift = task->scale,
                                  .rigid = task->rigid,
                                  .count = count,
                                  .seed = seed,
                                  .watch = &watch};
    free(modes->omega);
    free(modes->shapes);
    return lanczos_modes(&input, &modes->omega, &modes->shapes, fault);
}

/* Frequencies nearer to each other are taken for copies of one: a mesh is not quite as symmetric as
 * its body (a ring of 60 elements splits its pairs by 1e-4). */
static const double COPIES = 1e-3;

static bool are_copies(const double *omega, size_t i)
{
    return omega[i] <= (1.0 + COPIES) * omega[i - 1];
}

/* So many modes that no frequency is left with some of its copies: the rest of them too where they
 * end among those that are found, else none of them; those that were wanted where it is the first.
 */
static size_t whole_frequencies(const double *omega, size_t wanted, size_t found)
{
    size_t up = wanted, down = wanted;
    while (up < found && are_copies(omega, up))
        up++;
    if (up < found)
        return up;
    while (down > 0 && are_copies(omega, down))
        down--;
    return down > 0 ? down : wanted;
}

/* Where to count below: the widest gap after the wanted modes; how many lie below it. */
static size_t widest_gap(const double *omega, size_t wanted, size_t found, double *below)
{
    size_t best = wanted;
    double widest = 0.0;
    for (size_t i = wanted; i < found; i++) {
        double gap = omega[i] / omega[i - 1] - 1.0;
        if (gap <= widest)
            continue;
        widest = gap;
        best = i;
    }
    *below = sqrt(omega[best] * omega[best - 1]);
    return best;
}

/* Unknowns that supports leave, rigid motions taken out. */
static size_t modes_there_are(const struct modes_task *task)
{
    size_t n = task->matrices->stiffness.n, moving = n;
    for (size_t i = 0; task->matrices->held && i < n; i++)
        moving -= task->matrices->held[i];
    return moving > task->rigid.count ? moving - task->rigid.count : 0;
}

/* So many modes; then a count says whether they are the lowest, between two of the spare ones. */
static enum percuss_status find_most(const struct modes_task *task, struct modes *modes,
                                     struct factor **factor, struct fault *fault)
{
    size_t most = modes_there_are(task), counted = 0;
    if (task->most + SPARE > most)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "%zu modes: must be at most %zu with such a mesh", task->most,
                         most > SPARE ? most - SPARE : 0);
    for (uint64_t attempt = 1; attempt <= ATTEMPTS; attempt++) {
        enum percuss_status status = make_factor(task, factor, fault);
        if (!status)
            status = seek(task, *factor, task->most + SPARE, attempt, modes, fault);
        if (status)
            return status;
        /* one factor at a time fits where two might not */
        factor_free(*factor);
        *factor = NULL;
        modes->count = whole_frequencies(modes->omega, task->most, task->most + SPARE);
        modes->confirmed =
            widest_gap(modes->omega, modes->count, task->most + SPARE, &modes->confirmed_below);
        status = modes_count(task, modes->confirmed_below, &counted, fault);
        if (status)
            return status;
        if (counted == modes->confirmed)
            return make_factor(task, factor, fault);
    }
    return fault_set(fault, PERCUSS_INTERNAL, "%zu modes found below %g Hz, where there are %zu",
                     modes->confirmed, modes->confirmed_below / (2.0 * M_PI), counted);
}

/* All modes below a frequency, of which there are `count`. */
static enum percuss_status find_below(const struct modes_task *task, size_t count,
                                      struct modes *modes, struct factor **factor,
                                      struct fault *fault)
{
    enum percuss_status status = make_factor(task, factor, fault);
    modes->count = modes->confirmed = count;
    modes->confirmed_below = task->below;
    for (uint64_t attempt = 1; !status && attempt <= ATTEMPTS; attempt++) {
        status = seek(task, *factor, count, attempt, modes, fault);
        if (!status && (count == 0 || modes->omega[count - 1] < task->below))
            return PERCUSS_OK;
    }
    return status ? status
                  : fault_set(fault, PERCUSS_INTERNAL,
                              "fewer than %zu modes found below %g Hz, where there are as many",
                              count, task->below / (2.0 * M_PI));
}

/* Largest departure of the modes from orthonormality, with rigid motions and each other. */
static enum percuss_status measure(const struct modes_task *task, struct modes *modes,
                                   struct fault *fault)
{
    enum { TOGETHER = 16 };
    size_t n = modes->n, rigid = task->rigid.count;
    double *massive = malloc(TOGETHER * n * sizeof *massive + 1);
    double *products = malloc(TOGETHER * (modes->count + rigid) * sizeof *products + 1);
    /* a few at a time: M times a block of modes */
    for (size_t first = 0; massive && products && first < modes->count; first += TOGETHER) {
        size_t count = modes->count - first < TOGETHER ? modes->count - first : TOGETHER;
        struct dense block = {n, count, massive}, shapes = {n, modes->count, modes->shapes};
        sparse_multiply(&task->matrices->mass, count, modes->shapes + first * n, massive);
        /* with all modes: 1 with itself, 0 with others */
        dense_products(shapes, block, products);
        for (size_t j = 0; j < count; j++)
            for (size_t i = 0; i < modes->count; i++)
                modes->doubt = fmax(modes->doubt, fabs(products[j * modes->count + i] -
                                                       (i == first + j ? 1.0 : 0.0)));
        /* with rigid motions: 0 */
        dense_products(task->rigid, block, products);
        for (size_t i = 0; i < count * rigid; i++)
            modes->doubt = fmax(modes->doubt, fabs(products[i]));
    }
    bool fine = massive && products;
    free(massive);
    free(products);
    return fine ? PERCUSS_OK : fault_set(fault, PERCUSS_INTERNAL, "out of memory");
}

enum percuss_status modes_find(const struct modes_task *task, struct modes *modes,
                               struct factor **factor, struct fault *fault)
{
    size_t count = task->known;
    *modes = (struct modes){.n = task->matrices->stiffness.n, .shift = task->scale};
    *factor = NULL;
    enum percuss_status status = PERCUSS_OK;
    if (isfinite(task->below) && count == SIZE_MAX)
        status = modes_count(task, task->below, &count, fault);
    if (!status && !tell(task, COUNTED))
        status = fault_set(fault, PERCUSS_TIMEOUT, "stopped");
    if (!status)
        status = count <= task->most ? find_below(task, count, modes, factor, fault)
                                     : find_most(task, modes, factor, fault);
    if (!status)
        status = measure(task, modes, fault);
    if (status) {
        modes_free(modes);
        factor_free(*factor);
        *factor = NULL;
    }
    return status;
}

void modes_free(struct modes *modes)
{
    free(modes->omega);
    free(modes->shapes);
    *modes = (struct modes){0};
}
