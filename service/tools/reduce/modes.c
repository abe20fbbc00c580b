/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/modes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/vector.h"
#include "numeric/dense.h"
#include "numeric/linear.h"
#include "reduce/forked.h"
#include "reduce/lanczos.h"

/* ---- rigid motions ---- */

double rigid_modes_scale(const struct solid_mesh *mesh, const struct bulk *bulk)
{
    /* squares of the radii of gyration along the principal axes, from the inertia */
    double inertia[9], principal[3], speed = 0.0;
    memcpy(inertia, bulk->inertia, sizeof inertia);
    linear_symmetric_eigen(3, inertia, principal);
    double thin = 0.5 * (principal[0] + principal[1] - principal[2]) / bulk->mass;
    double longest = 0.5 * (principal[1] + principal[2] - principal[0]) / bulk->mass;
    for (size_t i = 0; i < mesh->part_count; i++)
        speed = fmax(speed, mesh->part[i].material.young / mesh->part[i].material.density);
    /* a slender beam's w = 22.4 sqrt(E/rho) k/L^2 with its radius of gyration k; L^2 = 12 of its
     * greatest radius of gyration squared. Thinner than a thousandth is taken for that */
    thin = fmax(thin, 1e-6 * longest);
    double bending = 22.4 * 22.4 * speed * thin / (144.0 * longest * longest);
    /* a compact body is softer: half a shear wave of E/2.6 along L */
    double shearing = M_PI * M_PI * speed / (2.6 * 12.0 * longest);
    return bending * shearing / (bending + shearing);
}

/* Six candidates: shifts along the axes, turns about the nodes' middle; held nodes do not move.
 */
static void fill_rigid(const struct solid_mesh *mesh, const bool *held, double *vectors)
{
    size_t n = 3 * mesh->node_count;
    double middle[3] = {0.0};
    for (size_t i = 0; i < mesh->node_count; i++)
        add_scaled3(1.0 / (double)mesh->node_count, mesh->points[i], middle);
    for (size_t i = 0; i < mesh->node_count; i++) {
        double arm[3];
        sub3(mesh->points[i], middle, arm);
        for (size_t m = 0; m < 3; m++) {
            double axis[3] = {m == 0, m == 1, m == 2};
            memcpy(vectors + m * n + 3 * i, axis, sizeof axis);
            cross3(axis, arm, vectors + (3 + m) * n + 3 * i);
        }
    }
    for (size_t i = 0; held && i < RIGID_MOST * n; i++)
        if (held[i % n])
            vectors[i] = 0.0;
}

/* Turns `count` vectors into those combinations of them that make the symmetric matrix
 * x^T `matrix` x diagonal; returns the diagonal, ascending. `spare` is as large as the vectors. */
static bool diagonalise_rigid(const struct sparse *matrix, size_t count, double *vectors,
                              double *spare, double *diagonal)
{
    size_t n = matrix->n;
    double products[RIGID_MOST * RIGID_MOST];
    sparse_multiply(matrix, count, vectors, spare);
    dense_products((struct dense){n, count, vectors}, (struct dense){n, count, spare}, products);
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            products[i * count + j] = products[j * count + i];
    if (!linear_symmetric_eigen(count, products, diagonal))
        return false;
    memcpy(spare, vectors, count * n * sizeof *spare);
    dense_combine((struct dense){n, count, spare}, 1.0, products, 0.0, count, vectors);
    return true;
}

/* Makes the remaining vectors M-orthonormal, of the largest first; returns how many have mass. */
static size_t normalise_rigid(const struct sparse *mass, double *vectors, double *spare)
{
    double diagonal[RIGID_MOST];
    size_t n = mass->n, kept = 0;
    /* turns are as heavy as shifts once each has its own mass taken out */
    for (size_t m = 0; m < RIGID_MOST; m++) {
        double own = sparse_product(mass, vectors + m * n, vectors + m * n);
        for (size_t i = 0; i < n && own > 0.0; i++)
            vectors[m * n + i] /= sqrt(own);
    }
    if (!diagonalise_rigid(mass, RIGID_MOST, vectors, spare, diagonal))
        return 0;
    for (size_t m = 0; m < RIGID_MOST; m++) {
        if (!(diagonal[m] > 1e-12))
            continue;
        for (size_t i = 0; i < n; i++)
            vectors[kept * n + i] = vectors[m * n + i] / sqrt(diagonal[m]);
        kept++;
    }
    return kept;
}

