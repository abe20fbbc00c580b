/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fault/interpose.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum { DESCRIPTORS = 4096 };

static struct {
    const char *path;
    unsigned long at;
    bool for_good, kills, breaks;
    atomic_ulong calls;
    atomic_bool failed;
    atomic_bool watched[DESCRIPTORS];
} files;

enum { CLOCK_SIZE = 16 };

static const char *count_file, *clock_text, *read_only_file;

/* The C library's function of that name. */
#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static bool concerns(const char *path)
{
    return files.path && path && strstr(path, files.path);
}

static bool is_watched(int file)
{
    return files.path && file >= 0 && file < DESCRIPTORS && atomic_load(&files.watched[file]);
}

static int watch(int file, bool watched)
{
    if (file >= 0 && file < DESCRIPTORS)
        atomic_store(&files.watched[file], watched);
    return file;
}

/* Whether the disk refuses to be written to. */
static bool is_read_only(void)
{
    if (!read_only_file || access(read_only_file, F_OK) != 0)
        return false;
    errno = EROFS;
    return true;
}

/* Whether this operation fails; the end of the process is left to the caller where it writes. */
static bool fails(bool writes)
{
    unsigned long call = atomic_fetch_add(&files.calls, 1) + 1;
    if (!files.at || !(call == files.at || (files.for_good && call > files.at)))
        return false;
    atomic_store(&files.failed, true);
    if (files.kills && !writes)
        raise(SIGKILL);
    errno = writes && !files.breaks ? ENOSPC : EIO;
    return true;
}

void interpose_files(const char *path, unsigned long at, bool for_good)
{
    files.path = path;
    files.at = at;
    files.for_good = for_good;
    atomic_store(&files.calls, 0);
    atomic_store(&files.failed, false);
}

unsigned long interpose_count(void)
{
    return atomic_load(&files.calls);
}

bool interpose_has_failed(void)
{
    return atomic_load(&files.failed);
}

bool interpose_fails(void)
{
    return fails(false);
}

bool interpose_is_meant(void)
{
    const char *program = getenv("PERCUSS_FAULT_PROGRAM");
    return !program || strcmp(program, program_invocation_short_name) == 0;
}

__attribute__((constructor)) static void begin(void)
{
    if (!interpose_is_meant())
        return;
    const char *at = getenv("PERCUSS_FAULT_AT"), *what = getenv("PERCUSS_FAULT_DO");
    files.path = getenv("PERCUSS_FAULT_PATH");
    files.at = at ? strtoul(at, NULL, 10) : 0;
    files.breaks = what && strncmp(what, "break", strlen("break")) == 0;
    files.for_good = what && (strcmp(what, "fail-on") == 0 || strcmp(what, "break-on") == 0);
    files.kills = what && strcmp(what, "kill") == 0;
    count_file = getenv("PERCUSS_FAULT_COUNT");
    read_only_file = getenv("PERCUSS_FAULT_READ_ONLY");
    const char *clock = getenv("PERCUSS_FAULT_CLOCK");
    int file = clock ? REAL(open)(clock, O_RDONLY | O_CLOEXEC) : -1;
    if (file < 0)
        return;
    void *text = mmap(NULL, CLOCK_SIZE, PROT_READ, MAP_SHARED, file, 0);
    clock_text = text == MAP_FAILED ? NULL : text;
    REAL(close)(file);
}

__attribute__((destructor)) static void end(void)
{
    FILE *file = count_file ? REAL(fopen)(count_file, "w") : NULL;
    if (!file)
        return;
    fprintf(file, "%lu\n", interpose_count());
    REAL(fclose)(file);
}

/* Opening, by each of its names. */
#define OPEN_MODE(flags, mode)                                                                     \
    mode_t mode = 0;                                                                               \
    if ((flags) & (O_CREAT | O_TMPFILE)) {                                                         \
        va_list arguments;                                                                         \
        va_start(arguments, flags);                                                                \
        mode = va_arg(arguments, mode_t);                                                          \
        va_end(arguments);                                                                         \
    }

int open(const char *path, int flags, ...)
{
    OPEN_MODE(flags, mode)
    bool watched = concerns(path);
    return watched && fails(false) ? -1 : watch(REAL(open)(path, flags, mode), watched);
}

int open64(const char *path, int flags, ...)
{
    OPEN_MODE(flags, mode)
    bool watched = concerns(path);
    return watched && fails(false) ? -1 : watch(REAL(open64)(path, flags, mode), watched);
}

FILE *fopen(const char *path, const char *mode)
{
    bool watched = concerns(path);
    FILE *file = watched && fails(false) ? NULL : REAL(fopen)(path, mode);
    if (file)
        watch(fileno(file), watched);
    return file;
}

FILE *fopen64(const char *path, const char *mode)
{
    bool watched = concerns(path);
    FILE *file = watched && fails(false) ? NULL : REAL(fopen64)(path, mode);
    if (file)
        watch(fileno(file), watched);
    return file;
}

int mkstemp(char *path)
{
    bool watched = concerns(path);
    return watched && fails(false) ? -1 : watch(REAL(mkstemp)(path), watched);
}

