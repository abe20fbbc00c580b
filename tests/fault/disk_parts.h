/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* What the disk for SQLite is made of: files, and what is written down of them. */
#ifndef PERCUSS_TEST_DISK_PARTS_H
#define PERCUSS_TEST_DISK_PARTS_H

#include <stdint.h>

#include "fault/disk.h"

/* What a disk writes in one piece; the store's page is eight of them. */
enum { SECTOR = 512, FILES = 8, NAME = 256 };

struct image {
    char name[NAME];
    bool exists;
    size_t size, room;
    unsigned char *bytes;
};

enum change_kind { CHANGE_CREATE, CHANGE_WRITE, CHANGE_CUT, CHANGE_SYNC, CHANGE_DELETE };

struct change {
    enum change_kind kind;
    int file;
    size_t offset, size;
    unsigned char *bytes; /* of a write */
};

struct record {
    struct change *changes;
    size_t count, room;
};

struct disk {
    struct image files[FILES];
    struct record record, kept;
    unsigned long operations, fail_at;
    bool for_good, full, failed;
    /* of the record that was kept: files as they are on the disk for certain, which has the changes
     * before `settled`; and how far it was looked through for that */
    struct image certain[FILES];
    size_t settled[FILES], looked;
    uint64_t chance;
};
extern struct disk disk;

/* The place of a file of that name, or -1; one that is given to the name. */
int disk_find(const char *name);
int disk_name(const char *name);

/* Counts an operation. Whether it is one that fails. */
bool disk_fails(bool needs_room);

/* Puts bytes into a file, which grows. */
void disk_image_write(struct image *image, size_t offset, const void *bytes, size_t size);

/* Writes a change down. */
void disk_note(enum change_kind kind, int file, size_t offset, size_t size, const void *bytes);

#endif
