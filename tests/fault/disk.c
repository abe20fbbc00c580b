/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "fault/disk_parts.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct disk disk;

static void *need(void *memory)
{
    if (!memory)
        abort();
    return memory;
}

static void image_grow(struct image *image, size_t size)
{
    if (size > image->room) {
        image->room = 2 * size;
        image->bytes = need(realloc(image->bytes, image->room));
    }
    if (size > image->size) {
        /* what was never written may hold anything */
        memset(image->bytes + image->size, 0xa5, size - image->size);
        image->size = size;
    }
}

void disk_image_write(struct image *image, size_t offset, const void *bytes, size_t size)
{
    image_grow(image, offset + size);
    memcpy(image->bytes + offset, bytes, size);
}

static void image_copy(struct image *to, const struct image *from)
{
    strcpy(to->name, from->name);
    to->exists = from->exists;
    to->size = 0;
    if (from->size)
        disk_image_write(to, 0, from->bytes, from->size);
}

void disk_note(enum change_kind kind, int file, size_t offset, size_t size, const void *bytes)
{
    struct record *record = &disk.record;
    if (record->count == record->room) {
        record->room = 2 * record->room + 64;
        record->changes = need(realloc(record->changes, record->room * sizeof *record->changes));
    }
    struct change *change = &record->changes[record->count++];
    *change = (struct change){kind, file, offset, size, NULL};
    if (bytes)
        change->bytes = memcpy(need(malloc(size)), bytes, size);
}

static void record_free(struct record *record)
{
    for (size_t i = 0; i < record->count; i++)
        free(record->changes[i].bytes);
    free(record->changes);
    *record = (struct record){0};
}

bool disk_fails(bool needs_room)
{
    disk.operations++;
    if (!disk.fail_at || (disk.full && !needs_room))
        return false;
    bool now = disk.operations == disk.fail_at || (disk.for_good && disk.operations > disk.fail_at);
    /* a full disk refuses the next operation that needs room */
    now = now || (disk.full && disk.operations > disk.fail_at && !disk.failed);
    disk.failed = disk.failed || now;
    return now;
}

int disk_find(const char *name)
{
    for (int i = 0; i < FILES; i++)
        if (disk.files[i].name[0] && strcmp(disk.files[i].name, name) == 0)
            return i;
    return -1;
}

int disk_name(const char *name)
{
    int file = disk_find(name);
    for (int i = 0; file < 0 && i < FILES; i++)
        if (!disk.files[i].name[0]) {
            strncpy(disk.files[i].name, name, NAME - 1);
            file = i;
        }
    if (file < 0)
        abort();
    return file;
}

static void forget_files(struct image *files)
{
    for (int i = 0; i < FILES; i++)
        free(files[i].bytes);
    memset(files, 0, FILES * sizeof *files);
}

void disk_clear(void)
{
    forget_files(disk.files);
    record_free(&disk.record);
    disk.operations = 0;
    disk_fail(0, false, false);
}

void disk_fail(unsigned long n, bool for_good, bool full)
{
    disk.fail_at = n ? disk.operations + n : 0;
    disk.for_good = for_good;
    disk.full = full;
    disk.failed = false;
}

bool disk_has_failed(void)
{
    return disk.failed;
}

unsigned long disk_operations(void)
{
    return disk.operations;
}

size_t disk_changes(void)
{
    return disk.record.count;
}

void disk_keep_record(void)
{
    record_free(&disk.kept);
    forget_files(disk.certain);
    for (int i = 0; i < FILES; i++)
        strcpy(disk.certain[i].name, disk.files[i].name);
    disk.kept = disk.record;
    disk.record = (struct record){0};
    memset(disk.settled, 0, sizeof disk.settled);
    disk.looked = 0;
    disk_clear();
}

unsigned disk_draw(unsigned below)
{
    disk.chance = disk.chance * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(disk.chance >> 33) % below;
}

