/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "reduce/lanczos.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/linear.h"
#include "numeric/random_stream.h"

/* Parts of the norm of A x, and of that of a random vector, below which rounding alone remains.
 */
static const double LOST = 1e-13, EXHAUSTED = 1e-8;

/* Vectors of the basis for each that there is: some blocks are zero or dependent at the end. */
enum { EXHAUSTIVE = 2 };

/* The basis grows block by block; T is its projection, banded, kept whole. */
struct lanczos {
    const struct lanczos_input *input;
    size_t n, size, room;   /* vectors so far, that fit */
    double *basis;          /* [room][n] */
    double *next, *massive; /* [LANCZOS_BLOCK][n]: the next block, and M times it */
    double *projection;     /* [room][room], T by rows, symmetric */
    double beta[LANCZOS_BLOCK * LANCZOS_BLOCK]; /* joins the next block to the last, [j][i] */
    double *products;                           /* [LANCZOS_BLOCK][room + rigid] */
    double *values, *vectors;                   /* of T: [room], [room][room] */
    double largest;                             /* norm of A x seen */
    size_t converged;
    bool foretold; /* input->foreseen is told */
};

static enum percuss_status no_memory(struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "out of memory for the modes of a mesh");
}

static bool regrow(double **array, size_t count)
{
    double *more = realloc(*array, (count + 1) * sizeof *more);
    *array = more ? more : *array;
    return more != NULL;
}

/* Room for `room` vectors: T moves to its new rows. */
static bool make_room(struct lanczos *state, size_t room)
{
    double *wider = calloc(room * room + 1, sizeof *wider);
    if (!wider || !regrow(&state->basis, room * state->n) ||
        !regrow(&state->products, LANCZOS_BLOCK * (room + state->input->rigid.count)) ||
        !regrow(&state->values, room) || !regrow(&state->vectors, room * room)) {
        free(wider);
        return false;
    }
    for (size_t i = 0; i < state->size; i++)
        memcpy(wider + i * room, state->projection + i * state->room, state->size * sizeof *wider);
    free(state->projection);
    state->projection = wider;
    state->room = room;
    return true;
}

/* M times columns of the next block. */
static void refresh(struct lanczos *state, size_t first, size_t count)
{
    sparse_multiply(&state->input->matrices->mass, count, state->next + first * state->n,
                    state->massive + first * state->n);
}

/* x -= V V^T M x of columns of the next block, for a set V of M-orthonormal vectors; the products
 * stay in state->products. */
static void take_out(struct lanczos *state, struct dense set, size_t first, size_t count)
{
    size_t at = first * state->n;
    dense_products(set, (struct dense){state->n, count, state->massive + at}, state->products);
    dense_combine(set, -1.0, state->products, 1.0, count, state->next + at);
}

static struct dense basis_of(const struct lanczos *state)
{
    return (struct dense){state->n, state->size, state->basis};
}

/* The vectors of the basis that A joins to its next block, but for rounding: the last two blocks.
 */
static struct dense joined_of(const struct lanczos *state)
{
    size_t most = 2 * LANCZOS_BLOCK, count = state->size < most ? state->size : most;
    return (struct dense){state->n, count, state->basis + (state->size - count) * state->n};
}

/* Adds the last products, with `count` vectors up to the newest, to the newest block's own place in
 * T. */
static void note_products(struct lanczos *state, size_t count)
{
    size_t newest = state->size - LANCZOS_BLOCK;
    for (size_t j = 0; j < LANCZOS_BLOCK; j++)
        for (size_t i = 0; i < LANCZOS_BLOCK; i++)
            state->projection[(newest + j) * state->room + newest + i] +=
                state->products[j * count + count - LANCZOS_BLOCK + i];
}

/* Orthogonal to rigid motions and to all vectors so far, in two passes, as one loses digits by
 * cancellation. With `noted`, A times the newest block, the first pass takes out what that is made
 * of, and there is nothing left in the second one but rounding. */
static void orthogonalise(struct lanczos *state, size_t first, size_t count, bool noted)
{
    for (int pass = 0; pass < 2; pass++) {
        struct dense set = noted && pass == 0 ? joined_of(state) : basis_of(state);
        /* both sets are orthogonal to each other: one product with M serves them */
        take_out(state, state->input->rigid, first, count);
        take_out(state, set, first, count);
        if (noted)
            note_products(state, set.count);
        refresh(state, first, count);
    }
}

/* Something new, by its place alone. */
static void fill_random(struct lanczos *state, size_t column)
{
    struct random_stream stream = {state->input->seed, LANCZOS_BLOCK};
    const bool *held = state->input->matrices->held;
    double *x = state->next + column * state->n;
    for (size_t i = 0; i < state->n; i++)
        x[i] = held && held[i] ? 0.0 : random_uniform(&stream, state->size + column, i) - 0.5;
    refresh(state, column, 1);
}

static double norm_of(const struct lanczos *state, size_t column)
{
    double square;
    dense_products((struct dense){state->n, 1, state->next + column * state->n},
                   (struct dense){state->n, 1, state->massive + column * state->n}, &square);
    return sqrt(fmax(square, 0.0));
}

