/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "store/table_file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "store/folder.h"
#include "store/table_key.h"

static enum percuss_status refuse(struct fault *fault, const char *path, const char *what)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: %s: %s", path, what, strerror(errno));
}

/* Text and the name go to disk before the new name is seen. */
static bool write_all(int file, const char *text)
{
    size_t left = strlen(text);
    while (left > 0) {
        ssize_t done = write(file, text, left);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return false;
        text += done;
        left -= (size_t)done;
    }
    return fsync(file) == 0;
}

enum percuss_status table_file_write(const char *folder, const char *text, const char *path,
                                     struct fault *fault)
{
    char aside[TABLE_PATH_SIZE];
    if (!folder_make(folder))
        return refuse(fault, folder, "cannot be made");
    /* no .json at its end: not taken for a table */
    if (snprintf(aside, sizeof aside, "%s/.table-XXXXXX", folder) >= (int)sizeof aside) {
        errno = ENAMETOOLONG;
        return refuse(fault, folder, "cannot be written to");
    }
    int file = mkstemp(aside);
    if (file < 0)
        return refuse(fault, folder, "cannot be written to");
    /* it gets its name once it is whole */
    bool good = write_all(file, text) && fchmod(file, 0644) == 0;
    good = close(file) == 0 && good;
    if (good && rename(aside, path) == 0)
        return atomic_file_sync_folder(path, fault);
    enum percuss_status status = refuse(fault, path, "cannot be written");
    unlink(aside);
    return status;
}

enum percuss_status table_file_save(const char *folder, const struct indentation_table *table,
                                    const struct table_origin *origin, char path[TABLE_PATH_SIZE],
                                    struct fault *fault)
{
    char key[TABLE_KEY_SIZE];
    table_key(&table->input, key);
    if (snprintf(path, TABLE_PATH_SIZE, "%s/%s.json", folder, key) >= TABLE_PATH_SIZE) {
        errno = ENAMETOOLONG;
        return refuse(fault, folder, "cannot be used");
    }
    char *text = table_json_write(table, origin);
    if (!text)
        return fault_set(fault, PERCUSS_INTERNAL, "contact table: out of memory");
    enum percuss_status status = table_file_write(folder, text, path, fault);
    free(text);
    return status;
}

enum percuss_status table_file_read(const char *path, char **text, size_t *size,
                                    struct fault *fault)
{
    FILE *file = fopen(path, "rbe");
    struct stat about;
    enum percuss_status status = PERCUSS_OK;
    *text = NULL;
    if (!file || fstat(fileno(file), &about) != 0) {
        status = refuse(fault, path, "cannot be read");
    } else if (!S_ISREG(about.st_mode) || about.st_size > TABLE_FILE_MAX_BYTES) {
        status = fault_set(fault, PERCUSS_BAD_REQUEST, "%.300s: must be a file of at most %d bytes",
                           path, TABLE_FILE_MAX_BYTES);
    } else if (!(*text = malloc((size_t)about.st_size + 1))) {
        status = fault_set(fault, PERCUSS_INTERNAL, "%.300s: out of memory", path);
    } else {
        *size = fread(*text, 1, (size_t)about.st_size, file);
    }
    if (file)
        fclose(file);
    return status;
}

enum percuss_status table_file_load(const char *path, struct indentation_table *table,
                                    struct fault *fault)
{
    size_t size = 0;
    *table = (struct indentation_table){0};
    struct fault reason = {""};
    char *text;
    enum percuss_status status = table_file_read(path, &text, &size, fault);
    if (status)
        return status;
    status = table_json_read(text, size, table, &reason);
    free(text);
    if (status)
        fault_set(fault, status, "%.300s: %.300s", path, reason.text);
    return status;
}
