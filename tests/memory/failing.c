/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "memory/failing.h"

#include <errno.h>
#include <execinfo.h>
#include <string.h>
#include <unistd.h>

#include "base/arena.h"

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *memory);
void *__real_arena_take(struct arena *arena, size_t count, size_t size);
void *__real_arena_reserve(struct arena *arena, size_t count, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *memory);
void *__wrap_arena_take(struct arena *arena, size_t count, size_t size);
void *__wrap_arena_reserve(struct arena *arena, size_t count, size_t size);

/* a table of the pieces in use, by address with open addressing: twice as many as any test has */
enum { PLACES = 1 << 18, CALLERS = 16 };

static struct {
    bool on, for_good, failed;
    unsigned long calls, at; /* since the trial began; the one that fails */
    size_t in_use;
    void *pieces[PLACES];
    void *callers[CALLERS]; /* of the call that failed, the nearest first */
    int caller_count;
} memory;

static size_t place_of(const void *piece)
{
    size_t place = ((uintptr_t)piece >> 4) * 0x9e3779b97f4a7c15u >> 46;
    while (memory.pieces[place] && memory.pieces[place] != piece)
        place = (place + 1) % PLACES;
    return place;
}

static void *taken(void *piece)
{
    if (piece) {
        memory.pieces[place_of(piece)] = piece;
        memory.in_use++;
    }
    return piece;
}

/* Takes a piece out, and puts those behind it where they are found without it. */
static void given_back(const void *piece)
{
    size_t place = place_of(piece);
    if (!piece || !memory.pieces[place])
        return;
    memory.pieces[place] = NULL;
    memory.in_use--;
    for (place = (place + 1) % PLACES; memory.pieces[place]; place = (place + 1) % PLACES) {
        void *moved = memory.pieces[place];
        memory.pieces[place] = NULL;
        memory.pieces[place_of(moved)] = moved;
    }
}

/* Whether this call gets nothing. */
static bool fails(void)
{
    if (!memory.on)
        return false;
    memory.calls++;
    if (memory.calls != memory.at && !(memory.for_good && memory.calls > memory.at))
        return false;
    if (!memory.failed)
        memory.caller_count = backtrace(memory.callers, CALLERS);
    memory.failed = true;
    errno = ENOMEM;
    return true;
}

void *__wrap_malloc(size_t size)
{
    return fails() ? NULL : taken(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size)
{
    return fails() ? NULL : taken(__real_calloc(count, size));
}

void *__wrap_realloc(void *old, size_t size)
{
    if (fails())
        return NULL;
    given_back(old);
    return taken(__real_realloc(old, size));
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return fails() ? NULL : taken(__real_aligned_alloc(alignment, size));
}

void __wrap_free(void *piece)
{
    given_back(piece);
    __real_free(piece);
}

/* Most calls find room in a block that the arena has: they fail as if there were none. */
static bool arena_fails(struct arena *arena)
{
    bool lacks = fails();
    arena->lacks = arena->lacks || lacks;
    return lacks;
}

void *__wrap_arena_take(struct arena *arena, size_t count, size_t size)
{
    return arena_fails(arena) ? NULL : __real_arena_take(arena, count, size);
}

void *__wrap_arena_reserve(struct arena *arena, size_t count, size_t size)
{
    return arena_fails(arena) ? NULL : __real_arena_reserve(arena, count, size);
}

void *failing_malloc(size_t size)
{
    return __wrap_malloc(size);
}

void *failing_realloc(void *old, size_t size)
{
    return __wrap_realloc(old, size);
}

void failing_free(void *piece)
{
    __wrap_free(piece);
}

void failing_begin(void)
{
    memory.on = true;
}

void failing_end(void)
{
    memory.on = false;
}

void fail_by_memory(const char *what)
{
    failing_end();
    print_error("call %lu of %lu fails: %s; it comes from (for addr2line)\n", memory.at,
                memory.calls, what);
    backtrace_symbols_fd(memory.callers, memory.caller_count, STDERR_FILENO);
    fail();
}

unsigned long fail_each(const char *what, failing_trial *trial, void *context, unsigned dense)
{
    unsigned long calls = 0;
    for (int for_good = 0; for_good < 2; for_good++) {
        memory.for_good = for_good;
        for (memory.at = 1, memory.failed = true; memory.failed;
             memory.at += 1 + memory.at / dense) {
            size_t before = memory.in_use;
            memory.calls = 0;
            memory.failed = false;
            bool whole = trial(context);
            failing_end();
            if (memory.in_use != before)
                fail_by_memory("memory is lost");
            if (!memory.failed && !whole)
                fail_msg("%s: out of memory without lack of any", what);
            if (!memory.failed)
                calls = memory.calls;
        }
    }
    if (getenv("PERCUSS_MEASURE"))
        print_message("    %-44s %lu calls\n", what, calls);
    return calls;
}

bool is_out_of_memory(enum percuss_status status, const char *text)
{
    failing_end();
    if (status == PERCUSS_OK || status == PERCUSS_TRUNCATED)
        return false;
    if (status != PERCUSS_INTERNAL || !strstr(text, "memory"))
        fail_by_memory(text);
    return true;
}