/* What is done with a descriptor. Half of what is written is there when it fails. */
#define ON_FILE(type, name, writes, half, parameters, ...)                                         \
    type name parameters                                                                           \
    {                                                                                              \
        if ((writes) && is_watched(file) && is_read_only())                                        \
            return -1;                                                                             \
        if (is_watched(file) && fails(writes)) {                                                   \
            int reason = errno;                                                                    \
            half;                                                                                  \
            if (files.kills)                                                                       \
                raise(SIGKILL);                                                                    \
            errno = reason;                                                                        \
            return -1;                                                                             \
        }                                                                                          \
        return REAL(name)(__VA_ARGS__);                                                            \
    }

ON_FILE(ssize_t, read, false, , (int file, void *to, size_t size), file, to, size)
ON_FILE(ssize_t, pread, false, , (int file, void *to, size_t size, off_t at), file, to, size, at)
ON_FILE(ssize_t, pread64, false, , (int file, void *to, size_t size, off64_t at), file, to, size,
        at)
ON_FILE(ssize_t, write, true, (void)!REAL(write)(file, from, size / 2),
        (int file, const void *from, size_t size), file, from, size)
ON_FILE(ssize_t, pwrite, true, (void)!REAL(pwrite)(file, from, size / 2, at),
        (int file, const void *from, size_t size, off_t at), file, from, size, at)
ON_FILE(ssize_t, pwrite64, true, (void)!REAL(pwrite64)(file, from, size / 2, at),
        (int file, const void *from, size_t size, off64_t at), file, from, size, at)
ON_FILE(int, fsync, false, , (int file), file)
ON_FILE(int, fdatasync, false, , (int file), file)
ON_FILE(int, fchmod, false, , (int file, mode_t mode), file, mode)
ON_FILE(int, ftruncate, true, , (int file, off_t size), file, size)
ON_FILE(int, ftruncate64, true, , (int file, off64_t size), file, size)

int close(int file)
{
    bool failed = is_watched(file) && fails(false);
    int reason = errno;
    watch(file, false);
    int result = REAL(close)(file);
    errno = failed ? reason : errno;
    return failed ? -1 : result;
}

int fclose(FILE *file)
{
    int number = fileno(file);
    bool failed = is_watched(number) && fails(false);
    int reason = errno;
    watch(number, false);
    int result = REAL(fclose)(file);
    errno = failed ? reason : errno;
    return failed ? EOF : result;
}

/* A stream that has failed says so: _IO_ERR_SEEN, which glibc calls so. */
size_t fread(void *to, size_t size, size_t count, FILE *file)
{
    if (!is_watched(fileno(file)) || !fails(false))
        return REAL(fread)(to, size, count, file);
    file->_flags |= 0x20; /* _IO_ERR_SEEN */
    errno = EIO;
    return 0;
}

int rename(const char *from, const char *to)
{
    return concerns(to) && fails(false) ? -1 : REAL(rename)(from, to);
}

int unlink(const char *path)
{
    return concerns(path) && fails(false) ? -1 : REAL(unlink)(path);
}

/* Seconds that the time of day is off. */
static time_t clock_offset(void)
{
    char text[CLOCK_SIZE + 1] = "";
    if (clock_text)
        memcpy(text, clock_text, CLOCK_SIZE);
    return (time_t)strtol(text, NULL, 10);
}

/* The kind of the watched file system, as a network's would be. */
int statfs(const char *path, struct statfs *about)
{
    const char *type = getenv("PERCUSS_FAULT_FILESYSTEM");
    int result = REAL(statfs)(path, about);
    if (result == 0 && type && concerns(path))
        about->f_type = (__typeof__(about->f_type))strtoul(type, NULL, 0);
    return result;
}

int clock_gettime(clockid_t clock, struct timespec *now)
{
    int result = REAL(clock_gettime)(clock, now);
    if (clock == CLOCK_REALTIME)
        now->tv_sec += clock_offset();
    return result;
}

int gettimeofday(struct timeval *restrict now, void *restrict zone)
{
    int result = REAL(gettimeofday)(now, zone);
    now->tv_sec += clock_offset();
    return result;
}

time_t time(time_t *to)
{
    time_t now = REAL(time)(NULL) + clock_offset();
    if (to)
        *to = now;
    return now;
}

/* Waiting until a time of day ends when that clock says so, whatever it has been set to meanwhile.
 * A time below a thousand million seconds is of the monotonic clock. */
int pthread_cond_timedwait(pthread_cond_t *restrict condition, pthread_mutex_t *restrict lock,
                           const struct timespec *restrict until)
{
    /* the first version of this symbol is that of another struct */
    static __typeof__(&pthread_cond_timedwait) real;
    static const long SLICE = 20000000; /* ns: how soon a new time is seen */
    if (!real)
        real = (__typeof__(&pthread_cond_timedwait))dlvsym(RTLD_NEXT, "pthread_cond_timedwait",
                                                           "GLIBC_2.3.2");
    if (!clock_text || until->tv_sec < 1000000000)
        return real(condition, lock, until);
    for (;;) {
        struct timespec now;
        REAL(clock_gettime)(CLOCK_REALTIME, &now);
        struct timespec end = {until->tv_sec - clock_offset(), until->tv_nsec};
        struct timespec slice = {now.tv_sec, now.tv_nsec + SLICE};
        slice.tv_sec += slice.tv_nsec / 1000000000;
        slice.tv_nsec %= 1000000000;
        bool last = end.tv_sec < slice.tv_sec ||
                    (end.tv_sec == slice.tv_sec && end.tv_nsec <= slice.tv_nsec);
        int result = real(condition, lock, last ? &end : &slice);
        if (result != ETIMEDOUT || last)
            return result;
    }
}