/* Takes the columns before it out of one, twice; `along`, of LANCZOS_BLOCK, gets the products. */
static void take_out_block(struct lanczos *state, size_t column, double *along)
{
    size_t n = state->n;
    double products[LANCZOS_BLOCK];
    for (int pass = 0; pass < 2; pass++) {
        struct dense before = {n, column, state->next}, weights = {n, column, state->massive};
        dense_products(weights, (struct dense){n, 1, state->next + column * n}, products);
        dense_combine(before, -1.0, products, 1.0, 1, state->next + column * n);
        dense_combine(weights, -1.0, products, 1.0, 1, state->massive + column * n);
        for (size_t i = 0; i < column; i++)
            along[i] += products[i];
    }
}

static void scale_column(struct lanczos *state, size_t column, double factor)
{
    for (size_t i = column * state->n; i < (column + 1) * state->n; i++) {
        state->next[i] *= factor;
        state->massive[i] *= factor;
    }
}

/* The next block becomes Q with next = Q beta (Gram and Schmidt). A column that depends on the
 * others has no beta and becomes a random one, or zero when the space is exhausted. */
static void orthonormalise(struct lanczos *state)
{
    memset(state->beta, 0, sizeof state->beta);
    for (size_t j = 0; j < LANCZOS_BLOCK; j++) {
        double *column = state->beta + j * LANCZOS_BLOCK, unused[LANCZOS_BLOCK];
        take_out_block(state, j, column);
        double norm = norm_of(state, j);
        if (norm > LOST * state->largest) {
            column[j] = norm;
            scale_column(state, j, 1.0 / norm);
            continue;
        }
        /* rounding is all that was left of it */
        fill_random(state, j);
        double fresh = norm_of(state, j);
        orthogonalise(state, j, 1, false);
        take_out_block(state, j, unused);
        norm = norm_of(state, j);
        scale_column(state, j, norm > EXHAUSTED * fresh ? 1.0 / norm : 0.0);
    }
}

/* The next block joins the basis, and beta joins it to the one before. */
static void append(struct lanczos *state)
{
    size_t first = state->size, room = state->room;
    memcpy(state->basis + first * state->n, state->next,
           LANCZOS_BLOCK * state->n * sizeof *state->basis);
    for (size_t j = 0; first > 0 && j < LANCZOS_BLOCK; j++)
        for (size_t i = 0; i < LANCZOS_BLOCK; i++) {
            double joint = state->beta[j * LANCZOS_BLOCK + i];
            state->projection[(first + i) * room + first - LANCZOS_BLOCK + j] = joint;
            state->projection[(first - LANCZOS_BLOCK + j) * room + first + i] = joint;
        }
    state->size += LANCZOS_BLOCK;
}

/* Eigenvalues of T, and how many of the largest have converged: the residual of a vector s of T's
 * is |beta s_last|. */
static bool look(struct lanczos *state)
{
    /* T, made symmetric against rounding */
    size_t size = state->size;
    for (size_t i = 0; i < size; i++)
        for (size_t j = 0; j < size; j++)
            state->vectors[i * size + j] = 0.5 * (state->projection[i * state->room + j] +
                                                  state->projection[j * state->room + i]);
    if (!linear_symmetric_eigen(size, state->vectors, state->values))
        return false;
    /* from the largest down, until a residual is too large */
    state->converged = 0;
    while (state->converged < size) {
        size_t at = size - 1 - state->converged;
        const double *last = state->vectors + at * size + size - LANCZOS_BLOCK;
        double square = 0.0;
        for (size_t i = 0; i < LANCZOS_BLOCK; i++) {
            double sum = 0.0;
            for (size_t j = 0; j < LANCZOS_BLOCK; j++)
                sum += state->beta[j * LANCZOS_BLOCK + i] * last[j];
            square += sum * sum;
        }
        if (!(state->values[at] > 0.0) || sqrt(square) > LANCZOS_RESIDUAL * state->values[at])
            break;
        state->converged++;
    }
    return true;
}

/* One block: A times the newest vectors, made new. */
static enum percuss_status extend(struct lanczos *state, struct fault *fault)
{
    /* orthonormalisation left M times the newest block */
    memcpy(state->next, state->massive, LANCZOS_BLOCK * state->n * sizeof *state->next);
    enum percuss_status status =
        factor_solve(state->input->factor, LANCZOS_BLOCK, state->next, fault);
    if (status)
        return status;
    refresh(state, 0, LANCZOS_BLOCK);
    for (size_t j = 0; j < LANCZOS_BLOCK; j++)
        state->largest = fmax(state->largest, norm_of(state, j));
    orthogonalise(state, 0, LANCZOS_BLOCK, true);
    orthonormalise(state);
    return PERCUSS_OK;
}

static bool goes_on(const struct lanczos *state)
{
    const struct watch *watch = state->input->watch;
    double done = (double)state->size / (double)lanczos_expected_vectors(state->input->count);
    return !watch || !watch->proceed || watch->proceed(watch->context, fmin(done, 0.99));
}

