/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include <sqlite3.h>
#include <string.h>

#include "fault/disk_parts.h"

struct handle {
    sqlite3_file base;
    int file;
};

static int file_close(sqlite3_file *base)
{
    (void)base;
    return SQLITE_OK;
}

static struct image *image_of(sqlite3_file *base)
{
    return &disk.files[((struct handle *)base)->file];
}

static int file_read(sqlite3_file *base, void *to, int size, sqlite3_int64 offset)
{
    const struct image *image = image_of(base);
    size_t from = (size_t)offset, wanted = (size_t)size;
    if (disk_fails(false))
        return SQLITE_IOERR_READ;
    size_t there = from < image->size ? image->size - from : 0;
    size_t got = there < wanted ? there : wanted;
    if (got)
        memcpy(to, image->bytes + from, got);
    memset((char *)to + got, 0, wanted - got);
    return got == wanted ? SQLITE_OK : SQLITE_IOERR_SHORT_READ;
}

static int file_write(sqlite3_file *base, const void *from, int size, sqlite3_int64 offset)
{
    if (disk_fails(true)) {
        /* some of it may be there */
        size_t part = (size_t)size / 2;
        disk_image_write(image_of(base), (size_t)offset, from, part);
        disk_note(CHANGE_WRITE, ((struct handle *)base)->file, (size_t)offset, part, from);
        return disk.full ? SQLITE_FULL : SQLITE_IOERR_WRITE;
    }
    disk_image_write(image_of(base), (size_t)offset, from, (size_t)size);
    disk_note(CHANGE_WRITE, ((struct handle *)base)->file, (size_t)offset, (size_t)size, from);
    return SQLITE_OK;
}

static int file_truncate(sqlite3_file *base, sqlite3_int64 size)
{
    struct image *image = image_of(base);
    if (disk_fails(false))
        return SQLITE_IOERR_TRUNCATE;
    if ((size_t)size < image->size)
        image->size = (size_t)size;
    disk_note(CHANGE_CUT, ((struct handle *)base)->file, 0, (size_t)size, NULL);
    return SQLITE_OK;
}

static int file_sync(sqlite3_file *base, int flags)
{
    (void)flags;
    if (disk_fails(true))
        return disk.full ? SQLITE_FULL : SQLITE_IOERR_FSYNC;
    disk_note(CHANGE_SYNC, ((struct handle *)base)->file, 0, 0, NULL);
    return SQLITE_OK;
}

static int file_size(sqlite3_file *base, sqlite3_int64 *size)
{
    *size = (sqlite3_int64)image_of(base)->size;
    return SQLITE_OK;
}

static int file_lock(sqlite3_file *base, int level)
{
    (void)base, (void)level;
    return SQLITE_OK;
}

static int file_is_reserved(sqlite3_file *base, int *reserved)
{
    (void)base;
    *reserved = 0;
    return SQLITE_OK;
}

static int file_control(sqlite3_file *base, int operation, void *argument)
{
    (void)base, (void)operation, (void)argument;
    return SQLITE_NOTFOUND;
}

static int file_sector(sqlite3_file *base)
{
    (void)base;
    return SECTOR;
}

/* As SQLite supposes of every disk: a write that is torn leaves what is beside it. */
static int file_promises(sqlite3_file *base)
{
    (void)base;
    return SQLITE_IOCAP_POWERSAFE_OVERWRITE;
}

static int disk_open(sqlite3_vfs *vfs, const char *name, sqlite3_file *base, int flags,
                     int *out_flags)
{
    static const sqlite3_io_methods methods = {
        .iVersion = 1,
        .xClose = file_close,
        .xRead = file_read,
        .xWrite = file_write,
        .xTruncate = file_truncate,
        .xSync = file_sync,
        .xFileSize = file_size,
        .xLock = file_lock,
        .xUnlock = file_lock,
        .xCheckReservedLock = file_is_reserved,
        .xFileControl = file_control,
        .xSectorSize = file_sector,
        .xDeviceCharacteristics = file_promises,
    };
    struct handle *handle = (struct handle *)base;
    (void)vfs;
    handle->base.pMethods = NULL;
    if (disk_fails(false))
        return SQLITE_CANTOPEN;
    handle->file = disk_name(name ? name : "temporary");
    struct image *image = &disk.files[handle->file];
    if (!image->exists) {
        if (!(flags & SQLITE_OPEN_CREATE))
            return SQLITE_CANTOPEN;
        image->exists = true;
        image->size = 0;
        disk_note(CHANGE_CREATE, handle->file, 0, 0, NULL);
    }
    if (out_flags)
        *out_flags = flags;
    handle->base.pMethods = &methods;
    return SQLITE_OK;
}

static int disk_delete(sqlite3_vfs *vfs, const char *name, int sync_folder)
{
    int file = disk_find(name);
    (void)vfs, (void)sync_folder;
    if (disk_fails(false))
        return SQLITE_IOERR_DELETE;
    if (file < 0 || !disk.files[file].exists)
        return SQLITE_IOERR_DELETE_NOENT;
    disk.files[file].exists = false;
    disk.files[file].size = 0;
    disk_note(CHANGE_DELETE, file, 0, 0, NULL);
    return SQLITE_OK;
}

static int disk_access(sqlite3_vfs *vfs, const char *name, int flags, int *there)
{
    int file = disk_find(name);
    (void)vfs, (void)flags;
    if (disk_fails(false))
        return SQLITE_IOERR_ACCESS;
    *there = file >= 0 && disk.files[file].exists;
    return SQLITE_OK;
}

static int disk_full_name(sqlite3_vfs *vfs, const char *name, int size, char *full)
{
    (void)vfs;
    sqlite3_snprintf(size, full, "%s", name);
    return SQLITE_OK;
}

void disk_install(void)
{
    static sqlite3_vfs vfs;
    vfs = *sqlite3_vfs_find(NULL);
    vfs.iVersion = 1;
    vfs.szOsFile = sizeof(struct handle);
    vfs.pNext = NULL;
    vfs.zName = "disk";
    vfs.xOpen = disk_open;
    vfs.xDelete = disk_delete;
    vfs.xAccess = disk_access;
    vfs.xFullPathname = disk_full_name;
    sqlite3_vfs_register(&vfs, 1);
}
