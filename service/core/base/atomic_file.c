/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "base/atomic_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static enum percuss_status atomic_file_refuse(const char *name, int reason, struct fault *fault)
{
    fault_set(fault, PERCUSS_BAD_REQUEST, "%.400s: cannot be written: %s", name, strerror(reason));
    errno = reason;
    return PERCUSS_BAD_REQUEST;
}

/* "FOLDER/", or "./" */
static void name_folder(const char *path, char folder[ATOMIC_FILE_SIZE])
{
    const char *slash = strrchr(path, '/');
    snprintf(folder, ATOMIC_FILE_SIZE, "%.*s", slash ? (int)(slash + 1 - path) : 2,
             slash ? path : "./");
}

enum percuss_status atomic_file_begin(struct atomic_file *file, const char *path,
                                      struct fault *fault)
{
    struct stat about;
    char folder[ATOMIC_FILE_SIZE];
    file->path = path;
    if (snprintf(file->aside, sizeof file->aside, "%s.part", path) >= (int)sizeof file->aside)
        return atomic_file_refuse(path, ENAMETOOLONG, fault);
    /* a device or a folder is not replaced */
    if (lstat(path, &about) == 0 && !S_ISREG(about.st_mode) && !S_ISLNK(about.st_mode))
        return atomic_file_refuse(path, S_ISDIR(about.st_mode) ? EISDIR : EEXIST, fault);
    name_folder(path, folder);
    if (access(folder, W_OK | X_OK) != 0)
        return atomic_file_refuse(folder, errno, fault);
    if (unlink(file->aside) != 0 && errno != ENOENT)
        return atomic_file_refuse(file->aside, errno, fault);
    return PERCUSS_OK;
}

int atomic_file_create(struct atomic_file *file, const char *path, unsigned mode,
                       struct fault *fault)
{
    if (atomic_file_begin(file, path, fault))
        return -1;
    int descriptor =
        open(file->aside, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, (mode_t)mode);
    if (descriptor < 0)
        atomic_file_refuse(file->aside, errno, fault);
    return descriptor;
}

enum percuss_status atomic_file_sync_folder(const char *path, struct fault *fault)
{
    char folder[ATOMIC_FILE_SIZE];
    name_folder(path, folder);
    int file = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    /* some file systems cannot synchronise folders, and some folders may not be read */
    bool good = file >= 0 ? fsync(file) == 0 || errno == EINVAL : errno == EACCES;
    int reason = errno;
    if (file >= 0)
        close(file);
    return good ? PERCUSS_OK
                : fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: cannot be synchronised: %s",
                            folder, strerror(reason));
}

/* False: errno has the reason. */
static bool synchronise(const char *path)
{
    int file = open(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    bool good = file >= 0 && fsync(file) == 0;
    int reason = errno;
    if (file >= 0)
        close(file);
    errno = reason;
    return good;
}

enum percuss_status atomic_file_rename(const char *from, const char *path, struct fault *fault)
{
    if (!synchronise(from) || rename(from, path) != 0)
        return atomic_file_refuse(path, errno, fault);
    return atomic_file_sync_folder(path, fault);
}

enum percuss_status atomic_file_finish(const struct atomic_file *file, bool durable,
                                       struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    if (durable)
        status = atomic_file_rename(file->aside, file->path, fault);
    else if (rename(file->aside, file->path) != 0)
        status = atomic_file_refuse(file->path, errno, fault);
    if (status)
        atomic_file_abandon(file);
    return status;
}

void atomic_file_abandon(const struct atomic_file *file)
{
    unlink(file->aside);
}