size_t lanczos_expected_vectors(size_t count)
{
    return 3 * count + 8 * LANCZOS_BLOCK;
}

/* Unknowns that can move elastically. */
static size_t free_count(const struct lanczos_input *input)
{
    size_t n = input->matrices->stiffness.n, moving = n;
    for (size_t i = 0; input->matrices->held && i < n; i++)
        moving -= input->matrices->held[i];
    return moving - input->rigid.count;
}

/* The frequency of the m-th eigenvalue from the largest down, rad/s. */
static double frequency(const struct lanczos *state, size_t m)
{
    double inverse = state->values[state->size - 1 - m];
    return sqrt(fmax(1.0 / inverse - state->input->shift, 0.0));
}

/* Tells all frequencies once most have converged. False: out of memory. */
static bool foretell(struct lanczos *state)
{
    const struct lanczos_input *input = state->input;
    size_t wanted = input->count;
    if (!input->foreseen || state->foretold || 4 * state->converged < 3 * wanted ||
        state->size < wanted)
        return true;
    double *omega = malloc((wanted + 1) * sizeof *omega);
    for (size_t m = 0; omega && m < wanted; m++)
        omega[m] = frequency(state, m);
    if (omega)
        input->foreseen(input->foreseen_context, omega);
    free(omega);
    state->foretold = true;
    return omega != NULL;
}

/* Until all that are wanted have converged; looks each time the basis has grown by a tenth. */
static enum percuss_status iterate(struct lanczos *state, struct fault *fault)
{
    size_t wanted = state->input->count, look_at = wanted + 2 * LANCZOS_BLOCK;
    /* a random block to begin with */
    for (size_t j = 0; j < LANCZOS_BLOCK; j++)
        fill_random(state, j);
    orthogonalise(state, 0, LANCZOS_BLOCK, false);
    orthonormalise(state);
    /* one block more, with room for it */
    while (state->converged < wanted) {
        if (state->size + LANCZOS_BLOCK > state->room &&
            !make_room(state, state->room + state->room / 2 + LANCZOS_BLOCK))
            return no_memory(fault);
        append(state);
        enum percuss_status status = extend(state, fault);
        if (status)
            return status;
        /* it can be stopped between blocks */
        if (!goes_on(state))
            return fault_set(fault, PERCUSS_TIMEOUT, "stopped");
        /* when it has grown by a tenth */
        if (state->size < look_at)
            continue;
        if (!look(state) || !foretell(state))
            return no_memory(fault);
        /* a basis of all there is holds them, unless rounding hides them */
        if (state->converged < wanted &&
            state->size > EXHAUSTIVE * free_count(state->input) + wanted)
            return fault_set(fault, PERCUSS_BAD_REQUEST,
                             "%zu modes: all %zu vectors that there are do not hold them: are "
                             "stiffness and mass whole, and of one body?",
                             wanted, free_count(state->input));
        look_at = state->size + state->size / 10;
    }
    return PERCUSS_OK;
}

/* The converged vectors, V s, lowest frequencies first. */
static enum percuss_status collect(struct lanczos *state, double **omega, double **shapes,
                                   struct fault *fault)
{
    size_t count = state->input->count, size = state->size;
    *omega = malloc((count + 1) * sizeof **omega);
    *shapes = malloc((count * state->n + 1) * sizeof **shapes);
    double *turned = malloc((count * size + 1) * sizeof *turned);
    if (!*omega || !*shapes || !turned) {
        free(*omega);
        free(*shapes);
        free(turned);
        *omega = *shapes = NULL;
        return no_memory(fault);
    }
    for (size_t m = 0; m < count; m++) {
        (*omega)[m] = frequency(state, m);
        memcpy(turned + m * size, state->vectors + (size - 1 - m) * size, size * sizeof *turned);
    }
    dense_combine(basis_of(state), 1.0, turned, 0.0, count, *shapes);
    free(turned);
    return PERCUSS_OK;
}

enum percuss_status lanczos_modes(const struct lanczos_input *input, double **omega,
                                  double **shapes, struct fault *fault)
{
    *omega = *shapes = NULL;
    /* no more than there are */
    if (input->count > free_count(input))
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%zu modes: the mesh has only %zu",
                         input->count, free_count(input));
    /* two blocks, and a basis for as many vectors as that usually takes */
    struct lanczos state = {.input = input, .n = input->matrices->stiffness.n};
    state.next = calloc(LANCZOS_BLOCK * state.n, sizeof *state.next);
    state.massive = calloc(LANCZOS_BLOCK * state.n, sizeof *state.massive);
    bool fine = state.next && state.massive &&
                make_room(&state, lanczos_expected_vectors(input->count) + LANCZOS_BLOCK);
    /* eigenvalues, then the shapes */
    enum percuss_status status = fine ? iterate(&state, fault) : no_memory(fault);
    if (!status)
        status = collect(&state, omega, shapes, fault);
    free(state.basis);
    free(state.next);
    free(state.massive);
    free(state.projection);
    free(state.products);
    free(state.values);
    free(state.vectors);
    return status;
}
