/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/database_check.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "store/database.h"

/* SQLite's file format: the size of the header, offsets of its numbers (big-endian), and the octets
 * that a process locks to have the file to itself. */
enum { HEADER_SIZE = 100, AT_VERSION = 60, AT_APPLICATION = 68 };
static const char MAGIC[] = "SQLite format 3"; /* with its final zero */
/* KiB: the log's bound (database.c), written back, and an impact with its reply. */
static const unsigned long long ROOM = 2048;
static const off_t LOCKS = 0x40000000, LOCK_COUNT = 512;

static enum percuss_status database_check_refuse(const char *path, const char *problem,
                                                 struct fault *fault)
{
    size_t length = strlen(path), most = 255;
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: %s",
                     length > most ? path + length - most : path, problem);
}

static enum percuss_status refuse_access(const char *path, const char *verb, struct fault *fault)
{
    char problem[160];
    snprintf(problem, sizeof problem, "cannot be %s: %s", verb, strerror(errno));
    return database_check_refuse(path, problem, fault);
}

/* Whether this user may make a missing folder: asks the first existing one above it. */
static bool may_make(const char *folder)
{
    char above[4096];
    snprintf(above, sizeof above, "%s", folder);
    while (access(above, F_OK) != 0) {
        char *slash = strrchr(above, '/');
        if (!slash || slash == above)
            return access(slash ? "/" : ".", W_OK | X_OK) == 0;
        *slash = '\0';
    }
    return access(above, W_OK | X_OK) == 0;
}

/* The message names the command that makes the folder. */
static enum percuss_status refuse_folder(const char *path, const char *folder, struct fault *fault)
{
    enum { SHOWN = 240 };
    char problem[384] = "cannot be made: No such file or directory: its folder is missing";
    size_t used = strlen(problem);
    if (strlen(folder) <= SHOWN)
        snprintf(problem + used, sizeof problem - used, ": %s %s makes it",
                 may_make(folder) ? "mkdir -p" : "sudo install -d -o \"$(id -un)\"", folder);
    return database_check_refuse(path, problem, fault);
}

enum percuss_status database_folder_check(const char *path, struct fault *fault)
{
    char folder[4096] = ".";
    const char *slash = strrchr(path, '/');
    if (slash && (size_t)(slash - path) < sizeof folder - 1)
        snprintf(folder, sizeof folder, "%.*s", slash > path ? (int)(slash - path) : 1, path);
    if (access(folder, W_OK | X_OK) == 0)
        return PERCUSS_OK;
    return errno == ENOENT ? refuse_folder(path, folder, fault)
                           : refuse_access(path, "made", fault);
}

static uint32_t number_at(const unsigned char *octets)
{
    return (uint32_t)octets[0] << 24 | (uint32_t)octets[1] << 16 | (uint32_t)octets[2] << 8 |
           octets[3];
}

static enum percuss_status check_header(const char *path, int file, int version,
                                        struct fault *fault)
{
    unsigned char header[HEADER_SIZE];
    char problem[160];
    ssize_t size = read(file, header, sizeof header);
    if (size < 0)
        return refuse_access(path, "read", fault);
    /* an empty file becomes ours */
    if (size == 0)
        return PERCUSS_OK;
    if (size < HEADER_SIZE || memcmp(header, MAGIC, sizeof MAGIC) != 0)
        return database_check_refuse(
            path, "cannot be used as a store of specimens: file is not a database", fault);
    if (number_at(header + AT_APPLICATION) != DATABASE_APPLICATION)
        return database_check_refuse(path, "is a database of another program", fault);
    uint32_t found = number_at(header + AT_VERSION);
    if (found >= 1 && found <= (uint32_t)version)
        return PERCUSS_OK;
    snprintf(problem, sizeof problem, "is of version %u: must be of version 1 to %d", found,
             version);
    return database_check_refuse(path, problem, fault);
}

