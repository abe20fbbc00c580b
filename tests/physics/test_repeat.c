/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Same request, same bytes: after anything else in the workspace, in a fresh one, on another
 * thread; and a warm solve takes no memory from the system. */
#include <pthread.h>
#include <unistd.h>

#include "physics/support.h"

/* This program's own malloc family counts what passes. Sanitizers bring their own. */
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__GLIBC__)
#define COUNTS_MEMORY 1
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);
#else
#define COUNTS_MEMORY 0
#endif

static _Thread_local unsigned long taken;
static _Thread_local size_t taken_bytes;

#if COUNTS_MEMORY
static void count(size_t size)
{
    taken++;
    taken_bytes += size;
}

void *malloc(size_t size)
{
    count(size);
    return __libc_malloc(size);
}

void *calloc(size_t items, size_t size)
{
    count(items * size);
    return __libc_calloc(items, size);
}

void *realloc(void *old, size_t size)
{
    count(size);
    return __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    count(size);
    return __libc_memalign(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    count(size);
    *memory = __libc_memalign(alignment, size);
    return *memory ? 0 : 12;
}
#endif

enum { SCENES = 7, RECORD = 600 };

static struct lab *lab_of_bodies(void)
{
    struct lab *lab = lab_create();
    struct body rod = make_bar(&rod_kind, ALUMINIUM, 0.010, 0.4);
    struct body damped = make_bar(&beam_kind, ALUMINIUM, 0.010, 0.8);
    rod.tip_radius = 0.015;
    damped.damping = 0.01;
    lab_add(lab, "ball", make_sphere(STEEL, 0.015));
    lab_add(lab, "rod", rod);
    lab_add(lab, "beam", make_bar(&beam_kind, ALUMINIUM, 0.010, 1.0));
    lab_add(lab, "damped", damped);
    return lab;
}

static struct solve_request scene(int index)
{
    const struct spot ball = sphere_spot("ball", 0.015);
    struct solve_request request;
    switch (index) {
    case 0:
        request = strike(ball, end_spot("rod", 0.4), 0.3);
        break;
    case 1:
        request = strike(ball, side_spot("beam", 0.0, 0.010, 0.0), 0.287);
        break;
    case 2:
        request = strike(end_spot("rod", 0.4), side_spot("beam", 0.2, 0.010, 1.0), 0.3);
        request.options.tolerance = 1e-5;
        break;
    case 3:
        request = strike(ball, side_spot("damped", -0.1, 0.010, 0.5), 0.2);
        request.contacts[0].gap = 1e-4;
        request.contacts[0].gap_acceleration = -9.81;
        break;
    case 4:
        request = strike(ball, ball, 0.2);
        break;
    case 5:
        request = strike(ball, side_spot("damped", 0.3, 0.010, 0.0), 0.4);
        request.options.conditioning = true;
        request.options.tolerance = 1e-6;
        break;
    default:
        request = strike(ball, end_spot("rod", 0.4), 0.3);
        request.options.method = PERCUSS_METHOD_CVODE;
    }
    return request;
}

/* Every number of an answer, in order; returns how many. */
static size_t record_of(const struct solve_result *result, double record[RECORD])
{
    const struct solve_contact_result *contact = &result->contacts[0];
    size_t n = 0;
    memset(record, 0, RECORD * sizeof *record);
    record[n++] = (double)result->status;
    record[n++] = (double)result->end_reason;
    record[n++] = result->window;
    record[n++] = contact->impulse;
    record[n++] = contact->restitution;
    record[n++] = contact->end_time;
    for (size_t i = 0; i < contact->sub_impacts_listed && i < 12; i++) {
        const struct sub_impact *sub = &contact->sub_impacts[i];
        const double values[] = {
            sub->start,           sub->compression_end,     sub->end,
            sub->impulse,         sub->compression_impulse, sub->peak_force,
            sub->max_indentation, sub->gap_rate_before,     sub->gap_rate_after};
        memcpy(record + n, values, sizeof values);
        n += COUNT(values);
    }
    memcpy(record + n, &result->energy, sizeof result->energy);
    n += sizeof result->energy / sizeof(double);
    record[n++] = result->restitution_time;
    record[n++] = result->restitution_modes;
    record[n++] = result->restitution_model;
    record[n++] = isnan(result->restitution_by_speed) ? 0.0 : result->restitution_by_speed;
    record[n++] = result->time_shift;
    record[n++] = result->omitted_error;
    for (size_t b = 0; b < result->body_count; b++) {
        const struct body_state *after = result->bodies[b].state_after;
        for (int k = 0; k < 3; k++) {
            record[n++] = result->bodies[b].velocity[k];
            record[n++] = result->bodies[b].angular_velocity[k];
        }
        record[n++] = result->bodies[b].vibration;
        size_t pairs = after ? (body_state_size(after) - sizeof *after) / sizeof(double) : 0;
        for (size_t k = 0; k < pairs && k < 150; k++)
            record[n++] = after->coordinates[k];
    }
    return n;
}

static void solve_and_record(struct solve_workspace *workspace, const struct solve_context *means,
                             int index, double record[RECORD])
{
    struct solve_result *result = malloc(sizeof *result);
    struct solve_request *request = malloc(sizeof *request);
    assert_true(result && request);
    *request = scene(index);
    solve(workspace, means, request, result);
    record_of(result, record);
    free(request);
    free(result);
}

static void same_bytes_whatever_came_before(void **state)
{
    (void)state;
    static double expected[SCENES][RECORD];
    static double record[RECORD];
    struct lab *lab = lab_of_bodies();
    uint64_t seed = 17;
    for (int i = 0; i < SCENES; i++) {
        struct solve_workspace *fresh = solve_workspace_create();
        assert_non_null(fresh);
        solve_and_record(fresh, &lab->means, i, expected[i]);
        solve_workspace_free(fresh);
    }
    for (int trial = 0; trial < 60; trial++) {
        int i = (int)random_between(&seed, 0.0, SCENES - 1e-9);
        solve_and_record(lab->workspace, &lab->means, i, record);
        if (memcmp(record, expected[i], sizeof record) != 0)
            fail_msg("scene %d differs in trial %d", i, trial);
    }
    lab_free(lab);
}

/* One of few places, so that a workspace has kept what belongs to it, or any other one. */
static struct solve_request drawn_scene(uint64_t *seed)
{
    static const double places[] = {-0.3, 0.0, 0.1, 0.25};
    static const double tolerances[] = {1e-2, 1e-3, 1e-4};
    const struct spot ball = sphere_spot("ball", 0.015);
    bool known = random_between(seed, 0.0, 1.0) < 0.7;
    double along = known ? places[(int)random_between(seed, 0.0, COUNT(places) - 1e-9)]
                         : random_between(seed, -0.35, 0.35);
    double around = known ? 0.0 : random_between(seed, 0.0, 6.0);
    const char *beam = random_between(seed, 0.0, 1.0) < 0.5 ? "beam" : "damped";
    struct solve_request request =
        random_between(seed, 0.0, 1.0) < 0.2
            ? strike(ball, end_spot("rod", 0.4), random_between(seed, 0.1, 0.4))
            : strike(ball, side_spot(beam, along, 0.010, around), random_between(seed, 0.1, 0.4));
    request.options.tolerance = tolerances[(int)random_between(seed, 0.0, 3.0 - 1e-9)];
    return request;
}

static void kept_sites_do_not_change_a_bit(void **state)
{
    (void)state;
    static struct solve_result result;
    static double warm[RECORD], record[RECORD];
    struct lab *lab = lab_of_bodies();
    uint64_t seed = 2463534242u;
    for (int trial = 0; trial < 200; trial++) {
        struct solve_request request = drawn_scene(&seed);
        assert_int_equal(solve(lab->workspace, &lab->means, &request, &result), PERCUSS_OK);
        record_of(&result, warm);
        struct solve_workspace *fresh = solve_workspace_create();
        assert_non_null(fresh);
        solve(fresh, &lab->means, &request, &result);
        record_of(&result, record);
        solve_workspace_free(fresh);
        if (memcmp(record, warm, sizeof record) != 0)
            fail_msg("request %d differs", trial);
    }
    lab_free(lab);
}

struct worker {
    const struct solve_context *means;
    double (*expected)[RECORD];
    bool same;
};

static void *work(void *context)
{
    struct worker *worker = context;
    struct solve_workspace *workspace = solve_workspace_create();
    static _Thread_local double record[RECORD];
    worker->same = workspace != NULL;
    for (int i = 0; workspace && i < 2 * SCENES; i++) {
        int index = (5 * i + 2) % SCENES;
        solve_and_record(workspace, worker->means, index, record);
        worker->same = worker->same && memcmp(record, worker->expected[index], sizeof record) == 0;
    }
    solve_workspace_free(workspace);
    return NULL;
}

static void same_bytes_on_many_threads(void **state)
{
    (void)state;
    static double expected[SCENES][RECORD];
    struct lab *lab = lab_of_bodies();
    struct worker workers[4];
    pthread_t threads[4];
    for (int i = 0; i < SCENES; i++)
        solve_and_record(lab->workspace, &lab->means, i, expected[i]);
    for (int i = 0; i < 4; i++) {
        workers[i] = (struct worker){&lab->means, expected, false};
        assert_int_equal(pthread_create(&threads[i], NULL, work, &workers[i]), 0);
    }
    for (int i = 0; i < 4; i++) {
        pthread_join(threads[i], NULL);
        assert_true(workers[i].same);
    }
    lab_free(lab);
}

static void a_warm_solve_takes_no_memory(void **state)
{
    (void)state;
    static struct solve_result result;
    if (!COUNTS_MEMORY)
        skip();
    struct lab *lab = lab_of_bodies();
    unsigned long worst = 0;
    for (int i = 0; i < SCENES - 1; i++) { /* the last is CVODE, which has its own memory */
        struct solve_request request = scene(i);
        /* twice: when the first one asks for more modes while it runs, the tables of its earlier
         * steps are made anew in the second */
        solve(lab->workspace, &lab->means, &request, &result);
        solve(lab->workspace, &lab->means, &request, &result);
        taken = 0;
        taken_bytes = 0;
        solve(lab->workspace, &lab->means, &request, &result);
        unsigned long calls = taken;
        if (getenv("PERCUSS_MEASURE"))
            print_message("    scene %d: %lu calls, %zu bytes\n", i, calls, taken_bytes);
        worst = calls > worst ? calls : worst;
    }
    assert_int_equal(worst, 0);
    lab_free(lab);
}

/* Memory that a workspace keeps must not grow with the number of requests. */
static void a_workspace_does_not_grow(void **state)
{
    (void)state;
    static struct solve_result result;
    if (!COUNTS_MEMORY)
        skip();
    struct lab *lab = lab_of_bodies();
    uint64_t seed = 31;
    for (int trial = 0; trial < 200; trial++) {
        struct solve_request request =
            strike(sphere_spot("ball", 0.015),
                   side_spot("beam", random_between(&seed, -0.4, 0.4), 0.010, 0.0),
                   random_between(&seed, 0.1, 0.4));
        if (trial == 150)
            taken_bytes = 0;
        solve(lab->workspace, &lab->means, &request, &result);
    }
    size_t late = taken_bytes;
    /* sites never repeat: what depends on them lives in the arena, not in the cache. A new step
     * table or more modes may still be asked for now and then. */
    if (getenv("PERCUSS_MEASURE"))
        print_message("    last 50 of 200 requests: %zu bytes\n", late);
    assert_true(late < 4000000);
    lab_free(lab);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_bytes_whatever_came_before),
        cmocka_unit_test(kept_sites_do_not_change_a_bit),
        cmocka_unit_test(same_bytes_on_many_threads),
        cmocka_unit_test(a_warm_solve_takes_no_memory),
        cmocka_unit_test(a_workspace_does_not_grow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