enum percuss_status rigid_modes_make(const struct solid_mesh *mesh, const struct matrices *matrices,
                                     double scale, size_t *count, double **vectors,
                                     struct fault *fault)
{
    size_t n = 3 * mesh->node_count;
    double resisted[RIGID_MOST] = {0.0}, *spare = calloc(RIGID_MOST * n, sizeof *spare);
    *vectors = calloc(RIGID_MOST * n, sizeof **vectors);
    *count = 0;
    if (*vectors && spare) {
        fill_rigid(mesh, matrices->held, *vectors);
        size_t kept = normalise_rigid(&matrices->mass, *vectors, spare);
        /* rounding leaves some 1e-9 of the first mode's, a support that holds far more than all */
        if (kept && diagonalise_rigid(&matrices->stiffness, kept, *vectors, spare, resisted))
            while (*count < kept && resisted[*count] < 1e-4 * scale)
                (*count)++;
    }
    bool fine = *vectors && spare;
    free(spare);
    if (fine)
        return PERCUSS_OK;
    free(*vectors);
    *vectors = NULL;
    return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
}

/* ---- elastic modes ---- */

/* Modes beyond those that are wanted, among which a gap is sought to count below; how often modes
 * are sought anew when some are missed. */
enum { SPARE = 4, ATTEMPTS = 3 };

/* Parts of the work: the count, the factor, the modes. */
static const double COUNTED = 0.15, FACTORED = 0.15;