/* That the file lies in, with its last slash. */
static void find_folder(const char *path, char *folder, size_t size)
{
    const char *slash = strrchr(path, '/');
    snprintf(folder, size, "%.*s", slash ? (int)(slash + 1 - path) : 1, slash ? path : ".");
}

/* Of the file, which may be a link to another volume; where there is none, of its folder. */
static bool find_volume(const char *path, struct statfs *volume)
{
    char folder[4096];
    find_folder(path, folder, sizeof folder);
    return statfs(path, volume) == 0 || statfs(folder, volume) == 0;
}

bool database_remark_volume(const char *path, char *remark, size_t size)
{
    /* statfs(2); FUSE is sshfs, GlusterFS and the like, and local ones (ntfs-3g) */
    static const char nfs[] = ": NFS version 4, without nolock and local_lock";
    static const struct {
        unsigned long type;
        const char *name, *advice;
    } shared[] = {{0x6969, "NFS", nfs},   {0xff534d42, "CIFS", ""},   {0xfe534d42, "SMB", ""},
                  {0x517b, "SMB", ""},    {0x65735546, "FUSE", ""},   {0x01021997, "9P", ""},
                  {0xc36400, "Ceph", ""}, {0x0bd00bd0, "Lustre", ""}, {0x5346414f, "AFS", ""}};
    struct statfs volume;
    if (!find_volume(path, &volume))
        return false;
    for (size_t i = 0; i < sizeof shared / sizeof *shared; i++) {
        /* some kernels extend the sign of 32 bits */
        if (((unsigned long)volume.f_type & 0xffffffff) != shared[i].type)
            continue;
        snprintf(
            remark, size,
            "lies on %s, which may be shared with other machines: the file's lock alone keeps a "
            "second daemon out, so that they all have to see locks%s",
            shared[i].name, shared[i].advice);
        return true;
    }
    return false;
}

enum percuss_status database_room_check(const char *path, struct fault *fault)
{
    char folder[4096];
    struct statvfs volume;
    find_folder(path, folder, sizeof folder);
    if (statvfs(folder, &volume) != 0 || volume.f_blocks == 0)
        return PERCUSS_OK;
    unsigned long long left = (unsigned long long)volume.f_bavail * volume.f_frsize / 1024;
    if (left >= ROOM)
        return PERCUSS_OK;
    return fault_set(fault, PERCUSS_BUSY,
                     "there is no room: %llu KiB are free in %.300s, and %llu are needed", left,
                     folder, ROOM);
}

static enum percuss_status check_locks(const char *path, int file, struct fault *fault)
{
    char problem[96];
    struct flock lock = {
        .l_type = F_RDLCK, .l_whence = SEEK_SET, .l_start = LOCKS, .l_len = LOCK_COUNT};
    if (fcntl(file, F_GETLK, &lock) != 0)
        return refuse_access(path, "locked", fault);
    if (lock.l_type == F_UNLCK)
        return PERCUSS_OK;
    snprintf(problem, sizeof problem, "is in use by another process (%ld)", (long)lock.l_pid);
    return database_check_refuse(path, problem, fault);
}

enum percuss_status database_check(const char *path, int version, struct fault *fault)
{
    struct stat found;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0 && errno == ENOENT)
        return database_folder_check(path, fault);
    if (file < 0)
        return refuse_access(path, "read", fault);
    /* SQLite needs a writable file, and a writable folder for its other files */
    enum percuss_status status = PERCUSS_OK;
    if (fstat(file, &found) != 0 || !S_ISREG(found.st_mode))
        status = database_check_refuse(path, "is no file", fault);
    else if (access(path, W_OK) != 0)
        status = refuse_access(path, "written", fault);
    else
        status = database_folder_check(path, fault);
    /* ours, and in no other process's use */
    if (!status)
        status = check_header(path, file, version, fault);
    if (!status)
        status = check_locks(path, file, fault);
    close(file);
    return status;
}
