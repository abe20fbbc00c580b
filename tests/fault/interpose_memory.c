/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <errno.h>
#include <link.h>
#include <malloc.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fault/interpose.h"

/* what there is underneath: glibc's own, which need no search for them, or the address sanitizer's
 */
#ifdef PERCUSS_ADDRESS_SANITIZER
#define REAL(name) __interceptor_##name
#else
#define REAL(name) __libc_##name
#endif
void *REAL(malloc)(size_t size);
void *REAL(calloc)(size_t count, size_t size);
void *REAL(realloc)(void *old, size_t size);
void *REAL(memalign)(size_t alignment, size_t size);

enum { RANGES = 32 };

/* Where the code is whose calls count. */
static struct {
    uintptr_t from, to;
} ranges[RANGES];

static int range_count;

/* Whether an object's file is meant: the program itself always. */
static bool is_named(const char *object, const char *names)
{
    if (!object[0])
        return true;
    while (*names) {
        size_t length = strcspn(names, ":");
        if (length > 0 && memmem(object, strlen(object), names, length))
            return true;
        names += length + (names[length] == ':');
    }
    return false;
}

static int note(struct dl_phdr_info *info, size_t size, void *names)
{
    (void)size;
    if (!is_named(info->dlpi_name, names))
        return 0;
    for (int i = 0; i < info->dlpi_phnum && range_count < RANGES; i++) {
        const ElfW(Phdr) *part = &info->dlpi_phdr[i];
        if (part->p_type != PT_LOAD || !(part->p_flags & PF_X))
            continue;
        ranges[range_count].from = info->dlpi_addr + part->p_vaddr;
        ranges[range_count].to = ranges[range_count].from + part->p_memsz;
        range_count++;
    }
    return 0;
}

__attribute__((constructor)) static void begin(void)
{
    char *names = getenv("PERCUSS_FAULT_MEMORY");
    if (names && interpose_is_meant())
        dl_iterate_phdr(note, names);
}

static bool fails(const void *caller)
{
    uintptr_t at = (uintptr_t)caller;
    int i = 0;
    while (i < range_count && (at < ranges[i].from || at >= ranges[i].to))
        i++;
    if (i == range_count || !interpose_fails())
        return false;
    errno = ENOMEM;
    return true;
}

#define CALLER __builtin_return_address(0)

void *malloc(size_t size)
{
    return fails(CALLER) ? NULL : REAL(malloc)(size);
}

void *calloc(size_t count, size_t size)
{
    return fails(CALLER) ? NULL : REAL(calloc)(count, size);
}

void *realloc(void *old, size_t size)
{
    return fails(CALLER) ? NULL : REAL(realloc)(old, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return fails(CALLER) ? NULL : REAL(memalign)(alignment, size);
}

int posix_memalign(void **to, size_t alignment, size_t size)
{
    void *piece = fails(CALLER) ? NULL : REAL(memalign)(alignment, size);
    if (!piece)
        return ENOMEM;
    *to = piece;
    return 0;
}

char *strndup(const char *text, size_t most)
{
    size_t length = strnlen(text, most);
    char *copy = fails(CALLER) ? NULL : REAL(malloc)(length + 1);
    if (!copy)
        return NULL;
    copy[length] = '\0';
    return memcpy(copy, text, length);
}

char *strdup(const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = fails(CALLER) ? NULL : REAL(malloc)(size);
    return copy ? memcpy(copy, text, size) : NULL;
}