struct modes_cost modes_cost(const struct factor_cost *cost, const struct rates *rates,
                             const struct matrices *matrices, size_t count)
{
    double vectors = (double)lanczos_expected_vectors(count);
    double length = (double)matrices->stiffness.n;
    size_t mass = matrices->mass.start[matrices->mass.n];
    /* each new vector meets all before it once, and M three times; another factor counts the modes
     */
    double each = rates_solution(rates, cost, LANCZOS_BLOCK) + 3.0 * rates_product(rates, mass);
    double products = 2.0 * length * vectors * (vectors + (double)count) / rates->thin;
    double arrays = 8.0 * (length * (vectors + (double)count) + 3.0 * vectors * vectors);
    double memory = cost->memory + arrays;
    double together = 2.0 * cost->memory + 8.0 * length * (double)count;
    return (struct modes_cost){memory, fmax(memory, together),
                               2.0 * rates_factor(rates, cost) + vectors * each + products};
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

static bool tell_done(const struct modes_task *task, double done)
{
    const struct watch *watch = task->watch;
    return !watch || !watch->proceed || watch->proceed(watch->context, done);
}

enum percuss_status modes_count(const struct modes_task *task, double omega,
                                const struct factor *like, size_t *count, struct fault *fault)
{
    struct factor *factor;
    enum percuss_status status =
        factor_analyse(task->matrices, FACTOR_INDEFINITE, like, &factor, fault);
    if (!status)
        status = factor_compute(factor, -omega * omega, fault);
    *count = status ? 0 : factor_negatives(factor);
    *count -= *count < task->rigid.count ? *count : task->rigid.count;
    factor_free(factor);
    return status;
}

/* `*factor`, analysed already or NULL, becomes that of K + shift M; NULL with an error. */
static enum percuss_status make_factor(const struct modes_task *task, double shift,
                                       struct factor **factor, struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    if (!*factor)
        status = factor_analyse(task->matrices, FACTOR_POSITIVE, NULL, factor, fault);
    if (!status)
        status = factor_compute(*factor, shift, fault);
    if (status) {
        factor_free(*factor);
        *factor = NULL;
    }
    return status;
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

/* A count by a copy of this process while it still seeks modes. */
struct count_ahead {
    const struct modes_task *task;
    const struct factor *like;
    double below;    /* rad/s */
    size_t *counted; /* forked_memory; NULL: none */
    pid_t copy;      /* -1: none */
};

static bool count_in_copy(void *context)
{
    const struct count_ahead *ahead = context;
    struct fault fault = {""};
    return modes_count(ahead->task, ahead->below, ahead->like, ahead->counted, &fault) ==
           PERCUSS_OK;
}

/* Counts below the gap that is foreseen. */
static void begin_count(void *context, const double *omega)
{
    struct count_ahead *ahead = context;
    size_t found = ahead->task->most + SPARE;
    widest_gap(omega, whole_frequencies(omega, ahead->task->most, found), found, &ahead->below);
    ahead->counted = forked_memory(sizeof *ahead->counted);
    if (ahead->counted)
        ahead->copy = forked_begin(count_in_copy, ahead);
}

/* Whether that is done, below the gap that it was in the end, and confirms the modes. */
static bool end_count(struct count_ahead *ahead, struct modes *modes)
{
    bool done = forked_end(ahead->copy);
    if (!done || *ahead->counted != modes->confirmed ||
        !(modes->omega[modes->confirmed - 1] < ahead->below &&
          ahead->below < modes->omega[modes->confirmed]))
        return false;
    modes->confirmed_below = ahead->below;
    return true;
}

static enum percuss_status seek_modes(const struct modes_task *task, struct factor *factor,
                                      size_t count, struct count_ahead *ahead, uint64_t seed,
                                      struct modes *modes, struct fault *fault)
{
    /* they are counted before or afterwards */
    double before = count > task->most ? FACTORED : COUNTED + FACTORED;
    struct stage stage = {task->watch, before, 1.0 - COUNTED - FACTORED};
    struct watch watch = {task->watch && task->watch->proceed ? stage_proceed : NULL, &stage};
    struct lanczos_input input = {.matrices = task->matrices,
                                  .factor = factor,
                                  .shift = modes->shift,
                                  .rigid = task->rigid,
                                  .count = count,
                                  .seed = seed,
                                  .watch = &watch,
                                  .foreseen = ahead ? begin_count : NULL,
                                  .foreseen_context = ahead};
    free(modes->omega);
    free(modes->shapes);
    return lanczos_modes(&input, &modes->omega, &modes->shapes, fault);
}

/* Unknowns that supports leave, rigid motions taken out. */
static size_t modes_there_are(const struct modes_task *task)
{
    size_t n = task->matrices->stiffness.n, moving = n;
    for (size_t i = 0; task->matrices->held && i < n; i++)
        moving -= task->matrices->held[i];
    return moving > task->rigid.count ? moving - task->rigid.count : 0;
}

/* One factor serves modes and statics. Statics go without the modes: a step leaves shift / (shift +
 * w^2) of each further one, so that this far below the first mode one step does; of the sixteen
 * digits rigid motions, of 1 / shift, take three more. */
static const double BELOW_FIRST = 1e-3;
/* The first mode's square is guessed. Where that was too much by more than this, the factor is made
 * anew. */
static const double GUESSED = 100.0;

/* Makes the factor for statics unless it is there and its shift suits the modes, now known. */
static enum percuss_status suit_factor(const struct modes_task *task, struct modes *modes,
                                       struct factor **factor, struct fault *fault)
{
    double first = modes->count ? modes->omega[0] * modes->omega[0] : task->scale;
    bool suits = modes->shift <= GUESSED * BELOW_FIRST * first;
    if (*factor && suits)
        return PERCUSS_OK;
    if (!suits)
        modes->shift = BELOW_FIRST * first;
    return make_factor(task, modes->shift, factor, fault);
}

/* So many modes and the spare ones, and how many a count is to confirm, unless it has already. */
static enum percuss_status seek_confirmed(const struct modes_task *task, struct factor *factor,
                                          uint64_t seed, struct modes *modes, struct fault *fault)
{
    size_t found = task->most + SPARE;
    struct count_ahead ahead = {.task = task, .like = factor, .copy = -1};
    bool counts = task->two_factors && task->processes > 1;
    enum percuss_status status =
        seek_modes(task, factor, found, counts ? &ahead : NULL, seed, modes, fault);
    if (status == PERCUSS_OK) {
        modes->count = whole_frequencies(modes->omega, task->most, found);
        modes->confirmed = widest_gap(modes->omega, modes->count, found, &modes->confirmed_below);
        modes->counted_ahead = end_count(&ahead, modes);
    } else {
        forked_drop(ahead.copy);
    }
    forked_memory_free(ahead.counted, sizeof *ahead.counted);
    return status;
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
    enum percuss_status status = make_factor(task, modes->shift, factor, fault);
    for (uint64_t attempt = 1; !status && attempt <= ATTEMPTS; attempt++) {
        if (!*factor)
            status = make_factor(task, modes->shift, factor, fault);
        if (!status)
            status = seek_confirmed(task, *factor, attempt, modes, fault);
        if (status)
            return status;
        if (modes->counted_ahead)
            return suit_factor(task, modes, factor, fault);
        if (!task->two_factors) {
            factor_free(*factor);
            *factor = NULL;
        }
        status = modes_count(task, modes->confirmed_below, *factor, &counted, fault);
        if (!status && counted == modes->confirmed)
            return suit_factor(task, modes, factor, fault);
    }
    if (status)
        return status;
    /* none of the first modes of a body is that soft */
    bool loose = modes->omega[0] * modes->omega[0] < modes->shift;
    return fault_set(fault, loose ? PERCUSS_BAD_REQUEST : PERCUSS_INTERNAL,
                     "%zu modes found below %g Hz, where there are %zu%s", modes->confirmed,
                     modes->confirmed_below / (2.0 * M_PI), counted,
                     loose ? ": are stiffness and mass whole, and of one body?" : "");
}

/* All modes below a frequency, of which there are `count`. */
static enum percuss_status find_below(const struct modes_task *task, size_t count,
                                      struct modes *modes, struct factor **factor,
                                      struct fault *fault)
{
    enum percuss_status status = make_factor(task, modes->shift, factor, fault);
    modes->count = modes->confirmed = count;
    modes->confirmed_below = task->below;
    for (uint64_t attempt = 1; !status && attempt <= ATTEMPTS; attempt++) {
        status = seek_modes(task, *factor, count, NULL, attempt, modes, fault);
        if (!status && (count == 0 || modes->omega[count - 1] < task->below))
            return suit_factor(task, modes, factor, fault);
    }
    return status ? status
                  : fault_set(fault, PERCUSS_INTERNAL,
                              "fewer than %zu modes found below %g Hz, where there are as many",
                              count, task->below / (2.0 * M_PI));
}

/* Largest departure of the modes from orthonormality, with rigid motions and each other. */
static enum percuss_status measure_doubt(const struct modes_task *task, struct modes *modes,
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
    *modes = (struct modes){.n = task->matrices->stiffness.n, .shift = BELOW_FIRST * task->scale};
    enum percuss_status status = PERCUSS_OK;
    if (isfinite(task->below) && count == SIZE_MAX)
        status = modes_count(task, task->below, *factor, &count, fault);
    if (!status && !tell_done(task, count <= task->most ? COUNTED : 0.0))
        status = fault_set(fault, PERCUSS_TIMEOUT, "stopped");
    if (!status)
        status = count <= task->most ? find_below(task, count, modes, factor, fault)
                                     : find_most(task, modes, factor, fault);
    if (!status)
        status = measure_doubt(task, modes, fault);
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