static void apply(struct image *image, const struct change *change)
{
    switch (change->kind) {
    case CHANGE_CREATE:
        image->exists = true;
        image->size = 0;
        break;
    case CHANGE_WRITE:
        disk_image_write(image, change->offset, change->bytes, change->size);
        break;
    case CHANGE_CUT:
        image->size = change->size < image->size ? change->size : image->size;
        break;
    case CHANGE_DELETE:
        image->exists = false;
        image->size = 0;
        break;
    case CHANGE_SYNC:
        break;
    }
}

/* All of it, nothing of it, or the sectors that chance takes. */
static void apply_in_part(struct image *image, const struct change *change)
{
    unsigned fate = disk_draw(3);
    if (fate == 0)
        return;
    if (fate == 1 || change->kind != CHANGE_WRITE) {
        apply(image, change);
        return;
    }
    for (size_t at = 0; at < change->size; at += SECTOR) {
        size_t size = change->size - at < SECTOR ? change->size - at : SECTOR;
        if (disk_draw(2))
            disk_image_write(image, change->offset + at, change->bytes + at, size);
    }
}

/* What is not certain of a file. Its name leads to the file that was there before it was deleted,
 * to none, or to the one that was made then; never to something of both. */
static void apply_by_chance(int file, size_t cut)
{
    struct image *image = &disk.files[file];
    for (size_t i = disk.settled[file]; i < cut; i++) {
        const struct change *change = &disk.kept.changes[i];
        if (change->file != file)
            continue;
        if (change->kind == CHANGE_DELETE && disk_draw(2))
            return;
        if (change->kind == CHANGE_DELETE || (change->kind == CHANGE_CREATE && disk_draw(2)))
            apply(image, change);
        else if (image->exists)
            apply_in_part(image, change);
    }
}

/* What a file was synchronised with is on the disk for certain. */
static void settle(int file, size_t until)
{
    for (size_t i = disk.settled[file]; i < until; i++)
        if (disk.kept.changes[i].file == file)
            apply(&disk.certain[file], &disk.kept.changes[i]);
    disk.settled[file] = until;
}

/* A new file is synchronised with its name, and so are all names of the folder. */
static void settle_names(int file, size_t until)
{
    bool is_new = false;
    for (size_t i = disk.settled[file]; i < until; i++)
        if (disk.kept.changes[i].file == file && disk.kept.changes[i].kind == CHANGE_CREATE)
            is_new = true;
    for (size_t i = until; is_new && i-- > 0;) {
        const struct change *change = &disk.kept.changes[i];
        if (change->kind == CHANGE_DELETE && i >= disk.settled[change->file])
            settle(change->file, i + 1);
    }
}

void disk_lose_power(size_t cut, unsigned seed)
{
    disk_clear();
    uint64_t before = disk.chance;
    disk.chance = seed * 2654435761u + cut;
    for (; disk.looked < cut; disk.looked++) {
        const struct change *change = &disk.kept.changes[disk.looked];
        if (change->kind != CHANGE_SYNC)
            continue;
        settle_names(change->file, disk.looked);
        settle(change->file, disk.looked);
    }
    for (int i = 0; i < FILES; i++) {
        image_copy(&disk.files[i], &disk.certain[i]);
        apply_by_chance(i, cut);
    }
    disk.chance = before;
}

static struct image *named(const char *name)
{
    return &disk.files[disk_name(name)];
}

size_t disk_size(const char *name)
{
    return named(name)->size;
}

unsigned char disk_byte(const char *name, size_t at)
{
    return named(name)->bytes[at];
}

void disk_write(const char *name, size_t at, const void *bytes, size_t size)
{
    disk_image_write(named(name), at, bytes, size);
}

void disk_cut(const char *name, size_t size)
{
    named(name)->size = size;
}

bool disk_is_whole(void)
{
    const char *faults = getenv("PERCUSS_FAULTS");
    return faults && strcmp(faults, "whole") == 0;
}
